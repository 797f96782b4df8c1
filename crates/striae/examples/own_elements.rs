//! Contact for elements of one's own: a pad of springs that is pressed onto a floor and dragged.
//!
//! In closed form the pad sticks with `tau = k u` up to `tau = mu p`, with `p = k d`.

mod plot;

use striae::{
    contact::{
        component::{Contact, Evaluated, Faults, Imposed, Opponent, Pair, State, Surface},
        placement::Placement,
        side::Side,
    },
    mesh::{NodeId, Vec3},
    nalgebra::{DMatrix, DVector},
    prelude::Friction,
};
use striae_figure::{Axis, Content, Panel, Series};

/// Stiffness of the springs per area, and the coefficient of friction.
const K: f64 = 1e6;
const MU: f64 = 0.3;
/// Quadrilaterals along a side of the pad, which is 1 wide.
const N: usize = 4;

/// Nodes of the underside and its facets, which look down.
fn underside() -> (Vec<Vec3>, Vec<[NodeId; 4]>) {
    let at = |i: usize| i as f64 / N as f64;
    let points = (0..=N).flat_map(|j| (0..=N).map(move |i| Vec3::new(at(i), at(j), 0.0)));
    let node = |i: usize, j: usize| NodeId::new(j * (N + 1) + i);
    let facet = |i, j| {
        [
            node(i, j),
            node(i, j + 1),
            node(i + 1, j + 1),
            node(i + 1, j),
        ]
    };
    let facets = (0..N).flat_map(|j| (0..N).map(move |i| facet(i, j)));
    (points.collect(), facets.collect())
}

/// One increment, in which the floor is shifted; `springs` are stiffnesses of the nodes.
fn solved(
    contact: &Contact,
    state: &State,
    springs: &[f64],
    shift: Vec3,
) -> Result<(State, Evaluated), Faults> {
    let anchors = contact.untouched().positions().to_vec();
    let floor = Imposed {
        placements: vec![Placement::shifted(shift)],
        ..Imposed::default()
    };
    let increment = contact.begin(state, &floor)?;
    let (mut x, mut tractions) = (increment.positions().to_vec(), increment.tractions());
    let mut found = increment.evaluate(&x, &tractions, None)?;
    loop {
        // Contact, and one's own elements: here springs at the nodes.
        let mut residual = DVector::from_column_slice(&found.residual);
        let mut tangent = DMatrix::zeros(residual.len(), residual.len());
        for (at, value) in found.values.iter().enumerate() {
            tangent[(found.rows[at], found.columns[at])] += value;
        }
        for (row, k) in springs.iter().flat_map(|k| [k; 3]).enumerate() {
            residual[row] += k * (x[row / 3] - anchors[row / 3])[row % 3];
            tangent[(row, row)] += k;
        }
        if found.number > 0 && found.norm < 1e-12 && residual.amax() < 1e-13 * K {
            return Ok((increment.accept(&found)?, found));
        }
        let change = tangent
            .lu()
            .solve(&-residual)
            .expect("springs hold every node");
        let (by_node, by_traction) = change.as_slice().split_at(3 * x.len());
        for (x, change) in x.iter_mut().zip(by_node.chunks(3)) {
            *x += Vec3::from_column_slice(change);
        }
        for (traction, change) in tractions.iter_mut().zip(by_traction) {
            *traction += change;
        }
        found = increment.evaluate(&x, &tractions, Some(&found))?;
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (points, facets) = underside();
    let mut springs = vec![0.0; points.len()];
    for node in facets.iter().flatten() {
        springs[node.index()] += 0.25 * K / (N * N) as f64;
    }
    let sole = Pair {
        name: "sole".into(),
        a: Surface {
            facets,
            youngs_modulus: K,
            texture: None,
        },
        b: Opponent::Plane {
            point: Vec3::zeros(),
            normal: Vec3::z(),
            texture: None,
        },
        friction: Friction::coulomb(MU)?,
        search_distance: None,
    };
    let contact = Contact::new(points, &[sole])?;
    let (pressed, d) = (contact.untouched(), 1e-3);
    let (mut state, _) = solved(&contact, &pressed, &springs, Vec3::z() * d)?;
    let mut drags = vec![[0.0, 0.0]];
    for u in [1e-4, 2e-4, 3e-4, 4e-4] {
        let (next, found) = solved(&contact, &state, &springs, Vec3::new(u, 0.0, d))?;
        let [force, _] = found.resultant(0, Side::A);
        println!(
            "u = {u:.0e}: pressed with {:.3}, dragged with {:.3}",
            force.z, force.x
        );
        assert!((force - Vec3::new((K * u).min(MU * K * d), 0.0, K * d)).norm() < 1e-9 * K * d);
        drags.push([1e3 * u, force.x]);
        state = next;
    }
    let panel = Panel::new(Axis::linear("way", "mm"), Axis::linear("drag", "N"))
        .with(Series::new("pad of springs", Content::line(drags)));
    plot::plot("own-elements", panel)
}
