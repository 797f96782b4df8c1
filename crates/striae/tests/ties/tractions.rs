//! Tractions of ties in files.

use std::path::Path;

use striae::{
    mesh::{
        CellKind::{CompositeTetrahedron, Hexahedron, Tetrahedron},
        generate::Block,
    },
    model::ModelBuilder,
    output::vtk::{Stored, read_series},
    prelude::*,
};

use super::scene::{Finished, halves, of, pull, tied};

/// Values of an array of a side at the last time, by node.
fn last(folder: &Path, side: &str, array: &str) -> Vec<Vec<f64>> {
    let series = read_series(&folder.join("ties.pvd")).unwrap();
    let parts = &series.last().unwrap().parts;
    let (_, file) = parts.iter().find(|part| part.0 == side).unwrap();
    let path = folder.join(file);
    let stored = Stored::open(&path).unwrap();
    let values = stored.array(&path, array).unwrap().unwrap();
    let rows = values.numbers.chunks_exact(values.components);
    rows.map(<[f64]>::to_vec).collect()
}

fn vectors(folder: &Path, side: &str, array: &str) -> Vec<Vec3> {
    let rows = last(folder, side, array).into_iter();
    rows.map(|row| Vec3::from_column_slice(&row)).collect()
}

fn written(model: ModelBuilder, folder: &Path) -> Finished {
    let simulation = Simulation::new(model.build().unwrap()).unwrap();
    let run = simulation.recorded(folder, "ties").run().unwrap();
    assert_eq!(run.ending, Ending::Completed);
    run
}

/// Largest difference of the traction at nodes of a side from stress times normal.
fn error(run: &Finished, folder: &Path, side: &str, body: &str) -> f64 {
    let stress = run.results().stresses(body).unwrap()[0];
    let normals = vectors(folder, side, "normal");
    let tractions = vectors(folder, side, "traction");
    let along_normal = last(folder, side, "normal_traction");
    let shear = vectors(folder, side, "shear_traction");
    assert!(tractions.len() > 9);
    let mut largest = 0.0_f64;
    for (at, (normal, traction)) in normals.iter().zip(&tractions).enumerate() {
        let expected = stress * normal;
        largest = largest.max((traction - expected).norm() / expected.norm());
        let whole = shear[at] + normal * along_normal[at][0];
        assert!((whole - traction).norm() < 1e-12 * expected.norm());
        assert!(shear[at].dot(normal).abs() < 1e-12 * expected.norm());
        assert!(along_normal[at][0] > 0.0, "tension is positive");
    }
    largest
}

#[test]
fn a_uniform_stress_is_a_uniform_traction_on_both_sides() {
    for (lower, upper) in [
        (Hexahedron, Hexahedron),
        (Tetrahedron, Hexahedron),
        (Hexahedron, CompositeTetrahedron),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let [a, b] = halves([0.3, -0.2]);
        let blocks = [of(lower, a), of(upper, b)];
        let run = written(tied(&blocks).step(pull(0.1)), folder);
        for (side, body) in [("glue-lower", "lower"), ("glue-upper", "upper")] {
            let error = error(&run, folder, side, body);
            assert!(error < 1e-8, "{lower:?} {upper:?} {side}: {error:.2e}");
        }
    }
}

#[test]
fn tractions_add_up_to_the_force_and_end_where_the_tie_does() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let [lower, _] = halves([0.0; 2]);
    let upper = Block {
        origin: Vec3::new(0.31, 0.27, 0.5),
        size: Vec3::new(0.4, 0.45, 0.3),
        divisions: [4, 4, 2],
        ..Block::default()
    };
    let pull = step("pull")
        .hold("lower", "zmin")
        .displace("upper", "zmax", [0.01, 0.0, 0.02]);
    let run = written(tied(&[lower, upper]).step(pull), folder);
    let report = run.results().tie("glue").unwrap();
    // On a grid of parallelograms an inner node has the area of one, at edges half of it.
    let tractions = vectors(folder, "glue-upper", "traction");
    let [nx, ny] = [5, 5];
    let sum: Vec3 = tractions
        .iter()
        .enumerate()
        .map(|(at, traction)| {
            let half = |at: usize, n: usize| if at == 0 || at == n - 1 { 0.5 } else { 1.0 };
            traction * half(at % nx, nx) * half(at / nx, ny)
        })
        .sum();
    let force = sum * (0.4 * 0.45 / 16.0);
    let off = (force - report.sides[1].force).norm() / force.norm();
    // Facets are stretched by some per cent.
    assert!(off < 0.03, "{off}");
    let outside = vectors(folder, "glue-lower", "traction");
    let bare = outside.iter().filter(|traction| traction.norm() == 0.0);
    // Five by five nodes, of which the outermost ones meet nothing.
    assert_eq!((outside.len(), bare.count()), (25, 16));
}
