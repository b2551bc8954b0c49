//! The phases at which a drive is lowest and rises fastest, and its largest speed.

use core::convert::Infallible;
use core::f64::consts::{FRAC_PI_2, PI, TAU};

use bouncing_disk_core::numerics::elementary::wrapped_angle;
use bouncing_disk_core::numerics::roots::bisection;

use super::pieces::Pieces;
use super::{Drive, DriveState, Fourier, Harmonic, Shape};

/// Difference, relative to the largest value, below which two values differ only by rounding.
const SAME: f64 = 64.0 * f64::EPSILON;

/// A phase in [0, 2 pi), with the height or the velocity.
type Candidate = (f64, f64);

impl Drive {
    /// The phase in [0, 2 pi) at which the platform is lowest: 3 pi/2 for a sine. If it is lowest more than
    /// once in a period, the result is the first of these phases. Which phase is first depends on where the
    /// period starts, for example where a recording begins. If the platform stays lowest for a while, the
    /// result is the start of this interval. Heights that differ by rounding count as equal. 0 for a platform
    /// that does not move.
    ///
    /// ```
    /// use std::f64::consts::PI;
    ///
    /// use bouncing_disk_drives::Drive;
    ///
    /// assert_eq!(Drive::fourier(&[(1.3, 0.0)])?.lowest_phase(), 1.5 * PI);
    /// // It falls up to the kink from which it rises again.
    /// let sawtooth = Drive::sawtooth(1.0, 0.3)?;
    /// assert_eq!(sawtooth.lowest_phase(), 0.85 * 2.0 * PI);
    /// assert!(sawtooth.velocity_before(sawtooth.lowest_phase()) < 0.0);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    #[must_use]
    pub fn lowest_phase(&self) -> f64 {
        match &self.shape {
            Shape::Fourier(fourier) => fourier.lowest_phase(),
            Shape::Pieces(pieces) => pieces.lowest_phase(),
        }
    }

    /// The phase in [0, 2 pi) at which the platform rises fastest: 0 for a sine. If several phases share the
    /// largest velocity up to rounding, the result is the first one after [`Self::lowest_phase`]; if the
    /// velocity jumps down from its largest value, the last double before the kink.
    #[must_use]
    pub fn fastest_rise_phase(&self) -> f64 {
        let candidates = match &self.shape {
            Shape::Fourier(fourier) => fourier.rises(),
            Shape::Pieces(pieces) => pieces.rises(),
        };
        let downwards = candidates.into_iter().map(|(phase, velocity)| (phase, -velocity));
        first_least(downwards.collect(), self.bounds().speed, self.lowest_phase())
    }

    /// The largest speed, upwards or downwards, in units of g/omega.
    ///
    /// ```
    /// use bouncing_disk_drives::Drive;
    ///
    /// // cos t + 2 cos 2 t is largest at t = 0; the sum of all harmonics bounds it from above in any case.
    /// let drive = Drive::fourier(&[(1.0, 0.0), (1.0, 0.0)])?;
    /// assert!((drive.peak_speed() - 3.0).abs() < 1e-15 && drive.bounds().speed == 3.0);
    /// // At other phases they do not add up.
    /// let drive = Drive::fourier(&[(1.0, 0.0), (1.0, 1.0)])?;
    /// assert!(drive.peak_speed() < 2.9 && drive.bounds().speed == 3.0);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    #[must_use]
    pub fn peak_speed(&self) -> f64 {
        match &self.shape {
            Shape::Fourier(fourier) => fourier.peak_speed(),
            Shape::Pieces(pieces) => pieces.bounds.speed,
        }
    }
}

/// The first of the phases from `start` at which the value is smallest up to rounding.
fn first_least(candidates: Vec<Candidate>, size: f64, start: f64) -> f64 {
    let least = candidates.iter().fold(f64::INFINITY, |least, (_, value)| value.min(least));
    let after = |phase: f64| if phase < start { phase + TAU } else { phase };
    let equal = candidates.into_iter().filter(|(_, value)| *value <= least + SAME * size);
    let first = equal.map(|(phase, _)| phase).reduce(|a, b| if after(b) < after(a) { b } else { a });
    first.unwrap_or(0.0)
}

impl Harmonic {
    /// The first time in [0, 2 pi) at which the sine has this phase for a positive amplitude, or the opposite
    /// phase for a negative one.
    fn first_at(&self, phase: f64) -> f64 {
        let phase = if self.amplitude < 0.0 { wrapped_angle(phase + PI) } else { phase };
        wrapped_angle(phase - self.angle) / self.number
    }
}

impl Fourier {
    fn lowest_phase(&self) -> f64 {
        if let [harmonic] = self.harmonics[..] {
            return harmonic.first_at(1.5 * PI);
        }
        let bounds = self.bounds();
        let size = bounds.highest.abs().max(bounds.lowest.abs());
        first_least(self.minima(|at| (at.height, at.velocity), self.bounds.acceleration), size, 0.0)
    }

    /// The maxima of the velocity that may be its largest value.
    fn rises(&self) -> Vec<Candidate> {
        if let [harmonic] = &self.harmonics[..] {
            let phase = wrapped_angle(self.lowest_phase() + FRAC_PI_2 / harmonic.number);
            return vec![(phase, self.at(phase).velocity)];
        }
        let minima = self.minima(|at| (-at.velocity, -at.acceleration), self.bounds.jerk);
        minima.into_iter().map(|(phase, value)| (phase, -value)).collect()
    }

    fn peak_speed(&self) -> f64 {
        match self.harmonics[..] {
            [Harmonic { number, amplitude, .. }] => amplitude.abs() * number,
            _ => {
                let down = self.minima(|at| (at.velocity, at.acceleration), self.bounds.jerk);
                let both = self.rises().into_iter().chain(down);
                both.fold(0.0, |most, (_, velocity)| velocity.abs().max(most))
            }
        }
    }

    /// The minima that may be the smallest value of a function, which `of` returns with its slope. If `bend`
    /// bounds the second derivative, a minimum is at most bend d^2/8 below the nearest of samples a distance
    /// d apart.
    fn minima(&self, of: impl Fn(&DriveState) -> (f64, f64), bend: f64) -> Vec<Candidate> {
        if self.harmonics.is_empty() {
            return Vec::new();
        }
        let count = 64 * self.highest_harmonic() as usize;
        let spacing = TAU / count as f64;
        let time = |k: usize| k as f64 * spacing;
        let samples: Vec<f64> = (0..count).map(|k| of(&self.at(time(k))).0).collect();
        let least = samples.iter().fold(f64::INFINITY, |least, value| value.min(least));
        let mut minima = Vec::new();
        for (k, &here) in samples.iter().enumerate() {
            let (before, after) = (samples[(k + count - 1) % count], samples[(k + 1) % count]);
            if here <= before && here <= after && here <= least + 0.25 * bend * spacing * spacing {
                let falls = |t: f64| Ok::<_, Infallible>(of(&self.at(t)).1 < 0.0);
                let Ok(time) = bisection(time(k) - spacing, time(k) + spacing, 64, falls);
                let phase = wrapped_angle(time);
                minima.push((phase, of(&self.at(phase)).0));
            }
        }
        minima
    }
}

impl Pieces {
    fn lowest_phase(&self) -> f64 {
        let mut candidates = Vec::new();
        for piece in 0..self.count() {
            let (start, [c0, c1, c2, c3]) = (self.starts[piece], self.coefficients[piece]);
            candidates.push((start, c0));
            // The root of c1 + 2 c2 x + 3 c3 x^2 at which this slope rises.
            let root = (c2 * c2 - 3.0 * c1 * c3).max(0.0).sqrt();
            let x = if c2 >= 0.0 { -c1 / (c2 + root) } else { (root - c2) / (3.0 * c3) };
            if x > 0.0 && x < self.length(piece) {
                candidates.push((start + x, self.at(start + x).height));
            }
        }
        let size = self.bounds.highest.abs().max(self.bounds.lowest.abs());
        let first = first_least(candidates, size, 0.0);
        // A platform that does not move at phase 0 has been there since an earlier phase.
        let stays = |piece: &usize| self.coefficients[*piece][1..] == [0.0; 3];
        let stayed = (0..self.count()).rev().take_while(|piece| stays(piece) && first == 0.0).last();
        stayed.map_or(first, |piece| self.starts[piece])
    }

    /// The places at which the velocity may be the largest.
    fn rises(&self) -> Vec<Candidate> {
        let mut candidates = Vec::new();
        for piece in 0..self.count() {
            let (start, [_, c1, c2, c3]) = (self.starts[piece], self.coefficients[piece]);
            candidates.push((start, c1));
            let x = -c2 / (3.0 * c3);
            let mut add = |time: f64| candidates.push((time, self.at(time).velocity));
            if c3 < 0.0 && x > 0.0 && x < self.length(piece) {
                add(start + x);
            }
            let next = (piece + 1) % self.count();
            if self.jumps[next] < 0.0 {
                add(self.starts[piece + 1].next_down());
            }
        }
        candidates
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bouncing_disk_core::numerics::random::SplitMix64;

    /// Sums, pieces, splines and kinks, selected by number.
    fn drive(k: u64) -> Drive {
        let mut random = SplitMix64::new(k);
        let mut within = |size: f64| size * (2.0 * random.unit() - 1.0);
        let harmonics = |count: usize, within: &mut dyn FnMut(f64) -> f64| {
            (0..count).map(|_| (within(1.0), within(3.0))).collect::<Vec<_>>()
        };
        let drive = match k % 6 {
            0 => Drive::fourier(&harmonics(1, &mut within)),
            1 => Drive::fourier(&harmonics(5, &mut within)),
            2 => Drive::fourier(&harmonics(32, &mut within)),
            3 => Drive::sawtooth(1.0, 0.5 + 0.49 * within(1.0)),
            4 => Drive::sampled(&(0..7).map(|_| within(1.0)).collect::<Vec<_>>()),
            _ => Drive::cubics(1.0).and_then(|drive| drive.earlier(3.0 + within(3.0))),
        };
        drive.expect("legal")
    }

    /// At none of many phases is the platform lower or faster, and it attains each extreme.
    #[test]
    fn no_other_phase_is_lower_or_faster() {
        for k in 0..120 {
            let drive = drive(k);
            let (lowest, fastest) = (drive.lowest_phase(), drive.fastest_rise_phase());
            assert!((0.0..TAU).contains(&lowest) && (0.0..TAU).contains(&fastest), "{k}: {lowest} {fastest}");
            let (height, rise) = (drive.height(lowest), drive.velocity(fastest));
            let peak = drive.peak_speed();
            assert!(peak <= drive.bounds().speed * (1.0 + 1e-15), "{k}");
            let (mut least, mut most, mut steepest) = (f64::INFINITY, f64::NEG_INFINITY, 0.0_f64);
            for step in 0..20_000 {
                let at = drive.at(f64::from(step) * (TAU / 20_000.0));
                least = at.height.min(least);
                most = at.velocity.max(most);
                steepest = at.velocity.abs().max(steepest);
            }
            let rounding = 1e-14 * drive.bounds().speed;
            // Within a step of an extreme the value differs by its second derivative, at a kink by the first.
            let step = TAU / 20_000.0;
            let off = 0.5 * step * step;
            let kink = if drive.kinks().count() > 0 { step * drive.bounds().speed } else { 0.0 };
            let (bend, jerk) = (off * drive.bounds().acceleration + kink, drive.bounds().jerk);
            assert!(height <= least + rounding && height > least - bend - rounding, "{k}: {height} {least}");
            assert!(rise >= most - rounding && rise < most + off * jerk + rounding, "{k}: {rise} {most}");
            assert!(peak >= steepest - rounding && peak < steepest + off * jerk + rounding, "{k}: {peak}");
        }
    }

    /// A shifted drive is lowest and rises fastest earlier by the same amount.
    #[test]
    fn the_extremes_of_a_shifted_drive_are_shifted() {
        let apart = |one: f64, other: f64| {
            let apart = wrapped_angle(one - other);
            apart.min(TAU - apart)
        };
        for k in 0..60 {
            let drive = drive(k);
            for shift in
                [1e-16, 1e-9, 0.3, 0.5 * PI, 2.0, PI, 4.0, 1.5 * PI, 6.0, TAU - 1e-9, TAU.next_down()]
            {
                let shifted = drive.earlier(shift).expect("finite");
                for of in [Drive::lowest_phase, Drive::fastest_rise_phase] {
                    let off = apart(of(&shifted) + shift, of(&drive));
                    assert!(off < 1e-7, "{k} {shift}: {} {}", of(&shifted), of(&drive));
                }
                assert!((shifted.peak_speed() - drive.peak_speed()).abs() < 1e-14 * drive.bounds().speed);
            }
        }
    }

    #[test]
    fn extremes_that_several_phases_share_have_a_rule() {
        let (sine, falls) = (Drive::fourier(&[(0.7, 0.0)]), Drive::fourier(&[(-0.7, 0.0)]));
        let (sine, falls) = (sine.expect("legal"), falls.expect("legal"));
        assert_eq!((sine.lowest_phase(), sine.fastest_rise_phase()), (1.5 * PI, 0.0));
        assert_eq!((falls.lowest_phase(), falls.fastest_rise_phase()), (0.5 * PI, PI));
        let twice = Drive::fourier(&[(0.0, 0.0), (0.7, 0.0)]).expect("legal");
        assert_eq!((twice.lowest_phase(), twice.fastest_rise_phase()), (0.75 * PI, PI));
        // The first of two equal ones; the other one for a period that begins between them.
        let later = twice.earlier(0.8 * PI).expect("finite");
        assert!((later.lowest_phase() - (1.75 - 0.8) * PI).abs() < 1e-14, "{}", later.lowest_phase());
        // Straight lines: from the kink on.
        let sawtooth = Drive::sawtooth(1.0, 0.3).expect("legal");
        let trough = sawtooth.kinks().find(|(_, jump)| *jump > 0.0).expect("there is one").0;
        assert_eq!((sawtooth.lowest_phase(), sawtooth.fastest_rise_phase()), (trough, trough));
        // It waits at its lowest point, whatever the phase at which a period begins.
        let quarter = 0.25 * TAU;
        let line = |from: f64, to: f64| (quarter, [from, (to - from) / quarter, 0.0, 0.0]);
        let waits = Drive::pieces(&[line(0.0, 1.0), line(1.0, 0.0), line(0.0, 0.0), line(0.0, 0.0)]);
        let waits = waits.expect("legal");
        assert_eq!(waits.lowest_phase().to_bits(), (2.0 * quarter).to_bits());
        let shifted = waits.earlier(0.6 * TAU).expect("finite");
        assert!((shifted.lowest_phase() - 0.9 * TAU).abs() < 1e-15, "{}", shifted.lowest_phase());
        let still = Drive::pieces(&[(TAU, [0.3, 0.0, 0.0, 0.0])]).expect("legal");
        assert_eq!((still.lowest_phase(), Drive::fourier(&[]).expect("legal").lowest_phase()), (0.0, 0.0));
        // Faster and faster up to a kink.
        let (speed, bend) = (1.0 / PI, 1.0 / (PI * PI));
        let rises = [(PI, [0.0, 0.0, bend, 0.0]), (PI, [1.0, -speed, 0.0, 0.0])];
        let rises = Drive::pieces(&rises).expect("legal");
        assert_eq!(rises.fastest_rise_phase().to_bits(), PI.next_down().to_bits());
    }
}
