//! The `striae` program.
//!
//! Exit codes: 0 if everything succeeded, 1 if a run or a file operation failed, 2 if the request
//! is not possible (bad arguments, a faulty deck, or a checkpoint that cannot be used), 130 when a
//! run was interrupted from the keyboard or by another signal that asks it to end.

mod command;
mod failure;
mod forecast;
mod interrupt;
mod progress;
mod ranks;
mod reporting;
mod shell;
mod source;

use clap::{CommandFactory, Parser, Subcommand};
use std::{
    io::{self, Write},
    process::ExitCode,
};

// Every iteration allocates and frees on all threads, which costs a tenth less with mimalloc
// than with the allocator of glibc.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Finite-element contact with anisotropic friction.
#[derive(Parser)]
#[command(name = "striae", version)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    New(command::new::Arguments),
    Check(command::check::Arguments),
    Convert(command::convert::Arguments),
    Run(command::run::Arguments),
    Resume(command::resume::Arguments),
    Report(command::report::Arguments),
    Picture(command::picture::Arguments),
    Reproduce(command::reproduce::Arguments),
    Law(command::law::Arguments),
    Fit(command::fit::Arguments),
    Material(command::material::Arguments),
    Mesh(command::mesh::Arguments),
    Schema(command::schema::Arguments),
    Texture(command::texture::Arguments),
    Sweep(command::sweep::Arguments),
    Compare(command::compare::Arguments),
    Completions(command::completions::Arguments),
    Man(command::man::Arguments),
}

fn main() -> ExitCode {
    interrupt::prepare();
    let out = &mut io::stdout();
    let result = match Arguments::parse().command {
        Command::New(arguments) => command::new::run(&arguments, out),
        Command::Check(arguments) => command::check::run(&arguments, out),
        Command::Convert(arguments) => command::convert::run(&arguments, out),
        Command::Run(arguments) => command::run::run(&arguments, out),
        Command::Resume(arguments) => command::resume::run(&arguments, out),
        Command::Picture(arguments) => command::picture::run(&arguments, out),
        Command::Report(arguments) => command::report::run(&arguments, out),
        Command::Reproduce(arguments) => command::reproduce::run(&arguments, out),
        Command::Law(arguments) => command::law::run(&arguments, out),
        Command::Fit(arguments) => command::fit::run(&arguments, out),
        Command::Material(arguments) => command::material::run(&arguments, out),
        Command::Mesh(arguments) => command::mesh::run(&arguments, out),
        Command::Schema(arguments) => command::schema::run(&arguments, out),
        Command::Texture(arguments) => command::texture::run(&arguments, out),
        Command::Sweep(arguments) => command::sweep::run(&arguments, out),
        Command::Compare(arguments) => command::compare::run(&arguments, out),
        Command::Completions(arguments) => {
            command::completions::run(&arguments, Arguments::command(), out)
        }
        Command::Man(arguments) => command::man::run(&arguments, Arguments::command(), out),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) if failure.is_told() || failure.is_broken_pipe() => failure.exit_code(),
        Err(failure) => {
            // At once, so that nothing of other ranks comes between.
            let _ = io::stderr().write_all(format!("{failure}\n").as_bytes());
            failure.exit_code()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_version_is_that_of_the_program() {
        let version = Arguments::command().render_version();
        assert_eq!(version, format!("striae {}\n", env!("CARGO_PKG_VERSION")));
    }

    #[test]
    fn arguments_do_not_contradict_each_other() {
        Arguments::command().debug_assert();
    }
}
