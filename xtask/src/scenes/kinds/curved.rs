//! Curved on curved: a ball in a socket, a cylinder in a groove.
//!
//! Both are sectors, held at the side away from the contact. Facets are inscribed in the
//! curve by `s = h^2/(8 R)` to twice that, so bodies begin apart by as much. With half the width of
//! the contact `a = k h` and the radius of the hollow `R (1 + c)`, that is `1/(4 k^2 c)` of the
//! approach `a^2 c/(2 R)`. Forces are held against those of a mesh twice as fine.

use super::{
    Dialect,
    parts::{Stance, Units, coulomb, pair_with, placement, scene},
    simple::{gridded, rubbery},
};
use crate::scenes::{
    claim::{Claim, Quantity},
    grid::{Cells, Course, Grid},
    random::Random,
    scene::{Body, End, Ending, RigidShape, Scene, Step},
    vector::{Vector, plus, times, unit},
};

/// Makes a scene with meshes of the first number, or finer by a factor.
type Build = fn(&mut Random, usize) -> Scene;

/// A scene with the same one on a finer mesh as its reference, whose forces are within a band.
pub fn with_finer(random: &mut Random, build: Build, factor: usize, band: [f64; 2]) -> Scene {
    let mut again = random.clone();
    let mut scene = build(random, 1);
    scene.reference = Some(Box::new(build(&mut again, factor)));
    let owner = scene.bodies[0].name;
    let quantity = Quantity::Beside(0, owner, scene_press(&scene));
    scene
        .claims
        .push(Claim::at_end("refined", 0, quantity, band));
    scene.ending = Ending::Completes;
    scene
}

/// Direction of the force on the first body: against its first motion, or up.
fn scene_press(scene: &Scene) -> Vector {
    match scene.rigid.first().map(|rigid| &rigid.shape) {
        Some(RigidShape::Head(..)) => [1.0, 0.0, 0.0],
        _ => [0.0, 0.0, 1.0],
    }
}

/// Two sectors about the same centre, pressed and perhaps slid.
struct Nest {
    units: Units,
    radius: f64,
    facet: f64,
    depth: f64,
    bodies: Vec<Body>,
    ratio: f64,
}

/// A point of a sector, by half its angle, the radius of the point and the unit of length.
type Sector = fn([f64; 3], Vector) -> Vector;

/// Half the angles of the inner and the outer sector.
const ANGLES: [f64; 2] = [0.65, 0.85];

fn nest(random: &mut Random, fine: usize, along: usize, map: Sector, across: usize) -> Nest {
    let units = Units::random(random);
    let radius = units.length;
    let count = random.whole(along..=along + 3);
    let alike = (count as f64 * ANGLES[1] / ANGLES[0]).ceil() as usize;
    let counts = [count, alike + random.whole(0..=2)];
    let ratio = random.decade(1e-3, 1e3);
    let chord = 2.0 * ANGLES[0] / count as f64;
    let wider = random.between(0.15, 0.4);
    let least = (1.2 / wider).sqrt();
    let wide = random.between(least, least.max(0.8 * ANGLES[0] / chord)) * chord;
    let apart = 0.25 * radius * chord * chord;
    let clearance = radius * wider;
    let thick = [random.between(0.4, 0.6), random.between(0.3, 0.6)];
    let radii = [
        [radius * (1.0 - thick[0]), radius],
        [radius + clearance, radius * (1.0 + wider + thick[1])],
    ];
    let names = ["inner", "outer"];
    // Many tetrahedra fill a sphere twice as fine.
    let cells = match random.whole(0..=3) {
        0 => Cells::Wedges,
        1 if across <= 2 => Cells::Tetrahedra,
        _ => Cells::Hexahedra,
    };
    let poisson = random.between(0.0, 0.4);
    let bodies = (0..2).map(|i| {
        let divisions = [counts[i] * fine, across.min(counts[i]) * fine, 2 * fine];
        let [low, high] = radii[i];
        let at = |x: Vector| {
            let r = low + (high - low) * x[2];
            // The lowest points of both are apart by a little.
            let lower = [0.0, 0.0, [apart - clearance, 0.0][i]];
            plus(lower, map([ANGLES[i], r, radius], x))
        };
        let grid = Grid::mapped(divisions, Course::Open, cells, at);
        let modulus = units.modulus * [ratio, 1.0][i];
        gridded(names[i], rubbery(modulus, poisson), grid)
    });
    let bodies = bodies.collect();
    let depth = apart + 0.5 * wide * wide * wider * radius;
    Nest {
        units,
        radius,
        facet: chord * radius,
        depth,
        bodies,
        ratio,
    }
}

impl Nest {
    fn pressed(self, random: &mut Random, slid: bool) -> Scene {
        let law = coulomb(random, 0.0, 0.5);
        let sides = [("inner", Some("zmax")), ("outer", Some("zmin"))];
        let mut pair = pair_with(random, "contact", sides, self.radius, 1.0, law);
        (pair.cap, pair.decay) = (None, None);
        let placement = placement(random, self.units, Stance::Any);
        let mut scene = scene(placement, Some(self.ratio), self.bodies, vec![pair]);
        let down = [0.0, 0.0, -self.depth];
        let press = Step::new("press")
            .moving("outer", "zmax", [0.0; 3])
            .moving("inner", "zmin", down)
            .ending(End::Touching);
        scene.steps = vec![press];
        if slid {
            let way = random.between(0.2, 1.0) * self.facet;
            let slide = Step::new("slide").moving("inner", "zmin", plus(down, [way, 0.0, 0.0]));
            scene.steps.push(slide.within(Some(5)));
        }
        scene
    }
}

/// A ball in a socket.
pub fn socket(random: &mut Random, _: Dialect) -> Scene {
    fn build(random: &mut Random, fine: usize) -> Scene {
        // Outward, with the first axis turned back to keep the sense of turning.
        let map: Sector = |[angle, r, _], [x, y, _]| {
            let [a, b] = [1.0 - 2.0 * x, 2.0 * y - 1.0].map(|share| (share * angle).tan());
            times(r, unit([a, b, -1.0]))
        };
        let nest = nest(random, fine, 5, map, 8);
        let slid = fine == 1 && random.chance(0.5);
        nest.pressed(random, slid)
    }
    with_finer(random, build, 2, [0.6, 1.8])
}

/// A cylinder in a groove.
pub fn groove(random: &mut Random, _: Dialect) -> Scene {
    fn build(random: &mut Random, fine: usize) -> Scene {
        let map: Sector = |[angle, r, unit], [x, y, _]| {
            let (sine, cosine) = (angle * (1.0 - 2.0 * x)).sin_cos();
            [r * sine, 0.5 * unit * y, -r * cosine]
        };
        let nest = nest(random, fine, 7, map, 2);
        let slid = fine == 1 && random.chance(0.5);
        nest.pressed(random, slid)
    }
    with_finer(random, build, 2, [0.6, 1.8])
}
