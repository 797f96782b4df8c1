//! `fault-slider`: a block on a spring that sticks and slips by rate and state.
//!
//! A slider on a spring of the stiffness `k` and a bearing of the viscosity `eta` per area, that is
//! dragged at the rate `V`, has the stretch `y`, slip rate `v` and state `theta` of
//!
//! ```text
//! dy/dt = V - v ,   d theta/dt = 1 - v theta/D
//! k y + eta (V - v) = p (mu + a ln(v/v0) + b ln(v0 theta/D))
//! ```
//!
//! Steady slip is stable for `k` above `(b - a) p/D - eta V/D`: a disturbance `exp(s t)` has
//! `(a p/V + eta) (s^2 + s V/D) + (k - b p/D) s + k V/D = 0`, both of whose roots decay there.

use striae_figure::{Axis, Color, Content, Figure, Panel, Series, Width};

use super::study::{Run, Study};
use crate::failure::Failure;

const DECK: &str = embedded!("fault-slider/slider.toml");
const PRESSURE: f64 = 5e6;
const AREA: f64 = 0.01;
/// Coefficient in steady slip at `RATE`, followed by its direct effect and that of the state.
const MU: f64 = 0.6;
const DIRECT: f64 = 0.01;
const EVOLUTION: f64 = 0.015;
const RATE: f64 = 1e-6;
const DISTANCE: f64 = 1e-5;
const BEARING: f64 = 5e9;
/// Coefficient that the spring carries at the start, and time of the drive.
const START: f64 = 0.59;
const TIME: f64 = 1200.0;
/// Stiffness of the softest spring over `(b - a) p/D`.
const SOFT: f64 = 0.5;

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let coarse = drive(study, "slip-6000", SOFT, 6000)?;
    let fine = drive(study, "slip-12000", SOFT, 12000)?;
    let expected = Cycle::of(&reference(SOFT));
    let [coarse_cycle, cycle] = [&coarse, &fine].map(|run| Cycle::of(&friction(run, SOFT)));
    study.measured("slip.period", cycle.period / expected.period);
    // The error falls with the size of the increments.
    let extrapolated = 2.0 * cycle.period - coarse_cycle.period;
    study.measured("slip.period.extrapolated", extrapolated / expected.period);
    study.measured("slip.fall", cycle.fall / expected.fall);
    study.measured("slip.regular", cycle.difference / cycle.period);
    let below = drive(study, "below", 0.7, 6000)?;
    let cycles = [friction(&below, 0.7), reference(0.7)].map(|series| thirds(&series)[2]);
    study.measured("below.range", cycles[0] / cycles[1]);
    let above = drive(study, "above", 0.9, 6000)?;
    let [_, second, last] = thirds(&friction(&above, 0.9));
    study.measured("above.growth", last / second);
    let creep = drive(study, "creep", 1.5, 600)?;
    let last = creep.at_end_of(2, "pair.fault.resultant_a.x") / (PRESSURE * AREA);
    study.measured("creep.friction", last / MU);
    study.draw(&figure(&fine, &creep), "friction")
}

/// Runs the deck with another stiffness of the spring and number of increments.
fn drive(study: &mut Study, name: &str, share: f64, count: usize) -> Result<Run, Failure> {
    let share = format!("share = {share:?} ");
    let count = format!("increments = {count}");
    let passages = [["share = 0.5 ", &share], ["increments = 6000", &count]];
    let deck = study.variant("slider", DECK, &passages)?;
    study.run(name, deck)
}

/// Times of the drive with the force of the spring over the pressure.
fn friction(run: &Run, share: f64) -> Vec<[f64; 2]> {
    let stretch = run.column("spring.bearing.elongation").into_iter();
    let stiffness = share * (EVOLUTION - DIRECT) / DISTANCE;
    let times = run.column("time").into_iter();
    let rows = times.zip(stretch);
    rows.map(|(time, y)| [time, START + stiffness * y])
        .collect()
}

/// Times with the force of the spring over the pressure of the slider of one degree of freedom, by
/// Runge and Kutta's method of fourth order.
fn reference(share: f64) -> Vec<[f64; 2]> {
    let stiffness = share * (EVOLUTION - DIRECT) * PRESSURE / DISTANCE;
    let slope = |[stretch, state]: [f64; 2]| {
        let rate = rate(stiffness * stretch, state);
        [RATE - rate, 1.0 - rate * state / DISTANCE]
    };
    let mut y = [START * PRESSURE / stiffness, DISTANCE / RATE];
    let mut time = 0.0;
    let mut rows = Vec::new();
    while time < TIME {
        rows.push([time, stiffness * y[0] / PRESSURE]);
        let rate = rate(stiffness * y[0], y[1]);
        let h = (0.02 * DISTANCE / rate).min(0.05);
        let moved = |by: f64, k: [f64; 2]| [y[0] + by * k[0], y[1] + by * k[1]];
        let a = slope(y);
        let b = slope(moved(0.5 * h, a));
        let c = slope(moved(0.5 * h, b));
        let d = slope(moved(h, c));
        y = [0, 1].map(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
        time += h;
    }
    rows
}

/// The slip rate at which friction and bearing carry the stress of the spring, by Newton's method
/// for its logarithm.
fn rate(stress: f64, state: f64) -> f64 {
    let steady = MU + EVOLUTION * (RATE * state / DISTANCE).ln();
    let excess = stress + BEARING * RATE - PRESSURE * steady;
    // From above, where the convex function has no overshoot.
    let mut logarithm = excess / (PRESSURE * DIRECT);
    if excess > BEARING * RATE {
        logarithm = logarithm.min((excess / (BEARING * RATE)).ln());
    }
    for _ in 0..60 {
        let viscous = BEARING * RATE * logarithm.exp();
        let error = PRESSURE * DIRECT * logarithm + viscous - excess;
        logarithm -= error / (PRESSURE * DIRECT + viscous);
    }
    RATE * logarithm.exp()
}

/// A cycle of stick and slip.
struct Cycle {
    period: f64,
    /// Difference to the period before.
    difference: f64,
    /// Highest less lowest friction.
    fall: f64,
}

impl Cycle {
    /// The last cycle of a series, between its falls through the middle.
    fn of(series: &[[f64; 2]]) -> Self {
        let later: Vec<[f64; 2]> = series
            .iter()
            .copied()
            .filter(|row| row[0] > 0.4 * TIME)
            .collect();
        let [low, high] = range(&later);
        let middle = 0.5 * (low + high);
        let falls = later
            .windows(2)
            .filter(|two| two[0][1] > middle && two[1][1] <= middle);
        let falls: Vec<f64> = falls
            .map(|two| {
                let share = (two[0][1] - middle) / (two[0][1] - two[1][1]);
                two[0][0] + share * (two[1][0] - two[0][0])
            })
            .collect();
        let [.., first, second, third] = falls[..] else {
            return Self {
                period: f64::NAN,
                difference: f64::NAN,
                fall: high - low,
            };
        };
        Self {
            period: third - second,
            difference: (third - 2.0 * second + first).abs(),
            fall: high - low,
        }
    }
}

fn range(rows: &[[f64; 2]]) -> [f64; 2] {
    let values = rows.iter().map(|row| row[1]);
    let low = values.clone().fold(f64::INFINITY, f64::min);
    [low, values.fold(f64::NEG_INFINITY, f64::max)]
}

/// Range of each third of the time.
fn thirds(series: &[[f64; 2]]) -> [f64; 3] {
    [0.0, 1.0, 2.0].map(|third| {
        let [from, to] = [third, third + 1.0].map(|third| third * TIME / 3.0);
        let rows = series.iter().copied();
        let rows: Vec<_> = rows.filter(|row| row[0] > from && row[0] <= to).collect();
        let [low, high] = range(&rows);
        high - low
    })
}

fn figure(slip: &Run, creep: &Run) -> Figure {
    let panel = |name: &str, rows: Vec<[f64; 2]>, share: f64| {
        let known = Content::dashed(reference(share));
        Panel::new(
            Axis::linear("time", "s"),
            Axis::linear("spring / pressure", ""),
        )
        .titled(name)
        .with(Series::new("block", Content::line(rows)).colored(Color::Blue))
        .with(Series::new("differential equations", known).colored(Color::Black))
    };
    let panels = vec![
        panel("soft spring", friction(slip, SOFT), SOFT),
        panel("stiff spring", friction(creep, 1.5), 1.5),
    ];
    Figure::new(Width::Page, panels)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steady_slip_is_a_solution_of_the_slider() {
        let rate = rate(MU * PRESSURE, DISTANCE / RATE);
        assert!((rate / RATE - 1.0).abs() < 1e-12, "{rate}");
    }

    #[test]
    fn the_reference_creeps_on_a_stiff_spring_and_cycles_on_a_soft_one() {
        let creep = reference(1.5);
        assert!((creep[creep.len() - 1][1] / MU - 1.0).abs() < 1e-9);
        let cycle = Cycle::of(&reference(SOFT));
        assert!(cycle.difference < 1e-3 * cycle.period);
        // Friction falls by some effects of the state.
        assert!(cycle.fall > 1.5 * EVOLUTION && cycle.fall < 4.0 * EVOLUTION);
    }
}
