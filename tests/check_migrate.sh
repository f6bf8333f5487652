#!/bin/sh
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
sed -E -i -f tools/migrate.sed $dir/*.c
for edits in tests/migrate/*.sed; do
    name=$(basename "$edits" .sed)
    cp "$dir/$name.c" "$dir/$name.text"
    sed -E -i -f "$edits" "$dir/$name.c"
    if cmp -s "$dir/$name.c" "$dir/$name.text"; then echo "$edits: changes nothing"; exit 1; fi
    $cc $strict -O0 -I. "$dir/$name.c" build/libperi.a ${OPENMP:--fopenmp} -lm -o "$dir/$name"
    "$dir/$name" || { echo "$name: ends with $?"; exit 1; }
done
