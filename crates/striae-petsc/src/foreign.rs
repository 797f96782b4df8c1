//! Rows of a matrix that parts of other ranks add to.

use crate::binding::Entry;
use std::collections::HashMap;
use striae_solve::team::Team;

/// Contributions of other ranks to this rank's rows, by the number of the row in the whole matrix.
pub(crate) type Foreign<const AREA: usize> = HashMap<u32, Vec<Entry<AREA>>>;

/// First row of every rank, of which this one has so many, and the end of all.
pub(crate) fn starts(team: &dyn Team, own: usize) -> Vec<usize> {
    let counts = team.gather(&(own as u64).to_le_bytes());
    let mut starts = vec![0];
    for count in counts {
        let count = count.first_chunk().copied().map_or(0, u64::from_le_bytes);
        starts.push(starts[starts.len() - 1] + count as usize);
    }
    starts
}

/// Sends rows to the ranks they belong to, and returns what came, in the order of the ranks.
pub(crate) fn exchange<const AREA: usize>(
    team: &dyn Team,
    starts: &[usize],
    rows: impl Iterator<Item = (u32, Vec<Entry<AREA>>)>,
) -> Foreign<AREA> {
    let mut parcels = vec![Vec::new(); team.size()];
    for (row, entries) in rows {
        pack(&mut parcels[owner(starts, row)], row, &entries);
    }
    unpacked(team.exchange(parcels))
}

/// Rows that this rank wants of those they belong to; `row` makes one of its own.
pub(crate) fn fetch<const AREA: usize>(
    team: &dyn Team,
    starts: &[usize],
    wanted: &[u32],
    row: impl Fn(usize) -> Vec<Entry<AREA>>,
) -> Foreign<AREA> {
    let mut wishes = vec![Vec::new(); team.size()];
    for &row in wanted {
        wishes[owner(starts, row)].push(f64::from(row));
    }
    let parcels = team.exchange(wishes).into_iter().map(|wishes| {
        let mut parcel = Vec::new();
        for wish in wishes {
            let own = wish as usize - starts[team.rank()];
            pack(&mut parcel, wish as u32, &row(own));
        }
        parcel
    });
    let parcels = parcels.collect();
    unpacked(team.exchange(parcels))
}

/// The rank that owns a row.
fn owner(starts: &[usize], row: u32) -> usize {
    starts.partition_point(|&start| start <= row as usize) - 1
}

fn pack<const AREA: usize>(parcel: &mut Vec<f64>, row: u32, entries: &[Entry<AREA>]) {
    if entries.is_empty() {
        return;
    }
    parcel.extend([f64::from(row), entries.len() as f64]);
    for (column, values) in entries {
        parcel.push(f64::from(*column));
        parcel.extend(values);
    }
}

fn unpacked<const AREA: usize>(parcels: Vec<Vec<f64>>) -> Foreign<AREA> {
    let mut foreign = Foreign::new();
    for parcel in parcels {
        let mut rest = parcel.as_slice();
        while let [row, count, entries @ ..] = rest {
            let (entries, others) = entries.split_at(*count as usize * (1 + AREA));
            let own: &mut Vec<Entry<AREA>> = foreign.entry(*row as u32).or_default();
            own.extend(entries.chunks_exact(1 + AREA).map(|entry| {
                let mut values = [0.0; AREA];
                values.copy_from_slice(&entry[1..]);
                (entry[0] as u32, values)
            }));
            rest = others;
        }
    }
    foreign
}
