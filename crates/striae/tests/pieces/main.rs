//! Files of runs on several ranks, which are threads here, against those of a run on one.

mod run;
mod same;

use std::{fs, path::Path};

use run::{From, run, run_while};
use same::{assert_same_fields, assert_same_tables};
use striae::{
    output::checkpoint::{Checkpoint, Index},
    solve::outcome::Ending,
};

fn files(folder: &Path, of: impl Fn(&str) -> bool) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.filter(|name| of(name)).collect();
    names.sort();
    names
}

#[test]
fn pieces_are_together_what_one_rank_writes() {
    let [alone, shared] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let (alone, shared) = (alone.path(), shared.path());
    assert_eq!(run(alone, 1, From::Start, 9), Ok(Ending::Completed));
    assert!(files(&alone.join("fields"), |name| name.ends_with(".pvtu")).is_empty());
    for ranks in [2, 3] {
        assert_eq!(run(shared, ranks, From::Start, 9), Ok(Ending::Completed));
        assert_same_fields(shared, alone);
        assert_same_tables(shared, alone);
        let pieces = files(&shared.join("fields"), |name| {
            name.starts_with("lower-00002")
        });
        assert!(pieces.len() > 2, "{pieces:?}");
    }
}

#[test]
fn runs_go_on_on_as_many_ranks_as_there_are() {
    let alone = tempfile::tempdir().unwrap();
    let alone = alone.path();
    run(alone, 1, From::Start, 9).unwrap();
    for ranks in [[3, 2], [3, 1], [1, 2], [2, 2]] {
        let shared = tempfile::tempdir().unwrap();
        let shared = shared.path();
        let ending = run(shared, ranks[0], From::Start, 3).unwrap();
        assert!(matches!(ending, Ending::Interrupted { .. }), "{ending}");
        let pieces = files(shared, |name| name.starts_with("checkpoint-"));
        let expected = if ranks[0] == 1 { 0 } else { ranks[0] };
        assert_eq!(pieces.len(), expected, "{pieces:?}");
        assert_eq!(Index::read(shared).unwrap().ranks(), ranks[0]);
        let ending = run(shared, ranks[1], From::Checkpoint, 9);
        assert_eq!(ending, Ok(Ending::Completed), "{ranks:?}");
        assert_same_fields(shared, alone);
        assert_same_tables(shared, alone);
        let pieces = files(shared, |name| name.starts_with("checkpoint-"));
        let expected = if ranks[1] == 1 { 0 } else { ranks[1] };
        assert_eq!(pieces.len(), expected, "{pieces:?}");
    }
}

#[test]
fn what_one_rank_cannot_write_ends_all_and_leaves_the_old_checkpoint() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let blocked = |rank: usize, increment: usize| {
        // The name of the next piece of rank 1 is taken by a folder that is not empty.
        if rank == 1 && increment == 2 {
            let next = folder.join("checkpoint-2.1.bin").join("taken");
            fs::create_dir_all(next).unwrap();
        }
    };
    let end = run_while(folder, 3, From::Start, 9, &blocked);
    let error = end.unwrap_err();
    assert!(error.starts_with("rank 1: cannot write"), "{error}");
    let whole = Checkpoint::read(folder).unwrap();
    assert_eq!(whole.point.increments, 1);
    let left = files(folder, |name| name.starts_with("checkpoint-"));
    let set = [0, 1, 2].map(|rank| format!("checkpoint-1.{rank}.bin"));
    assert_eq!(
        left,
        [&set[..], &["checkpoint-2.1.bin".to_owned()]].concat()
    );
}

#[test]
fn pieces_of_fields_that_cannot_be_written_end_all() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let blocked = |rank: usize, increment: usize| {
        if rank == 2 && increment == 1 {
            let next = folder.join("fields/lower-00002.2.vtu/taken");
            fs::create_dir_all(next).unwrap();
            let next = folder.join("fields/upper-00002.2.vtu/taken");
            fs::create_dir_all(next).unwrap();
        }
    };
    let error = run_while(folder, 3, From::Start, 9, &blocked).unwrap_err();
    assert!(error.starts_with("rank 2: cannot write"), "{error}");
    assert_eq!(Checkpoint::read(folder).unwrap().point.increments, 1);
}

#[test]
fn pieces_that_are_missing_or_damaged_are_named_by_all() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    run(folder, 2, From::Start, 2).unwrap();
    let pieces = files(folder, |name| name.starts_with("checkpoint-"));
    let piece = folder.join(&pieces[1]);
    let mut bytes = fs::read(&piece).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&piece, bytes).unwrap();
    for ranks in [1, 2] {
        let error = run(folder, ranks, From::Checkpoint, 9).unwrap_err();
        assert!(
            error.contains(&pieces[1]) && error.contains("damaged"),
            "{error}"
        );
    }
    fs::remove_file(&piece).unwrap();
    for ranks in [1, 3] {
        let error = run(folder, ranks, From::Checkpoint, 9).unwrap_err();
        assert!(error.contains(&pieces[1]), "{error}");
    }
}
