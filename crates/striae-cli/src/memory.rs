//! The allocator of the program.
//!
//! Every iteration allocates and frees vectors of the size of the model, on all threads.
//! With mimalloc that takes a tenth less time than with the allocator of glibc. By default it
//! gives freed pages back to the operating system after a while, to ask for them again in the
//! next iteration, which faults and clears every page; here it keeps them.

#![allow(unsafe_code)]

use libmimalloc_sys::{mi_option_set, mi_option_t};

#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// `mi_option_purge_delay` of mimalloc.h: milliseconds until freed pages are given back.
const PURGE_DELAY: mi_option_t = 15;
/// Never.
const NEVER: std::ffi::c_long = -1;

/// Keeps freed pages for later allocations.
pub fn keep_freed() {
    // SAFETY: the function sets a number and touches no memory of the program.
    unsafe { mi_option_set(PURGE_DELAY, NEVER) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use libmimalloc_sys::mi_option_get;

    #[test]
    fn the_number_is_that_of_the_delay() {
        // SAFETY: as above.
        let before = unsafe { mi_option_get(PURGE_DELAY) };
        // The default of mimalloc 3, which no other option has.
        assert_eq!(before, 1000);
        keep_freed();
        assert_eq!(unsafe { mi_option_get(PURGE_DELAY) }, NEVER);
    }
}
