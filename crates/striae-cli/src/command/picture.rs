//! `striae picture RESULTS FILE.png`: results as a picture, without a browser.

use std::{io::Write, path::PathBuf};

use striae_report::picture::{Picture, WIDTH, write};

use crate::failure::Failure;

/// Draw the results of a run: deformed bodies, coloured by a field.
#[derive(clap::Args)]
pub struct Arguments {
    /// Folder of the run, which may still be in progress.
    results: PathBuf,
    /// The file, a PNG; by default RESULTS/picture.png.
    #[arg(short, long, alias = "output")]
    out: Option<PathBuf>,
    /// Field by its name in the VTU files; by default the contact pressure.
    #[arg(long)]
    field: Option<String>,
    /// Component, such as `x`, `magnitude`, `von Mises`, `largest principal`.
    #[arg(long)]
    component: Option<String>,
    /// Time; by default the last one, otherwise the nearest with fields.
    #[arg(long, allow_negative_numbers = true)]
    time: Option<f64>,
    /// Viewing direction, from the eye to the bodies.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = direction)]
    view: Option<[f64; 3]>,
    /// Magnification of displacements.
    #[arg(long, default_value_t = 1.0)]
    magnify: f64,
    /// A body or a surface to leave out; may be repeated.
    #[arg(long, value_name = "NAME")]
    hide: Vec<String>,
    /// Width in pixels.
    #[arg(long, default_value_t = WIDTH, value_parser = width)]
    width: usize,
}

/// Writes the picture and says where it is.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let own = || arguments.results.join("picture.png");
    let file = arguments.out.clone().unwrap_or_else(own);
    let usual = Picture::default();
    let picture = Picture {
        field: arguments.field.clone(),
        component: arguments.component.clone(),
        time: arguments.time,
        direction: arguments.view.unwrap_or(usual.direction),
        magnification: arguments.magnify,
        hidden: arguments.hide.clone(),
        width: arguments.width,
    };
    write(&arguments.results, &picture, &file)?;
    writeln!(out, "wrote {}", file.display())?;
    Ok(())
}

/// Three numbers separated by commas.
pub fn direction(text: &str) -> Result<[f64; 3], String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|word| word.trim().parse()).collect();
    let numbers = numbers.ok().and_then(|numbers| numbers.try_into().ok());
    numbers.ok_or_else(|| "three numbers are needed, as 0.6,1,-0.65".to_owned())
}

/// A number of pixels that a picture may be wide.
pub fn width(text: &str) -> Result<usize, String> {
    let width = text
        .parse()
        .ok()
        .filter(|width| (100..=8000).contains(width));
    width.ok_or_else(|| "a number from 100 to 8000 is needed".to_owned())
}
