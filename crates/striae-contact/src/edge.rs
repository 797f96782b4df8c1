//! The nearest place on the edge of a surface, with its derivatives.
//!
//! For a node at `x` with the normal `n` of its own surface, and an edge from `s` to `e`:
//! with `r = s - x`, `d = e - s`, and `P = I - n n`
//!
//! ```text
//! t = -(r . P d)/(d . P d), in [0, 1],   g = n . (r + t d)
//! dt = -(P d . dr + (P r + 2 t P d) . dd - ((n . d) r + (n . r) d + 2 t (n . d) d) . dn)/(d . P d)
//! ```
//!
//! and `dt = 0` at an end of the edge.

use striae_mesh::Vec3;
use striae_surface::{node::SurfaceNode, scalar::Real};

use crate::{
    configuration::Configuration,
    nodal_normal::own_normal,
    projection::{Hit, share_of_edge},
    side::Side,
    term::Gradient,
    tracked::{TrackedScalar, add_slope},
};

/// Nearest place on the edge of the opposing surface.
#[derive(Clone, Debug)]
pub struct OnEdge {
    /// Places of the ends among the corners of the facet.
    pub ends: [usize; 2],
    /// Share `t` of the way from start to end.
    pub share: TrackedScalar,
    /// Gap along the node's own normal.
    pub gap: TrackedScalar,
}

/// The place on the edge between `nodes` that a node of `side` found with `hit`.
///
/// # Panics
/// If they are no corners of the facet.
pub fn on_edge(
    configuration: &Configuration,
    side: Side,
    node: SurfaceNode,
    hit: &Hit,
    nodes: [SurfaceNode; 2],
) -> OnEdge {
    let own = configuration.side(side);
    let other = configuration.facing(side);
    let corners = other.corners(hit.facet);
    let ends = nodes.map(|end| {
        let found = corners.iter().position(|corner| *corner == end);
        found.expect("an edge joins corners of its facet")
    });
    let n = own_normal(configuration, side, node);
    let [start, end] = nodes.map(|node| other.x[node]);
    let (r, d) = (start - own.x[node], end - start);
    let t = share_of_edge(&r, &d, &n.value);
    let (n_r, n_d) = (n.value.dot(&r), n.value.dot(&d));
    let across = |v: &Vec3, along: f64| v - n.value * along;
    let inside = t > 0.0 && t < 1.0;
    let scale = if inside {
        -1.0 / d.dot(&across(&d, n_d))
    } else {
        0.0
    };
    let by_r = across(&d, n_d) * scale;
    let by_d = across(&r, n_r) * scale + by_r * (2.0 * t);
    let by_n = (r * n_d + d * (n_r + 2.0 * t * n_d)) * -scale;
    let spread = |by_r: Vec3, by_d: Vec3, by_n: Vec3| -> Gradient {
        let numbering = configuration.pair.numbering();
        let mut gradient = vec![(numbering.position(side, node), -by_r)];
        if !configuration.pair.is_rigid() {
            let opposing = configuration.pair.opposing(side);
            let [start, end] = nodes.map(|node| numbering.position(opposing, node));
            gradient.extend([(start, by_r - by_d), (end, by_d)]);
        }
        for (first, block) in &n.jacobian {
            add_slope(&mut gradient, *first, block.tr_mul(&by_n));
        }
        gradient
    };
    let point = r + d * t;
    OnEdge {
        ends,
        gap: TrackedScalar {
            value: n.value.dot(&point),
            gradient: spread(
                n.value + by_r * n_d,
                n.value * t + by_d * n_d,
                point + by_n * n_d,
            ),
        },
        share: TrackedScalar {
            value: t,
            gradient: spread(by_r, by_d, by_n),
        },
    }
}

impl OnEdge {
    /// Interpolation functions of the corners of the facet.
    pub fn weights(&self) -> [f64; 4] {
        self.weights_along(self.share.value)
    }

    /// Weights for a share with derivatives.
    pub fn weights_along<D: Real>(&self, share: D) -> [D; 4] {
        let mut weights = [D::from(0.0); 4];
        weights[self.ends[0]] = -share + 1.0;
        weights[self.ends[1]] = share;
        weights
    }
}
