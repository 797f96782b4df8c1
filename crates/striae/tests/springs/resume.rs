//! A run with springs that is stopped and taken up again.

use std::path::Path;

use striae::prelude::*;

const DECK: &str = r#"title = "A weight on a spring"

[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1
poissons_ratio = 0.3
density = 1

[[body]]
name = "block"
material = "rubber"
mesh = { generator = "block", size = [2, 1, 1], divisions = [2, 1, 1] }

[[rigid]]
name = "weight"
plane = { point = [2, 0, 0.5], normal = [-1, 0, 0] }
reference = [2, 0.5, 0.5]
mass = 2
inertia = [0.1, 0.1, 0.1]

[[spring]]
name = "line"
a = { body = "block", nodes = "xmax" }
b = { rigid = "weight" }
stiffness = 0.4
damping = 0.05

[[spring]]
name = "anchor"
a = { rigid = "weight", point = [2.2, 0.5, 0.5] }
b = { fixed = [3, 0.5, 2] }
stiffness = 2
damping = 0.3
free_length = 1.5

[[step]]
name = "settle"
increments = { initial = 0.25, largest = 0.25 }
displacement = [{ body = "block", nodes = "xmin", x = 0, y = 0, z = 0 }]
rigid = [{ surface = "weight", free = ["x", "z"] }]

[[step]]
name = "swing"
dynamics = {}
increments = { initial = 0.125, largest = 0.125 }
velocity = [{ rigid = "weight", vector = [0, 0, 1] }]
"#;

/// Stops after some increments.
struct After(usize);

impl Observer for After {
    fn increment(&mut self, _: &striae::Converged<'_>) -> Next {
        self.0 -= 1;
        if self.0 == 0 {
            Next::Stop
        } else {
            Next::Continue
        }
    }
}

fn history(folder: &Path) -> String {
    std::fs::read_to_string(folder.join("history.csv")).unwrap()
}

#[test]
fn an_interrupted_run_goes_on_to_the_same_bits() {
    let directory = tempfile::tempdir().unwrap();
    let deck = directory.path().join("deck.toml");
    std::fs::write(&deck, DECK).unwrap();
    let whole = directory.path().join("whole");
    let run = Simulation::open(&deck, &whole).unwrap().run().unwrap();
    assert_eq!(run.ending, Ending::Completed, "{}", run.ending);
    for count in [2, 4, 7] {
        let parts = directory.path().join(format!("parts-{count}"));
        let first = Simulation::open(&deck, &parts).unwrap();
        first.run_with(&mut After(count)).unwrap();
        let rest = Simulation::resume(&parts).unwrap().run().unwrap();
        assert_eq!(rest.ending, Ending::Completed);
        assert_eq!(rest.state.positions, run.state.positions);
        assert_eq!(rest.state.forces, run.state.forces);
        assert_eq!(history(&parts), history(&whole));
    }
}
