// SPDX-License-Identifier: MIT
// page.mjs - the page in Chromium: struck, cut, dragged, loaded, brought to rest, by mouse, finger and keyboard; its words, its looks.
// SOURCE OF TRUTH: what web/README.md promises; of the beam the theory of beams; of accessibility the rules of axe-core.
//   node page.mjs index.html folder-of-pictures      playwright-core and axe-core beside this file (make web-test puts them there)
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [page = "build/web/index.html", pictures = "build/web-test"] = process.argv.slice(2),
    address = "file://" + resolve(page);
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const { pack, unpack } = await import(pathToFileURL(resolve("web/story.mjs")));
const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM || "/usr/bin/chromium",
    args: [
        "--no-sandbox",
        "--disable-gpu",
        "--disable-quic",
        "--no-first-run",
        "--disable-background-networking",
        "--disable-component-update",
        "--disable-sync",
    ],
});
const SIZES = { phone: [390, 844], tablet: [820, 1180], desktop: [1440, 900] };
const complaints = [];

async function open(hash = "", { size = "desktop", ...more } = {}) {
    const [width, height] = SIZES[size],
        context = await browser.newContext({ viewport: { width, height }, ...more }),
        tab = await context.newPage();
    tab.on("console", m => m.type() === "error" && complaints.push(m.text()));
    tab.on("pageerror", e => complaints.push(e.stack));
    await tab.goto(address + hash);
    await tab.waitForFunction(() => document.getElementById("points").textContent !== "0", null, { timeout: 60000 });
    return tab;
}

const number = async (tab, id) => Number((await tab.locator(`#${id}`).textContent()).replace(/[^\d.e-]/g, ""));
const until = (tab, id, least, timeout = 90000) =>
    tab.waitForFunction(([i, n]) => Number(document.getElementById(i).textContent.replace(/,/g, "")) >= n, [id, least], { timeout });
const onStage = async (tab, x, y) => {
    const box = await tab.locator("#stage").boundingBox();
    return [box.x + x * box.width, box.y + y * box.height];
};
const tool = (tab, name) => tab.locator(`[name=tool][value=${name}]`).check({ force: true });

async function drag(tab, from, to) {
    await tab.mouse.move(...(await onStage(tab, ...from)));
    await tab.mouse.down();
    await tab.mouse.move(...(await onStage(tab, (from[0] + to[0]) / 2, (from[1] + to[1]) / 2)));
    await tab.mouse.move(...(await onStage(tab, ...to)));
    await tab.waitForTimeout(600);
    await tab.mouse.up();
}

/** How many pixels of the body have the colours of great damage. */
const darkPixels = tab =>
    tab.evaluate(() => {
        const c = document.getElementById("stage"),
            d = c.getContext("2d").getImageData(0, 0, c.width, c.height).data;
        let n = 0;
        for (let k = 0; k < d.length; k += 4) if (d[k + 3] && d[k] > 2 * d[k + 2] && d[k + 1] < 160) ++n;
        return n;
    });

const tests = {
    async "a crack grows from the notch, and is seen"() {
        const tab = await open("#lesson=branching");
        await until(tab, "broken", 800);
        assert.ok((await darkPixels(tab)) > 500);
        await tab.getByRole("button", { name: "Pause" }).click();
        const said = await tab.locator("#live").textContent();
        assert.match(said, /Pane of glass, 9800 points\. After [\d.]+ microseconds \d+ of \d+ bonds are broken\. Largest damage [01]\.\d+\./);
        assert.ok(Number(said.match(/damage ([01]\.\d+)/)[1]) > 0.3);
        // the term at work stays marked
        assert.equal(await tab.locator(".term.works").first().count(), 1);
        assert.match(await tab.locator("#term-text").textContent(), /^At work: /);
        // the ledger closes
        const joules = async name => Number((await tab.locator(`#energy-${name}`).textContent()).replace(" J", ""));
        assert.ok(Math.abs(await joules("error")) < 0.02 * (await joules("external")));
    },
    async "a strike breaks bonds where there were none broken"() {
        const tab = await open("#lesson=branching&notch=0&pull=0&n=60");
        await until(tab, "time", 0.2);
        assert.equal(await number(tab, "broken"), 0);
        await tab.mouse.click(...(await onStage(tab, 0.5, 0.5)));
        await until(tab, "broken", 20);
    },
    async "a cut breaks the bonds that it crosses; start over makes them whole"() {
        const tab = await open("#lesson=waves&n=60");
        await tab.getByRole("button", { name: "Pause" }).click();
        await tool(tab, "cut");
        await drag(tab, [0.3, 0.5], [0.7, 0.5]);
        await until(tab, "broken", 100);
        await tab.getByRole("button", { name: "Start over" }).click();
        await tab.waitForFunction(() => document.getElementById("broken").textContent === "0");
    },
    async "dragged and loaded, the body takes up energy"() {
        for (const name of ["drag", "load"]) {
            const tab = await open("#lesson=waves&n=60");
            await tool(tab, name);
            await drag(tab, [0.5, 0.5], [0.6, 0.3]);
            await tab.waitForFunction(() => parseFloat(document.getElementById("energy-external").textContent) !== 0, null, {
                timeout: 30000,
            });
            await tab.close();
        }
    },
    async "a beam at rest bends as beams do, to 5 % with the moment correction"() {
        const tab = await open("#lesson=convergence&correction=MOMENT&m=2&n=160&precision=DOUBLE");
        await tab.getByRole("button", { name: "Find rest" }).click();
        await tab.waitForFunction(() => /at rest/.test(document.getElementById("error-text").textContent), null, { timeout: 60000 });
        assert.ok(parseFloat(await tab.locator("#error").textContent()) < 5);
    },
    async "Poisson's ratio of the pane at rest is what was asked for, to 3 % with the moment correction"() {
        const tab = await open("#lesson=poisson&n=80&precision=DOUBLE&correction=MOMENT");
        await tab.getByRole("button", { name: "Find rest" }).click();
        await tab.waitForFunction(() => /at rest/.test(document.getElementById("error-text").textContent), null, { timeout: 60000 });
        assert.ok(parseFloat(await tab.locator("#error").textContent()) < 3, await tab.locator("#error-text").textContent());
    },
    async "a ball cracks the block"() {
        const tab = await open("#lesson=impact&n=16");
        await tab.mouse.click(...(await onStage(tab, 0.5, 0.45)));
        await until(tab, "broken", 50);
        await tab.screenshot({ path: `${pictures}/block.png` });
    },
    async "by keyboard alone"() {
        const tab = await open("#lesson=branching&notch=0&pull=0&n=60");
        await tab.locator("#stage").focus();
        await tab.keyboard.press("ArrowRight");
        await tab.keyboard.press("Enter");
        await until(tab, "broken", 20);
        await tab.keyboard.press(" ");
        assert.equal(await tab.locator("#run").textContent(), "Run");
        await tab.keyboard.press("c");
        assert.ok(await tab.locator("[name=tool][value=cut]").isChecked());
    },
    async "by finger, on a phone, which shows all without scrolling sideways"() {
        const tab = await open("#lesson=branching&notch=0&pull=0&n=60", { size: "phone", hasTouch: true, isMobile: true });
        await tab.touchscreen.tap(...(await onStage(tab, 0.5, 0.5)));
        await until(tab, "broken", 20);
        assert.ok(await tab.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    },
    async "the link holds the settings"() {
        const tab = await open("#lesson=criteria&n=60&law=LPS&poisson=0.3&field=stress");
        for (const [name, value] of [
            ["n", "60"],
            ["law", "LPS"],
            ["poisson", "0.3"],
            ["field", "stress"],
            ["criterion", "BOND_ENERGY"],
        ])
            assert.equal(await tab.locator(`#settings [name=${name}]`).inputValue(), value, name);
        await tab.locator("[name=field]").selectOption("energy");
        assert.match(tab.url(), /field=energy/);
        // nonsense is not believed
        const other = await open("#lesson=none&n=1e9&law=x&poisson=9&steps=");
        assert.equal(await other.locator("[name=law]").inputValue(), "BOND_BASED");
    },
    async "the link holds the state: what was done is done again, to the last bit"() {
        const tab = await open("#lesson=branching&notch=0&pull=0&n=60");
        const state = of =>
            of.evaluate(() => {
                let hash = 2166136261;
                for (const b of new Uint8Array(globalThis.shown().displacement.buffer)) hash = Math.imul(hash ^ b, 16777619);
                return { hash, steps: globalThis.shown().steps, broken: globalThis.shown().broken };
            });
        await tab.mouse.click(...(await onStage(tab, 0.4, 0.5)));
        await until(tab, "broken", 20);
        await tool(tab, "cut");
        await drag(tab, [0.6, 0.4], [0.6, 0.6]);
        await tool(tab, "drag");
        await drag(tab, [0.8, 0.5], [0.85, 0.4]);
        await tab.locator("[name=pull]").fill("2");
        await tab.waitForTimeout(400);
        await tab.getByRole("button", { name: "Copy a link" }).click();
        await tab.waitForFunction(() => /story=/.test(location.hash));
        const link = new URL(tab.url()).hash,
            before = await state(tab);
        assert.ok(link.length < 8000 && before.broken > 20);
        const again = async hash => {
            const opened = await open(hash);
            await opened.waitForFunction(
                n => globalThis.shown()?.steps >= n && document.getElementById("run").textContent === "Run",
                before.steps,
            );
            return opened;
        };
        const other = await again(link);
        assert.deepEqual(await state(other), before);
        // what is looked at changes nothing, what was done does
        const looked = await again(`${link}&field=stress`);
        assert.deepEqual(await state(looked), before);
        await looked.close();
        const told = await unpack(new URLSearchParams(link.slice(1)).get("story"));
        told.acts.find(([letter]) => letter === "s")[2] += 0.25;
        const changed = await again(`${link.replace(/story=.*/, "story=")}${await pack(told)}`);
        assert.notEqual((await state(changed)).hash, before.hash);
        await changed.close();
        // told on, it is the same story
        await other.getByRole("button", { name: "Copy a link" }).click();
        await other.waitForFunction(() => document.getElementById("share").textContent !== "Copy a link to this state");
        assert.equal(new URL(other.url()).hash, link);
        // nonsense is not believed
        for (const text of ["x", "%00", "q1bKUrJSMtBRKlKyMtRRSlSyio5WslLSUTLUUTKMjQUA"]) {
            const wrong = await open(`#lesson=waves&n=60&story=${text}`);
            await until(wrong, "time", 0.2);
            await wrong.close();
        }
    },
    async "each lesson runs, with what a step costs and what it is worth"() {
        const tab = await open("#lesson=branching");
        for (const name of ["Waves", "Poisson’s ratio", "Criteria", "Horizon", "Impact", "Branching"]) {
            await tab.locator("#lessons label", { hasText: name }).click();
            await tab.waitForFunction(() => globalThis.shown()?.steps > 10 && parseFloat(document.getElementById("ms").textContent) > 0);
            assert.match(await tab.locator("#error").textContent(), /\d %$/, name);
            assert.ok((await tab.locator("#lesson-text").textContent()).length > 80);
        }
    },
    async "the page is there within two seconds"() {
        const times = [];
        for (let k = 0; k < 3; ++k) {
            const start = Date.now(),
                tab = await open("#lesson=branching");
            await tab.waitForFunction(() => globalThis.shown());
            times.push(Date.now() - start);
            await tab.close();
        }
        console.log(`     ${times.join(", ")} ms to the first picture`);
        assert.ok(Math.min(...times) < 2000);
    },
    async "choices of peri_choose fill the settings"() {
        const tab = await open("#lesson=branching");
        await tab.getByRole("button", { name: "10 %" }).click();
        await tab.waitForFunction(() => /points, error at most/.test(document.getElementById("choice").textContent));
    },
    async "who wants less motion gets none unasked"() {
        const tab = await open("#lesson=branching", { reducedMotion: "reduce" });
        await tab.waitForTimeout(500);
        assert.equal(await tab.locator("#run").textContent(), "Run");
        assert.equal(await number(tab, "time"), 0);
    },
    async "axe-core finds nothing, by day and night, at three sizes"() {
        for (const size of Object.keys(SIZES))
            for (const colorScheme of ["light", "dark"]) {
                const tab = await open("#lesson=branching", { size, colorScheme });
                await until(tab, "broken", 600);
                await tab.getByRole("button", { name: "Pause" }).click();
                await tab.screenshot({ path: `${pictures}/${size}-${colorScheme}.png`, fullPage: true });
                await tab.addScriptTag({ content: axe });
                const { violations } = await tab.evaluate(() => globalThis.axe.run());
                assert.deepEqual(
                    violations.map(v => `${v.id}: ${v.nodes.map(n => n.target).join(", ")}`),
                    [],
                    `${size} ${colorScheme}`,
                );
                await tab.close();
            }
    },
    async "frames per second with 9,800 points"() {
        const tab = await open("#lesson=branching&field=damage");
        await until(tab, "broken", 300);
        await tab.waitForTimeout(2500);
        const rates = await tab.evaluate(() => globalThis.rates);
        console.log(
            `     ${rates.body.toFixed(1)} of the body, ${rates.screen.toFixed(1)} of the screen; ` +
                `load ${readFileSync("/proc/loadavg", "utf8").split(" ")[0]}`,
        );
        assert.ok(rates.body > 1);
    },
};

let failed = 0;
const wanted = process.argv.slice(4);
for (const [name, test] of Object.entries(tests)) {
    if (wanted.length && !wanted.some(w => name.includes(w))) continue;
    complaints.length = 0;
    const start = Date.now();
    try {
        await test();
        assert.deepEqual(complaints, []);
        console.log(`ok   ${name} (${((Date.now() - start) / 1000).toFixed(1)} s)`);
    } catch (error) {
        ++failed;
        console.log(`FAIL ${name}\n${error.stack}`);
    }
    for (const context of browser.contexts()) await context.close();
}
await browser.close();
console.log(`${failed ? `${failed} failed` : "all passed"}`);
process.exit(failed ? 1 : 0);
