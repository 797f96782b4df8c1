//! Formulas of the book: LaTeX in Markdown to MathML, which browsers draw by themselves.
//!
//! A formula is a fenced block ` ```math ` or stands between dollar signs, as GitHub has it,
//! so pages read the same there. mdBook calls `cargo xtask mathematics` as a preprocessor:
//! a list of context and book comes in as JSON, the book goes out
//! (<https://rust-lang.github.io/mdBook/for_developers/preprocessors.html>).

use std::{
    io::{Read, Write},
    ops::Range,
};

use math_core::{LatexToMathML, MathCoreConfig, MathDisplay};
use pulldown_cmark::{CodeBlockKind, Event, Options, Parser, Tag};
use serde_json::Value;

use crate::fault::Fault;

/// A preprocessor of mdBook: `supports RENDERER` as arguments, or a book on standard input.
///
/// # Errors
/// When what comes in is no book, or a formula cannot be read.
pub fn preprocess(arguments: &[String]) -> Result<(), Fault> {
    if let [question, _renderer] = arguments
        && question == "supports"
    {
        return Ok(());
    }
    let mut text = String::new();
    let read = std::io::stdin().read_to_string(&mut text);
    read.map_err(|cause| Fault::Book(format!("the book cannot be read: {cause}")))?;
    let unknown = |cause| Fault::Book(format!("mdBook sent no book: {cause}"));
    let [_, mut book]: [Value; 2] = serde_json::from_str(&text).map_err(unknown)?;
    let writer = Formulas::new()?;
    chapters(&mut book, &writer)?;
    let written = std::io::stdout().write_all(book.to_string().as_bytes());
    written.map_err(|cause| Fault::Book(format!("the book cannot be written: {cause}")))
}

/// Replaces formulas in every chapter, however deep.
fn chapters(value: &mut Value, writer: &Formulas) -> Result<(), Fault> {
    match value {
        Value::Array(items) => items.iter_mut().try_for_each(|item| chapters(item, writer)),
        Value::Object(fields) => {
            let name = fields.get("name").and_then(Value::as_str);
            let name = name.unwrap_or_default().to_owned();
            for (key, value) in fields.iter_mut() {
                match value {
                    Value::String(text) if key == "content" => {
                        let drawn = writer.drawn(text);
                        *text = drawn.map_err(|why| Fault::Book(format!("{name}: {why}")))?;
                    }
                    other => chapters(other, writer)?,
                }
            }
            Ok(())
        }
        _ => Ok(()),
    }
}

/// Converter of formulas to MathML.
pub struct Formulas(LatexToMathML);

impl Formulas {
    /// Ready to make formulas.
    ///
    /// # Errors
    /// Never, as there are no macros that could be wrong.
    pub fn new() -> Result<Self, Fault> {
        let made = LatexToMathML::new(MathCoreConfig::default());
        made.map(Self)
            .map_err(|(error, ..)| Fault::Book(error.to_string()))
    }

    /// A page with all its formulas as MathML.
    ///
    /// # Errors
    /// The first formula that cannot be read, and why.
    pub fn drawn(&self, page: &str) -> Result<String, String> {
        let mut drawn = String::new();
        let mut at = 0;
        for (place, formula, display) in formulas(page) {
            let made = self.0.convert_with_local_counter(&formula, display);
            let made = made.map_err(|error| format!("{error} in\n{formula}"))?;
            drawn.push_str(&page[at..place.start]);
            let inert = inert(&made);
            match display {
                MathDisplay::Block => {
                    drawn.push_str(&format!("<div class=\"formula\">{inert}</div>\n"));
                }
                MathDisplay::Inline => drawn.push_str(&inert),
            }
            at = place.end;
        }
        drawn.push_str(&page[at..]);
        Ok(drawn)
    }
}

/// Formulas of a page with their places, in order.
fn formulas(page: &str) -> Vec<(Range<usize>, String, MathDisplay)> {
    let mut found = Vec::new();
    let mut fenced: Option<(Range<usize>, String)> = None;
    for (event, place) in Parser::new_ext(page, options()).into_offset_iter() {
        match event {
            Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(kind))) if &*kind == "math" => {
                fenced = Some((place, String::new()));
            }
            Event::Text(text) => {
                if let Some((_, formula)) = &mut fenced {
                    formula.push_str(&text);
                }
            }
            Event::End(pulldown_cmark::TagEnd::CodeBlock) => {
                if let Some((place, formula)) = fenced.take() {
                    found.push((place, formula.trim().to_owned(), MathDisplay::Block));
                }
            }
            Event::DisplayMath(formula) => {
                found.push((place, formula.to_string(), MathDisplay::Block));
            }
            Event::InlineMath(formula) => {
                found.push((place, formula.to_string(), MathDisplay::Inline));
            }
            _ => {}
        }
    }
    found
}

/// Extensions of Markdown that pages of the book may use.
pub fn options() -> Options {
    Options::ENABLE_MATH | Options::ENABLE_TABLES
}

/// MathML in which no letter means anything to Markdown.
fn inert(mathml: &str) -> String {
    let mut inert = String::new();
    let mut within_tag = false;
    for letter in mathml.chars() {
        match letter {
            '<' => within_tag = true,
            '>' => within_tag = false,
            _ => {}
        }
        match letter {
            '*' | '_' | '[' | ']' | '\\' | '`' | '~' | '|' | '!' if !within_tag => {
                inert.push_str(&format!("&#{};", u32::from(letter)));
            }
            '\n' => inert.push(' '),
            other => inert.push(other),
        }
    }
    inert
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_are_found_where_they_are_written_and_nowhere_else() {
        let page =
            "Let $g \\ge 0$, `$x$`.\n\n```math\ng = 0 \\\\\np_* = 1\n```\n\n```text\n$y$\n```\n";
        let found: Vec<String> = formulas(page)
            .into_iter()
            .map(|(_, text, _)| text)
            .collect();
        assert_eq!(found, ["g \\ge 0", "g = 0 \\\\\np_* = 1"]);
        let drawn = Formulas::new().unwrap().drawn(page).unwrap();
        assert_eq!(drawn.matches("<math").count(), 2);
        assert!(drawn.contains("<div class=\"formula\"><math display=\"block\">"));
        assert!(drawn.contains("`$x$`") && drawn.contains("$y$"));
        assert!(!drawn.contains('*') && !drawn.contains("\n\n</math>"));
    }

    #[test]
    fn a_formula_that_cannot_be_read_is_named() {
        let wrong = Formulas::new().unwrap().drawn("$\\nosuch{x}$");
        assert!(wrong.unwrap_err().contains("\\nosuch{x}"));
    }

    #[test]
    fn books_keep_all_but_formulas() {
        let mut book = serde_json::json!({"items": [{"Chapter": {
            "name": "a", "content": "$x$", "path": "a.md",
            "sub_items": [{"Chapter": {"name": "b", "content": "b", "sub_items": []}}]
        }}]});
        chapters(&mut book, &Formulas::new().unwrap()).unwrap();
        let chapter = &book["items"][0]["Chapter"];
        assert!(chapter["content"].as_str().unwrap().contains("<mi>x</mi>"));
        assert_eq!(chapter["sub_items"][0]["Chapter"]["content"], "b");
    }
}
