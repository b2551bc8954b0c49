//! Fig. 12: transient speed curves of long-period and low-period chattering.

mod compute;
mod draw;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;
use serde::{Deserialize, Serialize};

use super::alike::AlikeMotor;
use super::motor_case::{DEFINITIONS, LOW_PERIOD_FLIGHTS, MotorCase, RobustCycle};
use crate::claims::{Cases, Claim, Verdict, paper::ChatteringCases};
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Fig. 12.
#[derive(Debug)]
pub struct Fig12;

impl Experiment for Fig12 {
    type Data = Fig12Data;
    const ID: &'static str = "fig12";
    const TITLE: &'static str = "Speed transients of long-period and low-period chattering";
    const DISCUSSION: &str = include_str!("fig12/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![("motors that print alike", compute::SEED)]
    }

    fn caption(data: &Fig12Data) -> String {
        let (long, low) = (&data.long_period, &data.low_period);
        format!(
            "Speed transients of the motor of Table III that nothing perturbs. (a)–(c) A = {:e} m, g = {} m/s²: long-period \
             chattering, one orbit of many between which the last places of the inputs choose; (d)–(f) g = {} m/s² and an amplitude {:.1e} of the printed one \
             away from it, the nearest that was found with a low-period cycle of more than one flight which they do not choose ({}). (a), (d) Speed during each \
             flight; dashed: exponential fit, and what the impulses of one cycle predict. (b) Speed and (c), (f) height of the rotor in the blue windows, (f) over \
             three cycles; (e) speed during each flight of ten cycles, dots of one colour for the same flight of every cycle, which form lines. At the printed \
             amplitude itself the length of the cycle is a matter of rounding.",
            data.cases.amplitudes_m[0],
            long.motor.preload_acceleration_m_per_s2,
            low.motor.preload_acceleration_m_per_s2,
            low.amplitude_offset.abs(),
            low.robust_cycle.map_or_else(String::new, RobustCycle::words),
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig12Data, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &Fig12Data) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &Fig12Data) -> Vec<Claim> {
        claims(data)
    }

    fn parameters(data: &Fig12Data) -> Vec<(String, String)> {
        let motor = &data.long_period.motor;
        let pair = |name: &str, value: String| (name.to_owned(), value);
        let own = [
            pair("ω/2π", format!("{} Hz", motor.frequency_hz)),
            pair("Γ of (a)–(c)", format!("{:.2}", data.long_period.axial_forcing)),
            pair("Γ of (d)–(f)", format!("{:.2}", data.low_period.axial_forcing)),
            pair("low period", format!("at most {} long flights from rest to rest", data.low_period_flights)),
            pair("relaunch perturbation", "none".to_owned()),
            pair("orbits judged for (a)–(c)", data.alike[0].inputs.clone()),
            pair("orbits judged for (d)–(f)", data.alike[1].inputs.clone()),
        ];
        motor.shared_inputs().into_iter().chain(own).collect()
    }
}

/// The data of Fig. 12.
#[derive(Debug, Serialize, Deserialize)]
pub struct Fig12Data {
    cases: ChatteringCases,
    /// The printed long-period case.
    long_period: Shown,
    /// The low-period case, at the amplitude nearest to the printed one that repeats a robust low-period cycle of more than one flight.
    low_period: Shown,
    /// Most flights of a cycle that counts as one of low period.
    low_period_flights: usize,
    /// Motors of both cases whose amplitudes agree to twelve digits.
    alike: [Alike; 2],
    /// The lines of the low-period case.
    drawn_lines: Lines,
    /// Motors of low period among those that print like the low-period case.
    alike_of_low_period: LowPeriod,
}

/// Motors whose inputs all print like the paper's.
#[derive(Debug, Serialize, Deserialize)]
struct Alike {
    /// The ranges drawn from.
    inputs: String,
    motors: Vec<AlikeMotor>,
}

/// The first motors of low period of a longer sequence of those that print alike.
#[derive(Debug, Serialize, Deserialize)]
struct LowPeriod {
    /// Motors drawn to find them.
    drawn: usize,
    motors: Vec<AlikeMotor>,
    /// For each the lines that its speed forms.
    lines: Vec<Lines>,
}

/// The lines on which the speeds of the flights of a low-period cycle lie while the rotor is slow: one for each flight of the cycle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Lines {
    flights: usize,
    /// Largest distance of neighbouring lines, over what the speed gains in a cycle.
    gap_over_gain: f64,
    /// The same over ωΦ.
    gap_over_peak_angular_speed: f64,
}

/// A motor whose transient is drawn. Nothing perturbs it.
#[derive(Debug, Serialize, Deserialize)]
struct Shown {
    motor: MotorCase,
    /// Amplitude over the printed one minus 1.
    amplitude_offset: f64,
    axial_forcing: f64,
    /// Its cycle, if rounding does not choose it.
    robust_cycle: Option<RobustCycle>,
    cycle_duration_s: Option<f64>,
    largest_acceleration_rad_per_s2: f64,
    duration_s: f64,
    /// Each flight longer than half a period: its start and the speed during it.
    flight_time_s: Vec<f64>,
    flight_speed_rad_per_s: Vec<f64>,
    /// The same motor averaged over equal intervals, and its fits.
    fits: Fits,
    /// What the impulses of one cycle predict.
    prediction: Prediction,
    zoom: Zoom,
}

/// The two forms fitted to the same curve.
#[derive(Debug, Serialize, Deserialize)]
struct Fits {
    exponential_steady_speed_rad_per_s: f64,
    time_constant_s: f64,
    exponential_residual_rad_per_s: f64,
    ramp_steady_speed_rad_per_s: f64,
    rise_time_s: f64,
    ramp_residual_rad_per_s: f64,
    /// Mean over the last fifth.
    last_speed_rad_per_s: f64,
    /// Straight line through the whole of the rise, and its largest distance from the curve.
    slope_rad_per_s2: f64,
    slope_error_rad_per_s2: f64,
    farthest_from_line_rad_per_s: f64,
    /// Straight line through the first tenth of the rise.
    first_slope_rad_per_s2: f64,
    /// First time at which the speed is within 2 % of the last one.
    reached_s: Option<f64>,
}

/// Straight pieces from the impulses of one cycle (module `impulse`).
#[derive(Debug, Serialize, Deserialize)]
struct Prediction {
    /// S(0): net share of the normal impulse that pushes a slow rotor forwards.
    net_share_at_rest: f64,
    /// μ a_e g/a_g² S(0).
    slope_rad_per_s2: f64,
    steady_speed_rad_per_s: f64,
    /// When the pieces reach it.
    reached_s: f64,
    time_s: Vec<f64>,
    speed_rad_per_s: Vec<f64>,
    /// Each impact of at least a hundredth of the cycle's impulse: phase/2π, share of the impulse and cos(τ + θ).
    impacts: Vec<(f64, f64, f64)>,
    /// Impulses of the cycle over weight times its duration, minus 1.
    balance: f64,
}

/// A short part of the rise. Of the low-period case the flights of many cycles, which form its lines.
#[derive(Debug, Serialize, Deserialize)]
struct Zoom {
    time_s: Vec<f64>,
    speed_rad_per_s: Vec<f64>,
    height_m: Vec<f64>,
    /// Flights of many cycles: their starts and speeds.
    flight_time_s: Vec<f64>,
    flight_speed_rad_per_s: Vec<f64>,
}

/// So many orbits are enough for a verdict under another definition.
const ENOUGH: usize = 20;

fn is_low(motor: &AlikeMotor, most: usize) -> bool {
    motor.cycle.chattering_flights().is_some_and(|flights| flights <= most)
}

fn claims(data: &Fig12Data) -> Vec<Claim> {
    vec![
        case(data, 0, "section5.long_period_case"),
        case(data, 1, "section5.low_period_case"),
        exponential(data),
        linear(data),
        abrupt(data),
        lines(data),
    ]
}

/// That the orbits of a case are of long period (the first), or of low period.
fn case(data: &Fig12Data, case: usize, key: &str) -> Claim {
    let alike = &data.alike[case];
    let cases = |most: usize| Cases::of(alike.motors.iter().map(|motor| is_low(motor, most) == (case == 1)));
    let others = DEFINITIONS.map(cases);
    let words = DEFINITIONS.iter().zip(others).map(|(most, cases)| format!("{most}: {}", cases.words()));
    Claim::printed_statement(
        key,
        cases(LOW_PERIOD_FLIGHTS),
        format!(
            "A and g are printed, and the last places of the amplitude choose the cycle: {}; low period is at most {LOW_PERIOD_FLIGHTS} flights of more than half a period from \
             rest to rest. With other numbers of flights it holds for {}",
            alike.inputs,
            words.collect::<Vec<_>>().join("; ")
        ),
    )
    .by_definition(&others.map(Cases::sampled))
}

/// The verdicts on the orbits of a case that are of low period, or not, under the other definitions.
fn under_definitions(data: &Fig12Data, case: usize, holds: fn(&AlikeMotor) -> bool) -> Vec<Verdict> {
    let orbits =
        |most: usize| data.alike[case].motors.iter().filter(move |motor| is_low(motor, most) == (case == 1));
    let cases = DEFINITIONS.map(|most| Cases::of(orbits(most).map(holds)));
    cases.into_iter().filter(|cases| cases.tried >= ENOUGH).map(Cases::sampled).collect()
}

fn exponential(data: &Fig12Data) -> Claim {
    let fits = &data.long_period.fits;
    let motors = data.alike[0].motors.iter().filter(|motor| !motor.cycle.is_low_period());
    Claim::printed_statement(
        "section5.exponential_in_long_period",
        Cases::of(motors.map(AlikeMotor::is_exponential)),
        format!(
            "whether the exponential fits better than a linear rise to a constant, for the orbits of long period. Of the \
             motor drawn the root mean square deviation from the exponential is {:.3} rad/s, from the other {:.3} rad/s",
            fits.exponential_residual_rad_per_s, fits.ramp_residual_rad_per_s
        ),
    )
    .by_definition(&under_definitions(data, 0, AlikeMotor::is_exponential))
}

/// How many of the motors of low period have a property.
fn low_period(found: &LowPeriod, holds: fn(&AlikeMotor) -> bool) -> Cases {
    Cases::of(found.motors.iter().map(holds))
}

fn linear(data: &Fig12Data) -> Claim {
    let (fits, prediction) = (&data.low_period.fits, &data.low_period.prediction);
    let found = &data.alike_of_low_period;
    Claim::printed_statement(
        "section5.linear_rise",
        low_period(found, |motor| !motor.is_exponential()),
        format!(
            "whether a linear rise to a constant fits better than the exponential, for the first {} orbits of low period of {} with amplitudes that round to the printed one. \
             Of the motor drawn the deviation from a linear rise is {:.3}, from an exponential {:.3} rad/s; the line through the whole rise has \
             the slope {:.4} ± {:.4} rad/s² and lies {:.2} rad/s off at most: the rise consists of straight pieces. The first has {:.4} rad/s². The \
             normal impulse of a cycle is the weight times its duration (off by {:.0e}), of which the share {:.4} net pushes forwards \
             where cos(τ + θ) > 0: that slope is μ a_e g/a_g² = {:.4} rad/s² times the share, {:.4} rad/s²",
            found.motors.len(),
            found.drawn,
            fits.ramp_residual_rad_per_s,
            fits.exponential_residual_rad_per_s,
            fits.slope_rad_per_s2,
            fits.slope_error_rad_per_s2,
            fits.farthest_from_line_rad_per_s,
            fits.first_slope_rad_per_s2,
            prediction.balance.abs(),
            prediction.net_share_at_rest,
            data.low_period.largest_acceleration_rad_per_s2,
            prediction.slope_rad_per_s2,
        ),
    )
    .by_definition(&under_definitions(data, 1, |motor| !motor.is_exponential()))
}

fn abrupt(data: &Fig12Data) -> Claim {
    let (fits, prediction) = (&data.low_period.fits, &data.low_period.prediction);
    let found = &data.alike_of_low_period;
    Claim::printed_statement(
        "section5.abrupt_steady_state",
        low_period(found, AlikeMotor::stops_abruptly),
        format!(
            "whether the time from nine tenths of the last speed to all but a fiftieth of it, over that to one half, is nearer to the 0.16 of a \
             linear rise to a constant than to the 2.3 of an exponential, for {} orbits of low period. Of the motor drawn the impulses \
             predict as the steady speed that of the stator at the impact where those below and above balance, {:.3} rad/s, reached within 2 % after {:.3} s; \
             simulated {:.3} rad/s after {} s",
            found.motors.len(),
            prediction.steady_speed_rad_per_s,
            prediction.reached_s,
            fits.last_speed_rad_per_s,
            fits.reached_s.map_or_else(|| "no".to_owned(), |time| format!("{time:.3}")),
        ),
    )
    .by_definition(&under_definitions(data, 1, AlikeMotor::stops_abruptly))
}

/// Lines are told apart in a window of [`SEEN_CYCLES`] cycles where neighbours are this share of the rise in it apart.
const SEEN_APART: f64 = 0.05;
/// See [`SEEN_APART`].
const SEEN_CYCLES: f64 = 10.0;

fn lines(data: &Fig12Data) -> Claim {
    let found = &data.alike_of_low_period;
    let is_seen = |lines: &Lines| lines.gap_over_gain >= SEEN_APART * SEEN_CYCLES;
    let seen = Cases::of(found.lines.iter().map(is_seen));
    let several = found.lines.iter().filter(|lines| lines.flights > 1).count();
    let mut gaps: Vec<f64> = found.lines.iter().map(|lines| lines.gap_over_peak_angular_speed).collect();
    gaps.sort_by(f64::total_cmp);
    let (middle, widest) = (gaps.get(gaps.len() / 2), gaps.last());
    let impacts = &data.low_period.prediction.impacts;
    let words = impacts.iter().map(|(phase, share, level)| format!("({phase:.4}, {share:.3}, {level:+.3})"));
    Claim::printed_statement(
        "section5.multiple_lines",
        is_seen(&data.drawn_lines),
        format!(
            "whether the speeds of the flights of the motor drawn form at least two lines that stand apart by a twentieth of what the speed rises in ten cycles, as \
             panel (e) shows them. Of other orbits of low period {} do, where {several} of {} have more than one flight in a cycle. On the scale of the whole \
             transient no lines are seen: neighbouring lines are {:.2} % of ωΦ apart on the median, {:.2} % at most. Impacts of the cycle drawn with at least 1 % of its impulse (τ/2π, \
             share, cos(τ + θ)): {}",
            seen.words(),
            found.lines.len(),
            100.0 * middle.copied().unwrap_or(f64::NAN),
            100.0 * widest.copied().unwrap_or(f64::NAN),
            words.collect::<Vec<_>>().join(" "),
        ),
    )
}
