//! Advice about a model before it is run.
//!
//! ```text
//! Advice::of(model) -> faults     it cannot be run, or not as it is meant
//!                      warnings   results would hardly be what is wanted
//!                      notes      what it is, and what is worth a thought
//! ```
//!
//! Faults that a model or deck finds itself ([`Validate`](striae_model::Validate),
//! [`fitted`](striae_model::fitted)) are not repeated. Sizes come from the meshes, and for models
//! of many nodes the cost is estimated by a formula, so that a million elements take seconds.

mod bending;
mod cost;
mod everything;
mod fit;
mod friction;
mod hold;
mod joins;
mod parts;
mod pressed;
mod resolution;
mod rim;
mod sagitta;
mod setup;
mod shape;
mod sizes;
mod textures;
mod ties;
mod units;

pub use cost::Cost;

use striae_contact::initial::Fit;
use striae_model::{Model, initial::fits};

/// Advice about a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Advice {
    /// Remarks on what makes a run impossible.
    pub faults: Vec<Remark>,
    /// Remarks on what makes results doubtful.
    pub warnings: Vec<Remark>,
    /// Remarks of general interest.
    pub notes: Vec<Remark>,
}

/// One thing to know.
#[derive(Clone, Debug, PartialEq)]
pub struct Remark {
    /// Topic of the remark.
    pub topic: Topic,
    /// Name of the body, pair or step it is about, if it is about one.
    pub name: Option<String>,
    /// In a sentence.
    pub text: String,
}

/// Topic of a remark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Topic {
    /// Extent, volume and shape of elements.
    Shape,
    /// Moduli beside sizes and loads.
    Units,
    /// Elements too stiff where volumes can hardly change.
    Locking,
    /// Elements too stiff in bending.
    Bending,
    /// Restraint of a body.
    Hold,
    /// Gaps and overlaps at the start.
    Fit,
    /// A pair whose surfaces look away from each other.
    Facing,
    /// A pair that can never meet.
    NeverMeets,
    /// Surfaces that may touch, and thin bodies that may touch themselves.
    Contact,
    /// Coefficients of friction over all directions.
    Friction,
    /// Textures without a direction.
    Texture,
    /// Unknowns, memory and time.
    Cost,
}

impl Topic {
    /// Name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Shape => "shape",
            Self::Units => "units",
            Self::Locking => "locking",
            Self::Bending => "bending",
            Self::Hold => "hold",
            Self::Fit => "fit",
            Self::Facing => "facing",
            Self::NeverMeets => "never-meets",
            Self::Contact => "contact",
            Self::Friction => "friction",
            Self::Texture => "texture",
            Self::Cost => "cost",
        }
    }
}

impl std::fmt::Display for Remark {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.text)
    }
}

impl Advice {
    /// Looks at a model without [faults](striae_model::Validate::faults) of its own.
    pub fn of(model: &Model) -> Self {
        let mut advice = Self::default();
        let fits: Vec<Option<Fit>> = fits(model);
        shape::look(model, &mut advice);
        joins::look(model, &mut advice);
        units::look(model, &mut advice);
        setup::look(model, &mut advice);
        bending::look(model, &fits, &mut advice);
        hold::look(model, &fits, &mut advice);
        everything::look(model, &mut advice);
        fit::look(model, &fits, &mut advice);
        setup::prescribed::look(model, &fits, &mut advice);
        sagitta::look(model, &fits, &mut advice);
        pressed::look(model, &fits, &mut advice);
        resolution::look(model, &fits, &mut advice);
        rim::look(model, &mut advice);
        sizes::look(model, &mut advice);
        ties::look(model, &mut advice);
        friction::look(model, &mut advice);
        textures::look(model, &mut advice);
        if advice.faults.is_empty() {
            cost::look(model, &fits, &mut advice);
        }
        advice
    }

    /// True where there is a warning of one of these topics about a part.
    fn warns_of(&self, name: &str, topics: &[Topic]) -> bool {
        self.warnings
            .iter()
            .any(|warning| topics.contains(&warning.topic) && warning.name.as_deref() == Some(name))
    }

    fn fault(&mut self, topic: Topic, name: &str, text: String) {
        self.faults.push(Remark::new(topic, name, text));
    }

    fn warn(&mut self, topic: Topic, name: &str, text: String) {
        self.warnings.push(Remark::new(topic, name, text));
    }

    fn note(&mut self, topic: Topic, name: &str, text: String) {
        self.notes.push(Remark::new(topic, name, text));
    }
}

impl Remark {
    fn new(topic: Topic, name: &str, text: String) -> Self {
        Self {
            topic,
            name: (!name.is_empty()).then(|| name.to_owned()),
            text,
        }
    }
}
