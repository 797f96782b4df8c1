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

use nalgebra::{Matrix3, Vector3};
use num_dual::DualSVec64;
use rayon::prelude::*;
use striae_law::friction::RequiredTextures;
use striae_surface::{
    facet::Shape,
    scalar::{combination, constant3, dot, normalised, scaled},
    texture::{Axes, Field, Texture},
    transport::transported,
};

use crate::{
    configuration::Configuration,
    coverage::{Contact, Found, Place},
    edge::on_edge,
    frame::{Frame, Frames, Tracked, own_normal},
    kinematics::Kinematics,
    opposing::{Opposing, PlaceLanes},
    pointed::{RigidPoint, Spot, Tip},
    projection::{Hit, differentiated_rigid},
    selection::Selection,
    term::{Jacobian, Lanes, Source, parts, variable, variable3},
    transported::Transported,
};

/// Texture of one side of a pair.
#[derive(Clone, Debug)]
pub enum SideTexture {
    /// On the nodes of a surface of facets, deformable or rigid.
    Nodal(Texture),
    /// On a rigid plane, in its reference configuration.
    Plane(Field),
}

/// Textures at a node: its own and the opposing one, seen from its side.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodeTextures {
    /// `a_a`.
    pub own: Option<Tracked>,
    /// `a_b'`.
    pub opposite: Option<Tracked>,
}

/// Textures of all kept nodes, by side; empty where the law needs none.
pub type Textures = [Vec<NodeTextures>; 2];

/// A texture without direction at a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CollapsedTexture {
    /// Side of the pair.
    pub side: usize,
    /// Surface-local node.
    pub node: u32,
}

/// Textures of all nodes that the friction law looks at. Nodes that face nothing have any.
///
/// # Errors
/// When a convected texture has no direction left.
pub fn textures(
    configuration: &Configuration,
    selection: &Selection,
    frames: &Frames,
    kinematics: &[Kinematics],
) -> Result<Textures, CollapsedTexture> {
    if configuration.pair.friction.required_textures() == RequiredTextures::Any {
        return Ok([0, 1].map(|side| vec![NodeTextures::default(); selection.nodes(side)]));
    }
    let of_side = |side: usize| -> Result<Vec<NodeTextures>, CollapsedTexture> {
        let found: Vec<_> = (0..selection.nodes(side))
            .into_par_iter()
            .with_min_len(8)
            .map(|node| match &frames[side][node] {
                Some(frame) if selection.is_kept(side, node as u32) => Ok(NodeTextures {
                    own: match selection.tip(side, node as u32) {
                        Tip::Node { .. } => own(configuration, side, node as u32, &frame.n)?,
                        Tip::Rigid(point) => of_point(configuration, node as u32, point, frame)?,
                    },
                    opposite: if is_beside(selection, kinematics, side, node) {
                        any_direction(configuration, side, frame)
                    } else {
                        opposite(
                            configuration,
                            (side, node as u32),
                            selection.tip(side, node as u32),
                            (frame, frames),
                            faced(configuration, selection, side, node as u32),
                        )?
                    },
                }),
                _ => Ok(NodeTextures::default()),
            })
            .collect();
        found.into_iter().collect()
    };
    Ok([of_side(0)?, of_side(1)?])
}

/// The node's own `a`, for the normal `n`.
pub fn own(
    configuration: &Configuration,
    side: usize,
    node: u32,
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
    let mut add = |other: u32, weight: f64| {
        direction.value += snapshot.x[other as usize] * weight;
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

/// Whether a node with unknowns faces nothing. No position changes its gap then, so it is open
/// whatever the texture.
fn is_beside(selection: &Selection, kinematics: &[Kinematics], side: usize, node: usize) -> bool {
    let place = selection.basis.index[side][node];
    place.is_some_and(|k| kinematics[k as usize].gap.gradient.is_empty())
}

/// A tangent in place of the opposing texture, for nodes that friction does not act on.
fn any_direction(configuration: &Configuration, side: usize, frame: &Frame) -> Option<Tracked> {
    let textured = configuration.pair.sides[1 - side].texture.is_some();
    textured.then(|| Tracked {
        value: frame.t[0].value,
        jacobian: Jacobian::new(),
    })
}

/// The point opposite to a node: along its normal or, if it is pointed, that of the
/// deformable facet that it presses on.
fn faced(
    configuration: &Configuration,
    selection: &Selection,
    side: usize,
    node: u32,
) -> Option<(Contact, Found)> {
    let tip = selection.tip(side, node);
    if selection.is_pointed(side, node)
        && tip.presses_on_deformable(configuration)
        && let Some(hit) = Spot::new(configuration, tip).and_then(|spot| spot.hit)
    {
        let contact = Contact {
            gap: hit.gap,
            place: Place::Facet(hit),
        };
        return Some((contact, Found::Inside));
    }
    match tip {
        Tip::Node { side, node, .. } => configuration.opposite(side, node),
        Tip::Rigid(_) => None,
    }
}

/// The opposing `a_b'` at a node.
fn opposite(
    configuration: &Configuration,
    (side, node): (usize, u32),
    tip: Tip,
    (frame, frames): (&Frame, &Frames),
    faced: Option<(Contact, Found)>,
) -> Result<Option<Tracked>, CollapsedTexture> {
    let collapsed = CollapsedTexture { side, node };
    let Some(texture) = &configuration.pair.sides[1 - side].texture else {
        return Ok(None);
    };
    let Some((contact, found)) = faced else {
        return Err(collapsed);
    };
    match (texture, contact.place) {
        (SideTexture::Plane(field), Place::Plane(_)) => on_plane(configuration, side, node, field)
            .ok_or(collapsed)
            .map(Some),
        (SideTexture::Nodal(_), Place::Facet(hit)) if !tip.presses_on_deformable(configuration) => {
            on_rigid(configuration, node, &hit, found).map(Some)
        }
        (SideTexture::Nodal(_), Place::Facet(hit)) => {
            on_deformable(configuration, tip, frame, frames, (&hit, found)).map(Some)
        }
        _ => Err(collapsed),
    }
}

fn on_plane(
    configuration: &Configuration,
    side: usize,
    node: u32,
    field: &Field,
) -> Option<Tracked> {
    let (point, normal) = configuration.plane()?;
    let n = constant3(&normal);
    let x: Vector3<DualSVec64<3>> = variable3(&configuration.side(side).x[node as usize], 0);
    let gap = dot(&(x - constant3(&point)), &n);
    let placement = &configuration.placement;
    let place = placement.back_of(&(x - scaled(&n, gap)));
    let at_rest = constant3(&placement.rotation.tr_mul(&normal));
    let a = placement.direction_of(&field.axes(place, at_rest)?.a);
    let mut lanes = Lanes::default();
    lanes.push(Source::Unknowns {
        first: configuration.pair.numbering().position(side, node),
        count: 3,
    });
    Some(tracked(&lanes, &-a))
}

fn on_rigid(
    configuration: &Configuration,
    node: u32,
    hit: &Hit,
    found: Found,
) -> Result<Tracked, CollapsedTexture> {
    let target = configuration.side(1);
    let corners = target.corners(hit.facet);
    let shape = Shape::of(&corners);
    let mut lanes = Lanes::default();
    let place;
    // Lanes of the node's position or, on the edge, of the share of the way along it.
    let (weights, normal): ([DualSVec64<3>; 4], _) = match found {
        Found::Inside => {
            let x = variable3(&configuration.side(0).x[node as usize], 0);
            let ([xi, eta, _], normal) = differentiated_rigid(target, hit, &x);
            lanes.push(Source::Unknowns {
                first: configuration.pair.numbering().position(0, node),
                count: 3,
            });
            (shape.weights(xi, eta).value, normal)
        }
        Found::Edge(nodes) => {
            place = on_edge(configuration, 0, node, hit, nodes);
            lanes.push(Source::Scalar(&place.share.gradient));
            let weights = place.weights_along(variable(place.share.value, 0));
            let normals = corners.map(|corner| constant3(&target.normals[corner as usize]));
            (weights, normalised(&combination(&weights, &normals)))
        }
    };
    let mut sum: Vector3<DualSVec64<3>> = Vector3::zeros();
    for corner in 0..4 {
        let a = own(
            configuration,
            1,
            corners[corner],
            &fixed_normal(configuration, corners[corner]),
        )?
        .unwrap_or_default();
        let n_j = target.normals[corners[corner] as usize];
        let turned = transported(&constant3(&a.value), &constant3(&n_j), &normal);
        sum -= scaled(&turned, weights[corner]);
    }
    Ok(tracked(&lanes, &normalised(&sum)))
}

/// `a` of a rigid surface at a point that lodges with `node`: between the ends of its edge.
fn of_point(
    configuration: &Configuration,
    node: u32,
    point: RigidPoint,
    frame: &Frame,
) -> Result<Option<Tracked>, CollapsedTexture> {
    let n: Vector3<DualSVec64<3>> = variable3(&frame.n.value, 0);
    let mut sum: Vector3<DualSVec64<3>> = Vector3::zeros();
    for (end, weight) in point.ends.into_iter().zip([1.0 - point.share, point.share]) {
        let normal = fixed_normal(configuration, end);
        let Some(a) = own(configuration, 1, end, &normal)? else {
            return Ok(None);
        };
        let turned = transported(&constant3(&a.value), &constant3(&normal.value), &n);
        sum += scaled(&turned, DualSVec64::from(weight));
    }
    if sum.map(|component| component.re).norm() < f64::EPSILON {
        return Err(CollapsedTexture { side: 1, node });
    }
    let mut lanes = Lanes::default();
    lanes.push(Source::Vector(&frame.n.jacobian));
    Ok(Some(tracked(&lanes, &normalised(&sum))))
}

fn fixed_normal(configuration: &Configuration, node: u32) -> Tracked {
    Tracked {
        value: configuration.side(1).normals[node as usize],
        jacobian: Jacobian::new(),
    }
}

fn on_deformable(
    configuration: &Configuration,
    tip: Tip,
    frame: &Frame,
    frames: &Frames,
    (hit, found): (&Hit, Found),
) -> Result<Tracked, CollapsedTexture> {
    let side = tip.side();
    let other = configuration.side(1 - side);
    let numbering = configuration.pair.numbering();
    let corners = other.corners(hit.facet);
    let normals = corners.map(|corner| match &frames[1 - side][corner as usize] {
        Some(frame) => frame.n.clone(),
        None => own_normal(configuration, 1 - side, corner),
    });
    let mut a = Vec::with_capacity(4);
    for (corner, n) in corners.iter().zip(&normals) {
        a.push(own(configuration, 1 - side, *corner, n)?.unwrap_or_default());
    }
    let mut lanes = Lanes::default();
    let position = |side: usize, node: u32| Source::Unknowns {
        first: numbering.position(side, node),
        count: 3,
    };
    lanes.push(tip.lanes(configuration));
    lanes.push(Source::Vector(&frame.n.jacobian));
    for corner in corners {
        lanes.push(position(1 - side, corner));
    }
    for n in &normals {
        lanes.push(Source::Vector(&n.jacobian));
    }
    for texture in &a {
        lanes.push(Source::Vector(&texture.jacobian));
    }
    let shape = Shape::of(&corners);
    let n = frame.n.value;
    let on_edge = match (found, tip) {
        (Found::Edge(nodes), Tip::Node { side, node, .. }) => {
            Some(on_edge(configuration, side, node, hit, nodes))
        }
        _ => None,
    };
    // A rigid point is not found along its own normal.
    let ray = match tip {
        Tip::Rigid(_) => Spot::new(configuration, tip).map(|spot| spot.ray),
        Tip::Node { .. } => None,
    };
    let along = ray.as_ref().map_or(&n, |ray| &ray.value);
    let opposing = match &on_edge {
        None => Opposing::new(shape, hit, along, &other.corner_positions(hit.facet)),
        Some(place) => Opposing::at(place.weights()),
    };
    let turned: [Transported; 4] = std::array::from_fn(|corner| {
        Transported::new(&a[corner].value, &-normals[corner].value, &n)
    });
    let sum = opposing.sum(&turned);
    let length = sum.norm();
    let value = sum / length;
    let across = (Matrix3::identity() - value * value.transpose()) / length;
    let mut gradient = [[0.0; 3]; 45];
    let by_r = opposing.spread_sum(&across, &turned, [3, 18, 30], &mut gradient);
    let places = PlaceLanes {
        x: 0,
        n: if ray.is_some() { 42 } else { 3 },
        corners: 6,
    };
    if let Some(ray) = &ray {
        lanes.push(Source::Vector(&ray.jacobian));
    }
    match &on_edge {
        None => opposing.spread(&by_r, places, &mut gradient),
        Some(place) => {
            let [start, end] = place.ends.map(|corner| turned[corner].value);
            gradient[42] = (across * (start - end)).into();
            lanes.push(Source::Scalar(&place.share.gradient));
        }
    }
    Ok(Tracked {
        value,
        jacobian: lanes.jacobian(&gradient),
    })
}

fn tracked<const N: usize>(lanes: &Lanes, vector: &Vector3<DualSVec64<N>>) -> Tracked {
    let (value, gradient) = parts(vector);
    Tracked {
        value,
        jacobian: lanes.jacobian(&gradient),
    }
}
