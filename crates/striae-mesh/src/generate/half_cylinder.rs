//! A slice of a half cylinder, fine at the end of its middle radius.
//!
//! The section is a half disc of quadrangles (see `half_disc.rs`): a core below the flat
//! side and radial lines from it to the arc. Elements have the wanted size at
//! the contact point and grow away from it, see [`refined_lengths`](super::refined_lengths); nodes of
//! the arc lie on the circle. The section is extruded along `y`.

mod half_disc;

use super::generator::{Generate, Generator, product};
use super::grid::{all_positive, check_element_count, named_mesh};
use crate::{CellBlock, ElementId, Face, Mesh, MeshError, NodeId, Vec3};
use half_disc::HalfDisc;
use striae_declared::{
    Absent, Bound, Declared, LENGTH, NO_UNIT, NOT_NEGATIVE, POSITIVE, Parameter, Values,
};

/// The generator.
pub static HALF_CYLINDER: Declared<Generator> = Declared {
    name: "half-cylinder",
    summary: "A slice of a half cylinder along the second axis, finer around the contact point. Sets of nodes and facets: `flat`, `arc`, `ymin`, `ymax`.",
    parameters: &[
        Parameter::position(
            "apex",
            "Contact point in the side `ymin`: lowest of the lower half, highest of the upper half.",
        ),
        Parameter::word(
            "half",
            &[
                ("lower", "Arc below, flat side on top."),
                ("upper", "Arc on top, flat side below."),
            ],
            "Half of the cylinder.",
        ),
        Parameter::number("radius", POSITIVE, LENGTH, "Radius.")
            .or_in_programs(&Absent::Number(8.0)),
        Parameter::number("thickness", POSITIVE, LENGTH, "Thickness of the slice.")
            .or_in_programs(&Absent::Number(1.0)),
        Parameter::whole("layers", 1, "Elements over the thickness.").or(Absent::Whole(1)),
        Parameter::number(
            "element_size",
            POSITIVE,
            LENGTH,
            "Element size at the contact point.",
        )
        .or_in_programs(&Absent::Number(0.2)),
        Parameter::number(
            "fine_half_width",
            NOT_NEGATIVE,
            LENGTH,
            "Half the width of the zone with elements of this size.",
        )
        .or(Absent::Computed("5 element_size", |values| {
            5.0 * values.number("element_size")
        })),
        Parameter::number(
            "fine_depth",
            NOT_NEGATIVE,
            LENGTH,
            "Depth of the zone with elements of this size.",
        )
        .or(Absent::Number(0.0)),
        Parameter::number(
            "growth",
            &[Bound::AtLeast(1.0)],
            NO_UNIT,
            "Largest ratio of neighbouring sizes outside that zone.",
        )
        .or(Absent::Number(1.2)),
    ],
    build: |values| Ok(Generator::of(HalfCylinder::stated(values))),
    fit: None,
};

/// A slice of a half cylinder along `y`, with sides `flat`, `arc`, `ymin`, `ymax`. Defaults are
/// those of [`HALF_CYLINDER`].
#[derive(Clone, Debug, PartialEq)]
pub struct HalfCylinder {
    /// Contact point: the lowest point of the lower half, the highest of the
    /// upper half, in the side `ymin`.
    pub apex: Vec3,
    /// Half of the cylinder.
    pub half: Half,
    /// Radius.
    pub radius: f64,
    /// Extent of the slice along `y`.
    pub thickness: f64,
    /// Number of elements along `y`.
    pub layers: usize,
    /// Element size at the contact point.
    pub element_size: f64,
    /// Arc length to either side of the contact point with elements of this
    /// size.
    pub fine_half_width: f64,
    /// Depth to which elements have this height below the contact point.
    pub fine_depth: f64,
    /// Largest ratio of neighbouring sizes outside.
    pub growth: f64,
}

/// Half of a cylinder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Half {
    /// Arc downwards, flat side on top.
    Lower,
    /// Arc upwards, flat side below.
    Upper,
}

impl Default for HalfCylinder {
    fn default() -> Self {
        Self::stated(&HALF_CYLINDER.completed(&Values::default()))
    }
}

impl Generate for HalfCylinder {
    fn mesh(&self) -> Result<Mesh, MeshError> {
        self.mesh()
    }

    fn elements(&self) -> Option<u128> {
        let disc = HalfDisc::new(self).ok()?;
        Some(product(&[disc.cell_count(), self.layers]))
    }

    fn nodes(&self) -> Option<u128> {
        let disc = HalfDisc::new(self).ok()?;
        Some(product(&[disc.node_count(), self.layers.saturating_add(1)]))
    }
}

impl HalfCylinder {
    fn stated(values: &Values) -> Self {
        Self {
            apex: values.array("apex").into(),
            half: match values.word("half") {
                "upper" => Half::Upper,
                _ => Half::Lower,
            },
            radius: values.number("radius"),
            thickness: values.number("thickness"),
            layers: values.whole("layers"),
            element_size: values.number("element_size"),
            fine_half_width: values.number("fine_half_width"),
            fine_depth: values.number("fine_depth"),
            growth: values.number("growth"),
        }
    }

    /// The mesh.
    ///
    /// # Errors
    /// [`MeshError::Parameter`] for parameters out of range.
    pub fn mesh(&self) -> Result<Mesh, MeshError> {
        all_positive(&[("radius", self.radius), ("thickness", self.thickness)])?;
        MeshError::require(self.layers > 0, "layers", 0.0, "at least 1 is needed")?;
        let disc = HalfDisc::new(self)?;
        check_element_count([disc.cell_count(), self.layers])?;
        let positions = (0..=self.layers)
            .flat_map(|layer| {
                let y = self.thickness * layer as f64 / self.layers as f64;
                disc.positions().map(move |[x, z]| self.place(x, y, z))
            })
            .collect();
        let sheet = disc.node_count();
        let quadrangles = disc.quadrangles();
        let elements = (0..self.layers)
            .flat_map(|layer| quadrangles.iter().map(move |q| (layer, q)))
            .map(|(layer, &[a, b, c, d])| {
                let (near, far) = (layer * sheet, (layer + 1) * sheet);
                [
                    near + a,
                    near + d,
                    near + c,
                    near + b,
                    far + a,
                    far + d,
                    far + c,
                    far + b,
                ]
                .map(NodeId::new)
            });
        let elements = CellBlock::hexahedra(elements);
        named_mesh(positions, elements, self.sides(&disc))
    }

    /// A point of the lower half with its centre at the origin, put in place.
    fn place(&self, x: f64, y: f64, z: f64) -> Vec3 {
        let lower = Vec3::new(x, y, z + self.radius);
        self.apex
            + match self.half {
                Half::Lower => lower,
                Half::Upper => Vec3::new(-lower.x, lower.y, -lower.z),
            }
    }

    /// Faces of the four sides; local sides are those of the element corners in
    /// [`HalfCylinder::mesh`].
    fn sides(&self, disc: &HalfDisc) -> [(&'static str, Vec<Face>); 4] {
        let [flat, arc] = disc.outline();
        let sheet = disc.cell_count();
        let faces = |cells: &[(usize, u8)], layers: std::ops::Range<usize>| -> Vec<Face> {
            layers
                .flat_map(|layer| cells.iter().map(move |&(cell, side)| (layer, cell, side)))
                .map(|(layer, cell, side)| Face {
                    element: ElementId::new(layer * sheet + cell),
                    side,
                })
                .collect()
        };
        let whole: Vec<(usize, u8)> = (0..sheet).map(|cell| (cell, 0)).collect();
        let behind: Vec<(usize, u8)> = (0..sheet).map(|cell| (cell, 1)).collect();
        [
            ("flat", faces(&flat, 0..self.layers)),
            ("arc", faces(&arc, 0..self.layers)),
            ("ymin", faces(&whole, 0..1)),
            ("ymax", faces(&behind, self.layers - 1..self.layers)),
        ]
    }
}
