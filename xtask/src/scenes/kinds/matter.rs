//! Metal, rubber that relaxes and fibres: a block between a rigid plane and two planes of symmetry,
//! in uniaxial stress.
//!
//! | material | force over the area at rest |
//! | --- | --- |
//! | metal | `(Y + H e)/(1 + H/E) exp(e)`, with `e = -ln(1 - d/h)` |
//! | rubber | falls by `(3 K + G (1 + r))/((1 + r) (3 K + G))` from a sudden press to rest |
//! | fibres along | `(E + M) e` |
//! | fibres across | `e/(1/E - M (nu/E)^2/(1 + M/E))` |

use super::{
    Dialect,
    elements::CELLS,
    parts::{Stance, Units, body, pair_with, placement, scene},
    simple::{elastic, plain_block},
};
use crate::scenes::{
    claim::{Claim, Quantity, about},
    law::Law,
    random::Random,
    scene::{Beside, Body, End, Ending, Material, Rigid, RigidShape, Scene, Step},
    vector::Vector,
};

const UP: Vector = [0.0, 0.0, 1.0];

/// A block on a rigid plane.
struct Sample {
    scene: Scene,
    modulus: f64,
    high: f64,
    area: f64,
}

fn sample(random: &mut Random, of: impl FnOnce(f64) -> Material) -> Sample {
    let units = Units::random(random);
    let size = [0; 3].map(|_| random.between(0.5, 1.0) * units.length);
    let divisions = [
        random.whole(1..=3),
        random.whole(1..=3),
        random.whole(1..=3),
    ];
    let mut block = plain_block([0.0; 3], size, divisions);
    block.cells = random.chance(0.4).then(|| random.one_of(&CELLS));
    let block: Body = body("block", of(units.modulus), block);
    let sides = [("block", Some("zmin")), ("floor", None)];
    let law = Law::Frictionless;
    let pair = pair_with(random, "contact", sides, units.length, 1.0, law);
    let placement = placement(random, units, Stance::Upright);
    let mut scene = scene(placement, None, vec![block], vec![pair]);
    scene.rigid.push(Rigid {
        name: "floor",
        shape: RigidShape::Plane([0.0; 3], UP),
    });
    scene.ending = Ending::Completes;
    Sample {
        scene,
        modulus: units.modulus,
        high: size[2],
        area: size[0] * size[1],
    }
}

impl Sample {
    fn to(&self, name: &'static str, depth: f64) -> Step {
        Step::new(name).holding("block", "zmax", [None, None, Some(-depth)])
    }

    fn press(&self, depth: f64) -> Step {
        self.to("press", depth)
            .holding("block", "xmin", [Some(0.0), None, None])
            .holding("block", "ymin", [None, Some(0.0), None])
            .ending(End::Touching)
    }

    fn claim(&mut self, step: usize, force: f64, error: f64) {
        let quantity = Quantity::Force(0, "block", UP);
        let claim = Claim::at_end("closed form", step, quantity, about(force, error));
        self.scene.claims.push(claim);
    }
}

/// One of three materials beside elasticity.
pub fn matter(random: &mut Random, _: Dialect) -> Scene {
    match random.whole(0..=2) {
        0 => metal(random),
        1 => rubber(random),
        _ => fibres(random),
    }
}

/// Metal that yields, and is let go by more than it springs back.
fn metal(random: &mut Random) -> Scene {
    let (stress, hardening) = (random.between(0.002, 0.01), random.between(0.0, 0.2));
    let poisson = random.between(0.2, 0.4);
    let mut sample = sample(random, |modulus| Material {
        law: "elastic-plastic",
        beside: Beside::Yield(stress * modulus, hardening * modulus),
        ..elastic(modulus, poisson)
    });
    let strain = random.between(3.0 * stress, 0.08_f64.max(4.0 * stress));
    let depth = sample.high * (1.0 - (-strain).exp());
    let flow = (stress + hardening * strain) / (1.0 + hardening);
    sample.scene.steps = vec![
        sample.press(depth).within(Some(random.whole(5..=15))),
        sample
            .to("release", depth - 2.0 * flow * sample.high)
            .ending(End::Apart),
    ];
    let force = flow * sample.modulus * sample.area * strain.exp();
    sample.claim(0, force, 0.02);
    sample.scene
}

/// Rubber that relaxes after a sudden press.
fn rubber(random: &mut Random) -> Scene {
    let poisson = random.between(0.4, 0.49);
    let (ratio, time) = (random.between(0.3, 2.0), random.decade(1e-2, 1e2));
    let mut sample = sample(random, |modulus| Material {
        law: "isochoric-neo-hookean",
        beside: Beside::Relaxation(ratio, time),
        ..elastic(modulus, poisson)
    });
    let strain = random.between(0.005, 0.02);
    let depth = strain * sample.high;
    let mut press = sample.press(depth).within(Some(4));
    press.duration = Some(0.01 * time);
    let mut hold = sample.to("hold", depth).ending(End::Touching);
    hold.duration = Some(10.0 * time);
    hold.increments = Some(random.whole(20..=40));
    sample.scene.steps = vec![press, hold];
    // With G = 1.
    let bulk = 2.0 * (1.0 + poisson) / (3.0 * (1.0 - 2.0 * poisson));
    let fall = (3.0 * bulk + 1.0 + ratio) / ((1.0 + ratio) * (3.0 * bulk + 1.0));
    let quantity = Quantity::Since(0, "block", UP, 0);
    let claim = Claim::at_end("closed form", 1, quantity, about(fall, 0.03));
    sample.scene.claims.push(claim);
    let rest = sample.modulus * strain * sample.area;
    sample.claim(1, rest, 0.06);
    sample.scene
}

/// A block with linear fibres along or across the press.
fn fibres(random: &mut Random) -> Scene {
    let poisson = random.between(0.0, 0.4);
    let stiff = random.between(0.3, 5.0);
    let along = random.chance(0.5);
    let direction = if along { UP } else { [1.0, 0.0, 0.0] };
    let mut sample = sample(random, |modulus| Material {
        law: "neo-hookean",
        beside: Beside::Fibres(stiff * modulus, direction),
        ..elastic(modulus, poisson)
    });
    let strain = random.between(0.001, 0.004);
    sample.scene.steps = vec![sample.press(strain * sample.high)];
    let stiffness = if along {
        1.0 + stiff
    } else {
        1.0 / (1.0 - stiff * poisson * poisson / (1.0 + stiff))
    };
    let force = sample.modulus * stiffness * strain * sample.area;
    sample.claim(0, force, 0.02);
    sample.scene
}
