//! The picture of a textured surface: its facets in outline with a stroke along `s`
//! and a tick along `a` at the nodes, in parallel projection.
//!
//! Seen is the side of the surface that shows the most area; if it hides more than a
//! hundredth of the surface, the opposite view stands beside it. The directions tried
//! are the mean normal, along which an open surface without overhang shows most, and
//! the principal axes of `sum_f A_f n_f n_f`, for closed ones. Facets and nodes turned
//! away are left out. On fine meshes only some of the nodes are drawn.

use std::collections::BTreeSet;

use nalgebra::{Matrix3, SymmetricEigen};
use striae_figure::{Axis, Color, Content, Figure, Panel, Series, Width};
use striae_mesh::Vec3;

use super::surface::{TexturedSurface, extent, in_plane};

/// Share of the area that may be out of sight in a single view.
const HIDDEN: f64 = 0.01;

/// Most nodes drawn in a view, about.
const NODES: f64 = 500.0;

/// Least cosine between a nodal normal and the view for a node to be drawn.
const FACING: f64 = 0.05;

/// Half a stroke and a whole tick over the distance of the nodes drawn.
const STROKE: f64 = 0.36;
const TICK: f64 = 0.26;

/// The figure of a surface.
pub fn figure(surface: &TexturedSurface) -> Figure {
    let areas: Vec<Vec3> = surface.facets.iter().map(|f| area(surface, f)).collect();
    let total: f64 = areas.iter().map(|area| area.norm()).sum();
    let view = best_view(&areas);
    let mut panels = vec![panel(surface, &areas, view)];
    if hidden(&areas, view) > HIDDEN * total {
        panels.push(panel(surface, &areas, -view));
    }
    let width = if panels.len() == 1 {
        Width::Millimetres(120.0)
    } else {
        Width::Page
    };
    Figure::new(width, panels)
}

/// Area vector of a facet.
fn area(surface: &TexturedSurface, corners: &[striae_mesh::NodeId]) -> Vec3 {
    let x = |corner: usize| surface.positions[corners[corner % corners.len()].index()];
    let fan = (1..corners.len().saturating_sub(1)).map(|i| (x(i) - x(0)).cross(&(x(i + 1) - x(0))));
    fan.sum::<Vec3>() * 0.5
}

/// The direction towards the viewer from which the most area shows.
fn best_view(areas: &[Vec3]) -> Vec3 {
    let outer = |area: &Vec3| {
        let size = area.norm().max(f64::MIN_POSITIVE);
        area * area.transpose() / size
    };
    let spread: Matrix3<f64> = areas.iter().map(outer).sum();
    let axes = SymmetricEigen::new(spread).eigenvectors;
    let mean: Vec3 = areas.iter().sum();
    let mean = mean.try_normalize(1e-6 * spread.trace());
    let axes = (0..3).map(|axis| axes.column(axis).into_owned());
    let candidates = mean.into_iter().chain(axes.flat_map(|axis| [axis, -axis]));
    let mut best = (0.0, Vec3::z());
    for view in candidates {
        // What is equal but for round-off does not replace the earlier one.
        let area = shown(areas, view);
        if area > best.0 * (1.0 + 1e-6) {
            best = (area, view);
        }
    }
    rounded(best.1)
}

/// Projected area of the facets that face the viewer.
fn shown(areas: &[Vec3], view: Vec3) -> f64 {
    areas.iter().map(|area| area.dot(&view).max(0.0)).sum()
}

/// Area of the facets turned away from the viewer.
fn hidden(areas: &[Vec3], view: Vec3) -> f64 {
    let away = areas.iter().filter(|area| area.dot(&view) <= 0.0);
    away.map(|area| area.norm()).sum()
}

/// A coordinate axis where the direction is close to one.
fn rounded(view: Vec3) -> Vec3 {
    let nearest = view.map(f64::round);
    if (view - nearest).norm() < 1e-6 {
        nearest
    } else {
        view
    }
}

fn panel(surface: &TexturedSurface, areas: &[Vec3], view: Vec3) -> Panel {
    let axes = in_plane(view);
    let place = |x: &Vec3| axes.map(|axis| axis.dot(x));
    let facing = surface
        .facets
        .iter()
        .zip(areas)
        .filter(|(_, area)| area.dot(&view) > 0.0);
    let mut outlines = Vec::new();
    let mut seen = BTreeSet::new();
    for (corners, _) in facing {
        let closed = corners.iter().chain(corners.first());
        outlines.extend(closed.map(|corner| place(&surface.positions[corner.index()])));
        outlines.push([f64::NAN; 2]);
        seen.extend(corners.iter().map(|corner| corner.index()));
    }
    seen.retain(|&node| surface.normals[node].dot(&view) > FACING);
    let places: Vec<(usize, [f64; 2])> = (seen.iter())
        .map(|&node| (node, place(&surface.positions[node])))
        .collect();
    let (drawn, distance) = thinned(&places);
    let strokes = |vectors: &[Vec3], from: f64, to: f64| {
        let mut points = Vec::new();
        for (node, at) in &drawn {
            let along = place(&vectors[*node]);
            for share in [from, to] {
                points.push([0, 1].map(|axis| at[axis] + share * distance * along[axis]));
            }
            points.push([f64::NAN; 2]);
        }
        Content::line(points)
    };
    let [right, up] = axes.map(axis_name);
    Panel::plane(Axis::linear(right, ""), Axis::linear(up, ""))
        .titled(format!("seen from {}", direction(view)))
        .with(Series::new("", Content::line(outlines)).colored(Color::Grey))
        .with(Series::new("s", strokes(&surface.along, -STROKE, STROKE)).colored(Color::Blue))
        .with(Series::new("a", strokes(&surface.across, 0.0, TICK)).colored(Color::Vermillion))
}

/// At most about [`NODES`] of the places, evenly spread, and their distance.
fn thinned(places: &[(usize, [f64; 2])]) -> (Vec<(usize, [f64; 2])>, f64) {
    let (low, high) = extent(places.iter().map(|(_, at)| *at));
    let [wide, tall] = [0, 1].map(|axis| (high[axis] - low[axis]).max(0.0));
    let spacing = |count: f64| (wide * tall / count).sqrt().max(wide.max(tall) / count);
    let count = places.len().max(1) as f64;
    if count <= NODES {
        return (places.to_vec(), spacing(count));
    }
    let distance = spacing(NODES);
    let mut taken = BTreeSet::new();
    let cell = |at: &[f64; 2]| [0, 1].map(|axis| ((at[axis] - low[axis]) / distance) as u32);
    let drawn = places.iter().filter(|(_, at)| taken.insert(cell(at)));
    (drawn.copied().collect(), distance)
}

/// The name of a coordinate axis, or the direction in numbers.
fn axis_name(axis: Vec3) -> String {
    for (name, unit) in [("x", Vec3::x()), ("y", Vec3::y()), ("z", Vec3::z())] {
        if (axis - unit).norm() < 1e-9 {
            return name.to_owned();
        }
        if (axis + unit).norm() < 1e-9 {
            return format!("−{name}");
        }
    }
    format!("along {}", direction(axis))
}

fn direction(vector: Vec3) -> String {
    let name = |number: f64| {
        let number = (number * 100.0).round() / 100.0 + 0.0;
        number.to_string().replace('-', "−")
    };
    format!(
        "({}, {}, {})",
        name(vector.x),
        name(vector.y),
        name(vector.z)
    )
}
