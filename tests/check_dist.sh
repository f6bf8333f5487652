#!/bin/sh
# SPDX-License-Identifier: MIT
# The single-file header: generated twice alike, self-contained, the same tokens as the tree, only peri_ names exported, no state, only PERI
# macros left defined.
#   check_dist.sh --quick   the tokens of clang (else of gcc) and tcc alone: gcc takes ten times as long as clang for those of the single file
set -e
quick=$1
cc=${CC:-cc}
dir=build/checks/dist
file=build/dist/peri.h
rm -rf $dir
mkdir -p $dir build/dist
must_be_empty() { # must_be_empty WHAT FILE
    if [ -s "$2" ]; then
        echo "$1:"
        cat "$2"
        exit 1
    fi
}
awk -f tools/dist.awk peri.h > $file
awk -f tools/dist.awk peri.h | cmp - $file
grep -n '^#include "' $file > $dir/includes || true
must_be_empty "not self-contained" $dir/includes

# what each compiler sees, all vectors included, line marks and spaces at the start of lines aside: then the machine code is the same under
# any flags. The file includes itself: so under another name, too, which those compilers must be told that do not tell it
tokens() { # tokens FLAGS AND SOURCE
    $cc_of_tokens -std=c99 -DPERI_KERNELS=3 -E -P "$@" > $dir/raw
    sed 's/^[[:space:]]*//' $dir/raw | grep -v '^$' > $dir/tokens
}
cp $file $dir/other_name.h
printf '#define PERI_IMPLEMENTATION\n#include "../../dist/peri.h"\n' > $dir/user.c
printf '#define PERI_IMPLEMENTATION\n#include "other_name.h"\n' > $dir/other.c
compilers="gcc clang tcc x86_64-w64-mingw32-gcc"
if [ -n "$quick" ]; then
    compilers="tcc gcc"
    if command -v clang > /dev/null; then compilers="tcc clang"; fi
fi
for compiler in $compilers; do
    command -v $compiler > /dev/null || { echo "skip $compiler: not on this machine"; continue; }
    named=""
    echo __FILE_NAME__ | $compiler -E -P - 2> /dev/null | grep -q '"' || named='-DPERI_FILE="other_name.h"'
    cc_of_tokens=$compiler
    tokens peri_impl.c
    mv $dir/tokens $dir/tree
    tokens $dir/user.c
    cmp $dir/tokens $dir/tree
    tokens $named $dir/other.c
    cmp $dir/tokens $dir/tree
done
cc_of_tokens=$cc
if [ -n "$quick" ]; then # whose tokens of the tree are there
    cc_of_tokens=${compilers#* }
else
    tokens peri_impl.c
    mv $dir/tokens $dir/tree
fi
for header in peri.h $file; do
    tokens -DPERI_IMPLEMENTATION -x c $header
    cmp $dir/tokens $dir/tree
done
if command -v tcc > /dev/null; then tcc -c $dir/user.c -o $dir/tcc.o; fi
if [ -z "$quick" ] && command -v x86_64-w64-mingw32-gcc > /dev/null; then
    x86_64-w64-mingw32-gcc -std=c99 -Wall -Wextra -Werror -fsyntax-only $dir/user.c
fi
# guards, and the files of criteria that several lists take up, are some 410 lines
parts=$(cat peri.h peri_impl.c src/*/* | wc -l)
[ "$(wc -l < $file)" -le $((parts + 450)) ] || { echo "$file: 450 lines more than its parts: is a text there twice?"; exit 1; }

if command -v nm > /dev/null; then
    nm -g --defined-only build/libperi.a | awk "NF == 3" | grep -v ' peri_' > $dir/foreign || true
    must_be_empty "exported names without peri_" $dir/foreign
fi
if command -v objdump > /dev/null; then # .data.rel.ro: constants that hold addresses
    objdump -t build/libperi.a | grep -E '[[:space:]](\.(data|bss|tdata|tbss)|\*COM\*)' | grep -vE ' d +\.|\.data\.rel\.ro' > $dir/state || true
    must_be_empty "writable data" $dir/state
fi
printf '#include <stdint.h>\n#include <stddef.h>\n' | $cc -std=c99 -dM -E - | sort > $dir/before
printf '#include <stdint.h>\n#include <stddef.h>\n#include "peri.h"\n' | $cc -std=c99 -Ibuild/dist -dM -E - | sort > $dir/after
comm -13 $dir/before $dir/after | grep -v '^#define PERI_' > $dir/macros || true
must_be_empty "macros left defined" $dir/macros
