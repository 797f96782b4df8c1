//! `patch-frictionless`: uniform pressure passes through any overlap.
//!
//! Both blocks are under uniaxial stress, `sigma = -p e_z e_z`, for any law;
//! every deck is run with both orders of the sides of the pair.

use nalgebra::Matrix3;
use striae_contact::side::Side;
use striae_deck::Deck;
use striae_figure::{Axis, Color, Figure, Panel, Series, Width};

use super::{
    measure::{mesh_lines, pressure_map, stress_error, surface_nodes},
    study::{Extent, Run, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 7] = decks!("patch-frictionless":
    "matching",
    "three-to-four-upper-finer",
    "turned-upper-finer",
    "overhang-upper-finer",
    "three-to-four-lower-finer",
    "turned-lower-finer",
    "overhang-lower-finer",
);
const PRESSURE: f64 = 40.0;

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let mut panels = Vec::new();
    let mut worst = [0.0_f64; 2];
    for (name, text) in DECKS {
        let given = study.deck(name, text)?;
        let run = study.run(name, given.clone())?;
        let mut errors = errors(&run);
        if panels.len() < 4 {
            panels.push(panel(&run, name));
        }
        if study.extent == Extent::Full {
            let exchanged = study.run(&format!("{name}-exchanged"), exchanged(given))?;
            let more = self::errors(&exchanged);
            errors = [0, 1].map(|at| errors[at].max(more[at]));
        }
        study.measured(format!("{name}.stress"), errors[0]);
        study.measured(format!("{name}.pressure"), errors[1]);
        worst = [0, 1].map(|at| worst[at].max(errors[at]));
    }
    study.measured("stress", worst[0]);
    study.measured("pressure", worst[1]);
    let figure = Figure {
        width: Width::Page,
        columns: 2,
        panels,
    };
    study.draw(&figure, "overlaps")
}

/// Relative errors of the stress at all Gauss points and of the pressure at
/// all nodes in contact.
fn errors(run: &Run) -> [f64; 2] {
    let mut expected = Matrix3::zeros();
    expected[(2, 2)] = -PRESSURE;
    let nodes = Side::BOTH.map(|side| surface_nodes(run, side));
    let carrying = nodes.iter().flatten().map(|node| node.result.pressure);
    let pressure = carrying
        .filter(|&pressure| pressure != 0.0)
        .map(|pressure| (pressure / PRESSURE - 1.0).abs())
        .reduce(f64::max);
    [stress_error(run, &expected), pressure.unwrap_or(f64::NAN)]
}

/// The deck with the sides of its pair exchanged.
fn exchanged(mut deck: Deck) -> Deck {
    for pair in &mut deck.model.pairs {
        std::mem::swap(&mut pair.a, &mut pair.b);
        pair.textures.swap(0, 1);
    }
    deck
}

fn panel(run: &Run, name: &str) -> Panel {
    let bar = Axis::linear("pressure", "").within(0.0, 50.0);
    let title = name.trim_end_matches("-upper-finer").replace('-', " ");
    Panel::plane(Axis::linear("x", ""), Axis::linear("y", ""))
        .titled(title)
        .with(Series::new("", pressure_map(run, Side::B, 1, bar)))
        .with(mesh_lines(run, Side::A, "lower block", Color::Black))
        .with(mesh_lines(run, Side::B, "upper block", Color::Vermillion))
}
