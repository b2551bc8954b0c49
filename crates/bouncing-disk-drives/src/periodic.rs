//! Periodic orbits on a drive: Newton's method with multiple shooting, and a search from a grid of starts
//! (docs/numerics-impacts.md, "Periodic orbits").

use core::f64::consts::TAU;
use core::ops::RangeInclusive;

use bouncing_disk_core::orbits::{OrbitSearch, PeriodicOrbit, Stability};
use bouncing_disk_core::parts::{
    Catalogue, MAX_NEWTON_STEPS, Shooting, moved, next_to_margin, phase_difference, prime_period, settled,
    solve_block_cyclic, speed_scale,
};
use bouncing_disk_core::run::{Watch, in_parallel};
use bouncing_disk_core::{ChatterPolicy, Error, ImpactState, Observer, OrbitEvent, Phase};
use glam::{DMat2, DVec2};

use self::fold::Beside;
use self::one_impact::OneImpact;
use crate::driven_map::DrivenMap;

mod fold;
mod one_impact;

/// The shooting residual (rad, relative speed) below which an orbit counts as found if the residual no longer
/// shrinks.
const SHOOTING_RESIDUAL: f64 = 1.0e-11;

/// A generous bound on the error of one step of the map (rad, relative speed), which is the error of the
/// phase.
const MAP_ROUNDING: f64 = 1.0e-14;

/// Largest distance (rad) between the end of an iteration and its one-impact orbit: near a fold it is the
/// square root of the residual.
const REACH: f64 = 1.0e-3;

/// Distance (rad, and relative speed) within which an orbit near the doubling at which it is born repeats the
/// shorter orbit: the square root of |1 - T + D|.
const DOUBLED: f64 = 0.1;

/// The position error (rad) up to which the end of an iteration is kept although the exact phase is known.
const EXACT: f64 = 1.0e-12;

impl DrivenMap {
    /// The periodic orbit near `guess` (its impacts in order), with its multipliers. Its errors are
    /// estimates: the effects of rounding each impact on the orbit and on the trace.
    ///
    /// Near a fold an iteration may end where there is no orbit. An orbit is returned only if it exists
    /// beyond rounding, or as [`Marginal`](bouncing_disk_core::orbits::Stability::Marginal) if rounding
    /// decides whether it exists.
    ///
    /// ```
    /// use bouncing_disk_core::{ImpactMap, Vibration};
    /// use bouncing_disk_drives::{Drive, DrivenMap};
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
    /// [`Error::OutOfRange`] for an empty guess or one longer than
    /// [`MAX_PERIOD`](bouncing_disk_core::orbits::MAX_PERIOD); [`Error::NotSettled`]; [`Error::ImpactOnKink`]
    /// for an orbit without multipliers; [`Error::ImpactWithoutSpeed`] and [`Error::NoPlatformPeriods`] for a
    /// disk at rest; errors of [`Self::step`].
    pub fn refine(&self, guess: &[ImpactState]) -> Result<PeriodicOrbit, Error> {
        let orbit = self.iterated(guess)?;
        let (residual, iterations) = (orbit.position_error, MAX_NEWTON_STEPS);
        let periods = orbit.platform_periods;
        let one_impact = (orbit.period() == 1).then(|| self.one_impact(periods..=periods)).flatten();
        let existing = self.existing(orbit, one_impact.as_ref()).into_iter().next();
        let orbit = existing.ok_or(Error::NotSettled { what: "multiple shooting", iterations, residual })?;
        orbit.check_motion().map(|()| orbit)
    }

    /// The end of an iteration from a guess; near a fold it need not be an orbit.
    fn iterated(&self, guess: &[ImpactState]) -> Result<PeriodicOrbit, Error> {
        let shoot = |states: &[ImpactState]| self.shoot(states);
        let (states, shooting) = settled(guess, SHOOTING_RESIDUAL, shoot, moved, &mut |_| Ok(()))?;
        let orbit = self.measured(states, &shooting);
        orbit.check_motion().map(|()| orbit)
    }

    /// The periodic orbits that Newton's method finds, starting from the first impacts of orbits on a grid of
    /// starts. The list is complete only if the grid is fine enough. Orbits with an impact on a kink have no
    /// multipliers and are omitted, as are orbits that come to rest. With rigid impacts, the one-impact
    /// orbits follow from the phases at which the platform has the required velocity, and all of them are
    /// found. A family, as on a triangle, is represented by one member, whose position error is the length of
    /// the family.
    ///
    /// They are sorted like [`OrbitsFound`](bouncing_disk_core::orbits::OrbitsFound): by number of impacts,
    /// then of platform periods, then by decreasing speed of the fastest impact. Each orbit begins with its
    /// fastest impact.
    ///
    /// Near a fold the result contains both orbits or neither; if rounding decides whether they exist, it
    /// contains one [marginal](bouncing_disk_core::orbits::Stability::Marginal) orbit.
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
        let one_impact = self.one_impact(1..=search.max_platform_periods());
        let found = in_parallel(columns * rows, |start| {
            watch.ask()?;
            let angle = TAU * ((start % columns) as f64 + 0.5) / columns as f64;
            let share = ((start / columns) as f64 + 0.5) / rows as f64;
            let state = ImpactState::new(Phase::new(angle)?, -share * self.impact_speed_bound())?;
            let orbits = self.orbits_from(state, search, one_impact.as_ref());
            watch.finish(1);
            Ok::<_, Error>(orbits)
        });
        let (mut catalogue, mut of_one) = (Catalogue::default(), Vec::new());
        for of_start in found {
            for orbit in of_start? {
                if one_impact.is_some() && orbit.period() == 1 {
                    of_one.push(orbit);
                } else {
                    catalogue.add(orbit, 1, false);
                }
            }
        }
        let of_one = one_impact.map_or_else(Vec::new, |all| all.with_found(&of_one));
        watch.end();
        Ok(catalogue.into_sorted_with(of_one))
    }

    /// The one-impact orbits from their phases; `None` for compliant contacts, for which the phases are
    /// unknown.
    fn one_impact(&self, platform_periods: RangeInclusive<u64>) -> Option<OneImpact> {
        self.compliant().is_none().then(|| OneImpact::of(self, platform_periods))
    }

    /// A bound on the impact speeds of periodic orbits. After an impact at the relative speed w the disk
    /// rises at no more than V + r w, V the platform's largest speed. It then falls by at most the platform's
    /// range of heights more than it rises, and hits the platform, which moves at no more than V. The bound
    /// holds for rigid impacts; for a compliant contact it only limits the starts of a search.
    #[must_use]
    pub fn impact_speed_bound(&self) -> f64 {
        let (r, bounds) = (self.restitution(), self.drive().bounds());
        let (speed, fall) = (bounds.speed * (1.0 + r), bounds.highest - bounds.lowest);
        let lost = 1.0 - r * r;
        (speed + (speed * speed + 2.0 * fall * lost).sqrt()) / lost
    }

    /// The orbits found from the first impacts of one orbit, each with its fastest impact first.
    fn orbits_from(
        &self,
        start: ImpactState,
        search: &OrbitSearch,
        one_impact: Option<&OneImpact>,
    ) -> Vec<PeriodicOrbit> {
        let impacts = self.orbit(start, ChatterPolicy::Complete).map_while(|event| match event {
            Ok(OrbitEvent::Impact(landing)) => Some(ImpactState::from(landing)),
            _ => None,
        });
        let mut states = vec![start];
        states.extend(impacts.take(search.max_impacts() - 1));
        let mut orbits = Vec::new();
        for n in 1..=states.len() {
            let Ok(orbit) = self.prime(self.iterated(&states[..n])) else { continue };
            let within = |orbit: &PeriodicOrbit| orbit.platform_periods <= search.max_platform_periods();
            let existing = self.existing(orbit, one_impact).into_iter();
            // Near a doubled orbit is the orbit that it doubles, passed twice.
            let prime = existing.filter(|orbit| prime_period_of(orbit) == orbit.period() && within(orbit));
            orbits.extend(prime.filter_map(|orbit| self.fastest_first(orbit)));
        }
        orbits
    }

    /// The orbit at the end of an iteration, or the shorter orbit that it repeats.
    fn prime(&self, end: Result<PeriodicOrbit, Error>) -> Result<PeriodicOrbit, Error> {
        let end = end?;
        let prime = prime_period_of(&end);
        if prime < end.period() { self.iterated(&end.states[..prime]) } else { Ok(end) }
    }

    /// The orbit, starting with its fastest impact.
    fn fastest_first(&self, mut orbit: PeriodicOrbit) -> Option<PeriodicOrbit> {
        let fastest = (1..orbit.period()).fold(0, |fastest, i| {
            if orbit.states[i].velocity() < orbit.states[fastest].velocity() { i } else { fastest }
        });
        if fastest > 0 {
            orbit.states.rotate_left(fastest);
            orbit.monodromy = self.shoot(&orbit.states).ok()?.monodromy;
        }
        Some(orbit)
    }

    /// The orbits that exist at the end of an iteration or, at a fold, near it; nearest first. Away from
    /// folds this is the end itself.
    fn existing(&self, end: PeriodicOrbit, one_impact: Option<&OneImpact>) -> Vec<PeriodicOrbit> {
        if let Some(all) = one_impact.filter(|_| end.period() == 1) {
            if let Some(member) = all.member(self, &end) {
                return vec![member];
            }
            let apart = |orbit: &PeriodicOrbit| {
                phase_difference(orbit.states[0].phase().angle(), end.states[0].phase().angle()).abs()
            };
            let mut orbits = all.orbits_with(end.platform_periods).to_vec();
            orbits.retain(|orbit| apart(orbit) <= REACH);
            orbits.sort_by(|one, other| apart(one).total_cmp(&apart(other)));
            if let Some(nearest) = orbits.first_mut()
                && end.position_error <= EXACT
                && apart(nearest) <= EXACT
                && !next_to_fold(&end)
                && nearest.stability() != Stability::Marginal
            {
                *nearest = end;
            }
            return orbits;
        }
        if self.is_beside_its_doubling(&end) {
            return vec![self.doubled(end)];
        }
        if !next_to_fold(&end) && self.keeps_its_derivative(&end) {
            return vec![end];
        }
        match self.orbits_beside(&end) {
            Some(Beside::Orbits(orbits)) => orbits,
            Some(Beside::Family) | None => vec![undecided(end)],
        }
    }

    /// Whether an orbit nearly repeats its first half, and the orbit of this half is near its doubling.
    fn is_beside_its_doubling(&self, end: &PeriodicOrbit) -> bool {
        let half = prime_period(&end.states, DOUBLED);
        2 * half == end.period()
            && self
                .iterated(&end.states[..half])
                .is_ok_and(|half| next_to_margin(half.monodromy, half.determinant()).1)
    }

    /// An orbit near the doubling at which it is born; it is not a member of a pair. Its weak direction has
    /// opposite signs in both halves, so roundings of one sign do not move it.
    fn doubled(&self, end: PeriodicOrbit) -> PeriodicOrbit {
        let Ok(shooting) = self.shoot(&end.states) else { return end };
        let room = (shooting.worst + MAP_ROUNDING) * speed_scale(&end.states);
        let (mut position_error, mut trace_error) = (end.position_error, end.trace_error);
        for signs in [DVec2::new(room, room), DVec2::new(room, -room)] {
            let half = end.period() / 2;
            let right: Vec<_> = (0..end.period()).map(|i| if i < half { signs } else { -signs }).collect();
            let steps = solve_block_cyclic(&shooting.derivatives, &right);
            for step in &steps {
                position_error = position_error.max(step.x.abs()).max(step.y.abs());
            }
            let there = moved(&end.states, &steps).and_then(|states| self.shoot(&states).ok());
            let trace = there.map_or(f64::MAX, |there| there.monodromy.x_axis.x + there.monodromy.y_axis.y);
            trace_error = trace_error.max((trace - end.trace()).abs());
        }
        PeriodicOrbit { position_error, trace_error, ..end }
    }

    /// Whether the condition of Newton and Kantorovich holds: within twice the error of an orbit, the trace
    /// changes by less than half of 1 - T + D. Away from folds the condition can fail only if the
    /// acceleration may jump.
    fn keeps_its_derivative(&self, orbit: &PeriodicOrbit) -> bool {
        if self.drive().next_joint(0.0).is_none() {
            return true;
        }
        let reach = 2.0 * orbit.position_error;
        let most = 0.5 * (1.0 - orbit.trace() + orbit.determinant()).abs();
        [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)].into_iter().all(|(phase, velocity)| {
            let step = DVec2::new(phase * reach, velocity * reach);
            let there = moved(&orbit.states, &vec![step; orbit.period()]);
            let there = there.and_then(|states| self.shoot(&states).ok());
            there.is_some_and(|there| {
                let trace = there.monodromy.x_axis.x + there.monodromy.y_axis.y;
                (trace - orbit.trace()).abs() < most
            })
        })
    }

    fn shoot(&self, states: &[ImpactState]) -> Result<Shooting, Error> {
        Shooting::from(states, speed_scale(states), |state| {
            self.step_with_derivative(state).map(|(landing, derivative)| (landing.impact, derivative))
        })
    }

    /// The orbit with these impacts, which are known to form one.
    pub(crate) fn orbit_through(&self, states: Vec<ImpactState>) -> Result<PeriodicOrbit, Error> {
        let shooting = self.shoot(&states)?;
        Ok(self.measured(states, &shooting))
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
            // If the orbit is this close to its end, the multipliers are meaningless.
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

/// The number of impacts after which an orbit first repeats itself.
fn prime_period_of(orbit: &PeriodicOrbit) -> usize {
    prime_period(&orbit.states, 2.0 * orbit.position_error + 1.0e-9)
}

/// Whether a multiplier is near 1.
fn next_to_fold(orbit: &PeriodicOrbit) -> bool {
    next_to_margin(orbit.monodromy, orbit.determinant()).0
}

/// The orbit, marked as one whose existence depends on rounding.
fn undecided(orbit: PeriodicOrbit) -> PeriodicOrbit {
    let inside = 1.0 + orbit.determinant() - orbit.trace().abs();
    PeriodicOrbit { trace_error: orbit.trace_error.max(inside.abs()), ..orbit }
}

#[cfg(test)]
mod tests;
