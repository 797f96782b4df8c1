//! Lengths that can be computed with: their sixth powers are numbers.

use crate::{fault::FaultKind, model::RigidShape, path::Path};
use striae_mesh::Vec3;

use super::{Draft, List};

/// Smallest and largest extent.
const EXTENTS: [f64; 2] = [1e-50, 1e50];

/// Notes bodies and rigid surfaces that are smaller, larger or farther away.
pub(super) fn check(draft: &Draft<'_>, faults: &mut List) {
    for (index, body) in draft.bodies.iter().enumerate() {
        if let Some(mesh) = body.mesh {
            let path = Path::part("bodies", index);
            let name = format!("body `{}`", body.name);
            of_points(name, &mesh.positions, path, faults);
        }
    }
    for (index, rigid) in draft.rigid_surfaces.iter().enumerate() {
        let path = Path::part("rigid_surfaces", index).field("shape");
        let name = format!("rigid surface `{}`", rigid.name);
        match rigid.part.map(|part| &part.shape) {
            Some(RigidShape::Facets { positions, .. }) => of_points(name, positions, path, faults),
            Some(RigidShape::Plane { point, .. }) if !is_near(point) => {
                faults.push(path, fault(name, point.amax()));
            }
            _ => {}
        }
    }
}

fn of_points(name: String, positions: &[Vec3], path: Path, faults: &mut List) {
    let Some(first) = positions.first() else {
        return;
    };
    if let Some(far) = positions.iter().find(|x| !is_near(x)) {
        return faults.push(path, fault(name, far.amax()));
    }
    let extents = positions.iter().map(|x| (x - first).amax());
    let extent = extents.fold(0.0, f64::max);
    if extent < EXTENTS[0] {
        faults.push(path, fault(name, extent));
    }
}

fn is_near(x: &Vec3) -> bool {
    x.iter().all(|coordinate| coordinate.abs() <= EXTENTS[1])
}

fn fault(what: String, length: f64) -> FaultKind {
    FaultKind::Extent { what, length }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_bounds() {
        let found = |size: f64| {
            let mut faults = List::default();
            let positions = [Vec3::zeros(), Vec3::new(size, 0.0, 0.0)];
            of_points(
                "body `b`".into(),
                &positions,
                Path::of("bodies"),
                &mut faults,
            );
            faults.0.len()
        };
        assert_eq!([1e-30, 1.0, 1e30].map(found), [0; 3]);
        assert_eq!([1e-60, 1e60, f64::INFINITY, f64::NAN].map(found), [1; 4]);
    }
}
