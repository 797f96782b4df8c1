//! Iterations, times and memory of blocks that grow.

use crate::blocks::{Blocks, Contact, Rank, Top};
use std::{fs, time::Instant};
use striae_condensed::TangentSolver;
use striae_petsc::{Choice, PetscSolver, Ranks};
use striae_solve::team::Team;

/// Prints a row for blocks of every side.
pub fn report(ranks: &Ranks, sides: &[&str]) {
    let is_first = ranks.rank() == 0;
    if is_first {
        println!("unknowns contact iterations setup/s solution/s matrix,peak/(bytes/unknown)");
    }
    for side in sides.iter().filter_map(|side| side.parse().ok()) {
        for contact in [Contact::Stick, Contact::Slip] {
            let blocks = Blocks {
                side,
                height: usize::div_ceil(side, 2),
                stiffness: [1.0, 2.0],
                contact,
                top: Top::Held,
                slices: 1,
            };
            let part = blocks.part(Rank(ranks.rank(), ranks.size()));
            let unknowns = part.numbering.count;
            let before = memory("VmRSS:");
            let mut solver = PetscSolver::new(ranks, Choice::Iterative);
            solver.analyse(&part.partition).unwrap();
            let started = Instant::now();
            solver.factor(&part.tangent).unwrap();
            let made = Instant::now();
            let mut x = vec![0.0; part.rhs.len()];
            let report = solver
                .solve_to(&part.tangent, &part.rhs, &mut x, 1e-6)
                .unwrap();
            let solved = made.elapsed().as_secs_f64();
            let mut bytes = [before, memory("VmRSS:"), memory("VmHWM:")];
            ranks.sum(&mut bytes);
            if is_first {
                let [before, after, peak] = bytes.map(|b| b / unknowns as f64);
                println!(
                    "{unknowns:8} {contact:?} {:4} {:6.1} {solved:6.1} {before:6.0} {after:6.0} {peak:6.0}",
                    report.krylov_iterations,
                    (made - started).as_secs_f64(),
                );
            }
        }
    }
}

/// Bytes of this process.
fn memory(name: &str) -> f64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix(name));
    let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse().ok());
    1024.0 * kilobytes.unwrap_or(f64::NAN)
}
