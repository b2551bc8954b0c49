//! Means over the members of an ensemble or over a cycle, with their errors, and the units of the sums in
//! windows.

use bouncing_disk_core::numerics::elementary::hypot;
use bouncing_disk_core::numerics::statistics::{NORMAL_975, mean};

use crate::error::{Error, finite};
use crate::motor::operation::loaded_motor::LoadedMotor;
use crate::motor::operation::member::far_above;
use crate::motor::operation::point::{Estimate, by_perturbation, error_of_mean};
use crate::motor::tape::cycle::Cycle;
use crate::motor::tape::window::{AxialWindow, RotorWindow, Speeds, Window};
use crate::parameters::dimensionless::DimensionlessSystem;
use crate::parameters::scales::Scales;
use crate::stator::StatorLedger;

/// The sums of each member, for the rotors that started far below and far above the steady speed.
#[derive(Clone)]
pub(super) struct Pairs {
    pub(super) below: Vec<Sum>,
    pub(super) above: Vec<Sum>,
    /// The sums for rotors with half of a reduced inertia; empty if the inertia is not reduced.
    pub(super) quickest: Vec<Sum>,
    /// Speeds of each member's two rotors at evenly spaced times.
    pub(super) samples: Vec<Vec<f64>>,
    /// Whether members have perturbations of different sizes.
    pub(super) are_perturbed: bool,
    /// Relative error of values due to the steps of the tape.
    pub(super) steps: f64,
}

impl Pairs {
    /// Two values for each member: the mean over its two rotors, and the value of the rotor that started from
    /// above.
    pub(super) fn of(&self, value: &dyn Fn(&Sum) -> f64) -> [Vec<f64>; 2] {
        let middles =
            self.below.iter().zip(&self.above).map(|(one, other)| 0.5 * (value(one) + value(other)));
        [middles.collect(), self.above.iter().map(value).collect()]
    }

    /// The mean of one value per member, with its error due to their scatter.
    pub(super) fn scatter(&self, values: &[f64]) -> Result<Estimate, Error> {
        if self.are_perturbed { Estimate::of_decade(values) } else { Estimate::of(values) }
    }

    /// The standard deviation of a value over a decade of the perturbation, after subtracting twice the
    /// variance that the scatter of the members explains.
    pub(super) fn change(&self, values: &[f64]) -> Result<f64, Error> {
        if !self.are_perturbed {
            return Ok(0.0);
        }
        let (all, count) = (mean(values), values.len() as f64);
        let off = |own: &Vec<f64>| own.len() as f64 / count * (mean(own) - all) * (mean(own) - all);
        let between = by_perturbation(values).iter().map(off).sum::<f64>();
        // Three means about the overall mean.
        let scatter = self.scatter(values)?.standard_error;
        Ok((between - 2.0 * (2.0 * scatter * scatter)).max(0.0).sqrt())
    }
}

/// The set over which means are taken.
pub(super) enum Averages<'a> {
    Members(&'a Pairs),
    Cycle { sums: &'a [Sum; 2], cycle: &'a Cycle },
}

impl Averages<'_> {
    pub(super) fn estimate(&self, value: &dyn Fn(&Sum) -> f64) -> Result<Estimate, Error> {
        match self {
            Self::Members(pairs) => {
                let [middle, above] = pairs.of(value);
                let known = pairs.scatter(&middle)?.bounded_by(pairs.scatter(&above)?);
                let standard_error = hypot(known.standard_error, pairs.change(&middle)?);
                let off = known.value * (1.0 + pairs.steps);
                let known = Estimate { standard_error, ..known }.bounded_by(Estimate { value: off, ..known });
                if pairs.quickest.is_empty() {
                    return Ok(known);
                }
                let quickest: Vec<f64> = pairs.quickest.iter().map(value).collect();
                Ok(known.bounded_by(pairs.scatter(&quickest)?))
            }
            Self::Cycle { sums: [fine, coarse], cycle } => {
                let known = finite("estimate", value(fine))?;
                let off = (value(coarse) - known).abs() + cycle.repeats.distance * known.abs();
                Ok(Estimate { value: known, standard_error: off / NORMAL_975 })
            }
        }
    }

    /// The difference between the value for other rotors on the same motion and the value for these rotors.
    pub(super) fn rise(&self, others: &Self, value: &dyn Fn(&Sum) -> f64) -> Result<Estimate, Error> {
        match (self, others) {
            (Self::Members(own), Self::Members(other)) => {
                let ([own_values, _], [others, _]) = (own.of(value), other.of(value));
                let rises: Vec<f64> = own_values.iter().zip(others).map(|(own, other)| other - own).collect();
                let known = own.scatter(&rises)?;
                Ok(Estimate { standard_error: hypot(known.standard_error, own.change(&rises)?), ..known })
            }
            _ => {
                let (own, other) = (self.estimate(value)?, others.estimate(value)?);
                let standard_error = own.standard_error + other.standard_error;
                Ok(Estimate { value: other.value - own.value, standard_error })
            }
        }
    }

    /// The range of the speed during 95 % of the time, or over a whole cycle. The rotors have `quicker` times
    /// less inertia than their motor. `None` if too few speeds are known.
    pub(super) fn speed_range(&self, quicker: f64) -> Option<[Estimate; 2]> {
        let pairs = match self {
            Self::Cycle { sums, .. } => {
                let [Speeds::Within(fine), Speeds::Within(coarse)] =
                    sums.each_ref().map(|sum| sum.rotor.speeds)
                else {
                    return None;
                };
                return Some([0, 1].map(|end| {
                    let standard_error = (fine[end] - coarse[end]).abs() / NORMAL_975;
                    Estimate { value: fine[end], standard_error }
                }));
            }
            Self::Members(pairs) => pairs,
        };
        let count = pairs.samples.len();
        // The scatter needs two members.
        if count < 2 || pairs.samples.iter().map(Vec::len).sum::<usize>() < LEAST_SAMPLES {
            return None;
        }
        let samples = || pairs.samples.iter().enumerate();
        let mut sorted: Vec<(usize, f64)> =
            samples().flat_map(|(member, own)| own.iter().map(move |speed| (member, *speed))).collect();
        sorted.sort_by(|one, other| one.1.total_cmp(&other.1));
        let without = |left_out: usize| {
            let kept = samples().filter(|(member, _)| *member != left_out);
            let about = mean(&kept.flat_map(|(_, own)| own).copied().collect::<Vec<_>>());
            let kept = sorted.iter().filter(|(member, _)| *member != left_out);
            middle_of(&kept.map(|(_, speed)| *speed).collect::<Vec<_>>(), about, quicker)
        };
        // Each member is left out in turn: the jackknife.
        let all: Vec<[f64; 2]> = (0..count).map(without).collect();
        let found = without(count);
        Some([0, 1].map(|end| {
            let ends: Vec<f64> = all.iter().map(|range| range[end]).collect();
            let standard_error = error_of_mean(&ends) * (count as f64 - 1.0);
            Estimate { value: found[end], standard_error }
        }))
    }

    pub(super) fn ratio(
        &self,
        dividend: &dyn Fn(&Sum) -> f64,
        divisor: &dyn Fn(&Sum) -> f64,
    ) -> Option<Estimate> {
        match self {
            Self::Members(pairs) => {
                let (work, put_in) = (pairs.of(dividend), pairs.of(divisor));
                let ratio = |start: usize| Estimate::of_ratio(&work[start], &put_in[start]);
                ratio(0).zip(ratio(1)).map(|(middle, above)| middle.bounded_by(above))
            }
            Self::Cycle { sums: [fine, _], .. } => {
                let ratio = || self.estimate(&|sum| dividend(sum) / divisor(sum)).ok();
                if divisor(fine) > 0.0 { ratio() } else { None }
            }
        }
    }

    /// One of the sums.
    pub(super) fn first(&self) -> Sum {
        match self {
            Self::Members(pairs) => pairs.below.first().cloned().unwrap_or_default(),
            Self::Cycle { sums: [fine, _], .. } => fine.clone(),
        }
    }

    /// Averaged time (rad) and number of impacts of all members together.
    pub(super) fn duration_and_impacts(&self) -> (f64, u64) {
        match self {
            Self::Members(pairs) => (
                pairs.below.iter().map(|sum| sum.axial.duration).sum(),
                pairs.below.iter().map(|sum| sum.axial.impacts).sum(),
            ),
            Self::Cycle { sums: [fine, _], .. } => (fine.axial.duration, fine.axial.impacts),
        }
    }
}

/// Fewest samples of a speed for which a range is read off the ordered samples.
const LEAST_SAMPLES: usize = 160;

/// The ends of the middle 95 % of ordered speeds, moved towards `about` because a rotor with its full inertia
/// swings less.
fn middle_of(speeds: &[f64], about: f64, quicker: f64) -> [f64; 2] {
    [0.025, 0.975].map(|share| {
        let place = share * (speeds.len() - 1) as f64;
        let (index, part) = (place as usize, place.fract());
        let speed = speeds[index] + part * (speeds[index + 1] - speeds[index]);
        about + (speed - about) / quicker.sqrt()
    })
}

/// SI units of the sums in windows.
pub(super) struct Units {
    pub(super) time: f64,
    pub(super) length: f64,
    pub(super) speed: f64,
    /// m g a_e (N m).
    pub(super) torque: f64,
    /// Power (W) of one unit of energy per radian, axial and rotary.
    pub(super) axial: f64,
    pub(super) rotary: f64,
}

impl Units {
    pub(super) fn of(motor: &LoadedMotor<'_>) -> Self {
        let Scales { time, length, angular_speed, axial_energy, rotary_energy, .. } = motor.system.scales();
        Self {
            time,
            length,
            speed: angular_speed,
            torque: motor.torque_unit(),
            axial: motor.mass * axial_energy / time,
            rotary: motor.mass * rotary_energy / time,
        }
    }
}

/// The sum over windows of one member or of all members.
#[derive(Debug, Clone, Default)]
pub(super) struct Sum {
    pub(super) axial: AxialWindow,
    pub(super) rotor: RotorWindow,
}

impl Sum {
    /// The sum for a rotor over these windows.
    pub(super) fn of<'a>(windows: impl Iterator<Item = &'a Window>, rotor: usize) -> Self {
        let mut sum = Self::default();
        windows.for_each(|window| sum.add(window, rotor));
        sum
    }

    fn add(&mut self, window: &Window, rotor: usize) {
        let rotor = &window.rotors[rotor];
        self.axial.add(rotor.stator.as_ref().map_or(&window.axial, |own| &own.1));
        self.rotor.add(rotor);
    }

    /// The energies of a compliant stator.
    pub(super) fn stator(&self) -> StatorLedger {
        self.rotor.stator.as_ref().map(|own| own.0).unwrap_or_default()
    }

    /// The energy supplied, but at least the energy of all members' disks at the start, below which only
    /// rounding errors remain.
    pub(super) fn energy_scale(&self, units: &Units, system: &DimensionlessSystem, members: usize) -> f64 {
        let axial = self.axial.normal_work + self.axial.perturbation_work;
        // A load that drives the motor also supplies energy, as does a rotor that slows down.
        let rotor = &self.rotor;
        let rotary = rotor.friction_work.abs().max(rotor.load_work.abs()).max(rotor.friction_loss);
        let put_in = axial.abs() * units.axial + rotary * units.rotary;
        let (peak, twist) = (system.peak_acceleration(), far_above(system).max(system.twist_speed()));
        let moving = 0.5 * peak * peak * units.axial + 0.5 * twist * twist * units.rotary;
        put_in.max(members as f64 * moving)
    }

    /// The residual of the energy balance, relative to the supplied energy.
    pub(super) fn energy_residual(&self, units: &Units, system: &DimensionlessSystem, members: usize) -> f64 {
        let axial = self.axial.normal_work + self.axial.perturbation_work;
        let axial_left = axial - self.axial.restitution_loss - self.axial.energy_change;
        let rotor = &self.rotor;
        let rotary_left = rotor.friction_work - rotor.friction_loss - rotor.load_work - rotor.kinetic_change;
        let stator_left = self.stator().closure() * units.axial;
        let left = (axial_left * units.axial).abs() + (rotary_left * units.rotary).abs() + stator_left.abs();
        // The modes of a heavy stator hold much more energy than the disk.
        let modes = self.stator();
        let scale = self.energy_scale(units, system, members) + modes.drive_work.abs() * units.axial;
        if scale > 0.0 { left / scale } else { left }
    }
}
