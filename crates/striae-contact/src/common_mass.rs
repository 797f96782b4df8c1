//! Common mass of both surfaces, in an order of the nodes that depends neither on
//! sides nor on numbers.
//!
//! ```text
//! D_kJ = integral N_k N_J over all common polygons,   w_k = integral N_k
//! ```
//!
//! Sums of floating-point numbers depend on their order, and so would choices made from them. Nodes
//! are therefore ordered by position first; of two sides with nodes at the same places, the one
//! whose sorted nodes come first goes first. Only surfaces that are equal to the last bit are
//! distinguished by their label, and then nothing but the label differs.

use std::cmp::Ordering;

use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use crate::{
    interface::{Interface, InterfaceNode, Opponent},
    side::Side,
};

/// Weight below which a node carries nothing, over the area of its largest facet.
const WEIGHTLESS: f64 = 1e-12;

/// Entries of a row by column, sorted.
pub(crate) type SparseRow = Vec<(u32, f64)>;

/// Common mass and what follows from it at once.
pub(crate) struct CommonMass {
    /// Side and number of all nodes that matter, in order.
    pub nodes: Vec<(Side, SurfaceNode)>,
    /// Place of a node in the order.
    pub index: [Vec<Option<u32>>; 2],
    /// `D_kJ`.
    pub rows: Vec<SparseRow>,
    /// Rows integrated over whole facets, against a rigid surface only.
    pub whole: Vec<SparseRow>,
    /// `w_k`.
    pub weights: Vec<f64>,
    /// `true` for nodes with nonzero weight, which are candidates.
    pub weighted: Vec<bool>,
    /// `true` for nodes that carry traction.
    pub carries: Vec<bool>,
    /// Patch of a node, `None` without an overlap.
    pub patch: Vec<Option<u32>>,
    /// The side that goes first among equals.
    first: Side,
}

impl CommonMass {
    /// Sums the overlaps up.
    pub fn new(interface: &Interface) -> Self {
        let sides = interface.facets();
        let carried = carriers(interface);
        let wanted = with_neighbours(interface, &carried);
        let (nodes, first) = ordered(interface, &wanted);
        let mut index = Side::BOTH.map(|side| vec![None; interface.nodes[side].len()]);
        for (at, &(side, node)) in nodes.iter().enumerate() {
            index[side][node] = Some(at as u32);
        }
        let place =
            |side: Side, node: SurfaceNode| index[side][node].expect("corners are in the order");
        let corners = |overlap: usize| {
            let of = interface.overlaps[overlap].corners;
            let facets = sides.iter().zip(of);
            facets
                .flat_map(|(&side, corners)| corners.map(|node| place(side, node)))
                .collect()
        };
        let common = |source: usize, c: usize, d: usize| interface.overlaps[source].mass[c][d];
        let polygons = blocks(interface.overlaps.len(), corners, common);
        let rows = sums(nodes.len(), &polygons, common);
        let whole = match interface.opponent {
            Opponent::Deformable | Opponent::Itself { .. } => Vec::new(),
            Opponent::Rigid { whole } => {
                let near: Vec<_> = whole
                    .iter()
                    .filter(|facet| facet.corners.iter().any(|&node| carried[0][node]))
                    .collect();
                let corners =
                    |facet: usize| near[facet].corners.map(|node| place(Side::A, node)).into();
                let mass = |facet: usize, c: usize, d: usize| near[facet].mass[c][d];
                sums(nodes.len(), &blocks(near.len(), corners, mass), mass)
            }
        };
        let is_itself = matches!(interface.opponent, Opponent::Itself { .. });
        let weights: Vec<f64> = (0..nodes.len())
            .map(|k| {
                if is_itself {
                    // The functions of both facets sum up to one.
                    return 0.5 * rows[k].iter().map(|(_, mass)| mass).sum::<f64>();
                }
                let own = |&&(l, _): &&(u32, f64)| nodes[l as usize].0 == nodes[k].0;
                rows[k].iter().filter(own).map(|(_, mass)| mass).sum()
            })
            .collect();
        let areas = largest_facets(interface, &index, nodes.len());
        Self {
            weighted: (0..nodes.len())
                .map(|k| weights[k] > WEIGHTLESS * areas[k])
                .collect(),
            carries: nodes
                .iter()
                .map(|&(side, node)| carried[side][node])
                .collect(),
            patch: patches(nodes.len(), &polygons),
            nodes,
            index,
            rows,
            whole,
            weights,
            first,
        }
    }

    /// Key of a node among those at the same place: its side's turn, then its own.
    pub fn precedence(&self, k: u32) -> (bool, u32) {
        (self.nodes[k as usize].0 != self.first, k)
    }

    /// Node at a place in the order.
    pub fn node<'a>(&self, interface: &Interface<'a>, k: u32) -> &'a InterfaceNode {
        let (side, node) = self.nodes[k as usize];
        &interface.nodes[side][node]
    }
}

/// Nodes that carry traction: corners of overlaps and all within reach.
fn carriers(interface: &Interface) -> [Vec<bool>; 2] {
    let mut carried = Side::BOTH.map(|side| vec![false; interface.nodes[side].len()]);
    for overlap in interface.overlaps {
        for (&side, corners) in interface.facets().iter().zip(overlap.corners) {
            for node in corners {
                carried[side][node] = true;
            }
        }
    }
    for &side in interface.sides() {
        for (node, opposing) in interface.opposing[side].iter().enumerate() {
            carried[side][node] |= opposing.is_some();
        }
    }
    carried
}

/// Carrying nodes and, against a rigid surface, their neighbours.
fn with_neighbours(interface: &Interface, carried: &[Vec<bool>; 2]) -> [Vec<bool>; 2] {
    let mut wanted = carried.clone();
    if let Opponent::Rigid { whole } = interface.opponent {
        for facet in whole {
            if facet.corners.iter().any(|&node| carried[0][node]) {
                for node in facet.corners {
                    wanted[0][node] = true;
                }
            }
        }
    }
    wanted
}

/// Nodes by position and the side that goes first; see the module.
fn ordered(interface: &Interface, wanted: &[Vec<bool>; 2]) -> (Vec<(Side, SurfaceNode)>, Side) {
    let traits = |&(side, node): &(Side, SurfaceNode)| {
        let node = &interface.nodes[side][node];
        let [x, y, z] = node.position.into();
        [x, y, z, node.flexibility, node.compliance]
    };
    let compare = |a: &(Side, SurfaceNode), b: &(Side, SurfaceNode)| {
        let (a, b) = (traits(a), traits(b));
        let by_trait = a.iter().zip(&b).map(|(a, b)| a.total_cmp(b));
        by_trait.fold(Ordering::Equal, Ordering::then)
    };
    let of_side = Side::BOTH.map(|side| {
        let mut nodes: Vec<_> = SurfaceNode::all(wanted[side].len())
            .filter(|&node| wanted[side][node])
            .map(|node| (side, node))
            .collect();
        nodes.sort_by(compare);
        nodes
    });
    let differ = of_side[0]
        .iter()
        .zip(&of_side[1])
        .map(|(a, b)| compare(a, b));
    let sides = differ
        .fold(Ordering::Equal, Ordering::then)
        .then(of_side[0].len().cmp(&of_side[1].len()));
    let first = match sides {
        Ordering::Greater => Side::B,
        Ordering::Less | Ordering::Equal => Side::A,
    };
    let mut all = [of_side[first].as_slice(), &of_side[first.opposite()]].concat();
    all.sort_by(compare);
    (all, first)
}

/// Corners of a polygon in order.
struct Block {
    nodes: Vec<u32>,
    /// Positions in the polygon's own mass.
    from: Vec<u8>,
    source: usize,
}

/// Polygons by their corners; those with the same corners, as one facet has with many
/// of a rigid surface, by their mass.
fn blocks(
    count: usize,
    corners: impl Fn(usize) -> Vec<u32>,
    mass: impl Fn(usize, usize, usize) -> f64,
) -> Vec<Block> {
    let block = |source| {
        let corners = corners(source);
        let mut from: Vec<u8> = (0..corners.len() as u8).collect();
        from.sort_by_key(|&c| corners[c as usize]);
        Block {
            nodes: from.iter().map(|&c| corners[c as usize]).collect(),
            from,
            source,
        }
    };
    let mut blocks: Vec<_> = (0..count).map(block).collect();
    let masses = |block: &Block| {
        let all = block
            .from
            .iter()
            .flat_map(|&c| block.from.iter().map(move |&d| (c, d)));
        let of = |(c, d)| mass(block.source, usize::from(c), usize::from(d));
        all.map(of).collect::<Vec<f64>>()
    };
    blocks.sort_by(|a, b| {
        a.nodes.cmp(&b.nodes).then_with(|| {
            let pairs = masses(a).into_iter().zip(masses(b));
            let by_mass = pairs.map(|(a, b)| a.total_cmp(&b));
            by_mass.fold(Ordering::Equal, Ordering::then)
        })
    });
    blocks
}

fn sums(
    count: usize,
    blocks: &[Block],
    mass: impl Fn(usize, usize, usize) -> f64,
) -> Vec<SparseRow> {
    let mut touching = vec![Vec::new(); count];
    for block in blocks {
        for (c, &node) in block.nodes.iter().enumerate() {
            touching[node as usize].push((block, c));
        }
    }
    let mut sum = SparseSum::new(count);
    let row = |touching: &Vec<(&Block, usize)>| {
        for &(block, c) in touching {
            for (d, &other) in block.nodes.iter().enumerate() {
                let value = mass(block.source, block.from[c] as usize, block.from[d] as usize);
                if value != 0.0 {
                    sum.add(other, value);
                }
            }
        }
        sum.take()
    };
    touching.iter().map(row).collect()
}

/// Area of the largest facet with an overlap at every node.
fn largest_facets(interface: &Interface, index: &[Vec<Option<u32>>; 2], count: usize) -> Vec<f64> {
    let mut areas = vec![0.0_f64; count];
    for overlap in interface.overlaps {
        for (&side, corners) in interface.facets().iter().zip(overlap.corners) {
            let x: [Vec3; 4] = corners.map(|node| interface.nodes[side][node].position);
            let area = 0.5 * (x[2] - x[0]).cross(&(x[3] - x[1])).norm();
            for node in corners {
                if let Some(k) = index[side][node] {
                    areas[k as usize] = areas[k as usize].max(area);
                }
            }
        }
    }
    areas
}

/// Patches: nodes that overlaps connect, named by their first node.
fn patches(count: usize, blocks: &[Block]) -> Vec<Option<u32>> {
    let mut parent: Vec<u32> = (0..count as u32).collect();
    fn root(parent: &mut [u32], mut k: u32) -> u32 {
        while parent[k as usize] != k {
            parent[k as usize] = parent[parent[k as usize] as usize];
            k = parent[k as usize];
        }
        k
    }
    let mut touched = vec![false; count];
    for block in blocks {
        let first = root(&mut parent, block.nodes[0]);
        for &node in &block.nodes {
            touched[node as usize] = true;
            let other = root(&mut parent, node);
            let first = root(&mut parent, first);
            let (low, high) = (first.min(other), first.max(other));
            parent[high as usize] = low;
        }
    }
    (0..count as u32)
        .map(|k| touched[k as usize].then(|| root(&mut parent, k)))
        .collect()
}

/// Sum of sparse rows.
pub(crate) struct SparseSum {
    values: Vec<f64>,
    seen: Vec<bool>,
    touched: Vec<u32>,
}

impl SparseSum {
    /// Nothing, of so many columns.
    pub fn new(columns: usize) -> Self {
        Self {
            values: vec![0.0; columns],
            seen: vec![false; columns],
            touched: Vec::new(),
        }
    }

    /// Adds to an entry.
    pub fn add(&mut self, column: u32, value: f64) {
        if !self.seen[column as usize] {
            self.seen[column as usize] = true;
            self.touched.push(column);
        }
        self.values[column as usize] += value;
    }

    /// The row, after which the sum is zero.
    pub fn take(&mut self) -> SparseRow {
        self.touched.sort_unstable();
        let row = self.touched.iter().map(|&column| {
            self.seen[column as usize] = false;
            (column, std::mem::take(&mut self.values[column as usize]))
        });
        let row = row.collect();
        self.touched.clear();
        row
    }
}

/// Number of the cluster of every value: neighbours nearer than the tolerance share one.
pub(crate) fn ranks(values: &[f64], tolerance: f64) -> Vec<u32> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let mut ranks = vec![0; values.len()];
    let mut rank = 0;
    for pair in order.windows(2) {
        if values[pair[1]] - values[pair[0]] > tolerance {
            rank += 1;
        }
        ranks[pair[1]] = rank;
    }
    ranks
}
