#!/bin/sh
# SPDX-License-Identifier: MIT
# The pages of docs/ against peri.h: every public function, struct, field, callback type, enumerator and status is said where a reader looks
# for it, every name in the pages exists, every relative link leads to a file and a heading. A part of make lint.
cd "$(dirname "$0")/.." || exit 1
switches=$(grep -ohE '\b(defined *\(|ifn?def )PERI_[A-Z0-9_]+' src/base/*.h src/base/real.c src/body/body.c peri_impl.c peri.h | sed -E 's/.*[( ]//' | sort -u | tr '\n' ' ')
awk -v switches="$switches" -f tools/check_docs.awk peri.h README.md docs/*.md
