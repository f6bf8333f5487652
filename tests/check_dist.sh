#!/bin/sh
# The single-file header: generated twice alike, self-contained, the same machine code as the tree, only peri_ names exported, no state,
# only PERI macros left defined.
set -e
cc=${CC:-cc}
dir=build/checks/dist
rm -rf $dir
mkdir -p $dir
must_be_empty() { # must_be_empty WHAT FILE
    if [ -s "$2" ]; then
        echo "$1:"
        cat "$2"
        exit 1
    fi
}
awk -f tools/dist.awk peri.h > $dir/peri.h
awk -f tools/dist.awk peri.h | cmp - $dir/peri.h
grep -n '^#include "' $dir/peri.h > $dir/includes || true
must_be_empty "not self-contained" $dir/includes

printf '#define PERI_IMPLEMENTATION\n#include "peri.h"\n' > $dir/one.c
(cd $dir && $cc -std=c99 -pedantic -Wall -Wextra -Wconversion -Wshadow -Wundef -Werror -O1 -fno-pic -c one.c -o dist.o)
$cc -std=c99 -O1 -fno-pic -c peri_impl.c -o $dir/tree.o
if command -v objdump > /dev/null; then
    objdump -d $dir/dist.o | sed 1,3d > $dir/dist.s
    objdump -d $dir/tree.o | sed 1,3d > $dir/tree.s
    cmp $dir/dist.s $dir/tree.s
fi
if command -v nm > /dev/null; then
    nm -g --defined-only $dir/dist.o | grep -v ' peri_' > $dir/foreign || true
    must_be_empty "exported names without peri_" $dir/foreign
    nm $dir/dist.o | grep -i ' [bcd] ' > $dir/state || true
    must_be_empty "writable data" $dir/state
fi
printf '#include <stdint.h>\n#include <stddef.h>\n' | $cc -std=c99 -dM -E - | sort > $dir/before
printf '#include <stdint.h>\n#include <stddef.h>\n#include "peri.h"\n' | $cc -std=c99 -I$dir -dM -E - | sort > $dir/after
comm -13 $dir/before $dir/after | grep -v '^#define PERI_' > $dir/macros || true
must_be_empty "macros left defined" $dir/macros
