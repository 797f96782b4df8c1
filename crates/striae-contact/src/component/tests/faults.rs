//! Wrong uses, and the words that meet them.

use striae_law::friction::{Evolution, Friction, RateAndState, SlipRule, StateDependence};
use striae_mesh::{NodeId, Vec3};

use super::springs::grid;
use crate::component::{Contact, Imposed, Opponent, Pair, Surface};

fn pair(facets: Vec<[NodeId; 4]>) -> Pair {
    Pair {
        name: "sole".into(),
        a: Surface {
            facets,
            youngs_modulus: 1.0,
            texture: None,
        },
        b: Opponent::Plane {
            point: Vec3::zeros(),
            normal: Vec3::z(),
            texture: None,
        },
        friction: Friction::frictionless(),
        search_distance: None,
    }
}

#[test]
fn surfaces_that_are_inside_out_are_refused() {
    let (points, facets) = grid(2, 1.0, 0, false);
    let turned = facets.iter().map(|[a, b, c, d]| [*a, *d, *c, *b]);
    let turned = pair(turned.collect());
    let told = "pairs[0]: its sides face away from each other, so they cannot touch: at node 0 of side `a` their normals are 0 degrees apart, and 180 would be face to face; order the corners of each facet counter-clockwise seen from outside";
    assert_eq!(refused(&points, turned.clone()), told);
    assert!(Contact::new(points.clone(), &[pair(facets)]).is_ok());
    // From afar a motion may turn it.
    let afar: Vec<Vec3> = points.iter().map(|x| x + 9.0 * Vec3::z()).collect();
    assert!(Contact::new(afar, &[turned]).is_ok());
}

/// A pair whose friction depends on rate and state.
fn creeping(facets: Vec<[NodeId; 4]>) -> Pair {
    let law = RateAndState {
        evolution: Evolution::Ageing,
        direct_effect: 0.01,
        evolution_effect: 0.015,
        slip_rate: 1e-6,
        slip_distance: 1e-5,
        state: 10.0,
    };
    let law = StateDependence::rate_and_state(law).unwrap();
    let friction = Friction::coulomb(0.6).unwrap().with_state(law);
    Pair {
        friction,
        ..pair(facets)
    }
}

fn refused(points: &[Vec3], pair: Pair) -> String {
    let found = Contact::new(points.to_vec(), &[pair]);
    found.expect_err("a fault").to_string()
}

#[test]
fn faults_of_pairs_are_told_with_their_place() {
    let (points, facets) = grid(1, 1.0, 0, false);
    let node = |corner: usize, number: usize| {
        let mut facets = facets.clone();
        facets[0][corner] = NodeId::new(number);
        pair(facets)
    };
    let missing = "pairs[0].a.facets: facet 0 has node 9, but there are 4 nodes; they count from 0";
    assert_eq!(refused(&points, node(1, 9)), missing);
    let degenerate = "pairs[0].a.facets: facet 0 is degenerate: it needs three or four corners that differ, in order around it, and an area";
    assert_eq!(refused(&points, node(1, 0)), degenerate);
    let crossed = pair(vec![[0, 1, 2, 3].map(NodeId::new)]);
    assert_eq!(refused(&points, crossed), degenerate);
    let flat = vec![Vec3::zeros(); 4];
    assert_eq!(refused(&flat, pair(facets.clone())), degenerate);
    let mut twice = facets.clone();
    let [a, b, c, d] = facets[0];
    twice.push([c, d, a, b]);
    let repeated = "pairs[0].a.facets: facet 1 has the corners of facet 0; give each facet once";
    assert_eq!(refused(&points, pair(twice)), repeated);
    let mut folded = facets.clone();
    folded.push([a, d, c, b]);
    let told = "pairs[0].a.facets: the facets at node 0 face opposite ways; order the corners of each counter-clockwise seen from outside";
    assert_eq!(refused(&points, pair(folded)), told);
    assert_eq!(
        refused(&points, pair(Vec::new())),
        "pairs[0].a.facets: there is none; a surface needs at least one"
    );
    let soft = Pair {
        a: Surface {
            youngs_modulus: 0.0,
            ..pair(facets.clone()).a
        },
        ..pair(facets.clone())
    };
    assert_eq!(
        refused(&points, soft),
        "pairs[0].a.youngs_modulus: it must be positive, but is 0"
    );
    let itself = Pair {
        b: Opponent::Deformable(pair(facets.clone()).a),
        ..pair(facets.clone())
    };
    let told = "pairs[0].b.facets: node 0 is on side `a`, too; the sides of a pair must have no node in common";
    assert_eq!(refused(&points, itself), told);
    let bare = Pair {
        friction: Friction::orthotropic(0.1, 0.4, SlipRule::Opposing).unwrap(),
        ..pair(vec![[a, b, c, d]])
    };
    let told = "pairs[0].friction: the friction law needs a texture on one side, but 0 are given";
    assert_eq!(refused(&points, bare), told);
}

#[test]
fn faults_of_increments_are_told_with_their_place() {
    let (points, facets) = grid(1, 1.0, 0, false);
    let contact = Contact::new(points.clone(), &[pair(facets)]).unwrap();
    let state = contact.untouched();
    let begun = |imposed: Imposed| {
        contact
            .begin(&state, &imposed)
            .expect_err("a fault")
            .to_string()
    };
    let few = Imposed {
        prescribed: vec![true; 4],
        ..Imposed::default()
    };
    assert_eq!(begun(few), "prescribed: 4 are given, but 12 are needed");
    let still = Imposed {
        duration: 0.0,
        ..Imposed::default()
    };
    assert_eq!(begun(still), "duration: it must be positive, but is 0");
    let creeping = Contact::new(points.clone(), &[creeping(grid(1, 1.0, 0, false).1)]).unwrap();
    let endless = creeping.begin(&creeping.untouched(), &Imposed::default());
    assert_eq!(
        endless.expect_err("a fault").to_string(),
        "duration: friction of pairs[0] has a state or a factor that depends on slip: state how long the increment takes"
    );
    let increment = contact.begin(&state, &Imposed::default()).unwrap();
    let evaluated = |x: &[Vec3], t: &[f64]| {
        let found = increment.evaluate(x, t, None);
        found.expect_err("a fault").to_string()
    };
    let own = increment.tractions();
    assert_eq!(
        evaluated(&points[1..], &own),
        "positions: 3 are given, but 4 are needed"
    );
    assert_eq!(
        evaluated(&points, &own[1..]),
        "tractions: 11 are given, but 12 are needed"
    );
    let mut lost = points.clone();
    lost[2].y = f64::NAN;
    assert_eq!(evaluated(&lost, &own), "positions: row 2 is not finite");
    let flat = vec![Vec3::x(); 4];
    let told = "pairs[0].a.facets: facet 0 is degenerate: it needs three or four corners that differ, in order around it, and an area";
    assert_eq!(evaluated(&flat, &own), told);
}

#[test]
fn contact_can_be_shared_by_threads() {
    fn is_shared<T: Send + Sync>() {}
    is_shared::<Contact>();
    is_shared::<super::super::Increment>();
    is_shared::<super::super::Evaluated>();
}
