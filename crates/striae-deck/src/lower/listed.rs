//! The elements of a list that are known, and where they are written.

use crate::{faults::Span, read::At};

/// Elements that could be lowered, in their order.
pub(super) struct Listed<T> {
    pub(super) items: Vec<T>,
    /// Locations of each of them.
    pub(super) spans: Vec<Span>,
    written: usize,
}

impl<T> Listed<T> {
    /// Lowers every element; those with faults are left out.
    pub(super) fn new<R>(raw: &[At<R>], mut lower: impl FnMut(&At<R>) -> Option<T>) -> Self {
        let known = raw
            .iter()
            .filter_map(|raw| Some((lower(raw)?, raw.span.clone())));
        let (items, spans) = known.unzip();
        Self {
            items,
            spans,
            written: raw.len(),
        }
    }

    /// Returns whether every element is known.
    pub(super) fn whole(&self) -> bool {
        self.items.len() == self.written
    }

    /// Appends another list.
    pub(super) fn and(mut self, other: Self) -> Self {
        self.items.extend(other.items);
        self.spans.extend(other.spans);
        self.written += other.written;
        self
    }
}
