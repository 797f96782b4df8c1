//! Times of the parts of an iteration.

use crate::{clock::timed, compare, component, element, scene, yardstick};
use nalgebra::Matrix3;
use serde_json::{Value, json};
use std::{error::Error, hint::black_box};
use striae_condensed::{Automatic, Choice, Partition, Tangent, TangentSolver};
use striae_contact::{
    complementarity::{Conditions, Iteration},
    evaluation::evaluate,
    segment::Derivatives,
    selection::Selection,
    side::Side,
    unknowns::Tractions,
};
use striae_law::{
    bulk::{LameConstants, Material},
    friction::Friction,
};
use striae_model::Backend;
use striae_solve::{
    assembly::{ElementPlaces, Setting, StepContext, Trial},
    layout::{Extent, Layout},
    problem::Problem,
    state::State,
};
use striae_sparse::{LinearSolver, MultifrontalLu, SparseMatrix};
use striae_surface::normal::nodal_normals;

type Results = Result<Vec<Value>, Box<dyn Error>>;

const GROUPS: [&str; 9] = [
    "law",
    "element",
    "surface",
    "search",
    "assembly",
    "component",
    "factor",
    "iteration",
    "cases",
];
const SIZES: [usize; 3] = [3_000, 13_000, 52_000];

/// Times of some groups, all without any.
pub fn all(groups: &[String], sizes: &[usize]) -> Results {
    let groups: Vec<&str> = match groups {
        [] => GROUPS.into(),
        some => some.iter().map(String::as_str).collect(),
    };
    let sizes = if sizes.is_empty() { &SIZES } else { sizes };
    let mut results = Vec::new();
    for group in groups {
        match group {
            "law" => results.extend(law()?),
            "element" => results.extend(element::all()?),
            "surface" | "search" | "assembly" | "factor" => {
                for &size in sizes {
                    results.extend(of_scene(group, size)?);
                }
            }
            "component" => {
                for &size in sizes {
                    results.extend(component::all(size)?);
                }
            }
            "iteration" => {
                for &size in sizes {
                    results.push(compare::iteration(size)?);
                }
            }
            "cases" => results.extend(compare::all(&[], sizes)?),
            other => return Err(format!("no group `{other}`; there are {GROUPS:?}").into()),
        }
    }
    Ok(results)
}

/// Responses of the laws at a point.
fn law() -> Results {
    const COUNT: usize = 1000;
    let rubber = Material::neo_hookean(LameConstants {
        lambda: 0.657,
        shear: 0.164,
    });
    let gradient = |k: usize| {
        let mut f = Matrix3::identity();
        f[(0, 1)] = 1e-4 * k as f64;
        f
    };
    let bulk = timed("law", "neo-Hookean response", COUNT, || {
        for k in 0..COUNT {
            black_box(rubber.response(&gradient(k)).is_ok());
        }
    });
    let friction = Friction::coulomb(0.3)?;
    let cap = timed("law", "cap of Coulomb friction", COUNT, || {
        for k in 0..COUNT {
            black_box(friction.cap(k as f64, 0.0));
        }
    });
    Ok(vec![bulk, cap])
}

/// Parts of the first iteration of the stacked blocks.
fn of_scene(group: &str, size: usize) -> Results {
    let model = scene::model("stacked", size, Backend::Condensed)?;
    if group == "factor" {
        return factor(scene::stiffness(&model)?);
    }
    let problem = Problem::new(model.clone())?;
    let state = State::undeformed(&problem);
    let context = StepContext::new(&problem, 0, &state);
    let configuration = context.configuration(0, &state.positions, &state.rigid);
    let pair = &state.pairs[0];
    let selection = Selection::new(&configuration, None, &pair.kept, &context.fixed_on_pair[0]);
    let nodes: usize = Side::BOTH
        .into_iter()
        .map(|side| selection.nodes(side))
        .sum();
    Ok(match group {
        "surface" => {
            let surface = configuration.side(Side::A);
            vec![timed("surface", "nodal normals", surface.x.len(), || {
                black_box(nodal_normals(surface.surface, &surface.x));
            })]
        }
        "search" => {
            let roles = timed("search", "selection of roles", nodes, || {
                black_box(Selection::new(
                    &configuration,
                    None,
                    &pair.kept,
                    &context.fixed_on_pair[0],
                ));
            });
            let tractions: &Tractions = &state.pairs[0].tractions;
            let conditions = Conditions {
                friction: &context.plan.frictions[0],
                prescribed: &context.fixed_on_pair[0],
                iteration: Iteration::First,
                wanted: None,
            };
            let at = &configuration;
            let terms = timed("search", "segments and local terms", nodes, || {
                let evaluation = evaluate(
                    at,
                    at,
                    &selection,
                    tractions,
                    conditions,
                    Derivatives::First,
                );
                black_box(evaluation.is_ok());
            });
            vec![roles, terms]
        }
        _ => vec![assembly(&model)?],
    })
}

/// Elements of the bodies without contact.
fn assembly(model: &striae_model::Model) -> Result<Value, Box<dyn Error>> {
    let mut tangent = Tangent::from(scene::stiffness(model)?);
    let mut partition = Partition::from(tangent.bodies.structure());
    let mut bodies = model.clone();
    bodies.pairs.clear();
    let problem = Problem::new(bodies)?;
    let state = State::undeformed(&problem);
    let context = StepContext::new(&problem, 0, &state);
    let layout = Layout::new(&problem, Extent::default());
    let places = ElementPlaces::new(&problem, &layout, partition.structure());
    let imposed = context.imposed(0.0);
    let trial = Trial {
        positions: state.positions.clone(),
        tractions: Vec::new(),
        rigid: state.rigid.clone(),
        pressures: state.pressures.clone(),
    };
    let setting = Setting {
        context: &context,
        state: &state,
        selections: &[],
        imposed: &imposed,
    };
    let elements = model
        .bodies
        .iter()
        .map(|body| body.mesh.element_count())
        .sum();
    Ok(timed("assembly", "elements", elements, || {
        let parts = (&mut partition, &places, &mut tangent);
        black_box(scene::bodies(&setting, &trial, &layout, parts).is_ok());
    }))
}

/// Factorisations of the stiffness alone.
fn factor(stiffness: SparseMatrix) -> Results {
    let unknowns = stiffness.structure().unknowns();
    let tangent = Tangent::from(stiffness);
    let matrix = &tangent.bodies;
    let mut condensed = Automatic::new(Choice::ByCost);
    condensed.analyse(&Partition::from(matrix.structure()))?;
    let mut lu = MultifrontalLu::new();
    lu.analyse(matrix.structure())?;
    let mut results = vec![
        timed("factor", "condensed", unknowns, || {
            black_box(condensed.factor(&tangent).is_ok());
        }),
        timed("factor", "multifrontal LU", unknowns, || {
            black_box(lu.factor(matrix).is_ok());
        }),
    ];
    let seconds = yardstick::cholesky(matrix)?.wall;
    println!(
        "factor    faer Cholesky, same ordering     {}",
        crate::clock::words(seconds)
    );
    results.push(json!({
        "group": "factor", "name": "faer Cholesky", "items": unknowns, "median_s": seconds,
    }));
    Ok(results)
}
