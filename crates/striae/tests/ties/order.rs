//! Convergence: a bent beam of two tied parts converges to that of one piece.

use striae::{mesh::generate::Block, prelude::*};

use super::scene::{Finished, rubber, run, tie};

fn part(origin: f64, length: f64, divisions: [usize; 3]) -> Mesh {
    let block = Block {
        origin: Vec3::new(origin, 0.0, 0.0),
        size: Vec3::new(length, 1.0, 1.0),
        divisions,
        ..Block::default()
    };
    block.mesh().unwrap()
}

fn bent(last: &str) -> striae::model::StepBuilder {
    step("bend")
        .increments(1)
        .hold(if last == "beam" { "beam" } else { "root" }, "xmin")
        .traction(last, "xmax", [0.0, 0.0, 1e3])
}

fn tip(run: &Finished, last: &str) -> f64 {
    let results = run.results();
    let mesh = results
        .problem
        .model
        .bodies
        .iter()
        .find(|body| body.name == last);
    let nodes = mesh.unwrap().mesh.node_sets.get("xmax").unwrap();
    let moved = results.displacements(last).unwrap();
    nodes.iter().map(|node| moved[node.index()].z).sum::<f64>() / nodes.len() as f64
}

fn two_parts(fineness: usize) -> f64 {
    let (coarse, fine) = (
        [2 * fineness, fineness, fineness],
        [3 * fineness, fineness + 1, fineness + 1],
    );
    let model = model("A tied beam")
        .body(body("root", part(0.0, 2.0, coarse), rubber()))
        .body(body("end", part(2.0, 2.0, fine), rubber()))
        .tie(tie(
            "joint",
            surface("root", "xmax"),
            surface("end", "xmin"),
        ))
        .step(bent("end"));
    tip(&run(model), "end")
}

fn one_piece(fineness: usize) -> f64 {
    let mesh = part(0.0, 4.0, [4 * fineness, fineness, fineness]);
    let model = model("A beam")
        .body(body("beam", mesh, rubber()))
        .step(bent("beam"));
    tip(&run(model), "beam")
}

#[test]
fn a_tied_beam_converges_as_one_of_one_piece() {
    // Extrapolated from 6 and 12 at the order of linear elements.
    let (coarse, fine) = (one_piece(6), one_piece(12));
    let exact = fine + (fine - coarse) / 3.0;
    let errors: Vec<f64> = [2, 4, 8]
        .into_iter()
        .map(|fineness| (two_parts(fineness) / exact - 1.0).abs())
        .collect();
    let rates: Vec<f64> = errors
        .windows(2)
        .map(|pair| (pair[0] / pair[1]).log2())
        .collect();
    assert!(
        rates.iter().all(|rate| *rate > 1.5),
        "{errors:.3?} {rates:.2?}"
    );
    assert!(errors[2] < 0.02, "{errors:.4?}");
    // One half is as fine as this beam, the other finer.
    let whole = (one_piece(4) / exact - 1.0).abs();
    assert!(errors[1] < whole, "{errors:.4?} {whole:.4}");
}
