//! Extended nodes: those that carry traction, but can neither collocate contact
//! nor find their traction opposite to them.
//!
//! They take the traction of the nearest kinematic node, or the mean of several
//! equally near. There are two kinds: uncovered nodes of partly covered facets,
//! and traction nodes in a group without any kinematic node, all of whose members
//! look at others of the group; their balance alone would leave them undetermined.

use crate::{
    configuration::Configuration,
    coverage::{Coverage, Place},
    selection::{Leader, Partner, Role},
};

/// Gives uncovered nodes of facets in or next to the covered zone, and traction
/// nodes that look at each other only, the traction of the nearest kinematic node.
pub fn extend(
    configuration: &Configuration,
    coverage: &[Vec<Coverage>; 2],
    roles: &mut [Vec<Role>; 2],
) {
    let kinematic: Vec<Leader> = (0..2)
        .flat_map(|side| {
            let of_side = roles[side].iter().enumerate();
            let is_kinematic = of_side.filter(|(_, role)| matches!(role, Role::Kinematic(_)));
            let leader = |(node, _)| Leader {
                side,
                node: node as u32,
            };
            is_kinematic.map(leader).collect::<Vec<_>>()
        })
        .collect();
    if configuration.plane().is_some() || kinematic.is_empty() {
        return;
    }
    for &side in configuration.pair.deformable_sides() {
        for node in zone(configuration, side, coverage) {
            if coverage[side][node as usize] == Coverage::Missed {
                let leaders = nearest(configuration, &kinematic, side, node);
                roles[side][node as usize] = Role::Extended(leaders);
            }
        }
    }
    for (side, node) in detached(roles) {
        let leaders = nearest(configuration, &kinematic, side, node);
        roles[side][node as usize] = Role::Extended(leaders);
    }
}

/// The kinematic nodes nearest to a node.
fn nearest(
    configuration: &Configuration,
    kinematic: &[Leader],
    side: usize,
    node: u32,
) -> Vec<Leader> {
    let x = configuration.side(side).x[node as usize];
    let distance =
        |leader: &Leader| (configuration.side(leader.side).x[leader.node as usize] - x).norm();
    let least = kinematic.iter().map(distance).fold(f64::INFINITY, f64::min);
    let is_nearest = |leader: &&Leader| distance(leader) <= least * (1.0 + EQUALLY_NEAR);
    kinematic.iter().filter(is_nearest).copied().collect()
}

/// Traction nodes whose tractions are, however often one looks across, means of
/// tractions of other such nodes only: nothing would determine them.
fn detached(roles: &[Vec<Role>; 2]) -> Vec<(usize, u32)> {
    let mut determined = roles.each_ref().map(|side| {
        let is_traction = |role: &Role| matches!(role, Role::Traction(_));
        side.iter()
            .map(|role| !is_traction(role))
            .collect::<Vec<_>>()
    });
    loop {
        let mut found = Vec::new();
        let mut rest = Vec::new();
        for side in 0..2 {
            for (node, role) in roles[side].iter().enumerate() {
                let Role::Traction(Partner::Corners(corners, weights)) = role else {
                    continue;
                };
                if determined[side][node] {
                    continue;
                }
                let share: f64 = (0..4)
                    .filter(|&at| determined[1 - side][corners[at] as usize])
                    .map(|at| weights[at])
                    .sum();
                let list = if share > LEAST_SHARE {
                    &mut found
                } else {
                    &mut rest
                };
                list.push((side, node as u32));
            }
        }
        if found.is_empty() {
            return rest;
        }
        for (side, node) in found {
            determined[side][node as usize] = true;
        }
    }
}

/// Share of determined tractions below which a mean does not count as determined.
const LEAST_SHARE: f64 = 1e-2;

/// Relative difference of distances that does not count.
const EQUALLY_NEAR: f64 = 1e-6;

/// Nodes of facets that are touched by the covered zone, and of their neighbours.
fn zone(configuration: &Configuration, side: usize, coverage: &[Vec<Coverage>; 2]) -> Vec<u32> {
    let snapshot = configuration.side(side);
    let near = |c: &Coverage| matches!(c, Coverage::Near(_));
    let mut inside: Vec<bool> = coverage[side].iter().map(near).collect();
    for covered in &coverage[1 - side] {
        if let Coverage::Near(contact) = covered
            && let Place::Facet(hit) = contact.place
        {
            for node in snapshot.corners(hit.facet) {
                inside[node as usize] = true;
            }
        }
    }
    for _ in 0..2 {
        let before = inside.clone();
        for facet in snapshot.surface.facets() {
            if facet.iter().any(|&node| before[node as usize]) {
                for node in facet {
                    inside[*node as usize] = true;
                }
            }
        }
    }
    (0..inside.len() as u32)
        .filter(|&node| inside[node as usize])
        .collect()
}
