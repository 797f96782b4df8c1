//! Layers of a picture: surfaces coloured by a field, and transparent surfaces.

use striae_figure::color_map;

use crate::{
    ReportError, invariants,
    part::Part,
    picture::{
        Picture,
        canvas::{Canvas, Color},
        carrier::{carriers, chosen, extremes, known, limits, places, pressed, unknown, values},
        component,
        view::{View, cross, unit},
    },
    results::Kind,
};

/// Color of what has no field.
pub const GREY: Color = [0.80, 0.81, 0.84];

/// Opacity of transparent surfaces.
const VEIL: f64 = 0.32;

/// The field that a picture shows, at whatever time.
#[derive(Clone, Debug)]
pub struct Subject {
    /// Its name.
    field: String,
    /// Name of its component.
    component: &'static str,
    /// `true` if it is shown on sides of pairs, and other surfaces are seen through.
    is_contact: bool,
}

/// All surfaces of a picture.
pub struct Layers<'a> {
    subject: Subject,
    /// Least and largest value shown, where there are any.
    extremes: Option<[f64; 2]>,
    limits: [f64; 2],
    shown: Vec<Layer<'a>>,
    /// Surfaces without the field.
    others: Vec<Layer<'a>>,
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
        let (shown, is_contact) = carriers(parts, field, picture);
        let Some(first) = shown.first().and_then(|part| known(part, field)) else {
            return Err(unknown(parts, field));
        };
        let view = component(field, first.components, picture.component.as_deref())?;
        let subject = Subject {
            field: field.to_owned(),
            component: invariants::views(first.components)[view],
            is_contact,
        };
        let extremes = extremes(&shown, field, view);
        let touching = |part: &Part| pressed(part).filter(|points| points.contains(&true));
        // Where some sides touch, whole skins of others would hide them.
        let is_touching = is_contact && shown.iter().any(|part| touching(part).is_some());
        let shown = shown
            .into_iter()
            .filter(|part| !is_touching || touching(part).is_some());
        let shown = shown.map(|part| Layer {
            pressed: touching(part).filter(|_| is_contact).unwrap_or_default(),
            ..Layer::colored(part, parts, picture, field, view)
        });
        let shown = shown.collect();
        Ok(Self::with(parts, picture, subject, extremes, shown))
    }

    /// The surfaces of parts at any time, where the subject may not be known and nothing may touch.
    ///
    /// # Errors
    /// When the component of the field is not known.
    pub fn showing(
        subject: &Subject,
        parts: &'a [Part],
        picture: &Picture,
    ) -> Result<Self, ReportError> {
        let (field, on_contact) = (subject.field.as_str(), subject.is_contact);
        let (mut carriers, is_contact) = carriers(parts, field, picture);
        if is_contact != on_contact {
            carriers.clear();
        }
        let mut view = 0;
        if let Some(first) = carriers.first().and_then(|part| known(part, field)) {
            view = component(field, first.components, picture.component.as_deref())?;
        }
        let extremes = extremes(&carriers, field, view);
        let touches = |part: &Part| pressed(part).is_none_or(|points| points.contains(&true));
        let shown = carriers
            .into_iter()
            .filter(|part| !on_contact || touches(part));
        let shown = shown.map(|part| Layer {
            pressed: pressed(part).filter(|_| on_contact).unwrap_or_default(),
            ..Layer::colored(part, parts, picture, field, view)
        });
        let shown = shown.collect();
        Ok(Self::with(parts, picture, subject.clone(), extremes, shown))
    }

    /// Surfaces that have the field, and all others.
    fn with(
        parts: &'a [Part],
        picture: &Picture,
        subject: Subject,
        extremes: Option<[f64; 2]>,
        shown: Vec<Layer<'a>>,
    ) -> Self {
        let is_shown = |part: &Part| shown.iter().any(|layer| std::ptr::eq(layer.part, part));
        let others = parts
            .iter()
            .filter(|part| part.kind != Kind::Contact && !picture.hidden.contains(&part.name))
            .filter(|part| !is_shown(part))
            .map(|part| Layer {
                part,
                places: places(part, parts, picture.magnification),
                values: None,
                pressed: Vec::new(),
            });
        let others = others.collect();
        Self {
            subject,
            extremes,
            limits: picture.range.unwrap_or_else(|| limits(extremes)),
            shown,
            others,
        }
    }

    /// The surfaces with colours that span other values.
    pub fn spanning(self, limits: [f64; 2]) -> Self {
        Self { limits, ..self }
    }

    /// The field that is shown.
    pub fn subject(&self) -> &Subject {
        &self.subject
    }

    /// Least and largest value shown, where there are any.
    pub fn extremes(&self) -> Option<[f64; 2]> {
        self.extremes
    }

    /// Name of the field.
    pub fn field(&self) -> &str {
        &self.subject.field
    }

    /// Name of its component.
    pub fn component(&self) -> &'static str {
        self.subject.component
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
        let mut others = canvas.blank();
        for layer in &self.others {
            layer.draw(view, &mut others, self.limits);
        }
        let share = match self.subject.is_contact {
            true => VEIL,
            false => 1.0,
        };
        canvas.veil(&others, share);
    }
}

impl<'a> Layer<'a> {
    /// A surface with the values of a field.
    fn colored(
        part: &'a Part,
        parts: &[Part],
        picture: &Picture,
        field: &str,
        view: usize,
    ) -> Self {
        Self {
            part,
            places: places(part, parts, picture.magnification),
            values: known(part, field).map(|field| values(field, view)),
            pressed: Vec::new(),
        }
    }

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

/// Darkness of edges: less if they are close to each other.
pub fn darkness(ends: &[[[f64; 3]; 2]]) -> f64 {
    let lengths = ends.iter().map(|[a, b]| (a[0] - b[0]).hypot(a[1] - b[1]));
    let mean = lengths.sum::<f64>() / ends.len().max(1) as f64;
    (0.5 * (mean - 4.0) / 20.0).clamp(0.0, 0.5)
}
