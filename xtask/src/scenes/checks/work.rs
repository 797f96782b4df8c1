//! Work of friction at every node with an own row.
//!
//! The fields have tractions and slips at nodes; those of such a node are the ones that its rows
//! state, so `tau . du <= 0`. They have the slip without what the ramp of weak nodes adds, by which
//! such a node slips to and fro like a spring while it sticks: by some thousandths of a facet.

use crate::scenes::{vector::dot, vtu::Grid};

use super::{Findings, sizes::sizes};

/// Work per area that friction may give to a node in an increment, over the largest pressure times
/// the size of a facet: at one that slips, and at one that sticks.
const WORK: [f64; 2] = [1e-4, 2e-3];
/// Code of nodes that stick.
const STICKS: f64 = 1.0;

/// Checks the nodes that are kept, under pressures up to the largest.
pub fn check(
    findings: &mut Findings,
    grid: &Grid,
    kept: &dyn Fn(usize) -> bool,
    largest: f64,
    place: &dyn Fn(usize, String) -> String,
) {
    let (Some(friction), Some(slip)) = (grid.vectors("friction_traction"), grid.vectors("slip"))
    else {
        return;
    };
    let status = grid.scalars("status");
    let size = sizes(grid);
    for node in (0..grid.points.len()).filter(|&node| kept(node)) {
        let gained = dot(friction[node], slip[node]) / (largest * size[node]);
        let sticks = status.is_some_and(|status| status[node] == STICKS);
        findings.note("work", gained / WORK[usize::from(sticks)], || {
            place(
                node,
                format!("friction gives {gained:.2e} of pressure times facet"),
            )
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The measure of a unit square with friction of 0.3 along `x` under a pressure of 1.
    fn measure(slip: f64, status: f64) -> f64 {
        let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let grid = Grid::plain(points, vec![vec![0, 1, 2, 3]])
            .with("friction_traction", 3, [0.3, 0.0, 0.0].repeat(4))
            .with("slip", 3, [slip, 0.1, 0.0].repeat(4))
            .with("status", 1, vec![status; 4]);
        let mut findings = Findings::default();
        check(&mut findings, &grid, &|_| true, 1.0, &|_, what| what);
        findings.worst["work"].measure
    }

    #[test]
    fn friction_along_slip_gives_work() {
        assert!(measure(-0.5, 2.0) <= 0.0);
        assert!((measure(1e-3, 2.0) - 3.0).abs() < 1e-9);
        assert!((measure(1e-3, STICKS) - 0.15).abs() < 1e-9);
    }
}
