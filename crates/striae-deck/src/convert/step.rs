//! Steps.

use super::amplitude::Period;
use super::stated::{Component, History, Stated, Target};
use super::{Model, has, numbers};
use crate::write::value::{list, number, text};
use std::collections::{BTreeMap, BTreeSet};
use striae_meshfile::Keyword;

/// Parameter of the method of Hilber, Hughes and Taylor for transient fidelity, the default of models
/// without contact.
const TRANSIENT: f64 = -0.05;
/// Parameter for moderate dissipation, the default of models with contact: `1 - sqrt(2)`.
const MODERATE: f64 = 1.0 - std::f64::consts::SQRT_2;

/// Procedure of a step, without its conditions.
struct Procedure {
    period: Period,
    /// First, smallest and largest increment as fractions of it.
    increments: [f64; 3],
    /// Spectral radius at infinite frequency of a dynamic step.
    spectral_radius: Option<f64>,
}

impl Procedure {
    fn is_dynamic(&self) -> bool {
        self.spectral_radius.is_some()
    }
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
        let (mut start, mut names, mut is_first) = (0.0, BTreeSet::new(), true);
        let mut at = first;
        while at < keywords.len() {
            let after = keywords[at + 1..]
                .iter()
                .position(|keyword| is_step(&keyword));
            let end = after.map_or(keywords.len(), |after| at + 1 + after);
            let within: Vec<&Keyword<'_>> = keywords[at..end].iter().collect();
            // What stands before all steps belongs to the first that is one here.
            let initial = is_first.then_some(&before[..]);
            let stated = keywords[at]
                .parameter("NAME")
                .filter(|name| !name.is_empty());
            let mut name = stated.map_or(format!("step-{}", names.len() + 1), str::to_owned);
            while !names.insert(name.clone()) {
                name += "'";
            }
            if let Some(duration) = self.step(&name, initial, &within, start, &mut history) {
                start += duration;
                is_first = false;
            }
            at = end;
        }
        if is_first && first < keywords.len() {
            let what = "no step is one that a deck can state; the deck needs one";
            self.list(keywords[first].line, what);
        } else if is_first {
            let line = keywords.last().map_or(1, |keyword| keyword.line);
            self.list(line, "the model has no *STEP; the deck needs one");
        }
    }

    /// Reads a step; its duration.
    fn step(
        &mut self,
        name: &str,
        initial: Option<&[&'a Keyword<'a>]>,
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
        self.nonlinearity(within[0]);
        let Some(procedure) = self.procedure(within, start) else {
            let mut others = within.iter();
            let is_explicit = others.any(|keyword| keyword.parameter("EXPLICIT").is_some());
            let what = match is_explicit {
                true => "an explicit step; take *DYNAMIC without EXPLICIT",
                false => "no static or implicit dynamic step",
            };
            self.list(within[0].line, format!("*STEP `{name}`: {what}"));
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
        let before = initial.unwrap_or_default();
        for (keywords, period) in [(before, at_rest), (within, procedure.period)] {
            let mut own = keywords.iter();
            if own.any(|keyword| keyword.name == "BOUNDARY" && has(keyword, "OP", "NEW")) {
                // Of those that stand before all steps only what is stated again stays.
                stated.prescribed.clear();
            }
            for &keyword in keywords {
                match keyword.name.as_str() {
                    "BOUNDARY" => self.boundary(keyword, period, history, &mut stated),
                    "CLOAD" => self.forces(keyword, period, &mut stated),
                    "DSLOAD" => self.surface_loads(keyword, period, &mut stated),
                    "DLOAD" => self.body_loads(keyword, period, &mut stated),
                    "INITIAL CONDITIONS" => {
                        self.initial_conditions(keyword, procedure.is_dynamic(), &mut stated);
                    }
                    _ => {}
                }
            }
        }
        self.resolve_loads(history, &mut stated, procedure.period);
        let frictions = self.changed_frictions(within);
        let replaced = stated.replaced(history, &self.bodies);
        let mut ended = stated.ended(history);
        ended.retain(|component| !replaced.contains(component));
        let motions = self.motions(&stated, &ended, initial.is_some());
        let mut table = self.table(name, &procedure, &stated, &ended, motions);
        if !frictions.is_empty() {
            table += &entries("friction", &frictions);
        }
        self.steps += &table;
        ended.extend(replaced);
        for (key, line) in std::mem::take(&mut history.moving) {
            if !stated.prescribed.contains_key(&key) && !ended.contains(&key) {
                let what = "*BOUNDARY, TYPE=VELOCITY beyond the end of its step: state it in later steps, too";
                self.list(line, what);
            }
        }
        history.advance(stated, &ended);
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
        // Solvers and tolerances of the increments change no meaning.
        let known = [
            "DIRECT",
            "CETOL",
            "SOLVER",
            "HAFTOL",
            "NOHAF",
            "ALPHA",
            "APPLICATION",
        ];
        self.list_parameters(keyword, &known);
        let spectral_radius = is_dynamic.then(|| self.spectral_radius(keyword));
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
            None => is_dynamic && !has(keyword, "APPLICATION", "QUASI-STATIC"),
        };
        Some(Procedure {
            period: Period {
                start,
                duration,
                at_once,
                line: within[0].line,
            },
            increments: [first, smallest, largest].map(|size| size / duration),
            spectral_radius,
        })
    }

    /// Spectral radius at infinite frequency of a `*DYNAMIC`: that of the method of Hilber, Hughes
    /// and Taylor with its `alpha`, and of the backward Euler method in quasi-static applications.
    fn spectral_radius(&mut self, keyword: &Keyword<'_>) -> f64 {
        let application = keyword.parameter("APPLICATION").map(str::to_uppercase);
        let usual = match application.as_deref() {
            Some("QUASI-STATIC") => return 0.0,
            Some("TRANSIENT FIDELITY") => TRANSIENT,
            Some("MODERATE DISSIPATION") => MODERATE,
            other => {
                if let Some(word) = other {
                    let what = format!("*DYNAMIC: APPLICATION of `{word}`");
                    self.list(keyword.line, what);
                }
                let is_contact =
                    |other: &Keyword<'_>| matches!(&*other.name, "CONTACT" | "CONTACT PAIR");
                match self.keywords.iter().any(is_contact) {
                    true => MODERATE,
                    false => TRANSIENT,
                }
            }
        };
        let alpha = match keyword.parameter("ALPHA") {
            None => usual,
            Some(word) => {
                let stated = striae_meshfile::finite(word);
                let stated = stated.filter(|alpha| (-0.5..=0.0).contains(alpha));
                if stated.is_none() {
                    let what =
                        format!("*DYNAMIC: ALPHA of `{word}`, which is not between -0.5 and 0");
                    self.list(keyword.line, what);
                }
                stated.unwrap_or(usual)
            }
        };
        (1.0 + alpha) / (1.0 - alpha)
    }

    /// Lists the first step that takes displacements as small.
    fn nonlinearity(&mut self, step: &Keyword<'_>) {
        let is_large = step.parameter("NLGEOM").is_some() && !has(step, "NLGEOM", "NO");
        if self.is_nonlinear.is_none() && !is_large {
            let what = "*STEP without NLGEOM: displacements are not taken as small here";
            self.list(step.line, what);
        }
        self.is_nonlinear = Some(is_large);
    }

    /// Friction that changes at the start of a step.
    fn changed_frictions(&mut self, within: &[&'a Keyword<'a>]) -> Vec<String> {
        let mut all = Vec::new();
        for (at, keyword) in within.iter().enumerate() {
            if keyword.name != "CHANGE FRICTION" {
                continue;
            }
            self.used.insert(keyword.line);
            self.list_parameters(keyword, &["INTERACTION"]);
            let name = keyword.parameter("INTERACTION").unwrap_or_default();
            let name = name.to_uppercase();
            let law = match within.get(at + 1) {
                Some(option) if option.name == "FRICTION" => self.friction(option),
                _ => None,
            };
            let Some(law) = law else {
                self.list(keyword.line, "*CHANGE FRICTION without a friction");
                continue;
            };
            let pairs = self.pairs.iter().filter(|pair| pair.interaction == name);
            let entries = pairs.map(|pair| format!("{{ pair = {}, {} }}", pair.name, law.text));
            let entries: Vec<String> = entries.collect();
            if entries.is_empty() {
                let what = format!("*CHANGE FRICTION of `{name}`, which no pair has");
                self.list(keyword.line, what);
            }
            all.extend(entries);
        }
        all
    }

    fn table(
        &self,
        name: &str,
        procedure: &Procedure,
        stated: &Stated,
        ended: &BTreeSet<Component>,
        motions: Vec<String>,
    ) -> String {
        let [first, smallest, largest] = procedure.increments.map(number);
        let mut table = format!(
            "\n[[step]]\nname = {}\nduration = {}\nincrements = {{ initial = {first}, smallest = {smallest}, largest = {largest} }}\n",
            text(name),
            number(procedure.period.duration)
        );
        if let Some(radius) = procedure.spectral_radius {
            let radius = number(radius);
            table += &format!("dynamics = {{ spectral_radius = {radius} }}\n");
        }
        if let Some(gravity) = stated.gravity() {
            table += &format!("gravity = {gravity}\n");
        }
        let [forces, pressures, tractions] = stated.load_entries(&self.bodies);
        let lists = [
            ("velocity", stated.velocities(&self.bodies, &self.rigid)),
            ("release", self.releases(ended)),
            ("displacement", stated.displacements(&self.bodies)),
            ("traction", tractions),
            ("pressure", pressures),
            ("force", forces),
            ("rigid", motions),
        ];
        for (key, items) in lists {
            if !items.is_empty() {
                table += &entries(key, &items);
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
}

/// A key with a list, an item a line.
fn entries(key: &str, items: &[String]) -> String {
    let items = items.iter().map(|item| format!("    {item},\n"));
    format!("{key} = [\n{}]\n", items.collect::<String>())
}
