//! `striae material DECK`: what the materials of a deck do in uniaxial, equibiaxial and
//! planar tests, and where they are stable; see [`striae::figures::material`].

use std::{
    io::Write,
    path::{Path, PathBuf},
};

use striae::{
    case_name,
    figures::material::{Test, figure},
};
use striae_files::Stems;
use striae_law::bulk::{LameConstants, Material};
use striae_model::Body;

use super::law::make_folder;
use crate::{failure::Failure, source::Source};

/// Show the materials of a deck as figures and numbers.
#[derive(clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    source: Source,
    /// Smallest stretch, in compression.
    #[arg(long, default_value_t = 0.5, value_parser = compressed)]
    from: f64,
    /// Largest stretch, in tension.
    #[arg(long, default_value_t = 3.0, value_parser = stretched)]
    to: f64,
    /// Folder for the figures; by default results/NAME.
    #[arg(short, long, alias = "output")]
    out: Option<PathBuf>,
}

/// Draws and prints every material once.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let model = arguments.source.read()?.model;
    let folder = Path::new("results").join(case_name(&arguments.source.deck));
    let folder = arguments.out.clone().unwrap_or(folder);
    if model.bodies.is_empty() {
        writeln!(out, "the deck has no body, so it has no material")?;
        return Ok(());
    }
    make_folder(&folder)?;
    let mut stems = Stems::default();
    let shown = model.bodies.iter().flat_map(Shown::of);
    let shown: Vec<Shown> = shown
        .map(|shown| Shown {
            file: format!("material-{}", stems.take(&shown.file)),
            ..shown
        })
        .collect();
    for (at, one) in shown.iter().enumerate() {
        let same = |other: &&Shown| other.material == one.material;
        match shown[..at].iter().find(same) {
            Some(other) => writeln!(out, "{}: as {}", one.name, other.name)?,
            None => show(one, arguments, &folder, out)?,
        }
    }
    Ok(())
}

/// A material and where it is.
struct Shown<'m> {
    /// The body or section.
    name: String,
    /// Wanted, and later given, name of the file of its figure.
    file: String,
    material: &'m Material,
}

impl<'m> Shown<'m> {
    /// The materials of a body that elements are of.
    fn of(body: &'m Body) -> Vec<Self> {
        let shown = |section: usize| {
            let (name, file) = match section.checked_sub(1) {
                None => (format!("body `{}`", body.name), body.name.clone()),
                Some(at) => {
                    let set = &body.sections[at].set;
                    let name = format!("section `{set}` of body `{}`", body.name);
                    (name, format!("{}-{section}", body.name))
                }
            };
            Self {
                name,
                file,
                material: body.material_of(section),
            }
        };
        body.used_sections().into_iter().map(shown).collect()
    }
}

fn show(
    shown: &Shown,
    arguments: &Arguments,
    folder: &Path,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let material = shown.material;
    let constants = material.lame_constants();
    let LameConstants { lambda, shear } = constants;
    writeln!(
        out,
        "{}: {}; at rest E = {:.6e}, nu = {:.6}, G = {shear:.6e}, K = {:.6e}",
        shown.name,
        material.name(),
        constants.youngs_modulus(),
        constants.poissons_ratio(),
        lambda + 2.0 / 3.0 * shear,
    )?;
    if !material.fibres().is_empty() {
        writeln!(
            out,
            "  without its {} families of fibres, whose directions are those of the body:",
            material.fibres().len()
        )?;
    }
    let tests = Test::all(material.without_fibres(), arguments.from, arguments.to);
    writeln!(
        out,
        "  test         stretch from        to  nominal stress from            to  stable from        to"
    )?;
    for test in &tests {
        let ends = test.states.first().zip(test.states.last());
        let (first, last) = ends.expect("the state of rest is one of them");
        let [stable, unstable] = test.stable();
        writeln!(
            out,
            "  {:<11}  {:12.4}  {:8.4}  {:19.6e}  {:12.6e}  {stable:11.4}  {unstable:8.4}",
            test.mode.name(),
            first.stretch,
            last.stretch,
            first.nominal,
            last.nominal,
        )?;
    }
    figure(material.name(), &tests).write(folder, &shown.file)?;
    let file = folder.join(&shown.file);
    writeln!(out, "wrote {}.svg, .png and .csv", file.display())?;
    Ok(())
}

fn compressed(text: &str) -> Result<f64, String> {
    within(text, 0.0, 1.0)
}

fn stretched(text: &str) -> Result<f64, String> {
    within(text, 1.0, f64::INFINITY)
}

fn within(text: &str, above: f64, below: f64) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > above && number < below => Ok(number),
        _ if below.is_finite() => Err(format!("it must be a number between {above} and {below}")),
        _ => Err(format!("it must be a number above {above}")),
    }
}
