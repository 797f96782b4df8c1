//! `tread-slide`: a tread block that slides at five speeds with friction by pressure and speed.
//!
//! In full slip at the speed `v` friction is the integral of the law over the pressure that there is,
//!
//! ```text
//! T = S(v) int mu p0 (p/p0)^m dA ,  S(v) = c + (1 - c) exp(-v/v_s) + k v .
//! ```

use striae_contact::side::Side;
use striae_figure::{Axis, Color, Content, Figure, Marker, Panel, Series, Width};
use striae_solve::state::State;
use striae_surface::facet::{Shape, area_vector};

use super::{
    measure::{facets, surface_nodes_in},
    study::{Extent, Run, Study},
};
use crate::failure::Failure;

const DECK: &str = embedded!("tread-slide/patch.toml");
/// Coefficient at `LOAD` and rest, and exponent of the pressure.
const MU: f64 = 0.5;
const LOAD: f64 = 0.3;
const EXPONENT: f64 = 0.8;
/// Speeds of the steps after the first, mm/s.
const SPEEDS: [f64; 5] = [1.0, 10.0, 100.0, 1e3, 1e4];

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let slides = Slides::of(study, 10)?;
    study.measured("speeds.worst", slides.worst());
    let light = Slides::deep(study, 10, 0.2)?;
    study.measured("light.worst", light.worst());
    // Half of the pressure everywhere, but for large strains.
    let [heavy, light] = [&slides, &light].map(|slides| slides.ratio(3));
    let expected = 2f64.powf(1.0 - EXPONENT);
    study.measured("light.over_heavy", light / heavy / expected);
    let [slow, fast] = [0, 3].map(|at| slides.ratio(at) / slides.mean_law(at));
    study.measured(
        "stribeck.fall",
        fast / slow * (stribeck(SPEEDS[0]) / stribeck(SPEEDS[3])),
    );
    if study.extent == Extent::Quick {
        study.left_out.push("finer.worst");
    } else {
        let finer = Slides::of(study, 20)?;
        study.measured("finer.worst", finer.worst());
    }
    study.draw(&figure(&slides), "stribeck")
}

/// Coefficients at a speed over those at rest.
fn stribeck(speed: f64) -> f64 {
    0.4 + 0.6 * (-speed / 200.0).exp() + 5e-5 * speed
}

/// A run with the ends of its slides.
struct Slides {
    run: Run,
}

impl Slides {
    fn of(study: &mut Study, cells: usize) -> Result<Self, Failure> {
        Self::deep(study, cells, 0.4)
    }

    /// Runs the deck with elements along an edge, and the depth by which the block is pressed.
    fn deep(study: &mut Study, cells: usize, depth: f64) -> Result<Self, Failure> {
        let passages = [
            ["cells = 10 ", &format!("cells = {cells} ")],
            ["depth = 0.4 ", &format!("depth = {depth} ")],
        ];
        let deck = study.variant("patch", DECK, &passages)?;
        let run = study.run(&format!("patch-{cells}-{depth}"), deck)?;
        Ok(Self { run })
    }

    /// Friction over normal force at the end of a slide.
    fn ratio(&self, slide: usize) -> f64 {
        let [friction, normal] = ["x", "z"].map(|axis| {
            let column = format!("pair.patch.resultant_a.{axis}");
            self.run.at_end_of(slide + 2, &column)
        });
        -friction / normal
    }

    /// The integral of the law over the pressure at the end of a slide, over that of the pressure.
    fn law(&self, slide: usize) -> f64 {
        stribeck(SPEEDS[slide]) * self.mean_law(slide)
    }

    /// The integral without the factor of the speed.
    fn mean_law(&self, slide: usize) -> f64 {
        let friction = |p: f64| MU * LOAD * (p / LOAD).powf(EXPONENT);
        self.run
            .finished
            .steps
            .get(slide + 1)
            .map_or(f64::NAN, |state| {
                integral(&self.run, state, friction) / integral(&self.run, state, |p| p)
            })
    }

    /// Largest relative difference of friction from the integral.
    fn worst(&self) -> f64 {
        let slides = 0..SPEEDS.len();
        let errors = slides.map(|slide| (self.ratio(slide) / self.law(slide) - 1.0).abs());
        errors.fold(0.0, f64::max)
    }
}

/// Integral of a function of the pressure over the facets of the block.
fn integral(run: &Run, state: &State, of: impl Fn(f64) -> f64) -> f64 {
    const PARTS: usize = 8;
    let nodes = surface_nodes_in(run, state, Side::A);
    let mut sum = 0.0;
    for facet in facets(run, Side::A) {
        let corners = facet.map(|corner| &nodes[corner]);
        let positions = corners.map(|node| node.position);
        for part in 0..PARTS * PARTS {
            let [xi, eta] =
                [part / PARTS, part % PARTS].map(|at| (2 * at + 1) as f64 / PARTS as f64 - 1.0);
            let weights = Shape::Quadrilateral.weights(xi, eta);
            let terms = corners.iter().zip(weights.value);
            let pressure: f64 = terms.map(|(node, w)| w * node.result.pressure).sum();
            if pressure > 0.0 {
                sum += of(pressure) * area_vector(&weights, &positions).norm();
            }
        }
    }
    sum
}

fn figure(slides: &Slides) -> Figure {
    let found = (0..SPEEDS.len()).map(|at| [SPEEDS[at], slides.ratio(at)]);
    let expected = (0..SPEEDS.len()).map(|at| [SPEEDS[at], slides.law(at)]);
    let curve = (0..=80).map(|at| {
        let speed = 10f64.powf(f64::from(at) / 20.0);
        [speed, MU * stribeck(speed)]
    });
    let panel = Panel::new(
        Axis::logarithmic("speed", "mm/s"),
        Axis::linear("friction / load", ""),
    )
    .with(Series::new("law at 0.3 MPa", Content::dashed(curve.collect())).colored(Color::Black))
    .with(
        Series::new(
            "law over the pressure",
            Content::markers(expected.collect(), Marker::Cross),
        )
        .colored(Color::Black),
    )
    .with(
        Series::new("block", Content::markers(found.collect(), Marker::Circle))
            .colored(Color::Blue),
    );
    Figure::new(Width::Column, vec![panel])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn friction_falls_and_rises_over_the_speeds() {
        let factors = SPEEDS.map(stribeck);
        assert!((factors[0] - 0.997).abs() < 1e-3);
        assert!(factors[3] < 0.5 * factors[0] && factors[4] > 1.9 * factors[3]);
    }
}
