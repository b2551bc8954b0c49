//! The force of contacts that take time, over the period of the drive, and what follows for a rotor on it.

use std::f64::consts::{PI, TAU};

use bouncing_disk::core::numerics::random::SplitMix64;
use bouncing_disk::core::run::in_parallel;
use bouncing_disk::core::{
    Drive, DrivenMap, Error as CoreError, ImpactMap, ImpactState, Phase, Unobserved, Vibration,
};
use bouncing_disk::motor::{DrivenMotor, NormalImpulses, PhasedImpulse, TransientSettings};
use bouncing_disk::parameters::{Contact, Geometry, Waveform};
use bouncing_disk::{Error, Motor};

use super::{
    AMPLITUDES, CONTACT_TIMES, Cells, Curve, ExtraContactData, FORCINGS, LAGS, Life, Lives, PRELOADS,
    RESTITUTIONS, Run, SEED, TRANSITION, Transition,
};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::shared::{between, logarithmic};
use crate::progress::Progress;

/// Parts of the period into which impulses are sorted, and phase lags among which the best is chosen.
const BINS: usize = 512;
const TRIED_LAGS: u32 = 120;

/// Periods before anything is measured, and then: those of a rotor that is tapped, and of one that flies.
const SETTLING: usize = 10_000;
const TAPPED: usize = 200;
const FLOWN: usize = 40_000;

/// Of rigid impacts: how many, and the relaunch perturbation (g/ω).
const IMPACTS: usize = 4_000;
const RELAUNCH: f64 = 1e-3;

/// A motion without flights of more than `LONG` periods in `SHORT` touches in a row has lost them.
const LONG: f64 = 10.0;
const SHORT: usize = 200;

/// A contact at these parameters: contact time over the period, restitution, and whether a spring that unloads
/// at less stiffness takes the place of the damper; `None` is the rigid impact.
#[derive(Clone, Copy)]
pub(super) struct Law {
    pub(super) contact_time: Option<f64>,
    pub(super) restitution: f64,
    pub(super) hysteretic: bool,
}

impl Law {
    const fn damped(contact_time: f64, restitution: f64) -> Self {
        Self { contact_time: Some(contact_time), restitution, hysteretic: false }
    }

    pub(super) fn map(self, axial_forcing: f64) -> Result<DrivenMap, CoreError> {
        let rigid = DrivenMap::new(Drive::fourier(&[(PI * axial_forcing, 0.0)])?, self.restitution)?;
        match self.contact_time.map(|share| TAU * share) {
            None => Ok(rigid),
            Some(time) if self.hysteretic => rigid.with_hysteretic_contact(time),
            Some(time) => rigid.with_contact_time(time),
        }
    }

    /// The impulses on a platform with this forcing, sorted by phase, and how often in a period the force sets
    /// in.
    pub(super) fn impulses(self, axial_forcing: f64) -> Result<(NormalImpulses, f64), Error> {
        let (all, touches) = match self.map(axial_forcing)?.compliant() {
            None => {
                let vibration = Vibration::from_axial_forcing(axial_forcing)?;
                let map = ImpactMap::new(vibration, self.restitution)?;
                (NormalImpulses::of(&map, IMPACTS, RELAUNCH)?, 0.0)
            }
            Some(platform) => {
                let mut all = NormalImpulses::of_contact(platform, SETTLING, TAPPED)?;
                if all.duration > TAU && 2 * all.landings.len() < TAPPED {
                    all = NormalImpulses::of_contact(platform, SETTLING, FLOWN)?;
                }
                let touches = all.landings.len() as f64 * TAU / all.duration;
                (all, touches)
            }
        };
        let shares = all.histogram(BINS).into_iter().enumerate();
        let middle = |bin: usize| TAU * ((bin as f64 + 0.5) / BINS as f64 - 0.5);
        let contact = shares.map(|(bin, impulse)| PhasedImpulse { phase: middle(bin), impulse }).collect();
        Ok((NormalImpulses { contact, landings: all.landings, ..NormalImpulses::default() }, touches))
    }

    fn rotor(self, axial_forcing: f64) -> Result<Rotor, Error> {
        let (impulses, _) = self.impulses(axial_forcing)?;
        let balances = LAGS.map(|lag| impulses.balance(lag));
        Ok(Rotor {
            speeds: balances.each_ref().map(|balance| balance.steady_speed()),
            stall_shares: balances.each_ref().map(|balance| balance.net_share(0.0)),
        })
    }
}

/// What a disk from rest does, and a rotor with little friction on it.
pub(super) fn cell(law: Law, axial_forcing: f64) -> Result<Cell, Error> {
    let (impulses, touches) = law.impulses(axial_forcing)?;
    let speed = |lag| impulses.balance(lag).steady_speed();
    let lags = (0..TRIED_LAGS).map(|k| PI * (2.0 * f64::from(k) / f64::from(TRIED_LAGS) - 1.0));
    let best = lags.map(|lag| (lag, speed(lag))).fold((0.0, -1.0), |best, own| match own.1 > best.1 {
        true => own,
        false => best,
    });
    let regime = match touches {
        touches if touches <= 0.0 => 0,
        touches if touches < 0.9 => 2,
        touches if touches < 1.1 && at_one_phase(&impulses.landings) => 1,
        _ => 3,
    };
    let mean_phase = impulses.concentration().map_or(0.0, |mean| mean.mean_direction_rad);
    Ok(Cell { regime, mean_phase, best_lag: best.0, speed_at_zero: speed(0.0), best_speed: best.1 })
}

/// What a disk from rest does. Phases and lags in rad, speeds in units of ωΦ.
pub(super) struct Cell {
    /// See [`Cells::regimes`].
    pub(super) regime: u8,
    pub(super) mean_phase: f64,
    pub(super) best_lag: f64,
    pub(super) speed_at_zero: f64,
    pub(super) best_speed: f64,
}

/// Steady speed over ωΦ and stall torque over that of friction, at each of the [`LAGS`].
struct Rotor {
    speeds: [f64; 3],
    stall_shares: [f64; 3],
}

fn at_one_phase(phases: &[f64]) -> bool {
    phases.windows(2).all(|pair| {
        let apart = (pair[1] - pair[0]).rem_euclid(TAU);
        apart.min(TAU - apart) < 1e-3
    })
}

/// Results in parallel, in order.
fn each<T: Send>(
    count: usize,
    progress: &dyn Progress,
    one: impl Fn(usize) -> Result<T, ExperimentError> + Sync,
) -> Result<Vec<T>, ExperimentError> {
    in_parallel(count, |index| {
        let result = one(index);
        progress.advance(1);
        result
    })
    .into_iter()
    .collect()
}

/// From a release to the next one: after how long, and the disk there; `None` if it stays on the platform.
fn next_release(map: &DrivenMap, from: ImpactState) -> Result<Option<(f64, ImpactState)>, CoreError> {
    match map.step(from) {
        Ok(landing) => Ok(Some((landing.impact.duration(), landing.impact.into()))),
        Err(CoreError::NoLiftOff { .. }) => Ok(None),
        Err(error) => Err(error),
    }
}

/// How long flights last from a start, and whether they ended within `most` periods.
fn life(map: &DrivenMap, mut state: ImpactState, most: f64) -> Result<(f64, bool), CoreError> {
    let (mut now, mut last, mut short) = (0.0, 0.0, 0);
    while now < most {
        let Some((after, next)) = next_release(map, state)? else { return Ok((last, true)) };
        now += after / TAU;
        state = next;
        if after > LONG * TAU {
            (last, short) = (now, 0);
        } else {
            short += 1;
        }
        if short == SHORT {
            return Ok((last, true));
        }
    }
    Ok((most, false))
}

/// Where a platform taps the rotor in every period, roughly.
pub(super) fn tapped_start(axial_forcing: f64, restitution: f64) -> Result<ImpactState, CoreError> {
    ImpactState::new(Phase::new(1.64)?, -0.26 * axial_forcing / restitution)
}

fn random_start(random: &mut SplitMix64, axial_forcing: f64) -> Result<ImpactState, CoreError> {
    let (time, speed) = (TAU * random.unit(), PI * axial_forcing * (0.2 + 0.8 * random.unit()));
    ImpactState::new(Phase::new(time)?, -speed)
}

fn lives(
    name: &str,
    law: impl Fn(f64) -> Law + Sync,
    axial_forcing: f64,
    (quality, progress): (Quality, &dyn Progress),
) -> Result<Lives, ExperimentError> {
    let (starts, most) = quality.choose((8, 5e3), (64, 2e5));
    let times: Vec<f64> = (9..=30).map(|k| 0.05 * f64::from(k)).collect();
    let map = |time| law(time).map(axial_forcing);
    let points = each(times.len(), progress, |index| {
        let (map, mut random) = (map(times[index])?, SplitMix64::new(SEED));
        let (mut total, mut ended) = (0.0, 0);
        for _ in 0..starts {
            let (lasted, has_ended) = life(&map, random_start(&mut random, axial_forcing)?, most)?;
            total += lasted;
            ended += usize::from(has_ended);
        }
        Ok(Life { contact_time: times[index], flown_periods: total, ended })
    })?;
    // The tapped orbit, followed to shorter contacts up to its end.
    let mut state = tapped_start(axial_forcing, law(1.0).restitution)?;
    let mut tapped_from = None;
    for step in 0..=300_u32 {
        let time = 2.0 - 0.005 * f64::from(step);
        let releases = releases(&map(time)?, &mut state, quality.choose((1_000, 100), (4_000, 400)))?;
        if !releases.iter().all(|(after, _)| (after / TAU - 1.0).abs() < 1e-4) {
            break;
        }
        tapped_from = Some(time);
    }
    Ok(Lives { name: name.to_owned(), starts, most_periods: most, points, tapped_from })
}

/// Releases after `settling` ones.
fn releases(
    map: &DrivenMap,
    state: &mut ImpactState,
    (settling, kept): (usize, usize),
) -> Result<Vec<(f64, ImpactState)>, CoreError> {
    let mut releases = Vec::new();
    for release in 0..settling + kept {
        let Some((after, next)) = next_release(map, *state)? else { break };
        *state = next;
        if release >= settling {
            releases.push((after, next));
        }
    }
    Ok(releases)
}

fn transition(axial_forcing: f64, restitution: f64, quality: Quality) -> Result<Transition, CoreError> {
    let columns = quality.choose(60, 240);
    let counts = quality.choose((400, 12), (3_000, 32));
    let (mut tapped, mut flown) = (Vec::new(), Vec::new());
    let (mut state, mut random) = (tapped_start(axial_forcing, restitution)?, SplitMix64::new(SEED));
    let mut is_tapped = true;
    for column in (0..columns).rev() {
        let (from, to) = TRANSITION;
        let time = from + (to - from) * (f64::from(column) + 0.5) / f64::from(columns);
        let map = Law::damped(time, restitution).map(axial_forcing)?;
        let dots = |releases: Vec<(f64, ImpactState)>| {
            releases.into_iter().map(move |(_, state)| (time, state.phase().cycles()))
        };
        if is_tapped {
            let own = releases(&map, &mut state, counts)?;
            is_tapped = own.iter().all(|(after, _)| *after < LONG * TAU);
            tapped.extend(dots(own).filter(|_| is_tapped));
        }
        let mut start = random_start(&mut random, axial_forcing)?;
        flown.extend(dots(releases(&map, &mut start, (10, counts.1))?));
    }
    Ok(Transition { tapped, flown })
}

/// A curve of one quantity of the motor for each of the contacts.
fn curves(
    contacts: &[(String, Option<f64>)],
    values: &[f64],
    progress: &dyn Progress,
    of: impl Fn(Option<f64>, f64) -> Result<Rotor, Error> + Sync,
) -> Result<Vec<Curve>, ExperimentError> {
    let count = values.len();
    let rotors = each(contacts.len() * count, progress, |index| {
        Ok(of(contacts[index / count].1, values[index % count])?)
    })?;
    let curve = |((name, _), rotors): (&(String, _), &[Rotor])| {
        let of =
            |of: fn(&Rotor) -> [f64; 3]| [0, 1, 2].map(|lag| rotors.iter().map(|own| of(own)[lag]).collect());
        let (speeds, stall_shares) = (of(|own| own.speeds), of(|own| own.stall_shares));
        Curve { name: name.clone(), values: values.to_vec(), speeds, stall_shares }
    };
    Ok(contacts.iter().zip(rotors.chunks(count)).map(curve).collect())
}

/// The run-up of the paper's motor with a contact, and how much its speed fluctuates in the last third.
fn run(motor: Motor, name: &str, contact_time: Option<f64>, quality: Quality) -> Result<Run, Error> {
    let stator = DrivenMotor::new(motor, Waveform::Sine, Waveform::Sine)?;
    let frequency = motor.system().platform().angular_frequency() / TAU;
    let stator = match contact_time {
        Some(share) => stator.with_contact_time(share / frequency)?,
        None => stator,
    };
    let (duration, intervals) = quality.choose((0.3, 60), (4.0, 800));
    let settings = TransientSettings { duration, intervals, ..TransientSettings::default() };
    let curve = stator.transient(Phase::new(0.3)?, &settings, &Unobserved)?;
    let last = &curve.speeds[2 * curve.speeds.len() / 3..];
    let mean = last.iter().sum::<f64>() / last.len() as f64;
    let square = last.iter().map(|speed| (speed - mean) * (speed - mean)).sum::<f64>() / last.len() as f64;
    let points = curve.times.into_iter().zip(curve.speeds).collect();
    Ok(Run { name: name.to_owned(), points, mean, fluctuation: square.sqrt() })
}

/// The contact time of the paper's ball on the edge of its stator, and on a plane, over the period: least and
/// most.
pub(super) fn paper_contacts(motor: &Motor) -> Result<[[f64; 2]; 2], ExperimentError> {
    let plane = Contact { geometry: Some(Geometry::Plane), ring_radius: None, ..Contact::PAPER };
    let mut times = [[0.0; 2]; 2];
    for (own, contact) in times.iter_mut().zip([Contact::PAPER, plane]) {
        let sheet = motor.with(|sheet| sheet.contact = Some(contact))?;
        let statement = sheet.report(&Unobserved)?.contact.and_then(|contact| contact.time_over_period);
        *own = statement.expect("materials and sizes give a contact time");
    }
    Ok(times)
}

pub(super) fn compute(
    quality: Quality,
    progress: &dyn Progress,
) -> Result<ExtraContactData, ExperimentError> {
    let motor = Motor::paper_70_khz();
    let (paper, disk) = (motor.system(), motor.system().disk());
    let (restitution, forcing) = (disk.restitution(), paper.axial_forcing());
    let (columns, rows) = quality.choose((12, 8), (40, 30));
    let [ring, plane] = paper_contacts(&motor)?;
    let contacts: Vec<(String, Option<f64>)> =
        [None, Some(1.0), Some(ring[0]), Some(ring[1]), Some(plane[1])]
            .into_iter()
            .map(|time| (time.map_or_else(|| "rigid".to_owned(), |time| format!("{time:.1}")), time))
            .collect();
    let points = quality.choose(8, 32);
    progress.start((columns * rows + 4 * 22 + contacts.len() * points * 4) as u64, "motions");
    let at = |law: Law, forcing: f64| law.rotor(forcing);
    let table = |contact_time| Law { contact_time, restitution, hysteretic: false };
    let cells = each(columns * rows, progress, |index| {
        let middle = |index: usize, count: usize| (index as f64 + 0.5) / count as f64;
        let time = between(CONTACT_TIMES, middle(index % columns, columns));
        let forcing = between(FORCINGS, middle(index / columns, rows));
        Ok(cell(Law::damped(time, restitution), forcing)?)
    })?;
    let work = (quality, progress);
    let lives = vec![
        lives("0.5", |time| Law::damped(time, 0.5), forcing, work)?,
        lives("0.2", |time| Law::damped(time, 0.2), forcing, work)?,
        lives("0.9", |time| Law::damped(time, 0.9), forcing, work)?,
        lives("0.5, spring", |time| Law { hysteretic: true, ..Law::damped(time, 0.5) }, forcing, work)?,
    ];
    let preloads = logarithmic(PRELOADS, points);
    let amplitudes = logarithmic(AMPLITUDES, points);
    let restitutions: Vec<f64> = (0..points)
        .map(|k| RESTITUTIONS.0 + (RESTITUTIONS.1 - RESTITUTIONS.0) * k as f64 / (points - 1) as f64)
        .collect();
    let over_preload = curves(&contacts, &preloads, progress, |time, preload| {
        at(table(time), forcing * disk.preload_acceleration() / preload)
    })?;
    let over_amplitude = curves(&contacts, &amplitudes, progress, |time, amplitude| {
        at(table(time), forcing * amplitude / paper.platform().amplitude())
    })?;
    let over_restitution = curves(&contacts, &restitutions, progress, |time, restitution| {
        at(Law { restitution, ..table(time) }, forcing)
    })?;
    let lags: Vec<f64> = (0..=48).map(|k| PI * (f64::from(k) / 24.0 - 1.0)).collect();
    let over_lag = contacts.iter().map(|(name, time)| {
        let (impulses, _) = table(*time).impulses(forcing)?;
        let balances: Vec<_> = lags.iter().map(|lag| impulses.balance(*lag)).collect();
        let speeds = balances.iter().map(|balance| balance.steady_speed()).collect();
        let stall_shares = balances.iter().map(|balance| balance.net_share(0.0)).collect();
        let alone = |own: Vec<f64>| [own, Vec::new(), Vec::new()];
        let (speeds, stall_shares) = (alone(speeds), alone(stall_shares));
        Ok(Curve { name: name.clone(), values: lags.clone(), speeds, stall_shares })
    });
    let over_lag = over_lag.collect::<Result<_, ExperimentError>>()?;
    let times = logarithmic(CONTACT_TIMES, 2 * points);
    let variants = [
        ("0.5".to_owned(), Some(0.5)),
        ("0.2".to_owned(), Some(0.2)),
        ("0.9".to_owned(), Some(0.9)),
        ("0.5, spring".to_owned(), None),
    ];
    let over_time = curves(&variants, &times, progress, |restitution, time| {
        let law = Law::damped(time, restitution.unwrap_or(0.5));
        at(Law { hysteretic: restitution.is_none(), ..law }, forcing)
    })?;
    let runs = contacts.iter().map(|(name, time)| run(motor, name, *time, quality));
    Ok(ExtraContactData {
        axial_forcing: forcing,
        restitution,
        ring,
        plane,
        cells: Cells {
            columns,
            regimes: cells
                .chunks(columns)
                .map(|row| row.iter().map(|own| char::from(b'0' + own.regime)).collect())
                .collect(),
            mean_phases: cells.iter().map(|own| own.mean_phase).collect(),
            best_lags: cells.iter().map(|own| own.best_lag).collect(),
            speeds_at_zero: cells.iter().map(|own| own.speed_at_zero).collect(),
            best_speeds: cells.iter().map(|own| own.best_speed).collect(),
        },
        transition: transition(forcing, restitution, quality)?,
        lives,
        over_time,
        runs: runs.collect::<Result<_, _>>()?,
        mass_kg: motor.mass(),
        over_preload,
        over_lag,
        over_restitution,
        over_amplitude,
    })
}
