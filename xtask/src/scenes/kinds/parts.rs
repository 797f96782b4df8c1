//! Parts that scenes are made of: materials, meshes, friction, textures, places.

use crate::scenes::{
    law::Law,
    random::Random,
    scene::{
        Beside, Block, Body, Ending, Material, Origin, Pair, Placement, Scene, Shape, Side, Start,
        Statement, Texture,
    },
    vector::Vector,
};

/// Units of a scene.
#[derive(Clone, Copy, Debug)]
pub struct Units {
    /// Of length.
    pub length: f64,
    /// Of the modulus: that of the lower body.
    pub modulus: f64,
}

impl Units {
    /// Random units; half of the scenes have plain ones.
    pub fn random(random: &mut Random) -> Self {
        if random.chance(0.5) {
            return Self {
                length: 1.0,
                modulus: 1.0,
            };
        }
        Self {
            length: random.decade(1e-3, 1e2),
            modulus: random.decade(1e-2, 1e9),
        }
    }
}

/// Orientation of a scene in space.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Stance {
    /// As in the local frame, perhaps shifted.
    Upright,
    /// Upright or rotated at random.
    Any,
}

/// Placement of a scene.
pub fn placement(random: &mut Random, units: Units, stance: Stance) -> Placement {
    let far = random.one_of(&[0.0, 0.0, 1.0, 10.0]) * units.length;
    let mut any = || [0; 3].map(|_| random.between(-1.0, 1.0));
    let (axis, shift) = (any(), any().map(|x| x * far));
    let rotated = stance == Stance::Any && random.chance(0.6);
    Placement {
        axis,
        degrees: if rotated {
            random.between(-180.0, 180.0)
        } else {
            0.0
        },
        shift,
    }
}

/// Magnitude of the motion of a scene.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Strains {
    /// So little that linear elasticity may do.
    Small,
    /// Moderately.
    Moderate,
}

/// Draws how far a scene moves.
pub fn strains(random: &mut Random) -> Strains {
    if random.chance(0.2) {
        Strains::Small
    } else {
        Strains::Moderate
    }
}

impl Strains {
    /// The compression of the softer body.
    pub fn press(self, random: &mut Random) -> f64 {
        match self {
            Self::Small => random.between(0.001, 0.008),
            Self::Moderate => random.between(0.01, 0.06),
        }
    }

    /// A material.
    pub fn material(self, random: &mut Random, modulus: f64) -> Material {
        let poisson = match random.whole(0..=5) {
            0 => 0.0,
            1 | 2 => 0.3,
            3 => 0.49,
            _ => random.between(0.0, 0.48),
        };
        Material {
            law: match self {
                Self::Small => random.one_of(&["linear-elastic", "neo-hookean"]),
                Self::Moderate => "neo-hookean",
            },
            modulus,
            poisson,
            density: None,
            beside: Beside::Nothing,
        }
    }
}

/// A ratio of two moduli.
pub fn ratio(random: &mut Random) -> f64 {
    if random.chance(0.1) {
        1.0
    } else {
        random.decade(1e-4, 1e4)
    }
}

/// A block of a plan and height about the vertical axis through a point, its lower
/// side at the height of the point.
pub fn block(random: &mut Random, at: Vector, plan: [f64; 2], height: f64, layers: usize) -> Block {
    let divisions = [random.whole(2..=8), random.whole(2..=8), layers];
    let mut gradings = [None; 3];
    for grading in &mut gradings[..2] {
        *grading = match random.whole(0..=5) {
            0 => Some(("one_sided", random.decade(0.3, 3.0))),
            1 => Some(("symmetric", random.decade(0.4, 2.5))),
            _ => None,
        };
    }
    Block {
        origin: [at[0] - 0.5 * plan[0], at[1] - 0.5 * plan[1], at[2]],
        size: [plan[0], plan[1], height],
        divisions,
        gradings,
        mesh_rotation: if random.chance(0.2) {
            random.between(-20.0, 20.0)
        } else {
            0.0
        },
        irregularity: random
            .chance(0.25)
            .then(|| (random.between(0.05, 0.2), random.bits() % 1000)),
        ..Block::default()
    }
}

/// Height and layers of a body, of ordinary or of flat elements.
pub fn height(random: &mut Random, plan: [f64; 2]) -> (f64, usize) {
    if random.chance(0.15) {
        let layers = random.whole(1..=3);
        // Some five elements along the plan, each ten times as long as high.
        return (layers as f64 * plan[0] / 50.0, layers);
    }
    (
        plan[0].min(plan[1]) * random.between(0.35, 1.0),
        random.whole(1..=4),
    )
}

/// Edge of the elements in the plan, the mean of both directions.
pub fn facet(block: &Block) -> f64 {
    let edge = |axis: usize| block.size[axis] / block.divisions[axis] as f64;
    (edge(0) * edge(1)).sqrt()
}

/// A body of a block.
pub fn body(name: &'static str, material: Material, block: Block) -> Body {
    Body {
        name,
        material,
        shape: Shape::Block(Box::new(block)),
        union: None,
        nearest: Vec::new(),
        formulation: None,
    }
}

/// A friction law with textures for two sides about the middle of the contact.
///
/// `share` is a pressure to expect, for a cap of the shear stress.
pub fn pair(
    random: &mut Random,
    name: &'static str,
    sides: [(&'static str, Option<&'static str>); 2],
    reach: f64,
    pressure: f64,
) -> Pair {
    let law = law(random);
    pair_with(random, name, sides, reach, pressure, law)
}

/// As [`pair`], with a given law.
pub fn pair_with(
    random: &mut Random,
    name: &'static str,
    sides: [(&'static str, Option<&'static str>); 2],
    reach: f64,
    pressure: f64,
    law: Law,
) -> Pair {
    let textured = match law {
        Law::Frictionless | Law::Coulomb(_) => [false; 2],
        Law::TwoTextures(..) => [true; 2],
        _ => random.one_of(&[[true, false], [false, true]]),
    };
    let mut order = [0, 1];
    // Either body may be the first side; a rigid surface is the second one.
    if sides[1].1.is_some() && random.chance(0.5) {
        order = [1, 0];
    }
    let side = |random: &mut Random, index: usize| Side {
        owner: sides[index].0,
        facets: sides[index].1,
        texture: textured[index].then(|| texture(random, reach)),
    };
    let sides = order.map(|index| side(random, index));
    let rubs = law != Law::Frictionless;
    Pair {
        name: name.to_owned(),
        sides,
        cap: (rubs && random.chance(0.1))
            .then(|| law.coefficient() * pressure * random.between(0.5, 2.0)),
        decay: (rubs && random.chance(0.1))
            .then(|| (random.between(0.6, 0.95), random.between(0.05, 0.5) * reach)),
        law,
        origin: Origin::Scene,
    }
}

fn law(random: &mut Random) -> Law {
    match random.whole(0..=6) {
        0 => Law::Frictionless,
        1 => Law::Orthotropic(
            random.between(0.05, 0.6),
            random.between(0.05, 0.6),
            random.one_of(&["opposing", "associated"]),
        ),
        2 => {
            let forward = random.between(0.05, 0.25);
            let backward = forward * random.between(1.0, 2.5);
            Law::Nap(
                forward,
                backward,
                0.5 * (forward + backward) * random.between(0.8, 1.2),
            )
        }
        3 => {
            let angles = random.whole(4..=8);
            let rows = (0..angles).map(|i| {
                let angle = (i as f64 + random.between(0.0, 0.7)) * 360.0 / angles as f64;
                (angle, random.between(0.1, 0.5))
            });
            Law::Tabulated(rows.collect())
        }
        4 => Law::TwoTextures(
            random.between(0.1, 0.5),
            random.between(-0.3, 0.3),
            random.between(-0.02, 0.3),
            random.between(-1.0, 1.0),
        ),
        _ => coulomb(random, 0.02, 0.8),
    }
}

/// A law with friction.
pub fn rubbing(random: &mut Random) -> Law {
    loop {
        let law = law(random);
        if law != Law::Frictionless {
            return law;
        }
    }
}

/// Coulomb's law with a coefficient of a range.
pub fn coulomb(random: &mut Random, low: f64, high: f64) -> Law {
    Law::Coulomb(random.between(low, high))
}

/// A texture on a surface that reaches so far from the vertical axis.
fn texture(random: &mut Random, reach: f64) -> Texture {
    let angle = random.between(0.0, std::f64::consts::TAU);
    let turn = random.one_of(&[0.0, 0.0, 30.0, -75.0, 90.0]);
    let key = random.one_of(&["uniform", "uniform", "circumferential", "radial"]);
    if key == "uniform" {
        return Texture::Uniform([angle.cos(), angle.sin(), 0.0], turn);
    }
    // The axis stands well beside the surface, where the field has no singularity.
    let away = reach * random.between(2.5, 5.0);
    Texture::About(key, [away * angle.cos(), away * angle.sin(), 0.0], turn)
}

/// Number of increments: mostly the program's choice.
pub fn increments(random: &mut Random) -> Option<usize> {
    random.chance(0.25).then(|| random.whole(3..=20))
}

/// A scene without a seed yet.
pub fn scene(
    placement: Placement,
    ratio: Option<f64>,
    bodies: Vec<Body>,
    pairs: Vec<Pair>,
) -> Scene {
    Scene {
        seed: 0,
        kind: "",
        ratio,
        placement,
        bodies,
        rigid: Vec::new(),
        pairs,
        steps: Vec::new(),
        start: Start::Apart,
        statement: Statement::Pairs,
        enforcement: None,
        ties: Vec::new(),
        ending: Ending::Open,
        claims: Vec::new(),
        reference: None,
    }
}
