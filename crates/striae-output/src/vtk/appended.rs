//! The appended section: compressed arrays one after the other.
//!
//! One array is a header of `UInt64` numbers followed by its blocks,
//!
//! ```text
//! blocks | bytes of a full block | bytes of a partial last block, or 0 | compressed bytes of block 1 | ...
//! ```
//!
//! each block being a zlib stream of its own.

use std::io::Write;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use striae_mesh::Vec3;

use super::Values;

/// Uncompressed bytes of a full block.
const BLOCK: usize = 1 << 18;

/// Arrays collected so far.
#[derive(Default)]
pub(super) struct Appended {
    /// Content of the section after its leading underscore.
    pub bytes: Vec<u8>,
}

impl Appended {
    /// Appends one array and says at which offset it starts.
    pub fn push(&mut self, raw: &[u8]) -> usize {
        let offset = self.bytes.len();
        let blocks: Vec<Vec<u8>> = raw.chunks(BLOCK).map(compressed).collect();
        let header = [blocks.len(), BLOCK, raw.len() % BLOCK];
        for number in header.into_iter().chain(blocks.iter().map(Vec::len)) {
            self.bytes.extend((number as u64).to_le_bytes());
        }
        self.bytes.extend(blocks.into_iter().flatten());
        offset
    }
}

fn compressed(block: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    encoder
        .write_all(block)
        .and_then(|()| encoder.finish())
        .expect("writing to memory succeeds")
}

/// Little-endian bytes of vectors, x y z.
pub(super) fn vector_bytes(vectors: &[Vec3]) -> Vec<u8> {
    real_bytes(vectors.iter().flat_map(|v| [v.x, v.y, v.z]))
}

/// Little-endian bytes of an array's values.
pub(super) fn value_bytes(values: &Values) -> Vec<u8> {
    match values {
        Values::Scalars(values) => real_bytes(values.iter().copied()),
        Values::Vectors(values) => vector_bytes(values),
        Values::SymmetricTensors(values) => real_bytes(values.iter().flat_map(|t| {
            [
                t[(0, 0)],
                t[(1, 1)],
                t[(2, 2)],
                t[(0, 1)],
                t[(1, 2)],
                t[(0, 2)],
            ]
        })),
        Values::Tensors(values) => real_bytes(
            values
                .iter()
                .flat_map(|t| std::array::from_fn::<f64, 9, _>(|entry| t[(entry / 3, entry % 3)])),
        ),
        Values::Integers(values) => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
        Values::Codes(values) => values.clone(),
    }
}

fn real_bytes(numbers: impl Iterator<Item = f64>) -> Vec<u8> {
    numbers.flat_map(f64::to_le_bytes).collect()
}
