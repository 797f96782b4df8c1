//! A block with grooves that slides across them, to and fro.

use striae_contact::side::Side;
use striae_law::{
    bulk::{LameConstants, Material},
    friction::{Friction, SlipRule},
};
use striae_mesh::{NodeId, Vec3};
use striae_model::{Axes, BodyId, Curve, Displacement, LoadExtent, LoadKind, Model};
use striae_surface::texture::{Field, Lines, Paint};

use crate::scene::{Places, Run, block, body, increments, model, plane, step};

/// Coefficients of friction along and across the grooves.
const MU: [f64; 2] = [0.1, 0.3];
const WEAR: f64 = 0.05;
const PRESSURE: f64 = 0.05;
const WAY: f64 = 0.4;
const PASSES: usize = 20;
const INCREMENTS: usize = 4;

/// A soft block under a dead load, dragged by its upper side, straight across its grooves.
fn dragged() -> Model {
    let mesh = block([0.0; 3], [1.0, 1.0, 0.4], [5, 4, 2]).mesh().unwrap();
    let material = Material::neo_hookean(LameConstants::from_youngs_modulus(10.0, 0.3).unwrap());
    let mut model = model(vec![body("block", mesh, material)]);
    let friction = Friction::orthotropic(MU[0], MU[1], SlipRule::Opposing).unwrap();
    let floor = plane([0.0; 3], [0.0, 0.0, 1.0]);
    model.touch_rigid(("block", "zmin"), floor, friction);
    model.pairs[0].wear = [WEAR, 0.0];
    let grooves = Paint::Field(Field {
        lines: Lines::Uniform(Vec3::y()),
        turn: 0.0,
    });
    model.pairs[0].textures = [Some(grooves), None];
    let count = model.bodies[0].mesh.positions.len();
    let guided = Displacement {
        axes: Axes::Global,
        set: "all".to_owned(),
        body: BodyId(0),
        nodes: (0..count).map(NodeId::new).collect(),
        components: [None, Some(0.0.into()), None],
        curve: Curve::Ramp,
    };
    let mut press = step();
    let load = LoadKind::Pressure(PRESSURE);
    press.loads = vec![model.load("block", "zmax", load, LoadExtent::Whole)];
    let held = model.hold("block", "zmax", [Some(0.0), None, None]);
    press.displacements = vec![guided, held];
    model.steps = vec![press];
    for pass in 0..PASSES {
        let to = if pass % 2 == 0 { WAY } else { 0.0 };
        let mut slide = step();
        slide.displacements = vec![model.hold("block", "zmax", [Some(to), None, None])];
        slide.increments = increments(1.0 / INCREMENTS as f64, 1e-3);
        model.steps.push(slide);
    }
    model
}

/// All that slips does so across the grooves, so that the volume is `k/mu_across` times the friction
/// work in every increment, stick and turns included. The mean depth is that of Archard's law for
/// the way of the block, less what its shear takes as it turns round.
#[test]
fn twenty_passes_take_the_volume_of_the_friction_work() {
    let run = Run::completed(dragged());
    assert_eq!(run.states.len(), 2 + PASSES * INCREMENTS);
    let mut before = vec![0.0; run.last().pairs[0].tractions.worn[Side::A].len()];
    for state in &run.states[2..] {
        let pair = &state.pairs[0];
        let of_work = WEAR / MU[1] * pair.dissipated;
        assert!((pair.worn[0] / of_work - 1.0).abs() < 1e-12);
        let depths = &pair.tractions.worn[Side::A];
        let nodes = depths.iter().zip(&before);
        assert!(nodes.clone().all(|(now, then)| now >= then));
        assert!(nodes.into_iter().any(|(now, then)| now > then));
        before.clone_from(depths);
    }
    let expected = WEAR * PRESSURE * WAY * PASSES as f64;
    let worn = run.last().pairs[0].worn[0];
    assert!(
        worn < expected && worn > 0.98 * expected,
        "{worn} {expected}"
    );
    // Nodes of the sole have worn, each on its own, and the block follows what they lose.
    let deepest = before.iter().copied().fold(0.0, f64::max);
    let sunk = run
        .problem
        .node(0, run.problem.model.node_at("block", [0.4, 0.5, 0.0]));
    let height = run.last().positions[sunk].z;
    assert!(
        height < -0.8 * expected && height > -1.2 * deepest,
        "{height} {deepest}"
    );
}
