//! Figures and tables of the paper: what their functions record, and the files that are made of it.

use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::store::{Provenance, StorageError};
use bouncing_disk_plot::{DrawError, Figure};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::claims::catalogue::CatalogueError;
use crate::claims::{Claim, answers};
use crate::json::{self, FiniteError};
use crate::progress::Progress;
use crate::report::{self, TemplateError};
use crate::{output, provenance};

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
    /// The function of the figure ended without a drawing.
    #[error("nothing was drawn")]
    NoDrawing,
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
    /// The discussion refers to a number that no claim has.
    #[error("the discussion cannot be filled in")]
    Discussion(#[from] TemplateError),
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

/// A figure or table of the paper: one function, which computes and records.
#[derive(Debug, Clone, Copy)]
pub struct Experiment {
    /// `fig01` ... `fig14`, `table1` ... `table3`.
    pub id: &'static str,
    /// A short title for the gallery and for lists.
    pub title: &'static str,
    /// A description of the figure, in a paragraph for `docs/results.md`. `{{ claims["section4.merging"] }}` stands for the
    /// computed number of the claim that answers this entry of the [catalogue](crate::claims::catalogue).
    pub discussion: &'static str,
    /// Computes and records all that belongs to the figure. Deterministic: the same bits on every machine and with every
    /// number of threads.
    pub make: fn(&mut Paper<'_>) -> Result<(), ExperimentError>,
}

/// What a figure's function records.
pub struct Paper<'a> {
    /// How finely to sample.
    pub quality: Quality,
    /// Where to report how far it is.
    pub progress: &'a dyn Progress,
    seeds: Vec<(&'static str, u64)>,
    chatter_policy: Option<ChatterPolicy>,
    caption: String,
    parameters: Vec<(String, String)>,
    claims: Vec<Claim>,
    data: Map<String, Value>,
    figure: Option<Figure>,
}

impl fmt::Debug for Paper<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("Paper").field("caption", &self.caption).finish_non_exhaustive()
    }
}

impl Paper<'_> {
    /// The seed of some random draws. The first is *the* seed of the figure.
    pub fn seed(&mut self, draws: &'static str, seed: u64) -> u64 {
        self.seeds.push((draws, seed));
        seed
    }

    /// How a chattering sequence ends in the picture, if it shows one. A figure that compares both policies says so in its
    /// data.
    pub fn chattering(&mut self, policy: ChatterPolicy) {
        self.chatter_policy = Some(policy);
    }

    /// The caption, plain text with Unicode Greek.
    pub fn caption(&mut self, text: impl Into<String>) {
        self.caption = text.into();
    }

    /// A parameter for the gallery: its name, and its value with unit.
    pub fn parameter(&mut self, name: impl Into<String>, value: impl ToString) {
        self.parameters.push((name.into(), value.to_string()));
    }

    /// Parameters whose names are computed.
    pub fn parameters(&mut self, rows: impl IntoIterator<Item = (String, String)>) {
        self.parameters.extend(rows);
    }

    /// A number or statement that the paper prints, compared with the data; taken from the
    /// [catalogue](crate::claims::catalogue) by its key. Entries of the catalogue that have a reason why nothing can be
    /// computed are added by themselves.
    pub fn claim(&mut self, claim: Claim) {
        self.claims.push(claim);
    }

    /// Several of them.
    pub fn claims(&mut self, claims: impl IntoIterator<Item = Claim>) {
        self.claims.extend(claims);
    }

    /// The computed numbers: fields with their units in the names. A number that does not exist is an `Option`, never a NaN.
    ///
    /// # Errors
    /// [`ExperimentError::Data`] for a number that is not finite.
    pub fn data(&mut self, data: &impl Serialize) -> Result<(), ExperimentError> {
        if let Value::Object(fields) = json::to_value(data)? {
            self.data.extend(fields);
        }
        Ok(())
    }

    /// One of them, under this name.
    ///
    /// # Errors
    /// Those of [`Self::data`].
    pub fn record(&mut self, name: &str, value: &impl Serialize) -> Result<(), ExperimentError> {
        self.data(&BTreeMap::from([(name, value)]))
    }

    /// The drawing.
    pub fn draw(&mut self, figure: Figure) {
        self.figure = Some(figure);
    }
}

/// The contents of `ID.json`: all that was recorded but the drawing.
#[derive(Debug, Serialize, Deserialize)]
pub struct Record {
    /// The first part of a file of any format version to be read.
    pub provenance: Provenance,
    /// See [`Experiment::id`].
    pub id: String,
    /// See [`Experiment::title`].
    pub title: String,
    /// How finely it was sampled.
    pub quality: Quality,
    /// See [`Paper::caption`].
    pub caption: String,
    /// [`Experiment::discussion`] with its numbers.
    pub discussion: String,
    /// See [`Paper::parameter`].
    pub parameters: Vec<(String, String)>,
    /// See [`Paper::claim`]; with those of entries that nothing can be computed for.
    pub claims: Vec<Claim>,
    /// See [`Paper::data`].
    pub data: Value,
}

/// A figure that was computed.
#[derive(Debug)]
pub struct Made {
    /// All but the drawing.
    pub record: Record,
    /// See [`Paper::draw`].
    pub figure: Figure,
}

impl Experiment {
    /// Runs the experiment.
    ///
    /// # Errors
    /// Those of its function.
    pub fn compute(&self, quality: Quality, progress: &dyn Progress) -> Result<Made, ExperimentError> {
        let mut paper = Paper {
            quality,
            progress,
            seeds: Vec::new(),
            chatter_policy: None,
            caption: String::new(),
            parameters: Vec::new(),
            claims: Vec::new(),
            data: Map::new(),
            figure: None,
        };
        (self.make)(&mut paper)?;
        let mut claims = std::mem::take(&mut paper.claims);
        claims.extend(answers::not_computable(self.id));
        let record = Record {
            provenance: self.provenance(&paper)?,
            id: self.id.to_owned(),
            title: self.title.to_owned(),
            quality,
            caption: paper.caption,
            discussion: report::discussion(self, &claims)?,
            parameters: paper.parameters,
            claims,
            data: Value::Object(paper.data),
        };
        Ok(Made { record, figure: paper.figure.ok_or(ExperimentError::NoDrawing)? })
    }

    /// The origin of its files. Where it has several seeds, the first is *the* seed, and all of them are among the
    /// parameters, by the names of their draws.
    fn provenance(&self, paper: &Paper<'_>) -> Result<Provenance, StorageError> {
        let new = provenance::new(provenance::FIGURE);
        let mut provenance = new.with("figure", self.id)?.with("quality", &paper.quality)?;
        if let Some((_, first)) = paper.seeds.first() {
            provenance = provenance.with_seed(*first);
        }
        if paper.seeds.len() > 1 {
            provenance = provenance.with("seeds", &paper.seeds)?;
        }
        if let Some(policy) = paper.chatter_policy {
            provenance = provenance.with_chatter_policy(policy);
        }
        provenance.with("values", &paper.parameters)
    }
}

impl Made {
    /// Its files: `ID.json` and `ID.svg`, which say where they come from ([`provenance`]), and `ID.png`.
    ///
    /// # Errors
    /// [`ExperimentError::Draw`].
    pub fn files(&self) -> Result<Vec<output::File>, ExperimentError> {
        let Self { record, figure } = self;
        let svg = provenance::in_svg(&record.provenance, &figure.to_svg()?).into_bytes();
        let json = json::to_text(&json::to_value(record)?).into_bytes();
        let id = &record.id;
        Ok(vec![
            (format!("{id}.png"), figure.to_png()?),
            (format!("{id}.svg"), svg),
            (format!("{id}.json"), json),
        ])
    }
}

impl Record {
    /// Reads the content of an `ID.json`.
    ///
    /// # Errors
    /// [`ExperimentError::Provenance`] for one of a newer format, [`ExperimentError::Stored`] for one of another form.
    pub fn read(id: &str, bytes: &[u8]) -> Result<Self, ExperimentError> {
        /// The part that every version has.
        #[derive(Deserialize)]
        struct Origin {
            provenance: Option<Value>,
        }
        // Before anything else: a newer one may have any other form.
        let Origin { provenance } = serde_json::from_slice(bytes).map_err(ExperimentError::Stored)?;
        provenance::refuse_newer(provenance::FIGURE, provenance.as_ref(), &format!("{id}.json"))?;
        serde_json::from_slice(bytes).map_err(ExperimentError::Stored)
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
        let make = || demo.compute(Quality::Draft, &Silent).and_then(|made| made.files()).expect("works");
        let files = make();
        assert_eq!(files, make());
        let names: Vec<_> = files.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["demo.png", "demo.svg", "demo.json"]);
        let record = Record::read("demo", &files[2].1).expect("fits");
        assert_eq!(record.quality, Quality::Draft);
        let stored = json!(record.provenance);
        assert_eq!(stored["program"], "bouncing-disk-experiments");
        assert_eq!(stored["version"], env!("CARGO_PKG_VERSION"));
        assert_eq!(stored["format_version"], provenance::FIGURE.version);
        let seeds = json!([["points", 3], ["others", 4]]);
        let values = json!([["restitution ε", "0.5"]]);
        let parameters = json!({"figure": "demo", "quality": "draft", "seeds": seeds, "values": values});
        assert_eq!(stored["parameters"], parameters);
        assert_eq!((&stored["seed"], &stored["chatter_policy"]), (&json!(3), &json!("Complete")));
        let made = demo.compute(Quality::Draft, &Silent).expect("works");
        assert_eq!(json!(record), json!(made.record));
        let svg = provenance::in_svg(&record.provenance, &made.figure.to_svg().expect("draws"));
        assert_eq!(svg.into_bytes(), files[1].1);
    }

    #[test]
    fn what_cannot_be_stored_or_read_is_named() {
        let error = demo_entries()[1].compute(Quality::Draft, &Silent).expect_err("holds a NaN");
        let text = chain(&error);
        assert!(text.starts_with("the data cannot be stored: speed_m_per_s[1] is NaN"), "{text}");
        for (stored, expected) in [
            (
                r#"{"id": 3}"#,
                "the stored data do not fit this version: invalid type: integer `3`, expected a string at line 1",
            ),
            (
                r#"{"id": 3, "provenance": {"program": "bouncing-disk-experiments", "version": "7.0.0",
                    "format": "bouncing-disk figure", "format_version": 3}}"#,
                "\"demo.json\" has version 3 of the format \"bouncing-disk figure\" (written by \
                 \"bouncing-disk-experiments 7.0.0\"), newer than version 2, the newest that bouncing-disk",
            ),
        ] {
            let text = chain(&Record::read("demo", stored.as_bytes()).expect_err("of another form"));
            assert!(text.starts_with(expected), "{text}");
        }
    }
}
