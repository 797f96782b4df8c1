//! Textures that nearly have no direction on their surface.

use striae_model::{ContactSurface, Model, Pair, RigidShape};
use striae_surface::texture::{Lines, Paint};

use super::{Advice, Topic};

/// Sine of the angle between a direction and the normal that counts as zero.
const ALONG: f64 = 1e-6;
/// Sine from which on the direction is doubtful: six degrees.
const NEARLY: f64 = 0.1;

/// Notes textures nearly along the normal of a plane; those along it are refused with the model.
pub(super) fn look(model: &Model, advice: &mut Advice) {
    for pair in &model.pairs {
        on_plane(model, pair, advice);
    }
}

fn on_plane(model: &Model, pair: &Pair, advice: &mut Advice) {
    let (ContactSurface::Rigid(rigid), Some(Paint::Field(field))) = (&pair.b, &pair.textures[1])
    else {
        return;
    };
    let rigid = &model.rigid_surfaces[rigid.0];
    let (RigidShape::Plane { normal, .. }, Lines::Uniform(direction)) =
        (&rigid.shape, &field.lines)
    else {
        return;
    };
    let sine = direction.normalize().cross(&normal.normalize()).norm();
    let (name, plane) = (&pair.name, &rigid.name);
    if (ALONG..NEARLY).contains(&sine) {
        advice.warn(
            Topic::Texture,
            name,
            format!(
                "pair `{name}`: the texture of `{plane}` is only {:.1} degrees from its normal; its small tangential part gives the direction",
                sine.asin().to_degrees()
            ),
        );
    }
}
