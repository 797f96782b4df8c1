//! Sections of bodies: no element in two of them, and none without a material.

use std::collections::HashMap;

use crate::{fault::FaultKind, model::BodySection, path::Path};
use striae_mesh::ElementId;

use super::{Draft, List};

impl FaultKind {
    /// The fault that a body without a material of its own has elements, of so many, in
    /// no section.
    pub fn no_material(body: &str, elements: usize, sections: &[BodySection]) -> Option<Self> {
        let mut has_one = vec![false; elements];
        for element in sections.iter().flat_map(|section| &section.elements) {
            has_one[element.index()] = true;
        }
        let first = has_one.iter().position(|has_one| !has_one)?;
        Some(Self::NoMaterial {
            body: body.to_owned(),
            count: has_one.iter().filter(|has_one| !**has_one).count(),
            element: ElementId::new(first),
        })
    }
}

/// Notes every section with elements of an earlier one.
pub(super) fn check(draft: &Draft<'_>, faults: &mut List) {
    for (index, body) in draft.bodies.iter().enumerate() {
        let mut owner = HashMap::new();
        for (number, section) in body.sections.iter().enumerate() {
            let mut elements = section.elements.iter();
            let taken = elements.find(|element| owner.contains_key(*element));
            if let Some(element) = taken {
                let first: usize = owner[element];
                let kind = FaultKind::TwoSections {
                    body: body.name.to_owned(),
                    element: *element,
                    first: body.sections[first].set.clone(),
                    second: section.set.clone(),
                };
                let path = Path::part("bodies", index);
                faults.push(path.field("sections").index(number), kind);
            }
            let elements = section.elements.iter();
            owner.extend(elements.map(|element| (*element, number)));
        }
    }
}
