//! Properties that must hold on any number of ranks.

use crate::blocks::{Blocks, Contact, Part, Rank, Top};
use striae_condensed::{Automatic, Choice as Serial, FallBack, Method, TangentSolver};
use striae_petsc::{Choice, PetscSolver, Ranks};
use striae_solve::team::Team;
use striae_sparse::{SolveError, SolveReport};

/// Runs all checks.
pub fn all(ranks: &Ranks) {
    for (name, check) in [
        ("team", team as fn(&Ranks)),
        ("long messages", long_messages),
        ("answers of the direct solver", direct),
        ("answers of the iterative solver", iterative),
        ("several levels", several_levels),
        ("singular matrices", singular),
        ("what is not finite", not_finite),
        ("few unknowns", few_unknowns),
        ("indefinite bodies", indefinite),
    ] {
        check(ranks);
        if ranks.rank() == 0 {
            println!("{name}: well on {} ranks", ranks.size());
        }
    }
}

fn team(ranks: &Ranks) {
    let (rank, size) = (ranks.rank(), ranks.size());
    let all = ranks.gather(&vec![rank as u8; rank]);
    let expected: Vec<Vec<u8>> = (0..size).map(|r| vec![r as u8; r]).collect();
    assert_eq!(all, expected);
    let parcels = (0..size).map(|to| vec![(10 * rank + to) as f64; to + 1]);
    let received = ranks.exchange(parcels.collect());
    for (from, parcel) in received.iter().enumerate() {
        assert_eq!(*parcel, vec![(10 * from + rank) as f64; rank + 1]);
    }
    // Sums in the order of the ranks, with the same bits on all.
    for count in [0, 1, 7, 10_000] {
        let value = |rank: usize, k: usize| 1.0 / (3 * rank + k + 1) as f64;
        let mut sums: Vec<f64> = (0..count).map(|k| value(rank, k)).collect();
        ranks.sum(&mut sums);
        let expected = |k: usize| (1..size).fold(value(0, k), |sum, r| sum + value(r, k));
        assert!(sums.iter().enumerate().all(|(k, sum)| *sum == expected(k)));
        let mut largest: Vec<f64> = (0..count).map(|k| -value(rank, k)).collect();
        ranks.largest(&mut largest);
        let expected = |k: usize| -value(size - 1, k);
        assert!(largest.iter().enumerate().all(|(k, l)| *l == expected(k)));
    }
    let mut values = [if rank + 1 == size { f64::NAN } else { 1.0 }, 2.0];
    ranks.largest(&mut values);
    assert!(values[0].is_nan() && values[1] == 2.0);
}

fn long_messages(ranks: &Ranks) {
    let all = ranks.gather(&vec![ranks.rank() as u8; 3_000_000]);
    assert!(
        all.iter()
            .zip(0..)
            .all(|(part, r)| part.len() == 3_000_000 && part[17] == r)
    );
}

fn cases() -> impl Iterator<Item = Blocks> {
    let contacts = [Contact::Stick, Contact::Slip, Contact::Open];
    let tops = [Top::Held, Top::Free];
    let stiffness = [[1.0, 1.0], [1e5, 1.0], [1.0, 1e5]];
    let pairs = contacts.into_iter().flat_map(move |c| tops.map(|t| (c, t)));
    let cases = pairs.flat_map(move |(c, t)| stiffness.map(|s| (c, t, s)));
    cases.map(|(contact, top, stiffness)| Blocks {
        side: 9,
        height: 5,
        stiffness,
        contact,
        top,
        slices: 1,
    })
}

/// Largest difference from the answer of one rank, positions and multipliers each over the
/// largest.
fn difference(blocks: &Blocks, part: &Part, x: &[f64]) -> f64 {
    let whole = blocks.part(Rank(0, 1));
    let mut solver = Automatic::new(Serial::Multifrontal);
    solver.analyse(&whole.partition).unwrap();
    solver.factor(&whole.tangent).unwrap();
    let mut expected = vec![0.0; whole.rhs.len()];
    solver
        .solve(&whole.tangent, &whole.rhs, &mut expected)
        .unwrap();
    let mut error = 0.0_f64;
    for kind in [true, false] {
        let all = (0..whole.rhs.len()).filter(|&u| whole.is_position[u] == kind);
        let size = all.map(|u| expected[u].abs()).fold(0.0, f64::max);
        let own = (0..x.len()).filter(|&u| part.is_position[u] == kind);
        let off = own.map(|u| (x[u] - expected[part.serial[u]]).abs());
        error = error.max(off.fold(0.0, f64::max) / size);
    }
    error
}

fn solved(
    solver: &mut PetscSolver,
    part: &Part,
    reduction: f64,
) -> (Vec<f64>, Method, SolveReport) {
    solver.analyse(&part.partition).unwrap();
    let method = solver.factor(&part.tangent).unwrap().method;
    let mut x = vec![f64::NAN; part.rhs.len()];
    let report = solver
        .solve_to(&part.tangent, &part.rhs, &mut x, reduction)
        .unwrap();
    (x, method, report)
}

fn direct(ranks: &Ranks) {
    let mut solver = PetscSolver::new(ranks, Choice::Mumps);
    for blocks in cases() {
        let part = blocks.part(Rank(ranks.rank(), ranks.size()));
        let (x, method, report) = solved(&mut solver, &part, 1e-9);
        assert_eq!(method, Method::Mumps);
        assert!(report.backward_error < 1e-12, "{blocks:?} {report:?}");
        let error = difference(&blocks, &part, &x);
        // The answer of one rank has round-off, too.
        let condition = if blocks.stiffness[0] == blocks.stiffness[1] {
            1.0
        } else {
            1e2
        };
        assert!(error < condition * 1e-9, "{blocks:?} {error:e}");
        check_same(ranks, &part, &x);
    }
}

/// A residual that is reduced by 1e-9 takes GMRES alone. Between bodies whose stiffness differs
/// by 1e5, a reduction by 1e-11 is below round-off for some divisions: MUMPS may take over, and
/// the answer is as good.
fn iterative(ranks: &Ranks) {
    for blocks in cases() {
        let is_even = blocks.stiffness[0] == blocks.stiffness[1];
        let part = blocks.part(Rank(ranks.rank(), ranks.size()));
        for (reduction, is_asked_much) in [(1e-9, false), (1e-11, true)] {
            let mut solver = PetscSolver::new(ranks, Choice::Iterative);
            let (x, method, report) = solved(&mut solver, &part, reduction);
            assert_eq!(method, Method::Iterative);
            assert!(report.krylov_iterations > 0 || is_asked_much && !is_even);
            let error = difference(&blocks, &part, &x);
            if ranks.rank() == 0 && std::env::var_os("VERBOSE").is_some() {
                println!(
                    "{:?} {:?} {:?}, {reduction:e}: {} iterations, {error:.1e}",
                    blocks.contact, blocks.top, blocks.stiffness, report.krylov_iterations
                );
            }
            // The condition does the rest.
            let bound = if is_even { 1e2 * reduction } else { 1e-7 };
            assert!(error < bound, "{blocks:?} {error:e} {report:?}");
            check_same(ranks, &part, &x);
        }
    }
}

/// Of blocks that have a coarser level of their own before the levels of PETSc, with many
/// borders between ranks.
fn several_levels(ranks: &Ranks) {
    for contact in [Contact::Stick, Contact::Slip] {
        let blocks = Blocks {
            side: 17,
            height: 9,
            stiffness: [1.0, 1.0],
            contact,
            top: Top::Free,
            slices: 4,
        };
        let part = blocks.part(Rank(ranks.rank(), ranks.size()));
        let mut solver = PetscSolver::new(ranks, Choice::Iterative);
        let (x, method, report) = solved(&mut solver, &part, 1e-9);
        assert_eq!(method, Method::Iterative);
        let iterations = report.krylov_iterations;
        assert!((1..=26).contains(&iterations), "{blocks:?} {report:?}");
        let error = difference(&blocks, &part, &x);
        assert!(error < 1e-7, "{blocks:?} {error:e} {report:?}");
        check_same(ranks, &part, &x);
    }
}

/// All ranks have the same bits at an unknown.
fn check_same(ranks: &Ranks, part: &Part, x: &[f64]) {
    let mut all = vec![f64::NEG_INFINITY; part.numbering.count];
    let mut least = all.clone();
    for (&u, x) in part.numbering.whole.iter().zip(x) {
        (all[u], least[u]) = (*x, -x);
    }
    ranks.largest(&mut all);
    ranks.largest(&mut least);
    assert!(all.iter().zip(&least).all(|(a, b)| *a == -b));
}

fn blocks(top: Top) -> Blocks {
    Blocks {
        side: 7,
        height: 4,
        stiffness: [1.0, 2.0],
        contact: Contact::Slip,
        top,
        slices: 1,
    }
}

fn singular(ranks: &Ranks) {
    let loose = blocks(Top::Loose);
    let part = loose.part(Rank(ranks.rank(), ranks.size()));
    let mut direct = PetscSolver::new(ranks, Choice::Mumps);
    direct.analyse(&part.partition).unwrap();
    let error = direct.factor(&part.tangent).unwrap_err();
    let SolveError::Singular { unknown, .. } = error else {
        panic!("{error:?}");
    };
    // The upper block is loose: the unknown is one of its.
    let here = part.numbering.whole.iter().position(|&u| u == unknown);
    let half = loose.part(Rank(0, 1)).rhs.len() - 3 * 7 * 7 * 4;
    assert!(here.is_none_or(|u| part.serial[u] >= half), "{error:?}");
    let mut iterative = PetscSolver::new(ranks, Choice::Iterative);
    iterative.analyse(&part.partition).unwrap();
    let failed = iterative.factor(&part.tangent).and_then(|_| {
        let mut x = vec![0.0; part.rhs.len()];
        iterative.solve_to(&part.tangent, &part.rhs, &mut x, 1e-9)
    });
    assert!(
        matches!(failed, Err(SolveError::Singular { .. })),
        "{failed:?}"
    );
    // It goes on with another matrix.
    let held = blocks(Top::Held).part(Rank(ranks.rank(), ranks.size()));
    solved(&mut direct, &held, 1e-9);
    let mut iterative = PetscSolver::new(ranks, Choice::Iterative);
    let (_, method, _) = solved(&mut iterative, &held, 1e-9);
    assert_eq!(method, Method::Iterative);
}

fn not_finite(ranks: &Ranks) {
    let mut part = blocks(Top::Held).part(Rank(ranks.rank(), ranks.size()));
    let mut solver = PetscSolver::new(ranks, Choice::Mumps);
    let mut x = vec![0.0; part.rhs.len()];
    solved(&mut solver, &part, 1e-9);
    let last = ranks.rank() + 1 == ranks.size();
    // Something that only one rank knows of.
    if last {
        part.rhs[11] = f64::NAN;
    }
    let error = solver.solve_to(&part.tangent, &part.rhs, &mut x, 1e-9);
    assert!(matches!(error, Err(SolveError::NotFinite { .. })));
    if last {
        part.tangent.bodies.add(&[11], &[11], &[f64::NAN]).unwrap();
    }
    let error = solver.factor(&part.tangent).unwrap_err();
    assert!(matches!(error, SolveError::NotFinite { .. }), "{error:?}");
    let error = solver.solve_to(&part.tangent, &part.rhs, &mut x, 1e-9);
    assert_eq!(error, Err(SolveError::NotFactored));
}

fn few_unknowns(ranks: &Ranks) {
    // Small systems go to MUMPS by cost.
    let part = blocks(Top::Free).part(Rank(ranks.rank(), ranks.size()));
    let mut solver = PetscSolver::new(ranks, Choice::ByCost);
    let (_, method, _) = solved(&mut solver, &part, 1e-9);
    assert_eq!(method, Method::Mumps);
    solver.forget();
    let mut x = vec![0.0; part.rhs.len()];
    let error = solver.solve_to(&part.tangent, &part.rhs, &mut x, 1e-9);
    assert_eq!(error, Err(SolveError::NotFactored));
}

fn indefinite(ranks: &Ranks) {
    let mut part = blocks(Top::Held).part(Rank(ranks.rank(), ranks.size()));
    // Far from definite, but not singular.
    for (u, whole) in part.numbering.whole.iter().enumerate() {
        if part.numbering.own.contains(whole) && part.serial[u].is_multiple_of(2) {
            part.tangent.bodies.add(&[u], &[u], &[-10.0]).unwrap();
        }
    }
    let mut solver = PetscSolver::new(ranks, Choice::Iterative);
    let (_, _, report) = solved(&mut solver, &part, 1e-9);
    assert!(report.backward_error < 1e-12, "{report:?}");
    let again = solver.factor(&part.tangent).unwrap();
    assert_eq!(again.method, Method::Mumps);
    let expected = [FallBack::NoPreconditioner, FallBack::NotConverged];
    assert!(
        again.fall_back.is_some_and(|f| expected.contains(&f)),
        "{again:?}"
    );
}
