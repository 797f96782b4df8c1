//! Scenes posed again without pairs: all touches all.
//!
//! A couple of surfaces that one pair names becomes that of their owners, whole; of owners with
//! several pairs, and of surfaces with textures, the labels of the facets keep their laws. What
//! else the deck comes down to, such as a body and itself, is found in the history by its name.
//!
//! The scene as it was is run beside it, with a normal for each face at the edges, as where all
//! touches all. Where nothing is pressed but what its pairs name, forces have to be the same.

use std::collections::{BTreeMap, BTreeSet};

use super::{
    checks::Findings,
    law::Law,
    output::{Fields, History},
    scene::{Origin, Pair, RigidShape, SKIN, Scene, Side, Statement},
    vector::{Vector, length, minus, plus},
};

/// Difference of forces over the largest of the run where the same facets meet.
const SAME: f64 = 1e-8;
/// Distance over the size of facets up to which nodes of two runs are the same.
const NEAR: f64 = 0.05;
/// Pressure over the largest of a run below which it is none.
const NOTHING: f64 = 1e-6;

/// The scene without pairs, and the one to hold it against.
///
/// # Errors
/// Why it cannot be posed so.
pub fn posed(scene: &Scene) -> Result<[Scene; 2], &'static str> {
    if scene.statement != Statement::Pairs {
        return Err("has no pairs");
    }
    if scene.enforcement.is_some_and(|method| method != "weighted") {
        return Err("asks for collocated contact, that of pairs");
    }
    if is_pressed_beside(scene) {
        return Err("pushes nodes into what no pair names");
    }
    let mut couples: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    for pair in &scene.pairs {
        *couples.entry(owners(scene, pair)).or_default() += 1;
    }
    let whole = |pair: &Pair| {
        let textured = pair.sides.iter().any(|side| side.texture.is_some());
        couples[&owners(scene, pair)] == 1 && !textured
    };
    let mut pairs = scene.pairs.clone();
    for pair in &mut pairs {
        if whole(pair) {
            let sides = pair.sides.iter_mut();
            let facets = sides.filter_map(|side| side.facets.as_mut());
            facets.for_each(|facets| *facets = SKIN);
        }
        pair.sides.sort_by_key(|side| place(scene, side.owner));
        pair.name = pair.sides.each_ref().map(Side::label).join("-");
    }
    let first = &scene.pairs[0];
    let alike = scene
        .pairs
        .iter()
        .all(|pair| whole(pair) && (&pair.law, pair.cap, pair.decay) == (&first.law, None, None));
    let law = if alike {
        first.law.clone()
    } else {
        Law::Frictionless
    };
    let general = Scene {
        pairs,
        statement: Statement::All(law),
        ..scene.clone()
    };
    let named = Scene {
        statement: Statement::PairsOfFaces,
        reference: None,
        ..scene.clone()
    };
    Ok([general, named])
}

/// Returns true where a pair leaves out facets of a side because their nodes are prescribed.
fn is_pressed_beside(scene: &Scene) -> bool {
    let sides = scene.pairs.iter().flat_map(|pair| &pair.sides);
    let mut facets = sides.filter_map(|side| side.facets);
    facets.any(|facets| facets == "back")
}

/// Place of a body or rigid surface among all.
fn place(scene: &Scene, owner: &str) -> usize {
    let names = scene.bodies.iter().map(|body| body.name);
    let rigid = scene.rigid.iter().map(|rigid| rigid.name);
    let mut names = names.chain(rigid);
    names.position(|name| name == owner).unwrap_or(usize::MAX)
}

/// Owners of a pair, in their order.
fn owners(scene: &Scene, pair: &Pair) -> [usize; 2] {
    let mut owners = pair.sides.each_ref().map(|side| place(scene, side.owner));
    owners.sort_unstable();
    owners
}

/// The scene with all pairs that a deck came down to, by their names.
pub fn with_found(mut scene: Scene, names: &[String]) -> Scene {
    let Statement::All(law) = scene.statement.clone() else {
        return scene;
    };
    let is_known = |name: &String| scene.pairs.iter().any(|pair| pair.name == *name);
    let mut names: Vec<String> = names.to_vec();
    names.retain(|name| !is_known(name));
    names.sort_unstable();
    for name in names {
        let Some([a, b]) = sides(&scene, &name) else {
            continue;
        };
        scene.pairs.push(Pair {
            sides: [a, b],
            name,
            law: law.clone(),
            cap: None,
            decay: None,
            origin: Origin::Found,
        });
    }
    scene
}

/// Sides of a pair by its name, which is made of labels.
fn sides(scene: &Scene, name: &str) -> Option<[Side; 2]> {
    let owner = |label: &str| {
        let name = label.split('.').next()?;
        let bodies = scene.bodies.iter().map(|body| (body.name, Some(SKIN)));
        let touchable = |shape: &RigidShape| !matches!(shape, RigidShape::Head(..));
        let rigid = scene.rigid.iter().filter(|rigid| touchable(&rigid.shape));
        let rigid = rigid.map(|rigid| (rigid.name, None));
        let (owner, facets) = bodies.chain(rigid).find(|(owner, _)| *owner == name)?;
        let texture = None;
        Some(Side {
            owner,
            facets,
            texture,
        })
    };
    let dashes = name.match_indices('-');
    let mut found = dashes.filter_map(|(at, _)| {
        let (a, b) = (&name[..at], &name[at + 1..]);
        let (one, mut other) = (owner(a)?, owner(b)?);
        if a == b {
            other.facets = None;
        }
        Some([one, other])
    });
    found.next()
}

/// Holds a run against that of the same scene with pairs.
pub fn compare(findings: &mut Findings, general: &Run, named: &Run) {
    let times: Vec<f64> = named.history.column("time");
    let couples = |run: &Run, row: usize| -> BTreeMap<[usize; 2], Vector> {
        let mut sums = BTreeMap::new();
        for pair in &run.scene.pairs {
            let couple = owners(run.scene, pair);
            if couple[0] == couple[1] {
                continue;
            }
            let letter = if place(run.scene, pair.sides[0].owner) == couple[0] {
                "a"
            } else {
                "b"
            };
            let name = format!("pair.{}.resultant_{letter}", pair.name);
            let force = run.history.vector(row, &name).unwrap_or([f64::NAN; 3]);
            let sum = sums.entry(couple).or_insert([0.0; 3]);
            *sum = plus(*sum, force);
        }
        sums
    };
    let (mut largest, mut off): (f64, f64) = (0.0, 0.0);
    let mut when = 0;
    let mut others = false;
    // Friction remembers the increments, so that runs part where theirs do.
    let common = general.history.column("time").into_iter().zip(&times);
    let common = common.take_while(|(time, other)| (time - *other).abs() < 1e-9 * time.abs());
    for row in 0..common.count() {
        let [one, two] = [couples(general, row), couples(named, row)];
        let all: BTreeSet<_> = one.keys().chain(two.keys()).collect();
        for couple in all {
            let of = |run: &BTreeMap<_, Vector>| run.get(couple).copied().unwrap_or([0.0; 3]);
            let (force, beside) = (of(&one), of(&two));
            largest = largest.max(length(beside)).max(length(force));
            let difference = length(minus(force, beside));
            if difference > off {
                (off, when) = (difference, row + 1);
            }
        }
        others |= has_others(general, named, row);
    }
    if largest == 0.0 {
        return;
    }
    let share = off / largest;
    if others {
        findings.tell("beside pairs, other facets", share);
    } else {
        findings.tell("beside pairs, same facets", share);
        findings.note("pairs", share / SAME, || {
            format!("increment {when}: forces differ by {off:.2e} of {largest:.2e}")
        });
    }
}

/// A scene with its output.
pub struct Run<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Folder.
    pub folder: &'a std::path::Path,
    /// Its history.
    pub history: &'a History,
}

/// Returns true if nodes are pressed that are on no facet of the named pairs.
fn has_others(general: &Run, named: &Run, row: usize) -> bool {
    let fields = |run: &Run| Fields::read(run.folder, run.scene, row + 1);
    let (Ok(Some(general_fields)), Ok(Some(named_fields))) = (fields(general), fields(named))
    else {
        return false;
    };
    let mut largest: f64 = 0.0;
    for grid in general_fields.pairs.iter().flatten().flatten() {
        let pressures = grid.scalars("pressure").unwrap_or_default();
        largest = pressures.iter().fold(largest, |l, p| l.max(*p));
    }
    let pressed = |of: &super::vtu::Grid| -> Vec<Vector> {
        let pressures = of.scalars("pressure").unwrap_or_default();
        let nodes = of.points.iter().zip(pressures);
        let nodes = nodes.filter(|(_, p)| **p > NOTHING * largest);
        nodes.map(|(x, _)| *x).collect()
    };
    let named_at = |couple: [usize; 2], owner: &str| -> Vec<(Vector, f64)> {
        let pairs = named.scene.pairs.iter().zip(&named_fields.pairs);
        let pairs = pairs.filter(|(pair, _)| owners(named.scene, pair) == couple);
        let grids = pairs.flat_map(|(pair, grids)| {
            let sides = pair.sides.iter().zip(grids);
            sides.filter(|(side, _)| side.owner == owner)
        });
        let grids = grids.filter_map(|(_, grid)| grid.as_ref());
        grids
            .flat_map(|grid| {
                let sizes = super::checks::sizes::sizes(grid);
                grid.points.iter().copied().zip(sizes).collect::<Vec<_>>()
            })
            .collect()
    };
    let mut pairs = general.scene.pairs.iter().zip(&general_fields.pairs);
    pairs.any(|(pair, grids)| {
        let couple = owners(general.scene, pair);
        pair.sides.iter().zip(grids).any(|(side, grid)| {
            let Some(grid) = grid else { return false };
            let known = named_at(couple, side.owner);
            pressed(grid).iter().any(|x| {
                let near = |(y, size): &(Vector, f64)| length(minus(*x, *y)) < NEAR * size;
                !known.iter().any(near)
            })
        })
    })
}
