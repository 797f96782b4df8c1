#!/bin/sh
# Compiles the crates of the workspace for `striae-fuzz`: integers that overflow panic, and the
# crates that read input count the edges that an input passes and tell libFuzzer what they
# compare. Crates that solve are not counted: what happens there says little about the input, and
# takes long. All are optimised, as the time that an input takes is judged. `cargo xtask fuzz`
# names this script as RUSTC_WORKSPACE_WRAPPER, so that crates of others are compiled as always.
case " $* " in
*" --crate-name striae_mesh "* | *" --crate-name striae_model "* | *" --crate-name striae_files "* | \
    *" --crate-name striae_meshfile "* | *" --crate-name striae_output "* | \
    *" --crate-name striae_deck "* | *" --crate-name striae_law "* | *" --crate-name striae "*)
    set -- "$@" -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
        -Cllvm-args=-sanitizer-coverage-inline-8bit-counters \
        -Cllvm-args=-sanitizer-coverage-pc-table \
        -Cllvm-args=-sanitizer-coverage-trace-compares
    ;;
esac
exec "$@" -Coverflow-checks=yes -Copt-level=3
