//! Benchmarks: `striae-bench [GROUP ...] [--size UNKNOWNS ...] [--json FILE] [--compare | --growth [--backend SOLVER] | --agree] [--figure FOLDER]`.
//!
//! Groups are `law`, `element`, `surface`, `search`, `assembly`, `component`, `factor`,
//! `iteration` and `cases`; all of them without arguments. `--compare` runs scenes with the
//! condensed solver and with the multifrontal LU, each in a process of its own, and prints the
//! ratios of times and memory, and to a sparse Cholesky factorisation of the
//! stiffness alone by the library faer with the same ordering. `--growth` fits time
//! and memory against unknowns, of the condensed solver or another backend. `--agree`
//! makes every increment of decks again with the multifrontal LU and compares the
//! answers. README.md says what each group covers.

mod agree;
mod clock;
mod compare;
mod component;
mod element;
mod growth;
mod parts;
mod scene;
mod yardstick;

use serde_json::{Value, json};
use std::{error::Error, process::ExitCode};

/// Arguments of the command line.
#[derive(Default)]
struct Arguments {
    groups: Vec<String>,
    sizes: Vec<usize>,
    json: Option<String>,
    compare: bool,
    growth: bool,
    agree: bool,
    figure: Option<String>,
    backend: Option<String>,
}

fn main() -> ExitCode {
    match run(std::env::args().skip(1)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn run(mut words: impl Iterator<Item = String>) -> Result<(), Box<dyn Error>> {
    let mut arguments = Arguments::default();
    while let Some(word) = words.next() {
        match word.as_str() {
            "--one" => return compare::one(&words.collect::<Vec<_>>()),
            "--compare" => arguments.compare = true,
            "--growth" => arguments.growth = true,
            "--agree" => arguments.agree = true,
            "--backend" => arguments.backend = words.next(),
            "--figure" => arguments.figure = words.next(),
            "--json" => arguments.json = words.next(),
            "--size" => arguments
                .sizes
                .push(words.next().ok_or("--size needs a number")?.parse()?),
            group => arguments.groups.push(group.to_owned()),
        }
    }
    let results = if arguments.compare {
        compare::all(&arguments.groups, &arguments.sizes)?
    } else if arguments.growth {
        let folder = arguments.figure.as_deref();
        {
            let solver = arguments.backend.as_deref().unwrap_or("condensed");
            growth::all(&arguments.groups, &arguments.sizes, folder, solver)?
        }
    } else if arguments.agree {
        agree::all(&arguments.groups)?
    } else {
        parts::all(&arguments.groups, &arguments.sizes)?
    };
    if let Some(path) = arguments.json {
        let threads = std::thread::available_parallelism()?.get();
        let file = json!({ "version": env!("CARGO_PKG_VERSION"), "threads": threads, "results": &results });
        std::fs::write(path, serde_json::to_string_pretty::<Value>(&file)? + "\n")?;
    }
    agree::verdict(&results)
}
