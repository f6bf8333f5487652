/* SPDX-License-Identifier: MIT */
/* test_series.c - frames of a series for ParaView (peri_export_frame).

   SOURCE OF TRUTH: the collection is XML that names each frame once, with its time, and is whole after each call; a frame is the VTU of the
   same moment. tests/test_series.py reads the files that are left here by parsers of its own. */
#include "pool.h"
#include "refusal.h"
#include "scene.h"
#include "specimen.h"

#define PREFIX "build/tests/series"

static char *slurp(const char *path, int64_t *size) {
    FILE *file = fopen(path, "rb");
    char *text = (char *)calloc(1, 400000);
    CHECK(file != NULL);
    *size = file ? (int64_t)fread(text, 1, 399999, file) : 0;
    if (file) (void)fclose(file);
    return text;
}

/* How many frames the collection names, which must be first, first + 1, ... and end as it should; the times to time[]. */
static int frames_of(const char *path, const char *name, double *time) {
    int64_t size;
    int count = 0;
    char *text = slurp(path, &size), *at = text, *end, want[128];
    CHECK(strncmp(text, "<?xml", 5) == 0 && strstr(text, "<VTKFile type=\"Collection\""));
    while ((at = strstr(at, "<DataSet ")) != NULL) {
        snprintf(want, sizeof want, "file=\"%s_%06d.vtu\"", name, count);
        end = strstr(at, "/>");
        CHECK(end && strstr(at, want) && strstr(at, want) < end && strstr(at, "timestep=\""));
        if (!end || !strstr(at, "timestep=\"")) break;
        time[count++] = strtod(strstr(at, "timestep=\"") + 10, NULL);
        at = end;
    }
    end = strstr(text, "</Collection>\n</VTKFile>\n");
    CHECK(end != NULL);
    for (end += strlen("</Collection>\n</VTKFile>\n"); *end; ++end) CHECK(*end == '\n');
    free(text);
    return count;
}

static peri_body *moving(peri_body_desc *hooks) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.2, 0.1, 2.2, 6, 4, 0);
    const double v[2] = {0.01, 0.02};
    if (hooks) s.desc.allocate = hooks->allocate, s.desc.release = hooks->release, s.desc.memory_user = hooks->memory_user;
    peri_body *b = specimen_make(&s);
    MUST(b, peri_add_velocity(b, PERI_ALL, v));
    return b;
}

/* What test_series.py compares with. */
static void tell(peri_body *b, FILE *file) {
    const int64_t n = peri_point_count(b);
    double *x = get(b, PERI_FIELD_CURRENT_POSITION), *f = get(b, PERI_FIELD_DEFORMATION_GRADIENT);
    fprintf(file, "%.17g", peri_time(b));
    for (int64_t i = 0; i < n; ++i)
        fprintf(file, " %.17g %.17g %.17g %.17g %.17g %.17g", x[2 * i], x[2 * i + 1], f[4 * i], f[4 * i + 1], f[4 * i + 2], f[4 * i + 3]);
    fprintf(file, "\n");
    free(x);
    free(f);
}

static void each_call_leaves_it_whole(void) {
    static const int32_t fields[2] = {PERI_FIELD_CURRENT_POSITION, PERI_FIELD_DEFORMATION_GRADIENT};
    peri_body *b = moving(NULL);
    FILE *file = fopen(PREFIX ".txt", "w");
    double time[16], past[16];
    CHECK(file != NULL);
    if (!file) return;
    for (int k = 0; k < 12; ++k) {
        MUST(b, peri_export_frame(b, PREFIX ".pvd", k, fields, 2));
        past[k] = peri_time(b);
        tell(b, file);
        CHECK(frames_of(PREFIX ".pvd", "series", time) == k + 1);
        for (int n = 0; n <= k; ++n) CHECK_NEAR(time[n], past[n], 1e-15, 0);
        (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 3, 0.01, 0);
    }
    (void)fclose(file);
    peri_body_destroy(b);
}

/* A run that goes on from an earlier state writes its frames anew: the later ones go. Frame 0 begins the file. */
static void earlier_frames_begin_anew(void) {
    peri_body *b = moving(NULL);
    double time[16];
    for (int k = 0; k < 6; ++k) MUST(b, peri_export_frame(b, PREFIX "_b&c", k, NULL, 0));
    CHECK(frames_of(PREFIX "_b&c", "series_b&amp;c", time) == 6);
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 3, 0.01, 0);
    MUST(b, peri_export_frame(b, PREFIX "_b&c", 2, NULL, 0));
    CHECK(frames_of(PREFIX "_b&c", "series_b&amp;c", time) == 3 && time[1] == 0);
    CHECK_NEAR(time[2], 0.03, 1e-14, 0);
    MUST(b, peri_export_frame(b, PREFIX "_b&c", 3, NULL, 0));
    CHECK(frames_of(PREFIX "_b&c", "series_b&amp;c", time) == 4);
    MUST(b, peri_export_frame(b, PREFIX "_b&c", 0, NULL, 0));
    CHECK(frames_of(PREFIX "_b&c", "series_b&amp;c", time) == 1);
    peri_body_destroy(b);
}

static int32_t keep(void *user, const void *bytes, int64_t count) {
    char **end = (char **)user;
    memcpy(*end, bytes, (size_t)count);
    *end += count;
    return 0;
}

/* The VTU of a frame is that of peri_export_fields_to, and in an equilibrium its time is the load factor. */
static void a_frame_is_its_vtu(void) {
    static const int32_t fields[2] = {PERI_FIELD_DAMAGE, PERI_FIELD_DISPLACEMENT};
    const double lo[2] = {-1, -1}, edge[2] = {0.1, 1}, right[2] = {0.55, -1}, hi[2] = {2, 2}, pull[2] = {1e-3, 0};
    peri_body *b = moving(NULL);
    peri_solve_desc solve;
    int64_t size;
    double time[2];
    MUST(b, peri_reset(b));
    MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, edge)), PERI_AXIS_XY, NULL, NULL, NULL));
    MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, right, hi)), PERI_AXIS_X, pull, NULL, NULL));
    peri_solve_desc_init(&solve);
    solve.load_to = 0.75;
    MUST(b, peri_solve(b, &solve, NULL));
    MUST(b, peri_export_frame(b, PREFIX "_solve.pvd", 0, fields, 2));
    CHECK(frames_of(PREFIX "_solve.pvd", "series_solve", time) == 1 && fabs(time[0] - 0.75) < 1e-15);
    char *file = slurp(PREFIX "_solve_000000.vtu", &size), *own = (char *)malloc(400000), *end = own;
    MUST(b, peri_export_fields_to(b, fields, 2, keep, &end));
    CHECK(end - own == size && memcmp(own, file, (size_t)size) == 0);
    free(file);
    free(own);
    peri_body_destroy(b);
}

static void refused(void) {
    static const int32_t odd[1] = {7};
    static pool p;
    peri_body_desc hooks;
    double time[4];
    memset(&p, 0, sizeof p);
    p.fail_at = -1;
    peri_body_desc_init(&hooks);
    hook(&hooks, &p);
    peri_body *b = moving(&hooks);
    (void)remove(PREFIX "_none.pvd");
    CHECK(peri_export_frame(NULL, PREFIX ".pvd", 0, NULL, 0) == PERI_ERROR_ARGUMENT);
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_export_frame(b, NULL, 0, NULL, 0));
    REFUSE(b, PERI_ERROR_RANGE, peri_export_frame(b, PREFIX "_none.pvd", -1, NULL, 0));
    REFUSE(b, PERI_ERROR_RANGE, peri_export_frame(b, PREFIX "_none.pvd", 1000000, NULL, 0));
    FIELD_IS("frame");
    REFUSE(b, PERI_ERROR_CHOICE, peri_export_frame(b, PREFIX "_none.pvd", 0, odd, 1));
    REFUSE(b, PERI_ERROR_WRITE, peri_export_frame(b, PREFIX "_none.pvd", 3, NULL, 0)); /* not begun */
    REFUSE(b, PERI_ERROR_WRITE, peri_export_frame(b, "build/no_such_folder/x.pvd", 0, NULL, 0));
    MUST(b, peri_export_frame(b, PREFIX "_few.pvd", 0, NULL, 0));
    MUST(b, peri_export_frame(b, PREFIX "_few.pvd", 1, NULL, 0));
    REFUSE(b, PERI_ERROR_WRITE, peri_export_frame(b, PREFIX "_few.pvd", 3, NULL, 0)); /* one is missing */
    FIELD_IS("frame");
    CHECK(frames_of(PREFIX "_few.pvd", "series_few", time) == 2);
    (void)remove(PREFIX "_fewer.pvd");
    CHECK(rename(PREFIX "_few.pvd", PREFIX "_fewer.pvd") == 0);
    REFUSE(b, PERI_ERROR_WRITE, peri_export_frame(b, PREFIX "_fewer.pvd", 1, NULL, 0)); /* of frames of another name */
    CHECK(rename(PREFIX "_fewer.pvd", PREFIX "_few.pvd") == 0 && frames_of(PREFIX "_few.pvd", "series_few", time) == 2);
    REFUSE(b, PERI_ERROR_WRITE, peri_export_frame(b, PREFIX "_few_000000.vtu", 1, NULL, 0)); /* no collection */
    const int64_t blocks = p.blocks, first = p.calls;
    MUST(b, peri_export_frame(b, PREFIX "_few.pvd", 2, NULL, 0));
    for (int64_t k = 0, calls = p.calls - first; k < calls; ++k) {
        p.fail_at = p.calls + k;
        REFUSE(b, PERI_ERROR_MEMORY, peri_export_frame(b, PREFIX "_few.pvd", 3, NULL, 0));
        p.fail_at = -1;
        CHECK(p.blocks == blocks && p.wrong == 0);
    }
    CHECK(frames_of(PREFIX "_few.pvd", "series_few", time) == 3);
    peri_body_destroy(b);
    CHECK(p.blocks == 0);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(each_call_leaves_it_whole);
    RUN(earlier_frames_begin_anew);
    RUN(a_frame_is_its_vtu);
    RUN(refused);
    return test_end("test_series");
}
