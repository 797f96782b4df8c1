//! Models that have been found valid.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use pyo3::prelude::*;
use striae::{
    Error,
    advice::{Advice, Remark},
    deck,
    model::{self, Backend, ContactMass, Formulation, SectionBuilder, extended, initial::fits},
    output::Output,
    solve::{newton::estimate, problem::Problem, warning::warnings_at_start},
};

use crate::{
    cavity::Cavity,
    everything::Everything,
    fault::{model_error, model_faults, raised, refused},
    friction::Friction,
    material::Material,
    mesh::Mesh,
    own_factor::raised_in,
    pair::Pair,
    raised::Raised,
    rigid::Rigid,
    spring::Spring,
    start,
    step::Step,
    tie::Tie,
    words::in_python,
};

/// A model that has been found valid, and where it comes from.
#[pyclass(frozen, module = "striae._striae")]
pub struct Model {
    /// The model.
    pub model: Arc<model::Model>,
    /// Output requested by a deck.
    pub output: Output,
    /// The deck, if that is all there is to the model.
    pub deck: Option<PathBuf>,
    /// Numbers by which the deck asks for derivatives.
    pub wrt: Vec<String>,
    /// Exceptions raised by functions that state laws.
    pub raised: Vec<Raised>,
}

/// Name, mesh, material, density, whether the mass of contact nodes is moved, formulation,
/// and sections.
type Body<'py> = (
    String,
    PyRef<'py, Mesh>,
    Option<PyRef<'py, Material>>,
    Option<f64>,
    bool,
    Option<String>,
    Vec<Section<'py>>,
);

/// Element set, material, density and formulation.
type Section<'py> = (String, PyRef<'py, Material>, Option<f64>, Option<String>);

/// Backend, tolerance and largest number of iterations.
type Solver = (String, f64, usize);

/// Topic, name of the part and text of remarks.
type Remarks = Vec<(&'static str, Option<String>, String)>;

/// Smallest gap, largest overlap and nearest distance of a pair.
type Fit = (Option<f64>, f64, f64);

#[pymethods]
impl Model {
    #[staticmethod]
    #[allow(clippy::too_many_arguments)]
    fn build(
        title: &str,
        bodies: Vec<Body<'_>>,
        rigid: Vec<PyRef<'_, Rigid>>,
        pairs: Vec<PyRef<'_, Pair>>,
        everything: Option<PyRef<'_, Everything>>,
        ties: Vec<PyRef<'_, Tie>>,
        springs: Vec<PyRef<'_, Spring>>,
        cavities: Vec<PyRef<'_, Cavity>>,
        steps: Vec<PyRef<'_, Step>>,
        solver: Solver,
    ) -> PyResult<Self> {
        let sections = bodies.iter().flat_map(|body| &body.6);
        let materials = bodies.iter().filter_map(|body| body.2.as_ref());
        let materials = materials.chain(sections.map(|section| &section.1));
        let raised = materials.filter_map(|material| material.1.clone());
        let raised = raised.collect();
        let mut built = model::model(title).solver(settings(solver));
        for (name, mesh, material, density, redistributed, formulation, parts) in bodies {
            let mut parts = parts.into_iter().map(section);
            let mut body = match (material, parts.len()) {
                (Some(material), _) => model::body(name, mesh.0.clone(), material.0.clone()),
                (None, 0) => return Err(refused("material", "a body needs one, or sections")),
                (None, _) => {
                    let first = parts.next().expect("there is one");
                    model::composite(name, mesh.0.clone(), first)
                }
            };
            body = parts.fold(body, model::BodyBuilder::section);
            if let Some(formulation) = formulation.as_deref().map(formulated) {
                body = body.formulation(formulation);
            }
            if let Some(density) = density {
                body = body.density(density);
            }
            if redistributed {
                body = body.contact_mass(ContactMass::Redistributed);
            }
            built = built.body(body);
        }
        for rigid in rigid {
            built = built.rigid(rigid.0.clone());
        }
        for pair in pairs {
            built = built.pair(pair.0.clone());
        }
        if let Some(everything) = everything {
            built = built.contact(everything.0.clone());
        }
        for tie in ties {
            built = built.tie(tie.0.clone());
        }
        for spring in springs {
            built = built.spring(spring.0.clone());
        }
        for cavity in cavities {
            built = built.cavity(cavity.0.clone());
        }
        for step in &steps {
            built = built.step(step.0.clone());
        }
        let model = built.build().map_err(|faults| model_faults(&faults))?;
        start::checked(&model, &steps)?;
        Ok(Self {
            raised,
            ..Self::of(model)
        })
    }

    #[staticmethod]
    fn from_deck(path: PathBuf) -> PyResult<Self> {
        let read = deck::read(&path).map_err(|faults| raised(Error::Deck(faults), "deck"))?;
        Ok(Self {
            model: Arc::new(read.model),
            output: read.output,
            deck: Some(path),
            wrt: read.wrt,
            raised: Vec::new(),
        })
    }

    #[staticmethod]
    fn from_text(text: &str, folder: PathBuf) -> PyResult<Self> {
        let read = deck::parse(text, "deck", Path::new(&folder));
        let read = read.map_err(|faults| raised(Error::Deck(faults), "deck"))?;
        Ok(Self {
            output: read.output,
            wrt: read.wrt,
            ..Self::of(read.model)
        })
    }

    /// The model with more steps.
    fn extended(&self, steps: Vec<PyRef<'_, Step>>) -> PyResult<Self> {
        let added = steps.iter().map(|step| step.0.clone()).collect();
        let model = extended((*self.model).clone(), added);
        let model = model.map_err(|faults| model_faults(&faults))?;
        start::checked(&model, &steps)?;
        Ok(Self {
            output: self.output.clone(),
            raised: self.raised.clone(),
            ..Self::of(model)
        })
    }

    /// Numbers by which the deck asks for derivatives.
    #[getter]
    fn wrt(&self) -> Vec<String> {
        self.wrt.clone()
    }

    /// The text of a deck that reads back to the model.
    fn to_deck(&self) -> PyResult<String> {
        deck::write(&self.model, &self.output).map_err(|unstated| {
            let parts = unstated.parts.into_iter();
            model_error(parts.map(|(part, why)| (part, why.to_owned())).collect())
        })
    }

    #[getter]
    fn title(&self) -> String {
        self.model.title.clone()
    }

    fn bodies(&self) -> Vec<String> {
        let bodies = self.model.bodies.iter();
        bodies.map(|body| body.name.clone()).collect()
    }

    fn rigid(&self) -> Vec<String> {
        let rigid = self.model.rigid_surfaces.iter();
        rigid.map(|rigid| rigid.name.clone()).collect()
    }

    fn pairs(&self) -> Vec<String> {
        let pairs = self.model.pairs.iter();
        pairs.map(|pair| pair.name.clone()).collect()
    }

    fn cavities(&self) -> Vec<String> {
        let cavities = self.model.cavities.iter();
        cavities.map(|cavity| cavity.name.clone()).collect()
    }

    fn springs(&self) -> Vec<String> {
        let springs = self.model.springs.iter();
        springs.map(|spring| spring.name.clone()).collect()
    }

    fn ties(&self) -> Vec<String> {
        let ties = self.model.ties.iter();
        ties.map(|tie| tie.name.clone()).collect()
    }

    fn steps(&self) -> Vec<String> {
        let steps = self.model.steps.iter();
        steps.map(|step| step.name.clone()).collect()
    }

    /// Mesh of a body after gaps have been closed.
    fn mesh(&self, body: usize) -> Mesh {
        Mesh(self.model.bodies[body].mesh.clone())
    }

    /// Friction of a pair from the start.
    fn friction(&self, pair: usize) -> Friction {
        Friction(self.model.pairs[pair].friction.clone())
    }

    /// Returns whether Python functions are called during a run.
    #[getter]
    fn calls_python(&self) -> bool {
        !self.raised.is_empty() || !raised_in(&self.model).is_empty()
    }

    /// Faults, warnings and notes, as of `striae check`.
    fn advice(&self, py: Python<'_>) -> [Remarks; 3] {
        let model = self.model.clone();
        let advice = py.detach(move || Advice::of(&model));
        [advice.faults, advice.warnings, advice.notes].map(|remarks| {
            let told = |one: Remark| (one.topic.name(), one.name, in_python(&one.text));
            remarks.into_iter().map(told).collect()
        })
    }

    /// Unknowns at the start, how the pairs fit, and warnings.
    fn check(&self, py: Python<'_>) -> PyResult<(usize, Vec<Fit>, Vec<String>)> {
        let model = self.model.clone();
        let checked = py.detach(move || {
            let fits = fits(&model);
            let warnings = warnings_at_start(&model, &fits);
            let problem = Problem::new((*model).clone()).map_err(Error::Problem)?;
            let unknowns = estimate(&problem).map_or(0, |estimate| estimate.unknowns);
            let told = fits.iter().flatten().map(|fit| {
                let gap = fit.gap.as_ref().map(|gap| gap.gap);
                let overlap = fit.overlap.as_ref().map_or(0.0, |overlap| overlap.depth);
                (gap, overlap, fit.distance)
            });
            let warnings = warnings.iter().map(in_python);
            Ok((unknowns, told.collect(), warnings.collect()))
        });
        checked.map_err(|error: Error| raised(error, "model"))
    }
}

impl Model {
    /// A model that no deck states.
    pub fn of(model: model::Model) -> Self {
        Self {
            model: Arc::new(model),
            output: Output::default(),
            deck: None,
            wrt: Vec::new(),
            raised: Vec::new(),
        }
    }
}

fn section((set, material, density, formulation): Section<'_>) -> SectionBuilder {
    let mut section = model::section(set, material.0.clone());
    if let Some(density) = density {
        section = section.density(density);
    }
    match formulation.as_deref().map(formulated) {
        Some(formulation) => section.formulation(formulation),
        None => section,
    }
}

fn formulated(word: &str) -> Formulation {
    match word {
        "mean-dilatation" => Formulation::MeanDilatation,
        "assumed-strain" => Formulation::AssumedStrain,
        _ => Formulation::Standard,
    }
}

fn settings((backend, tolerance, largest_iterations): Solver) -> model::Solver {
    model::Solver {
        backend: match backend.as_str() {
            "multifrontal" => Backend::Multifrontal,
            "faer" => Backend::Faer,
            "iterative" => Backend::Iterative,
            "mumps" => Backend::Mumps,
            _ => Backend::Condensed,
        },
        tolerance,
        largest_iterations,
        ..model::solver()
    }
}
