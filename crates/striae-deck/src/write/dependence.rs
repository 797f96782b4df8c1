//! Dependence of coefficients of friction on pressure, slip rate and accumulated slip.

use striae_law::friction::{
    Coefficient, Decay, Logarithm, PressureConstants, RateConstants, SlipConstants,
};

use super::value::{list, number};

/// The keys of the dependences of a coefficient, each after a comma.
pub(super) fn keys(coefficient: &Coefficient) -> String {
    let by_pressure = by_pressure(&coefficient.by_pressure().constants());
    let by_rate = by_rate(&coefficient.by_rate().constants());
    let by_slip = by_slip(&coefficient.by_slip().constants());
    [by_pressure, by_rate, by_slip]
        .into_iter()
        .flatten()
        .collect()
}

fn by_pressure(constants: &PressureConstants) -> Option<String> {
    let (form, keys) = match *constants {
        PressureConstants::None => return None,
        PressureConstants::PowerLaw {
            exponent,
            pressure,
            floor,
        } => {
            let keys = [
                ("exponent", exponent),
                ("pressure", pressure),
                ("floor", floor),
            ];
            ("power-law", constants_of(&keys))
        }
        PressureConstants::Adhesion { pressure, floor } => (
            "adhesion",
            constants_of(&[("pressure", pressure), ("floor", floor)]),
        ),
        PressureConstants::Saturation { shear_stress } => (
            "saturation",
            constants_of(&[("shear_stress", shear_stress)]),
        ),
        PressureConstants::Table(points) => ("table", table("pressures", points)),
    };
    Some(format!(", by_pressure = {{ form = \"{form}\"{keys} }}"))
}

fn by_rate(constants: &RateConstants) -> Option<String> {
    let (form, keys) = match *constants {
        RateConstants::None => return None,
        RateConstants::Decay(decay) => {
            let Decay {
                kinetic_over_static,
                slip_rate,
                exponent,
                viscous,
            } = decay;
            if [exponent, viscous] == [1.0, 0.0] {
                let [ratio, rate] = [kinetic_over_static, slip_rate].map(number);
                return Some(format!(
                    ", decay = {{ kinetic_over_static = {ratio}, slip_rate = {rate} }}"
                ));
            }
            let keys = [
                ("kinetic_over_static", kinetic_over_static),
                ("slip_rate", slip_rate),
                ("exponent", exponent),
                ("viscous", viscous),
            ];
            ("stribeck", constants_of(&keys))
        }
        RateConstants::Logarithm(Logarithm {
            factor,
            slip_rate,
            limit,
        }) => {
            let mut keys = vec![("factor", factor), ("slip_rate", slip_rate)];
            keys.extend(limit.map(|limit| ("limit", limit)));
            ("logarithm", constants_of(&keys))
        }
        RateConstants::Table(points) => ("table", table("slip_rates", points)),
    };
    Some(format!(", by_slip_rate = {{ form = \"{form}\"{keys} }}"))
}

fn by_slip(constants: &SlipConstants) -> Option<String> {
    let (form, keys) = match *constants {
        SlipConstants::None => return None,
        SlipConstants::Exponential {
            final_over_initial,
            slip,
        } => {
            let keys = [("final_over_initial", final_over_initial), ("slip", slip)];
            ("exponential", constants_of(&keys))
        }
        SlipConstants::Table(points) => ("table", table("slips", points)),
    };
    Some(format!(
        ", by_accumulated_slip = {{ form = \"{form}\"{keys} }}"
    ))
}

fn constants_of(keys: &[(&str, f64)]) -> String {
    let keys = keys.iter();
    keys.map(|(key, value)| format!(", {key} = {}", number(*value)))
        .collect()
}

fn table(places: &str, points: &[[f64; 2]]) -> String {
    let [at, factors] = [0, 1].map(|column| list(points.iter().map(|point| number(point[column]))));
    format!(", {places} = {at}, factors = {factors}")
}
