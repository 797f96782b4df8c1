//! Blocks that slide: the friction of their pressure, speed and way.

use striae_contact::{side::Side, unknowns::Status};
use striae_law::friction::{
    Decay, Friction, Logarithm, PressureDependence, RateDependence, SlipDependence, SlipRule,
};
use striae_mesh::NodeId;
use striae_model::{Axes, BodyId, Curve, Displacement, LoadExtent, LoadKind, Model};
use striae_solve::{outcome::Ending, report::pairs, state::State};
use striae_surface::texture::{Field, Lines, Paint};

use crate::scene::{Places, Run, block, body, coulomb, increments, model, plane, rubber, step};

const MU: f64 = 0.3;

/// Friction on side `a`, and the force that presses it, at the end.
fn forces(run: &Run) -> [f64; 2] {
    force(run, run.last())
}

/// Friction and normal force in a state.
pub fn force(run: &Run, state: &State) -> [f64; 2] {
    let force = pairs(&run.problem, state)[0].sides[0].force;
    [force.xy().norm(), force.z]
}

/// A unit cube on a plane under a uniform pressure, all of its nodes moved along the plane at a
/// speed: pressure and slip rate are the same everywhere.
pub fn uniform(pressure: f64, speed: f64, friction: Friction) -> Model {
    let mesh = block([0.0; 3], [1.0, 1.0, 1.0], [2, 3, 2]).mesh().unwrap();
    let mut model = model(vec![body("block", mesh, rubber(10.0, 0.0))]);
    let floor = plane([0.0; 3], [0.0, 0.0, 1.0]);
    model.touch_rigid(("block", "zmin"), floor, friction);
    let all = |[x, y]: [f64; 2]| Displacement {
        axes: Axes::Global,
        set: "all".to_owned(),
        body: BodyId(0),
        nodes: (0..model.bodies[0].mesh.positions.len())
            .map(NodeId::new)
            .collect(),
        components: [Some(x.into()), Some(y.into()), None],
        curve: Curve::Ramp,
    };
    let (mut press, mut slide) = (step(), step());
    press.displacements = vec![all([0.0; 2])];
    let load = LoadKind::Pressure(pressure);
    press.loads = vec![model.load("block", "zmax", load, LoadExtent::Whole)];
    slide.duration = 2.0;
    slide.displacements = vec![all([0.8, 0.6].map(|way| 2.0 * way * speed))];
    slide.increments = increments(0.25, 0.2);
    model.steps = vec![press, slide];
    model
}

/// Asserts that friction of the sliding cube is that of a closed form.
fn assert_slides(friction: &Friction, pressure: f64, speed: f64, expected: f64) {
    let run = Run::completed(uniform(pressure, speed, friction.clone()));
    let [along, normal] = forces(&run);
    assert!((normal / pressure - 1.0).abs() < 1e-9, "{normal}");
    let name = friction.coefficient();
    let error = along / expected - 1.0;
    assert!(error.abs() < 1e-9, "{name:?} at {pressure}: {error:.1e}");
}

#[test]
fn a_block_in_full_slip_has_the_friction_of_its_pressure() {
    let with = |found: Result<PressureDependence, _>| coulomb(MU).with_pressure(found.unwrap());
    let power = with(PressureDependence::power_law(2.0 / 3.0, 0.1, None));
    let rising = with(PressureDependence::power_law(1.3, 0.1, None));
    let adhesion = with(PressureDependence::adhesion(0.02, None));
    let saturation = with(PressureDependence::saturation(0.05));
    let [places, factors] = [[0.0, 0.05, 0.2, 0.4], [1.2, 1.0, 0.6, 0.5]];
    let table = with(PressureDependence::table(&places, &factors));
    for pressure in [0.05, 0.2, 0.6] {
        let slides = |friction: &Friction, expected: f64| {
            assert_slides(friction, pressure, 0.1, expected);
        };
        slides(&power, MU * 0.1 * (pressure / 0.1).powf(2.0 / 3.0));
        slides(&rising, MU * 0.1 * (pressure / 0.1_f64).powf(1.3));
        slides(&adhesion, MU * (pressure + 0.02));
        slides(&saturation, 0.05 * (MU * pressure / 0.05).tanh());
        let at = places.iter().position(|place| *place == pressure);
        slides(&table, MU * factors[at.unwrap_or(3)] * pressure);
    }
}

#[test]
fn a_block_in_full_slip_has_the_friction_of_its_speed() {
    let with = |found: Result<RateDependence, _>| coulomb(MU).with_rate(found.unwrap());
    let stribeck = with(RateDependence::decay(Decay {
        kinetic_over_static: 0.4,
        slip_rate: 0.2,
        exponent: 2.0,
        viscous: 0.3,
    }));
    let rising = with(RateDependence::logarithm(Logarithm {
        factor: 0.05,
        slip_rate: 0.01,
        limit: None,
    }));
    let falling = with(RateDependence::logarithm(Logarithm {
        factor: -0.05,
        slip_rate: 0.01,
        limit: Some(1.0),
    }));
    for speed in [0.01, 0.1, 0.2, 0.4, 1.0, 3.0] {
        let slides = |friction: &Friction, factor: f64| {
            assert_slides(friction, 0.2, speed, MU * 0.2 * factor);
        };
        let decayed = 0.4 + 0.6 * (-(speed / 0.2).powi(2)).exp();
        slides(&stribeck, decayed + 0.3 * speed);
        slides(&rising, 1.0 + 0.05 * (speed / 0.01).ln_1p());
        slides(&falling, 1.0 - 0.05 * (speed.min(1.0) / 0.01).ln_1p());
    }
}

#[test]
fn factors_of_pressure_and_speed_multiply_in_laws_with_a_direction() {
    let law = Friction::orthotropic(0.1, 0.3, SlipRule::Opposing).unwrap();
    let power = PressureDependence::power_law(0.7, 0.1, None).unwrap();
    let rates = RateDependence::table(&[0.0, 0.4, 1.0], &[1.0, 0.8, 1.1]).unwrap();
    let friction = law.with_pressure(power).with_rate(rates);
    let mut model = uniform(0.2, 0.4, friction);
    // Slip is along (0.8, 0.6).
    for (lines, mu) in [([0.8, 0.6, 0.0], 0.1), ([-0.6, 0.8, 0.0], 0.3)] {
        model.pairs[0].textures[0] = Some(Paint::Field(Field {
            lines: Lines::Uniform(lines.into()),
            turn: 0.0,
        }));
        let [along, _] = forces(&Run::completed(model.clone()));
        let expected = mu * 0.8 * 0.1 * 2.0_f64.powf(0.7);
        assert!((along / expected - 1.0).abs() < 1e-9, "{along} {expected}");
    }
}

#[test]
fn friction_follows_the_slip_of_the_increments_before() {
    let run_in = SlipDependence::exponential(1.6, 0.15).unwrap();
    let run = Run::completed(uniform(0.2, 0.1, coulomb(MU).with_slip(run_in)));
    // Four increments of 0.05 each after the one that presses.
    assert_eq!(run.states.len(), 6);
    for (at, state) in run.states[2..].iter().enumerate() {
        let [along, _] = force(&run, state);
        let slip = 0.05 * at as f64;
        let expected = MU * 0.2 * (1.6 - 0.6 * (-slip / 0.15).exp());
        assert!((along / expected - 1.0).abs() < 1e-9, "{along} {expected}");
        let slips = state.pairs[0].tractions.accumulated.iter().flatten();
        let slips: Vec<f64> = slips.copied().collect();
        assert!(!slips.is_empty());
        assert!(
            slips.iter().all(|s| (s - slip - 0.05).abs() < 1e-12),
            "{slips:?}"
        );
    }
}

/// A block whose top is held and dragged: pressures differ from node to node, and nodes at the
/// edges open and close.
fn dragged(friction: Friction) -> Run {
    let mesh = block([0.0; 3], [1.0, 1.0, 0.4], [5, 4, 2]).mesh().unwrap();
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.3))]);
    let floor = plane([0.0; 3], [0.0, 0.0, 1.0]);
    model.touch_rigid(("block", "zmin"), floor, friction);
    let (mut press, mut slide) = (step(), step());
    press.displacements = vec![model.hold("block", "zmax", [Some(0.0), Some(0.0), Some(-0.02)])];
    slide.displacements = vec![model.hold("block", "zmax", [Some(0.3), Some(0.1), None])];
    slide.increments = increments(0.1, 1e-3);
    model.steps = vec![press, slide];
    Run::of(model)
}

#[test]
fn all_nodes_of_a_dragged_block_have_the_friction_of_their_pressure_and_speed() {
    let stribeck = RateDependence::decay(Decay {
        kinetic_over_static: 0.5,
        slip_rate: 0.1,
        exponent: 2.0,
        viscous: 0.1,
    });
    for dependence in [
        PressureDependence::power_law(2.0 / 3.0, 0.05, None),
        PressureDependence::power_law(1.4, 0.05, None),
        PressureDependence::adhesion(0.01, None),
        PressureDependence::saturation(0.01),
        PressureDependence::table(&[0.0, 0.03, 0.06], &[1.5, 1.0, 0.4]),
    ] {
        let friction = coulomb(MU).with_pressure(dependence.unwrap());
        let friction = friction.with_rate(stribeck.clone().unwrap());
        let name = format!("{:?}", friction.coefficient());
        let run = dragged(friction.clone());
        assert_eq!(run.ending, Ending::Completed, "{name}");
        assert!(run.cuts.is_empty(), "{name}: {:?}", run.cuts);
        let most = run.iterations.iter().map(Vec::len).max();
        assert!(most <= Some(12), "{name}: {most:?} iterations");
        let mut slipping = 0;
        // Increments of a tenth of a unit of time, after the one that presses.
        for pair in run.states[2..].iter().map(|state| &state.pairs[0]) {
            let nodes = pair.nodes[Side::A].iter().zip(&pair.kept[Side::A]);
            for (node, _) in nodes.filter(|(node, kept)| **kept && node.status != Status::Open) {
                let limit = friction.cap(node.pressure, 10.0 * node.slip.norm());
                let used = node.tau.norm();
                if node.status == Status::Slip {
                    slipping += 1;
                    assert!((used - limit).abs() < 1e-9, "{name}: {used} of {limit}");
                    assert!(node.tau.dot(&node.slip) <= 0.0, "{name}");
                } else {
                    assert!(used <= limit + 1e-9, "{name}: {used} of {limit}");
                }
            }
        }
        assert!(slipping > 100, "{name}: {slipping}");
    }
}
