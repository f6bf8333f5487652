/* SPDX-License-Identifier: MIT */
/* test_own_stress.c - correspondence with the stress of the caller.

   SOURCE OF TRUTH: Saint Venant-Kirchhoff's law, which is built in; differences of forces for the tangent; the bilinear stress-strain line
   of J2 plasticity; the balance of energies; peri.h for history, failures and refusals. */
#include "pool.h"
#include "scene.h"

/* ---- laws ------------------------------------------------------------------------------------------------------------ */

typedef struct hooke {
    int    dim, linear;
    double lambda, mu;
} hooke;

static double strain_of(const hooke *w, const double *h, int a, int c) {
    const int n = w->dim;
    double e = 0.5 * (h[a * n + c] + h[c * n + a]);
    for (int k = 0; !w->linear && k < n; ++k) e += 0.5 * h[k * n + a] * h[k * n + c];
    return e;
}

/* P = (1 + H) S, S = lambda tr(E) + 2 mu E, and dP/dH by hand: dP_ac/dH_bd = delta_ab S_dc + F_ak C_kcld F_bl. */
static int32_t saint_venant(void *user, const peri_stress_block *at) {
    const hooke *w = (const hooke *)user;
    const int n = w->dim;
    for (int64_t p = 0; p < at->count; ++p) {
        const double *h = &at->gradient[p * n * n];
        double s[9], f[9], trace = 0, energy = 0;
        for (int a = 0; a < n; ++a) trace += strain_of(w, h, a, a);
        for (int a = 0; a < n; ++a)
            for (int c = 0; c < n; ++c) {
                const double e = strain_of(w, h, a, c);
                s[a * n + c] = 2 * w->mu * e + (a == c ? w->lambda * trace : 0);
                f[a * n + c] = (a == c) + (w->linear ? 0 : h[a * n + c]);
                energy += 0.5 * s[a * n + c] * e;
            }
        at->energy[p] = energy;
        for (int a = 0; a < n; ++a)
            for (int c = 0; c < n; ++c) {
                double sum = 0;
                for (int k = 0; k < n; ++k) sum += f[a * n + k] * s[k * n + c];
                at->stress[(p * n + a) * n + c] = sum;
                for (int b = 0; at->tangent && b < n; ++b)
                    for (int d = 0; d < n; ++d) {
                        double t = !w->linear && a == b ? s[d * n + c] : 0;
                        for (int k = 0; k < n; ++k)
                            for (int l = 0; l < n; ++l)
                                t += f[a * n + k] * f[b * n + l] * ((k == c && l == d ? w->lambda : 0)
                                     + (k == l && c == d ? w->mu : 0) + (k == d && c == l ? w->mu : 0));
                        at->tangent[(p * n * n + a * n + c) * n * n + b * n + d] = t;
                    }
            }
    }
    return 0;
}

/* J2 with kinematic hardening, plane strain or 3D, small strains (Simo, Hughes 1998, 3.3.1): the centre of the yield surface moves by
   2/3 hardening times the plastic strain, so that no length of it is kept. history: plastic strain [3][3]. */
typedef struct metal {
    int    dim;
    double mu, bulk, yield, hardening;
} metal;

static int32_t flowing(void *user, const peri_stress_block *at) {
    const metal *w = (const metal *)user;
    const int n = w->dim;
    const double stiff = 2 * w->mu, hard = 2.0 / 3 * w->hardening, limit = sqrt(2.0 / 3) * w->yield;
    for (int64_t p = 0; p < at->count; ++p) {
        double e[9] = {0}, x[9], *past = &at->history[9 * p], trace = 0, norm = 0, flow = 0, energy = 0;
        for (int a = 0; a < n; ++a)
            for (int c = 0; c < n; ++c) e[3 * a + c] = 0.5 * (at->gradient[(p * n + a) * n + c] + at->gradient[(p * n + c) * n + a]);
        trace = e[0] + e[4] + e[8];
        for (int k = 0; k < 9; ++k) {
            x[k] = stiff * (e[k] - (k % 4 ? 0 : trace / 3) - past[k]) - hard * past[k];
            norm += x[k] * x[k];
        }
        norm = sqrt(norm);
        if (norm > limit) flow = (norm - limit) / (stiff + hard);
        for (int k = 0; k < 9; ++k) x[k] = norm > 0 ? x[k] / norm : 0;
        for (int a = 0; at->tangent && a < n * n; ++a)
            for (int b = 0; b < n * n; ++b) {
                const int k = 3 * (a / n) + a % n, l = 3 * (b / n) + b % n, both = k % 4 == 0 && l % 4 == 0;
                const double unit = 0.5 * (k == l) + 0.5 * (l == k % 3 * 3 + k / 3) - both / 3.0;
                double t = w->bulk * both + stiff * unit;
                if (flow > 0) t -= stiff * stiff * (flow / norm * unit + (1 / (stiff + hard) - flow / norm) * x[k] * x[l]);
                at->tangent[(p * n * n + a) * n * n + b] = t;
            }
        for (int k = 0; k < 9; ++k) past[k] += flow * x[k];
        for (int k = 0; k < 9; ++k) {
            const double s = stiff * (e[k] - (k % 4 ? 0 : trace / 3) - past[k]);
            if (k / 3 < n && k % 3 < n) at->stress[(p * n + k / 3) * n + k % 3] = s + (k % 4 ? 0 : w->bulk * trace);
            energy += s * s / (2 * stiff) + 0.5 * hard * past[k] * past[k];
        }
        at->energy[p] = energy + 0.5 * w->bulk * trace * trace;
        at->dissipation[p] = limit * flow;
    }
    return 0;
}

static int32_t counting(void *user, const peri_stress_block *at) {
    (void)user;
    for (int64_t p = 0; p < at->count; ++p) at->history[p] += at->time_step > 0;
    for (int64_t k = 0; k < 4 * at->count; ++k) at->stress[k] = at->gradient[k]; /* of plane bodies, of modulus 1 */
    for (int64_t k = 0; at->tangent && k < 16 * at->count; ++k) at->tangent[k] = k % 16 % 5 == 0;
    return 0;
}

/* ---- bodies ---------------------------------------------------------------------------------------------------------- */

static specimen correspondence(int32_t space, int nx, int ny, int nz, hooke *w, int32_t geometry) {
    specimen s = specimen_of(space, PERI_LAW_CORRESPONDENCE, 0.25, H, 2.6, nx, ny, nz);
    s.desc.geometry = geometry;
    w->dim = space == PERI_SPACE_SOLID ? 3 : 2;
    w->linear = geometry == PERI_GEOMETRY_LINEAR;
    w->mu = 1 / (2 * 1.25);
    w->lambda = 0.25 / (1.25 * (space == PERI_SPACE_PLANE_STRESS ? 0.75 : 0.5));
    return s;
}

static peri_body *own(specimen s, peri_stress_fn fn, void *user, int32_t history) {
    s.material.stress = fn;
    s.material.stress_user = user;
    s.material.history = history;
    return specimen_make(&s);
}

/* The same pseudo-random displacement of all bodies, of strains about `size`. */
static void shake(peri_body *b, double size, uint32_t seed) {
    const int64_t n = peri_point_count(b) * peri_dimension(b);
    double *u = (double *)calloc((size_t)n, sizeof *u);
    for (int64_t k = 0; k < n; ++k) {
        seed = seed * 1664525u + 1013904223u;
        u[k] = size * H * ((seed >> 8) / 8388608.0 - 1);
    }
    put(b, PERI_FIELD_DISPLACEMENT, u);
    free(u);
}

static double apart(peri_body *a, peri_body *b, int32_t field) {
    const int64_t n = peri_size_of_field(a, field);
    double *p = get(a, field), *q = get(b, field), most = 0, differ = 0;
    for (int64_t k = 0; k < n; ++k) most = fmax(most, fabs(p[k])), differ = fmax(differ, fabs(p[k] - q[k]));
    free(p);
    free(q);
    return differ / most;
}

/* ---- equal to what is built in --------------------------------------------------------------------------------------- */

static void equals_built_in(void) {
    static const struct {
        int32_t space, geometry, kernel, precision;
        double  same;
    } c[] = {
        { PERI_SPACE_PLANE_STRESS, PERI_GEOMETRY_NONLINEAR, PERI_KERNEL_BEST, PERI_PRECISION_DOUBLE, 1e-13 },
        { PERI_SPACE_PLANE_STRAIN, PERI_GEOMETRY_LINEAR, PERI_KERNEL_LIST, PERI_PRECISION_DOUBLE, 1e-13 },
        { PERI_SPACE_SOLID, PERI_GEOMETRY_NONLINEAR, PERI_KERNEL_LIST, PERI_PRECISION_DOUBLE, 1e-13 },
        { PERI_SPACE_SOLID, PERI_GEOMETRY_LINEAR, PERI_KERNEL_REFERENCE, PERI_PRECISION_DOUBLE, 1e-13 },
        { PERI_SPACE_SOLID, PERI_GEOMETRY_NONLINEAR, PERI_KERNEL_BEST, PERI_PRECISION_MIXED, 1e-5 },
        { PERI_SPACE_PLANE_STRESS, PERI_GEOMETRY_NONLINEAR, PERI_KERNEL_LIST, PERI_PRECISION_SINGLE, 1e-4 },
    };
    for (size_t k = 0; k < sizeof c / sizeof *c; ++k) {
        hooke w;
        peri_energy e[2];
        specimen s = correspondence(c[k].space, 7, 6, c[k].space == PERI_SPACE_SOLID ? 5 : 1, &w, c[k].geometry);
        s.desc.kernel = c[k].kernel;
        s.desc.precision = c[k].precision;
        peri_body *a = specimen_make(&s), *b = own(s, saint_venant, &w, 0);
        shake(a, 0.05, 7);
        shake(b, 0.05, 7);
        CHECK(apart(a, b, PERI_FIELD_FORCE_DENSITY) <= c[k].same);
        CHECK(apart(a, b, PERI_FIELD_STRESS) <= c[k].same);
        CHECK(apart(a, b, PERI_FIELD_FORCE_STRESS) <= c[k].same);
        CHECK(apart(a, b, PERI_FIELD_ENERGY_DENSITY) <= c[k].same);
        for (int n = 0; n < 2; ++n) (void)go(n ? b : a, PERI_INTEGRATOR_VELOCITY_VERLET, 20, 0, 0);
        CHECK(apart(a, b, PERI_FIELD_DISPLACEMENT) <= 10 * c[k].same);
        MUST(a, peri_get_energy(a, &e[0]));
        MUST(b, peri_get_energy(b, &e[1]));
        CHECK_NEAR(e[1].elastic, e[0].elastic, 10 * c[k].same, 0);
        CHECK(e[1].damping == 0);
        peri_body_destroy(a);
        peri_body_destroy(b);
    }
}

/* A material of each kind side by side: points of the built-in one are done as ever. */
static void beside_built_in(void) {
    hooke w;
    const specimen s = correspondence(PERI_SPACE_PLANE_STRESS, 8, 6, 1, &w, PERI_GEOMETRY_NONLINEAR);
    const double lo[2] = {0, 0}, mid[2] = {4 * H, 6 * H}, from[2] = {4 * H, 0}, hi[2] = {8 * H, 6 * H};
    peri_body *b[2];
    for (int n = 0; n < 2; ++n) {
        peri_material_desc m = s.material;
        b[n] = specimen_start(&s);
        m.stress = n ? saint_venant : NULL;
        m.stress_user = &w;
        const int32_t other = (int32_t)MUST(b[n], peri_add_material(b[n], &m));
        MUST(b[n], peri_add_box(b[n], peri_id(b[n], PERI_KIND_MATERIAL, 1), lo, mid, H));
        MUST(b[n], peri_add_box(b[n], other, from, hi, H));
        MUST(b[n], peri_build(b[n]));
        shake(b[n], 0.05, 3);
    }
    CHECK(apart(b[0], b[1], PERI_FIELD_FORCE_DENSITY) <= 1e-13);
    CHECK(apart(b[0], b[1], PERI_FIELD_ENERGY_DENSITY) <= 1e-13);
    peri_body_destroy(b[0]);
    peri_body_destroy(b[1]);
}

/* ---- the tangent ------------------------------------------------------------------------------------------------------- */

/* K v against the central difference of the forces, volumes being H^dim. */
static double tangent_error(peri_body *b, double size) {
    const int64_t n = peri_point_count(b) * peri_dimension(b);
    const double step = 1e-6;
    double *u = get(b, PERI_FIELD_DISPLACEMENT), *volume = get(b, PERI_FIELD_VOLUME), *v = (double *)calloc((size_t)(5 * n), sizeof *v);
    double *by = v + n, *at = v + 2 * n, *f = v + 3 * n, most = 0, differ = 0;
    peri_evaluate_desc e;
    peri_evaluate_desc_init(&e);
    e.displacement = at;
    for (int64_t k = 0; k < n; ++k) v[k] = size * sin(1.7 * (double)(k * k));
    MUST(b, peri_multiply_stiffness(b, v, by, n));
    for (int side = 0; side < 2; ++side) {
        for (int64_t k = 0; k < n; ++k) at[k] = u[k] + (side ? step : -step) * v[k];
        e.force = f + side * n;
        MUST(b, peri_evaluate(b, &e, NULL));
    }
    for (int64_t k = 0; k < n; ++k) {
        const double want = -(f[n + k] - f[k]) / (2 * step) * volume[k / peri_dimension(b)];
        most = fmax(most, fabs(want));
        differ = fmax(differ, fabs(want - by[k]));
    }
    MUST(b, peri_multiply_stiffness_at(b, u, v, at, n));
    for (int64_t k = 0; k < n; ++k) CHECK(at[k] == by[k]);
    free(u);
    free(v);
    free(volume);
    return differ / most;
}

static void tangent_is_the_derivative(void) {
    for (int k = 0; k < 4; ++k) {
        hooke w;
        specimen s = correspondence(k < 2 ? PERI_SPACE_PLANE_STRAIN : PERI_SPACE_SOLID, 5, 4, k < 2 ? 1 : 4, &w,
                                    k % 2 ? PERI_GEOMETRY_LINEAR : PERI_GEOMETRY_NONLINEAR);
        metal steel = { w.dim, 0.4, 2.0 / 3, 0.005, 0.1 };
        if (k == 2) s.desc.kernel = PERI_KERNEL_LIST;
        peri_body *a = own(s, saint_venant, &w, 0), *b = own(s, flowing, &steel, 9);
        shake(a, 0.05, 5);
        shake(b, 0.05, 5);
        CHECK(tangent_error(a, H) < 1e-6);
        CHECK(tangent_error(b, H) < 1e-6);
        peri_body_destroy(a);
        peri_body_destroy(b);
    }
}

/* ---- a bar, pulled and pushed ------------------------------------------------------------------------------------------ */

static int32_t pull(void *user, double factor, int64_t count, const int32_t *points, double *value) {
    for (int64_t k = 0; k < count; ++k) value[3 * k] = factor * ((const double *)user)[3 * points[k]];
    return 0;
}

/* A bar in 3D whose ends are given u = strain x: uniform. Kinematic hardening: yields back after 2 yield. Strains of 1e-2, so that the
   geometry may be of either kind; then H is small enough for 1 %. */
static void bar_cycles(void) {
    for (int nonlinear = 0; nonlinear < 2; ++nonlinear) {
        hooke w;
        metal steel = { 3, 0.4, 2.0 / 3, 0.002, 0.1 };
        specimen s = correspondence(PERI_SPACE_SOLID, 9, 3, 3, &w, nonlinear ? PERI_GEOMETRY_NONLINEAR : PERI_GEOMETRY_LINEAR);
        s.desc.horizon = 1.6 * H;
        peri_body *b = own(s, flowing, &steel, 9);
        double *x = get(b, PERI_FIELD_POSITION);
        const double most = 5e-3, soft = 0.1 / 1.1, first = 0.002 + soft * (most - 0.002), area = 9 * H * H;
        const double factor[4] = {1, 0.8, -0.5, 1};
        const double want[4] = {first, first - 0.2 * most, first - 0.004 - soft * (1.5 * most - 0.004), first};
        int32_t end = 0;
        for (int side = 0; side < 2; ++side) {
            const double lo[3] = {side ? 7 * H : 0, 0, 0}, hi[3] = {side ? 9 * H : 2 * H, 3 * H, 3 * H};
            const int32_t set = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
            end = (int32_t)MUST(b, peri_prescribe_displacement(b, set, PERI_AXIS_X, NULL, pull, x));
        }
        for (int64_t k = 0; k < peri_size_of_field(b, PERI_FIELD_POSITION); ++k) x[k] *= most;
        peri_solve_desc solve;
        peri_energy e;
        double taken = 0;
        peri_solve_desc_init(&solve);
        solve.loose = PERI_LOOSE_PINNED;
        solve.steps = 2;
        for (int k = 0; k < 4; ++k) {
            double force[3];
            solve.load_to = factor[k];
            MUST(b, peri_solve(b, &solve, NULL));
            MUST(b, peri_get_reaction(b, end, force));
            CHECK_NEAR(force[0] / area, want[k], 0.01, 0);
            MUST(b, peri_get_energy(b, &e));
            CHECK(e.damping >= taken);
            taken = e.damping;
        }
        /* what is dissipated: yield times the way of the plastic strain, forth, back and forth */
        const double forth = most - first, back = -0.5 * most - want[2];
        CHECK_NEAR(taken / (9 * area * H), 0.002 * (forth + 2 * (forth - back)), 0.02, 0);
        CHECK(fabs(e.error) < 0.1 * e.external); /* the trapezoidal rule over 8 steps that yield */
        free(x);
        peri_body_destroy(b);
    }
}

/* ---- history ----------------------------------------------------------------------------------------------------------- */

static double longest; /* time_step that was asked for */

static int32_t reads_count(void *user, const peri_stress_block *at) {
    double *most = (double *)user;
    longest = fmax(longest, at->time_step);
    for (int64_t p = 0; p < at->count; ++p) {
        if (at->history[p] > *most) *most = at->history[p];
        at->history[p] += at->time_step > 0;
    }
    for (int64_t k = 0; k < 4 * at->count; ++k) at->stress[k] = at->gradient[k];
    for (int64_t k = 0; at->tangent && k < 16 * at->count; ++k) at->tangent[k] = k % 16 % 5 == 0;
    return 0;
}

/* How often steps were committed, as the callback finds it in its history. */
static double committed(peri_body *b, double *most) {
    peri_evaluate_desc e;
    static double f[256];
    peri_evaluate_desc_init(&e);
    e.force = f;
    *most = -1;
    MUST(b, peri_evaluate(b, &e, NULL));
    return *most;
}

static int32_t collect(void *user, const void *bytes, int64_t count) {
    char **end = (char **)user;
    memcpy(*end, bytes, (size_t)count);
    *end += count;
    return 0;
}

static int32_t give(void *user, void *bytes, int64_t count) {
    const char **at = (const char **)user;
    memcpy(bytes, *at, (size_t)count);
    *at += count;
    return 0;
}

static void history_is_committed_once(void) {
    hooke w;
    double most = 0;
    static char bytes[1 << 20];
    char *end = bytes;
    const char *at = bytes;
    const specimen s = correspondence(PERI_SPACE_PLANE_STRESS, 8, 8, 1, &w, PERI_GEOMETRY_NONLINEAR);
    peri_body *b = own(s, reads_count, &most, 1), *copy = NULL;
    shake(b, 0.01, 3);
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 10, 0, 0);
    CHECK(committed(b, &most) == 10);
    CHECK(committed(b, &most) == 10);
    MUST(b, peri_body_clone(b, &copy, NULL));
    (void)go(copy, PERI_INTEGRATOR_CENTRAL_DIFFERENCE, 3, 0, 0);
    CHECK(committed(copy, &most) == 13);
    CHECK(committed(b, &most) == 10);
    MUST(b, peri_save_state_to(b, collect, &end));
    MUST(copy, peri_load_state_from(copy, give, &at));
    CHECK(committed(copy, &most) == 10);
    MUST(b, peri_reset(b));
    CHECK(committed(b, &most) == 0);
    peri_body_destroy(copy);
    peri_body_destroy(b);
}

static void history_in_equilibria(void) {
    hooke w;
    double most = 0;
    specimen s = correspondence(PERI_SPACE_PLANE_STRESS, 8, 8, 1, &w, PERI_GEOMETRY_NONLINEAR);
    s.material.density = 4; /* so that the unit of time inside is not 1 */
    longest = 0;
    const double force[2] = {0.01, 0}, lo[2] = {-1, -1}, hi[2] = {2 * H, 9 * H};
    peri_body *b = own(s, reads_count, &most, 1);
    peri_solve_desc solve;
    peri_solve_desc_init(&solve);
    MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)), PERI_AXIS_XY, NULL, NULL, NULL));
    MUST(b, peri_apply_body_force(b, PERI_ALL, force, NULL, NULL));
    solve.steps = 4;
    solve.duration = 2;
    MUST(b, peri_solve(b, &solve, NULL));
    CHECK(committed(b, &most) == 4);
    CHECK_NEAR(peri_time(b), 2, 1e-12, 0);
    CHECK_NEAR(longest, 0.5, 1e-12, 0);
    solve.load_to = 2;
    solve.duration = 0; /* no time passes */
    MUST(b, peri_solve(b, &solve, NULL));
    CHECK(committed(b, &most) == 4);
    peri_body_destroy(b);
}

/* ---- what goes wrong ------------------------------------------------------------------------------------------------- */

typedef struct trap { /* fails once `left` blocks were served                                                            */
    int     left;
    int32_t say;
} trap;

static int32_t trapped(void *user, const peri_stress_block *at) {
    trap *t = (trap *)user;
    (void)counting(NULL, at);
    if (t->left-- > 0) return 0;
    if (t->say == 0) at->stress[1] = (double)NAN;
    return t->say;
}

static void failures_are_told(void) {
    hooke w;
    trap t = { 100, -7 };
    peri_error error;
    peri_energy energy;
    static double f[128];
    peri_evaluate_desc e;
    peri_solve_desc solve;
    peri_advance_desc run;
    peri_evaluate_desc_init(&e);
    peri_solve_desc_init(&solve);
    peri_advance_desc_init(&run);
    run.steps = 5;
    e.force = f;
    specimen s = correspondence(PERI_SPACE_PLANE_STRESS, 8, 8, 1, &w, PERI_GEOMETRY_NONLINEAR);
    peri_body *b = own(s, trapped, &t, 1);
    MUST(b, peri_apply_body_force(b, PERI_ALL, f, NULL, NULL));
    for (t.say = -7; t.say <= 0; t.say += 7)
        for (int call = 0; call < 5; ++call) {
            t.left = call == 2 ? 3 : 0;
            solve.loose = PERI_LOOSE_PINNED;
            const int32_t status = call == 0 ? peri_evaluate(b, &e, NULL) : call == 1 ? peri_get_energy(b, &energy)
                                 : call == 2 ? peri_advance(b, &run) : call == 3 ? peri_solve(b, &solve, NULL)
                                 : peri_multiply_stiffness(b, f, f, 128);
            CHECK(status == PERI_ERROR_CALLBACK);
            MUST(b, peri_get_error(b, &error));
            CHECK(strcmp(error.field, "peri_stress_fn") == 0 && error.index == 0 && error.value == (t.say ? -7 : 1));
            t.left = 1000;
            MUST(b, peri_reset(b));
            MUST(b, peri_advance(b, &run));
            MUST(b, peri_reset(b));
        }
    peri_body_destroy(b);
}

static void refusals(void) {
    hooke w;
    const specimen s = correspondence(PERI_SPACE_PLANE_STRESS, 8, 8, 1, &w, PERI_GEOMETRY_NONLINEAR);
    peri_material_desc m = s.material;
    m.stress = counting;
    CHECK(material_status(PERI_SPACE_PLANE_STRESS, &m, "", -1) >= 0);
    m.history = -1;
    CHECK(material_status(PERI_SPACE_PLANE_STRESS, &m, "history", -1) == PERI_ERROR_RANGE);
    m.history = PERI_HISTORY + 1;
    CHECK(material_status(PERI_SPACE_PLANE_STRESS, &m, "history", -1) == PERI_ERROR_RANGE);
    m.history = 2;
    m.stress = NULL;
    CHECK(material_status(PERI_SPACE_PLANE_STRESS, &m, "stress", -1) == PERI_ERROR_ARGUMENT);
    m.history = 0;
    m.stress = counting;
    m.fracture_energy = 1;
    m.criterion = PERI_CRITERION_NODE_ENERGY;
    CHECK(material_status(PERI_SPACE_PLANE_STRESS, &m, "criterion", -1) == PERI_ERROR_CRITERION);
    m.criterion = PERI_CRITERION_STRETCH;
    m.stabilization = 0;
    m.law = PERI_LAW_LPS;
    CHECK(material_status(PERI_SPACE_PLANE_STRESS, &m, "stress", -1) == PERI_ERROR_LAW);
    peri_body *b = own(s, counting, NULL, 1);
    peri_matrix *matrix = NULL;
    peri_solve_desc solve;
    peri_solve_desc_init(&solve);
    CHECK(peri_matrix_create(b, &matrix) == PERI_ERROR_LAW);
    solve.duration = -1;
    CHECK(peri_solve(b, &solve, NULL) == PERI_ERROR_RANGE);
    solve.duration = 0;
    solve.method = PERI_METHOD_BICGSTAB;
    CHECK(peri_solve(b, &solve, NULL) == PERI_ERROR_LAW);
    solve.method = PERI_METHOD_NEWTON;
    solve.control = PERI_CONTROL_FRACTURE;
    CHECK(peri_solve(b, &solve, NULL) == PERI_ERROR_LAW);
    peri_body_destroy(b);
}

/* Memory that ends anywhere: PERI_ERROR_MEMORY, nothing is lost, and the same call then does it. flow: of bonds instead. */
static void short_memory(void) {
    for (int flow = 0; flow < 2; ++flow) {
        pool p = { 0, 0, 0, 0, -1, 0 };
        hooke w;
        double most = 0, product[128] = {0};
        const double force[2] = {0.001, 0}, lo[2] = {-1, -1}, hi[2] = {2 * H, 9 * H};
        specimen s = correspondence(PERI_SPACE_PLANE_STRESS, 8, 8, 1, &w, PERI_GEOMETRY_NONLINEAR);
        int32_t status = PERI_ERROR_MEMORY;
        peri_solve_desc solve;
        peri_solve_desc_init(&solve);
        if (flow) peri_material_desc_init(&s.material, PERI_LAW_LPS);
        s.material.young = s.material.density = 1;
        s.material.poisson = 0.3;
        s.material.yield_shear = flow ? 1 : 0;
        s.material.stress = flow ? NULL : reads_count;
        s.material.stress_user = &most;
        s.material.history = flow ? 0 : 1;
        hook(&s.desc, &p);
        peri_body *b = specimen_start(&s);
        MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), s.lo, s.hi, s.spacing));
        for (int64_t at = 0; status != PERI_OK && at < 200; ++at) {
            const int64_t blocks = p.blocks;
            p.fail_at = p.calls + at;
            status = peri_build(b);
            CHECK(status == PERI_OK || (status == PERI_ERROR_MEMORY && p.blocks == blocks));
        }
        p.fail_at = -1;
        MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)), PERI_AXIS_XY, NULL, NULL, NULL));
        MUST(b, peri_apply_body_force(b, PERI_ALL, force, NULL, NULL));
        for (int call = 0; call < 3; ++call) {
            peri_body *copy = NULL;
            status = PERI_ERROR_MEMORY;
            for (int64_t at = 0; status != PERI_OK && at < 400; ++at) {
                const int64_t blocks = p.blocks;
                p.fail_at = p.calls + at;
                status = call == 0 ? peri_solve(b, &solve, NULL) : call == 1 ? peri_body_clone(b, &copy, NULL)
                       : peri_multiply_stiffness(b, product, product, 128);
                for (int k = 0; k < 128; ++k) product[k] = k;
                CHECK(status == PERI_OK || (status == PERI_ERROR_MEMORY && p.blocks == blocks));
            }
            CHECK(status == PERI_OK);
            p.fail_at = -1;
            peri_body_destroy(copy);
        }
        peri_body_destroy(b);
        CHECK(p.blocks == 0 && p.wrong == 0);
    }
}

/* ---- breaking ---------------------------------------------------------------------------------------------------------- */

/* Bonds break as those of the built-in law do that break after the drift; energy is kept but for the error of the step. */
static void bonds_break(void) {
    hooke w;
    peri_body *b[2];
    peri_energy e;
    for (int n = 0; n < 2; ++n) {
        specimen s = correspondence(PERI_SPACE_PLANE_STRESS, 12, 8, 1, &w, PERI_GEOMETRY_NONLINEAR);
        s.material.critical_stretch = 0.05;
        s.desc.break_timing = PERI_BREAK_AFTER_DRIFT;
        b[n] = n ? own(s, saint_venant, &w, 0) : specimen_make(&s);
        double *x = get(b[n], PERI_FIELD_POSITION);
        for (int64_t k = 0; k < 2 * peri_point_count(b[n]); ++k) x[k] = k % 2 ? 0 : 0.12 * (x[k] - 6 * H);
        put(b[n], PERI_FIELD_VELOCITY, x);
        free(x);
        (void)go(b[n], PERI_INTEGRATOR_VELOCITY_VERLET, 60, 0.2 * H, 0);
    }
    CHECK(peri_broken_count(b[1]) > 20);
    CHECK(peri_broken_count(b[0]) == peri_broken_count(b[1]));
    CHECK(apart(b[0], b[1], PERI_FIELD_DISPLACEMENT) < 1e-9);
    MUST(b[1], peri_get_energy(b[1], &e));
    CHECK(e.fracture > 0 && fabs(e.error) < 0.01 * e.initial);
    peri_body_destroy(b[0]);
    peri_body_destroy(b[1]);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(equals_built_in);
    RUN(beside_built_in);
    RUN(tangent_is_the_derivative);
    RUN(bar_cycles);
    RUN(history_is_committed_once);
    RUN(history_in_equilibria);
    RUN(failures_are_told);
    RUN(refusals);
    RUN(short_memory);
    RUN(bonds_break);
    return test_end("test_own_stress");
}
