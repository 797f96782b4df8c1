//! Bodies: meshes with their sets, and materials.

use striae_law::bulk::Material;
use striae_mesh::{ElementId, Face, Mesh, NodeId, Sets};
use striae_model::{BodyId, ContactMass, Formulation, Model};

use super::value::{lines, list, number, text, vector};
use super::{Writer, law};

/// Sets of the bodies: those of the meshes, and those that had no name.
pub(super) struct Meshes<'m> {
    model: &'m Model,
    /// One for each body.
    nodes: Vec<Sets<NodeId>>,
    facets: Vec<Sets<Face>>,
    elements: Vec<Sets<ElementId>>,
}

impl<'m> Meshes<'m> {
    pub(super) fn new(model: &'m Model) -> Self {
        let count = model.bodies.len();
        Self {
            model,
            nodes: vec![Sets::default(); count],
            facets: vec![Sets::default(); count],
            elements: vec![Sets::default(); count],
        }
    }

    /// Name of the set of these nodes, if it may be `preferred`.
    pub(super) fn nodes(&mut self, body: BodyId, preferred: &str, members: &[NodeId]) -> String {
        let known = &self.model.bodies[body.0].mesh.node_sets;
        name(known, &mut self.nodes[body.0], preferred, members)
    }

    /// Name of the set of these facets.
    pub(super) fn facets(&mut self, body: BodyId, preferred: &str, members: &[Face]) -> String {
        let known = &self.model.bodies[body.0].mesh.facet_sets;
        name(known, &mut self.facets[body.0], preferred, members)
    }

    /// Name of the set of these elements, if it may be `preferred`.
    fn elements(&mut self, body: BodyId, preferred: &str, members: &[ElementId]) -> String {
        let known = &self.model.bodies[body.0].mesh.element_sets;
        name(known, &mut self.elements[body.0], preferred, members)
    }
}

/// Name of a set with these members; a new one where there is none.
fn name<T: Ord + Copy>(
    known: &Sets<T>,
    added: &mut Sets<T>,
    preferred: &str,
    members: &[T],
) -> String {
    let mut sorted = members.to_vec();
    sorted.sort_unstable();
    sorted.dedup();
    if known.get(preferred) == Some(&sorted[..]) {
        return preferred.to_owned();
    }
    let same = |(_, members): &(&str, &[T])| *members == &sorted[..];
    if let Some((name, _)) = known.iter().chain(added.iter()).find(same) {
        return name.to_owned();
    }
    let free = |name: &String| known.get(name).is_none() && added.get(name).is_none();
    let mut names = (1..).map(|number| format!("set-{number}"));
    let name = names.find(free).expect("there are more numbers than sets");
    added.insert(name.clone(), sorted);
    name
}

impl Writer<'_> {
    /// A body and its materials.
    pub(super) fn body(&mut self, at: usize) -> String {
        let body = &self.model.bodies[at];
        let name = text(&body.name);
        let Some(own) = self.material(at, &body.name, &body.material, body.density) else {
            return String::new();
        };
        let Some((others, sections)) = self.sections(at) else {
            return String::new();
        };
        let formulation = formulation(body.formulation);
        let mass = match body.contact_mass {
            ContactMass::Consistent => "consistent",
            ContactMass::Redistributed => "redistributed",
        };
        format!(
            "{own}{others}\n[[body]]\nname = {name}\n\
             material = {name}\nformulation = \"{formulation}\"\ncontact_mass = \"{mass}\"\n\
             {sections}mesh = {}\nnode_sets = {}\nfacet_sets = {}\nelement_sets = {}\n",
            mesh(&body.mesh),
            self.node_sets(at),
            self.facet_sets(at),
            self.element_sets(at),
        )
    }

    fn node_sets(&self, body: usize) -> String {
        let known = &self.model.bodies[body].mesh.node_sets;
        sets(
            "numbers",
            &[known, &self.meshes.nodes[body]],
            None,
            |node| node.0.to_string(),
        )
    }

    fn facet_sets(&self, body: usize) -> String {
        let mesh = &self.model.bodies[body].mesh;
        let known = [&mesh.facet_sets, &self.meshes.facets[body]];
        let all = mesh.boundary_faces();
        sets("sides", &known, Some(&all), |face| {
            format!("[{}, {}]", face.element.0, face.side)
        })
    }

    fn element_sets(&self, body: usize) -> String {
        let mesh = &self.model.bodies[body].mesh;
        let known = [&mesh.element_sets, &self.meshes.elements[body]];
        let all: Vec<ElementId> = (0..mesh.element_count()).map(ElementId::new).collect();
        sets("numbers", &known, Some(&all), |element| {
            element.0.to_string()
        })
    }

    /// A material of a body.
    fn material(
        &mut self,
        body: usize,
        name: &str,
        material: &Material,
        density: f64,
    ) -> Option<String> {
        let Some(lines) = law::material(material) else {
            let part = format!("body `{}`", self.model.bodies[body].name);
            self.refuse(part, "its material is a user-defined law");
            return None;
        };
        let density = match density {
            0.0 => String::new(),
            density => format!("density = {}\n", number(density)),
        };
        let name = text(name);
        Some(format!("\n[[material]]\nname = {name}\n{density}{lines}"))
    }

    /// Materials of the sections of a body, and the sections.
    fn sections(&mut self, at: usize) -> Option<(String, String)> {
        let body = &self.model.bodies[at];
        let (mut materials, mut sections) = (String::new(), Vec::new());
        let taken = |name: &String| self.model.bodies.iter().any(|body| body.name == *name);
        let names = (1..).map(|number: usize| format!("{}-{number}", body.name));
        let names: Vec<String> = (names.filter(|name| !taken(name)))
            .take(body.sections.len())
            .collect();
        for (section, name) in body.sections.iter().zip(names) {
            materials += &self.material(at, &name, &section.material, section.density)?;
            let elements = &section.elements;
            let set = self.meshes.elements(BodyId(at), &section.set, elements);
            let (set, name) = (text(&set), text(&name));
            let formulation = formulation(section.formulation);
            sections.push(format!(
                "{{ elements = {set}, material = {name}, formulation = \"{formulation}\" }}"
            ));
        }
        let sections = match sections.len() {
            0 => String::new(),
            _ => format!("sections = {}\n", lines(sections.into_iter())),
        };
        Some((materials, sections))
    }
}

fn formulation(formulation: Formulation) -> &'static str {
    match formulation {
        Formulation::Standard => "standard",
        Formulation::MeanDilatation => "mean-dilatation",
        Formulation::AssumedStrain => "assumed-strain",
    }
}

/// Positions and cells.
fn mesh(mesh: &Mesh) -> String {
    let positions = mesh.positions.iter().map(vector);
    let cells = mesh.elements().map(corners);
    format!(
        "{{ positions = {}, cells = {} }}",
        lines(positions),
        lines(cells)
    )
}

/// Numbers of nodes.
pub(super) fn corners(nodes: &[NodeId]) -> String {
    list(nodes.iter().map(|node| node.0.to_string()))
}

/// Sets with their members, but for a set `all` of what decks call so by themselves.
fn sets<T: Ord + Copy>(
    key: &str,
    sets: &[&Sets<T>],
    all: Option<&[T]>,
    member: impl Fn(&T) -> String,
) -> String {
    let stated = sets.iter().flat_map(|sets| sets.iter());
    let stated = stated.filter(|(name, members)| {
        let follows = *name == "all" && all == Some(*members);
        !members.is_empty() && !follows
    });
    lines(stated.map(|(name, members)| {
        let members = list(members.iter().map(&member));
        format!("{{ name = {}, {key} = {members} }}", text(name))
    }))
}
