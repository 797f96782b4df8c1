//! Dependencies that crates may have on each other.
//!
//! The table is the ladder of `ARCHITECTURE.md`: a crate may use only those in its row. Tests may
//! use more. [`VERIFICATION`] serves tests and the published cases, nothing else.
//!
//! Longer than other files, as it is one table.

use crate::breach::Breach;

use super::metadata::{Kind, Package};

/// Dependencies that a crate may have.
struct Row {
    name: &'static str,
    own: &'static [&'static str],
    outside: &'static [&'static str],
}

/// The crate of closed forms, rates and checks of derivatives.
const VERIFICATION: &str = "striae-verify";

const LADDER: &[Row] = &[
    Row {
        name: "striae-declared",
        own: &[],
        outside: &["thiserror"],
    },
    Row {
        name: "striae-mesh",
        own: &["striae-declared"],
        outside: &["nalgebra", "serde", "thiserror"],
    },
    Row {
        name: "striae-law",
        own: &["striae-declared", "striae-verify"],
        outside: &["nalgebra", "num-dual", "serde", "thiserror"],
    },
    Row {
        name: "striae-element",
        own: &["striae-law", "striae-mesh"],
        outside: &["nalgebra", "pulp", "serde", "thiserror"],
    },
    Row {
        name: "striae-surface",
        own: &["striae-declared", "striae-mesh"],
        outside: &["nalgebra", "num-dual", "serde", "thiserror"],
    },
    Row {
        name: "striae-contact",
        own: &["striae-law", "striae-mesh", "striae-surface"],
        outside: &[
            "crc32fast",
            "nalgebra",
            "num-dual",
            "pulp",
            "rayon",
            "serde",
            "thiserror",
        ],
    },
    Row {
        name: "striae-model",
        own: &[
            "striae-contact",
            "striae-element",
            "striae-law",
            "striae-mesh",
            "striae-surface",
        ],
        outside: &[
            "nalgebra",
            "num-dual",
            "rayon",
            "serde",
            "strsim",
            "thiserror",
        ],
    },
    Row {
        name: "striae-sparse",
        own: &[],
        // `bitflags`, `libc` and `syn`, as `memchr` below, for their features alone.
        outside: &[
            "bitflags",
            "faer",
            "libc",
            "metis-sys",
            "pulp",
            "rayon",
            "syn",
            "thiserror",
        ],
    },
    Row {
        name: "striae-condensed",
        own: &["striae-sparse"],
        outside: &["faer", "pulp", "rayon", "serde", "thiserror"],
    },
    Row {
        name: "striae-solve",
        own: &[
            "striae-condensed",
            "striae-contact",
            "striae-element",
            "striae-law",
            "striae-mesh",
            "striae-model",
            "striae-sparse",
            "striae-surface",
        ],
        outside: &["nalgebra", "num-dual", "rayon", "serde", "thiserror"],
    },
    Row {
        name: "striae-petsc",
        own: &["striae-condensed", "striae-solve", "striae-sparse"],
        outside: &["mpi", "rayon", "thiserror"],
    },
    Row {
        name: "striae-files",
        own: &[],
        outside: &["thiserror"],
    },
    Row {
        name: "striae-figure",
        own: &["striae-files"],
        outside: &[
            "ab_glyph",
            "dejavu",
            "gif",
            "plotters",
            "plotters-backend",
            "png",
            "thiserror",
        ],
    },
    Row {
        name: "striae-meshfile",
        own: &["striae-mesh"],
        outside: &["base64", "flate2", "roxmltree", "thiserror"],
    },
    Row {
        name: "striae-output",
        own: &[
            "striae-contact",
            "striae-element",
            "striae-files",
            "striae-mesh",
            "striae-model",
            "striae-solve",
            "striae-surface",
        ],
        outside: &[
            "crc32fast",
            "flate2",
            "nalgebra",
            "postcard",
            "serde",
            "serde_json",
            "thiserror",
            "toml",
        ],
    },
    Row {
        name: "striae-report",
        own: &["striae-figure", "striae-files", "striae-output"],
        outside: &[
            "flate2",
            "rayon",
            "serde",
            "serde_json",
            "thiserror",
            "toml",
        ],
    },
    Row {
        name: "striae-deck",
        own: &[
            "striae-declared",
            "striae-files",
            "striae-law",
            "striae-mesh",
            "striae-meshfile",
            "striae-model",
            "striae-output",
            "striae-solve",
            "striae-surface",
        ],
        outside: &["memchr", "serde_json", "thiserror", "toml"],
    },
    Row {
        name: "striae",
        own: &[
            "striae-contact",
            "striae-deck",
            "striae-declared",
            "striae-element",
            "striae-figure",
            "striae-files",
            "striae-law",
            "striae-mesh",
            "striae-meshfile",
            "striae-model",
            "striae-output",
            "striae-solve",
            "striae-surface",
        ],
        outside: &["nalgebra", "num-dual", "thiserror"],
    },
    Row {
        name: "striae-cases",
        own: &[
            "striae",
            "striae-contact",
            "striae-deck",
            "striae-figure",
            "striae-law",
            "striae-mesh",
            "striae-output",
            "striae-solve",
            "striae-surface",
            "striae-files",
            "striae-model",
            VERIFICATION,
        ],
        outside: &["nalgebra", "thiserror"],
    },
    Row {
        name: "striae-cli",
        own: &[
            "striae",
            "striae-cases",
            "striae-contact",
            "striae-deck",
            "striae-declared",
            "striae-figure",
            "striae-files",
            "striae-law",
            "striae-mesh",
            "striae-model",
            "striae-output",
            "striae-petsc",
            "striae-report",
            "striae-solve",
            "striae-surface",
        ],
        outside: &[
            "clap",
            "clap_complete",
            "clap_mangen",
            "ctrlc",
            "indicatif",
            "mimalloc",
            "nix",
            "rayon",
            "serde_json",
            "thiserror",
        ],
    },
    Row {
        name: "striae-py",
        own: &["striae", "striae-report"],
        outside: &["nalgebra", "numpy", "postcard", "pyo3", "rayon"],
    },
    Row {
        name: "striae-bench",
        own: &[
            "striae-condensed",
            "striae-contact",
            "striae-deck",
            "striae-element",
            "striae-figure",
            "striae-output",
            "striae-law",
            "striae-mesh",
            "striae-model",
            "striae-solve",
            "striae-sparse",
            "striae-surface",
        ],
        outside: &["faer", "nalgebra", "serde_json"],
    },
    Row {
        name: "striae-mutants",
        own: &["striae"],
        outside: &["crc32fast", "libfuzzer-sys"],
    },
    Row {
        name: VERIFICATION,
        own: &[],
        outside: &["nalgebra"],
    },
    Row {
        name: "xtask",
        own: &[],
        outside: &[
            "flate2",
            "math-core",
            "png",
            "pulldown-cmark",
            "serde_json",
            "thiserror",
            "toml",
        ],
    },
];

/// Dependencies that the table does not allow.
pub fn breaches(packages: &[Package]) -> Vec<Breach> {
    packages.iter().flat_map(of_package).collect()
}

fn of_package(package: &Package) -> Vec<Breach> {
    let breach = |wrong: String| Breach {
        place: package.name.clone(),
        wrong,
    };
    let Some(row) = LADDER.iter().find(|row| row.name == package.name) else {
        return vec![breach(
            "has no row in xtask/src/borders/dependencies.rs".into(),
        )];
    };
    package
        .dependencies
        .iter()
        .filter(|dependency| dependency.kind == Kind::Product)
        .map(|dependency| dependency.name.as_str())
        .filter(|name| !row.own.contains(name) && !row.outside.contains(name))
        .map(|name| breach(format!("must not depend on `{name}`")))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::borders::metadata::Dependency;

    fn package(name: &str, dependencies: &[(&str, Kind)]) -> Package {
        let dependency = |(name, kind): &(&str, Kind)| Dependency {
            name: (*name).into(),
            kind: *kind,
        };
        Package {
            name: name.into(),
            folder: "crates".into(),
            dependencies: dependencies.iter().map(dependency).collect(),
        }
    }

    fn found(name: &str, dependencies: &[(&str, Kind)]) -> Vec<String> {
        let breaches = breaches(&[package(name, dependencies)]);
        breaches.iter().map(Breach::to_string).collect()
    }

    #[test]
    fn a_crate_may_look_down_but_not_up_or_sideways() {
        use Kind::Product;
        assert!(found("striae-contact", &[("striae-surface", Product)]).is_empty());
        assert_eq!(
            found("striae-surface", &[("striae-contact", Product)]),
            ["striae-surface: must not depend on `striae-contact`"]
        );
        assert_eq!(
            found("striae-law", &[("striae-mesh", Product), ("toml", Product)]),
            [
                "striae-law: must not depend on `striae-mesh`",
                "striae-law: must not depend on `toml`"
            ]
        );
    }

    #[test]
    fn tests_may_use_more_and_products_but_laws_and_cases_no_verification() {
        for row in LADDER {
            assert!(found(row.name, &[(VERIFICATION, Kind::Development)]).is_empty());
            let breaches = found(row.name, &[(VERIFICATION, Kind::Product)]).len();
            assert_eq!(
                breaches,
                usize::from(!["striae-law", "striae-cases"].contains(&row.name)),
                "{}",
                row.name
            );
        }
    }

    #[test]
    fn a_crate_without_a_row_is_refused() {
        assert_eq!(found("striae-new", &[]).len(), 1);
    }

    #[test]
    fn rows_name_only_crates_that_stand_below_them() {
        // The ladder has no cycles and few rungs: every crate is reached by going down only.
        fn depth(name: &str, left: usize) -> usize {
            assert!(left > 0, "cycle through {name}");
            let row = LADDER.iter().find(|row| row.name == name).unwrap();
            let below = row.own.iter().map(|own| depth(own, left - 1));
            1 + below.max().unwrap_or(0)
        }
        for row in LADDER {
            assert!(depth(row.name, LADDER.len()) <= 11, "{}", row.name);
        }
    }
}
