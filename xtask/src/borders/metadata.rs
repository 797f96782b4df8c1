//! The crates of the workspace and what they depend on, from `cargo metadata`.

use std::path::PathBuf;

use serde_json::Value;

use crate::{cargo, fault::Fault};

/// The workspace.
pub struct Workspace {
    /// Its folder.
    pub root: PathBuf,
    /// Its crates.
    pub packages: Vec<Package>,
}

/// A crate of the workspace.
#[derive(Debug, PartialEq, Eq)]
pub struct Package {
    /// Its name.
    pub name: String,
    /// Its folder.
    pub folder: PathBuf,
    /// Dependencies listed in its manifest.
    pub dependencies: Vec<Dependency>,
}

/// A line of a manifest.
#[derive(Debug, PartialEq, Eq)]
pub struct Dependency {
    /// Name of the crate.
    pub name: String,
    /// Target that needs it.
    pub kind: Kind,
}

/// Target that needs a dependency.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The library, the program or the build script.
    Product,
    /// Tests, examples and benchmarks.
    Development,
}

/// Asks cargo for the workspace.
///
/// # Errors
/// When cargo does not answer, or not as expected.
pub fn workspace() -> Result<Workspace, Fault> {
    let json = cargo::answer(&["metadata", "--no-deps", "--format-version", "1"])?;
    read(&json).map_err(Fault::Metadata)
}

fn read(json: &[u8]) -> Result<Workspace, String> {
    let value: Value = serde_json::from_slice(json).map_err(|cause| cause.to_string())?;
    let packages = list(&value, "packages")?.iter().map(package);
    Ok(Workspace {
        root: text(&value, "workspace_root")?.into(),
        packages: packages.collect::<Result<_, _>>()?,
    })
}

fn package(value: &Value) -> Result<Package, String> {
    let manifest = PathBuf::from(text(value, "manifest_path")?);
    let folder = manifest.parent().ok_or("a manifest without a folder")?;
    let dependencies = list(value, "dependencies")?.iter().map(dependency);
    Ok(Package {
        name: text(value, "name")?.to_owned(),
        folder: folder.to_owned(),
        dependencies: dependencies.collect::<Result<_, _>>()?,
    })
}

fn dependency(value: &Value) -> Result<Dependency, String> {
    Ok(Dependency {
        name: text(value, "name")?.to_owned(),
        kind: match value["kind"].as_str() {
            Some("dev") => Kind::Development,
            _ => Kind::Product,
        },
    })
}

fn text<'a>(value: &'a Value, key: &str) -> Result<&'a str, String> {
    value[key].as_str().ok_or(format!("no text `{key}`"))
}

fn list<'a>(value: &'a Value, key: &str) -> Result<&'a Vec<Value>, String> {
    value[key].as_array().ok_or(format!("no list `{key}`"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crates_and_kinds_of_dependencies_are_read() {
        let json = r#"{"workspace_root": "/w", "packages": [{
            "name": "striae-law", "manifest_path": "/w/crates/striae-law/Cargo.toml",
            "dependencies": [{"name": "nalgebra", "kind": null}, {"name": "cc", "kind": "build"},
                             {"name": "proptest", "kind": "dev"}]}]}"#;
        let workspace = read(json.as_bytes()).unwrap();
        let dependency = |name: &str, kind| Dependency {
            name: name.into(),
            kind,
        };
        assert_eq!(workspace.root, PathBuf::from("/w"));
        assert_eq!(
            workspace.packages,
            [Package {
                name: "striae-law".into(),
                folder: "/w/crates/striae-law".into(),
                dependencies: vec![
                    dependency("nalgebra", Kind::Product),
                    dependency("cc", Kind::Product),
                    dependency("proptest", Kind::Development),
                ],
            }]
        );
    }

    #[test]
    fn what_is_missing_is_named() {
        let missing = read(br#"{"workspace_root": "/w", "packages": [{"name": "x", "manifest_path": "/w/x/Cargo.toml"}]}"#);
        assert_eq!(missing.err().as_deref(), Some("no list `dependencies`"));
    }
}
