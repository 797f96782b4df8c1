//! Sparse linear algebra: patterns, orderings, factorisations; no mechanics.
//!
//! The unknowns are grouped in [`Supervariable`]s (all that lives at one mesh
//! node). A [`Structure`] says which supervariables share an equation, a
//! [`SparseMatrix`] holds values on that fixed pattern, and a [`LinearSolver`]
//! analyses the structure once and factors and solves as often as needed:
//!
//! ```
//! use striae_linalg::{LinearSolver, MultifrontalLu, SparseMatrix, Structure, Supervariable};
//!
//! let (a, b) = (Supervariable(0), Supervariable(1));
//! let structure = Structure::from_cliques(vec![0, 1, 2], &[[a, b]])?;
//! let mut matrix = SparseMatrix::zero(&structure);
//! matrix.add(&[0, 1], &[0, 1], &[2.0, 1.0, 1.0, 0.0])?;
//!
//! let mut solver = MultifrontalLu::new();
//! solver.analyse(&structure)?;
//! solver.factor(&matrix)?;
//! let mut x = [0.0; 2];
//! let report = solver.solve(&matrix, &[3.0, 1.0], &mut x)?;
//! assert_eq!(x, [1.0, 1.0]);
//! assert!(report.backward_error < 1e-15);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod aggregation;
mod automatic;
mod bulk;
mod condensed;
mod dense;
mod descent;
mod equilibration;
mod error;
mod faer_lu;
mod flexibility;
mod front;
mod gmres;
mod interface;
mod iterative;
mod matrix;
mod metis;
mod multifrontal;
mod numeric;
mod ordering;
mod products;
mod real;
mod refinement;
mod schur;
mod singularity;
mod solver;
mod sparse_elimination;
mod structure;
mod substitution;
mod supernodes;
mod symmetric;
mod tree;
mod triangular;

pub use automatic::Automatic;
pub use error::{OutsidePattern, SolveError, StructureError};
pub use faer::Mat;
pub use faer_lu::FaerLu;
pub use matrix::{PlacedBlock, SparseMatrix};
pub use multifrontal::MultifrontalLu;
pub use ordering::nested_dissection;
pub use real::Precision;
pub use schur::SchurCholesky;
pub use solver::{
    Analysis, Experience, FactorReport, FactoredInterior, FallBack, Interior, LinearSolver, Method,
    REDUCTION, SolveReport,
};
pub use structure::{Structure, Supervariable, Tier};
