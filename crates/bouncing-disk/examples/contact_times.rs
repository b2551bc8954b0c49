//! The paper's motor with compliant contacts: the tables of docs/contacts-and-stators.md.
//!
//! A rotor with little friction in each contact ends at the speed at which the force of the contact pushes it forwards as
//! much as backwards (`NormalImpulses::of_contact`).
//!
//!     cargo run --release -p bouncing-disk --example contact_times
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, FRAC_PI_4, PI, TAU};

use bouncing_disk::core::numerics::roots::bisection;
use bouncing_disk::core::numerics::statistics::{mean, standard_deviation};
use bouncing_disk::core::{Error as CoreError, ImpactMap, ImpactState, Phase, Unobserved, Vibration};
use bouncing_disk::drives::{Drive, DrivenMap};
use bouncing_disk::motor::{Estimate, NormalImpulses, OperatingSettings, Operation};
use bouncing_disk::parameters::{Contact, Geometry};
use bouncing_disk::{Error, Motor, System};

/// Preloads over the mass (m/s²): 33, 82, 164, 200, 280 and 329 mN.
const PRELOADS: [f64; 6] = [1.0, 2.5, 5.0, 6.1, 8.5, 10.0];

/// Periods after which a rotor from rest is tapped in every one, if ever, and those that are then followed: of a rotor that
/// is tapped, and of one that flies for many of them.
const SETTLING: usize = 10_000;
const TAPPED: usize = 200;
const FLOWN: usize = 40_000;

/// A platform with these Γ and restitution, and a contact time over the period.
fn map(forcing: f64, restitution: f64, time: f64) -> Result<DrivenMap, CoreError> {
    DrivenMap::new(Drive::fourier(&[(PI * forcing, 0.0)])?, restitution)?.with_contact_time(TAU * time)
}

/// The impulses of a rotor from rest, once it is tapped in every period or over many flights; of rigid impacts without a
/// contact time.
fn impulses(system: &System, forcing: f64, time: Option<f64>) -> Result<NormalImpulses, Error> {
    let restitution = system.disk().restitution();
    let Some(time) = time else {
        let rigid = ImpactMap::new(Vibration::from_axial_forcing(forcing)?, restitution)?;
        return NormalImpulses::of(&rigid, 4_000, 1e-3);
    };
    let map = map(forcing, restitution, time)?;
    let platform = map.compliant().expect("a compliant contact");
    let tapped = NormalImpulses::of_contact(platform, SETTLING, TAPPED)?;
    let flies = tapped.duration > TAU && 2 * tapped.landings.len() < TAPPED;
    if flies { NormalImpulses::of_contact(platform, SETTLING, FLOWN) } else { Ok(tapped) }
}

fn name(time: Option<f64>) -> String {
    time.map_or_else(|| "rigid".to_owned(), |time| format!("{time:.1}"))
}

/// The contact times of the ball on the edge of its stator (least and most) and on a plane, over the period.
fn ball(motor: &Motor) -> Result<[f64; 3], Error> {
    let plane = Contact { geometry: Some(Geometry::Plane), ring_radius: None, ..Contact::PAPER };
    let times = |contact| {
        let report = motor.with(|sheet| sheet.contact = Some(contact))?.report(&Unobserved)?;
        let contact = report.contact.and_then(|contact| contact.time_over_period);
        Ok::<_, Error>(contact.expect("materials and sizes give a contact time"))
    };
    let ([least, most], [_, plane]) = (times(Contact::PAPER)?, times(plane)?);
    Ok([least, most, plane])
}

/// The motion, the mean phase of the force and the speeds, over those of the stator.
fn motions(motor: &Motor) -> Result<(), Error> {
    let system = motor.system();
    for time in [None, Some(0.5), Some(1.0)].into_iter().chain(ball(motor)?.map(Some)) {
        let impulses = impulses(system, system.axial_forcing(), time)?;
        let speed = |lag: f64| impulses.balance(lag).steady_speed();
        let lags = (0..120).map(|k| PI * (f64::from(k) / 60.0 - 1.0));
        let best = lags.max_by(|one, other| speed(*one).total_cmp(&speed(*other))).expect("many");
        let touches = impulses.landings.len() as f64 * TAU / impulses.duration;
        let force = impulses.concentration().expect("it touches").mean_direction_rad;
        println!(
            "| {} | {} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} |",
            name(time),
            if touches > 0.9 { "tapped" } else { "long flights" },
            force * FRAC_1_PI,
            best * FRAC_1_PI,
            speed(0.0),
            speed(-FRAC_PI_2),
            speed(best),
        );
    }
    Ok(())
}

/// A speed (rad/s) and its standard error, rounded up.
fn cell(speed: Estimate) -> String {
    format!("{:.2} ± {:.2}", speed.value, (100.0 * speed.standard_error).ceil().max(1.0) / 100.0)
}

/// Speeds at lags of 0 and -π/2 with this contact time over the period, as `bouncing-disk motor curve` finds them.
fn speeds(motor: &Motor, time: f64) -> Result<(), Error> {
    let period = TAU / motor.system().platform().angular_frequency();
    let settings = OperatingSettings {
        members: 4,
        relative_error: 0.02,
        most_impacts: 4_000_000,
        ..OperatingSettings::default()
    };
    let speed = |lag: f64| {
        let contact = Contact::lasting(time * period);
        let soft = motor.with(|sheet| (sheet.phase_lag, sheet.contact) = (lag, Some(contact)))?;
        match soft.torque_speed_curve(&[0.0], &settings, &Unobserved)?[0].operation() {
            Operation::Steady(point) => Ok(cell(point.speed)),
            other => Ok::<_, Error>(format!("{other:?}")),
        }
    };
    println!("| {time} | {} | {} |", speed(0.0)?, speed(-FRAC_PI_2)?);
    Ok(())
}

/// Speeds at the same lags of rotors that still fly, from starts that differ by the last digits of Γ.
fn flights(motor: &Motor) -> Result<(), Error> {
    const PERIODS: usize = 10_000;
    let (system, time) = (motor.system(), 0.6);
    let mut histories = Vec::new();
    for k in 1..=32 {
        let forcing = system.axial_forcing() * (1.0 + 1e-9 * f64::from(k));
        let map = map(forcing, system.disk().restitution(), time)?;
        let own = NormalImpulses::of_contact(map.compliant().expect("a compliant contact"), 500, PERIODS)?;
        // A rotor that is tapped has a landing in each period.
        if own.landings.len() < PERIODS / 5 {
            histories.push(own);
        }
    }
    let speed = |lag: f64| {
        let unit = system.platform().peak_angular_speed();
        let speeds: Vec<f64> = histories.iter().map(|own| unit * own.balance(lag).steady_speed()).collect();
        let standard_error = standard_deviation(&speeds) / (speeds.len() as f64).sqrt();
        cell(Estimate { value: mean(&speeds), standard_error })
    };
    println!("| {time}, flights | {} | {} |", speed(0.0), speed(-FRAC_PI_2));
    Ok(())
}

/// Speeds over those of the stator at the preloads, and the torque at standstill at 329 mN over that at 200 mN.
fn over_preload(motor: &Motor, times: &[Option<f64>], lags: &[(&str, f64)]) -> Result<(), Error> {
    let system = motor.system();
    for time in times {
        let forcing = |preload: f64| system.axial_forcing() * system.disk().preload_acceleration() / preload;
        let at = PRELOADS.iter().map(|preload| impulses(system, forcing(*preload), *time));
        let at = at.collect::<Result<Vec<_>, _>>()?;
        for (lag_name, lag) in lags {
            let cell = |index: usize| format!("{:.2}", at[index].balance(*lag).steady_speed());
            let torque = |index: usize| PRELOADS[index] * at[index].balance(*lag).net_share(0.0);
            let speeds = [0, 1, 2, 4, 5].map(cell).join(" | ");
            println!("| {} | {lag_name} | {speeds} | {:.2} |", name(*time), torque(5) / torque(3));
        }
    }
    Ok(())
}

/// The contact time over the period at which the orbit of one tap in every period loses its stability.
fn doubling(motor: &Motor) -> Result<(), Error> {
    let (forcing, restitution) = (motor.system().axial_forcing(), motor.system().disk().restitution());
    let guess = [ImpactState::new(Phase::new(1.64)?, -0.26 * forcing / restitution)?];
    let is_unstable = |time| {
        let orbit = map(forcing, restitution, time)?.refine(&guess)?;
        Ok::<_, CoreError>(orbit.multipliers().spectral_radius() > 1.0)
    };
    println!("stability at T_c/T = {:.4} by a doubling", bisection(0.5, 0.6, 40, is_unstable)?);
    Ok(())
}

fn main() -> Result<(), Error> {
    let (slow, fast) = (Motor::paper_70_khz(), Motor::paper_184_khz());
    motions(&slow)?;
    speeds(&slow, 1.0)?;
    flights(&slow)?;
    doubling(&slow)?;
    let [least, most, plane] = ball(&slow)?.map(Some);
    let lags = [("0", 0.0), ("−π/4", -FRAC_PI_4), ("−π/2", -FRAC_PI_2)];
    over_preload(&slow, &[None], &lags[..2])?;
    over_preload(&slow, &[least, most, plane], &lags)?;
    over_preload(&fast, &ball(&fast)?.map(Some), &lags[..1])
}
