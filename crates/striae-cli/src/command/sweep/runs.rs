//! Runs of a sweep: processes, several at a time, that an interrupt asks to stop.
//!
//! Each is in a process group of its own, so that Ctrl-C in a terminal reaches them only by way
//! of the sweep, once, whatever signal that got.

use std::{
    collections::BTreeMap,
    io::Read,
    process::{Child, Command, Stdio},
    sync::{
        Mutex, MutexGuard, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    thread,
    time::Duration,
};

use striae::Interrupt;

use super::members::Member;
use crate::failure::{IMPOSSIBLE, INTERRUPTED};

/// Time between two looks for an interrupt.
const PAUSE: Duration = Duration::from_millis(50);

/// State or end of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    /// The run has not begun.
    Waiting,
    /// The run has completed.
    Done,
    /// The run has failed.
    Failed {
        /// Exit code; none if a signal ended it, or it did not start.
        code: Option<i32>,
        /// Its message.
        reason: String,
    },
}

impl Outcome {
    /// True for a run that was asked to stop.
    pub(super) fn is_interrupted(&self) -> bool {
        self.is(INTERRUPTED)
    }

    /// True for a run that was refused, so that what its folder holds is older.
    pub(super) fn is_refused(&self) -> bool {
        self.is(IMPOSSIBLE)
    }

    fn is(&self, exit: u8) -> bool {
        matches!(self, Self::Failed { code: Some(code), .. } if *code == i32::from(exit))
    }
}

/// Runs in progress.
struct Runs<'s> {
    interrupt: &'s Interrupt,
    alive: Mutex<BTreeMap<usize, Child>>,
    over: AtomicBool,
}

/// Runs all members, or those before an interrupt; `ended` hears of each that has ended.
pub(super) fn all(
    members: &[Member],
    workers: usize,
    interrupt: &Interrupt,
    start: &(dyn Fn(&Member) -> Result<Command, String> + Sync),
    ended: &(dyn Fn(usize, &[Outcome]) + Sync),
) -> Vec<Outcome> {
    let runs = Runs {
        interrupt,
        alive: Mutex::default(),
        over: AtomicBool::new(false),
    };
    let next = Mutex::new(0..members.len());
    let outcomes = Mutex::new(vec![Outcome::Waiting; members.len()]);
    let work = || {
        loop {
            let Some(at) = locked(&next).next() else {
                break;
            };
            let outcome = runs.one(at, start(&members[at]));
            let mut outcomes = locked(&outcomes);
            outcomes[at] = outcome;
            ended(at, &outcomes);
        }
    };
    thread::scope(|scope| {
        scope.spawn(|| runs.watch());
        let workers: Vec<_> = (0..workers.min(members.len()))
            .map(|_| scope.spawn(work))
            .collect();
        for worker in workers {
            let _ = worker.join();
        }
        runs.over.store(true, Ordering::Relaxed);
    });
    outcomes
        .into_inner()
        .unwrap_or_else(PoisonError::into_inner)
}

impl Runs<'_> {
    fn one(&self, at: usize, command: Result<Command, String>) -> Outcome {
        let failed = |code, reason| Outcome::Failed { code, reason };
        let mut command = match command {
            Ok(command) => command,
            Err(cause) => return failed(None, cause),
        };
        command.stdin(Stdio::null()).stdout(Stdio::null());
        command.stderr(Stdio::piped());
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let said = {
            // Under the lock, so that an interrupt meets it either here or among the others.
            let mut alive = locked(&self.alive);
            if self.interrupt.is_set() {
                return Outcome::Waiting;
            }
            match command.spawn() {
                Ok(mut child) => {
                    let said = child.stderr.take();
                    alive.insert(at, child);
                    said
                }
                Err(cause) => return failed(None, format!("it cannot be started: {cause}")),
            }
        };
        let mut words = Vec::new();
        if let Some(mut said) = said {
            let _ = said.read_to_end(&mut words);
        }
        let child = locked(&self.alive).remove(&at);
        match child.map(|mut child| child.wait()) {
            Some(Ok(status)) if status.success() => Outcome::Done,
            Some(Ok(status)) => {
                let code = match (status.code(), self.interrupt.is_set()) {
                    // A signal that came before the program listened.
                    (None, true) => Some(i32::from(INTERRUPTED)),
                    (code, _) => code,
                };
                failed(code, reason(&words))
            }
            Some(Err(cause)) => failed(None, cause.to_string()),
            None => failed(None, "its process disappeared".to_owned()),
        }
    }

    /// Passes an interrupt on to all runs.
    fn watch(&self) {
        while !self.over.load(Ordering::Relaxed) {
            if self.interrupt.is_set() {
                locked(&self.alive).values().for_each(ask_to_stop);
                return;
            }
            thread::sleep(PAUSE);
        }
    }
}

/// The lock, also after a worker has failed: what it holds is changed in one go.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(unix)]
fn ask_to_stop(child: &Child) {
    use nix::{
        sys::signal::{Signal, kill},
        unistd::Pid,
    };
    if let Ok(id) = i32::try_from(child.id()) {
        let _ = kill(Pid::from_raw(id), Signal::SIGINT);
    }
}

/// Does nothing: the console informs all processes itself.
#[cfg(not(unix))]
fn ask_to_stop(_: &Child) {}

/// First line of a run's output that is no warning or progress.
fn reason(said: &[u8]) -> String {
    let said = String::from_utf8_lossy(said);
    let mut lines = said.lines().map(str::trim).filter(|line| {
        !line.is_empty() && !line.starts_with("warning:") && !line.starts_with("stopping after")
    });
    lines
        .next()
        .unwrap_or("it ended without a message")
        .to_owned()
}
