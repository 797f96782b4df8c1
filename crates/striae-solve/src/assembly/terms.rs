//! Contact terms in the system, and what they do to rigid bodies.
//!
//! The force `f` on a node at `x` pushes the rigid body on the other side of the pair, whose
//! reference point is at `c`, back with `-f` and `-(x - c) x f`. A term has no coordinates of the
//! body: its equations hold relative to the body. If the body and the nodes of the term were moved
//! alike by `du` and turned by `dphi`, gaps, slip and traction components would stay and forces
//! turn along, so that
//!
//! ```text
//! dr = dr/dx (dx - du - dphi x (x - c))                      of gaps, slip, tractions
//! df = df/dx (dx - du - dphi x (x - c)) + dphi x f           of forces
//! d((x - c) x f) = (dx - du) x f + (x - c) x df
//! ```
//!
//! A load on what the body leaves uncovered pushes nothing; one of fixed direction
//! does not turn.

use nalgebra::Matrix3;
use striae_contact::{
    configuration::Configuration, segment::Derivatives, side::Side, term::LocalTerm,
    unknown::Unknown,
};
use striae_mesh::Vec3;
use striae_sparse::Supervariable;
use striae_surface::node::SurfaceNode;

use super::{
    System,
    scatter::{Part, Slot},
    ties::Tie,
};
use striae_model::node::GlobalNode;

/// Reaction to the forces of a term.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Answer {
    /// The other side of the pair.
    Opposite,
    /// Something outside; forces turn with the surface.
    Follower,
    /// Something outside; forces keep their direction.
    Dead,
}

impl Answer {
    /// The part of the tangent that terms are in.
    fn part(self) -> Part {
        match self {
            Self::Opposite => Part::Contact,
            Self::Follower | Self::Dead => Part::Loads,
        }
    }
}

/// Places of a triple of unknowns of a pair in the system.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triple {
    /// The first of its unknowns.
    pub(super) first: usize,
    /// The node of the pair that it belongs to.
    pub(super) place: (Side, SurfaceNode),
    /// The node whose position it is.
    pub(super) position: Option<GlobalNode>,
    /// `true` if that node depends on others, or has axes of its own.
    pub(super) is_bound: bool,
    /// The rigid body that moves on the other side.
    against: Option<usize>,
}

impl System<'_> {
    /// Looks up where the unknowns of a pair are.
    pub(super) fn find_triples(&mut self, pair: usize, configuration: &Configuration) {
        let problem = self.context.problem;
        let numbering = configuration.pair.numbering();
        let rigid = problem.pairs[pair].rigid;
        let moving = rigid.filter(|&rigid| self.moving[rigid].is_some());
        let triple = |at: u32| {
            let unknown = numbering.unknown(3 * at);
            let (first, _) = self.layout.global(problem, pair, unknown)?;
            let (place, position) = match unknown {
                Unknown::Position { side, node, .. } => {
                    ((side, node), problem.surface_node(pair, side, node))
                }
                Unknown::Traction { side, node, .. } => ((side, node), None),
            };
            Some(Triple {
                first,
                place,
                position,
                is_bound: position.is_some_and(|node| {
                    problem.ties.follower(node).is_some()
                        || self.context.turned.frame(node).is_some()
                }),
                against: position.and(moving),
            })
        };
        let count = numbering.count() / 3;
        let triples = (0..count).map(triple).collect();
        self.triples.resize(pair, Vec::new());
        self.triples.push(triples);
    }

    pub(super) fn triple(&self, pair: usize, unknown: u32) -> &Triple {
        let triple = &self.triples[pair][unknown as usize / 3];
        triple.as_ref().expect("terms refer to active unknowns")
    }

    /// Adds a contact term.
    pub(super) fn add_term(&mut self, pair: usize, term: &LocalTerm, answer: Answer) {
        let slots = std::mem::take(&mut self.scratch.slots);
        let slot = |unknown: &u32| {
            let (triple, axis) = (self.triple(pair, *unknown), *unknown as usize % 3);
            Slot {
                unknown: triple.first + axis,
                position: triple.position.map(|node| (node, axis)),
                against: triple.against,
            }
        };
        let [mut rows, mut columns] = slots;
        rows.clear();
        rows.extend(term.rows.iter().map(slot));
        columns.clear();
        columns.extend(term.columns.iter().map(slot));
        if answer != Answer::Opposite {
            rows.iter_mut().for_each(|row| row.against = None);
        }
        for (row, residual) in rows.iter().zip(&term.residual) {
            self.residual[row.unknown] += residual;
            self.push_back(row, *residual);
        }
        if self.derivatives == Derivatives::First {
            self.add_rows(answer.part(), &rows, &columns, &term.tangent);
            self.turn(&rows, &columns, &term.residual, answer);
        }
        self.scratch.slots = [rows, columns];
    }

    /// Adds the answer to the force of a row to what acts on the body on the other side.
    fn push_back(&mut self, row: &Slot, residual: f64) {
        if let (Some(tie), Some((_, axis))) = (self.against(row), row.position) {
            let force = -Vec3::ith(axis, residual);
            let pushed = &mut self.forces.pushed[tie.rigid];
            pushed.force += force;
            pushed.torque += tie.arm.cross(&force);
            let longest = &mut self.longest_push[tie.rigid];
            *longest = longest.max(tie.arm.norm());
        }
    }

    /// Supervariable of the rigid body on the other side, if it moves.
    pub(super) fn opposite_body(&self, pair: usize) -> Option<Supervariable> {
        let rigid = self.context.problem.pairs[pair].rigid;
        rigid.and_then(|rigid| self.layout.body(rigid))
    }

    /// Adds rows of a block, leaving out prescribed ones.
    pub(super) fn add_rows(&mut self, part: Part, rows: &[Slot], columns: &[Slot], block: &[f64]) {
        if !rows.iter().any(|row| self.is_left_out(row)) {
            return self.scatter(part, rows, columns, block);
        }
        let kept: Vec<usize> = (0..rows.len())
            .filter(|&at| !self.is_left_out(&rows[at]))
            .collect();
        let rows: Vec<Slot> = kept.iter().map(|&at| rows[at]).collect();
        let block: Vec<f64> = kept
            .iter()
            .flat_map(|at| &block[at * columns.len()..(at + 1) * columns.len()])
            .copied()
            .collect();
        self.scatter(part, &rows, columns, &block);
    }

    /// Returns whether a row is prescribed and no moving body reacts to it.
    fn is_left_out(&self, slot: &Slot) -> bool {
        let fixed = |(node, axis): (GlobalNode, usize)| {
            // Rows of a node with axes of its own are left out once they are along these.
            self.context.turned.frame(node).is_none() && self.context.fixed[node.component(axis)]
        };
        slot.against.is_none() && slot.position.is_some_and(fixed)
    }

    /// Tangent of the forces that turn with a moving body, and of their arms.
    fn turn(&mut self, rows: &[Slot], columns: &[Slot], residual: &[f64], answer: Answer) {
        let Some(tie) = columns.iter().find_map(|slot| self.against(slot)) else {
            return;
        };
        let first_of_node = |at: &usize| matches!(rows[*at].position, Some((_, 0)));
        for at in (0..rows.len()).filter(first_of_node) {
            let force = -Vec3::from_column_slice(&residual[at..at + 3]);
            let node = [rows[at], rows[at + 1], rows[at + 2]];
            if answer != Answer::Dead {
                // The row states -f.
                let turned = force.cross_matrix() * tie.tangent;
                self.scatter(answer.part(), &node, &angles(&tie), &by_rows(&turned));
            }
            if answer == Answer::Opposite {
                self.shift_arms(&node, &tie, &force);
            }
        }
    }

    /// `(dx - du) x f` in the torque on what pushes the body.
    fn shift_arms(&mut self, node: &[Slot; 3], tie: &Tie, force: &Vec3) {
        let fixed = &self.context.fixed_rigid[tie.rigid];
        let free: Vec<usize> = (0..3).filter(|axis| !fixed[3 + axis]).collect();
        let rows: Vec<Slot> = free
            .iter()
            .map(|axis| Slot::plain(tie.first + 3 + axis))
            .collect();
        let of_node = node.map(|slot| Slot {
            against: None,
            ..slot
        });
        let of_body = [0, 1, 2].map(|axis| Slot::plain(tie.first + axis));
        let cross = -force.cross_matrix();
        for (columns, sign) in [(of_node, 1.0), (of_body, -1.0)] {
            let block: Vec<f64> = free
                .iter()
                .flat_map(|&row| (0..3).map(move |column| sign * cross[(row, column)]))
                .collect();
            self.scatter(Part::Contact, &rows, &columns, &block);
        }
    }
}

/// The angles of a body.
fn angles(tie: &Tie) -> [Slot; 3] {
    [3, 4, 5].map(|at| Slot::plain(tie.first + at))
}

fn by_rows(matrix: &Matrix3<f64>) -> Vec<f64> {
    matrix.transpose().iter().copied().collect()
}
