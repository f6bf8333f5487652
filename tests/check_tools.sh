#!/bin/sh
# SPDX-License-Identifier: MIT
# Tools that read headers see all of peri.h as it stands: ctags, cffi (less its lines of the preprocessor), bindgen; what a machine lacks is
# skipped. SOURCE OF TRUTH: the names in peri.h, found line by line: functions, structs, enumerators, types of callbacks.
cd "$(dirname "$0")/.." || exit 1
dir=build/checks/tools
status=0
rm -rf $dir
mkdir -p $dir
awk '
/^PERI_API/ && match($0, /peri_[a-z0-9_]+\(/) { print substr($0, RSTART, RLENGTH - 1) }
/^typedef (struct|enum) peri_/ { print $3 }
/^typedef .*\(\*peri_[a-z_]+_fn\)/ { match($0, /peri_[a-z_]+_fn/); print substr($0, RSTART, RLENGTH) }
/^ *(enum \{ )?PERI_[A-Z0-9_]+ = / { match($0, /PERI_[A-Z0-9_]+/); print substr($0, RSTART, RLENGTH) }
' peri.h | sort -u > $dir/names
[ "$(wc -l < $dir/names)" -gt 280 ] || { echo "tools: only $(wc -l < $dir/names) names in peri.h"; exit 1; }

compare() { # compare TOOL: all names are among those of $dir/TOOL
    sort -u $dir/"$1" | comm -23 $dir/names - > $dir/missing
    [ ! -s $dir/missing ] || { echo "tools: $1 misses $(wc -l < $dir/missing): $(head -5 $dir/missing | tr '\n' ' ')"; status=1; }
    echo "tools: $1 was asked for $(wc -l < $dir/names) names"
}

if command -v ctags > /dev/null; then
    ctags --language-force=C --c-kinds=+p -I PERI_API -f - peri.h > $dir/tags 2> /dev/null && cut -f 1 $dir/tags > $dir/ctags && compare ctags
else
    echo "tools: no ctags, skipped"
fi
for python in python3 /usr/bin/python3 none; do $python -c 'import cffi' 2> /dev/null && break; done
if [ $python != none ]; then
    $python - build/libperi.so > $dir/cffi << 'END' || { echo "tools: cffi failed"; status=1; }
import re, sys, cffi
text = open("peri.h").read()
text = re.sub(r"(?m)^#ifdef __cplusplus\n.*\n#endif\n", "", text)   # extern "C" and its brace
text = re.sub(r"(?m)^#.*\n", "", text).replace("PERI_API ", "")
ffi = cffi.FFI()
ffi.cdef(text)
lib = ffi.dlopen(sys.argv[1])
assert lib.peri_version() == 2000 and lib.PERI_ALL == 0x10000000 and lib.PERI_ERROR_ID_BODY == -11
typedefs, structs, _ = ffi.list_types()
print("\n".join(typedefs + structs + dir(lib)))
desc = ffi.new("peri_body_desc *")
lib.peri_body_desc_init(desc)
assert (desc.precision, desc.thickness) == (lib.PERI_PRECISION_DOUBLE, 1)
END
    compare cffi
else
    echo "tools: no cffi, skipped"
fi
if command -v bindgen > /dev/null; then
    bindgen --no-layout-tests peri.h -o $dir/peri.rs 2> $dir/bindgen.log || { echo "tools: bindgen: $(head -1 $dir/bindgen.log)"; status=1; }
    grep -oE '\b(peri|PERI)_[A-Za-z0-9_]+' $dir/peri.rs | sed -E 's/^peri_[a-z_]+_(PERI_)/\1/' > $dir/bindgen
    compare bindgen
else
    echo "tools: no bindgen, skipped"
fi
exit $status
