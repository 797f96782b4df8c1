//! Dependence of coefficients of friction on pressure, slip rate and accumulated slip.
//!
//! Results are `None` if a constant could not be read; its fault has been noted.

use crate::{
    raw,
    read::At,
    value::{All, NonNegative, Positive},
};
use striae_law::friction::{
    Decay, FrictionError, Logarithm, PressureDependence, RateDependence, SlipDependence,
};

/// Exponent of Stribeck's curve where none is given.
const EXPONENT: f64 = 2.0;

/// A dependence on the pressure.
pub(super) fn by_pressure(
    raw: &raw::ByPressure,
) -> Option<Result<PressureDependence, FrictionError>> {
    Some(match raw {
        raw::ByPressure::PowerLaw(law) => PressureDependence::power_law(
            law.exponent.as_ref()?.value.0,
            law.pressure.as_ref()?.value.0,
            law.floor.as_ref().map(|floor| floor.value.0),
        ),
        raw::ByPressure::Adhesion(law) => PressureDependence::adhesion(
            law.pressure.as_ref()?.value.0,
            law.floor.as_ref().map(|floor| floor.value.0),
        ),
        raw::ByPressure::Saturation(law) => {
            PressureDependence::saturation(law.shear_stress.as_ref()?.value.0)
        }
        raw::ByPressure::Table(table) => {
            PressureDependence::table(&places(&table.pressures)?, &factors(&table.factors)?)
        }
    })
}

/// A dependence on the slip rate.
pub(super) fn by_rate(raw: &raw::BySlipRate) -> Option<Result<RateDependence, FrictionError>> {
    Some(match raw {
        raw::BySlipRate::Stribeck(curve) => RateDependence::decay(Decay {
            kinetic_over_static: curve.kinetic_over_static.as_ref()?.value.0,
            slip_rate: curve.slip_rate.as_ref()?.value.0,
            exponent: curve.exponent.as_ref().map_or(EXPONENT, |d| d.value.0),
            viscous: curve.viscous.as_ref().map_or(0.0, |k| k.value.0),
        }),
        raw::BySlipRate::Logarithm(law) => RateDependence::logarithm(Logarithm {
            factor: law.factor.as_ref()?.value.0,
            slip_rate: law.slip_rate.as_ref()?.value.0,
            limit: law.limit.as_ref().map(|limit| limit.value.0),
        }),
        raw::BySlipRate::Table(table) => {
            RateDependence::table(&places(&table.slip_rates)?, &factors(&table.factors)?)
        }
    })
}

/// A dependence on the accumulated slip.
pub(super) fn by_slip(
    raw: &raw::ByAccumulatedSlip,
) -> Option<Result<SlipDependence, FrictionError>> {
    Some(match raw {
        raw::ByAccumulatedSlip::Exponential(law) => SlipDependence::exponential(
            law.final_over_initial.as_ref()?.value.0,
            law.slip.as_ref()?.value.0,
        ),
        raw::ByAccumulatedSlip::Table(table) => {
            SlipDependence::table(&places(&table.slips)?, &factors(&table.factors)?)
        }
    })
}

fn places(list: &Option<At<All<NonNegative>>>) -> Option<Vec<f64>> {
    Some(list.as_ref()?.value.0.iter().map(|place| place.0).collect())
}

fn factors(list: &Option<At<All<Positive>>>) -> Option<Vec<f64>> {
    let list = list.as_ref()?.value.0.iter();
    Some(list.map(|factor| factor.0).collect())
}
