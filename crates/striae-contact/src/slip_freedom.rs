//! The directions in which a kept node can slip.

/// Directions in which friction of a kept node is determined.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum SlipFreedom {
    /// In all.
    #[default]
    Plane,
    /// Along a unit vector, by its components along the tangents, and back.
    Line([f64; 2]),
    /// In none.
    Held,
    /// In one or none, but what is prescribed moves the node along another one. So it slips, and its
    /// friction follows from the law.
    Driven,
}

impl SlipFreedom {
    /// The freedom of a node in a model that differs by a small change from one where it has the
    /// freedom `other`: of the same kind, along the same sense of its line.
    ///
    /// A line has no sense of its own, yet the sign of the row of friction goes by it.
    pub(crate) fn like(self, other: Self) -> Self {
        match (self, other) {
            (Self::Line([x, y]), Self::Line([u, v])) if x * u + y * v < 0.0 => Self::Line([-x, -y]),
            (Self::Line(_), Self::Line(_)) => self,
            _ => other,
        }
    }
}
