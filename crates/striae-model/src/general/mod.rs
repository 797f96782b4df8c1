//! Contact of everything with everything: statements by names, lowered to pairs.
//!
//! ```text
//! skins of bodies - tied facets -> atoms: facets that all statements name alike
//! couple of atoms {x, y}, x = y included, not both rigid
//!     in a named pair       -> nothing: that pair has it
//!     narrowest rule        -> nothing where it excludes, else its friction
//!     no rule               -> the friction of all
//! couples of two owners with one law -> products of sides (x.. times y..), x.. with itself
//! ```
//!
//! A rule is narrower than another one if the couples that it names are some of those of the
//! other one; rules of which neither is narrower may not name the same couple,
//! unless all of them leave it out.

mod atom;
mod label;
mod lowered;
mod name;
mod paint;
mod product;
mod rule;
mod scene;
mod taken;

pub use lowered::{Lowered, Origin};

use crate::model::Initial;
use striae_law::friction::Friction;
use striae_surface::texture::Paint;

/// Dihedral angle in degrees from which on an edge separates faces, where nothing else is said.
pub const FEATURE_ANGLE: f64 = 45.0;

/// Contact of every surface with every surface, itself included; see [`everything`].
///
/// Surfaces have labels: the name of a body, that of a rigid surface, or that of a body and of
/// one of its facet sets, `tread.zmin`.
#[derive(Clone, Debug)]
pub struct Everything {
    friction: Friction,
    excluded: Vec<(String, Option<String>)>,
    between: Vec<(String, String, Friction)>,
    surfaces: Vec<(String, Paint)>,
    feature_angle: f64,
    search_distance: Option<f64>,
    initial: Initial,
    stabilised: bool,
}

/// Contact of all skins of bodies and all rigid surfaces with each other and of each body with
/// itself, without friction. Facets of pairs that have names, and facets that are tied, are
/// left to these.
pub fn everything() -> Everything {
    Everything {
        friction: Friction::frictionless(),
        excluded: Vec::new(),
        between: Vec::new(),
        surfaces: Vec::new(),
        feature_angle: FEATURE_ANGLE,
        search_distance: None,
        initial: Initial::AsMeshed,
        stabilised: false,
    }
}

impl Everything {
    /// Friction where nothing narrower is said; steps may change that of each pair.
    pub fn friction(mut self, friction: Friction) -> Self {
        self.friction = friction;
        self
    }

    /// Friction between two surfaces; of several statements the narrowest counts.
    pub fn between(
        mut self,
        a: impl Into<String>,
        b: impl Into<String>,
        friction: Friction,
    ) -> Self {
        self.between.push((a.into(), b.into(), friction));
        self
    }

    /// Leaves a surface out, whatever it meets.
    pub fn exclude(mut self, surface: impl Into<String>) -> Self {
        self.excluded.push((surface.into(), None));
        self
    }

    /// Leaves out that two surfaces meet; a body and itself, if they are one.
    pub fn exclude_between(mut self, a: impl Into<String>, b: impl Into<String>) -> Self {
        self.excluded.push((a.into(), Some(b.into())));
        self
    }

    /// Paints a texture on a surface at rest, for laws that need one.
    pub fn textured(mut self, surface: impl Into<String>, paint: Paint) -> Self {
        self.surfaces.push((surface.into(), paint));
        self
    }

    /// Dihedral angle in degrees from which on an edge separates faces, each of which has a
    /// normal and a traction of its own there.
    pub fn feature_angle(mut self, degrees: f64) -> Self {
        self.feature_angle = degrees;
        self
    }

    /// Sets the distance within which contact is searched.
    pub fn search_distance(mut self, distance: f64) -> Self {
        self.search_distance = Some(distance);
        self
    }

    /// Treatment of gaps and overlaps of the meshes of different bodies.
    pub fn initial(mut self, initial: Initial) -> Self {
        self.initial = initial;
        self
    }

    /// Lets viscous forces carry bodies across gaps.
    pub fn stabilised(mut self) -> Self {
        self.stabilised = true;
        self
    }
}
