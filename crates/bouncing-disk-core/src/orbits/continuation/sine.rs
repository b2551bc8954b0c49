//! Branches above a sine.

use core::f64::consts::TAU;

use glam::DMat2;

use super::ContinuedMap;
use crate::flight::launch::{Impact, Launch};
use crate::flight::platform::phase::Phase;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::elementary::{cos, sin, sin_cos};
use crate::numerics::error::Error;
use crate::orbits::closing::Flight;
use crate::orbits::periodic::PeriodicOrbit;

fn launch(flight: &Flight) -> Result<Launch, Error> {
    Ok(Launch::known(Phase::new(flight.from.0)?, flight.from.1))
}

impl ContinuedMap for ImpactMap {
    fn check_orbit(&self, orbit: &PeriodicOrbit) -> Result<(), Error> {
        Self::check_orbit(self, orbit)
    }

    fn is_grazed(&self, flight: &Flight) -> Result<bool, Error> {
        let impact = Impact {
            periods: 0,
            remainder: flight.duration,
            turns: 0,
            phase: Phase::new(flight.to.0)?,
            velocity: flight.to.1,
            evaluations: 0,
        };
        Ok(self.vibration().graze_margin(launch(flight)?, &impact) <= 0.0)
    }

    fn gap(&self, flight: &Flight, after: f64) -> Option<[f64; 3]> {
        let (peak, (phase, speed)) = (self.vibration().peak_acceleration(), flight.from);
        let start = cos(phase);
        let (sine, cosine) = sin_cos(phase + after);
        let risen = 2.0 * cos(phase + 0.5 * after) * sin(0.5 * after);
        let gap = (speed + peak * start) * after - 0.5 * after * after - peak * risen;
        Some([gap, speed - after + peak * (start - cosine), peak * sine - 1.0])
    }

    fn duration_found(&self, flight: &Flight) -> Result<f64, Error> {
        Ok(self.vibration().first_impact(launch(flight)?)?.duration())
    }

    fn orbit_through(
        &self,
        states: Vec<ImpactState>,
        durations: &[f64],
    ) -> Option<(PeriodicOrbit, [f64; 2])> {
        let n = states.len();
        let (mut monodromy, mut determinant, mut total) = (DMat2::IDENTITY, 1.0, 0.0);
        for (i, &h) in durations.iter().enumerate() {
            monodromy = self.derivative(states[i], states[(i + 1) % n], h) * monodromy;
            determinant *= self.restitution() * self.restitution();
            total += h;
        }
        let platform_periods = (total / TAU).round() as u64;
        let trace = monodromy.x_axis.x + monodromy.y_axis.y;
        Some((PeriodicOrbit::of(self, states, platform_periods, monodromy), [trace, determinant]))
    }
}
