//! Loads of a step: forces, pressures, tractions and gravity.
//!
//! Statements of a load are collected first, as components of a force may come from several
//! rows. In the deck a load has one vector and one curve, over the time of the run where there is
//! an amplitude.

use super::amplitude::{Approach, Over, Period};
use super::bodies::Body;
use super::faces::side;
use super::stated::{Family, History, Load, Loaded, Stated, StatedLoad, curve_key};
use super::{Model, has, numbers};
use crate::write::value::{list, number, text};
use std::collections::BTreeSet;
use striae_meshfile::{Keyword, Row};

impl<'a> Model<'a> {
    /// Reads `*CLOAD`.
    pub(super) fn forces(&mut self, keyword: &'a Keyword<'a>, period: Period, stated: &mut Stated) {
        self.begin_loads(keyword, &[], Family::Concentrated, stated);
        for row in &keyword.rows {
            let word = row.words[0];
            let all = numbers(row.words.get(1..).unwrap_or_default()).unwrap_or_default();
            let [component, value, ..] = all[..] else {
                self.list(row.line, format!("*CLOAD `{}`", row.words.join(", ")));
                continue;
            };
            let component = component as usize;
            let mut targets: Vec<(Loaded, usize)> = Vec::new();
            if let Some(rigid) = self.rigid_of_point(word) {
                match component {
                    1..=3 => targets.push((Loaded::Force(rigid), component - 1)),
                    4..=6 => targets.push((Loaded::Torque(rigid), component - 4)),
                    _ => {}
                }
            } else if let Some(rigid) = self.rigid_of_turning_point(word) {
                if let 1..=3 = component {
                    targets.push((Loaded::Torque(rigid), component - 1));
                }
            } else if let 1..=3 = component {
                for (body, set) in self.nodes(word) {
                    if self.axes(row.line, body, &set).is_some() {
                        let what = format!(
                            "*CLOAD `{}` in the axes of a *TRANSFORM: state its components along x, y and z",
                            row.words.join(", ")
                        );
                        self.list(row.line, what);
                        continue;
                    }
                    targets.push((Loaded::Nodes(body, set), component - 1));
                }
                if targets.is_empty() && self.nodes(word).is_empty() {
                    let what = format!(
                        "*CLOAD `{}`: `{word}` belongs to no body and no rigid body",
                        row.words.join(", ")
                    );
                    self.list(row.line, what);
                    continue;
                }
            }
            if targets.is_empty() && !self.listed.contains_key(&row.line) {
                self.list(row.line, format!("*CLOAD `{}`", row.words.join(", ")));
            }
            for (loaded, component) in targets {
                let mut components = [None; 3];
                components[component] = Some(value);
                let of = (Family::Concentrated, loaded, components);
                self.state_load(keyword, row, of, period, stated);
            }
        }
    }

    /// Reads `*DSLOAD`: pressures and tractions on surfaces.
    pub(super) fn surface_loads(
        &mut self,
        keyword: &'a Keyword<'a>,
        period: Period,
        stated: &mut Stated,
    ) {
        let known = ["FOLLOWER", "CONSTANT RESULTANT"];
        self.begin_loads(keyword, &known, Family::Surface, stated);
        for row in &keyword.rows {
            let word = row.words[0];
            let kind = row.words.get(1).copied().unwrap_or_default().to_uppercase();
            let all = numbers(row.words.get(2..).unwrap_or_default()).unwrap_or_default();
            let facets = self.facets(word);
            let vector = match (kind.as_str(), &all[..]) {
                ("P", [value, ..]) => Some([Some(*value), None, None]),
                ("TRVEC", [size, x, y, z, ..]) => along(*size, [*x, *y, *z]),
                _ => None,
            };
            let Some(vector) = vector.filter(|_| !facets.is_empty()) else {
                self.list(row.line, format!("*DSLOAD `{}`", row.words.join(", ")));
                continue;
            };
            for (body, facets) in facets {
                let loaded = match (kind.as_str(), has(keyword, "FOLLOWER", "NO")) {
                    ("P", _) => Loaded::Pressed(body, facets),
                    (_, true) => Loaded::Dead(body, facets),
                    (_, false) => Loaded::Follower(body, facets),
                };
                self.state_load(
                    keyword,
                    row,
                    (Family::Surface, loaded, vector),
                    period,
                    stated,
                );
            }
        }
    }

    /// Reads `*DLOAD`: gravity, and pressures on faces of elements.
    pub(super) fn body_loads(
        &mut self,
        keyword: &'a Keyword<'a>,
        period: Period,
        stated: &mut Stated,
    ) {
        self.begin_loads(keyword, &[], Family::Distributed, stated);
        let mut weighed = BTreeSet::new();
        let mut last = None;
        for row in &keyword.rows {
            let kind = row.words.get(1).copied().unwrap_or_default().to_uppercase();
            let all = numbers(row.words.get(2..).unwrap_or_default()).unwrap_or_default();
            let words = row.words.join(", ");
            match (kind.as_str(), &all[..]) {
                ("GRAV", [size, x, y, z, ..]) => {
                    let Some(vector) = along(*size, [*x, *y, *z]) else {
                        self.list(row.line, format!("*DLOAD `{words}`"));
                        continue;
                    };
                    weighed.extend(self.weighed(row.words[0]));
                    last = Some(row);
                    let of = (Family::Distributed, Loaded::Gravity, vector);
                    self.state_load(keyword, row, of, period, stated);
                }
                (kind, [value, ..]) if side(kind).is_some() => {
                    let found = self.loaded_faces.of(row.line);
                    if found.is_none() {
                        let what = format!("*DLOAD `{words}`, which is no outer face of a body");
                        self.list(row.line, what);
                    }
                    if self.loaded_faces.has_inner(row.line) {
                        let what = format!(
                            "*DLOAD `{words}`: pressures on faces between elements are left out"
                        );
                        self.list(row.line, what);
                    }
                    for (body, set) in found.unwrap_or_default() {
                        let loaded = Loaded::Pressed(body, set);
                        let of = (Family::Distributed, loaded, [Some(*value), None, None]);
                        self.state_load(keyword, row, of, period, stated);
                    }
                }
                ("CENTRIF" | "CENT" | "ROTA" | "CORIO" | "BX" | "BY" | "BZ", _) => {
                    let what = format!("*DLOAD `{words}`: gravity is the only force per volume");
                    self.list(row.line, what);
                }
                _ => self.list(row.line, format!("*DLOAD `{words}`")),
            }
        }
        if let Some(row) = last.filter(|_| weighed.len() < self.bodies.len()) {
            let what = format!(
                "*DLOAD, GRAV of `{}`: gravity is on all bodies that have a density",
                row.words[0]
            );
            self.list(row.line, what);
        }
    }

    /// Bodies of which a word stands for all elements, by place.
    fn weighed(&self, word: &str) -> Vec<usize> {
        let mut all = self.bodies_named(word);
        all.retain(|at| word.is_empty() || self.bodies[*at].is_within(word));
        all
    }

    fn begin_loads(
        &mut self,
        keyword: &Keyword<'_>,
        known: &[&str],
        family: Family,
        stated: &mut Stated,
    ) {
        self.used.insert(keyword.line);
        let known = [known, &["AMPLITUDE", "OP", "LOAD CASE"]].concat();
        self.list_parameters(keyword, &known);
        if has(keyword, "OP", "NEW") {
            stated.new_loads.insert(family);
        }
    }

    /// Adds components to what a step states of a load.
    fn state_load(
        &mut self,
        keyword: &Keyword<'_>,
        row: &Row<'_>,
        (family, loaded, components): (Family, Loaded, [Option<f64>; 3]),
        period: Period,
        stated: &mut Stated,
    ) {
        let amplitude = keyword.parameter("AMPLITUDE").map(str::to_owned);
        // Gravity of several bodies is one and the same.
        let adds = loaded != Loaded::Gravity;
        let entry = stated.raw_loads.entry(loaded).or_insert(StatedLoad {
            family,
            components: [None; 3],
            amplitude: amplitude.clone(),
            period,
            line: row.line,
        });
        if entry.amplitude != amplitude {
            let what = format!(
                "*{} `{}`: a load has one amplitude in a step; put it on a set of its own",
                keyword.name,
                row.words.join(", ")
            );
            self.list(row.line, what);
            return;
        }
        for (known, more) in entry.components.iter_mut().zip(components) {
            if let Some(more) = more {
                *known = Some(more + known.filter(|_| adds).unwrap_or(0.0));
            }
        }
    }

    /// Makes the loads of a step of what is stated.
    pub(super) fn resolve_loads(
        &mut self,
        history: &mut History,
        stated: &mut Stated,
        period: Period,
    ) {
        for (loaded, (family, present)) in &history.loads {
            let ends = stated.new_loads.contains(family) && *present != [0.0; 3];
            if ends && !stated.raw_loads.contains_key(loaded) {
                let none = StatedLoad {
                    family: *family,
                    components: [Some(0.0); 3],
                    amplitude: None,
                    period,
                    line: 0,
                };
                stated.raw_loads.insert(loaded.clone(), none);
            }
        }
        for (loaded, of) in &mut stated.raw_loads {
            let present = history.loads.get(loaded).map_or([0.0; 3], |(_, of)| *of);
            if stated.new_loads.contains(&of.family) {
                let components = of.components.iter_mut().zip(present);
                let ended =
                    components.filter(|(stated, present)| stated.is_none() && *present != 0.0);
                ended.for_each(|(stated, _)| *stated = Some(0.0));
            }
        }
        self.end_replaced(history, stated, period);
        for (loaded, of) in std::mem::take(&mut stated.raw_loads) {
            let present = history.loads.get(&loaded).map_or([0.0; 3], |(_, of)| *of);
            match self.resolved(&loaded, &of, present) {
                Ok((load, reached)) => {
                    history.loads.insert(loaded.clone(), (of.family, reached));
                    stated.loads.insert(loaded, load);
                }
                Err(what) => self.list(of.line, what),
            }
        }
    }

    fn resolved(
        &mut self,
        loaded: &Loaded,
        of: &StatedLoad,
        present: [f64; 3],
    ) -> Result<(Load, [f64; 3]), String> {
        let amplitude = of.amplitude.as_deref();
        let over = match loaded {
            Loaded::Force(_) | Loaded::Torque(_) => Over::Step,
            _ => Over::Run,
        };
        let (mut target, mut reached, mut curve) = (present, present, None);
        let mut is_first = true;
        for at in 0..3 {
            let value = match (of.components[at], amplitude) {
                (Some(value), _) => value,
                (None, Some(name)) if present[at] != 0.0 => {
                    return Err(format!(
                        "amplitude `{name}` of some components of a force whose others have none"
                    ));
                }
                (None, _) => continue,
            };
            if value == 0.0 && present[at] == 0.0 && amplitude.is_some() {
                target[at] = 0.0;
                continue;
            }
            let found: Approach =
                self.approach(amplitude, of.period, over, [present[at], value])?;
            if amplitude.is_some() && !is_first && curve != found.curve {
                return Err(
                    "components whose courses differ; put them on sets of their own".into(),
                );
            }
            is_first = false;
            (target[at], reached[at]) = (found.target, found.reached);
            curve = found.curve.or(curve);
        }
        let line = of.line;
        Ok((
            Load {
                target,
                curve,
                line,
            },
            reached,
        ))
    }
}

/// A vector of a size along a direction of any length; `None` without a direction.
fn along(size: f64, direction: [f64; 3]) -> Option<[Option<f64>; 3]> {
    let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
    (length > 0.0).then(|| direction.map(|x| Some(size * x / length)))
}

impl Stated {
    /// Entries of a step: forces at nodes, pressures, tractions.
    pub(super) fn load_entries(&self, bodies: &[Body]) -> [Vec<String>; 3] {
        let mut all: [Vec<String>; 3] = Default::default();
        for (loaded, load) in &self.loads {
            let vector = list(load.target.map(number));
            let curve = curve_key(&load.curve);
            let on = |body: &usize, key: &str, set: &str| {
                format!(
                    "body = {}, {key} = {}",
                    text(&bodies[*body].name),
                    text(set)
                )
            };
            match loaded {
                Loaded::Nodes(body, set) => {
                    let on = on(body, "nodes", set);
                    all[0].push(format!("{{ {on}, each = {vector}{curve} }}"));
                }
                Loaded::Pressed(body, set) => {
                    let (on, value) = (on(body, "facets", set), number(load.target[0]));
                    all[1].push(format!("{{ {on}, value = {value}{curve} }}"));
                }
                Loaded::Dead(body, set) | Loaded::Follower(body, set) => {
                    let direction = match loaded {
                        Loaded::Dead(..) => "dead",
                        _ => "follower",
                    };
                    let on = on(body, "facets", set);
                    all[2].push(format!(
                        "{{ {on}, vector = {vector}, direction = \"{direction}\"{curve} }}"
                    ));
                }
                Loaded::Force(_) | Loaded::Torque(_) | Loaded::Gravity => {}
            }
        }
        all
    }

    /// The gravity of a step.
    pub(super) fn gravity(&self) -> Option<String> {
        let load = self.loads.get(&Loaded::Gravity)?;
        let vector = list(load.target.map(number));
        let curve = curve_key(&load.curve);
        Some(format!("{{ vector = {vector}{curve} }}"))
    }
}
