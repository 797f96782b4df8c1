//! A slider on a slab, and what is claimed of it where all slips.

use super::{
    parts::{Stance, Units, body, pair_with, placement, scene},
    simple::{plain_block, rubbery},
};
use crate::scenes::{
    claim::{Claim, Quantity, about},
    law::Law,
    random::Random,
    scene::{End, Ending, Pair, Scene, Step, Texture},
};

/// Error of friction over pressure.
pub const SLIDING: f64 = 0.01;

/// A slider on a slab.
pub struct Slab {
    pub scene: Scene,
    pub units: Units,
    /// Depth to which the slider is pressed.
    pub depth: f64,
    /// Facets of slab and slider along the way.
    pub facets: [f64; 2],
    /// Way that is taken up before all slips.
    pub lag: f64,
    /// Length of the slab beyond the slider.
    pub room: f64,
}

/// Wishes for a slider.
pub struct Wanted {
    /// Its modulus over that of the slab.
    pub ratio: f64,
    /// Strain of the softer one.
    pub strain: f64,
    /// Length of the slab over that of the slider.
    pub length: f64,
    pub law: Law,
}

/// A slider that touches one end of a slab.
pub fn slab(random: &mut Random, wanted: &Wanted) -> Slab {
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
    /// The step that presses.
    pub fn press(&self) -> Step {
        Step::new("press")
            .moving("slab", "zmin", [0.0; 3])
            .moving("slider", "zmax", [0.0, 0.0, -self.depth])
            .within(Some(5))
            .ending(End::Touching)
    }

    /// A step to a place along the slab.
    pub fn to(&self, name: &'static str, x: f64) -> Step {
        Step::new(name)
            .moving("slider", "zmax", [x, 0.0, -self.depth])
            .ending(End::Touching)
    }

    /// Claims of a step in which the slider goes a way.
    pub fn claim(&mut self, step: usize, way: f64) {
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

/// Claims of a law in full slip; of two textures the output does not tell it.
fn claims(law: &Law) -> Vec<Quantity> {
    match law {
        Law::TwoTextures(..) | Law::Frictionless => Vec::new(),
        _ => vec![Quantity::Law(0)],
    }
}
