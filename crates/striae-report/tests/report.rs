//! Reports of small results that are made here, decoded from their pages by other means.

mod decoded;

use std::path::Path;

use decoded::Page;
use nalgebra::Matrix3;
use striae_mesh::{CellBlock, NodeId, Vec3};
use striae_output::vtk::{Array, Cells, Grid, Series, Snapshot, Values, write};
use striae_report::{
    ReportError,
    picture::{self, Picture},
    render,
};

/// Two cubes on each other, the upper face of which is a side of a pair.
const HEIGHTS: [f64; 3] = [0.0, 1.0, 2.0];

fn rest() -> Vec<Vec3> {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let places = HEIGHTS
        .iter()
        .flat_map(|z| corners.map(|[x, y]| Vec3::new(x, y, *z)));
    places.collect()
}

/// Displacements and stresses after so many increments.
fn fields(count: usize) -> (Vec<Vec3>, Vec<Matrix3<f64>>) {
    let size = count as f64;
    let u = |x: &Vec3| Vec3::new(0.01 * size * x.z, 0.0, -0.02 * size * x.z * x.z);
    let stress = |x: &Vec3| {
        let shear = 3.0 * size * x.x;
        Matrix3::new(
            -size,
            0.0,
            shear,
            0.0,
            x.y,
            0.0,
            shear,
            0.0,
            -7.0 * size * x.z,
        )
    };
    let rest = rest();
    (
        rest.iter().map(u).collect(),
        rest.iter().map(stress).collect(),
    )
}

/// Writes results at times 0 to `last`; contact from 1 on.
fn results(folder: &Path, last: usize) {
    std::fs::create_dir_all(folder.join("fields")).unwrap();
    let mut bodies = Series::new(folder.join("bodies.pvd"));
    let mut contact = Series::new(folder.join("contact.pvd"));
    let corners = |first: u32| std::array::from_fn(|at| NodeId(first + at as u32));
    let cells = [CellBlock::hexahedra([0, 4].map(corners))];
    for count in 0..=last {
        let (u, stress) = fields(count);
        let points: Vec<Vec3> = rest().iter().zip(&u).map(|(x, u)| x + u).collect();
        let time = count as f64 / 4.0;
        let file = format!("fields/column-{count:05}.vtu");
        let grid = Grid {
            points: &points,
            cells: Cells::Blocks(&cells),
            point_arrays: vec![
                Array::new("displacement", Values::Vectors(u)),
                Array::new("cauchy_stress", Values::SymmetricTensors(stress)),
            ],
            cell_arrays: vec![],
            time,
        };
        write(&folder.join(&file), &grid).unwrap();
        let parts = vec![("column".to_owned(), file.into())];
        bodies.append(Snapshot { time, parts }).unwrap();
        if count == 0 {
            continue;
        }
        let file = format!("fields/contact-top-column-{count:05}.vtu");
        let pressures = (0..4).map(|node| f64::from(node) / 3.0 + count as f64);
        let grid = Grid {
            points: &points[8..],
            cells: Cells::Quadrilaterals(&[[0, 1, 2, 3].map(NodeId)]),
            point_arrays: vec![Array::new("pressure", Values::Scalars(pressures.collect()))],
            cell_arrays: vec![],
            time,
        };
        write(&folder.join(&file), &grid).unwrap();
        let parts = vec![("top-column".to_owned(), file.into())];
        contact.append(Snapshot { time, parts }).unwrap();
    }
}

#[test]
fn numbers_of_a_page_are_those_of_the_files() {
    let folder = tempfile::tempdir().unwrap();
    results(folder.path(), 5);
    let page = Page::of(&render(folder.path()).unwrap());
    assert_eq!(page.head["times"].as_array().unwrap().len(), 6);
    let column = &page.head["parts"][0];
    assert_eq!(column["nodes"], 12, "all nodes are on the skin");
    assert_eq!(page.indices(&column["triangles"], 3).len(), 3 * 20);
    for time in 0..=5 {
        let (u, stress) = fields(time);
        for (name, numbers) in [
            (
                "displacement",
                u.iter().flat_map(|u| [u.x, u.y, u.z]).collect::<Vec<_>>(),
            ),
            (
                "cauchy_stress",
                (stress.iter())
                    .flat_map(|s| {
                        [
                            s[(0, 0)],
                            s[(1, 1)],
                            s[(2, 2)],
                            s[(0, 1)],
                            s[(1, 2)],
                            s[(0, 2)],
                        ]
                    })
                    .collect(),
            ),
        ] {
            let found = page.field(column, name, time).unwrap();
            let spread = |all: &[f64]| {
                let high = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                high - all.iter().copied().fold(f64::INFINITY, f64::min)
            };
            let bound = 0.51 / 65534.0 * spread(&numbers) + 1e-15;
            for (a, b) in found.iter().zip(&numbers) {
                assert!((a - b).abs() <= bound, "{name} at {time}: {a} {b}");
            }
        }
        let size = time as f64;
        let lengths = u.iter().map(|u| u.norm()).fold(0.0, f64::max);
        let field = decoded::field(column, "displacement");
        assert_eq!(field["views"]["magnitude"][time][1], lengths);
        let field = decoded::field(column, "cauchy_stress");
        assert_eq!(field["views"]["zz"][time][0], 0.0 - 14.0 * size);
    }
}

#[test]
fn sides_of_pairs_follow_their_bodies() {
    let folder = tempfile::tempdir().unwrap();
    results(folder.path(), 3);
    let page = Page::of(&render(folder.path()).unwrap());
    let side = &page.head["parts"][1];
    assert_eq!(side["kind"], "contact");
    assert_eq!(side["follows"][0], 0);
    assert_eq!(page.indices(&side["follows"][1], 1), [8, 9, 10, 11]);
    assert_eq!(
        page.field(side, "pressure", 0),
        None,
        "there is none before the first increment"
    );
    let found = page.field(side, "pressure", 2).unwrap();
    assert!((found[3] - 3.0).abs() < 1e-4 && (found[0] - 2.0).abs() < 1e-4);
}

#[test]
fn runs_under_way_and_odd_names_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    results(folder.path(), 1);
    let deck = "title = \"</script> & <b>\"\n[[step]]\nname = \"press\"\n";
    std::fs::write(folder.path().join("deck.toml"), deck).unwrap();
    std::fs::write(
        folder.path().join("law-sole.svg"),
        "<?xml?><svg id=\"law\"></svg>",
    )
    .unwrap();
    let text = render(folder.path()).unwrap();
    assert_eq!(text.matches("<script>").count(), 1);
    assert!(text.contains("<title>&lt;/script&gt; &amp; &lt;b&gt;</title>"));
    assert!(text.contains("<figcaption>sole</figcaption><svg id=\"law\">"));
    let page = Page::of(&text);
    assert_eq!(page.head["title"], "</script> & <b>");
    assert_eq!(page.head["steps"][0], "press");
    assert!(page.head["summary"].is_null());
}

#[test]
fn folders_without_results_and_damaged_files_are_named() {
    let folder = tempfile::tempdir().unwrap();
    assert!(matches!(
        render(folder.path()),
        Err(ReportError::Nothing(_))
    ));
    results(folder.path(), 2);
    let file = folder.path().join("fields/column-00002.vtu");
    let whole = std::fs::read(&file).unwrap();
    std::fs::write(&file, &whole[..whole.len() - 200]).unwrap();
    let error = render(folder.path()).unwrap_err().to_string();
    assert!(error.contains("column-00002.vtu"), "{error}");
}

#[test]
fn pictures_show_a_field_at_a_time_from_a_side() {
    let folder = tempfile::tempdir().unwrap();
    results(folder.path(), 3);
    let usual = Picture::default();
    let drawn = |picture: &Picture| picture::render(folder.path(), picture).unwrap();
    let first = drawn(&usual);
    assert_eq!(first, drawn(&usual));
    for other in [
        Picture {
            time: Some(0.25),
            ..usual.clone()
        },
        Picture {
            field: Some("cauchy_stress".into()),
            ..usual.clone()
        },
        Picture {
            field: Some("displacement".into()),
            ..usual.clone()
        },
        Picture {
            direction: [0.0, 1.0, 0.0],
            ..usual.clone()
        },
        Picture {
            magnification: 5.0,
            ..usual.clone()
        },
        Picture {
            hidden: vec!["column".into()],
            ..usual.clone()
        },
    ] {
        assert_ne!(first, drawn(&other), "{other:?}");
    }
    let component = |name: &str| Picture {
        field: Some("cauchy_stress".into()),
        component: Some(name.into()),
        ..usual.clone()
    };
    assert_ne!(drawn(&component("xx")), drawn(&component("zz")));
    let wrong = |picture: Picture| picture::render(folder.path(), &picture).unwrap_err();
    let unknown = wrong(Picture {
        field: Some("heat".into()),
        ..usual.clone()
    })
    .to_string();
    assert_eq!(
        unknown,
        "unknown field `heat`; known fields are cauchy_stress, displacement, motion, pressure"
    );
    assert!(
        wrong(component("ww"))
            .to_string()
            .contains("largest principal")
    );
    assert!(matches!(
        wrong(Picture {
            direction: [0.0; 3],
            ..usual
        }),
        ReportError::View
    ));
}

#[test]
fn animations_have_a_frame_a_time_one_view_and_one_colour_range() {
    let folder = tempfile::tempdir().unwrap();
    results(folder.path(), 4);
    let picture = Picture {
        width: 300,
        ..Picture::default()
    };
    let file = folder.path().join("animation.png");
    picture::animate(folder.path(), &picture, 0.2, &file).unwrap();
    let bytes = std::fs::read(&file).unwrap();
    let mut reader = png::Decoder::new(&bytes[..]).read_info().unwrap();
    assert_eq!(reader.info().animation_control().unwrap().num_frames, 5);
    let [width, height] = [reader.info().width, reader.info().height].map(|side| side as usize);
    let mut canvas = vec![[255_u8; 3]; width * height];
    let mut frames = Vec::new();
    for _ in 0..5 {
        let mut buffer = vec![0; reader.output_buffer_size()];
        reader.next_frame(&mut buffer).unwrap();
        let control = *reader.info().frame_control().unwrap();
        assert_eq!(control.delay_num, if frames.len() == 4 { 100 } else { 20 });
        let [left, top, columns, rows] = [
            control.x_offset,
            control.y_offset,
            control.width,
            control.height,
        ]
        .map(|side| side as usize);
        for at in 0..columns * rows {
            let to = (top + at / columns) * width + left + at % columns;
            canvas[to] = [buffer[3 * at], buffer[3 * at + 1], buffer[3 * at + 2]];
        }
        frames.push(canvas.clone());
    }
    // The bar and its numbers stand still; what is shown moves.
    for frame in &frames[1..] {
        assert_ne!(frame, &frames[0]);
        let bar = (width - width / 8)..width;
        for (row, column) in (0..height).flat_map(|row| bar.clone().map(move |c| (row, c))) {
            let at = row * width + column;
            assert_eq!(frame[at], frames[0][at]);
        }
    }
    // The colours span all times: the largest pressure of the first increment is not the brightest.
    let brightest = |frame: &[[u8; 3]]| {
        let room = frame
            .chunks_exact(width)
            .flat_map(|row| &row[..width - width / 8]);
        room.map(|dot| i32::from(dot[0]) - i32::from(dot[2])).max()
    };
    assert!(brightest(&frames[1]) < brightest(&frames[4]));
    let still = picture::render(
        folder.path(),
        &Picture {
            range: Some([1.0, 5.0]),
            ..picture.clone()
        },
    );
    let mut still = still.unwrap();
    assert_eq!(still.size()[0], width);
    let bar = [width - width / 8 + 2, still.size()[1] / 2];
    assert_eq!(*still.dot(bar), frames[4][height / 2 * width + bar[0]]);

    let gif = folder.path().join("animation.gif");
    picture::animate(folder.path(), &picture, 0.2, &gif).unwrap();
    assert!(std::fs::read(&gif).unwrap().starts_with(b"GIF89a"));
    let film = folder.path().join("film.mp4");
    let refused = picture::animate(folder.path(), &picture, 0.2, &film).unwrap_err();
    assert!(
        refused
            .to_string()
            .ends_with("ends in .gif or .png; choose one of these")
    );
    let unknown = Picture {
        field: Some("heat".into()),
        ..picture
    };
    picture::animate(folder.path(), &unknown, 0.2, &folder.path().join("no.gif")).unwrap_err();
    assert!(!film.exists() && !folder.path().join("no.gif").exists());
}
