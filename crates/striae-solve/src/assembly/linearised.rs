//! Contact on a linear background: all but contact is linearised once, contact is
//! evaluated at one trial state after the other.
//!
//! With the residual `r` and the tangent `K` of all but contact at `x`, and that of
//! contact `c`, the system at `x + d` is
//!
//! ```text
//! r + K d + c(x + d),    K + dc/dx(x + d)
//! ```
//!
//! Rows of supervariables that are not kept know no contact. A correction that solves
//! the first linear system leaves nothing in them, and none that follows changes that. `K`
//! is the part of the bodies in the tangent, and blocks of loads on faces that contact
//! surfaces cover in part, which are in the other one. All that is on one rank.

use striae_condensed::{Partition, Tangent};
use striae_contact::{complementarity::Iteration, evaluation::Evaluation, segment::Derivatives};
use striae_mesh::Vec3;
use striae_sparse::PlacedBlock;

use super::{Setting, System, Trial, configurations, contacts::contacts};
use crate::{layout::Layout, norms::Norms, outcome::CutBack};
use striae_model::node::GlobalNode;

/// All but contact at a trial state.
#[derive(Clone, Debug, Default)]
pub struct Background {
    /// Blocks in the part of contact.
    blocks: Vec<PlacedBlock<'static>>,
    residual: Vec<f64>,
    applied: Vec<Vec3>,
    square_of_forces: f64,
}

/// Contact at a trial state, on a linear background.
#[derive(Clone, Debug)]
pub struct ContactAssembled {
    /// Residual of every unknown.
    pub residual: Vec<f64>,
    /// Norms by field.
    pub norms: Norms,
    /// Contact of every pair.
    pub contacts: Vec<Evaluation>,
}

/// Evaluates contact at a trial state `change` away from the state of linearisation, and replaces
/// the contact in the tangent, whose part of the bodies is that of the background.
///
/// No rigid body may have coordinates among the unknowns. `None` where the partition would have
/// to grow.
///
/// # Errors
/// Returns why contact cannot be evaluated.
pub fn assemble_contact(
    setting: &Setting,
    background: &Background,
    (trial, change): (&Trial, &[f64]),
    iteration: Iteration,
    layout: &Layout,
    (partition, tangent): (&Partition, &mut Tangent),
) -> Result<Option<ContactAssembled>, CutBack> {
    let &Setting {
        context,
        selections,
        imposed,
        ..
    } = setting;
    let mut system = System::new(context, layout, &mut tangent.bodies, trial, imposed);
    system.linear_background(background, change, partition);
    let configurations = configurations(setting, trial);
    for (pair, configuration) in configurations.iter().enumerate() {
        system.find_triples(pair, configuration);
    }
    let contacts = contacts(
        &configurations,
        setting,
        trial,
        (iteration, Derivatives::First),
        &[],
    )?;
    system.add_contacts(&contacts);
    system.stabilise(trial, imposed);
    let Ok(rows) = partition.gathered(&system.all_blocks(&contacts)) else {
        return Ok(None);
    };
    tangent.contact = rows;
    system.pass_on();
    let norms = system.norms(trial, &contacts);
    system.turn_rows();
    system.idle(selections);
    system.prescribe(trial, imposed);
    Ok(Some(ContactAssembled {
        residual: system.residual,
        norms,
        contacts,
    }))
}

impl System<'_> {
    /// System before contact is added.
    pub(super) fn background(&self) -> Background {
        Background {
            blocks: self.blocks.clone(),
            residual: self.residual.clone(),
            applied: self.forces.applied.clone(),
            square_of_forces: self.square_of_forces,
        }
    }

    /// Fills in the background at a state `change` away from it.
    fn linear_background(
        &mut self,
        background: &Background,
        change: &[f64],
        partition: &Partition,
    ) {
        self.is_linearised = true;
        let kept = partition.kept();
        for row in kept.flat_map(|kept| partition.unknowns_of(kept)) {
            self.residual[row] = background.residual[row] + self.matrix.row_product(row, change);
        }
        self.blocks.clone_from(&background.blocks);
        for block in &self.blocks {
            block.add_product(change, &mut self.residual);
        }
        // Products are along the axes of the nodes, what they add to is not.
        let (context, layout) = (self.context, self.layout);
        let is_kept = |node: GlobalNode| partition.is_kept(layout.supervariable(node));
        for (node, frame) in context.turned.frames().filter(|(node, _)| is_kept(*node)) {
            let first = layout.position(node);
            let of = |rows: &[f64]| Vec3::from_column_slice(&rows[first..first + 3]);
            let found = of(&background.residual);
            let product = frame.axes() * (of(&self.residual) - found);
            self.residual[first..first + 3].copy_from_slice((found + product).as_slice());
        }
        self.square_of_forces = background.square_of_forces;
        self.forces.applied.clone_from(&background.applied);
    }
}
