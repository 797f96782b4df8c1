//! Part of each facet that a tie would glue.

use striae_contact::{configuration::Configuration, placement::Placement, side::Side, tie::join};
use striae_mesh::{Face, Mesh, Vec3};
use striae_surface::topology::Surface;

use super::surfaces::contact_pair;

/// Parts of the facets of two surfaces that a tie within a distance glues, from 0 to 1, in the
/// order of the facets.
pub fn covered(sides: [(&Mesh, &[Face]); 2], within: Option<f64>) -> [Vec<f64>; 2] {
    let pair = contact_pair(sides, within);
    let positions = Side::BOTH.map(|side| {
        let nodes = pair.sides[side].surface().map_or(&[][..], Surface::nodes);
        let mesh = sides[side.index()].0;
        let places = nodes.iter().map(|node| mesh.positions[node.index()]);
        places.collect::<Vec<Vec3>>()
    });
    let configuration = Configuration::new(&pair, positions, Placement::at_rest());
    join(&configuration, within)
        .cover
        .map(|facets| facets.into_iter().map(|part| part.min(1.0)).collect())
}
