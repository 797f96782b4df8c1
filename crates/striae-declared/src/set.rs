//! Sets of parameters: those of a table, and those of which exactly one set is given.

use super::{Form, Parameter, Set, Value, Values};

/// Values from which no set, or more than one, follows.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Choice {
    /// There is none of any set.
    #[error("{0} is needed")]
    None(String),
    /// There are some of two sets.
    #[error("`{first}` and `{second}` exclude each other; {choices} is needed")]
    Exclusive {
        /// A parameter of one set.
        first: &'static str,
        /// A parameter of another one.
        second: &'static str,
        /// Requirements of each set.
        choices: String,
    },
}

impl Set {
    /// Returns the set to choose: the only one, or that of which a parameter is given that the
    /// others do not have.
    ///
    /// # Errors
    /// When it is not exactly one.
    pub fn chosen(
        sets: &'static [Self],
        is_given: impl Fn(&str) -> bool,
    ) -> Result<&'static Self, Choice> {
        if let [only] = sets {
            return Ok(only);
        }
        let own = |at: usize| {
            let mut names = sets[at].names();
            let elsewhere = |name: &str| {
                let mut others = sets.iter().enumerate().filter(|(other, _)| *other != at);
                others.any(|(_, set)| set.names().any(|other| other == name))
            };
            names.find(|name| is_given(name) && !elsewhere(name))
        };
        let given = (0..sets.len()).filter_map(|at| Some((at, own(at)?)));
        let given: Vec<(usize, &str)> = given.collect();
        match given[..] {
            [(at, _)] => Ok(&sets[at]),
            [] => Err(Choice::None(choices(sets))),
            [(_, first), (_, second), ..] => Err(Choice::Exclusive {
                first,
                second,
                choices: choices(sets),
            }),
        }
    }

    fn names(&self) -> impl Iterator<Item = &'static str> {
        self.parameters.iter().map(|parameter| parameter.name)
    }
}

/// Tells what each of several sets requires.
fn choices(sets: &[Set]) -> String {
    let required = |set: &Set| {
        let required = set.parameters.iter().filter(|one| one.is_required());
        let names: Vec<String> = required.map(|one| format!("`{}`", one.name)).collect();
        names.join(" and ")
    };
    let choices: Vec<String> = sets.iter().map(required).collect();
    format!("either {}", choices.join(" or "))
}

/// Returns values with those of the parameters that are given or have a default.
pub(super) fn completed(parameters: &[Parameter], given: &Values, values: Values) -> Values {
    parameters.iter().fold(values, |values, parameter| {
        let table = |of: &Set, given: &Values| completed(of.parameters, given, Values::default());
        let value = match (parameter.form, given.get(parameter.name)) {
            (Form::OneOf(sets), _) => {
                let set = Set::chosen(sets, |name| given.get(name).is_some());
                return match set {
                    Ok(set) => completed(set.parameters, given, values),
                    Err(_) => values,
                };
            }
            (Form::Table(of), Some(Value::Table(given))) => Some(table(of, given).into()),
            (Form::Tables(of), Some(Value::Tables(all))) => {
                let all = all.iter().map(|given| table(of, given));
                Some(all.collect::<Vec<_>>().into())
            }
            (_, Some(value)) => Some(value.clone()),
            (_, None) => parameter.default(&values),
        };
        match value {
            Some(value) => values.with(parameter.name, value),
            None => values,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::Choice;
    use crate::{ANY, Absent, NO_UNIT, Parameter, Set};

    const fn number(name: &'static str) -> Parameter {
        Parameter::number(name, ANY, NO_UNIT, "A number.")
    }

    static SETS: [Set; 2] = [
        Set {
            doc: "Two numbers.",
            parameters: &[number("a"), number("common"), number("b")],
        },
        Set {
            doc: "One number, and more.",
            parameters: &[
                number("common"),
                number("c"),
                number("d").or(Absent::Nothing),
            ],
        },
    ];

    fn chosen(given: &[&str]) -> Result<&'static str, String> {
        let set = Set::chosen(&SETS, |name| given.contains(&name));
        set.map(|set| set.doc).map_err(|choice| choice.to_string())
    }

    #[test]
    fn a_set_follows_from_what_only_it_has() {
        assert_eq!(chosen(&["b"]), Ok("Two numbers."));
        assert_eq!(chosen(&["common", "d"]), Ok("One number, and more."));
        let only = Set::chosen(&SETS[..1], |_| false);
        assert_eq!(only.map(|set| set.doc), Ok("Two numbers."));
    }

    #[test]
    fn none_and_two_sets_are_refused() {
        let choices = "either `a` and `common` and `b` or `common` and `c` is needed";
        assert_eq!(chosen(&["common"]), Err(choices.to_owned()));
        let both = format!("`b` and `d` exclude each other; {choices}");
        assert_eq!(chosen(&["d", "b"]), Err(both));
        assert!(matches!(
            Set::chosen(&SETS, |_| true),
            Err(Choice::Exclusive { .. })
        ));
    }
}
