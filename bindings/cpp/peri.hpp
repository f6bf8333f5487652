/* peri.hpp - peri for C++: objects that own, spans, closures, exceptions. Made from peri.h by tools/bind.py: edit that.
   SPDX-License-Identifier: MIT
   C++11; include it, compile peri_impl.c as C and link both. Names are those of peri.h in namespace peri, with the body first:
   peri_add_box(body, ...) is body.add_box(...). A call that fails throws peri::error. What a closure throws stops the call that it came
   from and comes out of it. Closures of loads, obstacles and events live as long as the body and its clones, others as long as the call. */
#ifndef PERI_HPP
#define PERI_HPP

#include "peri.h"
#include <cstring>
#include <exception>
#include <functional>
#include <initializer_list>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>
#if defined(__cpp_lib_span) || (__cplusplus >= 202002L && defined(__has_include))
#include <span>
#endif

namespace peri {

/* A view of `size` numbers that others own: of vectors, arrays, lists, std::span. */
template <class T> class span {
public:
    typedef typename std::remove_const<T>::type value_type;
    span() : data_(nullptr), size_(0) {}
    span(std::nullptr_t) : data_(nullptr), size_(0) {}
    span(T *data, std::size_t size) : data_(data), size_(size) {}
    template <std::size_t N> span(T (&array)[N]) : data_(array), size_(N) {}
    span(std::initializer_list<value_type> list) : data_(nullptr), size_(list.size()) { /* in arguments: {0, 1} */
        T *first = list.begin();
        data_ = first;
    }
    template <class C, class = typename std::enable_if<std::is_convertible<decltype(std::declval<C &>().data()), T *>::value>::type>
    span(C &container) : data_(container.data()), size_(container.size()) {}
    template <class C, class = typename std::enable_if<std::is_convertible<decltype(std::declval<const C &>().data()), T *>::value>::type,
              class = void>
    span(const C &container) : data_(container.data()), size_(container.size()) {}
    T *data() const { return data_; }
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    T &operator[](std::size_t k) const { return data_[k]; }
    T *begin() const { return data_; }
    T *end() const { return data_ + size_; }
#if defined(__cpp_lib_span)
    operator std::span<T>() const { return std::span<T>(data_, size_); }
#endif

private:
    T *data_;
    std::size_t size_;
};

/* What went wrong, with the record of the library: status, the field, the index (or -1) and the value. */
class error : public std::runtime_error {
public:
    explicit error(const peri_error &record) : std::runtime_error(said(record)), record_(record) {}
    int32_t status() const { return record_.code; }
    const char *field() const { return record_.field; }
    int64_t index() const { return record_.index; }
    double value() const { return record_.value; }
    const peri_error &record() const { return record_; }

private:
    static std::string said(const peri_error &record) {
        char text[300];
        (void)peri_format_error(&record, text, int64_t(sizeof text));
        return text;
    }
    peri_error record_;
};

namespace detail {

/* What a closure has thrown on this thread, until the call of the library that it came from has ended. */
inline std::exception_ptr &thrown() {
    static thread_local std::exception_ptr one;
    return one;
}
inline void rethrow() {
    if (thrown()) {
        std::exception_ptr one;
        std::swap(one, thrown());
        std::rethrow_exception(one);
    }
}
template <class F> int32_t guarded(F call) {
    try {
        return call();
    } catch (...) {
        thrown() = std::current_exception();
        return -1;
    }
}
inline peri_error plain(int64_t status, const char *field) {
    peri_error record = peri_error();
    record.code = int32_t(status);
    record.index = -1;
    record.field = field;
    record.text = peri_status_text(record.code);
    return record;
}
inline void refuse(const char *field) { throw error(plain(PERI_ERROR_ARGUMENT, field)); }
inline void sized(std::size_t has, int64_t needs, const char *field) {
    if (int64_t(has) != needs) refuse(field);
}
inline void known(int64_t result, const peri_error *record) {
    rethrow();
    if (result < 0) throw error(record && record->code == result ? *record : plain(result, ""));
}

/* Closures that a body and its clones keep. */
struct keeper {
    std::mutex lock;
    std::vector<std::shared_ptr<void>> all;
    void keep(std::shared_ptr<void> one) {
        std::lock_guard<std::mutex> hold(lock);
        all.push_back(std::move(one));
    }
};

} /* namespace detail */

inline int32_t version() { return peri_version(); }
inline const char *status_text(int32_t status) { return peri_status_text(status); }

/* A field in place: component k of point i, in your units. */
inline double at(const peri_view &view, int64_t i, int k) {
    const int64_t entry = i * view.point_stride + k * view.component_stride;
    const double number = view.type == PERI_TYPE_F64   ? static_cast<const double *>(view.data)[entry]
                          : view.type == PERI_TYPE_F32 ? double(static_cast<const float *>(view.data)[entry])
                                                       : double(static_cast<const int32_t *>(view.data)[entry]);
    return view.offset[k < 3 ? k : 0] + view.scale * number;
}

/* Its numbers as they lie in the body: T is double, float or int32_t, as the type of the view says. */
template <class T> span<const T> numbers(const peri_view &view) {
    static_assert(std::is_floating_point<T>::value || std::is_same<T, int32_t>::value, "double, float or int32_t");
    const int32_t type = !std::is_floating_point<T>::value ? PERI_TYPE_I32 : sizeof(T) == 8 ? PERI_TYPE_F64 : PERI_TYPE_F32;
    if (view.type != type) detail::refuse("type");
    if (view.count == 0) return span<const T>();
    return span<const T>(static_cast<const T *>(view.data),
                         std::size_t((view.count - 1) * view.point_stride + (view.components - 1) * view.component_stride + 1));
}

class body;
class cracks;
class matrix;

/* Remarks that are no errors. level: 0 information, 1 warning. (level, text) */
typedef std::function<void(int32_t, const char *)> log_fn;
/* Influence function: *w = w(q) [-], q = |xi|/horizon > 0, with partial volumes also a little beyond 1; 0, or
   1e-100 < |w| < 1e100. (q, w) */
typedef std::function<int32_t(double, double &)> influence_fn;
/* > 0 takes the point or site at x[dim]; index numbers the candidates. (index, x) */
typedef std::function<int32_t(int64_t, span<const double>)> point_fn;
/* > 0 cuts the bond between points i < j at xi[dim] and xj[dim]. (i, j, xi, xj) */
typedef std::function<int32_t(int32_t, int32_t, span<const double>, span<const double>)> pair_fn;
/* Values of a load or support at `time` on points[count]: value[count*dim] holds the constant value; overwrite
   what varies. Once per step, for its end; in peri_solve time is the load factor. > 0 stops the run after the
   step; peri_solve as peri_iteration_fn does. (time, count, points, value) */
typedef std::function<int32_t(double, span<const int32_t>, span<double>)> load_fn;
/* Writes where the frame of an obstacle is at `time`: place[dim] [L], and its turn, in 2D an angle turn[1], in
   3D a quaternion turn[4] (w x y z). They hold those of the start. > 0: likewise. (time, place, turn) */
typedef std::function<int32_t(double, span<double>, span<double>)> motion_fn;
/* A shape: *distance [L] of x[dim] from its surface, < 0 inside, and there the outward normal[dim], of any
   length; in the frame of the obstacle (x, distance, normal) */
typedef std::function<int32_t(span<const double>, double &, span<double>)> distance_fn;
/* Comes on the threads of the body, for several blocks at once; no jump may leave it. (block) */
typedef std::function<int32_t(const peri_stress_block &)> stress_fn;
/* Writes the motion of a rigid support at `time`. > 0: likewise. (time, motion) */
typedef std::function<int32_t(double, span<double>)> rigid_fn;
/* A bond i < j broke by its criterion at `time` [T] and this stretch [-]. Called after the step, in ascending
   (i, j). > 0 ends the run with PERI_STOPPED. (i, j, time, stretch) */
typedef std::function<int32_t(int32_t, int32_t, double, double)> break_fn;
/* A law, or a criterion, of bonds. A function of what it gets alone: it comes for each bond from both ends, as
   often as wanted, on any thread, and may not call the library. (row) */
typedef std::function<int32_t(const peri_bond_row &)> bond_law_fn;
/* Takes the next `count` bytes of a file; all but 0 is a failure: PERI_ERROR_WRITE. (bytes, count) */
typedef std::function<int32_t(span<const unsigned char>)> write_fn;
/* Writes the next `count` bytes to `bytes`; all but 0 is a failure, as where fewer are left. (bytes, count) */
typedef std::function<int32_t(span<unsigned char>)> read_fn;
/* plane[k][i], of type PERI_TYPE_F64 or _F32, is of point i: send those of your points to where they are ghosts,
   and write those of ghosts. Once per step; `planes` is alike on all parts. (type, planes, plane) */
typedef std::function<int32_t(int32_t, int32_t, void **)> exchange_fn;
/* values[count] become their sums or maxima. Once per step, and in most calls. (reduction, count, values) */
typedef std::function<int32_t(int32_t, span<double>)> reduce_fn;
/* Every frame_steps steps and at the end of a run; at each equilibrium of peri_solve. > 0 stops. It may also
   cut, select, set no-fail zones and contact, add or remove loads and obstacles. (body) */
typedef std::function<int32_t(body &)> frame_fn;
/* After each iteration of the linear solver, with the residual over its scale. > 0 stops there, short of the
   equilibrium. (iteration, residual) */
typedef std::function<int32_t(int64_t, double)> iteration_fn;

namespace detail {
struct point_fn_holder {
    int dim;
    point_fn call;
    static int32_t call_c(void *user_, int64_t index_, const double *x_) {
        point_fn_holder &self = *static_cast<point_fn_holder *>(user_);
        return guarded([&]() -> int32_t { return self.call(index_, span<const double>(x_, std::size_t(self.dim))); });
    }
};
struct pair_fn_holder {
    int dim;
    pair_fn call;
    static int32_t call_c(void *user_, int32_t i_, int32_t j_, const double *xi_, const double *xj_) {
        pair_fn_holder &self = *static_cast<pair_fn_holder *>(user_);
        return guarded([&]() -> int32_t { return self.call(i_, j_, span<const double>(xi_, std::size_t(self.dim)), span<const double>(xj_, std::size_t(self.dim))); });
    }
};
struct load_fn_holder {
    int dim;
    load_fn call;
    static int32_t call_c(void *user_, double time_, int64_t count_, const int32_t *points_, double *value_) {
        load_fn_holder &self = *static_cast<load_fn_holder *>(user_);
        return guarded([&]() -> int32_t { return self.call(time_, span<const int32_t>(points_, std::size_t(count_)), span<double>(value_, std::size_t(count_*self.dim))); });
    }
};
struct rigid_fn_holder {
    int dim;
    rigid_fn call;
    static int32_t call_c(void *user_, double time_, double *motion_) {
        rigid_fn_holder &self = *static_cast<rigid_fn_holder *>(user_);
        return guarded([&]() -> int32_t { return self.call(time_, span<double>(motion_, std::size_t(self.dim+(2 * self.dim - 3)))); });
    }
};
struct break_fn_holder {
    int dim;
    break_fn call;
    static int32_t call_c(void *user_, int32_t i_, int32_t j_, double time_, double stretch_) {
        break_fn_holder &self = *static_cast<break_fn_holder *>(user_);
        return guarded([&]() -> int32_t { return self.call(i_, j_, time_, stretch_); });
    }
};
struct bond_law_fn_holder {
    int dim;
    bond_law_fn call;
    static int32_t call_c(void *user_, const peri_bond_row *row_) {
        bond_law_fn_holder &self = *static_cast<bond_law_fn_holder *>(user_);
        return guarded([&]() -> int32_t { return self.call(*row_); });
    }
};
struct write_fn_holder {
    int dim;
    write_fn call;
    static int32_t call_c(void *user_, const void *bytes_, int64_t count_) {
        write_fn_holder &self = *static_cast<write_fn_holder *>(user_);
        return guarded([&]() -> int32_t { return self.call(span<const unsigned char>(static_cast<const unsigned char *>(bytes_), std::size_t(count_))); });
    }
};
struct read_fn_holder {
    int dim;
    read_fn call;
    static int32_t call_c(void *user_, void *bytes_, int64_t count_) {
        read_fn_holder &self = *static_cast<read_fn_holder *>(user_);
        return guarded([&]() -> int32_t { return self.call(span<unsigned char>(static_cast<unsigned char *>(bytes_), std::size_t(count_))); });
    }
};
} /* namespace detail */
typedef peri_stress_block stress_block;
typedef peri_bond_row bond_row;

/* peri_body_desc, filled with the defaults. */
struct body_desc : peri_body_desc {
    body_desc() : peri_body_desc() { peri_body_desc_init(this); }
    body_desc(const peri_body_desc &plain_) : peri_body_desc(plain_) {}
    /* for PERI_INFLUENCE_USER Influence function: *w = w(q) [-], q = |xi|/horizon > 0, with partial volumes also
       a little beyond 1; 0, or 1e-100 < |w| < 1e100. (q, w) */
    std::function<int32_t(double, double &)> influence_fn;
    /* Default NULL: silent Remarks that are no errors. level: 0 information, 1 warning. (level, text) */
    std::function<void(int32_t, const char *)> log;
};

namespace detail {
struct body_desc_influence_user {
    int dim;
    std::function<int32_t(double, double &)> influence_fn;
    static int32_t influence_fn_c(void *user_, double q_, double *w_) {
        body_desc_influence_user &self = *static_cast<body_desc_influence_user *>(user_);
        return guarded([&]() -> int32_t { return self.influence_fn(q_, *w_); });
    }
    static void fill(peri_body_desc &to, body_desc_influence_user *self) {
        to.influence_user = self;
        if (self->influence_fn) to.influence_fn = influence_fn_c;
    }
};
} /* namespace detail */

namespace detail {
struct body_desc_log_user {
    int dim;
    std::function<void(int32_t, const char *)> log;
    static void log_c(void *user_, int32_t level_, const char *text_) {
        body_desc_log_user &self = *static_cast<body_desc_log_user *>(user_);
        (void)guarded([&]() { self.log(level_, text_); return int32_t(0); });
    }
    static void fill(peri_body_desc &to, body_desc_log_user *self) {
        to.log_user = self;
        if (self->log) to.log = log_c;
    }
};
} /* namespace detail */

/* peri_material_desc, filled with the defaults. */
struct material_desc : peri_material_desc {
    explicit material_desc(int32_t law_) : peri_material_desc() { peri_material_desc_init(this, law_); }
    /* correspondence: yours. Default NULL Comes on the threads of the body, for several blocks at once; no jump
       may leave it. (block) */
    std::function<int32_t(const peri_stress_block &)> stress;
};

namespace detail {
struct material_desc_stress_user {
    int dim;
    std::function<int32_t(const peri_stress_block &)> stress;
    static int32_t stress_c(void *user_, const peri_stress_block *block_) {
        material_desc_stress_user &self = *static_cast<material_desc_stress_user *>(user_);
        return guarded([&]() -> int32_t { return self.stress(*block_); });
    }
    static void fill(peri_material_desc &to, material_desc_stress_user *self) {
        to.stress_user = self;
        if (self->stress) to.stress = stress_c;
    }
};
} /* namespace detail */

/* peri_softening_desc, filled with the defaults. */
struct softening_desc : peri_softening_desc {
    explicit softening_desc(int32_t shape_) : peri_softening_desc() { peri_softening_desc_init(this, shape_); }
};

/* peri_cells_desc, filled with the defaults. Cells: polygons, convex or not; tetrahedra, pyramids, wedges,
   hexahedra (4, 5, 6, 8 corners) in VTK's order, or mirrored. */
struct cells_desc : peri_cells_desc {
    cells_desc() : peri_cells_desc() { peri_cells_desc_init(this); }
    cells_desc(const peri_cells_desc &plain_) : peri_cells_desc(plain_) {}
};

/* peri_part_desc, filled with the defaults. Ghosts: copies of points that other parts own, peri_ghost_depth
   horizons deep. They bear no load and are in no set, sum or count. Give them all else that their owners have:
   cuts, motion. */
struct part_desc : peri_part_desc {
    part_desc() : peri_part_desc() { peri_part_desc_init(this); }
    part_desc(const peri_part_desc &plain_) : peri_part_desc(plain_) {}
    /* where another part owns ghosts. Default NULL plane[k][i], of type PERI_TYPE_F64 or _F32, is of point i:
       send those of your points to where they are ghosts, and write those of ghosts. Once per step; `planes` is
       alike on all parts. (type, planes, plane) */
    std::function<int32_t(int32_t, int32_t, void **)> exchange;
    /* of several parts. Default NULL values[count] become their sums or maxima. Once per step, and in most
       calls. (reduction, count, values) */
    std::function<int32_t(int32_t, span<double>)> reduce;
};

namespace detail {
struct part_desc_user {
    int dim;
    std::function<int32_t(int32_t, int32_t, void **)> exchange;
    static int32_t exchange_c(void *user_, int32_t type_, int32_t planes_, void **plane_) {
        part_desc_user &self = *static_cast<part_desc_user *>(user_);
        return guarded([&]() -> int32_t { return self.exchange(type_, planes_, plane_); });
    }
    std::function<int32_t(int32_t, span<double>)> reduce;
    static int32_t reduce_c(void *user_, int32_t reduction_, int64_t count_, double *values_) {
        part_desc_user &self = *static_cast<part_desc_user *>(user_);
        return guarded([&]() -> int32_t { return self.reduce(reduction_, span<double>(values_, std::size_t(count_))); });
    }
    static void fill(peri_part_desc &to, part_desc_user *self) {
        to.user = self;
        if (self->exchange) to.exchange = exchange_c;
        if (self->reduce) to.reduce = reduce_c;
    }
};
} /* namespace detail */
typedef peri_fragment fragment;

/* peri_obstacle_desc, filled with the defaults. Pushes points within it out along the normal by stiffness*depth
   [M L^-2 T^-2]. A free one (of a mass) is moved by that and by gravity, not by other obstacles. */
struct obstacle_desc : peri_obstacle_desc {
    explicit obstacle_desc(int32_t shape_) : peri_obstacle_desc() { peri_obstacle_desc_init(this, shape_); }
    /* A shape: *distance [L] of x[dim] from its surface, < 0 inside, and there the outward normal[dim], of any
       length; in the frame of the obstacle (x, distance, normal) */
    std::function<int32_t(span<const double>, double &, span<double>)> distance;
    /* of others. Default NULL: at rest Writes where the frame of an obstacle is at `time`: place[dim] [L], and
       its turn, in 2D an angle turn[1], in 3D a quaternion turn[4] (w x y z). They hold those of the start. > 0:
       likewise. (time, place, turn) */
    std::function<int32_t(double, span<double>, span<double>)> motion;
};

namespace detail {
struct obstacle_desc_user {
    int dim;
    std::function<int32_t(span<const double>, double &, span<double>)> distance;
    static int32_t distance_c(void *user_, const double *x_, double *distance_, double *normal_) {
        obstacle_desc_user &self = *static_cast<obstacle_desc_user *>(user_);
        return guarded([&]() -> int32_t { return self.distance(span<const double>(x_, std::size_t(self.dim)), *distance_, span<double>(normal_, std::size_t(self.dim))); });
    }
    std::function<int32_t(double, span<double>, span<double>)> motion;
    static int32_t motion_c(void *user_, double time_, double *place_, double *turn_) {
        obstacle_desc_user &self = *static_cast<obstacle_desc_user *>(user_);
        return guarded([&]() -> int32_t { return self.motion(time_, span<double>(place_, std::size_t(self.dim)), span<double>(turn_, std::size_t(3*self.dim-5))); });
    }
    static void fill(peri_obstacle_desc &to, obstacle_desc_user *self) {
        to.user = self;
        if (self->distance) to.distance = distance_c;
        if (self->motion) to.motion = motion_c;
    }
};
} /* namespace detail */
typedef peri_obstacle_state obstacle_state;

/* peri_contact_desc, filled with the defaults. Unbonded surface points: 1/2 k (d - r)^2 where r < d =
   min(distance, |xi|), k = stiffness E V /(spacing distance) */
struct contact_desc : peri_contact_desc {
    contact_desc() : peri_contact_desc() { peri_contact_desc_init(this); }
    contact_desc(const peri_contact_desc &plain_) : peri_contact_desc(plain_) {}
};

/* peri_advance_desc, filled with the defaults. */
struct advance_desc : peri_advance_desc {
    advance_desc() : peri_advance_desc() { peri_advance_desc_init(this); }
    advance_desc(const peri_advance_desc &plain_) : peri_advance_desc(plain_) {}
    /* Default NULL Every frame_steps steps and at the end of a run; at each equilibrium of peri_solve. > 0
       stops. It may also cut, select, set no-fail zones and contact, add or remove loads and obstacles. (body) */
    std::function<int32_t(body &)> on_frame;
};

namespace detail {
struct advance_desc_user {
    body *owner;
    int dim;
    std::function<int32_t(body &)> on_frame;
    static int32_t on_frame_c(void *user_, peri_body *) {
        advance_desc_user &self = *static_cast<advance_desc_user *>(user_);
        return guarded([&]() -> int32_t { return self.on_frame(*self.owner); });
    }
    static void fill(peri_advance_desc &to, advance_desc_user *self) {
        to.user = self;
        if (self->on_frame) to.on_frame = on_frame_c;
    }
};
} /* namespace detail */

/* peri_evaluate_desc, filled with the defaults. */
struct evaluate_desc : peri_evaluate_desc {
    evaluate_desc() : peri_evaluate_desc() { peri_evaluate_desc_init(this); }
    evaluate_desc(const peri_evaluate_desc &plain_) : peri_evaluate_desc(plain_) {}
};
typedef peri_evaluate_report evaluate_report;

/* peri_solve_desc, filled with the defaults. */
struct solve_desc : peri_solve_desc {
    solve_desc() : peri_solve_desc() { peri_solve_desc_init(this); }
    solve_desc(const peri_solve_desc &plain_) : peri_solve_desc(plain_) {}
    /* Default NULL After each iteration of the linear solver, with the residual over its scale. > 0 stops there,
       short of the equilibrium. (iteration, residual) */
    std::function<int32_t(int64_t, double)> on_iteration;
    /* at each equilibrium, also after it cut. Default NULL Every frame_steps steps and at the end of a run; at
       each equilibrium of peri_solve. > 0 stops. It may also cut, select, set no-fail zones and contact, add or
       remove loads and obstacles. (body) */
    std::function<int32_t(body &)> on_step;
};

namespace detail {
struct solve_desc_user {
    body *owner;
    int dim;
    std::function<int32_t(int64_t, double)> on_iteration;
    static int32_t on_iteration_c(void *user_, int64_t iteration_, double residual_) {
        solve_desc_user &self = *static_cast<solve_desc_user *>(user_);
        return guarded([&]() -> int32_t { return self.on_iteration(iteration_, residual_); });
    }
    std::function<int32_t(body &)> on_step;
    static int32_t on_step_c(void *user_, peri_body *) {
        solve_desc_user &self = *static_cast<solve_desc_user *>(user_);
        return guarded([&]() -> int32_t { return self.on_step(*self.owner); });
    }
    static void fill(peri_solve_desc &to, solve_desc_user *self) {
        to.user = self;
        if (self->on_iteration) to.on_iteration = on_iteration_c;
        if (self->on_step) to.on_step = on_step_c;
    }
};
} /* namespace detail */
typedef peri_solve_report solve_report;
typedef peri_view view;
typedef peri_energy energy;

/* peri_cracks_desc, filled with the defaults. */
struct cracks_desc : peri_cracks_desc {
    cracks_desc() : peri_cracks_desc() { peri_cracks_desc_init(this); }
    cracks_desc(const peri_cracks_desc &plain_) : peri_cracks_desc(plain_) {}
};
typedef peri_crack_tip crack_tip;
typedef peri_memory memory;

/* peri_plan_desc, filled with the defaults. a body that is only described: one material in a box */
struct plan_desc : peri_plan_desc {
    plan_desc() : peri_plan_desc() { peri_plan_desc_init(this); }
    plan_desc(const peri_plan_desc &plain_) : peri_plan_desc(plain_) {}
};
typedef peri_plan_report plan_report;

/* peri_choose_desc, filled with the defaults. a preset, or an error, at least cost; or a budget; or both */
struct choose_desc : peri_choose_desc {
    choose_desc() : peri_choose_desc() { peri_choose_desc_init(this); }
    choose_desc(const peri_choose_desc &plain_) : peri_choose_desc(plain_) {}
};
typedef peri_choose_report choose_report;

/* Owns a peri_cracks; moves, and is not copied. Cracks: midway through the broken bonds of adjacent points. They
   outlive the body; free them by peri_cracks_destroy. */
class cracks {
public:
    cracks(peri_cracks *handle, int dim) : handle_(handle), dim_(dim) {}
    cracks(cracks &&other) noexcept : handle_(other.handle_), dim_(other.dim_) { other.handle_ = nullptr; }
    cracks &operator=(cracks &&other) noexcept {
        std::swap(handle_, other.handle_);
        std::swap(dim_, other.dim_);
        return *this;
    }
    cracks(const cracks &) = delete;
    cracks &operator=(const cracks &) = delete;
    ~cracks() { peri_cracks_destroy(handle_); }
    peri_cracks *get() const { return handle_; }

    /* ---- results ---- */
    /* polylines; 3D: sides of cells */
    int64_t paths() const { return peri_cracks_paths(handle_); }
    int64_t vertices() const { return peri_cracks_vertices(handle_); }
    int64_t tips() const { return peri_cracks_tips(handle_); }
    /* length [L]; 3D: area [L^2] */
    double size() const { return peri_cracks_size(handle_); }
    /* Path p: vertices start[p] to start[p+1], of start[paths+1]; in 3D 4: triangles 0 1 2, 0 2 3.
       vertex[vertices*dim] [L], time[vertices] of breaking [T] (peri_solve: load factor; NaN: not recorded),
       tip[tips]. Any may be NULL. */
    int32_t get_cracks(span<int64_t> start_ = nullptr, span<double> vertex_ = nullptr, span<double> time_ = nullptr, span<peri_crack_tip> tip_ = nullptr) const {
        if (!start_.empty()) detail::sized(start_.size(), paths()+1, "start");
        if (!vertex_.empty()) detail::sized(vertex_.size(), vertices()*dim_, "vertex");
        if (!time_.empty()) detail::sized(time_.size(), vertices(), "time");
        if (!tip_.empty()) detail::sized(tip_.size(), tips(), "tip");
        const int32_t result_ = peri_get_cracks(handle_, start_.data(), vertex_.data(), time_.data(), tip_.data());
        detail::known(result_, nullptr);
        return result_;
    }
    /* VTK XML PolyData (.vtp). */
    int32_t export_cracks_to(const write_fn &write_) const {
        detail::write_fn_holder context_ = {dim_, write_};
        const int32_t result_ = peri_export_cracks_to(handle_, write_ ? detail::write_fn_holder::call_c : nullptr, &context_);
        detail::known(result_, nullptr);
        return result_;
    }

private:
    peri_cracks *handle_;
    int dim_;
};

/* Owns a peri_matrix; moves, and is not copied. The same as a matrix by compressed rows, points*dim square ([T]
   3.2, 3.3). It outlives the body; free it by peri_matrix_destroy. */
class matrix {
public:
    matrix(peri_matrix *handle, int dim) : handle_(handle), dim_(dim) {}
    matrix(matrix &&other) noexcept : handle_(other.handle_), dim_(other.dim_) { other.handle_ = nullptr; }
    matrix &operator=(matrix &&other) noexcept {
        std::swap(handle_, other.handle_);
        std::swap(dim_, other.dim_);
        return *this;
    }
    matrix(const matrix &) = delete;
    matrix &operator=(const matrix &) = delete;
    ~matrix() { peri_matrix_destroy(handle_); }
    peri_matrix *get() const { return handle_; }

    /* ---- equilibrium ---- */
    /* The same as a matrix by compressed rows, points*dim square ([T] 3.2, 3.3). It outlives the body; free it
       by peri_matrix_destroy. */
    int64_t rows() const { return peri_matrix_rows(handle_); }
    /* The same as a matrix by compressed rows, points*dim square ([T] 3.2, 3.3). It outlives the body; free it
       by peri_matrix_destroy. */
    int64_t entries() const { return peri_matrix_entries(handle_); }
    /* start[rows+1], column[entries] ascending in each row, value[entries] [M T^-2]; any may be NULL. */
    int32_t get_matrix(span<int64_t> start_ = nullptr, span<int32_t> column_ = nullptr, span<double> value_ = nullptr) const {
        if (!start_.empty()) detail::sized(start_.size(), rows()+1, "start");
        if (!column_.empty()) detail::sized(column_.size(), entries(), "column");
        if (!value_.empty()) detail::sized(value_.size(), entries(), "value");
        const int32_t result_ = peri_get_matrix(handle_, start_.data(), column_.data(), value_.data());
        detail::known(result_, nullptr);
        return result_;
    }
    /* Matrix Market, coordinate real symmetric: the lower triangle. */
    int32_t export_matrix_to(const write_fn &write_) const {
        detail::write_fn_holder context_ = {dim_, write_};
        const int32_t result_ = peri_export_matrix_to(handle_, write_ ? detail::write_fn_holder::call_c : nullptr, &context_);
        detail::known(result_, nullptr);
        return result_;
    }

private:
    peri_matrix *handle_;
    int dim_;
};

/* Owns a peri_body; moves, and is not copied. */
class body {
public:
    body(peri_body *handle, std::shared_ptr<detail::keeper> keep) : handle_(handle), keep_(std::move(keep)) {}
    body(body &&other) noexcept : handle_(other.handle_), keep_(std::move(other.keep_)) { other.handle_ = nullptr; }
    body &operator=(body &&other) noexcept {
        std::swap(handle_, other.handle_);
        keep_.swap(other.keep_);
        return *this;
    }
    body(const body &) = delete;
    body &operator=(const body &) = delete;
    ~body() { peri_body_destroy(handle_); }
    explicit body(const body_desc &desc);
    /* The handle, for what C takes. */
    peri_body *get() const { return handle_; }

    /* ---- body ---- */
    /* An independent copy of a built body, state, loads and number included: ids hold in both. Points, families
       and weights are shared. error may be NULL. */
    body clone() const {
        peri_body *made_ = nullptr;
        peri_error error_ = detail::plain(0, "");
        const int32_t result_ = peri_body_clone(handle_, &made_, &error_);
        detail::known(result_, &error_);
        return body(made_, keep_);
    }
    /* After a callback was left by longjmp or an exception: ends the call that it came from, and frees its
       memory. The body may then be read, reset or destroyed; it runs again after peri_reset. Never from within a
       callback. PERI_ERROR_ORDER where none was left. Memory hooks, job systems and what a measuring peri_plan
       calls may not be left so. */
    int32_t unlock() {
        const int32_t result_ = peri_unlock(handle_);
        check(result_);
        return result_;
    }
    /* The id of the index-th (1, 2, ...) thing of a peri_kind, removed ones counted; or an error. */
    int32_t id(int32_t kind_, int64_t index_) const {
        const int32_t result_ = peri_id(handle_, kind_, index_);
        check(result_);
        return result_;
    }

    /* ---- materials ---- */
    /* Adds a material, before peri_build; at most 120. Returns its id, or an error. */
    int32_t add_material(const material_desc &desc_) {
        peri_material_desc desc_raw = desc_;
        if (desc_.stress) {
            std::shared_ptr<detail::material_desc_stress_user> desc_stress_user_context_(new detail::material_desc_stress_user{dimension(), desc_.stress});
            detail::material_desc_stress_user::fill(desc_raw, desc_stress_user_context_.get());
            keep_->keep(desc_stress_user_context_);
        }
        const int32_t result_ = peri_add_material(handle_, &desc_raw);
        check(result_);
        return result_;
    }
    /* Bonds between i and j break, and of bond-based i and j act, as if of `desc`, before peri_build; its law is
       that of one of them, not bond-based unless both are. Default: harmonic mean of the micromoduli, the
       criteria of both. */
    int32_t set_interface(int32_t i_, int32_t j_, const material_desc &desc_) {
        peri_material_desc desc_raw = desc_;
        if (desc_.stress) {
            std::shared_ptr<detail::material_desc_stress_user> desc_stress_user_context_(new detail::material_desc_stress_user{dimension(), desc_.stress});
            detail::material_desc_stress_user::fill(desc_raw, desc_stress_user_context_.get());
            keep_->keep(desc_stress_user_context_);
        }
        const int32_t result_ = peri_set_interface(handle_, i_, j_, &desc_raw);
        check(result_);
        return result_;
    }
    /* Bonds between bond-based materials i and j (i, i: within one) soften, before peri_build; their
       fracture_energy and critical_stretch do not count. PERI_BRITTLE: the horizon is too large, bonds break at
       once at less than the strength and take the energy. docs/laws.md */
    int32_t set_softening(int32_t i_, int32_t j_, const softening_desc &desc_) {
        const int32_t result_ = peri_set_softening(handle_, i_, j_, &desc_);
        check(result_);
        return result_;
    }
    /* The stretch at which bonds begin to soften, and that at which they break; after peri_build. PERI_BRITTLE:
       they are one. Either may be NULL. */
    int32_t get_softening(int32_t i_, int32_t j_, span<double> first_ = nullptr, span<double> last_ = nullptr) {
        if (!first_.empty()) detail::sized(first_.size(), 1, "first");
        if (!last_.empty()) detail::sized(last_.size(), 1, "last");
        const int32_t result_ = peri_get_softening(handle_, i_, j_, first_.data(), last_.data());
        check(result_);
        return result_;
    }
    /* Bonds between bond-based materials i and j follow fn, each with `states` (0..8) numbers of its own, 0 at
       first; before peri_build. Their critical stretch holds, too. docs/laws.md */
    int32_t set_bond_law(int32_t i_, int32_t j_, int32_t states_, const bond_law_fn &fn_ = nullptr) {
        std::shared_ptr<detail::bond_law_fn_holder> context_(new detail::bond_law_fn_holder{dimension(), fn_});
        if (fn_) keep_->keep(context_);
        const int32_t result_ = peri_set_bond_law(handle_, i_, j_, states_, fn_ ? detail::bond_law_fn_holder::call_c : nullptr, context_.get());
        check(result_);
        return result_;
    }
    /* Micromodulus c [M L^-5 T^-2] (bond-based only, else NULL) and critical stretch s0 [-] (HUGE_VAL: never;
       softening: where they break, after peri_build) of bonds between materials i and j. Either may be NULL.
       ([P] C.15-C.20, [T] 1.24, 1.40) */
    int32_t get_bond_constants(int32_t i_, int32_t j_, span<double> c_ = nullptr, span<double> s0_ = nullptr) {
        if (!c_.empty()) detail::sized(c_.size(), 1, "c");
        if (!s0_.empty()) detail::sized(s0_.size(), 1, "s0");
        const int32_t result_ = peri_get_bond_constants(handle_, i_, j_, c_.data(), s0_.data());
        check(result_);
        return result_;
    }
    /* Critical bond energy w0 [M L^-4 T^-2] of a material whose criterion is an energy; HUGE_VAL: none.
       PERI_CRITERION_NODE_ENERGY: after peri_build. */
    int32_t get_critical_energy(int32_t material_, span<double> w0_) {
        detail::sized(w0_.size(), 1, "w0");
        const int32_t result_ = peri_get_critical_energy(handle_, material_, w0_.data());
        check(result_);
        return result_;
    }
    double get_critical_energy(int32_t material_) {
        double w0_ = 0;
        (void)get_critical_energy(material_, span<double>(&w0_, 1));
        return w0_;
    }

    /* ---- points ---- */
    /* The box lo[dim]..hi[dim] in cells of about `spacing` [L], which tile it. */
    int64_t add_box(int32_t material_, span<const double> lo_, span<const double> hi_, double spacing_) {
        detail::sized(lo_.size(), dimension(), "lo");
        detail::sized(hi_.size(), dimension(), "hi");
        const int64_t result_ = peri_add_box(handle_, material_, lo_.data(), hi_.data(), spacing_);
        check(result_);
        return result_;
    }
    /* The box in cells[dim] cells per axis. */
    int64_t add_grid(int32_t material_, span<const double> lo_, span<const double> hi_, span<const int32_t> cells_) {
        detail::sized(lo_.size(), dimension(), "lo");
        detail::sized(hi_.size(), dimension(), "hi");
        detail::sized(cells_.size(), dimension(), "cells");
        const int64_t result_ = peri_add_grid(handle_, material_, lo_.data(), hi_.data(), cells_.data());
        check(result_);
        return result_;
    }
    /* The lattice cells whose centre is within `radius` of `centre`: a ball, in 2D a disc. */
    int64_t add_ball(int32_t material_, span<const double> centre_, double radius_, double spacing_) {
        detail::sized(centre_.size(), dimension(), "centre");
        const int64_t result_ = peri_add_ball(handle_, material_, centre_.data(), radius_, spacing_);
        check(result_);
        return result_;
    }
    /* The lattice cells of the box whose centre `inside` takes. */
    int64_t add_shape(int32_t material_, span<const double> lo_, span<const double> hi_, double spacing_, const point_fn &inside_) {
        detail::sized(lo_.size(), dimension(), "lo");
        detail::sized(hi_.size(), dimension(), "hi");
        detail::point_fn_holder context_ = {dimension(), inside_};
        const int64_t result_ = peri_add_shape(handle_, material_, lo_.data(), hi_.data(), spacing_, inside_ ? detail::point_fn_holder::call_c : nullptr, &context_);
        check(result_);
        return result_;
    }
    /* peri_add_box, interior vertices moved by up to `amount` (0..1) quarters of a cell ([P] B). */
    int64_t add_perturbed_box(int32_t material_, span<const double> lo_, span<const double> hi_, double spacing_, double amount_, uint64_t seed_) {
        detail::sized(lo_.size(), dimension(), "lo");
        detail::sized(hi_.size(), dimension(), "hi");
        const int64_t result_ = peri_add_perturbed_box(handle_, material_, lo_.data(), hi_.data(), spacing_, amount_, seed_);
        check(result_);
        return result_;
    }
    /* Points of yours: positions[count*dim] [L], volumes[count] [L^3] (planes: areas [L^2]), materials[count]
       (ids), or NULL where the body has one material. */
    int64_t add_points(span<const double> positions_, span<const double> volumes_, span<const int32_t> materials_ = nullptr) {
        detail::sized(positions_.size(), int64_t(volumes_.size())*dimension(), "positions");
        if (!materials_.empty()) detail::sized(materials_.size(), int64_t(volumes_.size()), "materials");
        const int64_t result_ = peri_add_points(handle_, int64_t(volumes_.size()), positions_.data(), volumes_.data(), materials_.data());
        check(result_);
        return result_;
    }
    /* Each is a point at its centroid, with its volume; partial volumes are exact. */
    int64_t add_cells(const cells_desc &desc_) {
        const int64_t result_ = peri_add_cells(handle_, &desc_);
        check(result_);
        return result_;
    }
    /* Families of yours instead of a search: ibond[points*width] as in [T] 3.11, row i padded with i. Membership
       must be mutual. Weights are computed as for found families, of whose horizon they must be. */
    int32_t set_families(int32_t width_, span<const int32_t> ibond_) {
        detail::sized(ibond_.size(), point_count()*int64_t(width_), "ibond");
        const int32_t result_ = peri_set_families(handle_, width_, ibond_.data());
        check(result_);
        return result_;
    }

    /* ---- a part of a body: one of several processes ---- */
    /* After the points, before peri_build. All parts make the same calls. */
    int32_t set_part(const part_desc &desc_) {
        peri_part_desc desc_raw = desc_;
        if (desc_.exchange || desc_.reduce) {
            std::shared_ptr<detail::part_desc_user> desc_user_context_(new detail::part_desc_user{dimension(), desc_.exchange, desc_.reduce});
            detail::part_desc_user::fill(desc_raw, desc_user_context_.get());
            keep_->keep(desc_user_context_);
        }
        const int32_t result_ = peri_set_part(handle_, &desc_raw);
        check(result_);
        return result_;
    }
    /* 1 or 2, before peri_build; the deepest that its materials need. */
    int32_t ghost_depth() const {
        const int32_t result_ = peri_ghost_depth(handle_);
        check(result_);
        return result_;
    }
    /* H[dim*dim] [-] by rows: images have their owner's displacement + H (distance). Default 0 */
    int32_t set_mean_gradient(span<const double> gradient_) {
        detail::sized(gradient_.size(), dimension(), "gradient");
        const int32_t result_ = peri_set_mean_gradient(handle_, gradient_.data());
        check(result_);
        return result_;
    }
    /* Of the cells of peri_add_box those from first[dim] to before last[dim]. */
    int64_t add_box_part(int32_t material_, span<const double> lo_, span<const double> hi_, double spacing_, span<const int32_t> first_, span<const int32_t> last_) {
        detail::sized(lo_.size(), dimension(), "lo");
        detail::sized(hi_.size(), dimension(), "hi");
        detail::sized(first_.size(), dimension(), "first");
        detail::sized(last_.size(), dimension(), "last");
        const int64_t result_ = peri_add_box_part(handle_, material_, lo_.data(), hi_.data(), spacing_, first_.data(), last_.data());
        check(result_);
        return result_;
    }
    /* Finds the families, computes weights and constants, takes the state. Warns of rows of points, and of
       sheets of them in 3D: no constants are for these. After a failure the body is as it was: add what is
       missing and build again. */
    int32_t build() {
        const int32_t result_ = peri_build(handle_);
        check(result_);
        return result_;
    }

    /* ---- the built body: nouns return that number ---- */
    /* 2 or 3 */
    int32_t dimension() const { return peri_dimension(handle_); }
    int64_t point_count() const { return peri_point_count(handle_); }
    /* size of the largest family */
    int32_t family_width() const { return peri_family_width(handle_); }
    /* broken and cut ones included */
    int64_t bond_count() const { return peri_bond_count(handle_); }
    /* of all families: twice the bonds */
    int64_t entry_count() const { return peri_entry_count(handle_); }
    /* bonds of the initial cracks */
    int64_t cut_count() const { return peri_cut_count(handle_); }
    /* bonds broken, or cut later */
    int64_t broken_count() const { return peri_broken_count(handle_); }
    /* steps, load steps too, since reset */
    int64_t step_count() const { return peri_step_count(handle_); }
    /* [T] since build or reset */
    double time() const { return peri_time(handle_); }
    /* that loads act with; 0 before any did */
    double load_factor() const { return peri_load_factor(handle_); }
    /* How bonds are worked on: "columns, AVX-512", "list, SSE2", "rows", "reference". */
    const char * kernel_text() const { return peri_kernel_text(handle_); }
    /* Largest stable time step [T], to 4 % at rest; of state-based bodies that can break, a bound. Takes 20 to
       100 steps once: docs/accuracy.md. 0 before peri_build. */
    double stable_step() const { return peri_stable_step(handle_); }
    /* Rows [first, first+count) of the families ([T] 3.11) to rows[count*width]: ascending, padded with the
       row's own number; broken bonds are listed. capacity counts entries. */
    int32_t get_families(int64_t first_, int64_t count_, span<int32_t> rows_) {
        const int32_t result_ = peri_get_families(handle_, first_, count_, rows_.data(), int64_t(rows_.size()));
        check(result_);
        return result_;
    }
    std::vector<int32_t> get_families(int64_t first_, int64_t count_) {
        std::vector<int32_t> rows_(static_cast<std::size_t>(int64_t(count_)*family_width()));
        (void)get_families(first_, count_, rows_);
        return rows_;
    }
    /* The point nearest to x[dim] [L]; _in_place: where it is now. */
    int32_t find_point(span<const double> x_) {
        detail::sized(x_.size(), dimension(), "x");
        const int32_t result_ = peri_find_point(handle_, x_.data());
        check(result_);
        return result_;
    }
    /* The point nearest to x[dim] [L]; _in_place: where it is now. */
    int32_t find_point_in_place(span<const double> x_) {
        detail::sized(x_.size(), dimension(), "x");
        const int32_t result_ = peri_find_point_in_place(handle_, x_.data());
        check(result_);
        return result_;
    }
    /* 1: bond (i,j) carries force; 0: broken or cut; PERI_ERROR_PAIR: no such bond. */
    int32_t bond_is_intact(int32_t i_, int32_t j_) {
        const int32_t result_ = peri_bond_is_intact(handle_, i_, j_);
        check(result_);
        return result_;
    }
    /* Motion, time, steps, load factor and ledger become zero, broken bonds whole. Initial cracks, sets, loads,
       obstacles and no-fail zones stay. */
    int32_t reset() {
        const int32_t result_ = peri_reset(handle_);
        check(result_);
        return result_;
    }

    /* ---- sets ---- */
    /* name (copied) may be NULL. Reference positions; box and ball include their boundary to 1e-9 spacings. */
    int32_t select_box(const char *name_, span<const double> lo_, span<const double> hi_) {
        detail::sized(lo_.size(), dimension(), "lo");
        detail::sized(hi_.size(), dimension(), "hi");
        const int32_t result_ = peri_select_box(handle_, name_, lo_.data(), hi_.data());
        check(result_);
        return result_;
    }
    /* name (copied) may be NULL. Reference positions; box and ball include their boundary to 1e-9 spacings. */
    int32_t select_ball(const char *name_, span<const double> centre_, double radius_) {
        detail::sized(centre_.size(), dimension(), "centre");
        const int32_t result_ = peri_select_ball(handle_, name_, centre_.data(), radius_);
        check(result_);
        return result_;
    }
    /* By present positions. */
    int32_t select_box_in_place(const char *name_, span<const double> lo_, span<const double> hi_) {
        detail::sized(lo_.size(), dimension(), "lo");
        detail::sized(hi_.size(), dimension(), "hi");
        const int32_t result_ = peri_select_box_in_place(handle_, name_, lo_.data(), hi_.data());
        check(result_);
        return result_;
    }
    /* By present positions. */
    int32_t select_ball_in_place(const char *name_, span<const double> centre_, double radius_) {
        detail::sized(centre_.size(), dimension(), "centre");
        const int32_t result_ = peri_select_ball_in_place(handle_, name_, centre_.data(), radius_);
        check(result_);
        return result_;
    }
    int32_t select_if(const char *name_, const point_fn &take_) {
        detail::point_fn_holder context_ = {dimension(), take_};
        const int32_t result_ = peri_select_if(handle_, name_, take_ ? detail::point_fn_holder::call_c : nullptr, &context_);
        check(result_);
        return result_;
    }
    int32_t select_points(const char *name_, span<const int32_t> points_) {
        const int32_t result_ = peri_select_points(handle_, name_, int64_t(points_.size()), points_.data());
        check(result_);
        return result_;
    }
    /* id, or PERI_ERROR_NAME */
    int32_t find_set(const char *name_) const {
        const int32_t result_ = peri_find_set(handle_, name_);
        check(result_);
        return result_;
    }
    /* id, or PERI_ERROR_NAME */
    int64_t size_of_set(int32_t set_) const {
        const int64_t result_ = peri_size_of_set(handle_, set_);
        check(result_);
        return result_;
    }
    /* id, or PERI_ERROR_NAME */
    int32_t get_set(int32_t set_, span<int32_t> points_) {
        const int32_t result_ = peri_get_set(handle_, set_, points_.data(), int64_t(points_.size()));
        check(result_);
        return result_;
    }
    std::vector<int32_t> get_set(int32_t set_) {
        std::vector<int32_t> points_(static_cast<std::size_t>(size_of_set(set_)));
        (void)get_set(set_, points_);
        return points_;
    }

    /* ---- cracks and failure ---- */
    /* Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a
       spacing. Returns the number of bonds newly cut. 2D */
    int64_t cut_segment(int32_t standing_, span<const double> from_, span<const double> to_) {
        detail::sized(from_.size(), dimension(), "from");
        detail::sized(to_.size(), dimension(), "to");
        const int64_t result_ = peri_cut_segment(handle_, standing_, from_.data(), to_.data());
        check(result_);
        return result_;
    }
    /* Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a
       spacing. Returns the number of bonds newly cut. 2D, [count*2] */
    int64_t cut_polyline(int32_t standing_, span<const double> vertices_) {
        if (vertices_.size() % std::size_t(2) != 0) detail::refuse("vertices");
        const int64_t result_ = peri_cut_polyline(handle_, standing_, int64_t(vertices_.size() / std::size_t(2)), vertices_.data());
        check(result_);
        return result_;
    }
    /* Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a
       spacing. Returns the number of bonds newly cut. 3D */
    int64_t cut_disc(int32_t standing_, span<const double> centre_, span<const double> normal_, double radius_) {
        detail::sized(centre_.size(), dimension(), "centre");
        detail::sized(normal_.size(), dimension(), "normal");
        const int64_t result_ = peri_cut_disc(handle_, standing_, centre_.data(), normal_.data(), radius_);
        check(result_);
        return result_;
    }
    /* Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a
       spacing. Returns the number of bonds newly cut. 3D */
    int64_t cut_triangle(int32_t standing_, span<const double> p_, span<const double> q_, span<const double> r_) {
        detail::sized(p_.size(), dimension(), "p");
        detail::sized(q_.size(), dimension(), "q");
        detail::sized(r_.size(), dimension(), "r");
        const int64_t result_ = peri_cut_triangle(handle_, standing_, p_.data(), q_.data(), r_.data());
        check(result_);
        return result_;
    }
    /* Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a
       spacing. Returns the number of bonds newly cut. 3D, or parallelogram */
    int64_t cut_rectangle(int32_t standing_, span<const double> corner_, span<const double> edge1_, span<const double> edge2_) {
        detail::sized(corner_.size(), dimension(), "corner");
        detail::sized(edge1_.size(), dimension(), "edge1");
        detail::sized(edge2_.size(), dimension(), "edge2");
        const int64_t result_ = peri_cut_rectangle(handle_, standing_, corner_.data(), edge1_.data(), edge2_.data());
        check(result_);
        return result_;
    }
    /* Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a
       spacing. Returns the number of bonds newly cut. [count*2] points; each pair must be a bond */
    int64_t cut_pairs(int32_t standing_, span<const int32_t> pairs_) {
        if (pairs_.size() % std::size_t(2) != 0) detail::refuse("pairs");
        const int64_t result_ = peri_cut_pairs(handle_, standing_, int64_t(pairs_.size() / std::size_t(2)), pairs_.data());
        check(result_);
        return result_;
    }
    /* Cuts each bond whose straight line from point to point meets the crack; touching counts, to 1e-9 of a
       spacing. Returns the number of bonds newly cut. */
    int64_t cut_if(int32_t standing_, const pair_fn &cut_) {
        detail::pair_fn_holder context_ = {dimension(), cut_};
        const int64_t result_ = peri_cut_if(handle_, standing_, cut_ ? detail::pair_fn_holder::call_c : nullptr, &context_);
        check(result_);
        return result_;
    }
    /* Bonds with an end in the set never break by a criterion (on = 1), or may again (0). Cuts still cut. */
    int32_t set_no_fail(int32_t set_, int32_t on_) {
        const int32_t result_ = peri_set_no_fail(handle_, set_, on_);
        check(result_);
        return result_;
    }
    /* fn is called for every bond that breaks by its criterion; NULL removes. Costs two to three bits per bond. */
    int32_t on_break(const break_fn &fn_ = nullptr) {
        std::shared_ptr<detail::break_fn_holder> context_(new detail::break_fn_holder{dimension(), fn_});
        if (fn_) keep_->keep(context_);
        const int32_t result_ = peri_on_break(handle_, fn_ ? detail::break_fn_holder::call_c : nullptr, context_.get());
        check(result_);
        return result_;
    }
    /* Strength of bonds, times that of points: factors[count] of pairs[count*2], or of intact bonds that `take`
       takes. Returns how many. */
    int64_t set_strength_pairs(span<const int32_t> pairs_, span<const double> factors_) {
        detail::sized(pairs_.size(), int64_t(factors_.size())*2, "pairs");
        const int64_t result_ = peri_set_strength_pairs(handle_, int64_t(factors_.size()), pairs_.data(), factors_.data());
        check(result_);
        return result_;
    }
    /* Strength of bonds, times that of points: factors[count] of pairs[count*2], or of intact bonds that `take`
       takes. Returns how many. */
    int64_t set_strength_if(double factor_, const pair_fn &take_) {
        detail::pair_fn_holder context_ = {dimension(), take_};
        const int64_t result_ = peri_set_strength_if(handle_, factor_, take_ ? detail::pair_fn_holder::call_c : nullptr, &context_);
        check(result_);
        return result_;
    }
    /* on = 1: keeps when bonds between adjacent points break, for peri_get_cracks: 32 to 44 bytes per point. */
    int32_t record_breaks(int32_t on_) {
        const int32_t result_ = peri_record_breaks(handle_, on_);
        check(result_);
        return result_;
    }

    /* ---- fragments: points joined by bonds that carry force ---- */
    /* How many there are, and which each point is in: of_point[points], or NULL. They are numbered 0, 1, ... by
       their least points when first asked for. Of one that has split since, the piece of most points keeps the
       number; the others get the next ones. Free where no bond broke. */
    int64_t find_fragments(span<int32_t> of_point_ = nullptr) {
        const int64_t result_ = peri_find_fragments(handle_, of_point_.data(), int64_t(of_point_.size()));
        check(result_);
        return result_;
    }
    /* out[k] is fragment k. */
    int32_t get_fragments(span<peri_fragment> out_) {
        const int32_t result_ = peri_get_fragments(handle_, out_.data(), int64_t(out_.size()));
        check(result_);
        return result_;
    }
    std::vector<peri_fragment> get_fragments() {
        std::vector<peri_fragment> out_(static_cast<std::size_t>(find_fragments(nullptr)));
        (void)get_fragments(out_);
        return out_;
    }
    /* The closed surface of a fragment, or of all (-1), now, by cells. vertices[][dim] [L]; faces[][dim] of
       vertices: in 2D edges with the fragment on the left, loop by loop, edge k from vertex k on; in 3D
       triangles, counter-clockwise from outside. owners[], or NULL: its point; inner[], or NULL: 1 where a crack
       made it. Points and cells of yours are squares or cubes. */
    int32_t size_of_outline(int32_t fragment_, span<int64_t> vertices_, span<int64_t> faces_) {
        detail::sized(vertices_.size(), 1, "vertices");
        detail::sized(faces_.size(), 1, "faces");
        const int32_t result_ = peri_size_of_outline(handle_, fragment_, vertices_.data(), faces_.data());
        check(result_);
        return result_;
    }
    /* The closed surface of a fragment, or of all (-1), now, by cells. vertices[][dim] [L]; faces[][dim] of
       vertices: in 2D edges with the fragment on the left, loop by loop, edge k from vertex k on; in 3D
       triangles, counter-clockwise from outside. owners[], or NULL: its point; inner[], or NULL: 1 where a crack
       made it. Points and cells of yours are squares or cubes. */
    int32_t get_outline(int32_t fragment_, span<double> vertices_, span<int32_t> faces_, span<int32_t> owners_ = nullptr, span<int32_t> inner_ = nullptr) {
        if (vertices_.size() % std::size_t(dimension()) != 0) detail::refuse("vertices");
        if (faces_.size() % std::size_t(dimension()) != 0) detail::refuse("faces");
        if (!owners_.empty()) detail::sized(owners_.size(), int64_t(faces_.size() / std::size_t(dimension())), "owners");
        if (!inner_.empty()) detail::sized(inner_.size(), int64_t(faces_.size() / std::size_t(dimension())), "inner");
        const int32_t result_ = peri_get_outline(handle_, fragment_, vertices_.data(), int64_t(vertices_.size() / std::size_t(dimension())), faces_.data(), owners_.data(), inner_.data(), int64_t(faces_.size() / std::size_t(dimension())));
        check(result_);
        return result_;
    }

    /* ---- initial state ---- */
    /* Add value[dim] to the displacement [L] or velocity [L T^-1] of a set, now; peri_reset clears both. Sums
       are below 1e15 spacings, 1e9 speeds of sound. */
    int32_t add_displacement(int32_t set_, span<const double> value_) {
        detail::sized(value_.size(), dimension(), "value");
        const int32_t result_ = peri_add_displacement(handle_, set_, value_.data());
        check(result_);
        return result_;
    }
    /* Add value[dim] to the displacement [L] or velocity [L T^-1] of a set, now; peri_reset clears both. Sums
       are below 1e15 spacings, 1e9 speeds of sound. */
    int32_t add_velocity(int32_t set_, span<const double> value_) {
        detail::sized(value_.size(), dimension(), "value");
        const int32_t result_ = peri_add_velocity(handle_, set_, value_.data());
        check(result_);
        return result_;
    }
    /* Supports: prescribe the `axes` of displacement [L] or velocity [L T^-1] of a set: value[dim] (NULL =
       zero), or as fn says (may be NULL). Later supports win. The load factor multiplies a constant
       displacement, not a velocity. A grip should be a horizon deep, of state-based laws two. */
    int32_t prescribe_displacement(int32_t set_, int32_t axes_, span<const double> value_ = nullptr, const load_fn &fn_ = nullptr) {
        if (!value_.empty()) detail::sized(value_.size(), dimension(), "value");
        std::shared_ptr<detail::load_fn_holder> context_(new detail::load_fn_holder{dimension(), fn_});
        if (fn_) keep_->keep(context_);
        const int32_t result_ = peri_prescribe_displacement(handle_, set_, axes_, value_.data(), fn_ ? detail::load_fn_holder::call_c : nullptr, context_.get());
        check(result_);
        return result_;
    }
    /* Supports: prescribe the `axes` of displacement [L] or velocity [L T^-1] of a set: value[dim] (NULL =
       zero), or as fn says (may be NULL). Later supports win. The load factor multiplies a constant
       displacement, not a velocity. A grip should be a horizon deep, of state-based laws two. */
    int32_t prescribe_velocity(int32_t set_, int32_t axes_, span<const double> value_ = nullptr, const load_fn &fn_ = nullptr) {
        if (!value_.empty()) detail::sized(value_.size(), dimension(), "value");
        std::shared_ptr<detail::load_fn_holder> context_(new detail::load_fn_holder{dimension(), fn_});
        if (fn_) keep_->keep(context_);
        const int32_t result_ = peri_prescribe_velocity(handle_, set_, axes_, value_.data(), fn_ ? detail::load_fn_holder::call_c : nullptr, context_.get());
        check(result_);
        return result_;
    }
    /* Support: the set moves as a rigid body. motion: displacement [L], then in 2D the angle about centre[dim],
       in 3D a vector along the axis as long as the angle; NULL: 0. The load factor multiplies it; or fn writes
       it (may be NULL). */
    int32_t prescribe_rigid(int32_t set_, span<const double> centre_, span<const double> motion_ = nullptr, const rigid_fn &fn_ = nullptr) {
        detail::sized(centre_.size(), dimension(), "centre");
        if (!motion_.empty()) detail::sized(motion_.size(), dimension()+(2 * dimension() - 3), "motion");
        std::shared_ptr<detail::rigid_fn_holder> context_(new detail::rigid_fn_holder{dimension(), fn_});
        if (fn_) keep_->keep(context_);
        const int32_t result_ = peri_prescribe_rigid(handle_, set_, centre_.data(), motion_.data(), fn_ ? detail::rigid_fn_holder::call_c : nullptr, context_.get());
        check(result_);
        return result_;
    }
    /* Body force density value[dim] [M L^-2 T^-2] on a set; gravity is density times g. */
    int32_t apply_body_force(int32_t set_, span<const double> value_, const load_fn &fn_ = nullptr) {
        detail::sized(value_.size(), dimension(), "value");
        std::shared_ptr<detail::load_fn_holder> context_(new detail::load_fn_holder{dimension(), fn_});
        if (fn_) keep_->keep(context_);
        const int32_t result_ = peri_apply_body_force(handle_, set_, value_.data(), fn_ ? detail::load_fn_holder::call_c : nullptr, context_.get());
        check(result_);
        return result_;
    }
    /* Traction value[dim] [M L^-1 T^-2] on a flat face of `area` [L^2] (2D: length [L]) and outward `normal`.
       The set: all points within two horizons of it, of one material. Uniform stress is exact for
       correspondence; else the total is, and strain is off by O(horizon). ([C] 2.5, docs/statics.md) */
    int32_t apply_traction(int32_t set_, double area_, span<const double> normal_, span<const double> value_, const load_fn &fn_ = nullptr) {
        detail::sized(normal_.size(), dimension(), "normal");
        detail::sized(value_.size(), dimension(), "value");
        std::shared_ptr<detail::load_fn_holder> context_(new detail::load_fn_holder{dimension(), fn_});
        if (fn_) keep_->keep(context_);
        const int32_t result_ = peri_apply_traction(handle_, set_, area_, normal_.data(), value_.data(), fn_ ? detail::load_fn_holder::call_c : nullptr, context_.get());
        check(result_);
        return result_;
    }
    /* A total of value*area (in 2D times the thickness), spread over the set by volume: on the outermost layer,
       say. Exact in sum, but strain near the face is wrong by O(1) ([C] 2.5). */
    int32_t apply_layer_traction(int32_t set_, double area_, span<const double> value_, const load_fn &fn_ = nullptr) {
        detail::sized(value_.size(), dimension(), "value");
        std::shared_ptr<detail::load_fn_holder> context_(new detail::load_fn_holder{dimension(), fn_});
        if (fn_) keep_->keep(context_);
        const int32_t result_ = peri_apply_layer_traction(handle_, set_, area_, value_.data(), fn_ ? detail::load_fn_holder::call_c : nullptr, context_.get());
        check(result_);
        return result_;
    }
    /* Pressure [M L^-1 T^-2] on all surfaces of a set, faces of cracks included ([C] 2.6): for a crack select
       the points within two horizons of it. fn: value[k*dim] is the pressure on point k. */
    int32_t apply_pressure(int32_t set_, double pressure_, const load_fn &fn_ = nullptr) {
        std::shared_ptr<detail::load_fn_holder> context_(new detail::load_fn_holder{dimension(), fn_});
        if (fn_) keep_->keep(context_);
        const int32_t result_ = peri_apply_pressure(handle_, set_, pressure_, fn_ ? detail::load_fn_holder::call_c : nullptr, context_.get());
        check(result_);
        return result_;
    }
    /* As [C] 2.6 has it: through the cut bonds between neighbouring points. */
    int32_t apply_bond_pressure_for_comparison(int32_t set_, double pressure_, const load_fn &fn_ = nullptr) {
        std::shared_ptr<detail::load_fn_holder> context_(new detail::load_fn_holder{dimension(), fn_});
        if (fn_) keep_->keep(context_);
        const int32_t result_ = peri_apply_bond_pressure_for_comparison(handle_, set_, pressure_, fn_ ? detail::load_fn_holder::call_c : nullptr, context_.get());
        check(result_);
        return result_;
    }
    /* ids are not used twice */
    int32_t remove_load(int32_t load_) {
        const int32_t result_ = peri_remove_load(handle_, load_);
        check(result_);
        return result_;
    }
    /* Force [M L T^-2] to force[dim]: of a support on the body, mean of the last step (or of the equilibrium);
       of a load, its present total. */
    int32_t get_reaction(int32_t load_, span<double> force_) {
        detail::sized(force_.size(), dimension(), "force");
        const int32_t result_ = peri_get_reaction(handle_, load_, force_.data());
        check(result_);
        return result_;
    }
    std::vector<double> get_reaction(int32_t load_) {
        std::vector<double> force_(static_cast<std::size_t>(dimension()));
        (void)get_reaction(load_, force_);
        return force_;
    }
    /* Its moment about place[dim] [M L^2 T^-2] to moment[1] (2D) or [3]. */
    int32_t get_reaction_moment(int32_t load_, span<const double> place_, span<double> moment_) {
        detail::sized(place_.size(), dimension(), "place");
        detail::sized(moment_.size(), (2 * dimension() - 3), "moment");
        const int32_t result_ = peri_get_reaction_moment(handle_, load_, place_.data(), moment_.data());
        check(result_);
        return result_;
    }
    std::vector<double> get_reaction_moment(int32_t load_, span<const double> place_) {
        std::vector<double> moment_(static_cast<std::size_t>((2 * dimension() - 3)));
        (void)get_reaction_moment(load_, place_, moment_);
        return moment_;
    }
    /* A mesh is copied, and must be closed. */
    int32_t add_obstacle(const obstacle_desc &desc_) {
        peri_obstacle_desc desc_raw = desc_;
        if (desc_.distance || desc_.motion) {
            std::shared_ptr<detail::obstacle_desc_user> desc_user_context_(new detail::obstacle_desc_user{dimension(), desc_.distance, desc_.motion});
            detail::obstacle_desc_user::fill(desc_raw, desc_user_context_.get());
            keep_->keep(desc_user_context_);
        }
        const int32_t result_ = peri_add_obstacle(handle_, &desc_raw);
        check(result_);
        return result_;
    }
    /* A mesh is copied, and must be closed. */
    int32_t remove_obstacle(int32_t obstacle_) {
        const int32_t result_ = peri_remove_obstacle(handle_, obstacle_);
        check(result_);
        return result_;
    }
    /* On the body: force[dim] [M L T^-2]; moment[3], in 2D [1], [M L^2 T^-2] about its place. Either may be
       NULL. */
    int32_t get_obstacle_force(int32_t obstacle_, span<double> force_ = nullptr, span<double> moment_ = nullptr) {
        if (!force_.empty()) detail::sized(force_.size(), dimension(), "force");
        if (!moment_.empty()) detail::sized(moment_.size(), (2 * dimension() - 3), "moment");
        const int32_t result_ = peri_get_obstacle_force(handle_, obstacle_, force_.data(), moment_.data());
        check(result_);
        return result_;
    }
    int32_t get_obstacle_state(int32_t obstacle_, peri_obstacle_state &state_) {
        const int32_t result_ = peri_get_obstacle_state(handle_, obstacle_, &state_);
        check(result_);
        return result_;
    }
    peri_obstacle_state get_obstacle_state(int32_t obstacle_) {
        peri_obstacle_state state_ = peri_obstacle_state();
        (void)get_obstacle_state(obstacle_, state_);
        return state_;
    }
    /* Sets place, turn, velocity and spin of a free one. */
    int32_t set_obstacle_state(int32_t obstacle_, const obstacle_state &state_) {
        const int32_t result_ = peri_set_obstacle_state(handle_, obstacle_, &state_);
        check(result_);
        return result_;
    }

    /* ---- contact ---- */
    /* Of materials i and j, ids or PERI_ALL; NULL: none. */
    int32_t set_contact(int32_t i_, int32_t j_, const contact_desc *desc_) {
        const int32_t result_ = peri_set_contact(handle_, i_, j_, desc_);
        check(result_);
        return result_;
    }

    /* ---- motion ---- */
    /* Advances the body in time. PERI_ERROR_STEP: it ends at a whole step; the value is what may follow. So does
       PERI_ERROR_CALLBACK of a peri_frame_fn or peri_break_fn. PERI_ERROR_UNSTABLE, and PERI_ERROR_CALLBACK of a
       load or obstacle (index: the point): it ended within a step; read it, then reset or destroy it. */
    int32_t advance(const advance_desc &desc_) {
        peri_advance_desc desc_raw = desc_;
        detail::advance_desc_user desc_user_context_ = {this, dimension(), desc_.on_frame};
        if (desc_.on_frame) detail::advance_desc_user::fill(desc_raw, &desc_user_context_);
        const int32_t result_ = peri_advance(handle_, &desc_raw);
        check(result_);
        return result_;
    }

    /* ---- a time loop or a solver of yours ---- */
    /* Forces at a displacement of yours. A step, rho of PERI_FIELD_DENSITY: v += dt/2 force/rho, u += dt v,
       peri_evaluate, v += (dt/2 force + impulse)/rho. report may be NULL. */
    int32_t evaluate(const evaluate_desc &desc_, peri_evaluate_report &report_) {
        const int32_t result_ = peri_evaluate(handle_, &desc_, &report_);
        check(result_);
        return result_;
    }

    /* ---- equilibrium ---- */
    /* Equilibrium under supports and loads, constant values times a factor from load_from to load_to, callbacks
       at time = factor, prescribed velocities at rest; bonds over their limit break until none does. A later run
       goes on at load_to. A failed step leaves the last equilibrium, or, after breaks, how far it came; so does
       PERI_ENDED_SEVERED. */
    int32_t solve(const solve_desc &desc_, peri_solve_report &report_) {
        peri_solve_desc desc_raw = desc_;
        detail::solve_desc_user desc_user_context_ = {this, dimension(), desc_.on_iteration, desc_.on_step};
        if (desc_.on_iteration || desc_.on_step) detail::solve_desc_user::fill(desc_raw, &desc_user_context_);
        const int32_t result_ = peri_solve(handle_, &desc_raw, &report_);
        check(result_);
        return result_;
    }
    peri_solve_report solve(const solve_desc &desc_) {
        peri_solve_report report_ = peri_solve_report();
        (void)solve(desc_, report_);
        return report_;
    }
    /* peri_advance by implicit steps, `time_step` > 0 of any size (generalised alpha, order 2). rho [0, 1]: what
       is left of the highest modes per step; 1 keeps the energy. solve: tolerance, fracture, limits,
       on_iteration; NULL: defaults. No obstacles or contact. A step that fails leaves the last one, less the
       bonds that broke in it. report may be NULL. */
    int32_t advance_implicit(const advance_desc &advance_, const solve_desc &solve_, double rho_, peri_solve_report &report_) {
        peri_advance_desc advance_raw = advance_;
        detail::advance_desc_user advance_user_context_ = {this, dimension(), advance_.on_frame};
        if (advance_.on_frame) detail::advance_desc_user::fill(advance_raw, &advance_user_context_);
        peri_solve_desc solve_raw = solve_;
        detail::solve_desc_user solve_user_context_ = {this, dimension(), solve_.on_iteration, solve_.on_step};
        if (solve_.on_iteration || solve_.on_step) detail::solve_desc_user::fill(solve_raw, &solve_user_context_);
        const int32_t result_ = peri_advance_implicit(handle_, &advance_raw, &solve_raw, rho_, &report_);
        check(result_);
        return result_;
    }
    /* out = K in [M L T^-2], the tangent at the present displacement times in[count], count = points*dim;
       without supports, obstacles and contact. out may be in. The first call takes memory (peri_memory.state). */
    int32_t multiply_stiffness(span<const double> in_, span<double> out_) {
        detail::sized(out_.size(), int64_t(in_.size()), "out");
        const int32_t result_ = peri_multiply_stiffness(handle_, in_.data(), out_.data(), int64_t(in_.size()));
        check(result_);
        return result_;
    }
    std::vector<double> multiply_stiffness(span<const double> in_) {
        std::vector<double> out_(static_cast<std::size_t>(in_.size()));
        (void)multiply_stiffness(in_, out_);
        return out_;
    }
    /* The same at `displacement` [points*dim] of yours instead: the body stays where it is. */
    int32_t multiply_stiffness_at(span<const double> displacement_, span<const double> in_, span<double> out_) {
        detail::sized(displacement_.size(), point_count()*dimension(), "displacement");
        detail::sized(out_.size(), int64_t(in_.size()), "out");
        const int32_t result_ = peri_multiply_stiffness_at(handle_, displacement_.data(), in_.data(), out_.data(), int64_t(in_.size()));
        check(result_);
        return result_;
    }
    std::vector<double> multiply_stiffness_at(span<const double> displacement_, span<const double> in_) {
        std::vector<double> out_(static_cast<std::size_t>(in_.size()));
        (void)multiply_stiffness_at(displacement_, in_, out_);
        return out_;
    }
    /* The same as a matrix by compressed rows, points*dim square ([T] 3.2, 3.3). It outlives the body; free it
       by peri_matrix_destroy. */
    matrix matrix_create() {
        peri_matrix *made_ = nullptr;
        const int32_t result_ = peri_matrix_create(handle_, &made_);
        check(result_);
        return matrix(made_, dimension());
    }

    /* ---- results ---- */
    /* Entries of a field: points*components. */
    int64_t size_of_field(int32_t field_) const {
        const int64_t result_ = peri_size_of_field(handle_, field_);
        check(result_);
        return result_;
    }
    /* Copies a field, as double, in your units and order. capacity counts doubles. */
    int32_t get_field(int32_t field_, span<double> out_) {
        const int32_t result_ = peri_get_field(handle_, field_, out_.data(), int64_t(out_.size()));
        check(result_);
        return result_;
    }
    std::vector<double> get_field(int32_t field_) {
        std::vector<double> out_(static_cast<std::size_t>(size_of_field(field_)));
        (void)get_field(field_, out_);
        return out_;
    }
    /* Sets a field W of all points; count = points*components. What peri_get_field gives changes no bit. Fields
       of material (docs/laws.md), which peri_frame_fn may set, too, outlast peri_reset. */
    int32_t set_field(int32_t field_, span<const double> in_) {
        const int32_t result_ = peri_set_field(handle_, field_, in_.data(), int64_t(in_.size()));
        check(result_);
        return result_;
    }
    /* Without a copy. Of a stored field it shows the present state; of a derived one that of the call, until it
       is viewed again. */
    int32_t view_field(int32_t field_, peri_view &view_) {
        const int32_t result_ = peri_view_field(handle_, field_, &view_);
        check(result_);
        return result_;
    }
    peri_view view_field(int32_t field_) {
        peri_view view_ = peri_view();
        (void)view_field(field_, view_);
        return view_;
    }
    /* Of points[count] alone: count*components. */
    int32_t get_field_at(int32_t field_, span<const int32_t> points_, span<double> out_) {
        const int32_t result_ = peri_get_field_at(handle_, field_, int64_t(points_.size()), points_.data(), out_.data(), int64_t(out_.size()));
        check(result_);
        return result_;
    }
    /* At places[count*dim] [L], in_place = 1: present ones: linear fields exactly, not across cracks. Outside:
       NaN. */
    int32_t interpolate_field(int32_t field_, int32_t in_place_, span<const double> places_, span<double> out_) {
        if (places_.size() % std::size_t(dimension()) != 0) detail::refuse("places");
        const int32_t result_ = peri_interpolate_field(handle_, field_, in_place_, int64_t(places_.size() / std::size_t(dimension())), places_.data(), out_.data(), int64_t(out_.size()));
        check(result_);
        return result_;
    }
    /* Bonds of the points of a set, as in peri_get_families. */
    int64_t size_of_bonds(int32_t set_, int32_t bond_) const {
        const int64_t result_ = peri_size_of_bonds(handle_, set_, bond_);
        check(result_);
        return result_;
    }
    /* Bonds of the points of a set, as in peri_get_families. */
    int32_t get_bonds(int32_t set_, int32_t bond_, span<double> out_) {
        const int32_t result_ = peri_get_bonds(handle_, set_, bond_, out_.data(), int64_t(out_.size()));
        check(result_);
        return result_;
    }
    /* Costs one evaluation of the forces. */
    int32_t get_energy(peri_energy &energy_) {
        const int32_t result_ = peri_get_energy(handle_, &energy_);
        check(result_);
        return result_;
    }
    peri_energy get_energy() {
        peri_energy energy_ = peri_energy();
        (void)get_energy(energy_);
        return energy_;
    }
    /* Momentum [M L T^-1] to linear[dim], about the origin [M L^2 T^-1] to angular[1] (2D) or [3]. Either may be
       NULL. */
    int32_t get_momentum(span<double> linear_ = nullptr, span<double> angular_ = nullptr) {
        if (!linear_.empty()) detail::sized(linear_.size(), dimension(), "linear");
        if (!angular_.empty()) detail::sized(angular_.size(), (2 * dimension() - 3), "angular");
        const int32_t result_ = peri_get_momentum(handle_, linear_.data(), angular_.data());
        check(result_);
        return result_;
    }
    cracks cracks_create(const cracks_desc &desc_) {
        peri_cracks *made_ = nullptr;
        const int32_t result_ = peri_cracks_create(handle_, &desc_, &made_);
        check(result_);
        return cracks(made_, dimension());
    }
    /* VTK XML for ParaView; "Warp By Vector" shows the deformed body. */
    int32_t export_vtu_to(const write_fn &write_) {
        detail::write_fn_holder context_ = {dimension(), write_};
        const int32_t result_ = peri_export_vtu_to(handle_, write_ ? detail::write_fn_holder::call_c : nullptr, &context_);
        check(result_);
        return result_;
    }
    /* fields[count], each once, or NULL: as above. */
    int32_t export_fields_to(span<const int32_t> fields_, const write_fn &write_) {
        detail::write_fn_holder context_ = {dimension(), write_};
        const int32_t result_ = peri_export_fields_to(handle_, fields_.data(), int64_t(fields_.size()), write_ ? detail::write_fn_holder::call_c : nullptr, &context_);
        check(result_);
        return result_;
    }
    /* One CSV line: step, time, the ledger, broken and cut bonds; header = 1: the names first. */
    int32_t export_history_to(int32_t header_, const write_fn &write_) {
        detail::write_fn_holder context_ = {dimension(), write_};
        const int32_t result_ = peri_export_history_to(handle_, header_, write_ ? detail::write_fn_holder::call_c : nullptr, &context_);
        check(result_);
        return result_;
    }
    int32_t export_vtu(const char *path_) {
        const int32_t result_ = peri_export_vtu(handle_, path_);
        check(result_);
        return result_;
    }
    /* Frame 0, 1, ... of a series: its VTU beside `path`, a .pvd. */
    int32_t export_frame(const char *path_, int64_t frame_, span<const int32_t> fields_ = nullptr) {
        const int32_t result_ = peri_export_frame(handle_, path_, frame_, fields_.data(), int64_t(fields_.size()));
        check(result_);
        return result_;
    }
    /* append = 0 starts the file with a header, 1 adds a line. */
    int32_t export_history(const char *path_, int32_t append_) {
        const int32_t result_ = peri_export_history(handle_, path_, append_);
        check(result_);
        return result_;
    }
    /* Saves the state: motion, bonds, what criteria keep, time, ledger. Not the scene: load it into a body that
       the same calls built. What follows has the same bits. */
    int32_t save_state_to(const write_fn &write_) {
        detail::write_fn_holder context_ = {dimension(), write_};
        const int32_t result_ = peri_save_state_to(handle_, write_ ? detail::write_fn_holder::call_c : nullptr, &context_);
        check(result_);
        return result_;
    }
    /* Reads all, verifies it, then takes it. PERI_ERROR_STATE: nothing has changed; field: what is of another
       scene, or "". */
    int32_t load_state_from(const read_fn &read_) {
        detail::read_fn_holder context_ = {dimension(), read_};
        const int32_t result_ = peri_load_state_from(handle_, read_ ? detail::read_fn_holder::call_c : nullptr, &context_);
        check(result_);
        return result_;
    }
    int32_t save_state(const char *path_) {
        const int32_t result_ = peri_save_state(handle_, path_);
        check(result_);
        return result_;
    }
    int32_t load_state(const char *path_) {
        const int32_t result_ = peri_load_state(handle_, path_);
        check(result_);
        return result_;
    }

    /* ---- what a scene costs ---- */
    int32_t get_memory(peri_memory &memory_) const {
        const int32_t result_ = peri_get_memory(handle_, &memory_);
        check(result_);
        return result_;
    }
    peri_memory get_memory() const {
        peri_memory memory_ = peri_memory();
        (void)get_memory(memory_);
        return memory_;
    }

private:
    void check(int64_t result) const {
        detail::rethrow();
        if (result < 0) {
            peri_error record = detail::plain(0, "");
            (void)peri_get_error(handle_, &record);
            detail::known(result, &record);
        }
    }
    peri_body *handle_;
    std::shared_ptr<detail::keeper> keep_;
};

/* *body is NULL on failure. error may be NULL. */
inline body body_create(const body_desc &desc_) {
    peri_body_desc desc_raw = desc_;
    std::shared_ptr<detail::keeper> keep = std::make_shared<detail::keeper>();
    if (desc_.influence_fn) {
        std::shared_ptr<detail::body_desc_influence_user> desc_influence_user_context_(new detail::body_desc_influence_user{desc_.space == PERI_SPACE_SOLID ? 3 : 2, desc_.influence_fn});
        detail::body_desc_influence_user::fill(desc_raw, desc_influence_user_context_.get());
        keep->keep(desc_influence_user_context_);
    }
    if (desc_.log) {
        std::shared_ptr<detail::body_desc_log_user> desc_log_user_context_(new detail::body_desc_log_user{desc_.space == PERI_SPACE_SOLID ? 3 : 2, desc_.log});
        detail::body_desc_log_user::fill(desc_raw, desc_log_user_context_.get());
        keep->keep(desc_log_user_context_);
    }
    peri_body *made_ = nullptr;
    peri_error error_ = detail::plain(0, "");
    const int32_t result_ = peri_body_create(&desc_raw, &made_, &error_);
    detail::known(result_, &error_);
    return body(made_, keep);
}

/* What a scene will cost, before it is made: some milliseconds. Refuses what peri_body_create,
   peri_add_material, peri_add_box and peri_build would refuse. error may be NULL. */
inline int32_t plan(const plan_desc &desc_, peri_plan_report &report_) {
    peri_error error_ = detail::plain(0, "");
    const int32_t result_ = peri_plan(&desc_, &report_, &error_);
    detail::known(result_, &error_);
    return result_;
}
inline peri_plan_report plan(const plan_desc &desc_) {
    peri_plan_report report_ = peri_plan_report();
    (void)plan(desc_, report_);
    return report_;
}

/* Fills body (precision, influence, quadrature, correction, horizon) and material (law, poisson, stabilization)
   with the best choice, from a measured table; the rest stays. body needs its space, material its constants.
   PERI_ERROR_RANGE: out of reach; the value is what is in reach. error may be NULL. */
inline int32_t choose(const choose_desc &desc_, peri_body_desc &body_, peri_material_desc &material_, peri_choose_report &report_) {
    peri_error error_ = detail::plain(0, "");
    const int32_t result_ = peri_choose(&desc_, &body_, &material_, &report_, &error_);
    detail::known(result_, &error_);
    return result_;
}
inline peri_choose_report choose(const choose_desc &desc_, peri_body_desc &body_, peri_material_desc &material_) {
    peri_choose_report report_ = peri_choose_report();
    (void)choose(desc_, body_, material_, report_);
    return report_;
}

inline body::body(const body_desc &desc) : body(body_create(desc)) {}

} /* namespace peri */

#endif
