//! The results for each motor: its operations, from the members and from the cycles that these reached.

use bouncing_disk_core::numerics::statistics::NORMAL_975;

use super::{Branch, Carried, MOST_CYCLES, MotorResult, Repeated, START_UP, SteadyRun, of_windows};
use crate::error::Error;
use crate::motor::operation::averages::{Averages, Pairs, Sum, Units};
use crate::motor::operation::loaded_motor::LoadedMotor;
use crate::motor::operation::point::{
    AxialMotion, Estimate, Life, OperatingPoint, OperatingRow, Operation, Shortfall, StatorPoint,
};
use crate::motor::operation::settling::left_out;
use crate::motor::tape::window::RotorWindow;

/// A speed below this share of the stator's largest speed counts as rounding.
const LEAST_SPEED: f64 = 1.0e-12;

/// The operations of each motor, of all parts.
pub(super) fn results_of(parts: &[SteadyRun<'_>]) -> Result<Vec<MotorResult>, Error> {
    let result = |index: usize| {
        let mut branches = Vec::new();
        for part in parts {
            branches.extend(part.branches(index)?);
        }
        branches.sort_by_key(|(from_rest, _, _)| std::cmp::Reverse(*from_rest));
        // There are members, or they have repeated.
        let [middle, above] = branches[0].2.clone();
        let branches = branches.into_iter().map(|(_, operation, _)| operation).collect();
        Ok((OperatingRow { branches }, middle, above))
    };
    (0..parts[0].asked).map(result).collect()
}

impl SteadyRun<'_> {
    /// The operations of a motor.
    pub(super) fn branches(&self, index: usize) -> Result<Vec<Branch>, Error> {
        let mut branches = Vec::new();
        let scales = self.motors[index].system.scales();
        let speed = |sum: &Sum| sum.rotor.angle / sum.axial.duration * scales.angular_speed;
        let pairs = self.pairs(index);
        // From below and from above, if these stay apart.
        let is_parted = !pairs.below.is_empty() && self.is_parted(index);
        let from_above = self.rotor_from_above(index);
        let all = match (pairs.below.is_empty(), is_parted) {
            (true, _) => Vec::new(),
            (false, true) => [[index; 2], [from_above; 2]]
                .map(|rotors| Pairs { samples: self.samples_of(rotors), ..self.pairs_of(rotors) })
                .into(),
            (false, false) => vec![Pairs { samples: self.samples_of([index, from_above]), ..pairs }],
        };
        let beside = self.beside(index);
        for pairs in &all {
            let others = beside.filter(|_| !is_parted).map(|beside| self.pairs(beside));
            let others = others.as_ref().map(Averages::Members);
            let point = self.point(index, &Averages::Members(pairs), others.as_ref())?;
            let (standard_error, wanted) = (point.speed.standard_error, self.wanted[index]);
            let too_large =
                (standard_error > 1.01 * wanted).then_some(Shortfall::Error { standard_error, wanted });
            let operation = match self.shortfalls[index].or(too_large) {
                None => Operation::Steady(point),
                Some(Shortfall::Error { .. }) => {
                    Operation::Unsettled(point, Shortfall::Error { standard_error, wanted })
                }
                Some(shortfall) => Operation::Unsettled(point, shortfall),
            };
            let from_rest = self.members.iter().map(|own| own.from_rest).sum();
            // A motion that ends is not where most rotors are finally.
            let from_rest = if self.life.ended > 0 { 0 } else { from_rest };
            branches.push((from_rest, operation, pairs.of(&speed)));
        }
        // A rotor that the stator turns forwards from rest does not reach the motion in which rotors are
        // driven back.
        if let [(_, first, _), (_, _, _)] = &branches[..]
            && let Some(OperatingPoint { blocked_torque: Some(torque), speed, .. }) = first.point()
            && speed.value < 0.0
            && torque.value > self.motors[index].torque_at_rest()
        {
            branches.swap(0, 1);
        }
        let is_family = self.repeated.len() > MOST_CYCLES && self.motors[index].stator.has_kinks();
        if is_family {
            let operation = self.family(index)?;
            let speeds: Vec<f64> = self.cycles(index).iter().map(speed).collect();
            branches.push((usize::from(self.life.ended > 0), operation, [speeds.clone(), speeds]));
        }
        for repeated in self.repeated.iter().filter(|_| !is_family) {
            let sums = repeated.windows.each_ref().map(|window| Sum::of(std::iter::once(window), index));
            let speeds = sums.each_ref().map(|sum| vec![speed(sum); self.settings.members]);
            let averages = Averages::Cycle { sums: &sums, cycle: &repeated.cycle };
            let others = beside.map(|beside| {
                repeated.windows.each_ref().map(|window| Sum::of(std::iter::once(window), beside))
            });
            let others = others.as_ref().map(|sums| Averages::Cycle { sums, cycle: &repeated.cycle });
            let point = self.point(index, &averages, others.as_ref())?;
            branches.push((repeated.from_rest, Operation::Steady(point), speeds));
        }
        Ok(branches)
    }

    /// The motor that differs from this one in its constant load only, and by the least amount; `None` if
    /// each motor has its own vertical motion.
    fn beside(&self, index: usize) -> Option<usize> {
        let motor = &self.motors[index];
        if motor.stator.acts_back() {
            return None;
        }
        let apart = |other: &usize| (self.systems[*other].load() - self.systems[index].load()).abs();
        let differs = |other: &usize| {
            let own = &self.motors[*other];
            let bare = |motor: &LoadedMotor<'_>| motor.system.with_disk(|disk| disk.load_acceleration = 0.0);
            let is_same = own.mass.to_bits() == motor.mass.to_bits() && bare(own).ok() == bare(motor).ok();
            let law = motor.law();
            let has_same_law = law.is_finite() && law.to_bits() == own.law().to_bits()
                || std::ptr::eq(own.stator, motor.stator);
            is_same && has_same_law && apart(other) > 0.0
        };
        (0..self.motors.len()).filter(differs).min_by(|one, other| apart(one).total_cmp(&apart(other)))
    }

    /// The time constant (s) of a motor's speed, from the change of the speed with the load.
    fn time_constant(
        &self,
        index: usize,
        averages: &Averages<'_>,
        others: &Averages<'_>,
    ) -> Option<Estimate> {
        let (motor, other) = (&self.motors[index], &self.motors[self.beside(index)?]);
        let unit = Units::of(motor).speed;
        let rise = averages.rise(others, &|sum| sum.rotor.angle / sum.axial.duration * unit).ok()?;
        let gyration = motor.system.disk().gyration_radius();
        let inertia = motor.mass * gyration * gyration;
        let times = inertia / (motor.load_torque - other.load_torque);
        let known = Estimate { value: times * rise.value, standard_error: times.abs() * rise.standard_error };
        (known.value > NORMAL_975 * known.standard_error).then_some(known)
    }

    /// The motion of a motor's rotor in each cycle.
    pub(super) fn cycles(&self, index: usize) -> Vec<Sum> {
        let of_cycle = |repeated: &Repeated| Sum::of(std::iter::once(&repeated.windows[0]), index);
        self.repeated.iter().map(of_cycle).collect()
    }

    /// The operation of a motor for which each start keeps its own cycle.
    fn family(&self, index: usize) -> Result<Operation, Error> {
        let cycles = self.cycles(index);
        let unit = self.motors[index].system.scales().angular_speed;
        let speeds: Vec<f64> = cycles.iter().map(|sum| sum.rotor.angle / sum.axial.duration * unit).collect();
        let (below, quickest) = (cycles.clone(), Vec::new());
        let samples = Vec::new();
        let pairs = Pairs { below, above: cycles, quickest, samples, are_perturbed: false, steps: 0.0 };
        let point = self.point(index, &Averages::Members(&pairs), None)?;
        let known = Estimate::of(&speeds)?;
        let spread = speeds.iter().fold(0.0_f64, |most, speed| (speed - known.value).abs().max(most));
        let speed = known.bounded_by(Estimate { value: known.value + spread, ..known });
        let shortfall = Shortfall::Start { spread, standard_error: known.standard_error };
        let motion = AxialMotion::Periodic {
            periods: self.repeated[0].cycle.periods,
            impacts: self.repeated[0].windows[0].axial.impacts,
        };
        Ok(Operation::Unsettled(OperatingPoint { speed, motion, ..point }, shortfall))
    }

    /// The operating point of a motor; `others` are the averages of the neighbouring motor, if there is one.
    fn point(
        &self,
        index: usize,
        averages: &Averages<'_>,
        others: Option<&Averages<'_>>,
    ) -> Result<OperatingPoint, Error> {
        let motor = &self.motors[index];
        let units = Units::of(motor);
        let estimate = |value: &dyn Fn(&Sum) -> f64| averages.estimate(value);
        let speed = |sum: &Sum| sum.rotor.angle / sum.axial.duration * units.speed;
        let mechanical = |sum: &Sum| sum.rotor.load_work / sum.axial.duration * units.rotary;
        let input = |sum: &Sum| {
            (sum.axial.normal_work * units.axial + sum.rotor.friction_work * units.rotary)
                / sum.axial.duration
        };
        let restitution = |sum: &Sum| sum.axial.restitution_loss / sum.axial.duration * units.axial;
        let friction = |sum: &Sum| sum.rotor.friction_loss / sum.axial.duration * units.rotary;
        let perturbation = |sum: &Sum| sum.axial.perturbation_work / sum.axial.duration * units.axial;
        let mechanical_power = estimate(&mechanical)?;
        let braked = mechanical_power.value >= 0.0;
        let efficiency = averages.ratio(&mechanical, &input).filter(|_| braked);
        let torque = |sum: &Sum| sum.rotor.load_impulse / sum.axial.duration * units.torque;
        let load_torque = if motor.law().is_finite() {
            Estimate { value: motor.load_torque + motor.law() * units.torque, standard_error: 0.0 }
        } else {
            estimate(&torque)?
        };
        let stator = motor.yielding().filter(|system| system.yields()).map(|system| {
            // A prescribed twist does the work on the disk that no mode does.
            let drive = |sum: &Sum| {
                let ledger = sum.stator();
                input(sum) + (ledger.drive_work - ledger.disk_work) / sum.axial.duration * units.axial
            };
            let lost = |sum: &Sum| sum.stator().damping_loss;
            let amplitude = |sum: &Sum| system.amplitude(0, lost(sum)[0], sum.axial.duration) * units.length;
            let loss = |sum: &Sum| lost(sum).iter().sum::<f64>() / sum.axial.duration * units.axial;
            Ok::<_, Error>(StatorPoint {
                amplitude: estimate(&amplitude)?,
                drive_power: estimate(&drive)?,
                damping_loss: estimate(&loss)?,
                efficiency: averages.ratio(&mechanical, &drive).filter(|_| braked),
            })
        });
        let of_all = estimate(&speed)?.value / units.speed;
        let deviation = |sum: &Sum| {
            // About the mean of all members: the speed of one may wander for longer than it is followed.
            let RotorWindow { angle, square, .. } = sum.rotor;
            let squares = square - of_all * (2.0 * angle - of_all * sum.axial.duration);
            // For a slow rotor it is inversely proportional to its inertia.
            let own = if let Averages::Members(_) = averages { self.quicker[index] } else { 1.0 };
            (squares / sum.axial.duration / own).max(0.0).sqrt() * units.speed
        };
        let friction_torque = self.systems[index].friction() * units.torque;
        let held = |sum: &Sum| sum.rotor.held / sum.axial.duration * friction_torque;
        let known_of_tapes = averages.first().rotor.held.is_finite();
        let given = |value: &dyn Fn(&Sum) -> f64| known_of_tapes.then(|| estimate(value)).transpose();
        // The error also includes the spread between starts.
        let mut known = estimate(&speed)?;
        let (motion, start_up, whole, members) = match averages {
            Averages::Members(_) => {
                let apart = self.apart(index, &self.speeds(index)[0]);
                known = known.bounded_by(Estimate { value: known.value + apart, ..known });
                let after = if self.ended_windows.is_empty() { left_out(self.windows()) } else { START_UP };
                let motion = AxialMotion::Irregular { life: self.life(units.time) };
                let omitted = |own: &Carried| of_windows(&own.windows[..after.min(own.windows.len())]);
                let start_up = self.members.iter().map(omitted).fold(0.0, f64::max) * units.time;
                (motion, start_up, self.total(index), self.settings.members)
            }
            Averages::Cycle { sums: [fine, _], cycle } => {
                let least = LEAST_SPEED * motor.fastest.angular_speed;
                if known.value.abs() < least {
                    known = Estimate { value: 0.0, standard_error: least / NORMAL_975 };
                }
                let (periods, impacts) = (cycle.periods, fine.axial.impacts);
                let motion = if cycle.is_contact() {
                    AxialMotion::Contact
                } else {
                    AxialMotion::Periodic { periods, impacts }
                };
                (motion, 0.0, fine.clone(), 1)
            }
        };
        let (duration, impacts) = averages.duration_and_impacts();
        Ok(OperatingPoint {
            load_torque: load_torque.value,
            load_torque_error: load_torque.standard_error,
            motion,
            speed: known,
            speed_deviation: given(&deviation)?,
            speed_range: averages
                .speed_range(self.quicker[index])
                .map(|range| range.map(|end| end.times(units.speed))),
            unstable_speed: None,
            time_constant: others.and_then(|others| self.time_constant(index, averages, others)),
            blocked_torque: given(&held)?,
            mechanical_power,
            input_power: estimate(&input)?,
            restitution_loss: estimate(&restitution)?,
            friction_loss: estimate(&friction)?,
            efficiency,
            perturbation_power: estimate(&perturbation)?.value,
            energy_residual: whole.energy_residual(&units, &self.systems[index], members),
            averaged_time: duration * units.time,
            start_up,
            impacts,
            stator: stator.transpose()?,
        })
    }

    /// The life of an irregular motion, with `unit` as the time per radian. The start-up is left out, because
    /// a member may then still be on its way to a cycle; after the start-up, motions end at a constant rate.
    fn life(&self, unit: f64) -> Life {
        let mut life = self.life;
        for own in &self.members {
            life.add(of_windows(&own.windows[own.windows.len().min(START_UP)..]), false);
        }
        if life.ended == 0 {
            return Life::NoneEndedIn(life.longest * unit);
        }
        let (value, ends) = (life.total / life.ended as f64 * unit, life.ended as f64);
        Life::Mean(Estimate { value, standard_error: value / ends.sqrt() })
    }
}
