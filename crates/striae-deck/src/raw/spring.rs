//! Springs and dashpots.

use crate::{
    declare::{either, table},
    value::{NonNegative, Number, Positive, Text},
};

table! {
    /// Springs, dashpots or both, from each node of end `a`; they act from the start of the run on.
    Spring {
        /// Unique name.
        required name: Text,
        /// First end.
        required a: SpringEnd,
        /// Second end, a single point: the springs act along the line between both ends as these
        /// move.
        optional b: SecondSpringEnd,
        /// Fixed direction of any length, instead of `b`: the springs resist displacements along it
        /// against ground.
        optional direction: [Number; 3],
        /// Tension of each spring over its elongation. Default: 0.
        optional stiffness: NonNegative,
        /// Tension of the dashpot beside each spring over the rate of elongation, in the time of the
        /// step. Default: 0.
        optional damping: NonNegative,
        /// Length at which the springs have no tension; needs `b`. Default: their length at the
        /// start.
        optional free_length: Positive,
        /// Tension of each spring at the start, negative for compression; instead of `free_length`.
        /// Default: 0.
        optional preload: Number,
    }
}

either! {
    /// An end of springs that moves with a body.
    SpringEnd {
        Nodes(SpringNodes),
        Rigid(SpringPoint),
    }
}

either! {
    /// The second end of springs.
    SecondSpringEnd {
        Nodes(SpringNodes),
        Rigid(SpringPoint),
        Fixed(FixedPoint),
    }
}

table! {
    /// Nodes of a deformable body; a single one at a second end.
    SpringNodes {
        /// Name of the body.
        required body: Text,
        /// Name of its node set.
        required nodes: Text,
    }
}

table! {
    /// A point of a rigid body.
    SpringPoint {
        /// Name of the rigid body.
        required rigid: Text,
        /// Position of the point at the start. Default: the reference point of the body.
        optional point: [Number; 3],
    }
}

table! {
    /// A point that is at rest.
    FixedPoint {
        /// Its position.
        required fixed: [Number; 3],
    }
}
