//! `bar-impact`: an elastic bar flies against a rigid wall.
//!
//! The wave equation gives the contact stress `rho c v` for the time `2 L/c`, and
//! a rebound with the velocity and the energy of the flight.

use striae_figure::{Axis, Color, Content, Figure, Panel, Series, Width};
use striae_model::{ContactMass, Procedure};

use super::study::{Run, Study};
use crate::failure::Failure;

const DECKS: [(&str, &str); 1] = decks!("bar-impact": "deck");
const SPEED: f64 = 0.01;
const AREA: f64 = 0.0016;
/// Length of the bar and wave speed are 1.
const TOUCH: f64 = 0.1;
const RELEASE: f64 = TOUCH + 2.0;
/// Kinetic energy of the flight.
const ENERGY: f64 = 0.5 * AREA * SPEED * SPEED;
const ELEMENTS: usize = 50;

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let runs = [
        ran(study, "0.8", 0.8, ContactMass::Consistent)?,
        ran(study, "0.5", 0.5, ContactMass::Consistent)?,
        ran(study, "1.0", 1.0, ContactMass::Consistent)?,
        ran(study, "redistributed", 0.8, ContactMass::Redistributed)?,
    ];
    let [run, .., redistributed] = &runs;
    let (mean, scatter) = steady(run);
    study.measured("stress.mean", mean);
    study.measured("stress.scatter", scatter);
    let (mean, scatter) = steady(redistributed);
    study.measured("redistributed.stress.mean", mean);
    study.measured("redistributed.stress.scatter", scatter);
    let stress = stress(run);
    let last = stress.iter().rposition(|[_, stress]| *stress > 0.5 * SPEED);
    study.measured("release.time", last.map_or(f64::NAN, |at| stress[at][0]));
    study.measured("rebound.velocity", run.at_end_of(1, "velocity.bar.z"));
    study.measured(
        "rebound.energy",
        energy(run).last().map_or(f64::NAN, |e| e[1]),
    );
    let imbalance = run.largest("energy.imbalance") / ENERGY;
    study.measured("energy.imbalance", imbalance);
    let chain = trapezoidal_chain();
    let highest = chain.iter().map(|[_, energy]| *energy).fold(0.0, f64::max);
    study.measured("trapezoidal.energy", highest);
    study.draw(&figure(&runs, chain), "impact")
}

/// Mean contact stress while the bar is held back, and its largest deviation, relative.
fn steady(run: &Run) -> (f64, f64) {
    let stress = stress(run);
    let steady = stress
        .iter()
        .filter(|[time, _]| (TOUCH + 0.25..TOUCH + 1.75).contains(time));
    let steady: Vec<f64> = steady.map(|[_, stress]| *stress).collect();
    let mean = steady.iter().sum::<f64>() / steady.len() as f64;
    let deviations = steady.iter().map(|stress| (stress / mean - 1.0).abs());
    (mean, deviations.fold(0.0, f64::max))
}

fn ran(
    study: &mut Study,
    name: &str,
    spectral_radius: f64,
    contact_mass: ContactMass,
) -> Result<Run, Failure> {
    let [(deck, text)] = DECKS;
    let mut deck = study.deck(deck, text)?;
    deck.model.steps[0].procedure = Procedure::Dynamic { spectral_radius };
    deck.model.bodies[0].contact_mass = contact_mass;
    study.run(name, deck)
}

/// Contact stress over time.
fn stress(run: &Run) -> Vec<[f64; 2]> {
    let force = run.column("pair.end.pressure_integral_a");
    let times = run.column("time");
    times
        .iter()
        .zip(force)
        .map(|(t, f)| [*t, f / AREA])
        .collect()
}

/// Kinetic and strain energy over that of the flight.
fn energy(run: &Run) -> Vec<[f64; 2]> {
    let (kinetic, strain) = (run.column("energy.kinetic"), run.column("energy.strain"));
    let sums = kinetic.iter().zip(strain).map(|(k, s)| (k + s) / ENERGY);
    run.column("time")
        .iter()
        .zip(sums)
        .map(|(t, e)| [*t, e])
        .collect()
}

/// Energy over time of the bar as a chain of lumped masses and springs, by the
/// trapezoidal rule with contact averaged as the other forces are: in every
/// increment the end is on the wall or free, whichever has neither penetration
/// nor pull at its end.
fn trapezoidal_chain() -> Vec<[f64; 2]> {
    const COUNT: usize = 300;
    let dt = 3.0 / COUNT as f64;
    let nodes = ELEMENTS + 1;
    let h = 1.0 / ELEMENTS as f64;
    let mass = |node: usize| {
        if node == 0 || node == ELEMENTS {
            0.5 * h
        } else {
            h
        }
    };
    let internal = |u: &[f64]| -> Vec<f64> {
        let mut force = vec![0.0; nodes];
        for element in 0..ELEMENTS {
            let tension = (u[element + 1] - u[element]) / h;
            force[element] -= tension;
            force[element + 1] += tension;
        }
        force
    };
    let (mut u, mut v) = (vec![0.0; nodes], vec![-1.0; nodes]);
    let mut contact = 0.0;
    let gap = TOUCH;
    let mut energies = vec![[0.0, 1.0]];
    for count in 1..=COUNT {
        let f_0 = internal(&u);
        // 4/dt^2 m (u_1 - u_0 - dt v_0) + f_1 + f_0 = c_1 + c_0
        let rhs = |touch: f64| -> Vec<f64> {
            (0..nodes)
                .map(|node| {
                    let c = if node == 0 { contact + touch } else { 0.0 };
                    4.0 / (dt * dt) * mass(node) * (u[node] + dt * v[node]) - f_0[node] + c
                })
                .collect()
        };
        let solve = |rhs: &[f64]| tridiagonal(4.0 / (dt * dt), 1.0 / h, &mass, rhs);
        let free = solve(&rhs(0.0));
        let mut push = vec![0.0; nodes];
        push[0] = 1.0;
        let push = solve(&push);
        let touch = ((-gap - free[0]) / push[0]).max(0.0);
        let next: Vec<f64> = free.iter().zip(&push).map(|(u, p)| u + touch * p).collect();
        for node in 0..nodes {
            v[node] = 2.0 / dt * (next[node] - u[node]) - v[node];
        }
        u = next;
        contact = touch;
        let kinetic: f64 = (0..nodes).map(|n| 0.5 * mass(n) * v[n] * v[n]).sum();
        let strain: f64 = u.windows(2).map(|u| 0.5 * (u[1] - u[0]).powi(2) / h).sum();
        energies.push([count as f64 * dt, 2.0 * (kinetic + strain)]);
    }
    energies
}

/// Solves `(a m + K) u = rhs` for the chain of springs `k`.
fn tridiagonal(a: f64, k: f64, mass: &dyn Fn(usize) -> f64, rhs: &[f64]) -> Vec<f64> {
    let n = rhs.len();
    let ends = |node: usize| if node == 0 || node == n - 1 { 1.0 } else { 2.0 };
    let mut diagonal: Vec<f64> = (0..n).map(|node| a * mass(node) + k * ends(node)).collect();
    let mut u = rhs.to_vec();
    for node in 1..n {
        let factor = -k / diagonal[node - 1];
        diagonal[node] += factor * k;
        u[node] -= factor * u[node - 1];
    }
    u[n - 1] /= diagonal[n - 1];
    for node in (0..n - 1).rev() {
        u[node] = (u[node] + k * u[node + 1]) / diagonal[node];
    }
    u
}

fn figure(runs: &[Run; 4], chain: Vec<[f64; 2]>) -> Figure {
    let [run, soft, hard, redistributed] = runs;
    let time = || Axis::linear("time", "L/c").within(0.0, 3.0);
    let exact = [
        [0.0, 0.0],
        [TOUCH, 0.0],
        [TOUCH, 1.0],
        [RELEASE, 1.0],
        [RELEASE, 0.0],
        [3.0, 0.0],
    ];
    let over = |run: &Run| {
        let points = stress(run).into_iter().map(|[t, s]| [t, s / SPEED]);
        Content::line(points.collect())
    };
    let stresses = Panel::new(
        time(),
        Axis::linear("contact stress", "ρ c v").within(0.0, 2.0),
    )
    .with(Series::new("spectral radius 0.8", over(run)).colored(Color::Blue))
    .with(Series::new("0.5", over(soft)).colored(Color::Green))
    .with(Series::new("0.8, mass redistributed", over(redistributed)).colored(Color::Vermillion))
    .with(Series::new("exact", Content::dashed(exact.to_vec())).colored(Color::Black));
    let energies = Panel::new(time(), Axis::linear("energy", "initial").within(0.9, 1.3))
        .with(Series::new("spectral radius 0.8", Content::line(energy(run))).colored(Color::Blue))
        .with(Series::new("0.5", Content::line(energy(soft))).colored(Color::Green))
        .with(Series::new("1", Content::line(energy(hard))).colored(Color::Purple))
        .with(
            Series::new("trapezoidal, contact averaged", Content::line(chain))
                .colored(Color::Vermillion),
        );
    Figure::new(Width::Page, vec![stresses, energies])
}
