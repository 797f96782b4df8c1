//! Forces of earlier steps at nodes that a later step loads by sets of other names.
//!
//! Abaqus keeps forces by node and component, a deck by set.

use super::Model;
use super::amplitude::Period;
use super::stated::{History, Loaded, Stated, StatedLoad};
use std::collections::HashMap;
use striae_mesh::NodeId;

impl Model<'_> {
    /// Ends forces whose nodes a step loads anew, by sets of other names.
    pub(super) fn end_replaced(&mut self, history: &History, stated: &mut Stated, period: Period) {
        let is_kept = |(loaded, _): &(&Loaded, _)| {
            matches!(loaded, Loaded::Nodes(..)) && !stated.raw_loads.contains_key(loaded)
        };
        let kept: Vec<_> = history.loads.iter().filter(is_kept).collect();
        if kept.is_empty() {
            return;
        }
        let mut anew = HashMap::new();
        for (loaded, of) in &stated.raw_loads {
            let Loaded::Nodes(body, set) = loaded else {
                continue;
            };
            for node in self.bodies[*body].nodes(set) {
                for component in (0..3).filter(|at| of.components[*at].is_some()) {
                    anew.insert((*body, node, component), (of.line, of.amplitude.is_none()));
                }
            }
        }
        for (loaded, (family, present)) in kept {
            let Loaded::Nodes(body, set) = loaded else {
                continue;
            };
            let nodes = self.bodies[*body].nodes(set);
            let mut components = [None; 3];
            for component in (0..3).filter(|at| present[*at] != 0.0) {
                let by_node = |node: &NodeId| anew.get(&(*body, *node, component));
                let new: Vec<&(usize, bool)> = nodes.iter().filter_map(by_node).collect();
                let Some((line, _)) = new.first() else {
                    continue;
                };
                // Along ramps the old force falls while the new one rises.
                if new.len() == nodes.len() && new.iter().all(|(_, is_ramp)| *is_ramp) {
                    components[component] = Some(0.0);
                    continue;
                }
                let what = format!(
                    "*CLOAD: its nodes keep the force that an earlier step states for `{set}`, and both act in the deck; state the forces of a step by the sets of the one before"
                );
                self.list(*line, what);
            }
            if components != [None; 3] {
                let none = StatedLoad {
                    family: *family,
                    components,
                    amplitude: None,
                    period,
                    line: 0,
                };
                stated.raw_loads.insert(loaded.clone(), none);
            }
        }
    }
}
