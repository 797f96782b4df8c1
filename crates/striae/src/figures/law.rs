//! Slip surfaces of friction laws, and the angle between slip and traction.
//!
//! The slip surface is `|tau|/varpi` over the direction of `-tau`; beside it stands the
//! angle between slip and `-tau`, or friction itself where it opposes slip, over the
//! direction of slip. Both directions count from `e`, see [`striae_law::friction`].

use striae_figure::{Axis, Content, Figure, Panel, Series, Width};
use striae_files::Stems;
use striae_law::friction::{Analysis, Friction, Law, SlipSample};
use striae_model::Model;

/// Points of a slip surface that is drawn.
pub const SAMPLES: usize = 720;

/// Points of a curve of coefficients.
const POINTS: u32 = 500;

/// A friction of a model.
pub struct Named<'a> {
    /// Place where it holds, in words.
    pub title: String,
    /// Name of its pair, and of the step that changes it.
    pub file: String,
    /// The friction.
    pub friction: &'a Friction,
}

/// The frictions of the pairs, and those that steps change them to.
pub fn frictions(model: &Model) -> impl Iterator<Item = Named<'_>> {
    let mut stems = Stems::default();
    let first = model.pairs.iter().map(|pair| {
        let title = format!("pair `{}`", pair.name);
        (title, pair.name.clone(), &pair.friction)
    });
    let later = model.steps.iter().flat_map(|step| {
        step.frictions.iter().map(|(pair, friction)| {
            let pair = &model.pairs[pair.0].name;
            let title = format!("pair `{pair}` from step `{}`", step.name);
            (title, format!("{pair}-{}", step.name), friction)
        })
    });
    first
        .chain(later)
        .map(move |(title, name, friction)| Named {
            title,
            file: stems.take(&name),
            friction,
        })
}

/// Slip surfaces and friction of a law, for textures at the angles that were analysed.
pub fn figure(friction: &Friction, analyses: &[Analysis]) -> Figure {
    drawn(friction, analyses, 1.0, "ϖ")
}

/// Slip surfaces and friction scaled by the static coefficient of friction: `|tau|/p` under
/// pressures at which no cap on the shear stress is reached.
pub fn coefficients(friction: &Friction, analyses: &[Analysis]) -> Figure {
    drawn(friction, analyses, friction.coefficient().at_rest(), "p")
}

/// Coefficients of friction over the pressure at rest, and over slip rate, in steady slip if they
/// depend on a state, and accumulated slip at the pressure at which they are the stated ones; `None` where they depend on none of them.
pub fn dependence(friction: &Friction) -> Option<Figure> {
    let coefficient = friction.coefficient();
    let (mu, by_pressure) = (coefficient.at_rest(), coefficient.by_pressure());
    let curve = |last: f64, value: &dyn Fn(f64) -> f64| curve(friction, last, value);
    let mut panels = Vec::new();
    if let Some(last) = by_pressure.scale() {
        let capped = |p: f64| friction.cap(p, 0.0) / p;
        let panel = Panel::new(Axis::linear("p", ""), Axis::linear("ϖ / p at rest", ""));
        panels.push(panel.with(curve(last, &capped)).titled("pressure"));
    }
    if let Some(last) = coefficient.by_rate().scale() {
        let at_rate = |v: f64| coefficient.at_slip_rate(v);
        let panel = Panel::new(Axis::linear("v", ""), Axis::linear("μ R(v)", ""));
        panels.push(panel.with(curve(last, &at_rate)).titled("slip rate"));
    }
    if let Some(law) = coefficient.by_state().constants() {
        let at_rate = |v: f64| coefficient.at_slip_rate(v);
        let panel = Panel::new(Axis::linear("v", ""), Axis::linear("μ(v, D/v)", ""));
        let curve = curve(100.0 * law.slip_rate, &at_rate);
        panels.push(panel.with(curve).titled("slip rate, steady"));
    }
    if let Some(law) = coefficient.by_state().of_healing() {
        let at_rate = |v: f64| coefficient.at_slip_rate(v);
        let panel = Panel::new(Axis::linear("v", ""), Axis::linear("μ H", ""));
        let curve = curve(20.0 * law.slip_distance / law.healing_time, &at_rate);
        panels.push(panel.with(curve).titled("slip rate, steady"));
        let rested = |t: f64| mu * law.factor(law.state_after(0.0, 0.0, t));
        let panel = Panel::new(Axis::linear("t", ""), Axis::linear("μ H", ""));
        let curve = self::curve(friction, 10.0 * law.healing_time, &rested);
        panels.push(panel.with(curve).titled("time at rest"));
    }
    if let Some(last) = coefficient.by_slip().scale() {
        let after = |s: f64| mu * coefficient.by_slip().at(s);
        let panel = Panel::new(Axis::linear("s", ""), Axis::linear("μ W(s)", ""));
        panels.push(panel.with(curve(last, &after)).titled("accumulated slip"));
    }
    (mu > 0.0 && !panels.is_empty()).then(|| Figure::new(Width::Page, panels))
}

fn curve(friction: &Friction, last: f64, value: &dyn Fn(f64) -> f64) -> Series {
    let points = (1..=POINTS).map(|i| last * f64::from(i) / f64::from(POINTS));
    let points = points.map(|x| [x, value(x)]).collect();
    Series::new(friction.law().name(), Content::line(points))
}

/// Slip surfaces and friction times `mu`, over what is called `unit`.
fn drawn(friction: &Friction, analyses: &[Analysis], mu: f64, unit: &str) -> Figure {
    let curve = |analysis: &Analysis| Curve {
        name: match friction.law() {
            Law::TwoTextures(_) => format!("θ = {}°", degrees(analysis.theta)),
            law => law.name().to_owned(),
        },
        samples: (analysis.samples.iter())
            .map(|sample| SlipSample {
                traction: sample.traction * mu,
                ..*sample
            })
            .collect(),
    };
    let curves: Vec<Curve> = analyses.iter().map(curve).collect();
    let sizes = analyses.iter().map(|analysis| analysis.extremes.traction);
    let largest = mu * sizes.fold(0.0, f64::max);
    let opposing = analyses
        .iter()
        .all(|analysis| analysis.extremes.deviation == 0.0);
    let second = if opposing {
        opposing_panel(&curves, mu, unit).titled("friction against slip")
    } else {
        deviation_panel(&curves).titled("slip and traction")
    };
    let panels = vec![
        polar_panel(&curves, largest, unit).titled("slip surface"),
        second,
    ];
    Figure::new(Width::Page, panels)
}

/// Samples of a slip surface under a name.
pub struct Curve {
    /// Name in the legend.
    pub name: String,
    /// The samples, once around.
    pub samples: Vec<SlipSample>,
}

/// Polar panel of slip surfaces up to `largest`: `|tau|/varpi` over the direction of `-tau`.
pub fn slip_surface_panel(curves: &[Curve], largest: f64) -> Panel {
    polar_panel(curves, largest, "ϖ")
}

fn polar_panel(curves: &[Curve], largest: f64, unit: &str) -> Panel {
    let label = format!("|τ| / {unit} over the direction of −τ");
    let radius = Axis::linear(label, "").within(0.0, 1.05 * largest);
    let series = curves.iter().map(|curve| {
        let closed = curve.samples.iter().chain(curve.samples.first());
        let points = closed.map(|sample| {
            let w = sample.traction;
            [w.y.atan2(w.x), w.norm()]
        });
        Series::new(&curve.name, Content::line(points.collect()))
    });
    series.fold(Panel::polar(radius), Panel::with)
}

/// Panel of the angle from slip to `-tau` over the direction of slip, in degrees.
pub fn deviation_panel(curves: &[Curve]) -> Panel {
    let y = Axis::linear("angle from slip to −τ", "°");
    let series = curves.iter().map(|curve| {
        let deviation = |sample: &SlipSample| sample.deviation.to_degrees();
        Series::new(&curve.name, over_slip(&curve.samples, deviation))
    });
    series.fold(Panel::new(slip_axis(), y), Panel::with)
}

/// Panel of friction against slip over the direction of slip.
fn opposing_panel(curves: &[Curve], mu: f64, unit: &str) -> Panel {
    let label = format!("−τ · d / {unit}");
    let y = Axis::linear(label, "").within(0.0, 1.05 * mu);
    let series = curves.iter().map(|curve| {
        let against = over_slip(&curve.samples, SlipSample::dissipation);
        Series::new(&curve.name, against)
    });
    series.fold(Panel::new(slip_axis(), y), Panel::with)
}

/// Axis of the direction of slip, in degrees from `e`.
pub fn slip_axis() -> Axis {
    Axis::linear("direction of slip: 0 across, ±90 along", "°").within(-180.0, 180.0)
}

/// A value of samples over their direction of slip, as a line along [`slip_axis`].
pub fn over_slip(samples: &[SlipSample], value: impl Fn(&SlipSample) -> f64) -> Content {
    let angle = |sample: &SlipSample| sample.slip.y.atan2(sample.slip.x).to_degrees();
    let points = samples.iter().map(|sample| [angle(sample), value(sample)]);
    let mut points: Vec<[f64; 2]> = points.collect();
    points.sort_by(|one, other| one[0].total_cmp(&other[0]));
    // Half a turn is one end of the line; it is the other one, too.
    if let Some(&[end, value]) = points.last()
        && end > 180.0 - 1e-6
    {
        points.insert(0, [end - 360.0, value]);
    }
    Content::line(points)
}

/// Degrees without the last digits that come of the conversion to radians.
pub fn degrees(angle: f64) -> f64 {
    (angle.to_degrees() * 1e9).round() / 1e9
}
