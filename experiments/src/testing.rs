//! Experiments for the tests of this crate.

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::{Axis, DensePoints, Figure, Line, Panel, Rect};
use serde::{Deserialize, Serialize};

use crate::claims::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality, RegisteredExperiment, entry};
use crate::progress::Progress;

/// A small experiment that works.
pub(crate) struct Demo;

#[derive(Serialize, Deserialize)]
pub(crate) struct DemoData {
    axial_forcing: Vec<f64>,
    impact_phase_rad: Vec<f64>,
    missing: Option<f64>,
}

impl Experiment for Demo {
    type Data = DemoData;
    const ID: &'static str = "demo";
    const TITLE: &'static str = "A demonstration";
    const DISCUSSION: &'static str = "It shows that | is escaped.";
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![("points", 3), ("others", 4)]
    }

    fn caption(data: &DemoData) -> String {
        format!("{} phases of impact τ_imp & Γ < 1.", data.impact_phase_rad.len())
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<DemoData, ExperimentError> {
        let count = quality.choose(5_u32, 50);
        progress.start(u64::from(count), "points");
        let axial_forcing: Vec<_> =
            (0..count).map(|i| 0.3 + 0.3 * f64::from(i) / f64::from(count - 1)).collect();
        progress.advance(u64::from(count));
        let impact_phase_rad = axial_forcing.iter().map(|forcing| forcing * forcing).collect();
        Ok(DemoData { axial_forcing, impact_phase_rad, missing: None })
    }

    fn draw(data: &DemoData) -> Result<Figure, ExperimentError> {
        let points = || data.axial_forcing.iter().copied().zip(data.impact_phase_rad.iter().copied());
        let panel = Panel::new(Rect::new(40.0, 10.0, 190.0, 120.0))
            .x(Axis::linear(0.3, 0.6).label(r"$\Gamma$"))
            .y(Axis::linear(0.0, 0.4).label(r"$\tau_{imp}$ (rad)"))
            .layer(Line::new(points()))
            .layer(DensePoints::new(points()));
        Ok(Figure::new(246.0, 160.0).panel(panel))
    }

    fn claims(data: &DemoData) -> Vec<Claim> {
        let last = data.impact_phase_rad.last().copied().unwrap_or(f64::NAN);
        vec![Claim::number([Self::ID, "Sec. 1", "last phase", "rad"], "0.36", last)]
    }

    fn parameters(_: &DemoData) -> Vec<(String, String)> {
        vec![("restitution ε".to_owned(), "0.5".to_owned())]
    }
}

/// An experiment whose data hold a NaN.
pub(crate) struct Broken;

#[derive(Serialize, Deserialize)]
pub(crate) struct BrokenData {
    speed_m_per_s: Vec<f64>,
}

impl Experiment for Broken {
    type Data = BrokenData;
    const ID: &'static str = "broken";
    const TITLE: &'static str = "An experiment that fails";

    fn caption(_: &BrokenData) -> String {
        String::new()
    }

    fn compute(_: Quality, _: &dyn Progress) -> Result<BrokenData, ExperimentError> {
        Ok(BrokenData { speed_m_per_s: vec![1.0, f64::NAN] })
    }

    fn draw(_: &BrokenData) -> Result<Figure, ExperimentError> {
        Ok(Figure::new(10.0, 10.0))
    }
}

/// A registry of the two.
pub(crate) fn demo_entries() -> Vec<RegisteredExperiment> {
    vec![entry::<Demo>(), entry::<Broken>()]
}
