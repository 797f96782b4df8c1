#!/bin/sh
# Compiles the crates of the workspace for libFuzzer, which counts the edges that an input passes
# and looks at what is compared. `cargo xtask fuzz` names it as RUSTC_WORKSPACE_WRAPPER: crates
# of others are compiled as always. Integers that overflow panic, as in debug builds.
case " $* " in
*" build_script_build "* | *" proc-macro "*) exec "$@" ;;
esac
exec "$@" -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
    -Cllvm-args=-sanitizer-coverage-inline-8bit-counters \
    -Cllvm-args=-sanitizer-coverage-pc-table \
    -Cllvm-args=-sanitizer-coverage-trace-compares \
    -Coverflow-checks=yes
