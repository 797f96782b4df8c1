//! A cap on a base whose facets are larger than the contact.
//!
//! Half the width of the contact is `a = sqrt(R d)` by Hertz, from a tenth of a facet on. The force
//! is held against that on a base whose facets are smaller than the contact; where the base is the
//! softer one, large facets can only be too stiff.

use super::{
    Dialect,
    parts::{Stance, Units, coulomb, pair_with, placement, scene},
    simple::{gridded, rubbery},
};
use crate::scenes::{
    claim::{Claim, Quantity},
    grid::{Cells, Course, Grid},
    random::Random,
    scene::{Body, Cap, End, Ending, Scene, Shape, Step},
    vector::plus,
};

/// A cap within a facet of the base.
pub fn speck(random: &mut Random, _: Dialect) -> Scene {
    let mut again = random.clone();
    let (mut scene, ratio) = build(random, Facets::Large);
    scene.reference = Some(Box::new(build(&mut again, Facets::Small).0));
    let high = if ratio < 0.3 { 1.5 } else { f64::INFINITY };
    let quantity = Quantity::Beside(0, "cap", [0.0, 0.0, 1.0]);
    let claim = Claim::at_end("refined", 0, quantity, [0.5, high]);
    scene.claims.push(claim);
    scene.ending = Ending::Completes;
    scene
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Facets {
    Large,
    Small,
}

fn build(random: &mut Random, facets: Facets) -> (Scene, f64) {
    let units = Units::random(random);
    let unit = units.length;
    let counts = [random.whole(1..=3), random.whole(1..=3)];
    let facet = unit / counts[0].max(counts[1]) as f64;
    let wide = random.decade(0.1, 0.7) * facet;
    let radius = wide * random.between(4.0, 8.0);
    let depth = wide * wide / radius;
    let ratio = random.decade(1e-4, 1e3);
    let poisson = random.between(0.0, 0.4);
    // Anywhere on the base but near its edge.
    let apex = [0; 2].map(|_| random.between(0.3, 0.7));
    let high = random.between(0.4, 0.8) * unit;
    let base = base(facets, counts, apex, [unit, unit, high]);
    let cap = Cap {
        apex: [0.0; 3],
        size: [5.0 * wide; 2],
        height: 3.0 * wide,
        radius,
        element: 0.4 * wide,
    };
    let mut of_cap: Body = gridded("cap", rubbery(units.modulus * ratio, poisson), base.clone());
    of_cap.shape = Shape::Cap(cap);
    let bodies = vec![
        of_cap,
        gridded("base", rubbery(units.modulus, poisson), base),
    ];
    let law = coulomb(random, 0.0, 0.5);
    let sides = [("cap", Some("cap")), ("base", Some("zmax"))];
    let mut pair = pair_with(random, "contact", sides, unit, 1.0, law);
    (pair.cap, pair.decay) = (None, None);
    let placement = placement(random, units, Stance::Upright);
    let mut scene = scene(placement, Some(ratio), bodies, vec![pair]);
    let down = [0.0, 0.0, -depth];
    scene.steps = vec![
        Step::new("press")
            .moving("base", "zmin", [0.0; 3])
            .moving("cap", "zmax", down)
            .ending(End::Touching),
    ];
    if facets == Facets::Large && random.chance(0.4) {
        let way = random.between(0.3, 2.0) * wide;
        let slide = Step::new("slide").moving("cap", "zmax", plus(down, [way, 0.0, 0.0]));
        scene.steps.push(slide.within(Some(6)));
    }
    (scene, ratio)
}

/// A base with its top in the plane `z = 0`, the place `apex` of its plan at the origin; of equal
/// elements, or of elements that are smaller towards there.
fn base(facets: Facets, counts: [usize; 2], apex: [f64; 2], size: [f64; 3]) -> Grid {
    const SMALL: [usize; 3] = [12, 12, 6];
    // From 0 to 1 with the middle at the place, and steps that grow away from it.
    let drawn = |share: f64, to: f64| {
        let s = 2.0 * share - 1.0;
        if s < 0.0 {
            to * (1.0 - s * s)
        } else {
            to + (1.0 - to) * s * s
        }
    };
    let divisions = match facets {
        Facets::Large => [counts[0], counts[1], counts[0].min(2)],
        Facets::Small => SMALL,
    };
    Grid::mapped(divisions, Course::Open, Cells::Hexahedra, |[x, y, z]| {
        let [x, y, z] = match facets {
            Facets::Large => [x, y, z - 1.0],
            Facets::Small => [drawn(x, apex[0]), drawn(y, apex[1]), -(1.0 - z) * (1.0 - z)],
        };
        [
            size[0] * (x - apex[0]),
            size[1] * (y - apex[1]),
            size[2] * z,
        ]
    })
}
