//! A run under `mpirun` while it goes, and how it ends. Linux only: ranks are found in `/proc`.

use std::{
    fs::{self, File},
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    thread,
    time::{Duration, Instant},
};

use super::ENVIRONMENT;
use crate::{fault::Fault, scenes::output::History};

/// Time allowed for a run.
const LIMIT: Duration = Duration::from_secs(600);
/// Time allowed for a run to end once it is disturbed.
const PATIENCE: Duration = Duration::from_secs(60);
/// Between two looks.
const PAUSE: Duration = Duration::from_millis(10);
/// Variable by which Open MPI tells a rank its number.
const RANK: &str = "OMPI_COMM_WORLD_RANK=";

/// A run of the program.
pub struct Started {
    child: Child,
    folder: PathBuf,
    log: PathBuf,
    /// Start of the run, or time at which it was disturbed.
    since: Instant,
    /// Time allowed from then on.
    patience: Duration,
}

/// Ending of a run.
pub struct Ended {
    /// Exit code; none where a signal ended it.
    pub code: Option<i32>,
    /// All that it printed.
    pub words: String,
    /// Seconds since it began or was disturbed.
    pub seconds: f64,
}

/// Starts the program on so many ranks, or without `mpirun` on none, with arguments and the
/// folder of its results; `log` takes what it prints.
///
/// # Errors
/// When it cannot be started.
pub fn start(
    (program, ranks): (&Path, usize),
    arguments: &[&str],
    folder: &Path,
    log: &Path,
) -> Result<Started, Fault> {
    let mut command = match ranks {
        0 => Command::new(program),
        _ => Command::new("mpirun"),
    };
    if ranks > 0 {
        command.arg("-n").arg(ranks.to_string()).arg(program);
    }
    command.args(arguments).arg(folder).envs(ENVIRONMENT);
    let file = File::create(log).map_err(broken_off)?;
    let both = file.try_clone().map_err(broken_off)?;
    let child = command.stdin(Stdio::null()).stdout(both).stderr(file);
    Ok(Started {
        child: child.spawn().map_err(broken_off)?,
        folder: folder.to_owned(),
        log: log.to_owned(),
        since: Instant::now(),
        patience: LIMIT,
    })
}

impl Started {
    /// Waits until its history has so many rows.
    ///
    /// # Errors
    /// When it ends before.
    pub fn reaches(&mut self, rows: usize) -> Result<(), Fault> {
        let history = self.folder.join("history.csv");
        let begun = Instant::now();
        loop {
            let text = fs::read_to_string(&history).unwrap_or_default();
            if text.lines().count() > rows {
                return Ok(());
            }
            let ended = self.child.try_wait().map_err(broken_off)?.is_some();
            if ended || begun.elapsed() > LIMIT {
                let _ = self.child.kill();
                let words = fs::read_to_string(&self.log).unwrap_or_default();
                return Err(Fault::Mpi(format!("{rows} increments were due: {words}")));
            }
            thread::sleep(PAUSE);
        }
    }

    /// Number of `mpirun`, or of the program.
    pub fn id(&self) -> u32 {
        self.child.id()
    }

    /// Numbers of the processes of the ranks, in the order of the ranks.
    pub fn ranks(&self) -> Vec<u32> {
        let folder = self.folder.to_string_lossy().into_owned();
        let processes = fs::read_dir("/proc").into_iter().flatten().flatten();
        let mut found: Vec<(usize, u32)> = processes
            .filter_map(|process| {
                let id = process.file_name().to_str()?.parse().ok()?;
                let read = |name| {
                    let bytes = fs::read(process.path().join(name)).ok()?;
                    Some(String::from_utf8_lossy(&bytes).into_owned())
                };
                let is_ours = read("cmdline")?.split('\0').any(|word| word == folder);
                let rank = read("environ")?
                    .split('\0')
                    .find_map(|word| word.strip_prefix(RANK)?.parse().ok());
                rank.filter(|_| is_ours).map(|rank| (rank, id))
            })
            .collect();
        found.sort_unstable();
        found.into_iter().map(|(_, id)| id).collect()
    }

    /// Runs a program that disturbs it, such as `kill`.
    ///
    /// # Errors
    /// When that fails.
    pub fn disturb(&mut self, program: &str, arguments: &[String]) -> Result<(), Fault> {
        self.disturbed();
        let status = Command::new(program).args(arguments).status();
        match status.map_err(broken_off)?.success() {
            true => Ok(()),
            false => Err(Fault::Mpi(format!("`{program} {arguments:?}` failed"))),
        }
    }

    /// Notes that it is disturbed now.
    pub fn disturbed(&mut self) {
        (self.since, self.patience) = (Instant::now(), PATIENCE);
    }

    /// Waits for its end.
    ///
    /// # Errors
    /// When it takes too long.
    pub fn ended(mut self) -> Result<Ended, Fault> {
        loop {
            if let Some(status) = self.child.try_wait().map_err(broken_off)? {
                return Ok(Ended {
                    code: status.code(),
                    words: fs::read_to_string(&self.log).map_err(broken_off)?,
                    seconds: self.since.elapsed().as_secs_f64(),
                });
            }
            if self.since.elapsed() > self.patience {
                let _ = self.child.kill();
                let _ = self.child.wait();
                let words = fs::read_to_string(&self.log).unwrap_or_default();
                return Err(Fault::Mpi(format!(
                    "{} does not end: {words}",
                    self.folder.display()
                )));
            }
            thread::sleep(PAUSE);
        }
    }
}

/// The history of a run.
///
/// # Errors
/// When it cannot be read.
pub fn history(folder: &Path) -> Result<History, Fault> {
    let path = folder.join("history.csv");
    History::read(&path).map_err(|words| Fault::Mpi(format!("{}: {words}", path.display())))
}

/// Fault that prevents a trial.
pub fn broken_off(cause: std::io::Error) -> Fault {
    Fault::Mpi(format!("a trial cannot be made: {cause}"))
}
