//! Positions of triples in a list.
//!
//! Derivatives are lists of blocks by [triple](crate::unknown), in any order. Summing such
//! lists asks for each triple where it is in the sum, if it is there. A table over all
//! triples answers at once. Each thread keeps one table; entries carry the number of the
//! list that they were made for, so that no list has to clear those of the last.

use std::cell::Cell;

use nalgebra::Matrix3;

use crate::unknown::Jacobian;

/// Places of triples, by their first unknowns, in a list of at most `u32::MAX` entries.
#[derive(Debug, Default)]
pub struct Places(Table);

/// Number of the list and place in it, for every triple.
#[derive(Debug, Default)]
struct Table {
    list: u32,
    entries: Vec<(u32, u32)>,
}

thread_local! {
    static SPARE: Cell<Table> = Cell::default();
}

impl Places {
    /// Places of an empty list.
    pub fn none() -> Self {
        let mut table = SPARE.take();
        if table.list == u32::MAX {
            table = Table::default();
        }
        table.list += 1;
        Self(table)
    }

    /// Places of a list of distinct triples.
    pub fn of(triples: impl Iterator<Item = u32>) -> Self {
        let mut places = Self::none();
        for (at, first) in triples.enumerate() {
            places.find(first, at);
        }
        places
    }

    /// Place of a triple; `next` from now on if it had none.
    pub fn find(&mut self, first: u32, next: usize) -> usize {
        let Table { list, entries } = &mut self.0;
        let triple = first as usize / 3;
        if triple >= entries.len() {
            entries.resize(triple + 1, (0, 0));
        }
        let (of, place) = &mut entries[triple];
        if of != list {
            (*of, *place) = (*list, next as u32);
        }
        *place as usize
    }
}

impl Drop for Places {
    fn drop(&mut self) {
        SPARE.set(std::mem::take(&mut self.0));
    }
}

/// A Jacobian that derivatives are added to.
#[derive(Debug)]
pub struct ChainedSum<'a> {
    places: Places,
    jacobian: &'a mut Jacobian,
}

impl<'a> ChainedSum<'a> {
    /// Starts from what there is.
    pub fn onto(jacobian: &'a mut Jacobian) -> Self {
        let places = Places::of(jacobian.iter().map(|entry| entry.0));
        Self { places, jacobian }
    }

    /// Adds `by v`, `v` an intermediate vector.
    pub fn add(&mut self, by: &Matrix3<f64>, inner: &Jacobian) {
        for (first, block) in inner {
            let next = self.jacobian.len();
            let at = self.places.find(*first, next);
            if at == next {
                self.jacobian.push((*first, by * block));
            } else {
                self.jacobian[at].1 += by * block;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_knows_nothing_of_the_one_before() {
        let mut first = Places::of([6, 0, 30].into_iter());
        assert_eq!([30, 6, 0].map(|triple| first.find(triple, 9)), [2, 0, 1]);
        assert_eq!(first.find(300, 3), 3);
        let mut within = Places::none();
        assert_eq!(within.find(6, 7), 7);
        drop(within);
        assert_eq!(first.find(6, 9), 0);
        drop(first);
        assert_eq!(Places::none().find(6, 5), 5);
    }

    #[test]
    fn chained_sums_add_up_by_triple() {
        let unit = Matrix3::<f64>::identity();
        let mut sum = vec![(3, unit), (0, unit)];
        let mut chained = ChainedSum::onto(&mut sum);
        chained.add(&(unit * 2.0), &vec![(0, unit), (12, unit)]);
        chained.add(&(unit * 4.0), &vec![(12, unit), (3, unit * 0.5)]);
        assert_eq!(
            sum,
            vec![(3, unit * 3.0), (0, unit * 3.0), (12, unit * 6.0)]
        );
    }
}
