//! A sharp rigid ridge that slides under a block.

use super::{
    parts::{Stance, Units, body, coulomb, pair_with, placement, scene},
    simple::{plain_block, rubbery},
    slab::SLIDING,
};
use crate::scenes::{
    claim::{Claim, Quantity, about},
    random::Random,
    scene::{End, Ending, Rigid, RigidShape, Scene, Step},
    vector::Vector,
};

/// A sharp rigid ridge under a block, by 0.3 to 2 facets an increment.
pub fn blade(random: &mut Random) -> Scene {
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
