# SPDX-License-Identifier: MIT
# wings.awk - no arrow upwards between the folders of src/: `awk -f tools/wings.awk peri_impl.c src/*/*`. The order of the folders is that
# of their first parts in peri_impl.c, headers aside, which may be read earlier. A function, variable, macro, type or constant that a
# folder defines may be used in that folder and in those after it. A name that several folders define belongs to the first of them,
# prototypes aside: they define nothing. Names that macros make (PERI_FN of the kernels) are not followed, and macros that an .inl text
# takes from those that include it are its parameters.
# Also counts where laws are told apart by name or flag outside src/laws (a name as data tells nothing apart); -v laws=refuse names each
# place and fails.

# The line without comments and without the insides of strings; in_comment goes on from line to line.
function stripped(line, out, at) {
    out = ""
    while (line != "") {
        if (in_comment) {
            at = index(line, "*/")
            if (!at) return out
            line = substr(line, at + 2)
            in_comment = 0
        } else if (match(line, /\/\*|"([^"\\]|\\.)*"/)) {
            out = out substr(line, 1, RSTART - 1) " "
            in_comment = substr(line, RSTART, 2) == "/*"
            line = substr(line, RSTART + RLENGTH)
        } else {
            return out line
        }
    }
    return out
}

function define(name) {
    if (!(name in home) || rank[folder] < rank[home[name]]) home[name] = folder
}

# Calls for each name of ours in a text.
function define_names(text) {
    while (match(text, /(peri|PERI)_[A-Za-z0-9_]+/)) {
        define(substr(text, RSTART, RLENGTH))
        text = substr(text, RSTART + RLENGTH)
    }
}

# What stands before the first { or ; at the margin: a function, or a variable with its values. `static peri__a *peri__b(...) {`
function define_head(head, name) {
    sub(/[\[=].*/, "", head)
    if (head ~ /\(/) {
        if (!match(head, /peri_[A-Za-z0-9_]+ *\(/)) return
        name = substr(head, RSTART, RLENGTH)
        sub(/ *\($/, "", name)
        define(name)
    } else if (match(head, /peri_[A-Za-z0-9_]+ *$/)) {
        name = substr(head, RSTART, RLENGTH)
        sub(/ *$/, "", name)
        define(name)
    }
}

FNR == 1 {
    in_comment = in_macro = in_enum = 0
    head = ""
    folder = FILENAME
    sub(/\/[^\/]*$/, "", folder)
}
FILENAME == "peri_impl.c" {
    if ($1 == "#define") {
        home[$2] = "peri_impl.c"
        rank["peri_impl.c"] = 0
    }
    if (!match($0, /^#include "src\/[a-z]+\//) || /\.h"/) next
    name = substr($0, RSTART + 10, RLENGTH - 11)
    if (!(name in rank)) rank[name] = ++folders
    next
}
!(folder in rank) {
    if (!(folder in lost)) print "lint: " folder " is not in peri_impl.c"
    lost[folder] = bad = 1
    next
}
{
    line = stripped($0)
    count++
    text[count] = line
    where[count] = FILENAME ":" FNR
    from[count] = folder
    if (in_macro || line ~ /^ *#/) {
        if (match(line, /^ *#define +PERI_[A-Za-z0-9_]+/)) {
            name = substr(line, RSTART, RLENGTH)
            sub(/.* /, "", name)
            define(name)
        }
        in_macro = line ~ /\\$/
        next
    }
    if (line ~ /^typedef enum/) in_enum = 1
    if (in_enum) {
        define_names(line)
        if (line ~ /}/) in_enum = 0
        next
    }
    if (line ~ /^(typedef )?(struct|union) peri_[A-Za-z0-9_]+ *[{;]/) define_names(substr(line, 1, index(line "{", "{") - 1))
    if (line ~ /^}? *peri_[A-Za-z0-9_]+ *;/ || line ~ /^} peri_/) define_names(line)
    if (line ~ /^typedef [^({]*;/ || line ~ /^typedef .*\(\*peri_/) {
        name = line
        sub(/^[^(]*\(\*/, "", name)
        sub(/\).*/, "", name)
        define_names(name)
    }
    if (head == "" && (line !~ /^[A-Za-z_]/ || line ~ /^typedef/)) next
    head = head " " line
    if (match(head, /[{;]/)) {
        if (substr(head, RSTART, 1) == "{") define_head(substr(head, 1, RSTART - 1))
        head = ""
    }
}
END {
    for (k = 1; k <= count; k++) {
        line = text[k]
        if (from[k] != "src/laws")
            while (match(line, /((([=!]=|[<>]=?|case) *)PERI_LAW_(BOND_BASED|LPS|OTERKUS|CORRESPONDENCE)|PERI_LAW_(BOND_BASED|LPS|OTERKUS|CORRESPONDENCE) *([=!]=|[<>])|(->|\.)(ordinary|tensors|dilates|states))([^A-Za-z0-9_]|$)/)) {
                told++
                if (laws == "refuse") print "lint: " where[k] ": a law by name: " substr(line, RSTART, RLENGTH)
                line = substr(line, RSTART + RLENGTH)
            }
        line = text[k]
        while (match(line, /(peri|PERI)_[A-Za-z0-9_]+/)) {
            name = substr(line, RSTART, RLENGTH)
            line = substr(line, RSTART + RLENGTH)
            if (name ~ /^PERI_/ && where[k] ~ /\.inl:/) continue
            if ((name in home) && rank[home[name]] > rank[from[k]]) {
                print "lint: " where[k] ": arrow up: " name " belongs to " home[name]
                bad = 1
            }
        }
    }
    if (verbose) for (name in home) print home[name], name
    print "law names outside src/laws: " (told + 0)
    if (told && laws == "refuse") bad = 1
    exit bad
}
