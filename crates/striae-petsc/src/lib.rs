//! Ranks over MPI, and systems in parts solved by PETSc.
//!
//! `Ranks` are the [`Team`](striae_solve::team::Team) of a program that was started as
//! `mpirun -n N ...`. `PetscSolver` is the [`TangentSolver`](striae_condensed::TangentSolver)
//! of systems whose parts the ranks hold:
//!
//! - by FGMRES. The product with the matrix is the sum of the products of the parts, no
//!   rank puts a whole row together. The preconditioner is the block factorisation of the
//!   [iterative solver](striae_condensed): bodies by one cycle of algebraic multigrid,
//!   contact by factors that all ranks make of it alike. The finest level has aggregates of
//!   its own, which do not reach over contact; all others are PETSc's (GAMG).
//! - or by MUMPS, a direct solver, on the matrix put together.
//!
//! Without the feature `petsc` this crate is empty, and needs neither library.
//!
//! # Options
//!
//! PETSc takes its options from the variable `PETSC_OPTIONS` and from what
//! `Ranks::start` is given. Prefixes are `striae_` for FGMRES, `striae_bulk_` for the
//! cycle on the bodies and `striae_direct_` for the direct solver: `-striae_ksp_monitor`
//! prints residuals, `-striae_bulk_pc_type hypre` takes BoomerAMG for all levels.
//!
//! # Faults
//!
//! All functions are collective, and errors that PETSc reports come back on all ranks. A rank that
//! panics takes all others down with it: MPI has no other way to leave those that wait.

#[cfg(feature = "petsc")]
mod binding;
#[cfg(feature = "petsc")]
mod borders;
#[cfg(feature = "petsc")]
mod bulk;
#[cfg(feature = "petsc")]
mod choice;
#[cfg(feature = "petsc")]
mod coupling;
#[cfg(feature = "petsc")]
mod direct;
#[cfg(feature = "petsc")]
mod error;
#[cfg(feature = "petsc")]
mod foreign;
#[cfg(feature = "petsc")]
mod gathered;
#[cfg(feature = "petsc")]
mod halo;
#[cfg(feature = "petsc")]
mod iterative;
#[cfg(feature = "petsc")]
mod level;
#[cfg(feature = "petsc")]
mod nodes;
#[cfg(feature = "petsc")]
mod product;
#[cfg(feature = "petsc")]
mod ranks;
#[cfg(feature = "petsc")]
mod solver;

#[cfg(feature = "petsc")]
pub use {choice::Choice, error::Error, ranks::Ranks, solver::PetscSolver};
