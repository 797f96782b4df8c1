//! Keywords of a file that no mesh is made of.

/// A keyword of a file that does not affect the mesh, such as a step or a contact pair.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unused {
    /// The keyword without its asterisk, in capitals.
    pub keyword: String,
    /// Locations in the file.
    pub places: Vec<String>,
    /// `true` if it states a material.
    pub of_materials: bool,
}

/// Most places of a keyword that a note names.
const MOST_PLACES: usize = 4;

/// A note of all that is not used, but for materials where these are; `None` where there is nothing.
pub fn unused_note(unused: &[Unused], with_materials: bool) -> Option<String> {
    let listed = unused.iter();
    let listed = listed.filter(|unused| !(with_materials && unused.of_materials));
    let words: Vec<String> = listed.map(words).collect();
    (!words.is_empty()).then(|| {
        format!(
            "keywords of the file that a mesh does not use: {}; `striae convert` makes a deck of them",
            words.join(", ")
        )
    })
}

fn words(unused: &Unused) -> String {
    let named = unused.places.iter().take(MOST_PLACES).cloned();
    let mut named: Vec<String> = named.collect();
    match unused.places.len().saturating_sub(MOST_PLACES) {
        0 => {}
        more => named.push(format!("and {more} more")),
    }
    format!("*{} ({})", unused.keyword, named.join(", "))
}
