//! Layers of a picture: surfaces coloured by a field, and transparent surfaces.

use striae_figure::color_map;

use crate::{
    ReportError, invariants,
    part::{Field, Part},
    picture::{
        Picture,
        canvas::{Canvas, Color},
        component,
        view::{View, cross, unit},
    },
    results::Kind,
};

/// Fields that are shown by default, in the order of preference.
const PREFERRED: [&str; 3] = ["pressure", "cauchy_stress", "displacement"];

/// Color of what has no field.
pub const GREY: Color = [0.80, 0.81, 0.84];

/// Values whose spread over their size is below this are equal.
const EQUAL: f64 = 1e-6;

/// Opacity of transparent surfaces.
const VEIL: f64 = 0.32;

/// All surfaces of a picture.
pub struct Layers<'a> {
    field: &'a str,
    component: &'static str,
    limits: [f64; 2],
    shown: Vec<Layer<'a>>,
    /// Surfaces without the field.
    others: Vec<Layer<'a>>,
    /// `true` if other layers are seen through it.
    veiled: bool,
}

/// A surface.
struct Layer<'a> {
    part: &'a Part,
    places: Vec<[f64; 3]>,
    values: Option<Vec<f64>>,
    /// Points that are pressed; empty where all of the surface is drawn.
    pressed: Vec<bool>,
}

impl<'a> Layers<'a> {
    /// The surfaces of parts at their only time.
    ///
    /// # Errors
    /// When the field or its component is not known.
    pub fn of(parts: &'a [Part], picture: &Picture) -> Result<Self, ReportError> {
        let field = chosen(parts, picture.field.as_deref())?;
        let is_hidden = |part: &Part| picture.hidden.contains(&part.name);
        let has = |part: &&Part| known(part, field).is_some() && !is_hidden(part);
        let on_contact = |part: &Part| part.kind == Kind::Contact;
        let only_contact = !parts.iter().any(|part| has(&part) && !on_contact(part));
        let mut shown: Vec<&Part> = parts
            .iter()
            .filter(|part| has(part) && on_contact(part) == only_contact)
            .collect();
        if only_contact {
            shown = one_side_each(&shown, parts);
        }
        let first = shown.first().and_then(|part| known(part, field));
        let Some(first) = first else {
            return Err(unknown(parts, field));
        };
        let view = component(field, first.components, picture.component.as_deref())?;
        let layer = |part: &'a Part, values| Layer {
            part,
            places: places(part, parts, picture.magnification),
            pressed: match &values {
                Some(_) if on_contact(part) => pressed(part),
                _ => Vec::new(),
            },
            values,
        };
        let others = parts
            .iter()
            .filter(|part| !on_contact(part) && !is_hidden(part));
        let others = others.filter(|part| !shown.iter().any(|other| std::ptr::eq(*other, *part)));
        Ok(Self {
            field,
            component: invariants::views(first.components)[view],
            limits: limits(&shown, field, view),
            others: others.map(|part| layer(part, None)).collect(),
            shown: shown
                .iter()
                .map(|part| layer(part, known(part, field).map(|field| values(field, view))))
                .collect(),
            veiled: only_contact,
        })
    }

    /// Name of the field.
    pub fn field(&self) -> &str {
        self.field
    }

    /// Name of its component.
    pub fn component(&self) -> &'static str {
        self.component
    }

    /// Least and largest value.
    pub fn limits(&self) -> [f64; 2] {
        self.limits
    }

    /// Places of all points.
    pub fn corners(&self) -> Vec<[f64; 3]> {
        let layers = self.shown.iter().chain(&self.others);
        layers.flat_map(|layer| layer.places.clone()).collect()
    }

    /// Draws all surfaces.
    pub fn draw(&self, view: &View, canvas: &mut Canvas) {
        for layer in &self.shown {
            layer.draw(view, canvas, self.limits);
        }
        if self.veiled {
            let mut veil = canvas.blank();
            for layer in &self.others {
                layer.draw(view, &mut veil, self.limits);
            }
            canvas.veil(&veil, VEIL);
        } else {
            for layer in &self.others {
                layer.draw(view, canvas, self.limits);
            }
        }
    }
}

impl Layer<'_> {
    fn draw(&self, view: &View, canvas: &mut Canvas, [least, largest]: [f64; 2]) {
        let seen: Vec<[f64; 3]> = self.places.iter().map(|x| view.seen(*x)).collect();
        let skin = &self.part.skin;
        let is_drawn = |points: &[u32]| {
            let mut points = points.iter();
            self.pressed.is_empty() || points.any(|&point| self.pressed[point as usize])
        };
        for triangle in skin
            .triangles
            .iter()
            .filter(|triangle| is_drawn(&triangle[..]))
        {
            let corners = triangle.map(|corner| corner as usize);
            let brightness = self.brightness(corners, view);
            let color = |shares: [f64; 3]| {
                let Some(values) = &self.values else {
                    return GREY.map(|channel| channel * brightness);
                };
                let value: f64 = (0..3).map(|i| shares[i] * values[corners[i]]).sum();
                let fraction = match largest > least {
                    true => (value - least) / (largest - least),
                    false => 0.5,
                };
                // Light changes colours less than shape needs, so that they can be read.
                let light = 0.5 + 0.5 * brightness;
                let map = color_map(if fraction.is_finite() { fraction } else { 0.0 });
                map.map(|channel| f64::from(channel) / 255.0 * light)
            };
            canvas.fill(corners.map(|corner| seen[corner]), color);
        }
        let ends = skin
            .edges
            .iter()
            .filter(|edge| is_drawn(&edge[..]))
            .map(|edge| edge.map(|end| seen[end as usize]));
        let ends: Vec<[[f64; 3]; 2]> = ends.collect();
        let darkness = darkness(&ends);
        if darkness > 0.02 {
            ends.into_iter()
                .for_each(|ends| canvas.line(ends, darkness));
        }
    }

    fn brightness(&self, corners: [usize; 3], view: &View) -> f64 {
        let [a, b, c] = corners.map(|corner| self.places[corner]);
        let side = |to: [f64; 3]| [0, 1, 2].map(|axis| to[axis] - a[axis]);
        let normal = unit(cross(side(b), side(c)));
        normal.map_or(1.0, |normal| view.brightness(normal))
    }
}

/// Points of a contact surface that are pressed; none if there are none, or their pressure is not
/// known. A whole skin would hide what touches, and has no colour where nothing does.
fn pressed(part: &Part) -> Vec<bool> {
    let Some(field) = known(part, "pressure") else {
        return Vec::new();
    };
    let pressed: Vec<bool> = values(field, 0).iter().map(|value| *value > 0.0).collect();
    match pressed.contains(&true) {
        true => pressed,
        false => Vec::new(),
    }
}

/// Darkness of edges: less if they are close to each other.
pub fn darkness(ends: &[[[f64; 3]; 2]]) -> f64 {
    let lengths = ends.iter().map(|[a, b]| (a[0] - b[0]).hypot(a[1] - b[1]));
    let mean = lengths.sum::<f64>() / ends.len().max(1) as f64;
    (0.5 * (mean - 4.0) / 20.0).clamp(0.0, 0.5)
}

/// The requested field, or the best one available.
fn chosen<'a>(parts: &'a [Part], wanted: Option<&str>) -> Result<&'a str, ReportError> {
    let names = names(parts);
    let find = |name: &str| names.iter().copied().find(|known| *known == name);
    let found = match wanted {
        Some(name) => find(name),
        None => PREFERRED.iter().find_map(|name| find(name)),
    };
    found.ok_or_else(|| unknown(parts, wanted.unwrap_or(PREFERRED[0])))
}

/// There is no such field on what is shown.
fn unknown(parts: &[Part], field: &str) -> ReportError {
    ReportError::Field {
        name: field.to_owned(),
        known: names(parts).join(", "),
    }
}

/// Names of all fields at the time.
fn names(parts: &[Part]) -> Vec<&str> {
    let fields = parts.iter().flat_map(|part| &part.arrays);
    let known = fields.filter(|field| field.times[0].is_some());
    let mut names: Vec<&str> = known.map(|field| field.name.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    names
}

/// A field of a part, where it is known.
fn known<'a>(part: &'a Part, name: &str) -> Option<&'a Field> {
    let mut fields = part.arrays.iter();
    fields.find(|field| field.name == name && field.times[0].is_some())
}

/// The smaller side of each pair, as the sides lie on each other and the larger one has nodes
/// beside the contact, to which tractions are continued.
fn one_side_each<'a>(sides: &[&'a Part], parts: &[Part]) -> Vec<&'a Part> {
    let pair = |side: &Part| {
        let body = side.follows.as_ref().map(|(body, _)| &parts[*body].name);
        let end = body.map(|body| format!("-{body}")).unwrap_or_default();
        side.name
            .strip_suffix(&end)
            .unwrap_or(&side.name)
            .to_owned()
    };
    let mut kept: Vec<&Part> = Vec::new();
    for side in sides {
        match kept.iter_mut().find(|other| pair(other) == pair(side)) {
            Some(other) if extent(side) < extent(other) => *other = side,
            Some(_) => {}
            None => kept.push(side),
        }
    }
    kept
}

/// Area of a surface at rest.
fn extent(part: &Part) -> f64 {
    let area = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|corner| part.rest[corner as usize]);
        let side = |to: [f64; 3]| [0, 1, 2].map(|axis| to[axis] - a[axis]);
        let n = cross(side(b), side(c));
        0.5 * (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt()
    };
    part.skin.triangles.iter().map(area).sum()
}

/// Least and largest value on what is shown.
fn limits(shown: &[&Part], field: &str, view: usize) -> [f64; 2] {
    let moments = shown
        .iter()
        .filter_map(|part| known(part, field)?.times[0].as_ref());
    let extremes = moments.filter_map(|moment| moment.extremes.get(view).copied().flatten());
    let both = extremes.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    let [least, largest] = both.unwrap_or([0.0, 0.0]);
    // What is equal but for the tolerance of the solution has one colour.
    if largest - least > EQUAL * least.abs().max(largest.abs()) {
        return [least, largest];
    }
    [0.5 * (least + largest); 2]
}

/// Values of a view at the nodes of the skin.
fn values(field: &Field, view: usize) -> Vec<f64> {
    let mut all = vec![0.0; invariants::views(field.components).len()];
    let points = points(field).into_iter();
    points
        .map(|point| {
            invariants::shown(&point, &mut all);
            all[view]
        })
        .collect()
}

/// Numbers of a field, point by point.
fn points(field: &Field) -> Vec<Vec<f64>> {
    let Some(moment) = &field.times[0] else {
        return Vec::new();
    };
    let codes = &moment.quantised.codes;
    let count = codes.len() / field.components;
    let number = |point: usize, c: usize| moment.quantised.number(codes[c * count + point]);
    (0..count)
        .map(|point| (0..field.components).map(|c| number(point, c)).collect())
        .collect()
}

/// Positions of the nodes of a part.
fn places(part: &Part, parts: &[Part], magnification: f64) -> Vec<[f64; 3]> {
    if let Some((body, nodes)) = &part.follows {
        let body = places(&parts[*body], &[], magnification);
        return nodes.iter().map(|node| body[*node as usize]).collect();
    }
    let way = points(&part.arrays[part.motion]);
    let place = |(rest, way): (&[f64; 3], &Vec<f64>)| {
        [0, 1, 2].map(|axis| rest[axis] + magnification * way[axis])
    };
    part.rest.iter().zip(&way).map(place).collect()
}
