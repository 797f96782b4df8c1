//! Motion of two sides towards each other.

use striae_mesh::Vec3;

use crate::{configuration::Configuration, side::Side};

/// Largest motion of one side relative to the other.
pub fn approach(start: &Configuration, end: &Configuration) -> f64 {
    let moves = |side: Side| -> [Vec3; 2] {
        let side = match start.pair.is_self_contact() {
            true => Side::A,
            false => side,
        };
        let (Some(from), Some(to)) = (&start.sides[side], &end.sides[side]) else {
            let way = start.plane().zip(end.plane());
            let way = way.map_or_else(Vec3::zeros, |((from, _), (to, _))| to - from);
            return [way; 2];
        };
        let mut moves = from.x.iter().zip(&to.x).map(|(from, to)| to - from);
        let first = moves.next().unwrap_or_default();
        moves.fold([first; 2], |[low, high], way| {
            [low.inf(&way), high.sup(&way)]
        })
    };
    let [a, b] = [moves(Side::A), moves(Side::B)];
    let apart = (a[1] - b[0]).abs().sup(&(b[1] - a[0]).abs());
    apart.norm()
}
