//! Judges whether the speeds of a run are known, and names their shortfalls.

use bouncing_disk_core::numerics::statistics::{NORMAL_975, mean};

use super::SteadyRun;
use crate::motor::operation::averages::{Averages, Pairs, Sum, Units};
use crate::motor::operation::member::LEAST_FOR_DECADE;
use crate::motor::operation::point::{Estimate, Shortfall, error_of_mean};
use crate::motor::operation::settling::{decided_by_start, drift, shortfall};
use crate::motor::tape::taped::{error_of_steps, resolution};
use crate::motor::tape::window::Window;

/// Largest difference in speed, as a share of the requested error, due to halving the inertia of the rotors.
const INERTIA_SHARE: f64 = 0.6;

/// If the scatter is less than this share of the requested error, a longer run does not help: the rest of the
/// error is due to the perturbation.
const SCATTER_SHARE: f64 = 0.5;

/// Rotors from below and from above that differ by more than this number of requested errors stay apart.
const PARTED: f64 = 8.0;

/// Fewest members of a group with its own amplitude.
const LEAST_OF_GROUP: usize = 2;

/// The shortfall of irregular motions that have no window yet.
const NOTHING_YET: Shortfall = Shortfall::Error { standard_error: f64::INFINITY, wanted: 1.0 };

/// A motor whose disk stores more than this share of the supplied power has not settled.
const STORED_SHARE: f64 = 0.05;

impl SteadyRun<'_> {
    /// The largest speed (rad/s) of the unloaded motors, to which errors are relative.
    pub(super) fn scale(&self) -> f64 {
        let unloaded = (0..self.motors.len()).filter(|motor| self.motors[*motor].is_unloaded());
        let scale = unloaded.map(|index| {
            let motor = &self.motors[index];
            let [speeds, _] = self.speeds(index);
            let means: Vec<f64> = if speeds.is_empty() {
                let unit = motor.system.scales().angular_speed;
                let cycles = self.cycles(index);
                cycles.iter().map(|sum| sum.rotor.angle / sum.axial.duration * unit).collect()
            } else {
                speeds.into_iter().flatten().collect()
            };
            let known = if means.is_empty() { 0.0 } else { mean(&means) };
            // A motor without twist moves only if a load makes it creep.
            let creep = motor.system.dimensionless().friction() * motor.system.scales().angular_speed;
            known.abs().max(0.01 * motor.fastest.angular_speed.max(creep))
        });
        scale.fold(0.0, f64::max)
    }

    pub(super) fn judge(&mut self) {
        if self.averaged().is_empty() {
            self.shortfalls.fill((!self.members.is_empty()).then_some(NOTHING_YET));
            return;
        }
        let scale = self.reference.unwrap_or_else(|| self.scale());
        // A load may drive a rotor faster than it turns without one; the error is then a share of its own
        // speed.
        let speeds: Vec<_> = (0..self.asked).map(|motor| self.speeds(motor)).collect();
        let wanted = |[middle, _]: &[Vec<Vec<f64>>; 2]| {
            let means: Vec<f64> = middle.iter().map(|windows| mean(windows)).collect();
            self.settings.relative_error * scale.max(mean(&means).abs())
        };
        self.wanted = speeds.iter().map(wanted).collect();
        self.shortfalls = (speeds.iter().enumerate())
            .map(|(motor, [middle, above])| {
                if self.is_parted(motor) {
                    return self.unbalanced(motor);
                }
                self.undecided(motor, middle)
                    .or_else(|| shortfall(middle, above, self.are_perturbed(), self.wanted[motor]))
                    .or_else(|| self.drifting_amplitude(motor, middle))
                    .or_else(|| self.inaccurate(motor))
                    .or_else(|| self.unbalanced(motor))
            })
            .collect();
    }

    /// Whether rotors from far below and from far above stay apart. Under a load that decreases with the
    /// speed, both may be steady, and no rotor passes from one speed to the other.
    pub(super) fn is_parted(&self, motor: usize) -> bool {
        if self.motors[motor].law().is_finite() {
            return false;
        }
        let ([middle, above], are_perturbed) = (self.speeds(motor), self.are_perturbed());
        let below: Vec<Vec<f64>> = middle
            .iter()
            .zip(&above)
            .map(|(middle, above)| {
                middle.iter().zip(above).map(|(middle, above)| 2.0 * middle - above).collect()
            })
            .collect();
        let settled =
            |speeds: &[Vec<f64>]| shortfall(speeds, speeds, are_perturbed, self.wanted[motor]).is_none();
        let of_all =
            |speeds: &[Vec<f64>]| mean(&speeds.iter().map(|windows| mean(windows)).collect::<Vec<_>>());
        settled(&below) && settled(&above) && of_all(&above) - of_all(&below) > PARTED * self.wanted[motor]
    }

    /// The drift of a compliant stator's amplitude, if it is significant, expressed as the resulting drift of
    /// the speed.
    fn drifting_amplitude(&self, motor: usize, speeds: &[Vec<f64>]) -> Option<Shortfall> {
        let amplitudes = self.amplitudes(motor)?;
        let of_all = |all: &[Vec<f64>]| mean(&all.iter().map(|windows| mean(windows)).collect::<Vec<_>>());
        let known = of_all(&amplitudes);
        let (off, standard_error) = drift(&amplitudes, self.settings.relative_error * known)?;
        let [drift, standard_error] = [off, standard_error].map(|part| part / known * of_all(speeds));
        Some(Shortfall::Drift { drift, standard_error: standard_error.abs() })
    }

    /// The amplitude of a compliant stator in the windows after the start-up, for each member.
    fn amplitudes(&self, motor: usize) -> Option<Vec<Vec<f64>>> {
        let system = self.motors[motor].yielding().filter(|system| system.yields())?;
        let amplitude = |window: &&Window| {
            let own = window.rotors[motor].stator.as_deref();
            own.map_or(0.0, |(ledger, axial)| system.amplitude(0, ledger.damping_loss[0], axial.duration))
        };
        Some(self.averaged().iter().map(|windows| windows.iter().map(amplitude).collect()).collect())
    }

    /// The members at each of the two amplitudes that a stator keeps in irregular motions without drift;
    /// empty if there is only one amplitude. Each group may be split again later.
    pub(super) fn groups(&self) -> Vec<Vec<usize>> {
        let amplitudes =
            (self.held.has_many() && self.ended_windows.is_empty()).then(|| self.amplitudes(0)).flatten();
        let Some(amplitudes) = amplitudes.filter(|all| decided_by_start(all).is_some()) else {
            return Vec::new();
        };
        let mut order: Vec<(f64, usize)> =
            amplitudes.iter().enumerate().map(|(index, windows)| (mean(windows), index)).collect();
        order.sort_by(|one, other| one.0.total_cmp(&other.0));
        let ratio = |place: &usize| order[place + 1].0 / order[*place].0;
        let gap = (0..order.len() - 1).max_by(|one, other| ratio(one).total_cmp(&ratio(other))).unwrap_or(0);
        let (low, high) = order.split_at(gap + 1);
        let groups: Vec<Vec<usize>> =
            [low, high].map(|part| part.iter().map(|(_, index)| *index).collect()).into();
        // Differences below the requested accuracy are part of the error.
        if ratio(&gap) < 1.0 + self.settings.relative_error {
            return Vec::new();
        }
        let is_settled = |group: &Vec<usize>| {
            let own: Vec<Vec<f64>> = group.iter().map(|index| amplitudes[*index].clone()).collect();
            group.len() >= LEAST_OF_GROUP && drift(&own, 0.0).is_none()
        };
        if groups.iter().all(is_settled) { groups } else { Vec::new() }
    }

    /// The dependence (rad/s) of the speed on the start, for a motor whose stator has kinks or is compliant.
    /// Between two kinks a stator may carry a whole family of motions, each of which keeps its own speed. A
    /// compliant stator may keep two amplitudes, with an irregular motion at each.
    pub(super) fn apart(&self, motor: usize, speeds: &[Vec<f64>]) -> f64 {
        if self.motors[motor].stator.has_kinks() || self.held.has_many() {
            decided_by_start(speeds).unwrap_or(0.0)
        } else {
            0.0
        }
    }

    /// A dependence on the start that exceeds the requested error.
    fn undecided(&self, motor: usize, speeds: &[Vec<f64>]) -> Option<Shortfall> {
        let spread = self.apart(motor, speeds);
        let means: Vec<f64> = speeds.iter().map(|windows| mean(windows)).collect();
        let standard_error = error_of_mean(&means);
        (standard_error + spread / NORMAL_975 > self.wanted[motor] && spread > 0.0)
            .then_some(Shortfall::Start { spread, standard_error })
    }

    /// The energy that the disk still stores, if it is too large a part of the supplied energy. If the disk
    /// settles, this part is inversely proportional to the time for which it is followed.
    fn unbalanced(&self, motor: usize) -> Option<Shortfall> {
        let units = Units::of(&self.motors[motor]);
        let sum = self.total(motor);
        let stored = sum.axial.energy_change * units.axial + sum.rotor.kinetic_change * units.rotary;
        let share = stored.abs() / sum.energy_scale(&units, &self.systems[motor], self.settings.members);
        // A disk that is thrown ever higher stores the platform's energy, however much the rotor takes.
        let given = sum.axial.normal_work.abs() + sum.axial.perturbation_work;
        let peak = self.systems[motor].peak_acceleration();
        let moving = 0.5 * self.settings.members as f64 * peak * peak;
        let share = share.max(sum.axial.energy_change.abs() / given.max(moving));
        let time = sum.axial.duration;
        let input = sum.axial.normal_work * units.axial + sum.rotor.friction_work * units.rotary;
        (share > STORED_SHARE)
            .then_some(Shortfall::PowerBalance { stored_power: stored / time, input_power: input / time })
    }

    /// The sum of all averaged windows.
    pub(super) fn total(&self, rotor: usize) -> Sum {
        Sum::of(self.averaged().into_iter().flatten(), rotor)
    }

    /// The sums of a motor's two rotors for each member after the start-up.
    pub(super) fn pairs(&self, index: usize) -> Pairs {
        let halved =
            (self.is_quicker() && index < self.asked).then(|| self.motors.len() + self.asked + index);
        Pairs {
            quickest: halved.map_or_else(Vec::new, |halved| self.pairs_of([halved; 2]).below),
            ..self.pairs_of([index, self.rotor_from_above(index)])
        }
    }

    /// The sums of two rotors for each member after the start-up.
    pub(super) fn pairs_of(&self, rotors: [usize; 2]) -> Pairs {
        let averaged = self.averaged();
        let [below, above] = rotors.map(|rotor| -> Vec<Sum> {
            averaged.iter().map(|windows| Sum::of(windows.iter().copied(), rotor)).collect()
        });
        let (quickest, samples) = (Vec::new(), Vec::new());
        let are_perturbed = self.are_perturbed();
        let is_pressed = below.iter().any(|sum| sum.axial.pressed > 0.0);
        let steps = if is_pressed { error_of_steps(resolution(self.settings.relative_error)) } else { 0.0 };
        Pairs { below, above, quickest, samples, are_perturbed, steps }
    }

    /// The sampled speeds of two rotors for each member after the start-up.
    pub(super) fn samples_of(&self, rotors: [usize; 2]) -> Vec<Vec<f64>> {
        let samples = |windows: &Vec<&Window>| {
            let of = |rotor: usize| windows.iter().flat_map(move |own| own.rotors[rotor].speeds.samples());
            rotors.into_iter().flat_map(of).collect()
        };
        self.averaged().iter().map(samples).collect()
    }

    /// Whether members have perturbations of different sizes, determined by their indices.
    fn are_perturbed(&self) -> bool {
        let count = self.members.len();
        !self.stators[0].takes_time()
            && self.ended_windows.is_empty()
            && count == self.settings.members
            && count >= LEAST_FOR_DECADE
    }

    /// Whether the rotors have less inertia than their motors.
    pub(super) fn is_quicker(&self) -> bool {
        self.quicker.iter().any(|quicker| *quicker > 1.0)
    }

    /// The mean speed (rad/s) of a motor, and its changes due to halving the inertia, if this is reduced, and
    /// due to the size of the perturbation; `None` if no motion is irregular.
    fn with_bias(&self, index: usize) -> Option<(Estimate, [f64; 2])> {
        let unit = self.motors[index].system.scales().angular_speed;
        let speed = |sum: &Sum| sum.rotor.angle / sum.axial.duration * unit;
        let pairs = self.pairs(index);
        let known = Averages::Members(&pairs).estimate(&speed).ok().filter(|_| !pairs.below.is_empty())?;
        let quickest: Vec<f64> = pairs.quickest.iter().map(speed).collect();
        let bias = if quickest.is_empty() { 0.0 } else { (mean(&quickest) - known.value).abs() };
        Some((known, [bias, pairs.change(&pairs.of(&speed)[0]).ok()?]))
    }

    /// Whether the reduction of the inertia matters more than the requested error allows.
    pub(super) fn is_too_quick(&self) -> bool {
        let bias = |index| self.with_bias(index).map_or(0.0, |(_, [bias, _])| bias);
        self.is_quicker() && (0..self.asked).any(|index| bias(index) > INERTIA_SHARE * self.wanted[index])
    }

    /// An error that is too large, including the effects of the reduced inertia and of the perturbation, if a
    /// longer run can reduce it.
    fn inaccurate(&self, index: usize) -> Option<Shortfall> {
        let (known, [bias, change]) = self.with_bias(index)?;
        let (standard_error, wanted) = (known.standard_error, self.wanted[index]);
        let scatter = (standard_error * standard_error - change * change).max(0.0).sqrt();
        let helps =
            standard_error > wanted && bias <= INERTIA_SHARE * wanted && scatter > SCATTER_SHARE * wanted;
        helps.then_some(Shortfall::Error { standard_error, wanted })
    }
}
