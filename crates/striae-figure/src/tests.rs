use proptest::prelude::*;

use super::description::*;
use super::layout::{Page, page};
use super::render::{png, svg};
use super::shape::{Anchor, Direction, Rectangle, Shape, Text, dashes};
use super::ticks::{linear, logarithmic, power_of_ten, round_below, round_words};
use super::{font, power_law, table};
use crate::FigureError;

fn number(label: &str) -> f64 {
    label.replace('−', "-").parse().unwrap()
}

/// The box of a text: left, top, right, bottom.
fn text_box(text: &Text) -> [f64; 4] {
    let wide = font::width(&text.words, text.size);
    let before = match text.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => wide / 2.0,
        Anchor::End => wide,
    };
    let (up, down) = (font::DIGIT_HEIGHT * text.size, 0.0);
    let [x, y] = text.place;
    match text.direction {
        Direction::Right => [x - before, y - up, x - before + wide, y + down],
        Direction::Up => [x - up, y + before - wide, x + down, y + before],
    }
}

fn texts(page: &Page) -> Vec<&Text> {
    let words = page.shapes.iter().filter_map(|shape| match shape {
        Shape::Text(text) => Some(text),
        _ => None,
    });
    words.collect()
}

fn busy_figure() -> Figure {
    let points: Vec<[f64; 2]> = (1..30)
        .map(|i| [f64::from(i) / 10.0, f64::from(i * i) * 1e5])
        .collect();
    let rates = vec![[0.8, 0.64], [0.4, 0.16], [0.2, 0.04], [0.1, 0.01]];
    let squares: Vec<Vec<[f64; 2]>> = (0..9)
        .map(|i| (f64::from(i % 3), f64::from(i / 3)))
        .map(|(x, y)| vec![[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]])
        .collect();
    let corners: Vec<[f64; 2]> = squares.iter().map(|square| square[0]).collect();
    let plane = Panel::plane(Axis::linear("x", "m"), Axis::linear("y", "m")).titled("map");
    Figure {
        width: Width::Page,
        columns: 2,
        panels: vec![
            Panel::new(Axis::linear("time t", "s"), Axis::linear("reaction", "N"))
                .titled("(a)")
                .with(Series::new("a name so long that it cannot stand in one row, whatever the width of the panel may be", Content::line(points.clone())))
                .with(Series::new("second", Content::dashed(points.clone())))
                .with(Series::new("third", Content::markers(points, Marker::Cross))),
            Panel::new(Axis::logarithmic("h", "m"), Axis::logarithmic("error", ""))
                .with(Series::new("rate", Content::PowerLaw { points: rates, marker: Marker::Diamond })),
            plane
                .with(Series::new("", Content::Facets {
                    values: (0..9).map(f64::from).collect(),
                    polygons: squares,
                    bar: Axis::linear("pressure", "Pa"),
                }))
                .with(Series::new("slip", Content::Arrows {
                    vectors: corners.iter().map(|c| [c[1], -c[0]]).collect(),
                    origins: corners,
                    unit: "m".into(),
                })),
            Panel::polar(Axis::linear("w", ""))
                .titled("(d)")
                .with(Series::new("ellipse", Content::line(vec![[0.0, 1.0], [1.5, 2.0], [3.0, 1.0]]))),
        ],
    }
}

#[test]
fn texts_stay_on_the_page_and_never_touch() {
    for width in [Width::Page, Width::Millimetres(240.0)] {
        let page = page(&Figure {
            width,
            ..busy_figure()
        })
        .unwrap();
        let texts = texts(&page);
        for (index, text) in texts.iter().enumerate() {
            let [left, top, right, bottom] = text_box(text);
            assert!(left >= 0.0 && top >= 0.0, "{text:?}");
            assert!(right <= page.width && bottom <= page.height, "{text:?}");
            for other in &texts[..index] {
                let box_b = text_box(other);
                let apart =
                    right <= box_b[0] || box_b[2] <= left || bottom <= box_b[1] || box_b[3] <= top;
                assert!(apart, "{text:?} on {other:?}");
            }
        }
    }
}

#[test]
fn names_and_slopes_are_in_the_legend() {
    let page = page(&busy_figure()).unwrap();
    let words: Vec<&str> = texts(&page)
        .iter()
        .map(|text| text.words.as_str())
        .collect();
    for wanted in [
        "second",
        "third",
        "rate (slope 2.00)",
        "slip (2 m)",
        "pressure [Pa]",
        "reaction [10⁷ N]",
        "270°",
    ] {
        assert!(words.contains(&wanted), "{wanted} not in {words:?}");
    }
}

#[test]
fn an_equal_aspect_keeps_squares_square() {
    let page = page(&busy_figure()).unwrap();
    let squares: Vec<&Vec<[f64; 2]>> = page
        .shapes
        .iter()
        .filter_map(|shape| match shape {
            Shape::Fill { places, .. } if places.len() == 4 => Some(places),
            _ => None,
        })
        .take(9)
        .collect();
    for square in squares {
        let side = |i: usize| {
            (0..2)
                .map(|c| (square[i][c] - square[(i + 1) % 4][c]).abs())
                .sum::<f64>()
        };
        assert!((side(0) - side(1)).abs() < 1e-9 * side(0), "{square:?}");
    }
}

#[test]
fn files_have_the_size_asked_for_and_all_the_numbers() {
    let directory = tempfile::tempdir().unwrap();
    let figure = Figure {
        width: Width::Column,
        columns: 1,
        panels: busy_figure().panels[..2].to_vec(),
    };
    figure.write(directory.path(), "busy").unwrap();
    let text = std::fs::read_to_string(directory.path().join("busy.svg")).unwrap();
    assert!(text.contains("width=\"85.0"), "{}", &text[..200]);
    let bytes = std::fs::read(directory.path().join("busy.png")).unwrap();
    let reader = png::Decoder::new(bytes.as_slice()).read_info().unwrap();
    assert_eq!(reader.info().width, 1004);
    assert_eq!(reader.info().pixel_dims.unwrap().xppu, 11_811);
    let csv = std::fs::read_to_string(directory.path().join("busy.csv")).unwrap();
    assert_eq!(csv.lines().count(), 1 + 3 * 29 + 4);
    assert!(csv.contains("\n2,,rate,1,0.4,0.16,,,\n"));
}

#[test]
fn the_bitmap_is_smooth_and_shows_the_series() {
    let panel = Panel::new(Axis::linear("x", ""), Axis::linear("y", ""))
        .with(Series::new("", Content::line(vec![[0.0, 0.0], [1.0, 1.0]])));
    let page = page(&Figure::new(Width::Column, vec![panel])).unwrap();
    let bytes = png(&page).unwrap();
    let mut reader = png::Decoder::new(bytes.as_slice()).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size()];
    reader.next_frame(&mut pixels).unwrap();
    let (mut full, mut partial) = (0, 0);
    for pixel in pixels.chunks(3) {
        let bluish = pixel[2] > pixel[0] && pixel[2].abs_diff(pixel[0]) > 30;
        full += usize::from(pixel == [0, 114, 178]);
        partial += usize::from(bluish && pixel != [0, 114, 178]);
    }
    assert!(full > 1000 && partial > 500, "{full} {partial}");
    assert!(svg(&page).unwrap().contains("#0072B2"));
}

#[test]
fn faulty_descriptions_are_refused() {
    let directory = tempfile::tempdir().unwrap();
    let refused = |panel: Panel| {
        let error = Figure::new(Width::Column, vec![panel])
            .write(directory.path(), "f")
            .unwrap_err();
        assert!(matches!(error, FigureError::Description { .. }));
        error.to_string()
    };
    let axis = || Axis::linear("x", "");
    assert!(refused(Panel::new(axis().within(1.0, 1.0), axis())).contains("from 1 to 1"));
    let log = Axis::logarithmic("h", "").within(0.0, 1.0);
    assert!(refused(Panel::new(log, axis())).contains("logarithmic"));
    let arrows = Content::Arrows {
        origins: vec![[0.0; 2]],
        vectors: vec![],
        unit: String::new(),
    };
    assert!(
        refused(Panel::plane(axis(), axis()).with(Series::new("v", arrows.clone())))
            .contains("0 vectors where 1")
    );
    assert!(refused(Panel::polar(axis()).with(Series::new("v", arrows))).contains("polar"));
    let none = Figure::new(Width::Column, vec![])
        .write(directory.path(), "f")
        .unwrap_err();
    assert!(none.to_string().contains("no panel"));
}

#[test]
fn awkward_numbers_are_drawn_without_fault() {
    for points in [
        vec![],
        vec![[0.0, 0.0]],
        vec![[f64::NAN, 1.0], [1.0, f64::INFINITY]],
        vec![[1.0, 5.0], [2.0, 5.0]],
        vec![[-1.0, -1.0], [1e-300, 1e300]],
    ] {
        for axis in [Axis::linear("a", ""), Axis::logarithmic("a", "")] {
            let panel = Panel::new(axis.clone(), axis)
                .with(Series::new("s", Content::line(points.clone())));
            let page = page(&Figure::new(Width::Column, vec![panel])).unwrap();
            let numbers = page.shapes.iter().flat_map(|shape| match shape {
                Shape::Fill { places, .. } | Shape::Stroke { places, .. } => places.concat(),
                Shape::Text(text) => text.place.to_vec(),
            });
            assert!(numbers.into_iter().all(f64::is_finite));
        }
    }
}

#[test]
fn an_axis_of_zeros_reaches_to_one() {
    let limits = Axis::linear("a", "").limits([0.0; 3].into_iter());
    assert_eq!(limits, Ok((0.0, 1.0)));
}

#[test]
fn tables_name_panel_and_series() {
    let text = table::text(&busy_figure());
    assert!(text.contains("\n3,map,slip,8,2.0,2.0,2.0,-2.0,\n"));
    assert!(text.contains("\n3,map,,4,2.0,1.0,,,4.0\n"));
}

#[test]
fn labels_are_words_for_round_numbers() {
    assert_eq!(power_of_ten(-12), "10⁻¹²");
    assert_eq!(
        [round_words(0.002), round_words(1e6), round_words(5e-9)],
        ["0.002", "10⁶", "5·10⁻⁹"]
    );
    assert_eq!(
        [round_below(3.9), round_below(0.0051), round_below(1e6)],
        [2.0, 0.005, 1e6]
    );
    let labels =
        |ticks: super::ticks::Ticks| ticks.major.into_iter().map(|t| t.1).collect::<Vec<_>>();
    assert_eq!(
        labels(linear(-0.1, 0.1, 4)),
        ["−0.10", "−0.05", "0.00", "0.05", "0.10"]
    );
    assert_eq!(labels(logarithmic(0.09, 0.9, 4)), ["0.1", "0.2", "0.5"]);
    assert_eq!(labels(logarithmic(1e-9, 1e3, 4)), ["10⁻⁸", "10⁻⁴", "10⁰"]);
}

proptest! {
    #[test]
    fn linear_ticks_are_inside_few_and_true(low in -1e3..1e3_f64, span in 1e-3..1e3_f64, power in -12..12, count in 2_usize..9) {
        let unit = 10_f64.powi(power);
        let (first, last) = (low * unit, (low + span) * unit);
        let ticks = linear(first, last, count);
        prop_assert!(ticks.major.len() <= count + 1);
        prop_assert!(ticks.major.len() + 1 >= count / 3);
        for (place, label) in &ticks.major {
            prop_assert!(*place >= first - 1e-6 * span * unit && *place <= last + 1e-6 * span * unit);
            let shown = number(label) * 10_f64.powi(ticks.exponent);
            prop_assert!((shown - place).abs() <= 1e-6 * span * unit, "{} for {}", label, place);
        }
    }

    #[test]
    fn logarithmic_ticks_are_inside_and_few(low in -12.0..6.0_f64, span in 0.4..14.0_f64, count in 3_usize..9) {
        let (first, last) = (10_f64.powf(low), 10_f64.powf(low + span));
        let ticks = logarithmic(first, last, count);
        prop_assert!(ticks.major.len() <= count + 1, "{:?}", ticks);
        let all = ticks.major.iter().map(|t| t.0).chain(ticks.minor);
        prop_assert!(all.into_iter().all(|t| t >= first * 0.999_999 && t <= last * 1.000_001));
    }

    #[test]
    fn a_power_law_is_found_again(factor in 1e-6..1e6_f64, exponent in -4.0..4.0_f64) {
        let points: Vec<[f64; 2]> = [0.8, 0.4, 0.2, 0.1].map(|x: f64| [x, factor * x.powf(exponent)]).into();
        let law = power_law(&points).unwrap();
        prop_assert!((law.exponent - exponent).abs() < 1e-9);
        prop_assert!((law.at(0.3) / (factor * 0.3_f64.powf(exponent)) - 1.0).abs() < 1e-9);
        prop_assert!(power_law(&points[..1]).is_none());
    }

    /// Sampled points of a segment are inside if and only if on the clipped part.
    #[test]
    fn clipping_keeps_what_is_inside(ends in prop::array::uniform4(-2.0..2.0_f64)) {
        let frame = Rectangle { left: -1.0, top: -0.5, width: 1.5, height: 1.2 };
        let (from, to) = ([ends[0], ends[1]], [ends[2], ends[3]]);
        let parts = frame.clip_line(&[from, to]);
        let length = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
        let kept: f64 = parts.iter().map(|part| length(part[0], part[1])).sum();
        let samples = 2000;
        let at = |i: usize| { let s = (i as f64 + 0.5) / samples as f64; [0, 1].map(|c| from[c] + s * (to[c] - from[c])) };
        let inside = (0..samples).filter(|i| frame.contains(at(*i), 0.0)).count();
        prop_assert!((kept - length(from, to) * inside as f64 / samples as f64).abs() < 5e-3);
    }

    /// Area of a clipped triangle against counting points.
    #[test]
    fn polygons_are_clipped(c in prop::array::uniform6(-2.0..2.0_f64)) {
        let frame = Rectangle { left: -1.0, top: -0.5, width: 1.5, height: 1.2 };
        let triangle = [[c[0], c[1]], [c[2], c[3]], [c[4], c[5]]];
        let clipped = frame.clip_polygon(&triangle);
        let area = |p: &[[f64; 2]]| (0..p.len()).map(|i| { let (a, b) = (p[i], p[(i + 1) % p.len()]); (a[0] * b[1] - a[1] * b[0]) / 2.0 }).sum::<f64>();
        let n = 120;
        let turn = area(&triangle).signum();
        let hits = (0..n * n).filter(|i| {
            let q = [frame.left + (f64::from(i % n) + 0.5) / f64::from(n) * frame.width, frame.top + (f64::from(i / n) + 0.5) / f64::from(n) * frame.height];
            (0..3).all(|k| turn * area(&[triangle[k], triangle[(k + 1) % 3], q]) >= 0.0)
        }).count();
        let counted = hits as f64 / f64::from(n * n) * frame.width * frame.height;
        prop_assert!((area(&clipped).abs() - counted).abs() < 0.05);
    }

    #[test]
    fn dashes_cover_their_share(length in 1.0..200.0_f64, on in 0.5..5.0_f64, off in 0.5..5.0_f64) {
        let line = [[0.0, 0.0], [length / 3.0, 0.0], [length / 3.0, 2.0 * length / 3.0]];
        let pieces = dashes(&line, [on, off]);
        let covered: f64 = pieces.iter().flat_map(|p| p.windows(2)).map(|w| (w[0][0] - w[1][0]).hypot(w[0][1] - w[1][1])).sum();
        let periods = (length / (on + off)).floor();
        let expected = periods * on + (length - periods * (on + off)).min(on);
        prop_assert!((covered - expected).abs() < 1e-9 * length.max(1.0));
    }
}
