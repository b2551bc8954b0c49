//! Beyond the paper: contacts that take time, and which of two schools is right for which motor.
//! `docs/contacts-that-take-time.md` is its chapter.

mod compute;
mod draw;

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;
use serde::{Deserialize, Serialize};

use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Ends of the map: contact time over the period, and Γ.
const CONTACT_TIMES: (f64, f64) = (0.05, 20.0);
const FORCINGS: (f64, f64) = (0.3, 1_000.0);

/// Contact times over the period in which flights and taps follow each other.
const TRANSITION: (f64, f64) = (0.45, 0.95);

/// Preloads (m/s²), amplitudes (m) and restitutions of the paper's figures.
const PRELOADS: (f64, f64) = (0.1, 10.0);
const AMPLITUDES: (f64, f64) = (1e-9, 1e-7);
const RESTITUTIONS: (f64, f64) = (0.1, 0.9);

/// Phase lags of the curves.
const LAGS: [f64; 3] = [0.0, -FRAC_PI_4, -FRAC_PI_2];

/// Of all random starts.
const SEED: u64 = 1;

/// Contacts that take time.
#[derive(Debug)]
pub struct ExtraContact;

/// The data of the contacts that take time.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraContactData {
    /// Of Table III.
    axial_forcing: f64,
    restitution: f64,
    mass_kg: f64,
    /// The contact time of the paper's ball on the edge of its stator, and on a plane, over the period.
    ring: [f64; 2],
    plane: [f64; 2],
    cells: Cells,
    transition: Transition,
    lives: Vec<Lives>,
    /// Over the contact time over the period, by restitution and law.
    over_time: Vec<Curve>,
    /// Run-ups as in Fig. 10.
    runs: Vec<Run>,
    /// By contact time over the period: over the preload (m/s²) as in Fig. 11, and over phase lag (rad),
    /// restitution and amplitude (m) as in Fig. 13.
    over_preload: Vec<Curve>,
    over_lag: Vec<Curve>,
    over_restitution: Vec<Curve>,
    over_amplitude: Vec<Curve>,
}

/// The cells of the map, row by row from the lowest Γ. Phases and lags in rad, speeds in units of ωΦ.
#[derive(Debug, Serialize, Deserialize)]
struct Cells {
    columns: usize,
    /// Of each row the digits 0: the disk never leaves the platform; 1: the force sets in once in every period,
    /// at one phase; 2: it flies for several periods; 3: another motion.
    regimes: Vec<String>,
    mean_phases: Vec<f64>,
    best_lags: Vec<f64>,
    speeds_at_zero: Vec<f64>,
    best_speeds: Vec<f64>,
}

/// Contact time over the period and phase (cycles) of releases: of the orbit that is followed from long contacts
/// on, and of starts at random.
#[derive(Debug, Serialize, Deserialize)]
struct Transition {
    tapped: Vec<(f64, f64)>,
    flown: Vec<(f64, f64)>,
}

/// How long flights last from random starts.
#[derive(Debug, Serialize, Deserialize)]
struct Lives {
    name: String,
    starts: usize,
    most_periods: f64,
    points: Vec<Life>,
    /// The shortest contact time over the period with an orbit that is tapped in every period.
    tapped_from: Option<f64>,
}

/// The flights of all starts together.
#[derive(Debug, Serialize, Deserialize)]
struct Life {
    contact_time: f64,
    flown_periods: f64,
    /// Starts whose flights ended.
    ended: usize,
}

impl Life {
    /// Mean life (periods) and its standard error, if flights ended often enough: the maximum likelihood of
    /// lives that end at a constant rate, some of which are not seen to end.
    fn mean(&self) -> Option<(f64, f64)> {
        const LEAST: usize = 4;
        let mean = self.flown_periods / self.ended as f64;
        (self.ended >= LEAST).then(|| (mean, mean / (self.ended as f64).sqrt()))
    }
}

/// Values of the horizontal axis, and by the [`LAGS`] the steady speed over ωΦ and the stall torque over that of
/// friction there.
#[derive(Debug, Serialize, Deserialize)]
struct Curve {
    name: String,
    values: Vec<f64>,
    speeds: [Vec<f64>; 3],
    stall_shares: [Vec<f64>; 3],
}

/// Times (s) and speeds (rad/s) of a run-up; mean and standard deviation of the speed in its last third.
#[derive(Debug, Serialize, Deserialize)]
struct Run {
    name: String,
    points: Vec<(f64, f64)>,
    mean: f64,
    fluctuation: f64,
}

impl Experiment for ExtraContact {
    type Data = ExtraContactData;
    const ID: &'static str = "extra-contact";
    const TITLE: &'static str = "A motor whose impacts take time";
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![("starts at random", SEED)]
    }

    fn caption(data: &ExtraContactData) -> String {
        let [low, high] = data.ring;
        format!(
            "A rotor on a linear spring and damper by contact time T_c (over the period T) and restitution ε of an isolated impact. (a) to (e): over T_c/T and Γ, \
             with ε = {}, from rest: the motion; the mean phase of the force; the phase lag at which little friction turns the rotor fastest; its steady speed \
             (over ωΦ) at θ = 0 and at the best lag. Dotted in (a): m g/(k A) = 0.1, 1, 10; white bar: the paper's motor, whose impacts last for {low:.1} to {high:.1} periods. \
             (f) to (o): Γ = {:.1} as in Table III. (f) Phases at which the force falls to zero: of the orbit that is tapped in every period (blue), and of starts at random (grey). \
             (g) Mean life of the long flights of {} starts at random, by ε: with a damper, and with a spring that unloads at ε² of its stiffness; dashed: the shortest contacts that \
             tap the rotor in every period. (h) Speeds at θ = 0 (solid) and -π/2 (dashed). (i) Run-ups, by T_c/T. (j) to (o): by T_c/T, at θ = 0 (solid), -π/4 (dotted) and -π/2 (dashed), the latter two of the longest contact alone: speed and stall torque \
             (over the largest that friction can give at this preload) as in Fig. 11; speed and stall torque over the lag; speed over restitution and amplitude, as in Fig. 13. Spikes: motions of low period.",
            data.restitution,
            data.axial_forcing,
            data.lives.first().map_or(0, |lives| lives.starts),
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraContactData, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &ExtraContactData) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_1_PI, TAU};

    use bouncing_disk::Motor;
    use bouncing_disk::core::Unobserved;
    use bouncing_disk::core::numerics::roots::bisection;
    use bouncing_disk::core::numerics::statistics::{mean, standard_deviation};
    use bouncing_disk::motor::{DrivenMotor, Estimate, NormalImpulses, OperatingSettings, Operation};
    use bouncing_disk::parameters::Waveform;

    use super::compute::{Law, cell, paper_contacts, tapped_start};
    use super::*;

    const PAGE: &str = include_str!("../../../docs/contacts-that-take-time.md");

    /// Preloads (m/s²) at which the features that the paper measured are sought: below, in, and above the range in
    /// which it found the speed constant, and the one from which on it found the stall torque constant (280 mN,
    /// 200 mN over the mass).
    const BELOW: f64 = 1.0;
    const WITHIN: [f64; 3] = [2.5, 5.0, 8.5];
    const PLATEAU: f64 = 6.1;
    const ABOVE: f64 = 10.0;

    /// Less than this share of the speed within is a sharp fall, as in Fig. 11; a motor with less than this speed
    /// within is no motor at this lag.
    const SHARP: f64 = 0.8;
    const LEAST: f64 = 0.25;

    /// Where the orbit of one tap doubles.
    #[test]
    fn the_page_has_the_doubling() {
        let motor = Motor::paper_70_khz();
        let (forcing, restitution) = (motor.system().axial_forcing(), motor.system().disk().restitution());
        let guess = [tapped_start(forcing, restitution).unwrap()];
        let radius = |time| {
            let law = Law { contact_time: Some(time), restitution, hysteretic: false };
            law.map(forcing)?.refine(&guess).map(|orbit| orbit.multipliers().spectral_radius())
        };
        let stable = |time| Ok::<_, bouncing_disk::core::Error>(radius(time)? > 1.0);
        let doubling = bisection(0.5, 0.6, 40, stable).unwrap();
        let words = format!("stability at T_c/T = {doubling:.4} by a doubling");
        assert!(PAGE.contains(&words), "{words}");
    }

    /// Speeds with the motor's friction; of flights that end after some 40,000 periods, with little friction.
    #[test]
    fn the_page_has_the_speeds() {
        let paper = Motor::paper_70_khz();
        let period = TAU / paper.system().platform().angular_frequency();
        let settings = OperatingSettings {
            members: 4,
            relative_error: 0.02,
            most_impacts: 4_000_000,
            ..OperatingSettings::default()
        };
        let speed = |time: f64, phase_lag: f64| {
            let motor = paper.with(|sheet| sheet.phase_lag = phase_lag).unwrap();
            let soft = DrivenMotor::new(motor, Waveform::Sine, Waveform::Sine).unwrap();
            let soft = soft.with_contact_time(time * period).unwrap();
            match soft.torque_speed_curve(&[0.0], &settings, &Unobserved).unwrap().remove(0) {
                Operation::Steady(point) | Operation::Unsettled(point, _) => point.speed,
                other => panic!("{other:?}"),
            }
        };
        let flown = |lag: f64| {
            const PERIODS: usize = 10_000;
            let law = Law {
                contact_time: Some(0.6),
                restitution: paper.system().disk().restitution(),
                hysteretic: false,
            };
            let histories = (1..=32).filter_map(|k| {
                let forcing = paper.system().axial_forcing() * (1.0 + 1e-9 * f64::from(k));
                let impulses =
                    NormalImpulses::of_contact(law.map(forcing).unwrap().compliant()?, 500, PERIODS);
                // A rotor that is tapped has a landing in each period.
                let impulses = impulses.ok().filter(|own| own.landings.len() < PERIODS / 5)?;
                Some(impulses.balance(lag).steady_speed() * paper.system().platform().peak_angular_speed())
            });
            let speeds: Vec<f64> = histories.collect();
            let standard_error = standard_deviation(&speeds) / (speeds.len() as f64).sqrt();
            Estimate { value: mean(&speeds), standard_error }
        };
        // A chaotic motion changes with the last bit: within the errors.
        let check = |name: &str, speed: &dyn Fn(f64) -> Estimate| {
            let row = PAGE.lines().find(|row| row.starts_with(&format!("| {name} |")) && row.contains('±'));
            for (cell, lag) in row.expect(name).split('|').skip(2).zip([0.0, -FRAC_PI_2]) {
                let own = speed(lag);
                let (value, error) = cell.trim().split_once(" ± ").expect(cell);
                let [value, error] = [value, error].map(|word| word.parse::<f64>().expect(word));
                let both = (error * error + own.standard_error * own.standard_error).sqrt();
                let agrees = (value - own.value).abs() < 0.005 + 3.0 * both;
                assert!(agrees && own.standard_error < 3.0 * error, "{name} {lag}: {own:?}");
            }
        };
        for time in [0.05, 0.2, 0.5, 0.6, 0.8, 1.0, 2.0, 5.0, 18.0] {
            check(&time.to_string(), &|lag| speed(time, lag));
        }
        check("0.6, flights", &flown);
    }

    /// The rows of the page, computed.
    #[test]
    fn the_page_has_the_findings() {
        let motor = Motor::paper_70_khz();
        let (forcing, restitution) = (motor.system().axial_forcing(), motor.system().disk().restitution());
        let law = |contact_time| Law { contact_time, restitution, hysteretic: false };
        let [ring, plane] = paper_contacts(&motor).unwrap();
        let times = [None, Some(0.5), Some(1.0), Some(ring[0]), Some(ring[1]), Some(plane[1])];
        let motions = ["never leaves", "tapped", "long flights", "other"];
        let mut rows = Vec::new();
        for time in times {
            let own = cell(law(time), forcing).unwrap();
            let (impulses, _) = law(time).impulses(forcing).unwrap();
            let name = time.map_or_else(|| "rigid".to_owned(), |time| format!("{time:.1}"));
            let motion = if time.is_none() { "long flights" } else { motions[usize::from(own.regime)] };
            rows.push(format!(
                "| {name} | {motion} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} |",
                own.mean_phase * FRAC_1_PI,
                own.best_lag * FRAC_1_PI,
                own.speed_at_zero,
                impulses.balance(-FRAC_PI_2).steady_speed(),
                own.best_speed,
            ));
        }
        // At how many of nine lags from 0 to -π/2 the motor turns, and shows each feature and all.
        for time in times.into_iter().filter(|time| time.is_none_or(|time| time > 0.9)) {
            let at = |preload: f64| {
                let forcing = forcing * motor.system().disk().preload_acceleration() / preload;
                law(time).impulses(forcing).unwrap().0
            };
            let [below, plateau, above] = [BELOW, PLATEAU, ABOVE].map(at);
            let within = WITHIN.map(at);
            let mut found = [0; 6];
            for eighth in 0..=8 {
                let lag = -FRAC_PI_2 * f64::from(eighth) / 8.0;
                let speed = |impulses: &NormalImpulses| impulses.balance(lag).steady_speed();
                let torque =
                    |impulses: &NormalImpulses, preload: f64| preload * impulses.balance(lag).net_share(0.0);
                let inside = within.each_ref().map(speed);
                let mean = inside.iter().sum::<f64>() / 3.0;
                let ends =
                    inside.iter().fold((1.0_f64, 0.0_f64), |ends, own| (ends.0.min(*own), ends.1.max(*own)));
                if mean < LEAST {
                    continue;
                }
                let features = [
                    true,
                    ends.0 > SHARP * ends.1,
                    speed(&below) < SHARP * mean,
                    speed(&above) < SHARP * mean,
                    torque(&above, ABOVE) < 1.2 * torque(&plateau, PLATEAU)
                        && torque(&plateau, PLATEAU) > 0.0,
                ];
                for (count, feature) in found.iter_mut().zip(features) {
                    *count += i32::from(feature);
                }
                found[5] += i32::from(features.iter().all(|feature| *feature));
            }
            let name = time.map_or_else(|| "rigid".to_owned(), |time| format!("{time:.1}"));
            let counts = found.map(|count| count.to_string()).join(" | ");
            rows.push(format!("| {name} | {counts} |"));
        }
        // At 184 kHz, at the printed lag.
        let motor = Motor::paper_184_khz();
        let [ring, plane] = paper_contacts(&motor).unwrap();
        for time in [1.0, ring[0], ring[1], plane[1]] {
            let speeds = [BELOW, WITHIN[0], WITHIN[1], WITHIN[2], ABOVE].map(|preload| {
                let own = motor.system();
                let forcing = own.axial_forcing() * own.disk().preload_acceleration() / preload;
                let (impulses, _) = law(Some(time)).impulses(forcing).unwrap();
                format!("{:.2}", impulses.balance(0.0).steady_speed())
            });
            rows.push(format!("| {time:.1} | {} |", speeds.join(" | ")));
        }
        let missing: Vec<_> = rows.into_iter().filter(|row| !PAGE.contains(row.as_str())).collect();
        assert!(missing.is_empty(), "{}", missing.join("\n"));
    }
}
