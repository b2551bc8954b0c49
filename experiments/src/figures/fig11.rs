//! Fig. 11: steady-state speed and stall torque of the motor against preload.

mod draw;
mod explanations;
mod trends;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::core::run::in_parallel;
use bouncing_disk::motor::{OperatingSettings, TransientSettings};
use serde::Serialize;

use self::trends::{Holes, Trend};
use crate::claims::paper;
use crate::experiment::{ExperimentError, Paper};
use crate::figures::shared::alike::{AlikeMotor, alike_groups};
use crate::figures::shared::inputs::{motor as inputs, with_unit};
use crate::figures::shared::motor::{MotorCase, MotorStatistics, statistics};
use crate::figures::shared::numbers::{Noise, extent};
use crate::figures::shared::stall::{Stall, net_share_at_rest};

/// Duration of a transient in rise times ωΦ a_g²/(μ a_e g): seven time constants or more.
const RISES: f64 = 6.0;

/// Seed of the preloads.
const PRELOAD_SEED: u64 = 46_201;

/// Impacts of the orbit that gives a motor's S(0).
const BALANCED_IMPACTS: usize = 1_500;

/// Motors above the preloads of the trends for each curve beside those drawn: together at least 200 of them
/// at each frequency.
const MORE_ABOVE: u32 = 52;

/// Fig. 11.
pub(crate) fn fig11(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    fig.seed("preloads", PRELOAD_SEED);
    fig.seed("ensembles", TransientSettings::default().seed);
    fig.seed("bouncing motors that print alike", explanations::BOUNCING_SEED);
    fig.seed("runs to stall", OperatingSettings::default().seed);
    let quality = fig.quality;
    let (printed, section) = (paper::preloads()?, paper::section_five()?);
    let motor = MotorCase::table_three()?;
    let mass = section.rotor_mass_kg();
    let inertia = mass * motor.gyration_radius_m * motor.gyration_radius_m;
    let perturbation = TransientSettings::default().relaunch_perturbation;
    // The larger the amplitude, the fewer collisions a transient averages over, and the cheaper it is.
    let members = quality.choose([2, 3, 6], [3, 5, 10]);
    let (count, more) = (quality.choose(20, 112), quality.choose(4, MORE_ABOVE));
    let amplitudes = section.amplitudes_of_fig10_m;
    let [low, high] = printed.measured_range_n.map(|preload| preload / mass);
    let trend_mn = printed.measured_range_n.map(|preload| 1e3 * preload);
    let three_preloads = [low, 0.5 * (low + high), high];
    let curves = amplitudes.len() + three_preloads.len();
    fig.progress.start((printed.frequencies_hz.len() * curves) as u64, "curves");

    // At each frequency and amplitude motors over the range of preloads, and further ones above those of the trends.
    let mut noise = Noise::new(PRELOAD_SEED);
    let (mut groups, mut ensembles) = (Vec::new(), Vec::new());
    let [first, last] = printed.preload_accelerations_m_per_s2;
    for frequency_hz in printed.frequencies_hz {
        for (amplitude_m, members) in amplitudes.into_iter().zip(members) {
            let of_curve = MotorCase { frequency_hz, amplitude_m, ..motor };
            for (from, count) in [(first, count), (high, more)] {
                let preloads = preloads([from, last], count, &mut noise);
                let with = |preload| inputs::PRELOAD_ACCELERATION.set(&of_curve, preload);
                let cases: Vec<MotorCase> = preloads.map(with).collect();
                ensembles.extend(cases.iter().map(|case| (*case, members, perturbation)));
                groups.push(cases);
            }
        }
    }
    let singles = alike_groups(&groups, RISES)?.into_iter().flat_map(|group| group.0);
    let mut motors = singles.zip(statistics(&ensembles, RISES)?);
    let mut points = |cases: &[MotorCase]| {
        let computed: Vec<_> = motors.by_ref().take(cases.len()).collect();
        let point = |k: usize| Point::of(&cases[k], &computed[k], mass, perturbation);
        in_parallel(cases.len(), point).into_iter().collect::<Result<Vec<Point>, ExperimentError>>()
    };
    let mut curves = Vec::new();
    for pair in groups.chunks_exact(2) {
        let MotorCase { frequency_hz, amplitude_m, .. } = pair[0][0];
        let (points, further) = (points(&pair[0])?, points(&pair[1])?);
        curves.push(Curve { frequency_hz, amplitude_m, points, further });
        fig.progress.advance(1);
    }

    // The load that really stalls the default motor, at three preloads of the trends.
    let at = |frequency_hz: f64| {
        three_preloads
            .map(|preload| inputs::PRELOAD_ACCELERATION.set(&MotorCase { frequency_hz, ..motor }, preload))
    };
    let cases = printed.frequencies_hz.map(at).concat();
    let stalls = Stall::of_each(&cases, quality.choose(4, 8), perturbation)?;
    let stalls: Vec<StallAt> = cases
        .iter()
        .zip(stalls)
        .map(|(case, stall)| StallAt {
            frequency_hz: case.frequency_hz,
            preload_mn: 1e3 * mass * case.preload_acceleration_m_per_s2,
            stall,
        })
        .collect();
    fig.progress.advance(stalls.len() as u64);

    let plateau_mn = 1e3 * printed.plateau_n;
    let of_curve: Vec<Trend> = curves.iter().map(|curve| Trend::of(curve, trend_mn, plateau_mn)).collect();
    let holes = Holes::of(&curves);
    fig.claims(trends::claims(&of_curve, printed.frequencies_hz, plateau_mn));
    let reduced_twist = explanations::ReducedTwist::of(&motor, quality, perturbation)?;
    fig.claim(reduced_twist.claim());
    let end_of_bouncing = explanations::EndOfBouncing::of(&motor)?;
    fig.claim(end_of_bouncing.claim());

    let per_curve = curves.first().map_or(0, |curve| curve.points.len());
    fig.caption(format!(
        "Effect of preload on steady-state speed and stall torque at (a), (b) {} and (c), (d) {} kHz, where the motor turns anticlockwise (positive \
         speeds). Dots: means of {}, {} and {} members at the three A, some with standard deviations; circles: {} motors on \
         low-period cycles, {} of one flight. Squares: the load that really stalls the motor at A = 10⁻⁸ m. Blue: 5 to 95 % of unperturbed \
         orbits. The paper prints no measured points and no pairing of g and A.",
        motor.frequency_hz / 1e3,
        printed.frequencies_hz[1] / 1e3,
        members[0],
        members[1],
        members[2],
        holes.low_period,
        holes.one_flight,
    ));
    fig.parameters(motor.shared_inputs());
    for input in [inputs::CONTACT_RADIUS, inputs::GYRATION_RADIUS] {
        fig.parameters([input.row(&motor)]);
    }
    fig.parameter("rotor mass", with_unit(&format!("{mass:.5}"), "kg"));
    fig.parameter("preloads", per_curve);
    fig.parameter("seed of the preloads", PRELOAD_SEED);
    fig.parameter("members by amplitude", members.map(|count| count.to_string()).join(", "));
    fig.parameter("duration", format!("{RISES} ωΦ a_g²/(μ a_e g)"));
    fig.parameter("relaunch perturbation", format!("{perturbation} g/ω"));
    fig.parameters([MotorCase::contact_row(curves.iter().flat_map(|curve| {
        let case = MotorCase { frequency_hz: curve.frequency_hz, amplitude_m: curve.amplitude_m, ..motor };
        [first, last].map(|preload| inputs::PRELOAD_ACCELERATION.set(&case, preload))
    }))]);
    fig.draw(draw::draw(&draw::Drawn { curves: &curves, stalls: &stalls, printed: &printed, mass, inertia }));

    // α̇_ss/t_c over (μ a_e g/a_g²) S(0): the least and the most between the preloads of the trends, and the mean.
    let over_balance = estimates_over_balance(&curves, &motor, [low, high]);
    let (least, most) = extent(over_balance.iter().copied());
    fig.record("estimate_over_balance", &[least, most])?;
    fig.record(
        "mean_estimate_over_balance",
        &(over_balance.iter().sum::<f64>() / over_balance.len() as f64),
    )?;
    fig.record("motor", &motor)?;
    fig.record("printed", &printed)?;
    fig.record("rotor_mass_kg", &mass)?;
    fig.record("members", &members)?;
    fig.record("rises", &RISES)?;
    fig.record("relaunch_perturbation", &perturbation)?;
    fig.record("preload_seed", &PRELOAD_SEED)?;
    fig.record("curves", &curves)?;
    fig.record("trends", &of_curve)?;
    fig.record("holes", &holes)?;
    fig.record("stalls", &stalls)?;
    fig.record("reduced_twist", &reduced_twist)?;
    fig.record("end_of_bouncing", &end_of_bouncing)
}

/// Preload accelerations over a range: its equal parts, and in each of them one, drawn evenly. Which values
/// the authors took is not printed, and a motor's orbit depends on it; a regular grid could meet or miss the
/// preloads at which the motor is on a short cycle.
fn preloads([first, last]: [f64; 2], count: u32, noise: &mut Noise) -> impl Iterator<Item = f64> {
    (0..count).map(move |index| first + (last - first) * (f64::from(index) + noise.even()) / f64::from(count))
}

/// One amplitude at one frequency.
#[derive(Debug, Serialize)]
struct Curve {
    frequency_hz: f64,
    amplitude_m: f64,
    points: Vec<Point>,
    /// Further motors above the preloads of the trends, which are not drawn: the statements about them shall
    /// rest on enough.
    further: Vec<Point>,
}

/// One preload.
#[derive(Clone, Copy, Debug, Serialize)]
struct Point {
    preload_acceleration_m_per_s2: f64,
    preload_mn: f64,
    axial_forcing: f64,
    statistics: MotorStatistics,
    /// S(0): the share of the normal impulse that pushes a rotor held at rest forwards, minus the rest.
    net_share_at_rest: f64,
    /// Steady speed (rad/s) of one orbit that nothing perturbs.
    single_speed_rad_per_s: f64,
    /// Its α̇_ss/t_c (rad/s²), if its speed settles.
    single_stall_rad_per_s2: Option<f64>,
}

impl Point {
    fn of(
        case: &MotorCase,
        (single, statistics): &(AlikeMotor, MotorStatistics),
        mass: f64,
        relaunch_perturbation: f64,
    ) -> Result<Self, ExperimentError> {
        let preload = case.preload_acceleration_m_per_s2;
        Ok(Self {
            preload_acceleration_m_per_s2: preload,
            preload_mn: 1e3 * mass * preload,
            axial_forcing: case.system()?.axial_forcing(),
            statistics: *statistics,
            net_share_at_rest: net_share_at_rest(case, BALANCED_IMPACTS, relaunch_perturbation)?,
            single_speed_rad_per_s: single.steady_speed_rad_per_s,
            single_stall_rad_per_s2: single.stall_over_limit.map(|share| share * case.largest_acceleration()),
        })
    }
}

/// The stall load at one preload.
#[derive(Clone, Copy, Debug, Serialize)]
struct StallAt {
    frequency_hz: f64,
    preload_mn: f64,
    stall: Stall,
}

/// α̇_ss/t_c over (μ a_e g/a_g²) S(0) of the motors between two preloads that are on no low-period cycle.
fn estimates_over_balance(curves: &[Curve], motor: &MotorCase, [low, high]: [f64; 2]) -> Vec<f64> {
    curves
        .iter()
        .flat_map(|curve| &curve.points)
        .filter(|point| point.preload_acceleration_m_per_s2 >= low)
        .filter(|point| point.preload_acceleration_m_per_s2 <= high && !point.statistics.is_low_period())
        .filter_map(|point| {
            let estimate = point.statistics.stall_acceleration_rad_per_s2?.mean;
            let preload = point.preload_acceleration_m_per_s2;
            let limit = inputs::PRELOAD_ACCELERATION.set(motor, preload).largest_acceleration();
            Some(estimate / (limit * point.net_share_at_rest))
        })
        .collect()
}
