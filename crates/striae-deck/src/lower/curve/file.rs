//! Points of a curve in a text file.

use std::path::Path;

use striae_files::Separator;

use crate::fault::FaultKind;

/// Reads the points in two columns of a file, below lines that are passed over.
///
/// # Errors
/// The first fault, with its line.
pub(super) fn points(
    base: &Path,
    file: &str,
    columns: [&str; 2],
    skipped: usize,
) -> Result<Vec<(f64, f64)>, FaultKind> {
    let fault = |line: Option<usize>, cause: String| FaultKind::CurveFile {
        file: file.to_owned(),
        line,
        cause,
    };
    let text = striae_meshfile::content(&base.join(file))
        .map_err(|cause| fault(None, format!("it cannot be read: {cause}")))?;
    let text = String::from_utf8(text).map_err(|_| {
        let cause = "it is no text in UTF-8; save it as comma-separated text";
        fault(None, cause.to_owned())
    })?;
    let lines = text.lines().enumerate();
    let mut lines = lines
        .map(|(at, line)| (at + 1, line.split('#').next().unwrap_or("")))
        .skip(skipped)
        .filter(|(_, line)| !line.trim().is_empty())
        .peekable();
    let Some(&(number, first)) = lines.peek() else {
        let cause = "it is empty; a line with the names of columns is needed, and a line for each \
                     point";
        return Err(fault(None, cause.to_owned()));
    };
    let separator = Separator::of(first);
    let names: Vec<&str> = separator.fields(first).map(|(_, name)| name).collect();
    if !names.iter().all(|name| separator.number(name).is_some()) {
        lines.next();
    }
    let mut fields = [0; 2];
    for (field, column) in fields.iter_mut().zip(columns) {
        if names.iter().filter(|name| **name == column).count() > 1 {
            let cause = format!(
                "several columns are named `{column}`; state the number of one, from 1, as a text"
            );
            return Err(fault(Some(number), cause));
        }
        *field = position(&names, column).ok_or_else(|| {
            let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
            let cause = format!(
                "there is no column `{column}`; there are {}",
                names.join(", ")
            );
            fault(Some(number), cause)
        })?;
    }
    let mut points = Vec::new();
    for (number, line) in lines {
        let all: Vec<&str> = separator.fields(line).map(|(_, field)| field).collect();
        let stated = all.iter().rposition(|field| !field.is_empty());
        let stated = stated.map_or(0, |last| last + 1);
        if stated > names.len() {
            let cause = format!(
                "it has {stated} fields, but the first line has {}; decimal commas need \
                 semicolons or tabs between the fields",
                names.len()
            );
            return Err(fault(Some(number), cause));
        }
        let value = |at: usize| {
            let field = all.get(fields[at]).copied().unwrap_or("");
            let value = separator.number(field).filter(|value| value.is_finite());
            value.ok_or_else(|| {
                let column = columns[at];
                fault(
                    Some(number),
                    format!("`{field}` is no finite number for column `{column}`"),
                )
            })
        };
        points.push((value(0)?, value(1)?));
    }
    Ok(points)
}

/// The column of a name, or of a number from 1.
fn position(names: &[&str], column: &str) -> Option<usize> {
    let by_number = || {
        let at = column.parse::<usize>().ok()?.checked_sub(1)?;
        (at < names.len()).then_some(at)
    };
    let by_name = names.iter().position(|name| *name == column);
    by_name.or_else(by_number)
}
