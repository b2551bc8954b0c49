//! The program `bouncing-disk`; what it does is in the library of this package.

use std::process::ExitCode;

fn main() -> ExitCode {
    bouncing_disk_cli::run()
}
