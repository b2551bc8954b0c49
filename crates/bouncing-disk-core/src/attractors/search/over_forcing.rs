//! Attractors and the shares of their basins as the forcing varies.

use super::settings::AttractorSearch;
use super::{Attractor, AttractorKind, Attractors};
use crate::flight::platform::vibration::Vibration;
use crate::map::impact_map::ImpactMap;
use crate::numerics::error::{Error, within};
use crate::numerics::stored::read_checked;
use crate::orbits::periodic::{PeriodicOrbit, phase_difference};
use crate::run::{Observer, Progress, Watch};

/// Largest number of forcings of one call.
pub const MAX_FORCINGS: usize = 1 << 16;

/// An attractor that is followed from one forcing to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct FollowedAttractor {
    /// The first forcing at which it was found, by its number in the list: it appears between the previous
    /// forcing and this one.
    pub appears: usize,
    /// The last forcing at which it was found: it vanishes between this forcing and the next.
    pub vanishes: usize,
}

/// The attractors at one forcing.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct AttractorsAt {
    /// Gamma.
    pub axial_forcing: f64,
    /// The attractors, with their shares of the trapping region at this forcing.
    pub attractors: Attractors,
    /// The index of each of them in [`BasinFractions::followed`].
    pub followed: Vec<usize>,
    /// The distance of each from its counterpart at the previous forcing (rad; a radian counts as much as the
    /// speed P at the present forcing). It is the mean distance of an impact of one attractor from the
    /// nearest impact of the other, in the direction in which this mean is larger. `None` for an attractor
    /// that appears, and for the disk at rest.
    pub moved: Vec<Option<f64>>,
}

/// The shares of the basins over the forcing.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedFractions"))]
pub struct BasinFractions {
    /// Coefficient of restitution, in [0, 1).
    pub restitution: f64,
    /// The attractors at each forcing, in the order of the forcings.
    pub at: Vec<AttractorsAt>,
    /// The attractors by the forcing at which they appear; the disk at rest is number 0.
    pub followed: Vec<FollowedAttractor>,
}

read_checked!(BasinFractions as UncheckedFractions {
    restitution: f64,
    at: Vec<AttractorsAt>,
    followed: Vec<FollowedAttractor>,
});

impl BasinFractions {
    /// Checks deserialised data: each attractor is a followed one between its appearance and its end.
    fn check(&self) -> Result<(), Error> {
        let unfitting = |what, found: usize, expected: usize| {
            Err(Error::Unfitting { what, found: found as u64, expected: expected as u64 })
        };
        let map = |forcing| ImpactMap::new(Vibration::from_axial_forcing(forcing)?, self.restitution);
        map(1.0)?;
        for (index, at) in self.at.iter().enumerate() {
            if *at.attractors.map() != map(at.axial_forcing)? {
                return unfitting(
                    "forcings before one whose attractors belong to another map",
                    index,
                    self.at.len(),
                );
            }
            let count = at.attractors.all().len();
            for (what, found) in [
                ("attractors that are followed", at.followed.len()),
                ("distances of attractors", at.moved.len()),
            ] {
                if found != count {
                    return unfitting(what, found, count);
                }
            }
            for own in &at.followed {
                let Some(FollowedAttractor { appears, vanishes }) = self.followed.get(*own) else {
                    return unfitting("number of a followed attractor", *own, self.followed.len());
                };
                if index < *appears || index > *vanishes {
                    return unfitting("forcing of an attractor that is not there", index, *appears);
                }
            }
        }
        Ok(())
    }

    /// The attractor followed under this number, at each forcing: `None` if it does not exist there.
    pub fn over(&self, followed: usize) -> impl Iterator<Item = (f64, Option<&Attractor>)> {
        self.at.iter().map(move |at| {
            let number = at.followed.iter().position(|own| *own == followed);
            (at.axial_forcing, number.and_then(|number| at.attractors.all().get(number)))
        })
    }
}

/// The location of an attractor: phases (rad) and velocities (units of g/omega).
pub(super) type Places = Vec<(f64, f64)>;

/// The places of a moving attractor; `None` for the disk at rest.
pub(super) fn places(attractor: &Attractor) -> Option<Places> {
    let impacts = |orbit: &PeriodicOrbit| {
        Some(orbit.states.iter().map(|state| (state.phase().angle(), state.velocity())).collect())
    };
    match &attractor.kind {
        AttractorKind::Rest(_) => None,
        AttractorKind::Periodic(known) => impacts(known.orbit()),
        AttractorKind::Marginal(orbit) => impacts(orbit),
        AttractorKind::Chaotic { recurrence, .. } | AttractorKind::Transient { recurrence, .. } => {
            Some(recurrence.cells.centres().collect())
        }
    }
}

/// The mean distance of a place of `one` from the nearest place of `other` (rad; a radian counts as much as
/// the speed P).
fn one_way(one: &Places, other: &Places, peak: f64) -> f64 {
    let nearest = |from: &(f64, f64)| {
        let square = other.iter().fold(f64::INFINITY, |least, to| {
            let (phase, velocity) = (phase_difference(to.0, from.0), (to.1 - from.1) / peak);
            least.min(phase * phase + velocity * velocity)
        });
        square.sqrt()
    };
    one.iter().map(nearest).sum::<f64>() / one.len() as f64
}

/// The index of the counterpart in `old` of each of `new`, and the distance: the nearest pairs within
/// `reach` first, each once.
pub(super) fn matched(
    old: &[Option<Places>],
    new: &[Option<Places>],
    (reach, peak): (f64, f64),
) -> Vec<Option<(usize, f64)>> {
    let mut pairs = Vec::new();
    for (i, from) in old.iter().enumerate() {
        for (j, to) in new.iter().enumerate() {
            if let (Some(from), Some(to)) = (from, to) {
                let distance = one_way(from, to, peak).max(one_way(to, from, peak));
                if distance <= reach {
                    pairs.push((distance, i, j));
                }
            }
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
    let mut taken = vec![false; old.len()];
    let mut matches = vec![None; new.len()];
    for (distance, i, j) in pairs {
        if !taken[i] && matches[j].is_none() {
            taken[i] = true;
            matches[j] = Some((i, distance));
        }
    }
    matches
}

/// The attractors at each of `forcings` (Gamma, in the order in which they are to be followed) for this
/// restitution, matched from forcing to forcing: each continues the nearest attractor at the previous
/// forcing, if this is within `reach` (rad, in [0, 100]). An attractor without such a predecessor appears,
/// and one without a successor vanishes. An orbit that doubles its period continues as the doubled orbit near
/// it.
///
/// The items of `observer` are the forcings.
///
/// ```
/// use bouncing_disk_core::attractors::{AttractorSearch, basin_fractions_over};
/// use bouncing_disk_core::Unobserved;
///
/// // The period-1 orbit appears at Gamma = 1/3; beside it there is the disk at rest.
/// let search = AttractorSearch::default().with_starts(200)?;
/// let over = basin_fractions_over(0.5, &[0.32, 0.36, 0.40], &search, 0.3, &Unobserved)?;
/// assert_eq!(over.followed.len(), 2);
/// assert_eq!((over.followed[1].appears, over.followed[1].vanishes), (1, 2));
/// let shares: Vec<_> = over.over(1).map(|(_, own)| own.map(|own| own.starts.value())).collect();
/// assert!(shares[0].is_none() && shares[2] > shares[1]);
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
///
/// # Errors
/// [`Error::OutOfRange`] for a forcing, the restitution or `reach`; [`Error::TooLarge`] for more than
/// [`MAX_FORCINGS`]; errors of [`ImpactMap::attractors`].
pub fn basin_fractions_over(
    restitution: f64,
    forcings: &[f64],
    search: &AttractorSearch,
    reach: f64,
    observer: &dyn Observer,
) -> Result<BasinFractions, Error> {
    let none = BasinFractions { restitution, at: Vec::new(), followed: Vec::new() };
    none.extended(forcings, search, reach, observer)
}

impl BasinFractions {
    /// Adds the attractors at more forcings after the present ones: the same result as from a single call
    /// with all forcings, even after storing and reading.
    ///
    /// So a long list of forcings can be computed in parts.
    ///
    /// The items of `observer` are the added forcings.
    ///
    /// ```
    /// # use bouncing_disk_core::attractors::{AttractorSearch, basin_fractions_over};
    /// # use bouncing_disk_core::Unobserved;
    /// # let search = AttractorSearch::default().with_starts(200)?;
    /// let begun = basin_fractions_over(0.5, &[0.32, 0.36], &search, 0.3, &Unobserved)?;
    /// let whole = basin_fractions_over(0.5, &[0.32, 0.36, 0.40], &search, 0.3, &Unobserved)?;
    /// assert_eq!(begun.extended(&[0.40], &search, 0.3, &Unobserved)?, whole);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// Errors of [`basin_fractions_over`]; [`Error::TooLarge`] for more than [`MAX_FORCINGS`] in all.
    pub fn extended(
        &self,
        forcings: &[f64],
        search: &AttractorSearch,
        reach: f64,
        observer: &dyn Observer,
    ) -> Result<Self, Error> {
        within("distance from one forcing to the next", reach, 0.0, 100.0, "[0, 100] (rad)")?;
        let count = self.at.len().saturating_add(forcings.len());
        if count > MAX_FORCINGS {
            let (count, limit) = (count as u64, MAX_FORCINGS as u64);
            return Err(Error::TooLarge { what: "forcings", count, limit });
        }
        let map = |forcing: &f64| ImpactMap::new(Vibration::from_axial_forcing(*forcing)?, self.restitution);
        let maps = forcings.iter().map(map).collect::<Result<Vec<_>, _>>()?;
        let total = forcings.len() as u64;
        let watch = Watch::begin(observer, 0, total)?;
        let mut extended = self.clone();
        let mut before: Vec<_> =
            self.at.last().map_or_else(Vec::new, |at| at.attractors.all().iter().map(places).collect());
        for (index, (map, forcing)) in maps.iter().zip(forcings).enumerate() {
            let part = |_: Progress| observer.observe(Progress { done: index as u64, total });
            let attractors = map.attractors(search, &part).map_err(|error| match error {
                Error::Stopped { .. } => Error::Stopped { done: index as u64, total },
                other => other,
            })?;
            let now: Vec<_> = attractors.all().iter().map(places).collect();
            let matches = matched(&before, &now, (reach, map.vibration().peak_acceleration()));
            before = now;
            extended.add(*forcing, attractors, &matches);
        }
        watch.end();
        Ok(extended)
    }

    /// Adds the attractors at the next forcing, some of which continue earlier ones.
    fn add(&mut self, forcing: f64, attractors: Attractors, matches: &[Option<(usize, f64)>]) {
        let index = self.at.len();
        let last = self.at.last().map_or(&[][..], |at| &at.followed);
        let mut followed = Vec::with_capacity(matches.len());
        for (number, own) in matches.iter().enumerate() {
            // The disk at rest exists at every forcing and comes first.
            let before = if number == 0 { last.first() } else { own.and_then(|(old, _)| last.get(old)) };
            match before {
                Some(before) => followed.push(*before),
                None => {
                    followed.push(self.followed.len());
                    self.followed.push(FollowedAttractor { appears: index, vanishes: index });
                }
            }
        }
        for own in &followed {
            self.followed[*own].vanishes = index;
        }
        let moved = matches.iter().map(|own| own.map(|(_, distance)| distance)).collect();
        self.at.push(AttractorsAt { axial_forcing: forcing, attractors, followed, moved });
    }
}
