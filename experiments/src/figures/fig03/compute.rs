//! The computation of Fig. 3.

use super::census::census;
use super::cycle::cycle;
use super::data::Fig03Data;
use super::sprung::sprung;
use crate::experiment::{ExperimentError, Quality};
use crate::progress::Progress;

pub(super) fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig03Data, ExperimentError> {
    let census = census(quality, progress)?;
    let cycle = cycle(quality)?;
    let sprung = sprung(quality)?;
    Ok(Fig03Data { census, cycle, sprung })
}
