//! Work of the thread that started a run: responds to increments, and checks the keyboard and laws
//! in Python.

use std::{
    sync::{
        Arc,
        mpsc::{Receiver, RecvTimeoutError, Sender},
    },
    time::Duration,
};

use pyo3::prelude::*;
use striae::{Interrupt, Next, solve::problem::Problem};

use crate::{
    raised::Raised,
    results::{Kept, Results},
};

/// Time between two checks of the keyboard.
const TICK: Duration = Duration::from_millis(50);

/// The Python function that is called with increments.
pub struct Callback {
    /// The function.
    pub function: Py<PyAny>,
    /// Problem that is solved.
    pub problem: Arc<Problem>,
    /// Source of increments.
    pub heard: Receiver<Arc<Kept>>,
    /// Target of responses.
    pub answer: Sender<Next>,
}

impl Callback {
    /// Passes on an increment and returns whether the run continues.
    fn told(&self, kept: Arc<Kept>) -> PyResult<Next> {
        Python::attach(|py| {
            py.check_signals()?;
            let results = Results {
                problem: self.problem.clone(),
                kept,
            };
            let answer = self.function.call1(py, (results,))?;
            let stops = answer
                .bind(py)
                .extract::<bool>()
                .is_ok_and(|goes_on| !goes_on);
            Ok(if stops { Next::Stop } else { Next::Continue })
        })
    }
}

/// Answers until the run has ended; returns the exception that stopped it.
pub fn listen(
    callback: Option<&Callback>,
    ended: &Receiver<()>,
    interrupt: &Interrupt,
    raised: &[Raised],
) -> Option<PyErr> {
    let mut stopped: Option<PyErr> = None;
    loop {
        let heard = match callback {
            Some(callback) => callback.heard.recv_timeout(TICK).map(Some),
            None => ended.recv_timeout(TICK).map(|()| None),
        };
        match (heard, callback) {
            (Ok(Some(kept)), Some(callback)) => {
                let answered = match &stopped {
                    None => callback.told(kept),
                    Some(_) => Ok(Next::Stop),
                };
                let next = answered.unwrap_or_else(|error| {
                    stopped = Some(error);
                    Next::Stop
                });
                // A run that has panicked hears no answer.
                let _ = callback.answer.send(next);
            }
            (Ok(_), _) => {}
            (Err(RecvTimeoutError::Timeout), _) => {
                if raised.iter().any(Raised::is_set) {
                    interrupt.set();
                }
                if let Err(error) = Python::attach(|py| py.check_signals()) {
                    interrupt.set();
                    stopped.get_or_insert(error);
                }
            }
            (Err(RecvTimeoutError::Disconnected), _) => return stopped,
        }
    }
}
