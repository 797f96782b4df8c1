//! Arrays of numpy from vectors of the library and back.

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::{exceptions::PyValueError, prelude::*};
use striae::mesh::{NodeId, Vec3};

/// An array of one dimension.
pub type Array1<'py, T> = Bound<'py, PyArray1<T>>;
/// An array of two dimensions.
pub type Array2<'py, T> = Bound<'py, PyArray2<T>>;

/// Rows of an array of three columns.
pub fn vectors(array: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<Vec3>> {
    let array = array.as_array();
    if array.ncols() != 3 {
        return Err(PyValueError::new_err("an array of three columns is needed"));
    }
    let rows = array.rows().into_iter();
    Ok(rows.map(|row| Vec3::new(row[0], row[1], row[2])).collect())
}

/// Rows of node numbers.
pub fn corners<const N: usize>(array: &PyReadonlyArray2<'_, i64>) -> PyResult<Vec<[NodeId; N]>> {
    let array = array.as_array();
    if array.ncols() != N {
        let text = format!("an array of {N} columns is needed");
        return Err(PyValueError::new_err(text));
    }
    let mut all = Vec::with_capacity(array.nrows());
    for row in array.rows() {
        let mut corners = [NodeId(0); N];
        for (corner, number) in corners.iter_mut().zip(row) {
            *corner = node(*number)?;
        }
        all.push(corners);
    }
    Ok(all)
}

/// Rows of node numbers, one after the other.
pub fn table(array: &PyReadonlyArray2<'_, i64>, columns: usize) -> PyResult<Vec<NodeId>> {
    let array = array.as_array();
    if array.ncols() != columns {
        let text = format!("an array of {columns} columns is needed");
        return Err(PyValueError::new_err(text));
    }
    array.iter().map(|number| node(*number)).collect()
}

/// Node numbers.
pub fn nodes(array: &PyReadonlyArray1<'_, i64>) -> PyResult<Vec<NodeId>> {
    array
        .as_array()
        .iter()
        .map(|number| node(*number))
        .collect()
}

fn node(number: i64) -> PyResult<NodeId> {
    let id = u32::try_from(number).map(NodeId);
    id.map_err(|_| PyValueError::new_err(format!("{number} is not the number of a node")))
}

/// Vectors as rows.
pub fn rows<'py>(
    py: Python<'py>,
    vectors: impl ExactSizeIterator<Item = [f64; 3]>,
) -> PyResult<Array2<'py, f64>> {
    let count = vectors.len();
    PyArray1::from_vec(py, vectors.flatten().collect()).reshape([count, 3])
}

/// Corners as rows.
pub fn node_rows<'py, const N: usize>(
    py: Python<'py>,
    corners: impl ExactSizeIterator<Item = [NodeId; N]>,
) -> PyResult<Array2<'py, i64>> {
    let count = corners.len();
    let numbers = corners.flatten().map(|node| i64::from(node.0)).collect();
    PyArray1::from_vec(py, numbers).reshape([count, N])
}

/// Node numbers as rows of so many columns.
pub fn node_table<'py>(
    py: Python<'py>,
    nodes: &[NodeId],
    columns: usize,
) -> PyResult<Array2<'py, i64>> {
    node_array(py, nodes).reshape([nodes.len() / columns, columns])
}

/// Node numbers as an array.
pub fn node_array<'py>(py: Python<'py>, nodes: &[NodeId]) -> Array1<'py, i64> {
    PyArray1::from_vec(py, nodes.iter().map(|node| i64::from(node.0)).collect())
}
