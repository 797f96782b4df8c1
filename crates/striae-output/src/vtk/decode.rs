//! A reader of our own files, written from the format's description alone.

use std::io::Read;

/// One array as it stands in a file.
pub struct Decoded {
    pub number: String,
    pub components: usize,
    pub bytes: Vec<u8>,
}

/// The array called `name`, decompressed.
pub fn array(file: &[u8], name: &str) -> Decoded {
    let start = b"<AppendedData encoding=\"raw\">\n   _";
    let at = file
        .windows(start.len())
        .position(|window| window == start)
        .unwrap();
    let text = std::str::from_utf8(&file[..at]).unwrap();
    let tag = text
        .lines()
        .find(|line| line.contains(&format!("Name=\"{name}\"")))
        .unwrap();
    let offset: usize = attribute(tag, "offset").parse().unwrap();
    Decoded {
        number: attribute(tag, "type").to_owned(),
        components: attribute(tag, "NumberOfComponents").parse().unwrap(),
        bytes: inflated(&file[at + start.len() + offset..]),
    }
}

/// The value of an attribute of an XML tag.
pub fn attribute<'a>(tag: &'a str, name: &str) -> &'a str {
    let after = tag.split_once(&format!(" {name}=\"")).unwrap().1;
    after.split_once('"').unwrap().0
}

impl Decoded {
    /// The array as real numbers.
    pub fn reals(&self) -> Vec<f64> {
        assert_eq!(self.number, "Float64");
        let chunks = self.bytes.chunks_exact(8);
        chunks
            .map(|chunk| f64::from_le_bytes(chunk.try_into().unwrap()))
            .collect()
    }

    /// The array as whole numbers.
    pub fn integers(&self) -> Vec<i64> {
        let chunks = |size| self.bytes.chunks_exact(size);
        match self.number.as_str() {
            "Int64" => chunks(8)
                .map(|c| i64::from_le_bytes(c.try_into().unwrap()))
                .collect(),
            "Int32" => chunks(4)
                .map(|c| i32::from_le_bytes(c.try_into().unwrap()).into())
                .collect(),
            "UInt8" => self.bytes.iter().map(|&b| b.into()).collect(),
            other => panic!("not whole numbers: {other}"),
        }
    }
}

fn inflated(section: &[u8]) -> Vec<u8> {
    let word =
        |index: usize| u64::from_le_bytes(section[8 * index..8 * index + 8].try_into().unwrap());
    let (blocks, full, last) = (word(0) as usize, word(1) as usize, word(2) as usize);
    let mut at = 8 * (3 + blocks);
    let mut bytes = Vec::new();
    for block in 0..blocks {
        let length = word(3 + block) as usize;
        let before = bytes.len();
        flate2::read::ZlibDecoder::new(&section[at..at + length])
            .read_to_end(&mut bytes)
            .unwrap();
        let expected = if block + 1 == blocks && last > 0 {
            last
        } else {
            full
        };
        assert_eq!(bytes.len() - before, expected);
        at += length;
    }
    bytes
}
