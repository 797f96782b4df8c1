//! Textures that cannot be painted, found before a problem is made of the model.

use striae_law::friction::RequiredTextures;
use striae_mesh::{Face, NodeId};
use striae_surface::texture::Paint;

use crate::{
    model::{ContactSurface, Model, Pair, RigidShape},
    pair_geometry::{PairError, Undirected, pair_geometry},
};

/// Cosine between the normals of a facet and of a plane that it faces.
const FACING: f64 = -0.2;

/// A texture that cannot be painted.
#[derive(Clone, Debug, PartialEq)]
pub struct PaintFault {
    /// Position of the pair in the model.
    pub pair: usize,
    /// Side of the texture, if it is one.
    pub side: Option<usize>,
    /// Reason.
    pub error: PairError,
}

/// All that is wrong with the sides and textures of the pairs; nothing if all can be painted.
pub fn faults(model: &Model) -> Vec<PaintFault> {
    let mut faults = Vec::new();
    for (pair, of_pair) in model.pairs.iter().enumerate() {
        if let Err(error) = pair_geometry(model, of_pair) {
            let side = side_of(of_pair, &error);
            faults.push(PaintFault { pair, side, error });
        } else if is_asked_for(model, pair)
            && let Some(error) = on_plane(model, of_pair)
        {
            let side = Some(1);
            faults.push(PaintFault { pair, side, error });
        }
    }
    faults
}

/// Side whose texture an error is about: the only one that is painted, or the first that fails.
fn side_of(pair: &Pair, error: &PairError) -> Option<usize> {
    match error {
        PairError::Texture { side, .. } | PairError::Undirected { side, .. } => Some(*side),
        PairError::PlaneTexture { .. } => pair.textures.iter().position(Option::is_some),
        _ => None,
    }
}

/// True where the friction of a pair needs textures, from the start or in a step.
fn is_asked_for(model: &Model, pair: usize) -> bool {
    let steps = model.steps.iter().flat_map(|step| &step.frictions);
    let changed = steps.filter(|(of, _)| of.0 == pair);
    let mut all = changed
        .map(|(_, friction)| friction)
        .chain([&model.pairs[pair].friction]);
    all.any(|friction| friction.required_textures() != RequiredTextures::Any)
}

/// A texture of a rigid plane that has no direction opposite to a node of the body.
fn on_plane(model: &Model, pair: &Pair) -> Option<PairError> {
    let (ContactSurface::Rigid(rigid), Some(Paint::Field(field))) = (&pair.b, &pair.textures[1])
    else {
        return None;
    };
    let rigid = &model.rigid_surfaces[rigid.0];
    let RigidShape::Plane { point, normal } = &rigid.shape else {
        return None;
    };
    let ContactSurface::Deformable { body, faces } = &pair.a else {
        return None;
    };
    let (body, n) = (&model.bodies[body.0], normal.normalize());
    let facing = |face: &&Face| {
        let area = body.mesh.area_vector(**face);
        area.dot(&n) < FACING * area.norm()
    };
    let nodes = faces.iter().filter(facing);
    let mut nodes: Vec<NodeId> = nodes.flat_map(|face| body.mesh.face_nodes(*face)).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let opposite = |node: &NodeId| {
        let x = body.mesh.positions[node.index()];
        x - n * (x - point).dot(&n)
    };
    let node = *nodes
        .iter()
        .find(|node| field.axes(opposite(node), n).is_none())?;
    let at = opposite(&node);
    Some(PairError::Undirected {
        pair: pair.name.clone(),
        side: 1,
        surface: format!("rigid surface `{}`", rigid.name),
        node: format!("{node} of body `{}`", body.name),
        at: Box::new(at),
        cause: Undirected::of(field, &at),
    })
}
