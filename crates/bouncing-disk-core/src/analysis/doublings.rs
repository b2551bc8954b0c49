//! The period-doubling cascade that starts from the orbit with one impact per period. The closed form of the first
//! doubling is in `periodic.rs`.

use roots::{Convergency, SearchError, find_root_brent};

use super::periodic::{MAX_PERIOD, PeriodicOrbit};
use crate::error::{Error, finite, within};
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::observer::{Observer, Tick, Unobserved, Watch};
use crate::platform::phase::Phase;
use crate::platform::vibration::Vibration;
use crate::read_checked;

/// A period doubling of the cascade that starts from the period-1 orbit.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedDoubling"))]
pub struct PeriodDoubling {
    /// The forcing Gamma_n.
    pub axial_forcing: f64,
    /// Period (in impacts) of the orbit that loses its stability.
    pub period: usize,
    /// det(1 + monodromy) at the forcing found: what the search left.
    pub residual: f64,
}

read_checked!(PeriodDoubling as UncheckedDoubling {
    axial_forcing: f64,
    period: usize,
    residual: f64,
});

impl PeriodDoubling {
    /// Checks what is read.
    fn check(&self) -> Result<(), Error> {
        Vibration::from_axial_forcing(self.axial_forcing)?;
        within("period", self.period as f64, 1.0, MAX_PERIOD as f64, "[1, 4096]")?;
        finite("residual", self.residual)?;
        Ok(())
    }
}

/// Root only where the function is exactly zero or the bracket a few neighbouring doubles.
struct NeighbouringDoubles;

impl Convergency<f64> for NeighbouringDoubles {
    fn is_root_found(&mut self, y: f64) -> bool {
        y == 0.0
    }

    fn is_converged(&mut self, x1: f64, x2: f64) -> bool {
        (x1 - x2).abs() <= 4.0 * f64::EPSILON * x1.abs().max(x2.abs())
    }

    fn is_iteration_limit_reached(&mut self, iterations: usize) -> bool {
        iterations > 200
    }
}

/// The first `count` period doublings of the orbit with one impact per period, for `restitution` in (0, 1).
///
/// Each orbit is followed in the forcing, corrected by multiple shooting, until (1 + m1)(1 + m2) changes sign; the
/// change of sign is refined by Brent's method. The doubled orbit is started along the direction that flips.
///
/// # Errors
/// [`Error::OutOfRange`] for the restitution or a count above 10 (rounding ends the cascade there);
/// [`Error::NotSettled`] if a branch is lost.
pub fn period_doublings(restitution: f64, count: usize) -> Result<Vec<PeriodDoubling>, Error> {
    period_doublings_observed(restitution, count, &Unobserved)
}

/// [`period_doublings`] with an observer; the items are the doublings. A [`DoublingsRun`] keeps what a call that is
/// stopped has found: ten of them take seconds.
///
/// # Errors
/// Those of [`period_doublings`]; [`Error::Stopped`] if the observer breaks.
pub fn period_doublings_observed(
    restitution: f64,
    count: usize,
    observer: &dyn Observer,
) -> Result<Vec<PeriodDoubling>, Error> {
    let mut run = DoublingsRun::new(restitution)?;
    run.advance(count, observer)?;
    Ok(run.found)
}

/// A period-doubling cascade under way: the doublings that are found, and the orbit that loses its stability at the
/// last one.
///
/// A run that is stopped, written, read and gone on with finds the doublings of one call without a stop, bit for bit.
///
/// ```
/// use bouncing_disk_core::{DoublingsRun, Unobserved, period_doublings};
///
/// let mut run = DoublingsRun::new(0.5)?;
/// run.advance(2, &Unobserved)?;
/// run.advance(4, &Unobserved)?;
/// assert_eq!(run.found(), period_doublings(0.5, 4)?);
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedRun"))]
pub struct DoublingsRun {
    restitution: f64,
    found: Vec<PeriodDoubling>,
    /// The orbit of the last doubling; none before the first.
    orbit: Option<PeriodicOrbit>,
}

read_checked!(DoublingsRun as UncheckedRun {
    restitution: f64,
    found: Vec<PeriodDoubling>,
    orbit: Option<PeriodicOrbit>,
});

fn within_cascade(count: usize) -> Result<(), Error> {
    within("count", count as f64, 0.0, 10.0, "[0, 10]").map(drop)
}

impl DoublingsRun {
    /// A run that has found none, for `restitution` in (0, 1).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the restitution.
    pub fn new(restitution: f64) -> Result<Self, Error> {
        within("restitution", restitution, f64::MIN_POSITIVE, 1.0 - f64::EPSILON, "(0, 1)")?;
        Ok(Self { restitution, found: Vec::new(), orbit: None })
    }

    /// Checks what is read.
    fn check(&self) -> Result<(), Error> {
        Self::new(self.restitution)?;
        within_cascade(self.found.len())?;
        // The forcings of a cascade rise, and its periods double.
        for (index, doubling) in self.found.iter().enumerate() {
            let least = if index == 0 { 0.0 } else { self.found[index - 1].axial_forcing.next_up() };
            within(
                "forcing of a doubling",
                doubling.axial_forcing,
                least,
                f64::MAX,
                "(that of the one before, inf)",
            )?;
            let period = (1_u64 << index) as f64;
            within("period of a doubling", doubling.period as f64, period, period, "2^n for the n-th one")?;
        }
        let (period, last) = (self.orbit.as_ref().map_or(0, PeriodicOrbit::period), self.found.last());
        let expected = last.map_or(0, |last| last.period) as f64;
        within("period of the last orbit", period as f64, expected, expected, "that of the last doubling")?;
        Ok(())
    }

    /// The coefficient of restitution.
    #[must_use]
    pub const fn restitution(&self) -> f64 {
        self.restitution
    }

    /// The doublings found, from the first one on.
    #[must_use]
    pub fn found(&self) -> &[PeriodDoubling] {
        &self.found
    }

    /// Searches until the first `count` doublings are found. What an earlier call has found stays; so it does when this
    /// call returns an error. The items of the observer are the doublings.
    ///
    /// # Errors
    /// Those of [`period_doublings`]; [`Error::Stopped`] if the observer breaks.
    pub fn advance(&mut self, count: usize, observer: &dyn Observer) -> Result<(), Error> {
        within_cascade(count)?;
        let watch = Watch::begin(observer, self.found.len().min(count) as u64, count as u64)?;
        let mut work = watch.work();
        while self.found.len() < count {
            self.find_next(&mut |impacts| work.spend(impacts))?;
            watch.set_done(self.found.len() as u64);
        }
        watch.end();
        Ok(())
    }

    /// Finds the next doubling; the tick counts impacts.
    fn find_next(&mut self, tick: Tick<'_>) -> Result<(), Error> {
        let restitution = self.restitution;
        let map_at = |forcing: f64| ImpactMap::new(Vibration::from_axial_forcing(forcing)?, restitution);
        let first = ImpactMap::first_doubling_forcing(restitution);
        let threshold = (1.0 - restitution) / (1.0 + restitution);
        // Where to start following, and the first step in the forcing.
        let (mut forcing, mut orbit, mut step) = match (&self.orbit, self.interval()) {
            (Some(orbit), Some((at, interval))) => {
                let (forcing, orbit) = doubled_orbit(&map_at, orbit, (at, interval), tick)?;
                (forcing, orbit, interval / 60.0)
            }
            _ => {
                let forcing = 0.5 * (first + threshold);
                let seed = map_at(forcing)?.period_one(1).ok_or(Error::NotSettled {
                    what: "period-1 orbit",
                    iterations: 0,
                    residual: forcing,
                })?;
                // Not a simple fraction: a step onto the doubling itself would have no sign to read.
                (forcing, map_at(forcing)?.refine_ticked(&[seed], tick)?, 0.27 * (first - threshold))
            }
        };
        // Follow until the sign changes.
        let mut steps = 0;
        let (low, low_states, high) = loop {
            let next_forcing = forcing + step;
            match map_at(next_forcing)?.refine_ticked(&orbit.states, tick) {
                Ok(next) if next.flip_function() <= 0.0 => {
                    break (forcing, orbit.states.clone(), next_forcing);
                }
                Ok(next) => {
                    forcing = next_forcing;
                    orbit = next;
                }
                Err(stopped @ Error::Stopped { .. }) => return Err(stopped),
                Err(_) => step *= 0.5,
            }
            steps += 1;
            if steps > 400 {
                return Err(Error::NotSettled {
                    what: "period-doubling branch",
                    iterations: steps,
                    residual: step,
                });
            }
        };
        let mut stopped = None;
        let flip = |forcing: f64| match map_at(forcing).and_then(|map| map.refine_ticked(&low_states, tick)) {
            Ok(orbit) => orbit.flip_function(),
            Err(error) => {
                if matches!(error, Error::Stopped { .. }) {
                    stopped = Some(error);
                }
                f64::NAN
            }
        };
        let at = find_root_brent(low, high, flip, &mut NeighbouringDoubles);
        if let Some(stopped) = stopped {
            return Err(stopped);
        }
        let at = at.map_err(|error: SearchError| Error::NotSettled {
            what: match error {
                SearchError::NoConvergency => "search of a period doubling",
                SearchError::NoBracketing => "bracket of a period doubling",
                _ => "root of the flip function",
            },
            iterations: 200,
            residual: high - low,
        })?;
        let orbit = map_at(at)?.refine_ticked(&low_states, tick)?;
        self.found.push(PeriodDoubling {
            axial_forcing: at,
            period: orbit.period(),
            residual: orbit.flip_function(),
        });
        self.orbit = Some(orbit);
        Ok(())
    }

    /// The forcing of the last doubling, and how far it lies from the one before, or from the birth of the period-1 orbit.
    /// The next such interval is about delta = 4.67 times shorter.
    fn interval(&self) -> Option<(f64, f64)> {
        let birth = (1.0 - self.restitution) / (1.0 + self.restitution);
        let mut last = self.found.iter().rev().map(|doubling| doubling.axial_forcing);
        let at = last.next()?;
        Some((at, at - last.next().unwrap_or(birth)))
    }
}

/// The orbit of twice the period a little beyond its birth at `at`, with its forcing.
fn doubled_orbit(
    map_at: &impl Fn(f64) -> Result<ImpactMap, Error>,
    orbit: &PeriodicOrbit,
    (at, interval): (f64, f64),
    tick: Tick<'_>,
) -> Result<(f64, PeriodicOrbit), Error> {
    let period = orbit.period();
    // Just beyond the doubling the attractor is the doubled orbit; the iteration itself finds it.
    for fraction in [0.06, 0.03, 0.1] {
        let forcing = at + fraction * interval;
        let map = map_at(forcing)?;
        let unstable = match map.refine_ticked(&orbit.states, tick) {
            Ok(unstable) => unstable,
            Err(stopped @ Error::Stopped { .. }) => return Err(stopped),
            Err(_) => continue,
        };
        let start = unstable.states[0];
        let nudged =
            ImpactState::new(Phase::new(start.phase().angle() + 1.0e-4 * interval)?, start.velocity())?;
        let settled = map.settled_orbit_ticked(nudged, (4_000 * period, 2 * period), 1.0e-7, tick)?;
        if let Some(doubled) = settled.filter(|doubled| doubled.period() == 2 * period) {
            return Ok((forcing, doubled));
        }
    }
    Err(Error::NotSettled { what: "doubled orbit", iterations: period as u32, residual: interval })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::StopAfter;

    /// Wherever it is stopped, also inside of the search of a root, it says so.
    #[test]
    fn a_cascade_can_be_stopped_anywhere() {
        let all = StopAfter::calls(u64::MAX);
        let found = period_doublings_observed(0.5, 6, &all).expect("nobody stops it");
        assert_eq!(Ok(found), period_doublings(0.5, 6));
        for calls in 1..all.asked() {
            let stopped = period_doublings_observed(0.5, 6, &StopAfter::calls(calls));
            assert!(matches!(stopped, Err(Error::Stopped { total: 6, .. })), "{calls}: {stopped:?}");
        }
        assert!(all.asked() > 5);
    }

    /// Stopped after so many calls, written, read and gone on with: the doublings of one call.
    #[cfg(feature = "serde")]
    #[test]
    fn a_cascade_that_is_stopped_keeps_what_it_has_found() {
        let at_once = period_doublings(0.5, 6).expect("nobody stops it");
        let (mut run, mut stops) = (DoublingsRun::new(0.5).expect("legal"), 0);
        loop {
            let text = serde_json::to_string(&run).expect("writes");
            let read: DoublingsRun = serde_json::from_str(&text).expect("legal");
            assert_eq!(read, run);
            run = read;
            // A cascade is gone on with from its last doubling: a call must be long enough to find one.
            match run.advance(6, &StopAfter::calls(2 + stops)) {
                Ok(()) => break,
                Err(Error::Stopped { done, total: 6 }) => assert_eq!(done, run.found().len() as u64),
                Err(error) => panic!("{error}"),
            }
            stops += 1;
        }
        assert_eq!(run.found(), at_once);
        assert!(stops >= 3, "{stops}");
        assert_eq!(run.advance(3, &StopAfter::calls(2)), Ok(()));
        assert_eq!(run.found(), at_once, "fewer than there are");
    }

    #[cfg(feature = "serde")]
    #[test]
    fn a_stored_cascade_that_is_none_is_refused() {
        let mut run = DoublingsRun::new(0.5).expect("legal");
        run.advance(3, &Unobserved).expect("found");
        let legal = serde_json::to_value(&run).expect("writes");
        let refused = |change: &dyn Fn(&mut serde_json::Value)| {
            let mut value = legal.clone();
            change(&mut value);
            assert_ne!(value, legal);
            serde_json::from_value::<DoublingsRun>(value).expect_err("refused").to_string()
        };
        assert!(refused(&|run| run["restitution"] = 1.0.into()).contains("restitution"));
        assert!(
            refused(&|run| run["found"][1]["axial_forcing"] = 0.1.into()).contains("forcing of a doubling")
        );
        assert!(refused(&|run| run["found"][2]["period"] = 3.into()).contains("period of a doubling"));
        assert!(refused(&|run| run["orbit"] = serde_json::Value::Null).contains("period of the last orbit"));
        assert!(refused(&|run| run["found"] = serde_json::json!([])).contains("period of the last orbit"));
        assert!(refused(&|run| run["extra"] = 1.into()).contains("extra"));
    }
}
