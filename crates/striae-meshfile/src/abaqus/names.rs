//! Names in an Abaqus file: numbers and labels, with and without an instance.
//!
//! If there are several instances of parts, the nodes and elements of the `i`-th (from 0) get their
//! numbers plus `i 2^40` in the whole, and the labels of its sets begin with its name and a dot. A
//! single instance keeps its numbers and labels.

use super::super::MeshFileFault;
use super::super::lines::parsed;
use super::super::numbers::NUMBER_BITS;
use super::keywords::{Keyword, Row};
use super::sets::{LabelSets, Member};
use std::collections::BTreeSet;

/// The instances whose numbers and labels are known.
#[derive(Clone, Default)]
pub(super) struct Names {
    instances: Vec<String>,
    /// `true` if the file has more than one instance.
    several: bool,
    /// The instance that a keyword speaks of.
    current: Option<usize>,
    /// Numbers of nodes and of elements of the assembly itself.
    nodes: BTreeSet<u64>,
    elements: BTreeSet<u64>,
    /// Rows of the file: no part has more nodes or elements.
    rows: u64,
}

impl Names {
    /// Names of a file.
    pub(super) fn of(keywords: &[Keyword<'_>]) -> Self {
        let instances = keywords.iter();
        let instances = instances.filter(|keyword| keyword.name == "INSTANCE");
        let rows = keywords.iter().map(|keyword| keyword.rows.len() as u64);
        Self {
            several: instances.count() > 1,
            rows: rows.sum(),
            ..Self::default()
        }
    }

    /// Names in a part, which knows no instance.
    pub(super) fn of_part(&self) -> Self {
        Self {
            rows: self.rows,
            ..Self::default()
        }
    }

    /// The names of the instances, where their numbers need these.
    pub(super) fn needed(self) -> Vec<String> {
        if self.several {
            self.instances
        } else {
            Vec::new()
        }
    }

    /// The place among several instances of one with this name, 0 of a single one.
    pub(super) fn instance(&self, name: &str) -> Option<u64> {
        self.place(name).map(|at| at as u64)
    }

    /// The name of the only instance.
    pub(super) fn only(&self) -> Option<&str> {
        match &self.instances[..] {
            [only] => Some(only),
            _ => None,
        }
    }

    /// Returns whether there is no instance.
    pub(super) fn is_empty(&self) -> bool {
        self.instances.is_empty()
    }

    /// Adds an instance; what its numbers are raised by and what its labels begin with.
    pub(super) fn add(&mut self, keyword: &Keyword<'_>) -> Result<(u64, String), MeshFileFault> {
        let name = keyword.required("NAME")?;
        if self.place(name).is_some() {
            return Err(keyword.fault("a name that no other instance has"));
        }
        self.instances.push(name.to_owned());
        Ok(match self.several {
            true => (
                ((self.instances.len() - 1) as u64) << NUMBER_BITS,
                format!("{name}."),
            ),
            false => (0, String::new()),
        })
    }

    /// Notes nodes of the assembly itself.
    pub(super) fn own_nodes(&mut self, keyword: &Keyword<'_>) -> Result<(), MeshFileFault> {
        for row in &keyword.rows {
            self.nodes
                .insert(parsed(row.line, row.words[0], "a node number")?);
        }
        Ok(())
    }

    /// Notes elements of the assembly itself.
    pub(super) fn own_elements(&mut self, keyword: &Keyword<'_>) -> Result<(), MeshFileFault> {
        for row in keyword.joined_rows(usize::MAX) {
            self.elements
                .insert(parsed(row.line, row.words[0], "an element number")?);
        }
        Ok(())
    }

    /// The names for a keyword, which may say what instance its words are of.
    pub(super) fn for_keyword(&self, keyword: &Keyword<'_>) -> Result<Self, MeshFileFault> {
        let mut names = self.clone();
        if let Some(instance) = keyword.parameter("INSTANCE") {
            let known = self.place(instance);
            names.current = Some(known.ok_or_else(|| keyword.fault("an instance defined before"))?);
        }
        Ok(names)
    }

    /// Adds to a set the members that the rows of a keyword name, by number, by
    /// `first, last, step` or by other sets.
    pub(super) fn extend(
        &self,
        sets: &mut LabelSets,
        label: &str,
        keyword: &Keyword<'_>,
    ) -> Result<(), MeshFileFault> {
        sets.name(label);
        for row in &keyword.rows {
            if keyword.parameter("GENERATE").is_some() {
                for member in self.generated(sets, row)? {
                    sets.push_in_range(label, row.line, member);
                }
                continue;
            }
            for member in self.listed(sets, row)? {
                sets.push(label, row.line, member);
            }
        }
        Ok(())
    }

    fn listed(&self, sets: &LabelSets, row: &Row<'_>) -> Result<Vec<u64>, MeshFileFault> {
        let mut members = Vec::new();
        for word in row.words.iter().filter(|word| !word.is_empty()) {
            members.extend(self.members(sets, row, word)?);
        }
        Ok(members)
    }

    fn generated(&self, sets: &LabelSets, row: &Row<'_>) -> Result<Vec<u64>, MeshFileFault> {
        let mut members = Vec::new();
        for number in generated(row, self.rows)? {
            members.extend(self.number(sets, row, self.current, number)?);
        }
        Ok(members)
    }

    /// The members that a word stands for: a number or the label of a set; none for a number of
    /// the assembly itself.
    pub(super) fn members(
        &self,
        sets: &LabelSets,
        row: &Row<'_>,
        word: &str,
    ) -> Result<Vec<u64>, MeshFileFault> {
        let word = word.trim_matches('"');
        let (instance, bare) = self.parted(word);
        if let Ok(number) = bare.parse::<u64>() {
            let member = self.number(sets, row, instance, number)?;
            return Ok(member.into_iter().collect());
        }
        let prefixed = instance.map(|at| format!("{}.{bare}", self.instances[at]));
        let of_instance = prefixed.and_then(|label| sets.get(&label));
        let members = of_instance.or_else(|| sets.get(word));
        let members = members.or_else(|| sets.get(bare).filter(|_| !self.several));
        let members = members.ok_or_else(|| row.fault("a number or a set defined before"))?;
        Ok(members.iter().map(|member| member.1).collect())
    }

    /// The member that a number stands for.
    fn number(
        &self,
        sets: &LabelSets,
        row: &Row<'_>,
        instance: Option<usize>,
        number: u64,
    ) -> Result<Option<u64>, MeshFileFault> {
        let own = match sets.of() {
            Member::Node => &self.nodes,
            Member::Element => &self.elements,
        };
        match instance {
            None if own.contains(&number) => Ok(None),
            _ if !self.several => Ok(Some(number)),
            Some(instance) if number < 1 << NUMBER_BITS => {
                Ok(Some(((instance as u64) << NUMBER_BITS) + number))
            }
            _ => Err(row.fault("a number with the name of its instance")),
        }
    }

    /// The instance and the rest of a word.
    fn parted<'w>(&self, word: &'w str) -> (Option<usize>, &'w str) {
        let dots = word.match_indices('.').map(|(at, _)| at);
        let mut parted = dots.filter_map(|at| Some((self.place(&word[..at])?, &word[at + 1..])));
        if let Some((instance, rest)) = parted.next() {
            return (Some(instance), rest);
        }
        match self.instances.is_empty() {
            // A part may have been written without the assembly that its words speak of.
            true => (None, word.rsplit_once('.').map_or(word, |(_, bare)| bare)),
            false => (self.current, word),
        }
    }

    fn place(&self, instance: &str) -> Option<usize> {
        let mut known = self.instances.iter();
        known.position(|name| name.eq_ignore_ascii_case(instance))
    }
}

/// The numbers of a row, of which there can be no more than the file has rows.
fn generated(row: &Row<'_>, rows: u64) -> Result<Vec<u64>, MeshFileFault> {
    let expected = "first, last and step";
    let numbers: Vec<u64> = row
        .words
        .iter()
        .filter(|word| !word.is_empty())
        .map(|word| parsed(row.line, word, expected))
        .collect::<Result<_, _>>()?;
    let (first, last, step) = match numbers[..] {
        [first, last] => (first, last, 1),
        [first, last, step] => (first, last, step),
        _ => return Err(row.fault(expected)),
    };
    if step == 0 || last < first {
        return Err(row.fault("first, last and step with first <= last and a step of at least 1"));
    }
    if (last - first) / step >= rows {
        return Err(row.fault("first, last and step of numbers that the file defines"));
    }
    Ok((first..=last).step_by(step as usize).collect())
}
