//! A step of a scene, in its local frame.

use super::vector::Vector;

/// A step.
#[derive(Clone, Debug, Default)]
pub struct Step {
    /// Name.
    pub name: &'static str,
    /// Duration.
    pub duration: Option<f64>,
    /// Number of increments.
    pub increments: Option<usize>,
    /// Body, node set and displacement; components that are absent need a scene
    /// that is not rotated.
    pub displacements: Vec<(&'static str, &'static str, [Option<f64>; 3])>,
    /// Body and node set that become free.
    pub releases: Vec<(&'static str, &'static str)>,
    /// Body, facets, traction and the area it acts on.
    pub tractions: Vec<(&'static str, &'static str, Vector, f64)>,
    /// Rigid surface, displacement and angle about the vertical in degrees.
    pub rigid: Vec<(&'static str, Vector, Option<f64>)>,
    /// Free rigid bodies.
    pub drives: Vec<Drive>,
    /// Rigid body, velocity, spin and a point of its axis; makes the step dynamic.
    pub throws: Vec<(&'static str, Vector, Vector, Vector)>,
    /// Body and velocity; makes the step dynamic.
    pub velocities: Vec<(&'static str, Vector)>,
    /// Acceleration of gravity; makes the step dynamic.
    pub gravity: Option<Vector>,
    /// Spectral radius, which also makes the step dynamic.
    pub spectral_radius: Option<f64>,
    /// Requirement that the first pair touches at the end.
    pub end: End,
}

/// Requirement on the end of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum End {
    /// Either.
    #[default]
    Open,
    /// The pairs carry force.
    Touching,
    /// The pairs have carried force at some time.
    Met,
    /// The pairs carry none.
    Apart,
}

impl Step {
    /// A step of a name.
    pub fn new(name: &'static str) -> Self {
        Self {
            name,
            ..Self::default()
        }
    }

    /// Prescribes all components.
    pub fn moving(mut self, body: &'static str, nodes: &'static str, to: Vector) -> Self {
        self.displacements.push((body, nodes, to.map(Some)));
        self
    }

    /// Prescribes some components.
    pub fn holding(
        mut self,
        body: &'static str,
        nodes: &'static str,
        to: [Option<f64>; 3],
    ) -> Self {
        self.displacements.push((body, nodes, to));
        self
    }

    /// States what must be at its end.
    pub fn ending(self, end: End) -> Self {
        Self { end, ..self }
    }

    /// Sets the number of increments.
    pub fn within(self, increments: Option<usize>) -> Self {
        Self { increments, ..self }
    }

    /// Returns whether inertia acts.
    pub fn is_dynamic(&self) -> bool {
        let thrown = !self.velocities.is_empty() || !self.throws.is_empty();
        thrown || self.gravity.is_some() || self.spectral_radius.is_some()
    }
}

/// Forces on a rigid body that is free.
#[derive(Clone, Debug)]
pub struct Drive {
    /// Name.
    pub name: &'static str,
    /// Coordinates that are free, in space.
    pub free: &'static [&'static str],
    /// Force.
    pub force: Vector,
    /// Torque.
    pub torque: Vector,
}
