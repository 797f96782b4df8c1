//! Blocks that slide over a larger one all the time: tools, reversals, long ways, rates.
//!
//! If all nodes slip, the integral of friction over that of pressure is the coefficient of
//! Coulomb's law, and the resultant lies on the slip surface of any law, with the mean normal.

use super::{
    Dialect,
    blade::blade,
    parts::{coulomb, rubbing},
    slab::{SLIDING, Wanted, slab},
};
use crate::scenes::{
    claim::{Claim, Quantity, about},
    random::Random,
    scene::{Ending, Scene},
};

/// A stiff block over a softer one, by 0.3 to 2 facets an increment.
pub fn tool(random: &mut Random, _: Dialect) -> Scene {
    if random.chance(0.3) {
        return blade(random);
    }
    let law = rubbing(random);
    let wanted = Wanted {
        ratio: random.decade(3.0, 1e4),
        strain: random.between(0.005, 0.04),
        length: random.between(2.5, 4.0),
        law,
    };
    let mut slab = slab(random, &wanted);
    let each = random.between(0.3, 2.0) * slab.facets[0];
    let count = ((slab.room - 0.1 * slab.units.length) / each)
        .floor()
        .clamp(2.0, 15.0);
    let way = count * each;
    let slide = slab.to("slide", way).within(Some(count as usize));
    slab.claim(1, way);
    slab.scene.steps = vec![slab.press(), slide];
    slab.scene
}

/// Names of twenty steps.
const REVERSALS: [&str; 20] = [
    "there-1", "back-1", "there-2", "back-2", "there-3", "back-3", "there-4", "back-4", "there-5",
    "back-5", "there-6", "back-6", "there-7", "back-7", "there-8", "back-8", "there-9", "back-9",
    "there-10", "back-10",
];

/// Twenty reversals of the direction.
pub fn reversals(random: &mut Random, _: Dialect) -> Scene {
    let law = coulomb(random, 0.05, 0.6);
    let wanted = Wanted {
        ratio: random.decade(1e-3, 1e3),
        strain: random.between(0.003, 0.02),
        length: random.between(2.0, 3.0),
        law,
    };
    let mut slab = slab(random, &wanted);
    let facet = slab.facets[0].min(slab.facets[1]);
    let ahead = (random.between(0.3, 1.2) * facet)
        .max(2.0 * slab.lag)
        .min(slab.room);
    let middle = 0.5 * slab.room;
    let start = slab.to("start", middle).within(Some(4));
    let mut steps = vec![slab.press(), start];
    let increments = random.whole(1..=3);
    for reversal in 0..20 {
        let sign = if reversal % 2 == 0 { 0.5 } else { -0.5 };
        let to = slab.to(REVERSALS[reversal], middle + sign * ahead);
        steps.push(to.within(Some(increments)));
        let mu = slab.scene.pairs[0].law.coefficient();
        let quantity = Quantity::Friction(0);
        let claim = Claim::at_end("sliding", 2 + reversal, quantity, about(mu, SLIDING));
        if reversal > 0 {
            slab.scene.claims.push(claim);
        }
    }
    slab.scene.steps = steps;
    slab.scene
}

/// Several facets an increment.
pub fn far_slip(random: &mut Random, _: Dialect) -> Scene {
    let law = rubbing(random);
    let wanted = Wanted {
        ratio: random.decade(1e-3, 1e3),
        strain: random.between(0.003, 0.02),
        length: random.between(5.0, 7.0),
        law,
    };
    let mut slab = slab(random, &wanted);
    let way = 0.95 * slab.room;
    let each = random.between(2.0, 6.0) * slab.facets[0].min(slab.facets[1]);
    let count = (way / each).ceil().max(2.0) as usize;
    let slide = slab.to("slide", way).within(Some(count));
    slab.claim(1, way);
    slab.scene.steps = vec![slab.press(), slide];
    slab.scene
}

/// Friction that falls with the rate of slip, at a steady rate.
pub fn decay(random: &mut Random, _: Dialect) -> Scene {
    let law = coulomb(random, 0.1, 0.6);
    let mu = law.coefficient();
    let wanted = Wanted {
        ratio: random.decade(1e-2, 1e2),
        strain: random.between(0.003, 0.02),
        length: random.between(2.5, 4.0),
        law,
    };
    let mut slab = slab(random, &wanted);
    let way = (0.8 * slab.room)
        .min(6.0 * slab.facets[0])
        .max(4.0 * slab.lag);
    let duration = random.decade(0.1, 10.0);
    let rate = way / duration;
    let kinetic = random.between(0.5, 0.95);
    let decay = rate * random.decade(0.2, 4.0);
    slab.scene.pairs[0].decay = Some((kinetic, decay));
    let steady = mu * (kinetic + (1.0 - kinetic) * (-rate / decay).exp());
    let mut slide = slab.to("slide", way).within(Some(random.whole(6..=12)));
    slide.duration = Some(duration);
    let quantity = Quantity::Friction(0);
    let claim = Claim::at_end("sliding", 1, quantity, about(steady, 5.0 * SLIDING));
    slab.scene.claims.push(claim.within(0.7));
    slab.scene.steps = vec![slab.press(), slide];
    // Friction that falls faster than the bodies can follow has no state in balance.
    slab.scene.ending = Ending::Open;
    slab.scene
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twenty_reversals_are_twenty_steps_beside_two() {
        let scene = reversals(&mut Random::new(3), Dialect::default());
        assert_eq!(scene.steps.len(), 22);
        let x = |step: usize| scene.steps[step].displacements[0].2[0].unwrap();
        assert!(
            (2..21)
                .all(|step| (x(step + 1) - x(step)) * (x(step) - x(step - 1)) < 0.0 || step == 2)
        );
    }
}
