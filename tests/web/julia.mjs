// SPDX-License-Identifier: MIT
// julia.mjs - the binding of Julia, which no package of Debian brings, as text: it is Julia, and its example calls what it has.
// SOURCE OF TRUTH: the grammar tree-sitter-julia.
//   node julia.mjs folder-of-node_modules file...      the binding first
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, ...files] = process.argv.slice(2),
    from = createRequire(resolve(folder, "package.json"));
const { Parser, Language } = await import(pathToFileURL(from.resolve("web-tree-sitter")).href);
await Parser.init();
const parser = new Parser();
parser.setLanguage(await Language.load(resolve(folder, "node_modules/tree-sitter-julia/tree-sitter-julia.wasm")));

/** Lines that are no Julia. */
function wrong(text) {
    const lines = [],
        look = node => {
            if (node.isError || node.isMissing) lines.push(node.startPosition.row + 1);
            node.children.forEach(look);
        };
    look(parser.parse(text).rootNode);
    return lines;
}

assert.notDeepEqual(wrong("function f(x)\n    if x\nend\n"), []);
for (const file of files) assert.deepEqual(wrong(readFileSync(file, "utf8")), [], file);
const binding = readFileSync(files[0], "utf8");
for (const file of files.slice(1))
    for (const [, name] of readFileSync(file, "utf8").matchAll(/\bPeri\.(?!jl\b)(\w+!?)/g)) {
        const defined = new RegExp(`^(function |const |(mutable )?struct )?${name}\\b`, "m");
        assert.match(binding, defined, `${file}: ${name}`);
    }
console.log("ok   the binding of Julia is Julia");
