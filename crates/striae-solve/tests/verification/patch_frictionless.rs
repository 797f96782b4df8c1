//! A smaller block on a larger one under the same pressure on all exposed faces.
//!
//! The Cauchy stress is `-p e_z e_z` in both bodies whatever their overlap and
//! their meshes, so each body deforms by `diag(a, a, b)` with
//!
//! ```text
//! G/J (a^2 - 1) + lambda (J - 1) = 0,   G/J (b^2 - 1) + lambda (J - 1) = -p,   J = a^2 b
//! ```

use crate::scene::{Places, Run, block, body, largest_distance, model, rubber, step};
use nalgebra::{Matrix2, Matrix3, Vector2};
use striae_contact::side::Side;
use striae_law::{
    bulk::{LameConstants, Material},
    friction::Friction,
};
use striae_mesh::{CellKind, Vec3, generate::Block};
use striae_model::{LoadExtent, LoadKind, Model};

const PRESSURE: f64 = 0.1;
const HEIGHT: f64 = 0.5;

struct Case {
    lower: Block,
    upper: Block,
    materials: [Material; 2],
}

fn case(origin: [f64; 2], size: [f64; 2], divisions: [usize; 2]) -> Case {
    Case {
        lower: block(
            [0.0; 3],
            [1.0, 1.0, HEIGHT],
            [divisions[0], divisions[0], 1],
        ),
        upper: block(
            [origin[0], origin[1], HEIGHT],
            [size[0], size[1], HEIGHT],
            [divisions[1], divisions[1], 1],
        ),
        materials: [rubber(2.0, 0.2), rubber(1.0, 0.35)],
    }
}

/// Stretches `a`, `b` under the pressure, by Newton's method.
fn stretches(material: &Material) -> [f64; 2] {
    let LameConstants { lambda, shear: g } = material.lame_constants();
    let residual = |v: Vector2<f64>| {
        let j = v.x * v.x * v.y;
        let volumetric = lambda * (j - 1.0);
        Vector2::new(
            g / j * (v.x * v.x - 1.0) + volumetric,
            g / j * (v.y * v.y - 1.0) + volumetric + PRESSURE,
        )
    };
    let slope = |v: Vector2<f64>| {
        let j = v.x * v.x * v.y;
        let d_j = Vector2::new(2.0 * v.x * v.y, v.x * v.x);
        Matrix2::from_fn(|row, column| {
            let own = if row == column { 2.0 * v[row] } else { 0.0 };
            g / j * own - g / (j * j) * (v[row] * v[row] - 1.0) * d_j[column] + lambda * d_j[column]
        })
    };
    let mut v = Vector2::new(1.0, 1.0);
    for _ in 0..20 {
        v -= slope(v).try_inverse().unwrap() * residual(v);
    }
    assert!(residual(v).norm() < 1e-14);
    [v.x, v.y]
}

fn pressed(case: &Case, order: [usize; 2]) -> Model {
    let [hard, soft] = case.materials.clone();
    let bodies = vec![
        body("lower", case.lower.mesh().unwrap(), hard),
        body("upper", case.upper.mesh().unwrap(), soft),
    ];
    let mut model = model(bodies);
    let sides = [("lower", "zmax"), ("upper", "zmin")];
    model.touch(sides[order[0]], sides[order[1]], Friction::frictionless());
    let pressure = LoadKind::Pressure(PRESSURE);
    let mut step = step();
    step.loads = vec![model.load("upper", "zmax", pressure, LoadExtent::Whole)];
    if case.lower.size != case.upper.size {
        step.loads.extend([
            model.load("upper", "zmin", pressure, LoadExtent::Exposed),
            model.load("lower", "zmax", pressure, LoadExtent::Exposed),
        ]);
    }
    let mut held = vec![model.hold("lower", "zmin", [None, None, Some(0.0)])];
    for (name, block) in [("lower", &case.lower), ("upper", &case.upper)] {
        let corner = block.origin;
        let next = corner + Vec3::new(block.size.x, 0.0, 0.0);
        held.push(model.pin(name, corner.into(), [Some(0.0), Some(0.0), None]));
        held.push(model.pin(name, next.into(), [None, Some(0.0), None]));
    }
    step.displacements = held;
    model.steps = vec![step];
    // Pressures are compared to 1e-10.
    model.solver.tolerance = 1e-12;
    model
}

/// Integrals over triangles and parallelograms are exact, so what is left is Newton's
/// tolerance; over others shape functions are rational, and quadrature leaves an error that
/// falls with about the sixth power of their distortion.
fn tolerance(case: &Case) -> f64 {
    let blocks = [&case.lower, &case.upper];
    let skewed = |block: &&Block| {
        let four_corners = matches!(block.cells, CellKind::Hexahedron | CellKind::Pyramid);
        four_corners && (block.irregularity > 0.0 || block.mesh_rotation != 0.0)
    };
    if blocks.iter().any(skewed) {
        1e-8
    } else {
        1e-10
    }
}

fn check(name: &str, case: &Case) {
    for order in [[0, 1], [1, 0]] {
        check_ordered(name, case, order);
    }
}

fn check_ordered(name: &str, case: &Case, order: [usize; 2]) {
    let tolerance = tolerance(case);
    let run = Run::completed(pressed(case, order));
    let what = format!("{name}, order {order:?}");
    check_bodies(&what, &run, case, tolerance);
    check_interface(&what, &run, tolerance);
}

fn check_bodies(what: &str, run: &Run, case: &Case, tolerance: f64) {
    let materials = &case.materials;
    let [_, lower] = stretches(&materials[0]);
    let expected_stress = Matrix3::from_diagonal(&Vec3::new(0.0, 0.0, -PRESSURE));
    for (body, block) in [&case.lower, &case.upper].into_iter().enumerate() {
        let [a, b] = stretches(&materials[body]);
        let bottom = [0.0, lower * HEIGHT][body];
        let model = &run.problem.model.bodies[body];
        let expected: Vec<Vec3> = model
            .mesh
            .positions
            .iter()
            .map(|x| {
                let from = x - block.origin;
                block.origin.xy().push(bottom) + Vec3::new(a * from.x, a * from.y, b * from.z)
            })
            .collect();
        let error = largest_distance(run.positions(body), &expected);
        assert!(
            error < tolerance,
            "{what}, body {body}: displacements off by {error:.1e}"
        );
        for (corners, element) in model.mesh.elements().zip(run.problem.elements[body].iter()) {
            let corners = corners.iter();
            let x: Vec<Vec3> = corners.map(|n| run.positions(body)[n.index()]).collect();
            for stress in element.stress(&x, &model.material, &[]).unwrap() {
                let error = (stress - expected_stress).amax();
                assert!(
                    error < tolerance * PRESSURE,
                    "{what}, body {body}: stress off by {error:.1e}"
                );
            }
        }
    }
}

fn check_interface(what: &str, run: &Run, tolerance: f64) {
    let pair = &run.last().pairs[0];
    let mut kept = 0;
    for side in Side::BOTH {
        for (node, is_kept) in pair.kept[side].iter().enumerate() {
            let p = pair.nodes[side][node].pressure;
            let off = (p - PRESSURE).abs();
            // Nodes without a share in the field have no pressure at all.
            let outside = !is_kept && p == 0.0;
            assert!(
                outside || off < tolerance * PRESSURE,
                "{what}: pressure {p} at {side}, {node}"
            );
            kept += usize::from(*is_kept);
        }
    }
    assert!(kept >= 4, "{what}: {kept} nodes");
    let report = &striae_solve::report::pairs(&run.problem, run.last())[0];
    assert!(
        report.mismatch < 1e-13 && report.moment_mismatch < tolerance,
        "{what}: {report:?}"
    );
    assert!(
        run.iterations[0].len() <= 7,
        "{what}: {} iterations",
        run.iterations[0].len()
    );
}

#[test]
fn matching_meshes() {
    check("matching", &case([0.25, 0.25], [0.5, 0.5], [4, 2]));
}

#[test]
fn three_to_four() {
    check("upper coarser", &case([0.125, 0.125], [0.75, 0.75], [4, 2]));
    check("upper finer", &case([0.125, 0.125], [0.75, 0.75], [3, 4]));
}

#[test]
fn rotated_mesh() {
    for divisions in [[3, 4], [4, 3]] {
        let mut case = case([0.1, 0.2], [0.7, 0.6], divisions);
        case.upper.mesh_rotation = 17.0;
        check("upper mesh turned", &case);
        case.lower.mesh_rotation = 17.0;
        case.upper.mesh_rotation = 0.0;
        check("lower mesh turned", &case);
    }
}

#[test]
fn overhang() {
    for divisions in [[3, 4], [4, 3]] {
        check(
            "overhang on two sides",
            &case([0.35, 0.27], [0.9, 0.95], divisions),
        );
    }
}

#[test]
fn irregular_meshes() {
    for divisions in [[3, 4], [5, 3]] {
        let mut case = case([0.11, 0.23], [0.7, 0.6], divisions);
        case.upper.irregularity = 0.2;
        case.lower.irregularity = 0.2;
        case.lower.seed = 1;
        check("irregular", &case);
    }
}

/// Kinds of the cells of the lower and the upper body.
const CELLS: [[CellKind; 2]; 9] = {
    use CellKind::{CompositeTetrahedron, Hexahedron, Pyramid, Tetrahedron, Wedge};
    [
        [Hexahedron, Tetrahedron],
        [Tetrahedron, Hexahedron],
        [Tetrahedron, Tetrahedron],
        [Wedge, Hexahedron],
        [Tetrahedron, Wedge],
        [Pyramid, Wedge],
        [CompositeTetrahedron, Hexahedron],
        [Wedge, CompositeTetrahedron],
        [CompositeTetrahedron, CompositeTetrahedron],
    ]
};

/// Checks a case of all kinds of cells, with sides in either order by turns.
fn check_cells(name: &str, case: impl Fn() -> Case) {
    for ([lower, upper], order) in CELLS.into_iter().zip([[0, 1], [1, 0]].into_iter().cycle()) {
        let mut case = case();
        case.lower.cells = lower;
        case.upper.cells = upper;
        check_ordered(&format!("{upper} on {lower}, {name}"), &case, order);
    }
}

#[test]
fn whole_faces_of_all_kinds_of_cells() {
    check_cells("whole faces", || {
        let mut case = case([0.0, 0.0], [1.0, 1.0], [3, 2]);
        case.materials[0] = case.materials[1].clone();
        case
    });
}

#[test]
fn overhang_of_all_kinds_of_cells() {
    check_cells("overhang", || case([0.35, 0.27], [0.9, 0.95], [2, 3]));
}

#[test]
fn irregular_meshes_of_all_kinds_of_cells() {
    check_cells("irregular", || {
        let mut case = case([0.11, 0.23], [0.7, 0.6], [3, 2]);
        case.upper.irregularity = 0.15;
        case.lower.irregularity = 0.15;
        case.lower.seed = 1;
        case.upper.mesh_rotation = 17.0;
        case
    });
}
