//! Flights in lockstep for callers that add something to each: rows of impacts instead of single ones.

use core::f64::consts::TAU;

use pulp::{Simd, WithSimd};

use crate::chatter::accumulation::surely_bounces_on;
use crate::flight::launch::Launch;
use crate::flight::platform::vibration::Vibration;
use crate::map::impact_map::ImpactState;
use crate::numerics::error::{Error, room_for};
use crate::sweep::lockstep::lanes::{
    Batch, Dispatch, FlightScheduler, InstructionSet, LANES, Mask, Purpose, Rebounding, Row, kept, mask,
};

/// A loop over lanes that [`Flights::run`] runs with the vector instructions of the processor.
///
/// Mark the implementation of [`Self::run`], and all functions it calls, with `#[inline(always)]`: a function
/// that is not inlined is compiled for the baseline.
pub trait LaneLoop {
    /// The loop.
    fn run(self);
}

/// Independent flights, computed together: each lane has its own platform and launch. The impacts have the
/// same bits as from [`Vibration::first_impact`].
///
/// Lanes come in batches of [`Self::LANES`] and are numbered consecutively: lane 70 is lane 6 of batch 1.
/// Setting a lane or batch that does not exist does nothing, and reading it returns `None`. The more batches,
/// the better flights of one kind fill the vectors of the processor.
///
/// ```
/// use bouncing_disk_core::sweep::{Flights, InstructionSet};
/// use bouncing_disk_core::{Launch, Phase, Vibration};
///
/// let mut flights = Flights::new(InstructionSet::best(), 1)?;
/// for lane in 0..10 {
///     flights.set_platform(lane, Vibration::new(2.0 + lane as f64)?);
///     flights.set_launch(lane, Launch::new(Phase::new(0.7)?, 3.0)?);
/// }
/// flights.fly(10, |lane, error| unreachable!("{lane}: {error}"));
/// let alone = Vibration::new(9.0)?.first_impact(Launch::new(Phase::new(0.7)?, 3.0)?)?;
/// assert_eq!(flights.state(7), Some(alone.into()));
/// assert_eq!(flights.impacts(0).map(|rows| rows.duration(7)), Some(alone.duration()));
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Flights {
    scheduler: Box<FlightScheduler>,
    batches: Vec<Batch>,
    /// Whether a lane of the batch has been put on a platform.
    placed: Vec<bool>,
}

/// The impacts of one batch of [`Flights`]; they are meaningless in lanes that have not flown since their
/// launch was set.
#[derive(Debug, Clone, Copy)]
pub struct LaneImpacts<'a> {
    /// Phases (rad), in [0, 2 pi).
    pub angle: &'a [f64; LANES],
    /// Sines of the phases.
    pub sin: &'a [f64; LANES],
    /// Cosines of the phases.
    pub cos: &'a [f64; LANES],
    /// Relative axial velocities w_A just before the impact, <= 0, in units of g/omega.
    pub velocity: &'a [f64; LANES],
    /// How many times the phase passed 0 (mod 2 pi) during the flight; a negative value is rounding and
    /// means 0.
    pub turns: &'a [f64; LANES],
    /// Phases (rad) that the flights left from.
    launched: &'a [f64; LANES],
    /// Durations, or `Impacts::BETWEEN_PHASES`.
    duration: &'a [f64; LANES],
}

impl LaneImpacts<'_> {
    /// Duration of the flight of a lane of the batch (rad): [`Impact::duration`](crate::Impact::duration).
    ///
    /// # Panics
    /// If the rows have no such lane.
    #[must_use]
    #[inline(always)]
    pub fn duration(&self, lane: usize) -> f64 {
        // As `flight::landed` finds it if the flight was not followed from its launch.
        let ahead = self.angle[lane] - self.launched[lane];
        let wrapped = ahead + TAU;
        let behind = mask(ahead < 0.0);
        // A sum that rounds to a whole turn is a whole number of periods, less than the rounding.
        let short_of = behind & mask(wrapped < TAU);
        let turns = kept(mask(self.turns[lane] > 0.0), self.turns[lane]);
        let less = turns - kept(short_of, 1.0);
        let periods = kept(mask(less > 0.0), less);
        let remainder = kept(!behind, ahead) + kept(short_of, wrapped);
        let known = self.duration[lane];
        if known >= 0.0 { known } else { periods * TAU + remainder }
    }
}

impl Flights {
    /// Number of lanes of a batch.
    pub const LANES: usize = LANES;

    /// Largest number of batches.
    pub const MAX_BATCHES: usize = 1 << 16;

    /// At least one batch of lanes on a platform at rest, computed with these instructions, or with the next
    /// lower set that the processor supports. The impacts do not depend on the instructions.
    ///
    /// # Errors
    /// [`Error::TooLarge`] for more than [`Self::MAX_BATCHES`] batches, or too many for the memory.
    pub fn new(set: InstructionSet, batches: usize) -> Result<Self, Error> {
        let count = batches.max(1);
        let room = (count as u64, Self::MAX_BATCHES as u64);
        let mut batches = room_for("batches of lanes", room.0, room.1)?;
        batches.resize(count, Batch::new(Vibration::still()));
        let mut placed = room_for("batches of lanes", room.0, room.1)?;
        placed.resize(count, false);
        Ok(Self { scheduler: Box::new(FlightScheduler::new(set, Purpose::Launches)), batches, placed })
    }

    /// Number of batches.
    #[must_use]
    pub const fn batches(&self) -> usize {
        self.batches.len()
    }

    /// Puts a lane on another platform. The first platform of a batch applies to all its lanes until they get
    /// their own.
    pub fn set_platform(&mut self, lane: usize, vibration: Vibration) {
        let index = lane / LANES;
        let (Some(batch), Some(placed)) = (self.batches.get_mut(index), self.placed.get_mut(index)) else {
            return;
        };
        if core::mem::replace(placed, true) {
            batch.set_platform(lane % LANES, vibration);
        } else {
            batch.share_platform(vibration);
        }
    }

    /// Sets the next launch of a lane; its last impact is discarded.
    pub fn set_launch(&mut self, lane: usize, launch: Launch) {
        if let Some(batch) = self.batches.get_mut(lane / LANES) {
            batch.set_launch(lane % LANES, launch.phase(), launch.relative_speed());
        }
    }

    /// The next launch of a lane.
    #[must_use]
    pub fn launch(&self, lane: usize) -> Option<Launch> {
        let (batch, lane) = (self.batches.get(lane / LANES)?, lane % LANES);
        Some(Launch::known(batch.launch_phase(lane), batch.launches().speed[lane]))
    }

    /// Sets the next launch of every lane of a batch to the rebound from its impact, with its own coefficient
    /// of restitution in [0, 1); another number counts as zero.
    ///
    /// If the bits of a lane in `may_rest` are then zero, its disk keeps bouncing:
    /// [`crate::ImpactMap::accumulation`] is `None`.
    pub fn rebound(&mut self, batch: usize, restitution: &[f64; LANES], may_rest: &mut [u64; LANES]) {
        let Some(batch) = self.batches.get_mut(batch) else { return };
        self.scheduler.dispatch().run(Rebound { rows: batch.rebounding(), restitution, may_rest });
    }

    /// Computes the impacts of the first `lanes` launches. `failed` receives each lane without one (see
    /// [`Vibration::first_impact`]), in order; the impact of such a lane is meaningless.
    pub fn fly(&mut self, lanes: usize, mut failed: impl FnMut(usize, Error)) {
        let lanes = lanes.min(LANES * self.batches.len());
        self.scheduler.fly(&mut self.batches, lanes, &mut failed);
    }

    /// The impacts of a batch.
    #[must_use]
    pub fn impacts(&self, batch: usize) -> Option<LaneImpacts<'_>> {
        let batch = self.batches.get(batch)?;
        let impacts = batch.impacts();
        Some(LaneImpacts {
            angle: &impacts.angle,
            sin: &impacts.sin,
            cos: &impacts.cos,
            velocity: &impacts.velocity,
            turns: &impacts.turns,
            launched: &batch.impacts_before().angle,
            duration: &impacts.duration,
        })
    }

    /// The impact of a lane.
    #[must_use]
    pub fn state(&self, lane: usize) -> Option<ImpactState> {
        Some(self.batches.get(lane / LANES)?.impact_state(lane % LANES))
    }

    /// Runs a loop with the instructions of the flights.
    #[inline(always)]
    pub fn run(&self, operation: impl LaneLoop) {
        self.scheduler.dispatch().run(Vectorised(operation));
    }
}

/// A runner of loops with the vector instructions of the processor but without [`Flights`], for one flight
/// with many companions.
#[derive(Debug, Clone, Copy)]
pub struct LaneRunner(Dispatch);

impl LaneRunner {
    /// A runner with `set`, or the next lower set that this processor supports.
    #[must_use]
    pub fn new(set: InstructionSet) -> Self {
        Self(Dispatch::new(set))
    }

    /// Runs a loop.
    #[inline(always)]
    pub fn run(&self, operation: impl LaneLoop) {
        self.0.run(Vectorised(operation));
    }
}

struct Vectorised<Loop>(Loop);

impl<Loop: LaneLoop> WithSimd for Vectorised<Loop> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.0.run();
    }
}

/// Launches that follow the impacts, and which of them may be the first of a chatter.
struct Rebound<'a> {
    rows: Rebounding<'a>,
    restitution: &'a Row,
    may_rest: &'a mut Mask,
}

impl WithSimd for Rebound<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { rows: Rebounding { peaks, impacts, speed: speeds }, restitution, may_rest } = self;
        for lane in 0..LANES {
            let (peak, given) = (peaks[lane], restitution[lane]);
            // A NaN would become the speed of a launch, and then the phase of an impact.
            let restitution = kept(mask(given >= 0.0) & mask(given < 1.0), given);
            let speed = -restitution * impacts.velocity[lane];
            let pull = 1.0 - peak * impacts.sin[lane];
            speeds[lane] = speed;
            may_rest[lane] = !mask(surely_bounces_on(peak, pull, speed, restitution));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flight::launch::{Impact, launch_that_may_dip};
    use crate::flight::platform::phase::Phase;
    use crate::numerics::testing::golden_spread;

    fn launch(k: u64) -> (Vibration, Launch) {
        let peak = match k % 5 {
            0 => 1.2 * golden_spread(k),
            1 | 2 => 1.0 + 2.0 * golden_spread(3 * k),
            3 => 197.392_088,
            _ => libm::exp10(6.0 * golden_spread(k / 7)),
        };
        let speed = (1.0 + peak) * libm::exp10(1.5 - 7.0 * golden_spread(k / 3) * golden_spread(11 * k));
        // Now and then phases next to the turn.
        let angle = if k.is_multiple_of(97) {
            TAU * (1.0 - 1e-16 * golden_spread(5 * k))
        } else {
            TAU * golden_spread(13 * k + k / 64)
        };
        let phase = Phase::new(angle).expect("finite");
        (Vibration::new(peak).expect("legal"), Launch::new(phase, speed).expect("legal"))
    }

    /// Flies these launches, and compares all values in the rows and lanes, and the errors, with single flights.
    fn compared(flights: &mut Flights, launches: &[(Vibration, Launch)]) -> Vec<Impact> {
        for (lane, (vibration, launch)) in launches.iter().enumerate() {
            flights.set_platform(lane, *vibration);
            flights.set_launch(lane, *launch);
        }
        let mut failures = Vec::new();
        flights.fly(launches.len(), |lane, error| failures.push((lane, error)));
        let (mut failures, mut landed) = (failures.into_iter(), Vec::new());
        for (lane, &(vibration, launch)) in launches.iter().enumerate() {
            let alone = match vibration.first_impact(launch) {
                Ok(alone) => alone,
                Err(error) => {
                    assert_eq!(failures.next(), Some((lane, error)));
                    continue;
                }
            };
            let (impacts, own) = (flights.impacts(lane / LANES).expect("exists"), lane % LANES);
            let angles = [impacts.angle[own], impacts.sin[own], impacts.cos[own]];
            let rows = [angles[0], angles[1], angles[2], impacts.velocity[own], impacts.duration(own)];
            let (phase, velocity) = (alone.phase, alone.velocity);
            let expected = [phase.angle(), phase.sin(), phase.cos(), velocity, alone.duration()];
            let (rows, expected) = (rows.map(f64::to_bits), expected.map(f64::to_bits));
            assert_eq!(rows, expected, "{lane} of {}: {vibration:?} {launch:?}", launches.len());
            assert_eq!(impacts.turns[own] as u64, alone.turns);
            assert_eq!(flights.state(lane), Some(alone.into()));
            landed.push(alone);
        }
        assert_eq!(failures.next(), None);
        landed
    }

    /// Batches of every size, because stages are computed for as few sixteens of lanes as hold their flights; and
    /// many flights.
    #[test]
    fn lanes_hold_what_single_flights_say() {
        const ALL: usize = 3 * LANES - 5;
        for set in InstructionSet::available() {
            let mut flights = Flights::new(set, 3).expect("few");
            for lanes in 1..=2 * LANES {
                let launches: Vec<_> = (0..lanes).map(|lane| launch((997 * lanes + lane) as u64)).collect();
                compared(&mut flights, &launches);
            }
            for block in 0..3_000 {
                let launches: Vec<_> = (0..ALL).map(|lane| launch(200 * block + lane as u64)).collect();
                compared(&mut flights, &launches);
            }
        }
    }

    /// Launches about as fast as the platform at its fastest; they may dip below it between separation and
    /// crest.
    #[test]
    fn launches_that_dip_are_those_of_single_flights() {
        let vibration = Vibration::new(2.0).expect("legal");
        let mut flights = Flights::new(InstructionSet::best(), 4).expect("few");
        let mut dips = 0;
        for block in 0..1_500 {
            let launches: Vec<_> = (0..4 * LANES as u64)
                .filter_map(|lane| {
                    let (phase, speed) = launch_that_may_dip(&vibration, 256 * block + lane);
                    Some((vibration, Launch::new(phase, speed).ok()?))
                })
                .collect();
            let landed = compared(&mut flights, &launches);
            assert_eq!(landed.len(), launches.len());
            let dipped = landed.iter().filter(|alone| alone.velocity > -0.1 && alone.duration() > 0.6);
            dips += dipped.count();
        }
        assert!(dips > 1_000, "{dips}");
    }

    #[test]
    fn more_batches_than_there_is_room_for_are_refused() {
        for batches in [Flights::MAX_BATCHES + 1, usize::MAX / 64, usize::MAX] {
            let refusal = Flights::new(InstructionSet::best(), batches).expect_err("too many");
            assert!(matches!(refusal, Error::TooLarge { count, .. } if count == batches as u64), "{refusal}");
        }
    }

    /// A rebound with NaN once launched disks that landed at no phase, without an error.
    #[test]
    fn a_rebound_that_is_none_leaves_the_disk_where_it_hit() {
        let (vibration, launch) = (Vibration::new(2.0).expect("legal"), launch(1).1);
        for restitution in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -0.5, 1.0, 1e300] {
            let mut flights = Flights::new(InstructionSet::best(), 1).expect("few");
            for lane in 0..LANES {
                flights.set_platform(lane, vibration);
                flights.set_launch(lane, launch);
            }
            flights.fly(LANES, |lane, error| unreachable!("{lane}: {error}"));
            let hit = flights.state(3).expect("exists");
            flights.rebound(0, &[restitution; LANES], &mut [0; LANES]);
            assert_eq!(flights.launch(3), Launch::new(hit.phase(), 0.0).ok(), "{restitution}");
        }
    }

    #[test]
    fn lanes_that_do_not_exist_are_refused() {
        let mut flights = Flights::new(InstructionSet::best(), 0).expect("few");
        assert_eq!(flights.batches(), 1, "at least one");
        let (vibration, launch) = launch(1);
        flights.set_platform(LANES, vibration);
        flights.set_launch(LANES, launch);
        flights.rebound(1, &[0.5; LANES], &mut [0; LANES]);
        assert!(flights.state(LANES).is_none() && flights.launch(LANES).is_none());
        assert!(flights.impacts(0).is_some() && flights.impacts(1).is_none());
    }
}
