//! `texture = { ... }` of a side of a pair.

use crate::{
    declare::{read_as_table, table},
    form::Alternative,
    law::Stated,
    read::{Part, TableReader},
    value::Text,
};
use striae_surface::texture::Paint;

/// A texture: directions along the grooves or the row of scales.
#[derive(Clone, Debug)]
pub(crate) enum Texture {
    /// As it is declared.
    Declared(Stated<Paint>),
    /// A direction at every node, from a file.
    OfFile(NodalTexture),
}

impl Part for Texture {
    fn part(reader: &mut TableReader<'_, '_, '_>) -> Option<Self> {
        let declared = reader.faults.laws().textures();
        let mut groups = Stated::groups(declared);
        groups.push(NodalTexture::alternatives());
        match declared.get(reader.choose(&groups)?) {
            Some(texture) => Some(Self::Declared(Stated::read(texture, reader))),
            None => NodalTexture::part(reader).map(Self::OfFile),
        }
    }

    fn alternatives() -> Vec<Alternative> {
        let mut all = Stated::<Paint>::alternatives();
        all.extend(NodalTexture::alternatives());
        all
    }
}

read_as_table!(Texture);

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
