//! Whole runs with two solvers beside each other, each in its own process.

use crate::{
    clock::{Seconds, words},
    scene, yardstick,
};
use serde_json::{Value, json};
use std::{
    error::Error,
    process::{Command, Stdio},
    time::Instant,
};
use striae_contact::evaluation::Evaluation;
use striae_model::Backend;
use striae_output::summary::peak_rss_mib;
use striae_solve::{
    drive::{Continue, Observer, Progress, run},
    newton::{Increment, IterationObserver, LinearWork},
    norms::Norms,
    outcome::{CutBack, Ending},
    problem::Problem,
    state::State,
};

const SIZES: [usize; 3] = [3_000, 13_000, 52_000];
/// Runs up to so many seconds are repeated.
const SHORT: f64 = 1.0;
const REPETITIONS: usize = 5;

/// Ratios for all scenes and sizes.
pub fn all(names: &[String], sizes: &[usize]) -> Result<Vec<Value>, Box<dyn Error>> {
    let names: Vec<&str> = match names {
        [] => scene::NAMES.into(),
        some => some.iter().map(String::as_str).collect(),
    };
    let sizes = if sizes.is_empty() { &SIZES } else { sizes };
    let mut results = Vec::new();
    for name in names {
        for &size in sizes {
            let yardstick = child(name, size, "yardstick")?;
            let own = median(name, size, "condensed")?;
            let other = median(name, size, "multifrontal")?;
            report(name, &yardstick, &own, &other);
            results.push(json!({
                "scene": name, "yardstick": yardstick, "condensed": own, "multifrontal": other,
            }));
        }
    }
    Ok(results)
}

/// Mean time of an iteration of the stacked blocks with the condensed solver, by part.
pub fn iteration(size: usize) -> Result<Value, Box<dyn Error>> {
    let run = child("stacked", size, "condensed")?;
    let whole = number(&run, "iteration_s");
    println!(
        "iteration stacked blocks, {} unknowns  {}",
        run["unknowns"],
        words(whole)
    );
    // The pairs are a part of the assembly.
    for part in ["assembly", "pairs", "factorisation", "solution", "contact"] {
        let seconds = number(&run, &format!("{part}_s"));
        let share = 100.0 * seconds / whole;
        println!("iteration   {part:30} {:>12}  {share:.0} %", words(seconds));
    }
    Ok(json!({ "group": "iteration", "name": "stacked", "median_s": whole, "run": run }))
}

pub(crate) fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or(f64::NAN)
}

fn report(name: &str, yardstick: &Value, own: &Value, other: &Value) {
    let iteration = |v: &Value| number(v, "iteration_s");
    let cholesky = number(yardstick, "cholesky_s");
    let cpu = |v: &Value| number(v, "run_cpu_s") / number(yardstick, "cholesky_cpu_s");
    println!("{name}, {} unknowns:", own["unknowns"]);
    for (solver, v) in [("condensed", own), ("multifrontal", other)] {
        println!(
            "  {solver:12} run {:7.2} s ({:.2} s of processors), {} iterations of {:.3} s (assembly {:.3}, factorisation {:.3}, solution {:.3}, {} corrections of contact alone {:.3}), analyses {:.2} s, {} factorisations (median {} an increment), {:.0} MiB, by {}",
            number(v, "run_s"),
            number(v, "run_cpu_s"),
            v["iterations"],
            iteration(v),
            number(v, "assembly_s"),
            number(v, "factorisation_s"),
            number(v, "solution_s"),
            v["contact_corrections"],
            number(v, "contact_s"),
            number(v, "analysis_s"),
            v["factorisations"],
            v["factorisations_median"],
            number(v, "peak_mib"),
            v["method"].as_str().unwrap_or("-"),
        );
    }
    println!(
        "  faer Cholesky of the stiffness {cholesky:.3} s\n  ratios: iteration condensed/LU {:.2} ({:.2} without corrections of contact alone), iteration/Cholesky {:.2}, memory condensed/LU {:.2}, run/Cholesky {:.1} (processors {:.1}), run condensed/LU {:.2} (processors {:.2}), outside factorisation and solution {:.0} %, assembly {:.0} % of an iteration",
        iteration(own) / iteration(other),
        (iteration(own) - number(own, "contact_s")) / iteration(other),
        iteration(own) / cholesky,
        number(own, "peak_mib") / number(other, "peak_mib"),
        number(own, "run_s") / cholesky,
        cpu(own),
        number(own, "run_s") / number(other, "run_s"),
        cpu(own) / cpu(other),
        100.0 * (1.0 - number(own, "factored_share")),
        100.0 * number(own, "assembly_share"),
    );
    println!("  answers differ by {:.1e}", difference(own, other));
}

pub(crate) fn child(name: &str, size: usize, what: &str) -> Result<Value, Box<dyn Error>> {
    let output = Command::new(std::env::current_exe()?)
        .args(["--one", name, &size.to_string(), what])
        .stderr(Stdio::inherit())
        .output()?;
    if !output.status.success() {
        return Err(format!("{name} {size} {what} failed").into());
    }
    Ok(serde_json::from_slice(&output.stdout)?)
}

/// A run, or the median of several where it is so short that chance decides.
fn median(name: &str, size: usize, solver: &str) -> Result<Value, Box<dyn Error>> {
    let mut runs = vec![child(name, size, solver)?];
    if number(&runs[0], "run_s") < SHORT {
        for _ in 1..REPETITIONS {
            runs.push(child(name, size, solver)?);
        }
    }
    runs.sort_by(|a, b| number(a, "run_s").total_cmp(&number(b, "run_s")));
    Ok(runs.swap_remove(runs.len() / 2))
}

/// One measurement, printed as JSON: scene, size, and the solver or the yardstick.
pub fn one(arguments: &[String]) -> Result<(), Box<dyn Error>> {
    let [name, size, what] = arguments else {
        return Err("a scene, a size and a solver are needed".into());
    };
    let size = size.parse()?;
    let result = match what.as_str() {
        "yardstick" => {
            let matrix = scene::stiffness(&scene::model(name, size, Backend::Condensed)?)?;
            let seconds = yardstick::cholesky(&matrix)?;
            json!({
                "unknowns": matrix.structure().unknowns(),
                "cholesky_s": seconds.wall, "cholesky_cpu_s": seconds.cpu,
            })
        }
        "condensed" => whole(name, size, Backend::Condensed)?,
        "multifrontal" => whole(name, size, Backend::Multifrontal)?,
        "iterative" => whole(name, size, Backend::Iterative)?,
        other => return Err(format!("no solver `{other}`").into()),
    };
    println!("{result}");
    Ok(())
}

fn whole(name: &str, size: usize, backend: Backend) -> Result<Value, Box<dyn Error>> {
    let problem = Problem::new(scene::model(name, size, backend)?)?;
    let started = Instant::now();
    let first = Seconds::now(started);
    let mut log = Log::default();
    let (state, ending) = run(&problem, State::undeformed(&problem), &mut log);
    let time = Seconds::now(started).since(first);
    let seconds = time.wall;
    if ending != Ending::Completed {
        return Err(ending.to_string().into());
    }
    let sum = |part: fn(&LinearWork) -> f64| log.work.iter().map(part).sum::<f64>();
    let count: usize = log.work.iter().map(|work| work.factorisations).sum();
    let assembly = sum(|work| work.times.assembly.as_secs_f64());
    let pairs = sum(|work| work.times.pairs.as_secs_f64());
    let factorisation = sum(|work| work.times.factorisation.as_secs_f64());
    let solution = sum(|work| work.times.solution.as_secs_f64());
    let contact = sum(|work| work.times.contact.as_secs_f64());
    let whole = assembly + factorisation + solution + contact;
    let iterations = log.iterations as f64;
    let mut counts: Vec<usize> = log.work.iter().map(|work| work.factorisations).collect();
    counts.sort_unstable();
    Ok(json!({
        "unknowns": log.unknowns,
        "iterations": log.iterations,
        "factorisations": count,
        "factorisations_median": counts[counts.len() / 2],
        "assembly_share": assembly / whole,
        "run_s": seconds,
        "run_cpu_s": time.cpu,
        "answers": answers(&problem, &state),
        "iteration_s": whole / iterations,
        "assembly_s": assembly / iterations,
        "pairs_s": pairs / iterations,
        "factorisation_s": factorisation / iterations,
        "solution_s": solution / iterations,
        "contact_s": contact / iterations,
        "contact_corrections": log.work.iter().map(|work| work.contact_corrections).sum::<usize>(),
        "analysis_s": sum(|work| work.times.analysis.as_secs_f64()),
        "factored_share": (factorisation + solution) / seconds,
        "peak_mib": peak_rss_mib(),
        "krylov_iterations": log.work.iter().map(|work| work.krylov_iterations).sum::<usize>(),
        "method": log.work.last().map(|work| work.method.to_string()),
    }))
}

/// Displacements of some hundred nodes.
fn answers(problem: &Problem, state: &State) -> Vec<f64> {
    let stride = (problem.reference.len() / 300).max(1);
    let displacements = state.positions.iter().zip(&problem.reference);
    let every = displacements.step_by(stride);
    every
        .flat_map(|(x, reference)| <[f64; 3]>::from(x - reference))
        .collect()
}

/// Largest difference of two answers over the largest of them.
fn difference(a: &Value, b: &Value) -> f64 {
    let list = |v: &Value| -> Vec<f64> {
        let list = v["answers"].as_array().into_iter().flatten();
        list.filter_map(Value::as_f64).collect()
    };
    let (a, b) = (list(a), list(b));
    let size = a.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let differences = a.iter().zip(&b).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max) / size
}

/// Times and counts of the increments.
#[derive(Default)]
struct Log {
    work: Vec<LinearWork>,
    iterations: usize,
    unknowns: usize,
}

impl IterationObserver for Log {
    fn iteration(&mut self, _: usize, _: &Norms, _: &[Evaluation]) {}
}

impl Observer for Log {
    fn step(&mut self, _: usize, _: &str) {}

    fn increment(&mut self, _: Progress, increment: &Increment) -> Continue {
        self.work.push(increment.work);
        self.iterations += increment.iterations.len();
        self.unknowns = increment.unknowns;
        Continue::Yes
    }

    fn cut_back(&mut self, progress: Progress, reason: &CutBack) -> Continue {
        eprintln!("cut back at {:.3}: {reason}", progress.time);
        Continue::Yes
    }
}
