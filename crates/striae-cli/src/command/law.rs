//! `striae law DECK`: what the friction of a deck, or of constants given on the
//! command line, looks like.
//!
//! For textures at several angles `theta` it draws the slip surface `|tau|/varpi`
//! over the direction of `-tau` and the angle between slip and `-tau`, or friction
//! itself where it opposes slip, over the direction of slip, both directions from `e`
//! (along `a_ba`, or the texture `a` of the only textured side), and prints the axes
//! `A`, `P` and offset `h` of the slip surface where it is an ellipse, its extremes and
//! where friction dissipates least; see [`striae_law::friction`]. Where coefficients depend on
//! pressure, slip rate or accumulated slip, it draws them over these, too.

mod coefficient;
mod constants;
mod json;

use std::{
    io::Write,
    path::{Path, PathBuf},
};

use striae::{
    case_name,
    figures::law::{SAMPLES, degrees, dependence, figure, frictions},
};
use striae_deck as deck;
use striae_law::friction::{Analysis, Friction, Law, RequiredTextures, SlipSurface};
use striae_model::Model;

use crate::{failure::Failure, source::Settings};
use coefficient::coefficient;
use constants::Constants;

/// Show the friction of a deck or of constants, as figures and numbers.
#[derive(clap::Args)]
pub struct Arguments {
    /// The deck, of which every friction is shown.
    #[arg(required_unless_present = "constants")]
    deck: Option<PathBuf>,
    #[command(flatten)]
    settings: Settings,
    #[command(flatten)]
    constants: Constants,
    /// Angles between the textures of the two sides, in degrees.
    #[arg(long, value_delimiter = ',', value_parser = finite, allow_negative_numbers = true, default_values_t = [0.0, 45.0, 90.0, 135.0, 180.0])]
    theta: Vec<f64>,
    /// Folder for the figures; by default results/NAME, or results/law without a deck.
    #[arg(short, long, alias = "output")]
    out: Option<PathBuf>,
    /// Print the numbers as JSON, and draw nothing.
    #[arg(long)]
    json: bool,
}

/// A finite number.
fn finite(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err("expected a finite number, such as `45`".to_owned()),
    }
}

/// A friction and what to call it.
struct Named {
    title: String,
    file: String,
    friction: Friction,
}

/// Draws and prints every friction.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let (frictions, folder) = match (&arguments.deck, &arguments.constants.0) {
        (Some(path), _) => {
            let folder = Path::new("results").join(case_name(path));
            let read = deck::read_with(path, &arguments.settings.set)?;
            (of_model(&read.model), folder)
        }
        (None, Some((law, constants))) => {
            let friction = constants::friction(law, constants)?;
            let named = Named {
                title: "constants".to_owned(),
                file: (*law).to_owned(),
                friction,
            };
            (vec![named], Path::new("results").join("law"))
        }
        (None, None) => (Vec::new(), PathBuf::new()),
    };
    let folder = arguments.out.clone().unwrap_or(folder);
    if frictions.is_empty() {
        writeln!(out, "the deck has no pair, so it has no friction")?;
        return Ok(());
    }
    if arguments.json {
        let all = frictions.iter();
        let all =
            all.map(|named| json::of_friction(&named.title, &named.friction, &arguments.theta));
        writeln!(out, "{:#}", serde_json::Value::from_iter(all))?;
        return Ok(());
    }
    make_folder(&folder)?;
    for named in &frictions {
        show(named, &arguments.theta, &folder, out)?;
    }
    Ok(())
}

/// Makes a folder for figures.
pub fn make_folder(folder: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).map_err(|cause| Failure::Unwritable {
        path: folder.to_owned(),
        cause,
    })
}

/// The frictions of a model.
fn of_model(model: &Model) -> Vec<Named> {
    let named = frictions(model).map(|named| Named {
        title: named.title,
        file: format!("law-{}", named.file),
        friction: named.friction.clone(),
    });
    named.collect()
}

fn show(named: &Named, theta: &[f64], folder: &Path, out: &mut dyn Write) -> Result<(), Failure> {
    let friction = &named.friction;
    write!(out, "{}: {}", named.title, friction.law().name())?;
    if matches!(friction.law(), Law::Frictionless) {
        return Ok(writeln!(out)?);
    }
    writeln!(out, ", {}", coefficient(friction))?;
    let analyses = analysed(friction, theta);
    write!(out, "{}", table(friction, &analyses))?;
    writeln!(out, "{}", verdict(&analyses))?;
    let figures = [
        (named.file.clone(), Some(figure(friction, &analyses))),
        (format!("{}-coefficient", named.file), dependence(friction)),
    ];
    for (name, figure) in figures {
        let Some(figure) = figure else { continue };
        figure.write(folder, &name)?;
        let file = folder.join(&name);
        writeln!(out, "wrote {}.svg, .png and .csv", file.display())?;
    }
    Ok(())
}

/// Slip surfaces at all angles between the textures that matter to a friction.
fn analysed(friction: &Friction, theta: &[f64]) -> Vec<Analysis> {
    let theta = match friction.required_textures() {
        RequiredTextures::Both => theta,
        RequiredTextures::Any | RequiredTextures::One => &[0.0],
    };
    let analyses = theta.iter();
    analyses
        .map(|theta| Analysis::new(friction, theta.to_radians(), SAMPLES))
        .collect()
}

/// Axes and extremes of the slip surfaces, a row an angle.
fn table(friction: &Friction, analyses: &[Analysis]) -> String {
    let two = friction.required_textures() == RequiredTextures::Both;
    let mut text = String::from(
        "  theta [deg]       A         P         h   max |w|  max angle(d, -tau) [deg]  least w . d\n",
    );
    for analysis in analyses {
        let theta = if two {
            degrees(analysis.theta).to_string()
        } else {
            "any".to_owned()
        };
        let axes = match &analysis.surface {
            SlipSurface::Ellipse(ellipse) => {
                [ellipse.across, ellipse.along, ellipse.offset].map(|length| format!("{length:.4}"))
            }
            SlipSurface::Star(_) | SlipSurface::Oblique(_) => [(); 3].map(|()| "-".to_owned()),
        };
        let [across, along, offset] = axes;
        text += &format!(
            "  {theta:>11}  {across:>8}  {along:>8}  {offset:>8}  {:8.4}  {:24.3}  {:11.4}\n",
            analysis.extremes.traction,
            analysis.extremes.deviation.to_degrees(),
            analysis.least.dissipation(),
        );
    }
    text
}

/// Verdict on dissipation, with the place where it is least.
fn verdict(analyses: &[Analysis]) -> String {
    let Some(first) = analyses.first() else {
        return String::new();
    };
    match &first.least_over_textures {
        Some(least) => format!(
            "  admissible: -tau . d / varpi is at least {:.6} over all textures and slips (at I0 = {:.6}, I1 = {:.6})",
            least.value,
            least.i0 + 0.0,
            least.i1 + 0.0
        ),
        None => format!(
            "  admissible: -tau . d / varpi is at least {:.6} over all slips (at {:.3} degrees from e, across the texture)",
            first.least.dissipation(),
            first.least.slip.y.atan2(first.least.slip.x).to_degrees(),
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Program {
        #[command(flatten)]
        arguments: Arguments,
    }

    /// Printed text, or the failure.
    fn said(words: &[&str], folder: &Path) -> Result<String, Failure> {
        let folder = folder.to_string_lossy();
        let words = ["law", "--out", &folder]
            .into_iter()
            .chain(words.iter().copied());
        let mut out = Vec::new();
        run(&Program::parse_from(words).arguments, &mut out)?;
        Ok(String::from_utf8(out).unwrap())
    }

    #[test]
    fn constants_give_figures_extremes_and_a_verdict() {
        let scratch = tempfile::tempdir().unwrap();
        let constants = "mu=0.3,c_mag=0.1,c_ang=0.1,c_cen=0.5";
        let text = said(&["--two-textures", constants], scratch.path()).unwrap();
        let row = |theta: &str| -> Vec<f64> {
            let line = text.lines().find(|line| line.trim().starts_with(theta));
            let words = line.unwrap().split_whitespace();
            words.map(|word| word.parse().unwrap()).collect()
        };
        assert_eq!(row("0 ")[1..5], [1.1, 1.9, 0.2, 2.1], "{text}");
        assert_eq!(row("180 ")[1..6], [0.9, 0.9, 0.0, 0.9, 0.0], "{text}");
        assert!(
            text.contains("admissible: -tau . d / varpi is at least 0.9"),
            "{text}"
        );
        for ending in ["svg", "png", "csv"] {
            let file = scratch.path().join(format!("two-textures.{ending}"));
            assert!(file.metadata().unwrap().len() > 1000);
        }
    }

    #[test]
    fn all_laws_can_be_given_as_constants() {
        let scratch = tempfile::tempdir().unwrap();
        for (law, constants, row) in [
            (
                "--coulomb",
                "mu=0.3,shear_cap=7",
                "any    1.0000    1.0000    0.0000    1.0000",
            ),
            (
                "--orthotropic",
                "mu_along=0.2, mu_across=0.4, slip_rule=associated",
                "any    0.5000    1.0000    0.0000    1.0000",
            ),
            (
                "--nap",
                "mu_forward=0.2,mu_backward=0.4,mu_lateral=0.3",
                "any    0.7500    0.7500    0.2500    1.0000",
            ),
            (
                "--tabulated",
                "angles=[0, 120, 240],mu=[0.2,0.4,0.1],shear_cap=7",
                "any         -         -         -    1.0000                     0.000       0.2500",
            ),
        ] {
            let text = said(&[law, constants], scratch.path()).unwrap();
            assert!(text.contains(row), "{text}");
        }
    }

    #[test]
    fn dependences_on_pressure_and_slip_rate_are_told_and_drawn() {
        let scratch = tempfile::tempdir().unwrap();
        let constants = r#"mu=0.3,by_pressure={form="power-law",exponent=0.5,pressure=4},by_slip_rate={form="stribeck",kinetic_over_static=0.6,slip_rate=2,viscous=0.1},by_accumulated_slip={form="exponential",final_over_initial=1.4,slip=3}"#;
        let text = said(&["--coulomb", constants], scratch.path()).unwrap();
        for line in [
            "coulomb, mu = 0.3, varpi = mu R(v) W(s) P(p)\n",
            "  pressure: P(p) = 4 (p/4)^0.5, a parabola below p = 0.004\n",
            "  accumulated slip: W(s) = 1.4 + (1 - 1.4) exp(-s/3)\n",
            "  slip rate: R(v) = 0.6 + (1 - 0.6) exp(-(v/2)^2) + 0.1 v\n",
        ] {
            assert!(text.contains(line), "{text}");
        }
        let drawn = scratch.path().join("coulomb-coefficient.csv");
        assert!(drawn.metadata().unwrap().len() > 1000);
        let json = said(&["--coulomb", constants, "--json"], scratch.path()).unwrap();
        let json: serde_json::Value = serde_json::from_str(&json).unwrap();
        assert_eq!(
            json[0]["by_pressure"],
            "4 (p/4)^0.5, a parabola below p = 0.004"
        );
    }

    #[test]
    fn healing_is_told_and_drawn() {
        let scratch = tempfile::tempdir().unwrap();
        let constants = r#"mu=0.3,by_state={form="static-kinetic",kinetic_over_static=0.6,slip_distance=0.1,healing_time=5}"#;
        let text = said(&["--coulomb", constants], scratch.path()).unwrap();
        for line in [
            "coulomb, mu = 0.3, varpi = mu H p\n",
            "  slip and time: H = 0.6 + (1 - 0.6) psi, d psi/dt = (1 - psi)/5 - psi v/0.1\n",
        ] {
            assert!(text.contains(line), "{text}");
        }
        let drawn = scratch.path().join("coulomb-coefficient.csv");
        assert!(drawn.metadata().unwrap().len() > 1000);
    }

    #[test]
    fn refused_constants_name_where_friction_would_create_energy() {
        let scratch = tempfile::tempdir().unwrap();
        let refused = |law: &str, constants: &str| {
            let failure = said(&[law, constants], scratch.path()).unwrap_err();
            assert!(matches!(failure, Failure::Constants(_)), "exit code 2");
            failure.to_string()
        };
        let text = refused("--two-textures", "mu=0.3,c_mag=0,c_ang=-1,c_cen=0");
        assert!(
            text.contains("I0 = 1.000000 and slip with a_ba . d = I1 = 2.000000"),
            "{text}"
        );
        let text = refused("--nap", "mu_forward=.05,mu_backward=.6,mu_lateral=.05");
        assert!(text.contains("degrees from the texture"), "{text}");
        let text = refused("--two-textures", "mu=0.3,c_mag=0,c_ang=0,c_cne=0");
        assert!(text.contains("did you mean `c_cen`"), "{text}");
        let text = refused("--tabulated", "angles=[0,90,360],mu=[0.1,0.2,0.1]");
        assert!(text.contains("must span less than a turn"), "{text}");
        let text = refused("--orthotropic", "mu_along=0.2");
        assert_eq!(
            text,
            "--orthotropic: `mu_across` is missing; add `mu_across=VALUE`, a number greater than 0"
        );
        let text = refused("--orthotropic", "mu_along=nan,mu_across=1");
        assert!(
            text.starts_with("--orthotropic: `mu_along` must be"),
            "{text}"
        );
        let text = refused("--coulomb", "mu=much");
        assert!(text.contains("must be a number of at least 0"), "{text}");
        assert_eq!(scratch.path().read_dir().unwrap().count(), 0);
    }

    #[test]
    fn every_friction_of_a_deck_is_shown() {
        let scratch = tempfile::tempdir().unwrap();
        let deck = scratch.path().join("deck.toml");
        std::fs::write(&deck, include_str!("new/blocks.toml")).unwrap();
        let text = said(&[&deck.to_string_lossy()], &scratch.path().join("figures")).unwrap();
        assert!(
            text.contains("pair `lower-upper`: coulomb, mu = 0.3"),
            "{text}"
        );
        assert!(scratch.path().join("figures/law-lower-upper.csv").exists());
    }
}
