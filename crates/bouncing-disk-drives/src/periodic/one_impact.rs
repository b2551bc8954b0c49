//! The one-impact orbits on a drive with rigid impacts: they occur at the phases at which the platform has a
//! certain velocity (docs/numerics-impacts.md, "Periodic orbits").

use core::f64::consts::{PI, TAU};
use core::ops::RangeInclusive;

use bouncing_disk_core::numerics::elementary::wrapped_angle;
use bouncing_disk_core::orbits::{PeriodicOrbit, Stability};
use bouncing_disk_core::parts::phase_difference;
use bouncing_disk_core::{ImpactState, Phase};

use super::EXACT;
use crate::drive::Drive;
use crate::driven_map::DrivenMap;

/// The rounding of a velocity and of its required value, in units of the sizes of both.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The first impact still counts as the orbit's if it comes earlier by at most this share of the flight.
const SAME_IMPACT: f64 = 1.0e-9;

/// The shortest cell (rad) searched for turning points of the velocity, and the largest number of cells.
const SHORTEST_CELL: f64 = 1.0e-7;
const MOST_CELLS: u32 = 1 << 18;

/// An interval in which the platform's velocity is monotonic and continuous.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    from: End,
    to: End,
    rises: bool,
    /// Whether the velocity is constant.
    is_flat: bool,
}

/// An end of a stretch.
#[derive(Debug, Clone, Copy)]
struct End {
    /// The time, which may be beyond the period for the later end.
    time: f64,
    velocity: f64,
    /// The jump of the velocity at a joint that is not a kink, within rounding.
    jump: f64,
    is_kink: bool,
}

/// Number of members of a family that are tried.
const MEMBERS: u32 = 16;

/// All one-impact orbits for a range of numbers of periods.
#[derive(Debug)]
pub(super) struct OneImpact {
    /// The smallest of these numbers.
    first: u64,
    found: Vec<Found>,
}

/// The one-impact orbits with a given number of periods.
#[derive(Debug)]
struct Found {
    orbits: Vec<PeriodicOrbit>,
    families: Vec<Family>,
}

/// A stretch on which the velocity has the required value at every phase.
#[derive(Debug)]
struct Family {
    from: f64,
    to: f64,
    has_member: bool,
}

impl Family {
    fn contains(&self, orbit: &PeriodicOrbit) -> bool {
        wrapped_angle(orbit.states[0].phase().angle() - self.from) <= self.to - self.from
    }
}

/// The stretches of a drive.
struct Stretches {
    all: Vec<Stretch>,
    speed: f64,
}

/// The phases at which the platform has a given velocity.
#[derive(Debug, Clone, Default)]
struct Phases {
    single: Vec<f64>,
    /// Extremes of the velocity that equal this value to within rounding.
    touching: Vec<f64>,
    /// Stretches on which the velocity equals this value throughout.
    families: Vec<(f64, f64)>,
}

impl OneImpact {
    /// The orbits with these numbers of periods, up to the largest for which the platform is fast enough.
    pub(super) fn of(map: &DrivenMap, platform_periods: RangeInclusive<u64>) -> Self {
        let stretches = Stretches::of(map.drive());
        let first = *platform_periods.start();
        let values = platform_periods.map(|periods| (periods, map.velocity_of_one_impact(periods)));
        let found = values.take_while(|(_, value)| *value <= (1.0 + ROUNDING) * stretches.speed);
        let found = found.map(|(periods, value)| {
            let Phases { single, touching, families } = stretches.phases(map.drive(), value);
            let orbit = |phase, family| map.orbit_of_one_impact(phase, periods, family);
            let member = |&(from, to): &(f64, f64)| {
                // An earlier impact may prevent the members far from the end of the stretch.
                let parts = (0..MEMBERS).map(|part| (f64::from(part) + 0.5) / f64::from(MEMBERS));
                let phases = parts.map(|part| wrapped_angle(to - (to - from) * part));
                phases.filter_map(|phase| orbit(phase, Some(to - from))).next()
            };
            let isolated = single.into_iter().chain(touching).filter_map(|phase| orbit(phase, None));
            let members: Vec<_> = families.iter().map(member).collect();
            let is_known = members.iter().map(Option::is_some);
            let families = families.iter().zip(is_known);
            let families =
                families.map(|(&(from, to), has_member)| Family { from, to, has_member }).collect();
            Found { orbits: isolated.chain(members.into_iter().flatten()).collect(), families }
        });
        Self { first, found: found.collect() }
    }

    /// All one-impact orbits, with one orbit for each family. Orbits that an earlier impact prevents, and
    /// orbits with their impact on a kink, are excluded.
    pub(super) fn orbits(&self) -> impl Iterator<Item = &PeriodicOrbit> {
        self.found.iter().flat_map(|found| &found.orbits)
    }

    fn with(&self, platform_periods: u64) -> Option<&Found> {
        self.found.get(usize::try_from(platform_periods.checked_sub(self.first)?).ok()?)
    }

    /// The orbits with this number of periods.
    pub(super) fn orbits_with(&self, platform_periods: u64) -> &[PeriodicOrbit] {
        self.with(platform_periods).map_or(&[], |found| &found.orbits)
    }

    /// The family to which a one-impact orbit belongs.
    fn family(&self, orbit: &PeriodicOrbit) -> Option<&Family> {
        self.with(orbit.platform_periods)?.families.iter().find(|family| family.contains(orbit))
    }

    /// The member at the phase of a one-impact orbit, if the orbit belongs to a family.
    pub(super) fn member(&self, map: &DrivenMap, orbit: &PeriodicOrbit) -> Option<PeriodicOrbit> {
        let family = self.family(orbit)?;
        let phase = orbit.states[0].phase().angle();
        map.orbit_of_one_impact(phase, orbit.platform_periods, Some(family.to - family.from))
    }

    /// All of [`Self::orbits`], however close to each other, each replaced by an orbit found from a start if
    /// the two agree. Members of families that were found only from starts are added.
    pub(super) fn with_found(&self, found: &[PeriodicOrbit]) -> Vec<PeriodicOrbit> {
        let mut all: Vec<PeriodicOrbit> = Vec::new();
        for own in self.orbits() {
            let meets = |orbit: &&PeriodicOrbit| {
                let apart = phase_difference(own.states[0].phase().angle(), orbit.states[0].phase().angle());
                orbit.platform_periods == own.platform_periods && apart.abs() <= EXACT
            };
            let is_decided = own.stability() != Stability::Marginal;
            let as_found = found.iter().filter(|_| is_decided).find(meets);
            all.push(as_found.unwrap_or(own).clone());
        }
        for orbit in found {
            if let Some(family) = self.family(orbit).filter(|family| !family.has_member)
                && !all
                    .iter()
                    .any(|known| known.platform_periods == orbit.platform_periods && family.contains(known))
            {
                all.push(orbit.clone());
            }
        }
        all
    }
}

impl Stretches {
    fn of(drive: &Drive) -> Self {
        let times = turning_points(drive);
        let mut stretches: Vec<Stretch> = Vec::with_capacity(times.len());
        for (index, &time) in times.iter().enumerate() {
            let next = times.get(index + 1).copied().unwrap_or(times[0] + TAU);
            let (from, to) = (End::starting(drive, time), End::ending(drive, next));
            let middle = drive.at(time + 0.5 * (next - time));
            let is_flat = middle.acceleration == 0.0 && middle.jerk == 0.0;
            let stretch = Stretch { from, to, rises: middle.acceleration > 0.0, is_flat };
            match stretches.last_mut().filter(|last| last.goes_on_as(&stretch)) {
                Some(last) => last.to = to,
                None => stretches.push(stretch),
            }
        }
        // The last one may continue beyond the seam.
        if let [first, .., last] = stretches[..]
            && last.goes_on_as(&first)
        {
            stretches.pop();
            stretches[0].from = End { time: last.from.time - TAU, ..last.from };
        }
        Self { all: stretches, speed: drive.bounds().speed }
    }

    /// The phases at which the velocity has this value.
    fn phases(&self, drive: &Drive, value: f64) -> Phases {
        let rounding = ROUNDING * (self.speed + value.abs());
        let undecided = |end: &End| (end.velocity - value).abs() <= rounding + end.jump;
        let mut phases = Phases::default();
        for (index, stretch) in self.all.iter().enumerate() {
            let Stretch { from, to, rises, is_flat } = *stretch;
            if is_flat {
                if undecided(&from) {
                    phases.families.push((from.time, to.time));
                }
                continue;
            }
            let next = &self.all[(index + 1) % self.all.len()];
            if undecided(&to) && !to.is_kink && !next.is_flat && next.rises != rises {
                phases.touching.push(wrapped_angle(to.time));
            }
            let is_within = (from.velocity < value) == rises && (to.velocity > value) == rises;
            if is_within && !undecided(&from) && !undecided(&to) {
                phases.single.push(wrapped_angle(crossing(drive, (from.time, to.time), rises, value)));
            }
        }
        phases
    }
}

impl Stretch {
    fn goes_on_as(&self, next: &Self) -> bool {
        !self.to.is_kink && self.is_flat == next.is_flat && self.rises == next.rises
    }
}

impl End {
    fn starting(drive: &Drive, time: f64) -> Self {
        let velocity = drive.velocity(time);
        let is_kink = drive.velocity_jump(time) != 0.0;
        let before = drive.velocity(before(time));
        Self { time, velocity, jump: if is_kink { 0.0 } else { (velocity - before).abs() }, is_kink }
    }

    fn ending(drive: &Drive, time: f64) -> Self {
        let end = Self::starting(drive, wrapped_angle(time));
        Self { time, velocity: drive.velocity(before(wrapped_angle(time))), ..end }
    }
}

/// The double before a time in [0, 2 pi).
fn before(time: f64) -> f64 {
    if time > 0.0 { time.next_down() } else { TAU.next_down() }
}

/// The time at which a monotonic velocity passes a value.
fn crossing(drive: &Drive, (mut low, mut high): (f64, f64), rises: bool, value: f64) -> f64 {
    loop {
        let middle = low + 0.5 * (high - low);
        if middle <= low || middle >= high {
            break;
        }
        if (drive.velocity(middle) < value) == rises { low = middle } else { high = middle }
    }
    let miss = |time: f64| (drive.velocity(time) - value).abs();
    if miss(low) <= miss(high) { low } else { high }
}

/// The times in [0, 2 pi) between which the velocity is monotonic: joints and zeros of the acceleration, in
/// order.
fn turning_points(drive: &Drive) -> Vec<f64> {
    let mut times = Vec::new();
    if drive.next_joint(0.0).is_none() {
        zeros_of_acceleration(drive, &mut times);
        return times;
    }
    let mut time = 0.0;
    while let Some(joint) = drive.next_joint(time) {
        times.push(time);
        let here = drive.at(time);
        let inner = -here.acceleration / here.jerk;
        if inner > 0.0 && inner < joint.after {
            times.push(time + inner);
        }
        if joint.time <= time {
            break;
        }
        time = joint.time;
    }
    times
}

/// All zeros of the acceleration of a Fourier sum in [0, 2 pi), and perhaps some other times.
///
/// A cell of half width h about m contains no zero if |A(m)| > max|A'| h. It contains at most one, which the
/// signs at its ends show, if |A'(m)| > max|A''| h. All other cells are halved.
fn zeros_of_acceleration(drive: &Drive, times: &mut Vec<f64>) {
    let (bounds, harmonic) = (drive.bounds(), drive.highest_harmonic());
    // Without acceleration every time is a zero.
    if bounds.acceleration == 0.0 {
        return;
    }
    let cells = 8.0 * harmonic;
    let mut left = MOST_CELLS;
    let mut open = Vec::new();
    let mut index = cells;
    while index > 0.0 {
        open.push((TAU * ((index - 1.0) / cells), TAU * (index / cells)));
        index -= 1.0;
    }
    while let Some((low, high)) = open.pop() {
        left = left.saturating_sub(1);
        let (middle, half) = (low + 0.5 * (high - low), 0.5 * (high - low) * (1.0 + 1.0e-9));
        let here = drive.at(middle);
        // A harmonic's fourth derivative is at most its number times its third.
        let rounding = ROUNDING * bounds.jerk * harmonic;
        if here.acceleration.abs() > bounds.jerk * half + rounding {
            continue;
        }
        if here.jerk.abs() > harmonic * bounds.jerk * half + rounding {
            let rises = here.jerk > 0.0;
            let is_below = |time: f64| (drive.acceleration(time) < 0.0) == rises;
            if is_below(low) && !is_below(high) {
                let (mut low, mut high) = (low, high);
                while high - low > f64::EPSILON * TAU {
                    let middle = low + 0.5 * (high - low);
                    if is_below(middle) { low = middle } else { high = middle }
                }
                times.push(if high < TAU { high } else { 0.0 });
            }
        } else if 2.0 * half <= SHORTEST_CELL || left == 0 {
            times.push(middle);
        } else {
            // The earlier half is on top.
            open.extend([(middle, high), (low, middle)]);
        }
    }
    times.sort_by(f64::total_cmp);
}

impl DrivenMap {
    /// The velocity of the platform at the impact of an orbit with one impact every k periods.
    fn velocity_of_one_impact(&self, platform_periods: u64) -> f64 {
        let r = self.restitution();
        PI * platform_periods as f64 * ((1.0 - r) / (1.0 + r))
    }

    /// The one-impact orbit at this phase with its errors; `family` is the length of the family's stretch, if
    /// the orbit belongs to one. `None` if an earlier impact occurs, the disk does not leave the platform, or
    /// the impact is on a kink.
    fn orbit_of_one_impact(
        &self,
        phase: f64,
        platform_periods: u64,
        family: Option<f64>,
    ) -> Option<PeriodicOrbit> {
        let r = self.restitution();
        let flight = TAU * platform_periods as f64;
        let state = ImpactState::new(Phase::new(phase).ok()?, -flight / (1.0 + r)).ok()?;
        let (landing, monodromy) = self.step_with_derivative(state).ok()?;
        if (landing.impact.duration() - flight).abs() > SAME_IMPACT * flight {
            return None;
        }
        let drive = self.drive();
        let here = drive.at(phase);
        let value = self.velocity_of_one_impact(platform_periods);
        let rounding = ROUNDING * (drive.bounds().speed + value);
        let beside = |distance: f64| [phase - distance, phase + distance].map(|time| drive.at(time));
        // The first distance, doubled, at which the velocity has certainly left the value.
        let mut distance = 4.0 * f64::EPSILON * TAU;
        let has_left = |distance: f64| {
            let moved = beside(distance).map(|there| (there.velocity - here.velocity).abs());
            moved[0].min(moved[1]) > 2.0 * rounding
        };
        while family.is_none() && !has_left(distance) && distance < 1.0 {
            distance *= 2.0;
        }
        let position_error = family.unwrap_or(distance);
        let change = beside(position_error)
            .map(|there| (there.acceleration - here.acceleration).abs())
            .into_iter()
            .fold(0.0, f64::max);
        let size = monodromy.to_cols_array().iter().fold(1.0, |sum, entry| sum + entry.abs());
        let trace_error = 16.0 * f64::EPSILON * size + (1.0 + r) * (1.0 + r) * change;
        Some(PeriodicOrbit { states: vec![state], platform_periods, monodromy, position_error, trace_error })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_platform_at_rest_has_no_stretches() {
        let still = Drive::fourier(&[]).expect("legal");
        assert!(turning_points(&still).is_empty());
        let map = DrivenMap::new(still, 0.5).expect("legal");
        assert_eq!(OneImpact::of(&map, 1..=3).orbits().count(), 0);
    }
}
