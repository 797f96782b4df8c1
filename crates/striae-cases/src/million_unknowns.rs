//! `million-unknowns`: large bodies by the iterative solver, beside coarse meshes by direct ones.

use super::study::{Extent, Run, Study};
use crate::failure::Failure;

const DECKS: [(&str, &str); 1] = decks!("million-unknowns": "deck");
/// Elements along an edge of the lower block in the deck and for a quick look.
const FULL: usize = 68;
const QUICK: usize = 32;
/// Meshes that are solved directly.
const COARSE: [usize; 3] = [8, 16, 24];
const FORCES: [(&str, &str); 2] = [("normal", "z"), ("tangential", "x")];

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let mut coarse = Vec::new();
    for n in COARSE {
        coarse.push(mesh(study, n, "condensed")?);
    }
    let (n, fine) = match study.extent {
        Extent::Full => {
            let [(name, text)] = DECKS;
            let deck = study.deck(name, text)?;
            (FULL, study.run(name, deck)?)
        }
        Extent::Quick => (QUICK, mesh(study, QUICK, "iterative")?),
    };
    for (name, axis) in FORCES {
        let forces = [0, 1, 2].map(|k| force(&coarse[k], "a", axis));
        let expected = extrapolated(COARSE.map(|n| 1.0 / n as f64), forces, 1.0 / n as f64);
        study.measured(format!("{name}.ratio"), force(&fine, "a", axis) / expected);
    }
    let (normal, tangential) = (force(&fine, "a", "z"), force(&fine, "a", "x"));
    let missing = |axis| (force(&fine, "a", axis) + force(&fine, "b", axis)).abs();
    let mismatch = missing("x").max(missing("z"));
    study.measured("mismatch", mismatch / normal.abs());
    study.measured("friction", (tangential / normal).abs());
    Ok(())
}

/// The deck on a coarser mesh with a given solver.
fn mesh(study: &mut Study, n: usize, backend: &str) -> Result<Run, Failure> {
    let [(_, text)] = DECKS;
    let divisions = |n: usize, height: usize| format!("[{n}, {n}, {height}]");
    let solver = format!("[solver]\nbackend = \"{backend}\"");
    let passages = [
        ["[68, 68, 34]", &divisions(n, n / 2)],
        ["[67, 67, 34]", &divisions(n - 1, n / 2)],
        ["[solver]", &solver],
    ];
    let name = format!("mesh-{n}");
    let deck = study.variant(&name, text, &passages)?;
    study.run(&name, deck)
}

fn force(run: &Run, side: &str, axis: &str) -> f64 {
    run.at_end_of(1, &format!("pair.interface.resultant_{side}.{axis}"))
}

/// Value at `size` of `f + c size^p` through three points, sizes falling.
fn extrapolated(sizes: [f64; 3], values: [f64; 3], size: f64) -> f64 {
    let wanted = (values[0] - values[1]) / (values[1] - values[2]);
    let ratio = |p: f64| {
        let [a, b, c] = sizes.map(|h| h.powf(p));
        (a - b) / (b - c)
    };
    let (mut low, mut high) = (0.1, 6.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if ratio(middle) < wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    let [_, b, c] = sizes.map(|h| h.powf(low));
    let factor = (values[1] - values[2]) / (b - c);
    values[2] + factor * (size.powf(low) - c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_extrapolated_exactly() {
        let law = |h: f64| 3.0 - 0.7 * h.powf(1.4);
        let sizes = [0.125, 0.0625, 0.04];
        let found = extrapolated(sizes, sizes.map(law), 0.01);
        assert!((found - law(0.01)).abs() < 1e-12);
    }
}
