//! Pads on springs: closed forms, balance of forces, contact that is met within an increment.

use nalgebra::{DMatrix, DVector};
use striae_law::friction::Friction;
use striae_mesh::{NodeId, Vec3};

use crate::{
    component::{Contact, Evaluated, Imposed, Increment, Opponent, Pair, State, Surface},
    placement::Placement,
    side::Side,
    unknowns::Status,
};

/// Modulus of the springs over their length.
pub(super) const STIFFNESS: f64 = 100.0;

/// Points and quadrilaterals of a grid over `[0, size]^2`, from below or above.
pub(super) fn grid(
    n: usize,
    size: f64,
    first: usize,
    looks_up: bool,
) -> (Vec<Vec3>, Vec<[NodeId; 4]>) {
    let at = |i: usize| size * i as f64 / n as f64;
    let points = (0..=n).flat_map(|j| (0..=n).map(move |i| Vec3::new(at(i), at(j), 0.0)));
    let node = |i: usize, j: usize| NodeId::new(first + j * (n + 1) + i);
    let facet = |i: usize, j: usize| {
        let [a, b, c, d] =
            [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| node(i, j));
        if looks_up { [a, b, c, d] } else { [a, d, c, b] }
    };
    let facets = (0..n).flat_map(|j| (0..n).map(move |i| facet(i, j)));
    (points.collect(), facets.collect())
}

/// Springs at all nodes, by areas of their own.
pub(super) struct Springs {
    pub(super) anchors: Vec<Vec3>,
    pub(super) stiffness: Vec<f64>,
}

impl Springs {
    /// Springs of a grid of quadrilaterals, of one stiffness per area.
    fn new(points: &[Vec3], facets: &[[NodeId; 4]], area: f64) -> Self {
        let mut stiffness = vec![0.0; points.len()];
        for node in facets.iter().flatten() {
            stiffness[node.index()] += 0.25 * area * STIFFNESS;
        }
        let anchors = points.to_vec();
        Self { anchors, stiffness }
    }

    /// Newton's method from the start of an increment.
    pub(super) fn solve(&self, mut increment: Increment) -> (Increment, Evaluated) {
        let (mut x, mut t) = (increment.positions().to_vec(), increment.tractions());
        let mut evaluated = increment.evaluate(&x, &t, None).unwrap();
        for iteration in 0..40 {
            let mut residual = DVector::from_vec(evaluated.residual.clone());
            let mut tangent = DMatrix::zeros(residual.len(), residual.len());
            let entries = evaluated.rows.iter().zip(&evaluated.columns);
            for ((&row, &column), value) in entries.zip(&evaluated.values) {
                tangent[(row, column)] += value;
            }
            for (node, k) in self.stiffness.iter().enumerate() {
                for c in 0..3 {
                    tangent[(3 * node + c, 3 * node + c)] += k;
                    residual[3 * node + c] += k * (x[node][c] - self.anchors[node][c]);
                }
            }
            if iteration > 0 && evaluated.norm < 1e-12 && residual.amax() < 1e-12 {
                let missed = increment.missed(&evaluated).unwrap();
                if missed.is_empty() {
                    return (increment, evaluated);
                }
                increment = increment.reselected(&evaluated).unwrap();
                t = increment.tractions();
                evaluated = increment.evaluate(&x, &t, None).unwrap();
                continue;
            }
            let change = tangent.lu().solve(&residual).expect("a regular tangent");
            let (positions, tractions) = change.as_slice().split_at(3 * x.len());
            for (x, change) in x.iter_mut().zip(positions.chunks(3)) {
                *x -= Vec3::from_column_slice(change);
            }
            t.iter_mut().zip(tractions).for_each(|(t, d)| *t -= d);
            evaluated = increment.evaluate(&x, &t, Some(&evaluated)).unwrap();
        }
        panic!("no convergence: {}", evaluated.norm);
    }
}

fn pad(n: usize, friction: Friction) -> (Contact, Springs) {
    let (points, facets) = grid(n, 1.0, 0, false);
    let springs = Springs::new(&points, &facets, 1.0 / (n * n) as f64);
    let pair = Pair {
        name: "sole".into(),
        a: Surface {
            facets,
            youngs_modulus: STIFFNESS,
            texture: None,
        },
        b: Opponent::Plane {
            point: Vec3::zeros(),
            normal: Vec3::z(),
            texture: None,
        },
        friction,
        search_distance: None,
    };
    (Contact::new(points, &[pair]).unwrap(), springs)
}

/// The pad on a floor that has moved by a shift.
fn moved(contact: &Contact, springs: &Springs, state: &State, shift: Vec3) -> (State, Evaluated) {
    let imposed = Imposed {
        placements: vec![Placement::shifted(shift)],
        ..Imposed::default()
    };
    let begun = contact.begin(state, &imposed).unwrap();
    let (increment, evaluated) = springs.solve(begun);
    (increment.accept(&evaluated).unwrap(), evaluated)
}

#[test]
fn a_pad_on_springs_sticks_and_slips_as_in_closed_form() {
    let (contact, springs) = pad(3, Friction::coulomb(0.3).unwrap());
    let (d, u) = (0.01, 0.001);
    let start = contact.untouched();
    let (pressed, evaluated) = moved(&contact, &springs, &start, Vec3::new(0.0, 0.0, d));
    let [force, moment] = evaluated.resultant(0, Side::A);
    assert!((force - Vec3::new(0.0, 0.0, STIFFNESS * d)).norm() < 1e-12);
    assert!((moment - Vec3::new(0.5, -0.5, 0.0) * STIFFNESS * d).norm() < 1e-12);
    let (stuck, evaluated) = moved(&contact, &springs, &pressed, Vec3::new(u, 0.0, d));
    let [force, _] = evaluated.resultant(0, Side::A);
    assert!((force - Vec3::new(u, 0.0, d) * STIFFNESS).norm() < 1e-12);
    assert!(
        evaluated
            .nodes(0, Side::A)
            .iter()
            .all(|node| node.status == Status::Stick)
    );
    let (_, evaluated) = moved(&contact, &springs, &stuck, Vec3::new(10.0 * u, 0.0, d));
    let [force, _] = evaluated.resultant(0, Side::A);
    assert!((force - Vec3::new(0.3 * d, 0.0, d) * STIFFNESS).norm() < 1e-12);
    let slip = 10.0 * u - 0.3 * d;
    for node in evaluated.nodes(0, Side::A) {
        assert_eq!(node.status, Status::Slip);
        assert!((node.pressure - STIFFNESS * d).abs() < 1e-11);
        // From where the node has stuck.
        assert!((node.slip.norm() - slip).abs() < 1e-12);
    }
    assert!((evaluated.dissipated(0) - 0.3 * STIFFNESS * d * slip).abs() < 1e-12);
    assert_eq!(
        evaluated.resultant(0, Side::B).map(|v| -v),
        evaluated.resultant(0, Side::A)
    );
}

#[test]
fn contact_that_is_met_within_an_increment_takes_part() {
    let (contact, springs) = pad(2, Friction::frictionless());
    let (apart, evaluated) = moved(&contact, &springs, &contact.untouched(), Vec3::z() * -3.0);
    assert_eq!(evaluated.resultant(0, Side::A)[0], Vec3::zeros());
    let (state, evaluated) = moved(&contact, &springs, &apart, Vec3::z() * 0.02);
    let force = evaluated.resultant(0, Side::A)[0];
    assert!((force.z - 0.02 * STIFFNESS).abs() < 1e-12, "{force}");
    assert!(state.pairs()[0].kept[0].iter().all(|kept| *kept));
}

/// Two pads, each on springs, of meshes that do not match.
pub(super) fn pads(friction: Friction) -> (Contact, Springs) {
    let (mut points, lower) = grid(3, 1.0, 0, true);
    let (upper_points, upper) = grid(2, 0.9, points.len(), false);
    let mut springs = Springs::new(&points, &lower, 1.0 / 9.0);
    let own = upper
        .iter()
        .map(|facet| facet.map(|node| NodeId::new(node.index() - points.len())));
    let on_top = Springs::new(&upper_points, &own.collect::<Vec<_>>(), 0.81 / 4.0);
    let shift = Vec3::new(0.031, 0.043, 0.0);
    // Curved, turned and a little apart from each other's lines.
    let bent = |x: Vec3| x + Vec3::z() * 0.05 * (x.x * x.x + 0.5 * x.y + 0.3 * x.x * x.y);
    points.iter_mut().for_each(|x| *x = bent(*x));
    points.extend(upper_points.iter().map(|x| bent(x + shift)));
    springs.anchors.clone_from(&points);
    springs.stiffness.extend(on_top.stiffness);
    let surface = |facets, modulus| Surface {
        facets,
        youngs_modulus: modulus,
        texture: None,
    };
    let pair = Pair {
        name: "pads".into(),
        a: surface(upper, 2.0 * STIFFNESS),
        b: Opponent::Deformable(surface(lower, STIFFNESS)),
        friction,
        search_distance: None,
    };
    (Contact::new(points, &[pair]).unwrap(), springs)
}

/// The pads after the anchors of the upper one have moved, from a state.
pub(super) fn dragged(
    contact: &Contact,
    springs: &mut Springs,
    state: &State,
    way: Vec3,
) -> (Increment, Evaluated) {
    springs.anchors[16..].iter_mut().for_each(|x| *x += way);
    springs.solve(contact.begin(state, &Imposed::default()).unwrap())
}

#[test]
fn forces_of_two_surfaces_balance() {
    let (contact, mut springs) = pads(Friction::coulomb(0.2).unwrap());
    let start = contact.untouched();
    let (increment, pressed) = dragged(&contact, &mut springs, &start, Vec3::z() * -0.02);
    let state = increment.accept(&pressed).unwrap();
    let (_, slid) = dragged(&contact, &mut springs, &state, Vec3::new(0.03, 0.01, 0.0));
    for evaluated in [pressed, slid] {
        let [a, b] = Side::BOTH.map(|side| evaluated.resultant(0, side)[0]);
        assert!(a.z > 0.5, "{a}");
        assert!((a + b).norm() < 1e-14 * a.norm());
        let nodes = (0..25).map(|node| evaluated.force(node)).sum::<Vec3>();
        assert!(nodes.norm() < 1e-14 * a.norm());
    }
}
