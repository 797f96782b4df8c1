//! `striae report RESULTS`: the results of a run as one HTML file.

use std::{io::Write, path::PathBuf};

use crate::failure::Failure;

/// Make one HTML file of the results of a run, with a 3D view, that opens without a network.
#[derive(clap::Args)]
pub struct Arguments {
    /// Folder of the run, which may still be in progress.
    results: PathBuf,
    /// The file; by default RESULTS/report.html.
    #[arg(short, long, alias = "output")]
    out: Option<PathBuf>,
}

/// Writes the file and says where it is.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let own = || arguments.results.join(striae_report::FILE);
    let file = arguments.out.clone().unwrap_or_else(own);
    striae_report::write(&arguments.results, &file)?;
    writeln!(out, "wrote {}", file.display())?;
    Ok(())
}
