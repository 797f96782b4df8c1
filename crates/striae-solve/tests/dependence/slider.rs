//! A spring slider with friction that depends on rate and state, beside closed forms and the
//! ordinary differential equations of one degree of freedom.
//!
//! A stiff plate lies on a plane under one layer of soft elements, whose upper side is pressed down
//! and dragged. Contact holds the plate level, so the layer is in simple shear and the plate slips
//! as a whole: a slider on a spring `k = G/h` per area, whatever the pressure of its nodes.

use striae_law::friction::{Evolution, Friction, RateAndState, StateDependence};
use striae_mesh::ElementId;
use striae_model::{BodySection, Formulation, Model, Procedure, Step};
use striae_solve::{outcome::Ending, report::pairs};

use crate::scene::{Places, Run, block, body, coulomb, increments, model, plane, rubber, step};

const MU: f64 = 0.6;
/// Direct effect and effect of the state.
const EFFECTS: [f64; 2] = [0.01, 0.015];
/// Rate at which the coefficient in steady slip is `MU`.
const RATE: f64 = 1e-6;
/// Shear modulus over thickness of the soft layer.
pub const STIFFNESS: f64 = 5.0;
/// Pressure under which the layer is, nearly.
pub const PRESSURE: f64 = 1e-3;
/// Thickness of the plate and of the layer.
const THICKNESS: [f64; 2] = [0.05, 0.2];

/// Constants with which the spring is `over_critical` times as stiff as the critical one,
/// `(b - a) p/D`.
fn law(evolution: Evolution, over_critical: f64) -> RateAndState {
    let [a, b] = EFFECTS;
    let slip_distance = over_critical * (b - a) * PRESSURE / STIFFNESS;
    RateAndState {
        evolution,
        direct_effect: a,
        evolution_effect: b,
        slip_rate: RATE,
        slip_distance,
        state: slip_distance / RATE,
    }
}

/// Motion of the upper side: rate, time and number of increments.
#[derive(Clone, Copy)]
pub struct Drag(pub f64, pub f64, pub usize);

fn slider(law: RateAndState, drags: &[Drag]) -> Model {
    let state = StateDependence::rate_and_state(law).unwrap();
    slider_with(coulomb(MU).with_state(state), drags)
}

/// The slider with any friction.
pub fn slider_with(friction: Friction, drags: &[Drag]) -> Model {
    let [plate, layer] = THICKNESS;
    let mut mesh = block([0.0; 3], [1.0, 1.0, plate + layer], [1, 1, 2])
        .mesh()
        .unwrap();
    for x in &mut mesh.positions {
        if x.z > 0.0 && x.z < plate + layer {
            x.z = plate;
        }
    }
    let mut block = body("block", mesh, rubber(2.0, 0.0));
    block.sections = vec![BodySection {
        set: "plate".to_owned(),
        elements: vec![ElementId(0)],
        material: rubber(2e3, 0.0),
        formulation: Formulation::Standard,
        density: 0.0,
    }];
    let mut model = model(vec![block]);
    let floor = plane([0.0; 3], [0.0, 0.0, 1.0]);
    model.touch_rigid(("block", "zmin"), floor, friction);
    let depth = PRESSURE * layer / 2.0;
    let to = |x: f64, model: &Model| {
        vec![model.hold("block", "zmax", [Some(x), Some(0.0), Some(-depth)])]
    };
    let mut press = step();
    press.duration = 1e-3;
    press.displacements = to(0.0, &model);
    let mut steps = vec![press];
    let mut place = 0.0;
    for Drag(rate, time, count) in drags {
        place += rate * time;
        let size = 1.0 / *count as f64;
        steps.push(Step {
            duration: *time,
            displacements: to(place, &model),
            increments: increments(size, 0.99 * size),
            ..step()
        });
    }
    model.steps = steps;
    model
}

/// Friction over pressure after every increment but the first, which presses.
pub fn coefficients(run: &Run) -> Vec<f64> {
    assert!(run.cuts.is_empty(), "{:?}", run.cuts);
    let states = run.states[2..].iter();
    let of = |state| {
        let force = pairs(&run.problem, state)[0].sides[0].force;
        -force.x / force.z
    };
    states.map(of).collect()
}

/// Pressure in a run.
pub fn pressure(run: &Run) -> f64 {
    pairs(&run.problem, run.last())[0].sides[0].force.z
}

/// The slider of one degree of freedom: stretch of the spring, slip rate and state.
struct Reference {
    law: RateAndState,
    pressure: f64,
    stretch: f64,
    state: f64,
}

impl Reference {
    fn steady(law: RateAndState, pressure: f64, rate: f64) -> Self {
        Self {
            law,
            pressure,
            stretch: law.steady(MU, rate) * pressure / STIFFNESS,
            state: law.slip_distance / rate,
        }
    }

    fn coefficient(&self) -> f64 {
        STIFFNESS * self.stretch / self.pressure
    }

    /// The rate that friction needs, far above rates of the regularisation.
    fn rate(&self, [stretch, state]: [f64; 2]) -> f64 {
        let law = &self.law;
        let aged = (law.slip_rate * state / law.slip_distance).ln();
        let excess = STIFFNESS * stretch / self.pressure - MU - law.evolution_effect * aged;
        law.slip_rate * (excess / law.direct_effect).exp()
    }

    fn slope(&self, at: [f64; 2], drag: f64) -> [f64; 2] {
        let rate = self.rate(at);
        let omega = rate * at[1] / self.law.slip_distance;
        let state = match self.law.evolution {
            Evolution::Ageing => 1.0 - omega,
            Evolution::Slip => -omega * omega.ln(),
        };
        [drag - rate, state]
    }

    /// Goes on for a time without inertia, by Runge and Kutta's method of fourth order; returns
    /// the largest coefficient.
    fn quasi_static(&mut self, drag: f64, time: f64) -> f64 {
        let (mut left, mut largest) = (time, self.coefficient());
        while left > 0.0 {
            let rate = self.rate([self.stretch, self.state]).max(drag);
            let relaxation = self.law.direct_effect * self.pressure / STIFFNESS;
            let h = (0.02 * relaxation.min(self.law.slip_distance) / rate).min(left);
            let y = [self.stretch, self.state];
            let moved = |by: f64, k: [f64; 2]| [y[0] + by * k[0], y[1] + by * k[1]];
            let a = self.slope(y, drag);
            let b = self.slope(moved(0.5 * h, a), drag);
            let c = self.slope(moved(0.5 * h, b), drag);
            let d = self.slope(moved(h, c), drag);
            let mean = |i: usize| (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]) / 6.0;
            self.stretch += h * mean(0);
            self.state += h * mean(1);
            left -= h;
            largest = largest.max(self.coefficient());
        }
        largest
    }
}

#[test]
fn steps_of_the_rate_lead_to_steady_friction() {
    for evolution in [Evolution::Ageing, Evolution::Slip] {
        let law = law(evolution, 5.0);
        let rates = [RATE, 10.0 * RATE, 0.1 * RATE];
        // The spring is stretched by 24 slip distances first.
        let drags = rates.map(|rate| Drag(rate, 50.0 * law.slip_distance / rate, 50));
        let run = Run::completed(slider(law, &drags));
        assert!((pressure(&run) / PRESSURE - 1.0).abs() < 1e-3);
        let found = coefficients(&run);
        let [a, b] = EFFECTS;
        for (at, rate) in rates.into_iter().enumerate() {
            let expected = MU + (a - b) * (rate / RATE).ln();
            let friction = found[50 * at + 49];
            assert!(
                (friction / expected - 1.0).abs() < 1e-7,
                "{friction} {expected}"
            );
        }
        // Faster slip at once takes more friction, then less.
        assert!(
            found[50..100]
                .iter()
                .all(|friction| *friction < MU + a * 10f64.ln())
        );
        assert!(found[50] > MU);
        let states = run.last().pairs[0].tractions.states.iter().flatten();
        for state in states {
            let steady = law.slip_distance / rates[2];
            assert!((state / steady - 1.0).abs() < 1e-7, "{state} {steady}");
        }
    }
}

#[test]
fn friction_heals_with_the_logarithm_of_the_time_at_rest() {
    let law = law(Evolution::Ageing, 20.0);
    let time = law.slip_distance / RATE;
    let holds = [10.0, 100.0, 1000.0].map(|share: f64| share * time);
    let mut drags = vec![Drag(RATE, 30.0 * time, 60)];
    for hold in holds {
        drags.extend([
            Drag(0.0, hold, 200),
            Drag(RATE, 4.0 * time, 200),
            Drag(RATE, 26.0 * time, 52),
        ]);
    }
    let run = Run::completed(slider(law, &drags));
    let found = coefficients(&run);
    let mut reference = Reference::steady(law, pressure(&run), RATE);
    let mut peaks = Vec::new();
    for (at, hold) in holds.into_iter().enumerate() {
        let first = 60 + 452 * at + 200;
        let peak = found[first..first + 200]
            .iter()
            .copied()
            .fold(0.0, f64::max)
            - MU;
        reference.quasi_static(0.0, hold);
        let expected = reference.quasi_static(RATE, 30.0 * time) - MU;
        assert!(
            (peak / expected - 1.0).abs() < 0.01,
            "{hold}: {peak} {expected}"
        );
        peaks.push(peak);
    }
    let [first, second] = [0, 1].map(|at| peaks[at + 1] - peaks[at]);
    // Equal gains of equal ratios of time, nearly `b ln 10` on a stiff spring.
    assert!((second / first - 1.0).abs() < 0.05, "{first} {second}");
    let whole = EFFECTS[1] * 10f64.ln();
    assert!(second < whole && second > 0.85 * whole, "{second} {whole}");
}

/// Growth of small oscillations over the rate of the state, `D/v`, in increments of a part of
/// this time.
fn growth(over_critical: f64, part: f64) -> f64 {
    let law = law(Evolution::Ageing, over_critical);
    let (rate, count) = (1.002 * RATE, (6.0 / part).round() as usize);
    let [slow, fast] = [RATE, rate].map(|rate| law.slip_distance / rate);
    let drags = [
        // Long increments damp what loading leaves.
        Drag(RATE, 300.0 * slow, 60),
        Drag(rate, part * fast * count as f64, count),
    ];
    let run = Run::completed(slider(law, &drags));
    let steady = law.steady(MU, rate);
    let found = coefficients(&run)[60..]
        .iter()
        .map(|f| f - steady)
        .collect::<Vec<_>>();
    // Two modes: `f_(n+1) = s f_n - q f_(n-1)` with `q` the product of their factors.
    let mut normal = nalgebra::Matrix2::zeros();
    let mut right = nalgebra::Vector2::zeros();
    for three in found.windows(3) {
        let before = nalgebra::Vector2::new(three[1], -three[0]);
        normal += before * before.transpose();
        right += before * three[2];
    }
    let fitted = normal.lu().solve(&right).unwrap();
    0.5 * fitted[1].ln() / part
}

#[test]
fn steady_slip_is_stable_above_the_critical_stiffness() {
    let stiffnesses = [0.9, 1.1];
    let [slow, fast] = stiffnesses.map(|over_critical| {
        let [coarse, fine] = [0.05, 0.025].map(|part| growth(over_critical, part));
        // Increments damp by their size.
        let exact = 2.0 * fine - coarse;
        let [a, b] = EFFECTS;
        let expected = (b - a) * (1.0 - over_critical) / (2.0 * a);
        assert!(
            (exact - expected).abs() < 0.002,
            "{over_critical}: {exact} {expected}"
        );
        exact
    });
    assert!(slow > 0.0 && fast < 0.0);
    let critical = 0.9 + 0.2 * slow / (slow - fast);
    assert!((critical - 1.0).abs() < 0.02, "{critical}");
}

/// Time between the last two falls of a series in equal steps through the middle of its range.
fn period(series: &[f64], step: f64) -> f64 {
    let later = &series[series.len() / 3..];
    let low = later.iter().copied().fold(f64::INFINITY, f64::min);
    let high = later.iter().copied().fold(0.0, f64::max);
    let middle = 0.5 * (low + high);
    let falls = later.windows(2).enumerate();
    let falls: Vec<f64> = falls
        .filter(|(_, two)| two[0] > middle && two[1] <= middle)
        .map(|(at, two)| (at as f64 + (two[0] - middle) / (two[0] - two[1])) * step)
        .collect();
    let last = falls.len() - 1;
    falls[last] - falls[last - 1]
}

/// Period of stick and slip of the slider of one degree of freedom with a mass per area.
fn reference_period(law: RateAndState, pressure: f64, mass: f64, drag: f64, time: f64) -> f64 {
    let mut y = [law.steady(MU, RATE) * pressure / STIFFNESS, RATE, law.state];
    let slope = |[stretch, rate, state]: [f64; 3]| {
        let friction = pressure * law.coefficient(MU, rate.max(0.0), state);
        let pull = STIFFNESS * stretch - friction;
        [
            drag - rate,
            pull / mass,
            1.0 - rate * state / law.slip_distance,
        ]
    };
    let step = 2e-3;
    let (mut now, mut series) = (0.0, vec![y[0]]);
    while now < time {
        let next = now + step;
        while now < next {
            // Friction stiffens the motion at low rates.
            let friction = law.direct_effect * pressure / y[1];
            let h = (0.5 * mass / friction).min(step).min(next - now);
            let moved = |by: f64, k: [f64; 3]| std::array::from_fn(|i| y[i] + by * k[i]);
            let a = slope(y);
            let b = slope(moved(0.5 * h, a));
            let c = slope(moved(0.5 * h, b));
            let d = slope(moved(h, c));
            for i in 0..3 {
                y[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
            }
            now += h;
        }
        series.push(y[0]);
    }
    period(&series, step)
}

/// Period of stick and slip in a number of increments, and the pressure.
fn period_of_slider(law: RateAndState, mass: f64, Drag(drag, time, count): Drag) -> [f64; 2] {
    let rest = Drag(RATE, 300.0 * law.slip_distance / RATE, 60);
    let mut model = slider(law, &[rest, Drag(drag, time, count)]);
    // The layer moves linearly from the plate to its upper side.
    let density = mass / (THICKNESS[0] + THICKNESS[1] / 3.0);
    model.bodies[0].density = density;
    model.bodies[0].sections[0].density = density;
    model.steps[2].procedure = Procedure::Dynamic {
        spectral_radius: 1.0,
    };
    let run = Run::of(model);
    assert_eq!(run.ending, Ending::Completed);
    let model = &run.problem.model;
    let ends = [THICKNESS[0] + THICKNESS[1], 0.0].map(|z| {
        let node = model.node_at("block", [0.0, 0.0, z]);
        run.problem.node(0, node)
    });
    // Before it are the initial state, the increment that presses and those that load.
    let stretches = run.states[62..].iter().map(|state| {
        let [upper, lower] = ends.map(|node| state.positions[node].x);
        upper - lower
    });
    let stretches: Vec<f64> = stretches.collect();
    let pressure = pairs(&run.problem, &run.states[61])[0].sides[0].force.z;
    [period(&stretches, time / count as f64), pressure]
}

#[test]
fn stick_and_slip_has_the_period_of_the_slider_with_its_mass() {
    let law = law(Evolution::Ageing, 0.6);
    let (mass, drag, time) = (0.1, 2.0 * RATE, 32.0);
    let [coarse, fine] = [1600, 3200].map(|count| Drag(drag, time, count));
    let [[coarse, _], [fine, pressure]] =
        [coarse, fine].map(|drag| period_of_slider(law, mass, drag));
    // The error is of first order in the increments.
    let found = 2.0 * fine - coarse;
    let expected = reference_period(law, pressure, mass, drag, time);
    let told = format!("{coarse} {fine} {found}, expected {expected}");
    assert!((found / expected - 1.0).abs() < 0.01, "{told}");
    assert!((fine / expected - 1.0).abs() < 0.02, "{told}");
}
