//! Deformable and rigid bodies.

use crate::{
    fault::{Fault, FaultKind},
    model::{Body, BodySection, ContactMass, Formulation, RigidInertia, RigidShape, RigidSurface},
    path::Path,
    solid::{self, SolidError},
};
use striae_law::bulk::Material;
use striae_mesh::{ElementId, Mesh, NodeId, Region, Vec3};

use super::lookup::Names;

/// A deformable body; see [`body`].
#[derive(Clone, Debug)]
pub struct BodyBuilder {
    body: Body,
    own_material: Own,
    /// Formulation requested for the whole body.
    stated: Option<Formulation>,
    sections: Vec<SectionBuilder>,
}

/// Material of a body besides those of its sections.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Own {
    Given,
    None,
}

/// A deformable body with the sets of its mesh, and with sets `all` of facets and of elements,
/// without density; elements of the formulation that [suits](Formulation::suited_to) the
/// material.
pub fn body(name: impl Into<String>, mut mesh: Mesh, material: Material) -> BodyBuilder {
    mesh.name_all_facets();
    mesh.name_all_elements();
    let body = Body {
        name: name.into(),
        mesh,
        formulation: Formulation::suited_to(&material),
        material,
        density: 0.0,
        contact_mass: ContactMass::Consistent,
        sections: Vec::new(),
    };
    BodyBuilder {
        body,
        own_material: Own::Given,
        stated: None,
        sections: Vec::new(),
    }
}

/// A deformable body all of whose elements are in sections, of which this is the first.
pub fn composite(name: impl Into<String>, mesh: Mesh, first: SectionBuilder) -> BodyBuilder {
    let mut builder = body(name, mesh, first.section.material.clone());
    builder.own_material = Own::None;
    builder.section(first)
}

/// A part of a body that is of a material of its own; see [`section`].
#[derive(Clone, Debug)]
pub struct SectionBuilder {
    section: BodySection,
    /// Formulation requested for these elements.
    stated: Option<Formulation>,
}

/// The elements of a set of the mesh of a body, of a material of their own, without
/// density; of the formulation requested for the body, or else the one that
/// [suits](Formulation::suited_to) the material.
pub fn section(elements: impl Into<String>, material: Material) -> SectionBuilder {
    let section = BodySection {
        set: elements.into(),
        elements: Vec::new(),
        formulation: Formulation::suited_to(&material),
        material,
        density: 0.0,
    };
    SectionBuilder {
        section,
        stated: None,
    }
}

impl SectionBuilder {
    /// Mass per reference volume, for inertia and gravity.
    pub fn density(mut self, density: f64) -> Self {
        self.section.density = density;
        self
    }

    /// Sets the formulation of its elements.
    pub fn formulation(mut self, formulation: Formulation) -> Self {
        self.stated = Some(formulation);
        self
    }
}

impl BodyBuilder {
    /// Mass per reference volume, for inertia and gravity.
    pub fn density(mut self, density: f64) -> Self {
        self.body.density = density;
        self
    }

    /// Sets the formulation of its elements, except in sections with one of their own.
    pub fn formulation(mut self, formulation: Formulation) -> Self {
        self.body.formulation = formulation;
        self.stated = Some(formulation);
        self
    }

    /// Sets the treatment of the mass of contact nodes.
    pub fn contact_mass(mut self, contact_mass: ContactMass) -> Self {
        self.body.contact_mass = contact_mass;
        self
    }

    /// Adds a section: elements of a material of their own.
    pub fn section(mut self, section: SectionBuilder) -> Self {
        self.sections.push(section);
        self
    }

    /// A set of the elements all of whose corners meet a condition at rest.
    pub fn elements_where(mut self, set: impl Into<String>, holds: impl Fn(&Vec3) -> bool) -> Self {
        let mesh = &mut self.body.mesh;
        let inside = |corners: &[NodeId]| {
            let mut corners = corners.iter();
            corners.all(|node| holds(&mesh.positions[node.index()]))
        };
        let elements = mesh.elements().enumerate();
        let elements = elements.filter(|(_, corners)| inside(corners));
        let elements: Vec<_> = elements.map(|(at, _)| ElementId::new(at)).collect();
        mesh.element_sets.insert(set, elements);
        self
    }

    /// A set of the nodes whose reference positions meet a condition.
    pub fn nodes_where(mut self, set: impl Into<String>, holds: impl Fn(&Vec3) -> bool) -> Self {
        let nodes = self.nodes_that(holds);
        self.body.mesh.node_sets.insert(set, nodes);
        self
    }

    /// A set of the boundary faces all of whose corners meet a condition at rest.
    pub fn facets_where(mut self, set: impl Into<String>, holds: impl Fn(&Vec3) -> bool) -> Self {
        let faces = self.body.mesh.faces_of_nodes(&self.nodes_that(holds));
        self.body.mesh.facet_sets.insert(set, faces);
        self
    }

    /// A set of the nodes in a region at rest.
    pub fn nodes_in(mut self, set: impl Into<String>, region: &Region) -> Self {
        let nodes = self.body.mesh.nodes_in(region);
        self.body.mesh.node_sets.insert(set, nodes);
        self
    }

    /// A set of the elements that lie in a region at rest with all their corners.
    pub fn elements_in(mut self, set: impl Into<String>, region: &Region) -> Self {
        let mesh = &mut self.body.mesh;
        let elements = mesh.elements_of(&mesh.nodes_in(region));
        mesh.element_sets.insert(set, elements);
        self
    }

    /// A set of the boundary faces that lie in a region at rest with all their corners.
    pub fn facets_in(mut self, set: impl Into<String>, region: &Region) -> Self {
        let mesh = &mut self.body.mesh;
        let faces = mesh.faces_of_nodes(&mesh.nodes_in(region));
        mesh.facet_sets.insert(set, faces);
        self
    }

    /// A set of the boundary faces whose outward normals are within an angle (radians) of a
    /// direction of any length.
    pub fn facets_along(
        mut self,
        set: impl Into<String>,
        direction: impl Into<Vec3>,
        angle: f64,
    ) -> Self {
        let mesh = &mut self.body.mesh;
        let faces = mesh.faces_along(&mesh.boundary_faces(), &direction.into(), angle);
        mesh.facet_sets.insert(set, faces);
        self
    }

    /// A set of the boundary faces that are reached from the one nearest to a place over edges
    /// at which the normal turns by no more than an angle (radians).
    pub fn facets_around(
        mut self,
        set: impl Into<String>,
        place: impl Into<Vec3>,
        angle: f64,
    ) -> Self {
        let mesh = &mut self.body.mesh;
        let faces = mesh.faces_around(&mesh.boundary_faces(), &place.into(), angle);
        mesh.facet_sets.insert(set, faces);
        self
    }

    fn nodes_that(&self, holds: impl Fn(&Vec3) -> bool) -> Vec<NodeId> {
        let positions = self.body.mesh.positions.iter().enumerate();
        let chosen = positions.filter(|(_, position)| holds(position));
        chosen.map(|(node, _)| NodeId::new(node)).collect()
    }

    /// The body with its sections, and what is wrong with these.
    pub(super) fn resolved(self, index: usize) -> (Body, Vec<Fault>) {
        let (mut body, mut faults) = (self.body, Vec::new());
        let path = || Path::part("bodies", index);
        for (at, mut builder) in self.sections.into_iter().enumerate() {
            let sets = &body.mesh.element_sets;
            match FaultKind::members("element", sets, &body.name, &builder.section.set) {
                Ok(elements) => {
                    if let Some(formulation) = builder.stated.or(self.stated) {
                        builder.section.formulation = formulation;
                    }
                    builder.section.elements = elements.to_vec();
                    body.sections.push(builder.section);
                }
                Err(kind) => faults.push(Fault {
                    path: path().field("sections").index(at),
                    kind: *kind,
                }),
            }
        }
        if self.own_material == Own::None && faults.is_empty() {
            let count = body.mesh.element_count();
            let kind = FaultKind::no_material(&body.name, count, &body.sections);
            let path = path().field("material");
            faults.extend(kind.map(|kind| Fault { path, kind }));
        }
        (body, faults)
    }
}

/// A rigid body; see [`plane`], [`rigid_surface`] and [`tied`].
#[derive(Clone, Debug)]
pub struct RigidBuilder {
    surface: RigidSurface,
    ties: Vec<(String, String)>,
}

/// An unbounded rigid plane; the normal points out of the rigid half space.
pub fn plane(
    name: impl Into<String>,
    point: impl Into<Vec3>,
    normal: impl Into<Vec3>,
) -> RigidBuilder {
    let normal: Vec3 = normal.into();
    let shape = RigidShape::Plane {
        point: point.into(),
        normal: normal.try_normalize(0.0).unwrap_or(normal),
    };
    RigidBuilder::new(name, shape)
}

/// A rigid surface of facets, outward by the right-hand rule; a triangle repeats its
/// last corner.
pub fn rigid_surface(
    name: impl Into<String>,
    positions: Vec<Vec3>,
    facets: Vec<[NodeId; 4]>,
) -> RigidBuilder {
    RigidBuilder::new(name, RigidShape::Facets { positions, facets })
}

/// A rigid solid of uniform density inside closed facets, which turns about its centre
/// of mass.
///
/// # Errors
/// When the facets leave the solid open, or look inward.
pub fn rigid_solid(
    name: impl Into<String>,
    positions: Vec<Vec3>,
    facets: Vec<[NodeId; 4]>,
    density: f64,
) -> Result<RigidBuilder, SolidError> {
    let inertia = solid::inertia(&positions, &facets, density)?;
    let rigid = rigid_surface(name, positions, facets);
    Ok(rigid.reference(inertia.centre).inertia(inertia))
}

/// A rigid body without a surface that a node set of a deformable body is tied to.
pub fn tied(
    name: impl Into<String>,
    body: impl Into<String>,
    nodes: impl Into<String>,
) -> RigidBuilder {
    let mut rigid = RigidBuilder::new(name, RigidShape::Bare);
    rigid.ties.push((body.into(), nodes.into()));
    rigid
}

impl RigidBuilder {
    fn new(name: impl Into<String>, shape: RigidShape) -> Self {
        Self {
            surface: RigidSurface::new(name, shape),
            ties: Vec::new(),
        }
    }

    /// Ties another node set of a deformable body to it.
    pub fn and_tied(mut self, body: impl Into<String>, nodes: impl Into<String>) -> Self {
        self.ties.push((body.into(), nodes.into()));
        self
    }

    /// The point about which it turns.
    pub fn reference(mut self, point: impl Into<Vec3>) -> Self {
        self.surface.reference = point.into();
        self
    }

    /// Mass and moments of inertia.
    pub fn inertia(mut self, inertia: RigidInertia) -> Self {
        self.surface.inertia = Some(inertia);
        self
    }

    /// Its shape.
    pub fn shape(&self) -> &RigidShape {
        &self.surface.shape
    }

    pub(super) fn name(&self) -> &str {
        &self.surface.name
    }

    pub(super) fn resolved(
        &self,
        index: usize,
        names: &Names<'_>,
        faults: &mut Vec<Fault>,
    ) -> Option<RigidSurface> {
        let path = |tie| {
            let list = Path::part("rigid_surfaces", index).field("ties");
            list.index(tie)
        };
        let ties: Vec<_> = (self.ties.iter().enumerate())
            .filter_map(|(tie, (body, nodes))| names.nodes(body, nodes, &path(tie), faults))
            .collect();
        (ties.len() == self.ties.len()).then(|| RigidSurface {
            ties,
            ..self.surface.clone()
        })
    }
}
