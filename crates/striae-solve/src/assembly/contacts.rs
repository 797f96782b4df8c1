//! Contact of all pairs: its evaluation at a trial state, and its place in the system.

use striae_contact::{
    complementarity::{Conditions, Iteration},
    configuration::Configuration,
    evaluation::{Collapse, Evaluation, evaluate},
    segment::Derivatives,
    side::Side,
    texture::CollapsedTexture,
};
use striae_mesh::{FacetId, Vec3};

use super::{Contact, Setting, System, Trial};
use crate::{outcome::CutBack, problem::Problem};
use striae_model::node::GlobalNode;

impl Contact {
    /// Contact of every pair.
    pub(super) fn evaluated(
        self,
        configurations: &[Configuration],
        setting: &Setting,
        trial: &Trial,
        derivatives: Derivatives,
        wanted: &[Option<[Vec<bool>; 2]>],
    ) -> Result<Vec<Evaluation>, CutBack> {
        match self {
            Self::Known(contacts) => Ok(contacts),
            Self::Evaluated(iteration) => {
                let which = (iteration, derivatives);
                contacts(configurations, setting, trial, which, wanted)
            }
        }
    }
}

/// Contact of every pair; `wanted` has the nodes whose rows are wanted with derivatives,
/// where not those of all are.
pub(super) fn contacts(
    configurations: &[Configuration],
    setting: &Setting,
    trial: &Trial,
    (iteration, derivatives): (Iteration, Derivatives),
    wanted: &[Option<[Vec<bool>; 2]>],
) -> Result<Vec<Evaluation>, CutBack> {
    let (context, state) = (setting.context, setting.state);
    let mut contacts = Vec::with_capacity(configurations.len());
    for (pair, configuration) in configurations.iter().enumerate() {
        let evaluation = evaluate(
            configuration,
            &context.configuration(pair, &state.positions, &state.rigid),
            &setting.selections[pair],
            &trial.tractions[pair],
            Conditions {
                friction: &context.plan.frictions[pair],
                prescribed: &context.fixed_on_pair[pair],
                iteration,
                wanted: wanted.get(pair).and_then(Option::as_ref),
            },
            derivatives,
        )
        .map_err(|error| not_evaluated(context.problem, pair, error))?;
        contacts.push(evaluation);
    }
    Ok(contacts)
}

fn not_evaluated(problem: &Problem, pair: usize, collapse: Collapse) -> CutBack {
    let name = || problem.model.pairs[pair].name.clone();
    let (side, node) = match collapse {
        Collapse::Texture(CollapsedTexture { side, node }) => (side, node),
        Collapse::Folded => return CutBack::Folded { pair: name() },
        Collapse::Factor(failure) => {
            return CutBack::Factor {
                pair: name(),
                failure,
            };
        }
    };
    let global = problem
        .surface_node(pair, side, node)
        .unwrap_or(GlobalNode(0));
    let (body, node) = problem.named_node(global);
    let pair = name();
    let body = problem.model.bodies[body].name.clone();
    CutBack::CollapsedTexture { pair, body, node }
}

impl System<'_> {
    /// Adds contact to the system; what is outside the pattern is noted.
    pub(super) fn add_contacts(&mut self, contacts: &[Evaluation]) {
        for (pair, evaluation) in contacts.iter().enumerate() {
            self.add_terms(pair, &evaluation.terms);
            for side in Side::BOTH {
                for (facet, forces) in &evaluation.facets[side] {
                    self.contact_forces(pair, side, *facet, &forces.force);
                }
            }
        }
    }

    fn contact_forces(&mut self, pair: usize, side: Side, facet: FacetId, forces: &[Vec3; 4]) {
        let problem = self.context.problem;
        if let Some(surface) = problem.pairs[pair].contact.sides[side].surface() {
            for (corner, force) in surface.facets()[facet.index()].iter().zip(forces) {
                if let Some(node) = problem.surface_node(pair, side, *corner) {
                    self.forces.contact[node] += force;
                }
            }
        }
    }
}
