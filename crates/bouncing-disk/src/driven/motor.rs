//! Motors whose stator moves in any way: the run-up from rest, and the speed under loads (Sec. V).

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::numerics::statistics::mean;
use bouncing_disk_core::run::{Watch, WorkCount};
use bouncing_disk_core::{Observer, Phase};

use super::engine::DrivenEngine;
use super::{DrivenEvent, DrivenStart, DrivenSystem};
use crate::error::{Error, check};
use crate::motor::rotor::transient::{Bins, curve};
use crate::motor::{SpeedCurve, TransientSettings};
use crate::parameters::disk::Disk;
use crate::parameters::driven_platform::DrivenPlatform;

/// Most runs of a [`speed_curve`] at one load.
const MAX_RUNS: usize = 100_000;

/// The speed transient of a rotor that lies at rest on the stator at `phase`, as
/// [`motor::transient`](crate::motor::transient()) for a sine.
///
/// The items of `observer` are the intervals of the curve.
///
/// # Errors
/// [`Error::OutOfRange`] for illegal settings; those of [`DrivenSystem::new`] and of the flights.
pub fn transient(
    stator: &DrivenPlatform,
    rotor: &Disk,
    phase: Phase,
    settings: &TransientSettings,
    observer: &dyn Observer,
) -> Result<SpeedCurve, Error> {
    let watch = Watch::begin(observer, 0, settings.intervals as u64)?;
    let mut work = watch.work();
    let curve = run(stator, rotor, phase, settings, &mut work, |done| watch.set_done(done))?;
    watch.end();
    Ok(curve)
}

fn run(
    stator: &DrivenPlatform,
    rotor: &Disk,
    phase: Phase,
    settings: &TransientSettings,
    work: &mut WorkCount<'_>,
    done: impl Fn(u64),
) -> Result<SpeedCurve, Error> {
    let unit = stator.scales(rotor);
    settings.check_for(&unit)?;
    let start = DrivenStart::Contact { phase, angular_speed: 0.0 };
    let mut engine = DrivenEngine::new(DrivenSystem::new(stator, rotor)?, start, settings.policy)?;
    engine.with_energy = false;
    let mut bins = Bins::new(settings.duration, settings.intervals)?;
    let mut generator = SplitMix64::new(settings.seed);
    let (mut impacts, mut separations, began) = (0, 0, engine.time());
    while bins.present.reached < settings.duration {
        work.spend(4)?;
        let (angle, now) = (engine.state().angle, engine.time().since(&began).radians());
        let left = settings.duration / unit.time - now;
        let Some(record) = engine.advance_within(left)? else {
            // Nothing happens any more: the rest of each interval.
            let mut turned = 0.0;
            for index in bins.present.index..settings.intervals {
                let last = index + 1 == settings.intervals;
                let to = if last { settings.duration } else { (index + 1) as f64 * bins.width };
                let (_, then) = engine.state_after(to / unit.time - now);
                bins.add(to, then.angle - angle - turned);
                turned = then.angle - angle;
            }
            break;
        };
        match record.event {
            DrivenEvent::Impact(_) | DrivenEvent::Kick(_) => impacts += 1,
            DrivenEvent::Separation => {
                separations += 1;
                if settings.relaunch_perturbation > 0.0 {
                    engine.perturb_launch(settings.relaunch_perturbation * generator.unit());
                }
            }
            _ => {}
        }
        let passed = record.time.since(&began).radians();
        bins.add(passed * unit.time, record.after.angle - angle);
        done(bins.present.index as u64);
    }
    curve(bins, &unit, (impacts, separations))
}

/// Speed of a motor under a load.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SpeedAtLoad {
    /// Deceleration by the load (rad/s^2), T_L/(m a_g^2).
    pub load_acceleration: f64,
    /// Mean speed at the end of the transients (rad/s).
    pub speed: f64,
    /// Standard error of it over the runs (rad/s).
    pub standard_error: f64,
}

/// The speed of a motor against the load: the means over the last `share` in (0, 1] of `runs` transients for each
/// load (rad/s^2), which start at phases spread over a period. The duration must be several time constants.
///
/// The items of `observer` are the transients.
///
/// # Errors
/// [`Error::OutOfRange`] for less than two runs, a load that is not finite or another share; those of [`transient`].
pub fn speed_curve(
    stator: &DrivenPlatform,
    rotor: &Disk,
    loads: &[f64],
    (runs, share): (usize, f64),
    settings: &TransientSettings,
    observer: &dyn Observer,
) -> Result<Vec<SpeedAtLoad>, Error> {
    check((2..=MAX_RUNS).contains(&runs), "number of runs", runs as f64, "[2, 100000]")?;
    let watch = Watch::begin(observer, 0, (loads.len() * runs) as u64)?;
    let mut work = watch.work();
    let mut curve = Vec::with_capacity(loads.len());
    for &load_acceleration in loads {
        let mut loaded = rotor.parameters();
        loaded.load_acceleration = load_acceleration;
        let loaded = loaded.build()?;
        let mut speeds = Vec::with_capacity(runs);
        for member in 0..runs {
            let phase = Phase::new(std::f64::consts::TAU * member as f64 / runs as f64)?;
            let seed = settings.seed.wrapping_add(member as u64);
            let own = TransientSettings { seed, ..*settings };
            speeds.push(run(stator, &loaded, phase, &own, &mut work, |_| {})?.mean_over_last(share)?);
            watch.set_done((curve.len() * runs + member + 1) as u64);
        }
        let speed = mean(&speeds);
        let squares: f64 = speeds.iter().map(|one| (one - speed) * (one - speed)).sum();
        let count = runs as f64;
        let standard_error = (squares / (count * (count - 1.0))).sqrt();
        curve.push(SpeedAtLoad { load_acceleration, speed, standard_error });
    }
    watch.end();
    Ok(curve)
}
