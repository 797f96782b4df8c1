//! Sets of numbers under labels that do not depend on capital letters.

use super::super::Place;
use super::instance::Placement;
use std::collections::{BTreeMap, HashSet};

/// Kind of the members of sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Member {
    Node,
    Element,
}

/// Members with the line that names them, by label in capitals.
#[derive(Clone)]
pub(super) struct LabelSets {
    of: Member,
    sets: BTreeMap<String, Set>,
    /// Numbers that ranges name, which need not all be defined.
    in_ranges: HashSet<u64>,
}

#[derive(Clone)]
struct Set {
    /// The label as it was first spelled.
    label: String,
    members: Vec<(usize, u64)>,
    /// Numbers of the members, each of which is named once: sets may name themselves.
    known: HashSet<u64>,
}

impl LabelSets {
    /// No sets.
    pub(super) fn new(of: Member) -> Self {
        Self {
            of,
            sets: BTreeMap::new(),
            in_ranges: HashSet::new(),
        }
    }

    /// Kind of the members.
    pub(super) fn of(&self) -> Member {
        self.of
    }

    pub(super) fn get(&self, label: &str) -> Option<&[(usize, u64)]> {
        let set = self.sets.get(&label.to_uppercase());
        set.map(|set| set.members.as_slice())
    }

    /// Members of all sets.
    pub(super) fn members(&self) -> impl Iterator<Item = u64> {
        let sets = self.sets.values();
        sets.flat_map(|set| set.members.iter().map(|(_, member)| *member))
    }

    /// All labels as they were first spelled.
    pub(super) fn labels(&self) -> Vec<String> {
        self.sets.values().map(|set| set.label.clone()).collect()
    }

    pub(super) fn push(&mut self, label: &str, line: usize, member: u64) {
        self.set(label).push(line, member);
    }

    /// Adds a member that a range of numbers names.
    pub(super) fn push_in_range(&mut self, label: &str, line: usize, member: u64) {
        self.in_ranges.insert(member);
        self.push(label, line, member);
    }

    /// Numbers of ranges that are not defined.
    pub(super) fn undefined(&self, is_defined: impl Fn(u64) -> bool) -> HashSet<u64> {
        let in_ranges = self.in_ranges.iter().copied();
        in_ranges.filter(|member| !is_defined(*member)).collect()
    }

    /// Leaves out numbers of ranges that are not defined, and returns notes about them.
    pub(super) fn leave_out(&mut self, undefined: &HashSet<u64>) -> Vec<String> {
        let mut notes = Vec::new();
        for set in self.sets.values_mut() {
            let before = set.members.len();
            let missing = |(_, member): &(usize, u64)| undefined.contains(member);
            let Some(line) = set.members.iter().find(|of| missing(of)).map(|of| of.0) else {
                continue;
            };
            set.members.retain(|of| !missing(of));
            let label = &set.label;
            notes.push(format!(
                "set `{label}`: numbers of a range, the first in line {line}, that are not defined and left out: {}",
                before - set.members.len()
            ));
        }
        notes
    }

    /// A label as it was first spelled.
    pub(super) fn spelled(&self, label: &str) -> String {
        let known = self.sets.get(&label.to_uppercase());
        known.map_or(label, |set| &set.label).to_owned()
    }

    /// Knows a label, if without members.
    pub(super) fn name(&mut self, label: &str) {
        self.set(label);
    }

    /// Adds the sets of a part that is placed.
    pub(super) fn place(&mut self, part: &Self, at: &Placement) {
        let in_ranges = part.in_ranges.iter();
        self.in_ranges
            .extend(in_ranges.map(|member| member + at.raise));
        for Set { label, members, .. } in part.sets.values() {
            let set = self.set(&format!("{}{label}", at.prefix));
            for (line, member) in members {
                set.push(*line, member + at.raise);
            }
        }
    }

    pub(super) fn into_sets(self) -> BTreeMap<String, Vec<(Place, u64)>> {
        let placed = |set: Set| {
            let members = set.members.into_iter();
            let members = members.map(|(line, member)| (Place::Line(line), member));
            (set.label, members.collect())
        };
        self.sets.into_values().map(placed).collect()
    }

    fn set(&mut self, label: &str) -> &mut Set {
        let set = self.sets.entry(label.to_uppercase());
        set.or_insert_with(|| Set {
            label: label.to_owned(),
            members: Vec::new(),
            known: HashSet::new(),
        })
    }
}

impl Set {
    fn push(&mut self, line: usize, member: u64) {
        if self.known.insert(member) {
            self.members.push((line, member));
        }
    }
}
