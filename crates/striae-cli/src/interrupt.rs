//! Interrupts from the keyboard, and SIGTERM and SIGHUP, which are taken alike.

use std::io::Write;

use striae::{Before, Interrupt};

use crate::failure::INTERRUPTED;

/// Listens to interrupts: the first one stops the run under way, the second one ends
/// the program.
pub fn listen() -> Interrupt {
    let interrupt = Interrupt::default();
    let set = interrupt.clone();
    // Without a handler an interrupt ends the program at once; results on disk stay valid.
    let _ = ctrlc::set_handler(move || {
        if set.set() == Before::Set {
            std::process::exit(i32::from(INTERRUPTED));
        }
        let text = "stopping after this increment; interrupt again to stop at once";
        let _ = writeln!(std::io::stderr(), "{text}");
    });
    interrupt
}
