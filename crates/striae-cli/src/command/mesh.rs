//! `striae mesh FILE`: what a mesh file holds, before a deck is written for it.

mod grid;
mod rigid;
mod surface;
mod words;

use std::{
    io::Write,
    path::{Path, PathBuf},
};

use striae::mesh_file::{self, MeshFileError, MeshFileFault, Reading, RigidSurfaceMesh};
use striae_report::picture::WIDTH;

use super::picture::{direction, width};
use crate::failure::Failure;

/// Show a mesh file: kinds of elements, sets, quality, and parts left out in reading.
#[derive(clap::Args)]
pub struct Arguments {
    /// The file: .msh of Gmsh, .inp of Abaqus, .vtu or .vtk of VTK, or .stl.
    file: PathBuf,
    /// Draw the facet sets, or the element sets if there are none, as a PNG; of a rigid surface
    /// the normals, with fronts, which bodies touch, and backs in two colours.
    #[arg(long, value_name = "FILE.png", value_parser = png)]
    picture: Option<PathBuf>,
    /// Viewing direction of the picture, from the eye to the mesh.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = direction)]
    view: Option<[f64; 3]>,
    /// Width of the picture in pixels.
    #[arg(long, default_value_t = WIDTH, value_parser = width)]
    width: usize,
    /// Write the mesh with its sets, numbers and quality for ParaView.
    #[arg(short, long, alias = "output", value_name = "FILE.vtu", value_parser = vtu)]
    out: Option<PathBuf>,
}

/// Reads the file, prints its content, and writes the requested files.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    match read(&arguments.file)? {
        Content::Body(reading) => body(*reading, arguments, out),
        Content::Rigid(surface) => rigid(&surface, arguments, out),
    }
}

/// Endings of the files that are read.
const KNOWN: &str = ".msh (Gmsh), .inp (Abaqus), .vtu or .vtk (VTK), or .stl";

/// Content of a mesh file.
enum Content {
    Body(Box<Reading>),
    Rigid(RigidSurfaceMesh),
}

/// The body of a file, or the rigid surface of one that has no elements of a body.
fn read(file: &Path) -> Result<Content, MeshFileError> {
    if has_ending(file, "stl") {
        return mesh_file::read_rigid_surface(file).map(Content::Rigid);
    }
    let error = match mesh_file::read_with_notes(file) {
        Ok(reading) => return Ok(Content::Body(Box::new(reading))),
        Err(error) => error,
    };
    match error.fault {
        MeshFileFault::Empty { .. } => {}
        MeshFileFault::UnknownEnding { .. } => {
            let fault = MeshFileFault::UnknownEnding { expected: KNOWN };
            return Err(MeshFileError { fault, ..error });
        }
        _ => return Err(error),
    }
    match mesh_file::read_rigid_surface(file) {
        Ok(surface) => Ok(Content::Rigid(surface)),
        Err(other) => match other.fault {
            // It has no surface either, or its format knows none.
            MeshFileFault::Empty { .. } | MeshFileFault::UnknownEnding { .. } => Err(error),
            _ => Err(other),
        },
    }
}

fn body(mut reading: Reading, arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    reading.mesh.name_all_facets();
    write!(out, "{}", words::of_body(&arguments.file, &reading))?;
    let Reading { mesh, numbers, .. } = &reading;
    if let Some(file) = &arguments.picture {
        draw(surface::of_body(mesh), arguments, file, out)?;
    }
    if let Some(file) = &arguments.out {
        grid::write(mesh, numbers, file)?;
        writeln!(out, "wrote {}", file.display())?;
    }
    Ok(())
}

fn rigid(
    read: &RigidSurfaceMesh,
    arguments: &Arguments,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    write!(out, "{}", rigid::words(&arguments.file, read))?;
    if let Some(file) = &arguments.picture {
        draw(surface::of_rigid(read), arguments, file, out)?;
    }
    if let Some(file) = &arguments.out {
        grid::write_surface(read, file)?;
        writeln!(out, "wrote {}", file.display())?;
    }
    Ok(())
}

fn draw(
    mut surfaces: striae_report::picture::Surfaces,
    arguments: &Arguments,
    file: &Path,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    surfaces.direction = arguments.view.unwrap_or(surfaces.direction);
    surfaces.width = arguments.width;
    surfaces.render()?.write_png(file)?;
    writeln!(out, "wrote {}", file.display())?;
    Ok(())
}

fn has_ending(path: &Path, ending: &str) -> bool {
    let found = path.extension().and_then(|ending| ending.to_str());
    found.is_some_and(|found| found.eq_ignore_ascii_case(ending))
}

fn png(text: &str) -> Result<PathBuf, String> {
    named(text, "png")
}

fn vtu(text: &str) -> Result<PathBuf, String> {
    named(text, "vtu")
}

fn named(text: &str, ending: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match has_ending(&path, ending) {
        true => Ok(path),
        false => Err(format!("the name of the file must end in .{ending}")),
    }
}
