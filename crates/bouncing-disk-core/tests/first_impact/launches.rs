//! Hard launches, and random ones.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use bouncing_disk_core::numerics::random::SplitMix64;

/// One launch. Its numbers are exact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Case {
    pub class: &'static str,
    /// P.
    pub peak: f64,
    /// Launch phase; not used for a launch from `separation`.
    pub angle: f64,
    /// Relative launch speed.
    pub speed: f64,
    /// Whether it is a launch from rest at the exact phase of separation, asin(1/P).
    pub separation: bool,
}

/// Random launches from a seed.
pub struct SplitMix(SplitMix64);

impl SplitMix {
    pub fn new(seed: u64) -> Self {
        Self(SplitMix64::new(seed))
    }

    pub fn next(&mut self) -> u64 {
        self.0.next_number()
    }

    /// A number in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Ten to a power that is uniform in an interval.
    pub fn decades(&mut self, low: f64, high: f64) -> f64 {
        libm::exp10(self.uniform(low, high))
    }

    pub fn sign(&mut self) -> f64 {
        if self.next() & 1 == 0 { 1.0 } else { -1.0 }
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    pub fn angle(&mut self) -> f64 {
        let angle = TAU * self.unit();
        if angle < TAU { angle } else { 0.0 }
    }
}

/// A peak acceleration and the name of its range.
pub fn peak(random: &mut SplitMix) -> (&'static str, f64) {
    match random.below(10) {
        0 => ("P = 0", 0.0),
        1 => ("P < 1", random.unit()),
        2 => ("P near 1", 1.0 + random.sign() * random.decades(-12.0, -2.0)),
        3 => ("P = 1", 1.0),
        4..=6 => ("P to 10", random.uniform(1.0, 10.0)),
        7..=8 => ("P to 1e3", random.decades(1.0, 3.0)),
        _ => ("P to 1e6", random.decades(3.0, 6.0)),
    }
}

/// A peak acceleration above 1.
fn peak_above_one(random: &mut SplitMix) -> f64 {
    match random.below(6) {
        0 => 1.0 + random.decades(-12.0, -2.0),
        1..=3 => random.uniform(1.01, 10.0),
        4 => random.decades(1.0, 3.0),
        _ => random.decades(3.0, 6.0),
    }
}

/// A launch of any kind from any phase.
pub fn random(random: &mut SplitMix) -> Case {
    let (class, peak) = peak(random);
    let angle = random.angle();
    let speed = match random.below(4) {
        // As a share of the platform's speed.
        0 | 1 => random.decades(-12.0, 0.8) * if peak > 0.0 { peak } else { 1.0 },
        // Many periods, up to 5e5.
        2 => PI * random.decades(-9.0, 5.69),
        // Of the order of the platform's speed.
        _ => random.uniform(0.0, 4.0) * peak.max(0.1),
    };
    Case { class, peak, angle, speed: speed.max(1.0e-300), separation: false }
}

/// A launch from rest when the platform begins to fall away.
pub fn separation(random: &mut SplitMix) -> Case {
    let peak = match random.below(3) {
        0 => 1.0 + random.decades(-15.0, -2.0),
        1 => random.uniform(1.0, 20.0),
        _ => random.decades(0.0, 6.0),
    };
    let peak = if peak > 1.0 { peak } else { 1.0 + f64::EPSILON };
    Case { class: "separation", peak, angle: 0.0, speed: 0.0, separation: true }
}

/// A launch from the edge of a zone.
pub fn boundary(random: &mut SplitMix) -> Case {
    let (_, peak) = peak(random);
    let sigma = if peak > 1.0 { libm::asin(1.0 / peak) } else { FRAC_PI_2 };
    let angle = match random.below(7) {
        0 => sigma,
        1 => PI - sigma,
        2 => FRAC_PI_2,
        3 => 0.0,
        4 => TAU.next_down(),
        5 => PI,
        _ => 1.5 * PI,
    };
    let angle = match random.below(4) {
        0 => angle.next_up(),
        1 if angle > 0.0 => angle.next_down(),
        _ => angle,
    };
    let angle = if angle < TAU { angle } else { TAU.next_down() };
    let speed = random.decades(-12.0, 0.8) * if peak > 0.0 { peak } else { 1.0 };
    Case { class: "boundary", peak, angle, speed, separation: false }
}

/// A slow launch near the phases at which the weight of a resting disk vanishes, P sin tau = 1.
pub fn chattering(random: &mut SplitMix) -> Case {
    let peak = if random.below(4) == 0 {
        1.0 + random.sign() * random.decades(-12.0, -1.0)
    } else {
        peak_above_one(random)
    };
    let sigma = if peak > 1.0 { libm::asin(1.0 / peak) } else { FRAC_PI_2 };
    let near = if random.below(2) == 0 { sigma } else { PI - sigma };
    let angle = near + random.sign() * random.decades(-12.0, -1.0);
    let angle = angle.clamp(0.0, TAU.next_down());
    let speed = peak * random.decades(-14.0, -2.0);
    Case { class: "chattering", peak, angle, speed, separation: false }
}

/// A flight of almost a whole number of periods.
pub fn whole_periods(random: &mut SplitMix) -> Case {
    let (_, peak) = peak(random);
    let angle = random.angle();
    let (_, cosine) = libm::sincos(angle);
    let periods = random.decades(0.0, 5.69).floor();
    let mut speed = PI * periods - peak * cosine;
    if speed <= 0.0 {
        speed = PI * periods;
    }
    Case { class: "whole periods", peak, angle, speed, separation: false }
}

/// A flight backwards in time from a phase at which the disk has a given gap and velocity.
struct Backward {
    peak: f64,
    sin: f64,
    cos: f64,
    gap: f64,
    velocity: f64,
}

impl Backward {
    /// The gap at a time `t` earlier.
    fn gap_before(&self, t: f64) -> f64 {
        let (s, _) = libm::sincos(t);
        let half = libm::sin(0.5 * t);
        let versine = 2.0 * half * half;
        let deficit = if t > 0.3 {
            t - s
        } else {
            let z = t * t;
            t * z / 6.0 * (1.0 - z / 20.0 * (1.0 - z / 42.0 * (1.0 - z / 72.0 * (1.0 - z / 110.0))))
        };
        (self.gap - self.velocity * t - 0.5 * t * t) + self.peak * (self.sin * versine - self.cos * deficit)
    }

    fn velocity_before(&self, t: f64) -> f64 {
        let (s, _) = libm::sincos(t);
        let half = libm::sin(0.5 * t);
        let versine = 2.0 * half * half;
        (self.velocity + t) + self.peak * (self.cos * versine - self.sin * s)
    }

    /// The time from the launch, and the largest gap since. The search starts at `from`, where the gap should
    /// be positive; the disk cannot have been launched above the crests.
    fn launch(&self, from: f64) -> Option<(f64, f64)> {
        let speed = self.velocity + self.peak * self.cos;
        let height = self.gap + self.peak * (self.sin - 1.0);
        let radicand = speed * speed + 2.0 * height;
        let free = if radicand > 0.0 && speed < 0.0 {
            let root = radicand.sqrt();
            (-speed - root, -speed + root)
        } else {
            (f64::INFINITY, f64::INFINITY)
        };
        let mut largest = 0.0_f64;
        let mut before = from;
        let mut t = from;
        let mut skipped = false;
        for _ in 0..4000 {
            if t >= free.0 && !skipped {
                skipped = true;
                before = free.1.max(t);
                t = before;
            }
            let gap = self.gap_before(t);
            if gap > 0.0 {
                largest = largest.max(gap);
            } else if largest > 0.0 {
                let (mut positive, mut negative) = (before, t);
                for _ in 0..200 {
                    let middle = 0.5 * (positive + negative);
                    if self.gap_before(middle) > 0.0 {
                        positive = middle;
                    } else {
                        negative = middle;
                    }
                }
                return Some((negative, largest));
            }
            before = t;
            t += (0.05 * t).min(1.0 / 64.0);
        }
        None
    }

    fn case(&self, class: &'static str, angle: f64, time: f64) -> Option<Case> {
        let launch = libm::fmod(angle - time, TAU);
        let launch = if launch < 0.0 { launch + TAU } else { launch };
        let speed = self.velocity_before(time);
        (speed > 0.0 && launch < TAU).then_some(Case {
            class,
            peak: self.peak,
            angle: launch,
            speed,
            separation: false,
        })
    }
}

/// A phase at which the gap is convex, often near the ends of that zone.
fn convex_phase(random: &mut SplitMix, peak: f64) -> f64 {
    let sigma = libm::asin(1.0 / peak);
    let width = PI - 2.0 * sigma;
    match random.below(4) {
        0 => sigma + width * random.decades(-5.0, -0.5),
        1 => PI - sigma - width * random.decades(-5.0, -0.5),
        _ => sigma + width * random.unit(),
    }
}

/// A launch whose disk passes a crest of the platform with a smallest gap of +-10^-2 ... 10^-15 of its
/// largest.
pub fn grazing(random: &mut SplitMix) -> Option<Case> {
    grazing_to(random, -15.5)
}

/// The same with a relative gap not below 10^`closest`.
pub fn grazing_to(random: &mut SplitMix, closest: f64) -> Option<Case> {
    let peak = peak_above_one(random);
    let angle = convex_phase(random, peak);
    let (sin, cos) = libm::sincos(angle);
    let mut flight = Backward { peak, sin, cos, gap: 0.0, velocity: 0.0 };
    let (_, scale) = flight.launch(1.0e-7)?;
    let share = random.sign() * random.decades(closest, -1.5);
    flight.gap = share * scale;
    let curvature = peak * sin - 1.0;
    let clear = if flight.gap < 0.0 { 1.2 * (2.0 * flight.gap.abs() / curvature).sqrt() } else { 0.0 };
    let (time, _) = flight.launch(clear.max(1.0e-9))?;
    let class = if flight.gap < 0.0 { "grazing hit" } else { "grazing miss" };
    flight.case(class, angle, time)
}

/// A launch whose disk touches the platform slowly, often at an inflection of the gap.
pub fn slow_touch(random: &mut SplitMix) -> Option<Case> {
    let peak = peak_above_one(random);
    let sigma = libm::asin(1.0 / peak);
    let angle = match random.below(4) {
        0 => sigma + random.sign() * random.decades(-9.0, -2.0) * (FRAC_PI_2 - sigma),
        1 => PI - sigma + random.sign() * random.decades(-9.0, -2.0) * (FRAC_PI_2 - sigma),
        2 => sigma,
        _ => random.angle(),
    };
    let (sin, cos) = libm::sincos(angle);
    let velocity = -peak * random.decades(-12.0, -1.0);
    let flight = Backward { peak, sin, cos, gap: 0.0, velocity };
    let (time, _) = flight.launch(1.0e-9)?;
    flight.case("slow touch", angle, time)
}

const fn launch(class: &'static str, peak: f64, angle: f64, speed: f64) -> Case {
    Case { class, peak, angle, speed, separation: false }
}

/// Launches that defeat a careless solver: each of them has defeated one.
pub const TRAPS: [Case; 16] = [
    // A gap at the inflection far below the rounding of heights counted from the crest.
    launch("trap: low start", 1854.4952716103069, 0.000539226136370109, 2.951889329631943e-6),
    launch("trap: low start", 1.9938048226305751, 0.5251925330349337, 2.6166210311548768e-8),
    launch("trap: low start", 225.57147695817932, 0.0041872603850243665, 5.1164091408261955e-6),
    launch("trap: low start", 912156.5229893959, 6.281969767540147, 0.5063162424541003),
    // Touches at an inflection: zero slope and curvature.
    launch("trap: slow inflection", 5.768746002934865, 3.587227185490912, 11.470452053443715),
    launch("trap: slow inflection", 1.7847623421711838, 4.573174754237005, 3.026217426385511),
    launch("trap: slow inflection", 1.0128023061456377, 1.0922096663713985, 0.010807884769195364),
    // A whole period, and its remainder.
    launch("trap: whole period", 0.0, 2.0287966029632174, std::f64::consts::PI),
    launch("trap: whole period", 4.384710854596273, 1.636809723859689, 9.714017439457246),
    // The velocity of a short flight.
    launch("trap: short flight", 1.0, 0.5169885676590233, 0.09308146566870024),
    launch("trap: short flight", 51528.024112363, 5.8664221538342005, 2985.300543990622),
    // Grazes of slow flights, where P is not the scale of the gap.
    launch("trap: slow graze", 1.577763576548891, 0.34285943203876157, 0.059109411360923236),
    launch("trap: slow graze", 1.343358477289649, 0.1936103466384762, 0.1722375576366748),
    launch("trap: slow graze", 2.2487668503814064, 0.12404461053353044, 0.09009036983031299),
    launch("trap: slow graze", 1.0082320029466527, 1.1866130619069695, 0.005594247262318719),
    launch("trap: slow graze", 9.199240439594853, 6.030767399440299, 0.44875654009860527),
];
