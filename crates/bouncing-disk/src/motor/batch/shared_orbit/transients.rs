//! The speed transients of many rotors on one vertical motion.

use bouncing_disk_core::run::WorkCount;
use bouncing_disk_core::sweep::{InstructionSet, LaneLoop, LaneRunner};
use bouncing_disk_core::{Impact, OrbitEvent, Phase};

use crate::driven::DrivenSystem;
use crate::error::{Error, room_for, within_limit};
use crate::motion::phase_time::PhaseTime;
use crate::motor::batch::members::{MAX_MEMBERS, MAX_SPEEDS};
use crate::motor::batch::rotor_rows::{RotorRows, Row, SharedImpact, WIDTH};
use crate::motor::batch::shared_orbit::shared_by;
use crate::motor::batch::shared_orbit::vertical::VerticalMotion;
use crate::motor::rotor::transient::{
    Bins, FLIGHTS_OF_EVENT, Interval, SpeedCurve, TransientSettings, curve, seconds,
};
use crate::motor::rotor::{Rotor, RotorStep};
use crate::motor::tape::source::Source;
use crate::motor::tape::taped::{Taped, resolution};
use crate::parameters::driven_platform::{DrivenPlatform, Waveform};
use crate::parameters::scales::Scales;
use crate::parameters::system::System;

/// The speed transients of motors that share one vertical motion: bit for bit those of
/// [`transient`](crate::motor::transient()) for each, in their order, for a fraction of the time.
///
/// They may differ in load, friction, phase lag, twist amplitude and radii. They start together at `phase`,
/// with the same perturbations of their relaunches (`settings.seed`), so that a difference between two of
/// them is much better known than either.
///
/// # Errors
/// [`Error::NotShared`] for motors with different peak accelerations, restitutions, frequencies or preloads;
/// [`Error::OutOfRange`] for none; an error of the core for more than [`MAX_MEMBERS`] or for curves of more
/// than [`MAX_SPEEDS`] speeds together; those of [`transient`](crate::motor::transient()).
pub(crate) fn shared_transients(
    systems: &[System],
    phase: Phase,
    settings: &TransientSettings,
    set: InstructionSet,
    work: &mut WorkCount<'_>,
) -> Result<Vec<SpeedCurve>, Error> {
    let first = shared_by(systems)?;
    settings.check_for(&first.scales())?;
    within_limit("rotors on one vertical motion", systems.len(), MAX_MEMBERS)?;
    within_limit("speeds of all curves", systems.len().saturating_mul(settings.intervals), MAX_SPEEDS)?;
    let perturbation = (settings.relaunch_perturbation, settings.seed);
    if first.soft_contact().is_some() {
        return soft_transients(systems, phase, settings, perturbation, work);
    }
    let vertical = VerticalMotion::from_rest(first.dimensionless(), phase, settings.policy, perturbation)?;
    let Some(vertical) = vertical else {
        // Rotors that never leave the platform share no vertical motion.
        return systems.iter().map(|system| SpeedCurve::alone(system, phase, settings, work)).collect();
    };
    let mut run = SharedRun::new(systems, phase, settings, vertical, set)?;
    run.compute(work)?;
    run.finished()
}

/// The same where contacts take time, up to the error of angles that are spread evenly between the releases next to
/// the ends of the intervals.
fn soft_transients(
    systems: &[System],
    phase: Phase,
    settings: &TransientSettings,
    perturbation: (f64, u64),
    work: &mut WorkCount<'_>,
) -> Result<Vec<SpeedCurve>, Error> {
    let driven = systems.iter().map(|system| {
        let stator = DrivenPlatform::new(*system.platform(), Waveform::Sine, Waveform::Sine)?;
        DrivenSystem::new(&stator.with_contact(system.soft_contact()), system.disk())
    });
    let driven = driven.collect::<Result<Vec<_>, Error>>()?;
    let source = Source::driven(&driven[0], (phase, None), perturbation)?;
    let mut member =
        Taped::new(source, resolution(1.0), driven.iter().map(|system| (system.rotor(), 0.0, 1.0)));
    let bins = systems.iter().map(|_| Bins::new(settings.duration, settings.intervals));
    let mut bins = bins.collect::<Result<Vec<_>, Error>>()?;
    let (mut passed, mut impacts, unit) = (0.0, 0, systems[0].scales().time);
    while bins[0].present.reached < settings.duration {
        let left = (bins[0].present.end - bins[0].present.reached) / unit;
        let window = member.next_window(left, &(1..=u64::MAX), work)?;
        passed += window.axial.duration;
        impacts += window.axial.impacts;
        for (bins, rotor) in bins.iter_mut().zip(&window.rotors) {
            bins.add(passed * unit, rotor.angle);
        }
    }
    let curves = bins.into_iter().zip(systems);
    curves.map(|(bins, system)| curve(bins, &system.scales(), (impacts, impacts))).collect()
}

/// Angles turned by the rotors of a row.
#[derive(Debug, Clone, Copy, Default)]
struct Turned {
    /// In the last flight.
    last: Row,
    /// In the present interval of the curve.
    sum: Row,
}

/// Carries all rotors through a flight and the impact that ends it.
struct CarryAll<'a> {
    impact: SharedImpact,
    /// Whether the flight ends in the present interval of the curve, so that its angle belongs to it.
    is_within: bool,
    rows: &'a mut [RotorRows<Turned>],
}

impl LaneLoop for CarryAll<'_> {
    #[inline(always)]
    fn run(self) {
        let Self { impact, is_within, rows } = self;
        for rotors in rows {
            for own in 0..WIDTH {
                let (speed, turned) = rotors.bounce(own, &impact).after(rotors.speed[own]);
                rotors.speed[own] = speed;
                let tally = &mut rotors.tally;
                tally.last[own] = turned;
                tally.sum[own] = if is_within { tally.sum[own] + turned } else { tally.sum[own] };
            }
        }
    }
}

/// One rotor while the disk lies on the platform, and its curve.
#[derive(Debug)]
struct Carried {
    rotor: Rotor,
    turned: Vec<f64>,
    separations: u64,
    unit: Scales,
}

/// Transients under way.
#[derive(Debug)]
struct SharedRun {
    vertical: VerticalMotion,
    carried: Vec<Carried>,
    rows: Vec<RotorRows<Turned>>,
    runner: LaneRunner,
    /// The present interval of all curves; the rows hold the angles turned in it.
    interval: Interval,
    /// Duration of an interval (s).
    width: f64,
    /// Duration (s).
    duration: f64,
    /// Angle (rad) of the start.
    start: f64,
    /// Unit of time (s).
    time: f64,
    impacts: u64,
}

impl SharedRun {
    fn new(
        systems: &[System],
        phase: Phase,
        settings: &TransientSettings,
        vertical: VerticalMotion,
        set: InstructionSet,
    ) -> Result<Self, Error> {
        let Bins { width, present: interval, .. } = Bins::new(settings.duration, settings.intervals)?;
        let mut carried = room_for("rotors on one vertical motion", systems.len(), MAX_MEMBERS)?;
        for system in systems {
            carried.push(Carried {
                rotor: Rotor::at_rest(system.dimensionless(), phase, 0.0, settings.policy)?,
                turned: Bins::new(settings.duration, settings.intervals)?.turned,
                separations: 0,
                unit: system.scales(),
            });
        }
        Ok(Self {
            vertical,
            rows: RotorRows::of(systems.iter().map(|system| *system.dimensionless())),
            runner: LaneRunner::new(set),
            interval,
            width,
            duration: settings.duration,
            start: phase.angle(),
            time: carried[0].unit.time,
            carried,
            impacts: 0,
        })
    }

    fn seconds(&self, time: PhaseTime) -> f64 {
        seconds(time.periods as f64, time.phase.angle() - self.start, self.time)
    }

    fn is_done(&self) -> bool {
        self.interval.reached >= self.duration
    }

    fn compute(&mut self, work: &mut WorkCount<'_>) -> Result<(), Error> {
        let rotors = self.carried.len() as u64;
        // A start on a platform that falls away is a flight.
        if self.carried.iter().all(|one| one.rotor.launch().is_none()) {
            self.rest(|_, _| {})?;
        }
        while !self.is_done() {
            match self.vertical.advance()? {
                Some(OrbitEvent::Impact(impact)) => {
                    self.hit(&impact);
                    work.spend(1 + rotors / WIDTH as u64)?;
                }
                Some(OrbitEvent::Attachment(rest)) => {
                    let now = self.vertical.now();
                    self.rest(|rotor, speed| rotor.rest_after(now, speed, &rest))?;
                    work.spend(FLIGHTS_OF_EVENT * (1 + rotors))?;
                }
                // A platform that has let the disk go once does so for ever.
                Some(_) | None => break,
            }
        }
        Ok(())
    }

    fn hit(&mut self, impact: &Impact) {
        self.impacts += 1;
        let to = self.seconds(self.vertical.now());
        let is_within = to <= self.interval.end;
        let impact = SharedImpact::new(impact, self.vertical.restitution());
        self.runner.run(CarryAll { impact, is_within, rows: &mut self.rows });
        if is_within {
            self.interval.reached = to;
            return;
        }
        let mut reached = self.interval;
        for (index, one) in self.carried.iter_mut().enumerate() {
            let (row, own) = (&mut self.rows[index / WIDTH], index % WIDTH);
            let mut interval = Interval { turned: row.tally.sum[own], ..self.interval };
            interval.pass(&mut one.turned, self.width, to, row.tally.last[own]);
            row.tally.sum[own] = interval.turned;
            reached = interval;
        }
        self.interval = reached;
    }

    /// Carries each rotor through a rest of the disk up to its separation, or up to the end of the transient.
    /// `begin` puts a rotor with the speed of the last impact on the platform.
    fn rest(&mut self, mut begin: impl FnMut(&mut Rotor, f64)) -> Result<(), Error> {
        let (began, mut separation, mut reached) = (self.vertical.now(), None, self.interval);
        for (index, one) in self.carried.iter_mut().enumerate() {
            let (row, own) = (&mut self.rows[index / WIDTH], index % WIDTH);
            let mut bins = Bins {
                turned: std::mem::take(&mut one.turned),
                width: self.width,
                present: Interval { turned: row.tally.sum[own], ..self.interval },
            };
            let mut add = |rotor: &Rotor| {
                let now = rotor.time();
                bins.add(
                    seconds(now.periods as f64, now.phase.angle() - self.start, self.time),
                    rotor.turned(),
                );
                bins.present.reached < self.duration
            };
            begin(&mut one.rotor, row.speed[own]);
            let mut goes_on = one.rotor.time() == began || add(&one.rotor);
            while goes_on {
                match one.rotor.advance()? {
                    RotorStep::Separation => {
                        one.separations += 1;
                        separation = Some(one.rotor.time());
                        add(&one.rotor);
                        goes_on = false;
                    }
                    RotorStep::Ended => goes_on = false,
                    RotorStep::Impact | RotorStep::Contact => goes_on = add(&one.rotor),
                }
            }
            row.speed[own] = one.rotor.speed();
            row.tally.sum[own] = bins.present.turned;
            one.turned = bins.turned;
            reached = bins.present;
        }
        self.interval = reached;
        if let Some(time) = separation {
            self.vertical.separate(time)?;
        }
        Ok(())
    }

    fn finished(self) -> Result<Vec<SpeedCurve>, Error> {
        let mut curves = room_for("rotors on one vertical motion", self.carried.len(), MAX_MEMBERS)?;
        for (index, one) in self.carried.into_iter().enumerate() {
            let turned = self.rows[index / WIDTH].tally.sum[index % WIDTH];
            let present = Interval { turned, ..self.interval };
            let bins = Bins { turned: one.turned, width: self.width, present };
            curves.push(curve(bins, &one.unit, (self.impacts, one.separations))?);
        }
        Ok(curves)
    }
}

#[cfg(test)]
mod tests;
