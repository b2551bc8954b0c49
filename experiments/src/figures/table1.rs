//! Table I: the single toss, what its entries were computed from, and what follows from them.

use std::f64::consts::PI;

use bouncing_disk::core::numerics::elementary::{acos, asin, hypot, tan};
use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::parameters::{LaunchSpeeds, Stroke};
use bouncing_disk::{Platform, System};
use bouncing_disk_plot::{Figure, Label, ruled_table};
use serde::Serialize;

use super::shared::alike::{DRAWN, agreement, draws};
use super::shared::cylinder::HandPath;
use super::shared::numbers::Propagated;
use super::shared::toss::TossCase;
use crate::claims::{
    Cases, Claim, catalogue,
    paper::{self, SectionThree, TableOne, Uncertain},
};
use crate::experiment::{ExperimentError, Paper, named};

/// Table I.
pub(crate) fn table1(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    fig.seed("launches and slopes that print alike", SEED);
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
    let data = &Table1Data {
        arc: arc(&case, platform)?,
        alike: alike(slip_slope_deg.uncertainty)?,
        table_i,
        section,
        slip_slope_deg,
        rows,
        computed_entries,
        separation,
    };
    fig.caption(format!(
        "The single toss as printed, the entries that the paper computes (φ_L, ω, μ) computed again, and the \
         quantities that follow from the printed entries. Uncertainties are sums of the effects of the inputs of \
         a row, each half the difference of both ends. Eq. (14) takes the hand's largest speeds for those at \
         separation; with the factor cos τ_sep that it leaves out, ω is {:.2} rad/s.",
        data.separation.corrected_angular_frequency_rad_per_s.value
    ));
    fig.parameters(parameters(data));
    fig.claims(claims(data));
    fig.draw(draw(data)?);
    fig.data(data)
}

fn parameters(data: &Table1Data) -> Vec<(String, String)> {
    let table = &data.table_i;
    named([
        ("launch speed", format!("{} m/s", data.section.launch_speed_m_per_s)),
        ("launch angular speed", format!("{} rad/s", data.section.launch_angular_speed_rad_per_s)),
        ("slope of slip", format!("{}°", data.slip_slope_deg)),
        ("c", format!("{} m", table.stroke_m)),
        ("a_e", format!("{} m", table.contact_radius_m)),
        ("a_g", format!("{} m", table.gyration_radius_m)),
        ("g", format!("{} m/s²", table.preload_acceleration_m_per_s2)),
    ])
}

fn claims(data: &Table1Data) -> Vec<Claim> {
    let entries = &data.computed_entries;
    let arc = &data.arc;
    let (frequency, angle, friction) =
        ("table1.angular_frequency", "table1.amplitude_angle", "table1.friction");
    vec![
        over_alike(angle, entries.amplitude_angle_rad.value, data.alike.amplitude_angle),
        combined("table1.amplitude_angle_uncertainty", &entries.amplitude_angle_rad)
            .note("the effects of a_e and the launch speeds"),
        over_alike(frequency, entries.angular_frequency_rad_per_s.value, data.alike.angular_frequency),
        combined("table1.angular_frequency_uncertainty", &entries.angular_frequency_rad_per_s)
            .note("the effects of c, a_e and the launch speeds"),
        over_alike(friction, entries.friction.value, data.alike.friction)
            .note(format!("tan({}°)", data.slip_slope_deg.value)),
        over_alike("table1.friction_uncertainty", entries.friction.sum, data.alike.friction_uncertainty)
            .note(format!("half the difference of the tangents at the ends of {}°", data.slip_slope_deg)),
        Claim::printed_statement(
            "section3.arc_length",
            (arc.length_m / arc.half_m - 1.0).abs() <= LENGTH,
            format!(
                "the path of Table I's toss, a straight line on the unrolled cylinder, is {:.4} m long from end to end, {:.4} times \
                 sqrt(A² + (a_e Φ)²) = {:.4} m, which is the distance from its middle to an end; in a period the hand moves {:.4} m. \
                 c is half of the arc",
                arc.length_m,
                arc.length_m / arc.half_m,
                arc.half_m,
                arc.per_period_m
            ),
        )
        .cause("half of the arc called the arc"),
        launch_without_slip(data),
    ]
}

fn draw(data: &Table1Data) -> Result<Figure, ExperimentError> {
    let header = ["", "printed", "computed", "from"].map(Label::new);
    let rows: Vec<Vec<Label>> = data
        .rows
        .iter()
        .map(|row| {
            let unit = if row.unit.is_empty() { String::new() } else { format!(" {}", row.unit) };
            let digits = row.decimals;
            let uncertainty = row
                .uncertainty
                .as_ref()
                .map_or_else(String::new, |uncertainty| format!(" ± {:.digits$}", uncertainty.sum));
            let computed = row
                .computed
                .map_or_else(String::new, |computed| format!("{computed:.digits$}{uncertainty}{unit}"));
            let printed = row.printed.as_ref().map_or_else(String::new, |text| format!("{text}{unit}"));
            vec![
                Label::new(&row.label),
                Label::plain(&printed),
                Label::plain(&computed),
                Label::new(&row.origin),
            ]
        })
        .collect();
    Ok(ruled_table(&header, &rows))
}

/// The data of Table I.
#[derive(Debug, Serialize)]
pub(crate) struct Table1Data {
    table_i: TableOne,
    section: SectionThree,
    slip_slope_deg: Uncertain,
    rows: Vec<Row>,
    computed_entries: ComputedEntries,
    separation: AtSeparation,
    arc: Arc,
    alike: Alike,
}

/// How many inputs that all print alike give the printed entries.
#[derive(Clone, Copy, Debug, Serialize)]
struct Alike {
    angular_frequency: Cases,
    amplitude_angle: Cases,
    friction: Cases,
    friction_uncertainty: Cases,
}

/// The path of a point of the hand at the contact radius in Table I's toss, a straight line on the unrolled
/// cylinder.
#[derive(Debug, Serialize)]
struct Arc {
    /// Its length from one end to the other, along a polygon of points of the path.
    length_m: f64,
    /// From the middle to an end: sqrt(A² + (a_e Φ)²), which the paper calls the arc length.
    half_m: f64,
    /// How far the hand moves in a period.
    per_period_m: f64,
}

/// One line of the table.
#[derive(Debug, Default, Serialize)]
struct Row {
    /// The symbol as it is set in print.
    label: String,
    unit: String,
    printed: Option<String>,
    computed: Option<f64>,
    /// Of the entries that are computed from measurements; the inputs of the others are not independent.
    uncertainty: Option<Propagated>,
    /// Decimals in the picture.
    decimals: usize,
    /// The formula or the source, as it is set in print.
    origin: String,
}

/// The entries of Table I that the paper computes from measurements.
#[derive(Debug, Serialize)]
struct ComputedEntries {
    angular_frequency_rad_per_s: Propagated,
    amplitude_angle_rad: Propagated,
    friction: Propagated,
}

/// The hand of Table I as the dough leaves it, θ = 0, without slip.
#[derive(Debug, Serialize)]
struct AtSeparation {
    /// cos τ_sep: both speeds over their largest values, which Eq. (14) takes instead.
    speed_share: f64,
    axial_speed_m_per_s: f64,
    angular_speed_rad_per_s: f64,
    largest_axial_speed_m_per_s: f64,
    largest_angular_speed_rad_per_s: f64,
    /// The ω that gives the measured speeds at τ_sep.
    corrected_angular_frequency_rad_per_s: Propagated,
    /// It over that of Eq. (14), minus 1.
    angular_frequency_change: f64,
}

/// Pieces of a period of the hand's path; its ends are among their ends.
const PIECES: u32 = 400;

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
const SEED: u64 = 1;

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

/// The computation of a row from the hand and the dough of Table I.
type Quantity = fn(&TossCase, &System) -> f64;

/// Label, unit, decimals, origin and formula of the quantities that follow from Table I.
type Following = (&'static str, &'static str, usize, &'static str, Quantity);

const FOLLOWING: [Following; 10] = [
    ("$A$", "m", 3, r"$c$ cos $\phi_L$, Eq. (13)", |_, system| system.platform().amplitude()),
    (r"$a_e \Phi$", "m", 3, r"$c$ sin $\phi_L$, Eq. (13)", |case, system| {
        case.contact_radius_m * system.platform().twist_amplitude()
    }),
    ("$L$", "", 2, r"tan $\phi_L$", |case, _| tan(case.amplitude_angle_rad)),
    (r"$\Phi$", "rad", 2, r"$c$ sin $\phi_L/a_e$", |_, system| system.platform().twist_amplitude()),
    (r"$\omega \Phi$", "rad/s", 1, r"$c \omega$ sin $\phi_L/a_e$", |_, system| {
        system.platform().peak_angular_speed()
    }),
    (r"$A \omega$", "m/s", 2, r"$c \omega$ cos $\phi_L$", |_, system| {
        system.platform().amplitude() * system.platform().angular_frequency()
    }),
    (r"$\Gamma$", "", 2, r"$A \omega^2/\pi g$", |_, system| system.axial_forcing()),
    (r"$\Gamma_T$", "", 2, r"$a_g^2 \Phi \omega^2/(a_e \pi g \mu)$", |_, system| {
        system.angular_forcing().unwrap_or(f64::INFINITY)
    }),
    (r"$\tau_{sep}$", "rad", 3, r"$\arcsin(1/\pi \Gamma)$, Eq. (15)", |_, system| {
        asin(1.0 / system.peak_acceleration())
    }),
    (r"largest $\phi_L$", "rad", 3, r"$\arccos(g/c \omega^2)$", |case, _| {
        acos(1.0 / case.stroke_acceleration())
    }),
];

fn rows(
    table: &TableOne,
    entries: &ComputedEntries,
    separation: &AtSeparation,
) -> Result<Vec<Row>, ExperimentError> {
    let printed = |label: &str, unit: &str, name: &str, origin: &str| -> Result<Row, ExperimentError> {
        let printed = Some(catalogue::text(&format!("table1.{name}"))?.to_owned());
        Ok(Row {
            label: label.to_owned(),
            unit: unit.to_owned(),
            printed,
            origin: origin.to_owned(),
            ..Row::default()
        })
    };
    let with = |row: Row, computed: Propagated, decimals: usize| Row {
        computed: Some(computed.value),
        uncertainty: Some(computed),
        decimals,
        ..row
    };
    let corrected = separation.corrected_angular_frequency_rad_per_s;
    let at_separation = following(
        r"$\omega$ with cos $\tau_{sep}$",
        "rad/s",
        2,
        r"the same, speeds taken at $\tau_{sep}$",
        corrected.value,
    );
    let mut rows = vec![
        printed(r"$\theta$", "rad", "phase_lag", "video")?,
        with(
            printed(r"$\phi_L$", "rad", "amplitude_angle", r"launch speeds, $a_e$; Eq. (14)")?,
            entries.amplitude_angle_rad,
            3,
        ),
        printed("$c$", "m", "stroke", "video")?,
        with(
            printed(r"$\omega$", "rad/s", "angular_frequency", r"launch speeds, $c$, $a_e$; Eq. (14)")?,
            entries.angular_frequency_rad_per_s,
            2,
        ),
        with(at_separation, corrected, 2),
        printed("$a_e$", "m", "contact_radius", "video")?,
        printed("$a_g$", "m", "gyration_radius", "video")?,
        with(printed(r"$\mu$", "", "friction", "tangent of the slope of slip")?, entries.friction, 2),
        printed("$g$", "m/s²", "preload_acceleration", "gravity")?,
    ];
    let case = TossCase::from(table);
    let system = case.system()?;
    for (label, unit, decimals, origin, quantity) in FOLLOWING {
        rows.push(following(label, unit, decimals, origin, quantity(&case, &system)));
    }
    let fastest = r"$\tau_{\mathit{max}|\dot{\beta}|}$";
    // Subtracted from zero: minus zero would be shown with its sign.
    rows.push(following(fastest, "rad", 0, r"$-\theta + n\pi$, Eq. (15)", 0.0 - table.phase_lag_rad));
    Ok(rows)
}

fn following(label: &str, unit: &str, decimals: usize, origin: &str, computed: f64) -> Row {
    Row {
        label: label.to_owned(),
        unit: unit.to_owned(),
        computed: Some(computed),
        decimals,
        origin: origin.to_owned(),
        ..Row::default()
    }
}

/// Two speeds that are the same differ by no more than this share: rounding.
const ROUNDING: f64 = 1e-14;
/// A length along a polygon of hundreds of points of a straight line adds as many roundings.
const LENGTH: f64 = 1e-12;

/// A printed uncertainty that several inputs share in: the paper does not say how their effects add up.
fn combined(key: &str, computed: &Propagated) -> Claim {
    let claim = Claim::printed(key, computed.sum);
    let squares = Claim::printed(key, computed.root_sum_of_squares).verdict;
    let note = format!(
        "plain sum of the effects; the root of the sum of their squares is {:.3}",
        computed.root_sum_of_squares
    );
    if squares == claim.verdict {
        return claim.note(note);
    }
    claim.fitted("how the effects of the inputs add up, as a plain sum").note(note)
}

/// An entry that the paper computes, judged over inputs that all round to the printed ones.
fn over_alike(key: &str, computed: f64, agreement: Cases) -> Claim {
    Claim::printed(key, computed).judged_over(agreement).note(format!(
        "at the printed inputs; of {} inputs that all round to them {} give the printed number",
        agreement.tried, agreement.holding
    ))
}

/// Eq. (14) takes the largest speeds of the hand for the speeds at separation.
fn launch_without_slip(data: &Table1Data) -> Claim {
    let separation = &data.separation;
    let same = |one: f64, other: f64| (one / other - 1.0).abs() <= ROUNDING;
    Claim::printed_statement(
        "section3.launch_without_slip",
        same(separation.axial_speed_m_per_s, separation.largest_axial_speed_m_per_s)
            && same(separation.angular_speed_rad_per_s, separation.largest_angular_speed_rad_per_s),
        format!(
            "these are the hand's largest speeds, at τ = 0 ({:.3} m/s and {:.2} rad/s for Table I); the dough leaves \
             at τ_sep with {:.3} of both ({:.3} m/s, {:.2} rad/s). With this factor ω is \
             {:.2} instead of {:.2} rad/s",
            separation.largest_axial_speed_m_per_s,
            separation.largest_angular_speed_rad_per_s,
            separation.speed_share,
            separation.axial_speed_m_per_s,
            separation.angular_speed_rad_per_s,
            separation.corrected_angular_frequency_rad_per_s.value,
            data.computed_entries.angular_frequency_rad_per_s.value,
        ),
    )
    .cause("the hand's largest speeds taken for those at separation")
}
