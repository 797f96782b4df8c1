//! `striae convert MODEL.inp`: a deck made of an Abaqus model.

use std::{
    fs,
    io::Write,
    path::{Component, Path, PathBuf},
};

use crate::{failure::Failure, shell::word};

/// Convert an Abaqus model to a deck; keywords without a counterpart are listed with their lines.
#[derive(clap::Args)]
pub struct Arguments {
    /// The model: an .inp file of Abaqus. The deck reads its meshes from there.
    model: PathBuf,
    /// The deck to be written; it must not exist. Default: the name of the model with .toml.
    #[arg(short, long, alias = "output", value_name = "DECK.toml")]
    out: Option<PathBuf>,
}

/// Writes the deck, prints what is not converted, and checks the deck.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let model = &arguments.model;
    let deck = arguments.out.clone();
    let deck = deck.unwrap_or_else(|| model.with_extension("toml"));
    // First of all the model: the name of a deck in its place is that of the deck to be written.
    let converted = striae_deck::convert(model, &reference(model, &deck))?;
    if deck.exists() {
        return Err(Failure::Exists(deck));
    }
    fs::write(&deck, &converted.deck).map_err(|cause| Failure::Unwritable {
        path: deck.clone(),
        cause,
    })?;
    if !converted.listed.is_empty() {
        writeln!(out, "not converted:")?;
    }
    for line in &converted.listed {
        writeln!(out, "  {line}")?;
    }
    writeln!(out, "wrote {}", deck.display())?;
    let read = striae_deck::read(&deck);
    let next = match read {
        Ok(_) => "next:",
        Err(_) => "next: complete the deck, then:",
    };
    writeln!(out, "{next} striae check {}", word(&deck))?;
    read?;
    Ok(())
}

/// The path of the model from the folder of the deck; from the root where they have nothing else in
/// common.
fn reference(model: &Path, deck: &Path) -> String {
    let folder = |path: &Path| {
        let parent = path.parent().unwrap_or(Path::new(""));
        let parent = if parent == Path::new("") {
            Path::new(".")
        } else {
            parent
        };
        parent.canonicalize().unwrap_or_else(|_| parent.to_owned())
    };
    let (of_model, of_deck) = (folder(model), folder(deck));
    let name = model.file_name().unwrap_or_default();
    let common = of_deck.ancestors().find(|one| of_model.starts_with(one));
    let path = match common.filter(|common| common.parent().is_some()) {
        Some(common) => {
            let [down, up] = [&of_model, &of_deck].map(|path| path.strip_prefix(common));
            let up = up.into_iter().flat_map(Path::components);
            let up = up.map(|_| Component::ParentDir.as_os_str());
            up.collect::<PathBuf>().join(down.unwrap_or(&of_model))
        }
        None => of_model,
    };
    let path = path.join(name);
    path.to_string_lossy().replace('\\', "/")
}
