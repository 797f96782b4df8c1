//! Nodes and facets of a side as the choice of roles sees them.

use striae_mesh::{FacetId, Vec3};
use striae_surface::{facet::Shape, node::SurfaceNode};

use super::Kept;
use crate::{
    configuration::Configuration,
    interface::{FacetMass, InterfaceNode, LastIncrement},
    segment::{Derivatives, FACING, Facet, plane_segment},
    side::Side,
};

/// The nodes of a deformable side.
pub(super) fn surface_nodes(
    configuration: &Configuration,
    side: Side,
    before: &Kept,
    prescribed: &[bool],
) -> Vec<InterfaceNode> {
    let Some(snapshot) = &configuration.sides[side] else {
        return Vec::new();
    };
    if side == Side::B && configuration.pair.is_rigid() {
        return Vec::new();
    }
    let modulus = configuration.pair.sides[side].stiffness;
    let nodes = snapshot.x.iter().zip(&snapshot.sizes).enumerate();
    nodes
        .map(|(node, (position, size))| {
            let components = prescribed.get(3 * node..3 * node + 3);
            let yields = components.is_none_or(|components| components.contains(&false));
            let share = f64::from(u8::from(yields));
            InterfaceNode {
                position: *position,
                flexibility: share * size / modulus,
                compliance: share / (modulus * size),
                last: if before[side].get(node) == Some(&true) {
                    LastIncrement::Kept
                } else {
                    LastIncrement::NotKept
                },
            }
        })
        .collect()
}

/// Masses of the facets of side `a` as if they were covered wholly: of those that face what
/// touches at one of their corners. A wall next to a sole cannot be covered.
pub(super) fn whole_facets(configuration: &Configuration, facing: &[Vec3]) -> Vec<FacetMass> {
    let own = configuration.side(Side::A);
    (0..own.surface.facets().len())
        .filter_map(|facet| {
            let facet = FacetId::new(facet);
            let corners = own.corners(facet);
            let x = own.corner_positions(facet);
            let shape = Shape::of(&corners);
            let n = normal(&x, shape);
            let faces = |corner: &SurfaceNode| {
                let towards = facing[*corner];
                n.dot(&towards) > -FACING * towards.norm()
            };
            if !corners.iter().any(faces) {
                return None;
            }
            let segment = plane_segment(&Facet { corners: x, shape }, &-n, Derivatives::None)?;
            let mass = std::array::from_fn(|c| std::array::from_fn(|d| segment.mass[c][d]));
            Some(FacetMass { corners, mass })
        })
        .collect()
}

fn normal(x: &[Vec3; 4], shape: Shape) -> Vec3 {
    match shape {
        Shape::Triangle => (x[1] - x[0]).cross(&(x[2] - x[0])),
        Shape::Quadrilateral => (x[2] - x[0]).cross(&(x[3] - x[1])),
    }
    .normalize()
}
