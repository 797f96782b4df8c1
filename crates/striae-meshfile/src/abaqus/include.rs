//! The text of an Abaqus file with the files that it includes in their places.
//!
//! `*INCLUDE, INPUT=name` stands for the lines of a file, whose name is relative to the file
//! that includes it. Lines of all files are counted through; [`Text::placed`] finds the file
//! of a line and its number there.

use super::super::lines::quoted;
use super::super::{MeshFileError, MeshFileFault, Place};
use std::path::{Path, PathBuf};

/// Lines of several files in one text.
pub(in super::super) struct Text {
    pub(in super::super) lines: String,
    pieces: Vec<Piece>,
    files: Vec<PathBuf>,
    count: usize,
}

/// Lines in a row that are of one file.
struct Piece {
    /// Number of the first in the text, from 1.
    first: usize,
    file: usize,
    /// Its number in the file, from 1.
    line: usize,
}

impl Text {
    /// Reads a file and all that it includes.
    pub(in super::super) fn read(path: &Path) -> Result<Self, MeshFileError> {
        let text = super::super::text(path).map_err(|fault| fault.of(path))?;
        let mut whole = Self {
            lines: String::with_capacity(text.len()),
            pieces: Vec::new(),
            files: Vec::new(),
            count: 0,
        };
        whole.append(path, &text, &mut vec![identity(path)])?;
        Ok(whole)
    }

    /// A fault of a line of the text as that of a line of its file.
    pub(in super::super) fn placed(&self, mut fault: MeshFileFault) -> MeshFileError {
        let mut file = 0;
        if let MeshFileFault::At {
            place: Place::Line(line),
            ..
        } = &mut fault
        {
            (file, *line) = self.origin(*line);
        }
        fault.of(&self.files[file])
    }

    /// Location of a line of the text, in words; with the name of the file if it is an included
    /// one.
    pub(in super::super) fn place(&self, line: usize) -> String {
        match self.origin(line) {
            (0, line) => format!("line {line}"),
            (file, line) => {
                let name = self.files[file].file_name().unwrap_or_default();
                format!("{} line {line}", name.to_string_lossy())
            }
        }
    }

    /// The file of a line of the text, and its number there.
    fn origin(&self, line: usize) -> (usize, usize) {
        let after = self.pieces.partition_point(|piece| piece.first <= line);
        let piece = &self.pieces[after.saturating_sub(1)];
        (piece.file, piece.line + line.saturating_sub(piece.first))
    }

    /// Adds the lines of a file; `within` are the files that are being read.
    fn append(
        &mut self,
        path: &Path,
        text: &str,
        within: &mut Vec<PathBuf>,
    ) -> Result<(), MeshFileError> {
        let file = self.files.len();
        self.files.push(path.to_owned());
        self.begin(file, 1);
        let mut lines = text.lines().enumerate();
        while let Some((index, line)) = lines.next() {
            if !is_include(line) {
                self.lines.push_str(line);
                self.lines.push('\n');
                self.count += 1;
                continue;
            }
            let (mut whole, mut last) = (line.trim().to_owned(), index);
            while whole.ends_with(',') {
                let Some((next, more)) = lines.next() else {
                    break;
                };
                whole += more.trim();
                last = next;
            }
            let fault = |fault: MeshFileFault| fault.of(path);
            let (name, text) = included(path, &whole, index + 1, within).map_err(fault)?;
            within.push(identity(&name));
            self.append(&name, &text, within)?;
            within.pop();
            self.begin(file, last + 2);
        }
        Ok(())
    }

    /// Starts a section that begins with a line of a file.
    fn begin(&mut self, file: usize, line: usize) {
        let first = self.count + 1;
        self.pieces.push(Piece { first, file, line });
    }
}

/// Path and text of the file that a keyword in a line of another file includes.
fn included(
    path: &Path,
    keyword: &str,
    line: usize,
    within: &[PathBuf],
) -> Result<(PathBuf, String), MeshFileFault> {
    let parameters = keyword.split(',').skip(1);
    let mut parameters = parameters.filter_map(|text| text.split_once('='));
    let input = parameters.find(|(key, _)| key.trim().eq_ignore_ascii_case("INPUT"));
    let Some((_, name)) = input else {
        return Err(MeshFileFault::line(
            line,
            "the parameter INPUT",
            quoted(keyword),
        ));
    };
    let name = name.trim().trim_matches('"');
    let file = path.parent().unwrap_or(Path::new("")).join(name);
    if within.contains(&identity(&file)) {
        let found = format!("{}, which includes this file", quoted(name));
        let expected = "a file that does not include this one again";
        return Err(MeshFileFault::line(line, expected, found));
    }
    match super::super::text(&file) {
        Ok(text) => Ok((file, text)),
        Err(fault) => {
            let found = format!("{}, which {fault}", quoted(name));
            Err(MeshFileFault::line(line, "a file to include", found))
        }
    }
}

/// Returns whether a line is the keyword `*INCLUDE`.
fn is_include(line: &str) -> bool {
    let keyword = line.trim_start().strip_prefix('*');
    let name = keyword.map(|keyword| keyword.split(',').next().unwrap_or_default());
    name.is_some_and(|name| name.trim().eq_ignore_ascii_case("INCLUDE"))
}

/// Canonical path, equal for all paths to one file.
fn identity(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_owned())
}
