//! What is computed for Table III.

use bouncing_disk::core::Unobserved;
use std::f64::consts::PI;

use bouncing_disk::{Estimate, InputSpread, InputTolerance, Motor, OperatingSettings, TransientSettings};

use super::data::{Drop, Following, Input, OverInputs, Speed, Table3Data};
use crate::catalogue;
use crate::claim::Cases;
use crate::experiment::{ExperimentError, Quality};
use crate::figures::motor_case::MotorCase;
use crate::figures::printed_inputs::DRAWN;
use crate::figures::stall::Stall;
use crate::figures::synthetic::Noise;
use crate::figures::uncertainty::Propagated;
use crate::paper::{self, SectionFive, Uncertain};

/// Seed of the drops whose height and gravity round to the printed ones.
pub(super) const DROP_SEED: u64 = 95;

pub(super) fn compute(quality: Quality) -> Result<Table3Data, ExperimentError> {
    let table = paper::table_three()?;
    let section = paper::section_five()?;
    let as_frequency = MotorCase::default_of(&table, &section);
    let as_printed =
        MotorCase { preload_acceleration_m_per_s2: table.preload_acceleration_m_per_s2, ..as_frequency };
    let cases = [as_printed, as_frequency];
    let mass = section.rotor_mass_kg();
    let stall = |case: &MotorCase| {
        Stall::of(case, quality.choose(4, 16), TransientSettings::default().relaunch_perturbation)
    };
    let stalls = [stall(&as_printed)?, stall(&as_frequency)?];
    let speeds = [speed(&as_printed, quality)?, speed(&as_frequency, quality)?];
    Ok(Table3Data {
        inputs: inputs(&cases)?,
        printed_inputs: paper::printed_inputs(),
        printed_preload_acceleration_m_per_s2: table.preload_acceleration_m_per_s2,
        frequency_khz: 1e-3 * section.default_frequency_hz,
        gravity_m_per_s2: section.gravity_m_per_s2,
        preloads_n: cases.map(|case| mass * case.preload_acceleration_m_per_s2),
        varied_m_per_s2: paper::preloads()?.preload_accelerations_m_per_s2,
        derived: derived(&cases, &stalls, &speeds, mass)?,
        stalls,
        speeds,
        drop: ball_drop(&section)?,
        ball_gyration_radius_mm: 1e3 * ball_gyration_radius(&section),
    })
}

/// The steady speed of a motor, and the spreads over its inputs.
fn speed(case: &MotorCase, quality: Quality) -> Result<Speed, ExperimentError> {
    let motor = Motor::paper_70_khz()
        .with(|sheet| sheet.preload_acceleration = Some(case.preload_acceleration_m_per_s2))?;
    let settings = OperatingSettings { members: quality.choose(4, 16), ..OperatingSettings::default() };
    let tolerance = InputTolerance { draws: quality.choose(8, 39), ..InputTolerance::default() };
    let over_inputs = |spread: Option<InputSpread>, unit: f64| {
        let quantity = || "spread over the inputs".to_owned();
        let InputSpread { mean, standard_deviation, from_to, draws, trapped, .. } =
            spread.ok_or_else(|| ExperimentError::NoData { quantity: quantity() })?;
        Ok::<_, ExperimentError>(OverInputs {
            tolerance: tolerance.preload,
            mean: mean.value / unit,
            deviation: standard_deviation.value / unit,
            from_to: from_to.map(|end| end / unit),
            draws,
            trapped,
        })
    };
    let Estimate { value, standard_error } = motor.no_load_speed(&settings)?;
    let speeds = motor.speed_spreads(&[0.0], &settings, &tolerance, &Unobserved)?;
    let inertia = motor.mass() * case.gyration_radius_m * case.gyration_radius_m;
    Ok(Speed {
        speed_rad_per_s: value,
        standard_error_rad_per_s: standard_error,
        over_inputs_rad_per_s: over_inputs(speeds.into_iter().next().flatten(), 1.0)?,
        stall_over_inputs_rad_per_s2: over_inputs(
            motor.stall_spread(&settings, &tolerance, &Unobserved)?,
            inertia,
        )?,
    })
}

/// The radius of gyration of a solid ball about a diameter, m.
fn ball_gyration_radius(section: &SectionFive) -> f64 {
    0.4_f64.sqrt() * 0.5 * section.rotor_diameter_m
}

/// An input in SI units, and the power of ten of its printed unit.
type Value = (fn(&MotorCase) -> f64, f64);

/// Symbol, label, unit, name in the catalogue, whether it is known, value.
type Listed = (&'static str, &'static str, &'static str, Option<&'static str>, bool, Value);

/// The inputs in the order of Sec. V A.
const INPUTS: [Listed; 9] = [
    ("a_g", "$a_g$", "mm", Some("gyration_radius"), true, (|case| case.gyration_radius_m, 1e3)),
    ("a_e", "$a_e$", "mm", Some("contact_radius"), true, (|case| case.contact_radius_m, 1e3)),
    ("ω/2π", r"$\omega/2\pi$", "kHz", None, true, (|case| case.frequency_hz, 1e-3)),
    (
        "g",
        "$g$",
        "m/s²",
        Some("preload_acceleration"),
        true,
        (|case| case.preload_acceleration_m_per_s2, 1.0),
    ),
    ("μ", r"$\mu$", "", Some("friction"), false, (|case| case.friction, 1.0)),
    ("ε", r"$\epsilon$", "", Some("restitution"), false, (|case| case.restitution, 1.0)),
    ("A", "$A$", "m", Some("amplitude"), false, (|case| case.amplitude_m, 1.0)),
    (
        "ωΦ",
        r"$\omega \Phi$",
        "rad/s",
        Some("peak_angular_speed"),
        false,
        (|case| case.peak_angular_speed_rad_per_s, 1.0),
    ),
    ("θ", r"$\theta$", "rad", Some("phase_lag"), false, (|case| case.phase_lag_rad, 1.0)),
];

fn inputs(cases: &[MotorCase; 2]) -> Result<Vec<Input>, ExperimentError> {
    let input = |(symbol, label, unit, name, known, (value, power)): Listed| {
        let printed = match name {
            Some(name) => catalogue::text(&format!("table3.{name}"))?.to_owned(),
            None => String::new(),
        };
        Ok(Input {
            symbol: symbol.to_owned(),
            label: label.to_owned(),
            unit: unit.to_owned(),
            printed,
            known,
            values: cases.map(|case| power * value(&case)),
        })
    };
    INPUTS.into_iter().map(input).collect()
}

/// Where the ends of a spread come from.
const WITHIN: &str = "preload and amplitude within 1 %";

fn derived(
    cases: &[MotorCase; 2],
    stalls: &[Stall; 2],
    speeds: &[Speed; 2],
    mass: f64,
) -> Result<Vec<Following>, ExperimentError> {
    let [printed, frequency] = cases;
    let systems = [printed.system()?, frequency.system()?];
    let row = |symbol: &str, label: &str, unit: &str, origin: &str, values: [f64; 2]| Following {
        symbol: symbol.to_owned(),
        label: label.to_owned(),
        unit: unit.to_owned(),
        values,
        origin: origin.to_owned(),
    };
    let omega = systems.map(|system| system.platform().angular_frequency());
    let forcing = systems.map(|system| system.angular_forcing().unwrap_or(f64::INFINITY));
    let peaks = systems.map(|system| system.peak_acceleration());
    let axial_speeds =
        systems.map(|system| system.platform().amplitude() * system.platform().angular_frequency());
    Ok(vec![
        row("ω", r"$\omega$", "rad/s", "", omega),
        row(
            "Φ",
            r"$\Phi$",
            "rad",
            r"$\omega \Phi/\omega$",
            systems.map(|system| system.platform().twist_amplitude()),
        ),
        row("Aω", r"$A \omega$", "m/s", "", axial_speeds),
        row("P", "$P$", "", r"$A \omega^2/g$", peaks),
        row("Γ", r"$\Gamma$", "", r"$A \omega^2/\pi g$", systems.map(|system| system.axial_forcing())),
        row("Γ_T", r"$\Gamma_T$", "", r"$a_g^2 \Phi \omega^2/(a_e \pi g \mu)$", forcing),
        row(
            "Γ_T/Γ",
            r"$\Gamma_T/\Gamma$",
            "",
            r"$a_g^2 \Phi/(a_e \mu A)$",
            [0, 1].map(|index| forcing[index] * PI / peaks[index]),
        ),
        row("mg", "$mg$", "N", "steel ball", cases.map(|case| mass * case.preload_acceleration_m_per_s2)),
        row(
            "largest acceleration",
            r"largest $\ddot{\alpha}$",
            "rad/s²",
            r"$\mu a_e g/a_g^2$",
            cases.map(|case| case.largest_acceleration()),
        ),
        row(
            "shortest rise time",
            "shortest rise",
            "s",
            r"$\omega \Phi$ over the largest $\ddot{\alpha}$",
            cases.map(|case| case.rise_time_s()),
        ),
        row(
            "load that stalls the motor",
            r"stall $T/m a_g^2$",
            "rad/s²",
            "load torque $T$ with mean speed 0",
            stalls.map(|stall| stall.load_rad_per_s2.mean),
        ),
        row(
            "stall torque",
            "stall $T$",
            "µN m",
            "",
            [0, 1].map(|index| {
                let radius = cases[index].gyration_radius_m;
                1e6 * mass * radius * radius * stalls[index].load_rad_per_s2.mean
            }),
        ),
        row(
            "α̇_ss/t_c",
            r"$\dot{\alpha}_{ss}/t_c$",
            "rad/s²",
            "the paper's estimate of it",
            stalls.map(|stall| stall.estimate_rad_per_s2.mean),
        ),
        row(
            "least stall",
            "least stall",
            "rad/s²",
            WITHIN,
            speeds.map(|of| of.stall_over_inputs_rad_per_s2.from_to[0]),
        ),
        row(
            "largest stall",
            "largest stall",
            "rad/s²",
            WITHIN,
            speeds.map(|of| of.stall_over_inputs_rad_per_s2.from_to[1]),
        ),
        row(
            "steady speed",
            r"$\dot{\alpha}_{ss}$",
            "rad/s",
            "mean over time, without load",
            speeds.map(|of| of.speed_rad_per_s),
        ),
        row(
            "least speed",
            "least speed",
            "rad/s",
            WITHIN,
            speeds.map(|of| of.over_inputs_rad_per_s.from_to[0]),
        ),
        row(
            "largest speed",
            "largest speed",
            "rad/s",
            WITHIN,
            speeds.map(|of| of.over_inputs_rad_per_s.from_to[1]),
        ),
    ])
}

fn ball_drop(section: &SectionFive) -> Result<Drop, ExperimentError> {
    let heights = paper::ball_drop()?;
    let gravity = section.gravity_m_per_s2;
    let inputs = [Uncertain { value: heights.drop_height_m, uncertainty: 0.0 }, heights.rebound_height_m];
    let restitution =
        Propagated::of(inputs, |[drop, rebound]| Ok::<_, ExperimentError>((rebound / drop).sqrt()))?;
    let speed = |height: f64| (2.0 * gravity * height).sqrt();
    let height = |speed: f64| speed * speed / (2.0 * gravity);
    let ends = |key: &str, power: i32| -> Result<[f64; 2], ExperimentError> {
        let printed = catalogue::number(key, power)?;
        Ok([printed.value - printed.half_unit, printed.value + printed.half_unit])
    };
    let printed_heights = ends("section5.drop_height", -2)?;
    let printed_speeds = ends("section5.drop_speed", 0)?;
    let [_, highest] = paper::preloads()?.preload_accelerations_m_per_s2;
    // Sec. III A prints the gravitational acceleration, with the digits of Table I.
    let printed_gravities = ends("table1.preload_acceleration", 0)?;
    let needed = |speed: f64, height: f64| speed * speed / (2.0 * height);
    let mut noise = Noise::new(DROP_SEED);
    let mut even = |[low, high]: [f64; 2]| low + (high - low) * noise.even();
    let agreement = Cases::of((0..DRAWN).map(|_| {
        let (height, gravity) = (even(printed_heights), even(printed_gravities));
        (printed_speeds[0]..=printed_speeds[1]).contains(&(2.0 * gravity * height).sqrt())
    }));
    let printed_rebounds = ends("section5.rebound_height", -2)?;
    let printed_restitutions = ends("section5.estimated_restitution", 0)?;
    let restitution_agreement = Cases::of((0..DRAWN).map(|_| {
        let (height, rebound) = (even(printed_heights), even(printed_rebounds));
        (printed_restitutions[0]..=printed_restitutions[1]).contains(&(rebound / height).sqrt())
    }));
    let drop_height = heights.drop_height_m;
    Ok(Drop {
        impact_speed_m_per_s: speed(drop_height),
        impact_speed_range_m_per_s: printed_heights.map(speed),
        heights_of_printed_speed_m: printed_speeds.map(height),
        gravity_of_printed_speed_m_per_s2: needed(paper::value("section5.drop_speed")?, drop_height),
        gravity_range_of_printed_speed_m_per_s2: [
            needed(printed_speeds[0], printed_heights[1]),
            needed(printed_speeds[1], printed_heights[0]),
        ],
        printed_gravity_range_m_per_s2: printed_gravities,
        agreement,
        highest_varied_m_per_s2: highest,
        impact_speed_at_highest_m_per_s: (2.0 * highest * drop_height).sqrt(),
        heights,
        restitution,
        restitution_range: [0, 1].map(|end| (printed_rebounds[end] / printed_heights[1 - end]).sqrt()),
        restitution_agreement,
    })
}
