//! Conditions in force in each step, accumulated over the steps before it.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use striae_law::friction::Friction;
use striae_mesh::{Face, NodeId, Vec3};

use crate::{
    actuation::{Actuations, SectionActuation},
    model::{
        ActuationKind, Body, BodyId, Curve, Freedom, LoadExtent, LoadKind, Model, Moment, Step,
        Value,
    },
};

/// All that holds in one step.
#[derive(Clone, Debug)]
pub struct StepPlan {
    /// Its start.
    pub start: Moment,
    /// Prescribed components of displacement by `(body, node, axis)`.
    pub displacements: BTreeMap<(usize, usize, usize), Prescription>,
    /// Loads.
    pub loads: Vec<PlannedLoad>,
    /// Forces at nodes.
    pub forces: Vec<PlannedForce>,
    /// Actuation of sections.
    pub actuations: Vec<PlannedActuation>,
    /// Coordinates of every rigid body; `None` where they are free.
    pub rigid: Vec<[Option<Prescription>; 6]>,
    /// Driving force and torque of every rigid body.
    pub driving: Vec<[VectorPlan; 2]>,
    /// Friction of every pair.
    pub frictions: Vec<Friction>,
    /// Acceleration of gravity.
    pub gravity: VectorPlan,
}

/// Prescription of a displacement component or a coordinate in a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Prescription {
    /// The quantity stays at its value at the start of the step.
    Hold,
    /// The quantity moves to the target along the curve.
    Go {
        /// Value at `c = 1`.
        target: Value,
        /// Curve of the approach.
        curve: Curve,
    },
}

/// A load in a step.
#[derive(Clone, Debug)]
pub struct PlannedLoad {
    /// Facet set.
    pub set: String,
    /// The body.
    pub body: BodyId,
    /// Its faces.
    pub faces: Vec<Face>,
    /// Load at the start of the step.
    pub from: Option<LoadKind<Value>>,
    /// Target.
    pub to: LoadKind<Value>,
    /// Part of the faces that is loaded.
    pub extent: LoadExtent,
    /// Curve towards the target.
    pub curve: Curve,
}

/// Forces at nodes in a step.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedForce {
    /// Node set.
    pub set: String,
    /// The body.
    pub body: BodyId,
    /// Its nodes.
    pub nodes: Vec<NodeId>,
    /// Force at each node at the start of the step.
    pub from: Vector3<Value>,
    /// Target.
    pub to: Vector3<Value>,
    /// Curve towards the target.
    pub curve: Curve,
}

/// An actuation of a section in a step.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedActuation {
    /// Number of the body.
    pub body: usize,
    /// Number of the section, 0 being the body's own material.
    pub section: usize,
    /// Value at the start of the step.
    pub from: Option<ActuationKind>,
    /// Target.
    pub to: ActuationKind,
    /// Curve towards the target.
    pub curve: Curve,
}

/// A vector in a step.
#[derive(Clone, Debug, PartialEq)]
pub struct VectorPlan {
    /// At the start.
    pub from: Vec3,
    /// Target.
    pub to: Vec3,
    /// Curve towards the target.
    pub curve: Curve,
}

impl Prescription {
    /// Value at a moment of a step that finds the value `start`, of a point at `x` in the
    /// reference configuration where the value is `rest`.
    pub fn at(&self, [rest, start]: [f64; 2], x: &Vec3, moment: Moment) -> f64 {
        match self {
            Self::Hold => start,
            Self::Go { target, curve } => {
                let from = curve.origin(start, rest);
                from + (rest + target.at(x, moment.time) - from) * curve.at(moment)
            }
        }
    }

    /// First and second derivative of the value by the fraction of the step.
    pub fn rate(&self, [rest, start]: [f64; 2], x: &Vec3, moment: Moment) -> [f64; 2] {
        let Self::Go { target, curve } = self else {
            return [0.0, 0.0];
        };
        let way = rest + target.at(x, moment.time) - curve.origin(start, rest);
        let rate = curve.rate(moment);
        if !target.moves() {
            return [rate.first, rate.second].map(|rate| way * rate);
        }
        let [first, second] = target.rate(x, moment.time);
        let (first, second) = (
            first * moment.duration,
            second * moment.duration * moment.duration,
        );
        let c = curve.at(moment);
        [
            way * rate.first + first * c,
            way * rate.second + 2.0 * first * rate.first + second * c,
        ]
    }
}

impl PlannedLoad {
    /// The load at a moment of the step.
    pub fn at(&self, moment: Moment) -> LoadKind<Value> {
        let to = self.to.map(|value| value.frozen(moment.time));
        let from = self.curve.origin(self.from.as_ref(), None);
        to.between(from, self.curve.at(moment))
    }
}

impl PlannedForce {
    /// The force at a moment of the step, which no longer changes with time.
    pub fn at(&self, moment: Moment) -> Vector3<Value> {
        let from = self.curve.origin(self.from.clone(), NO_FORCE);
        self.to.zip_map(&from, |to, from| {
            to.frozen(moment.time).between(&from, self.curve.at(moment))
        })
    }

    /// Force at the end of the step, kept.
    fn held(&self, end: Moment) -> Self {
        let reached = self.at(end);
        Self {
            from: reached.clone(),
            to: reached,
            curve: Curve::Constant,
            ..self.clone()
        }
    }
}

const NO_FORCE: Vector3<Value> =
    Vector3::new(Value::Number(0.0), Value::Number(0.0), Value::Number(0.0));

impl PlannedActuation {
    /// The value at a moment of the step.
    pub fn at(&self, moment: Moment) -> ActuationKind {
        let from = self.curve.origin(self.from.as_ref(), None);
        self.to.between(from, self.curve.at(moment))
    }
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

impl VectorPlan {
    /// The vector at a moment of the step.
    pub fn at(&self, moment: Moment) -> Vec3 {
        let from = self.curve.origin(self.from, Vec3::zeros());
        from + (self.to - from) * self.curve.at(moment)
    }

    fn zero() -> Self {
        Self {
            from: Vec3::zeros(),
            to: Vec3::zeros(),
            curve: Curve::Constant,
        }
    }

    /// Copy in which values reached at the end of the step are held.
    fn held(&self, end: Moment) -> Self {
        Self {
            from: self.at(end),
            to: self.at(end),
            curve: Curve::Constant,
        }
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
        loads: Vec::new(),
        forces: Vec::new(),
        actuations: Vec::new(),
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
    StepPlan {
        start: before.start,
        displacements: displacements(before, step),
        loads: loads(before, step),
        forces: forces(before, step),
        actuations: actuations(before, step, bodies),
        rigid: rigid(before, step),
        driving: driving(before, step),
        gravity: gravity(before, step),
        frictions: frictions(before, step),
    }
}

fn displacements(before: &StepPlan, step: &Step) -> BTreeMap<(usize, usize, usize), Prescription> {
    let hold = |(key, _): (&(usize, usize, usize), &Prescription)| (*key, Prescription::Hold);
    let mut all: BTreeMap<_, _> = before.displacements.iter().map(hold).collect();
    for release in &step.releases {
        for node in &release.nodes {
            for axis in (0..3).filter(|&axis| release.components[axis]) {
                all.remove(&(release.body.0, node.index(), axis));
            }
        }
    }
    for condition in &step.displacements {
        for node in &condition.nodes {
            for (axis, component) in condition.components.iter().enumerate() {
                if let Some(target) = component.clone() {
                    let curve = condition.curve.clone();
                    let key = (condition.body.0, node.index(), axis);
                    all.insert(key, Prescription::Go { target, curve });
                }
            }
        }
    }
    all
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
