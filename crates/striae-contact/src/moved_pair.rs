//! Actions of the unknowns of a pair on the positions that it moves.
//!
//! With the positions `J`, `P_J` that removes their prescribed components and `kappa_J` of
//! [`crate::roles`], the unknowns of a kept node `k` act by the columns
//!
//! ```text
//! pressure   f_Jk  = sqrt(kappa_J) P_J sum_segments (+-) D_kJ n                / sqrt(w_k l_k)
//! friction   f_Jka = sqrt(kappa_J) P_J sum_segments (+-) D_kJ R(n, n_k) t_a    / sqrt(w_k l_k)
//! D_kJ = integral phi_k N_J
//! ```
//!
//! Numbers of positions are common to all pairs, so products of columns of different pairs tell how
//! far their unknowns do the same.

use std::collections::BTreeMap;

use nalgebra::Matrix3;
use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use crate::{
    configuration::Configuration,
    frame::frame_of,
    pairing::{Corners, SIGNS, paired_facets},
    patch::kept_on,
    segment::SegmentDerivatives,
    selection::Selection,
    side::Side,
    transported::Transported,
};

/// Gap up to which a node touches, over the size of its segments.
const TOUCHING: f64 = 1e-6;
/// Square of the free part of a unit vector below which a node is prescribed along it, and weight
/// of such nodes above which a point is.
pub(crate) const MOSTLY: f64 = 0.5;

/// A position that contact moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mover {
    /// Number of the node, equal in all pairs.
    pub number: u32,
    /// Components that are prescribed.
    pub prescribed: [bool; 3],
    /// Axes of the components in columns, where they are not the coordinate axes.
    pub axes: Option<Matrix3<f64>>,
    /// Motion in the increment along the prescribed components; `None` if others move it.
    pub motion: Option<Vec3>,
}

impl Mover {
    /// Motion along a unit vector; `None` unless it is prescribed.
    pub(crate) fn imposed(&self, c: &Vec3) -> Option<f64> {
        let motion = self.motion?;
        (!self.is_free(c)).then(|| motion.dot(c))
    }

    /// Returns whether displacements leave most of the direction of a unit vector.
    pub(crate) fn is_free(&self, c: &Vec3) -> bool {
        (self.free() * c).norm_squared() >= MOSTLY
    }

    /// Returns whether nothing moves it but displacements.
    pub(crate) fn is_rigid(&self) -> bool {
        self.prescribed == [true; 3]
    }

    /// Projection to the directions that are not prescribed.
    pub(crate) fn free(&self) -> Matrix3<f64> {
        let free = self.prescribed.map(|held| f64::from(u8::from(!held)));
        let along_axes = Matrix3::from_diagonal(&free.into());
        match self.axes {
            Some(axes) => axes * along_axes * axes.transpose(),
            None => along_axes,
        }
    }
}

/// A pair, its traction field and the positions that it moves.
pub struct MovedPair<'a> {
    /// Configuration of the pair.
    pub configuration: &'a Configuration<'a>,
    /// Roles.
    pub selection: &'a Selection,
    /// The nodes of the deformable sides.
    pub movers: [Vec<Mover>; 2],
}

/// Action of an unknown on positions, by their numbers.
pub(crate) type Column = BTreeMap<u32, Vec3>;

/// Product of two columns.
pub(crate) fn product(a: &Column, b: &Column) -> f64 {
    let common = a
        .iter()
        .filter_map(|(number, a)| Some(a.dot(b.get(number)?)));
    common.sum()
}

/// Actions of the unknowns of a kept node: pressure, then friction along both tangents.
#[derive(Clone, Default)]
pub(crate) struct Actions {
    /// By number of the mover, with prescribed components.
    pub whole: BTreeMap<u32, [Vec3; 3]>,
    /// Projections to what is free of the movers.
    free: BTreeMap<u32, Matrix3<f64>>,
    /// `D_kJ`.
    masses: BTreeMap<u32, f64>,
    /// A segment of the node touches.
    pub touches: bool,
}

impl Actions {
    /// The part of an action that moves anything.
    pub fn column(&self, component: usize) -> Column {
        let free =
            |(number, whole): (&u32, &[Vec3; 3])| (*number, self.free[number] * whole[component]);
        self.whole.iter().map(free).collect()
    }

    /// `D_kJ`.
    pub fn masses(&self) -> impl Iterator<Item = (u32, f64)> {
        self.masses.iter().map(|(number, mass)| (*number, *mass))
    }

    /// `D_kJ` of the movers that are mostly free along a unit vector.
    pub fn responding(&self, c: Vec3) -> impl Iterator<Item = (u32, f64)> {
        let responds = move |number: u32| (self.free[&number] * c).norm_squared() >= MOSTLY;
        self.masses().filter(move |(number, _)| responds(*number))
    }
}

impl MovedPair<'_> {
    /// Actions of the kept nodes.
    pub(crate) fn actions(&self) -> Vec<Actions> {
        let (configuration, selection) = (self.configuration, self.selection);
        let kept = selection.kept();
        let normals: Vec<_> = kept
            .iter()
            .map(|kept| frame_of(configuration, kept.side, kept.node))
            .collect();
        let mut actions = vec![Actions::default(); kept.len()];
        let none = |_: &[Corners]| SegmentDerivatives::None;
        for paired in paired_facets(configuration, selection.scope(), &none, |_| true) {
            let n = paired.segment.normal;
            let corners: Vec<_> = (0..8)
                .filter_map(|corner| Some((corner, paired.node(configuration, corner)?)))
                .collect();
            let touches = paired.least_gap(configuration) <= TOUCHING * paired.segment.area.sqrt();
            for on_segment in kept_on(configuration, selection, &paired) {
                let k = on_segment.k as usize;
                actions[k].touches |= touches;
                let frame = &normals[k];
                let turned = |axis: usize| {
                    let t = &frame.t[axis].value;
                    Transported::new(t, &(frame.n.value * on_segment.sign), &n).value
                };
                let directions = [turned(0), turned(1)];
                let scale = selection.weight(k) * selection.basis.flexibility[k];
                for &(corner, (side, node)) in &corners {
                    let mover = &self.movers[side][node];
                    let kappa = kappa(configuration, side, node);
                    let by = SIGNS[corner] * (kappa / scale).sqrt();
                    let mass = &paired.segment.mass[corner];
                    let integral = |shares: &[f64; 8]| -> f64 {
                        let shares = shares.iter().zip(mass);
                        shares.map(|(share, m)| share * m).sum()
                    };
                    let mass = integral(&on_segment.shares);
                    if scale == 0.0 || mass == 0.0 || mover.is_rigid() {
                        continue;
                    }
                    let [pressure, friction] = [mass, integral(&on_segment.slips)].map(|m| by * m);
                    *actions[k].masses.entry(mover.number).or_default() += mass;
                    let whole = actions[k].whole.entry(mover.number).or_default();
                    whole[0] += n * pressure;
                    for (sum, direction) in whole[1..].iter_mut().zip(&directions) {
                        *sum += direction * friction;
                    }
                    actions[k].free.insert(mover.number, mover.free());
                }
            }
        }
        actions
    }
}

/// `1/(E h)` at a node.
fn kappa(configuration: &Configuration, side: Side, node: SurfaceNode) -> f64 {
    (configuration.pair.sides[side].stiffness * configuration.size(side, node)).recip()
}
