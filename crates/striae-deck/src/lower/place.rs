//! Locations in a deck of the parts of a model: from paths to spans.

use std::collections::BTreeMap;

use striae_model::{Origin, Path, Segment};

use super::list;
use crate::{faults::Span, raw, read::At, value::Text};

/// Locations of the conditions of a step, by list.
pub(super) type ConditionSpans = BTreeMap<&'static str, Vec<Span>>;

/// Locations of a step.
#[derive(Clone)]
pub(super) struct StepSpans {
    pub(super) whole: Span,
    pub(super) increments: Span,
    pub(super) conditions: ConditionSpans,
}

/// Known places of parts that have none of their own in a deck.
pub(super) struct Places {
    pub(super) steps: Vec<StepSpans>,
    /// Of pairs that contact of everything comes down to.
    pub(super) origins: Vec<Origin>,
}

/// Location of the part of a model at a path; the start of the deck if it is nowhere in particular.
pub(super) fn span(path: &Path, raw: &raw::Simulation, places: &Places) -> Span {
    use Segment::{Field, Index};
    let Places { steps, origins } = places;
    let named = list(&raw.pair).len();
    let found = match path.segments() {
        [Field("contact"), rest @ ..] => raw.contact.as_ref().map(|at| of_contact(at, rest)),
        [Field("pairs"), Index(index), rest @ ..] if *index >= named => {
            let origin = origins.get(index - named);
            let contact = raw.contact.as_ref();
            contact
                .zip(origin)
                .map(|(at, origin)| of_lowered(at, *origin, rest))
        }
        [Field("pairs"), Index(index), rest @ ..] => {
            let pair = list(&raw.pair).get(*index);
            pair.map(|pair| of_pair(pair, rest))
        }
        [Field("steps"), Index(index), rest @ ..] => {
            let step = steps.get(*index);
            step.map(|step| of_step(step, rest))
        }
        [Field("ties"), Index(index), rest @ ..] => {
            let tie = list(&raw.tie).get(*index);
            tie.map(|tie| of_tie(tie, rest))
        }
        [Field("springs"), Index(index), rest @ ..] => {
            let spring = list(&raw.spring).get(*index);
            spring.map(|spring| of_spring(spring, rest))
        }
        [Field("cavities"), Index(index), ..] => {
            let cavity = list(&raw.cavity).get(*index);
            cavity.map(|at| {
                at.value
                    .name
                    .as_ref()
                    .map_or(&at.span, |name| &name.span)
                    .clone()
            })
        }
        [Field("rigid_surfaces"), Index(index), rest @ ..] => {
            let rigid = list(&raw.rigid).get(*index);
            rigid.map(|rigid| of_rigid(rigid, rest))
        }
        [Field("bodies"), Index(index), rest @ ..] => {
            let body = list(&raw.body).get(*index);
            body.map(|body| of_body(body, rest))
        }
        _ => None,
    };
    found.unwrap_or(0..0)
}

/// Name of the set that the release at a path is of.
pub(super) fn released_set(path: &Path, raw: &raw::Simulation, places: &Places) -> Option<String> {
    let span = span(path, raw, places);
    let releases = list(&raw.step)
        .iter()
        .flat_map(|step| list(&step.value.release));
    let mut releases = releases.filter(|release| release.span == span);
    let set = releases.next()?.value.nodes.as_ref()?;
    Some(set.value.0.clone())
}

fn of_rigid(rigid: &At<raw::Rigid>, rest: &[Segment]) -> Span {
    let shape = rigid.value.shape.as_ref();
    let found = match (rest, shape) {
        (
            [Segment::Field("shape"), ..],
            Some(raw::RigidShape::Mesh(raw::RigidMesh { mesh, .. })),
        ) => mesh.as_ref().map(|at| &at.span),
        (
            [Segment::Field("shape"), ..],
            Some(raw::RigidShape::Plane(raw::RigidPlane { plane, .. })),
        ) => plane.as_ref().map(|at| &at.span),
        _ => None,
    };
    found.unwrap_or(&rigid.span).clone()
}

fn of_body(body: &At<raw::Body>, rest: &[Segment]) -> Span {
    use Segment::{Field, Index};
    let found = match rest {
        [Field("sections"), Index(index), ..] => list(&body.value.sections).get(*index),
        _ => None,
    };
    found.map_or(&body.span, |section| &section.span).clone()
}

fn of_step(step: &StepSpans, rest: &[Segment]) -> Span {
    use Segment::{Field, Index};
    let found = match rest {
        [Field("increments"), ..] => Some(&step.increments),
        [Field(list), Index(index), ..] => {
            let conditions = step.conditions.get(list);
            conditions.and_then(|spans| spans.get(*index))
        }
        _ => None,
    };
    found.unwrap_or(&step.whole).clone()
}

fn of_tie(tie: &At<raw::BodyTie>, rest: &[Segment]) -> Span {
    let within = tie.value.within.as_ref();
    let within = within.filter(|_| matches!(rest, [Segment::Field("within"), ..]));
    let name = tie.value.name.as_ref().map(|at| &at.span);
    let found = within.map(|at| &at.span).or(name);
    found.unwrap_or(&tie.span).clone()
}

fn of_spring(spring: &At<raw::Spring>, rest: &[Segment]) -> Span {
    let raw = &spring.value;
    let found = match rest {
        [Segment::Field("a"), ..] => raw.a.as_ref().map(|at| &at.span),
        [Segment::Field("b"), ..] => raw.b.as_ref().map(|at| &at.span),
        [Segment::Field("direction"), ..] => raw.direction.as_ref().map(|at| &at.span),
        [Segment::Field("stiffness"), ..] => raw.stiffness.as_ref().map(|at| &at.span),
        [Segment::Field("rest"), ..] => raw.free_length.as_ref().map(|at| &at.span),
        _ => None,
    };
    let name = raw.name.as_ref().map(|at| &at.span);
    found.or(name).unwrap_or(&spring.span).clone()
}

fn of_contact(at: &At<raw::Contact>, rest: &[Segment]) -> Span {
    use Segment::{Field, Index};
    let contact = &at.value;
    let found = match rest {
        [Field("friction"), ..] => contact.friction.as_ref().map(|at| &at.span),
        [Field("feature_angle"), ..] => contact.feature_angle.as_ref().map(|at| &at.span),
        [Field("search_distance"), ..] => contact.search_distance.as_ref().map(|at| &at.span),
        [Field("stabilised"), ..] => contact.stabilise.as_ref().map(|at| &at.span),
        [Field("initial"), ..] => contact.initial.as_ref().map(|at| &at.span),
        [Field("exclude"), Index(index), side @ ..] => {
            let stated = list(&contact.exclude).get(*index);
            stated.map(|at| of_label([&at.value.a, &at.value.b], side).unwrap_or(&at.span))
        }
        [Field("between"), Index(index), Field("friction"), ..] => {
            let stated = list(&contact.between).get(*index);
            stated
                .and_then(|at| at.value.friction.as_ref())
                .map(|at| &at.span)
        }
        [Field("between"), Index(index), side @ ..] => {
            let stated = list(&contact.between).get(*index);
            stated.map(|at| of_label([&at.value.a, &at.value.b], side).unwrap_or(&at.span))
        }
        [Field("surface"), Index(index), rest @ ..] => {
            let stated = list(&contact.surface).get(*index);
            stated.map(|at| match (rest, &at.value.of) {
                ([Field("of"), ..], Some(label)) => &label.span,
                _ => &at.span,
            })
        }
        _ => None,
    };
    found.unwrap_or(&at.span).clone()
}

/// A label of a statement about two surfaces.
fn of_label<'r>([a, b]: [&'r Option<At<Text>>; 2], rest: &[Segment]) -> Option<&'r Span> {
    let label = match rest {
        [Segment::Field("a"), ..] => a,
        [Segment::Field("b"), ..] => b,
        _ => return None,
    };
    label.as_ref().map(|at| &at.span)
}

/// A pair that contact of everything comes down to.
fn of_lowered(at: &At<raw::Contact>, origin: Origin, rest: &[Segment]) -> Span {
    match (rest, origin) {
        ([] | [Segment::Field("friction"), ..], origin) => {
            of_contact(at, &origin.path().segments()[1..])
        }
        (rest, _) => of_contact(at, rest),
    }
}

fn of_pair(pair: &At<raw::Pair>, rest: &[Segment]) -> Span {
    use Segment::{Field, Index};
    let raw = &pair.value;
    let found = match rest {
        [Field("friction"), ..] => raw.friction.as_ref().map(|at| &at.span),
        [Field("feature_angle"), ..] => raw.feature_angle.as_ref().map(|at| &at.span),
        [Field("stabilised"), ..] => raw.stabilise.as_ref().map(|at| &at.span),
        [Field("interference"), ..] => raw.interference.as_ref().map(|at| &at.span),
        [Field("wear"), ..] => raw.wear.as_ref().map(|at| &at.span),
        [Field("wear_across"), ..] => raw.wear_across.as_ref().map(|at| &at.span),
        [Field("initial"), ..] => {
            let initial = raw.initial.as_ref().map(|at| &at.span);
            initial.or(raw.name.as_ref().map(|at| &at.span))
        }
        [Field("a"), ..] => rigid_name(raw, 0).map(|at| &at.span),
        [Field("b"), ..] => rigid_name(raw, 1).map(|at| &at.span),
        [Field("textures"), Index(side), ..] => {
            let side = side_as_written(raw, *side);
            side.and_then(|side| side.texture.as_ref())
                .map(|texture| &texture.span)
        }
        _ => None,
    };
    found.unwrap_or(&pair.span).clone()
}

/// Name of the rigid surface that is a side of the model's pair.
fn rigid_name(raw: &raw::Pair, side: usize) -> Option<&At<Text>> {
    match side_as_written(raw, side)?.surface.as_ref()? {
        raw::SideSurface::Rigid(side) => side.rigid.as_ref(),
        raw::SideSurface::Deformable(_) => None,
    }
}

/// A side of the model's pair, of which a lone rigid surface is side `b` wherever it
/// is written.
fn side_as_written(raw: &raw::Pair, side: usize) -> Option<&raw::Side> {
    let a = raw.a.as_ref().map(|at| &at.value);
    let b = raw.b.as_ref().and_then(|at| at.value.other());
    let is_rigid = |side: Option<&raw::Side>| {
        let surface = side.and_then(|side| side.surface.as_ref());
        matches!(surface, Some(raw::SideSurface::Rigid(_)))
    };
    let swapped = is_rigid(a) && !is_rigid(b);
    if swapped == (side == 1) { a } else { b }
}
