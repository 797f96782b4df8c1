//! Blocks that loads alone press and push, held by friction.

use super::{
    Dialect,
    parts::{Stance, Units, body, coulomb, increments, pair_with, placement, scene},
    simple::{plain_block, rubbery},
};
use crate::scenes::{
    claim::{Claim, Quantity, about},
    random::Random,
    scene::{End, Ending, Scene, Step},
    vector::Vector,
};

/// A block that lies on a base, its middle at a place of it.
struct Laid {
    scene: Scene,
    units: Units,
    area: f64,
    high: f64,
    pressure: f64,
    mu: f64,
    softest: f64,
}

/// Position of the centre of the block, and its width, over the half width and the width of the
/// base.
struct Place {
    middle: [f64; 2],
    share: [f64; 2],
}

fn laid(random: &mut Random, place: &Place) -> Laid {
    let units = Units::random(random);
    let unit = units.length;
    let below = random.between(0.3, 0.6) * unit;
    let plan = place.share.map(|share| share * unit);
    let high = plan[0].min(plan[1]) * random.between(0.2, 0.4);
    let mut mesh = |most| {
        [
            random.whole(2..=most),
            random.whole(2..=most),
            random.whole(1..=2),
        ]
    };
    let base = plain_block(
        [-0.5 * unit, -0.5 * unit, -below],
        [unit, unit, below],
        mesh(6),
    );
    let corner = [0, 1].map(|i| 0.5 * (place.middle[i] * unit - plan[i]));
    let block = plain_block(
        [corner[0], corner[1], 0.0],
        [plan[0], plan[1], high],
        mesh(5),
    );
    let ratio = random.decade(1e-3, 1e3);
    let law = coulomb(random, 0.2, 0.5);
    let mu = law.coefficient();
    let softest = units.modulus * ratio.min(1.0);
    let pressure = random.between(0.0005, 0.004) * softest;
    let sides = [("base", Some("zmax")), ("block", Some("zmin"))];
    let mut pair = pair_with(random, "contact", sides, unit, pressure, law);
    (pair.cap, pair.decay) = (None, None);
    let poisson = random.between(0.0, 0.4);
    let bodies = vec![
        body("base", rubbery(units.modulus, poisson), base),
        body("block", rubbery(units.modulus * ratio, poisson), block),
    ];
    let placement = placement(random, units, Stance::Any);
    Laid {
        scene: scene(placement, Some(ratio), bodies, vec![pair]),
        units,
        area: plan[0] * plan[1],
        high,
        pressure,
        mu,
        softest,
    }
}

impl Laid {
    fn step(&self, random: &mut Random, name: &'static str, traction: Vector) -> Step {
        let mut step = Step::new(name).within(increments(random));
        step.tractions.push(("block", "zmax", traction, self.area));
        step
    }

    /// The first step, with the base held.
    fn load(&self, random: &mut Random) -> Step {
        self.step(random, "load", [0.0, 0.0, -self.pressure])
            .moving("base", "zmin", [0.0; 3])
            .ending(End::Touching)
    }

    /// The block stays within a share of its height of where it was laid.
    fn stays(&mut self, step: usize, share: f64) {
        for along in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
            let quantity = Quantity::Drift("centre.block".into(), along);
            let bounds = [-share * self.high, share * self.high];
            let claim = Claim::at_end("stands", step, quantity, bounds);
            self.scene.claims.push(claim);
        }
    }
}

/// Pressed and pushed by loads: below the limit of friction it holds, beyond it slides off.
pub fn forces(random: &mut Random, _: Dialect) -> Scene {
    let place = Place {
        middle: [0; 2].map(|_| random.between(-0.2, 0.2)),
        share: [0; 2].map(|_| random.between(0.4, 0.7)),
    };
    let mut laid = laid(random, &place);
    let holds = random.chance(0.6);
    let share = if holds {
        random.between(0.2, 0.8)
    } else {
        random.between(1.15, 1.6)
    };
    let angle = random.between(0.0, std::f64::consts::TAU);
    let push = share * laid.mu * laid.pressure;
    let traction = [push * angle.cos(), push * angle.sin(), -laid.pressure];
    let load = laid.load(random);
    let push = laid.step(random, "push", traction);
    laid.scene.steps = vec![load, push];
    if holds {
        laid.scene.ending = Ending::Completes;
        laid.stays(1, 0.25);
        let force = laid.pressure * laid.area;
        for step in 0..2 {
            let quantity = Quantity::Force(0, "block", [0.0, 0.0, 1.0]);
            let claim = Claim::at_end("closed form", step, quantity, about(force, 1e-6));
            laid.scene.claims.push(claim);
        }
    } else {
        laid.scene.ending = Ending::Stops(&[
            "limit of friction",
            "no equilibrium",
            "nothing else restrains",
        ]);
    }
    laid.scene
}

/// A dead load whose middle is inside the edge of the base by a tenth of its width or more.
pub fn dead_load(random: &mut Random, _: Dialect) -> Scene {
    let share = [0; 2].map(|_| random.between(0.4, 0.8));
    let at_corner = random.chance(0.3);
    // Over the half width: a tenth of the width is a fifth of it.
    let near = 1.0 - random.between(0.2, 0.6);
    let aside = if at_corner {
        random.sign() * (1.0 - random.between(0.2, 0.6))
    } else {
        random.between(-0.2, 0.2)
    };
    let place = Place {
        middle: [random.sign() * near, aside],
        share,
    };
    let mut laid = laid(random, &place);
    laid.scene.ending = Ending::Completes;
    let mut load = laid.load(random);
    if random.chance(0.4) {
        let density = random.decade(1e-2, 1e3);
        for body in &mut laid.scene.bodies {
            body.material.density = Some(density);
        }
        let speed = (laid.softest / density).sqrt();
        load.spectral_radius = Some(random.between(0.3, 0.8));
        load.duration = Some(random.between(20.0, 60.0) * laid.units.length / speed);
        load.increments = Some(random.whole(15..=30));
    } else {
        for (axis, along) in [(0, [1.0, 0.0, 0.0]), (1, [0.0, 1.0, 0.0])] {
            let middle = 0.5 * place.middle[axis] * laid.units.length;
            let band = 0.03 * laid.units.length;
            let quantity = Quantity::Lever(vec![0], "block", along);
            let claim = Claim::at_end("stands", 0, quantity, [middle - band, middle + band]);
            laid.scene.claims.push(claim);
        }
    }
    laid.scene.steps = vec![load];
    laid.stays(0, 0.25);
    laid.scene
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::scene::Shape;

    #[test]
    fn dead_loads_are_inside_by_a_tenth_of_the_width() {
        for seed in 0..200 {
            let scene = dead_load(&mut Random::new(seed), Dialect::default());
            let [base, block] = [0, 1].map(|i| match &scene.bodies[i].shape {
                Shape::Block(block) => block.clone(),
                _ => unreachable!("both are blocks"),
            });
            for axis in 0..2 {
                let middle = block.origin[axis] + 0.5 * block.size[axis];
                let room = 0.5 * base.size[axis] - middle.abs();
                assert!(room >= 0.0999 * base.size[axis], "{seed}: {room}");
            }
        }
    }
}
