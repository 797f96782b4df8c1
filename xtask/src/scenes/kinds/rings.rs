//! Whole rings: a ring on another one, and a shaft in a bush.

use super::{
    Dialect,
    curved::with_finer,
    parts::{Stance, Units, coulomb, pair_with, placement, scene},
    simple::{gridded, rubbery},
};
use crate::scenes::{
    claim::{Claim, Quantity, about},
    grid::{Cells, Course, Grid},
    random::Random,
    scene::{End, Rigid, RigidShape, Scene, Step},
    vector::{Vector, plus},
};

/// A ring about the axis `y` of a centre, from its inner to its outer radius.
fn ring(centre: Vector, radii: [f64; 2], width: f64, divisions: [usize; 3], crossed: bool) -> Grid {
    Grid::mapped(divisions, Course::Ring, Cells::Hexahedra, |[x, y, z]| {
        // Counted from the lowest point, so that a node is there.
        let (sine, cosine) = (std::f64::consts::TAU * x).sin_cos();
        let r = radii[0] + (radii[1] - radii[0]) * z;
        let along = width * (y - 0.5);
        let point = [-r * sine, along, -r * cosine];
        plus(
            centre,
            if crossed {
                [-point[1], point[0], point[2]]
            } else {
                point
            },
        )
    })
}

/// A ring on another one, beside or across, whole rings that bend or held at their inside.
pub fn rings(random: &mut Random, _: Dialect) -> Scene {
    fn build(random: &mut Random, fine: usize) -> Scene {
        let units = Units::random(random);
        let unit = units.length;
        let radii = [0, 1].map(|_| random.between(0.6, 1.0) * unit);
        let crossed = random.chance(0.5);
        let thin = random.between(0.2, 0.4);
        let counts = [0, 1].map(|_| 2 * random.whole(12..=16) * fine);
        let width = random.between(0.3, 0.5) * unit;
        let ratio = random.decade(1e-2, 1e2);
        let bends = random.chance(0.5);
        let names = ["upper", "lower"];
        let bodies = (0..2).map(|i| {
            let outer = radii[i];
            let centre = [0.0, 0.0, [outer, -outer][i]];
            let divisions = [counts[i], 2 * fine, fine];
            let inner = outer * (1.0 - thin);
            let across = crossed && i == 0;
            let mut grid = ring(centre, [inner, outer], width, divisions, across);
            let limit = 1.5 * outer;
            let far = |x: &Vector| x[2].abs() > limit;
            let far = (0..grid.positions.len()).filter(|&node| far(&grid.positions[node]));
            grid.nodes.push(("far", far.collect()));
            let modulus = units.modulus * [ratio, 1.0][i];
            let mut body = gridded(names[i], rubbery(modulus, 0.3), grid);
            body.formulation = Some("assumed-strain");
            body
        });
        let bodies = bodies.collect();
        // Held inside, the contact is about as wide as a facet.
        let facet = std::f64::consts::TAU * radii[0].max(radii[1]) * fine as f64
            / counts[0].min(counts[1]) as f64;
        let round = radii[0] * radii[1] / (radii[0] + radii[1]);
        let wide = random.between(0.6, 1.5) * facet;
        // No deeper than a tenth of the thinner ring.
        let thinner = thin * radii[0].min(radii[1]);
        let local = (0.5 * wide * wide / round).min(0.1 * thinner);
        let depth = if bends {
            random.between(0.02, 0.1) * unit
        } else {
            local
        };
        let held = if bends { "far" } else { "zmin" };
        let law = coulomb(random, 0.0, 0.5);
        let sides = [("upper", Some("zmax")), ("lower", Some("zmax"))];
        let mut pair = pair_with(random, "contact", sides, unit, 1.0, law);
        (pair.cap, pair.decay) = (None, None);
        let placement = placement(random, units, Stance::Any);
        let mut scene = scene(placement, Some(ratio), bodies, vec![pair]);
        scene.steps = vec![
            Step::new("press")
                .moving("lower", held, [0.0; 3])
                .moving("upper", held, [0.0, 0.0, -depth])
                .ending(End::Touching),
        ];
        scene
    }
    with_finer(random, build, 2, [0.5, 1.5])
}

/// A shaft in a bush with some clearance, pressed to its side and turned.
pub fn journal(random: &mut Random, _: Dialect) -> Scene {
    fn build(random: &mut Random, fine: usize) -> Scene {
        let units = Units::random(random);
        let radius = units.length;
        let counts = [0, 1].map(|_| random.whole(26..=34));
        let ratio = random.decade(1e-2, 1e3);
        let chord = std::f64::consts::TAU / counts[0].min(counts[1]) as f64;
        let clearance = radius * chord * chord * random.between(0.15, 0.3);
        let thick = [random.between(0.3, 0.5), random.between(0.2, 0.4)];
        let radii = [
            [radius * (1.0 - thick[0]), radius],
            [radius + clearance, radius * (1.0 + thick[1])],
        ];
        let long = random.between(0.2, 0.4) * radius;
        let names = ["shaft", "bush"];
        let bodies = (0..2).map(|i| {
            let divisions = [counts[i] * fine, 2 * fine, 1];
            let [low, high] = radii[i];
            let grid = Grid::mapped(divisions, Course::Ring, Cells::Hexahedra, |[x, y, z]| {
                let (sine, cosine) = (-std::f64::consts::TAU * x).sin_cos();
                let r = low + (high - low) * y;
                [r * cosine, r * sine, long * (z - 0.5)]
            });
            let modulus = units.modulus * [ratio, 1.0][i];
            gridded(names[i], rubbery(modulus, 0.3), grid)
        });
        let bodies = bodies.collect();
        let law = coulomb(random, 0.05, 0.4);
        let mu = law.coefficient();
        let sides = [("shaft", Some("ymax")), ("bush", Some("ymin"))];
        let mut pair = pair_with(random, "contact", sides, radius, 1.0, law);
        (pair.cap, pair.decay) = (None, None);
        let placement = placement(random, units, Stance::Any);
        let mut scene = scene(placement, Some(ratio), bodies, vec![pair]);
        scene.rigid.push(Rigid {
            name: "head",
            shape: RigidShape::Head("shaft", "ymin", [0.0; 3]),
        });
        let strain = random.between(0.03, 0.06) * ratio.min(1.0);
        let depth = clearance + strain * radius * (thick[0] / ratio + thick[1]);
        let aside = [-depth, 0.0, 0.0];
        let mut press = Step::new("press")
            .moving("bush", "ymax", [0.0; 3])
            .ending(End::Touching);
        press.rigid.push(("head", aside, Some(0.0)));
        let mut turn = Step::new("turn")
            .within(Some(random.whole(5..=15)))
            .ending(End::Touching);
        let degrees = random.sign() * random.between(10.0, 60.0);
        turn.rigid.push(("head", aside, Some(degrees)));
        scene.steps = vec![press];
        if fine == 1 {
            scene.steps.push(turn);
            let quantity = Quantity::Friction(0);
            let claim = Claim::at_end("sliding", 1, quantity, about(mu, 0.01));
            scene.claims.push(claim);
        }
        scene
    }
    with_finer(random, build, 2, [0.6, 1.8])
}
