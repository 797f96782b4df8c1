//! `striae texture DECK`: pictures of the painted textures before anything runs.
//!
//! For every textured side of every pair it writes `texture-PAIR-SIDE` as a figure
//! of the surface at rest, with a stroke along `s` and a tick along `a = n x s` at the
//! nodes, and as a `.vtu` file with the arrays `texture` (`s`), `structural_vector`
//! (`a`) and `normal`, and prints how well conditioned the interpolation between
//! painted places was. A rigid plane has no nodes and is sampled on a grid that
//! reaches a little beyond the other side.

use std::{
    io::Write,
    path::{Path, PathBuf},
};

use striae::{
    case_name,
    figures::{TexturedSurface, owner, texture},
};
use striae_contact::side::Side;
use striae_output::vtk::{self, Array, Cells, Grid, Values};
use striae_solve::problem::{Problem, ProblemError};
use striae_surface::texture::Conditioning;

use crate::{command::law::make_folder, failure::Failure, source::Source};

/// Draw the textures painted by a deck.
#[derive(clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    source: Source,
    /// Folder for the pictures; by default results/NAME.
    #[arg(short, long, alias = "output")]
    out: Option<PathBuf>,
}

/// Paints the surfaces, draws them and prints their properties.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let deck = arguments.source.read()?;
    let folder = arguments
        .out
        .clone()
        .unwrap_or_else(|| Path::new("results").join(case_name(&arguments.source.deck)));
    let problem = Problem::new(deck.model)?;
    let mut surfaces = Vec::new();
    for pair in 0..problem.pairs.len() {
        for side in Side::BOTH {
            let painted = TexturedSurface::new(&problem, pair, side).map_err(ProblemError::from)?;
            if let Some(surface) = painted {
                surfaces.push(((pair, side), surface));
            }
        }
    }
    if surfaces.is_empty() {
        writeln!(out, "no side of a pair has a texture")?;
        return Ok(());
    }
    make_folder(&folder)?;
    for (side, surface) in &surfaces {
        show(&problem, *side, surface, &folder, out)?;
    }
    Ok(())
}

fn show(
    problem: &Problem,
    (pair, side): (usize, Side),
    surface: &TexturedSurface,
    folder: &Path,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let model = &problem.model;
    let name = &model.pairs[pair].name;
    let owner = owner(model, pair, side);
    let conditioning = problem.pairs[pair].conditionings[side].as_ref();
    let count = surface.positions.len();
    let nodes = match conditioning {
        Some(_) => format!("{count} nodes"),
        None => format!("a plane, sampled at {count} points"),
    };
    writeln!(out, "pair `{name}`, side {side}, {owner}: {nodes}")?;
    writeln!(out, "  {}", told(conditioning))?;
    let stem = format!("texture-{name}-{side}");
    texture::figure(surface).write(folder, &stem)?;
    write_surface(&folder.join(&stem).with_extension("vtu"), surface)?;
    let file = folder.join(&stem);
    writeln!(out, "  wrote {}.svg, .png, .csv and .vtu", file.display())?;
    Ok(())
}

fn told(conditioning: Option<&Conditioning>) -> String {
    match conditioning {
        None => "a field in space".to_owned(),
        Some(Conditioning::Given) => "every node has its own direction".to_owned(),
        Some(Conditioning::Interpolated {
            diameter,
            width,
            smallest_eigenvalue,
            condition,
            amplitude,
        }) => format!(
            "interpolated: diameter {diameter:.6}, width {width:.6}, smallest eigenvalue \
             {smallest_eigenvalue:.2e}, condition {condition:.2e}, amplitude {amplitude:.3}"
        ),
    }
}

fn write_surface(path: &Path, surface: &TexturedSurface) -> Result<(), Failure> {
    let vectors =
        |name, vectors: &[striae_mesh::Vec3]| Array::new(name, Values::Vectors(vectors.to_vec()));
    let grid = Grid {
        points: &surface.positions,
        cells: Cells::Polygons(&surface.facets),
        point_arrays: vec![
            vectors("texture", &surface.along),
            vectors("structural_vector", &surface.across),
            vectors("normal", &surface.normals),
        ],
        cell_arrays: Vec::new(),
        time: 0.0,
    };
    Ok(vtk::write(path, &grid)?)
}

#[cfg(test)]
mod tests;
