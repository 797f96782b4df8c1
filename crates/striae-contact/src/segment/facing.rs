//! Segments of facets that hardly face each other.
//!
//! With `c = n_a . n_b` and the cosine `l` up to which facets oppose each other, everything that
//! is integrated over a segment counts by a share:
//!
//! ```text
//! t = (l - c)/w, kept in [0, 1]        s = t^2 (3 - 2 t)        w = RAMP
//! ds = -6 t (1 - t)/w dc,   dc = n_b . dn_a + n_a . dn_b
//! ```
//!
//! A facet that turns away while it is pressed would otherwise lose a seventh of its area at once,
//! and an increment that ends there has no solution.

use nalgebra::Matrix3;
use striae_mesh::Vec3;

use super::{
    Slopes,
    sums::add,
    support::{Pressed, PressedSlopes},
};

/// Range of the cosine over which segments fade.
const RAMP: f64 = 0.2;

/// Share of a segment that counts, where it is less than all of it.
#[derive(Clone, Debug)]
pub(super) struct Faded {
    /// `s`, above zero and below one.
    share: f64,
    /// `ds/dx`, column `3 k + i` for `x_k . e_i`.
    slopes: [f64; 24],
    /// `D` if all of it counted.
    pub whole: [[f64; 8]; 8],
}

/// Share of a segment that counts, by the angle of its facets.
pub(super) enum Facing {
    /// All of it counts.
    Whole,
    /// The share and its derivative by the cosine.
    Part(f64, f64),
}

impl Facing {
    /// `None` where facets do not face each other.
    pub fn of(cosine: f64, limit: f64) -> Option<Self> {
        let t = (limit - cosine) / RAMP;
        let share = t * t * (3.0 - 2.0 * t);
        match t {
            t if t >= 1.0 => Some(Self::Whole),
            t if t > 0.0 && share > 0.0 => Some(Self::Part(share, -6.0 * t * (1.0 - t) / RAMP)),
            _ => None,
        }
    }
}

impl Faded {
    /// Fades what is integrated over a segment, from the derivatives of the normal of each side
    /// and the normal of the other one.
    pub fn new(
        (share, by_cosine): (f64, f64),
        normals: &[(Vec3, [Matrix3<f64>; 4])],
        (area, mass): (&mut f64, &mut [[f64; 8]; 8]),
        slopes: Option<&mut Slopes>,
    ) -> Self {
        let mut by_x = [0.0; 24];
        for (side, (other, own)) in normals.iter().enumerate() {
            for (corner, slope) in own.iter().enumerate() {
                let along = slope.tr_mul(other) * by_cosine;
                let at = 12 * side + 3 * corner;
                by_x[at..at + 3].copy_from_slice(along.as_slice());
            }
        }
        let faded = Self {
            share,
            slopes: by_x,
            whole: *mass,
        };
        *area *= share;
        mass.iter_mut().flatten().for_each(|value| *value *= share);
        for (pair, row) in slopes
            .into_iter()
            .flat_map(|own| own.mass.iter_mut().enumerate())
        {
            let (c, d) = super::of_pair(pair);
            faded.fade(row, faded.whole[c][d]);
        }
        faded
    }

    /// The derivatives of `s v` from those of `v`.
    fn fade(&self, row: &mut [f64; 24], value: f64) {
        row.iter_mut().for_each(|slope| *slope *= self.share);
        add(row, value, &self.slopes);
    }

    /// Integrals of pressure over the part that counts, from those over the whole.
    pub fn pressed(&self, mut pressed: Pressed) -> Pressed {
        let Pressed {
            force,
            rows,
            closed,
            area,
            slopes,
            ..
        } = &mut pressed;
        if let Some(slopes) = slopes {
            let PressedSlopes {
                force: by_x,
                rows: rows_by_x,
                force_by_pressure,
                rows_by_pressure,
            } = &mut **slopes;
            let of_force = by_x.iter_mut().zip(&*force);
            let of_rows = rows_by_x.iter_mut().zip(&*rows);
            of_force
                .chain(of_rows)
                .for_each(|(row, value)| self.fade(row, *value));
            let by_pressure = force_by_pressure.iter_mut().flatten();
            by_pressure
                .chain(rows_by_pressure)
                .for_each(|value| *value *= self.share);
        }
        let values = force.iter_mut().chain(rows).chain(closed).chain([area]);
        values.for_each(|value| *value *= self.share);
        pressed
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector, Rotation3};
    use striae_surface::facet::Shape;
    use striae_verify::assert_derivative;

    use super::*;
    use crate::segment::{
        Derivatives, FACING, Facet, Pressing, Segment, Support, facet_normal, plane_segment,
        segment,
    };

    /// A square that looks up, and one above it that looks down and is turned to this cosine.
    fn pair(cosine: f64) -> DVector<f64> {
        let turn = Rotation3::from_axis_angle(&Vec3::x_axis(), (-cosine).acos());
        let a = [[0.0, 0.0], [1.0, 0.1], [1.1, 1.0], [0.1, 0.9]].map(|[x, y]| Vec3::new(x, y, 0.0));
        let b = [[0.2, 0.1], [0.3, 1.2], [1.2, 1.1], [1.1, 0.0]]
            .map(|[x, y]| turn * Vec3::new(x, y - 0.5, 0.0) + Vec3::new(0.0, 0.5, 0.2));
        let corners = a.iter().chain(&b);
        DVector::from_iterator(24, corners.flat_map(|x| [x.x, x.y, x.z]))
    }

    fn facets(x: &DVector<f64>) -> [Facet; 2] {
        [0, 12].map(|first| Facet {
            corners: std::array::from_fn(|c| Vec3::from_fn(|i, _| x[first + 3 * c + i])),
            shape: Shape::Quadrilateral,
        })
    }

    fn cosine(x: &DVector<f64>) -> f64 {
        let [n_a, n_b] = facets(x).map(|facet| facet_normal(&facet).unwrap());
        n_a.dot(&n_b)
    }

    /// Pressure of a node of each side, partly open.
    fn pressed(found: &Segment, x: &DVector<f64>) -> Pressed {
        let support = |first: usize, pressure: f64| Support {
            shares: std::array::from_fn(|c| if c / 4 == first { 0.25 } else { 0.0 }),
            pressure,
            bedding: 1.0,
            full: 1.0,
        };
        let [a, b] = facets(x);
        let corners: Vec<Vec3> = a.corners.iter().chain(&b.corners).copied().collect();
        let heights = std::array::from_fn(|c| {
            let height = found.normal.dot(&corners[c]);
            if c < 4 { -height } else { height }
        });
        let supports = vec![support(0, 3.0), support(1, 2.0)];
        found.pressed(&a, &Pressing::new(supports, heights, [0.0; 2]))
    }

    fn values(pressed: &Pressed) -> DVector<f64> {
        let values = pressed.force.iter().chain(&pressed.rows).copied();
        DVector::from_iterator(10, values)
    }

    fn slopes(pressed: &Pressed) -> DMatrix<f64> {
        let slopes = pressed.slopes.as_ref().unwrap();
        let rows: Vec<&[f64; 24]> = slopes.force.iter().chain(&slopes.rows).collect();
        DMatrix::from_fn(10, 24, |row, lane| rows[row][lane])
    }

    #[test]
    fn pressure_on_fading_segments_has_the_right_derivatives() {
        for cosine in [-0.37, -0.3, -0.24] {
            let origin = pair(cosine);
            assert!((self::cosine(&origin) - cosine).abs() < 1e-12);
            // Differences stay within the range that fades.
            let place = |z: &DVector<f64>| &origin + z * 0.1;
            for compliance in [[1.0, 1.0], [0.3, 1.0]] {
                let at = |x: &DVector<f64>, derivatives| {
                    let [a, b] = facets(x);
                    let found = segment(&a, &b, compliance, derivatives).expect("they overlap");
                    pressed(&found, x)
                };
                assert_derivative(
                    |z| values(&at(&place(z), Derivatives::None)),
                    |z| slopes(&at(&place(z), Derivatives::First)) * 0.1,
                    &DVector::zeros(24),
                );
            }
        }
    }

    #[test]
    fn pressure_against_planes_fades_with_the_right_derivatives() {
        let origin = pair(-0.3);
        for cosine in [-0.37f64, -0.3, -0.24] {
            let sine = (1.0 - cosine * cosine).sqrt();
            let normal = Vec3::new(0.0, sine, cosine);
            let at = |x: &DVector<f64>, derivatives| {
                let found = plane_segment(&facets(x)[0], &normal, derivatives).expect("they face");
                pressed(&found, x)
            };
            let place = |z: &DVector<f64>| &origin + z * 0.1;
            assert_derivative(
                |z| values(&at(&place(z), Derivatives::None)),
                |z| slopes(&at(&place(z), Derivatives::First)) * 0.1,
                &DVector::zeros(24),
            );
        }
    }

    #[test]
    fn swapped_sides_fade_by_the_same_share() {
        let [a, b] = facets(&pair(-0.3));
        for [c_a, c_b] in [[1.0, 1.0], [0.3, 1.0], [1.0, 0.0]] {
            let at = |a: &Facet, b: &Facet, compliance| {
                segment(a, b, compliance, Derivatives::First).expect("they overlap")
            };
            let (own, other) = (at(&a, &b, [c_a, c_b]), at(&b, &a, [c_b, c_a]));
            assert!((own.area / other.area - 1.0).abs() < 1e-12);
            let [own, other] = [own.faded, other.faded].map(|faded| faded.unwrap());
            assert!((own.share - other.share).abs() < 1e-15);
            for lane in 0..24 {
                let swapped = other.slopes[(lane + 12) % 24];
                assert!((own.slopes[lane] - swapped).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn segments_fade_from_all_to_nothing() {
        let share = |cosine| match Facing::of(cosine, FACING) {
            Some(Facing::Whole) => 1.0,
            Some(Facing::Part(share, _)) => share,
            None => 0.0,
        };
        let shares = [-0.401, -0.399, -0.3, -0.201, -0.199].map(share);
        assert_eq!([shares[0], shares[4]], [1.0, 0.0]);
        assert!(shares[1] > 0.999 && shares[3] < 1e-3, "{shares:?}");
        assert!((shares[2] - 0.5).abs() < 1e-12);
    }
}
