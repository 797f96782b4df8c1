//! Bytes of files that decks and their authors name.

use std::io::{Error, ErrorKind};
use std::path::Path;

/// Mark of some editors at the beginning of texts in UTF-8.
const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

/// Reads a whole file, without the byte-order mark of a text.
///
/// # Errors
/// Where the operating system refuses, and for what is no file: folders, devices, which may have
/// no end, and pipes, which may never begin, unless a shell hands them over.
pub fn content(path: &Path) -> Result<Vec<u8>, Error> {
    if !std::fs::metadata(path)?.is_file() && !is_handed_over(path) {
        return Err(Error::new(ErrorKind::InvalidInput, "it is not a file"));
    }
    let mut bytes = std::fs::read(path)?;
    if bytes.starts_with(BYTE_ORDER_MARK) {
        bytes.drain(..BYTE_ORDER_MARK.len());
    }
    Ok(bytes)
}

/// Returns whether a path is that of an open stream: `/dev/stdin`, or `/dev/fd/63` of `<(...)`.
fn is_handed_over(path: &Path) -> bool {
    path == Path::new("/dev/stdin") || path.starts_with("/dev/fd")
}

#[cfg(test)]
mod tests {
    use super::content;
    use std::path::Path;

    #[test]
    fn byte_order_marks_are_left_out_and_what_is_no_file_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.txt");
        for (written, read) in [("\u{feff}solid", "solid"), ("solid", "solid"), ("", "")] {
            std::fs::write(&file, written).unwrap();
            assert_eq!(content(&file).unwrap(), read.as_bytes());
        }
        let mut others = vec![folder.path()];
        if cfg!(unix) {
            others.push(Path::new("/dev/zero"));
        }
        for path in others {
            let refused = content(path).unwrap_err().to_string();
            assert_eq!(refused, "it is not a file");
        }
    }
}
