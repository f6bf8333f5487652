# SPDX-License-Identifier: MIT
"""model.py - what the makers of bindings share: the functions of peri.h as methods of what they act on.

A method has the name of its C function less "peri_", or less "peri_body_", "peri_cracks_", ... of its class; and of its arguments:
  self      the handle that it acts on (class Body, Cracks, Matrix), or none: then it is a plain function
  new       a handle that it gives: the result
  length    a count or capacity that follows from an array: left out
  user      what goes back to a callback: left out, for it holds the closure
  error     the record of calls without a body: left out, for it becomes the exception
The others stay, in the order of C. An array has the entries that `entries` says, an expression of

  dim, turns (1 in 2D, 3 in 3D), points, width, rows, entries, paths, vertices, tips, capacity, other arguments."""
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import api as reader  # noqa: E402

CLASSES = {"peri_body": "Body", "peri_cracks": "Cracks", "peri_matrix": "Matrix"}
# Those that the library calls only before the function returns; all others live as long as the body.
PASSING = {"peri_point_fn", "peri_pair_fn", "peri_write_fn", "peri_read_fn", "peri_frame_fn", "peri_iteration_fn"}
# Hooks of memory and threads: they may not fail, and stay functions of C.
RAW = {"peri_allocate_fn", "peri_release_fn", "peri_task_fn", "peri_parallel_for_fn"}
# What a binding does itself, by its errors, constructors and destructors.
INNER = {"peri_format_error", "peri_get_error", "peri_status_text", "peri_version"}


def short(name):
    return re.sub(r"^(peri|PERI)_", "", name)


def camel(name):
    """peri_body_desc: BodyDesc."""
    return "".join(part.capitalize() for part in short(name).split("_"))


def wrap(text, width):
    """Lines of at most `width` columns."""
    out, line = [], ""
    for word in text.split():
        if line and len(line) + 1 + len(word) > width:
            out.append(line)
            line = word
        else:
            line = (line + " " + word).strip()
    return out + [line] if line else out


class Model:
    def __init__(self, api):
        self.api = api
        self.structs = {s["name"]: s for s in api["structs"]}
        self.callbacks = {c["name"]: c for c in api["callbacks"]}
        self.classes = dict(CLASSES)
        for o in api["opaque"]:
            self.classes.setdefault(o["name"], camel(o["name"]))
        self.functions = api["functions"]
        for s in api["structs"]:
            self.pair(s)
        for c in api["callbacks"]:
            for p in c["params"]:
                if p["role"] == "user" or (p["type"] == "void" and p["name"] == "context"):
                    p["kind"] = "user"
        for f in self.functions:
            self.sort(f)

    # ---- structs -----------------------------------------------------------------------------------------------------

    def pair(self, s):
        """field["kind"]: cookie, reserved, callback, hook, user, length, array, data, text, struct pointer, struct, value;
        a callback knows the field of its user, an array that of its length."""
        names = [f["name"] for f in s["fields"]]
        for f in s["fields"]:
            name = f["name"]
            if name in ("cookie", "reserved"):
                f["kind"] = name
            elif f["type"] in RAW:
                f["kind"] = "hook"
            elif f["type"] in self.callbacks:
                f["kind"] = "callback"
                stem = re.sub(r"_fn$", "", name)
                f["user"] = next(u for u in (stem + "_user", "user") if u in names)
            elif f["type"] == "void" and (name == "user" or name.endswith("_user")):
                f["kind"] = "user"
            elif f["pointer"] and f["type"] == "char":
                f["kind"] = "text"
            elif f["pointer"] and f["type"] in self.structs:
                f["kind"] = "struct pointer"
            elif f["pointer"] and f["type"] == "void":
                f["kind"] = "data"
            elif f["pointer"]:
                f["kind"] = "array"
            elif f["type"] in self.structs:
                f["kind"] = "struct"
            else:
                f["kind"] = "value"
        for f in s["fields"]:
            if f["kind"] == "array" and f.get("entries"):
                counted = re.match(r"(\w+)", f["entries"]).group(1)
                if counted in names:
                    f["counted"] = counted
                    next(g for g in s["fields"] if g["name"] == counted)["kind"] = "length"

    def is_desc(self, name):
        return any(f["kind"] == "cookie" for f in self.structs[name]["fields"])

    def calls(self, name):
        """Fields that are callbacks of a closure."""
        return [f for f in self.structs[name]["fields"] if f["kind"] == "callback"]

    # ---- functions ---------------------------------------------------------------------------------------------------

    def sort(self, f):
        arrays = [p for p in f["params"] if p["role"] in ("array in", "array out", "struct out") and p.get("entries")]
        for k, p in enumerate(f["params"]):
            role = p["role"]
            if role == "handle":
                p["kind"] = "self" if k == 0 else "handle"
            elif role == "new handle":
                p["kind"] = "new"
            elif role == "user":
                p["kind"] = "user"
            elif role == "struct out" and p["type"] == "peri_error":
                p["kind"] = "error"
            elif role == "struct out" and self.is_desc(p["type"]):
                p["kind"] = "struct in out"
            elif role == "struct out" and p["entries"] != "1":
                p["kind"] = "array out"
            else:
                p["kind"] = {"text": "text", "value": "value"}.get(role, role)
            if p["kind"] == "value" and (p["name"] == "count" or p["name"].endswith("capacity")):
                source = self.source(p["name"], arrays)
                if source:
                    p["kind"], p["source"], p["factor"] = "length", source[0], source[1]
        f["class"] = self.classes[f["params"][0]["type"]] if f["params"] and f["params"][0]["role"] == "handle" else ""
        name = f["name"]
        own = f["params"][0]["type"] + "_" if f["class"] else "peri_"
        f["method"] = name[len(own):] if name.startswith(own) else short(name)
        f["inner"] = name in INNER or name.endswith(("_desc_init", "_destroy"))
        for p in f["params"]:
            if p["kind"] == "callback" and p["type"] in PASSING:
                p.pop("optional", None)  # what is passed through once is what the call is for
        f["makes"] = next((p for p in f["params"] if p["kind"] == "new"), None)
        f["outs"] = [p for p in f["params"] if p["kind"] in ("array out", "struct out")]
        f["plain"] = f["result"] in ("number", "text") or bool(re.search(r"_(count|width|dimension|paths|vertices|tips|rows|entries)$", name))

    @staticmethod
    def source(length, arrays):
        """The array that a count follows from, and by what it is divided. peri_get_families: none, the caller says how many rows."""
        plain = [p for p in arrays if p["entries"] == length]
        scaled = [p for p in arrays if p["entries"].startswith(length + "*")]
        if length == "count" and not any(p["const"] for p in plain + scaled):
            return None
        best = [p for p in plain if not p.get("optional")] or [p for p in scaled if not p.get("optional")] or plain + scaled
        if not best and length == "capacity":
            best = [p for p in arrays if not p["const"]]
            return (best[0]["name"], "1") if best else None
        if not best:
            return None
        return best[0]["name"], best[0]["entries"][len(length) + 1:] or "1"

    def visible(self, f):
        """The arguments that a caller gives."""
        return [p for p in f["params"] if p["kind"] not in ("self", "new", "length", "user", "error")]

    def sizes(self, f, of):
        """What the entries of an array are, in the words of a language: of(word) gives those of dim, points, an argument, ...;
        None where a word has none."""
        out = {}
        own = self.own_sizes(f)
        for p in f["params"]:
            if p["kind"] in ("array in", "array out") and p.get("entries"):
                words = re.findall(r"[A-Za-z_]\w*", own.get(p["name"], p["entries"]))
                known = {w: of(w) for w in words}
                text = own.get(p["name"], p["entries"])
                out[p["name"]] = None if None in known.values() else re.sub(r"[A-Za-z_]\w*", lambda m: known[m.group()], text)
        return out

    @staticmethod
    def own_sizes(f):
        """Where the entries are "capacity": what the body says of it."""
        name = f["name"]
        out = next((p for p in f["outs"] if p["entries"] == "capacity"), None)
        if not out:
            return {}
        says = {"peri_get_field": "size_of_field", "peri_get_set": "size_of_set", "peri_get_fragments": "fragments"}.get(name)
        return {out["name"]: says} if says else {}


def load():
    return Model(reader.without_joining(reader.load()))
