//! Tasks of newcomers, from the files of the book to pictures and tables.

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

/// Runs a script of the book in a copy of its folder, with the program on the path.
fn ran(script: &str) -> (Output, tempfile::TempDir) {
    let tasks = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/book/how-to/tasks");
    let folder = tempfile::tempdir().expect("a folder");
    for file in fs::read_dir(&tasks).expect("the tasks").flatten() {
        fs::copy(file.path(), folder.path().join(file.file_name())).expect("a copy");
    }
    let program = Path::new(env!("CARGO_BIN_EXE_striae"));
    let own = program.parent().map(PathBuf::from).into_iter();
    let path = env::var_os("PATH").unwrap_or_default();
    let path = env::join_paths(own.chain(env::split_paths(&path))).expect("folders");
    let output = Command::new("sh")
        .args(["-e", script])
        .env("PATH", path)
        .current_dir(folder.path())
        .output()
        .expect("a shell");
    (output, folder)
}

#[test]
fn an_assembly_becomes_a_picture_and_an_animation() {
    let (output, folder) = ran("assembly.sh");
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{output:?}");
    assert!(told.contains("no faults, no warnings"), "{told}");
    assert!(told.contains("all steps completed"), "{told}");
    // What slides has the friction of the file: .4.
    let history = fs::read_to_string(folder.path().join("results/assembly/history.csv")).unwrap();
    let value = |name: &str| {
        let mut lines = history.lines().map(|line| line.split(','));
        let at = lines.next().unwrap().position(|one| one.ends_with(name));
        let last = lines.next_back().unwrap().nth(at.unwrap());
        last.unwrap().parse::<f64>().unwrap()
    };
    let [x, z] = [".resultant_a.x", ".resultant_a.z"].map(value);
    assert!((x / z + 0.4).abs() < 1e-3, "{x} {z}");
    for file in [
        "assembly.png",
        "assembly.gif",
        "results/assembly/report.html",
    ] {
        assert!(folder.path().join(file).metadata().unwrap().len() > 1000);
    }
}

#[test]
fn a_template_is_swept_to_a_table() {
    let (output, folder) = ran("sweep.sh");
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{output:?}");
    // Pairs that never touch are not in the way.
    assert!(!told.contains("pad-pad"), "{told}");
    let table = fs::read_to_string(folder.path().join("sweep/sweep.csv")).unwrap();
    assert_eq!(table.lines().count(), 5);
    assert_eq!(table.matches(",completed,").count(), 4, "{table}");
}
