//! Beyond the paper: the stable manifolds of saddles over the basins of Fig. 7.

use std::f64::consts::PI;

use bouncing_disk::core::attractors::{ATTACHED, BasinSettings, FIRST_ORBIT, KnownOrbit, Label};
use bouncing_disk::core::chaos::{ManifoldKind, ManifoldSettings};
use bouncing_disk::core::orbits::{OrbitSearch, PeriodicOrbit, Stability};
use bouncing_disk::core::{self, ChatterPolicy, ImpactMap, ImpactState, Unobserved, Vibration};
use bouncing_disk_plot::{
    Axis, Colour, DOUBLE_COLUMN, Figure, Grid, Line, Margins, Marker, Panel, Raster, Rect, Scatter, Ticks,
};
use serde::{Deserialize, Serialize};

use super::shared::lines;
use crate::claims::paper;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::{Progress, advancing};

/// Top of the window of speeds, that of Fig. 7.
const WINDOW_TOP: f64 = 5.0;
/// Impacts after which a start counts as one that does not come to rest.
const IMPACTS: u32 = 1_000;
/// Comes to rest, does not, other periodic orbit.
const PALETTE: [Colour; 3] = [Colour::WHITE, Colour::LIGHT_GREY, Colour::DARK_GREY];

/// An impact: phase in periods and normalised speed |w_A Γ/(ωA)|.
type Spot = (f64, f64);

/// Stable manifolds over the basins of Fig. 7.
#[derive(Debug)]
pub struct ExtraManifolds;

/// The basins at one forcing, and what is drawn over them.
#[derive(Debug, Serialize, Deserialize)]
pub struct Basins {
    axial_forcing: f64,
    /// The fate of the cells, row by row: 0 comes to rest, 1 does not or is on the orbit that a saddle is
    /// born with, 2 is on another periodic orbit.
    rows: Vec<String>,
    /// The stable manifolds, piece by piece, and the saddles.
    manifolds: Vec<Vec<Spot>>,
    saddles: Vec<Spot>,
}

impl Experiment for ExtraManifolds {
    type Data = Vec<Basins>;
    const ID: &'static str = "extra-manifolds";
    const TITLE: &'static str = "Stable manifolds over the basins of Fig. 7";
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn caption(_: &Vec<Basins>) -> String {
        "Stable manifolds (blue) of the saddle of one impact in each period of the platform (red), and in (b) also of the saddle \
         that is born with the third attractor, over the basins of Fig. 7: white, starts that come to rest; gray, those that do \
         not; dark gray, those on another periodic orbit."
            .to_owned()
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<Vec<Basins>, ExperimentError> {
        let printed = paper::section_four()?;
        let (cells, arclength) = quality.choose((80, 150.0), (600, 1_500.0));
        progress.start(4 * cells as u64, "rows");
        let forcings = printed.axial_forcings_of_fig7.into_iter().take(4);
        forcings.map(|forcing| basins(forcing, printed.restitution, (cells, arclength), progress)).collect()
    }

    fn draw(data: &Vec<Basins>) -> Result<Figure, ExperimentError> {
        const HEIGHT: f64 = 430.0;
        let margins = Margins { left: 42.0, right: 8.0, top: 18.0, bottom: 34.0 };
        let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 2, 2).margins(margins).gaps(44.0, 50.0);
        let panels = data.iter().zip(["a", "b", "c", "d"]).enumerate();
        let panels = panels.map(|(index, (own, letter))| panel(own, letter, grid.cell(index / 2, index % 2)));
        Ok(Figure::new(DOUBLE_COLUMN, HEIGHT).panels(panels))
    }
}

fn basins(
    forcing: f64,
    restitution: f64,
    (cells, arclength): (usize, f64),
    progress: &dyn Progress,
) -> Result<Basins, ExperimentError> {
    let map = ImpactMap::new(Vibration::from_axial_forcing(forcing)?, restitution)?;
    let orbits = map.periodic_orbits(&OrbitSearch::new(4, 2)?.with_starts(64, 64)?, &Unobserved)?.orbits;
    let mut known = Vec::new();
    for orbit in orbits.iter().filter(|orbit| orbit.stability() == Stability::Stable) {
        known.push(KnownOrbit::new(orbit.clone(), orbit.trapping_radius(&map, 64, &Unobserved)?)?);
    }
    let settings = BasinSettings { max_impacts: IMPACTS, ..BasinSettings::default() };
    let grid = core::attractors::Grid::new(
        core::attractors::Axis::new(0.0, 1.0, cells)?,
        core::attractors::Axis::new(0.0, WINDOW_TOP, cells)?,
    )?;
    let basins = map.basins(grid, &known, settings, &advancing(progress))?;
    let mut saddles: Vec<PeriodicOrbit> = Vec::new();
    if let Some(pair) = map.period_one_pair(1) {
        saddles.extend(pair.saddle.orbit(&map)?);
    }
    if known.iter().any(|own| is_other(own.orbit())) {
        saddles.extend(orbits.iter().filter(|orbit| is_partner(orbit)).cloned());
    }
    let fastest = PI * (forcing + restitution * WINDOW_TOP);
    let wanted = ManifoldSettings::new(arclength, 400_000)?.with_launch_speed(fastest)?;
    let mut manifolds = Vec::new();
    for saddle in &saddles {
        manifolds.extend(lines(&map.manifold(saddle, ManifoldKind::Stable, &wanted, &Unobserved)?, spot));
    }
    let digits: Vec<char> = basins.labels().iter().map(|label| digit(*label, &known)).collect();
    Ok(Basins {
        axial_forcing: forcing,
        rows: digits.chunks(cells).map(|row| row.iter().collect()).collect(),
        saddles: saddles.iter().flat_map(|orbit| &orbit.states).map(|state| spot(*state)).collect(),
        manifolds,
    })
}

/// Of another number of impacts than periods, as the third attractor at the second forcing.
fn is_other(orbit: &PeriodicOrbit) -> bool {
    orbit.period() as u64 != orbit.platform_periods
}

/// A saddle of two impacts in one period, both multipliers positive: it is born in a fold with that
/// attractor's parent.
fn is_partner(orbit: &PeriodicOrbit) -> bool {
    let trace = orbit.monodromy.x_axis.x + orbit.monodromy.y_axis.y;
    orbit.period() == 2 && orbit.platform_periods == 1 && trace > 2.0
}

fn digit(label: Label, known: &[KnownOrbit]) -> char {
    if label == ATTACHED {
        return '0';
    }
    let caught = label.checked_sub(FIRST_ORBIT).and_then(|index| known.get(usize::from(index)));
    if caught.is_some_and(|own| is_other(own.orbit())) { '2' } else { '1' }
}

fn spot(state: ImpactState) -> Spot {
    (state.phase().cycles(), state.normalised_speed())
}

fn panel(basins: &Basins, letter: &str, area: Rect) -> Panel {
    let window = (0.0, WINDOW_TOP);
    let side = basins.rows.len();
    let cells = basins.rows.iter().flat_map(|row| row.bytes().map(|digit| digit.saturating_sub(b'0').min(2)));
    let mut panel = Panel::new(area)
        .x(Axis::linear(0.0, 1.0).label(r"$\tau_{imp}/2\pi$").ticks(Ticks::every(0.2).minor(2)))
        .y(Axis::linear(0.0, WINDOW_TOP).label(r"$|w_A\Gamma/(\omega A)|$").ticks(Ticks::every(1.0).minor(5)))
        .title(format!(r"({letter}) $\Gamma = {}$", basins.axial_forcing))
        .layer(Raster::new(side, side, cells.collect(), &PALETTE, (0.0, 1.0), window));
    for piece in &basins.manifolds {
        panel = panel.layer(Line::new(piece.iter().copied()).width(0.35).colour(Colour::BLUE));
    }
    let saddles = Scatter::new(basins.saddles.iter().copied()).marker(Marker::Circle);
    panel.layer(saddles.size(4.5).width(1.1).colour(Colour::VERMILION))
}
