//! Start values of functions of displacement.
//!
//! Conditions move nodes from their present displacement to the target. A function states
//! displacements themselves, so it has to begin at the displacement that the steps before have led
//! to.

use std::collections::BTreeMap;

use pyo3::prelude::*;
use striae::model::{
    Model,
    plan::{Prescription, StepPlan, plans},
};

use crate::{
    fault::model_error,
    step::{Start, Step},
};

/// Differences below this share of the displacements and of their change are round-off.
const ROUND_OFF: f64 = 1e-9;

/// Prescribed displacements by body, node and component; `None` where they are not known.
type Known = BTreeMap<(usize, usize, usize), Option<f64>>;

/// Checks that the functions of the last steps of a model start at the positions of the nodes.
pub fn checked(model: &Model, steps: &[PyRef<'_, Step>]) -> PyResult<()> {
    if steps.iter().all(|step| step.1.is_empty()) {
        return Ok(());
    }
    let first = model.steps.len() - steps.len();
    let mut known = Known::new();
    let mut faults = Vec::new();
    for (number, plan) in plans(model).iter().enumerate() {
        let stated = number.checked_sub(first).map(|at| &steps[at].1);
        for start in stated.into_iter().flatten() {
            let wrong = wrong(model, start, number, &known);
            faults.extend(wrong.map(|text| (format!("steps[{number}]"), text)));
        }
        known = after(model, plan, &known, number);
    }
    match faults.is_empty() {
        true => Ok(()),
        false => Err(model_error(faults)),
    }
}

/// Fault of the start of a function, if any.
fn wrong(model: &Model, start: &Start, step: usize, known: &Known) -> Option<String> {
    let mut bodies = model.bodies.iter().enumerate();
    let (body, found) = bodies.find(|(_, body)| body.name == start.body)?;
    let nodes = found.mesh.node_sets.get(&start.nodes)?;
    let axis = ["x", "y", "z"][start.axis];
    let place = format!("component `{axis}` of {}.{}", start.body, start.nodes);
    for node in nodes {
        let key = (body, node.index(), start.axis);
        let at = match known.get(&key) {
            None if step == 0 => Some(0.0),
            None => None,
            Some(value) => *value,
        };
        let Some(at) = at else {
            return Some(format!(
                "a function leads {place}, but node {} was free before, so its starting value is unknown; state a target and a curve",
                node.index()
            ));
        };
        let size = at.abs() + start.value.abs() + start.change.abs();
        if (at - start.value).abs() > ROUND_OFF * size {
            return Some(format!(
                "the function of {place} begins at {}, but node {} is at {at} at that time",
                start.value,
                node.index()
            ));
        }
    }
    None
}

/// Displacements after a step.
fn after(model: &Model, plan: &StepPlan, before: &Known, step: usize) -> Known {
    let end = plan.end();
    let value = |key: &(usize, usize, usize), how: &Prescription| {
        let x = &model.bodies[key.0].mesh.positions[key.1];
        let start = match before.get(key) {
            None if step == 0 => Some(0.0),
            None => None,
            Some(value) => *value,
        };
        match (how, start) {
            (how, Some(start)) => Some(how.at([0.0, start], x, end)),
            (Prescription::Go { target, curve }, None) if curve.at(end) == 1.0 => {
                Some(target.at(x, end.time))
            }
            _ => None,
        }
    };
    let all = plan.displacements.iter();
    all.map(|(key, how)| (*key, value(key, how))).collect()
}
