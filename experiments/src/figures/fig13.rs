//! Fig. 13: sensitivity of the motor to the five estimated parameters.

mod draw;
mod effects;
mod orbits;
mod sensitivity;
mod single_orbits;

use std::f64::consts::PI;

use bouncing_disk::core::numerics::elementary::pow;
use bouncing_disk::core::{ChatterPolicy, ImpactMap, Launch, OrbitEvent, Unobserved};
use bouncing_disk::estimate::ExponentialFit;
use bouncing_disk::motion::PAPER_CHATTER;
use bouncing_disk::motor::{NormalImpulses, TransientSettings};
use serde::Serialize;

use self::effects::{Effects, Reading, Varied, middle_exponent};
use self::single_orbits::SingleOrbits;
use crate::claims::paper;
use crate::experiment::{ExperimentError, Paper, Quality};
use crate::figures::shared::inputs::{Input, motor as inputs};
use crate::figures::shared::motor::{MotorCase, MotorStatistics, statistics};
use crate::figures::shared::numbers::{Concentration, Noise};

/// Duration of a transient in rise times ωΦ a_g²/(μ a_e g).
const RISES: f64 = 6.0;
/// The second perturbation (g/ω), which breaks most low-period cycles.
const BREAKING_PERTURBATION: f64 = 0.1;
/// ε of the distributions of impulse.
const RESTITUTIONS: [f64; 3] = [0.2, 0.5, 0.8];
/// Parts of the cycle in these distributions.
const PARTS: usize = 48;
/// Largest ε of a sweep.
const LARGEST_RESTITUTION: f64 = 0.9;

/// Seed of the relaunches of the counted collisions.
const RELAUNCH_SEED: u64 = 93;

/// A small change of ε or θ.
const SMALL_CHANGE: f64 = 1e-4;

/// Fig. 13.
pub(crate) fn fig13(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    fig.seed("motors that print alike", single_orbits::SEED);
    fig.seed("ensembles", TransientSettings::default().seed);
    fig.seed("relaunches of counted collisions", RELAUNCH_SEED);
    let quality = fig.quality;
    let members = quality.choose(3, 8);
    let impacts = quality.choose(4_000, 20_000);
    let perturbation = TransientSettings::default().relaunch_perturbation;
    let motor = MotorCase::table_three()?;

    // Each parameter is varied alone: ensembles of motors, and what the phases of the normal impulse predict for them.
    let amplitudes = paper::section_five()?.amplitudes_of_fig10_m;
    let grids = inputs::PANELS.map(|parameter| (parameter, values(parameter, &amplitudes, quality)));
    fig.progress.start(grids.iter().map(|(_, grid)| grid.len() as u64).sum::<u64>() + 2, "motors");
    let case = |(parameter, value): (Input<MotorCase>, f64)| parameter.set(&motor, value);
    let values = grids.iter().flat_map(|(parameter, grid)| grid.iter().map(|value| (*parameter, *value)));
    let ensembles = values.map(|value| (case(value), members, perturbation));
    let ensembles: Vec<_> = ensembles.chain([(motor, 2 * members, perturbation)]).collect();
    let mut ensembles = statistics(&ensembles, RISES)?.into_iter();
    let mut sweeps = Vec::new();
    for (parameter, grid) in grids {
        let mut points = Vec::new();
        for (value, statistics) in grid.into_iter().zip(&mut ensembles) {
            points.push(SweepPoint::of(value, &case((parameter, value)), statistics, impacts, perturbation)?);
            fig.progress.advance(1);
        }
        sweeps.push(Sweep { parameter, points });
    }
    let default =
        ensembles.next().ok_or_else(|| ExperimentError::NoData { quantity: "statistics".to_owned() })?;
    let impulses = RESTITUTIONS
        .map(|restitution| ImpulsePhases::of(&inputs::RESTITUTION.set(&motor, restitution), 5 * impacts));
    let impulses = impulses.into_iter().collect::<Result<Vec<_>, _>>()?;
    fig.progress.advance(1);
    let alike = SingleOrbits::of(quality)?;
    fig.progress.advance(1);
    let study = Study::new(motor, &default, sweeps, impulses, alike)?;

    let left_out = study.all_points().filter(|point| point.stall().is_none()).count();
    let low = study.all_points().filter(|point| point.statistics.is_low_period()).count();
    fig.caption(format!(
        "Effect of (a) μ, (b) ε, (c) θ, (d) A and (e) ωΦ about the default motor (grey vertical lines) on steady-state speed (crosses, left) and \
         stall torque (dots, right; none for {left_out} motors without a meaningful fit). Means and standard deviations of {members} members; pale: \
         {low} motors on a low-period cycle. Dotted: prediction from the phases of the normal impulse, (f). Grey area and blue lines: 5 to 95 % of {} \
         unperturbed motors whose inputs print alike. The paper does not print its ranges; these are ours.",
        study.alike.drawn,
    ));
    for sweep in &study.sweeps {
        if let (Some(first), Some(last)) = (sweep.points.first(), sweep.points.last()) {
            let (unit, count) = (sweep.parameter.unit, sweep.points.len());
            let range = format!("{:.3e} to {:.3e} {unit}, {count} values", first.value, last.value);
            fig.parameter(sweep.parameter.symbol, range);
        }
    }
    fig.parameter("members", members);
    fig.parameter("duration", format!("{RISES} ωΦ a_g²/(μ a_e g)"));
    fig.parameter("relaunch perturbation", format!("{perturbation} and {BREAKING_PERTURBATION} g/ω"));
    fig.parameter("inputs that print alike, but for ε", &study.alike.inputs);
    fig.parameters([MotorCase::contact_row([motor])]);

    // A counterexample is more than a point where it persists under a small change of the parameter.
    let mut persisting = Vec::new();
    for (parameter, value) in study.beyond_limits() {
        let cases = [value - SMALL_CHANGE, value + SMALL_CHANGE].map(|value| parameter.set(&motor, value));
        let means = statistics(&cases.map(|case| (case, members, perturbation)), RISES)?;
        let beyond = |(case, mean): (&MotorCase, &MotorStatistics)| {
            let reading = Reading::of(parameter.of(case), case, mean);
            reading.is_within_limits() == Some(false)
        };
        if cases.iter().zip(&means).all(beyond) {
            persisting.push((parameter, value));
        }
    }
    fig.claims(sensitivity::claims(&study, &persisting));
    fig.claims(orbits::claims(&study));
    fig.draw(draw::draw(&study));
    fig.record("motor", &motor)?;
    fig.record("members", &members)?;
    fig.record("rises", &RISES)?;
    fig.record("relaunch_perturbation", &perturbation)?;
    fig.record("breaking_perturbation", &BREAKING_PERTURBATION)?;
    fig.record("default", &default)?;
    fig.record("sweeps", &study.sweeps)?;
    fig.record("impulses", &study.impulses)?;
    fig.record("alike", &study.alike)
}

/// The values of a sweep. The paper's ranges are not in its text; A runs over its three amplitudes.
fn values(parameter: Input<MotorCase>, amplitudes: &[f64; 3], quality: Quality) -> Vec<f64> {
    let even = |first: f64, last: f64, count: u32| -> Vec<f64> {
        (0..count).map(|index| first + (last - first) * f64::from(index) / f64::from(count - 1)).collect()
    };
    match parameter.name {
        "friction" => even(0.02, 0.4, quality.choose(5, 20)),
        "restitution" => even(0.0, LARGEST_RESTITUTION, quality.choose(7, 19)),
        "phase_lag" => even(-PI, PI, quality.choose(9, 25)),
        "amplitude" => {
            let ratio = amplitudes[2] / amplitudes[0];
            let shares = even(0.0, 1.0, quality.choose(5, 25));
            shares.iter().map(|share| amplitudes[0] * pow(ratio, *share)).collect()
        }
        _ => even(5.0, 60.0, quality.choose(4, 12)),
    }
}

/// One panel.
#[derive(Debug, Serialize)]
struct Sweep {
    parameter: Input<MotorCase>,
    points: Vec<SweepPoint>,
}

/// One value of the parameter.
#[derive(Debug, Serialize)]
struct SweepPoint {
    value: f64,
    peak_angular_speed_rad_per_s: f64,
    statistics: MotorStatistics,
    /// From the phases of the impulses: steady speed over ωΦ, and α̇_ss/t_c of the curve fitted as the
    /// ensembles are.
    predicted_speed_ratio: f64,
    predicted_stall_acceleration_rad_per_s2: Option<f64>,
    /// Means over the impacts that are not summed.
    mean_impact_speed_m_per_s: f64,
    mean_impact_interval_s: f64,
}

impl SweepPoint {
    fn of(
        value: f64,
        case: &MotorCase,
        statistics: MotorStatistics,
        impacts: usize,
        perturbation: f64,
    ) -> Result<Self, ExperimentError> {
        let system = case.system()?;
        let impulses = NormalImpulses::of(system.dimensionless().map(), impacts, perturbation)?;
        let count = impulses.impacts.len() as f64;
        let speeds = impulses.impacts.iter().map(|one| one.impulse / (1.0 + case.restitution));
        let balance = impulses.balance(case.phase_lag_rad);
        let (times, transient) = balance.transient(RISES, 240);
        let fit = ExponentialFit::new(&times, &transient, &Unobserved).ok();
        let fit =
            fit.filter(|fit| fit.time_constant < 0.5 * RISES && fit.residual < 0.25 * fit.steady_speed.abs());
        Ok(Self {
            value,
            peak_angular_speed_rad_per_s: case.peak_angular_speed_rad_per_s,
            statistics,
            predicted_speed_ratio: balance.steady_speed(),
            predicted_stall_acceleration_rad_per_s2: fit
                .map(|fit| case.largest_acceleration() * fit.stall_acceleration()),
            mean_impact_speed_m_per_s: system.scales().velocity * speeds.sum::<f64>() / count,
            mean_impact_interval_s: system.scales().time * impulses.duration / count,
        })
    }

    fn speed_ratio(&self) -> f64 {
        self.statistics.steady_speed_rad_per_s.mean / self.peak_angular_speed_rad_per_s
    }

    fn stall(&self) -> Option<f64> {
        self.statistics.stall_acceleration_rad_per_s2.map(|spread| spread.mean)
    }
}

/// Normal impulse by phase.
#[derive(Debug, Serialize)]
struct ImpulsePhases {
    restitution: f64,
    /// Shares in equal parts of the cycle from τ = −π to π.
    shares: Vec<f64>,
    /// Where in the cycle the normal impulse is concentrated, the collisions that end a flight of more than half a period, and
    /// all collisions up to the paper's cut of a chatter.
    impulse: Option<Concentration>,
    landings: Option<Concentration>,
    collisions: Option<Concentration>,
}

impl ImpulsePhases {
    fn of(case: &MotorCase, impacts: usize) -> Result<Self, ExperimentError> {
        let system = case.system()?;
        let map = system.dimensionless().map();
        let impulses = NormalImpulses::of(map, impacts, BREAKING_PERTURBATION)?;
        let collisions = collisions(map, impacts)?;
        Ok(Self {
            restitution: case.restitution,
            shares: impulses.histogram(PARTS),
            impulse: impulses.concentration(),
            landings: impulses.concentration_of_collisions(),
            collisions: Concentration::of(collisions.into_iter().map(|phase| (phase, 1.0))),
        })
    }
}

/// The phases of the first collisions of a disk from rest, up to the paper's cut of each chatter, with perturbed relaunches.
fn collisions(map: &ImpactMap, count: usize) -> Result<Vec<f64>, ExperimentError> {
    let (mut phases, mut noise) = (Vec::with_capacity(count), Noise::new(RELAUNCH_SEED));
    let Some(leaves) = map.vibration().separation_phase() else { return Ok(phases) };
    let mut orbit = map.orbit_from_launch(Launch::new(leaves, 0.0)?, PAPER_CHATTER);
    while phases.len() < count
        && let Some(event) = orbit.advance()?
    {
        match event {
            OrbitEvent::Impact(impact) => phases.push(impact.phase.angle()),
            _ => orbit.perturb_launch(BREAKING_PERTURBATION * noise.even())?,
        }
    }
    Ok(phases)
}

/// What the claims and the drawing are about.
struct Study {
    motor: MotorCase,
    /// In the order of the panels.
    sweeps: Vec<Sweep>,
    /// The means of the sweeps, and what follows from them.
    varied: [Varied; 5],
    mean: Effects,
    /// Where the impulse falls in the cycle, for three ε.
    impulses: Vec<ImpulsePhases>,
    alike: SingleOrbits,
}

impl Study {
    fn new(
        motor: MotorCase,
        default: &MotorStatistics,
        sweeps: Vec<Sweep>,
        impulses: Vec<ImpulsePhases>,
        alike: SingleOrbits,
    ) -> Result<Self, ExperimentError> {
        let varied = sweeps.iter().map(|Sweep { parameter, points }| {
            let reading = |point: &SweepPoint| {
                Reading::of(point.value, &parameter.set(&motor, point.value), &point.statistics)
            };
            Varied { parameter: *parameter, readings: points.iter().map(reading).collect() }
        });
        let varied: [Varied; 5] = varied
            .collect::<Vec<_>>()
            .try_into()
            .map_err(|_| ExperimentError::NoData { quantity: "sweeps".to_owned() })?;
        let default = Reading::of(0.0, &motor, default);
        let mean = Effects::of(&varied, &default, middle_exponent);
        Ok(Self { motor, sweeps, varied, mean, impulses, alike })
    }

    fn points(&self, parameter: Input<MotorCase>) -> &[SweepPoint] {
        let sweep = self.sweeps.iter().find(|sweep| sweep.parameter == parameter);
        sweep.map_or(&[], |sweep| &sweep.points)
    }

    /// The values of ε and θ at which a mean is above the maximum that ωΦ or μ sets.
    fn beyond_limits(&self) -> Vec<(Input<MotorCase>, f64)> {
        let [_, by_restitution, by_lag, ..] = &self.varied;
        let sweeps = [by_restitution, by_lag].into_iter();
        let readings =
            sweeps.flat_map(|sweep| sweep.readings.iter().map(|reading| (sweep.parameter, reading)));
        let beyond = readings.filter(|(_, reading)| reading.is_within_limits() == Some(false));
        beyond.map(|(parameter, reading)| (parameter, reading.value)).collect()
    }

    fn all_points(&self) -> impl Iterator<Item = &SweepPoint> {
        self.sweeps.iter().flat_map(|sweep| &sweep.points)
    }

    /// The points that no low-period cycle governs.
    fn chaotic(&self, parameter: Input<MotorCase>) -> impl Iterator<Item = &SweepPoint> {
        self.points(parameter).iter().filter(|point| !point.statistics.is_low_period())
    }
}
