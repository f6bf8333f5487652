#!/bin/sh
# SPDX-License-Identifier: MIT
# The Python package as a stranger installs it: an archive of bindings/python, unpacked in an empty folder and installed by pip into an
# environment of its own, without a network; then the programs of its README. Needs Debian's python3-venv, -pip, -setuptools, -wheel and -numpy.
cd "$(dirname "$0")/.." || exit 1
python=$(for p in python3 /usr/bin/python3; do
    $p -c 'import numpy, matplotlib, pip, setuptools, venv, wheel' 2> /dev/null && echo "$p" && break; done)
[ -n "$python" ] || { echo "no python3 with NumPy, matplotlib, pip, setuptools, wheel and venv here: skipped"; exit 0; }
place=$(mktemp -d) || exit 1
trap 'rm -rf "$place"' EXIT
(cd bindings/python && $python -c 'import sys; from setuptools import build_meta; build_meta.build_sdist(sys.argv[1])' "$place") > "$place/log" 2>&1 ||
    { cat "$place/log"; exit 1; }
rm -rf bindings/python/peri.egg-info
$python -m venv --system-site-packages "$place/venv" || exit 1
awk -v place="$place" '/^```python/ { inside = 1; n++; next } /^```/ { inside = 0 } inside { print > (place "/part" n ".py") }' bindings/python/README.md
cd "$place" || exit 1
. venv/bin/activate
pip install --no-build-isolation --no-index ./peri-*.tar.gz > log 2>&1 || { cat log; exit 1; }
python -c 'import peri, sys; assert peri.__file__.startswith(sys.argv[1]), peri.__file__' "$(pwd -P)" || exit 1
[ "$(wc -l < part1.py)" -lt 30 ] || { echo "the glass program has $(wc -l < part1.py) lines"; exit 1; }
MPLBACKEND=Agg python part1.py 2> err > said || { cat err; exit 1; }
grep -q '^Body(2D, 16000 points, 218978 bonds' said && [ -s glass.png ] || { cat said err; exit 1; }
# the film, the fields and the error of the page go on from there
sed -i 's/^pane.advance.*//; s/^pane.plot.*//; s/^print(pane).*//' part1.py
sed 's/duration=42e-6/duration=4e-6, frames=4/' part2.py | cat part1.py - > film.py
{ cat part1.py; echo "body = pane"; cat part3.py; } > fields.py
{ cat part1.py; echo "body = pane"; cat part5.py; } > errors.py
for program in film fields errors; do
    MPLBACKEND=Agg python $program.py > said 2> err || { echo "$program:"; cat said err; exit 1; }
done
grep -q '^the time step exceeds the stable step' said && [ -s glass.gif ] || { cat said; exit 1; }
