//! Keywords of a file that no mesh is made of, in the order of their first lines.

use super::super::Unused;
use super::keywords::Keyword;
use super::material;
use std::collections::BTreeSet;

/// Keywords that say nothing of a model.
const SILENT: [&str; 2] = ["HEADING", "PREPRINT"];

/// The keywords in lines that are passed over; `place` puts into words where a line is.
pub(super) fn unused(
    keywords: &[Keyword<'_>],
    passed_over: &BTreeSet<usize>,
    place: impl Fn(usize) -> String,
) -> Vec<Unused> {
    let of_materials = material::lines(keywords);
    let mut found: Vec<Unused> = Vec::new();
    let named = keywords.iter().filter(|keyword| {
        let name = keyword.name.as_str();
        passed_over.contains(&keyword.line) && !SILENT.contains(&name) && !name.starts_with("END ")
    });
    for keyword in named {
        let of_materials = of_materials.contains(&keyword.line);
        let known = found
            .iter_mut()
            .find(|unused| unused.keyword == keyword.name && unused.of_materials == of_materials);
        match known {
            Some(unused) => unused.places.push(place(keyword.line)),
            None => found.push(Unused {
                keyword: keyword.name.clone(),
                places: vec![place(keyword.line)],
                of_materials,
            }),
        }
    }
    found
}
