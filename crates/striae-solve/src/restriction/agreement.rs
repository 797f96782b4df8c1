//! Elements that are degenerate on some rank, told to all.

use striae_element::{ElementError, ElementFault};
use striae_mesh::ElementId;

use crate::{
    problem::{Problem, ProblemError},
    share::Share,
};

/// Body, element, quadrature point and determinant of what is degenerate.
type Found = (usize, u32, usize, f64);

/// Share made by a rank, or the first degenerate element of the whole model, by body and number.
pub(super) fn agreed(
    share: &Share,
    bodies: &[String],
    own: Result<Problem, ProblemError>,
) -> Result<Problem, ProblemError> {
    let found = match &own {
        Err(ProblemError::Element { body, fault }) => found(share, bodies, body, fault),
        _ => None,
    };
    let told = found.map_or_else(Vec::new, |found| bytes(&found));
    let all = share.team().gather(&told);
    let all = all.iter().filter_map(|told| read(told));
    let first = all.min_by_key(|(body, element, ..)| (*body, *element));
    match first {
        None => own,
        Some((body, element, point, determinant)) => Err(ProblemError::Element {
            body: bodies[body].clone(),
            fault: ElementFault {
                element: ElementId(element),
                error: ElementError::Degenerate { point, determinant },
            },
        }),
    }
}

fn found(share: &Share, bodies: &[String], name: &str, fault: &ElementFault) -> Option<Found> {
    let body = bodies.iter().position(|body| body == name)?;
    let element = share.whole_element(body, fault.element);
    match fault.error {
        ElementError::Degenerate { point, determinant } => {
            Some((body, element.0, point, determinant))
        }
        // Others are of the current configuration.
        _ => None,
    }
}

fn bytes(&(body, element, point, determinant): &Found) -> Vec<u8> {
    let numbers = [body as u64, u64::from(element), point as u64];
    let numbers = numbers.into_iter().chain([determinant.to_bits()]);
    numbers.flat_map(u64::to_le_bytes).collect()
}

fn read(told: &[u8]) -> Option<Found> {
    let mut numbers = told
        .as_chunks()
        .0
        .iter()
        .map(|eight| u64::from_le_bytes(*eight));
    let mut next = || numbers.next();
    let (body, element, point) = (next()?, next()?, next()?);
    let determinant = f64::from_bits(next()?);
    Some((body as usize, element as u32, point as usize, determinant))
}
