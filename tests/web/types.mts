// SPDX-License-Identifier: MIT
// types.mts - what an editor or tsc says of the layer: all this is right, but for the last line.
import { load, type Peri, type Body } from "../js/peri.mjs";
const peri: Peri = await load();
const body: Body = new peri.Body({ space: peri.SPACE_PLANE_STRESS, horizon: 1 });
const m: number = body.add_material({ law: peri.LAW_BOND_BASED, young: 1, density: 1 });
body.add_box(m, [0, 0], [1, 1], 0.1);
body.apply_body_force(peri.ALL, [0, 0], (time, points, value) => { value[0] = time * points.length; });
body.advance({ steps: 3, on_frame: b => b.time() > 1 });
const { count, of_point } = body.find_fragments();
const d: Float64Array = body.get_field(peri.FIELD_DAMAGE);
const bytes: Uint8Array = body.export_vtu_to();
const r = body.solve(); r.iterations.toFixed();
const v = body.view_field(peri.FIELD_DISPLACEMENT); v.at(0, 1).toFixed(); v.data.length;
body.matrix_create().get_matrix().start.length;
// @ts-expect-error
body.advance({ stepz: 1 });
