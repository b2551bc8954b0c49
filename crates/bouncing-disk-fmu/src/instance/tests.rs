use super::*;
use crate::description::description;

fn reference(instance: &Instance, name: &str) -> u32 {
    let place = instance.variables.iter().position(|variable| variable.name == name);
    u32::try_from(place.expect("known")).expect("few")
}

fn started() -> Instance {
    let mut instance = Instance::new(&Motor::paper_70_khz());
    instance.enter_initialization(0.0).expect("legal");
    instance.exit_initialization().expect("legal");
    instance
}

fn speed(instance: &mut Instance) -> f64 {
    let speed = reference(instance, "speed");
    instance.get(speed).expect("known")
}

#[test]
fn a_stored_state_goes_on_as_the_first_one() {
    let mut instance = started();
    instance.step(0.0, 0.05).expect("legal");
    let mut stored = instance.clone();
    let mut ends = [&mut instance, &mut stored].map(|instance| {
        instance.step(0.05, 0.05).expect("legal");
        speed(instance).to_bits()
    });
    assert_eq!(ends[0], ends[1]);
    // What was set is forgotten, too.
    let torque = reference(&instance, "load_torque");
    instance.set(torque, 1e-5).expect("legal");
    instance.reset().expect("legal");
    assert_eq!(instance.get(torque), Ok(0.0));
    instance.enter_initialization(0.0).expect("legal");
    instance.exit_initialization().expect("legal");
    instance.step(0.0, 0.1).expect("legal");
    ends[1] = speed(&mut instance).to_bits();
    assert_eq!(ends[0], ends[1], "after a reset");
}

#[test]
fn parameters_count_until_the_start_and_inputs_until_the_end() {
    let mut instance = Instance::new(&Motor::paper_70_khz());
    let [friction, torque, on, output] =
        ["friction", "load_torque", "drive_on", "speed"].map(|name| reference(&instance, name));
    instance.set(friction, -1.0).expect("checked at the start");
    assert!(instance.get(output).is_err());
    instance.enter_initialization(0.0).expect("legal");
    assert!(instance.exit_initialization().expect_err("illegal").contains("friction = -1"));
    assert!(instance.step(0.0, 0.1).is_err());
    instance.set(friction, 0.2).expect("legal");
    assert_eq!(instance.get(output), Ok(0.0));
    instance.exit_initialization().expect("legal");
    assert!(instance.set(friction, 0.1).expect_err("late").contains("until the initialisation ends"));
    assert!(
        instance.set(output, 0.1).is_err() && instance.set(0, 0.1).is_err() && instance.set(99, 0.1).is_err()
    );
    assert!(instance.set(torque, f64::NAN).is_err());
    let seed = reference(&instance, "seed");
    let mut early = Instance::new(&Motor::paper_70_khz());
    assert!(
        [-1.0, 1.5, 1e300].into_iter().all(|value| early.set(seed, value).is_err())
            && early.set(seed, 7.0).is_ok()
    );
    instance.step(0.0, 0.1).expect("legal");
    let running = speed(&mut instance);
    let mut other = started();
    other.step(0.0, 0.1).expect("legal");
    assert!(running > 0.1 && running.to_bits() != speed(&mut other).to_bits(), "the friction counts");
    instance.set(on, 0.0).expect("legal");
    instance.set(torque, 1e-5).expect("legal");
    instance.step(0.1, 0.1).expect("legal");
    assert!(speed(&mut instance) < running);
    assert!(instance.step(0.3, 0.1).expect_err("a gap").contains("does not continue"));
    assert!(instance.step(0.2, -0.1).is_err() && instance.step(0.2, f64::NAN).is_err());
    instance.step(0.2, 0.0).expect("no step at all is legal");
    instance.terminate().expect("legal");
    assert!(instance.set(torque, 0.0).is_err() && instance.step(0.2, 0.1).is_err());
    assert!(speed(&mut instance).is_finite());
}

#[test]
fn a_description_has_each_variable_once_with_its_unit() {
    let text = description(&Motor::paper_70_khz());
    let all = variables(&Motor::paper_70_khz());
    for (reference, variable) in all.iter().enumerate() {
        let line = format!("<Float64 name=\"{}\" valueReference=\"{reference}\"", variable.name);
        assert_eq!(text.matches(&line).count(), 1, "{line}");
        let unit = format!("<Unit name=\"{}\">", variable.unit);
        assert!(variable.unit == "1" || text.contains(&unit), "{unit}");
    }
    assert!(
        text.contains(
            "name=\"amplitude\" valueReference=\"2\" causality=\"input\" start=\"1e-8\" unit=\"m\""
        )
    );
}

/// A late start shifts the times and nothing else; still no step may be skipped or repeated.
#[test]
fn a_run_may_begin_at_any_time() {
    let mut late = Instance::new(&Motor::paper_70_khz());
    late.enter_initialization(1024.0).expect("legal");
    late.exit_initialization().expect("legal");
    assert_eq!(late.step(1024.0, 0.125), Ok(1024.125));
    assert!(late.step(1024.126, 0.125).is_err() && late.step(1024.0, 0.125).is_err());
    let mut early = started();
    assert_eq!(early.step(0.0, 0.125), Ok(0.125));
    assert_eq!(speed(&mut late).to_bits(), speed(&mut early).to_bits());
}

/// Until it is switched on, nothing moves.
#[test]
fn a_motor_that_is_off_at_the_start_is_at_rest() {
    let mut instance = Instance::new(&Motor::paper_70_khz());
    let [on, amplitude, impacts] =
        ["drive_on", "vibration_amplitude", "impacts"].map(|name| reference(&instance, name));
    instance.set(on, 0.0).expect("legal");
    instance.enter_initialization(0.0).expect("legal");
    instance.exit_initialization().expect("legal");
    instance.step(0.0, 0.1).expect("legal");
    assert_eq!(
        (instance.get(amplitude), instance.get(impacts), speed(&mut instance)),
        (Ok(0.0), Ok(0.0), 0.0)
    );
    instance.set(on, 1.0).expect("legal");
    instance.step(0.1, 0.1).expect("legal");
    assert!(speed(&mut instance) > 0.1);
}
