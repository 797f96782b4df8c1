//! Conditions and loads that a step states, and those that it finds.

use super::amplitude::Period;
use super::bodies::Body;
use crate::write::value::{number, text};
use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use striae_mesh::NodeId;

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
    /// Components that move at a velocity at the end of the last step, with the line that states it.
    pub(super) moving: BTreeMap<Component, usize>,
    /// Number of the last step that states a prescribed component, and of steps.
    stated_in: BTreeMap<Component, usize>,
    steps: usize,
    /// Prescribed values of nodes, made when they are first asked for.
    by_node: OnceCell<HashMap<NodeComponent, f64>>,
}

/// A body by place, its node and a component.
type NodeComponent = (usize, NodeId, usize);

/// Nodes and components of prescribed components, with what is said of them.
fn by_node<'a, T: Copy + 'a>(
    prescribed: impl Iterator<Item = (&'a Component, T)>,
    bodies: &[Body],
) -> HashMap<NodeComponent, T> {
    let mut all = HashMap::new();
    for ((target, component), of) in prescribed {
        if let Target::Nodes(body, set) = target {
            let nodes = bodies[*body].nodes(set).into_iter();
            all.extend(nodes.map(|node| ((*body, node, *component), of)));
        }
    }
    all
}

impl History {
    /// Present value of a component; `None` if its nodes differ in it.
    pub(super) fn present(&self, key: &Component, bodies: &[Body]) -> Option<f64> {
        let (Target::Nodes(body, set), component) = key else {
            return Some(self.prescribed.get(key).copied().unwrap_or(0.0));
        };
        // Nothing has changed some of its nodes since.
        if self.stated_in.get(key) == Some(&self.steps) {
            return self.prescribed.get(key).copied();
        }
        if self.prescribed.is_empty() {
            return Some(0.0);
        }
        let known = self.by_node.get_or_init(|| {
            let mut all: Vec<(&Component, f64)> =
                self.prescribed.iter().map(|(key, of)| (key, *of)).collect();
            // What a later step states of a node replaces what an earlier one does.
            all.sort_by_key(|(key, _)| self.stated_in.get(*key));
            by_node(all.into_iter(), bodies)
        });
        let nodes = bodies[*body].nodes(set).into_iter();
        let mut values = nodes.map(|node| known.get(&(*body, node, *component)).unwrap_or(&0.0));
        let first = *values.next()?;
        values.all(|value| *value == first).then_some(first)
    }

    /// Returns whether the value of a component is not known: it was free in a step.
    pub(super) fn is_lost(&self, key: &Component, bodies: &[Body]) -> bool {
        let (Target::Nodes(body, set), component) = key else {
            return self.steps > 0 && !self.prescribed.contains_key(key);
        };
        let known = by_node(self.prescribed.keys().map(|key| (key, ())), bodies);
        let nodes = bodies[*body].nodes(set).into_iter();
        let mut all = nodes.map(|node| (*body, node, *component));
        self.steps > 0 && all.any(|node| !known.contains_key(&node))
    }

    /// Goes on to the end of a step, in which components have ended or been replaced.
    pub(super) fn advance(&mut self, stated: Stated, past: &BTreeSet<Component>) {
        self.by_node.take();
        self.prescribed.retain(|key, _| !past.contains(key));
        self.steps += 1;
        for key in stated.prescribed.keys() {
            self.stated_in.insert(key.clone(), self.steps);
        }
        self.moving = stated.moving;
        let targets = stated.prescribed.into_iter();
        self.prescribed
            .extend(targets.map(|(key, of)| (key, of.reached)));
    }
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
    /// Components that move at a velocity other than zero, with the line that states it.
    pub(super) moving: BTreeMap<Component, usize>,
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

    /// Prescribed components of which all nodes are stated again, by sets of other names.
    pub(super) fn replaced(&self, history: &History, bodies: &[Body]) -> BTreeSet<Component> {
        let is_kept = |key: &&Component| !self.prescribed.contains_key(*key);
        let kept: Vec<&Component> = history.prescribed.keys().filter(is_kept).collect();
        if kept.is_empty() || self.prescribed.is_empty() {
            return BTreeSet::new();
        }
        let anew = by_node(self.prescribed.keys().map(|key| (key, ())), bodies);
        let is_replaced = |(target, component): &&Component| match target {
            Target::Nodes(body, set) => {
                let nodes = bodies[*body].nodes(set);
                let mut all = nodes.iter();
                all.all(|node| anew.contains_key(&(*body, *node, *component)))
            }
            Target::Rigid(_) => false,
        };
        kept.into_iter().filter(is_replaced).cloned().collect()
    }
}
