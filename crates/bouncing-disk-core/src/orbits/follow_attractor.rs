//! Following an attractor of the impact map in the forcing: the state is carried over from one value to the
//! next.

use crate::chatter::policy::ChatterPolicy;
use crate::flight::platform::vibration::Vibration;
use crate::map::impact_map::{ImpactMap, ImpactState, OrbitEvent};
use crate::numerics::error::Error;
use crate::run::{Observer, Tick, Unobserved, Watch};

/// Impacts between two possible calls of an observer.
const IMPACTS_BETWEEN_TICKS: usize = 1_024;

/// A value of the forcing, and a state of the followed attractor there.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Followed {
    /// The map at this forcing.
    pub map: ImpactMap,
    /// The paper's Gamma.
    pub axial_forcing: f64,
    /// The last impact of the transient.
    pub state: ImpactState,
}

/// A lazy walk along an attractor: see [`follow_attractor`].
#[derive(Debug, Clone)]
pub struct Following<Forcings> {
    restitution: f64,
    policy: ChatterPolicy,
    transient: usize,
    state: Option<ImpactState>,
    forcings: Forcings,
}

/// Follows the attractor of `start` through `forcings`.
///
/// At each forcing the orbit is followed from the state carried over for `transient` impacts. The walk ends
/// before the first forcing at which the disk comes to rest during this transient: there the attractor is
/// lost to chattering.
pub fn follow_attractor<Forcings: IntoIterator<Item = f64>>(
    restitution: f64,
    forcings: Forcings,
    start: ImpactState,
    transient: usize,
    policy: ChatterPolicy,
) -> Following<Forcings::IntoIter> {
    let forcings = forcings.into_iter();
    Following { restitution, policy, transient, state: Some(start), forcings }
}

impl<Forcings: Iterator<Item = f64>> Iterator for Following<Forcings> {
    type Item = Result<Followed, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        let (state, axial_forcing) = (self.state.take()?, self.forcings.next()?);
        let followed = Vibration::from_axial_forcing(axial_forcing)
            .and_then(|vibration| ImpactMap::new(vibration, self.restitution))
            .and_then(|map| {
                let state = map.state_after(state, self.transient, self.policy, &Unobserved)?;
                Ok(state.map(|state| Followed { map, axial_forcing, state }))
            })
            .transpose()?;
        self.state = followed.as_ref().ok().map(|followed| followed.state);
        Some(followed)
    }
}

impl ImpactMap {
    /// The state `impacts` impacts after `start`, or `None` if the disk comes to rest earlier.
    ///
    /// The items of `observer` are the impacts.
    ///
    /// # Errors
    /// Errors of [`Vibration::first_impact`].
    pub fn state_after(
        &self,
        start: ImpactState,
        impacts: usize,
        policy: ChatterPolicy,
        observer: &dyn Observer,
    ) -> Result<Option<ImpactState>, Error> {
        let watch = Watch::begin(observer, 0, impacts as u64)?;
        let mut work = watch.work();
        let state = self.state_after_ticked(start, impacts, policy, &mut |impacts| work.finish(impacts))?;
        watch.end();
        Ok(state)
    }

    /// [`Self::state_after`] as a part of a longer call; the tick counts impacts.
    pub(crate) fn state_after_ticked(
        &self,
        start: ImpactState,
        impacts: usize,
        policy: ChatterPolicy,
        tick: Tick<'_>,
    ) -> Result<Option<ImpactState>, Error> {
        let (mut orbit, mut state, mut left) = (self.orbit(start, policy), start, impacts);
        while left > 0 {
            let chunk = left.min(IMPACTS_BETWEEN_TICKS);
            for _ in 0..chunk {
                match orbit.advance()? {
                    Some(OrbitEvent::Impact(impact)) => state = impact.into(),
                    Some(_) | None => return Ok(None),
                }
            }
            left -= chunk;
            tick(chunk as u64)?;
        }
        Ok(Some(state))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_period_one_orbit_is_followed_until_it_is_lost() {
        let at = |forcing: f64| {
            ImpactMap::new(Vibration::from_axial_forcing(forcing).expect("legal"), 0.5).expect("legal")
        };
        let start = at(0.335).period_one(1).expect("exists");
        let forcings = (0..60).map(|i| 0.335 + 0.002 * f64::from(i));
        for followed in follow_attractor(0.5, forcings, start, 2_000, ChatterPolicy::Complete) {
            let followed = followed.expect("no failure");
            let exact = followed.map.period_one(1).expect("exists");
            assert!((followed.state.phase().angle() - exact.phase().angle()).abs() < 1e-9);
        }
        // Near its birth the orbit attracts only from very near: the followed state is lost in one large
        // step.
        let lost = follow_attractor(0.5, [0.335, 0.4, 0.32, 0.4], start, 500, ChatterPolicy::Complete);
        assert_eq!(lost.count(), 2);
    }

    #[test]
    fn steps_are_the_same_whoever_watches() {
        let map = ImpactMap::new(Vibration::from_axial_forcing(0.55).expect("legal"), 0.5).expect("legal");
        let start = ImpactState::from_normalised(0.8, 1.3).expect("legal");
        assert_eq!(map.iterate(start, 20_000, &Unobserved), map.steps(start, 20_000));
    }
}
