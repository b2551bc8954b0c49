//! Parameters: from a file, a preset, and the command line.

mod document;
pub(crate) mod motor;
pub(crate) mod setting;
mod sheet;
pub(crate) mod system;

use std::path::Path;

use bouncing_disk::regular_file;

use crate::failure::Failure;

/// The largest file of parameters that is read (bytes): a hundred times that of any.
const LARGEST: u64 = 1 << 20;

/// The formats of a file of parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    Json,
    Toml,
}

/// The text of a file of parameters and its format, by its ending.
fn read(path: &Path) -> Result<(String, Format), Failure> {
    let name = path.display();
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    let format = match ending.as_deref() {
        Some("json") => Format::Json,
        Some("toml") => Format::Toml,
        _ => return Err(Failure::usage(format!("{name}: a file of parameters ends in .json or .toml"))),
    };
    let unreadable = |error: String| Failure::usage(format!("{name} cannot be read: {error}"));
    let bytes = regular_file::read(path, LARGEST).map_err(|error| unreadable(error.to_string()))?;
    let text = String::from_utf8(bytes).map_err(|_| unreadable("it is no text in UTF-8".to_owned()))?;
    Ok((text, format))
}
