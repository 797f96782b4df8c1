//! From statements to pairs.

use std::collections::{BTreeMap, BTreeSet};

use crate::{
    check::{Draft, of_everything},
    fault::Fault,
    model::{ContactSurface, Enforcement, Initial, Pair},
    path::Path,
};
use striae_law::friction::{Friction, RequiredTextures};
use striae_surface::texture::Paint;

use super::{
    Everything,
    label::{Owner, Part, part},
    name::Names,
    product::{Product, products},
    rule::{Couple, Rule, Rules, Stated},
    scene::{Scene, named, names_nothing},
};

/// Pairs that contact of everything comes down to.
#[derive(Clone, Debug, Default)]
pub struct Lowered {
    /// The pairs.
    pub pairs: Vec<Pair>,
    /// Origin of the friction of each.
    pub origins: Vec<Origin>,
}

/// Origin of the friction of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Origin {
    /// For all.
    All,
    /// In a statement of two surfaces, by its position.
    Between(usize),
}

impl Origin {
    /// The part of the model where it is stated.
    pub fn path(self) -> Path {
        match self {
            Self::All => Path::of("contact").field("friction"),
            Self::Between(at) => {
                let statement = Path::of("contact").field("between").index(at);
                statement.field("friction")
            }
        }
    }
}

impl Everything {
    /// The pairs among what a draft has, besides those that it names; `None` where faults, in
    /// it or found here, leave them unknown.
    pub fn lowered(&self, draft: &Draft<'_>, faults: &mut Vec<Fault>) -> Option<Lowered> {
        let before = faults.len();
        faults.extend(of_everything(self.feature_angle, self.search_distance));
        let rules = self.rules(draft, faults);
        let painted = self.painted(draft, faults);
        let known = draft.bodies.iter().all(|body| body.mesh.is_some())
            && draft
                .rigid_surfaces
                .iter()
                .all(|rigid| rigid.part.is_some())
            && draft.pairs.iter().all(|pair| pair.pair.is_some())
            && draft.ties.iter().all(|tie| tie.part.is_some());
        if !known || faults.len() > before {
            return None;
        }
        let scene = Scene::new(draft, rules, painted)?;
        let found = scene.pairs(self, faults);
        (faults.len() == before).then_some(found)
    }

    /// Statements about what meets.
    fn rules(&self, draft: &Draft<'_>, faults: &mut Vec<Fault>) -> Vec<Rule> {
        let excluded = self.excluded.iter().enumerate();
        let excluded = excluded.map(|(at, (a, b))| (Stated::Exclude(at), a, b.as_ref()));
        let between = self.between.iter().enumerate();
        let between = between.map(|(at, (a, b, _))| (Stated::Between(at), a, Some(b)));
        let mut rule = |(stated, a, b): (Stated, &String, Option<&String>)| {
            let path = stated.path();
            let a = part(draft, a, &path.clone().field("a"), faults);
            let b = b.map(|b| part(draft, b, &path.field("b"), faults));
            let b = match b {
                Some(named) => Some(named?),
                None => None,
            };
            Some(Rule { stated, a: a?, b })
        };
        excluded.chain(between).filter_map(&mut rule).collect()
    }

    /// Surfaces with textures.
    fn painted<'e>(&'e self, draft: &Draft<'_>, faults: &mut Vec<Fault>) -> Vec<(Part, &'e Paint)> {
        let surfaces = self.surfaces.iter().enumerate();
        let painted = surfaces.filter_map(|(at, (label, paint))| {
            let path = Path::of("contact").field("surface").index(at).field("of");
            Some((part(draft, label, &path, faults)?, paint))
        });
        painted.collect()
    }
}

/// Common traits of the couples of a pair: where their friction is stated, and the textures of both
/// owners, by statement.
type Law = (Origin, [Option<usize>; 2]);
/// Couples by owners and law.
type Groups = BTreeMap<(Owner, Owner), Laws>;
/// Couples of two owners by law.
type Laws = BTreeMap<Law, BTreeSet<Couple>>;

impl Scene<'_> {
    /// Pairs for all couples, with the faults of statements that contradict each other or say
    /// nothing.
    fn pairs(&self, all: &Everything, faults: &mut Vec<Fault>) -> Lowered {
        let rules = Rules::new(&self.rules, &self.atoms);
        let textures = self.textures(faults);
        let (mut undecided, mut groups) = (BTreeMap::new(), Groups::new());
        let count = self.atoms.len();
        let couples = (0..count).flat_map(|x| (x..count).map(move |y| (x, y)));
        for couple in couples.filter(|couple| self.is_open(*couple)) {
            let origin = match rules.deciding(couple) {
                Err(found) => {
                    undecided.entry(found.rules).or_insert(found);
                    continue;
                }
                Ok(None) => Origin::All,
                Ok(Some(rule)) => match self.rules[rule].stated {
                    Stated::Exclude(_) => continue,
                    Stated::Between(at) => Origin::Between(at),
                },
            };
            let owners = (self.atoms[couple.0].owner, self.atoms[couple.1].owner);
            let mut painted = [couple.0, couple.1].map(|atom| textures[atom]);
            if owners.0 == owners.1 {
                painted.sort_unstable();
            }
            let laws = groups.entry(owners).or_default();
            laws.entry((origin, painted)).or_default().insert(couple);
        }
        for laws in groups.values_mut() {
            all.leave_out_textures(laws);
        }
        faults.extend(undecided.into_values().map(|found| self.both_name(found)));
        for (at, rule) in self.rules.iter().enumerate() {
            if !rules.couples(at).iter().any(|couple| self.is_open(*couple)) {
                faults.push(names_nothing(rule.stated.path(), rule.stated.told()));
            }
        }
        self.lowered(all, &textures, &groups)
    }

    fn lowered(&self, all: &Everything, textures: &[Option<usize>], groups: &Groups) -> Lowered {
        let parts: Vec<&Part> = named(&self.rules, &self.painted).collect();
        let mut names = Names::new(self.draft, &self.atoms, &parts);
        let mut lowered = Lowered::default();
        let mut sides = Vec::new();
        for (owners, laws) in groups {
            let own = owners.0 == owners.1;
            let found = laws.iter().flat_map(|((origin, painted), couples)| {
                let products = products(couples).into_iter();
                products.map(move |product| (*origin, *painted != [None, None], product))
            });
            for (origin, has_textures, product) in found {
                let (a, b) = match &product {
                    Product::Itself(of) => (of, of),
                    Product::Sides(a, b) if self.atoms[a[0]].owner <= self.atoms[b[0]].owner => {
                        (a, b)
                    }
                    Product::Sides(a, b) => (b, a),
                };
                let paint = |side: &[usize]| {
                    let texture = textures[side[0]].filter(|_| has_textures)?;
                    Some(self.paint(side, texture))
                };
                sides.push([a.clone(), b.clone()]);
                lowered.origins.push(origin);
                lowered.pairs.push(Pair {
                    name: String::new(),
                    a: self.surface(a),
                    b: match &product {
                        Product::Itself(_) => ContactSurface::Itself,
                        Product::Sides(..) => self.surface(b),
                    },
                    textures: match &product {
                        Product::Itself(_) => [paint(a), None],
                        Product::Sides(..) => [paint(a), paint(b)],
                    },
                    friction: all.friction_of(origin).clone(),
                    enforcement: Enforcement::Weighted,
                    search_distance: all.search_distance,
                    initial: if own { Initial::AsMeshed } else { all.initial },
                    interference: None,
                    wear: [0.0; 2],
                    wear_across: 1.0,
                    stabilised: all.stabilised && !own,
                    feature_angle: Some(all.feature_angle),
                });
            }
        }
        for (pair, name) in lowered.pairs.iter_mut().zip(names.pairs(&sides)) {
            pair.name = name;
        }
        lowered
    }
}

impl Everything {
    fn friction_of(&self, origin: Origin) -> &Friction {
        match origin {
            Origin::All => &self.friction,
            Origin::Between(at) => &self.between[at].2,
        }
    }

    /// Leaves out textures that no law needs at the start. Of couples whose law has a statement of
    /// its own they stay for laws of later steps, unless they would divide the pair.
    fn leave_out_textures(&self, laws: &mut Laws) {
        let is_divided = |of: Origin| laws.keys().filter(|(origin, _)| *origin == of).count() > 1;
        let without: BTreeSet<Origin> = laws
            .keys()
            .map(|(origin, _)| *origin)
            .filter(|&origin| !self.needs_textures(origin))
            .filter(|&origin| origin == Origin::All || is_divided(origin))
            .collect();
        for ((origin, painted), couples) in std::mem::take(laws) {
            let painted = match without.contains(&origin) {
                true => [None, None],
                false => painted,
            };
            laws.entry((origin, painted)).or_default().extend(couples);
        }
    }

    fn needs_textures(&self, origin: Origin) -> bool {
        self.friction_of(origin).required_textures() != RequiredTextures::Any
    }
}
