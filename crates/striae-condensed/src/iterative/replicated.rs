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
    patches::Surface,
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
    /// Tier in which they are eliminated.
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
    /// unknowns and their rows, 1 for multipliers; `neighbours` are pairs of nodes that
    /// elements couple, by their numbers among the groups with bulk unknowns.
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
        neighbours: &[(u32, u32)],
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
        let contact =
            Contact::factor(&scaled, &constraints, compliance, &Surface::new(neighbours))?;
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

    /// Contribution of a constraint to the bulk.
    ///
    /// # Panics
    /// If there is no constraint of that number.
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

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    /// Three nodes that nothing couples but two constraints, forces that are not adjoint to
    /// them, and a multiplier that follows the second constraint's.
    fn entries() -> Vec<(u32, u32, f64)> {
        let mut entries: Vec<(u32, u32, f64)> = (0..9).map(|u| (u, u, 1.0)).collect();
        entries.extend([(0, 1, 0.2), (1, 0, 0.2), (7, 8, -0.3), (8, 7, -0.3)]);
        let rows = [
            [0.9, 0.1, 0.0, -0.4, 0.2, 0.1, 0.0, 0.0, -0.3],
            [0.0, 0.3, 0.2, 0.5, 0.8, 0.0, -0.6, 0.1, 0.0],
        ];
        for (m, row) in (9..).zip(rows) {
            for (u, g) in (0..).zip(row).filter(|entry| entry.1 != 0.0) {
                entries.push((m, u, g));
                entries.push((u, m, g + 0.05 * f64::from(u % 3)));
            }
        }
        entries.extend([(11, 10, -0.4), (11, 11, 1.0), (4, 11, 0.3), (2, 11, -0.2)]);
        entries.sort_by_key(|entry| (entry.0, entry.1));
        entries
    }

    /// Solves as the preconditioner does and with dense matrices, in which the bodies yield
    /// by `yielded` to forces; the difference over the size.
    fn error(neighbours: &[(u32, u32)], yielded: impl Fn(DMatrix<f64>) -> DMatrix<f64>) -> f64 {
        let group = |bulk: usize, multipliers: usize| Group {
            bulk,
            multipliers,
            tier: Tier(0),
        };
        let groups = [group(3, 0), group(3, 0), group(3, 0), group(0, 3)];
        let entries = entries();
        let (bulk, prescribed) = (vec![1.0; 12], [false; 12]);
        let factors = ContactFactors::new(&groups, &entries, bulk, &prescribed, neighbours);
        let factors = factors.unwrap();
        assert_eq!(factors.constraints(), 2);
        let scaling = factors.scaling();
        let mut matrix = DMatrix::zeros(12, 12);
        for (r, c, a) in entries {
            let (r, c) = (r as usize, c as usize);
            matrix[(r, c)] += scaling.rows[r] * a * scaling.columns[c];
        }
        let view = |at: (usize, usize), size| matrix.view(at, size).into_owned();
        let (c, g) = (view((0, 9), (9, 3)), view((9, 0), (3, 9)));
        let bulk = view((0, 0), (9, 9)).try_inverse().unwrap();
        let mut bulk = yielded(bulk).try_inverse().unwrap();
        for constraint in 0..2 {
            let Stiffening { entries, stiffness } = factors.stiffening(constraint);
            let mut g = DVector::zeros(9);
            for (node, values) in entries {
                (0..3).for_each(|c| g[3 * *node as usize + c] = values[c]);
            }
            bulk += stiffness * &g * g.transpose();
        }
        let (positions, given) = (
            [0.5, -1.0, 0.25, 0.0, 2.0, 0.5, -0.5, 1.0, 0.0],
            [1.0, -2.0, 0.7],
        );
        let schur = view((9, 9), (3, 3)) - &g * bulk.try_inverse().unwrap() * c;
        let rest = DVector::from(given.to_vec()) - &g * DVector::from(positions.to_vec());
        let expected = schur.try_inverse().unwrap() * rest;
        let mut found = given;
        factors.solve(&positions.map(|x| x as f32), &mut found);
        (DVector::from(found.to_vec()) - &expected).norm() / expected.norm()
    }

    /// Bound for the error left by the terms on the diagonals of constraints.
    const REMAINS: f64 = 10.0 * 1e-4;

    #[test]
    fn the_inverse_is_exact_for_nodes_that_only_constraints_couple() {
        let error = error(&[], |inverse| inverse);
        assert!(error < REMAINS, "{error:e}");
    }

    #[test]
    fn the_inverse_is_exact_for_a_patch_that_moves_as_one() {
        // Three nodes, each of which moves by 1 / sqrt(3) in a unit vector, and a stiffness
        // of 1 / sqrt(3).
        let with_patch = |mut inverse: DMatrix<f64>| {
            for (r, c) in (0..81)
                .map(|k| (k / 9, k % 9))
                .filter(|(r, c)| r % 3 == c % 3)
            {
                inverse[(r, c)] += 3.0_f64.sqrt() / 3.0;
            }
            inverse
        };
        let neighbours = [(0, 1), (2, 1), (1, 0)];
        let found = error(&neighbours, with_patch);
        assert!(found < REMAINS, "{found:e}");
        assert!(error(&neighbours, |inverse| inverse) > 0.01);
    }
}
