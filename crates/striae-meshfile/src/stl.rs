//! STL files, ASCII and binary: triangles without topology.
//!
//! Binary: a header of 80 bytes, the number of triangles as `u32`, and for each
//! triangle twelve `f32` (normal and three corners) and two more bytes, all
//! little-endian. A file with exactly the length that follows from its number
//! of triangles is binary, any other that starts with `solid` and has no zero
//! byte is ASCII.

use super::lines::Lines;
use super::{MeshFileFault, Place, RigidSurfaceMesh};
use std::collections::HashMap;
use striae_mesh::{NodeId, Vec3};

/// The triangles of a rigid surface.
pub(super) fn rigid_surface(bytes: &[u8]) -> Result<RigidSurfaceMesh, MeshFileFault> {
    let corners = match announced_length(bytes) {
        Some(length) if length == bytes.len() as u64 => binary(bytes)?,
        _ if is_ascii(bytes) => ascii(&String::from_utf8_lossy(bytes))?,
        announced => {
            return Err(MeshFileFault::Length {
                announced: announced.unwrap_or(HEADER as u64),
                found: bytes.len() as u64,
            });
        }
    };
    let surface = joined(&corners);
    if surface.facets.is_empty() {
        return Err(MeshFileFault::Empty {
            expected: "triangles",
            remedy: "export the surface again",
        });
    }
    Ok(surface)
}

const HEADER: usize = 84;
const TRIANGLE: usize = 50;
/// Ratio of the area to the square of the longest edge below which it counts as zero.
const FLAT: f64 = 1e-12;

/// The length of a binary file by its number of triangles.
fn announced_length(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(80..HEADER)?.first_chunk::<4>()?;
    Some(HEADER as u64 + TRIANGLE as u64 * u64::from(u32::from_le_bytes(*count)))
}

fn is_ascii(bytes: &[u8]) -> bool {
    let start = bytes.trim_ascii_start().first_chunk::<5>();
    start.is_some_and(|word| word.eq_ignore_ascii_case(b"solid")) && !bytes.contains(&0)
}

fn binary(bytes: &[u8]) -> Result<Vec<[Vec3; 3]>, MeshFileFault> {
    let (triangles, _) = bytes[HEADER..].as_chunks::<TRIANGLE>();
    let mut corners = Vec::with_capacity(triangles.len());
    for (index, triangle) in triangles.iter().enumerate() {
        let (numbers, _) = triangle[12..48].as_chunks::<4>();
        let number = |index: usize| f64::from(f32::from_le_bytes(numbers[index]));
        let of_triangle = [0, 3, 6].map(|i| Vec3::new(number(i), number(i + 1), number(i + 2)));
        for corner in &of_triangle {
            finite(Place::Triangle(index + 1), corner)?;
        }
        corners.push(of_triangle);
    }
    Ok(corners)
}

/// Refuses a corner with a coordinate that is infinite or not a number.
fn finite(place: Place, x: &Vec3) -> Result<(), MeshFileFault> {
    if x.iter().all(|coordinate| coordinate.is_finite()) {
        return Ok(());
    }
    let found = format!("a corner at ({}, {}, {})", x.x, x.y, x.z);
    let fault = MeshFileFault::at(place, "finite coordinates", found);
    Err(fault.with_remedy("export the surface again"))
}

fn ascii(text: &str) -> Result<Vec<[Vec3; 3]>, MeshFileFault> {
    let text = text.to_ascii_lowercase();
    let mut lines = Lines::new(&text);
    let mut triangles = Vec::new();
    while let Some(line) = lines.next() {
        match line.text.split_whitespace().next() {
            Some("solid" | "endsolid") => continue,
            Some("facet") => {}
            _ => return Err(line.fault("`facet normal` or `endsolid`")),
        }
        starts_with(&mut lines, "outer loop")?;
        let triangle = [
            vertex(&mut lines)?,
            vertex(&mut lines)?,
            vertex(&mut lines)?,
        ];
        triangles.push(triangle);
        starts_with(&mut lines, "endloop")?;
        starts_with(&mut lines, "endfacet")?;
    }
    Ok(triangles)
}

fn vertex(lines: &mut Lines<'_>) -> Result<Vec3, MeshFileFault> {
    let line = lines.expect("vertex x y z")?;
    let mut words = line.words();
    if words.next::<String>("vertex")? != "vertex" {
        return Err(line.fault("vertex x y z"));
    }
    let x: Vec<f64> = words.several(3, "a coordinate")?;
    let corner = Vec3::new(x[0], x[1], x[2]);
    finite(Place::Line(line.number), &corner)?;
    Ok(corner)
}

fn starts_with(lines: &mut Lines<'_>, words: &str) -> Result<(), MeshFileFault> {
    let line = lines.expect(words)?;
    if line.text.split_whitespace().eq(words.split_whitespace()) {
        return Ok(());
    }
    Err(line.fault(words))
}

/// True where corners coincide or are in line.
fn is_flat([a, b, c]: &[Vec3; 3]) -> bool {
    let edges = [b - a, c - b, a - c];
    let longest = edges.iter().map(Vec3::norm).fold(0.0, f64::max);
    let area = (edges[0] / longest).cross(&(edges[1] / longest)).norm();
    area.is_nan() || area <= FLAT
}

/// Facets that share corners at equal positions, without those of no extent.
fn joined(triangles: &[[Vec3; 3]]) -> RigidSurfaceMesh {
    let mut ids: HashMap<[u64; 3], NodeId> = HashMap::new();
    let mut positions = Vec::new();
    let mut facets = Vec::new();
    for triangle in triangles {
        if is_flat(triangle) {
            continue;
        }
        let [a, b, c] = triangle.map(|x| {
            // Adding zero makes the two zeros equal.
            let key = [x.x, x.y, x.z].map(|v| (v + 0.0).to_bits());
            *ids.entry(key).or_insert_with(|| {
                positions.push(x);
                NodeId::new(positions.len() - 1)
            })
        });
        facets.push([a, b, c, c]);
    }
    let left_out = triangles.len() - facets.len();
    RigidSurfaceMesh {
        positions,
        facets,
        left_out,
    }
}
