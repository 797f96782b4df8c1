//! The row of an increment in a history: resultants, reactions, motions and energies.
//!
//! Pairs whose sides may touch, of contact of everything for example, have columns from the
//! increment on in which they do: among `n` bodies there are some `n^2 / 2` pairs, of which a few
//! `n` touch.

use std::collections::HashSet;

use striae_mesh::Vec3;
use striae_model::{Pair, Procedure};
use striae_solve::{
    drive::Progress,
    dynamics::momentum,
    newton::Increment,
    problem::Problem,
    report::{
        PairReport, TieReport, bodies, cavities, held_reactions, pairs, rigid_bodies, springs, ties,
    },
    resolved::resolved,
    state::State,
};

/// Columns and values of the row of a converged increment, before which `cut_backs`
/// attempts were cut, in a history with the columns `so_far`.
pub fn row(
    problem: &Problem,
    progress: Progress,
    increment: &Increment,
    cut_backs: usize,
    so_far: &[String],
) -> Vec<(String, f64)> {
    let state = &increment.state;
    let head = [
        ("increment", progress.increment as f64),
        ("step", (progress.step + 1) as f64),
        ("time", state.time),
        ("iterations", increment.iterations.len() as f64),
        ("cutbacks", cut_backs as f64),
    ];
    let head = head.map(|(name, value)| (name.to_owned(), value));
    let listed = listed(problem, state, so_far);
    let rest = state_row(problem, state, &listed);
    head.into_iter().chain(rest).collect()
}

/// Returns for each pair whether it has columns in a history that has the columns `so_far`.
pub fn listed(problem: &Problem, state: &State, so_far: &[String]) -> Vec<bool> {
    let so_far: HashSet<&str> = so_far.iter().map(String::as_str).collect();
    let reports = pairs(problem, state);
    let stated = problem.model.pairs.iter().zip(&reports);
    let is_listed = |(pair, report): (&Pair, &PairReport)| {
        let is_known = || so_far.contains(mismatch(&report.name).as_str());
        let touches = report.stick + report.slip > 0 || report.dissipated != 0.0;
        pair.is_expected_to_touch() || touches || is_known()
    };
    stated.map(is_listed).collect()
}

/// Number of a column in the rows before the first one that has it: nothing touched.
pub fn before_touch(row: &[(String, f64)], column: &str) -> f64 {
    let Some(pair) = column.strip_suffix(".open") else {
        return 0.0;
    };
    let of_pair = |(name, _): &&(String, f64)| {
        let count = name.strip_prefix(pair);
        count.is_some_and(|count| [".stick", ".slip", ".open"].contains(&count))
    };
    row.iter().filter(of_pair).map(|(_, count)| count).sum()
}

/// Columns of a row that follow from the state alone, and their values, of pairs that are
/// [`listed`].
pub fn state_row(problem: &Problem, state: &State, listed: &[bool]) -> Vec<(String, f64)> {
    let mut row: Vec<(String, f64)> = Vec::new();
    let mut add = |name: &str, value: f64| row.push((name.to_owned(), value));
    add("energy.kinetic", state.energies.kinetic);
    add("energy.strain", state.energies.strain);
    add("energy.external", state.energies.external);
    add("energy.actuation", state.energies.actuation);
    add("energy.inelastic", state.energies.inelastic);
    add("energy.friction", state.energies.friction);
    add("energy.contact", state.energies.contact);
    add("energy.stabilisation", state.energies.stabilisation);
    add("energy.numerical", state.energies.numerical);
    add("energy.imbalance", state.energies.imbalance());
    if is_dynamic(problem) {
        let (linear, angular) = momentum(problem, state);
        add_vector(&mut row, "momentum", &linear);
        add_vector(&mut row, "angular_momentum", &angular);
    }
    for body in bodies(problem, state) {
        add_vector(&mut row, &format!("centre.{}", body.name), &body.centre);
        add_vector(&mut row, &format!("velocity.{}", body.name), &body.velocity);
    }
    let reports = pairs(problem, state);
    for (pair, report) in reports.iter().enumerate().filter(|(pair, _)| listed[*pair]) {
        add_pair(&mut row, report);
        let name = &report.name;
        if problem.pairs[pair].contact.wears() {
            for (letter, volume) in ["a", "b"].iter().zip(state.pairs[pair].worn) {
                row.push((format!("pair.{name}.worn_volume_{letter}"), volume));
            }
        }
        let sides = resolved(problem, state, pair).into_iter().zip(["a", "b"]);
        for (of_side, letter) in sides.filter_map(|(side, letter)| Some((side?, letter))) {
            row.push((format!("pair.{name}.along_{letter}"), of_side.along));
            row.push((format!("pair.{name}.across_{letter}"), of_side.across));
        }
    }
    for tie in ties(problem, state) {
        add_tie(&mut row, &tie);
    }
    add_parts(&mut row, problem, state);
    for (name, force) in held_reactions(problem, state) {
        add_vector(&mut row, &format!("reaction.{name}"), &force);
    }
    for rigid in rigid_bodies(problem, state) {
        let name = &rigid.name;
        add_vector(&mut row, &format!("torque.{name}"), &rigid.torque);
        add_vector(
            &mut row,
            &format!("displacement.{name}"),
            &rigid.displacement,
        );
        add_vector(&mut row, &format!("angle.{name}"), &rigid.angles);
    }
    row
}

/// Adds springs and cavities.
fn add_parts(row: &mut Vec<(String, f64)>, problem: &Problem, state: &State) {
    for spring in springs(problem, state) {
        let name = format!("spring.{}", spring.name);
        row.push((format!("{name}.tension"), spring.tension));
        row.push((format!("{name}.elongation"), spring.elongation));
        add_vector(row, &format!("{name}.force"), &spring.force);
    }
    for cavity in cavities(problem, state) {
        row.push((format!("cavity.{}.pressure", cavity.name), cavity.pressure));
        row.push((format!("cavity.{}.volume", cavity.name), cavity.volume));
    }
}

/// Returns whether any step has inertia.
fn is_dynamic(problem: &Problem) -> bool {
    let mut steps = problem.model.steps.iter();
    steps.any(|step| step.procedure != Procedure::QuasiStatic)
}

/// Adds the three columns of a vector.
pub(crate) fn add_vector(row: &mut Vec<(String, f64)>, name: &str, vector: &Vec3) {
    for (axis, value) in ["x", "y", "z"].iter().zip(vector.iter()) {
        row.push((format!("{name}.{axis}"), *value));
    }
}

/// A column that every pair with columns has.
fn mismatch(pair: &str) -> String {
    format!("pair.{pair}.mismatch")
}

fn add_pair(row: &mut Vec<(String, f64)>, report: &PairReport) {
    let name = format!("pair.{}", report.name);
    for (side, letter) in report.sides.iter().zip(["a", "b"]) {
        add_vector(row, &format!("{name}.resultant_{letter}"), &side.force);
        row.push((format!("{name}.pressure_integral_{letter}"), side.pressure));
        row.push((format!("{name}.friction_integral_{letter}"), side.friction));
    }
    row.push((mismatch(&report.name), report.mismatch));
    row.push((format!("{name}.moment_mismatch"), report.moment_mismatch));
    row.push((format!("{name}.stick"), report.stick as f64));
    row.push((format!("{name}.slip"), report.slip as f64));
    row.push((format!("{name}.open"), report.open as f64));
    row.push((format!("{name}.max_pressure"), report.max_pressure));
    row.push((format!("{name}.dissipated"), report.dissipated));
    row.push((format!("{name}.area"), report.sides[0].pressed));
    add_vector(row, &format!("{name}.centre"), &report.sides[0].centre);
}

fn add_tie(row: &mut Vec<(String, f64)>, report: &TieReport) {
    let name = format!("tie.{}", report.name);
    for (side, letter) in report.sides.iter().zip(["a", "b"]) {
        add_vector(row, &format!("{name}.force_{letter}"), &side.force);
    }
    row.push((format!("{name}.mismatch"), report.mismatch));
    row.push((format!("{name}.moment_mismatch"), report.moment_mismatch));
}
