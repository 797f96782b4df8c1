//! The ranks of a program that was started by `mpirun`.

use crate::{binding::Library, error::Error};
use mpi::{Threading, environment::Universe, topology::SimpleCommunicator, traits::*};
use std::{
    panic,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    thread,
};
use striae_solve::team::Team;

/// Exit code of a program of which a rank panicked, as Rust has it.
const PANICKED: i32 = 101;
/// Bytes that a rank sends in one call: counts of MPI have 32 bits.
const MOST: usize = 1 << 30;
/// Numbers up to which a sum sends all of them to all ranks.
const FEW: usize = 1 << 12;

/// The ranks of a program that was started by `mpirun`; cheap to clone.
///
/// The first call starts MPI and PETSc, the last clone that is dropped ends both. From then
/// on a panic on any rank ends all of them.
#[derive(Clone, Debug)]
pub struct Ranks(Arc<World>);

/// MPI and PETSc while they run. Fields are dropped in this order.
#[derive(Debug)]
struct World {
    library: Arc<Library>,
    rank: usize,
    size: usize,
    /// Held while MPI is called.
    turn: Mutex<()>,
    _universe: Ended,
}

/// MPI, to be finalised.
struct Ended(Option<Universe>);

impl std::fmt::Debug for Ended {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Universe")
    }
}

impl Drop for Ended {
    fn drop(&mut self) {
        // Ranks that wait for this one would keep it from ending.
        if thread::panicking() {
            abort(PANICKED);
        }
        self.0 = None;
    }
}

impl Ranks {
    /// Starts MPI and PETSc, which is given options such as `-striae_ksp_monitor`.
    ///
    /// # Errors
    /// When MPI runs already or cannot be called from several threads, or when PETSc does
    /// not start or has other kinds of numbers.
    pub fn start(options: &[&str]) -> Result<Self, Error> {
        let started = mpi::initialize_with_threading(Threading::Serialized);
        let (universe, threading) = started.ok_or(Error::Started)?;
        let universe = Ended(Some(universe));
        if threading < Threading::Serialized {
            return Err(Error::Threads);
        }
        let world = SimpleCommunicator::world();
        let library = Arc::new(Library::start(options)?);
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            before(panic);
            abort(PANICKED);
        }));
        Ok(Self(Arc::new(World {
            library,
            rank: world.rank() as usize,
            size: world.size() as usize,
            turn: Mutex::new(()),
            _universe: universe,
        })))
    }

    /// Ends all ranks at once, with an exit code.
    pub fn abort(&self, code: i32) -> ! {
        SimpleCommunicator::world().abort(code)
    }

    pub(crate) fn library(&self) -> &Arc<Library> {
        &self.0.library
    }

    /// MPI, for one thread at a time.
    fn turn(&self) -> (SimpleCommunicator, MutexGuard<'_, ()>) {
        let turn = self.0.turn.lock().unwrap_or_else(PoisonError::into_inner);
        (SimpleCommunicator::world(), turn)
    }

    /// Values of all ranks, in the order of the ranks, if they fit into one call.
    fn gather_once<T: Equivalence + Clone>(&self, own: &[T], zero: T) -> Vec<Vec<T>> {
        let (world, _turn) = self.turn();
        let mut counts = vec![0_i32; self.0.size];
        world.all_gather_into(&(own.len() as i32), &mut counts[..]);
        let starts = starts(&counts);
        let total: i32 = counts.iter().sum();
        let mut all = vec![zero; total as usize];
        let mut parts = mpi::datatype::PartitionMut::new(&mut all[..], &counts[..], &starts[..]);
        world.all_gather_varcount_into(own, &mut parts);
        split(&all, &counts)
    }

    /// Every rank's parcels for this one, where they fit into one call.
    fn exchange_once(&self, parcels: &[&[f64]]) -> Vec<Vec<f64>> {
        let (world, _turn) = self.turn();
        let sent: Vec<i32> = parcels.iter().map(|parcel| parcel.len() as i32).collect();
        let mut received = vec![0_i32; self.0.size];
        world.all_to_all_into(&sent[..], &mut received[..]);
        let out: Vec<f64> = parcels.concat();
        let total: i32 = received.iter().sum();
        let mut all = vec![0.0; total as usize];
        let (from, to) = (starts(&sent), starts(&received));
        let send = mpi::datatype::Partition::new(&out[..], &sent[..], &from[..]);
        let mut receive = mpi::datatype::PartitionMut::new(&mut all[..], &received[..], &to[..]);
        world.all_to_all_varcount_into(&send, &mut receive);
        split(&all, &received)
    }

    /// The largest of numbers of all ranks.
    fn most(&self, own: usize) -> usize {
        let (world, _turn) = self.turn();
        let mut all = vec![0_u64; self.0.size];
        world.all_gather_into(&(own as u64), &mut all[..]);
        all.into_iter().max().unwrap_or(0) as usize
    }

    /// Replaces values by what becomes of those of all ranks, in their order.
    fn reduce(&self, values: &mut [f64], join: impl Fn(f64, f64) -> f64) {
        let size = self.0.size;
        if size == 1 {
            return;
        }
        let joined = |all: &[Vec<f64>], values: &mut [f64]| {
            values.copy_from_slice(&all[0]);
            for other in &all[1..] {
                let pairs = values.iter_mut().zip(other);
                pairs.for_each(|(a, &b)| *a = join(*a, b));
            }
        };
        if values.len() <= FEW {
            let all = self.gather_once(values, 0.0);
            joined(&all, values);
            return;
        }
        // Every rank takes a piece.
        let piece = values.len().div_ceil(size);
        let mut parcels: Vec<Vec<f64>> = values.chunks(piece).map(<[f64]>::to_vec).collect();
        parcels.resize(size, Vec::new());
        let all = self.exchange(parcels);
        let mut own = all[0].clone();
        joined(&all, &mut own);
        let all = self.exchange(vec![own; size]);
        values.copy_from_slice(&all.concat());
    }
}

impl Team for Ranks {
    fn rank(&self) -> usize {
        self.0.rank
    }

    fn size(&self) -> usize {
        self.0.size
    }

    fn gather(&self, own: &[u8]) -> Vec<Vec<u8>> {
        let most = MOST / self.0.size;
        let mut all = vec![Vec::new(); self.0.size];
        for round in 0..self.most(own.len()).div_ceil(most) {
            let part = &own[(round * most).min(own.len())..((round + 1) * most).min(own.len())];
            let parts = self.gather_once(part, 0);
            all.iter_mut()
                .zip(parts)
                .for_each(|(all, part)| all.extend(part));
        }
        all
    }

    fn exchange(&self, parcels: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
        assert_eq!(parcels.len(), self.0.size, "one parcel for every rank");
        let most = MOST / size_of::<f64>() / self.0.size;
        let longest = parcels.iter().map(Vec::len).max().unwrap_or(0);
        let mut all = vec![Vec::new(); self.0.size];
        for round in 0..self.most(longest).div_ceil(most) {
            let part =
                |p: &Vec<f64>| (round * most).min(p.len())..((round + 1) * most).min(p.len());
            let parts: Vec<&[f64]> = parcels.iter().map(|p| &p[part(p)]).collect();
            let parts = self.exchange_once(&parts);
            all.iter_mut()
                .zip(parts)
                .for_each(|(all, part)| all.extend(part));
        }
        all
    }

    fn sum(&self, values: &mut [f64]) {
        self.reduce(values, |a, b| a + b);
    }

    fn largest(&self, values: &mut [f64]) {
        // `f64::max` would drop what is not a number.
        self.reduce(values, |a, b| if a.is_nan() || a >= b { a } else { b });
    }
}

/// Starts of parts with so many entries.
fn starts(counts: &[i32]) -> Vec<i32> {
    let before = counts.iter().scan(0, |sum, &count| {
        let start = *sum;
        *sum += count;
        Some(start)
    });
    before.collect()
}

/// Parts of so many entries.
fn split<T: Clone>(all: &[T], counts: &[i32]) -> Vec<Vec<T>> {
    let parts = starts(counts).into_iter().zip(counts);
    parts
        .map(|(start, &count)| all[start as usize..][..count as usize].to_vec())
        .collect()
}

/// Ends all ranks if MPI runs.
fn abort(code: i32) {
    if mpi::environment::is_initialized() && !mpi::is_finalized() {
        SimpleCommunicator::world().abort(code);
    }
}
