//! Motions of rigid bodies in a step.

use super::Model;
use super::amplitude::Curve;
use super::stated::{Component, Loaded, Prescribed, Stated, Target, curve_key};
use crate::write::value::{list, number, text};
use std::collections::BTreeSet;

/// Words for the coordinates of a rigid body.
const WORDS: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

impl Model<'_> {
    /// Entries of rigid bodies: components without a condition are free.
    pub(super) fn motions(
        &mut self,
        stated: &Stated,
        ended: &BTreeSet<Component>,
        is_first: bool,
    ) -> Vec<String> {
        (0..self.rigid.len())
            .filter_map(|at| self.motion(at, stated, ended, is_first))
            .collect()
    }

    fn motion(
        &mut self,
        at: usize,
        stated: &Stated,
        ended: &BTreeSet<Component>,
        is_first: bool,
    ) -> Option<String> {
        let rigid = &mut self.rigid[at];
        let (mut is_moved, mut is_freed) = ([false; 2], is_first);
        // Courses of what changes, each with the line that states it.
        let mut courses: Vec<(&Option<String>, usize)> = Vec::new();
        let (mut targets, mut rests) = (rigid.targets, false);
        for component in 0..6 {
            let key = (Target::Rigid(at), component);
            if ended.contains(&key) {
                rigid.held[component] = false;
                (rigid.targets[component], targets[component]) = (0.0, 0.0);
                is_freed = true;
            }
            let Some(Prescribed {
                target,
                reached,
                curve,
                line,
            }) = stated.prescribed.get(&key)
            else {
                rests |= rigid.held[component] && targets[component] != 0.0;
                continue;
            };
            // What was free may be anywhere.
            let was_free = !is_first && !rigid.held[component];
            rigid.held[component] = true;
            if was_free || rigid.targets[component] != *target || curve.is_some() {
                is_moved[component / 3] = true;
                courses.push((curve, *line));
            } else {
                rests |= *target != 0.0;
            }
            targets[component] = *target;
            rigid.targets[component] = *reached;
        }
        let mut keys = String::new();
        let [x, y, z, rx, ry, rz] = targets;
        if is_moved[0] {
            keys += &format!(", displacement = {}", list([x, y, z].map(number)));
        }
        if is_moved[1] {
            let degrees = [rx, ry, rz].map(|angle| number(angle.to_degrees()));
            keys += &format!(", rotation = {}", list(degrees));
        }
        let free = (0..6).filter(|component| !rigid.held[*component]);
        let free: Vec<String> = free.map(|component| text(WORDS[component])).collect();
        if !free.is_empty() && (is_freed || is_moved != [false; 2]) {
            keys += &format!(", free = {}", list(free));
        }
        for (key, loaded) in [("force", Loaded::Force(at)), ("torque", Loaded::Torque(at))] {
            if let Some(load) = stated.loads.get(&loaded) {
                keys += &format!(", {key} = {}", list(load.target.map(number)));
                courses.push((&load.curve, load.line));
            }
        }
        if keys.is_empty() {
            return None;
        }
        let curve = courses.first().and_then(|(curve, _)| (*curve).clone());
        let others = courses.iter().find(|(other, _)| **other != curve);
        if let Some((_, line)) = others.copied() {
            let what = "a rigid body has one course in a step: this one is that of its other components; divide the step";
            self.list(line, what);
        } else if rests && self.is_over_run(&curve) {
            let line = courses.first().map_or(0, |(_, line)| *line);
            let what = "components of the rigid body that stay where they are follow the amplitude too; divide the step";
            self.list(line, what);
        }
        let (name, curve) = (text(&self.rigid[at].name), curve_key(&curve));
        Some(format!("{{ surface = {name}{keys}{curve} }}"))
    }

    fn is_over_run(&self, curve: &Option<String>) -> bool {
        let named = |(name, _): &&(String, Curve)| Some(name) == curve.as_ref();
        let known = self.curves.iter().find(named);
        known.is_some_and(|(_, curve)| !matches!(curve, Curve::Step(_)))
    }
}
