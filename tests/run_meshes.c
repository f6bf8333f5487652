/* SPDX-License-Identifier: MIT */
/* run_meshes.c - the readers of tools/run: Gmsh 2 and 4.1, Abaqus, Peridigm and LAMMPS.

   SOURCE OF TRUTH: the geometry of the cells, worked out by hand: areas, volumes and centroids of triangles, rectangles, and of hexahedra
   of which the height is a bilinear function (the volume under it is its mean over the corners); determinants of affine maps; and who is in
   a set by the text of the file. Built and run by tests/check_run.sh, under sanitizers where there are some. */
#include "../tools/run/run.h"
#include "peri_test.h"

#define HEAD_2 "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
#define SQUARES "1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n"

/* [0,2] x [0,1]: a square and two triangles */
static const char gmsh_2[] = HEAD_2 "$PhysicalNames\n3\n1 7 \"left edge\"\n2 1 \"square\"\n2 2 \"rest\"\n$EndPhysicalNames\n"
    "$Nodes\n6\n" SQUARES "$EndNodes\n$Elements\n5\n1 1 2 7 1 1 4\n2 1 2 8 2 3 6\n3 3 2 1 1 1 2 5 4\n"
    "4 2 2 2 2 2 3 6\n5 2 2 2 2 2 6 5\n"
    "$EndElements\n";
static const char gmsh_4[] = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 7 \"left edge\"\n2 1 \"square\"\n2 2 \"rest\"\n"
    "$EndPhysicalNames\n$Entities\n1 2 2 0\n1 0 0 0 0\n1 0 0 0 0 1 0 1 7 0\n2 2 0 0 2 1 0 1 8 0\n1 0 0 0 1 1 0 1 1 0\n"
    "2 1 0 0 2 1 0 1 2 0\n$EndEntities\n$Nodes\n2 6 1 6\n2 1 0 4\n1\n2\n5\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 2 0 2\n3\n6\n2 0 0\n2 1 0\n"
    "$EndNodes\n$Elements\n4 5 1 5\n1 1 1 1\n1 1 4\n1 2 1 1\n2 3 6\n2 1 3 1\n3 1 2 5 4\n2 2 2 2\n"
    "4 2 3 6\n5 2 6 5\n$EndElements\n";
static const char abaqus_2[] = "*Heading\n a plate, not a mesh: 1, 2\n** a remark\n*Part, name=Plate\n*Node, nset = every\n1, 0., 0.\n"
    "2, 1., 0.\n3, 2., 0.\n4, 0., 1.\n5, 1., 1.\n6, 2., 1.\n"
    "*Element, type=CPS4R, elset=square\n3, 1, 2, 5,\n 4\n*ELEMENT, TYPE=CPS3, ELSET=rest\n"
    "4, 2, 3, 6\n5, 2, 6, 5\n*Nset, nset=\"left edge\"\n1, 4\n*Nset, nset=group_8, generate\n3, 6, 3\n*Elset, elset=both\nsquare, rest\n"
    "*End Part\n*Material, name=steel\n*Elastic\n2e11, 0.3\n";
static const char peridigm[] = "# x y z block volume\n0.5 0.5 0 1 1\n\n1.5 0.25 0 2 0.5 # a remark\n1.25 0.75 0 2 0.5\n";
static const char lammps[] = "LAMMPS data file\n\n3 atoms\n2 atom types\n0 2 xlo xhi\n0 1 ylo yhi\n\nMasses\n\n1 1.0\n2 1.0\n\n"
    "Atoms # peri\n\n1 1 1 2200 0.5 0.5 0\n2 2 0.5 2200 1.5 0.25 0 0 0 0\n"
    "3 2 0.5 2200 1.25 0.75 0\n\nVelocities\n\n1 0 0 0\n2 0 0 0\n3 0 0 0\n";

static int read_from(const char *bytes, size_t size, int format, int dim, run_cloud *cloud, run_fault *fault) {
    run_text text;
    int      result;
    memset(cloud, 0, sizeof *cloud);
    fault->text[0] = 0;
    result = run_text_of(&text, bytes, size, "mesh", fault);
    if (result == 0) result = run_read_cloud(&text, format, dim, cloud);
    run_text_close(&text);
    return result;
}

static int read_text(const char *bytes, int format, int dim, run_cloud *cloud) {
    run_fault fault;
    const int result = read_from(bytes, strlen(bytes), format, dim, cloud, &fault);
    if (result < 0) printf("    %s\n", fault.text);
    CHECK(result == 0);
    return result;
}

static void check_set(run_cloud *cloud, const char *name, int count, int first, int second) {
    const run_set *set = run_find_set(cloud, name);
    CHECK(set != NULL && set->count == count && (count < 1 || set->points[0] == first) && (count < 2 || set->points[1] == second));
}

static double sum(const run_cloud *cloud) {
    double  total = 0;
    int64_t k;
    for (k = 0; k < cloud->count; ++k) total += cloud->volume[k];
    return total;
}

/* The square [0,1]^2 and the triangles (1,0) (2,0) (2,1) and (1,0) (2,1) (1,1) of either format. */
static void check_squares(run_cloud *cloud) {
    static const double want[3][3] = {{0.5, 0.5, 1}, {5.0 / 3, 1.0 / 3, 0.5}, {4.0 / 3, 2.0 / 3, 0.5}};
    int k;
    CHECK(cloud->count == 3);
    for (k = 0; k < 3 && cloud->count == 3; ++k) {
        CHECK_NEAR(cloud->place[3 * k], want[k][0], 1e-14, 0);
        CHECK_NEAR(cloud->place[3 * k + 1], want[k][1], 1e-14, 0);
        CHECK_NEAR(cloud->volume[k], want[k][2], 1e-14, 0);
    }
    check_set(cloud, "square", 1, 0, 0);
    check_set(cloud, "rest", 2, 1, 2);
}

static void gmsh_in_the_plane(void) {
    const char *const texts[2] = {gmsh_2, gmsh_4};
    run_cloud cloud;
    int       k;
    for (k = 0; k < 2; ++k) {
        if (read_text(texts[k], RUN_FORMAT_GMSH, 2, &cloud) == 0) {
            check_squares(&cloud);
            check_set(&cloud, "left_edge", 1, 0, 0); /* the cells that have the line as a side */
            check_set(&cloud, "group_8", 1, 1, 0);
            CHECK(cloud.sets == 4);
        }
        run_free_cloud(&cloud);
    }
}

static void abaqus_in_the_plane(void) {
    run_cloud cloud;
    if (read_text(abaqus_2, RUN_FORMAT_ABAQUS, 2, &cloud) == 0) {
        check_squares(&cloud);
        check_set(&cloud, "left edge", 1, 0, 0);
        check_set(&cloud, "group_8", 2, 1, 2); /* the cells that have one of the nodes */
        check_set(&cloud, "both", 3, 0, 1);
        check_set(&cloud, "every", 3, 0, 1);
    }
    run_free_cloud(&cloud);
}

static void clouds_as_they_are(void) {
    run_cloud cloud;
    if (read_text(peridigm, RUN_FORMAT_PERIDIGM, 2, &cloud) == 0) {
        CHECK(cloud.count == 3 && cloud.place[3] == 1.5 && cloud.place[7] == 0.75 && cloud.volume[2] == 0.5);
        check_set(&cloud, "block_1", 1, 0, 0);
        check_set(&cloud, "block_2", 2, 1, 2);
    }
    run_free_cloud(&cloud);
    if (read_text(lammps, RUN_FORMAT_LAMMPS, 3, &cloud) == 0) {
        CHECK(cloud.count == 3 && cloud.place[3] == 1.5 && cloud.place[7] == 0.75 && cloud.volume[0] == 1 && cloud.volume[2] == 0.5);
        check_set(&cloud, "type_2", 2, 1, 2);
    }
    run_free_cloud(&cloud);
}

/* One cell of each shape, at an offset where sums of products of coordinates would lose digits. */
static void one_cell(const char *type, int corners, const double (*x)[3], double volume, const double *centroid) {
    char      text[2000];
    size_t    at = (size_t)snprintf(text, sizeof text, "*NODE\n");
    run_cloud cloud;
    int       k;
    for (k = 0; k < corners; ++k)
        at += (size_t)snprintf(text + at, sizeof text - at, "%d, %.17g, %.17g, %.17g\n", 10 * k + 3,
                               x[k][0] + 1000, x[k][1] - 500, x[k][2]);
    at += (size_t)snprintf(text + at, sizeof text - at, "*ELEMENT, TYPE=%s\n77", type);
    for (k = 0; k < corners; ++k) at += (size_t)snprintf(text + at, sizeof text - at, ", %d", 10 * k + 3);
    if (read_text(text, RUN_FORMAT_ABAQUS, 3, &cloud) == 0) {
        CHECK(cloud.count == 1);
        CHECK_NEAR(cloud.volume[0], volume, 1e-12, 0);
        for (k = 0; k < 3 && centroid != NULL; ++k) CHECK_NEAR(cloud.place[k], centroid[k] + (k == 0 ? 1000 : k == 1 ? -500 : 0), 0, 1e-11);
    }
    run_free_cloud(&cloud);
}

static void volumes_of_solids(void) {
    static const double box[8][3] = {{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {0, 0, 5}, {2, 0, 5}, {2, 3, 5}, {0, 3, 5}};
    static const double box_middle[3] = {1, 1.5, 2.5};
    static const double raised[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1.8}, {0, 1, 1}};
    static const double sheared[8][3] = {{0, 0, 0},     {1, 0, 0},     {1.3, 1, 0},   {0.3, 1, 0},
                                         {0.2, 0.4, 1}, {1.2, 0.4, 1}, {1.5, 1.4, 1}, {0.5, 1.4, 1}};
    static const double sheared_middle[3] = {0.75, 0.7, 0.5};
    static const double tetrahedron[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}, tetrahedron_middle[3] = {0.25, 0.5, 0.75};
    static const double wedge[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 4}, {1, 0, 4}, {0, 1, 4}};
    static const double wedge_middle[3] = {1.0 / 3, 1.0 / 3, 2};
    static const double pyramid[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 3}}, pyramid_middle[3] = {0.5, 0.5, 0.75};
    static const double inverted[4][3] = {{0, 0, 0}, {0, 2, 0}, {1, 0, 0}, {0, 0, 3}};
    one_cell("C3D8R", 8, box, 30, box_middle);
    one_cell("C3D8", 8, raised, 1.2, NULL); /* the mean height of a bilinear roof: (1 + 1 + 1.8 + 1)/4 */
    one_cell("C3D8", 8, sheared, 1, sheared_middle);
    one_cell("C3D4", 4, tetrahedron, 1, tetrahedron_middle);
    one_cell("C3D4", 4, inverted, 1, tetrahedron_middle);
    one_cell("C3D6", 6, wedge, 2, wedge_middle);
    one_cell("C3D5", 5, pyramid, 1, pyramid_middle);
}

/* Six tetrahedra of ten nodes tile a cube of Gmsh; a face of it is a group. */
static void tetrahedra_fill_a_cube(void) {
    static const int tets[6][4] = {{1, 2, 3, 7}, {1, 3, 4, 7}, {1, 4, 8, 7}, {1, 8, 5, 7}, {1, 5, 6, 7}, {1, 6, 2, 7}};
    char      text[3000];
    size_t    at = (size_t)snprintf(text, sizeof text, HEAD_2 "$Nodes\n8\n1 0 0 0\n2 1 0 0\n"
                                    "3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n"
                                    "$EndNodes\n$Elements\n8\n101 2 2 5 1 1 2 3\n102 2 2 5 1 1 3 4\n");
    run_cloud cloud;
    int       k;
    for (k = 0; k < 6; ++k)
        at += (size_t)snprintf(text + at, sizeof text - at, "%d 11 2 9 1 %d %d %d %d 1 1 1 1 1 1\n", k + 1,
                               tets[k][0], tets[k][1], tets[k][2], tets[k][3]);
    (void)snprintf(text + at, sizeof text - at, "$EndElements\n");
    if (read_text(text, RUN_FORMAT_GMSH, 3, &cloud) == 0) {
        CHECK(cloud.count == 6);
        CHECK_NEAR(sum(&cloud), 1, 1e-14, 0);
        check_set(&cloud, "group_9", 6, 0, 1);
        check_set(&cloud, "group_5", 2, 0, 1); /* those with a face on z = 0 */
    }
    run_free_cloud(&cloud);
}

/* Files with one thing wrong: the line and the field are named. */
static void faults_are_named(void) {
    static const struct { int format, dim; const char *text, *where; } bad[] = {
        {RUN_FORMAT_GMSH, 2, "$Nodes\n1\n", "mesh:1: MeshFormat"},
        {RUN_FORMAT_GMSH, 2, "$MeshFormat\n4.1 1 8\n$EndMeshFormat\n", "mesh:2: MeshFormat: the file is binary"},
        {RUN_FORMAT_GMSH, 2, "$MeshFormat\n4.0 0 8\n", "mesh:2: MeshFormat: only versions"},
        {RUN_FORMAT_GMSH, 2, HEAD_2 "$Nodes\n2\n1 0 0 0\n2 0 x 0\n", "mesh:7: node: a coordinate"},
        {RUN_FORMAT_GMSH, 2, HEAD_2 "$Nodes\n2\n1 0 0 0\n$EndNodes\n", "mesh:7: Nodes: "},
        {RUN_FORMAT_GMSH, 2, HEAD_2 "$Nodes\n1\n1 0 0 0\n2 0 0 0\n$EndNodes\n", "mesh:7: Nodes: more or fewer"},
        {RUN_FORMAT_GMSH, 2, HEAD_2 "$Nodes\n-1\n", "mesh:5: Nodes: a count is negative"},
        {RUN_FORMAT_GMSH, 2, HEAD_2 "$Nodes\n1\n1 0 0 nan\n", "mesh:6: node: a coordinate"},
        {RUN_FORMAT_GMSH, 2, HEAD_2 "$Elements\n1\n1 99 0 1 2 3\n", "mesh:6: Elements: an element of this type"},
        {RUN_FORMAT_GMSH, 2, HEAD_2 "$Elements\n1\n1 2 0 1 2\n", "mesh:6: Elements: more or fewer nodes"},
        {RUN_FORMAT_GMSH, 2, HEAD_2 "$Nodes\n6\n" SQUARES "$EndNodes\n$Elements\n1\n1 2 0 1 2 9\n$EndElements\n",
         "mesh:15: element: a node"},
        {RUN_FORMAT_GMSH, 2, HEAD_2 "$Nodes\n6\n" SQUARES "$EndNodes\n$Elements\n1\n1 2 0 1 2 3\n$EndElements\n",
         "mesh:15: element: has no volume"},
        {RUN_FORMAT_GMSH, 3, HEAD_2 "$Nodes\n6\n" SQUARES "$EndNodes\n$Elements\n1\n1 2 0 1 2 4\n$EndElements\n", "no solid element"},
        {RUN_FORMAT_GMSH, 2, HEAD_2 "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n", "mesh:7: node: its number is given twice"},
        {RUN_FORMAT_ABAQUS, 2, "*NODE\n1, 0, 0\n2, 1\n", "mesh:3: NODE: is not"},
        {RUN_FORMAT_ABAQUS, 2, "*NODE\n1, 0, 0\n*ELEMENT, TYPE=S4\n", "mesh:3: TYPE: elements of this type"},
        {RUN_FORMAT_ABAQUS, 2, "*NODE\n1, 0, 0\n*ELEMENT\n", "mesh:3: TYPE: *ELEMENT has none"},
        {RUN_FORMAT_ABAQUS, 2, "*ELEMENT, TYPE=CPS3\n1, 1, 2, 3, 4\n", "mesh:2: ELEMENT: more nodes"},
        {RUN_FORMAT_ABAQUS, 2, "*ELEMENT, TYPE=CPS3\n1, 1, 2\n*NODE\n", "mesh:3: ELEMENT: the element before"},
        {RUN_FORMAT_ABAQUS, 2, "*NSET, NSET=a\n1, b\n", "mesh:2: NSET: is neither"},
        {RUN_FORMAT_ABAQUS, 2, "*NSET, NSET=a, GENERATE\n1, 1000000000\n", "mesh:2: NSET: is not: first, last, step"},
        {RUN_FORMAT_ABAQUS, 2, "*PART, NAME=a\n*PART, NAME=b\n", "mesh:2: PART: more than one"},
        {RUN_FORMAT_ABAQUS, 2, "*INSTANCE, NAME=a\n1., 0., 0.\n", "mesh:2: INSTANCE: a placement"},
        {RUN_FORMAT_PERIDIGM, 3, "0 0 0 1\n", "mesh:1: point: is not"},
        {RUN_FORMAT_PERIDIGM, 3, "# x\n0 0 0 1 -1\n", "mesh:2: volume: is not a number above 0"},
        {RUN_FORMAT_PERIDIGM, 3, "0 q 0 1 1\n", "mesh:1: y: is not a finite number"},
        {RUN_FORMAT_PERIDIGM, 3, "0 0 0 1.5 1\n", "mesh:1: block: is not a whole number"},
        {RUN_FORMAT_LAMMPS, 3, "title\n2 atoms\nAtoms # peri\n1 1 1 1 0 0 0\n", "Atoms: the file ends before"},
        {RUN_FORMAT_LAMMPS, 3, "title\n1 atoms\nAtoms # full\n1 1 1 1 0 0 0\n", "mesh:3: Atoms: of this style"},
        {RUN_FORMAT_LAMMPS, 3, "title\n1 atoms\nAtoms\n1 1 1 1 0 0 0\n2 1 1 1 0 0 0\n", "mesh:5: Atoms: more atoms"},
        {RUN_FORMAT_LAMMPS, 3, "title\nAtoms\n1 1 1 1 0 0 0\n", "mesh:2: Atoms: the header"}};
    size_t k;
    for (k = 0; k < sizeof bad / sizeof *bad; ++k) {
        run_cloud cloud;
        run_fault fault;
        const int result = read_from(bad[k].text, strlen(bad[k].text), bad[k].format, bad[k].dim, &cloud, &fault);
        CHECK(result < 0);
        if (strstr(fault.text, bad[k].where) == NULL) printf("    row %d: %s\n", (int)k, fault.text);
        CHECK(strstr(fault.text, bad[k].where) != NULL);
        run_free_cloud(&cloud);
    }
}

/* Cut off at every byte, and with every byte replaced: read or refused with a text, and under sanitizers nothing else. A Gmsh or LAMMPS
   file says how much there is: what is read of a part of it is all of it. */
static void damaged_files(void) {
    static const struct { int format; const char *text; int counted; } all[] = {
        {RUN_FORMAT_GMSH, gmsh_2, 1}, {RUN_FORMAT_GMSH, gmsh_4, 1}, {RUN_FORMAT_ABAQUS, abaqus_2, 0}, {RUN_FORMAT_PERIDIGM, peridigm, 0},
        {RUN_FORMAT_LAMMPS, lammps, 1}};
    static const char bytes[] = "9-$*\n,#.";
    int refused = 0;
    size_t k, size, b;
    for (k = 0; k < sizeof all / sizeof *all; ++k) {
        const size_t whole = strlen(all[k].text);
        char        *copy = (char *)malloc(whole);
        run_cloud    cloud;
        run_fault    fault;
        CHECK(copy != NULL);
        for (size = 0; copy != NULL && size < whole; ++size) {
            int result = read_from(all[k].text, size, all[k].format, 2, &cloud, &fault);
            CHECK(result == 0 ? !all[k].counted || cloud.count == 3 : fault.text[0] != 0);
            refused += result < 0;
            run_free_cloud(&cloud);
            for (b = 0; b <= sizeof bytes - 1; ++b) { /* the zero at the end, too */
                memcpy(copy, all[k].text, whole);
                copy[size] = bytes[b];
                result = read_from(copy, whole, all[k].format, 2, &cloud, &fault);
                CHECK(result == 0 ? b < sizeof bytes - 1 : fault.text[0] != 0);
                run_free_cloud(&cloud);
            }
        }
        free(copy);
    }
    CHECK(refused > 500);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(gmsh_in_the_plane);
    RUN(abaqus_in_the_plane);
    RUN(clouds_as_they_are);
    RUN(volumes_of_solids);
    RUN(tetrahedra_fill_a_cube);
    RUN(faults_are_named);
    RUN(damaged_files);
    return test_end("run_meshes");
}
