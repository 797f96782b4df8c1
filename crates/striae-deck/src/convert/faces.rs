//! Faces of elements with pressures of `*DLOAD`, as facet sets of bodies.
//!
//! Faces with the same loads in all steps form a set, so that a later step changes what an earlier
//! one has stated.

use super::{Model, numbers};
use std::collections::{BTreeMap, BTreeSet, HashSet};
use striae_mesh::Face;
use striae_meshfile::Row;

/// A pressure of `*DLOAD`: the line of its keyword, its value, and how many equal ones the keyword
/// states for the face before.
type Statement = (usize, u64, usize);

/// Facet sets by the rows that load them.
#[derive(Default)]
pub(super) struct LoadedFaces {
    /// Bodies by place with facet sets, by the line of the row; none where another row with the
    /// same value speaks for it.
    by_row: BTreeMap<usize, Vec<(usize, String)>>,
    /// Lines of the rows of which some faces lie between elements.
    inner: BTreeSet<usize>,
}

impl LoadedFaces {
    /// Bodies by place with the facet sets that a row loads; `None` where it is on no body.
    pub(super) fn of(&self, row: usize) -> Option<Vec<(usize, String)>> {
        self.by_row.get(&row).cloned()
    }

    /// Returns whether some faces of a row lie between elements, and others outside.
    pub(super) fn has_inner(&self, row: usize) -> bool {
        self.inner.contains(&row) && self.by_row.contains_key(&row)
    }
}

/// The side of a load such as `P5`, from 0.
pub(super) fn side(kind: &str) -> Option<u8> {
    let number: u8 = kind.strip_prefix(['P', 'p'])?.parse().ok()?;
    (1..=6).contains(&number).then(|| number - 1)
}

fn value(row: &Row<'_>) -> Option<(u8, f64)> {
    let side = side(row.words.get(1)?)?;
    let value = numbers(row.words.get(2..3)?)?;
    Some((side, value[0]))
}

impl Model<'_> {
    /// Puts loaded faces into sets.
    pub(super) fn read_loaded_faces(&mut self) {
        let keywords = self.keywords;
        let loads = keywords.iter().filter(|keyword| keyword.name == "DLOAD");
        let rows = loads.flat_map(|keyword| keyword.rows.iter().map(|row| (keyword.line, row)));
        let rows: Vec<(usize, &Row<'_>)> = rows.filter(|(_, row)| value(row).is_some()).collect();
        if rows.is_empty() {
            return;
        }
        let mut first: BTreeMap<Statement, usize> = BTreeMap::new();
        for at in 0..self.bodies.len() {
            let body = &self.bodies[at];
            let mesh = &body.reading.mesh;
            let outside: HashSet<Face> = mesh.boundary_faces().into_iter().collect();
            let mut statements: BTreeMap<Face, BTreeSet<Statement>> = BTreeMap::new();
            for (keyword, row) in &rows {
                let Some((side, value)) = value(row) else {
                    continue;
                };
                if !self.bodies_named(row.words[0]).contains(&at) {
                    continue;
                }
                for element in body.elements_of(row.words[0]) {
                    let sides = mesh.kind(element).faces_of_side(side);
                    let faces = sides.map(|side| Face { element, side });
                    for face in faces {
                        if !outside.contains(&face) {
                            self.loaded_faces.inner.insert(row.line);
                            continue;
                        }
                        let stated = statements.entry(face).or_default();
                        let mut statement = (*keyword, value.to_bits(), 0);
                        while !stated.insert(statement) {
                            statement.2 += 1;
                        }
                        first.entry(statement).or_insert(row.line);
                        self.loaded_faces.by_row.entry(row.line).or_default();
                    }
                }
            }
            let mut classes: BTreeMap<BTreeSet<Statement>, Vec<Face>> = BTreeMap::new();
            for (face, of) in statements {
                classes.entry(of).or_default().push(face);
            }
            for (of, faces) in classes {
                let set = self.bodies[at].set_of_faces(faces);
                for statement in of {
                    let row = first[&statement];
                    let sets = self.loaded_faces.by_row.entry(row).or_default();
                    sets.push((at, set.clone()));
                }
            }
        }
    }
}
