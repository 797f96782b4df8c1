//! Warnings: reasons to distrust a converged result.
//!
//! Each converged increment is judged, and the worst of every kind is kept for every
//! pair:
//!
//! Forces and pressures are judged over the largest of the pair so far, or over those of strains of
//! 4e-6 where these are larger: less is round-off.
//!
//! | kind | value | limit |
//! | --- | --- | --- |
//! | `mismatch` | sum of the resultants over the largest load of the pair so far, see [`crate::report::PairReport::load`] | 1e-6 |
//! | `moment` | sum of the moments over the same and the size of the contact zone | 1e-2 |
//! | `tension` | tensile nodal pressure over the largest pressure of the pair so far | 1e-6 |
//! | `penetration` | depth over the size of the smaller facets there, see [`crate::interference`] | 0.1 |
//! | `passage` | the same for what has passed through, see there | 0 |
//! | `coarse` | facet size over that which would do for the zone of contact, where the force of the pair is largest, see [`crate::audit`] | 1 |
//! | `overlap` | the same for bodies inside themselves or others where no pair sees it, over the smaller facet | 0.1 |
//! | `unfelt` | the same while the pair has no force at all, but at nodes that another pair presses | 0.02 |
//! | `creation` | negative friction work over the largest energy | 1e-6 |
//! | `gain` | work that friction does at a node that slips over all that it does on its side in an increment, see [`crate::audit`] | 0.01 |
//! | `contact` | energy that contact has made, beyond friction, over the largest external work or work of actuation | 0.1 |
//! | `imbalance` | energy found nowhere over the largest energy | 1e-3 |
//! | `integration` | energy that the time integration has made over the largest energy | 0.1 |
//! | `snap` | strain energy that an increment of a quasi-static step gains without work over the largest energy | 0.5 |
//! | `residual` | residual of an increment that was accepted above the tolerance, where the integrals of contact jump | - |
//! | `stabilisation` | work lost to [stabilisation](crate::stabilisation) in a step over its external work, work of actuation or change of strain energy, whichever is largest | 0.01 |
//! | `rotation` | largest angle, in radians, by which elements of linear elastic bodies turn | 0.1 |
//! | `tie-mismatch` | sum of the forces on the sides of a tie over the sum of nodal forces | 1e-6 |
//! | `tie-moment` | sum of the moments over the same and the root of the tied area | 1e-2 |
//! | `never-touched` | the smallest distance at the start; after a completed run | - |
//! | `never-meets` | the same, before the run | - |
//!
//! Longer than other files, as it is the one list of all checks.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};
use striae_contact::{
    initial::Fit,
    interference::{Interference, Kind as Interfering, SHARE, Spot},
    selection::deepest,
    side::Side,
};
use striae_mesh::{ElementId, NodeId, Vec3, significant};
use striae_surface::node::SurfaceNode;

use crate::{
    audit::{Doubt, LEAST_SHARE, coarse, doubts},
    interference::{Positions, between, beyond, within},
    newton::{Acceptance, InStep, Increment, Reach},
    offsets::meant_depth,
    outcome::Ending,
    problem::Problem,
    report::{PairReport, pairs, ties},
    share::Whole,
    skin::{BodyOverlap, overlaps},
    state::{Energies, State},
};
use striae_model::{
    Initial, Model, PairId, Procedure,
    initial::{fits, may_meet, other_name},
    node::GlobalNode,
};

/// Depth over the facet size from which nodes that nothing presses on are unfelt.
const UNFELT: f64 = 0.02;

/// Something that makes results doubtful, with the number it is judged by.
#[derive(Clone, Debug, PartialEq)]
pub struct Warning {
    /// Subject of the warning.
    pub kind: Kind,
    /// Name of the contact pair or tie, if it is about one.
    pub pair: Option<String>,
    /// Worst value.
    pub value: f64,
    /// Value above which there is a warning.
    pub limit: f64,
    /// Time of the worst value.
    pub time: f64,
    /// In a sentence.
    pub text: String,
}

/// Kinds of warnings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Kind {
    /// Resultants of the two sides differ.
    Mismatch,
    /// Moments of the two sides differ.
    Moment,
    /// Contact pulls.
    Tension,
    /// Bodies are inside each other.
    Penetration,
    /// Bodies are inside each other and no contact feels it.
    Unfelt,
    /// Facets are too coarse for the zone of contact.
    Coarse,
    /// Bodies are inside themselves or others where no pair sees it.
    Overlap,
    /// Bodies have passed through each other.
    Passage,
    /// Friction makes energy.
    Creation,
    /// Friction pushes a node along its slip.
    Gain,
    /// Contact makes energy that friction does not explain.
    Contact,
    /// Energy is found nowhere.
    Imbalance,
    /// The time integration makes energy.
    Integration,
    /// An increment has gained strain energy without work.
    Snap,
    /// An increment was accepted above the tolerance.
    Residual,
    /// Much of the work of a step is lost to stabilisation.
    Stabilisation,
    /// A body for small rotations turns by a large one.
    Rotation,
    /// Forces on the two sides of a tie differ.
    TieMismatch,
    /// Moments on the two sides of a tie differ.
    TieMoment,
    /// A pair has never touched.
    NeverTouched,
    /// A pair can never meet.
    NeverMeets,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 21] = [
        Self::Mismatch,
        Self::Moment,
        Self::Tension,
        Self::Penetration,
        Self::Unfelt,
        Self::Coarse,
        Self::Overlap,
        Self::Passage,
        Self::Creation,
        Self::Gain,
        Self::Contact,
        Self::Imbalance,
        Self::Integration,
        Self::Snap,
        Self::Residual,
        Self::Stabilisation,
        Self::Rotation,
        Self::TieMismatch,
        Self::TieMoment,
        Self::NeverTouched,
        Self::NeverMeets,
    ];

    /// Name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mismatch => "mismatch",
            Self::Moment => "moment",
            Self::Tension => "tension",
            Self::Penetration => "penetration",
            Self::Unfelt => "unfelt",
            Self::Coarse => "coarse",
            Self::Overlap => "overlap",
            Self::Passage => "passage",
            Self::Creation => "creation",
            Self::Gain => "gain",
            Self::Contact => "contact",
            Self::Imbalance => "imbalance",
            Self::Integration => "integration",
            Self::Snap => "snap",
            Self::Residual => "residual",
            Self::Stabilisation => "stabilisation",
            Self::Rotation => "rotation",
            Self::TieMismatch => "tie-mismatch",
            Self::TieMoment => "tie-moment",
            Self::NeverTouched => "never-touched",
            Self::NeverMeets => "never-meets",
        }
    }

    /// Value above which there is a warning.
    pub fn limit(self) -> f64 {
        match self {
            Self::Mismatch | Self::TieMismatch | Self::Tension | Self::Creation => 1e-6,
            Self::Moment | Self::TieMoment | Self::Stabilisation => 1e-2,
            Self::Penetration | Self::Overlap => SHARE,
            Self::Unfelt => UNFELT,
            Self::Gain => LEAST_SHARE,
            Self::Coarse => 1.0,
            Self::Rotation | Self::Contact | Self::Integration => 0.1,
            // A force that rises with the way does at least half of the work of its last value.
            Self::Snap => 0.5,
            Self::Imbalance => 1e-3,
            Self::Residual | Self::Passage | Self::NeverTouched | Self::NeverMeets => 0.0,
        }
    }
}

/// Findings about a run so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Judgement {
    /// The worst of every kind and pair.
    pub worst: Vec<Worst>,
    /// Largest load of every pair.
    pub loads: Vec<f64>,
    /// Largest pressure of every pair.
    pub pressures: Vec<f64>,
    /// Largest energy.
    pub energy: f64,
    /// Largest external work, or work of actuation.
    pub external: f64,
    /// Energy that the time integration has made.
    pub integrated: f64,
    /// Energies at the start of the step.
    pub step: Energies,
}

/// The worst of a kind.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Worst {
    /// The kind.
    pub kind: Kind,
    /// The pair, the tie or the body, if it is about one.
    pub pair: Option<usize>,
    /// The body and the node of its mesh, if it is about one.
    pub node: Option<(usize, NodeId)>,
    /// The value, but for energies over the largest one.
    pub value: f64,
    /// Facet size there, if it is about one.
    pub size: f64,
    /// Its time.
    pub time: f64,
}

impl Judgement {
    /// Judges a converged increment by what it came from; collective.
    pub fn converged(&mut self, problem: &Problem, before: &State, increment: &Increment) {
        self.doubts(&increment.doubts, increment.state.time);
        let tolerance = problem.model.solver.tolerance;
        if let Acceptance::AtJump { residual } = increment.acceptance
            && residual > tolerance
        {
            self.note(Kind::Residual, None, residual, increment.state.time);
        }
        self.change(
            problem,
            [before, &increment.state],
            increment.in_step,
            &increment.interferences,
            &increment.overlaps,
        );
    }

    /// Judges an increment from `before` to `after`, however it came about; collective.
    pub fn increment(&mut self, problem: &Problem, before: &State, after: &State, in_step: InStep) {
        let ends = [before, after].map(Positions::from);
        let pairs = 0..problem.pairs.len();
        let interferences = pairs.map(|pair| between(problem, pair, ends[0], ends[1], SHARE));
        self.doubts(&doubts(problem, before, after), after.time);
        let overlaps = overlaps(
            &problem.skin,
            &problem.share,
            [&before.positions, &after.positions],
        );
        let interferences = interferences.collect::<Vec<_>>();
        self.change(problem, [before, after], in_step, &interferences, &overlaps);
    }

    fn change(
        &mut self,
        problem: &Problem,
        [before, after]: [&State; 2],
        in_step: InStep,
        interferences: &[Vec<Interference>],
        overlaps: &[BodyOverlap],
    ) {
        self.loads.resize(problem.pairs.len(), 0.0);
        self.pressures.resize(problem.pairs.len(), 0.0);
        let least = round_off(problem);
        let energies = &after.energies;
        self.energy = self.energy.max(largest(energies)).max(least);
        self.external = (self.external.max(energies.external.abs()))
            .max(energies.actuation.abs())
            .max(least);
        self.note(Kind::Contact, None, after.gained, after.time);
        let imbalance = energies.imbalance().abs();
        self.note(Kind::Imbalance, None, imbalance, after.time);
        let step = problem.model.steps.get(in_step.step);
        let made = before.energies.numerical - energies.numerical;
        match step.map(|step| step.procedure) {
            // Increments of a quasi-static step lose and gain by their finite size alone.
            Some(Procedure::QuasiStatic) => self.note(Kind::Snap, None, made, after.time),
            Some(Procedure::Dynamic { .. }) => {
                self.integrated += made;
                self.note(Kind::Integration, None, self.integrated, after.time);
            }
            None => {}
        }
        if in_step.reach == Reach::End {
            self.stabilisation(after);
        }
        self.note(Kind::Rotation, None, rotation(problem, after), after.time);
        let reports = pairs(problem, after);
        for (pair, report) in reports.iter().enumerate() {
            self.pair(problem, pair, report, [before, after]);
            self.passage(pair, &interferences[pair], after.time);
            self.penetration(problem, pair, (after, in_step), report.max_pressure);
        }
        for overlap in overlaps {
            let share = overlap.found.share();
            self.note(Kind::Overlap, Some(overlap.body), share, after.time);
        }
        for (tie, report) in ties(problem, after).iter().enumerate() {
            self.note(Kind::TieMismatch, Some(tie), report.mismatch, after.time);
            self.note(
                Kind::TieMoment,
                Some(tie),
                report.moment_mismatch,
                after.time,
            );
        }
    }

    /// Judges a step at its end.
    fn stabilisation(&mut self, after: &State) {
        let [from, to] = [&self.step, &after.energies];
        let work = (to.external - from.external).abs();
        let work = work.max((to.actuation - from.actuation).abs());
        let scale = work.max((to.strain - from.strain).abs());
        let share = over(to.stabilisation - from.stabilisation, scale);
        self.note(Kind::Stabilisation, None, share, after.time);
        self.step = after.energies;
    }

    fn doubts(&mut self, doubts: &[Doubt], time: f64) {
        for doubt in doubts {
            self.note_at(match *doubt {
                Doubt::Gain(gain) => Worst {
                    kind: Kind::Gain,
                    pair: Some(gain.pair),
                    node: Some((gain.body, gain.node)),
                    value: gain.share,
                    size: 0.0,
                    time,
                },
            });
        }
    }

    fn pair(
        &mut self,
        problem: &Problem,
        pair: usize,
        report: &PairReport,
        [before, after]: [&State; 2],
    ) {
        let load = report.load();
        if load > self.loads[pair] {
            self.coarse(problem, pair, after);
        }
        self.loads[pair] = self.loads[pair].max(load);
        self.pressures[pair] = self.pressures[pair].max(report.max_pressure);
        let nodes = after.pairs[pair].nodes.iter().flatten();
        let tension = nodes.map(|node| -node.pressure).fold(0.0, f64::max);
        let created = before.pairs[pair].dissipated - after.pairs[pair].dissipated;
        let noise = pressure_of_round_off(problem, pair);
        let pressures = self.pressures[pair].max(noise);
        let area = report.sides[0].area.max(report.sides[1].area);
        let share = over(load, self.loads[pair].max(noise * area));
        for (kind, value) in [
            (Kind::Mismatch, report.mismatch * share),
            (Kind::Moment, report.moment_mismatch * share),
            (Kind::Tension, over(tension, pressures)),
            (Kind::Creation, created),
        ] {
            self.note(kind, Some(pair), value, after.time);
        }
    }

    /// Judges the facets where the force of a pair is the largest so far, in place of earlier ones.
    fn coarse(&mut self, problem: &Problem, pair: usize, after: &State) {
        self.worst
            .retain(|known| (known.kind, known.pair) != (Kind::Coarse, Some(pair)));
        if let Some(found) = coarse(problem, pair, after) {
            self.note_at(Worst {
                kind: Kind::Coarse,
                pair: Some(pair),
                node: Some((found.body, found.node)),
                value: found.size / found.enough,
                size: found.size,
                time: after.time,
            });
        }
    }

    fn passage(&mut self, pair: usize, found: &[Interference], time: f64) {
        let passed = found
            .iter()
            .filter(|found| found.kind != Interfering::Inside);
        let depths = passed.map(Interference::share);
        self.note(Kind::Passage, Some(pair), depths.fold(0.0, f64::max), time);
    }

    fn penetration(
        &mut self,
        problem: &Problem,
        pair: usize,
        (after, in_step): (&State, InStep),
        pressure: f64,
    ) {
        let time = after.time;
        // Overlaps of meshes that are being pressed out are meant.
        let resolving = problem.model.pairs[pair].initial == Initial::Resolve;
        let is_first = in_step.step == 0 && in_step.reach == Reach::Within;
        if resolving && is_first {
            return;
        }
        // Contact that is narrower than the facets of a smooth surface has a positive mean
        // gap, so nothing feels it.
        let unfelt = pressure == 0.0;
        let bound = if unfelt { UNFELT } else { SHARE };
        let mut inside = within(problem, pair, after.into(), bound);
        if !inside.is_empty() {
            let worn = deepest(&after.pairs[pair].tractions.worn);
            inside = beyond(inside, meant_depth(problem, pair, worn), bound);
        }
        if unfelt && !inside.is_empty() {
            // Faces of a body share edges, where the pair of either of them feels contact.
            let pressed = pressed_nodes(problem, after);
            inside.retain(|found| match found.spot {
                Spot::Node(node) => {
                    let node = problem.surface_node(pair, found.side, node);
                    node.is_none_or(|node| !pressed.contains(&node))
                }
                Spot::Centre(_) => true,
            });
        }
        let depths = inside.iter().map(|found| found.share());
        let deepest = depths.fold(0.0, f64::max);
        self.note(Kind::Penetration, Some(pair), deepest, time);
        if unfelt {
            self.note(Kind::Unfelt, Some(pair), deepest, time);
        }
    }

    fn note(&mut self, kind: Kind, pair: Option<usize>, value: f64, time: f64) {
        self.note_at(Worst {
            kind,
            pair,
            node: None,
            value,
            size: 0.0,
            time,
        });
    }

    fn note_at(&mut self, found: Worst) {
        if found.value <= 0.0 {
            return;
        }
        let same = |known: &&mut Worst| known.kind == found.kind && known.pair == found.pair;
        match self.worst.iter_mut().find(same) {
            Some(known) if known.value >= found.value => {}
            Some(known) => *known = found,
            None => self.worst.push(found),
        }
    }

    /// Warnings at the end of a run.
    pub fn warnings(&self, problem: &Problem, ending: &Ending) -> Vec<Warning> {
        let model = &problem.model;
        let (fits, mut warnings) = match problem.share.holding() {
            None => {
                let fits = fits(model);
                let warnings = warnings_at_start(model, &fits);
                (fits, warnings)
            }
            Some(holding) => {
                let Whole { fits, may_meet, .. } = &holding.whole;
                (fits.clone(), never(model, fits, |pair| may_meet[pair]))
            }
        };
        let mut worst: Vec<Worst> = self
            .worst
            .iter()
            .map(|worst| self.relative(worst))
            .collect();
        if *ending == Ending::Completed {
            for (pair, fit) in fits.iter().enumerate() {
                let named = warnings
                    .iter()
                    .any(|w| w.pair.as_ref() == Some(&model.pairs[pair].name));
                let is_expected = model.pairs[pair].is_expected_to_touch();
                let is_unloaded = self.loads.get(pair).is_none_or(|load| *load == 0.0);
                if is_expected && is_unloaded && !named {
                    worst.push(Worst {
                        kind: Kind::NeverTouched,
                        pair: Some(pair),
                        node: None,
                        value: fit.as_ref().map_or(0.0, |fit| fit.distance),
                        size: 0.0,
                        time: 0.0,
                    });
                }
            }
        }
        worst.retain(|worst| worst.kind == Kind::NeverTouched || worst.value > worst.kind.limit());
        worst.sort_by_key(|worst| (worst.kind, worst.pair));
        warnings.extend(worst.iter().map(|worst| warning(problem, worst)));
        warnings
    }

    /// Energies over the largest one, or the largest external work.
    fn relative(&self, worst: &Worst) -> Worst {
        let value = match worst.kind {
            Kind::Contact => over(worst.value, self.external),
            Kind::Creation | Kind::Imbalance | Kind::Integration | Kind::Snap => {
                over(worst.value, self.energy)
            }
            _ => worst.value,
        };
        Worst { value, ..*worst }
    }
}

/// Square of strains that are round-off, or as good as that.
const STRAIN_SQUARED: f64 = 2e-11;

/// Nodes that some pair presses.
fn pressed_nodes(problem: &Problem, state: &State) -> BTreeSet<GlobalNode> {
    let pairs = state.pairs.iter().enumerate();
    let sides = pairs.flat_map(|(pair, of)| Side::BOTH.map(|side| (pair, side, &of.nodes[side])));
    let nodes = sides.flat_map(|(pair, side, nodes)| {
        let pressed = nodes.iter().enumerate().filter(|(_, of)| of.pressure > 0.0);
        pressed
            .filter_map(move |(node, _)| problem.surface_node(pair, side, SurfaceNode::new(node)))
    });
    nodes.collect()
}

/// Pressure below which all is round-off: that of strains of 4e-6 or less in the stiffer one of the
/// sides. What is judged at a millionth of it is 2e4 units in the last place of its modulus.
fn pressure_of_round_off(problem: &Problem, pair: usize) -> f64 {
    let contact = &problem.pairs[pair].contact;
    let moduli = contact.deformable_sides().iter();
    let moduli = moduli.map(|&side| contact.sides[side].stiffness);
    STRAIN_SQUARED.sqrt() * moduli.fold(0.0, f64::max)
}

/// Energy below which all is round-off: that of strains of 4e-6 or less. Its balance is
/// judged at a thousandth, which is a hundred units in the last place of `G V`. Collective.
fn round_off(problem: &Problem) -> f64 {
    let bodies = problem.elements.iter().enumerate();
    let energies = bodies.map(|(body, elements)| {
        let energies = elements.iter().enumerate().map(|(at, element)| {
            let material = problem.material(body, ElementId::new(at));
            material.lame_constants().shear * element.volume()
        });
        energies.sum::<f64>()
    });
    STRAIN_SQUARED * problem.share.sum(energies.sum())
}

/// Largest angle by which elements of linear elastic bodies have turned; collective.
fn rotation(problem: &Problem, state: &State) -> f64 {
    let bodies = problem.model.bodies.iter().zip(&problem.elements);
    let angles = bodies.enumerate().filter(|(at, _)| is_linear(problem, *at));
    let angles = angles.map(|(at, (body, elements))| -> f64 {
        let turned = elements.iter().zip(body.mesh.elements()).enumerate();
        let linear = turned.filter(|(element, _)| {
            let material = problem.material(at, ElementId::new(*element));
            !material.is_objective()
        });
        let angles = linear.map(|(_, (element, corners))| {
            let nodes = problem.nodes(at, corners).into_iter();
            let x: Vec<Vec3> = nodes.map(|node| state.positions[node]).collect();
            element.rotation(&x)
        });
        angles.fold(0.0, f64::max)
    });
    problem.share.largest(angles.fold(0.0, f64::max))
}

fn is_linear(problem: &Problem, body: usize) -> bool {
    let used = problem.compositions[body].used_sections().iter();
    let mut materials = used.map(|section| problem.model.bodies[body].material_of(*section));
    materials.any(|material| !material.is_objective())
}

fn linear_text(problem: &Problem) -> String {
    let bodies = problem.model.bodies.iter().enumerate();
    let linear = bodies.filter(|(at, _)| is_linear(problem, *at));
    let names = linear.map(|(_, body)| format!("`{}`", body.name));
    let names: Vec<String> = names.collect();
    match &names[..] {
        [name] => format!("body {name} rotates by up to"),
        names => format!("one of the bodies {} rotates by up to", names.join(", ")),
    }
}

fn over(value: f64, scale: f64) -> f64 {
    if scale > 0.0 { value / scale } else { 0.0 }
}

fn largest(energies: &Energies) -> f64 {
    let Energies {
        kinetic,
        strain,
        external,
        actuation,
        inelastic,
        friction,
        contact,
        stabilisation,
        numerical,
    } = *energies;
    let all = [
        kinetic,
        strain,
        external,
        actuation,
        inelastic,
        friction,
        contact,
        stabilisation,
        numerical,
    ];
    all.into_iter()
        .fold(0.0, |most: f64, energy| most.max(energy.abs()))
}

fn warning(problem: &Problem, worst: &Worst) -> Warning {
    let model = &problem.model;
    let &Worst {
        kind,
        pair,
        node,
        value,
        size,
        time,
    } = worst;
    let place = node.map_or_else(String::new, |(body, node)| {
        format!("{node} of `{}`", model.bodies[body].name)
    });
    let name = match (kind, pair) {
        (Kind::TieMismatch | Kind::TieMoment, Some(tie)) => &model.ties[tie].name,
        (Kind::Overlap, Some(body)) => &model.bodies[body].name,
        (_, Some(pair)) => &model.pairs[pair].name,
        (_, None) => "",
    };
    let percent = 100.0 * value;
    let text = match kind {
        Kind::Mismatch => format!(
            "pair `{name}`: the forces on its sides differ by {value:.1e} of the load at time {time:.4}"
        ),
        Kind::Moment => format!(
            "pair `{name}`: the moments on its sides differ by {value:.1e} of load times size at time {time:.4}"
        ),
        Kind::Tension => format!(
            "pair `{name}`: contact is tensile by {value:.1e} of the largest pressure at time {time:.4}"
        ),
        Kind::Penetration => format!(
            "pair `{name}`: its sides penetrate each other by {percent:.0} % of the smaller facet size at time {time:.4}"
        ),
        Kind::Unfelt => format!(
            "pair `{name}`: its sides penetrate each other by {percent:.1} % of the facet size at time {time:.4}, unnoticed by contact; refine the coarser side there"
        ),
        Kind::Overlap => format!(
            "body `{name}` penetrates itself, or another body without a pair between them, by {percent:.0} % of the facet size at time {time:.4}"
        ),
        Kind::Coarse => format!(
            "pair `{name}`: facets of size {} at {place} are too coarse for the contact zone at time {time:.4}, where its force is largest; a size of {} suffices",
            significant(size, 3),
            significant(size / value, 2)
        ),
        Kind::Passage => {
            format!("pair `{name}`: its sides have passed through each other at time {time:.4}")
        }
        Kind::Creation => format!(
            "pair `{name}`: friction creates energy, {value:.1e} of the largest energy in the increment to time {time:.4}"
        ),
        Kind::Gain => format!(
            "pair `{name}`: friction pushes {place} in the direction of its slip in the increment to time {time:.4} and gains {percent:.0} % of the frictional work on its side"
        ),
        Kind::Contact => format!(
            "contact has created energy up to time {time:.4}, besides friction, of {percent:.0} % of the largest external work or work of actuation"
        ),
        Kind::Imbalance => {
            format!(
                "the energy balance is violated by {value:.1e} of the largest energy at time {time:.4}"
            )
        }
        Kind::Integration => format!(
            "the time integration has created energy up to time {time:.4}, of {percent:.0} % of the largest energy: take a smaller `spectral_radius`, or smaller increments"
        ),
        Kind::Snap => format!(
            "the increment to time {time:.4} has gained strain energy without work, {percent:.0} % of the largest energy: it may have jumped to another equilibrium, with elements folded; look at the deformed mesh there, and take smaller increments"
        ),
        Kind::Residual => format!(
            "the increment to time {time:.4} was accepted with a residual of {value:.1e}, above the tolerance of {:.1e}: corners of facets lie so close to opposing edges that the integrals of contact jump by as much",
            problem.model.solver.tolerance
        ),
        Kind::Stabilisation => format!(
            "stabilisation has dissipated {percent:.1} % of the work of the step that ends at time {time:.4}"
        ),
        Kind::Rotation => format!(
            "{} {:.0} degrees at time {time:.4}: linear elasticity turns rotations into strains, of {:.1e} here; use neo-hookean",
            linear_text(problem),
            value.to_degrees(),
            1.0 - value.cos()
        ),
        Kind::TieMismatch | Kind::TieMoment => tie_text(worst, name),
        Kind::NeverTouched => format!("pair `{name}` has never touched"),
        Kind::NeverMeets => format!("pair `{name}` can never meet"),
    };
    Warning {
        kind,
        pair: (kind != Kind::Overlap && pair.is_some()).then(|| name.to_owned()),
        value,
        limit: kind.limit(),
        time,
        text,
    }
}

fn tie_text(worst: &Worst, name: &str) -> String {
    let &Worst { value, time, .. } = worst;
    match worst.kind {
        Kind::TieMoment => format!(
            "tie `{name}`: the moments on its sides differ by {value:.1e} of its force times its size at time {time:.4}; prescribe all or none of the components of its edge nodes"
        ),
        _ => format!(
            "tie `{name}`: the forces on its sides differ by {value:.1e} of its force at time {time:.4}"
        ),
    }
}

impl std::fmt::Display for Warning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.text)
    }
}

/// Warnings about a model before it is run, given how its pairs fit.
pub fn warnings_at_start(model: &Model, fits: &[Option<Fit>]) -> Vec<Warning> {
    never(model, fits, |pair| {
        let fit = fits[pair].as_ref();
        fit.is_none_or(|fit| may_meet(model, PairId(pair), fit))
    })
}

/// Warnings of pairs that can never meet.
fn never(model: &Model, fits: &[Option<Fit>], may_meet: impl Fn(usize) -> bool) -> Vec<Warning> {
    let mut warnings = Vec::new();
    for (pair, fit) in fits.iter().enumerate() {
        let is_expected = model.pairs[pair].is_expected_to_touch();
        let fit = fit.as_ref().filter(|_| is_expected && !may_meet(pair));
        let pair = PairId(pair);
        if let Some(fit) = fit {
            let name = &model.pairs[pair.0].name;
            let [a, b] = [Side::B, Side::A].map(|side| other_name(model, pair, side));
            let distance = fit.distance;
            warnings.push(Warning {
                kind: Kind::NeverMeets,
                pair: Some(name.clone()),
                value: distance,
                limit: 0.0,
                time: 0.0,
                text: format!(
                    "pair `{name}` can never meet: `{a}` and `{b}` are {distance:.3e} apart, and no prescribed displacement closes this gap"
                ),
            });
        }
    }
    warnings
}
