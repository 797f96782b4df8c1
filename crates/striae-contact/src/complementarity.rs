//! Collocated contact and friction at a kinematic node.
//!
//! Unknowns `p` and `z = z1 t1 + z2 t2`. With the gap `g`, the slip
//! `du = (I - n n)(x_I - xbar)` since the last converged configuration,
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
use striae_surface::{facet::Shape, scalar::constant3};

use crate::{
    configuration::Configuration,
    coverage::Place,
    frame::{FOLLOW, Frame, LostProjection},
    opposing::Opposing,
    projection::{Margin, differentiated_rigid},
    quantity::Quantity,
    selection::Partner,
    table_1::Corrector,
    term::{Field, Lanes, LocalTerm, Source, gradient, parts, variable3},
    texture::NodeTextures,
    traction::{Cap, on_lanes, push_textures},
    unknowns::{NodeResult, Status},
};

/// Which iteration of an increment is evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Iteration {
    /// The first: touching nodes are closed; closed nodes stick or, if they slipped
    /// before, go on slipping in their direction.
    First,
    /// A later one: the state decides.
    Later,
    /// A later one: the labels of the nodes decide.
    Corrected(Corrector),
}

/// A kinematic node with all that its rows need.
#[derive(Clone, Copy, Debug)]
pub struct KinematicNode<'a> {
    /// Side of the pair.
    pub side: usize,
    /// Surface-local node.
    pub node: u32,
    /// Opposing material point at the start of the increment.
    pub partner: Partner,
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

const N: usize = 45;
type Q = Quantity<N>;
const NORMAL: usize = 3;
const TANGENTS: usize = 6;
const X_OPPOSITE: usize = 12;
const X_PARTNER: usize = 24;
const TRACTION: usize = 36;
const TEXTURES: usize = 39;

/// Squared mobility below which a node cannot slip in a direction.
const IMMOBILE: f64 = 1e-12;

/// Gap below which a node counts as touching at the start of an increment, over the local size.
const TOUCHING: f64 = 1e-6;

/// The three rows of a kinematic node.
pub fn rows(
    configuration: &Configuration,
    node: &KinematicNode,
    prescribed: &Prescribed,
    iteration: Iteration,
) -> Result<(LocalTerm, NodeResult), LostProjection> {
    let state = NodeState::new(configuration, node, prescribed)?;
    let [p, z1, z2] = node.unknowns;
    let size = configuration.side(node.side).sizes[node.node as usize];
    let stiffness = stiffness(configuration, node.side) / size;
    let g = state.gap.re;
    let touching = iteration == Iteration::First && g <= TOUCHING * size;
    let closed = (touching || p - stiffness * g > 0.0) && state.is_free(&state.gap, X_OPPOSITE);
    let held = |component: usize, value: f64| {
        let mut row = [0.0; N];
        row[TRACTION + component] = 1.0;
        (Field::Traction, value, row)
    };
    let mut result = state.result(node);
    let rows = if !closed {
        [held(0, p), held(1, z1), held(2, z2)]
    } else {
        let (status, [first, second]) = state.tangential(
            configuration,
            [p, z1, z2],
            10.0 * stiffness,
            size,
            iteration,
        );
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
    Ok((term, result))
}

/// The smaller of the moduli of the two bodies.
fn stiffness(configuration: &Configuration, side: usize) -> f64 {
    let sides = &configuration.pair.sides;
    let other = if configuration.pair.is_rigid() {
        side
    } else {
        1 - side
    };
    sides[side].stiffness.min(sides[other].stiffness)
}

/// Gap and slip of a node as functions of the unknowns.
struct NodeState<'a> {
    lanes: Lanes<'a>,
    free: [bool; N],
    gap: Q,
    slipped: bool,
    before: Status,
    /// Components of `du`.
    slip: [Q; 2],
    /// Components of `K^-1 du`.
    turned: [Q; 2],
}

impl<'a> NodeState<'a> {
    fn new(
        configuration: &Configuration,
        node: &KinematicNode<'a>,
        prescribed: &Prescribed,
    ) -> Result<Self, LostProjection> {
        let (side, index) = (node.side, node.node as usize);
        let (own, numbering) = (configuration.side(side), configuration.pair.numbering());
        let mut lanes = Lanes::default();
        lanes.push(Source::Unknowns {
            first: numbering.position(side, node.node),
            count: 3,
        });
        lanes.push(Source::Vector(&node.frame.n.jacobian));
        lanes.push(Source::Vector(&node.frame.t[0].jacobian));
        lanes.push(Source::Vector(&node.frame.t[1].jacobian));
        let mut free = [false; N];
        for axis in 0..3 {
            free[axis] = !prescribed[side][3 * index + axis];
        }
        let mut opposite = |corners: Option<[u32; 4]>, lanes: &mut Lanes<'a>, lane: usize| {
            let Some(corners) = corners else {
                lanes.push(Source::Constant(12));
                return;
            };
            for (at, corner) in corners.into_iter().enumerate() {
                lanes.push(Source::Unknowns {
                    first: numbering.position(1 - side, corner),
                    count: 3,
                });
                for axis in 0..3 {
                    free[lane + 3 * at + axis] = !prescribed[1 - side][3 * corner as usize + axis];
                }
            }
        };
        let (x, n) = (own.x[index], node.frame.n.value);
        let reach = FOLLOW * configuration.reach(side, node.node);
        let contact = configuration
            .contact(side, node.node, reach, Margin::Extrapolated)
            .ok_or(LostProjection {
                side,
                node: node.node,
            })?;
        let mut gap = Q::constant(contact.gap);
        match contact.place {
            Place::Plane(_) => {
                opposite(None, &mut lanes, X_OPPOSITE);
                if let Some((_, normal)) = configuration.plane() {
                    gap.depend(0, &normal);
                }
            }
            Place::Facet(hit) if configuration.pair.is_rigid() => {
                opposite(None, &mut lanes, X_OPPOSITE);
                let x: Vector3<DualSVec64<3>> = variable3(&x, 0);
                let ([_, _, g], _) = differentiated_rigid(configuration.side(1), &hit, &x);
                gap.depend(0, &gradient(&g).into());
            }
            Place::Facet(hit) => {
                let target = configuration.side(1 - side);
                let corners = target.corners(hit.facet);
                opposite(Some(corners), &mut lanes, X_OPPOSITE);
                let positions = target.corner_positions(hit.facet);
                let opposing = Opposing::new(Shape::of(&corners), &hit, &n, &positions);
                let by_r = opposing.gap_by_r;
                gap.depend(0, &-by_r);
                gap.depend(NORMAL, &(by_r * -hit.gap));
                for corner in 0..4 {
                    let lane = X_OPPOSITE + 3 * corner;
                    gap.depend(lane, &(by_r * opposing.weights[corner]));
                }
            }
        }
        let weights = match node.partner {
            Partner::Rigid(_) => {
                opposite(None, &mut lanes, X_PARTNER);
                [0.0; 4]
            }
            Partner::Corners(corners, weights) => {
                opposite(Some(corners), &mut lanes, X_PARTNER);
                weights
            }
        };
        lanes.push(Source::Unknowns {
            first: numbering.traction(side, node.node),
            count: 3,
        });
        push_textures(&mut lanes, node.textures);
        let relative = x - node.partner.point(configuration, side);
        // Lanes of the law: normal and textures.
        let normal: Vector3<DualSVec64<9>> = variable3(&n, 0);
        let textures = on_lanes(node.textures, 3);
        let kernel = configuration.pair.friction.kernel(&normal, &textures);
        let (turned, by_surroundings) = parts(&(kernel.k_inverse * constant3(&relative)));
        let k_inverse = kernel.k_inverse.map(|component| component.re);
        // `t . v` for a vector `v` that depends on `relative` and on the law's lanes.
        let component = |axis: usize, v: &Vec3, by_relative: Vec3| {
            let mut component = Q::constant(node.frame.t[axis].value.dot(v));
            component.depend(0, &by_relative);
            component.depend(TANGENTS + 3 * axis, v);
            for (corner, weight) in weights.iter().enumerate() {
                component.depend(X_PARTNER + 3 * corner, &(by_relative * -weight));
            }
            component
        };
        let slip = [0, 1].map(|axis| component(axis, &relative, node.frame.t[axis].value));
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
        Ok(Self {
            lanes,
            free,
            gap,
            slipped: node.slipped,
            before: node.before,
            slip,
            turned,
        })
    }

    fn result(&self, node: &KinematicNode) -> NodeResult {
        let t = &node.frame.t;
        NodeResult {
            gap: self.gap.re,
            pressure: node.unknowns[0],
            tau: node.tau,
            slip: t[0].value * self.slip[0].re + t[1].value * self.slip[1].re,
            normal: node.frame.n.value,
            texture: Vec3::zeros(),
            status: Status::Open,
        }
    }

    /// Derivatives of a row by the free components of the node's own position
    /// and of the four corners from lane `opposite` on.
    fn free_gradient(&self, row: &Q, opposite: usize) -> impl Iterator<Item = f64> {
        let lanes = (0..3).chain(opposite..opposite + 12);
        lanes.map(move |lane| {
            if self.free[lane] {
                row.slope[lane]
            } else {
                0.0
            }
        })
    }

    fn is_free(&self, row: &Q, opposite: usize) -> bool {
        self.free_gradient(row, opposite).any(|d| d.abs() > 1e-9)
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
        let y = [0, 1].map(|at| Q::combination([(1.0, &z[at]), (r, &self.turned[at])]));
        let length = y[0].re.hypot(y[1].re);
        if iteration == Iteration::First {
            return if self.slipped && z1.hypot(z2) > 0.5 * varpi.re {
                (Status::Slip, self.continued_slip(&z, &varpi, size))
            } else {
                (Status::Stick, self.stick(&z, size))
            };
        }
        if let Iteration::Corrected(corrector) = iteration {
            let radius = Q::combination([(corrector.inflation.factor(), &varpi)]);
            let turned = [self.turned[0].re, self.turned[1].re];
            return match corrector.status(self.before, [z1, z2], turned, radius.re) {
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
        let second = if self.is_free(&turned, X_PARTNER) {
            (Field::Stick(size), turned.re, turned.slope)
        } else {
            let z_across = across(z);
            (Field::Traction, z_across.re, z_across.slope)
        };
        [(Field::Traction, along.re, along.slope), second]
    }

    /// Squared mobility of the slip in its principal directions: eigenvalues of
    /// the products of its derivatives by the free positions.
    fn mobility(&self) -> SymmetricEigen<f64, Const<2>> {
        let free = |at: usize| self.free_gradient(&self.slip[at], X_PARTNER);
        let product =
            |i: usize, j: usize| -> f64 { free(i).zip(free(j)).map(|(a, b)| a * b).sum() };
        Matrix2::new(product(0, 0), product(0, 1), product(1, 0), product(1, 1)).symmetric_eigen()
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
