//! Means at nodes of what elements have there, over all ranks that have some of them.
//!
//! Each rank sums what its own elements have, times their volume; sums are added over the ranks
//! that hold a node before they are divided by the volume. So fields have no seams between
//! ranks, and all of them have the same values at a node. Collective.

use nalgebra::Matrix3;
use striae_mesh::Vec3;
use striae_solve::problem::Problem;

/// Sums at the nodes of a body: what elements have times their volume, and their volume.
pub(crate) type Sums<T> = (Vec<T>, Vec<f64>);

/// Means of symmetric tensors; `None` where an element of any rank has none.
pub(crate) fn tensor_means(
    problem: &Problem,
    body: usize,
    own: Option<Sums<Matrix3<f64>>>,
) -> Option<Vec<Matrix3<f64>>> {
    let (mut tensors, mut volumes) = of_all(problem, own)?;
    if !problem.share.is_alone() {
        let pack = |tensor: &Matrix3<f64>, volume: &f64| {
            let [diagonal, beside] = parts(tensor);
            [diagonal, beside, Vec3::new(*volume, 0.0, 0.0)]
        };
        let packed = tensors.iter().zip(&volumes).map(|(t, v)| pack(t, v));
        let summed = summed(problem, body, packed.collect());
        for ((tensor, volume), sums) in tensors.iter_mut().zip(&mut volumes).zip(summed) {
            (*tensor, *volume) = (tensor_of(&sums[0], &sums[1]), sums[2].x);
        }
    }
    for (tensor, volume) in tensors.iter_mut().zip(volumes) {
        if volume > 0.0 {
            *tensor /= volume;
        }
    }
    Some(tensors)
}

/// Means of numbers; `None` where an element of any rank has none.
pub(crate) fn means(problem: &Problem, body: usize, own: Option<Sums<f64>>) -> Option<Vec<f64>> {
    let (mut values, mut volumes) = of_all(problem, own)?;
    if !problem.share.is_alone() {
        let packed = values.iter().zip(&volumes);
        let packed = packed.map(|(value, volume)| [Vec3::new(*value, *volume, 0.0)]);
        let summed = summed(problem, body, packed.collect());
        for ((value, volume), [sums]) in values.iter_mut().zip(&mut volumes).zip(summed) {
            (*value, *volume) = (sums.x, sums.y);
        }
    }
    let means = values.iter().zip(volumes);
    Some(means.map(|(value, volume)| value / volume).collect())
}

/// Value of this rank, unless another rank has none.
fn of_all<T>(problem: &Problem, own: Option<T>) -> Option<T> {
    match problem.share.any(own.is_none()) {
        true => None,
        false => own,
    }
}

/// Sums over the ranks that hold each node of a body.
fn summed<const N: usize>(problem: &Problem, body: usize, own: Vec<[Vec3; N]>) -> Vec<[Vec3; N]> {
    let nodes = problem.first_node[body]..problem.first_node[body + 1];
    let mut fields: [Vec<Vec3>; N] =
        std::array::from_fn(|_| vec![Vec3::zeros(); problem.reference.len()]);
    for (at, field) in fields.iter_mut().enumerate() {
        for (node, values) in nodes.clone().zip(&own) {
            field[node] = values[at];
        }
    }
    let mut parts = fields.each_mut().map(Vec::as_mut_slice);
    let mut parts: Vec<&mut [Vec3]> = parts.iter_mut().map(|part| &mut **part).collect();
    problem.share.sum_at_nodes(&mut parts);
    nodes
        .map(|node| std::array::from_fn(|at| fields[at][node]))
        .collect()
}

/// Diagonal of a symmetric tensor, and what is beside it.
fn parts(tensor: &Matrix3<f64>) -> [Vec3; 2] {
    let beside = [(0, 1), (1, 2), (0, 2)].map(|at| tensor[at]);
    [tensor.diagonal(), beside.into()]
}

fn tensor_of(diagonal: &Vec3, beside: &Vec3) -> Matrix3<f64> {
    let [xy, yz, xz] = [beside.x, beside.y, beside.z];
    let [xx, yy, zz] = [diagonal.x, diagonal.y, diagonal.z];
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}
