//! Where a command has its parameters from, the same for a system and for a motor.

use std::fmt::Debug;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use bouncing_disk::regular_file;
use clap::{Args, ValueEnum};
use serde::de::DeserializeOwned;

use crate::context::Context;
use crate::failure::Failure;
use crate::output::OutputArgs;
use crate::output::lines::visible;
use crate::range::{Words, one_of};

/// Parameters that a file can describe.
pub(crate) trait Described: Clone + Debug + Send + Sync + 'static {
    /// Those of the paper; the first are the default ones.
    const PRESETS: Words<fn() -> Self>;

    /// Reads a file; the settings take the place of what it says before anything is checked, so that they can
    /// put a wrong file right.
    ///
    /// # Errors
    /// [`Refusal`] says whether the text or a value is at fault.
    fn read(text: &str, format: Format, settings: &[Setting]) -> Result<Self, Refusal>;

    /// The same with other values.
    ///
    /// # Errors
    /// Names the key, or the value that is not legal.
    fn with(self, settings: &[Setting]) -> Result<Self, String>;

    /// A file that is read to the same parameters, with comments.
    fn template(&self) -> String;
}

/// Why a file gives no parameters.
pub(crate) enum Refusal {
    Text(String),
    /// A value, of the file or of a setting.
    Value(String),
}

/// A file, a preset, and single values.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Parameters")]
pub(crate) struct SourceArgs<D: Described> {
    /// A file of parameters, .toml or .json, in SI units; --template writes one
    #[arg(help_heading = None)]
    pub(crate) file: Option<PathBuf>,
    /// Parameters of the paper, in place of a file
    #[arg(long, conflicts_with = "file", value_name = "NAME", value_parser = one_of(D::PRESETS))]
    pub(crate) preset: Option<fn() -> D>,
    /// Gives a parameter another value, by its key in the file and in its unit: KEY=VALUE; may be repeated
    #[arg(long, value_name = "KEY=VALUE")]
    pub(crate) set: Vec<Setting>,
    /// Writes the parameters as a commented TOML file, to the terminal or with --out FILE.toml into a file,
    /// and computes nothing
    #[arg(long)]
    pub(crate) template: bool,
}

impl<D: Described> SourceArgs<D> {
    /// The file that is read, if any.
    pub(crate) fn inputs(&self) -> Vec<&Path> {
        self.file.as_deref().into_iter().collect()
    }

    /// Whether the user names parameters; otherwise they are the default ones.
    pub(crate) fn is_given(&self) -> bool {
        self.file.is_some() || self.preset.is_some() || !self.set.is_empty()
    }

    /// The parameters.
    ///
    /// # Errors
    /// [`Failure::Usage`] names the file, the line and the key.
    pub(crate) fn get(&self) -> Result<D, Failure> {
        let Some(path) = &self.file else {
            let preset = self.preset.unwrap_or(D::PRESETS[0].2);
            let built = preset().with(&self.set);
            return built.map_err(|why| Failure::usage(format!("--set: {why}")));
        };
        let name = path.display();
        let (text, format) = read_text(path)?;
        D::read(&text, format, &self.set).map_err(|refusal| match refusal {
            Refusal::Value(why) if !self.set.is_empty() => {
                Failure::usage(format!("{name} with --set: {why}"))
            }
            Refusal::Text(why) | Refusal::Value(why) => Failure::usage(format!("{name}: {why}")),
        })
    }

    /// The parameters; `None` if the template was requested, which is then written.
    pub(crate) fn unless_template(
        &self,
        output: &OutputArgs,
        context: Context,
    ) -> Result<Option<D>, Failure> {
        let parameters = self.get()?;
        if self.template {
            output.write_template(&parameters.template(), context.quiet)?;
        }
        Ok((!self.template).then_some(parameters))
    }

    /// The same, if the result can be written.
    pub(crate) fn begin(
        &self,
        output: &OutputArgs,
        has_picture: bool,
        context: Context,
    ) -> Result<Option<D>, Failure> {
        if !self.template {
            output.check(has_picture, &self.inputs(), None)?;
        }
        self.unless_template(output, context)
    }
}

/// A key and the number that it is given on the command line. Whether there is such a key, and whether the
/// number is legal, is seen where it is set.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Setting {
    pub(crate) key: String,
    pub(crate) value: f64,
}

impl FromStr for Setting {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let Some((key, value)) = text.split_once('=') else {
            return Err("a setting is KEY=VALUE, such as disk.friction=0.2".to_owned());
        };
        let number = value.trim().parse();
        let value = number.map_err(|_| format!("{:?} is no number", visible(value.trim())))?;
        Ok(Self { key: key.trim().to_owned(), value })
    }
}

/// That there is no such key, and which one may be meant: also who leaves out the table is shown the whole
/// path.
pub(super) fn unknown<'k>(key: &str, known: impl Iterator<Item = &'k str>) -> String {
    let known: Vec<&str> = known.collect();
    let likeness = |path: &str| {
        let name = path.rsplit('.').next().unwrap_or(path);
        strsim::jaro_winkler(path, key).max(strsim::jaro_winkler(name, key))
    };
    let best = known.iter().copied().max_by(|one, other| likeness(one).total_cmp(&likeness(other)));
    let shown = visible(&key.chars().take(60).collect::<String>());
    match best.filter(|name| likeness(name) > 0.8) {
        Some(name) => format!("the key \"{shown}\" is unknown; did you mean \"{name}\"?"),
        None => format!("the key \"{shown}\" is unknown; the known ones are {}", known.join(", ")),
    }
}

/// The formats of a file of parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    Json,
    Toml,
}

/// The largest file of parameters that is read (bytes): a hundred times that of any.
const LARGEST: u64 = 1 << 20;

fn read_text(path: &Path) -> Result<(String, Format), Failure> {
    let name = path.display();
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    let format = Format::from_str(&ending, true)
        .map_err(|_| Failure::usage(format!("{name}: a file of parameters ends in .json or .toml")))?;
    let unreadable = |why: &str| Failure::usage(format!("{name} cannot be read: {why}"));
    let bytes = regular_file::read(path, LARGEST).map_err(|error| unreadable(&error.to_string()))?;
    let text = String::from_utf8(bytes).map_err(|_| unreadable("it is no text in UTF-8"))?;
    // Some editors put a byte-order mark before the text.
    Ok((text.trim_start_matches('\u{feff}').to_owned(), format))
}

/// Reads the table of a text.
///
/// # Errors
/// Names the line.
pub(super) fn parse<T: DeserializeOwned>(text: &str, format: Format) -> Result<T, String> {
    match format {
        Format::Json => serde_json::from_str(text).map_err(|error| {
            let whole = error.to_string();
            // The reader appends the place.
            let place = format!(" at line {} column {}", error.line(), error.column());
            let reason = whole.strip_suffix(&place).unwrap_or(&whole);
            format!("line {}: {}", error.line().max(1), in_words(reason))
        }),
        Format::Toml => toml::from_str(text).map_err(|error| {
            let place = error.span().map_or(0, |span| span.start);
            let line = 1 + text.bytes().take(place).filter(|byte| *byte == b'\n').count();
            format!("line {line}: {}", in_words(error.message().trim()))
        }),
    }
}

/// The words of a reader; those on an unknown key, which has the known ones after it, name the nearest.
fn in_words(reason: &str) -> String {
    match reason.strip_prefix("unknown field ") {
        Some(keys) => {
            let mut keys = keys.split('`').skip(1).step_by(2);
            unknown(keys.next().unwrap_or_default(), keys)
        }
        // The type is a programmer's word.
        None => visible(&reason.replace("expected f64", "expected a number")),
    }
}
