//! Strips that bend over rigid ridges and rollers.

use super::{
    Dialect,
    curved::with_finer,
    parts::{Stance, Units, body, coulomb, pair_with, placement, scene},
    simple::{plain_block, rubbery},
};
use crate::scenes::{
    claim::{Claim, Quantity},
    random::Random,
    scene::{End, Ending, Rigid, RigidShape, Scene, Step},
    vector::Vector,
};

/// A strip that lies on a rigid profile.
struct Strip {
    scene: Scene,
    long: f64,
    wide: f64,
    thick: f64,
    facet: f64,
    modulus: f64,
}

/// A strip along `x` above the plane `z = 0`; its thickness over its length is `slim`.
fn strip(random: &mut Random, fine: usize, slim: f64, poisson: f64) -> Strip {
    let units = Units::random(random);
    let long = units.length;
    let (wide, thick) = (random.between(0.1, 0.3) * long, slim * long);
    let along = 2 * random.whole(9..=13) * fine;
    let divisions = [along, 2 * fine, fine];
    let block = plain_block(
        [-0.5 * long, -0.5 * wide, 0.0],
        [long, wide, thick],
        divisions,
    );
    let mut body = body("strip", rubbery(units.modulus, poisson), block);
    body.formulation = Some("assumed-strain");
    let at = |x: f64| [x * long, 0.0, thick];
    body.nearest = vec![("middle", at(0.0)), ("end", at(0.4))];
    let law = coulomb(random, 0.0, 0.5);
    let sides = [("strip", Some("zmin")), ("floor", None)];
    let mut pair = pair_with(random, "contact", sides, long, units.modulus, law);
    (pair.cap, pair.decay) = (None, None);
    let placement = placement(random, units, Stance::Upright);
    Strip {
        scene: scene(placement, None, vec![body], vec![pair]),
        long,
        wide,
        thick,
        facet: long / along as f64,
        modulus: units.modulus,
    }
}

/// A rigid profile along `x`, from below.
fn profile(points: &[[f64; 2]], half: f64) -> RigidShape {
    let positions: Vec<Vector> = points
        .iter()
        .flat_map(|&[x, z]| [[x, -half, z], [x, half, z]])
        .collect();
    let facets = (0..points.len() - 1).map(|i| [2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1]);
    RigidShape::Sheet(positions, facets.collect())
}

/// The upper part of a roller with its top at a place.
fn roller(top: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    (-8..=8)
        .map(|i| {
            let (sine, cosine) = (f64::from(i) * 0.15).sin_cos();
            [top[0] + radius * sine, top[1] + radius * (cosine - 1.0)]
        })
        .collect()
}

/// A strip bent over a roller by its ends: `F = 48 E I d/L^3`, and more where the force is spread
/// over some facets, which shortens `L`.
pub fn bend(random: &mut Random, _: Dialect) -> Scene {
    let slim = random.between(0.03, 0.05);
    let mut strip = strip(random, 1, slim, 0.0);
    let depth = random.between(0.4, 0.8) * strip.thick;
    // Narrower than the curve of the strip, which does not wrap it.
    let radius = random.between(0.1, 0.5) * strip.long.powi(2) / (12.0 * depth);
    let radius = radius.min(0.3 * strip.long);
    let points = roller([0.0, 0.0], radius);
    strip.scene.rigid.push(Rigid {
        name: "floor",
        shape: profile(&points, strip.wide),
    });
    let inertia = strip.wide * strip.thick.powi(3) / 12.0;
    let force = 48.0 * strip.modulus * inertia * depth / strip.long.powi(3);
    let press = Step::new("bend")
        .holding("strip", "xmin", [None, None, Some(-depth)])
        .holding("strip", "xmax", [None, None, Some(-depth)])
        .holding("strip", "middle", [Some(0.0), Some(0.0), None])
        .holding("strip", "end", [None, Some(0.0), None])
        .ending(End::Touching);
    // A facet on a narrow roller may be inside by 0.08 of its size.
    let least = 0.95 - 0.08 * strip.facet / depth;
    let quantity = Quantity::Force(0, "strip", [0.0, 0.0, 1.0]);
    let claim = Claim::at_end("closed form", 0, quantity, [least * force, 1.2 * force]);
    strip.scene.claims.push(claim);
    strip.scene.steps = vec![press];
    strip.scene.ending = Ending::Completes;
    strip.scene
}

/// A strip pulled over ridges or rollers by its ends.
pub fn sheet(random: &mut Random, _: Dialect) -> Scene {
    fn build(random: &mut Random, fine: usize) -> Scene {
        let slim = random.between(0.03, 0.06);
        let poisson = random.between(0.0, 0.4);
        let mut strip = strip(random, fine, slim, poisson);
        let (long, thick) = (strip.long, strip.thick);
        let count = random.whole(1..=3);
        let sharp = random.chance(0.4);
        let pitch = 0.5 * long / count as f64;
        let high = random.between(1.5, 3.0) * thick;
        let mut points = Vec::new();
        for ridge in 0..count {
            let middle = (ridge as f64 - 0.5 * (count as f64 - 1.0)) * pitch;
            if sharp {
                points.push([middle - 0.5 * pitch, -high]);
                points.push([middle, 0.0]);
            } else {
                let radius = random.between(0.2, 0.35) * pitch;
                points.extend(roller([middle, 0.0], radius));
            }
        }
        if sharp {
            points.push([0.5 * pitch * count as f64, -high]);
        }
        strip.scene.rigid.push(Rigid {
            name: "floor",
            shape: profile(&points, strip.wide),
        });
        let depth = random.between(0.5, 1.4) * thick;
        let down = [0.0, 0.0, -depth];
        let press = Step::new("drape")
            .moving("strip", "xmin", down)
            .moving("strip", "xmax", down)
            .ending(End::Touching);
        strip.scene.steps = vec![press];
        strip.scene
    }
    with_finer(random, build, 2, [0.85, 1.15])
}
