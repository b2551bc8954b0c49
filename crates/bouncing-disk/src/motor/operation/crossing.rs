//! The unstable speed of a rotor under a load torque that decreases with the speed.

use bouncing_disk_core::Observer;
use bouncing_disk_core::numerics::statistics::NORMAL_975;
use roots::{Convergency, find_root_regula_falsi};

use crate::error::Error;
use crate::motor::operation::loaded_motor::LoadedMotor;
use crate::motor::operation::point::Estimate;
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::operation::steady_run::operate_for;
use crate::motor::tape::replay::torque;

/// Share of the distance between two stable speeds: this close to them no unstable speed is sought, and the
/// slope is computed over this distance.
const MARGIN: f64 = 1.0 / 32.0;

/// A speed counts as found within this share of its standard error; and the largest number of speeds tried.
const FOUND: f64 = 0.25;
const MOST_STEPS: usize = 40;

/// The speed (rad/s) between two stable speeds, the slower first, from which a rotor may move to either of
/// them. At this speed the motor's torque rises above the load's as the speed grows. `None` if no such speed
/// is found, or if its 95 % interval is wider than the distance between the two.
///
/// The motor's torque at a speed is defined as the constant load under which a rotor has this mean speed. The
/// law of the load is evaluated at the mean speed. The swing of the rotor's speed is part of the error,
/// because it can carry a rotor across.
pub(super) fn unstable_speed(
    motor: &LoadedMotor<'_>,
    [slow, fast]: [f64; 2],
    settings: &OperatingSettings,
    observer: &dyn Observer,
) -> Result<Option<Estimate>, Error> {
    let Some(law) = motor.yielding() else { return Ok(None) };
    let bare = motor.stator.without_law()?;
    let unit = motor.system.scales().angular_speed;
    let (mut length, mut swing) = (None, 0.0);
    // The excess speed of a rotor that has the load of a given speed.
    let mut excess = |speed: f64| {
        let load = torque(&law.lines, speed / unit) * motor.torque_unit();
        let loaded = LoadedMotor { stator: &bare, ..*motor }.with_load(load)?;
        let found = operate_for(length, &[loaded], settings, observer)?;
        // All use one tape, so that their scatter is the same.
        length = length.or(Some(found.length));
        let deviation = found.rows[0].point().and_then(|one| one.speed_deviation);
        swing = deviation.map_or(0.0, |deviation| deviation.value);
        // No load exceeds the torque that friction gives at a speed that is maintained.
        let free =
            found.rows[0].point().map_or(Estimate { value: slow, standard_error: 0.0 }, |one| one.speed);
        Ok::<_, Error>(Estimate { value: free.value - speed, ..free })
    };
    let apart = MARGIN * (fast - slow);
    let (from, to) = (slow + apart, fast - apart);
    let ends = [excess(from)?, excess(to)?];
    if ends[0].value >= 0.0 || ends[1].value <= 0.0 {
        return Ok(None);
    }
    let mut failure = None;
    let off = |speed: f64| match excess(speed) {
        Ok(known) => known.value,
        Err(error) => {
            failure = failure.take().or(Some(error));
            0.0
        }
    };
    let mut near = Near(FOUND * ends[0].standard_error.max(ends[1].standard_error));
    let Ok(value) = find_root_regula_falsi(from, to, off, &mut near) else { return Ok(None) };
    if let Some(error) = failure {
        return Err(error);
    }
    let [below, above, at] = [excess(value - apart)?, excess(value + apart)?, excess(value)?];
    let slope = (above.value - below.value) / (2.0 * apart);
    // Its swing can carry a rotor across a nearby speed.
    let standard_error = (at.standard_error + at.value.abs() / NORMAL_975) / slope + swing;
    let is_known = slope > 0.0 && NORMAL_975 * standard_error < fast - slow;
    Ok(is_known.then_some(Estimate { value, standard_error }))
}

/// The largest distance at which two speeds count as equal.
struct Near(f64);

impl Convergency<f64> for Near {
    fn is_root_found(&mut self, excess: f64) -> bool {
        excess.abs() <= self.0
    }

    fn is_converged(&mut self, one: f64, other: f64) -> bool {
        (one - other).abs() <= self.0
    }

    fn is_iteration_limit_reached(&mut self, steps: usize) -> bool {
        steps >= MOST_STEPS
    }
}
