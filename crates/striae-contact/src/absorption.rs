//! Origin of the values of transient nodes.
//!
//! ```text
//! Z_t = sum_j M_tj Z_j,   Z_k = e_k,   M >= 0,   M 1 = 1
//! ```
//!
//! `Z` holds the absorption probabilities of a Markov chain. Transient nodes are
//! eliminated one by one, those with few connections first, and the diagonal
//! `1 - M_tt` is formed as the sum of the other entries, after Grassmann, Taksar &
//! Heyman, "Regenerative analysis and steady state distributions for Markov chains",
//! Oper. Res. 33 (1985), doi:10.1287/opre.33.5.1107. Nothing is subtracted: every
//! entry is right to round-off and not negative.

use std::{cmp::Reverse, collections::BinaryHeap};

use crate::common_mass::{SparseRow, SparseSum};

/// Entries below it are dropped.
const NOTHING: f64 = 1e-14;

/// Role of a node in the absorbing Markov chain.
pub(crate) enum State {
    /// The node takes values of others.
    Transient(SparseRow),
    /// The node has its own value.
    Absorbing,
    /// The node takes no part.
    Outside,
}

/// Rows of `Z` for all nodes, empty outside. Every transient node must reach an
/// absorbing one.
pub(crate) fn absorption(states: Vec<State>) -> Vec<SparseRow> {
    let count = states.len();
    let mut elimination = Elimination::new(states);
    let order = elimination.run();
    let mut z: Vec<SparseRow> = (0..count as u32)
        .map(|k| match elimination.kind[k as usize] {
            Kind::Absorbing => vec![(k, 1.0)],
            _ => SparseRow::new(),
        })
        .collect();
    let mut sum = SparseSum::new(count);
    for &t in order.iter().rev() {
        z[t as usize] = combined(&elimination.rows[t as usize], &z, &mut sum);
    }
    z
}

/// `sum_j row_j z_j`, without what is nothing, of sum one.
pub(crate) fn combined(row: &SparseRow, z: &[SparseRow], sum: &mut SparseSum) -> SparseRow {
    for &(j, by_j) in row {
        for &(k, value) in &z[j as usize] {
            sum.add(k, by_j * value);
        }
    }
    let mut combined = sum.take();
    combined.retain(|&(_, value)| value >= NOTHING);
    normalised(combined)
}

/// The row over its sum.
pub(crate) fn normalised(mut row: SparseRow) -> SparseRow {
    let total: f64 = row.iter().map(|(_, value)| value).sum();
    row.iter_mut().for_each(|(_, value)| *value /= total);
    row
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Transient,
    Absorbing,
    Outside,
    Eliminated,
}

struct Elimination {
    kind: Vec<Kind>,
    rows: Vec<SparseRow>,
    /// Transient nodes whose rows hold a node.
    users: Vec<Vec<u32>>,
}

impl Elimination {
    fn new(states: Vec<State>) -> Self {
        let mut kind = Vec::with_capacity(states.len());
        let mut rows = Vec::with_capacity(states.len());
        for state in states {
            let (of, row) = match state {
                State::Transient(row) => (Kind::Transient, row),
                State::Absorbing => (Kind::Absorbing, SparseRow::new()),
                State::Outside => (Kind::Outside, SparseRow::new()),
            };
            kind.push(of);
            rows.push(row);
        }
        let mut users = vec![Vec::new(); rows.len()];
        for (t, row) in rows.iter().enumerate() {
            for &(j, _) in row {
                if kind[j as usize] == Kind::Transient {
                    users[j as usize].push(t as u32);
                }
            }
        }
        Self { kind, rows, users }
    }

    /// Eliminates all transient nodes and says in what order.
    fn run(&mut self) -> Vec<u32> {
        let count = self.rows.len() as u32;
        let mut queue: BinaryHeap<Reverse<(usize, u32)>> = (0..count)
            .filter(|&t| self.kind[t as usize] == Kind::Transient)
            .map(|t| Reverse((self.cost(t), t)))
            .collect();
        let mut order = Vec::with_capacity(queue.len());
        while let Some(Reverse((cost, t))) = queue.pop() {
            let now = self.cost(t);
            if now > cost {
                queue.push(Reverse((now, t)));
                continue;
            }
            self.eliminate(t);
            order.push(t);
        }
        order
    }

    /// Entries that elimination may fill.
    fn cost(&self, t: u32) -> usize {
        self.users[t as usize].len() * self.rows[t as usize].len()
    }

    fn eliminate(&mut self, t: u32) {
        let mut row = std::mem::take(&mut self.rows[t as usize]);
        row.retain(|&(j, _)| j != t);
        let row = normalised(row);
        self.kind[t as usize] = Kind::Eliminated;
        for &(j, _) in &row {
            self.users[j as usize].retain(|&user| user != t);
        }
        for user in std::mem::take(&mut self.users[t as usize]) {
            if user != t {
                self.substitute(user, t, &row);
            }
        }
        self.rows[t as usize] = row;
    }

    /// Replaces a node in the row of a user by what it takes.
    fn substitute(&mut self, user: u32, t: u32, by: &SparseRow) {
        let old = std::mem::take(&mut self.rows[user as usize]);
        let share = old
            .binary_search_by_key(&t, |&(j, _)| j)
            .map_or(0.0, |at| old[at].1);
        let mut new = Vec::with_capacity(old.len() + by.len());
        let mut old = old.into_iter().filter(|&(j, _)| j != t).peekable();
        for &(j, value) in by {
            while let Some(entry) = old.next_if(|entry| entry.0 < j) {
                new.push(entry);
            }
            let before = old.next_if(|entry| entry.0 == j);
            if before.is_none() && self.kind[j as usize] == Kind::Transient {
                self.users[j as usize].push(user);
            }
            new.push((j, before.map_or(0.0, |entry| entry.1) + share * value));
        }
        new.extend(old);
        self.rows[user as usize] = new;
    }
}
