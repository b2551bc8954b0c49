//! What Sec. III B says of the best toss, compared with the curves.

use super::best::{Best, Compromise};
use super::tosses::LagCurve;
use super::{Curves, pi};
use crate::claims::judging::LINE_WIDTH;
use crate::claims::paper::Uncertain;
use crate::claims::{Claim, Verdict, catalogue};
use crate::experiment::{ExperimentError, Paper};
use crate::figures::shared::numbers;

/// Why the optimum of Table I as printed is another one.
const OTHER_OPTIMUM: &str = "Table I has its optimum at another φ_L";

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
        let next = self.angles[1..].partition_point(|end| *end < angle) + 1;
        let (from, to) = (self.angles[next - 1], self.angles[next]);
        let (one, other) = (self.values[next - 1], self.values[next]);
        let value = one + (other - one) * (angle - from) / (to - from);
        (self.high - value) / (self.high - self.low)
    }

    /// The angles at which it is lower than its maximum by no more than a line's width: the first and the last, and their
    /// share.
    fn accepted(&self) -> (String, f64) {
        let points = self.angles.iter().zip(&self.values);
        let as_high = points.filter(|(_, value)| self.high - **value <= LINE_WIDTH * (self.high - self.low));
        let as_high: Vec<f64> = as_high.map(|(angle, _)| *angle).collect();
        let (from, to) = numbers::extent(as_high.iter().copied());
        let share = as_high.len() as f64 / self.angles.len() as f64;
        (
            format!(
                "places from {} to {} are as high, {:.0} % of those drawn",
                pi(from),
                pi(to),
                100.0 * share
            ),
            share,
        )
    }
}

/// A place of a maximum: also as a multiple of π, as it is printed, and judged on the curve.
fn place(key: &str, computed: f64, curve: &Drawn) -> Result<Claim, ExperimentError> {
    let claim = Claim::printed(key, computed);
    let note = format!("computed {}, printed {}", pi(computed), claim.printed);
    let (places, share) = curve.accepted();
    let lower = curve.lower_at(catalogue::number(key, 0)?.value);
    Ok(claim.note(note).at_printed_place(lower, share).note(places))
}

/// `lossless` is the efficiency of the fastest toss if the energy lost in friction is not counted as put in.
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
            "dough at rest at the start: of all phase lags and φ_L the fastest toss has θ = {} and the most efficient θ = {} (or π \
             more). A dough that starts with the hand is fastest, {:.2} rad/s, at θ = {}, φ_L = {}",
            pi(absolute.fastest_phase_lag_rad),
            pi(absolute.most_efficient_phase_lag_rad),
            relative.fastest.airborne_speed_rad_per_s,
            pi(relative.fastest_phase_lag_rad),
            pi(relative.fastest.amplitude_angle_rad),
        ),
    ));

    // The numbers of the best toss, and with which parameters they come out.
    let grid = &data.consistency.coarse_grid;
    let (case, table) = (&grid.reading.parameters, &data.table_i);
    let shift = |value: f64, printed: &Uncertain| (value - printed.value) / printed.uncertainty;
    let reason = format!(
        "all printed numbers come out with ω = {:.2} rad/s ({:+.2} of its uncertainty), a_g = {:.4} m ({:+.2} of its uncertainty), if the maximum is the best of {} equal intervals of φ_L",
        case.angular_frequency_rad_per_s,
        shift(case.angular_frequency_rad_per_s, &table.angular_frequency_rad_per_s),
        case.gyration_radius_m,
        shift(case.gyration_radius_m, &table.gyration_radius_m),
        grid.intervals
    );
    let numbers = [
        place("section3.optimal_amplitude_angle", fastest.amplitude_angle_rad, &of_speed)?,
        Claim::printed("section3.largest_airborne_speed", fastest.airborne_speed_rad_per_s),
        Claim::printed("section3.largest_efficiency", fastest.efficiency)
            .note(format!("{lossless:.3} if the energy lost in friction is not counted as put in")),
        Claim::printed("section3.speed_ratio_at_optimum", fastest.speed_ratio.unwrap_or(f64::NAN)),
    ];
    fig.claims(numbers.map(|claim| {
        let claim = if claim.verdict == Verdict::Differs { claim.note(&reason) } else { claim };
        claim.cause(OTHER_OPTIMUM)
    }));

    // The paper reads one φ_L for the largest speed and the largest efficiency off its curves.
    let lower = of_efficiency.lower_at(fastest.amplitude_angle_rad);
    fig.claim(Claim::printed_statement(
        "section3.one_optimum",
        lower <= LINE_WIDTH,
        format!(
            "θ = 0: the airborne speed is largest at φ_L = {}, the efficiency at {}, {} apart. At the first the efficiency is {:.4}, at the \
             second {:.4}: lower by {:.2} % of what the curve spans",
            pi(fastest.amplitude_angle_rad),
            pi(efficient.amplitude_angle_rad),
            pi((fastest.amplitude_angle_rad - efficient.amplitude_angle_rad).abs()),
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
            .note(format!("of the curves drawn, θ = nπ/8, that of n = {}", firmest.n)),
    );
    fig.claim(place(
        "section3.amplitude_angle_of_largest_speed_ratio",
        at_zero.amplitude_angle_rad,
        &of_ratio,
    )?);
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
            largest - at_printed_optimum <= negligible,
            format!(
                "{at_printed_optimum:.4} at the printed optimum φ_L = {}, {:.4} at our own, {largest:.4} at most; the paper calls negligible what lies between two ratios \
                 that print as {} and {}, at most {negligible:.3}",
                data.printed.optimal_amplitude_angle_rad,
                fastest.ratio(),
                data.printed.speed_ratio_at_optimum,
                data.printed.largest_speed_ratio,
            ),
        )
        .cause(OTHER_OPTIMUM),
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
            "θ = 0: the dough slips least at φ_L = {} and is fastest at {}; the hand is fastest as the dough leaves at {} ({:.2} rad/s), and its largest speed \
             ωΦ grows up to the end of the range, {}. So there is an optimum without any slip, too, because τ_sep moves away from the hand's fastest moment",
            pi(between.least_slip_angle_rad),
            pi(between.fastest_toss_angle_rad),
            pi(between.fastest_hand_at_separation_angle_rad),
            between.hand_speed_at_separation_rad_per_s,
            pi(data.largest_amplitude_angle_rad),
        ),
    ));
    Ok(())
}
