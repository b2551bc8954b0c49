//! Labels of many starts at once, as by [`ImpactMap::basin_label`], with the flights in lockstep.

use super::screen::{Judge, LabelMasks};
use super::starts::{Cell, Cells, Starts};
use super::{BasinSettings, KnownOrbit, Label, UNDECIDED, flights_of_label, label_of_start};
use crate::chatter::policy::ChatterPolicy;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::error::Error;
use crate::sweep::lockstep::lanes::{Batch, FlightScheduler, InstructionSet, LANES, Lanes, Purpose};

/// Batches that are computed together. More of them fill the vectors of the rarer kinds of flight better;
/// with this number a thread's data still fit into the second-level cache of small processors.
const BATCHES: usize = 24;

impl ImpactMap {
    /// Labels cells until all are taken, at most `lanes` of them at a time.
    pub(super) fn label_cells(
        &self,
        cells: &Cells<'_>,
        known: &[KnownOrbit],
        settings: BasinSettings,
        lanes: usize,
    ) -> Result<(), Error> {
        if settings.policy != ChatterPolicy::Complete || settings.max_impacts == 0 {
            return self.label_one_by_one(cells, known, settings);
        }
        let capacity = lanes.clamp(1, BATCHES * LANES);
        let mut lockstep = Lockstep::new(self, known, settings, capacity);
        let mut starts = Starts::new(cells, Batch::new(*self.vibration()));
        while lockstep.lanes < capacity && lockstep.load(lockstep.lanes, &mut starts) {
            lockstep.lanes += 1;
        }
        let mut verdicts = LabelMasks::new();
        while lockstep.lanes > 0 {
            lockstep.fly()?;
            // From the last lane down, so that a lane moved into a gap has already been judged.
            for number in (0..lockstep.lanes.div_ceil(LANES)).rev() {
                lockstep.judge(number, &mut starts, &mut verdicts)?;
            }
            lockstep.give_up(&mut starts);
        }
        // Lanes also run empty when the call is stopped.
        if cells.watch.is_stopped() { cells.watch.ask() } else { Ok(()) }
    }

    fn label_one_by_one(
        &self,
        cells: &Cells<'_>,
        known: &[KnownOrbit],
        settings: BasinSettings,
    ) -> Result<(), Error> {
        let (mut work, flights) = (cells.watch.work(), flights_of_label(known));
        while let Some(share) = cells.take() {
            let rows = cells.speeds[share.first_row..].iter();
            for (row, speed) in share.labels.chunks_mut(cells.phases.len()).zip(rows) {
                for (label, phase) in row.iter_mut().zip(&cells.phases) {
                    let start = ImpactState::new(*phase, -speed)?;
                    *label = label_of_start(self, start, known, settings, || work.spend(flights))?;
                }
            }
            cells.rows_done(&share);
        }
        Ok(())
    }
}

/// The starts under way.
struct Lockstep<'a> {
    judge: Judge<'a>,
    max_impacts: u64,
    scheduler: Box<FlightScheduler>,
    batches: Vec<Batch>,
    /// The cell of each lane, and the round before its first flight.
    cell: Vec<Cell>,
    begun: Vec<u64>,
    /// The number of lanes in use, which are the first ones.
    lanes: usize,
    /// Flights made, and the round in which the first lane may have spent its impacts.
    round: u64,
    deadline: u64,
}

impl<'a> Lockstep<'a> {
    fn new(map: &'a ImpactMap, known: &'a [KnownOrbit], settings: BasinSettings, capacity: usize) -> Self {
        let scheduler = Box::new(FlightScheduler::new(InstructionSet::best(), Purpose::Orbits));
        Self {
            judge: Judge::new(map, known, settings, scheduler.dispatch()),
            max_impacts: u64::from(settings.max_impacts),
            scheduler,
            batches: vec![Batch::of_map(map); capacity.div_ceil(LANES)],
            cell: vec![Cell::NONE; capacity],
            begun: vec![0; capacity],
            lanes: 0,
            round: 0,
            deadline: u64::from(settings.max_impacts),
        }
    }

    /// One more impact for all lanes.
    fn fly(&mut self) -> Result<(), Error> {
        self.round += 1;
        let batches = &mut self.batches[..self.lanes.div_ceil(LANES)];
        let mut failure = None;
        self.scheduler.fly(batches, self.lanes, |_, error| failure = Some(error));
        failure.map_or(Ok(()), Err)
    }

    /// Labels the lanes of a batch that are decided by their impacts, and begins other starts there.
    fn judge(
        &mut self,
        number: usize,
        starts: &mut Starts<'_, '_>,
        verdicts: &mut LabelMasks,
    ) -> Result<(), Error> {
        self.judge.screen(self.batches[number].impacts(), verdicts, |flights| starts.spend(flights))?;
        let first = number * LANES;
        let settled = verdicts.settled & Lanes::first((self.lanes - first).min(LANES));
        for lane in settled.rev() {
            if verdicts.doubtful[lane] != 0 {
                starts.spend(self.judge.work_of_doubt())?;
            }
            if let Some(label) = self.judge.label(verdicts, &self.batches[number], lane) {
                self.finish(first + lane, label, starts);
            }
        }
        Ok(())
    }

    /// Labels the lanes that have spent their impacts.
    fn give_up(&mut self, starts: &mut Starts<'_, '_>) {
        if self.round < self.deadline {
            return;
        }
        let allowed = self.max_impacts;
        for lane in (0..self.lanes).rev() {
            if self.round - self.begun[lane] >= allowed {
                self.finish(lane, UNDECIDED, starts);
            }
        }
        let first = self.begun[..self.lanes].iter().min();
        self.deadline = first.map_or(u64::MAX, |begun| begun + allowed);
    }

    fn finish(&mut self, lane: usize, label: Label, starts: &mut Starts<'_, '_>) {
        starts.settle(self.cell[lane], label);
        if !self.load(lane, starts) {
            // The last lane in use fills the gap.
            self.lanes -= 1;
            let last = self.lanes;
            self.take(lane, last);
            self.cell[lane] = self.cell[last];
            self.begun[lane] = self.begun[last];
        }
    }

    /// Begins the next start in `lane`; false if no start is left.
    fn load(&mut self, lane: usize, starts: &mut Starts<'_, '_>) -> bool {
        let Some((cell, from)) = starts.next(&self.judge) else { return false };
        self.batches[lane / LANES].take_impact(lane % LANES, starts.batch(), from);
        self.cell[lane] = cell;
        self.begun[lane] = self.round;
        true
    }

    fn take(&mut self, lane: usize, from: usize) {
        let state = self.batches[from / LANES].impact_state(from % LANES);
        self.batches[lane / LANES].set_impact(lane % LANES, state.phase(), state.velocity());
    }
}

#[cfg(test)]
mod tests {
    use super::super::starts::Share;
    use super::super::{ATTACHED, Axis, Grid};
    use super::*;
    use crate::flight::platform::vibration::Vibration;
    use crate::run::Unobserved;

    fn compared(axial_forcing: f64, restitution: f64, cells: usize, max_impacts: u32) -> [usize; 4] {
        let map = ImpactMap::new(Vibration::from_axial_forcing(axial_forcing).expect("legal"), restitution)
            .expect("legal");
        let orbit = map
            .settled_orbit(
                ImpactState::from_normalised(0.8, 1.3).expect("legal"),
                4_000,
                16,
                1e-8,
                &Unobserved,
            )
            .expect("no failure");
        let known: Vec<_> = orbit
            .and_then(|orbit| orbit.trapping_radius(&map, 64, &Unobserved).ok().map(|radius| (orbit, radius)))
            .into_iter()
            // The same orbit again with a wider radius: the first orbit that captures a start decides its
            // label.
            .flat_map(|(orbit, radius)| {
                [radius, 1.5 * radius].map(|radius| KnownOrbit::new(orbit.clone(), radius).expect("legal"))
            })
            .collect();
        let settings = BasinSettings { max_impacts, policy: ChatterPolicy::Complete };
        let grid =
            Grid::new(Axis::new(0.0, 1.0, cells).expect("legal"), Axis::new(0.0, 3.0, cells).expect("legal"))
                .expect("legal");
        let basins = map.basins(grid, &known, settings, &Unobserved).expect("no failure");
        let mut counts = [0; 4];
        for row in 0..cells {
            for (column, &label) in basins.row(row).iter().enumerate() {
                let start = ImpactState::from_normalised(grid.impact_angle(column), grid.speed().centre(row))
                    .expect("legal");
                let expected = map.basin_label(start, &known, settings).expect("no failure");
                assert_eq!(label, expected, "Gamma {axial_forcing}: {start:?}");
                counts[usize::from(label).min(3)] += 1;
            }
        }
        counts
    }

    /// The bound of data/performance/README.md on the memory of a thread.
    #[test]
    fn lanes_take_less_than_512_kibibytes() {
        let (started, share) = ((BATCHES + 1) * LANES, size_of::<Share<'_>>() + 2 * size_of::<usize>());
        let lanes = (BATCHES + 1) * size_of::<Batch>() + size_of::<FlightScheduler>() + started * share;
        assert!(lanes < 512 << 10, "{lanes}");
    }

    #[test]
    fn lockstep_labels_are_those_of_single_orbits() {
        for (axial_forcing, restitution) in
            [(0.2, 0.5), (0.34, 0.5), (0.5, 0.5), (0.55, 0.5), (0.6, 0.5), (2.0, 0.8)]
        {
            let counts = compared(axial_forcing, restitution, 150, 300);
            assert!(counts[usize::from(ATTACHED)] > 0, "Gamma {axial_forcing}: {counts:?}");
        }
    }

    #[test]
    fn starts_are_given_up_after_the_same_number_of_impacts() {
        for max_impacts in [0, 1, 2, 7] {
            let counts = compared(0.5, 0.5, 120, max_impacts);
            assert!(counts[usize::from(UNDECIDED)] > 0, "{max_impacts}: {counts:?}");
        }
    }
}
