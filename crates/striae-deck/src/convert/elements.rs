//! Elements that are no solids.

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
            if is_other && !of_others.contains(&keyword.line) {
                let what = format!("*ELEMENT, TYPE={kind}: only solids are elements of a body");
                self.list(keyword.line, what);
            }
        }
    }
}
