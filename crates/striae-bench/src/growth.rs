//! Growth of time and memory with the number of unknowns.

use crate::compare::{child, number};
use serde_json::{Value, json};
use std::{error::Error, path::Path};
use striae_figure::{Axis, Content, Figure, Marker, Panel, Series, Width, power_law};

const SIZES: [usize; 6] = [10_000, 20_000, 40_000, 80_000, 160_000, 300_000];

/// Quantity as a function of a run.
type Of = fn(&Value) -> f64;

/// Fitted quantities: name, unit, and how each follows from a run.
const QUANTITIES: [(&str, &str, Of); 3] = [
    ("iteration", "s", |run| number(run, "iteration_s")),
    ("iteration, processors", "s", |run| {
        number(run, "run_cpu_s") / number(run, "iterations")
    }),
    ("peak of memory", "MiB", |run| number(run, "peak_mib")),
];

/// Runs scenes at several sizes with one solver, fits power laws and draws them.
pub fn all(
    names: &[String],
    sizes: &[usize],
    folder: Option<&str>,
    solver: &str,
) -> Result<Vec<Value>, Box<dyn Error>> {
    let names = match names {
        [] => vec!["stacked"],
        some => some.iter().map(String::as_str).collect(),
    };
    let sizes = if sizes.is_empty() { &SIZES } else { sizes };
    let mut results = Vec::new();
    for name in names {
        let mut runs = Vec::new();
        for &size in sizes {
            let run = child(name, size, solver)?;
            let list = QUANTITIES
                .iter()
                .map(|(what, unit, of)| format!("{what} {:.3} {unit}", of(&run)));
            let list: Vec<String> = list.collect();
            let method = run["method"].as_str().unwrap_or("-");
            let list = list.join(", ");
            println!("{name}, {} unknowns by {method}: {list}", run["unknowns"]);
            runs.push(run);
        }
        let exponents = report(name, &runs);
        if let Some(folder) = folder {
            figure(&runs).write(Path::new(folder), &stem(name, solver))?;
        }
        results
            .push(json!({ "scene": name, "solver": solver, "exponents": exponents, "runs": runs }));
    }
    Ok(results)
}

/// Name of the figure; the solver by default has none in it.
fn stem(name: &str, solver: &str) -> String {
    match solver {
        "condensed" => format!("growth-{name}"),
        other => format!("growth-{name}-{other}"),
    }
}

fn points(runs: &[Value], of: Of) -> Vec<[f64; 2]> {
    runs.iter()
        .map(|run| [number(run, "unknowns"), of(run)])
        .collect()
}

/// Prints and returns the fitted exponents.
fn report(name: &str, runs: &[Value]) -> Vec<Option<f64>> {
    let fitted = QUANTITIES.iter().map(|(what, _, of)| {
        let exponent = power_law(&points(runs, *of)).map(|law| law.exponent);
        match exponent {
            Some(exponent) => println!("{name}: {what} grows as unknowns^{exponent:.2}"),
            None => println!("{name}: one size alone says nothing about the growth of {what}"),
        }
        exponent
    });
    fitted.collect()
}

/// Time of an iteration and memory, each with its power law.
fn figure(runs: &[Value]) -> Figure {
    let law = |name: &str, of: Of, marker: Marker| {
        let content = Content::PowerLaw {
            points: points(runs, of),
            marker,
        };
        Series::new(name, content)
    };
    let [wall, processors, memory] = QUANTITIES.map(|(_, _, of)| of);
    let unknowns = || Axis::logarithmic("unknowns", "");
    let time = Panel::new(unknowns(), Axis::logarithmic("time of an iteration", "s"))
        .with(law("clock", wall, Marker::Circle))
        .with(law("processors", processors, Marker::Square));
    let memory = Panel::new(unknowns(), Axis::logarithmic("peak of memory", "MiB")).with(law(
        "memory",
        memory,
        Marker::Diamond,
    ));
    Figure::new(Width::Page, vec![time, memory])
}
