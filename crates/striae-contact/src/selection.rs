//! Roles of the nodes, chosen once an increment from the converged state.
//!
//! Every covered node of a deformable side is *kinematic* (collocated
//! impenetrability and friction) or carries *traction* only (collocated balance
//! with the opposing field). A candidate becomes kinematic iff the opposing
//! weights stay small both ways:
//!
//! ```text
//! sum over kinematic J of the other side of N_J(pi x_I) <= 1/2,
//! and the same for every kinematic node of the other side after adding I.
//! ```
//!
//! Then the gap rows restricted to the nodes' own normals are `1 - E` with
//! `||E||_inf <= 1/2`, of full rank, and the tractions `p_t = Z p_k` inherit
//! constants and positivity, `Z 1 = 1`, `Z >= 0`. Candidates come in classes:
//! those already kinematic, those on the edge of a surface that project inside
//! the other, the locally coarser side, the rest. All members of a class on one
//! side are judged together, so the choice does not depend on numbering.
//!
//! An uncovered node of a partly covered facet is *extended*: it takes the
//! traction of the nearest kinematic node, or the mean of several equally near.
//! So are traction nodes in a group without any kinematic node, all of whose
//! members look at others of the group: their balance alone leaves them undetermined.

use striae_mesh::{FacetId, Vec3};
use striae_surface::facet::Shape;

use crate::{
    configuration::Configuration,
    coverage::{Coverage, Place},
    extension::extend,
    patch::{Patch, patches},
};

/// What a surface node does in an increment.
#[derive(Clone, Debug, PartialEq)]
pub enum Role {
    /// No traction.
    Idle,
    /// Collocated impenetrability and friction.
    Kinematic(Partner),
    /// Collocated balance with the opposing traction field.
    Traction(Partner),
    /// The mean traction of kinematic nodes, its leaders.
    Extended(Vec<Leader>),
}

/// A kinematic node whose traction an extended node takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Leader {
    /// Its side.
    pub side: usize,
    /// Its surface-local number.
    pub node: u32,
}

/// Opposing material point at the start of the increment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Partner {
    /// On a deformable facet, as weights of its corners.
    Corners([u32; 4], [f64; 4]),
    /// On a rigid surface, in its reference configuration.
    Rigid(Vec3),
}

impl Partner {
    /// Where the point is now, seen from a node of `side`.
    pub fn point(&self, configuration: &Configuration, side: usize) -> Vec3 {
        match self {
            Partner::Rigid(point) => configuration.placement.point(point),
            Partner::Corners(corners, weights) => {
                let x = &configuration.side(1 - side).x;
                (0..4).map(|c| x[corners[c] as usize] * weights[c]).sum()
            }
        }
    }
}

/// Roles of all nodes of a pair and the patches they form.
#[derive(Clone, Debug, PartialEq)]
pub struct Selection {
    /// Role of every node of both sides; empty for a rigid side.
    pub roles: [Vec<Role>; 2],
    /// Connected contact patches.
    pub patches: Vec<Patch>,
    /// Patch of every node.
    pub patch_of: [Vec<Option<u32>>; 2],
}

/// Roles that were kinematic at the end of the last increment.
pub type Kinematic = [Vec<bool>; 2];

impl Selection {
    /// Chooses the roles in the converged configuration.
    pub fn new(configuration: &Configuration, kinematic_n: &Kinematic) -> Self {
        let pair = configuration.pair;
        let mut coverage = [Vec::new(), Vec::new()];
        for &side in pair.deformable_sides() {
            let count = configuration.side(side).x.len() as u32;
            coverage[side] = (0..count)
                .map(|node| configuration.coverage(side, node))
                .collect();
        }
        let kinematic = if pair.is_rigid() {
            let near = |c: &Coverage| matches!(c, Coverage::Near(_));
            [coverage[0].iter().map(near).collect(), Vec::new()]
        } else {
            Candidates::new(configuration, &coverage, kinematic_n).accepted()
        };
        let mut roles = roles(configuration, &coverage, &kinematic);
        extend(configuration, &coverage, &mut roles);
        let (patches, patch_of) = patches(configuration, &coverage, &roles);
        Self {
            roles,
            patches,
            patch_of,
        }
    }

    /// Which nodes are kinematic.
    pub fn kinematic(&self) -> Kinematic {
        [0, 1].map(|side| {
            let is = |role: &Role| matches!(role, Role::Kinematic(_));
            self.roles[side].iter().map(is).collect()
        })
    }

    /// Whether the node carries traction unknowns.
    pub fn is_active(&self, side: usize, node: u32) -> bool {
        self.roles[side]
            .get(node as usize)
            .is_some_and(|role| *role != Role::Idle)
    }
}

fn roles(
    configuration: &Configuration,
    coverage: &[Vec<Coverage>; 2],
    kinematic: &Kinematic,
) -> [Vec<Role>; 2] {
    [0, 1].map(|side| {
        let role = |(covered, kinematic): (&Coverage, &bool)| match covered {
            Coverage::Near(contact) => {
                let partner = partner(configuration, side, &contact.place);
                if *kinematic {
                    Role::Kinematic(partner)
                } else {
                    Role::Traction(partner)
                }
            }
            Coverage::Far | Coverage::Missed => Role::Idle,
        };
        coverage[side]
            .iter()
            .zip(&kinematic[side])
            .map(role)
            .collect()
    })
}

fn partner(configuration: &Configuration, side: usize, place: &Place) -> Partner {
    match place.weights(configuration, side) {
        Some((corners, weights)) if !configuration.pair.is_rigid() => {
            Partner::Corners(corners, weights)
        }
        _ => Partner::Rigid(
            configuration
                .placement
                .back(&place.point(configuration, side)),
        ),
    }
}

/// Candidates with their opposing corners and weights.
struct Candidates {
    of_side: [Vec<Candidate>; 2],
    /// Kinematic weight that every accepted node sees, by side and candidate.
    accepted: [Vec<bool>; 2],
    ranks: [usize; 2],
}

struct Candidate {
    class: Option<Class>,
    corners: [u32; 4],
    weights: [f64; 4],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Class {
    AlreadyKinematic,
    EdgeInside,
    Coarser,
    Rest,
}

impl Candidates {
    fn new(
        configuration: &Configuration,
        coverage: &[Vec<Coverage>; 2],
        kinematic_n: &Kinematic,
    ) -> Self {
        let of_side = [0, 1].map(|side| {
            (0..coverage[side].len())
                .map(|node| {
                    let was = kinematic_n[side].get(node).copied().unwrap_or(false);
                    candidate(configuration, side, node, &coverage[side][node], was)
                })
                .collect::<Vec<_>>()
        });
        Self {
            accepted: [0, 1].map(|side| vec![false; of_side[side].len()]),
            of_side,
            ranks: [0, 1].map(|side| configuration.pair.sides[side].rank),
        }
    }

    fn accepted(mut self) -> Kinematic {
        let order = if self.ranks[0] <= self.ranks[1] {
            [0, 1]
        } else {
            [1, 0]
        };
        use Class::{AlreadyKinematic, Coarser, EdgeInside, Rest};
        for class in [AlreadyKinematic, EdgeInside, Coarser, Rest] {
            for side in order {
                self.judge(side, class);
            }
        }
        self.accepted
    }

    /// Accepts all members of a class on one side that keep the weights small.
    fn judge(&mut self, side: usize, class: Class) {
        let other = 1 - side;
        let mut tentative = self.accepted[side].clone();
        let mut entrants = Vec::new();
        for (node, candidate) in self.of_side[side].iter().enumerate() {
            if candidate.class == Some(class)
                && kinematic_weight(candidate, &self.accepted[other]) <= LIMIT
            {
                tentative[node] = true;
                entrants.push(node);
            }
        }
        let mut refused = vec![false; tentative.len()];
        for (node, candidate) in self.of_side[other].iter().enumerate() {
            if self.accepted[other][node] && kinematic_weight(candidate, &tentative) > LIMIT {
                for corner in 0..4 {
                    if candidate.weights[corner] > WEIGHTLESS {
                        refused[candidate.corners[corner] as usize] = true;
                    }
                }
            }
        }
        for node in entrants {
            self.accepted[side][node] = !refused[node];
        }
    }
}

const LIMIT: f64 = 0.5 + 1e-9;
const WEIGHTLESS: f64 = 1e-9;

fn kinematic_weight(candidate: &Candidate, kinematic: &[bool]) -> f64 {
    (0..4)
        .filter(|&corner| kinematic[candidate.corners[corner] as usize])
        .map(|corner| candidate.weights[corner])
        .sum()
}

fn candidate(
    configuration: &Configuration,
    side: usize,
    node: usize,
    coverage: &Coverage,
    was_kinematic: bool,
) -> Candidate {
    let nothing = Candidate {
        class: None,
        corners: [0; 4],
        weights: [0.0; 4],
    };
    let Coverage::Near(contact) = coverage else {
        return nothing;
    };
    let (Some((corners, weights)), Place::Facet(hit)) =
        (contact.place.weights(configuration, side), contact.place)
    else {
        return nothing;
    };
    let (own, other) = (configuration.side(side), configuration.side(1 - side));
    let opposite_size: f64 = (0..4)
        .map(|c| other.sizes[corners[c] as usize] * weights[c])
        .sum();
    let on_opposite_boundary = on_boundary(configuration, 1 - side, hit.facet, hit.xi, hit.eta);
    let class = if was_kinematic {
        Class::AlreadyKinematic
    } else if own.surface.is_on_boundary(node as u32) && !on_opposite_boundary {
        Class::EdgeInside
    } else if own.sizes[node] > opposite_size * (1.0 + 1e-6) {
        Class::Coarser
    } else {
        Class::Rest
    };
    Candidate {
        class: Some(class),
        corners,
        weights,
    }
}

/// Whether a point of a facet lies on an edge of the surface.
fn on_boundary(
    configuration: &Configuration,
    side: usize,
    facet: FacetId,
    xi: f64,
    eta: f64,
) -> bool {
    let snapshot = configuration.side(side);
    let corners = snapshot.corners(facet);
    let weights = Shape::of(&corners).weights(xi, eta).value;
    snapshot
        .surface
        .boundary_edges()
        .iter()
        .filter(|edge| edge.facet == facet)
        .any(|edge| {
            let off_edge: f64 = (0..4)
                .filter(|&corner| !edge.nodes.contains(&corners[corner]))
                .map(|corner| weights[corner].abs())
                .sum();
            off_edge < 1e-6
        })
}
