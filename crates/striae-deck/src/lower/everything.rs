//! `[contact]`: contact of everything, lowered to pairs.

use super::{
    contact::lower_initial,
    friction::friction,
    list,
    place::{Places, span},
    surfaces::Surfaces,
    texture,
};
use crate::{faults::FaultList, raw, read::At, value::Text};
use striae_law::friction::Friction;
use striae_model::{Draft, Everything, Lowered, everything};
use striae_surface::texture::Paint;

/// The pairs, none if a deck does not request contact of everything; `None` after faults.
pub(super) fn lowered(
    raw: &raw::Simulation,
    draft: &Draft<'_>,
    surfaces: &Surfaces<'_>,
    faults: &mut FaultList<'_>,
) -> Option<Lowered> {
    let Some(contact) = &raw.contact else {
        return Some(Lowered::default());
    };
    let stated = stated(&contact.value, draft, surfaces, faults);
    if !contact.value.all.as_ref()?.value.0 {
        return Some(Lowered::default());
    }
    let mut found = Vec::new();
    let lowered = stated?.lowered(draft, &mut found);
    let places = Places {
        steps: Vec::new(),
        origins: Vec::new(),
    };
    for fault in found {
        faults.push(&span(&fault.path, raw, &places), fault.kind);
    }
    lowered
}

/// Statements of the table; `None` after faults.
fn stated(
    raw: &raw::Contact,
    draft: &Draft<'_>,
    surfaces: &Surfaces<'_>,
    faults: &mut FaultList<'_>,
) -> Option<Everything> {
    let mut all = everything();
    let mut is_whole = true;
    if let Some(stated) = &raw.friction {
        match friction(&stated.value, &stated.span, faults) {
            Some(friction) => all = all.friction(friction),
            None => is_whole = false,
        }
    }
    for At { value, .. } in list(&raw.exclude) {
        match (&value.a, &value.b) {
            (Some(a), None) => all = all.exclude(&a.value.0),
            (Some(a), Some(b)) => all = all.exclude_between(&a.value.0, &b.value.0),
            (None, _) => is_whole = false,
        }
    }
    for At { value, .. } in list(&raw.between) {
        match between(value, faults) {
            Some((a, b, friction)) => all = all.between(a, b, friction),
            None => is_whole = false,
        }
    }
    for At { value, .. } in list(&raw.surface) {
        match painted(value, draft, surfaces, faults) {
            Some((of, paint)) => all = all.textured(of, paint),
            None => is_whole = false,
        }
    }
    if let Some(angle) = &raw.feature_angle {
        all = all.feature_angle(angle.value.0);
    }
    if let Some(distance) = &raw.search_distance {
        all = all.search_distance(distance.value.0);
    }
    if let Some(initial) = &raw.initial {
        all = all.initial(lower_initial(&initial.value));
    }
    if raw.stabilise.as_ref().is_some_and(|truth| truth.value.0) {
        all = all.stabilised();
    }
    is_whole.then_some(all)
}

fn between<'r>(
    raw: &'r raw::Between,
    faults: &mut FaultList<'_>,
) -> Option<(&'r str, &'r str, Friction)> {
    let stated = raw.friction.as_ref();
    let friction = stated.and_then(|stated| friction(&stated.value, &stated.span, faults));
    let label = |of: &'r Option<At<Text>>| of.as_ref().map(|at| at.value.0.as_str());
    Some((label(&raw.a)?, label(&raw.b)?, friction?))
}

/// A label and the paint of what it stands for; labels that stand for nothing are judged later.
fn painted<'r>(
    raw: &'r raw::PaintedSurface,
    draft: &Draft<'_>,
    surfaces: &Surfaces<'_>,
    faults: &mut FaultList<'_>,
) -> Option<(&'r str, Paint)> {
    let Text(label) = &raw.of.as_ref()?.value;
    let stated = raw.texture.as_ref()?;
    let surface = draft.surface(label);
    let paint = texture::paint(stated, surface.as_ref(), surfaces, faults);
    Some((label.as_str(), paint?))
}
