//! The saddle that orbits pass before they come to rest.

use super::CrisisSearch;
use super::following::End;
use crate::analysis::manifold::of_saddle;
use crate::analysis::periodic::newton::same_orbit;
use crate::analysis::periodic::{PeriodicOrbit, phase_difference};
use crate::error::Error;
use crate::map::impact_map::{ImpactMap, ImpactState};

/// Orbits that are looked at.
const ORBITS: usize = 24;

/// The last impacts of an orbit among which it passes the saddle.
const IMPACTS: usize = 160;

/// The most impacts of the saddle.
const LONGEST: usize = 12;

/// How nearly (rad, and units of 1 + P) an orbit closes that passes a saddle.
const CLOSES: f64 = 0.02;

/// The least share of the orbits that pass the same saddle.
const SHARE: f64 = 0.25;

impl CrisisSearch {
    /// The saddles that orbits pass before they come to rest, those first that most of them pass.
    pub(super) fn saddles_passed(&self, map: &ImpactMap, end: &End) -> Result<Vec<PeriodicOrbit>, Error> {
        let mut found: Vec<(PeriodicOrbit, usize)> = Vec::new();
        let mut orbits = 0;
        for lost in end.lost.iter().take(ORBITS) {
            orbits += 1;
            let own = self.map(lost.forcing)?;
            let Some(saddle) = passed(map, &last_impacts(&own, lost.start, lost.impacts)?) else { continue };
            match found.iter_mut().find(|(known, _)| same_orbit(known, &saddle)) {
                Some((_, votes)) => *votes += 1,
                None => found.push((saddle, 1)),
            }
        }
        found.retain(|(_, votes)| *votes as f64 >= SHARE * f64::from(orbits));
        found.sort_by_key(|(_, votes)| core::cmp::Reverse(*votes));
        Ok(found.into_iter().map(|(saddle, _)| saddle).collect())
    }
}

/// The last impacts of an orbit that comes to rest after so many.
fn last_impacts(map: &ImpactMap, start: ImpactState, impacts: usize) -> Result<Vec<ImpactState>, Error> {
    let mut state = map.steps(start, impacts.saturating_sub(IMPACTS) as u64)?;
    let mut last = vec![state];
    for _ in 0..impacts.min(IMPACTS) {
        if map.rests_after(state) {
            break;
        }
        state = map.step(state)?.into();
        last.push(state);
    }
    Ok(last)
}

/// The saddle of few impacts that these impacts follow most closely for one round.
fn passed(map: &ImpactMap, last: &[ImpactState]) -> Option<PeriodicOrbit> {
    let scale = 1.0 + map.vibration().peak_acceleration();
    let mut nearest: Option<(f64, usize, usize)> = None;
    for period in 1..=LONGEST {
        for (index, (a, b)) in last.iter().zip(last.iter().skip(period)).enumerate() {
            let phase = phase_difference(b.phase().angle(), a.phase().angle()).abs();
            let distance = phase + (b.velocity() - a.velocity()).abs() / scale;
            // What chatters closes ever more nearly.
            let flies = a.velocity() < -0.01 * scale;
            if flies && distance < CLOSES && nearest.is_none_or(|(least, ..)| distance < least) {
                nearest = Some((distance, index, period));
            }
        }
    }
    let (_, index, period) = nearest?;
    let mut states = last[index..index + period].to_vec();
    let fastest = (0..period).min_by(|&a, &b| states[a].velocity().total_cmp(&states[b].velocity()))?;
    states.rotate_left(fastest);
    let orbit = map.refine(&states).ok()?;
    of_saddle(orbit.multipliers()).ok().map(|_| orbit)
}
