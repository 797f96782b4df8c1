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

use nalgebra::{Matrix3, RowVector3};
use striae_mesh::Vec3;
use striae_surface::facet::Shape;

use crate::{
    configuration::Configuration,
    coverage::Place,
    frame::{FOLLOW, Frame, Frames, LostProjection},
    opposing::{Opposing, PlaceLanes},
    projection::Margin,
    selection::{Leader, Selection},
    term::{Field, Jacobian, Lanes, LocalTerm, Row, Source, add_block},
    texture::Textures,
    traction::NodalTractions,
    transported::Transported,
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

    let [x, n] = [own.x[node as usize], frame.n.value];
    let shape = Shape::of(&corners);
    let opposing = Opposing::new(shape, &hit, &n, &other.corner_positions(hit.facet));
    let pressures = corners.map(|corner| fields.pressure(1 - side, corner));
    let turned = corners.map(|corner| {
        let tau = fields.tau[1 - side][corner as usize].value;
        Transported::new(&tau, &-fields.normal(1 - side, corner), &n)
    });
    let p_b: f64 = (0..4).map(|c| opposing.weights[c] * pressures[c]).sum();
    let tau_b = opposing.sum(&turned);
    // The targets of the rows are `e_1 p + T tau` with `T` of rows `0`, `t_1`, `t_2`.
    let only_pressure = Vec3::x();
    let tangential = components(frame);
    let mut gradient = [[0.0; 3]; LANES];
    let (mut p, mut tau) = (p_b, tau_b);
    let mut by_p_b = only_pressure;
    let mut by_tau_b = tangential;
    if let Some(patch) = patch {
        let geometry = fields.selection.patches[patch as usize];
        let values = fields.tractions.balance[patch as usize];
        let [c, omega] = [0, 3].map(|first| Vec3::from_column_slice(&values[first..first + 3]));
        let arm = (x - geometry.centre) / geometry.radius;
        let q = c + omega.cross(&arm);
        let share = 1.0 - q.dot(&n);
        (p, tau) = (share * p_b, tau_b * share + q * p_b);
        by_p_b = only_pressure * share + tangential * q;
        by_tau_b = tangential * share;
        let by_share = only_pressure * p_b + tangential * tau_b;
        let by_q = tangential * p_b - by_share * n.transpose();
        add_block(
            &mut gradient,
            X,
            &(by_q * omega.cross_matrix() / geometry.radius),
        );
        add_block(&mut gradient, NORMAL, &(by_share * -q.transpose()));
        add_block(&mut gradient, BALANCE, &by_q);
        add_block(&mut gradient, BALANCE + 3, &(by_q * -arm.cross_matrix()));
    }
    let sum_lanes = [NORMAL, N_OPPOSITE, TAU_OPPOSITE];
    let mut by_r = opposing.spread_sum(&by_tau_b, &turned, sum_lanes, &mut gradient);
    for corner in 0..4 {
        by_r += by_p_b * pressures[corner] * opposing.weights_by_r[corner].transpose();
        gradient[P_OPPOSITE + corner] = (by_p_b * opposing.weights[corner]).into();
    }
    let place = PlaceLanes {
        x: X,
        n: NORMAL,
        corners: X_OPPOSITE,
    };
    opposing.spread(&by_r, place, &mut gradient);
    add_tangents(&tau, TANGENTS, &mut gradient);
    gradient
        .iter_mut()
        .flatten()
        .for_each(|slope| *slope = -*slope);
    add_block(&mut gradient, OWN, &Matrix3::identity());
    let unknowns = fields.tractions.nodes[side][node as usize];
    let targets = only_pressure * p + tangential * tau;
    let rows: [Row; 3] = std::array::from_fn(|at| {
        (
            first + at as u32,
            Field::Traction,
            unknowns[at] - targets[at],
        )
    });
    Ok((LocalTerm::from_lanes(&lanes, &rows, &gradient), hit.gap))
}

/// Lanes of the rows of a traction node.
const LANES: usize = 61;
const X: usize = 0;
const NORMAL: usize = 3;
const TANGENTS: usize = 6;
const X_OPPOSITE: usize = 12;
const N_OPPOSITE: usize = 24;
const P_OPPOSITE: usize = 36;
const TAU_OPPOSITE: usize = 40;
const OWN: usize = 52;
const BALANCE: usize = 55;

/// `(0, t1 . v, t2 . v)` of a vector `v`.
fn components(frame: &Frame) -> Matrix3<f64> {
    let [t1, t2] = [0, 1].map(|axis| frame.t[axis].value.transpose());
    Matrix3::from_rows(&[RowVector3::zeros(), t1, t2])
}

/// Derivatives of `(0, t1 . tau, t2 . tau)` by the tangents, six lanes.
fn add_tangents(tau: &Vec3, lane: usize, gradient: &mut [[f64; 3]]) {
    for axis in 0..3 {
        gradient[lane + axis][1] += tau[axis];
        gradient[lane + 3 + axis][2] += tau[axis];
    }
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

    // Seen from the other side normals and tractions turn around.
    let sign = if side == side_k { 1.0 } else { -1.0 };
    let tau_k = fields.tau[side_k][node_k as usize].value;
    let n_k = fields.normal(side_k, node_k);
    let turned = Transported::new(&tau_k, &(n_k * sign), &frame.n.value);
    let tau = turned.value * sign;
    let tangential = components(frame);
    let mut gradient = [[0.0; 3]; 19];
    add_block(&mut gradient, 0, &(tangential * turned.by_n * sign));
    add_tangents(&tau, 3, &mut gradient);
    add_block(&mut gradient, 9, &(tangential * turned.by_from));
    add_block(&mut gradient, 12, &(tangential * turned.by_vector * sign));
    add_block(&mut gradient, 15, &-Matrix3::identity());
    gradient[18] = [1.0, 0.0, 0.0];
    gradient
        .iter_mut()
        .flatten()
        .for_each(|slope| *slope *= -share);
    let unknowns = fields.tractions.nodes[side][node as usize];
    let targets = Vec3::x() * fields.pressure(side_k, node_k) + tangential * tau;
    let rows: [Row; 3] = std::array::from_fn(|at| {
        let residual = (unknowns[at] - targets[at]) * share;
        (first + at as u32, Field::Traction, residual)
    });
    LocalTerm::from_lanes(&lanes, &rows, &gradient)
}
