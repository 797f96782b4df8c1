//! Conditions in force in each step, accumulated over the steps before it.

use std::collections::BTreeMap;

use striae_law::friction::Friction;
use striae_mesh::{Face, Vec3};

use crate::{
    actuation::{Actuations, SectionActuation},
    model::{ActuationKind, Body, BodyId, Curve, Freedom, LoadExtent, LoadKind, Model, Step},
};

/// All that holds in one step.
#[derive(Clone, Debug)]
pub struct StepPlan {
    /// Prescribed components of displacement by `(body, node, axis)`.
    pub displacements: BTreeMap<(usize, usize, usize), Prescription>,
    /// Loads.
    pub loads: Vec<PlannedLoad>,
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
        target: f64,
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
    pub from: Option<LoadKind>,
    /// Target.
    pub to: LoadKind,
    /// Part of the faces that is loaded.
    pub extent: LoadExtent,
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
    /// Value at the fraction `s` of a step that finds the value `start`.
    pub fn at(&self, start: f64, s: f64) -> f64 {
        match self {
            Self::Hold => start,
            Self::Go { target, curve } => start + (target - start) * curve.at(s),
        }
    }

    /// First and second derivative of the value by the fraction.
    pub fn rate(&self, start: f64, s: f64) -> [f64; 2] {
        match self {
            Self::Hold => [0.0, 0.0],
            Self::Go { target, curve } => {
                let rate = curve.rate(s);
                [rate.first, rate.second].map(|rate| (target - start) * rate)
            }
        }
    }
}

impl PlannedLoad {
    /// The load at the fraction `s` of the step.
    pub fn at(&self, s: f64) -> LoadKind {
        self.to.between(self.from.as_ref(), self.curve.at(s))
    }
}

impl PlannedActuation {
    /// The value at the fraction `s` of the step.
    pub fn at(&self, s: f64) -> ActuationKind {
        self.to.between(self.from.as_ref(), self.curve.at(s))
    }
}

impl StepPlan {
    /// Actuation of some bodies at the fraction `s` of the step.
    pub fn actuations(&self, bodies: &[Body], s: f64) -> Actuations {
        if self.actuations.is_empty() {
            return Actuations::default();
        }
        let none = |body: &Body| vec![SectionActuation::default(); body.sections.len() + 1];
        let mut all: Vec<Vec<SectionActuation>> = bodies.iter().map(none).collect();
        for planned in &self.actuations {
            all[planned.body][planned.section].add(&planned.at(s));
        }
        Actuations { bodies: all }
    }
}

impl VectorPlan {
    /// The vector at the fraction `s` of the step.
    pub fn at(&self, s: f64) -> Vec3 {
        self.from + (self.to - self.from) * self.curve.at(s)
    }

    fn zero() -> Self {
        Self {
            from: Vec3::zeros(),
            to: Vec3::zeros(),
            curve: Curve::Constant,
        }
    }

    /// Copy in which values reached at the end of the step are held.
    fn held(&self) -> Self {
        Self {
            from: self.at(1.0),
            to: self.at(1.0),
            curve: Curve::Constant,
        }
    }
}

/// Plans of all steps of a model.
pub fn plans(model: &Model) -> Vec<StepPlan> {
    let mut plan = StepPlan {
        displacements: BTreeMap::new(),
        loads: Vec::new(),
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
    for step in &model.steps {
        plan = next(&plan, step, &model.bodies);
        plans.push(plan.clone());
    }
    plans
}

fn next(before: &StepPlan, step: &Step, bodies: &[Body]) -> StepPlan {
    StepPlan {
        displacements: displacements(before, step),
        loads: loads(before, step),
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
                if let Some(target) = *component {
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
    let mut all: Vec<PlannedLoad> = before.loads.iter().map(held_load).collect();
    for load in &step.loads {
        let same = all.iter().position(|known| {
            known.body == load.body
                && known.set == load.set
                && known.extent == load.extent
                && std::mem::discriminant(&known.to) == std::mem::discriminant(&load.kind)
        });
        let planned = PlannedLoad {
            set: load.set.clone(),
            body: load.body,
            faces: load.faces.clone(),
            from: same.map(|at| all[at].to),
            to: load.kind,
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

fn held_load(load: &PlannedLoad) -> PlannedLoad {
    let reached = load.at(1.0);
    PlannedLoad {
        from: Some(reached),
        to: reached,
        curve: Curve::Constant,
        ..load.clone()
    }
}

fn actuations(before: &StepPlan, step: &Step, bodies: &[Body]) -> Vec<PlannedActuation> {
    let held = |known: &PlannedActuation| {
        let reached = known.at(1.0);
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
    let held = before.gravity.held();
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
                    let curve = motion.curve.clone();
                    *known = Some(Prescription::Go { target, curve });
                }
            }
        }
    }
    all
}

fn driving(before: &StepPlan, step: &Step) -> Vec<[VectorPlan; 2]> {
    let held = |plans: &[VectorPlan; 2]| plans.each_ref().map(VectorPlan::held);
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
