//! Digests of everything that determines a result, so that finished figures can be recognised as up to date.
//!
//! A figure depends on the libraries that this crate is built with, on all shared code of this crate, on the
//! lock file and the data, and on its own module, `src/figures/ID.rs` and the folder `src/figures/ID`. A
//! module that names another one (`fig06::`, a shared helper) depends on that one too, and a library on those
//! that its manifest names. Naming is what counts: depending on too much only recomputes too much. The other
//! crates do not count: what they write below their folders while they are built, such as the page's packages
//! from npm, would make every figure look out of date. A user's own measurements are not known when this is
//! built; `src/cache_key.rs` sees them when a figure is made.

use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::fmt::Write as _;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

/// Files that only list experiments; adding one to them changes no other. They may hold no function that a
/// figure uses.
const LISTS: [&str; 2] = ["src/registry.rs", "src/figures.rs"];

fn main() -> Result<(), Box<dyn Error>> {
    let package = PathBuf::from(std::env::var("CARGO_MANIFEST_DIR")?);
    let root = package.parent().ok_or("the package lies in the workspace")?.to_owned();
    let figures = package.join("src/figures");
    let mut libraries = BTreeSet::new();
    named_libraries(&package, &root.join("crates"), &mut libraries)?;
    let parts = ["Cargo.toml", "Cargo.lock", "data/cases", "data/paper", "experiments"];
    let mut shared = Vec::new();
    for path in parts.iter().map(|part| root.join(part)).chain(libraries) {
        println!("cargo:rerun-if-changed={}", path.display());
        collect(&path, &mut shared)?;
    }
    shared
        .retain(|path| !path.starts_with(&figures) && !LISTS.iter().any(|list| *path == package.join(list)));
    let mut modules: BTreeMap<String, Vec<PathBuf>> = BTreeMap::new();
    let mut files = Vec::new();
    collect(&figures, &mut files)?;
    for file in files {
        let inside = file.strip_prefix(&figures)?.with_extension("");
        if let Some(name) = inside.iter().next().and_then(|name| name.to_str()) {
            modules.entry(name.to_owned()).or_default().push(file.clone());
        }
    }
    let shared = digest(&root, &shared)?;
    let mut code = format!("const SHARED: &str = \"{shared}\";\nconst MODULES: &[(&str, &str)] = &[\n");
    for name in modules.keys() {
        let mut needed = BTreeSet::new();
        closure(name, &modules, &mut needed)?;
        let files: Vec<_> = needed.iter().flat_map(|name| modules[*name].iter().cloned()).collect();
        writeln!(code, "    (\"{name}\", \"{}\"),", digest(&root, &files)?)?;
    }
    code.push_str("];\n");
    let target = PathBuf::from(std::env::var("OUT_DIR")?).join("digests.rs");
    fs::write(target, code)?;
    Ok(())
}

/// The folders of all crates in `crates` that the manifest of `package` names, and the manifests of those in
/// turn.
pub(crate) fn named_libraries(
    package: &Path,
    crates: &Path,
    libraries: &mut BTreeSet<PathBuf>,
) -> Result<(), Box<dyn Error>> {
    let manifest = fs::read_to_string(package.join("Cargo.toml"))?;
    let named: BTreeSet<_> =
        manifest.lines().filter_map(|line| line.split(['.', '=']).next()).map(str::trim).collect();
    for entry in fs::read_dir(crates)? {
        let entry = entry?;
        let path = entry.path();
        if named.contains(entry.file_name().to_string_lossy().as_ref()) && libraries.insert(path.clone()) {
            named_libraries(&path, crates, libraries)?;
        }
    }
    Ok(())
}

/// All files below a path, in a fixed order; a missing path has none.
fn collect(path: &Path, files: &mut Vec<PathBuf>) -> Result<(), Box<dyn Error>> {
    if path.is_dir() {
        let mut entries =
            fs::read_dir(path)?.map(|entry| Ok(entry?.path())).collect::<std::io::Result<Vec<_>>>()?;
        entries.sort();
        for entry in entries {
            // Snapshots and test leftovers do not determine a result.
            let name = entry.file_name().and_then(|name| name.to_str()).unwrap_or_default();
            if !matches!(name, "target" | "tests" | "benches" | "examples" | "snapshots")
                && !name.starts_with('.')
            {
                collect(&entry, files)?;
            }
        }
    } else if path.is_file() {
        files.push(path.to_owned());
    }
    Ok(())
}

fn digest(root: &Path, files: &[PathBuf]) -> Result<String, Box<dyn Error>> {
    let mut hasher = DefaultHasher::new();
    for file in files {
        file.strip_prefix(root)?.to_string_lossy().replace('\\', "/").hash(&mut hasher);
        fs::read(file)?.hash(&mut hasher);
    }
    Ok(format!("{:016x}", hasher.finish()))
}

/// The module and all modules it names, directly or not.
fn closure<'a>(
    name: &'a str,
    modules: &'a BTreeMap<String, Vec<PathBuf>>,
    needed: &mut BTreeSet<&'a str>,
) -> Result<(), Box<dyn Error>> {
    if !needed.insert(name) {
        return Ok(());
    }
    for file in &modules[name] {
        let text = String::from_utf8_lossy(&fs::read(file)?).into_owned();
        for other in modules.keys() {
            if text.contains(&format!("{other}::")) || text.contains(&format!("::{other}")) {
                closure(other, modules, needed)?;
            }
        }
    }
    Ok(())
}
