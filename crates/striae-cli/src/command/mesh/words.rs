//! Description of a mesh file, in words and numbers.

use std::{collections::BTreeMap, fmt::Write, path::Path};

use striae::mesh_file::{MaterialCard, Reading, unused_note};
use striae_mesh::{
    CellKind, Mesh, NodeId, Quality, Vec3, place, quality::SMALL_SCALED_JACOBIAN, significant,
};

/// Lines about the mesh of a body.
pub fn of_body(file: &Path, reading: &Reading) -> String {
    let mesh = &reading.mesh;
    let quality = mesh.quality();
    let (low, high) = mesh.bounds();
    let mut lines = vec![
        file.display().to_string(),
        extent(&low, &high),
        format!("  {} nodes", mesh.positions.len()),
    ];
    lines.extend(kinds(mesh));
    lines.push(format!("  volume {}", significant(quality.volume, 7)));
    lines.push(format!(
        "  edges from {} to {}",
        significant(quality.shortest_edge, 7),
        significant(quality.longest_edge, 7)
    ));
    lines.push(shape(reading, &quality));
    lines.extend(element_sets(mesh));
    lines.extend(facet_sets(mesh));
    lines.extend(node_sets(mesh));
    lines.extend(reading.materials.iter().map(|card| material(card, reading)));
    lines.extend(reading.notes.iter().map(|note| format!("note: {note}")));
    lines.extend(joints(reading));
    let unused = unused_note(&reading.unused, true);
    lines.extend(unused.map(|note| format!("note: {note}")));
    lines.join("\n") + "\n"
}

pub(super) fn extent(low: &Vec3, high: &Vec3) -> String {
    format!("  from {} to {}", place(low), place(high))
}

/// A line for each kind of elements.
fn kinds(mesh: &Mesh) -> Vec<String> {
    let mut counts: BTreeMap<CellKind, usize> = BTreeMap::new();
    for block in &mesh.blocks {
        *counts.entry(block.kind).or_default() += block.len();
    }
    let words = |(kind, count): (CellKind, usize)| {
        let shape = kind.shape();
        let name = if count == 1 { shape.name } else { shape.plural };
        format!("  {count} {name}")
    };
    counts.into_iter().map(words).collect()
}

fn shape(reading: &Reading, quality: &Quality) -> String {
    let poorest = quality.poorest.iter();
    let poorest = poorest.map(|(element, scaled)| {
        let number = reading.numbers.element(*element);
        format!("{number} ({scaled:.4})")
    });
    let mut line = format!(
        "  smallest scaled Jacobians (at best 1), of elements {}",
        poorest.collect::<Vec<_>>().join(", ")
    );
    if !quality.slivers.is_empty() {
        let count = quality.slivers.len();
        let _ = write!(line, "; {count} below {SMALL_SCALED_JACOBIAN}");
    }
    line
}

fn element_sets(mesh: &Mesh) -> Vec<String> {
    let rows = mesh.element_sets.iter().map(|(name, members)| {
        let volumes = members.iter().map(|element| mesh.element_volume(*element));
        (name, members.len(), Some(volumes.sum()))
    });
    table(["element sets", "elements", "volume"], rows.collect())
}

fn facet_sets(mesh: &Mesh) -> Vec<String> {
    let rows = mesh.facet_sets.iter();
    let rows = rows.map(|(name, members)| (name, members.len(), Some(mesh.area(members))));
    table(["facet sets", "facets", "area"], rows.collect())
}

fn node_sets(mesh: &Mesh) -> Vec<String> {
    let rows = mesh.node_sets.iter();
    let rows = rows.map(|(name, members)| (name, members.len(), None));
    table(["node sets", "nodes", ""], rows.collect())
}

/// A material that the file states, and the element sets that are of it.
fn material(material: &MaterialCard, reading: &Reading) -> String {
    let sections = reading.sections.iter();
    let of_it = sections.filter(|section| section.material.eq_ignore_ascii_case(&material.name));
    let sets: Vec<String> = of_it.map(|section| format!("`{}`", section.set)).collect();
    let sets = match sets.len() {
        0 => String::new(),
        _ => format!("; of {}", sets.join(", ")),
    };
    match &material.card {
        Ok(card) => format!("  material `{}`: {card}{sets}", material.name),
        Err(cause) => format!(
            "  material `{}` cannot be used: {cause}{sets}",
            material.name
        ),
    }
}

/// Most pieces of a body that a note describes.
const MOST_PIECES: usize = 4;

/// Pieces that share no nodes, and nodes at one place that are not joined.
fn joints(reading: &Reading) -> Vec<String> {
    let Reading { mesh, numbers, .. } = reading;
    let at = |node: NodeId| place(&mesh.positions[node.index()]);
    let mut lines = Vec::new();
    let pieces = mesh.pieces();
    if pieces.len() > 1 {
        let shown = pieces.iter().take(MOST_PIECES).map(|piece| {
            let (count, node) = (piece.len(), numbers.node(piece[0]));
            format!("{count} nodes with node {node} at {}", at(piece[0]))
        });
        let mut shown: Vec<String> = shown.collect();
        match pieces.len().saturating_sub(MOST_PIECES) {
            0 => {}
            more => shown.push(format!("and {more} more")),
        }
        lines.push(format!(
            "note: pieces that share no nodes: {}: {}",
            pieces.len(),
            shown.join("; ")
        ));
    }
    let coincident = mesh.coincident_nodes();
    if let Some([first, second]) = coincident.first() {
        lines.push(format!(
            "warning: pairs of coincident nodes that are not joined: {}, the first {} and {} at {}; elements separate there without resistance. Merge coincident nodes in the mesh generator, unless a slit is intended",
            coincident.len(),
            numbers.node(*first),
            numbers.node(*second),
            at(*first)
        ));
    }
    lines
}

/// A table of sets by name, count and size; nothing where there are none.
fn table(head: [&str; 3], rows: Vec<(&str, usize, Option<f64>)>) -> Vec<String> {
    if rows.is_empty() {
        return Vec::new();
    }
    let names = rows.iter().map(|(name, ..)| name.chars().count());
    let width = names.max().unwrap_or(0).max(head[0].len());
    let line = |name: &str, count: &str, size: &str| {
        let line = format!("  {name:<width$}  {count:>10}  {size:>14}");
        line.trim_end().to_owned()
    };
    let mut lines = vec![line(head[0], head[1], head[2])];
    lines.extend(rows.into_iter().map(|(name, count, size)| {
        let size = size.map_or_else(String::new, |size| significant(size, 7));
        line(name, &count.to_string(), &size)
    }));
    lines
}
