//! Crises of a chaotic attractor: where its orbits begin to come to rest, to change their band or to leave its
//! part of the plane, and the tangency of manifolds that is the reason (docs/numerics-dynamics.md, "Crises").
//! Below, a rest stands for any of these events.
//!
//! The margin of the bracket: at its lower end no orbit rests in all M impacts, but the crisis may lie a
//! distance m below this end, because lives near the crisis exceed any M. So lives are measured at the
//! distances w, 4w, 16w and 64w above the lower end; w is the shortest distance at which 8 orbits rest and
//! beyond which lives shrink. A life T at the distance d (two errors larger) implies a life of at most 2 T
//! ((d + m)/m)^gamma at the lower end. Lives rise in steps, because the attractor's gaps close one after the
//! other (at restitution 0.8 by a factor of 20 over a factor of 2.5 in distance). So gamma is the steepest
//! power between neighbouring distances, two errors larger, and the factor 2 allows for a step in between. If
//! ln (20 k) rests are expected, with k the number of lower ends tried, 5 of 100 searches see none by chance.
//! The margin is the least m for which a rest would have been seen according to the best of the four
//! distances.
//!
//! An attractor counts as periodic if the lost orbits' largest exponent at the lower end is below 5 ln n/n
//! (n = 4,000 impacts; the exponent of neutral motion is a few ln n/n). At restitution 0.2 a periodic
//! attractor ends at 0.9549475, the chaotic one at 0.957192295.
//!
//! An independent program finds the crisis by direct iteration: between 0.957192294 and 0.957192296 at
//! restitution 0.2, and between 0.80913530 (no rest in 5e8 impacts) and 0.80913531 (mean life 7e5) at 0.3.
//! The ranges at other restitutions are 0.4858200 to 0.4858205 at 0.6, 0.4296065 to 0.4296070 at 0.7 and
//! 0.3994755 to 0.3994770 at 0.8. In 24 searches for each restitution, from starts over a fifth of the range,
//! all brackets contain these results at 0.3, 0.6 and 0.7 and the tangency at 0.5; at 0.8, 22 brackets do.
//!
//! The range is 0.87914656 to 0.87914657 at 0.25, 0.74502883 to 0.74502891 at 0.35 and 0.60551764 to 0.60551768
//! at 0.45 (no rest in 2e7 impacts below, rests above). The brackets contain these ranges; the tangency at 0.45
//! lies at 0.6055176549.
//!
//! For mergings of 2b bands the program takes the mean phases of every 2b-th impact in blocks of 200 such impacts.
//! Bands have merged if these means change places within 1e7 to 4e7 impacts. Two bands merge into one between
//! 0.903358313 and 0.903358326 at restitution 0.2, 0.758713476 and 0.758713489 at 0.3, 0.550064858 and
//! 0.550064871 at 0.5, 0.478694030 and 0.478694123 at 0.6.
//! Four merge into two between 0.748192700 and 0.748192725 at 0.3, 0.544964978 and 0.544964991 at 0.5. At 0.7
//! and 0.8 both bands are lost to rest first.
//!
//! For growths the program counts the cells that 1e6 impacts visit. The count rises within 3e-7 of 0.767062222
//! and 0.774656274 at 0.3, and of 0.547556395 and 0.552497334 at 0.5. In 24 searches each from random starts, all
//! brackets contain these mergings (0.3, 0.5, 0.6; four into two at 0.5) and growths (0.3, 0.5).
//!
//! Beyond the crisis of Fig. 6 lives were measured with 200 orbits at each of 14 distances. The unstable
//! manifold of the period-1 orbit touches at 0.560753164.

use core::ops::ControlFlow;

use crate::chaos::manifold::{Side, of_saddle};
use crate::flight::platform::vibration::Vibration;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::elementary::ln;
use crate::numerics::error::{Error, within};
use crate::orbits::periodic::{Multipliers, PeriodicOrbit};
use crate::run::{Observer, Progress, Unobserved, Watch};

mod exit;
mod following;
pub(crate) mod lifetimes;
mod tangency;

use exit::{Exit, ExitTest};
use following::{End, until};
use tangency::{Pair, tangencies};

/// The range of forcings in which to find a crisis, its event, and the number of impacts to follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrisisSearch {
    restitution: f64,
    low: f64,
    high: f64,
    samples: u32,
    impacts: u64,
    event: CrisisEvent,
}

/// The event that ends the life of an orbit on the attractor, and so the crisis that is sought. A rest always ends it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum CrisisEvent {
    /// The orbit comes to rest.
    Rest,
    /// The orbit changes from one band to another: an attractor of twice as many `bands` merges into one of `bands`.
    /// Before, every impact in one band is followed, `bands` impacts later, by one on the other side of a saddle of
    /// that many impacts. The range must begin where the attractor has these bands: beyond the doubling in which the
    /// saddle ceased to attract.
    BandMerging {
        /// The number of bands after the merging, in [1, 16].
        bands: u32,
    },
    /// The orbit leaves the part of the plane that the attractor occupied at all forcings followed before. Changes of
    /// less than 1/128 of a turn in the phase, or as much in units of 1 + P in the velocity, go unnoticed.
    Growth,
}

impl CrisisEvent {
    const fn verb(self) -> &'static str {
        match self {
            Self::Rest => "comes to rest",
            Self::BandMerging { .. } => "comes to rest or changes its band",
            Self::Growth => "comes to rest or leaves the attractor's part of the plane",
        }
    }
}

impl CrisisSearch {
    /// A search at this restitution in (0, 1) between two values of Gamma, `low` < `high`: the first below
    /// the crisis, the second beyond it. At each forcing 64 orbits are followed, for 2e6 impacts in all.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for any of these numbers.
    pub fn new(restitution: f64, (low, high): (f64, f64)) -> Result<Self, Error> {
        let search =
            Self { restitution, low, high, samples: 64, impacts: 2_000_000, event: CrisisEvent::Rest };
        search.check().map(|()| search)
    }

    /// The same search with `samples` orbits in [16, 1e6], followed for `impacts` in [1e4, 1e12] in all, and
    /// for at least 200 each. More impacts make the bracket narrower.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for either number.
    pub fn with_samples(self, samples: u32, impacts: u64) -> Result<Self, Error> {
        let search = Self { samples, impacts, ..self };
        search.check().map(|()| search)
    }

    /// The same search for a crisis of another kind than the loss to rest.
    ///
    /// ```
    /// # use bouncing_disk_core::chaos::{CrisisEvent, CrisisKind, CrisisSearch};
    /// # use bouncing_disk_core::Unobserved;
    /// // The two bands of the attractor of Fig. 6 become one where they touch the period-1 orbit.
    /// let search = CrisisSearch::new(0.5, (0.548, 0.552))?.with_samples(64, 400_000)?;
    /// let merging = search.for_event(CrisisEvent::BandMerging { bands: 1 })?;
    /// let crisis = merging.crisis(None, &Unobserved)?.expect("a crisis");
    /// assert_eq!(crisis.kind(), CrisisKind::BandMerging { bands: 1 });
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the number of bands.
    pub fn for_event(self, event: CrisisEvent) -> Result<Self, Error> {
        let search = Self { event, ..self };
        search.check().map(|()| search)
    }

    fn check(&self) -> Result<(), Error> {
        let most = Vibration::MAX_PEAK_ACCELERATION / core::f64::consts::PI;
        within(
            "restitution of a crisis",
            self.restitution,
            f64::MIN_POSITIVE,
            1.0 - f64::EPSILON / 2.0,
            "(0, 1)",
        )?;
        within("forcing below a crisis", self.low, 0.0, most, "[0, 3.18e7]")?;
        within("forcing beyond a crisis", self.high, self.low.next_up(), most, "(low end, 3.18e7]")?;
        within("samples of a crisis", f64::from(self.samples), 16.0, 1.0e6, "[16, 1000000]")?;
        within("impacts of a crisis", self.impacts as f64, 1.0e4, 1.0e12, "[1e4, 1e12]")?;
        if let CrisisEvent::BandMerging { bands } = self.event {
            within("bands of a crisis", f64::from(bands), 1.0, 16.0, "[1, 16]")?;
        }
        Ok(())
    }

    /// The map at a forcing.
    fn map(&self, forcing: f64) -> Result<ImpactMap, Error> {
        ImpactMap::new(Vibration::from_axial_forcing(forcing)?, self.restitution)
    }
}

/// A crisis: a chaotic attractor whose orbits begin to come to rest, or to undergo another [`CrisisEvent`].
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Crisis {
    /// Coefficient of restitution.
    pub restitution: f64,
    /// Gamma of the tangency; without a tangency, the middle of the bracket.
    pub forcing: f64,
    /// The error of `forcing`. Without a tangency it is half the width of the bracket. With a tangency it is
    /// the part of the bracket below the tangency: the crisis cannot lie above this point, except by the last
    /// change of the forcing along the saddle and by rounding.
    pub forcing_error: f64,
    /// The values of Gamma between which followed orbits place the crisis. The crisis certainly lies below
    /// the second, at which the event happened to an orbit. It lies above the first with a confidence of 95 %:
    /// otherwise 95 of 100 searches would have seen the event at a forcing where this one saw
    /// none. This assumes that mean survival times rise no more steeply towards the crisis than the measured
    /// ones.
    pub bracket: (f64, f64),
    /// An impact on the attractor near the lower end of the bracket.
    pub attractor: ImpactState,
    /// The motion of the disk just beyond the crisis, after it has left the attractor.
    pub after: AfterCrisis,
    /// The tangency of manifolds that causes the crisis, or the reason why none is known.
    pub tangency: Result<Tangency, NoTangency>,
}

/// The motion of a disk just beyond a crisis, after it has left the attractor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum AfterCrisis {
    /// It comes to rest, and moves on like this.
    Rest(LifeAfterRest),
    /// It is in the band into which two have merged.
    Merged {
        /// The number of bands after the merging.
        bands: u32,
    },
    /// It leaves the part of the plane that the attractor occupied, without coming to rest.
    Left {
        /// The orbits that were followed, each for as long as a life could have been.
        orbits: u32,
        /// Those of them that came back and stayed for 100 impacts or more.
        returned: u32,
    },
}

/// The motion of a disk after a rest just beyond a crisis. The disk always leaves a rest in the same state,
/// so one orbit decides for each forcing. The 16 forcings tried lie between the crisis and the upper end of
/// its bracket; if a tangency locates the crisis, they lie within the first sixteenth of that range.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum LifeAfterRest {
    /// At every forcing the disk rests again after at most `impacts` impacts, far fewer than orbits survive
    /// on the attractor, and so rests again and again: a boundary crisis, in which the attractor is lost. The
    /// number is 0 if the platform never falls away from the disk.
    Short {
        /// Impacts from one rest to the next.
        impacts: u64,
    },
    /// At every forcing the disk survives for long, as orbits on the attractor do: for more than 200 impacts
    /// and more than a hundredth of their mean survival time, or for all impacts followed. Rest has become a
    /// part of the attractor, or the disk goes to another attractor after a rest.
    Long {
        /// The smallest number of impacts followed without a rest.
        impacts: u64,
    },
    /// Some forcings are of the first kind, the others of the second.
    Varied {
        /// The number of forcings, of 16, that are of the first kind.
        short: u32,
    },
}

/// The kind of a crisis, by the motion after it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum CrisisKind {
    /// The attractor is lost: a disk that has come to rest rests again and again.
    Boundary,
    /// The attractor becomes larger: rest is a part of it, and chaos follows each rest.
    Interior,
    /// Some forcings just beyond are of the first kind, others of the second; without rests, some orbits return to the
    /// attractor and others do not.
    Undecided,
    /// Twice as many bands of the attractor merge into `bands`.
    BandMerging {
        /// The number of bands after the merging.
        bands: u32,
    },
    /// The attractor becomes larger without rests: orbits that leave it return.
    Growth,
    /// The attractor is lost to another one that does not rest: orbits that leave it do not return.
    OtherAttractor,
}

impl CrisisKind {
    /// Its name: `band merging`.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Boundary => "boundary",
            Self::Interior => "interior",
            Self::Undecided => "undecided",
            Self::BandMerging { .. } => "band merging",
            Self::Growth => "growth",
            Self::OtherAttractor => "other attractor",
        }
    }
}

/// The tangency of a crisis: the unstable manifold of a saddle on an attractor touches the stable manifold of
/// a saddle outside it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tangency {
    /// The saddle on the attractor, at the crisis.
    pub inside: PeriodicOrbit,
    /// The saddle whose stable manifold is touched, at the crisis.
    pub touched: PeriodicOrbit,
    /// The orbit of tangency, from near the first saddle to near the second.
    pub orbit: Vec<ImpactState>,
    /// Share of the first piece of the unstable manifold at which the orbit begins, in [0, 1].
    pub share: f64,
    /// The side of the first impact of the saddle on which this piece begins.
    pub side: Side,
    /// Second derivative (with respect to the share) of the distance from the stable manifold near the second
    /// saddle (in the units of manifolds), over the rate of change of this distance with Gamma. The escaping
    /// share of the first piece opens as sqrt(8 (Gamma - Gamma_c) / |curvature|). It is not 0 at a quadratic
    /// tangency.
    pub curvature: f64,
}

impl Crisis {
    /// Whether the attractor is lost, becomes larger or merges its bands, as far as [`Self::after`] decides it.
    #[must_use]
    pub const fn kind(&self) -> CrisisKind {
        match self.after {
            AfterCrisis::Rest(LifeAfterRest::Short { .. }) => CrisisKind::Boundary,
            AfterCrisis::Rest(LifeAfterRest::Long { .. }) => CrisisKind::Interior,
            AfterCrisis::Rest(LifeAfterRest::Varied { .. }) => CrisisKind::Undecided,
            AfterCrisis::Merged { bands } => CrisisKind::BandMerging { bands },
            AfterCrisis::Left { returned: 0, .. } => CrisisKind::OtherAttractor,
            AfterCrisis::Left { orbits, returned } if orbits == returned => CrisisKind::Growth,
            AfterCrisis::Left { .. } => CrisisKind::Undecided,
        }
    }

    /// The exponent of the mean life beyond the crisis, (Gamma - Gamma_c)^-exponent, after Grebogi, Ott and
    /// Yorke. With the multipliers a and b (|a| > 1 > |b|) per impact of the saddle on the attractor, it is
    /// 1/2 + ln|a|/|ln|b|| if the two saddles differ, and ln|b|/ln (a b)^2 if they are the same. `None`
    /// without a tangency, or if the multipliers do not determine it.
    #[must_use]
    pub fn life_exponent(&self) -> Option<f64> {
        let tangency = self.tangency.as_ref().ok()?;
        let one = tangency.inside.states == tangency.touched.states;
        let Multipliers::Real(large, small) = tangency.inside.multipliers() else { return None };
        let (large, small) = (ln(large.abs()), ln(small.abs()));
        let exponent = if one { small / (2.0 * (large + small)) } else { 0.5 - large / small };
        (exponent.is_finite() && exponent > 0.0).then_some(exponent)
    }
}

/// The reason why no tangency is known as the cause of a crisis.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum NoTangency {
    /// The orbits that came to rest had not passed a common saddle of few impacts.
    #[error(
        "the {orbits} orbits that came to rest just above the crisis passed no saddle of at most 12 impacts in common"
    )]
    NoSaddle {
        /// The number of orbits examined.
        orbits: usize,
    },
    /// The unstable manifold has no fold near the stable one: the attractor touches another saddle, or its
    /// edge is not a fold.
    #[error("no fold of the unstable manifold lies next to the saddle")]
    NoFold,
    /// The search for the tangency did not converge to within rounding.
    #[error("the tangency did not converge: the last step changed Gamma = {forcing} by {change:e}")]
    NotSettled {
        /// The last Gamma.
        forcing: f64,
        /// Its last change.
        change: f64,
    },
    /// The manifolds touch inside the attractor, or at a later forcing than the manifolds of another saddle:
    /// the attractor survives there, or is already gone, or no orbit near the tangency is lost.
    #[error("the manifolds touch elsewhere, at Gamma = {forcing}")]
    Elsewhere {
        /// Gamma of their tangency.
        forcing: f64,
    },
}

/// The reason why no crisis was found, with the observation.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum NoCrisis {
    /// The periodic orbit that would lead to the attractor is not yet born.
    #[error(
        "no orbit of one impact per period exists up to Gamma = {forcing}: it appears at Gamma = {birth}"
    )]
    NotBorn {
        /// The upper end.
        forcing: f64,
        /// Gamma at which the period-1 orbit is born.
        birth: f64,
    },
    /// A given saddle could not be followed to the forcing where it is needed.
    #[error("the saddle could be continued only to Gamma = {reached}, not to {forcing}")]
    NotFollowed {
        /// The forcing at which it is needed.
        forcing: f64,
        /// The last Gamma at which it was found.
        reached: f64,
    },
    /// No orbit comes to rest at the upper end of the range: the attractor is still there, perhaps larger
    /// (after an interior crisis), or has been lost to an attractor that does not come to rest.
    #[error("none of {samples} orbits {} at Gamma = {forcing} within {impacts} impacts in total", event.verb())]
    NoneRests {
        /// The upper end.
        forcing: f64,
        /// The number of orbits.
        samples: u32,
        /// The total number of their impacts.
        impacts: u64,
        /// The event that was sought.
        event: CrisisEvent,
    },
    /// Some orbits come to rest at the start of the search.
    #[error("an orbit already {} at Gamma = {forcing}, after {life} impacts", event.verb())]
    RestsBefore {
        /// The lower end.
        forcing: f64,
        /// The impacts of the first orbit that comes to rest.
        life: u64,
        /// The event that was sought.
        event: CrisisEvent,
    },
    /// The attractor at the start of the search does not have the bands that are to merge.
    #[error(
        "the attractor does not have {bands} bands at Gamma = {forcing}, alternating about a saddle of half as many impacts"
    )]
    NoBands {
        /// The lower end.
        forcing: f64,
        /// The number of bands before the merging.
        bands: usize,
    },
    /// The lost attractor is not chaotic but a periodic orbit that ends.
    #[error(
        "the attractor that disappears at Gamma = {forcing} is not chaotic: its largest exponent is {exponent:.4} per impact"
    )]
    NotChaotic {
        /// The last Gamma at which it exists.
        forcing: f64,
        /// Its largest Lyapunov exponent.
        exponent: f64,
    },
    /// Survival times do not shrink with the distance, so this is not a crisis.
    #[error(
        "lifetimes do not shorten beyond Gamma = {forcing}: {near:.3e} impacts next to it, {far:.3e} farther away"
    )]
    LivesDoNotShrink {
        /// The last Gamma at which orbits survive.
        forcing: f64,
        /// Mean survival time near it.
        near: f64,
        /// Mean survival time 64 times as far away.
        far: f64,
    },
    /// Orbits begin to come to rest, but not because the manifolds of the given saddles touch.
    #[error("orbits begin to come to rest between Gamma = {} and {}, but the given saddles do not explain it: \
             {reason}", bracket.0, bracket.1)]
    OtherReason {
        /// The bracket of the crisis (see [`Crisis::bracket`]).
        bracket: (f64, f64),
        /// The reason why the saddles have no tangency.
        reason: NoTangency,
    },
}

/// A disk survives for long after a rest if its number of impacts exceeds both of these: a share of the mean
/// survival time, which one orbit in a hundred does not reach by chance, and a number that is larger than in
/// short cycles from rest to rest.
const LONG: f64 = 0.01;
const LONG_ROUND: u64 = 200;

/// The half range (relative) of a search about the crises at other restitutions, and how many times it is
/// doubled.
const ABOUT: f64 = 0.01;
const WIDENINGS: u32 = 3;

/// Number of forcings near a crisis at which a disk is followed after a rest.
const FORCINGS_AFTER_REST: u32 = 16;

/// Orbits that are followed after they have left an attractor, and the impacts in its part of the plane, one after the
/// other, with which they have returned.
const ORBITS_AFTER_EXIT: usize = 24;
const STAY: u32 = 100;

/// How far beyond a tangency these forcings reach, as a share of the distance to the upper end of the
/// bracket.
const NEXT_TO: f64 = 1.0 / 16.0;

impl CrisisSearch {
    /// The crisis in which a chaotic attractor begins to lose orbits to rest.
    ///
    /// Orbits on the attractor are followed as Gamma rises, in steps that are halved when an orbit comes to
    /// rest, until there is a bracket. The next step is a search for the saddle passed by the orbits that
    /// come to rest just beyond the crisis, and for the tangency of its stable manifold with an unstable one.
    /// The tangency refines the result if it lies within the bracket.
    ///
    /// Without `saddles` the attractor is the one to which the period-1 orbit leads at the lower end of the
    /// range, or at its birth. With `saddles` it is the one to which the unstable manifold of the first
    /// saddle leads, on the attractor or at its edge; the stable manifold belongs to the second saddle, which
    /// may be the same one. Saddles may be given at any forcing, from which they are followed.
    ///
    /// The items of `observer` are impacts; their total is an upper bound.
    ///
    /// ```
    /// # use bouncing_disk_core::chaos::CrisisSearch;
    /// # use bouncing_disk_core::Unobserved;
    /// // The attractor of Fig. 6 is lost where it touches a saddle of three impacts in three periods.
    /// let search = CrisisSearch::new(0.5, (0.559, 0.562))?.with_samples(64, 400_000)?;
    /// let crisis = search.crisis(None, &Unobserved)?.expect("a crisis");
    /// assert!((crisis.forcing - 0.5607507).abs() < 1e-7 && crisis.forcing_error < 1e-5);
    /// assert_eq!(crisis.tangency.expect("found").touched.period(), 3);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if one of `saddles` is not a saddle; [`Error::Stopped`] if the observer breaks;
    /// errors of [`Vibration::first_impact`].
    pub fn crisis(
        &self,
        saddles: Option<(&PeriodicOrbit, &PeriodicOrbit)>,
        observer: &dyn Observer,
    ) -> Result<Result<Crisis, NoCrisis>, Error> {
        for orbit in saddles.iter().flat_map(|(inside, touched)| [inside, touched]) {
            of_saddle(orbit.multipliers())?;
        }
        let watch = Watch::begin(observer, 0, 60 * self.impacts)?;
        let found = match self.sought(saddles, &watch) {
            // The saddle between the bands is needed at the upper end.
            Err(Error::NoBranch { parameter: reached, .. }) => {
                Err(NoCrisis::NotFollowed { forcing: self.high, reached })
            }
            found => found?,
        };
        watch.end();
        Ok(found)
    }

    /// The curve of crises over the restitution: the crisis at each of `restitutions`, 1 to 1000 values, in an order in
    /// which neighbours are close. The first crisis is searched for in the range of this search. Each further one is
    /// searched for about the forcing extrapolated from the crises before it, in a range that is doubled up to three
    /// times if it contains none. Each crisis has its own error, saddle and kind.
    ///
    /// The items of the observer are the restitutions.
    ///
    /// ```
    /// # use bouncing_disk_core::chaos::CrisisSearch;
    /// # use bouncing_disk_core::Unobserved;
    /// let search = CrisisSearch::new(0.5, (0.559, 0.562))?.with_samples(64, 200_000)?;
    /// let found = search.over_restitution(&[0.5, 0.49], &Unobserved)?;
    /// assert!(found.iter().all(Result::is_ok));
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a restitution outside (0, 1) and for their number; the errors of [`Self::crisis`].
    pub fn over_restitution(
        &self,
        restitutions: &[f64],
        observer: &dyn Observer,
    ) -> Result<Vec<Result<Crisis, NoCrisis>>, Error> {
        within("restitutions of a curve of crises", restitutions.len() as f64, 1.0, 1.0e3, "[1, 1000]")?;
        let watch = Watch::begin(observer, 0, restitutions.len() as u64)?;
        let asked = |_: Progress| match watch.ask() {
            Ok(()) => ControlFlow::Continue(()),
            Err(_) => ControlFlow::Break(()),
        };
        let mut found: Vec<Result<Crisis, NoCrisis>> = Vec::new();
        for &restitution in restitutions {
            let known: Vec<_> = found.iter().flatten().map(|own| (own.restitution, own.forcing)).collect();
            let mut search = self.about(restitution, &known)?;
            let mut crisis = search.crisis(None, &asked)?;
            for _ in 0..WIDENINGS {
                if crisis.is_ok() {
                    break;
                }
                let half = search.high - search.low;
                let middle = search.low + 0.5 * half;
                let low = (middle - half).max(0.0);
                search = Self { low, high: middle + half, ..search };
                crisis = search.crisis(None, &asked)?;
            }
            found.push(crisis);
            watch.finish(1);
        }
        watch.end();
        Ok(found)
    }

    /// The search at another restitution, about the forcing extrapolated from the last two of these crises.
    fn about(&self, restitution: f64, known: &[(f64, f64)]) -> Result<Self, Error> {
        let own = 0.5 * (self.low + self.high);
        let forcing = match known {
            [] => own,
            [only] => only.1,
            [.., before, last] => last.1 + (last.1 - before.1) / (last.0 - before.0) * (restitution - last.0),
        };
        let half = if known.is_empty() { 0.5 * (self.high - self.low) } else { ABOUT * forcing };
        let search = Self { restitution, low: forcing - half, high: forcing + half, ..*self };
        search.check().map(|()| search)
    }

    fn sought(
        &self,
        saddles: Option<(&PeriodicOrbit, &PeriodicOrbit)>,
        watch: &Watch<'_>,
    ) -> Result<Result<Crisis, NoCrisis>, Error> {
        let end = match self.end_of_attractor(saddles.map(|(inside, _)| inside), watch)? {
            Ok(end) => end,
            Err(reason) => return Ok(Err(reason)),
        };
        let bracket = end.bracket;
        if matches!(end.exit, Exit::Bands(_))
            && let Some((forcing, life)) = self.rest_after_bands(&end)?
        {
            return Ok(Err(NoCrisis::RestsBefore { forcing, life, event: CrisisEvent::Rest }));
        }
        let pairs = match saddles {
            Some((inside, touched)) => {
                let followed = |orbit| self.followed_to(orbit, bracket.1);
                match (followed(inside)?, followed(touched)?) {
                    (Ok(inside), Ok(touched)) => vec![Pair { inside, touched }],
                    (Err(reached), _) | (_, Err(reached)) => {
                        return Ok(Err(NoCrisis::NotFollowed { forcing: bracket.1, reached }));
                    }
                }
            }
            None => self.pairs(&end)?,
        };
        let tangency = if pairs.is_empty() {
            Err(NoTangency::NoSaddle { orbits: end.lost.len() })
        } else {
            tangencies(self, &pairs, &end, watch)?
        };
        if let (Some(_), Err(reason)) = (saddles, &tangency) {
            return Ok(Err(NoCrisis::OtherReason { bracket, reason: *reason }));
        }
        let (forcing, forcing_error) = match &tangency {
            Ok(own) => {
                let above = own.error.min(bracket.1 - own.forcing);
                (own.forcing, (own.forcing - bracket.0).max(above))
            }
            Err(_) => (0.5 * (bracket.0 + bracket.1), 0.5 * (bracket.1 - bracket.0)),
        };
        // Only a tangency locates the crisis well enough for forcings "just beyond" it.
        let next = if tangency.is_ok() { NEXT_TO } else { 1.0 };
        let beyond = forcing + next * (bracket.1 - forcing);
        Ok(Ok(Crisis {
            restitution: self.restitution,
            forcing,
            forcing_error,
            bracket,
            attractor: end.attractor[0],
            after: self.after(&end, forcing, beyond)?,
            tangency: tangency.map(|own| own.tangency),
        }))
    }

    /// The saddles that orbits pass before they come to rest, each with the saddles whose unstable manifolds
    /// may touch its stable manifold.
    fn pairs(&self, end: &End) -> Result<Vec<Pair>, Error> {
        let map = self.map(end.bracket.1)?;
        if let Exit::Bands(saddle) = &end.exit {
            let Ok(saddle) = self.followed_to(saddle, end.bracket.1)? else { return Ok(Vec::new()) };
            return Ok(vec![Pair { inside: saddle.clone(), touched: saddle }]);
        }
        let node = map.period_one(1).and_then(|state| map.refine(&[state]).ok());
        let node = node.filter(|orbit| of_saddle(orbit.multipliers()).is_ok());
        let touched = self.saddles_passed(&map, end)?;
        let pairs = touched.iter().flat_map(|touched| {
            let inside = core::iter::once(touched).chain(&node);
            inside.map(|inside| Pair { inside: inside.clone(), touched: touched.clone() })
        });
        Ok(pairs.collect())
    }

    /// The forcing and the life of an orbit that comes to rest instead of changing its band, or after it: the attractor
    /// is then lost and not merged. The orbits are those farthest beyond, which change their bands most often.
    fn rest_after_bands(&self, end: &End) -> Result<Option<(f64, u64)>, Error> {
        for lost in end.lost.iter().rev().take(ORBITS_AFTER_EXIT) {
            let map = self.map(lost.forcing)?;
            let start = map.steps(lost.start, lost.impacts as u64)?;
            let lived = until(&map, &ExitTest::Rest, &[start], self.each(), &Unobserved)?;
            if lived[0].rests {
                return Ok(Some((lost.forcing, (lost.impacts + lived[0].lived) as u64)));
            }
        }
        Ok(None)
    }

    /// The motion after the event at forcings from `low` to `high`.
    fn after(&self, end: &End, low: f64, high: f64) -> Result<AfterCrisis, Error> {
        let region = match &end.exit {
            Exit::Rest => return self.after_rest(end, low, high).map(AfterCrisis::Rest),
            Exit::Bands(saddle) => return Ok(AfterCrisis::Merged { bands: saddle.period() as u32 }),
            Exit::Region(region) => region,
        };
        let (mut orbits, mut returned, mut rested) = (0, 0, 0);
        for lost in end.lost.iter().take(ORBITS_AFTER_EXIT) {
            let map = self.map(lost.forcing)?;
            let (mut state, mut stay, mut rests) =
                (map.steps(lost.start, lost.impacts as u64)?, 0, lost.rests);
            for _ in 0..self.each() {
                rests = rests || map.rests_after(state);
                if rests || stay == STAY {
                    break;
                }
                state = map.step(state)?.into();
                stay = if region.occupies(state) { stay + 1 } else { 0 };
            }
            orbits += 1;
            rested += u32::from(rests);
            returned += u32::from(stay == STAY);
        }
        if 2 * rested >= orbits {
            return self.after_rest(end, low, high).map(AfterCrisis::Rest);
        }
        Ok(AfterCrisis::Left { orbits, returned })
    }

    /// The motion after a rest at forcings from `low` to `high`.
    fn after_rest(&self, end: &End, low: f64, high: f64) -> Result<LifeAfterRest, Error> {
        let limit = self.each() as u64;
        let (mut short, mut least, mut most) = (0, u64::MAX, 0);
        for forcing in 0..FORCINGS_AFTER_REST {
            let share = f64::from(forcing) / f64::from(FORCINGS_AFTER_REST);
            let lived = self.relaunched(high - share * (high - low), limit)?;
            let long = lived == limit || lived > LONG_ROUND && lived as f64 > LONG * end.life;
            short += u32::from(!long);
            (least, most) = (least.min(lived), most.max(lived));
        }
        Ok(match short {
            FORCINGS_AFTER_REST => LifeAfterRest::Short { impacts: most },
            0 => LifeAfterRest::Long { impacts: least },
            short => LifeAfterRest::Varied { short },
        })
    }
}

#[cfg(test)]
mod tests;
