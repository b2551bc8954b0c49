//! The data of the figure.

use std::f64::consts::PI;

use bouncing_disk::{Stroke, TossDesign, TossRobustness};
use serde::{Deserialize, Serialize};

/// The data of the best tosses.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraDesignData {
    /// Stroke c of all hand motions (m).
    pub(super) stroke_m: f64,
    /// Least and most friction that every hand motion is judged at.
    pub(super) friction: [f64; 2],
    pub(super) curves: Vec<Curve>,
    /// The hand of Table I, its airborne speed at its own friction, and over the range.
    pub(super) table_one: Stroke,
    pub(super) table_one_speed_rad_per_s: f64,
    pub(super) table_one_worst_rad_per_s: f64,
    /// The best hand at the frequency and friction of Table I.
    pub(super) at_table_one: TossDesign,
    pub(super) random: Random,
}

/// The best hand motions over the frequency, under one limit of height.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Curve {
    /// The limit (m); `None` for none.
    pub(super) highest_flight_m: Option<f64>,
    pub(super) points: Vec<Best>,
}

/// The best hand motion at one frequency, and what is left of it.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Best {
    pub(super) design: TossDesign,
    pub(super) robustness: TossRobustness,
}

/// Hand motions drawn at random, at the frequency and friction of Table I.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Random {
    pub(super) tried: usize,
    pub(super) leaving: usize,
    /// The largest airborne speed among them (rad/s).
    pub(super) best_rad_per_s: f64,
}

impl ExtraDesignData {
    pub(super) fn caption(&self) -> String {
        let limits: Vec<String> = self
            .curves
            .iter()
            .map(|curve| curve.highest_flight_m.map_or("none".to_owned(), |height| format!("{height} m")))
            .collect();
        format!(
            "The best hand motion for the dough of Table I with its stroke of {} m, at each frequency: the largest airborne speed that it \
             gives at every friction from {} to {}, with the flight limited in height ({}). (a) That speed; bands: its least and most over \
             everything that rounds to the same digits; circle: the hand of Table I, over the same range of friction. (b) Amplitude \
             angle, where 0 is a vertical motion and 1/2 a rotary one, and (c) phase lag of the best hand.",
            self.stroke_m,
            self.friction[0],
            self.friction[1],
            limits.join(", "),
        )
    }

    pub(super) fn parameters(&self) -> Vec<(String, String)> {
        let hand = &self.table_one;
        [
            ("stroke c", format!("{} m", self.stroke_m)),
            ("friction", format!("{} to {}", self.friction[0], self.friction[1])),
            ("ω of Table I", format!("{:.4} rad/s", hand.angular_frequency)),
            ("amplitude angle of Table I", format!("{:.4}π", hand.amplitude_angle / PI)),
            ("phase lag of Table I", format!("{} rad", hand.phase_lag)),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .into()
    }
}
