//! `[contact]`: contact of every surface with every surface.

use super::{Friction, Initial, Texture};
use crate::{
    declare::table,
    read::At,
    value::{Angle, Positive, Text, Truth},
};

table! {
    /// Contact of every surface with every surface: all skins of bodies with each other, with themselves and with all rigid surfaces. Rigid surfaces do not touch each other. A surface has a label: the name of a body, that of a rigid surface, or that of a body and of one of its facet sets, such as `tread.zmin`.
    Contact {
        /// `true`: everything may touch everything. Surfaces joined by a `pair` keep the settings
        /// of that pair, and tied facets are left out. `false`: only surfaces named by a `pair` may
        /// touch.
        required all: Truth,
        /// Friction of surfaces not named in `between`; steps may change it, by names of pairs that
        /// are made of labels, such as `tread-road` and `tread-tread`. Default: frictionless.
        optional friction: Friction,
        /// Surfaces that do not touch.
        optional exclude: Vec<At<Excluded>>,
        /// Friction of two surfaces. If several statements concern the same facets, here and in
        /// `exclude`, the narrowest applies.
        optional between: Vec<At<Between>>,
        /// Textures.
        optional surface: Vec<At<PaintedSurface>>,
        /// Dihedral angle in degrees from which on an edge separates faces: nodes there have a
        /// normal and a traction for each face. Default: 45.
        optional feature_angle: Angle,
        /// As in `pair`.
        optional search_distance: Positive,
        /// As in `pair`, for surfaces of different bodies.
        optional initial: Initial,
        /// As in `pair`, for surfaces of different bodies.
        optional stabilise: Truth,
    }
}

table! {
    /// Surfaces that do not touch.
    Excluded {
        /// Label of a surface.
        required a: Text,
        /// Label of the surface that it does not touch, or its own. Default: any surface.
        optional b: Text,
    }
}

table! {
    /// Friction of two surfaces.
    Between {
        /// Label of a surface.
        required a: Text,
        /// Label of the surface that it touches, or its own.
        required b: Text,
        /// Friction from the start; steps may change it.
        required friction: Friction,
    }
}

table! {
    /// The texture of a surface, for friction laws that need one.
    PaintedSurface {
        /// Label of the surface.
        required of: Text,
        /// Texture painted on the surface at rest, which it follows as it deforms.
        required texture: Texture,
    }
}
