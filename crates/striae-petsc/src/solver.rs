//! The solver of systems in parts.

use crate::{
    binding::Library,
    borders::Borders,
    choice::Choice,
    direct::Direct,
    error::{Error, agreed},
    iterative::{Iterative, Shared},
    nodes::{Nodes, is_nodal},
    product::Product,
    ranks::Ranks,
};
use std::sync::Arc;
use striae_condensed::{
    Analysis, Factored, FallBack, Method, Numbering, Partition, Tangent, TangentSolver,
};
use striae_solve::team::Team;
use striae_sparse::{Cost, SolveError, SolveReport, check_finite};

/// Unknowns up to which MUMPS is taken by cost.
const FEW: usize = 100_000;
/// Unknowns a rank up to which it takes over where FGMRES fails.
const MANY: usize = 450_000;
/// Factorisations that MUMPS makes before FGMRES is tried again.
const REST: usize = 10;

/// A solver of systems whose parts the ranks hold.
#[derive(Debug)]
pub struct PetscSolver {
    choice: Choice,
    system: Option<System>,
    /// Factorisations for which FGMRES is not tried again after it failed, and why.
    rest: usize,
    failure: Option<FallBack>,
    ranks: Ranks,
}

/// Analysed system and its factors.
#[derive(Debug)]
struct System {
    partition: Partition,
    numbering: Numbering,
    /// Inner numbers, where the iterative solver is tried.
    nodes: Option<Nodes>,
    borders: Borders,
    /// Borders that the tangent touches, and its factors.
    factored: Option<(Borders, Made)>,
}

/// Factors.
#[derive(Debug)]
enum Made {
    Iterative(Box<Iterative>),
    Direct(Direct),
}

impl PetscSolver {
    /// A solver that has seen no matrix yet.
    pub fn new(ranks: &Ranks, choice: Choice) -> Self {
        Self {
            choice,
            system: None,
            rest: 0,
            failure: None,
            ranks: ranks.clone(),
        }
    }

    /// Returns whether MUMPS may take over where FGMRES fails.
    fn has_fall_back(&self, unknowns: usize) -> bool {
        unknowns <= MANY * self.ranks.size()
    }

    /// Factors with the solver that is chosen.
    fn make(&mut self, part: &Tangent) -> Result<(Borders, Made), SolveError> {
        let system = self.system.as_ref().ok_or(SolveError::NotAnalysed)?;
        let library = self.ranks.library();
        let mut borders = system.touched(library, part)?;
        let mut shared = system.shared(&self.ranks, part, &mut borders);
        let nodes = system.nodes.as_ref().filter(|_| self.rest == 0);
        if let Some(nodes) = nodes {
            match Iterative::new(&mut shared, nodes) {
                Ok(Some(made)) => {
                    let made = Made::Iterative(Box::new(made));
                    self.failure = None;
                    return Ok((borders, made));
                }
                failed if !self.has_fall_back(system.numbering.count) => {
                    let indefinite = SolveError::NotPositiveDefinite {
                        unknown: 0,
                        pivot: 0.0,
                    };
                    return Err(failed.err().unwrap_or(indefinite));
                }
                _ => {
                    self.failure = Some(FallBack::NoPreconditioner);
                    self.rest = REST;
                }
            }
        }
        self.rest = self.rest.saturating_sub(1);
        let made = Made::Direct(Direct::new(&mut shared)?);
        Ok((borders, made))
    }

    /// Solves for own unknowns.
    fn solve_own(
        &mut self,
        part: &Tangent,
        (rhs, x): (&[f64], &mut [f64]),
        reduction: f64,
    ) -> Result<SolveReport, SolveError> {
        let ranks = self.ranks.clone();
        let system = self.system.as_mut().ok_or(SolveError::NotAnalysed)?;
        let (borders, made) = system.factored.as_mut().ok_or(SolveError::NotFactored)?;
        let first = system.numbering.own.start;
        let mut product = Product::new(part, borders);
        let iterative = match made {
            Made::Direct(direct) => return direct.solve(&mut product, &ranks, (rhs, x), reduction),
            Made::Iterative(iterative) => iterative,
        };
        let solved = iterative.solve(&mut product, &ranks, (rhs, x, first), reduction);
        let unknowns = system.numbering.count;
        if solved.is_ok() || !self.has_fall_back(unknowns) {
            return solved;
        }
        self.failure = Some(FallBack::NotConverged);
        self.rest = REST;
        let system = self.system.as_mut().ok_or(SolveError::NotAnalysed)?;
        let (mut borders, _) = system.factored.take().ok_or(SolveError::NotFactored)?;
        let system = self.system.as_mut().ok_or(SolveError::NotAnalysed)?;
        let mut direct = Direct::new(&mut system.shared(&ranks, part, &mut borders))?;
        let mut product = Product::new(part, &mut borders);
        let report = direct.solve(&mut product, &ranks, (rhs, x), reduction)?;
        system.factored = Some((borders, Made::Direct(direct)));
        Ok(report)
    }

    /// Checks the matrix of this rank, as other ranks cannot.
    fn check(&self, part: &Tangent) -> Result<(), SolveError> {
        let system = self.system.as_ref().ok_or(SolveError::NotAnalysed)?;
        let is_known = system
            .partition
            .structure()
            .same_as(part.bodies.structure())
            && part.contact.unknowns() == system.partition.unknowns();
        if !is_known {
            return Err(SolveError::NotAnalysed);
        }
        let whole = |row: usize| SolveError::NotFinite {
            row: system.numbering.whole[row],
        };
        check_finite(&part.bodies).map_err(|error| match error {
            SolveError::NotFinite { row } => whole(row),
            other => other,
        })?;
        let mut contact = 0..part.contact.unknowns();
        match contact.find(|&row| part.contact.row(row).any(|(_, a)| !a.is_finite())) {
            Some(row) => Err(whole(row)),
            None => Ok(()),
        }
    }

    /// Checks the vectors of this rank.
    fn check_vectors(&self, rhs: &[f64], x: &[f64]) -> Result<(), SolveError> {
        let system = self.system.as_ref().ok_or(SolveError::NotAnalysed)?;
        system.factored.as_ref().ok_or(SolveError::NotFactored)?;
        let expected = system.partition.unknowns();
        for found in [rhs.len(), x.len()] {
            if found != expected {
                return Err(SolveError::Length { found, expected });
            }
        }
        match rhs.iter().position(|b| !b.is_finite()) {
            Some(row) => Err(SolveError::NotFinite {
                row: system.numbering.whole[row],
            }),
            None => Ok(()),
        }
    }
}

impl System {
    fn touched(&self, library: &Arc<Library>, part: &Tangent) -> Result<Borders, Error> {
        self.borders.touched(library, &self.numbering, part)
    }

    fn shared<'a>(
        &'a self,
        ranks: &'a Ranks,
        tangent: &'a Tangent,
        borders: &'a mut Borders,
    ) -> Shared<'a> {
        Shared {
            ranks,
            partition: &self.partition,
            numbering: &self.numbering,
            tangent,
            borders,
        }
    }
}

impl TangentSolver for PetscSolver {
    fn analyse(&mut self, partition: &Partition) -> Result<Analysis, SolveError> {
        self.system = None;
        let ranks = &self.ranks;
        let numbering = partition.numbering().ok_or(SolveError::NotAnalysed);
        let numbering = agreed(ranks, numbering)?;
        let own = numbering
            .whole
            .iter()
            .filter(|whole| numbering.own.contains(whole));
        let is_whole = numbering.whole.len() == partition.unknowns()
            && own.count() == numbering.own.len()
            && numbering.count < i32::MAX as usize;
        agreed(ranks, is_whole.then_some(()).ok_or(SolveError::NotAnalysed))?;
        let mut borders = Borders::new(ranks.library(), numbering)?;
        let is_tried = match self.choice {
            Choice::Iterative => true,
            Choice::ByCost => numbering.count > FEW,
            Choice::Mumps => false,
        };
        let mut others = [f64::from(!is_nodal(partition))];
        ranks.largest(&mut others);
        let is_nodal = others[0] == 0.0;
        if !is_nodal && self.choice == Choice::Iterative {
            return Err(SolveError::NotAnalysed);
        }
        let nodes = match is_tried && is_nodal {
            true => Some(Nodes::new(ranks, partition, numbering, &mut borders)?),
            false => None,
        };
        let method = match nodes {
            Some(_) => Method::Iterative,
            None => Method::Mumps,
        };
        self.system = Some(System {
            partition: partition.clone(),
            numbering: numbering.clone(),
            nodes,
            borders,
            factored: None,
        });
        Ok(Analysis {
            cost: Cost::default(),
            method,
        })
    }

    fn factor(&mut self, part: &Tangent) -> Result<Factored, SolveError> {
        self.forget();
        agreed(&self.ranks, self.check(part))?;
        let made = self.make(part);
        let (borders, made) = agreed(&self.ranks, made)?;
        let (method, factor_entries) = match &made {
            Made::Iterative(iterative) => (Method::Iterative, iterative.entries()),
            Made::Direct(direct) => (Method::Mumps, direct.entries()),
        };
        if let Some(system) = &mut self.system {
            system.factored = Some((borders, made));
        }
        Ok(Factored {
            factor_entries,
            method,
            fall_back: self.failure,
            ..Factored::default()
        })
    }

    fn solve_to(
        &mut self,
        part: &Tangent,
        rhs: &[f64],
        x: &mut [f64],
        reduction: f64,
    ) -> Result<SolveReport, SolveError> {
        agreed(&self.ranks, self.check_vectors(rhs, x))?;
        let system = self.system.as_ref().ok_or(SolveError::NotAnalysed)?;
        let own = system.borders.own.iter();
        let own_rhs: Vec<f64> = own.map(|&unknown| rhs[unknown as usize]).collect();
        let mut own = vec![0.0; own_rhs.len()];
        let solved = self.solve_own(part, (&own_rhs, &mut own), reduction);
        let report = agreed(&self.ranks, solved)?;
        let system = self.system.as_mut().ok_or(SolveError::NotAnalysed)?;
        system.borders.spread(&own, x)?;
        Ok(report)
    }

    fn forget(&mut self) {
        if let Some(system) = &mut self.system {
            system.factored = None;
        }
    }
}
