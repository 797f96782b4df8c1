//! Numbers in the terms of a deck, so that the same bits are read again.

/// Range, in units in the last place, in which the number that was written is sought around the
/// one that is computed back.
const REACH: i64 = 16;

/// Returns the number near `about` that `read` turns into `value`; `about` if there is none.
pub fn read_as(value: f64, about: f64, read: impl Fn(f64) -> f64) -> f64 {
    let steps = (0..=REACH).flat_map(|far| [far, -far]);
    let mut near = steps.map(|far| f64::from_bits(about.to_bits().wrapping_add_signed(far)));
    near.find(|near| read(*near) == value).unwrap_or(about)
}

/// Returns the degrees of an angle in radians.
pub fn degrees(angle: f64) -> f64 {
    read_as(angle, angle.to_degrees(), f64::to_radians)
}

#[cfg(test)]
mod tests {
    use super::{degrees, read_as};

    #[test]
    fn numbers_in_other_terms_are_read_as_the_same_bits() {
        for i in -3600..3600 {
            let angle = (0.1 * f64::from(i)).to_radians();
            assert_eq!(degrees(angle).to_radians().to_bits(), angle.to_bits());
            let density = (1.0 + f64::from(i).abs()) / 1e4 / 0.37;
            let found = read_as(density, density * 0.37, |mass| mass / 0.37);
            assert_eq!(found / 0.37, density);
        }
    }
}
