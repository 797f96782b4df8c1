//! Other shapes on a block: spherical caps, edges, oblique faces.

use super::{
    Dialect,
    parts::{
        Stance, Strains, Units, block, body, facet, height, increments, pair, placement, ratio,
        scene,
    },
    plain::{Press, Stack, Wanted},
};
use crate::scenes::{
    random::Random,
    scene::{Body, Cap, End, Rigid, RigidShape, Scene, Shape, Step},
    vector::plus,
};

/// A spherical cap pressed on a block or a rigid plane, perhaps slid.
pub fn cap(random: &mut Random, _: Dialect) -> Scene {
    let units = Units::random(random);
    let unit = units.length;
    let width = random.between(0.6, 1.0) * unit;
    let cap = Cap {
        apex: [0.0; 3],
        size: [width, width * random.between(0.9, 1.1)],
        height: width * random.between(0.6, 0.9),
        radius: width * random.between(1.0, 2.5),
        element: width * random.between(0.06, 0.12),
    };
    let against_rigid = random.chance(0.2);
    let ratio = ratio(random);
    let strain = random.between(0.01, 0.05);
    // Indented by about two elements over the contact radius.
    let depth = (strain * 0.4 * cap.height).min(3.0 * cap.element * cap.element / cap.radius);
    let side = ("cap", Some("cap"));
    let pressure = units.modulus * strain * ratio.min(1.0);
    let mut bodies = vec![Body {
        name: "cap",
        material: Strains::Moderate.material(random, units.modulus * ratio),
        shape: Shape::Cap(cap.clone()),
        union: None,
        nearest: Vec::new(),
        formulation: None,
    }];
    let below = if against_rigid {
        ("plane", None)
    } else {
        ("base", Some("zmax"))
    };
    let pair = pair(random, "contact", [side, below], unit, pressure);
    if !against_rigid {
        let plan = [
            random.between(0.7, 1.3) * unit,
            random.between(0.7, 1.3) * unit,
        ];
        let high = random.between(0.4, 0.8) * unit;
        let mut base = block(random, [0.0, 0.0, -high], plan, high, 3);
        for axis in 0..2 {
            base.divisions[axis] = random.whole(5..=8);
            base.gradings[axis] = Some(("symmetric", random.between(0.3, 0.8)));
        }
        bodies.push(body(
            "base",
            Strains::Moderate.material(random, units.modulus),
            base,
        ));
    }
    let placement = placement(random, units, Stance::Upright);
    let mut scene = scene(
        placement,
        (!against_rigid).then_some(ratio),
        bodies,
        vec![pair],
    );
    let down = [0.0, 0.0, -depth];
    let mut press = Step::new("press")
        .moving("cap", "zmax", down)
        .ending(End::Touching);
    if against_rigid {
        scene.rigid.push(Rigid {
            name: "plane",
            shape: RigidShape::Plane([0.0; 3], [0.0, 0.0, 1.0]),
        });
    } else {
        press = press.moving("base", "zmin", [0.0; 3]);
    }
    scene.steps = vec![press.within(increments(random))];
    if random.chance(0.6) {
        let angle = random.between(0.0, std::f64::consts::TAU);
        let way = random.between(0.3, 2.0) * cap.element;
        let to = plus(down, [way * angle.cos(), way * angle.sin(), 0.0]);
        let slide = Step::new("slide").moving("cap", "zmax", to);
        scene.steps.push(slide.within(increments(random)));
    }
    scene
}

/// A tilted block, pressed with its edge on a face.
pub fn edge(random: &mut Random, _: Dialect) -> Scene {
    let units = Units::random(random);
    let unit = units.length;
    let plan = [unit, random.between(0.8, 1.2) * unit];
    let (high, layers) = (random.between(0.4, 0.8) * unit, random.whole(2..=4));
    let lower = block(random, [0.0, 0.0, -high], plan, high, layers);
    let width = [
        random.between(0.4, 0.7) * unit,
        random.between(0.4, 0.9) * unit,
    ];
    let tall = random.between(0.4, 0.8) * unit;
    let mut upper = block(random, [0.0; 3], width, tall, 3);
    let flat = random.chance(0.4);
    let degrees = if flat {
        random.between(0.5, 5.0)
    } else {
        random.between(10.0, 45.0)
    };
    // Lifted about the edge on its left, which then lies across the middle of the face.
    let aside = -0.25 * unit;
    upper.origin[0] = aside;
    upper.tilt = Some(([0.0, 1.0, 0.0], -degrees, [aside, 0.0, 0.0]));
    let strain = random.between(0.01, 0.05);
    let depth = if flat {
        0.5 * strain * high
    } else {
        random.between(0.05, 0.2) * facet(&upper).min(facet(&lower))
    };
    let ratio = ratio(random);
    let sides = [("lower", Some("zmax")), ("upper", Some("sole"))];
    let pair = pair(
        random,
        "contact",
        sides,
        unit,
        units.modulus * ratio.min(1.0) * strain,
    );
    let mut tilted = body(
        "upper",
        Strains::Moderate.material(random, units.modulus * ratio),
        upper,
    );
    tilted.union = Some(("sole", ["zmin", "xmin"]));
    let bodies = vec![
        body(
            "lower",
            Strains::Moderate.material(random, units.modulus),
            lower,
        ),
        tilted,
    ];
    let placement = placement(random, units, Stance::Any);
    let mut scene = scene(placement, Some(ratio), bodies, vec![pair]);
    let down = [0.0, 0.0, -depth];
    scene.steps = vec![
        Step::new("press")
            .moving("lower", "zmin", [0.0; 3])
            .moving("upper", "zmax", down)
            .within(increments(random))
            .ending(End::Touching),
    ];
    if random.chance(0.4) {
        let way = random.sign() * random.between(0.2, 1.0) * 0.1 * unit;
        let slide = Step::new("slide").moving("upper", "zmax", plus(down, [way, 0.0, 0.0]));
        scene.steps.push(slide.within(increments(random)));
    }
    scene
}

/// Two blocks with an oblique interface, pressed.
pub fn oblique(random: &mut Random, _: Dialect) -> Scene {
    let mut stack = Stack::new(random, &Wanted::touching(Strains::Moderate));
    let slopes = [random.between(-0.25, 0.25), random.between(-0.25, 0.25)];
    let mut middles = [[0.0; 2]; 2];
    for (index, body) in stack.scene.bodies.iter_mut().enumerate() {
        let Shape::Block(block) = &mut body.shape else {
            continue;
        };
        middles[index] = [0, 1].map(|i| block.origin[i] + 0.5 * block.size[i]);
        let middle = middles[index];
        // Slopes are about the middle of the side; the plane goes through the origin.
        let rise = slopes[0] * middle[0] + slopes[1] * middle[1];
        if index == 0 {
            block.top_slopes = slopes;
            let (high, layers) = tall(random, block.size);
            (block.size[2], block.divisions[2]) = (high, layers);
            block.origin[2] = -high;
        } else {
            block.bottom_slopes = slopes;
            let (high, layers) = tall(random, block.size);
            (block.size[2], block.divisions[2]) = (high, layers);
        }
        block.origin[2] += rise;
    }
    let ratio = stack.scene.ratio.unwrap_or(1.0);
    let heights = [0, 1].map(|i| match &stack.scene.bodies[i].shape {
        Shape::Block(block) => block.size[2].min(block.size[0]).min(block.size[1]),
        Shape::Cap(cap) => cap.height,
        Shape::Grid(grid) => grid.edge,
    });
    let press = Press {
        moduli: [1.0, ratio],
        heights,
    };
    let depth = press.depth(random.between(0.005, 0.03));
    let down = [0.0, 0.0, -depth];
    scene_of(random, stack, down)
}

/// Height enough for oblique sides.
fn tall(random: &mut Random, size: [f64; 3]) -> (f64, usize) {
    let (high, layers) = height(random, [size[0], size[1]]);
    let least = 0.5 * (size[0] + size[1]) * 0.6;
    (high.max(least), layers)
}

fn scene_of(random: &mut Random, mut stack: Stack, down: [f64; 3]) -> Scene {
    let press = stack.press(random, down);
    stack.scene.steps = vec![press];
    if random.chance(0.5) {
        let way = plus(down, stack.way(random).map(|x| 0.3 * x));
        let slide = Step::new("slide").moving("upper", "zmax", way);
        stack.scene.steps.push(slide.within(increments(random)));
    }
    stack.scene
}
