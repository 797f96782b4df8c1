//! Textures of the sides of a pair.

use super::{nodal, surfaces::Surfaces};
use crate::{fault::FaultKind, faults::FaultList, raw::Texture, read::At};
use striae_model::{ContactSurface, FaultKind as ModelFault, RigidShape, RigidSurface};
use striae_surface::texture::Paint;

/// The paint of a side, `None` after its faults or those of the side have been noted.
pub(super) fn paint(
    raw: &At<Texture>,
    side: Option<&ContactSurface>,
    surfaces: &Surfaces<'_>,
    faults: &mut FaultList<'_>,
) -> Option<Paint> {
    let paint = match &raw.value {
        Texture::Declared(declared) => Some(match declared.made(&raw.span)? {
            Ok(paint) => paint,
            Err((refusal, place)) => {
                faults.push(&place, FaultKind::Texture(refusal.to_string()));
                return None;
            }
        }),
        Texture::OfFile(_) => None,
    };
    if let Some(surface) = plane(side, surfaces)
        && !matches!(paint, Some(Paint::Field(_)))
    {
        let surface = surface.name.clone();
        faults.push(&raw.span, ModelFault::NodesOnPlane { surface });
    }
    match &raw.value {
        Texture::Declared(_) => paint,
        Texture::OfFile(raw) => nodal::paint(raw, side?, surfaces, faults),
    }
}

/// The rigid plane that a side is, if it is one: it has no nodes.
fn plane<'s>(
    side: Option<&ContactSurface>,
    surfaces: &'s Surfaces<'_>,
) -> Option<&'s RigidSurface> {
    let Some(ContactSurface::Rigid(rigid)) = side else {
        return None;
    };
    let surface = surfaces.rigid[rigid.0].as_ref()?;
    matches!(surface.shape, RigidShape::Plane { .. }).then_some(surface)
}
