//! Pictures of figures that are committed, and whether they are those of what was made.
//!
//! They are made in paper quality. Whether they are out of date must be known without the minutes that takes:
//! [`FigureDigests`], written with them, holds a digest of what each was made from in *both* qualities.

use bouncing_disk::Provenance;
use bouncing_disk::core::numerics::digest::Digest;
use serde::{Deserialize, Serialize};

use crate::artifacts::{self, Stored};
use crate::cache_key::Stale;
use crate::experiment::{ErasedData, ExperimentError, Quality, RegisteredExperiment};
use crate::output::OutputFolder;
use crate::provenance;
use crate::results::ResultsError;

/// Widths of a picture (pixels), from the best on: the first counts whose file is small enough.
const PICTURE_WIDTHS: [u16; 4] = [1100, 950, 800, 650];
/// How large the file of a picture may be (bytes), where a smaller width helps.
pub const LARGEST_PICTURE: usize = 300_000;

/// What the picture of one figure, and its section of a page where it has one, were made from.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FigureDigests {
    /// Digest of data, drawing and section in draft quality.
    pub draft: String,
    /// The same in paper quality, of which the picture is.
    pub paper: String,
    /// Digest of the picture's file.
    pub picture: String,
}

impl FigureDigests {
    /// Whether a committed picture is the one that was written, of the figure that lies in an output folder in
    /// this quality, if one does.
    pub(crate) fn is_current(
        &self,
        made: Result<String, ResultsError>,
        quality: Quality,
        picture: Option<Vec<u8>>,
    ) -> Result<bool, ResultsError> {
        let expected = match quality {
            Quality::Draft => &self.draft,
            Quality::Paper => &self.paper,
        };
        let current = match made {
            Ok(made) => made == *expected,
            Err(ResultsError::Missing { .. }) => true,
            Err(ResultsError::Output(error)) => return Err(error.into()),
            Err(_) => false,
        };
        Ok(current && picture.is_some_and(|picture| picture_digest(&picture) == self.picture))
    }
}

/// A digest that does not depend on machine or compiler (FNV-1a, 64 bits).
pub fn digest(bytes: &[u8]) -> String {
    Digest::of(bytes).to_string()
}

/// The digest of a picture, which does not depend on what the file says of its origin.
pub fn picture_digest(bytes: &[u8]) -> String {
    digest(&provenance::without_png(bytes))
}

/// The name of the file of a picture.
pub(crate) fn picture_name(id: &str) -> String {
    format!("{id}.png")
}

/// A figure as it lies in an output folder.
pub(crate) struct MadeFiles {
    pub(crate) outcome: Box<dyn ErasedData>,
    provenance: Provenance,
    /// Data and drawing, without what they say of their origin.
    bytes: Vec<u8>,
}

impl MadeFiles {
    /// The documentation shows no measurements: what was made with some, or in another quality by a run since, is
    /// not taken for it.
    pub(crate) fn read(
        entry: &dyn RegisteredExperiment,
        folder: &OutputFolder,
        quality: Quality,
    ) -> Result<Self, ResultsError> {
        let id = entry.id();
        let missing = || ResultsError::Missing { id: id.to_owned() };
        let data = folder.read(&format!("{id}.json"))?.ok_or_else(missing)?;
        let drawing = folder.read(&format!("{id}.svg"))?.ok_or_else(missing)?;
        let cache_key = folder.cache_key(id).map_err(|stale| match stale {
            Stale::Missing => missing(),
            _ => ResultsError::Changed { id: id.to_owned() },
        })?;
        // What the program did not write itself may have any form.
        let whole =
            cache_key.holds(&format!("{id}.json"), &data) && cache_key.holds(&format!("{id}.svg"), &drawing);
        if !(whole && cache_key.quality == quality && !cache_key.shows_measurements()) {
            return Err(ResultsError::Changed { id: id.to_owned() });
        }
        let failed = |source| ResultsError::Figure { id: id.to_owned(), source };
        let Stored { outcome, provenance, .. } = artifacts::read(entry, &data).map_err(failed)?;
        // Another version of the program does not make another figure.
        let mut bytes = provenance::without_json(data);
        bytes.extend(provenance::without_svg(drawing));
        Ok(Self { outcome, provenance, bytes })
    }

    /// The digest of the files together with a text.
    pub(crate) fn digest_with(&self, text: &str) -> String {
        digest(&[&self.bytes, text.as_bytes()].concat())
    }

    /// The digest of the picture and the file that holds it.
    pub(crate) fn picture(&self, id: &str) -> Result<(String, Vec<u8>), ResultsError> {
        let failed = |source: ExperimentError| ResultsError::Figure { id: id.to_owned(), source };
        let figure = self.outcome.draw().map_err(failed)?;
        let mut picture = Vec::new();
        for width in PICTURE_WIDTHS {
            picture = figure.to_png_within(width).map_err(|error| failed(error.into()))?;
            if provenance::in_png(&self.provenance, &picture).len() <= LARGEST_PICTURE {
                break;
            }
        }
        Ok((digest(&picture), provenance::in_png(&self.provenance, &picture)))
    }
}
