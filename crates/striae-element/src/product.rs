//! Products of matrices with a row or a column for each corner, in the lanes of the processor:
//! they are filled with corners, so that sums do not depend on their number.

/// Factors `L` and `R` of a product, by what is summed over.
pub(super) type Factors<'a, const N: usize> = (&'a [[f64; N]], &'a [[f64; N]]);

/// `K_ab = sum_c L_ca R_cb` over all `c` of some parts, some rows at a time in registers: as
/// many as divide the corners.
#[inline(always)]
pub(super) fn product<const N: usize, const PARTS: usize>(
    parts: [Factors<N>; PARTS],
    block: &mut [[f64; N]; N],
) {
    match N {
        4 | 8 => by_rows::<N, 4, PARTS>(parts, block),
        6 => by_rows::<N, 3, PARTS>(parts, block),
        10 => by_rows::<N, 5, PARTS>(parts, block),
        _ => by_rows::<N, 1, PARTS>(parts, block),
    }
}

#[inline(always)]
fn by_rows<const N: usize, const ROWS: usize, const PARTS: usize>(
    parts: [Factors<N>; PARTS],
    block: &mut [[f64; N]; N],
) {
    for (first, rows) in (0..N).step_by(ROWS).zip(block.chunks_exact_mut(ROWS)) {
        let mut sums = [[0.0; N]; ROWS];
        for (left, right) in parts {
            for (left, right) in left.iter().zip(right) {
                for a in 0..ROWS {
                    for b in 0..N {
                        sums[a][b] += left[first + a] * right[b];
                    }
                }
            }
        }
        rows.copy_from_slice(&sums);
    }
}

/// Makes a block symmetric by its lower part.
#[inline(always)]
pub(super) fn mirror<const N: usize>(block: &mut [[f64; N]; N]) {
    for a in 0..N {
        for b in 0..a {
            block[b][a] = block[a][b];
        }
    }
}

/// Takes a block to its symmetric part.
#[inline(always)]
pub(super) fn symmetrise<const N: usize>(block: &mut [[f64; N]; N]) {
    for a in 0..N {
        for b in 0..a {
            let mean = 0.5 * (block[a][b] + block[b][a]);
            (block[a][b], block[b][a]) = (mean, mean);
        }
    }
}
