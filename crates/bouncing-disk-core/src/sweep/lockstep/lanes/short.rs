//! Flights that land within half a radian: `Vibration::short_flight`, many at a time.
//!
//! Slow launches are rare among ordinary ones, and all launches of a chattering disk are slow, so slow
//! launches are collected.

use core::f64::consts::{PI, TAU};

use pulp::{Simd, WithSimd};

use super::platform::Platform;
use super::{Impacts, LANES, Lanes, Launches, Mask, ROW, Row, Sixteens, Width, kept, lanes_of, mask};
use crate::flight::bounds::clears;
use crate::flight::gap::SHORT_FLIGHT;
use crate::flight::gap::{CrestForm, FASTEST_BRIEF, ShortForm};
use crate::numerics::elementary::{sine_deficit_ratio, versine_ratio};

/// Steps of Newton's iteration, as in `root_in_first_piece`.
const STEPS: usize = 4;

/// Packed slow launches.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(super) struct Short {
    speed: Row,
    /// P sin and P cos at launch, and the pair itself.
    sine: Row,
    cosine: Row,
    sin: Row,
    cos: Row,
    angle: Row,
    /// P.
    peak: Row,
    /// The phase (rad) at which the platform begins to fall away.
    separation: Row,
    /// Where the piece of constant curvature sign that contains the launch ends.
    end: Row,
    time: Row,
    /// gap/h and the relative velocity there.
    ratio: Row,
    slope: Row,
    /// Time and relative velocity before the last step, and that step.
    before: Row,
    velocity: Row,
    step: Row,
    /// Where the next piece ends.
    next_end: Row,
    /// Launches with a pull towards the platform, those still inside the piece, and those landed.
    pulled: Mask,
    inside: Mask,
    landed: Mask,
    /// Launches that may be hit before the first crest if they do not land soon.
    low: [bool; LANES],
    /// Launches where the platform falls away.
    away: Mask,
}

/// Newton's iteration on gap/h of the first `count` flights, and their impacts.
pub(super) struct Solve<'a> {
    pub(super) short: &'a mut Short,
    pub(super) count: usize,
    pub(super) impacts: &'a mut Impacts,
}

impl WithSimd for Solve<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { short, count, impacts } = self;
        let width = Sixteens::holding(count);
        begin(width, short);
        for k in 0..width.lanes() {
            short.time[k] = form(short, k).expected();
            // Lanes after the last launch would only add to the work.
            short.inside[k] = short.pulled[k] & mask(k < count);
            short.landed[k] = 0;
        }
        for _ in 0..STEPS {
            step(width, short);
            let flying = short.inside.iter().zip(&short.landed).take(width.lanes());
            if flying.fold(0, |any, (inside, landed)| any | (inside & !landed)) == 0 {
                break;
            }
        }
        impact(width, short, impacts);
    }
}

#[inline(always)]
fn form(short: &Short, k: usize) -> ShortForm {
    ShortForm {
        speed: short.speed[k],
        sine: short.sine[k],
        cosine: short.cosine[k],
        pull: 1.0 - short.sine[k],
    }
}

/// The pieces that contain the launches, and the pulls on them.
#[inline(always)]
fn begin(width: impl Width, short: &mut Short) {
    for k in 0..width.lanes() {
        let (angle, peak, separation) = (short.angle[k], short.peak[k], short.separation[k]);
        let retention = PI - separation;
        let away = mask(angle >= separation) & mask(angle < retention);
        let ahead = separation - angle;
        let to_separation = if ahead > 0.0 { ahead } else { ahead + TAU };
        let end = if away != 0 { retention - angle } else { to_separation };
        let next = if away != 0 { 2.0 * separation } else { -2.0 * separation };
        short.away[k] = away;
        short.sine[k] = peak * short.sin[k];
        short.cosine[k] = peak * short.cos[k];
        short.end[k] = end;
        short.next_end[k] = end + (PI + next);
        // Launches that may be brief are left to the solver of one flight.
        short.pulled[k] = !away & mask(short.speed[k] > FASTEST_BRIEF);
    }
}

#[inline(always)]
const fn within_short(end: f64) -> f64 {
    if end < SHORT_FLIGHT { end } else { SHORT_FLIGHT }
}

#[inline(always)]
fn step(width: impl Width, short: &mut Short) {
    for k in 0..width.lanes() {
        (short.ratio[k], short.slope[k]) = form(short, k).at(short.time[k]);
    }
    for k in 0..width.lanes() {
        let h = short.time[k];
        let inside = short.inside[k] & mask(h > 0.0) & mask(h < within_short(short.end[k]));
        let (ratio, velocity) = (short.ratio[k], short.slope[k]);
        let slope = velocity - ratio;
        let step = -ratio * h / slope;
        let moves = inside & !short.landed[k];
        let last = moves & mask(ShortForm::is_last(step, h, slope));
        let next = h + step;
        short.before[k] = if last != 0 { h } else { short.before[k] };
        short.step[k] = if last != 0 { step } else { short.step[k] };
        short.velocity[k] = if last != 0 { velocity } else { short.velocity[k] };
        short.time[k] = if moves != 0 { next } else { h };
        short.landed[k] |= last;
        short.inside[k] = inside;
    }
}

#[inline(always)]
fn impact(width: impl Width, short: &Short, impacts: &mut Impacts) {
    for k in 0..width.lanes() {
        let h = short.time[k];
        let h2 = h * h;
        let (sin_h, versine) = (h - h2 * h * sine_deficit_ratio(h), h2 * versine_ratio(h));
        let (s, c) = (short.sin[k], short.cos[k]);
        let sum = short.angle[k] + h;
        let turned = mask(sum >= TAU);
        impacts.angle[k] = sum - kept(turned, TAU);
        impacts.sin[k] = s + (c * sin_h - s * versine);
        impacts.cos[k] = c - (s * sin_h + c * versine);
        impacts.velocity[k] =
            form(short, k).impact_velocity(short.before[k], short.velocity[k], short.step[k]);
        impacts.turns[k] = kept(turned, 1.0);
        impacts.duration[k] = h;
    }
}

/// The outcome of a slow launch that has not landed.
pub(super) enum Fate {
    /// It flies on as if it had been launched faster.
    GoesLow,
    GoesAbove,
    Doubtful,
}

impl Short {
    pub(super) const fn new() -> Self {
        const MASK: Mask = [0; LANES];
        Self {
            speed: ROW,
            sine: ROW,
            cosine: ROW,
            sin: ROW,
            cos: ROW,
            angle: ROW,
            peak: ROW,
            separation: ROW,
            end: ROW,
            time: ROW,
            ratio: ROW,
            slope: ROW,
            before: ROW,
            velocity: ROW,
            step: ROW,
            next_end: ROW,
            pulled: MASK,
            inside: MASK,
            landed: MASK,
            low: [false; LANES],
            away: MASK,
        }
    }

    /// Sets number `k` to the launch of a lane.
    #[inline(always)]
    pub(super) fn set(
        &mut self,
        k: usize,
        platform: &Platform,
        launches: Launches<'_>,
        lane: usize,
        low: bool,
    ) {
        self.low[k] = low;
        self.speed[k] = launches.speed[lane];
        self.sin[k] = launches.from.sin[lane];
        self.cos[k] = launches.from.cos[lane];
        self.angle[k] = launches.from.angle[lane];
        self.peak[k] = platform.peak;
        self.separation[k] = platform.separation_angle;
    }

    /// The flights that have landed.
    #[inline(always)]
    pub(super) fn landed(&self) -> Lanes {
        lanes_of(&self.landed)
    }

    /// The outcome of flight number `k`, which has not landed.
    pub(super) fn fate(&self, k: usize) -> Fate {
        let form = form(self, k);
        let (last_ratio, last_velocity) = form.at(SHORT_FLIGHT);
        let (end_ratio, end_velocity) = form.at(within_short(self.end[k]));
        // A launch from rest is legal only where the platform falls away, and then it moves off.
        let away = self.pulled[k] == 0;
        // As `short_bracket`: no root in the pieces up to half a radian, and no dip, or none below the
        // tangents.
        let end = within_short(self.end[k]);
        let lowest = CrestForm::lowest_of_tangents(
            end_ratio * end,
            last_ratio * SHORT_FLIGHT,
            end_velocity,
            last_velocity,
            SHORT_FLIGHT - end,
        );
        let may_dip = !away && last_velocity > 0.0 && end_velocity < 0.0;
        let dips = may_dip && !clears(lowest, self.peak[k]);
        let second_piece = end_ratio > 0.0 && self.next_end[k] >= SHORT_FLIGHT + 1.0e-9 && !dips;
        let flies_on = last_ratio > 0.0
            && (self.end[k] >= SHORT_FLIGHT || second_piece)
            && (self.speed[k] > FASTEST_BRIEF || self.away[k] != 0);
        match (flies_on, self.low[k]) {
            (true, true) => Fate::GoesLow,
            (true, false) => Fate::GoesAbove,
            _ => Fate::Doubtful,
        }
    }
}
