# SPDX-License-Identifier: MIT
"""cpp.py - bindings/cpp/peri.hpp: one header, C++11."""
import re

from model import camel, short, wrap

HEAD = r"""/* peri.hpp - peri for C++: objects that own, spans, closures, exceptions. Made from peri.h by tools/bind.py: edit that.
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
"""


def comment(doc, indent=""):
    if not doc:
        return []
    lines = wrap(doc.replace("*/", "* /"), 110 - len(indent))
    lines[0] = "/* " + lines[0]
    lines[-1] += " */"
    return [indent + (("   " + x) if k else x) for k, x in enumerate(lines)]


class Cpp:
    def __init__(self, model):
        self.m = model
        self.kept = {}  # (struct or function) contexts

    # ---- callbacks: a std::function type each, and a trampoline -------------------------------------------------------

    def closure(self, name):
        c = self.m.callbacks[name]
        args = []
        for p in c["params"]:
            if p.get("kind") == "user" or (p["name"] == "count" and any(q.get("entries", "").startswith("count") for q in c["params"])) \
                    or (p["name"] == "count" and any(q["role"] == "bytes" for q in c["params"])):
                continue
            args.append(self.closure_type(p))
        returns = "void" if c["returns"] == "void" else "int32_t"
        return "std::function<%s(%s)>" % (returns, ", ".join(args))

    def closure_type(self, p):
        const = "const " if p["const"] else ""
        if p["role"] == "handle":
            return self.m.classes[p["type"]].lower() + " &"
        if p["role"] == "bytes":
            return "span<%sunsigned char>" % const
        if p["role"] in ("array in", "array out"):
            return p["type"] + " &" if p.get("entries") == "1" and not p["const"] else "span<%s%s>" % (const, p["type"])
        if p["role"].startswith("struct"):
            return const + p["type"] + " &"
        return "const char *" if p["role"] == "text" else p["type"] + (" " + "*" * p["pointer"] if p["pointer"] else "")

    def closure_doc(self, c):
        names = [p["name"] for p in c["params"] if p.get("kind") != "user"]
        return c["doc"] + (" " if c["doc"] else "") + "(" + ", ".join(names) + ")"

    def trampoline(self, name, holder, member):
        """A function of C that calls holder->member."""
        c = self.m.callbacks[name]
        params, args = [], []
        counted = [q for q in c["params"] if q.get("entries", "").startswith("count")]
        bytes_ = any(q["role"] == "bytes" for q in c["params"])
        for p in c["params"]:
            const = "const " if p["const"] else ""
            star = "*" * p["pointer"]
            params.append("%s%s %s%s" % (const, p["type"], star, p["name"] + "_" if p.get("kind") != "user" else "user_"))
            own = p["name"] + "_"
            if p.get("kind") == "user" or (p["name"] == "count" and (counted or bytes_)):
                continue
            if p["role"] == "handle":
                args.append("*self.owner")
            elif p["role"] == "bytes":
                args.append("span<%sunsigned char>(static_cast<%sunsigned char *>(%s), std::size_t(count_))" % (const, const, own))
            elif p["role"] in ("array in", "array out"):
                if p.get("entries") == "1" and not p["const"]:
                    args.append("*" + own)
                    continue
                entries = re.sub(r"\bturns\b", "(2 * self.dim - 3)", re.sub(r"\bdim\b", "self.dim", p["entries"]))
                entries = re.sub(r"\bcount\b", "count_", entries)
                args.append("span<%s%s>(%s, std::size_t(%s))" % (const, p["type"], own, entries))
            elif p["role"].startswith("struct"):
                args.append("*" + own)
            else:
                args.append(own)
        call = "self.%s(%s)" % (member, ", ".join(args))
        if any(p["role"] == "handle" for p in c["params"]):
            params = [re.sub(r"\b(body|cracks|matrix)_$", "", p).rstrip() for p in params]
        if c["returns"] == "void":
            body = "(void)guarded([&]() { %s; return int32_t(0); });" % call
        else:
            body = "return guarded([&]() -> int32_t { return %s; });" % call
        return ["    static %s %s_c(%s) {" % (c["returns"], member, ", ".join(params)),
                "        %s &self = *static_cast<%s *>(user_);" % (holder, holder),
                "        " + body, "    }"]

    # ---- structs -----------------------------------------------------------------------------------------------------

    def contexts(self, s):
        """For each user field of a struct, the closures that share it."""
        out = {}
        for f in self.m.calls(s["name"]):
            out.setdefault(f["user"], []).append(f)
        return out

    def struct(self, s):
        name, own = s["name"], short(s["name"])
        calls = self.m.calls(name)
        init = next((f for f in self.m.functions if f["name"] == name + "_init"), None)
        if not init:
            return ["typedef %s %s;" % (name, own)] if own != "error" else []
        extra = [p for p in init["params"] if p["kind"] == "value"]
        out = [""] + comment("%s, filled with the defaults. %s" % (name, s["doc"])) + ["struct %s : %s {" % (own, name)]
        given = ", ".join("%s %s_" % (p["type"], p["name"]) for p in extra)
        out.append("    %s%s(%s) : %s() { %s_init(this%s); }" % ("explicit " if extra else "", own, given, name, name,
                                                              "".join(", %s_" % p["name"] for p in extra)))
        if not extra:
            out.append("    %s(const %s &plain_) : %s(plain_) {}" % (own, name, name))
        for f in calls:
            out += comment(f["doc"] + " " + self.closure_doc(self.m.callbacks[f["type"]]), "    ")
            out.append("    %s %s;" % (self.closure(f["type"]), f["name"]))
        out.append("};")
        for user, fields in self.contexts(s).items():
            holder = "%s_%s" % (own, user)
            out += ["", "namespace detail {", "struct %s {" % holder]
            if any(p["role"] == "handle" for f in fields for p in self.m.callbacks[f["type"]]["params"]):
                out.append("    body *owner;")
            out.append("    int dim;")
            for f in fields:
                out.append("    %s %s;" % (self.closure(f["type"]), f["name"]))
                out += self.trampoline(f["type"], holder, f["name"])
            out += ["    static void fill(%s &to, %s *self) {" % (name, holder), "        to.%s = self;" % user]
            for f in fields:
                out.append("        if (self->%s) to.%s = %s_c;" % (f["name"], f["name"], f["name"]))
            out += ["    }", "};", "} /* namespace detail */"]
        return out

    # ---- methods -----------------------------------------------------------------------------------------------------

    def kind_of(self, p):
        const = "const " if p["const"] else ""
        if p["kind"] == "callback":
            return "const %s &" % short(p["type"])
        if p["kind"] == "text":
            return "const char *"
        if p["kind"] in ("array in", "array out"):
            return "span<%s%s> " % (const, p["type"])
        if p["kind"] == "struct in":
            own = short(p["type"]) if p["type"] != "peri_error" else p["type"]
            return "const %s %s" % (own, "*" if p.get("optional") else "&")
        if p["kind"] in ("struct out", "struct in out"):
            return "%s %s" % (p["type"], "&")
        return p["type"] + " "

    def size_word(self, f):
        names = {p["name"] for p in f["params"] if p["kind"] == "value"}
        dim = "dimension()" if f["class"] == "Body" else "dim_"

        def of(w):
            if w in names:
                return "int64_t(%s_)" % w
            cracks = f["class"] != "Body"
            return {"dim": dim, "turns": "(2 * %s - 3)" % dim, "points": "point_count()", "width": "family_width()",
                    "rows": "rows()", "entries": "entries()", "paths": "paths()", "vertices": "vertices()" if cracks else None,
                    "tips": "tips()", "size_of_field": "size_of_field(field_)", "size_of_set": "size_of_set(set_)",
                    "fragments": "find_fragments(nullptr)"}.get(w)
        return of

    def length_text(self, f, p):
        of = self.size_word(f)
        factor = p["factor"]
        divide = "" if factor == "1" else " / std::size_t(%s)" % re.sub(r"[a-z]\w*", lambda m: of(m.group()) or m.group(), factor)
        return "int64_t(%s_.size()%s)" % (p["source"], divide)

    def method(self, f):
        m = self.m
        shown = m.visible(f)
        of = self.size_word(f)
        sizes = m.sizes(f, of)
        before, args, after = [], [], []
        lengths = {p["name"]: self.length_text(f, p) for p in f["params"] if p["kind"] == "length"}

        def count_or(w):
            return lengths[w] if w in lengths else of(w)
        checks = m.sizes(f, count_or)
        record = "nullptr"
        for p in f["params"]:
            k, own = p["kind"], p["name"] + "_"
            if k == "self":
                args.append("handle_")
            elif k == "new":
                before.append("%s *made_ = nullptr;" % p["type"])
                args.append("&made_")
            elif k == "length":
                args.append(lengths[p["name"]])
            elif k == "error":
                before.append("peri_error error_ = detail::plain(0, \"\");")
                args.append("&error_")
                record = "&error_"
            elif k in ("array in", "array out"):
                size = checks.get(p["name"])
                text = p["entries"]
                trivial = [q for q in f["params"] if q["kind"] == "length" and q["source"] == p["name"]]
                if trivial and trivial[0]["factor"] != "1":
                    before.append("if (%s.size() %% std::size_t(%s) != 0) detail::refuse(\"%s\");" % (own, re.sub(
                        r"[a-z]\w*", lambda x: of(x.group()) or x.group(), trivial[0]["factor"]), p["name"]))
                elif size and text not in ("capacity",) and not trivial:
                    check = "detail::sized(%s.size(), %s, \"%s\");" % (own, size, p["name"])
                    before.append(("if (!%s.empty()) " % own if p.get("optional") else "") + check)
                args.append("%s.data()" % own)
            elif k == "struct in":
                calls = m.calls(p["type"])
                pointed = "(%s)" % own if p.get("optional") else own
                if calls:
                    before.append("%s %sraw = %s;" % (p["type"], own, own))
                    for user, fields in self.contexts(m.structs[p["type"]]).items():
                        before += self.context(f, p, user, fields)
                    args.append("&%sraw" % own)
                else:
                    args.append(pointed.strip("()") if p.get("optional") else "&" + own)
            elif k in ("struct out", "struct in out"):
                args.append("&" + own)
            elif k == "callback":
                before += self.argument_context(f, p)
                args += ["%s ? detail::%s_holder::call_c : nullptr" % (own, short(p["type"])), self.last_context]
            elif k == "user":
                pass
            else:
                args.append(own)
        return self.emit(f, shown, before, args, record, sizes)

    def dim_of(self, f):
        if f["name"] == "peri_body_create":
            return "desc_.space == PERI_SPACE_SOLID ? 3 : 2"
        return "dimension()" if f["class"] == "Body" else "dim_" if f["class"] else "2"

    def context(self, f, p, user, fields):
        own = short(p["type"])
        holder = "detail::%s_%s" % (own, user)
        handle = any(q["role"] == "handle" for g in fields for q in self.m.callbacks[g["type"]]["params"])
        some = " || ".join("%s_.%s" % (p["name"], g["name"]) for g in fields)
        values = (["this"] if handle else []) + [self.dim_of(f)] + ["%s_.%s" % (p["name"], g["name"]) for g in fields]
        make = "{" + ", ".join(values) + "}"
        name = "%s_%s_context_" % (p["name"], user)
        if all(g["type"] in __import__("model").PASSING for g in fields):
            return ["%s %s = %s;" % (holder, name, make),
                    "if (%s) %s::fill(%s_raw, &%s);" % (some, holder, p["name"], name)]
        keeper = "keep_" if f["class"] == "Body" else "keep"
        lines = [] if f["class"] == "Body" else ["std::shared_ptr<detail::keeper> keep = std::make_shared<detail::keeper>();"] \
            if user == next(iter(self.contexts(self.m.structs[p["type"]]))) else []
        return lines + ["if (%s) {" % some,
                        "    std::shared_ptr<%s> %s(new %s%s);" % (holder, name, holder, make),
                        "    %s::fill(%s_raw, %s.get());" % (holder, p["name"], name),
                        "    %s->keep(%s);" % (keeper, name), "}"]

    def argument_context(self, f, p):
        from model import PASSING
        holder = "detail::%s_holder" % short(p["type"])
        handle = any(q["role"] == "handle" for q in self.m.callbacks[p["type"]]["params"])
        make = "{%s%s, %s_}" % ("this, " if handle else "", self.dim_of(f), p["name"])
        if p["type"] in PASSING:
            self.last_context = "&context_"
            return ["%s context_ = %s;" % (holder, make)]
        self.last_context = "context_.get()"
        return ["std::shared_ptr<%s> context_(new %s%s);" % (holder, holder, make), "if (%s_) keep_->keep(context_);" % p["name"]]

    def emit(self, f, shown, before, args, record, sizes):
        name = f["method"]
        defaults, parts = True, []
        for p in reversed(shown):  # optional ones at the end may be left out
            text = self.kind_of(p) + p["name"] + "_"
            defaults = defaults and bool(p.get("optional")) and p["kind"] not in ("struct in", "struct out")
            parts.insert(0, text + (" = nullptr" if defaults else ""))
        call = "%s(%s)" % (f["name"], ", ".join(args))
        const = " const" if f["class"] and (f["params"][0]["const"]) else ""
        static = "" if f["class"] else "inline "
        out = comment(f["doc"], "    " if f["class"] else "")
        pad = "    " if f["class"] else ""
        if f["plain"]:
            return out + [pad + "%s%s %s(%s)%s { return %s; }" % (static, f["returns"] if f["returns"][-1] == "*" else f["returns"] + "",
                                                              name, ", ".join(parts), const, call)]
        returns = f["returns"]
        done = "return result_;"
        if f["makes"]:
            made = self.m.classes[f["makes"]["type"]].lower()
            returns = made
            keep = "keep_" if f["class"] else "keep"
            done = "return %s(made_, %s);" % (made, keep if made == "body" else "dimension()")
        out.append(pad + "%s%s %s(%s)%s {" % (static, returns, name, ", ".join(parts), const))
        out += [pad + "    " + b for b in before]
        out.append(pad + "    const %s result_ = %s;" % (f["returns"], call))
        if record == "nullptr" and f["class"] == "Body":
            out.append(pad + "    check(result_);")
        else:
            out.append(pad + "    detail::known(result_, %s);" % record)
        out += [pad + "    " + done, pad + "}"]
        # the same with its results returned
        if f["outs"] and len(f["outs"]) == 1 and not f["outs"][0].get("optional"):
            out += self.returning(f, shown, parts, sizes, const, pad, static)
        return out

    def returning(self, f, shown, parts, sizes, const, pad, static):
        p = f["outs"][0]
        given = [x for q, x in zip(shown, parts) if q is not p]
        names = ", ".join(q["name"] + "_" for q in shown)
        own = p["name"] + "_"
        name = f["method"]
        if p["kind"] == "struct out":
            kind, make = p["type"], "%s %s = %s();" % (p["type"], own, p["type"])
        elif p["entries"] == "1":
            kind, make = p["type"], "%s %s = 0;" % (p["type"], own)
            names = ", ".join("span<%s>(&%s, 1)" % (p["type"], own) if q is p else q["name"] + "_" for q in shown)
        elif sizes.get(p["name"]) or p["entries"] == "count":
            size = sizes.get(p["name"]) or next(q["name"] + "_.size()" for q in shown if q["kind"] == "array in" and q["entries"] == "count")
            kind, make = "std::vector<%s>" % p["type"], "std::vector<%s> %s(static_cast<std::size_t>(%s));" % (p["type"], own, size)
        else:
            return []
        return [pad + "%s%s %s(%s)%s {" % (static, kind, name, ", ".join(given), const), pad + "    " + make,
                pad + "    (void)%s(%s);" % (name, names), pad + "    return %s;" % own, pad + "}"]

    # ---- the whole ---------------------------------------------------------------------------------------------------

    def classes(self):
        out = []
        order = sorted(self.m.classes.items(), key=lambda c: c[1] == "Body")
        for c, name in order:
            own = name.lower()
            doc = next(o["doc"] for o in self.m.api["opaque"] if o["name"] == c)
            second = "std::shared_ptr<detail::keeper> keep" if own == "body" else "int dim"
            member = "keep_(std::move(keep))" if own == "body" else "dim_(dim)"
            moved = "keep_(std::move(other.keep_))" if own == "body" else "dim_(other.dim_)"
            swap = "keep_.swap(other.keep_);" if own == "body" else "std::swap(dim_, other.dim_);"
            out += [""] + comment("Owns a %s; moves, and is not copied. %s" % (c, "" if doc == "opaque" else doc)) + ["class %s {" % own, "public:"]
            out += ["    %s(%s *handle, %s) : handle_(handle), %s {}" % (own, c, second, member),
                    "    %s(%s &&other) noexcept : handle_(other.handle_), %s { other.handle_ = nullptr; }" % (own, own, moved),
                    "    %s &operator=(%s &&other) noexcept {" % (own, own), "        std::swap(handle_, other.handle_);", "        " + swap,
                    "        return *this;", "    }",
                    "    %s(const %s &) = delete;" % (own, own), "    %s &operator=(const %s &) = delete;" % (own, own),
                    "    ~%s() { %s_destroy(handle_); }" % (own, c)]
            if own == "body":
                out += ["    explicit body(const body_desc &desc);",
                        "    /* The handle, for what C takes. */"]
            out.append("    %s *get() const { return handle_; }" % c)
            section = ""
            for f in self.m.functions:
                if f["class"] == name and not f["inner"]:
                    if f["section"] != section:
                        section = f["section"]
                        out += ["", "    /* ---- %s ---- */" % section]
                    out += self.method(f)
            out += ["", "private:"]
            if own == "body":
                out += ["    void check(int64_t result) const {", "        detail::rethrow();", "        if (result < 0) {",
                        "            peri_error record = detail::plain(0, \"\");", "            (void)peri_get_error(handle_, &record);",
                        "            detail::known(result, &record);", "        }", "    }"]
            out += ["    %s *handle_;" % c, "    std::shared_ptr<detail::keeper> keep_;" if own == "body" else "    int dim_;", "};"]
        return out

    def text(self):
        m = self.m
        out = HEAD.rstrip("\n").split("\n")
        out += [""] + ["class %s;" % n.lower() for n in m.classes.values()]
        out.append("")
        from model import RAW
        for c in m.api["callbacks"]:
            if c["name"] not in RAW:
                out += comment(self.closure_doc(c))
                out.append("typedef %s %s;" % (self.closure(c["name"]), short(c["name"])))
        out += ["", "namespace detail {"]
        used = {p["type"] for f in m.functions for p in f["params"] if p["kind"] == "callback"}
        for c in m.api["callbacks"]:
            if c["name"] in used:
                out += ["struct %s_holder {" % short(c["name"]), "    int dim;", "    %s call;" % short(c["name"])]
                out += self.trampoline(c["name"], short(c["name"]) + "_holder", "call") + ["};"]
        out.append("} /* namespace detail */")
        for s in m.api["structs"]:
            out += self.struct(s)
        out += self.classes()
        for f in m.functions:
            if not f["class"] and not f["inner"]:
                out += [""] + self.method(f)
        out += ["", "inline body::body(const body_desc &desc) : body(body_create(desc)) {}", "", "} /* namespace peri */", "", "#endif"]
        return "\n".join(out) + "\n"


def files(model):
    return {"bindings/cpp/peri.hpp": Cpp(model).text()}
