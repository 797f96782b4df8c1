//! The condensed solver: bodies by Cholesky, contact by dense algebra.
//!
//! If the bulk is symmetric and positive definite, its interior is eliminated body by body at the
//! price of a Cholesky factorisation ([`SchurCholesky`](striae_sparse::SchurCholesky)); the contact
//! system on what was kept is solved exactly ([`Interface`](crate::interface::Interface)). Rows
//! with nothing but a diagonal (prescribed unknowns and tractions) are solved for first, and what
//! contact does not touch for now is eliminated with its body ([`Untouched`]). A bulk that is not
//! quite symmetric is taken as symmetric, and refinement makes up for it; one that is not definite
//! is refused.

mod contact;
mod substitution;
mod untouched;

use crate::{
    bulk::Body,
    entries::Kept,
    experience::FactoredInterior,
    interface::Purpose,
    partition::Partition,
    report::{Analysis, Factored, Method},
    scaling,
    tangent::Tangent,
};
use contact::ContactSystem;
use rayon::prelude::*;
use striae_sparse::{
    Cost, Equilibration, Factors, Precision, SolveError, SolveReport, gmres::Ends, refinement,
};
use substitution::Substitution;
use untouched::Untouched;

/// Time of an operation of a substitution, which waits for memory, over that of a factorisation.
const SUBSTITUTION: f64 = 5.0;
/// Not kept.
const NONE: u32 = u32::MAX;

/// Factors of the interior of every body and of the contact system.
#[derive(Debug)]
pub(crate) struct Condensed {
    partition: Partition,
    bodies: Vec<Body>,
    kept: Kept,
    /// Place of the kept unknowns of every body.
    blocks: Vec<Vec<u32>>,
    numeric: Option<Numeric>,
}

#[derive(Debug)]
struct Numeric {
    scaling: Equilibration,
    prescribed: Vec<bool>,
    precision: Precision,
    contact: ContactSystem,
}

impl Condensed {
    /// Plans the elimination of what is not kept.
    pub(crate) fn analyse(partition: &Partition) -> Result<Self, SolveError> {
        let bodies = Body::all(partition)?;
        let kept = Kept::of(partition);
        let blocks = bodies.iter().map(|body| {
            let local = body.schur.kept_unknowns().iter();
            local
                .map(|&u| kept.place(body.unknowns[u] as usize))
                .collect::<Vec<u32>>()
        });
        Ok(Self {
            blocks: blocks.collect(),
            partition: partition.clone(),
            bodies,
            kept,
            numeric: None,
        })
    }

    /// Bulk unknowns of the interface.
    pub(crate) fn interface(&self) -> usize {
        self.blocks.iter().map(Vec::len).sum()
    }

    /// Predicted cost, with a dense system on all bulk unknowns of the interface.
    pub(crate) fn analysis(&self, precision: Precision) -> Analysis {
        let order = self.interface();
        let mut sum = Cost {
            factor_entries: order * order,
            flops: self.work().0,
            peak_bytes: 2 * size_of::<f64>() * order * order,
        };
        for body in self.costs(precision) {
            sum.factor_entries += body.factor_entries;
            sum.flops += body.flops;
            sum.peak_bytes += body.peak_bytes;
        }
        Analysis {
            cost: sum,
            method: Method::Condensed,
        }
    }

    /// Operations of a dense system on all bulk unknowns of the interface, and of
    /// factoring the bodies.
    pub(crate) fn work(&self) -> (f64, f64) {
        let bodies = self.costs(Precision::Double).map(|a| a.flops);
        (2.0 / 3.0 * (self.interface() as f64).powi(3), bodies.sum())
    }

    fn costs(&self, precision: Precision) -> impl Iterator<Item = Cost> + '_ {
        self.bodies.iter().map(move |body| body.cost(precision))
    }

    /// Factors a matrix of the analysed structure, the interior in the given precision.
    pub(crate) fn factor(
        &mut self,
        tangent: &Tangent,
        precision: Precision,
    ) -> Result<Factored, SolveError> {
        self.numeric = None;
        if !self.partition.fits(tangent) {
            return Err(SolveError::NotAnalysed);
        }
        let rows = self.kept.rows(tangent)?;
        let scaling = scaling::by_diagonal(&self.partition, tangent, (&self.kept, &rows))?;
        let prescribed = prescribed(&self.partition, tangent);
        let (partition, bodies) = (&self.partition, self.bodies.par_iter_mut());
        bodies.try_for_each(|body| {
            body.factor(
                (partition, &tangent.bodies),
                &scaling,
                &prescribed,
                precision,
            )
        })?;
        let nothing = ContactSystem::default();
        self.factor_contact(rows, scaling, (prescribed, precision), nothing)
    }

    /// Makes the next matrix eliminate again what contact does not touch.
    pub(crate) fn forget_untouched(&mut self) {
        if let Some(numeric) = &mut self.numeric {
            numeric.contact = ContactSystem::default();
        }
    }

    /// Forgets the factors.
    pub(crate) fn forget(&mut self) {
        self.numeric = None;
    }

    /// Interior that the present factors were made of.
    pub(crate) fn factored(&self) -> Option<FactoredInterior> {
        let numeric = self.numeric.as_ref()?;
        let values = self.bodies.iter().map(|body| body.values().to_vec());
        Some(FactoredInterior {
            values: values.collect(),
            scales: numeric.scaling.columns.clone(),
            prescribed: numeric.prescribed.clone(),
            single: numeric.precision == Precision::Single,
        })
    }

    /// Factors the interior that another solver with the same analysis has factored.
    pub(crate) fn factor_again(&mut self, interior: &FactoredInterior) -> Result<(), SolveError> {
        self.numeric = None;
        let precision = match interior.single {
            true => Precision::Single,
            false => Precision::Double,
        };
        let bodies = self.bodies.par_iter_mut().zip(&interior.values);
        bodies.try_for_each(|(body, values)| body.factor_again(values, precision))?;
        self.numeric = Some(Numeric {
            scaling: Equilibration {
                rows: interior.scales.clone(),
                columns: interior.scales.clone(),
            },
            prescribed: interior.prescribed.clone(),
            precision,
            contact: ContactSystem::default(),
        });
        Ok(())
    }

    /// Factors the contact system of a matrix on the older interior.
    ///
    /// `None` when there is no interior or it has other prescribed unknowns.
    pub(crate) fn refresh(&mut self, tangent: &Tangent) -> Result<Option<Factored>, SolveError> {
        let Some(older) = self.numeric.take() else {
            return Ok(None);
        };
        if !self.partition.fits(tangent) || prescribed(&self.partition, tangent) != older.prescribed
        {
            return Ok(None);
        }
        let rows = self.kept.rows(tangent)?;
        let bulk = older.scaling.columns;
        let scaling = scaling::with_multipliers(&self.partition, bulk, (&self.kept, &rows));
        let interior = (older.prescribed, older.precision);
        self.factor_contact(rows, scaling, interior, older.contact)
            .map(Some)
    }

    /// Solves with the last factorisation and refines.
    pub(crate) fn solve(
        &self,
        tangent: &Tangent,
        rhs: &[f64],
        x: &mut [f64],
    ) -> Result<SolveReport, SolveError> {
        let numeric = self.numeric.as_ref().ok_or(SolveError::NotFactored)?;
        let factors = Substitution {
            condensed: self,
            numeric,
            tangent,
            purpose: Purpose::Answer,
        };
        refinement::solve(tangent, &numeric.scaling, &factors, rhs, x)
    }

    /// Solves with the factors as a preconditioner, of an older interior or in single
    /// precision; `None` when they are too far from the matrix.
    pub(crate) fn solve_nearby(
        &self,
        tangent: &Tangent,
        (rhs, x): (&[f64], &mut [f64]),
        ends: Ends,
    ) -> Result<Option<SolveReport>, SolveError> {
        let numeric = self.numeric.as_ref().ok_or(SolveError::NotFactored)?;
        let factors = Substitution {
            condensed: self,
            numeric,
            tangent,
            purpose: Purpose::Precondition,
        };
        refinement::solve_nearby(tangent, &numeric.scaling, &factors, (rhs, x), ends)
    }

    /// Returns whether the factors can precondition another matrix: what they know by a diagonal
    /// alone has no other entry there either.
    pub(crate) fn serves(&self, tangent: &Tangent) -> bool {
        let Some(numeric) = &self.numeric else {
            return false;
        };
        let known = numeric.contact.known.iter().enumerate();
        let mut known = known.filter(|(_, known)| **known).map(|(u, _)| u);
        self.partition.fits(tangent)
            && known.all(|u| tangent.row(u).all(|(v, a)| (u == v) == (a != 0.0)))
    }

    /// Factors the contact system of a matrix on the older interior and solves once.
    ///
    /// `None` as for [`refresh`](Self::refresh).
    pub(crate) fn solve_other_contact(
        &mut self,
        tangent: &Tangent,
        rhs: &[f64],
    ) -> Result<Option<Vec<f64>>, SolveError> {
        if self.refresh(tangent)?.is_none() {
            return Ok(None);
        }
        let numeric = self.numeric.as_ref().ok_or(SolveError::NotFactored)?;
        let mut x = rhs.to_vec();
        numeric.scaling.scale_rows(&mut x);
        // Single precision has a small range.
        let size = x.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        if size > 0.0 {
            x.iter_mut().for_each(|x| *x /= size);
        }
        let factors = Substitution {
            condensed: self,
            numeric,
            tangent,
            purpose: Purpose::Answer,
        };
        factors.solve_in_place(&mut x);
        numeric.scaling.scale_columns(&mut x);
        x.iter_mut().for_each(|x| *x *= size);
        Ok(Some(x))
    }

    /// Precision of the factors of the interior.
    pub(crate) fn precision(&self) -> Precision {
        self.numeric
            .as_ref()
            .map(|n| n.precision)
            .unwrap_or_default()
    }

    /// Work of factoring what contact leaves free, and of eliminating what it does not
    /// touch, over that of factoring the interior.
    ///
    /// The ratio distinguishes contact that holds most of what it touches, or that bodies
    /// outweigh, from contact of whole faces of two bodies, whichever way the contact system is
    /// solved.
    pub(crate) fn share_of_contact(&self) -> f64 {
        let work = |contact: &ContactSystem| {
            let eliminated = contact.untouched.iter().flatten();
            eliminated.map(Untouched::flops).sum::<f64>()
                + 2.0 / 3.0 * (contact.freedom as f64).powi(3)
        };
        let contact = self.numeric.as_ref().map(|numeric| &numeric.contact);
        let bodies: f64 = self.costs(self.precision()).map(|a| a.flops).sum();
        contact.map_or(0.0, work) / bodies
    }

    /// Solutions with given factors that cost as much as new factors of the interior.
    pub(crate) fn solutions_per_factorisation(&self) -> f64 {
        let (mut flops, mut entries) = (0.0, 0);
        for body in self.costs(self.precision()) {
            flops += body.flops;
            entries += body.factor_entries;
        }
        flops / (4.0 * SUBSTITUTION * entries.max(1) as f64)
    }
}

/// Bulk unknowns whose rows have no entry but the diagonal.
pub(crate) fn prescribed(partition: &Partition, tangent: &Tangent) -> Vec<bool> {
    (0..partition.unknowns())
        .into_par_iter()
        .with_min_len(1024)
        .map(|u| {
            let i = partition.owner(u).0;
            partition.bulk_group(i).contains(&u)
                && tangent.row(u).all(|(v, a)| (u == v) == (a != 0.0))
        })
        .collect()
}
