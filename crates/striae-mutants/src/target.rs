//! Readers of input, and the files that are damaged for them.

use std::path::{Path, PathBuf};

use striae::output::checkpoint::FILE;

use crate::mutation::Form;

/// A reader of input.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Target {
    /// Decks: reading, lowering, checks, advice, and the first increment of some.
    Deck,
    /// Mesh files of Gmsh.
    Gmsh,
    /// Mesh files of Abaqus.
    Abaqus,
    /// Mesh files of VTK.
    Vtk,
    /// Rigid surfaces in STL files.
    Stl,
    /// Abaqus models made decks.
    Convert,
    /// Checkpoints of runs.
    Checkpoint,
    /// Measured friction.
    Measurements,
}

impl Target {
    /// All targets.
    pub const ALL: [Self; 8] = [
        Self::Deck,
        Self::Gmsh,
        Self::Abaqus,
        Self::Vtk,
        Self::Stl,
        Self::Convert,
        Self::Checkpoint,
        Self::Measurements,
    ];

    /// Targets that are mesh files.
    pub const MESHES: [Self; 4] = [Self::Gmsh, Self::Abaqus, Self::Vtk, Self::Stl];

    /// Name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Deck => "deck",
            Self::Gmsh => "gmsh",
            Self::Abaqus => "abaqus",
            Self::Vtk => "vtk",
            Self::Stl => "stl",
            Self::Convert => "convert",
            Self::Checkpoint => "checkpoint",
            Self::Measurements => "measurements",
        }
    }

    /// Bytes as a file of the target; their beginning decides between two endings.
    pub fn sample(self, bytes: &[u8]) -> Sample {
        let name = match self {
            Self::Deck => "deck.toml",
            Self::Gmsh => "mesh.msh",
            Self::Abaqus | Self::Convert => "mesh.inp",
            Self::Vtk if bytes.trim_ascii_start().starts_with(b"<") => "mesh.vtu",
            Self::Vtk => "mesh.vtk",
            Self::Stl => "tool.stl",
            Self::Checkpoint => FILE,
            Self::Measurements => "forces.csv",
        };
        Sample {
            name: name.into(),
            form: Form::of(bytes),
            base: corpus().join("decks"),
            bytes: bytes.to_vec(),
        }
    }

    /// The targets of a list of names with commas; `meshes` and `all` are several.
    ///
    /// # Errors
    /// The name that is not known.
    pub fn listed(names: &str) -> Result<Vec<Self>, String> {
        let mut targets = Vec::new();
        for name in names.split(',') {
            match (name, Self::ALL.iter().find(|target| target.name() == name)) {
                ("all", _) => targets.extend(Self::ALL),
                ("meshes", _) => targets.extend(Self::MESHES),
                (_, Some(target)) => targets.push(*target),
                (_, None) => return Err(name.to_owned()),
            }
        }
        Ok(targets)
    }
}

/// A file that is damaged.
#[derive(Clone, Debug)]
pub struct Sample {
    /// Name of the file.
    pub name: String,
    /// Its content.
    pub bytes: Vec<u8>,
    /// Its form.
    pub form: Form,
    /// Folder that paths in it are relative to.
    pub base: PathBuf,
}

/// Decks outside the corpus, from the root of the repository.
const DECKS: [&str; 21] = [
    "cases/edge-contact/deck.toml",
    "cases/patch-frictionless/turned-lower-finer.toml",
    "cases/patch-slip/coulomb.toml",
    "cases/patch-slip/nap.toml",
    "cases/patch-slip/orthotropic.toml",
    "cases/patch-slip/tabulated.toml",
    "cases/patch-slip/two-textures.toml",
    "cases/patch-stick/three-to-four.toml",
    "cases/snake-scale/launched.toml",
    "cases/snake-scale/stop.toml",
    "cases/treloar/ogden.toml",
    "cases/treloar/arruda-boyce.toml",
    "crates/striae-cli/src/command/new/blocks.toml",
    "crates/striae-cli/src/command/new/pad.toml",
    "crates/striae-deck/tests/deck/base.toml",
    "crates/striae-deck/tests/deck/everything.toml",
    "crates/striae/src/simulation/tests/dynamic.toml",
    "crates/striae/src/simulation/tests/kept.toml",
    "crates/striae/src/simulation/tests/pushed.toml",
    "crates/striae/src/simulation/tests/quasi-static.toml",
    "cases/pad-on-incline/hold.toml",
];

/// Root of the repository.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The corpus.
fn corpus() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus")
}

/// The description of all keys of decks.
pub fn schema() -> Vec<u8> {
    std::fs::read(root().join("docs/deck.schema.json")).expect("a file of the repository")
}

/// A deck of few elements, for checkpoints.
pub fn small_deck() -> PathBuf {
    root().join("crates/striae/src/simulation/tests/quasi-static.toml")
}

/// The files of a target, in the order of their names; those of checkpoints are made by runs.
pub fn samples(target: Target) -> Vec<Sample> {
    let corpus = corpus();
    match target {
        Target::Deck => {
            let others = DECKS.iter().map(|path| root().join(path));
            let mut paths = listing(&corpus.join("decks"));
            paths.extend(others);
            read(paths)
        }
        Target::Gmsh => read(listing(&corpus.join("gmsh"))),
        Target::Abaqus | Target::Convert => read(listing(&corpus.join("abaqus"))),
        Target::Vtk => read(listing(&corpus.join("vtk"))),
        Target::Stl => read(listing(&corpus.join("stl"))),
        Target::Checkpoint => Vec::new(),
        Target::Measurements => read(listing(&corpus.join("measurements"))),
    }
}

/// Inputs that once failed, with the targets that they are for: `TARGET-WORD.ENDING`.
pub fn regressions() -> Vec<(Target, Sample)> {
    let samples = read(listing(&corpus().join("regressions"))).into_iter();
    let named = samples.map(|sample| {
        let target = sample.name.split('-').next().unwrap_or_default();
        let target = Target::ALL.into_iter().find(|of| of.name() == target);
        (target.expect("begins with a target"), sample)
    });
    named.collect()
}

/// Inputs of a target that libFuzzer found to reach code of their own.
pub fn found(target: Target) -> Vec<Sample> {
    let samples = read(listing(&corpus().join("fuzz").join(target.name()))).into_iter();
    let named = samples.map(|sample| Sample {
        name: format!("{}/{}", target.name(), sample.name),
        ..target.sample(&sample.bytes)
    });
    named.collect()
}

fn listing(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder of the corpus");
    let entries = entries.map(|entry| entry.expect("an entry of the corpus").path());
    let mut paths: Vec<PathBuf> = entries.filter(|path| path.is_file()).collect();
    paths.sort();
    paths
}

fn read(paths: Vec<PathBuf>) -> Vec<Sample> {
    let samples = paths.into_iter().map(|path| {
        let bytes = std::fs::read(&path).expect("a file of the corpus");
        Sample {
            name: path
                .file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into(),
            form: Form::of(&bytes),
            base: path.parent().unwrap_or(Path::new("")).to_owned(),
            bytes,
        }
    });
    samples.collect()
}
