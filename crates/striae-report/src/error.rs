//! Errors of reports.

use std::path::PathBuf;

use striae_figure::FigureError;
use striae_files::FileError;
use striae_output::OutputError;

/// Error of a report.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The folder holds no results.
    #[error("{} has neither history.csv nor bodies.pvd, so there is nothing to report", .0.display())]
    Nothing(PathBuf),
    /// Results cannot be read.
    #[error(transparent)]
    Results(#[from] OutputError),
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// There is no field of this name at the time.
    #[error("unknown field `{name}`; known fields are {known}")]
    Field {
        /// Requested name.
        name: String,
        /// All names.
        known: String,
    },
    /// A field has no component of this name.
    #[error("`{field}` has no component `{name}`; its components are {known}")]
    Component {
        /// The field.
        field: String,
        /// Requested name.
        name: String,
        /// All names.
        known: String,
    },
    /// A direction of view has no length.
    #[error("a view along (0, 0, 0) shows nothing")]
    View,
    /// The extension of an animation states no format.
    #[error("{}: an animation ends in .gif or .png; choose one of these", .0.display())]
    Animation(PathBuf),
    /// The extension of a picture states no format.
    #[error("{}: a picture ends in .png, with `--animate` in .gif or .png; choose one of these", .0.display())]
    Still(PathBuf),
    /// A time that is none.
    #[error("there is no time {0}; a finite number is needed, and the fields are from time {first} to {last}", first = .1[0], last = .1[1])]
    Time(f64, [f64; 2]),
    /// Displacements cannot be magnified so.
    #[error("displacements cannot be magnified by {0:e}; a number from -{most:e} to {most:e} is needed", most = .1)]
    Magnification(f64, f64),
    /// There is no body or surface of this name.
    #[error("unknown name `{name}` of a body or surface; known names are {known}")]
    Name {
        /// Requested name.
        name: String,
        /// All names.
        known: String,
    },
    /// A picture cannot be written.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// The files of a part at different times do not belong together.
    #[error("{}: {found} points where the files before have {expected}", path.display())]
    Points {
        /// The file.
        path: PathBuf,
        /// Points of the file.
        found: usize,
        /// Points of the first file of the part.
        expected: usize,
    },
    /// A file has cells that the format does not know.
    #[error("{}: cells of VTK's shape {shape} cannot be shown", path.display())]
    Shape {
        /// The file.
        path: PathBuf,
        /// The code of the shape.
        shape: u8,
    },
}
