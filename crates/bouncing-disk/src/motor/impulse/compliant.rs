//! The normal impulses of a disk on a platform with compliant contact.

use std::f64::consts::TAU;

use bouncing_disk_drives::compliance::{CompliantPlatform, ContactEnd, Pressed};

use super::{NormalImpulses, PhasedImpulse};
use crate::error::{Error, within_limit};

/// Largest number of periods that are followed.
const MAX_PERIODS: usize = 1_000_000;

/// Number of parts per period, and smallest number per contact, into which the force is divided. The speed of
/// the stator changes by less than 0.007 of its amplitude in half a part.
const PARTS: f64 = 512.0;
const LEAST_PARTS: f64 = 8.0;

impl NormalImpulses {
    /// The impulses of a disk that lies on the platform at phase 0, over `periods` of the drive after the
    /// first `settling` periods, or over one period if the disk follows the platform for ever. All impulses
    /// are listed under [`contact`](Self::contact), in parts; [`landings`](Self::landings) are the phases at
    /// which the force begins.
    ///
    /// # Errors
    /// An error of the core for more than a million periods; the errors of the flights and of the contacts.
    pub fn of_contact(platform: &CompliantPlatform, settling: usize, periods: usize) -> Result<Self, Error> {
        within_limit("periods whose impulses are wanted", settling.saturating_add(periods), MAX_PERIODS)?;
        let (from, until) = (TAU * settling as f64, TAU * (settling + periods) as f64);
        let mut impulses = Self { duration: until - from, ..Self::default() };
        let (mut now, mut pressed) = (0.0, platform.press(platform.resting(0.0)));
        while now < until {
            let end = pressed.end(until - now)?;
            let span = match end {
                Some(ContactEnd::Release(span) | ContactEnd::Turns(span, _)) => span,
                Some(ContactEnd::Settles(span)) => {
                    let mut steady = Self { duration: TAU, ..Self::default() };
                    steady.add(&pressed, span, span + TAU);
                    return Ok(steady);
                }
                None => until - now,
            };
            impulses.add(&pressed, (from - now).clamp(0.0, span), span);
            now += span;
            pressed = match end {
                None => break,
                Some(ContactEnd::Turns(_, branch)) => platform.press_on(branch, pressed.turned(span)),
                Some(_) => {
                    let Some(touch) = platform.touch(pressed.released(span), until - now)? else { break };
                    now += touch.duration;
                    if now > from {
                        impulses.landings.push(touch.state.time);
                    }
                    platform.press(touch.state)
                }
            };
        }
        Ok(impulses)
    }

    /// Adds the impulses of a contact from one time after its start to another.
    fn add(&mut self, pressed: &Pressed, from: f64, to: f64) {
        if to <= from {
            return;
        }
        let gained = pressed.velocity_change();
        let parts = ((to - from) * (PARTS / TAU)).ceil().max(LEAST_PARTS);
        let step = (to - from) / parts;
        let mut start = gained.at(from, to).value;
        for part in 0..parts as u32 {
            let end = from + step * f64::from(part + 1);
            let then = gained.at(end, to).value;
            // The force cannot pull; this removes the rounding of a force near zero.
            let impulse = (then - start + step).max(0.0);
            let phase = (pressed.from().time + (end - 0.5 * step)).rem_euclid(TAU);
            self.contact.push(PhasedImpulse { phase, impulse });
            start = then;
        }
    }
}

#[cfg(test)]
mod tests {
    use bouncing_disk_core::{Phase, Unobserved};
    use bouncing_disk_drives::Drive;
    use bouncing_disk_drives::compliance::Compliance;

    use super::*;
    use crate::Motor;
    use crate::motor::{MotorParameters, TransientSettings};
    use crate::parameters::contact::Contact;

    fn impulses(contact_periods: f64, peak: f64, settling: usize, periods: usize) -> NormalImpulses {
        let contact = Compliance::new(contact_periods * TAU, 0.5).expect("legal");
        let platform = CompliantPlatform::new(Drive::fourier(&[(peak, 0.0)]).expect("legal"), contact);
        NormalImpulses::of_contact(&platform.expect("legal"), settling, periods).expect("no failure")
    }

    #[test]
    fn the_impulse_is_the_weight_times_the_time() {
        let peak = Motor::paper_70_khz().system().dimensionless().peak_acceleration();
        // Tapped in every period; partly in contact; never left.
        for (contact_periods, peak) in [(1.0, peak), (5.0, peak), (18.0, peak), (1.0, 0.5)] {
            let impulses = impulses(contact_periods, peak, 5_000, 100);
            let off = impulses.total() / impulses.duration - 1.0;
            assert!(off.abs() < 1e-4, "{contact_periods} {peak}: {off}");
            let once = impulses.landings.iter().all(|phase| (phase - impulses.landings[0]).abs() < 1e-9);
            assert!(once, "{:?}", impulses.landings);
        }
    }

    /// A rotor whose speed changes little in one contact settles at the median. Its own motion, with all
    /// slips and reversals, is computed without medians.
    #[test]
    fn the_median_is_the_speed_at_which_a_rotor_ends() {
        let frequency = 70e3;
        for lag in [0.0, -0.5 * std::f64::consts::PI] {
            let quick = |sheet: &mut MotorParameters| (sheet.friction, sheet.phase_lag) = (1.0, lag);
            let motor = Motor::paper_70_khz().with(quick).expect("legal");
            let peak = motor.system().dimensionless().peak_acceleration();
            let predicted = impulses(2.0, peak, 2_000, 50).balance(lag).steady_speed();
            let contact = Contact::lasting(2.0 / frequency);
            let soft = motor.with(|sheet| sheet.contact = Some(contact)).expect("legal");
            let settings = TransientSettings { duration: 0.5, intervals: 5, ..TransientSettings::default() };
            let phase = Phase::new(0.3).expect("finite");
            let curve = soft.transient(phase, &settings, &Unobserved).expect("no failure");
            let speed = curve.speeds[4] / motor.system().platform().peak_angular_speed();
            assert!((speed - predicted).abs() < 0.01, "{lag}: {speed} {predicted}");
        }
    }
}
