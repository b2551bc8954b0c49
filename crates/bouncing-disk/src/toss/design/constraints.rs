//! The constraints on a hand motion, its objective, and how an optimum is certified.

use std::f64::consts::{FRAC_PI_2, TAU};

use bouncing_disk_core::numerics::elementary::acos;

use crate::error::{Error, check, finite, not_negative, positive};
use crate::parameters::disk::DiskParameters;
use crate::parameters::stroke::Stroke;
use crate::parameters::system::System;
use crate::toss::single::InitialSpin;

/// The objective of a toss.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum TossObjective {
    /// The airborne rotary speed (rad/s), in either direction.
    #[default]
    AirborneSpeed,
    /// The efficiency eta of Sec. III A.
    Efficiency,
    /// Turns of the dough until it is back at the height at which it left the hand, where it is caught.
    TurnsPerToss,
}

/// How the objective is taken over a range of friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum OverFriction {
    /// Its least value, which the hand motion reaches at any friction of the range.
    #[default]
    Worst,
    /// Its mean, each friction of the range as likely as any other.
    Mean,
}

/// The constraints on a hand motion, and its objective.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TossConstraints {
    /// The dough. Its friction is ignored in favour of [`Self::friction`], and so is its restitution.
    pub dough: DiskParameters,
    /// How the dough turns at the start.
    pub initial: InitialSpin,
    /// Stroke c (m), positive: the half length of the path of the hand at the contact radius (Eq. 13).
    pub stroke: f64,
    /// Least and largest coefficient of friction mu, not negative; equal if it is known.
    pub friction: [f64; 2],
    /// Least and largest angular frequency omega (rad/s), positive.
    pub angular_frequency: [f64; 2],
    /// Least and largest phase lag theta (rad), at most 2 pi apart. A lag that is larger by pi turns the
    /// dough as fast the other way, so that half a circle covers all results.
    pub phase_lag: [f64; 2],
    /// The highest that the dough may fly above the place where it leaves the hand (m), positive; `None` for
    /// no limit.
    pub highest_flight: Option<f64>,
    /// The objective.
    pub objective: TossObjective,
    /// How it is taken over the range of friction.
    pub over_friction: OverFriction,
}

impl TossConstraints {
    /// Table I: its dough, its stroke, its friction and its frequency, each as the one value that is printed,
    /// all phase lags, any height, and the largest airborne speed.
    #[must_use]
    pub fn pizza_toss() -> Self {
        let system = System::pizza_toss();
        let (hand, dough) = (Stroke::pizza_toss(), system.disk().parameters());
        Self {
            dough,
            initial: InitialSpin::AbsoluteRest,
            stroke: hand.stroke,
            friction: [dough.friction; 2],
            angular_frequency: [hand.angular_frequency; 2],
            phase_lag: [-FRAC_PI_2, FRAC_PI_2],
            highest_flight: None,
            objective: TossObjective::AirborneSpeed,
            over_friction: OverFriction::Worst,
        }
    }

    pub(crate) fn check(&self) -> Result<(), Error> {
        self.dough.build()?;
        positive("stroke", self.stroke)?;
        let [least, most] = self.friction;
        not_negative("friction (least)", least)?;
        not_negative("friction (most)", most)?;
        check(least <= most, "friction (most)", most, "[friction (least), inf)")?;
        let [least, most] = self.angular_frequency;
        positive("angular_frequency (least)", least)?;
        positive("angular_frequency (most)", most)?;
        check(least <= most, "angular_frequency (most)", most, "[angular_frequency (least), inf)")?;
        let peak_acceleration = self.stroke * most * most / self.gravity();
        let [least, most] = self.phase_lag;
        finite("phase_lag (least)", least)?;
        check(
            (least..=least + TAU).contains(&most),
            "phase_lag (most)",
            most,
            "[phase_lag (least), phase_lag (least) + 2 pi]",
        )?;
        self.highest_flight.map(|height| positive("highest_flight", height)).transpose()?;
        let legal = "(0, inf), with a finite peak acceleration c omega^2/g";
        check(peak_acceleration.is_finite(), "stroke", self.stroke, legal)?;
        if peak_acceleration <= 1.0 { Err(Error::NeverLeaves { peak_acceleration }) } else { Ok(()) }
    }

    pub(crate) const fn gravity(&self) -> f64 {
        self.dough.preload_acceleration
    }

    /// The amplitude angles (rad) at which the dough leaves the hand and flies no higher than allowed
    /// (docs/numerics/design.md, "The hand motions that are allowed"); `None` if it never leaves.
    pub(crate) fn amplitude_angles(&self, angular_frequency: f64) -> Option<[f64; 2]> {
        let (omega, g) = (angular_frequency, self.gravity());
        let lift_off = g / (self.stroke * omega * omega);
        if lift_off >= 1.0 {
            return None;
        }
        let most = acos(lift_off);
        let least = self.highest_flight.map_or(0.0, |height| {
            let amplitude = (2.0 * g * height + g * g / (omega * omega)).sqrt() / omega;
            let share = amplitude / self.stroke;
            if share < 1.0 { acos(share) } else { 0.0 }
        });
        Some([least.min(most), most])
    }
}

/// How far the grid of the search certifies an optimum.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TossCertificate {
    /// The number of hand motions on the grid.
    pub grid_points: usize,
    /// The best value on the grid; that of the refined optimum is at least as good.
    pub best_on_grid: f64,
    /// By how much a better motion that the grid missed could exceed the optimum, at most. The bound assumes
    /// that between two neighbouring points of the grid the objective changes no faster than between these
    /// two, or between either and its next neighbour. It does not include the surroundings of the optimum
    /// itself, up to the next points of the grid. Zero means that the optimum is certain under this
    /// assumption.
    pub hidden_gain: f64,
}
