//! Random scenes by kind.
//!
//! The seed modulo the number of kinds picks the kind, the sequence of the seed all
//! else. Seeds below [`FIRST_OF_ALL`] are of the first [`OLDEST`] kinds, so that seeds which
//! notes and other tasks name stay what they were; those from [`FIRST_OF_ITSELF`] on are of bodies
//! that touch themselves. Lengths are in a random unit, about the width of the larger body; moduli too.

mod blade;
mod columns;
mod convex;
mod corner;
mod curved;
mod dynamic;
mod edges;
mod elements;
mod free;
mod itself;
mod loads;
mod matter;
mod parts;
mod plain;
mod rigid;
mod rings;
mod shapes;
mod simple;
mod slab;
mod sliding;
mod solids;
mod speck;
mod symmetry;
mod thin;
mod trilith;

use std::ops::Range;

use super::{random::Random, scene::Scene};

/// Features that the program under test understands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dialect {
    /// Support of the key `initial` of pairs.
    pub initial: Choice,
    /// The method of contact to ask for; the program's default if absent.
    pub enforcement: Option<&'static str>,
}

/// Support of a key by the program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Choice {
    /// The program has the key.
    Known,
    /// The program does not have the key.
    #[default]
    Unknown,
}

/// Makes a scene of one kind.
type Make = fn(&mut Random, Dialect) -> Scene;

/// Name of a kind, and what makes its scenes.
type Kind = (&'static str, Make);

/// Kinds whose pairs have names.
pub const KINDS: [Kind; 43] = [
    ("press", plain::press),
    ("slide", plain::slide),
    ("turn", plain::turn),
    ("reverse", plain::reverse),
    ("slide-off", plain::slide_off),
    ("lift", plain::lift),
    ("gap", plain::gap),
    ("overlap", plain::overlap),
    ("grip", free::grip),
    ("sandwich", free::sandwich),
    ("cap", shapes::cap),
    ("edge", shapes::edge),
    ("oblique", shapes::oblique),
    ("plane", rigid::plane),
    ("ridges", rigid::ridges),
    ("bumps", rigid::bumps),
    ("drop", dynamic::drop),
    ("launch", dynamic::launch),
    ("load", plain::load),
    ("pile", columns::pile),
    ("trilith", trilith::trilith),
    ("patch", columns::patch),
    ("dense", columns::dense),
    ("tied", columns::tied),
    ("tool", sliding::tool),
    ("reversals", sliding::reversals),
    ("far-slip", sliding::far_slip),
    ("decay", sliding::decay),
    ("socket", curved::socket),
    ("groove", curved::groove),
    ("rings", rings::rings),
    ("journal", rings::journal),
    ("bend", thin::bend),
    ("sheet", thin::sheet),
    ("corner", corner::corner),
    ("shared-edge", edges::shared_edge),
    ("half", symmetry::half),
    ("forces", loads::forces),
    ("dead-load", loads::dead_load),
    ("matter", matter::matter),
    ("solids", solids::solids),
    ("speck", speck::speck),
    ("cells", elements::cells),
];

/// Names of the kinds, in their order.
pub fn names() -> impl Iterator<Item = &'static str> {
    KINDS.iter().chain(&itself::ITSELF).map(|kind| kind.0)
}

/// The seed from which on all kinds with names for what touches take turns.
pub const FIRST_OF_ALL: u64 = 100_000;
/// The seed from which on bodies that touch themselves, and nets of bodies, take turns.
pub const FIRST_OF_ITSELF: u64 = 200_000;
/// Number of kinds that take turns below.
const OLDEST: usize = 19;

/// Seeds and the kinds that take turns in them.
const TURNS: [(Range<u64>, &[Kind]); 3] = [
    (0..FIRST_OF_ALL, KINDS.split_at(OLDEST).0),
    (FIRST_OF_ALL..FIRST_OF_ITSELF, &KINDS),
    (FIRST_OF_ITSELF..u64::MAX, &itself::ITSELF),
];

fn entry(seed: u64) -> Kind {
    let turns = TURNS.iter().find(|(seeds, _)| seeds.contains(&seed));
    let (_, kinds) = turns.unwrap_or(&TURNS[2]);
    kinds[(seed % kinds.len() as u64) as usize]
}

/// Seeds that a kind takes turns in.
pub fn seeds_of(name: &str) -> Range<u64> {
    let has = |kinds: &[Kind]| kinds.iter().any(|kind| kind.0 == name);
    let mut turns = TURNS.iter().filter(|(_, kinds)| has(kinds));
    let from = turns.next().map_or(0, |(seeds, _)| seeds.start);
    let to = TURNS.iter().rev().find(|(_, kinds)| has(kinds));
    from..to.map_or(0, |(seeds, _)| seeds.end)
}

/// Name of the kind of a seed.
pub fn kind_of(seed: u64) -> &'static str {
    entry(seed).0
}

/// The scene of a seed.
pub fn scene(seed: u64, dialect: Dialect) -> Scene {
    let (kind, make) = entry(seed);
    let mut random = Random::new(seed);
    Scene {
        seed,
        kind,
        enforcement: dialect.enforcement,
        ..make(&mut random, dialect)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::{checks, claim::Quantity, deck, grid, output::Fields, scene::Shape, vtu};

    #[test]
    fn the_same_seed_gives_the_same_deck() {
        let new = FIRST_OF_ITSELF..FIRST_OF_ITSELF + 33;
        for seed in (0..90).chain(FIRST_OF_ALL..FIRST_OF_ALL + 90).chain(new) {
            let [one, two] = [0, 1].map(|_| deck::text(&scene(seed, Dialect::default())));
            assert_eq!(one, two);
        }
        let [one, other] = [0, 19].map(|seed| deck::text(&scene(seed, Dialect::default())));
        assert_ne!(one, other);
    }

    #[test]
    fn decks_are_toml_and_meshes_small() {
        let new = FIRST_OF_ITSELF..FIRST_OF_ITSELF + 110;
        for seed in (0..380).chain(FIRST_OF_ALL..FIRST_OF_ALL + 430).chain(new) {
            let scene = scene(seed, Dialect::default());
            let text = deck::text(&scene);
            let parsed: Result<toml::Table, _> = text.parse();
            assert!(parsed.is_ok(), "{seed}: {parsed:?}\n{text}");
            let count = |shape: &Shape| match shape {
                Shape::Block(block) => block.divisions.iter().product::<usize>(),
                Shape::Cap(_) => 0,
                Shape::Grid(grid) => grid.cells.len(),
            };
            let total: usize = scene.bodies.iter().map(|body| count(&body.shape)).sum();
            assert!(total <= 1500, "{seed}: {total} elements");
        }
    }

    #[test]
    fn claims_are_about_steps_pairs_and_bodies_of_their_scene() {
        for seed in FIRST_OF_ALL..FIRST_OF_ALL + 430 {
            let scene = scene(seed, Dialect::default());
            let names: Vec<&str> = scene.bodies.iter().map(|body| body.name).collect();
            for claim in &scene.claims {
                let about = |pair: usize, owner: &str| {
                    let sides = &scene.pairs[pair].sides;
                    assert!(sides.iter().any(|side| side.owner == owner), "{seed}");
                    assert!(names.contains(&owner), "{seed}: {owner}");
                };
                assert!(claim.step < scene.steps.len(), "{seed}");
                assert!(claim.low < claim.high, "{seed}: {claim:?}");
                match &claim.quantity {
                    Quantity::Force(pair, owner, _)
                    | Quantity::Beside(pair, owner, _)
                    | Quantity::Since(pair, owner, ..) => about(*pair, owner),
                    Quantity::Lever(pairs, owner, _) => {
                        pairs.iter().for_each(|&pair| about(pair, owner));
                    }
                    _ => {}
                }
                let beside = matches!(claim.quantity, Quantity::Beside(..));
                assert!(!beside || scene.reference.is_some(), "{seed}");
            }
        }
    }

    #[test]
    fn seeds_of_the_oldest_kinds_stay_what_they_were() {
        assert_eq!([17, 18, 19].map(kind_of), ["launch", "load", "press"]);
        assert_eq!(seeds_of("load"), 0..FIRST_OF_ITSELF);
        assert_eq!(seeds_of("pile"), FIRST_OF_ALL..FIRST_OF_ITSELF);
        assert_eq!(seeds_of("bag").start, FIRST_OF_ITSELF);
        let all: std::collections::BTreeSet<&str> = (FIRST_OF_ALL
            ..FIRST_OF_ALL + KINDS.len() as u64)
            .map(kind_of)
            .collect();
        assert_eq!(all.len(), KINDS.len());
    }

    #[test]
    fn bodies_that_touch_themselves_do_not_cross_at_rest() {
        for seed in FIRST_OF_ITSELF..FIRST_OF_ITSELF + 220 {
            let scene = scene(seed, Dialect::default());
            let bodies = scene.bodies.iter().map(|body| {
                let Shape::Grid(grid) = &body.shape else {
                    panic!("{seed}: {} is no grid", body.name);
                };
                let corners = |cell: &Vec<usize>| {
                    let corners = <[usize; 8]>::try_from(&cell[..]).unwrap();
                    grid::volume(&corners.map(|node| grid.positions[node]))
                };
                assert!(grid.cells.iter().all(|cell| corners(cell) > 0.0), "{seed}");
                let grid = vtu::Grid::plain(grid.positions.clone(), grid.cells.clone());
                (body.name, grid)
            });
            let fields = Fields {
                bodies: bodies.collect(),
                pairs: Vec::new(),
            };
            let found = checks::crossings(&fields);
            assert!(
                found.failed().next().is_none(),
                "{seed} {}: {found:?}",
                scene.kind
            );
            assert_eq!(
                found.worst["crossing"].measure, 0.0,
                "{seed} {}: {found:?}",
                scene.kind
            );
        }
    }
}
