//! Free rigid bodies on a deformable base: pushed, dropped and rolled.

use super::{
    Dialect,
    parts::{Stance, Units, body, coulomb, pair_with, placement, plain_block, rubbery, scene},
};
use crate::scenes::{
    claim::{Claim, Quantity},
    law::Law,
    random::Random,
    scene::{Drive, End, Ending, Rigid, RigidShape, Scene, Step},
    vector::Vector,
};

const ALL: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// A convex solid about its middle.
struct Solid {
    corners: Vec<Vector>,
    facets: Vec<[usize; 4]>,
    /// From its middle down to the base.
    below: f64,
    /// Its volume over the area on which it lies.
    high: f64,
}

fn cuboid(size: Vector) -> Solid {
    let corners = (0..8).map(|i| {
        let sign = |bit: usize| if i & bit > 0 { 0.5 } else { -0.5 };
        [size[0] * sign(1), size[1] * sign(2), size[2] * sign(4)]
    });
    Solid {
        corners: corners.collect(),
        facets: vec![
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ],
        below: 0.5 * size[2],
        high: size[2],
    }
}

/// A prism of many sides about the axis `y`, on one of them.
fn roller(radius: f64, long: f64, sides: usize) -> Solid {
    let at = |i: usize, y: f64| {
        let (sine, cosine) = ((i as f64 + 0.5) * std::f64::consts::TAU / sides as f64).sin_cos();
        [radius * sine, y, -radius * cosine]
    };
    let mut corners: Vec<Vector> = (0..sides).map(|i| at(i, -0.5 * long)).collect();
    corners.extend((0..sides).map(|i| at(i, 0.5 * long)));
    corners.extend([[0.0, -0.5 * long, 0.0], [0.0, 0.5 * long, 0.0]]);
    let mut facets = Vec::new();
    for i in 0..sides {
        let next = (i + 1) % sides;
        facets.push([i, i + sides, next + sides, next]);
        facets.push([2 * sides, i, next, next]);
        facets.push([2 * sides + 1, next + sides, i + sides, i + sides]);
    }
    let below = radius * (std::f64::consts::PI / sides as f64).cos();
    Solid {
        corners,
        facets,
        below,
        high: radius,
    }
}

/// A free solid above a base.
struct Ground {
    scene: Scene,
    gravity: f64,
    mass: f64,
}

fn ground(random: &mut Random, units: Units, solid: Solid, gap: f64, law: Law) -> Ground {
    let unit = units.length;
    let divisions = [random.whole(6..=9), random.whole(3..=5), 2];
    let base = plain_block(
        [-unit, -0.5 * unit, -0.5 * unit],
        [2.0 * unit, unit, 0.5 * unit],
        divisions,
    );
    let density = random.decade(1e-2, 1e2);
    let mut material = rubbery(units.modulus, random.between(0.0, 0.4));
    material.density = Some(density);
    let strain = random.between(0.0005, 0.003);
    let gravity = strain * units.modulus / (density * solid.high);
    let sides = [("base", Some("zmax")), ("solid", None)];
    let mut pair = pair_with(random, "contact", sides, unit, units.modulus, law);
    (pair.cap, pair.decay) = (None, None);
    let placement = placement(random, units, Stance::Any);
    let mut scene = scene(
        placement,
        None,
        vec![body("base", material, base)],
        vec![pair],
    );
    let mass = density * volume(&solid);
    let at = [0.0, 0.0, solid.below + gap];
    scene.rigid.push(Rigid {
        name: "solid",
        shape: RigidShape::Solid(solid.corners, solid.facets, at, density),
    });
    Ground {
        scene,
        gravity,
        mass,
    }
}

/// Volume of a solid about the origin.
fn volume(solid: &Solid) -> f64 {
    use crate::scenes::vector::{cross, dot};
    let of = |facet: &[usize; 4]| {
        let [a, b, c, d] = facet.map(|i| solid.corners[i]);
        (dot(cross(a, b), c) + dot(cross(a, c), d)) / 6.0
    };
    solid.facets.iter().map(of).sum()
}

impl Ground {
    fn step(&self, name: &'static str, duration: f64, force: Vector) -> Step {
        let mut step = Step::new(name)
            .moving("base", "zmin", [0.0; 3])
            .ending(End::Met);
        step.gravity = Some([0.0, 0.0, -self.gravity]);
        step.duration = Some(duration);
        step.spectral_radius = Some(0.5);
        step.drives.push(Drive {
            name: "solid",
            free: &ALL,
            force,
            torque: [0.0; 3],
        });
        step
    }

    fn goes(&mut self, along: Vector, bounds: [f64; 2]) {
        let quantity = Quantity::Column("displacement.solid".into(), along);
        let claim = Claim::at_end("stands", 0, quantity, bounds);
        self.scene.claims.push(claim);
    }
}

/// A free rigid body, pushed, dropped or rolled.
pub fn solids(random: &mut Random, _: Dialect) -> Scene {
    let mut scene = match random.whole(0..=2) {
        0 => pushed(random),
        1 => dropped(random),
        _ => rolled(random),
    };
    scene.ending = Ending::Completes;
    scene
}

/// A flat box under its weight, pushed: it stays, or goes by `(F/m - mu g) t^2/2`.
fn pushed(random: &mut Random) -> Scene {
    let units = Units::random(random);
    let unit = units.length;
    let size = [0.6, 0.5, 0.15].map(|share| share * random.between(0.8, 1.2) * unit);
    let law = coulomb(random, 0.1, 0.5);
    let mu = law.coefficient();
    let mut ground = ground(random, units, cuboid(size), 0.0, law);
    let moves = random.chance(0.5);
    let share = if moves {
        random.between(1.5, 3.0)
    } else {
        random.between(0.1, 0.6)
    };
    let friction = mu * ground.gravity;
    let way = random.between(0.1, 0.4) * unit;
    // The force rises along the step, from where friction holds to its whole.
    let duration = (6.0 * way / friction).sqrt();
    let force = [share * friction * ground.mass, 0.0, 0.0];
    let mut push = ground.step("push", duration, force);
    push.increments = Some(random.whole(30..=60));
    ground.scene.steps = vec![push];
    let slack = 0.03 * unit;
    if moves {
        // a(s) = mu g (share s - 1) from s = 1/share on.
        let rest = 1.0 - 1.0 / share;
        let way = friction * duration * duration * share * rest.powi(3) / 6.0;
        ground.goes([1.0, 0.0, 0.0], [0.85 * way - slack, 1.15 * way + slack]);
    } else {
        ground.goes([1.0, 0.0, 0.0], [-slack, slack]);
    }
    ground.goes([0.0, 1.0, 0.0], [-slack, slack]);
    ground.goes([0.0, 0.0, 1.0], [-slack, slack]);
    ground.scene
}

/// A box or a roller that falls, and rises no higher than it was.
fn dropped(random: &mut Random) -> Scene {
    let units = Units::random(random);
    let unit = units.length;
    let solid = if random.chance(0.5) {
        cuboid([0.5, 0.4, 0.3].map(|share| share * random.between(0.8, 1.2) * unit))
    } else {
        roller(0.2 * unit, 0.5 * unit, 16)
    };
    let gap = random.between(0.01, 0.1) * unit;
    let law = coulomb(random, 0.0, 0.5);
    let mut ground = ground(random, units, solid, gap, law);
    let fall = (2.0 * gap / ground.gravity).sqrt();
    let mut drop = ground.step("drop", 2.0 * fall, [0.0; 3]);
    drop.increments = Some(random.whole(40..=80));
    ground.scene.steps = vec![drop];
    ground.goes([0.0, 0.0, 1.0], [-1.5 * gap, 0.01 * gap]);
    ground.scene
}

/// A roller that rolls without slip: its sides make it jolt, so it goes little less than `v t`.
fn rolled(random: &mut Random) -> Scene {
    let units = Units::random(random);
    let unit = units.length;
    let (radius, sides) = (0.25 * unit, 32);
    let law = coulomb(random, 0.3, 0.6);
    let long = random.between(0.4, 0.8) * unit;
    let mut ground = ground(random, units, roller(radius, long, sides), 0.0, law);
    // Fast enough to pass over an edge: its rise is r (pi/n)^2/2.
    let rise = radius * (std::f64::consts::PI / sides as f64).powi(2) / 2.0;
    let speed = random.between(4.0, 8.0) * (2.0 * ground.gravity * rise).sqrt();
    let way = random.between(0.3, 0.6) * unit;
    let mut roll = ground.step("roll", way / speed, [0.0; 3]);
    roll.increments = Some(random.whole(40..=80));
    let spin = [0.0, speed / radius, 0.0];
    let axis = [0.0, 0.0, radius];
    roll.throws.push(("solid", [speed, 0.0, 0.0], spin, axis));
    ground.scene.steps = vec![roll];
    ground.goes([1.0, 0.0, 0.0], [0.75 * way, 1.1 * way]);
    ground.goes([0.0, 1.0, 0.0], [-0.05 * unit, 0.05 * unit]);
    ground.scene
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::vector::{cross, dot, minus};

    #[test]
    fn facets_of_solids_look_outwards() {
        for solid in [cuboid([1.0, 2.0, 3.0]), roller(1.0, 2.0, 12)] {
            for [a, b, c, _] in &solid.facets {
                let [a, b, c] = [a, b, c].map(|&i| solid.corners[i]);
                assert!(dot(cross(minus(b, a), minus(c, a)), a) > 0.0);
            }
        }
        assert!((volume(&cuboid([1.0, 2.0, 3.0])) - 6.0).abs() < 1e-12);
        // A prism of twelve sides has an area of 3.
        assert!((volume(&roller(1.0, 2.0, 12)) - 6.0).abs() < 1e-12);
    }
}
