#!/bin/sh
# SPDX-License-Identifier: MIT
# Programs of 0.1 (tests/migrate/*.c) through tools/migrate.sed and their edits by hand (the .sed beside each), as docs/migration.md tells
# users to do it: they must compile under the strict warnings, link, and find of themselves that they are right.
# SOURCE OF TRUTH: the programs compile, run and end with 0 under 0.1.0; what each checks is Hooke's law, or what peri.h says of counts.
set -e
cc=${CC:-cc}
dir=build/checks/migrate
strict="-std=c99 -pedantic -Wall -Wextra -Wconversion -Wshadow -Wundef -Werror"
echo x | sed -E 's/\bx\b/y/' | grep -q y || { echo "skip: this sed has no \\b"; exit 0; }
rm -rf $dir
mkdir -p $dir
cp tests/migrate/*.c $dir
printf 'void pull(peri_body *b, int32_t s, double *n, double *v) { peri_apply_surface_traction(b, s, 1, n, (v), NULL, NULL); }\n' > $dir/one.c
printf '    peri_apply_traction(body,\n                        one(two(body), 1), 1, v, NULL, NULL);\n' > $dir/lines.c
sed -E -i -f tools/migrate.sed $dir/*.c
grep -q 'peri_apply_traction(b' $dir/one.c && grep -q 'peri_apply_layer_traction(body' $dir/lines.c || { echo "tractions: $dir/one.c, lines.c"; exit 1; }

# a second run changes nothing, says so of every file, and leaves programs of 0.2 alone
mkdir $dir/twice
cp $dir/*.c examples/*.c $dir/twice
sed -E -i -f tools/migrate.sed $dir/twice/*.c 2> $dir/twice/said
for file in $dir/*.c; do cmp "$file" "$dir/twice/$(basename "$file")"; done
for file in examples/*.c; do cmp "$file" "$dir/twice/$(basename "$file")"; done
[ "$(grep -c 'left alone' $dir/twice/said)" -eq "$(ls $dir/twice/*.c | wc -l)" ] || { echo "migrate.sed: second run:"; cat $dir/twice/said; exit 1; }

for edits in tests/migrate/*.sed; do
    name=$(basename "$edits" .sed)
    cp "$dir/$name.c" "$dir/$name.text"
    sed -E -i -f "$edits" "$dir/$name.c"
    if cmp -s "$dir/$name.c" "$dir/$name.text"; then echo "$edits: changes nothing"; exit 1; fi
    $cc $strict -O0 -I. "$dir/$name.c" build/libperi.a ${OPENMP--fopenmp} -lm -o "$dir/$name"
    "$dir/$name" || { echo "$name: ends with $?"; exit 1; }
done

# the tables of docs/migration.md say what the script does, and its second program is what comes of the first
sed -nE 's/^\| `((peri|PERI)_\w+)` \| `(\w+)` \|$/\1 \3/p' docs/migration.md > $dir/names
[ "$(wc -l < $dir/names)" -ge 90 ] || { echo "docs/migration.md: few names"; exit 1; }
cut -d ' ' -f 1 $dir/names | sed -E -f tools/migrate.sed > $dir/renamed
cut -d ' ' -f 2 $dir/names | diff $dir/renamed - || { echo "docs/migration.md: names differ from tools/migrate.sed"; exit 1; }
grep -v SPDX-License $dir/short.c > $dir/after
awk '/^<!-- after -->/ { after = 1; next } /^```/ { inside = after && !inside; if (!inside) after = 0; next } inside' docs/migration.md |
    diff - $dir/after || { echo "docs/migration.md: the program after"; exit 1; }
