//! The native part of the Python package `striae`: meshes, laws, models, runs and results
//! of the library of the same name, as Python's objects and numpy's arrays.
//!
//! The interface for users is written in Python (`python/striae`) and calls this module with plain
//! names, numbers and arrays; nothing here is public. All returned arrays are new ones that Python
//! owns.

mod array;
mod cavity;
mod cells;
mod component;
mod declared;
mod everything;
mod fault;
mod fit;
mod friction;
mod generate;
mod listen;
mod material;
mod mesh;
mod model;
mod own;
mod own_factor;
mod own_friction;
mod pair;
mod raised;
mod results;
mod rigid;
mod run;
mod side;
mod spring;
mod start;
mod step;
mod texture;
mod tie;
mod words;

use pyo3::prelude::*;

/// The native module.
#[pymodule]
mod _striae {
    #[pymodule_export]
    use super::{
        cavity::Cavity,
        component::{Contact, Evaluation, Increment, MeshPair, MeshSurface, State},
        declared::{Parameter, beyond, declarations},
        everything::Everything,
        fit::{fit_friction, measurements_of},
        friction::Friction,
        generate::generated,
        material::Material,
        mesh::{Mesh, read_mesh, read_rigid_surface},
        model::Model,
        own::own_material,
        pair::Pair,
        results::Results,
        rigid::Rigid,
        run::files::{picture, report},
        run::returned::returned,
        run::{Run, deck_of, resume, run},
        spring::Spring,
        step::{Step, check_function, is_uniform, moves},
        texture::Texture,
        tie::Tie,
    };
}
