//! Rings and tubes that are crushed until their walls touch.

use super::{Dialect, Scene, Units, everything, plane, soft, steps_of};
use crate::scenes::{
    grid::{Cells, Course, Grid},
    kinds::parts::Stance,
    random::Random,
    scene::{Rigid, RigidShape, Step},
    vector::Vector,
};

/// An oval tube about the axis `y`, from its lowest point round.
fn oval(half: [f64; 2], thick: f64, wide: f64, divisions: [usize; 3]) -> Grid {
    Grid::mapped(divisions, Course::Ring, Cells::Hexahedra, |[x, y, z]| {
        let (sine, cosine) = (std::f64::consts::TAU * x).sin_cos();
        let inwards = thick * (1.0 - z);
        [
            -(half[0] - inwards) * sine,
            wide * y,
            -(half[1] - inwards) * cosine,
        ]
    })
}

/// A rigid strip of a plane that looks along `z`, up or down.
fn jaw(name: &'static str, z: f64, half: f64, across: [f64; 2], up: bool) -> Rigid {
    let [from, to] = across;
    let corners = [
        [-half, from, z],
        [half, from, z],
        [half, to, z],
        [-half, to, z],
    ];
    let facet = if up { [0, 1, 2, 3] } else { [0, 3, 2, 1] };
    Rigid {
        name,
        shape: RigidShape::Sheet(corners.to_vec(), vec![facet]),
    }
}

/// A ring in plane strain between planes or narrow jaws.
pub fn ring(random: &mut Random, _: Dialect) -> Scene {
    let units = Units::random(random);
    let around = 4 * random.whole(5..=9);
    let unit = units.length;
    let thick = random.between(0.06, 0.22) * unit;
    let half = [unit * random.between(0.8, 1.2), unit];
    let layers = random.whole(1..=2);
    let grid = oval(half, thick, 0.3 * unit, [around, 1, layers]);
    let grid = grid
        .with_nodes("middle", |x| x[0].abs() < 1e-9 * unit)
        .with_nodes("whole", |_| true);
    let mut body = soft(random, "ring", units, grid);
    body.formulation = Some("assumed-strain");
    let tools = if random.chance(0.5) {
        vec![
            plane("floor", [0.0, 0.0, -unit], [0.0, 0.0, 1.0]),
            plane("lid", [0.0, 0.0, unit], [0.0, 0.0, -1.0]),
        ]
    } else {
        let wide = random.between(0.3, 0.6) * unit;
        let across = [-0.1 * unit, 0.4 * unit];
        vec![
            jaw("floor", -unit, wide, across, true),
            jaw("lid", unit, wide, across, false),
        ]
    };
    let mut scene = everything(random, units, Stance::Upright, vec![body], tools);
    let closed = 2.0 * (unit - thick);
    let way = closed + random.between(-0.1, 0.2) * thick;
    let mut step = Step::new("crush")
        .holding("ring", "whole", [None, Some(0.0), None])
        .holding("ring", "middle", [Some(0.0), None, None])
        .within(steps_of(way, random.between(0.03, 0.06) * closed));
    step.rigid.push(("lid", [0.0, 0.0, -way], None));
    scene.steps = vec![step];
    scene
}

/// A tube clamped at one end and pinched towards the other.
pub fn tube(random: &mut Random, _: Dialect) -> Scene {
    let units = Units::random(random);
    let unit = units.length;
    let around = 4 * random.whole(4..=6);
    let thick = random.between(0.08, 0.2) * unit;
    let long = random.between(2.0, 3.5) * unit;
    let along = random.whole(5..=7);
    let grid = oval([unit, unit], thick, long, [around, along, 1]);
    let mut body = soft(random, "tube", units, grid);
    body.formulation = Some("assumed-strain");
    let open = random.between(0.4, 0.6) * long;
    let across = [open, 1.2 * long];
    let wide = random.between(1.2, 2.0) * unit;
    let tools = vec![
        jaw("floor", -unit, wide, across, true),
        jaw("lid", unit, wide, across, false),
    ];
    let mut scene = everything(random, units, Stance::Any, vec![body], tools);
    let closed = unit - thick;
    let way = closed + random.between(-0.1, 0.1) * thick;
    let mut step = Step::new("pinch")
        .moving("tube", "ymin", [0.0; 3])
        .within(steps_of(way, random.between(0.04, 0.08) * closed));
    let down: Vector = [0.0, 0.0, -way];
    step.rigid.push(("lid", down, None));
    step.rigid.push(("floor", down.map(|x| -x), None));
    scene.steps = vec![step];
    scene
}
