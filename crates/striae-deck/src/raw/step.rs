//! `[[curve]]` and `[[step]]` with its conditions.
//!
//! Longer than other files, as it is the one list of all that a step can state.

use super::{Actuation, Filling, Friction};
use crate::{
    declare::{either, table, words},
    faults::FaultList,
    form::Form,
    read::{At, Place, Read, Value, read_table, unexpected},
    value::{Count, Fraction, Number, Portion, Positive, Prose, Text, Varying, Whole},
};
use toml::de::DeValue;

table! {
    /// A curve for conditions to change along.
    NamedCurve {
        /// Unique name, other than `ramp`, `constant` and `smooth`, which are built in.
        required name: Text,
        /// Its course.
        include course: Course,
        /// Abscissa of the curve. Default: `step`.
        optional time: CurveTime,
    }
}

either! {
    /// The course of a curve.
    Course {
        Points(CoursePoints),
        File(CourseFile),
        Function(CourseFunction),
    }
}

table! {
    /// Points with straight lines between them.
    CoursePoints {
        /// Pairs of time and value, rising in time; over a step from 0 to 1.
        required points: Vec<At<[Number; 2]>>,
        /// Time after which the points begin again; they lie within it. Default: they do not.
        optional period: Positive,
    }
}

table! {
    /// Points from a text file with a line each, below a line with the names of columns. Fields are separated by semicolons, tabs or commas; beside semicolons and tabs a comma may be the decimal sign. What follows a `#` is passed over.
    CourseFile {
        /// The file, relative to the deck.
        required file: Text,
        /// Names of the columns with times and values, or their numbers from 1, as texts.
        required columns: [Text; 2],
        /// Lines at the beginning that are passed over. Default: 0.
        optional skip: Whole<0>,
        /// Time after which the points begin again; they lie within it. Default: they do not.
        optional period: Positive,
    }
}

table! {
    /// A function of time.
    CourseFunction {
        /// A text such as `"sin(2*pi*t)"`, with angles in radians. `t` is the abscissa of the curve.
        required function: Prose,
    }
}

words! {
    /// The abscissa of a curve.
    CurveTime {
        /// Fraction of the step; values are shares of the change that is done then.
        Step = "step",
        /// Time of the run; values are multiples of the target, whatever was before.
        Run = "run",
    }
}

table! {
    /// A part of the loading history. A condition holds until a later step restates or releases it.
    Step {
        /// Unique name.
        required name: Text,
        /// Duration in (pseudo) time. Default: 1.
        optional duration: Positive,
        /// Implicit dynamics; an empty table selects the defaults. Default: a sequence of
        /// equilibria without inertia.
        optional dynamics: Dynamics,
        /// Division of the step: a number of equal increments, at most 1e7, or their sizes. Default: 10.
        optional increments: Increments,
        /// Velocities of whole bodies at the start of the step. Default: their present velocities.
        optional velocity: Vec<At<Velocity>>,
        /// Acceleration of gravity on all bodies, until a later step restates it.
        optional gravity: Gravity,
        /// Prescribed displacements of nodes.
        optional displacement: Vec<At<Displacement>>,
        /// Prescribed displacements that end at the start of the step.
        optional release: Vec<At<Release>>,
        /// Tractions on facets.
        optional traction: Vec<At<Traction>>,
        /// Pressures on facets.
        optional pressure: Vec<At<Pressure>>,
        /// Forces at nodes.
        optional force: Vec<At<Force>>,
        /// Stress-free strains and tensions of bodies.
        optional actuation: Vec<At<Actuation>>,
        /// Contents of cavities.
        optional cavity: Vec<At<Filling>>,
        /// Motions of rigid bodies.
        optional rigid: Vec<At<RigidMotion>>,
        /// Changes of friction at the start of the step.
        optional friction: Vec<At<FrictionChange>>,
    }
}

table! {
    /// Implicit dynamics by the generalised-alpha method.
    Dynamics {
        /// Spectral radius at infinite frequency: 1 keeps oscillations that the increments do not resolve, small values damp them. Default: 0.8.
        optional spectral_radius: Portion,
    }
}

table! {
    /// Velocity of a body, `vector + spin x (x - about)`.
    Velocity {
        /// The body.
        include of: VelocityOf,
        /// Velocity. Default: none.
        optional vector: [Number; 3],
        /// Angular velocity. Default: none.
        optional spin: [Number; 3],
        /// Point of the axis of the spin, in space. Default: the origin.
        optional about: [Number; 3],
    }
}

either! {
    /// Part that a velocity is given to.
    VelocityOf {
        Body(VelocityOfBody),
        Rigid(VelocityOfRigid),
    }
}

table! {
    /// A deformable body.
    VelocityOfBody {
        /// Name of the body.
        required body: Text,
    }
}

table! {
    /// A rigid body with the nodes tied to it.
    VelocityOfRigid {
        /// Name of the rigid body.
        required rigid: Text,
    }
}

table! {
    /// Acceleration of gravity, from the present value to the target.
    Gravity {
        /// Target of the acceleration.
        required vector: [Number; 3],
        /// Curve towards the target: `ramp`, `constant`, `smooth` or the name of a curve. Default:
        /// `ramp`.
        optional curve: Text,
    }
}

/// Division of a step.
#[derive(Clone, Debug)]
pub(crate) enum Increments {
    /// Number of equal increments, cut if needed.
    Number(Count),
    /// Sizes as fractions of the step.
    Sizes(IncrementSizes),
}

impl Read for Increments {
    fn read(value: &Value<'_>, place: &Place, faults: &mut FaultList<'_>) -> Option<Self> {
        match value.get_ref() {
            DeValue::Integer(_) => Count::read(value, place, faults).map(Self::Number),
            DeValue::Table(_) => read_table(value, place, faults).map(Self::Sizes),
            _ => unexpected(value, place, faults, &Self::form()),
        }
    }

    fn form() -> Form {
        Form::Any(vec![Count::form(), IncrementSizes::form()])
    }
}

table! {
    /// Sizes of increments as fractions of the step.
    IncrementSizes {
        /// First increment. Default: a tenth, or the largest if that is smaller.
        optional initial: Fraction,
        /// Smallest increment, below which the run ends. Default: a thousandth of the first.
        optional smallest: Fraction,
        /// Largest increment, at least 1e-7. Default: the first.
        optional largest: Fraction,
    }
}

table! {
    /// Prescribed displacement of nodes, from the present value to the target.
    Displacement {
        /// Name of the body.
        required body: Text,
        /// Name of its node set.
        required nodes: Text,
        /// Axes of the components, which stay as they are in the reference configuration: the first one and a vector that determines the second one, a normal, or those of a cylinder. Default: those of the model.
        optional axes: DisplacementAxes,
        /// Target of the first component; absent components keep their state.
        optional x: Varying,
        /// Target of the second component.
        optional y: Varying,
        /// Target of the third component.
        optional z: Varying,
        /// Curve towards the target: `ramp`, `constant`, `smooth` or the name of a curve. Default: `ramp`; of functions of `t` `constant`, as they are followed.
        optional curve: Text,
    }
}

/// Axes of the components of a displacement.
#[derive(Clone, Debug)]
pub(crate) enum DisplacementAxes {
    /// First axis and a vector that determines the second one.
    Two([[Number; 3]; 2]),
    /// Axes stated in a table.
    Stated(StatedAxes),
}

impl Read for DisplacementAxes {
    fn read(value: &Value<'_>, place: &Place, faults: &mut FaultList<'_>) -> Option<Self> {
        match value.get_ref() {
            DeValue::Array(_) => Read::read(value, place, faults).map(Self::Two),
            DeValue::Table(_) => read_table(value, place, faults).map(Self::Stated),
            _ => unexpected(value, place, faults, &Self::form()),
        }
    }

    fn form() -> Form {
        Form::Any(vec![<[[Number; 3]; 2]>::form(), StatedAxes::form()])
    }
}

either! {
    /// Axes of the components of a displacement.
    StatedAxes {
        Normal(NormalAxis),
        Cylindrical(CylindricalAxes),
    }
}

table! {
    /// One axis: nodes of which its component is held slide on a plane.
    NormalAxis {
        /// A vector along the first axis, of any length; there are no others.
        required normal: [Number; 3],
    }
}

table! {
    /// Radial, tangential and axial components at the reference position of each node. Tangential ones are lengths, positive by the right-hand rule about the axis.
    CylindricalAxes {
        /// A point of the axis of the cylinder.
        required point: [Number; 3],
        /// A vector along the axis, of any length.
        required axis: [Number; 3],
    }
}

table! {
    /// End of prescribed displacements.
    Release {
        /// Name of the body.
        required body: Text,
        /// Name of its node set.
        required nodes: Text,
        /// Components that become free, in whatever axes they were stated. Default: all prescribed ones.
        optional components: Vec<At<Component>>,
    }
}

words! {
    /// A component of a vector.
    Component {
        /// First component.
        X = "x",
        /// Second component.
        Y = "y",
        /// Third component.
        Z = "z",
    }
}

table! {
    /// Force per area on facets.
    Traction {
        /// Name of the body.
        required body: Text,
        /// Name of its facet set.
        required facets: Text,
        /// Target of the traction.
        required vector: [Varying; 3],
        /// Direction of the force as the body deforms. Default: `dead`.
        optional direction: Direction,
        /// Part of the facets that is loaded. Default: `whole`.
        optional extent: Extent,
        /// Curve towards the target: `ramp`, `constant`, `smooth` or the name of a curve. Default:
        /// `ramp`.
        optional curve: Text,
    }
}

words! {
    /// Behaviour of a traction while the facets move.
    Direction {
        /// Force per reference area of fixed direction.
        Dead = "dead",
        /// Force per current area that rotates with the facet.
        Follower = "follower",
    }
}

words! {
    /// Part of the facets that carries a load.
    Extent {
        /// All facets.
        Whole = "whole",
        /// Only the part that no other contact surface covers.
        Exposed = "exposed",
    }
}

table! {
    /// Pressure on facets: force per current area against the current normal.
    Pressure {
        /// Name of the body.
        required body: Text,
        /// Name of its facet set.
        required facets: Text,
        /// Target of the pressure, positive inwards.
        required value: Varying,
        /// Part of the facets that is loaded. Default: `whole`.
        optional extent: Extent,
        /// Curve towards the target: `ramp`, `constant`, `smooth` or the name of a curve. Default: `ramp`; of functions of `t` `constant`.
        optional curve: Text,
    }
}

table! {
    /// Force of fixed direction at the nodes of a set, which may be a single one: see `nearest` and `numbers` of `set`.
    Force {
        /// Name of the body.
        required body: Text,
        /// Name of its node set.
        required nodes: Text,
        /// The force.
        include target: ForceTarget,
        /// Curve towards the target: `ramp`, `constant`, `smooth` or the name of a curve. Default: `ramp`; of functions of `t` `constant`.
        optional curve: Text,
    }
}

either! {
    /// Nodes that a force is stated for.
    ForceTarget {
        Total(ForceTotal),
        Each(ForceEach),
    }
}

table! {
    /// A force that all nodes take in equal parts.
    ForceTotal {
        /// Target of the force at all nodes together.
        required total: [Varying; 3],
    }
}

table! {
    /// A force at each node.
    ForceEach {
        /// Target of the force at each node.
        required each: [Varying; 3],
    }
}

table! {
    /// Motion of a rigid body. Initially all its coordinates are held.
    RigidMotion {
        /// Name of the rigid body.
        required surface: Text,
        /// Target of the displacement of its reference point. Default: it stays free or at its
        /// place.
        optional displacement: [Number; 3],
        /// Targets of the rotation angles about the fixed axes, in degrees, which add up increment
        /// by increment: the order of turns about several axes counts. Default: they stay free or
        /// unchanged.
        optional rotation: [Number; 3],
        /// Coordinates that are free, until a later step gives them a target again, and follow the
        /// forces; they have no target. A `displacement` gives all directions a target that are not
        /// listed here.
        optional free: Vec<At<Coordinate>>,
        /// Target of the force that drives free coordinates, at the reference point.
        optional force: [Number; 3],
        /// Target of the torque that drives free coordinates.
        optional torque: [Number; 3],
        /// Curve towards the targets: `ramp`, `constant`, `smooth` or the name of a curve. Default:
        /// `ramp`.
        optional curve: Text,
    }
}

words! {
    /// A coordinate of a rigid body.
    Coordinate {
        /// Displacement along the first axis.
        X = "x",
        /// Displacement along the second axis.
        Y = "y",
        /// Displacement along the third axis.
        Z = "z",
        /// Angle about the first axis.
        Rx = "rx",
        /// Angle about the second axis.
        Ry = "ry",
        /// Angle about the third axis.
        Rz = "rz",
    }
}

table! {
    /// Friction of a pair from the start of the step.
    FrictionChange {
        /// Name of the pair.
        required pair: Text,
        /// Its new friction.
        include friction: Friction,
    }
}
