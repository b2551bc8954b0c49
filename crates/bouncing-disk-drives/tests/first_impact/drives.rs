//! Flights above drives of every kind, judged by the oracle.
//!
//! The oracle of flights (`drive_oracle.rs`) demands that the stated error of each root is true, that no root is
//! earlier, and that at each doubt rounding hides the sign. The launches cover joints and their neighbours,
//! speeds from 1e-280 to flights of 1e4 periods, and grazes of crests and corners.
//!
//! In the campaign the oracle judges in 256 bits 500 launches of each drive, its first 500 doubts and its first
//! 500 impacts on kinks:
//!
//! ```text
//! CAMPAIGN_SIZE=1000000 cargo test -p bouncing-disk-drives --test first_impact -- --ignored drive_campaign --nocapture
//! ```
//!
//! | drive | launches | doubts | on kinks | most evaluations | doubts in 256 bits | true hits | otherwise |
//! | --- | --- | --- | --- | --- | --- | --- | --- |
//! | 3 harmonics | 1,000,006 | 24,671 | 0 | 58 | 513 | 338 | 47 |
//! | 32 harmonics | 1,000,014 | 22,340 | 0 | 117 | 515 | 312 | 39 |
//! | triangle | 1,000,015 | 8,239 | 20,065 | 6 | 502 | 407 | 29 |
//! | sawtooth | 1,000,015 | 8,551 | 20,016 | 6 | 506 | 370 | 42 |
//! | parabolas | 1,000,004 | 16,933 | 0 | 5 | 509 | 385 | 38 |
//! | cubics | 1,000,006 | 17,050 | 0 | 469 | 512 | 355 | 57 |
//! | cubic arcs with kinks | 1,000,001 | 22,712 | 100,653 | 251 | 509 | 362 | 42 |
//! | spline, 8 to 207 samples | 1,000,008 | 25,070 | 0 | 880 | 520 | 320 | 96 |
//!
//! Amplitudes are 1e-2 to 1e4, and three launches in ten are grazes with gaps of 1e-16 to 1e-2. No impact was
//! missed or invented. In 256 bits (9,144 launches) each doubt is confirmed; the last two columns count how many
//! truly hit, and how many go otherwise than the double decides.

use std::f64::consts::TAU;

use bouncing_disk_core::run::in_parallel;
use bouncing_disk_core::{Launch, Phase, Vibration};
use bouncing_disk_drives::Drive;
use bouncing_disk_drives::drive::DrivenImpact;

use crate::drive_oracle::{Flight, Heights};
use crate::launches::SplitMix;
use crate::numbers::Dd;
use crate::oracle::High;
use crate::shards;

/// A drive, with the data that an oracle needs.
pub struct Exact {
    pub drive: Drive,
    /// The harmonics (amplitude, angle) of a Fourier drive, otherwise empty.
    pub harmonics: Vec<(f64, f64)>,
    /// The starts of the pieces, and 2 pi.
    pub joints: Vec<f64>,
}

impl Exact {
    fn fourier(harmonics: Vec<(f64, f64)>) -> Self {
        let drive = Drive::fourier(&harmonics).unwrap();
        Self { drive, harmonics, joints: Vec::new() }
    }

    fn pieces(drive: Drive) -> Self {
        let mut joints = vec![0.0];
        while let Some(joint) = drive.next_joint(joints[joints.len() - 1]).filter(|joint| joint.time > 0.0) {
            joints.push(joint.time);
        }
        joints.push(TAU);
        Self { drive, harmonics: Vec::new(), joints }
    }

    /// Whether the impact after a launch at `time` with relative speed `w` is the true one: see
    /// [`Flight::judge`].
    fn judge(&self, at: &Heights<'_, Dd>, time: f64, w: f64, landing: &DrivenImpact) -> Result<(), String> {
        let (impact, h) = (&landing.impact, landing.impact.duration());
        let pull = 1.0 + self.drive.acceleration(time);
        if h < 1e-140 && pull > 1e-6 {
            // The squares of the oracle would underflow: the parabola is exact to all digits.
            let near = (h * pull - 2.0 * w).abs() <= 1e-9 * w && (impact.velocity + w).abs() <= 1e-14 * w;
            return if near { Ok(()) } else { Err("not the parabola".to_owned()) };
        }
        Flight::new(at, time, w).judge(landing).map(drop)
    }
}

/// A kind of drive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    ThreeHarmonics,
    ManyHarmonics,
    Triangle,
    Sawtooth,
    Parabolas,
    Cubics,
    Polygon,
    Spline,
}

pub const KINDS: [Kind; 8] = [
    Kind::ThreeHarmonics,
    Kind::ManyHarmonics,
    Kind::Triangle,
    Kind::Sawtooth,
    Kind::Parabolas,
    Kind::Cubics,
    Kind::Polygon,
    Kind::Spline,
];

impl Kind {
    pub fn draw(self, random: &mut SplitMix) -> Exact {
        let a = random.decades(-2.0, 4.0);
        match self {
            Self::ThreeHarmonics => Exact::fourier(
                (1..4).map(|j| (a * random.uniform(-1.0, 1.0) / f64::from(j), random.angle())).collect(),
            ),
            Self::ManyHarmonics => Exact::fourier(
                (1..33).map(|j| (a * random.uniform(-1.0, 1.0) / f64::from(j * j), random.angle())).collect(),
            ),
            Self::Triangle => Exact::pieces(Drive::triangle(a).unwrap()),
            Self::Sawtooth => Exact::pieces(Drive::sawtooth(a, random.uniform(0.05, 0.95)).unwrap()),
            Self::Parabolas => Exact::pieces(Drive::parabolas(a).unwrap()),
            Self::Cubics => Exact::pieces(Drive::cubics(a).unwrap()),
            Self::Polygon => polygon(a, random),
            Self::Spline => {
                let count = 8 + random.below(200);
                let (phase, third) = (random.angle(), random.unit());
                let time = |k: usize| k as f64 / count as f64 * TAU;
                let samples: Vec<_> = (0..count)
                    .map(|k| a * (libm::sin(time(k) + phase) + 0.3 * third * libm::sin(3.0 * time(k))))
                    .collect();
                Exact::pieces(Drive::sampled(&samples).unwrap())
            }
        }
    }
}

/// Cubic arcs between random heights, with a kink at each joint.
fn polygon(a: f64, random: &mut SplitMix) -> Exact {
    let count = 2 + random.below(6);
    let mut joints = vec![0.0];
    for k in 1..count {
        joints.push(TAU * (k as f64 + random.uniform(-0.3, 0.3)) / count as f64);
    }
    joints.push(TAU);
    let heights: Vec<_> = (0..count).map(|_| a * random.uniform(-1.0, 1.0)).collect();
    let pieces: Vec<_> = (0..count)
        .map(|k| {
            let d = joints[k + 1] - joints[k];
            let (c2, c3) = (a * random.uniform(-1.0, 1.0), a * random.uniform(-1.0, 1.0));
            let c1 = (heights[(k + 1) % count] - heights[k]) / d - d * (c2 + d * c3);
            (d, [heights[k], c1, c2, c3])
        })
        .collect();
    Exact::pieces(Drive::pieces(&pieces).unwrap())
}

/// A time in [0, 2 pi), most often on or near a seam.
fn seam(of: &Exact, random: &mut SplitMix) -> f64 {
    let time = match random.below(4) {
        0 => random.angle(),
        1 => 0.0,
        2 if !of.joints.is_empty() => of.joints[random.below(of.joints.len())],
        2 => 0.5 * TAU,
        _ => TAU,
    };
    let time = match random.below(4) {
        0 => time,
        1 => (0..=random.below(3)).fold(time, |t, _| t.next_down()),
        2 => (0..=random.below(3)).fold(time, |t, _| t.next_up()),
        _ => time + random.sign() * random.decades(-15.0, -3.0),
    };
    time.clamp(0.0, TAU.next_down())
}

/// A launch that grazes a crest or a corner, by a little more or less.
fn graze(of: &Exact, random: &mut SplitMix) -> Option<(f64, f64)> {
    let touch = if of.joints.len() > 2 && random.unit() < 0.5 {
        of.joints[random.below(of.joints.len() - 1)]
    } else {
        random.angle()
    };
    let at = of.drive.at(touch);
    let before = of.drive.velocity(touch - 1e-9);
    let slope = at.velocity + random.unit() * (before - at.velocity);
    let height = at.height + random.sign() * random.decades(-16.0, -2.0);
    let disk = |t: f64| height + t * (slope - 0.5 * t);
    let gap = |t: f64| disk(t) - of.drive.height(touch + t);
    // Back to the time when it was on the platform.
    let mut t = -random.decades(-3.0, 0.0);
    let mut step = 0.05;
    if gap(t) <= 0.0 {
        return None;
    }
    while gap(t - step) > 0.0 {
        t -= step;
        step *= 1.1;
        if t < -60.0 {
            return None;
        }
    }
    let (mut lo, mut hi) = (t - step, t);
    for _ in 0..100 {
        let m = 0.5 * (lo + hi);
        if gap(m) > 0.0 {
            hi = m;
        } else {
            lo = m;
        }
    }
    let time = (touch + hi).rem_euclid(TAU);
    let speed = slope - hi - of.drive.velocity(touch + hi);
    (speed > 0.0 && time < TAU).then_some((time, speed))
}

/// A launch on a seam.
fn launch(of: &Exact, random: &mut SplitMix) -> Option<(f64, f64)> {
    if random.unit() < 0.3 {
        return graze(of, random);
    }
    let time = seam(of, random);
    let speed = match random.below(6) {
        0 => random.decades(-280.0, -10.0),
        1 => random.decades(-12.0, -6.0),
        2 => random.decades(-6.0, 0.0),
        3 => random.decades(4.0, 4.8),
        _ => (1.0 + of.drive.bounds().speed) * 2.0 * random.unit(),
    };
    Some((time, speed))
}

#[derive(Debug, Default)]
struct Tally {
    launches: u64,
    doubts: u64,
    kinks: u64,
    evaluations: u32,
    /// The launch that needed the most evaluations.
    longest: String,
    /// Launches judged by the high-precision oracle, the doubts among them, the true hits among the doubts,
    /// and the doubts that the solver decides wrongly.
    judged: u64,
    judged_doubts: u64,
    hits: u64,
    otherwise: u64,
    failures: Vec<String>,
}

/// Sends a share of the launches, of the doubts and of the impacts on kinks to the high-precision oracle.
fn attack(kind: Kind, seed: u64, launches: u64) -> Tally {
    let (every, most) = ((launches / 500).max(100), (launches / 200).min(500));
    let mut random = SplitMix::new(seed);
    let mut tally = Tally::default();
    while tally.launches < launches {
        let exact = kind.draw(&mut random);
        let (near, wide) = (Heights::<Dd>::new(&exact), Heights::<High>::new(&exact));
        for _ in 0..20 {
            let Some((time, speed)) = launch(&exact, &mut random) else { continue };
            tally.launches += 1;
            let start = || format!("{kind:?} from {time:?} at {speed:e}, {} joints", exact.joints.len());
            let verdict = match exact.drive.first_impact_from(time, 0.0, speed) {
                Ok(landing) => {
                    tally.doubts += u64::from(landing.doubt.is_some());
                    tally.kinks += u64::from(landing.on_kink);
                    if landing.impact.evaluations > tally.evaluations {
                        tally.evaluations = landing.impact.evaluations;
                        tally.longest = format!("{}: {landing:?}", start());
                    }
                    let mut verdict = exact.judge(&near, time, speed, &landing);
                    let hard = landing.doubt.is_some() && tally.doubts <= most
                        || landing.on_kink && tally.kinks <= most;
                    if verdict.is_ok() && (hard || tally.launches.is_multiple_of(every)) {
                        verdict = Flight::new(&wide, time, speed).judge(&landing).map(|(hit, otherwise)| {
                            tally.judged += 1;
                            tally.judged_doubts += u64::from(landing.doubt.is_some());
                            tally.hits += u64::from(hit);
                            tally.otherwise += u64::from(otherwise);
                        });
                    }
                    verdict.map_err(|reason| format!("{landing:?}: {reason}"))
                }
                Err(error) => Err(error.to_string()),
            };
            if let Err(reason) = verdict {
                tally.failures.push(format!(
                    "{reason}; {} {:?} {:?}",
                    start(),
                    exact.harmonics,
                    exact.joints
                ));
            }
        }
    }
    tally
}

fn check(kind: Kind, seed: u64, launches: u64) {
    let tally = attack(kind, seed, launches);
    let (count, failures) = (tally.failures.len(), &tally.failures);
    assert!(failures.is_empty(), "{count} of {launches}:\n{}", failures[..count.min(4)].join("\n"));
    // Three in ten are built to graze, with gaps from 1e-16 to 1e-2.
    assert!(tally.doubts < launches / 8, "{tally:?}");
}

#[test]
fn launches_on_seams_of_fourier_sums() {
    check(Kind::ThreeHarmonics, 71, 3_000);
    check(Kind::ManyHarmonics, 72, 400);
}

#[test]
fn launches_on_seams_of_corners() {
    check(Kind::Triangle, 73, 30_000);
    check(Kind::Sawtooth, 74, 30_000);
    check(Kind::Polygon, 75, 30_000);
}

#[test]
fn launches_on_seams_of_smooth_pieces() {
    check(Kind::Parabolas, 76, 30_000);
    check(Kind::Cubics, 77, 30_000);
    check(Kind::Spline, 78, 5_000);
}

/// A campaign of 400,000 launches of each kind.
#[test]
#[ignore = "a campaign of some minutes"]
fn drive_campaign() {
    let launches = shards::size(400_000);
    let tallies =
        in_parallel(KINDS.len(), |kind| attack(KINDS[kind], shards::seed(1_000 + kind as u64), launches));
    println!("{tallies:#?}");
    assert!(tallies.iter().all(|tally| tally.failures.is_empty()));
}

/// From the same state before each event the sum gives the same events as the sine's own solver.
#[test]
fn a_sine_as_a_fourier_sum_lands_where_the_sine_does() {
    let mut random = SplitMix::new(51);
    let mut worst = 0.0_f64;
    let seams = [0.0, f64::MIN_POSITIVE, TAU.next_down(), 0.25 * TAU, 0.5 * TAU, 0.75 * TAU];
    for k in 0..250_000 {
        let peak = libm::exp10(3.0 * random.unit() - 1.0);
        let vibration = Vibration::new(peak).unwrap();
        let drive = Drive::fourier(&[(peak, 0.0)]).unwrap();
        let separation = vibration.separation_phase().map_or(0.0, |phase| phase.angle());
        let phase = match k % 4 {
            0 => *seams.get(random.below(7)).unwrap_or(&separation),
            _ => random.angle(),
        };
        let phase = Phase::new(phase).unwrap();
        let decades = if k % 16 == 1 { 250.0 } else { 6.0 };
        let speed = (1.0 + peak) * 3.0 * random.unit() * libm::exp10(-decades * random.unit());
        let launch = Launch::new(phase, speed).unwrap();
        let sine = vibration.first_impact(launch).unwrap();
        let sum = drive.first_impact(launch).unwrap();
        let apart = (sum.impact.duration() - sine.duration()).abs();
        let legal = 1e-12 * sine.duration() + 4.0 * sum.error;
        assert!(apart <= legal, "{peak} {phase:?} {speed:e}: {sine:?} {sum:?}");
        assert_eq!(sum.impact.turns, sine.turns);
        // A slow impact is uncertain by the rounding of the heights over its speed.
        if sine.velocity < -1e-3 * (1.0 + peak) {
            worst = worst.max(apart / sine.duration());
        }
    }
    assert!(worst < 1e-12, "{worst:e}");
}

/// A flight interrupted at a random time continues to the same impact as a disk in the air.
#[test]
fn an_interrupted_flight_lands_at_the_same_place() {
    let mut random = SplitMix::new(97);
    let mut compared = 0;
    while compared < 20_000 {
        let exact = KINDS[compared % KINDS.len()].draw(&mut random);
        let drive = &exact.drive;
        for _ in 0..20 {
            let Some((time, speed)) = launch(&exact, &mut random) else { continue };
            let landing = drive.first_impact_from(time, 0.0, speed).unwrap();
            let t = landing.impact.duration() * random.uniform(0.05, 0.95);
            let from = drive.at(time);
            let (u, there) = (from.velocity + speed, drive.at(time + t));
            let gap = from.height - there.height + t * (u - 0.5 * t);
            let bounds = drive.bounds();
            // The change of the impact by the rounding of this point.
            let size = bounds.highest - bounds.lowest + (1.0 + t) * (bounds.speed + u.abs() + t);
            let shift = 1e-14 * size / -landing.impact.velocity;
            let grazes = landing.doubt.is_some() || landing.on_kink || shift > 1e-9;
            if gap <= 1e-9 * size
                || grazes
                || exact.closest(time, speed, landing.impact.duration()) < 1e-9 * size
            {
                continue;
            }
            let again = drive.first_impact_from(time + t, gap, u - t - there.velocity).unwrap();
            let apart = (again.impact.duration() + t - landing.impact.duration()).abs();
            assert!(
                apart < 100.0 * shift + 1e-12,
                "{apart:e}: {landing:?}, from {t} on {again:?}, {drive:?}"
            );
            compared += 1;
        }
    }
}

impl Exact {
    /// The smallest sampled minimum of the gap in a flight: near a graze it is small.
    fn closest(&self, time: f64, w: f64, duration: f64) -> f64 {
        let from = self.drive.at(time);
        let gap = |t: f64| from.height - self.drive.height(time + t) + t * (from.velocity + w - 0.5 * t);
        let samples = 400.0;
        let gaps: Vec<_> = (0..400_u32).map(|k| gap(duration * f64::from(k) / samples)).collect();
        let dip = gaps.windows(3).filter(|three| three[1] <= three[0] && three[1] <= three[2]);
        dip.fold(f64::INFINITY, |least, three| {
            least.min(three[1] - (three[0] - three[1]).max(three[2] - three[1]))
        })
    }
}

/// A flight that is not followed to its impact has no impact up to the limit.
#[test]
fn flights_are_followed_to_a_limit() {
    let mut random = SplitMix::new(98);
    let (mut landed, mut flown) = (0, 0);
    while landed + flown < 4_000 {
        let exact = KINDS[random.below(KINDS.len())].draw(&mut random);
        let (time, speed) = (random.angle(), random.decades(-6.0, 1.3));
        let landing = exact.drive.first_impact_from(time, 0.0, speed).unwrap();
        if landing.doubt.is_some() {
            continue;
        }
        let limit = landing.impact.duration() * random.uniform(0.3, 1.7);
        let late = limit - landing.impact.duration();
        match exact.drive.first_impact_within(time, 0.0, speed, limit).unwrap() {
            Some(within) => {
                landed += 1;
                let apart = (within.impact.duration() - landing.impact.duration()).abs();
                assert!(apart <= landing.error + within.error && late >= -landing.error, "{late} {within:?}");
            }
            None => {
                flown += 1;
                assert!(late <= landing.error, "{late} {landing:?}");
            }
        }
    }
    assert!(landed > 300 && flown > 300, "{landed} {flown}");
}

/// Drives of all kinds.
fn draws(random: &mut SplitMix) -> impl Iterator<Item = Drive> {
    KINDS.into_iter().cycle().map(|kind| kind.draw(random).drive)
}

/// The derivatives up to the next joint, against the drive.
#[test]
fn derivatives_are_those_of_the_motion() {
    let mut random = SplitMix::new(92);
    for drive in draws(&mut random).take(900) {
        let bounds = drive.bounds();
        for time in [0.0, 0.7, 2.0, 4.4] {
            let left = drive.next_joint(time).map_or(0.5, |joint| joint.after);
            for step in 0..8 {
                let after = left * f64::from(step) / 8.0;
                let there = drive.at(time + after);
                for (order, value, sizes) in [
                    (0, there.height, bounds.highest - bounds.lowest + bounds.speed),
                    (1, there.velocity, bounds.speed + bounds.acceleration),
                    (2, there.acceleration, bounds.acceleration + bounds.jerk),
                ] {
                    let error = drive.derivative(order, time).at(after, left).value - value;
                    assert!(error.abs() <= 1e-14 * sizes, "{order} {time} {after}: {error:e} {drive:?}");
                }
            }
        }
    }
}

#[test]
fn changes_are_those_of_the_motion_and_keep_their_digits() {
    let mut random = SplitMix::new(93);
    for drive in draws(&mut random).take(900) {
        let bounds = drive.bounds();
        for (time, span) in [(0.3, 4.0), (2.0, 1.0), (3.0, 1e-9)] {
            let (from, to) = (drive.at(time), drive.at(time + span));
            let (mut kinks, mut kinked, mut here, mut passed) = (0.0, false, time, 0.0);
            while let Some(kink) = drive.next_kink(here).filter(|kink| passed + kink.after <= span) {
                let jump = drive.velocity(kink.time) - drive.velocity_before(kink.time);
                assert!((jump - kink.velocity_jump).abs() <= 1e-15 * bounds.speed);
                (here, passed) = (kink.time, passed + kink.after);
                (kinks, kinked) = (kinks + jump, true);
            }
            let (velocity, height) = drive.change(time, span);
            let error = velocity + kinks - (to.velocity - from.velocity);
            assert!(error.abs() <= 1e-11 * (bounds.speed + bounds.acceleration), "{error:e} {drive:?}");
            let error = height - (to.height - from.height - from.velocity * span);
            assert!(kinked || error.abs() <= 1e-11 * (bounds.speed + bounds.highest), "{error:e} {drive:?}");
            if span < 1e-6 {
                // Accurate to the rounding of the acceleration.
                let rounding = 1e-14 * span * bounds.acceleration;
                let first = from.acceleration * span + 0.5 * from.jerk * span * span;
                assert!((velocity - first).abs() <= rounding, "{drive:?}");
                let lift = 0.5 * from.acceleration * span * span + from.jerk * span * span * span / 6.0;
                assert!((height - lift).abs() <= rounding * span, "{drive:?}");
            }
        }
    }
}

/// Steep sawtooths: the times of their joints are rounded.
#[test]
fn sawtooths_of_any_rise_join_and_may_be_shifted() {
    let mut random = SplitMix::new(98);
    for rise in [1e-9, 1e-7, 1e-6, 5e-5, 1e-4, 0.3, 0.999_99, 1.0 - 1e-6] {
        let amplitude = 1e-3;
        let drive = Drive::sawtooth(amplitude, rise).unwrap();
        for _ in 0..200 {
            let shifted = drive.earlier(random.angle()).unwrap();
            assert!(shifted.max_height() <= amplitude * (1.0 + 1e-4));
        }
    }
}

/// Over whole periods the changes repeat, except for the ramp of a velocity that kinks reverse.
#[test]
fn changes_over_many_periods_are_those_of_one() {
    let drive = Drive::pieces(&[(2.0, [0.0, 1.0, -0.5, 0.0]), (TAU - 2.0, [0.0; 4])]).unwrap();
    let (velocity, height) = drive.change(0.5, TAU);
    let (twice, higher) = drive.change(0.5, 2.0 * TAU);
    assert!((twice - 2.0 * velocity).abs() < 1e-13 && velocity != 0.0);
    assert!((higher - (2.0 * height + TAU * velocity)).abs() < 1e-12);
    assert!(drive.change(0.5, 1e15).0.is_finite());
}
