//! The path of a point of the platform (Eq. 1) on a cylinder.

use std::f64::consts::TAU;

use bouncing_disk::Platform;
use bouncing_disk::core::Phase;
use serde::{Deserialize, Serialize};

use crate::experiment::ExperimentError;

/// One period of the motion of a point of the platform. The last point is the first one, computed again one
/// period later.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct HandPath {
    pub(crate) phase_rad: Vec<f64>,
    pub(crate) angle_rad: Vec<f64>,
    pub(crate) height_m: Vec<f64>,
}

impl HandPath {
    pub(crate) fn new(platform: &Platform, intervals: u32) -> Result<Self, ExperimentError> {
        let mut path = Self { phase_rad: Vec::new(), angle_rad: Vec::new(), height_m: Vec::new() };
        for step in 0..=intervals {
            let angle = TAU * f64::from(step) / f64::from(intervals);
            let phase = Phase::new(angle)?;
            path.phase_rad.push(angle);
            path.angle_rad.push(platform.angle(phase));
            path.height_m.push(platform.height(phase));
        }
        Ok(path)
    }

    pub(crate) fn points(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.angle_rad.iter().copied().zip(self.height_m.iter().copied())
    }

    /// The piece that ends at a share of the period and is `intervals` long.
    pub(crate) fn before(&self, share: f64, intervals: usize) -> impl Iterator<Item = (f64, f64)> + '_ {
        let last = (share * self.phase_rad.len() as f64) as usize;
        self.points().take(last + 1).skip(last.saturating_sub(intervals))
    }

    /// The length of the path in the cylinder's surface, along the polygon of its points.
    pub(crate) fn length(&self, radius: f64) -> f64 {
        self.points().zip(self.points().skip(1)).map(|(one, next)| distance(radius, one, next)).sum()
    }
}

/// The distance of two points in the surface of a cylinder.
fn distance(radius: f64, one: (f64, f64), other: (f64, f64)) -> f64 {
    let (across, up) = (radius * (other.0 - one.0), other.1 - one.1);
    (across * across + up * up).sqrt()
}
