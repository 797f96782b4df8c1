//! Output that nobody reads to its end.

use std::process::{Command, Stdio};

#[test]
fn a_pipe_that_is_closed_is_no_failure() {
    let mut run = Command::new(env!("CARGO_BIN_EXE_striae-mutants"))
        .args(["--targets", "deck", "--seeds", "0..2", "--jobs", "1"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(run.stdout.take());
    let ended = run.wait_with_output().expect("it ends");
    let said = String::from_utf8_lossy(&ended.stderr);
    assert!(ended.status.success() && said.is_empty(), "{said}");
}
