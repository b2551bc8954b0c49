//! Rotors on one vertical motion of a stator that moves in any way, each with an engine of its own: the first
//! one decides when a window ends. Where a sine and a contact that takes time allow it, they go from release
//! to release [together](Tapped).

use std::f64::consts::TAU;
use std::ops::RangeInclusive;

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::run::WorkCount;
use bouncing_disk_core::{ChatterPolicy, Phase};

use crate::error::Error;
use crate::motion::energy::EnergyLedger;
use crate::motion::event::Event;
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motor::operation::carrier::{CarriedEngine, Carrier, Left};
use crate::motor::operation::tapped::Tapped;
use crate::motor::operation::window::{AxialWindow, RotorWindow, Window};
use crate::motor::rotor::transient::FLIGHTS_OF_EVENT;
use crate::stator::StatorLedger;

/// All rotors of a member.
#[derive(Debug)]
pub(crate) struct Driven {
    rotors: Vec<Rotor>,
    /// The end of the last window.
    reached: PhaseTime,
    tapped: Option<Tapped>,
}

/// A rotor, and what it has done since its start.
#[derive(Debug)]
struct Rotor {
    engine: CarriedEngine,
    takes_time: bool,
    generator: SplitMix64,
    perturbation: f64,
    ledger: EnergyLedger,
    stator: StatorLedger,
    /// Energy given by the perturbations.
    given: f64,
    impacts: u64,
    /// Impacts, and what of the events of a contact that takes time recurs without an impact.
    recurrences: u64,
    /// At the end of the last window.
    before: Totals,
}

/// What a rotor has done up to a time.
#[derive(Debug, Clone, Copy, Default)]
struct Totals {
    ledger: EnergyLedger,
    stator: StatorLedger,
    given: f64,
    impacts: u64,
    axial_energy: f64,
    angle: f64,
    angular_speed: f64,
}

impl Driven {
    /// Rotors that lie on the stator at `phase` with these angular speeds, perturbed by numbers of one `seed`.
    pub(crate) fn new<'a>(
        starts: impl Iterator<Item = (&'a Carrier, f64)>,
        phase: Phase,
        (perturbation, seed): (f64, u64),
    ) -> Result<Self, Error> {
        let reached = PhaseTime::in_first_period(phase);
        let starts: Vec<_> = starts.collect();
        let driven: Option<Vec<_>> = starts.iter().map(|&(carrier, _)| carrier.driven()).collect();
        let tapped = driven.and_then(|systems| Tapped::new(systems.into_iter()));
        let rotors = starts.into_iter().map(|(carrier, angular_speed)| {
            let mut rotor = Rotor {
                engine: carrier.start(phase, angular_speed, ChatterPolicy::Complete)?,
                takes_time: carrier.takes_time(),
                generator: SplitMix64::new(seed),
                perturbation,
                ledger: EnergyLedger::default(),
                stator: StatorLedger::default(),
                given: 0.0,
                impacts: 0,
                recurrences: 0,
                before: Totals::default(),
            };
            rotor.before = rotor.totals(&reached);
            Ok(rotor)
        });
        Ok(Self { rotors: rotors.collect::<Result<_, Error>>()?, reached, tapped })
    }

    /// A rotor goes on from where another one was left, as all that do at the same time.
    pub(crate) fn resume(&mut self, place: usize, carrier: &Carrier, left: &Left) -> Result<(), Error> {
        if let Some(engine) = carrier.resume(left)? {
            self.reached = left.time;
            let rotor = &mut self.rotors[place];
            rotor.engine = engine;
            rotor.before = rotor.totals(&self.reached);
        }
        Ok(())
    }

    /// Where a rotor is at the end of the last window, on a stator that yields.
    pub(crate) fn left(&self, place: usize) -> Option<Left> {
        self.rotors[place].engine.left_at(self.reached)
    }

    /// Whether the stator never throws the rotors up.
    pub(crate) fn lies_for_ever(&self) -> bool {
        self.rotors.iter().all(|rotor| rotor.engine.lies_for_ever())
    }

    /// The next window, as for a sine; rotors that come to rest for ever have periods in place of impacts.
    pub(crate) fn next_window(
        &mut self,
        duration: f64,
        impacts: RangeInclusive<u64>,
        work: &mut WorkCount<'_>,
    ) -> Result<Window, Error> {
        let Some(mut tapped) = self.tapped.take() else {
            return self.general_window(duration, &impacts, true, work);
        };
        let from = self.reached;
        let end = from.after(PhaseSpan::from_radians(duration));
        let rotors = vec![RotorWindow::default(); self.rotors.len()];
        let mut window = Window { axial: AxialWindow::default(), rotors };
        if !tapped.begun && !self.rotors[0].engine.launches() {
            // The first contact.
            window.add(&self.general_window(0.0, &(0..=0), false, work)?);
        }
        loop {
            if !tapped.begun {
                // From where the engines are.
                let Some(launch) = self.rotors[0].engine.driven().and_then(|engine| engine.flight()) else {
                    let done = window.axial.impacts;
                    let left =
                        impacts.start().saturating_sub(done)..=impacts.end().saturating_sub(done).max(1);
                    let rest = end.since(&self.reached).radians();
                    window.add(&self.general_window(rest, &left, true, work)?);
                    return Ok(window);
                };
                tapped.begin(
                    self.reached,
                    launch,
                    self.rotors.iter().map(|rotor| rotor.before.angular_speed),
                );
            }
            let leader = &mut self.rotors[0];
            let going = |time: &PhaseTime, done: u64| {
                (time.order(&end).is_lt() || done < *impacts.start()) && done < *impacts.end()
            };
            let decided =
                tapped.run(&mut window, going, || leader.perturbation * leader.generator.unit(), work)?;
            window.axial.duration = tapped.time.since(&from).radians();
            self.reached = tapped.time;
            if decided {
                self.tapped = Some(tapped);
                return Ok(window);
            }
            // One tap by the engines.
            for (rotor, speed) in self.rotors.iter_mut().zip(tapped.speeds()) {
                if let Some(engine) = rotor.engine.driven() {
                    engine.fly_from(tapped.time, tapped.launch, speed);
                }
                rotor.before = rotor.totals(&self.reached);
            }
            tapped.begun = false;
            window.add(&self.general_window(0.0, &(1..=1), false, work)?);
        }
    }

    /// The next window by the engines; `anywhere`: a contact that takes time may be its end.
    fn general_window(
        &mut self,
        duration: f64,
        impacts: &RangeInclusive<u64>,
        anywhere: bool,
        work: &mut WorkCount<'_>,
    ) -> Result<Window, Error> {
        let from = self.reached;
        let (mut window, mut lies) = (Window::default(), false);
        for (index, rotor) in self.rotors.iter_mut().enumerate() {
            if index == 0 {
                (self.reached, lies) = rotor.lead(&from, (duration, anywhere), impacts, work)?;
            } else {
                rotor.follow(&self.reached, work)?;
            }
            let (before, now) = (rotor.before, rotor.totals(&self.reached));
            let change = |of: fn(&Totals) -> f64| of(&now) - of(&before);
            let axial = || {
                let duration = self.reached.since(&from).radians();
                AxialWindow {
                    duration,
                    normal_work: change(|totals| totals.ledger.normal_work),
                    perturbation_work: change(|totals| totals.given),
                    restitution_loss: change(|totals| totals.ledger.restitution_loss),
                    energy_change: change(|totals| totals.axial_energy),
                    impacts: if lies || now.impacts == before.impacts {
                        (duration / TAU + 0.5) as u64
                    } else {
                        now.impacts - before.impacts
                    },
                }
            };
            if index == 0 {
                window.axial = axial();
            }
            let yields = rotor.engine.driven().is_none();
            window.rotors.push(RotorWindow {
                angle: change(|totals| totals.angle),
                friction_work: change(|totals| totals.ledger.friction_work),
                friction_loss: change(|totals| totals.ledger.friction_loss),
                load_work: change(|totals| totals.ledger.load_work),
                kinetic_change: 0.5
                    * change(|totals| totals.angular_speed)
                    * (now.angular_speed + before.angular_speed),
                stator: yields.then(|| (now.stator - before.stator, axial())),
            });
            rotor.before = now;
        }
        Ok(window)
    }
}

impl Rotor {
    /// Goes on until a flight begins and the window is long enough; when that is, and whether the disk lies on
    /// the stator for ever.
    fn lead(
        &mut self,
        from: &PhaseTime,
        (duration, anywhere): (f64, bool),
        impacts: &RangeInclusive<u64>,
        work: &mut WorkCount<'_>,
    ) -> Result<(PhaseTime, bool), Error> {
        let end = from.after(PhaseSpan::from_radians(duration));
        let before = self.recurrences;
        let yields = self.engine.driven().is_none();
        let anywhere = anywhere && (self.takes_time || yields);
        let impacts_before = self.impacts;
        loop {
            let (now, done) = (self.engine.time(), self.recurrences - before);
            // A rotor that lies on a stator that yields has events of friction only, or none.
            let lies = yields && self.impacts == impacts_before;
            let lasts = now.order(&end).is_ge() && (lies || done >= *impacts.start());
            if (lasts || done >= *impacts.end()) && (anywhere || self.engine.launches()) {
                return Ok((now, false));
            }
            if self.engine.lies_for_ever() {
                let periods = ((duration / TAU) as u64).saturating_add(1).min(*impacts.end());
                let end = from.after(PhaseSpan { periods, remainder: 0.0 });
                self.follow(&end, work)?;
                return Ok((end, true));
            }
            self.advance(f64::INFINITY, work)?;
        }
    }

    /// Goes on to this time.
    fn follow(&mut self, to: &PhaseTime, work: &mut WorkCount<'_>) -> Result<(), Error> {
        while self.advance(to.since(&self.engine.time()).radians(), work)? {}
        if self.engine.lies() {
            let (ledger, stator) = self.engine.pause(to.since(&self.engine.time()).radians());
            self.ledger += ledger;
            self.stator += stator;
        }
        Ok(())
    }

    /// The next event within `limit`, if there is one.
    fn advance(&mut self, limit: f64, work: &mut WorkCount<'_>) -> Result<bool, Error> {
        work.spend(FLIGHTS_OF_EVENT)?;
        let Some((event, ledger, stator)) = self.engine.advance_within(limit)? else { return Ok(false) };
        self.ledger += ledger;
        self.stator += stator;
        match event {
            Event::Impact { .. } | Event::Kick { .. } | Event::Recontact => {
                self.impacts += 1;
                self.recurrences += 1;
            }
            Event::Turn => self.recurrences += 1,
            Event::SlipToStick | Event::SlipReversal(_) if self.engine.driven().is_none() => {
                self.recurrences += 1
            }
            _ => {}
        }
        if event.is_relaunch() {
            let speed = self.perturbation * self.generator.unit();
            let before = self.engine.disk().axial_velocity;
            self.engine.perturb_launch(speed);
            let after = self.engine.disk().axial_velocity;
            self.given += 0.5 * (after - before) * (after + before);
        }
        Ok(true)
    }

    /// At a time before the next event.
    fn totals(&self, at: &PhaseTime) -> Totals {
        let span = at.since(&self.engine.time()).radians();
        let state = self.engine.disk_after(span);
        let (mut ledger, mut stator) = self.engine.ledgers_after(span);
        ledger += self.ledger;
        stator += self.stator;
        Totals {
            ledger,
            stator,
            given: self.given,
            impacts: self.impacts,
            axial_energy: 0.5 * state.axial_velocity * state.axial_velocity
                + state.height
                + self.engine.spring_energy(span, &state),
            angle: state.angle,
            angular_speed: state.angular_speed,
        }
    }
}

#[cfg(test)]
mod tests {
    use bouncing_disk_core::run::Watch;
    use bouncing_disk_core::{Drive, Unobserved};

    use super::*;
    use crate::driven::DrivenSystem;
    use crate::motion::phase_time::phase_at;

    /// Rotors that come down through the platform's largest speed, where the engine takes over and hands back: in
    /// the regular motion of one tap in each period windows are those of engines alone.
    #[test]
    fn windows_with_taps_are_those_of_the_engine() {
        let (peak, twist) = (197.4, 4.27e5);
        let systems = [0.0, 0.2].map(|load| {
            let drive = |size: f64, angle: f64| Drive::fourier(&[(size, angle)]).expect("legal");
            let (height, angle) = (drive(peak, 0.0), drive(twist, -1.0));
            let rigid =
                DrivenSystem { height, angle, friction: 1.0, restitution: 0.5, load, compliance: None };
            Carrier::Driven(rigid.with_contact_time(TAU).expect("legal"))
        });
        let speeds = [twist + 20.0, -twist - 20.0, twist + 5.0, 0.3 * twist];
        let starts = || systems.iter().flat_map(|system| [(system, 0.0); 2]);
        let member = || Driven::new(starts(), phase_at(0.3), (1e-3, 5)).expect("legal");
        let (mut fast, mut slow) = (member(), member());
        let watch = Watch::begin(&Unobserved, 0, u64::MAX).expect("not stopped");
        fast.next_window(0.0, 2000..=2000, &mut watch.work()).expect("no failure");
        let tapped = fast.tapped.as_mut().expect("taps");
        tapped.begin(tapped.time, tapped.launch, speeds.into_iter());
        slow.reached = fast.reached;
        for (rotor, speed) in slow.rotors.iter_mut().zip(speeds) {
            let engine = rotor.engine.driven().expect("no stator that yields");
            engine.fly_from(tapped.time, tapped.launch, speed);
            (rotor.generator, rotor.before) = (fast.rotors[0].generator, rotor.totals(&slow.reached));
        }
        for _ in 0..3 {
            let own = fast.next_window(200.0, 10..=1000, &mut watch.work()).expect("no failure");
            let known =
                slow.general_window(200.0, &(10..=1000), false, &mut watch.work()).expect("no failure");
            assert!(own.axial.impacts == known.axial.impacts && own.axial.impacts > 30, "{own:?}");
            let near = |of: &dyn Fn(&Window) -> f64, size: f64| {
                assert!((of(&own) - of(&known)).abs() < 1e-9 * size, "{size} {own:?} {known:?}");
            };
            let loss = known.axial.restitution_loss;
            near(&|window| window.axial.duration, known.axial.duration);
            near(&|window| window.axial.normal_work, loss);
            near(&|window| window.axial.restitution_loss, loss);
            near(&|window| window.axial.energy_change, loss);
            near(&|window| window.axial.perturbation_work, loss);
            let size = twist * known.axial.duration;
            for index in 0..speeds.len() {
                near(&|window| window.rotors[index].angle, size);
                near(&|window| window.rotors[index].friction_work, size);
                near(&|window| window.rotors[index].friction_loss, size);
                near(&|window| window.rotors[index].load_work, size);
                near(&|window| window.rotors[index].kinetic_change, size);
            }
        }
        let tapped = fast.tapped.expect("taps");
        assert!(
            tapped.speeds().all(|speed| speed.abs() < twist),
            "{:?}",
            tapped.speeds().collect::<Vec<_>>()
        );
    }
}
