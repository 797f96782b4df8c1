//! Collocated balance at nodes that are not kinematic.
//!
//! A traction node takes the opposing field at its projection, transported node
//! to node, Jones & Papadopoulos (2006), eq. (43), plus the correction of its patch:
//!
//! ```text
//! p_I   = (1 - q . n_I) p_b
//! tau_I = (1 - q . n_I) tau_b + p_b (I - n n) q,   q = c + omega x (x_I - x_c)/l
//! ```
//!
//! with `p_b = sum N_J p_J` and `tau_b = -sum N_J R(n_I, -n_J) tau_J`: friction changes
//! with the pressure, so that a field that obeys Coulomb's law and slips in one
//! direction still does; `c` and `omega` are the balance unknowns of the
//! patch of radius `l`. An extended node takes the traction of its leader.

use nalgebra::Vector3;
use num_dual::DualSVec64;
use striae_mesh::Vec3;
use striae_surface::{
    facet::Shape,
    scalar::{constant3, cross, dot, scaled},
    transport::transported,
};

use crate::{
    configuration::Configuration,
    coverage::Place,
    frame::{FOLLOW, Frames, LostProjection},
    projection::{Margin, differentiated},
    selection::{Leader, Selection},
    term::{Field, Jacobian, Lanes, LocalTerm, Source, gradient, variable, variable3, variables3},
    texture::Textures,
    traction::NodalTractions,
    unknowns::Tractions,
};

/// What transfer rows look at.
#[derive(Clone, Copy, Debug)]
pub struct Fields<'a> {
    /// Where everything is.
    pub configuration: &'a Configuration<'a>,
    /// Roles.
    pub selection: &'a Selection,
    /// Nodal frames.
    pub frames: &'a Frames,
    /// Unknowns.
    pub tractions: &'a Tractions,
    /// Nodal textures.
    pub textures: &'a Textures,
    /// Nodal friction tractions.
    pub tau: &'a NodalTractions,
}

impl<'a> Fields<'a> {
    /// Appends the lane of the pressure of a node.
    pub fn push_pressure(&self, lanes: &mut Lanes<'a>, side: usize, node: u32) {
        lanes.push(if self.selection.is_active(side, node) {
            Source::Unknowns {
                first: self.configuration.pair.numbering().traction(side, node),
                count: 1,
            }
        } else {
            Source::Constant(1)
        });
    }

    /// Appends the lanes of an intermediate vector of a node that may be idle.
    pub fn push_vector(&self, lanes: &mut Lanes<'a>, jacobian: Option<&'a Jacobian>) {
        lanes.push(jacobian.map_or(Source::Constant(3), Source::Vector));
    }

    /// Normal of a node: of its frame or, for an idle node, of its surface.
    pub fn normal(&self, side: usize, node: u32) -> Vec3 {
        match &self.frames[side][node as usize] {
            Some(frame) => frame.n.value,
            None => self.configuration.side(side).normals[node as usize],
        }
    }

    /// Derivatives of the normal of a node, `None` for an idle one.
    pub fn normal_jacobian(&self, side: usize, node: u32) -> Option<&'a Jacobian> {
        self.frames[side][node as usize]
            .as_ref()
            .map(|frame| &frame.n.jacobian)
    }

    /// Derivatives of the friction traction of a node, `None` for an idle one.
    pub fn tau_jacobian(&self, side: usize, node: u32) -> Option<&'a Jacobian> {
        self.selection
            .is_active(side, node)
            .then(|| &self.tau[side][node as usize].jacobian)
    }

    /// Pressure of a node, zero for an idle one.
    pub fn pressure(&self, side: usize, node: u32) -> f64 {
        if self.selection.is_active(side, node) {
            self.tractions.nodes[side][node as usize][0]
        } else {
            0.0
        }
    }
}

/// Rows of a traction node and its gap.
pub fn traction_rows(
    fields: &Fields,
    side: usize,
    node: u32,
) -> Result<(LocalTerm, f64), LostProjection> {
    const N: usize = 61;
    type D = DualSVec64<N>;
    let Fields { configuration, .. } = *fields;
    let lost = LostProjection { side, node };
    let frame = fields.frames[side][node as usize].as_ref().ok_or(lost)?;
    let (own, other) = (configuration.side(side), configuration.side(1 - side));
    let reach = FOLLOW * configuration.reach(side, node);
    let contact = configuration
        .contact(side, node, reach, Margin::Extrapolated)
        .ok_or(lost)?;
    let Place::Facet(hit) = contact.place else {
        return Err(lost);
    };
    let corners = other.corners(hit.facet);
    let numbering = configuration.pair.numbering();
    let first = numbering.traction(side, node);

    let mut lanes = Lanes::default();
    let position = |side: usize, node: u32| Source::Unknowns {
        first: numbering.position(side, node),
        count: 3,
    };
    lanes.push(position(side, node));
    lanes.push(Source::Vector(&frame.n.jacobian));
    lanes.push(Source::Vector(&frame.t[0].jacobian));
    lanes.push(Source::Vector(&frame.t[1].jacobian));
    for corner in corners {
        lanes.push(position(1 - side, corner));
    }
    for corner in corners {
        fields.push_vector(&mut lanes, fields.normal_jacobian(1 - side, corner));
    }
    for corner in corners {
        fields.push_pressure(&mut lanes, 1 - side, corner);
    }
    for corner in corners {
        fields.push_vector(&mut lanes, fields.tau_jacobian(1 - side, corner));
    }
    lanes.push(Source::Unknowns { first, count: 3 });
    let patch = fields.selection.patch_of[side][node as usize];
    lanes.push(match patch {
        Some(patch) => Source::Unknowns {
            first: numbering.balance(patch as usize),
            count: 6,
        },
        None => Source::Constant(6),
    });

    let x: Vector3<D> = variable3(&own.x[node as usize], 0);
    let n: Vector3<D> = variable3(&frame.n.value, 3);
    let t: [Vector3<D>; 2] = [
        variable3(&frame.t[0].value, 6),
        variable3(&frame.t[1].value, 9),
    ];
    let x_opposite = variables3(&other.corner_positions(hit.facet), 12);
    let n_opposite: [Vector3<D>; 4] = variables3(&corners.map(|c| fields.normal(1 - side, c)), 24);
    let tau_opposite: [Vector3<D>; 4] =
        variables3(&corners.map(|c| fields.tau[1 - side][c as usize].value), 40);
    let shape = Shape::of(&corners);
    let [xi, eta, gap] = differentiated(shape, &hit, &x, &n, &x_opposite);
    let weights = shape.weights(xi, eta).value;
    let mut pressure = D::from_re(0.0);
    let mut tau: Vector3<D> = Vector3::zeros();
    for corner in 0..4 {
        let p: D = variable(fields.pressure(1 - side, corners[corner]), 36 + corner);
        pressure += weights[corner] * p;
        let turned = transported(&tau_opposite[corner], &-n_opposite[corner], &n);
        tau -= scaled(&turned, weights[corner]);
    }
    if let Some(patch) = patch {
        let geometry = fields.selection.patches[patch as usize];
        let values = fields.tractions.balance[patch as usize];
        let c: Vector3<D> = variable3(&Vec3::from_column_slice(&values[..3]), 55);
        let omega: Vector3<D> = variable3(&Vec3::from_column_slice(&values[3..]), 58);
        let arm = scaled(
            &(x - constant3(&geometry.centre)),
            D::from(1.0 / geometry.radius),
        );
        let q = c + cross(&omega, &arm);
        let share = -dot(&q, &n) + 1.0;
        tau = scaled(&tau, share) + scaled(&q, pressure);
        pressure *= share;
    }
    let unknowns = fields.tractions.nodes[side][node as usize];
    let rows = [pressure, dot(&tau, &t[0]), dot(&tau, &t[1])];
    let rows: Vec<_> = (0..3)
        .map(|at| {
            let own: D = variable(unknowns[at], 52 + at);
            let row = own - rows[at];
            (first + at as u32, Field::Traction, row.re, gradient(&row))
        })
        .collect();
    Ok((LocalTerm::from_lanes(&lanes, &rows), gap.re))
}

/// Rows of an extended node, one term a leader, each with its share.
pub fn extended_rows(
    fields: &Fields,
    side: usize,
    node: u32,
    leaders: &[Leader],
) -> Vec<LocalTerm> {
    let share = 1.0 / leaders.len() as f64;
    let term = |leader: &Leader| follower_rows(fields, side, node, *leader, share);
    leaders.iter().map(term).collect()
}

fn follower_rows(fields: &Fields, side: usize, node: u32, leader: Leader, share: f64) -> LocalTerm {
    const N: usize = 19;
    type D = DualSVec64<N>;
    let numbering = fields.configuration.pair.numbering();
    let first = numbering.traction(side, node);
    let (side_k, node_k) = (leader.side, leader.node);
    let (Some(frame), Some(n_jacobian), Some(tau_jacobian)) = (
        fields.frames[side][node as usize].as_ref(),
        fields.normal_jacobian(side_k, node_k),
        fields.tau_jacobian(side_k, node_k),
    ) else {
        unreachable!("extended nodes and their leaders carry traction");
    };
    let mut lanes = Lanes::default();
    lanes.push(Source::Vector(&frame.n.jacobian));
    lanes.push(Source::Vector(&frame.t[0].jacobian));
    lanes.push(Source::Vector(&frame.t[1].jacobian));
    lanes.push(Source::Vector(n_jacobian));
    lanes.push(Source::Vector(tau_jacobian));
    lanes.push(Source::Unknowns { first, count: 3 });
    fields.push_pressure(&mut lanes, side_k, node_k);

    let n: Vector3<D> = variable3(&frame.n.value, 0);
    let t: [Vector3<D>; 2] = [
        variable3(&frame.t[0].value, 3),
        variable3(&frame.t[1].value, 6),
    ];
    let n_k: Vector3<D> = variable3(&fields.normal(side_k, node_k), 9);
    let tau_k: Vector3<D> = variable3(&fields.tau[side_k][node_k as usize].value, 12);
    let tau = if side == side_k {
        transported(&tau_k, &n_k, &n)
    } else {
        -transported(&tau_k, &-n_k, &n)
    };
    let p_k: D = variable(fields.pressure(side_k, node_k), 18);
    let unknowns = fields.tractions.nodes[side][node as usize];
    let targets = [p_k, dot(&tau, &t[0]), dot(&tau, &t[1])];
    let rows: Vec<_> = (0..3)
        .map(|at| {
            let own: D = variable(unknowns[at], 15 + at);
            let row = (own - targets[at]) * share;
            (first + at as u32, Field::Traction, row.re, gradient(&row))
        })
        .collect();
    LocalTerm::from_lanes(&lanes, &rows)
}
