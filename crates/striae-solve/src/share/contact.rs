//! Assignment of rows of contact to ranks, which add their derivatives.
//!
//! All ranks hold the contact surfaces and have the same bits of positions, tractions and roles
//! there, so that any of them can add any row. A division of the volume says little of where
//! contact is: the rows of one rank's nodes may need all derivatives, or none. Nodes that carry
//! traction are shared out by their places instead: halved across their longest extent, again and
//! again. Each rank has about as many, on both sides of a place.

use std::ops::Range;
use striae_mesh::Vec3;

/// A rank for every place, of which each has about as many.
pub(crate) fn shared_out(places: &[Vec3], ranks: usize) -> Vec<u32> {
    let mut of_places = vec![0; places.len()];
    let mut all: Vec<usize> = (0..places.len()).collect();
    halve(places, &mut all, 0..ranks as u32, &mut of_places);
    of_places
}

fn halve(places: &[Vec3], part: &mut [usize], ranks: Range<u32>, of_places: &mut [u32]) {
    if ranks.len() <= 1 || part.is_empty() {
        part.iter().for_each(|&at| of_places[at] = ranks.start);
        return;
    }
    let first = places[part[0]];
    let (least, most) = part.iter().fold((first, first), |(least, most), &at| {
        (least.inf(&places[at]), most.sup(&places[at]))
    });
    let axis = (most - least).imax();
    let middle = ranks.start + ranks.len() as u32 / 2;
    let count = part.len() * (ranks.len() / 2) / ranks.len();
    part.select_nth_unstable_by(count, |&a, &b| {
        let along = places[a][axis].total_cmp(&places[b][axis]);
        along.then(a.cmp(&b))
    });
    let (low, high) = part.split_at_mut(count);
    halve(places, low, ranks.start..middle, of_places);
    halve(places, high, middle..ranks.end, of_places);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two grids of places that face each other.
    fn facing() -> Vec<Vec3> {
        let grid = (0..600).map(|at| (f64::from(at % 20), f64::from(at / 20)));
        grid.flat_map(|(x, y)| [Vec3::new(x, y, 0.0), Vec3::new(x + 0.3, y - 0.2, 0.1)])
            .collect()
    }

    #[test]
    fn ranks_have_about_as_many() {
        for ranks in 1..=7 {
            let of_places = shared_out(&facing(), ranks);
            for rank in 0..ranks as u32 {
                let count = of_places.iter().filter(|&&of| of == rank).count();
                assert!(count.abs_diff(1200 / ranks) <= 2, "{count} of {ranks}");
            }
        }
    }

    #[test]
    fn places_that_face_each_other_are_mostly_one_rank_s() {
        let of_places = shared_out(&facing(), 4);
        let parted = of_places.chunks(2).filter(|two| two[0] != two[1]).count();
        assert!(parted < 60, "{parted} of 600");
    }

    #[test]
    fn few_places_or_one_are_shared_out_as_well() {
        assert_eq!(shared_out(&[], 3), [0; 0]);
        assert_eq!(shared_out(&[Vec3::zeros(); 3], 1), [0; 3]);
        let mut of_places = shared_out(&[Vec3::zeros(); 3], 3);
        of_places.sort_unstable();
        assert_eq!(of_places, [0, 1, 2]);
    }
}
