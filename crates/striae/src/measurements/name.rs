//! Names of columns as people write them: in any letters, with a unit in brackets behind.

/// A name and the unit behind it, in small letters.
pub(super) struct Name {
    name: String,
    unit: Option<String>,
}

/// Units of angles.
const DEGREES: [&str; 4] = ["deg", "degree", "degrees", "°"];
/// Units of ratios.
const RATIO: [&str; 3] = ["", "-", "1"];
/// Letters between which a unit stands.
const BRACKETS: [(char, char); 2] = [('(', ')'), ('[', ']')];

impl Name {
    pub(super) fn of(written: &str) -> Self {
        let written = written.trim().to_lowercase();
        let unit = BRACKETS.iter().find_map(|(opening, closing)| {
            let (name, unit) = written.strip_suffix(*closing)?.rsplit_once(*opening)?;
            Some((name.trim().to_owned(), unit.trim().to_owned()))
        });
        match unit {
            Some((name, unit)) => Self {
                name,
                unit: Some(unit),
            },
            None => Self {
                name: written,
                unit: None,
            },
        }
    }

    /// Returns whether it names a quantity; friction is called as its coefficient, too.
    pub(super) fn is(&self, known: &str) -> bool {
        self.name == known || known == "friction" && matches!(self.name.as_str(), "mu" | "µ" | "μ")
    }

    /// The form in which a quantity is needed, if the unit is another one.
    pub(super) fn foreign_unit(&self, known: &str) -> Option<&'static str> {
        let unit = self.unit.as_deref()?;
        match known {
            "angle" | "direction" | "theta" if !DEGREES.contains(&unit) => Some("in degrees"),
            "friction" if !RATIO.contains(&unit) => Some("as a ratio of forces"),
            _ => None,
        }
    }
}

/// Returns whether a name is a quantity but for one letter that is missing, added, wrong or
/// swapped with the next one, or two in long names.
pub(super) fn is_misspelt(name: &str, known: &str) -> bool {
    let name = Name::of(name).name;
    let allowed = if known.len() > 6 { 2 } else { 1 };
    distance(&name, known) <= allowed
}

/// Number of letters to insert, remove, replace or swap, to get from one word to another.
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut rows: Vec<Vec<usize>> = vec![(0..=b.len()).collect()];
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let differs = usize::from(a[i - 1] != b[j - 1]);
            let above = &rows[i - 1];
            let mut least = (above[j - 1] + differs)
                .min(above[j] + 1)
                .min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(rows[i - 2][j - 2] + 1);
            }
            row.push(least);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_any_letters_and_units() {
        for (written, known) in [
            ("Angle (deg)", "angle"),
            ("ANGLE[°]", "angle"),
            ("Friction", "friction"),
            ("Mu [-]", "friction"),
        ] {
            let name = Name::of(written);
            assert!(
                name.is(known) && name.foreign_unit(known).is_none(),
                "{written}"
            );
        }
        assert_eq!(
            Name::of("angle (rad)").foreign_unit("angle"),
            Some("in degrees")
        );
        assert!(Name::of("Friction [%]").foreign_unit("friction").is_some());
        assert!(Name::of("Normal (kN)").foreign_unit("normal").is_none());
        assert!(!Name::of("angle of tilt").is("angle"));
    }

    #[test]
    fn near_words_are_misspelt_and_far_ones_others() {
        for (name, known) in [
            ("tangental", "tangential"),
            ("Agnle", "angle"),
            ("frction", "friction"),
        ] {
            assert!(is_misspelt(name, known), "{name}");
        }
        for (name, known) in [
            ("panel", "angle"),
            ("Winkel", "angle"),
            ("force", "friction"),
        ] {
            assert!(!is_misspelt(name, known), "{name}");
        }
    }
}
