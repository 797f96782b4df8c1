//! Interrupts from the keyboard, and SIGTERM, SIGHUP and SIGUSR1, which are taken alike.
//!
//! `mpirun` passes SIGUSR1 on to all ranks; on SIGTERM it ends them itself, two seconds later.

use std::io::Write;
#[cfg(unix)]
use std::thread;

#[cfg(unix)]
use nix::sys::signal::{SigSet, Signal};
use striae::{Before, Interrupt};

use crate::failure::INTERRUPTED;

/// Keeps SIGUSR1 until the program [listens](listen), so that it does not end it before, and
/// SIGXFSZ for good, so that a file that gets too large is a fault of writing. To be called
/// before there are other threads, which take that over.
pub fn prepare() {
    #[cfg(unix)]
    {
        let mut kept = user_signal();
        kept.add(Signal::SIGXFSZ);
        let _ = kept.thread_block();
    }
}

/// Listens to interrupts: the first one stops the current run, the second one ends
/// the program.
pub fn listen() -> Interrupt {
    let interrupt = Interrupt::default();
    let set = interrupt.clone();
    // Without a handler an interrupt ends the program at once; results on disk stay valid.
    let _ = ctrlc::set_handler(move || stop(&set));
    #[cfg(unix)]
    {
        let set = interrupt.clone();
        thread::spawn(move || {
            while user_signal().wait().is_ok() {
                stop(&set);
            }
        });
    }
    interrupt
}

/// An interrupt has come.
fn stop(interrupt: &Interrupt) {
    if interrupt.set() == Before::Set {
        std::process::exit(i32::from(INTERRUPTED));
    }
    let text = "stopping after this increment; interrupt again to stop immediately";
    let _ = writeln!(std::io::stderr(), "{text}");
}

/// Signal that batch systems send through `mpirun`.
#[cfg(unix)]
fn user_signal() -> SigSet {
    let mut signals = SigSet::empty();
    signals.add(Signal::SIGUSR1);
    signals
}
