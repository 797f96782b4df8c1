//! Damage to files of a run.

/// A file with a fault, and what `resume` has to say of it.
pub type Damage = (&'static str, fn(&[u8]) -> Vec<u8>, &'static str);

/// Damages, applied one at a time.
pub const DAMAGES: [Damage; 6] = [
    ("history.csv", first_half, "history.csv"),
    ("history.csv", with_another_digit, "history.csv"),
    ("checkpoint.bin", first_half, "checkpoint.bin"),
    ("checkpoint.bin", with_another_digit, "checkpoint.bin"),
    ("fields/pad-00005.vtu", first_half, "pad-00005.vtu"),
    ("fields/pad-00005.vtu", with_another_digit, "pad-00005.vtu"),
];

fn first_half(bytes: &[u8]) -> Vec<u8> {
    bytes[..bytes.len() / 2].to_vec()
}

/// The last digit before the middle becomes another one; without digits, a byte does.
fn with_another_digit(bytes: &[u8]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    let middle = bytes.len() / 2;
    let digit = bytes[..middle].iter().rposition(u8::is_ascii_digit);
    let at = digit.unwrap_or(middle);
    bytes[at] ^= 1;
    bytes
}
