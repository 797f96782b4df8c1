//! Conditions and loads that a step states, and those that it finds.

use super::amplitude::Period;
use super::bodies::Body;
use crate::write::value::{number, text};
use std::collections::{BTreeMap, BTreeSet};

/// Target of a condition.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Target {
    /// A body by place, and a node set.
    Nodes(usize, String),
    /// A rigid body by place.
    Rigid(usize),
}

/// A component of what a condition is on.
pub(super) type Component = (Target, usize);

/// Present values of all that is prescribed or applied.
#[derive(Default)]
pub(super) struct History {
    pub(super) prescribed: BTreeMap<Component, f64>,
    pub(super) loads: BTreeMap<Loaded, (Family, [f64; 3])>,
}

/// A component that a step prescribes.
#[derive(Clone)]
pub(super) struct Prescribed {
    pub(super) target: f64,
    /// Value at the end of the step.
    pub(super) reached: f64,
    pub(super) curve: Option<String>,
    /// Line that states it.
    pub(super) line: usize,
}

/// Conditions stated by the keywords of a step.
#[derive(Default)]
pub(super) struct Stated {
    pub(super) prescribed: BTreeMap<Component, Prescribed>,
    /// Axes of node sets that have their own, by body.
    pub(super) axes: BTreeMap<(usize, String), String>,
    /// `true` if conditions that are not stated again end.
    pub(super) is_new: bool,
    pub(super) raw_loads: BTreeMap<Loaded, StatedLoad>,
    /// Kinds of loads of which those that are not stated again end.
    pub(super) new_loads: BTreeSet<Family>,
    pub(super) loads: BTreeMap<Loaded, Load>,
    /// Velocities at the start, of nodes or of a rigid body.
    pub(super) velocities: BTreeMap<Target, [f64; 6]>,
}

/// Place of a load.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Loaded {
    /// A body by place, and a node set.
    Nodes(usize, String),
    /// Pressure on a body by place, and a facet set.
    Pressed(usize, String),
    /// Traction of a fixed direction, likewise.
    Dead(usize, String),
    /// Traction that turns with the facets, likewise.
    Follower(usize, String),
    /// Force on a rigid body by place.
    Force(usize),
    /// Torque on a rigid body by place.
    Torque(usize),
    Gravity,
}

/// The keyword of a load.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Family {
    Concentrated,
    Distributed,
    Surface,
}

/// Statement of a load by the rows of a step.
pub(super) struct StatedLoad {
    pub(super) family: Family,
    pub(super) components: [Option<f64>; 3],
    pub(super) amplitude: Option<String>,
    pub(super) period: Period,
    pub(super) line: usize,
}

/// A load in a step.
pub(super) struct Load {
    pub(super) target: [f64; 3],
    pub(super) curve: Option<String>,
    pub(super) line: usize,
}

/// `, curve = ...`, nothing for the ramp.
pub(super) fn curve_key(curve: &Option<String>) -> String {
    let curve = curve.as_ref();
    curve.map_or(String::new(), |curve| format!(", curve = {}", text(curve)))
}

impl Stated {
    /// Conditions of nodes: displacements of each set along each curve.
    pub(super) fn displacements(&self, bodies: &[Body]) -> Vec<String> {
        let mut groups: BTreeMap<(usize, &str, &Option<String>), String> = BTreeMap::new();
        for ((target, component), prescribed) in &self.prescribed {
            let Target::Nodes(body, set) = target else {
                continue;
            };
            let keys = groups.entry((*body, set, &prescribed.curve)).or_default();
            let value = number(prescribed.target);
            *keys += &format!(", {} = {value}", ["x", "y", "z"][*component]);
        }
        let entry = |((body, set, curve), keys): ((usize, &str, &Option<String>), String)| {
            let axes = self.axes.get(&(body, set.to_owned()));
            let axes = axes.map(|axes| format!(", axes = {axes}"));
            let (body, set) = (text(&bodies[body].name), text(set));
            format!(
                "{{ body = {body}, nodes = {set}{}{keys}{} }}",
                axes.unwrap_or_default(),
                curve_key(curve)
            )
        };
        groups.into_iter().map(entry).collect()
    }

    /// Prescribed components that are not stated again.
    pub(super) fn ended(&self, history: &History) -> BTreeSet<Component> {
        let before = history.prescribed.keys();
        let ended = before.filter(|key| self.is_new && !self.prescribed.contains_key(*key));
        ended.cloned().collect()
    }
}
