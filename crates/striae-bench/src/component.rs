//! Contact as a component of other programs, beside that of the program itself.

use std::{error::Error, hint::black_box, time::Duration};

use serde_json::Value;
use striae_condensed::{Partition, Tangent};
use striae_contact::{
    complementarity::Iteration,
    component::{Contact, Imposed, Opponent, Pair, Surface},
    segment::Derivatives,
    selection::Selection,
    side::Side,
};
use striae_mesh::NodeId;
use striae_model::Backend;
use striae_solve::{
    assembly::{self, ElementPlaces, Setting, StepContext, Trial, assemble},
    layout::{Extent, Layout},
    problem::Problem,
    state::State,
};

use crate::{
    clock::{timed, timed_by},
    scene,
};

/// Times of contact in the first iteration of the stacked blocks, by node: as the program evaluates
/// it and adds it to its system, and as the component evaluates it and adds its triplets.
pub fn all(size: usize) -> Result<Vec<Value>, Box<dyn Error>> {
    let model = scene::model("stacked", size, Backend::Condensed)?;
    let problem = Problem::new(model)?;
    let state = State::undeformed(&problem);
    let context = StepContext::new(&problem, 0, &state);
    let configuration = context.configuration(0, &state.positions, &state.rigid);
    let pair = &state.pairs[0];
    let selection = Selection::new(&configuration, None, &pair.kept, &context.fixed_on_pair[0]);
    let kept = selection.kept().len();
    let selections = [selection];
    let own = of_program(&context, &state, &selections)?;
    let component = of_component(&problem, &state, kept)?;
    let ratio = [&component, &own].map(|value| value["median_s"].as_f64().unwrap_or(f64::NAN));
    println!("  ratio: component/program {:.2}", ratio[0] / ratio[1]);
    Ok(vec![own, component])
}

/// Contact of the program, without the bodies that it assembles beside it.
fn of_program(
    context: &StepContext,
    state: &State,
    selections: &[Selection],
) -> Result<Value, Box<dyn Error>> {
    let problem = context.problem;
    let layout = Layout::new(problem, Extent::default().with(selections));
    let structure = scene::structure(problem, &layout)?;
    let mut partition = Partition::new(&structure, &layout.bulk())?;
    let places = ElementPlaces::new(problem, &layout, partition.structure());
    let mut tangent = Tangent::zero(partition.structure());
    let imposed = context.imposed(0.0);
    let setting = Setting {
        context,
        state,
        selections,
        imposed: &imposed,
    };
    let trial = Trial {
        positions: state.positions.clone(),
        tractions: vec![state.pairs[0].tractions.clone()],
        rigid: state.rigid.clone(),
        pressures: state.pressures.clone(),
    };
    let mut assembled = || -> Duration {
        let contact = assembly::Contact::Evaluated(Iteration::First);
        let parts = (&mut partition, &places, &mut tangent);
        let assembled = assemble(
            &setting,
            &trial,
            contact,
            Derivatives::First,
            &layout,
            parts,
        );
        assembled.map_or(Duration::MAX, |assembled| assembled.contact_time)
    };
    // The pattern has grown by then.
    assembled();
    let kept = selections[0].kept().len();
    Ok(timed_by(
        "component",
        "contact in the program",
        kept,
        assembled,
    ))
}

/// Contact of the component with the same surfaces.
fn of_component(problem: &Problem, state: &State, kept: usize) -> Result<Value, Box<dyn Error>> {
    let surface = |side: Side| -> Surface {
        let own = &problem.pairs[0].contact.sides[side];
        let facets = own.surface().map_or(&[][..], |surface| surface.facets());
        let node = |node| problem.surface_node(0, side, node).map_or(0, |node| node.0);
        let corners = facets.iter();
        Surface {
            facets: corners
                .map(|facet| facet.map(|corner| NodeId::new(node(corner))))
                .collect(),
            youngs_modulus: own.stiffness,
            texture: None,
        }
    };
    let pair = Pair {
        name: "interface".into(),
        a: surface(Side::A),
        b: Opponent::Deformable(surface(Side::B)),
        friction: problem.model.pairs[0].friction.clone(),
        search_distance: None,
    };
    let contact = Contact::new(state.positions.clone(), &[pair])?;
    let increment = contact.begin(&contact.untouched(), &Imposed::default())?;
    let tractions = increment.tractions();
    assert_eq!(tractions.len(), 3 * kept, "the same nodes are kept");
    Ok(timed("component", "contact in the component", kept, || {
        let evaluated = increment.evaluate(increment.positions(), &tractions, None);
        black_box(evaluated.is_ok());
    }))
}
