//! Unknowns, memory and time of a run.
//!
//! The linear systems of models up to [`COUNTED`] nodes are analysed, unless their contact takes
//! long to set up, as where many facets lie opposite to one. Beyond, factors have about as many
//! entries and operations as nested dissection gives on blocks of `n` unknowns, and the
//! iterative solver takes what it took on a million:
//!
//! ```text
//! direct      180 MB (n/2e4)^(4/3),  1.3e10 (n/2e4)^2 operations
//! iterative   5 kB n,                4.6e4 n operations
//! ```
//!
//! Time is that of six iterations an increment, with the fewest increments, at 4e9
//! operations a second.

use striae_contact::{initial::Fit, opposite::Opposite};
use striae_mesh::significant;
use striae_model::{
    Backend, ContactSurface, Model, PairId,
    initial::{opposite, other_name},
};
use striae_output::available_bytes;
use striae_solve::{
    drive::fewest_increments,
    newton::{Analysis, Estimate, estimate},
    problem::Problem,
};

use super::{Advice, Topic};
use crate::error::Error;

/// Nodes up to which the linear system is analysed.
const COUNTED: usize = 60_000;
/// Unknowns from which on the solver that chooses by cost iterates.
const ITERATED: usize = 450_000;
/// Memory for the choice of the unknowns of a pair from which on it takes long.
const CROWDED: f64 = 1.5e9;
/// Iterations in an increment.
const ITERATIONS: f64 = 6.0;
/// Memory by formula over that which suffices.
const UNCERTAIN: f64 = 1.5;
/// Operations a second.
const PACE: f64 = 4e9;

/// Estimated cost of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// Unknowns of a linear system.
    pub unknowns: usize,
    /// Memory at its highest, in bytes.
    pub bytes: f64,
    /// Operations of a factorisation or solution.
    pub operations: f64,
    /// Increments, if none has to be cut.
    pub increments: f64,
}

impl Cost {
    /// By formula, in no time.
    pub fn estimated(model: &Model) -> Self {
        let unknowns = unknowns(model);
        let n = unknowns as f64;
        let iterates = match model.solver.backend {
            Backend::Iterative => true,
            Backend::Condensed => unknowns > ITERATED,
            Backend::Multifrontal | Backend::Faer | Backend::Mumps => false,
        };
        let scale = n / 2e4;
        let (bytes, operations) = match iterates {
            true => (5e3 * n, 4.6e4 * n),
            false => (180e6 * scale.powf(4.0 / 3.0), 1.3e10 * scale * scale),
        };
        Self {
            unknowns,
            bytes,
            operations,
            increments: increments(model),
        }
    }

    /// Checks that the memory suffices, as far as a formula can tell.
    ///
    /// # Errors
    /// Returns [`Error::Memory`] if it certainly does not.
    pub fn fits(&self, available: f64) -> Result<(), Error> {
        if self.bytes <= UNCERTAIN * available {
            return Ok(());
        }
        Err(Error::Memory {
            unknowns: self.unknowns,
            needed: self.bytes,
            available,
        })
    }

    /// Seconds of a run.
    pub fn seconds(&self) -> f64 {
        self.increments * ITERATIONS * self.operations / PACE
    }
}

/// Displacements of all nodes, and tractions of half the nodes of contact surfaces.
fn unknowns(model: &Model) -> usize {
    let nodes: usize = model.bodies.iter().map(|of| of.mesh.positions.len()).sum();
    let sides = model.pairs.iter().flat_map(|pair| [&pair.a, &pair.b]);
    let facets: usize = sides
        .map(|side| match side {
            ContactSurface::Deformable { faces, .. } => faces.len(),
            ContactSurface::Rigid(_) | ContactSurface::Itself => 0,
        })
        .sum();
    3 * nodes + 3 * facets / 2
}

fn increments(model: &Model) -> f64 {
    let steps = 0..model.steps.len();
    steps.map(|step| fewest_increments(model, step)).sum()
}

/// Notes unknowns, memory and time.
pub(super) fn look(model: &Model, fits: &[Option<Fit>], advice: &mut Advice) {
    let nodes: usize = model.bodies.iter().map(|of| of.mesh.positions.len()).sum();
    let is_crowded = crowded(model, fits, advice);
    if nodes > COUNTED || is_crowded {
        let cost = Cost::estimated(model);
        let Cost {
            unknowns,
            bytes,
            operations,
            ..
        } = cost;
        advice.note(
            Topic::Cost,
            "",
            format!(
                "about {unknowns} unknowns; estimated by formula, a solution takes about {:.1} GB and {operations} operations",
                bytes / 1e9,
        operations = significant(operations, 2)),
        );
        time(&cost, advice);
        memory(&cost, advice);
        return;
    }
    let problem = match Problem::new(model.clone()) {
        Ok(problem) => problem,
        Err(error) => return advice.fault(Topic::Shape, "", error.to_string()),
    };
    match estimate(&problem) {
        Ok(estimate) => counted(model, &estimate, advice),
        Err(reason) => {
            let text = format!("the undeformed state cannot be evaluated: {reason}");
            advice.fault(Topic::Cost, "", text);
        }
    }
}

/// Warns of pairs with many facets opposite to one; true where there is one.
fn crowded(model: &Model, fits: &[Option<Fit>], advice: &mut Advice) -> bool {
    let mut found = false;
    for (index, fit) in fits.iter().enumerate() {
        let (pair, id) = (&model.pairs[index], PairId(index));
        let opposite = fit.as_ref().and_then(|fit| opposite(model, id, fit));
        let Some(opposite) = opposite.filter(|opposite| opposite.total > CROWDED) else {
            continue;
        };
        found = true;
        let Opposite {
            side,
            at,
            count,
            total,
            ..
        } = opposite;
        let [fine, coarse] = [side, side.opposite()].map(|side| other_name(model, id, side));
        let text = format!(
            "pair `{}`: {count} facets of `{fine}` lie opposite one facet of `{coarse}`, at {}; contact of facets of such different sizes is slow and takes up to {:.1} GB; refine `{coarse}` there, or make it a rigid surface if it hardly deforms",
            pair.name,
            striae_mesh::place(&at),
            total / 1e9
        );
        advice.warn(Topic::Cost, &pair.name, text);
    }
    found
}

fn counted(model: &Model, estimate: &Estimate, advice: &mut Advice) {
    let Estimate {
        unknowns,
        analysis,
        others,
    } = estimate;
    let megabytes = |analysis: &Analysis| {
        let megabytes = analysis.cost.peak_bytes as f64 / 1e6;
        format!(
            "{megabytes:.1} MB and {} operations",
            significant(analysis.cost.flops, 2)
        )
    };
    let others = others.iter();
    let others = others.map(|other| format!("; by {}: {}", other.method, megabytes(other)));
    advice.note(
        Topic::Cost,
        "",
        format!(
            "unknowns {unknowns} at the start; a factorisation ({}) takes about {}{}",
            analysis.method,
            megabytes(analysis),
            others.collect::<String>()
        ),
    );
    let cost = Cost {
        unknowns: *unknowns,
        bytes: analysis.cost.peak_bytes as f64,
        operations: analysis.cost.flops,
        increments: increments(model),
    };
    time(&cost, advice);
    memory(&cost, advice);
}

fn memory(cost: &Cost, advice: &mut Advice) {
    let Some(available) = available_bytes().filter(|available| cost.bytes > *available) else {
        return;
    };
    let text = format!(
        "a run takes about {:.1} GB of memory, but only {:.1} GB are available here",
        cost.bytes / 1e9,
        available / 1e9
    );
    advice.warn(Topic::Cost, "", text);
}

fn time(cost: &Cost, advice: &mut Advice) {
    let seconds = cost.seconds();
    let time = match seconds {
        ..1.0 => "less than a second".to_owned(),
        ..120.0 => format!("about {seconds:.0} s"),
        ..7200.0 => format!("about {:.0} min", seconds / 60.0),
        _ => format!("about {:.0} h", seconds / 3600.0),
    };
    let text = format!(
        "at least {} increments; with six iterations each, the linear systems take {time}",
        cost.increments
    );
    advice.note(Topic::Cost, "", text);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_beyond_memory_is_refused_by_name() {
        let cost = Cost {
            unknowns: 3_000_000,
            bytes: 15e9,
            operations: 1.4e11,
            increments: 10.0,
        };
        assert!(cost.fits(11e9).is_ok());
        let refused = cost.fits(8e9).expect_err("too much").to_string();
        assert!(
            refused.contains("3000000 unknowns take about 15.0 GB, but only 8.0 GB are available")
        );
        assert_eq!(cost.seconds(), 10.0 * 6.0 * 1.4e11 / 4e9);
    }
}
