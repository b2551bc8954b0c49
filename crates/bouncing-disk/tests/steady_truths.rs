//! Whether the stated errors of mean speeds hold what programs that share nothing with this library find.
//!
//! `data/steady_truths.json` has ten motors of each of five kinds, the first ten of a random list, none left out: rigid
//! impacts on a sine (1), contacts of 0.05 to 0.45 periods (2) and of 0.6 to 5 periods (3) with both laws of the contact,
//! rigid impacts on sums of two or three harmonics (4), on triangles and sawtooths (5). Forcing A omega^2 m/F from 1.1 to 40, rise from 5 to
//! 10^4 periods, restitution 0 to 0.95 (with contacts 0.1 to 0.95), friction 0.02 to 0.4, any lag; without load and under a load up to 0.6 of
//! the largest friction.
//!
//! The truths come from two programs in C. *Rigid impacts*: exact parabolas; the first touch by a scan in steps of 0.1 rad
//! (minima between two steps are looked at) and bisection, piece by piece on straight lines; every impact of a chatter
//! until its speed is below 1e-6 g/omega and the rest of it shorter than 1e-4 of the time to the separation or the kink; rests
//! in 256 steps a period; a random speed in [0, 1e-3] g/omega at each separation after a rest and each kick. *Contacts*: the exact
//! linear flow in steps of 1/200 period or a 50th of the contact, whichever is less (cycles: of 1/500 and 1/1000, extrapolated), by
//! exponentials of matrices; events by halving the step; stiffness and damper from trial impacts. Friction counts as even within a step, the
//! slip as a straight line. Two rotors for each load, from far above and far below, on 6 to 16 vertical motions that start from rest or
//! from throws. The error of a truth is the scatter of the motions (Student), half of what the two rotors still differ by over 1.96, and
//! what steps leave: 1e-5 of the speed for rigid impacts, 1e-4 for irregular motions with contacts, three times the error of the extrapolation for cycles
//! (`k1_08` and `k1_09`: 1e-3, for in their rests of 600 steps a period the slip has the sign of the step's end).
//!
//! A state is a motion that some starts come to and do not leave; `rest` says that one from rest did. A motor is covered if each of
//! its states lies within 1.96 standard errors, and 1.96 errors of the truth, of one of the branches, for both loads.
//!
//! `k4_04`, whose rise takes 4392 periods with a rest in each, is not independent of the library: its two rotors start 300 units (what
//! friction gives in a radian) on either side of the library's speeds, as far as time allowed; they met, and 10 units count as the error.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use bouncing_disk::Motor;
use bouncing_disk::core::Progress;
use bouncing_disk::motor::{OperatingSettings, Operation};

/// Of ten motors of a kind: those whose 95 % intervals may miss, and those that may be unsettled.
const MOST: [usize; 2] = [1, 2];

/// Coarser than the default, to take seconds: an interval has to hold the truth at any requested error.
const SETTINGS: (f64, usize, u64) = (0.03, 16, 2_000_000);

/// A motor without an answer after this time (s), many times what any takes on a busy machine, never ends and is missed.
const LONGEST: u64 = 200;

#[derive(serde::Deserialize)]
struct Truth {
    kind: u8,
    name: String,
    sheet: serde_json::Value,
    /// Torque (N m) of the second load; the first is none.
    load: f64,
    states: Vec<State>,
}

#[derive(serde::Deserialize)]
struct State {
    /// Whether a motion from rest comes to it.
    rest: bool,
    /// Mean speed (rad/s) and its error, without and with the load.
    speeds: [[f64; 2]; 2],
}

/// What became of a motor.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Verdict {
    Covered,
    Unsettled,
    Missed,
}

fn verdict(truth: &Truth) -> (Verdict, String) {
    let motor = Motor::from_json(&truth.sheet.to_string()).expect("a legal sheet");
    let (relative_error, members, most_impacts) = SETTINGS;
    let settings =
        OperatingSettings { relative_error, members, most_impacts, ..OperatingSettings::default() };
    let begun = Instant::now();
    let in_time = |_: Progress| {
        if begun.elapsed() > Duration::from_secs(LONGEST) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let rows = match motor.torque_speed_curve(&[0.0, truth.load], &settings, &in_time) {
        Ok(rows) => rows,
        Err(error) => return (Verdict::Missed, format!("{}: {error}\n", truth.name)),
    };
    if truth.states.is_empty() {
        return (Verdict::Missed, format!("{}: no truth\n", truth.name));
    }
    let (mut worst, mut said) = (Verdict::Covered, String::new());
    for (k, row) in rows.iter().enumerate() {
        for state in &truth.states {
            let [speed, error] = state.speeds[k];
            let points = row.branches.iter().filter_map(|branch| branch.point().map(|point| (branch, point)));
            let nearest = points.min_by(|one, other| {
                let distance = |speed_of: f64| (speed_of - speed).abs();
                distance(one.1.speed.value).total_cmp(&distance(other.1.speed.value))
            });
            let Some((branch, point)) = nearest else {
                return (Verdict::Missed, format!("{}: no operating point\n", truth.name));
            };
            let (value, standard_error) = (point.speed.value, point.speed.standard_error);
            let inside = (value - speed).abs() <= 1.96 * (standard_error + error);
            let own = match branch {
                Operation::Unsettled(..) => Verdict::Unsettled,
                _ if inside => Verdict::Covered,
                _ => Verdict::Missed,
            };
            if own != Verdict::Covered {
                let start = if state.rest { "rest" } else { "a throw" };
                let found = format!("{value:.5e} +- {standard_error:.1e} for {speed:.5e} +- {error:.1e}");
                let lacks = if own == Verdict::Missed { "missed" } else { "unsettled" };
                said += &format!("{}, load {k}, from {start}: {lacks}, {found}\n", truth.name);
            }
            worst = worst.max(own);
        }
    }
    (worst, said)
}

fn the_stated_errors_hold(kind: u8) {
    let truths: Vec<Truth> =
        serde_json::from_str(include_str!("data/steady_truths.json")).expect("legal data");
    let (mut counts, mut all_said) = ([0; 3], String::new());
    for truth in truths.iter().filter(|truth| truth.kind == kind) {
        let (verdict, said) = verdict(truth);
        counts[verdict as usize] += 1;
        all_said += &said;
    }
    let [covered, unsettled, missed] = counts;
    assert_eq!(covered + unsettled + missed, 10);
    assert!(
        missed <= MOST[0] && unsettled <= MOST[1],
        "{covered} covered, {unsettled} unsettled, {missed} missed\n{all_said}"
    );
}

#[test]
fn of_rigid_impacts_on_a_sine() {
    the_stated_errors_hold(1);
}

#[test]
fn of_brief_contacts() {
    the_stated_errors_hold(2);
}

#[test]
fn of_long_contacts() {
    the_stated_errors_hold(3);
}

#[test]
fn of_rigid_impacts_on_several_sines() {
    the_stated_errors_hold(4);
}

#[test]
fn of_rigid_impacts_on_straight_lines() {
    the_stated_errors_hold(5);
}
