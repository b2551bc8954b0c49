//! The engine under laws of restitution that depend on the speed.

use bouncing_disk_core::Phase;
use bouncing_disk_core::map::KuwabaraKono;
use bouncing_disk_core::numerics::elementary::pow;
use proptest::prelude::*;

use super::*;
use crate::motion::PAPER_CUT;
use crate::parameters::dimensionless::ForcingParameters;
use crate::testing;

/// Rounding of a ledger's closure relative to the magnitudes of its terms.
const CLOSURE: f64 = 1.0e-13;

const FORCING: ForcingParameters =
    ForcingParameters { axial_forcing: 0.45, angular_forcing: 2.0, phase_lag: 0.2, restitution: 0.5 };

/// A user's law, unknown to the library: one restitution up to a speed, another from there on.
#[derive(Debug, Clone, Copy)]
struct Brittle {
    restitution: f64,
    breaks_at: f64,
    then: f64,
}

impl Brittle {
    /// Constant at all speeds.
    const fn never(restitution: f64) -> Self {
        Self { restitution, breaks_at: f64::INFINITY, then: f64::NAN }
    }
}

impl RestitutionLaw for Brittle {
    fn restitution(&self, impact_speed: f64) -> f64 {
        if impact_speed < self.breaks_at { self.restitution } else { self.then }
    }
    fn derivative(&self, _: f64) -> f64 {
        0.0
    }
}

fn law() -> impl Strategy<Value = KuwabaraKono> {
    (0.05..0.95_f64, testing::log_uniform(1e-3, 1e3))
        .prop_map(|(restitution, speed)| KuwabaraKono::new(restitution, speed).unwrap())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, ..ProptestConfig::default() })]

    /// Energy is balanced in every event and in total; the loss in restitution and the axial impulse follow the
    /// law at the speed of the impact, and friction stays within the cone of that impulse.
    #[test]
    fn every_ledger_closes_under_a_law((system, start, _) in testing::motion(), law in law()) {
        let engine = Engine::with_law(system, law, start, PAPER_CUT).unwrap();
        let mut total = EnergyLedger::default();
        for record in engine.take(100) {
            let record = record.unwrap();
            let ledger = &record.ledger;
            prop_assert!(ledger.relative_closure() <= CLOSURE, "{:e} {record:?}", ledger.relative_closure());
            prop_assert!(ledger.restitution_loss >= 0.0);
            total += *ledger;
            let Event::Impact { axial_impact_velocity, capped, .. } = record.event else { continue };
            let speed = -axial_impact_velocity;
            let restitution = law.restitution(speed);
            let impulse = (1.0 + restitution) * speed;
            let rebound = restitution * speed;
            let lost = 0.5 * (speed * speed - rebound * rebound);
            // If a cut puts the disk on a platform that falls away, it also removes the rebound.
            let taken = record.axial_impulse < impulse * (1.0 - 1e-14);
            let (impulse, lost) = if taken { (speed, 0.5 * speed * speed) } else { (impulse, lost) };
            prop_assert!((record.axial_impulse - impulse).abs() <= 1e-14 * impulse, "{record:?}");
            prop_assert!((ledger.restitution_loss - lost).abs() <= 4e-15 * speed * speed, "{record:?}");
            let cone = system.friction() * (1.0 + restitution) * speed;
            prop_assert!(record.angular_impulse.abs() <= cone * (1.0 + 1e-14));
            prop_assert!(capped || (record.angular_impulse.abs() - cone).abs() <= 1e-14 * cone);
        }
        prop_assert!(total.relative_closure() <= 1e-10, "{:e}", total.relative_closure());
    }

    /// The vertical motion agrees with the map under the law, bit for bit.
    #[test]
    fn engine_and_map_agree_under_a_law(
        (system, _, _) in testing::motion(), law in law(), phase in testing::phase(), speed in 0.01..3.0_f64,
    ) {
        let map = ImpactMap::with_law(*system.vibration(), law);
        let launch = Launch::new(phase, speed).unwrap();
        let mut orbit = map.orbit_from_launch(launch, ChatterPolicy::Cut(PAPER_CUT));
        let start = InitialCondition::Launch { phase, relative_speed: speed, angular_speed: 0.3 };
        for record in Engine::with_law(system, law, start, PAPER_CUT).unwrap().take(300) {
            let Ok(record) = record else {
                prop_assert_eq!(record.is_err(), orbit.advance().is_err());
                break;
            };
            match record.event {
                Event::Impact { axial_impact_velocity, .. } => {
                    let Ok(Some(OrbitEvent::Impact(impact))) = orbit.advance() else { panic!("{record:?}") };
                    prop_assert_eq!(impact.phase, record.time.phase);
                    prop_assert_eq!(impact.velocity.to_bits(), axial_impact_velocity.to_bits());
                }
                Event::Attachment { error_bound, .. } => {
                    let Ok(Some(OrbitEvent::Attachment(rest))) = orbit.advance() else { panic!("{record:?}") };
                    prop_assert_eq!(rest.accumulation.error_bound.to_bits(), error_bound.to_bits());
                    prop_assert_eq!(rest.accumulation.phase, record.time.phase);
                }
                _ => {}
            }
        }
    }

    /// A law that is constant, but not known to be so, produces the same records as the system's own constant.
    #[test]
    fn a_constant_law_gives_the_bits_of_the_systems_restitution((system, start, _) in testing::motion()) {
        let policy = ChatterPolicy::Cut(PAPER_CUT);
        let own = Engine::new(system, start, policy).unwrap().take(100);
        let law = Brittle::never(system.restitution());
        let by_law = Engine::with_law(system, law, start, PAPER_CUT).unwrap().take(100);
        prop_assert_eq!(own.collect::<Vec<_>>(), by_law.collect::<Vec<_>>());
    }
}

fn lively() -> DimensionlessSystem {
    FORCING.build().unwrap()
}

fn lying() -> InitialCondition {
    InitialCondition::Contact { phase: Phase::new(4.0).unwrap(), angular_speed: 0.0 }
}

/// A finer cut moves the attachment by no more than the error of the coarser one.
#[test]
fn the_error_of_a_cut_covers_a_finer_one() {
    let law = KuwabaraKono::new(0.1, 1.0).unwrap();
    let attachment = |speed: f64| {
        let cut = ChatterCut::new(speed, 0.0, 1).unwrap();
        let engine = Engine::with_law(lively(), law, lying(), cut).unwrap();
        let record = engine
            .map(Result::unwrap)
            .take(100_000)
            .find(|record| matches!(record.event, Event::Attachment { .. }))
            .unwrap();
        let Event::Attachment { error_bound, .. } = record.event else { panic!("{record:?}") };
        (record.time, error_bound)
    };
    let (mut last, mut bound) = attachment(1e-2);
    for exponent in 3..9 {
        let (time, finer) = attachment(pow(10.0, -f64::from(exponent)));
        let moved = time.since(&last).radians();
        assert!(moved > 0.0 && moved <= bound && finer < bound, "{moved} {bound} {finer}");
        // The remainder is the finer cut's own error.
        assert!(moved + finer >= 0.5 * bound, "{moved} {bound} {finer}");
        (last, bound) = (time, finer);
    }
}

#[test]
fn an_illegal_restitution_is_the_last_thing_that_an_engine_tells() {
    for then in [f64::NAN, -0.5, 1.5, f64::INFINITY] {
        let law = Brittle { restitution: 0.5, breaks_at: 1.0, then };
        let start = InitialCondition::Flight {
            phase: Phase::new(0.0).unwrap(),
            gap: 50.0,
            relative_velocity: 0.0,
            angular_speed: 0.0,
        };
        let mut engine = Engine::with_law(lively(), law, start, PAPER_CUT).unwrap();
        let Err(Error::Core(bouncing_disk_core::Error::IllegalRestitution { restitution, impact_speed })) =
            engine.advance()
        else {
            panic!("{then} was taken")
        };
        assert!(restitution.to_bits() == then.to_bits() && impact_speed > 1.0);
        assert_eq!(engine.advance(), Ok(None));
    }
}

/// The law is never evaluated for a disk that never leaves the platform.
#[test]
fn a_disk_that_rests_for_ever_needs_no_law() {
    let system = ForcingParameters { axial_forcing: 0.2, ..FORCING }.build().unwrap();
    let law = Brittle { restitution: 0.5, breaks_at: 0.0, then: f64::NAN };
    let engine = Engine::with_law(system, law, lying(), PAPER_CUT).unwrap();
    assert!(engine.take(20).all(|record| record.is_ok()));
}
