//! PETSc from its start to its end.

use super::ffi;
use crate::error::Error;
use mpi::{ffi::MPI_Comm, raw::AsRaw, topology::SimpleCommunicator};
use std::{
    ffi::{CStr, CString, c_char, c_int, c_void},
    ptr,
    sync::{Arc, Mutex},
    thread,
};

/// PETSc, initialised; finalised when dropped.
#[derive(Debug)]
pub(crate) struct Library {
    /// Message of the last error.
    message: Arc<Mutex<Option<String>>>,
}

impl Library {
    /// Initialises PETSc, with MPI running, and gives it options.
    pub(crate) fn start(options: &[&str]) -> Result<Self, Error> {
        // Signals are the program's.
        let own = ["striae", "-no_signal_handler"].into_iter();
        let arguments: Vec<CString> = own
            .chain(options.iter().copied())
            .filter_map(|argument| CString::new(argument).ok())
            .collect();
        let mut pointers: Vec<*mut c_char> = arguments
            .into_iter()
            .map(CString::into_raw)
            .chain([ptr::null_mut()])
            .collect();
        let library = Self {
            message: Arc::default(),
        };
        // PETSc looks at its arguments up to the end: they stay for good.
        let count = Box::leak(Box::new(pointers.len() as c_int - 1));
        let first = Box::leak(Box::new(pointers.as_mut_ptr()));
        pointers.leak();
        // SAFETY: count and arguments are as those of a program, and are never freed. The
        // context of the handler lives until the program ends.
        unsafe {
            let null = ptr::null();
            library.check(ffi::PetscInitialize(count, first, null, null))?;
            let context = Arc::into_raw(Arc::clone(&library.message));
            let context = context.cast_mut().cast();
            library.check(ffi::PetscPushErrorHandler(collect, context))?;
        }
        library.check_kinds()?;
        Ok(library)
    }

    /// The error of a code, if it is one.
    pub(super) fn check(&self, code: ffi::Code) -> Result<(), Error> {
        if code == 0 {
            return Ok(());
        }
        let said = self.message.lock().ok().and_then(|mut said| said.take());
        let message = said.unwrap_or_else(|| general(code));
        Err(Error::Petsc { code, message })
    }

    /// Returns whether an option has a value.
    pub(crate) fn has_option(&self, prefix: &str, name: &str) -> Result<bool, Error> {
        let mut is_set = ffi::FALSE;
        let (prefix, name) = (text(prefix), text(&format!("-{name}")));
        // SAFETY: strings end with zero and live beyond the call; null means all options.
        let code = unsafe {
            let (all, prefix) = (ptr::null_mut(), prefix.as_ptr());
            ffi::PetscOptionsHasName(all, prefix, name.as_ptr(), &mut is_set)
        };
        self.check(code)?;
        Ok(is_set != ffi::FALSE)
    }

    /// Gives an option a value unless it has one.
    pub(crate) fn option(&self, prefix: &str, name: &str, value: &str) -> Result<(), Error> {
        if self.has_option(prefix, name)? {
            return Ok(());
        }
        let (name, value) = (text(&format!("-{prefix}{name}")), text(value));
        let all = ptr::null_mut();
        // SAFETY: strings end with zero and live beyond the call; null means all options.
        let code = unsafe { ffi::PetscOptionsSetValue(all, name.as_ptr(), value.as_ptr()) };
        self.check(code)
    }

    /// Checks that sizes of number types agree with the declarations.
    fn check_kinds(&self) -> Result<(), Error> {
        let size = |name: &CStr| {
            let (mut kind, mut found, mut size) = (0, ffi::FALSE, 0);
            // SAFETY: a string that ends with zero, and places for the answers.
            unsafe {
                let code = ffi::PetscDataTypeFromString(name.as_ptr(), &mut kind, &mut found);
                self.check(code)?;
                self.check(ffi::PetscDataTypeGetSize(kind, &mut size))?;
            }
            Ok::<usize, Error>(size)
        };
        let (scalar, real, index) = (size(c"scalar")?, size(c"real")?, size(c"int")?);
        match (scalar, real, index) {
            (8, 8, 4) => Ok(()),
            _ => Err(Error::Kinds {
                scalar,
                real,
                index,
            }),
        }
    }
}

impl Drop for Library {
    fn drop(&mut self) {
        if !thread::panicking() {
            // SAFETY: objects hold the library, so that they are gone.
            unsafe { ffi::PetscFinalize() };
        }
    }
}

/// Gives memory that PETSc has freed back to the system, so that others can have it. The GNU C
/// library would keep it for later requests of PETSc, even vectors of megabytes.
pub(super) fn give_back() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    // SAFETY: may be called at any time.
    unsafe {
        ffi::malloc_trim(0);
    }
}

/// All ranks.
pub(super) fn world() -> MPI_Comm {
    SimpleCommunicator::world().as_raw()
}

/// Communicator of this rank alone.
pub(super) fn alone() -> MPI_Comm {
    SimpleCommunicator::self_comm().as_raw()
}

/// Number of ranks.
pub(super) fn ranks() -> usize {
    use mpi::traits::Communicator;
    SimpleCommunicator::world().size() as usize
}

/// A string for PETSc.
pub(super) fn text(text: &str) -> CString {
    CString::new(text).unwrap_or_default()
}

/// A number of PETSc.
pub(super) fn index(number: usize) -> Result<c_int, Error> {
    c_int::try_from(number).map_err(|_| Error::Petsc {
        code: 0,
        message: format!("{number} is too large for indices of 32 bits"),
    })
}

/// PETSc's description of an error code.
fn general(code: ffi::Code) -> String {
    let mut said = ptr::null();
    // SAFETY: the answer is null or a string that is never freed.
    unsafe {
        ffi::PetscErrorMessage(code, &mut said, ptr::null_mut());
        match said.is_null() {
            true => "no message".to_owned(),
            false => CStr::from_ptr(said).to_string_lossy().into_owned(),
        }
    }
}

/// Keeps what an error says where it comes up first.
unsafe extern "C" fn collect(
    _: MPI_Comm,
    _: c_int,
    function: *const c_char,
    _: *const c_char,
    code: ffi::Code,
    kind: c_int,
    message: *const c_char,
    context: *mut c_void,
) -> ffi::Code {
    if kind != ffi::ERROR_INITIAL || context.is_null() {
        return code;
    }
    let words = |text: *const c_char| match text.is_null() {
        true => String::new(),
        // SAFETY: PETSc hands over strings that end with zero.
        false => unsafe { CStr::from_ptr(text) }
            .to_string_lossy()
            .into_owned(),
    };
    // SAFETY: the context is the one that was given with the handler, and is never freed.
    let said = unsafe { &*context.cast::<Mutex<Option<String>>>() };
    if let Ok(mut said) = said.lock() {
        *said = Some(format!("{}: {}", words(function), words(message).trim()));
    }
    code
}
