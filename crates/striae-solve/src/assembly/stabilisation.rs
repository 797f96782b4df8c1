//! Forces of stabilisation in the system, see [`crate::stabilisation`].

use super::{Imposed, System, Trial, terms::Answer};
use crate::stabilisation::{Dashpot, Point};

impl System<'_> {
    /// Adds what stabilises the pairs.
    pub(super) fn stabilise(&mut self, trial: &Trial, imposed: &Imposed) {
        for (pair, dashpots) in imposed.dashpots.iter().enumerate() {
            for dashpot in dashpots {
                self.add_dashpot(pair, dashpot, trial, imposed);
            }
        }
    }

    fn add_dashpot(&mut self, pair: usize, dashpot: &Dashpot, trial: &Trial, imposed: &Imposed) {
        let problem = self.context.problem;
        let numbering = self.context.pairs[pair].numbering();
        let rigid = problem.pairs[pair].rigid;
        let poses = rigid.map(|rigid| [&imposed.before[rigid], &trial.rigid[rigid]]);
        let stretch = dashpot.stretch(problem, pair, &trial.positions, poses);
        let first = |point: &Point| numbering.position(point.side, point.node);
        self.add_term(pair, &dashpot.term(&stretch, first), Answer::Opposite);
        for point in &dashpot.points {
            let node = problem.surface_node(pair, point.side, point.node);
            let node = node.expect("points of dashpots are nodes");
            let force = stretch * (-dashpot.stiffness * point.weight);
            self.forces.stabilisation[node] += force;
            if let Some(rigid) = rigid {
                let reference = problem.model.rigid_surfaces[rigid].reference;
                let arm = trial.positions[node] - reference - trial.rigid[rigid].displacement;
                let wrench = &mut self.forces.stabilised[rigid];
                wrench.force -= force;
                wrench.torque -= arm.cross(&force);
            }
        }
    }
}
