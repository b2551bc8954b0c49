//! A measured waveform as a periodic cubic spline.

use core::f64::consts::TAU;

use bouncing_disk_core::Error;
use bouncing_disk_core::parts::within;

use super::Drive;
use super::pieces::MAX_PIECES;

impl Drive {
    /// The periodic cubic spline through heights sampled at equal distances over one period; the first sample
    /// is at time 0 and again at 2 pi.
    ///
    /// ```
    /// use std::f64::consts::TAU;
    ///
    /// use bouncing_disk_drives::Drive;
    /// use bouncing_disk_core::numerics::elementary::sin;
    ///
    /// let samples: Vec<_> = (0..64).map(|k| sin(k as f64 / 64.0 * TAU)).collect();
    /// let drive = Drive::sampled(&samples)?;
    /// assert!((drive.height(1.0) - sin(1.0)).abs() < 1e-6);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for fewer than 3 samples or too large accelerations; [`Error::NotOfKind`] names
    /// a sample that is not finite; [`Error::TooLarge`] beyond [`MAX_PIECES`].
    pub fn sampled(heights: &[f64]) -> Result<Self, Error> {
        let count = heights.len();
        if count > MAX_PIECES {
            return Err(Error::TooLarge { what: "samples", count: count as u64, limit: MAX_PIECES as u64 });
        }
        within("number of samples", count as f64, 3.0, MAX_PIECES as f64, "[3, 1048576]")?;
        if let Some(index) = heights.iter().position(|height| !height.is_finite()) {
            return Err(Error::NotOfKind { what: "sample", index, count, expected: "finite" });
        }
        let starts: Vec<_> =
            (0..=count).map(|k| if k == count { TAU } else { k as f64 / count as f64 * TAU }).collect();
        let h = TAU / count as f64;
        let y = |k: usize| heights[k % count];
        let right: Vec<_> =
            (0..count).map(|k| 6.0 * ((y(k + 1) - y(k)) - (y(k) - y(k + count - 1))) / (h * h)).collect();
        let bends = cyclic(&right);
        let pieces = (0..count)
            .map(|k| {
                let (here, next) = (bends[k], bends[(k + 1) % count]);
                let slope = (y(k + 1) - y(k)) / h - h * (2.0 * here + next) / 6.0;
                [y(k), slope, 0.5 * here, (next - here) / (6.0 * h)]
            })
            .collect();
        Self::joined(starts, pieces)
    }
}

/// The solution of x_(k-1) + 4 x_k + x_(k+1) = b_k with cyclic indices: the inverse is a sum over powers of
/// the root -2 + sqrt 3, and powers above the 60th are below rounding.
fn cyclic(right: &[f64]) -> Vec<f64> {
    let root = 3.0_f64.sqrt() - 2.0;
    let count = right.len();
    let mut forward = vec![0.0; count];
    let mut backward = vec![0.0; count];
    // Two recursions, each warmed up over the end of the cycle.
    let warm = 60;
    let mut sum = 0.0;
    for k in 0..count + warm {
        let at = (k + count * warm - warm) % count;
        sum = root * sum + right[at];
        if k >= warm {
            forward[at] = sum;
        }
    }
    sum = 0.0;
    for k in (0..count + warm).rev() {
        let at = k % count;
        if k < count {
            backward[at] = root * sum;
        }
        sum = root * sum + right[at];
    }
    // The weight 1/(2 sqrt 3) of the power zero.
    let weight = 0.5 / 3.0_f64.sqrt();
    forward.iter().zip(&backward).map(|(forward, backward)| weight * (forward + backward)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_circle_is_solved() {
        for count in [3, 4, 17, 16_384] {
            let right: Vec<_> = (0..count).map(|k| ((k * 37 % 101) as f64) - 50.0).collect();
            let x = cyclic(&right);
            for k in 0..count {
                let sum = x[(k + count - 1) % count] + 4.0 * x[k] + x[(k + 1) % count];
                assert!((sum - right[k]).abs() < 1e-12, "{count} {k}: {sum} {}", right[k]);
            }
        }
    }

    /// The spline through the zeros and the extremes of the sine is [`Drive::cubics`].
    #[test]
    fn four_samples_make_the_cubic_approximation() {
        let (spline, cubics) =
            (Drive::sampled(&[0.0, 2.0, 0.0, -2.0]).expect("legal"), Drive::cubics(2.0).expect("legal"));
        for k in 0..100 {
            let (a, b) = (spline.at(0.0628 * f64::from(k)), cubics.at(0.0628 * f64::from(k)));
            assert!((a.height - b.height).abs() < 1e-14 && (a.acceleration - b.acceleration).abs() < 1e-13);
        }
        assert_eq!(spline.kinks().count() + cubics.kinks().count(), 0);
    }
}
