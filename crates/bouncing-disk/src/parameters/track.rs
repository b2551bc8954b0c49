//! One motion of the platform, its height or its angle: the core's [`Drive`] and what its derivatives are made
//! of, for the roots of friction.

use std::f64::consts::TAU;
use std::sync::Arc;

use bouncing_disk_core::Drive;
use bouncing_disk_core::Error;
use bouncing_disk_core::flight::DriveState;
use bouncing_disk_core::numerics::elementary::{sin_cos, wrapped_angle};
use bouncing_disk_core::numerics::quasi_polynomial::{DampedSine, QuasiPolynomial};

/// (amplitude + rate t) sin(number t + angle).
#[derive(Debug, Clone, Copy, PartialEq)]
struct Sine {
    number: f64,
    amplitude: f64,
    rate: f64,
    angle: f64,
}

/// The height of a platform, or its angle, over time in radians of its fundamental.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Track {
    drive: Drive,
    sines: Arc<[Sine]>,
    /// When the pieces begin, in [0, 2 pi).
    knots: Arc<[f64]>,
    /// When the velocity jumps, and by how much.
    kinks: Arc<[(f64, f64)]>,
}

/// The next time of a list: how far away, when, and what belongs to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Next {
    pub(crate) after: f64,
    pub(crate) time: f64,
    pub(crate) jump: f64,
}

impl Track {
    /// A sum of a_j sin(j t + phi_j).
    pub(crate) fn sines(harmonics: &[(f64, f64)]) -> Result<Self, Error> {
        let ramps: Vec<_> = harmonics.iter().map(|&(amplitude, angle)| (amplitude, 0.0, angle)).collect();
        Ok(Self::of_sines(Drive::fourier(harmonics)?, &ramps))
    }

    /// A sum of (a_j + b_j t) sin(j t + phi_j) for t in [0, `duration`].
    pub(crate) fn ramps(harmonics: &[(f64, f64, f64)], duration: f64) -> Result<Self, Error> {
        Ok(Self::of_sines(Drive::ramped_fourier(harmonics, duration)?, harmonics))
    }

    fn of_sines(drive: Drive, harmonics: &[(f64, f64, f64)]) -> Self {
        let sines = harmonics
            .iter()
            .enumerate()
            .filter(|(_, (amplitude, rate, _))| *amplitude != 0.0 || *rate != 0.0)
            .map(|(index, &(amplitude, rate, angle))| Sine {
                number: (index + 1) as f64,
                amplitude,
                rate,
                angle: wrapped_angle(angle),
            })
            .collect();
        Self { drive, sines, knots: Arc::new([]), kinks: Arc::new([]) }
    }

    /// Pieces (duration, [c0, c1, c2, c3]) of one period.
    pub(crate) fn pieces(pieces: &[(f64, [f64; 4])]) -> Result<Self, Error> {
        let drive = Drive::pieces(pieces)?;
        // The same sums as the core's.
        let sums = pieces.iter().scan(0.0, |time, (duration, _)| {
            let start = *time;
            *time += duration;
            Some(start)
        });
        let knots = sums.collect();
        Ok(Self::of_knots(drive, knots))
    }

    /// The periodic cubic spline through these.
    pub(crate) fn sampled(samples: &[f64]) -> Result<Self, Error> {
        let drive = Drive::sampled(samples)?;
        let count = samples.len() as f64;
        let knots = (0..samples.len()).map(|k| k as f64 / count * TAU).collect();
        Ok(Self::of_knots(drive, knots))
    }

    fn of_knots(drive: Drive, knots: Arc<[f64]>) -> Self {
        let kinks = drive.kinks().collect();
        Self { drive, sines: Arc::new([]), knots, kinks }
    }

    /// The same period of pieces begun at `phase` (rad): the piece that holds there is cut in two.
    pub(crate) fn earlier(self, phase: f64) -> Result<Self, Error> {
        let phase = wrapped_angle(phase);
        if phase == 0.0 {
            return Ok(self);
        }
        let first = self.knots.partition_point(|&knot| knot <= phase);
        let (before, after) = self.knots.split_at(first);
        let starts: Vec<_> = [&phase].into_iter().chain(after).chain(before).copied().collect();
        let ends = starts.iter().cycle().skip(1);
        let pieces = starts.iter().zip(ends).map(|(&start, &end)| {
            let (at, duration) =
                (self.at(start), if end > start { end - start } else { end + (TAU - start) });
            (duration, [at.height, at.velocity, 0.5 * at.acceleration, at.jerk / 6.0])
        });
        // A start at a knot leaves a piece without duration.
        Self::pieces(&pieces.filter(|(duration, _)| *duration < TAU).collect::<Vec<_>>())
    }

    pub(crate) const fn drive(&self) -> &Drive {
        &self.drive
    }

    pub(crate) fn at(&self, time: f64) -> DriveState {
        self.drive.at(time)
    }

    /// The velocity just before `time`.
    pub(crate) fn velocity_before(&self, time: f64) -> f64 {
        let jump = self.kinks.iter().find(|(kink, _)| kink.to_bits() == time.to_bits());
        self.drive.velocity(time) - jump.map_or(0.0, |(_, jump)| *jump)
    }

    /// Until when the track is defined: infinite unless it is a ramp.
    pub(crate) fn duration(&self) -> f64 {
        self.drive.duration()
    }

    pub(crate) fn is_still(&self) -> bool {
        self.drive.bounds().speed == 0.0
    }

    /// The highest number of a harmonic.
    pub(crate) fn highest_number(&self) -> f64 {
        self.sines.iter().fold(1.0, |most, sine| sine.number.max(most))
    }

    /// The next start of a piece after `time`.
    pub(crate) fn next_knot(&self, time: f64) -> Option<Next> {
        let first = *self.knots.first()?;
        let index = self.knots.partition_point(|&knot| knot <= time);
        Some(match self.knots.get(index) {
            Some(&knot) => Next { after: knot - time, time: knot, jump: 0.0 },
            None => Next { after: first + (TAU - time), time: first, jump: 0.0 },
        })
    }

    /// The next jump of the velocity after `time`.
    pub(crate) fn next_kink(&self, time: f64) -> Option<Next> {
        let first = *self.kinks.first()?;
        let index = self.kinks.partition_point(|&(kink, _)| kink <= time);
        Some(match self.kinks.get(index) {
            Some(&(kink, jump)) => Next { after: kink - time, time: kink, jump },
            None => Next { after: first.0 + (TAU - time), time: first.0, jump: first.1 },
        })
    }

    /// How much the velocity changes from `time` on in a `span` without kinks, and the height less the first
    /// velocity times the span: both accurate relative to themselves in a short span.
    pub(crate) fn change(&self, time: f64, span: f64) -> (f64, f64) {
        let (mut here, mut left, mut velocity, mut height) = (time, span, 0.0, 0.0);
        if self.knots.is_empty() {
            let value = |derivative, slope| {
                let mut bend = Bend::default();
                self.add(derivative, time, 1.0, &mut bend);
                bend.from([0.0, slope], [0.0; 2]).map_or(f64::NAN, |function| function.at(span, span).value)
            };
            return (value(1, self.at(time).acceleration), value(0, 0.0));
        }
        while left > 0.0 {
            let (at, next) = (self.at(here), self.next_knot(here));
            let h = next.map_or(left, |next| next.after.min(left));
            height += h * (velocity + h * (0.5 * at.acceleration + h * at.jerk / 6.0));
            velocity += h * (at.acceleration + 0.5 * h * at.jerk);
            let Some(next) = next.filter(|next| next.after < left) else { break };
            (here, left) = (next.time, left - next.after);
        }
        (velocity, height)
    }

    /// A derivative (1 or 2) from `time` to the next knot, and a constant.
    pub(crate) fn derivative(
        &self,
        derivative: usize,
        time: f64,
        constant: f64,
    ) -> Result<QuasiPolynomial, Error> {
        let (here, mut bend) = (self.at(time), Bend::default());
        self.add(derivative, time, 1.0, &mut bend);
        let values = [here.height, here.velocity, here.acceleration, here.jerk];
        bend.from([constant + values[derivative], values[derivative + 1]], [0.0; 2])
    }

    /// Adds `factor` times a derivative (0 to 2) about `time`, less its value and slope there.
    pub(crate) fn add(&self, derivative: usize, time: f64, factor: f64, bend: &mut Bend) {
        if derivative == 1 && !self.knots.is_empty() {
            bend.square += 0.5 * factor * self.at(time).jerk;
        }
        for &Sine { number, amplitude, rate, angle } in self.sines.iter() {
            // The sine of the derivative and that of the one below it, as coefficients of cosine and sine.
            let (sin, cos) = sin_cos(number * time + angle);
            let (mut own, mut below, mut power) = ([sin, cos], [0.0; 2], factor);
            for _ in 0..derivative {
                (own, below) = ([own[1], -own[0]], own.map(|x| x * power));
                power *= number;
            }
            let (size, turns) = (power * (amplitude + rate * time), derivative as f64 * rate);
            let mut push = |[cosine, sine]: [f64; 2], with_time| {
                bend.terms.push(DampedSine { cosine, sine, frequency: number, decay: 0.0, with_time });
            };
            push([size * own[0] + turns * below[0], size * own[1] + turns * below[1]], false);
            if rate != 0.0 {
                push(own.map(|x| power * rate * x), true);
            }
        }
    }
}

/// What bends a function away from its first value and slope: a square and sines.
#[derive(Debug, Default)]
pub(crate) struct Bend {
    square: f64,
    terms: Vec<DampedSine>,
}

impl Bend {
    /// The function with this value and slope at its start, known to these errors.
    pub(crate) fn from(self, start: [f64; 2], errors: [f64; 2]) -> Result<QuasiPolynomial, Error> {
        QuasiPolynomial::anchored(start, errors, [self.square, 0.0], self.terms)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tracks() -> [Track; 4] {
        let half = 0.5 * TAU;
        [
            Track::sines(&[(1.2, 0.3), (0.0, 0.0), (0.4, 5.0)]).expect("legal"),
            Track::ramps(&[(1.2, 0.1, 0.3), (0.2, -0.05, 2.0)], 20.0).expect("legal"),
            Track::pieces(&[(half, [0.0, half, -1.0, 0.0]), (half, [0.0, -half, 1.0, 0.0])]).expect("legal"),
            Track::sampled(&[0.0, 1.0, 0.3, -0.7, -0.1, 0.2]).expect("legal"),
        ]
    }

    /// Velocity and acceleration by the terms, as far as the next knot, and by the drive.
    #[test]
    fn the_terms_are_those_of_the_drive() {
        for track in tracks() {
            for time in [0.0, 0.7, 2.0, 4.4, 6.1] {
                let velocity = track.derivative(1, time, 0.0).expect("legal");
                let acceleration = track.derivative(2, time, 1.0).expect("legal");
                let span = track.next_knot(time).map_or(3.0, |next| next.after);
                for step in 0..8 {
                    let after = span * f64::from(step) / 8.0;
                    let there = track.at(time + after);
                    let error = velocity.at(after, span).value - there.velocity;
                    assert!(error.abs() < 1e-13, "{track:?} {time} {after}: {error:e}");
                    let error = acceleration.at(after, span).value - (1.0 + there.acceleration);
                    assert!(error.abs() < 1e-13, "{track:?} {time} {after}: {error:e}");
                }
            }
        }
    }

    #[test]
    fn changes_are_those_of_the_drive_and_keep_their_digits() {
        for track in tracks() {
            for (time, span) in [(0.3, 5.0), (2.0, 1.0), (4.0, 7.0), (3.0, 1e-9)] {
                let (from, to) = (track.at(time), track.at(time + span));
                let kinks: f64 = (0..2)
                    .flat_map(|turn| {
                        track.kinks.iter().map(move |&(kink, jump)| (kink + f64::from(turn) * TAU, jump))
                    })
                    .filter(|&(kink, _)| kink > time && kink <= time + span)
                    .map(|(_, jump)| jump)
                    .sum();
                let (velocity, height) = track.change(time, span);
                assert!((velocity + kinks - (to.velocity - from.velocity)).abs() < 1e-13, "{track:?} {time}");
                if kinks == 0.0 {
                    let direct = to.height - from.height - from.velocity * span;
                    assert!((height - direct).abs() < 1e-13, "{track:?} {time} {span}");
                }
                if span < 1e-6 {
                    let first = from.acceleration * span + 0.5 * from.jerk * span * span;
                    assert!((velocity - first).abs() < 1e-14 * first.abs(), "{track:?}");
                    let lift = 0.5 * from.acceleration * span * span + from.jerk * span * span * span / 6.0;
                    assert!((height - lift).abs() < 1e-14 * lift.abs(), "{track:?}");
                }
            }
        }
    }

    #[test]
    fn knots_come_one_after_the_other() {
        let [sines, _, pieces, sampled] = tracks();
        assert_eq!(sines.next_knot(1.0), None);
        let next = pieces.next_knot(0.5 * TAU).expect("there are two");
        assert!((next.after - 0.5 * TAU).abs() < 1e-15 && next.time == 0.0);
        assert!((0..6).all(|k| sampled.next_knot(f64::from(k)).is_some_and(|next| next.after > 0.0)));
    }
}
