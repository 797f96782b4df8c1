//! Names that are looked up, with suggestions.

/// The most similar of the names, if one is similar at all; `b-a` before all others for `a-b`.
pub fn nearest<'n>(name: &str, known: impl IntoIterator<Item = &'n str>) -> Option<String> {
    let similarity = |known: &str| match is_turned(name, known) {
        true => f64::INFINITY,
        false => strsim::jaro_winkler(&name.to_lowercase(), known),
    };
    known
        .into_iter()
        .map(|known| (similarity(known), known))
        .filter(|(similarity, _)| *similarity > 0.75)
        .max_by(|(a, _), (b, _)| a.total_cmp(b))
        .map(|(_, known)| known.to_owned())
}

/// Returns whether two names have the same two parts in the other order.
fn is_turned(name: &str, known: &str) -> bool {
    let mut hyphens = name.match_indices('-').map(|(at, _)| at);
    hyphens.any(|at| {
        let (first, second) = (&name[..at], &name[at + 1..]);
        let rest = known.strip_prefix(second);
        rest.and_then(|rest| rest.strip_prefix('-')) == Some(first)
    })
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn names_of_two_parts_are_found_in_either_order() {
        let known = ["lo-floor", "lo-lo", "lo-up", "up-floor", "up-up"];
        assert_eq!(nearest("up-lo", known).as_deref(), Some("lo-up"));
        assert_eq!(nearest("up-flor", known).as_deref(), Some("up-floor"));
        assert_eq!(nearest("x-y-z", ["x-z", "z-x-y"]).as_deref(), Some("z-x-y"));
        assert_eq!(nearest("nothing", known), None);
    }
}
