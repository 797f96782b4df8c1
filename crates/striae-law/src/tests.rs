//! Declared laws: each is made of values within its ranges, keeps them, and is made of them again.

use crate::{
    bulk,
    friction::{BY_PRESSURE, BY_RATE, BY_SLIP, BY_STATE, DECAY, LAWS},
};
use striae_declared::{Bound, Declared, Form, Kind, Parameter, Value, Values};

/// A value within the range of a parameter that any law accepts.
fn value(form: Form) -> Value {
    let number = |bounds: &[Bound]| {
        let tried = [0.3, 1.5];
        let admitted = tried
            .iter()
            .copied()
            .find(|one| bounds.iter().all(|of| of.admits(*one)));
        admitted.expect("the bounds admit one of them")
    };
    let table = |parameters: &[Parameter]| -> Values {
        let values = parameters.iter().map(|one| (one.name, value(one.form)));
        values.collect()
    };
    match form {
        Form::Number(bounds) => number(bounds).into(),
        Form::Numbers(bounds) => vec![number(bounds), 1.0, 2.0].into(),
        Form::Several(count, bounds) => vec![number(bounds); count].into(),
        Form::Direction => vec![0.0, 0.0, 1.0].into(),
        Form::Whole(least) => least.into(),
        Form::Counts(count) => vec![1; count].as_slice().into(),
        Form::Word(words) => words[0].0.into(),
        Form::Pairs => vec![[0.0, 0.3], [0.5, 1.5]].into(),
        Form::Vectors => vec![[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]].into(),
        Form::Table(set) => table(set.parameters).into(),
        Form::Tables(set) => vec![table(set.parameters); 2].into(),
        Form::OneOf(_) => unreachable!("it has no value of its own"),
    }
}

/// All ways to give values, with those that need not be given or without.
fn ways(parameters: &[Parameter], only_required: bool) -> Vec<Values> {
    let mut all = vec![Values::default()];
    for parameter in parameters {
        let added: Vec<Values> = match parameter.form {
            Form::OneOf(sets) => {
                let sets = sets.iter();
                sets.flat_map(|set| ways(set.parameters, only_required))
                    .collect()
            }
            _ if only_required && !parameter.is_required() => continue,
            form => vec![Values::default().with(parameter.name, value(form))],
        };
        let extended = |way: &Values| {
            let added = added.clone().into_iter();
            let way = way.clone();
            added.map(move |values| way.clone().followed_by(values))
        };
        all = all.iter().flat_map(extended).collect();
    }
    all
}

fn are_told(parameters: &[Parameter]) {
    for parameter in parameters {
        let has_unit = match parameter.form {
            Form::Number(_) | Form::Numbers(_) | Form::Several(..) => true,
            Form::Word(_) | Form::Pairs => false,
            Form::Direction | Form::Vectors | Form::Whole(_) | Form::Counts(_) => false,
            Form::Table(set) | Form::Tables(set) => {
                assert!(set.doc.ends_with('.'), "{}", set.doc);
                are_told(set.parameters);
                false
            }
            Form::OneOf(sets) => {
                sets.iter().for_each(|set| are_told(set.parameters));
                continue;
            }
        };
        assert!(parameter.doc.ends_with('.'), "{}", parameter.doc);
        assert_eq!(parameter.unit.is_empty(), !has_unit, "{}", parameter.name);
    }
}

fn are_made<L: Kind>(laws: &[&'static Declared<L>]) {
    for law in laws {
        let all = ways(law.parameters, false);
        for given in all.into_iter().chain(ways(law.parameters, true)) {
            let made = law.made(&given).expect(law.name);
            let statement = made.statement().expect("a declared law has a statement");
            assert_eq!(statement.law, law.name);
            for (name, value) in given.iter() {
                assert_eq!(statement.values.get(name), Some(value), "{}", law.name);
            }
            let again = law.made(&statement.values).expect(law.name);
            assert_eq!(again.statement(), Some(statement));
        }
        let names = laws.iter().filter(|other| other.name == law.name);
        assert_eq!(names.count(), 1, "{}", law.name);
        assert!(law.summary.ends_with('.'), "{}", law.summary);
        are_told(law.parameters);
    }
}

#[test]
fn each_is_made_again_of_what_it_states() {
    are_made(LAWS);
    are_made(BY_PRESSURE);
    are_made(BY_RATE);
    are_made(BY_SLIP);
    are_made(BY_STATE);
    are_made(&[&DECAY]);
    are_made(bulk::LAWS);
}

#[test]
fn directions_of_fibres_are_made_again_of_what_they_state() {
    for direction in bulk::DIRECTIONS {
        for given in ways(direction.parameters, false) {
            let Ok(made) = direction.made(&given);
            let statement = made.stated();
            assert_eq!(statement.law, direction.name);
            assert_eq!(direction.made(&statement.values), Ok(made));
        }
        are_told(direction.parameters);
    }
}

#[test]
fn fits_have_a_constant_for_each_number() {
    use crate::friction::Basis;
    for law in LAWS {
        if let Some(Basis::Sum(sum)) = law.fit {
            let numbers = law.parameters.iter();
            let numbers = numbers.filter(|one| matches!(one.form, Form::Number(_)));
            assert_eq!(numbers.count(), sum.constants.len(), "{}", law.name);
        }
    }
}

#[test]
fn constructors_of_bulk_laws_state_what_they_make() {
    for law in bulk::LAWS {
        for given in ways(law.parameters, false) {
            let made = law.made(&given).expect(law.name);
            let plain = match made.law().clone() {
                bulk::Law::NeoHookean { volumetric, .. } => {
                    bulk::Material::neo_hookean_with(made.lame_constants(), volumetric)
                }
                bulk::Law::LinearElastic { .. } => {
                    bulk::Material::linear_elastic(made.lame_constants())
                }
                bulk::Law::Hyperelastic(law) => bulk::Material::hyperelastic(law),
                bulk::Law::Viscoelastic(law) => bulk::Material::viscoelastic(law),
                bulk::Law::Plastic(law) => bulk::Material::plastic(law),
                bulk::Law::Fibrous(_) | bulk::Law::Own(_) => continue,
            };
            assert_eq!(plain, made);
            let statement = plain.statement().expect("a constructor states it");
            assert_eq!(statement.law, law.name);
            let again = law.made(&statement.values).expect(law.name);
            assert_eq!(again, made);
            assert_eq!(again.statement(), Some(statement));
        }
    }
}
