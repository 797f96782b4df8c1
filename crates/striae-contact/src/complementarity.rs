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
use striae_surface::{
    facet::Shape,
    scalar::{combination, constant3, dot},
};

use crate::{
    configuration::Configuration,
    coverage::Place,
    frame::{FOLLOW, Frame, LostProjection},
    projection::{Margin, differentiated, differentiated_rigid},
    selection::Partner,
    slip_rate::rate,
    table_1::Corrector,
    term::{Field, Lanes, LocalTerm, Row, Source, gradient, variable, variable3, variables3},
    texture::NodeTextures,
    traction::{on_lanes, push_textures},
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
type D = DualSVec64<N>;
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
        [(Field::Gap(size), g, gradient(&state.gap)), first, second]
    };
    let first = configuration
        .pair
        .numbering()
        .traction(node.side, node.node);
    let numbered: Vec<Row<N>> = rows
        .iter()
        .enumerate()
        .map(|(at, (field, residual, row))| (first + at as u32, *field, *residual, *row))
        .collect();
    Ok((LocalTerm::from_lanes(&state.lanes, &numbered), result))
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
    gap: D,
    slipped: bool,
    before: Status,
    /// Components of `du`.
    slip: [D; 2],
    /// Components of `K^-1 du`.
    turned: [D; 2],
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
        let x: Vector3<D> = variable3(&own.x[index], 0);
        let n: Vector3<D> = variable3(&node.frame.n.value, 3);
        let t: [Vector3<D>; 2] = [
            variable3(&node.frame.t[0].value, 6),
            variable3(&node.frame.t[1].value, 9),
        ];
        let reach = FOLLOW * configuration.reach(side, node.node);
        let contact = configuration
            .contact(side, node.node, reach, Margin::Extrapolated)
            .ok_or(LostProjection {
                side,
                node: node.node,
            })?;
        let gap = match (contact.place, configuration.plane()) {
            (_, Some((point, normal))) => {
                opposite(None, &mut lanes, X_OPPOSITE);
                dot(&(x - constant3(&point)), &constant3(&normal))
            }
            (Place::Facet(hit), None) if configuration.pair.is_rigid() => {
                opposite(None, &mut lanes, X_OPPOSITE);
                differentiated_rigid(configuration.side(1), &hit, &x).0[2]
            }
            (Place::Facet(hit), None) => {
                let target = configuration.side(1 - side);
                let corners = target.corners(hit.facet);
                opposite(Some(corners), &mut lanes, X_OPPOSITE);
                let positions = variables3(&target.corner_positions(hit.facet), X_OPPOSITE);
                differentiated(Shape::of(&corners), &hit, &x, &n, &positions)[2]
            }
            (Place::Plane(_), None) => unreachable!("only a plane has places on a plane"),
        };
        let partner = match node.partner {
            Partner::Rigid(point) => {
                opposite(None, &mut lanes, X_PARTNER);
                constant3(&configuration.placement.point(&point))
            }
            Partner::Corners(corners, weights) => {
                opposite(Some(corners), &mut lanes, X_PARTNER);
                let target = configuration.side(1 - side);
                let positions = corners.map(|corner| target.x[corner as usize]);
                combination(&weights.map(D::from), &variables3(&positions, X_PARTNER))
            }
        };
        lanes.push(Source::Unknowns {
            first: numbering.traction(side, node.node),
            count: 3,
        });
        push_textures(&mut lanes, node.textures);
        let relative = x - partner;
        let kernel = configuration
            .pair
            .friction
            .kernel(&n, &on_lanes(node.textures, TEXTURES));
        let turned = kernel.k_inverse * relative;
        Ok(Self {
            lanes,
            free,
            gap,
            slipped: node.slipped,
            before: node.before,
            slip: [dot(&t[0], &relative), dot(&t[1], &relative)],
            turned: [dot(&t[0], &turned), dot(&t[1], &turned)],
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
    fn free_gradient(&self, row: &D, opposite: usize) -> Vec<f64> {
        let row = gradient(row);
        (0..3)
            .chain(opposite..opposite + 12)
            .map(|lane| if self.free[lane] { row[lane] } else { 0.0 })
            .collect()
    }

    fn is_free(&self, row: &D, opposite: usize) -> bool {
        self.free_gradient(row, opposite)
            .iter()
            .any(|d| d.abs() > 1e-9)
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
        let pressure: D = variable(p, TRACTION);
        let z: [D; 2] = [variable(z1, TRACTION + 1), variable(z2, TRACTION + 2)];
        let friction = &configuration.pair.friction;
        if friction.cap(1.0, 0.0) == 0.0 {
            return (
                Status::Slip,
                z.map(|z| (Field::Traction, z.re, gradient(&z))),
            );
        }
        let varpi = friction.cap(pressure, rate(&self.slip) / configuration.elapsed);
        let y = [z[0] + self.turned[0] * r, z[1] + self.turned[1] * r];
        let length = y[0].re.hypot(y[1].re);
        if iteration == Iteration::First {
            return if self.slipped && z1.hypot(z2) > 0.5 * varpi.re {
                (Status::Slip, self.continued_slip(&z, &varpi, size))
            } else {
                (Status::Stick, self.stick(&z, size))
            };
        }
        if let Iteration::Corrected(corrector) = iteration {
            let radius = varpi * corrector.inflation.factor();
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

    /// Slip that goes on in the direction of `z`: `|z| = varpi` and no slip
    /// across, or no `z` across where the node cannot move that way.
    fn continued_slip(&self, z: &[D; 2], varpi: &D, size: f64) -> [TangentialRow; 2] {
        let direction = Vector2::new(z[0].re, z[1].re).normalize();
        let along = z[0] * direction.x + z[1] * direction.y - *varpi;
        let across = |v: &[D; 2]| v[1] * direction.x - v[0] * direction.y;
        let turned = across(&self.turned);
        let second = if self.is_free(&turned, X_PARTNER) {
            (Field::Stick(size), turned.re, gradient(&turned))
        } else {
            let z_across = across(z);
            (Field::Traction, z_across.re, gradient(&z_across))
        };
        [(Field::Traction, along.re, gradient(&along)), second]
    }

    /// Squared mobility of the slip in its principal directions: eigenvalues of
    /// the products of its derivatives by the free positions.
    fn mobility(&self) -> SymmetricEigen<f64, Const<2>> {
        let free = [0, 1].map(|at| self.free_gradient(&self.slip[at], X_PARTNER));
        let product =
            |i: usize, j: usize| -> f64 { free[i].iter().zip(&free[j]).map(|(a, b)| a * b).sum() };
        Matrix2::new(product(0, 0), product(0, 1), product(1, 0), product(1, 1)).symmetric_eigen()
    }

    /// `du = 0`, with `z = 0` in directions in which the node cannot move.
    fn stick(&self, z: &[D; 2], size: f64) -> [TangentialRow; 2] {
        let row = |field: Field, value: D| (field, value.re, gradient(&value));
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
            row(field, of[0] * q[0] + of[1] * q[1])
        })
    }
}

fn slip(z: &[D; 2], y: &[D; 2], varpi: &D) -> [TangentialRow; 2] {
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
        let row = z[at] - y[0] * m[(at, 0)] - y[1] * m[(at, 1)] - *varpi * direction[at];
        let residual = zv[at] - radius * direction[at];
        (Field::Traction, residual, gradient(&row))
    })
}
