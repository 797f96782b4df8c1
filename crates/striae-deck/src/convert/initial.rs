//! Initial conditions: velocities of whole bodies.

use super::bodies::Body;
use super::rigid::Rigid;
use super::stated::{Stated, Target};
use super::{Model, numbers};
use crate::write::value::{list, number, text, vector};
use striae_meshfile::Keyword;

impl<'a> Model<'a> {
    /// Reads `*INITIAL CONDITIONS`; a deck states velocities of whole bodies in steps with inertia.
    pub(super) fn initial_conditions(
        &mut self,
        keyword: &'a Keyword<'a>,
        is_dynamic: bool,
        stated: &mut Stated,
    ) {
        let kind = keyword.parameter("TYPE").unwrap_or_default().to_uppercase();
        if kind != "VELOCITY" {
            self.list(keyword.line, format!("*INITIAL CONDITIONS, TYPE={kind}"));
            return;
        }
        self.used.insert(keyword.line);
        self.list_parameters(keyword, &["TYPE"]);
        if !is_dynamic {
            let what = "*INITIAL CONDITIONS, TYPE=VELOCITY before a static step: there is no inertia in it";
            self.list(keyword.line, what);
            return;
        }
        for row in &keyword.rows {
            let words = row.words.join(", ");
            let all = numbers(row.words.get(1..).unwrap_or_default()).unwrap_or_default();
            let [component, value, ..] = all[..] else {
                self.list(row.line, format!("*INITIAL CONDITIONS `{words}`"));
                continue;
            };
            let (component, word) = (component as usize, row.words[0]);
            let (targets, limit) = match self.rigid_of_point(word) {
                Some(rigid) => (vec![Target::Rigid(rigid)], 6),
                None => {
                    let sets = self.nodes(word).into_iter();
                    let is_whole = |(body, set): &(usize, String)| {
                        let body = &self.bodies[*body];
                        body.nodes(set).len() == body.reading.mesh.positions.len()
                    };
                    let whole = sets.filter(is_whole).map(|(at, _)| (at, "all".to_owned()));
                    let whole = whole.map(|(at, set)| Target::Nodes(at, set));
                    (whole.collect(), 3)
                }
            };
            if targets.is_empty() || !(1..=limit).contains(&component) {
                let what =
                    format!("*INITIAL CONDITIONS `{words}`: velocities are those of whole bodies");
                self.list(row.line, what);
                continue;
            }
            for target in targets {
                let velocity = stated.velocities.entry(target).or_insert([0.0; 6]);
                velocity[component - 1] = value;
            }
        }
    }
}

impl Stated {
    /// Velocities at the start of the step.
    pub(super) fn velocities(&self, bodies: &[Body], rigid: &[Rigid]) -> Vec<String> {
        let entry = |(target, [x, y, z, rx, ry, rz]): (&Target, &[f64; 6])| {
            let velocity = list([*x, *y, *z].map(number));
            match target {
                Target::Nodes(body, _) => {
                    let body = text(&bodies[*body].name);
                    format!("{{ body = {body}, vector = {velocity} }}")
                }
                Target::Rigid(at) => {
                    let rigid = &rigid[*at];
                    let about = rigid.reference.map(|(_, x)| vector(&x));
                    let about = about.unwrap_or("[0.0, 0.0, 0.0]".to_owned());
                    format!(
                        "{{ rigid = {}, vector = {velocity}, spin = {}, about = {about} }}",
                        text(&rigid.name),
                        list([*rx, *ry, *rz].map(number))
                    )
                }
            }
        };
        self.velocities.iter().map(entry).collect()
    }
}
