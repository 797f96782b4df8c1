//! Laws in tables: the name of a declared law at one key, its parameters at others.
//!
//! Reader, schema and reference follow from the declarations of `striae-law`; this crate
//! knows no law by name.

use striae_law::{
    Laws,
    declared::{self, Declared, Kind, Parameter, Value, Values},
    friction::{
        BY_PRESSURE, BY_RATE, BY_SLIP, BY_STATE, DECAY, Friction, PressureDependence,
        RateDependence, SlipDependence, StateDependence,
    },
};

use super::{
    declare::read_as_table,
    faults::FaultList,
    form::{Alternative, Form, Key, Need, Open},
    read::{self, Part, Place, TableReader},
    value::{number, numbers, word},
};

/// A kind of laws that tables name.
pub(crate) trait Named: Kind {
    /// The key with the name.
    const TAG: &'static str;
    /// Its meaning.
    const DOC: &'static str;
    /// The kind, if a program may add laws of its own.
    const OPEN: Option<Open>;

    /// Returns the laws that can be named.
    fn declared(laws: &Laws) -> &[&'static Declared<Self>];
}

impl Named for Friction {
    const TAG: &'static str = "law";
    const DOC: &'static str = "Friction law.";
    const OPEN: Option<Open> = Some(Open::Friction);

    fn declared(laws: &Laws) -> &[&'static Declared<Self>] {
        laws.friction()
    }
}

impl Named for PressureDependence {
    const TAG: &'static str = "form";
    const DOC: &'static str = "How the coefficients depend on the pressure.";
    const OPEN: Option<Open> = None;

    fn declared(_: &Laws) -> &[&'static Declared<Self>] {
        BY_PRESSURE
    }
}

impl Named for RateDependence {
    const TAG: &'static str = "form";
    const DOC: &'static str = "How the coefficients depend on the slip rate.";
    const OPEN: Option<Open> = None;

    fn declared(_: &Laws) -> &[&'static Declared<Self>] {
        BY_RATE
    }
}

impl Named for SlipDependence {
    const TAG: &'static str = "form";
    const DOC: &'static str = "How the coefficients depend on the accumulated slip.";
    const OPEN: Option<Open> = None;

    fn declared(_: &Laws) -> &[&'static Declared<Self>] {
        BY_SLIP
    }
}

impl Named for StateDependence {
    const TAG: &'static str = "form";
    const DOC: &'static str = "How the state of the surface evolves.";
    const OPEN: Option<Open> = None;

    fn declared(_: &Laws) -> &[&'static Declared<Self>] {
        BY_STATE
    }
}

/// A law by its name, with the values of its parameters but after faults.
#[derive(Clone, Debug)]
pub(crate) struct Stated<L: Kind> {
    law: &'static Declared<L>,
    values: Option<Values>,
}

impl<L: Kind> Stated<L> {
    /// Reads the parameters of a law.
    fn parameters(law: &'static Declared<L>, reader: &mut TableReader<'_, '_, '_>) -> Self {
        // All are read, so that all faults are noted.
        let values: Vec<_> = law
            .parameters
            .iter()
            .map(|one| one_of(one, reader))
            .collect();
        let values: Option<Vec<_>> = values.into_iter().collect();
        let values = values.map(|values| values.into_iter().flatten().collect());
        Self { law, values }
    }

    /// Returns the law or its refusal; nothing where values could not be read.
    pub(crate) fn made(&self) -> Option<Result<L, L::Refusal>> {
        Some(self.law.made(self.values.as_ref()?))
    }
}

impl<L: Named> Part for Stated<L> {
    fn part(reader: &mut TableReader<'_, '_, '_>) -> Option<Self> {
        let laws = L::declared(reader.faults.laws());
        let names: Vec<&'static str> = laws.iter().map(|law| law.name).collect();
        let expected = Form::Words(names.iter().map(|name| (*name, "")).collect()).expected();
        let read = |value: &read::Value<'_>, place: &Place, faults: &mut FaultList<'_>| {
            word(value, place, faults, &names)
        };
        match reader.required_as(L::TAG, &expected, read) {
            Some(at) => Some(Self::parameters(laws[at.value], reader)),
            None => {
                laws.iter()
                    .for_each(|law| reader.tolerate(&[keys(law.parameters)]));
                None
            }
        }
    }

    fn alternatives() -> Vec<Alternative> {
        match L::OPEN {
            None => of_each::<L>(&Laws::default()),
            Some(open) => vec![Alternative {
                doc: String::new(),
                keys: vec![tag::<L>(Form::Law(open))],
            }],
        }
    }
}

/// The decay of coefficients, the only law of its table.
#[derive(Clone, Debug)]
pub(crate) struct Decay(pub(crate) Stated<RateDependence>);

impl Part for Decay {
    fn part(reader: &mut TableReader<'_, '_, '_>) -> Option<Self> {
        Some(Self(Stated::parameters(&DECAY, reader)))
    }

    fn alternatives() -> Vec<Alternative> {
        let doc = DECAY.summary.to_owned();
        vec![Alternative {
            doc,
            ..keys(DECAY.parameters)
        }]
    }
}

pub(crate) type ByPressure = Stated<PressureDependence>;
pub(crate) type BySlipRate = Stated<RateDependence>;
pub(crate) type ByAccumulatedSlip = Stated<SlipDependence>;
pub(crate) type ByState = Stated<StateDependence>;

read_as_table!(Decay);
read_as_table!(ByPressure);
read_as_table!(BySlipRate);
read_as_table!(ByAccumulatedSlip);
read_as_table!(ByState);

impl Open {
    /// Returns the compositions of a table with any of the laws.
    pub(crate) fn alternatives(self, laws: &Laws) -> Vec<Alternative> {
        match self {
            Self::Friction => of_each::<Friction>(laws),
        }
    }
}

/// Returns a composition for each law, with the key of its name first.
fn of_each<L: Named>(laws: &Laws) -> Vec<Alternative> {
    let composed = |law: &&'static Declared<L>| {
        let mut composed = keys(law.parameters);
        composed.doc = law.summary.to_owned();
        composed
            .keys
            .insert(0, tag::<L>(Form::Words(vec![(law.name, "")])));
        composed
    };
    L::declared(laws).iter().map(composed).collect()
}

fn tag<L: Named>(form: Form) -> Key {
    Key {
        name: L::TAG,
        doc: L::DOC.to_owned(),
        need: Need::Required,
        form,
    }
}

/// Returns the keys of parameters.
fn keys(parameters: &[Parameter]) -> Alternative {
    let key = |parameter: &Parameter| Key {
        name: parameter.name,
        doc: parameter.told(),
        need: match parameter.is_required() {
            true => Need::Required,
            false => Need::Optional,
        },
        form: form(parameter.form),
    };
    Alternative {
        doc: String::new(),
        keys: parameters.iter().map(key).collect(),
    }
}

fn form(of: declared::Form) -> Form {
    match of {
        declared::Form::Number(bounds) => Form::Number(bounds),
        declared::Form::Numbers(bounds) => Form::List(Box::new(Form::Number(bounds)), None),
        declared::Form::Word(words) => Form::Words(words.to_vec()),
    }
}

/// Returns the value of a parameter, nothing within where it is absent and need not be given;
/// nothing at all after a fault.
fn one_of(
    parameter: &Parameter,
    reader: &mut TableReader<'_, '_, '_>,
) -> Option<Option<(&'static str, Value)>> {
    let read = |value: &read::Value<'_>, place: &Place, faults: &mut FaultList<'_>| {
        Some(match parameter.form {
            declared::Form::Number(bounds) => number(value, place, faults, bounds)?.into(),
            declared::Form::Numbers(bounds) => numbers(value, place, faults, bounds)?.into(),
            declared::Form::Word(words) => {
                let names: Vec<&'static str> = words.iter().map(|(name, _)| *name).collect();
                names[word(value, place, faults, &names)?].into()
            }
        })
    };
    let given = reader.has(parameter.name);
    let found = match parameter.is_required() {
        true => reader.required_as(parameter.name, &form(parameter.form).expected(), read),
        false => reader.optional_as(parameter.name, read),
    };
    match found {
        Some(at) => Some(Some((parameter.name, at.value))),
        None if given || parameter.is_required() => None,
        None => Some(None),
    }
}
