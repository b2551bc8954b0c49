//! Launches, drops and parameters that land *on* the seams of the problem: phases at which the angle wraps or
//! a piece ends, numbers that form thresholds, exact binary fractions, and the neighbours of all of them in
//! units of the last place.
//!
//! Random numbers never meet such a place: none of 87 million random launches, 29 million of them built to
//! graze, showed the flights that lose a period at a seam; the first thousand of these did.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::launches::{Case, SplitMix};

/// Coefficients of restitution: both ends, exact fractions, and the paper's values.
pub const RESTITUTIONS: [f64; 14] = [
    0.0,
    f64::MIN_POSITIVE,
    1.0e-12,
    0.1,
    0.25,
    1.0 / 3.0,
    0.5,
    0.724_6,
    0.75,
    0.9,
    0.99,
    1.0 - 1.0e-7,
    1.0 - 1.0e-12,
    1.0 - 0.5 * f64::EPSILON,
];

/// One of these values.
pub fn one_of<T: Copy>(random: &mut SplitMix, values: &[T]) -> T {
    values[(random.next() % values.len() as u64) as usize]
}

/// `x` or, equally often, one of its nearest neighbours among doubles.
pub fn nearby(random: &mut SplitMix, x: f64) -> f64 {
    if random.next() & 1 == 0 {
        return x;
    }
    let mut near = x;
    for _ in 0..=random.next() % 4 {
        near = if random.next() & 1 == 0 { near.next_up() } else { near.next_down() };
    }
    near
}

/// A number between 0 and 1 with few binary digits.
fn binary_fraction(random: &mut SplitMix) -> f64 {
    let bits = 1 + random.next() % 8;
    (random.next() % (1 << bits)) as f64 / (1_u64 << bits) as f64
}

/// sigma = asin(1/P), as the crate computes it.
fn separation(peak: f64) -> f64 {
    if peak > 1.0 { libm::asin(1.0 / peak) } else { FRAC_PI_2 }
}

/// The forcing at which the orbits with one impact every `k` periods are born, or the forcing of the first
/// doubling (k = 1).
pub fn threshold_forcing(random: &mut SplitMix, restitution: f64) -> f64 {
    let r = restitution;
    let k = (1 + random.next() % 4) as f64;
    let birth = k * (1.0 - r) / (1.0 + r);
    if random.next() & 1 == 0 {
        return birth;
    }
    let height = 2.0 * (1.0 + r * r) / (PI * (1.0 + r) * (1.0 + r));
    ((birth / k) * (birth / k) + height * height).sqrt()
}

/// A peak acceleration P, at most `largest`.
pub fn peak(random: &mut SplitMix, largest: f64) -> f64 {
    let exact = match random.next() % 12 {
        0 => {
            one_of(random, &[0.0, f64::from_bits(1), f64::MIN_POSITIVE, 1.0e-300, 1.0e-155, 1.0e-16, 1.0e-8])
        }
        1 | 2 => one_of(random, &[1.0, 1.0, 0.5, 2.0, 4.0, 1.5, PI, TAU, 2.0 * PI * PI, 197.392_088]),
        3 => 1.0 + random.sign() * libm::exp2(-((random.next() % 53) as f64)),
        4..=6 => {
            let r = one_of(random, &RESTITUTIONS);
            PI * threshold_forcing(random, r)
        }
        7 => binary_fraction(random),
        8 => (random.next() % 32) as f64 + binary_fraction(random),
        9 => random.decades(-3.0, 1.0),
        _ => random.decades(0.0, libm::log10(largest)),
    };
    nearby(random, exact).clamp(0.0, largest)
}

/// A phase of the platform in [0, 2 pi).
pub fn angle(random: &mut SplitMix, peak: f64) -> f64 {
    let sigma = separation(peak);
    let exact = match random.next() % 12 {
        0 | 1 => 0.0,
        2 => TAU,
        3 => FRAC_PI_2,
        4 => one_of(random, &[PI, 1.5 * PI, 0.25 * PI, 0.75 * PI]),
        5 => sigma,
        6 => PI - sigma,
        7 => TAU * binary_fraction(random),
        8 => binary_fraction(random),
        9 => {
            // The phase of an orbit with one impact per period.
            let r = one_of(random, &RESTITUTIONS);
            let cosine = PI * (1.0 - r) / ((1.0 + r) * peak);
            if cosine <= 1.0 { libm::acos(cosine) } else { 0.0 }
        }
        10 => one_of(random, &[f64::from_bits(1), 1.0e-310, 1.0e-200, 1.0e-17, 1.0e-16, 4.0e-16]),
        _ => random.angle(),
    };
    let near = nearby(random, exact);
    if near < 0.0 {
        0.0
    } else if near < TAU {
        near
    } else {
        TAU.next_down()
    }
}

/// An extreme speed, from the smallest number upwards.
fn extreme_speed(random: &mut SplitMix, longest: f64) -> f64 {
    match random.next() % 4 {
        0 => one_of(random, &[f64::from_bits(1), f64::MIN_POSITIVE, 1.0e-300, 1.0e-155, 1.0e-120, 1.0e-17]),
        1 => random.decades(-320.0, -20.0),
        2 => random.decades(-20.0, -6.0),
        _ => longest * random.unit(),
    }
}

/// A launch speed with which the disk lands a time `h` later, ignoring earlier impacts; not positive if there
/// is none.
fn speed_to_land_after(peak: f64, angle: f64, h: f64) -> f64 {
    let (s, c) = libm::sincos(angle);
    let (s1, _) = libm::sincos(angle + h);
    0.5 * h - peak * (c + (s - s1) / h)
}

/// A launch whose flight is not much longer than `longest` rad or, for the fastest platforms, than a few
/// climbs.
pub fn launch(random: &mut SplitMix, largest_peak: f64, longest: f64) -> Case {
    let peak = peak(random, largest_peak);
    let angle = angle(random, peak);
    let (s, c) = libm::sincos(angle);
    let exact = match random.next() % 10 {
        // To land on the phase of another seam, after some turns.
        0..=4 => {
            let target = self::angle(random, peak);
            let turns = (random.next() % 4) as f64
                * if random.next().is_multiple_of(8) { (longest / 30.0).floor() } else { 1.0 };
            let h = TAU * turns + target - angle;
            let h = if h > 0.0 { h } else { h + TAU };
            speed_to_land_after(peak, angle, nearby(random, h))
        }
        // To land at a phase where the solver changes its form, or at the crest.
        5 => {
            let h = one_of(random, &[0.5, 0.25, 1.0, 1.7, TAU, PI]);
            speed_to_land_after(peak, angle, nearby(random, h))
        }
        // To just reach the height of the crests.
        6 => (2.0 * peak * (1.0 - s)).sqrt() - peak * c,
        7 => PI * (1 + random.next() % 8) as f64 * one_of(random, &[0.5, 1.0, 1.0, 2.0 / 3.0, 4.0 / 3.0]),
        8 => binary_fraction(random) * one_of(random, &[1.0, 4.0, peak]),
        _ => extreme_speed(random, longest / 2.5),
    };
    let speed = nearby(random, exact);
    let speed = if speed > 0.0 && speed.is_finite() { speed } else { extreme_speed(random, longest / 2.5) };
    Case { class: "seam", peak, angle, speed, separation: false }
}

/// Gap and velocity (disk minus platform) of a disk in the air above a seam.
pub fn drop(random: &mut SplitMix, largest_peak: f64) -> (Case, f64) {
    let peak = peak(random, largest_peak);
    let angle = angle(random, peak);
    let (s, c) = libm::sincos(angle);
    let exact = match random.next() % 8 {
        0 => random.decades(-300.0, -100.0),
        1 => random.decades(-100.0, -17.0),
        2 => peak * random.decades(-20.0, -8.0),
        3 => binary_fraction(random),
        // At the height of the crests.
        4 => peak - peak * s,
        5 => random.decades(-8.0, 2.0),
        6 => 1.0,
        _ => random.decades(0.0, 4.0),
    };
    let gap = nearby(random, exact);
    let gap = if gap >= f64::MIN_POSITIVE { gap } else { 1.0e-14 };
    let exact = match random.next() % 10 {
        0 | 1 => 0.0,
        2 => random.sign() * random.decades(-160.0, -20.0),
        3 => random.sign() * random.decades(-20.0, 0.0),
        4 => -random.decades(0.0, 9.0),
        5 => -peak * c,
        // To fall past the platform with or almost without touching it.
        6 => {
            -(2.0 * gap * (peak * s - 1.0).abs()).sqrt() * (1.0 + random.sign() * random.decades(-12.0, -1.0))
        }
        7 => random.sign() * (2.0 * gap).sqrt(),
        8 => random.sign() * binary_fraction(random),
        _ => random.uniform(-3.0, 3.0) * peak.max(1.0),
    };
    let velocity = nearby(random, exact);
    (Case { class: "seam drop", peak, angle, speed: velocity, separation: false }, gap)
}
