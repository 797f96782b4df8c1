//! Precedence among statements about two surfaces.

use std::collections::BTreeSet;

use super::{atom::Atom, label::Part};
use crate::path::Path;

/// Two atoms, the lower one first.
pub(super) type Couple = (usize, usize);

/// A statement about what meets.
#[derive(Clone, Debug)]
pub(super) struct Rule {
    /// Statement that it is.
    pub(super) stated: Stated,
    /// First surface.
    pub(super) a: Part,
    /// Second surface; `None`: any.
    pub(super) b: Option<Part>,
}

/// A statement by its kind and position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Stated {
    /// Surfaces that do not meet.
    Exclude(usize),
    /// Surfaces with a friction of their own.
    Between(usize),
}

impl Stated {
    /// Name of the list, and the position in it.
    pub(super) fn place(self) -> (&'static str, usize) {
        match self {
            Self::Exclude(at) => ("exclude", at),
            Self::Between(at) => ("between", at),
        }
    }

    /// Path in a model.
    pub(super) fn path(self) -> Path {
        let (list, at) = self.place();
        Path::of("contact").field(list).index(at)
    }

    /// Name in messages.
    pub(super) fn told(self) -> String {
        let (list, at) = self.place();
        format!("`{list}` {}", at + 1)
    }
}

/// Two statements of which neither is narrower, and a couple that both name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Undecided {
    /// Positions of the two rules.
    pub(super) rules: (usize, usize),
    /// The couple.
    pub(super) couple: Couple,
}

/// Rules with the couples that they name.
pub(super) struct Rules {
    couples: Vec<BTreeSet<Couple>>,
    /// Rules that leave couples out.
    excluding: Vec<bool>,
}

impl Rules {
    pub(super) fn new(rules: &[Rule], atoms: &[Atom]) -> Self {
        let couples = |rule: &Rule| {
            let members = |part: &Part| -> Vec<usize> {
                let all = atoms.iter().enumerate();
                let members = all.filter(|(_, atom)| atom.is_in(part));
                members.map(|(at, _)| at).collect()
            };
            let first = members(&rule.a);
            let second = rule.b.as_ref().map(members);
            let second = second.unwrap_or_else(|| (0..atoms.len()).collect());
            let couples = first.iter().flat_map(|&x| {
                let second = second.iter();
                second.map(move |&y| (x.min(y), x.max(y)))
            });
            couples.collect()
        };
        Self {
            couples: rules.iter().map(couples).collect(),
            excluding: rules
                .iter()
                .map(|rule| matches!(rule.stated, Stated::Exclude(_)))
                .collect(),
        }
    }

    /// Couples that a rule names.
    pub(super) fn couples(&self, rule: usize) -> &BTreeSet<Couple> {
        &self.couples[rule]
    }

    /// The rule that decides about a couple, if any names it.
    pub(super) fn deciding(&self, couple: Couple) -> Result<Option<usize>, Undecided> {
        let rules = 0..self.couples.len();
        let naming: Vec<usize> = rules
            .filter(|&at| self.couples[at].contains(&couple))
            .collect();
        let narrower = |one: usize, other: usize| {
            let (one, other) = (&self.couples[one], &self.couples[other]);
            one.len() < other.len() && one.is_subset(other)
        };
        let least = |&one: &usize| !naming.iter().any(|&other| narrower(other, one));
        let least: Vec<usize> = naming.iter().copied().filter(least).collect();
        match least[..] {
            [] => Ok(None),
            [one] => Ok(Some(one)),
            [first, ..] if least.iter().all(|&one| self.excluding[one]) => Ok(Some(first)),
            [first, second, ..] => Err(Undecided {
                rules: (first, second),
                couple,
            }),
        }
    }
}
