//! Sets of numbers under labels that do not depend on capital letters.

use super::super::lines::parsed;
use super::super::{MeshFileFault, Place};
use super::keywords::{Keyword, Row};
use std::collections::BTreeMap;

/// Members with the line that names them, by label in capitals.
#[derive(Default)]
pub(super) struct LabelSets(BTreeMap<String, Set>);

struct Set {
    /// The label as it was first spelled.
    label: String,
    members: Vec<(usize, u64)>,
}

impl LabelSets {
    pub(super) fn get(&self, label: &str) -> Option<&[(usize, u64)]> {
        let set = self.0.get(&label.to_uppercase());
        set.map(|set| set.members.as_slice())
    }

    pub(super) fn push(&mut self, label: &str, line: usize, member: u64) {
        self.set(label).members.push((line, member));
    }

    /// Adds the members that the rows of a keyword name, by number, by
    /// `first, last, step` or by other sets.
    pub(super) fn extend(
        &mut self,
        label: &str,
        keyword: &Keyword<'_>,
    ) -> Result<(), MeshFileFault> {
        self.set(label);
        for row in &keyword.rows {
            let members = match keyword.parameter("GENERATE") {
                Some(_) => generated(row)?,
                None => self.listed(row)?,
            };
            let members = members.into_iter().map(|member| (row.line, member));
            self.set(label).members.extend(members);
        }
        Ok(())
    }

    /// The members that a word stands for: a number or the label of a set,
    /// either of which the name of the instance and a dot may precede.
    pub(super) fn members(&self, row: &Row<'_>, word: &str) -> Result<Vec<u64>, MeshFileFault> {
        let word = word.trim_matches('"');
        let bare = word.rsplit_once('.').map_or(word, |(_, bare)| bare);
        if let Ok(number) = bare.parse() {
            return Ok(vec![number]);
        }
        let members = self.get(word).or_else(|| self.get(bare));
        let members = members.ok_or_else(|| row.fault("a number or a set defined before"))?;
        Ok(members.iter().map(|member| member.1).collect())
    }

    pub(super) fn into_sets(self) -> BTreeMap<String, Vec<(Place, u64)>> {
        let placed = |set: Set| {
            let members = set.members.into_iter();
            let members = members.map(|(line, member)| (Place::Line(line), member));
            (set.label, members.collect())
        };
        self.0.into_values().map(placed).collect()
    }

    fn set(&mut self, label: &str) -> &mut Set {
        self.0.entry(label.to_uppercase()).or_insert_with(|| Set {
            label: label.to_owned(),
            members: Vec::new(),
        })
    }

    fn listed(&self, row: &Row<'_>) -> Result<Vec<u64>, MeshFileFault> {
        let mut members = Vec::new();
        for word in row.words.iter().filter(|word| !word.is_empty()) {
            members.extend(self.members(row, word)?);
        }
        Ok(members)
    }
}

/// Most members that one row may generate.
const MOST_GENERATED: u64 = 100_000_000;

fn generated(row: &Row<'_>) -> Result<Vec<u64>, MeshFileFault> {
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
    if step == 0 || last < first || (last - first) / step > MOST_GENERATED {
        return Err(row.fault("first, last and step with first <= last and a step of at least 1"));
    }
    Ok((first..=last).step_by(step as usize).collect())
}
