//! Interface by which the holder of some rows of a level exchanges values with the holders of the
//! others.

/// Holders of the other rows.
///
/// Vectors of a level list this part's own nodes first, then those of others that its rows refer
/// to; so do vectors of the next level.
pub trait Others {
    /// Puts the values that others' nodes have in their places.
    fn fetch(&mut self, x: &mut [f32]);

    /// Fetches the values of others' nodes on the next level.
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
