# SPDX-License-Identifier: MIT
"""fortran.py - bindings/fortran/peri.f90: a module of Fortran 2008."""
import re

from model import PASSING, RAW, short, wrap

TYPES = {"double": "real(c_double)", "float": "real(c_float)", "int32_t": "integer(c_int32_t)", "int64_t": "integer(c_int64_t)",
         "uint32_t": "integer(c_int32_t)", "uint64_t": "integer(c_int64_t)"}

HEAD = r"""! SPDX-License-Identifier: MIT
! peri.f90 - peri for Fortran 2008. Made from peri.h by tools/bind.py: edit that.
!
! Names are those of peri.h; body is type(peri_body), and what C returns comes from a function, or by an argument where there is
! none to return. Lengths follow from the arrays. A callback is a bind(c) procedure of an interface below, and has its data in a
! module, or where user=c_loc(data) says. Each call takes stat= and errmsg=, like allocate: without stat, a failure is an error
! stop. A name '' stands for NULL. Points count from 0. A body is freed by call peri_body_destroy(body); do not copy it.

! What C has, as it is; use peri, not this.
module peri_c
    use, intrinsic :: iso_c_binding
    implicit none
"""

INNER = r"""
contains

    subroutine text_of(from, text)
        type(c_ptr), value :: from
        character(:), allocatable, intent(out) :: text
        character(kind=c_char), pointer :: letters(:)
        integer :: n
        text = ''
        if (.not. c_associated(from)) return
        call c_f_pointer(from, letters, [400])
        do n = 1, 399
            if (letters(n) == c_null_char) exit
            text = text // letters(n)
        end do
    end subroutine

    pure function c_text(text) result(out)
        character(*), intent(in) :: text
        character(kind=c_char) :: out(len(text) + 1)
        integer :: k
        do k = 1, len(text)
            out(k) = text(k:k)
        end do
        out(len(text) + 1) = c_null_char
    end function

    ! "" stands for NULL
    subroutine optional_text(text, at)
        character(kind=c_char), intent(in), target :: text(:)
        type(c_ptr), intent(out) :: at
        at = c_null_ptr
        if (size(text) > 1) at = c_loc(text(1))
    end subroutine

    function c_ptr_of(given) result(at)
        type(c_ptr), intent(in), optional :: given
        type(c_ptr) :: at
        at = c_null_ptr
        if (present(given)) at = given
    end function

    ! What went wrong, as stat and errmsg have it; an error stop where there is no stat.
    subroutine failed(record, stat, errmsg)
        type(peri_error), intent(in), target :: record
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        character(kind=c_char), target :: letters(400)
        character(:), allocatable :: text
        integer(c_int64_t) :: length
        type(c_ptr) :: at
        letters = c_null_char
        at = c_loc(letters(1)) ! not within the calls: gfortran 12 passes the length of a letter with it
        length = c_format_error(record, at, 400_c_int64_t)
        if (length < 0) return
        call text_of(at, text)
        if (present(errmsg)) errmsg = text
        if (present(stat)) then
            stat = record%code
        else
            write (error_unit, '(a)') text
            error stop 'peri: a call failed, and has no stat='
        end if
    end subroutine

    subroutine refused(field, stat, errmsg)
        character(*), intent(in) :: field
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        type(peri_error) :: record
        character(kind=c_char), target :: letters(len(field) + 1)
        letters = c_text(field)
        record%code = PERI_ERROR_ARGUMENT
        record%index = -1
        record%field = c_loc(letters(1))
        record%text = c_status_text(PERI_ERROR_ARGUMENT)
        call failed(record, stat, errmsg)
    end subroutine

    ! The record of a failed call of a body: stat, field, index and value.
    subroutine peri_get_error(body, record)
        type(peri_body), intent(in) :: body
        type(peri_error), intent(out) :: record
        integer(c_int32_t) :: result_
        result_ = c_get_error(body%handle, record)
        if (result_ < 0) record%code = result_
    end subroutine

    ! The field of a record.
    function peri_field_of_error(record) result(text)
        type(peri_error), intent(in) :: record
        character(:), allocatable :: text
        call text_of(record%field, text)
    end function

    function peri_status_text(status) result(text)
        integer, intent(in) :: status
        character(:), allocatable :: text
        call text_of(c_status_text(int(status, c_int32_t)), text)
    end function

    function peri_version() result(version)
        integer :: version
        version = c_version()
    end function

    pure function peri_id_index(id) result(index)
        integer(c_int32_t), intent(in) :: id
        integer(c_int32_t) :: index
        index = iand(id, int(z'FFFFF', c_int32_t))
    end function

    ! A field in place, nothing copied: component k of point i, both from 0, is data(1 + i*point_stride + k*component_stride).
    subroutine peri_view_pointer(view, data)
        type(peri_view), intent(in) :: view
        real(c_double), pointer, intent(out) :: data(:)
        nullify (data)
        if (view%type /= PERI_TYPE_F64 .or. view%count < 1) return
        call c_f_pointer(view%data, data, [(view%count - 1)*view%point_stride + (view%components - 1)*view%component_stride + 1])
    end subroutine
"""


def comment(doc, indent="    "):
    return [indent + "! " + x for x in wrap(doc, 125 - len(indent))] if doc else []


def fold(line, width=130):
    """Continued after a comma or blank."""
    out = []
    while len(line) > width:
        cut = max(line.rfind(", ", 0, width - 2) + 1, line.rfind(" ", 0, width - 2))
        if cut <= len(line) - len(line.lstrip()) + 4:
            break
        indent = re.match(r" *", line).group() + "    " if not out else re.match(r" *", out[0]).group() + "    "
        out.append(line[:cut].rstrip() + " &")
        line = indent + line[cut:].lstrip()
    return out + [line]


class Fortran:
    def __init__(self, model):
        self.m = model

    def intent(self, p):
        return "in" if p["const"] else "inout"

    # ---- interfaces of C ---------------------------------------------------------------------------------------------------

    def c_arg(self, p):
        name = p["name"]
        t = p["type"]
        if t in self.m.callbacks:
            return "type(c_funptr), value :: " + name
        if p["pointer"] and (t in ("char", "void") or t in self.m.classes):
            if p["pointer"] == 2:
                return "type(c_ptr), intent(out) :: " + name
            return "type(c_ptr), value :: " + name
        if p["pointer"] and t in self.m.structs:
            if p.get("optional") or p.get("entries") not in (None, "1"):
                return "type(c_ptr), value :: " + name
            return "type(%s), intent(%s) :: %s" % (t, self.intent(p), name)
        if p["pointer"]:
            return "type(c_ptr), value :: " + name
        return TYPES[t] + ", value :: " + name

    def interface(self, f):
        names = [p["name"] for p in f["params"]]
        kind = "subroutine" if f["returns"] == "void" else "function"
        line = "        %s c_%s(%s) bind(c, name='%s')" % (kind, short(f["name"]), ", ".join(names), f["name"])
        out = fold(line) + ["            import"]
        out += ["            " + self.c_arg(p) for p in f["params"]]
        if kind == "function":
            returns = "type(c_ptr)" if "*" in f["returns"] else TYPES[f["returns"]]
            out.append("            %s :: c_%s" % (returns, short(f["name"])))
        return out + ["        end " + kind]

    def callback(self, c):
        names = [p["name"] for p in c["params"]]
        void = c["returns"] == "void"
        kind = "subroutine" if void else "function"
        out = [""] + comment(c["doc"], "        ")
        out += fold("        %s %s(%s) bind(c)%s" % (kind, c["name"], ", ".join(names), "" if void else " result(result_)")) + ["            import"]
        for p in c["params"]:
            if p.get("kind") == "user" or p["type"] in ("void", "char") or p["role"] == "handle":
                out.append("            type(c_ptr), value :: " + p["name"])
            elif p["role"] in ("array in", "array out"):
                one = p.get("entries") == "1" and not p["const"]
                size = re.sub(r"\b(dim|turns)\b.*", "*", p["entries"]) if p.get("entries") else "*"
                size = "*" if re.search(r"dim|turns", p.get("entries", "*")) else size
                out.append("            %s, intent(%s) :: %s%s" % (TYPES[p["type"]], self.intent(p), p["name"], "" if one else "(%s)" % size))
            elif p["role"].startswith("struct"):
                out.append("            type(%s), intent(%s) :: %s" % (p["type"], self.intent(p), p["name"]))
            else:
                out.append("            %s, value :: %s" % (TYPES[p["type"]], p["name"]))
        if not void:
            out.append("            integer(c_int32_t) :: result_")
        return out + ["        end " + kind]

    # ---- wrappers ----------------------------------------------------------------------------------------------------------

    def size_word(self, f):
        values = {p["name"] for p in f["params"] if p["kind"] == "value"}
        body = f["class"] == "Body"
        h = f["params"][0]["name"]

        def of(w):
            if w in values:
                return w
            dim = "int(c_dimension(%s%%handle))" % h if body else "int(%s%%dim)" % h
            return {"dim": dim, "turns": "(2*%s - 3)" % dim, "points": "c_point_count(%s%%handle)" % h,
                    "width": "c_family_width(%s%%handle)" % h, "rows": "c_matrix_rows(%s%%handle)" % h, "entries": "c_matrix_entries(%s%%handle)" % h,
                    "paths": "c_cracks_paths(%s%%handle)" % h, "vertices": None if body else "c_cracks_vertices(%s%%handle)" % h,
                    "tips": "c_cracks_tips(%s%%handle)" % h}.get(w)
        return of

    def wrapper(self, f):
        m, of = self.m, self.size_word(f)
        lengths = {}
        for p in f["params"]:
            if p["kind"] == "length":
                factor = "" if p["factor"] == "1" else "/(%s)" % (of(p["factor"]) or p["factor"])
                source = next(q for q in f["params"] if q["name"] == p["source"])
                has = "size(%s, kind=c_int64_t)" % p["source"]
                lengths[p["name"]] = (p["name"] + "_", has + factor) if source.get("optional") else (has + factor, "")
        checks = m.sizes(f, lambda w: lengths[w][0] if w in lengths else of(w))
        names, declared, local, before, args, after = [], [], [], [], [], []
        outs_later = []
        for p in f["params"]:
            k, n = p["kind"], p["name"]
            optional = ", optional" if p.get("optional") else ""
            if k == "self":
                names.append(n)
                declared.append("type(%s), intent(in) :: %s" % (p["type"], n))
                args.append(n + "%handle")
            elif k == "new":
                names.append(n)
                declared.append("type(%s), intent(out) :: %s" % (p["type"], n))
                args.append(n + "%handle")
                if p["type"] != "peri_body":
                    after.append("%s%%dim = c_dimension(%s%%handle)" % (n, f["params"][0]["name"]))
            elif k == "length":
                value, extra = lengths[n]
                if extra:
                    local.append("integer(c_int64_t) :: %s_" % n)
                    source = next(q["source"] for q in f["params"] if q["name"] == n and q["kind"] == "length")
                    before += ["%s_ = 0" % n, "if (present(%s)) %s_ = %s" % (source, n, extra)]
                args.append(value)
            elif k == "error":
                local.append("type(peri_error), target :: record")
                args.append("c_loc(record)")
            elif k == "user":
                names.append(n)
                outs_later.append(n)
                declared.append("type(c_ptr), intent(in), optional :: " + n)
                args.append("c_ptr_of(%s)" % n)
            elif k in ("array in", "array out") and k == "array out" and p["entries"] == "1" and not p.get("optional"):
                names.append(n)
                declared.append("%s, intent(out), target :: %s" % (TYPES[p["type"]], n))
                args.append("c_loc(%s)" % n)
            elif k in ("array in", "array out"):
                names.append(n)
                one = p["entries"] == "1" and k == "array out"
                base = TYPES.get(p["type"], "type(%s)" % p["type"])
                shape = "" if one else "(:)"
                declared.append("%s, intent(%s)%s, target%s :: %s%s" % (base, self.intent(p), optional, "" if one else ", contiguous", n, shape))
                sources = [q for q in f["params"] if q["kind"] == "length" and q["source"] == n]
                size = checks.get(n)
                if not one:
                    test = None
                    if sources and sources[0]["factor"] != "1":
                        test = "mod(size(%s), %s) /= 0" % (n, of(sources[0]["factor"]) or sources[0]["factor"])
                    elif size and not sources:
                        test = "size(%s) /= %s" % (n, size)
                    if test and p.get("optional"):
                        before += ["if (present(%s)) then" % n, "    if (%s) then" % test, "        call refused('%s', stat, errmsg)" % n,
                                   "        return", "    end if", "end if"]
                    elif test:
                        before += ["if (%s) then" % test, "    call refused('%s', stat, errmsg)" % n, "    return", "end if"]
                local.append("type(c_ptr) :: %s_at" % n)
                at = ["%s_at = c_null_ptr" % n]
                if p.get("optional"):
                    at.append("if (present(%s)) %s_at = c_loc(%s)" % (n, n, n if one else n + "(1)") if one else
                              "if (present(%s)) %s_at = c_loc(%s)" % (n, n, n))
                else:
                    at.append("if (size(%s) > 0) %s_at = c_loc(%s)" % (n, n, n))
                before += at
                args.append(n + "_at")
            elif k in ("struct in", "struct out", "struct in out"):
                names.append(n)
                by = p.get("optional")
                if by:
                    declared.append("type(%s), intent(%s), optional, target :: %s" % (p["type"], self.intent(p), n))
                    local.append("type(c_ptr) :: %s_at" % n)
                    before += ["%s_at = c_null_ptr" % n, "if (present(%s)) %s_at = c_loc(%s)" % (n, n, n)]
                    args.append(n + "_at")
                else:
                    declared.append("type(%s), intent(%s) :: %s" % (p["type"], self.intent(p), n))
                    args.append(n)
            elif k == "callback":
                names.append(n)
                needed = p["type"] in PASSING
                declared.append("procedure(%s)%s :: %s" % (p["type"], "" if needed else ", optional", n))
                local.append("type(c_funptr) :: %s_at" % n)
                before += ["%s_at = c_funloc(%s)" % (n, n)] if needed else ["%s_at = c_null_funptr" % n, "if (present(%s)) %s_at = c_funloc(%s)" % (n, n, n)]
                args.append(n + "_at")
            elif k == "text":
                names.append(n)
                declared.append("character(*), intent(in) :: " + n)
                local.append("character(kind=c_char), target :: %s_c(len(%s) + 1)" % (n, n))
                local.append("type(c_ptr) :: %s_at" % n)
                before += ["%s_c = c_text(%s)" % (n, n), "%s_at = c_loc(%s_c(1))" % (n, n)]
                if p.get("optional"):
                    before.append("call optional_text(%s_c, %s_at)" % (n, n))
                args.append(n + "_at")
            else:
                names.append(n)
                declared.append("%s, intent(in) :: %s" % (TYPES[p["type"]], n))
                args.append(n)
        return self.emit(f, names, declared, local, before, args, after)

    def emit(self, f, names, declared, local, before, args, after):
        name = f["name"]
        own_record = any(p["kind"] == "error" for p in f["params"])
        call = "c_%s(%s)" % (short(name), ", ".join(args))
        out = [""] + comment(f["doc"])
        if f["plain"]:
            if f["result"] == "text":
                out += ["    function %s(%s) result(result_)" % (name, ", ".join(names))] + ["        " + d for d in declared]
                return out + ["        character(:), allocatable :: result_", "        call text_of(%s, result_)" % call, "    end function"]
            out += ["    function %s(%s) result(result_)" % (name, ", ".join(names))] + ["        " + d for d in declared]
            return out + ["        %s :: result_" % TYPES[f["returns"]], "        result_ = " + call, "    end function"]
        # a subroutine where all that comes back is in the arguments, else a function
        gives = self.gives(f)
        kind = "function" if gives else "subroutine"
        head = "    %s %s(%s)%s" % (kind, name, ", ".join(names + ["stat", "errmsg"]), " result(result_)" if gives else "")
        out += fold(head) + ["        " + d for d in declared]
        out += ["        integer, intent(out), optional :: stat", "        character(*), intent(inout), optional :: errmsg"]
        out += ["        %s :: result_" % TYPES[f["returns"]]] + ["        " + x for x in local]
        if not own_record:
            out.append("        type(peri_error) :: record")
        out += (["        result_ = PERI_ERROR_ARGUMENT"] if gives and any("refused" in b for b in before) else [])
        out += ["        " + b for b in before] + fold("        result_ = " + call)
        out += ["        if (result_ < 0) then"]
        if own_record:
            out += ["            record%code = int(result_, c_int32_t)"]
        else:
            if f["class"] == "Body":
                out += ["            if (c_get_error(%s%%handle, record) < 0) record%%code = 0" % f["params"][0]["name"]]
            out += ["            if (record%code /= result_) then"] if f["class"] == "Body" else []
            pad = "    " if f["class"] == "Body" else ""
            out += [pad + "            record%code = int(result_, c_int32_t)", pad + "            record%index = -1", pad + "            record%value = 0",
                    pad + "            record%field = c_null_ptr",
                    pad + "            record%text = c_status_text(record%code)"]
            out += ["            end if"] if f["class"] == "Body" else []
        out += ["            call failed(record, stat, errmsg)", "            return", "        end if"]
        out += ["        " + a for a in after]
        return out + ["        if (present(stat)) stat = %s" % ("int(result_)" if not gives else "0"), "    end " + kind]

    @staticmethod
    def gives(f):
        """Whether the result is an id or a count, not only a status: it says so, or comes from a call that adds, selects, finds, ..."""
        if f["returns"] == "int64_t":
            return True
        name = short(f["name"])
        return bool(re.match(r"(add_(material|obstacle)|select_|find_|prescribe_|apply_|id$|bond_is_)", name))

    # ---- structs -----------------------------------------------------------------------------------------------------------

    def struct(self, s):
        out = [""] + comment(s["doc"]) + ["    type, bind(c) :: " + s["name"]]
        for f in s["fields"]:
            t = f["type"]
            if t in self.m.callbacks:
                text = "type(c_funptr) :: %s = c_null_funptr" % f["name"]
            elif f["pointer"]:
                text = "type(c_ptr) :: %s = c_null_ptr" % f["name"]
            elif t in self.m.structs:
                text = "type(%s) :: %s" % (t, f["name"])
            else:
                text = "%s :: %s%s = 0" % (TYPES[t], f["name"], "(%d)" % f["length"] if f["length"] else "")
            said = f["doc"]
            if f["kind"] == "callback":
                said = ("c_funloc of a %s. " % t) + said
            out += comment(said, "        ") + ["        " + text]
        return out + ["    end type"]

    def text(self):
        m = self.m
        out = HEAD.rstrip("\n").split("\n")
        for c in m.api["constants"]:
            if isinstance(c["value"], int):
                out.append("    integer(c_int32_t), parameter :: %s = %d" % (c["name"], c["value"]))
        for e in m.api["enums"]:
            out.append("")
            for v in e["values"]:
                out += comment(v["doc"]) + ["    integer(c_int32_t), parameter :: %s = %d" % (v["name"], v["value"])]
        for o in m.api["opaque"]:
            dim = ["        integer(c_int32_t) :: dim = 0"] if o["name"] != "peri_body" else []
            out += [""] + comment("" if o["doc"] == "opaque" else o["doc"])
            out += ["    type :: " + o["name"], "        type(c_ptr) :: handle = c_null_ptr"] + dim + ["    end type"]
        for s in m.api["structs"]:
            out += self.struct(s)
        out += ["", "    abstract interface"]
        for c in m.api["callbacks"]:
            if c["name"] not in RAW:
                out += self.callback(c)
        out += ["    end interface", "", "    interface"]
        for f in m.functions:
            out += self.interface(f)
        out += ["    end interface", "end module", "", "module peri", "    use peri_c", "    use, intrinsic :: iso_fortran_env, only: error_unit", "    implicit none",
                "    private :: text_of, c_text, failed, refused, optional_text, c_ptr_of, error_unit"]
        out += ["    private :: c_" + short(f["name"]) for f in m.functions]
        out += INNER.rstrip("\n").split("\n")
        for f in m.functions:
            if f["name"].endswith("_desc_init"):
                extra = [p for p in f["params"] if p["kind"] == "value"]
                names = ["desc"] + [p["name"] for p in extra]
                out += [""] + comment(f["doc"]) + ["    subroutine %s(%s)" % (f["name"], ", ".join(names)),
                                                   "        type(%s), intent(out) :: desc" % f["params"][0]["type"]]
                out += ["        %s, intent(in) :: %s" % (TYPES[p["type"]], p["name"]) for p in extra]
                out += ["        call c_%s(%s)" % (short(f["name"]), ", ".join(names)), "    end subroutine"]
            elif f["name"].endswith("_destroy"):
                p = f["params"][0]
                out += [""] + comment(f["doc"]) + ["    subroutine %s(%s)" % (f["name"], p["name"]), "        type(%s), intent(inout) :: %s" % (p["type"], p["name"]),
                                                   "        call c_%s(%s%%handle)" % (short(f["name"]), p["name"]),
                                                   "        %s%%handle = c_null_ptr" % p["name"], "    end subroutine"]
            elif not f["inner"]:
                out += self.wrapper(f)
        out += ["end module"]
        return "\n".join(out) + "\n"


def files(model):
    return {"bindings/fortran/peri.f90": Fortran(model).text()}
