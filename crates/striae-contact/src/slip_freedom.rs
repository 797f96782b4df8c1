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
