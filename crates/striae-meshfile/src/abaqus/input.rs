//! An Abaqus file by its keywords, for what is no mesh.

use super::super::MeshFileError;
use super::super::collected::Collected;
use super::super::numbers::NUMBER_BITS;
use super::include::Text;
use super::keywords::{Keyword, keywords};
use std::path::Path;
use striae_mesh::Vec3;

/// An Abaqus file with the files that it includes in their places.
pub struct InputFile {
    text: Text,
}

impl InputFile {
    /// Reads a file and all that it includes.
    ///
    /// # Errors
    /// [`MeshFileError`] where a file cannot be read.
    pub fn read(path: &Path) -> Result<Self, MeshFileError> {
        Text::read(path).map(|text| Self { text })
    }

    /// Its keywords, in the order of the file.
    ///
    /// # Errors
    /// [`MeshFileError`] where a line is below no keyword.
    pub fn keywords(&self) -> Result<Vec<Keyword<'_>>, MeshFileError> {
        keywords(&self.text.lines).map_err(|fault| self.text.placed(fault))
    }

    /// Location of a line of the text, in words.
    pub fn place(&self, line: usize) -> String {
        self.text.place(line)
    }

    /// The nodes of its parts where they are placed; none where the mesh cannot be read.
    pub fn points(&self) -> Points {
        Points(super::of_text(&self.text).ok())
    }
}

/// Nodes of the parts of a file.
pub struct Points(Option<Collected>);

impl Points {
    /// Number and place of the node that a word stands for: a set that holds it alone, or its
    /// number, with the name of its instance if there are several.
    pub fn find(&self, word: &str) -> Option<(u64, Vec3)> {
        let all = self.0.as_ref()?;
        let mut sets = all.node_sets.iter();
        let set = sets.find(|(label, _)| label.eq_ignore_ascii_case(word));
        let number = match set {
            Some((_, members)) => match &members[..] {
                [(_, number)] => *number,
                _ => return None,
            },
            None => {
                let (instance, bare) = word.rsplit_once('.').unwrap_or(("", word));
                let mut known = all.instances.iter();
                let place = known.position(|name| name.eq_ignore_ascii_case(instance));
                let raise = (place.unwrap_or(0) as u64) << NUMBER_BITS;
                bare.parse::<u64>().ok()?.checked_add(raise)?
            }
        };
        Some((number, *all.nodes.get(&number)?))
    }
}

/// A number, whose exponent may be marked with `D`; `None` if it is not a number or not finite.
pub fn finite(word: &str) -> Option<f64> {
    super::number(word).filter(|number| number.is_finite())
}
