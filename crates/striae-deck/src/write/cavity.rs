//! Cavities and their contents.

use striae_model::{CavityContent, CavityFilling};

use super::Writer;
use super::value::{list, number, text};

impl<'m> Writer<'m> {
    /// A cavity.
    pub(super) fn cavity(&mut self, at: usize) -> String {
        let cavity = &self.model.cavities[at];
        let faces = cavity.parts.iter().map(|(body, faces)| {
            let set = self.meshes.facets(*body, "", faces);
            let body = &self.model.bodies[body.0].name;
            format!("{{ body = {}, facets = {} }}", text(body), text(&set))
        });
        let faces: Vec<String> = faces.collect();
        let name = text(&cavity.name);
        format!("\n[[cavity]]\nname = {name}\nfaces = {}\n", list(faces))
    }

    /// Content of a cavity in a step.
    pub(super) fn filling(&mut self, filling: &'m CavityFilling) -> String {
        let content = match filling.content {
            CavityContent::Pressure(pressure) => format!("pressure = {}", number(pressure)),
            CavityContent::Volume(volume) => format!("volume = {}", number(volume)),
            CavityContent::VolumeRatio(ratio) => format!("volume_ratio = {}", number(ratio)),
            CavityContent::Gas { ambient, exponent } => {
                let (ambient, exponent) = (number(ambient), number(exponent));
                format!("gas = {{ ambient = {ambient}, exponent = {exponent} }}")
            }
        };
        let name = text(&self.model.cavities[filling.cavity.0].name);
        let curve = self.curve(&filling.curve);
        format!("{{ cavity = {name}, {content}{curve} }}")
    }
}
