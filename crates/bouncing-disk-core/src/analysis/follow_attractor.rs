//! Following an attractor of the impact map in the forcing: the state is carried over from one value to the next.

use crate::chatter::policy::ChatterPolicy;
use crate::error::{Error, within};
use crate::map::impact_map::{ImpactMap, ImpactState, Orbit, OrbitEvent};
use crate::observer::{Observer, Tick, Unobserved, Watch};
use crate::platform::vibration::Vibration;
use crate::read_checked;

/// A value of the forcing, and a state of the followed attractor there.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedFollowed"))]
pub struct Followed {
    /// The map at this forcing.
    pub map: ImpactMap,
    /// The paper's Gamma.
    pub axial_forcing: f64,
    /// The last impact of the transient.
    pub state: ImpactState,
}

read_checked!(Followed as UncheckedFollowed {
    map: ImpactMap,
    axial_forcing: f64,
    state: ImpactState,
});

impl Followed {
    /// Checks what is read: the map is that of the forcing.
    fn check(&self) -> Result<(), Error> {
        let own = Vibration::from_axial_forcing(self.axial_forcing)?;
        let (found, expected) = (self.map.vibration().peak_acceleration(), own.peak_acceleration());
        within("peak acceleration of the map", found, expected, expected, "pi times the axial forcing")?;
        Ok(())
    }
}

/// A lazy walk along an attractor: see [`follow_attractor`].
#[derive(Debug, Clone)]
pub struct Following<Forcings> {
    restitution: f64,
    policy: ChatterPolicy,
    transient: usize,
    state: Option<ImpactState>,
    /// The forcing at which an observer has stopped.
    under_way: Option<(Followed, Transient)>,
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
    let forcings = forcings.into_iter();
    Following { restitution, policy, transient, state: Some(start), under_way: None, forcings }
}

impl<Forcings: Iterator<Item = f64>> Following<Forcings> {
    /// The next item with an observer; the items of the observer are the impacts of the transient. Where it
    /// breaks, the item is [`Error::Stopped`], and the next call goes on after the impacts that were
    /// followed.
    pub fn next_observed(&mut self, observer: &dyn Observer) -> Option<Result<Followed, Error>> {
        self.advance(observer).transpose()
    }

    fn advance(&mut self, observer: &dyn Observer) -> Result<Option<Followed>, Error> {
        let (followed, mut transient) = match self.under_way.take() {
            Some(under_way) => under_way,
            None => {
                let (Some(state), Some(axial_forcing)) = (self.state.take(), self.forcings.next()) else {
                    return Ok(None);
                };
                let map = ImpactMap::new(Vibration::from_axial_forcing(axial_forcing)?, self.restitution)?;
                (Followed { map, axial_forcing, state }, Transient::new(&map, state, self.policy))
            }
        };
        match transient.follow_observed(self.transient, observer) {
            Ok(Some(state)) => {
                self.state = Some(state);
                Ok(Some(Followed { state, ..followed }))
            }
            Ok(None) => Ok(None),
            Err(error) => {
                if matches!(error, Error::Stopped { .. }) {
                    self.under_way = Some((followed, transient));
                }
                Err(error)
            }
        }
    }
}

/// The first impacts of an orbit.
#[derive(Debug, Clone)]
struct Transient {
    orbit: Orbit,
    state: ImpactState,
    /// Impacts that were followed.
    impacts: usize,
}

impl Transient {
    /// Impacts after which an observer may be asked.
    const CHUNK: usize = 1_024;

    fn new(map: &ImpactMap, start: ImpactState, policy: ChatterPolicy) -> Self {
        Self { orbit: map.orbit(start, policy), state: start, impacts: 0 }
    }

    /// The state so many impacts after the start; `None` if the disk comes to rest before. The tick counts
    /// impacts.
    fn follow(&mut self, impacts: usize, tick: Tick<'_>) -> Result<Option<ImpactState>, Error> {
        // Copies, so that the next flight does not wait for what the last one has stored.
        let (mut orbit, mut state) = (self.orbit.clone(), self.state);
        while self.impacts < impacts {
            let chunk = (impacts - self.impacts).min(Self::CHUNK);
            for _ in 0..chunk {
                match orbit.advance()? {
                    Some(OrbitEvent::Impact(impact)) => state = impact.into(),
                    Some(OrbitEvent::Attachment(_)) | None => return Ok(None),
                }
            }
            self.impacts += chunk;
            if let Err(stopped) = tick(chunk as u64) {
                (self.orbit, self.state) = (orbit, state);
                return Err(stopped);
            }
        }
        Ok(Some(state))
    }

    fn follow_observed(
        &mut self,
        impacts: usize,
        observer: &dyn Observer,
    ) -> Result<Option<ImpactState>, Error> {
        let watch = Watch::begin(observer, self.impacts as u64, impacts as u64)?;
        let mut work = watch.work();
        let state = self.follow(impacts, &mut |impacts| work.finish(impacts))?;
        watch.end();
        Ok(state)
    }
}

impl<Forcings: Iterator<Item = f64>> Iterator for Following<Forcings> {
    type Item = Result<Followed, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        self.next_observed(&Unobserved)
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
        self.state_after_observed(start, impacts, policy, &Unobserved)
    }

    /// [`Self::state_after`] with an observer; the items are the impacts.
    ///
    /// # Errors
    /// Those of [`Self::state_after`]; [`Error::Stopped`] if the observer breaks. Who wants to go on from
    /// there advances an [`Orbit`].
    pub fn state_after_observed(
        &self,
        start: ImpactState,
        impacts: usize,
        policy: ChatterPolicy,
        observer: &dyn Observer,
    ) -> Result<Option<ImpactState>, Error> {
        Transient::new(self, start, policy).follow_observed(impacts, observer)
    }

    /// [`Self::state_after`] as a part of a longer call; the tick counts impacts.
    pub(crate) fn state_after_ticked(
        &self,
        start: ImpactState,
        impacts: usize,
        policy: ChatterPolicy,
        tick: Tick<'_>,
    ) -> Result<Option<ImpactState>, Error> {
        Transient::new(self, start, policy).follow(impacts, tick)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::StopAfter;

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

    #[test]
    fn a_walk_that_is_stopped_goes_on_after_the_impacts_it_followed() {
        let map = ImpactMap::new(Vibration::from_axial_forcing(0.45).expect("legal"), 0.5).expect("legal");
        let start = map.period_one(1).expect("exists");
        let walk = || follow_attractor(0.5, [0.45, 0.53, 0.55], start, 30_000, ChatterPolicy::Complete);
        let at_once: Vec<_> = walk().map(|followed| followed.expect("no failure")).collect();
        assert_eq!(at_once.len(), 3);
        let (mut walk, mut stops, mut got) = (walk(), 0, Vec::new());
        while let Some(followed) = walk.next_observed(&StopAfter::calls(1 + stops % 4)) {
            match followed {
                Ok(followed) => got.push(followed),
                Err(Error::Stopped { total: 30_000, .. }) => stops += 1,
                Err(error) => panic!("{error}"),
            }
        }
        assert!(got == at_once && stops > 5, "{stops}");
    }

    #[test]
    fn a_transient_can_be_stopped() {
        let map = ImpactMap::new(Vibration::from_axial_forcing(0.55).expect("legal"), 0.5).expect("legal");
        let start = ImpactState::from_normalised(0.8, 1.3).expect("legal");
        for policy in [ChatterPolicy::Complete, crate::testing::PAPER_POLICY] {
            let stopped = map.state_after_observed(start, usize::MAX, policy, &StopAfter::calls(3));
            assert_eq!(stopped, Err(Error::Stopped { done: 2 * 8_192, total: u64::MAX }));
        }
        let stopped = map.iterate_observed(start, u64::MAX, &StopAfter::calls(3));
        assert_eq!(stopped, Err(Error::Stopped { done: 2 * 8_192, total: u64::MAX }));
        let observed = map.iterate_observed(start, 20_000, &Unobserved);
        assert_eq!(observed, map.iterate(start, 20_000));
    }
}
