//! Factors of friction at the kept nodes, and their states.
//!
//! A factor, by healing or of one's own, is asked for at all kept nodes of a pair at once: with the
//! pressure that bounds friction, the slip rate, normal and textures now, and with slip, state and
//! position at the start of the increment. Where it goes with the slip rate it is asked for at
//! rest and in fast slip, too, which the rows of nodes need that turn around or begin to slip.

use striae_law::friction::{Factor, FactorFailure, FactorPoints, Friction};
use striae_mesh::Vec3;

use crate::{
    configuration::Configuration,
    factor_states::FactorStates,
    frame::Frames,
    history::History,
    kinematics::Kinematics,
    selection::Selection,
    side::Side,
    slip_rate::SlipRates,
    texture::Textures,
    tracked::Tracked,
    unknowns::{NodeResult, Status, Tractions},
};

/// Factors at a kept node.
#[derive(Clone, Copy, Debug)]
pub struct NodeFactor {
    /// At the present slip rate.
    pub present: Factor,
    /// At rest.
    pub at_rest: Factor,
    /// In fast slip.
    pub fast: Factor,
}

/// Conditions under which states evolve.
#[derive(Clone, Debug, PartialEq)]
pub struct Evolving {
    /// Duration of the increment; zero where it has none.
    elapsed: f64,
    /// Time at its end.
    time: f64,
    /// Positions of the surface nodes at its start, by side; none of a rigid side.
    positions: [Vec<Vec3>; 2],
}

/// Quantities that factors depend on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen<'a> {
    pub(crate) frames: &'a Frames,
    pub(crate) textures: &'a Textures,
    pub(crate) rates: &'a SlipRates,
    pub(crate) kinematics: &'a [Kinematics],
}

/// Factors of all kept nodes, empty if the law has none.
///
/// # Errors
/// When a factor is negative or not finite, or its law has failed.
pub(crate) fn factors(
    configuration: &Configuration,
    start: &Configuration,
    friction: &Friction,
    (selection, tractions, histories): (&Selection, &Tractions, &[History]),
    seen: Seen,
) -> Result<Vec<NodeFactor>, FactorFailure> {
    let Some(law) = friction.factor() else {
        return Ok(Vec::new());
    };
    let initial = law.initial_state();
    let mut points = FactorPoints {
        elapsed: duration(configuration),
        time: configuration.time,
        ..FactorPoints::default()
    };
    let kept = selection.kept().iter().zip(seen.kinematics);
    for ((kept, kinematics), history) in kept.zip(histories) {
        let (side, node) = kept.place();
        let [p, ..] = tractions.nodes[side][node];
        let frame = seen.frames[side][node].as_ref();
        let textures = &seen.textures[side][node];
        let vector =
            |texture: &Option<Tracked>| texture.as_ref().map_or(Vec3::zeros(), |t| t.value);
        points
            .pressure
            .push(kinematics.bounding_pressure(p).max(0.0));
        points.slip_rate.push(seen.rates[side][node].value);
        points.accumulated_slip.push(history.slip);
        points.position.push(start.side(side).x[node]);
        points
            .normal
            .push(frame.map_or(Vec3::z(), |frame| frame.n.value));
        points.own.push(vector(&textures.own));
        points.opposite.push(vector(&textures.opposite));
        let states = (0..initial.len()).map(|at| {
            history
                .of(|(side, node)| state(tractions, law.name(), &initial, side, node.index())[at])
        });
        points.states.extend(states);
    }
    let count = points.len();
    let goes_with_rate = friction.depends_on_rate();
    let fast = law.fast(points.elapsed);
    let asked = match goes_with_rate {
        true => {
            let [at_rest, fast] = [0.0, fast].map(|rate| points.at_rates(|_| rate));
            points.and(&at_rest).and(&fast)
        }
        false => points,
    };
    let found = friction.factors(&asked)?.unwrap_or_default();
    let of_node = |at: usize| match goes_with_rate {
        true => NodeFactor {
            present: found[at],
            at_rest: found[count + at],
            fast: found[2 * count + at],
        },
        false => NodeFactor {
            present: found[at],
            at_rest: found[at],
            fast: found[at],
        },
    };
    Ok((0..count).map(of_node).collect())
}

impl Evolving {
    /// From the start of an increment, if friction has a factor with a state.
    pub(crate) fn new(
        configuration: &Configuration,
        start: &Configuration,
        friction: &Friction,
    ) -> Option<Self> {
        let law = friction.factor()?;
        let of_side = |side: Side| {
            let snapshot = start.sides[side].as_ref();
            snapshot.map_or_else(Vec::new, |snapshot| snapshot.x.clone())
        };
        (!law.initial_state().is_empty()).then(|| Self {
            elapsed: duration(configuration),
            time: configuration.time,
            positions: Side::BOTH.map(of_side),
        })
    }
}

impl Tractions {
    /// Lets the states of a factor evolve over an increment that has converged, before its slip is
    /// [accumulated](Self::accumulate); those of open nodes rest. A law that fails ends the run
    /// with the next increment, so that its states may stay.
    pub fn evolve_factor(
        &mut self,
        nodes: &[Vec<NodeResult>; 2],
        friction: &Friction,
        evolving: &Evolving,
    ) {
        let Some(law) = friction.factor() else {
            return;
        };
        let initial = law.initial_state();
        let count = initial.len();
        let mut values = Side::BOTH.map(|side| {
            let of_node = |node: usize| state(self, law.name(), &initial, side, node);
            (0..nodes[side].len()).flat_map(of_node).copied().collect()
        });
        let mut points = FactorPoints {
            elapsed: evolving.elapsed,
            time: evolving.time,
            ..FactorPoints::default()
        };
        let mut places = Vec::new();
        for side in Side::BOTH {
            let of_side: &Vec<f64> = &values[side];
            for (node, result) in nodes[side].iter().enumerate() {
                if result.status == Status::Open {
                    continue;
                }
                let rate = match evolving.elapsed > 0.0 {
                    true => result.slip.norm() / evolving.elapsed,
                    false => 0.0,
                };
                points.pressure.push(result.pressure);
                points.slip_rate.push(rate);
                points.accumulated_slip.push(self.accumulated[side][node]);
                points.position.push(evolving.positions[side][node]);
                points.normal.push(result.normal);
                points.own.push(Vec3::zeros());
                points.opposite.push(Vec3::zeros());
                let own = count * node..count * (node + 1);
                points.states.extend(&of_side[own.clone()]);
                places.push((side, own));
            }
        }
        let found = law.states_after(&points).unwrap_or_default();
        if found.len() == points.states.len() && count > 0 {
            for ((side, own), after) in places.into_iter().zip(found.chunks_exact(count)) {
                values[side][own].copy_from_slice(after);
            }
        }
        self.factors = Some(FactorStates {
            law: law.name().to_owned(),
            count,
            values,
        });
    }
}

/// Duration of an increment, zero where it has none.
fn duration(configuration: &Configuration) -> f64 {
    match configuration.elapsed.is_finite() {
        true => configuration.elapsed,
        false => 0.0,
    }
}

/// State of a node, that at the start where the law has none there yet.
fn state<'a>(
    tractions: &'a Tractions,
    law: &str,
    initial: &'a [f64],
    side: Side,
    node: usize,
) -> &'a [f64] {
    let count = initial.len();
    let known = tractions.factors.as_ref();
    let known = known.filter(|states| states.law == law && states.count == count);
    known
        .and_then(|states| states.values[side].get(count * node..count * (node + 1)))
        .unwrap_or(initial)
}
