//! Errors of meshes and of the parameters of generators.

use crate::{CellKind, ElementId, Face, NodeId};
use striae_declared::shown;

/// Error of a mesh or of the parameters of a generator.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// An element names a node that does not exist.
    #[error("{element} refers to {node}, but the mesh has {nodes} nodes")]
    MissingNode {
        /// The element.
        element: ElementId,
        /// The node it names.
        node: NodeId,
        /// Number of nodes of the mesh.
        nodes: usize,
    },
    /// An element names one node at two corners.
    #[error("{element} has {node} at two of its corners; a {kind} needs {} different nodes", kind.corner_count())]
    RepeatedNode {
        /// Its kind.
        kind: CellKind,
        /// The element.
        element: ElementId,
        /// The node it names twice.
        node: NodeId,
    },
    /// Two elements have the same corners.
    #[error("{element} has the same corners as {other}; remove one of them")]
    RepeatedElement {
        /// The later one.
        element: ElementId,
        /// The earlier one.
        other: ElementId,
    },
    /// Nodes that no element uses.
    #[error("{} nodes belong to no element, the first is {}", nodes.len(), nodes[0])]
    OrphanNodes {
        /// The nodes, never empty.
        nodes: Vec<NodeId>,
    },
    /// A position that is not a number.
    #[error("the position of {node} is not finite")]
    NotFinite {
        /// The node.
        node: NodeId,
    },
    /// Three elements or more meet in one face.
    #[error("the {face} belongs to more than two elements")]
    CrowdedFace {
        /// The face as seen from one of the elements.
        face: Face,
    },
    /// A node set names a node that does not exist.
    #[error("node set '{set}' refers to {node}, but the mesh has {nodes} nodes")]
    MissingSetNode {
        /// Name of the set.
        set: String,
        /// The node it names.
        node: NodeId,
        /// Number of nodes of the mesh.
        nodes: usize,
    },
    /// An element set names an element that does not exist.
    #[error("element set '{set}' refers to {element}, but the mesh has {elements} elements")]
    MissingSetElement {
        /// Name of the set.
        set: String,
        /// The element it names.
        element: ElementId,
        /// Number of elements of the mesh.
        elements: usize,
    },
    /// A facet set names a face that is not on the boundary or does not exist.
    #[error("facet set '{set}' refers to {face}, which is not on the boundary of the mesh")]
    NotOnBoundary {
        /// Name of the set.
        set: String,
        /// The face it names.
        face: Face,
    },
    /// Elements whose Jacobian determinant is not positive everywhere.
    #[error(
        "{count} elements are turned inside out or degenerate, the first is {element} \
         with a Jacobian determinant of {determinant:.3e}"
    )]
    Inverted {
        /// Number of such elements.
        count: usize,
        /// The first of them.
        element: ElementId,
        /// Its smallest Jacobian determinant.
        determinant: f64,
    },
    /// Elements that one parameter of a generator turns inside out.
    #[error(
        "{count} elements are turned inside out or degenerate, the first is {element}, and none without `{parameter}`; make it more moderate or leave it out ({doc})"
    )]
    Distorted {
        /// Number of such elements.
        count: usize,
        /// The first of them.
        element: ElementId,
        /// Name of the parameter.
        parameter: &'static str,
        /// Description of the parameter.
        doc: &'static str,
    },
    /// A parameter of a generator outside its range.
    #[error("{name} is {}, but {requirement}", shown(*value))]
    Parameter {
        /// Name of the parameter.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Requirement on the value, phrased to end a sentence.
        requirement: &'static str,
    },
    /// A capped block that has no height left at its corners.
    #[error(
        "height is {}, but must be more than {rise:.6}, the rise of the cap at the corners; make the block higher or smaller in plan, or the radius larger", shown(*height)
    )]
    CapRise {
        /// Its height.
        height: f64,
        /// Rise of the cap there.
        rise: f64,
    },
    /// More elements than a generator makes.
    #[error("the mesh would have {elements} elements, but the limit is {most}")]
    TooLarge {
        /// Number of elements that the mesh would have.
        elements: u128,
        /// Largest number allowed.
        most: u128,
    },
    /// A list of interval lengths that does not fit the number of divisions.
    #[error("{lengths} interval lengths are given for {divisions} divisions")]
    IntervalCount {
        /// Number of lengths given.
        lengths: usize,
        /// Number of divisions.
        divisions: usize,
    },
    /// A list of new numbers that is not a permutation.
    #[error(
        "the new {what} numbers are not a permutation of 0..{count}: position {position} is wrong"
    )]
    NotPermutation {
        /// `node` or `element`.
        what: &'static str,
        /// Required count of numbers.
        count: usize,
        /// First position that repeats a number, is out of range, missing or in excess.
        position: usize,
    },
}

impl MeshError {
    /// `Ok` where `holds`, otherwise the [`MeshError::Parameter`] error.
    pub(crate) fn require(
        holds: bool,
        name: &'static str,
        value: f64,
        requirement: &'static str,
    ) -> Result<(), Self> {
        if holds {
            return Ok(());
        }
        Err(Self::Parameter {
            name,
            value,
            requirement,
        })
    }
}
