//! Reports of large results: size and time.

use std::{
    path::Path,
    time::{Duration, Instant},
};

use nalgebra::Matrix3;
use striae_mesh::{NodeId, Vec3, generate::Block};
use striae_output::vtk::{Array, Cells, Grid, Series, Snapshot, Values, write};
use striae_report::LIMIT;

/// Increments of the results.
const INCREMENTS: usize = 100;

/// Motion of a point: travelling waves, bending, and a small part that is unique to the point.
fn moved(x: &Vec3, node: usize, time: f64) -> Vec3 {
    let noise = |seed: f64| (f64::from(node as u32) * 12.9898 + seed + 7.0 * time).sin() * 1e-4;
    let wave = (7.0 * x.x + 3.0 * x.y - 5.0 * time).sin();
    Vec3::new(
        0.1 * time * x.z * x.z + noise(1.0),
        0.02 * wave * x.z + noise(2.0),
        -0.05 * time * x.z + 0.01 * wave + noise(3.0),
    )
}

fn stress(u: &Vec3, x: &Vec3, time: f64) -> Matrix3<f64> {
    let a = Matrix3::from_fn(|i, j| (u[i] * 40.0 + x[j] * 3.0 + time).sin() * (1.0 + x[i] * time));
    (a + a.transpose()) * 1e5
}

/// Writes results of a block with so many elements an edge, and its side in contact.
fn results(folder: &Path, divisions: [usize; 3]) -> usize {
    std::fs::create_dir_all(folder.join("fields")).unwrap();
    let mesh = Block {
        divisions,
        ..Block::default()
    }
    .mesh()
    .unwrap();
    let side: Vec<usize> = (0..mesh.positions.len())
        .filter(|n| mesh.positions[*n].z == 0.0)
        .collect();
    let row = divisions[0] + 1;
    let quads: Vec<[NodeId; 4]> = (0..divisions[1])
        .flat_map(|j| (0..divisions[0]).map(move |i| j * row + i))
        .map(|first| [first, first + 1, first + row + 1, first + row].map(NodeId::new))
        .collect();
    let mut bodies = Series::new(folder.join("bodies.pvd"));
    let mut contact = Series::new(folder.join("contact.pvd"));
    for count in 0..=INCREMENTS {
        let time = count as f64 / INCREMENTS as f64;
        let rest = mesh.positions.iter();
        let u: Vec<Vec3> = rest
            .clone()
            .enumerate()
            .map(|(node, x)| moved(x, node, time))
            .collect();
        let stresses = u
            .iter()
            .zip(rest.clone())
            .map(|(u, x)| stress(u, x, time))
            .collect();
        let points: Vec<Vec3> = rest.zip(&u).map(|(x, u)| x + u).collect();
        let below: Vec<Vec3> = side.iter().map(|node| points[*node]).collect();
        let vectors = |f: f64| Values::Vectors(below.iter().map(|x| x * f * time).collect());
        let scalars =
            |f: f64| Values::Scalars(below.iter().map(|x| (f * x.x * x.y).sin() * time).collect());
        for (name, points, cells, point_arrays, series) in [
            (
                "block",
                &points,
                Cells::Blocks(&mesh.blocks),
                vec![
                    Array::new("displacement", Values::Vectors(u.clone())),
                    Array::new("cauchy_stress", Values::SymmetricTensors(stresses)),
                ],
                &mut bodies,
            ),
            (
                "sole-block",
                &below,
                Cells::Quadrilaterals(&quads),
                vec![
                    Array::new("gap", scalars(3.0)),
                    Array::new("pressure", scalars(5.0)),
                    Array::new("mean_pressure", scalars(5.1)),
                    Array::new("traction", vectors(1.0)),
                    Array::new("friction_traction", vectors(2.0)),
                    Array::new("slip", vectors(3.0)),
                    Array::new("texture", vectors(4.0)),
                ],
                &mut contact,
            ),
        ] {
            let file = format!("fields/{name}-{count:05}.vtu");
            let grid = Grid {
                points,
                cells,
                point_arrays,
                cell_arrays: vec![],
                time,
            };
            write(&folder.join(&file), &grid).unwrap();
            let parts = vec![(name.to_owned(), file.into())];
            series.append(Snapshot { time, parts }).unwrap();
        }
    }
    mesh.positions.len()
}

fn measured(divisions: [usize; 3]) -> (usize, usize, Duration) {
    let folder = tempfile::tempdir().unwrap();
    let nodes = results(folder.path(), divisions);
    let started = Instant::now();
    let page = striae_report::render(folder.path()).unwrap();
    let times = page
        .split_once("\"times\":[")
        .unwrap()
        .1
        .split_once(']')
        .unwrap()
        .0;
    let times = times.split(',').count();
    println!(
        "{nodes} nodes: {} bytes, {times} times, {:?}",
        page.len(),
        started.elapsed()
    );
    assert!(page.len() <= LIMIT);
    (nodes, times, started.elapsed())
}

/// 100 increments of 50 000 nodes take at most 25 MB and 10 s.
#[test]
#[ignore = "takes a minute, most of it to make the results"]
fn a_hundred_increments_of_fifty_thousand_nodes_stay_small() {
    let (nodes, times, taken) = measured([36, 36, 36]);
    assert!(nodes > 50_000);
    assert_eq!(times, INCREMENTS + 1, "all times are there");
    assert!(taken < Duration::from_secs(10), "{taken:?}");
}

/// All nodes are on the surface, so some times are left out.
#[test]
#[ignore = "takes a minute, most of it to make the results"]
fn plates_of_fifty_thousand_nodes_stay_small() {
    let (nodes, times, taken) = measured([160, 155, 1]);
    assert!(nodes > 50_000);
    assert!(times > INCREMENTS / 8, "{times} times");
    assert!(taken < Duration::from_secs(20), "{taken:?}");
}
