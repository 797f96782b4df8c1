//! Blocks of numbers as text: predicted, split into bytes, deflated, in base64.
//!
//! Codes are predicted from what was before in space (`x_i' = x_(i-1)`), in time
//! (`x_i' = y_i`, with `y` the last time there was) or in both
//! (`x_i' = y_i + x_(i-1) - y_(i-1)`), whichever leaves the least differences. These are
//! folded to small whole numbers, `d -> 2d, -d -> 2d - 1`; all their low bytes come before
//! all their high ones.

use std::io::Write;

use flate2::{Compression, write::ZlibEncoder};

/// Prediction of codes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Prediction {
    Space,
    Time,
    Both,
}

const PREDICTIONS: [(Prediction, char); 3] = [
    (Prediction::Space, 's'),
    (Prediction::Time, 't'),
    (Prediction::Both, 'b'),
];

/// Codes of a row on which predictions are tried, about.
const SAMPLES: usize = 2000;

/// A block and what is needed to undo the predictions.
#[derive(Clone, Debug, PartialEq)]
pub struct Packed {
    /// The block, deflated.
    pub bytes: Vec<u8>,
    /// A letter for every row: `s`, `t` or `b`.
    pub predictions: String,
}

/// Rows of codes, one a time and component: `rows[time][component]` in one slice a time.
pub fn codes(times: &[&[u16]], components: usize) -> Packed {
    let (mut folded, mut predictions) = (Vec::new(), String::new());
    let mut last: Option<&[u16]> = None;
    for codes in times {
        let length = (codes.len() / components).max(1);
        for (component, row) in codes.chunks(length).enumerate() {
            let before = last.map(|last| &last[component * length..][..row.len()]);
            let known = PREDICTIONS
                .iter()
                .filter(|(p, _)| before.is_some() || *p == Prediction::Space);
            let costs = known.map(|known| (cost(known.0, row, before), known));
            let best = costs.min_by_key(|(cost, _)| *cost);
            let (prediction, letter) = best.map_or(PREDICTIONS[0], |(_, known)| *known);
            predictions.push(letter);
            let differences = (0..row.len()).map(|at| difference(prediction, row, before, at));
            folded.extend(differences);
        }
        last = Some(codes);
    }
    let low = folded.iter().map(|code| code.to_le_bytes()[0]);
    let high = folded.iter().map(|code| code.to_le_bytes()[1]);
    Packed {
        bytes: deflated(&low.chain(high).collect::<Vec<u8>>()),
        predictions,
    }
}

/// Bits that differences take, about; of some of them, evenly spread.
fn cost(prediction: Prediction, row: &[u16], before: Option<&[u16]>) -> u64 {
    let some = (0..row.len()).step_by(row.len() / SAMPLES + 1);
    let bits = some.map(|at| 16 - difference(prediction, row, before, at).leading_zeros());
    bits.map(u64::from).sum()
}

/// Residual of the prediction of a code, folded to a nonnegative number.
fn difference(prediction: Prediction, row: &[u16], before: Option<&[u16]>, at: usize) -> u16 {
    let earlier = |at: usize| before.map_or(0, |before| before[at]);
    let left = |of: &dyn Fn(usize) -> u16| if at > 0 { of(at - 1) } else { 0 };
    let expected = match prediction {
        Prediction::Space => left(&|at| row[at]),
        Prediction::Time => earlier(at),
        Prediction::Both => {
            (earlier(at).wrapping_add(left(&|at| row[at]))).wrapping_sub(left(&earlier))
        }
    };
    folded(row[at].wrapping_sub(expected))
}

fn folded(difference: u16) -> u16 {
    let signed = difference.cast_signed();
    (signed << 1 ^ signed >> 15).cast_unsigned()
}

/// Bytes of whole numbers, each the difference to the one so many places before.
pub fn indices(numbers: &[u32], stride: usize) -> Vec<u8> {
    let before = |at: usize| {
        if at >= stride {
            numbers[at - stride]
        } else {
            0
        }
    };
    let words = numbers.iter().enumerate().map(|(at, number)| {
        let signed = number.wrapping_sub(before(at)).cast_signed();
        (signed << 1 ^ signed >> 31).cast_unsigned().to_le_bytes()
    });
    let words: Vec<[u8; 4]> = words.collect();
    let bytes = (0..4).flat_map(|byte| words.iter().map(move |word| word[byte]));
    deflated(&bytes.collect::<Vec<u8>>())
}

/// Bytes of real numbers in single precision.
pub fn reals(numbers: impl Iterator<Item = f32>) -> Vec<u8> {
    deflated(&numbers.flat_map(f32::to_le_bytes).collect::<Vec<u8>>())
}

fn deflated(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder
        .write_all(bytes)
        .and_then(|()| encoder.finish())
        .expect("writing to memory succeeds")
}

/// Bytes in the letters of base64 (RFC 4648).
pub fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let byte = |at: usize| u32::from(three.get(at).copied().unwrap_or(0));
        let word = byte(0) << 16 | byte(1) << 8 | byte(2);
        for at in 0..4 {
            let letter = LETTERS[(word >> (18 - 6 * at)) as usize & 63];
            text.push(if at > three.len() { '=' } else { letter.into() });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use super::*;

    #[test]
    fn base64_is_that_of_the_standard() {
        for (plain, text) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(base64(plain.as_bytes()), text);
        }
    }

    #[test]
    fn small_differences_fold_to_small_numbers() {
        let found: Vec<u16> = [0, 1, -1, 2, -2, i16::MAX, i16::MIN]
            .map(|d: i16| folded(d.cast_unsigned()))
            .into();
        assert_eq!(found, [0, 2, 1, 4, 3, u16::MAX - 1, u16::MAX]);
    }

    /// Rows that repeat or move as a whole leave nothing to write.
    #[test]
    fn rows_are_predicted_by_what_fits_them_best() {
        let row = |shift: u16| {
            (0..50)
                .map(|i: u16| i.wrapping_mul(7919).wrapping_add(shift))
                .collect::<Vec<u16>>()
        };
        let (first, moved, line) = (row(0), row(9), (0..50).collect::<Vec<u16>>());
        let packed = codes(&[&first, &first, &moved, &line], 1);
        assert_eq!(packed.predictions, "stbs");
        let mut bytes = Vec::new();
        flate2::read::ZlibDecoder::new(&packed.bytes[..])
            .read_to_end(&mut bytes)
            .unwrap();
        assert_eq!(bytes.len(), 400);
        assert_eq!(bytes[50..100], [0; 50]);
        assert_eq!(
            bytes[100..150].iter().filter(|byte| **byte == 0).count(),
            49
        );
    }
}
