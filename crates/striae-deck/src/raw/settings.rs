//! `[output]` and `[solver]`.

use crate::{
    declare::{choice, table, words},
    value::{Count, Positive, Whole},
};

table! {
    /// What is written.
    OutputSettings {
        /// Increments between files of fields; 0: only the last. Default: 1.
        optional fields_every: Whole<0>,
        /// Increments between checkpoints, from which `striae resume` goes on; 0: only when interrupted. Default: 10.
        optional checkpoint_every: Whole<0>,
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
