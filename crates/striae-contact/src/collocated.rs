//! Collocated gap and slip of the kept nodes, and the fields of both sides.
//!
//! The formulation of Jones & Papadopoulos (2006): a kept node looks along its own normal,
//!
//! ```text
//! sum_J N_J x_J - x_I - g n_I = 0,     du = (I - n n)(x_I - xbar)
//! ```
//!
//! with the material point `xbar` that was opposite to it in the last converged
//! configuration. Every side has a field of its own; a node that is not kept takes its
//! traction from the kept nodes by its row of the [transfer](crate::transfer),
//!
//! ```text
//! p_I = sum_k Z_Ik p_k,   tau_I = sum_k Z_Ik R(n_I, n_k) tau_k
//! ```
//!
//! with normal and friction of a node of the other side seen from this one.

use nalgebra::{Matrix3, Vector3};
use num_dual::DualSVec64;
use rayon::prelude::*;
use striae_mesh::Vec3;
use striae_surface::{facet::Shape, node::SurfaceNode};

use crate::{
    configuration::Configuration,
    coverage::{Found, Place},
    edge::on_edge,
    frame::{Frame, Frames},
    kinematics::{Kinematics, Presence, Pressure},
    opposing::Opposing,
    pairing::side_sign,
    partner::Partner,
    projection::differentiated_rigid,
    selection::Selection,
    side::Side,
    term::{Gradient, Jacobian, Lanes, Source, add_block, gradient},
    tracked::{Tracked, TrackedScalar, add_chained, add_slope},
    traction::NodalTractions,
    transported::Transported,
    unknowns::Tractions,
};

/// Gaps and slips of all kept nodes.
pub fn kinematics(
    configuration: &Configuration,
    selection: &Selection,
    frames: &Frames,
) -> Vec<Kinematics> {
    (0..selection.kept().len())
        .into_par_iter()
        .with_min_len(8)
        .map(|k| {
            let (side, node) = selection.kept()[k].place();
            let frame = frames[side][node].as_ref();
            let slip = match (selection.partner(k), frame) {
                (Some(partner), Some(frame)) => slip(configuration, (side, node), partner, frame),
                _ => Tracked::default(),
            };
            let gap = frame.map_or_else(TrackedScalar::default, |frame| {
                let mut gap = gap(configuration, side, node, frame);
                gap.value += selection.offset_along_normal(side, node);
                gap
            });
            Kinematics {
                reaches: gap.gradient.clone(),
                gap,
                seen_slip: slip.value,
                shares: shares(configuration, (side, node), selection.partner(k)),
                slip,
                presence: Presence::Facing,
                pressure: Pressure::AtNode,
                stiffness: selection.stiffness(k),
            }
        })
        .collect()
}

/// The gap along the normal; without derivatives, so that the node stays open, where it
/// sees nothing.
fn gap(
    configuration: &Configuration,
    side: Side,
    node: SurfaceNode,
    frame: &Frame,
) -> TrackedScalar {
    let numbering = configuration.pair.numbering();
    let Some((contact, found)) = configuration.opposite(side, node) else {
        return TrackedScalar {
            value: f64::INFINITY,
            gradient: Gradient::new(),
        };
    };
    if let (Found::Edge(nodes), Place::Facet(hit)) = (found, contact.place) {
        return on_edge(configuration, side, node, &hit, nodes).gap;
    }
    let own = numbering.position(side, node);
    let value = contact.gap;
    let x = configuration.side(side).x[node];
    let gradient: Gradient = match contact.place {
        Place::Plane(_) => {
            let normal = configuration.plane().map_or_else(Vec3::zeros, |(_, n)| n);
            vec![(own, normal)]
        }
        Place::Facet(hit) if configuration.pair.is_rigid() => {
            let x: Vector3<DualSVec64<3>> = crate::term::variable3(&x, 0);
            let ([_, _, g], _) = differentiated_rigid(configuration.side(Side::B), &hit, &x);
            vec![(own, gradient(&g).into())]
        }
        Place::Facet(hit) => {
            let target = configuration.side(side.opposite());
            let corners = target.corners(hit.facet);
            let shape = Shape::of(&corners);
            let positions = target.corner_positions(hit.facet);
            let n = &frame.n.value;
            let opposing = Opposing::new(shape, &hit, n, &positions);
            let (by_r, weights) = (opposing.gap_by_r, opposing.weights);
            let by_n = by_r * -hit.gap;
            let mut gradient: Gradient = vec![(own, -by_r)];
            for corner in 0..4 {
                let first = numbering.position(side.opposite(), corners[corner]);
                add_slope(&mut gradient, first, by_r * weights[corner]);
            }
            for (first, block) in &frame.n.jacobian {
                add_slope(&mut gradient, *first, block.tr_mul(&by_n));
            }
            gradient
        }
    };
    TrackedScalar { value, gradient }
}

/// Slip of a node relative to the material point that was opposite to it.
fn slip(
    configuration: &Configuration,
    (side, node): (Side, SurfaceNode),
    partner: Partner,
    frame: &Frame,
) -> Tracked {
    let numbering = configuration.pair.numbering();
    let (x, n) = (configuration.side(side).x[node], frame.n.value);
    let tangential = Matrix3::identity() - n * n.transpose();
    let mut lanes = Lanes::default();
    let mut slopes = [[0.0; 3]; 18];
    lanes.push(Source::Unknowns {
        first: numbering.position(side, node),
        count: 3,
    });
    lanes.push(Source::Vector(&frame.n.jacobian));
    if let Partner::Corners(corners, weights) = partner {
        for (at, corner) in corners.into_iter().enumerate() {
            lanes.push(Source::Unknowns {
                first: numbering.position(side.opposite(), corner),
                count: 3,
            });
            add_block(&mut slopes, 6 + 3 * at, &(tangential * -weights[at]));
        }
    }
    let relative = x - partner.point(configuration, side);
    let by_n = Matrix3::identity() * n.dot(&relative) + n * relative.transpose();
    add_block(&mut slopes, 0, &tangential);
    add_block(&mut slopes, 3, &-by_n);
    Tracked {
        value: tangential * relative,
        jacobian: lanes.jacobian(&slopes),
    }
}

/// Shares of the node and of what is opposite to it in its friction.
fn shares(
    configuration: &Configuration,
    (side, node): (Side, SurfaceNode),
    partner: Option<Partner>,
) -> Vec<(u32, f64)> {
    let numbering = configuration.pair.numbering();
    let mut shares = vec![(numbering.position(side, node), 1.0)];
    if let Some(Partner::Corners(corners, weights)) = partner {
        let opposite = corners.map(|corner| numbering.position(side.opposite(), corner));
        shares.extend(opposite.into_iter().zip(weights));
    }
    shares
}

/// Pressure and friction of a node with their derivatives.
#[derive(Clone, Debug, Default)]
pub struct NodalField {
    /// Pressure.
    pub pressure: TrackedScalar,
    /// Friction traction.
    pub tau: Tracked,
}

/// Pressure and friction at every node of both sides.
pub fn nodal_fields(
    configuration: &Configuration,
    selection: &Selection,
    frames: &Frames,
    tractions: &Tractions,
    tau: &NodalTractions,
) -> [Vec<NodalField>; 2] {
    let numbering = configuration.pair.numbering();
    let at_node = |side: Side, node: SurfaceNode| {
        let mut field = NodalField::default();
        let Some(frame) = &frames[side][node] else {
            return field;
        };
        for &(k, weight) in selection.row(side, node) {
            let (side_k, node_k) = selection.kept()[k as usize].place();
            let first = numbering.traction(side_k, node_k);
            field.pressure.value += weight * tractions.nodes[side_k][node_k][0];
            let slope = Vec3::x() * weight;
            field.pressure.gradient.push((first, slope));
            let of_k = &tau[side_k][node_k];
            if let Some(frame_k) = &frames[side_k][node_k]
                && !of_k.jacobian.is_empty()
            {
                let sign = side_sign(side) * side_sign(side_k);
                let from = frame_k.n.value * sign;
                let turned = Transported::new(&of_k.value, &from, &frame.n.value);
                let factor = weight * sign;
                field.tau.value += turned.value * factor;
                let jacobian: &mut Jacobian = &mut field.tau.jacobian;
                add_chained(jacobian, &(turned.by_vector * factor), &of_k.jacobian);
                let by_from = turned.by_from * weight;
                add_chained(jacobian, &by_from, &frame_k.n.jacobian);
                add_chained(jacobian, &(turned.by_n * factor), &frame.n.jacobian);
            }
        }
        field
    };
    Side::BOTH.map(|side| {
        (0..selection.nodes(side))
            .into_par_iter()
            .with_min_len(16)
            .map(|node| at_node(side, SurfaceNode::new(node)))
            .collect()
    })
}
