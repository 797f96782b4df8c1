//! Definitions of sets that cannot be made: they need sets that are not there, or each other.
//!
//! A definition that needs a faulty one is passed over, as that has its fault already.

use super::{Definition, Named, has};
use crate::{fault::FaultKind, faults::FaultList};
use striae_mesh::Mesh;

/// Notes what is wrong with definitions each of which needs a set that is not there.
pub(super) fn refuse<'r>(
    mut left: Vec<Definition<'r>>,
    mut faulty: Vec<Named<'r>>,
    mesh: &mut Mesh,
    body: &str,
    faults: &mut FaultList<'_>,
) {
    while !left.is_empty() {
        let is_hopeless = |definition: &Definition<'_>| {
            let mut needs = definition.needs().into_iter();
            needs.any(|need| !has(mesh, need) && maker(&left, need).is_none())
        };
        let (hopeless, waiting): (Vec<_>, Vec<_>) = left.iter().copied().partition(is_hopeless);
        if hopeless.is_empty() {
            let circle = circle(&left, mesh);
            note(&circle, &left, body, faults);
            faulty.extend(circle);
            left.retain(|one| one.name().is_none_or(|name| !faulty.contains(&name)));
            continue;
        }
        for definition in hopeless {
            let mut needs = definition.needs().into_iter();
            if !needs.any(|need| faulty.contains(&need)) {
                definition.add(mesh, body, faults);
            }
            faulty.extend(definition.name());
        }
        left = waiting;
    }
}

/// The definition that makes a set.
fn maker<'r>(definitions: &[Definition<'r>], set: Named<'_>) -> Option<Definition<'r>> {
    let mut definitions = definitions.iter().copied();
    definitions.find(|definition| definition.name() == Some(set))
}

/// Sets of which each needs the next and the last the first; the one that is written first
/// among all that are left starts the search.
fn circle<'r>(left: &[Definition<'r>], mesh: &Mesh) -> Vec<Named<'r>> {
    let mut at = left[0];
    let mut passed: Vec<Named<'r>> = Vec::new();
    loop {
        let mut needs = at.needs().into_iter();
        let need = needs
            .find(|need| !has(mesh, *need))
            .expect("it needs what is not there");
        if let Some(start) = passed.iter().position(|set| *set == need) {
            return passed.split_off(start);
        }
        passed.push(need);
        at = maker(left, need).expect("some definition makes it");
    }
}

/// Notes the fault at the names of the sets.
fn note(circle: &[Named<'_>], left: &[Definition<'_>], body: &str, faults: &mut FaultList<'_>) {
    let (kind, name) = circle[0];
    let first = maker(left, circle[0]).and_then(|definition| definition.stated().1);
    let span = first.map_or(0..0, |name| name.span.clone());
    let over = circle[1..].iter();
    let over = over.map(|(kind, name)| format!("{} set `{name}`", kind.word()));
    let fault = FaultKind::CircularSet {
        body: body.to_owned(),
        kind: kind.word(),
        name: name.to_owned(),
        over: over.collect(),
    };
    faults.push(&span, fault);
}
