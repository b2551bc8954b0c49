//! Beyond the paper: the tangency at which the attractor of Fig. 6 is lost, and how long orbits live beyond
//! it.

use bouncing_disk::core::chaos::{Crisis, CrisisLives, CrisisSearch, ManifoldKind, ManifoldSettings};
use bouncing_disk::core::numerics::elementary::pow;
use bouncing_disk::core::orbits::PeriodicOrbit;
use bouncing_disk::core::sweep::orbit_diagram;
use bouncing_disk::core::{ChatterPolicy, ImpactMap, ImpactState, Unobserved, Vibration};
use bouncing_disk_plot::{
    Axis, Colour, DOUBLE_COLUMN, Dash, DensePoints, Figure, Line, Marker, Panel, Rect, Scatter, Ticks,
};
use serde::{Deserialize, Serialize};

use super::shared::lines;
use crate::claims::paper;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Γ between which the crisis lies.
const RANGE: (f64, f64) = (0.5595, 0.5615);
/// The largest distance in Γ at which lives are counted; each next one is half of it.
const FARTHEST: f64 = 1.0e-3;
/// The ranges of panel (a), and half the width and the height of panel (b): phases in periods, normalised
/// speeds.
const SHOWN: [(f64, f64); 2] = [(-0.12, 0.32), (0.95, 1.65)];
const MAGNIFIED: (f64, f64) = (0.006, 0.010);

/// An impact: phase in periods, in [-1/2, 1/2), and normalised speed |w_A Γ/(ωA)|.
type Spot = (f64, f64);

/// The crisis of the attractor of Fig. 6.
#[derive(Debug)]
pub struct ExtraCrisis;

/// The data of the crisis.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraCrisisData {
    crisis: Crisis,
    /// Impacts of an orbit on the attractor at the crisis.
    attractor: Vec<Spot>,
    /// The stable and the unstable manifold of the saddle at the crisis, piece by piece.
    stable: Vec<Vec<Spot>>,
    unstable: Vec<Vec<Spot>>,
    /// The impacts of the saddle, those of the orbit of tangency, and which of these is magnified.
    saddle: Vec<Spot>,
    tangency: Vec<Spot>,
    magnified: Spot,
    /// Mean lives beyond the crisis, of so many orbits at each Γ.
    lives: CrisisLives,
    orbits: usize,
}

impl Experiment for ExtraCrisis {
    type Data = ExtraCrisisData;
    const ID: &'static str = "extra-crisis";
    const TITLE: &'static str = "The crisis: a tangency, and the lives beyond it";
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn caption(data: &ExtraCrisisData) -> String {
        let law = data.lives.scaling.as_ref().map_or_else(
            |reason| format!("no power law: {reason}"),
            |law| format!("fitted line: exponent {:.2} ± {:.2}", law.exponent, law.standard_error),
        );
        format!(
            "The crisis of the attractor of Fig. 6: at Γ = {:.7} the unstable manifold (red) of a saddle (circles) touches its own \
             stable manifold (blue). (a) The attractor (dots) and the stable manifold; crosses: the orbit of tangency. (b) The same \
             next to one of its impacts, magnified. (c) Mean life in impacts over the distance of Γ from the crisis, {} orbits each; \
             {law}; dashed: the exponent {:.3} that the multipliers of the saddle tell.",
            data.crisis.forcing,
            data.orbits,
            -data.crisis.life_exponent().unwrap_or(f64::NAN),
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraCrisisData, ExperimentError> {
        let restitution = paper::section_four()?.restitution;
        progress.start(3, "parts");
        let none = || ExperimentError::NoData { quantity: "a crisis".to_owned() };
        let crisis = CrisisSearch::new(restitution, RANGE)?.crisis(None, &Unobserved)?.map_err(|_| none())?;
        let tangency = crisis.tangency.clone().map_err(|_| none())?;
        progress.advance(1);
        let at = ImpactMap::new(Vibration::from_axial_forcing(crisis.forcing)?, restitution)?;
        let start = *tangency.orbit.get(tangency.orbit.len() / 2).ok_or_else(none)?;
        let (recorded, stable, unstable) = quality.choose((4_000, 30.0, 6.0), (40_000, 120.0, 16.0));
        let attractor =
            orbit_diagram(&[at.orbit(start, ChatterPolicy::Complete)], 200, recorded, &Unobserved)?;
        let grown = |kind: ManifoldKind, arclength: f64| -> Result<Vec<Vec<Spot>>, ExperimentError> {
            let settings = ManifoldSettings::new(arclength, 100_000)?.with_resolution(0.03, 0.1)?;
            Ok(lines(&at.manifold(&tangency.touched, kind, &settings, &Unobserved)?, spot))
        };
        let (stable, unstable) =
            (grown(ManifoldKind::Stable, stable)?, grown(ManifoldKind::Unstable, unstable)?);
        progress.advance(1);
        let (orbits, most_impacts, halvings) = quality.choose((40, 2_000_000, 12), (300, 20_000_000, 14));
        let beyond: Vec<f64> =
            std::iter::successors(Some(FARTHEST), |last| Some(0.5 * last)).take(halvings + 1).collect();
        let lives = crisis.lives(&beyond, orbits, most_impacts, &Unobserved)?;
        progress.advance(1);
        let spots = |states: &[ImpactState]| states.iter().map(|state| spot(*state)).collect();
        Ok(ExtraCrisisData {
            attractor: spots(&attractor.concat()),
            stable,
            unstable,
            saddle: spots(&tangency.touched.states),
            tangency: spots(&tangency.orbit),
            magnified: magnified(&tangency.orbit, &tangency.touched).ok_or_else(none)?,
            lives,
            orbits,
            crisis,
        })
    }

    fn draw(data: &ExtraCrisisData) -> Result<Figure, ExperimentError> {
        let (phase, speed) = data.magnified;
        let near = [(phase - MAGNIFIED.0, phase + MAGNIFIED.0), (speed - MAGNIFIED.1, speed + MAGNIFIED.1)];
        Ok(Figure::new(DOUBLE_COLUMN, 232.0).panels([
            plane(data, Rect::new(42.0, 14.0, 150.0, 180.0), SHOWN, (0.1, 0.2), false).letter("a"),
            plane(data, Rect::new(240.0, 14.0, 108.0, 180.0), near, (0.005, 0.005), true).letter("b"),
            lives(data, Rect::new(402.0, 14.0, 100.0, 180.0)),
        ]))
    }
}

fn spot(state: ImpactState) -> Spot {
    let cycles = state.phase().cycles();
    (if cycles < 0.5 { cycles } else { cycles - 1.0 }, state.normalised_speed())
}

/// The first impact that is back at the saddle after the one that lies farthest from it: where the manifold
/// folds.
fn magnified(orbit: &[ImpactState], saddle: &PeriodicOrbit) -> Option<Spot> {
    let distance = |state: &ImpactState| {
        let own = spot(*state);
        let away = saddle.states.iter().map(|other| spot(*other));
        away.map(|other| (own.0 - other.0).abs().max((own.1 - other.1).abs())).fold(f64::INFINITY, f64::min)
    };
    let farthest = (0..orbit.len()).max_by(|&i, &j| distance(&orbit[i]).total_cmp(&distance(&orbit[j])))?;
    orbit[farthest..].iter().find(|state| distance(state) < 0.02).map(|state| spot(*state))
}

/// A part of the plane with attractor, manifolds, saddle and tangency.
fn plane(
    data: &ExtraCrisisData,
    area: Rect,
    [x, y]: [(f64, f64); 2],
    steps: (f64, f64),
    both: bool,
) -> Panel {
    let scatter = |spots: &[Spot]| Scatter::new(spots.iter().copied());
    let mut panel = Panel::new(area)
        .x(Axis::linear(x.0, x.1).label(r"$\tau_{imp}/2\pi$").ticks(Ticks::every(steps.0).minor(2)))
        .y(Axis::linear(y.0, y.1).label(r"$|w_A\Gamma/(\omega A)|$").ticks(Ticks::every(steps.1).minor(2)));
    for piece in &data.stable {
        panel = panel.layer(Line::new(piece.iter().copied()).width(0.6).colour(Colour::BLUE));
    }
    panel = panel.layer(DensePoints::new(data.attractor.iter().copied()).colour(Colour::BLACK).radius(0.35));
    if both {
        for piece in &data.unstable {
            panel = panel.layer(Line::new(piece.iter().copied()).width(0.6).colour(Colour::VERMILION));
        }
    }
    panel
        .layer(scatter(&data.saddle).marker(Marker::Circle).size(5.0).width(1.0).colour(Colour::VERMILION))
        .layer(scatter(&data.tangency).marker(Marker::Cross).size(3.8).width(0.7))
}

fn lives(data: &ExtraCrisisData, area: Rect) -> Panel {
    let known: Vec<_> = data.lives.lives.iter().filter(|life| life.ended > 0).collect();
    let ends = |values: Vec<f64>| {
        values.iter().fold((f64::MAX, 0.0_f64), |(low, high), &own| (low.min(own), high.max(own)))
    };
    let (least, most) = ends(known.iter().map(|life| life.impacts).collect());
    let (near, far) = ends(known.iter().map(|life| life.beyond).collect());
    let points = known.iter().map(|life| (life.beyond, life.impacts));
    let errors = known.iter().map(|life| life.relative_error * life.impacts);
    let mut panel = Panel::new(area)
        .x(Axis::log(0.5 * near, 2.0 * far).label(r"$\Gamma-\Gamma_c$"))
        .y(Axis::log(0.5 * least, 8.0 * most).label("mean life (impacts)"))
        .letter("c")
        .layer(Scatter::new(points).size(2.0).errors_y(errors));
    if let Ok(law) = &data.lives.scaling {
        let middle = (law.range.0 * law.range.1).sqrt();
        let line = |exponent: f64| {
            let of = |x: f64| (x, law.at(middle) * pow(x / middle, exponent));
            Line::new([of(law.range.0), of(law.range.1)]).width(0.8)
        };
        panel = panel.layer(line(law.exponent).colour(Colour::VERMILION));
        if let Some(expected) = data.crisis.life_exponent() {
            panel = panel.layer(line(-expected).colour(Colour::BLUE).dash(Dash::Dashed));
        }
    }
    panel
}
