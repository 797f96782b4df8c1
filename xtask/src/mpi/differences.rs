//! Differences between two histories.

use std::fmt;

use crate::scenes::output::History;

/// Largest difference of a resultant or reaction, over the largest of them, that is none.
pub const FORCES: f64 = 1e-8;
/// Largest difference of the iterations of an increment that is none.
pub const ITERATIONS: f64 = 1.0;

/// Differences between two histories.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Differences {
    /// Of resultants and reactions, over the largest of them.
    pub forces: f64,
    /// Of the iterations of an increment.
    pub iterations: f64,
}

impl Differences {
    /// # Errors
    /// Differences; an error if the histories have other columns or another number of rows.
    pub fn of(one: &History, other: &History) -> Result<Self, String> {
        let is_force = |name: &&str| name.contains(".resultant_") || name.starts_with("reaction.");
        let mut differences = Self {
            forces: 0.0,
            iterations: largest(one, other, "iterations")?.1,
        };
        let mut size: f64 = 0.0;
        for name in one.names().filter(is_force) {
            let (value, difference) = largest(one, other, name)?;
            size = size.max(value);
            differences.forces = differences.forces.max(difference);
        }
        if size == 0.0 {
            return Err("the history has no forces".into());
        }
        differences.forces /= size;
        Ok(differences)
    }

    /// Returns whether the differences are negligible.
    pub fn are_small(&self) -> bool {
        self.forces <= FORCES && self.iterations <= ITERATIONS
    }
}

impl fmt::Display for Differences {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { forces, iterations } = self;
        write!(
            f,
            "forces differ by {forces:.1e}, iterations by {iterations}"
        )
    }
}

/// The largest value and the largest difference of a column.
fn largest(one: &History, other: &History, name: &str) -> Result<(f64, f64), String> {
    let [a, b] = [one, other].map(|history| history.column(name));
    if a.is_empty() || a.len() != b.len() {
        return Err(format!("{} rows of `{name}` for {}", b.len(), a.len()));
    }
    let value = a.iter().fold(0.0, |most: f64, a| most.max(a.abs()));
    if a.iter().chain(&b).any(|number| !number.is_finite()) {
        return Err(format!("`{name}` is not finite"));
    }
    let differences = a.iter().zip(&b).map(|(a, b)| (a - b).abs());
    Ok((value, differences.fold(0.0, f64::max)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn history(rows: &str) -> History {
        let names = "iterations,pair.a.resultant_a.x,reaction.b.y";
        History::of(&format!("{names}\n{rows}")).unwrap()
    }

    #[test]
    fn forces_are_compared_over_the_largest() {
        let alone = history("3,1,-4\n4,2,0\n");
        let differences = Differences::of(&alone, &history("3,1.5,-4\n6,2,0\n")).unwrap();
        assert_eq!(differences.forces, 0.125);
        assert_eq!(differences.iterations, 2.0);
        assert!(!differences.are_small());
        assert!(Differences::of(&alone, &alone).unwrap().are_small());
    }

    #[test]
    fn runs_that_ended_elsewhere_differ() {
        let alone = history("3,1,-4\n4,2,0\n");
        assert!(Differences::of(&alone, &history("3,1,-4\n")).is_err());
        for rows in [
            "3,NaN,-4\n4,2,0\n",
            "3,1,-4\n4,NaN,0\n",
            "3,inf,-4\n4,2,0\n",
        ] {
            assert!(Differences::of(&alone, &history(rows)).is_err(), "{rows}");
        }
        assert!(Differences::of(&history("3,0,0\n"), &history("3,0,0\n")).is_err());
    }
}
