//! Elements of lower dimension: the faces and nodes of a body that they mark.
//!
//! Those in a set make a set of facets (surface elements) or of nodes (lines and points) of its
//! name; all others are counted, and said to be left out.

use super::collected::{Collected, FileFace};
use super::{Place, division};

/// How many elements of lower dimension are in no set, by their dimension.
#[derive(Default)]
pub(super) struct Loose([usize; 3]);

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
        self.loose.0[dimension] += usize::from(is_loose);
    }
}

impl Loose {
    /// What there is to say.
    pub(super) fn note(&self) -> Option<String> {
        let [points, lines, surfaces] = self.0;
        let words = [
            (surfaces, "surface element"),
            (lines, "line"),
            (points, "point"),
        ];
        let words = words.into_iter().filter(|(count, _)| *count > 0);
        let words = words.map(|(count, one)| match count {
            1 => format!("1 {one}"),
            _ => format!("{count} {one}s"),
        });
        let words: Vec<String> = words.collect();
        let (last, others) = words.split_last()?;
        let all = match others.len() {
            0 => last.clone(),
            _ => format!("{} and {last}", others.join(", ")),
        };
        Some(format!("in no set and left out: {all}"))
    }
}
