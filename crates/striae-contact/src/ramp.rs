//! The ramp: how weakly independent kept nodes fade into transferred ones.
//!
//! With `E` of [`crate::traction_basis`]
//!
//! ```text
//! g_k  += 1/w_k sum_l E_kl p_l
//! du_k += 1/w_k sum_l E_kl R(n_k, n_l) (tau_l - tau^n_l)
//! ```
//!
//! Of the friction it takes the increment, so that sticking nodes do not creep.

use nalgebra::Matrix3;
use rayon::prelude::*;
use striae_mesh::Vec3;

use crate::{
    configuration::Configuration,
    converged_friction::{CollapsedFacets, converged_friction},
    frame::{Frame, Frames},
    kinematics::Kinematics,
    pairing::side_sign,
    places::ChainedSum,
    selection::Selection,
    tracked::Tracked,
    traction::NodalTractions,
    transported::Transported,
    unknowns::Tractions,
};

/// Adds what the ramp does to the gaps, which depend on positions only before.
pub fn add_to_gaps(
    configuration: &Configuration,
    selection: &Selection,
    tractions: &Tractions,
    kinematics: &mut [Kinematics],
) {
    let kept = selection.kept();
    for weak in selection.ramp() {
        let pressure = |&(l, weight): &(u32, f64)| {
            let (side, node) = kept[l as usize].place();
            weight * tractions.nodes[side][node][0]
        };
        let jump: f64 = weak.row.iter().map(pressure).sum();
        for &(k, weight) in &weak.row {
            let share = weak.coefficient * weight / selection.weight(k as usize);
            kinematics[k as usize].gap.value += share * jump;
        }
    }
    let numbering = configuration.pair.numbering();
    for (k, row) in selection.coupling().iter().enumerate() {
        let slopes = row.iter().map(|&(l, coupling)| {
            let l = kept[l as usize];
            let slope = Vec3::x() * (coupling / selection.weight(k));
            (numbering.traction(l.side, l.node), slope)
        });
        kinematics[k].gap.gradient.extend(slopes);
    }
}

/// What the slips of the ramp depend on.
#[derive(Clone, Copy)]
pub struct Ramp<'a> {
    /// Where everything is.
    pub configuration: &'a Configuration<'a>,
    /// The last converged configuration.
    pub start: &'a Configuration<'a>,
    /// Roles.
    pub selection: &'a Selection,
    /// Nodal frames.
    pub frames: &'a Frames,
    /// Unknowns.
    pub tractions: &'a Tractions,
    /// Friction tractions of the kept nodes.
    pub tau: &'a NodalTractions,
}

/// Friction that a kept node has gained in the increment.
struct Gained<'a> {
    sign: f64,
    frame: &'a Frame,
    friction: Tracked,
}

impl Ramp<'_> {
    /// Adds what the ramp does to the slips.
    ///
    /// # Errors
    /// Where the facets around a node had collapsed to a line.
    pub fn add_to_slips(&self, kinematics: &mut [Kinematics]) -> Result<(), CollapsedFacets> {
        let coupling = self.selection.coupling();
        let found: Vec<_> = (0..coupling.len())
            .into_par_iter()
            .with_min_len(8)
            .map(|k| self.gained(k))
            .collect();
        let gained: Result<Vec<Option<Gained>>, _> =
            found.into_iter().map(Option::transpose).collect();
        let gained = gained?;
        kinematics[..coupling.len()]
            .par_iter_mut()
            .enumerate()
            .with_min_len(8)
            .for_each(|(k, kinematics)| {
                if let Some(own) = &gained[k] {
                    self.add(k, own, &gained, &mut kinematics.slip);
                }
            });
        Ok(())
    }

    /// `tau - tau^n'` of a node that the ramp acts on.
    fn gained(&self, k: usize) -> Option<Result<Gained<'_>, CollapsedFacets>> {
        if self.selection.coupling()[k].is_empty() {
            return None;
        }
        let (side, node) = self.selection.kept()[k].place();
        let frame = self.frames[side][node].as_ref()?;
        let (configuration, start) = (self.configuration, self.start);
        let old = self.tractions.tau_n[side][node];
        let old = converged_friction(configuration, start, (side, node), frame, old);
        Some(old.map(|old| {
            let mut friction = self.tau[side][node].clone();
            friction.value -= old.value;
            let mut sum = ChainedSum::onto(&mut friction.jacobian);
            sum.add(&-Matrix3::identity(), &old.jacobian);
            Gained {
                sign: side_sign(side),
                frame,
                friction,
            }
        }))
    }

    fn add(&self, k: usize, own: &Gained, gained: &[Option<Gained>], slip: &mut Tracked) {
        let n = own.frame.n.value;
        let mut sum = ChainedSum::onto(&mut slip.jacobian);
        let mut by_n = Matrix3::zeros();
        for &(l, coupling) in &self.selection.coupling()[k] {
            let Some(other) = &gained[l as usize] else {
                continue;
            };
            // Normals and frictions of nodes of different sides point against each other.
            let facing = other.sign * own.sign;
            let factor = coupling / self.selection.weight(k) * facing;
            let from = other.frame.n.value * facing;
            let turned = Transported::new(&other.friction.value, &from, &n);
            slip.value += turned.value * factor;
            by_n += turned.by_n * factor;
            sum.add(&(turned.by_vector * factor), &other.friction.jacobian);
            let by_from = turned.by_from * (factor * facing);
            sum.add(&by_from, &other.frame.n.jacobian);
        }
        sum.add(&by_n, &own.frame.n.jacobian);
    }
}
