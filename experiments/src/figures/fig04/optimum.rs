//! What Sec. III B says of the best toss, compared with the curves.

use bouncing_disk::core::numerics::elementary::{atan, tan};

use super::best::{Best, Compromise};
use super::tosses::LagCurve;
use super::{Curves, pi};
use crate::claims::judging::LINE_WIDTH;
use crate::claims::{Claim, Verdict, catalogue};
use crate::experiment::{ExperimentError, Paper};
use crate::figures::shared::numbers;

/// Why the optimum of Table I as printed is another one.
const COARSE_GRID: &str = "ω rounded in Table I, maximum read off a coarse grid of φ_L";

/// A curve of the picture, of which places are read off.
struct Drawn {
    angles: Vec<f64>,
    values: Vec<f64>,
    low: f64,
    high: f64,
}

impl Drawn {
    fn new(angles: &[f64], values: Vec<f64>) -> Self {
        let (low, high) = numbers::extent(values.iter().copied());
        // Without twist, at the first angles, there is no ratio.
        Self { angles: angles[angles.len() - values.len()..].to_vec(), values, low, high }
    }

    /// By how much it is lower than its maximum at an angle, linear between its points, as a share of what it spans.
    fn lower_at(&self, angle: f64) -> f64 {
        let next = self.angles[1..].partition_point(|end| *end < angle).min(self.angles.len() - 2) + 1;
        let (from, to) = (self.angles[next - 1], self.angles[next]);
        let (one, other) = (self.values[next - 1], self.values[next]);
        let value = one + (other - one) * (angle - from) / (to - from);
        (self.high - value) / (self.high - self.low)
    }

    /// The angles, linear between the points, at which it is lower than its maximum by no more than a line's width: the first
    /// and the last, and their share of the range by its length.
    fn accepted(&self) -> (f64, f64, f64) {
        let above = |value: f64| value - (self.high - LINE_WIDTH * (self.high - self.low));
        let (mut first, mut last, mut length) = (f64::INFINITY, f64::NEG_INFINITY, 0.0);
        let points = || self.angles.iter().zip(&self.values);
        for ((from, one), (to, other)) in points().zip(points().skip(1)) {
            let (one, other) = (above(*one), above(*other));
            let crossing = from + (to - from) * one / (one - other);
            let (start, end) = match (one >= 0.0, other >= 0.0) {
                (true, true) => (*from, *to),
                (true, false) => (*from, crossing),
                (false, true) => (crossing, *to),
                (false, false) => continue,
            };
            (first, last, length) = (first.min(start), last.max(end), length + end - start);
        }
        let (from, to) = numbers::extent(self.angles.iter().copied());
        (first, last, length / (to - from))
    }
}

/// A place of a maximum, judged on the curve.
fn place(key: &str, computed: f64, printed: f64, curve: &Drawn) -> Claim {
    let (from, to, share) = curve.accepted();
    Claim::printed(key, computed).at_printed_place(curve.lower_at(printed), share).note(format!(
        "as high from {} to {}, {:.0} % of the range",
        pi(from),
        pi(to),
        100.0 * share
    ))
}

/// `lossless` is the efficiency of the fastest toss if friction losses do not count as input.
pub(super) fn claims(
    fig: &mut Paper<'_>,
    data: &Curves,
    [absolute, relative]: &[Best; 2],
    between: &Compromise,
    [lossless, at_printed_optimum]: [f64; 2],
) -> Result<(), ExperimentError> {
    let drawn = &data.families[0].curves;
    let linear = &drawn[0];
    let angles = &data.amplitude_angle_rad;
    let (fastest, efficient) = (&linear.fastest, &linear.most_efficient);
    let of_speed = Drawn::new(angles, linear.airborne_speed_rad_per_s.clone());
    let of_efficiency = Drawn::new(angles, linear.efficiency.clone());
    let of_ratio = Drawn::new(angles, linear.speed_ratio.iter().copied().flatten().collect());

    // A lag of π is the same motion the other way.
    let is_linear = |of: fn(&LagCurve) -> f64| {
        let best = drawn.iter().max_by(|one, other| of(one).total_cmp(&of(other)));
        best.is_some_and(|curve| curve.n.is_multiple_of(8))
    };
    fig.claim(Claim::printed_statement(
        "section3.optimal_phase_lag",
        is_linear(|curve| curve.fastest.airborne_speed_rad_per_s.abs())
            && is_linear(|curve| curve.most_efficient.efficiency),
        format!(
            "of all lags, a dough at rest is thrown fastest at θ = {} and most efficiently at {} (or π more); one that starts with the hand \
             fastest, {:.2} rad/s, at θ = {}, φ_L = {}",
            pi(absolute.fastest_phase_lag_rad),
            pi(absolute.most_efficient_phase_lag_rad),
            relative.fastest.airborne_speed_rad_per_s,
            pi(relative.fastest_phase_lag_rad),
            pi(relative.fastest.amplitude_angle_rad),
        ),
    ));

    // The numbers of the best toss, and with which parameters they come out.
    let grid = &data.consistency.coarse_grid;
    let case = &grid.reading.parameters;
    let reason = format!(
        "all numbers result with ω = {:.2} rad/s, a_g = {:.4} m and the best of {} steps of φ_L",
        case.angular_frequency_rad_per_s, case.gyration_radius_m, grid.intervals
    );
    let (angle, ratio) =
        (fastest.amplitude_angle_rad, catalogue::number("section3.optimal_amplitude_ratio", 0)?);
    let printed_angle = catalogue::number("section3.optimal_amplitude_angle", 0)?.value;
    let numbers = [
        place("section3.optimal_amplitude_angle", angle, printed_angle, &of_speed),
        place("section3.optimal_amplitude_ratio", tan(angle), atan(ratio.value), &of_speed),
        Claim::printed("section3.largest_airborne_speed", fastest.airborne_speed_rad_per_s),
        Claim::printed("section3.largest_efficiency", fastest.efficiency)
            .note(format!("{lossless:.3} if friction losses do not count as input")),
        Claim::printed("section3.speed_ratio_at_optimum", fastest.speed_ratio.unwrap_or(f64::NAN)),
    ];
    fig.claims(numbers.map(|claim| {
        let claim = if claim.verdict == Verdict::Differs { claim.note(&reason) } else { claim };
        claim.cause(COARSE_GRID)
    }));

    // The paper reads one φ_L for the largest speed and the largest efficiency off its curves.
    let lower = of_efficiency.lower_at(fastest.amplitude_angle_rad);
    fig.claim(Claim::printed_statement(
        "section3.one_optimum",
        lower <= LINE_WIDTH,
        format!(
            "θ = 0: largest speed at φ_L = {}, largest efficiency at {}; the efficiency is {:.4} at the first and {:.4} at the second, \
             lower by {:.2} % of its span",
            pi(fastest.amplitude_angle_rad),
            pi(efficient.amplitude_angle_rad),
            fastest.efficiency,
            efficient.efficiency,
            100.0 * lower,
        ),
    ));

    // max |ν| and its place are read off the drawn curves.
    let ratios = || drawn.iter().map(|curve| curve.largest_speed_ratio.ratio());
    let firmest = drawn
        .iter()
        .max_by(|one, other| one.largest_speed_ratio.ratio().total_cmp(&other.largest_speed_ratio.ratio()));
    let firmest = firmest.unwrap_or(linear);
    let largest = firmest.largest_speed_ratio.ratio();
    let at_zero = &linear.largest_speed_ratio;
    let as_high = ratios().filter(|ratio| largest - ratio <= LINE_WIDTH).count();
    fig.claim(
        Claim::printed("section3.largest_speed_ratio", largest)
            .note(format!("among the curves θ = nπ/8 of the figure, the one for n = {}", firmest.n)),
    );
    let key = "section3.amplitude_angle_of_largest_speed_ratio";
    let printed_angle = catalogue::number(key, 0)?.value;
    fig.claim(place(key, at_zero.amplitude_angle_rad, printed_angle, &of_ratio));
    fig.claim(
        Claim::printed("section3.phase_lag_of_largest_speed_ratio", firmest.phase_lag_rad)
            .at_printed_place((largest - at_zero.ratio()).max(0.0), as_high as f64 / drawn.len() as f64),
    );

    // The paper calls negligible at most the difference of two ratios that print like its two.
    let printed_largest = catalogue::number("section3.largest_speed_ratio", 0)?;
    let printed_ratio = catalogue::number("section3.speed_ratio_at_optimum", 0)?;
    let negligible =
        printed_largest.value - printed_ratio.value + printed_largest.half_unit + printed_ratio.half_unit;
    fig.claim(
        Claim::printed_statement(
            "section3.speed_ratio_nearly_largest",
            largest - fastest.ratio() <= negligible,
            format!(
                "{:.4} at our optimum, {largest:.4} at most; negligible is at most {negligible:.3}, between two ratios that print as {} and {}. \
                 At the printed φ_L: {at_printed_optimum:.4}",
                fastest.ratio(),
                data.printed.speed_ratio_at_optimum,
                data.printed.largest_speed_ratio,
            ),
        )
        .cause(COARSE_GRID),
    );
    let observed = catalogue::number("section3.observed_amplitude_angle", 0)?;
    let farthest = observed.value + observed.uncertainty.unwrap_or(0.0);
    fig.claim(Claim::printed_statement(
        "section3.optimum_differs_from_observed",
        fastest.amplitude_angle_rad > farthest,
        format!(
            "the fastest toss has φ_L = {}, the observed ones at most {} with the printed uncertainty",
            pi(fastest.amplitude_angle_rad),
            pi(farthest)
        ),
    ));
    fig.claim(Claim::printed_statement(
        "section3.compromise",
        between.least_slip_angle_rad < between.fastest_toss_angle_rad
            && between.fastest_toss_angle_rad < between.fastest_hand_at_separation_angle_rad,
        format!(
            "θ = 0: least slip at φ_L = {}, fastest toss at {}, fastest hand at the separation at {} ({:.2} rad/s); its largest speed ωΦ grows to \
             the end, {}",
            pi(between.least_slip_angle_rad),
            pi(between.fastest_toss_angle_rad),
            pi(between.fastest_hand_at_separation_angle_rad),
            between.hand_speed_at_separation_rad_per_s,
            pi(data.largest_amplitude_angle_rad),
        ),
    ));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_as_high_as_the_maximum_are_measured_by_length_and_not_by_points() {
        let curve = Drawn::new(&[0.0, 1.0, 2.0, 4.0], vec![0.0, 1.0, 1.0, 0.0]);
        assert!((curve.lower_at(3.0) - 0.5).abs() < 1e-15 && curve.lower_at(1.5).abs() < 1e-15);
        let (first, last, share) = curve.accepted();
        assert!((first - 0.99).abs() < 1e-12 && (last - 2.02).abs() < 1e-12);
        assert!((share - (last - first) / 4.0).abs() < 1e-12);
    }
}
