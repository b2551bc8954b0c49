//! The result of a command, in every form that a user may request.

use bouncing_disk::store::{Format, Provenance};
use bouncing_disk_plot::Figure;
use serde::Serialize;
use serde_json::Value;

use super::files::{Kind, OutputArgs, Target, no_picture};
use super::json::{self, Data};
use super::lines::say;
use super::table::WriteTable;
use crate::failure::Failure;

/// The name of the program in what it writes, and its version.
pub(crate) const PROGRAM: &str = env!("CARGO_PKG_NAME");
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The result of a command.
pub(crate) struct Report {
    /// Of what, and from what.
    pub(crate) provenance: Provenance,
    /// The text for the terminal.
    pub(crate) text: String,
    /// Writes what goes into a comma-separated file.
    pub(crate) table: WriteTable,
    /// The fields of the JSON file after the provenance, in their order.
    pub(crate) data: Vec<(&'static str, Data)>,
    /// The picture, drawn on request; `None` for a result without one.
    pub(crate) figure: Option<Box<dyn Fn() -> Figure>>,
}

impl Report {
    /// Prints the result, or writes it to the requested files.
    pub(crate) fn deliver(&self, output: &OutputArgs, quiet: bool) -> Result<(), Failure> {
        if output.out.is_empty() {
            return Ok(say(&self.text)?);
        }
        output.out.iter().try_for_each(|target| self.write(target, output.force, quiet))
    }

    fn write(&self, target: &Target, replace: bool, quiet: bool) -> Result<(), Failure> {
        let figure = || self.figure.as_ref().map(|draw| draw()).ok_or_else(no_picture);
        match target.kind {
            Kind::Csv => {
                let provenance = value(&self.provenance)?;
                target.write(replace, quiet, |to| {
                    writeln!(to, "# provenance: {provenance}")?;
                    (self.table)(to)
                })
            }
            Kind::Json => {
                let provenance = stored(&self.provenance)?;
                let data = self.data.iter().map(|(name, data)| (*name, data));
                let fields = [("provenance", &provenance)].into_iter().chain(data);
                target.write(replace, quiet, |to| json::write(to, fields))
            }
            Kind::Png => {
                let bytes = figure()?.to_png()?;
                target.write(replace, quiet, |to| to.write_all(&bytes))
            }
            Kind::Svg => {
                let text = figure()?.to_svg()?;
                target.write(replace, quiet, |to| to.write_all(text.as_bytes()))
            }
            Kind::Toml => Err(target.no_result()),
        }
    }
}

/// A value as JSON. One that cannot be stored is a defect, and reported as a failure.
pub(crate) fn value(of: &(impl Serialize + ?Sized)) -> Result<Value, Failure> {
    serde_json::to_value(of).map_err(|error| Failure::failed(format!("a result cannot be stored: {error}")))
}

/// A value as a field of a file of JSON.
pub(crate) fn stored(of: &(impl Serialize + ?Sized)) -> Result<Data, Failure> {
    Ok(value(of)?.into())
}

/// The provenance of a command's result: each field of `job` is a parameter.
pub(crate) fn provenance(name: &'static str, job: &(impl Serialize + ?Sized)) -> Result<Provenance, Failure> {
    let format = Format { name, version: 1, oldest: 1 };
    let mut provenance = Provenance::new(format).written_by(PROGRAM, VERSION);
    if let Value::Object(fields) = value(job)? {
        for (name, value) in &fields {
            provenance = provenance.with(name, value)?;
        }
    }
    Ok(provenance)
}
