//! Bodies in flight: dropped on a plane or a block, launched along it.
//!
//! With the wave speed `c = sqrt(E/rho)` of the upper body and its height `h`, an
//! impact at the speed `v` strains it by about `v/c` and lasts some `2 h/c`.

use super::{
    Dialect,
    parts::{
        Stance, Strains, Units, block, body, coulomb, facet, pair, pair_with, placement, scene,
    },
};
use crate::scenes::{
    random::Random,
    scene::{End, Rigid, RigidShape, Scene, Step},
};

/// A block above a plane or a block, and the numbers of its flight.
struct Flight {
    scene: Scene,
    height: f64,
    facet: f64,
    /// Wave speed.
    speed: f64,
}

fn flight(random: &mut Random, gap: f64, coulomb_only: Option<f64>) -> Flight {
    let units = Units::random(random);
    let unit = units.length;
    let plan = [
        random.between(0.4, 0.7) * unit,
        random.between(0.4, 0.7) * unit,
    ];
    let height = random.between(0.3, 0.7) * unit;
    let layers = random.whole(2..=4);
    let mut upper = block(random, [0.0, 0.0, gap * unit], plan, height, layers);
    upper.divisions = upper.divisions.map(|count| count.min(5));
    let on_plane = random.chance(0.5);
    let ratio = random.decade(1e-2, 1e2);
    let density = random.decade(1e-2, 1e3);
    let modulus = units.modulus * ratio;
    let below = if on_plane {
        ("floor", None)
    } else {
        ("base", Some("zmax"))
    };
    let sides = [("upper", Some("zmin")), below];
    let pressure = 0.03 * modulus;
    let pair = match coulomb_only {
        Some(mu) => {
            let law = coulomb(random, mu, mu + 1e-9);
            pair_with(random, "contact", sides, unit, pressure, law)
        }
        None => pair(random, "contact", sides, unit, pressure),
    };
    let facet = facet(&upper);
    let mut of_upper = Strains::Moderate.material(random, modulus);
    of_upper.density = Some(density);
    let mut bodies = vec![body("upper", of_upper, upper)];
    if !on_plane {
        let plan = [
            random.between(0.9, 1.2) * unit,
            random.between(0.9, 1.2) * unit,
        ];
        let mut base = block(random, [0.0, 0.0, -0.4 * unit], plan, 0.4 * unit, 2);
        base.divisions = base.divisions.map(|count| count.min(6));
        let mut material = Strains::Moderate.material(random, units.modulus);
        material.density = Some(density);
        bodies.push(body("base", material, base));
    }
    let placement = placement(random, units, Stance::Any);
    let mut scene = scene(placement, (!on_plane).then_some(ratio), bodies, vec![pair]);
    if on_plane {
        scene.rigid.push(Rigid {
            name: "floor",
            shape: RigidShape::Plane([0.0; 3], [0.0, 0.0, 1.0]),
        });
    }
    Flight {
        scene,
        height,
        facet,
        speed: (modulus.min(units.modulus) / density).sqrt(),
    }
}

impl Flight {
    fn step(&self, name: &'static str) -> Step {
        let step = Step::new(name);
        if self.scene.bodies.len() > 1 {
            step.moving("base", "zmin", [0.0; 3])
        } else {
            step
        }
    }
}

/// Dropped with a speed, straight or aslant.
pub fn drop(random: &mut Random, _: Dialect) -> Scene {
    let gap = random.between(0.005, 0.05);
    let mut flight = flight(random, gap, None);
    let v = random.between(0.005, 0.05) * flight.speed;
    let aslant = random.one_of(&[0.0, 0.5, 1.0]) * v;
    let angle = random.between(0.0, std::f64::consts::TAU);
    let unit = flight.height / 0.5;
    let mut step = flight.step("drop");
    step.velocities
        .push(("upper", [aslant * angle.cos(), aslant * angle.sin(), -v]));
    step.duration = Some(1.5 * gap * unit / v + 6.0 * flight.height / flight.speed);
    step.increments = Some(random.whole(30..=60));
    step.end = End::Met;
    flight.scene.steps = vec![step];
    flight.scene
}

/// Launched along the surface under gravity, held by friction.
pub fn launch(random: &mut Random, _: Dialect) -> Scene {
    let mu = random.between(0.1, 0.6);
    let mut flight = flight(random, 0.0, Some(mu));
    // Its own weight strains the body by some thousandths.
    let strain = random.between(0.001, 0.01);
    let gravity = strain * flight.speed * flight.speed / flight.height;
    // The way to rest, v^2/(2 mu g), is a facet at most.
    let way = random.between(0.1, 1.0) * flight.facet;
    let v = (2.0 * mu * gravity * way).sqrt();
    let angle = random.between(0.0, std::f64::consts::TAU);
    let mut step = flight.step("launch");
    step.velocities
        .push(("upper", [v * angle.cos(), v * angle.sin(), 0.0]));
    step.gravity = Some([0.0, 0.0, -gravity]);
    step.duration = Some(1.2 * v / (mu * gravity));
    step.increments = Some(random.whole(30..=60));
    step.end = End::Met;
    flight.scene.steps = vec![step];
    flight.scene
}
