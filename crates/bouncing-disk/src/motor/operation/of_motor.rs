//! Operating point, torque-speed curve and stall load of a motor in steady operation.

use bouncing_disk_core::{Observer, Progress, Unobserved};

use crate::error::{Error, check};
use crate::motor::batch::shared_orbit::is_shared;
use crate::motor::data_sheet::Motor;
use crate::motor::operation::loaded_motor::{LargestSpeeds, LoadedMotor};
use crate::motor::operation::point::{Estimate, OperatingRow, Operation, Shortfall};
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::operation::stall_load::{StallLoad, stall_load};
use crate::motor::operation::steady_run::{Ends, MAX_OPERATED_ROTORS, continued, curve_of, operate};
use crate::motor::stator::{Stator, on_shaft};
use crate::parameters::system::System;

impl LoadedMotor<'static> {
    /// A motor whose stator moves sinusoidally, with rigid impacts and a constant load.
    pub(crate) fn of_sine(motor: &Motor) -> Result<Self, Error> {
        Ok(Self::on_sine(*motor.rigid_sine()?, motor.mass(), motor.load_torque()))
    }

    /// A rotor of this mass (kg) on a sine, with rigid impacts and a load torque (N m) that equals the
    /// system's.
    pub(crate) fn on_sine(system: System, mass: f64, load_torque: f64) -> Self {
        let fastest = LargestSpeeds::of_sine(&system);
        Self { system, fastest, stator: &Stator::Sine, mass, load_torque, surveyed: None, first_only: false }
    }
}

impl Motor {
    /// The motor in steady operation under a load torque (N m), which replaces the load torque of the data
    /// sheet or is added to the law of its table `[load]`.
    ///
    /// The observer's items are the impacts that may be spent.
    ///
    /// ```
    /// # use bouncing_disk::core::Unobserved;
    /// use bouncing_disk::Motor;
    /// use bouncing_disk::motor::{OperatingSettings, Operation, Shortfall};
    ///
    /// let motor = Motor::paper_70_khz();
    /// let half = 0.5 * motor.largest_torque();
    /// let row = motor.operating_point(half, &OperatingSettings::default(), &Unobserved)?;
    /// // Known to 5 % only: the speed depends on the size of the perturbation at relaunches.
    /// assert!(matches!(row.operation(), Operation::Unsettled(_, Shortfall::Error { .. })));
    /// let point = row.point().expect("a steady state");
    /// let (speed, efficiency) = (point.speed, point.efficiency.expect("it works"));
    /// assert!((speed.value - 8.8).abs() < 0.3 && speed.standard_error < 0.6);
    /// assert!((efficiency.value - 0.115).abs() < 0.01);
    /// // A load that friction cannot hold has no operating point.
    /// let overload = motor.operating_point(2.0 * motor.largest_torque(), &OperatingSettings::default(), &Unobserved)?;
    /// assert!(matches!(overload.operation(), Operation::Runaway { .. }));
    /// # Ok::<(), bouncing_disk::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for illegal settings and a load that is not finite; [`Error::LoadInTime`] for a
    /// time-dependent load; an error of the core for more than [`MAX_OPERATED_ROTORS`] rotors of all members
    /// together; the errors of the flights. A motor whose speed is not known well enough when all impacts are
    /// spent is not an error, but [`Operation::Unsettled`].
    pub fn operating_point(
        &self,
        load_torque: f64,
        settings: &OperatingSettings,
        observer: &dyn Observer,
    ) -> Result<OperatingRow, Error> {
        let mut all = self.torque_speed_curve(&[load_torque], settings, observer)?;
        // There are as many results as loads.
        Ok(all.swap_remove(0))
    }

    /// The motor in steady operation under each of these load torques (N m), in their order, on one vertical
    /// motion. A curve therefore costs little more than a point unless the motor settles slowly under some
    /// loads. (Each load has its own motion only if friction acts back on the stator, because a mode of a
    /// compliant stator twists.) The points share their perturbations, so the curve is smooth, and the
    /// difference between two points is more precise than either.
    ///
    /// The observer's items are the impacts that may be spent.
    ///
    /// # Errors
    /// The errors of [`Self::operating_point`]; [`Error::OutOfRange`] if there is no load.
    pub fn torque_speed_curve(
        &self,
        load_torques: &[f64],
        settings: &OperatingSettings,
        observer: &dyn Observer,
    ) -> Result<Vec<OperatingRow>, Error> {
        curve_of(self.loaded()?, load_torques, settings, observer)
    }

    /// The mean speed without load (rad/s). Its error may exceed the requested error.
    ///
    /// # Errors
    /// The errors of [`Self::operating_point`]; [`Error::NotSettled`] if the speed still drifts or depends on
    /// the start.
    pub fn no_load_speed(&self, settings: &OperatingSettings) -> Result<Estimate, Error> {
        let bare = self.stator_motion().without_law()?;
        let unloaded = LoadedMotor { stator: &bare, ..self.loaded()? };
        // There are as many results as loads.
        match curve_of(unloaded, &[0.0], settings, &Unobserved)?[0].operation() {
            Operation::Steady(point) | Operation::Unsettled(point, Shortfall::Error { .. }) => {
                Ok(point.speed)
            }
            Operation::Unsettled(point, _) => Err(Error::NotSettled {
                speed: point.speed.value,
                standard_error: point.speed.standard_error,
            }),
            // A zero load does not exceed the torque that friction can hold.
            Operation::Runaway { load_torque, .. } => Err(Error::Overpowered { load: *load_torque }),
        }
    }

    /// The load torque that stops the motor, with a bracket: the true stall, without the law of a table
    /// `[load]`.
    ///
    /// The observer's items are the impacts that its two searches may spend.
    ///
    /// # Errors
    /// The errors of [`Self::operating_point`]; [`Error::DoesNotTurn`] for a motor that does not turn without
    /// load; [`Error::NotSettled`] if a speed on which the result depends still drifts after the allowed
    /// impacts.
    pub fn stall_load(
        &self,
        settings: &OperatingSettings,
        observer: &dyn Observer,
    ) -> Result<StallLoad, Error> {
        let bare = self.stator_motion().without_law()?;
        stall_load(&LoadedMotor { stator: &bare, ..self.loaded()? }, settings, observer)
    }

    /// The operation under the sheet's load, starting from the final state of another motor, and the final
    /// state reached.
    pub(crate) fn continued(
        &self,
        from: Option<&Ends>,
        settings: &OperatingSettings,
        observer: &dyn Observer,
    ) -> Result<(OperatingRow, Option<Ends>), Error> {
        let (mut found, ends) = continued(self.loaded()?, from, settings, observer)?;
        // There are as many results as motors.
        Ok((found.rows.swap_remove(0), ends))
    }

    /// The motor under the load of its sheet, which must not depend on time.
    pub(crate) fn loaded(&self) -> Result<LoadedMotor<'_>, Error> {
        if self.load().is_some_and(|load| load.next_change_after(f64::NEG_INFINITY).is_some()) {
            return Err(Error::LoadInTime);
        }
        let (mass, load_torque) = (self.mass(), self.load_torque());
        let (system, stator) = (self.on_shaft()?, self.stator_motion());
        let sine = || LargestSpeeds::of_sine(&system);
        let fastest = stator.driven().map_or_else(sine, |own| LargestSpeeds::of_drives(&system, own));
        Ok(LoadedMotor { system, fastest, stator, mass, load_torque, surveyed: None, first_only: false })
    }

    /// The rotor with the inertia of its shaft on the sine of the sheet.
    pub(crate) fn on_shaft(&self) -> Result<System, Error> {
        match self.stator_motion() {
            Stator::Sine | Stator::Driven(_) => Ok(self.system().bare()),
            Stator::Yielding(_) => Ok(on_shaft(self.system(), self.load(), self.mass())?.bare()),
        }
    }
}

/// Whether one vertical motion carries the rotors of both motors.
fn share_height(one: &Motor, other: &Motor) -> bool {
    let (sheet, another) = (one.parameters(), other.parameters());
    is_shared(one.system(), other.system())
        && match (one.stator_motion(), other.stator_motion()) {
            (Stator::Sine, Stator::Sine) => true,
            (Stator::Driven(_), Stator::Driven(_)) => sheet.drive == another.drive,
            (Stator::Yielding(own), Stator::Yielding(_)) => {
                let is_same = (sheet.stator, sheet.load) == (another.stator, another.load);
                !own.twists() && is_same && one.mass().to_bits() == other.mass().to_bits()
            }
            _ => false,
        }
}

/// The steady operation of many motors, each under the load of its data sheet, in their order: for example
/// for maps of efficiency over lag and load, or over preload and amplitude. Consecutive motors that differ
/// only in load, friction, lag, twist, radii or mass share one vertical motion, so list such motors together.
/// Rotors that act back on their stator are computed one by one.
///
/// The observer's items are the motors.
///
/// # Errors
/// The errors of [`Motor::operating_point`]; [`Error::OutOfRange`] if there is no motor;
/// [`Error::LoadInTime`] for a time-dependent load.
pub fn operations(
    motors: &[Motor],
    settings: &OperatingSettings,
    observer: &dyn Observer,
) -> Result<Vec<OperatingRow>, Error> {
    check(!motors.is_empty(), "number of motors", 0.0, "[1, 1000000]")?;
    let (total, mut all) = (motors.len() as u64, Vec::with_capacity(motors.len()));
    let most = (MAX_OPERATED_ROTORS / settings.members.max(1)).max(1);
    for group in motors.chunk_by(share_height).flat_map(|group| group.chunks(most)) {
        let done = all.len() as u64;
        let observer = |_: Progress| observer.observe(Progress { done, total });
        let loaded: Vec<_> = group.iter().map(Motor::loaded).collect::<Result<_, _>>()?;
        all.extend(operate(&loaded, settings, &observer)?.rows);
    }
    // The answer does not matter, as nothing is left to stop.
    let _ = observer.observe(Progress { done: total, total });
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::refused;

    #[test]
    fn a_curve_is_that_of_its_loads_and_a_map_that_of_its_motors() {
        let motor = Motor::paper_70_khz();
        let settings = OperatingSettings { relative_error: 0.05, members: 4, ..OperatingSettings::default() };
        let largest = motor.largest_torque();
        let loads = [0.0, 0.2 * largest, 0.5 * largest, 1.1 * largest];
        let curve = motor.torque_speed_curve(&loads, &settings, &Unobserved).expect("no failure");
        assert!(curve.iter().zip(loads).all(|(point, load)| point.load_torque().to_bits() == load.to_bits()));
        let motors: Vec<Motor> =
            loads.iter().map(|&load| motor.with(|sheet| sheet.load_torque = load).expect("legal")).collect();
        let map = operations(&motors, &settings, &Unobserved).expect("no failure");
        assert_eq!(curve, map);
        let Operation::Runaway { largest_torque, .. } = curve[3].operation() else {
            panic!("{:?}", curve[3])
        };
        assert!((largest_torque / largest - 1.0).abs() < 1e-12);
        // Motors that share nothing, between motors that do.
        let other = motor.with(|sheet| sheet.amplitude = Some(1.1e-8)).expect("legal");
        let mixed = operations(
            &[motors[0].clone(), other.clone(), motors[1].clone(), motors[2].clone()],
            &settings,
            &Unobserved,
        )
        .expect("no failure");
        let alone = other.operating_point(0.0, &settings, &Unobserved).expect("no failure");
        assert_eq!(mixed[1], alone);
        let speed = |row: &OperatingRow| row.point().map(|point| point.speed.value);
        assert!(speed(&mixed[0]) > speed(&mixed[2]) && speed(&mixed[2]) > speed(&mixed[3]));
        let unloaded = motor.no_load_speed(&settings).expect("steady");
        assert!((unloaded.value - speed(&curve[0]).expect("steady")).abs() < 4.0 * unloaded.standard_error);
    }

    /// A motor of 40 kHz with contacts of 0.56 periods is either tapped in every period at once, or flies
    /// irregularly for thousands of periods first. Fourth-order integration in small steps gives 2.97 rad/s
    /// for the taps, and 3.626 rad/s for taps of 0.77 periods.
    #[test]
    fn coexisting_motions_are_branches_and_none_is_averaged() {
        use crate::motor::{AxialMotion, Life, MotorParameters};
        use crate::parameters::contact::Contact;
        let wave = |microseconds: f64| {
            let sheet = |sheet: &mut MotorParameters| {
                (sheet.drive_frequency, sheet.amplitude) = (40e3, Some(0.5e-6));
                (sheet.peak_angular_speed, sheet.twist_amplitude) = (Some(12.0), None);
                (sheet.mass, sheet.density, sheet.rotor_radius) = (Some(0.020), None, None);
                (sheet.contact_radius, sheet.gyration_radius) = (12.5e-3, Some(10e-3));
                (sheet.preload_force, sheet.preload_acceleration) = (Some(5.0), None);
                sheet.contact = Some(Contact::lasting(1e-6 * microseconds));
            };
            Motor::paper_70_khz().with(sheet).expect("legal")
        };
        let settings = OperatingSettings::default();
        let row = wave(14.0).operating_point(0.0, &settings, &Unobserved).expect("no failure");
        let [tapped, flying] = [0, 1].map(|branch| *row.branches[branch].steady().expect("known"));
        assert_eq!(row.branches.len(), 2);
        assert_eq!(tapped.motion, AxialMotion::Periodic { periods: 1, impacts: 1 });
        assert!((tapped.speed.value - 2.97).abs() < 0.006, "{tapped:?}");
        let AxialMotion::Irregular { life: Life::Mean(life) } = flying.motion else { panic!("{flying:?}") };
        // A run of this length sees a few of them end.
        assert!((0.3..10.0).contains(&life.value) && flying.speed.value > 8.0, "{flying:?}");
        for point in [tapped, flying] {
            let out = point.restitution_loss.value + point.friction_loss.value;
            let error = point.restitution_loss.standard_error + point.input_power.standard_error;
            assert!((point.input_power.value - out).abs() < 1e-6 * out + 3.0 * error, "{point:?}");
        }
        let soft = wave(19.25).operating_point(0.0, &settings, &Unobserved).expect("no failure");
        let speed = soft.steady().expect("known").speed;
        assert!(soft.branches.len() == 1 && (speed.value - 3.626).abs() < 0.003, "{speed:?}");
        // A free rotor stops under a load other than the torque on a blocked one.
        let stall = wave(14.0).stall_load(&settings, &Unobserved).expect("it turns");
        assert_eq!(stall.others.len(), 1);
        for own in [&stall, &stall.others[0]] {
            let blocked = own.blocked_torque.expect("nothing acts back");
            assert!(own.bracket[0] < own.torque.value && own.torque.value < own.bracket[1], "{own:?}");
            assert!((blocked.value / own.torque.value - 1.0).abs() < 0.05, "{own:?}");
        }
    }

    #[test]
    fn loads_that_are_none_are_refused_by_name() {
        let (motor, settings) = (Motor::paper_70_khz(), OperatingSettings::default());
        refused("load_torque", [f64::NAN, f64::INFINITY], |load| {
            motor.operating_point(load, &settings, &Unobserved)
        });
        refused("number of loads", [()], |()| motor.torque_speed_curve(&[], &settings, &Unobserved));
        refused("number of motors", [()], |()| operations(&[], &settings, &Unobserved));
    }
}
