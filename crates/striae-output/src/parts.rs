//! Names of the files of fields, without number and ending.
//!
//! ```text
//! BODY    rigid-NAME    contact-PAIR-BODY    tie-NAME-BODY
//! ```
//!
//! Names are made fit for files, and no two parts have the same, see [`Stems`].

use std::path::PathBuf;

use striae_files::Stems;
use striae_solve::problem::Problem;

/// Names of all parts of a problem, in the order of the model.
pub(crate) struct Parts {
    /// Of bodies.
    pub bodies: Vec<String>,
    /// Of rigid surfaces.
    pub rigid: Vec<String>,
    /// Of pairs, by side; empty for rigid sides.
    pub contact: Vec<[String; 2]>,
    /// Of ties, by side.
    pub ties: Vec<[String; 2]>,
}

impl Parts {
    /// Parts of a problem.
    pub fn new(problem: &Problem) -> Self {
        let model = &problem.model;
        let mut stems = Stems::default();
        let bodies = model.bodies.iter();
        let bodies = bodies.map(|body| stems.take(&body.name)).collect();
        let rigid = model.rigid_surfaces.iter();
        let rigid = rigid
            .map(|rigid| stems.take(&format!("rigid-{}", rigid.name)))
            .collect();
        let pairs = model.pairs.iter().zip(&problem.pairs);
        let contact = pairs
            .map(|(pair, geometry)| {
                geometry.bodies.map(|body| {
                    body.map_or_else(String::new, |body| {
                        let body = &model.bodies[body].name;
                        stems.take(&format!("contact-{}-{body}", pair.name))
                    })
                })
            })
            .collect();
        let ties = model.ties.iter().zip(&problem.ties.joints);
        let ties = ties
            .map(|(tie, joint)| {
                joint.bodies.map(|body| {
                    let body = &model.bodies[body].name;
                    stems.take(&format!("tie-{}-{body}", tie.name))
                })
            })
            .collect();
        Self {
            bodies,
            rigid,
            contact,
            ties,
        }
    }
}

/// The file of a part after so many increments, in the folder of a run.
pub(crate) fn file(part: &str, count: usize) -> PathBuf {
    PathBuf::from(format!("fields/{part}-{count:05}.vtu"))
}

/// The file that names the pieces of a part.
pub(crate) fn file_of_pieces(part: &str, count: usize) -> PathBuf {
    PathBuf::from(format!("fields/{part}-{count:05}.pvtu"))
}

/// The piece of a rank.
pub(crate) fn piece(part: &str, count: usize, rank: usize) -> PathBuf {
    PathBuf::from(format!("fields/{part}-{count:05}.{rank}.vtu"))
}

/// Returns whether a file belongs to an increment, whole or a piece.
pub(crate) fn is_of(name: &str, increment: usize) -> bool {
    let stem = ["vtu", "pvtu"].into_iter().find_map(|end| {
        let stem = name.strip_suffix(end)?;
        stem.strip_suffix('.')
    });
    let of = |stem: &str| stem.ends_with(&format!("-{increment:05}"));
    let is_number = |rank: &str| rank.bytes().all(|byte| byte.is_ascii_digit());
    stem.is_some_and(|stem| {
        let piece = stem.rsplit_once('.');
        of(stem) || piece.is_some_and(|(stem, rank)| is_number(rank) && of(stem))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_an_increment_are_known() {
        for name in ["a-00012.vtu", "a-00012.pvtu", "a-00012.3.vtu"] {
            assert!(is_of(name, 12) && !is_of(name, 2), "{name}");
        }
        assert!(!is_of("a-00012.txt", 12) && !is_of("a-00012.x.vtu", 12));
    }
}
