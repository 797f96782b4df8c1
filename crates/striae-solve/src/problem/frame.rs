//! Parts of a problem that follow from its model before there are elements.

use super::{ProblemError, shadow::shadowed};
use crate::{composition::Materials, contact_mass::massless, share::Share, skin::Skin};
use striae_model::{
    Model,
    pair_geometry::{PairGeometry, add_fibres, pair_geometry},
    tie::{Ties, first_nodes},
};

/// A model with what follows from it but for its elements, which take most of the memory.
pub(crate) struct Frame {
    /// The model as it was given, by which checkpoints know it.
    pub(crate) model: Model,
    /// The model with nodes that follow others where they belong, if there are any.
    pub(crate) placed: Option<Model>,
    /// Nodes that follow others.
    pub(crate) ties: Ties,
    /// Contact pairs.
    pub(crate) pairs: Vec<PairGeometry>,
    /// Nodes of bodies whose mass is moved to others.
    pub(crate) massless: Vec<bool>,
    /// Nodes that follow nodes which touch the same opponent.
    pub(crate) shadowed: Vec<[Vec<bool>; 2]>,
    /// Materials of every body.
    pub(crate) materials: Vec<Materials>,
    /// The skins of all bodies of the whole.
    pub(crate) skin: Skin,
    /// Share of the whole problem.
    pub(crate) share: Share,
}

impl Frame {
    /// Frame of a whole model.
    ///
    /// # Errors
    /// If a tie or a pair is not valid.
    pub(crate) fn new(model: Model) -> Result<Self, ProblemError> {
        let ties = Ties::new(&model).map_err(|mut faults| ProblemError::Tie(faults.remove(0)))?;
        let placed = (!ties.is_empty()).then(|| ties.moved(model.clone()));
        let placed = placed.transpose().map_err(ProblemError::Tie)?;
        let at = placed.as_ref().unwrap_or(&model);
        let first_node = first_nodes(at);
        let pairs = at.pairs.iter().map(|pair| pair_geometry(at, pair));
        let mut pairs: Vec<PairGeometry> = pairs.collect::<Result<_, _>>()?;
        add_fibres(at, &mut pairs);
        Ok(Self {
            massless: massless(at, &first_node),
            shadowed: shadowed(&pairs, &first_node, &ties),
            materials: at.bodies.iter().map(Materials::of).collect(),
            skin: Skin::new(at, &ties),
            pairs,
            ties,
            placed,
            share: Share::alone(),
            model,
        })
    }
}
