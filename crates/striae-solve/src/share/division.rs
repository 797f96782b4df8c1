//! Division of elements among ranks, and ownership of nodes.
//!
//! Elements of all bodies are the vertices of one graph, which is divided into parts of about equal
//! weight. The weight of an element is its share of its nodes, each node being divided equally
//! among its elements: rows of the system belong to nodes, and so, in meshes of any kind of cell,
//! do the work and memory of elements, as kinds that are smaller meet at a node in larger numbers.
//! Elements with three or more common nodes are neighbours, by a face or by an edge with a midside
//! node, and the number of common nodes is the cost of separating them. Elements on both sides of a
//! contact pair are no neighbours: all ranks hold the contact surfaces, so nothing would be saved.

use striae_mesh::{CellBlock, NodeId};
use striae_sparse::{Neighbourhood, SolveError, divided};

use crate::team::Team;
use striae_model::{Model, node::GlobalNode};

/// Nodes in common from which on elements are neighbours.
const LEAST_COMMON: u8 = 3;
/// Weight of a node: enough for parts of it to be about whole numbers.
const NODE: f64 = 24.0;

/// Division of elements among ranks, and ownership of nodes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Division {
    ranks: usize,
    /// Rank of every element, by body.
    elements: Vec<Vec<u32>>,
    /// Owner of every node of all bodies, one after the other.
    owners: Vec<u32>,
}

impl Division {
    /// Divides a model among so many ranks; the same for the same model.
    ///
    /// # Errors
    /// When the library for graphs fails.
    pub fn new(model: &Model, ranks: usize) -> Result<Self, SolveError> {
        let counts: Vec<usize> = counts(model).collect();
        let mut parts = match ranks {
            0 | 1 => vec![0; counts.iter().sum()],
            _ => divided(graph(model), ranks)?,
        }
        .into_iter();
        let of_body = |count: &usize| parts.by_ref().take(*count).collect();
        Ok(Self::given(
            model,
            ranks.max(1),
            counts.iter().map(of_body).collect(),
        ))
    }

    /// Division that rank 0 makes for all ranks of a team.
    ///
    /// # Errors
    /// If the library for graphs fails.
    pub fn agreed(model: &Model, team: &dyn Team) -> Result<Self, SolveError> {
        let own = match team.rank() {
            0 => Some(Self::new(model, team.size())),
            _ => None,
        };
        let message = match &own {
            Some(Ok(division)) => division.elements.concat().into_iter(),
            // There is always an element more than there are.
            Some(Err(SolveError::Library { code, .. })) => vec![*code as u32].into_iter(),
            Some(Err(_)) => vec![0].into_iter(),
            None => Vec::new().into_iter(),
        };
        let message: Vec<u8> = message.flat_map(u32::to_le_bytes).collect();
        let said = team.gather(&message).swap_remove(0);
        if let Some(own) = own {
            return own;
        }
        let counts: Vec<usize> = counts(model).collect();
        let mut ranks = said
            .as_chunks()
            .0
            .iter()
            .map(|four| u32::from_le_bytes(*four));
        if ranks.len() != counts.iter().sum::<usize>() {
            return Err(SolveError::Library {
                library: "METIS",
                code: ranks.next().unwrap_or(0) as i32,
            });
        }
        let of_body = |count: &usize| ranks.by_ref().take(*count).collect();
        let elements = counts.iter().map(of_body).collect();
        Ok(Self::given(model, team.size(), elements))
    }

    /// The division with these ranks of all elements, by body.
    ///
    /// # Panics
    /// When that is not a rank below `ranks` for every element.
    pub fn given(model: &Model, ranks: usize, elements: Vec<Vec<u32>>) -> Self {
        assert!(
            elements.iter().map(Vec::len).eq(counts(model)),
            "elements have a rank each"
        );
        let known = |rank: &u32| (*rank as usize) < ranks;
        assert!(elements.iter().flatten().all(known), "ranks are known");
        Self {
            owners: owners(model, ranks, &elements),
            ranks,
            elements,
        }
    }

    /// Number of ranks.
    pub fn ranks(&self) -> usize {
        self.ranks
    }

    /// Rank of every element, by body.
    pub fn elements(&self) -> &[Vec<u32>] {
        &self.elements
    }

    /// Owner of every node of all bodies, one body after the other.
    pub fn owners(&self) -> &[u32] {
        &self.owners
    }

    /// Owner of a node of the whole problem, which may be a mass point.
    pub fn owner(&self, node: GlobalNode) -> usize {
        self.owners.get(node.0).map_or(0, |owner| *owner as usize)
    }
}

/// Number of elements of each body.
fn counts(model: &Model) -> impl Iterator<Item = usize> {
    model.bodies.iter().map(|body| body.mesh.element_count())
}

/// Elements of all bodies with their neighbours.
fn graph(model: &Model) -> Neighbourhood {
    let mut graph = Neighbourhood::default();
    let mut first = 0;
    for body in &model.bodies {
        let of_nodes = ElementsOfNodes::new(body.mesh.positions.len(), &body.mesh.blocks);
        let mut common = vec![0_u8; body.mesh.element_count()];
        let mut met: Vec<u32> = Vec::new();
        for (at, corners) in body.mesh.elements().enumerate() {
            for node in corners {
                for &other in of_nodes.of(*node) {
                    if common[other as usize] == 0 {
                        met.push(other);
                    }
                    common[other as usize] += 1;
                }
            }
            let neighbours = met.drain(..).filter_map(|other| {
                let shared = std::mem::take(&mut common[other as usize]);
                let is_one = shared >= LEAST_COMMON && other as usize != at;
                is_one.then_some((first + other, u32::from(shared)))
            });
            let parts = corners.iter().map(|node| of_nodes.of(*node).len() as f64);
            let weight: f64 = parts.map(|count| NODE / count).sum();
            graph.add(weight.round() as u32, neighbours);
        }
        first += common.len() as u32;
    }
    graph
}

/// Elements that have each node as a corner.
struct ElementsOfNodes {
    starts: Vec<u32>,
    elements: Vec<u32>,
}

impl ElementsOfNodes {
    fn new(nodes: usize, blocks: &[CellBlock]) -> Self {
        let mut starts = vec![0; nodes + 1];
        for node in blocks.iter().flat_map(|block| &block.nodes) {
            starts[node.index() + 1] += 1;
        }
        for node in 0..nodes {
            starts[node + 1] += starts[node];
        }
        let mut next = starts.clone();
        let mut elements = vec![0; starts[nodes] as usize];
        let cells = blocks.iter().flat_map(CellBlock::cells);
        for (at, corners) in cells.enumerate() {
            for node in corners {
                let place = &mut next[node.index()];
                elements[*place as usize] = at as u32;
                *place += 1;
            }
        }
        Self { starts, elements }
    }

    fn of(&self, node: NodeId) -> &[u32] {
        let [first, end] = [0, 1].map(|next| self.starts[node.index() + next] as usize);
        &self.elements[first..end]
    }
}

/// Owners of all nodes: of the ranks that have an element of a node the one with most of them,
/// of several as good the one that owns the fewest nodes so far, rank 0 where there is none.
fn owners(model: &Model, ranks: usize, elements: &[Vec<u32>]) -> Vec<u32> {
    const NONE: u32 = u32::MAX;
    const SEVERAL: u32 = u32::MAX - 1;
    let nodes = model.bodies.iter().map(|body| body.mesh.positions.len());
    let mut owners = vec![NONE; nodes.sum()];
    let mut owned = vec![0_usize; ranks];
    let corners = || {
        let mut first = 0;
        let bodies = model.bodies.iter().zip(elements);
        bodies.flat_map(move |(body, ranks)| {
            let start = first;
            first += body.mesh.positions.len();
            let elements = body.mesh.elements().zip(ranks);
            elements.flat_map(move |(corners, rank)| {
                let nodes = corners.iter().map(move |node| start + node.index());
                nodes.map(move |node| (node, *rank))
            })
        })
    };
    for (node, rank) in corners() {
        owners[node] = match owners[node] {
            NONE => rank,
            known if known == rank => rank,
            _ => SEVERAL,
        };
    }
    let mut contested: Vec<(usize, u32)> = corners()
        .filter(|(node, _)| owners[*node] == SEVERAL)
        .collect();
    contested.sort_unstable();
    for owner in &mut owners {
        match *owner {
            SEVERAL => {}
            NONE => *owner = 0,
            rank => owned[rank as usize] += 1,
        }
    }
    for of_node in contested.chunk_by(|a, b| a.0 == b.0) {
        let candidates = of_node.chunk_by(|a, b| a.1 == b.1);
        let best = candidates.min_by_key(|of_rank| {
            let rank = of_rank[0].1;
            (usize::MAX - of_rank.len(), owned[rank as usize], rank)
        });
        if let Some(&[(node, rank), ..]) = best {
            owners[node] = rank;
            owned[rank as usize] += 1;
        }
    }
    owners
}
