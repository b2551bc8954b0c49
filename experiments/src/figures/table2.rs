//! Table II: the effects of the uncertainties of the inputs on the airborne speed.

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::parameters::{LaunchSpeeds, Stroke};
use bouncing_disk_plot::{Figure, Label, ruled_table};
use serde::Serialize;

use super::shared::numbers::Propagated;
use super::shared::toss::TossCase;
use crate::claims::{
    Claim,
    paper::{self, SectionThree, TableOne, Uncertain},
};
use crate::experiment::{ExperimentError, Paper};

/// Table II.
pub(crate) fn table2(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    let progress = fig.progress;
    let table_i = paper::table_one()?;
    let section = paper::section_three()?;
    let table = TossCase::from(&table_i);
    progress.start(INPUTS.len() as u64, "inputs");
    let mut effects = Vec::new();
    for input in INPUTS {
        effects.push(effect(&table_i, input)?);
        progress.advance(1);
    }
    let data = &Table2Data {
        airborne_speed_rad_per_s: table.airborne_speed()?,
        combined: combined(&effects),
        uncertainty_from_launch_speeds_rad_per_s: from_launch_speeds(&table_i, &section)?,
        effects,
        table_i,
        section,
    };
    fig.caption(format!(
        "Airborne rotation speed of the toss of Table I and its uncertainties due to each input: half the \
         difference of the speeds at both ends of the input's range, the changes at the ends, and the printed \
         value. Together {:.1} rad/s as a root sum of squares.",
        data.combined.root_sum_of_squares_rad_per_s
    ));
    fig.parameters(parameters(data));
    fig.claims(claims(data));
    fig.draw(draw(data)?);
    fig.data(data)
}

fn parameters(data: &Table2Data) -> Vec<(String, String)> {
    let mut parameters = vec![("phase lag θ".to_owned(), format!("{} rad", data.table_i.phase_lag_rad))];
    parameters.extend(data.effects.iter().map(|effect| {
        let value = format!("{} ± {} {}", effect.value, effect.uncertainty, effect.unit);
        (effect.input.clone(), value.trim_end().to_owned())
    }));
    parameters.push(("g".to_owned(), format!("{} m/s²", data.table_i.preload_acceleration_m_per_s2)));
    parameters
}

fn claims(data: &Table2Data) -> Vec<Claim> {
    let mut claims = Vec::new();
    for effect in &data.effects {
        let claim = Claim::printed(&effect.key, effect.central_rad_per_s.abs());
        claims.push(claim.note(format!(
            "half the difference of the speeds at both ends; changes at the upper end {:+.3}, at the lower end {:+.3}",
            effect.upper_rad_per_s, effect.lower_rad_per_s
        )));
    }
    claims.push(together(data));
    claims
}

fn draw(data: &Table2Data) -> Result<Figure, ExperimentError> {
    let header = [
        "input",
        "value",
        r"effect on $\dot{\alpha}_f$ (rad/s)",
        "at the upper end",
        "at the lower end",
        "printed",
    ]
    .map(Label::new);
    let mut rows: Vec<Vec<Label>> = Vec::new();
    for effect in &data.effects {
        // As many decimals as the printed entry, and one or two more.
        let decimals = if effect.printed_rad_per_s < 1.0 { 4 } else { 2 };
        let unit = if effect.unit.is_empty() { String::new() } else { format!(" {}", effect.unit) };
        rows.push(vec![
            Label::new(&effect.label),
            Label::plain(&format!("{} ± {}{unit}", effect.value, effect.uncertainty)),
            Label::plain(&format!("± {:.decimals$}", effect.central_rad_per_s.abs())),
            Label::plain(&signed(effect.upper_rad_per_s, decimals)),
            Label::plain(&signed(effect.lower_rad_per_s, decimals)),
            Label::plain(&format!("± {}", effect.printed_rad_per_s)),
        ]);
    }
    rows.push(vec![
        Label::new(r"$\dot{\alpha}_f$"),
        Label::plain(&format!("{:.2} rad/s", data.airborne_speed_rad_per_s)),
        Label::plain(&format!("± {:.2} (root sum of squares)", data.combined.root_sum_of_squares_rad_per_s)),
        Label::plain(""),
        Label::plain(""),
        Label::plain(&data.section.predicted_airborne_speed_rad_per_s),
    ]);
    Ok(ruled_table(&header, &rows))
}

/// The data of Table II.
#[derive(Debug, Serialize)]
pub(crate) struct Table2Data {
    table_i: TableOne,
    section: SectionThree,
    airborne_speed_rad_per_s: f64,
    effects: Vec<Effect>,
    combined: Combined,
    /// Effect of c, a_e, a_g, μ and both launch speeds, from which Eq. (14) computes ω and φ_L: the root sum
    /// of squares.
    uncertainty_from_launch_speeds_rad_per_s: f64,
}

/// The effect of one input's uncertainty on the airborne speed, in rad/s.
#[derive(Debug, Serialize)]
struct Effect {
    input: String,
    /// The entry of the catalogue.
    key: String,
    unit: String,
    value: f64,
    uncertainty: f64,
    /// Change of the speed if the input is larger by its uncertainty.
    upper_rad_per_s: f64,
    /// Change of the speed if it is smaller.
    lower_rad_per_s: f64,
    /// Half the difference of the two.
    central_rad_per_s: f64,
    printed_rad_per_s: f64,
    /// The symbol as it is set in print.
    label: String,
}

/// The effects of all inputs together, in rad/s, from central effects.
#[derive(Debug, Serialize)]
struct Combined {
    root_sum_of_squares_rad_per_s: f64,
    sum_rad_per_s: f64,
    largest_rad_per_s: f64,
    /// Root sum of squares without the largest.
    without_largest_rad_per_s: f64,
}

/// An input of the toss: symbol, name in the catalogue, label, unit, what Table I prints, and how it is changed.
type Input = (
    &'static str,
    &'static str,
    &'static str,
    &'static str,
    fn(&TableOne) -> Uncertain,
    fn(&mut TossCase, f64),
);

const INPUTS: [Input; 6] = [
    ("c", "stroke", "$c$", "m", |table| table.stroke_m, |case, value| case.stroke_m = value),
    (
        "ω",
        "angular_frequency",
        r"$\omega$",
        "rad/s",
        |table| table.angular_frequency_rad_per_s,
        |case, value| case.angular_frequency_rad_per_s = value,
    ),
    (
        "a_e",
        "contact_radius",
        "$a_e$",
        "m",
        |table| table.contact_radius_m,
        |case, value| case.contact_radius_m = value,
    ),
    (
        "a_g",
        "gyration_radius",
        "$a_g$",
        "m",
        |table| table.gyration_radius_m,
        |case, value| case.gyration_radius_m = value,
    ),
    ("μ", "friction", r"$\mu$", "", |table| table.friction, |case, value| case.friction = value),
    (
        "φ_L",
        "amplitude_angle",
        r"$\phi_L$",
        "rad",
        |table| table.amplitude_angle_rad,
        |case, value| case.amplitude_angle_rad = value,
    ),
];

fn effect(
    table: &TableOne,
    (symbol, name, label, unit, printed, set): Input,
) -> Result<Effect, ExperimentError> {
    let Uncertain { value, uncertainty } = printed(table);
    let speed = |share: f64| {
        let mut case = TossCase::from(table);
        set(&mut case, value + share * uncertainty);
        case.airborne_speed()
    };
    let middle = speed(0.0)?;
    let (upper, lower) = (speed(1.0)? - middle, speed(-1.0)? - middle);
    let key = format!("table2.{name}_effect");
    Ok(Effect {
        input: symbol.to_owned(),
        unit: unit.to_owned(),
        value,
        uncertainty,
        upper_rad_per_s: upper,
        lower_rad_per_s: lower,
        central_rad_per_s: 0.5 * (upper - lower),
        printed_rad_per_s: paper::value(&key)?,
        key,
        label: label.to_owned(),
    })
}

fn root_sum_of_squares(values: impl Iterator<Item = f64>) -> f64 {
    values.map(|value| value * value).sum::<f64>().sqrt()
}

fn combined(effects: &[Effect]) -> Combined {
    let sizes: Vec<_> = effects.iter().map(|effect| effect.central_rad_per_s.abs()).collect();
    let largest = sizes.iter().copied().fold(0.0, f64::max);
    let total = root_sum_of_squares(sizes.iter().copied());
    Combined {
        root_sum_of_squares_rad_per_s: total,
        sum_rad_per_s: sizes.iter().sum(),
        largest_rad_per_s: largest,
        without_largest_rad_per_s: root_sum_of_squares(sizes.into_iter().filter(|size| *size < largest)),
    }
}

/// The uncertainty of the airborne speed if the launch speeds are inputs, and ω and φ_L come from Eq. (14).
fn from_launch_speeds(table: &TableOne, section: &SectionThree) -> Result<f64, ExperimentError> {
    let inputs = [
        section.launch_speed_m_per_s,
        section.launch_angular_speed_rad_per_s,
        table.stroke_m,
        table.contact_radius_m,
        table.gyration_radius_m,
        table.friction,
    ];
    let airborne_speed =
        |[axial_speed, angular_speed, stroke, contact_radius, gyration_radius, friction]: [f64; 6]| {
            let launch = LaunchSpeeds { axial_speed, angular_speed, stroke, contact_radius };
            let stroke = Stroke::from_launch_speeds(launch)?;
            TossCase {
                stroke_m: stroke.stroke,
                contact_radius_m: contact_radius,
                angular_frequency_rad_per_s: stroke.angular_frequency,
                amplitude_angle_rad: stroke.amplitude_angle,
                gyration_radius_m: gyration_radius,
                friction,
                ..TossCase::from(table)
            }
            .airborne_speed()
        };
    Ok(Propagated::of(inputs, airborne_speed)?.root_sum_of_squares)
}

fn signed(value: f64, decimals: usize) -> String {
    format!("{value:+.decimals$}").replace('-', "−")
}

/// The uncertainty of all inputs together by the usual rule, and by what else may be meant: the paper does not say.
fn together(data: &Table2Data) -> Claim {
    const KEY: &str = "section3.predicted_airborne_speed_uncertainty";
    let combined = &data.combined;
    let others = [combined.largest_rad_per_s, combined.without_largest_rad_per_s];
    let verdicts = others.map(|uncertainty| Claim::printed(KEY, uncertainty).verdict);
    Claim::printed(KEY, combined.root_sum_of_squares_rad_per_s).by_definition(&verdicts).note(format!(
            "root of the sum of squares; the largest single effect is {:.1} and the root sum of squares of the others {:.1}, both of which print as the \
             paper's number; ω and φ_L are not independent of c and a_e: with both launch speeds, c, a_e, a_g and μ as independent inputs it is {:.1}",
            combined.largest_rad_per_s,
            combined.without_largest_rad_per_s,
            data.uncertainty_from_launch_speeds_rad_per_s
        ))
        .cause("±5 is no sum of the effects")
}
