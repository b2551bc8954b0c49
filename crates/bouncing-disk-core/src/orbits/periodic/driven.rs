//! Periodic orbits on a drive: Newton's method by multiple shooting, and a search from a grid of starts.

use core::f64::consts::TAU;

use glam::{DMat2, DVec2};

use super::newton::{Shooting, moved, prime_period, same_orbit, speed_scale};
use super::search::OrbitSearch;
use super::{MAX_NEWTON_STEPS, MAX_PERIOD, PeriodicOrbit};
use crate::chatter::policy::ChatterPolicy;
use crate::flight::platform::phase::Phase;
use crate::map::driven_map::{DrivenEvent, DrivenMap};
use crate::map::impact_map::ImpactState;
use crate::numerics::block_cyclic::solve_block_cyclic;
use crate::numerics::error::{Error, within};
use crate::run::{Observer, Watch, in_parallel};

/// A shooting residual (rad, relative speed) at which an orbit counts as found, if it no longer shrinks.
const SHOOTING_RESIDUAL: f64 = 1.0e-11;

/// The error of one step of the map (rad, relative speed): that of its phase, made generous.
const MAP_ROUNDING: f64 = 1.0e-14;

impl DrivenMap {
    /// The periodic orbit next to `guess` (its impacts in order), with its multipliers. Its errors are
    /// estimates: what a rounding of each impact makes of the orbit, and that of the trace.
    ///
    /// ```
    /// use bouncing_disk_core::{Drive, DrivenMap, ImpactMap, Vibration};
    ///
    /// let sine = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
    /// let exact = sine.period_one(1).expect("it exists");
    /// let map = DrivenMap::new(Drive::from(*sine.vibration()), 0.5)?;
    /// let orbit = map.refine(&[exact])?;
    /// assert!((orbit.states[0].velocity() - exact.velocity()).abs() < 1e-12);
    /// assert!((orbit.monodromy.determinant() - 0.25).abs() < 1e-12);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an empty guess or one longer than [`MAX_PERIOD`]; [`Error::NotSettled`];
    /// [`Error::ImpactOnKink`] for an orbit without multipliers; [`Error::ImpactWithoutSpeed`] and
    /// [`Error::NoPlatformPeriods`] for a disk at rest; those of [`Self::step`].
    pub fn refine(&self, guess: &[ImpactState]) -> Result<PeriodicOrbit, Error> {
        within("period", guess.len() as f64, 1.0, MAX_PERIOD as f64, "[1, 4096] impacts")?;
        let mut states = guess.to_vec();
        let mut residual = f64::INFINITY;
        for iterations in 1..=MAX_NEWTON_STEPS {
            let shooting = self.shoot(&states)?;
            let worst = shooting.worst;
            if worst <= SHOOTING_RESIDUAL && worst >= 0.5 * residual || worst == 0.0 {
                let orbit = self.measured(states, &shooting);
                orbit.check_motion()?;
                return Ok(orbit);
            }
            residual = worst;
            let steps = solve_block_cyclic(&shooting.derivatives, &shooting.right);
            states = moved(&states, &steps).ok_or(Error::NotSettled {
                what: "multiple shooting",
                iterations,
                residual,
            })?;
        }
        Err(Error::NotSettled { what: "multiple shooting", iterations: MAX_NEWTON_STEPS, residual })
    }

    /// The periodic orbits that Newton's method finds from the first impacts of the orbits of a grid of
    /// starts, the shortest first: all of them only if the grid is fine enough. Orbits with an impact on a
    /// kink have no multipliers and are left out, and so are those that come to rest.
    ///
    /// The items of `observer` are the starts.
    ///
    /// # Errors
    /// [`Error::Stopped`] if the observer stops it.
    pub fn periodic_orbits(
        &self,
        search: &OrbitSearch,
        observer: &dyn Observer,
    ) -> Result<Vec<PeriodicOrbit>, Error> {
        let (columns, rows) = (search.phases() as usize, search.speeds() as usize);
        let watch = Watch::begin(observer, 0, (columns * rows) as u64)?;
        let found = in_parallel(columns * rows, |start| {
            watch.ask()?;
            let angle = TAU * ((start % columns) as f64 + 0.5) / columns as f64;
            let share = ((start / columns) as f64 + 0.5) / rows as f64;
            let state = ImpactState::new(Phase::new(angle)?, -share * self.impact_speed_bound())?;
            let orbits = self.orbits_from(state, search);
            watch.finish(1);
            Ok::<_, Error>(orbits)
        });
        let mut orbits: Vec<PeriodicOrbit> = Vec::new();
        for of_start in found {
            for orbit in of_start? {
                if !orbits.iter().any(|known| same_orbit(known, &orbit)) {
                    orbits.push(orbit);
                }
            }
        }
        watch.end();
        orbits.sort_by_key(|orbit| (orbit.period(), orbit.platform_periods));
        Ok(orbits)
    }

    /// No impact of a periodic orbit is faster: from w the disk rises with at most V + r w, falls by the
    /// height of the platform more than it rises, and meets the platform's V. (That holds for rigid impacts;
    /// with a contact that takes time it is the range of the starts of a search.)
    #[must_use]
    pub fn impact_speed_bound(&self) -> f64 {
        let (r, bounds) = (self.restitution(), self.drive().bounds());
        let (speed, fall) = (bounds.speed * (1.0 + r), bounds.highest - bounds.lowest);
        let lost = 1.0 - r * r;
        (speed + (speed * speed + 2.0 * fall * lost).sqrt()) / lost
    }

    /// The orbits that the first impacts of one orbit lead to.
    fn orbits_from(&self, start: ImpactState, search: &OrbitSearch) -> Vec<PeriodicOrbit> {
        let impacts = self.orbit(start, ChatterPolicy::Complete).map_while(|event| match event {
            Ok(DrivenEvent::Impact(landing)) => Some(ImpactState::from(landing.impact)),
            _ => None,
        });
        let mut states = vec![start];
        states.extend(impacts.take(search.max_impacts() - 1));
        let mut orbits = Vec::new();
        for n in 1..=states.len() {
            let Ok(orbit) = self.refine(&states[..n]) else { continue };
            let prime = prime_period(&orbit.states, 2.0 * orbit.position_error + 1.0e-9);
            let orbit = if prime < n { self.refine(&orbit.states[..prime]) } else { Ok(orbit) };
            let within = |orbit: &PeriodicOrbit| orbit.platform_periods <= search.max_platform_periods();
            orbits.extend(orbit.ok().filter(|orbit| within(orbit)));
        }
        orbits
    }

    fn shoot(&self, states: &[ImpactState]) -> Result<Shooting, Error> {
        Shooting::from(states, speed_scale(states), |state| {
            self.step_with_derivative(state).map(|(landing, derivative)| (landing.impact, derivative))
        })
    }

    /// The orbit with its errors.
    fn measured(&self, states: Vec<ImpactState>, shooting: &Shooting) -> PeriodicOrbit {
        let room = (shooting.worst + MAP_ROUNDING) * speed_scale(&states);
        let mut position_error = 0.0_f64;
        for signs in [DVec2::new(room, room), DVec2::new(room, -room)] {
            for step in solve_block_cyclic(&shooting.derivatives, &vec![signs; states.len()]) {
                position_error = position_error.max(step.x.abs()).max(step.y.abs());
            }
        }
        let trace = |matrix: DMat2| matrix.x_axis.x + matrix.y_axis.y;
        let own = trace(shooting.monodromy);
        let mut trace_error = MAP_ROUNDING * own.abs();
        for step in [DVec2::new(position_error, 0.0), DVec2::new(0.0, position_error)] {
            // Where the orbit is as near as this to its end, the multipliers mean nothing.
            let there = moved(&states, &vec![step; states.len()]).and_then(|states| self.shoot(&states).ok());
            trace_error =
                there.map_or(f64::MAX, |there| trace_error.max((trace(there.monodromy) - own).abs()));
        }
        PeriodicOrbit {
            states,
            platform_periods: shooting.turns,
            monodromy: shooting.monodromy,
            position_error,
            trace_error,
        }
    }
}
