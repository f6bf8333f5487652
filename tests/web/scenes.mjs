// SPDX-License-Identifier: MIT
// scenes.mjs - the scenes of bindings/scenes.md through the layer of JavaScript: prints the lines of tests/binding_scenes.c.
//   node tests/web/scenes.mjs [folder of peri.mjs] [scene...]
import { pathToFileURL } from "node:url";

/** FNV-1a of 32 bits over the bytes of a typed array. */
export function hash(array) {
    let h = 2166136261;
    for (const byte of new Uint8Array(array.buffer, array.byteOffset, array.byteLength)) h = Math.imul(h ^ byte, 16777619) >>> 0;
    return h.toString(16).padStart(8, "0");
}

function common(peri, body) {
    const e = body.get_energy(),
        field = which => hash(body.get_field(which));
    return {
        points: body.point_count(),
        bonds: body.bond_count(),
        cut: body.cut_count(),
        steps: body.step_count(),
        broken: body.broken_count(),
        displacement: field(peri.FIELD_DISPLACEMENT),
        velocity: field(peri.FIELD_VELOCITY),
        damage: field(peri.FIELD_DAMAGE),
        kinetic: e.kinetic,
        elastic: e.elastic,
        external: e.external,
        fracture: e.fracture,
    };
}

function glass(peri) {
    const pane = new peri.Body({ space: peri.SPACE_PLANE_STRESS, horizon: 1.5e-3 });
    const material = pane.add_material({ law: peri.LAW_BOND_BASED, young: 72e9, density: 2440, fracture_energy: 3.8 });
    pane.add_box(material, [0, 0], [0.1, 0.04], 0.5e-3);
    pane.build();
    pane.cut_segment(peri.CUT_INITIAL, [0, 0.02], [0.05, 0.02]);
    pane.apply_layer_traction(pane.select_box("top", [0, 0.0395], [0.1, 0.04]), 0.1, [0, 2e6]);
    pane.prescribe_velocity(pane.select_box("bottom", [0, 0], [0.1, 0.0005]), peri.AXIS_XY, null);
    pane.advance({ duration: 40e-6 });
    const told = common(peri, pane);
    pane.destroy();
    return told;
}

function ball(peri) {
    const block = new peri.Body({ space: peri.SPACE_SOLID, horizon: 0.03 }),
        pairs = [],
        times = [];
    const material = block.add_material({ law: peri.LAW_LPS, young: 30e9, poisson: 0.2, density: 2400, critical_stretch: 3e-3 });
    block.add_box(material, [0, 0, 0], [0.1, 0.1, 0.04], 0.01);
    block.build();
    block.cut_rectangle(peri.CUT_INITIAL, [0.07, -0.01, -0.01], [0, 0.12, 0], [0, 0, 0.06]);
    const striker = block.add_obstacle({
        shape: peri.SHAPE_BALL,
        place: [0.05, 0.05, 0.055],
        radius: 0.02,
        density: 7800,
        friction: 0.1,
        velocity: [0, 0, -60],
    });
    block.on_break((i, j, time) => {
        pairs.push(i, j);
        times.push(time);
    });
    let frames = 0;
    block.advance({
        steps: 80,
        time_step: 1e-6,
        frame_steps: 10,
        on_frame: () => {
            ++frames;
        },
    });
    const told = common(peri, block),
        state = block.get_obstacle_state(striker),
        { count, of_point } = block.find_fragments();
    const [first] = block.get_fragments();
    Object.assign(told, {
        frames,
        breaks: times.length,
        pairs: hash(Int32Array.from(pairs)),
        times: hash(Float64Array.from(times)),
        striker_z: state.place[2],
        striker_speed: state.velocity[2],
        fragments: count,
        of_point: hash(of_point),
        first_points: first.points,
        first_centre_z: first.centre[2],
    });
    block.destroy();
    return told;
}

function cantilever(peri) {
    const beam = new peri.Body({ space: peri.SPACE_PLANE_STRESS, horizon: 0.15 }),
        curve = new Float64Array(12);
    beam.add_box(beam.add_material({ law: peri.LAW_LPS, young: 1e9, poisson: 0.3, density: 1000 }), [0, 0], [1, 0.25], 0.05);
    beam.build();
    const held = beam.select_box("held", [0, 0], [0.15, 0.25]),
        tip = beam.select_box("tip", [0.95, 0], [1, 0.25]);
    const support = beam.prescribe_displacement(held, peri.AXIS_XY, null);
    let called = 0;
    beam.apply_body_force(tip, [0, 0], (time, points, value) => {
        for (let k = 0; k < points.length; ++k) value[2 * k + 1] = -2e4 * time * time;
        called = 1;
    });
    const report = beam.solve({ steps: 2, curve_load: support, curve, curve_rows: 2 });
    const told = common(peri, beam);
    Object.assign(told, {
        load_steps: report.steps,
        curve_rows: report.curve_rows,
        curve: hash(curve),
        reaction_y: beam.get_reaction(support)[1],
        called,
    });
    beam.destroy();
    return told;
}

export const scenes = { glass, ball, cantilever };

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
    const { load } = await import(pathToFileURL(`${process.argv[2] ?? "build/js"}/peri.mjs`).href),
        peri = await load();
    const wanted = process.argv.slice(3);
    for (const [name, run] of Object.entries(scenes)) {
        if (wanted.length && !wanted.includes(name)) continue;
        for (const [key, value] of Object.entries(run(peri))) console.log(`${name}.${key} ${value}`);
    }
}
