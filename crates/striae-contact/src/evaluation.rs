//! Residual and tangent of a contact pair at given unknowns.
//!
//! A pure function of two configurations, the last converged one and the present one, of
//! the roles and of the traction unknowns.
//!
//! Longer than other files, as it is the one place where all that a pair contributes is joined.

use rayon::prelude::*;
use striae_law::friction::FactorFailure;
use striae_mesh::{FacetId, Vec3};
use striae_surface::node::SurfaceNode;

use crate::{
    collocated,
    common_field::{CommonField, by_facet, segment_terms},
    complementarity::{Conditions, ContactNode, rows},
    configuration::Configuration,
    factors::{Evolving, NodeFactor, Seen, factors},
    field::{FacetForces, Fields, facet_terms},
    frame::{Frame, Frames, frames},
    history::History,
    kinematics::{Kinematics, Pressure, Report},
    pair::Enforcement,
    pairing::{Corners, Folded, topology},
    patch::{Patch, Pressures, patches, wanted},
    ramp::{self, Ramp},
    segment::{Derivatives, SegmentDerivatives},
    segment_rows::Slip,
    selection::Selection,
    side::Side,
    slip_rate::{SlipRates, slip_rates},
    term::LocalTerm,
    texture::{CollapsedTexture, Textures, own, textures},
    traction::{NodalTractions, Surroundings, nodal_tractions},
    transported::Transported,
    unknowns::{NodeResult, Status, Tractions, begun},
    wear::{self, Worn},
    weighted,
};

/// Everything a pair contributes, and what it looks like.
#[derive(Clone, Debug)]
pub struct Evaluation {
    /// Rows of the residual; momentum rows are internal minus external force.
    pub terms: Vec<LocalTerm>,
    /// Results of every node, by side.
    pub nodes: [Vec<NodeResult>; 2],
    /// Kept nodes whose status is given and would be another one by their state, with that.
    pub otherwise: Vec<(Side, SurfaceNode, Status)>,
    /// Pressure, and components of `-tau` along the nodal tangents, of every node, by side:
    /// what the unknowns of a node that is kept from now on start from.
    pub carried: [Vec<[f64; 3]>; 2],
    /// Forces on the facets of each side.
    pub facets: [Vec<(FacetId, FacetForces)>; 2],
    /// Hash of the paired facets and of the corners and edges that bound their polygons. Integrals
    /// of contact jump slightly when it changes.
    pub topology: u64,
    /// Work that friction dissipates at the nodes that slip, `-sum_k w_k tau_k . du_k` with the
    /// weights that the slips are means over: that of the tractions on the present segments.
    pub dissipated: f64,
    /// Wear of both sides in the increment.
    pub worn: Worn,
    /// Conditions under which states of a factor of friction evolve, if there are some.
    pub evolving: Option<Evolving>,
}

/// Reason why a pair cannot be evaluated.
#[derive(Clone, Debug, PartialEq)]
pub enum Collapse {
    /// A texture has no direction left.
    Texture(CollapsedTexture),
    /// The surfaces are folded over each other.
    Folded,
    /// A factor of friction is not sound, or its law has failed.
    Factor(FactorFailure),
}

/// Evaluates a pair; `start` is the last converged configuration.
///
/// Without derivatives the tangents of its terms are not those of the rows, if they are there
/// at all. The rows are the same to the last bit.
///
/// # Errors
/// When a texture has no direction left, the surfaces are folded over each other, or friction has
/// no factor.
pub fn evaluate(
    configuration: &Configuration,
    start: &Configuration,
    selection: &Selection,
    tractions: &Tractions,
    conditions: Conditions,
    derivatives: Derivatives,
) -> Result<Evaluation, Collapse> {
    let friction = conditions.friction;
    let slip = if friction.is_frictionless() {
        Slip::Left
    } else {
        Slip::Wanted
    };
    let frames = frames(configuration, selection);
    let (patches, mut kinematics) = match configuration.pair.enforcement {
        Enforcement::Weighted => {
            // Forces at a node then depend on all segments around its neighbours, or gaps do.
            let reaches_far = friction.depends_on_rate() || configuration.pair.wears();
            let slopes = |corners: &[Corners]| {
                let asked = || wanted(configuration, selection, (conditions.wanted, corners));
                match (derivatives, slip) {
                    (Derivatives::First, _) if !reaches_far && !asked() => SegmentDerivatives::None,
                    (Derivatives::First, Slip::Left) => SegmentDerivatives::OfPressure,
                    (Derivatives::First, Slip::Wanted) => SegmentDerivatives::All,
                    (Derivatives::None, _) => SegmentDerivatives::None,
                }
            };
            let pressures = Pressures {
                tractions,
                iteration: conditions.iteration,
            };
            let asked = (slip, &slopes);
            let patches = patches(configuration, start, selection, pressures, asked)
                .map_err(|Folded| Collapse::Folded)?;
            let of = (patches.as_slice(), slip);
            let rows = weighted::kinematics(configuration, selection, &frames, tractions, of);
            (patches, rows)
        }
        Enforcement::Collocated => {
            let rows = collocated::kinematics(configuration, selection, &frames);
            (Vec::new(), rows)
        }
    };
    let textures = textures(configuration, friction, selection, &frames, &kinematics)
        .map_err(Collapse::Texture)?;
    let rates = slip_rates(configuration, friction, selection, &kinematics);
    let worn = wear::rates(
        configuration.pair,
        selection,
        tractions,
        (&kinematics, &textures),
    );
    if configuration.pair.enforcement == Enforcement::Weighted {
        ramp::add_to_gaps(configuration, selection, tractions, &mut kinematics);
        wear::add_to_gaps(selection, &worn, &mut kinematics);
    }
    let seen = Seen {
        frames: &frames,
        textures: &textures,
        rates: &rates,
        kinematics: &kinematics,
    };
    let histories: Vec<History> = match slip {
        Slip::Left => Vec::new(),
        Slip::Wanted => (0..selection.kept().len())
            .map(|k| History::new(selection, tractions, k))
            .collect(),
    };
    let of_nodes = (selection, tractions, &*histories);
    let factors = factors(configuration, start, friction, of_nodes, seen);
    let factors = factors.map_err(Collapse::Factor)?;
    let surroundings = Surroundings {
        friction,
        factors: &factors,
        histories: &histories,
        frames: &frames,
        textures: &textures,
        rates: &rates,
        kinematics: &kinematics,
    };
    let tau = nodal_tractions(configuration, selection, &surroundings, tractions);
    if configuration.pair.enforcement == Enforcement::Weighted && slip == Slip::Wanted {
        let ramp = Ramp {
            configuration,
            start,
            selection,
            frames: &frames,
            tractions,
            tau: &tau,
        };
        ramp.add_to_slips(&mut kinematics);
    }
    let stage = Stage {
        configuration,
        selection,
        tractions,
        frames: &frames,
        textures: &textures,
        kinematics: &kinematics,
        rates: &rates,
        factors: &factors,
        histories: &histories,
        tau: &tau,
    };
    let mut evaluation = stage.nodal(&patches);
    evaluation.evolving = Evolving::new(configuration, start, friction);
    evaluation.worn = Worn::new(configuration.pair, selection, &worn);
    evaluation.add_rows(&stage, conditions, derivatives);
    evaluation.follow_status(selection);
    match configuration.pair.enforcement {
        Enforcement::Weighted => evaluation.add_segments(&stage, patches),
        Enforcement::Collocated => evaluation.add_facets(&stage),
    }
    evaluation.add_means(configuration);
    Ok(evaluation)
}

/// All that the rows of a pair are made of.
struct Stage<'a> {
    configuration: &'a Configuration<'a>,
    selection: &'a Selection,
    tractions: &'a Tractions,
    frames: &'a Frames,
    textures: &'a Textures,
    kinematics: &'a [Kinematics],
    rates: &'a SlipRates,
    factors: &'a [NodeFactor],
    histories: &'a [History<'a>],
    tau: &'a NodalTractions,
}

impl Stage<'_> {
    /// Results of all nodes, without the status, by the transfer from kept nodes.
    fn nodal(&self, patches: &[Patch]) -> Evaluation {
        let selection = self.selection;
        let counts = Side::BOTH.map(|side| selection.nodes(side));
        let reports = weighted::reports(self.configuration, counts, patches);
        let mut evaluation = Evaluation {
            terms: Vec::new(),
            nodes: counts.map(|count| vec![NodeResult::default(); count]),
            otherwise: Vec::new(),
            carried: counts.map(|count| vec![[0.0; 3]; count]),
            facets: [Vec::new(), Vec::new()],
            topology: topology(patches.iter().map(|patch| &patch.paired)),
            dissipated: 0.0,
            worn: Worn::default(),
            evolving: None,
        };
        for side in Side::BOTH {
            for node in SurfaceNode::all(counts[side]) {
                if let Some(frame) = &self.frames[side][node] {
                    let result = self.of_node(side, node, frame, &reports[side][node]);
                    let [t1, t2] = [0, 1].map(|axis| -frame.t[axis].value.dot(&result.tau));
                    evaluation.carried[side][node] = [result.pressure, t1, t2];
                    evaluation.nodes[side][node] = result;
                }
            }
        }
        evaluation
    }

    fn of_node(&self, side: Side, node: SurfaceNode, frame: &Frame, report: &Report) -> NodeResult {
        let mut result = NodeResult {
            gap: report.gap,
            normal: frame.n.value,
            texture: self.own_texture(side, node, frame),
            ..NodeResult::default()
        };
        let n = frame.n.value;
        result.slip = report.slip - n * n.dot(&report.slip);
        let row = self.selection.row(side, node).iter();
        for (&(k, weight), &friction) in row.zip(self.selection.friction_row(side, node)) {
            let (side_k, node_k) = self.selection.kept()[k as usize].place();
            let p = self.tractions.nodes[side_k][node_k][0];
            let pressure = self.kinematics[k as usize].bounding_pressure(p);
            result.pressure += weight * pressure.max(0.0);
            if let Pressure::AtPoints(supported) = &self.kinematics[k as usize].pressure {
                result.closed += weight * supported.closed;
            }
            if let Some(from) = &self.frames[side_k][node_k] {
                let tau = &self.tau[side_k][node_k].value;
                let turned = Transported::new(tau, &(from.n.value * friction.signum()), &n);
                result.tau += turned.value * friction;
            }
        }
        result
    }

    /// Direction `s = a x n` of the node's own texture, zero without one.
    fn own_texture(&self, side: Side, node: SurfaceNode, frame: &Frame) -> Vec3 {
        match own(self.configuration, side, node, &frame.n) {
            Ok(Some(a)) => a.value.cross(&frame.n.value),
            Ok(None) | Err(_) => Vec3::zeros(),
        }
    }
}

impl Evaluation {
    /// Forgets the derivatives of the terms, which take the most room.
    pub fn forget_derivatives(&mut self) {
        for term in &mut self.terms {
            term.columns = Vec::new();
            term.tangent = Vec::new();
        }
    }

    fn add_rows(&mut self, stage: &Stage, conditions: Conditions, derivatives: Derivatives) {
        let kept = stage.selection.kept();
        let law = conditions.friction.rate_and_state();
        let state = |history: &History| match law {
            Some(law) => history.of(|(side, node)| begun(law, stage.tractions.states[side][node])),
            None => 0.0,
        };
        let found: Vec<Option<(LocalTerm, NodeResult, Status)>> = (0..kept.len())
            .into_par_iter()
            .with_min_len(8)
            .map(|k| {
                let (side, node) = kept[k].place();
                let history = stage.histories.get(k);
                let contact_node = ContactNode {
                    side,
                    node,
                    kinematics: &stage.kinematics[k],
                    frame: stage.frames[side][node].as_ref()?,
                    textures: &stage.textures[side][node],
                    rate: &stage.rates[side][node],
                    slipped: stage.tractions.slipped[side][node],
                    accumulated: history.map_or(0.0, |history| history.slip),
                    friction_state: history.map_or(0.0, state),
                    factor: stage.factors.get(k),
                    freedom: stage.selection.slip_freedom(k),
                    before: stage.tractions.labels[side][node],
                    unknowns: stage.tractions.nodes[side][node],
                    tau: stage.tau[side][node].value,
                    derivatives: match conditions.wanted {
                        Some(wanted) if !wanted[side][node] => Derivatives::None,
                        _ => derivatives,
                    },
                };
                Some(rows(stage.configuration, &contact_node, conditions))
            })
            .collect();
        for (k, found) in found.into_iter().enumerate() {
            let Some((term, result, decided)) = found else {
                continue;
            };
            let (side, node) = kept[k].place();
            if decided != result.status {
                self.otherwise.push((side, node, decided));
            }
            // What a sticking node is away from where it sticks is residual, not slip; a creeping
            // one slips at any rate.
            let creeps = conditions.friction.rate_and_state().is_some();
            if result.status == Status::Slip || creeps && result.status == Status::Stick {
                let kinematics = &stage.kinematics[k];
                let weight = kinematics.slip_weight(stage.selection.weight(k));
                self.dissipated -= weight * result.tau.dot(&kinematics.slip.value);
            }
            let texture = self.nodes[side][node].texture;
            self.nodes[side][node] = NodeResult { texture, ..result };
            self.terms.push(term);
        }
    }

    /// Nodes that are not kept have the status of the kept node that they follow most.
    fn follow_status(&mut self, selection: &Selection) {
        for side in Side::BOTH {
            for node in SurfaceNode::all(selection.nodes(side)) {
                let row = selection.row(side, node);
                let most = row.iter().max_by(|a, b| a.1.total_cmp(&b.1));
                if let Some(&(k, _)) = most
                    && !selection.is_kept(side, node)
                {
                    let (side_k, node_k) = selection.kept()[k as usize].place();
                    let pressure = self.nodes[side][node].pressure;
                    self.nodes[side][node].status = if pressure > 0.0 {
                        self.nodes[side_k][node_k].status
                    } else {
                        Status::Open
                    };
                }
            }
        }
    }

    fn add_segments(&mut self, stage: &Stage, patches: Vec<Patch>) {
        let field = CommonField {
            configuration: stage.configuration,
            selection: stage.selection,
            frames: stage.frames,
            tau: stage.tau,
        };
        let mut forces = [Vec::new(), Vec::new()];
        let pair = stage.configuration.pair;
        for (term, facets, of_facets) in segment_terms(field, patches) {
            self.terms.push(term);
            for ((side, facet), of_facet) in
                pair.facing_sides().into_iter().zip(facets).zip(of_facets)
            {
                if let Some(facet) = facet
                    && pair.is_deformable(side)
                {
                    forces[side].push((facet, of_facet));
                }
            }
        }
        self.facets = forces.map(|forces| by_facet(forces.into_iter()));
    }

    /// Forces on the nodes over their areas.
    fn add_means(&mut self, configuration: &Configuration) {
        for &side in configuration.pair.deformable_sides() {
            let mut areas = vec![0.0; self.nodes[side].len()];
            for (facet, forces) in &self.facets[side] {
                let corners = configuration.side(side).corners(*facet);
                for (at, node) in corners.into_iter().enumerate() {
                    self.nodes[side][node].mean += forces.force[at];
                    areas[node] += forces.area[at];
                }
            }
            let nodes = self.nodes[side].iter_mut().zip(areas);
            nodes.for_each(|(node, area)| {
                node.mean = if area > 0.0 {
                    node.mean / area
                } else {
                    Vec3::zeros()
                };
            });
        }
    }

    fn add_facets(&mut self, stage: &Stage) {
        let nodal = collocated::nodal_fields(
            stage.configuration,
            stage.selection,
            stage.frames,
            stage.tractions,
            stage.tau,
        );
        let fields = Fields {
            configuration: stage.configuration,
            frames: stage.frames,
            nodal: &nodal,
        };
        for &side in stage.configuration.pair.deformable_sides() {
            let facets = stage.configuration.side(side).surface.facets();
            let results: Vec<_> = (0..facets.len())
                .into_par_iter()
                .with_min_len(8)
                .filter(|&index| {
                    let mut corners = facets[index].iter();
                    corners.all(|&node| stage.selection.carries(side, node))
                })
                .map(|index| {
                    let facet = FacetId::new(index);
                    (facet, facet_terms(&fields, side, facet))
                })
                .collect();
            for (facet, (terms, forces)) in results {
                self.terms.extend(terms);
                self.facets[side].push((facet, forces));
            }
        }
    }
}
