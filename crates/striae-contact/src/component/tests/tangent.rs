//! The tangent is the derivative of the residual.

use nalgebra::{DMatrix, DVector};
use striae_law::friction::Friction;
use striae_mesh::Vec3;
use striae_verify::assert_derivative;

use super::springs::{dragged, pads};
use crate::{
    component::{Evaluated, Increment},
    side::Side,
    unknowns::Status,
};

/// Lengths and tractions over which contact changes little enough to keep its status.
const LENGTH: f64 = 1e-3;
const STRESS: f64 = 0.05;

fn residual_at(
    increment: &Increment,
    base: &Evaluated,
    from: &[f64],
    z: &DVector<f64>,
) -> Evaluated {
    let count = 3 * base.positions().len();
    let x = base.positions().iter().enumerate();
    let x = x.map(|(node, x)| x + Vec3::from_fn(|c, _| LENGTH * z[3 * node + c]));
    let tractions = from
        .iter()
        .enumerate()
        .map(|(at, t)| t + STRESS * z[count + at]);
    let tractions: Vec<f64> = tractions.collect();
    increment
        .evaluate(&x.collect::<Vec<_>>(), &tractions, Some(base))
        .unwrap()
}

fn dense(evaluated: &Evaluated) -> DMatrix<f64> {
    let count = evaluated.residual.len();
    let mut tangent = DMatrix::zeros(count, count);
    let entries = evaluated.rows.iter().zip(&evaluated.columns);
    for ((&row, &column), value) in entries.zip(&evaluated.values) {
        tangent[(row, column)] += value;
    }
    tangent
}

#[test]
fn every_place_has_one_entry() {
    let (contact, mut springs) = pads(Friction::coulomb(0.3).unwrap());
    let start = contact.untouched();
    let (_, pressed) = dragged(&contact, &mut springs, &start, Vec3::z() * -0.05);
    let places: Vec<_> = pressed.rows.iter().zip(&pressed.columns).collect();
    assert!(!places.is_empty() && places.len() == pressed.values.len());
    assert!(places.is_sorted_by(|before, after| before < after));
}

/// Pads after a press and a drag by `way`, whose nodes all have a status.
fn holds_after(way: Vec3, status: Status) {
    let (contact, mut springs) = pads(Friction::coulomb(0.3).unwrap());
    let start = contact.untouched();
    let (increment, pressed) = dragged(&contact, &mut springs, &start, Vec3::z() * -0.05);
    let state = increment.accept(&pressed).unwrap();
    let (increment, base) = dragged(&contact, &mut springs, &state, way);
    for (_, side, _) in increment.kept() {
        assert!(base.nodes(0, side).iter().any(|node| node.status == status));
    }
    assert!(
        base.nodes(0, Side::A)
            .iter()
            .all(|node| node.status == status)
    );
    let tractions = tractions_of(&increment, &base);
    let count = 3 * base.positions().len();
    let unit = |at: usize| if at < count { LENGTH } else { STRESS };
    assert_derivative(
        |z| {
            let found = residual_at(&increment, &base, &tractions, z);
            DVector::from_vec(found.residual)
        },
        |z| {
            let mut tangent = dense(&residual_at(&increment, &base, &tractions, z));
            for at in 0..tangent.ncols() {
                tangent.column_mut(at).scale_mut(unit(at));
            }
            tangent
        },
        &DVector::zeros(increment.unknowns()),
    );
}

/// The traction unknowns at which contact was evaluated.
fn tractions_of(increment: &Increment, evaluated: &Evaluated) -> Vec<f64> {
    let state = increment.accept(evaluated).unwrap();
    let tractions = &state.pairs()[0].tractions.nodes;
    let nodes = Side::BOTH.map(|side| evaluated.contact.nodes(0, side));
    let of = |(_, side, node): (usize, Side, _)| {
        let at = nodes[side].iter().position(|known| *known == node).unwrap();
        tractions[side][at]
    };
    increment.kept().into_iter().flat_map(of).collect()
}

#[test]
fn the_tangent_of_sticking_contact_is_the_derivative_of_its_residual() {
    holds_after(Vec3::new(1e-3, 5e-4, 0.0), Status::Stick);
}

#[test]
fn the_tangent_of_slipping_contact_is_the_derivative_of_its_residual() {
    holds_after(Vec3::new(0.05, 0.03, 0.0), Status::Slip);
}
