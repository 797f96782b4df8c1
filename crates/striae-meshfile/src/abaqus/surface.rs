//! Surfaces of elements and of nodes, and those made of other surfaces.
//!
//! A row is `element or element set, face`: `S1` to `S6` of solids, `SPOS` or `SNEG` of elements
//! that lie on the body, and without a face all that is free of the elements. `COMBINE` makes a
//! surface of others by `UNION`, `INTERSECTION` or `DIFFERENCE`. Source: Abaqus keywords reference
//! guide, `*SURFACE`.

use super::super::collected::FileFace;
use super::super::{MeshFileFault, Place};
use super::keywords::{Keyword, Row};
use super::names::Names;
use super::part::{Part, Use};

impl Part {
    /// Reads a surface of elements, of nodes or of other surfaces.
    pub(super) fn read_surface(
        &mut self,
        keyword: &Keyword<'_>,
        names: &Names,
    ) -> Result<Use, MeshFileFault> {
        if keyword.parameter("CROP").is_some() {
            return Ok(Use::Nothing);
        }
        if let Some(how) = keyword.parameter("COMBINE") {
            return self.combine(keyword, how);
        }
        let kind = keyword.parameter("TYPE").unwrap_or("ELEMENT");
        if kind.eq_ignore_ascii_case("NODE") {
            return self.read_surface_of_nodes(keyword, names);
        }
        if !kind.eq_ignore_ascii_case("ELEMENT") {
            return Ok(Use::Nothing);
        }
        let name = keyword.required("NAME")?;
        let mut faces = Vec::new();
        for row in &keyword.rows {
            let word = row.words.get(1).copied().unwrap_or_default();
            if word.is_empty() && row.words[0].is_empty() {
                self.note(format!(
                    "surface `{name}` of all that is free is left out; `all` is the set of it"
                ));
                return Ok(Use::Nothing);
            }
            let elements = names.members(&self.element_sets, row, row.words[0])?;
            for element in elements {
                match self.faces(row, element, word)? {
                    Some(found) => {
                        faces.extend(found.into_iter().map(|face| (Place::Line(row.line), face)));
                    }
                    None => {
                        let of = "edges or ends of elements";
                        self.note(format!("surface `{name}` of {of} is left out"));
                        return Ok(Use::Nothing);
                    }
                }
            }
        }
        self.surface(name).extend(faces);
        Ok(Use::Mesh)
    }

    /// Faces of an element by a word such as `S1`; `None` for edges and ends.
    fn faces(
        &self,
        row: &Row<'_>,
        element: u64,
        word: &str,
    ) -> Result<Option<Vec<FileFace>>, MeshFileFault> {
        if !self.lower.is_solid(element) {
            return Ok(is_face(word).then(|| self.lower.faces(element)));
        }
        match word.to_uppercase().as_str() {
            "" => Ok(Some(vec![FileFace::Free(element)])),
            word => match side(word) {
                Some(side) => Ok(Some(vec![FileFace::Side(element, side)])),
                None => Err(row.fault("a face S1 to S6 of an element or set")),
            },
        }
    }

    /// Rows `node or node set`.
    fn read_surface_of_nodes(
        &mut self,
        keyword: &Keyword<'_>,
        names: &Names,
    ) -> Result<Use, MeshFileFault> {
        let name = keyword.required("NAME")?;
        if self.node_sets.get(name).is_some() {
            return Ok(Use::Nothing);
        }
        self.node_sets.name(name);
        for row in &keyword.rows {
            for node in names.members(&self.node_sets, row, row.words[0])? {
                self.node_sets.push(name, row.line, node);
            }
        }
        Ok(Use::Mesh)
    }

    /// Rows of names of surfaces.
    fn combine(&mut self, keyword: &Keyword<'_>, how: &str) -> Result<Use, MeshFileFault> {
        let name = keyword.required("NAME")?;
        let mut found: Option<Vec<(Place, FileFace)>> = None;
        for row in &keyword.rows {
            for word in row.words.iter().filter(|word| !word.is_empty()) {
                let known = self.surfaces.get(&word.to_uppercase());
                let known =
                    known.ok_or_else(|| row.fault("a surface of elements defined before"))?;
                let is_in = |face: &FileFace| known.1.iter().any(|(_, other)| other == face);
                match (&mut found, how.to_uppercase().as_str()) {
                    (None, "UNION" | "INTERSECTION" | "DIFFERENCE") => {
                        found = Some(known.1.clone());
                    }
                    (Some(found), "UNION") => found.extend(known.1.iter().copied()),
                    (Some(found), "INTERSECTION") => found.retain(|(_, face)| is_in(face)),
                    (Some(found), "DIFFERENCE") => found.retain(|(_, face)| !is_in(face)),
                    _ => {
                        let expected = "COMBINE=UNION, INTERSECTION or DIFFERENCE";
                        return Err(keyword.fault(expected));
                    }
                }
            }
        }
        self.surface(name).extend(found.unwrap_or_default());
        Ok(Use::Mesh)
    }
}

/// Returns whether a word names a face of an element that is no solid.
fn is_face(word: &str) -> bool {
    let word = word.to_uppercase();
    word.is_empty() || ["SPOS", "SNEG"].contains(&word.as_str()) || side(&word).is_some()
}

fn side(word: &str) -> Option<u8> {
    let number: u8 = word.strip_prefix(['S', 's'])?.parse().ok()?;
    (1..=6).contains(&number).then(|| number - 1)
}
