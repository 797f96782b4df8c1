//! The page: text for people, numbers for the viewer, and the viewer.
//!
//! ```text
//! <script type="application/json" id="results">   all but the blocks, see [`Head`]
//! <script type="text/plain" id="block-7">         a block in base64, see [`crate::pack`]
//! ```

use std::collections::BTreeMap;

use rayon::prelude::*;
use serde::Serialize;
use striae_output::summary::Summary;

use crate::{
    LIMIT, ReportError, invariants,
    pack::{self, Packed, base64},
    part::{Field, Part, parts},
    results::{Kind, Results},
};

const PAGE: &str = include_str!("../assets/page.html");
const STYLE: &str = include_str!("../assets/style.css");
const THREE: &str = include_str!("../assets/three/three.min.js");
const VIEWER: [&str; 7] = [
    include_str!("../assets/viewer/numbers.js"),
    include_str!("../assets/viewer/blocks.js"),
    include_str!("../assets/viewer/colors.js"),
    include_str!("../assets/viewer/scene.js"),
    include_str!("../assets/viewer/controls.js"),
    include_str!("../assets/viewer/history.js"),
    include_str!("../assets/viewer/tables.js"),
];

/// Header that the viewer reads.
#[derive(Serialize)]
struct Head<'a> {
    title: &'a str,
    program: &'static str,
    summary: &'a Option<Summary>,
    columns: &'a [String],
    rows: &'a [Vec<f64>],
    steps: Vec<String>,
    times: Vec<f64>,
    /// Times at which there are fields, shown or not.
    written: usize,
    parts: Vec<PartHead<'a>>,
}

/// A part with the numbers of its blocks.
#[derive(Serialize)]
struct PartHead<'a> {
    name: &'a str,
    kind: Kind,
    nodes: usize,
    triangles: usize,
    edges: usize,
    rest: usize,
    motion: usize,
    /// The part whose nodes these are, and a block with their places in it.
    follows: Option<[usize; 2]>,
    fields: Vec<FieldHead<'a>>,
}

/// An array; where it is not known at a time, there is `null`.
#[derive(Serialize)]
struct FieldHead<'a> {
    name: &'a str,
    components: usize,
    block: usize,
    predictions: String,
    /// Least number and step at every time.
    scales: Vec<Option<[f64; 2]>>,
    /// Least and largest value by view at every time.
    views: BTreeMap<&'static str, Vec<Option<[f64; 2]>>>,
    order: &'static [&'static str],
}

/// Blocks in the order of their numbers.
#[derive(Default)]
struct Blocks(Vec<Vec<u8>>);

impl Blocks {
    fn add(&mut self, bytes: Vec<u8>) -> usize {
        self.0.push(bytes);
        self.0.len() - 1
    }

    /// Letters that the blocks take on the page.
    fn length(&self) -> usize {
        let letters = |bytes: &Vec<u8>| bytes.len().div_ceil(3) * 4 + 64;
        self.0.iter().map(letters).sum()
    }
}

/// The page of results.
///
/// # Errors
/// When fields cannot be read.
pub fn page(results: &Results) -> Result<String, ReportError> {
    let times = results.times();
    let parts = parts(results, &times)?;
    let mut stride = 1;
    loop {
        let mut blocks = Blocks::default();
        let heads = parts
            .iter()
            .map(|part| part_head(part, stride, times.len(), &mut blocks));
        let head = Head {
            title: &results.title(),
            program: env!("CARGO_PKG_VERSION"),
            summary: &results.summary,
            columns: &results.history.columns,
            rows: &results.history.rows,
            steps: results.steps(),
            parts: heads.collect(),
            times: kept(times.len(), stride).map(|at| times[at]).collect(),
            written: times.len(),
        };
        let text = serde_json::to_string(&head).expect("numbers and words become JSON");
        let fixed = THREE.len() + text.len() + results.deck.as_ref().map_or(0, String::len);
        let laws: usize = results.laws.iter().map(|(_, svg)| svg.len()).sum();
        let length = fixed + laws + blocks.length() + (1 << 18);
        if length <= LIMIT || stride >= times.len() {
            return Ok(filled(results, &text, &blocks));
        }
        stride *= 2;
    }
}

/// Every so many times, and the last.
fn kept(count: usize, stride: usize) -> impl Iterator<Item = usize> {
    let last = count.saturating_sub(1);
    (0..count).filter(move |at| at % stride == 0 || *at == last)
}

fn part_head<'a>(part: &'a Part, stride: usize, count: usize, blocks: &mut Blocks) -> PartHead<'a> {
    let skin = &part.skin;
    let follows = part.follows.as_ref();
    let follows = follows.map(|(body, nodes)| [*body, blocks.add(pack::indices(nodes, 1))]);
    let packed = part
        .arrays
        .par_iter()
        .map(|field| packed(field, stride, count));
    let packed: Vec<Packed> = packed.collect();
    let rest = part
        .rest
        .iter()
        .flatten()
        .map(|coordinate| *coordinate as f32);
    PartHead {
        name: &part.name,
        kind: part.kind,
        nodes: skin.nodes.len(),
        triangles: blocks.add(pack::indices(skin.triangles.as_flattened(), 3)),
        edges: blocks.add(pack::indices(skin.edges.as_flattened(), 2)),
        rest: blocks.add(pack::reals(rest)),
        motion: part.motion,
        follows,
        fields: (part.arrays.iter().zip(packed))
            .map(|(field, packed)| field_head(field, packed, stride, count, blocks))
            .collect(),
    }
}

/// The codes of a field at the times that are kept.
fn packed(field: &Field, stride: usize, count: usize) -> Packed {
    let moments = kept(count, stride).filter_map(|at| field.times[at].as_ref());
    let known: Vec<&[u16]> = moments.map(|moment| &moment.quantised.codes[..]).collect();
    pack::codes(&known, field.components)
}

fn field_head<'a>(
    field: &'a Field,
    packed: Packed,
    stride: usize,
    count: usize,
    blocks: &mut Blocks,
) -> FieldHead<'a> {
    let moments: Vec<_> = kept(count, stride)
        .map(|at| field.times[at].as_ref())
        .collect();
    let order = invariants::views(field.components);
    let view = |(at, name): (usize, &&'static str)| {
        let extremes = moments
            .iter()
            .map(|moment| moment.and_then(|moment| moment.extremes[at]));
        (*name, extremes.collect())
    };
    let scale = |moment: &Option<&crate::part::Moment>| {
        moment.map(|moment| [moment.quantised.least, moment.quantised.step])
    };
    FieldHead {
        name: &field.name,
        components: field.components,
        block: blocks.add(packed.bytes),
        predictions: packed.predictions,
        scales: moments.iter().map(scale).collect(),
        views: order.iter().enumerate().map(view).collect(),
        order,
    }
}

/// The template with everything in its place.
fn filled(results: &Results, head: &str, blocks: &Blocks) -> String {
    let laws = results.laws.iter().map(|(name, svg)| law(name, svg));
    let blocks = blocks.0.iter().enumerate().map(|(number, bytes)| {
        format!(
            "<script type=\"text/plain\" id=\"block-{number}\">{}</script>\n",
            base64(bytes)
        )
    });
    let parts: [(&str, String); 7] = [
        ("title", escaped(&results.title())),
        ("style", STYLE.to_owned()),
        ("laws", laws.collect()),
        ("deck", escaped(results.deck.as_deref().unwrap_or_default())),
        ("results", head.replace('<', "\\u003c")),
        ("blocks", blocks.collect()),
        ("program", [&[THREE], &VIEWER[..]].concat().join("\n")),
    ];
    let mut page = String::new();
    let mut pieces = PAGE.split("{{");
    page.push_str(pieces.next().unwrap_or_default());
    for piece in pieces {
        let (name, after) = piece.split_once("}}").unwrap_or(("", piece));
        let part = parts.iter().find(|(known, _)| *known == name);
        page.push_str(part.map_or("", |(_, text)| text));
        page.push_str(after);
    }
    page
}

fn law(name: &str, svg: &str) -> String {
    let start = svg.find("<svg").unwrap_or(0);
    let name = escaped(name);
    format!(
        "<figure><figcaption>{name}</figcaption>{}</figure>\n",
        &svg[start..]
    )
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}
