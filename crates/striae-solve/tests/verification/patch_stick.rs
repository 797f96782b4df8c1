//! Two blocks on each other with an oblique interface and meshes that do not match.
//!
//! Prescribed at both ends and loaded by `P N` at the sides, both deform by the
//! same `F` like one body as long as `|tau| <= mu p` for the traction
//! `sigma n = -p n + tau` of the interface.

use crate::scene::{Places, Run, block, body, coulomb, largest_distance, model, rubber, step};
use nalgebra::Matrix3;
use striae_contact::unknowns::Status;
use striae_law::bulk::Material;
use striae_mesh::{CellKind, NodeId, Vec3};
use striae_model::{Axes, BodyId, Curve, Displacement, LoadExtent, LoadKind, Model, Step};

const SLOPES: [f64; 2] = [0.2, -0.1];

fn material() -> Material {
    rubber(1.0, 0.3)
}

/// Compression by 10 %, free sideways, then simple shear.
fn gradient(shear: f64) -> Matrix3<f64> {
    let mut f = Matrix3::from_diagonal(&Vec3::new(1.03, 1.03, 0.9));
    f[(0, 2)] = shear;
    f[(1, 2)] = 0.3 * shear;
    f
}

/// `|tau|/p` on the interface.
fn obliquity(f: &Matrix3<f64>) -> f64 {
    let sigma = material().cauchy_stress(f).unwrap();
    let reference = Vec3::new(-SLOPES[0], -SLOPES[1], 1.0);
    let n = (f.try_inverse().unwrap().transpose() * reference).normalize();
    let t = sigma * n;
    let p = -t.dot(&n);
    (t + n * p).norm() / p
}

/// Divisions and kinds of the cells of the lower and the upper body.
type Meshes = [(usize, CellKind); 2];

/// Meshes of hexahedra, and of other kinds on either side.
fn meshes() -> Vec<Meshes> {
    use CellKind::{CompositeTetrahedron, Hexahedron, Pyramid, Tetrahedron, Wedge};
    let hexahedra = [[2, 3], [3, 2], [3, 4]].map(|of| of.map(|n| (n, Hexahedron)));
    let others = [
        [(2, Tetrahedron), (3, Hexahedron)],
        [(3, Hexahedron), (2, Tetrahedron)],
        [(3, Tetrahedron), (2, Wedge)],
        [(2, Wedge), (3, Pyramid)],
        [(2, CompositeTetrahedron), (3, Hexahedron)],
        [(3, Wedge), (2, CompositeTetrahedron)],
        [(2, CompositeTetrahedron), (3, CompositeTetrahedron)],
    ];
    hexahedra.into_iter().chain(others).collect()
}

fn shearing(shears: &[f64], meshes: Meshes, mu: f64) -> Model {
    let [(lower, lower_cells), (upper, upper_cells)] = meshes;
    let mut lower = block([0.0; 3], [1.0, 1.0, 0.6], [lower, lower, 1]);
    let mut upper = block([0.0, 0.0, 0.6], [1.0, 1.0, 0.6], [upper, upper, 1]);
    (lower.cells, upper.cells) = (lower_cells, upper_cells);
    lower.top_slopes = SLOPES;
    upper.bottom_slopes = SLOPES;
    let bodies = vec![
        body("lower", lower.mesh().unwrap(), material()),
        body("upper", upper.mesh().unwrap(), material()),
    ];
    let mut model = model(bodies);
    model.touch(("lower", "zmax"), ("upper", "zmin"), coulomb(mu));
    model.steps = shears
        .iter()
        .map(|&shear| homogeneous(&model, &gradient(shear)))
        .collect();
    model
}

/// Ends moved to `F X`, sides loaded by `P N`, in one increment.
fn homogeneous(model: &Model, f: &Matrix3<f64>) -> Step {
    let piola = material().response(f).unwrap().first_piola;
    let mut step = step();
    for (index, body) in model.bodies.iter().enumerate() {
        for (set, normal) in [
            ("xmin", -Vec3::x()),
            ("xmax", Vec3::x()),
            ("ymin", -Vec3::y()),
            ("ymax", Vec3::y()),
        ] {
            let traction = LoadKind::DeadTraction(piola * normal);
            step.loads
                .push(model.load(&body.name, set, traction, LoadExtent::Whole));
        }
        let end = ["zmin", "zmax"][index];
        for node in model.nodes(&body.name, end) {
            step.displacements.push(moved(model, index, node, f));
        }
    }
    step
}

fn moved(model: &Model, body: usize, node: NodeId, f: &Matrix3<f64>) -> Displacement {
    let x = model.bodies[body].mesh.positions[node.index()];
    let u = f * x - x;
    Displacement {
        axes: Axes::Global,
        set: "end".to_owned(),
        body: BodyId(body),
        nodes: vec![node],
        components: [u.x, u.y, u.z].map(|u| Some(u.into())),
        curve: Curve::Ramp,
    }
}

/// Status of the kept nodes of both sides.
fn statuses(run: &Run, state: usize) -> Vec<Status> {
    let pair = &run.states[state].pairs[0];
    (0..2)
        .flat_map(|side| pair.kept[side].iter().zip(&pair.nodes[side]))
        .filter(|(kept, _)| **kept)
        .map(|(_, node)| node.status)
        .collect()
}

#[test]
fn sticking_blocks_deform_like_one() {
    for meshes in meshes() {
        let shears = [0.0, 0.1, 0.2];
        let run = Run::completed(shearing(&shears, meshes, 1.2));
        for (state, shear) in shears.iter().enumerate() {
            let f = gradient(*shear);
            let reference = &run.problem.reference;
            let expected: Vec<Vec3> = reference.iter().map(|x| f * x).collect();
            let error = largest_distance(&run.states[state + 1].positions, &expected);
            assert!(
                error < 1e-10,
                "{meshes:?}, shear {shear}: off by {error:.1e}"
            );
            assert!(
                statuses(&run, state + 1)
                    .iter()
                    .all(|s| *s == Status::Stick)
            );
        }
    }
}

#[test]
fn all_nodes_leave_stick_at_the_same_load() {
    for meshes in meshes() {
        let mu = obliquity(&gradient(0.2));
        let run = Run::completed(shearing(&[0.0, 0.1999, 0.2001], meshes, mu));
        assert!(statuses(&run, 2).iter().all(|s| *s == Status::Stick));
        let after = statuses(&run, 3);
        assert!(
            after.iter().all(|s| *s == Status::Slip),
            "{meshes:?}: {after:?}"
        );
    }
}
