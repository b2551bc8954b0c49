//! An ensemble of vertical motions that runs until the speeds of all rotors are known well enough.

use std::f64::consts::TAU;

use bouncing_disk_core::Observer;
use bouncing_disk_core::numerics::statistics::{NORMAL_975, mean};
use bouncing_disk_core::run::{Watch, in_parallel};

use crate::error::{Error, check, finite, positive, within_limit};
use crate::motor::batch::members::starting_phase;
use crate::motor::batch::shared_orbit::shared_by;
use crate::motor::operation::averages::{Averages, Pairs, Sum, Units};
use crate::motor::operation::crossing::unstable_speed;
use crate::motor::operation::loaded_motor::LoadedMotor;
use crate::motor::operation::member::{LEAST_FOR_DECADE, LONGEST_DECAY, Member, Starts, far_above};
use crate::motor::operation::point::{
    AxialMotion, Estimate, Life, OperatingPoint, OperatingRow, Operation, Shortfall, StatorPoint,
    error_of_mean,
};
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::operation::settling::{decided_by_start, drift, left_out, shortfall};
use crate::motor::operation::survey::{Lived, Survey};
use crate::motor::stator::Stator;
use crate::motor::tape::cycle::Cycle;
use crate::motor::tape::left::Left;
use crate::motor::tape::source::Source;
use crate::motor::tape::taped::{error_of_steps, resolution};
use crate::motor::tape::window::{RotorWindow, Window};
use crate::parameters::dimensionless::DimensionlessSystem;
use crate::parameters::system::System;
use crate::stator::StatorSystem;

/// Windows of the first round, and windows in the time in which friction gives the platform's largest speed.
const FIRST_WINDOWS: usize = 12;
const WINDOWS_OF_RISE: f64 = 2.0;

/// The least length of a window, over the time in which an amplitude of the stator falls by a factor e.
const WINDOW_OF_DECAY: f64 = 0.75;

/// That of a stator whose members start on held amplitudes, as a share.
const HELD_SHARE: f64 = 0.3;

/// A slow rotor has less inertia than its motor, so that its rise takes no more periods than this, times the platform's
/// largest speed P (the length of flights), over the requested error or this one, whichever is smaller. The speed is then
/// off by a third of the requested error.
const PERIODS_OF_RISE: f64 = 0.3;

/// The same of rigid impacts on a stator that yields, whose long flights take longest to record: where the speed is then
/// off by too much, the rotors get more inertia.
const QUICK_SHARE: f64 = 0.02;
const LOOSE: f64 = 0.01;

/// The length of the shortest run, and the inertia of its rotors.
const SHORTEST: (f64, f64) = (1.0, 1.0);

/// If the speed of rotors with half their inertia differs by more than this share of the requested error, they get so
/// many times more.
const INERTIA_SHARE: f64 = 0.6;
const SLOWER: f64 = 4.0;

/// If the scatter is less than this share of the requested error, a longer run does not help: the rest is what the
/// perturbation changes.
const SCATTER_SHARE: f64 = 0.5;

/// Most times less.
const QUICKEST: f64 = 1.0e6;

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

/// Members begin, in place of others that repeat themselves, until there were so many times those of the settings.
const MOST_STARTS: usize = 3;

/// More cycles than this on a stator with kinks are a family: each start keeps its own.
const MOST_CYCLES: usize = 6;

/// Rotors from below and from above that are farther apart than so many requested errors stay so.
const PARTED: f64 = 8.0;

/// Windows that each of the members leaves out as its start-up if some end.
const START_UP: usize = FIRST_WINDOWS / 2;

/// Least windows for each member from which an irregular motion is stated.
const LEAST_WINDOWS: usize = 4;

/// Least members that keep an amplitude of their own.
const LEAST_OF_GROUP: usize = 2;

/// The shortfall of irregular motions that have no window yet.
const NOTHING_YET: Shortfall = Shortfall::Error { standard_error: f64::INFINITY, wanted: 1.0 };

/// A speed below this share of the stator's is that of rounding.
const LEAST_SPEED: f64 = 1.0e-12;

/// A motor whose disk stores more than this share of the power put in has not settled.
const STORED_SHARE: f64 = 0.05;

/// The mean speeds of all rotors and members, and the operations that follow from them.
#[derive(Debug)]
pub(crate) struct Operations {
    /// In the order of the motors.
    pub(crate) rows: Vec<OperatingRow>,
    /// `speeds[rotor][member]`, mean angular speeds (rad/s) of the first branch after the start-up, in the middle of
    /// those of rotors from far below and from far above; none for a runaway.
    pub(crate) speeds: Vec<Vec<f64>>,
    /// Those of rotors from far above, and in a cycle with coarser steps: the difference bounds the remainder of the
    /// start-up, and what steps do.
    pub(crate) speeds_from_above: Vec<Vec<f64>>,
    /// How long each member was followed, in units of the shortest run, and how many times more inertia than in the first
    /// run the rotors had.
    pub(crate) length: (f64, f64),
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
) -> Result<Vec<OperatingRow>, Error> {
    check(!load_torques.is_empty(), "number of loads", 0.0, "[1, 1000000]")?;
    let motors = load_torques
        .iter()
        .map(|&torque| motor.with_load(finite("load_torque", torque)?))
        .collect::<Result<Vec<_>, Error>>()?;
    Ok(operate(&motors, settings, observer)?.rows)
}

/// Where the members of an ensemble of one motor were left (SI).
pub(crate) type Ends = Vec<Left>;

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
        survey = if carried[0].surveyed.is_some() { None } else { carried[0].survey(&watch)? };
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
            // Each has a motion of its own. The errors are relative to the speed of the first one without load.
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

/// Gives two irregular motions of a row, of rotors from below and from above that stay apart, the speed between them.
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

/// The operations of a motor, and the speeds of the members of the first as in [`Operations`].
type MotorResult = (OperatingRow, Vec<f64>, Vec<f64>);

/// How many members came to an operation from rest, the operation, and the mean speeds (rad/s) of its two rotors in each
/// member.
type Branch = (usize, Operation, [Vec<f64>; 2]);

/// A motion that repeats itself, and the rotors that repeat with it.
struct Repeated {
    cycle: Cycle,
    /// What all rotors of a member do in it, with fine and with coarse steps.
    windows: [Window; 2],
    /// How many of the members that started from rest came to it.
    from_rest: usize,
}

/// A member and its windows.
struct Carried {
    index: usize,
    member: Member,
    /// How many starts from rest it stands for.
    from_rest: usize,
    windows: Vec<Window>,
}

/// An ensemble under way.
struct SteadyRun<'a> {
    motors: Vec<LoadedMotor<'a>>,
    /// Their [`LoadedMotor::dimensionless`].
    systems: Vec<DimensionlessSystem>,
    /// How many of them the caller requested: each of these is carried twice, from far below and from far
    /// above all steady speeds.
    asked: usize,
    members: Vec<Carried>,
    repeated: Vec<Repeated>,
    /// The windows of irregular motions that ended, without their start-up.
    ended_windows: Vec<Vec<Window>>,
    /// How long irregular motions lasted that ended, and all of a survey.
    life: Lived,
    /// Where those of the first members were left that repeat themselves.
    left: Vec<(usize, Left)>,
    /// Members begun so far, and the most.
    begun: usize,
    most_begun: usize,
    stators: Vec<Stator>,
    /// Held amplitudes, on which members start.
    held: Starts,
    /// How many times less inertia the rotors have than their motors.
    quicker: Vec<f64>,
    settings: OperatingSettings,
    /// Duration of a window (rad) and its least impacts.
    duration: f64,
    least_impacts: u64,
    /// Most impacts of a window.
    most_impacts: u64,
    /// The speed (rad/s) that errors are relative to, if it is known already.
    reference: Option<f64>,
    /// What each rotor still lacks, and the requested error (rad/s).
    shortfalls: Vec<Option<Shortfall>>,
    wanted: f64,
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
        // The amplitude of a stator that yields settles within the windows that are left out first.
        let decay = motors[0].stator.yielded().map_or(0.0, StatorSystem::decay_time);
        let settles = WINDOW_OF_DECAY * if decay > LONGEST_DECAY { HELD_SHARE * decay } else { decay };
        // A slow rotor needs less time with less inertia, which hardly matters. Rigid impacts on a sine take no longer to
        // record than to replay.
        let peak = held.largest().unwrap_or_else(|| systems[0].peak_acceleration()).max(1.0);
        let share =
            if stators[0].yields() && !stators[0].takes_time() { QUICK_SHARE } else { PERIODS_OF_RISE };
        let longest = slower * TAU * share * peak / settings.relative_error.min(LOOSE);
        let longest = longest.max(WINDOWS_OF_RISE * settles);
        let takes_long = stators[0].takes_long();
        let less = |system| if takes_long { (rise(system) / longest).clamp(1.0, QUICKEST) } else { 1.0 };
        let quicker: Vec<f64> = systems.iter().map(less).collect();
        // The time in which friction gives the platform's largest speed, in radians; that of the slowest
        // rotor.
        let rises = systems.iter().zip(&quicker).map(|(system, quicker)| rise(system) / quicker);
        let rise = rises.fold(0.0, f64::max);
        let duration = length * (rise.min(f64::MAX) / WINDOWS_OF_RISE).max(LEAST_PERIODS * TAU).max(settles);
        // Even where the rise takes for ever the first round spends no more than it may.
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
            wanted: 0.0,
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

    /// The next member that begins.
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

    /// Windows of a member so far; none if no motion is irregular.
    fn windows(&self) -> usize {
        self.members.first().map_or(0, |own| own.windows.len())
    }

    /// The windows of irregular motions after their start-up: those of each member, or, if some have ended, all of them
    /// one after the other in as many groups as there are members. None if they are too few.
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

    /// Follows the members until the speeds are known, and those that keep amplitudes of their own each alone from where
    /// this is seen.
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
                held: self.held.clone(),
                most_begun: self.begun,
                reference,
                ..self
            };
            parts.extend(part.settle(watch)?);
        }
        Ok(parts)
    }

    /// Follows the members until the speeds are known, or until they are seen to keep amplitudes of their own: the places
    /// of those on each.
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
            // Whether the impacts that are left are enough.
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

    /// Extends all members to so many windows. One whose motion is found to repeat itself gives its place to a member
    /// that begins.
    fn extend(&mut self, target: usize, watch: &Watch<'_>) -> Result<(), Error> {
        loop {
            self.extend_all(target, watch)?;
            if !self.take_repeated(watch)? {
                return Ok(());
            }
        }
    }

    /// Takes the members that repeat themselves out of those that are irregular; whether others took their places.
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
            let Some(cycle) = own.member.cycle(&mut watch.work())? else {
                kept.push(own);
                continue;
            };
            let followed = own.member.followed();
            self.left.extend(own.member.left().map(|left| (own.index, left)));
            let place = match self.repeated.iter().position(|known| known.cycle.is_same(&cycle)) {
                Some(known) => known,
                None => {
                    // A disk that just touches the stator does so more or less often in what is one motion all the same.
                    let windows = own.member.on_cycle(&cycle, &largest);
                    let alike = |known: &Repeated| known.windows[0].is_like(&windows[0], &largest);
                    let known = self.repeated.iter().position(alike).unwrap_or(self.repeated.len());
                    if known == self.repeated.len() {
                        self.repeated.push(Repeated { cycle, windows, from_rest: 0 });
                    }
                    known
                }
            };
            self.repeated[place].from_rest += own.from_rest;
            let mut windows = own.windows;
            // The last ones may be on the way to the cycle.
            let rates = self.repeated[place].windows[0].axial.rates();
            while windows.last().is_some_and(|window| window.axial.is_like(rates)) {
                windows.pop();
            }
            windows.pop();
            windows.drain(..windows.len().min(START_UP));
            // Without windows that are left it was on its way to the cycle from the start.
            if !windows.is_empty() {
                self.life.add(of_windows(&windows), true);
                self.ended_windows.push(windows);
            }
            // A cycle of the survey takes no place.
            places += usize::from(followed > 0.0);
        }
        // Where all come to one cycle further starts bring nothing new.
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

    /// Whether nothing more is wanted than is known: irregular motions end, so that a cycle is where most are from rest.
    fn knows_first(&self) -> bool {
        self.motors[0].first_only && self.life.ended > 0 && !self.repeated.is_empty()
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
        let windows = self.members.iter().map(|own| &own.windows).chain(&self.ended_windows);
        windows.flatten().map(|window| window.axial.impacts).sum()
    }

    fn extend_all(&mut self, target: usize, watch: &Watch<'_>) -> Result<(), Error> {
        let (duration, impacts) = (self.duration, self.least_impacts..=self.most_impacts);
        let extend_one = |own: &mut Carried| {
            let mut work = watch.work();
            while own.windows.len() < target && !own.member.repeats() {
                let window = own.member.next_window(duration, impacts.clone(), &mut work)?;
                watch.finish(window.axial.impacts);
                if !own.member.repeats() {
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

    /// Makes one window of two.
    fn merge(&mut self) {
        let going = self.members.iter_mut().map(|own| &mut own.windows);
        for windows in going.chain(&mut self.ended_windows) {
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
        let bracketed = motor < self.asked && !self.stators[0].acts_back();
        if bracketed { self.motors.len() + motor } else { motor }
    }

    /// Mean speeds (rad/s) in the windows after the start-up, of each member: in the middle of a motor's two
    /// rotors, and of the one from far above.
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

    /// The largest speed (rad/s) of the motors without load, to which errors are relative.
    fn scale(&self) -> f64 {
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

    fn judge(&mut self) {
        if self.averaged().is_empty() {
            self.shortfalls.fill((!self.members.is_empty()).then_some(NOTHING_YET));
            return;
        }
        self.wanted = self.settings.relative_error * self.reference.unwrap_or_else(|| self.scale());
        self.shortfalls = (0..self.asked)
            .map(|motor| {
                let [middle, above] = &self.speeds(motor);
                if self.is_parted(motor) {
                    return self.unbalanced(motor);
                }
                self.undecided(motor, middle)
                    .or_else(|| shortfall(middle, above, self.are_perturbed(), self.wanted))
                    .or_else(|| self.drifting_amplitude(motor, middle))
                    .or_else(|| self.inaccurate(motor))
                    .or_else(|| self.unbalanced(motor))
            })
            .collect();
    }

    /// Whether rotors from far below and from far above stay apart: under a load that falls with the speed both are where
    /// they remain, and no rotor passes from one to the other.
    fn is_parted(&self, motor: usize) -> bool {
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
        let settled = |speeds: &[Vec<f64>]| shortfall(speeds, speeds, are_perturbed, self.wanted).is_none();
        let of_all =
            |speeds: &[Vec<f64>]| mean(&speeds.iter().map(|windows| mean(windows)).collect::<Vec<_>>());
        settled(&below) && settled(&above) && of_all(&above) - of_all(&below) > PARTED * self.wanted
    }

    /// The amplitude of a stator that yields, if it still drifts, as the speed would drift that follows it.
    fn drifting_amplitude(&self, motor: usize, speeds: &[Vec<f64>]) -> Option<Shortfall> {
        let amplitudes = self.amplitudes(motor)?;
        let of_all = |all: &[Vec<f64>]| mean(&all.iter().map(|windows| mean(windows)).collect::<Vec<_>>());
        let known = of_all(&amplitudes);
        let (off, standard_error) = drift(&amplitudes, self.settings.relative_error * known)?;
        let [drift, standard_error] = [off, standard_error].map(|part| part / known * of_all(speeds));
        Some(Shortfall::Drift { drift, standard_error: standard_error.abs() })
    }

    /// The amplitude of a stator that yields in the windows after the start-up, of each member.
    fn amplitudes(&self, motor: usize) -> Option<Vec<Vec<f64>>> {
        let system = self.motors[motor].yielding().filter(|system| system.yields())?;
        let amplitude = |window: &&Window| {
            let (ledger, axial) = window.rotors[motor].stator.unwrap_or_default();
            system.amplitude(0, ledger.damping_loss[0], axial.duration)
        };
        Some(self.averaged().iter().map(|windows| windows.iter().map(amplitude).collect()).collect())
    }

    /// The members on each of the amplitudes that a stator keeps on irregular motions, and that do not drift; all of them
    /// where they have one. Those of a part that falls apart again do so later.
    fn groups(&self) -> Vec<Vec<usize>> {
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
        // What differs by less than is asked for is in the error.
        if ratio(&gap) < 1.0 + self.settings.relative_error {
            return Vec::new();
        }
        let is_settled = |group: &Vec<usize>| {
            let own: Vec<Vec<f64>> = group.iter().map(|index| amplitudes[*index].clone()).collect();
            group.len() >= LEAST_OF_GROUP && drift(&own, 0.0).is_none()
        };
        if groups.iter().all(is_settled) { groups } else { Vec::new() }
    }

    /// By how much (rad/s) the speed depends on the start, of a motor whose stator has kinks, or yields. Between two kinks
    /// a stator may carry a whole family of motions, each of which keeps a speed of its own; one that yields may keep two
    /// amplitudes, on each of which the motion is irregular.
    fn apart(&self, motor: usize, speeds: &[Vec<f64>]) -> f64 {
        if self.motors[motor].stator.has_kinks() || self.held.has_many() {
            decided_by_start(speeds).unwrap_or(0.0)
        } else {
            0.0
        }
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
        let sum = self.total(motor);
        let stored = sum.axial.energy_change * units.axial + sum.rotor.kinetic_change * units.rotary;
        let share = stored.abs() / sum.energy_scale(&units, &self.systems[motor], self.settings.members);
        // A disk that is thrown ever higher stores what the platform gives, however much the rotor takes.
        let given = sum.axial.normal_work.abs() + sum.axial.perturbation_work;
        let peak = self.systems[motor].peak_acceleration();
        let moving = 0.5 * self.settings.members as f64 * peak * peak;
        let share = share.max(sum.axial.energy_change.abs() / given.max(moving));
        let time = sum.axial.duration;
        let input = sum.axial.normal_work * units.axial + sum.rotor.friction_work * units.rotary;
        (share > STORED_SHARE)
            .then_some(Shortfall::PowerBalance { stored_power: stored / time, input_power: input / time })
    }

    /// All averaged windows.
    fn total(&self, rotor: usize) -> Sum {
        Sum::of(self.averaged().into_iter().flatten(), rotor)
    }

    /// The operations of a motor.
    fn branches(&self, index: usize) -> Result<Vec<Branch>, Error> {
        let mut branches = Vec::new();
        let scales = self.motors[index].system.scales();
        let speed = |sum: &Sum| sum.rotor.angle / sum.axial.duration * scales.angular_speed;
        let pairs = self.pairs(index);
        // From below and from above, if these stay apart.
        let is_parted = !pairs.below.is_empty() && self.is_parted(index);
        let from_above = self.rotor_from_above(index);
        let all = match (pairs.below.is_empty(), is_parted) {
            (true, _) => Vec::new(),
            (false, true) => vec![self.pairs_of([index; 2]), self.pairs_of([from_above; 2])],
            (false, false) => vec![pairs],
        };
        let beside = self.beside(index);
        for pairs in &all {
            let others = beside.filter(|_| !is_parted).map(|beside| self.pairs(beside));
            let others = others.as_ref().map(Averages::Members);
            let point = self.point(index, &Averages::Members(pairs), others.as_ref())?;
            let (standard_error, wanted) = (point.speed.standard_error, self.wanted);
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
            // What ends is not where most are in the end.
            let from_rest = if self.life.ended > 0 { 0 } else { from_rest };
            branches.push((from_rest, operation, pairs.of(&speed)));
        }
        // A rotor that the stator turns forwards from rest does not come to where rotors are driven back.
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

    /// The motor that differs least from this one in its constant load, and in nothing else; none where each has a vertical
    /// motion of its own.
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

    /// The time constant (s) of a motor's speed, from its change with the load.
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

    /// What a motor's rotor does in each cycle.
    fn cycles(&self, index: usize) -> Vec<Sum> {
        let of_cycle = |repeated: &Repeated| Sum::of(std::iter::once(&repeated.windows[0]), index);
        self.repeated.iter().map(of_cycle).collect()
    }

    /// The operation of a motor each start of which keeps a cycle of its own.
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

    /// The sums of a motor's two rotors in each member after the start-up.
    fn pairs(&self, index: usize) -> Pairs {
        let halved =
            (self.is_quicker() && index < self.asked).then(|| self.motors.len() + self.asked + index);
        Pairs {
            quickest: halved.map_or_else(Vec::new, |halved| self.pairs_of([halved; 2]).below),
            ..self.pairs_of([index, self.rotor_from_above(index)])
        }
    }

    /// The sums of two rotors in each member after the start-up.
    fn pairs_of(&self, rotors: [usize; 2]) -> Pairs {
        let averaged = self.averaged();
        let [below, above] = rotors.map(|rotor| -> Vec<Sum> {
            averaged.iter().map(|windows| Sum::of(windows.iter().copied(), rotor)).collect()
        });
        let quickest = Vec::new();
        let samples = |windows: &Vec<&Window>| {
            let of = |rotor: usize| windows.iter().flat_map(move |own| own.rotors[rotor].speeds.samples());
            rotors.into_iter().flat_map(of).collect()
        };
        let samples = averaged.iter().map(samples).collect();
        let are_perturbed = self.are_perturbed();
        let is_pressed = below.iter().any(|sum| sum.axial.pressed > 0.0);
        let steps = if is_pressed { error_of_steps(resolution(self.settings.relative_error)) } else { 0.0 };
        Pairs { below, above, quickest, samples, are_perturbed, steps }
    }

    /// Whether members have perturbations of two sizes, each at its place.
    fn are_perturbed(&self) -> bool {
        let count = self.members.len();
        !self.stators[0].takes_time()
            && self.ended_windows.is_empty()
            && count == self.settings.members
            && count >= LEAST_FOR_DECADE
    }

    /// Whether the rotors have less inertia than their motors.
    fn is_quicker(&self) -> bool {
        self.quicker.iter().any(|quicker| *quicker > 1.0)
    }

    /// The mean speed (rad/s) of a motor, and by how much that of rotors with half the inertia differs where rotors have
    /// less than their motors; `None` of no irregular motion.
    fn with_bias(&self, index: usize) -> Option<(Estimate, [f64; 2])> {
        let unit = self.motors[index].system.scales().angular_speed;
        let speed = |sum: &Sum| sum.rotor.angle / sum.axial.duration * unit;
        let pairs = self.pairs(index);
        let known = Averages::Members(&pairs).estimate(&speed).ok().filter(|_| !pairs.below.is_empty())?;
        let quickest: Vec<f64> = pairs.quickest.iter().map(speed).collect();
        let bias = if quickest.is_empty() { 0.0 } else { (mean(&quickest) - known.value).abs() };
        Some((known, [bias, pairs.change(&pairs.of(&speed)[0]).ok()?]))
    }

    /// Whether the inertia that is left out matters more than the requested error allows.
    fn is_too_quick(&self) -> bool {
        let bias = |index| self.with_bias(index).map_or(0.0, |(_, [bias, _])| bias);
        self.is_quicker() && (0..self.asked).any(|index| bias(index) > INERTIA_SHARE * self.wanted)
    }

    /// An error that is too large with the inertia that is left out and what the perturbation changes, if a longer run can
    /// help.
    fn inaccurate(&self, index: usize) -> Option<Shortfall> {
        let (known, [bias, change]) = self.with_bias(index)?;
        let (standard_error, wanted) = (known.standard_error, self.wanted);
        let scatter = (standard_error * standard_error - change * change).max(0.0).sqrt();
        let helps =
            standard_error > wanted && bias <= INERTIA_SHARE * wanted && scatter > SCATTER_SHARE * wanted;
        helps.then_some(Shortfall::Error { standard_error, wanted })
    }

    /// The operating point of a motor; the others are the averages of the motor beside it, if there is one.
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
                efficiency: averages.ratio(&mechanical, &drive).filter(|_| braked),
            })
        });
        let of_all = estimate(&speed)?.value / units.speed;
        let deviation = |sum: &Sum| {
            // About the mean of all members: the speed of one may wander for longer than it is followed.
            let RotorWindow { angle, square, .. } = sum.rotor;
            let squares = square - of_all * (2.0 * angle - of_all * sum.axial.duration);
            // That of a slow rotor is inverse to its inertia.
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
                (motion, 0.0, *fine, 1)
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

    /// How long an irregular motion lasts, in a unit of time per radian: beyond the start-up, in which a member may have
    /// been on its way to a cycle from the start, it ends at a constant rate.
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

/// The operations of each motor, of all parts.
fn results_of(parts: &[SteadyRun<'_>]) -> Result<Vec<MotorResult>, Error> {
    let result = |index: usize| {
        let mut branches = Vec::new();
        for part in parts {
            branches.extend(part.branches(index)?);
        }
        branches.sort_by_key(|(from_rest, _, _)| std::cmp::Reverse(*from_rest));
        // There are members, or they have repeated themselves.
        let [middle, above] = branches[0].2.clone();
        let branches = branches.into_iter().map(|(_, operation, _)| operation).collect();
        Ok((OperatingRow { branches }, middle, above))
    };
    (0..parts[0].asked).map(result).collect()
}

/// Where the members are; none of a stator that does not yield.
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

/// How long (rad) windows last together.
fn of_windows(windows: &[Window]) -> f64 {
    windows.iter().map(|window| window.axial.duration).sum()
}

#[cfg(test)]
mod tests;
