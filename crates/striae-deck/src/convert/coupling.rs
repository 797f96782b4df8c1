//! Couplings of nodes to a point, as rigid bodies that the nodes are tied to.

use super::Model;
use super::numbers;
use super::rigid::{Rigid, Shape};
use std::collections::BTreeSet;
use striae_meshfile::{Keyword, Row};

/// Components that rows `first, last` name, from 1.
fn components<'r>(rows: impl Iterator<Item = Vec<f64>> + 'r) -> BTreeSet<u64> {
    rows.flat_map(|row| {
        let first = row.first().map_or(1, |first| *first as u64);
        let last = row.get(1).map_or(first, |last| (*last as u64).max(first));
        first..=last.min(6)
    })
    .collect()
}

fn is_of_all_displacements(held: &BTreeSet<u64>) -> bool {
    held.is_empty() || (1..=3).all(|of| held.contains(&of))
}

impl<'a> Model<'a> {
    /// A kinematic coupling of all displacements.
    pub(super) fn coupling(&mut self, keyword: &'a Keyword<'a>) {
        self.used.insert(keyword.line);
        let known = ["CONSTRAINT NAME", "REF NODE", "SURFACE"];
        self.list_parameters(keyword, &known);
        let after = self
            .keywords
            .iter()
            .skip_while(|other| other.line != keyword.line);
        let Some(kind) = after.into_iter().nth(1) else {
            return;
        };
        let name = keyword.parameter("CONSTRAINT NAME").unwrap_or("coupling");
        if kind.name != "KINEMATIC" {
            let what = format!(
                "*COUPLING `{name}` with *{}: put loads on the surface, or couple by *KINEMATIC",
                kind.name
            );
            self.list(keyword.line, what);
            return;
        }
        self.used.insert(kind.line);
        let held = components(kind.rows.iter().filter_map(|row| numbers(&row.words)));
        if !is_of_all_displacements(&held) {
            self.list(
                kind.line,
                format!("*KINEMATIC `{name}` of some displacements only"),
            );
            return;
        }
        let surface = keyword.parameter("SURFACE").unwrap_or_default();
        let tied = self.nodes(surface);
        let reference = keyword
            .parameter("REF NODE")
            .and_then(|word| self.point(keyword, word));
        if tied.is_empty() {
            self.list(
                keyword.line,
                format!("*COUPLING `{name}`: no body has nodes of `{surface}`"),
            );
            return;
        }
        let name = self.rigid_name(name);
        self.rigid
            .push(Rigid::new(keyword.line, name, Shape::Tied(tied), reference));
    }

    /// `*KINEMATIC COUPLING, REF NODE=`, with rows `nodes, first, last`.
    pub(super) fn kinematic_coupling(&mut self, keyword: &'a Keyword<'a>) {
        self.used.insert(keyword.line);
        self.list_parameters(keyword, &["REF NODE"]);
        let mut tied = Vec::new();
        for row in &keyword.rows {
            let rest = numbers(row.words.get(1..).unwrap_or_default());
            let held = components(rest.into_iter().filter(|rest| !rest.is_empty()));
            let nodes = self.nodes(row.words[0]);
            if nodes.is_empty() || !is_of_all_displacements(&held) {
                let what = format!(
                    "*KINEMATIC COUPLING `{}` of no body, or of some displacements only",
                    row.words.join(", ")
                );
                self.list(row.line, what);
                continue;
            }
            tied.extend(nodes);
        }
        let word = keyword.parameter("REF NODE").unwrap_or_default();
        self.tie_to(keyword, word, "coupling", tied);
    }

    /// `*MPC`, of which `BEAM` ties nodes to one.
    pub(super) fn multi_point(&mut self, keyword: &'a Keyword<'a>) {
        self.used.insert(keyword.line);
        self.list_parameters(keyword, &[]);
        let mut beams: Vec<(&'a str, Vec<&'a Row<'a>>)> = Vec::new();
        for row in &keyword.rows {
            let word = |at: usize| row.words.get(at).copied().unwrap_or_default();
            let is_beam = word(0).eq_ignore_ascii_case("BEAM");
            // A control node that is part of a body moves with it.
            let is_free = self.points.find(word(2)).is_some() && self.nodes(word(2)).is_empty();
            if !is_beam || !is_free || self.nodes(word(1)).is_empty() {
                let what = format!(
                    "*MPC `{}`: tie nodes of a body to a free point by BEAM, or surfaces by *TIE",
                    row.words.join(", ")
                );
                self.list(row.line, what);
                continue;
            }
            match beams.iter_mut().find(|(point, _)| *point == word(2)) {
                Some((_, rows)) => rows.push(row),
                None => beams.push((word(2), vec![row])),
            }
        }
        for (point, rows) in beams {
            let tied = rows
                .iter()
                .flat_map(|row| self.nodes(row.words[1]))
                .collect();
            self.tie_to(keyword, point, "beams", tied);
        }
    }

    fn tie_to(
        &mut self,
        keyword: &'a Keyword<'a>,
        point: &str,
        name: &str,
        tied: Vec<(usize, String)>,
    ) {
        if tied.is_empty() {
            return;
        }
        let reference = self.point(keyword, point);
        let name = self.rigid_name(name);
        let shape = Shape::Tied(tied);
        self.rigid
            .push(Rigid::new(keyword.line, name, shape, reference));
    }
}
