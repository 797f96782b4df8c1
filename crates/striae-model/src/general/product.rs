//! Couples as products of two sides, and of sides with themselves.

use std::collections::{BTreeMap, BTreeSet};

use super::rule::Couple;

/// Atoms of the two sides of a pair.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Product {
    /// Each of the first with each of the second; none is on both sides.
    Sides(Vec<usize>, Vec<usize>),
    /// Each with each, itself included.
    Itself(Vec<usize>),
}

/// Disjoint products that make up these couples.
pub(super) fn products(couples: &BTreeSet<Couple>) -> Vec<Product> {
    let mut left = couples.clone();
    let mut products = Vec::new();
    let atoms: BTreeSet<usize> = couples.iter().flat_map(|&(x, y)| [x, y]).collect();
    for &first in &atoms {
        if !left.contains(&(first, first)) {
            continue;
        }
        let mut members = vec![first];
        for &next in atoms.range(first + 1..) {
            let meets = |member: &usize| left.contains(&(*member, next));
            let all = meets(&next) && members.iter().all(meets);
            if all {
                members.push(next);
            }
        }
        for (at, &x) in members.iter().enumerate() {
            members[at..].iter().for_each(|&y| _ = left.remove(&(x, y)));
        }
        products.push(Product::Itself(members));
    }
    // Atoms that meet the same others are one side.
    while let Some(&(first, _)) = left.first() {
        let opposite = |x: usize| -> Vec<usize> {
            let meets = |y: &usize| left.contains(&(x.min(*y), x.max(*y)));
            atoms.iter().copied().filter(meets).collect()
        };
        let mut alike: BTreeMap<Vec<usize>, Vec<usize>> = BTreeMap::new();
        for &x in &atoms {
            alike.entry(opposite(x)).or_default().push(x);
        }
        let second = opposite(first);
        let first = alike.remove(&second).unwrap_or_default();
        for &x in &first {
            second
                .iter()
                .for_each(|&y| _ = left.remove(&(x.min(y), x.max(y))));
        }
        products.push(Product::Sides(first, second));
    }
    products
}

#[cfg(test)]
mod tests {
    use super::*;

    fn couples(products: &[Product]) -> Vec<Couple> {
        let all = products.iter().flat_map(|product| match product {
            Product::Sides(a, b) => a
                .iter()
                .flat_map(|&x| b.iter().map(move |&y| (x.min(y), x.max(y))))
                .collect::<Vec<_>>(),
            Product::Itself(of) => of
                .iter()
                .flat_map(|&x| of.iter().map(move |&y| (x, y)))
                .filter(|(x, y)| x <= y)
                .collect(),
        });
        let mut all: Vec<Couple> = all.collect();
        all.sort_unstable();
        all
    }

    #[test]
    fn a_whole_body_is_one_product() {
        let whole = BTreeSet::from([(0, 0), (0, 1), (1, 1)]);
        assert_eq!(products(&whole), [Product::Itself(vec![0, 1])]);
        let sides = BTreeSet::from([(0, 2), (0, 3), (1, 2), (1, 3)]);
        assert_eq!(products(&sides), [Product::Sides(vec![0, 1], vec![2, 3])]);
    }

    #[test]
    fn products_are_disjoint_and_make_up_the_couples() {
        let all: Vec<Couple> = (0..4).flat_map(|y| (0..=y).map(move |x| (x, y))).collect();
        for chosen in 0..1_usize << all.len() {
            let members = all.iter().enumerate();
            let members = members.filter(|(at, _)| chosen >> at & 1 == 1);
            let chosen: BTreeSet<Couple> = members.map(|(_, couple)| *couple).collect();
            let found = products(&chosen);
            assert_eq!(couples(&found), chosen.into_iter().collect::<Vec<_>>());
            for product in &found {
                if let Product::Sides(a, b) = product {
                    assert!(!a.iter().any(|x| b.contains(x)));
                }
            }
        }
    }
}
