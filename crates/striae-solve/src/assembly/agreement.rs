//! Agreement of ranks on failures: what fails on one rank fails on all.
//!
//! Elements and loads are evaluated by one rank each, so one rank may fail where others do not. All
//! ranks learn of the first element that fails, by body and number in the whole mesh, as a single
//! rank would encounter it; then of the first load, by rank.

use striae_element::{ElementError, ElementFault};
use striae_mesh::{ElementId, NodeId, Vec3};

use crate::{outcome::CutBack, problem::Problem};
use striae_model::load::LoadError;

/// Result of a phase, or the first reason for which it failed on any rank; collective.
pub(super) fn agreed<T>(problem: &Problem, found: Result<T, CutBack>) -> Result<T, CutBack> {
    let share = &problem.share;
    if share.is_alone() || !share.any(found.is_err()) {
        return found;
    }
    let own = found.err();
    let words = own.as_ref().map_or_else(Vec::new, written);
    let all = share.team().gather(&words);
    let told = all.iter().filter_map(|words| read(&mut Words(words)));
    let first = told.min_by_key(|fault| place(problem, fault));
    // What cannot be told is of contact, which is the same everywhere.
    Err(first
        .or(own)
        .expect("what is not told has failed on all ranks"))
}

/// Order in which faults are met: contact first, then elements, then loads.
fn place(problem: &Problem, fault: &CutBack) -> (usize, usize, usize) {
    match fault {
        CutBack::InvertedElement { body, element } => {
            let bodies = &problem.model.bodies;
            let body = bodies.iter().position(|other| other.name == *body);
            (1, body.unwrap_or_default(), element.element.index())
        }
        CutBack::Load { .. } => (2, 0, 0),
        _ => (0, 0, 0),
    }
}

/// Stands for a Gauss point where a load has no value.
const UNDEFINED: usize = 4;

/// A fault in bytes; nothing for one that all ranks have anyway.
fn written(fault: &CutBack) -> Vec<u8> {
    let mut bytes = Vec::new();
    match fault {
        CutBack::InvertedElement { body, element } => {
            let (kind, point, values) = parts(&element.error);
            bytes.push(0);
            text(&mut bytes, body);
            number(&mut bytes, element.element.index());
            number(&mut bytes, kind);
            number(&mut bytes, point);
            values
                .iter()
                .for_each(|v| bytes.extend(v.to_bits().to_le_bytes()));
        }
        CutBack::Load { body, set, error } => {
            bytes.push(1);
            text(&mut bytes, body);
            text(&mut bytes, set);
            match error {
                LoadError::Undirected { gauss_point } => number(&mut bytes, *gauss_point),
                LoadError::Undefined { point } => {
                    number(&mut bytes, UNDEFINED);
                    let values = point.iter();
                    values.for_each(|v| bytes.extend(v.to_bits().to_le_bytes()));
                }
            }
        }
        CutBack::CollapsedTexture { pair, body, node } => {
            bytes.push(2);
            text(&mut bytes, pair);
            text(&mut bytes, body);
            number(&mut bytes, node.index());
        }
        CutBack::Folded { pair } => {
            bytes.push(3);
            text(&mut bytes, pair);
        }
        _ => {}
    }
    bytes
}

fn read(words: &mut Words) -> Option<CutBack> {
    let [kind] = words.bytes(1)?.try_into().ok()?;
    match kind {
        0 => Some(CutBack::InvertedElement {
            body: words.text()?,
            element: ElementFault {
                element: ElementId::new(words.number()?),
                error: words.element_error()?,
            },
        }),
        1 => Some(CutBack::Load {
            body: words.text()?,
            set: words.text()?,
            error: words.load_error()?,
        }),
        2 => Some(CutBack::CollapsedTexture {
            pair: words.text()?,
            body: words.text()?,
            node: NodeId::new(words.number()?),
        }),
        _ => Some(CutBack::Folded {
            pair: words.text()?,
        }),
    }
}

/// Kind, point and values of an error.
fn parts(error: &ElementError) -> (usize, usize, [f64; 2]) {
    match *error {
        ElementError::Degenerate { point, determinant } => (0, point, [determinant, 0.0]),
        ElementError::Inverted { point, determinant } => (1, point, [determinant, 0.0]),
        ElementError::Overstretched {
            point,
            strain,
            limit,
        } => (2, point, [strain, limit]),
        ElementError::OverstretchedFibres {
            point,
            strain,
            limit,
        } => (3, point, [strain, limit]),
        ElementError::Unsettled => (4, 0, [0.0; 2]),
        ElementError::Shrunk { determinant } => (5, 0, [determinant, 0.0]),
        ElementError::Refused { point, determinant } => (6, point, [determinant, 0.0]),
    }
}

fn number(bytes: &mut Vec<u8>, value: usize) {
    bytes.extend((value as u64).to_le_bytes());
}

fn text(bytes: &mut Vec<u8>, text: &str) {
    number(bytes, text.len());
    bytes.extend(text.as_bytes());
}

/// Bytes of a list that are not read yet.
struct Words<'a>(&'a [u8]);

impl<'a> Words<'a> {
    fn bytes(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, left) = self.0.split_at_checked(count)?;
        self.0 = left;
        Some(taken)
    }

    fn bits(&mut self) -> Option<u64> {
        let bytes = self.bytes(8)?;
        Some(u64::from_le_bytes(bytes.try_into().ok()?))
    }

    fn number(&mut self) -> Option<usize> {
        self.bits().map(|bits| bits as usize)
    }

    fn value(&mut self) -> Option<f64> {
        self.bits().map(f64::from_bits)
    }

    fn text(&mut self) -> Option<String> {
        let count = self.number()?;
        String::from_utf8(self.bytes(count)?.to_vec()).ok()
    }

    fn element_error(&mut self) -> Option<ElementError> {
        let (kind, point) = (self.number()?, self.number()?);
        let (value, limit) = (self.value()?, self.value()?);
        match kind {
            0 => Some(ElementError::Degenerate {
                point,
                determinant: value,
            }),
            1 => Some(ElementError::Inverted {
                point,
                determinant: value,
            }),
            2 => Some(ElementError::Overstretched {
                point,
                strain: value,
                limit,
            }),
            3 => Some(ElementError::OverstretchedFibres {
                point,
                strain: value,
                limit,
            }),
            5 => Some(ElementError::Shrunk { determinant: value }),
            6 => Some(ElementError::Refused {
                point,
                determinant: value,
            }),
            _ => Some(ElementError::Unsettled),
        }
    }

    fn load_error(&mut self) -> Option<LoadError> {
        Some(match self.number()? {
            UNDEFINED => LoadError::Undefined {
                point: Vec3::new(self.value()?, self.value()?, self.value()?),
            },
            gauss_point => LoadError::Undirected { gauss_point },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faults_survive_the_way_to_other_ranks() {
        let element = |error: ElementError| CutBack::InvertedElement {
            body: "disc".to_owned(),
            element: ElementFault {
                element: ElementId::new(17),
                error,
            },
        };
        let (point, determinant) = (3, -0.25);
        let (strain, limit) = (7.5, 4.0);
        let faults = [
            element(ElementError::Degenerate { point, determinant }),
            element(ElementError::Inverted { point, determinant }),
            element(ElementError::Refused { point, determinant }),
            element(ElementError::Overstretched {
                point,
                strain,
                limit,
            }),
            element(ElementError::OverstretchedFibres {
                point,
                strain,
                limit,
            }),
            element(ElementError::Unsettled),
            CutBack::Load {
                body: "disc".to_owned(),
                set: "top".to_owned(),
                error: LoadError::Undirected { gauss_point: 2 },
            },
            CutBack::CollapsedTexture {
                pair: "sole".to_owned(),
                body: "disc".to_owned(),
                node: NodeId::new(5),
            },
            CutBack::Folded {
                pair: "sole".to_owned(),
            },
        ];
        for fault in faults {
            assert_eq!(read(&mut Words(&written(&fault))), Some(fault));
        }
    }
}
