//! A scene: what is simulated and what must come of it.
//!
//! All lengths stand in a local frame in which the upper body presses down along
//! `-z`; [`super::deck`] brings them to their place in space.

use std::collections::BTreeMap;

use super::{claim::Claim, grid::Grid, law::Law, vector::Vector};

pub use super::step::{Drive, End, Step};

/// A random scene.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Seed it comes from.
    pub seed: u64,
    /// Name of its kind.
    pub kind: &'static str,
    /// Upper over lower modulus; `None` where the other side is rigid.
    pub ratio: Option<f64>,
    /// Placement in space.
    pub placement: Placement,
    /// Bulk materials: one a body.
    pub bodies: Vec<Body>,
    /// Rigid surfaces.
    pub rigid: Vec<Rigid>,
    /// Pairs.
    pub pairs: Vec<Pair>,
    /// Steps.
    pub steps: Vec<Step>,
    /// Start of the bodies: apart, or overlapping.
    pub start: Start,
    /// Statement of what may touch.
    pub statement: Statement,
    /// Method of contact to ask for.
    pub enforcement: Option<&'static str>,
    /// Ties.
    pub ties: Vec<Tie>,
    /// Endings allowed.
    pub ending: Ending,
    /// Numbers that must come of it, beside what always holds.
    pub claims: Vec<Claim>,
    /// A scene that is run beside it, to be held against.
    pub reference: Option<Box<Scene>>,
}

/// Statement of what may touch in a deck.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// By its pairs.
    Pairs,
    /// By its pairs, with a normal for each face at an edge, as where all touches all.
    PairsOfFaces,
    /// All touches all, with this law where nothing narrower is said. The pairs of the scene are
    /// those that it comes down to, under their names.
    All(Law),
}
/// Endings that a scene may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// Well, or for a reason that physics has.
    Open,
    /// Well: there is a state in balance at any time.
    Completes,
    /// For a reason with one of these words.
    Stops(&'static [&'static str]),
}

/// Arrangement of the bodies at the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// Apart or just touching.
    Apart,
    /// Overlapping; the program may resolve that or refuse it by name.
    Overlapping(Option<&'static str>),
}

/// A rotation about the origin and a shift.
#[derive(Clone, Copy, Debug)]
pub struct Placement {
    /// Axis of the rotation.
    pub axis: Vector,
    /// Angle in degrees.
    pub degrees: f64,
    /// Shift.
    pub shift: Vector,
}

/// A deformable body.
#[derive(Clone, Debug)]
pub struct Body {
    /// Name.
    pub name: &'static str,
    /// Law, Young's modulus, Poisson's ratio.
    pub material: Material,
    /// Shape and mesh.
    pub shape: Shape,
    /// Name and members of a set of facets made of several.
    pub union: Option<(&'static str, [&'static str; 2])>,
    /// Names of sets of one node, and the places that it is nearest to.
    pub nearest: Vec<(&'static str, Vector)>,
    /// Formulation of elements, if not the default.
    pub formulation: Option<&'static str>,
}

/// A bulk material.
#[derive(Clone, Copy, Debug)]
pub struct Material {
    /// Law.
    pub law: &'static str,
    /// Young's modulus.
    pub modulus: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Density where there is inertia.
    pub density: Option<f64>,
    /// Beside elasticity.
    pub beside: Beside,
}

/// A property of a material beside its elasticity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Beside {
    /// None.
    #[default]
    Nothing,
    /// Yield stress and hardening modulus.
    Yield(f64, f64),
    /// Modulus of a branch over that of the law, and its relaxation time.
    Relaxation(f64, f64),
    /// Modulus and direction of linear fibres.
    Fibres(f64, Vector),
}

/// A shape with its mesh.
#[derive(Clone, Debug)]
pub enum Shape {
    /// A block.
    Block(Box<Block>),
    /// A block with a spherical cap below.
    Cap(Cap),
    /// Elements in rows along three curved axes.
    Grid(Box<Grid>),
}

/// A block of hexahedra, or what they are divided into.
#[derive(Clone, Debug, Default)]
pub struct Block {
    /// Lowest corner.
    pub origin: Vector,
    /// Edges.
    pub size: Vector,
    /// Elements along the edges.
    pub divisions: [usize; 3],
    /// Kind and number of the grading of each edge.
    pub gradings: [Option<(&'static str, f64)>; 3],
    /// Slopes of the lower side.
    pub bottom_slopes: [f64; 2],
    /// Slopes of the upper side.
    pub top_slopes: [f64; 2],
    /// Turn of the mesh inside the outline, degrees.
    pub mesh_rotation: f64,
    /// Random displacement of nodes, and its seed.
    pub irregularity: Option<(f64, u64)>,
    /// Axis, degrees and pivot by which it is tilted.
    pub tilt: Option<(Vector, f64, Vector)>,
    /// Elements that hexahedra are divided into, if they are.
    pub cells: Option<&'static str>,
}

/// A block with a spherical cap below.
#[derive(Clone, Debug)]
pub struct Cap {
    /// Lowest point.
    pub apex: Vector,
    /// Edges of the plan.
    pub size: [f64; 2],
    /// From the lowest point to the top.
    pub height: f64,
    /// Radius of the sphere.
    pub radius: f64,
    /// Element size at the apex.
    pub element: f64,
}

/// A rigid surface.
#[derive(Clone, Debug)]
pub struct Rigid {
    /// Name.
    pub name: &'static str,
    /// Shape of the surface.
    pub shape: RigidShape,
}

/// Shape of a rigid surface.
#[derive(Clone, Debug)]
pub enum RigidShape {
    /// The plane through a point, with its normal.
    Plane(Vector, Vector),
    /// Facets over the plane `z = 0`, facing up.
    Sheet(Vec<Vector>, Vec<[usize; 4]>),
    /// Nodes of a body that move as one, and the point about which they turn.
    Head(&'static str, &'static str, Vector),
    /// A convex solid around the origin of the local frame moved to a point: corners about
    /// that point, facets, the point, density.
    Solid(Vec<Vector>, Vec<[usize; 4]>, Vector, f64),
}

/// Two surfaces of bodies that are glued.
#[derive(Clone, Debug)]
pub struct Tie {
    /// Name.
    pub name: &'static str,
    /// Bodies and facets.
    pub sides: [(&'static str, &'static str); 2],
}

/// Two surfaces that may touch.
#[derive(Clone, Debug)]
pub struct Pair {
    /// Name.
    pub name: String,
    /// Sides.
    pub sides: [Side; 2],
    /// Friction.
    pub law: Law,
    /// Largest shear stress.
    pub cap: Option<f64>,
    /// Ratio of kinetic to static friction, and the rate of the decay.
    pub decay: Option<(f64, f64)>,
    /// Its origin.
    pub origin: Origin,
}

/// Origin of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The scene is about it.
    Scene,
    /// All touches all, and so do these.
    Found,
}

/// Facets of a side that is all the skin of its body.
pub const SKIN: &str = "skin";

impl Pair {
    /// Returns true for a body that touches itself.
    pub fn is_itself(&self) -> bool {
        let [a, b] = &self.sides;
        a.owner == b.owner && b.facets.is_none()
    }
}

/// A side of a pair.
#[derive(Clone, Debug)]
pub struct Side {
    /// Name of the body or rigid surface.
    pub owner: &'static str,
    /// Facets of the body; `None` of a rigid surface, and of a body that is the other side, too.
    pub facets: Option<&'static str>,
    /// Texture.
    pub texture: Option<Texture>,
}

/// A texture.
#[derive(Clone, Copy, Debug)]
pub enum Texture {
    /// A direction and its turn in degrees.
    Uniform(Vector, f64),
    /// Circles or rays (by the key in the deck) about the vertical axis through a point.
    About(&'static str, Vector, f64),
}

impl Side {
    /// The label of its surface.
    pub fn label(&self) -> String {
        match self.facets {
            Some(facets) if facets != SKIN => format!("{}.{facets}", self.owner),
            _ => self.owner.to_owned(),
        }
    }
}

impl Scene {
    /// Returns whether any step has inertia.
    pub fn is_dynamic(&self) -> bool {
        self.steps.iter().any(Step::is_dynamic)
    }

    /// End of the last step.
    pub fn end_time(&self) -> f64 {
        self.steps
            .iter()
            .map(|step| step.duration.unwrap_or(1.0))
            .sum()
    }

    /// Node sets of a body whose displacement is prescribed or tied at some time, with the
    /// components that are. No two sets with common nodes hold the same component.
    pub fn held(&self, body: &str) -> BTreeMap<&'static str, [bool; 3]> {
        let mut all: BTreeMap<&str, [bool; 3]> = BTreeMap::new();
        let prescribed = self.steps.iter().flat_map(|step| &step.displacements);
        for (_, nodes, to) in prescribed.filter(|held| held.0 == body) {
            let components = all.entry(*nodes).or_default();
            for (component, to) in components.iter_mut().zip(to) {
                *component |= to.is_some();
            }
        }
        for rigid in &self.rigid {
            if let RigidShape::Head(tied, nodes, _) = rigid.shape
                && tied == body
            {
                all.insert(nodes, [true; 3]);
            }
        }
        all
    }

    /// Moment when a step ends.
    pub fn end_of(&self, step: usize) -> f64 {
        self.steps[..=step]
            .iter()
            .map(|step| step.duration.unwrap_or(1.0))
            .sum()
    }
}
