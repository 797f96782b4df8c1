//! Output of a run, on one rank or several, and the distance between two outputs.

use std::sync::Arc;

use striae_contact::evaluation::Evaluation;
use striae_mesh::Vec3;
use striae_model::{Backend, Model};
use striae_solve::{
    drive::{Continue, Observer, Progress, run, run_in},
    dynamics::momentum,
    newton::{InStep, Increment, IterationObserver, Workspace},
    norms::Norms,
    outcome::CutBack,
    problem::Problem,
    report::{bodies, held_reactions, pairs, reactions, rigid_bodies, ties},
    share::Division,
    state::State,
    team::{Gathered, Team, Together},
    warning::Judgement,
};

/// Largest difference of two numbers, relative to the largest one of their kind.
const CLOSE: f64 = 1e-8;
/// Areas under pressure, which consist of points that have some: round-off decides about points
/// where it vanishes.
const PRESSED: &str = "pressed areas";
/// Difference over the largest number of areas under pressure.
const POINTS: f64 = 1e-3;

/// Output of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Told {
    pub ending: String,
    /// Iterations of every increment, and where it ended.
    pub increments: Vec<(usize, f64)>,
    /// Reasons why increments were cut.
    pub cuts: Vec<String>,
    /// Names of numbers that belong together, and the numbers.
    pub numbers: Vec<(String, Vec<f64>)>,
    pub warnings: Vec<String>,
}

/// Output of a rank, and positions of its nodes by their numbers in the whole.
type OfRank = (Told, Vec<(usize, Vec3)>);

#[derive(Default)]
struct Record {
    increments: Vec<(usize, f64)>,
    cuts: Vec<String>,
    states: Vec<State>,
    in_steps: Vec<InStep>,
    iterations: usize,
}

impl IterationObserver for Record {
    fn iteration(&mut self, _: usize, _: &Norms, _: &[Evaluation]) {
        self.iterations += 1;
    }
}

impl Observer for Record {
    fn step(&mut self, _: usize, _: &str) {}

    fn increment(&mut self, progress: Progress, increment: &Increment) -> Continue {
        self.increments
            .push((increment.iterations.len(), progress.fraction));
        self.states.push(increment.state.clone());
        self.in_steps.push(increment.in_step);
        Continue::Yes
    }

    fn cut_back(&mut self, _: Progress, reason: &CutBack) -> Continue {
        self.cuts.push(reason.to_string());
        Continue::Yes
    }
}

/// Output of a model on one rank, with a solver that does not correct contact either, so that all
/// iterations are those of Newton's method.
pub fn alone(model: &Model) -> OfRank {
    let mut model = model.clone();
    model.solver.backend = Backend::Multifrontal;
    let problem = Problem::new(model).unwrap();
    told(&problem, None)
}

/// Output of a model on several ranks.
pub fn together(model: &Model, ranks: usize) -> Vec<OfRank> {
    let division = Division::new(model, ranks).unwrap();
    Together::run(ranks, |team| {
        let problem = Problem::shared(model.clone(), &division, Arc::clone(&team)).unwrap();
        told(&problem, Some(team))
    })
}

fn told(problem: &Problem, team: Option<Arc<dyn Team>>) -> OfRank {
    let mut record = Record::default();
    let start = State::undeformed(problem);
    let (end, ending) = match team {
        None => run(problem, start.clone(), &mut record),
        Some(team) => {
            let workspace = Workspace::with(Box::new(Gathered::new(team)));
            run_in(workspace, problem, (0, 0), start.clone(), &mut record)
        }
    };
    let mut judgement = Judgement::default();
    let mut before = &start;
    for (state, in_step) in record.states.iter().zip(&record.in_steps) {
        judgement.increment(problem, before, state, *in_step);
        before = state;
    }
    let warnings = judgement.warnings(problem, &ending);
    let nodes = problem.own_nodes().map(|node| {
        let whole = problem.share.whole_node(node);
        (whole.0, end.positions[node])
    });
    let told = Told {
        ending: ending.to_string(),
        increments: record.increments,
        cuts: record.cuts,
        numbers: numbers(problem, &end),
        warnings: warnings.iter().map(|w| w.kind.name().to_owned()).collect(),
    };
    (told, nodes.collect())
}

/// All that reports say of a state.
fn numbers(problem: &Problem, state: &State) -> Vec<(String, Vec<f64>)> {
    let mut all = Vec::new();
    let mut add = |name: &str, values: Vec<f64>| all.push((name.to_owned(), values));
    let flat = |vectors: &[Vec3]| vectors.iter().flat_map(|v| v.iter().copied()).collect();
    for pair in pairs(problem, state) {
        let forces = pair.sides.map(|side| side.force);
        add("forces", flat(&forces));
        add("moments", flat(&pair.sides.map(|side| side.moment)));
        add("areas", pair.sides.map(|side| side.area).to_vec());
        add(PRESSED, pair.sides.map(|side| side.pressed).to_vec());
        let [stick, slip, open] = [pair.stick, pair.slip, pair.open];
        add("statuses", vec![stick as f64, slip as f64, open as f64]);
        add("pressure", vec![pair.max_pressure]);
    }
    for pair in &state.pairs {
        add("worn", pair.worn.to_vec());
    }
    let all_reactions = reactions(problem, state);
    add(
        "reactions",
        flat(&all_reactions.iter().map(|r| r.1).collect::<Vec<_>>()),
    );
    let held = held_reactions(problem, state).into_iter();
    add(
        "held reactions",
        flat(&held.map(|r| r.1).collect::<Vec<_>>()),
    );
    for body in bodies(problem, state) {
        add("centres", flat(&[body.centre]));
        add("velocities", flat(&[body.velocity]));
    }
    for rigid in rigid_bodies(problem, state) {
        add("poses", flat(&[rigid.displacement, rigid.angles]));
        add("torques", flat(&[rigid.torque]));
    }
    for tie in ties(problem, state) {
        add("ties", flat(&tie.sides.map(|side| side.force)));
    }
    let (linear, angular) = momentum(problem, state);
    add("momentum", flat(&[linear]));
    add("angular momentum", flat(&[angular]));
    let e = &state.energies;
    let lost = [
        e.inelastic,
        e.friction,
        e.contact,
        e.stabilisation,
        e.numerical,
    ];
    add(
        "energies",
        [vec![e.kinetic, e.strain, e.external], lost.to_vec()].concat(),
    );
    all
}

/// Asserts that the output of a model on two, three and four ranks is that on one.
pub fn assert_same(model: &Model) -> Told {
    let (expected, positions) = alone(model);
    for ranks in 2..=4 {
        let found = together(model, ranks);
        for (told, _) in &found {
            assert_eq!(told, &found[0].0, "all of {ranks} ranks tell the same");
        }
        assert_near(&expected, &found[0].0, ranks);
        let mut nodes: Vec<(usize, Vec3)> = found.into_iter().flat_map(|(_, x)| x).collect();
        nodes.sort_by_key(|(node, _)| *node);
        assert_eq!(nodes.len(), positions.len(), "each node is owned once");
        let size = positions.iter().map(|(_, x)| x.norm()).fold(0.0, f64::max);
        for ((node, x), (same, y)) in nodes.iter().zip(&positions) {
            assert_eq!(node, same);
            let away = (x - y).norm();
            assert!(
                away < CLOSE * size,
                "node {node} is {away:.1e} away on {ranks} ranks"
            );
        }
    }
    expected
}

fn assert_near(expected: &Told, found: &Told, ranks: usize) {
    let on = format!("on {ranks} ranks");
    assert_eq!(expected.ending, found.ending, "{on}");
    assert_eq!(expected.warnings, found.warnings, "{on}");
    // The last digits of what an element comes to in a failed iteration may differ.
    let reasons = |told: &Told| -> Vec<String> {
        let cuts = told.cuts.iter().map(|cut| cut.split("= ").next());
        cuts.map(|words| words.unwrap_or_default().to_owned())
            .collect()
    };
    assert_eq!(reasons(expected), reasons(found), "{on}");
    assert_eq!(expected.increments.len(), found.increments.len(), "{on}");
    for ((count, end), (other, other_end)) in expected.increments.iter().zip(&found.increments) {
        assert_eq!(end, other_end, "{on}");
        assert!(
            count.abs_diff(*other) <= 1,
            "{count} and {other} iterations {on}"
        );
    }
    for ((name, values), (same, others)) in expected.numbers.iter().zip(&found.numbers) {
        assert_eq!((name, values.len()), (same, others.len()));
        let of_kind = expected.numbers.iter().filter(|(other, _)| other == name);
        let sizes = of_kind.flat_map(|(_, values)| values).map(|v| v.abs());
        // Energies are sums of what bodies exchange, momenta of what nodes have.
        let size = sizes.fold(1e-3, f64::max);
        let close = if name == PRESSED { POINTS } else { CLOSE };
        for (a, b) in values.iter().zip(others) {
            let is_near = (a - b).abs() <= close * size;
            assert!(is_near, "{name}: {values:?} and {others:?} {on}");
        }
    }
}
