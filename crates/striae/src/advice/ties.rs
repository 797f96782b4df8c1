//! Restraint of bodies by ties, and motions that ties leave free.

use striae_mesh::significant;
use striae_model::{Model, tie::Ties};

use super::{Advice, Topic};

/// Covered part of a surface that is all of it.
const ALL: f64 = 0.999;
/// Move over the facet size that is round-off.
const ROUND_OFF: f64 = 1e-9;

/// Notes what every tie joins, and how far it has moved nodes.
pub(super) fn look(model: &Model, advice: &mut Advice) {
    let ties = match Ties::new(model) {
        Ok(ties) => ties,
        Err(faults) => {
            for fault in faults {
                advice.fault(Topic::Fit, fault.tie(), fault.to_string());
            }
            return;
        }
    };
    for (joint, tie) in ties.joints.iter().zip(&model.ties) {
        let names = joint.bodies.map(|body| model.bodies[body].name.as_str());
        let mut text = format!(
            "tie `{}`: an area of {} of `{}` and `{}` is glued; nodes of `{}` follow",
            tie.name,
            significant(joint.area, 7),
            names[0],
            names[1],
            names[joint.follows]
        );
        if tie.moved > ROUND_OFF * joint.facet_size {
            let share = 100.0 * tie.moved / joint.facet_size;
            text += &format!(
                " and were moved by up to {}, {share:.2} % of the facet size, onto the other surface",
                significant(tie.moved, 4)
            );
        }
        for (name, cover) in names.iter().zip(joint.cover) {
            if cover < ALL {
                let free = 100.0 * (1.0 - cover);
                text += &format!(
                    "; {free:.1} % of the facets of `{name}` have no partner and are free"
                );
            }
        }
        advice.note(Topic::Fit, &tie.name, text);
    }
}
