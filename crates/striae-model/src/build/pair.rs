//! Contact pairs.

use crate::{
    fault::Fault,
    model::{ContactSurface, Curve, Enforcement, Initial, InterferenceFit, Pair},
    path::Path,
};
use striae_law::friction::Friction;
use striae_surface::texture::Paint;

use super::lookup::Names;

/// A side of a pair; see [`surface`], [`rigid`] and [`itself`].
#[derive(Clone, Debug)]
pub struct SideBuilder {
    owner: Owner,
    texture: Option<Paint>,
}

#[derive(Clone, Debug)]
enum Owner {
    Body { body: String, facets: String },
    Rigid(String),
    Itself,
}

/// A facet set of a deformable body.
pub fn surface(body: impl Into<String>, facets: impl Into<String>) -> SideBuilder {
    SideBuilder {
        owner: Owner::Body {
            body: body.into(),
            facets: facets.into(),
        },
        texture: None,
    }
}

/// A rigid surface.
pub fn rigid(name: impl Into<String>) -> SideBuilder {
    SideBuilder {
        owner: Owner::Rigid(name.into()),
        texture: None,
    }
}

/// Side `a` once more, as side `b`: facets of a body that may touch each other.
pub fn itself() -> SideBuilder {
    SideBuilder {
        owner: Owner::Itself,
        texture: None,
    }
}

impl SideBuilder {
    /// Paints a texture on the side at rest.
    pub fn textured(mut self, paint: Paint) -> Self {
        self.texture = Some(paint);
        self
    }

    pub(super) fn resolved(
        &self,
        path: &Path,
        names: &Names<'_>,
        faults: &mut Vec<Fault>,
    ) -> Option<ContactSurface> {
        match &self.owner {
            Owner::Body { body, facets } => {
                let (body, faces) = names.faces(body, facets, path, faults)?;
                Some(ContactSurface::Deformable { body, faces })
            }
            Owner::Rigid(name) => names.rigid(name, path, faults).map(ContactSurface::Rigid),
            Owner::Itself => Some(ContactSurface::Itself),
        }
    }
}

/// The sides `a` and `b` of a pair or a tie at a path; faults of both are reported.
pub(super) fn sides(
    [a, b]: &[SideBuilder; 2],
    path: &Path,
    names: &Names<'_>,
    faults: &mut Vec<Fault>,
) -> Option<[ContactSurface; 2]> {
    let a = a.resolved(&path.clone().field("a"), names, faults);
    let b = b.resolved(&path.clone().field("b"), names, faults);
    Some([a?, b?])
}

/// A contact pair; see [`pair`].
#[derive(Clone, Debug)]
pub struct PairBuilder {
    name: String,
    sides: [SideBuilder; 2],
    friction: Friction,
    enforcement: Enforcement,
    search_distance: Option<f64>,
    initial: Initial,
    interference: Option<InterferenceFit>,
    wear: [f64; 2],
    wear_across: f64,
    stabilised: bool,
    feature_angle: Option<f64>,
}

/// Two surfaces that may touch, without friction. At least one is of a deformable body.
pub fn pair(name: impl Into<String>, a: SideBuilder, b: SideBuilder) -> PairBuilder {
    PairBuilder {
        name: name.into(),
        sides: [a, b],
        friction: Friction::frictionless(),
        enforcement: Enforcement::Weighted,
        search_distance: None,
        initial: Initial::AsMeshed,
        interference: None,
        wear: [0.0; 2],
        wear_across: 1.0,
        stabilised: false,
        feature_angle: None,
    }
}

impl PairBuilder {
    /// Friction from the start; steps may change it.
    pub fn friction(mut self, friction: Friction) -> Self {
        self.friction = friction;
        self
    }

    /// Sets the enforcement of contact.
    pub fn enforcement(mut self, enforcement: Enforcement) -> Self {
        self.enforcement = enforcement;
        self
    }

    /// Sets the distance within which contact is searched.
    pub fn search_distance(mut self, distance: f64) -> Self {
        self.search_distance = Some(distance);
        self
    }

    /// Sets the treatment of initial gaps and overlaps of the meshes.
    pub fn initial(mut self, initial: Initial) -> Self {
        self.initial = initial;
        self
    }

    /// Interference between faces that are taken as touching at the start, along a curve over the
    /// first step; negative for a clearance.
    pub fn interference(mut self, value: f64, curve: Curve) -> Self {
        self.interference = Some(InterferenceFit { value, curve });
        self
    }

    /// Sets the coefficients of wear of the sides `a` and `b` over their hardness: the depth that
    /// wears off per pressure and slip, an inverse stress.
    pub fn wear(mut self, a: f64, b: f64) -> Self {
        self.wear = [a, b];
        self
    }

    /// Sets the coefficients of wear across a texture over those along it, which [`Self::wear`]
    /// states: of the texture of side `a`, or of `b` where `a` has none.
    pub fn wear_across(mut self, ratio: f64) -> Self {
        self.wear_across = ratio;
        self
    }

    /// Lets viscous forces carry bodies across gaps.
    pub fn stabilised(mut self) -> Self {
        self.stabilised = true;
        self
    }

    /// Dihedral angle in degrees from which on an edge separates faces, each of which has a
    /// normal and a traction of its own there.
    pub fn feature_angle(mut self, degrees: f64) -> Self {
        self.feature_angle = Some(degrees);
        self
    }

    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// The pair; a rigid surface becomes side `b`.
    pub(super) fn resolved(
        &self,
        index: usize,
        names: &Names<'_>,
        faults: &mut Vec<Fault>,
    ) -> Option<Pair> {
        let [mut a, mut b] = sides(&self.sides, &Path::part("pairs", index), names, faults)?;
        let mut textures = self.sides.each_ref().map(|side| side.texture.clone());
        let mut wear = self.wear;
        match (&a, &b) {
            (_, ContactSurface::Itself) => {}
            (ContactSurface::Rigid(_), _) => {
                std::mem::swap(&mut a, &mut b);
                textures.reverse();
                wear.reverse();
            }
            _ => {}
        }
        Some(Pair {
            name: self.name.clone(),
            a,
            b,
            textures,
            friction: self.friction.clone(),
            enforcement: self.enforcement,
            search_distance: self.search_distance,
            initial: self.initial,
            interference: self.interference.clone(),
            wear,
            wear_across: self.wear_across,
            stabilised: self.stabilised,
            feature_angle: self.feature_angle,
        })
    }
}
