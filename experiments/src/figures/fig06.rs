//! Fig. 6: bifurcation diagrams of the bouncing disk.

mod chattering;
mod claims;
mod compute;
mod contact;
mod data;
mod draw;
mod explored;
mod period_one;
mod regimes;
mod rotation;
mod slices;

use std::f64::consts::PI;

use bouncing_disk::motion::{PAPER_CHATTER, PAPER_CUT};

pub(crate) use self::data::Fig06Data;
use crate::experiment::{ExperimentError, Paper};

/// Fig. 6.
pub(crate) fn fig06(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(PAPER_CHATTER);
    let data = &compute::compute(fig.quality, fig.progress)?;
    fig.caption(format!(
        "Bifurcation diagrams (ε = {}): the attractor followed in Γ from its period-1 orbit at Γ = {} (dark gray) and \
         the chattering orbit of a disk from rest (light gray); where an orbit has many impacts, the darker the gray the denser they are. (a) Phase of impact; (b) relative axial impact speed; \
         (c), (d) angular speed of the disk just before impact for (θ, Γ_T) = ({}, {}) and ({}, {}). Dotted lines \
         mark the panels of Fig. 7. {} values of Γ, {} impacts each after a transient of {}; chattering ends by the \
         paper's cut. The followed attractor is lost in a crisis at Γ = {:.5} (dashed). (a\u{2032}) The followed attractor of (a) about \
         the third and the following doublings (dashed), at {} values of Γ. At {} values of Γ a disk from rest does not \
         come to rest again but ends on another attractor; nothing is drawn in light gray there.",
        data.restitution,
        data.followed_from,
        data.linear.phase_lag_rad,
        data.linear.angular_forcing,
        lag(data),
        data.semielliptical.angular_forcing,
        data.axial_forcing_values,
        data.examined_impacts,
        data.transient_impacts,
        data.merging.axial_forcing(),
        data.zoom.len(),
        data.not_chattering.len(),
    ));
    fig.parameter("restitution ε", data.restitution);
    fig.parameter(
        "axial forcing Γ",
        format!("{} to {}", data.axial_forcing_range.0, data.axial_forcing_range.1),
    );
    fig.parameter("values of Γ", data.axial_forcing_values);
    fig.parameter("transient", format!("{} impacts", data.transient_impacts));
    fig.parameter("examined", format!("{} impacts", data.examined_impacts));
    fig.parameter("(c) θ, Γ_T", format!("{}, {}", data.linear.phase_lag_rad, data.linear.angular_forcing));
    fig.parameter("(d) θ, Γ_T", format!("{}, {}", lag(data), data.semielliptical.angular_forcing));
    fig.parameter(
        "chattering",
        format!(
            "cut at |w_A Γ/(ωA)| < {:e} or after {} flights shorter than {:e} of a period",
            PAPER_CUT.smallest_speed(),
            PAPER_CUT.short_flights(),
            PAPER_CUT.short_flight()
        ),
    );
    fig.claims(claims::claims(data));
    fig.draw(draw::draw(data));
    fig.data(data)
}

/// θ of (d).
fn lag(data: &Fig06Data) -> String {
    format!("{:.2}π", data.semielliptical.phase_lag_rad / PI).replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::{Class, Computed};
    use crate::progress::Silent;

    /// A claim that is judged over a list of data is not judged if the list is empty.
    #[test]
    fn no_statement_of_the_paper_holds_without_data() {
        let mut data = compute::compute(crate::Quality::Draft, &Silent).expect("runs");
        assert!(claims::claims(&data).iter().all(|claim| !claim.lacks_data()));
        data.followed.clear();
        data.chattering.clear();
        data.doublings.clear();
        data.motions.clear();
        data.torque_ratios.clear();
        data.transfers.clear();
        data.lyapunov_exponents.clear();
        data.best_lags.clear();
        data.chatters.clear();
        data.forcing_effects.clear();
        data.explored.shadows.clear();
        data.period_one.lags.clear();
        data.period_one.orbits = 0;
        // The multiplier of one orbit is one number, not a list.
        let single = ["the period-1 orbit exists and attracts at Γ = 0.335, where following starts"];
        for claim in claims::claims(&data) {
            let holds = matches!(claim.computed, Computed::Boolean(true));
            let judged = matches!(claim.class, Class::Paper | Class::Identity);
            assert!(!(holds && judged) || single.contains(&claim.quantity.as_str()), "{}", claim.quantity);
        }
    }
}
