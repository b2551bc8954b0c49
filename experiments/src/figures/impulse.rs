//! Where in the cycle of the stator the rotor gets its normal impulse, and what speed follows from it.
//!
//! Between two moments of the same vertical state the normal impulse, of impacts and contact together, equals the
//! weight times the time between them. Friction passes on μ a_e of it, forwards wherever the stator turns faster than
//! the rotor and backwards elsewhere. For a rotor whose speed changes little in one impact therefore
//!
//! dα̇/dt = (μ a_e g/a_g²) S(α̇/(ωΦ)),    S(x) = share of impulse with cos(τ + θ) > x minus the rest.
//!
//! The steady speed is ωΦ times the impulse-weighted median of cos(τ + θ), and for a cycle of few impacts the
//! speed rises in straight lines that break where the rotor catches up with the stator at one of them.

use std::f64::consts::TAU;

use bouncing_disk::LONG_FLIGHT;
use bouncing_disk::core::elementary::cos;
use bouncing_disk::core::{ChatterPolicy, ImpactMap, Orbit, OrbitEvent, Phase};

use super::circular::Concentration;
use super::motor_case::core_error;
use crate::experiment::ExperimentError;

/// Parts into which a segment of contact is divided.
const CONTACT_PARTS: u32 = 32;

/// Impacts after which a motion that does not come to rest is given up.
const LONGEST_CYCLE: usize = 10_000;

/// The irrational step of an evenly filling sequence: the golden ratio.
const GOLDEN_STEP: f64 = 0.618_033_988_749_894_8;

/// Normal impulses of an orbit in units of m g/ω, each with its phase (rad).
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Impulses {
    /// Of single impacts.
    pub(crate) impacts: Vec<(f64, f64)>,
    /// Phases of the impacts that end a flight of more than half a period, those of a last cycle that is cut off among them. Those of a chattering sequence, without end, are not among them.
    pub(crate) landings: Vec<f64>,
    /// Of chattering that is summed, and of contact, in parts.
    pub(crate) contact: Vec<(f64, f64)>,
    /// Duration in radians, equal to the sum of all impulses between two separations.
    pub(crate) duration: f64,
}

impl Impulses {
    /// Of at least `impacts` impacts from one separation to a later one. Each separation gets a relative speed below
    /// `perturbation` (g/ω), evenly spread; the last cycle, cut off, is left out unless it is the only one.
    pub(crate) fn of(map: &ImpactMap, impacts: usize, perturbation: f64) -> Result<Self, ExperimentError> {
        let mut impulses = Self::default();
        let Some(phase) = map.vibration().separation_phase() else { return Ok(impulses) };
        let mut orbit = map.orbit_from_launch(phase, 0.0, ChatterPolicy::Complete).map_err(core_error)?;
        let mut separations = 0_u32;
        // What follows a separation is kept only when the next one comes.
        let mut complete = (0, 0, 0.0);
        let mut flown = 0.0;
        let most = 4 * impacts + LONGEST_CYCLE;
        while impulses.impacts.len() < most {
            let Some(event) = orbit.advance().map_err(core_error)? else { break };
            match event {
                OrbitEvent::Impact(impact) => {
                    flown += impact.duration();
                    if impact.duration() > LONG_FLIGHT {
                        impulses.landings.push(impact.phase.angle());
                    }
                    impulses
                        .impacts
                        .push((impact.phase.angle(), -(1.0 + map.restitution()) * impact.velocity));
                }
                OrbitEvent::Attachment(rest) => {
                    let Some((leaves, turns)) = rest.separation else { break };
                    let attached = rest.accumulation;
                    let from = impulses.impacts.last().map_or(phase.angle(), |impact| impact.0);
                    let chatter = attached.duration - rest.last_speed
                        + map.vibration().peak_acceleration() * (cos(attached.phase.angle()) - cos(from));
                    impulses.contact.push((attached.phase.angle(), chatter));
                    let until = leaves.angle() + TAU * turns as f64;
                    impulses.contact.extend(contact(map, attached.phase.angle(), until));
                    impulses.duration += flown + attached.duration + (until - attached.phase.angle());
                    flown = 0.0;
                    complete = (impulses.impacts.len(), impulses.contact.len(), impulses.duration);
                    if complete.0 >= impacts {
                        break;
                    }
                    separations += 1;
                    relaunch(&mut orbit, perturbation, separations)?;
                }
                _ => {}
            }
        }
        if complete.0 > 0 {
            impulses.impacts.truncate(complete.0);
            impulses.contact.truncate(complete.1);
            impulses.duration = complete.2;
        } else {
            impulses.duration = flown;
        }
        Ok(impulses)
    }

    fn all(&self) -> impl Iterator<Item = (f64, f64)> {
        self.impacts.iter().chain(&self.contact).copied()
    }

    /// The sum of all impulses.
    pub(crate) fn total(&self) -> f64 {
        self.all().map(|(_, impulse)| impulse).sum()
    }

    /// Shares of the impulse in equal parts of the cycle, from τ = −π to π.
    pub(crate) fn histogram(&self, parts: usize) -> Vec<f64> {
        let mut shares = vec![0.0; parts];
        for (phase, impulse) in self.all() {
            let turned = (phase / TAU + 0.5).rem_euclid(1.0);
            let part = ((turned * parts as f64) as usize).min(parts - 1);
            shares[part] += impulse;
        }
        let total: f64 = shares.iter().sum();
        shares.iter().map(|share| share / total).collect()
    }

    /// Where in the cycle the impulse is concentrated.
    pub(crate) fn concentration(&self) -> Option<Concentration> {
        Concentration::of(self.all())
    }

    /// Where the [`landings`](Self::landings) are.
    pub(crate) fn concentration_of_collisions(&self) -> Option<Concentration> {
        Concentration::of(self.landings.iter().map(|phase| (*phase, 1.0)))
    }

    /// Share of the impulse within `reach` (rad) of τ = 0.
    pub(crate) fn share_near_zero(&self, reach: f64) -> f64 {
        let near = self.all().filter(|(phase, _)| phase.min(TAU - phase) <= reach);
        near.map(|(_, impulse)| impulse).sum::<f64>() / self.total()
    }

    /// The impulses ordered by the speed of the stator with phase lag `phase_lag`.
    pub(crate) fn levels(&self, phase_lag: f64) -> Levels {
        let mut levels: Vec<(f64, f64)> =
            self.all().map(|(phase, impulse)| (cos(phase + phase_lag), impulse)).collect();
        levels.sort_by(|one, other| one.0.total_cmp(&other.0));
        let mut below = Vec::with_capacity(levels.len());
        let mut sum = 0.0;
        for (_, impulse) in &levels {
            sum += impulse;
            below.push(sum);
        }
        Levels { speeds: levels.into_iter().map(|level| level.0).collect(), below }
    }
}

/// Gives the launch that is due a relative speed of an evenly filling sequence.
fn relaunch(orbit: &mut Orbit, perturbation: f64, index: u32) -> Result<(), ExperimentError> {
    if perturbation > 0.0 {
        let share = (f64::from(index) * GOLDEN_STEP).rem_euclid(1.0);
        orbit.perturb_launch(perturbation * share).map_err(core_error)?;
    }
    Ok(())
}

/// The impulse of the normal force 1 − P sin τ between two angles, in parts.
fn contact(map: &ImpactMap, from: f64, until: f64) -> impl Iterator<Item = (f64, f64)> {
    let peak = map.vibration().peak_acceleration();
    let step = (until - from) / f64::from(CONTACT_PARTS);
    (0..CONTACT_PARTS).map(move |part| {
        let (start, end) = (from + step * f64::from(part), from + step * f64::from(part + 1));
        let middle = Phase::new(0.5 * (start + end)).map_or(start, |phase| phase.angle());
        (middle, (end - start) + peak * (cos(end) - cos(start)))
    })
}

/// Impulses ordered by cos(τ + θ).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Levels {
    speeds: Vec<f64>,
    /// Sum of the impulses up to each.
    below: Vec<f64>,
}

impl Levels {
    /// S: share of the impulse where the stator turns faster than `speed` (in units of ωΦ) minus the rest.
    pub(crate) fn net_share(&self, speed: f64) -> f64 {
        let slower = self.speeds.partition_point(|level| *level <= speed);
        let total = self.below.last().copied().unwrap_or(1.0);
        let below = if slower == 0 { 0.0 } else { self.below[slower - 1] };
        1.0 - 2.0 * below / total
    }

    /// The steady speed in units of ωΦ: the weighted median.
    pub(crate) fn steady_speed(&self) -> f64 {
        let half = 0.5 * self.below.last().copied().unwrap_or(0.0);
        let index = self.below.partition_point(|sum| *sum < half);
        self.speeds.get(index).or(self.speeds.last()).copied().unwrap_or(0.0)
    }

    /// The speed from rest in units of ωΦ at `count` equal steps up to `rises` rise times ωΦ a_g²/(μ a_e g).
    pub(crate) fn transient(&self, rises: f64, count: u32) -> (Vec<f64>, Vec<f64>) {
        let step = rises / f64::from(count);
        let mut speed = 0.0;
        let (mut times, mut speeds) = (Vec::new(), Vec::new());
        for index in 1..=count {
            let half = speed + 0.5 * step * self.net_share(speed);
            speed += step * self.net_share(half);
            times.push(step * f64::from(index));
            speeds.push(speed);
        }
        (times, speeds)
    }
}

#[cfg(test)]
mod tests {
    use bouncing_disk::core::Vibration;

    use super::*;

    fn map(peak: f64, restitution: f64) -> ImpactMap {
        let forcing = peak / std::f64::consts::PI;
        ImpactMap::new(Vibration::from_axial_forcing(forcing).expect("legal"), restitution).expect("legal")
    }

    #[test]
    fn the_impulse_of_a_cycle_is_the_weight_times_its_duration() {
        for (peak, restitution) in [(19.739_208_8, 0.5), (197.4, 0.3), (3.0, 0.0), (1.5, 0.5)] {
            let impulses = Impulses::of(&map(peak, restitution), 1, 0.0).expect("no failure");
            let off = impulses.total() / impulses.duration - 1.0;
            assert!(off.abs() < 1e-9, "{peak} {restitution}: {off}");
        }
    }

    #[test]
    fn half_of_the_impulse_lies_below_the_steady_speed() {
        let impulses = Impulses::of(&map(197.4, 0.5), 2_000, 1e-3).expect("no failure");
        let levels = impulses.levels(0.0);
        let steady = levels.steady_speed();
        assert!(levels.net_share(steady - 1e-6) >= 0.0 && levels.net_share(steady + 1e-6) <= 0.0);
        assert!(levels.net_share(-1.0 - 1e-9) >= 1.0 && levels.net_share(1.0) <= -1.0 + 1e-12);
        let (_, speeds) = levels.transient(20.0, 4_000);
        assert!((speeds[3_999] - steady).abs() < 0.02, "{} {steady}", speeds[3_999]);
        assert!((impulses.histogram(16).iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }
}
