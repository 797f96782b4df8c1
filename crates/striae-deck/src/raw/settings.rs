//! `[output]` and `[solver]`.

use crate::{
    declare::{choice, either, table, words},
    read::At,
    value::{Count, Number, Positive, Text, Whole},
};

table! {
    /// What is written.
    OutputSettings {
        /// Increments between files of fields; 0: only the last. Default: 1.
        optional fields_every: Whole<0>,
        /// Time between files of fields, in the place of `fields_every`: they are written after the first increment that reaches each multiple of it.
        optional fields_interval: Positive,
        /// Names of the bodies whose fields are written. Default: all.
        optional bodies: Vec<At<Text>>,
        /// Fields of bodies. Default: `displacement`, `velocity`, `cauchy-stress` and `von-mises`.
        optional body_fields: Vec<At<BodyField>>,
        /// Archard's coefficient `k`, wear depth over pressure and slip: writes the field `wear_depth` of contact surfaces. Default: none.
        optional wear_coefficient: Positive,
        /// Places whose displacement and stress are written to `probes.csv` after every increment.
        optional probes: Vec<At<Probe>>,
        /// Increments between checkpoints, from which `striae resume` goes on; 0: only when interrupted. Default: 10.
        optional checkpoint_every: Whole<0>,
    }
}

words! {
    /// A field of a body.
    BodyField {
        /// Displacement.
        Displacement = "displacement",
        /// Velocity, in dynamic steps.
        Velocity = "velocity",
        /// Cauchy stress at the nodes.
        CauchyStress = "cauchy-stress",
        /// Equivalent stress of von Mises.
        VonMises = "von-mises",
        /// Principal values of the Cauchy stress, the largest first.
        PrincipalStress = "principal-stress",
        /// Stored energy per volume at rest of the elements at each node.
        StrainEnergyDensity = "strain-energy-density",
    }
}

table! {
    /// A place of a body that is watched.
    Probe {
        /// Name of its columns.
        required name: Text,
        /// Name of the body.
        required body: Text,
        /// Where it is.
        include place: ProbePlace,
    }
}

either! {
    /// Where a probe is.
    ProbePlace {
        Point(ProbePoint),
        Nodes(ProbeNodes),
    }
}

table! {
    /// A material point.
    ProbePoint {
        /// Its place before anything has moved; values are interpolated.
        required point: [Number; 3],
    }
}

table! {
    /// The mean over a set of nodes.
    ProbeNodes {
        /// Name of the node set.
        required nodes: Text,
    }
}

table! {
    /// Newton's method and the linear solver.
    SolverSettings {
        /// Factorisation of the linear systems. Default: `condensed`.
        optional backend: Backend,
        /// How stick and slip are found. Default: `semismooth`.
        optional strategy: Strategy,
        /// Relative tolerance of every residual field. Default: 1e-10.
        optional tolerance: Positive,
        /// Iterations after which an increment is cut. Default: 40.
        optional largest_iterations: Count,
    }
}

words! {
    /// Factorisation of the linear systems.
    Backend {
        /// Bodies by Cholesky and contact by dense algebra; multifrontal LU where that does not work or pay, `iterative` for large bodies.
        Condensed = "condensed",
        /// Multifrontal LU on dense fronts.
        Multifrontal = "multifrontal",
        /// Sparse LU of the library faer.
        Faer = "faer",
        /// GMRES, the bodies by smoothed aggregation; direct factors where that fails.
        Iterative = "iterative",
    }
}

choice! {
    /// How stick and slip are found.
    Strategy by method {
        "semismooth" => Semismooth(Semismooth),
        "table-1" => Table1(Table1),
    }
}

table! {
    /// As part of the linearisation.
    Semismooth {}
}

table! {
    /// By a predictor and a corrector between iterations, for comparison.
    Table1 {
        /// How far friction may exceed the law, relative to it, before a sticking node slips. Default: 0.01.
        optional stick_tolerance: Positive,
    }
}
