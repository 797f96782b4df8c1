//! Blocks that slide over a larger one all the time: tools, reversals, long ways, rates.
//!
//! Where all nodes slip, the integral of friction over that of pressure is the coefficient of
//! Coulomb's law, and the resultant lies on the slip surface of any law, with the mean normal.

use super::{
    Dialect,
    parts::{
        Stance, Units, body, coulomb, pair_with, placement, plain_block, rubbery, rubbing, scene,
    },
};
use crate::scenes::{
    claim::{Claim, Quantity, about},
    law::Law,
    random::Random,
    scene::{End, Ending, Pair, Rigid, RigidShape, Scene, Step, Texture},
    vector::Vector,
};

/// Error of friction over pressure.
const SLIDING: f64 = 0.01;

/// A slider on a slab.
struct Slab {
    scene: Scene,
    units: Units,
    /// Depth to which the slider is pressed.
    depth: f64,
    /// Facets of slab and slider along the way.
    facets: [f64; 2],
    /// Way that is taken up before all slips.
    lag: f64,
    /// Length of the slab beyond the slider.
    room: f64,
}

/// Wishes for a slider.
struct Wanted {
    /// Its modulus over that of the slab.
    ratio: f64,
    /// Strain of the softer one.
    strain: f64,
    /// Length of the slab over that of the slider.
    length: f64,
    law: Law,
}

fn slab(random: &mut Random, wanted: &Wanted) -> Slab {
    let units = Units::random(random);
    let unit = units.length;
    let side = random.between(0.3, 0.5) * unit;
    let [high, tall] = [0, 1].map(|_| random.between(0.25, 0.4) * unit);
    let long = wanted.length * side;
    let lower = plain_block(
        [-0.5 * side, -unit * 0.5, -high],
        [long, unit, high],
        [
            ((long / side) * random.between(1.5, 3.0)).round() as usize,
            random.whole(3..=5),
            2,
        ],
    );
    let divisions = [
        random.whole(1..=4),
        random.whole(1..=4),
        random.whole(1..=2),
    ];
    let upper = plain_block(
        [-0.5 * side, -0.5 * side, 0.0],
        [side, side, tall],
        divisions,
    );
    let modulus = units.modulus;
    let poisson = [0, 1].map(|_| random.between(0.0, 0.4));
    let softer = modulus * wanted.ratio.min(1.0);
    // The slab is about as stiff as a column of twice the plan.
    let compliance = 0.5 * high / modulus + tall / (modulus * wanted.ratio);
    let pressure = wanted.strain * softer;
    let mu = wanted.law.largest();
    let sides = [("slab", Some("zmax")), ("slider", Some("zmin"))];
    let mut pair = pair_with(random, "contact", sides, unit, pressure, wanted.law.clone());
    (pair.cap, pair.decay) = (None, None);
    straight(random, &mut pair);
    let facets = [
        lower.size[0] / lower.divisions[0] as f64,
        side / upper.divisions[0] as f64,
    ];
    let bodies = vec![
        body("slab", rubbery(modulus, poisson[0]), lower),
        body("slider", rubbery(modulus * wanted.ratio, poisson[1]), upper),
    ];
    let placement = placement(random, units, Stance::Any);
    let mut scene = scene(placement, Some(wanted.ratio), bodies, vec![pair]);
    scene.ending = Ending::Completes;
    Slab {
        scene,
        units,
        depth: pressure * compliance,
        facets,
        lag: 3.0 * mu * pressure * compliance,
        room: long - side,
    }
}

/// Makes the textures of a pair straight ones, at random angles.
fn straight(random: &mut Random, pair: &mut Pair) {
    for side in &mut pair.sides {
        let angle = random.between(0.0, std::f64::consts::TAU);
        let texture = Texture::Uniform([angle.cos(), angle.sin(), 0.0], 0.0);
        side.texture = side.texture.map(|_| texture);
    }
}

impl Slab {
    fn press(&self) -> Step {
        Step::new("press")
            .moving("slab", "zmin", [0.0; 3])
            .moving("slider", "zmax", [0.0, 0.0, -self.depth])
            .within(Some(5))
            .ending(End::Touching)
    }

    fn to(&self, name: &'static str, x: f64) -> Step {
        Step::new(name)
            .moving("slider", "zmax", [x, 0.0, -self.depth])
            .ending(End::Touching)
    }

    /// Claims of a step in which the slider goes a way.
    fn claim(&mut self, step: usize, way: f64) {
        let from = (self.lag / way + 1e-6).min(1.0);
        for quantity in claims(&self.scene.pairs[0].law) {
            let claim = Claim::at_end("sliding", step, quantity, about(1.0, SLIDING));
            self.scene.claims.push(claim.within(from));
        }
        if let Law::Coulomb(mu) = self.scene.pairs[0].law {
            let bounds = about(mu, SLIDING);
            let claim = Claim::at_end("sliding", step, Quantity::Friction(0), bounds);
            self.scene.claims.push(claim.within(from));
        }
    }
}

/// What is claimed of a law in full slip; of two textures the output does not tell it.
fn claims(law: &Law) -> Vec<Quantity> {
    match law {
        Law::TwoTextures(..) | Law::Frictionless => Vec::new(),
        _ => vec![Quantity::Law(0)],
    }
}

/// A stiff block over a softer one, by 0.3 to 2 facets an increment.
pub fn tool(random: &mut Random, _: Dialect) -> Scene {
    if random.chance(0.3) {
        return blade(random);
    }
    let law = rubbing(random);
    let wanted = Wanted {
        ratio: random.decade(3.0, 1e4),
        strain: random.between(0.005, 0.04),
        length: random.between(2.5, 4.0),
        law,
    };
    let mut slab = slab(random, &wanted);
    let each = random.between(0.3, 2.0) * slab.facets[0];
    let count = ((slab.room - 0.1 * slab.units.length) / each)
        .floor()
        .clamp(2.0, 15.0);
    let way = count * each;
    let slide = slab.to("slide", way).within(Some(count as usize));
    slab.claim(1, way);
    slab.scene.steps = vec![slab.press(), slide];
    slab.scene
}

/// A sharp rigid ridge under a block, by 0.3 to 2 facets an increment.
fn blade(random: &mut Random) -> Scene {
    let units = Units::random(random);
    let unit = units.length;
    let divisions = [random.whole(5..=8), random.whole(1..=3), 2];
    let size = [
        unit,
        random.between(0.3, 0.6) * unit,
        random.between(0.3, 0.5) * unit,
    ];
    let block = plain_block([-0.5 * size[0], -0.5 * size[1], 0.0], size, divisions);
    let facet = size[0] / divisions[0] as f64;
    let law = coulomb(random, 0.05, 0.5);
    let mu = law.coefficient();
    let depth = random.between(0.1, 0.5) * facet;
    let sides = [("block", Some("zmin")), ("blade", None)];
    let mut pair = pair_with(random, "contact", sides, unit, units.modulus, law);
    (pair.cap, pair.decay) = (None, None);
    let material = rubbery(units.modulus, random.between(0.0, 0.4));
    let bodies = vec![body("block", material, block)];
    let placement = placement(random, units, Stance::Any);
    let mut scene = scene(placement, None, bodies, vec![pair]);
    let start = -0.25 * unit;
    let steep = random.between(0.3, 1.0);
    let half = 1.5 * depth / steep + 0.1 * facet;
    let at = |x: f64, y: f64, z: f64| -> Vector { [start + x, y * unit, z] };
    let positions = vec![
        at(-half, -0.4, -half * steep),
        at(-half, 0.4, -half * steep),
        at(0.0, -0.4, 0.0),
        at(0.0, 0.4, 0.0),
        at(half, -0.4, -half * steep),
        at(half, 0.4, -half * steep),
    ];
    let facets = vec![[0, 2, 3, 1], [2, 4, 5, 3]];
    scene.rigid.push(Rigid {
        name: "blade",
        shape: RigidShape::Sheet(positions, facets),
    });
    let press = Step::new("press").moving("block", "zmax", [0.0, 0.0, -depth]);
    let mut press = press.within(Some(5)).ending(End::Touching);
    press.rigid.push(("blade", [0.0; 3], None));
    let each = random.between(0.3, 2.0) * facet;
    let count = (0.5 * unit / each).floor().clamp(2.0, 12.0);
    let mut slide = Step::new("slide").within(Some(count as usize));
    slide.end = End::Touching;
    slide.rigid.push(("blade", [count * each, 0.0, 0.0], None));
    let claim = Claim::at_end("sliding", 1, Quantity::Friction(0), about(mu, SLIDING));
    scene.claims.push(claim.within(0.5));
    scene.steps = vec![press, slide];
    scene.ending = Ending::Completes;
    scene
}

/// Names of twenty steps.
const REVERSALS: [&str; 20] = [
    "there-1", "back-1", "there-2", "back-2", "there-3", "back-3", "there-4", "back-4", "there-5",
    "back-5", "there-6", "back-6", "there-7", "back-7", "there-8", "back-8", "there-9", "back-9",
    "there-10", "back-10",
];

/// Twenty reversals of the direction.
pub fn reversals(random: &mut Random, _: Dialect) -> Scene {
    let law = coulomb(random, 0.05, 0.6);
    let wanted = Wanted {
        ratio: random.decade(1e-3, 1e3),
        strain: random.between(0.003, 0.02),
        length: random.between(2.0, 3.0),
        law,
    };
    let mut slab = slab(random, &wanted);
    let facet = slab.facets[0].min(slab.facets[1]);
    let ahead = (random.between(0.3, 1.2) * facet)
        .max(2.0 * slab.lag)
        .min(slab.room);
    let middle = 0.5 * slab.room;
    let start = slab.to("start", middle).within(Some(4));
    let mut steps = vec![slab.press(), start];
    let increments = random.whole(1..=3);
    for reversal in 0..20 {
        let sign = if reversal % 2 == 0 { 0.5 } else { -0.5 };
        let to = slab.to(REVERSALS[reversal], middle + sign * ahead);
        steps.push(to.within(Some(increments)));
        let mu = slab.scene.pairs[0].law.coefficient();
        let quantity = Quantity::Friction(0);
        let claim = Claim::at_end("sliding", 2 + reversal, quantity, about(mu, SLIDING));
        if reversal > 0 {
            slab.scene.claims.push(claim);
        }
    }
    slab.scene.steps = steps;
    slab.scene
}

/// Several facets an increment.
pub fn far_slip(random: &mut Random, _: Dialect) -> Scene {
    let law = rubbing(random);
    let wanted = Wanted {
        ratio: random.decade(1e-3, 1e3),
        strain: random.between(0.003, 0.02),
        length: random.between(5.0, 7.0),
        law,
    };
    let mut slab = slab(random, &wanted);
    let way = 0.95 * slab.room;
    let each = random.between(2.0, 6.0) * slab.facets[0].min(slab.facets[1]);
    let count = (way / each).ceil().max(2.0) as usize;
    let slide = slab.to("slide", way).within(Some(count));
    slab.claim(1, way);
    slab.scene.steps = vec![slab.press(), slide];
    slab.scene
}

/// Friction that falls with the rate of slip, at a steady rate.
pub fn decay(random: &mut Random, _: Dialect) -> Scene {
    let law = coulomb(random, 0.1, 0.6);
    let mu = law.coefficient();
    let wanted = Wanted {
        ratio: random.decade(1e-2, 1e2),
        strain: random.between(0.003, 0.02),
        length: random.between(2.5, 4.0),
        law,
    };
    let mut slab = slab(random, &wanted);
    let way = (0.8 * slab.room)
        .min(6.0 * slab.facets[0])
        .max(4.0 * slab.lag);
    let duration = random.decade(0.1, 10.0);
    let rate = way / duration;
    let kinetic = random.between(0.5, 0.95);
    let decay = rate * random.decade(0.2, 4.0);
    slab.scene.pairs[0].decay = Some((kinetic, decay));
    let steady = mu * (kinetic + (1.0 - kinetic) * (-rate / decay).exp());
    let mut slide = slab.to("slide", way).within(Some(random.whole(6..=12)));
    slide.duration = Some(duration);
    let quantity = Quantity::Friction(0);
    let claim = Claim::at_end("sliding", 1, quantity, about(steady, 5.0 * SLIDING));
    slab.scene.claims.push(claim.within(0.7));
    slab.scene.steps = vec![slab.press(), slide];
    // Friction that falls faster than the bodies can follow has no state in balance.
    slab.scene.ending = Ending::Open;
    slab.scene
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twenty_reversals_are_twenty_steps_beside_two() {
        let scene = reversals(&mut Random::new(3), Dialect::default());
        assert_eq!(scene.steps.len(), 22);
        let x = |step: usize| scene.steps[step].displacements[0].2[0].unwrap();
        assert!(
            (2..21)
                .all(|step| (x(step + 1) - x(step)) * (x(step) - x(step - 1)) < 0.0 || step == 2)
        );
    }
}
