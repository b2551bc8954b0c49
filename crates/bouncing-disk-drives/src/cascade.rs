//! The period-doubling cascade on a drive, followed from branch to branch.

use core::f64::consts::{PI, TAU};

use bouncing_disk_core::orbits::{
    CascadeDoubling, ClosingMap as _, Continuation, ContinuationParameter, ContinuedMap as _,
    DoublingCascade, LocatedDoubling, OrbitSearch, PeriodicOrbit, Stability,
};
use bouncing_disk_core::{Error, Observer, Progress};

use crate::driven_map::DrivenMap;
use crate::family::DrivenFamily;

/// The forcings at which an initial orbit is sought, in units of the forcing from which rigid impacts have
/// such an orbit. Below 1, where compliant contacts have orbits, they rise in equal ratios; above 1 their
/// distances from 1 double, because the orbit may soon lose its stability.
const LOWEST: f64 = 0.5;
const RATIO: f64 = 1.05;
const NEAREST: f64 = 1.0e-4;
const DISTANCES: usize = 15;

/// Share of the rigid impact speed below which one-impact orbits are ignored: a compliant contact also allows
/// far slower ones, in which the disk hardly leaves the platform.
const LEAST_SPEED: f64 = 0.5;

/// Starts along each axis of the search for the initial orbit.
const STARTS: u32 = 16;

/// The first and the largest step of the arclength.
const STEPS: (f64, f64) = (1.0e-3, 0.02);
const MOST_POINTS: usize = 10_000;

/// The largest forcing of a branch, divided by 1 plus the forcing from which rigid impacts have an orbit.
const MOST: f64 = 20.0;

/// The unit of the forcing is the forcing of the initial orbit, but at least this.
const LEAST_UNIT: f64 = 0.1;

/// The cascade of [`doubling_cascade`](bouncing_disk_core::orbits::doubling_cascade) on any drive and
/// contact. `maps` returns the map at a forcing. The search follows the branches by continuation. The error
/// of a forcing is the error of the trace over its slope; graze margins are unknown (NaN).
///
/// ```
/// use bouncing_disk_core::Unobserved;
/// use bouncing_disk_drives::{Drive, DrivenMap, driven_doubling_cascade};
/// use std::f64::consts::PI;
///
/// let parabolas = |forcing: f64| DrivenMap::new(Drive::parabolas(PI * forcing).ok()?, 0.5).ok();
/// let found = driven_doubling_cascade(parabolas, 1, &Unobserved)?.doublings;
/// // By hand: pi (1 + r^2)/(4 (1 + r)^2).
/// assert!((found[0].axial_forcing - PI * 1.25 / 9.0).abs() < 1e-14);
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
///
/// # Errors
/// [`Error::NoBranch`] if no attracting orbit of one impact in one period is found; errors of
/// [`ContinuedMap::doublings`](bouncing_disk_core::orbits::ContinuedMap::doublings).
pub fn driven_doubling_cascade(
    maps: impl Fn(f64) -> Option<DrivenMap> + Send + Sync + 'static,
    count: usize,
    observer: &dyn Observer,
) -> Result<DoublingCascade, Error> {
    let asked = |_: Progress| observer.observe(Progress { done: 0, total: count as u64 });
    let (family, orbit, birth) = first_orbit(maps, &asked)?;
    let range = (0.5 * LOWEST * birth, MOST * (1.0 + birth));
    let settings = Continuation::new(ContinuationParameter::Number, range, true)?;
    let settings = settings.with_steps(STEPS.0, STEPS.1, MOST_POINTS)?;
    let found = family.doublings(&orbit, &settings, count, observer)?;
    let ended = |after| Error::NoDoubling { after };
    let last = found
        .last()
        .ok_or_else(|| ended(family.parameter(ContinuationParameter::Number).unwrap_or(birth)))?;
    let ended_by = (found.len() < count).then(|| ended(last.point.parameter));
    let doublings = (1..).zip(&found).map(|(number, LocatedDoubling { point, parameter_error, width })| {
        CascadeDoubling {
            number,
            period: point.orbit.period(),
            axial_forcing: point.parameter,
            forcing_error: *parameter_error,
            multiplier: point.flip_function() / (1.0 - point.determinant) - 1.0,
            width: *width,
            graze_margin: f64::NAN,
        }
    });
    Ok(DoublingCascade { doublings: doublings.collect(), ended_by })
}

/// An attracting orbit of one impact in one period at the lowest sampled forcing with such an orbit, and the
/// forcing from which rigid impacts have one, at the phase of fastest rise.
fn first_orbit(
    maps: impl Fn(f64) -> Option<DrivenMap> + Send + Sync + 'static,
    observer: &dyn Observer,
) -> Result<(DrivenFamily, PeriodicOrbit, f64), Error> {
    let unit = DrivenFamily::new(1.0, 1.0, maps)?;
    let (r, drive) = (unit.map().restitution(), unit.map().drive());
    let birth = PI * (1.0 - r) / (1.0 + r) / drive.velocity(drive.fastest_rise_phase());
    let search = OrbitSearch::new(1, 1)?.with_starts(STARTS, STARTS)?;
    let below =
        core::iter::successors(Some(LOWEST), |share| Some(RATIO * share)).take_while(|share| *share < 1.0);
    let above = core::iter::successors(Some(NEAREST), |above| Some(2.0 * above))
        .take(DISTANCES)
        .map(|above| 1.0 + above);
    for share in below.chain(above) {
        let forcing = share * birth;
        let Ok(family) = unit.with_parameter(ContinuationParameter::Number, forcing) else { continue };
        let orbits = family.map().periodic_orbits(&search, observer)?;
        let slowest = -LEAST_SPEED * TAU / (1.0 + r);
        let is_first = |orbit: &PeriodicOrbit| {
            orbit.stability() == Stability::Stable && orbit.states[0].velocity() < slowest
        };
        if let Some(orbit) = orbits.into_iter().find(is_first) {
            return Ok((family.with_unit(forcing.max(LEAST_UNIT)), orbit, birth));
        }
    }
    Err(Error::NoBranch { what: "an attracting orbit of one impact per period", parameter: birth })
}
