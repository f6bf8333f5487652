// SPDX-License-Identifier: MIT
//! The scenes of bindings/scenes.md by bindings/rust/peri; and what is its own: errors, panics, views, threads.
use peri::{AdvanceDesc, Body, BodyDesc, MaterialDesc, ObstacleDesc, SolveDesc};
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::sync::atomic::{AtomicI64, Ordering};
use std::sync::{Arc, Mutex};

fn c_double(v: f64) -> String {
    // %.17g
    if v == 0.0 {
        return "0".into();
    }
    let text = format!("{:.16e}", v);
    let (digits, power) = text.split_once('e').unwrap();
    let power: i32 = power.parse().unwrap();
    let negative = digits.starts_with('-');
    let digits: String = digits.chars().filter(|c| c.is_ascii_digit()).collect();
    let digits = digits.trim_end_matches('0');
    let sign = if negative { "-" } else { "" };
    if !(-4..17).contains(&power) {
        let rest = if digits.len() > 1 { format!(".{}", &digits[1..]) } else { String::new() };
        format!("{sign}{}{rest}e{}{:02}", &digits[..1], if power < 0 { '-' } else { '+' }, power.abs())
    } else if power < 0 {
        format!("{sign}0.{}{digits}", "0".repeat((-power - 1) as usize))
    } else {
        let whole = power as usize + 1;
        if digits.len() <= whole {
            format!("{sign}{digits}{}", "0".repeat(whole - digits.len()))
        } else {
            format!("{sign}{}.{}", &digits[..whole], &digits[whole..])
        }
    }
}

struct Scene(&'static str);

impl Scene {
    fn count(&self, name: &str, n: i64) {
        println!("{}.{} {}", self.0, name, n);
    }
    fn number(&self, name: &str, v: f64) {
        println!("{}.{} {}", self.0, name, c_double(v));
    }
    fn hash<I: IntoIterator<Item = u8>>(&self, name: &str, bytes: I) {
        let h = bytes.into_iter().fold(2166136261u32, |h, b| (h ^ u32::from(b)).wrapping_mul(16777619));
        println!("{}.{} {:08x}", self.0, name, h);
    }
    fn doubles(&self, name: &str, v: &[f64]) {
        self.hash(name, v.iter().flat_map(|x| x.to_le_bytes()));
    }
    fn integers(&self, name: &str, v: &[i32]) {
        self.hash(name, v.iter().flat_map(|x| x.to_le_bytes()));
    }
    fn common(&self, body: &Body) -> peri::Result<()> {
        self.count("points", body.point_count());
        self.count("bonds", body.bond_count());
        self.count("cut", body.cut_count());
        self.count("steps", body.step_count());
        self.count("broken", body.broken_count());
        self.doubles("displacement", &body.get_field(peri::FIELD_DISPLACEMENT)?);
        self.doubles("velocity", &body.get_field(peri::FIELD_VELOCITY)?);
        self.doubles("damage", &body.get_field(peri::FIELD_DAMAGE)?);
        let e = body.get_energy()?;
        self.number("kinetic", e.kinetic);
        self.number("elastic", e.elastic);
        self.number("external", e.external);
        self.number("fracture", e.fracture);
        Ok(())
    }
}

fn create(space: i32, horizon: f64) -> peri::Result<Body> {
    let mut d = BodyDesc::new();
    d.space = space;
    d.horizon = horizon;
    Body::new(d)
}

fn glass(s: Scene) -> peri::Result<()> {
    let pane = create(peri::SPACE_PLANE_STRESS, 1.5e-3)?;
    let mut m = MaterialDesc::new(peri::LAW_BOND_BASED);
    m.young = 72e9;
    m.density = 2440.0;
    m.fracture_energy = 3.8;
    pane.add_box(pane.add_material(m)?, &[0.0, 0.0], &[0.1, 0.04], 0.5e-3)?;
    pane.build()?;
    pane.cut_segment(peri::CUT_INITIAL, &[0.0, 0.02], &[0.05, 0.02])?;
    let top = pane.select_box("top", &[0.0, 0.0395], &[0.1, 0.04])?;
    let bottom = pane.select_box("bottom", &[0.0, 0.0], &[0.1, 0.0005])?;
    pane.apply_layer_traction(top, 0.1, &[0.0, 2e6], None)?;
    pane.prescribe_velocity(bottom, peri::AXIS_XY, None, None)?;
    let mut run = AdvanceDesc::new();
    run.duration = 40e-6;
    pane.advance(run)?;
    s.common(&pane)
}

fn ball(s: Scene) -> peri::Result<()> {
    let block = create(peri::SPACE_SOLID, 0.03)?;
    let mut m = MaterialDesc::new(peri::LAW_LPS);
    m.young = 30e9;
    m.poisson = 0.2;
    m.density = 2400.0;
    m.critical_stretch = 3e-3;
    block.add_box(block.add_material(m)?, &[0.0, 0.0, 0.0], &[0.1, 0.1, 0.04], 0.01)?;
    block.build()?;
    block.cut_rectangle(peri::CUT_INITIAL, &[0.07, -0.01, -0.01], &[0.0, 0.12, 0.0], &[0.0, 0.0, 0.06])?;
    let mut o = ObstacleDesc::new(peri::SHAPE_BALL);
    o.place = [0.05, 0.05, 0.055];
    o.radius = 0.02;
    o.density = 7800.0;
    o.friction = 0.1;
    o.velocity[2] = -60.0;
    let striker = block.add_obstacle(o)?;
    let told = Arc::new(Mutex::new((Vec::<i32>::new(), Vec::<f64>::new())));
    let tell = told.clone();
    block.on_break(Some(Box::new(move |i, j, time, _| {
        let mut told = tell.lock().unwrap();
        told.0.extend([i, j]);
        told.1.push(time);
        0
    })))?;
    let mut frames = 0;
    let mut on_frame = |_: &Body| {
        frames += 1;
        0
    };
    let mut run = AdvanceDesc::new();
    run.steps = 80;
    run.time_step = 1e-6;
    run.frame_steps = 10;
    run.on_frame = Some(&mut on_frame);
    block.advance(run)?;
    s.common(&block)?;
    let told = told.lock().unwrap();
    s.count("frames", frames);
    s.count("breaks", told.1.len() as i64);
    s.integers("pairs", &told.0);
    s.doubles("times", &told.1);
    let state = block.get_obstacle_state(striker)?;
    s.number("striker_z", state.place[2]);
    s.number("striker_speed", state.velocity[2]);
    let mut of_point = vec![0; block.point_count() as usize];
    s.count("fragments", block.find_fragments(Some(&mut of_point))?);
    let f = block.get_fragments()?;
    s.integers("of_point", &of_point);
    s.count("first_points", i64::from(f[0].points));
    s.number("first_centre_z", f[0].centre[2]);
    Ok(())
}

fn cantilever(s: Scene) -> peri::Result<()> {
    let beam = create(peri::SPACE_PLANE_STRESS, 0.15)?;
    let mut m = MaterialDesc::new(peri::LAW_LPS);
    m.young = 1e9;
    m.poisson = 0.3;
    m.density = 1000.0;
    beam.add_box(beam.add_material(m)?, &[0.0, 0.0], &[1.0, 0.25], 0.05)?;
    beam.build()?;
    let held = beam.select_box("held", &[0.0, 0.0], &[0.15, 0.25])?;
    let tip = beam.select_box("tip", &[0.95, 0.0], &[1.0, 0.25])?;
    let support = beam.prescribe_displacement(held, peri::AXIS_XY, None, None)?;
    let called = Arc::new(AtomicI64::new(0));
    let calls = called.clone();
    let pull = move |time: f64, _: &[i32], value: &mut [f64]| {
        calls.fetch_add(1, Ordering::Relaxed);
        value.chunks_mut(2).for_each(|v| v[1] = -2e4 * time * time);
        0
    };
    beam.apply_body_force(tip, &[0.0, 0.0], Some(Box::new(pull)))?;
    let mut curve = [0.0; 12];
    let mut solve = SolveDesc::new();
    solve.steps = 2;
    solve.curve_load = support;
    solve.curve = &mut curve;
    let report = beam.solve(solve)?;
    s.common(&beam)?;
    s.count("load_steps", report.steps);
    s.count("curve_rows", report.curve_rows);
    s.doubles("curve", &curve);
    s.number("reaction_y", beam.get_reaction(support)?[1]);
    s.count("called", i64::from(called.load(Ordering::Relaxed) > 0));
    Ok(())
}

fn strip() -> peri::Result<Body> {
    let body = create(peri::SPACE_PLANE_STRESS, 0.15)?;
    let mut m = MaterialDesc::new(peri::LAW_BOND_BASED);
    m.young = 1e9;
    m.density = 1000.0;
    body.add_box(body.add_material(m)?, &[0.0, 0.0], &[1.0, 0.25], 0.05)?;
    body.build()?;
    Ok(body)
}

/// What a closure has panicked with comes out of the call.
fn panics<F: FnOnce() -> R, R>(call: F) -> bool {
    catch_unwind(AssertUnwindSafe(call)).err().is_some_and(|p| p.downcast_ref::<&str>() == Some(&"here"))
}

fn steps<'a>(n: i64) -> AdvanceDesc<'a> {
    let mut run = AdvanceDesc::new();
    run.steps = n;
    run.frame_steps = 1;
    run
}

fn own() -> peri::Result<()> {
    let error = create(peri::SPACE_SOLID, -1.0).err().expect("a negative horizon is refused");
    assert_eq!((error.status, error.field, error.index, error.value), (peri::ERROR_RANGE, "horizon", -1, -1.0));
    assert!(error.to_string().contains("horizon"));
    let mut body = strip()?;
    let error = body.get_reaction(peri::ALL).expect_err("a set is no load");
    assert_eq!((error.status, error.index), (peri::ERROR_ID_KIND, i64::from(peri::ALL)));
    let error = body.select_box("short", &[0.0], &[1.0, 1.0]).expect_err("a corner of a plane has two numbers");
    assert_eq!((error.status, error.field), (peri::ERROR_ARGUMENT, "lo"));
    std::panic::set_hook(Box::new(|_| {}));
    let mut frames = 0;
    let mut on_frame = |b: &Body| {
        frames += 1;
        assert!(panics(|| b.cut_if(peri::CUT_NOW, &mut |_, _, _, _| panic!("here"))));
        panic!("here")
    };
    let mut run = steps(3);
    run.on_frame = Some(&mut on_frame);
    assert!(panics(|| body.advance(run)) && frames == 1);
    assert!(panics(|| body.select_if("x", &mut |_, _| panic!("here"))));
    assert!(panics(|| body.export_vtu_to(&mut |_| panic!("here"))));
    let load = body.apply_body_force(peri::ALL, &[0.0, 0.0], Some(Box::new(|_, _, _| panic!("here"))))?;
    assert!(panics(|| body.advance(steps(3))));
    let _ = std::panic::take_hook();
    body.reset()?;
    body.remove_load(load)?;
    assert_eq!((body.advance(steps(3))?, body.step_count()), (peri::OK, 3));
    let copied = body.get_field(peri::FIELD_DISPLACEMENT)?;
    let view = body.view_field(peri::FIELD_DISPLACEMENT)?;
    assert_eq!((view.points(), view.components(), view.at(3, 1)), (100, 2, copied[7]));
    let address = view.doubles().unwrap().as_ptr() as usize; // not a copy: the same place again
    assert_eq!(body.view_field(peri::FIELD_DISPLACEMENT)?.doubles().unwrap().as_ptr() as usize, address);
    // a clone outlives the body with the closures of both, on another thread
    let calls = Arc::new(AtomicI64::new(0));
    let other = {
        let first = strip()?;
        let calls = calls.clone();
        let count = move |_: f64, _: &[i32], _: &mut [f64]| {
            calls.fetch_add(1, Ordering::Relaxed);
            0
        };
        first.apply_body_force(peri::ALL, &[0.0, 0.0], Some(Box::new(count)))?;
        first.clone()?
    };
    let other = std::thread::spawn(move || other.advance(steps(3)).map(|_| other)).join().unwrap()?;
    assert!(calls.load(Ordering::Relaxed) >= 3);
    assert_eq!(other.cracks_create(&peri::CracksDesc::new())?.paths(), 0);
    let matrix = other.matrix_create()?;
    let mut start = vec![0; matrix.rows() as usize + 1];
    matrix.get_matrix(Some(&mut start), None, None)?;
    assert_eq!((matrix.rows(), start[200]), (200, matrix.entries()));
    Ok(())
}

fn main() -> peri::Result<()> {
    glass(Scene("glass"))?;
    ball(Scene("ball"))?;
    cantilever(Scene("cantilever"))?;
    own()
}
