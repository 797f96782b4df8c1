//! Model of a simulation: validated, immutable data that a deck is lowered to.
//!
//! All quantities are in the consistent units of the user.
//!
//! Longer than other files, as it is the one list of everything that a model can contain.

use nalgebra::{Matrix3, Vector3};
use serde::Serialize;
pub use striae_contact::{pair::Enforcement, side::Side};
use striae_law::{bulk::Material, friction::Friction};
use striae_mesh::{ElementId, Face, Mesh, NodeId, Vec3};
use striae_surface::texture::Paint;

pub use crate::{
    axes::Axes,
    function::{Function, NoFunction, Value},
};

/// A whole problem.
#[derive(Clone, Debug, Serialize)]
pub struct Model {
    /// One line that says what the problem is.
    pub title: String,
    /// Deformable bodies.
    pub bodies: Vec<Body>,
    /// Rigid surfaces.
    pub rigid_surfaces: Vec<RigidSurface>,
    /// Contact pairs.
    pub pairs: Vec<Pair>,
    /// Surfaces that are glued.
    pub ties: Vec<Tie>,
    /// Springs and dashpots.
    pub springs: Vec<Spring>,
    /// Cavities with a pressure inside.
    pub cavities: Vec<Cavity>,
    /// Steps in the order in which they are run.
    pub steps: Vec<Step>,
    /// Newton's method and the linear solver.
    pub solver: Solver,
}

pub use striae_element::Formulation;

/// A deformable body.
#[derive(Clone, Debug, Serialize)]
pub struct Body {
    /// Unique name.
    pub name: String,
    /// Mesh with its named sets.
    pub mesh: Mesh,
    /// Bulk material, where no section is.
    pub material: Material,
    /// Formulation of its elements.
    pub formulation: Formulation,
    /// Mass per reference volume; zero if neither inertia nor gravity needs it.
    pub density: f64,
    /// Mass of the nodes of its contact surfaces.
    pub contact_mass: ContactMass,
    /// Parts of it that are of other materials.
    pub sections: Vec<BodySection>,
}

/// Elements of a body that are of a material of their own.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BodySection {
    /// Name of the element set.
    pub set: String,
    /// The elements; those of no other section of the body.
    pub elements: Vec<ElementId>,
    /// Bulk material.
    pub material: Material,
    /// Formulation of these elements.
    pub formulation: Formulation,
    /// Mass per reference volume.
    pub density: f64,
}

/// Mass of the nodes of contact surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum ContactMass {
    /// Mass from the consistent mass matrix.
    Consistent,
    /// None: it is moved to the nodes behind, so that contact neither stops nor throws mass.
    Redistributed,
}

/// Position of a body in [`Model::bodies`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct BodyId(pub usize);

/// Position of a rigid surface in [`Model::rigid_surfaces`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct RigidId(pub usize);

/// Position of a pair in [`Model::pairs`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct PairId(pub usize);

/// A rigid body: a surface that deformable bodies may touch, or what nodes are tied to.
#[derive(Clone, Debug, Serialize)]
pub struct RigidSurface {
    /// Unique name.
    pub name: String,
    /// Its shape in the reference configuration.
    pub shape: RigidShape,
    /// Reference point, about which it turns.
    pub reference: Vec3,
    /// Nodes tied to it.
    pub ties: Vec<(BodyId, Vec<NodeId>)>,
    /// Mass, if it has any.
    pub inertia: Option<RigidInertia>,
}

/// Mass and principal moments of inertia at rest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RigidInertia {
    /// Mass.
    pub mass: f64,
    /// Its centre.
    pub centre: Vec3,
    /// Moments of inertia about axes through the centre; none is larger than the sum
    /// of the others.
    pub moments: [f64; 3],
    /// Directions of these axes, in columns.
    pub axes: Matrix3<f64>,
}

impl RigidInertia {
    /// Inertia about axes along the coordinate axes.
    pub fn aligned(mass: f64, centre: Vec3, moments: [f64; 3]) -> Self {
        Self {
            mass,
            centre,
            moments,
            axes: Matrix3::identity(),
        }
    }
}

impl RigidSurface {
    /// A rigid surface without mass and ties that turns about the origin.
    pub fn new(name: impl Into<String>, shape: RigidShape) -> Self {
        Self {
            name: name.into(),
            shape,
            reference: Vec3::zeros(),
            ties: Vec::new(),
            inertia: None,
        }
    }
}

/// Shape of a rigid surface.
#[derive(Clone, Debug, Serialize)]
pub enum RigidShape {
    /// An unbounded plane.
    Plane {
        /// A point of the plane.
        point: Vec3,
        /// Unit normal, out of the rigid half space.
        normal: Vec3,
    },
    /// Facets of three or four nodes, outward by the right-hand rule.
    Facets {
        /// Node positions.
        positions: Vec<Vec3>,
        /// Corners of the facets; a triangle repeats its last corner.
        facets: Vec<[NodeId; 4]>,
    },
    /// Nothing to touch.
    Bare,
}

/// One side of a contact pair.
#[derive(Clone, Debug, Serialize)]
pub enum ContactSurface {
    /// Faces of a deformable body.
    Deformable {
        /// The body.
        body: BodyId,
        /// Its faces that may come into contact.
        faces: Vec<Face>,
    },
    /// A rigid surface.
    Rigid(RigidId),
    /// The first side once more, as side `b`: the faces of a body that may touch each other.
    Itself,
}

/// Two surfaces that may touch; side `a` is always deformable.
#[derive(Clone, Debug, Serialize)]
pub struct Pair {
    /// Unique name.
    pub name: String,
    /// First side.
    pub a: ContactSurface,
    /// Second side.
    pub b: ContactSurface,
    /// Textures of the two sides, painted on their reference surfaces.
    pub textures: [Option<Paint>; 2],
    /// Friction from the start; steps may change it.
    pub friction: Friction,
    /// Enforcement of contact.
    pub enforcement: Enforcement,
    /// Distance within which contact is searched; `None`: half the local facet size.
    pub search_distance: Option<f64>,
    /// Treatment of initial gaps and overlaps of the meshes.
    pub initial: Initial,
    /// By how much the sides interfere, measured from faces that touch.
    pub interference: Option<InterferenceFit>,
    /// Coefficients of wear of the sides over their hardness: the depth that wears off per
    /// pressure and slip, an inverse stress; zero for a side that does not wear.
    pub wear: [f64; 2],
    /// Coefficients of wear across the texture of side `a`, or of `b` where `a` has none, over
    /// those along it.
    pub wear_across: f64,
    /// `true` if viscous forces carry bodies without other restraints across the gap.
    pub stabilised: bool,
    /// Dihedral angle in degrees from which on facets that share an edge belong to different
    /// faces: nodes on such an edge have a normal and a traction for each. `None`: one for all.
    pub feature_angle: Option<f64>,
}

impl Pair {
    /// The surfaces of both sides, the first one twice where it may touch itself.
    pub fn surfaces(&self) -> [&ContactSurface; 2] {
        match self.b {
            ContactSurface::Itself => [&self.a, &self.a],
            _ => [&self.a, &self.b],
        }
    }

    /// Returns whether its sides are stated because they touch, not because they may.
    pub fn is_expected_to_touch(&self) -> bool {
        self.feature_angle.is_none() && !self.is_on_itself()
    }

    /// True where the first side may touch itself.
    pub fn is_on_itself(&self) -> bool {
        matches!(self.b, ContactSurface::Itself)
    }

    /// True where both sides are of one body.
    pub fn is_within_a_body(&self) -> bool {
        let [a, b] = self.surfaces().map(|side| match side {
            ContactSurface::Deformable { body, .. } => Some(*body),
            ContactSurface::Rigid(_) | ContactSurface::Itself => None,
        });
        a.is_some() && a == b
    }

    /// Returns whether what lies between its sides may be their own body: not where two parts of a
    /// body are stated as a pair, which may be pieces of their own.
    pub fn is_in_one_body(&self) -> bool {
        self.is_within_a_body() && !self.is_expected_to_touch()
    }
}

/// Two surfaces of bodies that are glued from the start, see [`tie`](mod@crate::tie).
#[derive(Clone, Debug, Serialize)]
pub struct Tie {
    /// Unique name.
    pub name: String,
    /// First side.
    pub a: ContactSurface,
    /// Second side.
    pub b: ContactSurface,
    /// Distance up to which facets are tied; `None`: a tenth of their size, and facets that
    /// face each other from further away are a fault.
    pub within: Option<f64>,
    /// Largest distance that a node has been moved to its place on the other surface.
    pub moved: f64,
}

impl Tie {
    /// Returns whether a body is a side of it.
    pub fn joins(&self, body: BodyId) -> bool {
        let is = |side: &ContactSurface| matches!(side, ContactSurface::Deformable { body: of, .. } if *of == body);
        is(&self.a) || is(&self.b)
    }
}

/// Springs with dashpots beside them, one from each node of its first end, see [`crate::spring`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Spring {
    /// Unique name.
    pub name: String,
    /// First end.
    pub a: SpringEnd,
    /// The line along which it acts.
    pub line: SpringLine,
    /// Tension over elongation.
    pub stiffness: f64,
    /// Tension over rate of elongation.
    pub damping: f64,
    /// Tension at the start.
    pub rest: SpringRest,
}

/// A cavity, see [`cavity`](mod@crate::cavity).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cavity {
    /// Unique name.
    pub name: String,
    /// Its surface: faces of bodies, whose outward normals look into it.
    pub parts: Vec<(BodyId, Vec<Face>)>,
}

/// Position of a cavity in [`Model::cavities`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct CavityId(pub usize);

/// Content of a cavity in a step, until a later one states another.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CavityFilling {
    /// The cavity.
    pub cavity: CavityId,
    /// Its content.
    pub content: CavityContent,
    /// Curve towards a target.
    pub curve: Curve,
}

/// Kinds of contents of a cavity with their targets.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum CavityContent {
    /// Pressure over that of the surroundings.
    Pressure(f64),
    /// Volume.
    Volume(f64),
    /// Volume over that at rest.
    VolumeRatio(f64),
    /// Gas that is sealed in at the start of the step, at the pressure and volume that the cavity
    /// has there.
    Gas {
        /// Absolute pressure of the surroundings.
        ambient: f64,
        /// Polytropic exponent; 1 if the temperature stays.
        exponent: f64,
    },
}

/// End of springs that moves with a body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum SpringEnd {
    /// Nodes of a deformable body.
    Nodes {
        /// The body.
        body: BodyId,
        /// Its nodes.
        nodes: Vec<NodeId>,
    },
    /// A point of a rigid body.
    Rigid {
        /// The body.
        rigid: RigidId,
        /// Position of the point at the start.
        point: Vec3,
    },
}

/// Line along which springs act.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum SpringLine {
    /// Through both ends; the second one is a single point of a body.
    To(SpringEnd),
    /// Through the first end and a point that is at rest.
    ToPoint(Vec3),
    /// Along a fixed unit vector, to ground.
    Along(Vec3),
}

/// Tension of springs at the start.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum SpringRest {
    /// None.
    Slack,
    /// Tension of a spring that has none at this length.
    Length(f64),
    /// Prescribed tension, negative for compression.
    Preload(f64),
}

impl SpringEnd {
    /// Returns whether it is on a body of either kind.
    pub fn is_on(&self, mover: Mover) -> bool {
        match self {
            Self::Nodes { body, .. } => mover == Mover::Deformable(*body),
            Self::Rigid { rigid, .. } => mover == Mover::Rigid(*rigid),
        }
    }
}

impl Spring {
    /// Ends that move with bodies.
    pub fn ends(&self) -> impl Iterator<Item = &SpringEnd> {
        let b = match &self.line {
            SpringLine::To(end) => Some(end),
            SpringLine::ToPoint(_) | SpringLine::Along(_) => None,
        };
        std::iter::once(&self.a).chain(b)
    }

    /// Returns whether it resists displacements of a body.
    pub fn holds(&self, mover: Mover) -> bool {
        self.stiffness > 0.0 && self.ends().any(|end| end.is_on(mover))
    }
}

/// Treatment of the gaps and overlaps that the meshes of a pair have before any motion, see
/// [`crate::initial`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub enum Initial {
    /// Gaps are real, overlaps a fault.
    #[default]
    AsMeshed,
    /// Nodes are moved without strain until gaps and overlaps are gone.
    Close(ClosedGaps),
    /// Overlaps are pressed out in the course of the first step.
    Resolve,
}

/// An interference between faces that are taken as touching at the start, see
/// [`striae_contact::seating`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InterferenceFit {
    /// Overlap of the undeformed bodies at the end of the first step, kept from there on; negative
    /// for a clearance.
    pub value: f64,
    /// Curve of the approach in the first step.
    pub curve: Curve,
}

impl InterferenceFit {
    /// Interference at the fraction `s` of a step, with the start of the first one.
    pub fn at(&self, step: usize, s: f64, first: Moment) -> f64 {
        let s = if step == 0 { s } else { 1.0 };
        self.value * self.curve.at(first.later(s))
    }

    /// The largest overlap on the way.
    pub fn largest(&self, first: Moment) -> f64 {
        let [_, most] = self.curve.range(first);
        (most.max(1.0) * self.value).max(0.0)
    }

    /// The largest depth in which meshes may be in each other: the overlap on the way, or a
    /// clearance, by which they are in each other before their faces touch.
    pub fn deepest(&self, first: Moment) -> f64 {
        let ends = self.curve.range(first);
        self.value.abs() * ends.iter().fold(1.0, |most, end| end.abs().max(most))
    }
}

/// Gaps that are closed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum ClosedGaps {
    /// Up to this share of the local facet size.
    Share(f64),
    /// Up to this gap.
    UpTo(f64),
}

impl Default for ClosedGaps {
    fn default() -> Self {
        Self::Share(0.1)
    }
}

/// A part of the loading history.
///
/// A condition holds from the step that states it until a later step states
/// the same set and component again or releases it. A stated condition takes
/// its quantity from the present value to the target along the curve.
#[derive(Clone, Debug, Serialize)]
pub struct Step {
    /// Name for messages and output.
    pub name: String,
    /// Duration in (pseudo) time.
    pub duration: f64,
    /// Procedure: with or without inertia.
    pub procedure: Procedure,
    /// Increment control.
    pub increments: Increments,
    /// Velocities of whole bodies from the start of the step on.
    pub velocities: Vec<Velocity>,
    /// Acceleration of gravity, on all bodies.
    pub gravity: Option<Gravity>,
    /// Displacement conditions by component.
    pub displacements: Vec<Displacement>,
    /// Displacement conditions that end with the start of this step.
    pub releases: Vec<Release>,
    /// Loads on faces.
    pub loads: Vec<Load>,
    /// Forces at nodes.
    pub forces: Vec<NodalForce>,
    /// Actuation of bodies and their sections.
    pub actuations: Vec<Actuation>,
    /// Contents of cavities.
    pub fillings: Vec<CavityFilling>,
    /// Displacements of rigid surfaces.
    pub rigid_motions: Vec<RigidMotion>,
    /// Changes of friction at the start of the step.
    pub frictions: Vec<(PairId, Friction)>,
}

/// Procedure of a step: with or without inertia.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Procedure {
    /// A sequence of equilibria.
    QuasiStatic,
    /// Implicit dynamics by the generalised-alpha method.
    Dynamic {
        /// Spectral radius at infinite frequency: 1 keeps all of it, small values damp it at once.
        spectral_radius: f64,
    },
}

/// Velocity of a body, `v + w x (x - x0)`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Velocity {
    /// The body.
    pub body: Mover,
    /// `v`.
    pub velocity: Vec3,
    /// `w`.
    pub spin: Vec3,
    /// `x0`.
    pub about: Vec3,
}

/// A body of either kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Mover {
    /// A deformable body.
    Deformable(BodyId),
    /// A rigid one, with all that is tied to it.
    Rigid(RigidId),
}

/// Acceleration of gravity that a step goes to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Gravity {
    /// Target.
    pub acceleration: Vec3,
    /// Curve towards the target.
    pub curve: Curve,
}

/// Division of a step into increments, as fractions of its duration.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Increments {
    /// First increment.
    pub initial: f64,
    /// Smallest increment before the run is given up.
    pub smallest: f64,
    /// Largest increment.
    pub largest: f64,
}

/// Prescribed displacement of nodes.
#[derive(Clone, Debug, Serialize)]
pub struct Displacement {
    /// Name of the node set, for reports.
    pub set: String,
    /// The body.
    pub body: BodyId,
    /// Its nodes.
    pub nodes: Vec<NodeId>,
    /// Axes of the components.
    pub axes: Axes,
    /// Target by component; `None` leaves the component as it is.
    pub components: [Option<Value>; 3],
    /// Curve towards the target.
    pub curve: Curve,
}

impl Displacement {
    /// Targets that are numbers.
    pub fn numbers(&self) -> [Option<f64>; 3] {
        let components = self.components.each_ref();
        components.map(|component| component.as_ref().and_then(Value::number))
    }

    /// Vector of the targets that are numbers at the first node, where the others are zero.
    pub fn way(&self, mesh: &Mesh) -> Vec3 {
        let place = |node: &NodeId| mesh.positions[node.index()];
        let Some(x) = self.nodes.first().map(place) else {
            return Vec3::zeros();
        };
        let along = self.axes.directions(&x).into_iter().zip(self.numbers());
        along
            .filter_map(|(direction, target)| Some(direction? * target?))
            .sum()
    }

    /// Returns whether a target is a function.
    pub fn varies(&self) -> bool {
        let mut stated = self.components.iter().flatten();
        stated.any(|target| target.number().is_none())
    }
}

/// End of prescribed displacements.
#[derive(Clone, Debug, Serialize)]
pub struct Release {
    /// The body.
    pub body: BodyId,
    /// Its nodes.
    pub nodes: Vec<NodeId>,
    /// Components that become free, in whatever axes they were stated.
    pub components: [bool; 3],
}

/// A load on faces of a body.
#[derive(Clone, Debug, Serialize)]
pub struct Load {
    /// Name of the facet set; the same name and kind in a later step replaces the load.
    pub set: String,
    /// The body.
    pub body: BodyId,
    /// Its faces.
    pub faces: Vec<Face>,
    /// Kind of load on the faces.
    pub kind: LoadKind<Value>,
    /// Part of the faces that is loaded.
    pub extent: LoadExtent,
    /// Curve towards the target.
    pub curve: Curve,
}

/// Forces of fixed directions at nodes of a body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NodalForce {
    /// Name of the node set; the same name in a later step replaces the force.
    pub set: String,
    /// The body.
    pub body: BodyId,
    /// Its nodes.
    pub nodes: Vec<NodeId>,
    /// Target of the force at each node.
    pub force: Vector3<Value>,
    /// Curve towards the target.
    pub curve: Curve,
}

impl Model {
    /// Returns whether forces act on a body or its faces in a step, or it has a cavity that some
    /// step fills.
    pub fn loads(&self, step: &Step, body: BodyId) -> bool {
        let mut fillings = self.steps.iter().flat_map(|step| &step.fillings);
        let filled = |filling: &CavityFilling| {
            let parts = &self.cavities[filling.cavity.0].parts;
            parts.iter().any(|(of, _)| *of == body)
        };
        step.loads.iter().any(|load| load.body == body)
            || step.forces.iter().any(|force| force.body == body)
            || fillings.any(filled)
    }
}

/// Kinds of loads with their targets: numbers, or what they are made of at all points and times.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(bound = "S: Serialize + nalgebra::Scalar")]
pub enum LoadKind<S = f64> {
    /// Force per reference area of fixed direction.
    DeadTraction(Vector3<S>),
    /// Force per current area that turns with the facet.
    FollowerTraction(Vector3<S>),
    /// Force per current area against the current normal.
    Pressure(S),
}

/// Strain or tension imposed on a body, see [`crate::actuation`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Actuation {
    /// The body.
    pub body: BodyId,
    /// Number of the section, counted from 1; `None` for all of the body, with all sections.
    pub section: Option<usize>,
    /// The strain or tension that it takes on.
    pub kind: ActuationKind,
    /// Curve towards the target.
    pub curve: Curve,
}

/// Kinds of actuation with their targets; a section has the sum of all kinds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum ActuationKind {
    /// Symmetric stress-free strain `G - I`.
    Strain(Matrix3<f64>),
    /// Stress-free strain along each family of fibres.
    FibreStrain(f64),
    /// Stress-free strain of a change of temperature, the same in all directions.
    Thermal {
        /// Coefficient of thermal expansion.
        expansion: f64,
        /// Change of temperature since the start.
        temperature: f64,
    },
    /// Tension along each family of fibres, a force per reference area.
    FibreTension(f64),
    /// Tension along a line; those along other lines add to it.
    Tension {
        /// Unit vector in the reference configuration.
        along: Vec3,
        /// Force per reference area.
        value: f64,
    },
}

/// Part of the faces that carries a load.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum LoadExtent {
    /// All of it.
    Whole,
    /// Only what no other contact surface covers.
    Exposed,
}

/// Motion of a rigid body in a step.
#[derive(Clone, Debug, Serialize)]
pub struct RigidMotion {
    /// The body.
    pub surface: RigidId,
    /// Its coordinates: displacement of the reference point, angles in radians.
    pub coordinates: [Freedom; 6],
    /// Target of the driving force at the reference point.
    pub force: Option<Vec3>,
    /// Target of the driving torque.
    pub torque: Option<Vec3>,
    /// Curve towards the targets.
    pub curve: Curve,
}

/// Motion of a coordinate of a rigid body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Freedom {
    /// The coordinate stays free or at its value.
    AsBefore,
    /// The coordinate moves to a target.
    To(f64),
    /// Forces decide.
    Free,
}

/// Share of the change that is done, over the fraction of the step.
///
/// A quantity that goes from `v0` to the target `v1` has the value
/// `v0 + c(s) (v1 - v0)` at the fraction `s` of the step, where `v0` is what the step finds; of
/// a history over the time of the run, what there is at rest.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Curve {
    /// `c(s) = s`.
    Ramp,
    /// `c(s) = 1`.
    Constant,
    /// `c(s) = s^2 (3 - 2 s)`.
    Smooth,
    /// Piecewise linear through points `(s, c)`, `s` rising from 0 to 1.
    Table(Vec<(f64, f64)>),
    /// Any other course.
    History(History),
}

/// A point of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Fraction of the step that is done.
    pub s: f64,
    /// Time of the run.
    pub time: f64,
    /// Duration of the step.
    pub duration: f64,
}

/// A course of a quantity that is not tied to the ends of a step.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct History {
    /// Abscissa.
    pub clock: Clock,
    /// Values over it.
    pub course: Course,
}

/// Abscissa of a history.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Clock {
    /// Fraction of the step; values are shares of the change that is done.
    Step,
    /// Time of the run; values are multiples of the target, whatever was before.
    Run,
}

/// Values of a history.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Course {
    /// Linear between points, constant beyond them.
    Table(Vec<(f64, f64)>),
    /// Points that are repeated again and again.
    Periodic {
        /// The points.
        points: Vec<(f64, f64)>,
        /// When the points begin again.
        period: f64,
    },
    /// A function of `t`, the abscissa.
    Function(Function),
}

/// Settings of Newton's method and the linear solver.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Solver {
    /// Factorisation.
    pub backend: Backend,
    /// Determination of stick and slip.
    pub strategy: Strategy,
    /// Relative tolerance of every residual field.
    pub tolerance: f64,
    /// Iterations after which an increment is cut.
    pub largest_iterations: usize,
    /// Iterations after the tolerance is met, for answers that do not depend on it.
    pub further_iterations: usize,
}

/// Determination of stick and slip.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Strategy {
    /// As part of the linearisation.
    Semismooth,
    /// By predictor and corrector between iterations, see `striae_contact::table_1`.
    Table1 {
        /// Overshoot of the slip surface, relative to it, at which a node leaves stick.
        stick_tolerance: f64,
    },
}

/// Factorisation of the linear systems.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Backend {
    /// Cholesky factorisation of the bodies with dense contact; multifrontal LU
    /// where that does not work or pay, the iterative solver for large bodies.
    Condensed,
    /// Multifrontal LU on dense fronts.
    Multifrontal,
    /// faer's sparse LU.
    Faer,
    /// GMRES, the bodies by smoothed aggregation; direct factors where that fails.
    Iterative,
    /// MUMPS, a direct solver of several ranks; multifrontal LU on one rank without them.
    Mumps,
}
