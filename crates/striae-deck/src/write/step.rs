//! Steps and what they state.

use striae_declared::degrees;
use striae_model::{
    Axes, Displacement, Freedom, Load, LoadExtent, LoadKind, Mover, NodalForce, Procedure, Release,
    RigidMotion, Step, Velocity,
};

use super::value::{lines, list, number, text, varying, vector};
use super::{Writer, law};

/// Names of the coordinates of a rigid body.
const COORDINATES: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

impl<'m> Writer<'m> {
    /// A step.
    pub(super) fn step(&mut self, at: usize) -> String {
        let step = &self.model.steps[at];
        let mut told = format!(
            "\n[[step]]\nname = {}\nduration = {}\n{}increments = {{ initial = {}, \
             smallest = {}, largest = {} }}\n",
            text(&step.name),
            number(step.duration),
            match step.procedure {
                Procedure::QuasiStatic => String::new(),
                Procedure::Dynamic { spectral_radius } => {
                    let radius = number(spectral_radius);
                    format!("dynamics = {{ spectral_radius = {radius} }}\n")
                }
            },
            number(step.increments.initial),
            number(step.increments.smallest),
            number(step.increments.largest),
        );
        if let Some(gravity) = &step.gravity {
            let (vector, curve) = (vector(&gravity.acceleration), self.curve(&gravity.curve));
            told += &format!("gravity = {{ vector = {vector}{curve} }}\n");
        }
        told + &self.conditions(step)
    }

    /// The lists of a step; empty ones are left out.
    fn conditions(&mut self, step: &'m Step) -> String {
        let pressed = |load: &&Load| matches!(load.kind, LoadKind::Pressure(_));
        let (pressures, tractions): (Vec<&Load>, Vec<&Load>) = step.loads.iter().partition(pressed);
        let frictions = self.frictions(step);
        let all = [
            (
                "velocity",
                step.velocities
                    .iter()
                    .map(|one| self.velocity(one))
                    .collect(),
            ),
            (
                "displacement",
                step.displacements
                    .iter()
                    .map(|one| self.displacement(one))
                    .collect(),
            ),
            (
                "release",
                step.releases
                    .iter()
                    .filter_map(|one| self.release(one))
                    .collect(),
            ),
            (
                "traction",
                tractions.into_iter().map(|one| self.load(one)).collect(),
            ),
            (
                "pressure",
                pressures.into_iter().map(|one| self.load(one)).collect(),
            ),
            (
                "force",
                step.forces.iter().map(|one| self.force(one)).collect(),
            ),
            (
                "actuation",
                step.actuations
                    .iter()
                    .map(|one| self.actuation(one))
                    .collect(),
            ),
            (
                "cavity",
                step.fillings.iter().map(|one| self.filling(one)).collect(),
            ),
            (
                "rigid",
                step.rigid_motions
                    .iter()
                    .map(|one| self.motion(step, one))
                    .collect(),
            ),
            ("friction", frictions),
        ];
        let all = all
            .into_iter()
            .filter(|(_, items): &(_, Vec<String>)| !items.is_empty());
        all.map(|(key, items)| format!("{key} = {}\n", lines(items.into_iter())))
            .collect()
    }

    /// Friction that begins with a step.
    fn frictions(&mut self, step: &'m Step) -> Vec<String> {
        let stated = step.frictions.iter().map(|(pair, friction)| {
            let pair = &self.model.pairs[pair.0].name;
            (pair, law::friction_keys(friction))
        });
        let stated: Vec<_> = stated.collect();
        let told = stated.into_iter().map(|(pair, keys)| {
            let keys = keys.unwrap_or_else(|| {
                let part = format!("step `{}`, pair `{pair}`", step.name);
                self.refuse(part, "its friction is a user-defined law");
                String::new()
            });
            format!("{{ pair = {}, {keys} }}", text(pair))
        });
        told.collect()
    }

    fn velocity(&self, velocity: &Velocity) -> String {
        let of = match velocity.body {
            Mover::Deformable(body) => format!("body = {}", text(&self.model.bodies[body.0].name)),
            Mover::Rigid(rigid) => {
                let name = &self.model.rigid_surfaces[rigid.0].name;
                format!("rigid = {}", text(name))
            }
        };
        let [vector, spin, about] =
            [velocity.velocity, velocity.spin, velocity.about].map(|part| vector(&part));
        format!("{{ {of}, vector = {vector}, spin = {spin}, about = {about} }}")
    }

    fn displacement(&mut self, one: &'m Displacement) -> String {
        let set = self.meshes.nodes(one.body, &one.set, &one.nodes);
        let body = text(&self.model.bodies[one.body.0].name);
        let mut told = format!("body = {body}, nodes = {}", text(&set));
        told += &match &one.axes {
            Axes::Global => String::new(),
            Axes::Normal(normal) => format!(", axes = {{ normal = {} }}", vector(normal)),
            Axes::Skew { x, y } => format!(", axes = {}", list([x, y].map(vector))),
            Axes::Cylindrical { point, axis } => {
                let (point, axis) = (vector(point), vector(axis));
                format!(", axes = {{ point = {point}, axis = {axis} }}")
            }
        };
        for (name, component) in COORDINATES.iter().zip(&one.components) {
            if let Some(target) = component {
                told += &format!(", {name} = {}", varying(target));
            }
        }
        format!("{{ {told}{} }}", self.curve(&one.curve))
    }

    fn release(&mut self, one: &Release) -> Option<String> {
        let named = COORDINATES.iter().zip(one.components);
        let components = named
            .filter(|(_, freed)| *freed)
            .map(|(name, _)| text(name));
        let components: Vec<String> = components.collect();
        if components.is_empty() {
            return None;
        }
        let set = text(&self.meshes.nodes(one.body, "", &one.nodes));
        let (body, components) = (text(&self.model.bodies[one.body.0].name), list(components));
        Some(format!(
            "{{ body = {body}, nodes = {set}, components = {components} }}"
        ))
    }

    fn load(&mut self, one: &'m Load) -> String {
        let set = text(&self.meshes.facets(one.body, &one.set, &one.faces));
        let body = text(&self.model.bodies[one.body.0].name);
        let kind = match &one.kind {
            LoadKind::DeadTraction(target) => {
                format!(
                    "vector = {}, direction = \"dead\"",
                    list(target.iter().map(varying))
                )
            }
            LoadKind::FollowerTraction(target) => {
                format!(
                    "vector = {}, direction = \"follower\"",
                    list(target.iter().map(varying))
                )
            }
            LoadKind::Pressure(target) => format!("value = {}", varying(target)),
        };
        let extent = match one.extent {
            LoadExtent::Whole => "whole",
            LoadExtent::Exposed => "exposed",
        };
        let curve = self.curve(&one.curve);
        format!("{{ body = {body}, facets = {set}, {kind}, extent = \"{extent}\"{curve} }}")
    }

    fn force(&mut self, one: &'m NodalForce) -> String {
        let set = text(&self.meshes.nodes(one.body, &one.set, &one.nodes));
        let body = text(&self.model.bodies[one.body.0].name);
        let each = list(one.force.iter().map(varying));
        let curve = self.curve(&one.curve);
        format!("{{ body = {body}, nodes = {set}, each = {each}{curve} }}")
    }

    fn motion(&mut self, step: &Step, one: &'m RigidMotion) -> String {
        let name = &self.model.rigid_surfaces[one.surface.0].name;
        let mut told = format!("surface = {}", text(name));
        let (places, angles) = one.coordinates.split_at(3);
        for (key, part) in [("displacement", places), ("rotation", angles)] {
            let target = |freedom: &Freedom| match freedom {
                Freedom::To(target) if key == "rotation" => number(degrees(*target)),
                Freedom::To(target) => number(*target),
                Freedom::Free | Freedom::AsBefore => number(0.0),
            };
            let moved = part.iter().any(|one| matches!(one, Freedom::To(_)));
            if moved && part.contains(&Freedom::AsBefore) {
                let part = format!("step `{}`, rigid body `{name}`", step.name);
                let reason = "some of its components move and others keep their state";
                self.refuse(part, reason);
            }
            if moved {
                told += &format!(", {key} = {}", list(part.iter().map(target)));
            }
        }
        let named = COORDINATES.iter().zip(&one.coordinates);
        let free = named.filter(|(_, freedom)| **freedom == Freedom::Free);
        let free: Vec<String> = free.map(|(name, _)| text(name)).collect();
        if !free.is_empty() {
            told += &format!(", free = {}", list(free));
        }
        for (key, target) in [("force", &one.force), ("torque", &one.torque)] {
            if let Some(target) = target {
                told += &format!(", {key} = {}", vector(target));
            }
        }
        format!("{{ {told}{} }}", self.curve(&one.curve))
    }
}
