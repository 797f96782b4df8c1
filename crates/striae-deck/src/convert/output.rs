//! Requests of output.
//!
//! A deck has one list of fields for all steps. Forces of surfaces, reactions, energies and motions
//! of rigid bodies are in the history of every run; displacements of sets of nodes become probes.

use super::{Model, has};
use crate::write::value::{list, number, text};
use std::collections::{BTreeMap, BTreeSet};
use striae_meshfile::Keyword;

/// Fields by what asks for them.
const BODY_FIELDS: [(&str, &[&str]); 9] = [
    ("displacement", &["U", "UT"]),
    ("velocity", &["V", "VT"]),
    ("cauchy-stress", &["S"]),
    ("von-mises", &["S", "MISES", "MISESONLY"]),
    ("principal-stress", &["SP", "PS"]),
    ("logarithmic-strain", &["LE", "E", "ME"]),
    ("principal-strain", &["LEP", "EP"]),
    ("strain-energy-density", &["ENER", "SENER"]),
    ("history-variables", &["PE", "PEEQ", "PEMAG", "SDV"]),
];
const CONTACT_FIELDS: [(&str, &[&str]); 4] = [
    ("traction", &["CSTRESS", "CSTR", "CPRESS", "CSHEAR"]),
    ("gap", &["CDISP", "CDIS", "COPEN"]),
    ("slip", &["CDISP", "CDIS", "CSLIP"]),
    ("status", &["CSTATUS"]),
];
/// Beginnings of what the history of every run has of nodes.
const RECORDED: [&str; 4] = ["RF", "RM", "RT", "CF"];

/// Output that a model requests.
#[derive(Default)]
pub(super) struct Output {
    /// Files of fields: every so many increments, or at intervals of time.
    every: BTreeSet<u64>,
    intervals: Vec<f64>,
    /// `true` if what is usual is requested.
    is_usual: bool,
    body: BTreeSet<&'static str>,
    contact: BTreeSet<&'static str>,
    probes: BTreeMap<String, String>,
    checkpoints: Option<u64>,
}

impl<'a> Model<'a> {
    /// Reads requests of output.
    pub(super) fn read_output(&mut self) {
        let keywords = self.keywords;
        let (mut of_fields, mut duration) = (true, 1.0);
        for keyword in keywords {
            match keyword.name.as_str() {
                "STEP" => of_fields = true,
                "STATIC" | "VISCO" | "DYNAMIC" => {
                    let row = keyword.rows.first().and_then(|row| row.words.get(1));
                    let stated = row.and_then(|word| striae_meshfile::finite(word));
                    duration = stated.filter(|of| *of > 0.0).unwrap_or(1.0);
                }
                "OUTPUT" => {
                    of_fields = keyword.parameter("FIELD").is_some();
                    self.begin_output(keyword, duration);
                }
                "NODE OUTPUT" | "ELEMENT OUTPUT" | "CONTACT OUTPUT" | "ENERGY OUTPUT" => {
                    self.requested(keyword, of_fields);
                }
                "NODE FILE" | "EL FILE" | "CONTACT FILE" => {
                    self.every(keyword);
                    self.requested(keyword, true);
                }
                "NODE PRINT" | "EL PRINT" | "CONTACT PRINT" | "ENERGY PRINT" => {
                    self.requested(keyword, false);
                }
                "RESTART" => self.restart(keyword),
                _ => {}
            }
        }
    }

    fn begin_output(&mut self, keyword: &Keyword<'_>, duration: f64) {
        self.used.insert(keyword.line);
        let known = [
            "FIELD",
            "HISTORY",
            "FREQUENCY",
            "VARIABLE",
            "TIME INTERVAL",
            "NUMBER INTERVAL",
            "INTERVAL",
            "TIME MARKS",
            "OP",
        ];
        self.list_parameters(keyword, &known);
        if keyword.parameter("FIELD").is_none() {
            return;
        }
        if keyword.parameter("VARIABLE").is_some() {
            self.output.is_usual = true;
        }
        let value = |key: &str| keyword.parameter(key).and_then(striae_meshfile::finite);
        let count = value("NUMBER INTERVAL").or_else(|| value("INTERVAL"));
        let interval = count
            .filter(|count| *count > 0.0)
            .map(|count| duration / count);
        match value("TIME INTERVAL").or(interval) {
            Some(interval) if interval > 0.0 => self.output.intervals.push(interval),
            _ => self.every(keyword),
        }
    }

    fn every(&mut self, keyword: &Keyword<'_>) {
        let every = keyword.parameter("FREQUENCY");
        let every = every.and_then(|word| word.parse().ok());
        self.output.every.insert(every.unwrap_or(1));
    }

    /// Reads what a keyword asks for.
    fn requested(&mut self, keyword: &'a Keyword<'a>, of_fields: bool) {
        self.used.insert(keyword.line);
        let of_contact = keyword.name.starts_with("CONTACT");
        if keyword.name.starts_with("ENERGY") {
            return;
        }
        if keyword.parameter("VARIABLE").is_some() && of_fields {
            self.output.is_usual = true;
        }
        let words = keyword.rows.iter().flat_map(|row| &row.words);
        let words: Vec<String> = words
            .filter(|word| !word.is_empty())
            .map(|word| word.to_uppercase())
            .collect();
        if !of_fields {
            return self.recorded(keyword, &words);
        }
        let known: &[(&str, &[&str])] = match of_contact {
            true => &CONTACT_FIELDS,
            false => &BODY_FIELDS,
        };
        let mut unknown = Vec::new();
        for word in &words {
            let fields = known
                .iter()
                .filter(|(_, names)| names.contains(&word.as_str()));
            let fields: Vec<&'static str> = fields.map(|(field, _)| *field).collect();
            if fields.is_empty() {
                unknown.push(word.as_str());
            }
            match of_contact {
                true => self.output.contact.extend(fields),
                false => self.output.body.extend(fields),
            }
        }
        if !unknown.is_empty() {
            let what = format!("*{}: no field for {}", keyword.name, unknown.join(", "));
            self.list(keyword.line, what);
        }
    }

    /// Reads what is recorded over time; forces and energies always are.
    fn recorded(&mut self, keyword: &'a Keyword<'a>, words: &[String]) {
        if !keyword.name.starts_with("NODE") {
            if !keyword.name.starts_with("CONTACT") {
                let what = format!(
                    "*{} over time: name points in `probes` of `[output]`",
                    keyword.name
                );
                self.list(keyword.line, what);
            }
            return;
        }
        let is_displacement = |word: &&String| {
            let component = word.strip_prefix('U');
            component.is_some_and(|of| ["", "1", "2", "3", "T"].contains(&of))
        };
        let (known, others): (Vec<&String>, Vec<&String>) = words.iter().partition(is_displacement);
        let others = others.into_iter().map(String::as_str);
        let others = others.filter(|word| !RECORDED.iter().any(|of| word.starts_with(of)));
        let others: Vec<&str> = others.collect();
        if !others.is_empty() {
            let what = format!("*{} over time: no {}", keyword.name, others.join(", "));
            self.list(keyword.line, what);
        }
        if known.is_empty() {
            return;
        }
        let Some(word) = keyword.parameter("NSET") else {
            let what = format!("*{} of all nodes: name a set", keyword.name);
            self.list(keyword.line, what);
            return;
        };
        if self.rigid_of_point(word).is_some() || self.rigid_of_turning_point(word).is_some() {
            return;
        }
        for (body, set) in self.nodes(word) {
            let nodes = self.bodies[body].nodes(&set).len();
            let name = format!("{} {set}", self.bodies[body].name);
            let probe = format!(
                "{{ name = {}, body = {}, nodes = {} }}",
                text(&name),
                text(&self.bodies[body].name),
                text(&set)
            );
            let is_new = self.output.probes.insert(name, probe).is_none();
            if nodes > 1 && is_new {
                let what = format!(
                    "*{} of `{word}`: its probe has the mean over {nodes} nodes",
                    keyword.name
                );
                self.list(keyword.line, what);
            }
        }
    }

    fn restart(&mut self, keyword: &Keyword<'_>) {
        if keyword.parameter("WRITE").is_none() {
            self.list(keyword.line, "*RESTART, READ: resume by `striae resume`");
            return;
        }
        self.used.insert(keyword.line);
        self.list_parameters(
            keyword,
            &["WRITE", "FREQUENCY", "OVERLAY", "NUMBER INTERVAL"],
        );
        let every = keyword.parameter("FREQUENCY");
        self.output.checkpoints = every.and_then(|word| word.parse().ok());
    }

    /// The table of output; none where nothing is requested.
    pub(super) fn output_table(&mut self) -> String {
        let keywords = self.keywords;
        let output = &self.output;
        let mut table = String::new();
        let intervals = output.intervals.iter().copied();
        let shortest = intervals.fold(f64::INFINITY, f64::min);
        let often = output.every.iter().find(|every| **every > 0);
        let mut is_mixed = output.every.len() > 1 && output.intervals.is_empty();
        if shortest.is_finite() {
            table += &format!("fields_interval = {}\n", number(shortest));
            is_mixed |= output.intervals.iter().any(|other| *other != shortest);
        } else if let Some(every) = often.or(output.every.first()).filter(|every| **every != 1) {
            table += &format!("fields_every = {every}\n");
        }
        for (key, usual, fields) in [
            ("body_fields", output.is_usual, &output.body),
            ("contact_fields", output.is_usual, &output.contact),
        ] {
            if !usual && !fields.is_empty() {
                let fields = fields.iter().map(|field| text(field));
                table += &format!("{key} = {}\n", list(fields));
            }
        }
        if !output.probes.is_empty() {
            let probes = output
                .probes
                .values()
                .map(|probe| format!("    {probe},\n"));
            table += &format!("probes = [\n{}]\n", probes.collect::<String>());
        }
        if let Some(every) = output.checkpoints {
            table += &format!("checkpoint_every = {every}\n");
        }
        let mut requests = keywords.iter();
        let last = requests.rfind(|keyword| {
            keyword.name == "OUTPUT" && has(keyword, "FIELD", "") || keyword.name.ends_with(" FILE")
        });
        if let Some(keyword) = last.filter(|_| is_mixed) {
            let what = format!("*{}: all steps have the most frequent output", keyword.name);
            self.list(keyword.line, what);
        }
        match table.is_empty() {
            true => String::new(),
            false => format!("\n[output]\n{table}"),
        }
    }
}
