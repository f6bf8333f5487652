# SPDX-License-Identifier: MIT
# check.awk - the sentences of a page (standard input, from sentences.awk) against its lists: see check.sh. Variables: page, and
# list = 1: sentences without an entry are printed as entries to be completed.

function complain(where, what) { print where ": " what; bad = 1 }

function trim(text) {
    sub(/^ +/, "", text)
    sub(/ +$/, "", text)
    return text
}

# Where a quote with "…" for what it leaves out is the whole of a text, 1; what it leaves out is then in `left`.
function quotes(quote, text,    part, count, k, at) {
    left = ""
    count = split(quote, part, "…")
    for (k = 1; k <= count; ++k) {
        part[k] = trim(part[k])
        if (part[k] == "" && k > 1 && k < count) continue
        at = index(text, part[k])
        if (part[k] == "" && k == count) at = length(text) + 1
        if (k == count && k > 1 && part[k] != "") { # the end
            at = length(text) - length(part[k]) + 1
            if (at < 1 || substr(text, at) != part[k]) return 0
        }
        if (!at || (k == 1 && at != 1)) return 0
        left = left " " substr(text, 1, at - 1)
        text = substr(text, at + length(part[k]))
    }
    return text == ""
}

# Less what looks like a number and is none: names, links, the dimension of a space.
function bare(text) {
    gsub(/\]\([^)]*\)/, "]", text)
    gsub(/[A-Za-z_][A-Za-z0-9_]*/, "&\n", text)
    gsub(/[A-Za-z_][A-Za-z0-9_]*\n/, "a", text)
    gsub(/[23]a/, "", text) # 2D, 3D
    return text
}

function strict(text,    word) {
    if (bare(text) ~ /[0-9]/) return "a number"
    gsub(/`[^`]*`/, "", text)
    if (match(tolower(text), /(^|[^a-z])(must|never|always|refused|refuses|returns|same bits|exact|exactly)([^a-z]|$)/)) {
        word = substr(tolower(text), RSTART, RLENGTH)
        gsub(/^[^a-z]|[^a-z]$/, "", word)
        return "\"" word "\""
    }
    return ""
}

# ---- proofs ---------------------------------------------------------------------------------------

function load(path,    line, got) {
    if (path in content) return
    content[path] = ""
    there[path] = 0
    while ((got = (getline line < path)) > 0) {
        there[path] = 1
        content[path] = content[path] line "\n"
        if (path ~ /\.[ch]$/ && match(line, /^[a-z][A-Za-z0-9_ *]*[ *][a-z_0-9]+\(/)) {
            line = substr(line, 1, RLENGTH - 1)
            sub(/.*[ *]/, "", line)
            defined[path " " line] = 1
        }
    }
    close(path)
}

# A case of a test program is one that it runs; "a text in quotes" stands in the file, as the row of a table does.
function is_there(path, name) {
    if (name ~ /^"/) return index(content[path], substr(name, 2, length(name) - 2))
    if (path ~ /^tests\/test_[a-z_0-9]*\.c$/) return index(content[path], "RUN(" name ")")
    if (path ~ /\.[ch]$/) return (path " " name) in defined
    if (path ~ /\.(sh|py|awk)$/)
        return content[path] ~ ("(^|\n)[ \t]*(def |class |function )?" name "\\(|(queue|check|queue_program|program|skip) \"?" name "[ \"]|(^|\n)[ \t]*" name "\\)")
    return content[path] ~ ("(^|[^A-Za-z0-9_])" name "([^A-Za-z0-9_]|$)")
}

function prove(line, where,    path, name) {
    path = trim(substr(line, 1, index(line, ":") - 1))
    line = trim(substr(line, index(line, ":") + 1))
    load(path)
    if (!there[path]) {
        complain(where, "no file " path)
        return
    }
    if (line == "") complain(where, "names nothing in " path)
    while (line != "") {
        if (!match(line, line ~ /^"/ ? "^\"[^\"]*\"" : "^[^,]*")) {
            complain(where, "not understood: " line)
            return
        }
        name = substr(line, 1, RLENGTH)
        line = substr(line, RLENGTH + 1)
        sub(/^, */, "", line)
        if (!is_there(path, trim(name))) complain(where, path " has no " trim(name))
        proofs[path " " trim(name)] = 1
    }
}

# ---- lists ----------------------------------------------------------------------------------------

function finish(    k, hits, word) { # the entry that was read
    if (!open) return
    open = 0
    hits = 0
    for (k = from[under]; k <= till[under]; ++k) {
        if (!quotes(quote, text[k])) continue
        if (entry[k]) complain(at, "\"" quote "\": said already at " entry[k])
        if (hits && text[k] != text[hits]) complain(at, "\"" quote "\" begins more than one sentence under \"" under "\"")
        hits = k
        entry[k] = at
        if (class != "p") {
            word = strict(text[k])
            if (word != "") complain(at, "has " word " and so is a promise: " text[k])
        }
        if (bare(left) ~ /[0-9]/) complain(at, "leaves out a number of: " text[k])
    }
    if (!hits) complain(at, "no such sentence in " page " under \"" under "\": " quote)
    if (class == "p" && !proven) complain(at, "no proof: " quote)
    if (class != "p" && proven) complain(at, "has a proof, so it promises something: " quote)
    count[class]++
}

FILENAME == "-" {
    tab = index($0, "\t")
    name = substr($0, 1, tab - 1)
    rest = substr($0, tab + 1)
    tab = index(rest, "\t")
    ++sentences
    head[sentences] = name
    line[sentences] = substr(rest, 1, tab - 1)
    text[sentences] = substr(rest, tab + 1)
    if (!(name in from)) from[name] = sentences
    else if (head[sentences - 1] != name) complain(page ":" line[sentences], "a second heading \"" name "\"")
    till[name] = sentences
    next
}
FNR == 1 { finish() }
/^$|^#[^#]|^#$/ { finish(); next }
/^## / {
    finish()
    under = substr($0, 4)
    if (!(under in from)) complain(FILENAME ":" FNR, "no heading \"" under "\" with sentences in " page)
    next
}
/^[pdear] / {
    finish()
    open = 1
    at = FILENAME ":" FNR
    class = substr($0, 1, 1)
    quote = substr($0, 3)
    proven = 0
    next
}
/^  [A-Za-z0-9_.\/]+: / && open {
    prove($0, FILENAME ":" FNR)
    proven = 1
    next
}
/^  # / && open { next }
/^  [^ ]/ && open && !proven { quote = quote " " substr($0, 3); next }
{ complain(FILENAME ":" FNR, "not understood: " $0) }

# A sentence as an entry: its first words, and what holds its numbers.
function shortened(text,    out, rest, word, count, k, words, kept) {
    if (length(text) <= 120) return text
    count = split(text, words, " ")
    out = ""
    for (k = 1; k <= count; ++k) {
        if (length(out) < 60 || bare(words[k]) ~ /[0-9]/) {
            out = out (out == "" ? "" : kept < k - 1 ? " … " : " ") words[k]
            kept = k
        }
    }
    return kept < count ? out " …" : out
}

END {
    finish()
    for (k = 1; k <= sentences; ++k)
        if (!entry[k]) {
            if (list) {
                if (head[k] != last) printf "\n## %s\n\n", head[k]
                last = head[k]
                print "? " shortened(text[k])
            } else complain(page ":" line[k], "no entry in tests/promises: " text[k])
            open_count++
        }
    for (k in proofs) ++proof_count
    printf "promises: %s: %d sentences, %d promises, %d without an entry, %d proofs\n", page, sentences, count["p"], open_count, proof_count
    exit bad
}
