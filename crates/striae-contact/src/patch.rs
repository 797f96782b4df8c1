//! Connected contact patches of a pair of deformable sides.

use striae_mesh::Vec3;

use crate::{configuration::Configuration, coverage::Coverage, pair::Balance, selection::Role};

/// A connected part of the contact zone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Its centre `x_c`.
    pub centre: Vec3,
    /// Largest distance of its nodes from the centre.
    pub radius: f64,
}

/// Patches and the patch of every node, by side.
pub type Patches = (Vec<Patch>, [Vec<Option<u32>>; 2]);

/// The patches formed by the nodes that carry traction.
pub fn patches(
    configuration: &Configuration,
    coverage: &[Vec<Coverage>; 2],
    roles: &[Vec<Role>; 2],
) -> Patches {
    let none = [0, 1].map(|side| vec![None; roles[side].len()]);
    if configuration.pair.is_rigid() || configuration.pair.balance == Balance::None {
        return (Vec::new(), none);
    }
    let offset = roles[0].len();
    let mut groups = Groups::new(offset + roles[1].len());
    let index = |side: usize, node: u32| side * offset + node as usize;
    let active = |side: usize, node: u32| roles[side][node as usize] != Role::Idle;
    for side in 0..2 {
        for facet in configuration.side(side).surface.facets() {
            let carrying: Vec<u32> = facet.iter().copied().filter(|&n| active(side, n)).collect();
            for pair in carrying.windows(2) {
                groups.join(index(side, pair[0]), index(side, pair[1]));
            }
        }
        for node in 0..roles[side].len() as u32 {
            if let Coverage::Near(contact) = coverage[side][node as usize]
                && let Some((corners, _)) = contact.place.weights(configuration, side)
            {
                for corner in corners {
                    if active(1 - side, corner) {
                        groups.join(index(side, node), index(1 - side, corner));
                    }
                }
            }
        }
    }
    collect(configuration, roles, &mut groups, offset, none)
}

fn collect(
    configuration: &Configuration,
    roles: &[Vec<Role>; 2],
    groups: &mut Groups,
    offset: usize,
    mut patch_of: [Vec<Option<u32>>; 2],
) -> Patches {
    let mut members: Vec<Vec<Vec3>> = Vec::new();
    let mut number = vec![None; offset + roles[1].len()];
    for side in 0..2 {
        for node in 0..roles[side].len() {
            if roles[side][node] == Role::Idle {
                continue;
            }
            let root = groups.root(side * offset + node);
            let patch = *number[root].get_or_insert_with(|| {
                members.push(Vec::new());
                members.len() as u32 - 1
            });
            patch_of[side][node] = Some(patch);
            members[patch as usize].push(configuration.side(side).x[node]);
        }
    }
    let patch = |points: &Vec<Vec3>| {
        let centre = points.iter().sum::<Vec3>() / points.len() as f64;
        let radius = points
            .iter()
            .map(|x| (x - centre).norm())
            .fold(0.0, f64::max);
        Patch { centre, radius }
    };
    (members.iter().map(patch).collect(), patch_of)
}

/// Disjoint sets with the smallest member as root.
struct Groups(Vec<usize>);

impl Groups {
    fn new(count: usize) -> Self {
        Self((0..count).collect())
    }

    fn root(&mut self, mut item: usize) -> usize {
        while self.0[item] != item {
            self.0[item] = self.0[self.0[item]];
            item = self.0[item];
        }
        item
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b);
    }
}
