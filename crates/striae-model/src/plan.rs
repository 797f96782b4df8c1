//! Conditions in force in each step, accumulated over the steps before it.

mod planned;

use planned::NO_FORCE;
pub use planned::{
    Oblique, PlannedActuation, PlannedCavity, PlannedForce, PlannedLoad, Prescription, VectorPlan,
};

use std::collections::BTreeMap;

use striae_law::friction::Friction;
use striae_mesh::Vec3;

use crate::{
    actuation::{Actuations, SectionActuation},
    axes::{Axes, are_parallel},
    model::{Body, Curve, Freedom, LoadKind, Model, Moment, Step},
};

/// All that holds in one step.
#[derive(Clone, Debug)]
pub struct StepPlan {
    /// Its start.
    pub start: Moment,
    /// Prescribed components of displacement by `(body, node, axis)`, along the coordinate axes.
    pub displacements: BTreeMap<(usize, usize, usize), Prescription>,
    /// Prescribed components along other directions by `(body, node)`; none of a node is along a coordinate axis
    /// that is in `displacements`.
    pub oblique: BTreeMap<(usize, usize), Vec<Oblique>>,
    /// Loads.
    pub loads: Vec<PlannedLoad>,
    /// Forces at nodes.
    pub forces: Vec<PlannedForce>,
    /// Actuation of sections.
    pub actuations: Vec<PlannedActuation>,
    /// Content of every cavity.
    pub cavities: Vec<PlannedCavity>,
    /// Coordinates of every rigid body; `None` where they are free.
    pub rigid: Vec<[Option<Prescription>; 6]>,
    /// Driving force and torque of every rigid body.
    pub driving: Vec<[VectorPlan; 2]>,
    /// Friction of every pair.
    pub frictions: Vec<Friction>,
    /// Acceleration of gravity.
    pub gravity: VectorPlan,
}

impl StepPlan {
    /// Its end.
    pub fn end(&self) -> Moment {
        self.start.later(1.0)
    }

    /// Actuation of some bodies at the fraction `s` of the step.
    pub fn actuations(&self, bodies: &[Body], s: f64) -> Actuations {
        if self.actuations.is_empty() {
            return Actuations::default();
        }
        let none = |body: &Body| vec![SectionActuation::default(); body.sections.len() + 1];
        let mut all: Vec<Vec<SectionActuation>> = bodies.iter().map(none).collect();
        for planned in &self.actuations {
            all[planned.body][planned.section].add(&planned.at(self.start.later(s)));
        }
        Actuations { bodies: all }
    }
}

/// Starts of all steps of a model.
pub fn starts(model: &Model) -> Vec<Moment> {
    let mut time = 0.0;
    let start = |step: &Step| {
        let start = Moment {
            time,
            ..Moment::start(step.duration)
        };
        time = start.later(1.0).time;
        start
    };
    model.steps.iter().map(start).collect()
}

/// Plans of all steps of a model.
pub fn plans(model: &Model) -> Vec<StepPlan> {
    let mut plan = StepPlan {
        start: Moment::start(0.0),
        displacements: BTreeMap::new(),
        oblique: BTreeMap::new(),
        loads: Vec::new(),
        forces: Vec::new(),
        actuations: Vec::new(),
        cavities: vec![PlannedCavity::open(); model.cavities.len()],
        rigid: vec![[const { Some(Prescription::Hold) }; 6]; model.rigid_surfaces.len()],
        driving: vec![[VectorPlan::zero(), VectorPlan::zero()]; model.rigid_surfaces.len()],
        gravity: VectorPlan::zero(),
        frictions: model
            .pairs
            .iter()
            .map(|pair| pair.friction.clone())
            .collect(),
    };
    let mut plans = Vec::with_capacity(model.steps.len());
    for (step, start) in model.steps.iter().zip(starts(model)) {
        plan = StepPlan {
            start,
            ..next(&plan, step, &model.bodies)
        };
        plans.push(plan.clone());
    }
    plans
}

fn next(before: &StepPlan, step: &Step, bodies: &[Body]) -> StepPlan {
    let (displacements, oblique) = displacements(before, step, bodies);
    StepPlan {
        start: before.start,
        displacements,
        oblique,
        loads: loads(before, step),
        forces: forces(before, step),
        actuations: actuations(before, step, bodies),
        cavities: cavities(before, step),
        rigid: rigid(before, step),
        driving: driving(before, step),
        gravity: gravity(before, step),
        frictions: frictions(before, step),
    }
}

/// Prescribed components along the coordinate axes, and along other directions.
type Prescribed = (
    BTreeMap<(usize, usize, usize), Prescription>,
    BTreeMap<(usize, usize), Vec<Oblique>>,
);

fn displacements(before: &StepPlan, step: &Step, bodies: &[Body]) -> Prescribed {
    let hold = |(key, _): (&(usize, usize, usize), &Prescription)| (*key, Prescription::Hold);
    let mut all: BTreeMap<_, _> = before.displacements.iter().map(hold).collect();
    let held = |(key, of_node): (&(usize, usize), &Vec<Oblique>)| {
        (*key, of_node.iter().map(Oblique::held).collect())
    };
    let mut oblique: BTreeMap<_, Vec<Oblique>> = before.oblique.iter().map(held).collect();
    for release in &step.releases {
        for node in &release.nodes {
            for axis in (0..3).filter(|&axis| release.components[axis]) {
                all.remove(&(release.body.0, node.index(), axis));
            }
            if let Some(of_node) = oblique.get_mut(&(release.body.0, node.index())) {
                of_node.retain(|known| !release.components[known.component]);
            }
        }
    }
    for condition in &step.displacements {
        let body = condition.body.0;
        for node in &condition.nodes {
            let node = node.index();
            let directions = match condition.axes {
                Axes::Global => None,
                axes => Some(axes.directions(&bodies[body].mesh.positions[node])),
            };
            for (component, target) in condition.components.iter().enumerate() {
                let Some(target) = target.clone() else {
                    continue;
                };
                let curve = condition.curve.clone();
                let how = Prescription::Go { target, curve };
                let Some(directions) = &directions else {
                    if let Some(of_node) = oblique.get_mut(&(body, node)) {
                        let along = Vec3::ith(component, 1.0);
                        of_node.retain(|known| !are_parallel(&known.direction, &along));
                    }
                    all.insert((body, node, component), how);
                    continue;
                };
                if let Some(direction) = directions[component] {
                    for axis in 0..3 {
                        if are_parallel(&Vec3::ith(axis, 1.0), &direction) {
                            all.remove(&(body, node, axis));
                        }
                    }
                    let of_node = oblique.entry((body, node)).or_default();
                    of_node.retain(|known| !are_parallel(&known.direction, &direction));
                    of_node.push(Oblique {
                        component,
                        direction,
                        how,
                    });
                }
            }
        }
    }
    oblique.retain(|_, of_node| !of_node.is_empty());
    (all, oblique)
}

fn loads(before: &StepPlan, step: &Step) -> Vec<PlannedLoad> {
    let mut all: Vec<PlannedLoad> = before
        .loads
        .iter()
        .map(|load| held_load(load, before.end()))
        .collect();
    for load in &step.loads {
        let same = all.iter().position(|known| {
            known.body == load.body
                && known.set == load.set
                && known.extent == load.extent
                && known.to.is_like(&load.kind)
        });
        let planned = PlannedLoad {
            set: load.set.clone(),
            body: load.body,
            faces: load.faces.clone(),
            from: same.map(|at| all[at].to.clone()),
            to: load.kind.clone(),
            extent: load.extent,
            curve: load.curve.clone(),
        };
        match same {
            Some(at) => all[at] = planned,
            None => all.push(planned),
        }
    }
    // Decks list tractions and pressures apart, so that their order says nothing. Sums to the last
    // bit must not depend on it.
    all.sort_by_key(|load| matches!(load.to, LoadKind::Pressure(_)));
    all
}

fn held_load(load: &PlannedLoad, end: Moment) -> PlannedLoad {
    let reached = load.at(end);
    PlannedLoad {
        from: Some(reached.clone()),
        to: reached,
        curve: Curve::Constant,
        ..load.clone()
    }
}

fn forces(before: &StepPlan, step: &Step) -> Vec<PlannedForce> {
    let held = before.forces.iter().map(|force| force.held(before.end()));
    let mut all: Vec<PlannedForce> = held.collect();
    for stated in &step.forces {
        let same = all
            .iter()
            .position(|known| known.body == stated.body && known.set == stated.set);
        let planned = PlannedForce {
            set: stated.set.clone(),
            body: stated.body,
            nodes: stated.nodes.clone(),
            from: same.map_or(NO_FORCE, |at| all[at].to.clone()),
            to: stated.force.clone(),
            curve: stated.curve.clone(),
        };
        match same {
            Some(at) => all[at] = planned,
            None => all.push(planned),
        }
    }
    all
}

fn actuations(before: &StepPlan, step: &Step, bodies: &[Body]) -> Vec<PlannedActuation> {
    let held = |known: &PlannedActuation| {
        let reached = known.at(before.end());
        PlannedActuation {
            from: Some(reached),
            to: reached,
            curve: Curve::Constant,
            ..known.clone()
        }
    };
    let mut all: Vec<PlannedActuation> = before.actuations.iter().map(held).collect();
    for stated in &step.actuations {
        let body = stated.body.0;
        let sections = match stated.section {
            Some(section) => section..section + 1,
            None => 0..bodies[body].sections.len() + 1,
        };
        for section in sections {
            let same = all.iter().position(|known| {
                (known.body, known.section) == (body, section) && known.to.is_like(&stated.kind)
            });
            let planned = PlannedActuation {
                body,
                section,
                from: same.map(|at| all[at].to),
                to: stated.kind,
                curve: stated.curve.clone(),
            };
            match same {
                Some(at) => all[at] = planned,
                None => all.push(planned),
            }
        }
    }
    all
}

fn cavities(before: &StepPlan, step: &Step) -> Vec<PlannedCavity> {
    let mut all: Vec<_> = before.cavities.iter().map(PlannedCavity::held).collect();
    for filling in &step.fillings {
        all[filling.cavity.0] = PlannedCavity {
            content: filling.content,
            curve: Some(filling.curve.clone()),
        };
    }
    all
}

fn gravity(before: &StepPlan, step: &Step) -> VectorPlan {
    let held = before.gravity.held(before.end());
    match &step.gravity {
        None => held,
        Some(gravity) => VectorPlan {
            to: gravity.acceleration,
            curve: gravity.curve.clone(),
            ..held
        },
    }
}

fn rigid(before: &StepPlan, step: &Step) -> Vec<[Option<Prescription>; 6]> {
    let held = |coordinates: &[Option<Prescription>; 6]| {
        coordinates
            .each_ref()
            .map(|how| how.as_ref().map(|_| Prescription::Hold))
    };
    let mut all: Vec<_> = before.rigid.iter().map(held).collect();
    for motion in &step.rigid_motions {
        for (known, stated) in all[motion.surface.0].iter_mut().zip(motion.coordinates) {
            match stated {
                Freedom::AsBefore => {}
                Freedom::Free => *known = None,
                Freedom::To(target) => {
                    let (target, curve) = (target.into(), motion.curve.clone());
                    *known = Some(Prescription::Go { target, curve });
                }
            }
        }
    }
    all
}

fn driving(before: &StepPlan, step: &Step) -> Vec<[VectorPlan; 2]> {
    let held = |plans: &[VectorPlan; 2]| plans.each_ref().map(|plan| plan.held(before.end()));
    let mut all: Vec<_> = before.driving.iter().map(held).collect();
    for motion in &step.rigid_motions {
        let stated = [motion.force, motion.torque];
        for (plan, target) in all[motion.surface.0].iter_mut().zip(stated) {
            if let Some(target) = target {
                plan.to = target;
                plan.curve = motion.curve.clone();
            }
        }
    }
    all
}

fn frictions(before: &StepPlan, step: &Step) -> Vec<Friction> {
    let mut all = before.frictions.clone();
    for (pair, friction) in &step.frictions {
        all[pair.0] = friction.clone();
    }
    all
}
