//! Problems of other programs, as `suite.toml` lists them.
//!
//! ```toml
//! [[problem]]
//! deck = "NAME"                # NAME.toml beside the list
//! title = "what is computed"
//! by = "program or author"
//! source = "document"
//! url = "address"              # if it is public
//! remark = "what is different" # optional
//!
//! [[problem.run]]              # optional; by default one run of the deck as it is
//! name = "mu 0.1"
//! set = ["mu=0.1"]
//! stops = "why"                # of a run that does not reach its end
//!
//! [[problem.value]]
//! run = "mu 0.1"               # by default the first one
//! quantity = "what is compared"
//! formula = "reaction.block.xmin.x/100"
//! published = 0.412            # optional; without it the value is only told
//! from = "closed form"         # or "figure", "other programs", ...
//! within = 0.01                # expected of the discretisation, of the published value
//! off = "why"                  # of a value that is farther away
//! ```

use std::{fs, path::Path};

use toml::{Table, Value as Entry};

use crate::fault::Fault;

/// A problem that another program publishes.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Name of its deck.
    pub deck: String,
    /// Subject in a line.
    pub title: String,
    /// Program or author that publishes it.
    pub by: String,
    /// The document.
    pub source: String,
    /// Its address.
    pub url: Option<String>,
    /// Differences to the publication.
    pub remark: Option<String>,
    /// Runs of the deck.
    pub runs: Vec<Setting>,
    /// Values that are compared.
    pub values: Vec<Value>,
}

/// A run of a deck.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Setting {
    /// Name; empty of the only one.
    pub name: String,
    /// Parameters of the deck.
    pub set: Vec<String>,
    /// Reason why the program does not reach the end.
    pub stops: Option<String>,
}

/// A value that is compared.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    /// Place of its run in the list of the problem.
    pub run: usize,
    /// Name.
    pub quantity: String,
    /// Formula of the columns of the program's tables.
    pub formula: String,
    /// Published value.
    pub published: Option<f64>,
    /// Origin of the published value.
    pub from: String,
    /// Largest difference that the discretisation explains, over the published value.
    pub within: f64,
    /// Explanation of a larger difference.
    pub off: Option<String>,
}

/// Reads `suite.toml` of a folder.
///
/// # Errors
/// When the file cannot be read or lacks something.
pub fn read(folder: &Path) -> Result<Vec<Problem>, Fault> {
    let path = folder.join("suite.toml");
    let text = fs::read_to_string(&path).map_err(|cause| Fault::Unreadable {
        path: path.clone(),
        cause,
    })?;
    of(&text).map_err(|wrong| Fault::Suite(format!("{}: {wrong}", path.display())))
}

/// Reads the text of the list.
///
/// # Errors
/// Returns the fault, in words.
pub fn of(text: &str) -> Result<Vec<Problem>, String> {
    let table: Table = text.parse().map_err(|wrong| format!("{wrong}"))?;
    tables(&table, "problem").map(problem).collect()
}

fn problem(table: &Table) -> Result<Problem, String> {
    let deck = word(table, "deck")?;
    let within = |wrong: String| format!("problem `{deck}`: {wrong}");
    let runs: Vec<Setting> = tables(table, "run")
        .map(setting)
        .collect::<Result<_, _>>()
        .map_err(within)?;
    let runs = if runs.is_empty() {
        vec![Setting::default()]
    } else {
        runs
    };
    let values = tables(table, "value")
        .map(|table| value(table, &runs))
        .collect::<Result<_, _>>()
        .map_err(within)?;
    Ok(Problem {
        title: word(table, "title").map_err(within)?,
        by: word(table, "by").map_err(within)?,
        source: word(table, "source").map_err(within)?,
        url: word(table, "url").ok(),
        remark: word(table, "remark").ok(),
        deck,
        runs,
        values,
    })
}

fn setting(table: &Table) -> Result<Setting, String> {
    let set = table
        .get("set")
        .and_then(Entry::as_array)
        .into_iter()
        .flatten();
    Ok(Setting {
        name: word(table, "name").unwrap_or_default(),
        set: set
            .filter_map(|text| text.as_str().map(str::to_owned))
            .collect(),
        stops: word(table, "stops").ok(),
    })
}

fn value(table: &Table, runs: &[Setting]) -> Result<Value, String> {
    let quantity = word(table, "quantity")?;
    let run = match word(table, "run") {
        Ok(name) => runs
            .iter()
            .position(|run| run.name == name)
            .ok_or_else(|| format!("there is no run `{name}`"))?,
        Err(_) => 0,
    };
    let published = number(table, "published");
    let lacks = |key: &str| format!("value `{quantity}` has no `{key}`");
    if published.is_some() {
        number(table, "within").ok_or_else(|| lacks("within"))?;
        word(table, "from")?;
    }
    Ok(Value {
        run,
        formula: word(table, "formula")?,
        published,
        from: word(table, "from").unwrap_or_default(),
        within: number(table, "within").unwrap_or_default(),
        off: word(table, "off").ok(),
        quantity,
    })
}

fn tables<'a>(table: &'a Table, key: &str) -> impl Iterator<Item = &'a Table> {
    let entries = table
        .get(key)
        .and_then(Entry::as_array)
        .into_iter()
        .flatten();
    entries.filter_map(Entry::as_table)
}

fn word(table: &Table, key: &str) -> Result<String, String> {
    let word = table.get(key).and_then(Entry::as_str);
    word.map(str::to_owned)
        .ok_or_else(|| format!("there is no `{key}`"))
}

fn number(table: &Table, key: &str) -> Option<f64> {
    match table.get(key)? {
        Entry::Float(number) => Some(*number),
        Entry::Integer(number) => Some(*number as f64),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::suite::formula;

    /// Settings of the solver, of contact and of integration in time.
    const SETTINGS: [&str; 8] = [
        "solver",
        "search_distance",
        "enforcement",
        "initial",
        "stabilise",
        "contact_mass",
        "spectral_radius",
        "feature_angle",
    ];

    fn folder() -> std::path::PathBuf {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
        root.join(crate::suite::FOLDER)
    }

    #[test]
    fn every_deck_is_in_the_list_and_has_no_setting() {
        let listed: BTreeSet<String> = read(&folder())
            .unwrap()
            .into_iter()
            .map(|p| p.deck)
            .collect();
        let mut decks = BTreeSet::new();
        for entry in fs::read_dir(folder()).unwrap() {
            let path = entry.unwrap().path();
            let stem = path.file_stem().unwrap().to_str().unwrap();
            if path.extension().is_none_or(|end| end != "toml") || stem == "suite" {
                continue;
            }
            decks.insert(stem.to_owned());
            let deck: Table = fs::read_to_string(&path).unwrap().parse().unwrap();
            let setting = SETTINGS
                .into_iter()
                .find(|key| has(&Entry::Table(deck.clone()), key));
            assert_eq!(setting, None, "{stem}");
        }
        assert_eq!(decks, listed);
    }

    #[test]
    fn formulas_of_the_list_are_understood() {
        for problem in read(&folder()).unwrap() {
            for value in problem.values {
                if let Err(wrong) = formula::value(&value.formula, &mut |_, _| Some(1.0)) {
                    panic!("{}: {}: {wrong}", problem.deck, value.quantity);
                }
            }
        }
    }

    #[test]
    fn faults_name_the_problem() {
        let of = |text: &str| of(text).unwrap_err();
        assert_eq!(of("[[problem]]\n"), "there is no `deck`");
        let text = "[[problem]]\ndeck = \"a\"\ntitle = \"t\"\nby = \"b\"\nsource = \"s\"\n[[problem.value]]\n";
        assert_eq!(of(text), "problem `a`: there is no `quantity`");
        let text = format!("{text}quantity = \"q\"\nformula = \"1\"\npublished = 1\n");
        assert_eq!(of(&text), "problem `a`: value `q` has no `within`");
    }

    /// Presence of a key at any depth, increments aside, whose sizes have a key `initial` too.
    fn has(entry: &Entry, key: &str) -> bool {
        match entry {
            Entry::Table(table) => table
                .iter()
                .any(|(name, entry)| name == key || name != "increments" && has(entry, key)),
            Entry::Array(entries) => entries.iter().any(|entry| has(entry, key)),
            _ => false,
        }
    }
}
