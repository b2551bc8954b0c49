//! What the model says of the windows' means, member by member, and how that changes with the parameters.

use std::f64::consts::TAU;

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::{ChatterPolicy, InstructionSet, Phase, Watch, WorkCount};
use nalgebra::{DMatrix, DVector};

use super::measured_transient::MeasuredTransient;
use super::parameter::{FitParameter, ParameterRange};
use super::settings::ParameterFitSettings;
use super::windows::{INTERVALS, Windows};
use crate::error::Error;
use crate::motor::data_sheet::Motor;
use crate::motor::shared_orbit::is_shared;
use crate::motor::shared_orbit::transients::with_instructions;
use crate::motor::transient::TransientSettings;

/// Half of the step of a derivative along a parameter that leaves the vertical motion as it is, as a share of half the range.
const STEP: f64 = 0.05;

/// The same where the vertical motions differ, and with them the luck of the members: a longer step has less of it.
pub(super) const STEP_OF_ORBIT: f64 = 0.25;

/// The motor, what was measured of it, and what is to be found.
#[derive(Debug)]
pub(super) struct Model<'a> {
    pub(super) nominal: Motor,
    pub(super) transients: &'a [MeasuredTransient],
    pub(super) ranges: &'a [ParameterRange],
    pub(super) settings: &'a ParameterFitSettings,
    pub(super) windows: Vec<Windows>,
}

/// The windows' means of each member: a row a member, the windows of all preloads in their order.
pub(super) type MemberMeans = DMatrix<f64>;

impl Model<'_> {
    /// Number of windows at all preloads together.
    pub(super) fn statistics(&self) -> usize {
        self.windows.iter().map(Windows::count).sum()
    }

    /// The measured means of all windows.
    pub(super) fn measured(&self) -> DVector<f64> {
        let all = self.windows.iter().flat_map(|windows| windows.measured.iter().copied());
        DVector::from_iterator(self.statistics(), all)
    }

    /// The motor at these places in the ranges.
    pub(super) fn motor(&self, places: &DVector<f64>) -> Result<Motor, Error> {
        self.nominal.with(|sheet| {
            for (range, &place) in self.ranges.iter().zip(places.iter()) {
                range.parameter.set(sheet, range.value_at(place));
            }
        })
    }

    /// The means of all members of the motors at these places. All share starting phases and perturbations, and those that
    /// follow each other and share a vertical motion are carried by it together.
    pub(super) fn members(
        &self,
        candidates: &[DVector<f64>],
        watch: &Watch<'_>,
    ) -> Result<Vec<MemberMeans>, Error> {
        let members = self.settings.members;
        let mut systems = Vec::with_capacity(self.transients.len());
        for transient in self.transients {
            let at_preload = candidates.iter().map(|places| {
                self.motor(places).and_then(|motor| transient.motor(&motor)).map(|motor| *motor.system())
            });
            systems.push(at_preload.collect::<Result<Vec<_>, _>>()?);
        }
        let run = |work: &mut WorkCount<'_>, task: usize| {
            let (preload, member) = (task / members, task % members);
            let windows = &self.windows[preload];
            let settings = TransientSettings {
                duration: windows.duration,
                intervals: INTERVALS,
                relaunch_perturbation: self.settings.relaunch_perturbation,
                seed: SplitMix64::new(self.settings.seed.wrapping_add(task as u64)).next_number(),
                policy: ChatterPolicy::Complete,
            };
            let phase = Phase::new(TAU * (member as f64 + 0.5) / members as f64)?;
            let mut means = Vec::with_capacity(candidates.len() * windows.count());
            for group in systems[preload].chunk_by(is_shared) {
                for curve in with_instructions(group, phase, &settings, InstructionSet::best(), work)? {
                    means.extend(windows.of_curve(&curve.speeds));
                }
            }
            Ok::<_, Error>(means)
        };
        let tasks = members * self.transients.len();
        #[cfg(feature = "parallel")]
        let results: Vec<_> = {
            use rayon::prelude::*;
            (0..tasks).into_par_iter().map_init(|| watch.work(), run).collect()
        };
        #[cfg(not(feature = "parallel"))]
        let results: Vec<_> = {
            let mut work = watch.work();
            (0..tasks).map(|task| run(&mut work, task)).collect()
        };
        let mut all = vec![MemberMeans::zeros(members, self.statistics()); candidates.len()];
        let mut first = 0;
        for (task, result) in results.into_iter().enumerate() {
            let (preload, member) = (task / members, task % members);
            let count = self.windows[preload].count();
            for (index, mean) in result?.into_iter().enumerate() {
                all[index / count][(member, first + index % count)] = mean;
            }
            if member + 1 == members {
                first += count;
            }
        }
        Ok(all)
    }

    /// The means of all members at a place, and how they change along each of these ranges; nothing for the others.
    pub(super) fn with_derivatives(
        &self,
        places: &DVector<f64>,
        along: impl Fn(FitParameter) -> bool,
        watch: &Watch<'_>,
    ) -> Result<(MemberMeans, Vec<MemberMeans>), Error> {
        // Those that share the vertical motion first, behind the place itself.
        let mut order: Vec<usize> =
            (0..self.ranges.len()).filter(|&index| along(self.ranges[index].parameter)).collect();
        order.sort_by_key(|&index| self.ranges[index].parameter.changes_orbit());
        let mut candidates = vec![places.clone()];
        for &index in &order {
            let changes_orbit = self.ranges[index].parameter.changes_orbit();
            let step = if changes_orbit { STEP_OF_ORBIT } else { STEP };
            for direction in [1.0, -1.0] {
                let mut candidate = places.clone();
                candidate[index] = (places[index] + direction * step).clamp(-1.0, 1.0);
                candidates.push(candidate);
            }
        }
        let all = self.members(&candidates, watch)?;
        let mut derivatives = vec![MemberMeans::zeros(0, 0); self.ranges.len()];
        for (k, &index) in order.iter().enumerate() {
            let (ahead, behind) = (1 + 2 * k, 2 + 2 * k);
            let width = candidates[ahead][index] - candidates[behind][index];
            derivatives[index] = (&all[ahead] - &all[behind]) / width;
        }
        Ok((all[0].clone(), derivatives))
    }
}

/// The mean over the members.
pub(super) fn mean_of(members: &MemberMeans) -> DVector<f64> {
    let count = members.nrows() as f64;
    DVector::from_iterator(members.ncols(), members.column_iter().map(|column| column.sum() / count))
}
