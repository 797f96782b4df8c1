//! `striae completions SHELL`: words that a shell completes.

use std::io::Write;

use clap_complete::{Shell, generate};

use crate::failure::Failure;

/// Print the completions for a shell, as a file for its folder of completions.
#[derive(clap::Args)]
pub struct Arguments {
    /// The shell.
    #[arg(value_enum)]
    shell: Shell,
}

/// Prints the completions of the whole program.
pub fn run(
    arguments: &Arguments,
    mut program: clap::Command,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let mut text = Vec::new();
    generate(arguments.shell, &mut program, "striae", &mut text);
    out.write_all(&text)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn shells_know_subcommands_and_options() {
        for shell in [Shell::Bash, Shell::Zsh, Shell::Fish, Shell::PowerShell] {
            let mut out = Vec::new();
            let program = crate::Arguments::command();
            run(&Arguments { shell }, program, &mut out).unwrap();
            let text = String::from_utf8(out).unwrap();
            for word in ["resume", "sweep", "overwrite"] {
                assert!(text.contains(word), "{shell}: {word}");
            }
        }
    }
}
