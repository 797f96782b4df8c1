//! Declared laws: each is made of values within its ranges, keeps them, and is made of them again.

use crate::declared::{Bound, Declared, Form, Kind, Value, Values};
use crate::friction::{BY_PRESSURE, BY_RATE, BY_SLIP, DECAY, LAWS};

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
    match form {
        Form::Number(bounds) => number(bounds).into(),
        Form::Numbers(bounds) => vec![number(bounds), 1.0, 2.0].into(),
        Form::Word(words) => words[0].0.into(),
    }
}

fn are_made<L: Kind>(laws: &[&'static Declared<L>]) {
    for law in laws {
        let parameters = law.parameters.iter();
        let given = parameters.map(|parameter| (parameter.name, value(parameter.form)));
        let made = law.made(&given.collect::<Values>()).expect(law.name);
        let statement = made.statement().expect("a declared law has a statement");
        assert_eq!(statement.law, law.name);
        let again = law.made(&statement.values).expect(law.name);
        assert_eq!(again.statement(), Some(statement));
        let names = laws.iter().filter(|other| other.name == law.name);
        assert_eq!(names.count(), 1, "{}", law.name);
        assert!(law.summary.ends_with('.'), "{}", law.summary);
        for parameter in law.parameters {
            assert!(parameter.doc.ends_with('.'), "{}", parameter.doc);
            let is_word = matches!(parameter.form, Form::Word(_));
            assert_eq!(parameter.unit.is_empty(), is_word, "{}", parameter.name);
        }
        let required = law.parameters.iter().filter(|one| one.is_required());
        let required = required.map(|parameter| (parameter.name, value(parameter.form)));
        assert!(
            law.made(&required.collect::<Values>()).is_ok(),
            "{}",
            law.name
        );
    }
}

#[test]
fn each_is_made_again_of_what_it_states() {
    are_made(LAWS);
    are_made(BY_PRESSURE);
    are_made(BY_RATE);
    are_made(BY_SLIP);
    are_made(&[&DECAY]);
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
