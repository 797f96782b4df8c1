//! Ticks of an axis, and their labels.

/// The ticks of an axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Ticks {
    /// Numbers with a label.
    pub major: Vec<(f64, String)>,
    /// Numbers without.
    pub minor: Vec<f64>,
    /// Labels are to be multiplied by ten to this power.
    pub exponent: i32,
}

/// At most `count` round numbers from `first` to `last`.
pub(super) fn linear(first: f64, last: f64, count: usize) -> Ticks {
    let span = (last - first).abs();
    let step = round_step(span / count.max(1) as f64);
    let from = (first.min(last) / step - 1e-9).ceil() as i64;
    let to = (first.max(last) / step + 1e-9).floor() as i64;
    let largest = first.abs().max(last.abs());
    let exponent = if (1e-2..1e4).contains(&largest) {
        0
    } else {
        (largest * 1.000_001).log10().floor() as i32
    };
    let unit = 10_f64.powi(exponent);
    let scaled = step / unit;
    let decimals = (0..12)
        .find(|&d| {
            let shifted = scaled * 10_f64.powi(d);
            (shifted - shifted.round()).abs() < 1e-6 * shifted
        })
        .unwrap_or(12) as usize;
    let major = (from..=to)
        .map(|multiple| {
            let number = multiple as f64 * step;
            (number, signed(format!("{:.decimals$}", number / unit)))
        })
        .collect();
    Ticks {
        major,
        minor: Vec::new(),
        exponent,
    }
}

/// Powers of ten, with 2 and 5 between them where there are few.
pub(super) fn logarithmic(first: f64, last: f64, count: usize) -> Ticks {
    let (low, high) = (first.min(last), first.max(last));
    let inside = |number: &f64| *number >= low * (1.0 - 1e-9) && *number <= high * (1.0 + 1e-9);
    let (from, to) = (low.log10().floor() as i32, high.log10().ceil() as i32);
    let multiples = |digits: &[i32]| -> Vec<(i32, i32)> {
        (from..=to)
            .flat_map(|power| digits.iter().map(move |&digit| (digit, power)))
            .filter(|&(digit, power)| inside(&(f64::from(digit) * 10_f64.powi(power))))
            .collect()
    };
    let decades = multiples(&[1]);
    let stride = decades.len().div_ceil(count.max(1)) as i32;
    let between = if stride > 1 {
        decades.clone()
    } else {
        multiples(&[2, 3, 4, 5, 6, 7, 8, 9])
    };
    let labelled = if decades.len() >= 3 {
        decades
            .into_iter()
            .filter(|(_, power)| power % stride == 0)
            .collect()
    } else {
        [&[1, 2, 3, 4, 5, 6, 8][..], &[1, 2, 5], &[1, 3], &[1]]
            .into_iter()
            .map(multiples)
            .find(|labels| labels.len() <= count.max(2))
            .unwrap_or(decades)
    };
    let number = |&(digit, power): &(i32, i32)| f64::from(digit) * 10_f64.powi(power);
    let plain = labelled
        .iter()
        .all(|label| (1e-3..1e4).contains(&number(label)));
    let major = labelled
        .iter()
        .map(|label| (number(label), power_label(*label, plain)))
        .collect();
    Ticks {
        major,
        minor: between.iter().map(number).collect(),
        exponent: 0,
    }
}

/// Ten to a power, with raised digits.
pub(super) fn power_of_ten(power: i32) -> String {
    let raised = power
        .to_string()
        .chars()
        .map(|letter| match letter {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            digit => char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).unwrap_or(digit),
        })
        .collect::<String>();
    format!("10{raised}")
}

/// A round number in words.
pub(super) fn round_words(number: f64) -> String {
    let power = (number.abs() * 1.000_001).log10().floor() as i32;
    let digit = (number / 10_f64.powi(power)).round() as i32;
    power_label((digit, power), (1e-3..1e4).contains(&number))
}

/// The largest of 1, 2 and 5 times a power of ten not above `number`.
pub(super) fn round_below(number: f64) -> f64 {
    let power = 10_f64.powf(number.log10().floor());
    let factor = [5.0, 2.0, 1.0]
        .into_iter()
        .find(|f| f * power <= number * (1.0 + 1e-9));
    factor.unwrap_or(1.0) * power
}

fn round_step(least: f64) -> f64 {
    let power = 10_f64.powf(least.log10().floor());
    let factor = [1.0, 2.0, 2.5, 5.0, 10.0]
        .into_iter()
        .find(|f| f * power >= least * (1.0 - 1e-9));
    factor.unwrap_or(10.0) * power
}

fn power_label((digit, power): (i32, i32), plain: bool) -> String {
    if plain {
        let decimals = (-power).max(0) as usize;
        format!("{:.decimals$}", f64::from(digit) * 10_f64.powi(power))
    } else if digit == 1 {
        power_of_ten(power)
    } else {
        format!("{digit}·{}", power_of_ten(power))
    }
}

/// A number with a true minus sign; zero has none.
pub(super) fn signed(number: String) -> String {
    if number
        .trim_start_matches('-')
        .chars()
        .all(|c| c == '0' || c == '.')
    {
        number.trim_start_matches('-').to_owned()
    } else {
        number.replace('-', "−")
    }
}
