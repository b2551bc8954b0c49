//! The inverse of the impact map (docs/numerics-dynamics.md, "The inverse map").

use core::f64::consts::PI;

use crate::flight::platform::phase::Phase;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::elementary::wrapped_angle;
use crate::numerics::error::{Error, within};

/// The phase pi - tau, at which the time-reversed platform has its height at tau.
fn mirrored(phase: Phase) -> Phase {
    // Mirroring rounds the angle, but not its sine and cosine.
    Phase::from_parts(wrapped_angle(PI - phase.angle()), phase.sin(), -phase.cos())
}

impl ImpactMap {
    /// The impact before `state`: the only one that [`Self::step`] maps to `state`.
    ///
    /// Backwards in time the platform vibrates in the same way, but from the phase pi - tau, and the disk
    /// leaves it with the speed |v|. The first impact of that flight is the previous impact. The disk arrives
    /// there with its launch speed, the restitution times the unknown impact speed. So the inverse exists if
    /// the restitution is not 0 and the disk was in flight before the impact, and speeds grow backwards.
    ///
    /// Like [`Self::step`], it is discontinuous where the flight grazes the platform. An impact with zero speed
    /// is possible only as a graze, while the platform falls away faster than the disk. If such an impact is
    /// returned, a launch with zero speed followed it.
    ///
    /// ```
    /// # use bouncing_disk_core::{ImpactMap, ImpactState, Vibration};
    /// let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
    /// let state = ImpactState::from_normalised(0.8, 1.3)?;
    /// let back = map.step_back(map.step(state)?.into())?;
    /// assert!((back.velocity() - state.velocity()).abs() < 1e-12);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for restitution 0, at which the speed of an impact is lost, and if the earlier
    /// speed overflows a double; [`Error::NoLiftOff`] for an impact with zero speed on a platform that does
    /// not fall away; errors of [`Vibration::first_impact`](crate::Vibration::first_impact).
    pub fn step_back(&self, state: ImpactState) -> Result<ImpactState, Error> {
        let restitution = self.restitution();
        within("restitution of an inverse", restitution, f64::MIN_POSITIVE, 1.0, "(0, 1), a normal number")?;
        let impact = self.vibration().impact_after(mirrored(state.phase()), 0.0 - state.velocity())?;
        ImpactState::new(mirrored(impact.phase), impact.velocity / restitution)
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use super::*;
    use crate::flight::platform::vibration::Vibration;
    use crate::numerics::random::SplitMix64;

    fn map(peak_acceleration: f64, restitution: f64) -> ImpactMap {
        ImpactMap::new(Vibration::new(peak_acceleration).expect("legal"), restitution).expect("legal")
    }

    fn state(angle: f64, velocity: f64) -> ImpactState {
        ImpactState::new(Phase::new(angle).expect("finite"), velocity).expect("legal")
    }

    fn apart(a: ImpactState, b: ImpactState) -> f64 {
        let phase = (a.phase().angle() - b.phase().angle()).abs();
        phase.min(TAU - phase).max((a.velocity() - b.velocity()).abs())
    }

    /// In both orders, with the error expected from the derivative.
    #[test]
    fn it_undoes_a_step_and_a_step_undoes_it() {
        let mut random = SplitMix64::new(18);
        let mut undone = [0, 0];
        for _ in 0..20_000 {
            let map = map(0.2 + 6.0 * random.unit(), 0.1 + 0.85 * random.unit());
            let start = state(TAU * random.unit(), -12.0 * random.unit());
            let (impact, derivative) = map.step_with_derivative(start).expect("flies");
            let speed = -impact.velocity;
            let norm = derivative.x_axis.length() + derivative.y_axis.length();
            if speed > 1e-3 {
                let back = map.step_back(impact.into()).expect("flew");
                // The inverse of a 2x2 matrix has its norm over its determinant.
                let determinant = derivative.determinant().abs();
                let tolerance = 1e-13 * (1.0 + norm + norm / determinant) * (1.0 + speed);
                assert!(apart(back, start) <= tolerance, "{map}: {start} -> {back}, {tolerance}");
                undone[0] += 1;
            }
            let before = map.step_back(start).expect("flew");
            if before.velocity() < -1e-3 && start.velocity() < -1e-3 {
                let (again, derivative) = map.step_with_derivative(before).expect("flies");
                let norm = derivative.x_axis.length() + derivative.y_axis.length();
                let tolerance = 1e-13 * (1.0 + norm) * (1.0 - before.velocity());
                assert!(apart(again.into(), start) <= tolerance, "{map}: {start} -> {again:?}");
                undone[1] += 1;
            }
        }
        assert!(undone[0] > 19_000 && undone[1] > 19_000, "{undone:?}");
    }

    /// On a still platform everything is known in closed form.
    #[test]
    fn on_a_still_platform_the_impact_before_was_faster_and_a_flight_earlier() {
        let map = map(0.0, 0.5);
        for (angle, speed) in [(1.0, 0.25), (0.0, 0.3), (6.0, 1e-9), (3.0, 40.0)] {
            let before = map.step_back(state(angle, -speed)).expect("flew");
            assert!((before.velocity() + 2.0 * speed).abs() <= 1e-15 * speed, "{before}");
            let expected = wrapped_angle(angle - 2.0 * speed);
            assert!(apart(before, state(expected, -2.0 * speed)) <= 1e-14 * (1.0 + speed), "{before}");
        }
    }

    #[test]
    fn the_seam_of_the_phase_is_no_place() {
        let map = map(1.7, 0.5);
        for angle in [0.0, 5e-324, PI, PI.next_up(), TAU.next_down(), 1.5 * PI, 0.5 * PI] {
            let before = map.step_back(state(angle, -2.5)).expect("flew");
            assert!((0.0..TAU).contains(&before.phase().angle()));
            let again: ImpactState = map.step(before).expect("flies").into();
            assert!(apart(again, state(angle, -2.5)) < 1e-11, "{angle}: {again}");
        }
    }

    #[test]
    fn where_there_is_no_impact_before() {
        let start = state(1.0, -1.0);
        for restitution in [0.0, 5e-324] {
            let error = map(1.5, restitution).step_back(start).expect_err("forgotten");
            assert!(matches!(error, Error::OutOfRange { field: "restitution of an inverse", .. }), "{error}");
        }
        // The earlier speed overflows a double.
        let error = map(1.5, f64::MIN_POSITIVE).step_back(state(1.0, -30.0)).expect_err("too fast");
        assert!(matches!(error, Error::OutOfRange { field: "axial_impact_velocity", .. }), "{error}");
        // A disk at rest on a platform that does not fall away did not arrive in flight; a graze did.
        assert!(matches!(map(1.5, 0.5).step_back(state(4.0, 0.0)), Err(Error::NoLiftOff { .. })));
        let before = map(1.5, 0.5).step_back(state(0.5 * PI, 0.0)).expect("a graze");
        assert!(before.velocity() < 0.0);
        assert!(matches!(map(0.9, 0.5).step_back(state(0.5 * PI, 0.0)), Err(Error::NoLiftOff { .. })));
        assert!(matches!(map(0.9, 0.5).step_back(state(1.0, -1e17)), Err(Error::FlightTooLong { .. })));
    }
}
