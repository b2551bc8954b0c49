//! The contact time: scanned, because each one has a vertical motion of its own, and flights, taps and transients
//! between them make several ranges fit equally well. docs/numerics/motors.md, "Parameters from transients".

use std::f64::consts::TAU;

use bouncing_disk_core::numerics::elementary::{exp, ln};
use bouncing_disk_core::run::Watch;
use nalgebra::{DMatrix, DVector};

use crate::error::Error;
use crate::estimate::interval::IntervalEstimate;
use crate::estimate::parameter_fit::bootstrap::differences;
use crate::estimate::parameter_fit::estimate::{AcceptedRange, ParameterEstimate};
use crate::estimate::parameter_fit::model::Model;
use crate::estimate::parameter_fit::parameter::{FitParameter, FitRange};
use crate::estimate::parameter_fit::search::{Evaluations, Linearised};
use crate::estimate::parameter_fit::{ParameterFit, widening_for};
use crate::estimate::refusal::{FitError, FitRefusal, refused};
use crate::statistics::percentile;

/// Contact times over the period below which they count as one: rigid impacts are valid there.
const RIGID: f64 = 0.1;

/// The largest step of the first scan, and the smallest of the refined one, in the logarithm.
const STEPS: [f64; 2] = [0.1, 1e-3];

/// Most contact times of a scan.
pub(crate) const MOST_TIMES: usize = 400;

/// A step is fine enough where the means change by less than this many standard errors.
const FINE: f64 = 1.0;

/// By how much minus twice the log likelihood may be above the least one at a time that may be accepted.
const PLAUSIBLE: f64 = 16.0;

/// By what share of their change over a step the means may differ from a straight line.
const BEND: f64 = 0.25;

/// A likelihood ratio that excludes a time without a test.
const EXCLUDED: f64 = 100.0;

/// Ranges nearer to each other than this ratio are one.
const NEAR: f64 = 1.02;

/// The same for ranges that begin below this contact time over the period: a rotor flies there, and neighbouring
/// motions may lock on cycles.
const FLIGHTS: f64 = 0.5;
const NEAR_FLIGHTS: f64 = 1.25;

/// The best fit of all else at a contact time.
struct Candidate<'a> {
    /// Zero for rigid impacts.
    time: f64,
    model: Model<'a>,
    state: Linearised,
    /// What the other parameters can imitate of a weighted change of the means.
    imitated: DMatrix<f64>,
}

impl<'a> Candidate<'a> {
    fn at(
        model: &Model<'a>,
        (time, start): (f64, DVector<f64>),
        evaluations: &mut Evaluations,
        watch: &Watch<'_>,
    ) -> Result<Self, FitError> {
        let nominal = model.nominal.with(|sheet| {
            sheet.contact = sheet.contact.filter(|_| time > 0.0);
            if time > 0.0 {
                FitParameter::ContactTime.set(sheet, time);
            }
        })?;
        let model = Model { nominal, ..model.clone() };
        evaluations.most = evaluations.spent + model.settings.most_evaluations;
        let state = Linearised::search(&model, start, evaluations, watch)?;
        let imitated = &state.directions.derivatives * state.directions.response();
        Ok(Self { time, model, state, imitated })
    }

    /// Weighted differences of means, without what the other parameters can change.
    fn weighted(&self, difference: &DVector<f64>) -> DVector<f64> {
        let weighted = self.state.weights.apply(difference);
        &weighted - &self.imitated * &weighted
    }

    /// Minus twice the log likelihood of means.
    fn deviance(&self, means: &DVector<f64>) -> f64 {
        self.weighted(&(means - &self.state.local.smooth)).norm_squared()
            + self.state.weights.ln_determinant()
    }

    /// The least deviance on the way to another time, and by how many standard errors the means change on it.
    fn on_way(&self, other: &Self, means: &DVector<f64>) -> (f64, f64) {
        let change = self.weighted(&(&other.state.local.smooth - &self.state.local.smooth));
        let rest = self.weighted(&(means - &self.state.local.smooth));
        let share = (rest.dot(&change) / change.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        ((rest - &change * share).norm_squared() + self.state.weights.ln_determinant(), change.norm())
    }
}

/// The candidates, the shortest contact time first.
pub(super) struct Scan<'a> {
    /// What is fitted at each contact time.
    rest: Model<'a>,
    /// The time (s) below which impacts count as rigid.
    rigid: f64,
    candidates: Vec<Candidate<'a>>,
    /// Times without a best fit, and the middles of steps that stay too long: nothing excludes them.
    undecided: Vec<f64>,
    evaluations: Evaluations,
}

impl<'a> Scan<'a> {
    /// A first scan of the range; rigid impacts stand for times below a tenth of a period.
    pub(super) fn over(range: FitRange, whole: &Model<'a>, watch: &Watch<'_>) -> Result<Self, FitError> {
        let ranges = whole.ranges.iter().filter(|other| **other != range).copied().collect();
        let rest = Model { ranges, ..whole.clone() };
        let rigid = RIGID * TAU / whole.nominal.system().platform().angular_frequency();
        let evaluations = Evaluations { spent: 0, most: 0 };
        let mut scan = Self { rest, rigid, candidates: Vec::new(), undecided: Vec::new(), evaluations };
        let first = range.low.max(rigid);
        if range.low < first {
            scan.add(0.0, watch)?;
        }
        if range.high > first {
            let width = ln(range.high / first);
            let steps = (width / STEPS[0]).ceil();
            for step in 0..=steps as usize {
                scan.add((first * exp(width * step as f64 / steps)).min(range.high), watch)?;
            }
        }
        if scan.candidates.is_empty() {
            return refused(FitRefusal::NotConverged { evaluations: scan.evaluations.spent });
        }
        Ok(scan)
    }

    /// A search at this time from the parameters of the next shorter one.
    fn add(&mut self, time: f64, watch: &Watch<'_>) -> Result<(), FitError> {
        let after = self.candidates.partition_point(|known| known.time < time);
        let near = self.candidates.get(after.saturating_sub(1));
        let start = near.map_or_else(|| self.rest.start(), |near| near.state.places.clone());
        match Candidate::at(&self.rest, (time, start), &mut self.evaluations, watch) {
            Err(FitError::Refused(FitRefusal::NotConverged { .. })) => self.undecided.push(time),
            new => self.candidates.insert(after, new?),
        }
        Ok(())
    }

    /// Divides steps on which means may be near the measured ones, until they change little on such.
    pub(super) fn refine(&mut self, measured: &DVector<f64>, watch: &Watch<'_>) -> Result<(), FitError> {
        loop {
            let known = &self.candidates;
            let pairs = known.iter().zip(&known[1..]);
            let mut steps: Vec<(f64, f64, f64)> = pairs
                .filter(|(one, next)| one.time > 0.0 && ln(next.time / one.time) > STEPS[1])
                .map(|(one, next)| {
                    let (ahead, back) = (one.on_way(next, measured), next.on_way(one, measured));
                    let (deviance, change) = if ahead.0 < back.0 { ahead } else { back };
                    (deviance, change, one.time * (next.time / one.time).sqrt())
                })
                .collect();
            let deviances = known.iter().map(|known| known.deviance(measured));
            let least = deviances.chain(steps.iter().map(|step| step.0)).fold(f64::INFINITY, f64::min);
            steps.retain(|&(deviance, change, time)| {
                change > FINE
                    && deviance < least + PLAUSIBLE + BEND * BEND * change * change
                    && !self.undecided.contains(&time)
            });
            if known.len() + self.undecided.len() + steps.len() > MOST_TIMES {
                self.undecided.extend(steps.drain(..).map(|step| step.2));
            }
            if steps.is_empty() {
                return Ok(());
            }
            for (_, _, time) in steps {
                self.add(time, watch)?;
            }
        }
    }

    /// The candidate with the least deviance.
    pub(super) fn best(&self, measured: &DVector<f64>) -> usize {
        let deviances: Vec<f64> = self.candidates.iter().map(|own| own.deviance(measured)).collect();
        (1..deviances.len()).fold(0, |best, next| if deviances[next] < deviances[best] { next } else { best })
    }

    /// Which candidates cannot be excluded: the ratio of the best likelihood to theirs is not beyond what 95 % of
    /// measurements of theirs have.
    pub(super) fn accepted(
        &self,
        measured: &DVector<f64>,
        widening: f64,
        watch: &Watch<'_>,
    ) -> Result<Vec<bool>, Error> {
        let (known, mut work) = (&self.candidates, watch.work());
        let least = known[self.best(measured)].deviance(measured);
        let accepts = |own: &Candidate<'_>| {
            let excess = own.deviance(measured) - least;
            if excess <= 0.0 || excess > EXCLUDED {
                return Ok(excess <= 0.0);
            }
            let resampled = differences(&own.model, &own.state.local).map(|difference| {
                work.spend(known.len() as u64)?;
                let means = &own.state.local.smooth + difference;
                let least = known.iter().map(|other| other.deviance(&means)).fold(f64::INFINITY, f64::min);
                Ok(own.deviance(&means) - least)
            });
            let mut resampled = resampled.collect::<Result<Vec<f64>, Error>>()?;
            resampled.sort_by(f64::total_cmp);
            Ok(excess <= widening * widening * percentile(&resampled, 0.95))
        };
        known.iter().map(accepts).collect()
    }

    /// The ranges of accepted and undecided times, each up to the next one that is excluded.
    pub(super) fn times(&self, accepted: &[bool]) -> Vec<AcceptedRange> {
        let mut ranges: Vec<AcceptedRange> = Vec::new();
        let flights = FLIGHTS / RIGID * self.rigid;
        let near = |end: f64| (NEAR_FLIGHTS * end).min(flights).max(NEAR * end);
        let known = self.candidates.iter().map(|own| own.time).zip(accepted.iter().copied());
        let mut all: Vec<_> = known.chain(self.undecided.iter().map(|&time| (time, true))).collect();
        all.sort_by(|one, next| one.0.total_cmp(&next.0));
        for (index, &(time, _)) in all.iter().enumerate().filter(|(_, own)| own.1) {
            let low = index.checked_sub(1).map(|before| all[before].0);
            let low = low.filter(|_| time > (1.0 + 1e-9) * self.rigid);
            let high = all.get(index + 1).map(|next| next.0);
            match ranges.last_mut() {
                Some(last) if last.high.is_some_and(|end| low <= Some(near(end))) => last.high = high,
                _ => ranges.push(AcceptedRange { parameter: FitParameter::ContactTime, low, high }),
            }
        }
        ranges
    }
}

/// Fits all else at each of many contact times in the range, and says which of these are possible.
pub(super) fn scan(whole: &Model<'_>, range: FitRange, watch: &Watch<'_>) -> Result<ParameterFit, FitError> {
    let (mut scan, measured) = (Scan::over(range, whole, watch)?, whole.measured());
    scan.refine(&measured, watch)?;
    let best = scan.best(&measured);
    let Candidate { model, state, time: value, .. } = &scan.candidates[best];
    let mut fit = ParameterFit::of(model, state, scan.evaluations.spent, watch)?;
    let widening = widening_for(fit.misfit, fit.degrees_of_freedom, model)?;
    let accepted = scan.accepted(&measured, widening, watch)?;
    // The others have intervals that hold those at all accepted times, and none if these are not known at one.
    let mut unknown = !scan.undecided.is_empty();
    for (index, own) in scan.candidates.iter().enumerate() {
        if index != best && accepted[index] && !fit.parameters.is_empty() {
            let others = ParameterFit::estimates(&own.model, &own.state, widening, watch);
            if matches!(others, Err(FitError::Refused(FitRefusal::AtRangeEnd { .. }))) {
                unknown = true;
                continue;
            }
            for (all, other) in fit.parameters.iter_mut().zip(others?) {
                let both = all.estimate.zip(other.estimate);
                all.estimate = both.map(|(all, other)| IntervalEstimate {
                    value: all.value,
                    low: all.low.min(other.low),
                    high: all.high.max(other.high),
                });
            }
        }
    }
    fit.parameters.iter_mut().filter(|_| unknown).for_each(|all| all.estimate = None);
    fit.contact_times = scan.times(&accepted);
    let estimate = match fit.contact_times[..] {
        [AcceptedRange { low: Some(low), high: Some(high), .. }] => {
            Some(IntervalEstimate { value: *value, low, high })
        }
        _ => None,
    };
    let (parameter, nominal) = (range.parameter, range.parameter.of(&whole.nominal));
    let place = whole.ranges.iter().position(|other| *other == range).unwrap_or(0);
    fit.parameters.insert(place, ParameterEstimate { parameter, nominal, estimate });
    Ok(fit)
}
