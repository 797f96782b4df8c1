//! File names made from names that users have given.
//!
//! A name may hold what no file name may, such as `/`, or lead out of the folder. What
//! file systems do not take everywhere becomes `%` and the hexadecimal digits of its
//! bytes; of long names the first [`LONGEST`] bytes are left. Of names that come to the same,
//! also where letters count alike whatever their case, later ones end in `~2`, `~3`, ...

use std::collections::BTreeSet;

/// Longest part of a file name that a name may take, in bytes: file systems take 255.
const LONGEST: usize = 80;

/// The names that have been given to files so far.
#[derive(Clone, Debug, Default)]
pub struct Stems(BTreeSet<String>);

impl Stems {
    /// The name of a file, without its ending, for a wanted one.
    pub fn take(&mut self, wanted: &str) -> String {
        let stem = safe(wanted);
        let mut name = stem.clone();
        let mut count = 1;
        while !self.0.insert(name.to_lowercase()) {
            count += 1;
            name = format!("{stem}~{count}");
        }
        name
    }
}

/// The name with what file systems take everywhere.
fn safe(name: &str) -> String {
    let mut safe = String::new();
    for (at, letter) in name.chars().enumerate() {
        let is_refused = letter.is_control() || "/\\:*?\"<>|%".contains(letter);
        let mut bytes = [0; 4];
        let next = match is_refused || (at == 0 && letter == '.') {
            true => {
                let bytes = letter.encode_utf8(&mut bytes).bytes();
                bytes.map(|byte| format!("%{byte:02X}")).collect()
            }
            false => letter.to_string(),
        };
        if safe.len() + next.len() > LONGEST {
            break;
        }
        safe += &next;
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn usual_names_stay_and_others_lead_nowhere() {
        let mut stems = Stems::default();
        for name in ["lower", "contact-pad-floor", "Reifen, außen", "日本", "a b"] {
            assert_eq!(stems.take(name), name);
        }
        assert_eq!(stems.take("../../x"), "%2E.%2F..%2Fx");
        assert_eq!(stems.take("a\nb\0"), "a%0Ab%00");
        assert_eq!(stems.take("50%"), "50%25");
    }

    #[test]
    fn names_that_come_to_the_same_are_told_apart() {
        let mut stems = Stems::default();
        let long = "ü".repeat(200);
        let names = ["pad", "Pad", "pad", &long, &long].map(|name| stems.take(name));
        assert_eq!(names[..3], ["pad", "Pad~2", "pad~3"]);
        assert_eq!(names[3].len(), LONGEST);
        assert_eq!(names[4], format!("{}~2", names[3]));
    }
}
