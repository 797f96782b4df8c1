//! Parts put into their places.
//!
//! A row `x, y, z` below `*INSTANCE` moves the part, a second row `a, b, angle` then turns it
//! about the axis from the point `a` to `b` by the right-hand rule (degrees). With the unit
//! vector `k` of the axis,
//!
//! ```text
//! v = x + t - a,   x' = a + v cos(angle) + k x v sin(angle) + k (k . v)(1 - cos(angle)).
//! ```
//!
//! Source: Abaqus keywords reference guide, `*INSTANCE`.

use super::super::MeshFileFault;
use super::keywords::{Keyword, Row};
use super::number;
use striae_mesh::Vec3;

/// Placement of a part: the offset of its numbers, the prefix of its labels, and the motion of its
/// nodes.
pub(super) struct Placement {
    pub(super) raise: u64,
    pub(super) prefix: String,
    pub(super) motion: Motion,
}

/// A translation, and a turn after it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Motion {
    translation: Vec3,
    turn: Option<Turn>,
}

#[derive(Clone, Copy, Debug)]
struct Turn {
    point: Vec3,
    /// Of unit length.
    axis: Vec3,
    radians: f64,
}

impl Keyword<'_> {
    /// Image of a point of its part under an `*INSTANCE`; `None` if its rows are faulty.
    pub fn placed(&self, x: Vec3) -> Option<Vec3> {
        Motion::read(self).ok().map(|motion| motion.moved(x))
    }
}

impl Motion {
    /// The motion that the first rows of `*INSTANCE` state.
    pub(super) fn read(keyword: &Keyword<'_>) -> Result<Self, MeshFileFault> {
        let mut motion = Self::default();
        let mut rows = keyword.rows.iter();
        if let Some(row) = rows.next() {
            motion.translation = Vec3::from(numbers::<3>(row, "a translation of three numbers")?);
        }
        if let Some(row) = rows.next() {
            let expected = "two points of an axis and an angle";
            let [ax, ay, az, bx, by, bz, degrees] = numbers::<7>(row, expected)?;
            let (point, end) = (Vec3::new(ax, ay, az), Vec3::new(bx, by, bz));
            let axis = (end - point).try_normalize(0.0);
            motion.turn = Some(Turn {
                point,
                axis: axis.ok_or_else(|| row.fault("two different points of an axis"))?,
                radians: degrees.to_radians(),
            });
        }
        match rows.next() {
            None => Ok(motion),
            Some(row) => Err(row.fault("a keyword such as *END INSTANCE")),
        }
    }

    /// Image of a point.
    pub(super) fn moved(&self, x: Vec3) -> Vec3 {
        let x = x + self.translation;
        let Some(Turn {
            point,
            axis,
            radians,
        }) = self.turn
        else {
            return x;
        };
        let (sin, cos) = radians.sin_cos();
        let v = x - point;
        point + v * cos + axis.cross(&v) * sin + axis * (axis.dot(&v) * (1.0 - cos))
    }
}

/// So many finite numbers of a row; those that are missing are zero.
fn numbers<const N: usize>(row: &Row<'_>, expected: &str) -> Result<[f64; N], MeshFileFault> {
    let mut found = [0.0; N];
    let words = row.words.iter().filter(|word| !word.is_empty());
    if words.count() == 0 || row.words.iter().rposition(|word| !word.is_empty()) >= Some(N) {
        return Err(row.fault(expected));
    }
    for (value, word) in found.iter_mut().zip(&row.words) {
        if !word.is_empty() {
            let number = number(word).filter(|number| number.is_finite());
            *value = number.ok_or_else(|| row.fault(expected))?;
        }
    }
    Ok(found)
}
