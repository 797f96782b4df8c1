//! `stiff-punch`: an offset punch on a larger base, for all ratios of stiffness and size
//! of the elements.
//!
//! Counts the runs that converge and measures the balance of forces, tension and the
//! error of the force beside a fine mesh.

use striae_deck::Deck;

use super::{
    battery::{Battery, normal_force},
    study::{Extent, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 1] = decks!("stiff-punch": "deck");
const RATIOS: [&str; 6] = ["1e-4", "0.01", "1", "10", "100", "1e4"];
const DIVISIONS: [usize; 4] = [3, 4, 6, 12];
const FINE: [[usize; 3]; 2] = [[20, 20, 10], [16, 16, 10]];
/// Of the lower face of the punch.
const AREA: f64 = 0.62 * 0.65;

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let (ratios, divisions): (&[&str], &[usize]) = match study.extent {
        Extent::Full => (&RATIOS, &DIVISIONS),
        Extent::Quick => (&["0.01", "1", "100"], &[3, 6]),
    };
    let mut battery = Battery::new(AREA);
    let mut coarsest = 0.0_f64;
    for ratio in ratios {
        let deck = pressed(study, ratio, FINE)?;
        let fine = normal_force(&study.run_unjudged(&format!("{ratio}-fine"), deck)?);
        for &base in divisions {
            for &punch in divisions {
                let deck = pressed(study, ratio, [base, punch].map(block))?;
                let name = format!("{ratio}-{base}-{punch}");
                let trial = battery.run(study, ratio, &name, deck)?;
                let error = trial.force / fine - 1.0;
                trial.error = Some(error);
                if [base, punch] == [divisions[0]; 2] {
                    coarsest = coarsest.max(error.abs());
                }
            }
        }
    }
    study.measured("force.coarsest", coarsest);
    if study.extent == Extent::Quick {
        study.left_out.push("force.median");
    }
    battery.measure(study);
    battery.write(study)
}

fn block(n: usize) -> [usize; 3] {
    [n, n, (n / 2).max(2)]
}

/// The deck with other stiffness and divisions of base and punch.
fn pressed(study: &Study, ratio: &str, divisions: [[usize; 3]; 2]) -> Result<Deck, Failure> {
    let [(name, text)] = DECKS;
    let modulus = format!("youngs_modulus = {ratio}\n");
    let [base, punch] = [("1, 1", divisions[0]), ("0.62, 0.65", divisions[1])]
        .map(|(size, divisions)| format!("size = [{size}, 0.5], divisions = {divisions:?}"));
    let passages = [
        ["youngs_modulus = 100\n", &modulus],
        ["size = [1, 1, 0.5], divisions = [4, 4, 2]", &base],
        ["size = [0.62, 0.65, 0.5], divisions = [6, 6, 3]", &punch],
    ];
    study.variant(name, text, &passages)
}
