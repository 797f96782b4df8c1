//! Textures by their declarations, and lines by formulas of one's own.

use nalgebra::Vector3;
use num_dual::DualSVec64;
use striae_declared::{Declared, Kind, Value, Values, named};
use striae_mesh::Vec3;

use super::super::{
    Axis, DirectionField, Field, InadmissibleTexture, Lines, Paint, PointLane, TEXTURES, TURN,
};
use crate::scalar::scaled;

/// Circles about an axis, as the variant of the library draws them.
#[derive(Debug)]
struct Circles(Axis);

impl DirectionField for Circles {
    fn direction(&self, point: Vector3<PointLane>) -> Vector3<PointLane> {
        self.0.around(point)
    }

    fn axis(&self) -> Option<Axis> {
        Some(self.0)
    }
}

static CIRCLES: Declared<Paint> = Declared {
    name: "circles",
    summary: "Circles.",
    parameters: &[
        striae_declared::Parameter::axis("circles", "The axis."),
        TURN,
    ],
    build: |values| {
        let axis = Axis::stated(values, "circles");
        if axis.point.x > 9.0 {
            return Err(InadmissibleTexture {
                parameter: Some("circles"),
                reason: "the point of the axis is too far".to_owned(),
            });
        }
        Ok(Paint::lines(Lines::own(Circles(axis)), values))
    },
    fit: None,
};

fn axis() -> Axis {
    Axis {
        point: Vec3::new(0.3, -0.2, 0.5),
        direction: Vec3::new(0.4, 2.0, -1.0),
    }
}

fn about(name: &'static str) -> Values {
    let axis = Values::default().with("point", [0.3, -0.2, 0.5]);
    Values::default().with(name, axis.with("direction", [0.4, 2.0, -1.0]))
}

/// Values of each declared texture, but for those that have a default.
fn values(name: &str) -> Values {
    let none = Values::default();
    match name {
        "uniform" => none.with("uniform", [0.0, 3.0, 1.0]),
        "painted" => {
            let point = none.clone().with("at", [1.0, 2.0, 3.0]);
            none.with("points", vec![point.with("direction", [1.0, 0.0, 0.0])])
        }
        "nodal" => none.with("directions", vec![[1.0, 0.0, 0.0], [0.0, 2.0, 0.0]]),
        name => {
            let mut known = ["circumferential", "axial", "radial"].into_iter();
            about(known.find(|known| *known == name).expect("known"))
        }
    }
}

#[test]
fn a_texture_states_what_it_was_made_of() {
    for texture in TEXTURES {
        let given = values(texture.name);
        let paint = texture.made(&given).expect("the values are admissible");
        let statement = paint.stated().expect("it is declared");
        assert_eq!(statement.law, texture.name);
        assert_eq!(statement.values, texture.completed(&given));
        let again = named(TEXTURES, statement.law).map(|known| known.made(&statement.values));
        assert_eq!(again, Some(Ok(paint)));
    }
}

#[test]
fn lines_of_ones_own_are_those_of_the_library_with_their_derivatives() {
    type D = DualSVec64<2>;
    let known = Field {
        lines: Lines::Circumferential(axis()),
        turn: 0.4,
    };
    let own = Field {
        lines: Lines::own(Circles(axis())),
        turn: 0.4,
    };
    let along: Vector3<D> = Vector3::new(0.3, 1.0, -0.5).map(D::from);
    let across: Vector3<D> = Vector3::new(1.0, 0.2, 0.7).map(D::from);
    let [u, v] = [0, 1].map(|i| D::from_re(0.1 + 0.4 * i as f64).derivative(i));
    let point = scaled(&along, u) + scaled(&across, v * v);
    let normal = Vector3::new(0.6, 0.0, 0.8).map(D::from);
    let [known, own] = [known, own].map(|field| field.axes(point, normal).expect("off the axis"));
    for i in 0..3 {
        assert!((known.s[i].re - own.s[i].re).abs() < 1e-14);
        let slopes = |d: D| d.eps.unwrap_generic(nalgebra::Const::<2>, nalgebra::U1);
        assert!((slopes(known.s[i]) - slopes(own.s[i])).norm() < 1e-13);
    }
}

#[test]
fn lines_of_ones_own_keep_their_statement_but_for_the_turn() {
    let given = about("circles").with("turn", 20.0);
    let paint = CIRCLES.made(&given).expect("the axis is near");
    assert_eq!(paint.stated(), Some(CIRCLES.stated(given.clone())));
    assert_eq!(CIRCLES.made(&given), Ok(paint.clone()));
    let Paint::Field(field) = paint else {
        panic!("it is a field");
    };
    let turned = Paint::Field(Field { turn: 0.0, ..field });
    let stated = turned.stated().expect("it was declared");
    assert_eq!(stated.values.get("turn"), Some(&Value::Number(0.0)));
    let undeclared = Lines::own(Circles(axis()));
    assert_eq!(Paint::lines(undeclared, &Values::default()).stated(), None);
}

#[test]
fn a_refusal_names_its_parameter() {
    let far = Values::default().with("point", [10.0, 0.0, 0.0]);
    let far = far.with("direction", [0.0, 0.0, 1.0]);
    let refused = CIRCLES.made(&Values::default().with("circles", far));
    let refused = refused.expect_err("the axis is far");
    assert_eq!(Paint::refused(&refused), Some("circles"));
    assert_eq!(refused.to_string(), "the point of the axis is too far");
}
