//! The book as it was built: every link of a page must lead to an existing file or place, and no
//! page may load anything from a network.

use std::{
    collections::{HashMap, HashSet},
    fs,
    path::{Path, PathBuf},
};

use crate::{breach::Breach, fault::Fault};

/// Pages that mdBook makes for itself, relative to the root of a server.
const OWN: [&str; 2] = ["404.html", "toc.html"];

/// Breaches in the pages of a folder.
///
/// # Errors
/// If a page cannot be read.
pub fn breaches(folder: &Path) -> Result<Vec<Breach>, Fault> {
    let mut pages = HashMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(within) = folders.pop() {
        let unreadable = |cause| Fault::Unreadable {
            path: within.clone(),
            cause,
        };
        for entry in fs::read_dir(&within).map_err(unreadable)? {
            let path = entry.map_err(unreadable)?.path();
            let own = OWN.iter().any(|name| path.ends_with(name));
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "html") && !own {
                let text = fs::read_to_string(&path).map_err(unreadable)?;
                pages.insert(path, text);
            }
        }
    }
    let places: HashMap<&Path, HashSet<&str>> = pages
        .iter()
        .map(|(path, text)| {
            (
                path.as_path(),
                values(text, "id").map(|(_, id)| id).collect(),
            )
        })
        .collect();
    let wrong = pages.iter().flat_map(|(path, text)| {
        let links = values(text, "href").chain(values(text, "src"));
        let wrong = links.filter_map(|(tag, target)| leads_nowhere(path, tag, target, &places));
        let place = path.strip_prefix(folder).unwrap_or(path);
        wrong.map(|wrong| Breach {
            place: place.display().to_string(),
            wrong,
        })
    });
    let mut wrong: Vec<Breach> = wrong.collect();
    wrong.sort_by(|a, b| a.place.cmp(&b.place));
    Ok(wrong)
}

/// Fault of a link of a page.
fn leads_nowhere(
    page: &Path,
    tag: &str,
    target: &str,
    places: &HashMap<&Path, HashSet<&str>>,
) -> Option<String> {
    if target.contains("://") || target.starts_with("//") {
        return (tag != "a").then(|| format!("asks for `{target}` from a network"));
    }
    if target.starts_with("data:") || target.starts_with("mailto:") {
        return None;
    }
    let (path, place) = target.split_once('#').unwrap_or((target, ""));
    let file = match path.split('?').next().unwrap_or_default() {
        "" => page.to_owned(),
        path => resolved(page.parent().unwrap_or(Path::new("")), path),
    };
    if !file.exists() {
        return Some(format!("`{target}` leads nowhere"));
    }
    let known = places.get(file.as_path());
    let there = place.is_empty() || known.is_none_or(|ids| ids.contains(place));
    (!there).then(|| format!("`{target}`: there is no such place"))
}

fn resolved(folder: &Path, path: &str) -> PathBuf {
    let mut file = folder.to_owned();
    for part in path.split('/') {
        match part {
            "." | "" => {}
            ".." => {
                file.pop();
            }
            part => file.push(part),
        }
    }
    file
}

/// Names of tags and values of an attribute, wherever a tag has it.
fn values<'a>(text: &'a str, attribute: &'a str) -> impl Iterator<Item = (&'a str, &'a str)> {
    let start = format!(" {attribute}=\"");
    let tags = text.split('<').skip(1);
    tags.filter_map(move |tag| {
        let tag = tag.split_once('>').map_or(tag, |(inside, _)| inside);
        let mut words = tag.split(start.as_str());
        let name = words.next()?.split_whitespace().next()?;
        let value = words.next()?.split('"').next()?;
        (name != "base").then_some((name, value))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attributes_are_found_in_tags_alone() {
        let text = r##"<a class="x" href="a.html#b">href="no"</a><h2 id="b">B</h2><br>"##;
        assert_eq!(
            values(text, "href").collect::<Vec<_>>(),
            [("a", "a.html#b")]
        );
        assert_eq!(values(text, "id").collect::<Vec<_>>(), [("h2", "b")]);
    }

    #[test]
    fn networks_and_missing_places_are_told() {
        let page = Path::new("/nowhere/a.html");
        let places = HashMap::from([(page, HashSet::from(["here"]))]);
        let told = |tag, target| leads_nowhere(page, tag, target, &places);
        assert!(told("a", "https://example.org").is_none());
        assert!(told("script", "https://example.org/x.js").is_some());
        assert!(told("img", "b.png").unwrap().contains("nowhere"));
        assert_eq!(
            resolved(Path::new("/a/b"), "../c/./d.html"),
            Path::new("/a/c/d.html")
        );
    }
}
