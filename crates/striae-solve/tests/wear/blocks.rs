//! Blocks that wear under a uniform pressure, and two that wear each other.

use striae_contact::side::Side;
use striae_law::bulk::{LameConstants, Material};
use striae_mesh::{NodeId, Vec3};
use striae_model::{Axes, BodyId, Curve, Displacement, LoadExtent, LoadKind, Model};
use striae_solve::{newton::InStep, report::pairs, state::State, warning::Judgement};
use striae_surface::texture::{Field, Lines, Paint};

use crate::scene::{Places, Run, block, body, coulomb, increments, model, plane, step};

const MU: f64 = 0.3;
const YOUNG: f64 = 10.0;
/// Increments of the way that the blocks slide.
const COUNT: usize = 5;

/// A solid of linear elasticity without a Poisson effect.
fn columns() -> Material {
    let constants = LameConstants::from_youngs_modulus(YOUNG, 0.0);
    Material::linear_elastic(constants.unwrap())
}

/// The nodes of a body with some components prescribed.
fn held(body: usize, nodes: Vec<NodeId>, to: [Option<f64>; 3]) -> Displacement {
    Displacement {
        axes: Axes::Global,
        set: "nodes".to_owned(),
        body: BodyId(body),
        nodes,
        components: to.map(|value| value.map(Into::into)),
        curve: Curve::Ramp,
    }
}

fn all(model: &Model, body: usize) -> Vec<NodeId> {
    let count = model.bodies[body].mesh.positions.len();
    (0..count).map(NodeId::new).collect()
}

/// A cube on a plane, pressed by a load or by the displacement of its top, then moved along the
/// plane by `way` with all of its nodes: pressure and slip are the same everywhere.
fn cube(pressed: Pressed, way: f64, wear: f64) -> Model {
    let mesh = block([0.0; 3], [1.0; 3], [2, 3, 2]).mesh().unwrap();
    let mut model = model(vec![body("block", mesh, columns())]);
    let floor = plane([0.0; 3], [0.0, 0.0, 1.0]);
    model.touch_rigid(("block", "zmin"), floor, coulomb(MU));
    model.pairs[0].wear = [wear, 0.0];
    let (mut press, mut slide) = (step(), step());
    let whole = all(&model, 0);
    press.displacements = vec![held(0, whole.clone(), [Some(0.0), Some(0.0), None])];
    match pressed {
        Pressed::By(pressure) => {
            let load = LoadKind::Pressure(pressure);
            press.loads = vec![model.load("block", "zmax", load, LoadExtent::Whole)];
        }
        Pressed::Down(depth) => {
            let down = model.hold("block", "zmax", [None, None, Some(-depth)]);
            press.displacements.push(down);
        }
    }
    slide.displacements = vec![held(0, whole, [Some(0.8 * way), Some(0.6 * way), None])];
    slide.increments = increments(1.0 / COUNT as f64, 0.1);
    model.steps = vec![press, slide];
    model
}

/// Source of the pressure of a cube.
#[derive(Clone, Copy)]
enum Pressed {
    By(f64),
    Down(f64),
}

fn assert_uniform(values: &[f64], expected: f64, tolerance: f64) {
    for value in values {
        let error = value / expected - 1.0;
        assert!(
            error.abs() < tolerance,
            "{value:e} {expected:e}: {error:.1e}"
        );
    }
}

/// Depths at the nodes that have worn.
fn depths(state: &State, side: Side) -> Vec<f64> {
    let worn = state.pairs[0].tractions.worn[side].iter();
    worn.copied().filter(|depth| *depth != 0.0).collect()
}

fn assert_no_warning(run: &Run) {
    let mut judgement = Judgement::default();
    for (states, progress) in run.states.windows(2).zip(&run.progress) {
        let in_step = InStep::up_to(progress.step, progress.fraction);
        judgement.increment(&run.problem, &states[0], &states[1], in_step);
    }
    let warnings = judgement.warnings(&run.problem, &run.ending);
    assert!(warnings.is_empty(), "{warnings:?}");
}

#[test]
fn depth_under_a_dead_load_is_that_of_archard_everywhere() {
    // From hardly any stress of what wears off to many times the stress that there is.
    for (pressure, wear, way) in [(0.2, 1e-3, 0.1), (0.2, 0.05, 2.0), (0.01, 50.0, 0.3)] {
        let run = Run::completed(cube(Pressed::By(pressure), way, wear));
        for (index, state) in run.states.iter().rev().take(COUNT).rev().enumerate() {
            let slipped = way * (index + 1) as f64 / COUNT as f64;
            let worn = depths(state, Side::A);
            assert_eq!(worn.len(), 12);
            assert_uniform(&worn, wear * pressure * slipped, 1e-9);
            let of_work = wear / MU * state.pairs[0].dissipated;
            assert_uniform(&[state.pairs[0].worn[0]], of_work, 1e-9);
        }
        // In the first of them friction rises from nothing, which counts half.
        for states in run.states[run.states.len() - COUNT..].windows(2) {
            let lost = states[1].energies.contact - states[0].energies.contact;
            let worn = states[1].pairs[0].worn[0] - states[0].pairs[0].worn[0];
            assert_uniform(&[lost], pressure * worn, 1e-6);
        }
        assert_no_warning(&run);
    }
}

/// Grooves at an angle to the way, on the block or on the plane.
#[test]
fn depth_across_grooves_is_that_of_the_ratio() {
    let (pressure, wear, way, ratio) = (0.2, 0.05, 2.0, 3.0_f64);
    for (side, degrees) in [(0, 0.0_f64), (0, 25.0), (1, 25.0), (1, 90.0)] {
        let mut model = cube(Pressed::By(pressure), way, wear);
        let radians = degrees.to_radians();
        let grooves = Vec3::new(radians.cos(), radians.sin(), 0.0);
        model.pairs[0].textures[side] = Some(Paint::Field(Field {
            lines: Lines::Uniform(grooves),
            turn: 0.0,
        }));
        model.pairs[0].wear_across = ratio;
        let run = Run::completed(model);
        let along = grooves.dot(&Vec3::new(0.8, 0.6, 0.0));
        let seen = (along * along + ratio * ratio * (1.0 - along * along)).sqrt();
        let worn = depths(run.states.last().unwrap(), Side::A);
        assert_eq!(worn.len(), 12);
        assert_uniform(&worn, wear * pressure * way * seen, 1e-9);
    }
}

#[test]
fn pressure_of_a_column_falls_by_the_implicit_decay_of_a_spring() {
    let depth = 0.01;
    for (wear, way) in [(0.05, 0.4), (1.0, 2.0)] {
        let run = Run::completed(cube(Pressed::Down(depth), way, wear));
        let start = run.states.len() - COUNT;
        let mut expected = YOUNG * depth;
        for state in &run.states[start..] {
            expected /= 1.0 + YOUNG * wear * way / COUNT as f64;
            let nodes = state.pairs[0].nodes[0].iter();
            let pressures: Vec<f64> = nodes
                .filter(|node| node.pressure > 0.0)
                .map(|node| node.pressure)
                .collect();
            assert_eq!(pressures.len(), 12);
            assert_uniform(&pressures, expected, 1e-8);
            assert_uniform(&depths(state, Side::A), depth - expected / YOUNG, 1e-8);
        }
        assert_no_warning(&run);
    }
}

/// A block that is pressed on a larger one and moved back and forth.
fn on_another(sides: [(&str, &str); 2], wear: [f64; 2]) -> Model {
    let lower = block([0.0; 3], [1.5, 1.0, 0.5], [5, 3, 1]).mesh().unwrap();
    let upper = block([0.3, 0.1, 0.5], [0.7, 0.8, 0.5], [3, 4, 1])
        .mesh()
        .unwrap();
    let bodies = vec![
        body("lower", lower, columns()),
        body("upper", upper, columns()),
    ];
    let mut model = model(bodies);
    model.touch(sides[0], sides[1], coulomb(MU));
    model.pairs[0].wear = wear;
    let (mut press, mut slide) = (step(), step());
    press.displacements = vec![
        model.hold("lower", "zmin", [Some(0.0); 3]),
        model.hold("upper", "zmax", [Some(0.0), Some(0.0), Some(-0.02)]),
    ];
    slide.displacements = vec![model.hold("upper", "zmax", [Some(0.3), Some(0.05), None])];
    slide.increments = increments(0.125, 1e-3);
    model.steps = vec![press, slide];
    model
}

#[test]
fn both_sides_wear_by_their_coefficients_whichever_is_the_first() {
    let [lower, upper] = [("lower", "zmax"), ("upper", "zmin")];
    let wear = [0.02, 0.06];
    let run = Run::completed(on_another([lower, upper], wear));
    let swapped = Run::completed(on_another([upper, lower], [wear[1], wear[0]]));
    let [one, other] = [&run, &swapped].map(|run| &run.last().pairs[0]);
    for side in Side::BOTH {
        let [at, from] = [
            &one.tractions.worn[side],
            &other.tractions.worn[side.opposite()],
        ];
        let deepest = at.iter().copied().fold(0.0, f64::max);
        assert!(deepest > 1e-4, "{deepest}");
        for (one, other) in at.iter().zip(from) {
            assert!((one - other).abs() < 1e-8 * deepest, "{one} {other}");
        }
        // Friction work counts the slip with what the ramp of weak nodes adds.
        assert_uniform(&[one.worn[side]], wear[side] / MU * one.dissipated, 2e-3);
    }
    let pressed = |run: &Run| pairs(&run.problem, run.last())[0].sides[0].force.z.abs();
    let without = Run::completed(on_another([lower, upper], [0.0; 2]));
    assert!((pressed(&run) / pressed(&swapped) - 1.0).abs() < 1e-8);
    assert!(pressed(&run) < 0.95 * pressed(&without));
    assert_no_warning(&run);
}
