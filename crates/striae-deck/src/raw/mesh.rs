//! `mesh = { ... }` of a body.

use crate::{
    declare::{choice, either, table, words},
    read::At,
    value::{All, BelowHalf, Count, Growth, NonNegative, Number, Positive, Text, Truth, Whole},
};

either! {
    /// A mesh of a body.
    Mesh {
        File(BodyFile),
        Inline(InlineMesh),
        Generated(Generator),
    }
}

table! {
    /// A mesh of a body read from a file.
    BodyFile {
        /// Path relative to the deck.
        required file: Text,
        /// The part of the file that makes up the body: an element set, a physical volume of Gmsh,
        /// or an instance of Abaqus. Sets are restricted to it. Default: the whole file.
        optional elements: Text,
        /// `true`: elements have the materials that the file assigns to them, by `*SOLID SECTION`
        /// of Abaqus. Default: `false`.
        optional materials: Truth,
    }
}

table! {
    /// A mesh read from a file.
    MeshFile {
        /// Path relative to the deck.
        required file: Text,
        /// The part of an Abaqus file that makes up the surface: an element set or an instance.
        /// Default: all facets.
        optional elements: Text,
    }
}

table! {
    /// A mesh of a body written in the deck, without sets.
    InlineMesh {
        /// Positions of the nodes.
        required positions: Vec<At<[Number; 3]>>,
        /// Corners of the elements, with nodes counted from 0 and ordered as in Abaqus and Gmsh:
        /// eight of a hexahedron, six of a wedge, five of a pyramid, four of a tetrahedron, ten of
        /// one with midside nodes.
        required cells: Vec<At<All<Whole<0>>>>,
    }
}

choice! {
    /// Generator of the mesh.
    Generator by generator {
        "block" => Block(Block),
        "capped-block" => CappedBlock(CappedBlock),
        "half-cylinder" => HalfCylinder(HalfCylinder),
        "annulus" => Annulus(Annulus),
        "cylinder" => Cylinder(SolidCylinder),
        "torus" => Torus(Torus),
    }
}

table! {
    /// A block. Sets of nodes and facets: `xmin`, `xmax`, `ymin`, `ymax`, `zmin`, `zmax`, named before rotation.
    Block {
        /// Its corner of smallest coordinates, before rotation. Default: `[0, 0, 0]`.
        optional origin: [Number; 3],
        /// Edge lengths.
        required size: [Positive; 3],
        /// Hexahedra along the edges.
        required divisions: [Count; 3],
        /// Kind of cells that the hexahedra are divided into. Default: `hexahedra`, which are not
        /// divided.
        optional cells: Cells,
        /// Interval lengths along the edges. Default: equal.
        optional grading: Gradings,
        /// Rotation of the whole block. Default: none.
        optional rotation: Rotation,
        /// Angle in degrees by which the mesh is rotated about the third axis inside the unchanged
        /// outline. Default: 0.
        optional mesh_rotation: Number,
        /// Slopes of the lower side along the first two axes. Default: `[0, 0]`.
        optional bottom_slopes: [Number; 2],
        /// Slopes of the upper side along the first two axes. Default: `[0, 0]`.
        optional top_slopes: [Number; 2],
        /// Random displacement of inner nodes as a fraction of the local interval. Default: 0.
        optional irregularity: BelowHalf,
        /// Seed of the random displacement. Default: 0.
        optional seed: Whole<0>,
    }
}

words! {
    /// Kinds of elements.
    Cells {
        /// Hexahedra with eight nodes.
        Hexahedra = "hexahedra",
        /// Wedges with six nodes, two in each hexahedron, along the third axis.
        Wedges = "wedges",
        /// Pyramids with five nodes, six in each hexahedron.
        Pyramids = "pyramids",
        /// Tetrahedra with four nodes, six in each hexahedron.
        Tetrahedra = "tetrahedra",
        /// Tetrahedra with ten nodes, six in each hexahedron, each linear in twelve parts.
        CompositeTetrahedra = "composite-tetrahedra",
    }
}

table! {
    /// Interval lengths along the three axes.
    Gradings {
        /// Along the first axis. Default: equal.
        optional x: Grading,
        /// Along the second axis. Default: equal.
        optional y: Grading,
        /// Along the third axis. Default: equal.
        optional z: Grading,
    }
}

either! {
    /// Interval lengths along an edge.
    Grading {
        OneSided(OneSidedGrading),
        Symmetric(SymmetricGrading),
        Lengths(LengthGrading),
    }
}

table! {
    /// A geometric sequence from one end to the other.
    OneSidedGrading {
        /// Last length over the first.
        required one_sided: Positive,
    }
}

table! {
    /// A geometric sequence from both ends to the middle.
    SymmetricGrading {
        /// Length in the middle over the length at the ends.
        required symmetric: Positive,
    }
}

table! {
    /// Chosen lengths.
    LengthGrading {
        /// One length a division, up to a common factor.
        required lengths: Vec<At<Positive>>,
    }
}

table! {
    /// Rotation of a body.
    Rotation {
        /// Axis of any length.
        required axis: [Number; 3],
        /// Angle in degrees by the right-hand rule.
        required degrees: Number,
        /// Fixed point of the rotation. Default: the centre of the body.
        optional about: [Number; 3],
    }
}

table! {
    /// A block whose lower side is a spherical cap, finer around its lowest point. Sets of nodes and facets: `xmin`, `xmax`, `ymin`, `ymax`, `cap`, `zmax`.
    CappedBlock {
        /// Lowest point. Default: `[0, 0, 0]`.
        optional apex: [Number; 3],
        /// Edge lengths along the first two axes.
        required size: [Positive; 2],
        /// Height from the lowest point to the upper side.
        required height: Positive,
        /// Radius of the sphere.
        required radius: Positive,
        /// Element size at the lowest point.
        required element_size: Positive,
        /// Half the width of the zone with elements of this size. Default: twice the element size.
        optional fine_half_width: NonNegative,
        /// Depth of the zone with elements of this size. Default: 0.
        optional fine_depth: NonNegative,
        /// Largest ratio of neighbouring sizes outside that zone. Default: 1.3.
        optional growth: Growth,
        /// Part of it that is meshed. Default: `whole`.
        optional part: Part,
        /// Kind of cells that its hexahedra are divided into. Default: `hexahedra`, which are not
        /// divided.
        optional cells: Cells,
    }
}

words! {
    /// Part of a block that is meshed.
    Part {
        /// The whole block.
        Whole = "whole",
        /// The half on the positive side of the second axis; `ymin` is then the plane of symmetry.
        Half = "half",
    }
}

table! {
    /// A slice of a half cylinder along the second axis, finer around the contact point. Sets of nodes and facets: `flat`, `arc`, `ymin`, `ymax`.
    HalfCylinder {
        /// Contact point in the side `ymin`: lowest of the lower half, highest of the upper half. Default: `[0, 0, 0]`.
        optional apex: [Number; 3],
        /// Half of the cylinder. Default: `lower`.
        optional half: Half,
        /// Radius.
        required radius: Positive,
        /// Thickness of the slice.
        required thickness: Positive,
        /// Elements over the thickness. Default: 1.
        optional layers: Count,
        /// Element size at the contact point.
        required element_size: Positive,
        /// Half the width of the zone with elements of this size. Default: five times the element size.
        optional fine_half_width: NonNegative,
        /// Depth of the zone with elements of this size. Default: 0.
        optional fine_depth: NonNegative,
        /// Largest ratio of neighbouring sizes outside that zone. Default: 1.2.
        optional growth: Growth,
    }
}

words! {
    /// Half of a cylinder.
    Half {
        /// Arc below, flat side on top.
        Lower = "lower",
        /// Arc on top, flat side below.
        Upper = "upper",
    }
}

table! {
    /// A ring about an axis. Sets of nodes and facets: `rim` inside, `tread` outside, the plane sides `ymin`, `ymax` and both of them, `sides`.
    Annulus {
        /// Centre of the ring. Default: `[0, 0, 0]`.
        optional centre: [Number; 3],
        /// Axis of any length. Default: `[0, 1, 0]`.
        optional axis: [Number; 3],
        /// Inner radius.
        required inner_radius: Positive,
        /// Outer radius.
        required outer_radius: Positive,
        /// Width along the axis.
        required width: Positive,
        /// Elements along the radius, the circumference and the axis.
        required divisions: [Count; 3],
        /// Interval lengths from the inner to the outer radius. Default: equal.
        optional radial_grading: Grading,
        /// Interval lengths along the axis. Default: equal.
        optional axial_grading: Grading,
        /// Smaller elements around the lowest point. Default: none.
        optional refinement: Refinement,
    }
}

table! {
    /// Smaller elements around the lowest point of a ring.
    Refinement {
        /// Angle in degrees to either side of the lowest point within which the size is smallest.
        required half_angle: NonNegative,
        /// Size at the highest point over the size at the lowest.
        required ratio: Growth,
    }
}

table! {
    /// A solid cylinder. Sets of nodes and facets: the round `side`, `zmin`, `zmax`, for a quarter also its planes of symmetry `xmin` and `ymin`; named before rotation.
    SolidCylinder {
        /// Centre of the side `zmin`. Default: `[0, 0, 0]`.
        optional base: [Number; 3],
        /// Axis from there, of any length. Default: `[0, 0, 1]`.
        optional axis: [Number; 3],
        /// Radius.
        required radius: Positive,
        /// Extent along the axis.
        required height: Positive,
        /// Elements along half an edge of the square core, from the core to the side, and along the axis. A quarter turn has twice the first number.
        required divisions: [Count; 3],
        /// Interval lengths along the axis. Default: equal.
        optional axial_grading: Grading,
        /// Part of it that is meshed. Default: `whole`.
        optional part: Sector,
    }
}

words! {
    /// Part of a cylinder that is meshed.
    Sector {
        /// The whole cylinder.
        Whole = "whole",
        /// The quarter on the positive sides of the first two axes.
        Quarter = "quarter",
    }
}

table! {
    /// A ring of round section. Set of nodes and facets: `surface`.
    Torus {
        /// Centre of the ring. Default: `[0, 0, 0]`.
        optional centre: [Number; 3],
        /// Axis of any length. Default: `[0, 0, 1]`.
        optional axis: [Number; 3],
        /// Radius of the circle on which the centres of the sections lie.
        required ring_radius: Positive,
        /// Radius of the section.
        required section_radius: Positive,
        /// Elements along half an edge of the square core of the section, from the core to the surface, and around the axis. The section has eight times the first number around.
        required divisions: [Count; 3],
    }
}
