//! A period as pieces of polynomials of degree at most 3.

use super::landing::{Found, Start};
use super::{DriveBounds, DriveState};
use crate::numerics::error::Error;

#[derive(Debug, PartialEq)]
pub(crate) struct Pieces {
    pub(super) bounds: DriveBounds,
}

impl Pieces {
    pub(super) fn at(&self, _time: f64) -> DriveState {
        DriveState::default()
    }

    pub(super) fn kinks(&self) -> impl Iterator<Item = (f64, f64)> {
        core::iter::empty()
    }

    pub(super) fn window(&self, _start: Start, _error: [f64; 2], _to: f64) -> Result<Found, Error> {
        Ok(Found::default())
    }

    pub(super) fn contact_end(&self, _time: f64, _limit: f64) -> Option<(f64, f64, f64)> {
        None
    }

    pub(super) fn pull_within(&self, _time: f64, _duration: f64) -> Option<(f64, f64)> {
        None
    }
}
