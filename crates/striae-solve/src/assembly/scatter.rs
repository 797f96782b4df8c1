//! Blocks in the two parts of the tangent, with ties eliminated, see [`super::ties`], and along the
//! axes of nodes that have their own, see [`striae_model::axes`].

use std::{borrow::Cow, ops::Range};
use striae_contact::segment::Derivatives;
use striae_mesh::Vec3;
use striae_sparse::PlacedBlock;

use super::{System, ties::Tie};
use striae_model::node::GlobalNode;

/// An unknown or an equation before ties are eliminated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slot {
    pub(super) unknown: usize,
    /// Node and component of a position.
    pub(super) position: Option<(GlobalNode, usize)>,
    /// The rigid body on the other side of the pair, whose motion is subtracted.
    pub(super) against: Option<usize>,
}

impl Slot {
    /// Slot of an unknown that is not a position.
    pub(super) fn plain(unknown: usize) -> Self {
        Self {
            unknown,
            position: None,
            against: None,
        }
    }
}

/// Lists that are rebuilt for every block, rows first.
#[derive(Default)]
pub(super) struct Scratch {
    /// Of a contact term.
    pub(super) slots: [Vec<Slot>; 2],
    unknowns: [Vec<usize>; 2],
}

/// A part of the tangent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// Couplings of elements and ties.
    Bodies,
    /// Couplings of contact; all ranks know them.
    Contact,
    /// Couplings of loads on faces that contact covers partly, stored with those of contact.
    Loads,
}

/// Expansion of slots: equations or unknowns, and their weights by slot.
struct Spread {
    targets: Vec<usize>,
    weights: Vec<Vec<(usize, f64)>>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Row,
    Column,
}

impl System<'_> {
    /// Tie of the point of the body on the other side of a position to that body.
    pub(super) fn against(&self, slot: &Slot) -> Option<Tie> {
        let (node, _) = slot.position?;
        let body = self.moving[slot.against?].as_ref()?;
        Some(body.tie(&self.positions[node]))
    }

    /// Adds a block to a part of the tangent, with ties eliminated.
    pub(super) fn scatter(&mut self, part: Part, rows: &[Slot], columns: &[Slot], block: &[f64]) {
        if self.derivatives == Derivatives::None {
            return;
        }
        let tied = |slot: &Slot| {
            let position = slot.position;
            slot.against.is_some() || position.is_some_and(|(node, _)| self.is_bound(node))
        };
        if !rows.iter().chain(columns).any(tied) {
            let mut unknowns = std::mem::take(&mut self.scratch.unknowns);
            for (unknowns, slots) in unknowns.iter_mut().zip([rows, columns]) {
                unknowns.clear();
                unknowns.extend(slots.iter().map(|slot| slot.unknown));
            }
            self.add_block(part, [&unknowns[0], &unknowns[1]], block.into());
            self.scratch.unknowns = unknowns;
            return;
        }
        let rows = self.spread(rows, Kind::Row);
        let columns = self.spread(columns, Kind::Column);
        let width = columns.targets.len();
        let mut spread = vec![0.0; rows.targets.len() * width];
        for (row, row_weights) in rows.weights.iter().enumerate() {
            for (column, column_weights) in columns.weights.iter().enumerate() {
                let value = block[row * columns.weights.len() + column];
                for (at_row, in_row) in row_weights {
                    for (at_column, in_column) in column_weights {
                        spread[at_row * width + at_column] += in_row * in_column * value;
                    }
                }
            }
        }
        self.add_block(part, [&rows.targets, &columns.targets], spread.into());
    }

    /// Adds a block of unknowns to a part of the tangent.
    fn add_block(&mut self, part: Part, [rows, columns]: [&[usize]; 2], values: Cow<[f64]>) {
        match part {
            Part::Bodies => {
                let added = self.matrix.add(rows, columns, &values);
                added.expect("what elements and ties couple is in the pattern of the bodies");
            }
            Part::Contact | Part::Loads => {
                let rows = rows.iter().copied().zip(0..);
                let is_added = |row: &(usize, usize)| part == Part::Loads || self.owns(row.0);
                self.blocks.push(PlacedBlock {
                    rows: rows.filter(is_added).collect(),
                    columns: self.runs(columns),
                    values: values.into_owned().into(),
                });
            }
        }
    }

    /// Unknowns in runs of one supervariable each.
    fn runs(&self, unknowns: &[usize]) -> Vec<Range<usize>> {
        let mut runs: Vec<Range<usize>> = Vec::with_capacity(unknowns.len() / 3 + 1);
        for &unknown in unknowns {
            match runs.last_mut() {
                Some(run) if run.end == unknown && self.are_together(run.start, unknown) => {
                    run.end += 1;
                }
                _ => runs.push(unknown..unknown + 1),
            }
        }
        runs
    }

    fn are_together(&self, a: usize, b: usize) -> bool {
        let structure = self.matrix.structure();
        structure.owner(a) == structure.owner(b)
    }

    fn spread(&self, slots: &[Slot], kind: Kind) -> Spread {
        let followed: Vec<Vec<(usize, f64)>> =
            slots.iter().map(|slot| self.followed(slot, kind)).collect();
        let mut targets: Vec<usize> = followed.iter().flatten().map(|entry| entry.0).collect();
        targets.sort_unstable();
        targets.dedup();
        let at = |unknown: usize| targets.partition_point(|&target| target < unknown);
        let weights = followed
            .into_iter()
            .map(|entries| entries.into_iter().map(|(u, w)| (at(u), w)).collect())
            .collect();
        Spread { targets, weights }
    }

    /// Equations or unknowns that a slot stands for, with weights.
    fn followed(&self, slot: &Slot, kind: Kind) -> Vec<(usize, f64)> {
        let Some((node, axis)) = slot.position else {
            return vec![(slot.unknown, 1.0)];
        };
        let mut entries = Vec::with_capacity(1);
        match self.context.problem.ties.followed(node, axis) {
            Some(followed) => {
                for &(node, weight) in followed {
                    self.of_position((node, axis), kind, weight, &mut entries);
                }
            }
            None => self.of_position((node, axis), kind, 1.0, &mut entries),
        }
        if let Some(against) = self.against(slot) {
            entries.extend(self.followed_tie(&against, axis, kind, -1.0));
        }
        entries
    }

    /// Unknowns that a position without dependence on other nodes stands for, times a weight: the
    /// components along its axes of a node that has its own.
    fn of_position(
        &self,
        (node, axis): (GlobalNode, usize),
        kind: Kind,
        weight: f64,
        entries: &mut Vec<(usize, f64)>,
    ) {
        if let Some(frame) = self.context.turned.frame(node) {
            let first = self.layout.position(node);
            for own in 0..3 {
                let along = frame.axes()[(axis, own)];
                let is_held = kind == Kind::Row && self.context.fixed[node.component(own)];
                if along != 0.0 && !is_held {
                    entries.push((first + own, weight * along));
                }
            }
            return;
        }
        match self.tie(node) {
            Some(tie) => entries.extend(self.followed_tie(tie, axis, kind, weight)),
            None if kind == Kind::Row && self.context.fixed[node.component(axis)] => {}
            None => entries.push((self.layout.position(node) + axis, weight)),
        }
    }

    /// The coordinates of a body that a component of a position follows, with
    /// weights times `sign`.
    fn followed_tie(&self, tie: &Tie, axis: usize, kind: Kind, sign: f64) -> Vec<(usize, f64)> {
        let mut entries = Vec::with_capacity(4);
        entries.push((tie.first + axis, sign));
        for turn in 0..3 {
            let spin = match kind {
                Kind::Row => Vec3::ith(turn, 1.0),
                Kind::Column => tie.tangent.column(turn).into(),
            };
            let weight = sign * spin.cross(&tie.arm)[axis];
            if weight != 0.0 {
                entries.push((tie.first + 3 + turn, weight));
            }
        }
        if kind == Kind::Row {
            let fixed = &self.context.fixed_rigid[tie.rigid];
            entries.retain(|(unknown, _)| !fixed[unknown - tie.first]);
        }
        entries
    }
}
