//! Two blocks: pressed, slid, turned, pushed off, lifted, with gaps and overlaps.

use super::{
    Choice, Dialect,
    parts::{
        Stance, Strains, Units, block, body, facet, height, increments, pair, placement, ratio,
        scene, strains,
    },
};
use crate::scenes::{
    random::Random,
    scene::{End, Rigid, RigidShape, Scene, Start, Step},
    vector::{Vector, plus},
};

/// Two blocks on one another and what to do with them.
pub struct Stack {
    /// Without steps.
    pub scene: Scene,
    /// Depth by which the upper one is pressed down.
    pub depth: f64,
    /// Size of the facets.
    pub facet: f64,
    /// From the middle of the upper block to where the two no longer overlap.
    pub way_off: f64,
    /// Unit of length.
    pub unit: f64,
    /// Top of the upper block.
    pub top: Vector,
    /// Pressure to expect.
    pub pressure: f64,
    /// Area of the top.
    pub area: f64,
}

/// Start of two blocks.
pub struct Wanted {
    /// Between them, in facets; negative where they overlap.
    pub gap: f64,
    /// Magnitude of the compression.
    pub strains: Strains,
    /// Orientation in space.
    pub stance: Stance,
}

impl Wanted {
    /// Just touching.
    pub fn touching(strains: Strains) -> Self {
        Self {
            gap: 0.0,
            strains,
            stance: Stance::Any,
        }
    }
}

impl Stack {
    /// Two blocks with a gap in sizes of facets.
    pub fn new(random: &mut Random, wanted: &Wanted) -> Self {
        let units = Units::random(random);
        let unit = units.length;
        let plan = [
            random.between(0.8, 1.2) * unit,
            random.between(0.8, 1.2) * unit,
        ];
        let (upper_plan, middle) = upper_place(random, plan);
        let (h_lower, layers) = height(random, plan);
        let lower = block(random, [0.0, 0.0, -h_lower], plan, h_lower, layers);
        let (h_upper, layers) = height(random, upper_plan);
        let mut upper = block(random, middle, upper_plan, h_upper, layers);
        let size = (facet(&lower) * facet(&upper)).sqrt();
        // A block that is behind the other one is no overlap.
        let gap = (wanted.gap * size).max(-0.5 * h_lower.min(h_upper));
        upper.origin[2] = gap;
        let ratio = ratio(random);
        let width = [plan[0], plan[1], upper_plan[0], upper_plan[1]]
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        let strain = wanted.strains.press(random);
        let press = Press {
            moduli: [units.modulus, units.modulus * ratio],
            heights: [h_lower.min(width), h_upper.min(width)],
        };
        let reach = 0.5 * f64::hypot(plan[0], plan[1]) + f64::hypot(middle[0], middle[1]);
        let sides = [("lower", Some("zmax")), ("upper", Some("zmin"))];
        let pair = pair(random, "interface", sides, reach, press.pressure(strain));
        let materials = press
            .moduli
            .map(|modulus| wanted.strains.material(random, modulus));
        let bodies = vec![
            body("lower", materials[0], lower),
            body("upper", materials[1], upper),
        ];
        let placement = placement(random, units, wanted.stance);
        Self {
            scene: scene(placement, Some(ratio), bodies, vec![pair]),
            depth: press.depth(strain),
            facet: size,
            way_off: 0.5 * (plan[0] + upper_plan[0]) - middle[0],
            unit,
            pressure: press.pressure(strain),
            area: upper_plan[0] * upper_plan[1],
            top: plus(middle, [0.0, 0.0, h_upper + gap]),
        }
    }

    /// The step that presses, with the lower body clamped.
    pub fn press(&self, random: &mut Random, to: Vector) -> Step {
        Step::new("press")
            .moving("lower", "zmin", [0.0; 3])
            .moving("upper", "zmax", to)
            .within(increments(random))
            .ending(End::Touching)
    }

    /// A way to slide: some facets in any direction.
    pub fn way(&self, random: &mut Random) -> Vector {
        let angle = random.between(0.0, std::f64::consts::TAU);
        let far = random.between(0.3, 2.5) * self.facet;
        [far * angle.cos(), far * angle.sin(), 0.0]
    }
}

/// Two columns in a row under the same force.
pub struct Press {
    /// Their moduli.
    pub moduli: [f64; 2],
    /// Their heights, at most the width of the contact.
    pub heights: [f64; 2],
}

impl Press {
    fn stiffnesses(&self) -> [f64; 2] {
        [0, 1].map(|i| self.moduli[i] / self.heights[i])
    }

    /// The approach at which the more compressed column has a strain.
    pub fn depth(&self, strain: f64) -> f64 {
        let [one, two] = self.stiffnesses();
        let of = |own: f64, other: f64, height: f64| strain * height * (own + other) / other;
        of(one, two, self.heights[0]).min(of(two, one, self.heights[1]))
    }

    /// The pressure then.
    pub fn pressure(&self, strain: f64) -> f64 {
        let [one, two] = self.stiffnesses();
        self.depth(strain) * one * two / (one + two)
    }
}

/// Plan of the upper block and the place of its middle: smaller, flush, larger, over
/// an edge.
fn upper_place(random: &mut Random, plan: [f64; 2]) -> ([f64; 2], Vector) {
    let style = random.whole(0..=4);
    let share = [0, 1].map(|_| match style {
        0 => 1.0,
        1 => random.between(1.05, 1.4),
        _ => random.between(0.35, 0.85),
    });
    let upper = [plan[0] * share[0], plan[1] * share[1]];
    let mut shifted = |axis: usize| {
        let room = 0.5 * (plan[axis] - upper[axis]);
        match style {
            0 => 0.0,
            1 => random.between(-0.2, 0.2) * plan[axis],
            2 => random.between(-room, room),
            // Over the edge by up to half of it.
            3 => random.sign() * (room + random.between(0.0, 0.5) * upper[axis]),
            _ => room * random.one_of(&[-1.0, 0.0, 1.0]),
        }
    };
    let middle = [shifted(0), shifted(1), 0.0];
    (upper, middle)
}

fn touching(random: &mut Random) -> Stack {
    let strains = strains(random);
    Stack::new(random, &Wanted::touching(strains))
}

/// Two blocks that are to be pressed moderately.
pub fn moderate(random: &mut Random) -> Stack {
    Stack::new(random, &Wanted::touching(Strains::Moderate))
}

/// Pressed.
pub fn press(random: &mut Random, _: Dialect) -> Scene {
    let mut stack = touching(random);
    stack.scene.steps = vec![stack.press(random, [0.0, 0.0, -stack.depth])];
    stack.scene
}

/// Pressed by a load on the top, which is held sideways, and dragged under it.
pub fn load(random: &mut Random, _: Dialect) -> Scene {
    let strains = strains(random);
    let wanted = Wanted {
        stance: Stance::Upright,
        ..Wanted::touching(strains)
    };
    let mut stack = Stack::new(random, &wanted);
    // Over the edge, the covered part carries all.
    let traction = [0.0, 0.0, -0.5 * stack.pressure];
    let mut press = Step::new("press")
        .moving("lower", "zmin", [0.0; 3])
        .within(increments(random))
        .ending(End::Touching);
    let aside = |[x, y, _]: Vector| ("upper", "zmax", [Some(x), Some(y), None]);
    press.displacements.push(aside([0.0; 3]));
    press
        .tractions
        .push(("upper", "zmax", traction, stack.area));
    let mut slide = Step::new("slide")
        .within(increments(random))
        .ending(End::Touching);
    let way = stack.way(random).map(|x| 0.3 * x);
    slide.displacements.push(aside(way));
    stack.scene.steps = vec![press, slide];
    stack.scene
}

/// Pressed and slid.
pub fn slide(random: &mut Random, _: Dialect) -> Scene {
    let mut stack = touching(random);
    let down = [0.0, 0.0, -stack.depth];
    let press = stack.press(random, down);
    let way = plus(down, stack.way(random));
    let slide = Step::new("slide")
        .moving("upper", "zmax", way)
        .within(increments(random));
    stack.scene.steps = vec![press, slide];
    stack.scene
}

/// Pressed and turned about the normal.
pub fn turn(random: &mut Random, _: Dialect) -> Scene {
    let mut stack = moderate(random);
    let down = [0.0, 0.0, -stack.depth];
    let head = RigidShape::Head("upper", "zmax", stack.top);
    stack.scene.rigid.push(Rigid {
        name: "head",
        shape: head,
    });
    let mut press = Step::new("press")
        .moving("lower", "zmin", [0.0; 3])
        .within(increments(random))
        .ending(End::Touching);
    press.rigid.push(("head", down, Some(0.0)));
    let mut turn = Step::new("turn").within(increments(random));
    let degrees = random.sign() * random.between(3.0, 30.0);
    turn.rigid.push(("head", down, Some(degrees)));
    stack.scene.steps = vec![press, turn];
    stack.scene
}

/// Slid there and back.
pub fn reverse(random: &mut Random, _: Dialect) -> Scene {
    let mut stack = touching(random);
    let down = [0.0, 0.0, -stack.depth];
    let way = stack.way(random);
    let back = way.map(|x| -x * random.between(0.0, 1.0));
    let slide = |name, way| Step::new(name).moving("upper", "zmax", plus(down, way));
    let press = stack.press(random, down);
    stack.scene.steps = vec![
        press,
        slide("there", way).within(increments(random)),
        slide("back", back).within(increments(random)),
    ];
    stack.scene
}

/// Slid off an edge completely.
pub fn slide_off(random: &mut Random, _: Dialect) -> Scene {
    let mut stack = moderate(random);
    let down = [0.0, 0.0, -stack.depth];
    let way = stack.way_off + 0.1 * stack.unit + random.between(0.1, 0.3) * stack.facet;
    let aside = random.between(-0.2, 0.2) * stack.unit;
    // About half a facet an increment.
    let count = (way / (0.5 * stack.facet)).ceil().clamp(10.0, 40.0) as usize;
    let press = stack.press(random, down);
    let off = Step::new("off")
        .moving("upper", "zmax", plus(down, [way, aside, 0.0]))
        .within(Some(count))
        .ending(End::Apart);
    stack.scene.steps = vec![press, off];
    stack.scene
}

/// Pressed, lifted, moved aside and pressed again.
pub fn lift(random: &mut Random, _: Dialect) -> Scene {
    let mut stack = touching(random);
    let down = [0.0, 0.0, -stack.depth];
    let up = random.between(0.2, 3.0) * stack.facet;
    let aside = if random.chance(0.5) {
        stack.way(random)
    } else {
        [0.0; 3]
    };
    let aside = aside.map(|x| 0.3 * x);
    let to = |name, to, end| Step::new(name).moving("upper", "zmax", to).ending(end);
    let press = stack.press(random, down);
    let lift = to("lift", [0.0, 0.0, up], End::Apart).within(increments(random));
    let again = plus(down, aside);
    stack.scene.steps = vec![press, lift];
    if aside != [0.0; 3] {
        let aside = plus(aside, [0.0, 0.0, up]);
        stack
            .scene
            .steps
            .push(to("aside", aside, End::Apart).within(Some(2)));
    }
    stack
        .scene
        .steps
        .push(to("again", again, End::Touching).within(increments(random)));
    stack.scene
}

/// A gap closed in few increments, then pressed.
pub fn gap(random: &mut Random, _: Dialect) -> Scene {
    let strains = strains(random);
    let gap = random.decade(0.05, 3.0);
    let mut stack = Stack::new(
        random,
        &Wanted {
            gap,
            strains,
            stance: Stance::Any,
        },
    );
    let down = [0.0, 0.0, -stack.depth - gap * stack.facet];
    let aside = if random.chance(0.3) {
        stack.way(random)
    } else {
        [0.0; 3]
    };
    let mut press = stack.press(random, plus(down, aside));
    press.increments = Some(random.whole(1..=5));
    stack.scene.steps = vec![press];
    stack.scene
}

/// Blocks that overlap at the start, held and then pressed.
pub fn overlap(random: &mut Random, dialect: Dialect) -> Scene {
    let gap = -random.decade(0.005, 0.2);
    let mut stack = Stack::new(
        random,
        &Wanted {
            gap,
            strains: Strains::Moderate,
            stance: Stance::Any,
        },
    );
    let initial = random.one_of(&[None, Some("close"), Some("resolve")]);
    let known = dialect.initial == Choice::Known;
    stack.scene.start = Start::Overlapping(initial.filter(|_| known));
    let press = stack.press(random, [0.0, 0.0, -stack.depth]);
    stack.scene.steps = vec![press];
    stack.scene
}
