//! How long orbits live beyond a crisis, and the power law of their mean life.

use super::exit::{Exit, ExitTest};
use super::following::until;
use super::{AfterCrisis, Crisis, CrisisEvent, CrisisSearch};
use crate::chatter::policy::ChatterPolicy;
use crate::flight::platform::vibration::Vibration;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::error::{Error, within};
use crate::numerics::lifetime::Lifetime;
use crate::numerics::power_law::{NoPowerLaw, PowerLaw, PowerLawPoint, fit_power_law};
use crate::run::Observer;

/// Impacts of the orbit on the attractor from one start to the next.
const BETWEEN_STARTS: usize = 37;

/// Impacts of that orbit before the first start.
const TRANSIENT: usize = 2_000;

/// The fewest orbits that must have come to rest for a mean life to count in the power law.
const FEWEST_ENDED: u64 = 20;

/// The mean survival time, beyond a crisis, of orbits that start on the former attractor.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MeanLife {
    /// The distance from the crisis in Gamma, above 0.
    pub beyond: f64,
    /// Impacts of all orbits over the number that came to rest: the mean of an exponential law, even if some
    /// orbits were not followed to their end. The largest double if none came to rest.
    pub impacts: f64,
    /// Its standard error, relative to the mean; the largest double if none came to rest.
    pub relative_error: f64,
    /// Orbits that came to rest or underwent the event of the crisis.
    pub ended: u64,
    /// All orbits.
    pub orbits: u64,
}

impl MeanLife {
    /// The mean life of orbits with these lives; those with `most` impacts have not ended.
    pub(super) fn of(lives: impl Iterator<Item = usize>, most: usize, beyond: f64) -> Self {
        let (mut orbits, mut ended, mut total) = (0, 0, 0.0);
        for life in lives {
            orbits += 1;
            ended += u64::from(life < most);
            total += life as f64;
        }
        let life = Lifetime::new(total, ended).ok();
        let impacts = life.and_then(|life| life.mean()).unwrap_or(f64::MAX);
        let relative_error = if ended > 0 { 1.0 / (ended as f64).sqrt() } else { f64::MAX };
        Self { beyond, impacts, relative_error, ended, orbits }
    }
}

/// The mean survival times beyond a crisis and their power law.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct CrisisLives {
    /// The mean survival times, in the order of the given distances from the crisis.
    pub lives: Vec<MeanLife>,
    /// The power law of the mean survival time over the distance from the crisis, from distances at which 20
    /// orbits or more came to rest; or the reason why there is none. Its exponent is negative.
    pub scaling: Result<PowerLaw, NoPowerLaw>,
}

impl Crisis {
    /// The mean survival times of orbits at these distances above 0 beyond the crisis (in Gamma), and their
    /// power law. They start from one orbit on the attractor just below the crisis; their number is `orbits`
    /// in [1, 1e6], and each is followed for at most `impacts` >= 1 impacts.
    ///
    /// The items of `observer` are the orbits at one distance, counted from 0 for each.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a number out of its range; [`Error::NotSettled`] if the disk comes to rest
    /// below the crisis; errors of [`Vibration::first_impact`](crate::Vibration::first_impact).
    pub fn lives(
        &self,
        beyond: &[f64],
        orbits: usize,
        impacts: usize,
        observer: &dyn Observer,
    ) -> Result<CrisisLives, Error> {
        within("orbits beyond a crisis", orbits as f64, 1.0, 1.0e6, "[1, 1000000]")?;
        within("impacts beyond a crisis", impacts as f64, 1.0, f64::MAX, "at least 1")?;
        let map = |forcing| ImpactMap::new(Vibration::from_axial_forcing(forcing)?, self.restitution);
        let starts = self.starts(&map(self.bracket.0)?, orbits, observer)?;
        let (search, exit) = self.exit(&starts, impacts, observer)?;
        let mut lives = Vec::with_capacity(beyond.len());
        for &beyond in beyond {
            within("distance from a crisis", beyond, f64::MIN_POSITIVE, f64::MAX, "(0, inf)")?;
            let forcing = self.forcing + beyond;
            let lived = until(&map(forcing)?, &exit.at(&search, forcing)?, &starts, impacts, observer)?;
            lives.push(MeanLife::of(lived.iter().map(|own| own.lived), impacts, beyond));
        }
        let points: Vec<_> = lives
            .iter()
            .filter(|life| life.ended >= FEWEST_ENDED && life.impacts > 0.0)
            .map(|life| PowerLawPoint {
                x: life.beyond,
                y: life.impacts,
                relative_error: life.relative_error,
            })
            .collect();
        let scaling = fit_power_law(&points)?;
        Ok(CrisisLives { lives, scaling })
    }

    /// The event that ends a life, from these states on the attractor, and a search for it.
    fn exit(
        &self,
        starts: &[ImpactState],
        impacts: usize,
        observer: &dyn Observer,
    ) -> Result<(CrisisSearch, Exit), Error> {
        let event = match self.after {
            AfterCrisis::Rest(_) => CrisisEvent::Rest,
            AfterCrisis::Merged { bands } => CrisisEvent::BandMerging { bands },
            AfterCrisis::Left { .. } => CrisisEvent::Growth,
        };
        let search = CrisisSearch::new(self.restitution, self.bracket)?.for_event(event)?;
        let forcing = self.bracket.0;
        let what = "the bands of the attractor below a crisis";
        let mut exit = search.exit(forcing, starts)?.ok_or(Error::NoBranch { what, parameter: forcing })?;
        if let Exit::Region(region) = &mut exit {
            let map = search.map(forcing)?;
            let lived = until(&map, &ExitTest::Recorded(region), starts, impacts, observer)?;
            region.extend(&lived);
        }
        Ok((search, exit))
    }

    /// States on the attractor just below the crisis.
    fn starts(
        &self,
        map: &ImpactMap,
        count: usize,
        observer: &dyn Observer,
    ) -> Result<Vec<ImpactState>, Error> {
        let (mut state, mut between) = (self.attractor, TRANSIENT);
        let mut starts = Vec::with_capacity(count);
        while starts.len() < count {
            let next = map.state_after(state, between, ChatterPolicy::Complete, observer)?;
            let what = "an orbit on the attractor below a crisis";
            state = next.ok_or(Error::NotSettled { what, iterations: 0, residual: 0.0 })?;
            starts.push(state);
            between = BETWEEN_STARTS;
        }
        Ok(starts)
    }
}
