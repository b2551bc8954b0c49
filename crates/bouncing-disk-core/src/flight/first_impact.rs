//! The first impact of a flight: Eq. (11), with the guarantee that no earlier one is missed.
//!
//! In units of 1/omega and g/omega^2 a disk that leaves the platform at phase tau with relative speed w is
//! above it by
//!
//! ```text
//! gap(h) = w h - h^2/2 + P [h cos tau + sin tau - sin(tau + h)]
//! ```
//!
//! Three facts make the first zero h > 0 certain and its cost independent of the length of the flight (proofs
//! in docs/numerics-impacts.md):
//!
//! 1. *One crest decides.* A disk below a crest of the platform (phase pi/2) is hit by that crest at the
//!    latest. So the impact lies before the first crest after the launch that rises above the disk. If the disk
//!    rises above the crests, this is the first crest after it has come down to their height, at a moment known
//!    in closed form. In both cases the window to search is shorter than one period.
//! 2. *The curvature of the gap, P sin(tau + h) - 1, changes sign at two phases known in closed form.* A window
//!    has at most three pieces, each with a curvature of constant sign. A concave piece that starts above zero
//!    has a root only if it ends below, and then exactly one. A convex piece has at most one minimum, the only
//!    place where the gap may dip below zero and rise again.
//! 3. *gap(h)/h is regular*, so the root at the launch is divided out, and even the briefest flights have
//!    relative accuracy.

use core::f64::consts::{PI, TAU};

use crate::flight::bounds::{arc_speed, clears_by_tangents, may_return_soon};
use crate::flight::gap::{
    Bracket, CrestForm, FASTEST_BRIEF, GapForm, LaunchForm, Root, SHORT_FLIGHT, ShortForm, is_brief,
};
use crate::flight::launch::Impact;
use crate::flight::launch::Launch;
use crate::flight::platform::phase::Phase;
use crate::flight::platform::vibration::Vibration;
use crate::numerics::elementary::{
    CREST, impact_phase, nearby_wrapped, nearest_periods, sin_cos_bounded, sine_deficit_ratio, versine_ratio,
};
use crate::numerics::error::Error;

/// Longest flight accepted, in radians: beyond it the period count times 2 pi is no longer exact.
pub const MAX_FLIGHT_DURATION: f64 = 1.6e9;

/// A disk that comes down to the height of the crests with this speed or a slower one flies no longer than
/// [`MAX_FLIGHT_DURATION`]: it was launched at most 2e4 faster, from at most 2e8 below.
pub(crate) const FASTEST_ARC: f64 = -0.49 * MAX_FLIGHT_DURATION;

impl Vibration {
    /// The first impact after `launch` (Eq. 11).
    ///
    /// The impact phase is accurate to 1e-14 of a period or to the conditioning of the problem, whichever is
    /// worse (docs/numerics-impacts.md states the bound).
    ///
    /// # Errors
    /// [`Error::NoLiftOff`] for a launch from rest while the platform does not fall away;
    /// [`Error::FlightTooLong`] beyond [`MAX_FLIGHT_DURATION`].
    pub fn first_impact(&self, launch: Launch) -> Result<Impact, Error> {
        self.impact_after(launch.phase(), launch.relative_speed())
    }

    /// [`Self::first_impact`] for a speed that is known to be finite and not negative.
    #[inline]
    pub(crate) fn impact_after(&self, from: Phase, speed: f64) -> Result<Impact, Error> {
        let impact = self.impact_after_in_place(from, speed);
        #[cfg(debug_assertions)]
        if let Ok(impact) = &impact {
            self.assert_clock(from, speed, (impact.phase, impact.velocity), impact.duration());
        }
        impact
    }

    /// [`Self::impact_after`], inlined into its caller.
    #[inline(always)]
    pub(crate) fn impact_after_in_place(&self, from: Phase, speed: f64) -> Result<Impact, Error> {
        let p = self.peak_acceleration();
        let from = from.in_parts();
        let angle = from.angle();
        if may_return_soon(p, p * from.sin(), p * from.cos(), speed)
            && let Some(done) = self.short_flight(&from, speed)?
        {
            return Ok(done.in_parts());
        }
        let disk_speed = speed + p * from.cos();
        let depth = p - p * from.sin();
        let mut evaluations = 0;
        if !self.crests.surely_cleared(p, angle, disk_speed, arc_speed(disk_speed, depth)) {
            let low = LaunchForm { angle, peak: p, speed, sine: p * from.sin(), cosine: p * from.cos() };
            if let Some((bracket, guess)) = self.bracket_before_crest_of_launch(&low, &mut evaluations) {
                let root = low.root(bracket, guess, evaluations)?;
                return Ok(landed_within_a_turn(angle, root).in_parts());
            }
        }
        self.impact_from_above(angle, disk_speed, depth, speed, evaluations)
    }

    /// The window of a possible first root before the crest, and a place in it to start the search; `None` if
    /// there is certainly no root.
    ///
    /// Everything within [`SHORT_FLIGHT`] has been decided already, with the relative accuracy that it needs.
    /// The sign of a gap is taken from the crest form if that is beyond doubt, otherwise from the launch form.
    #[inline(never)]
    pub(crate) fn bracket_before_crest_of_launch(
        &self,
        low: &LaunchForm,
        evaluations: &mut u32,
    ) -> Option<(Bracket, f64)> {
        let &LaunchForm { angle, peak, speed, sine, cosine } = low;
        let rising = CrestForm { peak, angle, speed: speed + cosine, depth: peak - sine };
        let inflection = self.time_to_separation(angle);
        let crest = inflection + (CREST - self.separation_angle);
        if crest <= SHORT_FLIGHT
            || clears_by_tangents(
                peak,
                self.separation_speed,
                (inflection, rising.gap_over(self.separation_depth, inflection)),
                (crest, rising.gap_over(0.0, crest)),
                rising.speed,
            )
        {
            return None;
        }
        let mut has_passed = |platform_depth: f64, t: f64| {
            let gap = rising.gap_over(platform_depth, t);
            if gap.abs() > self.doubtful_gap {
                return gap <= 0.0;
            }
            *evaluations += 1;
            low.gap(t) <= 0.0
        };
        if inflection > SHORT_FLIGHT && has_passed(self.separation_depth, inflection) {
            // The parabola of the launch; if it leads out of the window, the end of the window, from which a
            // concave gap is approached without overshooting.
            let parabola = 2.0 * low.speed / (1.0 - low.sine);
            let inside = parabola > SHORT_FLIGHT && parabola < inflection;
            return Some((
                Bracket { lo: SHORT_FLIGHT, hi: inflection },
                if inside { parabola } else { inflection },
            ));
        }
        let lo = inflection.max(SHORT_FLIGHT);
        if has_passed(0.0, crest) {
            return Some((Bracket { lo, hi: crest }, lo));
        }
        if low.slope(lo) >= 0.0 || low.slope(crest) <= 0.0 {
            return None;
        }
        low.dip(lo, crest, evaluations).map(|hi| (Bracket { lo, hi }, lo))
    }

    /// The impact of a disk that rises above the crests: down to their height its flight is known in closed
    /// form. `disk_speed` and `depth` (below the crest) are those at `angle`; `speed` is only for the error.
    #[inline(always)]
    pub(crate) fn impact_from_above(
        &self,
        angle: f64,
        disk_speed: f64,
        depth: f64,
        speed: f64,
        evaluations: u32,
    ) -> Result<Impact, Error> {
        let radicand = disk_speed * disk_speed - 2.0 * depth;
        let fall = if radicand > 0.0 { radicand.sqrt() } else { 0.0 };
        self.impact_after_arc(angle, (disk_speed + fall, fall), speed, evaluations)
    }

    /// The impact of a disk that comes down to the height of the crests with the speed `fall` a time `free`
    /// after `angle`; `speed` is only for the error.
    #[inline(always)]
    pub(crate) fn impact_after_arc(
        &self,
        angle: f64,
        (free, fall): (f64, f64),
        speed: f64,
        mut evaluations: u32,
    ) -> Result<Impact, Error> {
        let p = self.peak_acceleration();
        if free > MAX_FLIGHT_DURATION {
            return Err(Error::FlightTooLong {
                relative_speed: speed,
                duration: free,
                limit: MAX_FLIGHT_DURATION,
            });
        }
        let (free_periods, rest) = nearest_periods(free);
        let start = angle + rest;
        let falling = CrestForm { peak: p, angle: start, speed: -fall, depth: 0.0 };
        let (turned, _) = nearby_wrapped(start);
        let crest = (CREST - turned) + if turned < CREST { 0.0 } else { TAU };
        // One root, unless the disk comes down slower than the platform can fall and just behind a crest.
        let behind_crest = (turned > CREST) & (turned < self.retention_angle);
        let bracket = if (fall < p) & behind_crest {
            self.bracket_behind_crest(&CrestForm { angle: turned, ..falling }, crest, &mut evaluations)
        } else {
            Bracket { lo: 0.0, hi: crest }
        };
        let root = falling.root(bracket, bracket.lo, evaluations)?;
        Ok(landed(angle, start, free_periods, root))
    }

    /// The window of the first root of an arc that starts at the crests' height while the platform falls away
    /// below the disk: the disk may catch up with the platform and be left behind again.
    #[cold]
    fn bracket_behind_crest(&self, falling: &CrestForm, crest: f64, evaluations: &mut u32) -> Bracket {
        let end = self.retention_angle - falling.angle;
        if falling.gap_over(self.separation_depth, end) <= 0.0 {
            return Bracket { lo: 0.0, hi: end };
        }
        let p = self.peak_acceleration();
        let (sin, cos) = sin_cos_bounded(falling.angle);
        // Slopes at both ends; between them the gap lies above both tangents, so above the point where these
        // meet.
        let (first, last) = (falling.speed - p * cos, (falling.speed - end) + self.separation_speed);
        let gap_at_end = falling.gap_over(self.separation_depth, end);
        let lowest = CrestForm::lowest_of_tangents(p - p * sin, gap_at_end, first, last, end);
        if first < 0.0
            && last > 0.0
            && lowest <= self.doubtful_gap
            && let Some(hi) = falling.dip(0.0, end, evaluations)
        {
            return Bracket { lo: 0.0, hi };
        }
        Bracket { lo: end, hi: crest }
    }

    /// The impact if it occurs within [`SHORT_FLIGHT`], otherwise `None`.
    fn short_flight(&self, from: &Phase, speed: f64) -> Result<Option<Impact>, Error> {
        if speed <= FASTEST_BRIEF {
            self.flight_of_hardly_any_speed(from, speed)
        } else {
            self.short_flight_with_speed(from, speed)
        }
    }

    /// [`Self::short_flight`] of a launch that is not brief, inlined into its caller.
    #[inline(always)]
    fn short_flight_with_speed(&self, from: &Phase, speed: f64) -> Result<Option<Impact>, Error> {
        let p = self.peak_acceleration();
        let angle = from.angle();
        let away = self.falls_away_at(angle);
        let sine = p * from.sin();
        let flight = ShortForm { speed, sine, cosine: p * from.cos(), pull: 1.0 - sine };
        let mut evaluations = 0;
        let end = if away { self.retention_angle - angle } else { self.time_to_separation(angle) };
        let at_once =
            if away { None } else { flight.root_in_first_piece(end.min(SHORT_FLIGHT), &mut evaluations) };
        let (h, velocity) = match at_once {
            Some(root) => root,
            None => match self.short_bracket(&flight, away, end, &mut evaluations) {
                Some(bracket) => flight.root(bracket, &mut evaluations)?,
                None => return Ok(None),
            },
        };
        let (phase, turns) = turned_by(*from, h);
        Ok(Some(Impact { periods: 0, remainder: h, turns, phase, velocity, evaluations }))
    }
}

/// The phase `h` in [0, 1/2] rad later, and whether it has passed 0 on the way.
#[inline(always)]
pub(crate) fn turned_by(from: Phase, h: f64) -> (Phase, u64) {
    let h2 = h * h;
    let (sin_h, versine) = (h - h2 * h * sine_deficit_ratio(h), h2 * versine_ratio(h));
    let (s, c) = (from.sin(), from.cos());
    let sum = from.angle() + h;
    let (wrapped, turns) = if sum >= TAU { (sum - TAU, 1) } else { (sum, 0) };
    (Phase::from_parts(wrapped, s + (c * sin_h - s * versine), c - (s * sin_h + c * versine)), turns)
}

/// If the platform falls away from a disk at rest with an acceleration below this share of 1 + P, the
/// acceleration is not computed from 1 - P sin tau, which is then mostly rounding error.
const DOUBTFUL_PULL: f64 = 1.0e-13;

impl Vibration {
    /// [`Self::short_flight`] from rest, or of a launch that may be [brief](is_brief), for which the search may
    /// fail.
    ///
    /// # Errors
    /// [`Error::NoLiftOff`] from rest if the platform does not fall away.
    #[cold]
    #[inline(never)]
    fn flight_of_hardly_any_speed(&self, from: &Phase, speed: f64) -> Result<Option<Impact>, Error> {
        let p = self.peak_acceleration();
        let away = self.falls_away_at(from.angle());
        let pull = 1.0 - p * from.sin();
        let impact = if speed <= 0.0 {
            if !away {
                return Err(Error::NoLiftOff { phase: from.angle(), peak_acceleration: p });
            }
            self.brief_flight_from_rest(from)
        } else if !away && is_brief(speed, pull) {
            // The smallest double stands for a duration of zero.
            let h = (2.0 * speed / pull).max(f64::from_bits(1));
            let (phase, turns) = turned_by(*from, h);
            Some(Impact { periods: 0, remainder: h, turns, phase, velocity: -speed, evaluations: 0 })
        } else {
            None
        };
        match impact {
            Some(impact) => Ok(Some(impact)),
            None => self.short_flight_with_speed(from, speed),
        }
    }

    /// The impact of a flight from rest that starts while the platform has nearly stopped falling away. Its
    /// acceleration c0 = P sin tau - 1 away from the disk is then smaller than the rounding of that difference,
    /// and is computed from the distances to the two phases at which it vanishes. `None` for all other
    /// launches.
    ///
    /// Over so short a flight the acceleration is c0 + c1 h - h^2/2, c1 = P cos tau, which integrates to
    /// gap = h^2 (c0/2 + c1 h/6 - h^2/24) (docs/numerics-impacts.md, "Brief flights").
    fn brief_flight_from_rest(&self, from: &Phase) -> Option<Impact> {
        let p = self.peak_acceleration();
        let angle = from.angle();
        // P sin tau - P sin sigma as a product.
        let (since, until) = (angle - self.separation_angle, self.retention_angle - angle);
        let away = 2.0 * p * (sin_cos_bounded(0.5 * since).0 * sin_cos_bounded(0.5 * until).0);
        let late = angle >= CREST;
        let brief = late || p - 1.0 <= DOUBTFUL_PULL;
        if !(brief && away <= DOUBTFUL_PULL * (1.0 + p)) {
            return None;
        }
        // P cos tau, from the distance to the crest where the carried cosine is nearly zero.
        let drift = p * sin_cos_bounded(CREST - angle).0;
        let root = (drift * drift + 3.0 * away).sqrt();
        let h = if late { 6.0 * away / (root - drift) } else { 2.0 * (drift + root) };
        let velocity = h * (away + h * (0.5 * drift - h * (1.0 / 6.0)));
        let (phase, turns) = turned_by(*from, h);
        let velocity = if velocity < 0.0 { velocity } else { 0.0 };
        Some(Impact { periods: 0, remainder: h, turns, phase, velocity, evaluations: 0 })
    }

    /// The window of the first root within [`SHORT_FLIGHT`], searched over pieces of constant curvature sign:
    /// convex while the platform falls `away`, otherwise concave; the first piece reaches to `end`.
    fn short_bracket(
        &self,
        flight: &ShortForm,
        away: bool,
        end: f64,
        evaluations: &mut u32,
    ) -> Option<Bracket> {
        let (mut lo, mut end, mut convex) = (0.0, end, away);
        loop {
            let hi = end.min(SHORT_FLIGHT);
            let (ratio, velocity) = flight.at(hi);
            *evaluations += 1;
            if ratio <= 0.0 {
                return Some(Bracket { lo, hi });
            }
            if convex
                && lo > 0.0
                && velocity > 0.0
                && flight.at(lo).1 < 0.0
                && let Some(hi) = flight.dip(lo, hi, evaluations)
            {
                return Some(Bracket { lo, hi });
            }
            if end >= SHORT_FLIGHT {
                return None;
            }
            lo = end;
            end += if convex { PI + 2.0 * self.separation_angle } else { PI - 2.0 * self.separation_angle };
            convex = !convex;
        }
    }
}

#[cfg(debug_assertions)]
impl Vibration {
    /// Asserts that the `duration` of a flight agrees with the velocities at its ends: a disk in free flight
    /// loses one unit of speed per radian, whatever the phases are (docs/numerics-impacts.md, "The clock").
    /// Debug builds only.
    ///
    /// An impact with zero velocity is a graze, whose slope is known to only half of the digits; it is not
    /// checked.
    pub(crate) fn assert_clock(
        &self,
        from: Phase,
        speed: f64,
        (phase, velocity): (Phase, f64),
        duration: f64,
    ) {
        let p = self.peak_acceleration();
        let lost = speed + p * (from.cos() - phase.cos()) - velocity;
        // Pairs that were rotated by many short flights deviate from their angles, which determine the time.
        let parted = |of: Phase| {
            let (sin, cos) = crate::numerics::elementary::sin_cos(of.angle());
            (of.sin() * cos - of.cos() * sin).abs()
        };
        let rounding =
            CLOCK_ROUNDING * (1.0 + p + speed.abs() + duration) + p * (parted(from) + parted(phase));
        assert!(
            velocity >= 0.0 || (lost - duration).abs() <= rounding,
            "a flight of {duration:e} rad loses {lost:e} of its speed: P = {p:e}, {from:?}, {speed:e}, {phase:?}, {velocity:e}"
        );
    }
}

/// Bound on the rounding of both sides of the law that `Vibration::assert_clock` states, relative to the
/// numbers they are computed from: about forty roundoffs, of which phases, speeds and their difference
/// contribute about ten. A period is 2 pi.
#[cfg(debug_assertions)]
const CLOCK_ROUNDING: f64 = 1.0e-14;

/// The impact of a form whose reference is the start of the flight itself, at `angle`.
pub(crate) fn landed_within_a_turn(angle: f64, root: Root) -> Impact {
    let mut impact = landed(angle, angle, 0.0, root);
    (impact.periods, impact.remainder) = if root.time >= TAU { (1, root.time - TAU) } else { (0, root.time) };
    impact
}

/// The impact of an arc whose reference is `start`, in [-pi, 3 pi), `periods` whole periods later than after a
/// launch at `angle` in the same period.
#[inline(always)]
pub(crate) fn landed(angle: f64, start: f64, periods: f64, root: Root) -> Impact {
    let (wrapped, turns) = impact_phase(start + root.time);
    let turns = (periods + turns) as u64;
    debug_assert!(
        (turns as f64 * TAU + (wrapped - angle) - (periods * TAU + (start - angle) + root.time)).abs()
            <= 1.0e-14 + 1.0e-15 * periods * TAU,
        "time and phase disagree: from {angle:e}, {periods} periods, {start:e} + {:e}, {wrapped:e} after {turns} turns",
        root.time
    );
    let ahead = wrapped - angle;
    let (periods, remainder) = if ahead >= 0.0 {
        (turns, ahead)
    } else if ahead + TAU < TAU {
        (turns.saturating_sub(1), ahead + TAU)
    } else {
        // A whole number of periods, less than the rounding.
        (turns, 0.0)
    };
    Impact {
        periods,
        remainder,
        turns,
        phase: Phase::from_parts(wrapped, root.sin, root.cos),
        velocity: if root.velocity < 0.0 { root.velocity } else { 0.0 },
        evaluations: root.evaluations,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The crest is the first impact of this disk, whichever window contains it.
    #[test]
    fn a_disk_that_comes_down_to_the_crest_at_the_crest_lands_there() {
        for (peak, fall) in [(0.5, 1e-9), (3.0, 0.5), (3.0, 4.0), (200.0, 40.0)] {
            let vibration = Vibration::new(peak).expect("legal");
            let impact = vibration.impact_after_arc(CREST, (0.0, fall), 1.0, 0).expect("lands");
            assert_eq!(impact.phase.angle().to_bits(), CREST.to_bits(), "{peak} {fall} {impact:?}");
            assert!(impact.duration() == 0.0 && impact.velocity < 0.0, "{peak} {fall} {impact:?}");
        }
    }
}
