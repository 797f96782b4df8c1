//! Points opposite to nodes at the start of an increment, for collocated slip.

use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use crate::{
    configuration::Configuration,
    pair::Enforcement,
    side::Side,
    traction_basis::{KeptNode, TractionBasis},
};

/// Opposing material point at the start of the increment, for collocated slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Partner {
    /// On a deformable facet, as weights of its corners.
    Corners([SurfaceNode; 4], [f64; 4]),
    /// On a rigid surface, in its reference configuration.
    Rigid(Vec3),
}

impl Partner {
    /// Present position of the point, as seen from a node of `side`.
    pub fn point(&self, configuration: &Configuration, side: Side) -> Vec3 {
        match self {
            Partner::Rigid(point) => configuration.placement.point(point),
            Partner::Corners(corners, weights) => {
                let x = &configuration.side(side.opposite()).x;
                (0..4).map(|c| x[corners[c]] * weights[c]).sum()
            }
        }
    }
}

/// Points opposite to the kept nodes, where rows are collocated.
pub(crate) fn partners(
    configuration: &Configuration,
    basis: &TractionBasis,
) -> Vec<Option<Partner>> {
    if configuration.pair.enforcement == Enforcement::Weighted {
        return vec![None; basis.kept.len()];
    }
    let partner = |kept: &KeptNode| {
        let (contact, _) = configuration.opposite(kept.side, kept.node)?;
        match contact.place.weights(configuration, kept.side) {
            Some((corners, weights)) if !configuration.pair.is_rigid() => {
                Some(Partner::Corners(corners, weights))
            }
            _ => {
                let point = contact.place.point(configuration, kept.side);
                Some(Partner::Rigid(configuration.placement.back(&point)))
            }
        }
    };
    basis.kept.iter().map(partner).collect()
}
