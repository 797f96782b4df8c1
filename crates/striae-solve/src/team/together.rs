//! Ranks that are threads of one process.

use std::{
    fmt,
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError},
    thread,
};

use rayon::ThreadPoolBuilder;

use super::Team;

/// One of several ranks that are threads of one process: what runs on a cluster, tried on one
/// machine without any library.
#[derive(Clone)]
pub struct Together {
    rank: usize,
    size: usize,
    table: Arc<Table>,
}

/// Table on which the ranks place their contributions.
struct Table {
    round: Mutex<Round>,
    complete: Condvar,
}

/// Parcels given since the last complete round.
struct Round {
    number: u64,
    given: Vec<Option<Parcel>>,
    /// All parcels of the round before.
    last: Arc<Vec<Parcel>>,
    is_broken: bool,
}

/// Contribution of a rank.
#[derive(Debug)]
enum Parcel {
    Bytes(Vec<u8>),
    Exchanged(Vec<Vec<f64>>),
    Summed(Vec<f64>),
    Compared(Vec<f64>),
}

impl fmt::Debug for Together {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "rank {} of {}", self.rank, self.size)
    }
}

impl Together {
    /// Does the same work on so many ranks, each on a thread of its own with its own pool of
    /// one thread, and returns what each made of it.
    ///
    /// # Panics
    /// When one of them does; the others then end with it.
    pub fn run<T: Send>(size: usize, work: impl Fn(Arc<dyn Team>) -> T + Sync) -> Vec<T> {
        let table = Arc::new(Table::new(size));
        let on_rank = |rank: usize| {
            let table = Arc::clone(&table);
            let team = Arc::new(Self { rank, size, table });
            let pool = ThreadPoolBuilder::new().num_threads(1).build();
            let pool = pool.expect("a thread for a rank");
            let done = catch_unwind(AssertUnwindSafe(|| {
                pool.install(|| work(Arc::clone(&team) as Arc<dyn Team>))
            }));
            if done.is_err() {
                team.table.break_off();
            }
            done
        };
        let results: Vec<thread::Result<T>> = thread::scope(|scope| {
            let ranks = (0..size).map(|rank| scope.spawn(move || on_rank(rank)));
            let ranks: Vec<_> = ranks.collect();
            let ends = ranks
                .into_iter()
                .map(|rank| rank.join().and_then(|end| end));
            ends.collect()
        });
        let of_rank = |result: thread::Result<T>| result.unwrap_or_else(|said| resume_unwind(said));
        results.into_iter().map(of_rank).collect()
    }

    /// Contributions of all ranks.
    fn all(&self, own: Parcel) -> Arc<Vec<Parcel>> {
        self.table.all(self.rank, own)
    }
}

impl Table {
    fn new(size: usize) -> Self {
        Self {
            round: Mutex::new(Round {
                number: 0,
                given: (0..size).map(|_| None).collect(),
                last: Arc::default(),
                is_broken: false,
            }),
            complete: Condvar::new(),
        }
    }

    fn round(&self) -> MutexGuard<'_, Round> {
        self.round.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn all(&self, rank: usize, own: Parcel) -> Arc<Vec<Parcel>> {
        let mut round = self.round();
        let number = round.number;
        round.given[rank] = Some(own);
        if round.given.iter().all(Option::is_some) {
            let given = round.given.iter_mut().filter_map(Option::take).collect();
            round.last = Arc::new(given);
            round.number += 1;
            self.complete.notify_all();
        }
        while round.number == number {
            assert!(!round.is_broken, "another rank has ended early");
            let woken = self.complete.wait(round);
            round = woken.unwrap_or_else(PoisonError::into_inner);
        }
        Arc::clone(&round.last)
    }

    fn break_off(&self) {
        self.round().is_broken = true;
        self.complete.notify_all();
    }
}

/// The parcels of a kind.
fn only<'a, T>(parcels: &'a [Parcel], of: impl Fn(&'a Parcel) -> Option<T>) -> Vec<T> {
    let parcels = parcels.iter().map(of);
    let parcels = parcels.map(|parcel| parcel.expect("all ranks call the same function"));
    parcels.collect()
}

impl Team for Together {
    fn rank(&self) -> usize {
        self.rank
    }

    fn size(&self) -> usize {
        self.size
    }

    fn gather(&self, own: &[u8]) -> Vec<Vec<u8>> {
        let all = self.all(Parcel::Bytes(own.to_vec()));
        only(&all, |parcel| match parcel {
            Parcel::Bytes(bytes) => Some(bytes.clone()),
            _ => None,
        })
    }

    fn exchange(&self, parcels: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
        let all = self.all(Parcel::Exchanged(parcels));
        only(&all, |parcel| match parcel {
            Parcel::Exchanged(parcels) => Some(parcels[self.rank].clone()),
            _ => None,
        })
    }

    fn sum(&self, values: &mut [f64]) {
        let all = self.all(Parcel::Summed(values.to_vec()));
        values.fill(0.0);
        let all = only(&all, |parcel| match parcel {
            Parcel::Summed(values) => Some(values),
            _ => None,
        });
        for own in all {
            assert_eq!(own.len(), values.len(), "all ranks sum as much");
            values
                .iter_mut()
                .zip(own)
                .for_each(|(sum, value)| *sum += value);
        }
    }

    fn largest(&self, values: &mut [f64]) {
        let all = self.all(Parcel::Compared(values.to_vec()));
        let all = only(&all, |parcel| match parcel {
            Parcel::Compared(values) => Some(values),
            _ => None,
        });
        for own in all {
            assert_eq!(own.len(), values.len(), "all ranks compare as much");
            for (most, value) in values.iter_mut().zip(own) {
                if value.is_nan() || *value > *most {
                    *most = *value;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_reduced_is_the_same_on_all_ranks() {
        let found = Together::run(4, |team| {
            let own = team.rank() as f64;
            let (mut sum, mut most) = ([own, 0.1], [own, -own]);
            for _ in 0..50 {
                sum = [own, 0.1];
                team.sum(&mut sum);
            }
            team.largest(&mut most);
            let mut odd = [if team.rank() == 2 { f64::NAN } else { own }];
            team.largest(&mut odd);
            assert!(odd[0].is_nan());
            (sum, most, team.gather(&[team.rank() as u8]))
        });
        for (sum, most, gathered) in found {
            assert_eq!(sum, [6.0, 0.1 + 0.1 + 0.1 + 0.1]);
            assert_eq!(most, [3.0, 0.0]);
            assert_eq!(gathered, [[0], [1], [2], [3]]);
        }
    }

    #[test]
    fn parcels_go_to_whom_they_are_meant_for() {
        let found = Together::run(3, |team| {
            let to = |rank: usize| vec![team.rank() as f64, rank as f64];
            team.exchange((0..3).map(to).collect())
        });
        for (rank, received) in found.iter().enumerate() {
            for (from, parcel) in received.iter().enumerate() {
                assert_eq!(*parcel, [from as f64, rank as f64]);
            }
        }
    }

    #[test]
    fn ranks_end_together() {
        let run = || {
            Together::run(3, |team| {
                assert!(team.rank() != 1, "rank 1 gives up");
                team.sum(&mut [1.0]);
            })
        };
        assert!(catch_unwind(run).is_err());
    }
}
