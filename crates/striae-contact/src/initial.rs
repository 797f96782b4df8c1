//! Initial fit of the sides of a pair: gaps and overlaps before any motion.
//!
//! ```text
//! gap > 0:  distance from the nearest point of the other side, for points that face it
//! gap < 0:  depth inside the other side, see [`crate::interference`]
//! ```
//!
//! A point faces the other side if `n . n_other < -.2` and it is not beyond its edge.

mod faces;
pub mod facing;

use rayon::prelude::*;
use striae_mesh::Vec3;

pub use faces::{Faces, overlaps};

use crate::{
    interference::{
        Interference, Nearest, Spot, Stage, Standing, inside, nearest_of, normal_at, position,
        spots,
    },
    sagitta,
    segment::FACING,
    side::Side,
};

/// Initial fit of two sides.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The smallest gap; `None` where the sides do not face each other.
    pub gap: Option<Opening>,
    /// The deepest overlap for its facet size.
    pub overlap: Option<Interference>,
    /// Mean error of the overlap as facets are chords of curved surfaces, over the mean overlap
    /// of the surfaces.
    pub chords: f64,
    /// Distance of the sides where they are nearest, whatever faces what.
    pub distance: f64,
    /// Position of side `a` relative to a rigid side.
    pub lies: Lies,
}

impl Fit {
    /// Fit of sides between which their own body may lie. It states neither gaps nor overlaps.
    pub const WITHIN_A_BODY: Self = Self {
        gap: None,
        overlap: None,
        chords: 0.0,
        distance: f64::INFINITY,
        lies: Lies::InFront,
    };
}

/// Position of side `a` relative to a rigid side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lies {
    /// Some of it is in front, or the other side is not rigid.
    InFront,
    /// All of it is behind.
    Behind,
}

/// A gap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opening {
    /// Side of the point.
    pub side: Side,
    /// The point.
    pub spot: Spot,
    /// Position of the point.
    pub point: Vec3,
    /// Its distance.
    pub gap: f64,
}

/// Initial fit of the sides of a pair.
pub fn fit(stage: &Stage) -> Fit {
    if stage.configuration.pair.is_in_one_body() {
        return Fit::WITHIN_A_BODY;
    }
    let seen: Vec<Seen> = sides(stage)
        .flat_map(|side| {
            let spots = spots(stage.configuration.side(side).surface);
            let seen: Vec<Seen> = spots
                .into_par_iter()
                .with_min_len(16)
                .filter_map(|spot| seen(stage, side, spot))
                .collect();
            seen
        })
        .collect();
    let gaps = seen
        .iter()
        .filter(|seen| seen.faces)
        .map(|seen| seen.opening);
    let distances = seen.iter().map(|seen| seen.opening.gap);
    let of_a = || seen.iter().filter(|seen| seen.opening.side == Side::A);
    let all_behind = of_a().all(|seen| seen.standing == Standing::Behind);
    let overlaps = inside(stage, 0.0).into_iter();
    let overlap = overlaps.reduce(|a, b| if b.share() > a.share() { b } else { a });
    let chords = overlap
        .as_ref()
        .map_or(0.0, |overlap| sagitta::share(stage, overlap.depth));
    Fit {
        gap: gaps.reduce(|a, b| if b.gap < a.gap { b } else { a }),
        overlap,
        chords,
        distance: distances.fold(f64::INFINITY, f64::min),
        lies: if stage.configuration.pair.is_rigid() && all_behind && of_a().next().is_some() {
            Lies::Behind
        } else {
            Lies::InFront
        },
    }
}

/// View of the other side from a point.
struct Seen {
    opening: Opening,
    standing: Standing,
    /// `true` if the point is in front of the facet it sees and faces it.
    faces: bool,
}

fn sides(stage: &Stage) -> impl Iterator<Item = Side> {
    let sides = stage.configuration.sides.each_ref().map(Option::is_some);
    Side::BOTH.into_iter().filter(move |&side| sides[side])
}

fn seen(stage: &Stage, side: Side, spot: Spot) -> Option<Seen> {
    let own = stage.configuration.side(side);
    let point = position(own, spot);
    let nearest = match stage.configuration.plane() {
        Some(plane) => on_plane(&point, &plane),
        None => nearest_of(stage.configuration.side(side.opposite()), &point)?,
    };
    let cosine = normal_at(own, spot).dot(&nearest.normal);
    Some(Seen {
        opening: Opening {
            side,
            spot,
            point,
            gap: nearest.distance,
        },
        standing: nearest.standing,
        faces: nearest.standing == Standing::Front && cosine < FACING,
    })
}

fn on_plane(x: &Vec3, (point, normal): &(Vec3, Vec3)) -> Nearest {
    let height = (x - point).dot(normal);
    Nearest {
        facet: striae_mesh::FacetId(0),
        point: x - normal * height,
        normal: *normal,
        distance: height.abs(),
        standing: if height < 0.0 {
            Standing::Behind
        } else {
            Standing::Front
        },
    }
}
