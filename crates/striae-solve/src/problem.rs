//! A validated model, ready to be solved: everything that is the same in all increments.

use striae_contact::pair::{ContactPair, Geometry, Side as ContactSide};
use striae_mesh::{Face, NodeId, Vec3};
use striae_surface::topology::Surface;

use crate::{
    element::{ElementFault, ReferenceElement, reference_elements},
    model::{Balance, Model, Pair, RigidShape, Side},
    plan::{StepPlan, plans},
};

/// A model with what follows from it.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The model.
    pub model: Model,
    /// First global node of every body; the last entry is the number of nodes.
    pub first_node: Vec<usize>,
    /// Reference position of every global node.
    pub reference: Vec<Vec3>,
    /// Reference elements of every body.
    pub elements: Vec<Vec<ReferenceElement>>,
    /// Contact pairs.
    pub pairs: Vec<PairGeometry>,
    /// What holds in each step.
    pub plans: Vec<StepPlan>,
}

/// A contact pair with its place in the problem.
#[derive(Clone, Debug)]
pub struct PairGeometry {
    /// The pair; its friction is that of the first step.
    pub contact: ContactPair,
    /// Body of each side, `None` for a rigid one.
    pub bodies: [Option<usize>; 2],
    /// Reference positions of a rigid side `b`.
    pub rigid_reference: Vec<Vec3>,
    /// Rigid surface that is side `b`.
    pub rigid: Option<usize>,
    /// Faces of each deformable side, in the order of the facets.
    pub faces: [Vec<Face>; 2],
}

/// A model that cannot be solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ProblemError {
    /// An element of the mesh is degenerate.
    #[error("body `{body}`, {fault}")]
    Element {
        /// Name of the body.
        body: String,
        /// What is wrong.
        fault: ElementFault,
    },
    /// A pair has a rigid first side or two rigid sides.
    #[error("pair `{pair}`: side `a` must be deformable")]
    RigidSide {
        /// Name of the pair.
        pair: String,
    },
}

impl Problem {
    /// Prepares a model.
    ///
    /// # Errors
    /// When the mesh has degenerate elements or a pair no deformable first side.
    pub fn new(model: Model) -> Result<Self, ProblemError> {
        let mut first_node = vec![0];
        let mut reference = Vec::new();
        let mut elements = Vec::new();
        for body in &model.bodies {
            reference.extend_from_slice(&body.mesh.positions);
            first_node.push(reference.len());
            let of_body =
                reference_elements(&body.mesh).map_err(|fault| ProblemError::Element {
                    body: body.name.clone(),
                    fault,
                })?;
            elements.push(of_body);
        }
        let pairs = model.pairs.iter().map(|pair| pair_geometry(&model, pair));
        Ok(Self {
            pairs: pairs.collect::<Result<_, _>>()?,
            plans: plans(&model),
            first_node,
            reference,
            elements,
            model,
        })
    }

    /// Global number of a node of a body.
    pub fn node(&self, body: usize, node: NodeId) -> usize {
        self.first_node[body] + node.index()
    }

    /// Body and node of a global node number.
    pub fn body_node(&self, node: usize) -> (usize, NodeId) {
        let body = self.first_node.partition_point(|&first| first <= node) - 1;
        (body, NodeId::new(node - self.first_node[body]))
    }

    /// Global node of a surface node of a pair.
    pub fn surface_node(&self, pair: usize, side: usize, node: u32) -> Option<usize> {
        let geometry = &self.pairs[pair];
        let surface = geometry.contact.sides[side].surface()?;
        let body = geometry.bodies[side]?;
        Some(self.node(body, surface.nodes()[node as usize]))
    }
}

fn pair_geometry(model: &Model, pair: &Pair) -> Result<PairGeometry, ProblemError> {
    let mut bodies = [None, None];
    let mut faces = [Vec::new(), Vec::new()];
    let mut rigid = None;
    let mut rigid_reference = Vec::new();
    let mut sides = Vec::with_capacity(2);
    for (index, side) in [&pair.a, &pair.b].into_iter().enumerate() {
        sides.push(match side {
            Side::Deformable {
                body,
                faces: of_side,
            } => {
                bodies[index] = Some(body.0);
                faces[index] = of_side.clone();
                deformable(model, body.0, of_side)
            }
            Side::Rigid(surface) => {
                rigid = Some(surface.0);
                let geometry = match &model.rigid_surfaces[surface.0].shape {
                    RigidShape::Plane { point, normal } => Geometry::Plane {
                        point: *point,
                        normal: normal.normalize(),
                    },
                    RigidShape::Facets { positions, facets } => {
                        let surface = Surface::new(facets);
                        rigid_reference = surface
                            .nodes()
                            .iter()
                            .map(|n| positions[n.index()])
                            .collect();
                        Geometry::Rigid(surface)
                    }
                };
                ContactSide {
                    geometry,
                    stiffness: f64::INFINITY,
                    rank: usize::MAX,
                }
            }
        });
    }
    let (Some(b), Some(a)) = (sides.pop(), sides.pop()) else {
        unreachable!("two sides were pushed");
    };
    if bodies[0].is_none() {
        return Err(ProblemError::RigidSide {
            pair: pair.name.clone(),
        });
    }
    Ok(PairGeometry {
        contact: ContactPair {
            name: pair.name.clone(),
            sides: [a, b],
            friction: pair.friction.clone(),
            balance: match pair.balance {
                Balance::Resultants => striae_contact::pair::Balance::Resultants,
                Balance::None => striae_contact::pair::Balance::None,
            },
            search_distance: pair.search_distance,
        },
        bodies,
        rigid_reference,
        rigid,
        faces,
    })
}

fn deformable(model: &Model, body: usize, faces: &[Face]) -> ContactSide {
    let body_model = &model.bodies[body];
    let facets: Vec<[NodeId; 4]> = faces
        .iter()
        .map(|&f| body_model.mesh.face_nodes(f))
        .collect();
    let constants = body_model.material.lame_constants();
    let (lambda, shear) = (constants.lambda, constants.shear);
    ContactSide {
        geometry: Geometry::Deformable(Surface::new(&facets)),
        stiffness: shear * (3.0 * lambda + 2.0 * shear) / (lambda + shear),
        rank: body,
    }
}
