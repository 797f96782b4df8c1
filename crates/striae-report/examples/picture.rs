//! A picture of a results folder: `cargo run -p striae-report --example picture RESULTS FILE.png`.

use std::{env, error::Error, path::Path};

use striae_report::picture::{Picture, write};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [results, file, field @ ..] = &arguments[..] else {
        return Err("a results folder and a file are needed, and perhaps a field".into());
    };
    let picture = Picture {
        field: field.first().cloned(),
        ..Picture::default()
    };
    Ok(write(Path::new(results), &picture, Path::new(file))?)
}
