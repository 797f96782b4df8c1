//! The corpus of the repository, made as small as it can be.

use std::{cmp::Reverse, fs, path::Path};

use super::{
    Place,
    run::{started, unreadable},
};
use crate::fault::Fault;

/// Inputs that are kept of a target, and bytes that they may have together.
const COUNT: usize = 48;
const SIZE: usize = 40_000;

/// Replaces the corpus of a target by a least choice of all inputs so far.
///
/// The seeds are in the repository already, so only inputs that reach code beyond them are chosen.
pub fn minimised(place: &Place, target: &str) -> Result<(), Fault> {
    let kept = Path::new("crates/striae-mutants/corpus/fuzz").join(target);
    let chosen = place.of("minimal", target);
    let [corpus, seeds] = ["corpus", "seeds"].map(|part| place.of(part, target));
    if chosen.exists() {
        fs::remove_dir_all(&chosen).map_err(unreadable(&chosen))?;
    }
    for folder in [&chosen, &kept] {
        fs::create_dir_all(folder).map_err(unreadable(folder))?;
    }
    let folders = [&chosen, &seeds, &corpus, &kept].map(|path| path.display().to_string());
    let mut words = vec!["-set_cover_merge=1", "-use_counters=0", "-use_cmp=0"];
    words.extend(folders.iter().map(String::as_str));
    let log = place.of("logs", &format!("{target}-minimise"));
    if !started(place, target, &log, &words)? {
        return Err(Fault::Option(format!("{} tells why", log.display())));
    }
    let seeds: Vec<Vec<u8>> = files(&seeds)?.into_iter().map(|(_, bytes)| bytes).collect();
    let mut inputs = files(&chosen)?;
    inputs.retain(|(_, bytes)| !seeds.contains(bytes));
    // Large inputs tell most; names are hashes.
    inputs.sort_by_key(|(name, bytes)| (Reverse(bytes.len()), name.clone()));
    fs::remove_dir_all(&kept).map_err(unreadable(&kept))?;
    fs::create_dir_all(&kept).map_err(unreadable(&kept))?;
    let mut left = SIZE;
    let fits = |(_, bytes): &&(String, Vec<u8>)| {
        let fits = bytes.len() <= left;
        left -= if fits { bytes.len() } else { 0 };
        fits
    };
    let fitting: Vec<_> = inputs.iter().filter(fits).take(COUNT).collect();
    for (name, bytes) in &fitting {
        let path = kept.join(&name[..name.len().min(12)]);
        fs::write(&path, bytes).map_err(unreadable(&path))?;
    }
    let count = fitting.len();
    println!("{target}: {count} of {} inputs kept", inputs.len());
    Ok(())
}

fn files(folder: &Path) -> Result<Vec<(String, Vec<u8>)>, Fault> {
    let entries = fs::read_dir(folder).map_err(unreadable(folder))?;
    let mut all = Vec::new();
    for entry in entries {
        let path = entry.map_err(unreadable(folder))?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let bytes = fs::read(&path).map_err(unreadable(&path))?;
        all.push((name.into_owned(), bytes));
    }
    Ok(all)
}
