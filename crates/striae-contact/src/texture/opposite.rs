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
    coverage::{Found, Place},
    edge::on_edge,
    frame::{Frame, Frames},
    nodal_normal::own_normal,
    opposing::{Opposing, PlaceLanes},
    projection::{Hit, differentiated_rigid},
    side::Side,
    term::{Jacobian, Lanes, Source, variable, variable3},
    tracked::Tracked,
    transported::Transported,
};

/// Length of a mean of unit vectors up to which it is round-off, as in the middle of a facet around
/// which they point away from it.
const ROUND_OFF: f64 = 1e-9;

/// The opposing `a_b'` at a node.
pub(super) fn opposite(
    configuration: &Configuration,
    (side, node): (Side, SurfaceNode),
    (frame, frames): (&Frame, &Frames),
) -> Result<Option<Tracked>, CollapsedTexture> {
    let collapsed = CollapsedTexture { side, node };
    let Some(texture) = &configuration.pair.sides[configuration.pair.opposing(side)].texture else {
        return Ok(None);
    };
    let Some((contact, found)) = configuration.opposite(side, node) else {
        return Err(collapsed);
    };
    match (texture, contact.place) {
        (SideTexture::Plane(field), Place::Plane(_)) => on_plane(configuration, side, node, field)
            .ok_or(collapsed)
            .map(Some),
        (SideTexture::Nodal(_), Place::Facet(hit)) if configuration.pair.is_rigid() => {
            on_rigid(configuration, node, &hit, found).map(Some)
        }
        (SideTexture::Nodal(_), Place::Facet(hit)) => {
            let at = (side, node);
            on_deformable(configuration, at, (frame, frames), (&hit, found)).map(Some)
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
    let length = sum.map(|component| component.re).norm();
    if length <= ROUND_OFF {
        return Err(CollapsedTexture {
            side: Side::A,
            node,
        });
    }
    Ok(tracked(&lanes, &normalised(&sum)))
}

fn fixed_normal(configuration: &Configuration, node: SurfaceNode) -> Tracked {
    Tracked {
        value: configuration.side(Side::B).normals[node],
        jacobian: Jacobian::new(),
    }
}

fn on_deformable(
    configuration: &Configuration,
    (side, node): (Side, SurfaceNode),
    (frame, frames): (&Frame, &Frames),
    (hit, found): (&Hit, Found),
) -> Result<Tracked, CollapsedTexture> {
    let opposing = configuration.pair.opposing(side);
    let other = configuration.side(opposing);
    let corners = other.corners(hit.facet);
    let normals = corners.map(|corner| match &frames[opposing][corner] {
        Some(frame) => frame.n.clone(),
        None => own_normal(configuration, opposing, corner),
    });
    let mut a = Vec::with_capacity(4);
    for (corner, n) in corners.iter().zip(&normals) {
        a.push(own(configuration, opposing, *corner, n)?.unwrap_or_default());
    }
    let mut lanes = lanes_of(configuration, (side, node), frame, &corners);
    for n in &normals {
        lanes.push(Source::Vector(&n.jacobian));
    }
    for texture in &a {
        lanes.push(Source::Vector(&texture.jacobian));
    }
    let shape = Shape::of(&corners);
    let n = frame.n.value;
    let on_edge = match found {
        Found::Inside => None,
        Found::Edge(nodes) => Some(on_edge(configuration, side, node, hit, nodes)),
    };
    let place = match &on_edge {
        None => Opposing::new(shape, hit, &n, &other.corner_positions(hit.facet)),
        Some(place) => Opposing::at(place.weights()),
    };
    let turned: [Transported; 4] = std::array::from_fn(|corner| {
        Transported::new(&a[corner].value, &-normals[corner].value, &n)
    });
    let sum = place.sum(&turned);
    let length = sum.norm();
    if length <= ROUND_OFF {
        return Err(CollapsedTexture { side, node });
    }
    let value = sum / length;
    let across = (Matrix3::identity() - value * value.transpose()) / length;
    let mut gradient = [[0.0; 3]; 43];
    let by_r = place.spread_sum(&across, &turned, [3, 18, 30], &mut gradient);
    let places = PlaceLanes {
        x: 0,
        n: 3,
        corners: 6,
    };
    match &on_edge {
        None => place.spread(&by_r, places, &mut gradient),
        Some(on_edge) => {
            let [start, end] = on_edge.ends.map(|corner| turned[corner].value);
            gradient[42] = (across * (start - end)).into();
            lanes.push(Source::Scalar(&on_edge.share.gradient));
        }
    }
    Ok(Tracked {
        value,
        jacobian: lanes.jacobian(&gradient),
    })
}

/// Lanes of the node, its normal and the corners that it faces.
fn lanes_of<'a>(
    configuration: &Configuration,
    (side, node): (Side, SurfaceNode),
    frame: &'a Frame,
    corners: &[SurfaceNode; 4],
) -> Lanes<'a> {
    let numbering = configuration.pair.numbering();
    let mut lanes = Lanes::default();
    lanes.push(Source::Unknowns {
        first: numbering.position(side, node),
        count: 3,
    });
    lanes.push(Source::Vector(&frame.n.jacobian));
    for &corner in corners {
        lanes.push(Source::Unknowns {
            first: numbering.position(configuration.pair.opposing(side), corner),
            count: 3,
        });
    }
    lanes
}
