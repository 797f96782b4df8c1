//! Names given to things, looked up with suggestions.

use super::{
    fault::FaultKind,
    faults::{FaultList, Span},
    read::At,
    value::Text,
};
use std::collections::{BTreeMap, BTreeSet};
use striae_model::{FaultKind as ModelFault, nearest};

/// The names of all things of one kind, by position.
pub(crate) struct Names {
    kind: &'static str,
    names: Vec<Option<String>>,
}

impl Names {
    /// Collects names; repeated ones are faults.
    pub(crate) fn new<'n>(
        kind: &'static str,
        names: impl IntoIterator<Item = Option<&'n At<Text>>>,
        faults: &mut FaultList<'_>,
    ) -> Self {
        let mut first: BTreeMap<&str, Span> = BTreeMap::new();
        let mut all = Vec::new();
        for name in names {
            all.push(name.map(|name| name.value.0.clone()));
            let Some(At {
                span,
                value: Text(name),
            }) = name
            else {
                continue;
            };
            match first.get(name.as_str()) {
                Some(earlier) => {
                    let place = faults.seen_from(earlier, span);
                    faults.push(
                        span,
                        FaultKind::DuplicateName {
                            kind,
                            name: name.clone(),
                            place,
                        },
                    );
                }
                None => {
                    first.insert(name, span.clone());
                }
            }
        }
        Self { kind, names: all }
    }

    /// Adds names that stand in no deck; `None`: some that are not known.
    pub(crate) fn extend(&mut self, names: impl IntoIterator<Item = Option<String>>) {
        self.names.extend(names);
    }

    /// Position of the thing of that name; an unknown name is a fault.
    pub(crate) fn find(&self, name: &At<Text>, faults: &mut FaultList<'_>) -> Option<usize> {
        let position = self.position(&name.value.0);
        // Where a thing has no readable name, this may be the one meant.
        if position.is_none() && self.names.iter().all(Option::is_some) {
            let known: BTreeSet<String> = self.names.iter().flatten().cloned().collect();
            let kind = ModelFault::UnknownName {
                kind: self.kind,
                name: name.value.0.clone(),
                nearest: nearest(&name.value.0, known.iter().map(String::as_str)),
                known: known.into_iter().collect(),
            };
            faults.push(&name.span, kind);
        }
        position
    }

    /// Position of the thing of that name.
    pub(crate) fn position(&self, name: &str) -> Option<usize> {
        self.names
            .iter()
            .position(|known| known.as_deref() == Some(name))
    }
}
