//! `striae picture RESULTS`: results as a picture or an animation, without a browser.

use std::{io::Write, path::PathBuf};

use striae_report::picture::{Picture, VIEWS, WIDTH, animate, write};

use crate::failure::Failure;

/// Draw the results of a run: deformed bodies, coloured by a field.
#[derive(clap::Args)]
pub struct Arguments {
    /// Folder of the run, which may still be in progress.
    results: PathBuf,
    /// The file, a PNG, or with `--animate` a GIF or an animated PNG; by default
    /// RESULTS/picture.png or RESULTS/animation.gif.
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
    /// Draw an animation of all times with fields, with one view and one colour range.
    #[arg(long, conflicts_with = "time")]
    animate: bool,
    /// Seconds that a frame of an animation is shown, the last one at least 1.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.1, requires = "animate", value_parser = seconds)]
    frame_time: f64,
    /// Viewing direction, from the eye to the bodies, or a view by its name: `corner`, `front`,
    /// `back`, `left`, `right`, `top`, `below`.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = direction)]
    view: Option<[f64; 3]>,
    /// Colour range; by default from the least to the largest value shown.
    #[arg(long, value_name = "LEAST,LARGEST", allow_hyphen_values = true, value_parser = range)]
    range: Option<[f64; 2]>,
    /// Magnification of displacements.
    #[arg(long, default_value_t = 1.0, allow_negative_numbers = true)]
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
    let name = match arguments.animate {
        true => "animation.gif",
        false => "picture.png",
    };
    let own = || arguments.results.join(name);
    let file = arguments.out.clone().unwrap_or_else(own);
    let usual = Picture::default();
    let picture = Picture {
        field: arguments.field.clone(),
        component: arguments.component.clone(),
        time: arguments.time,
        direction: arguments.view.unwrap_or(usual.direction),
        range: arguments.range,
        magnification: arguments.magnify,
        hidden: arguments.hide.clone(),
        width: arguments.width,
    };
    match arguments.animate {
        true => animate(&arguments.results, &picture, arguments.frame_time, &file)?,
        false => write(&arguments.results, &picture, &file)?,
    }
    writeln!(out, "wrote {}", file.display())?;
    Ok(())
}

/// A view by its name, or three numbers separated by commas.
pub fn direction(text: &str) -> Result<[f64; 3], String> {
    if let Some((_, direction)) = VIEWS.iter().find(|(name, _)| *name == text) {
        return Ok(*direction);
    }
    numbers(text).ok_or_else(|| {
        let names = VIEWS.map(|(name, _)| name).join(", ");
        format!("three numbers are needed, as 0.6,1,-0.65, or one of {names}")
    })
}

/// Two ascending numbers separated by a comma.
fn range(text: &str) -> Result<[f64; 2], String> {
    let range = numbers(text).filter(|[least, largest]| least < largest);
    range.ok_or_else(|| "two ascending numbers are needed, as 0,2.5e6".to_owned())
}

/// Finite numbers separated by commas.
fn numbers<const COUNT: usize>(text: &str) -> Option<[f64; COUNT]> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|word| word.trim().parse()).collect();
    let numbers: [f64; COUNT] = numbers.ok()?.try_into().ok()?;
    numbers.iter().all(|n| n.is_finite()).then_some(numbers)
}

/// A time that a frame may be shown.
fn seconds(text: &str) -> Result<f64, String> {
    let seconds = text
        .parse()
        .ok()
        .filter(|seconds| (0.01..=60.0).contains(seconds));
    seconds.ok_or_else(|| "a number of seconds from 0.01 to 60 is needed".to_owned())
}

/// A number of pixels that a picture may be wide.
pub fn width(text: &str) -> Result<usize, String> {
    let width = text
        .parse()
        .ok()
        .filter(|width| (100..=8000).contains(width));
    width.ok_or_else(|| "a number from 100 to 8000 is needed".to_owned())
}
