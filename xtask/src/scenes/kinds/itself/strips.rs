//! Folded strips that are closed and moved along themselves, down to layers a fifth of a facet
//! thick.

use super::{Dialect, Scene, Units, everything, soft, steps_of};
use crate::scenes::{
    grid::{Cells, Course, Grid},
    kinds::parts::Stance,
    random::Random,
    scene::Step,
    vector::Vector,
};

/// Facets around a turn.
const ROUND: usize = 6;

/// A strip in folds: flat layers of a length, joined by half circles.
struct Folds {
    turns: usize,
    long: f64,
    thick: f64,
    gap: f64,
    size: f64,
    across: usize,
}

impl Folds {
    /// Points of the middle line with its normals, in the plane of `x` and `z`.
    fn line(&self) -> Vec<[[f64; 2]; 2]> {
        let flat = (self.long / self.size).round() as usize;
        let pitch = self.thick + self.gap;
        let mut line = Vec::new();
        for turn in 0..=self.turns {
            let z = pitch * turn as f64;
            let way = if turn % 2 == 0 { 1.0 } else { -1.0 };
            for k in 0..=flat {
                let x = self.long * k as f64 / flat as f64;
                let x = if way > 0.0 { x } else { self.long - x };
                line.push([[x, z], [0.0, way]]);
            }
            if turn < self.turns {
                let end = if way > 0.0 { self.long } else { 0.0 };
                for k in 1..ROUND {
                    let angle = std::f64::consts::PI * k as f64 / ROUND as f64;
                    let (sine, cosine) = angle.sin_cos();
                    let place = [
                        end + way * 0.5 * pitch * sine,
                        z + 0.5 * pitch * (1.0 - cosine),
                    ];
                    line.push([place, [-sine, way * cosine]]);
                }
            }
        }
        line
    }

    fn grid(&self, wide: f64, cells: usize) -> Grid {
        let line = self.line();
        let divisions = [line.len() - 1, cells, self.across];
        let count = divisions[0] as f64;
        Grid::mapped(divisions, Course::Open, Cells::Hexahedra, |[s, y, z]| {
            let [place, normal] = line[(s * count).round() as usize];
            let off = self.thick * (z - 0.5);
            [
                place[0] + off * normal[0],
                wide * (y - 0.5),
                place[1] + off * normal[1],
            ]
        })
    }
}

/// A strip of some elements across or one.
pub fn folded(random: &mut Random, _: Dialect) -> Scene {
    let units = Units::random(random);
    let thick = random.between(0.06, 0.15);
    let folds = Folds {
        turns: random.whole(1..=3),
        long: units.length,
        thick: thick * units.length,
        gap: random.between(0.4, 1.5) * thick * units.length,
        size: units.length / random.whole(6..=12) as f64,
        across: random.whole(1..=2),
    };
    closed(random, units, &folds)
}

/// A strip thinner than its facets are wide, in layers that are as near.
pub fn thin(random: &mut Random, _: Dialect) -> Scene {
    let units = Units::random(random);
    let size = units.length / random.whole(5..=10) as f64;
    let thick = random.between(0.2, 0.8) * size;
    let folds = Folds {
        turns: random.whole(1..=3),
        long: units.length,
        thick,
        gap: random.between(0.4, 1.5) * thick,
        size,
        across: 1,
    };
    closed(random, units, &folds)
}

/// Closes the folds by the ends of the strip, then moves one of them along the layers.
fn closed(random: &mut Random, units: Units, folds: &Folds) -> Scene {
    let wide = random.between(0.8, 2.0) * folds.size;
    let flat = random.chance(0.6);
    let cells = if flat { 1 } else { random.whole(1..=2) };
    let top = folds.turns as f64 * (folds.thick + folds.gap);
    let near = |x: f64| {
        let from = if folds.turns % 2 == 1 { 0.0 } else { 0.65 };
        (from - 1e-6..from + 0.35 + 1e-6).contains(&(x / folds.long))
    };
    let at = |z: f64, height: f64| (z - height).abs() < 1e-6 * folds.thick;
    let high = top + 0.5 * folds.thick;
    let low = -0.5 * folds.thick;
    let is_low = |[x, _, z]: Vector| at(z, low) && (-1e-6..0.35).contains(&(x / folds.long));
    let is_high = |[x, _, z]: Vector| at(z, high) && near(x);
    let grid = folds.grid(wide, cells);
    let grid = grid
        .with_nodes("low", is_low)
        .with_nodes("high", is_high)
        .with_nodes("rest", |x| !is_low(x) && !is_high(x));
    let mut body = soft(random, "strip", units, grid);
    if folds.across == 1 {
        body.formulation = Some("assumed-strain");
    }
    // Plane strain holds the rest along one axis.
    let stance = if flat { Stance::Upright } else { Stance::Any };
    let mut scene = everything(random, units, stance, vec![body], Vec::new());
    let closed = folds.turns as f64 * folds.gap + random.between(0.0, 0.1) * folds.thick;
    let size = random.between(0.2, 0.8) * folds.thick;
    let slid = random.between(-0.2, 0.2) * folds.long;
    let moved = |name, x: f64, way: f64| {
        let step = Step::new(name)
            .moving("strip", "low", [0.0; 3])
            .moving("strip", "high", [x, 0.0, -closed])
            .within(steps_of(way, size));
        if flat {
            step.holding("strip", "rest", [None, Some(0.0), None])
        } else {
            step
        }
    };
    scene.steps = vec![
        moved("close", 0.0, closed),
        moved("slide", slid, slid.abs()),
    ];
    scene
}
