#!/bin/sh
# SPDX-License-Identifier: MIT
# install.sh - puts the built library into DESTDIR/PREFIX, or with --remove takes the same files away: `make install`, `make uninstall`.
# For systems with ELF libraries (Linux, the BSDs); CMakeLists.txt serves the others, too. Takes CC, OPENMP, VERSION, PREFIX, INCLUDEDIR,
# LIBDIR, DOCDIR and DESTDIR from the environment.
#
#   INCLUDEDIR/peri.h         the declarations; with PERI_IMPLEMENTATION it includes the single file
#   INCLUDEDIR/peri/peri.h    the single file. It includes itself, by a name that only some compilers tell it: "peri.h" serves all
#   LIBDIR                    libperi.a, libperi.so.VERSION and its links, pkgconfig/peri.pc, cmake/peri
#   DOCDIR                    licence, changes, README.md and docs, in the folders that their links expect
set -e
cd "$(dirname "$0")/.."
remove=""
[ "$1" != --remove ] || remove=yes
abi=${VERSION%.*} # before 1.0 the minor version is the interface
made=build/install

put() { # put MODE SOURCE TARGET
    if [ -n "$remove" ]; then
        rm -f "$DESTDIR$3"
    else
        install -d "$(dirname "$DESTDIR$3")"
        install -m "$1" "$2" "$DESTDIR$3"
    fi
}

link() { # link TO TARGET
    rm -f "$DESTDIR$2"
    [ -n "$remove" ] || ln -s "$1" "$DESTDIR$2"
}

for folder in "$PREFIX" "$INCLUDEDIR" "$LIBDIR" "$DOCDIR"; do
    case "$folder" in
    /*) ;;
    *) echo "install: \"$folder\" is not an absolute path"; exit 1 ;;
    esac
done

# below PREFIX, paths are written relative to it: the tree may be moved as a whole
under() { # under BASE PATH: PATH, or BASE/... where it lies below PREFIX
    case "$2" in
    "$PREFIX"/*) echo "$1${2#"$PREFIX"}" ;;
    *) echo "$2" ;;
    esac
}
up=$(echo "$LIBDIR/cmake/peri" | sed "s|^$PREFIX/||; s|[^/]*[^/]|..|g")
case "$LIBDIR" in "$PREFIX"/*) ;; *) up=$PREFIX ;; esac

fill() { # fill TEMPLATE: its text with the values of this build
    sed -e "s|@PERI_VERSION@|$VERSION|g; s|@PERI_VERSION_MAJOR@|${VERSION%%.*}|g; s|@PERI_ABI@|$abi|g; s|@PERI_POINTER@|$pointer|g" \
        -e "s|@PERI_PREFIX@|$PREFIX|; s|@PERI_INCLUDEDIR@|$(under "\${prefix}" "$INCLUDEDIR")|" \
        -e "s|@PERI_LIBDIR@|$(under "\${prefix}" "$LIBDIR")|; s|@PERI_INCLUDE_FROM_HERE@|$(under "$up" "$INCLUDEDIR")|" \
        -e "s|@PERI_PRIVATE_LIBS@|${OPENMP:+$OPENMP }-lm|; s|@PERI_PRIVATE_LIST@|${OPENMP:+$OPENMP;}m|" "$1"
}

if [ -z "$remove" ]; then
    mkdir -p $made
    pointer=$(echo __SIZEOF_POINTER__ | $CC -E -P -)
    sed 's|^#include "peri_impl.c"$|#include "peri/peri.h"|' peri.h > $made/peri.h
    grep -q '^#include "peri/peri.h"$' $made/peri.h || { echo "install: peri.h has no line #include \"peri_impl.c\""; exit 1; }
    for template in cmake/peri*.in; do fill "$template" > "$made/$(basename "$template" .in)"; done
fi

put 644 $made/peri.h "$INCLUDEDIR/peri.h"
put 644 build/dist/peri.h "$INCLUDEDIR/peri/peri.h"
put 644 build/libperi.a "$LIBDIR/libperi.a"
put 755 build/libperi.so "$LIBDIR/libperi.so.$VERSION"
link "libperi.so.$VERSION" "$LIBDIR/libperi.so.$abi"
link "libperi.so.$abi" "$LIBDIR/libperi.so"
put 644 $made/peri.pc "$LIBDIR/pkgconfig/peri.pc"
put 644 cmake/periConfig.cmake "$LIBDIR/cmake/peri/periConfig.cmake"
put 644 $made/periConfigVersion.cmake "$LIBDIR/cmake/peri/periConfigVersion.cmake"
put 644 $made/periTargets.cmake "$LIBDIR/cmake/peri/periTargets.cmake"
for page in LICENSE README.md CHANGELOG.md docs/*.md docs/*.png; do
    [ ! -f "$page" ] || put 644 "$page" "$DOCDIR/$page"
done

if [ -n "$remove" ]; then # folders that are empty now; PREFIX itself and those of the system stay
    empty() { rmdir "$DESTDIR$1" 2> /dev/null || true; }
    for folder in "$INCLUDEDIR/peri" "$LIBDIR/cmake/peri" "$LIBDIR/cmake" "$LIBDIR/pkgconfig" "$DOCDIR/docs" "$DOCDIR"; do empty "$folder"; done
    case "$PREFIX" in
    /|/usr|/usr/local) ;;
    *) for folder in "$INCLUDEDIR" "$LIBDIR" "$(dirname "$DOCDIR")" "$PREFIX/share"; do empty "$folder"; done ;;
    esac
else
    if [ -z "$DESTDIR" ]; then
        case "$LIBDIR" in # the loader finds libraries of the system by a table
        /lib*|/usr/lib*|/usr/local/lib*) [ "$(id -u)" -ne 0 ] || ldconfig 2> /dev/null || true ;;
        esac
    fi
    echo "installed peri $VERSION to $DESTDIR$PREFIX; PKG_CONFIG_PATH=$LIBDIR/pkgconfig"
fi
