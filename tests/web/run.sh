#!/bin/sh
# SPDX-License-Identifier: MIT
# make web-test: what needs emcc, node, npm or Chromium says so and is skipped where one is missing.
for needed in "${EMCC:-emcc}" node python3; do
    command -v "$needed" > /dev/null || { echo "web-test: no $needed on this machine, skipped"; exit 0; }
done
make --no-print-directory CC="${CC:-cc}" wasm build/wasm/scenes > build/wasm.log 2>&1 || { tail -n 20 build/wasm.log; exit 1; }
tail -n 2 build/wasm.log
node tests/web/layer.mjs build/js build/wasm/scenes || exit 1
node tests/web/grows.mjs "${EMCC:-emcc}" || exit 1

command -v npm > /dev/null || { echo "web-test: no npm on this machine, types and the page are skipped"; exit 0; }
mkdir -p build/web-test
cp tests/web/page.mjs tests/web/types.mts build/web-test/
if [ ! -d build/web-test/node_modules/tree-sitter-julia ]; then
    (cd build/web-test && { [ -f package.json ] || npm init -y > /dev/null; } && \
        npm install --no-audit --no-fund --ignore-scripts playwright-core@1 axe-core@4 typescript@5 web-tree-sitter@0.27 tree-sitter-julia@0.23 \
            > npm.log 2>&1) || { tail -n 3 build/web-test/npm.log; echo "web-test: no packages of npm, types, Julia and the page are skipped"; exit 0; }
fi
(cd build/web-test && node node_modules/typescript/bin/tsc --noEmit --strict --target es2022 --module nodenext types.mts) || exit 1
echo "ok   types"
node tests/web/julia.mjs build/web-test bindings/julia/Peri.jl bindings/julia/glass.jl || exit 1
CHROMIUM=${CHROMIUM:-$(command -v chromium || command -v chromium-browser || command -v google-chrome)}
[ -n "$CHROMIUM" ] || { echo "web-test: no Chromium on this machine, the page is skipped"; exit 0; }
make --no-print-directory web || exit 1
CHROMIUM=$CHROMIUM node build/web-test/page.mjs build/web/index.html build/web-test
