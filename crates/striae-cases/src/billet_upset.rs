//! `billet-upset`: a metal billet between plates, with and without friction.
//!
//! Without friction the billet stays a cylinder. With the logarithmic strain `e = ln(h0/h)`
//! and the plastic strain `p`, the force is in closed form
//!
//! ```text
//! F = Y(p) A0 h0/h ,   E (e - p) = Y(p)
//! ```
//!
//! `A0` the area as meshed. With friction the slab method has the pressure
//! `p(r) = Y exp(2 mu (R - r)/h)`, the friction hill, with the mean
//!
//! ```text
//! p/Y = 2 (exp x - 1 - x)/x^2 = 1 + x/3 + x^2/12 + ... ,   x = 2 mu R/h
//! ```

use striae_figure::{Axis, Color, Content, Figure, Marker, Panel, Series, Width};
use striae_law::friction::Friction;
use striae_mesh::Vec3;

use super::study::{Extent, Run, Study};
use crate::failure::Failure;

const DECKS: [(&str, &str); 2] = decks!("billet-upset": "upset", "hill");
/// Radius and half of the height, mm.
const RADIUS: f64 = 10.0;
const HEIGHT: f64 = 10.0;
const YOUNGS_MODULUS: f64 = 70e3;
/// Yield stress over plastic strain in `upset`.
const YIELD: [[f64; 2]; 8] = [
    [0.0, 59.2],
    [0.01, 81.6],
    [0.03, 101.7],
    [0.07, 120.4],
    [0.15, 140.3],
    [0.3, 161.1],
    [0.6, 185.1],
    [1.0, 205.0],
];
/// Yield stress and its slope in `hill`, and the share of the height by which it is upset.
const IDEAL: [f64; 2] = [100.0, 1.0];
const HILL: f64 = 0.05;
/// Half heights of the discs in `hill` with elements along them.
const DISCS: [(f64, usize); 3] = [(10.0, 6), (5.0, 3), (2.5, 2)];

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let quick = study.extent == Extent::Quick;
    let divisions = if quick { [2, 2, 4] } else { [3, 3, 6] };
    let coefficients: &[f64] = if quick {
        &[0.0, 0.1]
    } else {
        &[0.0, 0.05, 0.1]
    };
    let mut upset = Vec::new();
    for &mu in coefficients {
        upset.push(upset_with(study, mu, divisions)?);
    }
    let (smooth, rough) = (&upset[0], &upset[upset.len() - 1]);
    study.measured("smooth.force", smooth.force_error());
    study.measured("smooth.barrel", smooth.barrel());
    study.measured("rough.barrel", rough.barrel());
    study.measured("rough.pressure", rough.pressure_over_slab());
    study.measured("rough.volume", rough.volume());
    study.measured("rough.roundness", rough.roundness());
    let imbalance = upset.iter().map(Upset::imbalance);
    study.measured("energy.imbalance", imbalance.fold(0.0, f64::max));
    if quick {
        study
            .left_out
            .extend(["refined.force", "refined.radius", "barrels"]);
    } else {
        let growth = upset[1].barrel() / rough.barrel();
        study.measured("barrels", growth);
        let fine = upset_with(study, 0.1, [6, 6, 12])?;
        let over = |of: fn(&Upset) -> f64| of(rough) / of(&fine) - 1.0;
        study.measured("refined.force", over(Upset::mean_pressure));
        study.measured("refined.radius", over(Upset::belly));
    }
    let hill = hill(study, quick)?;
    let off = hill
        .iter()
        .map(|disc| (disc.pressure / disc.known - 1.0).abs());
    study.measured("hill.error", off.fold(0.0, f64::max));
    let thinnest = hill.last().map_or(f64::NAN, |disc| disc.pressure);
    study.measured("hill.thinnest", thinnest);
    draw(study, &upset, &hill)
}

/// A billet that was upset with hardening.
struct Upset {
    mu: f64,
    /// Elements around a quarter.
    around: usize,
    run: Run,
}

fn upset_with(study: &mut Study, mu: f64, divisions: [usize; 3]) -> Result<Upset, Failure> {
    let (file, text) = DECKS[0];
    let meshed = format!("divisions = {divisions:?}");
    let mut deck = study.variant(file, text, &[["divisions = [3, 3, 6]", &meshed]])?;
    deck.model.pairs[0].friction = Friction::coulomb(mu).expect("a coefficient of friction");
    let name = match divisions[0] {
        6 => format!("upset-{mu}-fine"),
        _ => format!("upset-{mu}"),
    };
    Ok(Upset {
        mu,
        around: 2 * divisions[0],
        run: study.run(&name, deck)?,
    })
}

/// Yield stress of `upset`.
fn yield_stress(strain: f64) -> f64 {
    let pieces = YIELD.windows(2);
    let mut pieces = pieces.filter(|piece| strain <= piece[1][0]);
    let Some([[p0, y0], [p1, y1]]) = pieces.next().map(|piece| [piece[0], piece[1]]) else {
        return YIELD[YIELD.len() - 1][1];
    };
    y0 + (y1 - y0) * (strain - p0) / (p1 - p0)
}

/// Kirchhoff stress at a logarithmic strain under monotonous uniaxial stress.
fn flow_stress(strain: f64) -> f64 {
    let (mut low, mut high) = (0.0, strain);
    if YOUNGS_MODULUS * strain <= yield_stress(0.0) {
        return YOUNGS_MODULUS * strain;
    }
    for _ in 0..200 {
        let plastic = 0.5 * (low + high);
        if YOUNGS_MODULUS * (strain - plastic) > yield_stress(plastic) {
            low = plastic;
        } else {
            high = plastic;
        }
    }
    yield_stress(low)
}

/// Mean pressure of the slab method over the yield stress, `x = 2 mu R/h`.
fn slab(x: f64) -> f64 {
    match x {
        0.0 => 1.0,
        x => 2.0 * (x.exp_m1() - x) / (x * x),
    }
}

/// Area of the whole section as meshed.
fn meshed_area(around: usize) -> f64 {
    let corners = 4.0 * around as f64;
    0.5 * corners * RADIUS.powi(2) * (std::f64::consts::TAU / corners).sin()
}

impl Upset {
    /// Height over that at rest and force of the whole billet, by increment.
    fn forces(&self) -> Vec<[f64; 2]> {
        let heights = self.run.column("displacement.plate.z");
        let forces = self.run.column("pair.face.resultant_a.z");
        let rows = heights.into_iter().zip(forces);
        rows.map(|(way, force)| [1.0 + way / HEIGHT, -4.0 * force])
            .collect()
    }

    /// Largest relative difference from the closed form of a billet without friction.
    fn force_error(&self) -> f64 {
        let area = meshed_area(self.around);
        let errors = self.forces().into_iter().map(|[height, force]| {
            let known = flow_stress(-height.ln()) * area / height;
            (force / known - 1.0).abs()
        });
        errors.fold(0.0, f64::max)
    }

    /// Force at the end over the mean section and the yield stress there.
    fn mean_pressure(&self) -> f64 {
        let last = self.forces().pop().unwrap_or([f64::NAN; 2]);
        let [height, force] = last;
        force * height / meshed_area(self.around) / flow_stress(-height.ln())
    }

    fn pressure_over_slab(&self) -> f64 {
        let height = self.forces().pop().map_or(f64::NAN, |[height, _]| height);
        let radius = RADIUS / height.sqrt();
        self.mean_pressure() / slab(self.mu * radius / (HEIGHT * height))
    }

    /// Initial and final positions of the nodes of a set.
    fn places(&self, set: &str) -> Vec<(Vec3, Vec3)> {
        let (problem, state) = (&self.run.finished.problem, &self.run.finished.state);
        let nodes = problem.model.bodies[0].mesh.node_sets.get(set);
        let nodes = problem.nodes(0, nodes.unwrap_or_default());
        let places = nodes.into_iter();
        places
            .map(|node| (problem.reference[node], state.positions[node]))
            .collect()
    }

    /// Radii of the side at a height of rest.
    fn radii(&self, height: f64) -> Vec<f64> {
        let side = self.places("side").into_iter();
        let at = side.filter(|(rest, _)| (rest.z - height).abs() < 1e-9);
        at.map(|(_, x)| x.xy().norm()).collect()
    }

    /// Largest radius, in the middle.
    fn belly(&self) -> f64 {
        self.radii(0.0).into_iter().fold(0.0, f64::max)
    }

    /// Radius in the middle over that of the face, less 1.
    fn barrel(&self) -> f64 {
        let face = self.radii(HEIGHT).into_iter().fold(0.0, f64::max);
        self.belly() / face - 1.0
    }

    /// Deviation of the middle from roundness: range of its radii over the largest.
    fn roundness(&self) -> f64 {
        let least = self.radii(0.0).into_iter().fold(f64::INFINITY, f64::min);
        1.0 - least / self.belly()
    }

    /// Volume over that at rest.
    fn volume(&self) -> f64 {
        let (problem, state) = (&self.run.finished.problem, &self.run.finished.state);
        let mesh = &problem.model.bodies[0].mesh;
        let mut deformed = striae_mesh::Mesh::clone(mesh);
        deformed.positions.clone_from(&state.positions);
        deformed.volume() / mesh.volume()
    }

    fn imbalance(&self) -> f64 {
        self.run.largest("energy.imbalance") / self.run.largest("energy.external")
    }

    /// The side in the plane `y = 0`, upwards from the middle.
    fn profile(&self) -> Vec<[f64; 2]> {
        let side = self.places("side").into_iter();
        let plane = side.filter(|(rest, _)| rest.y.abs() < 1e-9);
        let mut profile: Vec<[f64; 2]> = plane.map(|(_, x)| [x.x, x.z]).collect();
        profile.sort_by(|a, b| a[1].total_cmp(&b[1]));
        profile
    }
}

/// A disc of the friction hill.
struct Disc {
    mu: f64,
    /// Radius over height.
    slenderness: f64,
    /// Mean pressure over the yield stress.
    pressure: f64,
    /// Corresponding value of the slab method.
    known: f64,
}

fn hill(study: &mut Study, quick: bool) -> Result<Vec<Disc>, Failure> {
    let coefficients: &[f64] = if quick { &[0.1] } else { &[0.05, 0.1] };
    let mut discs = Vec::new();
    for &mu in coefficients {
        for (height, layers) in DISCS {
            discs.push(disc(study, mu, height, layers)?);
        }
    }
    Ok(discs)
}

fn disc(study: &mut Study, mu: f64, height: f64, layers: usize) -> Result<Disc, Failure> {
    let (file, text) = DECKS[1];
    let meshed = format!("height = {height}, divisions = [3, 3, {layers}]");
    let plate = format!("point = [0, 0, {height}]");
    let way = format!("displacement = [0, 0, {}]", -HILL * height);
    let passages = [
        ["height = 10, divisions = [3, 3, 6]", &meshed],
        ["point = [0, 0, 10]", &plate],
        ["displacement = [0, 0, -0.5]", &way],
    ];
    let mut deck = study.variant(file, text, &passages)?;
    deck.model.pairs[0].friction = Friction::coulomb(mu).expect("a coefficient of friction");
    let run = study.run(&format!("hill-{mu}-{height}"), deck)?;
    let [first, slope] = IDEAL;
    let left = 1.0 - HILL;
    let force = -4.0 * run.at_end_of(1, "pair.face.resultant_a.z");
    let stress = first - slope * left.ln();
    let slenderness = RADIUS / left.sqrt() / (2.0 * height * left);
    Ok(Disc {
        mu,
        slenderness,
        pressure: force * left / meshed_area(6) / stress,
        known: slab(2.0 * mu * slenderness),
    })
}

fn draw(study: &mut Study, upset: &[Upset], hill: &[Disc]) -> Result<(), Failure> {
    let colors = [Color::Black, Color::Blue, Color::Vermillion];
    let mut profiles = Panel::plane(
        Axis::linear("r", "mm").within(0.0, 14.0),
        Axis::linear("z", "mm").within(0.0, 10.5),
    )
    .with(
        Series::new(
            "at rest",
            Content::dashed(vec![[10.0, 0.0], [10.0, 10.0], [0.0, 10.0]]),
        )
        .colored(Color::Grey),
    );
    let mut forces = Panel::new(
        Axis::linear("reduction of height", "%"),
        Axis::linear("force", "kN"),
    );
    for (one, color) in upset.iter().zip(colors) {
        let name = format!("μ = {}", one.mu);
        let mut profile = one.profile();
        profile.push([0.0, profile.last().map_or(f64::NAN, |top| top[1])]);
        let profile = Content::line(profile);
        profiles = profiles.with(Series::new(name.clone(), profile).colored(color));
        let found = one.forces().into_iter();
        let found = found.map(|[height, force]| [100.0 * (1.0 - height), force / 1e3]);
        let found = Content::markers(found.step_by(4).collect(), Marker::Circle);
        forces = forces.with(Series::new(name, found).colored(color));
        let known = (0..=80).map(|step| 1.0 - 0.005 * f64::from(step));
        let known = known.map(|height| {
            let x = one.mu * RADIUS / height.sqrt() / (HEIGHT * height);
            let section = meshed_area(one.around) / height;
            let force = flow_stress(-f64::ln(height)) * section * slab(x);
            [100.0 * (1.0 - height), force / 1e3]
        });
        forces = forces.with(Series::new("", Content::line(known.collect())).colored(color));
    }
    let figure = Figure::new(Width::Page, vec![profiles, forces, friction_hill(hill)]);
    study.draw(&figure, "upset")
}

fn friction_hill(hill: &[Disc]) -> Panel {
    let mut panel = Panel::new(
        Axis::linear("R/h", "").within(0.0, 2.5),
        Axis::linear("mean pressure / Y", "").within(1.0, 1.2),
    );
    for (mu, color) in [(0.05, Color::Blue), (0.1, Color::Vermillion)] {
        let ratios = (0..=50).map(|step| 0.05 * f64::from(step));
        let known = ratios
            .map(|ratio| [ratio, slab(2.0 * mu * ratio)])
            .collect();
        let found = hill.iter().filter(|disc| disc.mu == mu);
        let found = found
            .map(|disc| [disc.slenderness, disc.pressure])
            .collect();
        panel = panel
            .with(Series::new(format!("slab, μ = {mu}"), Content::line(known)).colored(color))
            .with(Series::new("", Content::markers(found, Marker::Circle)).colored(color));
    }
    panel
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;
    use striae_deck as deck;

    #[test]
    fn the_slab_method_begins_like_its_series() {
        for x in [1e-3, 1e-2, 0.1] {
            let series = 1.0 + x / 3.0 + x * x / 12.0;
            assert!((slab(x) - series).abs() < 0.02 * x.powi(3), "{x}");
        }
    }

    #[test]
    fn the_decks_have_the_constants_of_the_closed_form() {
        for (name, text) in DECKS {
            let deck = deck::parse(text, name, Path::new("")).unwrap();
            let mesh = &deck.model.bodies[0].mesh;
            let face = mesh.facet_sets.get("zmax").unwrap();
            assert!((4.0 * mesh.area(face) - meshed_area(6)).abs() < 1e-10);
        }
        let table = format!("yield_table = {YIELD:?}")
            .replace(".0,", ",")
            .replace(".0]", "]");
        assert!(DECKS[0].1.contains(&table), "{table}");
    }
}
