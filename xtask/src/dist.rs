//! `cargo xtask dist`: everything that is given to others, in one folder, with checksums
//! (docs/publishing.md).

mod book;

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use anyhow::{Context, Result, bail};
use clap::{Args, ValueEnum};

use crate::explorer::succeed;
use crate::output::{complain, say};
use crate::workspace::{cargo, in_workspace};

/// The published crates, each after those that it needs.
const CRATES: [&str; 5] =
    ["bouncing-disk-core", "bouncing-disk", "bouncing-disk-plot", "bouncing-disk-fmu", "bouncing-disk-cli"];
/// What comes from PyPI: other versions may write other bytes.
const TOOLS: [&str; 3] = ["maturin==1.16.0", "ziglang==0.17.1", "cargo-zigbuild==0.24.1"];
const MDBOOK: &str = "0.5.4";
/// The oldest C library that the wheel and the program run on, where zig links them: that of manylinux2014.
const OLDEST_GLIBC: &str = "2.17";
/// Checksums of all files in the folder, as `sha256sum --check` reads them. A folder without is unfinished.
const SUMS: &str = "SHA256SUMS";
/// Archives and checksums, by Python's standard library.
const PACK: &str = include_str!("dist/pack.py");

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Part {
    /// The packages for crates.io, each built from what it holds.
    Crates,
    /// The wheel and the source distribution for PyPI.
    Wheel,
    /// The explorer: one file, and the same for a web server.
    Explorer,
    /// The book as a site, with the gallery and the explorer in it.
    Book,
    /// The command line for this kind of machine, with the library of its mock-up units.
    Program,
}

impl Part {
    /// The start of the names of its files.
    const fn folder(self) -> &'static str {
        match self {
            Self::Crates => "crates/",
            Self::Wheel => "python/",
            Self::Explorer => "explorer/",
            Self::Book => "book/",
            Self::Program => "program/",
        }
    }
}

#[derive(Args, Debug)]
pub(crate) struct Options {
    /// Make these parts alone.
    #[arg(value_enum, value_name = "PART", default_values = ["crates", "wheel", "explorer", "book", "program"])]
    parts: Vec<Part>,
    /// The folder to write to, from the root of the workspace.
    #[arg(long, value_name = "DIR", default_value = "target/dist")]
    out: PathBuf,
    /// Make the parts a second time, from a clone of the last commit in another place, and fail where any file
    /// differs.
    #[arg(long)]
    twice: bool,
    /// Do not build the crates from their packages.
    #[arg(long)]
    no_verify: bool,
    /// Options of `cargo xtask explorer`, such as another compiler.
    #[arg(last = true)]
    explorer: Vec<OsString>,
}

pub(crate) fn run(options: &Options) -> Result<ExitCode> {
    if options.twice && !git_says(&["status", "--porcelain"])?.is_empty() {
        bail!("only what is committed can be made a second time");
    }
    let out = in_workspace("").join(&options.out);
    fs::create_dir_all(&out).with_context(|| format!("{} cannot be made", out.display()))?;
    if out.join(SUMS).exists() {
        fs::remove_file(out.join(SUMS)).context("the old checksums cannot be removed")?;
    }
    let workshop = Workshop::new(&out)?;
    let asked = |part| options.parts.contains(&part);
    if asked(Part::Crates) {
        workshop.crates(options.no_verify)?;
    }
    if asked(Part::Wheel) {
        workshop.wheel()?;
    }
    if asked(Part::Program) {
        workshop.program()?;
    }
    if asked(Part::Explorer) || asked(Part::Book) {
        workshop.explorer(&options.explorer)?;
    }
    if asked(Part::Book) {
        book::book(&workshop, crate::figures::of_the_paper(&workshop.built.join("figures"))?.path())?;
    }
    succeed(workshop.python().args(["-c", PACK, "sums"]).arg(&out).arg(SUMS))?;
    say!("{}", out.join(SUMS).display())?;
    if options.twice { compared_with_another(options, &out) } else { Ok(ExitCode::SUCCESS) }
}

/// The programs that make the parts, and what makes them write the same bytes anywhere.
struct Workshop {
    out: PathBuf,
    tools: PathBuf,
    /// Where cargo builds: the flags are others than those of a developer's build, and would undo it.
    built: PathBuf,
    /// The last commit's time: a file in an archive is as old.
    time: String,
    flags: String,
    cargo_home: PathBuf,
}

impl Workshop {
    fn new(out: &Path) -> Result<Self> {
        let tools = in_workspace("target/dist-tools");
        let time = match std::env::var("SOURCE_DATE_EPOCH") {
            Ok(time) => time,
            Err(_) => git_says(&["log", "-1", "--format=%ct"])
                .context("without git, SOURCE_DATE_EPOCH must say how old the sources are")?,
        };
        // The places of this copy and of cargo's in messages are nobody's business, and differ.
        let home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
        let home = home.or_else(|| std::env::home_dir().map(|home| home.join(".cargo")));
        let home = home.context("cargo's home is not known")?;
        let remap = |place: &Path, name| format!("--remap-path-prefix={}={name}", place.display());
        let flags = [remap(&in_workspace(""), "/bouncing-disk/"), remap(&home, "/cargo")].join(" ");
        let built = in_workspace("target/dist-build");
        let workshop = Self { out: out.to_owned(), tools, built, time, flags, cargo_home: home };
        let python = if cfg!(windows) { "python" } else { "python3" };
        if !workshop.scripts().is_dir() {
            succeed(Command::new(python).args(["-m", "venv"]).arg(workshop.tools.join("python")))?;
        }
        let mut install = workshop.python();
        succeed(
            install.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]).args(TOOLS),
        )?;
        Ok(workshop)
    }

    /// The folder of a part, emptied.
    fn folder(&self, part: &str) -> Result<PathBuf> {
        let folder = self.out.join(part);
        if folder.exists() {
            fs::remove_dir_all(&folder).with_context(|| format!("{} stays", folder.display()))?;
        }
        fs::create_dir_all(&folder).with_context(|| format!("{} cannot be made", folder.display()))?;
        Ok(folder)
    }

    fn scripts(&self) -> PathBuf {
        self.tools.join("python").join(if cfg!(windows) { "Scripts" } else { "bin" })
    }

    /// A program with the same times, places and flags anywhere.
    fn steady(&self, mut command: Command) -> Command {
        command.env("SOURCE_DATE_EPOCH", &self.time).env("CARGO_TARGET_DIR", &self.built);
        // Cargo adds these to the flags of .cargo/config.toml.
        command.env("CARGO_BUILD_RUSTFLAGS", &self.flags);
        command.env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS", &self.flags);
        // The tools look for each other.
        let path = std::env::var_os("PATH").unwrap_or_default();
        let path = std::env::join_paths([self.scripts()].into_iter().chain(std::env::split_paths(&path)));
        command.envs(path.map(|path| ("PATH", path)));
        command
    }

    /// One of the tools from PyPI.
    fn tool(&self, name: &str) -> Command {
        self.steady(Command::new(self.scripts().join(format!("{name}{}", std::env::consts::EXE_SUFFIX))))
    }

    fn python(&self) -> Command {
        self.tool("python")
    }

    /// Another chore of this program.
    fn xtask(&self, chore: &str) -> Result<Command> {
        let mut command = Command::new(std::env::current_exe().context("this program has no place")?);
        command.arg(chore);
        Ok(self.steady(command))
    }

    fn crates(&self, no_verify: bool) -> Result<()> {
        self.forget_unpacked_crates()?;
        let folder = self.folder("crates")?;
        let mut package = self.steady(cargo());
        package.args(["package", "--locked", "--allow-dirty", "--quiet"]);
        package.args(no_verify.then_some("--no-verify"));
        succeed(package.args(CRATES.map(|name| ["--package", name]).as_flattened()))?;
        for name in CRATES {
            let name = format!("{name}-{}.crate", env!("CARGO_PKG_VERSION"));
            copy(&self.built.join("package").join(&name), &folder.join(&name))?;
        }
        Ok(())
    }

    /// Cargo keeps the packages of this workspace that it unpacked to build from, and takes them for those of
    /// today: the version is the same.
    fn forget_unpacked_crates(&self) -> Result<()> {
        let Ok(registries) = fs::read_dir(self.cargo_home.join("registry/src")) else { return Ok(()) };
        // The folders of registries that are no server's begin so.
        for registry in registries.flatten().filter(|folder| folder.file_name().as_encoded_bytes()[0] == b'-')
        {
            for name in CRATES {
                let unpacked = registry.path().join(format!("{name}-{}", env!("CARGO_PKG_VERSION")));
                if unpacked.exists() {
                    fs::remove_dir_all(&unpacked).with_context(|| format!("{} stays", unpacked.display()))?;
                }
            }
        }
        Ok(())
    }

    fn wheel(&self) -> Result<()> {
        let folder = self.folder("python")?;
        let maturin = |verb: &str| {
            let mut maturin = self.tool("maturin");
            maturin.current_dir(in_workspace("crates/bouncing-disk-python"));
            maturin.args([verb, "--out"]).arg(&folder);
            maturin
        };
        succeed(&mut maturin("sdist"))?;
        let mut build = maturin("build");
        build.args(["--release", "--locked"]);
        if cfg!(target_os = "linux") {
            build.args(["--zig", "--compatibility", "manylinux2014"]);
        }
        succeed(&mut build)
    }

    fn program(&self) -> Result<()> {
        let folder = self.folder("program")?;
        let target = format!("{}-{}", std::env::consts::ARCH, std::env::consts::OS);
        // Apart from the wheel, whose linker is another one: each would undo what the other has built.
        let mut built = self.built.join("program");
        let mut build = self.steady(cargo());
        build.arg("build");
        if cfg!(target_os = "linux") {
            let target = format!("{}-unknown-linux-gnu", std::env::consts::ARCH);
            build = self.tool("cargo-zigbuild");
            build.args(["zigbuild", "--target", &format!("{target}.{OLDEST_GLIBC}")]);
            built.push(target);
        }
        build.current_dir(in_workspace("")).env("CARGO_TARGET_DIR", self.built.join("program"));
        build.args([
            "--release",
            "--locked",
            "--package",
            "bouncing-disk-cli",
            "--package",
            "bouncing-disk-fmu",
        ]);
        succeed(&mut build)?;
        let program = format!("bouncing-disk{}", std::env::consts::EXE_SUFFIX);
        let name = format!("bouncing-disk-{}-{target}", env!("CARGO_PKG_VERSION"));
        let mut pack = self.python();
        pack.args(["-c", PACK, "archive"]).arg(folder.join(format!("{name}.tar.gz"))).arg(name);
        let library = format!("{DLL_PREFIX}bouncing_disk_fmu{DLL_SUFFIX}");
        pack.args([program, library].map(|name| built.join("release").join(name)));
        succeed(pack.args(["LICENSE-APACHE", "LICENSE-MIT", "CHANGELOG.md"].map(in_workspace)))
    }

    fn explorer(&self, options: &[OsString]) -> Result<()> {
        let built = self.built.join("explorer");
        let mut explorer = self.xtask("explorer")?;
        explorer.arg("--tools").arg(in_workspace("target/explorer-tools")).arg("--out").arg(&built);
        succeed(explorer.args(options))?;
        copy(&built.join("explorer.html"), &self.folder("explorer")?.join("explorer.html"))
    }

    /// mdBook, compiled once and without optimisation: it runs for seconds.
    fn mdbook(&self) -> Result<Command> {
        let root = self.tools.join(format!("mdbook-{MDBOOK}"));
        let program = root.join("bin").join(format!("mdbook{}", std::env::consts::EXE_SUFFIX));
        if !program.is_file() {
            let mut install = cargo();
            install.args(["install", "mdbook", "--debug", "--quiet", "--locked", "--no-default-features"]);
            install.args(["--features", "search", "--version", MDBOOK, "--root"]).arg(&root);
            succeed(&mut install)?;
        }
        Ok(self.steady(Command::new(program)))
    }
}

/// Makes all of it again in another place, and names the files that differ.
fn compared_with_another(options: &Options, first: &Path) -> Result<ExitCode> {
    // Not below this copy: cargo would read its configuration twice.
    let copy = std::env::temp_dir().join(format!("bouncing-disk-dist-{}", std::process::id()));
    succeed(Command::new("git").args(["clone", "--quiet"]).arg(in_workspace("")).arg(&copy))?;
    let target = copy.join("target");
    fs::create_dir_all(&target).with_context(|| format!("{} cannot be made", target.display()))?;
    for tools in ["dist-tools", "explorer-tools"] {
        succeed(Command::new("ln").arg("-s").arg(in_workspace("target").join(tools)).arg(&target))?;
    }
    let mut again = cargo();
    again.current_dir(&copy).env("CARGO_TARGET_DIR", &target);
    again.args(["run", "--quiet", "--release", "--package", "xtask", "--", "dist", "--no-verify"]);
    for part in &options.parts {
        again.arg(format!("{part:?}").to_lowercase());
    }
    succeed(again.arg("--").args(&options.explorer))?;
    let sums = [first, &copy.join("target/dist")].map(|folder| read(&folder.join(SUMS)));
    let [first, second] = sums;
    let (first, second) = (first?, second?);
    // Parts that this run has not made are left from an earlier one.
    let made: Vec<_> = options.parts.iter().map(|part| part.folder()).collect();
    let of_parts = |sums: &str| {
        let is_made = |line: &&str| {
            line.split_once("  ").is_some_and(|(_, file)| made.iter().any(|part| file.starts_with(part)))
        };
        sums.lines().filter(is_made).map(|line| format!("{line}\n")).collect::<String>()
    };
    let (first, second) = (of_parts(&first), of_parts(&second));
    let differ = differing(&first, &second);
    differ.iter().for_each(|file| complain!("differs: {file}"));
    say!("{} files, {} of them differ", first.lines().count(), differ.len())?;
    Ok(if differ.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// The names of files that have another checksum in the other list, or stand only in one.
fn differing<'a>(first: &'a str, second: &'a str) -> Vec<&'a str> {
    let alone = |line: &&str, other: &str| !other.lines().any(|theirs| theirs == *line);
    let mut names: Vec<_> = first.lines().filter(|line| alone(line, second)).collect();
    names.extend(second.lines().filter(|line| alone(line, first)));
    let mut names: Vec<_> = names.iter().filter_map(|line| Some(line.split_once("  ")?.1)).collect();
    names.sort_unstable();
    names.dedup();
    names
}

/// What git prints of this copy.
fn git_says(arguments: &[&str]) -> Result<String> {
    let output = Command::new("git").current_dir(in_workspace("")).args(arguments).output();
    let output = output.context("git cannot be run")?;
    if !output.status.success() {
        bail!("git {}: {}", arguments.join(" "), String::from_utf8_lossy(&output.stderr).trim());
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

fn read(path: &Path) -> Result<String> {
    fs::read_to_string(path).with_context(|| format!("{} cannot be read", path.display()))
}

fn write(path: &Path, text: &str) -> Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).with_context(|| format!("{} cannot be made", folder.display()))?;
    }
    fs::write(path, text).with_context(|| format!("{} cannot be written", path.display()))
}

fn copy(from: &Path, to: &Path) -> Result<()> {
    if let Some(folder) = to.parent() {
        fs::create_dir_all(folder).with_context(|| format!("{} cannot be made", folder.display()))?;
    }
    fs::copy(from, to).map(drop).with_context(|| format!("{} cannot be copied", from.display()))
}

/// All files below a folder, as paths from it.
fn files_below(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).with_context(|| format!("{} cannot be read", folder.display()))? {
        let entry = entry?;
        let name = PathBuf::from(entry.file_name());
        if entry.file_type()?.is_dir() {
            found.extend(files_below(&entry.path())?.into_iter().map(|path| name.join(path)));
        } else {
            found.push(name);
        }
    }
    found.sort_unstable();
    Ok(found)
}

fn copy_folder(from: &Path, to: &Path) -> Result<()> {
    files_below(from)?.iter().try_for_each(|path| copy(&from.join(path), &to.join(path)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_with_other_bytes_and_files_that_one_lacks_differ() {
        let (first, second) = ("1  same\n2  other\n3  gone\n", "4  new\n1  same\n5  other\n");
        assert_eq!(differing(first, second), ["gone", "new", "other"]);
        assert!(differing(first, first).is_empty());
    }
}
