//! Runs the program on a deck, as a person would.

use std::{
    fs::{self, File},
    io,
    path::Path,
    process::{Command, ExitStatus, Stdio},
    thread::sleep,
    time::{Duration, Instant},
};

/// Result of a run.
pub struct Run {
    /// The status, unless time ran out.
    pub status: Option<ExitStatus>,
    /// Printed text.
    pub log: String,
    /// Seconds it took.
    pub seconds: f64,
}

/// The longest a run may take, of the processor where the system tells.
pub const LIMIT: Duration = Duration::from_secs(180);
/// The longest a run may take on the clock.
const PATIENCE: Duration = Duration::from_secs(1800);

/// Runs `deck.toml` of a folder, with the output in its `out`, on one thread.
///
/// # Errors
/// When the program cannot be started or the folder not written.
pub fn run(binary: &Path, folder: &Path) -> io::Result<Run> {
    let log = folder.join("log.txt");
    let file = File::create(&log)?;
    let started = Instant::now();
    let mut child = Command::new(binary)
        .arg("run")
        .arg(folder.join("deck.toml"))
        .args(["--threads", "1", "--out"])
        .arg(folder.join("out"))
        .stdin(Stdio::null())
        .stdout(file.try_clone()?)
        .stderr(file)
        .spawn()?;
    let status = loop {
        if let Some(status) = child.try_wait()? {
            break Some(status);
        }
        // On a machine that others use, too, a run waits.
        let spent = processor_time(child.id()).unwrap_or(started.elapsed());
        if spent > LIMIT || started.elapsed() > PATIENCE {
            child.kill()?;
            child.wait()?;
            break None;
        }
        sleep(Duration::from_millis(10));
    };
    Ok(Run {
        status,
        log: String::from_utf8_lossy(&fs::read(&log)?).into_owned(),
        seconds: started.elapsed().as_secs_f64(),
    })
}

/// Returns whether the schema of the program's decks contains a word.
///
/// # Errors
/// If the program cannot be started.
pub fn knows(binary: &Path, word: &str) -> io::Result<bool> {
    let output = Command::new(binary).arg("schema").output()?;
    let schema = String::from_utf8_lossy(&output.stdout);
    Ok(schema.contains(&format!("\"{word}\"")))
}

/// Time that a process has had of the processor, where there is `/proc`: user and system time are
/// the twelfth and thirteenth word after its name, in hundredths of a second.
fn processor_time(id: u32) -> Option<Duration> {
    let text = fs::read_to_string(format!("/proc/{id}/stat")).ok()?;
    let (_, rest) = text.rsplit_once(')')?;
    let words: Vec<&str> = rest.split_whitespace().collect();
    let ticks = |word: usize| words.get(word)?.parse::<u64>().ok();
    Some(Duration::from_millis(10 * (ticks(11)? + ticks(12)?)))
}
