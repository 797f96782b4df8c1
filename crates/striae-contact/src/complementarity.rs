//! Contact and friction at a kept node.
//!
//! Unknowns `p` and `z = z1 t1 + z2 t2`. With the gap `g` and the slip `du` since the last
//! converged configuration (see [`crate::kinematics`]),
//! `varpi = varpi(max(p, 0), |du|/dt)` and `y = z + r_t K^-1 du`:
//!
//! ```text
//! p - r_n g > 0 : g = 0    else p = 0, z = 0
//! |y| <= varpi  : du = 0   else z = varpi y/|y|
//! ```
//!
//! The slip row is linearised with the globalised Jacobian of Hueeber, Stadler
//! & Wohlmuth (SIAM J. Sci. Comput. 30, 2008, doi:10.1137/060671061),
//!
//! ```text
//! dz - M dy - (y/|y|) dvarpi = -(z - varpi y/|y|),    M = varpi/|y| (I - beta F),
//! F = z y^T/(max(varpi, |z|) |y|),   alpha = cos(z, y),   delta = min(|z|/varpi, 1),
//! beta = 1/(1 - alpha delta) if alpha < 0 else 1,
//! ```
//!
//! which is the exact one where the row is satisfied.
//!
//! Longer than other files, as all rows of a node are made of the same derivatives.

use nalgebra::{Const, Matrix2, SymmetricEigen, Vector2, Vector3};
use num_dual::DualSVec64;
use striae_mesh::Vec3;
use striae_surface::scalar::constant3;

use crate::{
    configuration::Configuration,
    frame::Frame,
    kinematics::{Kinematics, Presence},
    quantity::Quantity,
    table_1::Corrector,
    term::{Field, Lanes, LocalTerm, Source, parts, variable3},
    texture::NodeTextures,
    traction::{Cap, on_lanes, push_textures},
    unknown::{Numbering, Unknown},
    unknowns::{NodeResult, Status},
};

/// Which iteration of an increment is evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Iteration {
    /// The first: touching nodes are closed; closed nodes stick or, if they slipped
    /// before, go on slipping in their direction.
    First,
    /// A later one: the state decides.
    Later {
        /// `r_t` over its default. It changes which way cycles are left, not the solution.
        slip_weight: f64,
    },
    /// A later one: the labels of the nodes decide.
    Corrected(Corrector),
}

impl Iteration {
    /// A later iteration with the default `r_t`.
    pub const LATER: Self = Self::Later { slip_weight: 1.0 };
}

/// A kept node with all that its rows need.
#[derive(Clone, Debug)]
pub struct ContactNode<'a> {
    /// Side of the pair.
    pub side: usize,
    /// Surface-local node.
    pub node: u32,
    /// Gap and slip.
    pub kinematics: &'a Kinematics,
    /// Nodal frame.
    pub frame: &'a Frame,
    /// Textures of both sides at the node.
    pub textures: &'a NodeTextures,
    /// Whether it slipped in the last converged increment.
    pub slipped: bool,
    /// Status in the iteration before.
    pub before: Status,
    /// `p`, `z1`, `z2`.
    pub unknowns: [f64; 3],
    /// Friction traction `tau`.
    pub tau: Vec3,
}

/// Which position unknowns are prescribed, by side, three a node.
pub type Prescribed = [Vec<bool>; 2];

/// What a tangential row states, its residual and its gradient over the lanes.
type TangentialRow = (Field, f64, [f64; N]);

const N: usize = 22;
type Q = Quantity<N>;
const GAP: usize = 0;
const SLIP: usize = 1;
const NORMAL: usize = 4;
const TANGENTS: usize = 7;
const TRACTION: usize = 13;
const TEXTURES: usize = 16;

/// Derivative of the gap below which nothing can change it.
const FIXED: f64 = 1e-9;

/// Squared mobility below which a node cannot slip in a direction, over that of free nodes.
/// Nodes between walls yield a little by the tilt of their normal, which is no freedom.
const IMMOBILE: f64 = 1e-4;

/// Gap below which a node counts as touching at the start of an increment, over the local size.
const TOUCHING: f64 = 1e-6;

/// The three rows of a kept node.
pub fn rows(
    configuration: &Configuration,
    node: &ContactNode,
    prescribed: &Prescribed,
    iteration: Iteration,
) -> (LocalTerm, NodeResult) {
    let state = NodeState::new(configuration, node, prescribed);
    let [p, z1, z2] = node.unknowns;
    let size = configuration.size(node.side, node.node);
    let [r_n, r_t] = node.kinematics.stiffness;
    let g = state.gap.re;
    let touching = iteration == Iteration::First && g <= TOUCHING * size;
    let closed = (touching || p - r_n * g > 0.0) && state.is_free();
    let held = |component: usize, value: f64| {
        let mut row = [0.0; N];
        row[TRACTION + component] = 1.0;
        (Field::Traction, value, row)
    };
    let mut result = state.result();
    let rows = if !closed {
        [held(0, p), held(1, z1), held(2, z2)]
    } else {
        let (status, [first, second]) =
            state.tangential(configuration, [p, z1, z2], r_t, size, iteration);
        result.status = status;
        [(Field::Gap(size), g, state.gap.slope), first, second]
    };
    let first = configuration
        .pair
        .numbering()
        .traction(node.side, node.node);
    let numbered = [0, 1, 2].map(|at| (first + at as u32, rows[at].0, rows[at].1));
    let gradient: [[f64; 3]; N] =
        std::array::from_fn(|lane| rows.each_ref().map(|row| row.2[lane]));
    let term = LocalTerm::from_lanes(&state.lanes, &numbered, &gradient);
    (term, result)
}

/// Gap and slip of a node as functions of the unknowns.
struct NodeState<'a> {
    node: &'a ContactNode<'a>,
    numbering: Numbering,
    prescribed: &'a Prescribed,
    lanes: Lanes<'a>,
    gap: Q,
    /// Components of `du`.
    slip: [Q; 2],
    /// Components of `K^-1 du`.
    turned: [Q; 2],
}

impl<'a> NodeState<'a> {
    fn new(
        configuration: &Configuration,
        node: &'a ContactNode<'a>,
        prescribed: &'a Prescribed,
    ) -> Self {
        let numbering = configuration.pair.numbering();
        let Kinematics { gap, slip, .. } = node.kinematics;
        let [t1, t2] = &node.frame.t;
        let mut lanes = Lanes::default();
        lanes.push(Source::Scalar(&gap.gradient));
        lanes.push(Source::Vector(&slip.jacobian));
        lanes.push(Source::Vector(&node.frame.n.jacobian));
        lanes.push(Source::Vector(&t1.jacobian));
        lanes.push(Source::Vector(&t2.jacobian));
        lanes.push(Source::Unknowns {
            first: numbering.traction(node.side, node.node),
            count: 3,
        });
        push_textures(&mut lanes, node.textures);
        // Lanes of the law: normal and textures.
        let normal: Vector3<DualSVec64<9>> = variable3(&node.frame.n.value, 0);
        let textures = on_lanes(node.textures, 3);
        let kernel = configuration.pair.friction.kernel(&normal, &textures);
        let (turned, by_surroundings) = parts(&(kernel.k_inverse * constant3(&slip.value)));
        let k_inverse = kernel.k_inverse.map(|component| component.re);
        // `t . v` for a vector `v` that depends on the slip and on the law's lanes.
        let component = |axis: usize, v: &Vec3, by_slip: Vec3| {
            let mut component = Q::constant(node.frame.t[axis].value.dot(v));
            component.depend(SLIP, &by_slip);
            component.depend(TANGENTS + 3 * axis, v);
            component
        };
        let of_slip = [0, 1].map(|axis| component(axis, &slip.value, node.frame.t[axis].value));
        let turned = [0, 1].map(|axis| {
            let t = node.frame.t[axis].value;
            let mut component = component(axis, &turned, k_inverse.tr_mul(&t));
            for (lane, derivative) in by_surroundings.iter().enumerate() {
                let lane = if lane < 3 {
                    NORMAL + lane
                } else {
                    TEXTURES + lane - 3
                };
                component.slope[lane] += t.dot(&Vec3::from(*derivative));
            }
            component
        });
        Self {
            node,
            numbering,
            prescribed,
            lanes,
            gap: Q::variable(gap.value, GAP),
            slip: of_slip,
            turned,
        }
    }

    fn result(&self) -> NodeResult {
        let ContactNode {
            frame,
            unknowns,
            tau,
            kinematics,
            ..
        } = self.node;
        NodeResult {
            gap: match kinematics.presence {
                Presence::Facing => kinematics.gap.value,
                Presence::Gone => 0.0,
            },
            pressure: unknowns[0],
            tau: *tau,
            slip: kinematics.seen_slip,
            normal: frame.n.value,
            texture: Vec3::zeros(),
            mean: Vec3::zeros(),
            status: Status::Open,
        }
    }

    /// Whether a triple is the position of the node itself or one of the other side.
    /// Neighbours on its own side have rows of their own; that they can move makes no room
    /// for one more.
    fn answers(&self, first: u32) -> bool {
        match self.numbering.unknown(first) {
            Unknown::Position { side, node, .. } => {
                side != self.node.side || node == self.node.node
            }
            Unknown::Traction { .. } => false,
        }
    }

    /// Whether a component of a triple is such a position and not prescribed.
    fn is_free_position(&self, first: u32, axis: usize) -> bool {
        match self.numbering.unknown(first) {
            Unknown::Position { side, node, .. } => {
                self.answers(first) && !self.prescribed[side][3 * node as usize + axis]
            }
            Unknown::Traction { .. } => false,
        }
    }

    /// Whether a free position changes the gap.
    fn is_free(&self) -> bool {
        let gradient = &self.node.kinematics.gap.gradient;
        gradient.iter().any(|(first, slope)| {
            (0..3).any(|axis| slope[axis].abs() > FIXED && self.is_free_position(*first, axis))
        })
    }

    /// Whether a free position changes the slip, turned or not.
    fn is_mobile(&self) -> bool {
        let eigen = self.mobility();
        eigen.eigenvalues.min() > IMMOBILE
    }

    /// Status and tangential rows of a closed node.
    fn tangential(
        &self,
        configuration: &Configuration,
        [p, z1, z2]: [f64; 3],
        r: f64,
        size: f64,
        iteration: Iteration,
    ) -> (Status, [TangentialRow; 2]) {
        let z = [Q::variable(z1, TRACTION + 1), Q::variable(z2, TRACTION + 2)];
        let friction = &configuration.pair.friction;
        if friction.cap(1.0, 0.0) == 0.0 {
            return (Status::Slip, z.map(|z| (Field::Traction, z.re, z.slope)));
        }
        let varpi = self.varpi(configuration, p);
        let r = match iteration {
            Iteration::Later { slip_weight } => r * slip_weight,
            Iteration::First | Iteration::Corrected(_) => r,
        };
        if iteration != Iteration::First
            && let Some(q) = self.only_way()
        {
            return self.along(&q, &z, &varpi, r, size, iteration);
        }
        let y = [0, 1].map(|at| Q::combination([(1.0, &z[at]), (r, &self.turned[at])]));
        let length = y[0].re.hypot(y[1].re);
        if iteration == Iteration::First {
            return if self.node.slipped && z1.hypot(z2) > 0.5 * varpi.re {
                (Status::Slip, self.continued_slip(&z, &varpi, size))
            } else {
                (Status::Stick, self.stick(&z, size))
            };
        }
        if let Iteration::Corrected(corrector) = iteration {
            let radius = Q::combination([(corrector.inflation.factor(), &varpi)]);
            let turned = [self.turned[0].re, self.turned[1].re];
            return match corrector.status(self.node.before, [z1, z2], turned, radius.re) {
                Status::Slip => (Status::Slip, slip(&z, &y, &radius)),
                _ => (Status::Stick, self.stick(&z, size)),
            };
        }
        if length <= varpi.re {
            (Status::Stick, self.stick(&z, size))
        } else {
            (Status::Slip, slip(&z, &y, &varpi))
        }
    }

    /// The direction in which the node can move, if there is but one.
    fn only_way(&self) -> Option<Vector2<f64>> {
        let eigen = self.mobility();
        let (least, most) = (eigen.eigenvalues.imin(), eigen.eigenvalues.imax());
        let single = eigen.eigenvalues[least] <= IMMOBILE && eigen.eigenvalues[most] > IMMOBILE;
        single.then(|| eigen.eigenvectors.column(most).into())
    }

    /// Status and rows of a node that can move along `q` only: friction along it, none
    /// across, where the slip is that of neighbours that a plane of symmetry mirrors.
    fn along(
        &self,
        q: &Vector2<f64>,
        z: &[Q; 2],
        varpi: &Q,
        r: f64,
        size: f64,
        iteration: Iteration,
    ) -> (Status, [TangentialRow; 2]) {
        let part = |v: &[Q; 2]| Q::combination([(q.x, &v[0]), (q.y, &v[1])]);
        let (along, turned) = (part(z), part(&self.turned));
        let y = along.re + r * turned.re;
        let (slips, radius) = match iteration {
            Iteration::Corrected(corrector) => {
                let radius = Q::combination([(corrector.inflation.factor(), varpi)]);
                let of = |value: f64| [value, 0.0];
                let before = self.node.before;
                let status = corrector.status(before, of(along.re), of(turned.re), radius.re);
                (status == Status::Slip, radius)
            }
            _ => (y.abs() > varpi.re, Q::combination([(1.0, varpi)])),
        };
        if !slips {
            return (Status::Stick, self.stick(z, size));
        }
        let row = |value: Q| (Field::Traction, value.re, value.slope);
        let off = Q::combination([(1.0, &along), (-y.signum(), &radius)]);
        let across = Q::combination([(-q.y, &z[0]), (q.x, &z[1])]);
        (Status::Slip, [row(off), row(across)])
    }

    /// `varpi` at the pressure `p` and the present slip rate, without derivatives by the
    /// slip where it vanishes.
    fn varpi(&self, configuration: &Configuration, p: f64) -> Q {
        let [first, second] = &self.slip;
        let length = first.re.hypot(second.re);
        let rate = length / configuration.elapsed;
        let cap = Cap::new(&configuration.pair.friction, p, rate);
        let by_slip = if length > 0.0 {
            cap.by_rate / (configuration.elapsed * length)
        } else {
            0.0
        };
        let mut varpi =
            Q::combination([(by_slip * first.re, first), (by_slip * second.re, second)]);
        varpi.slope[TRACTION] = cap.by_pressure;
        Q {
            re: cap.value,
            ..varpi
        }
    }

    /// Slip that goes on in the direction of `z`: `|z| = varpi` and no slip
    /// across, or no `z` across where the node cannot move that way.
    fn continued_slip(&self, z: &[Q; 2], varpi: &Q, size: f64) -> [TangentialRow; 2] {
        let direction = Vector2::new(z[0].re, z[1].re).normalize();
        let along = [(direction.x, &z[0]), (direction.y, &z[1]), (-1.0, varpi)];
        let along = Q::combination(along);
        let across = |v: &[Q; 2]| Q::combination([(direction.x, &v[1]), (-direction.y, &v[0])]);
        let turned = across(&self.turned);
        let second = if self.is_mobile() {
            (Field::Stick(size), turned.re, turned.slope)
        } else {
            let z_across = across(z);
            (Field::Traction, z_across.re, z_across.slope)
        };
        [(Field::Traction, along.re, along.slope), second]
    }

    /// Squared mobility of the slip in its principal directions: eigenvalues of the products
    /// of what friction there does to the free positions. Derivatives of the slip itself do
    /// not vanish where nothing can answer to friction, as the weights change with the shape.
    /// One is what it is if nothing is prescribed.
    fn mobility(&self) -> SymmetricEigen<f64, Const<2>> {
        let mut products = Matrix2::zeros();
        let mut scale = 0.0;
        let [t1, t2] = [0, 1].map(|axis| self.node.frame.t[axis].value);
        for &(first, share) in &self.node.kinematics.shares {
            if self.answers(first) {
                scale += share * share;
            }
            for axis in (0..3).filter(|&axis| self.is_free_position(first, axis)) {
                let components = Vector2::new(t1[axis], t2[axis]) * share;
                products += components * components.transpose();
            }
        }
        (products / f64::max(scale, f64::MIN_POSITIVE)).symmetric_eigen()
    }

    /// `du = 0`, with `z = 0` in directions in which the node cannot move.
    fn stick(&self, z: &[Q; 2], size: f64) -> [TangentialRow; 2] {
        let row = |field: Field, value: Q| (field, value.re, value.slope);
        let eigen = self.mobility();
        if eigen.eigenvalues.min() > IMMOBILE {
            return self.slip.map(|slip| row(Field::Stick(size), slip));
        }
        [0, 1].map(|at| {
            let q: Vector2<f64> = eigen.eigenvectors.column(at).into();
            let (field, of) = if eigen.eigenvalues[at] > IMMOBILE {
                (Field::Stick(size), &self.slip)
            } else {
                (Field::Traction, z)
            };
            row(field, Q::combination([(q[0], &of[0]), (q[1], &of[1])]))
        })
    }
}

fn slip(z: &[Q; 2], y: &[Q; 2], varpi: &Q) -> [TangentialRow; 2] {
    let zv = Vector2::new(z[0].re, z[1].re);
    let yv = Vector2::new(y[0].re, y[1].re);
    let (length, radius) = (yv.norm(), varpi.re);
    let direction = yv / length;
    let f = zv * direction.transpose() / radius.max(zv.norm()).max(f64::MIN_POSITIVE);
    let alpha = if zv.norm() > 0.0 {
        zv.dot(&direction) / zv.norm()
    } else {
        0.0
    };
    let delta = if radius > 0.0 {
        (zv.norm() / radius).min(1.0)
    } else {
        1.0
    };
    let beta = if alpha < 0.0 {
        1.0 / (1.0 - alpha * delta)
    } else {
        1.0
    };
    let m = (Matrix2::identity() - f * beta) * (radius / length);
    [0, 1].map(|at| {
        let row = Q::combination([
            (1.0, &z[at]),
            (-m[(at, 0)], &y[0]),
            (-m[(at, 1)], &y[1]),
            (-direction[at], varpi),
        ]);
        let residual = zv[at] - radius * direction[at];
        (Field::Traction, residual, row.slope)
    })
}
