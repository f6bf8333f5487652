#!/bin/sh
# SPDX-License-Identifier: MIT
# peri_run (tools/run): its readers and decks under sanitizers where there are some, then the program itself. SOURCE OF TRUTH: run_meshes.c
# and run_decks.c say theirs; of the program, README.md: what it writes, and the status and the line that it ends with.
#   check_run.sh PERI_RUN
cd "$(dirname "$0")/.." || exit 1
program=${1:-build/run/peri_run}
dir=build/checks/run
strict="-std=c99 -pedantic -Wall -Wextra -Wconversion -Wshadow -Wundef -Werror"
rm -rf $dir
mkdir -p $dir
sanitize="-g1 -fsanitize=address,undefined -fno-sanitize-recover=all"
echo 'int main(void){return 0;}' | $CC $sanitize -x c - -o $dir/probe 2> /dev/null && $dir/probe || sanitize=""
readers="tools/run/text.c tools/run/cells.c tools/run/gmsh.c tools/run/abaqus.c tools/run/mesh.c"
$CC $strict $sanitize -I. tests/run_meshes.c $readers -o $dir/run_meshes -lm && $dir/run_meshes || exit 1
$CC $strict $sanitize -I. tests/run_decks.c $readers tools/run/deck.c tools/run/scene.c tools/run/loads.c tools/run/result.c build/libperi.a \
    $OPENMP -o $dir/run_decks -lm && $dir/run_decks $dir > $dir/text || { cat $dir/text; exit 1; }
tail -n 1 $dir/text

mkdir $dir/out
$program -q tools/run/decks/bar.txt $dir/out > $dir/bar.text || exit 1
[ "$(grep -c '^probe [ab] point' $dir/bar.text)" -eq 2 ] && [ "$(wc -l < $dir/bar.text)" -eq 2 ] || { cat $dir/bar.text; exit 1; }
[ "$(head -c 8 $dir/out/bar.png | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] || { echo "run: no picture"; exit 1; }
head -n 1 $dir/out/bar.csv | grep -q '^step,time' || { echo "run: no history"; exit 1; }
sed 's/^density.*/density heavy/' tools/run/decks/bar.txt > $dir/bad.txt
$program -q $dir/bad.txt $dir/out > /dev/null 2> $dir/bad.text
[ $? -eq 1 ] && grep -q '^[^:]*bad.txt:10: \[material steel\] density: is not a finite number$' $dir/bad.text || { cat $dir/bad.text; exit 1; }
$program > /dev/null 2>&1
[ $? -eq 2 ] || { echo "run: no deck is no error"; exit 1; }
# every deck is run by run_decks.c, and every section and key of the decks is in the README
for deck in tools/run/decks/*.txt; do
    name=$(basename "$deck" .txt)
    grep -q "run_file(&scene, \"$name\")" tests/run_decks.c || { echo "run: $deck is not tested"; exit 1; }
done
sed 's/#.*//' tools/run/decks/*.txt | awk 'NF { print $1 }' | tr -d '[]' | sort -u | while read -r word; do
    grep -q "\`[^\`]*\b$word\b[^\`]*\`" tools/run/README.md || { echo "run: $word is not in tools/run/README.md"; exit 1; }
done
