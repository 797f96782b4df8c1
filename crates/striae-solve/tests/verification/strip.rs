//! Meshes of strips along lines.

use striae_mesh::{CellBlock, Mesh, NodeId, Vec3};

use crate::self_contact::with_skin;

/// A strip of elements one wide along a line, `across` elements thick.
pub fn strip(line: &[[f64; 2]], thickness: f64, across: usize, wide: f64) -> Mesh {
    let count = line.len();
    let at = |k: usize| Vec3::new(line[k][0], 0.0, line[k][1]);
    let normal = |k: usize| {
        let along = at((k + 1).min(count - 1)) - at(k.saturating_sub(1));
        Vec3::new(-along.z, 0.0, along.x).normalize()
    };
    let mut positions = Vec::new();
    for k in 0..count {
        for layer in 0..=across {
            let share = layer as f64 / across as f64 - 0.5;
            let place = at(k) + normal(k) * (share * thickness);
            positions.extend([place, place + Vec3::y() * wide]);
        }
    }
    let node = |k: usize, layer: usize, y: usize| NodeId::new(2 * (k * (across + 1) + layer) + y);
    let cells = (0..count - 1).flat_map(|k| (0..across).map(move |layer| (k, layer)));
    let cells = cells.map(|(k, layer)| {
        let face = |k: usize| {
            [
                node(k, layer, 0),
                node(k, layer, 1),
                node(k, layer + 1, 1),
                node(k, layer + 1, 0),
            ]
        };
        let ([a, b, c, d], [e, f, g, h]) = (face(k), face(k + 1));
        [a, b, c, d, e, f, g, h]
    });
    with_skin(Mesh::new(positions, vec![CellBlock::hexahedra(cells)]).unwrap())
}

/// Lines of a strip that is folded `turns` times, with flat parts of a length and turns of a
/// diameter.
pub fn folded(turns: usize, length: f64, diameter: f64, size: f64) -> Vec<[f64; 2]> {
    let flat = (length / size).round() as usize;
    let round = 6;
    let mut line = Vec::new();
    for turn in 0..=turns {
        let z = diameter * turn as f64;
        let forth = turn % 2 == 0;
        for k in 0..=flat {
            let x = length * k as f64 / flat as f64;
            line.push([if forth { x } else { length - x }, z]);
        }
        if turn < turns {
            for k in 1..round {
                let angle = std::f64::consts::PI * k as f64 / round as f64;
                let way = 0.5 * diameter * angle.sin();
                let x = if forth { length + way } else { -way };
                line.push([x, z + 0.5 * diameter * (1.0 - angle.cos())]);
            }
        }
    }
    line
}
