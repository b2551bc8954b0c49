//! The model's means over the windows, member by member, and their derivatives by the parameters.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::run::{Watch, in_parallel};
use bouncing_disk_core::sweep::InstructionSet;
use bouncing_disk_core::{ChatterPolicy, Phase, Progress};
use nalgebra::{DMatrix, DVector};

use crate::error::Error;
use crate::estimate::parameter_fit::measured_transient::MeasuredTransient;
use crate::estimate::parameter_fit::parameter::{FitParameter, FitRange};
use crate::estimate::parameter_fit::settings::ParameterFitSettings;
use crate::estimate::parameter_fit::windows::{INTERVALS, Windows};
use crate::motor::batch::shared_orbit::is_shared;
use crate::motor::batch::shared_orbit::transients::shared_transients;
use crate::motor::data_sheet::Motor;
use crate::motor::rotor::transient::TransientSettings;

/// Half of the step of a derivative along a parameter that leaves the vertical motion as it is, as a share of
/// half the range.
const STEP: f64 = 0.05;

/// Half of the span, as a share of half the range, over which a parabola smooths what depends on the vertical
/// motion. Neighbouring motions differ by chance, and some lock on a cycle; neither says anything about the
/// next motion.
pub(crate) const SPAN: f64 = 0.4;

/// Places on that span.
const NODES: usize = 9;

/// The motor, what was measured of it, and what is to be found.
#[derive(Debug, Clone)]
pub(crate) struct Model<'a> {
    pub(crate) nominal: Motor,
    pub(crate) transients: &'a [MeasuredTransient],
    pub(crate) ranges: Vec<FitRange>,
    pub(crate) settings: &'a ParameterFitSettings,
    pub(crate) windows: Vec<Windows>,
}

/// The windows' means of each member: a row a member, the windows of all preloads in their order.
pub(crate) type MemberMeans = DMatrix<f64>;

impl Model<'_> {
    /// Number of windows at all preloads together.
    pub(crate) fn statistics(&self) -> usize {
        self.windows.iter().map(Windows::count).sum()
    }

    /// The measured means of all windows.
    pub(crate) fn measured(&self) -> DVector<f64> {
        let all = self.windows.iter().flat_map(|windows| windows.measured.iter().copied());
        DVector::from_iterator(self.statistics(), all)
    }

    /// The places of the data sheet.
    pub(crate) fn start(&self) -> DVector<f64> {
        let places = self.ranges.iter().map(|range| range.place_of(range.parameter.of(&self.nominal)));
        DVector::from_iterator(self.ranges.len(), places.map(|place| place.clamp(-1.0, 1.0)))
    }

    /// The motor at these places in the ranges.
    pub(crate) fn motor(&self, places: &DVector<f64>) -> Result<Motor, Error> {
        self.nominal.with(|sheet| {
            for (range, &place) in self.ranges.iter().zip(places.iter()) {
                range.parameter.set(sheet, range.value_at(place));
            }
        })
    }

    /// The means of all members of the motors at these places. All share starting phases and perturbations,
    /// and those that follow each other and share a vertical motion are carried by it together.
    pub(crate) fn members(
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
        let run = |task: usize| {
            // A transient counts its own intervals; the call that it is a part of has others.
            let ask = |_: Progress| match watch.ask() {
                Ok(()) => ControlFlow::Continue(()),
                Err(_) => ControlFlow::Break(()),
            };
            let own = Watch::begin(&ask, 0, 1)?;
            let mut work = own.work();
            let (preload, member) = (task / members, task % members);
            let windows = &self.windows[preload];
            let settings = TransientSettings {
                duration: windows.duration,
                intervals: INTERVALS,
                relaunch_perturbation: self.settings.relaunch_perturbation,
                seed: SplitMix64::seed_of_stream(self.settings.seed, task as u64),
                policy: ChatterPolicy::Complete,
            };
            let phase = Phase::new(TAU * (member as f64 + 0.5) / members as f64)?;
            let mut means = Vec::with_capacity(candidates.len() * windows.count());
            for group in systems[preload].chunk_by(is_shared) {
                for curve in shared_transients(group, phase, &settings, InstructionSet::best(), &mut work)? {
                    means.extend(windows.of_curve(&curve.speeds));
                }
            }
            Ok::<_, Error>(means)
        };
        let tasks = members * self.transients.len();
        let results = in_parallel(tasks, run);
        if watch.is_stopped() {
            watch.ask()?;
        }
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

    /// The means of all members at a place, and how they change along each of these ranges; nothing for the
    /// others.
    pub(crate) fn with_derivatives(
        &self,
        places: &DVector<f64>,
        along: impl Fn(FitParameter) -> bool,
        watch: &Watch<'_>,
    ) -> Result<Local, Error> {
        let mut candidates = vec![places.clone()];
        let asked = |index: &usize| along(self.ranges[*index].parameter);
        let changes_orbit = |index: &usize| self.ranges[*index].parameter.changes_orbit();
        let all = || (0..self.ranges.len()).filter(asked);
        // Those that share the vertical motion first, behind the place itself.
        let shared: Vec<usize> = all().filter(|index| !changes_orbit(index)).collect();
        let smoothed: Vec<usize> = all().filter(changes_orbit).collect();
        for &index in &shared {
            for direction in [1.0, -1.0] {
                let mut candidate = places.clone();
                candidate[index] = (places[index] + direction * STEP).clamp(-1.0, 1.0);
                candidates.push(candidate);
            }
        }
        for &index in &smoothed {
            let middle = places[index].clamp(SPAN - 1.0, 1.0 - SPAN);
            for node in 0..NODES {
                let mut candidate = places.clone();
                candidate[index] = middle + SPAN * (2.0 * node as f64 / (NODES - 1) as f64 - 1.0);
                candidates.push(candidate);
            }
        }
        let members = self.members(&candidates, watch)?;
        let mut derivatives = vec![MemberMeans::zeros(0, 0); self.ranges.len()];
        for (k, &index) in shared.iter().enumerate() {
            let (ahead, behind) = (1 + 2 * k, 2 + 2 * k);
            let width = candidates[ahead][index] - candidates[behind][index];
            derivatives[index] = (&members[ahead] - &members[behind]) / width;
        }
        let (mut smooth, mut roughness) = (members[0].clone(), Vec::with_capacity(smoothed.len()));
        for (k, &index) in smoothed.iter().enumerate() {
            let nodes = 1 + 2 * shared.len() + NODES * k..1 + 2 * shared.len() + NODES * (k + 1);
            let distances: Vec<f64> =
                candidates[nodes.clone()].iter().map(|candidate| candidate[index] - places[index]).collect();
            let parabola = Parabola::at(&distances);
            let (mut value, mut slope) = (-&members[0], MemberMeans::zeros(smooth.nrows(), smooth.ncols()));
            for (node, [of_value, of_slope]) in nodes.clone().zip(&parabola.weights) {
                value += &members[node] * *of_value;
                slope += &members[node] * *of_slope;
            }
            smooth += value;
            derivatives[index] = slope;
            let means: Vec<DVector<f64>> = members[nodes].iter().map(mean_of).collect();
            let slope_variance = parabola.weights.iter().map(|[_, of_slope]| of_slope * of_slope).sum();
            roughness.push(Roughness {
                parameter: index,
                residuals: parabola.residuals(&means),
                slope_variance,
            });
        }
        let smooth = mean_of(&smooth);
        let members = members.into_iter().next().unwrap_or_else(|| MemberMeans::zeros(0, 0));
        Ok(Local { members, smooth, derivatives, roughness })
    }
}

/// The results of the model at a place and near it.
#[derive(Debug)]
pub(crate) struct Local {
    /// The means of all members.
    pub(crate) members: MemberMeans,
    /// The mean over members, smoothed along the parameters that change the vertical motion.
    pub(crate) smooth: DVector<f64>,
    /// The derivatives of the members' means along each range; empty if not requested.
    pub(crate) derivatives: Vec<MemberMeans>,
    /// The residuals of the smoothing, for each parameter that changes the vertical motion.
    pub(crate) roughness: Vec<Roughness>,
}

/// The residuals of the parabola along one parameter, caused by motions that lock on a cycle, and by chance.
#[derive(Debug)]
pub(crate) struct Roughness {
    pub(crate) parameter: usize,
    /// The sum of their squares is the variance about the parabola.
    pub(crate) residuals: Vec<DVector<f64>>,
    /// Variance of the slope for a variance of one about the parabola.
    pub(crate) slope_variance: f64,
}

/// The parabola of the least squares through numbers at some distances.
struct Parabola {
    powers: DMatrix<f64>,
    inverse: DMatrix<f64>,
    /// With which the numbers give its value and slope at distance zero.
    weights: Vec<[f64; 2]>,
}

impl Parabola {
    fn at(distances: &[f64]) -> Self {
        let powers = DMatrix::from_fn(distances.len(), 3, |node, power| match power {
            0 => 1.0,
            1 => distances[node],
            _ => distances[node] * distances[node],
        });
        let normal = powers.transpose() * &powers;
        // Three different distances have a parabola.
        let inverse = normal.try_inverse().unwrap_or_else(|| DMatrix::zeros(3, 3));
        let weights = (&powers * &inverse).row_iter().map(|row| [row[0], row[1]]).collect();
        Self { powers, inverse, weights }
    }

    /// The differences of the numbers from the parabola, over the root of their degrees of freedom.
    fn residuals(&self, numbers: &[DVector<f64>]) -> Vec<DVector<f64>> {
        let smoothing = &self.powers * &self.inverse * self.powers.transpose();
        let scale = 1.0 / (numbers.len() as f64 - 3.0).sqrt();
        let residual = |node: usize| {
            let fitted = numbers.iter().enumerate().map(|(other, number)| number * smoothing[(node, other)]);
            (&numbers[node] - fitted.fold(DVector::zeros(numbers[node].len()), |sum, part| sum + part))
                * scale
        };
        (0..numbers.len()).map(residual).collect()
    }
}

/// The mean over the members.
pub(crate) fn mean_of(members: &MemberMeans) -> DVector<f64> {
    let count = members.nrows() as f64;
    DVector::from_iterator(members.ncols(), members.column_iter().map(|column| column.sum() / count))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_found_and_what_is_beside_it_left() {
        let distances: Vec<f64> = (0..9).map(|node| 0.1 * f64::from(node) - 0.25).collect();
        let parabola = Parabola::at(&distances);
        let numbers: Vec<DVector<f64>> =
            distances.iter().map(|x| DVector::from_element(1, 3.0 - 2.0 * x + 5.0 * x * x)).collect();
        let of = |k: usize| {
            let parts = parabola.weights.iter().zip(&numbers).map(|(weights, number)| weights[k] * number[0]);
            parts.sum::<f64>()
        };
        assert!((of(0) - 3.0).abs() < 1e-12 && (of(1) + 2.0).abs() < 1e-12, "{} {}", of(0), of(1));
        let squares = |numbers: &[DVector<f64>]| {
            parabola.residuals(numbers).iter().map(DVector::norm_squared).sum::<f64>()
        };
        assert!(squares(&numbers) < 1e-24);
        // Numbers that alternate have nearly their own variance about any parabola: 9/6 less what it takes.
        let rough: Vec<DVector<f64>> = (0..9)
            .map(|node| &numbers[node] + DVector::from_element(1, if node % 2 == 0 { 0.1 } else { -0.1 }))
            .collect();
        let share = squares(&rough) / (0.01 * 9.0 / 6.0);
        assert!(share > 0.9 && share < 1.0, "{share}");
    }
}
