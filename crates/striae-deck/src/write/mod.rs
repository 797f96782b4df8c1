//! Models as decks: text that reads back to an equal model.
//!
//! Everything a model says is written, nothing is left to defaults that may change, and
//! numbers have as many digits as they need to be the same again. Meshes stand in the text by
//! positions, cells and numbers of members of sets: how they were generated or where they
//! were read is no part of a model. Gaps that were closed are closed in these meshes.
//!
//! If a deck states a quantity in other terms than a model (degrees for radians, a normal of any
//! length, coefficients for their shares in the largest), the number that is written is the one
//! that gives the same bits when it is read, see `value`.

mod actuation;
mod cavity;
pub(crate) mod law;
mod mesh;
mod output;
mod pair;
mod rigid;
mod spring;
mod step;
pub(crate) mod value;

use std::fmt;

use mesh::Meshes;
use striae_model::{Backend, Clock, Course, Curve, Model, Solver, Strategy};
use striae_output::Output;
use value::{number, text};

/// Parts of a model that a deck cannot state.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct Unstated {
    /// Parts of the model and why a deck cannot state them.
    pub parts: Vec<(String, &'static str)>,
}

impl fmt::Display for Unstated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, (part, reason)) in self.parts.iter().enumerate() {
            let end = if number == 0 { "" } else { "\n" };
            write!(f, "{end}{part}: {reason}")?;
        }
        Ok(())
    }
}

/// The text of a deck.
///
/// # Errors
/// Everything that the model states and a deck cannot: user-defined laws, textures at chosen nodes,
/// motions of single coordinates of rigid bodies.
pub fn write(model: &Model, output: &Output) -> Result<String, Unstated> {
    let mut writer = Writer {
        model,
        meshes: Meshes::new(model),
        curves: Vec::new(),
        unstated: Vec::new(),
    };
    let steps: String = (0..model.steps.len()).map(|at| writer.step(at)).collect();
    let pairs: String = (0..model.pairs.len()).map(|at| writer.pair(at)).collect();
    let ties: String = (0..model.ties.len()).map(|at| writer.tie(at)).collect();
    let springs = 0..model.springs.len();
    let springs: String = springs.map(|at| writer.spring(at)).collect();
    let cavities = 0..model.cavities.len();
    let cavities: String = cavities.map(|at| writer.cavity(at)).collect();
    let rigid = 0..model.rigid_surfaces.len();
    let rigid: String = rigid.map(|at| writer.rigid(at)).collect();
    let bodies: String = (0..model.bodies.len()).map(|at| writer.body(at)).collect();
    if !writer.unstated.is_empty() {
        let parts = writer.unstated;
        return Err(Unstated { parts });
    }
    let title = format!("title = {}\n", text(&model.title));
    let (output, solver) = (output::output(output), solver(&model.solver));
    let joints = pairs + &ties + &springs + &cavities;
    Ok(title + &output + &solver + &bodies + &rigid + &joints + &writer.curves() + &steps)
}

/// A model on its way to text.
struct Writer<'m> {
    model: &'m Model,
    meshes: Meshes<'m>,
    /// Curves that are not built in, by number.
    curves: Vec<&'m Curve>,
    unstated: Vec<(String, &'static str)>,
}

impl<'m> Writer<'m> {
    /// Notes what cannot be stated.
    fn refuse(&mut self, part: impl Into<String>, reason: &'static str) {
        self.unstated.push((part.into(), reason));
    }

    /// `, curve = ...`, nothing for the ramp.
    fn curve(&mut self, curve: &'m Curve) -> String {
        let name = match curve {
            Curve::Ramp => return String::new(),
            Curve::Constant => "constant".to_owned(),
            Curve::Smooth => "smooth".to_owned(),
            Curve::Table(_) | Curve::History(_) => {
                let known = self.curves.iter().position(|known| *known == curve);
                let at = known.unwrap_or_else(|| {
                    self.curves.push(curve);
                    self.curves.len() - 1
                });
                curve_name(at)
            }
        };
        format!(", curve = {}", text(&name))
    }

    fn curves(&self) -> String {
        let curve = |(at, curve): (usize, &&Curve)| {
            let name = text(&curve_name(at));
            format!("\n[[curve]]\nname = {name}\n{}", course(curve))
        };
        self.curves.iter().enumerate().map(curve).collect()
    }
}

/// The keys of a curve that is not built in.
fn course(curve: &Curve) -> String {
    let listed = |points: &[(f64, f64)]| {
        let pairs = points.iter();
        value::list(pairs.map(|(s, c)| value::list([*s, *c].map(number))))
    };
    let history = match curve {
        Curve::Ramp | Curve::Constant | Curve::Smooth => return String::new(),
        Curve::Table(points) => return format!("points = {}\n", listed(points)),
        Curve::History(history) => history,
    };
    let time = match history.clock {
        Clock::Step => "step",
        Clock::Run => "run",
    };
    let course = match &history.course {
        Course::Table(points) => format!("points = {}\n", listed(points)),
        Course::Periodic { points, period } => {
            format!(
                "points = {}\nperiod = {}\n",
                listed(points),
                number(*period)
            )
        }
        Course::Function(function) => format!("function = {}\n", text(function.text())),
    };
    format!("{course}time = \"{time}\"\n")
}

fn curve_name(at: usize) -> String {
    format!("curve-{}", at + 1)
}

fn solver(solver: &Solver) -> String {
    let backend = match solver.backend {
        Backend::Condensed => "condensed",
        Backend::Multifrontal => "multifrontal",
        Backend::Faer => "faer",
        Backend::Iterative => "iterative",
        Backend::Mumps => "mumps",
    };
    let strategy = match solver.strategy {
        Strategy::Semismooth => "{ method = \"semismooth\" }".to_owned(),
        Strategy::Table1 { stick_tolerance } => {
            let tolerance = number(stick_tolerance);
            format!("{{ method = \"table-1\", stick_tolerance = {tolerance} }}")
        }
    };
    format!(
        "\n[solver]\nbackend = \"{backend}\"\nstrategy = {strategy}\ntolerance = {}\n\
         largest_iterations = {}\n",
        number(solver.tolerance),
        solver.largest_iterations
    )
}
