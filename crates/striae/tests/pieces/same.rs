//! Comparison of the content of two folders.

use std::path::Path;

use striae::output::{
    history::Table,
    vtk::{Stored, read_series},
};

/// Largest difference of two numbers, relative to the largest one of their kind.
const CLOSE: f64 = 1e-8;

fn assert_near(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let size = expected
        .iter()
        .fold(0.0_f64, |most, value| most.max(value.abs()));
    for (at, (found, expected)) in found.iter().zip(expected).enumerate() {
        let away = (found - expected).abs();
        assert!(
            away <= CLOSE * size.max(1e-3),
            "{what} {at}: {found} for {expected}"
        );
    }
}

/// Fields of bodies and contact surfaces, node by node, of the last increment.
pub fn assert_same_fields(found: &Path, expected: &Path) {
    for name in ["bodies.pvd", "contact.pvd"] {
        let series = [found, expected].map(|folder| read_series(&folder.join(name)).unwrap());
        assert_eq!(series[0].len(), series[1].len(), "{name}");
        for (one, other) in series[0].iter().zip(&series[1]) {
            assert!((one.time - other.time).abs() < 1e-12);
            for (one, other) in one.parts.iter().zip(&other.parts) {
                assert_eq!(one.0, other.0);
                assert_same_grid(&found.join(&one.1), &expected.join(&other.1));
            }
        }
    }
}

fn assert_same_grid(found: &Path, expected: &Path) {
    let paths = [found, expected];
    let [one, other] = paths.map(|path| Stored::open(path).unwrap());
    let [x, y] = [(&one, found), (&other, expected)].map(|(stored, path)| {
        let points = stored.points(path).unwrap();
        points.concat()
    });
    assert_near(&x, &y, "points");
    assert_eq!(one.cells(found).unwrap(), other.cells(expected).unwrap());
    let [names, known] = [&one, &other].map(|stored| {
        let names = stored.names().map(|(name, _)| name.to_owned());
        names.collect::<Vec<_>>()
    });
    assert_eq!(names, known);
    for name in names {
        let values = one.array(found, &name).unwrap().unwrap();
        let wanted = other.array(expected, &name).unwrap().unwrap();
        assert_near(&values.numbers, &wanted.numbers, &name);
    }
    let memory = "equivalent_plastic_strain";
    let values = one.cell_array(found, memory).unwrap();
    let wanted = other.cell_array(expected, memory).unwrap();
    assert_eq!(values.is_some(), wanted.is_some());
    if let (Some(values), Some(wanted)) = (values, wanted) {
        assert_near(&values.numbers, &wanted.numbers, memory);
    }
}

pub fn assert_same_tables(found: &Path, expected: &Path) {
    for name in ["history.csv", "probes.csv", "sections.csv"] {
        let [one, other] = [found, expected].map(|folder| Table::read(&folder.join(name)).unwrap());
        assert_eq!(one.columns, other.columns);
        for column in &one.columns {
            // Iterations differ by one at most, and what is left of energies is round-off.
            if column != "iterations" {
                let values = [&one, &other].map(|table| table.column(column).unwrap());
                assert_near(&values[0], &values[1], &format!("{name}: {column}"));
            }
        }
    }
}
