//! Flights that land within half a radian: `Vibration::short_flight`, many at a time.
//!
//! Slow launches are few among ordinary ones and all of a chattering disk's, so they are packed: each stage runs over
//! as many of them as there are.

use core::f64::consts::TAU;

use pulp::{Simd, WithSimd};

use super::{Impacts, LANES, Launches, Mask, Platforms, ROW, Row, Work, mask, packed};
use crate::elementary::{sine_deficit_ratio, versine_ratio};
use crate::flight::SHORT_FLIGHT;
use crate::gap::ShortForm;

/// Steps of Newton's iteration for all packed flights; `root_in_first_piece` allows one more.
const STEPS: usize = 3;

/// Packed slow launches.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(super) struct Short {
    /// How many there are, and the lane of each.
    pub(super) count: usize,
    lane: [u8; LANES],
    speed: Row,
    /// P sin and P cos at launch, and the pair itself.
    sine: Row,
    cosine: Row,
    sin: Row,
    cos: Row,
    angle: Row,
    /// Where the piece of constant curvature that the launch lies in ends.
    end: Row,
    time: Row,
    velocity: Row,
    /// gap/h and relative velocity at the end of that piece, or after half a radian, and after half a radian.
    end_ratio: Row,
    end_velocity: Row,
    last_ratio: Row,
    last_velocity: Row,
    /// Where the next piece ends.
    next_end: Row,
    /// Launches with a pull towards the platform, those still inside the piece, and those landed.
    pulled: Mask,
    inside: Mask,
    landed: Mask,
}

/// Newton's iteration on gap/h.
pub(super) struct Solve<'a> {
    pub(super) short: &'a mut Short,
}

impl WithSimd for Solve<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let short = self.short;
        let lanes = packed(short.count);
        begin(short, lanes);
        for _ in 0..STEPS {
            step(short, lanes);
        }
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

#[inline(always)]
const fn within_short(end: f64) -> f64 {
    if end < SHORT_FLIGHT { end } else { SHORT_FLIGHT }
}

#[inline(always)]
fn begin(short: &mut Short, lanes: usize) {
    for k in 0..lanes {
        let form = form(short, k);
        (short.last_ratio[k], short.last_velocity[k]) = form.at(SHORT_FLIGHT);
        (short.end_ratio[k], short.end_velocity[k]) = form.at(within_short(short.end[k]));
        short.time[k] = form.expected();
        short.inside[k] = short.pulled[k];
        short.landed[k] = 0;
    }
}

#[inline(always)]
fn step(short: &mut Short, lanes: usize) {
    for k in 0..lanes {
        let form = form(short, k);
        let h = short.time[k];
        let inside = short.inside[k] & mask(h > 0.0) & mask(h < within_short(short.end[k]));
        let (ratio, velocity) = form.at(h);
        let slope = velocity - ratio;
        let step = -ratio * h / slope;
        let last = inside & !short.landed[k] & mask(ShortForm::is_last(step, h, slope));
        let moves = inside & !short.landed[k];
        let landing = form.impact_velocity(h, velocity, step);
        let next = h + step;
        short.velocity[k] = if last != 0 { landing } else { short.velocity[k] };
        short.time[k] = if moves != 0 { next } else { h };
        short.landed[k] |= last;
        short.inside[k] = inside;
    }
}

impl Short {
    pub(super) const fn new() -> Self {
        const MASK: Mask = [0; LANES];
        Self {
            count: 0,
            lane: [0; LANES],
            speed: ROW,
            sine: ROW,
            cosine: ROW,
            sin: ROW,
            cos: ROW,
            angle: ROW,
            end: ROW,
            time: ROW,
            velocity: ROW,
            end_ratio: ROW,
            end_velocity: ROW,
            last_ratio: ROW,
            last_velocity: ROW,
            next_end: ROW,
            pulled: MASK,
            inside: MASK,
            landed: MASK,
        }
    }

    /// Packs the slow launches of the first `lanes` lanes; false if there are none.
    pub(super) fn collect(
        &mut self,
        lanes: usize,
        platforms: &Platforms,
        launches: &Launches,
        work: &Work,
    ) -> bool {
        let mut count = 0;
        for lane in 0..lanes {
            if work.slow[lane] == 0 {
                continue;
            }
            let (angle, peak) = (launches.angle[lane], platforms.peak[lane]);
            let separation = platforms.separation_angle[lane];
            let retention = core::f64::consts::PI - separation;
            let away = angle >= separation && angle < retention;
            let ahead = separation - angle;
            let to_separation = if ahead > 0.0 { ahead } else { ahead + TAU };
            self.lane[count] = lane as u8;
            self.speed[count] = launches.speed[lane];
            self.sin[count] = launches.sin[lane];
            self.cos[count] = launches.cos[lane];
            self.sine[count] = peak * launches.sin[lane];
            self.cosine[count] = peak * launches.cos[lane];
            self.angle[count] = angle;
            self.end[count] = if away { retention - angle } else { to_separation };
            let next = if away { 2.0 * separation } else { -2.0 * separation };
            self.next_end[count] = self.end[count] + (core::f64::consts::PI + next);
            self.pulled[count] = mask(!away && launches.speed[lane] > 0.0);
            count += 1;
        }
        self.count = count;
        count > 0
    }

    /// Marks the lanes that have landed or are doubtful; the others go on as if they had been launched faster.
    pub(super) fn judge(&self, work: &mut Work) {
        for k in 0..self.count {
            let lane = usize::from(self.lane[k]);
            // A launch from rest is legal only where the platform falls away, and then it moves off.
            let away = self.pulled[k] == 0;
            // As `short_bracket`: no root in the pieces up to half a radian, and no dip that needs a search.
            let dips = !away && self.last_velocity[k] > 0.0 && self.end_velocity[k] < 0.0;
            let second_piece = self.end_ratio[k] > 0.0 && self.next_end[k] >= SHORT_FLIGHT + 1.0e-9 && !dips;
            let flies_on = self.landed[k] == 0
                && self.last_ratio[k] > 0.0
                && (self.end[k] >= SHORT_FLIGHT || second_piece)
                && (!away || self.sine[k] >= 1.0 || self.speed[k] > 0.0);
            if flies_on {
                work.slow[lane] = 0;
            } else {
                work.settled[lane] = self.landed[k];
                // Neither of the other paths.
                work.clears[lane] = u64::MAX;
                work.slow[lane] = u64::MAX;
            }
        }
    }

    /// Writes the landings.
    pub(super) fn land(&self, impacts: &mut Impacts) {
        for k in 0..self.count {
            if self.landed[k] == 0 {
                continue;
            }
            let lane = usize::from(self.lane[k]);
            let h = self.time[k];
            let h2 = h * h;
            let (sin_h, versine) = (h - h2 * h * sine_deficit_ratio(h), h2 * versine_ratio(h));
            let (s, c) = (self.sin[k], self.cos[k]);
            let sum = self.angle[k] + h;
            let (wrapped, turns) = if sum >= TAU { (sum - TAU, 1.0) } else { (sum, 0.0) };
            impacts.angle[lane] = wrapped;
            impacts.sin[lane] = s + (c * sin_h - s * versine);
            impacts.cos[lane] = c - (s * sin_h + c * versine);
            impacts.velocity[lane] = self.velocity[k];
            impacts.turns[lane] = turns;
        }
    }
}

impl Short {
    /// Writes the durations of the flights that have landed.
    pub(super) fn write_durations(&self, durations: &mut Row) {
        for k in 0..self.count {
            if self.landed[k] != 0 {
                durations[usize::from(self.lane[k])] = self.time[k];
            }
        }
    }
}
