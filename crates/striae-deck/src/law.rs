//! Laws, textures and generators in tables: the name of a declared one at one key, its parameters
//! at others; of textures and directions of fibres the keys of the parameters tell the name.
//!
//! Reader, schema and reference follow from the declarations of `striae-law`, `striae-surface` and
//! `striae-mesh`; this crate knows no law, no texture and no generator by name.

mod compositions;
mod reading;

use striae_declared::{Declared, Kind};
use striae_law::{
    bulk::{DIRECTIONS, Direction, Material},
    friction::{
        BY_PRESSURE, BY_RATE, BY_SLIP, BY_STATE, DECAY, Friction, PressureDependence,
        RateDependence, SlipDependence, StateDependence,
    },
};
use striae_mesh::generate::{GENERATORS, Generator};
use striae_surface::texture::Paint;

use super::{
    Laws,
    declare::read_as_table,
    faults::FaultList,
    form::{Alternative, Form, Open},
    read::{self, Part, Place, TableReader},
    value::word,
};
use compositions::{compositions, key, of_each, of_law};
pub(crate) use reading::Stated;

/// A kind of laws that tables name.
pub(crate) trait Named: Kind {
    /// The key with the name; none where the keys of the parameters tell it.
    const TAG: Option<&'static str>;
    /// Meaning of the name.
    const DOC: &'static str;
    /// The kind, if a program may add laws of its own.
    const OPEN: Option<Open>;

    /// Returns the laws that can be named.
    fn declared(laws: &Laws) -> &[&'static Declared<Self>];
}

impl Named for Friction {
    const TAG: Option<&'static str> = Some("law");
    const DOC: &'static str = "Friction law.";
    const OPEN: Option<Open> = Some(Open::Friction);

    fn declared(laws: &Laws) -> &[&'static Declared<Self>] {
        laws.friction()
    }
}

impl Named for Material {
    const TAG: Option<&'static str> = Some("law");
    const DOC: &'static str = "Bulk law.";
    const OPEN: Option<Open> = Some(Open::Bulk);

    fn declared(laws: &Laws) -> &[&'static Declared<Self>] {
        laws.bulk()
    }
}

impl Named for Generator {
    const TAG: Option<&'static str> = Some("generator");
    const DOC: &'static str = "Generator of the mesh.";
    const OPEN: Option<Open> = None;

    fn declared(_: &Laws) -> &[&'static Declared<Self>] {
        GENERATORS
    }
}

impl Named for Paint {
    const TAG: Option<&'static str> = None;
    const DOC: &'static str = "Texture.";
    const OPEN: Option<Open> = Some(Open::Texture);

    fn declared(laws: &Laws) -> &[&'static Declared<Self>] {
        laws.textures()
    }
}

impl Named for Direction {
    const TAG: Option<&'static str> = None;
    const DOC: &'static str = "Direction of fibres.";
    const OPEN: Option<Open> = None;

    fn declared(_: &Laws) -> &[&'static Declared<Self>] {
        DIRECTIONS
    }
}

impl Named for PressureDependence {
    const TAG: Option<&'static str> = Some("form");
    const DOC: &'static str = "How the coefficients depend on the pressure.";
    const OPEN: Option<Open> = None;

    fn declared(_: &Laws) -> &[&'static Declared<Self>] {
        BY_PRESSURE
    }
}

impl Named for RateDependence {
    const TAG: Option<&'static str> = Some("form");
    const DOC: &'static str = "How the coefficients depend on the slip rate.";
    const OPEN: Option<Open> = None;

    fn declared(_: &Laws) -> &[&'static Declared<Self>] {
        BY_RATE
    }
}

impl Named for SlipDependence {
    const TAG: Option<&'static str> = Some("form");
    const DOC: &'static str = "How the coefficients depend on the accumulated slip.";
    const OPEN: Option<Open> = None;

    fn declared(_: &Laws) -> &[&'static Declared<Self>] {
        BY_SLIP
    }
}

impl Named for StateDependence {
    const TAG: Option<&'static str> = Some("form");
    const DOC: &'static str = "How the state of the surface evolves.";
    const OPEN: Option<Open> = None;

    fn declared(_: &Laws) -> &[&'static Declared<Self>] {
        BY_STATE
    }
}

impl<L: Named> Part for Stated<L> {
    fn part(reader: &mut TableReader<'_, '_, '_>) -> Option<Self> {
        let laws = L::declared(reader.faults.laws());
        match L::TAG {
            Some(tag) => Self::of_name(tag, laws, reader),
            None => {
                let groups = Self::groups(laws);
                let at = reader.choose(&groups)?;
                Some(Self::read(laws[at], reader))
            }
        }
    }

    fn alternatives() -> Vec<Alternative> {
        match L::OPEN {
            None => of_each::<L>(&Laws::default()),
            Some(open) => vec![Alternative {
                doc: String::new(),
                keys: vec![key(L::TAG.unwrap_or_default(), L::DOC, Form::Law(open))],
            }],
        }
    }
}

impl<L: Named> Stated<L> {
    /// Returns the compositions of the keys of each law.
    pub(crate) fn groups(laws: &[&'static Declared<L>]) -> Vec<Vec<Alternative>> {
        laws.iter().map(|law| of_law(law)).collect()
    }

    /// Reads the law that is named at a key.
    fn of_name(
        tag: &'static str,
        laws: &[&'static Declared<L>],
        reader: &mut TableReader<'_, '_, '_>,
    ) -> Option<Self> {
        let names: Vec<&'static str> = laws.iter().map(|law| law.name).collect();
        let expected = Form::Words(names.iter().map(|name| (*name, "")).collect()).expected();
        let read = |value: &read::Value<'_>, place: &Place, faults: &mut FaultList<'_>| {
            word(value, place, faults, &names)
        };
        match reader.required_as(tag, &expected, read) {
            Some(at) => Some(Self::read(laws[at.value], reader)),
            None => {
                laws.iter()
                    .for_each(|law| reader.tolerate(&compositions(law.parameters)));
                None
            }
        }
    }
}

/// The decay of coefficients, the only law of its table.
#[derive(Clone, Debug)]
pub(crate) struct Decay(pub(crate) Stated<RateDependence>);

impl Part for Decay {
    fn part(reader: &mut TableReader<'_, '_, '_>) -> Option<Self> {
        Some(Self(Stated::read(&DECAY, reader)))
    }

    fn alternatives() -> Vec<Alternative> {
        of_law(&DECAY)
    }
}

pub(crate) type FibreDirection = Stated<Direction>;
pub(crate) type ByPressure = Stated<PressureDependence>;
pub(crate) type BySlipRate = Stated<RateDependence>;
pub(crate) type ByAccumulatedSlip = Stated<SlipDependence>;
pub(crate) type ByState = Stated<StateDependence>;

read_as_table!(FibreDirection);
read_as_table!(Decay);
read_as_table!(ByPressure);
read_as_table!(BySlipRate);
read_as_table!(ByAccumulatedSlip);
read_as_table!(ByState);

impl Open {
    /// Returns the compositions of a table with any of the laws.
    pub(crate) fn alternatives(self, laws: &Laws) -> Vec<Alternative> {
        match self {
            Self::Friction => of_each::<Friction>(laws),
            Self::Bulk => of_each::<Material>(laws),
            Self::Texture => of_each::<Paint>(laws),
        }
    }
}
