//! A block on rigid surfaces: planes, ridges, bumps.

use super::{
    Dialect,
    parts::{
        Stance, Strains, Units, block, body, facet, height, increments, pair, placement, scene,
        strains,
    },
};
use crate::scenes::{
    geometry::{self, triangles},
    random::Random,
    scene::{End, Rigid, RigidShape, Scene, Step},
    vector::{Vector, plus},
};

/// A block on a rigid surface.
struct Footing {
    scene: Scene,
    depth: f64,
    facet: f64,
    unit: f64,
    /// Height of the block.
    high: f64,
    /// Extent of the block along `x` and `y`, in the middle of the floor.
    plan: [f64; 2],
}

fn footing(random: &mut Random, strains: Strains) -> Footing {
    let units = Units::random(random);
    let unit = units.length;
    let plan = [
        random.between(0.6, 1.0) * unit,
        random.between(0.6, 1.0) * unit,
    ];
    let (high, layers) = height(random, plan);
    let upper = block(random, [0.0; 3], plan, high, layers);
    let strain = strains.press(random);
    let sides = [("upper", Some("zmin")), ("floor", None)];
    let pair = pair(random, "contact", sides, unit, strain * units.modulus);
    let facet = facet(&upper);
    let material = strains.material(random, units.modulus);
    let placement = placement(random, units, Stance::Any);
    Footing {
        scene: scene(
            placement,
            None,
            vec![body("upper", material, upper)],
            vec![pair],
        ),
        depth: strain * high.min(plan[0]).min(plan[1]),
        facet,
        unit,
        high,
        plan,
    }
}

impl Footing {
    fn way(&self, random: &mut Random) -> Vector {
        let angle = random.between(0.0, std::f64::consts::TAU);
        let far = random.between(0.3, 2.5) * self.facet;
        [far * angle.cos(), far * angle.sin(), 0.0]
    }

    /// The largest amplitude of waves that a block is pressed into: its upper side is held
    /// plane and has to stay above them.
    fn highest(&self) -> f64 {
        0.3 * self.high
    }

    /// Clearance between a sheet and the block, which is around the origin at height zero.
    fn clearance(&self, positions: &[Vector], facets: &[[usize; 4]]) -> f64 {
        const SAMPLES: i32 = 20;
        let radius = 0.5 * self.plan[0].min(self.plan[1]);
        let pieces: Vec<[Vector; 3]> = facets
            .iter()
            .flat_map(|facet| {
                let mut corners = facet.to_vec();
                corners.dedup();
                let corners: Vec<Vector> = corners.into_iter().map(|i| positions[i]).collect();
                triangles(&corners)
            })
            .collect();
        let at = |i: i32| radius * f64::from(i) / f64::from(SAMPLES);
        let samples = (-SAMPLES..=SAMPLES)
            .flat_map(|i| (-SAMPLES..=SAMPLES).map(move |j| [at(i), at(j), 0.0]))
            .filter(|x| x[0].hypot(x[1]) <= radius);
        let heights = samples.filter_map(|x| geometry::height(&pieces, x).map(|(z, _)| z));
        -heights.fold(f64::NEG_INFINITY, f64::max).min(0.0)
    }

    /// Presses and slides, either the body or the surface.
    fn pressed_and_slid(mut self, random: &mut Random, depth: f64) -> Scene {
        let down = [0.0, 0.0, -depth];
        let mut press = Step::new("press")
            .moving("upper", "zmax", down)
            .within(increments(random))
            .ending(End::Touching);
        let way = self.way(random);
        let mut slide = Step::new("slide").within(increments(random));
        if random.chance(0.3) {
            press.rigid.push(("floor", [0.0; 3], None));
            slide.rigid.push(("floor", way, None));
        } else {
            slide = slide.moving("upper", "zmax", plus(down, way));
        }
        self.scene.steps = vec![press];
        if random.chance(0.75) {
            self.scene.steps.push(slide);
        }
        self.scene
    }
}

/// A rigid plane; sometimes the block is lifted and set down again.
pub fn plane(random: &mut Random, _: Dialect) -> Scene {
    let strains = strains(random);
    let mut footing = footing(random, strains);
    let plane = RigidShape::Plane([0.0; 3], [0.0, 0.0, 1.0]);
    footing.scene.rigid.push(Rigid {
        name: "floor",
        shape: plane,
    });
    let (depth, up) = (footing.depth, 0.5 * footing.facet);
    let mut scene = footing.pressed_and_slid(random, depth);
    if random.chance(0.3) {
        let to = |name, z, end| {
            Step::new(name)
                .moving("upper", "zmax", [0.0, 0.0, z])
                .ending(end)
        };
        scene.steps.push(to("lift", up, End::Apart));
        scene.steps.push(to("again", -depth, End::Touching));
    }
    scene
}

/// Ridges across one direction, triangular or round.
pub fn ridges(random: &mut Random, _: Dialect) -> Scene {
    let mut footing = footing(random, Strains::Moderate);
    let pitch = random.between(1.0, 4.0) * footing.facet;
    let amplitude = (random.between(0.02, 0.12) * pitch).min(0.5 * footing.facet);
    let amplitude = amplitude.min(footing.highest());
    let round = random.chance(0.5);
    let points = if round { 8 } else { 2 };
    let count = (2.4 * footing.unit / pitch).ceil() as usize * points;
    let step = pitch / points as f64;
    let start = -0.5 * step * count as f64;
    let profile = |i: usize| {
        let phase = i as f64 / points as f64;
        if round {
            0.5 * amplitude * ((phase * std::f64::consts::TAU).cos() - 1.0)
        } else {
            -amplitude * (i % 2) as f64
        }
    };
    let half = 1.2 * footing.unit;
    let position = |i: usize, y: f64| [start + step * i as f64, y, profile(i)];
    let positions: Vec<Vector> = (0..=count)
        .flat_map(|i| [position(i, -half), position(i, half)])
        .collect();
    let facets = (0..count).map(|i| [2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1]);
    let facets: Vec<[usize; 4]> = facets.collect();
    let clearance = footing.clearance(&positions, &facets);
    let sheet = RigidShape::Sheet(positions, facets);
    footing.scene.rigid.push(Rigid {
        name: "floor",
        shape: sheet,
    });
    let depth = footing.depth.max(random.between(0.3, 1.0) * amplitude);
    footing.pressed_and_slid(random, clearance + depth)
}

/// Bumps in two directions, of triangles.
pub fn bumps(random: &mut Random, _: Dialect) -> Scene {
    let mut footing = footing(random, Strains::Moderate);
    let pitch = random.between(1.5, 4.0) * footing.facet;
    let amplitude = (random.between(0.02, 0.12) * pitch).min(0.4 * footing.facet);
    let amplitude = amplitude.min(footing.highest());
    let per_pitch = random.whole(2..=4);
    let step = pitch / per_pitch as f64;
    let count = ((2.4 * footing.unit / step).ceil() as usize).min(60);
    let step = step.max(2.4 * footing.unit / count as f64);
    let at = |i: usize| step * (i as f64 - 0.5 * count as f64);
    let wave = |x: f64| (x / pitch * std::f64::consts::TAU).cos();
    let position = |i: usize, j: usize| {
        let (x, y) = (at(i), at(j));
        [x, y, 0.25 * amplitude * (wave(x) + wave(y) - 2.0)]
    };
    let positions: Vec<Vector> = (0..=count)
        .flat_map(|i| (0..=count).map(move |j| position(i, j)))
        .collect();
    let id = |i: usize, j: usize| i * (count + 1) + j;
    let mut facets = Vec::new();
    for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
        let [a, b, c, d] = [id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)];
        facets.push([a, b, c, c]);
        facets.push([a, c, d, d]);
    }
    let clearance = footing.clearance(&positions, &facets);
    footing.scene.rigid.push(Rigid {
        name: "floor",
        shape: RigidShape::Sheet(positions, facets),
    });
    let depth = footing.depth.max(random.between(0.3, 1.0) * amplitude);
    footing.pressed_and_slid(random, clearance + depth)
}
