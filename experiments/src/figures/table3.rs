//! Table III: the default motor in both readings of its last column, and what the entries were computed from.

use std::f64::consts::PI;

use bouncing_disk::Unobserved;
use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::motor::{Estimate, InputSpread, InputTolerance, OperatingSettings, TransientSettings};
use bouncing_disk_plot::{Figure, Label, ruled_table};
use serde::Serialize;

use super::shared::alike::{DRAWN, Range, agreement, draws_of};
use super::shared::inputs::{Input, motor as inputs, with_unit};
use super::shared::motor::MotorCase;
use super::shared::numbers::{Noise, Propagated};
use super::shared::stall::Stall;
use crate::claims::paper::{self, BallDrop, Uncertain};
use crate::claims::{Cases, Claim, Verdict, catalogue};
use crate::experiment::{ExperimentError, Paper, Quality};

/// Table III.
pub(crate) fn table3(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    fig.seed("drops of the ball", DROP_SEED);
    fig.seed("friction and its reference values", FRICTION_SEED);
    fig.seed("runs to stall", OperatingSettings::default().seed);
    let ensembles = TransientSettings::default();
    fig.seed("ensembles", ensembles.seed);
    let quality = fig.quality;
    let (table, section) = (paper::table_three()?, paper::section_five()?);
    let (mass, gravity) = (section.rotor_mass_kg(), section.gravity_m_per_s2);

    // The last column as printed, a preload acceleration, and as what the authors meant.
    let printed_preload = table.preload_acceleration_m_per_s2;
    let as_frequency = MotorCase::table_three()?;
    let as_printed = inputs::PRELOAD_ACCELERATION.set(&as_frequency, printed_preload);
    let cases = [as_printed, as_frequency];
    let rows: Vec<InputRow> = [&inputs::KNOWN[..], &inputs::ESTIMATED]
        .concat()
        .into_iter()
        .map(|input| InputRow::of(input, &cases))
        .collect::<Result<_, _>>()?;
    let printed_inputs = paper::printed_inputs();
    let missing = rows.iter().find(|row| row.printed.is_empty()).map_or("none", |row| row.symbol);
    fig.claim(Claim::printed("section5.announced_inputs", rows.len() as f64).note(format!(
        "all are needed to build the model's platform and disk; Table III prints {printed_inputs}: {missing} is missing"
    )));

    let ball_gyration_radius_mm = 1e3 * (0.4_f64.sqrt() * 0.5 * section.rotor_diameter_m);
    fig.claim(
        Claim::printed("table3.gyration_radius", ball_gyration_radius_mm)
            .note("a_g of a solid ball is √(2/5) of its radius"),
    );
    let frequency_khz = 1e-3 * section.default_frequency_hz;
    let preloads_n = cases.map(|case| mass * case.preload_acceleration_m_per_s2);
    let varied = paper::preloads()?.preload_accelerations_m_per_s2;
    fig.claim(Claim::printed("table3.preload_acceleration", gravity).note(format!(
        "the 70 is ω/2π in kHz, which the table omits: as g it would press the rotor of {:.0} mN with {:.0} mN, outside the {} to {} m/s² of Sec. V B",
        1e3 * preloads_n[1],
        1e3 * preloads_n[0],
        varied[0],
        varied[1],
    )));

    fig.claim(reference_friction()?);

    // What the motor of either reading does.
    let tolerance = InputTolerance { draws: quality.choose(8, 39), ..InputTolerance::default() };
    let stalls =
        Stall::of_each(&[as_printed, as_frequency], quality.choose(4, 8), ensembles.relaunch_perturbation)?;
    let speeds = [speed(&as_printed, quality, None)?, speed(&as_frequency, quality, Some(tolerance))?];
    let derived = derived(&cases, &stalls, &speeds, mass)?;

    let drop = Drop::of(gravity, varied[1])?;
    fig.claims(drop.claims(gravity)?);

    fig.caption(format!(
        "The default motor. Sec. V A announces {} inputs, the table prints {printed_inputs}: a column for ω is missing, and its \
         last column can be read in two ways, both computed here: g = {printed_preload} m/s² as printed, or ω/2π = {frequency_khz} kHz with \
         gravity for g. ω is 2π × {frequency_khz} kHz in both. Below the nine inputs: what follows from \
         them. The load torque that stalls the motor makes the mean speed of {} members zero; the paper uses \
         α̇_ss/t_c instead.",
        rows.len(),
        stalls[1].members,
    ));
    fig.parameters(
        rows.iter().map(|row| (row.symbol.to_owned(), with_unit(&shown(row.values[1]), row.unit))),
    );
    fig.parameter("height of the drop", format!("{} m", drop.heights.drop_height_m));
    fig.parameter("height of the rebound", format!("{} m", drop.heights.rebound_height_m));
    fig.parameters([MotorCase::contact_row([as_frequency])]);
    fig.draw(draw(&rows, &derived));
    fig.record("inputs", &rows)?;
    fig.record("printed_inputs", &printed_inputs)?;
    fig.record("printed_preload_acceleration_m_per_s2", &printed_preload)?;
    fig.record("frequency_khz", &frequency_khz)?;
    fig.record("gravity_m_per_s2", &gravity)?;
    fig.record("preloads_n", &preloads_n)?;
    fig.record("varied_m_per_s2", &varied)?;
    fig.record("derived", &derived)?;
    fig.record("stalls", &stalls)?;
    fig.record("speeds", &speeds)?;
    fig.record("drop", &drop)?;
    fig.record("ball_gyration_radius_mm", &ball_gyration_radius_mm)
}

/// An input of a simulation, for both readings.
#[derive(Debug, Serialize)]
struct InputRow {
    symbol: &'static str,
    /// The symbol as it is set in print.
    label: &'static str,
    unit: &'static str,
    /// As printed; empty if the table does not print it.
    printed: &'static str,
    /// "Accurately known" by Sec. V A; the others are estimated.
    known: bool,
    /// In the printed unit.
    values: [f64; 2],
    #[serde(skip)]
    words: String,
}

impl InputRow {
    fn of(input: Input<MotorCase>, cases: &[MotorCase; 2]) -> Result<Self, ExperimentError> {
        let is_printed = input != inputs::FREQUENCY;
        let entry =
            if is_printed { input.entry()? } else { catalogue::find("section1.own_motor_frequency")? };
        let per_si_unit = match entry.unit.as_str() {
            "mm" => 1e3,
            "kHz" => 1e-3,
            _ => 1.0,
        };
        Ok(Self {
            symbol: input.symbol,
            label: input.label,
            unit: &entry.unit,
            printed: entry.printed.as_deref().filter(|_| is_printed).unwrap_or_default(),
            known: inputs::KNOWN.contains(&input),
            values: cases.map(|case| per_si_unit * input.of(&case)),
            words: input.words(),
        })
    }
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

/// A quantity that follows from the inputs, for both readings.
#[derive(Debug, Serialize)]
struct Following {
    /// What it is.
    words: &'static str,
    /// The symbol as it is set in print.
    label: &'static str,
    unit: &'static str,
    values: [Option<f64>; 2],
    origin: &'static str,
}

fn derived(
    cases: &[MotorCase; 2],
    stalls: &[Stall],
    speeds: &[Speed; 2],
    mass: f64,
) -> Result<Vec<Following>, ExperimentError> {
    let [printed, frequency] = cases;
    let systems = [printed.system()?, frequency.system()?];
    let row_of = |words, label, unit, origin, values| Following { words, label, unit, values, origin };
    let row =
        |words, label, unit, origin, values: [f64; 2]| row_of(words, label, unit, origin, values.map(Some));
    let end = |of: fn(&Speed) -> Option<OverInputs>, end: usize| {
        speeds.each_ref().map(|speed| of(speed).map(|spread| spread.from_to[end]))
    };
    let platforms = systems.map(|system| *system.platform());
    let omega = platforms.map(|platform| platform.angular_frequency());
    let forcing = systems.map(|system| system.angular_forcing().unwrap_or(f64::INFINITY));
    let peaks = systems.map(|system| system.peak_acceleration());
    let weights = cases.map(|case| mass * case.preload_acceleration_m_per_s2);
    let axial_speeds = platforms.map(|platform| platform.amplitude() * platform.angular_frequency());
    let largest = cases.map(|case| case.largest_acceleration());
    let stall = [0, 1].map(|reading| stalls[reading].load_rad_per_s2.value);
    let stall_torques = [0, 1].map(|index| {
        let radius = cases[index].gyration_radius_m;
        1e6 * mass * radius * radius * stall[index]
    });
    const WITHIN: &str = "preload and amplitude within 1 %";
    const STALL: &str = "$T/m a_g^2$";
    const SPEED: &str = r"$\dot{\alpha}_{ss}$";
    Ok(vec![
        row("angular frequency", r"$\omega$", "rad/s", "", omega),
        row(
            "twist amplitude",
            r"$\Phi$",
            "rad",
            r"$\omega \Phi/\omega$",
            platforms.map(|own| own.twist_amplitude()),
        ),
        row("peak axial speed", r"$A \omega$", "m/s", "", axial_speeds),
        row("peak acceleration", "$P$", "", r"$A \omega^2/g$", peaks),
        row(
            "axial forcing",
            r"$\Gamma$",
            "",
            r"$A \omega^2/\pi g$",
            systems.map(|system| system.axial_forcing()),
        ),
        row("angular forcing", r"$\Gamma_T$", "", r"$a_g^2 \Phi \omega^2/(a_e \pi g \mu)$", forcing),
        row(
            "ratio of forcings",
            r"$\Gamma_T/\Gamma$",
            "",
            r"$a_g^2 \Phi/(a_e \mu A)$",
            [0, 1].map(|index| forcing[index] * PI / peaks[index]),
        ),
        row("preload", "$mg$", "N", "steel ball", weights),
        row("largest acceleration", r"$\ddot{\alpha}$", "rad/s²", r"$\mu a_e g/a_g^2$", largest),
        row(
            "shortest rise",
            "",
            "s",
            r"$\omega \Phi$ over the largest $\ddot{\alpha}$",
            cases.map(|case| case.rise_time_s()),
        ),
        row("stall load", STALL, "rad/s²", "load torque $T$ with mean speed 0", stall),
        row("stall torque", "$T$", "µN m", "", stall_torques),
        row(
            "paper's estimate",
            r"$\dot{\alpha}_{ss}/t_c$",
            "rad/s²",
            "of the stall load, from a transient",
            [0, 1].map(|reading| stalls[reading].estimate_rad_per_s2.mean),
        ),
        row_of("least stall load", STALL, "rad/s²", WITHIN, end(|of| of.stall_over_inputs_rad_per_s2, 0)),
        row_of("largest stall load", STALL, "rad/s²", WITHIN, end(|of| of.stall_over_inputs_rad_per_s2, 1)),
        row(
            "steady speed",
            SPEED,
            "rad/s",
            "mean over time, without load",
            speeds.map(|of| of.speed_rad_per_s),
        ),
        row_of("least steady speed", SPEED, "rad/s", WITHIN, end(|of| of.over_inputs_rad_per_s, 0)),
        row_of("largest steady speed", SPEED, "rad/s", WITHIN, end(|of| of.over_inputs_rad_per_s, 1)),
    ])
}

/// Seed of the measured μ and of its reference values.
const FRICTION_SEED: u64 = 3;

/// "About three" is what is nearer to three than to another integer.
const ABOUT_THREE: std::ops::RangeInclusive<f64> = 2.5..=3.5;

/// The reference values against the μ of Table III.
fn reference_friction() -> Result<Claim, ExperimentError> {
    let low = paper::value("section5.lowest_reference_friction")?;
    let references = Range::exactly(low).up_to(paper::value("section5.highest_reference_friction")?);
    let measured = Range::printed("section5.mean_friction", 0)?;
    let measured_friction = paper::value("section5.mean_friction")?;
    let drawn = draws_of([references, measured], DRAWN, &mut Noise::new(FRICTION_SEED));
    let cases =
        Cases::of(drawn.iter().map(|[reference, measured]| ABOUT_THREE.contains(&(reference / measured))));
    // Or the lowest reference value is meant.
    let lowest =
        if ABOUT_THREE.contains(&(low / measured_friction)) { Verdict::Reproduced } else { Verdict::Differs };
    Ok(Claim::printed_statement(
        "section5.reference_friction_is_threefold",
        cases,
        format!(
            "of the reference values 0.3 to 0.4 over values that round to 0.10, {} are between 2.5 and 3.5",
            cases.words()
        ),
    )
    .judged_over(cases)
    .by_definition(&[lowest]))
}

/// Seed of the drops whose height and gravity round to the printed ones.
const DROP_SEED: u64 = 95;

/// The drop of the steel ball.
#[derive(Debug, Serialize)]
struct Drop {
    heights: BallDrop,
    restitution: Propagated,
    /// The least and the largest ε of heights that round to the printed ones.
    restitution_range: [f64; 2],
    /// Of these heights, drawn evenly, those whose ε rounds to the printed one.
    restitution_agreement: Cases,
    /// The same of its uncertainty.
    #[serde(skip)]
    uncertainty_agreement: Cases,
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
    /// The same with g up to the highest of Sec. V B.
    agreement_to_highest: Cases,
    /// The highest g of Sec. V B, and the impact speed with it.
    highest_varied_m_per_s2: f64,
    impact_speed_at_highest_m_per_s: f64,
}

impl Drop {
    fn of(gravity: f64, highest: f64) -> Result<Self, ExperimentError> {
        let heights = paper::ball_drop()?;
        let drop_height = heights.drop_height_m;
        let fall = |gravity: f64, height: f64| (2.0 * gravity * height).sqrt();
        let needed = |speed: f64, height: f64| speed * speed / (2.0 * height);
        let restitution = |height: f64, rebound: f64| (rebound / height).sqrt();
        let drops = Range::printed("section5.drop_height", -2)?;
        let rebounds = Range::printed("section5.rebound_height", -2)?;
        let speeds = Range::printed("section5.drop_speed", 0)?.ends();
        // Sec. III A prints the gravitational acceleration, with the digits of Table I.
        let gravities = Range::printed("table1.preload_acceleration", 0)?;
        let mut noise = Noise::new(DROP_SEED);
        let mut agreeing = |key, of: &dyn Fn(f64, f64) -> f64, other| {
            let drawn = draws_of([drops, other], DRAWN, &mut noise);
            agreement(key, drawn.iter().map(|[height, other]| of(*height, *other)))
        };
        let speed = |height: f64, gravity: f64| fall(gravity, height);
        let agreement = agreeing("section5.drop_speed", &speed, gravities)?;
        let restitution_agreement = agreeing("section5.estimated_restitution", &restitution, rebounds)?;
        let agreement_to_highest = agreeing("section5.drop_speed", &speed, gravities.up_to(highest))?;
        let uncertainty = |height: f64, rebound: f64| {
            let by = heights.rebound_height_m.uncertainty;
            0.5 * (restitution(height, rebound + by) - restitution(height, rebound - by))
        };
        let uncertainty_agreement =
            agreeing("section5.estimated_restitution_uncertainty", &uncertainty, rebounds)?;
        let inputs = [Uncertain { value: drop_height, uncertainty: 0.0 }, heights.rebound_height_m];
        let ([least, most], [lowest, highest_rebound]) = (drops.ends(), rebounds.ends());
        Ok(Self {
            restitution: Propagated::of(inputs, |[drop, rebound]| {
                Ok::<_, ExperimentError>(restitution(drop, rebound))
            })?,
            restitution_range: [restitution(most, lowest), restitution(least, highest_rebound)],
            restitution_agreement,
            uncertainty_agreement,
            impact_speed_m_per_s: fall(gravity, drop_height),
            impact_speed_range_m_per_s: drops.ends().map(|height| fall(gravity, height)),
            heights_of_printed_speed_m: speeds.map(|speed| speed * speed / (2.0 * gravity)),
            gravity_of_printed_speed_m_per_s2: needed(paper::value("section5.drop_speed")?, drop_height),
            gravity_range_of_printed_speed_m_per_s2: [needed(speeds[0], most), needed(speeds[1], least)],
            agreement,
            agreement_to_highest,
            highest_varied_m_per_s2: highest,
            impact_speed_at_highest_m_per_s: (2.0 * highest * drop_height).sqrt(),
            heights,
        })
    }

    fn claims(&self, gravity: f64) -> Result<Vec<Claim>, ExperimentError> {
        let highest = self.highest_varied_m_per_s2;
        let [least, most] = self.gravity_range_of_printed_speed_m_per_s2;
        let gives_printed_speed = |gravity: f64| (least..=most).contains(&gravity);
        Ok(vec![
            Claim::printed("section5.estimated_restitution", self.restitution.value)
                .judged_over(self.restitution_agreement)
                .note(format!(
                    "square root of rebound height over drop height; heights that round to the printed ones give {:.3} to {:.3}",
                    self.restitution_range[0], self.restitution_range[1],
                )),
            Claim::printed("section5.estimated_restitution_uncertainty", self.restitution.sum)
                .judged_over(self.uncertainty_agreement)
                .note(format!(
                    "half the difference of the ε at both ends of 0.9 ± 0.5 cm; {} of heights that print alike",
                    self.uncertainty_agreement.words(),
                )),
            Claim::printed("section5.drop_speed", self.impact_speed_m_per_s)
                .judged_over(self.agreement)
                .note(format!(
                    "√(2gh) with heights and g that round to the printed ones; with g up to the {highest} m/s² of the motor {} of {}",
                    self.agreement_to_highest.holding, self.agreement_to_highest.tried,
                ))
                .cause("another gravity in the fall of the ball"),
            // An inference from printed numbers; the text does not say which g was used.
            Claim::statement(
                "table3",
                "Sec. V A",
                "the printed impact speed is consistent with the g of 10 m/s² with which Sec. V B ends its range, and not with the 9.8 m/s² of Table I",
                gives_printed_speed(highest) && !gives_printed_speed(gravity),
                format!(
                    "v²/(2h) is {least:.3} to {most:.3} m/s² for everything that rounds to the printed speed and height. The authors may have \
                     taken {highest} m/s² for gravity, as for the full preload of Fig. 10",
                ),
            ),
        ])
    }
}

fn draw(inputs: &[InputRow], derived: &[Following]) -> Figure {
    let header =
        ["", "", "unit", "printed", r"$g$ as printed", r"70 is $\omega/2\pi$ in kHz", "from"].map(Label::new);
    let inputs = inputs.iter().map(|row| {
        vec![
            Label::plain(&row.words),
            Label::new(row.label),
            Label::plain(row.unit),
            Label::plain(row.printed),
            Label::plain(&shown(row.values[0])),
            Label::plain(&shown(row.values[1])),
            Label::plain(if row.known { "known input" } else { "estimated input" }),
        ]
    });
    let derived = derived.iter().map(|row| {
        vec![
            Label::plain(row.words),
            Label::new(row.label),
            Label::plain(row.unit),
            Label::plain(""),
            Label::plain(&row.values[0].map_or_else(String::new, shown)),
            Label::plain(&row.values[1].map_or_else(String::new, shown)),
            Label::new(row.origin),
        ]
    });
    ruled_table(&header, &inputs.chain(derived).collect::<Vec<_>>())
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
