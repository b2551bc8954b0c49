//! Labels of many starts at once: as [`ImpactMap::basin_label`], with the flights in lockstep.

use core::f64::consts::TAU;

use pulp::{Simd, WithSimd};

use super::{BasinSettings, KnownOrbit, Label, UNDECIDED};
use crate::chatter::{ChatterPolicy, chatters_to_rest};
use crate::elementary::nearest_whole;
use crate::error::Error;
use crate::lanes::{Batch, Flyer, Impacts, InstructionSet, LANES, Mask, mask};
use crate::map::{ImpactMap, ImpactState};

/// Share by which the screen's radius exceeds the known orbit's, so that its rounding does not matter.
const SLACK: f64 = 1.0e-9;

/// Batches that are computed together: enough of each kind of flight to fill vectors.
const BATCHES: usize = 8;

/// An impact of a known orbit.
#[derive(Debug, Clone, Copy)]
struct Target {
    angle: f64,
    velocity: f64,
    square_radius: f64,
}

/// Finds the lanes whose impacts may decide a label.
struct Screen<'a> {
    impacts: &'a Impacts,
    targets: &'a [Target],
    peak: f64,
    restitution: f64,
    rests: &'a mut Mask,
    near: &'a mut Mask,
}

impl WithSimd for Screen<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { impacts, targets, peak, restitution, rests, near } = self;
        for lane in 0..LANES {
            let speed = -restitution * impacts.velocity[lane];
            let (sin, cos) = (impacts.sin[lane], impacts.cos[lane]);
            rests[lane] = mask(chatters_to_rest(peak, sin, cos, speed, restitution)) | mask(speed <= 0.0);
            near[lane] = 0;
        }
        let inverse_peak = 1.0 / peak;
        for target in targets {
            for (lane, near) in near.iter_mut().enumerate() {
                let turned = impacts.angle[lane] - target.angle;
                let phase = turned - TAU * nearest_whole(turned * (1.0 / TAU));
                let velocity = (impacts.velocity[lane] - target.velocity) * inverse_peak;
                *near |= mask(phase * phase + velocity * velocity <= target.square_radius);
            }
        }
    }
}

impl ImpactMap {
    /// Labels `cells`, the one of index i with the start `start(i)`.
    pub(super) fn label_cells(
        &self,
        start: impl Fn(usize) -> Result<ImpactState, Error>,
        cells: &mut [Label],
        known: &[KnownOrbit],
        settings: BasinSettings,
    ) -> Result<(), Error> {
        if settings.policy != ChatterPolicy::Complete {
            for (index, label) in cells.iter_mut().enumerate() {
                *label = self.basin_label(start(index)?, known, settings)?;
            }
            return Ok(());
        }
        let targets: Vec<Target> = known
            .iter()
            .flat_map(|known| {
                known.orbit.states.iter().map(|state| Target {
                    angle: state.phase().angle(),
                    velocity: state.velocity(),
                    square_radius: known.radius * known.radius * (1.0 + SLACK),
                })
            })
            .collect();
        let mut lockstep = Lockstep {
            map: self,
            known,
            settings,
            batches: vec![Batch::new(*self.vibration()); BATCHES],
            cell: vec![0; BATCHES * LANES],
            impacts: vec![0; BATCHES * LANES],
            lanes: 0,
            next: 0,
        };
        let mut flyer = Box::new(Flyer::new(InstructionSet::best()));
        let (mut rests, mut near) = ([0; LANES], [0; LANES]);
        let restitution = [self.restitution(); LANES];
        while lockstep.lanes < BATCHES * LANES && lockstep.load(lockstep.lanes, &start, cells)? {
            lockstep.lanes += 1;
        }
        while lockstep.lanes > 0 {
            let mut failure = None;
            let used = lockstep.lanes.div_ceil(LANES);
            for batch in &mut lockstep.batches[..used] {
                batch.rebound(&restitution);
            }
            flyer.fly(&mut lockstep.batches[..used], lockstep.lanes, |_, error| failure = Some(error));
            if let Some(error) = failure {
                return Err(error);
            }
            // From the last lane, so that a lane moved into a gap has been judged.
            for number in (0..used).rev() {
                flyer.dispatch().run(Screen {
                    impacts: lockstep.batches[number].impacts(),
                    targets: &targets,
                    peak: self.vibration().peak_acceleration(),
                    restitution: self.restitution(),
                    rests: &mut rests,
                    near: &mut near,
                });
                let first = number * LANES;
                for lane in (first..lockstep.lanes.min(first + LANES)).rev() {
                    lockstep.impacts[lane] += 1;
                    let decided = match (rests[lane - first] | near[lane - first]) != 0 {
                        true => self.settles(lockstep.state(lane), known, settings.policy),
                        false => None,
                    };
                    let spent = lockstep.impacts[lane] >= settings.max_impacts;
                    if let Some(label) = decided.or(spent.then_some(UNDECIDED)) {
                        cells[lockstep.cell[lane]] = label;
                        if !lockstep.load(lane, &start, cells)? {
                            lockstep.retire(lane);
                        }
                    }
                }
            }
        }
        Ok(())
    }
}

/// The starts under way.
struct Lockstep<'a> {
    map: &'a ImpactMap,
    known: &'a [KnownOrbit],
    settings: BasinSettings,
    batches: Vec<Batch>,
    /// The cell of each lane, and the impacts since its start.
    cell: Vec<usize>,
    impacts: Vec<u32>,
    /// Lanes in use: the first ones.
    lanes: usize,
    /// The first cell not begun.
    next: usize,
}

impl Lockstep<'_> {
    /// Begins the next cell that its start does not decide in `lane`; false if there is none.
    fn load(
        &mut self,
        lane: usize,
        start: impl Fn(usize) -> Result<ImpactState, Error>,
        cells: &mut [Label],
    ) -> Result<bool, Error> {
        while self.next < cells.len() {
            let index = self.next;
            self.next += 1;
            let state = start(index)?;
            let decided = self.map.settles(state, self.known, self.settings.policy);
            let spent = (self.settings.max_impacts == 0).then_some(UNDECIDED);
            match decided.or(spent) {
                Some(label) => cells[index] = label,
                None => {
                    self.batches[lane / LANES].set_impact(lane % LANES, state.phase(), state.velocity());
                    self.cell[lane] = index;
                    self.impacts[lane] = 0;
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }

    /// Fills the gap that a finished lane leaves with the last one in use.
    fn retire(&mut self, lane: usize) {
        self.lanes -= 1;
        let last = self.state(self.lanes);
        self.batches[lane / LANES].set_impact(lane % LANES, last.phase(), last.velocity());
        self.cell[lane] = self.cell[self.lanes];
        self.impacts[lane] = self.impacts[self.lanes];
    }

    fn state(&self, lane: usize) -> ImpactState {
        self.batches[lane / LANES].impact_state(lane % LANES)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{ATTACHED, Axis, Grid};
    use super::*;
    use crate::vibration::Vibration;

    fn compared(axial_forcing: f64, restitution: f64, cells: usize) -> [usize; 4] {
        let map = ImpactMap::new(Vibration::from_axial_forcing(axial_forcing).expect("legal"), restitution)
            .expect("legal");
        let orbit = map
            .settled_orbit(ImpactState::from_normalised(0.8, 1.3).expect("legal"), 4_000, 16, 1e-8)
            .expect("no failure");
        let known: Vec<_> = orbit
            .and_then(|orbit| orbit.catching_radius(&map).map(|radius| KnownOrbit { orbit, radius }))
            .into_iter()
            .collect();
        let settings = BasinSettings { max_impacts: 300, policy: ChatterPolicy::Complete };
        let grid =
            Grid::new(Axis::new(0.0, 1.0, cells).expect("legal"), Axis::new(0.0, 3.0, cells).expect("legal"))
                .expect("legal");
        let basins = map.basins(grid, &known, settings, || ()).expect("no failure");
        let mut counts = [0; 4];
        for row in 0..cells {
            for (column, &label) in basins.row(row).iter().enumerate() {
                let start =
                    ImpactState::from_normalised(grid.phase.centre(column) * TAU, grid.speed.centre(row))
                        .expect("legal");
                let expected = map.basin_label(start, &known, settings).expect("no failure");
                assert_eq!(label, expected, "Gamma {axial_forcing}: {start:?}");
                counts[usize::from(label).min(3)] += 1;
            }
        }
        counts
    }

    #[test]
    fn lockstep_labels_are_those_of_single_orbits() {
        for (axial_forcing, restitution) in
            [(0.2, 0.5), (0.34, 0.5), (0.5, 0.5), (0.55, 0.5), (0.6, 0.5), (2.0, 0.8)]
        {
            let counts = compared(axial_forcing, restitution, 150);
            assert!(counts[usize::from(ATTACHED)] > 0, "Gamma {axial_forcing}: {counts:?}");
        }
    }

    /// A disk that is certain to chatter to rest does come to rest, impact by impact, in a time that the proof bounds.
    #[test]
    fn certain_rest_is_rest() {
        let (mut certain, mut late) = (0, 0);
        for k in 0..40_000_u32 {
            let share = |factor: f64| (f64::from(k) * factor) % 1.0;
            let restitution = 0.95 * share(0.754_877_666);
            let peak = 3.0 * share(0.569_840_29);
            let map = ImpactMap::new(Vibration::new(peak).expect("legal"), restitution).expect("legal");
            let speed = libm::exp10(-2.5 + 2.5 * share(0.137));
            let state = ImpactState::from_normalised(TAU * share(0.618_034), speed).expect("legal");
            let launch = -restitution * state.velocity();
            if !map.vibration().chatters_to_rest(state.phase(), launch, restitution) {
                continue;
            }
            certain += 1;
            late += u32::from(launch > 0.05);
            let mut orbit = map.orbit(state, ChatterPolicy::Complete);
            let rests = (0..2_000).find_map(|_| match orbit.advance().expect("no failure") {
                Some(crate::OrbitEvent::Impact(impact)) => {
                    assert!(-impact.velocity <= launch / restitution, "{state:?} {impact:?}");
                    None
                }
                event => Some(event.is_some()),
            });
            assert_eq!(rests, Some(true), "{state:?}");
        }
        assert!(certain > 5_000 && late > 500, "{certain} {late}");
    }
}
