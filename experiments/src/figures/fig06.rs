//! Fig. 6: bifurcation diagrams of the bouncing disk.

mod chattering;
mod crisis;
mod diagram;
mod doublings;
mod enlarged;
mod impulses;
mod period_one;
mod picture;
mod rotation;
mod speed;

use std::f64::consts::PI;

use bouncing_disk::motion::{PAPER_CHATTER, PAPER_CUT};
use bouncing_disk::toss::MultiTossSettings;

use self::diagram::{Diagram, Inputs};
use self::picture::Picture;
use super::shared::FORCING_RANGE;
use crate::claims::paper;
use crate::experiment::{ExperimentError, Paper};

/// Values of Γ, of the followed attractor and of the disk from rest, at which the dearer searches are done.
const SAMPLED: usize = 40;

/// Fig. 6.
pub(crate) fn fig06(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    // Another restitution gives the same panels: `Inputs { restitution: 0.6, ..Inputs::printed()? }`. Its claims still compare
    // with the numbers printed for 0.5.
    diagrams(fig, Inputs::printed()?)
}

fn diagrams(fig: &mut Paper<'_>, inputs: Inputs) -> Result<(), ExperimentError> {
    let quality = fig.quality;
    let values = quality.choose(200, 2_000);
    let settings = MultiTossSettings {
        policy: PAPER_CHATTER,
        transient_impacts: 1_000,
        examined_impacts: quality.choose(100, 300),
        longest_period: quality.choose(50, 128),
        tolerance: 1.0e-7,
    };
    let axial_forcings_of_fig7 = paper::section_four()?.axial_forcings_of_fig7;
    fig.chattering(PAPER_CHATTER);
    fig.record("restitution", &inputs.restitution)?;
    fig.record("axial_forcing_range", &FORCING_RANGE)?;
    fig.record("basin_axial_forcings", &axial_forcings_of_fig7)?;
    fig.record("axial_forcing_values", &values)?;
    fig.record("transient_impacts", &settings.transient_impacts)?;
    fig.record("examined_impacts", &settings.examined_impacts)?;
    fig.record("linear", &inputs.linear)?;
    fig.record("semielliptical", &inputs.semielliptical)?;
    fig.record("followed_from", &inputs.followed_from)?;

    fig.progress.start(2 * values as u64 + 3, "orbits and searches");
    let diagram = &Diagram::of(values, inputs, settings, fig.progress)?;
    fig.record("followed", &diagram.followed)?;
    fig.record("chattering", &diagram.chattering)?;
    let doublings = &doublings::cascade(inputs.restitution)[..];
    fig.progress.advance(1);
    // Side by side, for in most of the searches one step follows from another.
    let (merging, others) = rayon::join(
        || crisis::merging(diagram, quality),
        || -> Result<_, ExperimentError> {
            let single_tosses = chattering::single_tosses(diagram)?;
            let bouncing = chattering::bouncing(diagram)?;
            Ok((single_tosses, bouncing, enlarged::columns(diagram, doublings, quality)?))
        },
    );
    let (merging, (single_tosses, bouncing, enlarged)) = (merging?, others?);
    fig.progress.advance(1);
    fig.record("zoom", &enlarged)?;
    let crisis = merging.as_ref().map(|of| of.axial_forcing);

    doublings::claims(fig, doublings)?;
    doublings::period_one(fig, diagram, doublings)?;
    period_one::equation_16(fig, diagram)?;
    // Nothing lies beyond a crisis that was not found.
    let end = crisis.unwrap_or(f64::NAN);
    rotation::rotation(fig, diagram, doublings, end)?;
    chattering::chattering(fig, diagram, single_tosses.as_ref(), &bouncing, end)?;
    crisis::crisis(fig, diagram, doublings, merging.as_ref())?;
    speed::speeds(fig, diagram, doublings, crisis)?;
    impulses::transfers(fig, diagram)?;
    impulses::motions(fig, inputs, &axial_forcings_of_fig7)?;
    impulses::dimension(fig, inputs)?;
    impulses::torques(fig)?;
    fig.progress.advance(1);

    let lag =
        |rad: f64| if rad == 0.0 { "0".to_owned() } else { format!("{:.2}π", rad / PI).replace('-', "−") };
    let [linear, semielliptical] =
        inputs.twists().map(|twist| format!("{}, {}", lag(twist.phase_lag_rad), twist.angular_forcing));
    fig.parameter("restitution ε", inputs.restitution);
    fig.parameter("axial forcing Γ", format!("{} to {}", FORCING_RANGE.0, FORCING_RANGE.1));
    fig.parameter("values of Γ", values);
    fig.parameter("transient", format!("{} impacts", settings.transient_impacts));
    fig.parameter("examined", format!("{} impacts", settings.examined_impacts));
    fig.parameter("(c) θ, Γ_T", &linear);
    fig.parameter("(d) θ, Γ_T", &semielliptical);
    fig.parameter(
        "chattering",
        format!(
            "cut at |w_A Γ/(ωA)| < {:e} or after {} flights shorter than {:e} of a period",
            PAPER_CUT.smallest_speed(),
            PAPER_CUT.short_flights(),
            PAPER_CUT.short_flight()
        ),
    );
    fig.caption(format!(
        "Bifurcation diagrams (ε = {}). Dark gray: the attractor followed from period 1 at Γ = {}; light gray: the chattering \
         orbit of a disk from rest, missing at {} values of Γ where it never rests again. Long orbits are shaded by \
         density. (a) Phase of impact; (b) relative axial impact speed; (c), (d) angular speed just before impact for (θ, Γ_T) = \
         ({linear}) and ({semielliptical}). (a\u{2032}) The third to the fifth doubling. Dotted: panels of Fig. 7. {}",
        inputs.restitution,
        inputs.followed_from,
        bouncing.len(),
        crisis.map_or_else(String::new, |crisis| format!("Dashed: crisis at Γ = {crisis:.4}.")),
    ));
    let picture = Picture { diagram, doublings, crisis, axial_forcings_of_fig7, enlarged: &enlarged };
    fig.draw(picture::draw(&picture));
    Ok(())
}

/// The error of a Γ at which there is no orbit.
fn no_orbit(axial_forcing: f64) -> ExperimentError {
    ExperimentError::model(bouncing_disk::core::Error::NotSettled {
        what: "orbit",
        iterations: 0,
        residual: axial_forcing,
    })
}

/// Words in a row.
fn listed(words: impl IntoIterator<Item = String>) -> String {
    words.into_iter().collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Quality;
    use crate::claims::{Class, Computed};
    use crate::experiment::{Experiment, Made};
    use crate::progress::Silent;

    fn made(make: fn(&mut Paper<'_>) -> Result<(), ExperimentError>) -> Made {
        let figure = Experiment { id: "fig06", title: "", discussion: "", make };
        figure.compute(Quality::Draft, &Silent).expect("runs")
    }

    #[test]
    fn another_restitution_has_every_panel() {
        let made = made(|fig| diagrams(fig, Inputs { restitution: 0.6, ..Inputs::printed()? }));
        for branch in ["followed", "chattering", "zoom", "doublings"] {
            let drawn = made.record.data[branch].as_array().map_or(0, Vec::len);
            assert!(drawn > 4, "{branch}");
        }
        assert!(made.record.data["merging"].is_object());
        assert!(made.figure.to_svg().is_ok());
    }

    /// At this restitution there is no period-1 orbit in the range of the diagram: nothing said of the followed attractor has
    /// data, and only what other orbits show can hold.
    #[test]
    fn no_statement_of_the_paper_holds_without_data() {
        let made = made(|fig| diagrams(fig, Inputs { restitution: 0.1, ..Inputs::printed()? }));
        let claims = made.record.claims.iter();
        let holding =
            claims.filter(|claim| claim.class == Class::Paper && claim.computed == Computed::Boolean(true));
        let holding: Vec<_> = holding.filter_map(|claim| claim.key.as_deref()).collect();
        let of_other_orbits = [
            "section4.ratios_approach_feigenbaum",
            "section4.slip_vanishes",
            "section4.maximum_speed",
            "section4.elliptical_not_optimal",
            "section4.chattering_is_periodic",
            "section1.no_bouncing",
            "section4.single_tosses_end",
            "section4.chattering_decays",
            "section4.rest_in_finite_time",
            "section1.displacement_bounded",
            "section1.unbounded_rotation",
        ];
        assert_eq!(holding, of_other_orbits);
    }
}
