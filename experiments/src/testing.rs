//! Experiments for the tests of this crate.

mod fig15;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::{Axis, DensePoints, Figure, Line, Panel, Rect};
use serde_json::json;

use crate::claims::Claim;
use crate::experiment::{Experiment, ExperimentError, Paper};

/// A small experiment that works.
fn demo(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.seed("points", 3);
    fig.seed("others", 4);
    fig.chattering(ChatterPolicy::Complete);
    let count = fig.quality.choose(5_u32, 50);
    fig.progress.start(u64::from(count), "points");
    let forcings: Vec<f64> = (0..count).map(|i| 0.3 + 0.3 * f64::from(i) / f64::from(count - 1)).collect();
    fig.progress.advance(u64::from(count));
    let phases: Vec<f64> = forcings.iter().map(|forcing| forcing * forcing).collect();
    fig.caption(format!("{} phases of impact τ_imp & Γ < 1.", phases.len()));
    fig.parameter("restitution ε", 0.5);
    fig.data(&json!({"axial_forcing": forcings, "impact_phase_rad": phases, "missing": None::<f64>}))?;
    let last = phases.last().copied().unwrap_or(f64::NAN);
    fig.claim(Claim::number(["demo", "Sec. 1", "last phase", "rad"], "0.36", last));
    let points = || forcings.iter().copied().zip(phases.iter().copied());
    let panel = Panel::new(Rect::new(40.0, 10.0, 190.0, 120.0))
        .x(Axis::linear(0.3, 0.6).label(r"$\Gamma$"))
        .y(Axis::linear(0.0, 0.4).label(r"$\tau_{imp}$ (rad)"))
        .layer(Line::new(points()))
        .layer(DensePoints::new(points()));
    fig.draw(Figure::new(246.0, 160.0).panel(panel));
    Ok(())
}

/// An experiment whose data hold a NaN.
fn broken(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    #[derive(serde::Serialize)]
    struct Data {
        speed_m_per_s: [f64; 2],
    }
    fig.data(&Data { speed_m_per_s: [1.0, f64::NAN] })
}

/// A registry of the two.
pub(crate) fn demo_entries() -> Vec<Experiment> {
    vec![
        Experiment {
            id: "demo",
            title: "A demonstration",
            discussion: "It shows that | is escaped.",
            make: demo,
        },
        Experiment { id: "broken", title: "An experiment that fails", discussion: "", make: broken },
    ]
}

/// The example of `docs/contributing.md` is this code, and it runs.
#[test]
fn the_example_of_a_figure_is_documented_as_it_is() {
    let example = Experiment { id: "fig15", title: "", discussion: "", make: fig15::fig15 };
    let made = example.compute(crate::Quality::Draft, &crate::Silent).expect("runs");
    assert_eq!(made.record.data["height_m"].as_array().map(Vec::len), Some(6));
    assert_eq!(made.record.claims[0].key.as_deref(), Some("section5.rebounds_fall"));
    let page = include_str!("../../docs/contributing.md");
    let unindented: Vec<&str> = page.lines().map(|line| line.strip_prefix("    ").unwrap_or(line)).collect();
    assert!(unindented.join("\n").contains(include_str!("testing/fig15.rs").trim_end()));
}
