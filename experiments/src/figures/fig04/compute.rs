//! The computation of Fig. 4.

use bouncing_disk::InitialSpin;

use super::consistency::consistency;
use super::data::{self, Fig04Data};
use super::sweep;
use crate::claims::paper;
use crate::experiment::{ExperimentError, Quality};
use crate::figures::toss_case::TossCase;
use crate::progress::Progress;

pub(super) fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig04Data, ExperimentError> {
    let count = quality.choose(61, 481);
    progress.start(6, "parts");
    let done = || progress.advance(1);
    let table_i = paper::table_one()?;
    let printed = paper::section_three()?;
    let table = TossCase::from(&table_i);
    let angles = sweep::angles(&table, count);
    let rest = InitialSpin::AbsoluteRest;
    let families = sweep::INITIAL_STATES
        .into_iter()
        .map(|initial| sweep::family(&table, initial, &angles))
        .collect::<Result<Vec<_>, _>>()?;
    done();
    let separation = sweep::separation(&table, count)?;
    done();
    let friction_curves = printed
        .frictions_of_fig4e
        .iter()
        .map(|friction| sweep::friction_curve(&table, *friction, &angles))
        .collect::<Result<Vec<_>, _>>()?;
    let low_friction = sweep::low_friction(&table)?;
    done();
    let best = sweep::INITIAL_STATES
        .into_iter()
        .map(|initial| sweep::best(&table, initial))
        .collect::<Result<Vec<_>, _>>()?;
    done();
    let fastest = sweep::best_angle(&table, rest, sweep::speed)?;
    let toss = table.at_angle(fastest.amplitude_angle_rad).toss(rest)?;
    let kept = toss.energy.platform_work() - toss.energy.friction_loss;
    done();
    let consistency = consistency(&table_i, &printed, count)?;
    done();
    Ok(Fig04Data {
        largest_amplitude_angle_rad: table.largest_angle(),
        table_i_toss: data::TossPoint::new(&table, &table.toss(rest)?),
        lossless_efficiency_of_fastest: toss.rotary_energy_gain / kept,
        amplitude_angle_rad: angles,
        families,
        separation,
        friction_curves,
        low_friction,
        best,
        held_to_separation_angle_rad: sweep::held_to_separation(&table),
        compromise: sweep::compromise(&table)?,
        consistency,
        table_i,
        printed,
    })
}
