//! Choice of the dependent side of a tie, independent of names and numbers.
//!
//! The side with the finer facets follows, as its functions resolve more. Of two as fine, it
//! is that of the body that comes first by the mean place of its nodes, by `x`, `y`, `z`,
//! then by how far they are from there. Bodies for which all that is the same would be one.

use std::cmp::Ordering;

use striae_contact::{side::Side, tie::Joined};
use striae_mesh::{Mesh, Vec3};

/// Relative difference that counts as zero.
const SAME: f64 = 1e-6;

/// The side that follows.
pub(super) fn finer(joined: &Joined, meshes: [&Mesh; 2]) -> Side {
    let sizes = Side::BOTH.map(|side| joined.facet_size(side));
    let spreads = meshes.map(Spread::new);
    let scale = spreads[0].radius.max(spreads[1].radius);
    let by_spread = || {
        let [a, b] = spreads.each_ref().map(Spread::numbers);
        let of_each = a.iter().zip(&b);
        let different = of_each.map(|(a, b)| compared(*a, *b, scale));
        different.fold(Ordering::Equal, Ordering::then)
    };
    let order = compared(sizes[0], sizes[1], sizes[0].max(sizes[1])).then_with(by_spread);
    match order {
        Ordering::Greater => Side::B,
        Ordering::Less | Ordering::Equal => Side::A,
    }
}

fn compared(a: f64, b: f64, scale: f64) -> Ordering {
    if (a - b).abs() <= SAME * scale {
        Ordering::Equal
    } else {
        a.total_cmp(&b)
    }
}

/// Spread of the nodes of a body.
struct Spread {
    centre: Vec3,
    radius: f64,
}

impl Spread {
    fn new(mesh: &Mesh) -> Self {
        let count = mesh.positions.len() as f64;
        let centre = mesh.positions.iter().sum::<Vec3>() / count;
        let squares = mesh.positions.iter().map(|x| (x - centre).norm_squared());
        Self {
            centre,
            radius: (squares.sum::<f64>() / count).sqrt(),
        }
    }

    fn numbers(&self) -> [f64; 4] {
        [self.centre.x, self.centre.y, self.centre.z, self.radius]
    }
}
