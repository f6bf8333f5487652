#!/bin/sh
# The single-file header: generated twice alike, self-contained, the same machine code as the tree, only peri_ names exported, only PERI
# macros left defined.
set -e
cc=${CC:-cc}
dir=build/checks/dist
rm -rf $dir
mkdir -p $dir
awk -f tools/dist.awk peri.h > $dir/peri.h
awk -f tools/dist.awk peri.h | cmp - $dir/peri.h
! grep -n '^#include "' $dir/peri.h

printf '#define PERI_IMPLEMENTATION\n#include "peri.h"\n' > $dir/one.c
(cd $dir && $cc -std=c99 -pedantic -Wall -Wextra -Wconversion -Wshadow -Wundef -Werror -O2 -c one.c -o dist.o)
$cc -std=c99 -O2 -c peri_impl.c -o $dir/tree.o
if command -v objdump > /dev/null; then
    objdump -d $dir/dist.o | sed 1,3d > $dir/dist.s
    objdump -d $dir/tree.o | sed 1,3d > $dir/tree.s
    cmp $dir/dist.s $dir/tree.s
fi
if command -v nm > /dev/null; then
    ! nm -g --defined-only $dir/dist.o | grep -v ' peri_'
    # no state: nothing in writable data
    ! nm $dir/dist.o | grep -i ' [bd] '
fi
printf '#include <stdint.h>\n#include <stddef.h>\n' | $cc -std=c99 -dM -E - | sort > $dir/before
printf '#include <stdint.h>\n#include <stddef.h>\n#include "peri.h"\n' | $cc -std=c99 -I$dir -dM -E - | sort > $dir/after
! comm -13 $dir/before $dir/after | grep -v '^#define PERI_'
