//! Three and more bodies that touch in chains and nets.

use super::{Dialect, Scene, Units, everything, soft, steps_of};
use crate::scenes::{
    grid::{Cells, Course, Grid},
    kinds::parts::Stance,
    random::Random,
    scene::{Body, Step},
};

const FINS: [&str; 6] = ["fin-a", "fin-b", "fin-c", "fin-d", "fin-e", "fin-f"];
const WARP: [&str; 3] = ["warp-a", "warp-b", "warp-c"];
const WEFT: [&str; 3] = ["weft-a", "weft-b", "weft-c"];

/// Fins side by side, each held by its foot, from below or hanging from above; the first one is
/// bent by its head against the row.
pub fn fins(random: &mut Random, _: Dialect) -> Scene {
    let units = Units::random(random);
    let unit = units.length;
    let count = random.whole(3..=5);
    let hangs = random.chance(0.4);
    let mut at = 0.0;
    let mut feet = Vec::new();
    let mut bodies: Vec<Body> = Vec::new();
    for name in FINS.into_iter().take(count) {
        let thick = random.between(0.12, 0.25) * unit;
        let tall = random.between(0.8, 1.2) * unit;
        let wide = random.between(0.3, 0.6) * unit;
        let aside = random.between(-0.15, 0.15) * unit;
        let from = at;
        let hung = hangs && bodies.len() % 2 == 1;
        let low = if hung { 1.3 * unit - tall } else { 0.0 };
        let divisions = [
            random.whole(1..=2),
            random.whole(1..=2),
            random.whole(4..=7),
        ];
        let grid = Grid::mapped(divisions, Course::Open, Cells::Hexahedra, |[x, y, z]| {
            [from + thick * x, aside + wide * (y - 0.5), low + tall * z]
        });
        feet.push(if hung { "zmax" } else { "zmin" });
        bodies.push(soft(random, name, units, grid));
        at += thick + random.between(0.02, 0.15) * unit;
    }
    let mut scene = everything(random, units, Stance::Any, bodies, Vec::new());
    let way = random.between(0.3, 0.7) * unit;
    let mut step = Step::new("bend");
    for (name, foot) in FINS.into_iter().zip(&feet) {
        step = step.moving(name, foot, [0.0; 3]);
    }
    let size = random.between(0.02, 0.05) * unit;
    let aside = random.between(-0.1, 0.1) * unit;
    scene.steps = vec![
        step.moving(FINS[0], "zmax", [way, aside, -0.1 * way])
            .within(steps_of(way, size)),
    ];
    scene
}

/// Height of the chords of a cosine at a share of its half period, `fine` of them in a half period.
fn chord(share: f64, fine: usize) -> f64 {
    let at = share * fine as f64;
    let node = |k: f64| (std::f64::consts::PI * k / fine as f64).cos();
    let (from, part) = (at.floor(), at.fract());
    (1.0 - part) * node(from) + part * node(from + 1.0)
}

/// Strips woven over and under each other, pulled tight by their ends.
pub fn weave(random: &mut Random, _: Dialect) -> Scene {
    let units = Units::random(random);
    let pitch = units.length;
    let counts = [random.whole(2..=3), random.whole(1..=3)];
    let thick = random.between(0.08, 0.2) * pitch;
    let gap = random.between(0.05, 0.5) * thick;
    let wide = random.between(0.25, 0.5) * pitch;
    let fine = random.one_of(&[4, 6]);
    let across = random.whole(1..=2);
    let high = 0.5 * (thick + gap) / chord(0.5 * wide / pitch, fine);
    let mut bodies = Vec::new();
    for (way, names) in [WARP, WEFT].into_iter().enumerate() {
        let crossed = counts[1 - way];
        for (at, name) in names.into_iter().enumerate().take(counts[way]) {
            let up = if (at + way) % 2 == 0 { high } else { -high };
            // Half a pitch beyond the outer crossings.
            let long = crossed as f64 * pitch;
            let divisions = [fine * crossed, across, 1];
            let grid = Grid::mapped(divisions, Course::Open, Cells::Hexahedra, |[s, y, z]| {
                let along = long * s - 0.5 * pitch;
                let beside = at as f64 * pitch + wide * (y - 0.5);
                let z = up * (std::f64::consts::PI * along / pitch).cos() + thick * (z - 0.5);
                match way {
                    0 => [along, beside, z],
                    _ => [2.0 * at as f64 * pitch - beside, along, z],
                }
            });
            let mut body = soft(random, name, units, grid);
            body.formulation = Some("assumed-strain");
            bodies.push(body);
        }
    }
    let mut scene = everything(random, units, Stance::Any, bodies, Vec::new());
    let mut step = Step::new("pull");
    let pulled = [0, 1].map(|_| random.between(0.02, 0.1) * pitch);
    for (way, names) in [WARP, WEFT].into_iter().enumerate() {
        for name in names.into_iter().take(counts[way]) {
            let [from, to] = [-pulled[way], pulled[way]].map(|pull| match way {
                0 => [pull, 0.0, 0.0],
                _ => [0.0, pull, 0.0],
            });
            step = step.moving(name, "xmin", from).moving(name, "xmax", to);
        }
    }
    scene.steps = vec![step.within(Some(random.whole(4..=12)))];
    scene
}
