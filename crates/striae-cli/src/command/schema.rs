//! `striae schema`: what a deck may contain, for editors and people.

use crate::failure::Failure;
use std::io::Write;
use striae_deck as deck;

/// Print the JSON schema or the reference of the deck.
#[derive(clap::Args)]
pub struct Arguments {
    /// Format of the output.
    #[arg(long, value_enum, default_value_t = Format::Json)]
    format: Format,
}

/// Format of the output.
#[derive(Clone, Copy, clap::ValueEnum)]
enum Format {
    /// JSON schema, with which editors complete and check decks.
    Json,
    /// Reference of all keys.
    Markdown,
}

/// Prints the schema.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    match arguments.format {
        Format::Json => writeln!(out, "{:#}", deck::json_schema(&deck::Laws::default()))?,
        Format::Markdown => write!(out, "{}", deck::reference(&deck::Laws::default()))?,
    }
    Ok(())
}
