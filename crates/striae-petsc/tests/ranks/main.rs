//! Ranks and solvers, run as `mpirun -n N ...`; `cargo xtask mpi` does so for some N.
//!
//! Arguments: none for all checks; `growth SIDE...` for iterations, times and memory of
//! blocks of these sizes; `panic` to see that a rank that panics ends all.

#[cfg(feature = "petsc")]
mod blocks;
#[cfg(feature = "petsc")]
mod checks;
#[cfg(feature = "petsc")]
mod growth;

#[cfg(feature = "petsc")]
fn main() {
    use striae_petsc::Ranks;
    use striae_solve::team::Team;

    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let ranks = Ranks::start(&[]).expect("MPI and PETSc start");
    match words[..] {
        ["growth", ref sides @ ..] => {
            growth::report(&ranks, sides);
        }
        ["panic"] => {
            assert_ne!(ranks.rank() + 1, ranks.size(), "the last rank panics");
            ranks.gather(&[]);
            loop {
                std::thread::park();
            }
        }
        _ => checks::all(&ranks),
    }
}

#[cfg(not(feature = "petsc"))]
fn main() {}
