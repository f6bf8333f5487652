// SPDX-License-Identifier: MIT
//! A pane of glass is pulled until the crack from its notch splits it.

fn main() -> peri::Result<()> {
    let mut d = peri::BodyDesc::new();
    d.space = peri::SPACE_PLANE_STRESS;
    d.horizon = 1.5e-3;
    let mut glass = peri::MaterialDesc::new(peri::LAW_BOND_BASED);
    glass.young = 72e9;
    glass.density = 2440.0;
    glass.fracture_energy = 3.8;

    let pane = peri::Body::new(d)?;
    pane.add_box(pane.add_material(glass)?, &[0.0, 0.0], &[0.1, 0.04], 0.5e-3)?;
    pane.build()?;
    pane.cut_segment(peri::CUT_INITIAL, &[0.0, 0.02], &[0.05, 0.02])?;
    let top = pane.select_box("top", &[0.0, 0.0395], &[0.1, 0.04])?;
    pane.apply_layer_traction(top, 0.1, &[0.0, 2e6], None)?;
    let bottom = pane.select_box("bottom", &[0.0, 0.0], &[0.1, 0.0005])?;
    pane.prescribe_velocity(bottom, peri::AXIS_XY, None, None)?;
    let mut run = peri::AdvanceDesc::new();
    run.duration = 40e-6;
    pane.advance(run)?;
    println!("{} points, {} steps, {} bonds broken", pane.point_count(), pane.step_count(), pane.broken_count());
    Ok(())
}
