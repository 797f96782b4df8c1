//! Constants of friction laws from measured friction.

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use striae::{
    declared,
    law::fit::{Reading, Sought, Standing, fit},
    measurements::{self, AngleFrom, Angles, Form, NamedColumn},
};

use crate::{
    array::Array1,
    fault::{model_error, refused},
    friction::Friction,
};

/// Angles of slip and between the textures (radians), friction against and, where it was
/// measured, across slip, spreads, and numbers of the specimens.
type Measured<'py> = (
    PyReadonlyArray1<'py, f64>,
    PyReadonlyArray1<'py, f64>,
    PyReadonlyArray1<'py, f64>,
    Option<PyReadonlyArray1<'py, f64>>,
    PyReadonlyArray1<'py, f64>,
    Vec<usize>,
);

/// Columns as arrays handed to Python.
type Columns<'py> = (
    Array1<'py, f64>,
    Array1<'py, f64>,
    Array1<'py, f64>,
    Option<Array1<'py, f64>>,
    Array1<'py, f64>,
    Vec<String>,
);

/// Name, value and interval of a constant.
type Constant = (String, f64, Option<(f64, f64)>);

/// The law, its constants, the standard deviation of a reading, degrees of freedom, and
/// whether the law is at the bound of what dissipates, and factors of the specimens by number.
type Found = (
    Friction,
    Vec<Constant>,
    Option<f64>,
    usize,
    bool,
    Vec<(usize, f64)>,
);

/// Fits a law that is known by its name in decks, with words of its parameters.
#[pyfunction]
pub fn fit_friction(
    law: &str,
    words: Vec<(String, String)>,
    measured: Measured<'_>,
    level: f64,
) -> PyResult<Found> {
    let needed = || refused("law", "it cannot be fitted");
    let mut sought = Sought::named(law).ok_or_else(needed)?;
    for (name, word) in &words {
        let parameters = sought.law().parameters.iter();
        let mut known = parameters.filter_map(|parameter| match parameter.form {
            declared::Form::Word(words) if parameter.name == name => Some(words),
            _ => None,
        });
        let Some(known) = known.next() else {
            return Err(refused(name, "the law has no such word"));
        };
        let Some((word, _)) = known.iter().find(|(known, _)| known == word) else {
            let known: Vec<String> = known.iter().map(|(word, _)| format!("`{word}`")).collect();
            let message = format!("one of {} is needed, not {word:?}", known.join(", "));
            return Err(refused(name, message));
        };
        sought = sought.with(name, word);
    }
    let (slip, theta, against, across, spread, specimens) = &measured;
    let [slip, theta, against, spread] = [slip, theta, against, spread].map(|one| one.as_array());
    let across = across.as_ref().map(|across| across.as_array());
    let readings = (0..slip.len()).map(|i| Reading {
        slip: slip[i],
        against: against[i],
        across: across.map(|across| across[i]),
        theta: theta[i],
        spread: spread[i],
        specimen: specimens[i],
    });
    let readings: Vec<Reading> = readings.collect();
    let found = fit(&sought, &readings, level).map_err(|error| refused("fit_friction", error))?;
    let constants = found.constants.iter().map(|one| {
        let interval = one.interval.map(|[low, high]| (low, high));
        (one.name.to_string(), one.value, interval)
    });
    let factors = found.specimens.iter().map(|one| (one.number, one.factor));
    Ok((
        Friction(found.friction),
        constants.collect(),
        found.deviation,
        found.degrees_of_freedom,
        found.standing == Standing::AtBound,
        factors.collect(),
    ))
}

/// Angles of slip and between the textures (radians), friction against and, where it was
/// measured, across slip, spreads, and names of the specimens, where the file has them, in the
/// text of a file of measurements; columns as quantity and name.
#[pyfunction]
pub fn measurements_of<'py>(
    py: Python<'py>,
    text: &str,
    file: &str,
    columns: Vec<(String, String)>,
    along: bool,
    skipped: usize,
) -> PyResult<Columns<'py>> {
    let named = columns.iter().map(|(quantity, column)| {
        let named = NamedColumn::new(quantity, column);
        named.map_err(|message| refused("columns", message))
    });
    let form = Form {
        angle_from: match along {
            true => AngleFrom::Along,
            false => AngleFrom::Across,
        },
        angles: Angles::Needed,
        skipped,
        columns: named.collect::<PyResult<_>>()?,
    };
    let measured = measurements::read(text, file, &form).map_err(|faults| {
        let told = faults.faults.into_iter().map(|fault| {
            let at = fault
                .place
                .map_or_else(String::new, |(line, column)| format!(":{line}:{column}"));
            (format!("{file}{at}"), fault.message)
        });
        model_error(told.collect())
    })?;
    let readings = measured.readings;
    let names = match measured.specimens {
        none if none.is_empty() => Vec::new(),
        names => {
            let name = |reading: &Reading| names[reading.specimen].clone();
            readings.iter().map(name).collect()
        }
    };
    let column =
        |value: fn(&Reading) -> f64| PyArray1::from_vec(py, readings.iter().map(value).collect());
    let across: Option<Vec<f64>> = readings.iter().map(|reading| reading.across).collect();
    Ok((
        column(|reading| reading.slip),
        column(|reading| reading.theta),
        column(|reading| reading.against),
        across.map(|across| PyArray1::from_vec(py, across)),
        column(|reading| reading.spread),
        names,
    ))
}
