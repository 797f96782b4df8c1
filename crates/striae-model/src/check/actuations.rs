//! Actuation that bodies can follow: something is left of every length, fibres are there.

use std::mem::discriminant;

use crate::{
    fault::FaultKind,
    model::{Actuation, ActuationKind, Moment, Step},
    path::Path,
};
use striae_mesh::Vec3;

use super::{Draft, List};

/// Largest component of a strain, beyond all measure.
const LARGEST: f64 = 1e6;

/// Actuation of sections by the steps before.
#[derive(Default)]
pub(super) struct Reached(Vec<OfSection>);

/// An actuation of a section.
struct OfSection {
    body: usize,
    section: usize,
    kind: ActuationKind,
    /// Least principal strain on the way there.
    least: f64,
}

/// Notes what is wrong with the actuations of a step, and where they lead.
pub(super) fn check(
    draft: &Draft<'_>,
    (step, start): (&Step, Moment),
    path: &Path,
    reached: &mut Reached,
    faults: &mut List,
) {
    reached
        .0
        .iter_mut()
        .for_each(|of| of.least = of.kind.least_strain());
    for (index, stated) in step.actuations.iter().enumerate() {
        let path = path.clone().field("actuations").index(index);
        let earlier = step.actuations[..index].iter();
        let cause = unsound(draft, stated, start, earlier)
            .or_else(|| follow(draft, stated, start, reached));
        if let Some(cause) = cause {
            let kind = FaultKind::Actuation {
                step: step.name.clone(),
                of: name(draft, stated),
                cause,
            };
            faults.push(path, kind);
        }
    }
}

/// Name of the body or section that is actuated, in words.
fn name(draft: &Draft<'_>, stated: &Actuation) -> String {
    let body = &draft.bodies[stated.body.0];
    let section = stated
        .section
        .and_then(|at| body.sections.get(at.checked_sub(1)?));
    section.map_or_else(
        || format!("body `{}`", body.name),
        |section| format!("section `{}` of body `{}`", section.set, body.name),
    )
}

/// Reason why an actuation is meaningless on its own.
fn unsound<'a>(
    draft: &Draft<'_>,
    stated: &Actuation,
    start: Moment,
    mut earlier: impl Iterator<Item = &'a Actuation>,
) -> Option<String> {
    let overlaps = |other: &Actuation| {
        other.section.is_none() || stated.section.is_none() || other.section == stated.section
    };
    if earlier.any(|other| {
        other.body == stated.body && overlaps(other) && other.kind.is_like(&stated.kind)
    }) {
        return Some("this kind of actuation is stated twice; remove one of them".to_owned());
    }
    let factor = stated
        .curve
        .range(start)
        .iter()
        .fold(1.0, |most: f64, c| most.max(c.abs()));
    let is_within = |number: &f64, most: f64| (number * factor).abs() <= most;
    let numbers = stated.kind.numbers();
    let wrong = match stated.kind {
        ActuationKind::FibreTension(_) | ActuationKind::Tension { .. } => {
            let wrong = numbers.iter().find(|number| !is_within(number, f64::MAX));
            wrong.map(|wrong| format!("its tension must be a finite number, but is {wrong}"))
        }
        _ => {
            let wrong = numbers.iter().find(|number| !is_within(number, LARGEST));
            wrong.map(|wrong| {
                format!("its strain must be a number up to {LARGEST:e}, but is {wrong}")
            })
        }
    };
    if wrong.is_some() {
        return wrong;
    }
    match &stated.kind {
        ActuationKind::Strain(strain) if *strain != strain.transpose() => {
            Some("its strain must be symmetric".to_owned())
        }
        ActuationKind::Tension { along, .. } if !is_unit(along) => {
            Some("the direction of its tension must be a unit vector".to_owned())
        }
        kind => without_fibres(draft, stated, kind),
    }
}

/// Returns whether a vector has the length 1 to round-off.
fn is_unit(vector: &Vec3) -> bool {
    (vector.norm() - 1.0).abs() < 1e-6
}

/// Reason why missing fibres cannot be actuated.
fn without_fibres(draft: &Draft<'_>, stated: &Actuation, kind: &ActuationKind) -> Option<String> {
    let of_fibres = [
        ActuationKind::FibreStrain(0.0),
        ActuationKind::FibreTension(0.0),
    ];
    if !of_fibres
        .iter()
        .any(|one| discriminant(one) == discriminant(kind))
    {
        return None;
    }
    let body = &draft.bodies[stated.body.0];
    let of_sections = body.sections.iter().map(|of| Some(&of.material));
    let materials: Vec<_> = [body.material].into_iter().chain(of_sections).collect();
    let chosen = match stated.section {
        Some(at) => materials.get(at..=at)?,
        None => &materials,
    };
    // A material with faults of its own may have fibres.
    let mut known = chosen.iter();
    let none = known.all(|material| material.is_some_and(|material| material.fibres().is_empty()));
    none.then(|| {
        "its material has no fibres; give it `fibres`, or state a direction for `along`".to_owned()
    })
}

/// Takes an actuation into account; why nothing would be left of some length.
fn follow(
    draft: &Draft<'_>,
    stated: &Actuation,
    start: Moment,
    reached: &mut Reached,
) -> Option<String> {
    let body = stated.body.0;
    let sections = match stated.section {
        Some(section) => section..section + 1,
        None => 0..draft.bodies[body].sections.len() + 1,
    };
    let mut worst: Option<f64> = None;
    for section in sections {
        let all = &mut reached.0;
        let known = all.iter().position(|of| {
            (of.body, of.section) == (body, section) && of.kind.is_like(&stated.kind)
        });
        let from = known.map(|at| all[at].kind);
        let from = stated.curve.origin(from, None);
        let at = |c: f64| stated.kind.between(from.as_ref(), c);
        let ways = stated.curve.range(start).into_iter();
        let least = ways
            .map(|c| at(c).least_strain())
            .fold(f64::INFINITY, f64::min);
        let found = OfSection {
            body,
            section,
            kind: at(stated.curve.at(start.later(1.0))),
            least,
        };
        match known {
            Some(at) => all[at] = found,
            None => all.push(found),
        }
        let own = all
            .iter()
            .filter(|of| (of.body, of.section) == (body, section));
        let sum = own.map(|of| of.least.min(0.0)).sum::<f64>();
        worst = Some(worst.map_or(sum, |worst| worst.min(sum)));
    }
    let worst = worst.filter(|sum| sum.is_nan() || *sum <= -1.0)?;
    Some(format!(
        "its lengths at rest would change by the factor {:.4} and vanish; strains, all kinds together and with the values of their curves, must stay above -1",
        1.0 + worst
    ))
}
