//! The ramp: how weakly independent kept nodes fade into transferred ones.
//!
//! With `E` of [`crate::traction_basis`]
//!
//! ```text
//! g_k  += 1/w_k sum_l E_kl p_l
//! du_k += 1/w_k sum_l R(n_k, s_kl n_l) (F_kl tau_l - F'_kl tau^n_l)
//! ```
//!
//! where `F` is `E` with the signs `s_kl` of friction that is handed on, -1 between nodes that face
//! each other, and `F'` is the part of `E` of the weak nodes that stuck at the last converged state.
//! With the increment of friction these do not creep. Where a weak node slips the total counts:
//! with the increment, `E` would hold friction at the rough pattern it had before, push the
//! neighbours of weak nodes to the wrong sign in large slips, and let them stick there.

use nalgebra::Matrix3;
use rayon::prelude::*;
use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use crate::{
    configuration::Configuration,
    converged_friction::{CollapsedFacets, converged_friction},
    frame::{Frame, Frames},
    kinematics::{Kinematics, Presence, Pressure},
    places::ChainedSum,
    selection::Selection,
    side::Side,
    slip_freedom::SlipFreedom,
    tracked::{Tracked, TrackedScalar},
    traction::NodalTractions,
    traction_basis::coupling,
    transported::Transported,
    unknowns::Tractions,
};

/// Adds what the ramp does to the gaps, and decides the pressures that bound friction:
/// `P^_k = p_k + r_k (E p)_k/w_k`.
pub fn add_to_gaps(
    configuration: &Configuration,
    selection: &Selection,
    tractions: &Tractions,
    kinematics: &mut [Kinematics],
) {
    let kept = selection.kept();
    let numbering = configuration.pair.numbering();
    let pressure = |l: u32| {
        let (side, node) = kept[l as usize].place();
        tractions.nodes[side][node][0]
    };
    let given = given_pressure(selection, kinematics);
    for (k, kinematics) in kinematics.iter_mut().enumerate() {
        let row: &[(u32, f64)] = selection.coupling().get(k).map_or(&[], Vec::as_slice);
        let sum: f64 = row
            .iter()
            .map(|&(l, coupling)| coupling * pressure(l))
            .sum();
        let by_pressures = |share: f64| {
            row.iter().map(move |&(l, coupling)| {
                let l = kept[l as usize];
                (
                    numbering.traction(l.side, l.node),
                    Vec3::x() * (coupling * share),
                )
            })
        };
        let share = 1.0 / selection.weight(k);
        kinematics.gap.value += share * sum;
        kinematics.gap.gradient.extend(by_pressures(share));
        let Pressure::AtPoints(supported) = &mut kinematics.pressure else {
            continue;
        };
        if kinematics.presence == Presence::Gone {
            continue;
        }
        let own = numbering.traction(kept[k].side, kept[k].node);
        supported.mean = TrackedScalar {
            value: pressure(k as u32),
            gradient: vec![(own, Vec3::x())],
        };
        if !given[k] {
            kinematics.presence = Presence::Apart;
        }
        let factor = supported.bedding / supported.weight.value;
        supported.mean.value += factor * sum;
        let by_weight = -factor * sum / supported.weight.value;
        let weight = supported.weight.gradient.iter();
        let by_weight = weight.map(|(first, slope)| (*first, slope * by_weight));
        supported.mean.gradient.extend(by_weight);
        supported.mean.gradient.extend(by_pressures(factor));
    }
}

/// Kept nodes that are given pressure: by points of their support, or by the ramp from others that
/// are.
fn given_pressure(selection: &Selection, kinematics: &[Kinematics]) -> Vec<bool> {
    let touches = |kinematics: &Kinematics| match &kinematics.pressure {
        Pressure::AtNode => true,
        Pressure::AtPoints(supported) => supported.touches,
    };
    let mut given: Vec<bool> = kinematics.iter().map(touches).collect();
    let mut found: Vec<usize> = (0..given.len()).filter(|&k| given[k]).collect();
    while let Some(k) = found.pop() {
        for &(l, _) in selection.coupling().get(k).into_iter().flatten() {
            if !std::mem::replace(&mut given[l as usize], true) {
                found.push(l as usize);
            }
        }
    }
    given
}

/// Quantities that the slips of the ramp depend on.
#[derive(Clone, Copy)]
pub struct Ramp<'a> {
    /// Configuration of the pair.
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

/// Entry of a row of `F`.
#[derive(Clone, Copy)]
struct Coupled {
    l: u32,
    /// `F_kl`.
    value: f64,
    /// `s_kl`.
    facing: f64,
}

/// Friction of a kept node that the ramp acts on.
struct Ramped<'a> {
    frame: &'a Frame,
    friction: &'a Tracked,
    /// At the last converged state, turned along; none where no weak node around it stuck.
    before: Option<Tracked>,
}

impl Ramp<'_> {
    /// Adds the contribution of the ramp to the slips.
    ///
    /// # Errors
    /// If the facets around a node had collapsed to a line.
    pub fn add_to_slips(&self, kinematics: &mut [Kinematics]) -> Result<(), CollapsedFacets> {
        let all = self.coupling_of(|_| true);
        let stuck = self.coupling_of(|(side, node)| self.tractions.stuck[side][node]);
        let found: Vec<_> = (0..all.len())
            .into_par_iter()
            .with_min_len(8)
            .map(|k| self.ramped(k, &all[k], &stuck[k]))
            .collect();
        let found: Result<Vec<Option<Ramped>>, _> =
            found.into_iter().map(Option::transpose).collect();
        let ramped = found?;
        kinematics[..all.len()]
            .par_iter_mut()
            .enumerate()
            .with_min_len(8)
            .for_each(|(k, kinematics)| {
                if let Some(own) = &ramped[k]
                    && let Pressure::AtPoints(supported) = &kinematics.pressure
                    && kinematics.presence == Presence::Facing
                {
                    let weight = &supported.weight;
                    let coupling = [all[k].as_slice(), stuck[k].as_slice()];
                    self.add(own, &ramped, coupling, weight, &mut kinematics.slip);
                }
            });
        Ok(())
    }

    /// Rows of `F` by those weak nodes at these places of which friction is determined in all
    /// directions: one that lacks a direction has no ramp.
    fn coupling_of(&self, counts: impl Fn((Side, SurfaceNode)) -> bool) -> Vec<Vec<Coupled>> {
        let kept = self.selection.kept();
        let weak = self.selection.ramp().iter().filter(|weak| {
            let k = weak.kept as usize;
            self.selection.slip_freedom(k) == SlipFreedom::Plane && counts(kept[k].place())
        });
        let count = self.selection.coupling().len();
        let pressures = coupling(
            weak.clone().map(|weak| (weak.coefficient, &weak.row)),
            count,
        );
        let frictions = coupling(
            weak.map(|weak| (weak.coefficient, &weak.friction_row)),
            count,
        );
        let coupled = |(pressure, friction): (&(u32, f64), (u32, f64))| Coupled {
            l: friction.0,
            value: friction.1,
            facing: match pressure.1 * friction.1 < 0.0 {
                true => -1.0,
                false => 1.0,
            },
        };
        let rows = pressures.iter().zip(frictions);
        rows.map(|(pressures, frictions)| pressures.iter().zip(frictions).map(coupled).collect())
            .collect()
    }

    fn ramped(
        &self,
        k: usize,
        all: &[Coupled],
        stuck: &[Coupled],
    ) -> Option<Result<Ramped<'_>, CollapsedFacets>> {
        if all.is_empty() {
            return None;
        }
        let (side, node) = self.selection.kept()[k].place();
        let frame = self.frames[side][node].as_ref()?;
        let before = (!stuck.is_empty()).then(|| {
            let components = self.tractions.tau_n[side][node];
            let at = (side, node);
            converged_friction(self.configuration, self.start, at, frame, components)
        });
        Some(before.transpose().map(|before| Ramped {
            frame,
            friction: &self.tau[side][node],
            before,
        }))
    }

    fn add(
        &self,
        own: &Ramped,
        ramped: &[Option<Ramped>],
        [all, stuck]: [&[Coupled]; 2],
        weight: &TrackedScalar,
        slip: &mut Tracked,
    ) {
        let before = slip.value;
        let mut sum = ChainedSum::onto(&mut slip.jacobian);
        let mut by_n = Matrix3::zeros();
        let mut add = |other: &Ramped, friction: &Tracked, value: f64, facing: f64| {
            let factor = value / weight.value;
            let from = other.frame.n.value * facing;
            let turned = Transported::new(&friction.value, &from, &own.frame.n.value);
            slip.value += turned.value * factor;
            by_n += turned.by_n * factor;
            sum.add(&(turned.by_vector * factor), &friction.jacobian);
            let by_from = turned.by_from * (factor * facing);
            sum.add(&by_from, &other.frame.n.jacobian);
        };
        for coupled in all {
            if let Some(other) = &ramped[coupled.l as usize] {
                add(other, other.friction, coupled.value, coupled.facing);
            }
        }
        for coupled in stuck {
            if let Some(other) = &ramped[coupled.l as usize]
                && let Some(before) = &other.before
            {
                add(other, before, -coupled.value, coupled.facing);
            }
        }
        sum.add(&by_n, &own.frame.n.jacobian);
        drop(sum);
        let by_weight = (before - slip.value) / weight.value;
        for (first, slope) in &weight.gradient {
            slip.jacobian.push((*first, by_weight * slope.transpose()));
        }
    }
}
