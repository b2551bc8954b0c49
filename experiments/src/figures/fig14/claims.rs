//! What the paper says about Fig. 14, compared with the data.

use super::data::Fig14Data;
use crate::claim::Claim;

const ID: &str = "fig14";

/// Share of a normal distribution within two standard deviations.
const WITHIN_TWO_ERRORS: f64 = 0.9545;

impl Fig14Data {
    /// Standard error of the share of the records that hold the slope; `None` without records.
    fn spread(&self) -> Option<f64> {
        let variance = WITHIN_TWO_ERRORS * (1.0 - WITHIN_TWO_ERRORS);
        (self.records > 0).then(|| (variance / f64::from(self.records)).sqrt())
    }

    pub(super) fn on_line(&self, time: f64) -> f64 {
        1.0 + self.slope_per_s * (time - self.start_s)
    }
}

pub(super) fn claims(data: &Fig14Data) -> Vec<Claim> {
    vec![
        Claim::printed("appendix.growth_per_toss", data.growth_per_toss_percent).note(format!(
            "the printed growth over the {} tosses from the start of the first to the start of the last; on the printed \
             line it takes {:.2} s, {:.3} s a toss",
            data.tosses_between,
            data.duration_s,
            data.duration_s / f64::from(data.tosses_between)
        )),
        Claim::reading(
            ID,
            "appendix.growth_per_toss",
            "growth per toss, the last toss counted",
            data.growth_per_toss_inclusive_percent,
        ),
        Claim::statement(
            ID,
            "this work",
            "a dough that has grown by one toss's share leaves the hand of Table I's toss as fast, within the measured uncertainty",
            data.airborne_speed_change_rad_per_s.abs() < data.measured_uncertainty_rad_per_s,
            format!(
                "all radii of the dough larger, the hand the same: {:+.4} rad/s, where the measured speed is known to ± {} rad/s. A dough that grows so much \
                 while it flies keeps its angular momentum and loses {:.1} % of its speed",
                data.airborne_speed_change_rad_per_s,
                data.measured_uncertainty_rad_per_s,
                data.flight_spin_loss_percent
            ),
        ),
        Claim::statement(
            ID,
            "this work",
            "the line-fit estimator recovers the slope of synthetic records within its standard error",
            data.spread().map(|spread| (data.recovered_share - WITHIN_TWO_ERRORS).abs() <= 3.0 * spread),
            format!(
                "two standard errors hold the slope in {:.1} % of {} records; {:.1} % expected, with a standard error of {:.1} %",
                100.0 * data.recovered_share,
                data.records,
                100.0 * WITHIN_TWO_ERRORS,
                100.0 * data.spread().unwrap_or(f64::NAN)
            ),
        ),
    ]
}
