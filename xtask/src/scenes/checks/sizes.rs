//! Sizes of facets on contact surfaces.

use std::collections::HashMap;

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

/// Size of the facets at every node, of the face with the largest ones where faces with nodes of
/// their own meet: the face that is pressed is not known, and the annulus at the end of a tube is
/// finer than the tube.
pub fn sizes_at_places(grid: &Grid) -> Vec<f64> {
    let sizes = sizes(grid);
    let place = |node: usize| grid.points[node].map(f64::to_bits);
    let mut largest: HashMap<[u64; 3], f64> = HashMap::new();
    for (node, size) in sizes.iter().enumerate() {
        let known = largest.entry(place(node)).or_insert(*size);
        *known = known.max(*size);
    }
    (0..sizes.len()).map(|node| largest[&place(node)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_at_one_place_have_the_size_of_the_larger_facets() {
        let (a, b) = ([0.0; 3], [1.0, 0.0, 0.0]);
        let points = vec![a, b, [1.0, 1.0, 0.0], a, b, [1.0, 0.0, 0.25]];
        let mut grid = Grid::default();
        grid.points = points;
        grid.cells = vec![vec![0, 1, 2], vec![3, 4, 5]];
        let [large, small] = [0.5_f64.sqrt(), 0.125_f64.sqrt()];
        assert_eq!(
            sizes_at_places(&grid),
            [large, large, large, large, large, small]
        );
    }
}
