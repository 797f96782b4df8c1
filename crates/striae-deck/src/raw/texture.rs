//! `texture = { ... }` of a side of a pair.

use crate::{
    declare::{either, table},
    read::At,
    value::{Number, Positive, Text},
};

either! {
    /// A texture: directions along the grooves or the row of scales.
    Texture {
        Uniform(UniformTexture),
        Circumferential(CircumferentialTexture),
        Axial(AxialTexture),
        Radial(RadialTexture),
        Points(PointTexture),
        Nodal(NodalTexture),
        Listed(ListedTexture),
    }
}

table! {
    /// The tangential part of one direction.
    UniformTexture {
        /// The direction.
        required uniform: [Number; 3],
        /// Angle in degrees by which it is rotated about the outward normal. Default: 0.
        optional turn: Number,
    }
}

table! {
    /// Circles about an axis by the right-hand rule.
    CircumferentialTexture {
        /// The axis.
        required circumferential: Axis,
        /// Angle in degrees by which they are rotated about the outward normal. Default: 0.
        optional turn: Number,
    }
}

table! {
    /// Parallels of an axis.
    AxialTexture {
        /// The axis.
        required axial: Axis,
        /// Angle in degrees by which they are rotated about the outward normal. Default: 0.
        optional turn: Number,
    }
}

table! {
    /// Rays from an axis outwards.
    RadialTexture {
        /// The axis.
        required radial: Axis,
        /// Angle in degrees by which they are rotated about the outward normal. Default: 0.
        optional turn: Number,
    }
}

table! {
    /// Directions at chosen places, interpolated between them.
    PointTexture {
        /// The places and their directions.
        required points: Vec<At<PaintedPoint>>,
        /// Width of the interpolation. Default: a quarter of the largest distance over the surface.
        optional width: Positive,
    }
}

table! {
    /// A direction at every node of the surface, from a file.
    NodalTexture {
        /// Path relative to the deck of a Gmsh file (`.msh`) with `$NodeData` of three components,
        /// or of a list (`.csv`) with lines `node,x,y,z`. Nodes have the numbers of the mesh file;
        /// nodes of other meshes are counted from 0.
        required nodal: Text,
        /// Name of the node data of a Gmsh file. Default: the only data there.
        optional name: Text,
    }
}

table! {
    /// A direction at every node of the surface, written in the deck.
    ListedTexture {
        /// Directions in ascending order of the nodes; their tangential part is used.
        required directions: Vec<At<[Number; 3]>>,
    }
}

table! {
    /// An axis in space.
    Axis {
        /// A point of it. Default: `[0, 0, 0]`.
        optional point: [Number; 3],
        /// Its direction, of any length.
        required direction: [Number; 3],
    }
}

table! {
    /// A direction at a place.
    PaintedPoint {
        /// The place; the nearest node of the surface is painted.
        required at: [Number; 3],
        /// The direction; its tangential part is used.
        required direction: [Number; 3],
    }
}
