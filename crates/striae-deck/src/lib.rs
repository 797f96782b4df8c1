//! The deck: one TOML file that describes a whole simulation.
//!
//! Reading has two stages. The text becomes the tables of `raw`, in which every value has its form
//! and its place in the text; these are lowered to the [`Model`], in which every name has become an
//! id and every set its members. Both stages continue after a fault, so that [`Faults`] lists all
//! there are.
//!
//! [`write()`] goes the other way, from a model to a text that reads back to it, and
//! [`convert()`] makes a deck of an Abaqus model.
//!
//! All quantities are in one consistent system of units chosen by the author.

mod convert;
mod declare;
mod expression;
mod fault;
mod faults;
mod form;
mod include;
mod law;
mod laws;
mod lower;
mod names;
mod parameters;
mod places;
mod raw;
mod read;
mod schema;
mod settings;
mod value;
mod write;

pub use convert::{Converted, convert};
pub use fault::FaultKind;
pub use faults::{Fault, Faults, Location, Position};
pub use laws::Laws;
pub use places::{Part, Places};
pub use schema::{json_schema, reference};
pub use settings::Setting;
pub use write::{Unstated, write};

use faults::FaultList;
use std::path::Path;
use striae_law::friction::Friction;
use striae_model::Model;
use striae_output::Output;
use toml::de::{DeTable, DeValue};

/// A deck that has been found valid.
#[derive(Clone, Debug)]
pub struct Deck {
    /// Model to be simulated.
    pub model: Model,
    /// Output to be written.
    pub output: Output,
    /// Numbers of the deck by which a run of it is differentiated: names of parameters, or paths.
    pub wrt: Vec<String>,
    /// Notes on parts of mesh files that were interpreted or replaced, one line each.
    pub notes: Vec<String>,
    /// Locations of its named parts.
    pub places: Places,
    /// Faults of the deck if it is run without ranks.
    together: Option<Box<Faults>>,
}

impl Deck {
    /// The deck, for a run without ranks.
    ///
    /// # Errors
    /// When it requires a solver that needs ranks.
    pub fn alone(self) -> Result<Self, Faults> {
        match self.together {
            Some(faults) => Err(*faults),
            None => Ok(self),
        }
    }
}

/// Reads a deck from a file; paths in it are relative to its folder.
///
/// # Errors
/// All faults of the deck; one without position if the file cannot be read.
pub fn read(path: &Path) -> Result<Deck, Faults> {
    read_with(path, &[])
}

/// Reads a deck from a file with parameters and other numbers set from outside.
///
/// # Errors
/// As [`read`], and where a setting is of no number of the deck.
pub fn read_with(path: &Path, settings: &[Setting]) -> Result<Deck, Faults> {
    Reader::new(&Laws::default(), settings).read(path)
}

/// Reads a deck from its text.
///
/// `file` is what faults call it; paths in it are relative to `base`.
///
/// # Errors
/// All faults of the deck.
pub fn parse(text: &str, file: &str, base: &Path) -> Result<Deck, Faults> {
    parse_with(text, file, base, &[])
}

/// Reads a deck from its text with parameters and other numbers set from outside.
///
/// # Errors
/// As [`parse`], and where a setting is of no number of the deck.
pub fn parse_with(
    text: &str,
    file: &str,
    base: &Path,
    settings: &[Setting],
) -> Result<Deck, Faults> {
    Reader::new(&Laws::default(), settings).parse(text, file, base)
}

/// Reads the keys of a `friction` table on their own, without a deck.
///
/// `file` is what faults call the text.
///
/// # Errors
/// All faults of the keys and what the law refuses.
pub fn friction(text: &str, file: &str) -> Result<Friction, Faults> {
    let laws = Laws::default();
    let mut faults = FaultList::new(file, text, &laws);
    let friction = tables::<raw::Friction>(text, &mut faults)
        .and_then(|raw| lower::friction(&raw, &raw.span, &mut faults));
    match friction {
        Some(friction) if faults.is_empty() => Ok(friction),
        _ => Err(faults.into_faults()),
    }
}

/// Reads decks that may name other laws and textures than those of the library.
///
/// ```
/// use std::path::Path;
/// use striae_deck::{Laws, Reader};
/// use striae_declared::{Declared, POSITIVE, Parameter};
/// use striae_law::friction::Friction;
///
/// static SLIPPERY: Declared<Friction> = Declared {
///     name: "slippery",
///     summary: "A tenth of Coulomb friction.",
///     parameters: &[Parameter::number("dry", POSITIVE, "no unit", "Coefficient when dry.")],
///     build: |values| Friction::coulomb(0.1 * values.number("dry")),
///     fit: None,
/// };
///
/// let laws = Laws::default().with_friction(&SLIPPERY);
/// let deck = Reader::new(&laws, &[]).read(Path::new("deck.toml"));
/// # assert!(deck.is_err(), "there is no such file");
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Reader<'r> {
    laws: &'r Laws,
    settings: &'r [Setting],
}

impl<'r> Reader<'r> {
    /// Returns a reader with laws that decks may name and numbers that are set from outside.
    pub fn new(laws: &'r Laws, settings: &'r [Setting]) -> Self {
        Self { laws, settings }
    }

    /// Reads a deck from a file; paths in it are relative to its folder.
    ///
    /// # Errors
    /// All faults of the deck; one without position if the file cannot be read.
    pub fn read(&self, path: &Path) -> Result<Deck, Faults> {
        let (text, file, base) = text_of(path)?;
        self.deck(&text, &file, base, Some(path))
    }

    /// Reads parameters of a deck in a file, and other numbers of it by their paths.
    ///
    /// # Errors
    /// All faults of the text, and where there is no such number.
    pub fn numbers(&self, path: &Path, names: &[String]) -> Result<Vec<f64>, Faults> {
        let (text, file, base) = text_of(path)?;
        let mut faults = FaultList::new(&file, &text, self.laws);
        let included = include::texts(&text, base, Some(path), &mut faults);
        let found = computed(
            &text,
            &included,
            self.settings,
            &mut faults,
            |tree, faults| {
                let names = names.iter();
                names
                    .map(|name| settings::number(tree, name, None, faults))
                    .collect()
            },
        );
        match found {
            Some(numbers) if faults.is_empty() => Ok(numbers),
            _ => Err(faults.into_faults()),
        }
    }

    /// Reads a deck from its text, which faults call `file`; paths in it are relative to `base`.
    ///
    /// # Errors
    /// All faults of the deck.
    pub fn parse(&self, text: &str, file: &str, base: &Path) -> Result<Deck, Faults> {
        self.deck(text, file, base, None)
    }

    /// Reads a deck from its text, which is the content of `path` if it is one of a file.
    fn deck(
        &self,
        text: &str,
        file: &str,
        base: &Path,
        path: Option<&Path>,
    ) -> Result<Deck, Faults> {
        let mut faults = FaultList::new(file, text, self.laws);
        let included = include::texts(text, base, path, &mut faults);
        let deck = simulation(text, &included, self.settings, &mut faults)
            .and_then(|raw| lower::deck(&raw, base, &mut faults));
        match deck {
            Some(mut deck) if faults.is_empty() => {
                deck.notes.extend(settings::note(self.settings));
                Ok(deck)
            }
            _ => Err(faults.into_faults()),
        }
    }
}

/// The text of a file, its name in messages, and the folder that paths in it are relative to.
fn text_of(path: &Path) -> Result<(String, String, &Path), Faults> {
    let file = path.display().to_string();
    let bytes =
        striae_meshfile::content(path).map_err(|cause| Faults::unreadable(&file, &cause))?;
    let text = String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        Faults::no_text(&file, error.as_bytes(), valid)
    })?;
    Ok((text, file, path.parent().unwrap_or(Path::new(""))))
}

/// The tables of a deck and of what it includes, with the values of expressions.
fn simulation(
    text: &str,
    included: &[String],
    settings: &[Setting],
    faults: &mut FaultList<'_>,
) -> Option<raw::Simulation> {
    computed(text, included, settings, faults, |tree, faults| {
        let raw: raw::Simulation =
            read::read_keys(tree, 0..0, &read::Place::root(), faults, read::Part::part)?;
        for name in raw.sensitivity.iter().flat_map(|at| at.value.names()) {
            settings::number(tree, &name.value.0, Some(&name.span), faults);
        }
        Some(raw)
    })
}

/// Reads something from the tables of a deck and of what it includes, in which expressions have
/// been replaced by their values.
fn computed<T>(
    text: &str,
    included: &[String],
    settings: &[Setting],
    faults: &mut FaultList<'_>,
    read: impl FnOnce(&DeTable<'_>, &mut FaultList<'_>) -> Option<T>,
) -> Option<T> {
    // They outlive the tree that they are put into.
    let mut values = Vec::new();
    let mut tree = tree(text, faults)?;
    for text in included {
        include::merge(&mut tree, self::tree(text, faults)?);
    }
    values.extend(parameters::computed(&tree, settings, faults));
    parameters::replace(&mut tree, &values);
    read(&tree, faults)
}

/// The tables of a text.
fn tables<T: read::Part>(text: &str, faults: &mut FaultList<'_>) -> Option<T> {
    read::read_keys(
        &tree(text, faults)?,
        0..0,
        &read::Place::root(),
        faults,
        read::Part::part,
    )
}

fn tree<'t>(text: &'t str, faults: &mut FaultList<'_>) -> Option<DeTable<'t>> {
    let (tree, errors) = DeTable::parse_recoverable(text);
    for error in &errors {
        let span = error.span().unwrap_or(0..0);
        // The parser may complain of several parts of one number.
        let (span, message) = match number_at(text, span.start) {
            Some((place, number)) => {
                let (found, remedy) = (&text[place.clone()], striae_declared::shown(number));
                let message = format!("`{found}` is not how it writes a number; write {remedy}");
                (place, message)
            }
            None => {
                let message = error.message().to_owned() + decimals(text, span.start);
                (span, message)
            }
        };
        faults.push(&span, FaultKind::Syntax { message });
    }
    errors.is_empty().then(|| tree.into_inner())
}

/// The number around a place that other readers know and TOML does not: `.3`, `3.`, `03`.
fn number_at(text: &str, at: usize) -> Option<(faults::Span, f64)> {
    let of_number = |c: char| c.is_ascii_digit() || ['+', '-', '.', 'e', 'E'].contains(&c);
    let (before, after) = text.split_at_checked(at)?;
    let start = before.trim_end_matches(of_number).len();
    let end = text.len() - after.trim_start_matches(of_number).len();
    let found = &text[start..end];
    let number: f64 = found.parse().ok()?;
    let is_foreign = number.is_finite() && DeValue::parse(found).is_err();
    is_foreign.then_some((start..end, number))
}

/// A word on decimal commas, where a line that cannot be read has one.
fn decimals(text: &str, at: usize) -> &'static str {
    let before = text.get(..at).unwrap_or("");
    let start = before.rfind('\n').map_or(0, |start| start + 1);
    let line = text[start..].lines().next().unwrap_or("").as_bytes();
    let comma = line.windows(4).any(|four| {
        four[0] == b' ' && four[1].is_ascii_digit() && four[2] == b',' && four[3].is_ascii_digit()
    });
    match comma {
        true => "; write decimals with a point, such as 0.3",
        false => "",
    }
}
