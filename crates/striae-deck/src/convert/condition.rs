//! Boundary conditions and loads of a step.

use super::amplitude::{Approach, Period};
use super::{Model, has, numbers};
use crate::write::value::{list, number, text};
use std::collections::{BTreeMap, BTreeSet};
use striae_meshfile::Keyword;

/// Target of a condition.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Target {
    /// A body by place, and a node set.
    Nodes(usize, String),
    /// A rigid body by place.
    Rigid(usize),
}

/// A component of what a condition is on.
pub(super) type Component = (Target, usize);

/// Present values of all that is prescribed or applied.
#[derive(Default)]
pub(super) struct History {
    pub(super) prescribed: BTreeMap<Component, f64>,
    /// Loads by the words that name them.
    loads: BTreeMap<String, f64>,
}

/// Conditions stated by the keywords of a step.
#[derive(Default)]
pub(super) struct Stated {
    pub(super) prescribed: BTreeMap<Component, (f64, Option<String>)>,
    /// Axes of node sets that have their own, by body.
    axes: BTreeMap<(usize, String), String>,
    /// `true` if conditions that are not stated again end.
    pub(super) is_new: bool,
    pub(super) pressures: Vec<String>,
    pub(super) tractions: Vec<String>,
    pub(super) gravity: Option<String>,
    /// Forces and torques on rigid bodies.
    pub(super) forces: BTreeMap<(usize, usize), (f64, Option<String>)>,
}

/// Components that a word such as `PINNED` holds.
fn named(word: &str) -> Option<Vec<usize>> {
    let held: &[usize] = match word.to_uppercase().as_str() {
        "ENCASTRE" => &[0, 1, 2, 3, 4, 5],
        "PINNED" => &[0, 1, 2],
        "XSYMM" => &[0, 4, 5],
        "YSYMM" => &[1, 3, 5],
        "ZSYMM" => &[2, 3, 4],
        "XASYMM" => &[1, 2, 3],
        "YASYMM" => &[0, 2, 4],
        "ZASYMM" => &[0, 1, 5],
        _ => return None,
    };
    Some(held.to_vec())
}

impl<'a> Model<'a> {
    /// Reads `*BOUNDARY`.
    pub(super) fn boundary(
        &mut self,
        keyword: &'a Keyword<'a>,
        period: Period,
        history: &History,
        stated: &mut Stated,
    ) {
        self.used.insert(keyword.line);
        let known = ["AMPLITUDE", "OP", "TYPE", "LOAD CASE"];
        self.list_parameters(keyword, &known);
        stated.is_new |= has(keyword, "OP", "NEW");
        let kind = keyword.parameter("TYPE").unwrap_or("DISPLACEMENT");
        if !kind.eq_ignore_ascii_case("DISPLACEMENT") {
            self.list(keyword.line, format!("*BOUNDARY, TYPE={kind}"));
            return;
        }
        for row in &keyword.rows {
            let word = row.words[0];
            let second = row.words.get(1).copied().unwrap_or_default();
            let (held, value) = match named(second) {
                Some(held) => (held, 0.0),
                None => {
                    let Some(all) = numbers(&row.words[1..]).filter(|all| !all.is_empty()) else {
                        self.list(row.line, format!("*BOUNDARY `{}`", row.words.join(", ")));
                        continue;
                    };
                    let first = all[0] as usize;
                    let last = all.get(1).map_or(first, |last| (*last as usize).max(first));
                    if !(1..=6).contains(&first) || last > 6 {
                        self.list(row.line, format!("*BOUNDARY `{}`", row.words.join(", ")));
                        continue;
                    }
                    (
                        (first - 1..last).collect(),
                        all.get(2).copied().unwrap_or(0.0),
                    )
                }
            };
            let targets = self.targets(word);
            if targets.is_empty() {
                let what =
                    format!("*BOUNDARY of `{word}`, which belongs to no body and no rigid body");
                self.list(row.line, what);
            }
            let axes = self.axes(word);
            for target in targets {
                let is_solid = matches!(target, Target::Nodes(..));
                if let (Target::Nodes(body, set), Some(axes)) = (&target, &axes) {
                    stated.axes.insert((*body, set.clone()), axes.clone());
                }
                if is_solid && held.iter().all(|component| *component > 2) {
                    self.list(row.line, format!("*BOUNDARY: rotations of `{word}`"));
                }
                for &component in held.iter().filter(|component| !is_solid || **component < 3) {
                    let key = (target.clone(), component);
                    let present = history.prescribed.get(&key).copied().unwrap_or(0.0);
                    let amplitude = keyword.parameter("AMPLITUDE");
                    match self.approach(amplitude, period, [present, value]) {
                        Ok(Approach { target, curve }) => {
                            stated.prescribed.insert(key, (target, curve));
                        }
                        Err(what) => self.list(row.line, format!("*BOUNDARY of `{word}`: {what}")),
                    }
                }
            }
        }
    }

    /// Axes of the nodes that a word stands for, by `*TRANSFORM`.
    fn axes(&mut self, word: &str) -> Option<String> {
        let of_word =
            |keyword: &&Keyword<'_>| keyword.name == "TRANSFORM" && has(keyword, "NSET", word);
        let keyword = self.keywords.iter().find(of_word)?;
        let all = numbers(&keyword.rows.first()?.words)?;
        let (a, b) = all.get(..6)?.split_at(3);
        let told = |vector: &[f64]| list(vector.iter().map(|x| number(*x)));
        let kind = keyword.parameter("TYPE").unwrap_or("R").to_uppercase();
        let axes = match kind.as_str() {
            "R" => list([a, b].map(told)),
            "C" => {
                let along: Vec<f64> = a.iter().zip(b).map(|(a, b)| b - a).collect();
                format!("{{ point = {}, axis = {} }}", told(a), told(&along))
            }
            _ => return None,
        };
        self.used.insert(keyword.line);
        Some(axes)
    }

    /// Targets that a word refers to.
    fn targets(&mut self, word: &str) -> Vec<Target> {
        if let Some(rigid) = self.rigid_of_point(word) {
            return vec![Target::Rigid(rigid)];
        }
        let sets = self.nodes(word).into_iter();
        sets.map(|(body, set)| Target::Nodes(body, set)).collect()
    }

    /// Reads `*CLOAD`: forces on reference points.
    pub(super) fn forces(
        &mut self,
        keyword: &'a Keyword<'a>,
        period: Period,
        history: &mut History,
        stated: &mut Stated,
    ) {
        self.used.insert(keyword.line);
        self.list_parameters(keyword, &["AMPLITUDE", "OP"]);
        for row in &keyword.rows {
            let word = row.words[0];
            let all = numbers(&row.words[1..]).unwrap_or_default();
            let (Some(rigid), [component, value]) = (self.rigid_of_point(word), &all[..]) else {
                let what = format!(
                    "*CLOAD `{}`: a deck has forces on rigid bodies only; spread it as a traction",
                    row.words.join(", ")
                );
                self.list(row.line, what);
                continue;
            };
            let component = (*component as usize).clamp(1, 6) - 1;
            let key = format!("force {rigid} {component}");
            match self.load(keyword, period, history, &key, *value) {
                Ok(Approach { target, curve }) => {
                    stated.forces.insert((rigid, component), (target, curve));
                }
                Err(what) => self.list(row.line, format!("*CLOAD of `{word}`: {what}")),
            }
        }
    }

    /// Reads `*DSLOAD`: pressures and tractions on surfaces.
    pub(super) fn surface_loads(
        &mut self,
        keyword: &'a Keyword<'a>,
        period: Period,
        history: &mut History,
        stated: &mut Stated,
    ) {
        self.used.insert(keyword.line);
        self.list_parameters(
            keyword,
            &["AMPLITUDE", "OP", "FOLLOWER", "CONSTANT RESULTANT"],
        );
        for row in &keyword.rows {
            let word = row.words[0];
            let kind = row.words.get(1).copied().unwrap_or_default().to_uppercase();
            let all = numbers(row.words.get(2..).unwrap_or_default()).unwrap_or_default();
            let facets = self.facets(word);
            let is_known = matches!((kind.as_str(), all.len()), ("P", 1..) | ("TRVEC", 4..));
            if facets.is_empty() || !is_known {
                self.list(row.line, format!("*DSLOAD `{}`", row.words.join(", ")));
                continue;
            }
            let found = self.load(keyword, period, history, &format!("{kind} {word}"), all[0]);
            let Approach { target, curve } = match found {
                Ok(found) => found,
                Err(what) => {
                    self.list(row.line, format!("*DSLOAD of `{word}`: {what}"));
                    continue;
                }
            };
            for (body, facets) in facets {
                let on = format!("body = {}, facets = {}", text(&body), text(&facets));
                let curve = curve_key(&curve);
                if kind == "P" {
                    let value = number(target);
                    stated
                        .pressures
                        .push(format!("{{ {on}, value = {value}{curve} }}"));
                    continue;
                }
                let length = all[1..4].iter().map(|x| x * x).sum::<f64>().sqrt();
                let vector = all[1..4].iter().map(|x| number(target * x / length));
                let direction = match has(keyword, "FOLLOWER", "NO") {
                    true => "dead",
                    false => "follower",
                };
                stated.tractions.push(format!(
                    "{{ {on}, vector = {}, direction = \"{direction}\"{curve} }}",
                    list(vector)
                ));
            }
        }
    }

    /// Reads `*DLOAD`: gravity.
    pub(super) fn body_loads(
        &mut self,
        keyword: &'a Keyword<'a>,
        period: Period,
        history: &mut History,
        stated: &mut Stated,
    ) {
        self.used.insert(keyword.line);
        self.list_parameters(keyword, &["AMPLITUDE", "OP"]);
        for row in &keyword.rows {
            let is_gravity = row
                .words
                .get(1)
                .is_some_and(|kind| kind.eq_ignore_ascii_case("GRAV"));
            let all = numbers(row.words.get(2..).unwrap_or_default()).unwrap_or_default();
            let ([size, x, y, z], true) = (&all[..], is_gravity) else {
                self.list(row.line, format!("*DLOAD `{}`", row.words.join(", ")));
                continue;
            };
            if !row.words[0].is_empty() && self.bodies.len() > 1 {
                let what = format!(
                    "*DLOAD, GRAV of `{}`: gravity is on all bodies",
                    row.words[0]
                );
                self.list(row.line, what);
            }
            match self.load(keyword, period, history, "gravity", *size) {
                Ok(Approach { target, curve }) => {
                    let length = (x * x + y * y + z * z).sqrt();
                    let vector = [x, y, z].map(|x| number(target * x / length));
                    let (vector, curve) = (list(vector), curve_key(&curve));
                    stated.gravity = Some(format!("{{ vector = {vector}{curve} }}"));
                }
                Err(what) => self.list(row.line, format!("*DLOAD, GRAV: {what}")),
            }
        }
    }

    fn load(
        &mut self,
        keyword: &Keyword<'_>,
        period: Period,
        history: &mut History,
        key: &str,
        value: f64,
    ) -> Result<Approach, String> {
        if has(keyword, "OP", "NEW") && history.loads.keys().any(|known| known != key) {
            self.list(
                keyword.line,
                format!("*{}, OP=NEW: earlier loads stay", keyword.name),
            );
        }
        let present = history.loads.get(key).copied().unwrap_or(0.0);
        let found = self.approach(keyword.parameter("AMPLITUDE"), period, [present, value])?;
        history.loads.insert(key.to_owned(), found.target);
        Ok(found)
    }
}

/// `, curve = ...`, nothing for the ramp.
pub(super) fn curve_key(curve: &Option<String>) -> String {
    let curve = curve.as_ref();
    curve.map_or(String::new(), |curve| format!(", curve = {}", text(curve)))
}

impl Stated {
    /// Conditions of nodes: displacements of each set along each curve.
    pub(super) fn displacements(&self, bodies: &[super::bodies::Body]) -> Vec<String> {
        let mut groups: BTreeMap<(usize, &str, &Option<String>), String> = BTreeMap::new();
        for ((target, component), (value, curve)) in &self.prescribed {
            let Target::Nodes(body, set) = target else {
                continue;
            };
            let keys = groups.entry((*body, set, curve)).or_default();
            *keys += &format!(", {} = {}", ["x", "y", "z"][*component], number(*value));
        }
        let entry = |((body, set, curve), keys): ((usize, &str, &Option<String>), String)| {
            let axes = self.axes.get(&(body, set.to_owned()));
            let axes = axes.map(|axes| format!(", axes = {axes}"));
            let (body, set) = (text(&bodies[body].name), text(set));
            format!(
                "{{ body = {body}, nodes = {set}{}{keys}{} }}",
                axes.unwrap_or_default(),
                curve_key(curve)
            )
        };
        groups.into_iter().map(entry).collect()
    }

    /// Prescribed components that are not stated again.
    pub(super) fn ended(&self, history: &History) -> BTreeSet<Component> {
        let before = history.prescribed.keys();
        let ended = before.filter(|key| self.is_new && !self.prescribed.contains_key(*key));
        ended.cloned().collect()
    }
}
