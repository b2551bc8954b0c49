//! The result of a command in every form: lines on a terminal, tables, files.

pub(crate) mod files;
pub(crate) mod json;
pub(crate) mod table;

use bouncing_disk::store::{Format, Provenance};
use bouncing_disk_plot::Figure;
use serde::Serialize;
use serde_json::Value;

use crate::context::Context;
use crate::failure::{Failure, Result};
use crate::lines::say;
pub(crate) use files::OutputArgs;
use files::{Kind, NO_PICTURE, NO_RESULT, Target};
use json::Data;
pub(crate) use table::{Columns, Quantities, WriteTable};

/// Name and version of the program in its files.
pub(crate) const PROGRAM: &str = env!("CARGO_PKG_NAME");
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

pub(crate) struct Report<'a> {
    /// The program and its inputs.
    pub(crate) provenance: Provenance,
    pub(crate) text: String,
    /// Writes the comma-separated file.
    pub(crate) table: WriteTable<'a>,
    /// The fields of the JSON file after the provenance, in their order.
    pub(crate) data: Vec<(&'static str, Data<'a>)>,
    /// Draws the picture; `None` for results without one.
    pub(crate) figure: Option<Box<dyn Fn() -> Figure + 'a>>,
}

impl Report<'_> {
    /// Prints the result, or writes it to the requested files.
    pub(crate) fn deliver(&self, output: &OutputArgs, context: Context) -> Result<()> {
        if output.out.is_empty() {
            return Ok(say(&self.text)?);
        }
        output.out.iter().try_for_each(|target| self.write(target, output.force, context.quiet))
    }

    fn write(&self, target: &Target, replace: bool, quiet: bool) -> Result<()> {
        let figure =
            || self.figure.as_ref().map(|draw| draw()).ok_or_else(|| Failure::Usage(NO_PICTURE.to_owned()));
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
            Kind::Toml | Kind::Fmu => Err(Failure::Usage(format!("{target}: {NO_RESULT}"))),
        }
    }
}

/// A value as JSON. A value that cannot be stored is a defect, reported as a failure.
pub(crate) fn value(of: &(impl Serialize + ?Sized)) -> Result<Value> {
    serde_json::to_value(of).map_err(|error| Failure::Failed(format!("a result cannot be stored: {error}")))
}

/// A value as a field of a JSON file.
pub(crate) fn stored(of: &(impl Serialize + ?Sized)) -> Result<Data<'static>> {
    Ok(json::whole(value(of)?))
}

/// The provenance of a command's result: each field of `job` is a parameter.
pub(crate) fn provenance(name: &'static str, job: &(impl Serialize + ?Sized)) -> Result<Provenance> {
    let format = Format { name, version: 1, oldest: 1 };
    let mut provenance = Provenance::new(format).written_by(PROGRAM, VERSION);
    if let Value::Object(fields) = value(job)? {
        for (name, value) in &fields {
            provenance = provenance.with(name, value)?;
        }
    }
    Ok(provenance)
}
