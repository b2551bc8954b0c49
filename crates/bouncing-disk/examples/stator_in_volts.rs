//! What a stator does without a rotor under a voltage: amplitude, current and power.
//!
//!     cargo run --release -p bouncing-disk --example stator_in_volts
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use bouncing_disk::Motor;
use bouncing_disk::parameters::StatorParameters;

fn main() -> Result<(), bouncing_disk::Error> {
    // The paper's motor on a stator of 10 g that an impedance analyser has measured, under 20 V.
    let table = StatorParameters {
        mass: Some(0.010),
        quality: Some(300.0),
        volts: Some(20.0),
        anti_resonance: Some(70.4e3),
        capacitance: Some(1.2e-9),
        ..StatorParameters::default()
    };
    let motor = Motor::paper_70_khz().with(|sheet| {
        sheet.amplitude = None;
        sheet.stator = Some(table);
    })?;
    let omega = motor.system().platform().angular_frequency();
    let stator = motor.stator().expect("it yields");
    let electrical = stator.electrical_input_at(omega).expect("it has a circuit");
    let (current, _) = electrical.current.expect("it has a capacitance");
    println!("A = {:.2e} m without a rotor", motor.system().platform().amplitude());
    println!(
        "{:.0} mA, {:.2} W; {:.2e} m at 1 kHz more",
        1e3 * current,
        electrical.power,
        stator.amplitude_at(omega * 71.0 / 70.0)
    );
    Ok(())
}
