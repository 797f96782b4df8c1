//! An increment: the nodes that carry traction unknowns, and the evaluation of contact.

use std::sync::Arc;

use striae_mesh::{NodeId, Vec3};

use super::{
    contact::Contact,
    evaluated::Evaluated,
    fault::{FaultKind, Faults},
    imposed::{Imposed, prescribed},
    numbers::Numbers,
    restriction::{chosen, restrict},
    shape,
    state::State,
};
use crate::{
    complementarity::{Conditions, Iteration, Prescribed},
    configuration::Configuration,
    evaluation::{Collapse, evaluate},
    pair_state::{Predicted, fit},
    segment::Derivatives,
    selection::{Kept, Selection},
    side::Side,
    texture::CollapsedTexture,
    unknowns::Tractions,
};

/// An increment of contact from a state.
#[derive(Clone, Debug)]
pub struct Increment {
    contact: Contact,
    start: State,
    /// Imposed values, with an entry for everything.
    imposed: Imposed,
    prescribed: Vec<Prescribed>,
    selections: Vec<Selection>,
    numbers: Numbers,
    tractions: Vec<Tractions>,
    /// Rules of the first evaluation.
    first: Iteration,
    /// Shared with its copies and evaluations alone.
    identity: Arc<()>,
}

impl Contact {
    /// Begins an increment: chooses the nodes that carry traction unknowns.
    ///
    /// # Errors
    /// When lists have wrong lengths, or something in them is not finite.
    pub fn begin(&self, state: &State, imposed: &Imposed) -> Result<Increment, Faults> {
        Increment::new(self, state, imposed)
    }
}

impl Increment {
    fn new(contact: &Contact, state: &State, imposed: &Imposed) -> Result<Self, Faults> {
        if !state.fits(contact) {
            return Err(Faults::one("state", FaultKind::Foreign));
        }
        contact.areas(&state.positions)?;
        let imposed = imposed.completed(contact, state)?;
        let prescribed = prescribed(contact, &imposed.prescribed);
        let ends = (state, &imposed);
        let start = |pair| contact.configuration(pair, &state.positions, &state.placements);
        let predicted = |pair| {
            (!imposed.predicted.is_empty())
                .then(|| contact.configuration(pair, &imposed.predicted, &imposed.placements))
        };
        let before: Vec<&Kept> = state.pairs.iter().map(|pair| &pair.kept).collect();
        let mut selections = chosen(contact, ends, (&start, &predicted), &before, &prescribed);
        let nodes: Vec<_> = state.pairs.iter().map(|pair| &pair.nodes).collect();
        restrict(contact, ends, &mut selections, start, &nodes);
        let started = state.pairs.iter().zip(&selections);
        let tractions =
            started.map(|(pair, selection)| pair.started(selection, Predicted::AsBefore));
        Ok(Self {
            tractions: tractions.collect(),
            numbers: numbers(contact, &selections),
            contact: contact.clone(),
            start: state.clone(),
            imposed,
            prescribed,
            selections,
            first: Iteration::First,
            identity: Arc::default(),
        })
    }

    /// Number of unknowns: three a node, and three a kept node.
    pub fn unknowns(&self) -> usize {
        self.numbers.all()
    }

    /// Kept nodes in the order of their unknowns: pair, side and node of the mesh.
    pub fn kept(&self) -> Vec<(usize, Side, NodeId)> {
        let mut kept = Vec::with_capacity(self.numbers.kept());
        for (pair, selection) in self.selections.iter().enumerate() {
            let nodes = Side::BOTH.map(|side| self.contact.nodes(pair, side));
            let of_pair = selection.kept().iter().map(|kept| kept.place());
            kept.extend(of_pair.map(|(side, node)| (pair, side, nodes[side][node])));
        }
        kept
    }

    /// Traction unknowns to start from, three a kept node.
    pub fn tractions(&self) -> Vec<f64> {
        let pairs = self.selections.iter().zip(&self.tractions);
        let of_pair = |(selection, tractions): (&Selection, &Tractions)| {
            let kept = selection.kept().iter().map(|kept| kept.place());
            let values = kept.map(|(side, node)| tractions.nodes[side][node]);
            values.collect::<Vec<_>>()
        };
        pairs.flat_map(of_pair).flatten().collect()
    }

    /// Positions at the start.
    pub fn positions(&self) -> &[Vec3] {
        &self.start.positions
    }

    /// Evaluates contact at positions and traction unknowns; `after` is the evaluation that they
    /// are the correction of, none in the first iteration.
    ///
    /// # Errors
    /// When lists have wrong lengths, something in them is not finite, or facets or textures have
    /// collapsed.
    pub fn evaluate(
        &self,
        x: &[Vec3],
        tractions: &[f64],
        after: Option<&Evaluated>,
    ) -> Result<Evaluated, Faults> {
        shape::vectors(x, self.contact.node_count(), "positions")?;
        shape::count(tractions.len(), 3 * self.numbers.kept(), "tractions")?;
        if let Some(row) = tractions.iter().position(|value| !value.is_finite()) {
            return Err(Faults::one("tractions", FaultKind::NotFinite { row }));
        }
        self.contact.areas(x)?;
        let unknowns = self.unknowns_of(tractions, after)?;
        let number = after.map_or(0, |after| after.number + 1);
        let iteration = match (self.first, number) {
            (first, 0) => first,
            (_, number) => Iteration::later(number),
        };
        let contact = self.contact.clone();
        let evaluated = Evaluated::new(
            contact,
            (&self.identity, number),
            &self.numbers,
            x.to_vec(),
            unknowns,
        );
        let mut pairs = Vec::with_capacity(self.contact.pair_count());
        for pair in 0..self.contact.pair_count() {
            let conditions = Conditions {
                friction: &self.contact.members()[pair].friction,
                prescribed: &self.prescribed[pair],
                iteration,
                wanted: None,
            };
            let evaluation = evaluate(
                &self
                    .at(pair, x)
                    .lasting(self.imposed.duration)
                    .at_time(self.time()),
                &self.at_start(pair),
                &self.selections[pair],
                &evaluated.tractions[pair],
                conditions,
                Derivatives::First,
            );
            pairs.push(evaluation.map_err(|collapse| self.collapsed(pair, collapse))?);
        }
        Ok(evaluated.with(&self.numbers, pairs))
    }

    /// Traction unknowns of all nodes, with the labels that the evaluation before gives them.
    fn unknowns_of(
        &self,
        values: &[f64],
        after: Option<&Evaluated>,
    ) -> Result<Vec<Tractions>, Faults> {
        let mut all = match after {
            None => self.tractions.clone(),
            Some(after) => {
                self.own(after, "after")?;
                let pairs = after.tractions.iter().zip(&after.pairs);
                let labelled = pairs.map(|(tractions, evaluation)| {
                    let mut tractions = tractions.clone();
                    tractions.label(&evaluation.nodes);
                    tractions
                });
                labelled.collect()
            }
        };
        for (pair, (tractions, selection)) in all.iter_mut().zip(&self.selections).enumerate() {
            let own = values[3 * self.numbers.before(pair)..].chunks_exact(3);
            for (kept, value) in selection.kept().iter().zip(own) {
                tractions.nodes[kept.side][kept.node] = [value[0], value[1], value[2]];
            }
        }
        Ok(all)
    }

    /// Nodes without a share in the tractions that have met the other surface. An increment that
    /// misses some is solved again with them, see [`Self::reselected`].
    ///
    /// # Errors
    /// When the evaluation is one of another increment.
    pub fn missed(&self, evaluated: &Evaluated) -> Result<Vec<NodeId>, Faults> {
        self.own(evaluated, "evaluation")?;
        let mut missed = Vec::new();
        for (pair, selection) in self.selections.iter().enumerate() {
            let nodes = Side::BOTH.map(|side| self.contact.nodes(pair, side));
            let left_out = selection.left_out(&self.at_start(pair), &self.at(pair, &evaluated.x));
            missed.extend(left_out.iter().map(|&(side, node)| nodes[side][node]));
        }
        missed.sort_unstable();
        missed.dedup();
        let gains = || {
            let again = self.reselected(evaluated)?;
            let mut fields = again.selections.iter().zip(&self.selections).enumerate();
            Ok(fields.any(|(pair, (has, had))| {
                has.gains_on(had, &self.at_start(pair), &self.at(pair, &evaluated.x))
            }))
        };
        // What other pairs hold gets no share, however often it is offered one.
        match missed.is_empty() || gains()? {
            true => Ok(missed),
            false => Ok(Vec::new()),
        }
    }

    /// The increment with the nodes that an evaluation shows to be needed; its unknowns are
    /// others. The evaluation after it is one of a later iteration.
    ///
    /// # Errors
    /// When the evaluation is one of another increment.
    pub fn reselected(&self, evaluated: &Evaluated) -> Result<Self, Faults> {
        self.own(evaluated, "evaluation")?;
        let (contact, x) = (&self.contact, &evaluated.x);
        let ends = (&self.start, &self.imposed);
        let latest = |pair| self.at(pair, x);
        let had: Vec<Kept> = self.selections.iter().map(Selection::kept_nodes).collect();
        let mut selections = chosen(
            contact,
            ends,
            (&|pair| self.at_start(pair), &|pair| Some(latest(pair))),
            &had.iter().collect::<Vec<_>>(),
            &self.prescribed,
        );
        let mut tractions = evaluated.tractions.clone();
        for (pair, tractions) in tractions.iter_mut().enumerate() {
            let carried = &evaluated.pairs[pair].carried;
            fit(&selections[pair], &had[pair], carried, tractions);
        }
        let nodes: Vec<_> = evaluated.pairs.iter().map(|of| &of.nodes).collect();
        restrict(contact, ends, &mut selections, latest, &nodes);
        Ok(Self {
            numbers: numbers(contact, &selections),
            selections,
            tractions,
            first: Iteration::LATER,
            identity: Arc::default(),
            ..self.clone()
        })
    }

    /// The state that an evaluation with a small residual leads to.
    ///
    /// # Errors
    /// When the evaluation is one of another increment.
    pub fn accept(&self, evaluated: &Evaluated) -> Result<State, Faults> {
        self.own(evaluated, "evaluation")?;
        let after = |pair: usize| {
            let (tractions, evaluation) = (&evaluated.tractions[pair], &evaluated.pairs[pair]);
            let friction = &self.contact.members()[pair].friction;
            self.start.pairs[pair].after(
                tractions.clone(),
                &self.selections[pair],
                evaluation.clone(),
                friction,
                self.imposed.duration,
            )
        };
        Ok(State {
            positions: evaluated.x.clone(),
            placements: self.imposed.placements.clone(),
            pairs: (0..self.contact.pair_count()).map(after).collect(),
            time: self.time(),
            checksum: self.contact.checksum(),
        })
    }

    fn own(&self, evaluated: &Evaluated, place: &str) -> Result<(), Faults> {
        match Arc::ptr_eq(&evaluated.made_by, &self.identity) {
            true => Ok(()),
            false => Err(Faults::one(place, FaultKind::OtherIncrement)),
        }
    }

    /// Time at the end.
    fn time(&self) -> f64 {
        match self.imposed.duration.is_finite() {
            true => self.start.time + self.imposed.duration,
            false => self.start.time,
        }
    }

    fn at_start(&self, pair: usize) -> Configuration<'_> {
        let State {
            positions,
            placements,
            ..
        } = &self.start;
        self.contact.configuration(pair, positions, placements)
    }

    fn at(&self, pair: usize, x: &[Vec3]) -> Configuration<'_> {
        self.contact
            .configuration(pair, x, &self.imposed.placements)
    }

    fn collapsed(&self, pair: usize, collapse: Collapse) -> Faults {
        let (side, node) = match collapse {
            Collapse::Texture(CollapsedTexture { side, node }) => (side, node),
            Collapse::Folded => {
                return Faults::one(format!("pairs[{pair}]"), FaultKind::FoldedSurfaces);
            }
            Collapse::Factor(failure) => {
                let cause = failure.to_string();
                return Faults::one(format!("pairs[{pair}]"), FaultKind::Factor { cause });
            }
        };
        let surface = self.contact.members()[pair].pair.sides[side].surface();
        let node = surface.map_or(NodeId(0), |surface| surface.nodes()[node.index()]);
        let kind = FaultKind::CollapsedTexture { node };
        Faults::one(format!("pairs[{pair}].{side}"), kind)
    }
}

fn numbers(contact: &Contact, selections: &[Selection]) -> Numbers {
    let pairs = contact.members().iter().map(|member| &member.pair);
    Numbers::new(contact.node_count(), pairs.zip(selections))
}
