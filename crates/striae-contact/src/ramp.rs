//! The ramp: how weakly independent kept nodes fade into transferred ones.
//!
//! With `E` of [`crate::traction_basis`]
//!
//! ```text
//! g_k  += 1/w_k sum_l E_kl p_l
//! du_k += 1/w_k sum_j sum_l R(n_k, s_kl n_l) F^j_kl (tau_l - m_j tau^n_l)
//! m_j   = exp(-(sqrt(|du_j|^2 + d^2) - d)/l)
//! ```
//!
//! where `F^j` is the part of `E` of the weak node `j` with the signs `s_kl` of friction that is
//! handed on, -1 between nodes that face each other, and `m_j` is what `j` remembers of the friction
//! before the increment after its slip `du_j`, without what the ramp adds. At rest the ramp acts on
//! increments of friction: with the total, nodes would creep at constant load. In slip the total
//! counts: with the increment, `E` would hold friction at the rough pattern it had before, push the
//! neighbours of weak nodes to the wrong sign in large slips, and let them stick there. The length
//! `l` is the displacement by which the friction deformed the support of `j`, so that solutions scale
//! with the loads. `d` makes `m_j` smooth at rest; apart from it the memory fades by the same share
//! in one increment of slip and in many.

use nalgebra::Matrix3;
use rayon::prelude::*;
use striae_mesh::Vec3;

use crate::{
    common_mass::SparseRow,
    configuration::Configuration,
    converged_friction::converged_friction,
    frame::{Frame, Frames},
    kinematics::{Kinematics, Presence, Pressure},
    places::ChainedSum,
    selection::Selection,
    slip_freedom::SlipFreedom,
    tracked::{Tracked, TrackedScalar},
    traction::NodalTractions,
    traction_basis::{Weak, coupling},
    transported::Transported,
    unknown::Jacobian,
    unknowns::Tractions,
};

/// `l` over the displacement by which the friction before the increment deforms a support.
const FADING: f64 = 1.0;
/// `d` over `l`.
const REST: f64 = 1e-3;

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
    let touches = kinematics.iter().map(touches).collect();
    let given = given_pressure(touches, selection.coupling(), selection.wear());
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

/// Returns whether a kept node has pressure at points of its support.
fn touches(kinematics: &Kinematics) -> bool {
    match &kinematics.pressure {
        Pressure::AtNode => true,
        Pressure::AtPoints(supported) => supported.touches,
    }
}

/// Kept nodes that are given pressure: by points of their support, by the ramp from others that are,
/// or by what wears off at these, which opens their gap.
fn given_pressure(touches: Vec<bool>, coupling: &[SparseRow], wear: &[SparseRow]) -> Vec<bool> {
    let mut given = touches;
    let mut found: Vec<usize> = (0..given.len()).filter(|&k| given[k]).collect();
    while let Some(k) = found.pop() {
        for &(l, _) in coupling.get(k).into_iter().flatten() {
            if !std::mem::replace(&mut given[l as usize], true) {
                found.push(l as usize);
            }
        }
    }
    let worn = wear.iter();
    let worn = worn.map(|row| row.iter().any(|&(l, _)| given[l as usize]));
    let worn: Vec<bool> = worn.collect();
    given
        .iter_mut()
        .zip(worn)
        .for_each(|(is, worn)| *is |= worn);
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
    /// At the last converged state, turned along.
    before: Tracked,
}

/// Memory of a weak node.
struct Memory<'a> {
    weak: &'a Weak,
    /// `m_j`.
    share: f64,
    /// Its derivative by the slip `du_j`.
    by_slip: Vec3,
    /// Derivatives of `du_j`.
    slip: Jacobian,
}

/// Rows by place among the kept nodes.
type Rows = Vec<Vec<Coupled>>;

/// Entries of a row that one memory has a share in.
type OfMemory<'a> = (&'a Memory<'a>, Vec<Coupled>);

impl Ramp<'_> {
    /// Adds the contribution of the ramp to the slips.
    pub fn add_to_slips(&self, kinematics: &mut [Kinematics]) {
        let memories = self.memories(kinematics);
        let count = self.selection.coupling().len();
        let all = rows(&memories, count, |_| 1.0);
        let remembered = rows(&memories, count, |memory| memory.share);
        let fading = fading(&memories, count);
        let ramped: Vec<Option<Ramped>> = (0..count)
            .into_par_iter()
            .with_min_len(8)
            .map(|k| self.ramped(k, &all[k]))
            .collect();
        kinematics[..count]
            .par_iter_mut()
            .enumerate()
            .with_min_len(8)
            .for_each(|(k, kinematics)| {
                if let Some(own) = &ramped[k]
                    && let Pressure::AtPoints(supported) = &kinematics.pressure
                    && kinematics.presence == Presence::Facing
                {
                    let weight = &supported.weight;
                    let coupling = [all[k].as_slice(), remembered[k].as_slice()];
                    let slip = &mut kinematics.slip;
                    add((own, &ramped), coupling, &fading[k], weight, slip);
                }
            });
    }

    /// Memories of the weak nodes of which friction is determined in all directions, as one that
    /// lacks a direction has no ramp, and of those that follow others.
    fn memories(&self, kinematics: &[Kinematics]) -> Vec<Memory<'_>> {
        let is_whole =
            |weak: &&Weak| self.selection.slip_freedom(weak.kept as usize) == SlipFreedom::Plane;
        let weak = self.selection.ramp().iter().filter(is_whole);
        let weak = weak.chain(&self.selection.following);
        weak.map(|weak| {
            let Kinematics { slip, presence, .. } = &kinematics[weak.kept as usize];
            let length = FADING * self.displacement(weak);
            let rest = REST * length;
            if *presence != Presence::Facing || length == 0.0 {
                return Memory {
                    weak,
                    share: 0.0,
                    by_slip: Vec3::zeros(),
                    slip: Jacobian::new(),
                };
            }
            let path = slip.value.norm().hypot(rest);
            let share = ((rest - path) / length).exp();
            Memory {
                weak,
                share,
                by_slip: slip.value * (-share / (length * path)),
                slip: slip.jacobian.clone(),
            }
        })
        .collect()
    }

    /// Displacement by which the largest friction that a weak node takes part in deformed its support
    /// at the last converged state.
    fn displacement(&self, weak: &Weak) -> f64 {
        let kept = self.selection.kept();
        let friction = weak.row.iter().map(|&(l, _)| {
            let (side, node) = kept[l as usize].place();
            let [first, second] = self.tractions.tau_n[side][node];
            first.hypot(second)
        });
        self.selection.flexibility(weak.kept as usize) * friction.fold(0.0, f64::max)
    }

    fn ramped(&self, k: usize, all: &[Coupled]) -> Option<Ramped<'_>> {
        if all.is_empty() {
            return None;
        }
        let (side, node) = self.selection.kept()[k].place();
        let frame = self.frames[side][node].as_ref()?;
        let components = self.tractions.tau_n[side][node];
        let at = (side, node);
        let before = converged_friction(self.configuration, self.start, at, frame, components);
        Some(Ramped {
            frame,
            friction: &self.tau[side][node],
            before,
        })
    }
}

/// Rows of `sum_j f_j F^j`.
fn rows(memories: &[Memory], count: usize, factor: impl Fn(&Memory) -> f64) -> Rows {
    let scaled = memories
        .iter()
        .map(|memory| (memory.weak, memory.weak.coefficient * factor(memory)));
    let scaled = scaled.filter(|(_, coefficient)| *coefficient != 0.0);
    let pressures = coupling(scaled.clone().map(|(weak, c)| (c, &weak.row)), count);
    let frictions = coupling(scaled.map(|(weak, c)| (c, &weak.friction_row)), count);
    let rows = pressures.iter().zip(frictions);
    rows.map(|(pressures, frictions)| {
        let entries = pressures.iter().zip(frictions);
        entries
            .map(|(pressure, (l, value))| Coupled::new(l, value, pressure.1))
            .collect()
    })
    .collect()
}

/// Rows of each `F^j` whose share changes with the slip.
fn fading<'a>(memories: &'a [Memory<'a>], count: usize) -> Vec<Vec<OfMemory<'a>>> {
    let mut fading: Vec<Vec<OfMemory>> = (0..count).map(|_| Vec::new()).collect();
    for memory in memories.iter().filter(|of| of.by_slip != Vec3::zeros()) {
        let weak = memory.weak;
        let entries = || weak.row.iter().zip(&weak.friction_row);
        for (&(k, of_pressure), &(_, of_friction)) in entries() {
            let row = entries().map(|(&(l, pressure), &(_, friction))| {
                let value = weak.coefficient * of_friction * friction;
                Coupled::new(l, value, of_pressure * pressure)
            });
            fading[k as usize].push((memory, row.collect()));
        }
    }
    fading
}

impl Coupled {
    /// Entry of `F` beside that of `E`, for pressure.
    fn new(l: u32, value: f64, of_pressure: f64) -> Self {
        Self {
            l,
            value,
            facing: match of_pressure * value < 0.0 {
                true => -1.0,
                false => 1.0,
            },
        }
    }
}

/// Adds the row of a node to its slip.
fn add(
    (own, ramped): (&Ramped, &[Option<Ramped>]),
    [all, remembered]: [&[Coupled]; 2],
    fading: &[OfMemory],
    weight: &TrackedScalar,
    slip: &mut Tracked,
) {
    let before = slip.value;
    let mut sum = ChainedSum::onto(&mut slip.jacobian);
    let mut by_n = Matrix3::zeros();
    let turned = |coupled: &Coupled, other: &Ramped, friction: &Tracked| {
        let from = other.frame.n.value * coupled.facing;
        Transported::new(&friction.value, &from, &own.frame.n.value)
    };
    let mut add = |coupled: &Coupled, other: &Ramped, friction: &Tracked, sign: f64| {
        let factor = sign * coupled.value / weight.value;
        let turned = turned(coupled, other, friction);
        slip.value += turned.value * factor;
        by_n += turned.by_n * factor;
        sum.add(&(turned.by_vector * factor), &friction.jacobian);
        let by_from = turned.by_from * (factor * coupled.facing);
        sum.add(&by_from, &other.frame.n.jacobian);
    };
    for coupled in all {
        if let Some(other) = &ramped[coupled.l as usize] {
            add(coupled, other, other.friction, 1.0);
        }
    }
    for coupled in remembered {
        if let Some(other) = &ramped[coupled.l as usize] {
            add(coupled, other, &other.before, -1.0);
        }
    }
    for (memory, row) in fading {
        let parts = row.iter().filter_map(|coupled| {
            let other = ramped[coupled.l as usize].as_ref()?;
            let factor = coupled.value / weight.value;
            Some(turned(coupled, other, &other.before).value * factor)
        });
        let remembered: Vec3 = parts.sum();
        sum.add(&(-remembered * memory.by_slip.transpose()), &memory.slip);
    }
    sum.add(&by_n, &own.frame.n.jacobian);
    drop(sum);
    let by_weight = (before - slip.value) / weight.value;
    for (first, slope) in &weight.gradient {
        slip.jacobian.push((*first, by_weight * slope.transpose()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn to(nodes: &[u32]) -> SparseRow {
        nodes.iter().map(|&node| (node, 1.0)).collect()
    }

    #[test]
    fn pressure_comes_from_points_the_ramp_and_what_wears_off() {
        let touches = vec![true, false, false, false, false];
        let apart = given_pressure(touches.clone(), &[], &[]);
        assert_eq!(apart, touches);
        // A node that has its pressure from the ramp hands it on.
        let coupling = [to(&[0, 1]), to(&[0, 1, 2]), to(&[1, 2]), to(&[3]), to(&[4])];
        let by_ramp = given_pressure(touches.clone(), &coupling, &[]);
        assert_eq!(by_ramp, [true, true, true, false, false]);
        // What wears off at node 0 opens the gap of node 3, which keeps its row; what would wear
        // off at node 4, which is apart, opens none.
        let wear = [to(&[0]), to(&[]), to(&[4]), to(&[0, 3]), to(&[4])];
        let by_wear = given_pressure(touches, &[], &wear);
        assert_eq!(by_wear, [true, false, false, true, false]);
    }
}
