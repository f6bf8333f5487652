# SPDX-License-Identifier: MIT
# what text cannot do: the callback returns 0, the cut is damage, and the id is kept
s/^static void pull\(/static int32_t pull(/
/value\[2 \* k\] = time;/a\
    return 0;
s/^    peri_add_material\(b, &m\);/    const int32_t rubber = peri_add_material(b, \&m);/
s/peri_id\(b, PERI_KIND_MATERIAL, 0 \+ 1\)/rubber/
s/PERI_CUT_INITIAL/PERI_CUT_NOW/
