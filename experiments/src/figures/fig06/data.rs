//! The numbers of Fig. 6.

use serde::Serialize;

use crate::claims::Cases;

/// Data of Fig. 6.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Fig06Data {
    pub(super) restitution: f64,
    pub(super) axial_forcing_range: (f64, f64),
    pub(super) basin_axial_forcings: [f64; 5],
    pub(super) axial_forcing_values: usize,
    /// Impacts at each Γ before any is kept.
    pub(super) transient_impacts: usize,
    /// Impacts examined at each Γ; a round of a periodic orbit is stored once.
    pub(super) examined_impacts: usize,
    /// (c): phase lag θ (rad) and angular forcing Γ_T.
    pub(super) linear: Twist,
    pub(super) semielliptical: Twist,
    /// Γ from which the period-1 attractor is followed.
    pub(super) followed_from: f64,
    /// The followed attractor, by rising Γ.
    pub(super) followed: Vec<Slice>,
    /// The chattering orbit from rest, by rising Γ; missing where the disk does not come to rest again.
    pub(super) chattering: Vec<Slice>,
    /// The Γ above 1/π where a disk from rest does not come to rest again but ends on another attractor.
    pub(super) not_chattering: Vec<Bouncing>,
    /// The followed attractor about the third to the fifth doubling, at finer steps of Γ.
    pub(super) zoom: Vec<Column>,
    pub(super) doublings: Vec<f64>,
    /// The lowest Γ at which the period-1 orbit was found, by bisection.
    pub(super) period_one_threshold: f64,
    /// Impact phase of the period-1 orbit at the first doubling (rad).
    pub(super) phase_at_first_doubling_rad: f64,
    /// Spectral radius of the period-1 orbit where following starts.
    pub(super) multiplier_where_followed_from: f64,
    pub(super) merging: Merging,
    /// Where the chattering orbit stops being a chain of single tosses.
    pub(super) single_tosses: SingleTosses,
    /// How a disk from rest comes to rest again, at some Γ.
    pub(super) chatters: Vec<Chatter>,
    /// The effect of Γ_T on the rotation, at some Γ from period 4 on.
    pub(super) forcing_effects: Vec<ForcingEffect>,
    /// Γ at which two branches of the period-4 orbit have the same speed in (d).
    pub(super) branch_crossings: Vec<f64>,
    /// Lyapunov exponents of the followed attractor beyond the last doubling: Γ, and the growth rate per
    /// impact.
    pub(super) lyapunov_exponents: Vec<(f64, f64)>,
    pub(super) period_one: PeriodOne,
    /// Long motions: how far they go.
    pub(super) motions: Vec<Motion>,
    /// How many numbers the impact map depends on.
    pub(super) dimension: Dimension,
    /// Γ_T and the ratio of torques, for two systems of the paper.
    pub(super) torque_ratios: Vec<TorqueRatio>,
    /// Where the angular momentum is transferred.
    pub(super) transfers: Vec<Transfer>,
    /// The share that impacts transfer in the motor of Table III, from rest.
    pub(super) motor_share_in_impacts: Option<f64>,
    /// The attractor just before the crisis and the orbits beyond it.
    pub(super) explored: Explored,
    /// The best phase lag at some Γ.
    pub(super) best_lags: Vec<BestLag>,
    /// Values of Γ from the crisis on at which one impact gives a disk from rest more than half of its
    /// impulse.
    pub(super) one_impact_decides: OneImpactDecides,
}

/// A disk from rest that bounces for ever.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Bouncing {
    pub(super) axial_forcing: f64,
    /// Impacts in one round of the periodic orbit that it has settled on; `None` if it is on none.
    pub(super) period: Option<usize>,
}

/// The impact phases at one Γ.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Column {
    pub(super) axial_forcing: f64,
    /// τ_imp/2π, each once, to six decimals.
    pub(super) impact_phase_cycles: Vec<f64>,
}

/// The rotation of period-1 orbits, from many starts and for many motions of the platform.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct PeriodOne {
    /// Orbits: of one impact every one, two or three periods of the platform, by Γ, θ, Γ_T and the speed of
    /// the disk at first.
    pub(super) orbits: usize,
    pub(super) impacts_each: usize,
    /// The largest |w_T|/(ωΦ) in the last impact of an orbit.
    pub(super) largest_tangential_speed: f64,
    /// Speeds against the phase lag.
    pub(super) lags: Vec<LagScan>,
}

/// The steady speeds of one period-1 orbit against the phase lag.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct LagScan {
    pub(super) axial_forcing: f64,
    pub(super) impact_phase_rad: f64,
    /// Distance between the lags tried (rad).
    pub(super) lag_step_rad: f64,
    /// The lag of those with the highest speed (rad).
    pub(super) best_lag_rad: f64,
    /// Speed/(ωΦ) at θ = −τ_imp.
    pub(super) speed_at_impact_phase: f64,
    /// Speed/(ωΦ) at θ = −π/2.
    pub(super) speed_of_elliptical: f64,
}

/// A long motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Motion {
    pub(super) axial_forcing: f64,
    pub(super) restitution: f64,
    /// Largest height of the disk, in amplitudes of the platform.
    pub(super) highest: f64,
    /// No disk can ever rise higher, by energy.
    pub(super) height_bound: f64,
    /// Angle turned in the first half of the impacts, in amplitudes Φ.
    pub(super) turned_in_first_half: f64,
    pub(super) turned_in_second_half: f64,
}

/// How many numbers the next collision depends on, if w_A is in units of ωA and w_T in units of ωΦ.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Dimension {
    /// Parameters of the system in SI units that are changed one by one.
    pub(super) parameters: Vec<String>,
    /// Number of outputs whose derivatives are taken.
    pub(super) outcomes: usize,
    /// Rank of the matrix of derivatives.
    pub(super) rank: usize,
}

/// Γ_T beside the torques.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct TorqueRatio {
    pub(super) system: String,
    pub(super) angular_forcing: f64,
    /// The torque that gives the disk the platform's largest angular acceleration, over the frictional torque
    /// of the preload.
    pub(super) ratio: f64,
}

/// The angular impulses of an orbit, by size, and what of them is transferred in impacts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Transfer {
    pub(super) axial_forcing: f64,
    pub(super) angular_forcing: f64,
    /// Whether it is the orbit from rest, or the followed attractor.
    pub(super) from_rest: bool,
    /// Share of the impulses that impacts transfer, those of a chatter included.
    pub(super) share_in_impacts: f64,
}

/// The part of the plane of phase and speed that orbits visit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Visited {
    pub(super) axial_forcing: f64,
    pub(super) impacts: usize,
    /// Occupied arc of the phases, in periods.
    pub(super) arc_cycles: f64,
    /// Largest |w_A Γ/(ωA)|.
    pub(super) largest_speed: f64,
    /// Cells of the plane visited, a hundredth of a period wide and a hundredth high.
    pub(super) cells: usize,
}

/// The widening at the crisis, and the shadow that the attractor leaves.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Explored {
    /// The attractor just before the crisis.
    pub(super) before: Visited,
    /// The same with as many impacts of a disk from rest there.
    pub(super) before_with_chattering: Visited,
    /// The orbit that starts on that attractor, just after the crisis.
    pub(super) after: Visited,
    /// Beyond the crisis: Γ, and the share of the impacts of the orbit from rest that are near the chaotic
    /// saddle there.
    pub(super) shadows: Vec<Shadow>,
}

/// How many impacts of an orbit lie near the chaotic saddle at the same Γ.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Shadow {
    pub(super) axial_forcing: f64,
    /// Share of the impacts within a hundredth or two of the saddle, in periods and in |w_A Γ/(ωA)|.
    pub(super) share_near: f64,
    /// Share of the plane, up to the largest speed just after the crisis, that is so near.
    pub(super) share_of_plane: f64,
}

/// The phase lag with the highest mean speed at one Γ, of the followed attractor or, beyond it, of a disk
/// from rest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct BestLag {
    pub(super) axial_forcing: f64,
    pub(super) angular_forcing: f64,
    /// Whether it is the followed attractor.
    pub(super) followed: bool,
    /// Impacts in one round of it, if it is periodic.
    pub(super) period: Option<usize>,
    /// Mean speed/(ωΦ) at the best lag tried.
    pub(super) speed: f64,
}

/// Where one impact of the cycle of a disk from rest has most of the impulse: a motor with the lag that is
/// best for this impact turns at ωΦ.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct OneImpactDecides {
    /// Smallest and largest Γ, and how many were tried.
    pub(super) axial_forcing_range: (f64, f64),
    pub(super) tried: usize,
    /// Γ_T of the motors that are simulated there.
    pub(super) angular_forcing: f64,
    /// Those found: Γ, Γ_T, lag and the mean speed of the simulation.
    pub(super) found: Vec<BestLag>,
}

/// Phase lag and angular forcing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Twist {
    pub(super) phase_lag_rad: f64,
    pub(super) angular_forcing: f64,
}

/// The last impacts of a disk from rest before it comes to rest again: those that end flights of less than
/// half a period.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Chatter {
    pub(super) axial_forcing: f64,
    /// Impacts up to the paper's cut.
    pub(super) impacts: usize,
    /// Of all pairs of these, those whose later one is slower, and whose later flight is shorter.
    pub(super) slower: Cases,
    pub(super) shorter: Cases,
    /// The time of rest (periods), from the separation on, with infinitely many impacts summed, and with the
    /// paper's cut.
    pub(super) rests_at_cycles: f64,
    pub(super) cut_at_cycles: f64,
}

/// By how much the angular speeds of the impacts vary more at the small Γ_T than at the large one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct ForcingEffect {
    pub(super) axial_forcing: f64,
    /// Difference of the standard deviations, as shares of ωΦ, with the phase lags of (c) and of (d).
    pub(super) added_variation: [f64; 2],
}

/// The impacts at one Γ. Coordinates are rounded to 1e-6, far below the resolution of the picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Slice {
    pub(super) axial_forcing: f64,
    /// Impacts in one round of a periodic orbit or from one rest to the next of a chattering one, if it
    /// repeats.
    pub(super) period: Option<usize>,
    /// Periods of the platform in the same.
    pub(super) platform_periods: Option<u64>,
    pub(super) impact_phase_cycles: Vec<f64>,
    pub(super) normalised_impact_speed: Vec<f64>,
    /// α'/|ωΦ| just before the impact, for (c).
    pub(super) linear: Vec<f64>,
    pub(super) linear_mean: f64,
    /// α'/|ωΦ| just before the impact, for (d).
    pub(super) semielliptical: Vec<f64>,
    pub(super) semielliptical_mean: f64,
}

/// The crisis in which the followed attractor is lost to chattering.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Merging {
    /// Impacts that an orbit has to survive without attaching.
    pub(super) impacts: usize,
    pub(super) starts: usize,
    /// Largest Γ of the bisection at which all survived.
    pub(super) survived: f64,
    /// Smallest Γ at which one was lost.
    pub(super) lost: f64,
    /// The same two with a tenth of the impacts.
    pub(super) survived_in_a_tenth: f64,
    pub(super) lost_in_a_tenth: f64,
    /// Γ, and the mean number of impacts before the disk attaches (at most `impacts` / 10).
    pub(super) mean_life_impacts: Vec<(f64, f64)>,
}

impl Merging {
    /// Γ of the crisis.
    pub(super) fn axial_forcing(&self) -> f64 {
        0.5 * (self.survived + self.lost)
    }

    /// How far it may be off: the last bracket and what ten times as many impacts change.
    pub(super) fn uncertainty(&self) -> f64 {
        0.5 * (self.lost - self.survived) + (self.axial_forcing() - self.in_a_tenth()).abs()
    }

    fn in_a_tenth(&self) -> f64 {
        0.5 * (self.survived_in_a_tenth + self.lost_in_a_tenth)
    }
}

/// The end of the single-toss pattern of the chattering orbit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct SingleTosses {
    /// Largest Γ of the bisection with one cycle per period of the platform.
    pub(super) last: f64,
    /// Smallest Γ without.
    pub(super) first_other: f64,
    /// Share of the Γ from there to 0.52 at which the disk comes to rest once in every period.
    pub(super) share_beyond: f64,
    /// Fewest periods of the platform in a cycle from there to 0.52, over the Γ that chatter.
    pub(super) periods_beyond: Option<u64>,
}
