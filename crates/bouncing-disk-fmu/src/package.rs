//! The unit as a file: a zip archive of the description, the data sheet and the binary.

use std::fmt::{self, Display, Formatter};
use std::io::{Cursor, Write as _};

use bouncing_disk::Motor;
use bouncing_disk::motor::{MotorInputs, MotorSimulation, SimulationSettings};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use crate::description::{IDENTIFIER, description};

/// The data sheet among the resources.
pub(crate) const SHEET: &str = "motor.json";

/// Why a unit cannot be made of a motor.
#[derive(Debug)]
#[non_exhaustive]
pub enum PackageError {
    /// The motor cannot be simulated step by step.
    Motor(bouncing_disk::Error),
    /// The library is not of this version.
    Library,
    /// The standard has no name for machines of this kind.
    Machine,
    /// The archive cannot be written.
    Archive(String),
}

impl Display for PackageError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Motor(error) => error.fmt(f),
            Self::Library => f.write_str(
                "it is not the library of a functional mock-up unit of this version of bouncing-disk",
            ),
            Self::Machine => f.write_str("FMI 3.0 has no name for this machine"),
            Self::Archive(error) => f.write_str(error),
        }
    }
}

impl std::error::Error for PackageError {}

/// The file name of the library on this machine, as `cargo build --package bouncing-disk-fmu` makes it.
#[must_use]
pub fn library_name() -> String {
    use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
    format!("{DLL_PREFIX}bouncing_disk_fmu{DLL_SUFFIX}")
}

/// A text that every library of this version contains: the end of one of its messages.
const MARK: &str = concat!("made by bouncing-disk ", env!("CARGO_PKG_VERSION"));

/// The unit of a motor as the bytes of an archive, with this library as its binary; equal motors and libraries
/// produce equal bytes.
///
/// # Errors
/// [`PackageError`].
pub fn packed(motor: &Motor, library: &[u8]) -> Result<Vec<u8>, PackageError> {
    MotorSimulation::new(motor, MotorInputs::of(motor), SimulationSettings::default())
        .map_err(PackageError::Motor)?;
    let holds = |text: &[u8]| library.windows(text.len()).any(|part| part == text);
    if !holds(MARK.as_bytes()) || !holds(b"fmi3InstantiateCoSimulation") {
        return Err(PackageError::Library);
    }
    let system = match std::env::consts::OS {
        known @ ("linux" | "windows") => known,
        "macos" => "darwin",
        _ => return Err(PackageError::Machine),
    };
    let machine = match std::env::consts::ARCH {
        known @ ("x86_64" | "aarch64" | "x86") => known,
        _ => return Err(PackageError::Machine),
    };
    let binary = format!("binaries/{machine}-{system}/{IDENTIFIER}{}", std::env::consts::DLL_SUFFIX);
    let (text, sheet) = (description(motor), motor.to_json());
    let files = [
        ("modelDescription.xml", text.as_bytes()),
        (&format!("resources/{SHEET}"), sheet.as_bytes()),
        (&binary, library),
    ];
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let options =
        SimpleFileOptions::default().compression_method(CompressionMethod::Stored).unix_permissions(0o755);
    let failed = |error: &dyn Display| PackageError::Archive(error.to_string());
    for (name, bytes) in files {
        archive.start_file(name, options).map_err(|error| failed(&error))?;
        archive.write_all(bytes).map_err(|error| failed(&error))?;
    }
    Ok(archive.finish().map_err(|error| failed(&error))?.into_inner())
}
