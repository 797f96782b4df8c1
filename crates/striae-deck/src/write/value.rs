//! Values as TOML, so that the same bits are read again.

use striae_mesh::Vec3;
use striae_model::Value;

/// A number.
pub(crate) fn number(value: f64) -> String {
    format!("{value:?}")
}

/// A number or a function.
pub(crate) fn varying(value: &Value) -> String {
    match value {
        Value::Number(value) => number(*value),
        Value::Function(function) => text(function.text()),
    }
}

/// A text in quotes.
pub(crate) fn text(value: &str) -> String {
    toml::Value::String(value.to_owned()).to_string()
}

/// A list of what is text already.
pub(crate) fn list(items: impl IntoIterator<Item = String>) -> String {
    let items: Vec<String> = items.into_iter().collect();
    format!("[{}]", items.join(", "))
}

/// A list with a line for each item.
pub(crate) fn lines(items: impl Iterator<Item = String>) -> String {
    let items = items.map(|item| format!("    {item},\n"));
    format!("[\n{}]", items.collect::<String>())
}

/// The components of a vector.
pub(crate) fn vector(value: &Vec3) -> String {
    list([value.x, value.y, value.z].map(number))
}

/// A vector of which the unit vector is `unit`.
pub(crate) fn direction(unit: &Vec3) -> Vec3 {
    let mut multiples = (0..100_000).map(|i| unit * (1.0 + 1e-3 * f64::from(i)));
    multiples
        .find(|multiple| multiple.normalize() == *unit)
        .unwrap_or(*unit)
}

#[cfg(test)]
mod tests {
    use super::{direction, text};
    use striae_mesh::Vec3;

    #[test]
    fn directions_are_read_as_the_same_bits() {
        for i in -3600..3600 {
            let unit = Vec3::new(f64::from(i), 77.7, 0.3 * f64::from(i) - 50.0).normalize();
            assert_eq!(direction(&unit).normalize(), unit, "{i}");
        }
    }

    #[test]
    fn texts_are_in_quotes() {
        for told in ["plain", "with \"quotes\" and \\", "two\nlines", "ϖ"] {
            let table: toml::Table = format!("key = {}", text(told)).parse().unwrap();
            assert_eq!(table["key"].as_str(), Some(told));
        }
    }
}
