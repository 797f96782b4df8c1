//! Meshes of strips along lines.

use striae_mesh::{CellBlock, Mesh, NodeId, Vec3};

use crate::self_contact::with_skin;

/// Elements between neighbouring sections, lines of points from one face of a strip to the other,
/// one element wide along `y`; a closed strip leads from the last section to the first one.
pub fn swept(sections: &[Vec<Vec3>], is_closed: bool, wide: f64) -> Mesh {
    let (count, points) = (sections.len(), sections[0].len());
    let pairs = sections
        .iter()
        .flatten()
        .map(|place| [*place, place + Vec3::y() * wide]);
    let node = |k: usize, layer: usize, y: usize| NodeId::new(2 * (k % count * points + layer) + y);
    let steps = if is_closed { count } else { count - 1 };
    let cells = (0..steps).flat_map(|k| (0..points - 1).map(move |layer| (k, layer)));
    let cells = cells.map(|(k, layer)| {
        let [a, b] = [k, k + 1].map(|k| {
            [(layer, 0), (layer, 1), (layer + 1, 1), (layer + 1, 0)].map(|(at, y)| node(k, at, y))
        });
        [a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]]
    });
    let cells = CellBlock::hexahedra(cells);
    with_skin(Mesh::new(pairs.flatten().collect(), vec![cells]).unwrap())
}

/// A strip along a line in the plane of `x` and `z`, `across` elements thick.
pub fn strip(line: &[[f64; 2]], thickness: f64, across: usize, wide: f64) -> Mesh {
    let count = line.len();
    let at = |k: usize| Vec3::new(line[k][0], 0.0, line[k][1]);
    let section = |k: usize| {
        let along = at((k + 1).min(count - 1)) - at(k.saturating_sub(1));
        let normal = Vec3::new(-along.z, 0.0, along.x).normalize();
        let share = |layer: usize| layer as f64 / across as f64 - 0.5;
        (0..=across)
            .map(|layer| at(k) + normal * (share(layer) * thickness))
            .collect()
    };
    swept(&(0..count).map(section).collect::<Vec<_>>(), false, wide)
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
