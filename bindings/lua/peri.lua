-- SPDX-License-Identifier: MIT
-- peri.lua - peri for LuaJIT. Made from peri.h by tools/bind.py: edit that.
--   local peri = require "peri"      the shared library is that of the environment variable PERI, else libperi.so
-- Names are those of peri.h: peri_add_box(body, ...) is body:add_box(...), PERI_SPACE_SOLID is peri.SPACE_SOLID. Arrays are tables of numbers
-- or arrays of the FFI (peri.doubles(n), peri.integers(n)), which are not copied; those that come back are of the FFI: from 0 on. A call
-- that fails raises an error: a table with status, field, index, value and text. What a function of yours raises stops the call that it came
-- from and comes out of it. A function gets what C has, less `user`; of a body, the body.
local ffi = require "ffi"
jit.off(true, true) -- what calls back must not be called from compiled traces

ffi.cdef [[
typedef struct peri_body peri_body;
typedef struct peri_matrix peri_matrix;
typedef struct peri_cracks peri_cracks;
typedef struct peri_error peri_error;
typedef struct peri_stress_block peri_stress_block;
typedef struct peri_bond_row peri_bond_row;
typedef struct peri_body_desc peri_body_desc;
typedef struct peri_material_desc peri_material_desc;
typedef struct peri_softening_desc peri_softening_desc;
typedef struct peri_cells_desc peri_cells_desc;
typedef struct peri_part_desc peri_part_desc;
typedef struct peri_fragment peri_fragment;
typedef struct peri_obstacle_desc peri_obstacle_desc;
typedef struct peri_obstacle_state peri_obstacle_state;
typedef struct peri_contact_desc peri_contact_desc;
typedef struct peri_advance_desc peri_advance_desc;
typedef struct peri_evaluate_desc peri_evaluate_desc;
typedef struct peri_evaluate_report peri_evaluate_report;
typedef struct peri_solve_desc peri_solve_desc;
typedef struct peri_solve_report peri_solve_report;
typedef struct peri_view peri_view;
typedef struct peri_energy peri_energy;
typedef struct peri_cracks_desc peri_cracks_desc;
typedef struct peri_crack_tip peri_crack_tip;
typedef struct peri_memory peri_memory;
typedef struct peri_plan_desc peri_plan_desc;
typedef struct peri_plan_report peri_plan_report;
typedef struct peri_choose_desc peri_choose_desc;
typedef struct peri_choose_report peri_choose_report;
typedef void * (*peri_allocate_fn)(void *user, uint64_t bytes);
typedef void (*peri_release_fn)(void *user, void *pointer, uint64_t bytes);
typedef void (*peri_task_fn)(void *context, int64_t k);
typedef void (*peri_parallel_for_fn)(void *user, int64_t count, peri_task_fn task, void *context);
typedef void (*peri_log_fn)(void *user, int32_t level, const char *text);
typedef int32_t (*peri_influence_fn)(void *user, double q, double *w);
typedef int32_t (*peri_point_fn)(void *user, int64_t index, const double *x);
typedef int32_t (*peri_pair_fn)(void *user, int32_t i, int32_t j, const double *xi, const double *xj);
typedef int32_t (*peri_load_fn)(void *user, double time, int64_t count, const int32_t *points, double *value);
typedef int32_t (*peri_motion_fn)(void *user, double time, double *place, double *turn);
typedef int32_t (*peri_distance_fn)(void *user, const double *x, double *distance, double *normal);
typedef int32_t (*peri_stress_fn)(void *user, const peri_stress_block *block);
typedef int32_t (*peri_rigid_fn)(void *user, double time, double *motion);
typedef int32_t (*peri_break_fn)(void *user, int32_t i, int32_t j, double time, double stretch);
typedef int32_t (*peri_bond_law_fn)(void *user, const peri_bond_row *row);
typedef int32_t (*peri_write_fn)(void *user, const void *bytes, int64_t count);
typedef int32_t (*peri_read_fn)(void *user, void *bytes, int64_t count);
typedef int32_t (*peri_exchange_fn)(void *user, int32_t type, int32_t planes, void **plane);
typedef int32_t (*peri_reduce_fn)(void *user, int32_t reduction, int64_t count, double *values);
typedef int32_t (*peri_frame_fn)(void *user, peri_body *body);
typedef int32_t (*peri_iteration_fn)(void *user, int64_t iteration, double residual);
struct peri_error {
    int32_t code;
    int32_t reserved;
    int64_t index;
    double value;
    const char *field;
    const char *text;
};
struct peri_stress_block {
    int64_t count;
    const int32_t *points;
    const double *gradient;
    double time_step;
    double *history;
    double *stress;
    double *tangent;
    double *energy;
    double *dissipation;
};
struct peri_bond_row {
    int32_t point;
    int32_t count;
    const int32_t *others;
    const double *length;
    const double *stretch;
    double *state;
    double *force;
    double *tangent;
    double *energy;
    double *lost;
    int32_t *broken;
};
struct peri_body_desc {
    uint64_t cookie;
    int32_t space;
    int32_t precision;
    int32_t geometry;
    int32_t influence;
    int32_t quadrature;
    int32_t correction;
    int32_t break_timing;
    int32_t moments;
    int32_t kernel;
    int32_t instructions;
    int32_t threads;
    int32_t ledger;
    int32_t number;
    int32_t reserved;
    double horizon;
    double thickness;
    peri_influence_fn influence_fn;
    void *influence_user;
    peri_allocate_fn allocate;
    peri_release_fn release;
    void *memory_user;
    peri_parallel_for_fn parallel_for;
    void *parallel_user;
    peri_log_fn log;
    void *log_user;
};
struct peri_material_desc {
    uint64_t cookie;
    int32_t law;
    int32_t criterion;
    double young;
    double bulk;
    double poisson;
    double density;
    double fracture_energy;
    double critical_stretch;
    double stabilization;
    double strength;
    double cohesion;
    double friction_angle;
    double compression;
    double rate;
    double rate_power;
    double delay;
    double yield_shear;
    int32_t relaxations;
    int32_t history;
    double relaxation_part[4];
    double relaxation_time[4];
    peri_stress_fn stress;
    void *stress_user;
};
struct peri_softening_desc {
    uint64_t cookie;
    int32_t shape;
    int32_t unloading;
    double strength;
    double fracture_energy;
    double compression;
    int64_t count;
    const double *table;
};
struct peri_cells_desc {
    uint64_t cookie;
    int64_t vertex_count;
    const double *vertices;
    int64_t vertex_stride;
    int64_t cell_count;
    const int32_t *corners;
    const int64_t *offsets;
    int32_t cell_corners;
    int32_t reserved;
    const int32_t *materials;
};
struct peri_part_desc {
    uint64_t cookie;
    double origin[3];
    double length;
    double mean_volume;
    int64_t ghost_count;
    const int32_t *ghosts;
    const int32_t *owners;
    const int64_t *ids;
    peri_exchange_fn exchange;
    peri_reduce_fn reduce;
    void *user;
};
struct peri_fragment {
    int32_t first;
    int32_t points;
    int32_t parent;
    int32_t held;
    double mass;
    double centre[3];
    double velocity[3];
    double angular[3];
    double inertia[6];
    double lo[3];
    double hi[3];
};
struct peri_obstacle_desc {
    uint64_t cookie;
    int32_t shape;
    int32_t reserved;
    double place[3];
    double turn[4];
    double normal[3];
    double axis[3];
    double radius;
    double length;
    double size[3];
    int64_t vertex_count;
    int64_t face_count;
    const double *vertices;
    const int32_t *faces;
    peri_distance_fn distance;
    double stiffness;
    double friction;
    double friction_speed;
    double restitution;
    double mass;
    double density;
    double inertia[3];
    double velocity[3];
    double spin[3];
    double gravity[3];
    peri_motion_fn motion;
    void *user;
};
struct peri_obstacle_state {
    double place[3];
    double turn[4];
    double velocity[3];
    double spin[3];
    double mass;
    double kinetic;
    double stored;
    double lost;
};
struct peri_contact_desc {
    uint64_t cookie;
    double stiffness;
    double distance;
    double friction;
    double friction_speed;
    double restitution;
};
struct peri_advance_desc {
    uint64_t cookie;
    int32_t integrator;
    int32_t force_step;
    int64_t steps;
    double duration;
    double time_step;
    double safety;
    double damping;
    double load_factor;
    int64_t frame_steps;
    peri_frame_fn on_frame;
    void *user;
};
struct peri_evaluate_desc {
    uint64_t cookie;
    int32_t type;
    int32_t nodal;
    int32_t bonds;
    int32_t external;
    int32_t fracture;
    int32_t energy;
    int64_t point_stride;
    int64_t component_stride;
    const void *displacement;
    const void *velocity;
    double time_step;
    double time;
    double load_factor;
    void *force;
    void *impulse;
};
struct peri_evaluate_report {
    int64_t broken;
    double energy;
};
struct peri_solve_desc {
    uint64_t cookie;
    int32_t method;
    int32_t preconditioner;
    int32_t loose;
    int32_t fracture;
    int32_t control;
    int32_t curve_load;
    int32_t keep;
    int32_t reserved;
    double criticality;
    double tolerance;
    double energy_tolerance;
    int64_t iterations;
    int64_t newton;
    int64_t breaks;
    double load_from;
    double load_to;
    int64_t steps;
    double duration;
    int64_t halvings;
    double *curve;
    int64_t curve_rows;
    peri_iteration_fn on_iteration;
    peri_frame_fn on_step;
    void *user;
};
struct peri_solve_report {
    int64_t iterations;
    int64_t passes;
    int64_t newton;
    int64_t steps;
    int64_t broken;
    int64_t curve_rows;
    int64_t loose;
    int64_t lost_parts;
    int64_t lost_points;
    int64_t bytes;
    int32_t ended;
    int32_t reserved;
    double residual;
    double load_factor;
};
struct peri_view {
    const void *data;
    int64_t count;
    int64_t point_stride;
    int64_t component_stride;
    int32_t components;
    int32_t type;
    double scale;
    double offset[3];
};
struct peri_energy {
    double kinetic;
    double elastic;
    double contact;
    double external;
    double obstacle;
    double damping;
    double fracture;
    double initial;
    double error;
};
struct peri_cracks_desc {
    uint64_t cookie;
    int32_t initial;
    int32_t current;
    double shortest;
};
struct peri_crack_tip {
    double place[3];
    double direction[3];
    double speed;
    int64_t path;
};
struct peri_memory {
    int64_t points;
    int64_t families;
    int64_t damage;
    int64_t state;
    int64_t laws;
    int64_t loads;
    int64_t fields;
    int64_t total;
    int64_t shared;
};
struct peri_plan_desc {
    uint64_t cookie;
    const peri_body_desc *body;
    const peri_material_desc *material;
    int32_t source;
    int32_t measure;
    double amount;
    double lo[3];
    double hi[3];
    double spacing;
};
struct peri_plan_report {
    int64_t points;
    int64_t entries;
    int64_t width;
    int64_t columns;
    int64_t bytes;
    int64_t peak;
    double stable_step;
    double seconds;
};
struct peri_choose_desc {
    uint64_t cookie;
    int32_t preset;
    int32_t quantity;
    double error;
    double seconds;
    int64_t bytes;
    double feature;
    double lo[3];
    double hi[3];
};
struct peri_choose_report {
    double spacing;
    double across;
    double error;
    const char *text;
    peri_plan_report cost;
};
int32_t peri_version(void);
const char * peri_status_text(int32_t status);
int64_t peri_format_error(const peri_error *error, char *buffer, int64_t capacity);
void peri_body_desc_init(peri_body_desc *desc);
int32_t peri_body_create(const peri_body_desc *desc, peri_body **body, peri_error *error);
int32_t peri_body_clone(const peri_body *body, peri_body **copy, peri_error *error);
void peri_body_destroy(peri_body *body);
int32_t peri_unlock(peri_body *body);
int32_t peri_get_error(const peri_body *body, peri_error *error);
int32_t peri_id(const peri_body *body, int32_t kind, int64_t index);
void peri_material_desc_init(peri_material_desc *desc, int32_t law);
int32_t peri_add_material(peri_body *body, const peri_material_desc *desc);
int32_t peri_set_interface(peri_body *body, int32_t i, int32_t j, const peri_material_desc *desc);
void peri_softening_desc_init(peri_softening_desc *desc, int32_t shape);
int32_t peri_set_softening(peri_body *body, int32_t i, int32_t j, const peri_softening_desc *desc);
int32_t peri_get_softening(peri_body *body, int32_t i, int32_t j, double *first, double *last);
int32_t peri_set_bond_law(peri_body *body, int32_t i, int32_t j, int32_t states, peri_bond_law_fn fn, void *user);
int32_t peri_get_bond_constants(peri_body *body, int32_t i, int32_t j, double *c, double *s0);
int32_t peri_get_critical_energy(peri_body *body, int32_t material, double *w0);
int64_t peri_add_box(peri_body *body, int32_t material, const double *lo, const double *hi, double spacing);
int64_t peri_add_grid(peri_body *body, int32_t material, const double *lo, const double *hi, const int32_t *cells);
int64_t peri_add_ball(peri_body *body, int32_t material, const double *centre, double radius, double spacing);
int64_t peri_add_shape(peri_body *body, int32_t material, const double *lo, const double *hi, double spacing, peri_point_fn inside, void *user);
int64_t peri_add_perturbed_box(peri_body *body, int32_t material, const double *lo, const double *hi, double spacing, double amount, uint64_t seed);
int64_t peri_add_points(peri_body *body, int64_t count, const double *positions, const double *volumes, const int32_t *materials);
void peri_cells_desc_init(peri_cells_desc *desc);
int64_t peri_add_cells(peri_body *body, const peri_cells_desc *desc);
int32_t peri_set_families(peri_body *body, int32_t width, const int32_t *ibond);
void peri_part_desc_init(peri_part_desc *desc);
int32_t peri_set_part(peri_body *body, const peri_part_desc *desc);
int32_t peri_ghost_depth(const peri_body *body);
int32_t peri_set_mean_gradient(peri_body *body, const double *gradient);
int64_t peri_add_box_part(peri_body *body, int32_t material, const double *lo, const double *hi, double spacing, const int32_t *first, const int32_t *last);
int32_t peri_build(peri_body *body);
int32_t peri_dimension(const peri_body *body);
int64_t peri_point_count(const peri_body *body);
int32_t peri_family_width(const peri_body *body);
int64_t peri_bond_count(const peri_body *body);
int64_t peri_entry_count(const peri_body *body);
int64_t peri_cut_count(const peri_body *body);
int64_t peri_broken_count(const peri_body *body);
int64_t peri_step_count(const peri_body *body);
double peri_time(const peri_body *body);
double peri_load_factor(const peri_body *body);
const char * peri_kernel_text(const peri_body *body);
double peri_stable_step(const peri_body *body);
int32_t peri_get_families(peri_body *body, int64_t first, int64_t count, int32_t *rows, int64_t capacity);
int32_t peri_find_point(peri_body *body, const double *x);
int32_t peri_find_point_in_place(peri_body *body, const double *x);
int32_t peri_bond_is_intact(peri_body *body, int32_t i, int32_t j);
int32_t peri_reset(peri_body *body);
int32_t peri_select_box(peri_body *body, const char *name, const double *lo, const double *hi);
int32_t peri_select_ball(peri_body *body, const char *name, const double *centre, double radius);
int32_t peri_select_box_in_place(peri_body *body, const char *name, const double *lo, const double *hi);
int32_t peri_select_ball_in_place(peri_body *body, const char *name, const double *centre, double radius);
int32_t peri_select_if(peri_body *body, const char *name, peri_point_fn take, void *user);
int32_t peri_select_points(peri_body *body, const char *name, int64_t count, const int32_t *points);
int32_t peri_find_set(const peri_body *body, const char *name);
int64_t peri_size_of_set(const peri_body *body, int32_t set);
int32_t peri_get_set(peri_body *body, int32_t set, int32_t *points, int64_t capacity);
int64_t peri_cut_segment(peri_body *body, int32_t standing, const double *from, const double *to);
int64_t peri_cut_polyline(peri_body *body, int32_t standing, int64_t count, const double *vertices);
int64_t peri_cut_disc(peri_body *body, int32_t standing, const double *centre, const double *normal, double radius);
int64_t peri_cut_triangle(peri_body *body, int32_t standing, const double *p, const double *q, const double *r);
int64_t peri_cut_rectangle(peri_body *body, int32_t standing, const double *corner, const double *edge1, const double *edge2);
int64_t peri_cut_pairs(peri_body *body, int32_t standing, int64_t count, const int32_t *pairs);
int64_t peri_cut_if(peri_body *body, int32_t standing, peri_pair_fn cut, void *user);
int32_t peri_set_no_fail(peri_body *body, int32_t set, int32_t on);
int32_t peri_on_break(peri_body *body, peri_break_fn fn, void *user);
int64_t peri_set_strength_pairs(peri_body *body, int64_t count, const int32_t *pairs, const double *factors);
int64_t peri_set_strength_if(peri_body *body, double factor, peri_pair_fn take, void *user);
int32_t peri_record_breaks(peri_body *body, int32_t on);
int64_t peri_find_fragments(peri_body *body, int32_t *of_point, int64_t capacity);
int32_t peri_get_fragments(peri_body *body, peri_fragment *out, int64_t capacity);
int32_t peri_size_of_outline(peri_body *body, int32_t fragment, int64_t *vertices, int64_t *faces);
int32_t peri_get_outline(peri_body *body, int32_t fragment, double *vertices, int64_t vertex_capacity, int32_t *faces, int32_t *owners, int32_t *inner, int64_t face_capacity);
int32_t peri_add_displacement(peri_body *body, int32_t set, const double *value);
int32_t peri_add_velocity(peri_body *body, int32_t set, const double *value);
int32_t peri_prescribe_displacement(peri_body *body, int32_t set, int32_t axes, const double *value, peri_load_fn fn, void *user);
int32_t peri_prescribe_velocity(peri_body *body, int32_t set, int32_t axes, const double *value, peri_load_fn fn, void *user);
int32_t peri_prescribe_rigid(peri_body *body, int32_t set, const double *centre, const double *motion, peri_rigid_fn fn, void *user);
int32_t peri_apply_body_force(peri_body *body, int32_t set, const double *value, peri_load_fn fn, void *user);
int32_t peri_apply_traction(peri_body *body, int32_t set, double area, const double *normal, const double *value, peri_load_fn fn, void *user);
int32_t peri_apply_layer_traction(peri_body *body, int32_t set, double area, const double *value, peri_load_fn fn, void *user);
int32_t peri_apply_pressure(peri_body *body, int32_t set, double pressure, peri_load_fn fn, void *user);
int32_t peri_apply_bond_pressure_for_comparison(peri_body *body, int32_t set, double pressure, peri_load_fn fn, void *user);
int32_t peri_remove_load(peri_body *body, int32_t load);
int32_t peri_get_reaction(peri_body *body, int32_t load, double *force);
int32_t peri_get_reaction_moment(peri_body *body, int32_t load, const double *place, double *moment);
void peri_obstacle_desc_init(peri_obstacle_desc *desc, int32_t shape);
int32_t peri_add_obstacle(peri_body *body, const peri_obstacle_desc *desc);
int32_t peri_remove_obstacle(peri_body *body, int32_t obstacle);
int32_t peri_get_obstacle_force(peri_body *body, int32_t obstacle, double *force, double *moment);
int32_t peri_get_obstacle_state(peri_body *body, int32_t obstacle, peri_obstacle_state *state);
int32_t peri_set_obstacle_state(peri_body *body, int32_t obstacle, const peri_obstacle_state *state);
void peri_contact_desc_init(peri_contact_desc *desc);
int32_t peri_set_contact(peri_body *body, int32_t i, int32_t j, const peri_contact_desc *desc);
void peri_advance_desc_init(peri_advance_desc *desc);
int32_t peri_advance(peri_body *body, const peri_advance_desc *desc);
void peri_evaluate_desc_init(peri_evaluate_desc *desc);
int32_t peri_evaluate(peri_body *body, const peri_evaluate_desc *desc, peri_evaluate_report *report);
void peri_solve_desc_init(peri_solve_desc *desc);
int32_t peri_solve(peri_body *body, const peri_solve_desc *desc, peri_solve_report *report);
int32_t peri_advance_implicit(peri_body *body, const peri_advance_desc *advance, const peri_solve_desc *solve, double rho, peri_solve_report *report);
int32_t peri_multiply_stiffness(peri_body *body, const double *in, double *out, int64_t count);
int32_t peri_multiply_stiffness_at(peri_body *body, const double *displacement, const double *in, double *out, int64_t count);
int32_t peri_matrix_create(peri_body *body, peri_matrix **matrix);
void peri_matrix_destroy(peri_matrix *matrix);
int64_t peri_matrix_rows(const peri_matrix *matrix);
int64_t peri_matrix_entries(const peri_matrix *matrix);
int32_t peri_get_matrix(const peri_matrix *matrix, int64_t *start, int32_t *column, double *value);
int32_t peri_export_matrix_to(const peri_matrix *matrix, peri_write_fn write, void *user);
int64_t peri_size_of_field(const peri_body *body, int32_t field);
int32_t peri_get_field(peri_body *body, int32_t field, double *out, int64_t capacity);
int32_t peri_set_field(peri_body *body, int32_t field, const double *in, int64_t count);
int32_t peri_view_field(peri_body *body, int32_t field, peri_view *view);
int32_t peri_get_field_at(peri_body *body, int32_t field, int64_t count, const int32_t *points, double *out, int64_t capacity);
int32_t peri_interpolate_field(peri_body *body, int32_t field, int32_t in_place, int64_t count, const double *places, double *out, int64_t capacity);
int64_t peri_size_of_bonds(const peri_body *body, int32_t set, int32_t bond);
int32_t peri_get_bonds(peri_body *body, int32_t set, int32_t bond, double *out, int64_t capacity);
int32_t peri_get_energy(peri_body *body, peri_energy *energy);
int32_t peri_get_momentum(peri_body *body, double *linear, double *angular);
void peri_cracks_desc_init(peri_cracks_desc *desc);
int32_t peri_cracks_create(peri_body *body, const peri_cracks_desc *desc, peri_cracks **cracks);
void peri_cracks_destroy(peri_cracks *cracks);
int64_t peri_cracks_paths(const peri_cracks *cracks);
int64_t peri_cracks_vertices(const peri_cracks *cracks);
int64_t peri_cracks_tips(const peri_cracks *cracks);
double peri_cracks_size(const peri_cracks *cracks);
int32_t peri_get_cracks(const peri_cracks *cracks, int64_t *start, double *vertex, double *time, peri_crack_tip *tip);
int32_t peri_export_cracks_to(const peri_cracks *cracks, peri_write_fn write, void *user);
int32_t peri_export_vtu_to(peri_body *body, peri_write_fn write, void *user);
int32_t peri_export_fields_to(peri_body *body, const int32_t *fields, int64_t count, peri_write_fn write, void *user);
int32_t peri_export_history_to(peri_body *body, int32_t header, peri_write_fn write, void *user);
int32_t peri_export_vtu(peri_body *body, const char *path);
int32_t peri_export_frame(peri_body *body, const char *path, int64_t frame, const int32_t *fields, int64_t count);
int32_t peri_export_history(peri_body *body, const char *path, int32_t append);
int32_t peri_save_state_to(peri_body *body, peri_write_fn write, void *user);
int32_t peri_load_state_from(peri_body *body, peri_read_fn read, void *user);
int32_t peri_save_state(peri_body *body, const char *path);
int32_t peri_load_state(peri_body *body, const char *path);
int32_t peri_get_memory(const peri_body *body, peri_memory *memory);
void peri_plan_desc_init(peri_plan_desc *desc);
int32_t peri_plan(const peri_plan_desc *desc, peri_plan_report *report, peri_error *error);
void peri_choose_desc_init(peri_choose_desc *desc);
int32_t peri_choose(const peri_choose_desc *desc, peri_body_desc *body, peri_material_desc *material, peri_choose_report *report, peri_error *error);
]]

local C = ffi.load(os.getenv("PERI") or "peri")
local peri = {
    VERSION = "0.2.0",
    VERSION_NUMBER = 2000,
    ALL = 268435456,
    BRITTLE = 2, -- success: as brittle bonds, the horizon being too large
    STOPPED = 1, -- a callback asked to stop; the body is at a whole step
    OK = 0, -- success
    ERROR_ARGUMENT = -1, -- missing, NULL or given twice, or a count that is wrong
    ERROR_CHOICE = -2, -- not a value of this enum, or a flag that is not 0 or 1
    ERROR_DESCRIPTOR = -3, -- not filled by its init function, or of another version
    ERROR_RANGE = -4, -- a number is not finite or outside the range of its field
    ERROR_ORDER = -5, -- too early, too late, or from a callback that may not
    ERROR_MEMORY = -6, -- the allocator returned NULL
    ERROR_TOO_LARGE = -7, -- more than the library or memory takes; see the value
    ERROR_CAPACITY = -8, -- the buffer has the wrong size; it needs the value
    ERROR_ID_NONE = -9, -- no id: zero, a plain number, or what a failed call returned
    ERROR_ID_KIND = -10, -- an id of another kind: of a load, say, not of a set
    ERROR_ID_BODY = -11, -- an id of another body
    ERROR_ID_GONE = -12, -- nothing has this id: it was removed, or never given
    ERROR_INDEX = -13, -- no point has this number
    ERROR_NAME = -14, -- a name that is taken, or that no set has
    ERROR_EMPTY = -15, -- the body, the shape or the selection holds no point
    ERROR_MATERIAL = -16, -- the material contradicts itself, or is missing
    ERROR_POISSON = -17, -- bond-based: Poisson's ratio is fixed; it is the value
    ERROR_LAW = -18, -- this law has no such thing, or cannot take this
    ERROR_CRITERION = -19, -- the criterion cannot act on this law, or lacks its G0
    ERROR_INFLUENCE = -20, -- the influence function or its moments are not finite
    ERROR_POINT = -21, -- a place not finite, no volume, or a cell that crosses itself
    ERROR_COINCIDENT = -22, -- two points are at the same place
    ERROR_HORIZON = -23, -- the horizon is smaller than the spacing of the points
    ERROR_FAMILY = -24, -- a point has no neighbour, or none with a weight
    ERROR_IBOND = -25, -- given families: wrong number, not mutual, not of the horizon
    ERROR_CRACK = -26, -- the crack has no extent, or is not for this space
    ERROR_PAIR = -27, -- the two points share no bond
    ERROR_FIELD = -28, -- this field cannot be used in this way: it is not stored
    ERROR_AREA = -29, -- the points feel another area than that of the face
    ERROR_STEP = -30, -- the time step exceeds the stable step, which is the value
    ERROR_UNSTABLE = -31, -- a point passed 1e9 speeds of sound: step, load or start
    ERROR_CALLBACK = -32, -- a callback failed, or wrote what is not finite
    ERROR_LOOSE = -33, -- no support holds this part against some motion
    ERROR_INDEFINITE = -34, -- the tangent is not positive: buckling or softening
    ERROR_CONVERGENCE = -35, -- no equilibrium within the iterations; value: residual
    ERROR_WRITE = -36, -- the file or the write callback failed
    ERROR_LEFT_OUT = -37, -- left out of this build, by the switch that the field names
    ERROR_STATE = -38, -- no saved state of such a body, or damaged; value: the byte
    ERROR_PART = -39, -- not of a part of a body; or its ghosts are not as owned
    KIND_MATERIAL = 2201,
    KIND_SET = 2202,
    KIND_LOAD = 2203, -- supports included
    KIND_OBSTACLE = 2204,
    SPACE_PLANE_STRESS = 101, -- 2D, thin plate; bond-based: Poisson's ratio 1/3
    SPACE_PLANE_STRAIN = 102, -- 2D, long prism; bond-based: 1/4
    SPACE_SOLID = 103, -- 3D; bond-based: 1/4
    PRECISION_DOUBLE = 201,
    PRECISION_MIXED = 202, -- state in double, bonds in single: strain to 7 digits
    PRECISION_SINGLE = 203, -- faster, 0.65 of the memory; strains below 1e-6 lose digits
    GEOMETRY_NONLINEAR = 301, -- e = |xi+eta| - |xi|, force along xi+eta ([T] 1.23)
    GEOMETRY_LINEAR = 302, -- e = xi.eta/|xi|, force along xi: small motion ([T] 1.37)
    INFLUENCE_CONSTANT = 401, -- 1, also beyond [P] w0, [C] Const
    INFLUENCE_CUTOFF = 402, -- 1, beyond 0 [P] w0.5
    INFLUENCE_LINEAR = 403, -- 1 - q, beyond 0 [P] w1, [C] Linear
    INFLUENCE_CUBIC = 404, -- 1 - 3q^2 + 2q^3, beyond 0 [P] w3
    INFLUENCE_QUINTIC = 405, -- 1 - 10q^3 + 15q^4 - 6q^5, beyond 0 [P] w5
    INFLUENCE_SEPTIC = 406, -- 1 - 35q^4 + 84q^5 - 70q^6 + 20q^7, beyond 0 [P] w7
    INFLUENCE_POWER_2 = 407, -- (1 - q)^2, beyond 0 [C] Quadr
    INFLUENCE_POWER_3 = 408, -- (1 - q)^3, beyond 0 [C] Cubic
    INFLUENCE_GAUSSIAN = 409, -- exp(-q^2), also beyond [T]
    INFLUENCE_PROPORTIONAL = 410, -- q, also beyond [T]
    INFLUENCE_INVERSE = 411, -- 1/q, also beyond [T], [C] Inv
    INFLUENCE_INVERSE_4 = 412, -- q^-4, also beyond; no finite moments [T]
    INFLUENCE_POLE_EDGE = 413, -- 1/(1 + spacing/(2 horizon) - q) [T]
    INFLUENCE_POLE_HALF = 414, -- 1/|2q - 1|, also beyond; no finite moments [T]
    INFLUENCE_POLE_QUARTER = 415, -- exp(1/(q - 1/4)), also beyond; no moments; [T] in mm
    INFLUENCE_USER = 416, -- influence_fn
    QUADRATURE_FULL = 501, -- cells whose centre is within, whole [P] FA
    QUADRATURE_RAMP = 502, -- from 1 to 0 over horizon -+ spacing/2 [T] Fig. 3.7
    QUADRATURE_PARTIAL = 503, -- the exact part within the horizon [P] PA-AC
    QUADRATURE_PARTIAL_CENTROID = 504, -- 2D, to its centroid [P] IPA-AC: for comparison
    QUADRATURE_PARTIAL_MOMENT = 505, -- 2D, the centroid's energy, objective
    BREAK_WITHIN_STEP = 601, -- a bond acts until it meets its criterion; error O(dt^2)
    BREAK_AFTER_DRIFT = 602, -- until the middle of the step [P]; ledger error O(dt)
    CORRECTION_NONE = 701, -- the constants of an infinite body
    CORRECTION_VOLUME = 702, -- bond-based, by volumes (Le, Bobaru 2018): for comparison
    CORRECTION_ENERGY = 703, -- bond-based: right energy of isotropic strain and mean shear
    CORRECTION_MOMENT = 704, -- weights, as little as makes uniform strain exact on lattices
    CORRECTION_EQUILIBRIUM = 705, -- and in equilibrium inside on any cloud; not of parts
    MOMENTS_LIVE = 2501, -- those left: they take over what others carried
    MOMENTS_WHOLE = 2502, -- all, broken and cut ones included
    KERNEL_BEST = 801, -- columns on lattices where that serves, else a list
    KERNEL_REFERENCE = 802, -- every quantity by its formula, bond by bond: slow
    KERNEL_LIST = 803, -- the list of families, as clouds have it
    INSTRUCTIONS_BEST = 901, -- of the machine
    INSTRUCTIONS_BASELINE = 902, -- SSE2
    INSTRUCTIONS_AVX2 = 903,
    INSTRUCTIONS_AVX512 = 904, -- F, VL, DQ and BW
    LAW_BOND_BASED = 1001, -- t = 1/2 c w s, s = e/|xi|: PMB, generalised [P] A, [T] 1.23
    LAW_LPS = 1002, -- t = (w/m)(A theta |xi| + B e) [T] 1.54, 1.67, [C] 2-7
    LAW_OTERKUS = 1003, -- t = 2 w (a d theta + b e), on each family [C] 8-17
    LAW_CORRESPONDENCE = 1004, -- T = w P K^-1 xi, stabilised [C] 18-21
    CRITERION_STRETCH = 1101, -- s > s0 [T] 1.40, 1.41
    CRITERION_BOND_ENERGY = 1102, -- state-based: work on the bond > w0 [T] 1.100
    CRITERION_NODE_ENERGY = 1103, -- state-based: mean energy of both ends > w0 [T] 1.102
    CRITERION_PRINCIPAL_STRESS = 1104, -- tension along the bond > strength
    CRITERION_VON_MISES = 1105, -- von Mises's > strength; shortened bonds, too
    CRITERION_MOHR_COULOMB = 1106, -- shear > cohesion - tan(friction_angle) normal
    CRITERION_CONFINED_STRETCH = 1107, -- s > s0 - compression * least s at either end
    CRITERION_RATE_STRETCH = 1108, -- s > s0 (1 + (ds/dt / rate)^rate_power)
    CRITERION_DELAYED_STRETCH = 1109, -- s > s0 for `delay` in all
    SOFTENING_BILINEAR = 2901, -- straight
    SOFTENING_TRILINEAR = 2902, -- kinked at 1/4 of the strength: concrete
    SOFTENING_EXPONENTIAL = 2903, -- cut off at 1/100 of the strength
    SOFTENING_TABLE = 2904, -- a table of yours
    UNLOADING_SECANT = 3001, -- to the origin: damage
    UNLOADING_ELASTIC = 3002, -- as stiff as new: a stretch stays
    REDUCTION_SUM = 3901,
    REDUCTION_MAX = 3902,
    CUT_INITIAL = 2101, -- an initial crack: stays at peri_reset. Only before the first step
    CUT_NOW = 2102, -- counts as broken, whole again at peri_reset
    CUT_IN_PLACE = 2103, -- as PERI_CUT_NOW, where the body is now: by current positions
    AXIS_X = 4097,
    AXIS_Y = 4098,
    AXIS_Z = 4100,
    AXIS_XY = 4099,
    AXIS_XYZ = 4103,
    SHAPE_PLANE = 2601, -- all behind the plane through 0 with `normal`
    SHAPE_BALL = 2602, -- radius; 2D: a disc
    SHAPE_BOX = 2603, -- size, about 0
    SHAPE_CAPSULE = 2604, -- within radius of a line of `length` along `axis`, about 0
    SHAPE_CYLINDER = 2605, -- 3D: the same with flat ends
    SHAPE_MESH = 2606, -- within the closed surface of vertices and faces
    SHAPE_DISTANCE = 2607, -- where `distance` is below 0
    INTEGRATOR_VELOCITY_VERLET = 1201, -- half kick, drift, force, half kick [T] 2.2
    INTEGRATOR_CENTRAL_DIFFERENCE = 1202, -- one kick per step, the same motion [L], [T] 2.10
    METHOD_NEWTON = 1301, -- conjugate gradients on the tangent, never stored
    METHOD_BICGSTAB = 1302, -- on the assembled tangent ([T] 3.2): for comparison
    METHOD_RELAXATION = 1303, -- adaptive dynamic relaxation: slow, any tangent
    PRECONDITIONER_MULTILEVEL = 1401, -- blocks, and elasticity on background grids
    PRECONDITIONER_BLOCK_JACOBI = 1402, -- the dim x dim blocks of the diagonal
    PRECONDITIONER_NONE = 1403,
    LOOSE_REFUSED = 1501, -- PERI_ERROR_LOOSE, index: a point of it; see lost_parts
    LOOSE_PINNED = 1502, -- just enough is held; exact where loads balance
    LOOSE_BALANCED = 1503, -- the part of the loads that drives the mode is left out
    CONTROL_LOAD = 2801, -- the load steps
    CONTROL_FRACTURE = 2802, -- where the next bond meets its criterion: through snap-back
    ENDED_LOAD = 2701, -- load_to is reached
    ENDED_SEVERED = 2702, -- a part that bears a load or a support broke off
    ENDED_BREAKS = 2703,
    ENDED_STOPPED = 2704,
    FIELD_POSITION = 2001, -- S [dim] reference position [L]
    FIELD_DISPLACEMENT = 2002, -- SW [dim] [L]
    FIELD_VELOCITY = 2003, -- SW [dim] [L T^-1]
    FIELD_FORCE_DENSITY = 2004, -- S [dim] internal, loads, obstacles, contact
    FIELD_VOLUME = 2005, -- S [L^3]; planes: area [L^2]
    FIELD_MATERIAL = 2006, -- PERI_ID_INDEX of the material
    FIELD_FAMILY_SIZE = 2007, -- bonds of the point, broken ones included
    FIELD_DAMAGE = 2008, -- 1 - intact/all volume of the family [-] [L]
    FIELD_DAMAGE_GROWN = 2009, -- the same among bonds that are not initial cracks
    FIELD_ENERGY_DENSITY = 2010, -- elastic W of the law [M L^-1 T^-2] [P] eq. 7
    FIELD_CURRENT_POSITION = 2011, -- [dim] [L]
    FIELD_DILATATION = 2012, -- theta of the law [-]
    FIELD_STRAIN = 2013, -- [tensor] of F: small, or Green-Lagrange [T] 4.14
    FIELD_STRESS = 2014, -- [tensor] Cauchy, of the material [M L^-1 T^-2]
    FIELD_FORCE_STRESS = 2015, -- [tensor] Cauchy, what the bonds carry [T] 4.10, 4.13
    FIELD_REACTION = 2016, -- [dim] force density of supports, mean of the last step
    FIELD_FRAGMENT = 2017, -- peri_find_fragments
    FIELD_MASS = 2018, -- [M]; planes: thickness included
    FIELD_DENSITY = 2019, -- W [M L^-3] Default: of the material
    FIELD_HELD = 2020, -- [dim] 1: a support prescribes it; else 0
    FIELD_EIGENSTRAIN = 2021, -- W stretch at no force [-] -0.9..10. Default 0
    FIELD_STRENGTH = 2022, -- W times s0, squared times w0 [-] 1e-6..1e6. Default 1
    FIELD_STIFFNESS = 2023, -- W times E [-] 1e-6..1e6. Default 1
    FIELD_DEFORMATION_GRADIENT = 2024, -- [dim*dim] F by rows
    TYPE_F64 = 1601,
    TYPE_F32 = 1602,
    TYPE_I32 = 1603,
    BOND_POINT = 4001, -- i
    BOND_OTHER = 4002, -- j
    BOND_LENGTH = 4003, -- |xi| [L]
    BOND_VOLUME = 4004, -- beta V_j [L^3]
    BOND_WEIGHT = 4005, -- w beta V_j, corrected
    BOND_INTACT = 4006, -- 1 or 0
    BOND_STRETCH = 4007, -- [-]
    BOND_FORCE = 4008, -- [dim] part of the force density of i
    BOND_ENERGY = 4009, -- and of the energy density
    SOURCE_BOX = 1701, -- peri_add_box
    SOURCE_PERTURBED = 1702, -- peri_add_perturbed_box
    SOURCE_POINTS = 1703, -- peri_add_points: a cloud, about one point to a cell
    QUANTITY_DEFORMATION = 1801, -- stiffness; the least thickness that carries
    QUANTITY_STRESS = 1802, -- around holes and notches; the radius
    QUANTITY_WAVES = 1803, -- their way; the shortest wavelength
    QUANTITY_FRACTURE = 1804, -- when cracks grow; the crack's length, 8 spacings or more
    PRESET_NONE = 1901,
    PRESET_GAME = 1902, -- 20 %
    PRESET_TEACHING = 1903, -- 10 %
    PRESET_ENGINEERING = 1904, -- 5 %
    PRESET_REFERENCE = 1905, -- deformation 1 %, stress 2 %, waves and fracture 3 %
}

-- ---- errors

local Error = {}
Error.__index = Error
Error.__tostring = function(e) return e.text end

local pending -- what a function of yours has raised, until the call that it came from has ended

local function guard(f)
    return function(...)
        local good, result = pcall(f, ...)
        if good then return result == true and 1 or tonumber(result) or 0 end
        pending = pending or { result }
        return -1
    end
end

local function raise(record)
    local text = ffi.new("char[300]")
    C.peri_format_error(record, text, 300)
    error(setmetatable({ status = record[0].code, field = ffi.string(record[0].field), index = tonumber(record[0].index),
        value = record[0].value, text = ffi.string(text) }, Error), 0)
end

local function blank(status, field)
    local record = ffi.new("peri_error[1]")
    record[0].code, record[0].index, record[0].field, record[0].text = status, -1, field, C.peri_status_text(status)
    return record
end

local function refuse(field) raise(blank(-1, field)) end

local function check(result, record, body)
    if pending then
        local raised = pending
        pending = nil
        error(raised[1], 0)
    end
    result = tonumber(result)
    if result < 0 then
        if body then
            record = blank(0, "")
            C.peri_get_error(body, record)
        end
        if not record or record[0].code ~= result then record = blank(result, "") end
        raise(record)
    end
    return result
end

-- ---- arrays

local sizes = { double = 8, int32_t = 4, int64_t = 8, peri_fragment = ffi.sizeof("peri_fragment"), peri_crack_tip = ffi.sizeof("peri_crack_tip") }

function peri.doubles(n) return ffi.new("double[?]", n) end
function peri.integers(n) return ffi.new("int32_t[?]", n) end

-- an array of the FFI and its entries, of a table or as it is
local function array(kind, given, field)
    if type(given) == "table" then
        local made = ffi.new(kind .. "[?]", math.max(#given, 1))
        for k = 1, #given do made[k - 1] = given[k] end
        return made, #given
    end
    if type(given) ~= "cdata" then refuse(field) end
    return given, ffi.sizeof(given) / (sizes[kind] or ffi.sizeof(kind))
end

local function sized(has, needs, field)
    if has ~= needs then refuse(field) end
end

local function text(given) return given ~= nil and ffi.string(given) or "" end

-- ---- descriptions: fields of C, and functions of yours in the place of callbacks

local function wrap(kind, raw, calls)
    local functions, anchors = {}, {}
    return setmetatable({}, {
        kind = kind,
        raw = raw,
        functions = functions,
        __index = function(_, name)
            if calls[name] then return functions[name] end
            return raw[0][name]
        end,
        __newindex = function(_, name, value)
            if calls[name] then
                functions[name] = value
            elseif type(value) == "table" and getmetatable(value) and getmetatable(value).raw then
                anchors[name], raw[0][name] = value, getmetatable(value).raw
            elseif type(value) == "table" then
                local to = raw[0][name]
                if tostring(ffi.typeof(to)):find("[", 1, true) then
                    for k = 1, #value do to[k - 1] = value[k] end
                else
                    local kind_of = tostring(ffi.typeof(to)):find("int", 1, true) and "int32_t" or "double"
                    anchors[name] = array(kind_of, value, name)
                    raw[0][name] = anchors[name]
                end
            else
                anchors[name], raw[0][name] = value, value
            end
        end,
    })
end

local function plain(desc, kind)
    local meta = getmetatable(desc)
    if type(desc) ~= "table" or not meta or meta.kind ~= kind then refuse("desc") end
    return meta.raw, meta.functions
end

-- functions that a body and its clones keep
local function keeper()
    local all = {}
    all.sentinel = ffi.gc(ffi.new("char[1]"), function()
        for k = 1, #all do all[k]:free() end
    end)
    return all
end

local function free(all)
    for k = 1, #all do all[k]:free() end
end

-- peri_body_desc, filled with the defaults: space, precision, geometry, influence, quadrature, correction, break_timing, moments,
-- kernel, instructions, threads, ledger, number, horizon, thickness, influence_fn, allocate, release, parallel_for, log.
function peri.body_desc()
    local raw = ffi.new("peri_body_desc[1]")
    C.peri_body_desc_init(raw)
    return wrap("peri_body_desc", raw, { influence_fn = true, log = true })
end

-- peri_material_desc, filled with the defaults: law, criterion, young, bulk, poisson, density, fracture_energy, critical_stretch,
-- stabilization, strength, cohesion, friction_angle, compression, rate, rate_power, delay, yield_shear, relaxations, history,
-- relaxation_part, relaxation_time, stress.
function peri.material_desc(law)
    local raw = ffi.new("peri_material_desc[1]")
    C.peri_material_desc_init(raw, law)
    return wrap("peri_material_desc", raw, { stress = true })
end

-- peri_softening_desc, filled with the defaults: shape, unloading, strength, fracture_energy, compression, count, table.
function peri.softening_desc(shape)
    local raw = ffi.new("peri_softening_desc[1]")
    C.peri_softening_desc_init(raw, shape)
    return wrap("peri_softening_desc", raw, {})
end

-- peri_cells_desc, filled with the defaults: vertex_count, vertices, vertex_stride, cell_count, corners, offsets, cell_corners,
-- materials. Cells: polygons, convex or not; tetrahedra, pyramids, wedges, hexahedra (4, 5, 6, 8 corners) in VTK's order, or
-- mirrored.
function peri.cells_desc()
    local raw = ffi.new("peri_cells_desc[1]")
    C.peri_cells_desc_init(raw)
    return wrap("peri_cells_desc", raw, {})
end

-- peri_part_desc, filled with the defaults: origin, length, mean_volume, ghost_count, ghosts, owners, ids, exchange, reduce. Ghosts:
-- copies of points that other parts own, peri_ghost_depth horizons deep. They bear no load and are in no set, sum or count. Give
-- them all else that their owners have: cuts, motion.
function peri.part_desc()
    local raw = ffi.new("peri_part_desc[1]")
    C.peri_part_desc_init(raw)
    return wrap("peri_part_desc", raw, { exchange = true, reduce = true })
end

-- peri_obstacle_desc, filled with the defaults: shape, place, turn, normal, axis, radius, length, size, vertex_count, face_count,
-- vertices, faces, distance, stiffness, friction, friction_speed, restitution, mass, density, inertia, velocity, spin, gravity,
-- motion. Pushes points within it out along the normal by stiffness*depth [M L^-2 T^-2]. A free one (of a mass) is moved by that and
-- by gravity, not by other obstacles.
function peri.obstacle_desc(shape)
    local raw = ffi.new("peri_obstacle_desc[1]")
    C.peri_obstacle_desc_init(raw, shape)
    return wrap("peri_obstacle_desc", raw, { distance = true, motion = true })
end

-- peri_contact_desc, filled with the defaults: stiffness, distance, friction, friction_speed, restitution. Unbonded surface points:
-- 1/2 k (d - r)^2 where r < d = min(distance, |xi|), k = stiffness E V /(spacing distance)
function peri.contact_desc()
    local raw = ffi.new("peri_contact_desc[1]")
    C.peri_contact_desc_init(raw)
    return wrap("peri_contact_desc", raw, {})
end

-- peri_advance_desc, filled with the defaults: integrator, force_step, steps, duration, time_step, safety, damping, load_factor,
-- frame_steps, on_frame.
function peri.advance_desc()
    local raw = ffi.new("peri_advance_desc[1]")
    C.peri_advance_desc_init(raw)
    return wrap("peri_advance_desc", raw, { on_frame = true })
end

-- peri_evaluate_desc, filled with the defaults: type, nodal, bonds, external, fracture, energy, point_stride, component_stride,
-- displacement, velocity, time_step, time, load_factor, force, impulse.
function peri.evaluate_desc()
    local raw = ffi.new("peri_evaluate_desc[1]")
    C.peri_evaluate_desc_init(raw)
    return wrap("peri_evaluate_desc", raw, {})
end

-- peri_solve_desc, filled with the defaults: method, preconditioner, loose, fracture, control, curve_load, keep, criticality,
-- tolerance, energy_tolerance, iterations, newton, breaks, load_from, load_to, steps, duration, halvings, curve, curve_rows,
-- on_iteration, on_step.
function peri.solve_desc()
    local raw = ffi.new("peri_solve_desc[1]")
    C.peri_solve_desc_init(raw)
    return wrap("peri_solve_desc", raw, { on_iteration = true, on_step = true })
end

-- peri_cracks_desc, filled with the defaults: initial, current, shortest.
function peri.cracks_desc()
    local raw = ffi.new("peri_cracks_desc[1]")
    C.peri_cracks_desc_init(raw)
    return wrap("peri_cracks_desc", raw, {})
end

-- peri_plan_desc, filled with the defaults: body, material, source, measure, amount, lo, hi, spacing. a body that is only described:
-- one material in a box
function peri.plan_desc()
    local raw = ffi.new("peri_plan_desc[1]")
    C.peri_plan_desc_init(raw)
    return wrap("peri_plan_desc", raw, {})
end

-- peri_choose_desc, filled with the defaults: preset, quantity, error, seconds, bytes, feature, lo, hi. a preset, or an error, at
-- least cost; or a budget; or both
function peri.choose_desc()
    local raw = ffi.new("peri_choose_desc[1]")
    C.peri_choose_desc_init(raw)
    return wrap("peri_choose_desc", raw, {})
end

function peri.version() return C.peri_version() end
function peri.status_text(status) return text(C.peri_status_text(status)) end
function peri.struct(kind) return ffi.new("peri_" .. kind) end -- all zero: peri.struct "obstacle_state"

-- A field in place: component k of point i, in your units.
function peri.at(view, i, k)
    local kinds = { [1601] = "const double *", [1602] = "const float *", [1603] = "const int32_t *" }
    local data = ffi.cast(kinds[view.type], view.data)
    return view.offset[k < 3 and k or 0] + view.scale * data[i * tonumber(view.point_stride) + k * tonumber(view.component_stride)]
end

local Body = {}
Body.__index = Body
peri.Body = Body
local function own_body(handle, second)
    return setmetatable({ handle = ffi.gc(handle, C.peri_body_destroy), keep = second }, Body)
end
-- Frees it at once; else the collector does.
function Body:destroy()
    if self.handle ~= nil then
        C.peri_body_destroy(ffi.gc(self.handle, nil))
        self.handle = nil
    end
end

local Cracks = {}
Cracks.__index = Cracks
peri.Cracks = Cracks
local function own_cracks(handle, second)
    return setmetatable({ handle = ffi.gc(handle, C.peri_cracks_destroy), dim = second }, Cracks)
end
-- Frees it at once; else the collector does.
function Cracks:destroy()
    if self.handle ~= nil then
        C.peri_cracks_destroy(ffi.gc(self.handle, nil))
        self.handle = nil
    end
end

local Matrix = {}
Matrix.__index = Matrix
peri.Matrix = Matrix
local function own_matrix(handle, second)
    return setmetatable({ handle = ffi.gc(handle, C.peri_matrix_destroy), dim = second }, Matrix)
end
-- Frees it at once; else the collector does.
function Matrix:destroy()
    if self.handle ~= nil then
        C.peri_matrix_destroy(ffi.gc(self.handle, nil))
        self.handle = nil
    end
end

-- *body is NULL on failure. error may be NULL.
function peri.body_create(desc)
    local keep = keeper()
    local desc_c, desc_f
    desc_c, desc_f = plain(desc, "peri_body_desc")
    if desc_f.influence_fn then
        local call = desc_f.influence_fn
        keep[#keep + 1] = ffi.cast("peri_influence_fn", guard(function(_, q, w) return call(q, w) end))
        desc_c[0].influence_fn = keep[#keep]
    end
    if desc_f.log then
        local call = desc_f.log
        keep[#keep + 1] = ffi.cast("peri_log_fn", function(...) guard(function(_, level, text) return call(level, text(text)) end)(...) end)
        desc_c[0].log = keep[#keep]
    end
    local made = ffi.new("peri_body *[1]")
    local record = blank(0, "")
    local result = C.peri_body_create(desc_c, made, record)
    desc_c[0].influence_fn = nil
    desc_c[0].log = nil
    check(result, record)
    return own_body(made[0], keep)
end

-- An independent copy of a built body, state, loads and number included: ids hold in both. Points, families and weights are shared.
-- error may be NULL.
function Body:clone()
    local keep = self.keep
    local made = ffi.new("peri_body *[1]")
    local record = blank(0, "")
    local result = C.peri_body_clone(self.handle, made, record)
    check(result, record)
    return own_body(made[0], keep)
end

-- After a callback was left by longjmp or an exception: ends the call that it came from, and frees its memory. The body may then be
-- read, reset or destroyed; it runs again after peri_reset. Never from within a callback. PERI_ERROR_ORDER where none was left.
-- Memory hooks, job systems and what a measuring peri_plan calls may not be left so.
function Body:unlock()
    local result = C.peri_unlock(self.handle)
    return check(result, nil, self.handle)
end

-- The id of the index-th (1, 2, ...) thing of a peri_kind, removed ones counted; or an error.
function Body:id(kind, index)
    local result = C.peri_id(self.handle, kind, index)
    return check(result, nil, self.handle)
end

-- Adds a material, before peri_build; at most 120. Returns its id, or an error.
function Body:add_material(desc)
    local keep = self.keep
    local desc_c, desc_f
    desc_c, desc_f = plain(desc, "peri_material_desc")
    if desc_f.stress then
        local call = desc_f.stress
        keep[#keep + 1] = ffi.cast("peri_stress_fn", guard(function(_, block) return call(block) end))
        desc_c[0].stress = keep[#keep]
    end
    local result = C.peri_add_material(self.handle, desc_c)
    desc_c[0].stress = nil
    return check(result, nil, self.handle)
end

-- Bonds between i and j break, and of bond-based i and j act, as if of `desc`, before peri_build; its law is that of one of them,
-- not bond-based unless both are. Default: harmonic mean of the micromoduli, the criteria of both.
function Body:set_interface(i, j, desc)
    local keep = self.keep
    local desc_c, desc_f
    desc_c, desc_f = plain(desc, "peri_material_desc")
    if desc_f.stress then
        local call = desc_f.stress
        keep[#keep + 1] = ffi.cast("peri_stress_fn", guard(function(_, block) return call(block) end))
        desc_c[0].stress = keep[#keep]
    end
    local result = C.peri_set_interface(self.handle, i, j, desc_c)
    desc_c[0].stress = nil
    return check(result, nil, self.handle)
end

-- Bonds between bond-based materials i and j (i, i: within one) soften, before peri_build; their fracture_energy and
-- critical_stretch do not count. PERI_BRITTLE: the horizon is too large, bonds break at once at less than the strength and take the
-- energy. docs/laws.md
function Body:set_softening(i, j, desc)
    local desc_c
    desc_c = plain(desc, "peri_softening_desc")
    local result = C.peri_set_softening(self.handle, i, j, desc_c)
    return check(result, nil, self.handle)
end

-- The stretch at which bonds begin to soften, and that at which they break; after peri_build. PERI_BRITTLE: they are one. Either may
-- be NULL.
function Body:get_softening(i, j, first, last)
    local first_c, first_n = nil, 0
    if first ~= nil then first_c, first_n = array("double", first, "first") end
    if first ~= nil then sized(first_n, 1, "first") end
    local last_c, last_n = nil, 0
    if last ~= nil then last_c, last_n = array("double", last, "last") end
    if last ~= nil then sized(last_n, 1, "last") end
    local result = C.peri_get_softening(self.handle, i, j, first_c, last_c)
    return check(result, nil, self.handle)
end

-- Bonds between bond-based materials i and j follow fn, each with `states` (0..8) numbers of its own, 0 at first; before peri_build.
-- Their critical stretch holds, too. docs/laws.md
function Body:set_bond_law(i, j, states, fn)
    local keep = self.keep
    local fn_c = nil
    if fn then
        keep[#keep + 1] = ffi.cast("peri_bond_law_fn", guard(function(_, row) return fn(row) end))
        fn_c = keep[#keep]
    end
    local result = C.peri_set_bond_law(self.handle, i, j, states, fn_c, nil)
    return check(result, nil, self.handle)
end

-- Micromodulus c [M L^-5 T^-2] (bond-based only, else NULL) and critical stretch s0 [-] (HUGE_VAL: never; softening: where they
-- break, after peri_build) of bonds between materials i and j. Either may be NULL. ([P] C.15-C.20, [T] 1.24, 1.40)
function Body:get_bond_constants(i, j, c, s0)
    local c_c, c_n = nil, 0
    if c ~= nil then c_c, c_n = array("double", c, "c") end
    if c ~= nil then sized(c_n, 1, "c") end
    local s0_c, s0_n = nil, 0
    if s0 ~= nil then s0_c, s0_n = array("double", s0, "s0") end
    if s0 ~= nil then sized(s0_n, 1, "s0") end
    local result = C.peri_get_bond_constants(self.handle, i, j, c_c, s0_c)
    return check(result, nil, self.handle)
end

-- Critical bond energy w0 [M L^-4 T^-2] of a material whose criterion is an energy; HUGE_VAL: none. PERI_CRITERION_NODE_ENERGY:
-- after peri_build.
function Body:get_critical_energy(material, w0)
    local w0_c, w0_n = nil, 0
    w0 = w0 or ffi.new("double[?]", 1)
    if w0 ~= nil then w0_c, w0_n = array("double", w0, "w0") end
    sized(w0_n, 1, "w0")
    local result = C.peri_get_critical_energy(self.handle, material, w0_c)
    check(result, nil, self.handle)
    return tonumber(w0[0])
end

-- The box lo[dim]..hi[dim] in cells of about `spacing` [L], which tile it.
function Body:add_box(material, lo, hi, spacing)
    local lo_c, lo_n = nil, 0
    if lo ~= nil then lo_c, lo_n = array("double", lo, "lo") end
    sized(lo_n, self:dimension(), "lo")
    local hi_c, hi_n = nil, 0
    if hi ~= nil then hi_c, hi_n = array("double", hi, "hi") end
    sized(hi_n, self:dimension(), "hi")
    local result = C.peri_add_box(self.handle, material, lo_c, hi_c, spacing)
    return check(result, nil, self.handle)
end

-- The box in cells[dim] cells per axis.
function Body:add_grid(material, lo, hi, cells)
    local lo_c, lo_n = nil, 0
    if lo ~= nil then lo_c, lo_n = array("double", lo, "lo") end
    sized(lo_n, self:dimension(), "lo")
    local hi_c, hi_n = nil, 0
    if hi ~= nil then hi_c, hi_n = array("double", hi, "hi") end
    sized(hi_n, self:dimension(), "hi")
    local cells_c, cells_n = nil, 0
    if cells ~= nil then cells_c, cells_n = array("int32_t", cells, "cells") end
    sized(cells_n, self:dimension(), "cells")
    local result = C.peri_add_grid(self.handle, material, lo_c, hi_c, cells_c)
    return check(result, nil, self.handle)
end

-- The lattice cells whose centre is within `radius` of `centre`: a ball, in 2D a disc.
function Body:add_ball(material, centre, radius, spacing)
    local centre_c, centre_n = nil, 0
    if centre ~= nil then centre_c, centre_n = array("double", centre, "centre") end
    sized(centre_n, self:dimension(), "centre")
    local result = C.peri_add_ball(self.handle, material, centre_c, radius, spacing)
    return check(result, nil, self.handle)
end

-- The lattice cells of the box whose centre `inside` takes.
function Body:add_shape(material, lo, hi, spacing, inside)
    local here = {}
    local lo_c, lo_n = nil, 0
    if lo ~= nil then lo_c, lo_n = array("double", lo, "lo") end
    sized(lo_n, self:dimension(), "lo")
    local hi_c, hi_n = nil, 0
    if hi ~= nil then hi_c, hi_n = array("double", hi, "hi") end
    sized(hi_n, self:dimension(), "hi")
    local inside_c = nil
    if inside then
        here[#here + 1] = ffi.cast("peri_point_fn", guard(function(_, index, x) return inside(tonumber(index), x) end))
        inside_c = here[#here]
    end
    local result = C.peri_add_shape(self.handle, material, lo_c, hi_c, spacing, inside_c, nil)
    free(here)
    return check(result, nil, self.handle)
end

-- peri_add_box, interior vertices moved by up to `amount` (0..1) quarters of a cell ([P] B).
function Body:add_perturbed_box(material, lo, hi, spacing, amount, seed)
    local lo_c, lo_n = nil, 0
    if lo ~= nil then lo_c, lo_n = array("double", lo, "lo") end
    sized(lo_n, self:dimension(), "lo")
    local hi_c, hi_n = nil, 0
    if hi ~= nil then hi_c, hi_n = array("double", hi, "hi") end
    sized(hi_n, self:dimension(), "hi")
    local result = C.peri_add_perturbed_box(self.handle, material, lo_c, hi_c, spacing, amount, seed)
    return check(result, nil, self.handle)
end

-- Points of yours: positions[count*dim] [L], volumes[count] [L^3] (planes: areas [L^2]), materials[count] (ids), or NULL where the
-- body has one material.
function Body:add_points(positions, volumes, materials)
    local positions_c, positions_n = nil, 0
    if positions ~= nil then positions_c, positions_n = array("double", positions, "positions") end
    sized(positions_n, volumes_n*self:dimension(), "positions")
    local volumes_c, volumes_n = nil, 0
    if volumes ~= nil then volumes_c, volumes_n = array("double", volumes, "volumes") end
    local materials_c, materials_n = nil, 0
    if materials ~= nil then materials_c, materials_n = array("int32_t", materials, "materials") end
    if materials ~= nil then sized(materials_n, volumes_n, "materials") end
    local result = C.peri_add_points(self.handle, volumes_n, positions_c, volumes_c, materials_c)
    return check(result, nil, self.handle)
end

-- Each is a point at its centroid, with its volume; partial volumes are exact.
function Body:add_cells(desc)
    local desc_c
    desc_c = plain(desc, "peri_cells_desc")
    local result = C.peri_add_cells(self.handle, desc_c)
    return check(result, nil, self.handle)
end

-- Families of yours instead of a search: ibond[points*width] as in [T] 3.11, row i padded with i. Membership must be mutual. Weights
-- are computed as for found families, of whose horizon they must be.
function Body:set_families(width, ibond)
    local ibond_c, ibond_n = nil, 0
    if ibond ~= nil then ibond_c, ibond_n = array("int32_t", ibond, "ibond") end
    sized(ibond_n, self:point_count()*width, "ibond")
    local result = C.peri_set_families(self.handle, width, ibond_c)
    return check(result, nil, self.handle)
end

-- After the points, before peri_build. All parts make the same calls.
function Body:set_part(desc)
    local keep = self.keep
    local desc_c, desc_f
    desc_c, desc_f = plain(desc, "peri_part_desc")
    if desc_f.exchange then
        local call = desc_f.exchange
        keep[#keep + 1] = ffi.cast("peri_exchange_fn", guard(function(_, type, planes, plane) return call(type, planes, plane) end))
        desc_c[0].exchange = keep[#keep]
    end
    if desc_f.reduce then
        local call = desc_f.reduce
        keep[#keep + 1] = ffi.cast("peri_reduce_fn", guard(function(_, reduction, count, values) return call(reduction, tonumber(count), values) end))
        desc_c[0].reduce = keep[#keep]
    end
    local result = C.peri_set_part(self.handle, desc_c)
    desc_c[0].exchange = nil
    desc_c[0].reduce = nil
    return check(result, nil, self.handle)
end

-- 1 or 2, before peri_build; the deepest that its materials need.
function Body:ghost_depth()
    local result = C.peri_ghost_depth(self.handle)
    return check(result, nil, self.handle)
end

-- H[dim*dim] [-] by rows: images have their owner's displacement + H (distance). Default 0
function Body:set_mean_gradient(gradient)
    local gradient_c, gradient_n = nil, 0
    if gradient ~= nil then gradient_c, gradient_n = array("double", gradient, "gradient") end
    sized(gradient_n, self:dimension(), "gradient")
    local result = C.peri_set_mean_gradient(self.handle, gradient_c)
    return check(result, nil, self.handle)
end

-- Of the cells of peri_add_box those from first[dim] to before last[dim].
function Body:add_box_part(material, lo, hi, spacing, first, last)
    local lo_c, lo_n = nil, 0
    if lo ~= nil then lo_c, lo_n = array("double", lo, "lo") end
    sized(lo_n, self:dimension(), "lo")
    local hi_c, hi_n = nil, 0
    if hi ~= nil then hi_c, hi_n = array("double", hi, "hi") end
    sized(hi_n, self:dimension(), "hi")
    local first_c, first_n = nil, 0
    if first ~= nil then first_c, first_n = array("int32_t", first, "first") end
    sized(first_n, self:dimension(), "first")
    local last_c, last_n = nil, 0
    if last ~= nil then last_c, last_n = array("int32_t", last, "last") end
    sized(last_n, self:dimension(), "last")
    local result = C.peri_add_box_part(self.handle, material, lo_c, hi_c, spacing, first_c, last_c)
    return check(result, nil, self.handle)
end

-- Finds the families, computes weights and constants, takes the state. Warns of rows of points, and of sheets of them in 3D: no
-- constants are for these. After a failure the body is as it was: add what is missing and build again.
function Body:build()
    local result = C.peri_build(self.handle)
    return check(result, nil, self.handle)
end

-- 2 or 3
function Body:dimension()
    return tonumber(C.peri_dimension(self.handle))
end

function Body:point_count()
    return tonumber(C.peri_point_count(self.handle))
end

-- size of the largest family
function Body:family_width()
    return tonumber(C.peri_family_width(self.handle))
end

-- broken and cut ones included
function Body:bond_count()
    return tonumber(C.peri_bond_count(self.handle))
end

-- of all families: twice the bonds
function Body:entry_count()
    return tonumber(C.peri_entry_count(self.handle))
end

-- bonds of the initial cracks
function Body:cut_count()
    return tonumber(C.peri_cut_count(self.handle))
end

-- bonds broken, or cut later
function Body:broken_count()
    return tonumber(C.peri_broken_count(self.handle))
end

-- steps, load steps too, since reset
function Body:step_count()
    return tonumber(C.peri_step_count(self.handle))
end

-- [T] since build or reset
function Body:time()
    return tonumber(C.peri_time(self.handle))
end

-- that loads act with; 0 before any did
function Body:load_factor()
    return tonumber(C.peri_load_factor(self.handle))
end

-- How bonds are worked on: "columns, AVX-512", "list, SSE2", "rows", "reference".
function Body:kernel_text()
    return text(C.peri_kernel_text(self.handle))
end

-- Largest stable time step [T], to 4 % at rest; of state-based bodies that can break, a bound. Takes 20 to 100 steps once:
-- docs/accuracy.md. 0 before peri_build.
function Body:stable_step()
    return tonumber(C.peri_stable_step(self.handle))
end

-- Rows [first, first+count) of the families ([T] 3.11) to rows[count*width]: ascending, padded with the row's own number; broken
-- bonds are listed. capacity counts entries.
function Body:get_families(first, count, rows)
    local rows_c, rows_n = nil, 0
    rows = rows or ffi.new("int32_t[?]", count*self:family_width())
    if rows ~= nil then rows_c, rows_n = array("int32_t", rows, "rows") end
    local result = C.peri_get_families(self.handle, first, count, rows_c, rows_n)
    check(result, nil, self.handle)
    return rows
end

-- The point nearest to x[dim] [L]; _in_place: where it is now.
function Body:find_point(x)
    local x_c, x_n = nil, 0
    if x ~= nil then x_c, x_n = array("double", x, "x") end
    sized(x_n, self:dimension(), "x")
    local result = C.peri_find_point(self.handle, x_c)
    return check(result, nil, self.handle)
end

-- The point nearest to x[dim] [L]; _in_place: where it is now.
function Body:find_point_in_place(x)
    local x_c, x_n = nil, 0
    if x ~= nil then x_c, x_n = array("double", x, "x") end
    sized(x_n, self:dimension(), "x")
    local result = C.peri_find_point_in_place(self.handle, x_c)
    return check(result, nil, self.handle)
end

-- 1: bond (i,j) carries force; 0: broken or cut; PERI_ERROR_PAIR: no such bond.
function Body:bond_is_intact(i, j)
    local result = C.peri_bond_is_intact(self.handle, i, j)
    return check(result, nil, self.handle)
end

-- Motion, time, steps, load factor and ledger become zero, broken bonds whole. Initial cracks, sets, loads, obstacles and no-fail
-- zones stay.
function Body:reset()
    local result = C.peri_reset(self.handle)
    return check(result, nil, self.handle)
end

-- name (copied) may be NULL. Reference positions; box and ball include their boundary to 1e-9 spacings.
function Body:select_box(name, lo, hi)
    local lo_c, lo_n = nil, 0
    if lo ~= nil then lo_c, lo_n = array("double", lo, "lo") end
    sized(lo_n, self:dimension(), "lo")
    local hi_c, hi_n = nil, 0
    if hi ~= nil then hi_c, hi_n = array("double", hi, "hi") end
    sized(hi_n, self:dimension(), "hi")
    local result = C.peri_select_box(self.handle, name, lo_c, hi_c)
    return check(result, nil, self.handle)
end

-- name (copied) may be NULL. Reference positions; box and ball include their boundary to 1e-9 spacings.
function Body:select_ball(name, centre, radius)
    local centre_c, centre_n = nil, 0
    if centre ~= nil then centre_c, centre_n = array("double", centre, "centre") end
    sized(centre_n, self:dimension(), "centre")
    local result = C.peri_select_ball(self.handle, name, centre_c, radius)
    return check(result, nil, self.handle)
end

-- By present positions.
function Body:select_box_in_place(name, lo, hi)
    local lo_c, lo_n = nil, 0
    if lo ~= nil then lo_c, lo_n = array("double", lo, "lo") end
    sized(lo_n, self:dimension(), "lo")
    local hi_c, hi_n = nil, 0
    if hi ~= nil then hi_c, hi_n = array("double", hi, "hi") end
    sized(hi_n, self:dimension(), "hi")
    local result = C.peri_select_box_in_place(self.handle, name, lo_c, hi_c)
    return check(result, nil, self.handle)
end

-- By present positions.
function Body:select_ball_in_place(name, centre, radius)
    local centre_c, centre_n = nil, 0
    if centre ~= nil then centre_c, centre_n = array("double", centre, "centre") end
    sized(centre_n, self:dimension(), "centre")
    local result = C.peri_select_ball_in_place(self.handle, name, centre_c, radius)
    return check(result, nil, self.handle)
end

function Body:select_if(name, take)
    local here = {}
    local take_c = nil
    if take then
        here[#here + 1] = ffi.cast("peri_point_fn", guard(function(_, index, x) return take(tonumber(index), x) end))
        take_c = here[#here]
    end
    local result = C.peri_select_if(self.handle, name, take_c, nil)
    free(here)
    return check(result, nil, self.handle)
end

function Body:select_points(name, points)
    local points_c, points_n = nil, 0
    if points ~= nil then points_c, points_n = array("int32_t", points, "points") end
    local result = C.peri_select_points(self.handle, name, points_n, points_c)
    return check(result, nil, self.handle)
end

-- id, or PERI_ERROR_NAME
function Body:find_set(name)
    local result = C.peri_find_set(self.handle, name)
    return check(result, nil, self.handle)
end

-- id, or PERI_ERROR_NAME
function Body:size_of_set(set)
    local result = C.peri_size_of_set(self.handle, set)
    return check(result, nil, self.handle)
end

-- id, or PERI_ERROR_NAME
function Body:get_set(set, points)
    local points_c, points_n = nil, 0
    points = points or ffi.new("int32_t[?]", self:size_of_set(set))
    if points ~= nil then points_c, points_n = array("int32_t", points, "points") end
    local result = C.peri_get_set(self.handle, set, points_c, points_n)
    check(result, nil, self.handle)
    return points
end

-- Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the number
-- of bonds newly cut. 2D
function Body:cut_segment(standing, from, to)
    local from_c, from_n = nil, 0
    if from ~= nil then from_c, from_n = array("double", from, "from") end
    sized(from_n, self:dimension(), "from")
    local to_c, to_n = nil, 0
    if to ~= nil then to_c, to_n = array("double", to, "to") end
    sized(to_n, self:dimension(), "to")
    local result = C.peri_cut_segment(self.handle, standing, from_c, to_c)
    return check(result, nil, self.handle)
end

-- Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the number
-- of bonds newly cut. 2D, [count*2]
function Body:cut_polyline(standing, vertices)
    local vertices_c, vertices_n = nil, 0
    if vertices ~= nil then vertices_c, vertices_n = array("double", vertices, "vertices") end
    if vertices_n % (2) ~= 0 then refuse("vertices") end
    local result = C.peri_cut_polyline(self.handle, standing, vertices_n / 2, vertices_c)
    return check(result, nil, self.handle)
end

-- Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the number
-- of bonds newly cut. 3D
function Body:cut_disc(standing, centre, normal, radius)
    local centre_c, centre_n = nil, 0
    if centre ~= nil then centre_c, centre_n = array("double", centre, "centre") end
    sized(centre_n, self:dimension(), "centre")
    local normal_c, normal_n = nil, 0
    if normal ~= nil then normal_c, normal_n = array("double", normal, "normal") end
    sized(normal_n, self:dimension(), "normal")
    local result = C.peri_cut_disc(self.handle, standing, centre_c, normal_c, radius)
    return check(result, nil, self.handle)
end

-- Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the number
-- of bonds newly cut. 3D
function Body:cut_triangle(standing, p, q, r)
    local p_c, p_n = nil, 0
    if p ~= nil then p_c, p_n = array("double", p, "p") end
    sized(p_n, self:dimension(), "p")
    local q_c, q_n = nil, 0
    if q ~= nil then q_c, q_n = array("double", q, "q") end
    sized(q_n, self:dimension(), "q")
    local r_c, r_n = nil, 0
    if r ~= nil then r_c, r_n = array("double", r, "r") end
    sized(r_n, self:dimension(), "r")
    local result = C.peri_cut_triangle(self.handle, standing, p_c, q_c, r_c)
    return check(result, nil, self.handle)
end

-- Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the number
-- of bonds newly cut. 3D, or parallelogram
function Body:cut_rectangle(standing, corner, edge1, edge2)
    local corner_c, corner_n = nil, 0
    if corner ~= nil then corner_c, corner_n = array("double", corner, "corner") end
    sized(corner_n, self:dimension(), "corner")
    local edge1_c, edge1_n = nil, 0
    if edge1 ~= nil then edge1_c, edge1_n = array("double", edge1, "edge1") end
    sized(edge1_n, self:dimension(), "edge1")
    local edge2_c, edge2_n = nil, 0
    if edge2 ~= nil then edge2_c, edge2_n = array("double", edge2, "edge2") end
    sized(edge2_n, self:dimension(), "edge2")
    local result = C.peri_cut_rectangle(self.handle, standing, corner_c, edge1_c, edge2_c)
    return check(result, nil, self.handle)
end

-- Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the number
-- of bonds newly cut. [count*2] points; each pair must be a bond
function Body:cut_pairs(standing, pairs)
    local pairs_c, pairs_n = nil, 0
    if pairs ~= nil then pairs_c, pairs_n = array("int32_t", pairs, "pairs") end
    if pairs_n % (2) ~= 0 then refuse("pairs") end
    local result = C.peri_cut_pairs(self.handle, standing, pairs_n / 2, pairs_c)
    return check(result, nil, self.handle)
end

-- Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a spacing. Returns the number
-- of bonds newly cut.
function Body:cut_if(standing, cut)
    local here = {}
    local cut_c = nil
    if cut then
        here[#here + 1] = ffi.cast("peri_pair_fn", guard(function(_, i, j, xi, xj) return cut(i, j, xi, xj) end))
        cut_c = here[#here]
    end
    local result = C.peri_cut_if(self.handle, standing, cut_c, nil)
    free(here)
    return check(result, nil, self.handle)
end

-- Bonds with an end in the set never break by a criterion (on = 1), or may again (0). Cuts still cut.
function Body:set_no_fail(set, on)
    local result = C.peri_set_no_fail(self.handle, set, on)
    return check(result, nil, self.handle)
end

-- fn is called for every bond that breaks by its criterion; NULL removes. Costs two to three bits per bond.
function Body:on_break(fn)
    local keep = self.keep
    local fn_c = nil
    if fn then
        keep[#keep + 1] = ffi.cast("peri_break_fn", guard(function(_, i, j, time, stretch) return fn(i, j, time, stretch) end))
        fn_c = keep[#keep]
    end
    local result = C.peri_on_break(self.handle, fn_c, nil)
    return check(result, nil, self.handle)
end

-- Strength of bonds, times that of points: factors[count] of pairs[count*2], or of intact bonds that `take` takes. Returns how many.
function Body:set_strength_pairs(pairs, factors)
    local pairs_c, pairs_n = nil, 0
    if pairs ~= nil then pairs_c, pairs_n = array("int32_t", pairs, "pairs") end
    sized(pairs_n, factors_n*2, "pairs")
    local factors_c, factors_n = nil, 0
    if factors ~= nil then factors_c, factors_n = array("double", factors, "factors") end
    local result = C.peri_set_strength_pairs(self.handle, factors_n, pairs_c, factors_c)
    return check(result, nil, self.handle)
end

-- Strength of bonds, times that of points: factors[count] of pairs[count*2], or of intact bonds that `take` takes. Returns how many.
function Body:set_strength_if(factor, take)
    local here = {}
    local take_c = nil
    if take then
        here[#here + 1] = ffi.cast("peri_pair_fn", guard(function(_, i, j, xi, xj) return take(i, j, xi, xj) end))
        take_c = here[#here]
    end
    local result = C.peri_set_strength_if(self.handle, factor, take_c, nil)
    free(here)
    return check(result, nil, self.handle)
end

-- on = 1: keeps when bonds between adjacent points break, for peri_get_cracks: 32 to 44 bytes per point.
function Body:record_breaks(on)
    local result = C.peri_record_breaks(self.handle, on)
    return check(result, nil, self.handle)
end

-- How many there are, and which each point is in: of_point[points], or NULL. They are numbered 0, 1, ... by their least points when
-- first asked for. Of one that has split since, the piece of most points keeps the number; the others get the next ones. Free where
-- no bond broke.
function Body:find_fragments(of_point)
    local of_point_c, of_point_n = nil, 0
    if of_point ~= nil then of_point_c, of_point_n = array("int32_t", of_point, "of_point") end
    local result = C.peri_find_fragments(self.handle, of_point_c, of_point_n)
    return check(result, nil, self.handle)
end

-- out[k] is fragment k.
function Body:get_fragments(out)
    local out_c, out_n = nil, 0
    out = out or ffi.new("peri_fragment[?]", self:find_fragments())
    if out ~= nil then out_c, out_n = array("peri_fragment", out, "out") end
    local result = C.peri_get_fragments(self.handle, out_c, out_n)
    check(result, nil, self.handle)
    return out
end

-- The closed surface of a fragment, or of all (-1), now, by cells. vertices[][dim] [L]; faces[][dim] of vertices: in 2D edges with
-- the fragment on the left, loop by loop, edge k from vertex k on; in 3D triangles, counter-clockwise from outside. owners[], or
-- NULL: its point; inner[], or NULL: 1 where a crack made it. Points and cells of yours are squares or cubes.
function Body:size_of_outline(fragment, vertices, faces)
    local vertices_c, vertices_n = nil, 0
    vertices = vertices or ffi.new("int64_t[?]", 1)
    if vertices ~= nil then vertices_c, vertices_n = array("int64_t", vertices, "vertices") end
    sized(vertices_n, 1, "vertices")
    local faces_c, faces_n = nil, 0
    faces = faces or ffi.new("int64_t[?]", 1)
    if faces ~= nil then faces_c, faces_n = array("int64_t", faces, "faces") end
    sized(faces_n, 1, "faces")
    local result = C.peri_size_of_outline(self.handle, fragment, vertices_c, faces_c)
    check(result, nil, self.handle)
    return tonumber(vertices[0]), tonumber(faces[0])
end

-- The closed surface of a fragment, or of all (-1), now, by cells. vertices[][dim] [L]; faces[][dim] of vertices: in 2D edges with
-- the fragment on the left, loop by loop, edge k from vertex k on; in 3D triangles, counter-clockwise from outside. owners[], or
-- NULL: its point; inner[], or NULL: 1 where a crack made it. Points and cells of yours are squares or cubes.
function Body:get_outline(fragment, vertices, faces, owners, inner)
    local vertices_c, vertices_n = nil, 0
    if vertices ~= nil then vertices_c, vertices_n = array("double", vertices, "vertices") end
    if vertices_n % (self:dimension()) ~= 0 then refuse("vertices") end
    local faces_c, faces_n = nil, 0
    if faces ~= nil then faces_c, faces_n = array("int32_t", faces, "faces") end
    if faces_n % (self:dimension()) ~= 0 then refuse("faces") end
    local owners_c, owners_n = nil, 0
    if owners ~= nil then owners_c, owners_n = array("int32_t", owners, "owners") end
    if owners ~= nil then sized(owners_n, faces_n / self:dimension(), "owners") end
    local inner_c, inner_n = nil, 0
    if inner ~= nil then inner_c, inner_n = array("int32_t", inner, "inner") end
    if inner ~= nil then sized(inner_n, faces_n / self:dimension(), "inner") end
    local result = C.peri_get_outline(self.handle, fragment, vertices_c, vertices_n / self:dimension(), faces_c, owners_c, inner_c, faces_n / self:dimension())
    check(result, nil, self.handle)
    return vertices, faces
end

-- Add value[dim] to the displacement [L] or velocity [L T^-1] of a set, now; peri_reset clears both. Sums are below 1e15 spacings,
-- 1e9 speeds of sound.
function Body:add_displacement(set, value)
    local value_c, value_n = nil, 0
    if value ~= nil then value_c, value_n = array("double", value, "value") end
    sized(value_n, self:dimension(), "value")
    local result = C.peri_add_displacement(self.handle, set, value_c)
    return check(result, nil, self.handle)
end

-- Add value[dim] to the displacement [L] or velocity [L T^-1] of a set, now; peri_reset clears both. Sums are below 1e15 spacings,
-- 1e9 speeds of sound.
function Body:add_velocity(set, value)
    local value_c, value_n = nil, 0
    if value ~= nil then value_c, value_n = array("double", value, "value") end
    sized(value_n, self:dimension(), "value")
    local result = C.peri_add_velocity(self.handle, set, value_c)
    return check(result, nil, self.handle)
end

-- Supports: prescribe the `axes` of displacement [L] or velocity [L T^-1] of a set: value[dim] (NULL = zero), or as fn says (may be
-- NULL). Later supports win. The load factor multiplies a constant displacement, not a velocity. A grip should be a horizon deep, of
-- state-based laws two.
function Body:prescribe_displacement(set, axes, value, fn)
    local keep = self.keep
    local value_c, value_n = nil, 0
    if value ~= nil then value_c, value_n = array("double", value, "value") end
    if value ~= nil then sized(value_n, self:dimension(), "value") end
    local fn_c = nil
    if fn then
        keep[#keep + 1] = ffi.cast("peri_load_fn", guard(function(_, time, count, points, value) return fn(time, tonumber(count), points, value) end))
        fn_c = keep[#keep]
    end
    local result = C.peri_prescribe_displacement(self.handle, set, axes, value_c, fn_c, nil)
    return check(result, nil, self.handle)
end

-- Supports: prescribe the `axes` of displacement [L] or velocity [L T^-1] of a set: value[dim] (NULL = zero), or as fn says (may be
-- NULL). Later supports win. The load factor multiplies a constant displacement, not a velocity. A grip should be a horizon deep, of
-- state-based laws two.
function Body:prescribe_velocity(set, axes, value, fn)
    local keep = self.keep
    local value_c, value_n = nil, 0
    if value ~= nil then value_c, value_n = array("double", value, "value") end
    if value ~= nil then sized(value_n, self:dimension(), "value") end
    local fn_c = nil
    if fn then
        keep[#keep + 1] = ffi.cast("peri_load_fn", guard(function(_, time, count, points, value) return fn(time, tonumber(count), points, value) end))
        fn_c = keep[#keep]
    end
    local result = C.peri_prescribe_velocity(self.handle, set, axes, value_c, fn_c, nil)
    return check(result, nil, self.handle)
end

-- Support: the set moves as a rigid body. motion: displacement [L], then in 2D the angle about centre[dim], in 3D a vector along the
-- axis as long as the angle; NULL: 0. The load factor multiplies it; or fn writes it (may be NULL).
function Body:prescribe_rigid(set, centre, motion, fn)
    local keep = self.keep
    local centre_c, centre_n = nil, 0
    if centre ~= nil then centre_c, centre_n = array("double", centre, "centre") end
    sized(centre_n, self:dimension(), "centre")
    local motion_c, motion_n = nil, 0
    if motion ~= nil then motion_c, motion_n = array("double", motion, "motion") end
    if motion ~= nil then sized(motion_n, self:dimension()+(2 * self:dimension() - 3), "motion") end
    local fn_c = nil
    if fn then
        keep[#keep + 1] = ffi.cast("peri_rigid_fn", guard(function(_, time, motion) return fn(time, motion) end))
        fn_c = keep[#keep]
    end
    local result = C.peri_prescribe_rigid(self.handle, set, centre_c, motion_c, fn_c, nil)
    return check(result, nil, self.handle)
end

-- Body force density value[dim] [M L^-2 T^-2] on a set; gravity is density times g.
function Body:apply_body_force(set, value, fn)
    local keep = self.keep
    local value_c, value_n = nil, 0
    if value ~= nil then value_c, value_n = array("double", value, "value") end
    sized(value_n, self:dimension(), "value")
    local fn_c = nil
    if fn then
        keep[#keep + 1] = ffi.cast("peri_load_fn", guard(function(_, time, count, points, value) return fn(time, tonumber(count), points, value) end))
        fn_c = keep[#keep]
    end
    local result = C.peri_apply_body_force(self.handle, set, value_c, fn_c, nil)
    return check(result, nil, self.handle)
end

-- Traction value[dim] [M L^-1 T^-2] on a flat face of `area` [L^2] (2D: length [L]) and outward `normal`. The set: all points within
-- two horizons of it, of one material. Uniform stress is exact for correspondence; else the total is, and strain is off by
-- O(horizon). ([C] 2.5, docs/statics.md)
function Body:apply_traction(set, area, normal, value, fn)
    local keep = self.keep
    local normal_c, normal_n = nil, 0
    if normal ~= nil then normal_c, normal_n = array("double", normal, "normal") end
    sized(normal_n, self:dimension(), "normal")
    local value_c, value_n = nil, 0
    if value ~= nil then value_c, value_n = array("double", value, "value") end
    sized(value_n, self:dimension(), "value")
    local fn_c = nil
    if fn then
        keep[#keep + 1] = ffi.cast("peri_load_fn", guard(function(_, time, count, points, value) return fn(time, tonumber(count), points, value) end))
        fn_c = keep[#keep]
    end
    local result = C.peri_apply_traction(self.handle, set, area, normal_c, value_c, fn_c, nil)
    return check(result, nil, self.handle)
end

-- A total of value*area (in 2D times the thickness), spread over the set by volume: on the outermost layer, say. Exact in sum, but
-- strain near the face is wrong by O(1) ([C] 2.5).
function Body:apply_layer_traction(set, area, value, fn)
    local keep = self.keep
    local value_c, value_n = nil, 0
    if value ~= nil then value_c, value_n = array("double", value, "value") end
    sized(value_n, self:dimension(), "value")
    local fn_c = nil
    if fn then
        keep[#keep + 1] = ffi.cast("peri_load_fn", guard(function(_, time, count, points, value) return fn(time, tonumber(count), points, value) end))
        fn_c = keep[#keep]
    end
    local result = C.peri_apply_layer_traction(self.handle, set, area, value_c, fn_c, nil)
    return check(result, nil, self.handle)
end

-- Pressure [M L^-1 T^-2] on all surfaces of a set, faces of cracks included ([C] 2.6): for a crack select the points within two
-- horizons of it. fn: value[k*dim] is the pressure on point k.
function Body:apply_pressure(set, pressure, fn)
    local keep = self.keep
    local fn_c = nil
    if fn then
        keep[#keep + 1] = ffi.cast("peri_load_fn", guard(function(_, time, count, points, value) return fn(time, tonumber(count), points, value) end))
        fn_c = keep[#keep]
    end
    local result = C.peri_apply_pressure(self.handle, set, pressure, fn_c, nil)
    return check(result, nil, self.handle)
end

-- As [C] 2.6 has it: through the cut bonds between neighbouring points.
function Body:apply_bond_pressure_for_comparison(set, pressure, fn)
    local keep = self.keep
    local fn_c = nil
    if fn then
        keep[#keep + 1] = ffi.cast("peri_load_fn", guard(function(_, time, count, points, value) return fn(time, tonumber(count), points, value) end))
        fn_c = keep[#keep]
    end
    local result = C.peri_apply_bond_pressure_for_comparison(self.handle, set, pressure, fn_c, nil)
    return check(result, nil, self.handle)
end

-- ids are not used twice
function Body:remove_load(load)
    local result = C.peri_remove_load(self.handle, load)
    return check(result, nil, self.handle)
end

-- Force [M L T^-2] to force[dim]: of a support on the body, mean of the last step (or of the equilibrium); of a load, its present
-- total.
function Body:get_reaction(load, force)
    local force_c, force_n = nil, 0
    force = force or ffi.new("double[?]", self:dimension())
    if force ~= nil then force_c, force_n = array("double", force, "force") end
    sized(force_n, self:dimension(), "force")
    local result = C.peri_get_reaction(self.handle, load, force_c)
    check(result, nil, self.handle)
    return force
end

-- Its moment about place[dim] [M L^2 T^-2] to moment[1] (2D) or [3].
function Body:get_reaction_moment(load, place, moment)
    local place_c, place_n = nil, 0
    if place ~= nil then place_c, place_n = array("double", place, "place") end
    sized(place_n, self:dimension(), "place")
    local moment_c, moment_n = nil, 0
    moment = moment or ffi.new("double[?]", (2 * self:dimension() - 3))
    if moment ~= nil then moment_c, moment_n = array("double", moment, "moment") end
    sized(moment_n, (2 * self:dimension() - 3), "moment")
    local result = C.peri_get_reaction_moment(self.handle, load, place_c, moment_c)
    check(result, nil, self.handle)
    return moment
end

-- A mesh is copied, and must be closed.
function Body:add_obstacle(desc)
    local keep = self.keep
    local desc_c, desc_f
    desc_c, desc_f = plain(desc, "peri_obstacle_desc")
    if desc_f.distance then
        local call = desc_f.distance
        keep[#keep + 1] = ffi.cast("peri_distance_fn", guard(function(_, x, distance, normal) return call(x, distance, normal) end))
        desc_c[0].distance = keep[#keep]
    end
    if desc_f.motion then
        local call = desc_f.motion
        keep[#keep + 1] = ffi.cast("peri_motion_fn", guard(function(_, time, place, turn) return call(time, place, turn) end))
        desc_c[0].motion = keep[#keep]
    end
    local result = C.peri_add_obstacle(self.handle, desc_c)
    desc_c[0].distance = nil
    desc_c[0].motion = nil
    return check(result, nil, self.handle)
end

-- A mesh is copied, and must be closed.
function Body:remove_obstacle(obstacle)
    local result = C.peri_remove_obstacle(self.handle, obstacle)
    return check(result, nil, self.handle)
end

-- On the body: force[dim] [M L T^-2]; moment[3], in 2D [1], [M L^2 T^-2] about its place. Either may be NULL.
function Body:get_obstacle_force(obstacle, force, moment)
    local force_c, force_n = nil, 0
    if force ~= nil then force_c, force_n = array("double", force, "force") end
    if force ~= nil then sized(force_n, self:dimension(), "force") end
    local moment_c, moment_n = nil, 0
    if moment ~= nil then moment_c, moment_n = array("double", moment, "moment") end
    if moment ~= nil then sized(moment_n, (2 * self:dimension() - 3), "moment") end
    local result = C.peri_get_obstacle_force(self.handle, obstacle, force_c, moment_c)
    return check(result, nil, self.handle)
end

function Body:get_obstacle_state(obstacle)
    local state = ffi.new("peri_obstacle_state")
    local result = C.peri_get_obstacle_state(self.handle, obstacle, state)
    check(result, nil, self.handle)
    return state
end

-- Sets place, turn, velocity and spin of a free one.
function Body:set_obstacle_state(obstacle, state)
    local result = C.peri_set_obstacle_state(self.handle, obstacle, state)
    return check(result, nil, self.handle)
end

-- Of materials i and j, ids or PERI_ALL; NULL: none.
function Body:set_contact(i, j, desc)
    local desc_c
    if desc ~= nil then desc_c = plain(desc, "peri_contact_desc") end
    local result = C.peri_set_contact(self.handle, i, j, desc_c)
    return check(result, nil, self.handle)
end

-- Advances the body in time. PERI_ERROR_STEP: it ends at a whole step; the value is what may follow. So does PERI_ERROR_CALLBACK of
-- a peri_frame_fn or peri_break_fn. PERI_ERROR_UNSTABLE, and PERI_ERROR_CALLBACK of a load or obstacle (index: the point): it ended
-- within a step; read it, then reset or destroy it.
function Body:advance(desc)
    local here = {}
    local desc_c, desc_f
    desc_c, desc_f = plain(desc, "peri_advance_desc")
    if desc_f.on_frame then
        local call = desc_f.on_frame
        here[#here + 1] = ffi.cast("peri_frame_fn", guard(function(_, _) return call(self) end))
        desc_c[0].on_frame = here[#here]
    end
    local result = C.peri_advance(self.handle, desc_c)
    desc_c[0].on_frame = nil
    free(here)
    return check(result, nil, self.handle)
end

-- Forces at a displacement of yours. A step, rho of PERI_FIELD_DENSITY: v += dt/2 force/rho, u += dt v, peri_evaluate, v += (dt/2
-- force + impulse)/rho. report may be NULL.
function Body:evaluate(desc)
    local desc_c
    desc_c = plain(desc, "peri_evaluate_desc")
    local report = ffi.new("peri_evaluate_report")
    local result = C.peri_evaluate(self.handle, desc_c, report)
    check(result, nil, self.handle)
    return report
end

-- Equilibrium under supports and loads, constant values times a factor from load_from to load_to, callbacks at time = factor,
-- prescribed velocities at rest; bonds over their limit break until none does. A later run goes on at load_to. A failed step leaves
-- the last equilibrium, or, after breaks, how far it came; so does PERI_ENDED_SEVERED.
function Body:solve(desc)
    local here = {}
    local desc_c, desc_f
    desc_c, desc_f = plain(desc, "peri_solve_desc")
    if desc_f.on_iteration then
        local call = desc_f.on_iteration
        here[#here + 1] = ffi.cast("peri_iteration_fn", guard(function(_, iteration, residual) return call(tonumber(iteration), residual) end))
        desc_c[0].on_iteration = here[#here]
    end
    if desc_f.on_step then
        local call = desc_f.on_step
        here[#here + 1] = ffi.cast("peri_frame_fn", guard(function(_, _) return call(self) end))
        desc_c[0].on_step = here[#here]
    end
    local report = ffi.new("peri_solve_report")
    local result = C.peri_solve(self.handle, desc_c, report)
    desc_c[0].on_iteration = nil
    desc_c[0].on_step = nil
    free(here)
    check(result, nil, self.handle)
    return report
end

-- peri_advance by implicit steps, `time_step` > 0 of any size (generalised alpha, order 2). rho [0, 1]: what is left of the highest
-- modes per step; 1 keeps the energy. solve: tolerance, fracture, limits, on_iteration; NULL: defaults. No obstacles or contact. A
-- step that fails leaves the last one, less the bonds that broke in it. report may be NULL.
function Body:advance_implicit(advance, solve, rho)
    local here = {}
    local advance_c, advance_f
    advance_c, advance_f = plain(advance, "peri_advance_desc")
    if advance_f.on_frame then
        local call = advance_f.on_frame
        here[#here + 1] = ffi.cast("peri_frame_fn", guard(function(_, _) return call(self) end))
        advance_c[0].on_frame = here[#here]
    end
    local solve_c, solve_f
    solve_c, solve_f = plain(solve, "peri_solve_desc")
    if solve_f.on_iteration then
        local call = solve_f.on_iteration
        here[#here + 1] = ffi.cast("peri_iteration_fn", guard(function(_, iteration, residual) return call(tonumber(iteration), residual) end))
        solve_c[0].on_iteration = here[#here]
    end
    if solve_f.on_step then
        local call = solve_f.on_step
        here[#here + 1] = ffi.cast("peri_frame_fn", guard(function(_, _) return call(self) end))
        solve_c[0].on_step = here[#here]
    end
    local report = ffi.new("peri_solve_report")
    local result = C.peri_advance_implicit(self.handle, advance_c, solve_c, rho, report)
    advance_c[0].on_frame = nil
    solve_c[0].on_iteration = nil
    solve_c[0].on_step = nil
    free(here)
    check(result, nil, self.handle)
    return report
end

-- out = K in [M L T^-2], the tangent at the present displacement times in[count], count = points*dim; without supports, obstacles
-- and contact. out may be in. The first call takes memory (peri_memory.state).
function Body:multiply_stiffness(in_, out)
    local in_c, in_n = nil, 0
    if in_ ~= nil then in_c, in_n = array("double", in_, "in") end
    local out_c, out_n = nil, 0
    out = out or ffi.new("double[?]", in_n)
    if out ~= nil then out_c, out_n = array("double", out, "out") end
    sized(out_n, in_n, "out")
    local result = C.peri_multiply_stiffness(self.handle, in_c, out_c, in_n)
    check(result, nil, self.handle)
    return out
end

-- The same at `displacement` [points*dim] of yours instead: the body stays where it is.
function Body:multiply_stiffness_at(displacement, in_, out)
    local displacement_c, displacement_n = nil, 0
    if displacement ~= nil then displacement_c, displacement_n = array("double", displacement, "displacement") end
    sized(displacement_n, self:point_count()*self:dimension(), "displacement")
    local in_c, in_n = nil, 0
    if in_ ~= nil then in_c, in_n = array("double", in_, "in") end
    local out_c, out_n = nil, 0
    out = out or ffi.new("double[?]", in_n)
    if out ~= nil then out_c, out_n = array("double", out, "out") end
    sized(out_n, in_n, "out")
    local result = C.peri_multiply_stiffness_at(self.handle, displacement_c, in_c, out_c, in_n)
    check(result, nil, self.handle)
    return out
end

-- The same as a matrix by compressed rows, points*dim square ([T] 3.2, 3.3). It outlives the body; free it by peri_matrix_destroy.
function Body:matrix_create()
    local keep = self.keep
    local made = ffi.new("peri_matrix *[1]")
    local result = C.peri_matrix_create(self.handle, made)
    check(result, nil, self.handle)
    return own_matrix(made[0], self:dimension())
end

-- The same as a matrix by compressed rows, points*dim square ([T] 3.2, 3.3). It outlives the body; free it by peri_matrix_destroy.
function Matrix:rows()
    return tonumber(C.peri_matrix_rows(self.handle))
end

-- The same as a matrix by compressed rows, points*dim square ([T] 3.2, 3.3). It outlives the body; free it by peri_matrix_destroy.
function Matrix:entries()
    return tonumber(C.peri_matrix_entries(self.handle))
end

-- start[rows+1], column[entries] ascending in each row, value[entries] [M T^-2]; any may be NULL.
function Matrix:get_matrix(start, column, value)
    local start_c, start_n = nil, 0
    if start ~= nil then start_c, start_n = array("int64_t", start, "start") end
    if start ~= nil then sized(start_n, self:rows()+1, "start") end
    local column_c, column_n = nil, 0
    if column ~= nil then column_c, column_n = array("int32_t", column, "column") end
    if column ~= nil then sized(column_n, self:entries(), "column") end
    local value_c, value_n = nil, 0
    if value ~= nil then value_c, value_n = array("double", value, "value") end
    if value ~= nil then sized(value_n, self:entries(), "value") end
    local result = C.peri_get_matrix(self.handle, start_c, column_c, value_c)
    return check(result)
end

-- Matrix Market, coordinate real symmetric: the lower triangle.
function Matrix:export_matrix_to(write)
    local here = {}
    local write_c = nil
    if write then
        here[#here + 1] = ffi.cast("peri_write_fn", guard(function(_, bytes, count) return write(ffi.string(bytes, count)) end))
        write_c = here[#here]
    end
    local result = C.peri_export_matrix_to(self.handle, write_c, nil)
    free(here)
    return check(result)
end

-- Entries of a field: points*components.
function Body:size_of_field(field)
    local result = C.peri_size_of_field(self.handle, field)
    return check(result, nil, self.handle)
end

-- Copies a field, as double, in your units and order. capacity counts doubles.
function Body:get_field(field, out)
    local out_c, out_n = nil, 0
    out = out or ffi.new("double[?]", self:size_of_field(field))
    if out ~= nil then out_c, out_n = array("double", out, "out") end
    local result = C.peri_get_field(self.handle, field, out_c, out_n)
    check(result, nil, self.handle)
    return out
end

-- Sets a field W of all points; count = points*components. What peri_get_field gives changes no bit. Fields of material
-- (docs/laws.md), which peri_frame_fn may set, too, outlast peri_reset.
function Body:set_field(field, in_)
    local in_c, in_n = nil, 0
    if in_ ~= nil then in_c, in_n = array("double", in_, "in") end
    local result = C.peri_set_field(self.handle, field, in_c, in_n)
    return check(result, nil, self.handle)
end

-- Without a copy. Of a stored field it shows the present state; of a derived one that of the call, until it is viewed again.
function Body:view_field(field)
    local view = ffi.new("peri_view")
    local result = C.peri_view_field(self.handle, field, view)
    check(result, nil, self.handle)
    return view
end

-- Of points[count] alone: count*components.
function Body:get_field_at(field, points, out)
    local points_c, points_n = nil, 0
    if points ~= nil then points_c, points_n = array("int32_t", points, "points") end
    local out_c, out_n = nil, 0
    if out ~= nil then out_c, out_n = array("double", out, "out") end
    local result = C.peri_get_field_at(self.handle, field, points_n, points_c, out_c, out_n)
    check(result, nil, self.handle)
    return out
end

-- At places[count*dim] [L], in_place = 1: present ones: linear fields exactly, not across cracks. Outside: NaN.
function Body:interpolate_field(field, in_place, places, out)
    local places_c, places_n = nil, 0
    if places ~= nil then places_c, places_n = array("double", places, "places") end
    if places_n % (self:dimension()) ~= 0 then refuse("places") end
    local out_c, out_n = nil, 0
    if out ~= nil then out_c, out_n = array("double", out, "out") end
    local result = C.peri_interpolate_field(self.handle, field, in_place, places_n / self:dimension(), places_c, out_c, out_n)
    check(result, nil, self.handle)
    return out
end

-- Bonds of the points of a set, as in peri_get_families.
function Body:size_of_bonds(set, bond)
    local result = C.peri_size_of_bonds(self.handle, set, bond)
    return check(result, nil, self.handle)
end

-- Bonds of the points of a set, as in peri_get_families.
function Body:get_bonds(set, bond, out)
    local out_c, out_n = nil, 0
    if out ~= nil then out_c, out_n = array("double", out, "out") end
    local result = C.peri_get_bonds(self.handle, set, bond, out_c, out_n)
    check(result, nil, self.handle)
    return out
end

-- Costs one evaluation of the forces.
function Body:get_energy()
    local energy = ffi.new("peri_energy")
    local result = C.peri_get_energy(self.handle, energy)
    check(result, nil, self.handle)
    return energy
end

-- Momentum [M L T^-1] to linear[dim], about the origin [M L^2 T^-1] to angular[1] (2D) or [3]. Either may be NULL.
function Body:get_momentum(linear, angular)
    local linear_c, linear_n = nil, 0
    if linear ~= nil then linear_c, linear_n = array("double", linear, "linear") end
    if linear ~= nil then sized(linear_n, self:dimension(), "linear") end
    local angular_c, angular_n = nil, 0
    if angular ~= nil then angular_c, angular_n = array("double", angular, "angular") end
    if angular ~= nil then sized(angular_n, (2 * self:dimension() - 3), "angular") end
    local result = C.peri_get_momentum(self.handle, linear_c, angular_c)
    return check(result, nil, self.handle)
end

function Body:cracks_create(desc)
    local keep = self.keep
    local desc_c
    desc_c = plain(desc, "peri_cracks_desc")
    local made = ffi.new("peri_cracks *[1]")
    local result = C.peri_cracks_create(self.handle, desc_c, made)
    check(result, nil, self.handle)
    return own_cracks(made[0], self:dimension())
end

-- polylines; 3D: sides of cells
function Cracks:paths()
    return tonumber(C.peri_cracks_paths(self.handle))
end

function Cracks:vertices()
    return tonumber(C.peri_cracks_vertices(self.handle))
end

function Cracks:tips()
    return tonumber(C.peri_cracks_tips(self.handle))
end

-- length [L]; 3D: area [L^2]
function Cracks:size()
    return tonumber(C.peri_cracks_size(self.handle))
end

-- Path p: vertices start[p] to start[p+1], of start[paths+1]; in 3D 4: triangles 0 1 2, 0 2 3. vertex[vertices*dim] [L],
-- time[vertices] of breaking [T] (peri_solve: load factor; NaN: not recorded), tip[tips]. Any may be NULL.
function Cracks:get_cracks(start, vertex, time, tip)
    local start_c, start_n = nil, 0
    if start ~= nil then start_c, start_n = array("int64_t", start, "start") end
    if start ~= nil then sized(start_n, self:paths()+1, "start") end
    local vertex_c, vertex_n = nil, 0
    if vertex ~= nil then vertex_c, vertex_n = array("double", vertex, "vertex") end
    if vertex ~= nil then sized(vertex_n, self:vertices()*self.dim, "vertex") end
    local time_c, time_n = nil, 0
    if time ~= nil then time_c, time_n = array("double", time, "time") end
    if time ~= nil then sized(time_n, self:vertices(), "time") end
    local tip_c, tip_n = nil, 0
    if tip ~= nil then tip_c, tip_n = array("peri_crack_tip", tip, "tip") end
    if tip ~= nil then sized(tip_n, self:tips(), "tip") end
    local result = C.peri_get_cracks(self.handle, start_c, vertex_c, time_c, tip_c)
    return check(result)
end

-- VTK XML PolyData (.vtp).
function Cracks:export_cracks_to(write)
    local here = {}
    local write_c = nil
    if write then
        here[#here + 1] = ffi.cast("peri_write_fn", guard(function(_, bytes, count) return write(ffi.string(bytes, count)) end))
        write_c = here[#here]
    end
    local result = C.peri_export_cracks_to(self.handle, write_c, nil)
    free(here)
    return check(result)
end

-- VTK XML for ParaView; "Warp By Vector" shows the deformed body.
function Body:export_vtu_to(write)
    local here = {}
    local write_c = nil
    if write then
        here[#here + 1] = ffi.cast("peri_write_fn", guard(function(_, bytes, count) return write(ffi.string(bytes, count)) end))
        write_c = here[#here]
    end
    local result = C.peri_export_vtu_to(self.handle, write_c, nil)
    free(here)
    return check(result, nil, self.handle)
end

-- fields[count], each once, or NULL: as above.
function Body:export_fields_to(fields, write)
    local here = {}
    local fields_c, fields_n = nil, 0
    if fields ~= nil then fields_c, fields_n = array("int32_t", fields, "fields") end
    local write_c = nil
    if write then
        here[#here + 1] = ffi.cast("peri_write_fn", guard(function(_, bytes, count) return write(ffi.string(bytes, count)) end))
        write_c = here[#here]
    end
    local result = C.peri_export_fields_to(self.handle, fields_c, fields_n, write_c, nil)
    free(here)
    return check(result, nil, self.handle)
end

-- One CSV line: step, time, the ledger, broken and cut bonds; header = 1: the names first.
function Body:export_history_to(header, write)
    local here = {}
    local write_c = nil
    if write then
        here[#here + 1] = ffi.cast("peri_write_fn", guard(function(_, bytes, count) return write(ffi.string(bytes, count)) end))
        write_c = here[#here]
    end
    local result = C.peri_export_history_to(self.handle, header, write_c, nil)
    free(here)
    return check(result, nil, self.handle)
end

function Body:export_vtu(path)
    local result = C.peri_export_vtu(self.handle, path)
    return check(result, nil, self.handle)
end

-- Frame 0, 1, ... of a series: its VTU beside `path`, a .pvd.
function Body:export_frame(path, frame, fields)
    local fields_c, fields_n = nil, 0
    if fields ~= nil then fields_c, fields_n = array("int32_t", fields, "fields") end
    local result = C.peri_export_frame(self.handle, path, frame, fields_c, fields_n)
    return check(result, nil, self.handle)
end

-- append = 0 starts the file with a header, 1 adds a line.
function Body:export_history(path, append)
    local result = C.peri_export_history(self.handle, path, append)
    return check(result, nil, self.handle)
end

-- Saves the state: motion, bonds, what criteria keep, time, ledger. Not the scene: load it into a body that the same calls built.
-- What follows has the same bits.
function Body:save_state_to(write)
    local here = {}
    local write_c = nil
    if write then
        here[#here + 1] = ffi.cast("peri_write_fn", guard(function(_, bytes, count) return write(ffi.string(bytes, count)) end))
        write_c = here[#here]
    end
    local result = C.peri_save_state_to(self.handle, write_c, nil)
    free(here)
    return check(result, nil, self.handle)
end

-- Reads all, verifies it, then takes it. PERI_ERROR_STATE: nothing has changed; field: what is of another scene, or "".
function Body:load_state_from(read)
    local here = {}
    local read_c = nil
    if read then
        here[#here + 1] = ffi.cast("peri_read_fn", guard(function(_, bytes, count) return read(bytes, tonumber(count)) end))
        read_c = here[#here]
    end
    local result = C.peri_load_state_from(self.handle, read_c, nil)
    free(here)
    return check(result, nil, self.handle)
end

function Body:save_state(path)
    local result = C.peri_save_state(self.handle, path)
    return check(result, nil, self.handle)
end

function Body:load_state(path)
    local result = C.peri_load_state(self.handle, path)
    return check(result, nil, self.handle)
end

function Body:get_memory()
    local memory = ffi.new("peri_memory")
    local result = C.peri_get_memory(self.handle, memory)
    check(result, nil, self.handle)
    return memory
end

-- What a scene will cost, before it is made: some milliseconds. Refuses what peri_body_create, peri_add_material, peri_add_box and
-- peri_build would refuse. error may be NULL.
function peri.plan(desc)
    local desc_c
    desc_c = plain(desc, "peri_plan_desc")
    local report = ffi.new("peri_plan_report")
    local record = blank(0, "")
    local result = C.peri_plan(desc_c, report, record)
    check(result, record)
    return report
end

-- Fills body (precision, influence, quadrature, correction, horizon) and material (law, poisson, stabilization) with the best
-- choice, from a measured table; the rest stays. body needs its space, material its constants. PERI_ERROR_RANGE: out of reach; the
-- value is what is in reach. error may be NULL.
function peri.choose(desc, body, material)
    local keep = keeper()
    local desc_c
    desc_c = plain(desc, "peri_choose_desc")
    local body_c, body_f
    body_c, body_f = plain(body, "peri_body_desc")
    if body_f.influence_fn then
        local call = body_f.influence_fn
        keep[#keep + 1] = ffi.cast("peri_influence_fn", guard(function(_, q, w) return call(q, w) end))
        body_c[0].influence_fn = keep[#keep]
    end
    if body_f.log then
        local call = body_f.log
        keep[#keep + 1] = ffi.cast("peri_log_fn", function(...) guard(function(_, level, text) return call(level, text(text)) end)(...) end)
        body_c[0].log = keep[#keep]
    end
    local material_c, material_f
    material_c, material_f = plain(material, "peri_material_desc")
    if material_f.stress then
        local call = material_f.stress
        keep[#keep + 1] = ffi.cast("peri_stress_fn", guard(function(_, block) return call(block) end))
        material_c[0].stress = keep[#keep]
    end
    local report = ffi.new("peri_choose_report")
    local record = blank(0, "")
    local result = C.peri_choose(desc_c, body_c, material_c, report, record)
    body_c[0].influence_fn = nil
    body_c[0].log = nil
    material_c[0].stress = nil
    check(result, record)
    return report
end

function peri.body(desc) return peri.body_create(desc) end

return peri
