//! Files beside decks: meshes, models of Abaqus, checkpoints, measurements.

use std::path::{Path, PathBuf};

use striae::{
    Error, Simulation,
    deck::convert as made,
    law::{
        fit::{Sought, fit},
        friction::LAWS,
    },
    measurements,
    mesh_file::{
        MeshFileError, MeshFileFault, node_numbers, read_node_vectors, read_rigid_surface,
        read_with_notes, rigid_node_numbers,
    },
    output::checkpoint::FILE,
};

use super::{Depth, Finding, Kind, Reached, deck, failed, worded};
use crate::target::Sample;

/// Reads a file in all ways that there are, then in a deck.
pub(super) fn mesh(sample: &Sample, folder: &Path, depth: Depth) -> Result<Reached, Finding> {
    let (path, name) = written(sample, folder, "mesh");
    let numbers = node_numbers(&path, None);
    let of_surface = read_rigid_surface(&path).map(drop);
    let faults = [
        read_with_notes(&path).map(drop),
        numbers.map(drop),
        of_surface,
        rigid_node_numbers(&path, None).map(drop),
        read_node_vectors(&path, None).map(drop),
    ];
    for fault in faults.into_iter().filter_map(Result::err) {
        placed(&fault)?;
    }
    let text = format!(
        "title = \"mesh\"\n\
         material = [{{ name = \"m\", law = \"neo-hookean\", youngs_modulus = 1, poissons_ratio = 0.3 }}]\n\
         [[body]]\nname = \"b\"\nmaterial = \"m\"\nmesh = {{ file = \"{name}\" }}\n\
         [[step]]\nname = \"s\"\nincrements = 1\n\
         displacement = [{{ body = \"b\", nodes = \"all\", x = 0, y = 0, z = 0.001 }}]\n"
    );
    let whole = deck::around(&text, folder, depth)?;
    // Materials of the file, and nodes left free.
    let text = text
        .replace("material = \"m\"\nmesh", "mesh")
        .replace("\"all\"", "\"zmin\"");
    deck::around(&text, folder, depth)?;
    Ok(whole)
}

/// Reads a rigid surface, then a deck in which it presses on a block.
pub(super) fn surface(sample: &Sample, folder: &Path, depth: Depth) -> Result<Reached, Finding> {
    let (path, name) = written(sample, folder, "tool");
    if let Err(fault) = read_rigid_surface(&path) {
        placed(&fault)?;
    }
    let text = format!(
        "title = \"tool\"\n\
         material = [{{ name = \"m\", law = \"neo-hookean\", youngs_modulus = 1, poissons_ratio = 0.3 }}]\n\
         [[body]]\nname = \"b\"\nmaterial = \"m\"\n\
         mesh = {{ generator = \"block\", origin = [0, 0, 1], size = [1, 1, 1], divisions = [2, 2, 2] }}\n\
         [[rigid]]\nname = \"t\"\nmesh = {{ file = \"{name}\" }}\n\
         [[pair]]\nname = \"p\"\na = {{ body = \"b\", facets = \"zmin\" }}\nb = {{ rigid = \"t\", texture = {{ uniform = [1, 0.3, 0] }} }}\n\
         friction = {{ law = \"orthotropic\", mu_along = 0.1, mu_across = 0.3 }}\n\
         [[step]]\nname = \"s\"\nincrements = 2\n\
         displacement = [{{ body = \"b\", nodes = \"zmax\", x = 0, y = 0, z = -0.01 }}]\n"
    );
    deck::around(&text, folder, depth)
}

/// Makes a deck of a model and reads it.
pub(super) fn convert(sample: &Sample, folder: &Path, depth: Depth) -> Result<Reached, Finding> {
    let (path, name) = written(sample, folder, "model");
    match made(&path, &name) {
        Err(fault) => placed(&fault).map(|()| Reached::Refused),
        Ok(converted) => deck::around(&converted.deck, folder, depth),
    }
}

/// Goes on from a checkpoint.
pub(super) fn checkpoint(sample: &Sample, folder: &Path) -> Result<Reached, Finding> {
    let run = folder.join("run");
    std::fs::create_dir_all(&run).expect("a new folder");
    std::fs::write(run.join(FILE), &sample.bytes).expect("a file of a new folder");
    match Simulation::resume(&run) {
        Ok(_) => Ok(Reached::Accepted),
        Err(error @ (Error::Checkpoint(_) | Error::Deck(_))) => {
            worded(&error.to_string()).map(|()| Reached::Refused)
        }
        Err(error) => failed(Kind::NoPlace, error.to_string()),
    }
}

/// Reads measurements and fits every law to them.
pub(super) fn measurements(sample: &Sample) -> Result<Reached, Finding> {
    let text = String::from_utf8_lossy(&sample.bytes);
    let form = measurements::Form::default();
    let readings = match measurements::read(&text, "m.csv", &form) {
        Ok(measured) => measured.readings,
        Err(faults) => {
            for fault in &faults.faults {
                let whole = ["it is empty", "it has no readings", "it cannot be read"];
                let whole = whole.iter().any(|word| fault.message.contains(word));
                if fault.place.is_none() && !whole {
                    return failed(Kind::NoPlace, fault.message.clone());
                }
            }
            return Ok(Reached::Refused);
        }
    };
    let laws = LAWS.iter().filter_map(|law| Sought::new(law));
    let associated = Sought::named("orthotropic");
    let associated = associated.map(|law| law.with("slip_rule", "associated"));
    for law in laws.chain(associated) {
        match fit(&law, &readings, 0.95) {
            Err(error) => worded(&error.to_string())?,
            Ok(found) => {
                let numbers = found.constants.iter().map(|one| one.value);
                if numbers.into_iter().any(|number| !number.is_finite()) {
                    return failed(Kind::Raw, format!("{found:?}"));
                }
            }
        }
    }
    Ok(Reached::Accepted)
}

/// Writes a sample to a file of its ending; returns its path and name.
fn written(sample: &Sample, folder: &Path, stem: &str) -> (PathBuf, String) {
    let ending = Path::new(&sample.name).extension().unwrap_or_default();
    let name = format!("{stem}.{}", ending.to_string_lossy());
    let path = folder.join(&name);
    std::fs::write(&path, &sample.bytes).expect("a file of a new folder");
    (path, name)
}

/// Refuses faults of a file without a place in it.
fn placed(error: &MeshFileError) -> Result<(), Finding> {
    let message = error.to_string();
    let placed = match &error.fault {
        MeshFileFault::At { .. }
        | MeshFileFault::Length { .. }
        | MeshFileFault::NoVector { .. } => true,
        // These are about the whole file, and say what is needed.
        MeshFileFault::Empty { .. }
        | MeshFileFault::UnknownEnding { .. }
        | MeshFileFault::NodeData { .. }
        | MeshFileFault::NoPart { .. } => true,
        MeshFileFault::Mesh(_) => ["node ", "element ", "set "]
            .iter()
            .any(|part| message.contains(part)),
        MeshFileFault::Unreadable(_) => false,
    };
    match placed {
        true => worded(&message),
        false => failed(Kind::NoPlace, message),
    }
}
