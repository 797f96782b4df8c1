//! Rigid surfaces beside the bodies that they touch.

use striae_mesh::significant;
use striae_model::{ContactSurface, Model, RigidShape};

use super::{
    Advice, Topic,
    shape::{box_of, extent},
};

/// Size of a rigid surface over that of a body below and above which units seem to differ.
const SMALL: f64 = 2e-3;
const LARGE: f64 = 500.0;

/// Warns of rigid surfaces that are hardly in the unit of length of the bodies they touch.
pub(super) fn look(model: &Model, advice: &mut Advice) {
    for pair in &model.pairs {
        let (ContactSurface::Deformable { body, .. }, ContactSurface::Rigid(rigid)) =
            (&pair.a, &pair.b)
        else {
            continue;
        };
        let rigid = &model.rigid_surfaces[rigid.0];
        let RigidShape::Facets { positions, .. } = &rigid.shape else {
            continue;
        };
        let body = &model.bodies[body.0];
        let [low, high] = extent(&body.mesh);
        let size = (high - low).norm();
        let [low, high] = box_of(positions);
        let own = (high - low).norm();
        if !(SMALL..LARGE).contains(&(own / size)) {
            let (name, body) = (&rigid.name, &body.name);
            let text = format!(
                "rigid surface `{name}` is {own} long, but body `{body}`, which it is to touch, {size}; are both meshes in one unit of length?",
                own = significant(own, 4),
                size = significant(size, 4)
            );
            advice.warn(Topic::Units, name, text);
        }
    }
}
