//! Number of unknowns that contact leaves free.
//!
//! The row of a multiplier says what the multiplier is, as where a node slips; or how two
//! sides yield to it, as on the ramp of a weak node; or, with no multiplier in it, it holds
//! one of the bulk unknowns that contact touches:
//!
//! ```text
//! freedom = bulk unknowns - rows without multipliers
//! ```
//!
//! The number is the order of the dense system that an elimination of the multipliers leaves if
//! rows do not fill up: none where all nodes stick to a rigid surface, two for each node that slips
//! there, and at least the unknowns of one side between two bodies. It follows from the rows alone,
//! whichever way the system is solved.

use super::Kind;
use rayon::prelude::*;
use striae_sparse::sparse_elimination::{DROPPED, Row};

/// Bulk unknowns that the rows of the multipliers leave free.
pub(crate) fn freedom(kinds: &[Kind], rows: &[Row]) -> usize {
    let is_bulk = |kind: &&Kind| matches!(kind, Kind::Bulk { .. });
    let bulk = kinds.iter().filter(is_bulk).count();
    let holds = |(kind, row): &(&Kind, &Row)| **kind == Kind::Multiplier && holds(kinds, row);
    let held = kinds.par_iter().zip(rows).filter(holds).count();
    bulk.saturating_sub(held)
}

/// Returns whether a row contains no multiplier.
fn holds(kinds: &[Kind], row: &Row) -> bool {
    let largest = row.iter().fold(0.0_f64, |m, e| m.max(e.1.abs()));
    let counts = |a: f64| a.abs() > DROPPED * largest;
    let is_multiplier = |&(c, a): &(u32, f64)| kinds[c as usize] == Kind::Multiplier && counts(a);
    !row.iter().any(is_multiplier)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interface::{Block, Interface, Places};
    use striae_sparse::Values;

    #[test]
    fn it_is_the_order_that_elimination_leaves() {
        const NODES: usize = 8;
        // Two rows of nodes on springs, the first ones tied, the next ones with known forces.
        let mut spring = vec![0.0; NODES * NODES];
        spring.iter_mut().step_by(NODES + 1).for_each(|s| *s = 1.0);
        let own = [0..8, 8..16].map(|range| range.collect::<Vec<u32>>());
        let blocks = own.each_ref().map(|places| Block {
            places,
            values: Values::Double(&spring),
        });
        for (tied, yielding) in (0..7).flat_map(|tied| [(tied, 0), (tied, 2)]) {
            let mut kinds: Vec<Kind> = (0..2)
                .flat_map(|block| (0..8).map(move |row| Kind::Bulk { block, row }))
                .collect();
            kinds.extend([Kind::Multiplier; 6]);
            let mut rows = vec![Row::new(); kinds.len()];
            for (at, m) in (16_u32..22).enumerate() {
                rows[at].push((m, 1.0));
                rows[at + NODES].push((m, -1.0));
                rows[m as usize] = match at < tied {
                    true if at < yielding => vec![(at as u32, 1.0), (m, 0.01)],
                    true => vec![(at as u32, 1.0), ((at + NODES) as u32, -1.0)],
                    false => vec![(at as u32, 0.2), (m, 1.0)],
                };
            }
            let found = freedom(&kinds, &rows);
            let eliminated = Interface::factor(&Places { kinds }, rows, &blocks, 1e-12);
            assert_eq!(found, 16 - tied.saturating_sub(yielding));
            assert_eq!(eliminated.expect("springs").dense_order(), found);
        }
    }

    #[test]
    fn rows_hold_bulk_unknowns_unless_multipliers_are_in_them() {
        let bulk = |row: u32| Kind::Bulk { block: 0, row };
        let mut kinds: Vec<Kind> = (0..4).map(bulk).collect();
        kinds.extend([Kind::Multiplier; 3]);
        kinds.push(Kind::Apart);
        let mut rows = vec![Row::new(); kinds.len()];
        rows[0] = vec![(0, 1.0), (4, 1.0)];
        assert_eq!(freedom(&kinds[..4], &rows[..4]), 4);
        // A gap, and two rows of a node that slips.
        rows[4] = vec![(0, 1.0), (1, -0.5)];
        rows[5] = vec![(4, 0.3), (5, 1.0)];
        rows[6] = vec![(2, 0.5), (4, 0.3), (6, 1.0)];
        assert_eq!(freedom(&kinds, &rows), 3);
        // They stick.
        rows[5] = vec![(2, 1.0)];
        rows[6] = vec![(3, 1.0), (6, 1e-20)];
        assert_eq!(freedom(&kinds, &rows), 1);
        // Contact yields a little.
        rows[4].push((4, 0.01));
        assert_eq!(freedom(&kinds, &rows), 2);
    }
}
