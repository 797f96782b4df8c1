//! Description of a rigid surface: extent, sides that its facets look to, and edges.
//!
//! The corners of a facet go counter-clockwise as seen from its outer side, so two facets go
//! along their edge in opposite directions. A surface without other edges encloses the volume
//! `V = 1/3 sum x . a` over its facets, `a` the vector of their area; it is positive where they
//! look outward.

use std::{collections::BTreeMap, path::Path};

use striae::mesh_file::RigidSurfaceMesh;
use striae_mesh::{NodeId, Vec3, place, significant};

use super::words::extent;

/// Ratio of the area to the square of the longest diagonal below which it counts as zero.
const FLAT: f64 = 1e-12;
/// Mean of the unit normals below which they look to no common side.
const ALL_AROUND: f64 = 1e-6;

/// Lines about a rigid surface.
pub(super) fn words(file: &Path, surface: &RigidSurfaceMesh) -> String {
    let positions = &surface.positions;
    let start = positions.first().copied().unwrap_or_default();
    let corners = positions.iter();
    let (low, high) = corners.fold((start, start), |(low, high), x| (low.inf(x), high.sup(x)));
    let areas: Vec<Vec3> = surface.facets.iter().map(|it| area(surface, it)).collect();
    let total: f64 = areas.iter().map(Vec3::norm).sum();
    let edges = Edges::of(&surface.facets);
    let mut lines = vec![
        file.display().to_string(),
        extent(&low, &high),
        format!("  {} nodes", positions.len()),
        format!("  facets of a rigid surface: {}", surface.facets.len()),
        format!("  area {}", significant(total, 7)),
        format!("  {}", edges.closure()),
        format!("  {}", sides(surface, &areas, &edges)),
    ];
    lines.extend(edges.warnings(positions));
    lines.extend(without_area(surface));
    lines.join("\n") + "\n"
}

/// Half the cross product of the diagonals.
fn area(surface: &RigidSurfaceMesh, facet: &[NodeId; 4]) -> Vec3 {
    let [a, b, c, d] = facet.map(|node| surface.positions[node.index()]);
    0.5 * (c - a).cross(&(d - b))
}

/// Sides that the facets look to.
fn sides(surface: &RigidSurfaceMesh, areas: &[Vec3], edges: &Edges) -> String {
    if edges.turned.is_some() || edges.crowded.is_some() {
        return "the facets do not look to one side".to_owned();
    }
    if edges.boundary == 0 {
        let volume = volume(surface, areas);
        let size = significant(volume.abs(), 7);
        return match volume >= 0.0 {
            true => format!("the facets look outward; the enclosed volume is {size}"),
            false => format!(
                "the facets look inward, so that bodies touch it from within; the enclosed volume is {size}"
            ),
        };
    }
    let total: f64 = areas.iter().map(Vec3::norm).sum();
    let mean = areas.iter().sum::<Vec3>() / total;
    match mean.norm() > ALL_AROUND {
        true => format!(
            "mean normal {}: bodies touch it from there",
            place(&mean.normalize())
        ),
        false => "the normals look to all sides, with a mean of zero".to_owned(),
    }
}

/// Signed volume of a closed surface.
fn volume(surface: &RigidSurfaceMesh, areas: &[Vec3]) -> f64 {
    // From a point nearby, so that little is lost to cancellation.
    let origin = surface.positions.first().copied().unwrap_or_default();
    let facets = surface.facets.iter().zip(areas);
    let parts = facets.map(|(facet, area)| {
        let corners = facet.map(|node| surface.positions[node.index()] - origin);
        // The middle of a triangle counts its last corner once.
        let middle = match facet[2] == facet[3] {
            true => (corners[0] + corners[1] + corners[2]) / 3.0,
            false => corners.iter().sum::<Vec3>() / 4.0,
        };
        middle.dot(area) / 3.0
    });
    parts.sum()
}

/// Facets of no area, those that were left out and those that are there.
fn without_area(surface: &RigidSurfaceMesh) -> Vec<String> {
    let mut lines = Vec::new();
    match surface.left_out {
        0 => {}
        1 => lines.push("note: 1 facet without area is left out".to_owned()),
        count => lines.push(format!("note: {count} facets without area are left out")),
    }
    let is_flat = |facet: &&[NodeId; 4]| {
        let [a, b, c, d] = facet.map(|node| surface.positions[node.index()]);
        let lengths = [b - a, c - b, c - a, d - b].map(|edge| edge.norm_squared());
        let longest = lengths.into_iter().fold(0.0, f64::max);
        let area = 2.0 * area(surface, facet).norm();
        area.is_nan() || area <= FLAT * longest
    };
    let mut flat = surface.facets.iter().filter(is_flat);
    if let Some(first) = flat.next() {
        let at = place(&surface.positions[first[0].index()]);
        lines.push(format!(
            "warning: facets without area: {}, the first at {at}; a deck refuses them, so remove them in the mesh generator",
            1 + flat.count()
        ));
    }
    lines
}

/// A facet at an edge, and whether it goes from the lower node to the higher one.
type Joined = (usize, bool);

/// Edges of facets, by how they join them.
struct Edges {
    /// Number of edges of one facet.
    boundary: usize,
    /// Edges along which two facets go the same way.
    turned: Option<Found>,
    /// Edges of more than two facets.
    crowded: Option<Found>,
}

/// Number of edges of a kind, and the first of them.
struct Found {
    count: usize,
    facets: Vec<usize>,
    ends: [NodeId; 2],
}

impl Edges {
    fn of(facets: &[[NodeId; 4]]) -> Self {
        let mut all: BTreeMap<[NodeId; 2], Vec<Joined>> = BTreeMap::new();
        for (index, facet) in facets.iter().enumerate() {
            for corner in 0..4 {
                let [from, to] = [facet[corner], facet[(corner + 1) % 4]];
                if from != to {
                    let ends = [from.min(to), from.max(to)];
                    all.entry(ends).or_default().push((index, from < to));
                }
            }
        }
        let found = |is_one: &dyn Fn(&[Joined]) -> bool| {
            let mut of_kind = all.iter().filter(|(_, of)| is_one(of));
            let (ends, of) = of_kind.next()?;
            Some(Found {
                count: 1 + of_kind.count(),
                facets: of.iter().map(|(facet, _)| *facet).collect(),
                ends: *ends,
            })
        };
        Self {
            boundary: all.values().filter(|of| of.len() == 1).count(),
            turned: found(&|of| matches!(of, [(_, way), (_, other)] if way == other)),
            crowded: found(&|of| of.len() > 2),
        }
    }

    fn closure(&self) -> String {
        match self.boundary {
            0 => "closed".to_owned(),
            count => format!("open, with {count} boundary edges"),
        }
    }

    /// Edges at which facets have no common side.
    fn warnings(&self, positions: &[Vec3]) -> Vec<String> {
        let place_of = |found: &Found| {
            let [from, to] = found.ends.map(|node| place(&positions[node.index()]));
            let facets = found.facets.iter().map(usize::to_string);
            let facets: Vec<String> = facets.collect();
            format!(
                "the first of facets {} from {from} to {to}",
                facets.join(", ")
            )
        };
        let turned = self.turned.iter().map(|found| {
            format!(
                "warning: edges between facets of opposite orientations: {}, {}; turn one of them, so that the corners of all are counter-clockwise as seen from the body",
                found.count,
                place_of(found)
            )
        });
        let crowded = self.crowded.iter().map(|found| {
            format!(
                "warning: edges of more than two facets: {}, {}; remove facets that lie within",
                found.count,
                place_of(found)
            )
        });
        turned.chain(crowded).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tetrahedron at the corner of a cube, without some of its facets.
    fn said(facets: &[[usize; 3]]) -> String {
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 6.0]];
        let surface = RigidSurfaceMesh {
            positions: corners.map(Vec3::from).to_vec(),
            facets: facets
                .iter()
                .map(|[a, b, c]| [*a, *b, *c, *c].map(NodeId::new))
                .collect(),
            left_out: 0,
        };
        words(Path::new("s.stl"), &surface)
    }

    const OUTWARD: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

    #[test]
    fn closed_surfaces_look_outward_or_inward() {
        let outward = said(&OUTWARD);
        let words = "closed\n  the facets look outward; the enclosed volume is 1\n";
        assert!(outward.ends_with(words), "{outward}");
        let inward = said(&OUTWARD.map(|[a, b, c]| [a, c, b]));
        assert!(inward.contains("look inward"), "{inward}");
    }

    #[test]
    fn open_surfaces_have_a_mean_normal_and_boundary_edges() {
        let base = said(&OUTWARD[..1]);
        assert!(base.contains("open, with 3 boundary edges"), "{base}");
        assert!(base.contains("mean normal (0, 0, -1)"), "{base}");
    }

    #[test]
    fn edges_without_a_common_side_are_told() {
        let mut facets = OUTWARD.to_vec();
        facets[0] = [0, 1, 2];
        let turned = said(&facets);
        let words =
            "opposite orientations: 3, the first of facets 0, 1 from (0, 0, 0) to (1, 0, 0)";
        assert!(turned.contains(words), "{turned}");
        facets[0] = OUTWARD[0];
        facets.push([0, 1, 2]);
        let crowded = said(&facets);
        assert!(
            crowded.contains("edges of more than two facets: 3"),
            "{crowded}"
        );
        assert!(crowded.contains("do not look to one side"), "{crowded}");
        assert!(!crowded.contains("opposite"), "{crowded}");
    }

    #[test]
    fn facets_without_area_are_told() {
        let flat = said(&[[0, 1, 2], [0, 1, 1]]);
        assert!(
            flat.contains("facets without area: 1, the first at (0, 0, 0)"),
            "{flat}"
        );
    }
}
