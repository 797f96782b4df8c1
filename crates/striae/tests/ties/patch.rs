//! A constant stress passes a tie, whatever the facets.

use striae::{
    mesh::{
        CellKind::{self, CompositeTetrahedron, Hexahedron, Tetrahedron, Wedge},
        generate::Block,
    },
    prelude::*,
};

use super::scene::{glue, halves, of, pull, run, tied, unevenness};

const SLOPES: [f64; 2] = [0.3, -0.2];

fn unevenness_of(blocks: &[Block; 2]) -> f64 {
    let run = run(tied(blocks).step(pull(0.1)));
    let report = glue(&run);
    assert!(report.mismatch < 1e-10, "{report:?}");
    assert!(report.moment_mismatch < 1e-10, "{report:?}");
    unevenness(&run)
}

fn kinds(lower: CellKind, upper: CellKind) -> [Block; 2] {
    let [a, b] = halves(SLOPES);
    [of(lower, a), of(upper, b)]
}

#[test]
fn parallelograms_and_triangles_are_exact() {
    let all = [
        (Hexahedron, Hexahedron),
        (Hexahedron, Tetrahedron),
        (Tetrahedron, Hexahedron),
        (Wedge, Tetrahedron),
        (Hexahedron, CompositeTetrahedron),
    ];
    for (lower, upper) in all {
        let uneven = unevenness_of(&kinds(lower, upper));
        assert!(uneven < 1e-10, "{lower:?} {upper:?}: {uneven:.2e}");
    }
}

#[test]
fn other_quadrilaterals_leave_the_error_of_quadrature() {
    for upper in [Hexahedron, Tetrahedron, Wedge] {
        let [lower, of_upper] = kinds(Hexahedron, upper);
        let turned = Block {
            mesh_rotation: 15.0,
            irregularity: 0.1,
            ..lower
        };
        let uneven = unevenness_of(&[turned, of_upper]);
        assert!(uneven < 1e-8, "{upper:?}: {uneven:.2e}");
    }
}

#[test]
fn a_smaller_block_in_the_middle_stays_tied() {
    let [lower, _] = halves([0.0; 2]);
    let upper = Block {
        origin: Vec3::new(0.21, 0.17, 0.5),
        size: Vec3::new(0.55, 0.6, 0.3),
        divisions: [4, 4, 2],
        ..Block::default()
    };
    let pull = step("pull")
        .hold("lower", "zmin")
        .displace("upper", "zmax", [0.01, 0.0, 0.02]);
    let run = run(tied(&[lower, upper]).step(pull));
    let report = glue(&run);
    assert!(report.mismatch < 1e-10 && report.moment_mismatch < 1e-10);
    assert!((report.area - 0.33).abs() < 1e-12, "{}", report.area);
    let force = run.results().reaction("upper.zmax").unwrap();
    let sides = report.sides.map(|side| side.force);
    assert!((sides[1] + force).norm() < 1e-8 * force.norm());
    assert!((sides[0] - force).norm() < 1e-8 * force.norm());
}
