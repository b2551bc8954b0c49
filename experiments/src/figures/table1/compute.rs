//! What is computed for Table I.

use std::f64::consts::PI;

use bouncing_disk::core::Phase;
use bouncing_disk::core::numerics::elementary::{acos, asin, hypot, tan};
use bouncing_disk::{LaunchSpeeds, Platform, Stroke, System};

use super::data::{Alike, Arc, AtSeparation, ComputedEntries, Row, Table1Data};
use crate::catalogue;
use crate::experiment::ExperimentError;
use crate::figures::hand_path::HandPath;
use crate::figures::printed_inputs::{DRAWN, agreement, draws};
use crate::figures::toss_case::TossCase;
use crate::figures::uncertainty::Propagated;
use crate::paper::{self, SectionThree, TableOne, Uncertain};

/// Pieces of a period of the hand's path; its ends are among their ends.
const PIECES: u32 = 400;
pub(super) fn compute() -> Result<Table1Data, ExperimentError> {
    let table_i = paper::table_one()?;
    let section = paper::section_three()?;
    let slip_slope_deg = slip_slope()?;
    let computed_entries = computed_entries(&table_i, &section, slip_slope_deg)?;
    let uncorrected = computed_entries.angular_frequency_rad_per_s.value;
    let separation = at_separation(&table_i, &section, uncorrected)?;
    let rows = rows(&table_i, &computed_entries, &separation)?;
    let case = TossCase::from(&table_i);
    let system = case.system()?;
    let platform = system.platform();
    Ok(Table1Data {
        arc: arc(&case, platform)?,
        alike: alike(slip_slope_deg.uncertainty)?,
        table_i,
        section,
        slip_slope_deg,
        rows,
        computed_entries,
        separation,
    })
}

fn slip_slope() -> Result<Uncertain, ExperimentError> {
    let key = "section3.slip_slope";
    let printed = catalogue::number(key, 0)?;
    Ok(Uncertain { value: printed.value, uncertainty: printed.uncertainty.unwrap_or_default() })
}

fn computed_entries(
    table: &TableOne,
    section: &SectionThree,
    slip_slope_deg: Uncertain,
) -> Result<ComputedEntries, ExperimentError> {
    let inputs = launch(table, section);
    Ok(ComputedEntries {
        angular_frequency_rad_per_s: Propagated::of(inputs, |at| {
            stroke(at).map(|stroke| stroke.angular_frequency)
        })?,
        amplitude_angle_rad: Propagated::of(inputs, |at| stroke(at).map(|stroke| stroke.amplitude_angle))?,
        friction: Propagated::of([slip_slope_deg], |[slope]| {
            Ok::<_, ExperimentError>(tan(PI / 180.0 * slope))
        })?,
    })
}

/// Seed of the inputs that print alike.
pub(super) const SEED: u64 = 1;

/// The computed entries over inputs that all round to the printed ones.
fn alike(uncertainty_deg: f64) -> Result<Alike, ExperimentError> {
    let launch = [
        ("section3.launch_speed", 0),
        ("section3.launch_angular_speed", 0),
        ("table1.stroke", 0),
        ("table1.contact_radius", 0),
    ];
    let strokes = draws(launch, DRAWN, SEED)?.into_iter().map(stroke).collect::<Result<Vec<_>, _>>()?;
    let slopes = draws([("section3.slip_slope", 0)], DRAWN, SEED)?;
    let tangent = |slope: f64| tan(PI / 180.0 * slope);
    // Both ends of the slope's range are printed to whole degrees.
    let half_width =
        |[slope]: &[f64; 1]| 0.5 * (tangent(slope + uncertainty_deg) - tangent(slope - uncertainty_deg));
    Ok(Alike {
        angular_frequency: agreement(
            "table1.angular_frequency",
            strokes.iter().map(|stroke| stroke.angular_frequency),
        )?,
        amplitude_angle: agreement(
            "table1.amplitude_angle",
            strokes.iter().map(|stroke| stroke.amplitude_angle),
        )?,
        friction: agreement("table1.friction", slopes.iter().map(|[slope]| tangent(*slope)))?,
        friction_uncertainty: agreement("table1.friction_uncertainty", slopes.iter().map(half_width))?,
    })
}

/// The inputs of Eq. (14): both launch speeds, c and a_e.
fn launch(table: &TableOne, section: &SectionThree) -> [Uncertain; 4] {
    [
        section.launch_speed_m_per_s,
        section.launch_angular_speed_rad_per_s,
        table.stroke_m,
        table.contact_radius_m,
    ]
}

fn stroke(
    [axial_speed, angular_speed, stroke, contact_radius]: [f64; 4],
) -> Result<Stroke, bouncing_disk::Error> {
    Stroke::from_launch_speeds(LaunchSpeeds { axial_speed, angular_speed, stroke, contact_radius })
}

fn at_separation(
    table: &TableOne,
    section: &SectionThree,
    uncorrected: f64,
) -> Result<AtSeparation, ExperimentError> {
    let system = TossCase::from(table).system()?;
    let platform = system.platform();
    let phase = separation(&system)?;
    let gravity = table.preload_acceleration_m_per_s2;
    let corrected = Propagated::of(launch(table, section), |at| {
        let stroke = stroke(at)?;
        let amplitude = Platform::from_stroke(stroke)?.amplitude();
        // ω² cos² τ_sep = ω_14² with sin τ_sep = g/(A ω²): a quadratic equation for ω².
        let (square, acceleration) =
            (stroke.angular_frequency * stroke.angular_frequency, gravity / amplitude);
        Ok((0.5 * square + hypot(0.5 * square, acceleration)).sqrt())
    })
    .map_err(|error: bouncing_disk::Error| ExperimentError::model(error))?;
    Ok(AtSeparation {
        speed_share: phase.cos(),
        axial_speed_m_per_s: platform.velocity(phase),
        angular_speed_rad_per_s: platform.angular_speed(phase),
        largest_axial_speed_m_per_s: platform.amplitude() * platform.angular_frequency(),
        largest_angular_speed_rad_per_s: platform.peak_angular_speed(),
        angular_frequency_change: corrected.value / uncorrected - 1.0,
        corrected_angular_frequency_rad_per_s: corrected,
    })
}

fn separation(system: &System) -> Result<Phase, ExperimentError> {
    system.dimensionless().map().vibration().separation_phase().ok_or_else(|| {
        ExperimentError::model(bouncing_disk::Error::NeverLeaves {
            peak_acceleration: system.peak_acceleration(),
        })
    })
}

fn arc(case: &TossCase, platform: &Platform) -> Result<Arc, ExperimentError> {
    let path = HandPath::new(platform, PIECES)?;
    let per_period_m = path.length(case.contact_radius_m);
    Ok(Arc {
        // There and back.
        length_m: 0.5 * per_period_m,
        half_m: hypot(platform.amplitude(), case.contact_radius_m * platform.twist_amplitude()),
        per_period_m,
    })
}

/// What a row computes from the hand and the dough of Table I.
type Quantity = fn(&TossCase, &System) -> f64;

/// Symbol, label, unit, decimals, origin and formula of the quantities that follow from Table I.
type Following = (&'static str, &'static str, &'static str, usize, &'static str, Quantity);

const FOLLOWING: [Following; 10] = [
    ("A", "$A$", "m", 3, r"$c$ cos $\phi_L$, Eq. (13)", |_, system| system.platform().amplitude()),
    ("a_e Φ", r"$a_e \Phi$", "m", 3, r"$c$ sin $\phi_L$, Eq. (13)", |case, system| {
        case.contact_radius_m * system.platform().twist_amplitude()
    }),
    ("L", "$L$", "", 2, r"tan $\phi_L$", |case, _| tan(case.amplitude_angle_rad)),
    ("Φ", r"$\Phi$", "rad", 2, r"$c$ sin $\phi_L/a_e$", |_, system| system.platform().twist_amplitude()),
    ("ωΦ", r"$\omega \Phi$", "rad/s", 1, r"$c \omega$ sin $\phi_L/a_e$", |_, system| {
        system.platform().peak_angular_speed()
    }),
    ("Aω", r"$A \omega$", "m/s", 2, r"$c \omega$ cos $\phi_L$", |_, system| {
        system.platform().amplitude() * system.platform().angular_frequency()
    }),
    ("Γ", r"$\Gamma$", "", 2, r"$A \omega^2/\pi g$", |_, system| system.axial_forcing()),
    ("Γ_T", r"$\Gamma_T$", "", 2, r"$a_g^2 \Phi \omega^2/(a_e \pi g \mu)$", |_, system| {
        system.angular_forcing().unwrap_or(f64::INFINITY)
    }),
    ("τ_sep", r"$\tau_{sep}$", "rad", 3, r"$\arcsin(1/\pi \Gamma)$, Eq. (15)", |_, system| {
        asin(1.0 / system.peak_acceleration())
    }),
    ("largest φ_L", r"largest $\phi_L$", "rad", 3, r"$\arccos(g/c \omega^2)$", |case, _| {
        acos(1.0 / case.stroke_acceleration())
    }),
];

fn rows(
    table: &TableOne,
    entries: &ComputedEntries,
    separation: &AtSeparation,
) -> Result<Vec<Row>, ExperimentError> {
    let printed =
        |symbol: &str, label: &str, unit: &str, name: &str, origin: &str| -> Result<Row, ExperimentError> {
            Ok(Row {
                symbol: symbol.to_owned(),
                label: label.to_owned(),
                unit: unit.to_owned(),
                printed: Some(catalogue::text(&format!("table1.{name}"))?.to_owned()),
                computed: None,
                uncertainty: None,
                decimals: 0,
                origin: origin.to_owned(),
            })
        };
    let with = |row: Row, computed: Propagated, decimals: usize| Row {
        computed: Some(computed.value),
        uncertainty: Some(computed),
        decimals,
        ..row
    };
    let mut rows = vec![
        printed("θ", r"$\theta$", "rad", "phase_lag", "video")?,
        with(
            printed("φ_L", r"$\phi_L$", "rad", "amplitude_angle", r"launch speeds, $a_e$; Eq. (14)")?,
            entries.amplitude_angle_rad,
            3,
        ),
        printed("c", "$c$", "m", "stroke", "video")?,
        with(
            printed("ω", r"$\omega$", "rad/s", "angular_frequency", r"launch speeds, $c$, $a_e$; Eq. (14)")?,
            entries.angular_frequency_rad_per_s,
            2,
        ),
        Row {
            symbol: "ω with cos τ_sep".to_owned(),
            label: r"$\omega$ with cos $\tau_{sep}$".to_owned(),
            unit: "rad/s".to_owned(),
            printed: None,
            computed: Some(separation.corrected_angular_frequency_rad_per_s.value),
            uncertainty: Some(separation.corrected_angular_frequency_rad_per_s),
            decimals: 2,
            origin: r"the same, speeds taken at $\tau_{sep}$".to_owned(),
        },
        printed("a_e", "$a_e$", "m", "contact_radius", "video")?,
        printed("a_g", "$a_g$", "m", "gyration_radius", "video")?,
        with(printed("μ", r"$\mu$", "", "friction", "tangent of the slope of slip")?, entries.friction, 2),
        printed("g", "$g$", "m/s²", "preload_acceleration", "gravity")?,
    ];
    let case = TossCase::from(table);
    let system = case.system()?;
    for (symbol, label, unit, decimals, origin, quantity) in FOLLOWING {
        rows.push(following(symbol, label, unit, decimals, origin, quantity(&case, &system)));
    }
    let fastest = r"$\tau_{\mathit{max}|\dot{\beta}|}$";
    // Subtracted from zero: minus zero would be shown with its sign.
    rows.push(following(
        "τ_max",
        fastest,
        "rad",
        0,
        r"$-\theta + n\pi$, Eq. (15)",
        0.0 - table.phase_lag_rad,
    ));
    Ok(rows)
}

fn following(symbol: &str, label: &str, unit: &str, decimals: usize, origin: &str, computed: f64) -> Row {
    Row {
        symbol: symbol.to_owned(),
        label: label.to_owned(),
        unit: unit.to_owned(),
        printed: None,
        computed: Some(computed),
        uncertainty: None,
        decimals,
        origin: origin.to_owned(),
    }
}
