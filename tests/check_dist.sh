#!/bin/sh
# The single-file header: generated twice alike, self-contained, the same tokens as the tree, only peri_ names exported, no state, only PERI
# macros left defined.
set -e
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

# what the compiler sees, line marks aside: then the machine code is the same under any flags
tokens() { $cc -std=c99 -E -P "$@" > $dir/tokens; }
tokens peri_impl.c
mv $dir/tokens $dir/tree
for header in peri.h $file; do
    tokens -DPERI_IMPLEMENTATION -x c $header
    cmp $dir/tokens $dir/tree
done

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
