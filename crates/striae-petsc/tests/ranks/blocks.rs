//! Two elastic blocks in contact, one above the other, divided between ranks.

use striae_condensed::{Numbering, Partition, Tangent};
use striae_sparse::{PlacedBlock, SparseMatrix, Structure, Supervariable};

#[path = "../../../striae-sparse/tests/elastic/mod.rs"]
mod elastic;

/// Effect of the lower block's face on the upper one's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contact {
    Stick,
    /// With friction at every node of the left half.
    Slip,
    /// The left half does not touch.
    Open,
}

/// Support of the upper block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Top {
    Held,
    /// By contact alone.
    Free,
    /// Not at all, as there is no contact either.
    Loose,
}

/// Blocks of `side x side x height` nodes each; the lower one carries three multipliers at
/// each node of its upper face.
#[derive(Clone, Copy, Debug)]
pub struct Blocks {
    pub side: usize,
    pub height: usize,
    pub stiffness: [f64; 2],
    pub contact: Contact,
    pub top: Top,
    /// Slices that each rank has of a block.
    pub slices: usize,
}

/// Data held by one rank.
pub struct Part {
    pub partition: Partition,
    pub numbering: Numbering,
    pub tangent: Tangent,
    /// Values of the whole right-hand side.
    pub rhs: Vec<f64>,
    /// `true` for unknowns that are positions.
    pub is_position: Vec<bool>,
    /// Number of each unknown when one rank has all.
    pub serial: Vec<usize>,
}

/// A rank, and how many there are.
#[derive(Clone, Copy)]
pub struct Rank(pub usize, pub usize);

impl Blocks {
    fn area(&self) -> usize {
        self.side * self.side
    }

    fn nodes(&self) -> usize {
        2 * self.height * self.area()
    }

    fn size(&self, node: usize) -> usize {
        if node / self.area() == self.height - 1 {
            6
        } else {
            3
        }
    }

    /// Cells of a block, with the rank that has each: slices along the first axis, in turn.
    fn cells(&self, block: usize, ranks: usize) -> Vec<(usize, [usize; 8])> {
        let (side, height) = (self.side, self.height);
        let mut cells = Vec::new();
        for z in block * height..block * height + height - 1 {
            for y in 0..side - 1 {
                for x in 0..side - 1 {
                    let cell = [0, 1, 2, 3, 4, 5, 6, 7].map(|k| {
                        let (x, y, z) = (x + (k & 1), y + (k >> 1 & 1), z + (k >> 2));
                        x + side * (y + side * z)
                    });
                    cells.push((x * ranks * self.slices / (side - 1) % ranks, cell));
                }
            }
        }
        cells
    }

    /// Rank that owns each node: the first that has a cell with it.
    fn owners(&self, ranks: usize) -> Vec<usize> {
        let mut owners = vec![usize::MAX; self.nodes()];
        for block in 0..2 {
            for (rank, cell) in self.cells(block, ranks) {
                cell.iter().for_each(|&n| owners[n] = owners[n].min(rank));
            }
        }
        owners
    }

    /// Each node of the lower face with four of the upper one.
    fn ties(&self) -> Vec<[usize; 5]> {
        let (side, height, area) = (self.side, self.height, self.area());
        let tie = |k: usize| {
            let (x, y) = ((k % side).min(side - 2), (k / side).min(side - 2));
            let above = |dx: usize, dy: usize| x + dx + side * (y + dy) + height * area;
            let own = k + (height - 1) * area;
            [own, above(0, 0), above(1, 0), above(0, 1), above(1, 1)]
        };
        (0..area).map(tie).collect()
    }

    /// The part of a rank: its cells, and all nodes of both faces.
    pub fn part(&self, Rank(rank, ranks): Rank) -> Part {
        let owners = self.owners(ranks);
        let (area, height) = (self.area(), self.height);
        let cells: Vec<(usize, [usize; 8])> = (0..2)
            .flat_map(|block| {
                self.cells(block, ranks)
                    .into_iter()
                    .map(move |c| (block, c))
            })
            .filter(|(_, (owner, _))| *owner == rank)
            .map(|(block, (_, cell))| (block, cell))
            .collect();
        let mut is_here = vec![false; self.nodes()];
        is_here[(height - 1) * area..(height + 1) * area].fill(true);
        cells
            .iter()
            .flat_map(|c| c.1)
            .for_each(|n| is_here[n] = true);
        let here: Vec<usize> = (0..self.nodes()).filter(|&n| is_here[n]).collect();
        let mut local = vec![usize::MAX; self.nodes()];
        here.iter().zip(0..).for_each(|(&n, k)| local[n] = k);
        let (partition, offsets) = self.partition(&here, &local, &cells);
        let first = |n: usize| offsets[local[n]];
        let is_held = |n: usize| n < area || self.top == Top::Held && n >= self.nodes() - area;
        let mut bodies = SparseMatrix::zero(partition.structure());
        for block in 0..2 {
            let shear = self.stiffness[block];
            let values = elastic::cell(1.5 * shear, shear, 1.0);
            for (_, cell) in cells.iter().filter(|c| c.0 == block) {
                let unknowns: Vec<usize> =
                    cell.iter().flat_map(|&n| first(n)..first(n) + 3).collect();
                let kept: Vec<usize> = (0..24).filter(|&a| !is_held(cell[a / 3])).collect();
                let rows: Vec<usize> = kept.iter().map(|&a| unknowns[a]).collect();
                let entries = kept.iter().flat_map(|a| &values[24 * a..24 * a + 24]);
                let entries: Vec<f64> = entries.copied().collect();
                bodies.add(&rows, &unknowns, &entries).unwrap();
            }
        }
        for &n in here.iter().filter(|&&n| is_held(n) && owners[n] == rank) {
            for u in first(n)..first(n) + 3 {
                bodies.add(&[u], &[u], &[self.stiffness[0]]).unwrap();
            }
        }
        let blocks: Vec<PlacedBlock> = self
            .ties()
            .iter()
            .flat_map(|tie| self.tie(tie, &first, &|n: usize| owners[n] == rank))
            .collect();
        let contact = partition.gathered(&blocks).unwrap();
        let (numbering, serial) = self.numbering(&here, &owners, Rank(rank, ranks));
        let load = |n: usize, c: usize| match c {
            3.. => 0.0,
            _ if n < area || n >= self.nodes() - area => 0.0,
            c => [0.3, 0.1, -1.0][c] + ((21 * n + 8 * c) % 13) as f64 / 13.0,
        };
        let each = || {
            here.iter()
                .flat_map(|&n| (0..self.size(n)).map(move |c| (n, c)))
        };
        Part {
            rhs: each().map(|(n, c)| load(n, c)).collect(),
            is_position: each().map(|(_, c)| c < 3).collect(),
            tangent: Tangent { bodies, contact },
            partition: partition.numbered(numbering.clone()),
            numbering,
            serial,
        }
    }

    fn partition(
        &self,
        here: &[usize],
        local: &[usize],
        cells: &[(usize, [usize; 8])],
    ) -> (Partition, Vec<usize>) {
        let mut offsets = vec![0];
        for &n in here {
            offsets.push(offsets[offsets.len() - 1] + self.size(n));
        }
        let cliques: Vec<Vec<Supervariable>> = cells
            .iter()
            .map(|(_, cell)| cell.iter().map(|&n| Supervariable(local[n])).collect())
            .collect();
        let structure = Structure::from_cliques(offsets.clone(), &cliques).unwrap();
        let points = here.iter().map(|&n| {
            let z = n / self.area();
            let layer = if z < self.height { z } else { z - 1 };
            [n % self.side, n / self.side % self.side, layer].map(|x| x as f64)
        });
        let ties = self.ties();
        let ties = ties
            .iter()
            .map(|tie| tie.iter().map(|&n| Supervariable(local[n])).collect());
        let partition = Partition::new(&structure, &vec![3; here.len()])
            .and_then(|partition| partition.with_points(points.collect()))
            .unwrap();
        (partition.grown(&ties.collect()).unwrap(), offsets)
    }

    /// Numbers rank by rank, and those of a rank that has all.
    fn numbering(
        &self,
        here: &[usize],
        owners: &[usize],
        Rank(rank, ranks): Rank,
    ) -> (Numbering, Vec<usize>) {
        let mut first = vec![0; self.nodes()];
        let (mut count, mut own) = (0, 0..0);
        for owner in 0..ranks {
            let start = count;
            for n in (0..self.nodes()).filter(|&n| owners[n] == owner) {
                first[n] = count;
                count += self.size(n);
            }
            if owner == rank {
                own = start..count;
            }
        }
        let mut serial = vec![0];
        for n in 0..self.nodes() {
            serial.push(serial[n] + self.size(n));
        }
        let unknowns = |starts: &[usize]| -> Vec<usize> {
            let each = here
                .iter()
                .flat_map(|&n| starts[n]..starts[n] + self.size(n));
            each.collect()
        };
        let whole = unknowns(&first);
        let numbering = Numbering { count, own, whole };
        (numbering, unknowns(&serial))
    }

    /// Normal and tangential rows of one node; forces act on the nodes it is tied to. Only
    /// rows of nodes that are owned.
    fn tie(
        &self,
        tie: &[usize; 5],
        first: &dyn Fn(usize) -> usize,
        owns: &dyn Fn(usize) -> bool,
    ) -> Vec<PlacedBlock<'static>> {
        let multiplier = first(tie[0]) + 3;
        let is_left = tie[0] % self.side < self.side / 2;
        let mut blocks = Vec::new();
        let mut add = |node: usize, row: usize, column: usize, value: f64| {
            if owns(node) {
                blocks.push(PlacedBlock {
                    rows: vec![(row, 0)],
                    columns: std::iter::once(column..column + 1).collect(),
                    values: vec![value].into(),
                });
            }
        };
        for c in 0..3 {
            let (row, is_normal) = (multiplier + c, c == 2);
            let is_open = self.top == Top::Loose || self.contact == Contact::Open && is_left;
            let slips = self.contact == Contact::Slip && is_left && !is_normal && !is_open;
            if is_open || slips {
                add(tie[0], row, row, 1.0);
            }
            if slips {
                add(tie[0], row, multiplier + 2, -0.3);
            }
            for (k, &node) in tie.iter().enumerate() {
                let weight = if k == 0 { 1.0 } else { -0.25 };
                let u = first(node) + c;
                add(node, u, row, 0.01 * weight);
                if !is_open && !slips {
                    add(tie[0], row, u, weight);
                }
            }
        }
        blocks
    }
}
