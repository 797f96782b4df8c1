//! Extent and volume of bodies, the poorest elements, and elements that lock.

use striae_mesh::{CellKind, Mesh, Vec3, place, quality::SMALL_SCALED_JACOBIAN, significant};
use striae_model::{Body, Formulation, Model};

use super::{Advice, Topic, parts::Part};

/// Scaled Jacobian below which elements are worth a look.
const POOR: f64 = 0.3;
/// Poisson's ratio from which on volumes can hardly change.
const STIFF_VOLUME: f64 = 0.45;

/// Notes the shape of every body.
pub(super) fn look(model: &Model, advice: &mut Advice) {
    for body in &model.bodies {
        shape(body, advice);
        for part in Part::all(body) {
            locking(body, &part, advice);
        }
    }
}

/// Smallest and largest coordinates of nodes.
pub(super) fn extent(mesh: &Mesh) -> [Vec3; 2] {
    box_of(&mesh.positions)
}

/// Least and largest coordinates of points.
pub(super) fn box_of(points: &[Vec3]) -> [Vec3; 2] {
    let start = [f64::INFINITY, f64::NEG_INFINITY].map(Vec3::repeat);
    let points = points.iter();
    points.fold(start, |[low, high], x| [low.inf(x), high.sup(x)])
}

fn shape(body: &Body, advice: &mut Advice) {
    let name = &body.name;
    let [low, high] = extent(&body.mesh);
    let quality = body.mesh.quality();
    let [shortest, longest] = [quality.shortest_edge, quality.longest_edge];
    let [shortest, longest] = [shortest, longest].map(|edge| significant(edge, 4));
    advice.note(
        Topic::Shape,
        name,
        format!(
            "body `{name}` lies between {} and {} and has the volume {}; its edges are {shortest} to {longest} long, the smallest scaled Jacobian {:.3}",
            place(&low),
            place(&high),
            significant(quality.volume, 7),
            quality.smallest_scaled_jacobian
        ),
    );
    if quality.smallest_scaled_jacobian < POOR {
        let poorest = quality.poorest.iter();
        let poorest = poorest.map(|(element, scaled)| format!("{element} ({scaled:.3})"));
        let poorest = poorest.collect::<Vec<_>>().join(", ");
        let text = format!(
            "body `{name}`: the elements of the poorest shape, by scaled Jacobian (1 for regular elements): {poorest}"
        );
        match quality.slivers.len() {
            0 => advice.note(Topic::Shape, name, text),
            count => advice.warn(
                Topic::Shape,
                name,
                format!("{text}; {count} of them below {SMALL_SCALED_JACOBIAN} are nearly flat"),
            ),
        }
    }
}

fn locking(body: &Body, part: &Part, advice: &mut Advice) {
    let (about, nu) = (&part.name, part.poissons_ratio());
    let others = part.kinds.iter().any(|kind| *kind != CellKind::Hexahedron);
    let tetrahedra = part.kinds.contains(&CellKind::Tetrahedron);
    let name = &body.name;
    if others && part.formulation == Formulation::AssumedStrain {
        advice.warn(
            Topic::Locking,
            name,
            format!(
                "{about} has elements other than hexahedra; `formulation = \"assumed-strain\"` treats them like the standard formulation"
            ),
        );
    }
    if nu > STIFF_VOLUME && part.formulation == Formulation::Standard {
        advice.warn(
            Topic::Locking,
            name,
            format!(
                "{about} has Poisson's ratio {nu:.4} and the standard formulation: its elements lock and are far too stiff; use `formulation = \"mean-dilatation\"`"
            ),
        );
    } else if nu > STIFF_VOLUME && tetrahedra {
        advice.warn(
            Topic::Locking,
            name,
            format!(
                "{about} has Poisson's ratio {nu:.4} and four-node tetrahedra, which lock in every formulation; use ten-node tetrahedra or hexahedra"
            ),
        );
    } else if tetrahedra {
        advice.note(
            Topic::Locking,
            name,
            format!(
                "{about} has four-node tetrahedra, which are stiffer than hexahedra of the same size; use ten-node tetrahedra, or compare with a finer mesh"
            ),
        );
    }
}
