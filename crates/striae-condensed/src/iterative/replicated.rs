//! The contact part of the preconditioner where the bodies are elsewhere.
//!
//! Ranks that share a system all make the same [`ContactFactors`], from the nodes that
//! multipliers couple to. The bodies, of which each has a part, get the
//! [stiffness](ContactFactors::stiffening) that makes them definite, and are inverted by
//! someone else.

use super::{
    Nodes,
    constraints::{Compliance, Constraint},
    contact::Contact,
    scaled::Scaled,
};
use crate::{entries::Kept, partition::Partition, scaling, tangent::Tangent};
use striae_sparse::{
    CompressedRows, Equilibration, SolveError, SparseMatrix, Structure, StructureError, Tier,
};

/// A supervariable: a node, multipliers, or both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Group {
    /// Unknowns of the bulk, 0 or 3, which come first.
    pub bulk: usize,
    /// Multipliers.
    pub multipliers: usize,
    /// When they are eliminated.
    pub tier: Tier,
}

/// Stiffness `s g^T g` that a constraint adds to the scaled bulk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stiffening<'a> {
    /// `g`, by nodes: the number of each among the groups with bulk unknowns.
    pub entries: &'a [(u32, [f64; 3])],
    /// `s`.
    pub stiffness: f64,
}

/// Couplings of multipliers with the bulk, and factors of their Schur complement.
#[derive(Debug)]
pub struct ContactFactors {
    scaling: Equilibration,
    constraints: Vec<Constraint>,
    contact: Contact,
}

impl ContactFactors {
    /// From groups and the entries between their unknowns, which are numbered group by
    /// group, `(row, column, value)` in rising order of rows and columns. Of those between
    /// bulk unknowns only the ones within a node count. `bulk` are factors that scale bulk
    /// unknowns and their rows, 1 for multipliers.
    ///
    /// # Errors
    /// When the Schur complement has no factors.
    ///
    /// # Panics
    /// When a list does not have one entry an unknown, or entries are in another order.
    pub fn new(
        groups: &[Group],
        entries: &[(u32, u32, f64)],
        bulk: Vec<f64>,
        prescribed: &[bool],
    ) -> Result<Self, SolveError> {
        let partition = partition(groups).map_err(|_| SolveError::NotAnalysed)?;
        assert_eq!(bulk.len(), partition.unknowns(), "one factor an unknown");
        assert_eq!(
            prescribed.len(),
            partition.unknowns(),
            "one flag an unknown"
        );
        let nodes = Nodes::new(&partition).ok_or(SolveError::NotAnalysed)?;
        let tangent = tangent(&partition, entries);
        let kept = Kept::of(&partition);
        let rows = kept.rows(&tangent)?;
        let scaling = scaling::with_multipliers(&partition, bulk, (&kept, &rows));
        let scaled = Scaled {
            nodes: &nodes,
            tangent: &tangent,
            scaling: &scaling,
            prescribed,
        };
        let constraints = Constraint::all(&scaled, &nodes.multipliers);
        let compliance = Compliance::of(&scaled);
        let contact = Contact::factor(&scaled, &constraints, compliance)?;
        Ok(Self {
            scaling,
            constraints,
            contact,
        })
    }

    /// Factors that scale all unknowns and rows.
    pub fn scaling(&self) -> &Equilibration {
        &self.scaling
    }

    /// Number of constraints.
    pub fn constraints(&self) -> usize {
        self.constraints.len()
    }

    /// What a constraint adds to the bulk.
    ///
    /// # Panics
    /// When there is none of that number.
    pub fn stiffening(&self, constraint: usize) -> Stiffening<'_> {
        let constraint = &self.constraints[constraint];
        Stiffening {
            entries: &constraint.entries,
            stiffness: constraint.stiffness,
        }
    }

    /// `m := S^-1 (m - G_x x)` nearly, with scaled multipliers in their order and three unknowns of
    /// every node that has any.
    pub fn solve(&self, x: &[f32], m: &mut [f64]) {
        self.contact.solve(x, m);
    }

    /// `b := b - C m`.
    pub fn subtract_forces(&self, m: &[f64], b: &mut [f32]) {
        self.contact.subtract_forces(m, b);
    }

    /// Entries that are kept.
    pub fn entries(&self) -> usize {
        self.contact.entries()
    }
}

/// Groups that couple nothing but their own unknowns, all kept.
fn partition(groups: &[Group]) -> Result<Partition, StructureError> {
    let mut offsets = vec![0];
    for group in groups {
        offsets.push(offsets[offsets.len() - 1] + group.bulk + group.multipliers);
    }
    let structure = Structure::from_cliques::<Vec<_>>(offsets, &[])?;
    let structure = structure.with_tiers(groups.iter().map(|group| group.tier).collect())?;
    let bulk: Vec<usize> = groups.iter().map(|group| group.bulk).collect();
    let partition = Partition::new(&structure, &bulk).expect("one number a group");
    Ok(partition.with_all_kept())
}

/// Entries within groups as bodies, all others as contact.
fn tangent(partition: &Partition, entries: &[(u32, u32, f64)]) -> Tangent {
    let owner = |unknown: u32| partition.owner(unknown as usize);
    let (own, between): (Vec<_>, Vec<_>) = entries
        .iter()
        .partition(|&&(row, column, _)| owner(row) == owner(column));
    let mut bodies = SparseMatrix::zero(partition.structure());
    for (row, column, value) in own {
        let added = bodies.add(&[row as usize], &[column as usize], &[value]);
        added.expect("groups couple their unknowns");
    }
    let contact = CompressedRows::from_entries(partition.unknowns(), &between);
    Tangent { bodies, contact }
}
