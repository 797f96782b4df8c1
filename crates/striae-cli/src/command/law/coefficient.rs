//! The coefficient of friction in words.

use striae_declared::Kind;
use striae_law::friction::{DECAY, Friction};

/// `varpi` and what it depends on in words.
pub(super) fn coefficient(friction: &Friction) -> String {
    let mu = friction.coefficient();
    let mut words = format!("mu = {}", mu.at_rest());
    let by_rate = mu.by_rate().statement();
    let decay = by_rate.is_some_and(|stated| stated.law == DECAY.name);
    let fast = mu.at_slip_rate(f64::MAX);
    if decay && fast != mu.at_rest() {
        words += &format!(" at rest and {fast} in fast slip");
    }
    let by_pressure = mu.by_pressure().is_some();
    let by_rate = mu.by_rate().is_some() && !decay;
    let by_slip = mu.by_slip().is_some();
    let by_state = mu.by_state().constants().is_some();
    let healing = mu.by_state().of_healing();
    words += ", varpi = mu";
    words += match (by_rate, by_state) {
        (true, _) => " R(v)",
        (false, true) => "(v, theta)",
        (false, false) => "",
    };
    words += if healing.is_some() { " H" } else { "" };
    words += if by_slip { " W(s)" } else { "" };
    words += if by_pressure { " P(p)" } else { " p" };
    if let Some(cap) = friction.shear_cap() {
        words += &format!(" but at most {cap}");
    }
    if by_rate {
        words += &format!("\n  slip rate: R(v) = {}", mu.by_rate());
    }
    if by_state {
        words += &format!("\n  rate and state: mu(v, theta) = {}", mu.by_state());
    }
    if let Some(healing) = healing {
        words += &format!("\n  slip and time: H = {healing}");
    }
    if by_slip {
        words += &format!("\n  accumulated slip: W(s) = {}", mu.by_slip());
    }
    if by_pressure {
        words += &format!("\n  pressure: P(p) = {}", mu.by_pressure());
    }
    words
}
