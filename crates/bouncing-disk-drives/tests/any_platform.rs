//! Verdicts, exponents and diagrams on drives, against two programs that are independent of the solver. On
//! pieces of constant acceleration each flight is a root of quadratics, and each chatter a geometric series;
//! on any other shape a march finds the next impact.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::f64::consts::{PI, TAU};

use bouncing_disk_core::attractors::{
    AfterRest, AttractingMap as _, Attractor, AttractorKind, AttractorSearch, Attractors, Axis,
    BasinSettings, Grid, KnownOrbit, Verdict, VerdictSettings, verdicts,
};
use bouncing_disk_core::chaos::{LyapunovOutcome, lyapunov_exponents, lyapunov_spectra};
use bouncing_disk_core::numerics::elementary::{atan2, cos, hypot, ln, sin};
use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::orbits::OrbitSearch;
use bouncing_disk_core::sweep::{orbit_diagram, survival_times};
use bouncing_disk_core::{
    BouncingMap as _, ChatterPolicy, Error, ImpactMap, ImpactState, OrbitEvent, Phase, Unobserved, Vibration,
};
use bouncing_disk_drives::{Drive, DrivenMap};

/// Pieces of constant acceleration: the start of each, with its height, velocity and half its acceleration at
/// this point.
#[derive(Debug, Clone)]
struct Parabolas(Vec<(f64, [f64; 3])>);

/// The motion after an impact or a rest.
#[derive(Debug, Clone, Copy)]
enum Motion {
    /// The disk leaves the platform at this phase with this speed.
    Launch(f64, f64),
    /// The disk rests from this phase.
    Rest(f64),
}

/// An orbit as it was followed.
#[derive(Debug, Default)]
struct Followed {
    /// Phases and velocities of the impacts, and the periods before each.
    impacts: Vec<(f64, f64, u64)>,
    /// The phase of each separation, and the numbers of impacts, long flights and periods before it.
    separations: Vec<(f64, usize, usize, u64)>,
    rests_for_ever: bool,
}

/// The end of an orbit.
#[derive(Debug, PartialEq)]
enum End {
    Rest,
    /// On a periodic orbit through this impact.
    Cycle(f64, f64),
    Other,
}

impl Parabolas {
    fn triangle(a: f64, rise: f64) -> Self {
        let crest = PI * rise;
        let (up, down) = (a / crest, -a / (PI - crest));
        Self(vec![(0.0, [0.0, up, 0.0]), (crest, [a, down, 0.0]), (TAU - crest, [-a, up, 0.0])])
    }

    fn arcs(a: f64) -> Self {
        let (slope, half) = (4.0 * a / PI, 4.0 * a / (PI * PI));
        Self(vec![(0.0, [0.0, slope, -half]), (PI, [0.0, -slope, half])])
    }

    fn piece(&self, phase: f64) -> usize {
        self.0.iter().rposition(|(start, _)| *start <= phase).unwrap()
    }

    fn end(&self, piece: usize) -> f64 {
        self.0.get(piece + 1).map_or(TAU, |next| next.0)
    }

    fn at(&self, piece: usize, phase: f64) -> [f64; 3] {
        let (start, [z, v, half]) = self.0[piece];
        let s = phase - start;
        [z + s * (v + s * half), v + 2.0 * s * half, half]
    }
}

/// A platform whose motion is followed without the solver.
trait Followable {
    /// The next impact: its phase, its velocity, and how often the phase passed 0.
    fn fly(&self, phase: f64, speed: f64) -> (f64, f64, u64);

    /// The motion after an impact.
    fn after(&self, phase: f64, speed: f64, r: f64) -> Motion;

    /// The phase at which a rest ends, how often the phase passes 0 before, and the next motion; `None` if
    /// the rest lasts.
    fn leave(&self, phase: f64, r: f64) -> Option<(f64, u64, Motion)>;

    /// The orbit from an impact, for `impacts` impacts or until it leaves a rest for the fifth time.
    fn follow(&self, (phase, velocity): (f64, f64), r: f64, impacts: usize) -> Followed {
        let mut followed = Followed::default();
        let mut motion = self.after(phase, -r * velocity, r);
        let (mut long, mut periods) = (0, 0);
        while followed.impacts.len() < impacts && followed.separations.len() < 5 {
            match motion {
                Motion::Launch(from, speed) => {
                    let (to, velocity, turns) = self.fly(from, speed);
                    periods += turns;
                    long += usize::from(to - from + TAU * turns as f64 > PI);
                    followed.impacts.push((to, velocity, periods));
                    motion = self.after(to, -r * velocity, r);
                }
                Motion::Rest(since) => {
                    let whole = (since / TAU).floor();
                    periods += whole as u64;
                    match self.leave(since - TAU * whole, r) {
                        Some((at, turns, next)) => {
                            periods += turns;
                            followed.separations.push((at, followed.impacts.len(), long, periods));
                            motion = next;
                        }
                        None => {
                            followed.rests_for_ever = true;
                            break;
                        }
                    }
                }
            }
        }
        followed
    }

    /// The growth of a small difference by the next impact, and its direction after it; `None` at a rest.
    fn grow(&self, at: &mut (f64, f64), ahead: &mut (f64, f64), r: f64) -> Option<f64> {
        let ((phase, velocity), size) = (*at, 1e-8);
        if let Motion::Rest(_) = self.after(phase, -r * velocity, r) {
            return None;
        }
        let (next, fast, _) = self.fly(phase, -r * velocity);
        let beside = ((phase + size * ahead.0).rem_euclid(TAU), -r * (velocity + size * ahead.1));
        let (there, other, _) = self.fly(beside.0, beside.1);
        let away = (there - next + PI).rem_euclid(TAU) - PI;
        let grown = hypot(away, other - fast) / size;
        *ahead = (away / size / grown, (other - fast) / size / grown);
        *at = (next, fast);
        Some(grown)
    }

    /// The mean exponent over 20 parts of `impacts` impacts, and its error; or the end of an orbit that rests
    /// or settles earlier.
    fn exponent(&self, mut at: (f64, f64), r: f64, impacts: u64) -> Result<(f64, f64), End> {
        let (mut ahead, mut parts) = ((1.0, 0.0), [0.0; 20]);
        for part in &mut parts {
            for _ in 0..impacts {
                *part += ln(self.grow(&mut at, &mut ahead, r).ok_or(End::Rest)?) / impacts as f64;
            }
            if *part <= 0.0 {
                return Err(End::Cycle(at.0, at.1));
            }
        }
        let mean = parts.iter().sum::<f64>() / 20.0;
        let squares: f64 = parts.iter().map(|part| (part - mean) * (part - mean)).sum();
        Ok((mean, (squares / (19.0 * 20.0)).sqrt()))
    }

    /// The state of an orbit after `impacts` impacts, or that it rests forever; `None` if rounding may have
    /// moved it by more than 1e-4.
    fn known(&self, mut at: (f64, f64), r: f64, impacts: u64) -> Option<End> {
        let (mut ahead, mut error) = ((1.0, 0.0), 0.0);
        for _ in 0..impacts {
            if let Some(grown) = self.grow(&mut at, &mut ahead, r) {
                error = error * grown + 1e-13;
            } else if let Motion::Rest(since) = self.after(at.0, -r * at.1, r) {
                let mut motion = Motion::Rest(since);
                for _ in 0..5 {
                    let Motion::Rest(since) = motion else { break };
                    let Some(left) = self.leave(since.rem_euclid(TAU), r) else { return Some(End::Rest) };
                    motion = left.2;
                }
                let Motion::Launch(from, speed) = motion else { return Some(End::Other) };
                let (to, velocity, _) = self.fly(from, speed);
                // No difference survives a rest.
                (at, error) = ((to, velocity), 1e-9);
            }
            if error > 1e-4 {
                return None;
            }
        }
        Some(End::Cycle(at.0, at.1))
    }
}

impl Followable for Parabolas {
    fn fly(&self, phase: f64, speed: f64) -> (f64, f64, u64) {
        let (mut piece, mut from, mut turns) = (self.piece(phase), phase, 0);
        // The heights are not used: gaps may be below their rounding.
        let (mut gap, mut b) = (0.0_f64, speed);
        loop {
            // gap + b s - c s^2 = 0, when the disk comes down.
            let c = 0.5 + self.0[piece].1[2];
            let discriminant = (b * b + 4.0 * c * gap).sqrt();
            let s = if b > 0.0 { 0.5 * (b + discriminant) / c } else { 2.0 * gap / (discriminant - b) };
            let length = self.end(piece) - from;
            if s >= 0.0 && s < length {
                return (from + s, -discriminant, turns);
            }
            gap = (gap + length * (b - length * c)).max(0.0);
            let before = self.at(piece, self.end(piece))[1];
            piece = (piece + 1) % self.0.len();
            turns += u64::from(piece == 0);
            from = self.0[piece].0;
            b += before - self.0[piece].1[1] - 2.0 * c * length;
        }
    }

    fn after(&self, phase: f64, speed: f64, r: f64) -> Motion {
        let piece = self.piece(phase);
        let pull = 1.0 + 2.0 * self.at(piece, phase)[2];
        let rest = phase + 2.0 * speed / (pull * (1.0 - r));
        // A long flight counts.
        let flight = 2.0 * speed / pull;
        if pull > 0.0 && flight < PI && rest < self.end(piece) {
            Motion::Rest(rest)
        } else {
            Motion::Launch(phase, speed)
        }
    }

    fn leave(&self, phase: f64, r: f64) -> Option<(f64, u64, Motion)> {
        let (mut piece, mut turns) = (self.piece(phase), 0);
        let room = 1e-12 * self.0.iter().map(|(_, [_, velocity, _])| velocity.abs()).fold(0.0, f64::max);
        for _ in 0..=self.0.len() {
            let end = self.end(piece);
            let before = self.at(piece, end)[1];
            piece = (piece + 1) % self.0.len();
            turns += u64::from(piece == 0);
            let (start, [_, velocity, half]) = self.0[piece];
            let jump = velocity - before;
            if jump < -room {
                return Some((start, turns, Motion::Launch(start, -jump)));
            }
            if jump > room {
                return Some((start, turns, self.after(start, r * jump, r)));
            }
            if 0.5 + half < 0.0 {
                return Some((start, turns, Motion::Launch(start, 0.0)));
            }
        }
        None
    }
}

/// A shape for the march: the largest acceleration, and height, velocity and acceleration at a phase.
struct Marched {
    most: f64,
    top: f64,
    at: Box<dyn Fn(f64) -> [f64; 3]>,
}

/// Steps of the march in a period.
const STEPS: f64 = 128.0;

fn bisected(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if holds(middle) { low = middle } else { high = middle }
    }
    low
}

impl Marched {
    fn sum(harmonics: [(f64, f64); 3]) -> Self {
        let terms = move || harmonics.into_iter().zip(1..).map(|((a, phase), j)| (a, f64::from(j), phase));
        let most = terms().map(|(a, j, _)| a.abs() * j * j).sum();
        let top = terms().map(|(a, _, _)| a.abs()).sum();
        let at = move |t: f64| {
            terms().fold([0.0; 3], |[z, v, acceleration], (a, j, phase)| {
                let (s, c) = (sin(j * t + phase), cos(j * t + phase));
                [z + a * s, v + a * j * c, acceleration - a * j * j * s]
            })
        };
        Self { most, top, at: Box::new(at) }
    }

    /// In each quarter (3 y - y^3)/2, y being the share of the way from a zero to an extreme: zero slope at
    /// the extreme, zero curvature at the zero.
    fn cubics(a: f64) -> Self {
        let at = move |t: f64| {
            let quarter = (t.rem_euclid(TAU) / (0.5 * PI)).min(3.999_999_999_999);
            let (sign, place) = if quarter < 2.0 { (a, quarter) } else { (-a, quarter - 2.0) };
            let (y, way) = if place < 1.0 { (place, 1.0) } else { (2.0 - place, -1.0) };
            let unit = 0.5 * PI;
            [
                sign * 0.5 * y * (3.0 - y * y),
                sign * way * 1.5 * (1.0 - y * y) / unit,
                -sign * 3.0 * y / (unit * unit),
            ]
        };
        Self { most: 12.0 * a / (PI * PI), top: a, at: Box::new(at) }
    }
}

impl Followable for Marched {
    fn fly(&self, phase: f64, speed: f64) -> (f64, f64, u64) {
        let [z, v, _] = (self.at)(phase);
        let gap = |t: f64| z + t * (v + speed - 0.5 * t) - (self.at)(phase + t)[0];
        let slope = |t: f64| v + speed - t - (self.at)(phase + t)[1];
        // It rises for at least this long.
        let mut low = if speed > 0.0 { (speed / (1.0 + self.most)).min(TAU / STEPS) } else { 1e-4 };
        // Above the whole platform no impact is possible.
        let up = v + speed;
        let above = (up * up + 2.0 * (z - self.top)).sqrt();
        let root = loop {
            if up - above <= low {
                low = low.max(up + above - 1e-9);
            }
            let high = low + TAU / STEPS;
            if gap(high) <= 0.0 {
                break bisected(low, high, |t| gap(t) > 0.0);
            }
            if slope(low) < 0.0 && slope(high) > 0.0 {
                let lowest = bisected(low, high, |t| slope(t) < 0.0);
                if gap(lowest) < 0.0 {
                    break bisected(low, lowest, |t| gap(t) > 0.0);
                }
            }
            low = high;
        };
        let turns = ((phase + root) / TAU).floor();
        (phase + root - TAU * turns, slope(root), turns as u64)
    }

    fn after(&self, phase: f64, speed: f64, r: f64) -> Motion {
        let pull = 1.0 + (self.at)(phase)[2];
        let chatter = 2.0 * speed / (pull * (1.0 - r));
        if pull > 0.01 && chatter < 1e-4 {
            Motion::Rest(phase + chatter)
        } else {
            Motion::Launch(phase, speed)
        }
    }

    fn leave(&self, phase: f64, _r: f64) -> Option<(f64, u64, Motion)> {
        let pull = |t: f64| 1.0 + (self.at)(phase + t)[2];
        // The platform may leave the disk behind for only a moment.
        let step = TAU / (128.0 * STEPS);
        let before =
            (0..).map(|k| f64::from(k) * step).take_while(|t| *t < TAU).find(|t| pull(t + step) < 0.0)?;
        let at = phase + bisected(before, before + step, |t| pull(t) >= 0.0);
        let turns = (at / TAU).floor();
        Some((at - TAU * turns, turns as u64, Motion::Launch(at - TAU * turns, 0.0)))
    }
}

fn state(phase: f64, velocity: f64) -> ImpactState {
    ImpactState::from_normalised(phase, -velocity / PI).unwrap()
}

/// A triangle, a sawtooth or parabolas, with amplitude and restitution.
fn random_map(case: usize, random: &mut SplitMix64) -> (Parabolas, DrivenMap, [f64; 2]) {
    let (a, r) = (0.3 + 4.0 * random.unit(), 0.9 * random.unit());
    let (exact, drive) = match case % 3 {
        0 => (Parabolas::triangle(a, 0.5), Drive::triangle(a)),
        1 => {
            let rise = 0.1 + 0.8 * random.unit();
            (Parabolas::triangle(a, rise), Drive::sawtooth(a, rise))
        }
        _ => (Parabolas::arcs(a), Drive::parabolas(a)),
    };
    (exact, DrivenMap::new(drive.unwrap(), r).unwrap(), [a, r])
}

/// The map of a shape, and the program that follows its orbits: triangles, sawteeth, parabolas, sums of three
/// harmonics, cubics.
fn map_of(kind: u32, a: f64, r: f64, shape: [f64; 4]) -> (Box<dyn Followable>, DrivenMap) {
    let (exact, drive): (Box<dyn Followable>, _) = match kind {
        0 => (Box::new(Parabolas::triangle(a, 0.5)), Drive::triangle(a)),
        1 => {
            let rise = 0.1 + 0.8 * shape[0];
            (Box::new(Parabolas::triangle(a, rise)), Drive::sawtooth(a, rise))
        }
        2 => (Box::new(Parabolas::arcs(a)), Drive::parabolas(a)),
        3 => {
            let [second, lag, third, another] = shape;
            let harmonics = [(a, 0.0), (0.3 * a * second, TAU * lag), (0.15 * a * third, TAU * another)];
            (Box::new(Marched::sum(harmonics)), Drive::fourier(&harmonics))
        }
        _ => (Box::new(Marched::cubics(a)), Drive::cubics(a)),
    };
    (exact, DrivenMap::new(drive.unwrap(), r).unwrap())
}

/// The number of verdicts of each kind.
#[derive(Debug, Default)]
struct Seen {
    /// The number of exponents, and of those within one and two stated errors of the exponent of a much
    /// longer orbit.
    exponents: u32,
    within: [u32; 2],
    after_rests: u32,
    /// Irregular motions that rest, or settle, later.
    rest: u32,
    settle: u32,
    periodic: u32,
    from_start: u32,
    chaotic: u32,
    chattering: u32,
    undecided: u32,
}

impl Seen {
    /// Compares an exponent with the exponent over the next 20 times as many impacts, on the same attractor.
    /// A motion that rests or settles during these has none. Returns the difference in units of both errors
    /// together.
    fn exponent(
        &mut self,
        exact: &dyn Followable,
        (map, start): (&DrivenMap, ImpactState),
        settings: VerdictSettings,
        verdict: Verdict,
    ) -> Option<f64> {
        let Verdict::Chaotic { exponent, standard_error, rests, .. } = verdict else { return None };
        let (mut orbit, mut impacts, mut at) = (map.orbit(start, ChatterPolicy::Complete), 0, (0.0, 0.0));
        while impacts < settings.transient + settings.impacts {
            match orbit.advance().unwrap().unwrap() {
                OrbitEvent::Impact(impact) => {
                    impacts += 1;
                    at = (impact.phase.angle(), impact.velocity);
                }
                OrbitEvent::Separation(_) | OrbitEvent::Kick(_) => impacts = 0,
                _ => {}
            }
        }
        match exact.exponent(at, map.restitution(), settings.impacts) {
            Ok((own, error)) => {
                let away = (own - exponent).abs();
                self.exponents += 1;
                self.after_rests += u32::from(rests > 0);
                for (within, errors) in self.within.iter_mut().zip([1.0, 2.0]) {
                    *within += u32::from(away < errors * standard_error);
                }
                Some((own - exponent) / hypot(standard_error, error))
            }
            Err(end) => {
                *(if end == End::Rest { &mut self.rest } else { &mut self.settle }) += 1;
                None
            }
        }
    }
}

/// The verdict on one start, against the followed orbit.
fn check_verdict(exact: &dyn Followable, map: &DrivenMap, start: (f64, f64), context: &str, seen: &mut Seen) {
    let (settings, r) =
        (VerdictSettings { transient: 500, impacts: 4_000, ..VerdictSettings::default() }, map.restitution());
    let verdict = map.verdict(state(start.0, start.1), settings).unwrap();
    let context = format!("{context}: r = {r}, {start:?}, {verdict:?}");
    match verdict {
        Verdict::Periodic { impacts, platform_periods, state, distance, after, .. } => {
            seen.periodic += 1;
            // The orbit on which it settled attracts its neighbours.
            let beside = (state.phase().angle() + 1e-6, state.velocity());
            let followed = exact.follow(beside, r, 20_000).impacts;
            assert_eq!(followed.len(), 20_000, "{context}");
            let (last, before) = (followed[19_999], followed[19_999 - impacts as usize]);
            assert!((last.1 - before.1).abs() < 1e-6, "{context}: {last:?} {before:?}");
            assert_eq!(last.2 - before.2, platform_periods, "{context}");
            // The start also ends there, unless the path is so irregular that any program loses the memory of
            // its start.
            match exact.known(start, r, after + 500) {
                Some(End::Cycle(phase, velocity)) => {
                    seen.from_start += 1;
                    let room = distance + 1e-3;
                    let near = |own: &(f64, f64, u64)| {
                        let apart = (own.0 - phase + PI).rem_euclid(TAU) - PI;
                        apart.abs() < room && (own.1 - velocity).abs() < room * (1.0 + velocity.abs())
                    };
                    assert!(
                        followed[20_000 - impacts as usize..].iter().any(near),
                        "{context}: {phase} {velocity}"
                    );
                }
                end => assert_eq!(end, None, "{context}"),
            }
        }
        Verdict::Chaotic { .. } => {
            seen.chaotic += 1;
            let errors = seen.exponent(exact, (map, self::state(start.0, start.1)), settings, verdict);
            assert!(errors.is_none_or(|errors| errors.abs() < 5.0), "{context}: {errors:?}");
        }
        Verdict::Chattering { cycle, after } => {
            seen.chattering += 1;
            let followed = exact.follow(start, r, 100_000);
            let rests = !followed.separations.is_empty();
            assert!(rests || exact.known(start, r, after + 500).is_none(), "{context}");
            if rests && cycle.is_exact() {
                assert_eq!(followed.separations.len(), 5, "{context}");
                // The round from a separation to the next at the same phase.
                let last = followed.separations.last().unwrap();
                let same = |other: &&(f64, usize, usize, u64)| (other.0 - last.0).abs() < 1e-9;
                let earlier = followed.separations[..4].iter().rev().find(same).unwrap();
                assert_eq!(last.3 - earlier.3, cycle.platform_periods, "{context}: {followed:?}");
                assert_eq!((last.2 - earlier.2) as u64, cycle.long_flights, "{context}: {followed:?}");
            }
        }
        Verdict::AtRest { after, .. } => {
            let rests = exact.follow(start, r, after as usize + 20_000).rests_for_ever;
            assert!(rests || exact.known(start, r, after + 500).is_none(), "{context}");
        }
        _ => seen.undecided += 1,
    }
}

#[test]
fn verdicts_on_parabolas_are_those_of_quadratics() {
    let (mut seen, mut random) = (Seen::default(), SplitMix64::new(70));
    for case in 0..120 {
        let (exact, map, [a, _]) = random_map(case, &mut random);
        let start = (TAU * random.unit(), -2.0 * PI * random.unit());
        check_verdict(&exact, &map, start, &format!("{case}: a = {a}"), &mut seen);
    }
    assert!(seen.chattering > 30 && seen.periodic + seen.chaotic > 10, "{seen:?}");
    assert!(seen.undecided < 30, "{seen:?}");
}

/// Sums of three harmonics and cubics.
#[test]
fn verdicts_on_smooth_shapes_are_those_of_a_march() {
    let (mut seen, mut random) = (Seen::default(), SplitMix64::new(72));
    for case in 0..SMOOTH_MAPS {
        let (a, r) = (0.6 + 2.4 * random.unit(), 0.3 + 0.6 * random.unit());
        let shape = core::array::from_fn(|_| if case % 2 == 0 { random.unit() } else { 0.0 });
        let (exact, map) = map_of(3 + case % 2, a, r, shape);
        let start = (TAU * random.unit(), -2.0 * PI * random.unit());
        check_verdict(&*exact, &map, start, &format!("{case}: a = {a}"), &mut seen);
    }
    assert!(
        seen.chattering > 3 && seen.periodic + seen.chaotic > 3 && seen.undecided < SMOOTH_MAPS / 4,
        "{seen:?}"
    );
}

/// Half of them sums, half cubics.
const SMOOTH_MAPS: u32 = 24;

/// The amplitude at which irregular motion begins, approached from above to within a share of 2^-4 to 2^-9.
fn beginning(
    kind: u32,
    r: f64,
    shape: [f64; 4],
    start: ImpactState,
    settings: VerdictSettings,
) -> Option<f64> {
    let verdict = |a: f64| map_of(kind, a, r, shape).1.verdict(start, settings).unwrap();
    let irregular = |a: f64| matches!(verdict(a), Verdict::Chaotic { .. });
    let first = 0.3 + shape[0];
    let mut steps = (0..20).map(|k| first * (1.0 + 0.05 * f64::from(k)));
    let mut low = steps.find(|a| matches!(verdict(*a), Verdict::Periodic { .. }))?;
    let mut high = steps.find(|a| irregular(*a))?;
    for _ in 0..(4.0 + 6.0 * shape[1]) as u32 {
        let middle = 0.5 * (low + high);
        *(if irregular(middle) { &mut high } else { &mut low }) = middle;
    }
    Some(high)
}

/// Exponents of `maps` irregular motions of a kind, every other one at the onset of irregular motion.
fn exponents_of(kind: u32, maps: u32, impacts: u64) -> Seen {
    let (mut seen, mut random) = (Seen::default(), SplitMix64::new(76 + u64::from(kind)));
    let settings = VerdictSettings { impacts, ..VerdictSettings::default() };
    while seen.exponents < maps {
        let (r, shape) = (0.3 + 0.67 * random.unit(), core::array::from_fn(|_| random.unit()));
        let (a, start) = (0.3 + 4.0 * random.unit(), state(TAU * random.unit(), -TAU * random.unit()));
        let beginning = || beginning(kind, r, shape, start, settings);
        let Some(a) = (if seen.exponents % 2 == 0 { Some(a) } else { beginning() }) else { continue };
        let (exact, map) = map_of(kind, a, r, shape);
        let verdict = map.verdict(start, settings).unwrap();
        seen.exponent(&*exact, (&map, start), settings, verdict);
    }
    seen
}

/// For each kind, the number of exponents, of those within one and two stated errors, and of those measured
/// after a rest; and the number of motions omitted because they rest or settle later.
fn stated_errors(maps: u32, impacts: u64) -> [[u32; 5]; 5] {
    [0, 1, 2, 3, 4].map(|kind| {
        let Seen { within: [one, two], after_rests, rest, settle, .. } = exponents_of(kind, maps, impacts);
        [one, two, after_rests, rest, settle]
    })
}

/// A stated error is a standard error: two of them contain the exponent for at least 90 of 100 irregular
/// motions.
#[test]
fn stated_errors_hold_the_exponents() {
    let found = stated_errors(6, 400);
    let two: u32 = found.iter().map(|kind| kind[1]).sum();
    assert!(two >= 27, "{found:?}");
}

/// Triangles, sawteeth, parabolas, sums and cubics. Two errors contain 284 of 300 exponents over 400 impacts
/// and 239 of 250 over 4,000; for the worst kind 56 of 60 and 47 of 50. The others are mostly intermittent,
/// with laminar parts longer than the measurement. Further motions, 266 and 264, rest or settle later and are
/// omitted.
#[test]
#[ignore = "minutes: 550 exponents"]
fn stated_errors_hold_the_exponents_of_many_maps() {
    let found = [(60, 400), (50, 4_000)].map(|(maps, impacts)| stated_errors(maps, impacts));
    let recorded = [
        [
            [44, 56, 8, 48, 3],
            [41, 58, 8, 29, 1],
            [47, 56, 3, 59, 0],
            [42, 56, 3, 45, 29],
            [51, 58, 12, 51, 1],
        ],
        [
            [40, 47, 4, 19, 4],
            [36, 48, 6, 30, 16],
            [35, 47, 1, 63, 0],
            [42, 49, 7, 67, 22],
            [37, 48, 5, 41, 2],
        ],
    ];
    assert_eq!(found, recorded);
}

/// Restitutions from 0 to the last number below 1, amplitudes and starts from the smallest number upwards,
/// and impacts on kinks.
fn check_margins(cases: u32, seed: u64) -> Seen {
    let (mut seen, mut random) = (Seen::default(), SplitMix64::new(seed));
    let mut pick = |list: &[f64]| list[(random.unit() * list.len() as f64) as usize];
    let least = f64::from_bits(1);
    for case in 0..cases {
        let r = pick(&[0.0, 0.3, 0.5, 0.9, 0.99, 0.999, 1.0 - 1e-6, 1.0_f64.next_down()]);
        let a = pick(&[1e-310, 1e-160, 1e-12, 1e-8, 0.01, 0.3, 0.8, 1.0, 1.3, 2.0, 2.9, 4.0, 30.0]);
        let phase = pick(&[0.0, least, 1e-310, 0.5 * PI, PI, PI.next_down(), 1.5 * PI, 0.7, 5.0]);
        let velocity = -pick(&[0.0, least, 1e-310, 1e-160, 1e-12, 1e-6, 0.1, 1.0, 0.5 * PI, 4.0, 30.0]);
        let (exact, map) =
            map_of(case % 5, a, r, core::array::from_fn(|_| pick(&[0.0, 0.1, 0.25, 0.5, 0.9])));
        let context = format!("{case}: a = {a:e}");
        if case % 5 < 3 || a > 1e-3 {
            check_verdict(&*exact, &map, (phase, velocity), &context, &mut seen);
        } else {
            // A march does not resolve such heights. They throw the disk if it loses even less.
            let settings = VerdictSettings { transient: 100, impacts: 400, ..VerdictSettings::default() };
            let verdict = map.verdict(state(phase, velocity), settings).unwrap();
            let rests = matches!(verdict, Verdict::AtRest { .. } | Verdict::Undecided { .. });
            assert!(rests || a > 0.1 * (1.0 - r), "{context}: r = {r}, {phase} {velocity}: {verdict:?}");
        }
    }
    seen
}

#[test]
fn verdicts_at_the_margins_are_those_of_the_others() {
    let seen = check_margins(100, 77);
    assert!(seen.chattering > 10 && seen.periodic + seen.chaotic > 5, "{seen:?}");
}

#[test]
#[ignore = "minutes: 10,000 maps"]
fn verdicts_at_many_margins_are_those_of_the_others() {
    check_margins(10_000, 78);
}

/// A wandering orbit comes near periodic ones by chance, but ends on none of them.
#[test]
fn orbits_that_wander_are_on_their_way_to_none() {
    for (a, r, phase, velocity) in [
        (0.220_123_688_145_340_72, 1.0 - 2e-3, 3.763_669_019_056_795_4, -1.805_291_612_313_229),
        (0.028_071_521_921_365_87, 1.0 - 1e-3, 2.712_156_061_444_463_5, -1.709_974_626_307_158_7),
    ] {
        let (map, phase) = (driven(Drive::triangle(a).unwrap(), r), Phase::new(phase).unwrap());
        let settings = VerdictSettings { transient: 500, impacts: 4_000, ..VerdictSettings::default() };
        let verdict = map.verdict(ImpactState::new(phase, velocity).unwrap(), settings).unwrap();
        assert!(matches!(verdict, Verdict::Undecided { .. }), "{verdict:?}");
    }
}

/// A shape as a function of its amplitude: the phase at which it rises with a given speed and slows down; the
/// amplitude at which it first reaches this speed, and the amplitude at which it has a given deceleration
/// there.
struct Family {
    drive: fn(f64) -> Drive,
    phase: fn(f64, f64) -> f64,
    birth: fn(f64) -> f64,
    doubling: fn(f64, f64) -> f64,
}

const FAMILIES: [Family; 3] = [
    Family {
        drive: |a| Drive::fourier(&[(a, 0.0)]).unwrap(),
        phase: |a, v| atan2((a * a - v * v).max(0.0).sqrt(), v),
        birth: |v| v,
        doubling: |v, d| hypot(v, d),
    },
    Family {
        drive: |a| Drive::parabolas(a).unwrap(),
        phase: |a, v| (4.0 * a / PI - v) * PI * PI / (8.0 * a),
        birth: |v| v * PI / 4.0,
        doubling: |_, d| d * PI * PI / 8.0,
    },
    Family {
        drive: |a| Drive::cubics(a).unwrap(),
        phase: |a, v| 0.5 * PI * (1.0 - v * PI / (3.0 * a)).max(0.0).sqrt(),
        birth: |v| v * PI / 3.0,
        // a (1 - y^2) = b, a y = c.
        doubling: |v, d| {
            let (b, c) = (v * PI / 3.0, d * PI * PI / 12.0);
            0.5 * (b + hypot(b, 2.0 * c))
        },
    },
];

/// An orbit of one impact per period needs the speed pi (1 - r)/(1 + r) while the platform slows down, and
/// doubles at the deceleration 2 (1 + r^2)/(1 + r)^2. At 1e-6 from either the verdict is right; nearer there
/// may be none.
#[test]
fn verdicts_beside_births_and_doublings() {
    let settings = VerdictSettings { transient: 500, impacts: 1_000, ..VerdictSettings::default() };
    for (family, r) in FAMILIES.iter().flat_map(|family| [0.5, 0.95].map(|r| (family, r))) {
        let speed = PI * (1.0 - r) / (1.0 + r);
        let doubling = (family.doubling)(speed, 2.0 * (1.0 + r * r) / ((1.0 + r) * (1.0 + r)));
        for (seam, inside) in [((family.birth)(speed), 1.0), (doubling, -1.0)] {
            for beside in [1e-6, 1e-8, 1e-12, f64::EPSILON] {
                for (side, off) in [(1.0, 0.0), (-1.0, 0.0), (-1.0, 1e-3)] {
                    let a = seam * (1.0 + inside * side * beside);
                    let map = DrivenMap::new((family.drive)(a), r).unwrap();
                    let start = state((family.phase)(a, speed) + off, -TAU / (1.0 + r));
                    let verdict = map.verdict(start, settings).unwrap();
                    let one = matches!(verdict, Verdict::Periodic { impacts: 1, platform_periods: 1, .. });
                    let context = format!("{:?}, {r}, {inside} {side} {beside}: {verdict:?}", map.drive());
                    assert!(side > 0.0 || !one, "{context}");
                    assert!(side < 0.0 || beside < 1e-6 || off > 0.0 || one, "{context}");
                }
            }
        }
    }
}

/// The general code on the sine as a sum, against the sine's own code.
#[test]
fn analyses_of_a_sine_as_a_sum_are_those_of_the_sine() {
    let mut random = SplitMix64::new(71);
    let settings = VerdictSettings { transient: 300, impacts: 2_000, ..VerdictSettings::default() };
    let (mut sines, mut sums) = (Vec::new(), Vec::new());
    for _ in 0..40 {
        let (forcing, r) = (0.3 + 0.6 * random.unit(), 0.9 * random.unit());
        let sine = ImpactMap::new(Vibration::from_axial_forcing(forcing).unwrap(), r).unwrap();
        let sum = DrivenMap::new(Drive::fourier(&[(PI * forcing, 0.0)]).unwrap(), r).unwrap();
        let start = state(TAU * random.unit(), -2.0 * PI * random.unit());
        sines.push((sine, start));
        sums.push((sum, start));
    }
    let own = verdicts(&sines, settings, &Unobserved).unwrap();
    let general = verdicts(&sums, settings, &Unobserved).unwrap();
    for (own, general) in own.iter().zip(&general) {
        match (own, general) {
            (
                Verdict::Periodic { impacts, platform_periods, multipliers, .. },
                Verdict::Periodic { impacts: n, platform_periods: k, multipliers: other, .. },
            ) => {
                assert_eq!((impacts, platform_periods), (n, k));
                assert!((multipliers.spectral_radius() - other.spectral_radius()).abs() < 1e-7);
            }
            (Verdict::Chattering { cycle, .. }, Verdict::Chattering { cycle: other, .. }) => {
                if cycle.is_exact() && other.is_exact() {
                    let numbers = [cycle, other].map(|one| (one.platform_periods, one.long_flights));
                    assert_eq!(numbers[0], numbers[1]);
                }
            }
            // Rounding decides when a chaotic orbit comes to rest.
            (Verdict::Chaotic { .. }, Verdict::Chattering { cycle, .. })
            | (Verdict::Chattering { cycle, .. }, Verdict::Chaotic { .. }) => assert!(!cycle.is_exact()),
            (own, general) => {
                assert_eq!(
                    std::mem::discriminant(own),
                    std::mem::discriminant(general),
                    "{own:?} {general:?}"
                );
            }
        }
    }
    let search = AttractorSearch::default().with_starts(64).unwrap().with_impacts(300, 2_000).unwrap();
    for ((sine, _), (sum, _)) in sines.iter().zip(&sums).take(12) {
        let [own, general] = [
            sine.attractors(&search, &Unobserved).unwrap().all().to_vec(),
            Attractors::find(sum, &search, &Unobserved).unwrap().all().to_vec(),
        ];
        let orbits = |all: &[Attractor]| -> Vec<_> {
            let orbits = all.iter().filter(|own| own.starts.count() > 3).filter_map(|own| own.kind.orbit());
            orbits.map(|orbit| (orbit.period(), orbit.platform_periods)).collect()
        };
        let found: Vec<_> = general.iter().filter_map(|own| own.kind.orbit()).collect();
        for (n, k) in orbits(&own) {
            assert!(
                found.iter().any(|other| (other.period(), other.platform_periods) == (n, k)),
                "{sine}: {n} {k}"
            );
        }
        assert_eq!(own[0].kind.lasts(), general[0].kind.lasts(), "{sine}");
    }
    let mut settled = 0;
    for ((sine, start), (sum, _)) in sines.iter().zip(&sums) {
        let own = sine.settled_orbit(*start, 2_000, 8, 1e-7, &Unobserved).unwrap();
        let general = sum.settled_orbit(*start, 2_000, 8, 1e-7, &Unobserved).unwrap();
        assert_eq!(own.is_some(), general.is_some(), "{sine}");
        if let (Some(own), Some(general)) = (own, general) {
            settled += 1;
            assert_eq!((own.period(), own.platform_periods), (general.period(), general.platform_periods));
            assert!(general.states.iter().all(|at| own.distance(*at, PI) < 1e-9), "{sine}");
        }
        assert_eq!(sum.iterate(*start, 3, &Unobserved), sum.steps(*start, 3));
    }
    assert!(settled > 1, "{settled}");
    let exponents = [
        lyapunov_exponents(&sines, 100, 400, &Unobserved).unwrap(),
        lyapunov_exponents(&sums, 100, 400, &Unobserved).unwrap(),
    ];
    let spectra = lyapunov_spectra(&sums, 100, 400, &Unobserved).unwrap();
    for ((own, general), outcome) in exponents[0].iter().zip(&exponents[1]).zip(spectra) {
        // Rounding decides when a chaotic orbit comes to rest.
        let lasting = own.or(*general).filter(|_| own.is_none() || general.is_none());
        assert!(lasting.is_none_or(|exponent| exponent > 0.0), "{own:?} {general:?}");
        if let (Some(own), Some(general), LyapunovOutcome::Exponents(spectrum)) = (own, general, outcome) {
            // Rounding separates chaotic orbits, but not their means.
            let room = if *own > 0.0 { 5.0 * spectrum.standard_error + 0.05 } else { 1e-6 };
            assert!((own - general).abs() < room, "{own} {general}");
            if let (Some(second), Some(sum)) = (spectrum.second, spectrum.exact_sum) {
                assert!((spectrum.largest + second - sum).abs() < 1e-9, "{spectrum:?}");
            }
        }
    }
    let orbits = |index: usize| sums[index].0.orbit(sums[index].1, ChatterPolicy::Complete);
    let orbits: Vec<_> = (0..40).map(orbits).collect();
    let lives = survival_times(&orbits, 400, &Unobserved).unwrap();
    let own: Vec<_> = sines.iter().map(|(map, start)| map.orbit(*start, ChatterPolicy::Complete)).collect();
    for (own, general) in survival_times(&own, 400, &Unobserved).unwrap().into_iter().zip(lives) {
        // The number of summed impacts of a chatter differs.
        assert!(own >= 20 || general < 100, "{own} {general}: too soon for rounding");
    }
    assert_eq!(orbit_diagram(&orbits, 10, 5, &Unobserved).unwrap().len(), 40);
}

/// Without restitution a disk on a triangle leaves at each crest, and sticks at each trough, which hits it.
#[test]
fn a_kick_is_a_part_of_a_cycle() {
    let map = DrivenMap::new(Drive::triangle(1.0).unwrap(), 0.0).unwrap();
    let verdict = map.verdict(state(0.3, -1.0), VerdictSettings::default()).unwrap();
    let Verdict::Chattering { cycle, after } = verdict else { panic!("{verdict:?}") };
    assert_eq!((cycle.impacts, cycle.platform_periods, cycle.long_flights, after), (2, 1, 0, 0));
    assert!(cycle.is_exact());
}

/// A long contact keeps the disk forever on a gentle platform.
#[test]
fn a_disk_in_a_soft_contact_comes_to_rest_for_ever() {
    let gentle = DrivenMap::new(Drive::fourier(&[(0.5, 0.0)]).unwrap(), 0.5).unwrap();
    let soft = gentle.with_contact_time(0.3).unwrap();
    let verdict = soft.verdict(state(0.3, -1.0), VerdictSettings::default()).unwrap();
    assert!(matches!(verdict, Verdict::AtRest { .. }), "{verdict:?}");
}

/// arXiv 2004.10633 claims that the diagram depends on the order of the polynomial. At restitution 0.5
/// parabolas have period 1 from pi/12 to 5 pi/36 = 0.436, and chaotic bands immediately beyond. One cubic for
/// the whole period has period 1 only near its birth.
#[test]
fn parabolas_go_from_period_one_to_bands_and_one_cubic_has_it_next_to_its_birth() {
    let search = AttractorSearch::default().with_starts(256).unwrap();
    let kinds = |drive: Drive| {
        let map = DrivenMap::new(drive, 0.5).unwrap();
        let found = Attractors::find(&map, &search, &Unobserved).unwrap();
        let periods = found.all().iter().filter(|own| own.starts.count() > 0).map(|own| {
            own.kind.orbit().map_or(own.kind.name().to_owned(), |orbit| orbit.period().to_string())
        });
        periods.collect::<Vec<_>>()
    };
    let parabolas = |forcing: f64| kinds(Drive::parabolas(PI * forcing).unwrap());
    for forcing in [0.275, 0.35, 0.42, 0.435] {
        assert!(parabolas(forcing).contains(&"1".to_owned()), "{forcing}: {:?}", parabolas(forcing));
    }
    for forcing in [0.44, 0.45] {
        let found = parabolas(forcing);
        assert!(found.contains(&"chaotic".to_owned()), "{forcing}: {found:?}");
        assert!(!found.iter().any(|own| ["1", "2", "4"].contains(&own.as_str())), "{forcing}: {found:?}");
    }
    // t (t - pi) (t - 2 pi), with the largest height 2 pi^3/(3 sqrt 3).
    let cubic = |forcing: f64| {
        let scale = 3.0 * 3.0_f64.sqrt() / (2.0 * PI * PI * PI) * PI * forcing;
        Drive::pieces(&[(TAU, [0.0, 2.0 * PI * PI * scale, -3.0 * PI * scale, scale])]).unwrap()
    };
    let has_one = |forcing: f64| kinds(cubic(forcing)).contains(&"1".to_owned());
    assert!(has_one(0.235), "{:?}", kinds(cubic(0.235)));
    assert!(![0.2, 0.26, 0.3, 0.35, 0.4].into_iter().any(has_one));
}

/// Near its doubling, by hand at (pi/4) (1 + r^2)/(1 + r)^2, the one-impact orbit is never reported to
/// attract if it repels, nor omitted if it attracts. Near its birth at the corner, pi (1 - r)/(4 (1 + r)),
/// nothing fails.
#[test]
fn attractors_beside_the_doubling_and_the_corner_of_parabolas() {
    let search = AttractorSearch::default().with_starts(16).unwrap().with_impacts(300, 2_000).unwrap();
    let one_impact = |forcing: f64, r: f64| {
        let map = DrivenMap::new(Drive::parabolas(PI * forcing).unwrap(), r).unwrap();
        let found = Attractors::find(&map, &search, &Unobserved).unwrap();
        let own = found.all().iter().find(|own| own.kind.orbit().is_some_and(|orbit| orbit.period() == 1));
        own.map(|own| own.kind.name())
    };
    let r = 0.5;
    let doubling = 0.25 * PI * (1.0 + r * r) / ((1.0 + r) * (1.0 + r));
    let birth = 0.25 * PI * (1.0 - r) / (1.0 + r);
    for beside in [1e-8, 1e-12, f64::EPSILON] {
        let before = one_impact(doubling * (1.0 - beside), r);
        assert!(before.is_some(), "{r}, {beside}: {before:?}");
        let after = one_impact(doubling * (1.0 + beside), r);
        assert_ne!(after, Some("periodic"), "{r}, {beside}");
        assert_ne!(one_impact(birth * (1.0 - beside), r), Some("periodic"), "{r}, {beside}");
        one_impact(birth * (1.0 + beside), r);
    }
    assert_eq!(one_impact(doubling * (1.0 - 1e-6), r), Some("periodic"));
    assert_eq!(one_impact(birth * (1.0 + 1e-6), r), Some("periodic"));
}

/// A very short contact keeps the orbits without chatter, and a chatter has finitely many impacts; a long
/// contact leaves only rest on a gentle platform.
#[test]
fn soft_contacts_have_the_attractors_of_rigid_ones_where_they_are_short() {
    let search = AttractorSearch::default().with_starts(64).unwrap().with_impacts(300, 2_000).unwrap();
    let periods = |map: &DrivenMap| {
        let found = Attractors::find(map, &search, &Unobserved).unwrap();
        let orbits = found.all().iter().filter_map(|own| own.kind.orbit());
        let mut periods: Vec<_> = orbits.map(|orbit| (orbit.period(), orbit.platform_periods)).collect();
        periods.sort_unstable();
        (periods, matches!(found.all()[0].kind, AttractorKind::Rest(AfterRest::StaysForEver)))
    };
    for amplitude in [1.2, 1.4] {
        let rigid = DrivenMap::new(Drive::fourier(&[(amplitude, 0.0)]).unwrap(), 0.5).unwrap();
        let soft = rigid.clone().with_contact_time(1e-4).unwrap();
        let own = periods(&soft).0;
        assert!(periods(&rigid).0.iter().all(|orbit| own.contains(orbit)), "{own:?}");
    }
    let gentle = DrivenMap::new(Drive::fourier(&[(0.5, 0.0)]).unwrap(), 0.5).unwrap();
    assert_eq!(periods(&gentle.with_contact_time(0.3).unwrap()), (vec![], true));
}

/// A gentle arc whose end kicks the disk that has come to rest on it: no impact ends a flight.
#[test]
fn a_disk_that_is_only_kicked_has_no_impacts_and_a_cycle() {
    let arc = Drive::pieces(&[(TAU, [0.0, 0.05 * TAU, -0.05, 0.0])]).unwrap();
    for r in [0.0, 0.2] {
        let map = DrivenMap::new(arc.clone(), r).unwrap();
        let start = state(0.3, -0.1);
        let columns =
            orbit_diagram(&[map.orbit(start, ChatterPolicy::Complete)], 0, 50, &Unobserved).unwrap();
        assert!(columns[0].len() < 50, "{r}: {}", columns[0].len());
        let verdict = map.verdict(start, VerdictSettings::default()).unwrap();
        let Verdict::Chattering { cycle, .. } = verdict else { panic!("{r}: {verdict:?}") };
        assert_eq!((cycle.impacts, cycle.platform_periods), (1, 1), "{r}: {cycle:?}");
    }
}

impl Parabolas {
    fn end_of(&self, start: (f64, f64), r: f64) -> End {
        let followed = self.follow(start, r, 8_000);
        if followed.rests_for_ever || !followed.separations.is_empty() {
            return End::Rest;
        }
        let last = followed.impacts[7_999];
        let near = |lag: usize| {
            let before = followed.impacts[7_999 - lag];
            (last.0 - before.0).abs() < 1e-9 && (last.1 - before.1).abs() < 1e-9
        };
        if (1..257).any(near) { End::Cycle(last.0, last.1) } else { End::Other }
    }

    /// The first separation, and the periods, of the cycle of rests on which a resting start ends.
    fn rests(&self, start: (f64, f64), r: f64) -> Option<(f64, u64)> {
        let followed = self.follow(start, r, 100_000);
        let last = followed.separations.get(4)?;
        let first = followed.separations[..4].iter().rposition(|other| (other.0 - last.0).abs() < 1e-9)?;
        let cycle = &followed.separations[first..4];
        let phase = cycle.iter().map(|separation| separation.0).fold(f64::INFINITY, f64::min);
        Some((phase, last.3 - cycle[0].3))
    }

    /// Lines between `points` random points.
    fn zigzag(points: usize, height: f64, random: &mut SplitMix64) -> Self {
        let share = TAU / points as f64;
        let phases: Vec<f64> = (0..points)
            .map(|k| if k == 0 { 0.0 } else { share * (k as f64 + 0.8 * random.unit() - 0.4) })
            .collect();
        let heights: Vec<f64> = (0..points).map(|_| height * random.unit()).collect();
        let piece = |k: usize| {
            let (end, next) =
                if k + 1 < points { (phases[k + 1], heights[k + 1]) } else { (TAU, heights[0]) };
            (phases[k], [heights[k], (next - heights[k]) / (end - phases[k]), 0.0])
        };
        Self((0..points).map(piece).collect())
    }

    fn drive(&self) -> Drive {
        let piece = |k: usize| {
            let (start, [z, v, half]) = self.0[k];
            (self.end(k) - start, [z, v, half, 0.0])
        };
        Drive::pieces(&(0..self.0.len()).map(piece).collect::<Vec<_>>()).unwrap()
    }
}

fn through(found: &Attractors<DrivenMap>, (phase, velocity): (f64, f64)) -> bool {
    found.all().iter().filter_map(|own| own.kind.orbit()).any(|orbit| {
        orbit.states.iter().any(|at| {
            let apart = (at.phase().angle() - phase + PI).rem_euclid(TAU) - PI;
            let room = 1e-6 + orbit.position_error;
            apart.abs() < room && (at.velocity() - velocity).abs() < room * (1.0 + velocity.abs())
        })
    })
}

/// Every start ends on a found attractor, and every found attractor lasts.
#[test]
fn attractors_on_parabolas_are_those_of_quadratics() {
    let search = AttractorSearch::default().with_starts(256).unwrap().with_impacts(1_000, 20_000).unwrap();
    let mut random = SplitMix64::new(74);
    let mut kinds = [0; 5];
    for case in 0..30 {
        let (exact, map, [a, r]) = random_map(case, &mut random);
        let found = Attractors::find(&map, &search, &Unobserved).unwrap();
        let context = || {
            let all: Vec<_> =
                found.all().iter().map(|own| format!("{} ({})", own.kind, own.starts.count())).collect();
            format!("{case}: a = {a}, r = {r}: {all:?}, undecided {}", found.undecided().count())
        };
        for own in found.all() {
            let names = ["rest", "periodic", "marginal", "chaotic", "transient"];
            kinds[names.iter().position(|name| *name == own.kind.name()).unwrap()] += 1;
            if let AttractorKind::Periodic(known) = &own.kind {
                let at = known.orbit().states[0];
                let end = exact.end_of((at.phase().angle(), at.velocity()), r);
                let End::Cycle(phase, velocity) = end else { panic!("{}: {end:?}", context()) };
                assert!(through(&found, (phase, velocity)), "{}: {phase} {velocity}", context());
            }
        }
        let mut rests = Vec::new();
        for _ in 0..16 {
            let start = (TAU * random.unit(), -map.impact_speed_bound() * random.unit());
            match exact.end_of(start, r) {
                End::Rest => rests.extend(exact.rests(start, r)),
                End::Cycle(phase, velocity) => {
                    assert!(through(&found, (phase, velocity)), "{}: {phase} {velocity}", context());
                }
                End::Other => {
                    let other = found
                        .all()
                        .iter()
                        .any(|own| !matches!(own.kind, AttractorKind::Rest(_) | AttractorKind::Periodic(_)));
                    assert!(other || found.undecided().count() > 0, "{}", context());
                }
            }
        }
        if let AttractorKind::Rest(AfterRest::RestsAgain(cycle)) = &found.all()[0].kind
            && cycle.is_exact()
        {
            assert!(rests.iter().all(|rest| rest.1 == cycle.platform_periods), "{}: {rests:?}", context());
        }
    }
    assert!(kinds[1] > 5 && kinds[3] + kinds[4] > 2, "{kinds:?}");
}

/// If the platform has several crests, rests end at several phases and may belong to different cycles.
#[test]
fn rests_on_a_zigzag_are_one_cycle_or_several() {
    let search = AttractorSearch::default().with_starts(256).unwrap().with_impacts(500, 4_000).unwrap();
    let (mut random, mut several, mut two, mut one) = (SplitMix64::new(75), 0, 0, 0);
    for case in 0..100 {
        let (points, height, r) = (4 + 2 * (case % 2), 2.0 + 4.0 * random.unit(), 0.05 * random.unit());
        let exact = Parabolas::zigzag(points, height, &mut random);
        let map = DrivenMap::new(exact.drive(), r).unwrap();
        let found = Attractors::find(&map, &search, &Unobserved).unwrap();
        let mut cycles: Vec<(f64, u64)> = Vec::new();
        for _ in 0..100 {
            let start = (TAU * random.unit(), -map.impact_speed_bound() * random.unit());
            if let Some((phase, periods)) = exact.rests(start, r) {
                let same = |own: &&(f64, u64)| (own.0 - phase).abs() < 1e-9 && own.1 == periods;
                if !cycles.iter().any(|own| same(&own)) {
                    cycles.push((phase, periods));
                }
            }
        }
        let context = || format!("{case}: {height} {r} {}: {cycles:?}", found.all()[0].kind);
        match &found.all()[0].kind {
            AttractorKind::Rest(AfterRest::Several { last: true }) => {
                several += 1;
                // The oracle may have missed one.
                assert!(!cycles.is_empty(), "{}", context());
                two += usize::from(cycles.len() > 1);
            }
            AttractorKind::Rest(AfterRest::RestsAgain(cycle)) if cycle.is_exact() => {
                one += 1;
                assert!(cycles.iter().all(|own| own.1 == cycle.platform_periods), "{}", context());
                assert!(cycles.len() <= 1, "{}", context());
            }
            _ => {}
        }
    }
    assert!(several > 2 && 2 * two > several && one > 10, "{several} {two} {one}");
}

/// Every start within the radius of the orbit derived by hand ends on it.
#[test]
fn starts_within_the_radius_end_on_the_orbit_of_the_parabolas() {
    let (a, r) = (1.3, 0.5);
    let (map, exact) = (DrivenMap::new(Drive::parabolas(a).unwrap(), r).unwrap(), Parabolas::arcs(a));
    // The platform rises at pi (1 - r)/(1 + r) there.
    let phase = (4.0 * a / PI - PI * (1.0 - r) / (1.0 + r)) / (8.0 * a / (PI * PI));
    let orbit = map.refine(&[state(phase, -TAU / (1.0 + r))]).unwrap();
    let radius = orbit.trapping_radius(&map, 64, &Unobserved).unwrap();
    assert!(radius > 1e-3, "{radius}");
    let (mut random, speed) = (SplitMix64::new(72), map.drive().bounds().speed);
    for _ in 0..50 {
        let (angle, reach) = (TAU * random.unit(), radius * random.unit());
        let start = (phase + reach * cos(angle), -TAU / (1.0 + r) + reach * speed * sin(angle));
        let end = *exact.follow(start, r, 3_000).impacts.last().unwrap();
        assert!((end.0 - phase).abs() < 1e-9 && (end.1 + TAU / (1.0 + r)).abs() < 1e-9, "{start:?} {end:?}");
    }
}

/// Rows outside a grid are an error on every map.
#[test]
fn rows_outside_of_a_grid_are_refused() {
    let sine = ImpactMap::new(Vibration::from_axial_forcing(0.45).unwrap(), 0.5).unwrap();
    let driven = DrivenMap::new(Drive::triangle(1.0).unwrap(), 0.5).unwrap();
    let grid = Grid::new(Axis::new(0.0, 1.0, 4).unwrap(), Axis::new(0.0, 2.0, 4).unwrap()).unwrap();
    let settings = BasinSettings::default();
    for (first, end) in [(0, 5), (2, 2), (3, 1), (9, usize::MAX)] {
        let refusals = [
            sine.basins_of_rows(grid, first..end, &[], settings, &Unobserved),
            driven.basins_of_rows(grid, first..end, &[], settings, &Unobserved),
        ];
        for refused in refusals {
            assert!(matches!(refused, Err(Error::Unfitting { .. })), "{first}..{end}: {refused:?}");
        }
    }
}

fn driven(drive: Drive, restitution: f64) -> DrivenMap {
    DrivenMap::new(drive, restitution).unwrap()
}

/// Only the sine itself is the same map.
#[test]
fn orbits_of_another_map_are_refused() {
    let own = ImpactMap::new(Vibration::from_axial_forcing(0.2).unwrap(), 0.8).unwrap();
    let node = own.period_one_pair(1).unwrap().node.orbit(&own).unwrap().unwrap();
    let grid = Grid::new(Axis::new(0.0, 1.0, 4).unwrap(), Axis::new(0.0, 2.0, 4).unwrap()).unwrap();
    let (settings, known) = (BasinSettings::default(), [KnownOrbit::new(node.clone(), 0.01).unwrap()]);
    let misses = |result: Result<(), Error>| match result {
        Err(Error::NotAnOrbit { impact: 0, distance }) => distance,
        other => panic!("{other:?}"),
    };
    let (p, third) = (0.2 * PI, Drive::fourier(&[(0.2 * PI, 0.0), (0.0, 0.0), (0.01, 0.3)]));
    let sine = driven(Drive::from(*own.vibration()), 0.8);
    assert_eq!(sine.check_orbit(&node), Ok(()));
    sine.basins(grid, &known, settings, &Unobserved).unwrap();
    for other in [
        driven(Drive::parabolas(p).unwrap(), 0.8),
        driven(third.unwrap(), 0.8),
        driven(Drive::from(*own.vibration()), 0.79),
        sine.clone().with_contact_time(0.1).unwrap(),
    ] {
        assert!(misses(other.check_orbit(&node)) > 1e-3);
        misses(other.basins(grid, &known, settings, &Unobserved).map(drop));
    }
}

/// Orbits from searches, stable or not, also after storing and reading.
#[test]
fn own_orbits_are_never_refused() {
    let search = OrbitSearch::new(3, 4).unwrap().with_starts(10, 10).unwrap();
    let mut checked = 0;
    let two = Drive::fourier(&[(1.5, 0.2), (0.3, 1.0)]).unwrap();
    for own in [
        driven(Drive::parabolas(2.0).unwrap(), 0.6),
        driven(Drive::triangle(1.9).unwrap(), 0.4),
        driven(two.clone(), 0.0),
        driven(two.clone(), 0.9),
        driven(two, 0.5).with_contact_time(0.2).unwrap(),
    ] {
        for orbit in own.periodic_orbits(&search, &Unobserved).unwrap() {
            assert_eq!(
                own.check_orbit(&serde_json::from_str(&serde_json::to_string(&orbit).unwrap()).unwrap()),
                Ok(()),
                "{own:?} {orbit:?}"
            );
            checked += 1;
        }
    }
    assert!(checked > 20, "{checked}");
}
