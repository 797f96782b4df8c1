//! Two blocks on each other with an oblique interface and meshes that do not match.
//!
//! Prescribed at both ends and loaded by `P N` at the sides, both deform by the
//! same `F` like one body as long as `|tau| <= mu p` for the traction
//! `sigma n = -p n + tau` of the interface.

use crate::scene::{Places, Run, block, body, coulomb, largest_distance, model, rubber, step};
use nalgebra::Matrix3;
use striae_contact::unknowns::Status;
use striae_law::bulk::Material;
use striae_mesh::{NodeId, Vec3};
use striae_solve::model::{BodyId, Curve, Displacement, LoadExtent, LoadKind, Model, Step};

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

fn shearing(shears: &[f64], divisions: [usize; 2], mu: f64) -> Model {
    let [lower, upper] = divisions.map(|n| [n, n, 1]);
    let mut lower = block([0.0; 3], [1.0, 1.0, 0.6], lower);
    let mut upper = block([0.0, 0.0, 0.6], [1.0, 1.0, 0.6], upper);
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
        set: "end".to_owned(),
        body: BodyId(body),
        nodes: vec![node],
        components: [Some(u.x), Some(u.y), Some(u.z)],
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
    for divisions in [[2, 3], [3, 2], [3, 4]] {
        let shears = [0.0, 0.1, 0.2];
        let run = Run::completed(shearing(&shears, divisions, 1.2));
        for (state, shear) in shears.iter().enumerate() {
            let f = gradient(*shear);
            let reference = &run.problem.reference;
            let expected: Vec<Vec3> = reference.iter().map(|x| f * x).collect();
            let error = largest_distance(&run.states[state + 1].positions, &expected);
            assert!(
                error < 1e-10,
                "{divisions:?}, shear {shear}: off by {error:.1e}"
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
    for divisions in [[2, 3], [3, 2], [2, 2]] {
        let mu = obliquity(&gradient(0.2));
        let run = Run::completed(shearing(&[0.0, 0.1999, 0.2001], divisions, mu));
        assert!(statuses(&run, 2).iter().all(|s| *s == Status::Stick));
        let after = statuses(&run, 3);
        assert!(
            after.iter().all(|s| *s == Status::Slip),
            "{divisions:?}: {after:?}"
        );
    }
}
