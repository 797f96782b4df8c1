//! What ranks that write one run agree on.
//!
//! Each rank writes its pieces, rank 0 all else. What fails on one rank fails on all: after
//! each part that may fail they tell each other, so that none goes on alone and none waits for
//! another that has given up. All functions here are collective.

use std::fmt::Display;

use serde::{Serialize, de::DeserializeOwned};
use striae_solve::share::Share;

use crate::OutputError;

/// What a rank has come to, or what failed on another rank, the lowest one.
///
/// # Errors
/// When any rank has failed.
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

/// What rank 0 makes of it; nothing on others.
///
/// # Errors
/// When it fails there.
pub(crate) fn on_first<T, E: Display + From<OutputError>>(
    share: &Share,
    work: impl FnOnce() -> Result<T, E>,
) -> Result<Option<T>, E> {
    agreed(share, is_first(share).then(work).transpose())
}

/// What rank 0 makes of it, on all ranks.
///
/// # Errors
/// When it fails there.
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

/// What every rank says, in the order of the ranks.
pub(crate) fn told<T: Serialize + DeserializeOwned>(share: &Share, own: &T) -> Vec<T> {
    let own = postcard::to_allocvec(own).expect("what ranks tell are plain values");
    let all = share.team().gather(&own);
    let read = |bytes: &Vec<u8>| postcard::from_bytes(bytes).expect("ranks are of one program");
    all.iter().map(read).collect()
}

/// Whether it is this rank that writes what there is once only.
pub(crate) fn is_first(share: &Share) -> bool {
    share.team().rank() == 0
}
