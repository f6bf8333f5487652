# SPDX-License-Identifier: MIT
# what text cannot do: callbacks return 0, and a cut made after a step is damage
s/^static void (count_break|ramp)\(/static int32_t \1(/
/\+\+breaks;/a\
    return 0;
/value\[k\] \*= factor;/a\
    return 0;
/after a step/s/PERI_CUT_INITIAL/PERI_CUT_NOW/
