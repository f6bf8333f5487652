# dist.awk - writes the single-file header: `awk -f tools/dist.awk peri.h`. Quoted includes are put in place, .c and .h once, .inl every
# time (the kernels are one text in four instantiations). What was put in place before is left out.
function put(path, folder, line, target, name) {
    folder = path
    if (!sub(/[^\/]*$/, "", folder)) folder = ""
    while ((getline line < path) > 0) {
        if (line ~ /^#include "/) {
            name = line
            sub(/^#include "/, "", name)
            sub(/".*$/, "", name)
            target = folder name
            if (target !~ /\.inl$/ && (target in done)) continue
            done[target] = 1
            print "/* ---- begin " target " ---- */"
            put(target)
            print "/* ---- end " target " ---- */"
        } else {
            print line
        }
    }
    close(path)
}
BEGIN {
    done[ARGV[1]] = 1
    put(ARGV[1])
}
