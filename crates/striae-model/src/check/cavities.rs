//! Cavities that enclose no volume, and contents that they cannot have.

use crate::{
    cavity::{RimFault, enclosed},
    fault::{Fault, FaultKind},
    model::{CavityContent, CavityFilling, Curve, Model, Procedure},
    path::Path,
    plan::plans,
};
use striae_mesh::{Vec3, place, significant};

use super::{List, distinct};

/// Every fault of the cavities of a model and of their contents. Only whole models have any.
pub fn faults(model: &Model) -> Vec<Fault> {
    let mut faults = List::default();
    let names = model.cavities.iter().map(|cavity| cavity.name.as_str());
    distinct("cavity", "cavities", names, &mut faults);
    for index in 0..model.cavities.len() {
        if let Some(cause) = unsound(model, index) {
            let cavity = model.cavities[index].name.clone();
            let path = Path::part("cavities", index);
            faults.push(path, FaultKind::Cavity { cavity, cause });
        }
    }
    for (at, step) in model.steps.iter().enumerate() {
        for (index, filling) in step.fillings.iter().enumerate() {
            let path = Path::part("steps", at).field("fillings").index(index);
            let mut earlier = step.fillings[..index].iter();
            let cause = match earlier.any(|other| other.cavity == filling.cavity) {
                true => Some("the step states its content twice; remove one of them".to_owned()),
                false => content(filling),
            };
            if let Some(cause) = cause {
                let cavity = model.cavities[filling.cavity.0].name.clone();
                faults.push(path, FaultKind::Cavity { cavity, cause });
            }
        }
    }
    if !model.cavities.is_empty() {
        moving_volumes(model, &mut faults);
    }
    faults.0
}

/// Reason why a surface encloses no volume.
fn unsound(model: &Model, index: usize) -> Option<String> {
    let edge = |[a, b]: [Vec3; 2]| format!("from {} to {}", place(&a), place(&b));
    match enclosed(model, index) {
        Ok(volume) if volume > 0.0 => None,
        Ok(volume) => Some(format!(
            "its faces enclose a volume of {volume}; name faces of the inner side of the bodies, which look into the cavity",
        volume = significant(volume, 4))),
        Err(RimFault::Open(ends)) => Some(format!(
            "its surface ends at the edge {}; add the faces that close it, or, at a plane of symmetry, hold both nodes at zero along one normal of the edge in all steps",
            edge(ends)
        )),
        Err(RimFault::Branched(ends)) => Some(format!(
            "more than two of its faces meet at the edge {}, or two that look to opposite sides; name each face of its surface once",
            edge(ends)
        )),
        Err(RimFault::Planes) => Some(
            "the planes in which its rims are held neither meet in a point nor are those of a slice; close all rims but those at planes of symmetry, or at two parallel planes"
                .to_owned(),
        ),
    }
}

/// Reason why a content is none.
fn content(filling: &CavityFilling) -> Option<String> {
    let told =
        |what: &str, found: f64| Some(format!("its {what} must be positive, but is {found}"));
    let is_positive = |value: f64| value > 0.0 && value.is_finite();
    match filling.content {
        CavityContent::Pressure(pressure) if !pressure.is_finite() => Some(format!(
            "its pressure must be a finite number, but is {pressure}"
        )),
        CavityContent::Volume(volume) if !is_positive(volume) => told("volume", volume),
        CavityContent::VolumeRatio(ratio) if !is_positive(ratio) => told("volume ratio", ratio),
        CavityContent::Gas { ambient, .. } if !is_positive(ambient) => {
            told("ambient pressure", ambient)
        }
        CavityContent::Gas { exponent, .. } if !is_positive(exponent) => told("exponent", exponent),
        CavityContent::Gas { .. } if filling.curve != Curve::Ramp => {
            Some("a gas has no target, so it has no `curve`; remove the curve".to_owned())
        }
        _ => None,
    }
}

/// Notes volumes that are prescribed in steps with inertia.
fn moving_volumes(model: &Model, faults: &mut List) {
    for (at, plan) in plans(model).iter().enumerate() {
        let is_dynamic = model.steps[at].procedure != Procedure::QuasiStatic;
        for (cavity, planned) in model.cavities.iter().zip(&plan.cavities) {
            let is_volume = matches!(
                planned.content,
                CavityContent::Volume(_) | CavityContent::VolumeRatio(_)
            );
            if is_dynamic && is_volume {
                let cause = format!(
                    "its volume is prescribed in step `{}`, which has inertia; state a pressure or a gas there",
                    model.steps[at].name
                );
                let cavity = cavity.name.clone();
                let path = Path::part("steps", at);
                faults.push(path, FaultKind::Cavity { cavity, cause });
            }
        }
    }
}
