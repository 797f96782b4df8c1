//! What the holder of some rows of a level asks of those who hold the others.

/// Who holds the other rows.
///
/// Vectors of a level have this part's own nodes first, then those of others that its rows
/// name; vectors of the next level alike.
pub trait Others {
    /// Puts the values that others' nodes have in their places.
    fn fetch(&mut self, x: &mut [f32]);

    /// The same on the next level.
    fn fetch_coarse(&mut self, x: &mut [f32]);

    /// Adds what stands in the places of others on the next level to their own values.
    fn bring_coarse(&mut self, x: &mut [f32]);
}

/// All rows are here.
pub(crate) struct Nobody;

impl Others for Nobody {
    fn fetch(&mut self, _: &mut [f32]) {}

    fn fetch_coarse(&mut self, _: &mut [f32]) {}

    fn bring_coarse(&mut self, _: &mut [f32]) {}
}

/// Adds a number up over all parts.
pub type Sum<'a> = &'a dyn Fn(f64) -> f64;
