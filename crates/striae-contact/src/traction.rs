//! Nodal friction tractions `tau` from the unknowns, with their derivatives.
//!
//! At kept nodes `tau = -(L z + varpi eta)`, or what else the law makes of `z`, with `varpi`
//! at the present slip rate. Friction that depends on rate and state is always on the slip
//! surface: there `varpi = |z|`, which needs no rate, of which next to rest round-off is left.

use nalgebra::{Matrix3, Vector3};
use num_dual::DualSVec64;
use rayon::prelude::*;
use striae_law::friction::{Factor, Friction, Textures as LawTextures};
use striae_mesh::Vec3;
use striae_surface::{node::SurfaceNode, scalar::constant3};

use crate::{
    configuration::Configuration,
    factors::NodeFactor,
    frame::{Frame, Frames},
    history::History,
    kinematics::{Kinematics, Pressure},
    selection::Selection,
    side::Side,
    slip_rate::SlipRates,
    term::{Lanes, Source, add_block, gradient, parts, variable, variable3},
    texture::{NodeTextures, Textures},
    tracked::Tracked,
    unknowns::Tractions,
};

/// Nodal friction tractions by side; zero without derivatives at nodes that are not kept
/// and without friction.
pub type NodalTractions = [Vec<Tracked>; 2];

/// Quantities that tractions depend on at every node.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings<'a> {
    /// Friction law.
    pub friction: &'a Friction,
    /// Nodal frames.
    pub frames: &'a Frames,
    /// Textures of both sides.
    pub textures: &'a Textures,
    /// Slip rates.
    pub rates: &'a SlipRates,
    /// Kinematics of the kept nodes, for the pressures that bound friction.
    pub kinematics: &'a [Kinematics],
    /// Factors of friction at the kept nodes, if there are some.
    pub factors: &'a [NodeFactor],
    /// Histories of the kept nodes, if there is friction.
    pub histories: &'a [History<'a>],
}

/// Friction tractions of all kept nodes.
pub fn nodal_tractions(
    configuration: &Configuration,
    selection: &Selection,
    surroundings: &Surroundings,
    tractions: &Tractions,
) -> NodalTractions {
    let friction = surroundings.friction;
    let frictionless = friction.is_frictionless();
    Side::BOTH.map(|side| {
        (0..selection.nodes(side))
            .into_par_iter()
            .with_min_len(16)
            .map(SurfaceNode::new)
            .map(|node| match &surroundings.frames[side][node] {
                Some(frame) if selection.is_kept(side, node) && !frictionless => {
                    let first = configuration.pair.numbering().traction(side, node);
                    let unknowns = tractions.nodes[side][node];
                    let k = selection.basis.index[side][node].expect("the node is kept");
                    let kinematics = &surroundings.kinematics[k as usize];
                    nodal_traction(
                        surroundings,
                        frame,
                        (side, node),
                        (first, unknowns, surroundings.histories[k as usize].slip),
                        (kinematics, surroundings.factors.get(k as usize)),
                    )
                }
                _ => Tracked::default(),
            })
            .collect()
    })
}

fn nodal_traction(
    surroundings: &Surroundings,
    frame: &Frame,
    (side, node): (Side, SurfaceNode),
    (first, unknowns, accumulated): (u32, [f64; 3], f64),
    (kinematics, factor): (&Kinematics, Option<&NodeFactor>),
) -> Tracked {
    let friction = surroundings.friction;
    let textures = &surroundings.textures[side][node];
    let rate = &surroundings.rates[side][node];
    let [t1, t2] = &frame.t;
    let [p, z1, z2] = unknowns;
    let vector = in_frame(frame, [z1, z2]);
    let pressure = kinematics.bounding_pressure(p);
    let creeps = friction.rate_and_state().is_some();
    let cap = match creeps {
        true => Cap::on_surface(&vector),
        false => {
            let history = (accumulated, factor.map(|factor| &factor.present));
            Cap::new(friction, history, pressure, rate.value)
        }
    };
    let response = if *textures == NodeTextures::default() {
        Response::new::<4>(friction, frame, textures, cap, &vector)
    } else {
        Response::new::<13>(friction, frame, textures, cap, &vector)
    };
    let by_vector = match vector.try_normalize(0.0) {
        Some(direction) if creeps => response.by_vector + response.by_cap * direction.transpose(),
        _ => response.by_vector,
    };
    let mut gradient = [[0.0; 3]; 20];
    let (by_own, by_mean) = match kinematics.pressure {
        Pressure::AtNode => (response.by_pressure, Vec3::zeros()),
        Pressure::AtPoints(_) => (Vec3::zeros(), response.by_pressure),
    };
    let by_unknowns = [by_own, by_vector * t1.value, by_vector * t2.value];
    add_block(&mut gradient, 0, &Matrix3::from_columns(&by_unknowns));
    add_block(&mut gradient, 3, &(by_vector * z1));
    add_block(&mut gradient, 6, &(by_vector * z2));
    gradient[9..18].copy_from_slice(&response.by_surroundings);
    gradient[18] = response.by_rate.into();
    gradient[19] = by_mean.into();
    let mut lanes = Lanes::default();
    lanes.push(Source::Unknowns { first, count: 3 });
    lanes.push(Source::Vector(&t1.jacobian));
    lanes.push(Source::Vector(&t2.jacobian));
    lanes.push(Source::Vector(&frame.n.jacobian));
    push_textures(&mut lanes, textures);
    lanes.push(Source::Scalar(&rate.gradient));
    // Without an offset of the slip surface friction does not depend on the pressure but by `z`.
    lanes.push(match &kinematics.pressure {
        Pressure::AtPoints(supported) if by_mean != Vec3::zeros() => {
            Source::Scalar(&supported.mean.gradient)
        }
        Pressure::AtNode | Pressure::AtPoints(_) => Source::Constant(1),
    });
    Tracked {
        value: response.tau,
        jacobian: lanes.jacobian(&gradient),
    }
}

/// `varpi` with its derivatives by pressure and slip rate.
#[derive(Clone, Copy, Debug)]
pub struct Cap {
    /// `varpi`.
    pub value: f64,
    /// `d varpi / d p`.
    pub by_pressure: f64,
    /// `d varpi / d v`.
    pub by_rate: f64,
    /// Derivatives by normal and textures.
    pub by_surroundings: [f64; 9],
}

impl Cap {
    /// Of a vector `z` on the slip surface; depends on nothing else.
    fn on_surface(z: &Vec3) -> Self {
        Self {
            value: z.norm(),
            by_pressure: 0.0,
            by_rate: 0.0,
            by_surroundings: [0.0; 9],
        }
    }

    /// After an accumulated slip, at a pressure and a slip rate, with the factor there if friction
    /// has one.
    pub fn new(
        friction: &Friction,
        (accumulated, factor): (f64, Option<&Factor>),
        pressure: f64,
        rate: f64,
    ) -> Self {
        let Some(factor) = factor else {
            let (pressure, rate) = (variable(pressure, 0), variable(rate, 1));
            let varpi: DualSVec64<2> = friction.cap_after(accumulated, pressure, rate);
            let [by_pressure, by_rate] = gradient(&varpi);
            return Self {
                value: varpi.re,
                by_pressure,
                by_rate,
                by_surroundings: [0.0; 9],
            };
        };
        let (pressure, rate) = (variable(pressure, 0), variable(rate, 1));
        let value = variable(factor.value, 2);
        let varpi: DualSVec64<3> = friction.cap_with(accumulated, pressure, rate, value);
        let [by_pressure, by_rate, by_factor] = gradient(&varpi);
        Self {
            value: varpi.re,
            by_pressure: by_pressure + by_factor * factor.by_pressure,
            by_rate: by_rate + by_factor * factor.by_slip_rate,
            by_surroundings: factor.by_surroundings.map(|by| by_factor * by),
        }
    }
}

/// A friction traction with its derivatives by what the law sees.
struct Response {
    tau: Vec3,
    by_vector: Matrix3<f64>,
    by_cap: Vec3,
    by_pressure: Vec3,
    by_rate: Vec3,
    /// Lane by lane, by normal and textures.
    by_surroundings: [[f64; 3]; 9],
}

impl Response {
    /// The law over `N` lanes: `z`, `varpi` and, if textures are looked at, the normal
    /// and the textures.
    fn new<const N: usize>(
        friction: &Friction,
        frame: &Frame,
        textures: &NodeTextures,
        cap: Cap,
        z: &Vec3,
    ) -> Self {
        let (n, textures) = if N > 4 {
            (variable3(&frame.n.value, 4), on_lanes(textures, 7))
        } else {
            (constant3(&frame.n.value), LawTextures::none())
        };
        let z: Vector3<DualSVec64<N>> = variable3(z, 0);
        let kernel = friction.kernel(&n, &textures);
        let (tau, gradient) = parts(&kernel.traction(variable(cap.value, 3), &z));
        let by_cap = Vec3::from(gradient[3]);
        let mut by_surroundings = [[0.0; 3]; 9];
        by_surroundings[..N - 4].copy_from_slice(&gradient[4..]);
        for (sum, by) in by_surroundings.iter_mut().zip(&cap.by_surroundings) {
            for (sum, by_cap) in sum.iter_mut().zip(&gradient[3]) {
                *sum += by_cap * by;
            }
        }
        Self {
            tau,
            by_vector: Matrix3::from_fn(|row, column| gradient[column][row]),
            by_cap,
            by_pressure: by_cap * cap.by_pressure,
            by_rate: by_cap * cap.by_rate,
            by_surroundings,
        }
    }
}

/// Textures of a node as variables from lane `lane` on.
pub fn on_lanes<const N: usize>(
    textures: &NodeTextures,
    lane: usize,
) -> LawTextures<DualSVec64<N>> {
    let variable = |texture: &Option<Tracked>, lane: usize| {
        texture
            .as_ref()
            .map(|texture| variable3(&texture.value, lane))
    };
    LawTextures {
        own: variable(&textures.own, lane),
        opposite: variable(&textures.opposite, lane + 3),
    }
}

/// Appends the six lanes of the textures of a node.
pub fn push_textures<'a>(lanes: &mut Lanes<'a>, textures: &'a NodeTextures) {
    for texture in [&textures.own, &textures.opposite] {
        lanes.push(match texture {
            Some(texture) => Source::Vector(&texture.jacobian),
            None => Source::Constant(3),
        });
    }
}

/// `sum_axis component t_axis`.
pub fn in_frame(frame: &Frame, components: [f64; 2]) -> Vec3 {
    frame.t[0].value * components[0] + frame.t[1].value * components[1]
}
