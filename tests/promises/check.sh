#!/bin/sh
# SPDX-License-Identifier: MIT
# What a page promises is tested: each of its sentences has an entry in tests/promises/NAME*.txt (docs/NAME.md, README.md), and what the
# entry names is there.
#   check.sh          a part of make lint
#   check.sh --list   sentences without an entry, as entries to be completed
#
# A list has the headings of the page (whatever their level: "## Build"), and below each an entry for each sentence:
#
#   p A bond that is stretched too far breaks … and stays broken.        p: it promises something. "…" stands for what is left out, which
#     tests/test_breaking.c: two_points, reset_and_repeat                may be no number: a number that changes asks for the test again.
#                                                                        Any lines of proofs: a file, and what in it checks the sentence:
#                                                                        a case that a test program runs, a function, "a text in quotes".
#   d A body is a cloud of points.                                       d: says what a word means; e: explains; a: advises; r: refers to
#                                                                        other places, or leads to what follows.
#
# A quote may go on in the next line, indented by two; "  # remark" says how the proof proves. What has a number, or says must, never, always,
# refused, returns, exact, same bits, is a promise.
cd "$(dirname "$0")/../.." || exit 1
status=0
for page in docs/manual.md docs/statics.md README.md; do
    name=${page##*/}
    awk -f tests/promises/sentences.awk $page |
        awk -v page=$page -v list="${1:+1}" -f tests/promises/check.awk - tests/promises/${name%.md}*.txt || status=1
done
exit $status
