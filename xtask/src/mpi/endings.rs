//! Endings of runs on three ranks that are disturbed or cannot continue, and the state they leave.
//!
//! | trial | what it must say |
//! | --- | --- |
//! | a rank is killed | `mpirun`: signal 9 |
//! | an element turns inside out on one rank | its number, at each increment that all ranks cut back, and where none is small enough; as often as one process |
//! | a rank may write no more | its number, the file, "File too large" |
//! | the disk is full | the file, "No space left" |
//! | `mpirun` gets SIGTERM | "stopping after this increment" |
//! | `mpirun` gets SIGUSR1, ranks get SIGTERM | "interrupted at time" |
//! | ranks get SIGTERM twice, with `--all` | "interrupt again to stop at once" |
//! | a run that was stopped, or has completed, takes other steps | "all steps completed" |
//!
//! All must end within a minute, with an exit code that is not 0, and with a checkpoint, from
//! which another number of ranks comes to the forces of a run that was left alone. A full disk
//! is passed over where nothing may be mounted.

mod branches;
mod decks;

use std::{
    collections::HashMap,
    fs,
    io::Write,
    path::{Path, PathBuf},
};

use super::{
    cases::{Extent, by_multifrontal},
    differences::Differences,
    started::{Ended, Started, broken_off, history, start},
};
use crate::{endurance::disk::SmallDisk, fault::Fault, scenes::output::History};
use decks::{CRUSHED, LONG, PAD};

/// Ranks of the runs that are disturbed.
const RANKS: usize = 3;
/// Increments after which they are: there is a checkpoint, and steps are left.
const ROWS: usize = 13;
/// Kilobytes of a disk on which a run begins well.
const ROOM: u32 = 20_000;

/// The program, and where runs go.
struct Trials<'a> {
    program: &'a Path,
    root: PathBuf,
    /// Of decks, left alone on three ranks.
    whole: HashMap<&'static str, History>,
}

/// Makes all trials.
///
/// # Errors
/// The first one that comes out wrong.
pub fn check(program: &Path, extent: Extent) -> Result<(), Fault> {
    println!("== endings");
    let root = Path::new("target/mpi/endings");
    if root.exists() {
        fs::remove_dir_all(root).map_err(broken_off)?;
    }
    fs::create_dir_all(root).map_err(broken_off)?;
    let root = fs::canonicalize(root).map_err(broken_off)?;
    let trials = Trials::new(program, root)?;
    let (moments, after): (usize, _) = match extent {
        Extent::Short => (1, [1, 2]),
        Extent::All => (9, [1, 4]),
    };
    for moment in 0..moments {
        trials.killed(moment % RANKS, ROWS + 2 * moment, after[moment % 2])?;
    }
    trials.crushed()?;
    trials.limited()?;
    trials.full()?;
    let late = ("-TERM", To::Mpirun, "stopping after this increment");
    trials.signalled("long", late, 2)?;
    trials.signalled("pad", ("-USR1", To::Mpirun, "interrupted at time"), 1)?;
    trials.signalled("pad", ("-TERM", To::Ranks, "interrupted at time"), after[1])?;
    trials.branched()?;
    match extent {
        Extent::Short => Ok(()),
        Extent::All => trials.twice(),
    }
}

/// Receiver of a signal.
#[derive(Clone, Copy, PartialEq, Eq)]
enum To {
    Mpirun,
    Ranks,
}

impl To {
    fn of(self, run: &Started) -> Vec<String> {
        let all = match self {
            Self::Mpirun => vec![run.id()],
            Self::Ranks => run.ranks(),
        };
        all.iter().map(ToString::to_string).collect()
    }
}

impl<'a> Trials<'a> {
    fn new(program: &'a Path, root: PathBuf) -> Result<Self, Fault> {
        let decks = [("pad", PAD.deck()), ("long", LONG.deck())];
        let mut trials = Self {
            program,
            root,
            whole: HashMap::new(),
        };
        trials.write("crushed", CRUSHED)?;
        for (name, deck) in decks {
            trials.write(name, &deck)?;
            let folder = trials.root.join(format!("{name}-whole"));
            let ended = trials.begun(name, &folder)?.ended()?;
            expect("left alone", &ended, Some(0), &["all steps completed"])?;
            trials.whole.insert(name, history(&folder)?);
            println!("{name}, left alone: {:.1} s", ended.seconds);
        }
        Ok(trials)
    }

    fn write(&self, name: &str, deck: &str) -> Result<(), Fault> {
        let path = self.root.join(name).with_extension("toml");
        fs::write(path, deck).map_err(broken_off)
    }

    fn killed(&self, rank: usize, rows: usize, after: usize) -> Result<(), Fault> {
        let name = format!("rank {rank} killed after {rows} increments");
        let (mut run, folder) = self.in_the_middle("pad", &format!("killed-{rows}"), rows)?;
        let id = rank_of(&run, rank)?;
        run.disturb("kill", &["-KILL".into(), id])?;
        let ended = run.ended()?;
        expect(&name, &ended, None, &["signal 9"])?;
        self.resumed("pad", &name, (&ended, &folder), after)
    }

    /// All ranks cut back what one of them cannot do, and end where that does not help.
    fn crushed(&self) -> Result<(), Fault> {
        let name = "an element inside out for good";
        let folder = self.root.join("crushed");
        let mut run = self.begun("crushed", &folder)?;
        run.disturbed();
        let ended = run.ended()?;
        let words = ["stopped at time", "turned inside out"];
        expect(name, &ended, Some(1), &words)?;
        let (alone, before) = (self.alone("crushed", 1)?, history(&folder)?);
        let alike_alone = alike(name, &alone, &before)?;
        let [one, other] = [&alone, &before].map(|of| of.number(of.len() - 1, "cutbacks"));
        if one != other || one == Some(0.0) {
            return Err(Fault::Mpi(format!(
                "{name}: {other:?} cut-backs for {one:?}"
            )));
        }
        let again = self.taken_up(&folder, 2)?.ended()?;
        expect(name, &again, Some(1), &words)?;
        let differences = alike(name, &before, &history(&folder)?)?;
        let last = said(&ended, "stopped at time");
        println!(
            "{name}: {:.1} s, code 1, {} increments cut back before the last that converged; \
             \"{last}\"; one process: {alike_alone}; resumed on 2 ranks to the same end: \
             {differences}",
            ended.seconds,
            one.unwrap_or(0.0)
        );
        Ok(())
    }

    /// One rank may write small files only.
    fn limited(&self) -> Result<(), Fault> {
        let name = "no room for a rank";
        let (mut run, folder) = self.in_the_middle("pad", "limited", ROWS)?;
        let id = rank_of(&run, 1)?;
        run.disturb("prlimit", &["--fsize=4096".into(), "--pid".into(), id])?;
        let ended = run.ended()?;
        expect(name, &ended, Some(1), &["rank 1", "File too large"])?;
        self.resumed("pad", name, (&ended, &folder), 2)
    }

    /// The disk on which all write runs full.
    fn full(&self) -> Result<(), Fault> {
        let name = "a full disk";
        let mount = self.root.join("disk");
        let Some(_disk) = SmallDisk::mounted(&mount, ROOM) else {
            println!("{name}: mounting is not allowed");
            return Ok(());
        };
        let folder = mount.join("results");
        let mut run = self.begun("pad", &folder)?;
        run.reaches(ROWS)?;
        run.disturbed();
        let filler = mount.join("filler");
        let mut file = fs::File::create(&filler).map_err(broken_off)?;
        while file.write(&[0; 4096]).is_ok_and(|count| count > 0) {}
        let ended = run.ended()?;
        // What is open keeps its room.
        drop(file);
        fs::remove_file(filler).map_err(broken_off)?;
        expect(name, &ended, Some(1), &["No space left"])?;
        self.resumed("pad", name, (&ended, &folder), 1)
    }

    /// A signal to someone, and what the run must say then.
    fn signalled(
        &self,
        deck: &str,
        (signal, to, words): (&str, To, &str),
        after: usize,
    ) -> Result<(), Fault> {
        let (whom, folder) = match to {
            To::Mpirun => ("mpirun", format!("mpirun{signal}")),
            To::Ranks => ("all ranks", format!("ranks{signal}")),
        };
        let name = format!("{} to {whom}", signal.replace('-', "SIG"));
        let (mut run, folder) = self.in_the_middle(deck, &folder, ROWS)?;
        let whom = to.of(&run);
        run.disturb("kill", &[vec![signal.into()], whom].concat())?;
        let ended = run.ended()?;
        expect(&name, &ended, None, &[words])?;
        self.resumed(deck, &name, (&ended, &folder), after)
    }

    /// The second signal ends a run at once.
    fn twice(&self) -> Result<(), Fault> {
        let name = "SIGTERM to all ranks, twice";
        let (mut run, folder) = self.in_the_middle("pad", "twice", ROWS)?;
        let whom = To::Ranks.of(&run).join(" ");
        let both = format!("kill -TERM {whom}; sleep 0.01; kill -TERM {whom} || true");
        run.disturb("sh", &["-c".into(), both])?;
        let ended = run.ended()?;
        expect(name, &ended, None, &["interrupt again to stop immediately"])?;
        self.resumed("pad", name, (&ended, &folder), 2)
    }

    /// Goes on after an ending, to the forces of the run that was left alone.
    fn resumed(
        &self,
        deck: &str,
        name: &str,
        (ended, folder): (&Ended, &Path),
        ranks: usize,
    ) -> Result<(), Fault> {
        let kept = history_so_far(folder)?;
        let again = self.taken_up(folder, ranks)?.ended()?;
        expect(name, &again, Some(0), &["all steps completed"])?;
        let differences = alike(name, &self.whole[deck], &history(folder)?)?;
        println!(
            "{name}: {:.1} s, code {}, {kept} increments kept; on {ranks} ranks: {differences}",
            ended.seconds,
            ended.code.map_or("none".into(), |code| code.to_string())
        );
        Ok(())
    }

    /// A deck on three ranks, after so many increments.
    fn in_the_middle(
        &self,
        deck: &str,
        name: &str,
        rows: usize,
    ) -> Result<(Started, PathBuf), Fault> {
        let folder = self.root.join(name);
        let mut run = self.begun(deck, &folder)?;
        run.reaches(rows)?;
        Ok((run, folder))
    }

    fn begun(&self, deck: &str, folder: &Path) -> Result<Started, Fault> {
        let deck = self.root.join(deck).with_extension("toml");
        let arguments = ["run", &deck.to_string_lossy(), "--out"];
        self.started(RANKS, &arguments, folder)
    }

    fn taken_up(&self, folder: &Path, ranks: usize) -> Result<Started, Fault> {
        self.started(ranks, &["resume", "--quiet"], folder)
    }

    /// The history of one process with the multifrontal LU, which ends with a code.
    fn alone(&self, deck: &str, code: i32) -> Result<History, Fault> {
        let path = self.root.join(deck).with_extension("toml");
        let text = fs::read_to_string(&path).map_err(broken_off)?;
        let path = self.root.join(format!("{deck}-alone.toml"));
        fs::write(&path, by_multifrontal(&text)).map_err(broken_off)?;
        let folder = path.with_extension("");
        let arguments = ["run", "--threads", "1", &path.to_string_lossy(), "--out"];
        let ended = self.started(0, &arguments, &folder)?.ended()?;
        expect(deck, &ended, Some(code), &[])?;
        history(&folder)
    }

    fn started(&self, ranks: usize, words: &[&str], folder: &Path) -> Result<Started, Fault> {
        let name = folder.file_name().unwrap_or_default().to_string_lossy();
        let log = self.root.join(format!("{name}-{}.log", words[0]));
        start((self.program, ranks), words, folder, &log)
    }
}

/// The process of a rank.
fn rank_of(run: &Started, rank: usize) -> Result<String, Fault> {
    let ranks = run.ranks();
    let found = ranks.get(rank).map(ToString::to_string);
    found.ok_or_else(|| Fault::Mpi(format!("there are {} ranks", ranks.len())))
}

/// Holds an ending against an exit code, that is any but 0 if it is not given, and words.
fn expect(name: &str, ended: &Ended, code: Option<i32>, words: &[&str]) -> Result<(), Fault> {
    let is_right = code.map_or(ended.code != Some(0), |code| ended.code == Some(code));
    let missing = words.iter().find(|words| !ended.words.contains(**words));
    match (is_right, missing) {
        (true, None) => Ok(()),
        (false, _) => {
            let wrong = format!("{name}: exit code {:?}\n{}", ended.code, ended.words);
            Err(Fault::Mpi(wrong))
        }
        (_, Some(missing)) => {
            let wrong = format!("{name}: it did not say `{missing}`\n{}", ended.words);
            Err(Fault::Mpi(wrong))
        }
    }
}

/// Differences that are small.
fn alike(name: &str, one: &History, other: &History) -> Result<Differences, Fault> {
    let differences = Differences::of(one, other);
    let differences = differences.map_err(|words| Fault::Mpi(format!("{name}: {words}")))?;
    match differences.are_small() {
        true => Ok(differences),
        false => Err(Fault::Mpi(format!("{name}: {differences}"))),
    }
}

/// The line with some words.
fn said<'a>(ended: &'a Ended, words: &str) -> &'a str {
    let mut lines = ended.words.lines().rev();
    lines.find(|line| line.contains(words)).unwrap_or_default()
}

/// Number of increments that a run has recorded.
fn history_so_far(folder: &Path) -> Result<usize, Fault> {
    let text = fs::read_to_string(folder.join("history.csv")).map_err(broken_off)?;
    Ok(text.lines().count().saturating_sub(1))
}
