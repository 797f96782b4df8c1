//! Wear: material that friction removes from the sides of a pair opens the gap.
//!
//! By Archard (1953, doi:10.1063/1.1721448) a side loses the depth `h = k p |du|` in an increment,
//! with its coefficient of wear over its hardness `k`, an inverse stress. With the pressure and
//! the slip at the kept nodes
//!
//! ```text
//! q_l  = P^_l |du_l|,   P^_l = p_l - r_l/w_l integral phi_l min(g, p_l/r_l) da
//! dw_J = k_s sum_l Z_Jl q_l              depth at the nodes J of side s
//! g_k += sum_l M_kl q_l                  with the rows M of `wear_rows`
//! ```
//!
//! With a coefficient `rho k` across a texture its direction `a` across the grooves counts,
//!
//! ```text
//! |du|  ->  sqrt(|du|^2 + (rho^2 - 1) (a . du)^2)
//! ```
//!
//! `P^_l` is the mean pressure over the support as the points see it, and bounds friction in place
//! of that of [`crate::complementarity`], which is the same where the gap row holds: next to what
//! wears off, `p_l` alone may be far from the pressure. The slip is the one that is seen, without
//! what the ramp adds. `Z` and `M` are those of the start of the increment; what has worn before is
//! part of the gap at points, see [`Selection::worn`].

use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use crate::{
    kinematics::{Kinematics, Presence, Pressure},
    pair::ContactPair,
    places::Places,
    selection::Selection,
    side::Side,
    texture::Textures,
    tracked::{Tracked, TrackedScalar},
    unknown::Gradient,
    unknowns::Tractions,
};

/// Pressure and wear of a kept node over its coefficient.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rate {
    /// `P^_l`.
    pressure: TrackedScalar,
    /// `q_l`.
    wear: TrackedScalar,
    /// `w_l` of the present configuration.
    weight: f64,
}

/// Rates of all kept nodes, from kinematics without ramps; empty for pairs without wear.
pub(crate) fn rates(
    pair: &ContactPair,
    selection: &Selection,
    tractions: &Tractions,
    (kinematics, textures): (&[Kinematics], &Textures),
) -> Vec<Rate> {
    if selection.wear().is_empty() {
        return Vec::new();
    }
    let numbering = pair.numbering();
    let directed = pair.wears_by();
    let across = |side: Side, node: SurfaceNode| {
        let textures = &textures[side][node];
        let a = match directed? == side {
            true => textures.own.as_ref(),
            false => textures.opposite.as_ref(),
        };
        a.map(|a| (pair.wear_across, a))
    };
    let kept = selection.kept().iter().zip(kinematics).enumerate();
    kept.map(|(k, (kept, kinematics))| {
        let (side, node) = kept.place();
        let own = numbering.traction(side, node);
        let p = tractions.nodes[side][node][0];
        let pressure = mean_pressure(kinematics, selection.weight(k), (own, p));
        pressure.map_or_else(Rate::default, |pressure| Rate {
            wear: wear(&pressure, kinematics, across(side, node)),
            weight: kinematics.slip_weight(selection.weight(k)),
            pressure,
        })
    })
    .collect()
}

/// `P^_l` of a node with the unknown `p`; `None` where it faces nothing.
fn mean_pressure(
    kinematics: &Kinematics,
    start: f64,
    (own, p): (u32, f64),
) -> Option<TrackedScalar> {
    let Pressure::AtPoints(supported) = &kinematics.pressure else {
        return None;
    };
    if kinematics.presence == Presence::Gone {
        return None;
    }
    let weight = &supported.weight;
    let factor = supported.bedding * start / weight.value;
    let taken = factor * kinematics.gap.value;
    let mut gradient = vec![(own, Vec3::x())];
    let by_gap = kinematics.gap.gradient.iter();
    gradient.extend(by_gap.map(|(first, slope)| (*first, slope * -factor)));
    let by_weight = taken / weight.value;
    let of_weight = weight.gradient.iter();
    gradient.extend(of_weight.map(|(first, slope)| (*first, slope * by_weight)));
    Some(TrackedScalar {
        value: p - taken,
        gradient,
    })
}

/// `q_l`, with the ratio `rho` of a direction across grooves if there is one; without derivatives
/// where the node does not slip.
fn wear(
    pressure: &TrackedScalar,
    kinematics: &Kinematics,
    across: Option<(f64, &Tracked)>,
) -> TrackedScalar {
    let slip = &kinematics.slip;
    let (more, a) = match across {
        Some((ratio, a)) => (ratio * ratio - 1.0, a.value),
        None => (0.0, Vec3::zeros()),
    };
    let along_a = slip.value.dot(&a);
    let way = (slip.value.norm_squared() + more * along_a * along_a).sqrt();
    if way == 0.0 {
        return TrackedScalar::default();
    }
    let by_slip = (slip.value + a * (more * along_a)) * (pressure.value / way);
    let by_texture = slip.value * (more * along_a * pressure.value / way);
    let of_pressure = pressure.gradient.iter();
    let of_pressure = of_pressure.map(|(first, slope)| (*first, slope * way));
    let of_slip = slip.jacobian.iter();
    let of_slip = of_slip.map(|(first, block)| (*first, block.tr_mul(&by_slip)));
    let of_texture = across.into_iter().flat_map(|(_, a)| &a.jacobian);
    let of_texture = of_texture.map(|(first, block)| (*first, block.tr_mul(&by_texture)));
    TrackedScalar {
        value: pressure.value * way,
        gradient: of_pressure.chain(of_slip).chain(of_texture).collect(),
    }
}

/// Opens the gaps by what wears in the increment, and decides the pressures that bound friction.
pub(crate) fn add_to_gaps(selection: &Selection, rates: &[Rate], kinematics: &mut [Kinematics]) {
    let rows = selection.wear().iter().zip(rates);
    for (kinematics, (row, own)) in kinematics.iter_mut().zip(rows) {
        let worn = combined(row, rates);
        kinematics.gap.value += worn.value;
        kinematics.gap.gradient.extend(&worn.gradient);
        if kinematics.presence != Presence::Gone
            && let Pressure::AtPoints(supported) = &mut kinematics.pressure
        {
            supported.mean = own.pressure.clone();
        }
    }
}

/// `sum_l row_l q_l`, with one slope for each triple.
fn combined(row: &[(u32, f64)], rates: &[Rate]) -> TrackedScalar {
    let mut value = 0.0;
    let mut gradient = Gradient::new();
    let mut places = Places::none();
    for &(l, weight) in row {
        let rate = &rates[l as usize].wear;
        value += weight * rate.value;
        for (first, slope) in &rate.gradient {
            let at = places.find(*first, gradient.len());
            if at == gradient.len() {
                gradient.push((*first, slope * weight));
            } else {
                gradient[at].1 += slope * weight;
            }
        }
    }
    TrackedScalar { value, gradient }
}

/// Wear of both sides in an increment; nothing of pairs without wear.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Worn {
    /// `dw_J` of all nodes, by side; empty for pairs without wear.
    pub depths: [Vec<f64>; 2],
    /// Volumes `k_s sum_l w_l q_l`, with the weights of the present configuration.
    pub volumes: [f64; 2],
}

impl Worn {
    /// From the rates of the kept nodes.
    pub(crate) fn new(pair: &ContactPair, selection: &Selection, rates: &[Rate]) -> Self {
        if rates.is_empty() {
            return Self::default();
        }
        let whole: f64 = rates.iter().map(|rate| rate.weight * rate.wear.value).sum();
        Self {
            depths: Side::BOTH.map(|side| depths(pair, selection, rates, side)),
            volumes: pair.wear.map(|coefficient| coefficient * whole),
        }
    }
}

fn depths(pair: &ContactPair, selection: &Selection, rates: &[Rate], side: Side) -> Vec<f64> {
    let depth = |node: SurfaceNode| {
        let row = selection.row(side, node).iter();
        let rate: f64 = row
            .map(|&(l, weight)| weight * rates[l as usize].wear.value)
            .sum();
        pair.wear[side] * rate
    };
    SurfaceNode::all(selection.nodes(side)).map(depth).collect()
}
