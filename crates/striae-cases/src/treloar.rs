//! `treloar`: the rubber of 1944 in three tests, by four laws.
//!
//! With the stretch `l` the nominal stress of an incompressible solid is
//!
//! ```text
//! uniaxial     stretches (l, l^-1/2, l^-1/2)    invariants: P = 2 (l - l^-2) (W1 + W2/l)
//! planar       (l, 1, l^-1)                                 P = 2 (l - l^-3) (W1 + W2)
//! equibiaxial  (l, l, l^-2)                                 P = 2 (l - l^-5) (W1 + W2 l^2)
//! ```
//!
//! with `Wi = dW/dIi`, and `P = sum mu (l^(a - 1) - l^(e a - 1))` of Ogden's law, `e` = -1/2,
//! -1 and -2. Points of the measurements are compared along the curves.

use nalgebra::{DMatrix, DVector};
use striae_figure::{Axis, Color, Content, Figure, Marker, Panel, Series, Width};

use super::study::{Run, Study};
use crate::failure::Failure;

const DECKS: [(&str, &str); 4] =
    decks!("treloar": "ogden", "mooney-rivlin", "yeoh", "arruda-boyce");

/// Constants of Ogden (1972), in MPa.
const OGDEN: [[f64; 2]; 3] = [[0.63, 1.3], [0.0012, 5.0], [-0.01, -2.0]];
const MOONEY_RIVLIN: [f64; 2] = [0.1713, 0.0047];
const YEOH: [f64; 3] = [0.1830, -0.001_418, 3.935e-5];
/// Modulus, and links of a chain.
const ARRUDA_BOYCE: [f64; 2] = [0.27, 26.5];
/// Coefficients of the powers of `I1` in the series of Arruda and Boyce.
const SERIES: [f64; 5] = [
    1.0 / 2.0,
    1.0 / 20.0,
    11.0 / 1050.0,
    19.0 / 7000.0,
    519.0 / 673_750.0,
];

/// A test with its measurements, stretch and nominal stress in MPa.
struct Test {
    name: &'static str,
    /// Power of the stretch across.
    across: f64,
    measured: &'static [[f64; 2]],
}

const UNIAXIAL: Test = Test {
    name: "uniaxial",
    across: -0.5,
    measured: &[
        [1.01, 0.03],
        [1.12, 0.14],
        [1.24, 0.23],
        [1.39, 0.32],
        [1.61, 0.41],
        [1.89, 0.50],
        [2.17, 0.58],
        [2.42, 0.67],
        [3.01, 0.85],
        [3.58, 1.04],
        [4.03, 1.21],
        [4.76, 1.58],
        [5.36, 1.94],
        [5.76, 2.29],
        [6.16, 2.67],
        [6.40, 3.02],
        [6.62, 3.39],
        [6.87, 3.75],
        [7.05, 4.12],
        [7.16, 4.47],
        [7.27, 4.85],
        [7.43, 5.21],
        [7.50, 5.57],
        [7.61, 6.30],
    ],
};

const EQUIBIAXIAL: Test = Test {
    name: "equibiaxial",
    across: -2.0,
    measured: &[
        [1.04, 0.09],
        [1.08, 0.16],
        [1.12, 0.24],
        [1.14, 0.26],
        [1.20, 0.33],
        [1.31, 0.44],
        [1.42, 0.51],
        [1.69, 0.65],
        [1.94, 0.77],
        [2.49, 0.96],
        [3.03, 1.24],
        [3.43, 1.45],
        [3.75, 1.72],
        [4.03, 1.96],
        [4.26, 2.22],
        [4.44, 2.43],
    ],
};

const PLANAR: Test = Test {
    name: "planar",
    across: -1.0,
    measured: &[
        [1.06, 0.07],
        [1.14, 0.16],
        [1.21, 0.24],
        [1.32, 0.33],
        [1.46, 0.42],
        [1.87, 0.59],
        [2.40, 0.76],
        [2.98, 0.93],
        [3.48, 1.11],
        [3.96, 1.28],
        [4.36, 1.46],
        [4.69, 1.62],
        [4.96, 1.79],
    ],
};

const TESTS: [Test; 3] = [UNIAXIAL, EQUIBIAXIAL, PLANAR];

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let mut curves = Vec::new();
    for (name, text) in DECKS {
        let deck = study.deck(name, text)?;
        let run = study.run(name, deck)?;
        let mut off = 0.0_f64;
        let mut of_law = Vec::new();
        for test in &TESTS {
            let curve = test.curve(&run);
            let largest = curve
                .iter()
                .map(|[l, p]| (p / closed(name, test, *l) - 1.0).abs());
            off = largest.fold(off, f64::max);
            study.measured(format!("{name}.{}.error", test.name), test.error(&curve));
            of_law.push(curve);
        }
        study.measured(format!("{name}.closed"), off);
        curves.push((name, of_law));
    }
    let [modulus] = fitted(&[UNIAXIAL], |test, l| [test.powers(l)[0]])[..] else {
        unreachable!("one constant")
    };
    study.measured("fit.neo-hookean", 2.0 * modulus);
    let mooney = fitted(&[EQUIBIAXIAL], Test::powers);
    study.measured("fit.mooney-rivlin.c10", mooney[0]);
    study.measured("fit.mooney-rivlin.c01", mooney[1]);
    let [sum] = fitted(&[PLANAR], |test, l| [test.powers(l)[0]])[..] else {
        unreachable!("one constant")
    };
    study.measured("fit.mooney-rivlin.planar", sum);
    for (name, value) in ["c10", "c20", "c30"]
        .into_iter()
        .zip(fitted(&TESTS, of_yeoh))
    {
        study.measured(format!("fit.yeoh.{name}"), value);
    }
    study.draw(&figure(&curves), "tests")
}

impl Test {
    /// The last stretch.
    fn last(&self) -> f64 {
        self.measured[self.measured.len() - 1][0]
    }

    /// Stretch and nominal stress of every increment.
    fn curve(&self, run: &Run) -> Vec<[f64; 2]> {
        let forces = run.column(&format!("reaction.{}.xmax.x", self.name));
        let times = run.column("time").into_iter().zip(forces);
        times
            .filter(|(time, _)| *time > 0.0)
            .map(|(time, force)| [1.0 + time * (self.last() - 1.0), force])
            .collect()
    }

    /// Deviation of a curve from the measurements in the mean square, over their own.
    fn error(&self, curve: &[[f64; 2]]) -> f64 {
        let (mut off, mut whole) = (0.0, 0.0);
        for [stretch, stress] in self.measured {
            off += (at(curve, *stretch) - stress).powi(2);
            whole += stress * stress;
        }
        (off / whole).sqrt()
    }

    /// First and second invariant.
    fn invariants(&self, l: f64) -> [f64; 2] {
        let across = l.powf(self.across);
        let third = 1.0 / (l * across);
        let squares = [l, third, across].map(|l| l * l);
        let sum = |terms: [f64; 3]| terms.iter().sum();
        [sum(squares), sum(squares.map(f64::recip))]
    }

    /// Factors of `W1` and `W2`.
    fn powers(&self, l: f64) -> [f64; 2] {
        let first = 2.0 * (l - l.powf(2.0 * self.across - 1.0));
        let second = match self.name {
            "uniaxial" => first / l,
            "equibiaxial" => first * l * l,
            _ => first,
        };
        [first, second]
    }
}

/// Nominal stress of the incompressible law.
fn closed(law: &str, test: &Test, l: f64) -> f64 {
    let [i1, _] = test.invariants(l);
    let [first, second] = test.powers(l);
    match law {
        "ogden" => {
            let term = |[mu, a]: [f64; 2]| mu * (l.powf(a - 1.0) - l.powf(test.across * a - 1.0));
            OGDEN.into_iter().map(term).sum()
        }
        "mooney-rivlin" => first * MOONEY_RIVLIN[0] + second * MOONEY_RIVLIN[1],
        "yeoh" => of_yeoh(test, l).iter().zip(YEOH).map(|(a, c)| a * c).sum(),
        _ => {
            let [mu, links] = ARRUDA_BOYCE;
            let terms = SERIES.into_iter().enumerate();
            let slope = terms.map(|(at, c)| c * (at + 1) as f64 * (i1 / links).powi(at as i32));
            first * mu * slope.sum::<f64>()
        }
    }
}

/// Factors of the constants of Yeoh's law.
fn of_yeoh(test: &Test, l: f64) -> [f64; 3] {
    let strain = test.invariants(l)[0] - 3.0;
    [1.0, 2.0 * strain, 3.0 * strain * strain].map(|slope| slope * test.powers(l)[0])
}

/// Constants by least squares over tests.
fn fitted<const N: usize>(tests: &[Test], terms: impl Fn(&Test, f64) -> [f64; N]) -> Vec<f64> {
    let points: Vec<([f64; N], f64)> = tests
        .iter()
        .flat_map(|test| test.measured.iter().map(|[l, p]| (terms(test, *l), *p)))
        .collect();
    let matrix = DMatrix::from_fn(points.len(), N, |row, column| points[row].0[column]);
    let stress = DVector::from_iterator(points.len(), points.iter().map(|(_, p)| *p));
    let solved = matrix.svd(true, true).solve(&stress, 0.0);
    solved.map_or(vec![f64::NAN; N], |found| found.as_slice().to_vec())
}

/// A curve between two of its points.
fn at(curve: &[[f64; 2]], x: f64) -> f64 {
    let after = curve.iter().position(|point| point[0] >= x - 1e-9);
    let [a, b] = match after {
        Some(0) => [[1.0, 0.0], curve[0]],
        Some(after) => [curve[after - 1], curve[after]],
        None => return f64::NAN,
    };
    a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0])
}

fn figure(curves: &[(&str, Vec<Vec<[f64; 2]>>)]) -> Figure {
    let colors = [Color::Blue, Color::Vermillion, Color::Green, Color::Orange];
    let panels = TESTS.iter().enumerate().map(|(of, test)| {
        let x = Axis::linear("stretch", "").within(1.0, test.last() + 0.1);
        let y = Axis::linear("nominal stress", "MPa");
        let measured = Content::markers(test.measured.to_vec(), Marker::Circle);
        let panel = Panel::new(x, y)
            .titled(test.name)
            .with(Series::new("Treloar", measured).colored(Color::Black));
        curves
            .iter()
            .zip(colors)
            .fold(panel, |panel, ((name, curve), color)| {
                let series = Series::new(name.replace('-', " "), Content::line(curve[of].clone()));
                panel.with(series.colored(color))
            })
    });
    let panels = panels.collect();
    Figure {
        columns: 3,
        ..Figure::new(Width::Page, panels)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_decks_carry_the_constants_and_the_last_stretches() {
        let text = |name: &str| DECKS.iter().find(|deck| deck.0 == name).unwrap().1;
        let has = |name: &str, words: String| assert!(text(name).contains(&words), "{words}");
        for [mu, alpha] in OGDEN {
            has("ogden", format!("mu = {mu}, alpha = {alpha} "));
        }
        has(
            "mooney-rivlin",
            format!("c10 = {}\nc01 = {}", MOONEY_RIVLIN[0], MOONEY_RIVLIN[1]),
        );
        has(
            "yeoh",
            "c10 = 0.1830\nc20 = -0.001418\nc30 = 3.935e-5".to_owned(),
        );
        let locking = ARRUDA_BOYCE[1].sqrt();
        has(
            "arruda-boyce",
            format!("mu = 0.27\nlocking_stretch = {locking}"),
        );
        for (name, _) in DECKS {
            for test in &TESTS {
                let words = format!(
                    "\"{}\", nodes = \"xmax\", x = {:.2} ",
                    test.name,
                    test.last() - 1.0
                );
                has(name, words);
            }
        }
    }

    #[test]
    fn closed_forms_of_invariants_are_slopes_of_the_energy() {
        for test in &TESTS {
            for l in [1.2, 2.0, 4.0] {
                let step = 1e-5;
                let slope = |of: usize| {
                    let [above, below] = [l + step, l - step].map(|l| test.invariants(l)[of]);
                    // Two axes do work in the equibiaxial test.
                    let axes = if test.name == "equibiaxial" { 2.0 } else { 1.0 };
                    (above - below) / (2.0 * step * axes)
                };
                let found = test.powers(l);
                for of in 0..2 {
                    assert!(
                        (found[of] / slope(of) - 1.0).abs() < 1e-8,
                        "{} {l}",
                        test.name
                    );
                }
            }
        }
    }
}
