#!/bin/sh
# SPDX-License-Identifier: MIT
# Bindings: those in the repository are what peri.h says and lack none of its names; each runs the scenes of bindings/scenes.md, and what is
# its own (errors, exceptions through callbacks, views), and prints what C prints; structs have the sizes and offsets of C, there and on
# other targets; a field and a function that are added to a copy of peri.h come to all of them. What a machine lacks is skipped by name.
# SOURCE OF TRUTH: tests/binding_scenes.c, and the C compiler for layouts.
#   test_bindings.sh          after make lib
#   test_bindings.sh --long   also Rust, Fortran and Go, the examples, cargo, clang++, C++20, sanitizers
cd "$(dirname "$0")/.." || exit 1
root=$PWD
dir=build/checks/bindings
status=0
CC=${CC:-cc}
strict="-pedantic -Wall -Wextra -Wconversion -Wshadow -Werror"
glass="16000 points, 268 steps, 1967 bonds broken"
mkdir -p $dir
# the scenes are small: more threads cost more than they give
OMP_NUM_THREADS=1
export OMP_NUM_THREADS
command -v python3 > /dev/null || { echo "bindings: no python3, skipped"; exit 0; }

bad() { echo "bindings: $*"; status=1; }
has() { command -v "$1" > /dev/null || { echo "bindings: no $1, skipped"; return 1; }; }

python3 tools/api.py --check || status=1
python3 tools/bind.py --check || status=1

# ---- the scenes
$CC -std=c99 -O0 -I. tests/binding_scenes.c build/libperi.a -o $dir/scenes_c $OPENMP -lm && $dir/scenes_c > $dir/c.text || bad "the scenes in C"
[ "$(wc -l < $dir/c.text)" -ge 50 ] || bad "only $(wc -l < $dir/c.text) lines of C"
same() { # same NAME: the lines of $dir/NAME.text are those of C; numbers may be written otherwise
    awk -v name="$1" 'function upper(t) { return toupper(t) }
        NR == FNR { key[FNR] = $1; value[FNR] = $2; lines = FNR; next }
        { k = FNR; if ($1 != key[k]) { print "bindings: " name ": " $1 " instead of " key[k]; bad = 1; exit }
          if (upper($2) != upper(value[k]) && !($2 ~ /[.]/ && $2 + 0 == value[k] + 0)) {
              print "bindings: " name ": " $1 " is " $2 ", in C " value[k]; bad = 1 } }
        END { if (!bad && k != lines) { print "bindings: " name ": " k + 0 " lines instead of " lines; bad = 1 } exit bad }' \
        $dir/c.text "$dir/$1.text" || status=1
}

python3 tools/bind.py --sizes $dir || bad "sizes"
$CC -std=c99 -I. $dir/sizes.c -o $dir/sizes && $dir/sizes > $dir/sizes.text || bad "sizes in C"
python3 - << 'END' || bad "julia: blocks or brackets do not close"
import re, sys
text = re.sub(r'\"\"\".*?\"\"\"|\"(?:\\.|[^\"\\\n])*\"|#[^\n]*', "", open("bindings/julia/Peri.jl", encoding="utf-8").read(), flags=re.S)
opened = len(re.findall(r"(?<![:.\w])(?:function|(?:mutable )?struct|if|try|let|for|while|do|begin|module)(?![\w!])", text))
closed = len(re.findall(r"(?<![:.\w])end(?![\w!])", text))
brackets = [text.count(a) - text.count(b) for a, b in ("()", "[]", "{}")]
sys.exit(opened != closed or any(brackets) or opened < 150)
END
cmp -s $dir/sizes.jl $dir/sizes.text || bad "julia: other sizes or offsets than C"

if has g++; then
    g++ -std=c++11 $strict -I. -Ibindings/cpp tests/bindings/scenes.cpp build/libperi.a -o $dir/scenes_cpp $OPENMP -lm &&
        $dir/scenes_cpp > $dir/cpp.text && same cpp || bad "C++"
fi
if has luajit; then
    (PERI=$root/build/libperi.so LUA_PATH="$root/bindings/lua/?.lua" && export PERI LUA_PATH && luajit tests/bindings/scenes.lua > $dir/lua.text &&
        luajit $dir/sizes.lua | cmp -s - $dir/sizes.text) && same lua || bad "lua"
fi
if [ "$1" = --long ] && has rustc; then
    out="--out-dir $dir --edition 2021"
    link=$(case $OPENMP in *fopenmp*) echo "-l gomp" ;; esac)
    rustc --crate-type rlib --crate-name peri_sys bindings/rust/peri-sys/src/lib.rs $out -D warnings &&
        rustc --crate-type rlib --crate-name peri bindings/rust/peri/src/lib.rs --extern peri_sys=$dir/libperi_sys.rlib $out -D warnings &&
        rustc --crate-name scenes_rs tests/bindings/scenes.rs --extern peri=$dir/libperi.rlib -L $dir -L build -l static=peri $link -l m \
            $out -D warnings &&
        rustc --crate-name sizes_rs $dir/sizes.rs --extern peri_sys=$dir/libperi_sys.rlib $out &&
        $dir/scenes_rs > $dir/rust.text && $dir/sizes_rs | cmp -s - $dir/sizes.text && same rust || bad "rust"
fi
if [ "$1" = --long ] && has gfortran; then
    gfortran -std=f2008 -Wall -Wextra -Werror -O0 -J $dir -c bindings/fortran/peri.f90 -o $dir/peri_f90.o &&
        gfortran -std=f2008 -Wall -Wextra -Werror -O0 -J $dir tests/bindings/scenes.f90 $dir/peri_f90.o build/libperi.a -o $dir/scenes_f90 \
            $OPENMP -lm &&
        gfortran -ffree-line-length-none -O0 -I $dir $dir/sizes.f90 $dir/peri_f90.o build/libperi.a -o $dir/sizes_f90 $OPENMP -lm &&
        $dir/scenes_f90 > $dir/fortran.text && $dir/sizes_f90 | cmp -s - $dir/sizes.text && same fortran || bad "fortran"
fi
if [ "$1" = --long ] && has go && has gcc; then
    [ -z "$(gofmt -l bindings/go)" ] || bad "gofmt"
    (cd bindings/go && GOFLAGS=-mod=mod GOCACHE=$root/build/go CC=gcc go build -o "$root/$dir/glass_go" .) && $dir/glass_go > $dir/go.text &&
        grep -qx "$glass" $dir/go.text && grep -qx "$(grep '^glass.kinetic ' $dir/c.text)" $dir/go.text && grep -qx "glass.frames 6" $dir/go.text ||
        bad "go"
fi
command -v julia > /dev/null && { PERI=$root/build/libperi.so julia bindings/julia/glass.jl | grep -qx "$glass" || bad "julia"; }

# ---- layouts by the rules of C, which bindings without a compiler use, on other targets
if has clang; then
    for target in x86-64:x86_64-linux-gnu i386:i386-linux-gnu aarch64:aarch64-linux-gnu wasm32:wasm32-unknown-unknown; do
        clang -target ${target##*:} -ffreestanding -I. -fsyntax-only $dir/${target%%:*}.c || bad "layout of $target"
    done
fi

# ---- what is added to peri.h comes to all of them
copy=$dir/copy
rm -rf $copy
mkdir -p $copy/bindings
cp -r tools $copy
awk '{ print }
    /^    int32_t ledger; / { print "    double added_field; /* [L] > 0. Default 1 */" }
    /^PERI_API int32_t peri_reset\(/ { print "\n/* Adds numbers[count] to what is there. */"
        print "PERI_API int32_t peri_added_function(peri_body *body, int64_t count, const double *numbers);" }' peri.h > $copy/peri.h
python3 $copy/tools/api.py && python3 $copy/tools/bind.py && python3 $copy/tools/bind.py --check || bad "make bindings on a copy"
for file in $(python3 tools/bind.py --list); do
    case $file in *.hpp) names=added_function ;; */peri-sys/*) names="added_field added_function" ;; *) names="added_field added_function" ;; esac
    for name in $names; do grep -q "$name" "$copy/$file" || bad "$file: no $name"; done
    python3 - "$file" "$copy/$file" << 'END' || status=1
import difflib, sys
old, new = (open(f, encoding="utf-8").read().splitlines() for f in sys.argv[1:])
lost = [d for d in difflib.unified_diff(old, new, lineterm="", n=0) if d.startswith("-") and not d.startswith("---")]
if lost:
    print("bindings: %s: what is added changes other lines, too: %s" % (sys.argv[1], lost[0]))
    sys.exit(1)
END
done
echo '#include "peri.hpp"
int main() { peri::body_desc d; d.added_field = 2; (void)&peri::body::added_function; return 0; }' > $copy/user.cpp
! command -v g++ > /dev/null || g++ -std=c++11 $strict -I$copy -I$copy/bindings/cpp -fsyntax-only $copy/user.cpp || bad "C++ of the copy"

[ "$1" = --long ] || exit $status

# ---- the examples; other compilers
ran() { # ran NAME COMMAND: prints what the glass program prints
    name=$1
    shift
    "$@" | grep -qx "$glass" || bad "$name"
}
if command -v g++ > /dev/null; then
    g++ -std=c++11 $strict -O0 -I. -Ibindings/cpp bindings/cpp/glass.cpp build/libperi.a -o $dir/glass_cpp $OPENMP -lm && ran glass.cpp $dir/glass_cpp
    g++ -std=c++11 -g1 -fsanitize=address,undefined -I. -Ibindings/cpp tests/bindings/scenes.cpp build/libperi.a -o $dir/scenes_san $OPENMP -lm &&
        $dir/scenes_san > $dir/san.text && same san || bad "C++ under sanitizers"
    g++ -std=c++20 $strict -I. -Ibindings/cpp -fsyntax-only tests/bindings/scenes.cpp || bad "C++20"
fi
if has clang++; then
    clang++ -std=c++11 $strict -I. -Ibindings/cpp -fsyntax-only tests/bindings/scenes.cpp || bad "clang++"
fi
if command -v luajit > /dev/null; then
    PERI=$root/build/libperi.so LUA_PATH="$root/bindings/lua/?.lua" ran glass.lua luajit bindings/lua/glass.lua
fi
if command -v gfortran > /dev/null; then
    gfortran -std=f2008 -Wall -I $dir bindings/fortran/glass.f90 $dir/peri_f90.o build/libperi.a -o $dir/glass_f90 $OPENMP -lm &&
        ran glass.f90 $dir/glass_f90
fi
if has cargo; then
    (cd bindings/rust && CARGO_TARGET_DIR=$root/build/cargo cargo run --offline -q --example glass | grep -qx "$glass") || bad "cargo"
fi
for file in bindings/*/glass.* bindings/rust/peri/examples/glass.rs; do
    case $file in */go/*) continue ;; esac # an example of cgo, not of a binding
    lines=$(grep -vc '^ *\(//\|--\|#\|!\)' "$file")
    [ "$lines" -lt 30 ] || bad "$file: $lines lines"
done
exit $status
