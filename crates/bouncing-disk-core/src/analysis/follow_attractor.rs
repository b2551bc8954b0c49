//! Following an attractor of the impact map in the forcing: the state is carried over from one value to the next.

use crate::chatter::policy::ChatterPolicy;
use crate::error::Error;
use crate::map::impact_map::{ImpactMap, ImpactState, OrbitEvent};
use crate::platform::vibration::Vibration;

/// A value of the forcing, and a state of the followed attractor there.
#[derive(Debug, Clone, Copy, PartialEq)]
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

/// Follows the attractor that `start` lies on (or is attracted to) through `forcings`.
///
/// At each forcing the orbit from the state carried over runs for `transient` impacts. The walk ends before the
/// forcing at which the disk comes to rest during that transient: the attractor is lost to chattering.
pub fn follow_attractor<Forcings: IntoIterator<Item = f64>>(
    restitution: f64,
    forcings: Forcings,
    start: ImpactState,
    transient: usize,
    policy: ChatterPolicy,
) -> Following<Forcings::IntoIter> {
    Following { restitution, policy, transient, state: Some(start), forcings: forcings.into_iter() }
}

impl<Forcings: Iterator<Item = f64>> Following<Forcings> {
    fn advance(&mut self) -> Result<Option<Followed>, Error> {
        let (Some(start), Some(axial_forcing)) = (self.state.take(), self.forcings.next()) else {
            return Ok(None);
        };
        let map = ImpactMap::new(Vibration::from_axial_forcing(axial_forcing)?, self.restitution)?;
        let Some(state) = map.state_after(start, self.transient, self.policy)? else { return Ok(None) };
        self.state = Some(state);
        Ok(Some(Followed { map, axial_forcing, state }))
    }
}

impl<Forcings: Iterator<Item = f64>> Iterator for Following<Forcings> {
    type Item = Result<Followed, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        self.advance().transpose()
    }
}

impl ImpactMap {
    /// The state `impacts` impacts after `start`, or `None` if the disk comes to rest before.
    ///
    /// # Errors
    /// Those of [`Vibration::first_impact`].
    pub fn state_after(
        &self,
        start: ImpactState,
        impacts: usize,
        policy: ChatterPolicy,
    ) -> Result<Option<ImpactState>, Error> {
        let mut state = start;
        let mut orbit = self.orbit(start, policy);
        for _ in 0..impacts {
            match orbit.advance()? {
                Some(OrbitEvent::Impact(impact)) => state = impact.into(),
                Some(OrbitEvent::Attachment(_)) | None => return Ok(None),
            }
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
        // Next to its birth the orbit attracts only from very near: the followed state is lost in one large step.
        let lost = follow_attractor(0.5, [0.335, 0.4, 0.32, 0.4], start, 500, ChatterPolicy::Complete);
        assert_eq!(lost.count(), 2);
    }
}
