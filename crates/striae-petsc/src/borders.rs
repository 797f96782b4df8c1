//! Unknowns of a part that belong to other ranks.

use crate::{
    binding::{Lay, Library, Scatter, Sum},
    error::Error,
};
use std::sync::Arc;
use striae_condensed::{Numbering, Tangent};

/// Unknowns of a part that this rank owns, and unknowns whose values come from others.
#[derive(Debug)]
pub(crate) struct Borders {
    /// Unknown of the part of each of this rank's own.
    pub(crate) own: Vec<u32>,
    /// Unknowns that are others'.
    pub(crate) others: Vec<u32>,
    scatter: Scatter,
    /// Values of `others`.
    buffer: Vec<f64>,
}

impl Borders {
    /// With all unknowns that are others'; `None` where an own one is missing.
    pub(crate) fn new(library: &Arc<Library>, numbering: &Numbering) -> Result<Self, Error> {
        let mut own = vec![0; numbering.own.len()];
        let mut others = Vec::new();
        for (unknown, whole) in (0..).zip(&numbering.whole) {
            match numbering.own.contains(whole) {
                true => own[whole - numbering.own.start] = unknown,
                false => others.push(unknown),
            }
        }
        Self::with(library, numbering, own, others)
    }

    /// With those only that a tangent has entries for.
    pub(crate) fn touched(
        &self,
        library: &Arc<Library>,
        numbering: &Numbering,
        tangent: &Tangent,
    ) -> Result<Self, Error> {
        let count = numbering.whole.len();
        let mut is_touched = vec![false; count];
        for row in 0..count {
            for (column, _) in tangent.row(row).filter(|entry| entry.1 != 0.0) {
                (is_touched[row], is_touched[column]) = (true, true);
            }
        }
        let others = self.others.iter().copied();
        let others = others.filter(|&unknown| is_touched[unknown as usize]);
        Self::with(library, numbering, self.own.clone(), others.collect())
    }

    fn with(
        library: &Arc<Library>,
        numbering: &Numbering,
        own: Vec<u32>,
        others: Vec<u32>,
    ) -> Result<Self, Error> {
        let wanted = others.iter().map(|&u| numbering.whole[u as usize] as u32);
        let wanted: Vec<u32> = wanted.collect();
        Ok(Self {
            scatter: Scatter::new(library, lay(numbering), &wanted)?,
            buffer: vec![0.0; others.len()],
            own,
            others,
        })
    }

    /// Values of own unknowns to all ranks that have them in their parts.
    pub(crate) fn spread(&mut self, own: &[f64], part: &mut [f64]) -> Result<(), Error> {
        self.scatter.fetch(own, &mut self.buffer)?;
        for (&unknown, value) in self.own.iter().zip(own) {
            part[unknown as usize] = *value;
        }
        for (&unknown, value) in self.others.iter().zip(&self.buffer) {
            part[unknown as usize] = *value;
        }
        Ok(())
    }

    /// Values of parts to who owns the unknowns.
    pub(crate) fn collect(&mut self, part: &[f64], own: &mut [f64], sum: Sum) -> Result<(), Error> {
        for (value, &unknown) in own.iter_mut().zip(&self.own) {
            *value = part[unknown as usize];
        }
        for (value, &unknown) in self.buffer.iter_mut().zip(&self.others) {
            *value = part[unknown as usize];
        }
        self.scatter.bring(&self.buffer, own, sum)
    }

    /// Combines shared values and returns the result to all ranks.
    pub(crate) fn join(&mut self, part: &mut [f64], sum: Sum) -> Result<(), Error> {
        let mut own = vec![0.0; self.own.len()];
        self.collect(part, &mut own, sum)?;
        self.spread(&own, part)
    }
}

/// Layout of vectors of the whole system.
pub(crate) fn lay(numbering: &Numbering) -> Lay {
    Lay {
        first: numbering.own.start,
        own: numbering.own.len(),
        total: numbering.count,
    }
}
