//! What the paper says about Fig. 5, compared with the data.

use std::f64::consts::PI;

use super::Fig05Data;
use super::data::{Column, Toss};
use crate::claim::Claim;
use crate::table::{Cell, Table};

const ID: &str = "fig05";
const PLACE: &str = "Sec. III B";
/// The share of the hand's speed that a dough in a firm grip may lack.
const NEARLY_NOTHING: f64 = 0.01;
/// The hand's speed at the lowest point, cos(3π/2 + θ), is known to this share of the largest one.
const ROUNDING: f64 = 100.0 * f64::EPSILON;

fn pi(angle: f64) -> String {
    format!("{:.3}π", angle / PI)
}

/// The toss at θ_1 of a column.
fn first(column: &Column) -> Option<&Toss> {
    column.tosses.first()
}

/// A quantity of the tosses at θ_1, by column, as text.
fn listed(data: &Fig05Data, value: impl Fn(&Column, &Toss) -> String) -> String {
    let parts = data.columns.iter().filter_map(|column| {
        first(column).map(|toss| format!("φ_L = {}: {}", column.printed, value(column, toss)))
    });
    parts.collect::<Vec<_>>().join("; ")
}

fn values(data: &Fig05Data, value: impl Fn(&Column, &Toss) -> f64) -> Vec<f64> {
    data.columns.iter().filter_map(|column| first(column).map(|toss| value(column, toss))).collect()
}

fn rises(values: &[f64]) -> bool {
    values.windows(2).all(|pair| pair[0] < pair[1])
}

fn falls(values: &[f64]) -> bool {
    values.windows(2).all(|pair| pair[0] > pair[1])
}

pub(super) fn caption(data: &Fig05Data) -> String {
    format!(
        "Details of various hand motions (dashed curves) and the resulting dough trajectories (solid curves): height, \
         angle and angular speed in single tosses with Table I's parameters, for the amplitude ratios φ_L = {}. Two phase \
         lags, θ_1 = 0 (blue) and θ_2 = π/2 (vermilion), which have the same heights. Time runs from the hand's lowest point, \
         where the dough is at rest; shaded: dough and hand in contact, up to the phase of separation τ_sep. Heights are \
         shown up to the landing, angles and speeds in and after the contact. The effects of a suboptimal φ_L are seen \
         in the speeds at θ_1: slip at the separation at high φ_L, a low hand speed ωΦ at low φ_L.",
        data.columns.iter().map(|column| column.printed.as_str()).collect::<Vec<_>>().join(", ")
    )
}

pub(super) fn parameters(data: &Fig05Data) -> Vec<(String, String)> {
    let table = &data.table_i;
    let angles: Vec<_> = data.columns.iter().map(|column| column.printed.as_str()).collect();
    let lags = data.columns.first().map_or(String::new(), |column| {
        column.tosses.iter().map(|toss| pi(toss.phase_lag_rad)).collect::<Vec<_>>().join(", ")
    });
    [
        ("amplitude angle φ_L", angles.join(", ")),
        ("phase lag θ", lags),
        ("stroke c", format!("{} m", table.stroke_m.value)),
        ("angular frequency ω", format!("{} rad/s", table.angular_frequency_rad_per_s.value)),
        ("contact radius a_e", format!("{} m", table.contact_radius_m.value)),
        ("radius of gyration a_g", format!("{} m", table.gyration_radius_m.value)),
        ("friction μ", table.friction.value.to_string()),
        ("gravity g", format!("{} m/s²", table.preload_acceleration_m_per_s2)),
        ("start", "lowest point of the hand, τ = 3π/2; dough at rest".to_owned()),
    ]
    .map(|(name, value)| (name.to_owned(), value))
    .to_vec()
}

pub(super) fn table(data: &Fig05Data) -> Table {
    let mut table = Table::new([
        "phi_L (rad)",
        "theta (rad)",
        "separation phase (rad)",
        "largest hand speed (rad/s)",
        "hand speed at separation (rad/s)",
        "airborne speed (rad/s)",
        "slip at separation (rad/s)",
        "sliding share of contact time",
        "apex above mean height of hand (m)",
        "landing time (s)",
    ]);
    for column in &data.columns {
        for toss in &column.tosses {
            table.push([
                Cell::from(column.amplitude_angle_rad),
                toss.phase_lag_rad.into(),
                toss.separation_phase_rad.into(),
                toss.largest_hand_speed_rad_per_s.into(),
                toss.hand_speed_at_separation_rad_per_s.into(),
                toss.airborne_speed_rad_per_s.into(),
                toss.slip_at_separation_rad_per_s.into(),
                toss.sliding_share_of_contact.into(),
                toss.apex_height_m.into(),
                toss.landing_time_s.into(),
            ]);
        }
    }
    table
}

pub(super) fn claims(data: &Fig05Data) -> Vec<Claim> {
    let mut claims = amplitude_ratio(data);
    claims.extend(limits(data));
    claims.extend(phase_lag(data));
    claims
}

/// What φ_L does.
fn amplitude_ratio(data: &Fig05Data) -> Vec<Claim> {
    let slip_share =
        |_: &Column, toss: &Toss| toss.slip_at_separation_rad_per_s / toss.hand_speed_at_separation_rad_per_s;
    let slips = values(data, slip_share);
    let hand = values(data, |column, _| column.largest_hand_speed_rad_per_s);
    let force = values(data, |column, _| column.peak_acceleration);
    let height = values(data, |_, toss| toss.apex_height_m);
    let speed = values(data, |_, toss| toss.airborne_speed_rad_per_s);
    vec![
        Claim::statement(
            ID,
            "Fig. 5 caption",
            "the dough slips at the separation at high φ_L",
            data.columns.last().and_then(first).is_some_and(|toss| toss.sliding_at_separation) && rises(&slips),
            listed(data, |column, toss| {
                format!(
                    "{} at the separation, {:.2} rad/s or {:.1} % behind the hand, sliding for {:.0} % of the contact",
                    if toss.sliding_at_separation { "slides" } else { "sticks" },
                    toss.slip_at_separation_rad_per_s,
                    100.0 * slip_share(column, toss),
                    100.0 * toss.sliding_share_of_contact
                )
            }),
        ),
        Claim::statement(
            ID,
            "Fig. 5 caption",
            "the hand's rotation rate ωΦ is low at low φ_L",
            rises(&hand),
            listed(data, |column, toss| {
                format!(
                    "ωΦ = {:.2} rad/s, airborne speed {:.2} rad/s",
                    column.largest_hand_speed_rad_per_s, toss.airborne_speed_rad_per_s
                )
            }),
        ),
        Claim::statement(
            ID,
            PLACE,
            "φ_L → π/2 raises ωΦ and lowers the normal contact force, so that the dough slides at τ_sep",
            rises(&hand) && falls(&force),
            listed(data, |column, _| {
                format!(
                    "ωΦ = {:.2} rad/s, largest contact force {:.2} m g",
                    column.largest_hand_speed_rad_per_s,
                    1.0 + column.peak_acceleration
                )
            }),
        ),
        Claim::statement(
            ID,
            PLACE,
            "of the three tosses at θ = 0 that with φ_L = 0.323π is the fastest, a compromise between slip and ωΦ",
            matches!(speed[..], [low, best, high] if best > low && best > high),
            listed(data, |_, toss| format!("airborne speed {:.2} rad/s", toss.airborne_speed_rad_per_s)),
        )
        .note("the largest speed of Table I's tosses is at another φ_L, see fig04"),
        Claim::statement(
            ID,
            PLACE,
            "a smaller φ_L gives a greater toss height",
            falls(&height),
            listed(data, |_, toss| format!("apex {:.3} m above the hand's mean height", toss.apex_height_m)),
        ),
    ]
}

/// Enough force and friction, and the phase of separation.
fn limits(data: &Fig05Data) -> Vec<Claim> {
    let shares =
        |missing: &[f64]| missing.iter().map(|share| format!("{share:.1e}")).collect::<Vec<_>>().join(", ");
    let grips: Vec<_> = data
        .firm_grip
        .iter()
        .map(|grip| format!("μ = {}: {}", grip.friction, shares(&grip.missing_share)))
        .collect();
    let converge = (0..data.columns.len()).all(|column| {
        let missing: Vec<f64> = data
            .firm_grip
            .iter()
            .filter_map(|grip| grip.missing_share.get(column))
            .map(|share| share.abs())
            .collect();
        falls(&missing[1..]) && missing.last().is_some_and(|last| *last < NEARLY_NOTHING)
    });
    let separation = data
        .columns
        .iter()
        .filter_map(|column| {
            let toss = first(column)?;
            let formula = bouncing_disk::core::elementary::asin(1.0 / column.peak_acceleration);
            Some((toss.separation_phase_rad - formula).abs())
        })
        .fold(0.0, f64::max);
    vec![
        Claim::statement(
            ID,
            PLACE,
            "with sufficient contact force and friction the airborne speed is the hand's speed at the separation",
            converge,
            format!(
                "share of the hand's speed at τ_sep that the dough lacks (negative: it is ahead), for the three φ_L at \
                 θ = 0: {}; it vanishes as μ grows. Just before τ_sep it always slides, since N falls to zero",
                grips.join("; ")
            ),
        ),
        Claim::statement(
            ID,
            "Eq. (15)",
            "τ_sep = arcsin(1/πΓ)",
            separation <= 8.0 * f64::EPSILON,
            format!(
                "largest difference from the engine's separations: {separation:.1e} rad; {}",
                listed(data, |_, toss| format!("τ_sep = {}", pi(toss.separation_phase_rad)))
            ),
        ),
    ]
}

/// What θ does.
fn phase_lag(data: &Fig05Data) -> Vec<Claim> {
    let pairs: Vec<_> = data
        .columns
        .iter()
        .filter_map(|column| match &column.tosses[..] {
            [one, two] => Some((column, one, two)),
            _ => None,
        })
        .collect();
    let slower =
        pairs.iter().all(|(_, one, two)| two.airborne_speed_rad_per_s < one.airborne_speed_rad_per_s);
    let lags = &data.lags;
    let at_zero = lags.iter().find(|lag| lag.phase_lag_rad == 0.0);
    let positive_lag = at_zero.is_some_and(|zero| {
        lags.iter()
            .filter(|lag| lag.phase_lag_rad > 0.0)
            .all(|lag| lag.late_gain_rad_per_s < zero.late_gain_rad_per_s)
    });
    let at_rest =
        ROUNDING * pairs.iter().map(|(_, one, _)| one.largest_hand_speed_rad_per_s).fold(0.0, f64::max);
    let negative_lag =
        lags.iter().all(|lag| (lag.phase_lag_rad < 0.0) == (lag.lowest_speed_rad_per_s < -at_rest));
    let described = |value: &dyn Fn(&super::data::Dependence) -> f64| {
        lags.iter()
            .map(|lag| format!("θ = {}: {:.2}", pi(lag.phase_lag_rad), value(lag)))
            .collect::<Vec<_>>()
            .join("; ")
    };
    vec![
        Claim::statement(
            ID,
            "Fig. 5",
            "the toss at θ_2 = π/2 is slower than that at θ_1 = 0 at each of the three φ_L",
            slower,
            pairs
                .iter()
                .map(|(column, one, two)| {
                    format!(
                        "φ_L = {}: {:.2} and {:.2} rad/s",
                        column.printed, one.airborne_speed_rad_per_s, two.airborne_speed_rad_per_s
                    )
                })
                .collect::<Vec<_>>()
                .join("; "),
        ),
        Claim::statement(
            ID,
            PLACE,
            "for θ > 0 the torque is reduced as the separation approaches",
            positive_lag,
            format!(
                "speed gained in the second half of the contact (rad/s), φ_L = 0.323π: {}",
                described(&|lag| lag.late_gain_rad_per_s)
            ),
        ),
        Claim::statement(
            ID,
            PLACE,
            "for θ < 0 there is reverse torque at τ_0",
            negative_lag,
            format!(
                "the dough starts at rest; its lowest speed in contact (rad/s), φ_L = 0.323π: {}",
                described(&|lag| lag.lowest_speed_rad_per_s)
            ),
        ),
    ]
}
