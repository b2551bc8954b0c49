//! The numbers of Fig. 11.

use bouncing_disk::estimate::Spread;
use serde::Serialize;

use crate::claims::Cases;
use crate::claims::paper::Preloads;
use crate::figures::shared::motor::{MotorCase, MotorStatistics};
use crate::figures::shared::stall::Stall;

/// The data of Fig. 11.
#[derive(Debug, Serialize)]
pub(crate) struct Fig11Data {
    pub(super) motor: MotorCase,
    pub(super) printed: Preloads,
    /// Mass of the rotor, a solid steel ball.
    pub(super) rotor_mass_kg: f64,
    /// Members of an ensemble, by amplitude: the larger the amplitude, the fewer collisions a transient
    /// averages over, and the cheaper it is.
    pub(super) members: [usize; 3],
    pub(super) rises: f64,
    pub(super) relaunch_perturbation: f64,
    pub(super) preload_seed: u64,
    /// By frequency, then amplitude.
    pub(super) curves: Vec<Curve>,
    /// Of each curve.
    pub(super) trends: Vec<Trend>,
    /// The motors on a low-period cycle, of all curves.
    pub(super) holes: Holes,
    /// α̇_ss/t_c over (μ a_e g/a_g²) S(0), the least and the most between the preloads of the trends; without
    /// motors on a low-period cycle.
    pub(super) estimate_over_balance: [f64; 2],
    /// Its mean over these motors.
    pub(super) mean_estimate_over_balance: f64,
    /// The stall of the default motor at the lowest, the middle and the highest preload of the trends, by
    /// frequency.
    pub(super) stalls: Vec<StallAt>,
    /// The default motor at full preload with the printed and with a smaller ωΦ.
    pub(super) reduced_twist: ReducedTwist,
    pub(super) end_of_bouncing: EndOfBouncing,
}

/// One amplitude at one frequency.
#[derive(Debug, Serialize)]
pub(super) struct Curve {
    pub(super) frequency_hz: f64,
    pub(super) amplitude_m: f64,
    pub(super) points: Vec<Point>,
    /// Further motors above the preloads of the trends, which are not drawn: the statements about them shall
    /// rest on enough.
    pub(super) further: Vec<Point>,
}

/// One preload.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Point {
    pub(super) preload_acceleration_m_per_s2: f64,
    pub(super) preload_mn: f64,
    pub(super) axial_forcing: f64,
    pub(super) statistics: MotorStatistics,
    /// S(0): the share of the normal impulse that pushes a rotor held at rest forwards, minus the rest.
    pub(super) net_share_at_rest: f64,
    /// Steady speed (rad/s) of one orbit that nothing perturbs.
    pub(super) single_speed_rad_per_s: f64,
    /// Its α̇_ss/t_c (rad/s²), if its speed settles.
    pub(super) single_stall_rad_per_s2: Option<f64>,
}

/// The stall load at one preload.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct StallAt {
    pub(super) frequency_hz: f64,
    pub(super) preload_mn: f64,
    pub(super) stall: Stall,
}

/// A motor whose stator twists less.
#[derive(Debug, Serialize)]
pub(super) struct ReducedTwist {
    /// ωΦ (rad/s), printed and reduced.
    pub(super) peak_angular_speeds_rad_per_s: [f64; 2],
    pub(super) steady_speeds_rad_per_s: [Spread; 2],
    pub(super) stall_accelerations_rad_per_s2: Option<[Spread; 2]>,
    /// Single orbits that are slower with the reduced one.
    pub(super) slower: Cases,
}

impl Fig11Data {
    /// The range of preloads (mN) of the measured trends.
    pub(super) fn trend_mn(&self) -> [f64; 2] {
        trend_mn(&self.printed)
    }

    /// m a_g² (kg m²), which makes a torque of an angular acceleration.
    pub(super) fn moment_of_inertia(&self) -> f64 {
        self.rotor_mass_kg * self.motor.gyration_radius_m * self.motor.gyration_radius_m
    }
}

/// The range of preloads (mN) of the measured trends.
pub(super) fn trend_mn(printed: &Preloads) -> [f64; 2] {
    printed.measured_range_n.map(|preload| 1e3 * preload)
}

/// One curve: the behaviour of its motors inside the preloads of the measured trends, and beside them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Trend {
    pub(super) frequency_hz: f64,
    pub(super) amplitude_m: f64,
    /// The middle steady speed of all motors inside.
    pub(super) median_speed_rad_per_s: f64,
    /// How many single orbits inside have a speed, a torque or both on the trend. One without a stall torque is off it.
    pub(super) speed: Cases,
    pub(super) torque: Cases,
    pub(super) both: Cases,
    /// How many single orbits above the preload of the measured plateau have a torque nearer to the trend
    /// than to that plateau.
    pub(super) no_plateau: Cases,
    /// Exponents of speed and torque inside, of all motors that have them: the median over all pairs of
    /// motors, which a few off the trend do not move.
    pub(super) speed_exponent: Option<f64>,
    pub(super) torque_exponent: Option<f64>,
    /// The same of the torque above the preload of the measured plateau: 1 on the trend, 0 on a plateau.
    pub(super) high_torque_exponent: Option<f64>,
    /// How many single orbits below and above do not turn more slowly by a sharp change than the middle of
    /// those inside, and how many above not faster.
    pub(super) no_fall: Cases,
    pub(super) no_rise_above: Cases,
    /// Middle steady speed of the lowest and of the highest quarter of those beside the preloads of the
    /// trends, over that inside.
    pub(super) outside_over_inside: [f64; 2],
}

/// The motors on a low-period cycle, and what those of a single flight do.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Holes {
    pub(super) motors: usize,
    pub(super) low_period: usize,
    pub(super) one_flight: usize,
    /// Smallest and largest fraction of Γ of the motors on a cycle of one flight, and the difference.
    pub(super) one_flight_fractions: Option<[f64; 2]>,
    pub(super) one_flight_window: Option<f64>,
    /// Slowest and fastest steady speed (rad/s) of these, of all motors on a low-period cycle, and of all
    /// others.
    pub(super) one_flight_speeds_rad_per_s: Option<[f64; 2]>,
}

/// The fate of bouncing rotors at Γ < 1/π.
#[derive(Debug, Serialize)]
pub(super) struct EndOfBouncing {
    /// What still prints as the ε of Table III.
    pub(super) restitutions: [f64; 2],
    /// How many come to rest for good.
    pub(super) at_rest: Cases,
    /// The restitution above which a rotor can go on bouncing at some Γ < 1/π.
    pub(super) threshold_restitution: f64,
    pub(super) coexisting: Coexisting,
}

/// A rotor that is launched on the period-1 orbit below Γ = 1/π.
#[derive(Debug, Serialize)]
pub(super) struct Coexisting {
    pub(super) restitution: f64,
    pub(super) axial_forcing: f64,
    /// After so many impacts ...
    pub(super) impacts: usize,
    /// ... it still bounces.
    pub(super) bounces: bool,
}
