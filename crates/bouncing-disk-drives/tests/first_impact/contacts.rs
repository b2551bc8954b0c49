//! Compliant contacts, judged event by event.
//!
//! The oracle knows the law, y'' + c y' + k y = -1 - s'', and integrates it by its Taylor series in
//! double-doubles (one start in 1000 in 77 digits): flights are k = c = 0, and no damping is special. On each piece of
//! the series the function that ends the motion is a polynomial, which falls to zero where the oracle of
//! flights says. Doubts are events that twice a stated rounding decides: 128 u times the sizes of value, slope and
//! second derivative at the start, and of the largest force. Starts aim at grazes, resonances and the edges of lift-off
//! and holding, with contact times of 1e-5 to 1e3 rad and restitutions of 0.001 to 1 - 1e-6, next to exp(-2) by ulps.
//!
//!     CAMPAIGN_SIZE=1000000 cargo test -p bouncing-disk-drives --test first_impact -- --ignored contact_campaign --nocapture
//!
//! saw 298,449 touches, 32,164 recontacts, 303,572 releases, turns to load (49,082), unload (161,321) and hold (82,686),
//! 4,286 settlings, 68,686 motions followed to the end of the search, 4,284 doubts, 984 motions in 77 digits: none was
//! missed or invented.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use bouncing_disk_core::Error;
use bouncing_disk_core::run::in_parallel;
use bouncing_disk_drives::Drive;
use bouncing_disk_drives::compliance::{
    Compliance, CompliantPlatform, ContactEnd, Pressed, RelativeState, SpringState, Touch,
};

use crate::launches::SplitMix;
use crate::numbers::{Dd, Number, dd};
use crate::oracle::{High, U};
use crate::polynomials::{derivatives, first_fall, jet};
use crate::shards;

/// Terms of a series over half of its radius: the rest is below 1e-30.
const TERMS: usize = 24;

/// Allowed rounding error of a function, in units of u times its terms.
const ROUNDING: f64 = 128.0 * U;

/// Pieces after which a motion is no longer judged.
const PIECES: f64 = 400.0;

/// A polynomial in the time since the start of its piece.
struct Polynomial([Dd; TERMS]);

impl Polynomial {
    /// Value and slope.
    fn at(&self, t: Dd) -> (Dd, Dd) {
        let [value, slope, _] = jet(&self.0, &t);
        (value, slope)
    }

    /// Bound on a derivative in [0, `to`].
    fn bound(&self, order: usize, to: f64) -> f64 {
        let factor = |m: usize| (0..order).map(|i| (m - i) as f64).product::<f64>();
        self.0[order..].iter().enumerate().rev().fold(0.0, |sum, (n, c)| {
            let m = n + order;
            sum * to + factor(m) * c.high().abs()
        })
    }
}

/// A platform's harmonics (amplitude, angle) and the weight.
#[derive(Debug, Clone)]
struct Law {
    harmonics: Vec<(f64, f64)>,
    weight: f64,
}

impl Law {
    fn size(&self, order: i32) -> f64 {
        let size = |(j, &(a, _)): (i32, &(f64, f64))| a.abs() * libm::pow(f64::from(j), f64::from(order));
        (1..).zip(&self.harmonics).map(size).sum()
    }

    /// Bound on the load 1 + s''.
    fn load(&self) -> f64 {
        self.weight + self.size(2)
    }

    /// Derivatives of the load.
    fn loads<N: Number>(&self, time: &N) -> Vec<N> {
        let mut loads = derivatives(&self.harmonics, time, TERMS + 2).split_off(2);
        loads[0] = loads[0].clone() + N::of(self.weight);
        loads
    }
}

/// The motion from a state, as pieces of equal length.
struct Motion {
    step: f64,
    rate: f64,
    /// Coefficients of the gap and of the load.
    pieces: Vec<[[Dd; TERMS]; 2]>,
}

/// The coefficients of gap, velocity, load and a constant.
type Form = [Dd; 4];

fn form(gap: f64, velocity: f64) -> Form {
    [gap, velocity, 0.0, 0.0].map(dd)
}

impl Motion {
    fn new<N: Number>(law: &Law, (k, c): (f64, f64), from: RelativeState, until: f64) -> Self {
        let rate = (k.sqrt() + c).max(law.harmonics.len() as f64).max(1.0);
        let step = if until > 0.0 { (0.5 / rate).min(0.25 * until) } else { 0.5 / rate };
        let step = libm::exp2(libm::floor(libm::log2(step.max(1e-12))));
        let (mut y, mut v) = (N::of(from.gap), N::of(from.velocity));
        let mut pieces = Vec::new();
        while pieces.is_empty() || pieces.len() as f64 * step < until {
            let time = N::of(from.time) + N::of(pieces.len() as f64 * step);
            let loads = law.loads(&time);
            let mut gap = vec![y, v];
            for m in 0..TERMS - 2 {
                let bend = loads[m].clone() + N::of(c) * gap[m + 1].clone() + N::of(k) * gap[m].clone();
                gap.push(-bend);
            }
            let (mut inverse, mut power, h) = (N::of(1.0), N::of(1.0), N::of(step));
            (y, v) = (N::of(0.0), N::of(0.0));
            let mut piece = [[dd(0.0); TERMS]; 2];
            for m in 0..TERMS {
                let coefficient = gap[m].clone() * inverse.clone();
                y = y + coefficient.clone() * power.clone();
                if m + 1 < TERMS {
                    v = v + gap[m + 1].clone() * inverse.clone() * power.clone();
                }
                piece[0][m] = coefficient.dd();
                piece[1][m] = (loads[m].clone() * inverse.clone()).dd();
                power = power * h.clone();
                inverse = inverse / N::of((m + 1) as f64);
            }
            pieces.push(piece);
        }
        Self { step, rate, pieces }
    }

    fn polynomial(&self, piece: usize, form: &Form) -> Polynomial {
        let [gap, load] = &self.pieces[piece];
        let next = |m: usize| gap.get(m + 1).map_or(dd(0.0), |&c| dd((m + 1) as f64) * c);
        let mut sum: [Dd; TERMS] =
            std::array::from_fn(|m| form[0] * gap[m] + form[1] * next(m) + form[2] * load[m]);
        sum[0] = sum[0] + form[3];
        Polynomial(sum)
    }

    fn piece_at(&self, t: f64) -> (usize, f64) {
        let piece = ((t / self.step) as usize).min(self.pieces.len() - 1);
        (piece, t - piece as f64 * self.step)
    }

    fn at(&self, form: &Form, t: f64) -> (Dd, Dd) {
        let (piece, h) = self.piece_at(t);
        self.polynomial(piece, form).at(dd(h))
    }

    /// The first time, in steps of an eighth of a piece, at which `is_there` holds and did not before.
    fn first(&self, form: &Form, is_there: impl Fn((Dd, Dd)) -> bool) -> Option<f64> {
        let mut before = false;
        for piece in 0..self.pieces.len() {
            let polynomial = self.polynomial(piece, form);
            for k in 0..8 {
                let (a, b) = (0.125 * self.step * f64::from(k), 0.125 * self.step * f64::from(k + 1));
                let here = is_there(polynomial.at(dd(b)));
                if here && !before {
                    let (mut lo, mut hi) = (dd(a), dd(b));
                    for _ in 0..100 {
                        let m = (lo + hi) * dd(0.5);
                        if is_there(polynomial.at(m)) { hi = m } else { lo = m }
                    }
                    return Some(piece as f64 * self.step + hi.high());
                }
                before = here;
            }
        }
        None
    }
}

/// A function of the motion that must stay positive up to an event, and the bound on its rounding:
/// r0 + r1 t + r2 t^2, at most `cap` (1 + rate t), in units of [`ROUNDING`].
struct Fall {
    form: Form,
    raise: [f64; 3],
    cap: f64,
}

impl Fall {
    fn raised(&self, rate: f64, from: f64, to: f64) -> [f64; 3] {
        let [r0, r1, r2] = self.raise.map(|r| r * ROUNDING);
        let here = r0 + from * (r1 + from * r2);
        let cap = self.cap * ROUNDING * (1.0 + rate * to);
        if here > cap { [cap, 0.0, 0.0] } else { [here, r1 + 2.0 * from * r2, r2] }
    }

    fn tolerance(&self, rate: f64, t: f64) -> f64 {
        self.raised(rate, t, t)[0]
    }

    /// Checks that the function is positive up to `end`, to within twice its rounding; and, if `falls`, that
    /// it falls to zero there. True if the rounding was needed.
    fn judge(&self, motion: &Motion, (start, end): (f64, f64), falls: bool) -> Result<bool, String> {
        let rounding = self.tolerance(motion.rate, end);
        let (mut doubt, mut last) = (false, end);
        if falls {
            let (piece, h) = motion.piece_at(end);
            let polynomial = motion.polynomial(piece, &self.form);
            let (value, slope) = polynomial.at(dd(h));
            let (value, slope) = (value.high(), slope.high());
            let legal = rounding + slope.abs() * 4.0 * U * end;
            let touch = (2.0 * legal * polynomial.bound(2, h)).sqrt();
            let rises = slope > 2.0 * touch + ROUNDING * (self.raise[1] + self.raise[2] * end);
            let off = if end == 0.0 { value } else { value.abs() };
            if off > legal || rises && value >= -legal {
                return Err(format!("no root at {end:e}: {value:e} {slope:e}, legal {legal:e} {touch:e}"));
            }
            doubt = slope > -touch;
            last = if doubt { end } else { end - 2.0 * legal / slope.abs() };
        }
        for piece in motion.piece_at(start).0..=motion.piece_at(end).0 {
            let at = piece as f64 * motion.step;
            let (from, to) = ((start - at).max(0.0), (end - at).min(motion.step));
            let mut polynomial = motion.polynomial(piece, &self.form);
            let sure = (last - at).min(to);
            // A start that is zero within rounding is not a root.
            let starts = from > 0.0 || piece == 0 && polynomial.0[0].high() <= 2.0 * ROUNDING * self.raise[0];
            let open = first_fall(&polynomial.0, dd(from), dd(sure)).is_some();
            if !open && sure >= to {
                continue;
            }
            doubt |= open && !starts;
            for (c, r) in polynomial.0.iter_mut().zip(self.raised(motion.rate, at, at + to)) {
                *c = *c + dd(2.0 * r);
            }
            if let Some((after, before)) = first_fall(&polynomial.0, dd(from), dd(to)) {
                return Err(format!("missed from {at:e} on, between {after:?} and {before:?}"));
            }
        }
        Ok(doubt)
    }
}

/// A platform, with the data that the oracle needs.
struct Contact {
    law: Law,
    platform: CompliantPlatform,
    spring: (f64, f64),
    unloading: f64,
    hysteretic: bool,
}

impl Contact {
    fn new(harmonics: Vec<(f64, f64)>, compliance: Compliance) -> Self {
        Self {
            platform: CompliantPlatform::new(Drive::fourier(&harmonics).unwrap(), compliance).unwrap(),
            law: Law { harmonics, weight: 1.0 },
            spring: (compliance.stiffness(), compliance.damping()),
            unloading: compliance.unloading_stiffness(),
            hysteretic: compliance.damping() == 0.0,
        }
    }

    fn motion(&self, spring: (f64, f64), from: RelativeState, until: f64, wide: bool) -> Motion {
        if wide {
            Motion::new::<High>(&self.law, spring, from, until)
        } else {
            Motion::new::<Dd>(&self.law, spring, from, until)
        }
    }

    fn gap(&self, from: RelativeState, sign: f64) -> Fall {
        let high = if from.gap > 0.0 { 2.0 * self.law.size(0) } else { 0.0 };
        let raise = [from.gap.abs() + high, from.velocity.abs(), self.law.load()];
        Fall { form: form(sign, 0.0), raise, cap: f64::INFINITY }
    }

    fn velocity(&self, (k, c): (f64, f64), from: RelativeState, sign: f64) -> Fall {
        let bend = self.law.load() + k * from.gap.abs() + c * from.velocity.abs();
        let bend = bend + self.gain((k, c));
        let third = self.law.size(3) + k * from.velocity.abs() + c * bend;
        Fall { form: form(0.0, sign), raise: [from.velocity.abs(), bend, third], cap: f64::INFINITY }
    }

    /// The force in contact, with the spring on this branch.
    fn force(&self, (k, c): (f64, f64), from: RelativeState, most: f64, sign: f64) -> Fall {
        let force = k * from.gap.abs() + c * from.velocity.abs();
        let bend = self.law.load() + force;
        let slope = k * from.velocity.abs() + c * bend;
        let gain = if most.is_finite() { self.gain((k, c)) } else { 0.0 };
        let raise = [force, slope, k * (bend + gain) + c * (slope + self.law.size(3))];
        Fall { form: form(-sign * k, -sign * c), raise, cap: most + self.law.load() + gain }
    }

    /// The time span that is judged.
    fn horizon(&self, (k, c): (f64, f64)) -> f64 {
        0.25 * PIECES / (k.sqrt() + c).max(self.law.harmonics.len() as f64).max(1.0)
    }

    /// The pull that counts as zero for a disk that lies on the platform without a force: twice the value
    /// stated in docs/numerics-impacts.md.
    fn pull(&self, from: RelativeState) -> f64 {
        let lies = from.gap == 0.0 && from.velocity == 0.0;
        if lies { 2e-12 * self.law.load() + 16.0 * U * TAU * self.law.size(3) } else { 0.0 }
    }

    /// The largest gain of the forced oscillation of the force: large near a resonance, as is the free
    /// oscillation against it.
    fn gain(&self, (k, c): (f64, f64)) -> f64 {
        let gain = |(j, &(a, _)): (i32, &(f64, f64))| {
            let j = f64::from(j);
            a.abs() * j * j * libm::hypot(k, c * j) / libm::hypot(k - j * j, c * j)
        };
        if self.hysteretic { 0.0 } else { (1..).zip(&self.law.harmonics).map(gain).sum() }
    }

    fn near(&self, what: &str, found: f64, exact: Dd, legal: f64) -> Result<(), String> {
        let off = (exact - dd(found)).high().abs();
        if off <= legal { Ok(()) } else { Err(format!("{what} {found:e}, off by {off:e}, legal {legal:e}")) }
    }

    fn judge_time(&self, from: f64, span: f64, to: f64) -> Result<(), String> {
        let turns = ((from + span - to) / TAU).round();
        let off = dd(from) + dd(span) - dd(to) - dd(turns) * (Dd::PI + Dd::PI);
        let legal = (0.0..TAU).contains(&to) && off.high().abs() <= 4.0 * U * (TAU + span);
        if legal { Ok(()) } else { Err(format!("time {to:e} {span:e} after {from:e}")) }
    }

    /// Judges a flight to the next touch: true if it is in doubt.
    fn judge_touch(
        &self,
        from: RelativeState,
        touch: Option<&Touch>,
        limit: f64,
        wide: bool,
    ) -> Result<bool, String> {
        let end = touch.map_or(limit, |touch| touch.duration);
        let motion = self.motion((0.0, 0.0), from, end, wide);
        if let Some(touch) = touch {
            self.judge_time(from.time, end, touch.state.time)?;
            let fall = self.velocity((0.0, 0.0), from, 1.0);
            let (velocity, bend) = motion.at(&fall.form, end);
            let legal = fall.tolerance(motion.rate, end)
                + (2.0 * self.gap(from, 1.0).tolerance(motion.rate, end) * bend.high().abs()).sqrt();
            let legal = if from.gap < 0.0 { legal * 4.0 } else { legal };
            self.near("velocity", touch.state.velocity, velocity, legal)?;
        }
        let at_once = touch.is_some_and(|touch| touch.duration == 0.0);
        if from.gap == 0.0 && from.velocity < 0.0 {
            return if at_once { Ok(false) } else { Err("flies below the platform".to_owned()) };
        }
        let load = motion.at(&[0.0, 0.0, 1.0, 0.0].map(dd), 0.0).0.high();
        let pull = self.pull(from);
        if from.gap == 0.0 && from.velocity == 0.0 {
            if at_once {
                let held = load >= -pull;
                return if held { Ok(load < pull) } else { Err(format!("held by a load {load:e}")) };
            }
            let mut fall = self.gap(from, 1.0);
            fall.raise[2] += pull / ROUNDING;
            return fall.judge(&motion, (0.0, end), touch.is_some());
        }
        if from.gap >= 0.0 {
            return self.gap(from, 1.0).judge(&motion, (0.0, end), touch.is_some());
        }
        let pulled = self.force(self.spring, from, f64::INFINITY, -1.0);
        if touch.is_some_and(|touch| touch.state.gap < 0.0) {
            let free = self.gap(from, -1.0).judge(&motion, (0.0, end), false)?;
            return Ok(pulled.judge(&motion, (0.0, end), true)? || free);
        }
        // It rises until the spring presses, as long as it can become free.
        let top = motion.first(&form(0.0, 1.0), |(velocity, _)| velocity.high() < 0.0);
        let top = top.unwrap_or(end).min(end);
        let free = |t: f64| motion.at(&form(1.0, 0.0), t).0.high() > 0.0;
        if !free(top) {
            // It may touch zero from below.
            let doubt = pulled.judge(&motion, (0.0, end), false)?;
            return Ok(self.gap(from, -1.0).judge(&motion, (0.0, end), touch.is_some())? || doubt);
        }
        let (mut below, mut freed) = (0.0, top);
        for _ in 0..80 {
            let m = 0.5 * (below + freed);
            if free(m) { freed = m } else { below = m }
        }
        let doubt = pulled.judge(&motion, (0.0, freed), false)?;
        Ok(self.gap(from, 1.0).judge(&motion, (freed, end), touch.is_some())? || doubt)
    }

    /// Judges a contact to its next event.
    fn judge_end(
        &self,
        pressed: &Pressed,
        end: Option<ContactEnd>,
        limit: f64,
        wide: bool,
    ) -> Result<bool, String> {
        let from = *pressed.from();
        let (span, falls) = match end {
            Some(ContactEnd::Release(t) | ContactEnd::Turns(t, _)) => (t, true),
            Some(ContactEnd::Settles(t)) => (t, false),
            None => (limit, false),
        };
        let spring = match pressed.spring_state() {
            SpringState::Unloading => (self.unloading, 0.0),
            _ => self.spring,
        };
        let settles = matches!(end, Some(ContactEnd::Settles(_)));
        // A settled disk is followed for a period, if this can be judged.
        let on = if settles { TAU.min(self.horizon(spring)) } else { 0.0 };
        let motion = self.motion(spring, from, span + on, wide);
        let load = [0.0, 0.0, 1.0, 0.0].map(dd);
        if pressed.spring_state() == SpringState::Held {
            let size = self.law.load() + self.spring.0 * from.gap.abs();
            let edge = |sign: f64, k: f64| Fall {
                form: [dd(0.0), dd(0.0), dd(sign), dd(sign) * dd(k) * dd(from.gap)],
                raise: [3.0 * size + self.pull(from) / ROUNDING, self.law.size(3), 0.0],
                cap: 4.0 * size + self.pull(from) / ROUNDING,
            };
            let (unloads, loads) = (edge(1.0, self.unloading), edge(-1.0, self.spring.0));
            let to = |branch| matches!(end, Some(ContactEnd::Turns(_, to)) if to == branch);
            let doubt = unloads.judge(&motion, (0.0, span), to(SpringState::Unloading))?;
            return Ok(loads.judge(&motion, (0.0, span), to(SpringState::Loading))? || doubt);
        }
        let (velocity, _) = motion.at(&form(0.0, 1.0), span);
        let load_here = motion.at(&load, 0.0).0.high();
        let (k, c) = spring;
        let most = motion.pieces.iter().map(|[gap, _]| k * gap[0].high().abs() + c * gap[1].high().abs());
        let mut force = self.force(spring, from, most.fold(0.0, f64::max), 1.0);
        let moves = self.velocity(
            spring,
            from,
            if pressed.spring_state() == SpringState::Loading { -1.0 } else { 1.0 },
        );
        let off = moves.tolerance(motion.rate, span).min(
            ROUNDING
                * (from.velocity.abs() + span * (force.cap + self.law.load()))
                * (1.0 + motion.rate * span),
        );
        if let Some(ContactEnd::Release(_)) = end {
            let released = pressed.released(span);
            self.judge_time(from.time, span, released.time)?;
            let exact = if velocity.high() > 0.0 { velocity } else { dd(0.0) };
            self.near("released", released.velocity, exact, off)?;
        }
        if !self.hysteretic {
            let put_down = load_here.abs() <= self.pull(from);
            if put_down {
                force.raise[0] += 2.0 * self.pull(from) / ROUNDING;
                force.cap += 2.0 * self.pull(from) / ROUNDING;
            }
            let doubt = force.judge(&motion, (0.0, span + on), falls)?;
            if settles {
                let steady = self.platform.steady().map_err(|error| error.to_string())?;
                let (gap, drive) = (motion.at(&form(1.0, 0.0), span).0, self.platform.drive());
                let time = from.time + span;
                let follows = steady.height(time) - drive.height(time) - 1.0 / k;
                let size = self.law.size(0) + 1.0 / k + force.cap / k + TAU * self.law.size(1);
                self.near("settled", follows, gap, 4.0 * ROUNDING * size * (1.0 + span))?;
            }
            return Ok(doubt);
        }
        let turns = matches!(end, Some(ContactEnd::Turns(..)));
        let mut doubt = moves.judge(&motion, (0.0, span), turns)?;
        if pressed.spring_state() == SpringState::Unloading {
            doubt |= force.judge(&motion, (0.0, span), falls && !turns)?;
        }
        if let Some(ContactEnd::Turns(_, to)) = end {
            let turned = pressed.turned(span);
            self.judge_time(from.time, span, turned.time)?;
            let gap = motion.at(&form(1.0, 0.0), span).0;
            let legal = self.gap(RelativeState { gap: -from.gap.abs(), ..from }, 1.0).tolerance(1.0, span);
            // The velocities of disk and platform are rounded.
            let legal = legal + 4.0 * U * span * (self.law.size(1) + from.velocity.abs());
            self.near("turned", turned.gap, gap, legal)?;
            let load = motion.at(&load, span).0.high();
            let (low, high) = (-self.unloading * gap.high(), -self.spring.0 * gap.high());
            let rounding = 3.0 * ROUNDING * (self.law.load() + high + (span + 1.0) * self.law.size(3))
                + self.spring.0 * legal;
            let right = match to {
                SpringState::Loading => load > high - rounding,
                SpringState::Unloading => load < low + rounding,
                SpringState::Held => low - rounding <= load && load <= high + rounding,
            };
            doubt |= (load - low).abs() <= rounding || (load - high).abs() <= rounding;
            if !right {
                return Err(format!(
                    "{to:?} at load {load:e} between {low:e} and {high:e}, rounding {rounding:e}"
                ));
            }
        }
        Ok(doubt)
    }

    /// Changes the velocity (or the gap) so that the first minimum of the form is `depth`.
    fn aimed(
        &self,
        spring: (f64, f64),
        mut from: RelativeState,
        form: &Form,
        by: bool,
        depth: f64,
    ) -> RelativeState {
        let minimum = |from: RelativeState| {
            let motion = Motion::new::<Dd>(&self.law, spring, from, 0.1 * self.horizon(spring));
            let t = motion.first(form, |(_, slope)| slope.high() > 0.0)?;
            (motion.at(form, 0.0).1.high() < 0.0).then(|| motion.at(form, t).0.high())
        };
        let changed = |from: RelativeState, step: f64| {
            if by {
                RelativeState { velocity: from.velocity + step, ..from }
            } else {
                RelativeState { gap: from.gap + step, ..from }
            }
        };
        for _ in 0..6 {
            let size = if by { from.velocity } else { from.gap };
            let step = 1e-4 * size.abs() + 1e-9;
            let (Some(here), Some(there)) = (minimum(from), minimum(changed(from, step))) else {
                return from;
            };
            let next = changed(from, (depth - here) * step / (there - here));
            if !(next.gap.abs() < 1e9 && next.velocity.abs() < 1e6) {
                return from;
            }
            from = next;
        }
        from
    }
}

/// A number a few doubles away.
fn nudged(random: &mut SplitMix, x: f64) -> f64 {
    let by = random.below(7) as i64 - 3;
    f64::from_bits((x.to_bits() as i64 + by).max(0) as u64)
}

fn restitution(random: &mut SplitMix) -> f64 {
    let critical = libm::exp(-2.0);
    match random.below(8) {
        0 => 0.001,
        1 => nudged(random, critical),
        2 => critical * (1.0 + random.sign() * random.decades(-15.0, -3.0)),
        3 => 1.0 - random.decades(-6.0, -2.0),
        4 => random.decades(-3.0, -0.01),
        _ => random.uniform(0.05, 0.95),
    }
}

fn contact(random: &mut SplitMix) -> Contact {
    let size = match random.below(6) {
        0 => 1.0 + random.sign() * random.decades(-15.0, -1.0),
        1 => random.decades(-2.0, 0.0),
        2 => random.decades(0.0, 2.0),
        _ => random.uniform(1.0, 8.0),
    };
    let harmonics: Vec<_> = match random.below(2) {
        0 => vec![(size, 0.0)],
        _ => (1..=1 + random.below(4))
            .map(|j| (random.uniform(-1.0, 1.0) * size / (j * j) as f64, random.angle()))
            .collect(),
    };
    let (e, law) = (restitution(random), random.below(2));
    let time = match random.below(8) {
        0 => 1e-5,
        1 => 1e3,
        2 => random.decades(-5.0, 3.0),
        3 => {
            // At or near a resonance of a spring that loads or unloads.
            let share = if law == 0 { 1.0 } else { 0.5 * (1.0 + [e, 1.0 / e][random.below(2)]) };
            PI * share / (1 + random.below(4)) as f64 * (1.0 + random.decades(-17.0, -1.0))
        }
        _ => random.decades(-1.5, 1.5),
    };
    let compliance = LAWS[law](time, e);
    Contact::new(harmonics, compliance.unwrap())
}

fn phase(random: &mut SplitMix, contact: &Contact) -> f64 {
    let size = contact.law.size(2).max(1.0);
    let seam = match random.below(8) {
        0 => 0.0,
        1 => TAU,
        2 => FRAC_PI_2,
        3 => libm::asin(1.0 / size),
        4 => PI - libm::asin(1.0 / size),
        _ => return random.angle(),
    };
    nudged(random, seam).min(TAU.next_down())
}

/// The next motion of the disk.
#[derive(Debug)]
enum Next {
    Flies(RelativeState),
    Presses(SpringState, RelativeState),
}

fn start(random: &mut SplitMix, contact: &Contact) -> Next {
    let time = phase(random, contact);
    let platform = &contact.platform;
    let (k, c) = contact.spring;
    let scale = contact.law.load();
    let slow = |random: &mut SplitMix| match random.below(3) {
        0 => 0.0,
        1 => random.decades(-12.0, -3.0),
        _ => scale * random.uniform(0.0, 2.0),
    };
    let depth = random.sign() * random.decades(-15.0, -3.0);
    let load = 1.0 + platform.drive().acceleration(time);
    let in_contact = |random: &mut SplitMix| {
        let sag = scale / k.max(contact.unloading) * random.uniform(0.0, 2.0);
        let speed = sag * k.sqrt() * random.uniform(-1.0, 1.0);
        let state = RelativeState { time, gap: -sag, velocity: speed };
        // The force presses.
        if k * sag < c * speed { RelativeState { velocity: -speed, ..state } } else { state }
    };
    let pressed = match random.below(10) {
        0 => return Next::Flies(RelativeState { time, gap: 0.0, velocity: slow(random) }),
        1 => return Next::Flies(RelativeState { time, gap: 0.0, velocity: -slow(random) }),
        2 => {
            let from =
                RelativeState { time, gap: slow(random).max(1e-12), velocity: random.uniform(-1.0, 2.0) };
            let aimed = contact.aimed((0.0, 0.0), from, &form(1.0, 0.0), false, depth);
            return Next::Flies(if aimed.gap > 0.0 { aimed } else { from });
        }
        3 => {
            // After a release.
            let velocity = slow(random);
            let from = RelativeState { time, gap: -c / k * velocity, velocity };
            if random.below(2) == 0 {
                return Next::Flies(from);
            }
            let aimed = contact.aimed((0.0, 0.0), from, &form(k, c), true, depth * k);
            let velocity = aimed.velocity.max(0.0);
            return Next::Flies(RelativeState { gap: -c / k * velocity, velocity, ..from });
        }
        4 => RelativeState { velocity: -slow(random), time, gap: 0.0 },
        5 => platform.resting(nudged(random, time).min(TAU.next_down())),
        6 if contact.hysteretic => {
            // At an edge of the branches.
            let k = if random.below(2) == 0 { k } else { contact.unloading };
            let gap =
                -nudged(random, load.max(1e-100) / k) * (1.0 + random.sign() * random.decades(-17.0, -8.0));
            RelativeState { time, gap, velocity: 0.0 }
        }
        7 if contact.hysteretic => {
            // Held, with the load this close to an edge.
            let most = (0..400).map(|i| platform.drive().acceleration(TAU * f64::from(i) / 400.0));
            let (low, high) = most.fold((0.0_f64, 0.0_f64), |(low, high), a| (low.min(a), high.max(a)));
            let gap = if random.below(2) == 0 {
                -(1.0 + high + depth) / k
            } else {
                -(1.0 + low + depth) / contact.unloading
            };
            RelativeState { time, gap: gap.min(0.0), velocity: 0.0 }
        }
        6..=8 => {
            let from = in_contact(random);
            let (form, spring) = if !contact.hysteretic {
                (form(-k, -c), contact.spring)
            } else if from.velocity < 0.0 {
                (form(0.0, -1.0), contact.spring)
            } else {
                (form(-contact.unloading, 0.0), (contact.unloading, 0.0))
            };
            let aimed = contact.aimed(spring, from, &form, true, depth);
            let legal = aimed.gap < 0.0 && platform.force(aimed) > 0.0;
            if legal { aimed } else { from }
        }
        _ => in_contact(random),
    };
    Next::Presses(platform.spring_state(pressed), pressed)
}

const KINDS: [&str; 10] = [
    "touches",
    "recontacts",
    "releases",
    "loading",
    "unloading",
    "holding",
    "settled",
    "unfinished",
    "doubts",
    "wide",
];

#[derive(Default)]
struct Tally {
    /// Events of each kind, doubts among them, and events judged in 77 digits.
    counts: [u64; 10],
    failures: Vec<String>,
}

impl Tally {
    /// Follows up to twelve events.
    fn follow(&mut self, contact: &Contact, start: Next, wide: bool) {
        let (mut next, mut standstill) = (start, 0);
        for _ in 0..12 {
            let (text, judged, kind, then) = match next {
                Next::Flies(from) => {
                    let limit = contact.horizon((0.0, 0.0));
                    let found = contact.platform.touch(from, limit);
                    let text = format!("flies {from:?} {found:?}");
                    let judged = found.as_ref().map_err(Error::to_string);
                    let judged =
                        judged.and_then(|touch| contact.judge_touch(from, touch.as_ref(), limit, wide));
                    let then = found.ok().flatten().map(|Touch { state, duration, .. }| {
                        (Next::Presses(contact.platform.spring_state(state), state), duration)
                    });
                    let kind = match then {
                        Some((Next::Presses(_, state), _)) => usize::from(state.gap < 0.0),
                        _ => 7,
                    };
                    (text, judged, kind, then)
                }
                Next::Presses(branch, from) => {
                    let pressed = contact.platform.press_on(branch, from);
                    let limit = contact.horizon(contact.spring);
                    let found = pressed.end(limit);
                    let text = format!("presses {branch:?} {from:?} {found:?}");
                    let judged = found.as_ref().map_err(Error::to_string);
                    let judged = judged.and_then(|&end| contact.judge_end(&pressed, end, limit, wide));
                    let (kind, then) = match found {
                        Ok(Some(ContactEnd::Release(t))) => (2, Some((Next::Flies(pressed.released(t)), t))),
                        Ok(Some(ContactEnd::Turns(t, to))) => {
                            (3 + to as usize, Some((Next::Presses(to, pressed.turned(t)), t)))
                        }
                        Ok(Some(ContactEnd::Settles(_))) => (6, None),
                        _ => (7, None),
                    };
                    (text, judged, kind, then)
                }
            };
            self.counts[kind] += 1;
            self.counts[9] += u64::from(wide);
            let stands = then.as_ref().is_some_and(|then| then.1 == 0.0);
            standstill = if stands { standstill + 1 } else { 0 };
            let judged = if standstill > 4 { Err("no time passes".to_owned()) } else { judged };
            match judged {
                Ok(doubt) => self.counts[8] += u64::from(doubt),
                Err(reason) => {
                    let (compliance, harmonics) = (contact.platform.compliance(), &contact.law.harmonics);
                    self.failures.push(format!("{reason}\n  {text}\n  {compliance:?} {harmonics:?}"));
                    return;
                }
            }
            let Some(then) = then else { return };
            next = then.0;
        }
    }
}

fn attack(seed: u64, events: u64) -> Tally {
    let mut random = SplitMix::new(seed);
    let mut tally = Tally::default();
    while tally.counts[..8].iter().sum::<u64>() < events {
        let contact = contact(&mut random);
        for _ in 0..4 {
            let start = start(&mut random, &contact);
            tally.follow(&contact, start, random.below(1000) == 0);
        }
    }
    tally
}

/// Runs the campaign in 16 parts.
#[allow(clippy::print_stdout, reason = "asked for, to update the documented numbers")]
fn campaign(seed: u64, events: u64) {
    let tallies = in_parallel(16, |part| attack(seed + part as u64, events / 16));
    for (kind, name) in KINDS.iter().enumerate() {
        println!("{name} {}", tallies.iter().map(|tally| tally.counts[kind]).sum::<u64>());
    }
    let failures: Vec<_> = tallies.into_iter().flat_map(|tally| tally.failures).collect();
    assert!(failures.is_empty(), "{}: {}", failures.len(), failures[..failures.len().min(4)].join("\n"));
}

#[test]
fn contacts_on_seams() {
    campaign(300, 20_000);
}

#[test]
#[ignore = "a campaign of some minutes"]
fn contact_campaign() {
    campaign(shards::seed(300), shards::size(1_000_000));
}

/// Contact time and restitution without weight on a platform at rest, from an independent first root of the
/// force.
#[test]
fn isolated_impacts_last_and_rebound_as_they_say() {
    let critical = libm::exp(-2.0);
    let mut restitutions = vec![0.001, 0.05, 0.5, 0.9, 1.0 - 1e-6];
    restitutions.extend([critical, critical * (1.0 - 1e-8), critical * (1.0 + 1e-8)]);
    restitutions.extend([-1_i64, 1].map(|by| f64::from_bits((critical.to_bits() as i64 + by) as u64)));
    let law = Law { harmonics: Vec::new(), weight: 0.0 };
    let mut worst = (0.0_f64, 0.0_f64);
    for e in restitutions {
        for time in [1e-5, 0.5, 1e3] {
            let damped = Compliance::new(time, e).unwrap();
            let (k, c) = (damped.stiffness(), damped.damping());
            let from = RelativeState { time: 0.0, gap: 0.0, velocity: -1.0 };
            let motion = Motion::new::<High>(&law, (k, c), from, 1.1 * time);
            let lasts = motion.first(&form(-k, -c), |(force, _)| force.high() < 0.0).unwrap();
            let kept = motion.at(&form(0.0, 1.0), lasts).0.high();
            // The spring that unloads: a quarter of a period of each stiffness.
            let spring = Compliance::hysteretic(time, e).unwrap();
            let (k, k2) = (spring.stiffness(), spring.unloading_stiffness());
            let motion = Motion::new::<High>(&law, (k, 0.0), from, time);
            let turned = motion.first(&form(0.0, 1.0), |(velocity, _)| velocity.high() > 0.0).unwrap();
            let from =
                RelativeState { gap: motion.at(&form(1.0, 0.0), turned).0.high(), velocity: 0.0, ..from };
            let motion = Motion::new::<High>(&law, (k2, 0.0), from, time);
            let freed = motion.first(&form(1.0, 0.0), |(gap, _)| gap.high() > 0.0).unwrap();
            let sprung = motion.at(&form(0.0, 1.0), freed).0.high();
            for (compliance, lasts, kept) in [(damped, lasts, kept), (spring, turned + freed, sprung)] {
                for off in [lasts - time, lasts - compliance.contact_time()] {
                    worst.0 = worst.0.max(off.abs() / time);
                }
                for off in [kept - e, kept - compliance.restitution()] {
                    worst.1 = worst.1.max(off.abs() / e);
                }
            }
        }
    }
    assert!(worst.0 < 1e-15 && worst.1 < 4e-15, "{worst:?}");
}

/// The disk after a contact with this start.
fn rebound(platform: &CompliantPlatform, mut from: RelativeState) -> RelativeState {
    let mut branch = platform.spring_state(from);
    loop {
        let pressed = platform.press_on(branch, from);
        match pressed.end(f64::INFINITY).unwrap().unwrap() {
            ContactEnd::Release(t) => return pressed.released(t),
            ContactEnd::Turns(t, to) => (branch, from) = (to, pressed.turned(t)),
            ContactEnd::Settles(_) => panic!("settles"),
        }
    }
}

type Make = fn(f64, f64) -> Result<Compliance, Error>;

/// Both laws of a contact, by contact time and restitution.
const LAWS: [Make; 2] = [Compliance::new, Compliance::hysteretic];

/// The exponents with which a difference falls from each contact time to the next, a tenth of it.
pub fn exponents(differences: &[f64]) -> Vec<f64> {
    differences.windows(2).map(|pair| libm::log10(pair[0] / pair[1])).collect()
}

#[test]
fn brief_contacts_rebound_as_rigid_ones_to_first_order() {
    for law in LAWS {
        for e in [0.05, 0.5, 0.9] {
            for time in [0.3, 1.7, 4.0, 6.0] {
                let differences = [1e-3, 1e-4, 1e-5, 1e-6].map(|lasts| {
                    let drive = Drive::fourier(&[(2.5, 0.0)]).unwrap();
                    let platform = CompliantPlatform::new(drive, law(lasts, e).unwrap()).unwrap();
                    let after = rebound(&platform, RelativeState { time, gap: 0.0, velocity: -3.0 });
                    (after.velocity - 3.0 * e).abs() / (3.0 * e)
                });
                let orders = exponents(&differences);
                assert!(orders.iter().all(|&order| order > 0.9), "{e} {time}: {differences:?} {orders:?}");
            }
        }
    }
}
