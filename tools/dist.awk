# SPDX-License-Identifier: MIT
# dist.awk - writes the single-file header: `awk -f tools/dist.awk peri.h`. Quoted includes are put in place, .c and .h once. A long text
# that is included in several places (.inl; adjacent includes are one text) stands at the end of the file, once, in a section of its own
# number, and each include of it becomes an include of the file itself with PERI_TEXT set to that number; so within sections, to any depth.
# Compilers read the whole file each time that it includes itself, 30 ms of gcc: so what is short is put in place every time.
function fail(what) {
    print "dist.awk: " what > "/dev/stderr"
    exit failed = 1
}
function target_of(folder, line) {
    sub(/^[ \t]*#[ \t]*include "/, "", line)
    sub(/".*$/, "", line)
    line = folder line
    while (sub(/[^\/.]+\/\.\.\//, "", line)) continue
    return line
}
# Reads path into line[path, k], of which those with target[path, k] != "" are includes; adjacent ones of .inl are one, names apart by |.
# Counts in how many places each stands, and lines[path], those of what it includes among them.
function scan(path, folder, text, n, t, more, list, k, parts) {
    if (path in count) return
    count[path] = lines[path] = n = 0
    folder = path
    if (!sub(/[^\/]*$/, "", folder)) folder = ""
    while ((more = (getline text < path)) > 0) {
        if (text == "/* SPDX-License-Identifier: MIT */") continue # peri.h says it for all
        t = text ~ /^[ \t]*#[ \t]*include "/ ? target_of(folder, text) : ""
        if (t ~ /\.inl$/ && n > 0 && target[path, n] ~ /\.inl$/) target[path, n] = target[path, n] "|" t
        else {
            line[path, ++n] = text
            target[path, n] = t
        }
    }
    if (more < 0) fail("cannot read " path)
    close(path)
    count[path] = lines[path] = n
    for (k = 1; k <= n; ++k)
        if ((t = target[path, k]) != "") {
            places[t]++
            lines[path] += lines_of(t)
        }
}
function lines_of(list, parts, n, k, sum) {
    n = split(list, parts, "|")
    for (k = 1; k <= n; ++k) {
        scan(parts[k])
        sum += lines[parts[k]]
    }
    return sum
}
function say_self() {
    if (said_self++) return
    print "/* How this file includes itself: PERI_FILE if you define it; its name, where the compiler tells it (gcc 12, clang 9); \"peri.h\". */"
    print "#if defined(PERI_FILE)"
    print "#define PERI_SELF PERI_FILE"
    print "#elif defined(__FILE_NAME__)"
    print "#define PERI_SELF __FILE_NAME__"
    print "#else"
    print "#define PERI_SELF \"peri.h\""
    print "#endif"
}
function select_text(number) {
    print "#undef PERI_TEXT"
    if (number) print "#define PERI_TEXT " number
}
# own: the number of the section that this stands in; 0 outside
function put_all(list, own, parts, n, k) {
    n = split(list, parts, "|")
    for (k = 1; k <= n; ++k) {
        if (!own && parts[k] !~ /\.inl$/) done[parts[k]] = 1
        print "/* ---- begin " parts[k] " ---- */"
        put(parts[k], own)
        print "/* ---- end " parts[k] " ---- */"
    }
}
function put(path, own, k, t) {
    for (k = 1; k <= count[path]; ++k) {
        t = target[path, k]
        if (t == "") print line[path, k]
        else if (t in done) continue
        else if (t !~ /\.inl$/ || places[t] < 2 || lines_of(t) < 120) {
            say_self()
            put_all(t, own)
        } else {
            if (!(t in number)) section[number[t] = ++sections] = t
            select_text(number[t])
            print "#include PERI_SELF"
            select_text(own)
        }
    }
}
BEGIN {
    done[ARGV[1]] = 1
    scan(ARGV[1])
    put(ARGV[1], 0)
    for (n = 1; n <= sections; ++n) {
        if (n == 1) print "\n#ifdef PERI_TEXT"
        print (n == 1 ? "#if" : "#elif") " PERI_TEXT == " n
        put_all(section[n], n)
    }
    if (sections) print "#endif\n#endif"
    exit failed
}
