//! Atoms: facets of one owner that all statements name alike.

use std::collections::BTreeMap;

use striae_mesh::Face;

use super::label::{Owner, Part};

/// Facets of a body that no statement distinguishes, or a rigid surface.
#[derive(Clone, Debug)]
pub(super) struct Atom {
    /// Their owner.
    pub(super) owner: Owner,
    /// The facets, ascending; none of a rigid surface.
    pub(super) faces: Vec<Face>,
}

impl Atom {
    /// Returns whether all of it is in a part, which it is if any of it is.
    pub(super) fn is_in(&self, part: &Part) -> bool {
        self.owner == part.owner
            && match (&part.faces, self.faces.first()) {
                (Some(faces), Some(first)) => faces.binary_search(first).is_ok(),
                (Some(_), None) => false,
                (None, _) => true,
            }
    }

    /// Returns whether it is of a rigid surface.
    pub(super) fn is_rigid(&self) -> bool {
        matches!(self.owner, Owner::Rigid(_))
    }
}

/// The skin of a body in classes of facets that lie in the same parts.
pub(super) fn classes(body: usize, skin: &[Face], parts: &[&Part]) -> Vec<Atom> {
    let owner = Owner::Body(body);
    let mut class = vec![0_usize; skin.len()];
    for part in parts.iter().filter(|part| part.owner == owner) {
        let Some(faces) = &part.faces else { continue };
        let mut refined = BTreeMap::new();
        for (class, face) in class.iter_mut().zip(skin) {
            let next = refined.len();
            let key = (*class, faces.binary_search(face).is_ok());
            *class = *refined.entry(key).or_insert(next);
        }
    }
    let mut atoms: BTreeMap<usize, Vec<Face>> = BTreeMap::new();
    for (class, face) in class.into_iter().zip(skin) {
        atoms.entry(class).or_default().push(*face);
    }
    let atoms = atoms.into_values();
    atoms.map(|faces| Atom { owner, faces }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use striae_mesh::ElementId;

    #[test]
    fn facets_are_told_apart_by_the_parts_they_lie_in() {
        let face = |element| Face {
            element: ElementId::new(element),
            side: 0,
        };
        let part = |faces: &[usize]| Part {
            label: String::new(),
            owner: Owner::Body(1),
            faces: Some(faces.iter().map(|&at| face(at)).collect()),
        };
        let skin: Vec<Face> = (0..6).map(face).collect();
        let (first, second) = (part(&[1, 2, 3]), part(&[3, 4]));
        let atoms = classes(1, &skin, &[&first, &second]);
        let mut found: Vec<Vec<usize>> = atoms
            .iter()
            .map(|atom| atom.faces.iter().map(|face| face.element.index()).collect())
            .collect();
        found.sort();
        assert_eq!(found, [vec![0, 5], vec![1, 2], vec![3], vec![4]]);
        for atom in &atoms {
            let inside = atom
                .faces
                .iter()
                .all(|face| [1, 2, 3].contains(&face.element.index()));
            assert_eq!(atom.is_in(&first), inside);
        }
        assert_eq!(classes(0, &skin, &[&first, &second]).len(), 1);
    }
}
