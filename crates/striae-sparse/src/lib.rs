//! Sparse linear algebra: patterns, orderings, factorisations, preconditioners.
//!
//! The unknowns are grouped in [`Supervariable`]s (all that lives at one mesh
//! node). A [`Structure`] says which supervariables share an equation, a
//! [`SparseMatrix`] holds values on that fixed pattern, and a [`LinearSolver`]
//! analyses the structure once and factors and solves as often as needed:
//!
//! ```
//! use striae_sparse::{LinearSolver, MultifrontalLu, SparseMatrix, Structure, Supervariable};
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

pub mod aggregation;
mod compressed;
pub mod dense;
mod descent;
mod division;
mod equilibration;
mod error;
mod faer_lu;
mod front;
pub mod gmres;
mod matrix;
mod metis;
mod multifrontal;
mod numeric;
mod ordering;
mod products;
mod real;
pub mod refinement;
mod schur;
mod singularity;
mod solver;
pub mod sparse_elimination;
mod structure;
mod substitution;
mod supernodes;
mod supervariable;
pub mod symmetric;
mod tree;
pub mod triangular;

pub use compressed::{CompressedRows, PlacedBlock};
pub use division::{Neighbourhood, divided};
pub use equilibration::{Equilibration, check_finite, root};
pub use error::{OutsidePattern, SolveError, StructureError};
pub use faer::Mat;
pub use faer_lu::FaerLu;
pub use matrix::{CliquePlaces, Member, MemberRows, SparseMatrix};
pub use multifrontal::MultifrontalLu;
pub use ordering::nested_dissection;
pub use products::{LinearOperator, Residual, RowSums};
pub use real::{Precision, Real};
pub use schur::{SchurCholesky, Values, mirror_lower};
pub use singularity::Factors;
pub use solver::{Age, Cost, FactorReport, LinearSolver, SolveReport};
pub use structure::Structure;
pub use supervariable::{Supervariable, Tier};
