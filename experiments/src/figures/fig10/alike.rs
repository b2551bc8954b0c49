//! Single orbits of motors that print alike, and what is said of them.

use bouncing_disk::core::chaos::LyapunovEstimate;
use bouncing_disk::core::numerics::elementary::ln;
use bouncing_disk::core::{ChatterPolicy, ImpactState, Launch, OrbitEvent};
use glam::DVec2;
use serde::Serialize;

use crate::claims::{Cases, Claim, all};
use crate::experiment::ExperimentError;
use crate::figures::shared::alike::{AlikeMotor, PrintedInputs, SpeedBand, alike_groups};
use crate::figures::shared::map_in_parallel;
use crate::figures::shared::motor::{LOW_PERIOD_FLIGHTS, MotorCase, by_definition_words, by_each_definition};
use crate::figures::shared::numbers::median;

/// Duration of the transients that verdicts are taken over, in rise times.
const JUDGED_RISES: f64 = 6.0;
/// Impacts after which a motor that has not come to rest is no longer followed.
const LONGEST_FLIGHTS: u64 = 20_000;

/// The growth of a small perturbation of a motor's vertical motion between two rests.
#[derive(Serialize)]
pub(super) struct BetweenRests {
    pub(super) amplitude_m: f64,
    /// How many motors it grows in for certain, by the measure of a chaotic attractor.
    pub(super) grows: Cases,
    /// Medians over these motors: impacts from the separation to the next rest, and mean logarithmic growth
    /// per impact.
    pub(super) impacts: Option<f64>,
    pub(super) growth_per_impact: Option<f64>,
}

/// Motors whose inputs all print like the paper's: the same draws at the three amplitudes.
#[derive(Serialize)]
pub(super) struct Alike {
    /// The ranges drawn from.
    pub(super) inputs: String,
    /// By amplitude, then by draw.
    pub(super) motors: Vec<Vec<AlikeMotor>>,
    /// The middle nine tenths of their speeds, by amplitude.
    pub(super) bands: Vec<SpeedBand>,
    pub(super) between_rests: Vec<BetweenRests>,
}

impl Alike {
    /// The motors of Table III at the three amplitudes, with the g drawn that is not printed.
    pub(super) fn drawn(inputs: PrintedInputs, count: usize, seed: u64) -> Result<Self, ExperimentError> {
        let drawn = |key| Ok::<_, ExperimentError>(inputs.amplitude(key)?.drawn(count, seed));
        let cases = [
            drawn("section5.smallest_amplitude_of_fig10")?,
            drawn("section5.middle_amplitude_of_fig10")?,
            drawn("section5.largest_amplitude_of_fig10")?,
        ];
        let (motors, bands): (Vec<_>, Vec<_>) = alike_groups(&cases, JUDGED_RISES)?.into_iter().unzip();
        let between_rests = cases.iter().map(|cases| between_rests(cases)).collect::<Result<Vec<_>, _>>()?;
        Ok(Self { inputs: inputs.words(), motors, bands, between_rests })
    }

    /// The three motors of each draw.
    pub(super) fn draws(&self) -> impl Iterator<Item = [&AlikeMotor; 3]> {
        let count = self.motors.iter().map(Vec::len).min().unwrap_or(0);
        (0..count).map(|index| [0, 1, 2].map(|amplitude| &self.motors[amplitude][index]))
    }
}

/// The growth of a small perturbation from the separation to the next rest, as the mean of its logarithm per
/// impact. A rest ends it: every motor leaves the stator at the same phase again.
fn growth(motor: &MotorCase) -> Result<Option<LyapunovEstimate>, ExperimentError> {
    let map = *motor.system()?.dimensionless().map();
    let Some(leaves) = map.vibration().separation_phase() else { return Ok(None) };
    let mut orbit = map.orbit_from_launch(Launch::new(leaves, 0.0)?, ChatterPolicy::Complete);
    let mut state: Option<ImpactState> = None;
    let (mut perturbation, mut logarithm, mut impacts) = (DVec2::Y, 0.0, 0);
    while impacts < LONGEST_FLIGHTS {
        let Some(OrbitEvent::Impact(impact)) = orbit.advance()? else { break };
        if let Some(state) = state {
            perturbation = map.step_with_derivative(state)?.1 * perturbation;
            let length = perturbation.length();
            logarithm += ln(length);
            perturbation /= length;
            impacts += 1;
        }
        state = Some(impact.into());
    }
    Ok((impacts > 0).then(|| LyapunovEstimate {
        exponent: logarithm / impacts as f64,
        standard_error: 0.0,
        impacts,
    }))
}

fn between_rests(cases: &[MotorCase]) -> Result<BetweenRests, ExperimentError> {
    let growths: Vec<_> = map_in_parallel(cases, growth)?.into_iter().flatten().collect();
    let growing = || growths.iter().filter(|growth| growth.grows());
    Ok(BetweenRests {
        amplitude_m: cases.first().map_or(f64::NAN, |case| case.amplitude_m),
        grows: Cases { holding: growing().count(), tried: cases.len() },
        impacts: median(growing().map(|growth| growth.impacts as f64)),
        growth_per_impact: median(growing().map(|growth| growth.exponent)),
    })
}

pub(super) fn long_period(alike: &Alike) -> Claim {
    let by_draw =
        |most| Cases::of(alike.draws().map(|draw| draw.into_iter().all(|motor| !motor.cycle.is_low(most))));
    let shares = by_each_definition(by_draw);
    Claim::printed_statement(
        "section5.long_period_chattering",
        by_draw(LOW_PERIOD_FLIGHTS),
        format!("by the most flights of a low period: {}", by_definition_words(&shares)),
    )
    .by_shares(&shares)
}

/// Chaos that a rest ends.
pub(super) fn transient_chaos(alike: &Alike) -> Claim {
    let between = &alike.between_rests;
    let words = between.iter().map(|of| {
        format!(
            "{:e} m: in {} of {}, e^{:.1} an impact",
            of.amplitude_m,
            of.grows.holding,
            of.grows.tried,
            of.growth_per_impact.unwrap_or(f64::NAN),
        )
    });
    Claim::printed_statement(
        "section5.transient_chaos",
        between.iter().map(|of| of.grows).sum::<Cases>(),
        format!("a small perturbation grows between two rests, at {}", words.collect::<Vec<_>>().join("; ")),
    )
}

/// Motors of long period must oscillate more than the middle one of those of low period at their amplitude.
pub(super) fn long_period_oscillates(alike: &Alike) -> Claim {
    let middles = |most: usize| {
        [0, 1, 2].map(|amplitude| &alike.motors[amplitude]).map(|motors| {
            let low = motors.iter().filter(|motor| motor.cycle.is_low(most));
            // A comparison with NaN fails.
            median(low.map(|motor| motor.oscillation)).unwrap_or(f64::NAN)
        })
    };
    let by_draw = |most: usize| {
        let middles = middles(most);
        let draws = alike.draws().filter_map(|draw| {
            let long = draw.into_iter().zip(middles).filter(|(motor, _)| !motor.cycle.is_low(most));
            all(long, |(motor, middle)| motor.oscillation > middle)
        });
        Cases::of(draws)
    };
    let shares = by_each_definition(by_draw);
    Claim::printed_statement(
        "section5.oscillation_from_long_period",
        by_draw(LOW_PERIOD_FLIGHTS),
        format!(
            "at every A of long period the speed varies more than in the middle motor of low period; {}",
            by_definition_words(&shares),
        ),
    )
    .by_shares(&shares)
}
