use super::*;
use crate::motor::MotorRegime;
use crate::testing::{check_stops, refused};

fn at_forcing(motor: &Motor, forcing: f64) -> Motor {
    let preload = motor.system().platform().peak_acceleration() / (PI * forcing);
    motor
        .with(|sheet| {
            sheet.preload_force = None;
            sheet.preload_acceleration = Some(preload);
        })
        .expect("legal")
}

/// The verdict from 64 relaunches agrees with the report's, which follows 20 000 impacts.
#[test]
fn the_verdict_is_that_of_the_report() {
    let (mut traps, mut agree, mut tried) = (0, 0, 0);
    for (amplitude, from, to) in [(1e-9, 2.0, 4.0), (1e-8, 11.8, 13.2), (1e-7, 203.0, 204.0)] {
        let motor = Motor::paper_70_khz().with(|sheet| sheet.amplitude = Some(amplitude)).expect("legal");
        for step in 0..24 {
            let motor = at_forcing(&motor, from + (to - from) * f64::from(step) / 24.0);
            let verdict = motor.trap_verdict().expect("no failure");
            let regime = motor.report(&Unobserved).expect("no failure").regime;
            let locked = matches!(regime, MotorRegime::LowPeriodChattering(_));
            tried += 1;
            traps += u32::from(verdict.is_trap);
            agree += u32::from(verdict.is_trap == locked);
            if let (true, MotorRegime::LowPeriodChattering(cycle)) = (verdict.is_trap, regime) {
                assert_eq!(verdict.cycle, Some(cycle), "{verdict:?}");
                assert!(verdict.return_share() > 0.9, "{verdict:?}");
            }
        }
    }
    assert!(traps >= 3 && agree >= tried - 1, "{traps} {agree} {tried}");
}

/// A flight of n and a half periods ends when the stator recedes as fast as the rotor falls.
#[test]
fn traps_of_a_single_flight_are_at_half_a_forcing() {
    let motor = Motor::paper_70_khz();
    for whole in [5.0, 6.0, 12.0, 40.0, 100.0] {
        let verdict = at_forcing(&motor, whole + 0.51).trap_verdict().expect("no failure");
        let cycle = verdict.cycle.expect("short");
        assert!(verdict.is_trap && cycle.long_flights == 1 && verdict.returns == 64, "{verdict:?}");
        assert!((verdict.forcing_fraction - 0.51).abs() < 1e-9, "{verdict:?}");
        assert!((cycle.platform_periods as f64 - (whole + 1.0)).abs() <= 1.0, "{verdict:?}");
        for fraction in [0.2, 0.4, 0.6, 0.8] {
            let verdict = at_forcing(&motor, whole + fraction).trap_verdict().expect("no failure");
            let single = verdict.cycle.is_some_and(|cycle| cycle.long_flights == 1);
            assert!(!(verdict.is_trap && single), "{verdict:?}");
        }
    }
}

/// The window begins just below the soft landing of docs/numerics-dynamics.md, and is a twentieth wide.
#[test]
fn windows_of_a_single_flight_begin_at_the_soft_landing() {
    for whole in [3.0, 6.0, 12.0, 100.0] {
        let motor = at_forcing(&Motor::paper_70_khz(), whole + 0.51);
        let [from, to] =
            motor.nearest_trap(0.01, &Unobserved).expect("no failure").expect("one").forcing_from_to;
        let soft = whole + 0.5 - 0.5 / (PI * PI * (whole + 0.5));
        assert!((0.004..0.007).contains(&(soft - from)), "{whole}: {from}");
        assert!((0.05..0.06).contains(&(to - soft)) || whole < 4.0, "{whole}: {to}");
    }
}

#[test]
fn many_preloads_are_judged_one_by_one() {
    let motor = Motor::paper_70_khz();
    let preloads = [9.8, 5.0, 1e3, 1e6, 1e-3];
    let verdicts = low_period_traps(&motor, &preloads, &Unobserved).expect("no failure");
    for (preload, verdict) in preloads.into_iter().zip(&verdicts) {
        let alone = motor.with(|sheet| sheet.preload_acceleration = Some(preload)).expect("legal");
        assert_eq!(*verdict, alone.trap_verdict().expect("no failure"));
        assert!((0.0..1.0).contains(&verdict.forcing_fraction), "{verdict:?}");
    }
    // A stator that never throws has no traps.
    assert!(verdicts[3].axial_forcing < 1.0 / PI && !verdicts[3].is_trap && verdicts[3].cycle.is_none());
    assert_eq!(low_period_traps(&motor, &[], &Unobserved).expect("nothing to do"), []);
    refused("preload_acceleration", [0.0, -1.0, f64::NAN, f64::INFINITY], |bad| {
        low_period_traps(&motor, &[9.8, bad], &Unobserved)
    });
    // A preload as a force is replaced.
    let sprung = motor
        .with(|sheet| (sheet.preload_acceleration, sheet.preload_force) = (None, Some(5.0)))
        .expect("legal");
    assert_eq!(low_period_traps(&sprung, &preloads, &Unobserved).expect("no failure"), verdicts);
    check_stops(5, |observer| low_period_traps(&motor, &preloads, observer));
}

#[test]
fn the_nearest_trap_is_that_of_a_dense_scan() {
    for (forcing, range) in [(12.2, 0.1), (12.51, 0.1), (6.9, 0.15), (40.3, 0.02)] {
        let motor = at_forcing(&Motor::paper_70_khz(), forcing);
        let trap = motor.nearest_trap(range, &Unobserved).expect("no failure").expect("one");
        let [from, to] = trap.forcing_from_to;
        assert!(from < to && trap.verdict.is_trap, "{trap:?}");
        // Each of the values gives the near edge.
        let edge = |change: &dyn Fn(&mut crate::motor::MotorParameters)| {
            motor.with(|sheet| change(sheet)).expect("legal").system().axial_forcing()
        };
        let edges = [
            edge(&|sheet| sheet.preload_acceleration = Some(trap.preload_acceleration)),
            edge(&|sheet| sheet.amplitude = Some(trap.amplitude)),
            edge(&|sheet| sheet.drive_frequency = trap.drive_frequency),
        ];
        let near = if forcing < from {
            from
        } else if forcing > to {
            to
        } else {
            forcing
        };
        for edge in edges {
            assert!((edge / near - 1.0).abs() < 1e-12, "{edges:?} {trap:?}");
        }
        let distance = 1.0 - (forcing.min(near) / forcing.max(near));
        assert!((trap.relative_distance - distance).abs() < 1e-12, "{trap:?}");
        // An independent grid finds nothing nearer; beyond the edge there is no trap.
        let away =
            |offset: f64| at_forcing(&motor, forcing + offset).trap_verdict().expect("no failure").is_trap;
        if trap.relative_distance > 0.0 {
            let gap = (near - forcing).abs();
            for k in 0..200 {
                let offset = gap * (0.999_99 * f64::from(k) / 200.0);
                let found = away(offset) || away(-offset);
                // A trap narrower than the step may be missed.
                let wide = found && away(offset + trap.forcing_step) && away(offset - trap.forcing_step);
                assert!(!wide, "{k} {trap:?}");
            }
            let beyond = 1e-6 * (near - forcing).signum();
            assert!(away(near - forcing + beyond) && !away(near - forcing - beyond), "{trap:?}");
        } else {
            assert!(motor.trap_verdict().expect("no failure").is_trap && from <= forcing && forcing <= to);
        }
    }
}

#[test]
fn a_motor_far_from_every_trap_has_none() {
    let motor = at_forcing(&Motor::paper_70_khz(), 12.25);
    assert_eq!(motor.nearest_trap(1e-9, &Unobserved).expect("no failure"), None);
    let still = Motor::paper_70_khz().with(|sheet| sheet.amplitude = Some(0.0)).expect("legal");
    assert_eq!(still.nearest_trap(1.0, &Unobserved).expect("no failure"), None);
    let bad = [0.0, -0.1, 1.1, f64::NAN, f64::INFINITY];
    refused("relative_range", bad, |range| motor.nearest_trap(range, &Unobserved));
    check_stops(None, |observer| motor.nearest_trap(0.1, observer));
}
