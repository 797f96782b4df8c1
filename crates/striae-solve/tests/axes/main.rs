//! Displacements prescribed in axes of their own, against turned models and closed forms.

#[path = "../verification/scene.rs"]
#[allow(dead_code, reason = "shared with another test program")]
mod scene;

mod ring;
mod turned;

use striae_mesh::{Mesh, NodeId, Vec3};
use striae_model::{Axes, BodyId, Curve, Displacement};

/// Prescribes the components that are not `None` at the nodes of the first body with these
/// reference positions.
fn prescribed(
    mesh: &Mesh,
    axes: Axes,
    components: [Option<f64>; 3],
    at: impl Fn(&Vec3) -> bool,
) -> Displacement {
    let nodes = mesh.positions.iter().enumerate();
    let nodes: Vec<NodeId> = nodes
        .filter(|(_, x)| at(x))
        .map(|(node, _)| NodeId::new(node))
        .collect();
    assert!(!nodes.is_empty());
    Displacement {
        set: "chosen".to_owned(),
        body: BodyId(0),
        nodes,
        axes,
        components: components.map(|of| of.map(Into::into)),
        curve: Curve::Ramp,
    }
}
