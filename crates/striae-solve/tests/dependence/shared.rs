//! A cube that slides over a floor of two parts, each in a pair of its own: slip, states of
//! friction and worn depths go on with the surfaces, whichever pair they are in.

use striae_contact::side::Side;
use striae_law::friction::{
    Evolution, Friction, Healing, HealingCourse, RateAndState, SlipDependence, StateDependence,
};
use striae_mesh::{Face, NodeId};
use striae_model::{
    Axes, BodyId, ContactSurface, Curve, Displacement, LoadExtent, LoadKind, Model, Pair,
};
use striae_solve::{outcome::Ending, report::pairs, state::State};

use crate::scene::{Places, Run, block, body, coulomb, increments, model, rubber, step};

const MU: f64 = 0.3;
const PRESSURE: f64 = 0.05;
const WAY: f64 = 1.3;
/// Increments of the way.
const COUNT: usize = 13;
/// Place of the border between the two parts of the floor.
const BORDER: f64 = 1.2;

/// Numbers of elements along an edge of the cube, of 1, and along the floor, of 3: which side keeps
/// nodes follows from them.
const DIVISIONS: [[usize; 2]; 4] = [[5, 5], [5, 3], [2, 15], [4, 22]];

/// A cube on a held floor, pressed by a dead load, then moved along it with all of its nodes:
/// pressure and slip are the same everywhere.
fn cube([cube, floor]: [usize; 2], friction: Friction) -> Model {
    let mesh = block([0.0; 3], [1.0; 3], [cube, 2, 2]).mesh().unwrap();
    let road = block([-0.3, -0.5, -0.5], [3.0, 2.0, 0.5], [floor, 4, 1]).mesh();
    let bodies = [("cube", mesh), ("floor", road.unwrap())];
    let bodies = bodies.map(|(name, mesh)| body(name, mesh, rubber(10.0, 0.0)));
    let mut model = model(bodies.into());
    model.touch(("cube", "zmin"), ("floor", "zmax"), friction);
    let all = |body: usize, to: [Option<f64>; 3]| Displacement {
        axes: Axes::Global,
        set: "all".to_owned(),
        body: BodyId(body),
        nodes: (0..model.bodies[body].mesh.positions.len())
            .map(NodeId::new)
            .collect(),
        components: to.map(|to| to.map(Into::into)),
        curve: Curve::Ramp,
    };
    let held = all(1, [Some(0.0); 3]);
    let (mut press, mut slide) = (step(), step());
    press.displacements = vec![all(0, [Some(0.0), Some(0.0), None]), held.clone()];
    let load = LoadKind::Pressure(PRESSURE);
    press.loads = vec![model.load("cube", "zmax", load, LoadExtent::Whole)];
    slide.displacements = vec![all(0, [Some(WAY), Some(0.0), None]), held];
    slide.increments = increments(1.0 / COUNT as f64, 0.05);
    model.steps = vec![press, slide];
    model
}

/// Divides the pair into one for each part of the floor.
fn over_two_parts(mut model: Model) -> Model {
    let whole = model.pairs.remove(0);
    let ContactSurface::Deformable { body, faces } = &whole.b else {
        panic!("the floor deforms");
    };
    let mesh = &model.bodies[body.0].mesh;
    let is_left = |face: &Face| {
        let corners = mesh
            .face_nodes(*face)
            .map(|node| mesh.positions[node.index()].x);
        corners.iter().sum::<f64>() < 4.0 * BORDER
    };
    let [left, right] = [true, false].map(|left| {
        let faces = faces.iter().copied().filter(|face| is_left(face) == left);
        let part = ContactSurface::Deformable {
            body: *body,
            faces: faces.collect(),
        };
        Pair {
            name: if left { "left" } else { "right" }.to_owned(),
            b: part,
            ..whole.clone()
        }
    });
    model.pairs = vec![left, right];
    model
}

/// The run of a model that gets through all steps without cuts.
fn run(model: Model) -> Run {
    let run = Run::of(model);
    assert_eq!(run.ending, Ending::Completed, "{}", run.ending);
    assert!(run.cuts.is_empty(), "{:?}", run.cuts);
    run
}

/// Forces on the cube by all pairs in all states but the first, along and against the floor.
fn forces(run: &Run) -> Vec<[f64; 2]> {
    let force = |state: &State| {
        let of_pairs = pairs(&run.problem, state);
        let forces = of_pairs.iter().map(|pair| pair.sides[0].force);
        let force: striae_mesh::Vec3 = forces.sum();
        [-force.x, force.z]
    };
    run.states[1..].iter().map(force).collect()
}

/// Largest difference of forces over the load.
fn difference(one: &Run, other: &Run) -> f64 {
    let [one, other] = [forces(one), forces(other)];
    assert_eq!(one.len(), other.len());
    let both = one.iter().flatten().zip(other.iter().flatten());
    let largest = both.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    largest / PRESSURE
}

fn frictions() -> Vec<Friction> {
    let by_slip = SlipDependence::exponential(0.25, 0.5).unwrap();
    let by_state = RateAndState {
        evolution: Evolution::Ageing,
        direct_effect: 0.01,
        evolution_effect: 0.03,
        slip_rate: 1.0,
        slip_distance: 0.4,
        state: 5.0,
    };
    let healing = Healing {
        course: HealingCourse::Exponential {
            kinetic_over_static: 0.6,
        },
        slip_distance: 0.5,
        healing_time: 20.0,
        state: 1.0,
    };
    vec![
        coulomb(MU).with_slip(by_slip),
        coulomb(MU).with_state(StateDependence::rate_and_state(by_state).unwrap()),
        coulomb(MU).with_state(StateDependence::healing(healing).unwrap()),
    ]
}

/// The cube takes its history with it, whichever side keeps nodes and whatever pair they are in: its
/// friction changes as that of a cube of one element.
#[test]
fn friction_goes_by_the_surface_that_slips_farther() {
    for friction in frictions() {
        let alone = run(cube([1, 1], friction.clone()));
        let along = forces(&alone);
        let change = along.last().unwrap()[0] / along[1][0];
        assert!(change < 0.9, "{friction:?}: {change}");
        for divisions in DIVISIONS {
            let one = cube(divisions, friction.clone());
            for (model, bound) in [(one.clone(), 1e-4), (over_two_parts(one), 1e-3)] {
                let found = difference(&alone, &run(model));
                assert!(found < bound, "{divisions:?}, {friction:?}: {found:.1e}");
            }
        }
    }
}

/// The sole of the cube wears nearly as it would on one part, and so does the floor: depths differ
/// where nodes of either side carry the pressure at the border.
#[test]
fn depths_go_on_where_a_surface_comes_into_another_pair() {
    for divisions in DIVISIONS {
        let mut worn = cube(divisions, coulomb(MU));
        worn.pairs[0].wear = [0.2, 0.1];
        let [one, two] = [worn.clone(), over_two_parts(worn)].map(run);
        let found = difference(&one, &two);
        assert!(found < 5e-3, "{divisions:?}: {found:.1e}");
        let depth = |run: &Run, pair: usize| run.last().pairs[pair].tractions.worn[Side::A].clone();
        let of_one = depth(&one, 0);
        for pair in [0, 1] {
            for (one, two) in of_one.iter().zip(depth(&two, pair)) {
                assert!(
                    (one - two).abs() < 0.08 * one,
                    "{divisions:?}: {one}, {two}"
                );
            }
        }
        let volumes = |run: &Run, side: usize| -> f64 {
            run.last().pairs.iter().map(|pair| pair.worn[side]).sum()
        };
        for side in [0, 1] {
            let [one, two] = [&one, &two].map(|run| volumes(run, side));
            assert!(
                (two / one - 1.0).abs() < 1e-2,
                "{divisions:?}: {one}, {two}"
            );
        }
    }
}

/// A pair without wear meets the surface as others have worn it.
#[test]
fn a_pair_without_wear_meets_what_others_have_worn() {
    let mut worn = over_two_parts(cube(DIVISIONS[0], coulomb(MU)));
    let unworn = run(worn.clone());
    worn.pairs[0].wear = [0.2, 0.0];
    let run = run(worn);
    let last = run.last();
    let [left, right] = [0, 1].map(|pair| &last.pairs[pair].tractions.worn[Side::A]);
    assert_eq!(left, right);
    // Most of the cube is on the second pair at the end, and has come down by what is off it.
    let worn = run.positions(0).iter().zip(unworn.positions(0));
    let lost: f64 = worn.map(|(worn, unworn)| unworn.z - worn.z).sum();
    let lost = lost / run.positions(0).len() as f64;
    let deepest = right.iter().copied().fold(0.0, f64::max);
    assert!(lost > 0.3 * deepest && lost < deepest, "{lost}, {deepest}");
}

/// In full slip friction takes its force times the way, and wears off in proportion, however far
/// contact moves over the facets in an increment.
#[test]
fn work_and_worn_volume_are_those_of_the_force_on_its_way() {
    for (divisions, increments) in DIVISIONS.into_iter().zip([13, 5, 3, 8]) {
        let mut model = cube(divisions, coulomb(MU));
        model.pairs[0].wear = [1e-4, 0.0];
        let size = 1.0 / increments as f64;
        model.steps[1].increments.initial = size;
        model.steps[1].increments.largest = size;
        let run = run(model);
        let forces = forces(&run);
        assert_eq!(forces.len(), 1 + increments);
        for (states, force) in run.states[1..].windows(2).zip(&forces[1..]) {
            let [before, after] = [&states[0], &states[1]].map(|state| &state.pairs[0]);
            let way = WAY * size;
            let work = after.dissipated - before.dissipated;
            let by_force = force[0] * way;
            assert!((work / by_force - 1.0).abs() < 1e-3, "{work}, {by_force}");
            let volume = after.worn[0] - before.worn[0];
            let expected = 1e-4 * PRESSURE * way;
            assert!(
                (volume / expected - 1.0).abs() < 1e-3,
                "{volume}, {expected}"
            );
        }
    }
}

/// A place that touches with friction and without slips as far as it does with friction: in an
/// increment all of the way or none of it.
#[test]
fn pairs_without_friction_count_no_slip() {
    let mut model = over_two_parts(cube(DIVISIONS[1], coulomb(MU)));
    model.pairs[1].friction = Friction::frictionless();
    let run = run(model);
    let slip = &run.last().pairs[0].tractions.accumulated[Side::A];
    let way = WAY / COUNT as f64;
    assert!(slip.iter().any(|slip| *slip > 3.0 * way), "{slip:?}");
    for slip in slip {
        let ways = slip / way;
        assert!((ways - ways.round()).abs() < 1e-2, "{ways}");
    }
}
