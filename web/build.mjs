// SPDX-License-Identifier: MIT
// build.mjs - the page in one file: style, scripts, the worker and the library within, so that it opens from a disk, too.
//   node web/build.mjs build/js build/web/index.html
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname } from "node:path";
import { gzipSync } from "node:zlib";

const [library, out] = process.argv.slice(2),
    here = new URL(".", import.meta.url).pathname;
const read = path => readFileSync(path, "utf8");

/** A module as text of a script that follows those that it imports. */
const plain = path =>
    read(path)
        .replace(/^import .*?;$/gms, "")
        .replace(/^export /gm, "")
        .replaceAll("import.meta.url", "self.location.href");
/** Nothing that ends the element around it. */
const safe = text => text.replaceAll("</script", "<\\/script");

/** docs/accuracy.md: the choices of peri_choose, errors in % at 8, 16 and 32 spacings: problem -> recipe -> three numbers. */
function table() {
    const text = read(`${here}/../docs/accuracy.md`),
        from = text.indexOf("The choices of `peri_choose`, errors in %");
    const rows = text
        .slice(from)
        .split("\n")
        .filter(line => line.startsWith("|"))
        .slice(2, 6)
        .map(line => line.split("|").slice(2, 6));
    const numbers = rows.map(row => row.map(cell => cell.split("/").map(Number)));
    if (from < 0 || numbers.length !== 4 || numbers.flat(2).length !== 48 || numbers.flat(2).some(Number.isNaN))
        throw new Error("docs/accuracy.md: the table of errors is not as expected");
    return Object.fromEntries(["cantilever", "hole", "crack", "wave"].map((name, k) => [name, numbers.map(row => row[k])]));
}

const worker = [`${library}/api.mjs`, `${library}/peri.mjs`, `${here}scenes.mjs`, `${here}solver.mjs`].map(plain).join("\n");
const page = [`${here}scenes.mjs`, `${here}story.mjs`, `${here}draw.mjs`, `${here}page.mjs`].map(plain).join("\n");
const wasm = gzipSync(readFileSync(`${library}/peri.wasm`), { level: 9 }).toString("base64");
const script = `
const workerText = ${JSON.stringify(worker)};
globalThis.makeWorker = () => new Worker(URL.createObjectURL(new Blob([workerText], { type: "text/javascript" })));
${page}
(async () => {
    const packed = Uint8Array.from(atob("${wasm}"), c => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    start(new Uint8Array(await new Response(stream).arrayBuffer()), ${JSON.stringify(table())});
})();
`;
const html = read(`${here}index.html`)
    .replace("<!--style-->", () => `<style>\n${read(`${here}style.css`)}</style>`)
    .replace("<!--script-->", () => `<script>\n"use strict";\n(() => {${safe(script)}})();\n</script>`);
mkdirSync(dirname(out), { recursive: true });
writeFileSync(out, html);
console.log(`${out}: ${html.length} bytes, ${gzipSync(html).length} by gzip`);
