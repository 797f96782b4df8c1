//! The picture of an example, written into the folder `PICTURES` if that is in the environment.

use std::{env, error::Error, path::PathBuf};

use striae_figure::{Figure, Panel, Width};

/// Writes `NAME.svg`, `NAME.png` and `NAME.csv`, if pictures are wanted.
pub(crate) fn plot(name: &str, panel: Panel) -> Result<(), Box<dyn Error>> {
    if let Some(folder) = env::var_os("PICTURES") {
        Figure::new(Width::Column, vec![panel]).write(&PathBuf::from(folder), name)?;
    }
    Ok(())
}
