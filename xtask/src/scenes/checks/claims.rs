//! Claims of a kind of scene about its results, see [`crate::scenes::claim`].
//!
//! A force that is none where the claim is one above zero is contact that was missed: it is
//! noted as `contact`.

use std::{f64::consts::FRAC_1_SQRT_2, path::Path};

use crate::scenes::{
    claim::{Claim, Quantity},
    geometry::area,
    law::Point,
    output::{Fields, History},
    scene::{Pair, Scene, Texture},
    vector::{Vector, applied, dot, length, minus, plus, times, transposed, unit},
    vtu::Grid,
};

use super::Findings;

/// The output of a run, and of that of its reference.
pub struct Output<'a> {
    /// Folder.
    pub folder: &'a Path,
    /// The scene.
    pub scene: &'a Scene,
    /// Its history.
    pub history: &'a History,
    /// The history of the reference.
    pub reference: Option<&'a History>,
}

/// Checks all claims.
pub fn check(findings: &mut Findings, output: &Output) {
    for claim in &output.scene.claims {
        for row in rows(output.scene, output.history, claim) {
            let Some(value) = output.value(&claim.quantity, row, claim.step) else {
                continue;
            };
            let place = || {
                let Claim { low, high, .. } = claim;
                let quantity = &claim.quantity;
                format!(
                    "{quantity:?}, increment {}: {value:.4e}, claimed {low:.4e} to {high:.4e}",
                    row + 1
                )
            };
            let is_force = matches!(claim.quantity, Quantity::Force(..) | Quantity::Beside(..));
            if is_force && value == 0.0 && claim.low > 0.0 {
                findings.note("contact", f64::INFINITY, place);
            } else {
                findings.note(claim.check, claim.measure(value), place);
            }
        }
    }
}

/// The row at the end of a step.
fn end_row(scene: &Scene, history: &History, step: usize) -> Option<usize> {
    let end = scene.end_of(step);
    let is_end = |&row: &usize| {
        let time = history.number(row, "time");
        time.is_some_and(|time| (time - end).abs() < 1e-9 * end)
    };
    (0..history.len()).find(is_end)
}

/// The rows that a claim is about.
fn rows(scene: &Scene, history: &History, claim: &Claim) -> Vec<usize> {
    if claim.from >= 1.0 {
        return end_row(scene, history, claim.step).into_iter().collect();
    }
    let end = scene.end_of(claim.step);
    let duration = scene.steps[claim.step].duration.unwrap_or(1.0);
    let from = end - (1.0 - claim.from) * duration;
    let counts = |&row: &usize| {
        let time = history.number(row, "time").unwrap_or(f64::NAN);
        time > from - 1e-9 * end && time < end + 1e-9 * end
    };
    // What ends at the start of the step belongs to the one before.
    let own = |&row: &usize| history.number(row, "step") == Some(claim.step as f64 + 1.0);
    (0..history.len()).filter(counts).filter(own).collect()
}

impl Output<'_> {
    fn value(&self, quantity: &Quantity, row: usize, step: usize) -> Option<f64> {
        let along = |force: Vector, direction: &Vector| {
            dot(force, self.scene.placement.direction(*direction))
        };
        let now = |pair: &usize, owner: &str| on_body(self.scene, self.history, row, *pair, owner);
        Some(match quantity {
            Quantity::Force(pair, owner, direction) => along(now(pair, owner)?, direction),
            Quantity::Pull(tie, owner, direction) => {
                let of_tie = &self.scene.ties[*tie];
                let sign = if of_tie.sides[0].0 == *owner {
                    1.0
                } else {
                    -1.0
                };
                let force = self
                    .history
                    .vector(row, &format!("tie.{}.force_a", of_tie.name))?;
                sign * along(force, direction)
            }
            Quantity::Beside(pair, owner, direction) => {
                let (scene, history) = (self.scene.reference.as_deref()?, self.reference?);
                let other_row = end_row(scene, history, step)?;
                let other = on_body(scene, history, other_row, *pair, owner)?;
                let other = dot(other, scene.placement.direction(*direction));
                along(now(pair, owner)?, direction) / other
            }
            Quantity::Since(pair, owner, direction, other) => {
                let other = end_row(self.scene, self.history, *other)?;
                let other = on_body(self.scene, self.history, other, *pair, owner)?;
                along(now(pair, owner)?, direction) / along(other, direction)
            }
            Quantity::Friction(pair) => {
                let name = &self.scene.pairs[*pair].name;
                let of = |what: &str| {
                    self.history
                        .number(row, &format!("pair.{name}.{what}_integral_a"))
                };
                of("friction")? / of("pressure")?
            }
            Quantity::Law(pair) => self.law(row, *pair)?,
            Quantity::Lever(pairs, owner, direction) => {
                self.lever(row, pairs, owner, *direction)?
            }
            Quantity::Column(name, direction) => along(self.history.vector(row, name)?, direction),
            Quantity::Drift(name, direction) => {
                let moved = minus(
                    self.history.vector(row, name)?,
                    self.history.vector(0, name)?,
                );
                along(moved, direction)
            }
        })
    }

    /// Use of the law by the resultant on the side with the texture, or on the first one.
    ///
    /// Normals of a pair are nearer to those of the stiffer side, whose mean is taken.
    fn law(&self, row: usize, index: usize) -> Option<f64> {
        let pair = &self.scene.pairs[index];
        let fields = Fields::read(self.folder, self.scene, row + 1).ok()??;
        let textured = pair.sides.iter().position(|side| side.texture.is_some());
        let side = textured.unwrap_or(0);
        let sides = &fields.pairs[index];
        let modulus = |side: usize| {
            let owner = pair.sides[side].owner;
            let body = self.scene.bodies.iter().find(|body| body.name == owner);
            // Of a rigid side there are no fields.
            body.map_or(0.0, |body| body.material.modulus)
        };
        let seen = if modulus(side) >= modulus(1 - side) {
            side
        } else {
            1 - side
        };
        let sign = if seen == side { 1.0 } else { -1.0 };
        let normal = times(sign, mean_normal(sides[seen].as_ref()?)?);
        let owner = pair.sides[side].owner;
        let force = on_body(self.scene, self.history, row, index, owner)?;
        let pressure = -dot(force, normal);
        let friction = plus(force, times(pressure, normal));
        let texture = match pair.sides[side].texture {
            Some(Texture::Uniform(direction, 0.0)) => {
                let s = self.scene.placement.direction(direction);
                unit(minus(s, times(dot(s, normal), normal)))
            }
            _ => [0.0; 3],
        };
        let point = Point {
            pressure,
            friction,
            normal,
            texture,
        };
        Some(pair.law.use_of(&point, None))
    }

    /// Mean of the centres of pressure of pairs, weighted with their forces, from the local
    /// origin.
    fn lever(&self, row: usize, pairs: &[usize], owner: &str, direction: Vector) -> Option<f64> {
        let place = &self.scene.placement;
        let (mut sum, mut moment) = (0.0, 0.0);
        for &pair in pairs {
            let force = on_body(self.scene, self.history, row, pair, owner)?;
            let force = dot(force, place.direction([0.0, 0.0, 1.0]));
            let name = &self.scene.pairs[pair].name;
            let centre = self.history.vector(row, &format!("pair.{name}.centre"))?;
            let centre = applied(&transposed(&place.matrix()), minus(centre, place.shift));
            sum += force;
            moment += force * dot(centre, direction);
        }
        Some(moment / sum)
    }
}

/// Force of a pair on one of its two bodies.
fn on_body(
    scene: &Scene,
    history: &History,
    row: usize,
    pair: usize,
    owner: &str,
) -> Option<Vector> {
    let Pair { name, sides, .. } = &scene.pairs[pair];
    let letter = if sides[0].owner == owner { "a" } else { "b" };
    history.vector(row, &format!("pair.{name}.resultant_{letter}"))
}

/// Mean normal of the face that bears most, weighted with pressure and area.
///
/// In contact of everything a flank takes part with slivers of its facets, which weigh far less than
/// the area about its nodes. Normals at more than 45 degrees from the first mean are of such faces.
fn mean_normal(grid: &Grid) -> Option<Vector> {
    let (pressure, normals) = (grid.scalars("pressure")?, grid.vectors("normal")?);
    let mut areas = vec![0.0; grid.points.len()];
    for (index, cell) in grid.cells.iter().enumerate() {
        let share = area(&grid.corners(index)) / cell.len() as f64;
        for &node in cell {
            areas[node] += share;
        }
    }
    let mean = |near: &dyn Fn(Vector) -> bool| {
        let nodes = (0..areas.len()).filter(|&i| near(normals[i]));
        let sum = nodes
            .map(|i| times(areas[i] * pressure[i], normals[i]))
            .fold([0.0; 3], plus);
        (length(sum) > 0.0).then(|| unit(sum))
    };
    let first = mean(&|_| true)?;
    mean(&|normal| dot(normal, first) > FRAC_1_SQRT_2)
}
