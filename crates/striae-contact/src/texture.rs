//! Textures of the two sides at a contact node, with their derivatives.
//!
//! Every node carries the unit tangent vector `a = n x s` of its own surface,
//! convected with the edges. The texture of the other side is brought to the
//! node like the opposing traction, node to node,
//!
//! ```text
//! a_b' ~ -sum N_J R(n_I, -n_J) a_J
//! ```
//!
//! made of unit length; the sign expresses it for the normal of the node's own
//! side, Jones & Papadopoulos (2006), eq. (17).

mod opposite;

use nalgebra::{Matrix3, Vector3};
use num_dual::DualSVec64;
use rayon::prelude::*;
use striae_law::friction::{Friction, RequiredTextures};
use striae_surface::{node::SurfaceNode, texture::Axes};

pub use crate::pair::SideTexture;
use crate::{
    configuration::Configuration,
    frame::{Frame, Frames},
    kinematics::Kinematics,
    selection::Selection,
    side::Side,
    term::{Jacobian, Lanes, Source, parts, variable3},
    tracked::Tracked,
};
use opposite::opposite;

/// Textures at a node: its own and the opposing one, seen from its side.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodeTextures {
    /// `a_a`.
    pub own: Option<Tracked>,
    /// `a_b'`.
    pub opposite: Option<Tracked>,
}

/// Textures of all kept nodes, by side; empty where neither the law nor wear needs any.
pub type Textures = [Vec<NodeTextures>; 2];

/// A texture without direction at a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CollapsedTexture {
    /// Side of the pair.
    pub side: Side,
    /// Surface-local node.
    pub node: SurfaceNode,
}

/// Textures of all nodes that friction or wear depends on. Nodes that face nothing have arbitrary
/// ones.
///
/// # Errors
/// When a convected texture has no direction left.
pub fn textures(
    configuration: &Configuration,
    friction: &Friction,
    selection: &Selection,
    frames: &Frames,
    kinematics: &[Kinematics],
) -> Result<Textures, CollapsedTexture> {
    let is_needed = friction.required_textures() != RequiredTextures::Any
        || configuration.pair.wears_by().is_some();
    if !is_needed {
        return Ok(Side::BOTH.map(|side| vec![NodeTextures::default(); selection.nodes(side)]));
    }
    let of_side = |side: Side| -> Result<Vec<NodeTextures>, CollapsedTexture> {
        let found: Vec<_> = (0..selection.nodes(side))
            .into_par_iter()
            .with_min_len(8)
            .map(SurfaceNode::new)
            .map(|node| match &frames[side][node] {
                Some(frame) if selection.is_kept(side, node) => Ok(NodeTextures {
                    own: own(configuration, side, node, &frame.n)?,
                    opposite: if is_beside(selection, kinematics, side, node) {
                        any_direction(configuration, side, frame)
                    } else {
                        opposite(configuration, (side, node), (frame, frames))?
                    },
                }),
                _ => Ok(NodeTextures::default()),
            })
            .collect();
        found.into_iter().collect()
    };
    Ok([of_side(Side::A)?, of_side(Side::B)?])
}

/// The node's own `a`, for the normal `n`.
pub fn own(
    configuration: &Configuration,
    side: Side,
    node: SurfaceNode,
    n: &Tracked,
) -> Result<Option<Tracked>, CollapsedTexture> {
    let Some(SideTexture::Nodal(texture)) = &configuration.pair.sides[side].texture else {
        return Ok(None);
    };
    let snapshot = configuration.side(side);
    let numbering = configuration.pair.numbering();
    let ordinates = texture.ordinates(node);
    let mut direction = Tracked::default();
    let mut total = 0.0;
    let mut add = |other: SurfaceNode, weight: f64| {
        direction.value += snapshot.x[other] * weight;
        let first = numbering.position(side, other);
        let block = Matrix3::from_diagonal_element(weight);
        direction.jacobian.push((first, block));
    };
    for (&other, &weight) in ordinates.ring.iter().zip(ordinates.weights) {
        add(other, weight);
        total += weight;
    }
    add(node, -total);
    type D = DualSVec64<6>;
    let axes: Option<Axes<D>> = Axes::along(variable3(&direction.value, 0), variable3(&n.value, 3));
    let a = axes.ok_or(CollapsedTexture { side, node })?.a;
    let mut lanes = Lanes::default();
    lanes.push(Source::Vector(&direction.jacobian));
    lanes.push(Source::Vector(&n.jacobian));
    Ok(Some(tracked(&lanes, &a)))
}

/// Returns whether a node with unknowns faces nothing. Its gap then depends on no position, so it
/// is open for any texture.
fn is_beside(
    selection: &Selection,
    kinematics: &[Kinematics],
    side: Side,
    node: SurfaceNode,
) -> bool {
    let place = selection.basis.index[side][node];
    place.is_some_and(|k| kinematics[k as usize].gap.gradient.is_empty())
}

/// A tangent in place of the opposing texture, for nodes that friction does not act on.
fn any_direction(configuration: &Configuration, side: Side, frame: &Frame) -> Option<Tracked> {
    let textured = configuration.pair.sides[configuration.pair.opposing(side)]
        .texture
        .is_some();
    textured.then(|| Tracked {
        value: frame.t[0].value,
        jacobian: Jacobian::new(),
    })
}

fn tracked<const N: usize>(lanes: &Lanes, vector: &Vector3<DualSVec64<N>>) -> Tracked {
    let (value, gradient) = parts(vector);
    Tracked {
        value,
        jacobian: lanes.jacobian(&gradient),
    }
}
