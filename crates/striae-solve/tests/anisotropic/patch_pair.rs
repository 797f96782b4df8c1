//! Uniform slip of two bodies of one material on each other, with homogeneous stress.
//!
//! Both have the gradient `F` of [`Oblique`], so that the interface bears the traction of the
//! friction law. The upper one hangs over, and is moved along the interface besides, by the
//! same way everywhere. Ends are prescribed; sides bear `P N`, and what is exposed of the
//! interface its traction.

use crate::{
    dissipation::dissipates,
    oblique::{Formula, Oblique, Sliding, material, uniform},
    scene::{Places, Run, block, body, largest_distance, model, step},
};
use nalgebra::Vector2;
use striae_contact::unknowns::Status;
use striae_mesh::{
    CellKind::{self, CompositeTetrahedron, Hexahedron, Pyramid, Tetrahedron, Wedge},
    Vec3,
    generate::Block,
};
use striae_model::{Axes, BodyId, Curve, Displacement, LoadExtent, LoadKind, Model, Step};

const HEIGHT: f64 = 0.4;
/// Distance that the upper body slides.
const WAY: f64 = 0.05;

/// The bodies at rest; side `a` is the upper one, as the laws are written for it.
fn at_rest(oblique: &Oblique, cells: [CellKind; 2]) -> Model {
    let lower = block([0.0; 3], [1.0, 1.0, HEIGHT], [2, 3, 1]);
    let upper = block([0.33, 0.21, HEIGHT], [0.8, 0.6, HEIGHT], [3, 2, 1]);
    let mesh = |block: Block, cells| Block { cells, ..block }.mesh().unwrap();
    let bodies = vec![
        body("lower", mesh(lower, cells[0]), material()),
        body("upper", mesh(upper, cells[1]), material()),
    ];
    let mut model = model(bodies);
    model.touch(("upper", "zmin"), ("lower", "zmax"), oblique.law.friction());
    model.pairs[0].textures = oblique.angles.map(|angle| angle.map(uniform));
    model
}

/// Positions of the nodes of a body, the upper one at `place`.
fn moved(sliding: &Sliding, body: usize, x: &Vec3, place: Vector2<f64>) -> Vec3 {
    sliding.gradient * x + place.push(0.0) * body as f64
}

/// A step of one increment to this state.
fn to(model: &Model, sliding: &Sliding, place: Vector2<f64>) -> Step {
    let mut step = step();
    let traction = sliding.stress * Vec3::z();
    for (at, (end, face, traction)) in [("zmin", "zmax", traction), ("zmax", "zmin", -traction)]
        .into_iter()
        .enumerate()
    {
        let body = &model.bodies[at];
        for node in model.nodes(&body.name, end) {
            let x = body.mesh.positions[node.index()];
            let u = moved(sliding, at, &x, place) - x;
            step.displacements.push(Displacement {
                axes: Axes::Global,
                set: end.to_owned(),
                body: BodyId(at),
                nodes: vec![node],
                components: [u.x, u.y, u.z].map(|u| Some(u.into())),
                curve: Curve::Ramp,
            });
        }
        step.loads.extend(sliding.on_sides(model, &body.name));
        let follower = LoadKind::FollowerTraction(traction);
        let exposed = model.load(&body.name, face, follower, LoadExtent::Exposed);
        step.loads.push(exposed);
    }
    step
}

fn check(oblique: &Oblique, degrees: f64, cells: [CellKind; 2]) {
    let what = format!("{:?} along {degrees}, {cells:?}", oblique.law);
    let sliding = oblique.sliding(degrees);
    let stuck = oblique.bearing(sliding.direction, Vector2::zeros());
    let place = sliding.direction * WAY;
    let mut model = at_rest(oblique, cells);
    model.steps.push(to(&model, &stuck, Vector2::zeros()));
    model.steps.push(to(&model, &sliding, place));
    let run = Run::completed(model);
    for at in 0..2 {
        let body = &run.problem.model.bodies[at];
        let expected = body.mesh.positions.iter();
        let expected: Vec<Vec3> = expected.map(|x| moved(&sliding, at, x, place)).collect();
        let error = largest_distance(run.positions(at), &expected);
        assert!(error < 1e-10, "{what}: {} off by {error:.1e}", body.name);
        for (corners, element) in body.mesh.elements().zip(run.problem.elements[at].iter()) {
            let corners = corners.iter();
            let x: Vec<Vec3> = corners
                .map(|node| run.positions(at)[node.index()])
                .collect();
            for stress in element.stress(&x, &body.material, &[]).unwrap() {
                let error = (stress - sliding.stress).amax();
                assert!(error < 1e-10, "{what}: stress off by {error:.1e}");
            }
        }
    }
    let pair = &run.last().pairs[0];
    for (side, sign) in [1.0, -1.0].into_iter().enumerate() {
        let nodes = pair.nodes[side].iter().zip(&pair.kept[side]);
        for (node, _) in nodes.filter(|(_, kept)| **kept) {
            assert_eq!(node.status, Status::Slip, "{what}");
            let tau = (node.tau - sliding.tau.push(0.0) * sign).norm();
            let p = (node.pressure - sliding.pressure).abs();
            assert!(tau < 1e-10 && p < 1e-10, "{what}: {node:?}");
        }
    }
    dissipates(&run);
}

const CELLS: [[CellKind; 2]; 8] = [
    [Hexahedron, Hexahedron],
    [Tetrahedron, Hexahedron],
    [Hexahedron, Tetrahedron],
    [Tetrahedron, Wedge],
    [Wedge, Pyramid],
    [CompositeTetrahedron, Hexahedron],
    [Wedge, CompositeTetrahedron],
    [CompositeTetrahedron, CompositeTetrahedron],
];

#[test]
fn isotropic_slip_of_all_kinds_of_cells() {
    for cells in CELLS {
        let coulomb = Oblique::new(Formula::Coulomb(0.3), [None; 2]);
        check(&coulomb, 205.0, cells);
    }
}

#[test]
fn textured_slip_of_all_kinds_of_cells() {
    let nap = Oblique::new(Formula::Nap([0.1, 0.3, 0.2]), [Some(30.0), None]);
    let grooves = Oblique::new(Formula::Opposing([0.1, 0.3]), [None, Some(110.0)]);
    let two = Formula::TwoTextures([0.3, 0.1, 0.1, 0.5]);
    let two = Oblique::new(two, [Some(-20.0), Some(70.0)]);
    for (cells, oblique) in CELLS.into_iter().zip([nap, grooves, two].iter().cycle()) {
        check(oblique, 70.0, cells);
    }
}
