//! Random contact systems of two bodies against dense algebra.

use super::*;
use faer::{Mat, linalg::solvers::Solve};

/// Numbers in `-1..1` of a linear congruential generator.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

const SIZES: [usize; 2] = [21, 30];
const MULTIPLIERS: usize = 70;

/// Two bodies, multipliers, and one unknown that is solved for apart.
struct System {
    places: Places,
    rows: Vec<Row>,
    own: [Vec<u32>; 2],
    complements: [Vec<f64>; 2],
}

/// Bodies on springs of a stiffness; entries between bulk unknowns that no flexibility knows
/// have a size.
fn system(stiffness: f64, unknown: f64) -> System {
    let mut random = Random(7);
    let bulk = SIZES[0] + SIZES[1];
    let count = bulk + MULTIPLIERS + 1;
    let own = [0..SIZES[0], SIZES[0]..bulk].map(|range| range.map(|k| k as u32).collect());
    let mut kinds = vec![Kind::Multiplier; count];
    kinds[count - 1] = Kind::Apart;
    let complements = [0, 1].map(|block| {
        let n = SIZES[block];
        // Laplacian of a chain, which only the springs hold.
        let mut values = vec![0.0; n * n];
        for k in 0..n - 1 {
            for (i, j, a) in [
                (k, k, 0.5),
                (k + 1, k + 1, 0.5),
                (k, k + 1, -0.5),
                (k + 1, k, -0.5),
            ] {
                values[i * n + j] += a;
            }
        }
        values
    });
    let mut rows = vec![Row::new(); count];
    for (block, own) in (0_u32..).zip(&own) {
        let own: &Vec<u32> = own;
        for (row, &k) in (0_u32..).zip(own) {
            kinds[k as usize] = Kind::Bulk { block, row };
            rows[k as usize].push((k, stiffness));
        }
    }
    let spread = |random: &mut Random, count: usize| {
        let first = ((random.next() + 1.0) * 0.5 * (bulk - count) as f64) as usize;
        first..first + count
    };
    for k in 0..bulk {
        for to in spread(&mut random, 4) {
            rows[k].push((to as u32, unknown * random.next()));
        }
    }
    for m in (bulk..count - 1).filter(|m| m % 2 == 0) {
        rows[m].push((m as u32, 1.0));
        rows[m].push((m as u32 + 1, 0.3 * random.next()));
    }
    for m in (bulk..count - 1).filter(|m| m % 2 == 1) {
        let partner = (m - bulk) / 2;
        for k in [partner, SIZES[0] + partner % SIZES[1]] {
            rows[m].push((k as u32, 1.0 + 0.1 * random.next()));
            rows[k].push((m as u32, 1.0 + 0.1 * random.next()));
        }
        rows[m].push((m as u32, -0.5));
    }
    for row in &mut rows {
        row.sort_by_key(|entry| entry.0);
        row.dedup_by(|b, a| {
            a.0 == b.0 && {
                a.1 += b.1;
                true
            }
        });
    }
    System {
        places: Places { kinds },
        rows,
        own,
        complements,
    }
}

impl System {
    fn blocks(&self) -> Vec<Block<'_>> {
        let own = self.own.iter().zip(&self.complements);
        own.map(|(places, values)| Block {
            places,
            values: Values::Double(values),
        })
        .collect()
    }

    fn dense(&self) -> Mat<f64> {
        let n = self.rows.len();
        let mut dense = Mat::zeros(n, n);
        for (i, row) in self.rows.iter().enumerate() {
            row.iter().for_each(|&(j, a)| dense[(i, j as usize)] += a);
        }
        for (own, values) in self.own.iter().zip(&self.complements) {
            for (i, &k) in own.iter().enumerate() {
                for (j, &l) in own.iter().enumerate() {
                    dense[(k as usize, l as usize)] += values[j * own.len() + i];
                }
            }
        }
        dense[(n - 1, n - 1)] = 1.0;
        dense
    }

    fn factored(&self) -> Option<(Compliant, Flexibility)> {
        let (kinds, blocks) = (&self.places.kinds, self.blocks());
        let flexibility = Flexibility::new(&blocks, (kinds, &self.rows), 1e-8)?;
        let given = (blocks.as_slice(), &flexibility);
        let compliant =
            Compliant::factor(&self.places, self.rows.clone(), given, (1e-12, Trial::Due));
        compliant.ok().map(|compliant| (compliant, flexibility))
    }
}

#[test]
fn the_solution_is_that_of_dense_algebra() {
    for unknown in [0.0, 0.01, 0.05] {
        let system = system(0.3, unknown);
        let (compliant, flexibility) = system.factored().expect("a regular system");
        let n = system.rows.len();
        let rhs: Vec<f64> = (0..n - 1).map(|k| (k as f64).sin()).chain([0.0]).collect();
        let found = compliant.solve((&system.blocks(), &flexibility), &rhs, Purpose::Answer);
        let b = Mat::from_fn(n, 1, |i, _| rhs[i]);
        let expected = system.dense().partial_piv_lu().solve(&b);
        let size = expected.norm_max();
        for (k, value) in found.iter().enumerate() {
            let error = (value - expected[(k, 0)]).abs() / size;
            assert!(error < 1e-8, "unknown {k}: off by {error:e}");
        }
        assert_eq!(compliant.dense_order(), MULTIPLIERS);
    }
}

#[test]
fn bodies_that_only_contact_holds_have_no_flexibility() {
    assert!(system(0.0, 0.0).factored().is_none());
}

#[test]
fn what_is_too_much_for_gmres_is_handed_back() {
    assert!(system(0.3, 2.0).factored().is_none());
}
