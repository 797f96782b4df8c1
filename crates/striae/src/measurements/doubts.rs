//! Notes on numbers that are possible and yet seldom meant.

use std::f64::consts::TAU;

use super::header::Row;

/// Friction over the median of all beyond which it is doubted.
const OUTLYING: f64 = 10.0;
/// Most lines that a note names.
const MOST_LINES: usize = 4;

/// Notes on the rows of a file.
pub(super) fn doubts(rows: &[Row]) -> Vec<String> {
    [negative(rows), outlying(rows), radians(rows)]
        .into_iter()
        .flatten()
        .collect()
}

fn negative(rows: &[Row]) -> Option<String> {
    let lines = lines(rows, |row| row.friction < 0.0)?;
    Some(format!(
        "negative friction, which would drive the slip: {lines}; correct the sign, or an offset of the force"
    ))
}

fn outlying(rows: &[Row]) -> Option<String> {
    let mut sizes: Vec<f64> = rows.iter().map(|row| row.friction.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let median = *sizes.get(sizes.len() / 2)?;
    let lines = lines(rows, |row| {
        median > 0.0 && row.friction.abs() > OUTLYING * median
    })?;
    Some(format!(
        "friction of more than {OUTLYING} times the median {median:.4}: {lines}; is it in percent, or a misprint?"
    ))
}

fn radians(rows: &[Row]) -> Option<String> {
    let angles = || rows.iter().map(|row| row.angle.abs());
    let largest = angles().fold(0.0, f64::max);
    let is_part = |angle: f64| angle.fract() != 0.0;
    (largest > 1.0 && largest <= 1.001 * TAU && angles().any(is_part)).then(|| {
        format!("all angles are within {largest:.4} degrees; are they in radians? Convert them to degrees")
    })
}

/// Lines of such rows with their friction, in words.
fn lines(rows: &[Row], is_one: impl Fn(&Row) -> bool) -> Option<String> {
    let such: Vec<&Row> = rows.iter().filter(|row| is_one(row)).collect();
    let named = such.iter().take(MOST_LINES);
    let mut named: Vec<String> = named
        .map(|row| format!("{} in line {}", row.friction, row.line))
        .collect();
    if such.len() > MOST_LINES {
        named.push(format!("and {} more", such.len() - MOST_LINES));
    }
    (!named.is_empty()).then(|| named.join(", "))
}
