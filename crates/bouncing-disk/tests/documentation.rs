//! What the pages written by hand say of the code is so: the tutorial's programs are the examples and print
//! what it says, every file, item, link and section that is named exists, and the contents list every page.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs;
use std::mem;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use bouncing_disk::core::sweep::{orbit_diagram, survival_times};
use bouncing_disk::core::{ChatterPolicy, ImpactMap, ImpactState, Unobserved, Vibration};

/// Pages that nobody writes by hand.
const GENERATED: [&str; 2] = ["docs/results.md", "docs/errata.md"];

/// Lists of what was, with the names of its time.
const RECORDS: [&str; 1] = ["CHANGELOG.md"];

/// Files that a run writes, and that pages may name.
const WRITTEN_BY_A_RUN: [&str; 4] = ["claims.json", "claims.schema.json", "index.html", "sums.json"];

/// Endings by which a word in code type is known as a file.
const ENDINGS: [&str; 7] = [".rs", ".md", ".toml", ".json", ".png", ".csv", ".html"];

/// What is wrong, all of it at once.
#[derive(Default)]
struct Faults(BTreeSet<String>);

impl Faults {
    fn check(&mut self, holds: bool, fault: impl FnOnce() -> String) {
        if !holds {
            self.0.insert(fault());
        }
    }

    fn report(self) {
        assert!(self.0.is_empty(), "{:#?}", self.0);
    }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Folders of the repository; what else may lie in a working copy is nobody's business.
const FOLDERS: [&str; 7] = [".cargo", ".ci", "crates", "data", "docs", "experiments", "xtask"];

/// All files of these folders and beside them, as paths from its root.
fn files() -> Vec<String> {
    fn collect(folder: &Path, prefix: &str, found: &mut Vec<String>) {
        for entry in fs::read_dir(folder).expect("readable") {
            let entry = entry.expect("readable");
            let name = entry.file_name().to_string_lossy().into_owned();
            let path = format!("{prefix}{name}");
            if !entry.file_type().expect("known").is_dir() {
                found.push(path);
            } else if !["node_modules", "target"].contains(&name.as_str())
                && (!prefix.is_empty() || FOLDERS.contains(&name.as_str()))
            {
                collect(&entry.path(), &format!("{path}/"), found);
            }
        }
    }
    let mut found = Vec::new();
    collect(&root(), "", &mut found);
    found.sort_unstable();
    found
}

fn pages() -> Vec<String> {
    let mut pages = files();
    pages.retain(|path| path.ends_with(".md"));
    pages
}

/// Pages whose words about the code are checked.
fn pages_by_hand() -> Vec<String> {
    let mut pages = pages();
    pages.retain(|page| {
        (page == "README.md" || page.starts_with("docs/"))
            && !GENERATED.contains(&page.as_str())
            && !RECORDS.contains(&page.as_str())
    });
    pages
}

/// The lines of a page outside of code blocks.
fn prose(text: &str) -> Vec<&str> {
    let mut in_code = false;
    let mut lines = Vec::new();
    for line in text.lines() {
        if line.starts_with("```") {
            in_code = !in_code;
        } else if !in_code && !line.starts_with("    ") {
            lines.push(line);
        }
    }
    lines
}

/// The words in code type of a line.
fn code_words(line: &str) -> impl Iterator<Item = &str> {
    line.split('`').skip(1).step_by(2)
}

/// The figure that docs/contributing.md adds, which does not exist.
const EXAMPLE_FIGURE: &str = "fig15";

fn is_file_name(word: &str) -> bool {
    let plain = word.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"_-./".contains(&byte));
    let placeholder = word.split(['/', '.']).any(|part| part == "ID");
    plain
        && !placeholder
        && !word.contains(EXAMPLE_FIGURE)
        && !word.starts_with('.')
        && !WRITTEN_BY_A_RUN.iter().any(|written| word.ends_with(written))
        && (word.ends_with('/') && word.len() > 1 || ENDINGS.iter().any(|ending| word.ends_with(ending)))
}

/// The last part of a path of items, `c` of `a::b::c`.
fn item_name(word: &str) -> Option<&str> {
    let name = word.rsplit("::").next()?;
    let legal = |part: &str| {
        part.starts_with(|first: char| first.is_ascii_alphabetic() || first == '_')
            && part.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
    };
    (!word.starts_with(EXAMPLE_FIGURE) && word.split("::").all(legal)).then_some(name)
}

fn words_of_code(text: &str) -> impl Iterator<Item = &str> {
    text.lines()
        .filter(|line| !line.trim_start().starts_with("//"))
        .flat_map(|line| line.split(|letter: char| !(letter.is_ascii_alphanumeric() || letter == '_')))
}

/// The headings of a page as they are written.
fn headings(text: &str) -> Vec<&str> {
    prose(text)
        .into_iter()
        .filter(|line| line.starts_with('#'))
        .map(|line| line.trim_start_matches('#').trim())
        .collect()
}

/// The name by which a link finds a heading.
fn anchor(heading: &str) -> String {
    heading
        .chars()
        .filter_map(|letter| match letter {
            ' ' => Some('-'),
            '-' | '_' => Some(letter),
            _ => letter.is_alphanumeric().then(|| letter.to_lowercase().next().unwrap_or(letter)),
        })
        .collect()
}

/// An example as the tutorial shows it: from its first `use` on.
fn shown(example: &str) -> String {
    let text = read(&format!("crates/bouncing-disk/examples/{example}.rs"));
    let start = text.find("\nuse ").unwrap_or_else(|| panic!("{example} uses nothing"));
    text[start + 1..].to_owned()
}

fn examples() -> Vec<String> {
    let folder = "crates/bouncing-disk/examples/";
    let name = |path: &String| Some(path.strip_prefix(folder)?.strip_suffix(".rs")?.to_owned());
    files().iter().filter_map(name).collect()
}

/// The pages that show programs and what they print.
const TUTORIALS: [&str; 3] =
    ["docs/tutorial.md", "docs/designing-a-motor.md", "docs/studying-the-dynamics.md"];

/// The blocks of a page in this language.
fn fenced(page: &str, language: &str) -> Vec<String> {
    let fence = format!("```{language}\n");
    let body = |part: &str| part.split_once("```").map(|(body, _)| body.to_owned());
    page.split(&fence).skip(1).filter_map(body).collect()
}

/// The blocks of the tutorials in this language.
fn blocks(language: &str) -> Vec<String> {
    TUTORIALS.map(read).iter().flat_map(|page| fenced(page, language)).collect()
}

#[test]
fn the_programs_of_the_tutorial_are_the_examples() {
    let blocks: BTreeSet<String> = blocks("rust").into_iter().collect();
    let mut examples = examples();
    examples.retain(|name| TABLES.iter().all(|(example, _)| example != name));
    let examples: BTreeSet<String> = examples.iter().map(|name| shown(name)).collect();
    assert_eq!(blocks, examples);
}

/// Examples whose program no page shows, and the page that has what they print.
const TABLES: [(&str, &str); 3] = [
    ("contact_times", "docs/contacts-and-stators.md"),
    ("yielding_stator", "docs/contacts-and-stators.md"),
    ("start_up", "docs/numerics-impacts.md"),
];

/// Every line that is printed: a sentence may be broken in two, and a row may go on.
#[test]
fn the_pages_have_the_numbers_that_the_examples_compute() {
    let mut faults = Faults::default();
    let begun: Vec<_> = TABLES.iter().map(|(example, page)| (start(example), *page)).collect();
    for (process, page) in begun {
        let one_space = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        let (text, printed) = (one_space(&read(page)), printed(page, process));
        assert!(printed.lines().count() > 2, "{page}: {printed}");
        for line in printed.lines() {
            faults.check(text.contains(&one_space(line)), || format!("{page} has no: {line}"));
        }
    }
    faults.report();
}

/// An example, begun: `cargo test` builds the examples beside the tests.
fn start(example: &str) -> Child {
    let this = std::env::current_exe().expect("known");
    let folder = this.parent().and_then(Path::parent).expect("a target folder").join("examples");
    let path = folder.join(format!("{example}{}", std::env::consts::EXE_SUFFIX));
    let process = Command::new(&path).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
    process.unwrap_or_else(|error| panic!("{path:?}: {error} (cargo test -p bouncing-disk builds it)"))
}

/// What a program has printed at its end.
fn printed(name: &str, process: Child) -> String {
    let output = process.wait_with_output().expect("ends");
    assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).replace("\r\n", "\n")
}

/// They run here, so that they run wherever the tests do.
#[test]
fn the_examples_print_what_the_tutorial_says() {
    assert_eq!(blocks("rust").len(), blocks("text").len());
    // All are begun before the first is awaited, since each keeps one processor busy.
    let begun: Vec<_> = blocks("rust")
        .iter()
        .map(|program| {
            let name = examples().into_iter().find(|name| shown(name) == *program).expect("an example");
            (start(&name), name)
        })
        .collect();
    for ((process, name), expected) in begun.into_iter().zip(&blocks("text")) {
        assert_eq!(printed(&name, process), *expected, "{name}");
    }
}

/// The crises and the coexisting attractors that the tutorial warns of: each is looked for a hundredth of a
/// forcing to either side.
#[test]
fn what_the_tutorial_says_of_crises_and_attractors_is_so() {
    let map = |forcing: f64, restitution: f64| {
        ImpactMap::new(Vibration::from_axial_forcing(forcing).expect("legal"), restitution).expect("legal")
    };
    let start = |map: &ImpactMap, share: f64| {
        let orbit = map.period_one(1).expect("exists");
        let off = ImpactState::new(orbit.phase(), (1.0 + share) * orbit.velocity()).expect("legal");
        map.orbit(off, ChatterPolicy::Complete)
    };
    let lifetimes = |forcing: f64, restitution: f64| {
        let map = map(forcing, restitution);
        let starts: Vec<_> = (1..=20).map(|k| start(&map, 5e-4 * f64::from(k))).collect();
        survival_times(&starts, 100_000, &Unobserved).expect("no failure")
    };
    let tutorial = read("docs/tutorial.md");
    assert!(tutorial.contains("beyond the crisis (0.56 at restitution 0.5, 0.40 at 0.8)"));
    for (crisis, restitution) in [(0.56, 0.5), (0.40, 0.8)] {
        let below = lifetimes(crisis - 0.01, restitution);
        assert!(below.contains(&100_000), "{restitution}: {below:?}");
        let beyond = lifetimes(crisis + 0.01, restitution);
        assert!(beyond.iter().all(|&impacts| impacts < 100_000), "{restitution}: {beyond:?}");
    }
    let page = tutorial.split_whitespace().collect::<Vec<_>>().join(" ");
    let said = "At restitution 0.8 and Γ = 0.3835 a start 1 % off the period-1 orbit ends on six phases, one 0.1 % off on two.";
    assert!(page.contains(said));
    let map = map(0.3835, 0.8);
    let columns = orbit_diagram(&[start(&map, 0.01), start(&map, 0.001)], 20_000, 512, &Unobserved)
        .expect("no failure");
    let phases = columns.iter().map(|column| {
        column
            .iter()
            .map(|impact| (1e6 * impact.phase().cycles()).round() as i64)
            .collect::<BTreeSet<_>>()
            .len()
    });
    assert_eq!(phases.collect::<Vec<_>>(), [6, 2]);
}

#[test]
fn every_file_that_a_page_names_exists() {
    let mut faults = Faults::default();
    let files = files();
    let exists = |name: &str| {
        let ending = format!("/{name}");
        files.iter().any(|path| {
            path == name
                || path.ends_with(&ending)
                || name.ends_with('/') && (path.starts_with(name) || path.contains(&ending))
        })
    };
    for page in pages_by_hand() {
        let text = read(&page);
        for line in prose(&text) {
            for name in code_words(line).filter(|word| is_file_name(word)) {
                faults.check(exists(name), || format!("{page} names {name}"));
            }
        }
    }
    faults.report();
}

#[test]
fn every_item_that_a_page_names_exists() {
    let mut faults = Faults::default();
    let sources: Vec<String> = files().into_iter().filter(|path| path.ends_with(".rs")).collect();
    let sources: Vec<String> = sources.iter().map(|path| read(path)).collect();
    let known: BTreeSet<&str> = sources.iter().flat_map(|text| words_of_code(text)).collect();
    let crates: Vec<String> = ["crates", "."].iter().flat_map(|folder| folder_names(folder)).collect();
    for page in pages_by_hand() {
        let text = read(&page);
        for line in prose(&text) {
            for name in code_words(line).filter_map(item_name) {
                let is_known = known.contains(name) || crates.iter().any(|known| known == name);
                faults.check(is_known, || format!("{page} names {name}"));
            }
        }
    }
    faults.report();
}

fn folder_names(folder: &str) -> Vec<String> {
    let entries = fs::read_dir(root().join(folder)).expect("readable");
    entries.map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned()).collect()
}

/// The names that a source defines: what follows `fn`, `struct` and their like.
fn definitions(text: &str) -> impl Iterator<Item = &str> {
    const KEYWORDS: [&str; 6] = ["const", "enum", "fn", "struct", "trait", "type"];
    words_of_code(text)
        .scan("", |before, word| Some((mem::replace(before, word), word)))
        .filter_map(|(before, word)| KEYWORDS.contains(&before).then_some(word))
}

/// The table has each equation, figure and table of the paper once, beside items that the libraries define.
#[test]
fn the_map_of_the_paper_is_right() {
    let mut faults = Faults::default();
    let text = read("docs/contributing.md");
    let (_, table) = text.split_once("## Where to find the paper's equations").expect("a section");
    let (table, _) = table.split_once("\n## ").expect("another one");
    let mut libraries = files();
    libraries.retain(|path| {
        path.ends_with(".rs")
            && [
                "crates/bouncing-disk-core/src/",
                "crates/bouncing-disk-drives/src/",
                "crates/bouncing-disk/src/",
            ]
            .iter()
            .any(|folder| path.starts_with(folder))
    });
    let sources: Vec<String> = libraries.iter().map(|path| read(path)).collect();
    let defined: BTreeSet<&str> = sources.iter().flat_map(|text| definitions(text)).collect();
    let mut places = Vec::new();
    for row in table.lines().filter(|line| line.starts_with("| ")).skip(2) {
        places.push(row.split('|').nth(1).expect("a cell").trim().to_owned());
        for item in code_words(row) {
            for name in item.split("::") {
                faults.check(defined.contains(name), || format!("{name} in {row}"));
            }
        }
    }
    let equations = (1..=17).map(|number| format!("Eq. {number}"));
    let figures = (1..=14).map(|number| format!("Fig. {number}"));
    let tables = ["I", "II", "III"].map(|number| format!("Table {number}"));
    assert_eq!(places, equations.chain(figures).chain(tables).collect::<Vec<_>>());
    faults.report();
}

#[test]
fn every_link_leads_somewhere() {
    let mut faults = Faults::default();
    // The sources of a page that is made have the links of that page.
    for page in pages().into_iter().filter(|page| !page.contains("/src/")) {
        let text = read(&page);
        let folder = root().join(&page).parent().expect("a folder").to_owned();
        let prose = prose(&text).join("\n");
        for link in prose.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            if link.contains("://") || link.contains(char::is_whitespace) {
                continue;
            }
            let (path, section) = link.split_once('#').unwrap_or((link, ""));
            let target = if path.is_empty() { root().join(&page) } else { folder.join(path) };
            faults.check(target.exists(), || format!("{page} links to {link}"));
            if !section.is_empty() && target.extension() == Some(OsStr::new("md")) {
                let text = fs::read_to_string(&target).expect("readable");
                let marked = text.contains(&format!("id=\"{section}\""));
                let found = headings(&text).iter().any(|heading| anchor(heading) == section);
                faults.check(marked || found, || format!("{page} links to {link}"));
            }
        }
    }
    faults.report();
}

/// A comment names a page, or a page and then a section in quotation marks.
#[test]
fn every_page_and_section_that_the_code_names_exists() {
    let mut faults = Faults::default();
    let is_name = |letter: char| letter.is_ascii_alphanumeric() || "/_-.".contains(letter);
    let mut named = 0;
    for path in files() {
        let is_text = [".rs", ".toml", ".md"].iter().any(|ending| path.ends_with(ending));
        if !is_text || RECORDS.contains(&path.as_str()) {
            continue;
        }
        let text = read(&path);
        // A comment as one line: what is named may be broken in two.
        let lines = text.lines().map(|line| line.trim_start().trim_start_matches(['/', '!', '#']).trim());
        let text = lines.collect::<Vec<_>>().join(" ");
        for (place, _) in text.match_indices("docs/") {
            let rest = &text[place..];
            let end = rest.find(|letter| !is_name(letter)).unwrap_or(rest.len());
            let Some(end) = rest[..end].rfind(".md").map(|end| end + 3) else { continue };
            let (page, rest) = rest.split_at(end);
            let exists = root().join(page).is_file();
            faults.check(exists, || format!("{path} names {page}"));
            if !exists {
                continue;
            }
            named += 1;
            let rest = rest.trim_start_matches('`');
            faults
                .check(!rest.starts_with(", section "), || format!("{path}: sections of {page} have names"));
            if let Some((section, _)) = rest.strip_prefix(", \"").and_then(|rest| rest.split_once('"')) {
                let found = headings(&read(page)).contains(&section);
                faults.check(found, || format!("{path}: {page} has no \"{section}\""));
            }
        }
    }
    assert!(named > 40, "{named}");
    faults.report();
}

#[test]
fn the_contents_list_every_page() {
    let mut faults = Faults::default();
    let contents = read("docs/SUMMARY.md");
    for page in pages().iter().filter_map(|page| page.strip_prefix("docs/")) {
        let listed = contents.contains(&format!("]({page})"));
        faults.check(listed || page == "SUMMARY.md", || format!("docs/SUMMARY.md does not list {page}"));
    }
    faults.report();
}

/// The modules that a library shows.
fn public_modules(text: &str) -> BTreeSet<&str> {
    let hidden = |before: &str| before.trim() == "#[doc(hidden)]";
    let lines: Vec<&str> = text.lines().collect();
    let shown = lines.windows(2).filter(|pair| !hidden(pair[0])).map(|pair| pair[1]);
    shown.filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';')).collect()
}

/// The libraries that have chapters and rooms: the name in docs/contributing.md, and the folder.
const LIBRARIES: [(&str, &str); 3] = [
    ("core", "crates/bouncing-disk-core/src"),
    ("drives", "crates/bouncing-disk-drives/src"),
    ("model", "crates/bouncing-disk/src"),
];

#[test]
fn every_module_is_a_chapter_of_its_library() {
    let mut faults = Faults::default();
    for (_, folder) in LIBRARIES {
        let text = read(&format!("{folder}/lib.rs"));
        let rows = text.lines().filter(|line| line.starts_with("//! | "));
        let chapters: BTreeSet<&str> = rows.filter_map(|row| code_words(row).next()).collect();
        for module in public_modules(&text) {
            let is_listed = chapters.contains(module) || chapters.contains(&*format!("mod@{module}"));
            faults.check(is_listed, || format!("{folder}/lib.rs has no chapter {module}"));
        }
    }
    faults.report();
}

/// What the library itself, without its tests, takes from other modules of its crate.
fn modules_used_by<'a>(
    texts: &[(String, String)],
    folder: &str,
    room: &str,
    all: &[&'a str],
) -> Vec<&'a str> {
    let own = [format!("{folder}/{room}.rs"), format!("{folder}/{room}/")];
    let is_test = |path: &str| path.contains("/tests/") || path.ends_with("tests.rs");
    let files = texts.iter().filter(|(path, _)| *path == own[0] || path.starts_with(&own[1]));
    let library = files
        .filter(|(path, _)| !is_test(path))
        .map(|(_, text)| text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default());
    let code: String =
        library.flat_map(str::lines).filter(|line| !line.trim_start().starts_with("//")).collect();
    let is_used = |module: &&&str| code.contains(&format!("crate::{module}::"));
    all.iter().filter(is_used).copied().collect()
}

/// Each module of a library stands in the table, and uses only modules before it.
#[test]
fn every_module_is_a_room_in_its_place() {
    let mut faults = Faults::default();
    let architecture = read("docs/contributing.md");
    for (name, folder) in LIBRARIES {
        let mut texts = files();
        texts.retain(|path| path.starts_with(folder) && path.ends_with(".rs"));
        let texts: Vec<_> = texts.into_iter().map(|path| (path.clone(), read(&path))).collect();
        let row = architecture.lines().find(|line| line.starts_with(&format!("| {name} |")));
        let rooms: Vec<&str> =
            code_words(row.expect("a row")).map(|room| room.trim_end_matches('/')).collect();
        let library = read(&format!("{folder}/lib.rs"));
        for module in public_modules(&library) {
            faults.check(rooms.contains(&module), || format!("{name} has no room {module}"));
        }
        for (place, room) in rooms.iter().enumerate() {
            for used in modules_used_by(&texts, folder, room, &rooms) {
                let is_before = rooms[..=place].contains(&used);
                faults.check(is_before, || format!("{name}: {room} uses {used}, which comes after it"));
            }
        }
    }
    faults.report();
}
