// SPDX-License-Identifier: MIT
// layer.mjs - the layer of JavaScript above WebAssembly, under node.
// SOURCE OF TRUTH: the scenes: the same calls in C, every bit (tests/binding_scenes.c); beams: Hooke's law; else what README.md promises.
//   node tests/web/layer.mjs build/js build/wasm/scenes
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { gzipSync } from "node:zlib";
import { pathToFileURL } from "node:url";
import { scenes } from "./scenes.mjs";

const [folder = "build/js", program = "build/wasm/scenes"] = process.argv.slice(2);
const { load, PeriError } = await import(pathToFileURL(`${folder}/peri.mjs`).href);
const peri = await load(),
    plane = await load("./peri2d.wasm");
const tests = [];
const test = (name, fn) => tests.push([name, fn]);

/** A bar of 20 x 4 points, 1 x 0.2. */
function bar(library, more = {}, material = {}, corner = [0, 0]) {
    const body = new library.Body({ space: library.SPACE_PLANE_STRESS, horizon: 0.15, ...more });
    const [x, y] = corner;
    body.add_box(body.add_material({ law: library.LAW_BOND_BASED, young: 1, density: 1, ...material }), corner, [x + 1, y + 0.2], 0.05);
    body.build();
    return body;
}

/** What fn throws. */
function thrown(fn) {
    try {
        fn();
    } catch (error) {
        return error;
    }
    assert.fail("nothing was thrown");
}

for (const [name, run] of Object.entries(scenes)) {
    test(`scene ${name}: the bits of C`, () => {
        const here = run(peri),
            lines = execFileSync(program, [name], { encoding: "utf8" }).trim().split("\n");
        assert.equal(lines.length, Object.keys(here).length);
        for (const line of lines) {
            const [, key, value] = line.match(/^\w+\.(\w+) (\S+)$/);
            if (/^[0-9a-f]{8}$/.test(value)) assert.equal(here[key], value, line);
            else assert.equal(Number(here[key]), Number(value), line);
        }
    });
}

test("the small build: size, single precision, the same motion to single precision", () => {
    assert.ok(gzipSync(readFileSync(`${folder}/peri2d.wasm`), { level: 9 }).length <= 150_000);
    const far = library => {
        const body = bar(library, { precision: library.PRECISION_SINGLE });
        body.add_velocity(body.select_box(null, [0.9, 0], [1, 0.2]), [0.01, 0]);
        body.advance({ steps: 50 });
        return body.get_field(library.FIELD_DISPLACEMENT);
    };
    const one = far(peri),
        other = far(plane);
    assert.deepEqual([...one], [...other]);
    assert.ok(Math.max(...one) > 1e-4);
    const error = thrown(() => bar(plane));
    assert.equal(error.status, "PERI_ERROR_LEFT_OUT");
    assert.equal(error.field, "PERI_NO_F64");
    const body = bar(plane, { precision: plane.PRECISION_SINGLE });
    for (const [call, name] of [
        [() => body.solve({}), "solve"],
        [() => body.clone(), "clone"],
        [() => plane.plan({}, [], []), "plan"],
    ]) {
        const left = thrown(call);
        assert.equal(left.status, "PERI_ERROR_LEFT_OUT");
        assert.equal(left.field, name);
    }
    body.destroy();
});

test("errors: status, field, index, value", () => {
    let error = thrown(() => new peri.Body({ space: peri.SPACE_PLANE_STRESS }));
    assert.ok(error instanceof PeriError);
    assert.equal(error.status, "PERI_ERROR_RANGE");
    assert.equal(error.code, peri.ERROR_RANGE);
    assert.equal(error.field, "horizon");
    const body = new peri.Body({ space: peri.SPACE_PLANE_STRESS, horizon: 1 });
    body.add_material({ law: peri.LAW_BOND_BASED, young: 1, density: 1 });
    error = thrown(() => body.add_points([0, 0, 1, NaN, 2, 0], [1, 1, 1]));
    assert.equal(error.status, "PERI_ERROR_POINT");
    assert.equal(error.index, 1);
    assert.match(error.message, /index 1/);
    error = thrown(() => body.add_material({ law: peri.LAW_BOND_BASED, young: 1, density: 1, poisson: 0.1 }));
    assert.equal(error.status, "PERI_ERROR_POISSON");
    assert.ok(Math.abs(error.value - 1 / 3) < 1e-15);
    body.destroy();
    assert.throws(() => body.build(), /destroyed/);
});

test("arguments of the wrong kind or length never reach the library", () => {
    const body = bar(peri);
    assert.throws(() => new peri.Body({ horizont: 1 }), /no field "horizont"/);
    assert.throws(() => new peri.Body({ horizon: "1" }), /a number is wanted/);
    assert.throws(() => new peri.Body({ allocate: () => 0 }), /not for JavaScript/);
    assert.throws(() => body.add_material({ young: 1 }), /law is required/);
    assert.throws(() => body.select_box(null, [0], [1, 1]), /lo: 2 entries are wanted, 1 given/);
    assert.throws(() => body.advance({ steps: 1.5 }), /whole number/);
    assert.throws(() => body.select_if(null, 7), /a function is wanted/);
    assert.throws(() => body.find_point([0, 0], 1), /at most 1 argument/);
    assert.throws(() => body.solve({ curve: new Float64Array(5), curve_rows: 1 }), /6 entries are wanted, 5 given/);
    assert.throws(() => body.evaluate({ force: new Float64Array(3) }), /160 entries are wanted/);
    assert.throws(() => body.evaluate({ force: new Float32Array(160) }), /not of the type/);
    body.destroy();
});

test("exceptions of callbacks come through, at once, and the body lives on", () => {
    const body = bar(peri),
        all = peri.ALL,
        mine = new Error("mine");
    let calls = 0;
    const fail = () => {
        ++calls;
        throw mine;
    };
    const load = body.apply_body_force(all, [0, 0], fail);
    for (let k = 0; k < 3; ++k) body.apply_body_force(all, [0, 0], fail);
    assert.equal(
        thrown(() => body.advance({ steps: 5 })),
        mine,
    );
    assert.equal(calls, 1);
    for (let k = 0; k < 4; ++k) body.remove_load(load + k);
    body.reset();
    for (const desc of [
        { steps: 3, on_frame: fail },
        { steps: 3, frame_steps: 1, on_frame: fail },
    ]) {
        calls = 0;
        assert.equal(
            thrown(() => body.advance(desc)),
            mine,
        );
        assert.equal(calls, 1);
    }
    assert.equal(
        thrown(() => body.select_if(null, fail)),
        mine,
    );
    assert.equal(
        thrown(() => body.cut_if(peri.CUT_NOW, fail)),
        mine,
    );
    assert.equal(
        thrown(() => body.export_vtu_to(fail)),
        mine,
    );
    assert.equal(
        thrown(() => body.load_state_from(fail)),
        mine,
    );
    body.reset();
    body.prescribe_displacement(body.select_box(null, [0, 0], [0.15, 0.2]), peri.AXIS_XY, [0, 0]);
    const pull = body.apply_body_force(peri.ALL, [1e-3, 0]);
    assert.equal(
        thrown(() => body.solve({ on_iteration: fail })),
        mine,
    );
    assert.equal(
        thrown(() => body.solve({ on_step: fail })),
        mine,
    );
    body.remove_load(pull);
    // from a call within a callback
    const inner = thrown(() => body.advance({ steps: 2, on_frame: b => b.select_box(null, [5, 5], [6, 6]) }));
    assert.equal(inner.status, "PERI_ERROR_EMPTY");
    assert.equal(body.advance({ steps: 2, frame_steps: 1, on_frame: () => true }), peri.STOPPED);
    assert.equal(body.advance({ steps: 2 }), peri.OK);
    body.destroy();
});

test("callbacks of the body itself: influence, log, shapes, obstacles", () => {
    const body = bar(peri, {
        influence: peri.INFLUENCE_USER,
        influence_fn: (q, w) => {
            w[0] = 1 - q;
        },
    });
    const same = bar(peri, { influence: peri.INFLUENCE_LINEAR });
    for (const b of [body, same]) {
        b.add_velocity(b.select_box(null, [0.9, 0], [1, 0.2]), [0.01, 0]);
        b.advance({ steps: 20 });
    }
    const [u, v] = [body, same].map(b => b.get_field(peri.FIELD_VELOCITY));
    u.forEach((one, k) => assert.ok(Math.abs(one - v[k]) < 1e-14, `${one} ${v[k]}`)); // 1 - q, rounded otherwise
    const disc = new peri.Body({ space: peri.SPACE_PLANE_STRESS, horizon: 0.3 });
    const material = disc.add_material({ law: peri.LAW_BOND_BASED, young: 1, density: 1 });
    assert.equal(
        disc.add_shape(material, [0, 0], [1, 1], 0.1, (index, x) => x[0] < 0.5),
        50,
    );
    disc.build();
    const wall = disc.add_obstacle({
        shape: peri.SHAPE_BOX,
        size: [0.2, 2],
        place: [0.7, 0.5],
        motion: (time, place) => {
            place[0] = 0.7 - time;
        },
    });
    disc.advance({ duration: 0.2 });
    assert.ok(Math.abs(disc.get_obstacle_state(wall).place[0] - 0.5) < 1e-12);
    assert.ok(disc.get_obstacle_force(wall).force[0] < 0);
    disc.destroy();
    body.destroy();
    same.destroy();
});

test("fields in place: no copy, present state, units", () => {
    for (const precision of [peri.PRECISION_DOUBLE, peri.PRECISION_SINGLE]) {
        const body = bar(peri, { precision }, {}, [3, -7]),
            view = body.view_field(peri.FIELD_DISPLACEMENT);
        assert.equal(view.data.buffer, peri.memory.buffer);
        body.add_displacement(peri.ALL, [0.25, -0.5]);
        assert.ok(Math.abs(view.at(7, 0) - 0.25) < 1e-7 && Math.abs(view.at(7, 1) + 0.5) < 1e-7);
        const copy = body.get_field(peri.FIELD_DISPLACEMENT);
        const places = body.view_field(peri.FIELD_POSITION),
            same = body.get_field(peri.FIELD_POSITION);
        for (let i = 0; i < view.count; ++i) {
            for (let k = 0; k < 2; ++k) {
                assert.equal(view.at(i, k), copy[2 * i + k]);
                assert.equal(places.at(i, k), same[2 * i + k]);
            }
        }
        body.destroy();
    }
});

test("a bar pulled by Hooke's law; nested descriptors; results by name", () => {
    const body = bar(peri, { correction: peri.CORRECTION_MOMENT });
    const held = body.select_box("held", [0, 0], [0.15, 0.2]);
    body.prescribe_displacement(held, peri.AXIS_X, null);
    body.prescribe_displacement(body.select_box(null, [0.85, 0], [1, 0.2]), peri.AXIS_X, [1e-3, 0]);
    const report = body.solve({ loose: peri.LOOSE_PINNED });
    assert.equal(report.ended, peri.ENDED_LOAD);
    assert.equal(body.find_set("held"), held);
    const points = body.get_set(held);
    assert.equal(points.length, body.size_of_set(held));
    // between the grips, of one horizon each, 0.7 long: 1e-3 of it at E = 1 over the width 0.2, to what cut families do at the grips
    const force = Math.abs(body.get_reaction(body.id(peri.KIND_LOAD, 1))[0]);
    assert.ok(Math.abs(force / ((1e-3 / 0.75) * 0.2) - 1) < 0.1, String(force));
    const { start, column, value } = body.matrix_create();
    assert.equal(start, undefined);
    const matrix = body.matrix_create(),
        rows = matrix.get_matrix();
    assert.equal(rows.start.length, 161);
    assert.equal(rows.value.length, matrix.entries());
    assert.equal(column, value);
    matrix.destroy();
    const plan = peri.plan({
        body: { space: peri.SPACE_PLANE_STRESS, horizon: 0.15 },
        material: { law: peri.LAW_BOND_BASED, young: 1, density: 1 },
        lo: [0, 0],
        hi: [1, 0.2],
        spacing: 0.05,
    });
    assert.equal(plan.points, 80);
    const choice = peri.choose(
        { preset: peri.PRESET_TEACHING, quantity: peri.QUANTITY_WAVES, feature: 0.2, lo: [0, 0], hi: [1, 1] },
        { space: peri.SPACE_PLANE_STRESS },
        { law: peri.LAW_BOND_BASED, young: 1, density: 1 },
    );
    assert.ok(choice.report.error <= 0.1 && choice.body.horizon > choice.report.spacing && choice.report.text.length > 10);
    assert.ok(choice.report.cost.points > 10 && choice.report.cost.stable_step > 0);
    body.destroy();
});

test("files: bytes, and back", () => {
    const body = bar(peri);
    body.add_velocity(body.select_box(null, [0.9, 0], [1, 0.2]), [0.01, 0]);
    body.advance({ steps: 10 });
    const state = body.save_state_to(),
        vtu = new TextDecoder().decode(body.export_vtu_to());
    assert.match(vtu, /^<\?xml|^<VTKFile/);
    body.advance({ steps: 10 });
    const after = body.get_field(peri.FIELD_VELOCITY);
    body.load_state_from(state);
    assert.equal(body.step_count(), 10);
    body.advance({ steps: 10 });
    assert.deepEqual([...body.get_field(peri.FIELD_VELOCITY)], [...after]);
    assert.equal(thrown(() => body.load_state_from(state.slice(0, 100))).status, "PERI_ERROR_STATE");
    body.destroy();
});

test("three hundred bodies and runs take no more memory than one", () => {
    const run = () => {
        const body = bar(peri),
            copy = body.clone();
        copy.apply_body_force(peri.ALL, [0, 0], () => 0);
        copy.advance({ steps: 2 });
        for (let k = 0; k < 40; ++k) copy.set_field(peri.FIELD_VELOCITY, copy.get_field(peri.FIELD_VELOCITY));
        body.destroy();
        copy.destroy();
    };
    for (let k = 0; k < 10; ++k) run();
    const before = peri.memory.buffer.byteLength;
    for (let k = 0; k < 300; ++k) run();
    assert.equal(peri.memory.buffer.byteLength, before);
});

let failed = 0;
for (const [name, fn] of tests) {
    try {
        fn();
        console.log(`ok   ${name}`);
    } catch (error) {
        ++failed;
        console.log(`FAIL ${name}\n${error.stack}`);
    }
}
console.log(`${tests.length - failed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
