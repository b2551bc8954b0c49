//! The run-up of a motor from rest, on any kind of stator.

use std::ops::ControlFlow;

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::run::{Watch, in_parallel};
use bouncing_disk_core::{Observer, Phase, Progress};

use crate::driven::{DrivenEngine, DrivenStart, DrivenSystem};
use crate::error::Error;
use crate::motion::event::{Event, Motion, SteeredMotion};
use crate::motion::phase_time::PhaseTime;
use crate::motor::batch::members::TransientMember;
use crate::motor::batch::transients::transients;
use crate::motor::data_sheet::Motor;
use crate::motor::rotor::transient::{
    Bins, FLIGHTS_OF_EVENT, SpeedCurve, TransientSettings, curve, transient,
};
use crate::motor::stator::{Stator, lines, still};
use crate::motor::tape::tapped::Tapped;
use crate::parameters::load::LoadLaw;
use crate::parameters::scales::Scales;
use crate::stator::{StatorEngine, StatorSystem};

impl Motor {
    /// The speed transient of the rotor, which lies at rest on the stator as the stator begins to move at
    /// `phase`.
    ///
    /// The observer's items are the intervals of the curve.
    ///
    /// ```
    /// use bouncing_disk::Motor;
    /// use bouncing_disk::core::{Phase, Unobserved};
    /// use bouncing_disk::motor::TransientSettings;
    /// use bouncing_disk::parameters::Waveform;
    ///
    /// // The height of the stator has a second harmonic with a tenth of the amplitude.
    /// let motor = Motor::paper_70_khz()
    ///     .with(|sheet| sheet.drive.height = Waveform::Fourier(vec![(1.0, 0.0), (0.1, 0.3)]))?;
    /// let settings = TransientSettings { duration: 0.1, intervals: 10, ..TransientSettings::default() };
    /// let run_up = motor.transient(Phase::new(0.0)?, &settings, &Unobserved)?;
    /// assert!(run_up.impacts > 10 && run_up.speeds[9] > 0.0);
    /// # Ok::<(), bouncing_disk::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for illegal settings; the errors of the flights.
    pub fn transient(
        &self,
        phase: Phase,
        settings: &TransientSettings,
        observer: &dyn Observer,
    ) -> Result<SpeedCurve, Error> {
        Ok(self.run_up(phase, settings, observer)?.0)
    }

    /// Like [`Self::transient`], with the amplitude (m) of the axial mode at the end of each interval,
    /// defined as in [`MotorOutputs::amplitude`](crate::motor::MotorOutputs::amplitude); empty for a rigid
    /// stator. On a compliant stator the chatter policy of the settings has no effect: impacts are followed
    /// until the remaining chatter lasts 1e-7 rad.
    ///
    /// # Errors
    /// The errors of [`Self::transient`].
    pub fn run_up(
        &self,
        phase: Phase,
        settings: &TransientSettings,
        observer: &dyn Observer,
    ) -> Result<(SpeedCurve, Vec<f64>), Error> {
        match self.stator_motion() {
            Stator::Sine => Ok((transient(self.system(), phase, settings, observer)?, Vec::new())),
            Stator::Driven(own) => {
                let unit = self.system().scales();
                Ok((driven_run_up(&own.system, &unit, phase, settings, observer)?, Vec::new()))
            }
            Stator::Yielding(own) => self.yielding_run_up(own, phase, settings, observer),
        }
    }

    /// The transients of members with these phases and settings, computed on several threads if available.
    /// With rigid impacts on a sine, the members are computed in lockstep, as in [`transients`].
    ///
    /// The observer's items are the members.
    ///
    /// # Errors
    /// The first error of [`Self::transient`].
    pub fn transients(
        &self,
        members: &[TransientMember],
        observer: &dyn Observer,
    ) -> Result<Vec<SpeedCurve>, Error> {
        if let Stator::Sine = self.stator_motion() {
            let own = |member: &TransientMember| TransientMember { system: *self.system(), ..*member };
            let members: Vec<_> = members.iter().map(own).collect();
            return transients(&members, observer)?.into_iter().collect();
        }
        let watch = Watch::begin(observer, 0, members.len() as u64)?;
        let curves = in_parallel(members.len(), |index| {
            let TransientMember { phase, settings, .. } = &members[index];
            let stops = |_: Progress| watch.ask().map_or(ControlFlow::Break(()), ControlFlow::Continue);
            let curve = self.transient(*phase, settings, &stops);
            watch.finish(1);
            curve
        });
        let curves = curves.into_iter().collect();
        watch.end();
        curves
    }

    /// The run-up on a compliant stator, or under a load that follows a law.
    fn yielding_run_up(
        &self,
        stator: &StatorSystem,
        phase: Phase,
        settings: &TransientSettings,
        observer: &dyn Observer,
    ) -> Result<(SpeedCurve, Vec<f64>), Error> {
        let system = self.on_shaft()?;
        let unit = system.scales();
        settings.check_for(&unit)?;
        let watch = Watch::begin(observer, 0, settings.intervals as u64)?;
        let mut work = watch.work();
        let (load, mut amplitudes, mut switched) = (self.load(), Vec::new(), 0.0);
        let under = |load: &LoadLaw, time: f64| {
            let lines = lines(load, time, &system, self.mass());
            let own = if load.drives_at(time) { stator.clone() } else { still(stator)? };
            own.with_load(&lines)
        };
        let begun = load.map_or_else(|| Ok(stator.clone()), |load| under(&load, 0.0))?;
        let mut engine = StatorEngine::new(begun, DrivenStart::Contact { phase, angular_speed: 0.0 })?;
        if load.is_some_and(|load| !load.drives_at(0.0)) {
            engine.calm();
        }
        engine.skip_energies();
        let mut run = RunUp::new(settings, &unit, engine.time())?;
        while run.goes_on() {
            work.spend(FLIGHTS_OF_EVENT)?;
            let (angle, now) = (engine.disk().angle, run.passed(&engine.time()));
            let left = settings.duration / unit.time - now;
            let change = load.and_then(|load| Some((load, load.next_change_after(switched)?)));
            let change = change.filter(|(_, change)| change / unit.time < left + now);
            let mut until = change.map_or(left, |(_, change)| (change / unit.time - now).max(0.0));
            let boundary = (amplitudes.len() + 1) as f64 * run.bins.width / unit.time - now;
            let samples = engine.amplitude_after(0.0).is_some() && boundary < until;
            if samples {
                until = boundary.max(0.0);
            }
            if let Some(record) = engine.advance_within(until)? {
                run.count(&mut engine, &record.event, angle);
                watch.set_done(run.bins.present.index as u64);
            } else if samples {
                amplitudes.extend(engine.amplitude_after(until).map(|amplitude| amplitude * unit.length));
                if engine.pause_contact(until).is_some() {
                    run.bins.add((now + until) * unit.time, engine.disk().angle - angle);
                }
            } else if let Some((load, change)) = change {
                engine.switch(until, under(&load, change)?);
                switched = change;
                run.bins.add(change, engine.disk().angle - angle);
            } else {
                run.coast(&engine);
                break;
            }
        }
        watch.end();
        let left = settings.duration / unit.time - run.passed(&engine.time());
        if let (Some(last), true) = (engine.amplitude_after(left), amplitudes.len() < settings.intervals) {
            amplitudes.resize(settings.intervals, last * unit.length);
        }
        Ok((run.finished()?, amplitudes))
    }
}

/// The run-up on a stator that moves by waveforms, or with compliant contacts.
fn driven_run_up(
    system: &DrivenSystem,
    unit: &Scales,
    phase: Phase,
    settings: &TransientSettings,
    observer: &dyn Observer,
) -> Result<SpeedCurve, Error> {
    settings.check_for(unit)?;
    let watch = Watch::begin(observer, 0, settings.intervals as u64)?;
    let mut work = watch.work();
    let start = DrivenStart::Contact { phase, angular_speed: 0.0 };
    let mut engine = DrivenEngine::new(system.clone(), start, settings.policy)?;
    engine.skip_energies();
    let mut tapped = Tapped::new(std::iter::once(system));
    let mut run = RunUp::new(settings, unit, engine.time())?;
    while run.goes_on() {
        if let Some(tapped) = &mut tapped
            && let Some(launch) = engine.flight()
        {
            tapped.begin(engine.time(), launch, std::iter::once(engine.state().angular_speed));
            while run.goes_on()
                && let Some(angle) = tapped.turn()
            {
                work.spend(2)?;
                (run.impacts, run.separations) = (run.impacts + 1, run.separations + 1);
                if let Some(speed) = run.perturbation() {
                    tapped.perturb(speed);
                }
                run.bins.add(run.passed(&tapped.time) * unit.time, angle);
                watch.set_done(run.bins.present.index as u64);
            }
            let speed = tapped.speeds().next().unwrap_or_default();
            engine.fly_from(tapped.time, tapped.launch, speed);
            if !run.goes_on() {
                break;
            }
        }
        work.spend(FLIGHTS_OF_EVENT)?;
        let angle = engine.disk().angle;
        let left = settings.duration / unit.time - run.passed(&engine.time());
        let Some(record) = engine.advance_within(left)? else {
            run.coast(&engine);
            break;
        };
        run.count(&mut engine, &record.event, angle);
        watch.set_done(run.bins.present.index as u64);
    }
    watch.end();
    run.finished()
}

/// A run-up under way.
struct RunUp<'a> {
    settings: &'a TransientSettings,
    unit: &'a Scales,
    began: PhaseTime,
    bins: Bins,
    generator: SplitMix64,
    impacts: u64,
    separations: u64,
}

impl<'a> RunUp<'a> {
    fn new(settings: &'a TransientSettings, unit: &'a Scales, began: PhaseTime) -> Result<Self, Error> {
        let bins = Bins::new(settings.duration, settings.intervals)?;
        let generator = SplitMix64::new(settings.seed);
        Ok(Self { settings, unit, began, bins, generator, impacts: 0, separations: 0 })
    }

    fn goes_on(&self) -> bool {
        self.bins.present.reached < self.settings.duration
    }

    /// Radians since the start.
    fn passed(&self, time: &PhaseTime) -> f64 {
        time.since(&self.began).radians()
    }

    /// The relative speed of the next relaunch, if relaunches are perturbed.
    fn perturbation(&mut self) -> Option<f64> {
        let size = self.settings.relaunch_perturbation;
        (size > 0.0).then(|| size * self.generator.unit())
    }

    /// Counts an event; since the previous event the rotor has turned from this `angle`.
    fn count(&mut self, engine: &mut impl SteeredMotion, event: &Event, angle: f64) {
        match event {
            Event::Impact { .. } | Event::Kick { .. } | Event::Recontact => self.impacts += 1,
            Event::Separation => self.separations += 1,
            _ => {}
        }
        if event.is_relaunch()
            && let Some(speed) = self.perturbation()
        {
            engine.perturb_launch(speed);
        }
        self.bins.add(self.passed(&engine.time()) * self.unit.time, engine.disk().angle - angle);
    }

    /// Continues the motion through the remaining intervals when no event is left.
    fn coast(&mut self, engine: &impl SteeredMotion) {
        let (angle, now) = (engine.disk().angle, self.passed(&engine.time()));
        let mut turned = 0.0;
        for index in self.bins.present.index..self.settings.intervals {
            let last = index + 1 == self.settings.intervals;
            let to = if last { self.settings.duration } else { (index + 1) as f64 * self.bins.width };
            let then = engine.disk_after(to / self.unit.time - now);
            self.bins.add(to, then.angle - angle - turned);
            turned = then.angle - angle;
        }
    }

    fn finished(self) -> Result<SpeedCurve, Error> {
        curve(self.bins, self.unit, (self.impacts, self.separations))
    }
}
