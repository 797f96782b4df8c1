//! `finger-pad`: the pad of a finger is stroked across a nap, forth and back.
//!
//! In full slip friction over the force is the coefficient with the nap in one direction and
//! against it in the other, and the stroke costs `(m_f + m_b) N` a length. With Coulomb's law
//! the loop is symmetric.

use striae_contact::side::Side;
use striae_figure::{Axis, Color, Content, Figure, Panel, Series, Width};
use striae_law::friction::Friction;
use striae_mesh::Vec3;
use striae_solve::state::State;

use super::{
    measure::{facets, law_error, surface_nodes_in},
    study::{Extent, Run, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 1] = decks!("finger-pad": "deck");
/// Size of the elements in the deck and for a quick look.
const SIZES: [&str; 2] = ["element_size = 1,", "element_size = 1.25,"];
/// Part of the deck that the run without fibres omits.
const FIBRES: &str = r#"fibres = [
    { k1 = 0.1, k2 = 10, dispersion = 0.1, direction = { circumferential = { point = [0, 0, 9], direction = [0, 1, 0] } } },
    { k1 = 0.1, k2 = 10, dispersion = 0.1, direction = { circumferential = { point = [0, 0, 9], direction = [1, 0, 0] } } },
]
"#;
/// Way of the strokes from the middle, mm.
const STROKE: f64 = 5.0;
/// Coefficients with and against the nap.
const MU: [f64; 2] = [0.3, 0.6];
/// Direction of the nap's texture, along its rows of hairs; the hairs point along `-x`.
const ROWS: Vec3 = Vec3::new(0.0, 1.0, 0.0);

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let nap = ran(study, "nap", &[], None)?;
    let strokes = [nap.friction(2), nap.friction(3)];
    study.measured("forth", strokes[0]);
    study.measured("back", strokes[1]);
    study.measured(
        "force",
        2.0 * nap.run.at_end_of(1, "pair.touch.resultant_a.z"),
    );
    study.measured("work", nap.work());
    let mut all = vec![nap];
    if study.extent == Extent::Full {
        all.push(ran(study, "coulomb", &[], Some(MU[1]))?);
        all.push(ran(study, "no-fibres", &[[FIBRES, ""]], None)?);
        let [forth, back] = [2, 3].map(|step| all[1].friction(step));
        study.measured("coulomb.asymmetry", (forth + back).abs());
        let force = |at: usize| all[at].run.at_end_of(1, "pair.touch.resultant_a.z");
        study.measured("fibres", force(0) / force(2));
    } else {
        study.left_out.extend(["coulomb.asymmetry", "fibres"]);
    }
    let worst = |of: fn(&Stroked) -> f64| all.iter().map(of).fold(0.0, f64::max);
    study.measured("law", worst(Stroked::law_error));
    study.measured("balance", worst(Stroked::balance));
    study.measured("energy.imbalance", worst(Stroked::imbalance));
    draw(study, &all)
}

/// A finger that was stroked.
struct Stroked {
    run: Run,
}

fn ran(
    study: &mut Study,
    name: &str,
    changes: &[[&str; 2]],
    mu: Option<f64>,
) -> Result<Stroked, Failure> {
    let [(file, text)] = DECKS;
    let mut passages = changes.to_vec();
    if study.extent == Extent::Quick {
        passages.push(SIZES);
    }
    let mut deck = study.variant(file, text, &passages)?;
    if let Some(mu) = mu {
        let pair = &mut deck.model.pairs[0];
        pair.friction = Friction::coulomb(mu).expect("a coefficient of friction");
        pair.textures = [None, None];
    }
    Ok(Stroked {
        run: study.run(name, deck)?,
    })
}

impl Stroked {
    /// Friction along the stroke over the force at the end of a step.
    fn friction(&self, step: usize) -> f64 {
        let of = |axis| {
            let name = format!("pair.touch.resultant_a.{axis}");
            self.run.at_end_of(step, &name)
        };
        of("x") / of("z")
    }

    /// Way of the finger along the stroke, friction and force, by increment.
    fn loop_of_forces(&self) -> Vec<[f64; 3]> {
        let friction = self.run.column("pair.touch.resultant_a.x");
        let force = self.run.column("pair.touch.resultant_a.z");
        let steps = self.run.column("step");
        let times = self.run.column("time");
        let rows = (0..steps.len()).filter(|row| steps[*row] > 1.0);
        rows.map(|row| {
            let way = match steps[row] {
                2.0 => STROKE * (times[row] - 1.0),
                _ => STROKE * (1.0 - 2.0 * (times[row] - 2.0)),
            };
            [way, friction[row], force[row]]
        })
        .collect()
    }

    /// Frictional dissipation over the last quarter of the strokes, divided by coefficient, force
    /// and path.
    fn work(&self) -> f64 {
        let rows = self.loop_of_forces();
        let dissipated = self.run.column("energy.friction");
        let late = rows.len() / 4;
        let first = rows.len() - late;
        let spent = dissipated[dissipated.len() - 1] - dissipated[dissipated.len() - 1 - late];
        let pairs = rows[first - 1..].windows(2);
        let known =
            pairs.map(|pair| MU[0] * 0.5 * (pair[0][2] + pair[1][2]) * (pair[0][0] - pair[1][0]));
        spent / known.sum::<f64>()
    }

    /// Imbalance of the forces that hold the finger and the force of the fabric, relative to the
    /// latter.
    fn balance(&self) -> f64 {
        let sum = ["x", "y", "z"].map(|axis| {
            self.run
                .at_end_of(3, &format!("reaction.finger.all.{axis}"))
                + self
                    .run
                    .at_end_of(3, &format!("pair.touch.resultant_a.{axis}"))
        });
        Vec3::from(sum).norm() / self.run.at_end_of(3, "pair.touch.resultant_a.z")
    }

    /// Largest difference of friction at a node from the law for its slip.
    fn law_error(&self) -> f64 {
        let textured = self.run.finished.problem.model.pairs[0].textures[1].is_some();
        law_error(&self.run, 0, textured.then_some(ROWS))
    }

    fn imbalance(&self) -> f64 {
        self.run.largest("energy.imbalance") / self.run.largest("energy.external")
    }
}

fn draw(study: &mut Study, all: &[Stroked]) -> Result<(), Failure> {
    let nap = &all[0];
    let line = |stroked: &Stroked| {
        let rows = stroked.loop_of_forces().into_iter();
        rows.map(|[way, friction, force]| [way, -friction / force])
            .collect()
    };
    let limits = |y: f64| Content::dashed(vec![[-STROKE, y], [STROKE, y]]);
    let loops = Panel::new(
        Axis::linear("way of the finger", "mm").within(-STROKE, STROKE),
        Axis::linear("friction / force", "").within(-0.8, 0.8),
    )
    .with(Series::new("law", limits(MU[1])).colored(Color::Black))
    .with(Series::new("", limits(-MU[0])).colored(Color::Black));
    let named = [("nap", Color::Blue), ("Coulomb", Color::Grey)];
    let loops = all
        .iter()
        .zip(named)
        .fold(loops, |panel, (one, (name, color))| {
            panel.with(Series::new(name, Content::line(line(one))).colored(color))
        });
    let steps = &nap.run.finished.steps;
    study.draw(&Figure::new(Width::Column, vec![loops]), "strokes")?;
    let patches = vec![
        patch(&nap.run, &steps[1], STROKE).titled("against the nap"),
        patch(&nap.run, &steps[2], -STROKE).titled("with it"),
    ];
    study.draw(&Figure::new(Width::Page, patches), "patch")
}

/// Mean pressure on the facets that touch, seen from above, about the finger.
fn patch(run: &Run, state: &State, way: f64) -> Panel {
    let nodes = surface_nodes_in(run, state, Side::A);
    let (mut polygons, mut values) = (Vec::new(), Vec::new());
    for facet in facets(run, Side::A) {
        let corners = facet[..3].iter().map(|corner| &nodes[*corner]);
        let pressure = corners
            .clone()
            .map(|node| node.result.mean_pressure())
            .sum::<f64>()
            / 3.0;
        if pressure > 0.0 {
            let places = corners.map(|node| [node.position.x - way, node.position.y]);
            polygons.push(places.collect());
            values.push(1e3 * pressure);
        }
    }
    let largest = values.iter().copied().fold(0.0, f64::max);
    let bar = Axis::linear("pressure", "kPa").within(0.0, largest);
    let [x, y] =
        [("x", -5.0), ("y", 0.0)].map(|(label, low)| Axis::linear(label, "mm").within(low, 5.0));
    Panel::plane(x, y).with(Series::new(
        "",
        Content::Facets {
            polygons,
            values,
            bar,
        },
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_deck_has_the_passages_of_the_variants() {
        let [(_, text)] = DECKS;
        for passage in [SIZES[0], FIBRES] {
            assert_eq!(text.matches(passage).count(), 1, "{passage}");
        }
    }
}
