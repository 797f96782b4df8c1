//! `striae man`: the manual page.

use std::{io::Write, path::PathBuf};

use clap_mangen::{Man, generate_to};

use super::law::make_folder;
use crate::failure::Failure;

/// Print the manual page, or write it with those of the subcommands to a folder.
#[derive(clap::Args)]
pub struct Arguments {
    /// Folder for the pages, such as ~/.local/share/man/man1.
    #[arg(short, long, alias = "output")]
    out: Option<PathBuf>,
}

/// Prints the page or writes all pages.
pub fn run(
    arguments: &Arguments,
    program: clap::Command,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let Some(folder) = &arguments.out else {
        let mut page = Vec::new();
        Man::new(program).render(&mut page)?;
        out.write_all(&page)?;
        return Ok(());
    };
    make_folder(folder)?;
    generate_to(program, folder).map_err(|cause| Failure::Unwritable {
        path: folder.clone(),
        cause,
    })?;
    writeln!(out, "wrote the pages to {}", folder.display())?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn there_is_a_page_and_one_for_each_subcommand() {
        let mut out = Vec::new();
        let program = crate::Arguments::command;
        run(&Arguments { out: None }, program(), &mut out).unwrap();
        let page = String::from_utf8(out).unwrap();
        assert!(page.contains(".TH striae 1"), "{page}");
        let folder = tempfile::tempdir().unwrap();
        let all = Arguments {
            out: Some(folder.path().to_owned()),
        };
        run(&all, program(), &mut Vec::new()).unwrap();
        for name in ["striae.1", "striae-run.1", "striae-sweep.1"] {
            assert!(folder.path().join(name).exists(), "{name}");
        }
    }
}
