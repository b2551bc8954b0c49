use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::sweep::LaneRunner;

use super::*;

/// A step divided into many small steps without closed forms: friction acts against the slip, and holds the
/// rotor if the other torques are weaker.
fn small_steps(step: Step, mut speed: f64) -> Slid {
    const COUNT: usize = 200_000;
    let (mut slid, share) =
        (Slid { speed, angle: 0.0, square: 0.0, work: 0.0, loss: 0.0 }, 1.0 / COUNT as f64);
    let gained = step.to - step.from;
    for index in 0..COUNT {
        let stator = step.from + gained * (index as f64 + 0.5) * share;
        let slip = speed - stator;
        let most = step.friction * share;
        // The speed of a rotor without friction, relative to the stator's speed at that time.
        let free = slip - (gained + step.load) * share;
        let impulse = (-free).clamp(-most, most);
        let after = speed - step.load * share + impulse;
        slid.angle += 0.5 * step.span * share * (speed + after);
        slid.square += step.span * share * (speed * speed + speed * after + after * after) / 3.0;
        slid.work += impulse * stator;
        slid.loss -= impulse * (0.5 * (speed + after) - stator);
        speed = after;
    }
    Slid { speed, ..slid }
}

#[test]
fn a_step_is_what_small_steps_make_of_it() {
    let mut random = SplitMix64::new(3);
    let mut between = |low: f64, high: f64| low + (high - low) * random.unit();
    for trial in 0..60 {
        let step = Step {
            span: between(0.01, 0.2),
            from: between(-1.0, 1.0),
            to: between(-1.0, 1.0),
            friction: [0.0, between(0.0, 0.3), between(0.5, 3.0)][trial % 3],
            load: [0.0, between(-0.5, 0.5)][trial % 2],
        };
        // Near the stator's speed, equal to it, and far from it.
        for speed in [step.from, step.from + 1e-9, between(-1.5, 1.5), 5.0, -5.0] {
            let (own, known) = (step.slide(speed), small_steps(step, speed));
            let size = 1.0 + speed.abs();
            for (one, other) in [
                (own.speed, known.speed),
                (own.angle / step.span, known.angle / step.span),
                (own.square / step.span, known.square / step.span),
                (own.work, known.work),
                (own.loss, known.loss),
            ] {
                assert!((one - other).abs() < 1e-4 * size * size, "{step:?} {speed}: {own:?} {known:?}");
            }
            // The energy supplied equals the energy used.
            let kinetic = 0.5 * (own.speed - speed) * (own.speed + speed);
            let left = own.work - own.loss - step.load * (own.angle / step.span) - kinetic;
            assert!(left.abs() < 1e-14 * size * size, "{step:?} {speed}: {left}");
            assert!(own.loss >= -1e-15, "{own:?}");
        }
    }
}

/// In flight, the exact decay on each piece agrees with small steps, also across nodes of the law and where
/// the law drives the rotor.
#[test]
fn a_flight_under_a_law_is_what_small_steps_make_of_it() {
    let law = [
        LoadLine { from: f64::NEG_INFINITY, to: -1.0, torque: 0.4, slope: 0.6 },
        LoadLine { from: -1.0, to: 0.5, torque: -0.2 + 1e-12, slope: 1e-12 },
        LoadLine { from: 0.5, to: 2.0, torque: -0.7, slope: 1.0 },
        LoadLine { from: 2.0, to: f64::INFINITY, torque: 1.3, slope: 0.0 },
    ];
    for (speed, load, span) in [
        (3.0, 0.0, 2.0),
        (3.0, 0.1, 6.0),
        (-3.0, 0.0, 3.0),
        (0.0, 0.0, 1e-6),
        (1.0, -0.4, 9.0),
        (0.6, 0.0, 50.0),
    ] {
        let mut rows = RotorRows::<Done>::default();
        rows.put(0, [0.0, load], [0.0; 2]);
        rows.speed[0] = speed;
        fly_under(&mut rows, 1, span, &law);
        let (count, mut known, mut angle, mut impulse, mut work) = (400_000, speed, 0.0, 0.0, 0.0);
        let step = span / f64::from(count);
        for _ in 0..count {
            let slope = |at: f64| -(load + torque(&law, at));
            let middle = known + 0.5 * step * slope(known);
            let (taken, after) = (torque(&law, middle), known + step * slope(middle));
            angle += step * middle;
            impulse += step * taken;
            work += step * taken * middle;
            known = after;
        }
        let done = &rows.tally;
        for (own, other) in [
            (rows.speed[0], known),
            (done.angle[0], angle),
            (done.law_impulse[0], impulse),
            (done.law_work[0], work),
        ] {
            assert!((own - other).abs() < 1e-6 * (1.0 + other.abs()), "{speed} {load} {span}: {own} {other}");
        }
    }
}

/// A rotor held at rest receives the impulse from the time in which the stator turns forwards, minus the
/// rest.
#[test]
fn a_held_rotor_gets_the_difference_of_both_directions() {
    let held = |from: f64, to: f64| {
        let mut done = Done::default();
        hold(&mut done, 2.0, [from; WIDTH], [to; WIDTH]);
        done.held[0]
    };
    for (from, to, share) in
        [(1.0, 0.5, 1.0), (-0.2, -1.0, -1.0), (1.0, -1.0, 0.0), (3.0, -1.0, 0.5), (0.0, 0.0, 0.0)]
    {
        assert!((held(from, to) - 2.0 * share).abs() < 1e-15, "{from} {to}");
    }
}

/// On a rotor that slides throughout, a constant force does the same work as for the exact sine: on average
/// the chord used in a step equals the arc.
#[test]
fn a_slide_on_a_sine_takes_its_mean_speed() {
    use std::f64::consts::FRAC_PI_2;

    use bouncing_disk_core::sweep::InstructionSet;

    let mut tape = Tape::new(0.0, 32.0, Vec::new());
    tape.press(0.0, FRAC_PI_2, |to| 3.0 * to);
    let mut rows = RotorRows::<Done>::default();
    rows.put(0, [0.1, 0.0], [2.0, 0.0]);
    rows.speed[0] = 50.0;
    let mut rotors = [Rotors { rows, count: 1, quicker: [1.0; WIDTH], law: Vec::new(), column: None }];
    LaneRunner::new(InstructionSet::best()).run(Replay {
        tape: &tape,
        steps: 1..tape.knots.len(),
        rotors: &mut rotors,
    });
    // Friction 0.1 times the force 3 times the integral of 2 cos over a quarter of a period.
    let done = rotors[0].rows.tally;
    // The series of the chord omits terms of 17 h^6/20160 and smaller.
    let step = std::f64::consts::TAU / 32.0;
    let cube = step * step * step;
    let left_out = 17.0 / 20_160.0 * cube * cube;
    assert!((done.work[0] + 0.6).abs() < 1.1 * 0.6 * left_out, "{}", done.work[0]);
    assert!((done.held[0] - 3.0 * FRAC_PI_2).abs() < 1e-12, "{}", done.held[0]);
}
