//! Friction laws on the common kernel `-tau = L z + varpi eta`, `|z| <= varpi`, or
//! `|z| <= varpi rho` with `rho` by the direction of `z` for measured coefficients.
//!
//! A [`Friction`] joins a [`Law`] (the shape of the slip surface and the slip
//! rule), a [`Coefficient`] and, if wanted, a cap on the shear stress. It gives
//! the solver two functions: the radius [`Friction::cap`] of the slip surface of `z`
//! and the [`Kernel`] that turns `z` into a traction. Both are generic over
//! dual numbers, so their derivatives are exact. Where coefficients depend on rate and state,
//! [`Friction::creep`] takes the place of the radius.
//!
//! Longer than other files, as it joins all dependences and laws in one type.
//!
//! Conventions: `p >= 0` is compressive; slip is the motion of the surface that
//! carries the point relative to the other one; the traction acts on the
//! surface that carries the point.

mod analysis;
mod basis;
mod battery;
mod by_pressure;
mod by_rate;
mod by_slip;
mod by_state;
mod coefficient;
mod coulomb;
mod creep;
mod ellipse;
mod error;
mod factor;
mod kernel;
mod monotone;
mod nap;
mod oblique;
mod orthotropic;
mod own;
mod periodic;
mod published;
mod slip_sample;
mod slip_surface;
mod star;
mod tabulated;
mod textures;
mod two_textures;

#[cfg(test)]
mod tests;

pub use analysis::Analysis;
pub use basis::{Basis, Direction, Meaning, Sum};
pub use battery::{Violation, battery};
pub use by_pressure::{BY_PRESSURE, FLOOR_OF_ADHESION, FLOOR_OF_POWER_LAW, PressureDependence};
pub use by_rate::{BY_RATE, DECAY, Decay, Logarithm, RateDependence};
pub use by_slip::{BY_SLIP, SlipDependence};
pub use by_state::{BY_STATE, Evolution, Healing, HealingCourse, RateAndState, StateDependence};
pub use coefficient::Coefficient;
pub use creep::{Creep, Past};
pub use ellipse::Ellipse;
pub use error::{FactorFailure, FrictionError};
pub use factor::{
    Factor, FactorBatch, FactorLane, FactorLaw, FactorPoint, FactorPoints, FactorRange,
    LARGEST_STATE, OwnFactor,
};
pub use kernel::Kernel;
pub use nap::Nap;
pub use num_dual::DualNum;
pub use oblique::Oblique;
pub use orthotropic::Orthotropic;
pub use own::{FrictionLaw, Lane, Own};
pub use published::Published;
use serde::Serialize;
pub use slip_sample::{Extremes, SlipRule, SlipSample};
pub use slip_surface::SlipSurface;
pub use star::Star;
pub use tabulated::{Radial, Tabulated};
pub use textures::Textures;
pub use two_textures::{LeastDissipation, TwoTextures};

use error::positive;
use nalgebra::Vector3;
use striae_declared::{Declared, Kind, Statement};

/// The laws that decks, the program and the Python package know by name.
pub static LAWS: &[&Declared<Friction>] = &[
    &coulomb::FRICTIONLESS,
    &coulomb::COULOMB,
    &two_textures::TWO_TEXTURES,
    &orthotropic::ORTHOTROPIC,
    &nap::NAP,
    &tabulated::TABULATED,
];

/// Friction between two surfaces.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Friction {
    law: Law,
    coefficient: Coefficient,
    shear_cap: Option<f64>,
    #[serde(skip)]
    statement: Option<Statement>,
}

impl Kind for Friction {
    type Refusal = FrictionError;
    type Fit = Basis;

    fn with_statement(self, statement: Statement) -> Self {
        let statement = Some(statement);
        Self { statement, ..self }
    }

    fn statement(&self) -> Option<&Statement> {
        self.statement.as_ref()
    }
}

/// Shape of the slip surface, and slip rule.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Law {
    /// No friction.
    Frictionless,
    /// Isotropic Coulomb friction.
    Coulomb,
    /// Two textured surfaces.
    TwoTextures(TwoTextures),
    /// One textured surface, two coefficients.
    Orthotropic(Orthotropic),
    /// One textured surface with a nap, three coefficients.
    Nap(Nap),
    /// One textured surface, coefficients at many angles.
    Tabulated(Tabulated),
    /// A law from outside the crate.
    Own(Own),
}

impl Law {
    /// The name of the law in decks, or the one it has given itself.
    pub fn name(&self) -> &str {
        match self {
            Self::Frictionless => "frictionless",
            Self::Coulomb => "coulomb",
            Self::TwoTextures(_) => "two-textures",
            Self::Orthotropic(_) => "orthotropic",
            Self::Nap(_) => "nap",
            Self::Tabulated(_) => "tabulated",
            Self::Own(own) => own.law().name(),
        }
    }

    fn required_textures(&self) -> RequiredTextures {
        match self {
            Self::Frictionless | Self::Coulomb => RequiredTextures::Any,
            Self::Orthotropic(_) | Self::Nap(_) | Self::Tabulated(_) => RequiredTextures::One,
            Self::TwoTextures(_) => RequiredTextures::Both,
            Self::Own(own) => own.law().required_textures(),
        }
    }
}

/// Surfaces, of the two, that must carry a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RequiredTextures {
    /// Textures have no effect.
    Any,
    /// Exactly one of the two surfaces.
    One,
    /// Both surfaces.
    Both,
}

impl RequiredTextures {
    /// Surfaces that must carry a texture, where another number of them does.
    pub fn unmet(self, found: usize) -> Option<&'static str> {
        match self {
            Self::One if found != 1 => Some("one side"),
            Self::Both if found != 2 => Some("both sides"),
            Self::Any | Self::One | Self::Both => None,
        }
    }
}

impl Friction {
    /// A law from outside the crate, scaled with the coefficient `mu`; see [`FrictionLaw`].
    ///
    /// # Errors
    /// When `mu` is negative, or friction would create energy for some textures and some
    /// slip direction.
    pub fn own(law: impl FrictionLaw + 'static, mu: f64) -> Result<Self, FrictionError> {
        let coefficient = Coefficient::constant(mu)?;
        Ok(Self::new(Law::Own(Own::new(law)?), coefficient))
    }

    /// Lets all coefficients depend on the pressure; see [`PressureDependence`].
    pub fn with_pressure(self, by_pressure: PressureDependence) -> Self {
        let coefficient = self.coefficient.with_pressure(by_pressure);
        Self {
            coefficient,
            ..self
        }
    }

    /// Lets all coefficients depend on the slip rate, and not on a state; see
    /// [`RateDependence`].
    pub fn with_rate(self, by_rate: RateDependence) -> Self {
        let coefficient = self.coefficient.with_rate(by_rate);
        Self {
            coefficient,
            ..self
        }
    }

    /// Lets all coefficients depend on the accumulated slip; see [`SlipDependence`].
    pub fn with_slip(self, by_slip: SlipDependence) -> Self {
        let coefficient = self.coefficient.with_slip(by_slip);
        Self {
            coefficient,
            ..self
        }
    }

    /// Lets all coefficients depend on slip rate and state, in place of a dependence on the slip
    /// rate alone; see [`StateDependence`].
    pub fn with_state(self, by_state: StateDependence) -> Self {
        let coefficient = self.coefficient.with_state(by_state);
        Self {
            coefficient,
            ..self
        }
    }

    /// Lets all coefficients have a factor of one's own, in place of a dependence on slip rate and
    /// state; see [`FactorLaw`].
    ///
    /// # Errors
    /// When the factor needs textures of other surfaces than the law.
    pub fn with_factor(self, factor: OwnFactor) -> Result<Self, FrictionError> {
        let [law, of_factor] = [
            self.law.required_textures(),
            factor.law().required_textures(),
        ];
        let any = RequiredTextures::Any;
        if law != of_factor && law != any && of_factor != any {
            return Err(FrictionError::FactorTextures {
                factor: factor.law().name().to_owned(),
                law: self.law.name().to_owned(),
            });
        }
        Ok(Self {
            coefficient: self.coefficient.with_factor(factor),
            // It does not tell the factor.
            statement: None,
            ..self
        })
    }

    /// Factors of the coefficients at points, by healing or of one's own, if there is one.
    ///
    /// # Errors
    /// When it is negative or not finite, or a law has failed.
    pub fn factors(&self, points: &FactorPoints) -> Result<Option<Vec<Factor>>, FactorFailure> {
        let law = self.factor();
        law.map(|law| factor::sound_factors(law, points))
            .transpose()
    }

    /// Factor by healing or of one's own, if there is one.
    pub fn factor(&self) -> Option<&dyn FactorBatch> {
        let law = self.coefficient.factor();
        law.filter(|_| !self.is_frictionless())
    }

    /// Lets all coefficients decay exponentially with the slip rate, from the stated values
    /// at rest to `kinetic_over_static` times them; see [`Decay`].
    ///
    /// # Errors
    /// When the ratio is negative or the rate is not positive.
    pub fn with_decay(self, kinetic_over_static: f64, rate: f64) -> Result<Self, FrictionError> {
        let values = [
            ("kinetic_over_static", kinetic_over_static),
            ("slip_rate", rate),
        ];
        Ok(self.with_rate(DECAY.made(&values.into())?))
    }

    /// Bounds the radius of the slip surface: `varpi = min(mu R(v) W(s) P(p), tau_max)`.
    ///
    /// # Errors
    /// When the bound is not positive.
    pub fn with_shear_cap(self, tau_max: f64) -> Result<Self, FrictionError> {
        let shear_cap = Some(positive("shear_cap", tau_max)?);
        Ok(Self { shear_cap, ..self })
    }

    /// The law.
    pub fn law(&self) -> &Law {
        &self.law
    }

    /// The coefficient of friction the law is scaled with.
    pub fn coefficient(&self) -> &Coefficient {
        &self.coefficient
    }

    /// Returns whether the reach of `z` depends on its direction; see [`Kernel::reach`].
    pub fn turns(&self) -> bool {
        matches!(self.law, Law::Tabulated(_))
    }

    /// Returns whether there is none, at any pressure and slip rate.
    pub fn is_frictionless(&self) -> bool {
        self.coefficient.at_rest() == 0.0
    }

    /// Returns whether `varpi` depends on the slip rate.
    pub fn depends_on_rate(&self) -> bool {
        let course = self.coefficient.course();
        self.coefficient.by_rate().is_some() || course.is_some_and(|course| course.goes_with_rate)
    }

    /// Returns whether an increment needs a duration: friction has a state, or a factor that depends
    /// on the slip of the increment or its rate.
    pub fn evolves(&self) -> bool {
        let has_state = |factor: &dyn FactorBatch| !factor.initial_state().is_empty();
        let course = self.coefficient.course();
        self.rate_and_state().is_some()
            || self.factor().is_some_and(has_state)
            || course.is_some_and(|course| course.goes_with_rate)
    }

    /// Returns whether `varpi` falls with the slip rate anywhere.
    pub fn weakens(&self) -> bool {
        let course = self.coefficient.course();
        self.weakest_rate().is_some() || course.is_some_and(|course| course.falls)
    }

    /// Smallest and largest coefficient at rest over all directions of slip and, with textures on
    /// both surfaces, over all angles between them, at no pressure and without slip so far.
    pub fn range(&self) -> [f64; 2] {
        const DIRECTIONS: usize = 360;
        const ANGLES: usize = 37;
        let angles = match self.required_textures() {
            RequiredTextures::Both => ANGLES,
            RequiredTextures::Any | RequiredTextures::One => 1,
        };
        let at_rest = self.coefficient.at_slip_rate(0.0);
        let surfaces = (0..angles).map(|at| std::f64::consts::PI * at as f64 / (ANGLES - 1) as f64);
        let sizes = surfaces.flat_map(|theta| {
            let samples = self.slip_surface(theta).sampled(DIRECTIONS);
            samples.into_iter().map(|sample| sample.traction.norm())
        });
        let range = sizes.fold([f64::INFINITY, 0.0], |[low, high], size| {
            [low.min(size), high.max(size)]
        });
        range.map(|size: f64| at_rest * size)
    }

    /// Coefficient that is not exceeded in any direction, at any pressure, slip and slip rate;
    /// infinite where there is no such bound.
    pub fn largest_coefficient(&self) -> f64 {
        let [_, largest] = self.range();
        let coefficient = &self.coefficient;
        let by_pressure = coefficient.by_pressure().largest_factor();
        largest * self.largest_over_rest() * by_pressure * coefficient.by_slip().largest_factor()
    }

    /// Largest `varpi` over that at rest.
    pub fn largest_over_rest(&self) -> f64 {
        let course = self.coefficient.course();
        let of_factor = course.map_or(1.0, |course| course.largest_over_rest);
        self.coefficient.by_rate().largest_over_rest() * of_factor
    }

    /// The slip rate at which `R` has fallen most, if it falls anywhere.
    pub fn weakest_rate(&self) -> Option<f64> {
        self.coefficient.by_rate().weakest_rate()
    }

    /// The bound on `varpi`, if any.
    pub fn shear_cap(&self) -> Option<f64> {
        self.shear_cap
    }

    /// Surfaces that must carry a texture for [`Friction::kernel`] to exist.
    pub fn required_textures(&self) -> RequiredTextures {
        match (self.law.required_textures(), self.coefficient.own()) {
            (RequiredTextures::Any, Some(factor)) => factor.law().required_textures(),
            (textures, _) => textures,
        }
    }

    /// Radius of the slip surface of `z`, over its reach: `varpi = mu R(v) P(p)`, at most
    /// the shear cap, and zero where the pressure is not compressive. Without accumulated slip, and
    /// in steady slip if coefficients depend on a state.
    ///
    /// Kinks, with one-sided derivatives taken on the side the value lies on: at
    /// `p = 0`, where friction meets the cap, and at the ends of tables, floors and limits of
    /// [`PressureDependence`] and [`RateDependence`].
    pub fn cap<D: DualNum<Primitive = f64> + Copy>(&self, pressure: D, slip_rate: D) -> D {
        self.cap_after(0.0, pressure, slip_rate)
    }

    /// The bound after an accumulated slip `s >= 0`: `varpi = mu R(v) W(s) P(p)`.
    pub fn cap_after<D: DualNum<Primitive = f64> + Copy>(
        &self,
        slip: f64,
        pressure: D,
        slip_rate: D,
    ) -> D {
        if pressure.re() <= 0.0 {
            return D::zero();
        }
        self.capped(self.coefficient.bound(pressure, slip_rate, slip))
    }

    /// The bound with a factor `F` at this pressure and slip rate:
    /// `varpi = mu R(v) W(s) P(p) F`.
    pub fn cap_with<D: DualNum<Primitive = f64> + Copy>(
        &self,
        slip: f64,
        pressure: D,
        slip_rate: D,
        factor: D,
    ) -> D {
        if pressure.re() <= 0.0 {
            return D::zero();
        }
        let bound = self
            .coefficient
            .bound_with(pressure, slip_rate, slip, factor);
        self.capped(bound)
    }

    /// `varpi` up to the shear cap.
    fn capped<D: DualNum<Primitive = f64> + Copy>(&self, varpi: D) -> D {
        match self.shear_cap {
            Some(tau_max) if varpi.re() > tau_max => D::from(tau_max),
            _ => varpi,
        }
    }

    /// The law at a point with the unit normal `n` of the surface that carries it, and
    /// the unit textures there.
    ///
    /// # Panics
    /// When the textures are not those the law requires; see
    /// [`Friction::required_textures`].
    pub fn kernel<D: DualNum<Primitive = f64> + Copy>(
        &self,
        normal: &Vector3<D>,
        textures: &Textures<D>,
    ) -> Kernel<'_, D> {
        const ONE: &str = "exactly one surface has a texture";
        let only = || textures.only().expect(ONE);
        match &self.law {
            Law::Frictionless | Law::Coulomb => coulomb::kernel(),
            Law::TwoTextures(law) => {
                let (own, opposite) = textures.both().expect("both surfaces have a texture");
                law.kernel(&own, &opposite)
            }
            Law::Orthotropic(law) => law.kernel(&only()),
            Law::Nap(law) => law.kernel(&only()),
            Law::Tabulated(law) => law.kernel(textures.only_axes(normal).expect(ONE)),
            Law::Own(own) => own.kernel(normal, textures),
        }
    }

    /// The slip surface over `varpi` for textures at the angle `theta` (radians),
    /// which has no effect on laws for a single texture.
    pub fn slip_surface(&self, theta: f64) -> SlipSurface {
        SlipSurface::Ellipse(match &self.law {
            Law::Frictionless | Law::Coulomb => coulomb::slip_surface(),
            Law::TwoTextures(law) => law.slip_surface(theta),
            Law::Orthotropic(law) => law.slip_surface(),
            Law::Nap(law) => law.slip_surface(),
            Law::Tabulated(law) => return SlipSurface::Star(law.slip_surface()),
            Law::Own(own) => {
                let surface = own.slip_surface(theta);
                return SlipSurface::Oblique(surface.expect("the law was judged when it was made"));
            }
        })
    }

    fn new(law: Law, coefficient: Coefficient) -> Self {
        Self {
            law,
            coefficient,
            shear_cap: None,
            statement: None,
        }
    }
}
