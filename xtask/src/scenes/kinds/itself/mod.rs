//! Bodies that touch themselves, and nets of bodies: nothing names what touches.

mod bag;
mod nets;
mod round;
mod slots;
mod spiral;
mod strips;

use super::{
    Dialect, Kind,
    parts::{Stance, Units, coulomb, placement, scene},
    simple::{gridded, rubbery},
};
use crate::scenes::{
    grid::Grid,
    law::Law,
    random::Random,
    scene::{Body, Origin, Pair, Rigid, RigidShape, SKIN, Scene, Side, Statement},
    vector::Vector,
};

/// Names of the kinds and what makes them.
pub const ITSELF: [Kind; 11] = [
    ("slots", slots::slots),
    ("pins", slots::pins),
    ("folded", strips::folded),
    ("thin-folds", strips::thin),
    ("wound", spiral::wound),
    ("rolled", spiral::rolled),
    ("crushed-ring", round::ring),
    ("crushed-tube", round::tube),
    ("bag", bag::bag),
    ("fins", nets::fins),
    ("weave", nets::weave),
];

/// A law between surfaces, without friction now and then.
fn law(random: &mut Random) -> Law {
    if random.chance(0.25) {
        Law::Frictionless
    } else {
        coulomb(random, 0.1, 0.9)
    }
}

/// A body of rubber, of elements that bend well or of plain ones.
fn soft(random: &mut Random, name: &'static str, units: Units, grid: Grid) -> Body {
    let poisson = random.between(0.0, 0.42);
    let mut body = gridded(name, rubbery(units.modulus, poisson), grid);
    body.formulation = random.chance(0.7).then_some("assumed-strain");
    body
}

/// A rigid plane.
fn plane(name: &'static str, point: Vector, normal: Vector) -> Rigid {
    Rigid {
        name,
        shape: RigidShape::Plane(point, normal),
    }
}

/// Bodies and rigid surfaces of which all touch all, with a law for deformable bodies and one for
/// rigid surfaces.
fn everything(
    random: &mut Random,
    units: Units,
    stance: Stance,
    bodies: Vec<Body>,
    rigid: Vec<Rigid>,
) -> Scene {
    let laws = [law(random), law(random)];
    let whole = |owner| Side {
        owner,
        facets: Some(SKIN),
        texture: None,
    };
    let bare = |owner| Side {
        facets: None,
        ..whole(owner)
    };
    let pair = |sides: [Side; 2], law: &Law| Pair {
        name: format!("{}-{}", sides[0].owner, sides[1].owner),
        sides,
        law: law.clone(),
        cap: None,
        decay: None,
        origin: Origin::Found,
    };
    let mut pairs = Vec::new();
    for (at, body) in bodies.iter().enumerate() {
        pairs.push(pair([whole(body.name), bare(body.name)], &laws[0]));
        let others = bodies[at + 1..].iter();
        pairs.extend(others.map(|other| pair([whole(body.name), whole(other.name)], &laws[0])));
        let touchable = |rigid: &&Rigid| !matches!(rigid.shape, RigidShape::Head(..));
        let rigid = rigid.iter().filter(touchable);
        pairs.extend(rigid.map(|rigid| pair([whole(body.name), bare(rigid.name)], &laws[1])));
    }
    let placement = placement(random, units, stance);
    let mut scene = scene(placement, None, bodies, pairs);
    scene.rigid = rigid;
    let [own, _] = laws;
    scene.statement = Statement::All(own);
    scene
}

/// Number of increments in which a way is covered by steps of about a length.
fn steps_of(way: f64, length: f64) -> Option<usize> {
    Some((way / length).ceil().clamp(2.0, 30.0) as usize)
}
