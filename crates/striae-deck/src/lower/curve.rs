//! Curves along which conditions change.

use crate::{
    fault::FaultKind,
    faults::FaultList,
    names::Names,
    raw,
    read::At,
    value::{Number, Text},
};
use striae_model::{FaultKind as ModelFault, misshapen, nearest};
use striae_solve::model::Curve;

const BUILT_IN: [(&str, Curve); 3] = [
    ("ramp", Curve::Ramp),
    ("constant", Curve::Constant),
    ("smooth", Curve::Smooth),
];

/// The built-in curves and those of the deck.
pub(super) struct Curves {
    names: Names,
    known: Vec<String>,
    curves: Vec<Option<Curve>>,
}

impl Curves {
    pub(super) fn new(raw: &[At<raw::NamedCurve>], faults: &mut FaultList<'_>) -> Self {
        let names = || raw.iter().map(|curve| curve.value.name.as_ref());
        for name in names()
            .flatten()
            .filter(|name| built_in(&name.value.0).is_some())
        {
            faults.push(
                &name.span,
                FaultKind::ReservedName {
                    name: name.value.0.clone(),
                },
            );
        }
        let own = names().flatten().map(|name| name.value.0.as_str());
        let known = BUILT_IN
            .iter()
            .map(|(name, _)| *name)
            .chain(own)
            .map(str::to_owned)
            .collect();
        Self {
            names: Names::new("curve", names(), faults),
            known,
            curves: raw
                .iter()
                .map(|curve| table(&curve.value, faults))
                .collect(),
        }
    }

    /// The curve of that name; the ramp where none is given.
    pub(super) fn find(
        &self,
        name: Option<&At<Text>>,
        faults: &mut FaultList<'_>,
    ) -> Option<Curve> {
        let Some(name) = name else {
            return Some(Curve::Ramp);
        };
        if let Some(curve) = built_in(&name.value.0) {
            return Some(curve);
        }
        let Some(position) = self.names.position(&name.value.0) else {
            let kind = ModelFault::UnknownName {
                kind: "curve",
                name: name.value.0.clone(),
                known: self.known.clone(),
                nearest: nearest(&name.value.0, self.known.iter().map(String::as_str)),
            };
            faults.push(&name.span, kind);
            return None;
        };
        self.curves[position].clone()
    }
}

fn built_in(name: &str) -> Option<Curve> {
    BUILT_IN
        .into_iter()
        .find(|(known, _)| *known == name)
        .map(|(_, curve)| curve)
}

fn table(raw: &raw::NamedCurve, faults: &mut FaultList<'_>) -> Option<Curve> {
    let points = raw
        .points
        .as_ref()
        .filter(|points| !faults.within(&points.span))?;
    let pairs: Vec<(f64, f64)> = points
        .value
        .iter()
        .map(
            |At {
                 value: [Number(s), Number(c)],
                 ..
             }| (*s, *c),
        )
        .collect();
    let Some(found) = misshapen(&pairs) else {
        return Some(Curve::Table(pairs));
    };
    let curve = raw
        .name
        .as_ref()
        .map_or(String::new(), |name| name.value.0.clone());
    faults.push(&points.span, ModelFault::BadCurve { curve, found });
    None
}
