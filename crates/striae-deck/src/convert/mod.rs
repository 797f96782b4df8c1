//! Decks made of Abaqus models.
//!
//! Meshes stay in the file: a body refers to its instance, or to an element set. Materials,
//! contact, conditions and steps become tables of the deck. What has no counterpart is listed
//! with its line; a keyword that nothing was made of is in the list, whatever it is.

mod amplitude;
mod bodies;
mod condition;
mod contact;
mod coupling;
mod elements;
mod faces;
mod friction;
mod general;
mod initial;
mod load;
mod materials;
mod motion;
mod output;
mod points;
mod profile;
mod remedy;
mod replaced;
mod rigid;
mod slip_direction;
mod springs;
mod stated;
mod step;

use crate::write::value::text;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use striae_meshfile::{InputFile, Keyword, MeshFileError};

/// A deck made of a model.
#[derive(Clone, Debug)]
pub struct Converted {
    /// Its text, with what has no counterpart in comments on top.
    pub deck: String,
    /// Content without a counterpart in the deck, each item with its line.
    pub listed: Vec<String>,
}

/// Makes a deck of an Abaqus model; `written` is how the deck names the file.
///
/// # Errors
/// [`MeshFileError`] where the file or the mesh in it cannot be read.
pub fn convert(path: &Path, written: &str) -> Result<Converted, MeshFileError> {
    let input = InputFile::read(path)?;
    let keywords = input.keywords()?;
    let mut model = Model::new(&input, &keywords);
    model.read_bodies(path)?;
    model.read_loaded_faces();
    model.read_rigid();
    model.read_contact();
    model.read_springs();
    model.read_steps();
    model.read_output();
    model.list_idle_amplitudes();
    model.list_other_elements();
    Ok(model.finished(path, written))
}

/// A model on its way to a deck.
struct Model<'a> {
    input: &'a InputFile,
    keywords: &'a [Keyword<'a>],
    points: points::ReferencePoints,
    instances: Vec<bodies::Instance<'a>>,
    bodies: Vec<bodies::Body>,
    /// Tables of materials.
    materials: String,
    rigid: Vec<rigid::Rigid>,
    /// Tables of pairs and ties.
    contact: String,
    pairs: Vec<contact::Pair>,
    /// Tables of springs and dashpots.
    springs: String,
    loaded_faces: faces::LoadedFaces,
    curves: Vec<(String, amplitude::Curve)>,
    /// Tables of steps.
    steps: String,
    /// Record of whether the last step takes displacements as large; `None` before the first.
    is_nonlinear: Option<bool>,
    output: output::Output,
    /// Lines of keywords of which something was made.
    used: BTreeSet<usize>,
    /// Content without a counterpart, by line.
    listed: BTreeMap<usize, Vec<String>>,
}

/// Keywords of meshes, and those that say nothing by themselves.
const OF_MESHES: [&str; 9] = [
    "HEADING", "PREPRINT", "PART", "ASSEMBLY", "INSTANCE", "NODE", "ELEMENT", "NSET", "ELSET",
];

impl<'a> Model<'a> {
    fn new(input: &'a InputFile, keywords: &'a [Keyword<'a>]) -> Self {
        Self {
            input,
            keywords,
            points: points::ReferencePoints::new(input, keywords),
            instances: bodies::instances(keywords),
            bodies: Vec::new(),
            materials: String::new(),
            rigid: Vec::new(),
            contact: String::new(),
            pairs: Vec::new(),
            springs: String::new(),
            loaded_faces: faces::LoadedFaces::default(),
            curves: Vec::new(),
            steps: String::new(),
            is_nonlinear: None,
            output: output::Output::default(),
            used: BTreeSet::new(),
            listed: BTreeMap::new(),
        }
    }

    /// Lists what has no counterpart.
    fn list(&mut self, line: usize, what: impl Into<String>) {
        self.listed.entry(line).or_default().push(what.into());
    }

    /// Lists parameters of a keyword that are none of these.
    fn list_parameters(&mut self, keyword: &Keyword<'_>, known: &[&str]) {
        let others = keyword.parameters();
        let others: Vec<&str> = others
            .map(|(key, _)| key)
            .filter(|key| !known.contains(key))
            .collect();
        if !others.is_empty() {
            let what = format!("*{}: parameter {}", keyword.name, others.join(", "));
            self.list(keyword.line, what);
        }
    }

    fn finished(mut self, path: &Path, written: &str) -> Converted {
        let output = self.output_table();
        for keyword in self.keywords {
            let name = keyword.name.as_str();
            let is_of_mesh = OF_MESHES.contains(&name) || name.starts_with("END ");
            if !is_of_mesh
                && !self.used.contains(&keyword.line)
                && !self.listed.contains_key(&keyword.line)
            {
                let advice = remedy::remedy(name);
                self.list(keyword.line, format!("*{name}{advice}"));
            }
        }
        let lines = self.listed.iter();
        let listed: Vec<String> = lines
            .flat_map(|(line, all)| {
                let place = self.input.place(*line);
                all.iter().map(move |what| format!("{place}: {what}"))
            })
            .collect();
        let file = path.file_name().unwrap_or_default().to_string_lossy();
        let mut deck = format!("# Made of {file} by `striae convert`.\n");
        if !listed.is_empty() {
            deck += "#\n# Not converted:\n";
            for line in &listed {
                deck += &format!("#   {}\n", line.replace(char::is_control, " "));
            }
        }
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        deck += &format!("\ntitle = {}\n{}", text(&stem), self.materials);
        let bodies = self.bodies.iter().map(|body| body.table(written));
        deck += &bodies.collect::<String>();
        let rigid = self.rigid.iter();
        deck += &rigid
            .map(|rigid| rigid.table(written, &self.bodies))
            .collect::<String>();
        deck += &self.contact;
        deck += &self.springs;
        deck += &amplitude::tables(&self.curves);
        deck += &self.steps;
        deck += &output;
        Converted { deck, listed }
    }
}

/// Returns whether a parameter has a given word as its value, in any case.
fn has(keyword: &Keyword<'_>, parameter: &str, word: &str) -> bool {
    let value = keyword.parameter(parameter);
    value.is_some_and(|value| value.eq_ignore_ascii_case(word))
}

/// The numbers of a row from one of its words on; `None` where one is not a number, 0 for a blank.
fn numbers(words: &[&str]) -> Option<Vec<f64>> {
    let value = |word: &&str| match word.is_empty() {
        true => Some(0.0),
        false => striae_meshfile::finite(word),
    };
    words.iter().map(value).collect()
}
