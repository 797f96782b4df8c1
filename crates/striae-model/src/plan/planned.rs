//! Single conditions of a step: values at its start, targets and curves between them.

use nalgebra::Vector3;
use striae_mesh::{Face, NodeId, Vec3};

use crate::model::{
    ActuationKind, BodyId, CavityContent, Curve, LoadExtent, LoadKind, Moment, Value,
};

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

/// Prescription of a displacement along a direction that may be no coordinate axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Oblique {
    /// Component in the axes in which it was stated.
    pub component: usize,
    /// Unit vector along it.
    pub direction: Vec3,
    /// The prescription.
    pub how: Prescription,
}

impl Oblique {
    /// The prescription in a later step that does not state it.
    pub(super) fn held(&self) -> Self {
        Self {
            how: Prescription::Hold,
            ..self.clone()
        }
    }
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

/// Content of a cavity in a step.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedCavity {
    /// The content.
    pub content: CavityContent,
    /// Curve towards its target; `None` where it stays as it is.
    pub curve: Option<Curve>,
}

impl PlannedCavity {
    /// A cavity in which the pressure is that of the surroundings.
    pub(super) fn open() -> Self {
        Self {
            content: CavityContent::Pressure(0.0),
            curve: None,
        }
    }

    /// Content in a later step that does not state it.
    pub(super) fn held(&self) -> Self {
        Self {
            content: self.content,
            curve: None,
        }
    }
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
    pub(super) fn held(&self, end: Moment) -> Self {
        let reached = self.at(end);
        Self {
            from: reached.clone(),
            to: reached,
            curve: Curve::Constant,
            ..self.clone()
        }
    }
}

pub(super) const NO_FORCE: Vector3<Value> =
    Vector3::new(Value::Number(0.0), Value::Number(0.0), Value::Number(0.0));

impl PlannedActuation {
    /// The value at a moment of the step.
    pub fn at(&self, moment: Moment) -> ActuationKind {
        let from = self.curve.origin(self.from.as_ref(), None);
        self.to.between(from, self.curve.at(moment))
    }
}

impl VectorPlan {
    /// The vector at a moment of the step.
    pub fn at(&self, moment: Moment) -> Vec3 {
        let from = self.curve.origin(self.from, Vec3::zeros());
        from + (self.to - from) * self.curve.at(moment)
    }

    pub(super) fn zero() -> Self {
        Self {
            from: Vec3::zeros(),
            to: Vec3::zeros(),
            curve: Curve::Constant,
        }
    }

    /// Copy in which values reached at the end of the step are held.
    pub(super) fn held(&self, end: Moment) -> Self {
        Self {
            from: self.at(end),
            to: self.at(end),
            curve: Curve::Constant,
        }
    }
}
