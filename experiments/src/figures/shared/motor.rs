//! A motor about Table III, and the statistics of its transients.

use std::f64::consts::TAU;

use bouncing_disk::core::run::in_parallel;
use bouncing_disk::core::{ChatterPolicy, Unobserved};
use bouncing_disk::estimate::{Spread, TransientEnsemble};
use bouncing_disk::motor::{TransientMember, TransientSettings, transients};
use bouncing_disk::parameters::{Contact, ContactStatement, ContactWarning};
use bouncing_disk::toss::{ChatteringCycle, EXAMINED_IMPACTS, OrbitClass};
use bouncing_disk::{DiskParameters, Motor, PlatformParameters, System};
use serde::Serialize;

use crate::claims::{Cases, paper};
use crate::experiment::ExperimentError;
use crate::figures::shared::inputs::motor as inputs;
use crate::figures::shared::statistics::{EnsembleStatistics, unperturbed_orbit};
pub(crate) use crate::figures::shared::statistics::{LARGEST_CONSTANT, LARGEST_RESIDUAL};

/// Low period: a chattering cycle of at most so many flights, from rest to rest, that are longer than half a
/// period of the platform. The paper draws no line; its example in Fig. 12 shows a few lines that can be told
/// apart. Every figure uses this one; Fig. 13 has the shares of cycles of up to 2, 4, 8, 16 and 32 flights,
/// and so show how much depends on it.
pub(crate) const LOW_PERIOD_FLIGHTS: usize = 4;

/// Other definitions, under which a verdict must be the same to count.
pub(crate) const DEFINITIONS: [usize; 4] = [2, 8, 16, 32];

/// The cases in which something holds under each definition, in their order.
pub(crate) fn by_each_definition(cases: impl Fn(usize) -> Cases) -> Vec<(usize, Cases)> {
    let mut definitions = [&DEFINITIONS[..], &[LOW_PERIOD_FLIGHTS]].concat();
    definitions.sort_unstable();
    definitions.into_iter().map(|flights| (flights, cases(flights))).collect()
}

/// In which share of the cases something holds under each definition, in words.
pub(crate) fn by_definition_words(cases: &[(usize, Cases)]) -> String {
    let words = cases.iter().map(|(flights, cases)| {
        let share =
            cases.share().map_or_else(|| "none".to_owned(), |share| format!("{:.0} %", 100.0 * share));
        format!("{flights}: {share}")
    });
    words.collect::<Vec<_>>().join(", ")
}

/// Intervals over which the speed of a transient is averaged.
pub(crate) const INTERVALS: usize = 120;

/// The inputs of Sec. V A, in SI units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct MotorCase {
    pub(crate) friction: f64,
    pub(crate) restitution: f64,
    pub(crate) phase_lag_rad: f64,
    pub(crate) amplitude_m: f64,
    pub(crate) peak_angular_speed_rad_per_s: f64,
    pub(crate) contact_radius_m: f64,
    pub(crate) gyration_radius_m: f64,
    pub(crate) preload_acceleration_m_per_s2: f64,
    pub(crate) frequency_hz: f64,
}

impl MotorCase {
    /// The default motor: Table III with its 70 read as ω/2π in kHz, and gravity as the preload.
    pub(crate) fn table_three() -> Result<Self, ExperimentError> {
        let (table, section) = (paper::table_three()?, paper::section_five()?);
        Ok(Self {
            friction: table.friction,
            restitution: table.restitution,
            phase_lag_rad: table.phase_lag_rad,
            amplitude_m: table.amplitude_m,
            peak_angular_speed_rad_per_s: table.peak_angular_speed_rad_per_s,
            contact_radius_m: 1e-3 * table.contact_radius_mm,
            gyration_radius_m: 1e-3 * table.gyration_radius_mm,
            preload_acceleration_m_per_s2: section.gravity_m_per_s2,
            frequency_hz: section.default_frequency_hz,
        })
    }

    pub(crate) fn system(&self) -> Result<System, ExperimentError> {
        let angular_frequency = TAU * self.frequency_hz;
        let platform = PlatformParameters {
            amplitude: self.amplitude_m,
            twist_amplitude: self.peak_angular_speed_rad_per_s / angular_frequency,
            angular_frequency,
            phase_lag: self.phase_lag_rad,
        };
        let build = || System::new(platform.build()?, self.rotor().build()?);
        build().map_err(ExperimentError::model)
    }

    /// Its data sheet, with the paper's rotor mass.
    pub(crate) fn motor(&self) -> Result<Motor, ExperimentError> {
        let motor = Motor::paper_70_khz().with(|sheet| {
            sheet.drive_frequency = self.frequency_hz;
            sheet.amplitude = Some(self.amplitude_m);
            sheet.peak_angular_speed = Some(self.peak_angular_speed_rad_per_s);
            sheet.phase_lag = self.phase_lag_rad;
            sheet.contact_radius = self.contact_radius_m;
            sheet.gyration_radius = Some(self.gyration_radius_m);
            sheet.preload_acceleration = Some(self.preload_acceleration_m_per_s2);
            sheet.friction = self.friction;
            sheet.restitution = self.restitution;
        });
        motor.map_err(ExperimentError::model)
    }

    const fn rotor(&self) -> DiskParameters {
        DiskParameters {
            contact_radius: self.contact_radius_m,
            gyration_radius: self.gyration_radius_m,
            friction: self.friction,
            restitution: self.restitution,
            preload_acceleration: self.preload_acceleration_m_per_s2,
            load_acceleration: 0.0,
        }
    }

    /// The parameters that all motors of the figures share, by name and with units, for the gallery.
    pub(crate) fn shared_inputs(&self) -> Vec<(String, String)> {
        inputs::SHARED.iter().map(|input| input.row(self)).collect()
    }

    /// What the contact of a steel ball with the paper's stator says of rigid impacts, over some motors, for the
    /// gallery.
    pub(crate) fn contact_row(motors: impl IntoIterator<Item = Self>) -> (String, String) {
        let of = |motor: Self| {
            let motor = Motor::paper_70_khz().with(|sheet| {
                sheet.contact = Some(Contact::PAPER);
                sheet.drive_frequency = motor.frequency_hz;
                sheet.amplitude = Some(motor.amplitude_m);
                sheet.preload_acceleration = Some(motor.preload_acceleration_m_per_s2);
            });
            motor.ok()?.report(&Unobserved).ok()?.contact
        };
        let both = |[low, high]: [f64; 2], own: [f64; 2]| [low.min(own[0]), high.max(own[1])];
        let whole = motors.into_iter().filter_map(of).reduce(|mut whole, own| {
            let times = whole.time_over_period.zip(own.time_over_period).map(|(whole, own)| both(whole, own));
            whole.time_over_period = times.or(whole.time_over_period).or(own.time_over_period);
            let depths = [whole, own].map(|own| own.indentation_over_amplitude);
            whole.indentation_over_amplitude = both(depths[0], depths[1]);
            whole
        });
        let periods = whole.and_then(|own| own.time_over_period).unwrap_or_default();
        let [_, (_, depth)] = ContactStatement::rows(whole.as_ref());
        let words = ContactWarning::LongContact { periods };
        let words = format!("{words}; m g/(k A) = {depth} (docs/numerics-dynamics.md)");
        ("contact of a steel ball on an aluminium ring".to_owned(), words)
    }

    /// μ a_e g/a_g² (rad/s²): the acceleration if friction pushed one way all the time.
    pub(crate) fn largest_acceleration(&self) -> f64 {
        self.rotor().friction_acceleration()
    }

    /// The time (s) in which that acceleration gives the stator's largest speed ωΦ.
    pub(crate) fn rise_time_s(&self) -> f64 {
        self.peak_angular_speed_rad_per_s / self.largest_acceleration()
    }

    /// The cycle of the motor that nothing perturbs.
    pub(crate) fn cycle(&self, policy: ChatterPolicy) -> Result<Cycle, ExperimentError> {
        Ok(Cycle::from(unperturbed_orbit(&self.system()?, policy)?))
    }

    /// The cycle of the motor that nothing perturbs, if all motors that cannot be distinguished from it have
    /// the same.
    pub(crate) fn robust_cycle(&self) -> Result<Option<RobustCycle>, ExperimentError> {
        let cycle = self.cycle(ChatterPolicy::Complete)?;
        let ulps = UNTOLD.map(|part| self.amplitude_m * (1.0 + part));
        let neighbours = [self.amplitude_m.next_up(), self.amplitude_m.next_down()];
        for amplitude_m in ulps.into_iter().chain(neighbours) {
            if (Self { amplitude_m, ..*self }).cycle(ChatterPolicy::Complete)? != cycle {
                return Ok(None);
            }
        }
        Ok(Some(RobustCycle(cycle)))
    }
}

/// Transients of so many rotors of each motor, with a relaunch perturbation (g/ω), over `rises` rise times, and their statistics. All
/// transients are computed at once: many advance in lockstep.
pub(crate) fn statistics(
    motors: &[(MotorCase, usize, f64)],
    rises: f64,
) -> Result<Vec<MotorStatistics>, ExperimentError> {
    let settings = |motor: &MotorCase, relaunch_perturbation: f64| TransientSettings {
        duration: rises * motor.rise_time_s(),
        intervals: INTERVALS,
        relaunch_perturbation,
        ..TransientSettings::default()
    };
    let mut all = Vec::new();
    let mut first = Vec::with_capacity(motors.len());
    for (motor, members, perturbation) in motors {
        first.push(all.len());
        all.extend(TransientMember::of_ensemble(
            &motor.system()?,
            &settings(motor, *perturbation),
            *members,
        )?);
    }
    let curves = transients(&all, &Unobserved)?;
    let statistics = |k: usize| -> Result<MotorStatistics, ExperimentError> {
        let (motor, members, perturbation) = &motors[k];
        let own = curves[first[k]..first[k] + members].to_vec();
        let runs = TransientEnsemble::of_results(own, &Unobserved)?;
        let TransientSettings { duration, policy, .. } = settings(motor, *perturbation);
        Ok(EnsembleStatistics::of(&motor.system()?, &runs, duration, policy)?.into())
    };
    in_parallel(motors.len(), statistics).into_iter().collect()
}

/// What `multi_toss` says that the unperturbed motor repeats.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "class", rename_all = "snake_case")]
pub(crate) enum Cycle {
    /// From rest to rest.
    Chattering(ChatteringCycle),
    /// Without rest.
    Periodic { impacts: usize, platform_periods: u64 },
    /// Nothing within the impacts examined.
    Longer,
    /// The rotor does not bounce.
    AtRest,
}

impl From<OrbitClass> for Cycle {
    fn from(orbit: OrbitClass) -> Self {
        match orbit {
            OrbitClass::Chattering(cycle) => Self::Chattering(cycle),
            OrbitClass::Periodic { period, platform_periods, .. } => {
                Self::Periodic { impacts: period, platform_periods }
            }
            OrbitClass::AtRest => Self::AtRest,
            _ => Self::Longer,
        }
    }
}

/// Changes of the amplitude, as parts of it, that nobody could set or compute: some units in the last place,
/// and a hundred times as much.
const UNTOLD: [f64; 6] = [5e-16, -5e-16, 1.1e-15, -1.1e-15, 1e-13, -1e-13];

/// A cycle that the last places of the inputs do not choose. Of no other is the length written or drawn: only
/// [`MotorCase::robust_cycle`] makes one, and only it has words.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(transparent)]
pub(crate) struct RobustCycle(Cycle);

impl RobustCycle {
    /// The cycle.
    pub(crate) fn cycle(self) -> Cycle {
        self.0
    }

    /// In words.
    pub(crate) fn words(self) -> String {
        match self.0 {
            Cycle::Chattering(cycle) => cycle.to_string(),
            Cycle::Periodic { impacts, platform_periods } => {
                format!("{impacts} impacts in {platform_periods} periods without rest")
            }
            Cycle::Longer => format!("more than {} impacts", EXAMINED_IMPACTS / 2),
            Cycle::AtRest => "no bouncing".to_owned(),
        }
    }
}

impl Cycle {
    /// Its duration in periods of the platform.
    pub(crate) fn platform_periods(self) -> Option<u64> {
        match self {
            Self::Chattering(cycle) => Some(cycle.platform_periods),
            Self::Periodic { platform_periods, .. } => Some(platform_periods),
            Self::Longer | Self::AtRest => None,
        }
    }

    /// Its flights of more than half a period; of a periodic orbit its impacts.
    pub(crate) fn flights(self) -> Option<usize> {
        match self {
            Self::Chattering(cycle) => Some(cycle.long_flights),
            Self::Periodic { impacts, .. } => Some(impacts),
            Self::Longer | Self::AtRest => None,
        }
    }

    /// Its flights of more than half a period, if it is a chattering cycle.
    pub(crate) fn chattering_flights(self) -> Option<usize> {
        match self {
            Self::Chattering(cycle) => Some(cycle.long_flights),
            Self::Periodic { .. } | Self::Longer | Self::AtRest => None,
        }
    }

    /// Whether it is of low period: [`LOW_PERIOD_FLIGHTS`]. An orbit without rest is no chattering cycle,
    /// however short.
    pub(crate) fn is_low_period(self) -> bool {
        self.is_low(LOW_PERIOD_FLIGHTS)
    }

    /// The same under another definition: of at most so many flights.
    pub(crate) fn is_low(self, most: usize) -> bool {
        self.chattering_flights().is_some_and(|flights| flights <= most)
    }

    /// Whether every flight ends in a rest.
    pub(crate) fn is_one_flight(self) -> bool {
        self.chattering_flights() == Some(1)
    }
}

/// [`EnsembleStatistics`] as data, units in the names.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct MotorStatistics {
    /// From the fits; where less than half of the members can be fitted, the mean over the last half of each.
    pub(crate) steady_speed_rad_per_s: Spread,
    /// Over the members that can be fitted; `None` where less than half can.
    pub(crate) stall_acceleration_rad_per_s2: Option<Spread>,
    /// Whether the exponential fits the transients better than a linear rise to a constant.
    #[serde(skip)]
    pub(crate) is_exponential: bool,
    /// The cycle without perturbation.
    pub(crate) cycle: Cycle,
    /// Whether the perturbed members repeat that cycle, too.
    pub(crate) locked: bool,
}

impl From<EnsembleStatistics> for MotorStatistics {
    fn from(statistics: EnsembleStatistics) -> Self {
        Self {
            steady_speed_rad_per_s: statistics.steady_speed,
            stall_acceleration_rad_per_s2: statistics.stall_acceleration,
            is_exponential: statistics.is_exponential,
            cycle: statistics.orbit.into(),
            locked: statistics.locked,
        }
    }
}

impl MotorStatistics {
    /// Whether a low-period cycle governs the perturbed motor, too: one that the perturbation does not break,
    /// or one of a single flight, which it breaks only now and then.
    pub(crate) fn is_low_period(&self) -> bool {
        self.cycle.is_low_period() && (self.locked || self.cycle.is_one_flight())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fig. 12's printed low-period case hangs on the last places, and so do the motors next to 9.8 m/s²; 9.8
    /// itself does not.
    #[test]
    fn a_cycle_that_a_few_units_in_the_last_place_change_has_no_words() {
        let motor = MotorCase::table_three().expect("reads");
        let at = |amplitude_m, preload_acceleration_m_per_s2| {
            MotorCase { amplitude_m, preload_acceleration_m_per_s2, ..motor }.robust_cycle().expect("runs")
        };
        for (amplitude, preload) in
            [(1e-8, 1.0), (1.000_000_000_01e-8, 1.0), (1e-9, 9.795), (1e-9, 9.81), (1e-9, 10.0)]
        {
            assert_eq!(at(amplitude, preload), None, "A = {amplitude}, g = {preload}");
        }
        assert_eq!(
            at(1e-9, 9.8).map(RobustCycle::words).as_deref(),
            Some("2 long flights, 14 impacts, 15 periods")
        );
    }

    /// The cycle keeps its form in the figures' data.
    #[test]
    fn a_cycle_is_written_flat() {
        let cycle = Cycle::Chattering(ChatteringCycle { impacts: 9, platform_periods: 11, long_flights: 2 });
        let text = serde_json::to_string(&cycle).expect("writes");
        assert_eq!(text, r#"{"class":"chattering","impacts":9,"platform_periods":11,"long_flights":2}"#);
    }
}
