//! An ensemble of vertical motions that runs until the speeds of all rotors are known well enough.
//!
//! If recording a vertical motion takes longer than replaying it, the inertia of slow rotors is reduced. They
//! then rise in 0.3 P/e periods, or in 0.02 P/e for rigid impacts on a compliant stator. Here e is the
//! requested error, at most 1 %, and P the platform's largest speed, at the largest held amplitude. The
//! standard deviation of the speed is scaled back by the root of the inertia; on a cycle each rotor moves at
//! its own inertia. Members on a compliant stator are split at the largest ratio of neighbouring amplitudes.
//! They are split only if these amplitudes differ by more than the requested error and by five times the part
//! that scatter in time explains, and if no group drifts.
//!
//! A rotor whose speed changes little in a flight has nearly the same mean speed at any inertia, but needs a
//! run of several time constants. A third rotor with half of the reduced inertia shows the effect of the
//! reduction. The difference over 1.96 is added to the error; if the difference exceeds 0.6 of the requested
//! error, the run restarts with four times the inertia.
//!
//! A stator with piecewise linear motion can carry a family of vertical motions, each with its own phase and
//! speed. More than six cycles count as a family, which is reported as its mean with `Shortfall::Start`; the
//! largest difference from the mean, over 1.96, is part of the error. Kicks at upward kinks are perturbed
//! like separations.

use std::f64::consts::TAU;

use bouncing_disk_core::Observer;
use bouncing_disk_core::run::{Watch, in_parallel};

use self::rows::results_of;
use crate::error::{Error, check, finite, positive, within_limit};
use crate::motor::batch::members::starting_phase;
use crate::motor::batch::shared_orbit::shared_by;
use crate::motor::operation::crossing::unstable_speed;
use crate::motor::operation::loaded_motor::LoadedMotor;
use crate::motor::operation::member::{LONGEST_DECAY, Member, Starts, far_above};
use crate::motor::operation::point::{AxialMotion, OperatingRow, Operation, Shortfall};
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::operation::settling::left_out;
use crate::motor::operation::survey::{Lived, Survey};
use crate::motor::stator::Stator;
use crate::motor::tape::cycle::Cycle;
use crate::motor::tape::left::Left;
use crate::motor::tape::recurrence::Key;
use crate::motor::tape::source::Source;
use crate::motor::tape::window::{RotorWindow, Window};
use crate::parameters::dimensionless::DimensionlessSystem;
use crate::parameters::system::System;
use crate::stator::StatorSystem;

/// Number of windows in the first round, and in the time in which friction can accelerate a rotor to the
/// platform's largest speed.
const FIRST_WINDOWS: usize = 12;
const WINDOWS_OF_RISE: f64 = 2.0;

/// The least length of a window relative to the time in which an amplitude of the stator falls by a factor e.
const WINDOW_OF_DECAY: f64 = 0.75;

/// Factor by which this length is reduced for a stator whose members all start at held amplitudes.
const HELD_SHARE: f64 = 0.3;

/// A slow rotor has less inertia than its motor, so that its rise takes at most this number times P/e
/// periods. P is the platform's largest speed, which sets the length of flights; e is the requested error,
/// but at most `LOOSE`. The error of the speed is then a third of the requested one.
const PERIODS_OF_RISE: f64 = 0.3;

/// The same for rigid impacts on a compliant stator, whose long flights take longest to record; if the error
/// of the speed is then too large, the inertia is increased.
const QUICK_SHARE: f64 = 0.02;
const LOOSE: f64 = 0.01;

/// The length of the shortest run, and the factor by which the inertia of its rotors is increased.
const SHORTEST: (f64, f64) = (1.0, 1.0);

/// A run whose rotors have too little inertia begins again with this many times the inertia.
const SLOWER: f64 = 4.0;

/// Largest factor by which the inertia is reduced.
const QUICKEST: f64 = 1.0e6;

/// If there are more windows than this, pairs of windows are merged.
const MOST_WINDOWS: usize = 128;

/// Largest number of rotors of all members of one ensemble together. With their windows, including those of a
/// second start of each rotor, they fill half a gigabyte.
pub const MAX_OPERATED_ROTORS: usize = 1 << 16;

/// Fewest impacts of a window, and fewest periods of the platform.
const LEAST_IMPACTS: u64 = 50;
const LEAST_PERIODS: f64 = 10.0;

/// A round is at most this many times as long as all previous rounds together, whatever the estimate.
const GROWTH: f64 = 3.0;

/// Factor by which the estimated number of windows is increased, so that a further round is seldom needed.
const MARGIN: f64 = 1.15;

/// Number of members that run first. The others may join the cycles that these reach.
const PILOTS: usize = 2;

/// New members replace members that repeat, until this many times the number in the settings have begun.
const MOST_STARTS: usize = 3;

/// More cycles than this on a stator with kinks form a family, in which each start keeps its own cycle.
const MOST_CYCLES: usize = 6;

/// Number of windows that each member omits as its start-up if the motions of some members end.
const START_UP: usize = FIRST_WINDOWS / 2;

/// Fewest windows per member from which an irregular motion is reported.
const LEAST_WINDOWS: usize = 4;

/// The mean speeds of all rotors and members, and the operations that follow from them.
#[derive(Debug)]
pub(crate) struct Operations {
    /// The rows in the order of the motors.
    pub(crate) rows: Vec<OperatingRow>,
    /// `speeds[rotor][member]`, mean angular speeds (rad/s) of the first branch after the start-up, averaged
    /// over the rotors from far below and from far above; empty for a runaway.
    pub(crate) speeds: Vec<Vec<f64>>,
    /// The same for rotors from far above; for a cycle, with coarser steps. The difference bounds the error
    /// due to the start-up and the steps.
    pub(crate) speeds_from_above: Vec<Vec<f64>>,
    /// How long each member was followed, in units of the shortest run, and the factor by which the inertia
    /// was increased relative to the first run.
    pub(crate) length: (f64, f64),
}

/// The steady operation of motors that share one vertical motion. The errors are relative to the largest
/// speed of the unloaded motors; if all motors are loaded, the first motor is also computed without its load.
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
) -> Result<Vec<OperatingRow>, Error> {
    check(!load_torques.is_empty(), "number of loads", 0.0, "[1, 1000000]")?;
    let motors = load_torques
        .iter()
        .map(|&torque| motor.with_load(finite("load_torque", torque)?))
        .collect::<Result<Vec<_>, Error>>()?;
    Ok(operate(&motors, settings, observer)?.rows)
}

/// The final states of the members of an ensemble of one motor (SI).
pub(crate) type Ends = Vec<Left>;

/// The steady operation of a motor, starting from the final state of another motor, and the final state
/// reached; `None` for a runaway or a rigid stator.
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
/// known; the settings may have fewer members than are otherwise legal.
pub(crate) fn operate_for(
    length: Option<(f64, f64)>,
    motors: &[LoadedMotor<'_>],
    settings: &OperatingSettings,
    observer: &dyn Observer,
) -> Result<Operations, Error> {
    Ok(operate_from(length, motors, None, settings, observer)?.0)
}

fn operate_from(
    length: Option<(f64, f64)>,
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
    let survey;
    let mut carried: Vec<LoadedMotor<'_>> =
        motors.iter().copied().filter(|motor| !motor.runs_away()).collect();
    let asked = carried.len();
    let bare = motors[0].stator.without_law()?;
    if !carried.iter().any(LoadedMotor::is_unloaded) {
        let system = first.with_disk(|disk| disk.load_acceleration = 0.0)?;
        carried.push(LoadedMotor { system, stator: &bare, load_torque: 0.0, ..motors[0] });
    }

    let mut results = Operations {
        rows: Vec::new(),
        speeds: Vec::new(),
        speeds_from_above: Vec::new(),
        length: length.unwrap_or(SHORTEST),
    };
    let (mut ends, mut known) = (None, Vec::new());
    let (is_timed, length_of_all) = (length.is_some(), length.unwrap_or(SHORTEST).0);
    if asked > 0 {
        let watch = Watch::begin(observer, 0, settings.most_impacts)?;
        survey =
            if carried[0].surveyed.is_some() { None } else { carried[0].survey(settings.seed, &watch)? };
        carried.iter_mut().for_each(|motor| motor.surveyed = motor.surveyed.or(survey.as_ref()));
        let run = |motors: Vec<LoadedMotor<'_>>, asked: usize, reference: Option<f64>| {
            let (length, mut slower) = length.unwrap_or(SHORTEST);
            let (parts, first) = loop {
                let mut run =
                    SteadyRun::new((length, slower), motors.clone(), asked, from, settings, &watch)?;
                run.reference = reference;
                let first = run.duration;
                if is_timed {
                    run.extend(FIRST_WINDOWS, &watch)?;
                    break (vec![run], first);
                }
                let parts = run.settle(&watch)?;
                if !parts.iter().any(SteadyRun::is_too_quick) {
                    break (parts, first);
                }
                slower *= SLOWER;
            };
            let longest =
                parts.iter().map(|run| run.duration / first * run.windows() as f64).fold(0.0, f64::max);
            let longer = longest / FIRST_WINDOWS as f64;
            let scale = parts[0].reference.unwrap_or_else(|| parts[0].scale());
            Ok::<_, Error>((results_of(&parts)?, (longer, slower), ends_of(&parts), scale))
        };
        if motors[0].stator.acts_back() {
            // Each has its own motion. The errors are relative to the speed of the first one without load.
            let unloaded = carried.iter().position(LoadedMotor::is_unloaded).unwrap_or(0);
            let (of_unloaded, longer, left, scale) = run(vec![carried[unloaded]], 1, None)?;
            results.length = (length_of_all * longer.0, longer.1);
            let others: Vec<usize> = (0..asked).filter(|index| *index != unloaded).collect();
            let all = in_parallel(others.len(), |index| run(vec![carried[others[index]]], 1, Some(scale)));
            let mut found: Vec<Option<MotorResult>> = (0..asked).map(|_| None).collect();
            ends = left.filter(|_| unloaded < asked);
            for (index, one) in others.into_iter().zip(all) {
                let (one, longer, left, _) = one?;
                let longer = (length_of_all * longer.0, longer.1);
                results.length = (results.length.0.max(longer.0), results.length.1.max(longer.1));
                ends = ends.or(left);
                found[index] = one.into_iter().next();
            }
            if unloaded < asked {
                found[unloaded] = of_unloaded.into_iter().next();
            }
            known = found.into_iter().flatten().collect();
        } else {
            let (found, longer, left, _) = run(carried, asked, None)?;
            results.length = (length_of_all * longer.0, longer.1);
            (known, ends) = (found, left);
        }
        watch.end();
    }
    let mut known = known.into_iter();
    for motor in motors {
        // Each motor that does not run away has a result.
        let (mut row, speeds, above) =
            if motor.runs_away() { None } else { known.next() }.unwrap_or_else(|| {
                let branches = vec![motor.runaway()];
                (OperatingRow { branches }, Vec::new(), Vec::new())
            });
        add_unstable_speed(motor, &mut row, settings, observer)?;
        results.rows.push(row);
        results.speeds.push(speeds);
        results.speeds_from_above.push(above);
    }
    Ok((results, ends))
}

/// If a row contains two irregular motions, of rotors from below and from above that stay apart, adds the
/// unstable speed between them.
fn add_unstable_speed(
    motor: &LoadedMotor<'_>,
    row: &mut OperatingRow,
    settings: &OperatingSettings,
    observer: &dyn Observer,
) -> Result<(), Error> {
    let points = row.branches.iter_mut().filter_map(Operation::point_mut);
    let mut irregular: Vec<_> =
        points.filter(|point| matches!(point.motion, AxialMotion::Irregular { .. })).collect();
    irregular.sort_by(|one, other| one.speed.value.total_cmp(&other.speed.value));
    if let [slow, fast] = &mut irregular[..]
        && !motor.law().is_finite()
    {
        let speeds = [slow.speed.value, fast.speed.value];
        let between = unstable_speed(motor, speeds, settings, observer)?;
        (slow.unstable_speed, fast.unstable_speed) = (between, between);
    }
    Ok(())
}

/// The operations of a motor, and the members' speeds in the first operation, as in [`Operations`].
type MotorResult = (OperatingRow, Vec<f64>, Vec<f64>);

/// The number of members that reached an operation from rest, the operation, and the mean speeds (rad/s) of
/// the two rotors in each member.
type Branch = (usize, Operation, [Vec<f64>; 2]);

/// A motion that repeats, and the rotors that repeat with it.
struct Repeated {
    cycle: Cycle,
    /// The motion of all rotors of a member in the cycle, with fine and with coarse steps.
    windows: [Window; 2],
    /// Number of members started from rest that reached this motion.
    from_rest: usize,
}

/// A member and its windows.
struct Carried {
    index: usize,
    member: Member,
    /// Number of starts from rest that the member represents.
    from_rest: usize,
    windows: Vec<Window>,
}

/// An ensemble under way.
struct SteadyRun<'a> {
    motors: Vec<LoadedMotor<'a>>,
    /// The [`LoadedMotor::dimensionless`] of each motor.
    systems: Vec<DimensionlessSystem>,
    /// Number of motors that the caller requested: each of these has two rotors, which start far below and
    /// far above all steady speeds.
    asked: usize,
    members: Vec<Carried>,
    repeated: Vec<Repeated>,
    /// The windows, after the start-up, of irregular motions that have ended.
    ended_windows: Vec<Vec<Window>>,
    /// How long irregular motions lasted before they ended, including those of a survey.
    life: Lived,
    /// The final states of the first members that repeat.
    left: Vec<(usize, Left)>,
    /// Number of members begun so far, and its limit.
    begun: usize,
    most_begun: usize,
    stators: Vec<Stator>,
    /// Held amplitudes at which members start.
    held: Starts,
    /// Factor by which each rotor has less inertia than its motor.
    quicker: Vec<f64>,
    settings: OperatingSettings,
    /// Duration of a window (rad), and its smallest number of impacts.
    duration: f64,
    least_impacts: u64,
    /// Largest number of impacts of a window.
    most_impacts: u64,
    /// The speed (rad/s) to which errors are relative, if it is already known.
    reference: Option<f64>,
    /// The shortfall of each rotor, and its requested error (rad/s).
    shortfalls: Vec<Option<Shortfall>>,
    wanted: Vec<f64>,
}

impl<'a> SteadyRun<'a> {
    fn new(
        (length, slower): (f64, f64),
        motors: Vec<LoadedMotor<'a>>,
        asked: usize,
        from: Option<&Ends>,
        settings: &OperatingSettings,
        watch: &Watch<'_>,
    ) -> Result<Self, Error> {
        let systems = motors.iter().map(LoadedMotor::dimensionless).collect::<Result<Vec<_>, Error>>()?;
        let stators = motors.iter().map(|motor| motor.stator.for_motor(&motor.system));
        let stators = stators.collect::<Result<Vec<_>, Error>>()?;
        let rise = |system: &DimensionlessSystem| {
            if system.friction() > 0.0 { system.twist_speed() / system.friction() } else { 0.0 }
        };
        let held = match from {
            None => Starts::new(&stators[0], settings, &mut watch.work())?,
            Some(_) => Starts::default(),
        };
        // The amplitude of a compliant stator settles within the windows that are omitted first.
        let decay = motors[0].stator.yielded().map_or(0.0, StatorSystem::decay_time);
        let settles = WINDOW_OF_DECAY * if decay > LONGEST_DECAY { HELD_SHARE * decay } else { decay };
        // A slow rotor needs less time if it has less inertia, which hardly affects its speed. Rigid impacts
        // on a sine take no longer to record than to replay.
        let peak = held.largest().unwrap_or_else(|| systems[0].peak_acceleration()).max(1.0);
        let share =
            if stators[0].yields() && !stators[0].takes_time() { QUICK_SHARE } else { PERIODS_OF_RISE };
        let longest = slower * TAU * share * peak / settings.relative_error.min(LOOSE);
        let longest = longest.max(WINDOWS_OF_RISE * settles);
        let takes_long = stators[0].takes_long();
        let less = |system| if takes_long { (rise(system) / longest).clamp(1.0, QUICKEST) } else { 1.0 };
        let quicker: Vec<f64> = systems.iter().map(less).collect();
        // The time (rad) in which friction can accelerate the slowest rotor to the platform's largest speed.
        let rises = systems.iter().zip(&quicker).map(|(system, quicker)| rise(system) / quicker);
        let rise = rises.fold(0.0, f64::max);
        let duration = length * (rise.min(f64::MAX) / WINDOWS_OF_RISE).max(LEAST_PERIODS * TAU).max(settles);
        // Even if the rise takes for ever, the first round stays within its allowance.
        let most_impacts = (settings.most_impacts / (settings.members * FIRST_WINDOWS) as u64).max(1);
        let least_impacts = ((length * LEAST_IMPACTS as f64) as u64).min(most_impacts);
        let survey = motors[0].surveyed;
        let most_begun = match (survey, from) {
            (Some(Survey { irregular: Some(irregular), .. }), _) => {
                irregular.len().min(MOST_STARTS * settings.members)
            }
            (_, Some(_)) => settings.members,
            (_, None) => MOST_STARTS * settings.members,
        };
        let shortfalls = vec![None; asked];
        let life = survey.map_or_else(Lived::default, |survey| survey.life);
        let mut run = Self {
            motors,
            systems,
            asked,
            members: Vec::new(),
            repeated: Vec::new(),
            ended_windows: Vec::new(),
            life,
            left: Vec::new(),
            begun: 0,
            most_begun,
            stators,
            held,
            quicker,
            settings: *settings,
            duration,
            least_impacts,
            most_impacts,
            reference: None,
            shortfalls,
            wanted: vec![0.0; asked],
        };
        for surveyed in survey.into_iter().flat_map(|survey| &survey.cycles) {
            let member = run.member(0, Some(&surveyed.source))?.on(surveyed.repeats);
            let from_rest = surveyed.from_rest;
            run.members.push(Carried { index: settings.members, member, from_rest, windows: Vec::new() });
        }
        while run.begun < settings.members.min(run.most_begun) {
            let begins = run.begin()?;
            run.members.push(begins);
        }
        let scales = run.motors[0].system.scales();
        for (own, left) in run.members.iter_mut().zip(from.into_iter().flatten()) {
            let left = left.scaled(&scales, f64::recip);
            own.member.go_on_from((left.time, left.state))?;
        }
        Ok(run)
    }

    /// The next member.
    fn begin(&mut self) -> Result<Carried, Error> {
        let index = self.begun;
        self.begun += 1;
        let survey = self.motors[0].surveyed;
        let known =
            survey.and_then(|survey| survey.irregular.as_ref().map(|all| (&all[index], survey.from_rest)));
        let from_rest = match known {
            Some((_, from_rest)) if index == 0 => from_rest,
            Some(_) => 0,
            None => usize::from(index < self.settings.members && self.held.is_from_rest(index)),
        };
        let from = known.map(|(source, _)| source);
        let member = self.member(index, from)?;
        Ok(Carried { index, member, from_rest, windows: Vec::new() })
    }

    fn member(&self, index: usize, from: Option<&Source>) -> Result<Member, Error> {
        let mut member = Member::new(
            &self.systems,
            &self.stators,
            self.asked,
            index,
            &self.quicker,
            from,
            &self.settings,
        )?;
        if let Some(start) =
            self.held.of(index, starting_phase(self.settings.seed, index, self.settings.members)?)
        {
            member.set_off(start)?;
        }
        Ok(member)
    }

    /// Number of windows per member so far; 0 if no motion is irregular.
    fn windows(&self) -> usize {
        self.members.first().map_or(0, |own| own.windows.len())
    }

    /// The windows of irregular motions after their start-up, for each member. If some motions have ended,
    /// all windows one after the other, divided into as many groups as there are members; empty if there are
    /// too few windows.
    fn averaged(&self) -> Vec<Vec<&Window>> {
        if self.ended_windows.is_empty() {
            let after = left_out(self.windows());
            return self.members.iter().map(|own| own.windows[after..].iter().collect()).collect();
        }
        let going = self.members.iter().flat_map(|own| own.windows.iter().skip(START_UP));
        let all: Vec<&Window> = self.ended_windows.iter().flatten().chain(going).collect();
        let each = all.len() / self.settings.members;
        if each < LEAST_WINDOWS { Vec::new() } else { all.chunks_exact(each).map(<[_]>::to_vec).collect() }
    }

    /// Follows the members until the speeds are known; if members keep separate amplitudes, each group
    /// continues alone.
    fn settle(mut self, watch: &Watch<'_>) -> Result<Vec<Self>, Error> {
        let groups = self.compute(watch)?;
        if groups.len() < 2 {
            return Ok(vec![self]);
        }
        let reference = Some(self.reference.unwrap_or_else(|| self.scale()));
        let mut members: Vec<Option<Carried>> =
            std::mem::take(&mut self.members).into_iter().map(Some).collect();
        let all = members.len() as u64;
        let mut parts = Vec::new();
        for group in groups {
            let count = group.len();
            let own: Vec<Carried> = group.into_iter().filter_map(|index| members[index].take()).collect();
            let most_impacts = self.settings.most_impacts / all * count as u64;
            let part = Self {
                members: own,
                settings: OperatingSettings { members: count, most_impacts, ..self.settings },
                repeated: if parts.is_empty() { std::mem::take(&mut self.repeated) } else { Vec::new() },
                left: if parts.is_empty() { std::mem::take(&mut self.left) } else { Vec::new() },
                ended_windows: Vec::new(),
                motors: self.motors.clone(),
                systems: self.systems.clone(),
                stators: self.stators.clone(),
                quicker: self.quicker.clone(),
                shortfalls: self.shortfalls.clone(),
                wanted: self.wanted.clone(),
                held: self.held.clone(),
                most_begun: self.begun,
                reference,
                ..self
            };
            parts.extend(part.settle(watch)?);
        }
        Ok(parts)
    }

    /// Follows the members until the speeds are known, or until they are seen to keep separate amplitudes;
    /// returns the indices of the members at each amplitude.
    fn compute(&mut self, watch: &Watch<'_>) -> Result<Vec<Vec<usize>>, Error> {
        let mut target = FIRST_WINDOWS;
        loop {
            self.extend(target, watch)?;
            self.judge();
            let groups = self.groups();
            if groups.len() > 1 {
                return Ok(groups);
            }
            if self.members.is_empty() || self.knows_first() {
                return Ok(Vec::new());
            }
            let lacking = self.shortfalls.iter().flatten();
            let Some(factor) = lacking.map(|shortfall| self.hoped_for(shortfall)).reduce(f64::max) else {
                return Ok(Vec::new());
            };
            let windows = self.windows();
            let grown = (windows as f64 * factor.min(GROWTH)).ceil() as usize;
            target = grown.max(windows + 1);
            // Whether the remaining impacts suffice.
            let spent = self.spent();
            let left = self.settings.most_impacts.saturating_sub(spent);
            let each = spent.max(1) as f64 / windows as f64;
            let affordable = windows.saturating_add((left as f64 / each) as usize);
            if affordable <= windows {
                return Ok(Vec::new());
            }
            target = target.min(affordable);
            if target > MOST_WINDOWS && self.windows() >= 2 * FIRST_WINDOWS {
                self.merge();
                target = target.div_ceil(2).max(self.windows() + 1);
            }
        }
    }

    /// Extends all members to this number of windows. A member whose motion is found to repeat is replaced by
    /// a new one.
    fn extend(&mut self, target: usize, watch: &Watch<'_>) -> Result<(), Error> {
        if self.windows() == 0 && self.stators[0].yields() && self.members.len() > PILOTS {
            // The others stop early when they reach a cycle of the first ones.
            let others = self.members.split_off(PILOTS);
            self.extend_all(target, watch)?;
            self.take_repeated(watch)?;
            self.members.extend(others);
        }
        loop {
            let cycles: Vec<&[Key]> = self.repeated.iter().map(|known| known.cycle.touches()).collect();
            self.members.iter_mut().for_each(|own| own.member.know(&cycles));
            self.extend_all(target, watch)?;
            if !self.take_repeated(watch)? {
                return Ok(());
            }
        }
    }

    /// Removes the members that repeat; returns whether new members replaced them.
    fn take_repeated(&mut self, watch: &Watch<'_>) -> Result<bool, Error> {
        let mut begins = false;
        let largest: Vec<f64> = {
            let own: Vec<f64> = self.systems.iter().map(far_above).collect();
            let asked = if self.stators[0].acts_back() { 0 } else { self.asked };
            let again = if self.is_quicker() { asked } else { 0 };
            own.iter().chain(&own[..asked]).chain(&own[..again]).copied().collect()
        };
        let (mut kept, mut places) = (Vec::new(), 0);
        for mut own in std::mem::take(&mut self.members) {
            let Some(place) = self.place_of(&mut own.member, &largest, watch)? else {
                kept.push(own);
                continue;
            };
            let followed = own.member.followed();
            self.left.extend(own.member.left().map(|left| (own.index, left)));
            self.repeated[place].from_rest += own.from_rest;
            let mut windows = own.windows;
            // The last ones may be on the way to the cycle.
            let rates = self.repeated[place].windows[0].axial.rates();
            while windows.last().is_some_and(|window| window.axial.is_like(rates)) {
                windows.pop();
            }
            windows.pop();
            windows.drain(..windows.len().min(START_UP));
            // If no windows are left, it was on its way to the cycle from the start.
            if !windows.is_empty() {
                self.life.add(of_windows(&windows), true);
                self.ended_windows.push(windows);
            }
            // A cycle from the survey occupies no place.
            places += usize::from(followed > 0.0);
        }
        // If all reach one cycle, further starts give nothing new.
        let (several, irregular) = (self.repeated.len() > 1, !kept.is_empty() || self.life.ended > 0);
        if (several || irregular) && !self.knows_first() {
            let begin = places.min(self.most_begun - self.begun);
            for _ in 0..begin {
                kept.push(self.begin()?);
            }
            begins = begin > 0;
        }
        self.members = kept;
        Ok(begins)
    }

    /// The index of the cycle that a member repeats, if any; a cycle that is not yet known is added.
    fn place_of(
        &mut self,
        member: &mut Member,
        largest: &[f64],
        watch: &Watch<'_>,
    ) -> Result<Option<usize>, Error> {
        if let Some(known) = member.repeats().and_then(|repeats| repeats.known) {
            return Ok(Some(known));
        }
        let Some(cycle) = member.cycle(&mut watch.work())? else { return Ok(None) };
        if let Some(known) = self.repeated.iter().position(|known| known.cycle.is_same(&cycle)) {
            return Ok(Some(known));
        }
        // A disk that just touches the stator may touch it more or less often in the same motion.
        let windows = member.on_cycle(&cycle, largest);
        let alike = |known: &Repeated| known.windows[0].is_like(&windows[0], largest);
        let known = self.repeated.iter().position(alike).unwrap_or(self.repeated.len());
        if known == self.repeated.len() {
            self.repeated.push(Repeated { cycle, windows, from_rest: 0 });
        }
        Ok(Some(known))
    }

    /// Whether all required results are known because irregular motions end, so that most rotors from rest
    /// finally reach a cycle.
    fn knows_first(&self) -> bool {
        self.motors[0].first_only && self.life.ended > 0 && !self.repeated.is_empty()
    }

    /// The factor by which a run must be extended.
    fn hoped_for(&self, shortfall: &Shortfall) -> f64 {
        match *shortfall {
            Shortfall::Error { standard_error, wanted } => {
                let ratio = standard_error / wanted;
                MARGIN * ratio * ratio
            }
            Shortfall::Drift { .. } | Shortfall::Start { .. } | Shortfall::PowerBalance { .. } => 2.0,
        }
    }

    /// Number of impacts of all members.
    fn spent(&self) -> u64 {
        let windows = self.members.iter().map(|own| &own.windows).chain(&self.ended_windows);
        windows.flatten().map(|window| window.axial.impacts).sum()
    }

    fn extend_all(&mut self, target: usize, watch: &Watch<'_>) -> Result<(), Error> {
        let (duration, impacts) = (self.duration, self.least_impacts..=self.most_impacts);
        let extend_one = |own: &mut Carried| {
            let mut work = watch.work();
            while own.windows.len() < target && own.member.repeats().is_none() {
                let window = own.member.next_window(duration, impacts.clone(), &mut work)?;
                watch.finish(window.axial.impacts);
                if own.member.repeats().is_none() {
                    own.windows.push(window);
                }
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

    /// Merges pairs of windows.
    fn merge(&mut self) {
        let going = self.members.iter_mut().map(|own| &mut own.windows);
        for windows in going.chain(&mut self.ended_windows) {
            let mut pairs = std::mem::take(windows).into_iter();
            while let Some(mut window) = pairs.next() {
                // An odd last one is not merged.
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

    /// Index of a motor's rotor that started from far above, or of the only rotor of a motor that the caller
    /// did not request.
    fn rotor_from_above(&self, motor: usize) -> usize {
        let bracketed = motor < self.asked && !self.stators[0].acts_back();
        if bracketed { self.motors.len() + motor } else { motor }
    }

    /// Mean speeds (rad/s) of each member in the windows after the start-up: averaged over a motor's two
    /// rotors, and for the rotor from far above.
    fn speeds(&self, motor: usize) -> [Vec<Vec<f64>>; 2] {
        let unit = self.motors[motor].system.scales().angular_speed;
        let above = self.rotor_from_above(motor);
        let averaged = self.averaged();
        let of = |angle: &dyn Fn(&[RotorWindow]) -> f64| -> Vec<Vec<f64>> {
            let speed = |window: &&Window| angle(&window.rotors) / window.axial.duration * unit;
            averaged.iter().map(|windows| windows.iter().map(speed).collect()).collect()
        };
        [of(&|rotors| 0.5 * (rotors[motor].angle + rotors[above].angle)), of(&|rotors| rotors[above].angle)]
    }
}

/// The states of the members; `None` for a rigid stator.
fn ends_of(parts: &[SteadyRun<'_>]) -> Option<Ends> {
    let scales = parts[0].motors[0].system.scales();
    let of = |own: &Carried| own.member.left().map(|left| (own.index, left));
    let mut all: Vec<_> = parts.iter().flat_map(|run| &run.members).map(of).collect::<Option<_>>()?;
    all.extend(parts.iter().flat_map(|run| &run.left).copied());
    let members = parts.iter().map(|run| run.settings.members).sum();
    all.retain(|(index, _)| *index < members);
    all.sort_by_key(|(index, _)| *index);
    (!all.is_empty()).then(|| all.into_iter().map(|(_, left)| left.scaled(&scales, |unit| unit)).collect())
}

/// Total duration (rad) of windows.
fn of_windows(windows: &[Window]) -> f64 {
    windows.iter().map(|window| window.axial.duration).sum()
}

mod judgement;
mod rows;
#[cfg(test)]
mod tests;
