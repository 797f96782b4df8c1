//! A body, a side of a pair or a rigid surface over all times, as a skin with arrays.
//!
//! Places are a rest position in single precision and a displacement, so that deformations
//! can be magnified: `displacement` where the files have it, otherwise how far points have
//! gone since the first file. A side of a pair lies on a body and follows its nodes.

use std::{
    collections::HashMap,
    path::{Path, PathBuf},
};

use rayon::prelude::*;
use striae_output::vtk::{Stored, StoredValues};

use crate::{
    ReportError,
    boundary::Skin,
    invariants::extremes,
    quantised::Quantised,
    results::{Kind, Results},
};

/// Arrays that repeat others, or that few need.
const LEFT_OUT: [&str; 3] = ["structural_vector", "mean_traction", "normal"];

/// Field of the displacements of points, for files without `displacement`.
const MOTION: &str = "motion";

/// A surface over time.
pub struct Part {
    /// Its name.
    pub name: String,
    /// Kind of the part.
    pub kind: Kind,
    /// Its file at every time, where there is one.
    files: Vec<Option<PathBuf>>,
    /// The surface.
    pub skin: Skin,
    /// Rest positions of its nodes.
    pub rest: Vec<[f64; 3]>,
    /// The arrays.
    pub arrays: Vec<Field>,
    /// Place in `arrays` of the displacements.
    pub motion: usize,
    /// The body that its nodes lie on: its place among the parts, and their nodes.
    pub follows: Option<(usize, Vec<u32>)>,
}

/// An array over time.
pub struct Field {
    /// Its name.
    pub name: String,
    /// Numbers a point.
    pub components: usize,
    /// At every time, where it is known.
    pub times: Vec<Option<Moment>>,
}

/// An array at one time.
pub struct Moment {
    /// On the skin.
    pub quantised: Quantised,
    /// Least and largest value of every view, inside the body included.
    pub extremes: Vec<Option<[f64; 2]>>,
}

/// All parts of results at some times.
///
/// # Errors
/// When a file cannot be read, or does not go with the others.
pub fn parts(results: &Results, times: &[f64]) -> Result<Vec<Part>, ReportError> {
    let mut parts: Vec<Part> = Vec::new();
    for (kind, series) in &results.series {
        let mut names: Vec<&String> = Vec::new();
        for (name, _) in series.iter().flat_map(|snapshot| &snapshot.parts) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        for name in names {
            let file = |time: &f64| {
                let snapshot = series
                    .iter()
                    .rev()
                    .find(|snapshot| snapshot.time == *time)?;
                let (_, file) = snapshot.parts.iter().find(|(part, _)| part == name)?;
                Some(results.folder.join(file))
            };
            let files: Vec<Option<PathBuf>> = times.iter().map(file).collect();
            parts.extend(part(name, *kind, &files)?);
        }
    }
    follow(&mut parts)?;
    Ok(parts)
}

/// A part, if there is a file at any time.
fn part(name: &str, kind: Kind, files: &[Option<PathBuf>]) -> Result<Option<Part>, ReportError> {
    let Some(first) = files.iter().flatten().next() else {
        return Ok(None);
    };
    let stored = Stored::open(first)?;
    let shape = |shape| ReportError::Shape {
        path: first.clone(),
        shape,
    };
    let skin = Skin::of(&stored.cells(first)?).map_err(shape)?;
    let points = stored.points(first)?;
    let displacement = stored
        .array(first, "displacement")?
        .filter(|u| u.components == 3);
    let rest = |node: &usize| match &displacement {
        Some(u) => [0, 1, 2].map(|axis| points[*node][axis] - u.numbers[3 * node + axis]),
        None => points[*node],
    };
    let rest: Vec<[f64; 3]> = skin.nodes.iter().map(rest).collect();
    let read = |file: &Option<PathBuf>| match file {
        Some(path) => moments(path, &skin, &rest, points.len()).map(Some),
        None => Ok(None),
    };
    let read: Result<Vec<_>, ReportError> = files.par_iter().map(read).collect();
    let arrays = by_name(read?);
    let motion = arrays
        .iter()
        .position(|a| a.name == "displacement" || a.name == MOTION);
    Ok(Some(Part {
        name: name.to_owned(),
        kind,
        files: files.to_vec(),
        motion: motion.expect("each file gives a motion"),
        rest,
        arrays,
        skin,
        follows: None,
    }))
}

/// Arrays of a file on the skin, with the extremes of the whole file.
fn moments(
    path: &Path,
    skin: &Skin,
    rest: &[[f64; 3]],
    expected: usize,
) -> Result<Vec<(String, usize, Moment)>, ReportError> {
    let stored = Stored::open(path)?;
    let names: Vec<(String, usize)> = stored.names().map(|(n, c)| (n.to_owned(), c)).collect();
    let has = |wanted: &str| names.iter().any(|(name, _)| name == wanted);
    let mut moments = Vec::new();
    for (name, components) in &names {
        let said = LEFT_OUT.contains(&name.as_str()) || name == "von_mises" && has("cauchy_stress");
        if said {
            continue;
        }
        let Some(values) = stored.array(path, name)? else {
            continue;
        };
        check(path, values.numbers.len() / components, expected)?;
        let moment = Moment {
            quantised: on_skin(&values, &skin.nodes),
            extremes: extremes(*components, &values.numbers),
        };
        moments.push((name.clone(), *components, moment));
    }
    if !has("displacement") {
        let points = stored.points(path)?;
        check(path, points.len(), expected)?;
        let way = skin.nodes.iter().zip(rest);
        let way =
            way.flat_map(|(node, rest)| [0, 1, 2].map(|axis| points[*node][axis] - rest[axis]));
        let numbers: Vec<f64> = way.collect();
        let moment = Moment {
            quantised: Quantised::new(3, &numbers),
            extremes: extremes(3, &numbers),
        };
        moments.push((MOTION.to_owned(), 3, moment));
    }
    Ok(moments)
}

fn check(path: &Path, found: usize, expected: usize) -> Result<(), ReportError> {
    if found == expected {
        return Ok(());
    }
    let path = path.to_owned();
    Err(ReportError::Points {
        path,
        found,
        expected,
    })
}

fn on_skin(values: &StoredValues, nodes: &[usize]) -> Quantised {
    let components = values.components;
    let row = |node: &usize| &values.numbers[node * components..][..components];
    let numbers: Vec<f64> = nodes.iter().flat_map(row).copied().collect();
    Quantised::new(components, &numbers)
}

fn by_name(read: Vec<Option<Vec<(String, usize, Moment)>>>) -> Vec<Field> {
    let count = read.len();
    let mut fields: Vec<Field> = Vec::new();
    for (time, moments) in read.into_iter().enumerate() {
        for (name, components, moment) in moments.into_iter().flatten() {
            let known = fields
                .iter()
                .position(|f| f.name == name && f.components == components);
            let at = known.unwrap_or_else(|| {
                fields.push(Field {
                    name,
                    components,
                    times: (0..count).map(|_| None).collect(),
                });
                fields.len() - 1
            });
            fields[at].times[time] = Some(moment);
        }
    }
    fields
}

/// Lets sides of pairs follow the bodies on which they lie: where all their points are, to
/// the last bit, points of the body's skin at the first time that both have.
fn follow(parts: &mut [Part]) -> Result<(), ReportError> {
    for at in 0..parts.len() {
        if parts[at].kind != Kind::Contact {
            continue;
        }
        for body in 0..parts.len() {
            let [side, on] = [&parts[at], &parts[body]];
            if on.kind == Kind::Body
                && side.name.ends_with(&format!("-{}", on.name))
                && let Some(nodes) = common(side, on)?
            {
                parts[at].follows = Some((body, nodes));
                break;
            }
        }
    }
    Ok(())
}

/// Nodes of a body's skin on which the nodes of a side lie.
fn common(side: &Part, body: &Part) -> Result<Option<Vec<u32>>, ReportError> {
    let mut both = side.files.iter().zip(&body.files);
    let Some((Some(side_file), Some(body_file))) = both.find(|(a, b)| a.is_some() && b.is_some())
    else {
        return Ok(None);
    };
    let points = |path: &PathBuf, skin: &Skin| {
        let points = Stored::open(path)?.points(path)?;
        let bits = |node: &usize| points[*node].map(f64::to_bits);
        Ok::<_, ReportError>(skin.nodes.iter().map(bits).collect::<Vec<_>>())
    };
    let places: HashMap<[u64; 3], u32> = points(body_file, &body.skin)?
        .into_iter()
        .zip(0..)
        .collect();
    let own = points(side_file, &side.skin)?;
    Ok(own.iter().map(|x| places.get(x).copied()).collect())
}
