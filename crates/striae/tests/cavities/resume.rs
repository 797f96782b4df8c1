//! A run with a cavity that is stopped and taken up again.

use striae::prelude::*;

const DECK: &str = r#"title = "A tube that is filled and squeezed"

[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1
poissons_ratio = 0.3

[[body]]
name = "tube"
material = "rubber"
mesh = { generator = "annulus", inner_radius = 0.5, outer_radius = 0.8, width = 0.4, divisions = [2, 16, 1] }
node_sets = [
    { name = "below", from = [-1, -1, -1], to = [1, 1, -0.79] },
    { name = "above", from = [-1, -1, 0.79], to = [1, 1, 1] },
]

[[cavity]]
name = "inside"
faces = [{ body = "tube", facets = "rim" }]

[[step]]
name = "fill"
increments = 2
displacement = [
    { body = "tube", nodes = "sides", y = 0 },
    { body = "tube", nodes = "below", x = 0, z = 0 },
    { body = "tube", nodes = "above", x = 0 },
]
cavity = [{ cavity = "inside", volume_ratio = 1.2 }]

[[step]]
name = "squeeze"
increments = 3
displacement = [{ body = "tube", nodes = "above", z = -0.2 }]
cavity = [{ cavity = "inside", gas = { ambient = 0.5, exponent = 1.4 } }]
"#;

/// Stops after some increments.
struct After(usize);

impl Observer for After {
    fn increment(&mut self, _: &striae::Converged<'_>) -> Next {
        self.0 -= 1;
        match self.0 {
            0 => Next::Stop,
            _ => Next::Continue,
        }
    }
}

#[test]
fn an_interrupted_run_goes_on_to_the_same_bits() {
    let directory = tempfile::tempdir().unwrap();
    let deck = directory.path().join("deck.toml");
    std::fs::write(&deck, DECK).unwrap();
    let [whole, parts] = ["whole", "parts"].map(|name| directory.path().join(name));
    let run = Simulation::open(&deck, &whole).unwrap().run().unwrap();
    assert_eq!(run.ending, Ending::Completed, "{}", run.ending);
    let first = Simulation::open(&deck, &parts).unwrap();
    first.run_with(&mut After(3)).unwrap();
    let rest = Simulation::resume(&parts).unwrap().run().unwrap();
    assert_eq!(rest.ending, Ending::Completed);
    assert_eq!(rest.state.positions, run.state.positions);
    assert_eq!(rest.state.pressures, run.state.pressures);
    let [one, other] =
        [&whole, &parts].map(|folder| std::fs::read(folder.join("history.csv")).unwrap());
    assert!(one == other);
}
