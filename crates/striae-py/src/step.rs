//! Steps under construction.
//!
//! Longer than other files, as it is the one list of all that a step can state.

use pyo3::{exceptions::PyValueError, prelude::*};
use striae::model::{
    ActuationKind, Axes, CavityContent, Clock, Component, Course, Curve, Freedom, Function,
    History, Increments, LoadExtent, LoadKind, StepBuilder, Value, actuation::strain_in_axes,
    equal_increments, step,
};

use crate::{fault::refused, friction::Friction};

/// Start value of a function.
#[derive(Clone)]
pub struct Start {
    /// Name of the body.
    pub body: String,
    /// Name of the node set.
    pub nodes: String,
    /// Component.
    pub axis: usize,
    /// Displacement.
    pub value: f64,
    /// Largest change from it.
    pub change: f64,
}

/// The name of a curve, its points, or a clock with a period, points and the text of a function.
#[derive(FromPyObject)]
pub enum Along {
    Word(String),
    Points(Vec<(f64, f64)>),
    Course(String, Option<f64>, Vec<(f64, f64)>, String),
}

/// A number, or the text of a function of position and time.
#[derive(FromPyObject)]
pub enum Target {
    Number(f64),
    Function(String),
}

impl Target {
    fn value(self) -> PyResult<Value> {
        match self {
            Self::Number(number) => Ok(number.into()),
            Self::Function(text) => Ok(function(&text)?.into()),
        }
    }
}

fn function(text: &str) -> PyResult<Function> {
    Function::new(text).map_err(|fault| PyValueError::new_err(fault.to_string()))
}

/// Refuses a text that is no function of position and time.
#[pyfunction]
pub fn check_function(text: &str, path: &str) -> PyResult<()> {
    let read = Function::new(text).map(|_| ());
    read.map_err(|fault| refused(path, fault))
}

/// Returns whether a function of position and time changes with time.
#[pyfunction]
pub fn moves(text: &str) -> PyResult<bool> {
    function(text).map(|function| function.moves())
}

/// Returns whether a function of position and time is the same everywhere.
#[pyfunction]
pub fn is_uniform(text: &str) -> PyResult<bool> {
    function(text).map(|function| function.is_uniform())
}

impl Along {
    /// The curve.
    pub fn curve(self) -> PyResult<Curve> {
        match self {
            Self::Points(points) => Ok(Curve::Table(points)),
            Self::Course(clock, period, points, text) => {
                let clock = match clock.as_str() {
                    "step" => Clock::Step,
                    _ => Clock::Run,
                };
                let course = match (period, text.as_str()) {
                    (Some(period), "") => Course::Periodic { points, period },
                    (None, "") => Course::Table(points),
                    (_, text) => Course::Function(function(text)?),
                };
                Ok(match (clock, course) {
                    (Clock::Step, Course::Table(points)) => Curve::Table(points),
                    (clock, course) => Curve::History(History { clock, course }),
                })
            }
            Self::Word(word) => match word.as_str() {
                "ramp" => Ok(Curve::Ramp),
                "constant" => Ok(Curve::Constant),
                "smooth" => Ok(Curve::Smooth),
                _ => Err(PyValueError::new_err(format!("no curve is named `{word}`"))),
            },
        }
    }
}

/// A step.
#[pyclass(module = "striae._striae")]
pub struct Step(
    /// Builder of the step.
    pub StepBuilder,
    /// Start values of functions of displacement.
    pub Vec<Start>,
);

impl Step {
    fn build(&mut self, add: impl FnOnce(StepBuilder) -> StepBuilder) {
        self.0 = add(self.0.clone());
    }
}

#[pymethods]
impl Step {
    #[new]
    fn new(name: &str, duration: f64) -> Self {
        Self(step(name).duration(duration), Vec::new())
    }

    fn equal(&mut self, number: usize) {
        self.build(|step| step.increment_sizes(equal_increments(number)));
    }

    fn sizes(&mut self, initial: f64, smallest: f64, largest: f64) {
        let sizes = Increments {
            initial,
            smallest,
            largest,
        };
        self.build(|step| step.increment_sizes(sizes));
    }

    fn dynamic(&mut self, spectral_radius: f64) {
        self.build(|step| step.dynamic(spectral_radius));
    }

    fn displace(
        &mut self,
        body: &str,
        nodes: &str,
        axes: (String, Vec<[f64; 3]>),
        components: [Option<Target>; 3],
        along: Along,
    ) -> PyResult<()> {
        let curve = along.curve()?;
        let (kind, vectors) = axes;
        let axes = match (kind.as_str(), &vectors[..]) {
            ("normal", [normal]) => Axes::Normal((*normal).into()),
            ("two", [x, y]) => Axes::Skew {
                x: (*x).into(),
                y: (*y).into(),
            },
            ("cylindrical", [point, axis]) => Axes::Cylindrical {
                point: (*point).into(),
                axis: (*axis).into(),
            },
            _ => Axes::Global,
        };
        let mut targets = [None, None, None];
        for (target, stated) in targets.iter_mut().zip(components) {
            *target = stated.map(Target::value).transpose()?;
        }
        self.build(|step| step.displace_in(axes, body, nodes, targets).along(curve));
        Ok(())
    }

    /// Leads a component of a displacement along a function that begins at the start
    /// of the range and whose points have shares of its change.
    fn lead(
        &mut self,
        body: String,
        nodes: String,
        axis: usize,
        range: [f64; 2],
        points: Vec<(f64, f64)>,
    ) {
        let [start, change] = range;
        let mut components = [None; 3];
        components[axis] = Some(start + change);
        let curve = Curve::Table(points);
        self.build(|step| step.displace(&*body, &*nodes, components).along(curve));
        self.1.push(Start {
            body,
            nodes,
            axis,
            value: start,
            change,
        });
    }

    /// Sets components free, all that are prescribed where none is named.
    fn release(&mut self, body: &str, nodes: &str, components: Vec<usize>) {
        let axes = [Component::X, Component::Y, Component::Z];
        let chosen = components.iter().filter_map(|axis| axes.get(*axis));
        let chosen: Vec<Component> = chosen.copied().collect();
        self.build(|step| match &chosen[..] {
            [] => step.release_all(body, nodes),
            chosen => step.release(body, nodes, chosen),
        });
    }

    fn pressure(
        &mut self,
        body: &str,
        facets: &str,
        pressure: Target,
        exposed: bool,
        along: Along,
    ) -> PyResult<()> {
        let kind = LoadKind::Pressure(pressure.value()?);
        self.load(body, facets, kind, exposed, along)
    }

    fn traction(
        &mut self,
        body: &str,
        facets: &str,
        traction: [Target; 3],
        follower: bool,
        exposed: bool,
        along: Along,
    ) -> PyResult<()> {
        let [x, y, z] = traction.map(Target::value);
        let traction = [x?, y?, z?];
        let kind = if follower {
            LoadKind::FollowerTraction(traction.into())
        } else {
            LoadKind::DeadTraction(traction.into())
        };
        self.load(body, facets, kind, exposed, along)
    }

    fn force(
        &mut self,
        body: &str,
        nodes: &str,
        force: [Target; 3],
        each: bool,
        along: Along,
    ) -> PyResult<()> {
        let curve = along.curve()?;
        let [x, y, z] = force.map(Target::value);
        let force = [x?, y?, z?];
        self.build(|step| {
            let pulled = match each {
                true => step.force_at_each(body, nodes, force),
                false => step.force(body, nodes, force),
            };
            pulled.along(curve)
        });
        Ok(())
    }

    /// A strain without stress by its components `xx`, `yy`, `zz`, `xy`, `yz`, `zx`.
    fn strain(
        &mut self,
        body: &str,
        section: Option<&str>,
        components: [f64; 6],
        axes: [[f64; 3]; 2],
        along: Along,
    ) -> PyResult<()> {
        let strain = strain_in_axes(components, axes.map(Into::into));
        let strain = strain.ok_or_else(|| PyValueError::new_err("the axes do not span a plane"))?;
        self.actuate(body, section, ActuationKind::Strain(strain), along)
    }

    fn fibre_strain(
        &mut self,
        body: &str,
        section: Option<&str>,
        strain: f64,
        along: Along,
    ) -> PyResult<()> {
        self.actuate(body, section, ActuationKind::FibreStrain(strain), along)
    }

    fn warm(
        &mut self,
        body: &str,
        section: Option<&str>,
        expansion: f64,
        temperature: f64,
        along: Along,
    ) -> PyResult<()> {
        let kind = ActuationKind::Thermal {
            expansion,
            temperature,
        };
        self.actuate(body, section, kind, along)
    }

    /// Pressure, volume or ratio of the volume of a cavity, by the word for it.
    fn fill(&mut self, cavity: &str, kind: &str, target: f64, along: Along) -> PyResult<()> {
        let curve = along.curve()?;
        let content = match kind {
            "pressure" => CavityContent::Pressure(target),
            "volume" => CavityContent::Volume(target),
            _ => CavityContent::VolumeRatio(target),
        };
        self.build(|step| step.fill(cavity, content).along(curve));
        Ok(())
    }

    fn seal(&mut self, cavity: &str, ambient: f64, exponent: f64) {
        let content = CavityContent::Gas { ambient, exponent };
        self.build(|step| step.fill(cavity, content));
    }

    /// A tension along a unit vector, or along fibres.
    fn pull(
        &mut self,
        body: &str,
        section: Option<&str>,
        tension: f64,
        line: Option<[f64; 3]>,
        along: Along,
    ) -> PyResult<()> {
        let kind = match line {
            Some(line) => ActuationKind::Tension {
                along: line.into(),
                value: tension,
            },
            None => ActuationKind::FibreTension(tension),
        };
        self.actuate(body, section, kind, along)
    }

    fn gravity(&mut self, acceleration: [f64; 3], along: Along) -> PyResult<()> {
        let curve = along.curve()?;
        self.build(|step| step.gravity(acceleration).along(curve));
        Ok(())
    }

    /// Targets of the coordinates of a rigid body, the angles in degrees, and which are free.
    fn move_rigid(
        &mut self,
        name: &str,
        targets: [Option<f64>; 6],
        free: [bool; 6],
        force: Option<[f64; 3]>,
        torque: Option<[f64; 3]>,
        along: Along,
    ) -> PyResult<()> {
        let curve = along.curve()?;
        let coordinates = std::array::from_fn(|at| match targets[at] {
            _ if free[at] => Freedom::Free,
            Some(angle) if at >= 3 => Freedom::To(angle.to_radians()),
            Some(target) => Freedom::To(target),
            None => Freedom::AsBefore,
        });
        let (force, torque) = (force.map(Into::into), torque.map(Into::into));
        self.build(|step| {
            let driven = step.drive_rigid(name, coordinates, force, torque);
            driven.along(curve)
        });
        Ok(())
    }

    fn velocity(&mut self, body: &str, v: [f64; 3], spin: [f64; 3], about: [f64; 3]) {
        self.build(|step| step.velocity(body, v).spinning(spin, about));
    }

    fn rigid_velocity(&mut self, name: &str, v: [f64; 3], spin: [f64; 3], about: [f64; 3]) {
        self.build(|step| step.rigid_velocity(name, v).spinning(spin, about));
    }

    fn friction(&mut self, pair: &str, friction: PyRef<'_, Friction>) {
        self.build(|step| step.friction(pair, friction.0.clone()));
    }
}

impl Step {
    fn actuate(
        &mut self,
        body: &str,
        section: Option<&str>,
        kind: ActuationKind,
        along: Along,
    ) -> PyResult<()> {
        let curve = along.curve()?;
        self.build(|step| {
            let actuated = match section {
                Some(section) => step.actuate_section(body, section, kind),
                None => step.actuate(body, kind),
            };
            actuated.along(curve)
        });
        Ok(())
    }

    fn load(
        &mut self,
        body: &str,
        facets: &str,
        kind: LoadKind<Value>,
        exposed: bool,
        along: Along,
    ) -> PyResult<()> {
        let curve = along.curve()?;
        let extent = if exposed {
            LoadExtent::Exposed
        } else {
            LoadExtent::Whole
        };
        self.build(|step| step.load(body, facets, kind, extent).along(curve));
        Ok(())
    }
}
