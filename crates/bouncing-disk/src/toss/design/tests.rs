use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::{Arc, Mutex, OnceLock};

use bouncing_disk_core::Unobserved;
use bouncing_disk_core::numerics::random::SplitMix64;

use super::*;
use crate::DiskParameters;
use crate::toss::design::hand::{Hand, toss, value_of};
use crate::toss::{
    InitialSpin, OverFriction, Robustness, TossHalfUnits, TossInput, TossObjective, TossRobustness,
};

/// The design, searched once for all tests.
fn designed(constraints: &TossConstraints) -> TossDesign {
    static KNOWN: Mutex<Vec<(TossConstraints, Arc<OnceLock<TossDesign>>)>> = Mutex::new(Vec::new());
    let known = {
        let mut known = KNOWN.lock().expect("no panic");
        match known.iter().find(|(of, _)| of == constraints) {
            Some((_, design)) => Arc::clone(design),
            None => {
                known.push((*constraints, Arc::default()));
                Arc::clone(&known[known.len() - 1].1)
            }
        }
    };
    *known.get_or_init(|| best_toss(constraints, &Unobserved).expect("legal"))
}

/// A hand motion at random among those that are allowed.
fn random_hand(constraints: &TossConstraints, random: &mut SplitMix64) -> Option<Hand> {
    let mut within = |[low, high]: [f64; 2]| low + (high - low) * random.unit();
    let angular_frequency = within(constraints.angular_frequency);
    let phase_lag = within(constraints.phase_lag);
    let angles = constraints.amplitude_angles(angular_frequency)?;
    Some(Hand { angular_frequency, phase_lag, amplitude_angle: within(angles) })
}

/// Sec. III B: the fastest toss of Table I is at theta = 0; its angle is that of the figure, not the printed
/// one (docs/errata.md).
#[test]
fn the_best_toss_of_table_i_is_that_of_fig_4() {
    let fastest = designed(&TossConstraints::pizza_toss());
    assert!((fastest.hand.amplitude_angle / PI - 0.300_852).abs() < 1e-6, "{fastest:?}");
    assert!((fastest.value - 22.0336).abs() < 1e-4, "{fastest:?}");
    assert!(fastest.hand.phase_lag.abs() < 1e-6, "{fastest:?}");
    let efficient =
        designed(&TossConstraints { objective: TossObjective::Efficiency, ..TossConstraints::pizza_toss() });
    assert!((efficient.hand.amplitude_angle / PI - 0.3035).abs() < 5e-5, "{efficient:?}");
    assert!((efficient.value - 0.3988).abs() < 5e-5, "{efficient:?}");
}

fn cases() -> Vec<TossConstraints> {
    let table = TossConstraints::pizza_toss();
    let uncertain = TossConstraints { friction: [0.4, 0.8], ..table };
    let free = TossConstraints { angular_frequency: [5.0, 20.0], highest_flight: Some(0.6), ..uncertain };
    vec![
        table,
        uncertain,
        TossConstraints { over_friction: OverFriction::Mean, ..uncertain },
        TossConstraints { objective: TossObjective::Efficiency, ..uncertain },
        TossConstraints { objective: TossObjective::TurnsPerToss, ..uncertain },
        TossConstraints { initial: InitialSpin::RestRelativeToHand, ..uncertain },
        free,
        TossConstraints { objective: TossObjective::TurnsPerToss, ..free },
        TossConstraints { objective: TossObjective::Efficiency, over_friction: OverFriction::Mean, ..free },
        TossConstraints { phase_lag: [0.3, 1.2], ..free },
    ]
}

/// None of many hand motions at random is better, nor is one next to the optimum.
#[test]
fn nothing_is_better_than_the_best() {
    for (index, constraints) in cases().into_iter().enumerate() {
        let design = designed(&constraints);
        let mut random = SplitMix64::new(17);
        let value =
            |hand: Hand| value_of(&constraints, hand.stroke(&constraints), constraints.dough).unwrap();
        for _ in 0..5_000 {
            let Some(hand) = random_hand(&constraints, &mut random) else { continue };
            assert!(
                value(hand) <= design.value * (1.0 + 1e-9),
                "{index} {hand:?} {} {design:?}",
                value(hand)
            );
        }
        for _ in 0..2_000 {
            let width = 1e-5 + 1e-2 * random.unit() * random.unit();
            let mut near = |value: f64, [low, high]: [f64; 2]| {
                (value + width * (2.0 * random.unit() - 1.0)).clamp(low, high)
            };
            let angular_frequency = near(design.hand.angular_frequency, constraints.angular_frequency);
            let phase_lag = near(design.hand.phase_lag, constraints.phase_lag);
            let Some(angles) = constraints.amplitude_angles(angular_frequency) else { continue };
            let amplitude_angle = near(design.hand.amplitude_angle, angles);
            let hand = Hand { angular_frequency, phase_lag, amplitude_angle };
            assert!(
                value(hand) <= design.value * (1.0 + 1e-6),
                "{index} {hand:?} {} {design:?}",
                value(hand)
            );
        }
        let certificate = design.certificate;
        assert!(certificate.best_on_grid <= design.value, "{index} {certificate:?}");
        assert!(certificate.hidden_gain >= 0.0, "{index} {certificate:?}");
    }
}

#[test]
fn the_height_is_kept_and_used() {
    for height in [0.05, 0.3, 0.6] {
        let constraints = TossConstraints { highest_flight: Some(height), ..TossConstraints::pizza_toss() };
        let design = designed(&constraints);
        assert!(design.flight_height <= height * (1.0 + 1e-9), "{design:?}");
        // The height of the launch is that of the flight itself.
        let system = crate::System::new(
            crate::Platform::from_stroke(design.hand).unwrap(),
            constraints.dough.build().unwrap(),
        )
        .unwrap();
        let flight = crate::toss::single_toss(&system, constraints.initial).unwrap();
        let rise = 0.5 * flight.launch_speed * flight.launch_speed / 9.8;
        assert!((rise - design.flight_height).abs() < 1e-12, "{rise} {design:?}");
    }
    // A limit that nothing reaches changes nothing.
    let high = TossConstraints { highest_flight: Some(1e3), ..TossConstraints::pizza_toss() };
    assert_eq!(designed(&high).hand, designed(&TossConstraints::pizza_toss()).hand);
}

/// The angles at the ends of the closed form are those of the flights.
#[test]
fn the_allowed_angles_end_where_the_flight_does() {
    let mut random = SplitMix64::new(5);
    for _ in 0..200 {
        let omega = 8.0 + 12.0 * random.unit();
        let height = 0.02 + random.unit();
        let constraints = TossConstraints {
            highest_flight: Some(height),
            angular_frequency: [omega; 2],
            ..TossConstraints::pizza_toss()
        };
        let [least, most] = constraints.amplitude_angles(omega).unwrap();
        let rise = |angle: f64| {
            let hand = Hand { angular_frequency: omega, phase_lag: 0.0, amplitude_angle: angle };
            let toss = toss(hand.stroke(&constraints), constraints.dough, 0.6, constraints.initial).unwrap();
            toss.map(|toss| flight_height(&toss, 9.8))
        };
        let at_least = rise(least).unwrap();
        assert!(at_least <= height * (1.0 + 1e-12), "{omega} {height} {at_least}");
        assert!(least <= 0.0 || (at_least - height).abs() < 1e-12 * height, "{omega} {height} {at_least}");
        assert!(rise(most - 1e-9).unwrap() < 1e-6 && rise(most + 1e-9).is_none(), "{omega}");
    }
    assert_eq!(TossConstraints::pizza_toss().amplitude_angles(1.0), None);
}

#[test]
fn friction_that_is_uncertain_costs_what_it_costs() {
    let table = TossConstraints::pizza_toss();
    let uncertain = TossConstraints { friction: [0.5, 0.7], ..table };
    let least = TossConstraints { friction: [0.5; 2], ..table };
    let [table, worst, mean, least] = [
        designed(&table),
        designed(&uncertain),
        designed(&TossConstraints { over_friction: OverFriction::Mean, ..uncertain }),
        designed(&least),
    ];
    assert!(worst.value < table.value && worst.value <= least.value * (1.0 + 1e-9), "{worst:?} {least:?}");
    assert!(mean.value > worst.value, "{mean:?} {worst:?}");
    // The paper: the chef keeps the angle low where the friction is uncertain.
    assert!(worst.hand.amplitude_angle < table.hand.amplitude_angle, "{worst:?} {table:?}");
    let robust = worst.robustness(&TossHalfUnits::default()).unwrap().friction;
    // The least over many frictions is the one over a few.
    assert!((robust.least - worst.value).abs() < 1e-9 * worst.value, "{robust:?} {worst:?}");
    assert!(robust.most >= robust.nominal && robust.worst_input == Some(TossInput::Friction), "{robust:?}");
}

/// The spread holds whatever rounds to the same digits.
#[test]
fn the_spread_holds_what_rounds_to_the_same_digits() {
    let half_units = TossHalfUnits {
        stroke: 0.005,
        angular_frequency: 0.5,
        amplitude_angle: 0.005,
        phase_lag: 0.05,
        contact_radius: 0.0005,
        gyration_radius: 0.005,
        preload_acceleration: 0.05,
    };
    for constraints in [cases()[0], cases()[6]] {
        let design = designed(&constraints);
        let TossRobustness { digits, friction, highest_flight } = design.robustness(&half_units).unwrap();
        assert!((digits.nominal - design.value).abs() < 1e-12 * design.value, "{digits:?}");
        assert!(digits.least < digits.nominal && digits.nominal < digits.most, "{digits:?}");
        assert!(digits.worst_loss <= digits.nominal - digits.least, "{digits:?}");
        assert!(digits.worst_input.is_some() && highest_flight > design.flight_height);
        assert!(friction.least <= friction.nominal);
        let mut random = SplitMix64::new(3);
        let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
        for _ in 0..5_000 {
            let mut near = |value: f64, half: f64| value + half * (2.0 * random.unit() - 1.0);
            let hand = Stroke {
                stroke: near(design.hand.stroke, half_units.stroke),
                angular_frequency: near(design.hand.angular_frequency, half_units.angular_frequency),
                amplitude_angle: near(design.hand.amplitude_angle, half_units.amplitude_angle),
                phase_lag: near(design.hand.phase_lag, half_units.phase_lag),
                contact_radius: near(design.hand.contact_radius, half_units.contact_radius),
            };
            let dough = DiskParameters {
                contact_radius: hand.contact_radius,
                gyration_radius: near(constraints.dough.gyration_radius, half_units.gyration_radius),
                preload_acceleration: near(9.8, half_units.preload_acceleration),
                ..constraints.dough
            };
            let value = value_of(&constraints, hand, dough).unwrap();
            (least, most) = (least.min(value), most.max(value));
        }
        assert!(digits.least <= least && most <= digits.most, "{digits:?} {least} {most}");
        // It is not much wider than what was seen either.
        let seen = (most - least) / (digits.most - digits.least);
        assert!(seen > 0.4, "{seen} {digits:?}");
    }
}

#[test]
fn exact_inputs_leave_nothing_in_doubt() {
    let design = designed(&TossConstraints::pizza_toss());
    let TossRobustness { digits, friction, highest_flight } =
        design.robustness(&TossHalfUnits::default()).unwrap();
    for spread in [digits, friction] {
        let Robustness { nominal, least, most, worst_input, worst_loss } = spread;
        assert!((least, most, worst_input) == (nominal, nominal, None) && worst_loss <= 0.0, "{spread:?}");
    }
    assert!((highest_flight - design.flight_height).abs() < 1e-15);
    for bad in [-1e-300, f64::NAN, f64::INFINITY, 0.25, 1e300] {
        let half_units = TossHalfUnits { stroke: bad, ..TossHalfUnits::default() };
        assert_eq!(crate::testing::refused_field(design.robustness(&half_units)), "half unit of stroke");
    }
    // A subnormal one is none.
    let tiny = TossHalfUnits { stroke: 5e-324, ..TossHalfUnits::default() };
    assert!((design.robustness(&tiny).unwrap().digits.most - digits.most).abs() <= 0.0);
}

#[test]
fn constraints_that_allow_nothing_are_refused_by_name() {
    let table = TossConstraints::pizza_toss();
    let nan = f64::NAN;
    for (constraints, name) in [
        (TossConstraints { stroke: 0.0, ..table }, "stroke"),
        (TossConstraints { stroke: 1e308, angular_frequency: [1e3; 2], ..table }, "stroke"),
        (TossConstraints { friction: [0.7, 0.6], ..table }, "friction (most)"),
        (TossConstraints { friction: [-0.1, 0.6], ..table }, "friction (least)"),
        (TossConstraints { friction: [nan, 0.6], ..table }, "friction (least)"),
        (TossConstraints { angular_frequency: [0.0, 1.0], ..table }, "angular_frequency (least)"),
        (TossConstraints { angular_frequency: [2.0, 1.0], ..table }, "angular_frequency (most)"),
        (TossConstraints { phase_lag: [nan, 1.0], ..table }, "phase_lag (least)"),
        (TossConstraints { phase_lag: [0.0, 6.3], ..table }, "phase_lag (most)"),
        (TossConstraints { phase_lag: [0.0, -0.1], ..table }, "phase_lag (most)"),
        (TossConstraints { highest_flight: Some(0.0), ..table }, "highest_flight"),
        (TossConstraints { highest_flight: Some(nan), ..table }, "highest_flight"),
        (
            TossConstraints { dough: DiskParameters { gyration_radius: 0.0, ..table.dough }, ..table },
            "gyration_radius",
        ),
    ] {
        assert_eq!(crate::testing::refused_field(best_toss(&constraints, &Unobserved)), name);
    }
    let slow = TossConstraints { angular_frequency: [1.0, 6.0], ..table };
    let error = best_toss(&slow, &Unobserved).expect_err("too slow");
    assert!(matches!(error, Error::NeverLeaves { peak_acceleration } if peak_acceleration < 1.0), "{error}");
}

#[test]
fn the_ends_of_what_is_legal_have_a_best_toss() {
    let table = TossConstraints::pizza_toss();
    // Without friction nothing turns, with much of it the dough follows the hand.
    let slippery = designed(&TossConstraints { friction: [0.0; 2], ..table });
    assert!(slippery.value.abs() < 1e-12 && slippery.toss.launch_speed > 0.0, "{slippery:?}");
    let sticky = designed(&TossConstraints { friction: [1e6; 2], ..table });
    assert!(sticky.value > 26.0 && sticky.value < 0.25 * 15.0 / 0.135, "{sticky:?}");
    // A range of frequencies that begins where nothing leaves, and one of which only the end does.
    let from_low = designed(&TossConstraints { angular_frequency: [1e-300, 15.0], ..table });
    assert!((from_low.hand.angular_frequency - 15.0).abs() < 1e-9, "{from_low:?}");
    // A single lag.
    let lagging = designed(&TossConstraints { phase_lag: [0.4; 2], ..table });
    assert!(lagging.value < 22.0 && (lagging.hand.phase_lag - 0.4).abs() <= 0.0, "{lagging:?}");
    // The other half of the circle has the same, the other way round.
    let other = designed(&TossConstraints { phase_lag: [FRAC_PI_2, 1.5 * PI], ..table });
    assert!((other.value - designed(&table).value).abs() < 1e-9, "{other:?}");
    assert!(other.toss.airborne_speed < 0.0 && (other.hand.phase_lag - PI).abs() < 1e-6, "{other:?}");
}

#[test]
fn a_search_can_be_stopped() {
    let stop = |_: bouncing_disk_core::Progress| std::ops::ControlFlow::Break(());
    let error = best_toss(&TossConstraints::pizza_toss(), &stop).expect_err("stopped");
    assert!(matches!(error, Error::Core(bouncing_disk_core::Error::Stopped { .. })), "{error}");
}

/// The toss of the design is that of its system, to the last bit.
#[test]
fn the_system_of_a_design_tosses_as_it_says() {
    for constraints in cases() {
        let design = designed(&constraints);
        let system = design.system().expect("legal");
        assert_eq!(
            crate::toss::single_toss(&system, constraints.initial),
            Ok(design.toss),
            "{constraints:?}"
        );
        let [least, most] = constraints.friction;
        assert!((system.disk().friction() - (least + most) / 2.0).abs() < 1e-15);
    }
    // The middle of two numbers whose sum no double holds.
    assert!((crate::toss::design::hand::middle([f64::MAX, f64::MAX]) / f64::MAX - 1.0).abs() < 1e-15);
    // Public fields may be changed to what is no system.
    let mut design = designed(&TossConstraints::pizza_toss());
    design.constraints.friction = [-1.0, -1.0];
    assert!(matches!(design.system(), Err(Error::OutOfRange { field: "friction", .. })));
}
