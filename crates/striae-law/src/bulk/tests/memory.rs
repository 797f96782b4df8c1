//! A point that goes through increments, and what laws with a memory do then.

mod plastic;
mod viscoelastic;

use super::*;

/// A point of a material and what it has been through.
struct Point {
    material: Material,
    variables: Vec<f64>,
    dissipated: f64,
}

impl Point {
    fn at_rest(material: Material) -> Self {
        Self {
            variables: vec![0.0; material.variables()],
            material,
            dissipated: 0.0,
        }
    }

    /// Goes to `F` in the time `elapsed`.
    fn to(&mut self, f: &Matrix3<f64>, elapsed: f64) -> Response {
        let old = self.variables.clone();
        let past = Past {
            variables: &old,
            elapsed,
        };
        let mut present = Present {
            variables: &mut self.variables,
            dissipated: 0.0,
        };
        let response = self.material.respond(f, past, &mut present).unwrap();
        self.dissipated += present.dissipated;
        response
    }
}

fn shear(k: f64) -> Matrix3<f64> {
    let mut f = Matrix3::identity();
    f[(0, 1)] = k;
    f
}

fn diagonal(logarithms: [f64; 3]) -> Matrix3<f64> {
    Matrix3::from_diagonal(&logarithms.map(f64::exp).into())
}

/// Rubber that says it gains energy by flowing.
#[derive(Debug)]
struct Gaining;

impl BulkLaw for Gaining {
    fn name(&self) -> &str {
        "gaining"
    }

    fn response(&self, f: &Matrix3<f64>) -> Result<Response, ResponseError> {
        laws()[0].response(f)
    }

    fn variables(&self) -> usize {
        1
    }

    fn respond(
        &self,
        f: &Matrix3<f64>,
        past: Past,
        present: &mut Present,
    ) -> Result<Response, ResponseError> {
        present.variables[0] = past.variables[0] + past.elapsed;
        present.dissipated = -past.elapsed;
        self.response(f)
    }

    fn lame_constants(&self) -> LameConstants {
        laws()[0].lame_constants()
    }
}

#[test]
fn the_battery_finds_flow_that_gains_energy() {
    let found = battery(&Material::own(Gaining));
    assert!(
        matches!(found[..], [Violation::Dissipation(gain)] if gain < 0.0),
        "{found:?}"
    );
}
