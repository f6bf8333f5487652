/* damage.c */
#include "extremes.h"

static outcome lone(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    peri_body_desc d;
    peri_body *b = NULL;
    extreme_desc(&d, (int32_t)row->value, precision, 3);
    if (!extreme_fails(&o, NULL, peri_body_create(&d, &b, NULL))) (void)extreme_fails(&o, b, peri_build(b));
    return extreme_end(o, b);
}

static const extreme rows[] = {
    {"no point", "peri.h", lone, PERI_SOLID, 0, 0, PERI_ERROR_MATERIAL, NULL, {0, 0, 0}},
};
const extreme_table extreme_damage = EXTREME_TABLE("damage", rows);
