//! What the exact map does at a point of its parameters, from many starts.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use bouncing_disk::core::{
    ChatterPolicy, CycleTrust, Error, ImpactMap, ImpactState, Launch, OrbitEvent, Phase, Verdict,
    VerdictSettings, Vibration, verdicts,
};

use crate::experiment::ExperimentError;

/// How long an orbit is followed: most are decided after a few hundred impacts.
pub(super) const SETTINGS: VerdictSettings =
    VerdictSettings { transient: 500, impacts: 3_000, longest_period: 64, tolerance: 1.0e-7 };

/// What a disk does for good.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Behaviour {
    /// An attracting orbit of so many impacts in so many periods of the platform.
    Periodic { impacts: u64, platform_periods: u64 },
    /// A positive exponent.
    Chaotic,
    /// Flights and rest in turn: so many long flights, so many periods.
    Chattering { long_flights: u64, platform_periods: u64 },
    /// The same in a cycle that is so long that rounding chooses it.
    LongChattering,
    /// Rest for ever.
    AtRest,
    /// No verdict.
    Undecided,
}

impl Behaviour {
    pub(super) fn of(verdict: &Verdict) -> Self {
        match *verdict {
            Verdict::Periodic { impacts, platform_periods, .. } => {
                Self::Periodic { impacts, platform_periods }
            }
            Verdict::Chaotic { .. } => Self::Chaotic,
            Verdict::Chattering { cycle, .. } => match cycle.trust {
                CycleTrust::Exact => Self::Chattering {
                    long_flights: cycle.long_flights,
                    platform_periods: cycle.platform_periods,
                },
                _ => Self::LongChattering,
            },
            Verdict::AtRest { .. } => Self::AtRest,
            _ => Self::Undecided,
        }
    }

    /// Whether flights and rests follow each other for ever.
    pub(super) fn rests_again(self) -> bool {
        matches!(self, Self::Chattering { .. } | Self::LongChattering)
    }

    /// The number of different flights that one sees: of a cycle with rests the long ones.
    pub(super) fn modes(self) -> Option<u64> {
        match self {
            Self::Periodic { impacts, .. } => Some(impacts),
            Self::Chattering { long_flights, .. } => Some(long_flights),
            _ => None,
        }
    }

    fn words(self) -> String {
        match self {
            Self::Periodic { impacts, platform_periods } => {
                format!("{} in {}", counted(impacts, "impact"), counted(platform_periods, "period"))
            }
            Self::Chaotic => "chaos".to_owned(),
            Self::Chattering { long_flights, platform_periods } => format!(
                "{} and rest in {}",
                counted(long_flights, "long flight"),
                counted(platform_periods, "period")
            ),
            Self::LongChattering => "a sticking cycle chosen by rounding".to_owned(),
            Self::AtRest => "rest for ever".to_owned(),
            Self::Undecided => "undecided".to_owned(),
        }
    }
}

/// "1 impact", "2 impacts".
pub(super) fn counted(count: u64, of: &str) -> String {
    if count == 1 { format!("1 {of}") } else { format!("{count} {of}s") }
}

/// How many starts do what.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Behaviours(BTreeMap<Behaviour, usize>);

impl Behaviours {
    pub(super) fn of<'a>(verdicts: impl IntoIterator<Item = &'a Verdict>) -> Self {
        let mut counts = BTreeMap::new();
        for verdict in verdicts {
            *counts.entry(Behaviour::of(verdict)).or_insert(0) += 1;
        }
        Self(counts)
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = Behaviour> {
        self.0.keys().copied()
    }

    /// Behaviours that last: not undecided.
    pub(super) fn decided(&self) -> usize {
        self.iter().filter(|behaviour| *behaviour != Behaviour::Undecided).count()
    }

    /// The most frequent ones first, with the share of the starts.
    pub(super) fn words(&self) -> String {
        const SHOWN: usize = 4;
        let total: usize = self.0.values().sum();
        let mut counts: Vec<_> = self.0.iter().collect();
        // Stable, so that equal shares stay in the order of the behaviours.
        counts.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
        let mut parts: Vec<String> = counts
            .iter()
            .take(SHOWN)
            .map(|(behaviour, count)| format!("{} ({count} of {total} starts)", behaviour.words()))
            .collect();
        if counts.len() > SHOWN {
            parts.push(format!("{} more", counts.len() - SHOWN));
        }
        parts.join("; ")
    }
}

/// The exact map at a peak acceleration.
pub(super) fn map(peak_acceleration: f64, restitution: f64) -> Result<ImpactMap, Error> {
    ImpactMap::new(Vibration::new(peak_acceleration)?, restitution)
}

/// The exact map at a forcing.
pub(super) fn map_at(axial_forcing: f64, restitution: f64) -> Result<ImpactMap, Error> {
    ImpactMap::new(Vibration::from_axial_forcing(axial_forcing)?, restitution)
}

/// A grid of n phases by n speeds over all impacts that an attractor can have.
pub(super) fn starts(map: &ImpactMap, n: u32) -> Result<Vec<(ImpactMap, ImpactState)>, Error> {
    let bound = map.impact_speed_bound();
    let middle = |index: u32| (f64::from(index) + 0.5) / f64::from(n);
    let state = |index: u32| {
        let phase = Phase::new(TAU * middle(index % n))?;
        Ok((*map, ImpactState::new(phase, -bound * middle(index / n))?))
    };
    (0..n * n).map(state).collect()
}

/// What the orbits from n by n starts do at each of several maps.
pub(super) fn behaviours_of(maps: &[ImpactMap], n: u32) -> Result<Vec<Behaviours>, ExperimentError> {
    let mut all = Vec::new();
    for map in maps {
        all.extend(starts(map, n)?);
    }
    let verdicts = verdicts(&all, SETTINGS)?;
    Ok(verdicts.chunks((n * n).max(1) as usize).map(Behaviours::of).collect())
}

/// What the orbits from n by n starts do.
pub(super) fn behaviours(map: &ImpactMap, n: u32) -> Result<Behaviours, ExperimentError> {
    Ok(behaviours_of(&[*map], n)?.pop().unwrap_or_default())
}

/// The first impact of a disk that leaves a platform that falls away: all that have rested go on from there. None where the
/// platform never falls away.
pub(super) fn after_rest(map: &ImpactMap) -> Result<Option<ImpactState>, Error> {
    let Some(phase) = map.vibration().separation_phase() else { return Ok(None) };
    let mut orbit = map.orbit_from_launch(Launch::new(phase, 0.0)?, ChatterPolicy::Complete);
    Ok(orbit.next().transpose()?.and_then(|event| match event {
        OrbitEvent::Impact(impact) => Some(impact.into()),
        _ => None,
    }))
}

/// The verdicts on the orbits that leave a rest, at each map whose platform falls away.
pub(super) fn verdicts_after_rest(
    maps: &[ImpactMap],
    settings: VerdictSettings,
) -> Result<Vec<Verdict>, ExperimentError> {
    let mut starts = Vec::new();
    for map in maps {
        starts.extend(after_rest(map)?.map(|state| (*map, state)));
    }
    Ok(verdicts(&starts, settings)?)
}

/// The disk's own speed after an impact, in units of g/omega.
pub(super) fn own_speed(map: &ImpactMap, state: &ImpactState) -> f64 {
    map.vibration().peak_acceleration() * state.phase().cos() - map.restitution() * state.velocity()
}

/// All impacts of a periodic orbit from one of them.
pub(super) fn impacts(map: &ImpactMap, first: ImpactState, count: u64) -> Result<Vec<ImpactState>, Error> {
    let mut states = vec![first];
    while (states.len() as u64) < count {
        states.push(map.step(states[states.len() - 1])?.into());
    }
    Ok(states)
}

/// The forcing of a frequency in units in which amplitude, gravity and mass are 1: P is its square.
pub(super) fn forcing_of_frequency(frequency: f64) -> f64 {
    frequency * frequency / PI
}

/// The other way round.
pub(super) fn frequency_of_forcing(axial_forcing: f64) -> f64 {
    (PI * axial_forcing).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_starts_do_is_counted_and_put_into_words() {
        let found = behaviours(&map_at(0.45, 0.5).expect("legal"), 4).expect("computed");
        assert!(found.iter().any(|one| one == Behaviour::Periodic { impacts: 1, platform_periods: 1 }));
        assert!(found.words().contains("of 16 starts") && found.words().contains("1 impact in 1 period"));
        assert!(found.decided() >= 2, "{found:?}");
        assert_eq!(Behaviours::default().words(), "");
    }

    #[test]
    fn a_platform_that_never_falls_away_is_left_by_nobody() {
        assert_eq!(after_rest(&map(1.0, 0.5).expect("legal")).expect("no flight"), None);
        let map = map(1.2, 0.5).expect("legal");
        let verdicts = verdicts_after_rest(&[map], SETTINGS).expect("computed");
        assert_eq!(
            Behaviours::of(&verdicts).iter().collect::<Vec<_>>(),
            [Behaviour::Chattering { long_flights: 0, platform_periods: 1 }]
        );
    }

    #[test]
    fn the_speed_of_an_orbit_with_one_impact_is_a_multiple_of_pi() {
        let map = map_at(0.45, 0.5).expect("legal");
        let state = map.period_one(1).expect("born");
        assert!((own_speed(&map, &state) - PI).abs() < 1e-14);
        assert_eq!(impacts(&map, state, 3).expect("flies").len(), 3);
        assert!((frequency_of_forcing(forcing_of_frequency(1.66)) - 1.66).abs() < 1e-15);
    }
}
