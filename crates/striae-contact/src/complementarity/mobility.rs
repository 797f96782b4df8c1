//! The directions in which a closed node can slip.
//!
//! Some of the positions that answer to the friction of a node may be prescribed. With the
//! shares `a_J` of nodes in that friction, and the axes `e` in which node `J` is free,
//!
//! ```text
//! M_ij = sum_J a_J^2 sum_e (t_i . e)(t_j . e) / sum_J a_J^2
//! ```
//!
//! is the identity if nothing is prescribed. Its eigenvalues are squared mobilities, and a node
//! with only one that is not small slips along the eigenvector `q = (cos t, sin t)`,
//! `tan 2t = 2 M_12/(M_11 - M_22)`. It turns as the frame does, here with derivatives by the
//! frame; those by the shares vanish where all that answers is free along the same axes.
//! Derivatives of the slip itself would not do: they do not vanish where nothing can answer to
//! friction, as the weights change with the shape.

use striae_mesh::Vec3;

use super::state::{NodeState, Q, TANGENTS};

/// Squared mobility below which a node cannot slip in a direction, over that of free nodes.
/// Nodes between walls yield a little by the tilt of their normal, which is no freedom.
const IMMOBILE: f64 = 1e-4;

/// In which directions a node can slip.
pub(super) enum Mobility {
    /// In all.
    Free,
    /// Along one direction and back.
    Along(Box<Way>),
    /// In none.
    Held,
}

/// The only way that a node can go, in components along the tangents.
pub(super) struct Way {
    /// `q`.
    pub(super) of_slip: [Q; 2],
    /// The direction of `z` where it slips along `q`, the unit vector of `K^-1 q`.
    pub(super) of_friction: [Q; 2],
}

impl Mobility {
    /// What the prescribed positions leave to a node.
    pub(super) fn new(state: &NodeState) -> Self {
        let [first, mixed, second] = products(state);
        let difference = Q::combination([(1.0, &first), (-1.0, &second)]);
        let twice = Q::combination([(2.0, &mixed)]);
        let radius = 0.5 * difference.re.hypot(twice.re);
        let middle = 0.5 * (first.re + second.re);
        if middle - radius > IMMOBILE {
            Self::Free
        } else if middle + radius > IMMOBILE {
            let of_slip = direction(&difference, &twice);
            let of_friction = of_friction(state, &of_slip);
            Self::Along(Box::new(Way {
                of_slip,
                of_friction,
            }))
        } else {
            Self::Held
        }
    }
}

/// `M_11`, `M_12`, `M_22`.
fn products(state: &NodeState) -> [Q; 3] {
    let mut free = Vec3::zeros();
    let mut scale = 0.0;
    for &(first, share) in &state.node.kinematics.shares {
        if state.answers(first) {
            scale += share * share;
        }
        for axis in (0..3).filter(|&axis| state.is_free_position(first, axis)) {
            free[axis] += share * share;
        }
    }
    free /= f64::max(scale, f64::MIN_POSITIVE);
    let t = [0, 1].map(|at| state.node.frame.t[at].value);
    [(0, 0), (0, 1), (1, 1)].map(|(i, j)| {
        let by_i = free.component_mul(&t[j]);
        let mut product = Q::constant(t[i].dot(&by_i));
        product.depend(TANGENTS + 3 * i, &by_i);
        product.depend(TANGENTS + 3 * j, &free.component_mul(&t[i]));
        product
    })
}

/// `(cos t, sin t)` with `tan 2t = twice/difference`.
fn direction(difference: &Q, twice: &Q) -> [Q; 2] {
    let square = difference.re * difference.re + twice.re * twice.re;
    let angle = 0.5 * twice.re.atan2(difference.re);
    let by = [0.5 * difference.re / square, -0.5 * twice.re / square];
    let turn = Q::combination([(by[0], twice), (by[1], difference)]);
    let (sine, cosine) = angle.sin_cos();
    [(cosine, -sine), (sine, cosine)].map(|(value, slope)| Q {
        re: value,
        ..Q::combination([(slope, &turn)])
    })
}

/// Unit vector of `K^-1 q`.
fn of_friction(state: &NodeState, q: &[Q; 2]) -> [Q; 2] {
    let v = [0, 1].map(|i| {
        let [first, second] = [0, 1].map(|j| Q::product(&state.k_inverse(i, j), &q[j]));
        Q::combination([(1.0, &first), (1.0, &second)])
    });
    let length = v[0].re.hypot(v[1].re);
    let unit = [0, 1].map(|i| v[i].re / length);
    let stretch = Q::combination([(unit[0], &v[0]), (unit[1], &v[1])]);
    [0, 1].map(|i| Q {
        re: unit[i],
        ..Q::combination([(1.0 / length, &v[i]), (-unit[i] / length, &stretch)])
    })
}
