//! Facets of rigid surfaces that have no area, and neighbours that look to opposite sides.
//!
//! Facets go counter-clockwise as seen from outside, so the two at an edge go along it in
//! opposite directions. Edges of more than two facets say nothing.

use std::collections::BTreeMap;

use crate::{fault::FaultKind, model::RigidShape, path::Path};
use striae_mesh::{NodeId, Vec3};

use super::{Draft, List};

/// Ratio of the area to the square of the longest diagonal below which it counts as zero.
const FLAT: f64 = 1e-12;

/// Notes the first such facets of every rigid surface.
pub(super) fn check(draft: &Draft<'_>, faults: &mut List) {
    for (index, rigid) in draft.rigid_surfaces.iter().enumerate() {
        let Some(RigidShape::Facets { positions, facets }) = rigid.part.map(|part| &part.shape)
        else {
            continue;
        };
        let path = Path::part("rigid_surfaces", index).field("shape");
        let rigid = || rigid.name.to_owned();
        let named = |facet: &[NodeId; 4]| facet.iter().all(|node| node.index() < positions.len());
        if !facets.iter().all(named) {
            continue;
        }
        let flat = facets.iter().position(|facet| is_flat(positions, facet));
        if let Some(facet) = flat {
            let at = positions[facets[facet][0].index()];
            let rigid = rigid();
            let kind = FaultKind::FlatFacet { rigid, facet, at };
            faults.push(path, kind);
        } else if let Some((first, second, [from, to])) = turned(facets) {
            let kind = FaultKind::TurnedFacet {
                rigid: rigid(),
                first,
                second,
                ends: [positions[from.index()], positions[to.index()]],
            };
            faults.push(path, kind);
        }
    }
}

/// True where a facet has no area, or none that is a number.
fn is_flat(positions: &[Vec3], facet: &[NodeId; 4]) -> bool {
    let [a, b, c, d] = facet.map(|node| positions[node.index()]);
    let diagonals = [c - a, d - b];
    // A triangle repeats its last corner.
    let longest = [b - a, c - b, diagonals[0], diagonals[1]];
    let longest = longest.iter().map(Vec3::norm).fold(0.0, f64::max);
    let unit = diagonals.map(|diagonal| diagonal / longest);
    let area = unit[0].cross(&unit[1]).norm();
    area.is_nan() || area <= FLAT
}

/// Two facets that go the same way along their common edge, and its ends.
fn turned(facets: &[[NodeId; 4]]) -> Option<(usize, usize, [NodeId; 2])> {
    let mut edges: BTreeMap<[NodeId; 2], Vec<(usize, bool)>> = BTreeMap::new();
    for (index, facet) in facets.iter().enumerate() {
        for corner in 0..4 {
            let [from, to] = [facet[corner], facet[(corner + 1) % 4]];
            if from != to {
                let ends = [from.min(to), from.max(to)];
                edges.entry(ends).or_default().push((index, from < to));
            }
        }
    }
    let same = edges.iter().filter_map(|(ends, of)| match of[..] {
        [(first, way), (second, other)] if way == other => Some((first, second, *ends)),
        _ => None,
    });
    same.min_by_key(|(first, second, _)| (*first, *second))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facets(facets: &[[usize; 4]]) -> Vec<[NodeId; 4]> {
        let facets = facets.iter();
        facets.map(|facet| facet.map(NodeId::new)).collect()
    }

    #[test]
    fn neighbours_go_opposite_ways_along_their_edge() {
        let right = facets(&[[0, 1, 4, 3], [1, 2, 5, 4]]);
        assert_eq!(turned(&right), None);
        let wrong = facets(&[[0, 1, 4, 3], [1, 4, 5, 2]]);
        let ends = [NodeId::new(1), NodeId::new(4)];
        assert_eq!(turned(&wrong), Some((0, 1, ends)));
        // A fan of three facets at an edge has no outside.
        let fan = facets(&[[0, 1, 2, 2], [0, 1, 3, 3], [1, 0, 4, 4]]);
        assert_eq!(turned(&fan), None);
        let triangles = facets(&[[0, 1, 2, 2], [0, 2, 3, 3]]);
        assert_eq!(turned(&triangles), None);
    }

    #[test]
    fn facets_on_a_line_have_no_area() {
        let at = |x: [f64; 3]| Vec3::from(x);
        let square = [
            [0.0; 3],
            [1e-9, 0.0, 0.0],
            [1e-9, 1e-9, 0.0],
            [0.0, 1e-9, 0.0],
        ]
        .map(at);
        let all = [0, 1, 2, 3].map(NodeId::new);
        assert!(!is_flat(&square, &all));
        assert!(!is_flat(&square, &[0, 1, 2, 2].map(NodeId::new)));
        let line = [0.0, 1.0, 2.0, 3.0].map(|x| at([x, 2.0 * x, 0.0]));
        assert!(is_flat(&line, &all));
        assert!(is_flat(&[at([1.0; 3]); 4], &all));
        assert!(is_flat(&[at([f64::NAN; 3]); 4], &all));
    }
}
