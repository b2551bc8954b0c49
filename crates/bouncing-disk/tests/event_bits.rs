//! Digests of every number in the records of events: on the sine, on drives with rigid and with compliant
//! contacts, and on compliant stators. A rewritten engine must give the same bits.

use bouncing_disk::core::map::KuwabaraKono;
use bouncing_disk::core::numerics::digest::Digest;
use bouncing_disk::core::numerics::random::SplitMix64;
use bouncing_disk::core::{ChatterCut, ChatterPolicy, Phase};
use bouncing_disk::driven::{DrivenEngine, DrivenSystem};
use bouncing_disk::motion::{PAPER_CHATTER, PAPER_CUT, PhaseSpan};
use bouncing_disk::parameters::{DimensionlessParameters, DimensionlessSystem, DrivenPlatform, Waveform};
use bouncing_disk::stator::{LoadLine, StatorEngine, StatorSystem, YieldingMode};
use bouncing_disk::{Engine, Error, InitialCondition, System};

/// Adds each number, to the last bit, and each name.
fn add(digest: &mut Digest, value: &impl std::fmt::Debug) {
    digest.bytes(format!("{value:?}").as_bytes());
}

struct Draw(SplitMix64);

impl Draw {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.unit()
    }

    fn of<T: Copy>(&mut self, all: &[T]) -> T {
        all[(self.0.unit() * all.len() as f64) as usize % all.len()]
    }

    fn system(&mut self) -> Result<DimensionlessSystem, Error> {
        DimensionlessParameters {
            peak_acceleration: self.of(&[0.0, 0.5, 1.0, 1.2, 2.0, 3.7, 20.0]),
            twist_speed: self.of(&[0.0, 0.1, 1.0, 3.0, 30.0]),
            phase_lag: self.of(&[0.0, 0.2, -1.0, 2.5]),
            friction: self.of(&[0.0, 0.1, 0.5, 1.3]),
            restitution: self.of(&[0.0, 0.1, 0.5, 0.8, 0.99]),
            load: self.of(&[0.0, 0.0, 0.05, -0.3, 0.6]),
        }
        .build()
    }

    fn start(&mut self) -> Result<InitialCondition, Error> {
        let phase = Phase::new(self.between(0.0, std::f64::consts::TAU))?;
        let angular_speed = self.of(&[0.0, 0.7, -2.0]);
        Ok(match self.of(&[0, 1, 2]) {
            0 => InitialCondition::Contact { phase, angular_speed },
            1 => {
                let relative_speed = self.between(0.01, 2.0);
                InitialCondition::Launch { phase, relative_speed, angular_speed }
            }
            _ => {
                let (gap, relative_velocity) = (self.between(0.01, 5.0), self.between(-1.0, 1.0));
                InitialCondition::Flight { phase, gap, relative_velocity, angular_speed }
            }
        })
    }

    fn policy(&mut self) -> Result<ChatterPolicy, Error> {
        let short = ChatterPolicy::Cut(ChatterCut::new(1e-3, 0.05, 3)?);
        Ok(self.of(&[ChatterPolicy::Complete, PAPER_CHATTER, short]))
    }
}

#[test]
fn events_on_the_sine_are_the_recorded_ones() -> Result<(), Error> {
    let (mut draw, mut digest, mut events) = (Draw(SplitMix64::new(1)), Digest::new(), 0);
    for _ in 0..1_500 {
        let (system, start, policy) = (draw.system()?, draw.start()?, draw.policy()?);
        let mut engine = match Engine::new(system, start, policy) {
            Ok(engine) => engine,
            Err(error) => {
                add(&mut digest, &error);
                continue;
            }
        };
        for _ in 0..60 {
            let span = PhaseSpan::from_radians(0.3);
            add(&mut digest, &(engine.time(), engine.state(), engine.launches()));
            add(&mut digest, &(engine.state_after(span), engine.ledger_after(span)));
            if engine.launches() && draw.of(&[true, false, false, false]) {
                engine.perturb_launch(draw.between(0.0, 0.1))?;
            }
            let next = engine.advance();
            add(&mut digest, &next);
            if !matches!(next, Ok(Some(_))) {
                break;
            }
            events += 1;
        }
        let law = KuwabaraKono::new(draw.between(0.1, 0.9), draw.between(0.01, 10.0))?;
        if let Ok(engine) = Engine::with_law(system, law, start, PAPER_CUT) {
            engine.take(40).for_each(|record| add(&mut digest, &record));
        }
    }
    assert!(events > 20_000, "{events}");
    assert_eq!(format!("{:#018x}", digest.value()), "0xc25cd71b0ea1642a");
    Ok(())
}

/// All kinds of drives, among them those with kinks.
fn driven(draw: &mut Draw) -> Result<DrivenSystem, Error> {
    if draw.of(&[true, false]) {
        return DrivenSystem::try_from(draw.system()?);
    }
    let waves = [
        Waveform::Sine,
        Waveform::Triangle,
        Waveform::Parabolas,
        Waveform::Sawtooth(0.3),
        Waveform::Sawtooth(0.8),
    ];
    let mut wave = || waves[(draw.0.unit() * 5.0) as usize % 5].clone();
    let (height, angle) = (wave(), wave());
    let toss = System::pizza_toss()
        .with_platform(|hand| hand.amplitude *= draw.of(&[0.2, 0.6, 1.0, 4.0]))?
        .with_disk(|dough| {
        dough.restitution = draw.of(&[0.0, 0.4, 0.8]);
        dough.friction = draw.of(&[0.0, 0.1, 0.6]);
    })?;
    DrivenSystem::new(&DrivenPlatform::new(*toss.platform(), height, angle)?, toss.disk())
}

fn driven_events(seed: u64, soft: bool) -> Result<(Digest, usize), Error> {
    let (mut draw, mut digest, mut events) = (Draw(SplitMix64::new(seed)), Digest::new(), 0);
    for _ in 0..400 {
        let (system, start, policy) = (driven(&mut draw)?, draw.start()?, draw.policy()?);
        let system = if soft {
            let time = draw.of(&[0.05, 0.5, 2.0, 6.0]);
            match draw.of(&[true, true, false]) {
                true => system.with_contact_time(time),
                false => system.with_hysteretic_contact(time),
            }
        } else {
            Ok(system)
        };
        let mut engine = match system.and_then(|system| DrivenEngine::new(system, start, policy)) {
            Ok(engine) => engine,
            Err(error) => {
                add(&mut digest, &error);
                continue;
            }
        };
        for event in 0..40 {
            add(&mut digest, &(engine.time(), engine.state()));
            add(&mut digest, &(engine.state_after(0.3), engine.ledger_after(0.3)));
            if event == 20 {
                let (time, state) = engine.state_after(0.01);
                match DrivenEngine::of_state(engine.system().clone(), time, state, policy) {
                    Ok(again) => engine = again,
                    Err(error) => add(&mut digest, &error),
                }
            }
            let next = engine.advance();
            add(&mut digest, &next);
            if !matches!(next, Ok(Some(_))) {
                break;
            }
            events += 1;
        }
    }
    Ok((digest, events))
}

#[test]
fn events_on_drives_are_the_recorded_ones() -> Result<(), Error> {
    let (digest, events) = driven_events(2, false)?;
    assert!(events > 5_000, "{events}");
    assert_eq!(format!("{:#018x}", digest.value()), "0x706be52dc8c09edc");
    Ok(())
}

#[test]
fn events_in_contacts_that_take_time_are_the_recorded_ones() -> Result<(), Error> {
    let (digest, events) = driven_events(3, true)?;
    assert!(events > 5_000, "{events}");
    assert_eq!(format!("{:#018x}", digest.value()), "0x6c82d382106edae4");
    Ok(())
}

#[test]
fn events_on_stators_are_the_recorded_ones() -> Result<(), Error> {
    let (mut draw, mut digest, mut events) = (Draw(SplitMix64::new(4)), Digest::new(), 0);
    for _ in 0..200 {
        let (base, start) = (draw.system()?, draw.start()?);
        let axial = YieldingMode::axial(draw.of(&[0.3, 2.0, 50.0]), draw.of(&[0.9, 1.0, 2.2]), 20.0);
        let torsional = YieldingMode::torsional(draw.of(&[0.5, 5.0]), draw.of(&[1.0, 3.1]), 50.0);
        let modes = match draw.of(&[0, 1, 2, 3]) {
            0 => vec![axial],
            1 => vec![torsional],
            2 => vec![YieldingMode { angle: 0.6, ..axial }],
            _ => vec![axial, torsional],
        };
        let contact_time = draw.of(&[None, None, Some(0.1), Some(2.0)]);
        let (below, above) = (f64::NEG_INFINITY, f64::INFINITY);
        let lines = [
            LoadLine { from: below, to: 0.5, torque: 0.0, slope: 0.02 },
            LoadLine { from: 0.5, to: above, torque: 0.01, slope: 0.0 },
        ];
        let system = StatorSystem::build(&base, &modes, 0.7, contact_time);
        let system =
            if draw.of(&[true, false]) { system.and_then(|system| system.with_load(&lines)) } else { system };
        let mut engine = match system.and_then(|system| StatorEngine::new(system, start)) {
            Ok(engine) => engine,
            Err(error) => {
                add(&mut digest, &error);
                continue;
            }
        };
        for event in 0..40 {
            add(&mut digest, &(engine.time(), engine.state(), engine.lies_for_ever()));
            add(&mut digest, &(engine.state_after(0.3), engine.ledgers_after(0.3)));
            if event == 15 {
                let system = engine.system().clone();
                add(&mut digest, &engine.switch(0.0, system));
            }
            if event == 25 {
                match StatorEngine::of_state(engine.system().clone(), engine.time(), engine.state()) {
                    Ok(again) => engine = again,
                    Err(error) => add(&mut digest, &error),
                }
            }
            let next = engine.advance();
            add(&mut digest, &next);
            if !matches!(next, Ok(Some(_))) {
                break;
            }
            events += 1;
        }
    }
    assert!(events > 3_000, "{events}");
    assert_eq!(format!("{:#018x}", digest.value()), "0x266b2f572bfd569c");
    Ok(())
}
