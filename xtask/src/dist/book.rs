//! The book as a site: the pages of `docs` behind the README, with the files that they link to, the gallery
//! and the explorer.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Component, Path};

use anyhow::{Result, bail};

use super::{Workshop, copy, copy_folder, files_below, read, write};
use crate::explorer::succeed;
use crate::workspace::{DOCS_FOLDER, in_workspace};

const SETTINGS: &str = "[book]\ntitle = \"A bouncing disk\"\nlanguage = \"en\"\n\n\
                        [output.html]\nno-section-label = true\ninput-404 = \"\"\nadditional-css = [\"wide.css\"]\n\
                        playground.runnable = false\n";
/// Tables of numbers are wider than mdBook's column.
const STYLE: &str = ":root { --content-max-width: 1000px; }\n";
/// The page that becomes the site's first.
const FRONT: &str = "README.md";
/// Where the files lie that are no pages of the book.
const SOURCES: &str = "source";
const LIVE: &str = "# Gallery and explorer\n\n\
    - [The gallery](gallery/index.html): the figures and tables of the paper, recomputed, with their data, \
    and each printed number against the computed one.\n\
    - [The explorer](explorer/index.html): tosses, orbit diagrams, basins and motors, computed as you watch; \
    one file, to keep and to give to others.\n";

/// Builds the site; the explorer and the figures are made already.
pub(super) fn book(workshop: &Workshop, figures: &Path) -> Result<()> {
    let folder = workshop.built.join("book");
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    let pages = folder.join("src");
    write(&folder.join("book.toml"), SETTINGS)?;
    write(&folder.join("wide.css"), STYLE)?;
    let docs = in_workspace(DOCS_FOLDER);
    let mut others = BTreeSet::new();
    write(&pages.join(FRONT), &linked_in_book(FRONT, &read(&in_workspace(FRONT))?, &mut others))?;
    for path in files_below(&docs)? {
        if path.extension().is_some_and(|ending| ending == "md") {
            let name = format!("{DOCS_FOLDER}/{}", path.display()).replace('\\', "/");
            write(&pages.join(&path), &linked_in_book(&name, &read(&docs.join(&path))?, &mut others))?;
        } else {
            copy(&docs.join(&path), &pages.join(&path))?;
        }
    }
    let contents = read(&pages.join("SUMMARY.md"))?;
    let front = format!("# Summary\n\n[A bouncing disk]({FRONT})\n[Gallery and explorer](live.md)\n");
    write(&pages.join("SUMMARY.md"), &contents.replacen("# Summary\n", &front, 1))?;
    write(&pages.join("live.md"), LIVE)?;
    for path in &others {
        let (from, to) = (in_workspace(path), pages.join(place_in_book(path)));
        if !from.is_dir() {
            copy(&from, &to)?;
            continue;
        }
        let files = files_below(&from)?;
        let line = |file: &std::path::PathBuf| format!("<li><a href=\"{0}\">{0}</a>\n", file.display());
        write(&to, &format!("<!DOCTYPE html>\n<ul>\n{}</ul>\n", files.iter().map(line).collect::<String>()))?;
        copy_folder(&from, &to.with_file_name(""))?;
    }
    gallery(figures, &pages.join("gallery"))?;
    copy(&workshop.out.join("explorer/explorer.html"), &pages.join("explorer/index.html"))?;
    let site = workshop.folder("book")?;
    succeed(workshop.mdbook()?.arg("build").arg(&folder).arg("--dest-dir").arg(&site))?;
    let broken = broken_links(&site)?;
    if !broken.is_empty() {
        bail!("the book has links that lead nowhere:\n{}", broken.join("\n"));
    }
    Ok(())
}

/// Copies the gallery without the run times, which no other machine shares.
fn gallery(from: &Path, to: &Path) -> Result<()> {
    for path in files_below(from)? {
        let ending = path.extension().unwrap_or_default();
        let is_shown = ["csv", "json", "png", "svg"].iter().any(|shown| ending == *shown);
        if path.components().count() == 1 && is_shown {
            copy(&from.join(&path), &to.join(&path))?;
        }
    }
    write(&to.join("index.html"), &without_run_times(&read(&from.join("index.html"))?))
}

/// The gallery's line under each figure is "Paper quality, 1.5 s. <a ...".
fn without_run_times(page: &str) -> String {
    let line = |line: &str| match line.split_once(" quality, ") {
        Some((start, rest)) if line.starts_with("<p class=\"files\">") => match rest.split_once(". <a ") {
            Some((_, links)) => format!("{start} quality. <a {links}\n"),
            None => format!("{line}\n"),
        },
        _ => format!("{line}\n"),
    };
    page.lines().map(line).collect()
}

/// A page with the links that lead to other files of the repository, leading there in the book. Files that
/// are no pages are added to the others.
fn linked_in_book(page: &str, text: &str, others: &mut BTreeSet<String>) -> String {
    let folder = Path::new(page).parent().unwrap_or(Path::new(""));
    let depth = Path::new(&place_in_book(page)).components().count() - 1;
    let mut in_code = false;
    let mut written = String::new();
    for line in text.lines() {
        in_code ^= line.starts_with("```");
        let mut parts = line.split("](");
        written += parts.next().unwrap_or_default();
        for part in parts {
            written += "](";
            let (link, _) = part.split_once(')').unwrap_or_default();
            let (path, section) =
                link.split_once('#').map_or((link, ""), |(path, _)| (path, &link[path.len()..]));
            if in_code || path.is_empty() || link.contains("://") {
                written += part;
                continue;
            }
            let target = normal(&folder.join(path));
            if target != FRONT && !target.starts_with("docs/") {
                others.insert(target.clone());
            }
            written +=
                &format!("{}{}{section}{}", "../".repeat(depth), place_in_book(&target), &part[link.len()..]);
        }
        written.push('\n');
    }
    written
}

/// Where a file of the repository lies in the book. Browsers show text that is called so.
fn place_in_book(path: &str) -> String {
    if path == "docs/SUMMARY.md" {
        return "toc.html".to_owned();
    }
    if path == FRONT {
        return path.to_owned();
    }
    if let Some(page) = path.strip_prefix("docs/") {
        return page.to_owned();
    }
    let ending = if in_workspace(path).is_dir() {
        "/index.html"
    } else if path.ends_with(".ipynb") {
        ""
    } else {
        ".txt"
    };
    // mdBook takes what has `.md` in it for a page.
    format!("{SOURCES}/{}{ending}", path.strip_suffix(".md").unwrap_or(path))
}

/// A path without `..`.
fn normal(path: &Path) -> String {
    let mut parts = Vec::new();
    for part in path.components() {
        match part {
            Component::ParentDir => drop(parts.pop()),
            Component::Normal(name) => parts.push(name.to_string_lossy()),
            _ => {}
        }
    }
    parts.join("/")
}

/// The links of all pages of a site that lead to no file of it, or to no place on its page. The explorer has
/// none, but programs that write some.
fn broken_links(site: &Path) -> Result<Vec<String>> {
    let mut pages = BTreeMap::new();
    let files: BTreeSet<_> = files_below(site)?.iter().map(|path| normal(path)).collect();
    for name in files.iter().filter(|name| name.ends_with(".html") && !name.starts_with("explorer/")) {
        pages.insert(name.as_str(), read(&site.join(name))?);
    }
    let mut broken = Vec::new();
    for (name, text) in &pages {
        let folder = Path::new(name).parent().unwrap_or(Path::new(""));
        let links = [" href=\"", " src=\""].into_iter().flat_map(|attribute| text.split(attribute).skip(1));
        for link in links.filter_map(|rest| Some(rest.split_once('"')?.0)) {
            if link.contains(':') {
                continue;
            }
            let (path, section) = link.split_once('#').unwrap_or((link, ""));
            let path = path.split('?').next().unwrap_or_default();
            let target = if path.is_empty() { (*name).to_owned() } else { normal(&folder.join(path)) };
            let is_place = |page: &String| section.is_empty() || page.contains(&format!("id=\"{section}\""));
            if !files.contains(&target) || !pages.get(target.as_str()).is_none_or(is_place) {
                broken.push(format!("{name}: {link}"));
            }
        }
    }
    broken.dedup();
    Ok(broken)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_lead_to_the_same_file_in_the_book() {
        let mut others = BTreeSet::new();
        let page = "[a](../model.md#drag) and [the\nsolver](solver.md), [code](../../xtask/src/main.rs),\n\
                    [front](../../README.md), [here](#b), [far](https://example.org/a.md)\n```\n[a](b.md)\n```\n";
        let linked = linked_in_book("docs/numerics/drives.md", page, &mut others);
        let expected = "[a](../model.md#drag) and [the\nsolver](../numerics/solver.md), [code](../source/xtask/src/main.rs.txt),\n\
                        [front](../README.md), [here](#b), [far](https://example.org/a.md)\n```\n[a](b.md)\n```\n";
        assert_eq!(linked, expected);
        assert_eq!(others.into_iter().collect::<Vec<_>>(), ["xtask/src/main.rs"]);
        let front =
            linked_in_book(FRONT, "[a](docs/numerics.md) [b](LICENSE-MIT) [c](docs)", &mut BTreeSet::new());
        assert_eq!(front, "[a](numerics.md) [b](source/LICENSE-MIT.txt) [c](source/docs/index.html)\n");
    }

    #[test]
    fn a_link_to_no_file_and_one_to_no_place_are_broken() {
        let site = tempfile::tempdir().expect("writable");
        let page = "<a href=\"b/c.html#here\"><a href=\"#d\"><img src=\"e.png?1\"><a href=\"mailto:f\"><h1 id=\"d\">";
        write(&site.path().join("a.html"), page).expect("writable");
        write(&site.path().join("e.png"), "").expect("writable");
        write(&site.path().join("b/c.html"), "<p id=\"here\"><a href=\"../a.html#d\">").expect("writable");
        assert!(broken_links(site.path()).expect("readable").is_empty());
        write(&site.path().join("b/c.html"), "<a href=\"../a.html#x\"><img src=\"e.png\">")
            .expect("writable");
        let broken = broken_links(site.path()).expect("readable");
        assert_eq!(broken, ["a.html: b/c.html#here", "b/c.html: ../a.html#x", "b/c.html: e.png"]);
    }

    #[test]
    fn the_gallery_is_published_without_run_times() {
        let line = "<p class=\"files\">Paper quality, 2 min 5 s. <a href=\"fig01.json\">data</a></p>\n";
        let shown = "<p class=\"files\">Paper quality. <a href=\"fig01.json\">data</a></p>\n<p>\n";
        assert_eq!(without_run_times(&format!("{line}<p>\n")), shown);
    }
}
