//! Fig. 11 with a compliant stator: the tables of docs/contacts-and-stators.md.
//!
//!     cargo run --release -p bouncing-disk --example yielding_stator
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::f64::consts::{FRAC_1_PI, TAU};

use bouncing_disk::core::numerics::elementary::pow;
use bouncing_disk::core::numerics::statistics::mean;
use bouncing_disk::core::{Phase, Unobserved};
use bouncing_disk::motor::{SpeedCurve, TransientSettings};
use bouncing_disk::parameters::{Contact, LoadLaw, StatorKind, StatorParameters};
use bouncing_disk::{Error, Motor};

/// Of all stators: quality factor, and amplitude (m) without a rotor.
const QUALITY: f64 = 300.0;
const AMPLITUDE: f64 = 1e-7;

/// Preloads over the mass (m/s²): 33, 82, 164, 200, 280 and 329 mN.
const PRELOADS: [f64; 6] = [1.0, 2.5, 5.0, 6.1, 8.5, 10.0];

/// Points of a run, and the first of those that are averaged.
const INTERVALS: usize = 500;
const FIRST: usize = 200;
const LAST: usize = INTERVALS - 1;

/// A rotor in compliant contacts is followed for so many periods; friction changes its speed by this share of the stator's
/// in a period. One whose speed is held has ten thousand times its own inertia.
const PERIODS: f64 = 2_500.0;
const LIGHT: f64 = 1.5e-3;
const HELD: f64 = 1e4;

/// A motor of the paper with a compliant stator.
struct Case {
    motor: Motor,
    twists: bool,
    /// Effective mass (kg).
    mass: f64,
    /// Contact time over the period of 70 kHz on a platform that does not yield; `None` is the rigid impact.
    contact: Option<f64>,
}

/// Steady speed (rad/s), torque at standstill (N m), amplitude at the steady speed over that without a rotor, and mean time
/// between impacts (s).
struct Point {
    speed: f64,
    stall_torque: f64,
    amplitude: f64,
    flight: f64,
}

impl Case {
    fn run(
        &self,
        preload: f64,
        gyration: f64,
        inertia: f64,
        duration: f64,
    ) -> Result<(SpeedCurve, f64), Error> {
        let kind = if self.twists { StatorKind::AxialTwist } else { StatorKind::Axial };
        let omega = self.motor.system().platform().angular_frequency();
        let stator = StatorParameters {
            kind,
            mass: Some(self.mass),
            quality: Some(QUALITY),
            resonance: Some(omega / TAU),
            ..StatorParameters::default()
        };
        let time = self.contact.map(|share| share / 70e3);
        // The drive is switched on just after the start.
        let load = LoadLaw::constant(0.0)?.with_drive(1e-9, f64::MAX)?.with_inertia(inertia)?;
        let motor = self.motor.with(|sheet| {
            (sheet.amplitude, sheet.phase_lag) = (Some(AMPLITUDE), 0.0);
            sheet.gyration_radius = Some(gyration);
            (sheet.preload_force, sheet.preload_acceleration) = (None, Some(preload));
            (sheet.stator, sheet.load) = (Some(stator), Some(load));
            sheet.contact = time.map(Contact::lasting);
        })?;
        let settings =
            TransientSettings { duration, intervals: INTERVALS, seed: 1, ..TransientSettings::default() };
        let (curve, amplitudes) = motor.run_up(Phase::new(0.5 * TAU)?, &settings, &Unobserved)?;
        let squares: f64 = amplitudes[FIRST..].iter().map(|own| own * own).sum();
        let amplitude = (squares / (INTERVALS - FIRST) as f64).sqrt() / AMPLITUDE;
        Ok((curve, amplitude))
    }

    fn point(&self, preload: f64) -> Result<Point, Error> {
        let (platform, disk) = (self.motor.system().platform(), self.motor.system().disk());
        let (frequency, gyration) = (platform.angular_frequency() / TAU, disk.gyration_radius());
        let settles = 12.0 * QUALITY * FRAC_1_PI / frequency;
        let flight = 2.0 * AMPLITUDE * TAU * frequency * (1.0 + disk.restitution()) / preload;
        let longest = if self.contact.is_some() { PERIODS / frequency } else { 80.0 * flight };
        let held = HELD * self.motor.mass() * gyration * gyration;
        let (curve, amplitude) = self.run(preload, gyration, held, settles + longest)?;
        let stall_torque =
            held * (curve.speeds[LAST] - curve.speeds[FIRST]) / (curve.times[LAST] - curve.times[FIRST]);
        // A speed that friction reaches in single flights depends on the inertia; in contacts of a period it does not.
        let flies = self.contact.is_none() && amplitude > 0.02;
        let (speed, friction) =
            (platform.peak_angular_speed(), disk.friction() * disk.contact_radius() * preload);
        let (gyration, duration) = if flies {
            (gyration, 6.0 * speed * gyration * gyration / friction)
        } else {
            ((friction / (frequency * LIGHT * speed)).sqrt(), settles + 2.0 * PERIODS / frequency)
        };
        let (curve, amplitude) = self.run(preload, gyration, 0.0, duration)?;
        let flight = curve.times[LAST] / curve.impacts.max(1) as f64;
        Ok(Point { speed: mean(&curve.speeds[FIRST..]), stall_torque, amplitude, flight })
    }
}

/// What the drive must give at 329 mN and 70 kHz at most 0.55 V peak to peak, and how heavy and long a bar of the tip's
/// width is that is a quarter of a wave long.
fn limits() {
    let (omega, volts) = (TAU * 70e3, 0.5 * 0.55);
    let (width, density, modulus) = (2.5e-3, 2700.0, 69e9_f64);
    let force = PRELOADS[5] * Motor::paper_70_khz().mass();
    let power = 0.5 * force * omega * AMPLITUDE;
    let wave = (modulus / density).sqrt() / 70e3;
    println!("M/Q > {:.0} mg", 1e6 * force / (omega * omega * AMPLITUDE));
    println!("F₀ ω A₀/2 = {:.1} mW", 1e3 * power);
    println!("of {:.1} Ω at most", volts * volts / (2.0 * power));
    println!("ρSλ/8 of {:.2} g", 1e3 * density * width * width * wave / 8.0);
    println!("({:.0} mm at 70 kHz)", 1e3 * wave / 4.0);
}

/// The relative change of the preload over the height of a flight, if a magnet at 10 mm would carry the ball and its pull
/// falls with this power of the distance.
fn change_in_flight(preload: f64, flight: f64, power: f64) -> f64 {
    const WEIGHT: f64 = 9.81;
    // The magnet takes the rest of the weight: (d_0/d)^n of it.
    let taken = WEIGHT - preload;
    let distance = 10e-3 * pow(WEIGHT / taken, 1.0 / power);
    power * taken * (preload * flight * flight / 8.0) / (distance * preload)
}

/// Of rigid impacts at A₀ and a tenth of it, and of compliant contacts: at 33, 164 and 280 mN.
fn magnet(rigid: &Case, soft: &Case) -> Result<(), Error> {
    for (name, case, scale) in
        [("rigid, 100 nm", rigid, 1.0), ("rigid, 10 nm", rigid, 0.1), ("4.3", soft, 1.0)]
    {
        let cells = [PRELOADS[0], PRELOADS[2], PRELOADS[4]].map(|preload| {
            let flight = scale * case.point(preload)?.flight;
            let change = |power| change_in_flight(preload, flight, power);
            Ok::<_, Error>(format!("{:.0e} to {:.0e}", change(4.0), change(7.0)))
        });
        let cells = cells.into_iter().collect::<Result<Vec<_>, _>>()?;
        println!("| {name} | {} |", cells.join(" | "));
    }
    Ok(())
}

fn main() -> Result<(), Error> {
    limits();
    let slow = |twists, mass, contact| Case { motor: Motor::paper_70_khz(), twists, mass, contact };
    let fast = |twists| Case { motor: Motor::paper_184_khz(), ..slow(twists, 0.0105, Some(4.3)) };
    let [rigid, soft] =
        [(0.0100, None), (0.0105, Some(4.3))].map(|(mass, contact)| slow(false, mass, contact));
    magnet(&rigid, &soft)?;
    let cases = [
        slow(true, 0.0100, None),
        rigid,
        slow(true, 0.0105, Some(0.8)),
        slow(true, 0.0110, Some(4.3)),
        slow(true, 0.0120, Some(8.9)),
        slow(true, 0.0060, Some(16.8)),
        soft,
        fast(true),
        fast(false),
    ];
    for case in cases {
        let points = PRELOADS.map(|preload| case.point(preload));
        let points = points.into_iter().collect::<Result<Vec<_>, _>>()?;
        let cells = |of: fn(&Point) -> String| [0, 1, 2, 4, 5].map(|index| of(&points[index])).join(" | ");
        let torque = |index: usize| 1e6 * points[index].stall_torque;
        let stator = format!(
            "| {:.0} | {} | {:.1} | {} |",
            case.motor.system().platform().angular_frequency() / TAU / 1e3,
            if case.twists { "twists" } else { "axial" },
            1e3 * case.mass,
            case.contact.map_or_else(|| "rigid".to_owned(), |time| time.to_string()),
        );
        println!(
            "{stator} {} | {:.0}, {:.0} |",
            cells(|point| format!("{:.1}", point.speed.abs())),
            torque(3),
            torque(5)
        );
        println!("{stator} {} |", cells(|point| format!("{:.2}", point.amplitude)));
    }
    Ok(())
}
