# SPDX-License-Identifier: MIT
# check_docs.awk - called by check_docs.sh: peri.h, then README.md and docs/*.md.
#
# Where things must be said: functions, callback types, structs, enums and enumerators anywhere in docs/; functions, enumerators of status and
# fields in manual.md, or in a page that it links to (statics, theory, accuracy, laws); the fields of a struct in the first cells of a table under the
# heading that names it. The table under the heading "Calls and statuses" has every function, and only statuses that there are.

function complain(what) { print "docs: " what; bad = 1 }

function slug(heading) { # as the hosts of repositories make anchors of headings
    heading = tolower(heading)
    gsub(/[^a-z0-9 _-]/, "", heading)
    gsub(/ /, "-", heading)
    return heading
}

function folder(path) { return path ~ /\// ? substr(path, 1, match(path, /[^\/]*$/) - 1) : "" }

function resolve(path) { # without "a/../"
    while (match(path, /[^\/.]+\/\.\.\//)) path = substr(path, 1, RSTART - 1) substr(path, RSTART + RLENGTH)
    return path
}

# ---- peri.h ---------------------------------------------------------------------------------------

function declare(text,    name, parts, count, k) { # one declaration of the header, comments gone
    if (text ~ /PERI_API[^;=]*[ *]peri_[a-z0-9_]+\(/) {
        match(text, /peri_[a-z0-9_]+\(/)
        name = substr(text, RSTART, RLENGTH - 1)
        kind[name] = "function"
    } else if (text ~ /typedef[^(]*\(\*peri_[a-z0-9_]+\)/) {
        match(text, /\(\*peri_[a-z0-9_]+/)
        name = substr(text, RSTART + 2, RLENGTH - 2)
        kind[name] = "callback"
    } else if (match(text, /typedef (enum|struct) peri_[a-z0-9_]+/)) {
        name = substr(text, RSTART, RLENGTH)
        sub(/.* /, "", name)
        kind[name] = text ~ /typedef enum/ ? "enum" : "struct"
        if (!match(text, /\{.*\}/)) return
        text = substr(text, RSTART + 1, RLENGTH - 2)
        count = split(text, parts, text ~ /;/ ? ";" : ",")
        for (k = 1; k <= count; ++k) member(name, parts[k])
    }
}

function member(of, text,    count, names, k) {
    if (kind[of] == "enum") {
        if (match(text, /PERI_[A-Z0-9_]+/)) kind[substr(text, RSTART, RLENGTH)] = of == "peri_status" ? "status" : "enumerator"
        return
    }
    sub(/\[[0-9]+\]/, "", text)
    count = split(text, names, ",")
    for (k = 1; k <= count; ++k)
        if (match(names[k], /[a-z0-9_]+ *$/)) {
            sub(/ +$/, "", names[k])
            field[of " " substr(names[k], match(names[k], /[a-z0-9_]+$/))] = 1
        }
}

FILENAME == "peri.h" {
    line = $0
    while (match(line, /PERI_[A-Z0-9_]+|peri_[a-z0-9_]+/)) { # macros, and names that comments speak of
        known[substr(line, RSTART, RLENGTH)] = 1
        line = substr(line, RSTART + RLENGTH)
    }
    header = header " " $0
    next
}

function read_header(    count, parts, k, depth, one, at, c) {
    while (match(header, /\/\*([^*]|\*[^\/])*\*\//)) header = substr(header, 1, RSTART - 1) " " substr(header, RSTART + RLENGTH)
    depth = 0
    one = ""
    for (at = 1; at <= length(header); ++at) {
        c = substr(header, at, 1)
        if (c == "{") ++depth
        if (c == "}") --depth
        one = one c
        if (c == ";" && depth <= 1 && one !~ /typedef (enum|struct)[^;]*\{[^}]*$/) {
            declare(one)
            one = ""
        }
    }
    count = split(switches, parts, /[ \n]+/)
    for (k = 1; k <= count; ++k) known[parts[k]] = 1
    known["PERI_FILE"] = 1
    known["PERI_KERNELS"] = 1
}

# ---- pages ----------------------------------------------------------------------------------------

FNR == 1 {
    if (!read) read_header()
    read = 1
    page = FILENAME
    sub(/.*\//, "", page)
    under = heading = ""
    fenced = 0
    pages[++page_count] = FILENAME
}

/^ *```/ { fenced = !fenced; next }

!fenced && /^#+ / {
    heading = $0
    sub(/^#+ /, "", heading)
    under = heading
    anchors[FILENAME "#" slug(heading)] = 1
}

{
    said_in = page ~ /^(manual|statics|theory|accuracy|laws)\.md$/
    text = $0
    while (match(text, /(peri|PERI)_[A-Za-z0-9_]+/)) {
        name = substr(text, RSTART, RLENGTH)
        after = substr(text, RSTART + RLENGTH, 2)
        before = RSTART > 1 ? substr(text, RSTART - 1, 1) : ""
        text = substr(text, RSTART + RLENGTH)
        if (before ~ /[A-Za-z0-9_]/ || after ~ /^\.[a-z]/ || name ~ /^peri_impl$/) continue # peri_impl.c
        if (said_in) said[name] = 1
        if (docs(FILENAME)) anywhere[name] = 1
        if (page != "migration.md") used[name " " FILENAME ":" FNR (after ~ /^\*|^\.\./ || name ~ /_$/ ? " open" : "")] = 1
    }
    if (under ~ /peri_[a-z0-9_]+/ && said_in && /^\| `/) {
        match(under, /peri_[a-z0-9_]+/)
        struct = substr(under, RSTART, RLENGTH)
        split($0, cell, "|")
        text = cell[2]
        while (match(text, /`[a-z0-9_]+`/)) {
            told[struct " " substr(text, RSTART + 1, RLENGTH - 2)] = 1
            text = substr(text, RSTART + RLENGTH)
        }
    }
    if (heading == "Calls and statuses" && /^\| `peri_/) {
        split($0, cell, "|")
        text = cell[2]
        while (match(text, /peri_[a-z0-9_]+/)) {
            name = substr(text, RSTART, RLENGTH)
            if (name in row) complain(FILENAME ":" FNR ": " name " is in the table twice")
            row[name] = 1
            text = substr(text, RSTART + RLENGTH)
        }
        text = cell[3]
        sub(/:.*/, "", text)
        while (match(text, /[A-Z_]+/)) {
            returned[substr(text, RSTART, RLENGTH)] = FILENAME ":" FNR
            text = substr(text, RSTART + RLENGTH)
        }
    }
    text = $0
    gsub(/`[^`]*`/, "", text)
    while (!fenced && match(text, /\]\([^)]+\)/)) {
        links[FILENAME ":" FNR ":" substr(text, RSTART + 2, RLENGTH - 3)] = 1
        text = substr(text, RSTART + RLENGTH)
    }
}

function docs(file) { return file ~ /^docs\// }

function exists(path) { return system("test -e '" path "'") == 0 }

function check_names(    key, part, k, found) {
    for (name in kind) {
        if (!(name in anywhere)) complain(kind[name] " " name " of peri.h is nowhere in docs/")
        else if ((kind[name] == "function" || kind[name] == "status") && !(name in said)) complain(name " is not in manual.md")
        if (kind[name] == "function" && !(name in row)) complain(name " is not in the table of calls and statuses")
    }
    for (key in field)
        if (!(key in told)) {
            split(key, part, " ")
            complain("field " part[2] " is not said under a heading that names " part[1])
        }
    for (name in row)
        if (kind[name] != "function") complain(name " of the table of calls and statuses is no function")
    for (name in returned)
        if (name != "ID" && kind["PERI_ERROR_" name] != "status" && kind["PERI_" name] != "status")
            complain(returned[name] ": no status " name)
    for (name in kind)
        if (kind[name] == "status" && name != "PERI_OK") {
            k = name
            sub(/^PERI_(ERROR_)?/, "", k)
            if (!(k in returned) && !(k ~ /^ID_/ && "ID" in returned)) complain("no call returns " name ", says the table")
        }
    for (key in used) {
        split(key, part, " ")
        if (part[1] in known || part[1] in kind || (part[2] ~ /inside\.md/ && (part[1] ~ /^peri__/ || part[1] ~ /^PERI_(SPLIT|SAME_COUNT)$/))) continue
        found = 0
        if (part[3] == "open")
            for (name in known) found = found || index(name, part[1]) == 1
        if (!found) complain(part[2] ": " part[1] " is not in peri.h")
    }
}

function check_links(    key, part, at, path, anchor, file) {
    for (key in links) {
        match(key, /^[^:]*:[0-9]+:/)
        file = substr(key, 1, RLENGTH - 1)
        path = substr(key, RLENGTH + 1)
        if (path ~ /^[a-z]+:/) continue
        at = file
        sub(/:.*/, "", at)
        anchor = ""
        if (match(path, /#.*/)) {
            anchor = substr(path, RSTART + 1)
            path = substr(path, 1, RSTART - 1)
        }
        path = path == "" ? at : resolve(folder(at) path)
        if (!exists(path)) complain(file ": " path " is not there")
        else if (anchor != "" && !(path "#" anchor in anchors)) complain(file ": " path " has no heading #" anchor)
    }
}

END {
    check_names()
    check_links()
    for (name in kind) ++count[kind[name]]
    for (key in field) ++count["field"]
    if (page_count < 8 || count["function"] < 90 || count["status"] < 38 || count["field"] < 130) complain("little was read")
    if (ENVIRON["VERBOSE"]) for (key in count) print key, count[key]
    exit bad
}
