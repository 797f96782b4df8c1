//! Sizes of facets on contact surfaces.

use crate::scenes::{geometry::area, vtu::Grid};

/// Size of the facets at every node: the root of their mean area.
pub fn sizes(grid: &Grid) -> Vec<f64> {
    let mut sums = vec![(0.0, 0.0); grid.points.len()];
    for (index, cell) in grid.cells.iter().enumerate() {
        let area = area(&grid.corners(index));
        for &node in cell {
            sums[node].0 += area;
            sums[node].1 += 1.0;
        }
    }
    sums.into_iter()
        .map(|(area, count)| (area / count).sqrt())
        .collect()
}
