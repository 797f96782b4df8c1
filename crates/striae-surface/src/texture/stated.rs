//! Textures as they are stated by name and values.

use std::convert::Infallible;

use striae_declared::{Kind, Statement, Value, Values, degrees};
use striae_mesh::Vec3;

use super::error::InadmissibleTexture;
use super::paint::{
    AXIAL, CIRCUMFERENTIAL, Field, Lines, NODAL, PAINTED, Paint, RADIAL, TURN, UNIFORM,
};

impl Kind for Paint {
    type Refusal = InadmissibleTexture;
    type Fit = Infallible;

    fn with_statement(self, statement: Statement) -> Self {
        match self {
            Self::Field(Field {
                lines: Lines::Own(own),
                turn,
            }) => Self::Field(Field {
                lines: Lines::Own(own.with_statement(statement)),
                turn,
            }),
            other => other,
        }
    }

    fn refused(refusal: &InadmissibleTexture) -> Option<&'static str> {
        refusal.parameter
    }
}

impl Paint {
    /// Returns the declared texture that this one is, with its values.
    ///
    /// `None` where no declared texture is like it: directions at nodes by their numbers, and lines
    /// of a formula that is not declared.
    pub fn stated(&self) -> Option<Statement> {
        let vector = |of: &Vec3| -> [f64; 3] { (*of).into() };
        let statement = |law, values| Some(Statement { law, values });
        match self {
            Self::Field(field) => field.stated(),
            Self::Points { directions, width } => {
                let point = |(at, direction): &(Vec3, Vec3)| {
                    let values = Values::default().with("at", vector(at));
                    values.with("direction", vector(direction))
                };
                let points: Vec<Values> = directions.iter().map(point).collect();
                let values = Values::default().with("points", points);
                statement(PAINTED.name, values.with_any("width", *width))
            }
            Self::Nodal(directions) => {
                let directions = Value::Vectors(directions.iter().map(vector).collect());
                let values = Values::default().with("directions", directions);
                statement(NODAL.name, values)
            }
            Self::Nodes { .. } => None,
        }
    }
}

impl Field {
    fn stated(&self) -> Option<Statement> {
        let turn = degrees(self.turn);
        let (law, lines): (_, Value) = match &self.lines {
            Lines::Uniform(direction) => {
                let direction: [f64; 3] = (*direction).into();
                (UNIFORM.name, direction.into())
            }
            Lines::Circumferential(axis) => (CIRCUMFERENTIAL.name, axis.values().into()),
            Lines::Axial(axis) => (AXIAL.name, axis.values().into()),
            Lines::Radial(axis) => (RADIAL.name, axis.values().into()),
            Lines::Own(own) => {
                let Statement { law, values } = own.statement()?;
                // The turn may have changed since the texture was made.
                let given = |(name, value): (&'static str, &Value)| match name == TURN.name {
                    true => (name, turn.into()),
                    false => (name, value.clone()),
                };
                let is_told = turn == 0.0 || values.get(TURN.name).is_some();
                let values = values.iter().map(given).collect();
                return is_told.then_some(Statement { law, values });
            }
        };
        let values = Values::default().with(law, lines).with(TURN.name, turn);
        Some(Statement { law, values })
    }
}
