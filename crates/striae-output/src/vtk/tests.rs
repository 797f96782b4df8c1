use nalgebra::Matrix3;
use proptest::prelude::*;
use striae_mesh::{CellBlock, CellKind, NodeId, Vec3};

use super::decode::{array, attribute};
use super::xml::encode;
use super::*;
use crate::OutputError;

fn ids<const N: usize>(corners: [u32; N]) -> [NodeId; N] {
    corners.map(NodeId)
}

fn cube() -> Vec<Vec3> {
    (0..8)
        .map(|i: u32| {
            Vec3::new(
                f64::from((i ^ (i >> 1)) & 1),
                f64::from((i >> 1) & 1),
                f64::from(i >> 2),
            ) / 3.0
        })
        .collect()
}

#[test]
fn every_kind_of_array_survives_bit_by_bit() {
    let points = cube();
    let cells = [CellBlock::hexahedra([ids([0, 1, 2, 3, 4, 5, 6, 7])])];
    let tensor = Matrix3::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0);
    let scalars = vec![
        0.1,
        -0.0,
        f64::NAN,
        f64::MAX,
        f64::MIN_POSITIVE,
        5e-324,
        1e300,
        f64::NEG_INFINITY,
    ];
    let grid = Grid {
        points: &points,
        cells: Cells::Blocks(&cells),
        point_arrays: vec![
            Array::new("gap <n>", Values::Scalars(scalars.clone())),
            Array::new("normal", Values::Vectors(points.clone())),
            Array::new("status", Values::Codes((0..8).collect())),
        ],
        cell_arrays: vec![
            Array::new("stress", Values::SymmetricTensors(vec![tensor])),
            Array::new("F", Values::Tensors(vec![tensor])),
            Array::new("body", Values::Integers(vec![-7])),
        ],
        time: 0.1,
    };
    let file = encode(&grid);
    let bits = |numbers: &[f64]| numbers.iter().map(|n| n.to_bits()).collect::<Vec<_>>();
    let flat: Vec<f64> = points.iter().flat_map(|p| [p.x, p.y, p.z]).collect();
    assert_eq!(bits(&array(&file, "Points").reals()), bits(&flat));
    assert_eq!(bits(&array(&file, "gap &lt;n&gt;").reals()), bits(&scalars));
    let normal = array(&file, "normal");
    assert_eq!(normal.components, 3);
    assert_eq!(bits(&normal.reals()), bits(&flat));
    assert_eq!(
        array(&file, "stress").reals(),
        [1.0, 5.0, 9.0, 2.0, 6.0, 3.0]
    );
    assert_eq!(
        array(&file, "F").reals(),
        (1..10).map(f64::from).collect::<Vec<_>>()
    );
    assert_eq!(array(&file, "body").integers(), [-7]);
    assert_eq!(
        array(&file, "status").integers(),
        (0..8).collect::<Vec<_>>()
    );
    assert_eq!(
        array(&file, "connectivity").integers(),
        (0..8).collect::<Vec<_>>()
    );
    assert_eq!(array(&file, "offsets").integers(), [8]);
    assert_eq!(array(&file, "types").integers(), [12]);
}

#[test]
fn cells_carry_the_shape_and_the_corners_of_their_kind() {
    let points = [cube(), cube()].concat();
    let nodes = |count: u32| (0..count).map(NodeId).collect();
    let blocks = CellKind::ALL.map(|kind| CellBlock {
        kind,
        nodes: nodes(kind.corner_count() as u32),
    });
    let grid = Grid {
        points: &points,
        cells: Cells::Blocks(&blocks),
        point_arrays: vec![],
        cell_arrays: vec![Array::new("block", Values::Integers(vec![0, 1, 2, 3, 4]))],
        time: 0.0,
    };
    let file = encode(&grid);
    assert_eq!(array(&file, "types").integers(), [10, 14, 13, 12, 24]);
    assert_eq!(array(&file, "offsets").integers(), [4, 9, 15, 23, 33]);
    let corners = array(&file, "connectivity").integers();
    assert_eq!(corners[4..9], [0, 1, 2, 3, 4]);
    // The first triangle of VTK's wedge looks outward.
    assert_eq!(corners[9..15], [0, 2, 1, 3, 5, 4]);
}

#[test]
fn polygons_carry_the_shape_their_corners_ask_for() {
    let points = cube();
    let polygons: Vec<Vec<NodeId>> = vec![
        ids([0, 1, 2]).into(),
        ids([0, 1, 2, 3]).into(),
        ids([0, 1, 2, 3, 4]).into(),
    ];
    let grid = Grid {
        points: &points,
        cells: Cells::Polygons(&polygons),
        point_arrays: vec![],
        cell_arrays: vec![],
        time: 0.0,
    };
    let file = encode(&grid);
    assert_eq!(array(&file, "types").integers(), [5, 9, 7]);
    assert_eq!(array(&file, "offsets").integers(), [3, 7, 12]);
}

#[test]
fn faulty_grids_are_refused_by_name() {
    let points = cube();
    let triangles = [ids([0, 1, 8])];
    let mut grid = Grid {
        points: &points,
        cells: Cells::Triangles(&triangles),
        point_arrays: vec![],
        cell_arrays: vec![],
        time: 0.0,
    };
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("faulty.vtu");
    let error = write(&path, &grid).unwrap_err();
    assert!(matches!(
        error,
        OutputError::MissingPoint {
            cell: 0,
            point: 8,
            points: 8,
            ..
        }
    ));
    grid.cells = Cells::Triangles(&[]);
    grid.point_arrays = vec![Array::new("gap", Values::Scalars(vec![0.0; 7]))];
    let error = write(&path, &grid).unwrap_err();
    assert!(matches!(
        error,
        OutputError::ArrayLength {
            expected: 8,
            found: 7,
            ..
        }
    ));
    let gap = Array::new("gap", Values::Scalars(vec![0.0; 8]));
    grid.point_arrays = vec![gap.clone(), gap];
    let error = write(&path, &grid).unwrap_err();
    assert!(matches!(error, OutputError::Duplicate { name, .. } if name == "gap"));
    assert!(!path.exists());
}

#[test]
fn a_series_is_valid_after_every_append() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("run.pvd");
    let mut series = Series::new(&path);
    for step in 1..=3 {
        let parts = ["lower & co", "upper"]
            .map(|name| (name.to_owned(), format!("run/{name}_{step}.vtu").into()));
        series
            .append(Snapshot {
                time: 0.1 * f64::from(step),
                parts: parts.into(),
            })
            .unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        let tags: Vec<&str> = text
            .lines()
            .filter(|line| line.contains("<DataSet"))
            .collect();
        assert_eq!(tags.len(), 2 * step as usize);
        let last = tags[tags.len() - 2];
        let time: f64 = attribute(last, "timestep").parse().unwrap();
        assert_eq!(time.to_bits(), (0.1 * f64::from(step)).to_bits());
        assert_eq!(attribute(last, "part"), "0");
        assert_eq!(
            attribute(last, "file"),
            format!("run/lower &amp; co_{step}.vtu")
        );
        assert!(text.trim_end().ends_with("</VTKFile>"));
    }
    assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 1);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    /// Lengths on both sides of one, two and three blocks.
    #[test]
    fn long_arrays_survive_in_blocks(length in 0_usize..70_000, seed in any::<u64>()) {
        let mut bits = seed | 1;
        let values: Vec<f64> = (0..length)
            .map(|_| {
                bits = bits.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
                (bits >> 11) as f64
            })
            .collect();
        let points = vec![Vec3::zeros(); length];
        let grid = Grid {
            points: &points,
            cells: Cells::Triangles(&[]),
            point_arrays: vec![Array::new("v", Values::Scalars(values.clone()))],
            cell_arrays: vec![],
            time: 0.0,
        };
        prop_assert_eq!(array(&encode(&grid), "v").reals(), values);
    }
}

#[test]
fn exactly_full_blocks_survive() {
    for blocks in 1..=2 {
        let values: Vec<f64> = (0..blocks * 32_768).map(f64::from).collect();
        let points = vec![Vec3::zeros(); values.len()];
        let grid = Grid {
            points: &points,
            cells: Cells::Triangles(&[]),
            point_arrays: vec![Array::new("v", Values::Scalars(values.clone()))],
            cell_arrays: vec![],
            time: 0.0,
        };
        assert_eq!(array(&encode(&grid), "v").reals(), values);
    }
}

#[test]
fn files_are_read_back() {
    let points = cube();
    let cells = [CellBlock::hexahedra([ids([0, 1, 2, 3, 4, 5, 6, 7])])];
    let names = ["gap <n> & \"m\"", "status"];
    let grid = Grid {
        points: &points,
        cells: Cells::Blocks(&cells),
        point_arrays: vec![
            Array::new(names[0], Values::Scalars((0..8).map(f64::from).collect())),
            Array::new(names[1], Values::Codes((0..8).collect())),
            Array::new("u", Values::Vectors(points.clone())),
        ],
        cell_arrays: vec![Array::new("body", Values::Integers(vec![-7]))],
        time: 0.25,
    };
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("cube.vtu");
    write(&path, &grid).unwrap();
    let stored = Stored::open(&path).unwrap();
    assert_eq!(stored.time, 0.25);
    let found: Vec<_> = stored.names().collect();
    assert_eq!(found, [(names[0], 1), (names[1], 1), ("u", 3)]);
    let expected: Vec<[f64; 3]> = points.iter().map(|p| [p.x, p.y, p.z]).collect();
    assert_eq!(stored.points(&path).unwrap(), expected);
    let read = stored.cells(&path).unwrap();
    let read: Vec<_> = read.iter().collect();
    assert_eq!(read, [(12, &[0, 1, 2, 3, 4, 5, 6, 7][..])]);
    for name in names {
        let values = stored.array(&path, name).unwrap().unwrap();
        assert_eq!(values.numbers, (0..8).map(f64::from).collect::<Vec<_>>());
    }
    assert_eq!(stored.array(&path, "body").unwrap(), None);
    let whole = std::fs::read(&path).unwrap();
    std::fs::write(&path, &whole[..whole.len() / 2]).unwrap();
    assert!(Stored::open(&path).is_err());
    // The bytes before the end of the file are those of the last array, `body`; `u` is next.
    std::fs::write(&path, &whole[..whole.len() - 100]).unwrap();
    let stored = Stored::open(&path).unwrap();
    assert!(stored.array(&path, "status").is_ok());
    let error = stored.array(&path, "u").unwrap_err().to_string();
    assert!(error.ends_with("array `u` is damaged"), "{error}");
}

#[test]
fn collections_are_read_back() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("run.pvd");
    let mut series = Series::new(&path);
    for step in 0..3 {
        let parts = ["lower & co", "upper"];
        let parts = parts.map(|name| (name.to_owned(), format!("run/{name}_{step}.vtu").into()));
        let time = 0.1 * f64::from(step);
        let parts = parts.into();
        series.append(Snapshot { time, parts }).unwrap();
    }
    assert_eq!(read_series(&path).unwrap(), series.snapshots());
}
