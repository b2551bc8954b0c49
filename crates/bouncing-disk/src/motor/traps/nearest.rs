//! How near a motor is to a low-period trap.

use std::f64::consts::PI;

use bouncing_disk_core::elementary::{exp, ln_1p};
use bouncing_disk_core::{ImpactMap, Observer, Unobserved, Vibration, Watch, WorkCount};

use crate::error::{Error, check};
use crate::motor::data_sheet::Motor;
use crate::motor::traps::TrapVerdict;

/// Step of the scan in the axial forcing parameter Gamma. Traps of a single flight are about a twentieth
/// wide.
const STEP: f64 = 1.0 / 2048.0;

/// Most steps on either side. A motor with so large a Gamma that they do not suffice is scanned in wider
/// ones.
const MOST_STEPS: f64 = 100_000.0;

/// Halvings of a step that find the edge of a trap: to 1e-9 of Gamma's unit.
const HALVINGS: u32 = 20;

/// The low-period trap that is nearest to a motor.
///
/// Only Gamma and the restitution decide, so that the same trap is reached by a change of preload, of
/// amplitude or of frequency: the near edge is given for each of them, the others kept.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct NearestTrap {
    /// Distance of the near edge: the relative change of amplitude or preload that reaches it, the smaller of
    /// the two in size; zero for a motor in the trap.
    pub relative_distance: f64,
    /// Preload (m/s^2) of the near edge; that of the motor, if it is in the trap.
    pub preload_acceleration: f64,
    /// Amplitude (m) of the near edge.
    pub amplitude: f64,
    /// Drive frequency (Hz) of the near edge.
    pub drive_frequency: f64,
    /// From where to where in Gamma the trap reaches, or the range that was scanned does.
    pub forcing_from_to: [f64; 2],
    /// What the rotor does in the middle of it.
    pub verdict: TrapVerdict,
    /// Step of the scan in Gamma: traps that are narrower may have been missed.
    pub forcing_step: f64,
}

impl Motor {
    /// The low-period trap that is nearest to the motor, if there is one within a relative change of its
    /// preload or amplitude of `relative_range`, in (0, 1].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for another range; the errors of the flights.
    pub fn nearest_trap(&self, relative_range: f64) -> Result<Option<NearestTrap>, Error> {
        self.nearest_trap_observed(relative_range, &Unobserved)
    }

    /// [`Self::nearest_trap`] with an observer; the items are the steps to either side.
    ///
    /// # Errors
    /// Those of [`Self::nearest_trap`]; an error of the core
    /// ([`Stopped`](bouncing_disk_core::Error::Stopped)) if the observer breaks.
    pub fn nearest_trap_observed(
        &self,
        relative_range: f64,
        observer: &dyn Observer,
    ) -> Result<Option<NearestTrap>, Error> {
        let legal = relative_range > 0.0 && relative_range <= 1.0;
        check(legal, "relative_range", relative_range, "(0, 1]")?;
        let (peak, reach) = (self.system().peak_acceleration(), ln_1p(relative_range));
        // The stator that never throws has no trap, however hard it is shaken within the range.
        if peak <= 0.0 {
            return Ok(None);
        }
        let step = (PI * STEP / peak).max(reach / MOST_STEPS).min(reach);
        let steps = (reach / step).floor() as u64;
        let watch = Watch::begin(observer, 0, steps)?;
        let scan = Scan { motor: self, peak, reach, step };
        let found = scan.nearest(steps, &watch)?;
        watch.end();
        Ok(found)
    }
}

/// A scan over the logarithm of the forcing, relative to that of the motor.
struct Scan<'a> {
    motor: &'a Motor,
    peak: f64,
    reach: f64,
    step: f64,
}

impl Scan<'_> {
    fn verdict(&self, offset: f64, work: &mut WorkCount<'_>) -> Result<TrapVerdict, Error> {
        let map = self.motor.system().dimensionless().map();
        // The motor itself to the last bit.
        if offset == 0.0 {
            return TrapVerdict::of(map, self.motor.preload_acceleration(), work);
        }
        let factor = exp(offset);
        let map = ImpactMap::new(Vibration::new(self.peak * factor)?, map.restitution())?;
        TrapVerdict::of(&map, self.motor.preload_acceleration() / factor, work)
    }

    fn is_trap(&self, offset: f64, work: &mut WorkCount<'_>) -> Result<bool, Error> {
        Ok(self.verdict(offset, work)?.is_trap)
    }

    fn nearest(&self, steps: u64, watch: &Watch<'_>) -> Result<Option<NearestTrap>, Error> {
        let mut work = watch.work();
        if self.is_trap(0.0, &mut work)? {
            let ends = [self.end(0.0, -1.0, &mut work)?, self.end(0.0, 1.0, &mut work)?];
            return self.described(0.0, ends, &mut work).map(Some);
        }
        for index in 1..=steps {
            watch.set_done(index - 1);
            let mut nearest: Option<(f64, f64)> = None;
            for sign in [-1.0, 1.0] {
                let outside = sign * self.step * (index - 1) as f64;
                let inside = sign * self.step * index as f64;
                if self.is_trap(inside, &mut work)? {
                    let edge = self.edge(inside, outside, &mut work)?;
                    if nearest.is_none_or(|(other, _)| edge.abs() < other.abs()) {
                        nearest = Some((edge, inside));
                    }
                }
            }
            if let Some((edge, inside)) = nearest {
                let far = self.end(inside, edge.signum(), &mut work)?;
                let ends = if edge < far { [edge, far] } else { [far, edge] };
                return self.described(edge, ends, &mut work).map(Some);
            }
        }
        Ok(None)
    }

    /// The last offset in the trap, between one in it and one that is not.
    fn edge(&self, mut inside: f64, mut outside: f64, work: &mut WorkCount<'_>) -> Result<f64, Error> {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (inside + outside);
            if self.is_trap(middle, work)? {
                inside = middle;
            } else {
                outside = middle;
            }
        }
        Ok(inside)
    }

    /// The end of a trap in a direction, or of the range.
    fn end(&self, inside: f64, sign: f64, work: &mut WorkCount<'_>) -> Result<f64, Error> {
        let mut last = inside;
        while last.abs() <= self.reach {
            let next = last + sign * self.step;
            if !self.is_trap(next, work)? {
                return self.edge(last, next, work);
            }
            last = next;
        }
        Ok(last)
    }

    fn described(&self, offset: f64, ends: [f64; 2], work: &mut WorkCount<'_>) -> Result<NearestTrap, Error> {
        let (motor, factor) = (self.motor, exp(offset));
        let forcing = self.peak / PI;
        Ok(NearestTrap {
            relative_distance: 1.0 - 1.0 / exp(offset.abs()),
            preload_acceleration: motor.preload_acceleration() / factor,
            amplitude: motor.parameters().amplitude * factor,
            drive_frequency: motor.parameters().drive_frequency * factor.sqrt(),
            forcing_from_to: ends.map(|end| forcing * exp(end)),
            verdict: self.verdict(0.5 * (ends[0] + ends[1]), work)?,
            forcing_step: forcing * self.step,
        })
    }
}
