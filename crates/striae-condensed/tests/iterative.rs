//! The iterative solver on two elastic blocks in contact, against the LU.

mod parts;

use striae_condensed::{
    Automatic, Choice, FallBack, Method, Partition, REDUCTION, Tangent, TangentSolver,
};
use striae_sparse::{SolveReport, SparseMatrix, Structure, Supervariable};

#[path = "../../striae-sparse/tests/elastic/mod.rs"]
mod elastic;

/// Effect of the lower block's face on the upper one's.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Contact {
    Stick,
    /// With friction at every node of the left half.
    Slip,
    /// The left half does not touch.
    Open,
}

/// Support of the upper block.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Top {
    Held,
    /// By contact alone.
    Free,
}

/// Two blocks of `side x side x height` nodes, one above the other; the lower one carries
/// three multipliers at each node of its upper face.
struct Blocks {
    side: usize,
    height: usize,
    partition: Partition,
}

impl Blocks {
    fn new(side: usize, height: usize) -> Self {
        let area = side * side;
        let nodes = 2 * height * area;
        let mut offsets = vec![0];
        for k in 0..nodes {
            offsets.push(offsets[k] + if k / area == height - 1 { 6 } else { 3 });
        }
        let points = (0..nodes).map(|k| {
            let z = k / area;
            let layer = if z < height { z } else { z - 1 };
            [k % side, k / side % side, layer].map(|x| x as f64)
        });
        let mut cells = Vec::new();
        for block in 0..2 {
            cells.extend(cells_of(side, height, block));
        }
        let bulk = Structure::from_cliques(offsets, &cells).unwrap();
        let partition = Partition::new(&bulk, &vec![3; nodes])
            .and_then(|partition| partition.with_points(points.collect()))
            .unwrap();
        let partition = partition
            .grown(&ties(side, height).into_iter().collect())
            .unwrap();
        Self {
            side,
            height,
            partition,
        }
    }

    fn first(&self, s: Supervariable) -> usize {
        self.partition.unknowns_of(s).start
    }

    fn matrix(&self, stiffness: [f64; 2], contact: Contact, top: Top) -> Tangent {
        let mut matrix = SparseMatrix::zero(self.partition.whole());
        let area = self.side * self.side;
        let nodes = 2 * self.height * area;
        let held = |s: Supervariable| s.0 < area || top == Top::Held && s.0 >= nodes - area;
        for (block, modulus) in stiffness.into_iter().enumerate() {
            let values = elastic::cell(1.5 * modulus, modulus, 1.0);
            for cell in cells_of(self.side, self.height, block) {
                let unknowns = cell.iter().flat_map(|&s| (0..3).map(move |c| (s, c)));
                let unknowns: Vec<usize> = unknowns.map(|(s, c)| self.first(s) + c).collect();
                let kept: Vec<usize> = (0..24).filter(|&a| !held(cell[a / 3])).collect();
                let rows: Vec<usize> = kept.iter().map(|&a| unknowns[a]).collect();
                let entries = kept.iter().flat_map(|a| &values[24 * a..24 * a + 24]);
                let entries: Vec<f64> = entries.copied().collect();
                matrix.add(&rows, &unknowns, &entries).unwrap();
            }
        }
        for s in (0..nodes).map(Supervariable).filter(|&s| held(s)) {
            let u = self.first(s);
            (u..u + 3).for_each(|u| matrix.add(&[u], &[u], &[stiffness[0]]).unwrap());
        }
        for tie in ties(self.side, self.height) {
            self.tie(&mut matrix, &tie, contact);
        }
        parts::tangent(&self.partition, &matrix, 0.0)
    }

    /// Normal and tangential rows of one node; forces act on the nodes it is tied to.
    fn tie(&self, matrix: &mut SparseMatrix, tie: &[Supervariable], contact: Contact) {
        let first = self.first(tie[0]) + 3;
        let is_left = tie[0].0 % self.side < self.side / 2;
        for c in 0..3 {
            let (row, is_normal) = (first + c, c == 2);
            let is_open = contact == Contact::Open && is_left;
            let slips = contact == Contact::Slip && is_left && !is_normal;
            if is_open || slips {
                matrix.add(&[row], &[row], &[1.0]).unwrap();
            }
            if slips {
                matrix.add(&[row], &[first + 2], &[-0.3]).unwrap();
            }
            for (k, &s) in tie.iter().enumerate() {
                let weight = if k == 0 { 1.0 } else { -0.25 };
                let u = self.first(s) + c;
                matrix.add(&[u], &[row], &[0.01 * weight]).unwrap();
                if !is_open && !slips {
                    matrix.add(&[row], &[u], &[weight]).unwrap();
                }
            }
        }
    }

    fn load(&self) -> Vec<f64> {
        let area = self.side * self.side;
        let nodes = 2 * self.height * area;
        let mut rhs = vec![0.0; self.partition.unknowns()];
        for s in (area..nodes - area).map(Supervariable) {
            let u = self.first(s);
            (0..3)
                .for_each(|c| rhs[u + c] = [0.3, 0.1, -1.0][c] + ((7 * u + c) % 13) as f64 / 13.0);
        }
        rhs
    }
}

fn cells_of(side: usize, height: usize, block: usize) -> Vec<[Supervariable; 8]> {
    let mut cells = Vec::new();
    for z in block * height..block * height + height - 1 {
        for y in 0..side - 1 {
            for x in 0..side - 1 {
                cells.push([0, 1, 2, 3, 4, 5, 6, 7].map(|k| {
                    let (x, y, z) = (x + (k & 1), y + (k >> 1 & 1), z + (k >> 2));
                    Supervariable(x + side * (y + side * z))
                }));
            }
        }
    }
    cells
}

/// Each node of the lower face with four of the upper one.
fn ties(side: usize, height: usize) -> Vec<Vec<Supervariable>> {
    let area = side * side;
    let tie = |k: usize| {
        let (x, y) = ((k % side).min(side - 2), (k / side).min(side - 2));
        let above = |dx: usize, dy: usize| x + dx + side * (y + dy) + height * area;
        let own = k + (height - 1) * area;
        let all = [own, above(0, 0), above(1, 0), above(0, 1), above(1, 1)];
        all.map(Supervariable).to_vec()
    };
    (0..area).map(tie).collect()
}

fn solved(
    solver: &mut Automatic,
    (partition, matrix): (&Partition, &Tangent),
    rhs: &[f64],
) -> (Vec<f64>, Method, SolveReport) {
    let mut x = vec![0.0; rhs.len()];
    solver.analyse(partition).unwrap();
    let method = solver.factor(matrix).unwrap().method;
    let report = solver.solve(matrix, rhs, &mut x).unwrap();
    (x, method, report)
}

/// Largest difference of positions over the largest one.
fn difference(blocks: &Blocks, a: &[f64], b: &[f64]) -> f64 {
    let is_position = |&u: &usize| u - blocks.first(blocks.partition.owner(u)) < 3;
    let (mut size, mut largest) = (0.0_f64, 0.0_f64);
    for u in (0..a.len()).filter(is_position) {
        size = size.max(b[u].abs());
        largest = largest.max((a[u] - b[u]).abs());
    }
    largest / size
}

#[test]
fn the_answers_are_those_of_the_lu() {
    let blocks = Blocks::new(9, 5);
    let rhs = blocks.load();
    for contact in [Contact::Stick, Contact::Slip, Contact::Open] {
        for top in [Top::Held, Top::Free] {
            for stiffness in [[1.0, 1.0], [1e5, 1.0], [1.0, 1e5]] {
                let matrix = blocks.matrix(stiffness, contact, top);
                let (x, method, report) = solved(
                    &mut Automatic::new(Choice::Iterative),
                    (&blocks.partition, &matrix),
                    &rhs,
                );
                let (expected, ..) = solved(
                    &mut Automatic::new(Choice::Multifrontal),
                    (&blocks.partition, &matrix),
                    &rhs,
                );
                let case = format!("{contact:?} {top:?} {stiffness:?}: {report:?}");
                assert_eq!(method, Method::Iterative, "{case}");
                assert!(report.krylov_iterations <= 30, "{case}");
                // The residual is reduced as asked; the condition does the rest.
                let error = difference(&blocks, &x, &expected);
                assert!(error < 1e3 * REDUCTION, "{case} {error:e}");
            }
        }
    }
}

#[test]
fn iterations_hardly_grow_under_refinement() {
    for contact in [Contact::Stick, Contact::Slip] {
        let counts = [7, 13, 25].map(|side| {
            let blocks = Blocks::new(side, side.div_ceil(2));
            let matrix = blocks.matrix([1.0, 2.0], contact, Top::Held);
            let (_, _, report) = solved(
                &mut Automatic::new(Choice::Iterative),
                (&blocks.partition, &matrix),
                &blocks.load(),
            );
            report.krylov_iterations
        });
        let grows = counts[2] as f64 > 1.3 * counts[1] as f64 + 3.0;
        assert!(!grows && counts[2] <= 25, "{contact:?} {counts:?}");
    }
}

#[test]
fn threads_do_not_change_a_bit() {
    let blocks = Blocks::new(20, 10);
    let matrix = blocks.matrix([1.0, 3.0], Contact::Slip, Top::Free);
    let rhs = blocks.load();
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().unwrap();
        pool.install(|| {
            solved(
                &mut Automatic::new(Choice::Iterative),
                (&blocks.partition, &matrix),
                &rhs,
            )
            .0
        })
    };
    let one = with(1);
    assert!(one == with(2) && one == with(3));
}

#[test]
fn a_body_without_support_is_left_to_the_lu() {
    let blocks = Blocks::new(5, 3);
    let mut matrix = blocks.matrix([1.0, 1.0], Contact::Stick, Top::Held);
    // Far from definite, but not singular.
    for u in blocks.first(Supervariable(90))..blocks.first(Supervariable(100)) {
        matrix.bodies.add(&[u], &[u], &[-40.0]).unwrap();
    }
    let rhs = blocks.load();
    let mut solver = Automatic::new(Choice::Iterative);
    let mut x = vec![0.0; rhs.len()];
    solver.analyse(&blocks.partition).unwrap();
    solver.factor(&matrix).unwrap();
    let report = solver.solve(&matrix, &rhs, &mut x).unwrap();
    assert!(report.backward_error < 1e-12, "{report:?}");
    let again = solver.factor(&matrix).unwrap();
    assert_ne!(again.method, Method::Iterative);
    let reason = again.fall_back;
    let expected = [FallBack::NoPreconditioner, FallBack::NotConverged];
    assert!(reason.is_some_and(|r| expected.contains(&r)), "{reason:?}");
}

#[test]
fn bulks_of_other_than_three_unknowns_are_left_to_direct_solvers() {
    let pair = [[Supervariable(0), Supervariable(1)]];
    let structure = Structure::from_cliques(vec![0, 2, 4], &pair).unwrap();
    let mut matrix = SparseMatrix::zero(&structure);
    (0..4).for_each(|u| matrix.add(&[u], &[u], &[2.0]).unwrap());
    let (x, method, _) = solved(
        &mut Automatic::new(Choice::Iterative),
        (&Partition::from(&structure), &Tangent::from(matrix)),
        &[2.0; 4],
    );
    assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-15));
    assert_eq!(method, Method::Condensed);
}
