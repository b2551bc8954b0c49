//! The forcing at which orbits on an attractor begin to come to rest, found by following them.

use std::collections::BTreeSet;

use crate::chaos::crisis::exit::{Exit, ExitTest, Track};
use crate::chaos::crisis::lifetimes::MeanLife;
use crate::chaos::crisis::{CrisisEvent, CrisisSearch, NoCrisis};
use crate::chaos::manifold::saddle::Saddle;
use crate::chaos::manifold::{ManifoldKind, ManifoldSettings, Side, grower::Grower, of_saddle};
use crate::chatter::policy::ChatterPolicy;
use crate::flight::launch::Launch;
use crate::flight::platform::vibration::Vibration;
use crate::map::impact_map::{ImpactMap, ImpactState, OrbitEvent};
use crate::numerics::elementary::{exp, ln, sin_cos};
use crate::numerics::error::Error;
use crate::numerics::random::SplitMix64;
use crate::orbits::periodic::newton::same_orbit;
use crate::orbits::periodic::{PeriodicOrbit, phase_difference};
use crate::run::{Observer, Progress, Unobserved, Watch};
use crate::sweep::lyapunov::lyapunov_exponents;
use crate::sweep::{SweepEvent, sweep};
use core::ops::ControlFlow;

/// The least distance beyond its birth (relative to Gamma) at which the period-1 orbit is followed.
const AFTER_BIRTH: f64 = 1.0e-3;

/// Distance of the first orbits from the periodic one (relative to its velocity).
const BESIDE: f64 = 1.0e-6;

/// Displacement of the orbits from one forcing to the next (relative to the velocity), which separates orbits
/// that have merged.
const SHAKE: f64 = 1.0e-10;

/// The longest step in Gamma over the range.
const LONGEST_STEP: f64 = 1.0 / 64.0;

/// The narrowest bracket, relative to Gamma: [`SHAKE`] must not carry orbits over it.
const NARROWEST: f64 = 1.0e-9;

/// Once the mean survival time exceeds this share of all impacts, the upper end of the bracket is as near to
/// the crisis as this number of impacts can show. From then on the bracket is halved only as many times as
/// the second number.
const TOLD: f64 = 1.0 / 16.0;
const MORE_HALVINGS: u32 = 5;

/// The fewest orbits that rest at the upper end of the bracket.
const FEWEST_RESTS: u64 = 8;

/// The fewest impacts of an orbit.
const FEWEST_IMPACTS: usize = 200;

/// Lower ends after which the search gives up: events happen by chance at any forcing.
const MOST_LOWER_ENDS: u32 = 40;

/// Largest number of forcings with surviving orbits whose states are kept.
const KEPT: usize = 24;

/// Impacts over which exponents are measured. A growth like a power of their number n, as in neutral motion,
/// has an exponent of a few ln n/n: up to 5 ln n/n is not chaos.
const EXPONENT_IMPACTS: usize = 4_000;

/// Distances beyond the lower end at which survival times are compared, as multiples of the smallest.
const DISTANCES: [f64; 4] = [1.0, 4.0, 16.0, 64.0];

/// The factor by which survival times oscillate about their power law.
const OSCILLATION: f64 = 2.0;

/// The least ratio of survival times from which a margin is computed.
const LEAST_SEEN: f64 = 1.1;

/// The share of searches that miss a rest at a lower end by chance.
const MISSED: f64 = 0.05;

/// The longest move of an impact (rad, and relative speed) in one step along a branch of saddles.
const LONGEST_MOVE: f64 = 0.2;

/// The shortest step along such a branch, relative to Gamma.
const SHORTEST_STEP: f64 = 1.0e-6;

/// An orbit that was followed.
pub(super) struct Followed {
    /// Its impacts before it came to rest or the event of the search happened, at most those followed.
    pub(super) lived: usize,
    /// The last of them.
    pub(super) state: ImpactState,
    /// Whether it came to rest.
    pub(super) rests: bool,
    /// The cells of the plane that it entered, if the event is about them.
    pub(super) seen: BTreeSet<(u16, u32)>,
}

/// Orbits at a forcing.
struct Herd {
    forcing: f64,
    states: Vec<ImpactState>,
}

/// An orbit that comes to rest.
pub(super) struct Lost {
    pub(super) forcing: f64,
    pub(super) start: ImpactState,
    pub(super) impacts: usize,
    pub(super) rests: bool,
}

/// The end of an attractor, where orbits begin to come to rest.
pub(super) struct End {
    /// See [`super::Crisis::bracket`].
    pub(super) bracket: (f64, f64),
    /// Impacts on the attractor, near the lower end of the bracket.
    pub(super) attractor: Vec<ImpactState>,
    /// Orbits from these impacts that come to rest at the upper end of the bracket or near it, then those
    /// that come to rest farther beyond.
    pub(super) lost: Vec<Lost>,
    /// The mean survival time at the distance where 8 of them come to rest.
    pub(super) life: f64,
    /// The event.
    pub(super) exit: Exit,
}

impl CrisisSearch {
    /// Impacts of each orbit.
    pub(super) fn each(&self) -> usize {
        ((self.impacts / u64::from(self.samples)) as usize).max(FEWEST_IMPACTS * self.bands())
    }

    /// The forcing at which the attractor to which `inside` or the period-1 orbit leads begins to lose
    /// orbits.
    pub(super) fn end_of_attractor(
        &self,
        inside: Option<&PeriodicOrbit>,
        watch: &Watch<'_>,
    ) -> Result<Result<End, NoCrisis>, Error> {
        let mut reached = match self.first_herd(inside, watch)? {
            Ok(herd) => vec![herd],
            Err(reason) => return Ok(Err(reason)),
        };
        let mut exit = match self.exit_beside(&reached[0], watch)? {
            Ok(exit) => exit,
            Err(reason) => return Ok(Err(reason)),
        };
        let (each, all) = (self.each(), self.each() as f64 * f64::from(self.samples));
        let longest = LONGEST_STEP * (self.high - reached[0].forcing);
        let mut step = longest;
        let (mut shortest_life, mut halvings, mut lower_ends) = (usize::MAX, MORE_HALVINGS, 0);
        while let Some(here) = reached.last() {
            let next = here.forcing + step;
            let (forcing, most) = if next < self.high {
                (next, (each / 4).max(FEWEST_IMPACTS * self.bands()))
            } else {
                (self.high, each)
            };
            let lived = self.follow(forcing, &exit, &shaken(&here.states)?, most, watch)?;
            let life = life_of(&lived, most, forcing - here.forcing);
            if life.ended == 0 {
                if forcing >= self.high {
                    let (samples, impacts) = (self.samples, all as u64);
                    return Ok(Err(NoCrisis::NoneRests { forcing, samples, impacts, event: self.event }));
                }
                if reached.len() == KEPT {
                    reached.remove(0);
                }
                if let Exit::Region(region) = &mut exit {
                    region.extend(&lived);
                }
                reached.push(Herd { forcing, states: ends(lived) });
                step = (2.0 * step).min(longest);
                continue;
            }
            let width = forcing - here.forcing;
            halvings -= u32::from(halvings > 0 && life.impacts >= TOLD * all);
            if width > NARROWEST * forcing && halvings > 0 {
                step = 0.5 * width;
                continue;
            }
            // The lower end again with all impacts: so far its orbits made only a quarter of them.
            lower_ends += 1;
            let lived = self.follow(here.forcing, &exit, &here.states, each, watch)?;
            if lived.iter().all(|own| own.lived == each) {
                if let Exit::Region(region) = &mut exit {
                    region.extend(&lived);
                }
                let below = Herd { forcing: here.forcing, states: ends(lived) };
                match self.end(below, &exit, forcing, lower_ends, watch)? {
                    // The attractor of some orbits has ended: follow the other orbits further.
                    Err((_, Some(survivors))) if survivors.forcing < self.high => reached = vec![survivors],
                    found => return Ok(found.map_err(|(reason, _)| reason)),
                }
                (step, halvings, lower_ends) = (longest, MORE_HALVINGS, 0);
                continue;
            }
            shortest_life = lived.iter().fold(shortest_life, |least, own| least.min(own.lived));
            let lost = here.forcing;
            if lower_ends >= MOST_LOWER_ENDS {
                return Ok(Err(self.ends_before(lost, shortest_life)));
            }
            reached.pop();
            step = reached.last().map_or(step, |before| 0.5 * (lost - before.forcing));
        }
        Ok(Err(self.ends_before(self.low, shortest_life)))
    }

    pub(super) fn ends_before(&self, forcing: f64, life: usize) -> NoCrisis {
        NoCrisis::RestsBefore { forcing, life: life as u64, event: self.event }
    }

    /// The event of the search, for the attractor on which these orbits are.
    fn exit_beside(&self, herd: &Herd, watch: &Watch<'_>) -> Result<Result<Exit, NoCrisis>, Error> {
        let (forcing, each) = (herd.forcing, self.each().max(10 * FEWEST_IMPACTS));
        let exit = match self.exit(forcing, &herd.states)? {
            Some(Exit::Region(mut region)) => {
                let map = self.map(forcing)?;
                let lived = self.lives(&map, &ExitTest::Recorded(&region), &herd.states, each, watch)?;
                if let Some(life) = lived.iter().map(|own| own.lived).min().filter(|life| *life < each) {
                    return Ok(Err(self.ends_before(forcing, life)));
                }
                region.extend(&lived);
                Exit::Region(region)
            }
            Some(exit @ Exit::Bands(_)) => {
                let lived = self.follow(forcing, &exit, &herd.states, each, watch)?;
                if lived.iter().any(|own| own.lived < each) {
                    return Ok(Err(NoCrisis::NoBands { forcing, bands: 2 * self.bands() }));
                }
                exit
            }
            Some(exit) => exit,
            None => return Ok(Err(NoCrisis::NoBands { forcing, bands: 2 * self.bands() })),
        };
        Ok(Ok(exit))
    }

    /// Impacts of the saddle between the bands; 1 if the event is another.
    pub(super) fn bands(&self) -> usize {
        match self.event {
            CrisisEvent::BandMerging { bands } => bands as usize,
            _ => 1,
        }
    }

    /// The end of an attractor on which orbits survive at `below` and begin to come to rest at `forcing`; or
    /// the reason why this is no crisis, with the surviving orbits if a periodic attractor next to theirs has
    /// ended. `below` is the last of `lower_ends` lower ends that were tried; orbits came to rest at the
    /// others.
    fn end(
        &self,
        below: Herd,
        exit: &Exit,
        forcing: f64,
        lower_ends: u32,
        watch: &Watch<'_>,
    ) -> Result<Result<End, (NoCrisis, Option<Herd>)>, Error> {
        let (each, mut width, mut chaotic) = (self.each(), forcing - below.forcing, false);
        let power = |near: &MeanLife, far: &MeanLife| {
            let apart = ln(far.beyond / near.beyond);
            let error = (1.0 / near.ended as f64 + 1.0 / far.ended as f64).sqrt() / apart;
            (ln(near.impacts / far.impacts) / apart, error)
        };
        // Upwards until the rests are not due to chance and survival times shrink.
        let (lives, lost, steepest) = loop {
            let (mut lives, mut lost) = (Vec::new(), Vec::new());
            for share in DISTANCES {
                let (beyond, width) = (below.forcing + share * width, share * width);
                let lived = self.follow(beyond, exit, &below.states, each, watch)?;
                lives.push(life_of(&lived, each, width));
                lost.extend(self.lost(&below.states, beyond, &lived));
                if !chaotic && !lost.is_empty() {
                    let exponent = self.exponent(below.forcing, &lost)?;
                    let impacts = EXPONENT_IMPACTS as f64;
                    if exponent.is_nan() || exponent <= 5.0 * ln(impacts) / impacts {
                        let left: Vec<_> =
                            lived.iter().filter(|own| own.lived == each).map(|own| own.state).collect();
                        let states = left.iter().copied().cycle().take(below.states.len()).collect();
                        let survivors = (!left.is_empty()).then_some(Herd { forcing: beyond, states });
                        let reason = NoCrisis::NotChaotic { forcing: below.forcing, exponent };
                        return Ok(Err((reason, survivors)));
                    }
                    chaotic = true;
                }
                if lives.iter().any(|life| life.ended < FEWEST_RESTS) {
                    break;
                }
            }
            let (near, far) = (lives[0], lives[lives.len() - 1]);
            let (mean, error) = power(&near, &far);
            if lives.len() == DISTANCES.len() && far.ended >= FEWEST_RESTS && mean > 2.0 * error {
                break (lives, lost, mean + 2.0 * error);
            }
            if width > self.high - self.low {
                let (near, far) = (near.impacts, far.impacts);
                let reason = NoCrisis::LivesDoNotShrink { forcing: below.forcing, near, far };
                return Ok(Err((reason, None)));
            }
            width *= 4.0;
        };
        // Survival times rise in steps, as gaps close one after the other, so the steepest rise anywhere
        // counts.
        let powers = lives.windows(2).map(|pair| power(&pair[0], &pair[1]));
        let steepest = powers.fold(steepest, |most, (power, error)| most.max(power + 2.0 * error));
        // If the crisis lay lower by the margin, a rest would have been seen at the lower end, and at the
        // others before.
        let unseen = ln(f64::from(lower_ends) / MISSED);
        let all = each as f64 * below.states.len() as f64;
        let margin = lives.iter().fold(f64::MAX, |least, life| {
            let seen = all / (unseen * OSCILLATION * life.impacts * (1.0 + 2.0 * life.relative_error));
            least.min(life.beyond / (exp(ln(seen.max(LEAST_SEEN)) / steepest) - 1.0))
        });
        let bracket = (below.forcing - margin, forcing);
        let exit = exit.clone();
        Ok(Ok(End { bracket, lost, attractor: below.states, life: lives[0].impacts, exit }))
    }

    /// The orbits that come to rest.
    fn lost(&self, starts: &[ImpactState], forcing: f64, lived: &[Followed]) -> Vec<Lost> {
        let ended = starts.iter().zip(lived).filter(|(_, own)| own.lived < self.each());
        ended.map(|(&start, own)| Lost { forcing, start, impacts: own.lived, rests: own.rests }).collect()
    }

    /// The mean of the largest exponents of some of these orbits at a forcing at which they survive.
    fn exponent(&self, forcing: f64, lost: &[Lost]) -> Result<f64, Error> {
        let map = self.map(forcing)?;
        let starts: Vec<_> = lost.iter().take(16).map(|own| (map, own.start)).collect();
        let exponents: Vec<_> =
            lyapunov_exponents(&starts, 0, EXPONENT_IMPACTS, &Unobserved)?.into_iter().flatten().collect();
        Ok(exponents.iter().sum::<f64>() / exponents.len() as f64)
    }

    /// Orbits on the attractor at the lower end of the range, or just beyond its birth.
    fn first_herd(
        &self,
        inside: Option<&PeriodicOrbit>,
        watch: &Watch<'_>,
    ) -> Result<Result<Herd, NoCrisis>, Error> {
        let birth = (1.0 - self.restitution) / (1.0 + self.restitution);
        let forcing = if inside.is_some() { self.low } else { self.low.max((1.0 + AFTER_BIRTH) * birth) };
        if forcing >= self.high {
            return Ok(Err(NoCrisis::NotBorn { forcing: self.high, birth }));
        }
        let map = self.map(forcing)?;
        let orbit = match (inside, map.period_one(1)) {
            (Some(inside), _) => match self.followed_to(inside, forcing)? {
                Ok(orbit) => orbit,
                Err(reached) => return Ok(Err(NoCrisis::NotFollowed { forcing, reached })),
            },
            (None, Some(state)) => map.refine(&[state])?,
            (None, None) => return Ok(Err(NoCrisis::NotBorn { forcing: self.high, birth })),
        };
        let mut life = usize::MAX;
        for starts in self.starts_beside(&map, &orbit)? {
            let each = self.each().max(10 * FEWEST_IMPACTS);
            let lived = self.follow(forcing, &Exit::Rest, &starts, each, watch)?;
            if lived.iter().all(|own| own.lived == each) {
                return Ok(Ok(Herd { forcing, states: ends(lived) }));
            }
            life = lived.iter().fold(life, |least, own| least.min(own.lived));
        }
        Ok(Err(NoCrisis::RestsBefore { forcing, life: life as u64, event: CrisisEvent::Rest }))
    }

    /// Starts on either side of a saddle, on its unstable manifold; about an orbit of another kind, all
    /// together.
    fn starts_beside(&self, map: &ImpactMap, orbit: &PeriodicOrbit) -> Result<Vec<Vec<ImpactState>>, Error> {
        let Ok(saddle) = Saddle::of(map, orbit, 0) else {
            let mut random = SplitMix64::new(0);
            let state = orbit.states[0];
            let beside = |_| {
                let factor = 1.0 + BESIDE * (random.unit() - 0.5);
                ImpactState::new(state.phase(), state.velocity() * factor)
            };
            return Ok(vec![(0..self.samples).map(beside).collect::<Result<_, _>>()?]);
        };
        let side = |side| {
            let settings = ManifoldSettings::new(1.0, 16)?;
            let piece = Grower::new(map, &saddle, ManifoldKind::Unstable, side, &settings)?;
            let shares = (0..self.samples).map(|k| f64::from(k) / f64::from(self.samples));
            let states = shares.filter_map(|share| piece.first_piece(share).transpose());
            states.map(|found| found.map(|(state, _)| state)).collect::<Result<Vec<_>, Error>>()
        };
        Ok(vec![side(Side::Later)?, side(Side::Earlier)?])
    }

    /// The orbits from these starts until they come to rest or the event happens, at most for `most` impacts.
    fn follow(
        &self,
        forcing: f64,
        exit: &Exit,
        starts: &[ImpactState],
        most: usize,
        watch: &Watch<'_>,
    ) -> Result<Vec<Followed>, Error> {
        self.lives(&self.map(forcing)?, &exit.at(self, forcing)?, starts, most, watch)
    }

    fn lives(
        &self,
        map: &ImpactMap,
        exit: &ExitTest<'_>,
        starts: &[ImpactState],
        most: usize,
        watch: &Watch<'_>,
    ) -> Result<Vec<Followed>, Error> {
        let observer = |_: Progress| match watch.ask() {
            Ok(()) => ControlFlow::Continue(()),
            Err(_) => ControlFlow::Break(()),
        };
        let lives = until(map, exit, starts, most, &observer);
        let Progress { done, total } = watch.progress();
        watch.set_done((done + (most * starts.len()) as u64).min(total));
        watch.ask()?;
        lives
    }

    /// A periodic orbit of any map of this restitution, followed to a forcing; or the last forcing to which
    /// it could be followed.
    pub(super) fn followed_to(
        &self,
        orbit: &PeriodicOrbit,
        forcing: f64,
    ) -> Result<Result<PeriodicOrbit, f64>, Error> {
        let Some(mut reached) = self.forcing_of(orbit)? else { return Ok(Err(f64::NAN)) };
        let (mut orbit, mut step) = (orbit.clone(), forcing - reached);
        loop {
            let last = (forcing - reached).abs() <= step.abs();
            let next = if last { forcing } else { reached + step };
            match self.map(next)?.refine(&orbit.states) {
                Ok(found) if moved(&orbit, &found) <= LONGEST_MOVE => {
                    if last {
                        return Ok(Ok(found));
                    }
                    (orbit, reached, step) = (found, next, 2.0 * step);
                }
                _ if step.abs() > SHORTEST_STEP * reached => step *= 0.5,
                _ => return Ok(Err(reached)),
            }
        }
    }

    /// The forcing to which a periodic orbit belongs, from the height at the end of its first flight.
    fn forcing_of(&self, orbit: &PeriodicOrbit) -> Result<Option<f64>, Error> {
        let (from, to) = (orbit.states[0], orbit.states[1 % orbit.period()]);
        let launch = 0.0 - self.restitution * from.velocity();
        let ((sine, cosine), end) = (sin_cos(from.phase().angle()), sin_cos(to.phase().angle()));
        for turns in 0..=orbit.platform_periods {
            let between = to.phase().angle() - from.phase().angle();
            let h = between + core::f64::consts::TAU * (turns as f64);
            let forcing = (0.5 * h - launch) * h / (cosine * h - end.0 + sine) / core::f64::consts::PI;
            if h <= 0.0 || !(0.0..=Vibration::MAX_PEAK_ACCELERATION / 4.0).contains(&forcing) {
                continue;
            }
            if let Ok(own) = self.map(forcing)?.refine(&orbit.states)
                && moved(orbit, &own) < 1.0e-6
            {
                return Ok(Some(forcing));
            }
        }
        Ok(None)
    }

    /// The number of impacts from the separation after a rest to the next rest, up to the limit.
    pub(super) fn relaunched(&self, forcing: f64, most: u64) -> Result<u64, Error> {
        let map = self.map(forcing)?;
        let Some(phase) = map.vibration().separation_phase() else { return Ok(0) };
        let mut orbit = map.orbit_from_launch(Launch::new(phase, 0.0)?, ChatterPolicy::Complete);
        let mut impacts = 0;
        while impacts < most && matches!(orbit.advance()?, Some(OrbitEvent::Impact(_))) {
            impacts += 1;
        }
        Ok(impacts)
    }
}

/// The largest displacement of an impact of an orbit (rad, and relative speed).
fn moved(from: &PeriodicOrbit, to: &PeriodicOrbit) -> f64 {
    from.states.iter().zip(&to.states).fold(0.0, |most: f64, (a, b)| {
        let phase = phase_difference(b.phase().angle(), a.phase().angle()).abs();
        most.max(phase).max((b.velocity() - a.velocity()).abs() / (1.0 + a.velocity().abs()))
    })
}

fn life_of(lived: &[Followed], most: usize, beyond: f64) -> MeanLife {
    MeanLife::of(lived.iter().map(|own| own.lived), most, beyond)
}

fn ends(lived: Vec<Followed>) -> Vec<ImpactState> {
    lived.into_iter().map(|own| own.state).collect()
}

/// The orbits from these starts until they come to rest or the event happens, at most for `most` >= 1 impacts.
pub(super) fn until(
    map: &ImpactMap,
    exit: &ExitTest<'_>,
    starts: &[ImpactState],
    most: usize,
    observer: &dyn Observer,
) -> Result<Vec<Followed>, Error> {
    let orbits: Vec<_> = starts.iter().map(|&start| map.orbit(start, ChatterPolicy::Complete)).collect();
    let followed = sweep(
        &orbits,
        |index| (0, starts[index], false, Track::default()),
        |(lived, state, rests, track), event| match event {
            SweepEvent::Impact(impact) => {
                if exit.happens(track, impact.state) {
                    return ControlFlow::Break(());
                }
                (*lived, *state) = (*lived + 1, impact.state);
                if *lived < most { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            }
            _ => {
                *rests = true;
                ControlFlow::Break(())
            }
        },
        observer,
    )?;
    let shown = |(lived, state, rests, track): (usize, ImpactState, bool, Track)| {
        let seen = track.seen;
        Followed { lived, state, rests, seen }
    };
    Ok(followed.into_iter().map(shown).collect())
}

/// The same states, each moved slightly by a different amount.
fn shaken(states: &[ImpactState]) -> Result<Vec<ImpactState>, Error> {
    let moved = states.iter().enumerate().map(|(index, state)| {
        let factor = 1.0 + SHAKE * (index as f64 / states.len() as f64);
        ImpactState::new(state.phase(), state.velocity() * factor)
    });
    moved.collect()
}

/// The number of orbits that are examined.
const ORBITS: usize = 24;

/// The last impacts of an orbit among which it passes the saddle.
const IMPACTS: usize = 160;

/// The largest number of impacts of the saddle.
const LONGEST: usize = 12;

/// The distance (rad, and units of 1 + P) to which an orbit that passes a saddle closes.
const CLOSES: f64 = 0.02;

/// The least share of the orbits that pass the same saddle.
const SHARE: f64 = 0.25;

impl CrisisSearch {
    /// The saddles that orbits pass before they come to rest, in order of decreasing number of orbits.
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

/// The last impacts of an orbit that comes to rest after `impacts` impacts.
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
            // The impacts of a chatter come ever closer, but are not a cycle.
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
