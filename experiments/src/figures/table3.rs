//! Table III: the default motor in both readings of its last column, and what the entries were computed from.

use std::f64::consts::PI;

use bouncing_disk::Unobserved;
use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::motor::{Estimate, InputSpread, InputTolerance, OperatingSettings, TransientSettings};
use bouncing_disk_plot::{Figure, Label, ruled_table};
use serde::Serialize;

use super::shared::alike::DRAWN;
use super::shared::motor::MotorCase;
use super::shared::numbers::{Noise, Propagated};
use super::shared::stall::Stall;
use crate::claims::{
    Cases, Claim, catalogue,
    paper::{self, BallDrop, SectionFive, Uncertain},
};
use crate::experiment::{ExperimentError, Paper, Quality};

/// Table III.
pub(crate) fn table3(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    fig.seed("drops of the ball", DROP_SEED);
    fig.seed("runs to stall", OperatingSettings::default().seed);
    fig.seed("ensembles", TransientSettings::default().seed);
    let quality = fig.quality;
    let table = paper::table_three()?;
    let section = paper::section_five()?;
    let as_frequency = MotorCase::table_three()?;
    let as_printed =
        MotorCase { preload_acceleration_m_per_s2: table.preload_acceleration_m_per_s2, ..as_frequency };
    let cases = [as_printed, as_frequency];
    let mass = section.rotor_mass_kg();
    let stall = |case: &MotorCase| {
        Stall::of(case, quality.choose(4, 16), TransientSettings::default().relaunch_perturbation)
    };
    let tolerance = InputTolerance { draws: quality.choose(8, 39), ..InputTolerance::default() };
    let stalls = [stall(&as_printed)?, stall(&as_frequency)?];
    let speeds = [speed(&as_printed, quality, None)?, speed(&as_frequency, quality, Some(tolerance))?];
    let data = &Table3Data {
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
    };
    fig.caption(format!(
        "The default motor. Sec. V A announces {} inputs, the table prints {}: a column for ω is missing, and its \
         last column can be read in two ways, both computed here: g = {} m/s² as printed, or ω/2π = {} kHz with \
         gravity for g. ω is 2π × {} kHz in both. Below the nine inputs: what follows from \
         them. The load torque that stalls the motor is that at which the mean speed of {} members is zero; the paper takes \
         α̇_ss/t_c for it.",
        data.inputs.len(),
        data.printed_inputs,
        data.printed_preload_acceleration_m_per_s2,
        data.frequency_khz,
        data.frequency_khz,
        data.stalls[1].members,
    ));
    fig.parameters(parameters(data));
    fig.claims(claims(data));
    fig.draw(draw(data)?);
    fig.data(data)
}

fn parameters(data: &Table3Data) -> Vec<(String, String)> {
    let drop = &data.drop;
    let mut parameters: Vec<_> = data
        .inputs
        .iter()
        .map(|input| {
            (input.symbol.clone(), format!("{} {}", shown(input.values[1]), input.unit).trim_end().to_owned())
        })
        .collect();
    parameters.push(("height of the drop".to_owned(), format!("{} m", drop.heights.drop_height_m)));
    parameters.push(("height of the rebound".to_owned(), format!("{} m", drop.heights.rebound_height_m)));
    parameters.push(MotorCase::contact_row(MotorCase::table_three()));
    parameters
}

fn claims(data: &Table3Data) -> Vec<Claim> {
    let missing: Vec<_> = data
        .inputs
        .iter()
        .filter(|input| input.printed.is_empty())
        .map(|input| input.symbol.clone())
        .collect();
    let drop = &data.drop;
    let [slowest, fastest] = drop.impact_speed_range_m_per_s;
    vec![
        Claim::printed("section5.announced_inputs", data.inputs.len() as f64).note(format!(
            "all are needed to build the model's platform and disk; Table III prints {}: {} is missing",
            data.printed_inputs,
            missing.join(", ")
        )),
        Claim::printed("table3.gyration_radius", data.ball_gyration_radius_mm)
            .note("a_g of a solid ball is √(2/5) of its radius"),
        preload(data),
        Claim::printed("section5.estimated_restitution", drop.restitution.value)
            .judged_over(drop.restitution_agreement)
            .note(format!(
                "square root of rebound height over drop height. Heights that round to the printed ones give {:.3} to {:.3}, {} in {} of them an ε that \
                 rounds to the printed one",
                drop.restitution_range[0],
                drop.restitution_range[1],
                drop.restitution_agreement.holding,
                drop.restitution_agreement.tried,
            )),
        Claim::printed("section5.drop_speed", drop.impact_speed_m_per_s).judged_over(drop.agreement).note(format!(
            "heights that round to {:.1} cm give {slowest:.3} to {fastest:.3} m/s with g = {} m/s²; of heights and g that round to the printed ones {} in {} give the \
             printed speed, with g up to the {} m/s² of the motor's full preload {} in {}",
            100.0 * drop.heights.drop_height_m,
            data.gravity_m_per_s2,
            drop.agreement.holding,
            drop.agreement.tried,
            drop.highest_varied_m_per_s2,
            drop.agreement_to_highest.holding,
            drop.agreement_to_highest.tried,
        ))
        .cause("a fall with another gravitational acceleration"),
        drop_gravity(data),
    ]
}

fn draw(data: &Table3Data) -> Result<Figure, ExperimentError> {
    let header =
        ["", "unit", "printed", r"$g$ as printed", r"70 is $\omega/2\pi$ in kHz", "from"].map(Label::new);
    let inputs = data.inputs.iter().map(|input| {
        vec![
            Label::new(&input.label),
            Label::plain(&input.unit),
            Label::plain(&input.printed),
            Label::plain(&shown(input.values[0])),
            Label::plain(&shown(input.values[1])),
            Label::plain(if input.known { "known input" } else { "estimated input" }),
        ]
    });
    let derived = data.derived.iter().map(|row| {
        vec![
            Label::new(&row.label),
            Label::plain(&row.unit),
            Label::plain(""),
            Label::plain(&row.values[0].map_or_else(String::new, shown)),
            Label::plain(&row.values[1].map_or_else(String::new, shown)),
            Label::new(&row.origin),
        ]
    });
    let rows: Vec<Vec<Label>> = inputs.chain(derived).collect();
    Ok(ruled_table(&header, &rows))
}

/// The data of Table III.
#[derive(Debug, Serialize)]
pub(crate) struct Table3Data {
    inputs: Vec<Input>,
    /// How many of the inputs the table prints.
    printed_inputs: usize,
    printed_preload_acceleration_m_per_s2: f64,
    frequency_khz: f64,
    gravity_m_per_s2: f64,
    /// Preload of the rotor, a steel ball, for the two readings of g.
    preloads_n: [f64; 2],
    /// Range of preloads in the experiments, as accelerations.
    varied_m_per_s2: [f64; 2],
    derived: Vec<Following>,
    /// The load that stalls the motor, for the two readings.
    stalls: [Stall; 2],
    /// The speed without load, and how far it and that load lie apart over the tolerances of the inputs.
    speeds: [Speed; 2],
    drop: Drop,
    /// a_g of a solid ball of the rotor's diameter.
    ball_gyration_radius_mm: f64,
}

/// The steady speed of a motor without load, and what the tolerances of its inputs make of it and of the
/// stall load.
#[derive(Clone, Copy, Debug, Serialize)]
struct Speed {
    speed_rad_per_s: f64,
    standard_error_rad_per_s: f64,
    /// Of the reading that the motors of this work have.
    over_inputs_rad_per_s: Option<OverInputs>,
    stall_over_inputs_rad_per_s2: Option<OverInputs>,
}

/// A number of motors that are drawn: preload and amplitude within a tolerance, the relaunch perturbation
/// within a decade.
#[derive(Clone, Copy, Debug, Serialize)]
struct OverInputs {
    /// The least and the largest.
    from_to: [f64; 2],
    draws: usize,
    trapped: usize,
}

/// An input of a simulation, for both readings.
#[derive(Debug, Serialize)]
struct Input {
    symbol: String,
    /// The symbol as it is set in print.
    label: String,
    unit: String,
    /// As printed; empty if the table does not print it.
    printed: String,
    /// "Accurately known" by Sec. V A; the others are estimated.
    known: bool,
    values: [f64; 2],
}

/// A quantity that follows from the inputs, for both readings.
#[derive(Debug, Serialize)]
struct Following {
    label: String,
    unit: String,
    values: [Option<f64>; 2],
    origin: String,
}

/// The drop of the steel ball.
#[derive(Debug, Serialize)]
struct Drop {
    heights: BallDrop,
    restitution: Propagated,
    /// The least and the largest ε of heights that round to the printed ones.
    restitution_range: [f64; 2],
    /// Of these heights, drawn evenly, those whose ε rounds to the printed one.
    restitution_agreement: Cases,
    /// The agreement of the impact speed with gravitational accelerations up to the highest preload of Sec. V
    /// B.
    agreement_to_highest: Cases,
    impact_speed_m_per_s: f64,
    /// For the heights that are printed as the drop height.
    impact_speed_range_m_per_s: [f64; 2],
    /// The heights that give the printed speed, as rounded.
    heights_of_printed_speed_m: [f64; 2],
    /// v²/(2 h) of the printed speed and height, and for everything that rounds to them.
    gravity_of_printed_speed_m_per_s2: f64,
    gravity_range_of_printed_speed_m_per_s2: [f64; 2],
    /// Of the heights and the g that round to the printed ones, drawn evenly, those that give the printed speed.
    agreement: Cases,
    /// The highest g of Sec. V B, and the impact speed with it.
    highest_varied_m_per_s2: f64,
    impact_speed_at_highest_m_per_s: f64,
}

/// Seed of the drops whose height and gravity round to the printed ones.
const DROP_SEED: u64 = 95;

/// The steady speed of a motor, and with a tolerance the spreads over its inputs.
fn speed(
    case: &MotorCase,
    quality: Quality,
    tolerance: Option<InputTolerance>,
) -> Result<Speed, ExperimentError> {
    let motor = case.motor()?;
    let settings = OperatingSettings { members: quality.choose(4, 16), ..OperatingSettings::default() };
    let over_inputs = |spread: Option<InputSpread>, unit: f64| {
        let quantity = || "spread over the inputs".to_owned();
        let InputSpread { from_to, draws, trapped, .. } =
            spread.ok_or_else(|| ExperimentError::NoData { quantity: quantity() })?;
        Ok::<_, ExperimentError>(OverInputs { from_to: from_to.map(|end| end / unit), draws, trapped })
    };
    let Estimate { value, standard_error } = motor.no_load_speed(&settings)?;
    let mut speed = Speed {
        speed_rad_per_s: value,
        standard_error_rad_per_s: standard_error,
        over_inputs_rad_per_s: None,
        stall_over_inputs_rad_per_s2: None,
    };
    if let Some(tolerance) = tolerance {
        let speeds = motor.speed_spreads(&[0.0], &settings, &tolerance, &Unobserved)?;
        let stall = motor.stall_spread(&settings, &tolerance, &Unobserved)?;
        let inertia = motor.mass() * case.gyration_radius_m * case.gyration_radius_m;
        speed.over_inputs_rad_per_s = Some(over_inputs(speeds.into_iter().next().flatten(), 1.0)?);
        speed.stall_over_inputs_rad_per_s2 = Some(over_inputs(stall, inertia)?);
    }
    Ok(speed)
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
    let row_of = |label: &str, unit: &str, origin: &str, values: [Option<f64>; 2]| Following {
        label: label.to_owned(),
        unit: unit.to_owned(),
        values,
        origin: origin.to_owned(),
    };
    let row = |label: &str, unit: &str, origin: &str, values: [f64; 2]| {
        row_of(label, unit, origin, values.map(Some))
    };
    let spread_end = |label: &str, unit: &str, of: fn(&Speed) -> Option<OverInputs>, end: usize| {
        row_of(label, unit, WITHIN, [0, 1].map(|index| of(&speeds[index]).map(|spread| spread.from_to[end])))
    };
    let omega = systems.map(|system| system.platform().angular_frequency());
    let forcing = systems.map(|system| system.angular_forcing().unwrap_or(f64::INFINITY));
    let peaks = systems.map(|system| system.peak_acceleration());
    let axial_speeds =
        systems.map(|system| system.platform().amplitude() * system.platform().angular_frequency());
    Ok(vec![
        row(r"$\omega$", "rad/s", "", omega),
        row(
            r"$\Phi$",
            "rad",
            r"$\omega \Phi/\omega$",
            systems.map(|system| system.platform().twist_amplitude()),
        ),
        row(r"$A \omega$", "m/s", "", axial_speeds),
        row("$P$", "", r"$A \omega^2/g$", peaks),
        row(r"$\Gamma$", "", r"$A \omega^2/\pi g$", systems.map(|system| system.axial_forcing())),
        row(r"$\Gamma_T$", "", r"$a_g^2 \Phi \omega^2/(a_e \pi g \mu)$", forcing),
        row(
            r"$\Gamma_T/\Gamma$",
            "",
            r"$a_g^2 \Phi/(a_e \mu A)$",
            [0, 1].map(|index| forcing[index] * PI / peaks[index]),
        ),
        row("$mg$", "N", "steel ball", cases.map(|case| mass * case.preload_acceleration_m_per_s2)),
        row(
            r"largest $\ddot{\alpha}$",
            "rad/s²",
            r"$\mu a_e g/a_g^2$",
            cases.map(|case| case.largest_acceleration()),
        ),
        row(
            "shortest rise",
            "s",
            r"$\omega \Phi$ over the largest $\ddot{\alpha}$",
            cases.map(|case| case.rise_time_s()),
        ),
        row(
            r"stall $T/m a_g^2$",
            "rad/s²",
            "load torque $T$ with mean speed 0",
            stalls.map(|stall| stall.load_rad_per_s2.value),
        ),
        row(
            "stall $T$",
            "µN m",
            "",
            [0, 1].map(|index| {
                let radius = cases[index].gyration_radius_m;
                1e6 * mass * radius * radius * stalls[index].load_rad_per_s2.value
            }),
        ),
        row(
            r"$\dot{\alpha}_{ss}/t_c$",
            "rad/s²",
            "the paper's estimate of it",
            stalls.map(|stall| stall.estimate_rad_per_s2.mean),
        ),
        spread_end("least stall", "rad/s²", |of| of.stall_over_inputs_rad_per_s2, 0),
        spread_end("largest stall", "rad/s²", |of| of.stall_over_inputs_rad_per_s2, 1),
        row(
            r"$\dot{\alpha}_{ss}$",
            "rad/s",
            "mean over time, without load",
            speeds.map(|of| of.speed_rad_per_s),
        ),
        spread_end("least speed", "rad/s", |of| of.over_inputs_rad_per_s, 0),
        spread_end("largest speed", "rad/s", |of| of.over_inputs_rad_per_s, 1),
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
    let agreeing = |gravities, even: &mut dyn FnMut([f64; 2]) -> f64| {
        Cases::of((0..DRAWN).map(|_| {
            let (height, gravity) = (even(printed_heights), even(gravities));
            (printed_speeds[0]..=printed_speeds[1]).contains(&(2.0 * gravity * height).sqrt())
        }))
    };
    let agreement = agreeing(printed_gravities, &mut even);
    let printed_rebounds = ends("section5.rebound_height", -2)?;
    let printed_restitutions = ends("section5.estimated_restitution", 0)?;
    let restitution_agreement = Cases::of((0..DRAWN).map(|_| {
        let (height, rebound) = (even(printed_heights), even(printed_rebounds));
        (printed_restitutions[0]..=printed_restitutions[1]).contains(&(rebound / height).sqrt())
    }));
    let agreement_to_highest = agreeing([printed_gravities[0], highest], &mut even);
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
        agreement,
        agreement_to_highest,
        highest_varied_m_per_s2: highest,
        impact_speed_at_highest_m_per_s: (2.0 * highest * drop_height).sqrt(),
        heights,
        restitution,
        restitution_range: [0, 1].map(|end| (printed_rebounds[end] / printed_heights[1 - end]).sqrt()),
        restitution_agreement,
    })
}

/// Four digits and a true minus sign, with a power of ten where the number is large or small.
fn shown(value: f64) -> String {
    if value.abs() > 0.0 && !(1e-2..1e4).contains(&value.abs()) {
        let text = format!("{value:.3e}");
        let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
        let digits = digits.trim_end_matches('0').trim_end_matches('.');
        let power: String = power.chars().map(superscript).collect();
        let digits = digits.replace('-', "−");
        if digits == "1" { format!("10{power}") } else { format!("{digits} × 10{power}") }
    } else {
        let decimals = if value.abs() >= 100.0 {
            1
        } else if value.abs() >= 10.0 {
            2
        } else {
            3
        };
        let text = format!("{value:.decimals$}");
        text.trim_end_matches('0').trim_end_matches('.').replace('-', "−")
    }
}

fn superscript(digit: char) -> char {
    match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        other => other.to_digit(10).and_then(|digit| char::from_u32('⁰' as u32 + digit)).unwrap_or(other),
    }
}

const ID: &str = "table3";

/// The g that gives the printed speed. An inference from printed numbers; the text does not say which g was used.
fn drop_gravity(data: &Table3Data) -> Claim {
    let drop = &data.drop;
    let [least, most] = drop.gravity_range_of_printed_speed_m_per_s2;
    let holds = |gravity: f64| (least..=most).contains(&gravity);
    Claim::statement(
        ID,
        "Sec. V A",
        "the printed impact speed is consistent with the g of 10 m/s² with which Sec. V B ends its range, and not with the 9.8 m/s² of Table I",
        holds(drop.highest_varied_m_per_s2) && !holds(data.gravity_m_per_s2),
        format!(
            "v²/(2h) is {:.2} m/s², and {least:.3} to {most:.3} for everything that rounds to the printed height and speed; with {} m/s² the speed is {:.4} m/s. This suggests, and \
             does not show, that the authors took {} m/s² for gravity, here and as the full preload of Fig. 10, where at A = 1 nm and {} m/s² the motor repeats a short cycle that it does not have elsewhere",
            drop.gravity_of_printed_speed_m_per_s2,
            drop.highest_varied_m_per_s2,
            drop.impact_speed_at_highest_m_per_s,
            drop.highest_varied_m_per_s2,
            data.gravity_m_per_s2,
        ),
    )
}

/// The last column of Table III.
fn preload(data: &Table3Data) -> Claim {
    let [printed, gravity] = data.preloads_n.map(|force| 1e3 * force);
    let [low, high] = data.varied_m_per_s2;
    Claim::printed("table3.preload_acceleration", data.gravity_m_per_s2).note(format!(
        "the frequency is the input that Table III does not print; its default is {} kHz and the preload is gravity, \
         so the 70 is ω/2π in kHz. As printed, g would be a preload of {printed:.0} mN on the rotor, which weighs \
         {gravity:.0} mN, and outside the {low} to {high} m/s² of Sec. V B",
        data.frequency_khz
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_shown_with_four_digits() {
        for (value, text) in [
            (1e-8, "10⁻⁸"),
            (4.398e5, "4.398 × 10⁵"),
            (0.0, "0"),
            (9.8, "9.8"),
            (123.456, "123.5"),
            (1.25, "1.25"),
        ] {
            assert_eq!(shown(value), text);
        }
    }
}
