//! Functions of PETSc that are called, declared by hand: real scalars, 32-bit indices.
//!
//! The numbers behind the constants are those of PETSc's headers since 3.18; the sizes of its types
//! are checked at startup.

use mpi::ffi::MPI_Comm;
use std::ffi::{c_char, c_int, c_void};

/// An error code; zero is none.
pub(super) type Code = c_int;
/// A truth value.
pub(super) type Bool = c_int;

/// Kinds of objects.
macro_rules! handles {
    ($($name:ident),*) => {$(
        #[doc = concat!("A handle of a ", stringify!($name), ".")]
        #[repr(transparent)]
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) struct $name(*mut c_void);

        impl $name {
            /// No object.
            pub(super) const NULL: Self = Self(std::ptr::null_mut());
        }

        // SAFETY: PETSc does not mind which thread calls it, one at a time. Objects are
        // called by who may change them, and the handle alone does nothing.
        unsafe impl Send for $name {}
        // SAFETY: as above.
        unsafe impl Sync for $name {}
    )*};
}
handles!(Vec, IndexSet, VecScatter, Mat, NullSpace, Ksp, Pc);

/// A handler of errors: communicator, line, function, file, code, kind, message, context.
pub(super) type ErrorHandler = unsafe extern "C" fn(
    MPI_Comm,
    c_int,
    *const c_char,
    *const c_char,
    Code,
    c_int,
    *const c_char,
    *mut c_void,
) -> Code;

pub(super) const FALSE: Bool = 0;
pub(super) const ERROR_INITIAL: c_int = 0;
pub(super) const INSERT_VALUES: c_int = 1;
pub(super) const ADD_VALUES: c_int = 2;
pub(super) const MAX_VALUES: c_int = 3;
pub(super) const SCATTER_FORWARD: c_int = 0;
pub(super) const SCATTER_REVERSE: c_int = 1;
pub(super) const COPY_VALUES: c_int = 0;
pub(super) const FINAL_ASSEMBLY: c_int = 0;
pub(super) const MATOP_MULT: c_int = 3;

#[cfg(all(target_os = "linux", target_env = "gnu"))]
unsafe extern "C" {
    /// Of the GNU C library: gives free memory back to the system, all but so many bytes.
    pub(super) fn malloc_trim(kept: usize) -> c_int;
}

unsafe extern "C" {
    pub(super) fn PetscInitialize(
        argc: *mut c_int,
        args: *mut *mut *mut c_char,
        file: *const c_char,
        help: *const c_char,
    ) -> Code;
    pub(super) fn PetscFinalize() -> Code;
    pub(super) fn PetscPushErrorHandler(handler: ErrorHandler, context: *mut c_void) -> Code;
    pub(super) fn PetscErrorMessage(
        code: c_int,
        text: *mut *const c_char,
        specific: *mut *mut c_char,
    ) -> Code;
    pub(super) fn PetscDataTypeFromString(
        name: *const c_char,
        kind: *mut c_int,
        found: *mut Bool,
    ) -> Code;
    pub(super) fn PetscDataTypeGetSize(kind: c_int, size: *mut usize) -> Code;
    pub(super) fn PetscOptionsHasName(
        options: *mut c_void,
        prefix: *const c_char,
        name: *const c_char,
        set: *mut Bool,
    ) -> Code;
    pub(super) fn PetscOptionsSetValue(
        options: *mut c_void,
        name: *const c_char,
        value: *const c_char,
    ) -> Code;

    pub(super) fn VecCreateSeqWithArray(
        comm: MPI_Comm,
        block: c_int,
        count: c_int,
        array: *const f64,
        vector: *mut Vec,
    ) -> Code;
    pub(super) fn VecCreateMPIWithArray(
        comm: MPI_Comm,
        block: c_int,
        own: c_int,
        total: c_int,
        array: *const f64,
        vector: *mut Vec,
    ) -> Code;
    pub(super) fn VecPlaceArray(vector: Vec, array: *const f64) -> Code;
    pub(super) fn VecResetArray(vector: Vec) -> Code;
    pub(super) fn VecGetArrayRead(vector: Vec, array: *mut *const f64) -> Code;
    pub(super) fn VecRestoreArrayRead(vector: Vec, array: *mut *const f64) -> Code;
    pub(super) fn VecGetArray(vector: Vec, array: *mut *mut f64) -> Code;
    pub(super) fn VecRestoreArray(vector: Vec, array: *mut *mut f64) -> Code;
    pub(super) fn VecGetLocalSize(vector: Vec, size: *mut c_int) -> Code;
    pub(super) fn VecDestroy(vector: *mut Vec) -> Code;

    pub(super) fn ISCreateGeneral(
        comm: MPI_Comm,
        count: c_int,
        indices: *const c_int,
        mode: c_int,
        set: *mut IndexSet,
    ) -> Code;
    pub(super) fn ISDestroy(set: *mut IndexSet) -> Code;
    pub(super) fn VecScatterCreate(
        from: Vec,
        from_set: IndexSet,
        to: Vec,
        to_set: IndexSet,
        scatter: *mut VecScatter,
    ) -> Code;
    pub(super) fn VecScatterBegin(
        scatter: VecScatter,
        from: Vec,
        to: Vec,
        insert: c_int,
        mode: c_int,
    ) -> Code;
    pub(super) fn VecScatterEnd(
        scatter: VecScatter,
        from: Vec,
        to: Vec,
        insert: c_int,
        mode: c_int,
    ) -> Code;
    pub(super) fn VecScatterDestroy(scatter: *mut VecScatter) -> Code;

    pub(super) fn MatCreate(comm: MPI_Comm, matrix: *mut Mat) -> Code;
    pub(super) fn MatSetSizes(
        matrix: Mat,
        own_rows: c_int,
        own_columns: c_int,
        rows: c_int,
        columns: c_int,
    ) -> Code;
    pub(super) fn MatSetType(matrix: Mat, kind: *const c_char) -> Code;
    pub(super) fn MatSetBlockSizes(matrix: Mat, rows: c_int, columns: c_int) -> Code;
    pub(super) fn MatSeqAIJSetPreallocation(
        matrix: Mat,
        each: c_int,
        entries: *const c_int,
    ) -> Code;
    pub(super) fn MatMPIAIJSetPreallocation(
        matrix: Mat,
        each: c_int,
        entries: *const c_int,
        each_off: c_int,
        entries_off: *const c_int,
    ) -> Code;
    pub(super) fn MatSetValues(
        matrix: Mat,
        row_count: c_int,
        rows: *const c_int,
        column_count: c_int,
        columns: *const c_int,
        values: *const f64,
        mode: c_int,
    ) -> Code;
    pub(super) fn MatAssemblyBegin(matrix: Mat, kind: c_int) -> Code;
    pub(super) fn MatAssemblyEnd(matrix: Mat, kind: c_int) -> Code;
    pub(super) fn MatMult(matrix: Mat, x: Vec, y: Vec) -> Code;
    pub(super) fn MatDestroy(matrix: *mut Mat) -> Code;
    pub(super) fn MatNullSpaceCreate(
        comm: MPI_Comm,
        has_constant: Bool,
        count: c_int,
        vectors: *const Vec,
        space: *mut NullSpace,
    ) -> Code;
    pub(super) fn MatNullSpaceDestroy(space: *mut NullSpace) -> Code;
    pub(super) fn MatSetNearNullSpace(matrix: Mat, space: NullSpace) -> Code;
    pub(super) fn MatCreateShell(
        comm: MPI_Comm,
        own_rows: c_int,
        own_columns: c_int,
        rows: c_int,
        columns: c_int,
        context: *mut c_void,
        matrix: *mut Mat,
    ) -> Code;
    pub(super) fn MatShellSetOperation(
        matrix: Mat,
        operation: c_int,
        function: unsafe extern "C" fn(Mat, Vec, Vec) -> Code,
    ) -> Code;
    pub(super) fn MatShellGetContext(matrix: Mat, context: *mut c_void) -> Code;
    pub(super) fn MatMumpsSetIcntl(matrix: Mat, number: c_int, value: c_int) -> Code;
    pub(super) fn MatMumpsGetInfog(matrix: Mat, number: c_int, value: *mut c_int) -> Code;

    pub(super) fn PCCreate(comm: MPI_Comm, pc: *mut Pc) -> Code;
    pub(super) fn PCSetType(pc: Pc, kind: *const c_char) -> Code;
    pub(super) fn PCSetOperators(pc: Pc, matrix: Mat, preconditioner: Mat) -> Code;
    pub(super) fn PCSetOptionsPrefix(pc: Pc, prefix: *const c_char) -> Code;
    pub(super) fn PCSetFromOptions(pc: Pc) -> Code;
    pub(super) fn PCSetUp(pc: Pc) -> Code;
    pub(super) fn PCGetFailedReason(pc: Pc, reason: *mut c_int) -> Code;
    pub(super) fn PCApply(pc: Pc, x: Vec, y: Vec) -> Code;
    pub(super) fn PCApplyTranspose(pc: Pc, x: Vec, y: Vec) -> Code;
    pub(super) fn PCFactorSetMatSolverType(pc: Pc, kind: *const c_char) -> Code;
    pub(super) fn PCFactorSetUpMatSolverType(pc: Pc) -> Code;
    pub(super) fn PCFactorGetMatrix(pc: Pc, factors: *mut Mat) -> Code;
    pub(super) fn PCShellSetApply(
        pc: Pc,
        function: unsafe extern "C" fn(Pc, Vec, Vec) -> Code,
    ) -> Code;
    pub(super) fn PCShellSetContext(pc: Pc, context: *mut c_void) -> Code;
    pub(super) fn PCShellGetContext(pc: Pc, context: *mut c_void) -> Code;
    pub(super) fn PCDestroy(pc: *mut Pc) -> Code;

    pub(super) fn KSPCreate(comm: MPI_Comm, ksp: *mut Ksp) -> Code;
    pub(super) fn KSPSetType(ksp: Ksp, kind: *const c_char) -> Code;
    pub(super) fn KSPSetOptionsPrefix(ksp: Ksp, prefix: *const c_char) -> Code;
    pub(super) fn KSPSetFromOptions(ksp: Ksp) -> Code;
    pub(super) fn KSPSetOperators(ksp: Ksp, matrix: Mat, preconditioner: Mat) -> Code;
    pub(super) fn KSPSetTolerances(
        ksp: Ksp,
        relative: f64,
        absolute: f64,
        divergence: f64,
        iterations: c_int,
    ) -> Code;
    pub(super) fn KSPGMRESSetRestart(ksp: Ksp, restart: c_int) -> Code;
    pub(super) fn KSPGetPC(ksp: Ksp, pc: *mut Pc) -> Code;
    pub(super) fn KSPSolve(ksp: Ksp, rhs: Vec, solution: Vec) -> Code;
    pub(super) fn KSPGetIterationNumber(ksp: Ksp, iterations: *mut c_int) -> Code;
    pub(super) fn KSPDestroy(ksp: *mut Ksp) -> Code;
}
