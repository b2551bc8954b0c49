//! Single tosses (Sec. III): the dough rests in the hand at its lowest point, and is thrown.

use crate::display::numbers;
use std::f64::consts::PI;
use std::fmt::{self, Display, Formatter};

use bouncing_disk_core::numerics::elementary::sin;
use bouncing_disk_core::{ChatterPolicy, Phase};

use crate::error::Error;
use crate::motion::energy::EnergyLedger;
use crate::motion::engine::Engine;
use crate::motion::event::{Event, EventRecord};
use crate::motion::initial_condition::InitialCondition;
use crate::motion::si::SiEnergy;
use crate::motion::state::Mode;
use crate::motion::trajectory::Trajectory;
use crate::parameters::dimensionless::DimensionlessSystem;
use crate::parameters::scales::Scales;
use crate::parameters::system::System;

/// Phase at which a toss starts on the sine of Eq. (1): the lowest point of the hand. For other motions it is
/// [`Drive::lowest_phase`](bouncing_disk_drives::Drive::lowest_phase).
pub const TOSS_START: f64 = 1.5 * PI;

/// How the dough turns at the start of a toss. The two cases differ if the phase lag is not zero, because the
/// hand then turns at omega Phi sin theta as the toss starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum InitialSpin {
    /// It does not turn.
    #[default]
    AbsoluteRest,
    /// It turns with the hand.
    RestRelativeToHand,
}

/// The performance measures of a single toss (Sec. III A), in SI units; energies per unit mass of the dough.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TossPerformance {
    /// Airborne rotary speed of the dough (rad/s).
    pub airborne_speed: f64,
    /// Rotary kinetic energy that the dough gains up to the separation, divided by the energy that the
    /// tossing motion puts in by then. The input is the work of the hand, by normal force and friction: it
    /// goes into the dough's rotation, lift and height above the lowest point, and into friction between hand
    /// and dough. If the dough starts with the hand, its initial spin counts as supplied by the hand and
    /// gained by the dough. The efficiency is negative if a dough at rest is turned by a hand that takes
    /// energy back. For the formula see [`SiEnergy::efficiency`].
    #[cfg_attr(feature = "serde", serde(deserialize_with = "bouncing_disk_core::stored::nan_if_none"))]
    pub efficiency: f64,
    /// Airborne rotary speed divided by the largest rotary speed of the hand, omega Phi for the sine; `None`
    /// without twist.
    pub speed_ratio: Option<f64>,
    /// Phase of the separation (rad).
    pub separation_phase: f64,
    /// Whether the dough slides on the hand as it leaves.
    pub sliding_at_separation: bool,
    /// Vertical speed of the dough as it leaves (m/s).
    pub launch_speed: f64,
    /// Rotary kinetic energy gained (J/kg).
    pub rotary_energy_gain: f64,
    /// The energy balance up to the separation (J/kg).
    pub energy: SiEnergy,
}

/// The toss of `system`'s disk from its platform, up to the separation.
///
/// The disk's restitution does not matter, as nothing has fallen back yet.
///
/// # Errors
/// [`Error::NeverLeaves`] if the hand never falls away from the dough (phi_L > acos(g/(c omega^2)) for a
/// motion given by its stroke); [`Error::SoftContact`].
pub fn single_toss(system: &System, initial: InitialSpin) -> Result<TossPerformance, Error> {
    let mut ledger = EnergyLedger::default();
    for record in toss_engine(system, initial)? {
        let record = record?;
        ledger += record.ledger;
        if record.event == Event::Separation {
            let peak = system.platform().peak_angular_speed();
            let spin = match initial {
                InitialSpin::AbsoluteRest => 0.0,
                InitialSpin::RestRelativeToHand => {
                    let gyration = system.disk().gyration_radius();
                    let rim_speed = gyration * peak * sin(system.platform().phase_lag());
                    0.5 * rim_speed * rim_speed
                }
            };
            return Ok(TossPerformance::of(&record, &ledger, &system.scales(), spin, peak));
        }
    }
    Err(never_leaves(system))
}

/// The whole toss of `system`'s disk, from the start until the dough lands.
///
/// # Errors
/// The errors of [`single_toss`].
pub fn toss_trajectory(system: &System, initial: InitialSpin) -> Result<Trajectory, Error> {
    Trajectory::record(&mut toss_engine(system, initial)?, |record| {
        matches!(record.event, Event::Impact { .. })
    })
}

fn toss_engine(system: &System, initial: InitialSpin) -> Result<Engine, Error> {
    DimensionlessSystem::try_from(system)?;
    if system.dimensionless().vibration().separation_phase().is_none() {
        return Err(never_leaves(system));
    }
    let phase = Phase::new(TOSS_START)?;
    let angular_speed = match initial {
        InitialSpin::AbsoluteRest => 0.0,
        InitialSpin::RestRelativeToHand => system.dimensionless().platform_angular_speed(phase),
    };
    Engine::new(system, InitialCondition::Contact { phase, angular_speed }, ChatterPolicy::Complete)
}

impl TossPerformance {
    /// The performance for a disk that starts with the rotary energy `spin` (J/kg), on a hand with the peak
    /// angular speed `peak` (rad/s).
    pub(crate) fn of(
        separation: &EventRecord,
        ledger: &EnergyLedger,
        scales: &Scales,
        spin: f64,
        peak: f64,
    ) -> Self {
        let state = scales.state(&separation.after);
        let energy = scales.energy(ledger);
        Self {
            airborne_speed: state.angular_speed,
            efficiency: energy.efficiency(spin),
            speed_ratio: (peak > 0.0).then(|| state.angular_speed / peak),
            separation_phase: separation.time.phase.angle(),
            sliding_at_separation: matches!(separation.before.mode, Mode::Sliding(_)),
            launch_speed: state.axial_velocity,
            rotary_energy_gain: energy.rotary_kinetic_change,
            energy,
        }
    }
}

const fn never_leaves(system: &System) -> Error {
    Error::NeverLeaves { peak_acceleration: system.peak_acceleration() }
}

impl Display for TossPerformance {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let own = [self.airborne_speed, self.launch_speed, self.separation_phase, self.efficiency];
        let [spin, speed, phase, efficiency] = own.map(numbers(f));
        write!(
            f,
            "airborne at {spin} rad/s and {speed} m/s, separation at {phase} rad, efficiency {efficiency}"
        )?;
        self.speed_ratio.map_or(Ok(()), |ratio| write!(f, ", speed ratio {}", numbers(f)(ratio)))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use bouncing_disk_core::numerics::elementary::{acos, asin, cos};
    use proptest::prelude::*;

    use super::*;
    use crate::parameters::disk::DiskParameters;
    use crate::parameters::platform::Platform;
    use crate::parameters::stroke::Stroke;

    /// Table I, except for amplitude angle, phase lag and friction.
    fn table_i(amplitude_angle: f64, phase_lag: f64, friction: f64) -> System {
        let hand = Platform::from_stroke(Stroke { amplitude_angle, phase_lag, ..Stroke::pizza_toss() });
        let dough = DiskParameters { friction, ..System::pizza_toss().disk().parameters() };
        System::new(hand.unwrap(), dough.build().unwrap()).unwrap()
    }

    #[test]
    fn table_i_gives_fourteen_radians_per_second() {
        let toss = single_toss(&table_i(0.55, 0.0, 0.6), InitialSpin::AbsoluteRest).unwrap();
        assert!((toss.airborne_speed - 14.0).abs() < 0.5, "{toss:?}");
        assert!(toss.energy.platform_work() > 0.0 && toss.efficiency > 0.0 && toss.efficiency < 1.0);
        assert!((toss.launch_speed - 3.1).abs() < 0.1, "{toss:?}");
    }

    /// The work of the hand goes into the rotation, the upward motion and the height of the dough, and into
    /// friction; a dough that starts with the hand keeps the spin that the hand gave it.
    #[test]
    fn the_efficiency_is_the_share_of_the_rotation_in_what_the_hand_has_given() {
        for (lag, friction) in [(0.7, 0.6), (-1.2, 0.6), (0.4, 0.1), (0.3, 50.0), (0.0, 0.6)] {
            for initial in [InitialSpin::AbsoluteRest, InitialSpin::RestRelativeToHand] {
                let system = table_i(0.55, lag, friction);
                let toss = single_toss(&system, initial).unwrap();
                let rim_speed = 0.11 * toss.airborne_speed;
                let rotary = 0.5 * rim_speed * rim_speed;
                let lifted = system.platform().amplitude() * (1.0 + sin(toss.separation_phase));
                let axial = 0.5 * toss.launch_speed * toss.launch_speed + 9.8 * lifted;
                let expected = rotary / (rotary + axial + toss.energy.friction_loss);
                assert!((toss.efficiency - expected).abs() < 1e-12 * expected, "{lag} {friction} {toss:?}");
                let hand = system.platform().peak_angular_speed();
                assert_eq!(toss.speed_ratio, Some(toss.airborne_speed / hand));
                let at_start = match initial {
                    InitialSpin::AbsoluteRest => 0.0,
                    // The hand turns at omega Phi cos(3 pi/2 + theta).
                    InitialSpin::RestRelativeToHand => 0.11 * hand * sin(lag),
                };
                let gain = rotary - 0.5 * at_start * at_start;
                assert!((toss.rotary_energy_gain - gain).abs() < 1e-12 * rotary, "{lag} {friction} {toss:?}");
            }
        }
        // For a hand that does not twist, the speed ratio is undefined.
        let flat = single_toss(&table_i(0.0, 0.7, 0.6), InitialSpin::AbsoluteRest).unwrap();
        assert_eq!((flat.speed_ratio, flat.airborne_speed.abs()), (None, 0.0));
    }

    #[test]
    fn a_whole_toss_ends_with_the_first_impact() {
        let system = table_i(0.55, 0.4, 0.6);
        let whole = toss_trajectory(&system, InitialSpin::RestRelativeToHand).unwrap();
        let events: Vec<Event> = whole.records().iter().map(|record| record.event).collect();
        let (last, before) = events.split_last().unwrap();
        assert!(matches!(last, Event::Impact { .. }) && before.last() == Some(&Event::Separation));
        assert!(!before.iter().any(|event| matches!(event, Event::Impact { .. })));
        // The normal force goes to zero, so any twisting dough slides in the end, and without twist it never
        // does.
        let slides = |angle| {
            single_toss(&table_i(angle, 0.3, 0.6), InitialSpin::RestRelativeToHand)
                .unwrap()
                .sliding_at_separation
        };
        assert!(slides(0.55) && !slides(0.0));
    }

    /// Fig. 4: the optimum for the speed as stated in the paper's text (its amplitude angle is 0.323 pi).
    #[test]
    fn the_fastest_toss_reaches_twenty_two_radians_per_second() {
        let fastest = (0..=450)
            .filter_map(|step| {
                single_toss(&table_i(1e-3 * PI * f64::from(step), 0.0, 0.6), InitialSpin::AbsoluteRest).ok()
            })
            .map(|toss| toss.airborne_speed)
            .fold(0.0, f64::max);
        assert!((fastest - 22.0).abs() < 0.5, "{fastest}");
    }

    proptest! {
        #![proptest_config(ProptestConfig { max_global_rejects: 100_000, ..ProptestConfig::default() })]

        /// If the dough lags throughout, the speed is the integral of the friction (physics of theta = 0).
        #[test]
        fn a_lagging_dough_has_the_closed_form_speed(angle in 0.0..1.5_f64, friction in 0.05..1.0_f64) {
            let system = table_i(angle, 0.0, friction);
            prop_assume!(system.peak_acceleration() > 1.0);
            let trajectory = toss_trajectory(&system, InitialSpin::AbsoluteRest).unwrap();
            let first = trajectory.records()[0];
            // One segment of sliding from start to separation.
            prop_assume!(first.event == Event::Separation && matches!(first.before.mode, Mode::Sliding(_)));
            let toss = single_toss(&system, InitialSpin::AbsoluteRest).unwrap();
            let leaves = asin(1.0 / system.peak_acceleration());
            let omega = system.platform().angular_frequency();
            let expected = friction * 0.135 / (0.11 * 0.11)
                * (9.8 * (leaves + FRAC_PI_2) / omega + system.platform().amplitude() * omega * cos(leaves));
            prop_assert!((toss.airborne_speed - expected).abs() < 1e-12 * expected, "{} {expected}", toss.airborne_speed);
            prop_assert!((toss.separation_phase - leaves).abs() < 1e-15);
        }

        /// Half a period of phase lag reverses the twist.
        #[test]
        fn half_a_period_of_lag_reverses_the_rotation(
            angle in 0.0..1.5_f64, lag in -PI..PI, friction in 0.0..1.0_f64, relative in any::<bool>(),
        ) {
            let initial = if relative { InitialSpin::RestRelativeToHand } else { InitialSpin::AbsoluteRest };
            let system = table_i(angle, lag, friction);
            prop_assume!(system.peak_acceleration() > 1.0);
            let one = single_toss(&system, initial).unwrap();
            let other = single_toss(&table_i(angle, lag + PI, friction), initial).unwrap();
            let scale = system.platform().peak_angular_speed() + 1e-300;
            prop_assert!((one.airborne_speed + other.airborne_speed).abs() < 1e-12 * scale.max(1.0), "{one:?} {other:?}");
            // The works of normal force and friction may cancel.
            let energy = one.energy;
            let cancelled =
                (energy.normal_work.abs() + energy.friction_work.abs()) / energy.platform_work().abs();
            let bound = 1e-12 * (1.0 + one.efficiency.abs()) * cancelled;
            prop_assert!((one.efficiency - other.efficiency).abs() < bound, "{one:?} {other:?}");
        }
    }

    #[test]
    fn a_flat_stroke_never_leaves_the_hand() {
        let limit = acos(9.8 / (0.25 * 225.0));
        assert!(single_toss(&table_i(limit - 1e-9, 0.3, 0.6), InitialSpin::AbsoluteRest).is_ok());
        let error = single_toss(&table_i(limit + 1e-9, 0.3, 0.6), InitialSpin::AbsoluteRest).unwrap_err();
        assert!(matches!(error, Error::NeverLeaves { peak_acceleration } if peak_acceleration < 1.0));
        assert_eq!(
            toss_trajectory(&table_i(1.5, 0.0, 0.6), InitialSpin::AbsoluteRest).unwrap_err(),
            never_leaves(&table_i(1.5, 0.0, 0.6))
        );
    }
}
