//! Guarantees of the choice of roles, over random meshes and overlaps.
//!
//! ```text
//! gap rows restricted to the nodes' own normals: 1 - E,  ||E||_inf <= 1/2,  ||(1 - E)^-1|| <= 2
//! tractions: p_t = Z p_k,  Z >= 0,  Z 1 = 1
//! ```

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use striae_contact::{
    configuration::Configuration,
    pair::{Balance, ContactPair, Geometry, Side},
    placement::Placement,
    selection::{Partner, Role, Selection},
};
use striae_law::friction::Friction;
use striae_mesh::{Mesh, Vec3, generate::Block};
use striae_surface::topology::Surface;

#[derive(Clone, Debug)]
struct Overlap {
    divisions: [[usize; 2]; 2],
    origin: [f64; 2],
    size: [f64; 2],
    irregularity: [f64; 2],
    mesh_rotation: f64,
    seed: u64,
    was_kinematic: bool,
}

fn overlaps() -> impl Strategy<Value = Overlap> {
    let divisions = || [1..8_usize, 1..8_usize];
    // Round origins and sizes make edges and nodes coincide now and then.
    let round = |low: i32, high: i32| (low..high).prop_map(|tenths| f64::from(tenths) / 12.0);
    (
        [divisions(), divisions()],
        [round(-6, 9), round(-6, 9)],
        [round(4, 18), round(4, 18)],
        [
            prop_oneof![Just(0.0), 0.0..0.25_f64],
            prop_oneof![Just(0.0), 0.0..0.25_f64],
        ],
        prop_oneof![Just(0.0), 0.0..20.0_f64],
        0..1000_u64,
        any::<bool>(),
    )
        .prop_map(
            |(divisions, origin, size, irregularity, mesh_rotation, seed, was_kinematic)| Overlap {
                divisions,
                origin,
                size,
                irregularity,
                mesh_rotation,
                seed,
                was_kinematic,
            },
        )
}

fn side(mesh: &Mesh, set: &str, rank: usize) -> (Side, Vec<Vec3>) {
    let faces = mesh.facet_sets.get(set).unwrap();
    let facets: Vec<_> = faces.iter().map(|&face| mesh.face_nodes(face)).collect();
    let surface = Surface::new(&facets);
    let x = surface
        .nodes()
        .iter()
        .map(|n| mesh.positions[n.index()])
        .collect();
    let side = Side {
        geometry: Geometry::Deformable(surface),
        stiffness: 1.0,
        texture: None,
        rank,
    };
    (side, x)
}

/// A pair of flat surfaces on each other and the positions of their nodes.
fn flat(case: &Overlap) -> (ContactPair, [Vec<Vec3>; 2]) {
    let [lower, upper] = [0, 1].map(|at| {
        let [nx, ny] = case.divisions[at];
        let block = Block {
            origin: [
                Vec3::zeros(),
                Vec3::new(case.origin[0], case.origin[1], 1.0),
            ][at],
            size: [
                Vec3::repeat(1.0),
                Vec3::new(case.size[0], case.size[1], 1.0),
            ][at],
            divisions: [nx, ny, 1],
            irregularity: case.irregularity[at],
            mesh_rotation: [0.0, case.mesh_rotation][at],
            seed: case.seed + at as u64,
            ..Block::default()
        };
        block.mesh().unwrap()
    });
    let ((a, x_a), (b, x_b)) = (side(&lower, "zmax", 0), side(&upper, "zmin", 1));
    let pair = ContactPair {
        name: "pair".to_owned(),
        sides: [a, b],
        friction: Friction::frictionless(),
        balance: Balance::Resultants,
        search_distance: None,
    };
    (pair, [x_a, x_b])
}

/// Numbers of the nodes in the order of the sides.
struct Numbers([usize; 2]);

impl Numbers {
    fn of(&self, side: usize, node: u32) -> usize {
        side * self.0[0] + node as usize
    }

    fn count(&self) -> usize {
        self.0[0] + self.0[1]
    }
}

fn roles(selection: &Selection) -> Vec<(usize, u32, &Role)> {
    (0..2)
        .flat_map(|side| {
            let of_side = selection.roles[side].iter().enumerate();
            of_side.map(move |(node, role)| (side, node as u32, role))
        })
        .collect()
}

fn check(case: &Overlap) -> Result<(), TestCaseError> {
    let (pair, x) = flat(case);
    let numbers = Numbers([x[0].len(), x[1].len()]);
    let configuration = Configuration::new(&pair, x.clone(), Placement::at_rest());
    let mut before = [0, 1].map(|side| vec![false; x[side].len()]);
    if case.was_kinematic {
        // Roles of a configuration that has since been left.
        let moved = [
            x[0].clone(),
            x[1].iter()
                .map(|x| x + Vec3::new(0.07, 0.05, 0.0))
                .collect(),
        ];
        let there = Configuration::new(&pair, moved, Placement::at_rest());
        before = Selection::new(&there, &before).kinematic();
    }
    let selection = Selection::new(&configuration, &before);
    gap_rows_are_regular(&selection, &numbers)?;
    tractions_are_means(&selection, &numbers)
}

fn gap_rows_are_regular(selection: &Selection, numbers: &Numbers) -> Result<(), TestCaseError> {
    let count = numbers.count();
    let mut rows = DMatrix::<f64>::identity(count, count);
    for (side, node, role) in roles(selection) {
        if let Role::Kinematic(Partner::Corners(corners, weights)) = role {
            let row = numbers.of(side, node);
            let mut sum = 0.0;
            for (corner, weight) in corners.iter().zip(weights) {
                if matches!(
                    selection.roles[1 - side][*corner as usize],
                    Role::Kinematic(_)
                ) {
                    rows[(row, numbers.of(1 - side, *corner))] += weight;
                    sum += weight.abs();
                }
            }
            prop_assert!(sum <= 0.5 + 1e-8, "row of {side}, {node} sums to {sum}");
        }
    }
    let inverse = rows.try_inverse().unwrap();
    let largest = inverse
        .row_iter()
        .map(|row| row.iter().map(|v| v.abs()).sum::<f64>());
    prop_assert!(largest.fold(0.0, f64::max) <= 2.0 + 1e-6);
    Ok(())
}

fn tractions_are_means(selection: &Selection, numbers: &Numbers) -> Result<(), TestCaseError> {
    let count = numbers.count();
    let mut transfer = DMatrix::<f64>::identity(count, count);
    let mut kinematic = Vec::new();
    let mut carrying = Vec::new();
    for (side, node, role) in roles(selection) {
        let row = numbers.of(side, node);
        match role {
            Role::Idle => continue,
            Role::Kinematic(_) => kinematic.push(row),
            Role::Traction(Partner::Corners(corners, weights)) => {
                for (corner, weight) in corners.iter().zip(weights) {
                    transfer[(row, numbers.of(1 - side, *corner))] -= weight;
                }
            }
            Role::Extended(leaders) => {
                for leader in leaders {
                    transfer[(row, numbers.of(leader.side, leader.node))] -=
                        1.0 / leaders.len() as f64;
                }
            }
            Role::Traction(Partner::Rigid(_)) => prop_assert!(false, "a rigid partner"),
        }
        carrying.push(row);
    }
    if carrying.is_empty() {
        return Ok(());
    }
    prop_assert!(!kinematic.is_empty(), "tractions without a kinematic node");
    let singular_values = transfer.clone().singular_values();
    prop_assert!(
        singular_values.min() > 1e-6,
        "singular transfer: {}",
        singular_values.min()
    );
    let solver = transfer.lu();
    let mut sum = DVector::<f64>::zeros(count);
    for row in &kinematic {
        let mut unit = DVector::zeros(count);
        unit[*row] = 1.0;
        let column = solver.solve(&unit).unwrap();
        prop_assert!(column.min() > -1e-7, "a negative share {}", column.min());
        sum += column;
    }
    for row in carrying {
        prop_assert!(
            (sum[row] - 1.0).abs() < 1e-9,
            "shares of {row} sum to {}",
            sum[row]
        );
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn gaps_are_regular_and_tractions_are_means(case in overlaps()) {
        check(&case)?;
    }
}
