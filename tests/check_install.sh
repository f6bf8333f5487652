#!/bin/sh
# SPDX-License-Identifier: MIT
# `make install` into an empty prefix, then examples/hello.c from a folder elsewhere against what is there: by pkg-config, shared and static,
# as the single file, by find_package and by add_subdirectory; `make uninstall` leaves nothing. What a machine lacks is skipped by name.
# SOURCE OF TRUTH: the program has to say of itself that the bar grows by what Hooke's law gives, to 5 %.
set -e
export OMP_NUM_THREADS=1
cd "$(dirname "$0")/.."
root=$PWD
cc=${CC:-cc}
dir=$root/build/checks/install
prefix="$dir/prefix"
rm -rf "$dir"
mkdir -p "$dir/user"
make() { command make --no-print-directory CC="$cc" PREFIX="$prefix" "$@"; }

right() { # right WHAT COMMAND...: the command's two figures agree to 5 %
    what=$1
    shift
    "$@" > "$dir/said"
    sed -n 's/^60 mm grow by \([0-9.]*\) um, by Hooke.s law \([0-9.]*\) um$/\1 \2/p' "$dir/said" |
        awk '{ right = $1 > 0.95 * $2 && $1 < 1.05 * $2 } END { exit !right }' || { echo "$what:"; cat "$dir/said"; exit 1; }
    echo "pass $what"
}

make install > "$dir/log" 2>&1 || { cat "$dir/log"; exit 1; }
library=$prefix/lib/libperi.so
if command -v readelf > /dev/null; then
    named=$(readelf -d "$library" | sed -n 's/.*SONAME.*\[\(.*\)\].*/\1/p')
    [ -e "$prefix/lib/$named" ] && [ "$named" != libperi.so ] || { echo "SONAME \"$named\" is no file of $prefix/lib"; exit 1; }
fi
if command -v nm > /dev/null; then
    nm -D --defined-only "$library" | awk '{print $3}' | grep -v '^peri_[a-z]' > "$dir/foreign" || true
    [ ! -s "$dir/foreign" ] || { echo "exported, but not peri_*:"; cat "$dir/foreign"; exit 1; }
    nm -D --defined-only "$library" | awk '{print $3}' | sort > "$dir/exported"
    sed -n 's/^PERI_API .*[ *]\(peri_[a-z0-9_]*\)(.*/\1/p' peri.h | sort > "$dir/declared"
    diff "$dir/declared" "$dir/exported"
fi

for page in LICENSE README.md docs/manual.md docs/branching.png; do
    cmp "$page" "$prefix/share/doc/peri/$page"
done

# a user's folder, which sees of the library what is installed alone
cd "$dir/user"
sed 's|"../peri.h"|<peri.h>|' "$root/examples/hello.c" > hello.c
if command -v pkg-config > /dev/null; then
    export PKG_CONFIG_PATH="$prefix/lib/pkgconfig"
    $cc -O1 hello.c $(pkg-config --cflags --libs peri) -o shared
    right pkg_config_shared env LD_LIBRARY_PATH="$prefix/lib" ./shared
    if $cc -O1 -static hello.c $(pkg-config --static --cflags --libs peri) -o static 2> log; then
        right pkg_config_static ./static
    elif echo 'int main(void) { return 0; }' | $cc -static $(pkg-config --static --libs-only-other peri) -x c - -o probe 2> /dev/null; then
        cat log
        exit 1
    else
        echo "skip pkg_config_static: no static C library on this machine"
    fi
else
    echo "skip pkg_config_shared, pkg_config_static: no pkg-config on this machine"
fi

# the single file by both of its names, without optimisation and what hello.c has no use of: it links
parts="-DPERI_NO_3D -DPERI_NO_MIXED -DPERI_NO_F32 -DPERI_NO_STATICS -DPERI_NO_ADVICE -DPERI_NO_OUTPUT"
quick=$cc
command -v tcc > /dev/null && quick=tcc # which tells no file its name, besides
for name in peri.h peri/peri.h; do
    printf '#define PERI_IMPLEMENTATION\n#include <%s>\n' $name > single.c
    $quick -O0 $parts -I"$prefix/include" -c single.c -o single.o
    $quick -O0 -I"$prefix/include" hello.c single.o -o single -lm
done
echo "pass single_file"

if command -v cmake > /dev/null; then
    mkdir -p find include
    cat > find/CMakeLists.txt << 'END'
cmake_minimum_required(VERSION 3.13)
project(find LANGUAGES C)
find_package(peri ${WANTED} REQUIRED COMPONENTS peri static)
add_executable(shared ../hello.c)
target_link_libraries(shared peri::peri)
add_executable(static ../hello.c)
target_link_libraries(static peri::static)
END
    case $cc in
    "ccache "*) configure="cmake -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_C_COMPILER=${cc#* }" ;;
    *) configure="cmake -DCMAKE_C_COMPILER=$cc" ;;
    esac
    found() { $configure -S find -B find/build -DCMAKE_PREFIX_PATH="$prefix" "$@" > log 2>&1; }
    version=$(sed -n 's/^.define PERI_VERSION *"\(.*\)"/\1/p' "$root/peri.h")
    found -DWANTED="${version%.*}" && cmake --build find/build > log 2>&1 || { cat log; exit 1; }
    right find_package_shared find/build/shared
    right find_package_static find/build/static
    rm -r find/build
    if found -DWANTED=99.0; then echo "find_package takes $version for 99.0"; exit 1; fi

    # of the tree: small, and without optimisation: so the bar has cells twice as wide
    sed 's|1e-3|2e-3|g; s|{0.099, 0}|{0.098, 0}|; s|4000|1000|; s|8000|2000|; s|2080|540|; s|2020|510|' hello.c > coarse.c
    cat > include/CMakeLists.txt << 'END'
cmake_minimum_required(VERSION 3.13)
project(include LANGUAGES C)
foreach(part 3D MIXED F32 STATICS ADVICE OUTPUT)
  set(PERI_NO_${part} ON)
endforeach()
set(PERI_KERNELS 1)
add_subdirectory(${PERI} peri)
add_executable(hello ../coarse.c)
target_link_libraries(hello peri::peri)
END
    { $configure -S include -B include/build -DPERI="$root" -DCMAKE_C_FLAGS_DEBUG=-O0 -DCMAKE_BUILD_TYPE=Debug &&
        cmake --build include/build; } > log 2>&1 || { cat log; exit 1; }
    right add_subdirectory include/build/hello
else
    echo "skip find_package, add_subdirectory: no cmake on this machine"
fi

cd "$root"
make uninstall
(cd "$prefix" && find . -mindepth 1) > "$dir/left"
[ ! -s "$dir/left" ] || { echo "left by make uninstall:"; cat "$dir/left"; exit 1; }
echo "pass uninstall"
