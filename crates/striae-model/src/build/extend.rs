//! Steps after those that a model has.

use crate::{
    check::{Draft, DraftStep, Validate},
    fault::{Fault, Faults},
    model::{Model, Step},
};

use super::{
    StepBuilder,
    lookup::Names,
    placed,
    step::{Prescribed, Resolved},
};

/// The model with more steps at its end; names are those of its parts. What the meshes
/// of its pairs leave open or overlapping is not judged again.
///
/// # Errors
/// All faults: unknown names and everything that [`Validate`] finds. Steps count from
/// the first one of the model.
pub fn extended(mut model: Model, steps: Vec<StepBuilder>) -> Result<Model, Faults> {
    let mut faults = Vec::new();
    let first = model.steps.len();
    let resolved = resolved(&model, &steps, &mut faults);
    if faults.is_empty() {
        let new = resolved.into_iter().map(|resolved| resolved.step);
        model.steps.extend(new);
        return model.checked();
    }
    let mut draft = Draft::of(&model);
    draft
        .steps
        .extend(resolved.iter().map(|resolved| DraftStep {
            step: &resolved.step,
            known: resolved.known,
            displacements: resolved.displacements(),
        }));
    let found = draft.faults().into_iter();
    faults.extend(found.map(|fault| placed(fault, first, &resolved)));
    Err(Faults(faults))
}

fn resolved(model: &Model, steps: &[StepBuilder], faults: &mut Vec<Fault>) -> Vec<Resolved> {
    let rigid = model.rigid_surfaces.iter().map(|rigid| rigid.name.as_str());
    let pairs = model.pairs.iter().map(|pair| pair.name.as_str());
    let mut names = Names::new(&model.bodies, rigid.collect(), pairs.collect());
    let cavities = model.cavities.iter();
    names.cavities = cavities.map(|cavity| cavity.name.as_str()).collect();
    let mut prescribed = Prescribed::default();
    let before: &[Step] = &model.steps;
    before.iter().for_each(|step| prescribed.after(step));
    let numbered = (before.len()..).zip(steps);
    let resolve = |(index, step): (usize, &StepBuilder)| {
        step.resolved(index, &names, &mut prescribed, faults)
    };
    numbered.map(resolve).collect()
}
