//! Values as bytes, exactly: little-endian numbers of eight bytes, lists with their
//! length in front, fields one after the other.

use nalgebra::{Matrix3, Vector3};
use striae_contact::{
    field::FacetForces,
    pointed::RigidPoint,
    unknowns::{Label, NodeResult, Status, Tractions},
};
use striae_mesh::FacetId;
use striae_solve::{
    drive::Point,
    layout::Extent,
    newton::{Course, Experience, FactoredInterior, Memory},
    rigid::{Pose, Wrench},
    state::{Energies, NodalForces, PairState, State},
    warning::{Judgement, Kind, Worst},
};

use crate::summary::SolverSummary;

/// What can be written as bytes and read back.
pub(super) trait Coded: Sized {
    /// Appends the bytes.
    fn put(&self, bytes: &mut Vec<u8>);
    /// Takes the value from the front; `None` where the bytes are none of it.
    fn take(bytes: &mut &[u8]) -> Option<Self>;
}

impl Coded for u64 {
    fn put(&self, bytes: &mut Vec<u8>) {
        bytes.extend(self.to_le_bytes());
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        let (number, rest) = bytes.split_first_chunk::<8>()?;
        *bytes = rest;
        Some(Self::from_le_bytes(*number))
    }
}

macro_rules! as_number {
    ($($type:ty: $to:expr, $from:expr;)+) => { $(
        impl Coded for $type {
            fn put(&self, bytes: &mut Vec<u8>) {
                let to: fn(&$type) -> u64 = $to;
                to(self).put(bytes);
            }

            fn take(bytes: &mut &[u8]) -> Option<Self> {
                let from: fn(u64) -> Option<$type> = $from;
                from(u64::take(bytes)?)
            }
        }
    )+ };
}

as_number! {
    f64: |x| x.to_bits(), |n| Some(f64::from_bits(n));
    usize: |x| *x as u64, |n| usize::try_from(n).ok();
    u32: |x| u64::from(*x), |n| u32::try_from(n).ok();
    bool: |x| u64::from(*x), |n| [false, true].get(n as usize).copied();
    FacetId: |x| x.index() as u64, |n| usize::try_from(n).ok().map(FacetId::new);
    Kind: |x| Kind::ALL.iter().position(|kind| kind == x).map_or(u64::MAX, |at| at as u64),
        |n| Kind::ALL.get(usize::try_from(n).ok()?).copied();
    Status: |x| match x {
        Status::Open => 0,
        Status::Stick => 1,
        Status::Slip => 2,
    }, |n| [Status::Open, Status::Stick, Status::Slip].get(n as usize).copied();
}

impl<T: Coded> Coded for Vec<T> {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.len().put(bytes);
        self.iter().for_each(|element| element.put(bytes));
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        let count = usize::take(bytes)?;
        (0..count).map(|_| T::take(bytes)).collect()
    }
}

impl<T: Coded> Coded for Box<T> {
    fn put(&self, bytes: &mut Vec<u8>) {
        T::put(self, bytes);
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        T::take(bytes).map(Box::new)
    }
}

impl<T: Coded, const N: usize> Coded for [T; N] {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.iter().for_each(|element| element.put(bytes));
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        let all: Option<Vec<T>> = (0..N).map(|_| T::take(bytes)).collect();
        all?.try_into().ok()
    }
}

impl<A: Coded, B: Coded> Coded for (A, B) {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.0.put(bytes);
        self.1.put(bytes);
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        Some((A::take(bytes)?, B::take(bytes)?))
    }
}

impl Coded for String {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.len().put(bytes);
        bytes.extend(self.as_bytes());
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        let length = usize::take(bytes)?;
        let (text, rest) = bytes.split_at_checked(length)?;
        *bytes = rest;
        Self::from_utf8(text.to_vec()).ok()
    }
}

impl<T: Coded> Coded for Option<T> {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.is_some().put(bytes);
        self.iter().for_each(|value| value.put(bytes));
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        if bool::take(bytes)? {
            T::take(bytes).map(Some)
        } else {
            Some(None)
        }
    }
}

impl Coded for Vector3<f64> {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.iter().for_each(|component| component.put(bytes));
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        <[f64; 3]>::take(bytes).map(Self::from)
    }
}

impl Coded for Matrix3<f64> {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.iter().for_each(|component| component.put(bytes));
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        let columns = <[f64; 9]>::take(bytes)?;
        Some(Self::from_column_slice(&columns))
    }
}

macro_rules! coded {
    ($($name:ident { $($field:ident),+ $(,)? };)+) => { $(
        impl Coded for $name {
            fn put(&self, bytes: &mut Vec<u8>) {
                $(self.$field.put(bytes);)+
            }

            fn take(bytes: &mut &[u8]) -> Option<Self> {
                Some(Self { $($field: Coded::take(bytes)?),+ })
            }
        }
    )+ };
}
pub(super) use coded;

coded! {
    NodeResult { gap, pressure, tau, slip, normal, texture, mean, status };
    FacetForces { force, area, pressure, friction };
    Tractions { nodes, tau_n, slipped, labels };
    Label { status, begun, slip, fell, turns };
    Worst { kind, pair, value, time };
    Judgement { worst, forces, pressures, energy, step };
    SolverSummary { method, factorisations, contact_corrections, fall_backs, reason };
    PairState { tractions, kept, required, pointed, points, carried, nodes, facets, dissipated };
    RigidPoint { ends, share, left };
    Wrench { force, torque };
    Pose { displacement, turned, rotation };
    NodalForces { internal, inertia, reaction, applied, contact, stabilisation, stabilised, rigid, pushed };
    Energies { kinetic, strain, external, inelastic, friction, contact, stabilisation, numerical };
    State { time, positions, velocities, accelerations, rigid, histories, pairs, forces, energies };
    Extent { nodes };
    FactoredInterior { values, scales, prescribed, single };
    Experience { too_coarse, taken, interior };
    Memory { extent, cliques, solver, course };
    Course { step, start, end, positions, rigid, tractions, before };
    Point { step, increments, fraction, size, search, start, state, memory };
}
