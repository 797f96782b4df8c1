//! Places in a model, such as `steps[1].displacements[0]`.

use std::fmt;

/// One step of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Segment {
    /// A field.
    Field(&'static str),
    /// A position in a list, from 0.
    Index(usize),
}

/// A place in a model.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Path(Vec<Segment>);

impl Path {
    /// A part of the model by the name of its list and its position.
    pub fn part(list: &'static str, index: usize) -> Self {
        Self(vec![Segment::Field(list), Segment::Index(index)])
    }

    /// A field of the model itself.
    pub fn of(field: &'static str) -> Self {
        Self(vec![Segment::Field(field)])
    }

    /// A field of what is here.
    pub fn field(mut self, name: &'static str) -> Self {
        self.0.push(Segment::Field(name));
        self
    }

    /// An element of the list that is here.
    pub fn index(mut self, index: usize) -> Self {
        self.0.push(Segment::Index(index));
        self
    }

    /// The segments from the outside in.
    pub fn segments(&self) -> &[Segment] {
        &self.0
    }
}

impl fmt::Display for Path {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (position, segment) in self.0.iter().enumerate() {
            match segment {
                Segment::Field(name) if position == 0 => write!(f, "{name}")?,
                Segment::Field(name) => write!(f, ".{name}")?,
                Segment::Index(index) => write!(f, "[{index}]")?,
            }
        }
        Ok(())
    }
}
