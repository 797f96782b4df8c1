//! Overlap of a slice with itself, found without contact: nodes inside elements of others.

use striae_mesh::Vec3;

use super::study::Run;

/// Largest depth of a node of the outline of the first body in elements that it is no corner of.
///
/// The body is a slice of one element; `front` tells by their place at rest which of its nodes are
/// seen, and `plane` gives the coordinates in which they are.
pub fn depth(run: &Run, front: impl Fn(&Vec3) -> bool, plane: impl Fn(&Vec3) -> [f64; 2]) -> f64 {
    let (problem, state) = (&run.finished.problem, &run.finished.state);
    let mesh = &problem.model.bodies[0].mesh;
    let places: Vec<[f64; 2]> = state.positions.iter().map(plane).collect();
    let cells = mesh.elements().map(|corners| {
        let seen = corners
            .iter()
            .map(|node| node.index())
            .filter(|&node| front(&mesh.positions[node]));
        around(seen.collect(), &places)
    });
    deepest(&cells.collect::<Vec<_>>(), &places)
}

/// Corners in the order of their directions from the middle.
fn around(mut cell: Vec<usize>, places: &[[f64; 2]]) -> Vec<usize> {
    let mean =
        |axis: usize| cell.iter().map(|&node| places[node][axis]).sum::<f64>() / cell.len() as f64;
    let middle = [mean(0), mean(1)];
    let direction = |node: usize| {
        let [x, y] = [0, 1].map(|axis| places[node][axis] - middle[axis]);
        y.atan2(x)
    };
    cell.sort_by(|&one, &other| direction(one).total_cmp(&direction(other)));
    cell
}

fn deepest(cells: &[Vec<usize>], places: &[[f64; 2]]) -> f64 {
    let all: Vec<[usize; 2]> = cells.iter().flat_map(|cell| edges(cell)).collect();
    let free = |[from, to]: &[usize; 2]| !all.contains(&[*to, *from]);
    let outline: Vec<[usize; 2]> = all.iter().copied().filter(free).collect();
    let mut deepest = 0.0_f64;
    for &[node, _] in &outline {
        let place = places[node];
        let within = |cell: &Vec<usize>| {
            !cell.contains(&node)
                && edges(cell).all(|[from, to]| side(places[from], places[to], place) > 0.0)
        };
        if cells.iter().any(within) {
            let others = outline.iter().filter(|edge| !edge.contains(&node));
            let distances = others.map(|edge| distance(edge.map(|node| places[node]), place));
            deepest = deepest.max(distances.fold(f64::INFINITY, f64::min));
        }
    }
    deepest
}

/// Edges of a cell, counter-clockwise.
fn edges(cell: &[usize]) -> impl Iterator<Item = [usize; 2]> + '_ {
    (0..cell.len()).map(|at| [cell[at], cell[(at + 1) % cell.len()]])
}

/// Positive to the left of a line.
fn side(from: [f64; 2], to: [f64; 2], place: [f64; 2]) -> f64 {
    (to[0] - from[0]) * (place[1] - from[1]) - (to[1] - from[1]) * (place[0] - from[0])
}

fn distance([from, to]: [[f64; 2]; 2], place: [f64; 2]) -> f64 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let away = [place[0] - from[0], place[1] - from[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    let share = ((along[0] * away[0] + along[1] * away[1]) / square).clamp(0.0, 1.0);
    (away[0] - share * along[0]).hypot(away[1] - share * along[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_corner_in_another_square_is_found() {
        let places = [
            [0.0, 0.0],
            [1.0, 0.0],
            [1.0, 1.0],
            [0.0, 1.0],
            [0.9, 0.5],
            [2.0, 0.5],
            [2.0, 2.0],
            [0.9, 2.0],
        ];
        let cells = [vec![0, 1, 3, 2], vec![4, 5, 6, 7]].map(|cell| around(cell, &places));
        assert!((deepest(&cells, &places) - 0.1).abs() < 1e-15);
        assert_eq!(deepest(&cells[..1], &places), 0.0);
    }
}
