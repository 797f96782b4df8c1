//! Choice of PETSc's solvers.

/// Choice of PETSc's solvers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Choice {
    /// MUMPS for systems of few unknowns, else FGMRES, and MUMPS where that fails.
    #[default]
    ByCost,
    /// FGMRES, whatever it costs; MUMPS where it fails.
    Iterative,
    /// MUMPS, and no other.
    Mumps,
}
