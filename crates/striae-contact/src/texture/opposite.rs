//! The texture that a node with unknowns faces, brought to the node.

use nalgebra::{Matrix3, Vector3};
use num_dual::DualSVec64;
use striae_surface::{
    facet::Shape,
    node::SurfaceNode,
    scalar::{combination, constant3, dot, normalised, scaled},
    texture::Field,
    transport::transported,
};

use super::{CollapsedTexture, SideTexture, own, tracked};
use crate::{
    configuration::Configuration,
    coverage::{Contact, Found, Place},
    edge::on_edge,
    frame::{Frame, Frames},
    nodal_normal::own_normal,
    opposing::{Opposing, PlaceLanes},
    projection::{Hit, differentiated_rigid},
    selection::Selection,
    side::Side,
    spot::Spot,
    term::{Jacobian, Lanes, Source, variable, variable3},
    tip::{RigidPoint, Tip},
    tracked::Tracked,
    transported::Transported,
};

/// The point opposite to a node: along its normal or, if it is pointed, that of the
/// deformable facet that it presses on.
pub(super) fn faced(
    configuration: &Configuration,
    selection: &Selection,
    side: Side,
    node: SurfaceNode,
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
pub(super) fn opposite(
    configuration: &Configuration,
    (side, node): (Side, SurfaceNode),
    tip: Tip,
    (frame, frames): (&Frame, &Frames),
    faced: Option<(Contact, Found)>,
) -> Result<Option<Tracked>, CollapsedTexture> {
    let collapsed = CollapsedTexture { side, node };
    let Some(texture) = &configuration.pair.sides[side.opposite()].texture else {
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
    side: Side,
    node: SurfaceNode,
    field: &Field,
) -> Option<Tracked> {
    let (point, normal) = configuration.plane()?;
    let n = constant3(&normal);
    let x: Vector3<DualSVec64<3>> = variable3(&configuration.side(side).x[node], 0);
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
    node: SurfaceNode,
    hit: &Hit,
    found: Found,
) -> Result<Tracked, CollapsedTexture> {
    let target = configuration.side(Side::B);
    let corners = target.corners(hit.facet);
    let shape = Shape::of(&corners);
    let mut lanes = Lanes::default();
    let place;
    // Lanes of the node's position or, on the edge, of the share of the way along it.
    let (weights, normal): ([DualSVec64<3>; 4], _) = match found {
        Found::Inside => {
            let x = variable3(&configuration.side(Side::A).x[node], 0);
            let ([xi, eta, _], normal) = differentiated_rigid(target, hit, &x);
            lanes.push(Source::Unknowns {
                first: configuration.pair.numbering().position(Side::A, node),
                count: 3,
            });
            (shape.weights(xi, eta).value, normal)
        }
        Found::Edge(nodes) => {
            place = on_edge(configuration, Side::A, node, hit, nodes);
            lanes.push(Source::Scalar(&place.share.gradient));
            let weights = place.weights_along(variable(place.share.value, 0));
            let normals = corners.map(|corner| constant3(&target.normals[corner]));
            (weights, normalised(&combination(&weights, &normals)))
        }
    };
    let mut sum: Vector3<DualSVec64<3>> = Vector3::zeros();
    for corner in 0..4 {
        let a = own(
            configuration,
            Side::B,
            corners[corner],
            &fixed_normal(configuration, corners[corner]),
        )?
        .unwrap_or_default();
        let n_j = target.normals[corners[corner]];
        let turned = transported(&constant3(&a.value), &constant3(&n_j), &normal);
        sum -= scaled(&turned, weights[corner]);
    }
    Ok(tracked(&lanes, &normalised(&sum)))
}

/// `a` of a rigid surface at a point that lodges with `node`: between the ends of its edge.
pub(super) fn of_point(
    configuration: &Configuration,
    node: SurfaceNode,
    point: RigidPoint,
    frame: &Frame,
) -> Result<Option<Tracked>, CollapsedTexture> {
    let n: Vector3<DualSVec64<3>> = variable3(&frame.n.value, 0);
    let mut sum: Vector3<DualSVec64<3>> = Vector3::zeros();
    for (end, weight) in point.ends.into_iter().zip([1.0 - point.share, point.share]) {
        let normal = fixed_normal(configuration, end);
        let Some(a) = own(configuration, Side::B, end, &normal)? else {
            return Ok(None);
        };
        let turned = transported(&constant3(&a.value), &constant3(&normal.value), &n);
        sum += scaled(&turned, DualSVec64::from(weight));
    }
    if sum.map(|component| component.re).norm() < f64::EPSILON {
        return Err(CollapsedTexture {
            side: Side::B,
            node,
        });
    }
    let mut lanes = Lanes::default();
    lanes.push(Source::Vector(&frame.n.jacobian));
    Ok(Some(tracked(&lanes, &normalised(&sum))))
}

fn fixed_normal(configuration: &Configuration, node: SurfaceNode) -> Tracked {
    Tracked {
        value: configuration.side(Side::B).normals[node],
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
    let other = configuration.side(side.opposite());
    let corners = other.corners(hit.facet);
    let normals = corners.map(|corner| match &frames[side.opposite()][corner] {
        Some(frame) => frame.n.clone(),
        None => own_normal(configuration, side.opposite(), corner),
    });
    let mut a = Vec::with_capacity(4);
    for (corner, n) in corners.iter().zip(&normals) {
        a.push(own(configuration, side.opposite(), *corner, n)?.unwrap_or_default());
    }
    let mut lanes = lanes_of(configuration, tip, frame, &corners);
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
    let spot = match tip {
        Tip::Rigid(_) => Spot::new(configuration, tip),
        Tip::Node { .. } => None,
    };
    let (ray, of_spot) = spot.map(|spot| (spot.ray, spot.opposing)).unzip();
    let opposing = match (&on_edge, of_spot.flatten()) {
        (None, Some(opposing)) => opposing,
        (None, None) => Opposing::new(shape, hit, &n, &other.corner_positions(hit.facet)),
        (Some(place), _) => Opposing::at(place.weights()),
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

/// Lanes of the tip, its normal and the corners that it faces.
fn lanes_of<'a>(
    configuration: &Configuration,
    tip: Tip,
    frame: &'a Frame,
    corners: &[SurfaceNode; 4],
) -> Lanes<'a> {
    let numbering = configuration.pair.numbering();
    let mut lanes = Lanes::default();
    lanes.push(tip.lanes(configuration));
    lanes.push(Source::Vector(&frame.n.jacobian));
    for &corner in corners {
        lanes.push(Source::Unknowns {
            first: numbering.position(tip.side().opposite(), corner),
            count: 3,
        });
    }
    lanes
}
