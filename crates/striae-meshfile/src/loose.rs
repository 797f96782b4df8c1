//! Elements of lower dimension that are left out.

/// Numbers of elements of lower dimension in no set, by dimension.
#[derive(Default)]
pub(super) struct Loose([usize; 3]);

impl Loose {
    /// Counts elements of a dimension.
    pub(super) fn count(&mut self, dimension: usize, more: usize) {
        self.0[dimension] += more;
    }

    /// Note about them, if there are any.
    pub(super) fn note(&self) -> Option<String> {
        let [points, lines, surfaces] = self.0;
        let words = [
            (surfaces, "surface element"),
            (lines, "line"),
            (points, "point"),
        ];
        let words = words.into_iter().filter(|(count, _)| *count > 0);
        let words = words.map(|(count, one)| match count {
            1 => format!("1 {one}"),
            _ => format!("{count} {one}s"),
        });
        let words: Vec<String> = words.collect();
        let (last, others) = words.split_last()?;
        let all = match others.len() {
            0 => last.clone(),
            _ => format!("{} and {last}", others.join(", ")),
        };
        Some(format!("in no set and left out: {all}"))
    }
}
