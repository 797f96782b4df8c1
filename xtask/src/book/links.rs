//! Links between the Markdown files of the repository: each has to lead to a file that is
//! there, and to a heading that it has. Anchors are those of GitHub and mdBook: lower case,
//! hyphens for spaces, no other punctuation, a number where a heading comes again.

use std::{
    collections::{HashMap, HashSet},
    fs,
    path::{Component, Path, PathBuf},
};

use pulldown_cmark::{Event, Parser, Tag, TagEnd};

use super::mathematics::options;
use crate::{breach::Breach, fault::Fault};

/// Folders with Markdown files.
const FOLDERS: [&str; 4] = ["cases", "crates", "docs", "."];

/// The table of contents of the book.
const SUMMARY: &str = "docs/SUMMARY.md";

/// Links and anchors of a file.
#[derive(Default)]
struct Page {
    /// Lines and targets.
    links: Vec<(usize, String)>,
    anchors: HashSet<String>,
}

/// All links that lead nowhere, and pages of the book that its contents leave out.
///
/// # Errors
/// When a file cannot be read.
pub fn breaches(root: &Path) -> Result<Vec<Breach>, Fault> {
    let mut pages = HashMap::new();
    for path in markdown(root)? {
        let text = fs::read_to_string(&path).map_err(|cause| Fault::Unreadable {
            path: path.clone(),
            cause,
        })?;
        pages.insert(within(root, &path), Page::of(&text));
    }
    let mut breaches: Vec<Breach> = pages
        .iter()
        .flat_map(|(file, page)| {
            let links = page.links.iter();
            links.filter_map(|(line, target)| {
                let wrong = leads_nowhere(root, file, target, &pages)?;
                Some(Breach {
                    place: format!("{}:{line}", file.display()),
                    wrong,
                })
            })
        })
        .collect();
    breaches.extend(left_out(&pages));
    breaches.sort_by(|a, b| a.place.cmp(&b.place));
    Ok(breaches)
}

/// Fault of a link of a file.
fn leads_nowhere(
    root: &Path,
    file: &Path,
    target: &str,
    pages: &HashMap<PathBuf, Page>,
) -> Option<String> {
    if target.contains("://") || target.starts_with("mailto:") {
        return None;
    }
    let (path, anchor) = target.split_once('#').unwrap_or((target, ""));
    let folder = file.parent().unwrap_or(Path::new(""));
    let path = match path {
        "" => file.to_owned(),
        path => plain(&folder.join(path)),
    };
    if !root.join(&path).exists() {
        return Some(format!("`{target}` leads nowhere"));
    }
    let known = |page: &Page| anchor.is_empty() || page.anchors.contains(anchor);
    let page = pages.get(&path);
    (!page.is_none_or(known)).then(|| format!("`{target}`: there is no such heading"))
}

/// Pages below `docs` that the contents of the book do not name.
fn left_out(pages: &HashMap<PathBuf, Page>) -> Vec<Breach> {
    let Some(summary) = pages.get(Path::new(SUMMARY)) else {
        return Vec::new();
    };
    let named: HashSet<PathBuf> = summary
        .links
        .iter()
        .map(|(_, target)| Path::new("docs").join(target))
        .collect();
    let files = pages.keys();
    files
        .filter(|file| file.starts_with("docs") && *file != Path::new(SUMMARY))
        .filter(|file| !named.contains(*file))
        .map(|file| Breach {
            place: file.display().to_string(),
            wrong: format!("is not in {SUMMARY}"),
        })
        .collect()
}

impl Page {
    fn of(text: &str) -> Self {
        let mut page = Self::default();
        let mut heading: Option<String> = None;
        for (event, place) in Parser::new_ext(text, options()).into_offset_iter() {
            match event {
                Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                    let line = text[..place.start].lines().count().max(1);
                    page.links.push((line, dest_url.to_string()));
                }
                Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
                Event::Text(words) | Event::Code(words) => {
                    if let Some(heading) = &mut heading {
                        heading.push_str(&words);
                    }
                }
                Event::End(TagEnd::Heading(_)) => {
                    let anchor = anchor(&heading.take().unwrap_or_default());
                    let mut again = (1..).map(|number| format!("{anchor}-{number}"));
                    let mut own = anchor.clone();
                    while !page.anchors.insert(own.clone()) {
                        own = again.next().expect("there is no end of numbers");
                    }
                }
                _ => {}
            }
        }
        page
    }
}

/// The anchor of a heading.
fn anchor(heading: &str) -> String {
    let letters = heading.trim().to_lowercase();
    let letters = letters.chars().filter_map(|letter| match letter {
        ' ' => Some('-'),
        '-' | '_' => Some(letter),
        other => other.is_alphanumeric().then_some(other),
    });
    letters.collect()
}

/// Markdown files of the repository.
fn markdown(root: &Path) -> Result<Vec<PathBuf>, Fault> {
    let mut files = Vec::new();
    let mut folders: Vec<PathBuf> = FOLDERS.iter().map(|name| root.join(name)).collect();
    while let Some(folder) = folders.pop() {
        let unreadable = |cause| Fault::Unreadable {
            path: folder.clone(),
            cause,
        };
        let top = folder == root;
        for entry in fs::read_dir(&folder).map_err(unreadable)? {
            let path = entry.map_err(unreadable)?.path();
            if path.is_dir() && !top {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "md") {
                files.push(path);
            }
        }
    }
    Ok(files)
}

/// A path within the repository.
fn within(root: &Path, path: &Path) -> PathBuf {
    plain(path.strip_prefix(root).unwrap_or(path))
}

/// A path without `.` and `..`.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                plain.pop();
            }
            other => plain.push(other),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_link_of_the_repository_leads_somewhere() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
        let found = breaches(root).unwrap();
        let lines: Vec<String> = found.iter().map(Breach::to_string).collect();
        assert!(found.is_empty(), "{}", lines.join("\n"));
    }

    #[test]
    fn anchors_are_made_as_readers_find_them() {
        assert_eq!(anchor("What `a`, b & c say: 1.5"), "what-a-b--c-say-15");
        let page = Page::of("# A\n\n## B\n\n[b](#b-1)\n\n## B\n\n`[no](link)`\n");
        assert!(page.anchors.contains("b") && page.anchors.contains("b-1"));
        assert_eq!(page.links, [(4, "#b-1".to_owned())]);
    }

    #[test]
    fn what_leads_nowhere_is_told() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let file = PathBuf::from("docs/a.md");
        let pages = HashMap::from([
            (file.clone(), Page::of("# Known\n")),
            (PathBuf::from("Cargo.toml"), Page::default()),
        ]);
        let told = |target: &str| leads_nowhere(root, &file, target, &pages);
        assert!(told("https://example.org").is_none());
        assert!(told("../Cargo.toml").is_none());
        assert!(told("../Cargo.toml#known").unwrap().contains("heading"));
        assert!(told("b.md").unwrap().contains("nowhere"));
    }
}
