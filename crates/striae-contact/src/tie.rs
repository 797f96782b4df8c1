//! Rows that tie two surfaces at rest: dual mortar functions over common polygons.
//!
//! With the interpolation functions `N_l` of a facet `e` of the side that follows and `N_m`
//! of the facets opposite to it, over what `e` has in common with them,
//!
//! ```text
//! G_lk = int N_l N_k dA,   C_lm = int N_l N_m dA,   d_l = int N_l dA = sum_k G_lk
//! psi_l = sum_k A_lk N_k,   A = diag(d) G^-1:   int psi_l N_k dA = d_l delta_lk,   sum_l psi_l = 1
//! int psi_l (x_own - x_opposite) dA = d_l x_l - sum_m (A C)_lm x_m
//! ```
//!
//! The functions `psi_l` are Wohlmuth's, "A mortar finite element method using dual spaces for
//! the Lagrange multiplier", SIAM J. Numer. Anal. 38 (2000), doi:10.1137/S0036142999350929,
//! made on what is covered of a facet. As they add up to one, a constant traction is
//! transferred exactly; as both sides are integrated by the same rule, rows vanish for
//! surfaces that lie on each other.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};
use striae_mesh::{FacetId, Vec3};
use striae_surface::{node::SurfaceNode, topology::distinct_corners};

use crate::{
    configuration::{Configuration, Snapshot},
    pairing::{PairedFacets, Scope, paired_facets},
    segment::SegmentDerivatives,
    side::Side,
};

/// Distance over the reach of the larger facet, which is half its size, up to which facets
/// are tied where nothing else is said: a tenth of the facet size.
const NEAR: f64 = 0.2;
/// Covered part of a facet below which it is not tied.
const LEAST_COVER: f64 = 0.01;
/// Covered part of a facet from which it does not count as missing its partner.
const COVERED: f64 = 0.5;

/// Two surfaces at rest and what they have in common.
#[derive(Clone, Debug)]
pub struct Joined {
    near: Vec<PairedFacets>,
    /// Part of every facet that is tied, by side.
    pub cover: [Vec<f64>; 2],
    /// Area of every facet, by side.
    pub areas: [Vec<f64>; 2],
    /// Largest distance of facets that are tied.
    pub gap: f64,
    /// Facets that face each other too far away to be tied, with nothing nearer.
    pub apart: Option<Apart>,
    /// Mean place of what is tied.
    pub centre: Vec3,
}

/// Facets that face each other from afar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Apart {
    /// Distance.
    pub gap: f64,
    /// Distance relative to the size of the larger facet.
    pub share: f64,
    /// Position.
    pub place: Vec3,
}

/// Rows of a facet of the side that follows.
#[derive(Clone, Debug)]
pub struct FacetRows {
    /// Its corners, surface-local.
    pub corners: Vec<SurfaceNode>,
    /// `d_l`.
    pub weights: Vec<f64>,
    /// `d_l` over what it were if all of the facet were covered.
    pub cover: Vec<f64>,
    /// `(A C)_lm` by opposite node, for every corner.
    pub opposite: BTreeMap<SurfaceNode, Vec<f64>>,
}

/// Common segments of two surfaces; facets further apart than `within`, or than a tenth of their
/// size by default, are not tied.
pub fn join(configuration: &Configuration, within: Option<f64>) -> Joined {
    let counts = Side::BOTH.map(|side| configuration.side(side).surface.facets().len());
    let compliances = counts.map(|count| vec![1.0; count]);
    let scope = Scope {
        compliances: &compliances,
        depth: 0.0,
        start: None,
    };
    let paired = paired_facets(configuration, scope, &|_| SegmentDerivatives::None, |_| {
        true
    });
    let areas = Side::BOTH.map(|side| areas(configuration.side(side)));
    let gap = |paired: &PairedFacets| paired.mean_gap(configuration).abs();
    let limit = |paired: &PairedFacets| within.unwrap_or(NEAR * paired.reach);
    let (near, far): (Vec<_>, Vec<_>) = paired
        .into_iter()
        .partition(|paired| gap(paired) <= limit(paired));
    let cover = cover(&near, &areas);
    let missing = |paired: &&PairedFacets| {
        let facets = paired.facets.iter().enumerate();
        let mut bare = facets.filter_map(|(side, facet)| {
            let facet = facet.as_ref()?.index();
            let from_afar = paired.segment.area / areas[side][facet];
            Some(cover[side][facet] < COVERED && from_afar > COVERED)
        });
        bare.any(|bare| bare)
    };
    let apart = far.iter().filter(missing).map(|paired| Apart {
        gap: gap(paired),
        share: 0.5 * gap(paired) / paired.reach,
        place: middle(paired),
    });
    let apart = apart.reduce(|most, other| if other.gap > most.gap { other } else { most });
    let area: f64 = near.iter().map(|paired| paired.segment.area).sum();
    let sum: Vec3 = near.iter().map(|p| middle(p) * p.segment.area).sum();
    Joined {
        gap: near.iter().map(gap).fold(0.0, f64::max),
        apart: apart.filter(|_| within.is_none()),
        centre: sum / area.max(f64::MIN_POSITIVE),
        near,
        cover,
        areas,
    }
}

/// Mean of the corners of both facets.
fn middle(paired: &PairedFacets) -> Vec3 {
    paired.x.iter().sum::<Vec3>() / 8.0
}

fn areas(side: &Snapshot) -> Vec<f64> {
    let area = |facet: usize| {
        let [a, b, c, d] = side.corner_positions(FacetId::new(facet));
        0.5 * (c - a).cross(&(d - b)).norm()
    };
    (0..side.surface.facets().len()).map(area).collect()
}

fn cover(near: &[PairedFacets], areas: &[Vec<f64>; 2]) -> [Vec<f64>; 2] {
    let mut cover = areas.each_ref().map(|areas| vec![0.0; areas.len()]);
    for paired in near {
        for side in Side::BOTH {
            if let Some(facet) = paired.facets[side] {
                cover[side][facet.index()] += paired.segment.area / areas[side][facet.index()];
            }
        }
    }
    cover
}

impl Joined {
    /// Returns whether nothing is tied.
    pub fn is_empty(&self) -> bool {
        self.near.is_empty()
    }

    /// Area that is tied.
    pub fn area(&self) -> f64 {
        self.near.iter().map(|paired| paired.segment.area).sum()
    }

    /// Size of the facets of a side that are tied, the root of their mean area.
    pub fn facet_size(&self, side: Side) -> f64 {
        let tied = self.cover[side].iter().zip(&self.areas[side]);
        let tied: Vec<f64> = tied
            .filter(|(cover, _)| **cover > 0.0)
            .map(|(_, area)| *area)
            .collect();
        (tied.iter().sum::<f64>() / tied.len().max(1) as f64).sqrt()
    }

    /// Rows of the facets of a side, which follows the other one, in the order of the facets.
    pub fn rows(&self, configuration: &Configuration, side: Side) -> Vec<FacetRows> {
        let mut of_facets: BTreeMap<usize, Vec<&PairedFacets>> = BTreeMap::new();
        for paired in &self.near {
            if let Some(facet) = paired.facets[side] {
                of_facets.entry(facet.index()).or_default().push(paired);
            }
        }
        let rows = of_facets.into_iter().filter_map(|(facet, paired)| {
            let corners = configuration.side(side).corners(FacetId::new(facet));
            let is_tied = self.cover[side][facet] >= LEAST_COVER;
            is_tied.then(|| facet_rows(&corners, self.areas[side][facet], &paired, side))?
        });
        rows.collect()
    }
}

/// Rows of a facet; `None` where what is covered of it is too thin for dual functions.
fn facet_rows(
    corners: &[SurfaceNode; 4],
    area: f64,
    paired: &[&PairedFacets],
    side: Side,
) -> Option<FacetRows> {
    let own = distinct_corners(corners);
    let (count, first, first_opposite) = (own.len(), 4 * side.index(), 4 * side.opposite().index());
    let mut gram = DMatrix::<f64>::zeros(count, count);
    let mut common: BTreeMap<SurfaceNode, DVector<f64>> = BTreeMap::new();
    for paired in paired {
        let mass = &paired.segment.mass;
        for l in 0..count {
            for k in 0..count {
                gram[(l, k)] += mass[first + l][first + k];
            }
        }
        let opposite = distinct_corners(&paired.corners[side.opposite()]);
        for (m, node) in opposite.iter().enumerate() {
            let sum = common.entry(*node).or_insert_with(|| DVector::zeros(count));
            for l in 0..count {
                sum[l] += mass[first + l][first_opposite + m];
            }
        }
    }
    let weights: DVector<f64> = gram.column_sum();
    let inverse = gram.cholesky()?;
    let opposite = common.into_iter().map(|(node, column)| {
        let row = inverse.solve(&column).component_mul(&weights);
        (node, row.iter().copied().collect())
    });
    let whole = area / count as f64;
    Some(FacetRows {
        corners: own.to_vec(),
        cover: weights.iter().map(|weight| weight / whole).collect(),
        weights: weights.iter().copied().collect(),
        opposite: opposite.collect(),
    })
}
