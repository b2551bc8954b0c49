//! `cargo xtask explorer`: the page that shows the model in a browser.

mod tools;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use anyhow::{Context, Result, bail};
use clap::Args;

use crate::output::say;
use crate::workspace::{cargo, in_workspace};

/// The package, its library, and the page that runs it.
const PACKAGE: &str = "bouncing-disk-web";
const LIBRARY: &str = "bouncing_disk_web";
const PAGE: &str = "crates/bouncing-disk-web/page";

/// The compilation target.
const TARGET: &str = "wasm32-unknown-unknown";

#[derive(Args, Debug)]
pub(crate) struct Options {
    /// Write the page to this folder: explorer.html, which holds everything, and site/, the same in several
    /// files for a web server.
    #[arg(long, value_name = "DIR", default_value = "target/explorer")]
    out: PathBuf,
    /// Serve the page on this machine alone when it is built, by Python's web server, until interrupted.
    #[arg(long)]
    serve: bool,
    /// Build no page, but its module with what computes the digests of results, and compare these in Node
    /// with those of x86-64.
    #[arg(long, conflicts_with = "serve")]
    digests: bool,
    /// The port of --serve; 0 takes any that is free.
    #[arg(long, value_name = "PORT", default_value_t = 8080, requires = "serve")]
    port: u16,
    /// Another rustc, such as that of a distribution, which has or can build the standard library of
    /// WebAssembly.
    #[arg(long, value_name = "PATH")]
    rustc: Option<PathBuf>,
    /// Build the standard library of WebAssembly from the sources of that rustc, where it is not installed.
    #[arg(long)]
    build_std: bool,
    /// The linker of WebAssembly, where rustc has none of its own.
    #[arg(long, value_name = "PATH")]
    linker: Option<PathBuf>,
}

pub(crate) fn run(options: &Options) -> Result<ExitCode> {
    tools::complain_of_missing(options.rustc.as_deref(), options.build_std)?;
    let out =
        if options.out.is_absolute() { options.out.clone() } else { in_workspace("").join(&options.out) };
    if options.digests {
        digests_compared(options, &out.join("digests"))?;
        return Ok(ExitCode::SUCCESS);
    }
    let module = out.join("module");
    bound(&compiled(options, &[])?, &module)?;
    let page = in_workspace(PAGE);
    // Install exactly the packages of the lock file, without running their scripts: they bring their programs
    // ready to use.
    succeed(tools::npm().current_dir(&page).args(["ci", "--no-audit", "--no-fund", "--loglevel=error"]))?;
    succeed(
        Command::new("node")
            .current_dir(&page)
            .args(["build.mjs", "--check", "--wasm"])
            .arg(module.join(format!("{LIBRARY}_bg.wasm")))
            .arg("--glue")
            .arg(module.join(format!("{LIBRARY}.js")))
            .arg("--out")
            .arg(&out),
    )?;
    say!("{}", out.join("explorer.html").display())?;
    if options.serve {
        let mut server = Command::new("python3");
        server.args(["-m", "http.server", "--bind", "127.0.0.1", "--directory"]).arg(out.join("site"));
        succeed(server.arg(options.port.to_string()))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Fails where WebAssembly gives other bits than the machine that the digests were stored on.
fn digests_compared(options: &Options, folder: &Path) -> Result<()> {
    bound(&compiled(options, &["digests"])?, folder)?;
    let test = in_workspace(PAGE).join("tests").join("digests.test.mjs");
    succeed(Command::new("node").arg("--test").arg(test).env("EXPLORER_MODULE", folder))
}

/// Writes the module and what binds it to JavaScript into a folder.
fn bound(module: &Path, folder: &Path) -> Result<()> {
    std::fs::create_dir_all(folder).with_context(|| format!("{} cannot be made", folder.display()))?;
    let wasm_bindgen = tools::wasm_bindgen(&in_workspace("target/explorer-tools"))?;
    succeed(
        Command::new(wasm_bindgen)
            .args(["--target", "no-modules", "--no-typescript", "--out-name", LIBRARY, "--out-dir"])
            .arg(folder)
            .arg(module),
    )
}

/// The module as the compiler leaves it.
fn compiled(options: &Options, features: &[&str]) -> Result<PathBuf> {
    let folder = in_workspace("target");
    let mut build = cargo();
    build.args(["build", "--profile", "web", "--package", PACKAGE, "--lib", "--target", TARGET, "--locked"]);
    build.arg("--features").arg(features.join(","));
    build.arg("--target-dir").arg(&folder);
    if let Some(rustc) = &options.rustc {
        build.env("RUSTC", rustc);
    }
    if let Some(linker) = &options.linker {
        build.env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", linker);
    }
    if options.build_std {
        // The option is not stable, although what it is used for here is.
        build.env("RUSTC_BOOTSTRAP", "1").arg("-Zbuild-std=std,panic_abort");
    }
    succeed(&mut build)?;
    Ok(folder.join(TARGET).join("web").join(format!("{LIBRARY}.wasm")))
}

/// Runs a program that reports its own errors.
pub(crate) fn succeed(command: &mut Command) -> Result<()> {
    let name = Path::new(command.get_program()).display().to_string();
    let status = command.status().with_context(|| format!("{name} cannot be run"))?;
    if !status.success() {
        bail!("{name} failed ({status})");
    }
    Ok(())
}
