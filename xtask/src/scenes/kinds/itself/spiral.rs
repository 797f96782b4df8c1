//! Strips rolled up to spirals, wound by their inner end or crushed.

use super::{Dialect, Scene, Units, everything, plane, soft, steps_of};
use crate::scenes::{
    grid::{Cells, Course, Grid},
    kinds::parts::Stance,
    random::Random,
    scene::{Body, Rigid, RigidShape, Step},
    vector::Vector,
};

/// A strip in the plane of `x` and `y` along `r = r_0 + pitch phi/(2 pi)`.
struct Spiral {
    body: Body,
    units: Units,
    pitch: f64,
    gap: f64,
    outer: f64,
    /// Room between the outermost layer and the inner end, but for the layers between them.
    room: f64,
}

impl Spiral {
    fn new(random: &mut Random) -> Self {
        let units = Units::random(random);
        let inner = random.between(0.4, 0.6) * units.length;
        let thick = random.between(0.05, 0.1) * units.length;
        let gap = random.between(0.4, 1.5) * thick;
        let pitch = thick + gap;
        let turns = random.between(1.5, 2.2);
        let radius = |turn: f64| inner + pitch * turn;
        let around = random.whole(14..=18);
        let cells = (turns * around as f64).round() as usize;
        let across = random.whole(1..=2);
        let wide = random.between(0.5, 1.5) * units.length / around as f64;
        let grid = Grid::mapped(
            [cells, across, 1],
            Course::Open,
            Cells::Hexahedra,
            |[s, y, z]| {
                let turn = -turns * s;
                let (sine, cosine) = (std::f64::consts::TAU * turn).sin_cos();
                let r = radius(-turn) + thick * (y - 0.5);
                [r * cosine, r * sine, wide * z]
            },
        );
        let side = |name: &str| {
            let side = grid.sides.iter().find(|side| side.0 == name);
            side.map(|side| side.1.clone()).unwrap_or_default()
        };
        let ends = [side("xmin"), side("xmax")].concat();
        let count = grid.positions.len();
        let rest = (0..count).filter(|node| !ends.contains(node)).collect();
        let mut grid = grid;
        grid.nodes.push(("rest", rest));
        let mut body = soft(random, "strip", units, grid);
        if across == 1 {
            body.formulation = Some("assumed-strain");
        }
        let outer = radius(turns) + 0.5 * thick;
        Self {
            body,
            units,
            pitch,
            gap,
            outer,
            room: pitch * turns - 1.2 * thick * turns.floor(),
        }
    }
}

/// The inner end turned with its hub until layers touch, the outer end held.
pub fn wound(random: &mut Random, _: Dialect) -> Scene {
    let spiral = Spiral::new(random);
    let hub = RigidShape::Head("strip", "xmin", [0.0; 3]);
    let hub = Rigid {
        name: "hub",
        shape: hub,
    };
    let Spiral { body, units, .. } = spiral;
    let mut scene = everything(random, units, Stance::Upright, vec![body], vec![hub]);
    let degrees = random.between(60.0, 200.0) * if random.chance(0.75) { 1.0 } else { -0.5 };
    let mut step = Step::new("wind")
        .moving("strip", "xmax", [0.0; 3])
        .holding("strip", "rest", [None, None, Some(0.0)])
        .within(steps_of(degrees.abs(), random.between(6.0, 15.0)));
    step.rigid.push(("hub", [0.0; 3], Some(degrees)));
    scene.steps = vec![step];
    scene
}

/// Crushed between two planes, the inner end held.
pub fn rolled(random: &mut Random, _: Dialect) -> Scene {
    let spiral = Spiral::new(random);
    let Spiral {
        body,
        units,
        pitch,
        gap,
        outer,
        room,
    } = spiral;
    let planes = vec![
        plane("left", [-outer, 0.0, 0.0], [1.0, 0.0, 0.0]),
        plane("right", [outer, 0.0, 0.0], [-1.0, 0.0, 0.0]),
    ];
    let mut scene = everything(random, units, Stance::Upright, vec![body], planes);
    // The inner end is held: planes that go further would go through it.
    let way = (random.between(1.0, 3.0) * gap + pitch).min(room);
    let mut step = Step::new("crush")
        .moving("strip", "xmin", [0.0; 3])
        .holding("strip", "rest", [None, None, Some(0.0)])
        .holding("strip", "xmax", [None, None, Some(0.0)])
        .within(steps_of(way, random.between(0.2, 0.6) * (pitch - gap)));
    let to: Vector = [way, 0.0, 0.0];
    step.rigid.push(("left", to, None));
    step.rigid.push(("right", to.map(|x| -x), None));
    scene.steps = vec![step];
    scene
}
