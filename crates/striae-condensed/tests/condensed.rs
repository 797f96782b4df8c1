//! The condensed solver on two blocks tied by multipliers, against the LU.
//!
//! Longer than other files, as all tests are of the same blocks.

mod parts;

use striae_condensed::{
    Automatic, Choice, FallBack, Growth, Method, Partition, Tangent, TangentSolver,
};
use striae_sparse::{Age, SolveError, SparseMatrix, Structure, Supervariable};

/// Effect of the lower block's face on the upper one's.
#[derive(Clone, Copy, PartialEq)]
enum Contact {
    Stick,
    /// Every other node.
    Slip,
    Open,
    /// So many rows of nodes stick.
    Part(usize),
}

/// Two grids of `side x side x height` nodes each, one above the other; the
/// lower one carries three multipliers at each node of its upper face.
struct Blocks {
    side: usize,
    height: usize,
    partition: Partition,
}

impl Blocks {
    fn new(side: usize, height: usize) -> Self {
        let node = |x: usize, y: usize, z: usize| x + side * (y + side * z);
        let mut cells = Vec::new();
        for z in (0..2 * height - 1).filter(|z| z + 1 != height) {
            for y in 0..side - 1 {
                for x in 0..side - 1 {
                    let corner = |k: usize| node(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2));
                    cells.push((0..8).map(|k| Supervariable(corner(k))).collect::<Vec<_>>());
                }
            }
        }
        let nodes = 2 * height * side * side;
        let face = |k: usize| k / (side * side) == height - 1;
        let mut offsets = vec![0];
        for k in 0..nodes {
            offsets.push(offsets[k] + if face(k) { 6 } else { 3 });
        }
        let bulk = Structure::from_cliques(offsets, &cells).unwrap();
        let mut blocks = Self {
            side,
            height,
            partition: Partition::new(&bulk, &vec![3; nodes]).unwrap(),
        };
        let ties: Growth = blocks.ties().collect();
        blocks.partition = blocks.partition.grown(&ties).unwrap();
        blocks
    }

    /// Each node of the lower face with four of the upper one.
    fn ties(&self) -> impl Iterator<Item = Vec<Supervariable>> {
        let (side, area, height) = (self.side, self.side * self.side, self.height);
        (0..area).map(move |k| {
            let (x, y) = ((k % side).min(side - 2), (k / side).min(side - 2));
            let above = |dx: usize, dy: usize| x + dx + side * (y + dy) + height * area;
            let own = k + (height - 1) * area;
            [own, above(0, 0), above(1, 0), above(0, 1), above(1, 1)]
                .map(Supervariable)
                .to_vec()
        })
    }

    fn first(&self, s: Supervariable) -> usize {
        self.partition.unknowns_of(s).start
    }

    /// Stiffness of both blocks; bottom and top are prescribed, as rows without other entries.
    fn matrix(&self, stiffness: [f64; 2], contact: Contact) -> Tangent {
        let mut matrix = SparseMatrix::zero(self.partition.whole());
        let area = self.side * self.side;
        let nodes = 2 * self.height * area;
        let held = |s: Supervariable| s.0 < area || s.0 >= nodes - area;
        for (k, modulus) in stiffness.into_iter().enumerate() {
            for cell in self.cells(k) {
                let columns: Vec<usize> = cell
                    .iter()
                    .flat_map(|&s| (0..3).map(move |c| (s, c)))
                    .map(|(s, c)| self.first(s) + c)
                    .collect();
                let kept: Vec<usize> = (0..24).filter(|&a| !held(cell[a / 3])).collect();
                let rows: Vec<usize> = kept.iter().map(|&a| columns[a]).collect();
                let block = kept.iter().flat_map(|&a| (0..24).map(move |b| entry(a, b)));
                let block: Vec<f64> = block.map(|e| modulus * e).collect();
                matrix.add(&rows, &columns, &block).unwrap();
            }
        }
        for s in (0..nodes).map(Supervariable).filter(|&s| held(s)) {
            for c in 0..3 {
                let u = self.first(s) + c;
                matrix.add(&[u], &[u], &[stiffness[0]]).unwrap();
            }
        }
        for tie in self.ties() {
            self.tie(&mut matrix, &tie, contact);
        }
        parts::tangent(&self.partition, &matrix, 0.25)
    }

    fn cells(&self, block: usize) -> impl Iterator<Item = [Supervariable; 8]> {
        let (side, height) = (self.side, self.height);
        let per_layer = (side - 1) * (side - 1);
        (0..per_layer * (height - 1)).map(move |k| {
            let (z, k) = (block * height + k / per_layer, k % per_layer);
            let (x, y) = (k % (side - 1), k / (side - 1));
            [0, 1, 2, 3, 4, 5, 6, 7].map(|c| {
                let (x, y, z) = (x + (c & 1), y + (c >> 1 & 1), z + (c >> 2));
                Supervariable(x + side * (y + side * z))
            })
        })
    }

    fn tie(&self, matrix: &mut SparseMatrix, tie: &[Supervariable], contact: Contact) {
        let multiplier = self.first(tie[0]) + 3;
        let contact = match contact {
            Contact::Part(rows) if tie[0].0 % self.side < rows => Contact::Stick,
            Contact::Part(_) => Contact::Open,
            whole => whole,
        };
        let slips = contact == Contact::Slip && tie[0].0.is_multiple_of(2);
        for c in 0..3 {
            let row = multiplier + c;
            if contact == Contact::Open || slips && c > 0 {
                matrix.add(&[row], &[row], &[1.0]).unwrap();
            }
            if slips && c > 0 {
                matrix.add(&[row], &[multiplier], &[-0.3]).unwrap();
            }
            for (k, &s) in tie.iter().enumerate() {
                let weight = if k == 0 { 1.0 } else { -0.25 };
                let u = self.first(s) + c;
                matrix.add(&[u], &[row], &[0.01 * weight]).unwrap();
                if contact != Contact::Open && !(slips && c > 0) {
                    matrix.add(&[row], &[u], &[weight]).unwrap();
                } else if slips {
                    matrix.add(&[row], &[u], &[-0.2 * weight]).unwrap();
                }
            }
        }
    }
}

/// Entry of a semidefinite cell matrix: constants cost nothing.
fn entry(a: usize, b: usize) -> f64 {
    let coupling = [[1.0, 0.2, 0.1], [0.2, 1.2, 0.3], [0.1, 0.3, 0.9]];
    let graph = if a / 3 == b / 3 { 7.0 } else { -1.0 };
    graph * coupling[a % 3][b % 3] / 8.0
}

fn solution(
    solver: &mut Automatic,
    (blocks, matrix): (&Blocks, &Tangent),
    rhs: &[f64],
) -> (Vec<f64>, Method) {
    let mut x = vec![0.0; rhs.len()];
    solver.analyse(&blocks.partition).unwrap();
    let report = solver.factor(matrix).unwrap();
    let solved = solver.solve_to(matrix, rhs, &mut x, 1e-13).unwrap();
    assert!(solved.backward_error < 1e-12, "{solved:?}");
    (x, report.method)
}

fn load(n: usize) -> Vec<f64> {
    (0..n).map(|k| ((k * 7) % 13) as f64 - 6.0).collect()
}

/// Largest difference, each kind of unknown by its own size.
fn difference(blocks: &Blocks, a: &[f64], b: &[f64]) -> f64 {
    let kind = |u: usize| usize::from(u - blocks.first(blocks.partition.owner(u)) >= 3);
    let mut sizes = [0.0_f64; 2];
    let mut largest = [0.0_f64; 2];
    for u in 0..a.len() {
        sizes[kind(u)] = sizes[kind(u)].max(b[u].abs());
        largest[kind(u)] = largest[kind(u)].max((a[u] - b[u]).abs());
    }
    (largest[0] / sizes[0]).max(largest[1] / sizes[1].max(f64::MIN_POSITIVE))
}

#[test]
fn the_answers_are_those_of_the_lu() {
    for (side, height) in [(2, 2), (5, 3), (7, 4)] {
        let blocks = Blocks::new(side, height);
        let rhs = load(blocks.partition.unknowns());
        for contact in [
            Contact::Stick,
            Contact::Slip,
            Contact::Open,
            Contact::Part(1),
        ] {
            // Steel on rubber and equal blocks.
            for stiffness in [[1.0, 1.0], [1e5, 1.0], [1.0, 1e5]] {
                let matrix = blocks.matrix(stiffness, contact);
                let (x, method) = solution(
                    &mut Automatic::new(Choice::ByCost),
                    (&blocks, &matrix),
                    &rhs,
                );
                let (expected, _) = solution(
                    &mut Automatic::new(Choice::Multifrontal),
                    (&blocks, &matrix),
                    &rhs,
                );
                let error = difference(&blocks, &x, &expected);
                assert_eq!(method, Method::Condensed);
                assert!(error < 1e-9, "{side} {height} {stiffness:?}: {error:e}");
            }
        }
    }
}

#[test]
fn the_dense_system_has_the_order_of_the_multipliers() {
    let blocks = Blocks::new(6, 4);
    let mut solver = Automatic::new(Choice::ByCost);
    solver.analyse(&blocks.partition).unwrap();
    let report = solver
        .factor(&blocks.matrix([1.0, 2.0], Contact::Stick))
        .unwrap();
    assert_eq!(report.dense_order, 3 * 36);
    let report = solver
        .factor(&blocks.matrix([1.0, 2.0], Contact::Slip))
        .unwrap();
    assert_eq!(report.dense_order, 3 * 36);
}

#[test]
fn nodes_that_nothing_touches_are_eliminated_with_their_body() {
    let blocks = Blocks::new(9, 6);
    let rhs = load(blocks.partition.unknowns());
    let mut solver = Automatic::new(Choice::ByCost);
    solver.analyse(&blocks.partition).unwrap();
    // Rows of nine nodes: those that stick, below, and one more, above, are touched,
    // and stay so. Those that stick have multipliers.
    let order = |stick: usize| 27 * stick;
    let mut order_of = |rows: usize| {
        let matrix = blocks.matrix([1.0, 2.0], Contact::Part(rows));
        let order = solver.factor(&matrix).unwrap().dense_order;
        let mut x = vec![0.0; rhs.len()];
        let solved = solver.solve_to(&matrix, &rhs, &mut x, 1e-13).unwrap();
        let (expected, _) = solution(
            &mut Automatic::new(Choice::Multifrontal),
            (&blocks, &matrix),
            &rhs,
        );
        let error = difference(&blocks, &x, &expected);
        assert!(error < 1e-9, "{error:e}");
        (order, solved.age)
    };
    assert_eq!(order_of(2), (order(2), Age::Fresh));
    assert_eq!(order_of(1), (order(1), Age::Stale));
    assert_eq!(order_of(4), (order(4), Age::Stale));
    assert_eq!(order_of(1), (order(1), Age::Stale));
    solver.start_afresh();
    let matrix = blocks.matrix([1.0, 2.0], Contact::Part(1));
    assert_eq!(solver.factor(&matrix).unwrap().dense_order, order(1));
}

#[test]
fn thin_bodies_in_contact_all_over_are_left_to_the_lu() {
    let blocks = Blocks::new(16, 3);
    let matrix = blocks.matrix([1.0, 2.0], Contact::Stick);
    let mut solver = Automatic::new(Choice::ByCost);
    let analysis = solver.analyse(&blocks.partition).unwrap();
    let estimates = solver.estimates(&blocks.partition).unwrap();
    let condensed = estimates.iter().find(|e| e.method == Method::Condensed);
    assert_eq!(analysis.method, Method::Multifrontal);
    assert!(condensed.unwrap().cost.flops > analysis.cost.flops);
    let report = solver.factor(&matrix).unwrap();
    let expected = FallBack::LargeInterface {
        unknowns: 2 * 3 * 16 * 16,
    };
    assert_eq!(report.method, Method::Multifrontal);
    assert_eq!(report.fall_back, Some(expected));
}

#[test]
fn an_indefinite_interior_is_left_to_the_lu() {
    let blocks = Blocks::new(5, 4);
    let mut matrix = blocks.matrix([1.0, 1.0], Contact::Stick);
    let node = Supervariable(25 + 12);
    let u = blocks.first(node);
    matrix.bodies.add(&[u], &[u], &[-20.0]).unwrap();
    let rhs = load(blocks.partition.unknowns());
    let mut solver = Automatic::new(Choice::ByCost);
    solver.analyse(&blocks.partition).unwrap();
    let report = solver.factor(&matrix).unwrap();
    assert_eq!(report.method, Method::Multifrontal);
    let reason = report.fall_back;
    assert!(matches!(reason, Some(FallBack::IndefiniteInterior { unknown }) if unknown >= u));
    let (x, _) = solution(&mut solver, (&blocks, &matrix), &rhs);
    let (expected, _) = solution(
        &mut Automatic::new(Choice::Multifrontal),
        (&blocks, &matrix),
        &rhs,
    );
    assert!(difference(&blocks, &x, &expected) < 1e-9);
}

#[test]
fn a_bulk_that_is_not_quite_symmetric_is_refined() {
    let blocks = Blocks::new(5, 4);
    let mut matrix = blocks.matrix([1.0, 1.0], Contact::Slip);
    let (a, b) = (
        blocks.first(Supervariable(30)),
        blocks.first(Supervariable(31)),
    );
    matrix.bodies.add(&[a], &[b], &[0.05]).unwrap();
    let rhs = load(blocks.partition.unknowns());
    let (x, method) = solution(
        &mut Automatic::new(Choice::ByCost),
        (&blocks, &matrix),
        &rhs,
    );
    let (expected, _) = solution(
        &mut Automatic::new(Choice::Multifrontal),
        (&blocks, &matrix),
        &rhs,
    );
    assert_eq!(method, Method::Condensed);
    assert!(difference(&blocks, &x, &expected) < 1e-9);
}

#[test]
fn a_block_that_nothing_holds_is_named() {
    let blocks = Blocks::new(4, 3);
    let mut matrix = blocks.matrix([1.0, 1.0], Contact::Open);
    // Take the supports of the upper block away.
    let nodes = 2 * 3 * 16;
    for s in (nodes - 16..nodes).map(Supervariable) {
        let u = blocks.first(s);
        (u..u + 3).for_each(|u| matrix.bodies.add(&[u], &[u], &[-1.0]).unwrap());
    }
    let mut solver = Automatic::new(Choice::ByCost);
    solver.analyse(&blocks.partition).unwrap();
    let failed = solver.factor(&matrix).unwrap_err();
    assert!(matches!(failed, SolveError::Singular { .. }), "{failed:?}");
}

#[test]
fn older_interiors_precondition_until_they_are_too_far() {
    let blocks = Blocks::new(18, 9);
    let rhs = load(blocks.partition.unknowns());
    let mut solver = Automatic::new(Choice::ByCost);
    solver.analyse(&blocks.partition).unwrap();
    let mut x = vec![0.0; rhs.len()];
    let steps = [
        ([1.0, 2.0], Contact::Stick, Age::Fresh),
        ([1.02, 1.97], Contact::Stick, Age::Stale),
        ([1.02, 1.97], Contact::Slip, Age::Stale),
        ([60.0, 0.01], Contact::Slip, Age::Fresh),
    ];
    for (stiffness, contact, interior) in steps {
        let matrix = blocks.matrix(stiffness, contact);
        solver.factor(&matrix).unwrap();
        let report = solver.solve(&matrix, &rhs, &mut x).unwrap();
        assert_eq!(report.age, interior, "{stiffness:?} {report:?}");
        let (expected, _) = solution(
            &mut Automatic::new(Choice::Multifrontal),
            (&blocks, &matrix),
            &rhs,
        );
        // The reduction of the residual times a factor for the condition.
        let error = difference(&blocks, &x, &expected);
        assert!(
            error < 1e3 * striae_condensed::REDUCTION,
            "{stiffness:?} {error:e} {report:?}"
        );
    }
}

#[test]
fn factors_are_in_double_precision_where_single_is_too_coarse() {
    let blocks = Blocks::new(9, 6);
    let mut matrix = blocks.matrix([1.0, 1.0], Contact::Stick);
    let nodes = [81 + 40, 81 + 41].map(Supervariable);
    let pair = nodes.map(|node| blocks.first(node));
    let stiff = 1e9;
    let spring = [stiff, -stiff, -stiff, stiff];
    let rhs = load(blocks.partition.unknowns());
    let mut solver = Automatic::new(Choice::ByCost);
    solution(&mut solver, (&blocks, &matrix), &rhs);
    assert!(!solver.experience().0.too_coarse);
    matrix.bodies.add(&pair, &pair, &spring).unwrap();
    let (x, method) = solution(&mut solver, (&blocks, &matrix), &rhs);
    assert!(solver.experience().0.too_coarse);
    assert_eq!(method, Method::Condensed);
    let (expected, _) = solution(
        &mut Automatic::new(Choice::Multifrontal),
        (&blocks, &matrix),
        &rhs,
    );
    // Round-off times the condition of the spring.
    assert!(difference(&blocks, &x, &expected) < 1e-6);
}

#[test]
fn a_solver_goes_on_from_the_experience_of_another_to_the_last_bit() {
    let blocks = Blocks::new(18, 9);
    let rhs = load(blocks.partition.unknowns());
    let mut first = Automatic::new(Choice::ByCost);
    solution(
        &mut first,
        (&blocks, &blocks.matrix([1.0, 2.0], Contact::Stick)),
        &rhs,
    );
    let mut second = Automatic::new(Choice::ByCost);
    second.analyse(&blocks.partition).unwrap();
    let (experience, interior) = first.experience();
    second.recall(&experience, interior.as_ref());
    let matrix = blocks.matrix([1.02, 1.97], Contact::Slip);
    let answers = [&mut first, &mut second].map(|solver| {
        solver.start_afresh();
        solver.factor(&matrix).unwrap();
        let mut x = vec![0.0; rhs.len()];
        let report = solver.solve(&matrix, &rhs, &mut x).unwrap();
        assert_eq!(report.age, Age::Stale);
        x
    });
    assert_eq!(answers[0], answers[1]);
    assert_eq!(first.experience().0, second.experience().0);
    assert_eq!(first.experience().1, second.experience().1);
}

#[test]
fn other_contact_is_solved_on_the_same_interior() {
    let blocks = Blocks::new(9, 6);
    let rhs = load(blocks.partition.unknowns());
    let mut solver = Automatic::new(Choice::ByCost);
    assert!(!solver.has_interior());
    let matrix = blocks.matrix([1.0, 2.0], Contact::Part(2));
    solution(&mut solver, (&blocks, &matrix), &rhs);
    assert!(solver.has_interior());
    for contact in [
        Contact::Part(1),
        Contact::Open,
        Contact::Part(3),
        Contact::Slip,
        Contact::Stick,
    ] {
        let other = blocks.matrix([1.0, 2.0], contact);
        let x = solver.solve_other_contact(&other, &rhs).unwrap().unwrap();
        let (expected, _) = solution(
            &mut Automatic::new(Choice::Multifrontal),
            (&blocks, &other),
            &rhs,
        );
        let error = difference(&blocks, &x, &expected);
        // Once through factors in single precision.
        assert!(error < 1e-5, "{error:e}");
    }
}

#[test]
fn factors_of_a_matrix_nearby_serve_another_and_stay_as_they_are() {
    let blocks = Blocks::new(18, 9);
    let rhs = load(blocks.partition.unknowns());
    let mut solver = Automatic::new(Choice::ByCost);
    let matrix = blocks.matrix([1.0, 2.0], Contact::Part(9));
    solution(&mut solver, (&blocks, &matrix), &rhs);
    let mut before = vec![0.0; rhs.len()];
    solver.solve(&matrix, &rhs, &mut before).unwrap();
    let near = blocks.matrix([1.01, 1.98], Contact::Part(9));
    let mut x = vec![0.0; rhs.len()];
    let report = solver.solve_beside(&near, &rhs, &mut x, 1e-9).unwrap();
    assert!(report.is_some());
    let (expected, _) = solution(
        &mut Automatic::new(Choice::Multifrontal),
        (&blocks, &near),
        &rhs,
    );
    let error = difference(&blocks, &x, &expected);
    // The reduction of the residual times a factor for the condition.
    assert!(error < 1e-6, "{error:e}");
    // Unknowns that the factors know by a diagonal have other rows here.
    let closed = blocks.matrix([1.0, 2.0], Contact::Stick);
    let report = solver.solve_beside(&closed, &rhs, &mut x, 1e-9).unwrap();
    assert!(report.is_none());
    solver.solve(&matrix, &rhs, &mut x).unwrap();
    assert!(x == before);
}

#[test]
fn threads_do_not_change_a_bit() {
    let blocks = Blocks::new(12, 6);
    let rhs = load(blocks.partition.unknowns());
    let with = |contact: Contact, threads: usize| {
        let matrix = blocks.matrix([1.0, 3.0], contact);
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let (x, method) = pool.install(|| {
            solution(
                &mut Automatic::new(Choice::ByCost),
                (&blocks, &matrix),
                &rhs,
            )
        });
        assert_eq!(method, Method::Condensed);
        x
    };
    for contact in [Contact::Slip, Contact::Part(4)] {
        assert!(with(contact, 1) == with(contact, 2));
    }
}
