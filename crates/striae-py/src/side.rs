//! Contact at the nodes of a side of a pair, as arrays.

use numpy::PyArray1;
use pyo3::{prelude::*, types::PyDict};
use striae::{
    contact::unknowns::{NodeResult, Status},
    mesh::{NodeId, Vec3},
    surface::topology::Surface,
};

use crate::array::{node_array, node_rows, rows};

/// A deformable side in one configuration.
pub struct OfSide<'a> {
    /// Numbers of its nodes.
    pub nodes: &'a [NodeId],
    /// Its facets.
    pub facets: Option<&'a Surface>,
    /// Positions by the number of the node.
    pub positions: &'a [Vec3],
    /// Results at the nodes.
    pub known: &'a [NodeResult],
}

impl OfSide<'_> {
    /// Arrays by their names.
    pub fn arrays<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let known = self.known;
        let vectors = |value: fn(&NodeResult) -> Vec3| {
            rows(py, known.iter().map(move |node| value(node).into()))
        };
        let numbers = |value: fn(&NodeResult) -> f64| {
            PyArray1::from_vec(py, known.iter().map(value).collect())
        };
        let at = self.nodes.iter();
        let at = at.map(|node| self.positions[node.index()].into());
        let facets = self.facets.map_or(&[][..], |s| s.facets());
        let corners = facets.iter().map(|facet| facet.map(|node| NodeId(node.0)));
        let all = PyDict::new(py);
        all.set_item("nodes", node_array(py, self.nodes))?;
        all.set_item("facets", node_rows(py, corners)?)?;
        all.set_item("position", rows(py, at)?)?;
        all.set_item("gap", numbers(|node| node.gap))?;
        all.set_item("pressure", numbers(|node| node.pressure))?;
        all.set_item("mean_pressure", numbers(NodeResult::mean_pressure))?;
        all.set_item("friction", vectors(|node| node.tau)?)?;
        all.set_item("traction", vectors(traction)?)?;
        all.set_item("mean_traction", vectors(|node| node.mean)?)?;
        all.set_item("slip", vectors(|node| node.slip)?)?;
        all.set_item("normal", vectors(|node| node.normal)?)?;
        all.set_item("texture", vectors(|node| node.texture)?)?;
        let status = known.iter().map(|node| match node.status {
            Status::Open => 0_i8,
            Status::Stick => 1,
            Status::Slip => 2,
        });
        all.set_item("status", PyArray1::from_vec(py, status.collect()))?;
        Ok(all)
    }
}

/// Traction on the surface that carries the node, `-p n + tau`.
fn traction(node: &NodeResult) -> Vec3 {
    node.tau - node.normal * node.pressure
}
