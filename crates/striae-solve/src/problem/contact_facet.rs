//! Faces of bodies that are facets of pairs.

use std::collections::HashMap;

use striae_contact::side::Side;
use striae_mesh::{Face, FacetId};

use striae_model::pair_geometry::PairGeometry;

/// A facet of a side of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ContactFacet {
    /// The pair.
    pub pair: usize,
    /// Its side.
    pub side: Side,
    /// The facet.
    pub facet: FacetId,
}

/// Contact facets that each face of each body is, of those whose element is here.
pub(super) fn contact_facets(pairs: &[PairGeometry]) -> HashMap<(usize, Face), Vec<ContactFacet>> {
    let mut facets: HashMap<_, Vec<_>> = HashMap::new();
    for (pair, geometry) in pairs.iter().enumerate() {
        for side in Side::BOTH {
            let Some(body) = geometry.bodies[side] else {
                continue;
            };
            for (at, face) in geometry.faces[side].iter().enumerate() {
                if let Some(face) = *face {
                    facets.entry((body, face)).or_default().push(ContactFacet {
                        pair,
                        side,
                        facet: FacetId::new(at),
                    });
                }
            }
        }
    }
    facets
}
