//! The two surfaces of a tie, and reasons why they do not meet.

use striae_contact::{
    configuration::Configuration,
    pair::{ContactPair, Enforcement, Geometry, PairedSurface},
    side::Side,
    tie::Joined,
};
use striae_mesh::{Face, Mesh};
use striae_surface::topology::Surface;

use super::TieFault;
use crate::model::Model;

/// Two surfaces as those of a pair.
pub(super) fn contact_pair(sides: [(&Mesh, &[Face]); 2], within: Option<f64>) -> ContactPair {
    let sides = sides.map(|(mesh, faces)| {
        let facets: Vec<_> = faces.iter().map(|face| mesh.face_nodes(*face)).collect();
        PairedSurface {
            geometry: Geometry::Deformable(Surface::new(&facets)),
            behind: Vec::new(),
            enclosure: None,
            stiffness: 1.0,
            texture: None,
        }
    });
    ContactPair {
        name: String::new(),
        sides,
        enforcement: Enforcement::Weighted,
        search_distance: within,
        has_faces: false,
        one_body: false,
        wear: [0.0; 2],
        wear_across: 1.0,
    }
}

/// Reason why surfaces do not meet, if they do not.
pub(super) fn unmet(
    model: &Model,
    tie: &str,
    bodies: [usize; 2],
    configuration: &Configuration,
    joined: &Joined,
) -> Result<(), TieFault> {
    let (tie, [a, b]) = (
        tie.to_owned(),
        bodies.map(|body| model.bodies[body].name.clone()),
    );
    if let Some(apart) = joined.apart {
        return Err(TieFault::Apart {
            tie,
            a,
            b,
            gap: apart.gap,
            share: apart.share,
            at: apart.place,
        });
    }
    if joined.is_empty() {
        let distance = distance(configuration);
        return Err(TieFault::Nothing {
            tie,
            a,
            b,
            distance,
        });
    }
    Ok(())
}

/// Distance of the nearest nodes of both sides.
fn distance(configuration: &Configuration) -> f64 {
    let nodes = Side::BOTH.map(|side| &configuration.side(side).x);
    let distances = nodes[0].iter().map(|x| {
        let others = nodes[1].iter().map(|y| (x - y).norm());
        others.fold(f64::INFINITY, f64::min)
    });
    distances.fold(f64::INFINITY, f64::min)
}
