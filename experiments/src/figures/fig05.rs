//! Fig. 5: hand motions and the dough's motion in single tosses.

mod claims;
mod compute;
mod data;
mod draw;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

pub use self::data::Fig05Data;
use crate::claims::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;
use crate::table::{Cell, Table};

/// Fig. 5.
#[derive(Debug)]
pub struct Fig05;

impl Experiment for Fig05 {
    type Data = Fig05Data;

    const ID: &'static str = "fig05";

    const TITLE: &'static str = "Hand motions and the resulting dough trajectories";
    const DISCUSSION: &str = include_str!("fig05/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn caption(data: &Fig05Data) -> String {
        format!(
            "Details of various hand motions (dashed curves) and the resulting dough trajectories (solid curves): height, \
             angle and angular speed in single tosses with Table I's parameters, for the amplitude ratios φ_L = {}. Two phase \
             lags, θ_1 = 0 (blue) and θ_2 = π/2 (vermilion), which have the same heights. Time runs from the hand's lowest point, \
             where the dough is at rest; shaded: dough and hand in contact, up to the separation at t_sep, at the phase τ_sep = ωt_sep − π/2. Heights are \
             shown up to the landing, angles and speeds in and after the contact. The effects of a suboptimal φ_L are seen \
             in the speeds at θ_1: slip at the separation at high φ_L, a low hand speed ωΦ at low φ_L.",
            data.columns.iter().map(|column| column.printed.as_str()).collect::<Vec<_>>().join(", ")
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig05Data, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &Fig05Data) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &Fig05Data) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &Fig05Data) -> Vec<(String, String)> {
        let table = &data.table_i;
        let angles: Vec<_> = data.columns.iter().map(|column| column.printed.as_str()).collect();
        let lags = data.columns.first().map_or(String::new(), |column| {
            column.tosses.iter().map(|toss| claims::pi(toss.phase_lag_rad)).collect::<Vec<_>>().join(", ")
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

    fn table(data: &Fig05Data) -> Option<Table> {
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
        Some(table)
    }
}
