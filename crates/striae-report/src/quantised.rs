//! Numbers in 16 bits of their range.

/// The code of what is no number.
const NOTHING: u16 = u16::MAX;

/// Steps between the least and the largest number.
const STEPS: f64 = (u16::MAX - 1) as f64;

/// An array at one time: `least + step code`.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantised {
    /// The least number.
    pub least: f64,
    /// Difference of neighbouring codes; 0 where all numbers are equal.
    pub step: f64,
    /// Codes, component by component.
    pub codes: Vec<u16>,
}

impl Quantised {
    /// Numbers given point by point.
    pub fn new(components: usize, numbers: &[f64]) -> Self {
        let finite = numbers.iter().filter(|number| number.is_finite());
        let (least, largest) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
            (a.min(*v), b.max(*v))
        });
        let (least, step) = if least <= largest {
            (least, (largest - least) / STEPS)
        } else {
            (0.0, 0.0)
        };
        let code = |number: f64| match (number.is_finite(), step > 0.0) {
            (false, _) => NOTHING,
            (_, false) => 0,
            _ => ((number - least) / step).round().min(STEPS) as u16,
        };
        let rows = numbers.len() / components;
        let turned =
            (0..components).flat_map(|c| (0..rows).map(move |row| numbers[row * components + c]));
        Self {
            least,
            step,
            codes: turned.map(code).collect(),
        }
    }

    /// The number of a code; NaN if there is none.
    pub fn number(&self, code: u16) -> f64 {
        match code {
            NOTHING => f64::NAN,
            code => self.least + self.step * f64::from(code),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back_to_half_a_step() {
        let numbers: Vec<f64> = (0..300)
            .map(|i| (f64::from(i) * 0.37).sin() * 1e-7 + 2.0)
            .collect();
        let found = Quantised::new(3, &numbers);
        for (point, numbers) in numbers.chunks(3).enumerate() {
            for (component, number) in numbers.iter().enumerate() {
                let code = found.codes[component * 100 + point];
                let back = found.least + found.step * f64::from(code);
                assert!((back - number).abs() <= 0.51 * found.step);
            }
        }
    }

    #[test]
    fn what_is_equal_and_what_is_no_number_have_their_codes() {
        let found = Quantised::new(1, &[2.5, f64::NAN, 2.5]);
        assert_eq!((found.least, found.step), (2.5, 0.0));
        assert_eq!(found.codes, [0, NOTHING, 0]);
        let none = Quantised::new(1, &[f64::INFINITY]);
        assert_eq!((none.least, none.codes), (0.0, vec![NOTHING]));
    }
}
