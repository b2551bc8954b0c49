//! Table II: the effects of the uncertainties of the inputs on the airborne speed.

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::parameters::{LaunchSpeeds, Stroke};
use bouncing_disk_plot::{Figure, Label, ruled_table};
use serde::Serialize;

use super::shared::inputs::{Input, toss, with_unit};
use super::shared::numbers::Propagated;
use super::shared::toss::TossCase;
use crate::claims::Claim;
use crate::claims::paper::{self, SectionThree, TableOne, Uncertain};
use crate::experiment::{ExperimentError, Paper};

/// Table II.
pub(crate) fn table2(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    let (table_i, section) = (paper::table_one()?, paper::section_three()?);
    let case = TossCase::from(&table_i);
    let speed = case.airborne_speed()?;
    fig.progress.start(toss::TABLE_TWO.len() as u64, "inputs");
    let mut effects = Vec::new();
    for input in toss::TABLE_TWO {
        let effect = effect(&case, speed, input)?;
        fig.claim(Claim::printed(&effect.key, effect.central_rad_per_s.abs()).note(format!(
            "half the difference of the speeds at both ends; changes at the upper end {:+.3}, at the lower end {:+.3}",
            effect.upper_rad_per_s, effect.lower_rad_per_s
        )));
        effects.push(effect);
        fig.progress.advance(1);
    }

    // All inputs together, by the usual rule and by what else the paper may mean.
    let sizes = || effects.iter().map(|effect| effect.central_rad_per_s.abs());
    let largest = sizes().fold(0.0, f64::max);
    let combined = Combined {
        root_sum_of_squares_rad_per_s: root_sum_of_squares(sizes()),
        sum_rad_per_s: sizes().sum(),
        largest_rad_per_s: largest,
        without_largest_rad_per_s: root_sum_of_squares(sizes().filter(|size| *size < largest)),
    };
    let from_launch_speeds = from_launch_speeds(&table_i, &section)?;
    fig.claim(together(&combined, from_launch_speeds));
    let measured = section.launch_angular_speed_rad_per_s;
    fig.claim(Claim::printed_statement(
        "section3.prediction_agrees",
        (speed - measured.value).abs() <= measured.uncertainty,
        format!(
            "{speed:.2} rad/s, and {measured} measured: the difference is at most the printed uncertainty"
        ),
    ));

    fig.caption(format!(
        "Airborne rotation speed of the toss of Table I and its uncertainties due to each input: half the \
         difference of the speeds at both ends of the input's range, the changes at the ends, and the printed \
         value. Together {:.1} rad/s as a root sum of squares.",
        combined.root_sum_of_squares_rad_per_s
    ));
    let [lag, gravity] = [toss::PHASE_LAG, toss::PRELOAD_ACCELERATION].map(|input| input.row(&case));
    fig.parameter(format!("phase lag {}", lag.0), lag.1);
    fig.parameters(effects.iter().map(|effect| (effect.input.to_owned(), effect.range())));
    fig.parameter(gravity.0, gravity.1);
    fig.draw(draw(&effects, speed, &combined, &section.predicted_airborne_speed_rad_per_s));
    fig.record("airborne_speed_rad_per_s", &speed)?;
    fig.record("effects", &effects)?;
    fig.record("combined", &combined)?;
    // Of c, a_e, a_g, μ and both launch speeds, from which Eq. (14) computes ω and φ_L: the root sum of squares.
    fig.record("uncertainty_from_launch_speeds_rad_per_s", &from_launch_speeds)?;
    fig.record("table_i", &table_i)?;
    fig.record("section", &section)
}

/// The effect of one input's uncertainty on the airborne speed, in rad/s.
#[derive(Debug, Serialize)]
struct Effect {
    input: &'static str,
    /// The symbol as it is set in print.
    label: &'static str,
    unit: &'static str,
    /// The entry of the catalogue.
    key: String,
    value: f64,
    uncertainty: f64,
    /// Change of the speed if the input is larger by its uncertainty.
    upper_rad_per_s: f64,
    /// Change of the speed if it is smaller.
    lower_rad_per_s: f64,
    /// Half the difference of the two.
    central_rad_per_s: f64,
    printed_rad_per_s: f64,
}

impl Effect {
    /// The input's value and uncertainty.
    fn range(&self) -> String {
        with_unit(&format!("{} ± {}", self.value, self.uncertainty), self.unit)
    }
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

fn effect(case: &TossCase, middle: f64, input: Input<TossCase>) -> Result<Effect, ExperimentError> {
    let Uncertain { value, uncertainty } = paper::uncertain(&input.key(), 0)?;
    let change = |by: f64| Ok::<_, ExperimentError>(input.set(case, value + by).airborne_speed()? - middle);
    let (upper, lower) = (change(uncertainty)?, change(-uncertainty)?);
    let key = format!("table2.{}_effect", input.name);
    Ok(Effect {
        input: input.symbol,
        label: input.label,
        unit: input.unit,
        value,
        uncertainty,
        upper_rad_per_s: upper,
        lower_rad_per_s: lower,
        central_rad_per_s: 0.5 * (upper - lower),
        printed_rad_per_s: paper::value(&key)?,
        key,
    })
}

fn root_sum_of_squares(values: impl Iterator<Item = f64>) -> f64 {
    values.map(|value| value * value).sum::<f64>().sqrt()
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

/// The uncertainty of all inputs together by the usual rule, and by what else may be meant: the paper does not say.
fn together(combined: &Combined, from_launch_speeds: f64) -> Claim {
    const KEY: &str = "section3.predicted_airborne_speed_uncertainty";
    let others = [combined.largest_rad_per_s, combined.without_largest_rad_per_s];
    let verdicts = others.map(|uncertainty| Claim::printed(KEY, uncertainty).verdict);
    Claim::printed(KEY, combined.root_sum_of_squares_rad_per_s)
        .by_definition(&verdicts)
        .note(format!(
            "root of the sum of squares; the largest is {:.1}, the others {:.1}; from launch speeds {from_launch_speeds:.1}",
            combined.largest_rad_per_s, combined.without_largest_rad_per_s,
        ))
        .cause("±5 is no sum of the effects")
}

fn draw(effects: &[Effect], speed: f64, combined: &Combined, printed_speed: &str) -> Figure {
    let header = [
        "input",
        "value",
        r"effect on $\dot{\alpha}_f$ (rad/s)",
        "at the upper end",
        "at the lower end",
        "printed",
    ];
    let mut rows: Vec<Vec<Label>> = Vec::new();
    for effect in effects {
        // As many decimals as the printed entry, and one or two more.
        let decimals = if effect.printed_rad_per_s < 1.0 { 4 } else { 2 };
        let signed = |value: f64| Label::plain(&format!("{value:+.decimals$}").replace('-', "−"));
        rows.push(vec![
            Label::new(effect.label),
            Label::plain(&effect.range()),
            Label::plain(&format!("± {:.decimals$}", effect.central_rad_per_s.abs())),
            signed(effect.upper_rad_per_s),
            signed(effect.lower_rad_per_s),
            Label::plain(&format!("± {}", effect.printed_rad_per_s)),
        ]);
    }
    rows.push(vec![
        Label::new(r"$\dot{\alpha}_f$"),
        Label::plain(&format!("{speed:.2} rad/s")),
        Label::plain(&format!("± {:.2} (root sum of squares)", combined.root_sum_of_squares_rad_per_s)),
        Label::plain(""),
        Label::plain(""),
        Label::plain(printed_speed),
    ]);
    ruled_table(&header.map(Label::new), &rows)
}
