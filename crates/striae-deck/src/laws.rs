//! Laws and textures that decks may name.

use striae_declared::Declared;
use striae_law::{
    bulk::{self, Material},
    friction::{self, Friction},
};
use striae_surface::texture::{Paint, TEXTURES};

/// Laws and textures that a deck may name: those of the library, and others that are added.
///
/// ```
/// use striae_deck::Laws;
/// use striae_declared::{Declared, POSITIVE, Parameter};
/// use striae_law::friction::Friction;
///
/// static SLIPPERY: Declared<Friction> = Declared {
///     name: "slippery",
///     summary: "A tenth of Coulomb friction.",
///     parameters: &[Parameter::number("dry", POSITIVE, "no unit", "Coefficient when dry.")],
///     build: |values| Friction::coulomb(0.1 * values.number("dry")),
///     fit: None,
/// };
///
/// let laws = Laws::default().with_friction(&SLIPPERY);
/// assert_eq!(laws.friction().last().unwrap().name, "slippery");
/// ```
#[derive(Clone, Debug)]
pub struct Laws {
    friction: Vec<&'static Declared<Friction>>,
    bulk: Vec<&'static Declared<Material>>,
    textures: Vec<&'static Declared<Paint>>,
}

impl Default for Laws {
    fn default() -> Self {
        Self {
            friction: friction::LAWS.to_vec(),
            bulk: bulk::LAWS.to_vec(),
            textures: TEXTURES.to_vec(),
        }
    }
}

impl Laws {
    /// Returns the laws with one more, in place of one of the same name.
    pub fn with_friction(mut self, law: &'static Declared<Friction>) -> Self {
        self.friction.retain(|known| known.name != law.name);
        self.friction.push(law);
        self
    }

    /// Returns the laws with one more, in place of one of the same name.
    pub fn with_bulk(mut self, law: &'static Declared<Material>) -> Self {
        self.bulk.retain(|known| known.name != law.name);
        self.bulk.push(law);
        self
    }

    /// Returns the laws with one more texture, in place of one of the same name.
    ///
    /// Tables tell textures apart by their keys, so each needs one that no other texture has.
    pub fn with_texture(mut self, texture: &'static Declared<Paint>) -> Self {
        self.textures.retain(|known| known.name != texture.name);
        self.textures.push(texture);
        self
    }

    /// Returns the textures.
    pub fn textures(&self) -> &[&'static Declared<Paint>] {
        &self.textures
    }

    /// Returns the bulk laws.
    pub fn bulk(&self) -> &[&'static Declared<Material>] {
        &self.bulk
    }

    /// Returns the laws of friction.
    pub fn friction(&self) -> &[&'static Declared<Friction>] {
        &self.friction
    }
}
