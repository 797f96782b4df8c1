//! Boundary conditions of a step.

use super::amplitude::{Over, Period};
use super::stated::{History, Prescribed, Stated, Target};
use super::{Model, has, numbers};
use crate::write::value::{list, vector};
use striae_mesh::{NodeId, Vec3};
use striae_meshfile::{Keyword, Row};
use striae_model::Axes;

/// Components that a word such as `PINNED` holds.
fn named(word: &str) -> Option<Vec<usize>> {
    let held: &[usize] = match word.to_uppercase().as_str() {
        "ENCASTRE" => &[0, 1, 2, 3, 4, 5],
        "PINNED" => &[0, 1, 2],
        "XSYMM" => &[0, 4, 5],
        "YSYMM" => &[1, 3, 5],
        "ZSYMM" => &[2, 3, 4],
        "XASYMM" => &[1, 2, 3],
        "YASYMM" => &[0, 2, 4],
        "ZASYMM" => &[0, 1, 5],
        _ => return None,
    };
    Some(held.to_vec())
}

/// Components and value of a row; `None` where it states no mechanical ones.
fn stated(row: &Row<'_>) -> Option<(Vec<usize>, f64)> {
    let second = row.words.get(1).copied().unwrap_or_default();
    if let Some(held) = named(second) {
        return Some((held, 0.0));
    }
    let all = numbers(&row.words[1..]).filter(|all| !all.is_empty())?;
    let first = all[0] as usize;
    let last = all.get(1).map_or(first, |last| (*last as usize).max(first));
    let value = all.get(2).copied().unwrap_or(0.0);
    let is_known = (1..=6).contains(&first) && last <= 6;
    is_known.then(|| ((first - 1..last).collect(), value))
}

impl<'a> Model<'a> {
    /// Reads `*BOUNDARY`.
    pub(super) fn boundary(
        &mut self,
        keyword: &'a Keyword<'a>,
        period: Period,
        history: &History,
        stated_so_far: &mut Stated,
    ) {
        self.used.insert(keyword.line);
        let known = ["AMPLITUDE", "OP", "TYPE", "LOAD CASE"];
        self.list_parameters(keyword, &known);
        stated_so_far.is_new |= has(keyword, "OP", "NEW");
        let kind = keyword.parameter("TYPE").unwrap_or("DISPLACEMENT");
        let is_velocity = kind.eq_ignore_ascii_case("VELOCITY");
        if !is_velocity && !kind.eq_ignore_ascii_case("DISPLACEMENT") {
            self.list(keyword.line, format!("*BOUNDARY, TYPE={kind}"));
            return;
        }
        if keyword.parameter("FIXED").is_some() {
            let what = "*BOUNDARY, FIXED: state the displacements that the nodes have then";
            self.list(keyword.line, what);
            return;
        }
        for row in &keyword.rows {
            let word = row.words[0];
            let Some((held, value)) = stated(row) else {
                self.list(row.line, format!("*BOUNDARY `{}`", row.words.join(", ")));
                continue;
            };
            let targets = self.targets(word);
            if targets.is_empty() {
                let what =
                    format!("*BOUNDARY of `{word}`, which belongs to no body and no rigid body");
                self.list(row.line, what);
            }
            for (target, first) in targets {
                let is_solid = matches!(target, Target::Nodes(..));
                let across = match &target {
                    Target::Nodes(body, set) => {
                        self.target_across(row, *body, set, &held, stated_so_far)
                    }
                    Target::Rigid(_) => Some(target.clone()),
                };
                if is_solid && held.iter().all(|component| *component > 2) {
                    self.list(row.line, format!("*BOUNDARY: rotations of `{word}`"));
                }
                let limit = if is_solid { 3 } else { 6 };
                for component in held.iter().map(|at| at + first).filter(|at| *at < limit) {
                    let target = match component {
                        0 | 1 => across.clone(),
                        _ => Some(target.clone()),
                    };
                    let Some(target) = target else { continue };
                    let key = (target, component);
                    let amplitude = keyword.parameter("AMPLITUDE");
                    let present = history.present(&key, &self.bodies);
                    // Ramps start from where the nodes are.
                    let is_ramp = amplitude.is_none() && !is_velocity;
                    let Some(present) = present.or(is_ramp.then_some(0.0)) else {
                        let what = format!(
                            "*BOUNDARY of `{word}`: its nodes have different displacements before, so this one has no start; state them by the sets of the step before"
                        );
                        self.list(row.line, what);
                        continue;
                    };
                    if is_velocity && value != 0.0 && history.is_lost(&key, &self.bodies) {
                        let what = format!(
                            "*BOUNDARY of `{word}`: it was free before, so this velocity has no start; state the displacement that it leads to"
                        );
                        self.list(row.line, what);
                        continue;
                    }
                    if is_velocity && value != 0.0 {
                        stated_so_far.moving.insert(key.clone(), row.line);
                    }
                    let found = match is_velocity {
                        true => self.travel(amplitude, period, [present, value]),
                        false => self.approach(amplitude, period, Over::Step, [present, value]),
                    };
                    match found {
                        Ok(found) => {
                            let prescribed = Prescribed {
                                target: found.target,
                                reached: found.reached,
                                curve: found.curve,
                                line: row.line,
                            };
                            stated_so_far.prescribed.insert(key, prescribed);
                        }
                        Err(what) => self.list(row.line, format!("*BOUNDARY of `{word}`: {what}")),
                    }
                }
            }
        }
    }

    /// Target of the first two components of a row, and the axes of all: nodes on the axis of a
    /// cylinder have neither a radial nor a tangential direction and are left out; `None` where
    /// all are.
    fn target_across(
        &mut self,
        row: &Row<'_>,
        body: usize,
        set: &str,
        held: &[usize],
        stated: &mut Stated,
    ) -> Option<Target> {
        let whole = Target::Nodes(body, set.to_owned());
        let Some(axes) = self.axes(row.line, body, set) else {
            return Some(whole);
        };
        let told = axes_text(&axes);
        stated.axes.insert((body, set.to_owned()), told.clone());
        let of = &mut self.bodies[body];
        let is_on_axis = |node: &NodeId| {
            let [radial, ..] = axes.directions(&of.reading.mesh.positions[node.index()]);
            radial.is_none()
        };
        let (on, off): (Vec<NodeId>, Vec<NodeId>) = of.nodes(set).into_iter().partition(is_on_axis);
        if on.is_empty() || held.iter().all(|component| *component > 1) {
            return Some(whole);
        }
        let numbers: Vec<String> = on
            .iter()
            .map(|node| of.reading.numbers.node(*node))
            .collect();
        let target = (!off.is_empty()).then(|| {
            let set = of.set_of_nodes(format!("{set} off the axis"), off);
            stated.axes.insert((body, set.clone()), told);
            Target::Nodes(body, set)
        });
        let what = format!(
            "*BOUNDARY of `{}`: node {} is on the axis of the *TRANSFORM, where components 1 and 2 have no direction; left out",
            row.words[0],
            numbers.join(", ")
        );
        let what = match numbers.len() {
            1 => what,
            _ => what
                .replacen(": node ", ": nodes ", 1)
                .replacen(" is on", " are on", 1),
        };
        self.list(row.line, what);
        target
    }

    /// Axes of the nodes of a set by `*TRANSFORM`, whatever set that names.
    pub(super) fn axes(&mut self, line: usize, body: usize, set: &str) -> Option<Axes> {
        let keywords = self.keywords.iter();
        let transforms = keywords.filter(|keyword| keyword.name == "TRANSFORM");
        for keyword in transforms.rev() {
            let Some(word) = keyword.parameter("NSET") else {
                continue;
            };
            let nodes = self.nodes(word);
            let turned = nodes.into_iter().find(|(at, _)| *at == body);
            let Some((_, turned)) = turned else { continue };
            let sets = |set: &str| self.bodies[body].nodes(set);
            let (turned, own) = (sets(&turned), sets(set));
            let count = own.iter().filter(|node| turned.contains(node)).count();
            if count == 0 {
                continue;
            }
            if count < own.len() {
                let what = format!(
                    "some nodes of `{set}` are in `{word}` of *TRANSFORM: its axes are left out; give these nodes a set of their own"
                );
                self.list(line, what);
                continue;
            }
            let axes = transform(keyword)?;
            self.used.insert(keyword.line);
            return Some(axes);
        }
        None
    }

    /// Targets that a word refers to, each with the component that its first one is.
    fn targets(&mut self, word: &str) -> Vec<(Target, usize)> {
        if let Some(rigid) = self.rigid_of_point(word) {
            return vec![(Target::Rigid(rigid), 0)];
        }
        if let Some(rigid) = self.rigid_of_turning_point(word) {
            return vec![(Target::Rigid(rigid), 3)];
        }
        let sets = self.nodes(word).into_iter();
        sets.map(|(body, set)| (Target::Nodes(body, set), 0))
            .collect()
    }
}

/// The axes that a `*TRANSFORM` states.
fn transform(keyword: &Keyword<'_>) -> Option<Axes> {
    let all = numbers(&keyword.rows.first()?.words)?;
    let (a, b) = all.get(..6)?.split_at(3);
    let (a, b) = (Vec3::from_column_slice(a), Vec3::from_column_slice(b));
    let kind = keyword.parameter("TYPE").unwrap_or("R").to_uppercase();
    match kind.as_str() {
        "R" => Some(Axes::Skew { x: a, y: b }),
        "C" => Some(Axes::Cylindrical {
            point: a,
            axis: b - a,
        }),
        _ => None,
    }
}

/// Axes as a deck states them; empty for those of the coordinates.
fn axes_text(axes: &Axes) -> String {
    match axes {
        Axes::Global => String::new(),
        Axes::Normal(normal) => format!("{{ normal = {} }}", vector(normal)),
        Axes::Skew { x, y } => list([x, y].map(vector)),
        Axes::Cylindrical { point, axis } => {
            format!("{{ point = {}, axis = {} }}", vector(point), vector(axis))
        }
    }
}
