//! Finds the start of a rise in a record: rows before the switch-on, or in a dead time, have constant speed.

use bouncing_disk_core::numerics::elementary::{exp, ln};
use bouncing_disk_core::run::WorkCount;

use crate::error::Error;
use crate::statistics::correlation_time;

/// The fewest points of a curve that is fitted.
pub(crate) const LEAST_POINTS: usize = 8;

/// Step of the trial time constants, in their logarithm.
const STEP: f64 = 0.05;

/// The fit omits initial rows if this lowers the logarithm of the sum of squares, over all independent rows, by
/// more than this number, half of Akaike's penalty for the two added parameters. An unnecessary cut costs rows;
/// a missing one causes a bias.
const PRICE: f64 = 2.0;

/// Sums of squared residuals below this share of the sum of squared speeds are rounding.
const EXACT: f64 = 1.0e-13;

/// The number of rows before the rise. The record is cut so that a constant speed before the cut and a
/// saturating exponential after it leave the smallest sum of squares. It stays whole if the cut does not
/// describe it better.
pub(crate) fn rows_before_rise(
    times: &[f64],
    speeds: &[f64],
    work: &mut WorkCount<'_>,
) -> Result<usize, Error> {
    let n = times.len();
    let most = n.saturating_sub(LEAST_POINTS);
    let mean = speeds.iter().sum::<f64>() / n as f64;
    let speeds: Vec<f64> = speeds.iter().map(|speed| speed - mean).collect();
    let least = EXACT * speeds.iter().map(|speed| speed * speed).sum::<f64>();
    let duration = (times[n - 1] - times[0]).min(f64::MAX);
    let shortest = times.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
    let shortest = shortest.max(duration / (10 * n) as f64);
    let (low, high) = (ln(shortest), ln(100.0) + ln(duration));
    // For each cut the least squares after it, with the logarithm of their constant, and the squares for the
    // last two constants.
    let mut behind = vec![(f64::INFINITY, 0.0); most + 1];
    let mut last = vec![[f64::INFINITY; 2]; most + 1];
    for trial in 0..=((high - low) / STEP) as u32 {
        let log = low + STEP * f64::from(trial);
        work.spend(1 + n as u64 / 4)?;
        let constant = exp(log);
        let (mut count, mut y, mut yy, mut e, mut ee, mut ey) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        for k in (0..n).rev() {
            let (speed, decay) = (speeds[k], exp((times[0] - times[k]) / constant));
            count += 1.0;
            y += speed;
            yy += speed * speed;
            e += decay;
            ee += decay * decay;
            ey += decay * speed;
            if k > most {
                continue;
            }
            let (spread, product) = (ee - e * e / count, ey - e * y / count);
            let taken = if spread > 1e-12 * ee { product * product / spread } else { 0.0 };
            let squares = (yy - y * y / count - taken).max(0.0);
            let [before, at] = last[k];
            // The vertex of the parabola through the last three, relative to the middle one.
            let bend = before - 2.0 * at + squares;
            let has_bottom = at <= before && at <= squares && bend > 0.0 && bend.is_finite();
            let (bottom, place) = if has_bottom {
                let place = 0.5 * (before - squares) / bend;
                ((at - 0.5 * bend * place * place).max(0.0), log + STEP * (place - 1.0))
            } else {
                (squares, log)
            };
            if bottom < behind[k].0 {
                behind[k] = (bottom, place);
            }
            last[k] = [at, squares];
        }
    }
    let (mut sum, mut squares) = (0.0, 0.0);
    let mut best = (behind[0].0 + least, 0);
    for k in 1..=most {
        sum += speeds[k - 1];
        squares += speeds[k - 1] * speeds[k - 1];
        let all = (squares - sum * sum / k as f64).max(0.0) + behind[k].0 + least;
        if all < best.0 {
            best = (all, k);
        }
    }
    let (squares, cut) = best;
    if cut == 0 {
        return Ok(0);
    }
    let residuals = residuals(&times[cut..], &speeds[cut..], exp(behind[cut].1));
    let correlated = correlation_time(&residuals, 3).unwrap_or(0.125 * n as f64);
    let gain = n as f64 / correlated * ln((behind[0].0 + least) / squares);
    Ok(if gain > PRICE { cut } else { 0 })
}

/// The residuals of the best exponential with this constant.
fn residuals(times: &[f64], speeds: &[f64], constant: f64) -> Vec<f64> {
    let n = times.len() as f64;
    let decays: Vec<f64> = times.iter().map(|time| exp((times[0] - time) / constant)).collect();
    let (decay, speed) = (decays.iter().sum::<f64>() / n, speeds.iter().sum::<f64>() / n);
    let spread: f64 = decays.iter().map(|own| (own - decay) * (own - decay)).sum();
    let product: f64 = decays.iter().zip(speeds).map(|(own, value)| (own - decay) * (value - speed)).sum();
    let slope = if spread > 0.0 { product / spread } else { 0.0 };
    decays.iter().zip(speeds).map(|(own, value)| value - speed - slope * (own - decay)).collect()
}
