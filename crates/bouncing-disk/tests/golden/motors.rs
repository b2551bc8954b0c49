//! Digests of motors and fits, as the core has them of flights and orbits.

use bouncing_disk::core::numerics::digest::Digest;
use bouncing_disk::core::numerics::elementary::exp;
use bouncing_disk::core::numerics::random::SplitMix64;
use bouncing_disk::core::{Phase, Unobserved};
use bouncing_disk::estimate::{FitSettings, RiseEstimate, TransientFit};
use bouncing_disk::motor::{OperatingSettings, SweepQuantity, TransientSettings};
use bouncing_disk::parameters::{Contact, LoadLaw, StatorKind, StatorParameters};
use bouncing_disk::{Error, Motor};

fn one(name: &str, numbers: impl IntoIterator<Item = f64>, recorded: u64) -> Vec<String> {
    let mut digest = Digest::new();
    numbers.into_iter().for_each(|number| digest.number(number));
    if digest.value() == recorded { Vec::new() } else { vec![format!("{name}: {:#018x}", digest.value())] }
}

fn starting(duration: f64) -> TransientSettings {
    TransientSettings { duration, intervals: 24, ..TransientSettings::default() }
}

/// Run-ups, and operating points, with contacts that take time, of both signs of the damping's square, and with
/// flights of less than a period and of many.
pub(crate) fn taps() -> Result<Vec<String>, Error> {
    let (mut run_ups, mut numbers) = (Vec::new(), Vec::new());
    for (periods, restitution, lag) in [(0.05, 0.5, 0.0), (0.4, 0.7, -1.2), (0.9, 0.1, 0.6), (0.3, 0.01, 0.2)]
    {
        let motor =
            Motor::paper_70_khz().with(|sheet| (sheet.phase_lag, sheet.restitution) = (lag, restitution))?;
        let motor = motor.with(|sheet| sheet.contact = Some(Contact::lasting(periods / 70e3)))?;
        let curve = motor.transient(Phase::new(0.3)?, &starting(0.01), &Unobserved)?;
        run_ups.extend(curve.times.iter().chain(&curve.speeds));
        let settings = OperatingSettings {
            relative_error: 0.2,
            members: 4,
            most_impacts: 10_000,
            ..OperatingSettings::default()
        };
        let points = motor.torque_speed_curve(&[0.0, 1e-6], &settings, &Unobserved)?;
        for quantity in [SweepQuantity::Speed, SweepQuantity::Efficiency] {
            numbers.extend(
                points.iter().map(|point| quantity.of(point.operation()).map_or(f64::NAN, |one| one.value)),
            );
        }
    }
    let mut all = one("run-ups with taps", run_ups, 0x1956_895a_62f8_de14);
    all.extend(one("taps", numbers, 0x4331_8d14_cc11_ab8e));
    Ok(all)
}

/// Rigid impacts and contacts that take time on stators that yield, under a load and when the drive is switched off.
pub(crate) fn run_ups_on_stators() -> Result<Vec<String>, Error> {
    let axial = StatorParameters { mass: Some(0.05), quality: Some(300.0), ..StatorParameters::default() };
    let twisting = StatorParameters { kind: StatorKind::AxialTwist, twist_per_height: Some(700.0), ..axial };
    let two = StatorParameters {
        kind: StatorKind::AxialAndTorsional,
        inertia: Some(1e-6),
        torsional_quality: Some(100.0),
        resonance: Some(70.1e3),
        ..axial
    };
    let fan = LoadLaw::new(&[0.0, 10.0], &[0.0, 1e-6])?.with_drive(0.0, 0.02)?;
    let (mut rigid, mut soft) = (Vec::new(), Vec::new());
    for (stator, speed, contact_time, load) in [
        (axial, Some(30.0), None, None),
        (twisting, None, None, Some(fan)),
        (two, Some(30.0), Some(1e-5), None),
        (axial, Some(30.0), Some(4e-6), Some(fan)),
    ] {
        let motor = Motor::paper_70_khz().with(|sheet| {
            (sheet.stator, sheet.amplitude, sheet.peak_angular_speed) = (Some(stator), Some(1e-7), speed);
            sheet.load = load;
        })?;
        let motor = motor.with(|sheet| sheet.contact = contact_time.map(Contact::lasting))?;
        let (curve, amplitudes) = motor.run_up(Phase::new(1.0)?, &starting(0.03), &Unobserved)?;
        let numbers = if contact_time.is_some() { &mut soft } else { &mut rigid };
        numbers.extend(curve.times.iter().chain(&curve.speeds).chain(&amplitudes));
        numbers.extend([curve.impacts as f64, curve.separations as f64]);
    }
    let mut all = one("run-ups on stators with rigid impacts", rigid, 0x58ba_74cb_327b_a8e2);
    all.extend(one("run-ups on stators with compliant contacts", soft, 0x2436_584f_8ec1_438a));
    Ok(all)
}

fn add_rise(numbers: &mut Vec<f64>, rise: &RiseEstimate) {
    let all = [Some(rise.steady_speed), Some(rise.constant), Some(rise.stall_acceleration), rise.start_speed];
    numbers.extend(all.into_iter().flatten().flat_map(|one| [one.value, one.low, one.high]));
    numbers.push(rise.residual);
}

/// Fits with intervals of one run, from rest and not, and of several.
pub(crate) fn transient_fits() -> Vec<String> {
    let run = |run: u64| {
        let mut random = SplitMix64::new(run);
        let times: Vec<f64> = (0..80).map(|row| 0.1 * f64::from(row)).collect();
        let speeds =
            times.iter().map(|time| 20.0 * (1.0 - exp(-time)) + 0.8 * (random.unit() - 0.5)).collect();
        (times, speeds)
    };
    let runs: Vec<(Vec<f64>, Vec<f64>)> = (1..7).map(run).collect();
    let runs: Vec<_> = runs.iter().map(|(times, speeds)| (times.as_slice(), speeds.as_slice())).collect();
    let mut numbers = Vec::new();
    for (runs, from_rest) in [(&runs[..1], true), (&runs[..1], false), (&runs[..], true), (&runs[..], false)]
    {
        let settings = FitSettings { resamples: 200, from_rest, ..FitSettings::default() };
        let fit = TransientFit::of_measured(runs, &settings, &Unobserved).expect("fits");
        add_rise(&mut numbers, &fit.exponential);
        fit.ramp.iter().for_each(|ramp| add_rise(&mut numbers, ramp));
        numbers.extend([fit.start_time, fit.duration]);
    }
    one("transient fits", numbers, 0x9bc6_c4d3_10c3_6922)
}

/// What a motor's rated points leave of its friction.
#[cfg(feature = "fit")]
pub(crate) fn rated_fits() -> Vec<String> {
    use bouncing_disk::estimate::{FitParameter, FitRange, MotorFit, MotorFitSettings, RatedPoint};

    let motor = Motor::paper_70_khz().with(|sheet| sheet.contact_radius = 5e-3).expect("legal");
    let ranges = [FitRange { parameter: FitParameter::Friction, low: 0.03, high: 0.4 }];
    let mut settings = MotorFitSettings { most_evaluations: 24, ..MotorFitSettings::default() };
    settings.operating =
        OperatingSettings { relative_error: 0.02, members: 4, most_impacts: 100_000, ..settings.operating };
    // Points of the motor itself, with other starts.
    let known = OperatingSettings { seed: 7, ..settings.operating };
    let curve = motor.torque_speed_curve(&[0.0, 1e-5, 2e-5], &known, &Unobserved).expect("no failure");
    let points: Vec<_> = [0.0, 1e-5, 2e-5]
        .iter()
        .zip(&curve)
        .map(|(load, point)| {
            let speed = SweepQuantity::Speed.of(point.operation()).expect("steady").value;
            RatedPoint::under_load([*load, 0.0], [speed, 0.3])
        })
        .collect();
    let fit = MotorFit::new(&motor, &points, &[], &ranges, &settings, &Unobserved).expect("fits");
    let mut numbers: Vec<_> =
        fit.points.iter().flat_map(|point| [point.fitted, point.standard_error]).collect();
    for own in &fit.parameters {
        numbers.push(own.value.unwrap_or(f64::INFINITY));
        let ends = own.accepted.iter().flat_map(|range| [range.low, range.high]);
        numbers.extend(ends.map(|end| end.unwrap_or(f64::INFINITY)));
    }
    numbers.extend([fit.misfit, fit.evaluations as f64]);
    one("rated fits", numbers, 0xd51a_2d8d_52ac_3dd8)
}
