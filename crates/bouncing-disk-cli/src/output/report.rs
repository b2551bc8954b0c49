//! The result of a command, in every form that it may be asked for.

use std::io::{self, Write};

use bouncing_disk::{Format, Provenance};
use bouncing_disk_plot::Figure;
use serde::Serialize;
use serde_json::Value;

use super::files::{Kind, Target};
use super::json::{self, Data};
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
    /// Writes what goes into a comma-separated file.
    pub(crate) table: WriteTable,
    /// The fields of the JSON file after the provenance, in their order.
    pub(crate) data: Vec<(&'static str, Data)>,
    /// The picture, drawn when it is asked for; `None` of what has none.
    pub(crate) figure: Option<Box<dyn Fn() -> Figure>>,
}

/// Writes a table as comma-separated text.
pub(crate) type WriteTable = Box<dyn Fn(&mut dyn Write) -> io::Result<()>>;

impl Report {
    /// Writes a file.
    fn write(&self, target: &Target, replace: bool) -> Result<(), Failure> {
        let figure = || self.figure.as_ref().map(|draw| draw()).ok_or_else(no_picture);
        match target.kind {
            Kind::Csv => {
                let provenance = value(&self.provenance)?;
                target.write(replace, |to| {
                    writeln!(to, "# provenance: {provenance}")?;
                    (self.table)(to)
                })
            }
            Kind::Json => {
                let provenance = stored(&self.provenance)?;
                let data = self.data.iter().map(|(name, data)| (*name, data));
                target.write(replace, |to| {
                    json::write(to, [("provenance", &provenance)].into_iter().chain(data))
                })
            }
            Kind::Png => {
                let bytes = figure()?.to_png()?;
                target.write(replace, |to| to.write_all(&bytes))
            }
            Kind::Svg => {
                let text = figure()?.to_svg()?;
                target.write(replace, |to| to.write_all(text.as_bytes()))
            }
            Kind::Toml => Err(no_result(target)),
        }
    }

    /// Prints the result, or writes it to the files that are asked for.
    pub(crate) fn deliver(&self, output: &OutputArgs, quiet: bool) -> Result<(), Failure> {
        if output.out.is_empty() {
            return Ok(say!("{}", self.text.trim_end())?);
        }
        for target in &output.out {
            self.write(target, output.force)?;
            wrote(target, quiet);
        }
        Ok(())
    }
}

/// A table that is there already.
pub(crate) fn ready(table: Table) -> WriteTable {
    Box::new(move |to| table.write_csv(to))
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

/// Why no result goes into a file of parameters.
pub(crate) fn no_result(target: &Target) -> Failure {
    Failure::usage(format!(
        "{target}: a result is .csv, .json, .png or .svg; .toml is the file of --template"
    ))
}

/// A value as JSON. What cannot be stored is a defect, and told as a failure.
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
