//! What the fits of known transients tell of fits.

use super::data::{Duration, ExtraFitData};
use crate::claim::{self, Claim};

const ID: &str = "extra-fit";
const PLACE: &str = "this work";

pub(super) fn claims(data: &ExtraFitData) -> Vec<Claim> {
    let (steady, constant) = (data.fit.steady_speed(), data.fit.time_constant());
    let accepted: usize = data.durations.iter().map(|duration| duration.accepted).sum();
    let share = |of: fn(&Duration) -> usize| {
        data.durations.iter().map(of).sum::<usize>() as f64 / accepted.max(1) as f64
    };
    let (constants, speeds) =
        (share(|duration| duration.constants_covered), share(|duration| duration.speeds_covered));
    let short = data.durations.iter().filter(|duration| duration.time_constants < 2.0);
    let long = data.durations.iter().filter(|duration| duration.time_constants > 5.0);
    vec![
        Claim::expected(
            ID,
            PLACE,
            "steady speed fitted to the synthetic transient",
            "rad/s",
            (data.steady_speed_rad_per_s, 0.5 * (steady.high - steady.low)),
            steady.value,
        )
        .note("expected: what the transient was made from; half of the 95 % interval"),
        Claim::expected(
            ID,
            PLACE,
            "time constant fitted to the synthetic transient",
            "s",
            (data.time_constant_s, 0.5 * (constant.high - constant.low)),
            constant.value,
        )
        .note("expected: what the transient was made from; half of the 95 % interval"),
        Claim::statement(
            ID,
            PLACE,
            "95 % intervals of accepted fits cover the truth in at least 90 % of the ensembles, all durations together",
            (accepted > 0).then_some(constants >= 0.9 && speeds >= 0.9),
            format!(
                "{:.1} % for the time constant and {:.1} % for the steady speed, of {accepted} accepted fits; not more than the \
                 ensembles of one duration are independent",
                100.0 * constants,
                100.0 * speeds
            ),
        ),
        Claim::statement(
            ID,
            PLACE,
            "durations below two time constants are refused, for every ensemble",
            claim::all(short, |duration| duration.accepted == 0 && duration.refusal.is_some()),
            data.durations
                .first()
                .and_then(|duration| duration.refusal.clone())
                .unwrap_or_else(|| "accepted".to_owned()),
        ),
        Claim::statement(
            ID,
            PLACE,
            "durations above five time constants are accepted, for every ensemble",
            claim::all(long, |duration| duration.accepted == duration.tried),
            format!("{} ensembles of each", data.durations.last().map_or(0, |duration| duration.tried)),
        ),
    ]
}
