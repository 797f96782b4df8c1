//! Runs on several ranks: what they need from outside.

use std::{fmt::Debug, sync::Arc};

use striae_model::Backend;
use striae_solve::{newton::TangentSolver, team::Team};

use crate::error::Error;

/// Ranks that run a simulation together. All of them make the same calls in the same order.
pub trait Ranks: Debug + Send + Sync {
    /// The ranks, as this one sees them.
    fn team(&self) -> Arc<dyn Team>;

    /// A solver of the systems that they share.
    fn solver(&self, backend: Backend) -> Box<dyn TangentSolver>;
}

/// Result of this rank, or the failure of another rank, the lowest one; collective.
pub(crate) fn agreed<T>(ranks: Option<&Arc<dyn Ranks>>, own: Result<T, Error>) -> Result<T, Error> {
    let Some(ranks) = ranks else {
        return own;
    };
    let said = own.as_ref().err().map(ToString::to_string);
    let said = said.unwrap_or_default();
    let all = ranks.team().gather(said.as_bytes());
    match (own, all.iter().position(|said| !said.is_empty())) {
        (Ok(_), Some(rank)) => Err(Error::Elsewhere {
            rank,
            cause: String::from_utf8_lossy(&all[rank]).into_owned(),
        }),
        (own, _) => own,
    }
}
