# SPDX-License-Identifier: MIT
# what text cannot do: callbacks return 0 and write their value; ids in arrays; statuses that were split; materials are numbered from 1
s/^    peri_add_plane_obstacle\(ball, place, normal, 0, floor_at, &speed\);/    peri_obstacle_desc ground;\n    peri_obstacle_desc_init(\&ground, PERI_SHAPE_PLANE);\n    ground.place[2] = place[2];\n    ground.normal[2] = normal[2];\n    ground.motion = floor_at;\n    ground.user = \&speed;\n    peri_add_obstacle(ball, \&ground);/
s/^static double weight\(void \*user, double q\)/static int32_t weight(void *user, double q, double *w)/
s/return q < 1 \? 1 - q : 0;/*w = q < 1 ? 1 - q : 0;\n    return 0;/
s/^static void floor_at\((.*)\) \{ (.*) \}/static int32_t floor_at(\1, double *turn) {\n    (void)turn;\n    \2\n    return 0;\n}/
s/^    const int32_t materials\[2\] = \{1, 1\};/    int32_t materials[2];/
s/(peri_select_points\(ball, NULL, 0, materials\) != PERI_ERROR_)SET/\1EMPTY/
s/(peri_find_set\(ball, "rim"\) != PERI_ERROR_)SET/\1NAME/
s/PERI_ERROR_ID\b/PERI_ERROR_ID_NONE/
/m\.bulk = 2;/{
n
s/^    peri_add_material\(ball, &m\);/    materials[0] = materials[1] = peri_add_material(ball, \&m);/
}
s/first == 0 && last == 1/last == first + 1/
