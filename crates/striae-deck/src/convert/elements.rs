//! Elements that are no solids of a body.

use super::Model;
use std::collections::BTreeSet;

/// Beginnings of the types that are surfaces of bodies or rigid bodies.
const SURFACES: [&str; 2] = ["SFM3D", "R3D"];

impl Model<'_> {
    /// Lists elements that nothing is made of.
    pub(super) fn list_other_elements(&mut self) {
        let keywords = self.keywords;
        let others = self
            .instances
            .iter()
            .filter(|instance| !instance.is_solid() && !instance.kinds.is_empty());
        // Their instances are listed as a whole.
        let of_others = others.flat_map(|instance| instance.own.iter().map(|own| own.line));
        let of_others: BTreeSet<usize> = of_others.collect();
        for keyword in keywords {
            let kind = keyword.parameter("TYPE").unwrap_or_default().to_uppercase();
            let is_other = keyword.name == "ELEMENT"
                && !kind.starts_with("C3D")
                && !SURFACES.iter().any(|start| kind.starts_with(start));
            let is_listed = of_others.contains(&keyword.line) || self.used.contains(&keyword.line);
            if is_other && !is_listed {
                let count = keyword.joined_rows(usize::MAX).len();
                let are = if count == 1 {
                    "element is"
                } else {
                    "elements are"
                };
                let what = format!(
                    "*ELEMENT, TYPE={kind}: {count} {are} left out; only C3D4 to C3D27 are elements of a body"
                );
                self.list(keyword.line, what);
            }
        }
    }
}
