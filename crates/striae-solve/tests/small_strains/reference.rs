//! Numbers of the independent implementation.

const REFERENCE: &str = include_str!("reference.txt");

/// A punch on a base.
pub struct Case {
    /// The line that states it.
    pub name: String,
    /// Divisions of base and punch.
    pub divisions: [usize; 2],
    /// Modulus of the punch over that of the base.
    pub ratio: f64,
    /// Coefficient of friction.
    pub mu: f64,
    /// Start of the punch.
    pub origin: [f64; 2],
    /// Increments that follow.
    pub increments: Vec<Increment>,
}

/// An increment and where it leads.
pub struct Increment {
    /// Displacement of the top of the punch: the part that does not scale with the depth.
    pub shift: [f64; 2],
    /// Displacement over the depth.
    pub rate: [f64; 3],
    /// Kept nodes by side.
    pub kept: [Vec<usize>; 2],
    /// Pressure, then friction on the punch along x and y, over the depth.
    pub unknowns: Vec<f64>,
    /// Closed shares of the kept nodes, as sums over points; empty where all are one.
    pub shares: Vec<f64>,
    /// Nodal forces over the depth by side.
    pub forces: [Vec<f64>; 2],
}

fn numbers(words: &str) -> Vec<f64> {
    let number = |word: &str| word.parse().expect("a number");
    words.split_whitespace().map(number).collect()
}

fn places(words: &str) -> Vec<usize> {
    let place = |word: &str| word.parse().expect("a place");
    words.split_whitespace().map(place).collect()
}

/// All cases.
pub fn cases() -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    for line in REFERENCE.lines().filter(|line| !line.starts_with('#')) {
        let (word, rest) = line.split_once(' ').expect("a word and numbers");
        if word == "case" {
            let c = numbers(rest);
            cases.push(Case {
                name: line.to_owned(),
                divisions: [c[0] as usize, c[1] as usize],
                ratio: c[2],
                mu: c[3],
                origin: [c[4], c[5]],
                increments: Vec::new(),
            });
            continue;
        }
        let increments = &mut cases.last_mut().expect("a case begins").increments;
        if word == "increment" {
            let c = numbers(rest);
            increments.push(Increment {
                shift: [c[0], c[1]],
                rate: [c[2], c[3], c[4]],
                kept: [Vec::new(), Vec::new()],
                unknowns: Vec::new(),
                shares: Vec::new(),
                forces: [Vec::new(), Vec::new()],
            });
            continue;
        }
        let increment = increments.last_mut().expect("an increment begins");
        let of_side = rest.split_once(' ');
        match (word, of_side) {
            ("unknowns", _) => increment.unknowns = numbers(rest),
            ("shares", _) => increment.shares = numbers(rest),
            ("kept", Some((side, nodes))) => increment.kept[places(side)[0]] = places(nodes),
            ("forces", Some((side, values))) => increment.forces[places(side)[0]] = numbers(values),
            _ => panic!("{word}"),
        }
    }
    cases
}
