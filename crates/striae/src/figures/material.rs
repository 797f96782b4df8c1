//! Responses of bulk materials in the tests by which they are measured.
//!
//! The nominal stress over the stretch of uniaxial, equibiaxial and planar specimens, as a
//! line where the material is stable in the sense of Drucker and dashed where it is not;
//! see [`striae_law::bulk::Mode`].

use striae_figure::{Axis, Color, Content, Figure, Panel, Series, Width};
use striae_law::bulk::{Material, Mode, TestState};

/// States of a test on each side of the state of rest.
pub const SAMPLES: usize = 200;

/// A test of a material, from the largest compression to the largest tension.
#[derive(Clone, Debug, PartialEq)]
pub struct Test {
    /// The test.
    pub mode: Mode,
    /// Its states, by ascending stretch; fewer than requested if the law ends.
    pub states: Vec<TestState>,
}

impl Test {
    /// All tests of a material between two stretches, `first < 1 < last`.
    pub fn all(material: &Material, first: f64, last: f64) -> Vec<Self> {
        let test = |mode: Mode| {
            let mut states = mode.states(material, first, SAMPLES);
            states.reverse();
            states.pop();
            states.extend(mode.states(material, last, SAMPLES));
            Self { mode, states }
        };
        Mode::ALL.map(test).into()
    }

    /// The stretches around the state of rest between which all states are stable.
    pub fn stable(&self) -> [f64; 2] {
        let unstable = |state: &&TestState| state.stability <= 0.0;
        let (compressed, stretched): (Vec<&TestState>, Vec<&TestState>) =
            self.states.iter().partition(|state| state.stretch < 1.0);
        let first = compressed.iter().copied().rfind(unstable);
        let last = stretched.iter().copied().find(unstable);
        let end = |state: Option<&TestState>| state.map_or(1.0, |state| state.stretch);
        [
            first.map_or(end(self.states.first()), |state| state.stretch),
            last.map_or(end(self.states.last()), |state| state.stretch),
        ]
    }
}

/// Nominal stresses over the stretch, dashed where the material is not stable.
pub fn figure(name: &str, tests: &[Test]) -> Figure {
    const COLORS: [Color; 3] = [Color::Blue, Color::Vermillion, Color::Green];
    let mut panel = Panel::new(
        Axis::linear("stretch", ""),
        Axis::linear("nominal stress", ""),
    );
    for (test, color) in tests.iter().zip(COLORS) {
        let [first, last] = test.stable();
        let points = |from: f64, to: f64| -> Vec<[f64; 2]> {
            let inside = |state: &&TestState| (from..=to).contains(&state.stretch);
            let states = test.states.iter().filter(inside);
            states.map(|state| [state.stretch, state.nominal]).collect()
        };
        let stable = Content::line(points(first, last));
        panel = panel.with(Series::new(test.mode.name(), stable).colored(color));
        for (side, unstable) in [
            ("compression", points(0.0, first)),
            ("tension", points(last, f64::INFINITY)),
        ] {
            if unstable.len() > 1 {
                let name = format!("{}, unstable in {side}", test.mode.name());
                panel = panel.with(Series::new(&name, Content::dashed(unstable)).colored(color));
            }
        }
    }
    Figure::new(Width::Page, vec![panel.titled(name)])
}
