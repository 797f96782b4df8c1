//! A user-defined friction law and bulk law: a herringbone sole of foam on a floor.
//!
//! Herringbone grooves turn friction aside: sliding forth is pushed to one side, sliding
//! back to the other. The foam is the law of Blatz and Ko (1962, doi:10.1122/1.548937) for
//! polyurethane with half its volume of air, which neither shares nor needs a bulk modulus.

mod plot;

use striae::law::bulk::{self, BulkLaw, Response, ResponseError, Tangent};
use striae::law::friction::{self, FrictionLaw, Kernel, Lane, RequiredTextures, Textures};
use striae::nalgebra::{Matrix3, SVector, Vector3};
use striae::num_dual::{Dual2SVec64, hessian};
use striae::prelude::*;
use striae_figure::{Axis, Content, Panel, Series};

/// `-tau = (I + s a t^T) z`: friction along `t` drags a share `s` of itself across.
#[derive(Debug)]
struct Herringbone {
    share: f64,
}

impl FrictionLaw for Herringbone {
    fn name(&self) -> &str {
        "herringbone"
    }

    fn required_textures(&self) -> RequiredTextures {
        RequiredTextures::One
    }

    fn kernel(&self, n: &Vector3<Lane>, textures: &Textures<Lane>) -> Kernel<'static, Lane> {
        let [a, t] = textures.only_axes(n).expect("one surface has a texture");
        let shear = a * t.transpose() * Lane::from(self.share);
        Kernel::affine(Matrix3::identity() + shear, Vector3::zeros())
    }
}

/// `W = G/2 (I2/I3 + 2 sqrt(I3) - 5)` with the invariants of `C`; Poisson's ratio is 1/4.
#[derive(Debug)]
struct BlatzKo {
    shear: f64,
}

impl BulkLaw for BlatzKo {
    fn name(&self) -> &str {
        "Blatz-Ko"
    }

    fn response(&self, f: &Matrix3<f64>) -> Result<Response, ResponseError> {
        let determinant = f.determinant();
        if determinant.is_nan() || determinant <= 0.0 {
            return Err(ResponseError::Inverted { determinant });
        }
        let components = SVector::<f64, 9>::from_fn(|row, _| f[(row / 3, row % 3)]);
        let energy = |x: SVector<Dual2SVec64<9>, 9>| {
            let f = Matrix3::from_fn(|i, j| x[3 * i + j]);
            let j = f.column(0).cross(&f.column(1)).dot(&f.column(2));
            let c = f.transpose() * f;
            let square = c
                .iter()
                .fold(Dual2SVec64::from(0.0), |sum, c| sum + *c * *c);
            let i1 = c[(0, 0)] + c[(1, 1)] + c[(2, 2)];
            let i2 = (i1 * i1 - square) * 0.5;
            (i2 / (j * j) + j * 2.0 - 5.0) * (0.5 * self.shear)
        };
        let (energy, slope, curvature): (f64, _, Tangent) = hessian(energy, &components);
        Ok(Response {
            energy,
            first_piola: Matrix3::from_fn(|i, j| slope[3 * i + j]),
            tangent: curvature,
        })
    }

    fn lame_constants(&self) -> LameConstants {
        LameConstants {
            lambda: self.shear,
            shear: self.shear,
        }
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let friction = Friction::own(Herringbone { share: 0.5 }, 0.4)?;
    assert_eq!(
        friction::battery(&friction),
        [],
        "mechanics of the friction law"
    );
    let foam = Material::own(BlatzKo { shear: 1e5 });
    assert_eq!(bulk::battery(&foam), [], "mechanics of the foam");

    let block = Block {
        size: Vec3::new(0.1, 0.1, 0.05),
        divisions: [4, 4, 2],
        ..Block::default()
    };
    let sole = surface("sole", "zmin").textured(uniform([1.0, 0.0, 0.0]));
    let model = model("A herringbone sole on a floor")
        .body(body("sole", block.mesh()?, foam))
        .rigid(plane("floor", [0.0; 3], [0.0, 0.0, 1.0]))
        .pair(pair("contact", sole, rigid("floor")).friction(friction))
        .step(
            step("press")
                .increments(2)
                .displace("sole", "zmax", [0.0, 0.0, -0.005]),
        )
        .step(step("forth").displace("sole", "zmax", [Some(0.06), Some(0.0), None]))
        .step(step("back").displace("sole", "zmax", [Some(-0.06), Some(0.0), None]))
        .build()?;
    let run = Simulation::new(model)?.run()?;
    println!("{}", run.ending);
    let force = |axis: &str| {
        run.history
            .column(&format!("pair.contact.resultant_a.{axis}"))
    };
    let [x, y, z] = ["x", "y", "z"].map(|axis| force(axis).expect("there is such a column"));
    let step = run.history.column("step").expect("there is such a column");
    for (name, number) in [("forth", 2.0), ("back", 3.0)] {
        let last = step
            .iter()
            .rposition(|step| *step == number)
            .expect("the step was run");
        println!(
            "sliding {name}: friction {:.3} against, {:.3} aside of the normal force",
            x[last] / z[last],
            y[last] / z[last],
        );
    }
    let points = run
        .history
        .column("time")
        .expect("there is such a column")
        .into_iter()
        .zip(x.iter().zip(&y).zip(&z));
    let points: Vec<[[f64; 2]; 2]> = points
        .map(|(time, ((x, y), z))| [[time, x / z], [time, y / z]])
        .collect();
    let friction = |at: usize| Content::line(points.iter().map(|point| point[at]).collect());
    let panel = Panel::new(
        Axis::linear("time", ""),
        Axis::linear("friction / pressure", ""),
    )
    .with(Series::new("along", friction(0)))
    .with(Series::new("aside", friction(1)));
    plot::plot("own-laws", panel)
}
