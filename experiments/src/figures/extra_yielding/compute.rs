//! Run-ups from the switch-on, with the inertia that settles soonest without changing what they settle to.

use std::f64::consts::{FRAC_1_PI, TAU};

use bouncing_disk::core::{Phase, Unobserved};
use bouncing_disk::motor::{DrivenMotor, TransientSettings};
use bouncing_disk::parameters::{Contact, LoadLaw, StatorKind, StatorParameters, Waveform};
use bouncing_disk::{Error, Motor};

use super::{CONTACT_TIMES, Curve, DETUNINGS, ExtraYieldingData, MASSES, PRELOADS, Point, SEED, features};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::shared::{between, map_in_parallel};
use crate::progress::Progress;

/// Of all stators; masses (kg) of the curves with rigid impacts, and of the stator with contacts that take time.
pub(super) const QUALITY: f64 = 300.0;
const RIGID_MASSES: [f64; 3] = [0.006, 0.010, 0.030];
pub(super) const MASS: f64 = 0.0105;

/// Contact times over the period of 70 kHz on a platform that does not yield: a short one, the two ends of the ball on the
/// edge of its ring, and the ball on a plane (`docs/contacts-that-take-time.md`).
pub(super) const TIMES: [f64; 4] = [0.8, 4.3, 8.9, 16.8];

/// Amplitudes (m) without a rotor.
pub(super) const AMPLITUDE: f64 = 1e-7;
const FAST_AMPLITUDES: [f64; 3] = [1e-8, 3e-8, 1e-7];

/// Points of a run, and those that are averaged.
const INTERVALS: usize = 500;
const AVERAGED: usize = 300;

/// Run-ups last for so many times in which a mode loses 1/e of its amplitude, and periods, or longest flights, or times in
/// which friction reaches the stator's speed.
const RINGING: f64 = 12.0;
const PERIODS: f64 = 2_500.0;
const FLIGHTS: f64 = 80.0;
const RISES: f64 = 6.0;

/// A rotor that is thrown less than this share of A₀ high rests on the stator.
const THROWN: f64 = 0.02;

/// Of a rotor in contacts that take time the inertia is such that friction changes its speed by this share of the
/// stator's in a period; one that is held has ten thousand times its own.
const LIGHT: f64 = 1.5e-3;
const HELD: f64 = 1e4;

/// A motor of the paper on a stator that yields.
#[derive(Debug, Clone, Copy)]
pub(super) struct Case {
    pub(super) motor: Motor,
    pub(super) twists: bool,
    /// Effective mass (kg), amplitude without a rotor (m), resonance over drive frequency.
    pub(super) mass: f64,
    pub(super) amplitude: f64,
    pub(super) tuning: f64,
    /// Contact time (s) on a platform that does not yield; `None` is the rigid impact.
    pub(super) contact_time: Option<f64>,
}

impl Case {
    fn built(&self, preload: f64, gyration: f64, load: LoadLaw) -> Result<DrivenMotor, Error> {
        let stator = StatorParameters {
            kind: if self.twists { StatorKind::AxialTwist } else { StatorKind::Axial },
            mass: Some(self.mass),
            quality: Some(QUALITY),
            resonance: Some(self.tuning * self.frequency()),
            // Off resonance the force is the same, and not the amplitude without a rotor.
            force: self.detuned_force(),
            ..StatorParameters::default()
        };
        // The spring is that of the platform that does not yield; the library's contact time is that on this stator.
        let yields = 1.0 / (1.0 + self.motor.mass() / self.mass).sqrt();
        let motor = self.motor.with(|sheet| {
            sheet.amplitude = self.detuned_force().is_none().then_some(self.amplitude);
            sheet.phase_lag = 0.0;
            sheet.gyration_radius = Some(gyration);
            (sheet.preload_force, sheet.preload_acceleration) = (None, Some(preload));
            (sheet.stator, sheet.load) = (Some(stator), Some(load));
            sheet.contact =
                self.contact_time.map(|time| Contact { time: Some(yields * time), ..Contact::default() });
        })?;
        DrivenMotor::new(motor, Waveform::Sine, Waveform::Sine)
    }

    fn detuned_force(&self) -> Option<f64> {
        let resonance = self.tuning * self.motor.system().platform().angular_frequency();
        let force = self.mass * resonance * resonance * self.amplitude / QUALITY;
        (self.tuning.total_cmp(&1.0).is_ne()).then_some(force)
    }

    fn frequency(&self) -> f64 {
        self.motor.system().platform().angular_frequency() / TAU
    }

    /// The means over this many motors that are switched on at other phases.
    pub(super) fn point(&self, preload: f64, members: usize) -> Result<Point, ExperimentError> {
        let mut sum = Point { speed: 0.0, stall_torque: 0.0, amplitude: 0.0, flight: 0.0 };
        for member in 0..members {
            let own = self.member(preload, (member as f64 + 0.5) / members as f64)?;
            sum.speed += own.speed / members as f64;
            sum.stall_torque += own.stall_torque / members as f64;
            sum.amplitude += own.amplitude / members as f64;
            sum.flight += own.flight / members as f64;
        }
        Ok(sum)
    }

    fn member(&self, preload: f64, cycles: f64) -> Result<Point, Error> {
        let (platform, disk) = (self.motor.system().platform(), self.motor.system().disk());
        let (frequency, gyration) = (self.frequency(), disk.gyration_radius());
        // The drive is switched on just after the start.
        let load = LoadLaw::constant(0.0)?.with_drive(1e-9, f64::MAX)?;
        let run = |inertia: f64, gyration: f64, duration: f64| {
            let settings = TransientSettings {
                duration,
                intervals: INTERVALS,
                seed: SEED,
                ..TransientSettings::default()
            };
            self.built(preload, gyration, load.with_inertia(inertia)?)?.run_up(
                Phase::new(TAU * cycles)?,
                &settings,
                &Unobserved,
            )
        };
        let amplitude = |all: &[f64]| {
            let last = &all[INTERVALS - AVERAGED..];
            (last.iter().map(|own| own * own).sum::<f64>() / last.len() as f64).sqrt() / self.amplitude
        };
        let settles = RINGING * QUALITY * FRAC_1_PI / frequency;
        let flight = 2.0 * self.amplitude * TAU * frequency * (1.0 + disk.restitution()) / preload;
        let held = HELD * self.motor.mass() * gyration * gyration;
        let longest = if self.contact_time.is_some() { PERIODS / frequency } else { FLIGHTS * flight };
        let (curve, amplitudes) = run(held, gyration, settles + longest)?;
        let (first, last) = (INTERVALS - AVERAGED, INTERVALS - 1);
        let stall_torque =
            held * (curve.speeds[last] - curve.speeds[first]) / (curve.times[last] - curve.times[first]);
        // A speed that friction reaches in single flights depends on the inertia; in contacts of a period it does not.
        let flies = self.contact_time.is_none() && amplitude(&amplitudes) > THROWN;
        let (speed, friction) =
            (platform.peak_angular_speed(), disk.friction() * disk.contact_radius() * preload);
        let (curve, amplitudes) = if flies {
            run(0.0, gyration, RISES * speed * gyration * gyration / friction)?
        } else {
            run(0.0, (friction / (frequency * LIGHT * speed)).sqrt(), settles + 2.0 * PERIODS / frequency)?
        };
        let speeds = &curve.speeds[first..];
        Ok(Point {
            speed: speeds.iter().sum::<f64>() / speeds.len() as f64,
            stall_torque,
            amplitude: amplitude(&amplitudes),
            flight: curve.times[last] / curve.impacts.max(1) as f64,
        })
    }
}

/// A contact time (s) of so many periods of 70 kHz.
pub(super) fn periods(of: f64) -> f64 {
    of * TAU / Motor::paper_70_khz().system().platform().angular_frequency()
}

pub(super) fn compute(
    quality: Quality,
    progress: &dyn Progress,
) -> Result<ExtraYieldingData, ExperimentError> {
    let (slow, fast) = (Motor::paper_70_khz(), Motor::paper_184_khz());
    let (count, members) = (quality.choose(2, 13), quality.choose(1, 2));
    let (columns, rows, tunings) = (quality.choose(1, 15), quality.choose(1, 5), quality.choose(2, 17));
    let base =
        Case { motor: slow, twists: true, mass: MASS, amplitude: AMPLITUDE, tuning: 1.0, contact_time: None };
    let both = |cases: Vec<(String, Case)>| -> Vec<(String, Case)> {
        let of = |twists| cases.iter().map(move |(name, case)| (name.clone(), Case { twists, ..*case }));
        of(true).chain(of(false)).collect()
    };
    let rigid = RIGID_MASSES.map(|mass| (format!("{} g", 1e3 * mass), Case { mass, ..base }));
    let soft = TIMES.map(|time| (format!("{time}"), Case { contact_time: Some(periods(time)), ..base }));
    let quick = FAST_AMPLITUDES.map(|amplitude| {
        let contact_time = Some(periods(TIMES[1]));
        (format!("{:.0} nm", 1e9 * amplitude), Case { motor: fast, amplitude, contact_time, ..base })
    });
    let groups = [rigid.to_vec(), soft.to_vec(), quick.to_vec()].map(both);
    let even = |(from, to): (f64, f64), share: f64| from + (to - from) * share;
    let middle = |index: usize, of: usize| (index as f64 + 0.5) / of as f64;
    let end = |index: usize, of: usize| index as f64 / (of - 1) as f64;
    let preloads: Vec<f64> = (0..count).map(|k| even(PRELOADS, end(k, count))).collect();
    let all: usize = groups.iter().map(Vec::len).sum();
    progress.start((all * count + columns * rows + 4 * tunings) as u64, "motors");
    let curves = |cases: &[(String, Case)]| {
        cases
            .iter()
            .map(|(name, case)| {
                let points = map_in_parallel(&preloads, |preload| {
                    let members = if case.contact_time.is_some() { 1 } else { members };
                    let point = case.point(*preload, members)?;
                    progress.advance(1);
                    Ok((*preload, point))
                })?;
                Ok(Curve { name: name.clone(), twists: case.twists, points })
            })
            .collect::<Result<Vec<_>, ExperimentError>>()
    };
    let [rigid, soft, fast] = groups.each_ref().map(|cases| curves(cases));
    let found = map_in_parallel(&(0..columns * rows).collect::<Vec<_>>(), |&cell| {
        let mass = QUALITY * even(MASSES, middle(cell % columns, columns));
        let time = between(CONTACT_TIMES, middle(cell / columns, rows));
        let case = Case { mass, contact_time: Some(periods(time)), ..base };
        let found = features(|preload| case.point(preload, 1))?;
        progress.advance(1);
        Ok(found.into_iter().map(u8::from).sum())
    })?;
    let detuned = both(vec![
        ("rigid".to_owned(), base),
        ("4.3".to_owned(), Case { contact_time: Some(periods(TIMES[1])), ..base }),
    ]);
    let tuned: Vec<f64> = (0..tunings).map(|k| even(DETUNINGS, end(k, tunings))).collect();
    let detuned = detuned.iter().map(|(name, case)| {
        let points = map_in_parallel(&tuned, |detuning| {
            let point = Case { tuning: 1.0 + detuning, ..*case }.point(PRELOADS.1, 1)?;
            progress.advance(1);
            Ok((*detuning, point))
        })?;
        Ok(Curve { name: name.clone(), twists: case.twists, points })
    });
    Ok(ExtraYieldingData {
        quality_factor: QUALITY,
        mass_kg: slow.mass(),
        rigid: rigid?,
        soft: soft?,
        fast: fast?,
        map: (columns, found),
        detuned: detuned.collect::<Result<_, ExperimentError>>()?,
    })
}
