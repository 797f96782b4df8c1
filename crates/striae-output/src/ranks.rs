//! Agreement of ranks that write one run.
//!
//! Each rank writes its pieces, rank 0 everything else. What fails on one rank fails on all: after
//! each part that may fail the ranks inform each other, so that none continues alone and none waits
//! for another that has given up. All functions here are collective.

use std::fmt::Display;

use serde::{Serialize, de::DeserializeOwned};
use striae_solve::share::Share;

use crate::OutputError;

/// Result of this rank, or the failure of another rank, the lowest one.
///
/// # Errors
/// If any rank has failed.
pub fn agreed<T, E: Display + From<OutputError>>(share: &Share, own: Result<T, E>) -> Result<T, E> {
    if share.is_alone() {
        return own;
    }
    let said = own.as_ref().err().map(ToString::to_string);
    let all: Vec<Option<String>> = told(share, &said);
    let mut failed = all.into_iter().enumerate();
    let failed = failed.find_map(|(rank, said)| said.map(|said| (rank, said)));
    match (own, failed) {
        (own, None) => own,
        // Its own words are the better ones.
        (Err(error), Some((rank, _))) if rank == share.team().rank() => Err(error),
        (_, Some((rank, cause))) => Err(OutputError::Elsewhere { rank, cause }.into()),
    }
}

/// Runs a piece of work on rank 0; the others do nothing.
///
/// # Errors
/// If it fails there.
pub(crate) fn on_first<T, E: Display + From<OutputError>>(
    share: &Share,
    work: impl FnOnce() -> Result<T, E>,
) -> Result<Option<T>, E> {
    agreed(share, is_first(share).then(work).transpose())
}

/// Runs a piece of work on rank 0 and returns its result on all ranks.
///
/// # Errors
/// If it fails there.
pub fn from_first<T, E>(share: &Share, work: impl FnOnce() -> Result<T, E>) -> Result<T, E>
where
    T: Serialize + DeserializeOwned,
    E: Display + From<OutputError>,
{
    if share.is_alone() {
        return work();
    }
    let own = on_first(share, work)?;
    let mut all: Vec<Option<T>> = told(share, &own);
    let first = all.swap_remove(0);
    Ok(first.expect("rank 0 has agreed to what it made"))
}

/// Values of all ranks, in the order of the ranks.
pub(crate) fn told<T: Serialize + DeserializeOwned>(share: &Share, own: &T) -> Vec<T> {
    let own = postcard::to_allocvec(own).expect("what ranks tell are plain values");
    let all = share.team().gather(&own);
    let read = |bytes: &Vec<u8>| postcard::from_bytes(bytes).expect("ranks are of one program");
    all.iter().map(read).collect()
}

/// Returns whether this rank writes what exists only once.
pub(crate) fn is_first(share: &Share) -> bool {
    share.team().rank() == 0
}
