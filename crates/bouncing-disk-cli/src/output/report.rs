//! The result of a command, in every form that it may be asked for.

use bouncing_disk::{Format, Provenance};
use bouncing_disk_plot::Figure;
use serde::Serialize;
use serde_json::Value;

use super::files::{Kind, Target};
use super::json;
use super::lines::{complain, say};
use super::table::Table;
use crate::arguments::OutputArgs;
use crate::failure::Failure;

/// The name of the program in what it writes.
pub(crate) const PROGRAM: &str = env!("CARGO_PKG_NAME");
/// Its version.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// What a command has found.
pub(crate) struct Report {
    /// Of what, and from what.
    pub(crate) provenance: Provenance,
    /// What is printed.
    pub(crate) text: String,
    /// What goes into a comma-separated file, made when it is asked for: that of a large map takes much
    /// memory.
    pub(crate) table: Box<dyn Fn() -> Table>,
    /// The fields of the JSON file after the provenance, in their order.
    pub(crate) data: Vec<(&'static str, Value)>,
    /// The picture, drawn when it is asked for; `None` of what has none.
    pub(crate) figure: Option<Box<dyn Fn() -> Figure>>,
}

impl Report {
    /// The bytes of a file.
    fn bytes(&self, kind: Kind) -> Result<Vec<u8>, Failure> {
        let figure = || self.figure.as_ref().map(|draw| draw()).ok_or_else(no_picture);
        Ok(match kind {
            Kind::Csv => {
                let provenance = value(&self.provenance)?;
                format!("# provenance: {provenance}\n{}", (self.table)().to_csv()).into_bytes()
            }
            Kind::Json => {
                let provenance = value(&self.provenance)?;
                let data = self.data.iter().map(|(name, value)| (*name, value));
                json::object([("provenance", &provenance)].into_iter().chain(data)).into_bytes()
            }
            Kind::Png => figure()?.to_png()?,
            Kind::Svg => figure()?.to_svg()?.into_bytes(),
        })
    }

    /// Prints the result, or writes it to the files that are asked for.
    pub(crate) fn deliver(&self, output: &OutputArgs, quiet: bool) -> Result<(), Failure> {
        if output.out.is_empty() {
            return Ok(say!("{}", self.text.trim_end())?);
        }
        for target in &output.out {
            target.write(&self.bytes(target.kind)?, output.force)?;
            wrote(target, quiet);
        }
        Ok(())
    }
}

/// A table that is there already.
pub(crate) fn ready(table: Table) -> Box<dyn Fn() -> Table> {
    Box::new(move || table.clone())
}

/// Says that a file is there.
pub(crate) fn wrote(target: &Target, quiet: bool) {
    if !quiet {
        complain!("wrote {target}");
    }
}

/// Why there is no picture.
pub(crate) fn no_picture() -> Failure {
    Failure::usage("this command has no picture; .csv and .json are possible")
}

/// A value as JSON. What cannot be stored is a defect, and told as a failure.
pub(crate) fn value(of: &(impl Serialize + ?Sized)) -> Result<Value, Failure> {
    serde_json::to_value(of).map_err(|error| Failure::failed(format!("a result cannot be stored: {error}")))
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
