//! Curves along which conditions change.

mod file;

use super::function::Parameters;
use crate::{
    fault::FaultKind,
    faults::FaultList,
    names::Names,
    raw,
    read::At,
    value::{Number, Positive, Text},
};
use std::path::Path;
use striae_model::{Clock, Course, Curve, FaultKind as ModelFault, History, misshapen, nearest};

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
    pub(super) fn new(
        raw: &[At<raw::NamedCurve>],
        base: &Path,
        parameters: &Parameters,
        faults: &mut FaultList<'_>,
    ) -> Self {
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
                .map(|curve| lowered(&curve.value, base, parameters, faults))
                .collect(),
        }
    }

    /// The curve of that name; the ramp where none is given.
    pub(super) fn find(
        &self,
        name: Option<&At<Text>>,
        faults: &mut FaultList<'_>,
    ) -> Option<Curve> {
        self.find_or(Curve::Ramp, name, faults)
    }

    /// The curve of that name; the usual one where none is given.
    pub(super) fn find_or(
        &self,
        usual: Curve,
        name: Option<&At<Text>>,
        faults: &mut FaultList<'_>,
    ) -> Option<Curve> {
        let Some(name) = name else {
            return Some(usual);
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

fn lowered(
    raw: &raw::NamedCurve,
    base: &Path,
    parameters: &Parameters,
    faults: &mut FaultList<'_>,
) -> Option<Curve> {
    let clock = match raw.time.as_ref().map(|time| time.value) {
        None | Some(raw::CurveTime::Step) => Clock::Step,
        Some(raw::CurveTime::Run) => Clock::Run,
    };
    let (span, course) = match raw.course.as_ref()? {
        raw::Course::Points(of) => {
            let points = of.points.as_ref();
            let points = points.filter(|points| !faults.within(&points.span))?;
            let pair = |At { value: [s, c], .. }: &At<[Number; 2]>| (s.0, c.0);
            let pairs = points.value.iter().map(pair).collect();
            (&points.span, course(pairs, &of.period))
        }
        raw::Course::File(of) => {
            let stated = of.file.as_ref()?;
            let columns = of.columns.as_ref()?.value.each_ref().map(|text| &*text.0);
            let skipped = of.skip.as_ref().map_or(0, |skip| skip.value.0);
            let read = file::points(base, &stated.value.0, columns, skipped);
            let pairs = read.map_err(|kind| faults.push(&stated.span, kind)).ok()?;
            (&stated.span, course(pairs, &of.period))
        }
        raw::Course::Function(of) => {
            let stated = of.function.as_ref()?;
            let function = parameters.function(&stated.value.0, &stated.span, faults)?;
            (&stated.span, Course::Function(function))
        }
    };
    let curve = match (clock, course) {
        (Clock::Step, Course::Table(points)) => Curve::Table(points),
        (clock, course) => Curve::History(History { clock, course }),
    };
    let name = raw.name.as_ref().map_or("", |name| &name.value.0);
    match misshapen(name, &curve) {
        None => Some(curve),
        Some(kind) => {
            faults.push(span, kind);
            None
        }
    }
}

fn course(points: Vec<(f64, f64)>, period: &Option<At<Positive>>) -> Course {
    match period {
        None => Course::Table(points),
        Some(period) => Course::Periodic {
            points,
            period: period.value.0,
        },
    }
}
