//! What the figure shows, against what other computations of the same motor expect.

use bouncing_disk::core::numerics::statistics::NORMAL_975;

use super::data::ExtraTorqueSpeedData;
use crate::claim::{self, Claim};

const ID: &str = "extra-torque-speed";
const PLACE: &str = "this work";

/// Two numbers agree if they differ by at most so many standard errors of their difference.
const ERRORS: f64 = 3.0;

/// How far the steady speed of an exponential may lie from that of the motor, as a share of it.
const EXPONENTIAL: f64 = 0.02;

fn tolerance(one: f64, other: f64) -> f64 {
    ERRORS * (one * one + other * other).sqrt()
}

pub(super) fn claims(data: &ExtraTorqueSpeedData) -> Vec<Claim> {
    let mut claims = numbers(data);
    claims.extend(statements(data));
    claims
}

fn numbers(data: &ExtraTorqueSpeedData) -> Vec<Claim> {
    let mut claims = Vec::new();
    if let Some(unloaded) = data.curve.points.first() {
        let settled = data.transient.settled_speed_rad_per_s;
        let allowed = tolerance(unloaded.speed.standard_error, settled.standard_error);
        claims.push(
            Claim::expected(
                ID,
                PLACE,
                "speed without load",
                "rad/s",
                (settled.value, allowed),
                unloaded.speed.value,
            )
            .note(format!(
                "expected: the mean of {} transients over the last quarter of {:.2} s; three standard errors of the difference",
                data.transient.members, data.transient.duration_s
            )),
        );
    }
    let impulses = &data.by_impulses;
    let share = |acceleration: f64| acceleration / impulses.limit_rad_per_s2;
    let computed = data.stall.torque_n_m;
    let error = computed.standard_error / data.largest_torque_n_m;
    let expected = (
        share(impulses.load_rad_per_s2.mean),
        tolerance(error, share(impulses.load_rad_per_s2.standard_error)),
    );
    claims.push(
        Claim::expected(ID, PLACE, "stall load over μ m g a_e", "", expected, data.stall.share).note(format!(
            "expected: the zero of the mean speed of a rotor that feels the impulses of {} recorded orbits; three standard \
             errors of the difference; the balance of the normal impulse of a rotor held at rest gives {:.3} ± {:.3}",
            impulses.members,
            share(impulses.balance_rad_per_s2.mean),
            share(impulses.balance_rad_per_s2.standard_error),
        )),
    );
    let (peak, peaks) = (&data.drawn_peak, &data.peaks);
    let seeds = peaks.seeds.len();
    // One curve scatters as each of the others does, whose mean is expected.
    let spread = |of_mean: f64| of_mean * (seeds as f64).sqrt();
    let power_allowed = tolerance(peaks.power_w.standard_error, spread(peaks.power_w.standard_error));
    let load_allowed =
        tolerance(peaks.load_torque_n_m.standard_error, spread(peaks.load_torque_n_m.standard_error));
    let origin = format!(
        "expected: the mean of {seeds} curves with other seeds; three standard errors of the difference"
    );
    claims.push(
        Claim::expected(
            ID,
            PLACE,
            "highest mechanical power",
            "µW",
            (1e6 * peaks.power_w.value, 1e6 * power_allowed),
            1e6 * peak.power_w,
        )
        .note(&origin),
    );
    claims.push(
        Claim::expected(
            ID,
            PLACE,
            "load at the highest power",
            "µN m",
            (1e6 * peaks.load_torque_n_m.value, 1e6 * load_allowed),
            1e6 * peak.load_torque_n_m,
        )
        .note(&origin),
    );
    claims
}

fn statements(data: &ExtraTorqueSpeedData) -> Vec<Claim> {
    let stall = &data.stall;
    let [under, over] = stall.speeds_at_bracket_rad_per_s;
    let runaways = data.overloads.iter().filter(|load| load.runs_away).count();
    let estimate = data.transient.stall_estimate_n_m;
    let ratio = estimate.value / stall.torque_n_m.value;
    let slope = data.curve.points.windows(2);
    let (fitted, settled) = (data.transient.steady_speed_rad_per_s, data.transient.settled_speed_rad_per_s);
    let off = fitted.value / settled.value - 1.0;
    vec![
        Claim::statement(
            ID,
            PLACE,
            "the steady speed of the exponential fit lies within 2 % of the speed of the settled motor",
            off.abs() < EXPONENTIAL,
            format!(
                "{:.2} in [{:.2}, {:.2}] against {:.2} ± {:.2} rad/s, {:+.1} %: the interval holds the scatter of the transients, \
                 not that they do not rise exponentially",
                fitted.value,
                fitted.low,
                fitted.high,
                settled.value,
                settled.standard_error,
                1e2 * off,
            ),
        ),
        Claim::statement(
            ID,
            PLACE,
            "at the ends of the bracket of the stall load the motor turns on and is driven back",
            under.value > 0.0 && over.value < 0.0,
            format!(
                "{:.3} ± {:.3} and {:.3} ± {:.3} rad/s at {:.2} and {:.2} µN m, of an ensemble with another seed",
                under.value,
                under.standard_error,
                over.value,
                over.standard_error,
                1e6 * stall.bracket_n_m[0],
                1e6 * stall.bracket_n_m[1],
            ),
        ),
        Claim::statement(
            ID,
            PLACE,
            "loads of μ m g a_e and above run away, and none on the curve does",
            claim::all(&data.overloads, |load| load.runs_away),
            format!(
                "{runaways} of {} overloads, {} points of the curve",
                data.overloads.len(),
                data.curve.points.len()
            ),
        ),
        Claim::statement(
            ID,
            PLACE,
            "the speed falls with the load throughout",
            claim::all(slope, |pair| pair[1].speed.value < pair[0].speed.value),
            format!("{} loads, which share their perturbations", data.curve.points.len()),
        ),
        Claim::statement(
            ID,
            PLACE,
            "the paper's estimate I α̇_ss/t_c lies above the stall load, beyond the intervals of both",
            estimate.low > stall.torque_n_m.value + NORMAL_975 * stall.torque_n_m.standard_error,
            format!(
                "estimate {:.2} µN m in [{:.2}, {:.2}], {:+.0} % of the stall load {:.2} ± {:.2} µN m; the interval holds the \
                 scatter of the transients, not that the speed does not rise exponentially",
                1e6 * estimate.value,
                1e6 * estimate.low,
                1e6 * estimate.high,
                100.0 * (ratio - 1.0),
                1e6 * stall.torque_n_m.value,
                1e6 * stall.torque_n_m.standard_error,
            ),
        ),
    ]
}
