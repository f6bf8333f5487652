# SPDX-License-Identifier: MIT
# Every `field` of an error record is an identifier that peri.h has, or some of them with ", " between; or the switch of a build (PERI_NO_).
#   awk -f tools/fields.awk peri.h src/*/*.c
# Looked at are the texts in calls that record an error or pass the field on, and the arguments that the PERI_NEED macros name themselves.

# What lies between the parenthesis at `at` in `text` and its partner.
function inside(text, at,    depth, k, c, quoted) {
    for (k = at; k <= length(text); ++k) {
        c = substr(text, k, 1)
        if (c == "\"") quoted = !quoted
        if (quoted) continue
        if (c == "(") depth++
        if (c == ")" && --depth == 0) return substr(text, at + 1, k - at - 1)
    }
    return ""
}

# The last of the arguments, without what leads to a member.
function last_name(text,    k, c, depth, from) {
    for (k = 1; k <= length(text); ++k) {
        c = substr(text, k, 1)
        if (c == "(") depth++
        if (c == ")") depth--
        if (c == "," && depth == 0) from = k
    }
    text = substr(text, from + 1)
    sub(/^.*->/, "", text)
    gsub(/ /, "", text)
    return text
}

function check(field, file,    part, n, k) {
    n = split(field, part, ", ")
    for (k = 1; k <= n; ++k) {
        seen++
        if (part[k] in known || part[k] ~ /^PERI_NO_[A-Z0-9]+$/) continue
        print "lint: " file ": \"" field "\" is the field of an error, and no name of peri.h"
        bad = 1
        return
    }
}

function look_through(text, file,    call, arguments, literal) {
    while (match(text, /(peri__fail|peri__fail_const|peri__fail_step|peri__set_error|peri__find|peri__find_load|peri__check_room|peri__check_state|peri__heed|peri__without|PERI_NEED|PERI_NEED_[A-Z]+|PERI_CHOICE_)\(/)) {
        call = substr(text, RSTART, RLENGTH - 1)
        arguments = inside(text, RSTART + RLENGTH - 1)
        text = substr(text, RSTART + RLENGTH)
        if (call ~ /^PERI_NEED_(VECTOR|CHOICE|FLAG|NUMBER)$/) check(last_name(arguments), file)
        if (call == "PERI_CHOICE_") check(substr(arguments, 1, index(arguments, ",") - 1), file)
        if (call ~ /^PERI_NEED_|^PERI_CHOICE_/) continue
        while (match(arguments, /"[^"]*"/)) {
            literal = substr(arguments, RSTART + 1, RLENGTH - 2)
            arguments = substr(arguments, RSTART + RLENGTH)
            if (literal != "") check(literal, file)
        }
    }
}

{
    if (FNR == 1) {
        if (source != "") look_through(source, name)
        source = ""
        name = FILENAME
    }
    line = $0
    if (name == "peri.h") { # comments hold words that are no names
        if (comment && !(at = index(line, "*/"))) next
        if (comment) line = substr(line, at + 2)
        comment = 0
        while (at = index(line, "/*")) {
            rest = substr(line, at + 2)
            line = substr(line, 1, at - 1)
            comment = !(at = index(rest, "*/"))
            if (comment) break
            line = line " " substr(rest, at + 2)
        }
        while (match(line, /[A-Za-z_][A-Za-z_0-9]*/)) {
            known[substr(line, RSTART, RLENGTH)] = 1
            line = substr(line, RSTART + RLENGTH)
        }
        next
    }
    if (continued || line ~ /^#define/) { # the macros themselves
        continued = line ~ /\\$/
        next
    }
    gsub(/\/\*[^*]*\*\//, "", line)
    source = source " " line
}
END {
    look_through(source, name)
    if (seen < 300) print "lint: only " seen " fields of errors were found"
    exit bad || seen < 300
}
