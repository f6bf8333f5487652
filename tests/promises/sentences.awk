# SPDX-License-Identifier: MIT
# sentences.awk - the sentences of a page in Markdown, one a line: "heading <tab> line <tab> sentence". Paragraphs and items of lists are cut
# at full stops; a row of a table is one sentence, its cells parted by " | ", and so is a block of code without a language (a drawing).
# Headings, heads of tables, comments, and blocks of C and Python, which tests/check_docs.sh compiles and runs, are none.

function emit(text, line) {
    gsub(/[ \t]+/, " ", text)
    sub(/^ /, "", text)
    sub(/ $/, "", text)
    if (text != "") printf "%s\t%d\t%s\n", heading, line, text
}

# Cuts what has been gathered. A full stop ends a sentence where a space follows, outside of `code`, save after "..." and short forms.
function flush(    at, c, code, from, rest, line, k) {
    from = 1
    for (at = 1; at <= length(gathered); ++at) {
        c = substr(gathered, at, 1)
        if (c == "`") code = !code
        if (code || c !~ /[.!?]/) continue
        rest = substr(gathered, at + 1)
        if (!match(rest, /^[)*"]* /) && rest !~ /^[)*"]*$/) continue
        if (substr(gathered, at - 1, 1) == "." || substr(gathered, at - 3, 4) ~ /(e\.g|i\.e|[ (]cf)\.$/) continue
        match(rest, /^[)*"]*/)
        at += RLENGTH
        if (substr(gathered, from, at - from + 1) ~ /^ *\*\*[^*]*\*\*$/) continue # a title in bold begins its sentence
        emit(substr(gathered, from, at - from + 1), line_at(from))
        from = at + 1
    }
    emit(substr(gathered, from), line_at(from))
    gathered = ""
    lines = 0
}

function line_at(at,    k) {
    while (substr(gathered, at, 1) == " ") ++at
    for (k = lines; k > 1; --k) if (starts[k] <= at) break
    return number[k]
}

function gather(text) {
    if (gathered != "") gathered = gathered " "
    starts[++lines] = length(gathered) + 1
    number[lines] = FNR
    gathered = gathered text
}

/^ *```/ {
    if (fenced) {
        if (drawing) emit(block, first)
        fenced = 0
        next
    }
    flush()
    fenced = 1
    drawing = /^ *``` *$/
    first = FNR
    block = "```"
    next
}
fenced { block = block " " $0; next }
/^<!--/ { next }
/^#+ / {
    flush()
    heading = $0
    sub(/^#+ /, "", heading)
    gsub(/`/, "", heading)
    table = 0
    next
}
/^\|/ {
    flush()
    if (++table <= 2) next # the head and the line below it
    row = $0
    gsub(/\\\|/, "\001", row) # a bar within a cell
    sub(/^\| */, "", row)
    sub(/ *\|$/, "", row)
    gsub(/ *\| */, " | ", row)
    gsub(/\001/, "\\|", row)
    emit(row, FNR)
    next
}
{ table = 0 }
/^ *$/ { flush(); next }
/^ *([-*]|[0-9]+\.) / { flush(); sub(/^ *([-*]|[0-9]+\.) /, "") }
{ gather($0) }
END { flush() }
