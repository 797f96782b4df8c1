//! Densities where there is inertia or gravity.

use crate::{
    fault::FaultKind,
    model::{Procedure, Step},
    path::Path,
};

use super::{Draft, List, Positions};

/// Notes every material without density in the first step that needs it.
pub(super) fn check(draft: &Draft<'_>, partial: &Positions, faults: &mut List) {
    let needs = |step: &Step| step.gravity.is_some() || step.procedure != Procedure::QuasiStatic;
    let mut steps = draft.steps.iter().enumerate();
    let first = steps.find(|(index, of)| !partial.contains(index) && needs(of.step));
    let Some((index, of)) = first else { return };
    for body in &draft.bodies {
        let own = body.density == Some(0.0);
        let own = own.then(|| "its material".to_owned());
        let sections = body.sections.iter().filter(|of| of.density == 0.0);
        let sections = sections.map(|of| format!("the material of its section `{}`", of.set));
        for material in own.into_iter().chain(sections) {
            let kind = FaultKind::NoDensity {
                body: body.name.into(),
                material,
                step: of.step.name.clone(),
            };
            faults.push(Path::part("steps", index), kind);
        }
    }
}
