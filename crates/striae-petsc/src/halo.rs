//! Blocks of unknowns that other ranks own and rows of this rank name.
//!
//! Vectors have this rank's own blocks first, then those of others.

use crate::{
    binding::{Library, Scatter, Side, Sum},
    error::Error,
};
use std::sync::Arc;

/// Blocks of others.
#[derive(Debug)]
pub(crate) struct Halo {
    side: Side,
    /// Their numbers, rising.
    others: Vec<u32>,
    scatter: Scatter,
    /// Values of own blocks and of others.
    own: Vec<f64>,
    theirs: Vec<f64>,
}

impl Halo {
    /// With the blocks that are named, in any order. Collective.
    pub(crate) fn new(
        library: &Arc<Library>,
        side: Side,
        named: impl Iterator<Item = u32>,
    ) -> Result<Self, Error> {
        let mut others: Vec<u32> = named.filter(|&block| !side.contains(block)).collect();
        others.sort_unstable();
        others.dedup();
        let size = side.size as u32;
        let wanted = others
            .iter()
            .flat_map(|&block| size * block..size * (block + 1));
        let wanted: Vec<u32> = wanted.collect();
        Ok(Self {
            scatter: Scatter::new(library, side.unknowns(), &wanted)?,
            own: vec![0.0; side.unknowns().own],
            theirs: vec![0.0; wanted.len()],
            side,
            others,
        })
    }

    /// Numbers of others' blocks, rising.
    pub(crate) fn others(&self) -> &[u32] {
        &self.others
    }

    /// Own unknowns.
    pub(crate) fn own(&self) -> usize {
        self.own.len()
    }

    /// Blocks of a vector.
    pub(crate) fn blocks(&self) -> usize {
        self.side.blocks.own + self.others.len()
    }

    /// Place of a block in a vector.
    pub(crate) fn place(&self, block: u32) -> usize {
        match self.side.contains(block) {
            true => block as usize - self.side.blocks.first,
            false => self.side.blocks.own + self.others.partition_point(|&other| other < block),
        }
    }

    /// Number of the block in a place.
    pub(crate) fn number(&self, place: usize) -> u32 {
        match place.checked_sub(self.side.blocks.own) {
            Some(other) => self.others[other],
            None => (self.side.blocks.first + place) as u32,
        }
    }

    /// Puts the values of others in their places.
    pub(crate) fn fetch(&mut self, x: &mut [f32]) -> Result<(), Error> {
        let (own, theirs) = x.split_at_mut(self.own.len());
        widen(own, &mut self.own);
        self.scatter.fetch(&self.own, &mut self.theirs)?;
        narrow(&self.theirs, theirs);
        Ok(())
    }

    /// Adds what stands in the places of others to their own values.
    pub(crate) fn bring(&mut self, x: &mut [f32]) -> Result<(), Error> {
        let (own, theirs) = x.split_at_mut(self.own.len());
        widen(own, &mut self.own);
        widen(theirs, &mut self.theirs);
        self.scatter
            .bring(&self.theirs, &mut self.own, Sum::Added)?;
        narrow(&self.own, own);
        Ok(())
    }
}

/// `wide = x`.
pub(crate) fn widen(x: &[f32], wide: &mut [f64]) {
    wide.iter_mut()
        .zip(x)
        .for_each(|(wide, &x)| *wide = f64::from(x));
}

/// `x = wide`, rounded.
pub(crate) fn narrow(wide: &[f64], x: &mut [f32]) {
    x.iter_mut()
        .zip(wide)
        .for_each(|(x, &wide)| *x = wide as f32);
}
