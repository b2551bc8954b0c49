//! The computation of Table II.

use bouncing_disk::{LaunchSpeeds, Stroke};

use super::data::{Combined, Effect, Table2Data};
use crate::experiment::ExperimentError;
use crate::figures::toss_case::TossCase;
use crate::figures::uncertainty::Propagated;
use crate::claims::paper::{self, SectionThree, TableOne, TableTwo, Uncertain};
use crate::progress::Progress;

/// Share of an uncertainty over which a slope is taken.
const SLOPE_STEP: f64 = 1e-4;

/// An input of the toss: how the paper names it and how it is changed.
struct Input {
    symbol: &'static str,
    name: &'static str,
    label: &'static str,
    unit: &'static str,
    printed_value: Uncertain,
    printed: f64,
    set: fn(&mut TossCase, f64),
}

fn inputs(table: &TableOne, printed: &TableTwo) -> [Input; 6] {
    [
        Input {
            symbol: "c",
            name: "stroke",
            label: "$c$",
            unit: "m",
            printed_value: table.stroke_m,
            printed: printed.stroke_effect_rad_per_s,
            set: |case, value| case.stroke_m = value,
        },
        Input {
            symbol: "ω",
            name: "angular_frequency",
            label: r"$\omega$",
            unit: "rad/s",
            printed_value: table.angular_frequency_rad_per_s,
            printed: printed.angular_frequency_effect_rad_per_s,
            set: |case, value| case.angular_frequency_rad_per_s = value,
        },
        Input {
            symbol: "a_e",
            name: "contact_radius",
            label: "$a_e$",
            unit: "m",
            printed_value: table.contact_radius_m,
            printed: printed.contact_radius_effect_rad_per_s,
            set: |case, value| case.contact_radius_m = value,
        },
        Input {
            symbol: "a_g",
            name: "gyration_radius",
            label: "$a_g$",
            unit: "m",
            printed_value: table.gyration_radius_m,
            printed: printed.gyration_radius_effect_rad_per_s,
            set: |case, value| case.gyration_radius_m = value,
        },
        Input {
            symbol: "μ",
            name: "friction",
            label: r"$\mu$",
            unit: "",
            printed_value: table.friction,
            printed: printed.friction_effect_rad_per_s,
            set: |case, value| case.friction = value,
        },
        Input {
            symbol: "φ_L",
            name: "amplitude_angle",
            label: r"$\phi_L$",
            unit: "rad",
            printed_value: table.amplitude_angle_rad,
            printed: printed.amplitude_angle_effect_rad_per_s,
            set: |case, value| case.amplitude_angle_rad = value,
        },
    ]
}

fn effect(table: &TossCase, input: &Input) -> Result<Effect, ExperimentError> {
    let Uncertain { value, uncertainty } = input.printed_value;
    let speed = |share: f64| {
        let mut case = *table;
        (input.set)(&mut case, value + share * uncertainty);
        case.airborne_speed()
    };
    let middle = speed(0.0)?;
    let (upper, lower) = (speed(1.0)? - middle, speed(-1.0)? - middle);
    Ok(Effect {
        input: input.symbol.to_owned(),
        key: format!("table2.{}_effect", input.name),
        unit: input.unit.to_owned(),
        value,
        uncertainty,
        upper_rad_per_s: upper,
        lower_rad_per_s: lower,
        central_rad_per_s: 0.5 * (upper - lower),
        linear_rad_per_s: (speed(SLOPE_STEP)? - speed(-SLOPE_STEP)?) / (2.0 * SLOPE_STEP),
        printed_rad_per_s: input.printed,
        label: input.label.to_owned(),
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

pub(super) fn compute(progress: &dyn Progress) -> Result<Table2Data, ExperimentError> {
    let table_i = paper::table_one()?;
    let printed = paper::table_two()?;
    let section = paper::section_three()?;
    let table = TossCase::from(&table_i);
    let inputs = inputs(&table_i, &printed);
    progress.start(inputs.len() as u64, "inputs");
    let mut effects = Vec::new();
    for input in &inputs {
        effects.push(effect(&table, input)?);
        progress.advance(1);
    }
    Ok(Table2Data {
        airborne_speed_rad_per_s: table.airborne_speed()?,
        combined: combined(&effects),
        uncertainty_from_launch_speeds_rad_per_s: from_launch_speeds(&table_i, &section)?,
        effects,
        table_i,
        section,
    })
}
