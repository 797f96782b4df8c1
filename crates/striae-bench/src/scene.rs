//! Problems of about a given number of unknowns.

use std::{error::Error, path::Path};
use striae_condensed::{Partition, Tangent};
use striae_contact::segment::Derivatives;
use striae_deck as deck;
use striae_mesh::generate::CappedBlock;
use striae_model::{Backend, Model};
use striae_solve::{
    assembly::{Assembled, Contact, ElementPlaces, Setting, StepContext, Trial, assemble},
    layout::{Extent, Layout},
    outcome::CutBack,
    problem::Problem,
    state::State,
};
use striae_sparse::{SparseMatrix, Structure, Supervariable};

/// The scenes by name.
pub const NAMES: [&str; 2] = ["stacked", "hertz"];

/// A scene.
pub fn model(name: &str, unknowns: usize, backend: Backend) -> Result<Model, Box<dyn Error>> {
    let text = match name {
        "stacked" => stacked(unknowns),
        "hertz" => hertz(unknowns),
        other => return Err(format!("no scene `{other}`; there are {NAMES:?}").into()),
    };
    let mut model = deck::parse(&text, name, Path::new(""))?.model;
    model.solver.backend = backend;
    Ok(model)
}

const MATERIAL: &str = r#"
[[material]]
name = "rubber"
law = "neo-hookean"
lambda = 0.657
shear_modulus = 0.164
"#;

/// Two blocks with meshes that do not match, in contact all over, pressed and sheared.
fn stacked(unknowns: usize) -> String {
    // A cube of n elements an edge has about 3 n^3 displacements.
    let n = (unknowns as f64 / 3.3).cbrt().round() as usize;
    let height = n.div_ceil(2);
    format!(
        r#"title = "Stacked blocks"
{MATERIAL}
[[body]]
name = "lower"
material = "rubber"
mesh = {{ generator = "block", size = [1, 1, 0.5], divisions = [{n}, {n}, {height}] }}
[[body]]
name = "upper"
material = "rubber"
mesh = {{ generator = "block", origin = [0, 0, 0.5], size = [1, 1, 0.5], divisions = [{m}, {m}, {height}] }}
[[pair]]
name = "interface"
a = {{ body = "lower", facets = "zmax" }}
b = {{ body = "upper", facets = "zmin" }}
friction = {{ law = "coulomb", mu = 0.2 }}
[[step]]
name = "press and shear"
increments = 2
displacement = [
    {{ body = "lower", nodes = "zmin", x = 0, y = 0, z = 0 }},
    {{ body = "upper", nodes = "zmax", x = 0.02, y = 0, z = -0.02 }},
]
"#,
        m = n - 1
    )
}

/// A block with a spherical face, pressed onto a rigid plane and sheared.
fn hertz(unknowns: usize) -> String {
    let size = cap_size(unknowns);
    format!(
        r#"title = "Block with a spherical face on a rigid plane"
{MATERIAL}
[[body]]
name = "block"
material = "rubber"
mesh = {{ generator = "capped-block", size = [10, 10], height = 6.5, radius = 12, element_size = {size}, fine_half_width = 1.6, fine_depth = 0.5 }}
[[rigid]]
name = "foundation"
plane = {{ point = [0, 0, 0], normal = [0, 0, 1] }}
[[pair]]
name = "contact"
a = {{ body = "block", facets = "cap" }}
b = {{ rigid = "foundation" }}
[[step]]
name = "press"
increments = 5
displacement = [
    {{ body = "block", nodes = "zmax", x = 0, y = 0, z = -0.15 }},
]
[[step]]
name = "shear"
increments = 5
friction = [{{ pair = "contact", law = "coulomb", mu = 0.1 }}]
displacement = [{{ body = "block", nodes = "zmax", x = 0.015 }}]
"#
    )
}

/// Size of the elements at the contact of a block with about so many displacements.
fn cap_size(unknowns: usize) -> f64 {
    let displacements = |size: f64| {
        let block = CappedBlock {
            element_size: size,
            fine_half_width: 1.6,
            fine_depth: 0.5,
            ..CappedBlock::default()
        };
        block.mesh().map_or(0, |mesh| 3 * mesh.positions.len())
    };
    let (mut fine, mut coarse) = (0.05, 1.0);
    for _ in 0..12 {
        let middle = f64::sqrt(fine * coarse);
        if displacements(middle) > unknowns {
            fine = middle;
        } else {
            coarse = middle;
        }
    }
    coarse
}

/// Stiffness of the bodies alone, at rest; rows of prescribed components hold a diagonal only.
pub fn stiffness(model: &Model) -> Result<SparseMatrix, Box<dyn Error>> {
    let mut model = model.clone();
    model.pairs.clear();
    for step in &mut model.steps {
        step.frictions.clear();
    }
    let problem = Problem::new(model)?;
    let state = State::undeformed(&problem);
    let context = StepContext::new(&problem, 0, &state);
    let layout = Layout::new(&problem, Extent::default());
    let structure = structure(&problem, &layout)?;
    let mut partition = Partition::from(&structure);
    let places = ElementPlaces::new(&problem, &layout, &structure);
    let mut tangent = Tangent::zero(partition.structure());
    let trial = Trial {
        positions: state.positions.clone(),
        tractions: Vec::new(),
        rigid: state.rigid.clone(),
        pressures: state.pressures.clone(),
    };
    let imposed = context.imposed(0.0);
    let setting = Setting {
        context: &context,
        state: &state,
        selections: &[],
        imposed: &imposed,
    };
    match bodies(
        &setting,
        &trial,
        &layout,
        (&mut partition, &places, &mut tangent),
    ) {
        Ok(_) => Ok(tangent.bodies),
        Err(reason) => Err(reason.to_string().into()),
    }
}

/// Couplings of the unknowns of a layout by elements.
pub fn structure(problem: &Problem, layout: &Layout) -> Result<Structure, Box<dyn Error>> {
    let mut cliques = Vec::new();
    for (body, model) in problem.model.bodies.iter().enumerate() {
        let nodes = |corners| -> Vec<Supervariable> {
            let nodes = problem.nodes(body, corners).into_iter();
            nodes.map(|node| layout.supervariable(node)).collect()
        };
        cliques.extend(model.mesh.elements().map(nodes));
    }
    Ok(Structure::from_cliques(
        layout.offsets().to_vec(),
        &cliques,
    )?)
}

/// Evaluates all elements, without contact.
pub fn bodies(
    setting: &Setting,
    trial: &Trial,
    layout: &Layout,
    parts: (&mut Partition, &ElementPlaces, &mut Tangent),
) -> Result<Assembled, CutBack> {
    let contact = Contact::Known(Vec::new());
    assemble(setting, trial, contact, Derivatives::First, layout, parts)
}
