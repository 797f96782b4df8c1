//! Faults of a model, with their messages.
//!
//! Longer than other files, as it lists every kind of fault with its message.

use std::fmt;

use striae_mesh::{ElementId, NodeId, place, significant};

use crate::path::Path;

/// A fault of a model and where it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// The part that is wrong.
    pub path: Path,
    /// Kind of fault.
    pub kind: FaultKind,
}

/// All faults of a model.
#[derive(Clone, Debug, PartialEq)]
pub struct Faults(pub Vec<Fault>);

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path, self.kind)
    }
}

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for fault in &self.0 {
            writeln!(f, "{fault}")?;
        }
        match self.0.len() {
            1 => write!(f, "1 fault"),
            count => write!(f, "{count} faults"),
        }
    }
}

impl std::error::Error for Faults {}

/// One kind of fault with the names and numbers that explain it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FaultKind {
    /// Two things of one kind have the same name.
    #[error("{kind} `{name}` is already defined as {first}")]
    DuplicateName {
        /// Body, rigid surface, ...
        kind: &'static str,
        /// The name.
        name: String,
        /// Path of the first definition.
        first: Path,
    },
    /// Facets with three corners where four are needed.
    #[error(
        "{what} needs facets with four corners, and body `{body}` has triangles there; mesh it with hexahedra, wedges or pyramids that show quadrilaterals"
    )]
    Triangles {
        /// Feature that needs them.
        what: String,
        /// Name of the body.
        body: String,
    },
    /// A model without bodies or steps.
    #[error("the model has no {what}; {need}")]
    Nothing {
        /// `body` or `step`.
        what: &'static str,
        /// Reason why one is needed.
        need: &'static str,
    },
    /// An id that nothing has.
    #[error("there is no {what} {index}; there are {count}, counted from 0")]
    Missing {
        /// Body, rigid surface, pair, node or element.
        what: &'static str,
        /// The id.
        index: usize,
        /// Number of existing ones.
        count: usize,
    },
    /// A number outside its range.
    #[error("{what} must be {expected}, but is {found}")]
    Range {
        /// Name of the quantity.
        what: String,
        /// Requirement on the value.
        expected: &'static str,
        /// Value given instead.
        found: f64,
    },
    /// A name that nothing has.
    #[error("no {kind} is named `{name}`; {}{}", existing(.known), did_you_mean(.nearest))]
    UnknownName {
        /// Body, material, ...
        kind: &'static str,
        /// The name.
        name: String,
        /// Existing names.
        known: Vec<String>,
        /// The most similar of them.
        nearest: Option<String>,
    },
    /// A set that a body does not have.
    #[error("body `{body}` has no {kind} set `{name}`; {}{}", it_has(.known), did_you_mean(.nearest))]
    UnknownSet {
        /// The body.
        body: String,
        /// Node, facet or element.
        kind: &'static str,
        /// The set.
        name: String,
        /// The sets it has.
        known: Vec<String>,
        /// The most similar of them.
        nearest: Option<String>,
    },
    /// A set without members.
    #[error("{kind} set `{name}` of body `{body}` is empty")]
    EmptySet {
        /// The body.
        body: String,
        /// Node, facet or element.
        kind: &'static str,
        /// The set.
        name: String,
    },
    /// An element in two sections of a body.
    #[error(
        "{element} of body `{body}` is in two sections, `{first}` and `{second}`; each element needs exactly one material"
    )]
    TwoSections {
        /// The body.
        body: String,
        /// The first such element.
        element: ElementId,
        /// Set of the earlier section.
        first: String,
        /// Set of the later section.
        second: String,
    },
    /// Elements without a material.
    #[error(
        "body `{body}` has no `material` of its own, and {count} of its elements are in no section, the first is {element}; give the body a material, or all elements a section"
    )]
    NoMaterial {
        /// The body.
        body: String,
        /// Number of such elements.
        count: usize,
        /// The first of them.
        element: ElementId,
    },
    /// A mesh cannot be generated or read.
    #[error("the mesh of {owner} cannot be made: {cause}")]
    Mesh {
        /// The body or rigid surface.
        owner: String,
        /// Message of its generator.
        cause: String,
    },
    /// A pair without a deformable side.
    #[error("pair `{pair}` joins two rigid surfaces; at least one side must be a body")]
    TwoRigid {
        /// The pair.
        pair: String,
    },
    /// A facet is on both sides of a pair.
    #[error(
        "pair `{pair}` has {shared} facets of body `{body}` on both sides; give its sides facets of their own, or set `b = \"itself\"` if facets of `a` may touch each other"
    )]
    SharedFacets {
        /// The pair.
        pair: String,
        /// The body.
        body: String,
        /// Number of such facets.
        shared: usize,
    },
    /// A surface that is a body's and a rigid one's.
    #[error("`{label}` is the name of a body and of a rigid surface; rename one of them")]
    TwoMeanings {
        /// The name.
        label: String,
    },
    /// A part of a rigid surface.
    #[error(
        "`{label}` is a part of rigid surface `{rigid}`, which has no sets; name all of it, `{rigid}`"
    )]
    PartOfRigid {
        /// The label.
        label: String,
        /// The rigid surface.
        rigid: String,
    },
    /// Two statements about what meets, of which neither is narrower.
    #[error(
        "{statements} both name {a} and {b}, and neither is narrower; remove one of them, or give it facet sets, such as `body.set`"
    )]
    BothName {
        /// The two statements.
        statements: String,
        /// A surface that both name.
        a: String,
        /// Surfaces that it meets.
        b: String,
    },
    /// Two textures on one surface, neither of which is that of a narrower one.
    #[error(
        "`surface` {first} and {second} paint the same facets, of {} and {}, and neither is narrower; remove one of them, or give it another facet set", labels[0], labels[1]
    )]
    BothPaint {
        /// Number of the earlier statement.
        first: usize,
        /// Number of the later statement.
        second: usize,
        /// Surfaces that they name.
        labels: [String; 2],
    },
    /// A statement about what meets that nothing does.
    #[error(
        "{statement} names nothing that can touch: named pairs and ties keep their facets, and rigid surfaces do not touch each other; remove it, or name other surfaces"
    )]
    NothingToTouch {
        /// The statement.
        statement: String,
    },
    /// A side that stands for the other one, where it cannot.
    #[error("pair `{pair}`: {found}; only side `b` can be `itself`, of a body on side `a`")]
    NotItself {
        /// The pair.
        pair: String,
        /// Names that exist.
        found: &'static str,
    },
    /// A pair of a body with itself with a setting that needs two sides.
    #[error("pair `{pair}` is one of a surface with itself, which {what}; remove this setting")]
    OnItself {
        /// The pair.
        pair: String,
        /// The request.
        what: &'static str,
    },
    /// Faces of their own in a pair that has one normal at a node.
    #[error(
        "pair `{pair}` is collocated and states `feature_angle`: its nodes have one normal each; remove one of the settings"
    )]
    CollocatedFeatures {
        /// The pair.
        pair: String,
    },
    /// A rigid side that wears.
    #[error(
        "pair `{pair}`: `wear` states a coefficient for its rigid side, which keeps its shape. State one for the deformable side alone"
    )]
    RigidWear {
        /// The pair.
        pair: String,
    },
    /// Wear of collocated contact.
    #[error(
        "pair `{pair}` is collocated and states `wear`, which opens weighted gaps only; remove one of the settings"
    )]
    CollocatedWear {
        /// The pair.
        pair: String,
    },
    /// Wear that depends on a direction, of sides that do not wear.
    #[error("pair `{pair}` states `wear_across`, but no `wear`; state both, or remove it")]
    WearAcrossNothing {
        /// The pair.
        pair: String,
    },
    /// Wear that depends on a direction that no texture states.
    #[error(
        "pair `{pair}` states `wear_across`, but neither side has a texture that wear could be across; give one a `texture`, or remove it"
    )]
    WearWithoutTexture {
        /// The pair.
        pair: String,
    },
    /// Wear that depends on a direction to two textures.
    #[error(
        "pair `{pair}` states `wear_across`, but both sides have a texture, and it is not said which one wear depends on; remove it, or one of the textures"
    )]
    WearAcrossTwoTextures {
        /// The pair.
        pair: String,
    },
    /// Wear without friction.
    #[error(
        "pair `{pair}` states `wear`, but is frictionless in all steps: sides wear where they slip with friction. State a friction law, with a small coefficient if need be, or remove `wear`"
    )]
    FrictionlessWear {
        /// The pair.
        pair: String,
    },
    /// Two pairs join the same surfaces.
    #[error("pair `{pair}` joins the same two surfaces as pair `{other}`")]
    SamePair {
        /// The pair.
        pair: String,
        /// The earlier pair.
        other: String,
    },
    /// A texture that cannot be painted.
    #[error("{cause}")]
    Unpainted {
        /// Reason.
        cause: crate::pair_geometry::PairError,
    },
    /// A tie that does not hold.
    #[error("{fault}")]
    Tie {
        /// Reason.
        fault: crate::tie::TieFault,
    },
    /// A pair joins what is tied.
    #[error(
        "tie `{tie}` glues facets that also belong to pair `{pair}`, which lets them slide and open; remove one of them, or give the pair other facets"
    )]
    TiedPair {
        /// The tie.
        tie: String,
        /// The pair.
        pair: String,
    },
    /// Two ties join the same facets.
    #[error("tie `{tie}` joins facets that tie `{other}` already joins; remove one of them")]
    SameTie {
        /// The tie.
        tie: String,
        /// The earlier tie.
        other: String,
    },
    /// A cavity that encloses nothing, or a content that it cannot have.
    #[error("cavity `{cavity}`: {cause}")]
    Cavity {
        /// The cavity.
        cavity: String,
        /// Reason, and what is needed.
        cause: String,
    },
    /// A spring that has no force, no direction or too many ends.
    #[error("spring `{spring}`: {cause}")]
    Spring {
        /// The spring.
        spring: String,
        /// Reason, and what is needed.
        cause: String,
    },
    /// A pair is stabilised, but all steps have inertia.
    #[error(
        "pair `{pair}` is stabilised, but every step is dynamic, where inertia carries bodies across gaps. Remove `stabilise`"
    )]
    StabilisedByInertia {
        /// The pair.
        pair: String,
    },
    /// A pair states an interference and presses the overlap of its meshes out, too.
    #[error(
        "pair `{pair}` states an interference and `initial = \"resolve\"`: the interference is measured from touching faces, whatever the overlap of their meshes. Remove one of the settings"
    )]
    InterferenceResolved {
        /// The pair.
        pair: String,
    },
    /// The meshes of a pair do not fit.
    #[error("{fault}")]
    Initial {
        /// Fault of the initial fit.
        fault: crate::initial::InitialFault,
    },
    /// A displacement condition without a component.
    #[error(
        "the displacement of `{set}` of body `{body}` prescribes nothing; give at least one of `x`, `y`, `z`"
    )]
    NoComponent {
        /// The body.
        body: String,
        /// The node set.
        set: String,
    },
    /// A displacement along an axis that does not exist.
    #[error(
        "the displacement of `{set}` of body `{body}` states `{component}`{}: {reason}", at_node(*node)
    )]
    NoDirection {
        /// The body.
        body: String,
        /// The node set.
        set: String,
        /// `x`, `y` or `z`.
        component: char,
        /// A node for which that is so, if it depends on the node.
        node: Option<NodeId>,
        /// Reason, and what to do.
        reason: &'static str,
    },
    /// A node is prescribed along directions that are not independent.
    #[error(
        "in step `{step}` {node} of body `{body}` is prescribed along {count} directions, and the last one, `{component}` of `{set}`, follows from the others or nearly so; leave it out there, or release others first"
    )]
    DependentDirections {
        /// The step.
        step: String,
        /// The body.
        body: String,
        /// A node for which that is so.
        node: NodeId,
        /// Number of directions.
        count: usize,
        /// The node set that was stated last.
        set: String,
        /// `x`, `y` or `z`.
        component: char,
    },
    /// One component of a node is prescribed twice in one step.
    #[error(
        "step `{step}` prescribes component `{component}` of {node} of body `{body}` twice: \
         {first} by `{first_set}`, {second} by `{second_set}`"
    )]
    PrescribedTwice {
        /// The step.
        step: String,
        /// The body.
        body: String,
        /// A node for which that is so.
        node: NodeId,
        /// `x`, `y` or `z`.
        component: char,
        /// The earlier target and curve.
        first: String,
        /// The earlier set.
        first_set: String,
        /// The later target and curve.
        second: String,
        /// The later set.
        second_set: String,
    },
    /// A release of something that is free.
    #[error(
        "step `{step}` releases {component} of `{set}` of body `{body}`, which is not prescribed"
    )]
    NotPrescribed {
        /// The step.
        step: String,
        /// The body.
        body: String,
        /// The node set.
        set: String,
        /// A component, or that there is none.
        component: String,
    },
    /// A value is stated twice in one step.
    #[error("step `{step}` states {what} twice")]
    StatedTwice {
        /// The step.
        step: String,
        /// Name of the value.
        what: String,
    },
    /// Sizes of increments that contradict each other.
    #[error(
        "increments of step `{step}` must satisfy smallest <= initial <= largest, but {smallest}, {initial}, {largest} do not"
    )]
    IncrementOrder {
        /// The step.
        step: String,
        /// Smallest increment.
        smallest: f64,
        /// First increment.
        initial: f64,
        /// Largest increment.
        largest: f64,
    },
    /// A velocity in a step in which nothing has one.
    #[error(
        "step `{step}` states a velocity but has no inertia; give it `dynamics = {{}}` or remove the velocity"
    )]
    VelocityWithoutInertia {
        /// The step.
        step: String,
    },
    /// A body without density where there is inertia or gravity.
    #[error(
        "body `{body}` has inertia or weight in step `{step}`, but {material} has no `density`; give it one"
    )]
    NoDensity {
        /// The body.
        body: String,
        /// Its material, or that of a section.
        material: String,
        /// The first step that needs it.
        step: String,
    },
    /// Mass without inertia, inertia without mass, both and density, or moments that no body has.
    #[error(
        "rigid body `{rigid}` needs both `mass` and `inertia`, none of whose three moments exceeds the sum of the others, or `density` alone"
    )]
    RigidInertia {
        /// The rigid body.
        rigid: String,
    },
    /// A side that is a rigid body without a surface.
    #[error("rigid body `{rigid}` has no surface to touch; give it a `plane` or a `mesh`")]
    NoSurface {
        /// The rigid body.
        rigid: String,
    },
    /// A length that cannot be computed with.
    #[error(
        "{what} has a length or coordinate of {length}, outside of the range from 1e-50 to 1e50; repair the mesh, or choose another unit of length",
        length = significant(*length, 2))]
    Extent {
        /// The body or rigid surface, as the subject of a sentence.
        what: String,
        /// The length.
        length: f64,
    },
    /// A facet of a rigid surface without area.
    #[error(
        "facet {facet} of rigid surface `{rigid}`, with a corner at {}, has no area; remove it, or correct its corners",
        place(at)
    )]
    FlatFacet {
        /// The rigid surface.
        rigid: String,
        /// The facet, from 0.
        facet: usize,
        /// Its first corner.
        at: striae_mesh::Vec3,
    },
    /// Neighbouring facets of a rigid surface that look to opposite sides.
    #[error(
        "facets {first} and {second} of rigid surface `{rigid}` have opposite orientations at their edge from {} to {}; reverse one of them, so that the corners of all are counter-clockwise as seen from the body",
        place(&ends[0]), place(&ends[1])
    )]
    TurnedFacet {
        /// The rigid surface.
        rigid: String,
        /// The earlier facet, from 0.
        first: usize,
        /// The later one.
        second: usize,
        /// Ends of their edge.
        ends: [striae_mesh::Vec3; 2],
    },
    /// A rigid body that nothing could move as it should.
    #[error(
        "step `{step}` frees coordinates of rigid body `{rigid}`; only bodies that nodes are tied to, that have a mass, that springs hold or that are a side of a pair can be free"
    )]
    FreeRigid {
        /// The rigid body.
        rigid: String,
        /// The step.
        step: String,
    },
    /// A coordinate of a rigid body that is free and has a target.
    #[error(
        "coordinate `{coordinate}` of rigid body `{rigid}` is `free`, so it follows the forces and has no target, but its target is {target}; remove it from `free`, or make the target 0"
    )]
    FreeTarget {
        /// The coordinate.
        coordinate: &'static str,
        /// The rigid body.
        rigid: String,
        /// Its target, with angles in degrees.
        target: f64,
    },
    /// A node that follows two rigid bodies.
    #[error(
        "rigid bodies `{first}` and `{second}` are both tied to {node} of body `{body}`; a node follows one of them: take it out of the set of the other"
    )]
    TiedTwice {
        /// The rigid body that is listed first.
        first: String,
        /// The other one.
        second: String,
        /// Body of the node.
        body: String,
        /// The first such node.
        node: NodeId,
    },
    /// A node that follows a rigid body and is prescribed.
    #[error(
        "step `{step}` prescribes {node} of body `{body}`, which is tied to a rigid body; move the rigid body instead"
    )]
    PrescribedTied {
        /// The step.
        step: String,
        /// The body.
        body: String,
        /// The first such node.
        node: NodeId,
    },
    /// Points that do not make a curve.
    #[error("the first numbers of the points of curve `{curve}` must ascend {found}")]
    BadCurve {
        /// The curve.
        curve: String,
        /// Description of the fault.
        found: String,
    },
    /// A curve that depends on position.
    #[error(
        "curve `{curve}` must be a function of `t` alone, but `{function}` depends on `x`, `y` or `z`; state it as the value itself"
    )]
    CurveOfPosition {
        /// The curve.
        curve: String,
        /// The function.
        function: String,
    },
    /// A function that has no value at some time.
    #[error("`{function}` has no finite value at t = {t}; it must have one in all of its step")]
    UndefinedCurve {
        /// The function.
        function: String,
        /// The time.
        t: f64,
    },
    /// A function that has no value at some point or time.
    #[error(
        "`{function}` has no finite value at x = {}, y = {}, z = {}, t = {t}; it must have one at all points that it is stated for and in all of its step", x[0], x[1], x[2]
    )]
    Undefined {
        /// The function.
        function: String,
        /// The point.
        x: [f64; 3],
        /// The time.
        t: f64,
    },
    /// Elastic constants of a material that is not stable.
    #[error(
        "`lambda` = {lambda} and `shear_modulus` = {shear} give a bulk modulus that is not positive"
    )]
    BulkModulus {
        /// First Lame constant.
        lambda: f64,
        /// Shear modulus.
        shear: f64,
    },
    /// The constants of a bulk law are inadmissible.
    #[error("the material is not admissible: {cause}")]
    Material {
        /// Name of the constant, and the reason.
        cause: String,
    },
    /// Textures do not fit the friction law.
    #[error(
        "the friction of pair `{pair}` needs a texture on {required}; sides that have one: {found}; {}", texturing(*found, *is_named)
    )]
    Textures {
        /// The pair.
        pair: String,
        /// Number of sides that must have one.
        required: &'static str,
        /// Number of sides that have one.
        found: usize,
        /// Is a pair of its own, not of contact of everything.
        is_named: bool,
    },
    /// A texture given at nodes of a plane.
    #[error(
        "rigid surface `{surface}` is a plane and has no nodes, so its texture cannot be given at points or nodes"
    )]
    NodesOnPlane {
        /// The rigid surface.
        surface: String,
    },
    /// A direction of no length.
    #[error("{place} must not be the zero vector")]
    ZeroVector {
        /// The key and its table.
        place: String,
    },
    /// An actuation that a body cannot follow.
    #[error("step `{step}` actuates {of}: {cause}")]
    Actuation {
        /// The step.
        step: String,
        /// The body or section.
        of: String,
        /// Reason, and what is needed.
        cause: String,
    },
    /// A body that can move without resistance.
    #[error(
        "body `{body}` is in no contact pair and {} in step `{step}`; prescribe displacements that restrain it", leaves(.motions)
    )]
    Free {
        /// The body.
        body: String,
        /// The first step in which it is free.
        step: String,
        /// Number of free rigid motions, out of six.
        motions: usize,
    },
    /// A piece of a body that is not joined to the rest and can move without resistance.
    #[error(
        "body `{body}` is made of {pieces} pieces that share no nodes, and for the piece of {nodes} nodes with {node} at {} {} in step `{step}`{}", place(at), leaves(.motions), joining(*coincident)
    )]
    LoosePiece {
        /// The body.
        body: String,
        /// Number of pieces.
        pieces: usize,
        /// Nodes of the piece.
        nodes: usize,
        /// The first of them.
        node: NodeId,
        /// Position of the node.
        at: striae_mesh::Vec3,
        /// The first step in which it is free.
        step: String,
        /// Number of free rigid motions, out of six.
        motions: usize,
        /// Nodes of the piece that lie on nodes of other pieces.
        coincident: usize,
    },
    /// A body that contact can only push away.
    #[error(
        "contact can only push {mover} along {direction} in step `{step}`, and {}",
        unopposed(load, pairs)
    )]
    PushedAway {
        /// Body or rigid body, as the object of a sentence.
        mover: String,
        /// Direction, such as `-z`.
        direction: String,
        /// The step.
        step: String,
        /// Force of the loads along that direction.
        load: f64,
        /// Names of the pairs.
        pairs: Vec<String>,
    },
    /// A contact surface that displacements move into a rigid plane.
    #[error(
        "pair `{pair}`: in step `{step}` displacements move all nodes of its contact surface, up to {} deep into the rigid plane, so contact can have no effect; prescribe nodes away from the contact surface, such as those of the opposite face",
        significant(*depth, 4)
    )]
    PrescribedInto {
        /// The pair.
        pair: String,
        /// The step.
        step: String,
        /// The largest depth.
        depth: f64,
    },
    /// Both sides of a pair are prescribed towards each other.
    #[error(
        "pair `{pair}`: in step `{step}` displacements prescribe all nodes of both contact surfaces along their normals, so the contact pressure is undetermined; prescribe nodes away from the contact surface, such as those of the opposite face, and leave at least one side free"
    )]
    BothPrescribed {
        /// The pair.
        pair: String,
        /// The step.
        step: String,
    },
}

fn did_you_mean(nearest: &Option<String>) -> String {
    nearest
        .as_ref()
        .map_or_else(String::new, |name| format!("; did you mean `{name}`?"))
}

fn quoted(words: &[String]) -> String {
    let words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
    words.join(", ")
}

fn existing(known: &[String]) -> String {
    match known {
        [] => "there is none".into(),
        [one] => format!("there is `{one}`"),
        several => format!("there are {}", quoted(several)),
    }
}

fn it_has(known: &[String]) -> String {
    if known.is_empty() {
        "it has none".into()
    } else {
        format!("it has {}", quoted(known))
    }
}

fn texturing(found: usize, is_named: bool) -> &'static str {
    match (found, is_named) {
        (2, _) => "leave one of them out",
        (_, true) => "give a side its direction, such as `texture = { uniform = [1, 0, 0] }`",
        (_, false) => {
            "name the textured facets as `of` of a `[[contact.surface]]`, and as `a` or `b` of a `[[contact.between]]` that gives their pair a law of its own from the start"
        }
    }
}

fn joining(coincident: usize) -> String {
    match coincident {
        0 => "; prescribe displacements that restrain it, tie it to the rest, or make it a separate body".into(),
        count => format!(
            "; {count} of its nodes lie on nodes of another piece: merge coincident nodes in the mesh generator, or tie the pieces"
        ),
    }
}

fn unopposed(load: &f64, pairs: &[String]) -> String {
    let pairs = quoted(pairs);
    match *load > 0.0 {
        true => format!(
            "its loads pull it in the same direction, away from the contact of {pairs}, with a force of {load}; reverse the loads (a positive pressure presses on a surface), or prescribe displacements that restrain it",
            load = significant(*load, 4)
        ),
        false => format!(
            "nothing resists this motion: it would fly off, and the contact of {pairs} would have no force; prescribe displacements that restrain it, or load it towards the contact"
        ),
    }
}

fn at_node(node: Option<NodeId>) -> String {
    node.map_or_else(String::new, |node| format!(" at {node}"))
}

fn leaves(motions: &usize) -> String {
    match motions {
        6 => "nothing restrains it".into(),
        1 => "one of its rigid motions is free".into(),
        _ => format!("{motions} of its rigid motions are free"),
    }
}
