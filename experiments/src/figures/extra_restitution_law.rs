//! Beyond the paper: the orbit diagram with a constant restitution and with that of viscoelastic bodies.

use std::f64::consts::{PI, TAU};

use bouncing_disk::core::map::{Constant, KuwabaraKono, RestitutionLaw};
use bouncing_disk::core::numerics::elementary::acos;
use bouncing_disk::core::numerics::roots::bisection;
use bouncing_disk::core::{ChatterPolicy, ImpactMap, ImpactState, OrbitEvent, Phase, Vibration};
use bouncing_disk::motion::PAPER_CHATTER;
use bouncing_disk_plot::{
    Anchor, Axis, Colour, Corner, DOUBLE_COLUMN, Dash, DensePoints, Figure, Grid, Legend, Line, Margins,
    Panel, Rect, Rule, Scatter, Stroke, Text, Ticks,
};
use serde::{Deserialize, Serialize};

use crate::claims::paper;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// The last Γ of the diagram: both attractors are lost before it.
const LAST: f64 = 0.62;

/// Highest |w_A Γ/(ωA)| at which the laws are drawn.
const FASTEST: f64 = 3.0;

/// Two laws of restitution.
#[derive(Debug)]
pub struct ExtraRestitutionLaw;

/// The data of the comparison of two laws.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraRestitutionLawData {
    law: KuwabaraKono,
    /// Γ from which the period-1 attractor is followed.
    first_axial_forcing: f64,
    constant: Followed,
    viscoelastic: Followed,
}

/// The attractor that is followed from the period-1 orbit.
#[derive(Debug, Serialize, Deserialize)]
struct Followed {
    /// Γ and phase of impact (cycles).
    dots: Vec<(f64, f64)>,
    /// The first Γ at which the disk comes to rest; `None` if it never does.
    lost_at: Option<f64>,
    /// Γ of the first period doubling, where the derivative of the map along the period-1 orbit has the
    /// multiplier -1.
    first_doubling: f64,
}

impl Experiment for ExtraRestitutionLaw {
    type Data = ExtraRestitutionLawData;
    const ID: &'static str = "extra-restitution-law";
    const TITLE: &'static str = "The orbit diagram under two laws of restitution";
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(PAPER_CHATTER);

    fn caption(data: &ExtraRestitutionLawData) -> String {
        let lost =
            |own: &Followed| own.lost_at.map_or("not at all".to_owned(), |at| format!("at Γ = {at:.4}"));
        format!(
            "The attractor followed in Γ from the period-1 orbit at Γ = {}, as in Fig. 6(a): (a) constant restitution {}; (b) the \
             law of viscoelastic bodies (Kuwabara and Kono), 1 - r proportional to v^(1/5) at low speed, with the same restitution at the \
             speed 2π g/(ω(1 + r)) of all period-1 impacts. Dashed: the first period doublings, from the derivative of the map. The \
             attractor is lost, as the disk comes to rest: {} in (a), {} in (b). (c) Both laws; dot: where they agree.",
            data.first_axial_forcing,
            data.law.reference_restitution(),
            lost(&data.constant),
            lost(&data.viscoelastic),
        )
    }

    fn compute(
        quality: Quality,
        progress: &dyn Progress,
    ) -> Result<ExtraRestitutionLawData, ExperimentError> {
        let section = paper::section_four()?;
        let restitution = section.restitution;
        let law = KuwabaraKono::new(restitution, TAU / (1.0 + restitution))?;
        let (from, values) = (section.followed_from, quality.choose(240, 1_600));
        let forcings: Vec<f64> =
            (0..values).map(|k| from + (LAST - from) * k as f64 / (values - 1) as f64).collect();
        let impacts = quality.choose((600, 80), (3_000, 240));
        progress.start(2, "laws");
        let constant = followed(&Constant::new(restitution)?, restitution, &forcings, impacts)?;
        progress.advance(1);
        let viscoelastic = followed(&law, restitution, &forcings, impacts)?;
        progress.advance(1);
        Ok(ExtraRestitutionLawData { law, first_axial_forcing: from, constant, viscoelastic })
    }

    fn draw(data: &ExtraRestitutionLawData) -> Result<Figure, ExperimentError> {
        const HEIGHT: f64 = 205.0;
        let margins = Margins { left: 42.0, right: 10.0, top: 12.0, bottom: 34.0 };
        let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 1, 3).margins(margins).gaps(14.0, 10.0);
        let grid = grid.column_weights(&[1.0, 1.0, 0.85]);
        let from = data.first_axial_forcing;
        let y = Axis::linear(-0.06, 0.3).ticks(Ticks::every(0.1).minor(2));
        let (left, middle) = (y.clone().label(r"$\tau_{imp}/2\pi$"), y.without_numbers());
        let mut right = grid.cell(0, 2);
        // The third panel has numbers and a label of its own.
        right.left += 34.0;
        right.width -= 34.0;
        Ok(Figure::new(DOUBLE_COLUMN, HEIGHT).panels([
            diagram(&data.constant, grid.cell(0, 0), from, "constant").y(left).letter("a"),
            diagram(&data.viscoelastic, grid.cell(0, 1), from, "viscoelastic").y(middle).letter("b"),
            laws(&data.law, right),
        ]))
    }
}

fn map<L: RestitutionLaw>(axial_forcing: f64, law: &L) -> Result<ImpactMap<L>, ExperimentError> {
    Ok(ImpactMap::with_law(Vibration::from_axial_forcing(axial_forcing)?, law.clone()))
}

/// The impact of the period-1 orbit in closed form: the disk lands with v = 2π/(1 + r) where the platform
/// rises with π (1 - r)/(1 + r) and brakes.
fn period_one(axial_forcing: f64, restitution: f64) -> Result<ImpactState, ExperimentError> {
    let angle = acos((1.0 - restitution) / (1.0 + restitution) / axial_forcing);
    Ok(ImpactState::new(Phase::new(angle)?, -TAU / (1.0 + restitution))?)
}

fn followed<L: RestitutionLaw>(
    law: &L,
    restitution: f64,
    forcings: &[f64],
    (transient, kept): (usize, usize),
) -> Result<Followed, ExperimentError> {
    let mut state = period_one(forcings[0], restitution)?;
    let (mut dots, mut lost_at) = (Vec::new(), None);
    'forcings: for &axial_forcing in forcings {
        let mut orbit = map(axial_forcing, law)?.orbit(state, PAPER_CHATTER);
        let mut column = Vec::new();
        for index in 0..transient + kept {
            let Some(OrbitEvent::Impact(impact)) = orbit.advance()? else {
                lost_at = Some(axial_forcing);
                break 'forcings;
            };
            state = ImpactState::from(impact);
            if index >= transient {
                column.push((axial_forcing, state.phase().cycles()));
            }
        }
        dots.extend(column);
    }
    let first_doubling = bisection(0.4, 0.6, 48, |forcing| {
        let (_, derivative) = map(forcing, law)?.step_with_derivative(period_one(forcing, restitution)?)?;
        let trace = derivative.x_axis.x + derivative.y_axis.y;
        // The sign of (1 + one multiplier)(1 + the other one).
        Ok::<_, ExperimentError>(1.0 + trace + derivative.determinant() > 0.0)
    })?;
    Ok(Followed { dots, lost_at, first_doubling })
}

fn diagram(followed: &Followed, area: Rect, from: f64, name: &str) -> Panel {
    // The attractor passes phase zero.
    let shown = |(forcing, phase): (f64, f64)| (forcing, if phase > 0.5 { phase - 1.0 } else { phase });
    let dots = followed.dots.iter().map(|dot| shown(*dot));
    let rule = |forcing, colour, dash| Rule::vertical(forcing).stroke(Stroke::new(colour, 0.6).dashed(dash));
    Panel::new(area)
        .x(Axis::linear(from, LAST).label(r"$\Gamma$").ticks(Ticks::every(0.1).minor(5)))
        .layer(DensePoints::new(dots).colour(Colour::rgb(40, 40, 40)).radius(0.3))
        .layer(rule(followed.first_doubling, Colour::BLUE, Dash::Dashed))
        .layers(followed.lost_at.map(|lost| rule(lost, Colour::VERMILION, Dash::Dotted)))
        .layer(Text::at_axes(0.15, 0.915, name).anchor(Anchor::Left).size(8.5))
}

fn laws(law: &KuwabaraKono, area: Rect) -> Panel {
    let restitution = law.reference_restitution();
    let curve = (0..=120).map(|k| FASTEST * f64::from(k * k) / f64::from(120 * 120));
    let curve = curve.map(|normalised| (normalised, law.restitution(PI * normalised)));
    let constant = Line::new([(0.0, restitution), (FASTEST, restitution)]).dash(Dash::Dashed);
    Panel::new(area)
        .x(Axis::linear(0.0, FASTEST).label(r"$|w_A\Gamma/(\omega A)|$").ticks(Ticks::every(1.0).minor(5)))
        .y(Axis::linear(0.0, 1.0).label(r"restitution $\epsilon$").ticks(Ticks::every(0.2).minor(2)))
        .letter_in("c", Corner::BottomLeft)
        .layer(constant.colour(Colour::DARK_GREY).name("constant"))
        .layer(Line::new(curve).name("viscoelastic"))
        .layer(Scatter::new([(law.reference_speed() / PI, restitution)]).size(5.0))
        .legend(Legend::at(Corner::TopRight))
}
