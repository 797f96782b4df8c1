//! The surfaces of the caller's mesh that may touch.

use std::{collections::BTreeSet, sync::Arc};

use striae_law::friction::Friction;
use striae_mesh::{NodeId, Vec3};
use striae_surface::{
    normal::nodal_normals,
    texture::{Paint, Texture},
    topology,
};

use super::{
    fault::{Fault, FaultKind, Faults},
    input::{Opponent, Pair, Surface},
    numbers::{nodes_of, of_side},
    shape,
};
use crate::{
    configuration::Configuration,
    initial::facing::{Seen, back_to_back},
    pair::{ContactPair, Enforcement, Geometry, PairedSurface, SideTexture},
    placement::Placement,
    side::Side,
};

/// Surfaces of a mesh, and rigid ones, that may touch. Copies share their contents.
#[derive(Clone, Debug)]
pub struct Contact(Arc<Parts>);

#[derive(Debug)]
struct Parts {
    reference: Vec<Vec3>,
    members: Vec<Member>,
    /// Checksum of the mesh and its surfaces, by which states are told apart.
    checksum: u32,
}

/// A pair with what goes with it.
#[derive(Debug)]
pub(super) struct Member {
    pub(super) pair: ContactPair,
    pub(super) friction: Friction,
    /// Reference positions of a rigid side `b`.
    pub(super) rigid: Vec<Vec3>,
}

impl Contact {
    /// Contact of pairs of surfaces of a mesh with nodes at these reference positions.
    ///
    /// # Errors
    /// Lists all faults of the pairs.
    pub fn new(positions: Vec<Vec3>, pairs: &[Pair]) -> Result<Self, Faults> {
        shape::finite(&positions, "positions")?;
        if pairs.is_empty() {
            return Err(Faults::one("pairs", FaultKind::NoPair));
        }
        let mut faults: Vec<Fault> = names(pairs);
        let mut members = Vec::with_capacity(pairs.len());
        for (index, pair) in pairs.iter().enumerate() {
            match member(pair, &positions) {
                Ok(member) => members.push(member),
                Err(Faults(found)) => faults.extend(found.into_iter().map(|fault| Fault {
                    place: format!("pairs[{index}].{}", fault.place),
                    ..fault
                })),
            }
        }
        if !faults.is_empty() {
            return Err(Faults(faults));
        }
        let contact = Self(Arc::new(Parts {
            checksum: checksum(&positions, &members),
            reference: positions,
            members,
        }));
        let away = (0..pairs.len()).filter_map(|pair| contact.away(pair));
        let away: Vec<Fault> = away.collect();
        match away.is_empty() {
            true => Ok(contact),
            false => Err(Faults(away)),
        }
    }

    /// The fault that the sides of a pair touch and look away from each other.
    fn away(&self, pair: usize) -> Option<Fault> {
        let placements = vec![Placement::at_rest(); self.pair_count()];
        let configuration = self.configuration(pair, self.reference(), &placements);
        let found = back_to_back(&configuration).filter(Seen::touches)?;
        let surface = self.surface(pair, found.side)?;
        Some(Fault {
            place: format!("pairs[{pair}]"),
            kind: FaultKind::Away {
                node: surface.nodes()[found.node.index()],
                side: found.side,
                angle: found.cosine.clamp(-1.0, 1.0).acos().to_degrees(),
            },
        })
    }

    /// Number of nodes of the mesh.
    pub fn node_count(&self) -> usize {
        self.0.reference.len()
    }

    /// Number of pairs.
    pub fn pair_count(&self) -> usize {
        self.members().len()
    }

    /// Nodes of a side of a pair, in the order of its results; none of a rigid one.
    pub fn nodes(&self, pair: usize, side: Side) -> Vec<NodeId> {
        nodes_of(&self.members()[pair].pair, side)
    }

    /// Facets of a side of a pair; none of a plane.
    pub fn surface(&self, pair: usize, side: Side) -> Option<&topology::Surface> {
        self.members()[pair].pair.sides[side].surface()
    }

    pub(super) fn reference(&self) -> &[Vec3] {
        &self.0.reference
    }

    pub(super) fn checksum(&self) -> u32 {
        self.0.checksum
    }

    pub(super) fn members(&self) -> &[Member] {
        &self.0.members
    }

    /// Configuration of a pair.
    pub(super) fn configuration(
        &self,
        pair: usize,
        x: &[Vec3],
        placements: &[Placement],
    ) -> Configuration<'_> {
        let Member {
            pair: of, rigid, ..
        } = &self.members()[pair];
        let positions = Side::BOTH.map(|side| match of.is_deformable(side) {
            true => of_side(of, side).map(|(_, node)| x[node.index()]).collect(),
            false => rigid.clone(),
        });
        Configuration::new(of, positions, placements[pair])
    }

    /// Checks that all facets have an area.
    pub(super) fn areas(&self, x: &[Vec3]) -> Result<(), Faults> {
        for (index, Member { pair, .. }) in self.members().iter().enumerate() {
            for &side in pair.deformable_sides() {
                let at: Vec<Vec3> = of_side(pair, side).map(|(_, n)| x[n.index()]).collect();
                let surface = pair.sides[side].surface();
                let found = surface.map_or(Ok(()), |surface| shape::areas(surface, &at));
                found.map_err(|kind| Faults::one(format!("pairs[{index}].{side}.facets"), kind))?;
            }
        }
        Ok(())
    }
}

/// Checksum of positions and facets; friction and textures may change between states.
fn checksum(positions: &[Vec3], members: &[Member]) -> u32 {
    let mut sum = crc32fast::Hasher::new();
    let mut vectors = |list: &[Vec3]| {
        for number in list.iter().flatten() {
            sum.update(&number.to_bits().to_le_bytes());
        }
    };
    vectors(positions);
    for member in members {
        vectors(&member.rigid);
        for side in &member.pair.sides {
            if let Geometry::Plane { point, normal } = &side.geometry {
                vectors(&[*point, *normal]);
            }
        }
    }
    for member in members {
        for surface in member.pair.sides.iter().filter_map(PairedSurface::surface) {
            let nodes = surface.nodes().iter().map(|node| node.index());
            let corners = surface.facets().iter().flatten().map(|node| node.index());
            for number in nodes.chain(corners) {
                sum.update(&(number as u64).to_le_bytes());
            }
        }
    }
    sum.finalize()
}

/// Names that several pairs have.
fn names(pairs: &[Pair]) -> Vec<Fault> {
    let mut known = BTreeSet::new();
    let pairs = pairs.iter().enumerate();
    let repeated = pairs.filter(|(_, pair)| !known.insert(&pair.name));
    let fault = |(index, pair): (usize, &Pair)| Fault {
        place: format!("pairs[{index}].name"),
        kind: FaultKind::Name {
            name: pair.name.clone(),
        },
    };
    repeated.map(fault).collect()
}

fn member(stated: &Pair, positions: &[Vec3]) -> Result<Member, Faults> {
    positive(stated.search_distance, "search_distance")?;
    let a = deformable(&stated.a, positions, "a")?;
    let mut rigid = Vec::new();
    let b = match &stated.b {
        Opponent::Deformable(surface) => {
            let b = deformable(surface, positions, "b")?;
            shared(&a, &b)?;
            b
        }
        Opponent::Rigid {
            points,
            facets,
            texture,
        } => {
            shape::finite(points, "b.points")?;
            let surface = surface(facets, points, "b")?;
            rigid = places(&surface, points);
            let texture = painted(&surface, &rigid, texture.as_ref(), "b")?;
            side(Geometry::Rigid(surface), f64::INFINITY, texture)
        }
        Opponent::Plane {
            point,
            normal,
            texture,
        } => plane(point, normal, texture.as_ref())?,
    };
    textured(&stated.friction, [&a, &b])?;
    let pair = ContactPair {
        name: stated.name.clone(),
        sides: [a, b],
        enforcement: Enforcement::Weighted,
        search_distance: stated.search_distance,
        has_faces: false,
        one_body: false,
        wear: [0.0; 2],
        wear_across: 1.0,
    };
    let friction = stated.friction.clone();
    Ok(Member {
        pair,
        friction,
        rigid,
    })
}

fn positive(value: Option<f64>, place: &str) -> Result<(), Faults> {
    match value {
        Some(value) if !(value > 0.0 && value.is_finite()) => {
            Err(Faults::one(place, FaultKind::NotPositive { value }))
        }
        _ => Ok(()),
    }
}

/// A side that touches with a texture.
fn side(geometry: Geometry, stiffness: f64, texture: Option<SideTexture>) -> PairedSurface {
    PairedSurface {
        geometry,
        stiffness,
        texture,
        behind: Vec::new(),
        enclosure: None,
    }
}

fn deformable(stated: &Surface, positions: &[Vec3], place: &str) -> Result<PairedSurface, Faults> {
    let surface = surface(&stated.facets, positions, place)?;
    positive(
        Some(stated.youngs_modulus),
        &format!("{place}.youngs_modulus"),
    )?;
    let x = places(&surface, positions);
    let texture = painted(&surface, &x, stated.texture.as_ref(), place)?;
    Ok(side(
        Geometry::Deformable(surface),
        stated.youngs_modulus,
        texture,
    ))
}

fn surface(
    facets: &[[NodeId; 4]],
    points: &[Vec3],
    place: &str,
) -> Result<topology::Surface, Faults> {
    let refused = |kind| Faults::one(format!("{place}.facets"), kind);
    shape::corners(facets, points.len()).map_err(refused)?;
    let surface = topology::Surface::new(facets);
    let x = places(&surface, points);
    shape::areas(&surface, &x).map_err(refused)?;
    shape::convex(&surface, &x).map_err(refused)?;
    Ok(surface)
}

fn places(surface: &topology::Surface, points: &[Vec3]) -> Vec<Vec3> {
    let nodes = surface.nodes().iter();
    nodes.map(|node| points[node.index()]).collect()
}

fn plane(point: &Vec3, normal: &Vec3, texture: Option<&Paint>) -> Result<PairedSurface, Faults> {
    shape::finite(&[*point], "b.point")?;
    shape::finite(&[*normal], "b.normal")?;
    let unit = normal.try_normalize(0.0);
    let normal = unit.ok_or_else(|| Faults::one("b.normal", FaultKind::Zero))?;
    let field = |paint: &Paint| match paint {
        Paint::Field(field) => Ok(SideTexture::Plane(field.clone())),
        _ => Err(Faults::one("b.texture", FaultKind::PlaneTexture)),
    };
    let texture = texture.map(field).transpose()?;
    let point = *point;
    Ok(side(
        Geometry::Plane { point, normal },
        f64::INFINITY,
        texture,
    ))
}

fn painted(
    surface: &topology::Surface,
    x: &[Vec3],
    paint: Option<&Paint>,
    place: &str,
) -> Result<Option<SideTexture>, Faults> {
    let Some(paint) = paint else {
        return Ok(None);
    };
    let normals = nodal_normals(surface, x);
    let painted = Texture::new(x, surface.facets(), &normals, paint);
    let (texture, _) = painted.map_err(|error| {
        let node = error.node();
        let node = node.and_then(|node| surface.nodes().get(node.index()).copied());
        Faults::one(
            format!("{place}.texture"),
            FaultKind::Texture { node, error },
        )
    })?;
    Ok(Some(SideTexture::Nodal(texture)))
}

/// Refuses sides that have a node in common.
fn shared(a: &PairedSurface, b: &PairedSurface) -> Result<(), Faults> {
    let nodes = |side: &PairedSurface| side.surface().map_or(Vec::new(), |s| s.nodes().to_vec());
    let known: BTreeSet<NodeId> = nodes(a).into_iter().collect();
    let node = nodes(b).into_iter().find(|node| known.contains(node));
    node.map_or(Ok(()), |node| {
        Err(Faults::one("b.facets", FaultKind::Shared { node }))
    })
}

/// Refuses friction without the textures that give it a direction, or with too many.
fn textured(friction: &Friction, sides: [&PairedSurface; 2]) -> Result<(), Faults> {
    let found = sides.iter().filter(|side| side.texture.is_some()).count();
    let unmet = friction.required_textures().unmet(found);
    unmet.map_or(Ok(()), |required| {
        let kind = FaultKind::Textures { required, found };
        Err(Faults::one("friction", kind))
    })
}
