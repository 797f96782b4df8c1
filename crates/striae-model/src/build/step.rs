//! Steps and their conditions.
//!
//! Longer than other files, as it is the one list of all that a step can state.

use std::collections::{BTreeMap, BTreeSet};

use crate::{
    check::Known,
    fault::Fault,
    model::{
        Actuation, ActuationKind, Axes, BodyId, CavityContent, CavityFilling, Curve, Displacement,
        Freedom, Gravity, Increments, Load, LoadExtent, LoadKind, Mover, NodalForce, Procedure,
        Release, RigidMotion, Step, Value, Velocity,
    },
    path::Path,
};
use nalgebra::Vector3;
use striae_law::friction::Friction;
use striae_mesh::{NodeId, Vec3};

use super::lookup::Names;

/// Smallest increment over the first one, where nothing else is said.
const SMALLEST_OVER_INITIAL: f64 = 1e-3;

/// So many equal increments, which are cut where they must be.
pub fn equal_increments(number: usize) -> Increments {
    let size = 1.0 / number as f64;
    Increments {
        initial: size,
        smallest: size * SMALLEST_OVER_INITIAL,
        largest: size,
    }
}

/// Targets of the components of a displacement; `None` leaves a component as it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Components(pub [Option<Value>; 3]);

impl From<[f64; 3]> for Components {
    fn from(targets: [f64; 3]) -> Self {
        Self(targets.map(|target| Some(target.into())))
    }
}

impl From<[Option<f64>; 3]> for Components {
    fn from(targets: [Option<f64>; 3]) -> Self {
        Self(targets.map(|target| target.map(Value::from)))
    }
}

impl From<[Option<Value>; 3]> for Components {
    fn from(targets: [Option<Value>; 3]) -> Self {
        Self(targets)
    }
}

impl Components {
    /// Returns whether a target changes with time.
    fn move_on(&self) -> bool {
        self.0.iter().flatten().any(Value::moves)
    }
}

/// Curve along which a target is approached where nothing else is said: one that changes with
/// time is followed from the start.
pub fn usual_curve(moves: bool) -> Curve {
    match moves {
        true => Curve::Constant,
        false => Curve::Ramp,
    }
}

/// A component of a displacement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// Along `x`.
    X,
    /// Along `y`.
    Y,
    /// Along `z`.
    Z,
}

/// A set of a body, by names.
type Place = (String, String);

/// A step under construction; see [`step`].
#[derive(Clone, Debug)]
pub struct StepBuilder {
    step: Step,
    displacements: Vec<(Place, Axes, Components, Curve)>,
    releases: Vec<(Place, Released)>,
    loads: Vec<(Place, LoadKind<Value>, LoadExtent, Curve)>,
    forces: Vec<(Place, Spread, Curve)>,
    actuations: Vec<(String, Option<String>, ActuationKind, Curve)>,
    fillings: Vec<(String, CavityContent, Curve)>,
    motions: Vec<(String, RigidMotion)>,
    velocities: Vec<(Owner, Velocity)>,
    frictions: Vec<(String, Friction)>,
    last: Last,
}

/// A force at nodes.
#[derive(Clone, Debug, PartialEq)]
enum Spread {
    /// At each of them.
    Each(Vector3<Value>),
    /// At all of them together, in equal parts.
    Total(Vector3<Value>),
}

/// The part of a force that each of so many nodes takes.
pub fn shared_force(total: &Vector3<Value>, nodes: usize) -> Vector3<Value> {
    total.map(|component| component.times(1.0 / nodes as f64))
}
/// Components that a release sets free.
#[derive(Clone, Copy, Debug)]
enum Released {
    /// The components given here.
    Chosen([bool; 3]),
    /// All that are prescribed.
    Prescribed,
}

#[derive(Clone, Debug)]
enum Owner {
    Body(String),
    Rigid(String),
}

/// Condition stated last.
#[derive(Clone, Copy, Debug)]
enum Last {
    Nothing,
    Displacement,
    Load,
    Force,
    Actuation,
    Filling,
    Motion,
    Velocity,
    Gravity,
}

/// A step without inertia, of duration 1 in ten equal increments.
pub fn step(name: impl Into<String>) -> StepBuilder {
    StepBuilder {
        step: Step {
            name: name.into(),
            duration: 1.0,
            procedure: Procedure::QuasiStatic,
            increments: equal_increments(10),
            velocities: Vec::new(),
            gravity: None,
            displacements: Vec::new(),
            releases: Vec::new(),
            loads: Vec::new(),
            forces: Vec::new(),
            actuations: Vec::new(),
            fillings: Vec::new(),
            rigid_motions: Vec::new(),
            frictions: Vec::new(),
        },
        displacements: Vec::new(),
        releases: Vec::new(),
        loads: Vec::new(),
        forces: Vec::new(),
        actuations: Vec::new(),
        fillings: Vec::new(),
        motions: Vec::new(),
        velocities: Vec::new(),
        frictions: Vec::new(),
        last: Last::Nothing,
    }
}

impl StepBuilder {
    /// Duration in (pseudo) time.
    pub fn duration(mut self, duration: f64) -> Self {
        self.step.duration = duration;
        self
    }

    /// So many equal increments.
    pub fn increments(self, number: usize) -> Self {
        self.increment_sizes(equal_increments(number))
    }

    /// Increments of these sizes, over the duration.
    pub fn increment_sizes(mut self, increments: Increments) -> Self {
        self.step.increments = increments;
        self
    }

    /// Gives the step inertia; see [`Procedure::Dynamic`].
    pub fn dynamic(mut self, spectral_radius: f64) -> Self {
        self.step.procedure = Procedure::Dynamic { spectral_radius };
        self
    }

    /// Takes a node set to a displacement from its reference positions.
    pub fn displace(
        self,
        body: impl Into<String>,
        nodes: impl Into<String>,
        components: impl Into<Components>,
    ) -> Self {
        self.displace_in(Axes::Global, body, nodes, components)
    }

    /// Takes a node set to a displacement from its reference positions with these components in
    /// axes of its own, which stay as they are in the reference configuration. Components that
    /// are `None` keep their state: with [`Axes::Normal`] and the first one alone nodes slide on
    /// a plane.
    pub fn displace_in(
        mut self,
        axes: Axes,
        body: impl Into<String>,
        nodes: impl Into<String>,
        components: impl Into<Components>,
    ) -> Self {
        let place = (body.into(), nodes.into());
        let components = components.into();
        let curve = usual_curve(components.move_on());
        self.displacements.push((place, axes, components, curve));
        self.last = Last::Displacement;
        self
    }

    /// Holds a node set at its reference positions.
    pub fn hold(self, body: impl Into<String>, nodes: impl Into<String>) -> Self {
        self.displace(body, nodes, [0.0; 3])
    }

    /// Ends prescribed displacements of a node set in these components, in whatever axes they were
    /// stated.
    pub fn release(
        mut self,
        body: impl Into<String>,
        nodes: impl Into<String>,
        components: &[Component],
    ) -> Self {
        let components =
            [Component::X, Component::Y, Component::Z].map(|one| components.contains(&one));
        let place = (body.into(), nodes.into());
        self.releases.push((place, Released::Chosen(components)));
        self
    }

    /// Ends all prescribed displacements of a node set.
    pub fn release_all(mut self, body: impl Into<String>, nodes: impl Into<String>) -> Self {
        let place = (body.into(), nodes.into());
        self.releases.push((place, Released::Prescribed));
        self
    }

    /// Loads a facet set.
    pub fn load(
        mut self,
        body: impl Into<String>,
        facets: impl Into<String>,
        kind: impl Into<LoadKind<Value>>,
        extent: LoadExtent,
    ) -> Self {
        let place = (body.into(), facets.into());
        let kind = kind.into();
        let curve = usual_curve(kind.moves());
        self.loads.push((place, kind, extent, curve));
        self.last = Last::Load;
        self
    }

    /// Presses on a facet set.
    pub fn pressure(
        self,
        body: impl Into<String>,
        facets: impl Into<String>,
        pressure: impl Into<Value>,
    ) -> Self {
        let kind = LoadKind::Pressure(pressure.into());
        self.load(body, facets, kind, LoadExtent::Whole)
    }

    /// Pulls on a facet set with a force per reference area.
    pub fn traction(
        self,
        body: impl Into<String>,
        facets: impl Into<String>,
        traction: impl Into<Vec3>,
    ) -> Self {
        let kind = LoadKind::DeadTraction(traction.into());
        self.load(body, facets, kind, LoadExtent::Whole)
    }

    /// Pulls on a node set with a force that all its nodes take in equal parts.
    pub fn force(
        self,
        body: impl Into<String>,
        nodes: impl Into<String>,
        total: impl Into<Vector3<Value>>,
    ) -> Self {
        self.with_force((body.into(), nodes.into()), Spread::Total(total.into()))
    }

    /// Pulls on each node of a set with a force.
    pub fn force_at_each(
        self,
        body: impl Into<String>,
        nodes: impl Into<String>,
        force: impl Into<Vector3<Value>>,
    ) -> Self {
        self.with_force((body.into(), nodes.into()), Spread::Each(force.into()))
    }

    fn with_force(mut self, place: Place, spread: Spread) -> Self {
        let (Spread::Each(force) | Spread::Total(force)) = &spread;
        let curve = usual_curve(force.iter().any(Value::moves));
        self.forces.push((place, spread, curve));
        self.last = Last::Force;
        self
    }

    /// Takes a strain without stress, or a tension, of all of a body to a target.
    pub fn actuate(self, body: impl Into<String>, kind: ActuationKind) -> Self {
        self.with_actuation(body.into(), None, kind)
    }

    /// Actuates one of its sections, by the name of the element set.
    pub fn actuate_section(
        self,
        body: impl Into<String>,
        section: impl Into<String>,
        kind: ActuationKind,
    ) -> Self {
        self.with_actuation(body.into(), Some(section.into()), kind)
    }

    fn with_actuation(
        mut self,
        body: String,
        section: Option<String>,
        kind: ActuationKind,
    ) -> Self {
        self.actuations.push((body, section, kind, Curve::Ramp));
        self.last = Last::Actuation;
        self
    }

    /// Takes the content of a cavity to a target, or seals in the gas that is there.
    pub fn fill(mut self, cavity: impl Into<String>, content: CavityContent) -> Self {
        self.fillings.push((cavity.into(), content, Curve::Ramp));
        self.last = Last::Filling;
        self
    }

    /// Takes gravity to an acceleration.
    pub fn gravity(mut self, acceleration: impl Into<Vec3>) -> Self {
        self.step.gravity = Some(Gravity {
            acceleration: acceleration.into(),
            curve: Curve::Ramp,
        });
        self.last = Last::Gravity;
        self
    }

    /// Takes coordinates of a rigid body to targets: displacement of its reference
    /// point, angles in radians.
    pub fn move_rigid(self, name: impl Into<String>, coordinates: [Freedom; 6]) -> Self {
        self.drive_rigid(name, coordinates, None, None)
    }

    /// Drives a rigid body, with a force at the reference point and a torque on its free
    /// coordinates.
    pub fn drive_rigid(
        mut self,
        name: impl Into<String>,
        coordinates: [Freedom; 6],
        force: Option<Vec3>,
        torque: Option<Vec3>,
    ) -> Self {
        let motion = RigidMotion {
            surface: crate::model::RigidId(0),
            coordinates,
            force,
            torque,
            curve: Curve::Ramp,
        };
        self.motions.push((name.into(), motion));
        self.last = Last::Motion;
        self
    }

    /// Gives a deformable body a velocity at the start of the step.
    pub fn velocity(self, body: impl Into<String>, velocity: impl Into<Vec3>) -> Self {
        self.with_velocity(Owner::Body(body.into()), velocity.into())
    }

    /// Gives a rigid body a velocity at the start of the step.
    pub fn rigid_velocity(self, name: impl Into<String>, velocity: impl Into<Vec3>) -> Self {
        self.with_velocity(Owner::Rigid(name.into()), velocity.into())
    }

    fn with_velocity(mut self, owner: Owner, velocity: Vec3) -> Self {
        let velocity = Velocity {
            body: Mover::Deformable(BodyId(0)),
            velocity,
            spin: Vec3::zeros(),
            about: Vec3::zeros(),
        };
        self.velocities.push((owner, velocity));
        self.last = Last::Velocity;
        self
    }

    /// Adds a spin (radians per time) about an axis through a point to the velocity that
    /// was stated last.
    pub fn spinning(mut self, spin: impl Into<Vec3>, about: impl Into<Vec3>) -> Self {
        if let (Last::Velocity, Some((_, velocity))) = (self.last, self.velocities.last_mut()) {
            velocity.spin = spin.into();
            velocity.about = about.into();
        }
        self
    }

    /// Changes the friction of a pair.
    pub fn friction(mut self, pair: impl Into<String>, friction: Friction) -> Self {
        self.frictions.push((pair.into(), friction));
        self
    }

    /// Takes what was stated last to its target along a curve. Without it targets are approached
    /// along a ramp, and followed from the start where they change with time.
    pub fn along(mut self, curve: Curve) -> Self {
        let of_last = match self.last {
            Last::Nothing | Last::Velocity => None,
            Last::Displacement => (self.displacements.last_mut()).map(|(_, _, _, curve)| curve),
            Last::Load => self.loads.last_mut().map(|(_, _, _, curve)| curve),
            Last::Force => self.forces.last_mut().map(|(_, _, curve)| curve),
            Last::Actuation => self.actuations.last_mut().map(|(_, _, _, curve)| curve),
            Last::Filling => self.fillings.last_mut().map(|(_, _, curve)| curve),
            Last::Motion => self.motions.last_mut().map(|(_, motion)| &mut motion.curve),
            Last::Gravity => self.step.gravity.as_mut().map(|gravity| &mut gravity.curve),
        };
        if let Some(of_last) = of_last {
            *of_last = curve;
        }
        self
    }

    fn resolve_displacements(
        &self,
        resolved: &mut Resolved,
        path: &Path,
        names: &Names<'_>,
        prescribed: &Prescribed,
        faults: &mut Vec<Fault>,
    ) {
        resolved.step.displacements =
            resolved.all("displacements", &self.displacements, |index, of| {
                let ((body, set), axes, components, curve) = of;
                let path = path.clone().field("displacements").index(index);
                let (body, nodes) = names.nodes(body, set, &path, faults)?;
                Some(Displacement {
                    set: set.clone(),
                    body,
                    nodes,
                    axes: *axes,
                    components: components.0.clone(),
                    curve: curve.clone(),
                })
            });
        resolved.step.releases = resolved.all("releases", &self.releases, |index, of| {
            let ((body, set), components) = of;
            let path = path.clone().field("releases").index(index);
            let (body, nodes) = names.nodes(body, set, &path, faults)?;
            let components = match components {
                Released::Chosen(components) => *components,
                Released::Prescribed => prescribed.on(body, &nodes),
            };
            Some(Release {
                body,
                nodes,
                components,
            })
        });
    }

    pub(super) fn resolved(
        &self,
        index: usize,
        names: &Names<'_>,
        prescribed: &mut Prescribed,
        faults: &mut Vec<Fault>,
    ) -> Resolved {
        let mut resolved = Resolved {
            step: self.step.clone(),
            known: Known::Whole,
            stated: self.displacements.len(),
            positions: BTreeMap::new(),
        };
        let path = Path::part("steps", index);
        let at = |list: &'static str, index| path.clone().field(list).index(index);
        self.resolve_displacements(&mut resolved, &path, names, prescribed, faults);
        prescribed.after(&resolved.step);
        resolved.step.loads = resolved.all("loads", &self.loads, |index, of| {
            let ((body, set), kind, extent, curve) = of;
            let (body, faces) = names.faces(body, set, &at("loads", index), faults)?;
            Some(Load {
                set: set.clone(),
                body,
                faces,
                kind: kind.clone(),
                extent: *extent,
                curve: curve.clone(),
            })
        });
        resolved.step.forces = resolved.all("forces", &self.forces, |index, of| {
            let ((body, set), spread, curve) = of;
            let (body, nodes) = names.nodes(body, set, &at("forces", index), faults)?;
            Some(NodalForce {
                set: set.clone(),
                body,
                force: match spread {
                    Spread::Each(force) => force.clone(),
                    Spread::Total(force) => shared_force(force, nodes.len()),
                },
                nodes,
                curve: curve.clone(),
            })
        });
        resolved.step.actuations = resolved.all("actuations", &self.actuations, |index, of| {
            let (body, section, kind, curve) = of;
            let path = at("actuations", index);
            let body = names.body(body, &path, faults)?;
            let section = match section {
                Some(set) => Some(names.section(body, set, &path, faults)?),
                None => None,
            };
            Some(Actuation {
                body,
                section,
                kind: *kind,
                curve: curve.clone(),
            })
        });
        resolved.step.fillings = resolved.all("fillings", &self.fillings, |index, of| {
            let (name, content, curve) = of;
            Some(CavityFilling {
                cavity: names.cavity(name, &at("fillings", index), faults)?,
                content: *content,
                curve: curve.clone(),
            })
        });
        resolved.step.rigid_motions = resolved.all("rigid_motions", &self.motions, |index, of| {
            let surface = names.rigid(&of.0, &at("rigid_motions", index), faults)?;
            let motion = of.1.clone();
            Some(RigidMotion { surface, ..motion })
        });
        resolved.step.velocities = resolved.all("velocities", &self.velocities, |index, of| {
            let path = at("velocities", index);
            let body = match &of.0 {
                Owner::Body(name) => Mover::Deformable(names.body(name, &path, faults)?),
                Owner::Rigid(name) => Mover::Rigid(names.rigid(name, &path, faults)?),
            };
            Some(Velocity { body, ..of.1 })
        });
        resolved.step.frictions = resolved.all("frictions", &self.frictions, |index, of| {
            let pair = names.pair(&of.0, &at("frictions", index), faults)?;
            Some((pair, of.1.clone()))
        });
        resolved
    }
}

/// Components of nodes of bodies that are prescribed after the steps so far.
#[derive(Default)]
pub(super) struct Prescribed(BTreeSet<(BodyId, NodeId, usize)>);

impl Prescribed {
    /// Components that are prescribed at some of these nodes.
    fn on(&self, body: BodyId, nodes: &[NodeId]) -> [bool; 3] {
        [0, 1, 2].map(|axis| {
            nodes
                .iter()
                .any(|node| self.0.contains(&(body, *node, axis)))
        })
    }

    /// Takes the releases of a step, then its displacements, into account.
    pub(super) fn after(&mut self, step: &Step) {
        for release in &step.releases {
            for axis in (0..3).filter(|axis| release.components[*axis]) {
                for node in &release.nodes {
                    self.0.remove(&(release.body, *node, axis));
                }
            }
        }
        for stated in &step.displacements {
            for axis in (0..3).filter(|axis| stated.components[*axis].is_some()) {
                let nodes = stated.nodes.iter().map(|node| (stated.body, *node, axis));
                self.0.extend(nodes);
            }
        }
    }
}

/// A step with ids for names, as far as these are known.
pub(super) struct Resolved {
    pub(super) step: Step,
    pub(super) known: Known,
    /// Number of displacement conditions stated.
    stated: usize,
    /// Positions in the builder of what is known, by list.
    positions: BTreeMap<&'static str, Vec<usize>>,
}

impl Resolved {
    /// Returns whether all displacement conditions are known.
    pub(super) fn displacements(&self) -> Known {
        let positions = self.positions.get("displacements");
        let gaps = positions.is_some_and(|known| known.len() < self.stated);
        if gaps { Known::InPart } else { Known::Whole }
    }

    /// Position in the builder of an element of a list.
    pub(super) fn position(&self, list: &str, index: usize) -> usize {
        let known = self.positions.get(list);
        known.map_or(index, |positions| positions[index])
    }

    fn all<T, U>(
        &mut self,
        list: &'static str,
        items: &[T],
        mut resolve: impl FnMut(usize, &T) -> Option<U>,
    ) -> Vec<U> {
        let known: Vec<(usize, U)> = (items.iter().enumerate())
            .filter_map(|(index, item)| Some((index, resolve(index, item)?)))
            .collect();
        if known.len() < items.len() {
            self.known = Known::InPart;
        }
        let (positions, known) = known.into_iter().unzip();
        self.positions.insert(list, positions);
        known
    }
}
