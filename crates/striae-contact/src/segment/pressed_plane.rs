//! Pressure decided at the points of a facet against an unbounded rigid plane.
//!
//! The integrals are those of [`super::points`]; points are fixed on the facet. A quadrilateral
//! has three by three Gauss points where its corners are all closed or all open: exact, as
//! `N_c phi_k g J` is of degree four in each coordinate. Else it is divided by four, at most
//! [`DIVISIONS`] times, and the smallest parts have four by four Lobatto points, which include
//! their corners.

use striae_mesh::Vec3;
use striae_surface::{facet::Shape, scalar::combination};

use super::{
    Facet, Slopes, closed_share,
    divided::{DIVISIONS, divided},
    plane_facet::Vec2,
    rule,
    support::{OfSupport, Point, Pressed, PressedSlopes, Pressing, over_bedding},
};

/// `(point, weight)` on `[-1, 1]`, exact to degree five.
const GAUSS_3: [(f64, f64); 3] = [
    (-0.774_596_669_241_483_4, 5.0 / 9.0),
    (0.0, 8.0 / 9.0),
    (0.774_596_669_241_483_4, 5.0 / 9.0),
];
/// Rule with points at the ends of the interval.
const LOBATTO_4: [(f64, f64); 4] = [
    (-1.0, 1.0 / 6.0),
    (-0.447_213_595_499_957_9, 5.0 / 6.0),
    (0.447_213_595_499_957_9, 5.0 / 6.0),
    (1.0, 1.0 / 6.0),
];

/// Coordinates on the facet and the weight.
type FacetPoint = ([f64; 2], f64);

/// Integrals of pressure over a facet against the plane with the normal `-n`, with derivatives
/// if those of the segment are known.
pub(super) fn pressed_on_plane(
    facet: &Facet,
    n: &Vec3,
    pressing: &Pressing,
    mass: &[[f64; 8]; 8],
    slopes: Option<&Slopes>,
) -> Pressed {
    let shape = facet.shape;
    let count = match shape {
        Shape::Triangle => 3,
        Shape::Quadrilateral => 4,
    };
    let corners = (0..count).map(|at| shares(shape, shape.corner(Some(at))));
    if pressing.is_idle(corners) {
        return pressing.idle(mass, slopes);
    }
    let state = |place: [f64; 2]| pressing.state(&shares(shape, place));
    let points = match shape {
        Shape::Triangle => on_triangle(&state),
        Shape::Quadrilateral => {
            let mut points = Vec::new();
            on_square([-1.0, -1.0], 2.0, &state, DIVISIONS, &mut points);
            points
        }
    };
    let supports = pressing.count();
    let mut pressed = Pressed {
        rows: vec![0.0; supports],
        closed: closed_on_plane(facet, n, pressing, mass),
        touches: vec![false; supports],
        slopes: slopes.map(|_| {
            Box::new(PressedSlopes {
                rows: vec![[0.0; 24]; supports],
                force_by_pressure: vec![[0.0; 8]; supports],
                rows_by_pressure: vec![0.0; supports],
                ..PressedSlopes::default()
            })
        }),
        ..Pressed::default()
    };
    for point in points {
        pressed.add(facet, n, pressing, point);
    }
    pressed
}

/// `int phi_k` over the closed share of the supports.
fn closed_on_plane(facet: &Facet, n: &Vec3, pressing: &Pressing, mass: &[[f64; 8]; 8]) -> Vec<f64> {
    let shape = facet.shape;
    let at = |place: &Vec2| {
        let weights = shape.weights(place.x, place.y);
        let [by_xi, by_eta] =
            [&weights.d_xi, &weights.d_eta].map(|d| combination(d, &facet.corners));
        let functions = shares(shape, [place.x, place.y]);
        (functions, n.dot(&by_xi.cross(&by_eta)))
    };
    let triangles = match shape {
        Shape::Triangle => vec![[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(Vec2::from)],
        Shape::Quadrilateral => {
            let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(Vec2::from);
            let of_edge = |at: usize| [corners[at], corners[(at + 1) % 4], Vec2::zeros()];
            [0, 1, 2, 3].map(of_edge).to_vec()
        }
    };
    let whole = pressing.weights(mass);
    closed_share::closed(pressing, whole, triangles.into_iter(), &rule::DEGREE_6, &at)
}

/// Interpolation functions at a place; a plane has none.
fn shares(shape: Shape, [xi, eta]: [f64; 2]) -> [f64; 8] {
    let value = shape.weights(xi, eta).value;
    std::array::from_fn(|c| if c < 4 { value[c] } else { 0.0 })
}

impl Pressed {
    fn add(&mut self, facet: &Facet, n: &Vec3, pressing: &Pressing, point: FacetPoint) {
        let ([xi, eta], share) = point;
        let weights = facet.shape.weights(xi, eta);
        let functions = shares(facet.shape, [xi, eta]);
        let [by_xi, by_eta] =
            [&weights.d_xi, &weights.d_eta].map(|d| combination(d, &facet.corners));
        let jacobian = n.dot(&by_xi.cross(&by_eta));
        let [turned_xi, turned_eta] = [n.cross(&by_xi), by_eta.cross(n)];
        let by_x = |k: usize| turned_eta * weights.d_xi[k] + turned_xi * weights.d_eta[k];
        let gap = pressing.gap(&functions);
        let at = Point::new(pressing, &functions, gap);
        let area = share * jacobian;
        if at.is_pressed() {
            self.area += area;
        }
        // A value at the point, and its derivative by the gap there.
        let add_slopes = |row: &mut [f64; 24], value: f64, by_gap: f64| {
            for k in 0..4 {
                let slope = by_x(k) * (share * value) - n * (area * by_gap * functions[k]);
                (0..3).for_each(|axis| row[3 * k + axis] += slope[axis]);
            }
        };
        for c in 0..4 {
            let value = functions[c] * at.pressure;
            self.force[c] += area * value;
            if let Some(slopes) = &mut self.slopes {
                add_slopes(&mut slopes.force[c], value, -functions[c] * at.stiffness);
            }
        }
        for (k, (support, limit)) in pressing.supports().enumerate() {
            let of = OfSupport::new((support, limit), &functions, gap);
            let open = area * of.phi * (1.0 - of.closed);
            self.rows[k] += area * of.phi * of.held;
            self.touches[k] |= of.closed > 0.0;
            if let Some(slopes) = &mut self.slopes {
                add_slopes(&mut slopes.rows[k], of.phi * of.held, of.phi * of.closed);
                slopes.rows_by_pressure[k] += over_bedding(open, support);
                for c in 0..4 {
                    slopes.force_by_pressure[k][c] += area * of.phi * of.closed * functions[c];
                }
            }
        }
    }
}

fn on_triangle(state: &impl Fn([f64; 2]) -> usize) -> Vec<FacetPoint> {
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(Vec2::from);
    let at = |place: &Vec2| state([place.x, place.y]);
    let points = divided(&corners, &rule::DEGREE_5, &at);
    let place = |(shares, weight): rule::Point| ([shares[1], shares[2]], 0.5 * weight);
    points.into_iter().map(place).collect()
}

fn on_square(
    low: [f64; 2],
    size: f64,
    state: &impl Fn([f64; 2]) -> usize,
    divisions: usize,
    points: &mut Vec<FacetPoint>,
) {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
        .map(|[xi, eta]| state([low[0] + size * xi, low[1] + size * eta]));
    let pure = corners.iter().all(|corner| *corner == corners[0]);
    if !pure && divisions > 0 {
        let half = 0.5 * size;
        for [xi, eta] in [[0.0, 0.0], [half, 0.0], [0.0, half], [half, half]] {
            on_square(
                [low[0] + xi, low[1] + eta],
                half,
                state,
                divisions - 1,
                points,
            );
        }
        return;
    }
    let rule: &[(f64, f64)] = if pure { &GAUSS_3 } else { &LOBATTO_4 };
    for (xi, first) in rule {
        for (eta, second) in rule {
            let place = [xi, eta].map(|at| 0.5 * size * (at + 1.0));
            let weight = first * second * 0.25 * size * size;
            points.push(([low[0] + place[0], low[1] + place[1]], weight));
        }
    }
}
