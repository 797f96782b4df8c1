//! `striae check --json`.

use serde_json::{Value, json};
use striae::advice::{Advice, Remark};
use striae_deck::{Deck, Faults};

use super::{place, side_nodes};

/// Faults of a deck with their places.
pub fn of_faults(faults: &Faults) -> Value {
    let all = faults.iter().map(|fault| {
        json!({
            "file": fault.file,
            "line": fault.position.map(|position| position.line),
            "column": fault.position.map(|position| position.column),
            "text": fault.kind.to_string(),
        })
    });
    json!({ "faults": all.collect::<Vec<_>>() })
}

/// A model with what there is to say about it.
pub fn of_model(deck: &Deck, advice: &Advice) -> Value {
    let Deck { model, notes, .. } = deck;
    let remarks = |all: &[Remark]| remarks(deck, all);
    let bodies = model.bodies.iter().map(|body| {
        json!({
            "name": body.name,
            "nodes": body.mesh.positions.len(),
            "elements": body.mesh.element_count(),
            "material": body.material.name(),
        })
    });
    let pairs = model.pairs.iter().map(|pair| {
        let nodes = [&pair.a, &pair.b].map(|side| side_nodes(side, model).len());
        json!({ "name": pair.name, "nodes": nodes })
    });
    let steps = model.steps.iter();
    let steps = steps.map(|step| json!({ "name": step.name, "duration": step.duration }));
    let notes = notes.iter().map(|note| json!({ "text": note }));
    json!({
        "title": model.title,
        "bodies": bodies.collect::<Vec<_>>(),
        "pairs": pairs.collect::<Vec<_>>(),
        "steps": steps.collect::<Vec<_>>(),
        "faults": remarks(&advice.faults),
        "warnings": remarks(&advice.warnings),
        "notes": notes.chain(remarks(&advice.notes)).collect::<Vec<_>>(),
    })
}

fn remarks(deck: &Deck, remarks: &[Remark]) -> Vec<Value> {
    let all = remarks.iter().map(|remark| {
        let at = place(deck, remark);
        json!({
            "topic": remark.topic.name(),
            "name": remark.name,
            "text": remark.text,
            "file": at.map(|at| &at.file),
            "line": at.map(|at| at.position.line),
        })
    });
    all.collect()
}
