//! Rigid surfaces in the files of a run: where they are, how they are textured, and that
//! planes reach as far as their bodies go.

use striae::{
    output::vtk::{Stored, read_series},
    prelude::*,
};

/// Displacement and rotation of the floor.
const SHIFT: f64 = 0.1;
const TURN: f64 = 0.3;

fn run(folder: &std::path::Path) {
    let rubber = Material::neo_hookean(LameConstants::from_youngs_modulus(1e6, 0.3).unwrap());
    let mesh = Block {
        divisions: [2, 2, 2],
        ..Block::default()
    };
    let go = Freedom::To;
    let motion = [go(SHIFT), go(0.0), go(0.0), go(0.0), go(0.0), go(TURN)];
    let friction = Friction::orthotropic(0.1, 0.4, SlipRule::Opposing).unwrap();
    let textured = rigid("floor").textured(uniform([1.0, 0.0, 0.0]));
    let model = model("A block on a floor that turns")
        .body(body("block", mesh.mesh().unwrap(), rubber))
        .rigid(plane("floor", [0.0; 3], [0.0, 0.0, 1.0]))
        .pair(pair("sole", surface("block", "zmin"), textured).friction(friction))
        .step(
            step("press")
                .increments(1)
                .displace("block", "zmax", [0.0, 0.0, -0.02]),
        )
        .step(step("turn").increments(3).move_rigid("floor", motion))
        .step(
            step("drag")
                .increments(2)
                .displace("block", "zmax", [Some(3.0), None, None]),
        )
        .build()
        .unwrap();
    let simulation = Simulation::new(model).unwrap();
    let run = simulation.recorded(folder, "floor").run().unwrap();
    assert_eq!(run.ending, Ending::Completed);
}

#[test]
fn planes_are_written_where_they_are_and_as_far_as_bodies_go() {
    let folder = tempfile::tempdir().unwrap();
    run(folder.path());
    let [bodies, rigid] = ["bodies.pvd", "rigid.pvd"].map(|name| {
        let series = read_series(&folder.path().join(name)).unwrap();
        series.into_iter().map(|snapshot| {
            let path = folder.path().join(&snapshot.parts[0].1);
            (snapshot.time, Stored::open(&path).unwrap(), path)
        })
    });
    let (cos, sin) = (TURN.cos(), TURN.sin());
    let mut times = Vec::new();
    for ((time, body, body_path), (same, floor, path)) in bodies.zip(rigid) {
        assert_eq!(time, same);
        times.push(time);
        let numbers = |name: &str| floor.array(&path, name).unwrap().unwrap().numbers;
        let (s, a) = (numbers("texture"), numbers("structural_vector"));
        let share = (time - 1.0).clamp(0.0, 1.0);
        let turned = [(share * TURN).cos(), (share * TURN).sin(), 0.0];
        for (s, a) in s.chunks(3).zip(a.chunks(3)) {
            for axis in 0..3 {
                assert!((s[axis] - turned[axis]).abs() < 1e-12, "at {time}: {s:?}");
            }
            assert!((a[0] + turned[1]).abs() + (a[1] - turned[0]).abs() < 1e-12);
        }
        let points = floor.points(&path).unwrap();
        let moved = numbers("displacement");
        assert!(points.iter().all(|x| x[2].abs() < 1e-12));
        if time == 0.0 {
            assert!(moved.iter().all(|u| *u == 0.0));
        }
        // Seen from the floor, the body lies within its edges.
        let back = |x: &[f64; 3]| {
            let [x, y] = [x[0] - share * SHIFT, x[1]];
            if share == 1.0 {
                [cos * x + sin * y, cos * y - sin * x]
            } else {
                [x, y]
            }
        };
        if share == 0.0 || share == 1.0 {
            let edge = |of: fn(f64, f64) -> f64, axis: usize, places: &[[f64; 3]]| {
                places.iter().map(|x| back(x)[axis]).reduce(of).unwrap()
            };
            let body = body.points(&body_path).unwrap();
            // Turned as it is, the path of the body leaves the floor sideways.
            let along = if share == 0.0 { 0..2 } else { 0..1 };
            for axis in along {
                assert!(edge(f64::min, axis, &points) < edge(f64::min, axis, &body));
                assert!(edge(f64::max, axis, &points) > edge(f64::max, axis, &body));
            }
        }
    }
    assert_eq!(times.len(), 7);
    assert_eq!(times[0], 0.0);
}
