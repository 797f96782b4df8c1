//! Free rigid bodies on a deformable base: pushed, dropped and rolled.

use super::{
    Dialect,
    convex::{Solid, cuboid, roller, volume},
    parts::{Stance, Units, body, coulomb, pair_with, placement, scene},
    simple::{plain_block, rubbery},
};
use crate::scenes::{
    claim::{Claim, Quantity},
    law::Law,
    random::Random,
    scene::{Drive, End, Ending, Rigid, RigidShape, Scene, Step},
    vector::Vector,
};

const ALL: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

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
