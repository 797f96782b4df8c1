//! Selection of the nodes of a pair that carry traction unknowns, and of the dependence of the
//! others on them.
//!
//! Roles are chosen at the start of an increment, see [`crate::roles`], from the
//! configuration it starts from and, where that shows too little, the one that it leads to.
//! They are frozen in the increment, as is the transfer to nodes that are not kept, see
//! `transfer`. Of facets that are paired in both configurations the mean
//! overlap counts.

mod approach;
mod gathered;
mod sides;
mod traction_field;

pub use approach::approach;
pub use traction_field::{Selection, deepest};

use crate::{
    configuration::Configuration,
    pairing::{Scope, compliances},
    partner::partners,
    side::Side,
    unknown::Prescribed,
};
use gathered::Gathered;

/// Nodes that are kept, by side.
pub type Kept = [Vec<bool>; 2];

/// Origin of the roles of nodes.
#[derive(Clone, Copy)]
enum Roles<'a> {
    /// Chosen, with an advantage for nodes that were kept in the last increment.
    After(&'a Kept),
    /// Given by the nodes that are kept.
    Given(&'a Kept),
}

impl Selection {
    /// Chooses the kept nodes from the configuration that an increment starts from and, if
    /// it is known, the one that it is predicted to lead to; `before` are those of the last
    /// increment.
    pub fn new(
        start: &Configuration,
        predicted: Option<&Configuration>,
        before: &Kept,
        prescribed: &Prescribed,
    ) -> Self {
        Self::in_roles(start, predicted, Roles::After(before), prescribed)
    }

    /// The traction field of given kept nodes in these configurations.
    pub fn with_kept(
        start: &Configuration,
        predicted: Option<&Configuration>,
        kept: &Kept,
        prescribed: &Prescribed,
    ) -> Self {
        Self::in_roles(start, predicted, Roles::Given(kept), prescribed)
    }

    /// The field of the nodes that remain to a pair in these configurations, with what else this one
    /// has.
    pub fn keeping(
        &self,
        start: &Configuration,
        predicted: Option<&Configuration>,
        kept: &Kept,
        prescribed: &Prescribed,
    ) -> Self {
        Self {
            offsets: self.offsets.clone(),
            worn: self.worn.clone(),
            fitted: self.fitted.clone(),
            has_yielded: !kept.iter().flatten().any(|is_kept| *is_kept),
            ..Self::with_kept(start, predicted, kept, prescribed)
        }
    }

    fn in_roles(
        start: &Configuration,
        predicted: Option<&Configuration>,
        roles: Roles,
        prescribed: &Prescribed,
    ) -> Self {
        let compliances = compliances(start);
        let depth = predicted.map_or(0.0, |predicted| approach(start, predicted));
        let depth = depth + start.worn;
        let positions = |side: Side| start.sides[side].as_ref().map(|side| side.x.clone());
        let positions = Side::BOTH.map(|side| positions(side).unwrap_or_default());
        let scope = Scope {
            compliances: &compliances,
            depth,
            start: Some(&positions),
        };
        let mut gathered = Gathered::new(start, scope);
        if let Some(predicted) = predicted {
            gathered.add(Gathered::new(predicted, scope));
        }
        let mut basis = gathered.basis(start, roles, prescribed);
        for (side, count) in Side::BOTH.into_iter().zip(start.pair.carriers()) {
            basis.index[side].resize(count, None);
            basis.rows[side].resize(count, Vec::new());
            basis.friction_rows[side].resize(count, Vec::new());
        }
        let partners = partners(start, &basis);
        Self {
            basis,
            compliances,
            depth,
            start: positions,
            partners,
            offsets: [Vec::new(), Vec::new()],
            worn: [Vec::new(), Vec::new()],
            slip_freedoms: Vec::new(),
            following: Vec::new(),
            fitted: None,
            has_yielded: false,
        }
    }
}
