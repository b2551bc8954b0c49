//! What a figure or table of the paper is: data, drawing, claims.

use std::fmt;
use std::str::FromStr;

use bouncing_disk::StorageError;
use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::{DrawError, Figure};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::answers;
use crate::catalogue::CatalogueError;
use crate::claim::Claim;
use crate::finite::{self, FiniteError};
use crate::measured::{Layout, MeasuredError, Series};
use crate::progress::Progress;
use crate::table::{Table, TableError};

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
    /// What was given.
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

/// Why an experiment gave no result. The cause is the [source](std::error::Error::source); [`chain`] shows all.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExperimentError {
    /// The model refused a parameter or could not finish a trajectory.
    #[error("the model failed")]
    Model(#[source] Box<dyn std::error::Error + Send + Sync>),
    /// The figure could not be drawn.
    #[error("the figure could not be drawn")]
    Draw(#[from] DrawError),
    /// The table is malformed.
    #[error("the table could not be written")]
    Table(#[from] TableError),
    /// The data cannot be stored: a number is infinite or not a number.
    #[error("the data cannot be stored")]
    Data(#[from] FiniteError),
    /// Stored data do not have the form this version reads.
    #[error("the stored data do not fit this version")]
    Stored(#[source] serde_path_to_error::Error<serde_json::Error>),
    /// What a file says of its origin cannot be stored, or is of a newer format.
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
    /// A user's measurements cannot be used.
    #[error(transparent)]
    Measured(Box<MeasuredError>),
    /// An input file (a table of the paper) could not be read.
    #[error("cannot read {path}")]
    Input {
        /// The file.
        path: std::path::PathBuf,
        /// What the system or the parser reported.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
}

impl From<MeasuredError> for ExperimentError {
    fn from(error: MeasuredError) -> Self {
        Self::Measured(Box::new(error))
    }
}

impl From<StorageError> for ExperimentError {
    fn from(error: StorageError) -> Self {
        Self::Provenance(Box::new(error))
    }
}

impl From<bouncing_disk::FitError> for ExperimentError {
    fn from(error: bouncing_disk::FitError) -> Self {
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
    /// The computed numbers: plain, serialisable, units in the field names. A number that does not exist is an
    /// `Option`, never a NaN: storing a number that is not finite is an error.
    type Data: Serialize + DeserializeOwned + Send + Sync + 'static;

    /// `fig01` ... `fig14`, `table1` ... `table3`.
    const ID: &'static str;

    /// A short title for the gallery and for lists.
    const TITLE: &'static str;

    /// What the figure shows, in a paragraph for `docs/results.md`; nothing for a figure beyond the paper. `{section4.merging}` stands for the computed number
    /// of the claim that answers this entry of the [catalogue](crate::catalogue).
    const DISCUSSION: &'static str = "";
    /// The files of a user's measurements that can be drawn over this figure.
    const MEASUREMENTS: &'static [Layout] = &[];
    /// What ends a chattering sequence in what is drawn, where there is one. A figure that compares both policies says so
    /// in its data.
    const CHATTER_POLICY: Option<ChatterPolicy> = None;

    /// What is drawn at random, and its seed; the first is *the* seed of the figure.
    fn seeds() -> Vec<(&'static str, u64)> {
        Vec::new()
    }

    /// The caption, plain text with Unicode Greek.
    fn caption(data: &Self::Data) -> String;

    /// Computes the data. Deterministic: the same bits on every machine and with every number of threads.
    ///
    /// # Errors
    ///
    /// When the model fails.
    fn compute(quality: Quality, progress: &dyn Progress) -> Result<Self::Data, ExperimentError>;

    /// Puts a user's measurements, and what is fitted to them, into a field of the data of its own. The computed
    /// numbers stay what they are; after an error the data are unchanged.
    ///
    /// # Errors
    ///
    /// When the fit to the measurements is not defined.
    fn overlay(_data: &mut Self::Data, _series: &Series) -> Result<(), ExperimentError> {
        Ok(())
    }

    /// Draws the data.
    ///
    /// # Errors
    ///
    /// When the data cannot be drawn.
    fn draw(data: &Self::Data) -> Result<Figure, ExperimentError>;

    /// Every number and statement the paper prints about this figure, compared with the data, each taken from the
    /// [catalogue](crate::catalogue) by its key. Entries of the catalogue that have a reason why nothing can be computed are
    /// added by the framework.
    fn claims(_data: &Self::Data) -> Vec<Claim> {
        Vec::new()
    }

    /// Name and value with unit, for the gallery.
    fn parameters(_data: &Self::Data) -> Vec<(String, String)> {
        Vec::new()
    }

    /// The data as a table, where the paper prints a table.
    fn table(_data: &Self::Data) -> Option<Table> {
        None
    }
}

/// An experiment whose data type is erased, so that a registry can hold all of them.
pub trait RegisteredExperiment: Sync + Send {
    /// See [`Experiment::ID`].
    fn id(&self) -> &'static str;

    /// See [`Experiment::TITLE`].
    fn title(&self) -> &'static str;

    /// See [`Experiment::MEASUREMENTS`].
    fn measurements(&self) -> &'static [Layout] {
        &[]
    }

    /// See [`Experiment::seeds`].
    fn seeds(&self) -> Vec<(&'static str, u64)> {
        Vec::new()
    }

    /// See [`Experiment::CHATTER_POLICY`].
    fn chatter_policy(&self) -> Option<ChatterPolicy> {
        None
    }

    /// Computes the data.
    ///
    /// # Errors
    ///
    /// When the model fails.
    fn compute(
        &self,
        quality: Quality,
        progress: &dyn Progress,
    ) -> Result<Box<dyn ErasedData>, ExperimentError>;

    /// Reads data that an earlier run stored.
    ///
    /// # Errors
    ///
    /// When another version wrote them and they do not fit.
    fn read(&self, stored: Value) -> Result<Box<dyn ErasedData>, ExperimentError>;
}

/// The data of one experiment, whatever their type, and what can be made from them.
pub trait ErasedData: Send + Sync {
    /// See [`Experiment::overlay`].
    ///
    /// # Errors
    ///
    /// When the fit to the measurements is not defined.
    fn overlay(&mut self, series: &Series) -> Result<(), ExperimentError>;

    /// The data as JSON.
    ///
    /// # Errors
    ///
    /// When a number is not finite; JSON has no way to write it and would silently hold `null`.
    fn to_json(&self) -> Result<Value, ExperimentError>;

    /// See [`Experiment::draw`].
    ///
    /// # Errors
    ///
    /// When the data cannot be drawn.
    fn draw(&self) -> Result<Figure, ExperimentError>;

    /// See [`Experiment::claims`].
    fn claims(&self) -> Vec<Claim>;

    /// See [`Experiment::caption`].
    fn caption(&self) -> String;

    /// See [`Experiment::DISCUSSION`].
    fn discussion(&self) -> &'static str;

    /// See [`Experiment::parameters`].
    fn parameters(&self) -> Vec<(String, String)>;

    /// See [`Experiment::table`].
    fn table(&self) -> Option<Table>;
}

/// The type-erased form of the experiment `E`, for the registry.
pub fn entry<E: Experiment>() -> Box<dyn RegisteredExperiment> {
    Box::new(Erased::<E>(std::marker::PhantomData))
}

struct Erased<E>(std::marker::PhantomData<E>);

impl<E: Experiment> RegisteredExperiment for Erased<E> {
    fn id(&self) -> &'static str {
        E::ID
    }

    fn title(&self) -> &'static str {
        E::TITLE
    }

    fn measurements(&self) -> &'static [Layout] {
        E::MEASUREMENTS
    }

    fn seeds(&self) -> Vec<(&'static str, u64)> {
        E::seeds()
    }

    fn chatter_policy(&self) -> Option<ChatterPolicy> {
        E::CHATTER_POLICY
    }

    fn compute(
        &self,
        quality: Quality,
        progress: &dyn Progress,
    ) -> Result<Box<dyn ErasedData>, ExperimentError> {
        Ok(Box::new(Typed::<E>(E::compute(quality, progress)?)))
    }

    fn read(&self, stored: Value) -> Result<Box<dyn ErasedData>, ExperimentError> {
        let data = serde_path_to_error::deserialize(stored).map_err(ExperimentError::Stored)?;
        Ok(Box::new(Typed::<E>(data)))
    }
}

struct Typed<E: Experiment>(E::Data);

impl<E: Experiment> ErasedData for Typed<E> {
    fn overlay(&mut self, series: &Series) -> Result<(), ExperimentError> {
        E::overlay(&mut self.0, series)
    }

    fn to_json(&self) -> Result<Value, ExperimentError> {
        Ok(finite::to_value(&self.0)?)
    }

    fn draw(&self) -> Result<Figure, ExperimentError> {
        E::draw(&self.0)
    }

    fn claims(&self) -> Vec<Claim> {
        let mut claims = E::claims(&self.0);
        claims.extend(answers::not_computable(E::ID));
        claims
    }

    fn caption(&self) -> String {
        E::caption(&self.0)
    }

    fn discussion(&self) -> &'static str {
        E::DISCUSSION
    }

    fn parameters(&self) -> Vec<(String, String)> {
        E::parameters(&self.0)
    }

    fn table(&self) -> Option<Table> {
        E::table(&self.0)
    }
}
