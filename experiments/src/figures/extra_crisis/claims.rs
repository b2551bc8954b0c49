//! What the figure shows, and its check.

use super::data::ExtraCrisisData;
use crate::claim::Claim;

const ID: &str = "extra-crisis";
const PLACE: &str = "this work";

/// Standard errors that the fitted exponent may be from the one that the multipliers tell.
const ERRORS: f64 = 3.0;

pub(super) fn claims(data: &ExtraCrisisData) -> Vec<Claim> {
    let (crisis, tangency) = (&data.crisis, &data.contact);
    let (none, some) = crisis.bracket;
    let fitted = data.lives.scaling.as_ref().ok().zip(data.expected_exponent);
    vec![
        Claim::statement(
            ID,
            PLACE,
            "no orbit on the attractor comes to rest at the last forcing below the tangency, some do at the first one above it",
            none < crisis.forcing && crisis.forcing < some,
            format!("{none:.9} < {:.12} < {some:.9}", crisis.forcing),
        ),
        Claim::statement(
            ID,
            PLACE,
            "the tangency is quadratic, of the stable and the unstable manifold of one saddle",
            tangency.curvature.abs() > 0.0 && tangency.inside.states == tangency.touched.states,
            format!("second derivative by the share of the first piece {:.3}", tangency.curvature),
        ),
        Claim::statement(
            ID,
            PLACE,
            "the unstable manifold of the period-1 orbit, in the midst of the attractor, touches later",
            data.midst_forcing > crisis.forcing,
            format!("at {:.9}", data.midst_forcing),
        ),
        Claim::statement(
            ID,
            PLACE,
            "the mean life beyond the crisis follows a power law with the exponent that the multipliers of the saddle tell",
            fitted.map(|(law, expected)| (law.exponent + expected).abs() <= ERRORS * law.standard_error),
            match (&data.lives.scaling, data.expected_exponent) {
                (Ok(law), Some(expected)) => {
                    format!("{:.3} ± {:.3} against {:.3}", law.exponent, law.standard_error, -expected)
                }
                (Err(reason), _) => reason.to_string(),
                (Ok(_), None) => "the multipliers do not tell".to_owned(),
            },
        ),
    ]
}
