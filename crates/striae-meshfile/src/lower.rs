//! Elements of lower dimension: the faces and nodes of a body that they mark.
//!
//! Elements in a set become a set of facets (surface elements) or of nodes (lines and points) of
//! its name; all others are counted and reported as left out.

use super::collected::{Collected, FileFace};
use super::{Place, division};

/// The faces that a surface element is on a body, none for a number of nodes that no such
/// element has.
pub(super) fn faces(nodes: &[u64]) -> Vec<FileFace> {
    let facets = match *nodes {
        [a, b, c] => vec![[a, b, c, c]],
        [a, b, c, d] => vec![[a, b, c, d]],
        [a, b, c, ab, bc, ca] => division::in_triangles([a, b, c], [ab, bc, ca]),
        [a, b, c, d, ab, bc, cd, da] => {
            return vec![FileFace::Eight([a, b, c, d], [ab, bc, cd, da])];
        }
        [a, b, c, d, ab, bc, cd, da, middle] => {
            division::quartered([a, b, c, d], [ab, bc, cd, da], middle)
        }
        _ => Vec::new(),
    };
    facets.into_iter().map(FileFace::Corners).collect()
}

impl Collected {
    /// Adds an element of lower dimension to the sets it is in.
    pub(super) fn add_lower(
        &mut self,
        dimension: usize,
        place: Place,
        nodes: &[u64],
        sets: impl IntoIterator<Item = String>,
    ) {
        let faces = if dimension == 2 {
            faces(nodes)
        } else {
            Vec::new()
        };
        let mut is_loose = true;
        for name in sets {
            is_loose = false;
            if dimension == 2 {
                let set = self.facet_sets.entry(name).or_default();
                set.extend(faces.iter().map(|face| (place, *face)));
            } else {
                let set = self.node_sets.entry(name).or_default();
                set.extend(nodes.iter().map(|&node| (place, node)));
            }
        }
        self.loose.count(dimension, usize::from(is_loose));
    }
}
