//! Blocks with slots from below, and blocks cut into pins.

use super::{Dialect, Scene, Units, everything, plane, soft};
use crate::scenes::{
    grid::{Cells, Course, Grid},
    kinds::parts::Stance,
    random::Random,
    scene::{End, Step},
    vector::{Vector, plus},
};

/// A row of cells with narrow gaps: gaps are columns of their own.
struct Row {
    /// Cells of a lamella.
    lamella: usize,
    /// Gaps.
    gaps: usize,
    /// Width of a gap over that of a lamella.
    width: f64,
}

impl Row {
    fn cells(&self) -> usize {
        self.gaps + (self.gaps + 1) * self.lamella
    }

    fn is_gap(&self, column: usize) -> bool {
        self.gaps > 0 && column % (self.lamella + 1) == self.lamella && column < self.cells()
    }

    /// Place of a grid line, from the share of all of them.
    fn place(&self, share: f64) -> f64 {
        let line = (share * self.cells() as f64).round() as usize;
        let width = |column| {
            if self.is_gap(column) {
                self.width
            } else {
                1.0 / self.lamella as f64
            }
        };
        (0..line).map(width).sum()
    }

    fn length(&self) -> f64 {
        self.place(1.0)
    }

    /// Returns whether a share of the cells is in a gap.
    fn has_gap_at(&self, share: f64) -> bool {
        self.is_gap((share * self.cells() as f64) as usize)
    }
}

/// A block with slots, pressed on a plane and dragged over it.
pub fn slots(random: &mut Random, _: Dialect) -> Scene {
    let row = Row {
        gaps: random.whole(1..=3),
        lamella: random.whole(1..=3),
        width: random.between(0.04, 0.3),
    };
    let solid = Row {
        gaps: 0,
        lamella: random.whole(1..=3),
        width: 0.0,
    };
    dragged(random, [row, solid])
}

/// A block cut into pins by slots both ways, pressed and dragged.
pub fn pins(random: &mut Random, _: Dialect) -> Scene {
    let rows = [0, 1].map(|_| Row {
        gaps: random.whole(1..=2),
        lamella: random.whole(1..=2),
        width: random.between(0.05, 0.3),
    });
    dragged(random, rows)
}

fn dragged(random: &mut Random, rows: [Row; 2]) -> Scene {
    let units = Units::random(random);
    let unit = units.length;
    let high = random.whole(3..=5);
    let deep = random.whole(2..=high - 1) as f64 / high as f64;
    let tall = random.between(1.2, 2.2) * unit;
    let divisions = [rows[0].cells(), rows[1].cells(), high];
    let grid = Grid::mapped(divisions, Course::Open, Cells::Hexahedra, |x| x);
    let cut = |[x, y, z]: Vector| z < deep && (rows[0].has_gap_at(x) || rows[1].has_gap_at(y));
    let grid = grid
        .without(cut)
        .moved(|[x, y, z]| [unit * rows[0].place(x), unit * rows[1].place(y), tall * z]);
    let middle = rows.each_ref().map(|row| 0.5 * unit * row.length());
    let grid = grid.moved(|x| plus(x, [-middle[0], -middle[1], 0.0]));
    let body = soft(random, "tread", units, grid);
    let road = plane("road", [0.0; 3], [0.0, 0.0, 1.0]);
    let mut scene = everything(random, units, Stance::Any, vec![body], vec![road]);
    let down = [0.0, 0.0, -random.between(0.02, 0.1) * tall];
    let angle = random.between(0.0, std::f64::consts::TAU);
    let far = random.between(0.15, 0.5) * unit;
    let way = [far * angle.cos(), far * angle.sin(), 0.0];
    let size = random.between(0.05, 0.15) * unit;
    let to = |name, to| Step::new(name).moving("tread", "zmax", to);
    scene.steps = vec![
        to("press", down).ending(End::Open),
        to("drag", plus(down, way)).within(super::steps_of(far, size)),
    ];
    scene
}
