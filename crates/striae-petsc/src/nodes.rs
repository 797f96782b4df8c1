//! Nodes of three unknowns and multipliers, numbered over all ranks.
//!
//! *Inner* numbers have the bulk first: `3 node + component`, and multipliers after all
//! nodes. Of nodes and of multipliers every rank owns a range.

use crate::{binding::Lay, borders::Borders, error::Error, foreign::starts};
use striae_condensed::{Numbering, Partition};
use striae_solve::team::Team;

/// Not a node.
pub(crate) const NONE: u32 = u32::MAX;

/// Inner numbers.
#[derive(Debug)]
pub(crate) struct Nodes {
    /// Nodes on the ranks.
    pub(crate) lay: Lay,
    /// First node of every rank, and the end.
    pub(crate) starts: Vec<usize>,
    /// Multipliers of all ranks.
    pub(crate) multipliers: usize,
    /// Supervariable of each of this rank's nodes.
    pub(crate) supervariables: Vec<u32>,
    /// Node of each supervariable, [`NONE`] without bulk unknowns.
    pub(crate) of: Vec<u32>,
    /// Inner number of each unknown of the part.
    pub(crate) inner: Vec<u32>,
    /// Places of the bulk unknowns of own nodes among all own unknowns.
    pub(crate) places: Vec<u32>,
}

/// Returns whether a part can be numbered by nodes: each supervariable has three bulk unknowns or
/// none.
pub(crate) fn is_nodal(partition: &Partition) -> bool {
    (0..partition.supervariables()).all(|i| [0, 3].contains(&partition.bulk_group(i).len()))
}

impl Nodes {
    /// Numbers of a part that can be seen by nodes. Collective.
    pub(crate) fn new(
        team: &dyn Team,
        partition: &Partition,
        numbering: &Numbering,
        borders: &mut Borders,
    ) -> Result<Self, Error> {
        let is_own = |unknown: usize| numbering.own.contains(&numbering.whole[unknown]);
        let has_bulk = |&i: &usize| !partition.bulk_group(i).is_empty();
        let all = 0..partition.supervariables();
        let mut own: Vec<usize> = all.clone().filter(has_bulk).collect();
        own.retain(|&i| is_own(partition.bulk_group(i).start));
        own.sort_by_key(|&i| numbering.whole[partition.bulk_group(i).start]);
        let groups = all.clone().map(|i| partition.multiplier_group(i));
        let mut multipliers: Vec<usize> = groups.flatten().filter(|&u| is_own(u)).collect();
        multipliers.sort_by_key(|&u| numbering.whole[u]);
        let starts_of_nodes = starts(team, own.len());
        let starts_of_multipliers = starts(team, multipliers.len());
        let lay = Lay {
            first: starts_of_nodes[team.rank()],
            own: own.len(),
            total: starts_of_nodes[team.size()],
        };
        let place = |unknown: usize| numbering.whole[unknown] - numbering.own.start;
        let mut numbers = vec![0.0; numbering.own.len()];
        let mut places = Vec::with_capacity(3 * own.len());
        for (node, &i) in (lay.first..).zip(&own) {
            for (component, unknown) in partition.bulk_group(i).enumerate() {
                numbers[place(unknown)] = (3 * node + component) as f64;
                places.push(place(unknown) as u32);
            }
        }
        let first = 3 * lay.total + starts_of_multipliers[team.rank()];
        for (number, &unknown) in (first..).zip(&multipliers) {
            numbers[place(unknown)] = number as f64;
        }
        let mut inner = vec![0.0; numbering.whole.len()];
        borders.spread(&numbers, &mut inner)?;
        let inner: Vec<u32> = inner.into_iter().map(|number| number as u32).collect();
        let of = all.map(|i| match partition.bulk_group(i) {
            bulk if bulk.is_empty() => NONE,
            bulk => inner[bulk.start] / 3,
        });
        Ok(Self {
            lay,
            starts: starts_of_nodes,
            multipliers: starts_of_multipliers[team.size()],
            supervariables: own.into_iter().map(|i| i as u32).collect(),
            of: of.collect(),
            inner,
            places,
        })
    }

    /// Returns whether an inner number is that of a multiplier.
    pub(crate) fn is_multiplier(&self, inner: u32) -> bool {
        inner as usize >= 3 * self.lay.total
    }

    /// Returns whether this rank owns a node.
    pub(crate) fn is_own(&self, node: u32) -> bool {
        (self.lay.first..self.lay.first + self.lay.own).contains(&(node as usize))
    }

    /// Layout in unknowns instead of nodes.
    pub(crate) fn lay_of_unknowns(&self) -> Lay {
        Lay {
            first: 3 * self.lay.first,
            own: 3 * self.lay.own,
            total: 3 * self.lay.total,
        }
    }
}
