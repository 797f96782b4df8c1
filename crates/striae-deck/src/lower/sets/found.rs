//! Members of a set, and what to say where there are none.

/// Members that a definition selects.
pub(super) struct Found<T> {
    pub(super) members: Vec<T>,
    /// Reason why there may be none.
    pub(super) hint: Option<String>,
}

impl<T> From<Vec<T>> for Found<T> {
    fn from(members: Vec<T>) -> Self {
        let hint = None;
        Self { members, hint }
    }
}
