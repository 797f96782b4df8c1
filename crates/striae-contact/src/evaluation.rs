//! Residual and tangent of a contact pair at given unknowns.
//!
//! A pure function of the configuration, the roles and the traction unknowns.

use rayon::prelude::*;
use striae_mesh::{FacetId, Vec3};

use crate::{
    balance::{BalanceRows, balance_rows, held_balance},
    complementarity::{Iteration, KinematicNode, Prescribed, rows},
    configuration::Configuration,
    coverage::Place,
    field::{FacetForces, facet_terms},
    frame::{LostProjection, Tracked, frames},
    projection::Margin,
    selection::{Partner, Role, Selection},
    slip_rate::slip_velocities,
    term::LocalTerm,
    texture::{CollapsedTexture, own, textures},
    traction::{Surroundings, nodal_tractions},
    transfer::{Fields, extended_rows, traction_rows},
    unknowns::{NodeResult, Status, Tractions},
};

/// Everything a pair contributes, and what it looks like.
#[derive(Clone, Debug)]
pub struct Evaluation {
    /// Rows of the residual; momentum rows are internal minus external force.
    pub terms: Vec<LocalTerm>,
    /// Results of every node, by side.
    pub nodes: [Vec<NodeResult>; 2],
    /// Forces on the facets of each side.
    pub facets: [Vec<(FacetId, FacetForces)>; 2],
    /// Covered area that belongs to every node, by side.
    pub nodal_areas: [Vec<f64>; 2],
}

/// A configuration that cannot be evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EvaluationError {
    /// A node no longer sees the other side.
    Lost(LostProjection),
    /// A convected texture has no direction left.
    Collapsed(CollapsedTexture),
}

impl From<LostProjection> for EvaluationError {
    fn from(lost: LostProjection) -> Self {
        Self::Lost(lost)
    }
}

impl From<CollapsedTexture> for EvaluationError {
    fn from(collapsed: CollapsedTexture) -> Self {
        Self::Collapsed(collapsed)
    }
}

/// Evaluates a pair.
///
/// # Errors
/// When a node no longer sees the other side or its texture collapses.
pub fn evaluate(
    configuration: &Configuration,
    selection: &Selection,
    tractions: &Tractions,
    prescribed: &Prescribed,
    iteration: Iteration,
) -> Result<Evaluation, EvaluationError> {
    let frames = frames(configuration, selection)?;
    let textures = textures(configuration, selection, &frames)?;
    let velocities = slip_velocities(configuration, selection, &frames);
    let surroundings = Surroundings {
        frames: &frames,
        textures: &textures,
        velocities: &velocities,
    };
    let tau = nodal_tractions(configuration, selection, &surroundings, tractions);
    let fields = Fields {
        configuration,
        selection,
        frames: &frames,
        tractions,
        textures: &textures,
        tau: &tau,
    };
    let mut evaluation = Evaluation {
        terms: Vec::new(),
        nodes: [0, 1].map(|side| vec![NodeResult::default(); selection.roles[side].len()]),
        facets: [Vec::new(), Vec::new()],
        nodal_areas: [0, 1].map(|side| vec![0.0; selection.roles[side].len()]),
    };
    let balance = balance_rows(&fields);
    evaluation.terms.extend(held_balance(&balance, tractions));
    for &side in configuration.pair.deformable_sides() {
        evaluation.add_nodes(&fields, side, prescribed, iteration)?;
        evaluation.add_facets(&fields, side, &balance);
    }
    evaluation.follow_status(configuration, selection);
    Ok(evaluation)
}

impl Evaluation {
    fn add_nodes(
        &mut self,
        fields: &Fields,
        side: usize,
        prescribed: &Prescribed,
        iteration: Iteration,
    ) -> Result<(), LostProjection> {
        let roles = &fields.selection.roles[side];
        let results: Vec<_> = (0..roles.len())
            .into_par_iter()
            .with_min_len(8)
            .filter(|&node| roles[node] != Role::Idle)
            .map(|node| node_rows(fields, side, node as u32, prescribed, iteration))
            .collect();
        for result in results {
            let (node, terms, result) = result?;
            self.terms.extend(terms);
            self.nodes[side][node as usize] = result;
        }
        Ok(())
    }

    fn add_facets(&mut self, fields: &Fields, side: usize, balance: &[BalanceRows]) {
        let selection = fields.selection;
        let facets = fields.configuration.side(side).surface.facets();
        let results: Vec<_> = (0..facets.len())
            .into_par_iter()
            .with_min_len(8)
            .filter_map(|index| {
                let active = facets[index]
                    .iter()
                    .find(|&&n| selection.is_active(side, n))?;
                let patch = selection.patch_of[side][*active as usize];
                let rows = patch.map(|patch| &balance[patch as usize]);
                let facet = FacetId::new(index);
                Some((facet, facet_terms(fields, side, facet, rows)))
            })
            .collect();
        for (facet, (terms, forces)) in results {
            self.terms.extend(terms);
            for (corner, area) in facets[facet.index()].iter().zip(forces.area) {
                self.nodal_areas[side][*corner as usize] += area;
            }
            self.facets[side].push((facet, forces));
        }
    }

    /// Traction and extended nodes take the status of the heaviest opposing
    /// corner or of their leader.
    fn follow_status(&mut self, configuration: &Configuration, selection: &Selection) {
        let known = self
            .nodes
            .each_ref()
            .map(|side| side.iter().map(|result| result.status).collect::<Vec<_>>());
        for side in 0..2 {
            for (node, role) in selection.roles[side].iter().enumerate() {
                let result = &mut self.nodes[side][node];
                let source = match role {
                    Role::Traction(Partner::Corners(corners, weights)) => {
                        let heaviest = (0..4).max_by(|&a, &b| weights[a].total_cmp(&weights[b]));
                        heaviest.map(|corner| (1 - side, corners[corner]))
                    }
                    Role::Extended(leaders) => Some((leaders[0].side, leaders[0].node)),
                    _ => None,
                };
                if let Some((other, corner)) = source {
                    let kinematic =
                        matches!(selection.roles[other][corner as usize], Role::Kinematic(_));
                    let rate = result.slip.norm() / configuration.elapsed;
                    let cap = configuration.pair.friction.cap(result.pressure, rate);
                    result.status = match known[other][corner as usize] {
                        _ if result.pressure <= 0.0 => Status::Open,
                        status if kinematic => status,
                        _ if result.tau.norm() < cap * (1.0 - 1e-6) => Status::Stick,
                        _ => Status::Slip,
                    };
                }
            }
        }
    }
}

fn node_rows(
    fields: &Fields,
    side: usize,
    node: u32,
    prescribed: &Prescribed,
    iteration: Iteration,
) -> Result<(u32, Vec<LocalTerm>, NodeResult), LostProjection> {
    let lost = LostProjection { side, node };
    let frame = fields.frames[side][node as usize].as_ref().ok_or(lost)?;
    let unknowns = fields.tractions.nodes[side][node as usize];
    let tau = fields.tau[side][node as usize].value;
    let mut result = NodeResult {
        pressure: unknowns[0],
        tau,
        normal: frame.n.value,
        texture: own_texture(fields, side, node, &frame.n),
        ..NodeResult::default()
    };
    match &fields.selection.roles[side][node as usize] {
        Role::Kinematic(partner) => {
            let kinematic = KinematicNode {
                side,
                node,
                partner: *partner,
                frame,
                textures: &fields.textures[side][node as usize],
                slipped: fields.tractions.slipped[side][node as usize],
                before: fields.tractions.statuses[side][node as usize],
                unknowns,
                tau,
            };
            let (term, of_rows) = rows(fields.configuration, &kinematic, prescribed, iteration)?;
            let result = NodeResult {
                texture: result.texture,
                ..of_rows
            };
            Ok((node, vec![term], result))
        }
        Role::Traction(partner) => {
            let (term, gap) = traction_rows(fields, side, node)?;
            result.gap = gap;
            result.slip = slip(fields.configuration, side, node, *partner, &frame.n.value);
            Ok((node, vec![term], result))
        }
        Role::Extended(leaders) => {
            let terms = extended_rows(fields, side, node, leaders);
            Ok((node, terms, result))
        }
        Role::Idle => Err(lost),
    }
}

/// Direction `s = a x n` of the node's own texture, zero without one.
fn own_texture(fields: &Fields, side: usize, node: u32, n: &Tracked) -> Vec3 {
    match own(fields.configuration, side, node, n) {
        Ok(Some(a)) => a.value.cross(&n.value),
        Ok(None) | Err(_) => Vec3::zeros(),
    }
}

/// `(I - n n)(x_I - xbar)`.
fn slip(configuration: &Configuration, side: usize, node: u32, partner: Partner, n: &Vec3) -> Vec3 {
    let relative = configuration.side(side).x[node as usize] - partner.point(configuration, side);
    relative - n * n.dot(&relative)
}

/// Nodes outside the selection that have run into the other side.
pub fn missed_contacts(configuration: &Configuration, selection: &Selection) -> Vec<(usize, u32)> {
    let mut missed = Vec::new();
    for &side in configuration.pair.deformable_sides() {
        for node in 0..selection.roles[side].len() as u32 {
            if selection.roles[side][node as usize] != Role::Idle {
                continue;
            }
            let reach = configuration.reach(side, node);
            let contact = configuration.contact(side, node, reach, Margin::Inside);
            if let Some(contact) = contact
                && contact.gap < -0.05 * reach
                && !matches!(contact.place, Place::Facet(hit) if beside_active(configuration, selection, side, hit.facet))
            {
                missed.push((side, node));
            }
        }
    }
    missed
}

/// Whether a facet of the other side carries traction at all its corners.
fn beside_active(
    configuration: &Configuration,
    selection: &Selection,
    side: usize,
    facet: FacetId,
) -> bool {
    !configuration.pair.is_rigid()
        && configuration
            .side(1 - side)
            .corners(facet)
            .iter()
            .all(|&corner| selection.is_active(1 - side, corner))
}
