//! Parameters: names, forms with bounds, units, what holds where they are absent, descriptions.

use super::{Value, Values};

/// A parameter of a law, or several in one.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Name in decks; of [`Form::OneOf`] a name for those who read the code.
    pub name: &'static str,
    /// Form of its value.
    pub form: Form,
    /// Unit, such as `force per area`, or [`NO_UNIT`]; empty for a word.
    pub unit: &'static str,
    /// Value where none is given.
    pub absent: Absent,
    /// Description, one sentence or more, without unit and default.
    pub doc: &'static str,
}

/// Parameters that belong together.
#[derive(Debug)]
pub struct Set {
    /// Description in one sentence or more.
    pub doc: &'static str,
    /// The parameters.
    pub parameters: &'static [Parameter],
}

/// Form of the value of a parameter.
#[derive(Clone, Copy, Debug)]
pub enum Form {
    /// A finite number within bounds.
    Number(&'static [Bound]),
    /// A list of them.
    Numbers(&'static [Bound]),
    /// As many of them as stated.
    Several(usize, &'static [Bound]),
    /// Three finite numbers that are not all zero.
    Direction,
    /// A list of three finite numbers each.
    Vectors,
    /// A whole number that is not smaller than a least one.
    Whole(usize),
    /// As many numbers of things as stated, each at least 1.
    Counts(usize),
    /// One of a few words, each with its description.
    Word(&'static [(&'static str, &'static str)]),
    /// A list of pairs of finite numbers.
    Pairs,
    /// Values of its own parameters.
    Table(&'static Set),
    /// A list of them.
    Tables(&'static Set),
    /// No value of its own: parameters beside the others, exactly one of several sets of them.
    OneOf(&'static [Set]),
}

/// A bound of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// Larger than.
    Above(f64),
    /// Not smaller than.
    AtLeast(f64),
    /// Smaller than.
    Below(f64),
    /// Not larger than.
    AtMost(f64),
}

/// Value of a parameter that is not given.
#[derive(Clone, Copy, Debug)]
pub enum Absent {
    /// There is none: the parameter is required.
    Refused,
    /// A number.
    Number(f64),
    /// Several numbers.
    Numbers(&'static [f64]),
    /// A whole number.
    Whole(usize),
    /// Several numbers of things.
    Counts(&'static [usize]),
    /// A word.
    Word(&'static str),
    /// A number that follows from the parameters before it, and the formula in words.
    Computed(&'static str, fn(&Values) -> f64),
    /// The law does without.
    Nothing,
    /// The law does something else, which is told in words.
    Otherwise(&'static str),
    /// Decks must give a value, programs have this one.
    InPrograms(&'static Absent),
}

/// A line in space: the parameters of [`Parameter::axis`].
pub static AXIS: Set = Set {
    doc: "A line in space.",
    parameters: &[
        Parameter::position("point", "A point of the axis."),
        Parameter::direction("direction", "Direction of the axis, of any length."),
    ],
};

/// Unit of a ratio.
pub const NO_UNIT: &str = "no unit";
/// Unit of a distance.
pub const LENGTH: &str = "length";
/// Bounds of a number greater than zero.
pub const POSITIVE: &[Bound] = &[Bound::Above(0.0)];
/// Bounds of a number of at least zero.
pub const NOT_NEGATIVE: &[Bound] = &[Bound::AtLeast(0.0)];
/// Bounds of any finite number.
pub const ANY: &[Bound] = &[];
/// Bounds of Poisson's ratio of a compressible solid.
pub const POISSONS_RATIO: &[Bound] = &[Bound::Above(-1.0), Bound::Below(0.5)];

impl Bound {
    /// Returns whether a number respects the bound.
    pub fn admits(self, value: f64) -> bool {
        match self {
            Self::Above(limit) => value > limit,
            Self::AtLeast(limit) => value >= limit,
            Self::Below(limit) => value < limit,
            Self::AtMost(limit) => value <= limit,
        }
    }
}

impl Parameter {
    /// Returns a number that must be given.
    pub const fn number(
        name: &'static str,
        bounds: &'static [Bound],
        unit: &'static str,
        doc: &'static str,
    ) -> Self {
        Self {
            name,
            form: Form::Number(bounds),
            unit,
            absent: Absent::Refused,
            doc,
        }
    }

    /// Returns a list of numbers that must be given.
    pub const fn numbers(
        name: &'static str,
        bounds: &'static [Bound],
        unit: &'static str,
        doc: &'static str,
    ) -> Self {
        Self {
            form: Form::Numbers(bounds),
            ..Self::number(name, bounds, unit, doc)
        }
    }

    /// Returns so many numbers that must be given.
    pub const fn several(
        name: &'static str,
        count: usize,
        bounds: &'static [Bound],
        unit: &'static str,
        doc: &'static str,
    ) -> Self {
        Self {
            form: Form::Several(count, bounds),
            ..Self::number(name, bounds, unit, doc)
        }
    }

    /// Returns a position, by default the origin.
    pub const fn position(name: &'static str, doc: &'static str) -> Self {
        Self {
            absent: Absent::Numbers(&[0.0; 3]),
            ..Self::several(name, 3, ANY, LENGTH, doc)
        }
    }

    /// Returns a vector of any length but zero that must be given.
    pub const fn direction(name: &'static str, doc: &'static str) -> Self {
        Self {
            form: Form::Direction,
            ..Self::number(name, ANY, "", doc)
        }
    }

    /// Returns an axis that must be given, by its direction and by default through the origin.
    pub const fn axis(name: &'static str, doc: &'static str) -> Self {
        Self::table(name, &AXIS, doc)
    }

    /// Returns a list of vectors that must be given.
    pub const fn vectors(name: &'static str, unit: &'static str, doc: &'static str) -> Self {
        Self {
            form: Form::Vectors,
            ..Self::number(name, ANY, unit, doc)
        }
    }

    /// Returns a whole number that must be given.
    pub const fn whole(name: &'static str, least: usize, doc: &'static str) -> Self {
        Self {
            form: Form::Whole(least),
            ..Self::number(name, ANY, "", doc)
        }
    }

    /// Returns so many numbers of things that must be given.
    pub const fn counts(name: &'static str, count: usize, doc: &'static str) -> Self {
        Self {
            form: Form::Counts(count),
            ..Self::number(name, ANY, "", doc)
        }
    }

    /// Returns a word, the first one by default.
    pub const fn word(
        name: &'static str,
        words: &'static [(&'static str, &'static str)],
        doc: &'static str,
    ) -> Self {
        Self {
            form: Form::Word(words),
            absent: Absent::Word(words[0].0),
            ..Self::number(name, ANY, "", doc)
        }
    }

    /// Returns a list of pairs of numbers that must be given.
    pub const fn pairs(name: &'static str, doc: &'static str) -> Self {
        Self {
            form: Form::Pairs,
            ..Self::number(name, ANY, "", doc)
        }
    }

    /// Returns a table of parameters that must be given.
    pub const fn table(name: &'static str, set: &'static Set, doc: &'static str) -> Self {
        Self {
            form: Form::Table(set),
            ..Self::number(name, ANY, "", doc)
        }
    }

    /// Returns a list of tables of parameters that must be given.
    pub const fn tables(name: &'static str, set: &'static Set, doc: &'static str) -> Self {
        Self {
            form: Form::Tables(set),
            ..Self::number(name, ANY, "", doc)
        }
    }

    /// Returns the parameters of exactly one of several sets, or those of the only one.
    pub const fn one_of(name: &'static str, sets: &'static [Set]) -> Self {
        Self {
            form: Form::OneOf(sets),
            ..Self::number(name, ANY, "", "")
        }
    }

    /// Returns the parameter with another value where none is given.
    pub const fn or(self, absent: Absent) -> Self {
        Self { absent, ..self }
    }

    /// Returns the parameter with a value that programs need not give, but decks must.
    pub const fn or_in_programs(self, absent: &'static Absent) -> Self {
        self.or(Absent::InPrograms(absent))
    }

    /// Returns whether decks must give a value.
    pub fn is_required(&self) -> bool {
        matches!(self.absent, Absent::Refused | Absent::InPrograms(_))
    }

    /// Returns whether programs must give a value, too.
    pub fn is_required_in_programs(&self) -> bool {
        matches!(self.absent, Absent::Refused)
    }

    /// Returns the description with unit and default.
    pub fn told(&self) -> String {
        let doc = match self.unit {
            "" | NO_UNIT => self.doc.to_owned(),
            unit => format!("{} ({unit}).", self.doc.trim_end_matches('.')),
        };
        match self.absent.told() {
            Some(default) if !self.is_required() => format!("{doc} Default: {default}."),
            _ => doc,
        }
    }

    pub(super) fn default(&self, values: &Values) -> Option<Value> {
        self.absent.value(values)
    }
}

impl Absent {
    /// Returns the description of the default, in which code is in ticks; nothing where a value
    /// must be given.
    pub fn told(&self) -> Option<String> {
        Some(match self {
            Self::Refused => return None,
            Self::Number(number) => number.to_string(),
            Self::Numbers(numbers) => format!("`{}`", list(numbers)),
            Self::Whole(number) => number.to_string(),
            Self::Counts(counts) => format!("`{}`", list(counts)),
            Self::Word(told) | Self::Computed(told, _) => format!("`{told}`"),
            Self::Nothing => "none".to_owned(),
            Self::Otherwise(told) => (*told).to_owned(),
            Self::InPrograms(absent) => return absent.told(),
        })
    }

    fn value(&self, values: &Values) -> Option<Value> {
        match self {
            Self::Refused | Self::Nothing | Self::Otherwise(_) => None,
            Self::Number(number) => Some((*number).into()),
            Self::Numbers(numbers) => Some((*numbers).into()),
            Self::Whole(number) => Some((*number).into()),
            Self::Counts(counts) => Some((*counts).into()),
            Self::Word(word) => Some((*word).into()),
            Self::Computed(_, value) => Some(value(values).into()),
            Self::InPrograms(absent) => absent.value(values),
        }
    }
}

fn list(items: &[impl ToString]) -> String {
    let items: Vec<String> = items.iter().map(ToString::to_string).collect();
    format!("[{}]", items.join(", "))
}

#[cfg(test)]
mod tests {
    use super::{Absent, POSITIVE, Parameter};
    use crate::Values;

    #[test]
    fn defaults_are_told_but_for_those_of_programs() {
        let place = Parameter::position("place", "A place.");
        assert_eq!(place.told(), "A place (length). Default: `[0, 0, 0]`.");
        let equal = Absent::Otherwise("equal");
        let lengths = Parameter::numbers("lengths", POSITIVE, "", "Lengths.").or(equal);
        assert_eq!(lengths.told(), "Lengths. Default: equal.");
        let counts = Parameter::counts("counts", 2, "Counts.");
        let counts = counts.or_in_programs(&Absent::Counts(&[2, 3]));
        assert!(counts.is_required());
        assert_eq!(counts.told(), "Counts.");
        let value = counts.default(&Values::default());
        assert_eq!(value, Some([2, 3][..].into()));
    }
}
