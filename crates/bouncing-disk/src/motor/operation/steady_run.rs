//! An ensemble of vertical motions that runs until the speeds of all rotors are known well enough.

use std::f64::consts::TAU;

use bouncing_disk_core::Observer;
use bouncing_disk_core::numerics::statistics::{NORMAL_975, mean};
use bouncing_disk_core::run::Watch;

use crate::driven::DrivenSystem;
use crate::error::{Error, check, finite, positive, within_limit};
use crate::motor::batch::shared_orbit::shared_by;
use crate::motor::operation::followed::Left;
use crate::motor::operation::member::{Member, far_above};
use crate::motor::operation::point::{
    Estimate, OperatingPoint, Operation, Shortfall, StatorPoint, error_of_mean,
};
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::operation::settling::{decided_by_start, left_out, shortfall};
use crate::motor::operation::window::{AxialWindow, RotorWindow, Window};
use crate::motor::stator::Stator;
use crate::parameters::dimensionless::{DimensionlessParameters, DimensionlessSystem};
use crate::parameters::scales::Scales;
use crate::parameters::system::System;
use crate::stator::{StatorLedger, StatorSystem};

/// Windows of the first round, and windows in the time in which friction gives the platform's largest speed.
const FIRST_WINDOWS: usize = 12;
const WINDOWS_OF_RISE: f64 = 2.0;

/// With more windows, two and two become one.
const MOST_WINDOWS: usize = 128;

/// Most rotors of all members of one ensemble together: half a gigabyte with their windows, and those of the
/// second start of each.
pub const MAX_OPERATED_ROTORS: usize = 1 << 16;

/// Least impacts of a window, and least periods of the platform.
const LEAST_IMPACTS: u64 = 50;
const LEAST_PERIODS: f64 = 10.0;

/// A round is at most so many times as long as all rounds before it together, whatever the estimate.
const GROWTH: f64 = 3.0;

/// The factor by which the estimated number of windows is increased, so that a further round is seldom
/// needed.
const MARGIN: f64 = 1.15;

/// Relative rounding of a load that was computed from the largest torque of friction in other units: some ten
/// operations.
const LOAD_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// A motor whose disk stores more than this share of the power put in has not settled.
const STORED_SHARE: f64 = 0.05;

/// A motor under a load, to be carried on a shared vertical motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LoadedMotor<'a> {
    /// Rotor, shaft and sine of the sheet.
    pub(crate) system: System,
    /// The largest speeds of the stator.
    pub(crate) fastest: LargestSpeeds,
    /// The stator; load, friction and phase lag are those of `system`.
    pub(crate) stator: &'a Stator,
    /// Mass m (kg).
    pub(crate) mass: f64,
    /// Load torque T_L (N m) as given, from which the system's load is computed.
    pub(crate) load_torque: f64,
}

/// The largest speeds of a stator, by which starts and errors are scaled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LargestSpeeds {
    /// Of the height (g/omega), and of the angle (g a_e/(a_g^2 omega)).
    pub(crate) height: f64,
    pub(crate) angle: f64,
    /// Of the angle (rad/s).
    pub(crate) angular_speed: f64,
}

impl LargestSpeeds {
    /// Those of the sine of a system.
    pub(crate) fn of_sine(system: &System) -> Self {
        let own = system.dimensionless();
        let angular_speed = system.platform().peak_angular_speed();
        Self { height: own.peak_acceleration(), angle: own.twist_speed(), angular_speed }
    }

    /// Those of drives on the platform and under the disk of a system.
    pub(crate) fn of_drives(system: &System, driven: &DrivenSystem) -> Self {
        let (disk, scales, frequency) =
            (system.disk(), system.scales(), system.platform().angular_frequency());
        let preload = disk.preload_acceleration();
        let inertia = disk.gyration_radius() * disk.gyration_radius() / (disk.contact_radius() * preload);
        let amplitude = driven.height().bounds().speed * scales.length;
        let angular_speed = frequency * (driven.angle().bounds().speed * scales.angle);
        Self {
            height: amplitude * frequency * frequency / preload,
            angle: inertia * angular_speed * frequency,
            angular_speed,
        }
    }
}

impl LoadedMotor<'_> {
    /// Its numbers without units, with the largest speeds of its stator as those of the sine.
    fn dimensionless(&self) -> Result<DimensionlessSystem, Error> {
        let LargestSpeeds { height, angle, .. } = self.fastest;
        let own = self.system.dimensionless().parameters();
        DimensionlessParameters { peak_acceleration: height, twist_speed: angle, ..own }.build()
    }

    /// The same motor under another load torque (N m).
    pub(crate) fn with_load(&self, load_torque: f64) -> Result<Self, Error> {
        let disk = self.system.disk().parameters().with_load_torque(load_torque, self.mass)?;
        Ok(Self { system: System::new(*self.system.platform(), disk.build()?)?, load_torque, ..*self })
    }

    /// The same motor with another phase lag (rad).
    pub(crate) fn with_phase_lag(&self, phase_lag: f64) -> Result<Self, Error> {
        let system = self.system.with_platform(|platform| platform.phase_lag = phase_lag)?;
        Ok(Self { system, ..*self })
    }

    /// The load torque in units of m g a_e.
    pub(crate) const fn load(&self) -> f64 {
        self.system.dimensionless().load()
    }

    /// Whether a mean speed differs from zero: by more than four of its standard errors, and by more than
    /// rounding.
    pub(crate) fn turns(&self, speed: Estimate) -> bool {
        let rounding = 1e-6 * self.fastest.angular_speed;
        speed.value.abs() > (4.0 * speed.standard_error).max(rounding)
    }

    /// The largest mean torque of friction, mu m g a_e (N m).
    pub(crate) fn largest_torque(&self) -> f64 {
        let disk = self.system.disk();
        disk.friction() * self.mass * disk.preload_acceleration() * disk.contact_radius()
    }

    /// Its stator, if it yields or the load has a law.
    fn yielding(&self) -> Option<&StatorSystem> {
        self.stator.yielded()
    }

    /// What the law of the load adds to the load torque; infinite where it depends on the speed.
    fn law(&self) -> f64 {
        self.yielding().map_or(0.0, |own| own.constant_law().unwrap_or(f64::INFINITY))
    }

    /// Neither load torque nor law.
    fn is_unloaded(&self) -> bool {
        self.load() == 0.0 && self.law() == 0.0
    }

    /// The load accelerates it for ever: in units of m g a_e it is above the coefficient of friction, or
    /// equal to it but for the rounding of the torques in other units. On average the normal force is the
    /// weight under preload, so that friction gives no more, whatever the motion. Of a load that depends on the speed this
    /// is not known.
    fn runs_away(&self) -> bool {
        let system = self.system.dimensionless();
        let load = system.load() + self.law();
        load.is_finite() && load != 0.0 && load.abs() >= system.friction() * (1.0 - LOAD_ROUNDING)
    }

    fn runaway(&self) -> Operation {
        let system = self.system.dimensionless();
        let load = system.load() + self.law();
        let beyond = (load.abs() - system.friction()).max(0.0);
        let scale = self.system.scales().angular_acceleration;
        Operation::Runaway {
            load_torque: self.load_torque + self.law() * Units::of(self).torque,
            largest_torque: self.largest_torque(),
            acceleration: -beyond.copysign(load) * scale,
        }
    }
}

/// The mean speeds of all rotors and members, and the operations that follow from them.
#[derive(Debug)]
pub(crate) struct Operations {
    /// In the order of the motors.
    pub(crate) operations: Vec<Operation>,
    /// `speeds[rotor][member]`, mean angular speeds (rad/s) after the start-up, in the middle of those of
    /// rotors from far below and from far above; none for a runaway.
    pub(crate) speeds: Vec<Vec<f64>>,
    /// Those of rotors from far above: the difference bounds the remainder of the start-up.
    pub(crate) speeds_from_above: Vec<Vec<f64>>,
    /// How long each member was followed, in units of the shortest run.
    pub(crate) length: f64,
}

/// The steady operation of motors that share one vertical motion. The errors are relative to the largest
/// speed of those without load; if all have one, the first motor is also computed without its load.
pub(crate) fn operate(
    motors: &[LoadedMotor<'_>],
    settings: &OperatingSettings,
    observer: &dyn Observer,
) -> Result<Operations, Error> {
    settings.check()?;
    operate_for(None, motors, settings, observer)
}

/// The operations of a motor under each of these load torques.
pub(crate) fn curve_of(
    motor: LoadedMotor<'_>,
    load_torques: &[f64],
    settings: &OperatingSettings,
    observer: &dyn Observer,
) -> Result<Vec<Operation>, Error> {
    check(!load_torques.is_empty(), "number of loads", 0.0, "[1, 1000000]")?;
    let motors = load_torques
        .iter()
        .map(|&torque| motor.with_load(finite("load_torque", torque)?))
        .collect::<Result<Vec<_>, Error>>()?;
    Ok(operate(&motors, settings, observer)?.operations)
}

/// Where the two rotors of each member of an ensemble of one motor were left (SI).
pub(crate) type Ends = Vec<[Left; 2]>;

/// The steady operation of a motor from where another one was left, and where it is left; none of a runaway, and
/// of a stator that does not yield.
pub(crate) fn continued(
    motor: LoadedMotor<'_>,
    from: Option<&Ends>,
    settings: &OperatingSettings,
    observer: &dyn Observer,
) -> Result<(Operations, Option<Ends>), Error> {
    settings.check()?;
    operate_from(None, &[motor], from, settings, observer)
}

/// [`operate`] with members that are followed for exactly this length, however well the speeds are then
/// known; the settings may have fewer members than is legal elsewhere.
pub(crate) fn operate_for(
    length: Option<f64>,
    motors: &[LoadedMotor<'_>],
    settings: &OperatingSettings,
    observer: &dyn Observer,
) -> Result<Operations, Error> {
    Ok(operate_from(length, motors, None, settings, observer)?.0)
}

fn operate_from(
    length: Option<f64>,
    motors: &[LoadedMotor<'_>],
    from: Option<&Ends>,
    settings: &OperatingSettings,
    observer: &dyn Observer,
) -> Result<(Operations, Option<Ends>), Error> {
    let rotors = motors.len().saturating_mul(settings.members);
    within_limit("rotors of all members", rotors, MAX_OPERATED_ROTORS)?;
    let systems: Vec<System> = motors.iter().map(|motor| motor.system).collect();
    let first = *shared_by(&systems)?;
    for motor in motors {
        positive("mass", motor.mass)?;
    }
    let mut carried: Vec<LoadedMotor<'_>> =
        motors.iter().copied().filter(|motor| !motor.runs_away()).collect();
    let asked = carried.len();
    let bare = motors[0].stator.without_law()?;
    if !carried.iter().any(LoadedMotor::is_unloaded) {
        let system = first.with_disk(|disk| disk.load_acceleration = 0.0)?;
        carried.push(LoadedMotor { system, stator: &bare, load_torque: 0.0, ..motors[0] });
    }

    let mut results = Operations {
        operations: Vec::new(),
        speeds: Vec::new(),
        speeds_from_above: Vec::new(),
        length: length.unwrap_or(1.0),
    };
    let mut ends = None;
    let mut known = if asked > 0 {
        let watch = Watch::begin(observer, 0, settings.most_impacts)?;
        let mut run = SteadyRun::new(length.unwrap_or(1.0), carried, asked, from, settings)?;
        let first = run.duration;
        match length {
            Some(_) => run.extend(FIRST_WINDOWS, &watch)?,
            None => run.compute(settings, &watch)?,
        }
        results.length *= run.duration / first * run.windows() as f64 / FIRST_WINDOWS as f64;
        watch.end();
        ends = run.ends();
        run.results()?
    } else {
        Vec::new()
    }
    .into_iter();
    for motor in motors {
        // Each motor that does not run away has a result.
        let (operation, speeds, above) = if motor.runs_away() { None } else { known.next() }
            .unwrap_or_else(|| (motor.runaway(), Vec::new(), Vec::new()));
        results.operations.push(operation);
        results.speeds.push(speeds);
        results.speeds_from_above.push(above);
    }
    Ok((results, ends))
}

/// An operation, and the speeds of its members as in [`Operations`].
type MotorResult = (Operation, Vec<f64>, Vec<f64>);

/// An ensemble under way.
struct SteadyRun<'a> {
    motors: Vec<LoadedMotor<'a>>,
    /// Their [`LoadedMotor::dimensionless`].
    systems: Vec<DimensionlessSystem>,
    /// How many of them the caller requested: each of these is carried twice, from far below and from far
    /// above all steady speeds.
    asked: usize,
    members: Vec<(Member, Vec<Window>)>,
    /// Duration of a window (rad) and its least impacts.
    duration: f64,
    least_impacts: u64,
    /// Most impacts of a window.
    most_impacts: u64,
    /// What each rotor still lacks, and the requested error (rad/s).
    shortfalls: Vec<Option<Shortfall>>,
    wanted: f64,
}

impl<'a> SteadyRun<'a> {
    fn new(
        length: f64,
        motors: Vec<LoadedMotor<'a>>,
        asked: usize,
        from: Option<&Ends>,
        settings: &OperatingSettings,
    ) -> Result<Self, Error> {
        let systems = motors.iter().map(LoadedMotor::dimensionless).collect::<Result<Vec<_>, Error>>()?;
        let stators = motors.iter().map(|motor| motor.stator.for_motor(&motor.system));
        let stators = stators.collect::<Result<Vec<_>, Error>>()?;
        let mut members = (0..settings.members)
            .map(|index| Ok((Member::new(&systems, &stators, asked, index, settings)?, Vec::new())))
            .collect::<Result<Vec<_>, Error>>()?;
        for ((member, _), ends) in members.iter_mut().zip(from.into_iter().flatten()) {
            if let (Member::Yielding(member), Some(system)) = (member, stators[0].yielded()) {
                let (scales, speed) = (motors[0].system.scales(), far_above(&systems[0]));
                for ((place, speed), left) in [(0, -speed), (motors.len(), speed)].into_iter().zip(ends) {
                    let mut left = left.scaled(&scales, f64::recip);
                    // That they meet bounds what depends on the start, as of rotors that lie.
                    left.state.disk.angular_speed = speed;
                    member.resume(place, system, &left)?;
                }
            }
        }
        // The time in which friction gives the platform's largest speed, in radians; that of the slowest
        // rotor.
        let rise = systems.iter().filter(|system| system.friction() > 0.0);
        let rise = rise.map(|system| system.twist_speed() / system.friction()).fold(0.0, f64::max);
        let duration = length * (rise.min(f64::MAX) / WINDOWS_OF_RISE).max(LEAST_PERIODS * TAU);
        // Even where the rise takes for ever the first round spends no more than it may.
        let most_impacts = (settings.most_impacts / (settings.members * FIRST_WINDOWS) as u64).max(1);
        let least_impacts = ((length * LEAST_IMPACTS as f64) as u64).min(most_impacts);
        let shortfalls = vec![None; asked];
        Ok(Self {
            motors,
            systems,
            asked,
            members,
            duration,
            least_impacts,
            most_impacts,
            shortfalls,
            wanted: 0.0,
        })
    }

    /// Where the rotors of the first motor are.
    fn ends(&self) -> Option<Ends> {
        let scales = self.motors[0].system.scales();
        let left = |member: &Member, place: usize| match member {
            Member::Yielding(member) => Some(member.left(place).scaled(&scales, |unit| unit)),
            _ => None,
        };
        let places = [0, self.rotor_from_above(0)];
        self.members
            .iter()
            .map(|(member, _)| Some([left(member, places[0])?, left(member, places[1])?]))
            .collect()
    }

    /// Windows so far.
    fn windows(&self) -> usize {
        self.members[0].1.len()
    }

    fn compute(&mut self, settings: &OperatingSettings, watch: &Watch<'_>) -> Result<(), Error> {
        let mut target = FIRST_WINDOWS;
        loop {
            let more = target - self.windows();
            self.extend(more, watch)?;
            self.judge(settings);
            let lacking = self.shortfalls.iter().flatten();
            let Some(factor) = lacking.map(|shortfall| self.hoped_for(shortfall)).reduce(f64::max) else {
                return Ok(());
            };
            let windows = self.windows();
            let grown = (windows as f64 * factor.min(GROWTH)).ceil() as usize;
            target = grown.max(windows + 1);
            // Whether the impacts that are left are enough.
            let spent = self.spent();
            let left = settings.most_impacts.saturating_sub(spent);
            let each = spent.max(1) as f64 / windows as f64;
            let affordable = windows.saturating_add((left as f64 / each) as usize);
            if affordable <= windows {
                return Ok(());
            }
            target = target.min(affordable);
            if target > MOST_WINDOWS && self.windows() >= 2 * FIRST_WINDOWS {
                self.merge();
                target = target.div_ceil(2).max(self.windows() + 1);
            }
        }
    }

    /// How many times as long a run has to be.
    fn hoped_for(&self, shortfall: &Shortfall) -> f64 {
        match *shortfall {
            Shortfall::Error { standard_error, wanted } => {
                let ratio = standard_error / wanted;
                MARGIN * ratio * ratio
            }
            Shortfall::Drift { .. } | Shortfall::Start { .. } | Shortfall::PowerBalance { .. } => 2.0,
        }
    }

    /// Impacts of all members.
    fn spent(&self) -> u64 {
        let windows = self.members.iter().flat_map(|(_, windows)| windows);
        windows.map(|window| window.axial.impacts).sum()
    }

    fn extend(&mut self, more: usize, watch: &Watch<'_>) -> Result<(), Error> {
        let (duration, impacts) = (self.duration, self.least_impacts..=self.most_impacts);
        let extend_one = |(member, windows): &mut (Member, Vec<Window>)| {
            let mut work = watch.work();
            for _ in 0..more {
                let window = member.next_window(duration, impacts.clone(), &mut work)?;
                watch.finish(window.axial.impacts);
                windows.push(window);
            }
            Ok::<(), Error>(())
        };
        #[cfg(feature = "parallel")]
        {
            use rayon::prelude::*;
            let results: Vec<_> = self.members.par_iter_mut().with_max_len(1).map(extend_one).collect();
            results.into_iter().collect()
        }
        #[cfg(not(feature = "parallel"))]
        self.members.iter_mut().try_for_each(extend_one)
    }

    /// Makes one window of two.
    fn merge(&mut self) {
        for (_, windows) in &mut self.members {
            let mut pairs = std::mem::take(windows).into_iter();
            while let Some(mut window) = pairs.next() {
                // An odd one at the end is the last and stays alone.
                if let Some(next) = pairs.next() {
                    window.add(&next);
                }
                windows.push(window);
            }
        }
        self.duration *= 2.0;
        self.least_impacts *= 2;
        self.most_impacts = self.most_impacts.saturating_mul(2);
    }

    /// The rotor of a motor that started from far above; for a motor that the caller did not request, its
    /// only rotor.
    fn rotor_from_above(&self, motor: usize) -> usize {
        if motor < self.asked { self.motors.len() + motor } else { motor }
    }

    /// Mean speeds (rad/s) in the windows after the start-up, of each member: in the middle of a motor's two
    /// rotors, and of the one from far above.
    fn speeds(&self, motor: usize) -> [Vec<Vec<f64>>; 2] {
        let unit = self.motors[motor].system.scales().angular_speed;
        let after = left_out(self.windows());
        let above = self.rotor_from_above(motor);
        let of = |angle: &dyn Fn(&[RotorWindow]) -> f64| -> Vec<Vec<f64>> {
            let speed = |window: &Window| angle(&window.rotors) / window.axial.duration * unit;
            self.members.iter().map(|(_, windows)| windows[after..].iter().map(speed).collect()).collect()
        };
        [of(&|rotors| 0.5 * (rotors[motor].angle + rotors[above].angle)), of(&|rotors| rotors[above].angle)]
    }

    fn judge(&mut self, settings: &OperatingSettings) {
        let speeds: Vec<_> = (0..self.motors.len()).map(|motor| self.speeds(motor)).collect();
        let mean = |windows: &[Vec<f64>]| {
            let count = windows.len() * windows[0].len();
            windows.iter().flatten().sum::<f64>() / count as f64
        };
        let unloaded = self.motors.iter().zip(&speeds).filter(|(motor, _)| motor.is_unloaded());
        let scale = unloaded.map(|(motor, [speeds, _])| {
            // A motor without twist moves only if a load makes it creep.
            let creep = motor.system.dimensionless().friction() * motor.system.scales().angular_speed;
            mean(speeds).abs().max(0.01 * motor.fastest.angular_speed.max(creep))
        });
        self.wanted = settings.relative_error * scale.fold(0.0, f64::max);
        self.shortfalls = (0..self.asked)
            .map(|motor| {
                let [middle, above] = &speeds[motor];
                self.undecided(motor, middle)
                    .or_else(|| shortfall(middle, above, self.wanted))
                    .or_else(|| self.unbalanced(motor))
            })
            .collect();
    }

    /// By how much (rad/s) the speed depends on the start, of a motor whose stator has kinks. Between two kinks such a
    /// stator may carry a whole family of motions, each of which keeps a speed of its own.
    fn apart(&self, motor: usize, speeds: &[Vec<f64>]) -> f64 {
        let driven = self.motors[motor].stator.driven();
        let has_kinks = driven.is_some_and(|system| system.height().kinks().next().is_some());
        if has_kinks { decided_by_start(speeds).unwrap_or(0.0) } else { 0.0 }
    }

    /// A dependence on the start that is larger than the requested error.
    fn undecided(&self, motor: usize, speeds: &[Vec<f64>]) -> Option<Shortfall> {
        let spread = self.apart(motor, speeds);
        let means: Vec<f64> = speeds.iter().map(|windows| mean(windows)).collect();
        let standard_error = error_of_mean(&means);
        (standard_error + spread / NORMAL_975 > self.wanted && spread > 0.0)
            .then_some(Shortfall::Start { spread, standard_error })
    }

    /// The energy that the disk still stores, if it is too large a part of the supplied energy. For a disk
    /// that settles this part falls as one over the time for which it is followed.
    fn unbalanced(&self, motor: usize) -> Option<Shortfall> {
        let units = Units::of(&self.motors[motor]);
        let sum = self.total(motor, left_out(self.windows())..self.windows());
        let stored = sum.axial.energy_change * units.axial + sum.rotor.kinetic_change * units.rotary;
        let share = stored.abs() / sum.energy_scale(&units, &self.systems[motor], self.members.len());
        let time = sum.axial.duration;
        let input = sum.axial.normal_work * units.axial + sum.rotor.friction_work * units.rotary;
        (share > STORED_SHARE)
            .then_some(Shortfall::PowerBalance { stored_power: stored / time, input_power: input / time })
    }

    /// These windows of all members.
    fn total(&self, rotor: usize, windows: std::ops::Range<usize>) -> Sum {
        let mut sum = Sum::default();
        for window in self.members.iter().flat_map(|(_, all)| &all[windows.clone()]) {
            sum.add(window, rotor);
        }
        sum
    }

    fn results(&self) -> Result<Vec<MotorResult>, Error> {
        (0..self.asked).map(|motor| self.result(motor)).collect()
    }

    /// The operating point of a motor, and the mean speeds (rad/s) of its two rotors in each member.
    fn result(&self, index: usize) -> Result<MotorResult, Error> {
        let motor = &self.motors[index];
        let units = Units::of(motor);
        let after = left_out(self.windows());
        let [below, above] = [index, self.rotor_from_above(index)].map(|rotor| {
            let member = |(_, windows): &(Member, Vec<Window>)| {
                let mut sum = Sum::default();
                windows[after..].iter().for_each(|window| sum.add(window, rotor));
                sum
            };
            self.members.iter().map(member).collect::<Vec<Sum>>()
        });
        let pairs = Pairs { below, above };
        let of = |value: &dyn Fn(&Sum) -> f64| pairs.of(value);
        let estimate = |value: &dyn Fn(&Sum) -> f64| pairs.estimate(value);
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
        let efficiency = pairs.ratio(&mechanical, &input).filter(|_| braked);
        let torque = |sum: &Sum| sum.stator().load_impulse / sum.axial.duration * units.torque;
        let load_torque = if motor.law() == 0.0 {
            Estimate { value: motor.load_torque, standard_error: 0.0 }
        } else {
            estimate(&torque)?
        };
        let stator = motor.yielding().filter(|system| system.yields()).map(|system| {
            // What no mode gives the disk a prescribed twist does.
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
                efficiency: pairs.ratio(&mechanical, &drive).filter(|_| braked),
            })
        });
        let starts = self
            .members
            .iter()
            .map(|(_, windows)| windows[..after].iter().map(|window| window.axial.duration).sum::<f64>());
        let whole = self.total(index, 0..self.windows());
        // The error also includes the spread between starts.
        let known = estimate(&speed)?;
        let apart = self.apart(index, &self.speeds(index)[0]);
        let point = OperatingPoint {
            load_torque: load_torque.value,
            load_torque_error: load_torque.standard_error,
            speed: known.bounded_by(Estimate { value: known.value + apart, ..known }),
            mechanical_power,
            input_power: estimate(&input)?,
            restitution_loss: estimate(&restitution)?,
            friction_loss: estimate(&friction)?,
            efficiency,
            perturbation_power: estimate(&perturbation)?.value,
            energy_residual: whole.energy_residual(&units, &self.systems[index], self.members.len()),
            averaged_time: pairs.below.iter().map(|sum| sum.axial.duration).sum::<f64>() * units.time,
            start_up: starts.sum::<f64>() / self.members.len() as f64 * units.time,
            impacts: pairs.below.iter().map(|sum| sum.axial.impacts).sum(),
            stator: stator.transpose()?,
        };
        let operation = match self.shortfalls[index] {
            None => Operation::Steady(point),
            Some(shortfall) => Operation::Unsettled(point, shortfall),
        };
        let [middle, above] = of(&speed);
        Ok((operation, middle, above))
    }
}

/// The sums of each member, of its rotors from far below and from far above.
struct Pairs {
    below: Vec<Sum>,
    above: Vec<Sum>,
}

impl Pairs {
    /// Of each member in the middle of its two rotors, and of that from above.
    fn of(&self, value: &dyn Fn(&Sum) -> f64) -> [Vec<f64>; 2] {
        let middles =
            self.below.iter().zip(&self.above).map(|(one, other)| 0.5 * (value(one) + value(other)));
        [middles.collect(), self.above.iter().map(value).collect()]
    }

    fn estimate(&self, value: &dyn Fn(&Sum) -> f64) -> Result<Estimate, Error> {
        let [middle, above] = self.of(value);
        Ok(Estimate::of(&middle)?.bounded_by(Estimate::of(&above)?))
    }

    fn ratio(&self, dividend: &dyn Fn(&Sum) -> f64, divisor: &dyn Fn(&Sum) -> f64) -> Option<Estimate> {
        let (work, put_in) = (self.of(dividend), self.of(divisor));
        let ratio = |start: usize| Estimate::of_ratio(&work[start], &put_in[start]);
        ratio(0).zip(ratio(1)).map(|(middle, above)| middle.bounded_by(above))
    }
}

/// SI units of what the windows hold.
struct Units {
    time: f64,
    length: f64,
    speed: f64,
    /// m g a_e (N m).
    torque: f64,
    /// Power (W) for one unit of axial, and of rotary energy in a radian.
    axial: f64,
    rotary: f64,
}

impl Units {
    fn of(motor: &LoadedMotor<'_>) -> Self {
        let Scales { time, length, angular_speed, axial_energy, rotary_energy, .. } = motor.system.scales();
        Self {
            time,
            length,
            speed: angular_speed,
            torque: motor.mass
                * motor.system.disk().preload_acceleration()
                * motor.system.disk().contact_radius(),
            axial: motor.mass * axial_energy / time,
            rotary: motor.mass * rotary_energy / time,
        }
    }
}

/// Windows of one member, or of all, added up.
#[derive(Debug, Default)]
struct Sum {
    axial: AxialWindow,
    rotor: RotorWindow,
}

impl Sum {
    fn add(&mut self, window: &Window, rotor: usize) {
        let rotor = &window.rotors[rotor];
        self.axial.add(rotor.stator.as_ref().map_or(&window.axial, |(_, own)| own));
        self.rotor.add(rotor);
    }

    /// The energies of a stator that yields.
    fn stator(&self) -> StatorLedger {
        self.rotor.stator.map(|(ledger, _)| ledger).unwrap_or_default()
    }

    /// The energy that came in; where less came in than the disks of all members have at their start, that:
    /// there are only roundings then.
    fn energy_scale(&self, units: &Units, system: &DimensionlessSystem, members: usize) -> f64 {
        let axial = self.axial.normal_work + self.axial.perturbation_work;
        // A load that drives the motor puts energy in, too, and so does a rotor that slows down.
        let rotor = &self.rotor;
        let rotary = rotor.friction_work.abs().max(rotor.load_work.abs()).max(rotor.friction_loss);
        let put_in = axial.abs() * units.axial + rotary * units.rotary;
        let (peak, twist) = (system.peak_acceleration(), far_above(system).max(system.twist_speed()));
        let moving = 0.5 * peak * peak * units.axial + 0.5 * twist * twist * units.rotary;
        put_in.max(members as f64 * moving)
    }

    /// The residual of the energy balance, relative to the supplied energy.
    fn energy_residual(&self, units: &Units, system: &DimensionlessSystem, members: usize) -> f64 {
        let axial = self.axial.normal_work + self.axial.perturbation_work;
        let axial_left = axial - self.axial.restitution_loss - self.axial.energy_change;
        let rotor = &self.rotor;
        let rotary_left = rotor.friction_work - rotor.friction_loss - rotor.load_work - rotor.kinetic_change;
        let stator_left = self.stator().closure() * units.axial;
        let left = (axial_left * units.axial).abs() + (rotary_left * units.rotary).abs() + stator_left.abs();
        // The modes of a heavy stator hold much more than the disk.
        let modes = self.stator();
        let scale = self.energy_scale(units, system, members) + modes.drive_work.abs() * units.axial;
        if scale > 0.0 { left / scale } else { left }
    }
}

#[cfg(test)]
mod tests;
