//! Reference points: nodes that conditions name without being of a body.

use std::collections::HashMap;
use striae_mesh::Vec3;
use striae_meshfile::{InputFile, Keyword, Points};

/// Identity of a reference point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PointId {
    /// One of the assembly, by number.
    Assembly(u64),
    /// One of the parts or of a file without parts, by number.
    Part(u64),
}

/// A node with its place.
pub(super) type Point = (PointId, Vec3);

/// All nodes that may be reference points.
pub(super) struct ReferencePoints {
    of_parts: Points,
    /// Nodes of the assembly.
    own: HashMap<u64, Vec3>,
    /// Nodes alone in a set of the assembly, by its label in capitals.
    sets: HashMap<String, u64>,
}

impl ReferencePoints {
    pub(super) fn new(input: &InputFile, keywords: &[Keyword<'_>]) -> Self {
        let (mut own, mut sets) = (HashMap::new(), HashMap::<String, Vec<u64>>::new());
        let mut is_in_assembly = false;
        for keyword in keywords {
            match keyword.name.as_str() {
                "ASSEMBLY" | "END INSTANCE" => is_in_assembly = true,
                "INSTANCE" | "END ASSEMBLY" => is_in_assembly = false,
                "NODE" if is_in_assembly => {
                    for row in &keyword.rows {
                        let Ok(number) = row.words[0].parse::<u64>() else {
                            continue;
                        };
                        let at = |axis: usize| {
                            let word = row.words.get(axis).copied().unwrap_or_default();
                            striae_meshfile::finite(word).unwrap_or(0.0)
                        };
                        own.insert(number, Vec3::new(at(1), at(2), at(3)));
                        if let Some(set) = keyword.parameter("NSET") {
                            sets.entry(set.to_uppercase()).or_default().push(number);
                        }
                    }
                }
                "NSET" if is_in_assembly && keyword.parameter("INSTANCE").is_none() => {
                    let Some(label) = keyword.parameter("NSET") else {
                        continue;
                    };
                    for word in keyword.rows.iter().flat_map(|row| &row.words) {
                        if let Ok(number) = word.parse::<u64>() {
                            sets.entry(label.to_uppercase()).or_default().push(number);
                        }
                    }
                }
                _ => {}
            }
        }
        let single = sets.into_iter();
        let single = single.filter_map(|(label, members)| match members[..] {
            [number] => Some((label, number)),
            _ => None,
        });
        Self {
            of_parts: input.points(),
            own,
            sets: single.collect(),
        }
    }

    /// The node that a word stands for.
    pub(super) fn find(&self, word: &str) -> Option<Point> {
        let number = self.sets.get(&word.to_uppercase()).copied();
        let number = number.or_else(|| word.parse().ok());
        let own = number.and_then(|number| {
            let place = self.own.get(&number)?;
            Some((PointId::Assembly(number), *place))
        });
        own.or_else(|| {
            let (number, place) = self.of_parts.find(word)?;
            Some((PointId::Part(number), place))
        })
    }
}
