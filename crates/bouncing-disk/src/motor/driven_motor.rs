//! A motor whose stator moves in any way: run-up, operating points, stall.

use std::ops::ControlFlow;

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::run::{Watch, in_parallel};
use bouncing_disk_core::{Observer, Phase, Progress};

use crate::driven::DrivenSystem;
use crate::error::Error;
use crate::motion::event::Event;
use crate::motor::batch::members::TransientMember;
use crate::motor::data_sheet::Motor;
use crate::motor::operation::best_phase_lag::{BestPhaseLag, best_phase_lag};
use crate::motor::operation::carrier::{CarriedEngine, Carrier};
use crate::motor::operation::ensemble::{Ends, LoadedMotor, continued, curve_of};
use crate::motor::operation::point::Operation;
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::operation::stall_load::{StallLoad, stall_load};
use crate::motor::operation::tapped::Tapped;
use crate::motor::rotor::transient::{Bins, FLIGHTS_OF_EVENT, SpeedCurve, TransientSettings, curve};
use crate::parameters::contact::{Contact, ContactLaw};
use crate::parameters::dimensionless::DimensionlessParameters;
use crate::parameters::driven_platform::{DriveParameters, DrivenPlatform, Waveform};
use crate::parameters::load::LoadLaw;
use crate::parameters::system::System;
use crate::stator::{LoadLine, StatorSystem};

/// A [`Motor`] whose stator moves by waveforms in place of the sines of Eq. (1), or whose contacts take the time
/// that its sheet has in the table `[contact]`, whose stator yields by its table `[stator]`, or whose load varies
/// by its table `[load]`.
///
/// ```
/// use bouncing_disk::Motor;
/// use bouncing_disk::core::{Phase, Unobserved};
/// use bouncing_disk::motor::{DrivenMotor, TransientSettings};
/// use bouncing_disk::parameters::Waveform;
///
/// // The height of the stator has a second harmonic with a tenth of the amplitude.
/// let height = Waveform::Fourier(vec![(1.0, 0.0), (0.1, 0.3)]);
/// let motor = DrivenMotor::new(Motor::paper_70_khz(), height, Waveform::Sine)?;
/// let settings = TransientSettings { duration: 0.1, intervals: 10, ..TransientSettings::default() };
/// let run_up = motor.transient(Phase::new(0.0)?, &settings, &Unobserved)?;
/// assert!(run_up.impacts > 10 && run_up.speeds[9] > 0.0);
/// # Ok::<(), bouncing_disk::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct DrivenMotor {
    motor: Motor,
    stator: DrivenPlatform,
    carrier: Carrier,
    /// The sine with the same largest speeds.
    bound: System,
}

impl DrivenMotor {
    /// The motor with these waveforms, which multiply the amplitudes of its stator.
    ///
    /// # Errors
    /// Those of [`DrivenPlatform::new`] and [`DrivenSystem::new`].
    pub fn new(motor: Motor, height: Waveform, angle: Waveform) -> Result<Self, Error> {
        Self::on(motor, DrivenPlatform::new(*motor.system().platform(), height, angle)?)
    }

    fn on(motor: Motor, stator: DrivenPlatform) -> Result<Self, Error> {
        let stator = stator.with_contact(motor.system().soft_contact());
        if motor.stator().is_some() || motor.load().is_some() {
            return Self::yielding(motor, stator);
        }
        let rigid = motor.system().with_contact(None)?;
        let system = DrivenSystem::new(&stator, motor.system().disk())?;
        let scales = motor.system().scales();
        let bound = rigid.with_platform(|platform| {
            platform.amplitude = system.height().bounds().speed * scales.length;
            platform.twist_amplitude = system.angle().bounds().speed * scales.angle;
        })?;
        Ok(Self { motor, stator, carrier: Carrier::Driven(system), bound })
    }

    /// On a stator that yields, or under a load that varies.
    fn yielding(motor: Motor, stator: DrivenPlatform) -> Result<Self, Error> {
        if stator.height() != &Waveform::Sine || stator.angle() != &Waveform::Sine {
            let other = if motor.stator().is_some() { "stator" } else { "load" };
            return Err(Error::BothGiven { one: "drive", other });
        }
        let (mut own, bound) = with_shaft(&motor)?;
        if let Some(load) = motor.load() {
            let stops = !load.drives_at(f64::NEG_INFINITY) || !load.drives_at(f64::MAX);
            if stops && motor.stator().is_none() {
                return Err(Error::SwitchedMotion);
            }
            own = own.with_load(&lines(&load, 0.0, &bound, motor.mass()))?;
        }
        Ok(Self { motor, stator, carrier: Carrier::Yielding(Box::new(own)), bound })
    }

    /// The stator and the load at a time (s) after the start.
    fn carrier_at(&self, time: f64) -> Result<StatorSystem, Error> {
        let Some(own) = self.carrier.yielding() else { return Err(Error::YieldingStator) };
        let Some(load) = self.motor.load() else { return Ok(own.clone()) };
        let lines = lines(&load, time, &self.bound, self.motor.mass());
        if load.drives_at(time) { own.clone().with_load(&lines) } else { still(own)?.with_load(&lines) }
    }

    /// The motor with the motion that the table `[drive]` of a file gives.
    ///
    /// # Errors
    /// Those of [`Self::new`]; [`Error::StartPhase`]; [`Error::BothGiven`] for a stator that yields, or a load that varies; [`Error::SwitchedMotion`] for a load that switches a prescribed motion.
    pub fn of_drive(motor: Motor, drive: &DriveParameters) -> Result<Self, Error> {
        Self::on(motor, DrivenPlatform::of_drive(*motor.system().platform(), drive)?)
    }

    /// As [`Self::of_drive`]; `None` for the paper's motor, which moves as a sine, has rigid impacts, a stator that
    /// does not yield and a constant load: a [`Motor`] is the faster one.
    ///
    /// # Errors
    /// As [`Self::of_drive`].
    pub fn where_needed(motor: Motor, drive: &DriveParameters) -> Result<Option<Self>, Error> {
        let system = motor.system();
        let needed = !drive.is_sine() || system.soft_contact().is_some() || system.prescribed().is_err();
        needed.then(|| Self::of_drive(motor, drive)).transpose()
    }

    /// The motor with a contact that takes time: an isolated impact lasts for `contact_time` (s) and has the
    /// sheet's restitution. Below 1e-6 rad of the vibration impacts are rigid.
    ///
    /// # Errors
    /// Those of [`System::with_contact`] and [`DrivenSystem::with_contact_time`].
    pub fn with_contact_time(self, contact_time: f64) -> Result<Self, Error> {
        self.touching(Contact::lasting(contact_time))
    }

    /// As [`Self::with_contact_time`], with a spring that unloads at less stiffness in place of a damper.
    ///
    /// # Errors
    /// As for [`Self::with_contact_time`].
    pub fn with_hysteretic_contact(self, contact_time: f64) -> Result<Self, Error> {
        self.touching(Contact { law: Some(ContactLaw::Hysteresis), ..Contact::lasting(contact_time) })
    }

    fn touching(self, contact: Contact) -> Result<Self, Error> {
        Self::on(self.motor.with(|sheet| sheet.contact = Some(contact))?, self.stator)
    }

    /// The data sheet.
    #[must_use]
    pub const fn motor(&self) -> &Motor {
        &self.motor
    }

    /// The stator.
    #[must_use]
    pub const fn stator(&self) -> &DrivenPlatform {
        &self.stator
    }

    /// For a steady operation, which knows no time.
    fn loaded(&self) -> Result<LoadedMotor<'_>, Error> {
        if self.motor.load().is_some_and(|load| load.next_change_after(f64::NEG_INFINITY).is_some()) {
            return Err(Error::LoadInTime);
        }
        let (mass, load_torque) = (self.motor.mass(), self.motor.load_torque());
        Ok(LoadedMotor { system: self.bound, stator: Some((&self.stator, &self.carrier)), mass, load_torque })
    }

    /// As [`Motor::torque_speed_curve`]; a curve takes as long as its points together, except on sines with a
    /// contact time, where one vertical motion carries all rotors. Under a table `[load]` the torques come on top
    /// of its law: no torque at all is the motor with its fan.
    ///
    /// # Errors
    /// As [`Motor::torque_speed_curve`]; [`Error::LoadInTime`] for a load that varies in time, as by the next two.
    pub fn torque_speed_curve(
        &self,
        load_torques: &[f64],
        settings: &OperatingSettings,
        observer: &dyn Observer,
    ) -> Result<Vec<Operation>, Error> {
        curve_of(self.loaded()?, load_torques, settings, observer)
    }

    /// Under the load of its sheet, from where another motor was left, and where it is left.
    pub(crate) fn continued(
        &self,
        from: Option<&Ends>,
        settings: &OperatingSettings,
        observer: &dyn Observer,
    ) -> Result<(Operation, Option<Ends>), Error> {
        let (mut found, ends) = continued(self.loaded()?, from, settings, observer)?;
        // As many as motors.
        Ok((found.operations.swap_remove(0), ends))
    }

    /// As [`Motor::stall_load`], without the law of a table `[load]`: the torque is all that the shaft takes.
    ///
    /// # Errors
    /// As [`Motor::stall_load`].
    pub fn stall_load(
        &self,
        settings: &OperatingSettings,
        observer: &dyn Observer,
    ) -> Result<StallLoad, Error> {
        let bare = self.carrier.without_law()?;
        let motor = LoadedMotor { stator: Some((&self.stator, &bare)), ..self.loaded()? };
        stall_load(&motor, settings, observer)
    }

    /// As [`Motor::best_phase_lag`]; the phase lag shifts the whole waveform of the angle.
    ///
    /// # Errors
    /// As [`Motor::best_phase_lag`]; [`Error::BothGiven`] where the one mode of a stator moves both height and angle.
    pub fn best_phase_lag(
        &self,
        settings: &OperatingSettings,
        observer: &dyn Observer,
    ) -> Result<BestPhaseLag, Error> {
        if self.motor.stator().is_some_and(|stator| stator.modes()[0].angle != 0.0) {
            let one = "a stator of the kind axial_twist";
            return Err(Error::BothGiven { one, other: "a phase lag to be found" });
        }
        best_phase_lag(&self.loaded()?, settings, observer)
    }

    /// The transients of these members by their phases and settings, computed in parallel.
    ///
    /// The items of `observer` are the members.
    ///
    /// # Errors
    /// The first one of [`Self::transient`].
    pub fn transients(
        &self,
        members: &[TransientMember],
        observer: &dyn Observer,
    ) -> Result<Vec<SpeedCurve>, Error> {
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

    /// The speed transient of a rotor that starts at rest on the stator at `phase`, as
    /// [`transient`](crate::motor::transient()) for a sine.
    ///
    /// The items of `observer` are the intervals of the curve.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for illegal settings; those of [`DrivenSystem::new`] and of the flights.
    pub fn transient(
        &self,
        phase: Phase,
        settings: &TransientSettings,
        observer: &dyn Observer,
    ) -> Result<SpeedCurve, Error> {
        Ok(self.run_up(phase, settings, observer)?.0)
    }

    /// As [`Self::transient`], with the amplitude (m) of the axial mode at the end of each interval, that of
    /// [`MotorOutputs::amplitude`](crate::motor::MotorOutputs::amplitude). Empty for a stator that does not yield. On one that yields the
    /// chatter policy of the settings has no effect: impacts are followed down to a chatter of 1e-7 rad.
    ///
    /// # Errors
    /// As [`Self::transient`].
    pub fn run_up(
        &self,
        phase: Phase,
        settings: &TransientSettings,
        observer: &dyn Observer,
    ) -> Result<(SpeedCurve, Vec<f64>), Error> {
        let unit = self.bound.scales();
        settings.check_for(&unit)?;
        let watch = Watch::begin(observer, 0, settings.intervals as u64)?;
        let mut work = watch.work();
        let (load, mut amplitudes, mut switched) = (self.motor.load(), Vec::new(), 0.0);
        let mut engine = match load {
            Some(_) => {
                Carrier::Yielding(Box::new(self.carrier_at(0.0)?)).start(phase, 0.0, settings.policy)?
            }
            None => self.carrier.start(phase, 0.0, settings.policy)?,
        };
        if let Some(load) = load
            && !load.drives_at(0.0)
        {
            engine.calm();
        }
        let mut engine = engine.without_energy();
        let mut bins = Bins::new(settings.duration, settings.intervals)?;
        let mut generator = SplitMix64::new(settings.seed);
        let (mut impacts, mut separations, began) = (0, 0, engine.time());
        let mut tapped = self.carrier.driven().and_then(|system| Tapped::new(std::iter::once(system)));
        while bins.present.reached < settings.duration {
            if let (Some(tapped), CarriedEngine::Driven(engine)) = (&mut tapped, &mut engine)
                && let Some(launch) = engine.flight()
            {
                tapped.begin(engine.time(), launch, std::iter::once(engine.state().angular_speed));
                while bins.present.reached < settings.duration
                    && let Some(angle) = tapped.turn()
                {
                    work.spend(2)?;
                    (impacts, separations) = (impacts + 1, separations + 1);
                    if settings.relaunch_perturbation > 0.0 {
                        tapped.perturb(settings.relaunch_perturbation * generator.unit());
                    }
                    bins.add(tapped.time.since(&began).radians() * unit.time, angle);
                    watch.set_done(bins.present.index as u64);
                }
                let speed = tapped.speeds().next().unwrap_or_default();
                engine.fly_from(tapped.time, tapped.launch, speed);
                if bins.present.reached >= settings.duration {
                    break;
                }
            }
            work.spend(FLIGHTS_OF_EVENT)?;
            let (angle, now) = (engine.disk().angle, engine.time().since(&began).radians());
            let left = settings.duration / unit.time - now;
            let change = load.and_then(|load| load.next_change_after(switched));
            let change = change.filter(|change| change / unit.time < left + now);
            let mut until = change.map_or(left, |change| (change / unit.time - now).max(0.0));
            let yields = engine.amplitude_after(0.0).is_some();
            let boundary = (amplitudes.len() + 1) as f64 * bins.width / unit.time - now;
            let samples = yields && boundary < until;
            if samples {
                until = boundary.max(0.0);
            }
            let Some((event, ..)) = engine.advance_within(until)? else {
                if samples {
                    amplitudes.extend(engine.amplitude_after(until).map(|amplitude| amplitude * unit.length));
                    if engine.lies() {
                        engine.pause(until);
                        bins.add((now + until) * unit.time, engine.disk().angle - angle);
                    }
                    continue;
                }
                if let Some(change) = change {
                    engine.switch(until, self.carrier_at(change)?);
                    switched = change;
                    bins.add(change, engine.disk().angle - angle);
                    continue;
                }
                // No event is left: the motion continues through the rest of the intervals.
                let mut turned = 0.0;
                for index in bins.present.index..settings.intervals {
                    let last = index + 1 == settings.intervals;
                    let to = if last { settings.duration } else { (index + 1) as f64 * bins.width };
                    let then = engine.disk_after(to / unit.time - now);
                    bins.add(to, then.angle - angle - turned);
                    turned = then.angle - angle;
                }
                break;
            };
            match event {
                Event::Impact { .. } | Event::Kick { .. } | Event::Recontact => impacts += 1,
                Event::Separation => separations += 1,
                _ => {}
            }
            if event.is_relaunch() && settings.relaunch_perturbation > 0.0 {
                engine.perturb_launch(settings.relaunch_perturbation * generator.unit());
            }
            let passed = engine.time().since(&began).radians();
            bins.add(passed * unit.time, engine.disk().angle - angle);
            watch.set_done(bins.present.index as u64);
        }
        watch.end();
        let left = settings.duration / unit.time - engine.time().since(&began).radians();
        if let (Some(last), true) = (engine.amplitude_after(left), amplitudes.len() < settings.intervals) {
            amplitudes.resize(settings.intervals, last * unit.length);
        }
        Ok((curve(bins, &unit, (impacts, separations))?, amplitudes))
    }
}

/// A motor with the inertia of its shaft on its stator, and the same with a prescribed motion and rigid impacts.
pub(crate) fn with_shaft(motor: &Motor) -> Result<(StatorSystem, System), Error> {
    let shaft = motor.load().map_or(0.0, |load| load.inertia()) / motor.mass();
    let system = motor.system().with_disk(|disk| {
        disk.gyration_radius = (disk.gyration_radius * disk.gyration_radius + shaft).sqrt();
    })?;
    let mut bound = system.with_contact(None)?.with_stator(None)?;
    bound.has_load_law = false;
    Ok((StatorSystem::of_system(&system, motor.mass())?, bound))
}

/// A stator without its drive.
pub(crate) fn still(system: &StatorSystem) -> Result<StatorSystem, Error> {
    let base = system.base().parameters();
    system.with_base(&DimensionlessParameters { peak_acceleration: 0.0, twist_speed: 0.0, ..base }.build()?)
}

/// The lines of a load at a time (s), on a disk of this mass.
pub(crate) fn lines(load: &LoadLaw, time: f64, system: &System, mass: f64) -> Vec<LoadLine> {
    let disk = system.disk();
    let torque = load.factor_at(time) / (mass * disk.preload_acceleration() * disk.contact_radius());
    let speed = system.scales().angular_speed;
    let mut lines = Vec::new();
    let mut reached = f64::NEG_INFINITY;
    while reached < f64::INFINITY {
        let segment = load.segment_at(reached);
        reached = segment.to;
        lines.push(LoadLine {
            from: segment.from / speed,
            to: segment.to / speed,
            torque: segment.torque * torque,
            slope: segment.slope * torque * speed,
        });
    }
    lines
}

#[cfg(test)]
mod tests {
    use bouncing_disk_core::Unobserved;

    use super::*;
    use crate::motor::{Estimate, Shortfall};
    use crate::parameters::stator::StatorParameters;

    fn settings() -> OperatingSettings {
        OperatingSettings { relative_error: 0.04, members: 4, ..OperatingSettings::default() }
    }

    /// Of one motor on both engines: chaotic orbits, so the means agree, not the impacts.
    #[test]
    fn a_sine_as_a_waveform_turns_the_motor_as_the_sine_does() {
        let motor = Motor::paper_70_khz();
        let driven = DrivenMotor::new(motor, Waveform::Sine, Waveform::Sine).expect("legal");
        let loads = [0.0, 0.4 * motor.largest_torque(), 1.5 * motor.largest_torque()];
        let curve = driven.torque_speed_curve(&loads, &settings(), &Unobserved).expect("no failure");
        let known = motor.torque_speed_curve(&loads, &settings(), &Unobserved).expect("no failure");
        for (own, known) in curve.iter().zip(&known).take(2) {
            let (own, known) = (own.steady().expect("known"), known.steady().expect("known"));
            assert!(own.energy_residual < 1e-9, "{own:?}");
            let near = |one: Estimate, other: Estimate| {
                let error = one.standard_error + other.standard_error;
                assert!((one.value - other.value).abs() < 3.0 * error, "{one:?} {other:?}");
            };
            near(own.speed, known.speed);
            near(own.input_power, known.input_power);
            near(own.friction_loss, known.friction_loss);
            near(own.restitution_loss, known.restitution_loss);
        }
        assert_eq!(curve[2], known[2], "a runaway");
        let strong = motor.with(|sheet| sheet.amplitude = Some(1e-7)).expect("legal");
        let driven = DrivenMotor::new(strong, Waveform::Sine, Waveform::Sine).expect("legal");
        let settings = TransientSettings {
            duration: 0.02,
            intervals: 4,
            relaunch_perturbation: 0.0,
            ..TransientSettings::default()
        };
        for phase in [0.3, 0.69, 1.08, 3.0, 5.0] {
            let phase = Phase::new(phase).expect("finite");
            let own = driven.transient(phase, &settings, &Unobserved).expect("no failure");
            let sine = crate::motor::transient(strong.system(), phase, &settings, &Unobserved);
            let sine = sine.expect("no failure");
            // Flights of hundreds of periods round the phase by 1e-13 rad, and each of the few impacts that
            // follow multiplies that by some hundred: its speed decides on another long flight.
            let near = |(own, sine): (&f64, &f64)| (own - sine).abs() <= 1e-8 * sine.abs();
            assert!(own.speeds.iter().zip(&sine.speeds).all(near), "{own:?} {sine:?}");
        }
    }

    /// A stator that saws: its kinks end each rest by a kick, and never by a separation.
    fn sawing(amplitude: f64) -> DrivenMotor {
        let sheet = Motor::paper_70_khz().with(|sheet| sheet.amplitude = Some(amplitude)).expect("legal");
        let shape = Waveform::Sawtooth(0.7);
        DrivenMotor::new(sheet, shape.clone(), shape).expect("legal")
    }

    /// The seed of the perturbations matters if there are any, and only then.
    #[test]
    fn relaunches_by_kicks_are_perturbed_as_separations_are() {
        let run = |relaunch_perturbation: f64, seed: u64| {
            let settings = TransientSettings {
                duration: 0.02,
                intervals: 4,
                relaunch_perturbation,
                seed,
                ..TransientSettings::default()
            };
            // It starts on the falling line.
            let phase = Phase::new(std::f64::consts::PI).expect("finite");
            sawing(3e-10).transient(phase, &settings, &Unobserved).expect("no failure")
        };
        let calm = run(0.0, 1);
        assert_eq!((calm.separations, run(0.0, 2).speeds), (0, calm.speeds.clone()));
        let known = run(1e-3, 1);
        assert!(known.speeds != calm.speeds && run(1e-3, 2).speeds != known.speeds, "{known:?}");
    }

    /// Amplitudes that differ by a billionth give the same speed within the stated errors, whatever cycle their rounding
    /// would select.
    #[test]
    fn a_stator_with_kinks_does_not_lock_the_motor_on_a_rounded_cycle() {
        let points = [0.0, 1.0, 2.0, 3.0].map(|k| {
            let motor = sawing(3e-10 * (1.0 + 1e-9 * k));
            let curve = motor.torque_speed_curve(&[0.0], &settings(), &Unobserved).expect("no failure");
            *curve[0].steady().expect("known")
        });
        for (own, known) in points.iter().flat_map(|own| points.iter().map(move |known| (own, known))) {
            let error = own.speed.standard_error + known.speed.standard_error;
            assert!((own.speed.value - known.speed.value).abs() <= 3.0 * error, "{own:?} {known:?}");
        }
        assert!(points.iter().all(|point| point.perturbation_power > 0.0), "{points:?}");
    }

    /// A triangle at 1 nm kicks the rotor once, and then carries it in flights that keep their phase: each start has
    /// a speed of its own.
    #[test]
    fn a_neutral_family_of_motions_is_said_to_depend_on_the_start() {
        let sheet = Motor::paper_70_khz().with(|sheet| sheet.amplitude = Some(1e-9)).expect("legal");
        let motor = DrivenMotor::new(sheet, Waveform::Triangle, Waveform::Sine).expect("legal");
        let few = OperatingSettings { most_impacts: 200_000, ..settings() };
        let curve = motor.torque_speed_curve(&[0.0], &few, &Unobserved).expect("no failure");
        let Operation::Unsettled(point, Shortfall::Start { spread, .. }) = curve[0] else {
            panic!("{:?}", curve[0])
        };
        // The 95 % interval covers the speed of each start, and with it those of a motor started once.
        assert!(spread > 1.0, "{point:?} {spread}");
        for seed in 1..4 {
            let settings =
                TransientSettings { duration: 1.0, intervals: 10, seed, ..TransientSettings::default() };
            let curve = motor.transient(Phase::new(0.3).expect("finite"), &settings, &Unobserved);
            let speed = curve.expect("no failure").speeds[9];
            let off = (speed - point.speed.value).abs();
            assert!(off < 1.96 * point.speed.standard_error, "{speed} {point:?}");
        }
    }

    /// A short contact gives the speed of rigid impacts; one of a period taps the rotor in every period at the
    /// crest, so that the lag of its predecessors beats the paper's.
    #[test]
    fn the_contact_time_decides_on_the_best_lag() {
        let period = 1.0 / 70e3;
        let speed = |lag: f64, share: f64| {
            let motor = Motor::paper_70_khz().with(|sheet| sheet.phase_lag = lag).expect("legal");
            let rigid = DrivenMotor::new(motor, Waveform::Sine, Waveform::Sine).expect("legal");
            let motor =
                if share > 0.0 { rigid.with_contact_time(share * period).expect("legal") } else { rigid };
            let settings = TransientSettings { duration: 0.4, intervals: 4, ..TransientSettings::default() };
            let curve = motor.transient(Phase::new(0.3).expect("finite"), &settings, &Unobserved);
            curve.expect("no failure").speeds[3]
        };
        let crest = -std::f64::consts::FRAC_PI_2;
        assert!(speed(crest, 1.0) > 1.2 * speed(0.0, 1.0));
        assert!(speed(crest, 0.05) < 0.3 * speed(0.0, 0.05));
        let motor = DrivenMotor::new(Motor::paper_70_khz(), Waveform::Sine, Waveform::Sine).expect("legal");
        let known = &motor.torque_speed_curve(&[0.0], &settings(), &Unobserved).expect("no failure")[0];
        let short = motor.with_contact_time(0.02 * period).expect("legal");
        let own = &short.torque_speed_curve(&[0.0], &settings(), &Unobserved).expect("no failure")[0];
        let (own, known) = (own.steady().expect("known"), known.steady().expect("known"));
        let error = own.speed.standard_error + known.speed.standard_error;
        assert!((own.speed.value - known.speed.value).abs() < 3.0 * error, "{own:?} {known:?}");
        assert!(own.energy_residual < 1e-9, "{own:?}");
    }

    /// Taps in closed form give the run-up of the engine, which follows an angle with a second harmonic, be it
    /// ever so small.
    #[test]
    fn run_ups_by_taps_are_those_of_the_engine() {
        let speeds = |angle: Waveform, lag: f64| {
            let motor = Motor::paper_70_khz().with(|sheet| sheet.phase_lag = lag).expect("legal");
            let motor = DrivenMotor::new(motor, Waveform::Sine, angle).expect("legal");
            let motor = motor.with_contact_time(1.0 / 70e3).expect("legal");
            let settings =
                TransientSettings { duration: 0.06, intervals: 12, ..TransientSettings::default() };
            motor
                .transient(Phase::new(0.3).expect("finite"), &settings, &Unobserved)
                .expect("no failure")
                .speeds
        };
        for lag in [0.0, -1.2] {
            let own = speeds(Waveform::Sine, lag);
            let engine = speeds(Waveform::Fourier(vec![(1.0, 0.0), (1e-300, 0.0)]), lag);
            for (own, engine) in own.iter().zip(&engine) {
                // A tap lasts a thousandth of an interval, within which its angle counts as even.
                assert!((own - engine).abs() < 1e-4 * engine, "{lag}: {own} {engine}");
            }
        }
    }

    #[test]
    fn rigid_calls_refuse_a_contact_time_that_matters() {
        let motor = |time: f64| {
            Motor::paper_70_khz().with(|sheet| sheet.contact = Some(Contact::lasting(time))).expect("legal")
        };
        let (soft, stiff, drive) = (motor(1e-5), motor(1e-12), DriveParameters::default());
        assert_eq!(soft.torque_speed_curve(&[0.0], &settings(), &Unobserved), Err(Error::SoftContact));
        assert_eq!(soft.nearest_trap(0.1, &Unobserved), Err(Error::SoftContact));
        let phase = Phase::new(0.3).expect("finite");
        let settings = TransientSettings { duration: 1e-3, intervals: 4, ..TransientSettings::default() };
        let run = |motor: &Motor| crate::motor::transient(motor.system(), phase, &settings, &Unobserved);
        assert_eq!(run(&soft), Err(Error::SoftContact));
        assert_eq!(run(&stiff), run(&Motor::paper_70_khz()));
        assert!(DrivenMotor::where_needed(soft, &drive).expect("legal").is_some());
        assert_eq!(DrivenMotor::where_needed(stiff, &drive), Ok(None));
        assert!(stiff.warnings().iter().any(|warning| warning.to_string().starts_with("impacts are rigid")));
    }

    /// On a stator too slow to throw it the rotor creeps under a load, as on the sine.
    #[test]
    fn a_rotor_that_never_leaves_the_stator_has_its_steady_speed() {
        let calm = Motor::paper_70_khz().with(|sheet| sheet.amplitude = Some(4e-11)).expect("legal");
        let driven = DrivenMotor::new(calm, Waveform::Sine, Waveform::Sine).expect("legal");
        let loads = [0.0, 0.3 * calm.largest_torque()];
        let curve = driven.torque_speed_curve(&loads, &settings(), &Unobserved).expect("no failure");
        let known = calm.torque_speed_curve(&loads, &settings(), &Unobserved).expect("no failure");
        for (own, known) in curve.iter().zip(&known) {
            let (own, known) = (own.steady().expect("known"), known.steady().expect("known"));
            let error = own.speed.standard_error + known.speed.standard_error;
            assert!((own.speed.value - known.speed.value).abs() < 3.0 * error, "{own:?} {known:?}");
            let loss = known.friction_loss.value;
            assert!((own.friction_loss.value - loss).abs() < 1e-6 * loss, "{own:?} {known:?}");
            assert!(own.energy_residual < 1e-9, "{own:?}");
        }
    }

    fn on_stator(
        mass: f64,
        quality: f64,
        change: impl FnOnce(&mut crate::motor::MotorParameters),
    ) -> DrivenMotor {
        let modes =
            StatorParameters { mass: Some(mass), quality: Some(quality), ..StatorParameters::default() };
        let motor = Motor::paper_70_khz().with(|sheet| {
            sheet.stator = Some(modes);
            change(sheet);
        });
        DrivenMotor::where_needed(motor.expect("legal"), &DriveParameters::default())
            .expect("legal")
            .expect("yields")
    }

    /// A stator of a thousand tons is prescribed; one of 10 g is damped by the rotor, and lifts none that presses too
    /// hard, but answers.
    #[test]
    fn a_stator_yields_by_its_mass() {
        let point = |motor: &DrivenMotor| {
            motor.torque_speed_curve(&[0.0], &settings(), &Unobserved).expect("no failure").swap_remove(0)
        };
        let heavy = point(&on_stator(1e6, 300.0, |_| {}));
        let known =
            Motor::paper_70_khz().torque_speed_curve(&[0.0], &settings(), &Unobserved).expect("no failure");
        let (own, known) = (heavy.steady().expect("known"), known[0].steady().expect("known"));
        let error = own.speed.standard_error + known.speed.standard_error;
        assert!((own.speed.value - known.speed.value).abs() < 3.0 * error, "{own:?} {known:?}");
        let stator = own.stator.expect("yields");
        assert!((stator.amplitude.value / 1e-8 - 1.0).abs() < 1e-6 && own.energy_residual < 1e-9, "{own:?}");
        let light = |preload: f64| {
            on_stator(0.01, 300.0, |sheet| {
                (sheet.amplitude, sheet.preload_acceleration) = (Some(1e-7), Some(preload));
            })
        };
        let own = *point(&light(5.0)).point().expect("it turns");
        let stator = own.stator.expect("yields");
        // By an integration in small steps: 0.6861 of the amplitude without a rotor, 8.10 mW.
        assert!((stator.amplitude.value / 1e-7 - 0.686).abs() < 0.01, "{own:?}");
        let drive = stator.drive_power.value;
        let lost = stator.damping_loss.value + own.restitution_loss.value + own.friction_loss.value;
        assert!((drive / 8.17e-3 - 1.0).abs() < 0.02 && (drive / lost - 1.0).abs() < 0.02, "{own:?}");
        // A rotor that is never lifted off: by periods, in place of impacts.
        let few = OperatingSettings { most_impacts: 2_000, ..settings() };
        let weighed = light(25.0).torque_speed_curve(&[0.0], &few, &Unobserved).expect("no failure");
        let weighed = *weighed[0].point().expect("it does not run away");
        assert!(weighed.impacts > 0 && weighed.energy_residual < 1e-9, "{weighed:?}");
        assert!(weighed.stator.expect("yields").amplitude.value < 1e-9, "{weighed:?}");
    }

    /// A load over the speed: its mean torque is that of its mean speed on a line, with a node on it or not, and the torque
    /// that is asked for comes on top. What varies in time is refused.
    #[test]
    fn operating_points_are_under_the_law_of_the_load() {
        let motor = |load: LoadLaw| {
            let sheet = Motor::paper_70_khz().with(|sheet| sheet.load = Some(load)).expect("legal");
            DrivenMotor::of_drive(sheet, &DriveParameters::default()).expect("legal")
        };
        let point = |load: Result<LoadLaw, Error>, torque: f64| {
            let motor = motor(load.expect("legal"));
            motor.torque_speed_curve(&[torque], &settings(), &Unobserved).expect("no failure").swap_remove(0)
        };
        let lines = [(&[0.0, 20.0][..], &[0.0, 14e-6][..]), (&[0.0, 10.0, 20.0], &[0.0, 7e-6, 14e-6])];
        let [line, bent] = lines.map(|(speeds, torques)| {
            let law = LoadLaw::new(speeds, torques).and_then(|law| law.with_inertia(1e-7));
            let found = *point(law, 3e-6).steady().expect("known");
            let mean = 3e-6 + 0.7e-6 * found.speed.value;
            assert!((found.load_torque / mean - 1.0).abs() < 1e-9, "{found:?}");
            let error = 0.7e-6 * found.speed.standard_error;
            assert!((found.load_torque_error / error - 1.0).abs() < 1e-6, "{found:?}");
            assert!(found.energy_residual < 1e-9 && found.stator.is_none(), "{found:?}");
            found
        });
        let error = line.speed.standard_error + bent.speed.standard_error;
        assert!((line.speed.value - bent.speed.value).abs() < error, "{line:?} {bent:?}");
        let constant = point(LoadLaw::constant(4e-6), 6e-6);
        let known =
            Motor::paper_70_khz().operating_point(10e-6, &settings(), &Unobserved).expect("no failure");
        let (own, known) = (constant.steady().expect("known"), known.steady().expect("known"));
        let error = own.speed.standard_error + known.speed.standard_error;
        assert!((own.load_torque / 10e-6 - 1.0).abs() < 1e-9 && own.load_torque_error < 1e-15);
        assert!((own.speed.value - known.speed.value).abs() < 3.0 * error, "{own:?} {known:?}");
        let Operation::Runaway { load_torque, .. } = point(LoadLaw::constant(38e-6), 4e-6) else {
            panic!("friction holds {}", Motor::paper_70_khz().largest_torque())
        };
        assert!((load_torque / 42e-6 - 1.0).abs() < 1e-9, "{load_torque}");
        let stops = LoadLaw::constant(1e-6).and_then(|law| law.with_factors(&[1.0], &[0.0])).expect("legal");
        let refused = motor(stops).torque_speed_curve(&[0.0], &settings(), &Unobserved);
        assert_eq!(refused, Err(Error::LoadInTime));
    }

    /// Requested errors are relative to the speed without load or law: of a fan that nearly stalls the motor, and of a
    /// load that friction alone does not hold.
    #[test]
    fn errors_are_relative_to_the_speed_without_the_law_of_the_load() {
        let wanted = |load: Result<LoadLaw, Error>, torque: f64| {
            let sheet = Motor::paper_70_khz().with(|sheet| sheet.load = load.ok()).expect("legal");
            let motor = DrivenMotor::of_drive(sheet, &DriveParameters::default()).expect("legal");
            // What drifts by chance does not say which error it lacks.
            let mut seeds = (1..10).filter_map(|seed| {
                let few =
                    OperatingSettings { relative_error: 1e-6, most_impacts: 100_000, seed, ..settings() };
                match motor.torque_speed_curve(&[torque], &few, &Unobserved).expect("no failure")[0] {
                    Operation::Unsettled(_, Shortfall::Error { wanted, .. }) => {
                        Some(wanted / few.relative_error)
                    }
                    _ => None,
                }
            });
            seeds.next().expect("one that does not drift")
        };
        let known = Motor::paper_70_khz().no_load_speed(&settings()).expect("known").value;
        let loads = [(LoadLaw::constant(60e-6), -50e-6), (LoadLaw::fan(2.0, 30e-6, 3), 0.0)];
        for (load, torque) in loads {
            let own = wanted(load, torque);
            assert!((own / known - 1.0).abs() < 0.2, "{own} {known}");
        }
    }

    #[test]
    fn a_stall_is_that_of_the_motor_without_the_law_of_its_load() {
        let few = OperatingSettings { relative_error: 0.3, most_impacts: 20_000, ..settings() };
        let stall = |load: Result<LoadLaw, Error>| {
            let sheet = Motor::paper_70_khz().with(|sheet| sheet.load = load.ok()).expect("legal");
            let motor = DrivenMotor::of_drive(sheet, &DriveParameters::default()).expect("legal");
            motor.stall_load(&few, &Unobserved)
        };
        // Bit for bit, also where the budget is too small for a stall.
        assert_eq!(stall(LoadLaw::constant(10e-6)), stall(LoadLaw::constant(0.0)));
    }

    /// The drive is switched off at half of a run-up: the modes ring down within 2 Q/omega, and the rotor stops.
    #[test]
    fn a_run_up_ends_when_the_drive_is_switched_off() {
        let motor = on_stator(1.0, 300.0, |sheet| {
            sheet.load = LoadLaw::fan(20.0, 1e-7, 4).and_then(|load| load.with_drive(0.005, 0.05)).ok();
            sheet.peak_angular_speed = Some(3.0);
        });
        let settings = TransientSettings { duration: 0.1, intervals: 100, ..TransientSettings::default() };
        let (curve, amplitudes) =
            motor.run_up(Phase::new(1.0).expect("finite"), &settings, &Unobserved).expect("legal");
        assert!(amplitudes.len() == 100 && curve.speeds.len() == 100);
        assert!(amplitudes[..4].iter().all(|amplitude| *amplitude < 1e-10), "{amplitudes:?}");
        assert!(amplitudes[48] > 5e-9 && amplitudes[99] < 0.2 * amplitudes[48], "{amplitudes:?}");
        assert!(curve.speeds[48] > 0.1, "{:?}", curve.speeds);
    }
}
