//! Bodies.

use super::{cards::Cards, formulation::formulation, materials::Materials, mesh, sections, sets};
use crate::{faults::FaultList, names::Names, raw, read::At, value::Text};
use std::path::Path;
use striae_law::bulk::Material;
use striae_mesh::{Face, Mesh, NodeId};
use striae_meshfile::{Asked, Reading, unused_note};
use striae_model::{Body, BodyId, BodySection, ContactMass, DraftBody, Formulation};

/// All bodies of the deck, of which some may be faulty.
pub(super) struct Bodies {
    names: Names,
    bodies: Vec<RawBody>,
}

struct RawBody {
    name: String,
    mesh: Option<Mesh>,
    /// The file of its mesh, as the deck states it.
    file: Option<String>,
    /// Notes on parts of this file that were interpreted or replaced.
    notes: Vec<String>,
    material: Option<Material>,
    density: Option<f64>,
    formulation: Option<Formulation>,
    sections: Vec<BodySection>,
    contact_mass: ContactMass,
}

impl Bodies {
    pub(super) fn new(
        raw: &[At<raw::Body>],
        materials: &Materials,
        base: &Path,
        faults: &mut FaultList<'_>,
    ) -> Self {
        let names = Names::new(
            "body",
            raw.iter().map(|body| body.value.name.as_ref()),
            faults,
        );
        let bodies = raw
            .iter()
            .map(|body| lower_body(&body.value, materials, base, faults))
            .collect();
        Self { names, bodies }
    }

    /// The body of that name.
    pub(super) fn find(
        &self,
        name: Option<&At<Text>>,
        faults: &mut FaultList<'_>,
    ) -> Option<BodyId> {
        self.names.find(name?, faults).map(BodyId)
    }

    /// Name of a body.
    pub(super) fn name(&self, body: BodyId) -> &str {
        &self.bodies[body.0].name
    }

    /// Sections of a body, as far as they are known.
    pub(super) fn sections(&self, body: BodyId) -> &[BodySection] {
        &self.bodies[body.0].sections
    }

    /// Mesh of a body, if it could be made.
    pub(super) fn mesh(&self, body: BodyId) -> Option<&Mesh> {
        self.bodies[body.0].mesh.as_ref()
    }

    /// Known parts of all bodies.
    pub(super) fn drafts(&self) -> Vec<DraftBody<'_>> {
        let bodies = self.bodies.iter().map(|body| DraftBody {
            name: &body.name,
            mesh: body.mesh.as_ref(),
            material: body.material.as_ref(),
            sections: &body.sections,
            density: body.own_density(),
        });
        bodies.collect()
    }

    /// Nodes of a set of a body.
    pub(super) fn nodes(
        &self,
        body: BodyId,
        set: Option<&At<Text>>,
        faults: &mut FaultList<'_>,
    ) -> Option<Vec<NodeId>> {
        sets::members(
            "node",
            &self.mesh(body)?.node_sets,
            self.name(body),
            set?,
            faults,
        )
    }

    /// Faces of a set of a body.
    pub(super) fn faces(
        &self,
        body: BodyId,
        set: Option<&At<Text>>,
        faults: &mut FaultList<'_>,
    ) -> Option<Vec<Face>> {
        sets::members(
            "facet",
            &self.mesh(body)?.facet_sets,
            self.name(body),
            set?,
            faults,
        )
    }

    /// Notes on parts of mesh files that were interpreted or replaced.
    pub(super) fn notes(&self) -> Vec<String> {
        // Bodies that are parts of one file have notes of it in common.
        let mut notes: Vec<(&RawBody, &String, Vec<String>)> = Vec::new();
        let all = self.bodies.iter();
        let all = all.flat_map(|body| body.notes.iter().map(move |note| (body, note)));
        for (body, note) in all {
            let known = notes.iter_mut().find(|(first, known, _)| {
                body.file.is_some() && first.file == body.file && *known == note
            });
            let name = format!("`{}`", body.name);
            match known {
                Some((_, _, names)) if !names.contains(&name) => names.push(name),
                _ => notes.push((body, note, vec![name])),
            }
        }
        let words = |(_, note, names): (&RawBody, &String, Vec<String>)| match &names[..] {
            [name] => format!("body {name}: {note}"),
            names => format!("bodies {}: {note}", names.join(", ")),
        };
        notes.into_iter().map(words).collect()
    }

    /// The bodies of the model, if none is faulty.
    pub(super) fn finished(self) -> Option<Vec<Body>> {
        self.bodies
            .into_iter()
            .map(|body| {
                // Without one of its own, no element is of it.
                let first = || body.sections.first().map(|of| of.material.clone());
                let material = body.material.clone().or_else(first)?;
                let suited = Formulation::suited_to(&material);
                Some(Body {
                    name: body.name,
                    mesh: body.mesh?,
                    formulation: body.formulation.unwrap_or(suited),
                    material,
                    density: body.density.unwrap_or(0.0),
                    contact_mass: body.contact_mass,
                    sections: body.sections,
                })
            })
            .collect()
    }
}

impl RawBody {
    /// Density of its own material; zero if there is none, `None` without that material.
    fn own_density(&self) -> Option<f64> {
        let sections = self.sections.iter();
        let covered: usize = sections.map(|of| of.elements.len()).sum();
        let whole = self.mesh.as_ref().map(Mesh::element_count);
        let density = self.density.unwrap_or(0.0);
        (whole != Some(covered)).then_some(density)
    }
}

fn lower_body(
    raw: &raw::Body,
    materials: &Materials,
    base: &Path,
    faults: &mut FaultList<'_>,
) -> RawBody {
    let name = raw
        .name
        .as_ref()
        .map_or("", |name| &name.value.0)
        .to_owned();
    let (material, density) = match &raw.material {
        Some(name) => materials.find(name, faults),
        None => (None, None),
    };
    let reading = raw.mesh.as_ref();
    let reading = reading.and_then(|mesh| mesh::body_mesh(mesh, &name, base, faults));
    let (mut mesh, notes, asked, cards) = match reading {
        Some(reading) => {
            let cards = cards(&reading, raw);
            let mut notes = reading.notes;
            notes.extend(unused_note(&reading.unused, cards.is_some()));
            (Some(reading.mesh), notes, reading.asked, cards)
        }
        None => (None, Vec::new(), None, None),
    };
    if let Some(mesh) = &mut mesh {
        sets::add_sets(mesh, &name, raw, faults);
    }
    let asked = asked.map(|asked| match asked {
        Asked::MeanDilatation => Formulation::MeanDilatation,
        Asked::AssumedStrain => Formulation::AssumedStrain,
    });
    let stated = formulation(&raw.formulation).or(asked);
    let sections = mesh.as_ref().map_or_else(Vec::new, |mesh| {
        let sections = sections::Sections {
            materials,
            stated,
            mesh,
            body: &name,
            cards,
        };
        sections.lowered(raw, faults)
    });
    RawBody {
        sections,
        name,
        mesh,
        file: file(raw).and_then(|file| Some(file.file.as_ref()?.value.0.clone())),
        notes,
        material,
        density,
        formulation: stated,
        contact_mass: match raw.contact_mass.as_ref().map(|mass| mass.value) {
            None | Some(raw::ContactMass::Consistent) => ContactMass::Consistent,
            Some(raw::ContactMass::Redistributed) => ContactMass::Redistributed,
        },
    }
}

/// The file of the mesh of a body.
fn file(raw: &raw::Body) -> Option<&raw::BodyFile> {
    match &raw.mesh.as_ref()?.value {
        raw::Mesh::File(file) => Some(file),
        raw::Mesh::Generated(_) | raw::Mesh::Inline(_) => None,
    }
}

/// Materials stated by the mesh file, if the deck requests them.
fn cards(reading: &Reading, raw: &raw::Body) -> Option<Cards> {
    let wanted = file(raw)?.materials.as_ref()?.value.0;
    wanted.then(|| Cards {
        materials: reading.materials.clone(),
        sections: reading.sections.clone(),
    })
}
