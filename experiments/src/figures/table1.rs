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
use super::shared::inputs::{Input, toss, with_unit};
use super::shared::numbers::Propagated;
use super::shared::toss::TossCase;
use crate::claims::paper::{self, SectionThree, TableOne, Uncertain};
use crate::claims::{Cases, Claim};
use crate::experiment::{ExperimentError, Paper};

/// Seed of the inputs that print alike.
const SEED: u64 = 1;

/// Table I.
pub(crate) fn table1(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    fig.seed("launches and slopes that print alike", SEED);
    let (table_i, section) = (paper::table_one()?, paper::section_three()?);
    let case = TossCase::from(&table_i);
    let system = case.system()?;

    // The entries that the paper computes from measurements, and from all measurements that print alike.
    let inputs = launch(&table_i, &section);
    let frequency = Propagated::of(inputs, |at| stroke(at).map(|stroke| stroke.angular_frequency))?;
    let angle = Propagated::of(inputs, |at| stroke(at).map(|stroke| stroke.amplitude_angle))?;
    let slope = paper::uncertain("section3.slip_slope", 0)?;
    let tangent = |degrees: f64| tan(PI / 180.0 * degrees);
    let friction = Propagated::of([slope], |[slope]| Ok::<_, ExperimentError>(tangent(slope)))?;
    let launches = [
        ("section3.launch_speed", 0),
        ("section3.launch_angular_speed", 0),
        ("table1.stroke", 0),
        ("table1.contact_radius", 0),
    ];
    let strokes = draws(launches, DRAWN, SEED)?.into_iter().map(stroke).collect::<Result<Vec<_>, _>>()?;
    let slopes = draws([("section3.slip_slope", 0)], DRAWN, SEED)?;
    // Both ends of the slope's range are printed to whole degrees.
    let half_width =
        |[at]: &[f64; 1]| 0.5 * (tangent(at + slope.uncertainty) - tangent(at - slope.uncertainty));
    let alike = Alike {
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
    };
    fig.claim(over_alike("table1.amplitude_angle", angle.value, alike.amplitude_angle));
    fig.claim(combined("table1.amplitude_angle_uncertainty", &angle, "a_e and the launch speeds"));
    fig.claim(over_alike("table1.angular_frequency", frequency.value, alike.angular_frequency));
    fig.claim(combined("table1.angular_frequency_uncertainty", &frequency, "c, a_e and the launch speeds"));
    fig.claim(
        over_alike("table1.friction", friction.value, alike.friction).note(format!("tan({}°)", slope.value)),
    );
    fig.claim(
        over_alike("table1.friction_uncertainty", friction.sum, alike.friction_uncertainty)
            .note(format!("half the difference of the tangents at the ends of {slope}°")),
    );

    let arc = arc(&case, system.platform())?;
    fig.claim(
        Claim::printed_statement(
            "section3.arc_length",
            (arc.length_m / arc.half_m - 1.0).abs() <= LENGTH,
            format!(
                "from end to end the path is {:.4} m long; sqrt(A² + (a_e Φ)²) = {:.4} m is its half, from the middle to an end",
                arc.length_m, arc.half_m,
            ),
        )
        .cause("half the arc called the arc"),
    );
    let separation = at_separation(&table_i, &section, &system, frequency.value)?;
    fig.claim(launch_without_slip(&separation));

    fig.caption(format!(
        "The single toss as printed, the entries that the paper computes (φ_L, ω, μ) recomputed, and the \
         quantities that follow from the printed entries. Uncertainties are sums of the effects of the inputs of \
         a row, each half the difference of both ends. Eq. (14) takes the hand's largest speeds for those at \
         separation; with the factor cos τ_sep that it leaves out, ω is {:.2} rad/s.",
        separation.corrected_angular_frequency_rad_per_s.value
    ));
    fig.parameter("launch speed", format!("{} m/s", section.launch_speed_m_per_s));
    fig.parameter("launch angular speed", format!("{} rad/s", section.launch_angular_speed_rad_per_s));
    fig.parameter("slope of slip", format!("{slope}°"));
    for input in [toss::STROKE, toss::CONTACT_RADIUS, toss::GYRATION_RADIUS] {
        fig.parameter(input.symbol, with_unit(&paper::uncertain(&input.key(), 0)?.to_string(), input.unit));
    }
    fig.parameters([toss::PRELOAD_ACCELERATION.row(&case)]);

    let corrected = separation.corrected_angular_frequency_rad_per_s;
    let mut rows = vec![
        Row::printed(toss::PHASE_LAG, "video")?,
        Row::printed(toss::AMPLITUDE_ANGLE, r"launch speeds, $a_e$; Eq. (14)")?.with(angle, 3),
        Row::printed(toss::STROKE, "video")?,
        Row::printed(toss::ANGULAR_FREQUENCY, r"launch speeds, $c$, $a_e$; Eq. (14)")?.with(frequency, 2),
        Row::following((
            r"$\omega$ with cos $\tau_{sep}$",
            "rad/s",
            2,
            r"the same, speeds taken at $\tau_{sep}$",
            corrected.value,
        ))
        .with(corrected, 2),
        Row::printed(toss::CONTACT_RADIUS, "video")?,
        Row::printed(toss::GYRATION_RADIUS, "video")?,
        Row::printed(toss::FRICTION, "tangent of the slope of slip")?.with(friction, 2),
        Row::printed(toss::PRELOAD_ACCELERATION, "gravity")?,
    ];
    rows.extend(following(&case, &system).map(Row::following));
    fig.draw(draw(&rows));
    fig.record("table_i", &table_i)?;
    fig.record("section", &section)?;
    fig.record("slip_slope_deg", &slope)?;
    fig.record("rows", &rows)?;
    fig.record(
        "computed_entries",
        &ComputedEntries { angular_frequency_rad_per_s: frequency, amplitude_angle_rad: angle, friction },
    )?;
    fig.record("separation", &separation)?;
    fig.record("arc", &arc)?;
    fig.record("alike", &alike)
}

/// The entries of Table I that the paper computes from measurements.
#[derive(Debug, Serialize)]
struct ComputedEntries {
    angular_frequency_rad_per_s: Propagated,
    amplitude_angle_rad: Propagated,
    friction: Propagated,
}

/// How many inputs that all print alike give the printed entries.
#[derive(Debug, Serialize)]
struct Alike {
    angular_frequency: Cases,
    amplitude_angle: Cases,
    friction: Cases,
    friction_uncertainty: Cases,
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

/// An entry that the paper computes, judged over inputs that all round to the printed ones.
fn over_alike(key: &str, computed: f64, agreement: Cases) -> Claim {
    Claim::printed(key, computed).judged_over(agreement).note(format!(
        "at the printed inputs; of {} inputs that all round to them {} give the printed number",
        agreement.tried, agreement.holding
    ))
}

/// A printed uncertainty that several inputs share in: the paper does not say how their effects add up.
fn combined(key: &str, computed: &Propagated, inputs: &str) -> Claim {
    let claim = Claim::printed(key, computed.sum);
    let squares = Claim::printed(key, computed.root_sum_of_squares).verdict;
    let note = format!(
        "the root of the sum of their squares is {:.3}; the inputs are {inputs}",
        computed.root_sum_of_squares
    );
    if squares == claim.verdict {
        return claim.note(note);
    }
    claim.fitted("the rule for adding the effects of the inputs, a plain sum").note(note)
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

/// Pieces of a period of the hand's path; its ends are among their ends.
const PIECES: u32 = 400;

fn arc(case: &TossCase, platform: &Platform) -> Result<Arc, ExperimentError> {
    let per_period_m = HandPath::new(platform, PIECES)?.length(case.contact_radius_m);
    Ok(Arc {
        // There and back.
        length_m: 0.5 * per_period_m,
        half_m: hypot(platform.amplitude(), case.contact_radius_m * platform.twist_amplitude()),
        per_period_m,
    })
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

fn at_separation(
    table: &TableOne,
    section: &SectionThree,
    system: &System,
    uncorrected: f64,
) -> Result<AtSeparation, ExperimentError> {
    let platform = system.platform();
    let phase = separation(system)?;
    let gravity = table.preload_acceleration_m_per_s2;
    let corrected = Propagated::of(launch(table, section), |at| {
        let stroke = stroke(at)?;
        let amplitude = Platform::from_stroke(stroke)?.amplitude();
        // ω² cos² τ_sep = ω_14² with sin τ_sep = g/(A ω²): a quadratic equation for ω².
        let (square, acceleration) =
            (stroke.angular_frequency * stroke.angular_frequency, gravity / amplitude);
        Ok::<_, bouncing_disk::Error>((0.5 * square + hypot(0.5 * square, acceleration)).sqrt())
    })?;
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

/// Two speeds that are the same differ by no more than this share: rounding.
const ROUNDING: f64 = 1e-14;
/// A length along a polygon of hundreds of points of a straight line adds as many roundings.
const LENGTH: f64 = 1e-12;

/// Eq. (14) takes the largest speeds of the hand for the speeds at separation.
fn launch_without_slip(separation: &AtSeparation) -> Claim {
    let same = |one: f64, other: f64| (one / other - 1.0).abs() <= ROUNDING;
    Claim::printed_statement(
        "section3.launch_without_slip",
        same(separation.axial_speed_m_per_s, separation.largest_axial_speed_m_per_s)
            && same(separation.angular_speed_rad_per_s, separation.largest_angular_speed_rad_per_s),
        format!(
            "{:.3} m/s and {:.2} rad/s are the hand's largest speeds, at τ = 0; the dough leaves at τ_sep with {:.3} of both. \
             With this factor ω is {:.2} rad/s",
            separation.largest_axial_speed_m_per_s,
            separation.largest_angular_speed_rad_per_s,
            separation.speed_share,
            separation.corrected_angular_frequency_rad_per_s.value,
        ),
    )
    .cause("launch speeds taken at the wrong phase")
}

/// One line of the table.
#[derive(Debug, Default, Serialize)]
struct Row {
    /// The symbol as it is set in print.
    label: &'static str,
    unit: &'static str,
    printed: Option<&'static str>,
    computed: Option<f64>,
    /// Of the entries that are computed from measurements; the inputs of the others are not independent.
    uncertainty: Option<Propagated>,
    /// Decimals in the picture.
    decimals: usize,
    /// The formula or the source, as it is set in print.
    origin: &'static str,
}

impl Row {
    fn printed(input: Input<TossCase>, origin: &'static str) -> Result<Self, ExperimentError> {
        let printed = input.entry()?.printed.as_deref();
        Ok(Self { label: input.label, unit: input.unit, printed, origin, ..Self::default() })
    }

    fn with(self, computed: Propagated, decimals: usize) -> Self {
        Self { computed: Some(computed.value), uncertainty: Some(computed), decimals, ..self }
    }

    fn following((label, unit, decimals, origin, computed): Following) -> Self {
        Self { label, unit, computed: Some(computed), decimals, origin, ..Self::default() }
    }
}

/// Label, unit, decimals, origin and value of a quantity that follows from the entries.
type Following = (&'static str, &'static str, usize, &'static str, f64);

fn following(case: &TossCase, system: &System) -> [Following; 11] {
    let platform = system.platform();
    let rim = case.contact_radius_m * platform.twist_amplitude();
    let axial_speed = platform.amplitude() * platform.angular_frequency();
    let angular_forcing = system.angular_forcing().unwrap_or(f64::INFINITY);
    let fastest = r"$\tau_{\mathit{max}|\dot{\beta}|}$";
    [
        ("$A$", "m", 3, r"$c$ cos $\phi_L$, Eq. (13)", platform.amplitude()),
        (r"$a_e \Phi$", "m", 3, r"$c$ sin $\phi_L$, Eq. (13)", rim),
        ("$L$", "", 2, r"tan $\phi_L$", tan(case.amplitude_angle_rad)),
        (r"$\Phi$", "rad", 2, r"$c$ sin $\phi_L/a_e$", platform.twist_amplitude()),
        (r"$\omega \Phi$", "rad/s", 1, r"$c \omega$ sin $\phi_L/a_e$", platform.peak_angular_speed()),
        (r"$A \omega$", "m/s", 2, r"$c \omega$ cos $\phi_L$", axial_speed),
        (r"$\Gamma$", "", 2, r"$A \omega^2/\pi g$", system.axial_forcing()),
        (r"$\Gamma_T$", "", 2, r"$a_g^2 \Phi \omega^2/(a_e \pi g \mu)$", angular_forcing),
        (
            r"$\tau_{sep}$",
            "rad",
            3,
            r"$\arcsin(1/\pi \Gamma)$, Eq. (15)",
            asin(1.0 / system.peak_acceleration()),
        ),
        (r"largest $\phi_L$", "rad", 3, r"$\arccos(g/c \omega^2)$", acos(1.0 / case.stroke_acceleration())),
        // Subtracted from zero: minus zero would be shown with its sign.
        (fastest, "rad", 0, r"$-\theta + n\pi$, Eq. (15)", 0.0 - case.phase_lag_rad),
    ]
}

fn draw(rows: &[Row]) -> Figure {
    let cells = |row: &Row| {
        let digits = row.decimals;
        let uncertainty = row.uncertainty.map_or_else(String::new, |own| format!(" ± {:.digits$}", own.sum));
        let computed = row.computed.map(|computed| format!("{computed:.digits$}{uncertainty}"));
        let with_unit = |text: &str| Label::plain(&with_unit(text, row.unit));
        vec![
            Label::new(row.label),
            row.printed.map_or_else(|| Label::plain(""), with_unit),
            computed.as_deref().map_or_else(|| Label::plain(""), with_unit),
            Label::new(row.origin),
        ]
    };
    let header = ["", "printed", "computed", "from"].map(Label::new);
    ruled_table(&header, &rows.iter().map(cells).collect::<Vec<_>>())
}
