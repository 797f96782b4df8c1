//! Steps.

use super::amplitude::Period;
use super::condition::{Component, History, Stated, Target, curve_key};
use super::{Model, has, numbers};
use crate::write::value::{list, number, text};
use std::collections::{BTreeMap, BTreeSet};
use striae_meshfile::Keyword;

/// Procedure of a step, without its conditions.
struct Procedure {
    period: Period,
    /// First, smallest and largest increment as fractions of it.
    increments: [f64; 3],
    is_dynamic: bool,
}

impl<'a> Model<'a> {
    /// Reads all steps; conditions before the first belong to it.
    pub(super) fn read_steps(&mut self) {
        let keywords = self.keywords;
        let mut history = History::default();
        let is_step = |keyword: &&Keyword<'_>| keyword.name == "STEP";
        let first = keywords.iter().position(|keyword| is_step(&keyword));
        let first = first.unwrap_or(keywords.len());
        let before: Vec<&Keyword<'_>> = keywords[..first].iter().collect();
        let (mut start, mut names) = (0.0, BTreeSet::new());
        let mut at = first;
        while at < keywords.len() {
            let after = keywords[at + 1..]
                .iter()
                .position(|keyword| is_step(&keyword));
            let end = after.map_or(keywords.len(), |after| at + 1 + after);
            let within: Vec<&Keyword<'_>> = keywords[at..end].iter().collect();
            let initial = if at == first { &before[..] } else { &[] };
            let stated = keywords[at]
                .parameter("NAME")
                .filter(|name| !name.is_empty());
            let mut name = stated.map_or(format!("step-{}", names.len() + 1), str::to_owned);
            while !names.insert(name.clone()) {
                name += "'";
            }
            if let Some(duration) = self.step(&name, initial, &within, start, &mut history) {
                start += duration;
            }
            at = end;
        }
        if first == keywords.len() {
            let line = keywords.last().map_or(1, |keyword| keyword.line);
            self.list(line, "the model has no *STEP; the deck needs one");
        }
    }

    /// Reads a step; its duration.
    fn step(
        &mut self,
        name: &str,
        initial: &[&'a Keyword<'a>],
        within: &[&'a Keyword<'a>],
        start: f64,
        history: &mut History,
    ) -> Option<f64> {
        self.used.insert(within[0].line);
        self.list_parameters(
            within[0],
            &[
                "NAME",
                "NLGEOM",
                "INC",
                "UNSYMM",
                "AMPLITUDE",
                "EXTRAPOLATION",
            ],
        );
        if has(within[0], "NLGEOM", "NO") {
            self.list(
                within[0].line,
                "*STEP, NLGEOM=NO: displacements may be large",
            );
        }
        let Some(procedure) = self.procedure(within, start) else {
            self.list(
                within[0].line,
                format!("*STEP `{name}`: no static or implicit dynamic step"),
            );
            for keyword in within.iter().skip(1) {
                if !keyword.name.starts_with("END ") {
                    self.list(keyword.line, format!("*{} of this step", keyword.name));
                }
            }
            return None;
        };
        let at_rest = Period {
            at_once: false,
            ..procedure.period
        };
        let mut stated = Stated::default();
        for (keywords, period) in [(initial, at_rest), (within, procedure.period)] {
            for &keyword in keywords {
                match keyword.name.as_str() {
                    "BOUNDARY" => self.boundary(keyword, period, history, &mut stated),
                    "CLOAD" => self.forces(keyword, period, history, &mut stated),
                    "DSLOAD" => self.surface_loads(keyword, period, history, &mut stated),
                    "DLOAD" => self.body_loads(keyword, period, history, &mut stated),
                    _ => {}
                }
            }
        }
        let ended = stated.ended(history);
        let is_first = !initial.is_empty();
        let table = self.table(name, &procedure, &stated, &ended, is_first);
        self.steps += &table;
        for component in ended {
            history.prescribed.remove(&component);
        }
        let targets = stated.prescribed.into_iter();
        history
            .prescribed
            .extend(targets.map(|(key, (value, _))| (key, value)));
        Some(procedure.period.duration)
    }

    fn procedure(&mut self, within: &[&'a Keyword<'a>], start: f64) -> Option<Procedure> {
        let is_procedure = |keyword: &&&Keyword<'_>| {
            ["STATIC", "VISCO", "DYNAMIC"].contains(&keyword.name.as_str())
        };
        let keyword = within.iter().find(is_procedure)?;
        let is_dynamic = keyword.name == "DYNAMIC";
        if keyword.parameter("EXPLICIT").is_some() {
            return None;
        }
        self.used.insert(keyword.line);
        self.list_parameters(keyword, &["DIRECT", "CETOL"]);
        let row = keyword.rows.first();
        let row = row.and_then(|row| numbers(&row.words)).unwrap_or_default();
        let at = |at: usize| row.get(at).copied().filter(|value| *value > 0.0);
        let duration = at(1).unwrap_or(1.0);
        let first = at(0).unwrap_or(duration).min(duration);
        let is_direct = keyword.parameter("DIRECT").is_some();
        let smallest = at(2).unwrap_or(first.min(1e-5 * duration)).min(first);
        let largest = match is_direct {
            true => first,
            false => at(3).unwrap_or(duration).clamp(first, duration),
        };
        let amplitude = within[0].parameter("AMPLITUDE");
        let at_once = match amplitude {
            Some(word) => word.eq_ignore_ascii_case("STEP"),
            None => is_dynamic,
        };
        Some(Procedure {
            period: Period {
                start,
                duration,
                at_once,
            },
            increments: [first, smallest, largest].map(|size| size / duration),
            is_dynamic,
        })
    }

    fn table(
        &mut self,
        name: &str,
        procedure: &Procedure,
        stated: &Stated,
        ended: &BTreeSet<Component>,
        is_first: bool,
    ) -> String {
        let [first, smallest, largest] = procedure.increments.map(number);
        let mut table = format!(
            "\n[[step]]\nname = {}\nduration = {}\nincrements = {{ initial = {first}, smallest = {smallest}, largest = {largest} }}\n",
            text(name),
            number(procedure.period.duration)
        );
        if procedure.is_dynamic {
            table += "dynamics = {}\n";
        }
        if let Some(gravity) = &stated.gravity {
            table += &format!("gravity = {gravity}\n");
        }
        let lists = [
            ("release", self.releases(ended)),
            ("displacement", stated.displacements(&self.bodies)),
            ("traction", stated.tractions.clone()),
            ("pressure", stated.pressures.clone()),
            ("rigid", self.motions(stated, ended, is_first)),
        ];
        for (key, items) in lists {
            if !items.is_empty() {
                let items = items.iter().map(|item| format!("    {item},\n"));
                table += &format!("{key} = [\n{}]\n", items.collect::<String>());
            }
        }
        table
    }

    fn releases(&self, ended: &BTreeSet<Component>) -> Vec<String> {
        let mut groups: BTreeMap<(usize, &str), Vec<String>> = BTreeMap::new();
        for (target, component) in ended {
            if let Target::Nodes(body, set) = target {
                let components = groups.entry((*body, set)).or_default();
                components.push(text(["x", "y", "z"][*component]));
            }
        }
        let entry = |((body, set), components): ((usize, &str), Vec<String>)| {
            let (body, set) = (text(&self.bodies[body].name), text(set));
            format!(
                "{{ body = {body}, nodes = {set}, components = {} }}",
                list(components)
            )
        };
        groups.into_iter().map(entry).collect()
    }

    /// Motions of rigid bodies: components without a condition are free.
    fn motions(
        &mut self,
        stated: &Stated,
        ended: &BTreeSet<Component>,
        is_first: bool,
    ) -> Vec<String> {
        let mut all = Vec::new();
        for at in 0..self.rigid.len() {
            let rigid = &mut self.rigid[at];
            let (mut curve, mut is_moved, mut is_freed) = (None, [false; 2], is_first);
            for component in 0..6 {
                let key = (Target::Rigid(at), component);
                if ended.contains(&key) {
                    rigid.held[component] = false;
                    is_freed = true;
                }
                if let Some((value, along)) = stated.prescribed.get(&key) {
                    rigid.held[component] = true;
                    is_moved[component / 3] |= rigid.targets[component] != *value;
                    rigid.targets[component] = *value;
                    curve = curve.or(along.clone());
                }
            }
            let mut keys = String::new();
            let [x, y, z, rx, ry, rz] = rigid.targets;
            if is_moved[0] {
                keys += &format!(", displacement = {}", list([x, y, z].map(number)));
            }
            if is_moved[1] {
                let degrees = [rx, ry, rz].map(|angle| number(angle.to_degrees()));
                keys += &format!(", rotation = {}", list(degrees));
            }
            let words = ["x", "y", "z", "rx", "ry", "rz"];
            let free = (0..6).filter(|component| !rigid.held[*component]);
            let free: Vec<String> = free.map(|component| text(words[component])).collect();
            if !free.is_empty() && (is_freed || is_moved != [false; 2]) {
                keys += &format!(", free = {}", list(free));
            }
            for (key, from) in [("force", 0), ("torque", 3)] {
                let of = |component: usize| stated.forces.get(&(at, from + component));
                if (0..3).any(|component| of(component).is_some()) {
                    let vector = [0, 1, 2].map(|component| {
                        curve = curve
                            .clone()
                            .or(of(component).and_then(|(_, curve)| curve.clone()));
                        number(of(component).map_or(0.0, |(value, _)| *value))
                    });
                    keys += &format!(", {key} = {}", list(vector));
                }
            }
            if !keys.is_empty() {
                let (name, curve) = (text(&self.rigid[at].name), curve_key(&curve));
                all.push(format!("{{ surface = {name}{keys}{curve} }}"));
            }
        }
        all
    }
}
