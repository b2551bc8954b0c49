//! The parts of a figure or table of the paper: data, drawing, claims.

use std::fmt;
use std::str::FromStr;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::store::{Format, Provenance, StorageError};
use bouncing_disk_plot::{DrawError, Figure};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::claims::catalogue::CatalogueError;
use crate::claims::{Claim, answers};
use crate::json::{self, FiniteError};
use crate::progress::Progress;
use crate::provenance;

/// How finely an experiment samples its parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Quality {
    /// Coarse grids: seconds per figure, for tests.
    Draft,
    /// The grids of the published pictures.
    #[default]
    Paper,
}

impl Quality {
    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Draft => "draft",
            Self::Paper => "paper",
        }
    }

    /// One of two values, by quality: `quality.choose(50, 400)` grid lines in draft and in paper quality.
    pub fn choose<T>(self, draft: T, paper: T) -> T {
        match self {
            Self::Draft => draft,
            Self::Paper => paper,
        }
    }
}

impl fmt::Display for Quality {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}

/// A quality that is neither `draft` nor `paper`.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown quality \"{given}\": draft or paper")]
pub struct UnknownQuality {
    /// The given text.
    pub given: String,
}

impl FromStr for Quality {
    type Err = UnknownQuality;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "draft" => Ok(Self::Draft),
            "paper" => Ok(Self::Paper),
            _ => Err(UnknownQuality { given: text.to_owned() }),
        }
    }
}

/// Why an experiment gave no result. The cause is the [source](std::error::Error::source); [`chain`] shows
/// all.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExperimentError {
    /// The model refused a parameter or could not finish a trajectory.
    #[error("the model failed")]
    Model(#[source] Box<dyn std::error::Error + Send + Sync>),
    /// The figure could not be drawn.
    #[error("the figure could not be drawn")]
    Draw(#[from] DrawError),
    /// The data cannot be stored: a number is infinite or not a number.
    #[error("the data cannot be stored")]
    Data(#[from] FiniteError),
    /// Stored data do not have the form this version reads.
    #[error("the stored data do not fit this version")]
    Stored(#[source] serde_json::Error),
    /// The origin of a file cannot be stored, or is of a newer format.
    #[error(transparent)]
    Provenance(Box<StorageError>),
    /// A number printed in the paper could not be read.
    #[error("the catalogue of printed numbers failed")]
    Catalogue(#[from] CatalogueError),
    /// A number or statement has no data to be judged by.
    #[error("\"{quantity}\" has no data to be judged by")]
    NoData {
        /// The number or statement.
        quantity: String,
    },
    /// An input file (a table of the paper) could not be read.
    #[error("cannot read {path}")]
    Input {
        /// The file.
        path: std::path::PathBuf,
        /// The report of the system or the parser.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
}

impl From<StorageError> for ExperimentError {
    fn from(error: StorageError) -> Self {
        Self::Provenance(Box::new(error))
    }
}

impl From<bouncing_disk::estimate::FitError> for ExperimentError {
    fn from(error: bouncing_disk::estimate::FitError) -> Self {
        Self::model(error)
    }
}

impl From<bouncing_disk::Error> for ExperimentError {
    fn from(error: bouncing_disk::Error) -> Self {
        Self::model(error)
    }
}

impl From<bouncing_disk::core::Error> for ExperimentError {
    fn from(error: bouncing_disk::core::Error) -> Self {
        Self::model(error)
    }
}

impl ExperimentError {
    /// Wraps an error of the model: `model.run(..)?`.
    pub fn model(error: impl std::error::Error + Send + Sync + 'static) -> Self {
        Self::Model(Box::new(error))
    }
}

/// An error with all its causes, on one line.
pub fn chain(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        text.push_str(&format!(": {error}"));
        cause = error.source();
    }
    text
}

/// One figure or table of the paper.
///
/// Everything is an associated function: an experiment has no state besides its data.
pub trait Experiment: Sync + Send + 'static {
    /// The computed numbers: plain, serialisable, units in the field names. A number that does not exist is
    /// an `Option`, never a NaN: storing a number that is not finite is an error.
    type Data: Serialize + DeserializeOwned + Send + Sync + 'static;

    /// `fig01` ... `fig14`, `table1` ... `table3`.
    const ID: &'static str;

    /// A short title for the gallery and for lists.
    const TITLE: &'static str;

    /// A description of the figure, in a paragraph for `docs/results.md`. `{section4.merging}` stands for the computed number of the claim that answers this entry of the
    /// [catalogue](crate::claims::catalogue).
    const DISCUSSION: &'static str = "";
    /// How a chattering sequence ends in the picture, if it shows one. A figure that compares both policies
    /// says so in its data.
    const CHATTER_POLICY: Option<ChatterPolicy> = None;

    /// The random draws and their seeds; the first is *the* seed of the figure.
    fn seeds() -> Vec<(&'static str, u64)> {
        Vec::new()
    }

    /// The caption, plain text with Unicode Greek.
    fn caption(data: &Self::Data) -> String;

    /// Computes the data. Deterministic: the same bits on every machine and with every number of threads.
    fn compute(quality: Quality, progress: &dyn Progress) -> Result<Self::Data, ExperimentError>;

    /// Draws the data.
    fn draw(data: &Self::Data) -> Result<Figure, ExperimentError>;

    /// Every number and statement the paper prints about this figure, compared with the data, each taken from
    /// the [catalogue](crate::claims::catalogue) by its key. Entries of the catalogue that have a reason why
    /// nothing can be computed are added by the framework.
    fn claims(_data: &Self::Data) -> Vec<Claim> {
        Vec::new()
    }

    /// Name and value with unit, for the gallery.
    fn parameters(_data: &Self::Data) -> Vec<(String, String)> {
        Vec::new()
    }
}

/// [`Experiment::parameters`] of known names.
pub(crate) fn named<const N: usize>(parameters: [(&str, String); N]) -> Vec<(String, String)> {
    parameters.map(|(name, value)| (name.to_owned(), value)).to_vec()
}

/// Data of an experiment, whatever their type, and all that is made from them.
#[derive(Debug)]
pub struct Made {
    /// The data as JSON.
    pub data: Value,
    /// See [`Experiment::caption`].
    pub caption: String,
    /// See [`Experiment::parameters`].
    pub parameters: Vec<(String, String)>,
    /// See [`Experiment::claims`]; with those of entries that nothing can be computed for.
    pub claims: Vec<Claim>,
    /// See [`Experiment::draw`].
    pub figure: Figure,
}

impl Made {
    fn of<E: Experiment>(data: &E::Data) -> Result<Self, ExperimentError> {
        let mut claims = E::claims(data);
        claims.extend(answers::not_computable(E::ID));
        if let Some(claim) = claims.iter().find(|claim| claim.lacks_data()) {
            return Err(ExperimentError::NoData { quantity: claim.quantity.clone() });
        }
        Ok(Self {
            data: json::to_value(data)?,
            caption: E::caption(data),
            parameters: E::parameters(data),
            claims,
            figure: E::draw(data)?,
        })
    }
}

/// An experiment whose data type is erased, so that a list can hold all of them.
#[derive(Debug)]
pub struct RegisteredExperiment {
    /// See [`Experiment::ID`].
    pub id: &'static str,
    /// See [`Experiment::TITLE`].
    pub title: &'static str,
    /// See [`Experiment::DISCUSSION`].
    pub discussion: &'static str,
    /// See [`Experiment::seeds`].
    pub seeds: Vec<(&'static str, u64)>,
    /// See [`Experiment::CHATTER_POLICY`].
    pub chatter_policy: Option<ChatterPolicy>,
    compute: fn(Quality, &dyn Progress) -> Result<Made, ExperimentError>,
    read: fn(&[u8]) -> Result<Stored, ExperimentError>,
}

/// The type-erased form of the experiment `E`.
pub fn entry<E: Experiment>() -> RegisteredExperiment {
    RegisteredExperiment {
        id: E::ID,
        title: E::TITLE,
        discussion: E::DISCUSSION,
        seeds: E::seeds(),
        chatter_policy: E::CHATTER_POLICY,
        compute: |quality, progress| Made::of::<E>(&E::compute(quality, progress)?),
        read: |bytes| {
            let record: Record<E::Data> = serde_json::from_slice(bytes).map_err(ExperimentError::Stored)?;
            Ok((Made::of::<E>(&record.data)?, record.quality, record.provenance))
        },
    }
}

/// The name and content of a file.
pub type File = (String, Vec<u8>);

/// What is made from stored data, and their quality and origin.
pub type Stored = (Made, Quality, Provenance);

/// The part of `ID.json` that every version has.
#[derive(Deserialize)]
struct Origin {
    provenance: Option<Value>,
}

/// The contents of `ID.json`.
#[derive(Serialize, Deserialize)]
struct Record<Data> {
    /// The first part of a file of any format version to be read.
    provenance: Provenance,
    id: String,
    title: String,
    quality: Quality,
    caption: String,
    parameters: Vec<(String, String)>,
    data: Data,
}

impl RegisteredExperiment {
    /// Runs the experiment.
    pub fn compute(&self, quality: Quality, progress: &dyn Progress) -> Result<Made, ExperimentError> {
        (self.compute)(quality, progress)
    }

    /// The origin of a file of this format. Where the experiment has several seeds, the first is *the* seed,
    /// and all of them are among the parameters, by the names of their draws.
    pub fn provenance(&self, format: Format, quality: Quality) -> Result<Provenance, StorageError> {
        let mut provenance = provenance::new(format).with("figure", self.id)?.with("quality", &quality)?;
        if let Some((_, first)) = self.seeds.first() {
            provenance = provenance.with_seed(*first);
        }
        if self.seeds.len() > 1 {
            provenance = provenance.with("seeds", &self.seeds)?;
        }
        if let Some(policy) = self.chatter_policy {
            provenance = provenance.with_chatter_policy(policy);
        }
        Ok(provenance)
    }

    /// Runs the experiment and makes its files, `ID.json` and `ID.svg`, which say where they come from ([`provenance`]), and
    /// `ID.png`.
    pub fn files(&self, quality: Quality, progress: &dyn Progress) -> Result<Vec<File>, ExperimentError> {
        let Made { data, caption, parameters, figure, .. } = self.compute(quality, progress)?;
        let provenance = self.provenance(provenance::FIGURE, quality)?.with("values", &parameters)?;
        let png = figure.to_png()?;
        let svg = provenance::in_svg(&provenance, &figure.to_svg()?).into_bytes();
        let (id, title) = (self.id.to_owned(), self.title.to_owned());
        let record = Record { provenance, id, title, quality, caption, parameters, data };
        let json = json::to_text(&json::to_value(&record)?).into_bytes();
        let id = self.id;
        Ok(vec![(format!("{id}.png"), png), (format!("{id}.svg"), svg), (format!("{id}.json"), json)])
    }

    /// Reads the data that [`Self::files`] stored in `ID.json`, and the quality and origin of these.
    pub fn read(&self, bytes: &[u8]) -> Result<Stored, ExperimentError> {
        // Before anything else: a newer one may have any other form.
        let Origin { provenance } = serde_json::from_slice(bytes).map_err(ExperimentError::Stored)?;
        provenance::refuse_newer(provenance::FIGURE, provenance.as_ref(), &format!("{}.json", self.id))?;
        (self.read)(bytes)
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::progress::Silent;
    use crate::testing::demo_entries;

    #[test]
    fn files_are_the_same_bytes_on_every_run_say_their_origin_and_read_back() {
        let demo = &demo_entries()[0];
        let make = || demo.files(Quality::Draft, &Silent).expect("works");
        let files = make();
        assert_eq!(files, make());
        let names: Vec<_> = files.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["demo.png", "demo.svg", "demo.json"]);
        let (made, quality, origin) = demo.read(&files[2].1).expect("fits");
        assert_eq!((quality, made.claims.len()), (Quality::Draft, 1));
        let parameters = origin.parameters();
        assert_eq!((&parameters["figure"], &parameters["quality"]), (&"demo".into(), &"draft".into()));
        assert_eq!(parameters["values"], serde_json::json!([["restitution ε", "0.5"]]));
        assert_eq!((origin.seed(), origin.chatter_policy()), (Some(3), Some(ChatterPolicy::Complete)));
        let svg = provenance::in_svg(&origin, &made.figure.to_svg().expect("draws"));
        assert_eq!(svg.into_bytes(), files[1].1);
    }

    #[test]
    fn a_figure_says_what_was_computed() {
        let entries = demo_entries();
        let stored = json!(entries[0].provenance(provenance::FIGURE, Quality::Draft).expect("storable"));
        assert_eq!(stored["program"], "bouncing-disk-experiments");
        assert_eq!(stored["version"], env!("CARGO_PKG_VERSION"));
        assert_eq!(stored["format_version"], provenance::FIGURE.version);
        let seeds = json!([["points", 3], ["others", 4]]);
        assert_eq!(stored["parameters"], json!({"figure": "demo", "quality": "draft", "seeds": seeds}));
        assert_eq!((&stored["seed"], &stored["chatter_policy"]), (&json!(3), &json!("Complete")));
        // Without seed or policy, too, both are there.
        let none = json!(entries[1].provenance(provenance::CLAIM, Quality::Paper).expect("storable"));
        assert!(none.as_object().is_some_and(|members| members.len() == 7) && none["seed"].is_null());
    }

    #[test]
    fn what_cannot_be_stored_or_read_is_named() {
        let entries = demo_entries();
        let error = entries[1].files(Quality::Draft, &Silent).expect_err("holds a NaN");
        let text = chain(&error);
        assert!(text.starts_with("the data cannot be stored: speed_m_per_s[1] is NaN"), "{text}");
        for (stored, expected) in [
            (
                r#"{"id": 3}"#,
                "the stored data do not fit this version: invalid type: integer `3`, expected a string at line 1",
            ),
            (
                r#"{"id": 3, "provenance": {"program": "bouncing-disk-experiments", "version": "7.0.0",
                    "format": "bouncing-disk figure", "format_version": 2}}"#,
                "\"demo.json\" has version 2 of the format \"bouncing-disk figure\" (written by \
                 \"bouncing-disk-experiments 7.0.0\"), newer than version 1, the newest that bouncing-disk",
            ),
        ] {
            let text = chain(&entries[0].read(stored.as_bytes()).expect_err("of another form"));
            assert!(text.starts_with(expected), "{text}");
        }
    }
}
