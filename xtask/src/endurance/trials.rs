//! The trials, and what must hold after each.

use std::{
    collections::BTreeMap,
    fs,
    io::{BufRead, BufReader},
    path::{Path, PathBuf},
    process::{Child, Command, Output, Stdio},
    thread,
    time::{Duration, Instant},
};

use super::{
    damage::DAMAGES,
    disk::SmallDisk,
    folder::{broken, differences, files},
};
use crate::{
    decks::{Grooved, Pad},
    fault::Fault,
};

/// A run of a second or so, whose grooves are part of its state.
const PAD: Pad = Pad {
    divisions: [2, 2, 2],
    grooved: Grooved::Pad,
    increments: [10, 30],
    way: 1.0,
    output: "fields_every = 5\ncheckpoint_every = 10",
};

/// A program, a deck, and what the run of the deck writes if it is left alone.
pub struct Trials {
    program: PathBuf,
    root: PathBuf,
    expected: BTreeMap<PathBuf, Vec<u8>>,
    duration: Duration,
    faults: Vec<String>,
}

impl Trials {
    /// Runs the deck once, undisturbed.
    ///
    /// # Errors
    /// When that does not end well.
    pub fn new(program: PathBuf, root: PathBuf) -> Result<Self, Fault> {
        let mut trials = Self {
            program,
            root,
            expected: BTreeMap::new(),
            duration: Duration::ZERO,
            faults: Vec::new(),
        };
        fs::write(trials.root.join("deck.toml"), PAD.deck()).map_err(broken_off)?;
        let folder = trials.root.join("whole");
        let started = Instant::now();
        let output = trials
            .command("run", &folder)
            .output()
            .map_err(broken_off)?;
        trials.duration = started.elapsed();
        if !output.status.success() {
            return Err(Fault::Endurance(said(&output)));
        }
        trials.expected = files(&folder).map_err(broken_off)?;
        let (count, time) = (trials.expected.len(), trials.duration.as_secs_f64());
        println!("left alone: {count} files in {time:.2} s");
        Ok(trials)
    }

    /// Kills runs without warning.
    ///
    /// # Errors
    /// When a trial cannot be made.
    pub fn killed(&mut self, count: u32) -> Result<(), Fault> {
        let (mut resumed, mut anew, mut ended) = (0, 0, 0);
        for number in 0..count {
            let folder = self.root.join(format!("killed-{number}"));
            let mut child = self.command("run", &folder).spawn().map_err(broken_off)?;
            thread::sleep(self.moment(number, count));
            child.kill().map_err(broken_off)?;
            let status = child.wait().map_err(broken_off)?;
            if status.success() {
                ended += 1;
            } else if folder.exists() {
                let left = files(&folder).map_err(broken_off)?;
                self.note(&folder, broken(&left));
            }
            if folder.join("checkpoint.bin").exists() {
                resumed += 1;
            } else if !status.success() {
                anew += 1;
            }
            self.brought_to_its_end(&folder)?;
        }
        println!("killed {count} times: {resumed} resumed, {anew} begun anew, {ended} had ended");
        Ok(())
    }

    /// Interrupts runs by SIGTERM.
    ///
    /// # Errors
    /// When a trial cannot be made.
    pub fn interrupted(&mut self, count: u32) -> Result<(), Fault> {
        let (mut stopped, mut ended) = (0, 0);
        for number in 0..count {
            let folder = self.root.join(format!("interrupted-{number}"));
            let mut command = self.command("run", &folder);
            let child = command.spawn().map_err(broken_off)?;
            thread::sleep(self.moment(number, count));
            send("-TERM", &child)?;
            let output = child.wait_with_output().map_err(broken_off)?;
            match output.status.code() {
                Some(0) => ended += 1,
                Some(130) => {
                    stopped += 1;
                    let last = said(&output);
                    if !last.contains("interrupted at time") || !last.contains("striae resume") {
                        self.note(&folder, vec![format!("it said: {last}")]);
                    }
                    if !folder.join("checkpoint.bin").exists() {
                        self.note(&folder, vec!["there is no checkpoint".into()]);
                    }
                }
                // Before the program listens to signals it ends as any other does.
                None if !folder.join("history.csv").exists() => stopped += 1,
                code => self.note(&folder, vec![format!("exit code {code:?}")]),
            }
            self.brought_to_its_end(&folder)?;
        }
        println!("SIGTERM {count} times: {stopped} stopped, {ended} had ended");
        Ok(())
    }

    /// Lets the disk run full, and limits the size of files.
    ///
    /// # Errors
    /// When a trial cannot be made.
    pub fn short_of_disk(&mut self) -> Result<(), Fault> {
        let mut count = 0;
        for kilobytes in [8, 40, 80, 120, 200] {
            let mount = self.root.join(format!("disk-{kilobytes}"));
            let Some(disk) = SmallDisk::mounted(&mount, kilobytes) else {
                println!("no disk of {kilobytes} kB: mounting is not allowed");
                continue;
            };
            let folder = mount.join("results");
            let output = self.command("run", &folder).output().map_err(broken_off)?;
            count += u32::from(!output.status.success());
            self.failed_for_room(&folder, &output);
            if !disk.resize(100_000) {
                return Err(Fault::Endurance("the disk cannot be enlarged".into()));
            }
            self.brought_to_its_end(&folder)?;
        }
        for blocks in [4, 40, 70] {
            let folder = self.root.join(format!("limit-{blocks}"));
            let limit = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" \"$@\"");
            let inner = self.command("run", &folder);
            let mut command = Command::new("sh");
            command.arg("-c").arg(limit).arg(inner.get_program());
            command.args(inner.get_args()).stderr(Stdio::piped());
            command.current_dir(&self.root);
            let output = command.output().map_err(broken_off)?;
            count += u32::from(!output.status.success());
            self.failed_for_room(&folder, &output);
            self.brought_to_its_end(&folder)?;
        }
        println!("short of room: {count} runs stopped");
        Ok(())
    }

    /// Starts a second run in the folder of another.
    ///
    /// # Errors
    /// When a trial cannot be made.
    pub fn beside_another(&mut self) -> Result<(), Fault> {
        let folder = self.root.join("beside");
        let mut first = self.loud("run", &folder);
        let mut child = first.spawn().map_err(broken_off)?;
        let progress = child.stderr.take().map(BufReader::new);
        let mut lines = progress.into_iter().flat_map(BufRead::lines);
        lines.nth(13);
        send("-STOP", &child)?;
        for (name, extra) in [
            ("run", None),
            ("run", Some("--overwrite")),
            ("resume", None),
        ] {
            let output = self.command(name, &folder).args(extra).output();
            let output = output.map_err(broken_off)?;
            let words = said(&output);
            if output.status.code() != Some(2)
                || !words.contains("is still being written by another run")
            {
                let wrong = format!("{name} {extra:?}: {:?}, {words}", output.status.code());
                self.note(&folder, vec![wrong]);
            }
        }
        send("-CONT", &child)?;
        lines.for_each(drop);
        child.wait().map_err(broken_off)?;
        self.compared(&folder)?;
        println!("a second run was refused 3 times");
        Ok(())
    }

    /// Damages files of an interrupted run, one at a time.
    ///
    /// # Errors
    /// When a trial cannot be made.
    pub fn damaged(&mut self) -> Result<(), Fault> {
        let folder = self.root.join("damaged");
        let mut first = self.loud("run", &folder);
        let mut child = first.spawn().map_err(broken_off)?;
        let progress = child.stderr.take().map(BufReader::new);
        let mut lines = progress.into_iter().flat_map(BufRead::lines);
        lines.nth(22);
        send("-TERM", &child)?;
        lines.for_each(drop);
        child.wait().map_err(broken_off)?;
        let before = self.root.join("damaged-before");
        copied(&folder, &before).map_err(broken_off)?;
        let mut refused = 0;
        for (name, damage, expected) in DAMAGES {
            let file = folder.join(name);
            let bytes = fs::read(&file).map_err(broken_off)?;
            fs::write(&file, damage(&bytes)).map_err(broken_off)?;
            let output = self
                .command("resume", &folder)
                .output()
                .map_err(broken_off)?;
            let words = said(&output);
            if output.status.code() == Some(2) && words.contains(expected) {
                refused += 1;
            } else {
                let wrong = format!("damaged {name}: {:?}, {words}", output.status.code());
                self.note(&folder, vec![wrong]);
            }
            fs::remove_dir_all(&folder).map_err(broken_off)?;
            copied(&before, &folder).map_err(broken_off)?;
        }
        self.brought_to_its_end(&folder)?;
        println!("damaged files {} times: {refused} refused", DAMAGES.len());
        Ok(())
    }

    /// Verdict on all trials.
    ///
    /// # Errors
    /// Returns all failures.
    pub fn verdict(self) -> Result<(), Fault> {
        match self.faults.len() {
            0 => Ok(()),
            count => {
                let all = self.faults.join("\n");
                Err(Fault::Endurance(format!(
                    "{all}\n{count} trials came out wrong"
                )))
            }
        }
    }

    /// The program with the deck or a folder, quiet.
    fn command(&self, name: &str, folder: &Path) -> Command {
        let mut command = self.loud(name, folder);
        command.arg("--quiet");
        command
    }

    /// Command that prints its progress.
    fn loud(&self, name: &str, folder: &Path) -> Command {
        let mut command = Command::new(&self.program);
        command
            .current_dir(&self.root)
            .args([name, "--threads", "1"]);
        match name {
            "resume" => command.arg(folder),
            _ => command.arg("deck.toml").arg("--out").arg(folder),
        };
        command.stdout(Stdio::null()).stderr(Stdio::piped());
        command
    }

    fn moment(&self, number: u32, count: u32) -> Duration {
        self.duration
            .mul_f64((f64::from(number) + 0.5) / f64::from(count))
    }

    /// Resumes from a checkpoint, or starts again if there is none and the run has not ended; then
    /// compares all files and removes the folder.
    fn brought_to_its_end(&mut self, folder: &Path) -> Result<(), Fault> {
        let mut command = match folder.join("checkpoint.bin").exists() {
            true => self.command("resume", folder),
            false if !folder.join("summary.json").exists() => {
                let mut again = self.command("run", folder);
                again.arg("--overwrite");
                again
            }
            false => return self.compared(folder),
        };
        let output = command.output().map_err(broken_off)?;
        if !output.status.success() {
            self.note(folder, vec![said(&output)]);
            return Ok(());
        }
        self.compared(folder)
    }

    fn compared(&mut self, folder: &Path) -> Result<(), Fault> {
        let found = files(folder).map_err(broken_off)?;
        let wrong = differences(&found, &self.expected);
        if wrong.is_empty() {
            fs::remove_dir_all(folder).map_err(broken_off)?;
        }
        self.note(folder, wrong);
        Ok(())
    }

    fn failed_for_room(&mut self, folder: &Path, output: &Output) {
        if output.status.success() {
            return;
        }
        let words = said(output);
        let named = words.contains("No space left") || words.contains("File too large");
        if output.status.code() != Some(1) || !named {
            let wrong = format!("without room: {:?}, {words}", output.status.code());
            self.note(folder, vec![wrong]);
        }
        if let Ok(left) = files(folder) {
            self.note(folder, broken(&left));
        }
    }

    fn note(&mut self, folder: &Path, wrong: Vec<String>) {
        let name = folder.strip_prefix(&self.root).unwrap_or(folder).display();
        let lines = wrong.into_iter().map(|wrong| format!("{name}: {wrong}"));
        self.faults.extend(lines);
    }
}

/// The last line that a program printed.
fn said(output: &Output) -> String {
    let words = String::from_utf8_lossy(&output.stderr).into_owned();
    words
        .trim_end()
        .lines()
        .last()
        .unwrap_or_default()
        .to_owned()
}

fn send(signal: &str, child: &Child) -> Result<(), Fault> {
    let id = child.id().to_string();
    // The run may have ended meanwhile, which the caller sees.
    let sent = Command::new("kill").args([signal, &id]).output();
    sent.map(|_| ()).map_err(broken_off)
}

fn copied(from: &Path, to: &Path) -> std::io::Result<()> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let path = entry?.path();
        let target = to.join(path.file_name().unwrap_or_default());
        match path.is_dir() {
            true => copied(&path, &target)?,
            false => fs::copy(&path, &target).map(|_| ())?,
        }
    }
    Ok(())
}

fn broken_off(cause: std::io::Error) -> Fault {
    Fault::Endurance(format!("a trial cannot be made: {cause}"))
}
