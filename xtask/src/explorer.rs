//! `cargo xtask explorer`: the page that shows the model in a browser.

mod tools;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use anyhow::{Context, Result, bail};
use clap::Args;

use crate::output::{complain, say};
use crate::workspace::{cargo, in_workspace, target_folder};

/// The package, its library, and the page that runs it.
const PACKAGE: &str = "bouncing-disk-web";
const LIBRARY: &str = "bouncing_disk_web";
const PAGE: &str = "crates/bouncing-disk-web/page";

/// The compilation target.
const TARGET: &str = "wasm32-unknown-unknown";

#[derive(Args, Debug)]
pub(crate) struct Options {
    /// Write explorer.html, which holds everything, to this folder [default: explorer in cargo's target folder].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Where the page will be published: links copied from the file on a disk lead there. Without it they have
    /// the address in crates/bouncing-disk-web/page/index.html.
    #[arg(long, value_name = "URL")]
    address: Option<String>,
    /// Serve the page on this machine alone when it is built, by Python's web server, until interrupted.
    #[arg(long)]
    serve: bool,
    /// The port of --serve; 0 takes any that is free.
    #[arg(long, value_name = "PORT", default_value_t = 8080, requires = "serve")]
    port: u16,
    /// Another rustc, such as a distribution's, that has or can build the standard library for
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
    // Said now, and not after ten minutes.
    if let Some(address) = &options.address
        && !address.is_empty()
        && !["https://", "http://"].iter().any(|scheme| address.starts_with(scheme))
    {
        bail!("--address {address} is not the address of a page: it must begin with https://");
    }
    tools::complain_of_missing(options.rustc.as_deref(), options.build_std)?;
    let target = target_folder()?;
    let out = options.out.as_ref().map_or(target.join("explorer"), |out| in_workspace("").join(out));
    complain!("Building the explorer in 4 steps: about ten minutes the first time, a minute or two later");
    let module = out.join("module");
    bound(options, &target, &module)?;
    let page = in_workspace(PAGE);
    complain!("3/4 The page's packages, from npm: a few seconds");
    // Install exactly the packages of the lock file, without running their scripts: they bring their programs
    // ready to use.
    succeed(tools::npm().current_dir(&page).args(["ci", "--no-audit", "--no-fund", "--loglevel=error"]))?;
    complain!("4/4 The page: a few seconds");
    succeed(
        Command::new("node")
            .current_dir(&page)
            .args(["build.mjs", "--check", "--wasm"])
            .arg(module.join(format!("{LIBRARY}_bg.wasm")))
            .arg("--glue")
            .arg(module.join(format!("{LIBRARY}.js")))
            .arg("--out")
            .arg(&out)
            .args(options.address.as_ref().map(|address| format!("--address={address}"))),
    )?;
    say!("{}", out.join("explorer.html").display())?;
    if options.serve {
        let mut server = Command::new("python3");
        server.args(["-m", "http.server", "--bind", "127.0.0.1", "--directory"]).arg(&out);
        succeed(server.arg(options.port.to_string()))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Writes the module and its JavaScript bindings into a folder.
fn bound(options: &Options, target: &Path, folder: &Path) -> Result<()> {
    complain!("1/4 The library as a WebAssembly module: a minute or two");
    let module = compiled(options, target)?;
    std::fs::create_dir_all(folder).with_context(|| format!("{} cannot be made", folder.display()))?;
    complain!("2/4 The bindings to JavaScript: a few seconds, the first time a few minutes");
    let wasm_bindgen = tools::wasm_bindgen(&target.join("explorer-tools"))?;
    succeed(
        Command::new(wasm_bindgen)
            .args([
                "--target",
                "no-modules",
                "--no-typescript",
                "--remove-name-section",
                "--remove-producers-section",
                "--out-name",
                LIBRARY,
                "--out-dir",
            ])
            .arg(folder)
            .arg(module),
    )
}

/// The module as the compiler leaves it.
fn compiled(options: &Options, target: &Path) -> Result<PathBuf> {
    let mut build = cargo();
    build.args(["build", "--profile", "web", "--package", PACKAGE, "--lib", "--target", TARGET, "--locked"]);
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
    Ok(target.join(TARGET).join("web").join(format!("{LIBRARY}.wasm")))
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
