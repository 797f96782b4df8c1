//! Forces of unit pressures in self-contact, where scalars do not see that a node of the mesh is
//! pressed from two of its faces.

use std::collections::BTreeMap;

use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use crate::{common_mass::CommonMass, interface::Interface, pairing::SIGNS, side::Side};

/// Forces of unit pressures on the nodes of the mesh, in self-contact.
pub(super) struct Actions {
    /// `f_Jk` by kept node.
    of_pressure: Vec<BTreeMap<u32, Vec3>>,
    /// By node of the mesh.
    on_node: BTreeMap<u32, Vec<(u32, Vec3)>>,
    /// `kappa_J`.
    compliances: BTreeMap<u32, f64>,
}

impl Actions {
    pub(super) fn new(interface: &Interface, mass: &CommonMass, mesh: &[u32]) -> Self {
        let count = mass.nodes.len();
        let place = |node: SurfaceNode| mass.index[Side::A][node];
        let mut of_pressure = vec![BTreeMap::new(); count];
        for overlap in interface.overlaps {
            let corners: [SurfaceNode; 8] = std::array::from_fn(|c| overlap.corners[c / 4][c % 4]);
            for (c, of_c) in overlap.mass.iter().enumerate() {
                let Some(k) = place(corners[c]) else { continue };
                for (d, value) in of_c.iter().enumerate().filter(|(_, value)| **value != 0.0) {
                    let sum: &mut Vec3 = of_pressure[k as usize]
                        .entry(mesh[corners[d].index()])
                        .or_default();
                    *sum += overlap.normal * (SIGNS[d] * value);
                }
            }
        }
        let mut on_node: BTreeMap<u32, Vec<(u32, Vec3)>> = BTreeMap::new();
        let mut weights: BTreeMap<u32, [f64; 2]> = BTreeMap::new();
        for (k, (_, node)) in mass.nodes.iter().enumerate() {
            let sum = weights.entry(mesh[node.index()]).or_default();
            let weight = mass.weights[k];
            sum[0] += weight * mass.node(interface, k as u32).compliance;
            sum[1] += weight;
            for (&number, force) in &of_pressure[k] {
                on_node.entry(number).or_default().push((k as u32, *force));
            }
        }
        let mean = |(number, [sum, weight]): (u32, [f64; 2])| {
            (number, if weight > 0.0 { sum / weight } else { 0.0 })
        };
        Self {
            of_pressure,
            on_node,
            compliances: weights.into_iter().map(mean).collect(),
        }
    }

    /// `sum_J kappa_J f_Jk . f_Jl`.
    pub(super) fn row(&self, k: usize) -> Vec<(u32, f64)> {
        let on = self.of_pressure[k].iter().flat_map(|(number, own)| {
            let compliance = self.compliances[number];
            let product = move |&(l, force): &(u32, Vec3)| (l, compliance * own.dot(&force));
            self.on_node[number].iter().map(product)
        });
        on.collect()
    }
}
