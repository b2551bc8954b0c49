//! How far a disk goes, where it gets its angular momentum, how many numbers its next collision depends on, and what Γ_T
//! compares.

use std::f64::consts::TAU;

use bouncing_disk::core::{ChatterPolicy, ImpactState, Phase};
use bouncing_disk::motion::{Mode, PAPER_CHATTER};
use bouncing_disk::parameters::DimensionlessSystem;
use bouncing_disk::toss::{CollisionEvent, CollisionState, Collisions};
use bouncing_disk::{Engine, Event, EventRecord, InitialCondition, System};
use serde::Serialize;

use super::diagram::{Diagram, Inputs, sampled, start};
use super::{SAMPLED, no_orbit};
use crate::claims::{Cases, Claim, all, any, paper};
use crate::experiment::{ExperimentError, Paper};
use crate::figures::shared::map_in_parallel;
use crate::figures::shared::motor::MotorCase;
use crate::figures::shared::numbers::extent;
use crate::figures::shared::toss::TossCase;

/// Impacts of a long motion.
const LONG: usize = 4_000;
/// Restitutions other than the diagram's: nearly elastic ones.
const NEARLY_ELASTIC: [f64; 2] = [0.9, 0.99];

/// A long motion.
#[derive(Serialize)]
struct Motion {
    axial_forcing: f64,
    restitution: f64,
    /// Largest height of the disk, in amplitudes of the platform; by energy no disk can ever rise higher than the bound.
    highest: f64,
    height_bound: f64,
    /// Angle turned in each half of the impacts, in amplitudes Φ.
    turned_in_first_half: f64,
    turned_in_second_half: f64,
}

/// No impact is faster than this, relative to the platform: between two impacts the disk falls by no more
/// than the platform's 2P, and the platform moves with no more than P. In units of g/ω.
fn speed_bound(peak: f64, restitution: f64) -> f64 {
    let mut speed = 0.0_f64;
    // A contraction by the restitution.
    for _ in 0..10_000 {
        let launched = restitution * speed + peak;
        speed = (launched * launched + 4.0 * peak).sqrt() + peak;
    }
    speed
}

/// From rest.
fn motion(axial_forcing: f64, system: &DimensionlessSystem) -> Result<Motion, ExperimentError> {
    let peak = system.peak_acceleration();
    let mut collisions = Collisions::new(*system, start(system, None, true)?, ChatterPolicy::Complete)?;
    let (mut angles, mut highest) = (Vec::with_capacity(LONG), peak);
    while angles.len() < LONG {
        let Some(event) = collisions.advance()? else { break };
        let CollisionEvent::Collision(collision) = event else { continue };
        let phase = collision.state.phase;
        let launched = -system.restitution() * collision.state.axial_impact_velocity + peak * phase.cos();
        let rise = if launched > 0.0 { 0.5 * launched * launched } else { 0.0 };
        highest = highest.max(peak * phase.sin() + rise);
        angles.push(collision.angle);
    }
    let angle = |impact: usize| angles.get(impact).copied().ok_or_else(|| no_orbit(axial_forcing));
    let (first, half, last) = (angle(0)?, angle(LONG / 2 - 1)?, angle(LONG - 1)?);
    let launched = system.restitution() * speed_bound(peak, system.restitution()) + peak;
    Ok(Motion {
        axial_forcing,
        restitution: system.restitution(),
        highest: highest / peak,
        height_bound: (peak + 0.5 * launched * launched) / peak,
        turned_in_first_half: (half - first) / system.twist_speed(),
        turned_in_second_half: (last - half) / system.twist_speed(),
    })
}

/// The statements of Sec. I about the vertical and the rotary motion: motions from rest at the Γ of Fig. 7, at the diagram's
/// restitution and nearly elastic.
pub(super) fn motions(fig: &mut Paper<'_>, inputs: Inputs, forcings: &[f64]) -> Result<(), ExperimentError> {
    let restitutions = [inputs.restitution, NEARLY_ELASTIC[0], NEARLY_ELASTIC[1]];
    let cases: Vec<(f64, f64)> =
        forcings.iter().flat_map(|forcing| restitutions.map(|restitution| (*forcing, restitution))).collect();
    let motions = map_in_parallel(&cases, |&(axial_forcing, restitution)| {
        let system = Inputs { restitution, ..inputs }.system(axial_forcing, inputs.semielliptical)?;
        motion(axial_forcing, &system)
    })?;
    fig.claim(Claim::printed_statement(
        "section1.displacement_bounded",
        all(&motions, |motion| motion.highest <= motion.height_bound),
        format!(
            "{} motions from rest at the Γ of Fig. 7, restitutions {} to {}: at most {:.2} of the height that energy allows for ever",
            motions.len(),
            inputs.restitution,
            NEARLY_ELASTIC[1],
            extent(motions.iter().map(|motion| motion.highest / motion.height_bound)).1,
        ),
    ));
    let goes_on = |motion: &Motion| {
        let (first, second) = (motion.turned_in_first_half, motion.turned_in_second_half);
        // As far again in the second half, and far more than the platform's own 2Φ.
        first * second > 0.0 && second.abs() > 0.5 * first.abs() && second.abs() > 100.0
    };
    fig.claim(Claim::printed_statement(
        "section1.unbounded_rotation",
        any(&motions, goes_on),
        format!(
            "with θ and Γ_T of (d) up to {:.0} Φ in the second half of the impacts, and as far in the first",
            extent(motions.iter().map(|motion| motion.turned_in_second_half.abs())).1
        ),
    ));
    fig.record("motions", &motions)
}

/// Impacts over which the angular impulses are added up, from a disk that does not turn: once it turns in
/// step with the platform, nothing is transferred in period 1.
const TRANSFERS: usize = 600;
/// Parts into which a segment on the platform is divided: the impulse of friction may change its sign within
/// a segment.
const PARTS: usize = 16;

/// The angular impulses of an orbit, by size, and what of them is transferred in impacts.
#[derive(Serialize)]
struct Transfer {
    axial_forcing: f64,
    angular_forcing: f64,
    /// Whether it is the orbit from rest, or the followed attractor.
    from_rest: bool,
    /// Share of the impulses that impacts transfer, those of a chatter included.
    share_in_impacts: f64,
}

/// The share of the angular impulses, by size, that impacts transfer; `None` where there are none.
fn share_in_impacts(
    system: &DimensionlessSystem,
    start: InitialCondition,
) -> Result<Option<f64>, ExperimentError> {
    let mut engine = Engine::new(*system, start, PAPER_CHATTER)?;
    let (mut impacts, mut impulsive, mut contact) = (0, 0.0, 0.0);
    while impacts < TRANSFERS {
        let Some(record) = engine.advance()? else { break };
        impacts += usize::from(matches!(record.event, Event::Impact { .. }));
        impulsive += record.angular_impulse.abs();
        contact += turned_in_contact(&record, system);
    }
    let all = impulsive + contact;
    Ok((all > 0.0).then(|| impulsive / all))
}

/// The sum of the sizes of the changes of angular speed on the platform; zero in flight.
fn turned_in_contact(record: &EventRecord, system: &DimensionlessSystem) -> f64 {
    let speed = |part: usize| record.evaluate(system, part as f64 / PARTS as f64).disk.angular_speed;
    if record.segment.state.mode == Mode::Flight {
        return 0.0;
    }
    (0..PARTS).map(|part| (speed(part + 1) - speed(part)).abs()).sum()
}

/// Both rotary motions, of the followed attractor and of a disk from rest, evenly over the diagram.
pub(super) fn transfers(fig: &mut Paper<'_>, diagram: &Diagram) -> Result<(), ExperimentError> {
    let followed = sampled(SAMPLED, &diagram.states());
    let followed = followed.into_iter().map(|(forcing, state)| (forcing, Some(state)));
    let resting = sampled(SAMPLED, &diagram.resting()).into_iter().map(|forcing| (forcing, None));
    let starts: Vec<(f64, Option<ImpactState>)> = followed.chain(resting).collect();
    let transfers = map_in_parallel(&starts, |&(axial_forcing, state)| {
        let transfer = |twist| -> Result<_, ExperimentError> {
            let system = diagram.inputs.system(axial_forcing, twist)?;
            let share = share_in_impacts(&system, start(&system, state, false)?)?;
            let (angular_forcing, from_rest) = (twist.angular_forcing, state.is_none());
            Ok(share.map(|share_in_impacts| Transfer {
                axial_forcing,
                angular_forcing,
                from_rest,
                share_in_impacts,
            }))
        };
        let [linear, semielliptical] = diagram.inputs.twists().map(transfer);
        Ok([linear?, semielliptical?])
    })?;
    let transfers: Vec<Transfer> = transfers.into_iter().flatten().flatten().collect();
    let motor = MotorCase::table_three()?.system()?;
    let motor = share_in_impacts(motor.dimensionless(), start(motor.dimensionless(), None, false)?)?;
    // The attractor transfers all of it in impacts, by its choice: the orbits from rest decide.
    let from_rest: Vec<f64> =
        transfers.iter().filter(|of| of.from_rest).map(|of| of.share_in_impacts).collect();
    let mean = (!from_rest.is_empty()).then(|| from_rest.iter().sum::<f64>() / from_rest.len() as f64);
    let (least, most) = extent(transfers.iter().map(|of| of.share_in_impacts));
    fig.claim(Claim::printed_statement(
        "section4.transfer_in_impacts",
        mean.map_or_else(Cases::default, Cases::of_share),
        format!(
            "{:.3} of all angular impulses, by size, on average over the orbits from rest, {least:.3} to {most:.3} by orbit; {:.3} in the motor of Table III",
            mean.unwrap_or(f64::NAN),
            motor.unwrap_or(f64::NAN),
        ),
    ));
    fig.record("transfers", &transfers)?;
    fig.record("motor_share_in_impacts", &motor)
}

/// Γ_T beside the torques.
#[derive(Serialize)]
struct TorqueRatio {
    system: &'static str,
    angular_forcing: f64,
    /// The torque that gives the disk the platform's largest angular acceleration, over the frictional torque
    /// of the preload.
    ratio: f64,
}

/// The inertial and the frictional torque of a disk that follows the platform under its preload.
fn torque_ratio(name: &'static str, system: &System) -> Result<TorqueRatio, ExperimentError> {
    let (disk, platform) = (system.disk(), system.platform());
    // Per unit mass: a_g² times the largest angular acceleration, and μ a_e g.
    let inertial = disk.gyration_radius()
        * disk.gyration_radius()
        * platform.parameters().angular_frequency
        * platform.peak_angular_speed();
    let frictional = disk.friction() * disk.contact_radius() * disk.preload_acceleration();
    let angular_forcing = system.angular_forcing().ok_or_else(|| no_orbit(system.axial_forcing()))?;
    Ok(TorqueRatio { system: name, angular_forcing, ratio: inertial / frictional })
}

pub(super) fn torques(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    let toss = TossCase::from(&paper::table_one()?).system()?;
    let motor = MotorCase::table_three()?.system()?;
    let ratios =
        [torque_ratio("the toss of Table I", &toss)?, torque_ratio("the motor of Table III", &motor)?];
    let words = ratios
        .each_ref()
        .map(|of| format!("{}, Γ_T = {:.4e} and a ratio of {:.4e}", of.system, of.angular_forcing, of.ratio));
    fig.claim(Claim::printed_statement(
        "section4.meaning_of_angular_forcing",
        all(&ratios, |of| of.ratio.total_cmp(&of.angular_forcing).is_eq()),
        format!("the ratio of torques is π Γ_T: {}", words.join("; ")),
    ));
    fig.record("torque_ratios", &ratios)
}

/// Relative change of a parameter (of the phase lag, in rad): its square, the error of a central difference, and the rounding
/// that it divides are both far below [`DEPENDENT`].
const CHANGE: f64 = 1.0e-5;
/// A diagonal element of a QR decomposition with exchanges counts as zero below this share of the largest one: independent rows
/// leave ten thousand times as much, dependent ones a hundredth.
const DEPENDENT: f64 = 0.5e-6;
/// The phase (rad), w_A/(ωA) and w_T/(ωΦ) of the impacts that are mapped: no special ones, slow and fast, forward and backward, in
/// which the slip ends (the first and the last) or goes on (the others).
const IMPACTS: [(f64, f64, f64); 4] =
    [(0.3, -0.9, 0.4), (1.2, -0.5, -6.0), (5.9, -0.6, 5.0), (0.7, -2.3, -2.1)];
/// The name of an input, and how it changes by a share (the phase lag by radians).
type Input = (&'static str, fn(&mut MotorCase, f64));
/// The nine inputs of Sec. V A.
const INPUTS: [Input; 9] = [
    ("a_g", |case, change| case.gyration_radius_m *= 1.0 + change),
    ("a_e", |case, change| case.contact_radius_m *= 1.0 + change),
    ("ω", |case, change| case.frequency_hz *= 1.0 + change),
    ("g", |case, change| case.preload_acceleration_m_per_s2 *= 1.0 + change),
    ("μ", |case, change| case.friction *= 1.0 + change),
    ("ε", |case, change| case.restitution *= 1.0 + change),
    ("A", |case, change| case.amplitude_m *= 1.0 + change),
    ("ωΦ", |case, change| case.peak_angular_speed_rad_per_s *= 1.0 + change),
    ("θ", |case, change| case.phase_lag_rad += change),
];

/// The impacts that follow [`IMPACTS`], in the same units.
fn next_collisions(case: MotorCase) -> Result<Vec<f64>, ExperimentError> {
    let system: DimensionlessSystem = case.system()?.try_into()?;
    let (peak, twist) = (system.peak_acceleration(), system.twist_speed());
    let mut outcomes = Vec::with_capacity(3 * IMPACTS.len());
    for (angle, axial, tangential) in IMPACTS {
        let state = CollisionState {
            phase: Phase::new(angle)?,
            axial_impact_velocity: axial * peak,
            tangential_impact_velocity: tangential * twist,
        };
        let mut collisions = Collisions::after(system, state, ChatterPolicy::Complete)?;
        let Some(CollisionEvent::Collision(next)) = collisions.advance()? else {
            return Err(no_orbit(system.axial_forcing()));
        };
        outcomes.extend([
            TAU * next.time.cycles(),
            next.state.axial_impact_velocity / peak,
            next.state.tangential_impact_velocity / twist,
        ]);
    }
    Ok(outcomes)
}

/// The rank of the derivatives of the next collisions by the nine inputs, at the toss of Table I as a motor of those inputs, if w_A is
/// in units of ωA and w_T in units of ωΦ.
pub(super) fn dimension(fig: &mut Paper<'_>, inputs: Inputs) -> Result<(), ExperimentError> {
    let toss = TossCase::from(&paper::table_one()?);
    let platform = toss.system()?;
    let case = MotorCase {
        friction: toss.friction,
        restitution: inputs.restitution,
        phase_lag_rad: inputs.semielliptical.phase_lag_rad,
        amplitude_m: platform.platform().parameters().amplitude,
        peak_angular_speed_rad_per_s: platform.platform().peak_angular_speed(),
        contact_radius_m: toss.contact_radius_m,
        gyration_radius_m: toss.gyration_radius_m,
        preload_acceleration_m_per_s2: toss.preload_acceleration_m_per_s2,
        frequency_hz: toss.angular_frequency_rad_per_s / TAU,
    };
    let mut derivatives = Vec::new();
    for (_, change) in INPUTS {
        let [above, below] = [CHANGE, -CHANGE].map(|size| {
            let mut changed = case;
            change(&mut changed, size);
            next_collisions(changed)
        });
        derivatives
            .push(above?.iter().zip(&below?).map(|(above, below)| above - below).collect::<Vec<f64>>());
    }
    let outcomes = derivatives[0].len();
    let rank = rank(derivatives);
    fig.claim(Claim::printed("section4.map_parameters", rank as f64).note(format!(
        "rank of the derivatives of {outcomes} numbers of the next collisions by the {} inputs of a system in SI units",
        INPUTS.len(),
    )));
    fig.record("dimension", &Dimension { parameters: INPUTS.map(|(name, _)| name), outcomes, rank })
}

/// How many rows are independent: the largest row is taken out of the others, as in a QR decomposition with exchanges, until
/// nothing is left.
fn rank(mut rows: Vec<Vec<f64>>) -> usize {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (mut rank, mut first) = (0, None);
    while let Some((largest, square)) =
        rows.iter().map(|row| dot(row, row)).enumerate().max_by(|a, b| a.1.total_cmp(&b.1))
    {
        if square <= DEPENDENT * DEPENDENT * *first.get_or_insert(square) {
            break;
        }
        let pivot = rows.swap_remove(largest);
        for row in &mut rows {
            let along = dot(row, &pivot) / square;
            row.iter_mut().zip(&pivot).for_each(|(entry, pivot)| *entry -= along * pivot);
        }
        rank += 1;
    }
    rank
}

/// How many numbers the next collision depends on.
#[derive(Serialize)]
struct Dimension {
    /// Parameters of the system in SI units that are changed one by one.
    parameters: [&'static str; 9],
    /// Number of outputs whose derivatives are taken.
    outcomes: usize,
    /// Rank of the matrix of derivatives.
    rank: usize,
}

#[cfg(test)]
mod tests {
    use super::{DEPENDENT, rank};

    #[test]
    fn the_rank_is_that_of_a_qr_decomposition_with_exchanges() {
        let dependent = vec![vec![1.0, 0.0, 2.0], vec![0.0, 3.0, 0.0], vec![2.0, 3.0, 4.0]];
        let independent: Vec<Vec<f64>> =
            (1..=5).map(|row| (1..=7).map(|place| f64::from(row * place * place % 11)).collect()).collect();
        for (rows, expected) in [(dependent, 2), (independent, 5)] {
            let matrix = faer::Mat::from_fn(rows[0].len(), rows.len(), |place, row: usize| rows[row][place]);
            let decomposition = matrix.col_piv_qr();
            let triangle = decomposition.thin_R();
            let size = |index| triangle[(index, index)].abs();
            let independent = (0..rows.len()).filter(|index| size(*index) > DEPENDENT * size(0)).count();
            assert_eq!((rank(rows), independent), (expected, expected));
        }
    }
}
