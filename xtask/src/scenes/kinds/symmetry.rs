//! Halves and quarters of symmetric scenes, held against the whole.

use super::{
    Dialect,
    parts::{Stance, Units, body, pair_with, placement, ratio, scene},
    plain::Press,
    simple::{plain_block, rubbery},
};
use crate::scenes::{
    claim::{Claim, Quantity, about},
    law::Law,
    random::Random,
    scene::{Block, Body, End, Ending, Scene, Step},
};

/// Part of a scene that is modelled.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    Whole,
    /// All beyond `y = 0`.
    Half,
    /// All beyond `x = 0` and `y = 0`.
    Quarter,
}

impl Part {
    fn is_cut(self, axis: usize) -> bool {
        match self {
            Self::Whole => false,
            Self::Half => axis == 1,
            Self::Quarter => axis < 2,
        }
    }

    /// Its share of a block about the vertical axis.
    fn of(self, mut block: Block) -> Block {
        for axis in (0..2).filter(|&axis| self.is_cut(axis)) {
            block.origin[axis] = 0.0;
            block.size[axis] *= 0.5;
            block.divisions[axis] /= 2;
        }
        block
    }

    /// Holds a body at its planes of symmetry, and the whole one at nodes that lie there.
    fn held(self, mut step: Step, body: &'static str, slides: bool) -> Step {
        let along = [Some(0.0), None, None];
        let across = [None, Some(0.0), None];
        if self.is_cut(1) {
            step = step.holding(body, "ymin", across);
        } else {
            step = step.holding(body, "middle", across);
            if !slides {
                step = step.holding(body, "end", across);
            }
        }
        if slides {
            return step;
        }
        let at = if self.is_cut(0) { "xmin" } else { "middle" };
        if self.is_cut(0) || self.is_cut(1) {
            return step.holding(body, at, along);
        }
        // The middle of the whole one is held along both axes by one condition.
        step.displacements
            .retain(|held| (held.0, held.1) != (body, "middle"));
        step.holding(body, "middle", [Some(0.0), Some(0.0), None])
    }
}

/// Half or a quarter of two blocks, pressed, and half of them slid along its plane.
pub fn half(random: &mut Random, _: Dialect) -> Scene {
    let quarter = random.chance(0.4);
    let part = if quarter { Part::Quarter } else { Part::Half };
    let mut again = random.clone();
    let mut scene = build(random, part, quarter);
    scene.reference = Some(Box::new(build(&mut again, Part::Whole, quarter)));
    let share = if quarter { 0.25 } else { 0.5 };
    let mut claim = |step, along, error| {
        let quantity = Quantity::Beside(0, "upper", along);
        let claim = Claim::at_end("refined", step, quantity, about(share, error));
        scene.claims.push(claim);
    };
    claim(0, [0.0, 0.0, 1.0], 0.01);
    if !quarter {
        claim(1, [0.0, 0.0, 1.0], 0.01);
    }
    if !quarter && scene.pairs[0].law != Law::Frictionless {
        let quantity = Quantity::Beside(0, "upper", [1.0, 0.0, 0.0]);
        let claim = Claim::at_end("refined", 1, quantity, about(share, 0.02));
        scene.claims.push(claim);
    }
    scene.ending = Ending::Completes;
    scene
}

fn build(random: &mut Random, part: Part, quarter: bool) -> Scene {
    let units = Units::random(random);
    let unit = units.length;
    let plan = [0; 2].map(|_| random.between(0.8, 1.2) * unit);
    let upper_plan = [0, 1].map(|axis| plan[axis] * random.between(0.4, 0.9));
    let heights = [0; 2].map(|_| random.between(0.3, 0.6) * unit);
    let ratio = ratio(random);
    let press = Press {
        moduli: [units.modulus, units.modulus * ratio],
        heights,
    };
    let strain = random.between(0.005, 0.03);
    let (depth, pressure) = (press.depth(strain), press.pressure(strain));
    let names = ["lower", "upper"];
    let poisson = random.between(0.0, 0.4);
    let bodies: Vec<Body> = (0..2)
        .map(|i| {
            let [a, b] = [plan, upper_plan][i];
            let bottom = [-heights[0], 0.0][i];
            let divisions = [
                2 * random.whole(1..=4),
                2 * random.whole(1..=4),
                random.whole(1..=3),
            ];
            let block = plain_block([-0.5 * a, -0.5 * b, bottom], [a, b, heights[i]], divisions);
            let outer = [bottom, heights[1]][i];
            let material = rubbery(press.moduli[i], poisson);
            let mut body = body(names[i], material, part.of(block));
            if part == Part::Whole {
                body.nearest = vec![
                    ("middle", [0.0, 0.0, outer]),
                    ("end", [0.5 * a, 0.0, outer]),
                ];
            }
            body
        })
        .collect();
    let law = match random.chance(0.25) {
        true => Law::Frictionless,
        false => Law::Coulomb(random.between(0.05, 0.6)),
    };
    let sides = [("lower", Some("zmax")), ("upper", Some("zmin"))];
    let mut pair = pair_with(random, "interface", sides, unit, pressure, law);
    (pair.cap, pair.decay) = (None, None);
    let way = random.between(0.1, 0.6) * unit / 4.0;
    let placement = placement(random, units, Stance::Upright);
    let mut scene = scene(placement, Some(ratio), bodies, vec![pair]);
    let x = |x: f64| if quarter { None } else { Some(x) };
    let mut step = Step::new("press").ending(End::Touching);
    for name in names {
        step = part.held(step, name, !quarter);
    }
    let down = Some(-depth);
    step = step
        .holding("lower", "zmin", [x(0.0), None, Some(0.0)])
        .holding("upper", "zmax", [x(0.0), None, down]);
    scene.steps = vec![step];
    if !quarter {
        let slide = Step::new("slide").holding("upper", "zmax", [Some(way), None, down]);
        scene.steps.push(slide.within(Some(6)));
    }
    scene
}
