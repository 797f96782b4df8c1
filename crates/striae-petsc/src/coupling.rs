//! Multipliers and the nodes they couple to, the same on all ranks.

use crate::{
    binding::{Entry, Library, Scatter},
    borders::lay,
    error::Error,
    gathered::Gathered,
    nodes::{NONE, Nodes},
};
use std::{collections::HashMap, sync::Arc};
use striae_condensed::{ContactFactors, Numbering, Partition, Tangent};
use striae_solve::team::Team;
use striae_sparse::{Equilibration, SolveError, Supervariable};

/// Numbers of a node that ranks add up: its block of the bodies, factors, flags.
const SUMMED: usize = 15;

/// Contact and what couples to it.
#[derive(Debug)]
pub(crate) struct Coupling {
    factors: ContactFactors,
    /// Constraints that own nodes are in.
    incident: HashMap<u32, Vec<Incidence>>,
    /// Nodes, numbered over all ranks.
    nodes: Vec<u32>,
    /// Place of each own node among the own ones, with its place here.
    own_nodes: Vec<(u32, u32)>,
    /// Place of each own multiplier among the own unknowns, with its place here.
    own_multipliers: Vec<(u32, u32)>,
    fetch_nodes: Scatter,
    fetch_multipliers: Scatter,
    /// Values at nodes, twice, and of multipliers.
    positions: Vec<f64>,
    single: Vec<f32>,
    multipliers: Vec<f64>,
}

/// A place of a node in a constraint.
#[derive(Clone, Copy, Debug)]
struct Incidence {
    /// Number of the constraint.
    constraint: u32,
    /// Number of the node's entry in it.
    entry: u32,
}

/// A part of a system whose interface is sought.
#[derive(Clone, Copy)]
pub(crate) struct Part<'a> {
    pub(crate) partition: &'a Partition,
    pub(crate) numbering: &'a Numbering,
    pub(crate) nodes: &'a Nodes,
    pub(crate) tangent: &'a Tangent,
    /// Factors of bulk unknowns.
    pub(crate) scaling: &'a [f64],
    pub(crate) prescribed: &'a [bool],
}

impl Coupling {
    /// Makes it of all parts, with the factors that scale multipliers and their rows by the
    /// places of own unknowns. `None` without multipliers. Collective.
    pub(crate) fn new(
        library: &Arc<Library>,
        team: &dyn Team,
        part: Part<'_>,
        scaling: &mut Equilibration,
    ) -> Result<Option<Self>, SolveError> {
        if part.nodes.multipliers == 0 {
            return Ok(None);
        }
        let mut gathered = part.gathered(team);
        let (bulk, prescribed) = part.add_nodes(team, &mut gathered);
        let factors = ContactFactors::new(
            &gathered.groups,
            &gathered.entries,
            bulk,
            &prescribed,
            &part.neighbours(team, &gathered),
        )?;
        let own = &part.numbering.own;
        let mut own_multipliers = Vec::new();
        for (at, &whole) in (0..).zip(&gathered.multipliers) {
            if own.contains(&(whole as usize)) {
                own_multipliers.push((whole - own.start as u32, at));
            }
        }
        let unknowns = gathered.multiplier_unknowns();
        for &(place, at) in &own_multipliers {
            let unknown = unknowns[at as usize] as usize;
            scaling.rows[place as usize] = factors.scaling().rows[unknown];
            scaling.columns[place as usize] = factors.scaling().columns[unknown];
        }
        Ok(Some(Self::of(
            library,
            part,
            gathered,
            (factors, own_multipliers),
        )?))
    }

    fn of(
        library: &Arc<Library>,
        part: Part<'_>,
        gathered: Gathered,
        (factors, own_multipliers): (ContactFactors, Vec<(u32, u32)>),
    ) -> Result<Self, Error> {
        let first = part.nodes.lay.first as u32;
        let own = (0..)
            .zip(&gathered.nodes)
            .filter(|&(_, &node)| part.nodes.is_own(node));
        let own_nodes: Vec<(u32, u32)> = own.map(|(at, &node)| (node - first, at)).collect();
        let places: HashMap<u32, u32> = own_nodes.iter().map(|&(k, at)| (at, k)).collect();
        let mut incident: HashMap<u32, Vec<Incidence>> = HashMap::new();
        for constraint in 0..factors.constraints() {
            for (entry, (at, _)) in (0..).zip(factors.stiffening(constraint).entries) {
                if let Some(&k) = places.get(at) {
                    let constraint = constraint as u32;
                    let place = Incidence { constraint, entry };
                    incident.entry(k).or_default().push(place);
                }
            }
        }
        let wanted: Vec<u32> = gathered
            .nodes
            .iter()
            .flat_map(|&n| 3 * n..3 * n + 3)
            .collect();
        let multipliers = &gathered.multipliers;
        Ok(Self {
            factors,
            incident,
            own_nodes,
            own_multipliers,
            fetch_nodes: Scatter::new(library, part.nodes.lay_of_unknowns(), &wanted)?,
            fetch_multipliers: Scatter::new(library, lay(part.numbering), multipliers)?,
            positions: vec![0.0; wanted.len()],
            single: vec![0.0; wanted.len()],
            multipliers: vec![0.0; multipliers.len()],
            nodes: gathered.nodes,
        })
    }

    /// Adds the stiffness of constraints to the row of an own node.
    pub(crate) fn add_stiffness(&self, node: usize, entries: &mut Vec<Entry<9>>) {
        let Some(incident) = self.incident.get(&(node as u32)) else {
            return;
        };
        for &Incidence { constraint, entry } in incident {
            let added = self.factors.stiffening(constraint as usize);
            let own = added.entries[entry as usize].1;
            for &(at, values) in added.entries {
                let block = std::array::from_fn(|k| added.stiffness * own[k / 3] * values[k % 3]);
                entries.push((self.nodes[at as usize], block));
            }
        }
    }

    /// Solves for the multipliers, `S m = r_m - G_x x`, from the residual by own unknowns and
    /// the displacements of own nodes, and subtracts their forces from `b` at own nodes.
    pub(crate) fn solve(
        &mut self,
        residual: &[f64],
        x: &[f64],
        b: &mut [f64],
    ) -> Result<(), Error> {
        self.fetch_multipliers
            .fetch(residual, &mut self.multipliers)?;
        self.fetch_nodes.fetch(x, &mut self.positions)?;
        let pairs = self.single.iter_mut().zip(&self.positions);
        pairs.for_each(|(single, &x)| *single = x as f32);
        self.factors.solve(&self.single, &mut self.multipliers);
        self.single.fill(0.0);
        self.factors
            .subtract_forces(&self.multipliers, &mut self.single);
        for &(k, at) in &self.own_nodes {
            for component in 0..3 {
                let force = self.single[3 * at as usize + component];
                b[3 * k as usize + component] += f64::from(force);
            }
        }
        Ok(())
    }

    /// Puts the multipliers that were solved for in the places of own ones.
    pub(crate) fn put_multipliers(&self, v: &mut [f64]) {
        for &(place, at) in &self.own_multipliers {
            v[place as usize] = self.multipliers[at as usize];
        }
    }

    /// Entries that are kept.
    pub(crate) fn entries(&self) -> usize {
        self.factors.entries()
    }
}

impl Part<'_> {
    /// Groups with multipliers and all entries in their rows and columns, from all ranks.
    fn gathered(&self, team: &dyn Team) -> Gathered {
        let Self {
            partition, nodes, ..
        } = *self;
        let (mut entries, mut groups) = (Vec::new(), Vec::new());
        for Supervariable(i) in partition.kept() {
            for unknown in partition.group(i) {
                let row = nodes.inner[unknown];
                for (column, a) in self.tangent.row(unknown).filter(|entry| entry.1 != 0.0) {
                    let column = nodes.inner[column];
                    if nodes.is_multiplier(row) || nodes.is_multiplier(column) {
                        entries.extend(row.to_le_bytes());
                        entries.extend(column.to_le_bytes());
                        entries.extend(a.to_le_bytes());
                    }
                }
            }
            let multipliers = partition.multiplier_group(i);
            let whole = &self.numbering.whole;
            if multipliers.is_empty() || !self.numbering.own.contains(&whole[multipliers.start]) {
                continue;
            }
            let tier = partition.tier(Supervariable(i)).0;
            let head = [nodes.of[i], tier, multipliers.len() as u32];
            let each = multipliers.flat_map(|u| [nodes.inner[u], whole[u] as u32]);
            head.into_iter()
                .chain(each)
                .for_each(|word| groups.extend(word.to_le_bytes()));
        }
        let words = |bytes: Vec<u8>| -> Vec<u32> {
            let words = bytes.as_chunks().0.iter();
            words.map(|&word| u32::from_le_bytes(word)).collect()
        };
        let mut gathered = Gathered::new(team.gather(&groups).into_iter().flat_map(words));
        for bytes in team.gather(&entries) {
            for entry in bytes.as_chunks::<16>().0 {
                let word = |at: usize| entry[at..at + 4].first_chunk().copied();
                let value = entry.last_chunk().copied().map_or(0.0, f64::from_le_bytes);
                let [row, column] = [0, 4].map(|at| word(at).map_or(NONE, u32::from_le_bytes));
                gathered.entries.push((row, column, value));
            }
        }
        gathered.add_bare_nodes(nodes);
        gathered
    }

    /// Pairs of gathered nodes that elements couple, by their places.
    fn neighbours(&self, team: &dyn Team, gathered: &Gathered) -> Vec<(u32, u32)> {
        let nodes = self.nodes;
        let place: HashMap<u32, u32> = gathered.nodes.iter().copied().zip(0..).collect();
        let mut pairs = Vec::new();
        for (i, node) in nodes.of.iter().enumerate() {
            let Some(at) = place.get(node) else {
                continue;
            };
            let edges = self.partition.edges(i);
            let bulk = edges.filter(|&edge| self.partition.is_bulk_edge(edge));
            let others = bulk.map(|edge| nodes.of[self.partition.target(edge)]);
            for other in others.filter_map(|other| place.get(&other)) {
                pairs.extend(at.to_le_bytes());
                pairs.extend(other.to_le_bytes());
            }
        }
        let gathered = team.gather(&pairs).into_iter().flatten();
        let gathered: Vec<u8> = gathered.collect();
        let words = gathered.as_chunks::<4>().0.iter();
        let words: Vec<u32> = words.map(|&word| u32::from_le_bytes(word)).collect();
        let pairs = words.as_chunks::<2>().0.iter();
        pairs.map(|&[a, b]| (a, b)).collect()
    }

    /// Adds the blocks of the bodies at nodes, and returns factors of their unknowns and
    /// which are prescribed.
    fn add_nodes(&self, team: &dyn Team, gathered: &mut Gathered) -> (Vec<f64>, Vec<bool>) {
        let Self {
            partition, nodes, ..
        } = *self;
        let place: HashMap<u32, usize> = gathered.nodes.iter().copied().zip(0..).collect();
        let mut summed = vec![0.0; SUMMED * gathered.nodes.len()];
        for i in 0..partition.supervariables() {
            let Some(&at) = place.get(&nodes.of[i]) else {
                continue;
            };
            let summed = &mut summed[SUMMED * at..][..SUMMED];
            for (r, unknown) in partition.bulk_group(i).enumerate() {
                for (c, other) in partition.bulk_group(i).enumerate() {
                    summed[3 * r + c] = self.tangent.bodies.get(unknown, other).unwrap_or(0.0);
                }
                if nodes.is_own(nodes.of[i]) {
                    summed[9 + r] = self.scaling[unknown];
                    summed[12 + r] = f64::from(self.prescribed[unknown]);
                }
            }
        }
        team.sum(&mut summed);
        let end = gathered.end as usize;
        let (mut bulk, mut prescribed) = (vec![1.0; end], vec![false; end]);
        for (node, summed) in gathered.nodes.iter().zip(summed.chunks_exact(SUMMED)) {
            let first = gathered.node_places[node];
            for r in 0..3 {
                bulk[first as usize + r] = summed[9 + r];
                prescribed[first as usize + r] = summed[12 + r] != 0.0;
                for c in 0..3 {
                    let (row, column) = (first + r as u32, first + c as u32);
                    gathered.entries.push((row, column, summed[3 * r + c]));
                }
            }
        }
        gathered.sum();
        (bulk, prescribed)
    }
}
