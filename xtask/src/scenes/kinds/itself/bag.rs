//! Closed bags with thin walls, pressed flat.

use super::{Dialect, Scene, Units, everything, plane, soft, steps_of};
use crate::scenes::{
    grid::{Cells, Course, Grid},
    kinds::parts::Stance,
    random::Random,
    scene::Step,
    vector::Vector,
};

/// Two walls that bulge away from each other, joined all around by a seam, pressed flat between
/// planes.
pub fn bag(random: &mut Random, _: Dialect) -> Scene {
    let units = Units::random(random);
    let unit = units.length;
    let cells = [0, 1].map(|_| 2 * random.whole(3..=4));
    let plan = [2.0 * unit, random.between(1.2, 2.0) * unit];
    let thick = random.between(0.06, 0.15) * unit;
    let rim = random.between(0.2, 0.5) * thick;
    let bulge = random.between(0.15, 0.4) * unit;
    let seam = cells.map(|count| 1.0 / count as f64);
    let divisions = [cells[0], cells[1], 3];
    let grid = Grid::mapped(divisions, Course::Open, Cells::Hexahedra, |x| x);
    let inside = |[x, y, z]: Vector| {
        let within = |x: f64, seam: f64| (seam..1.0 - seam).contains(&x);
        within(x, seam[0]) && within(y, seam[1]) && (z - 0.5).abs() < 0.1
    };
    // Height of the cavity over the middle plane; none but the rim at the seam.
    let half = |x: f64, y: f64| {
        let arch = |x: f64, seam: f64| {
            let inner = ((x - 0.5).abs() / (0.5 - seam)).min(1.0);
            1.0 - inner * inner
        };
        0.5 * rim + 0.5 * bulge * (arch(x, seam[0]) * arch(y, seam[1])).sqrt()
    };
    let grid = grid.without(inside).moved(|[x, y, z]| {
        let level = (3.0 * z).round();
        let up = if level > 1.5 { 1.0 } else { -1.0 };
        let outside = if level == 0.0 || level == 3.0 {
            thick
        } else {
            0.0
        };
        [
            plan[0] * (x - 0.5),
            plan[1] * (y - 0.5),
            up * (half(x, y) + outside),
        ]
    });
    let high = half(0.5, 0.5) + thick;
    let lowest = |x: Vector, at: [f64; 2]| {
        let near = |x: f64, at: f64| (x - at).abs() < 1e-6 * unit;
        near(x[0], at[0]) && near(x[1], at[1]) && x[2] < 0.5 * thick - high
    };
    let beside = plan[0] / cells[0] as f64;
    let grid = grid
        .with_nodes("middle", |x| lowest(x, [0.0, 0.0]))
        .with_nodes("beside", |[x, y, z]| {
            (x - beside).abs() < 1e-6 * unit && y.abs() < 1e-6 * unit && z < -0.9 * thick
        });
    let body = soft(random, "bag", units, grid);
    let planes = vec![
        plane("floor", [0.0, 0.0, -high], [0.0, 0.0, 1.0]),
        plane("lid", [0.0, 0.0, high], [0.0, 0.0, -1.0]),
    ];
    let mut scene = everything(random, units, Stance::Upright, vec![body], planes);
    let way = random.between(0.85, 1.02) * (bulge + rim);
    let size = random.between(0.2, 0.5) * thick;
    let mut step = Step::new("flatten")
        .holding("bag", "middle", [Some(0.0), Some(0.0), None])
        .holding("bag", "beside", [None, Some(0.0), None])
        .within(steps_of(way, size));
    step.rigid.push(("lid", [0.0, 0.0, -way], None));
    scene.steps = vec![step];
    scene
}
