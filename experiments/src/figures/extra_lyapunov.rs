//! Beyond the paper: the Lyapunov exponent over the forcing, under the orbit diagram.

use bouncing_disk::core::attractors::{CycleTrust, UndecidedReason, Verdict, VerdictSettings, verdicts};
use bouncing_disk::core::numerics::elementary::ln;
use bouncing_disk::core::sweep::orbit_diagram;
use bouncing_disk::core::{ChatterPolicy, ImpactMap, ImpactState, Orbit, Unobserved, Vibration};
use bouncing_disk_plot::{
    Axis, Colour, Corner, DOUBLE_COLUMN, Dash, DensePoints, Figure, Grid, Legend, Margins, Panel, Rule,
    Stroke, Ticks,
};
use serde::{Deserialize, Serialize};

use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::{Progress, advancing};

const RESTITUTION: f64 = 0.5;

/// Γ of the columns, and the exponents that are drawn.
const FORCINGS: (f64, f64) = (0.44, 0.62);
const EXPONENTS: (f64, f64) = (-0.9, 0.9);

/// Impacts before those that are drawn.
const SKIPPED: usize = 1_000;

/// The name and colour of each kind; the last one drawn lies on top.
const KINDS: [(Kind, &str, Colour); 4] = [
    (Kind::Rest, "with rests", Colour::LIGHT_GREY),
    (Kind::Periodic, "periodic", Colour::BLUE),
    (Kind::Chaotic, "chaotic", Colour::VERMILION),
    (Kind::Undecided, "undecided", Colour::BLACK),
];

/// Lyapunov exponents over the forcing.
#[derive(Debug)]
pub struct ExtraLyapunov;

/// The motion of a disk at one forcing.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Column {
    axial_forcing: f64,
    kind: Kind,
    /// The exponent per impact; none for a cycle that doubles follow exactly: no perturbation survives a
    /// rest.
    exponent: Option<f64>,
    impact_phase_cycles: Vec<f64>,
}

/// The long-term motion of a disk.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
enum Kind {
    Periodic,
    Chaotic,
    Rest,
    Undecided,
}

impl Experiment for ExtraLyapunov {
    type Data = Vec<Column>;
    const ID: &'static str = "extra-lyapunov";
    const TITLE: &'static str = "Lyapunov exponents over the forcing";
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn caption(data: &Vec<Column>) -> String {
        format!(
            "Orbit diagram (a) and largest Lyapunov exponent per impact (b) for a restitution of {RESTITUTION}, from one start at each of {} Γ. Blue: \
             periodic orbits, with the exponent of their multipliers; vermilion: chaos; grey: the disk comes to rest again and again, \
             where the exponent is that of the flights between two rests, drawn only where the cycle is so long that rounding chooses \
             it; black: undecided. Dashed: the first doubling in closed form.",
            data.len()
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<Vec<Column>, ExperimentError> {
        let (columns, drawn) = quality.choose((120, 20), (1_800, 150));
        let (transient, impacts) = quality.choose((1_000, 2_000), (2_000, 50_000));
        let settings = VerdictSettings { transient, impacts, ..VerdictSettings::default() };
        let state = ImpactState::from_normalised(1.2, 1.3)?;
        let mut starts = Vec::new();
        for k in 0..columns {
            let forcing = FORCINGS.0 + (FORCINGS.1 - FORCINGS.0) * (f64::from(k) + 0.5) / f64::from(columns);
            starts.push((ImpactMap::new(Vibration::from_axial_forcing(forcing)?, RESTITUTION)?, state));
        }
        progress.start(starts.len() as u64, "orbits");
        let verdicts = verdicts(&starts, settings, &advancing(progress))?;
        let orbits: Vec<Orbit> =
            starts.iter().map(|(map, state)| map.orbit(*state, ChatterPolicy::Complete)).collect();
        let diagram = orbit_diagram(&orbits, SKIPPED, drawn, &Unobserved)?;
        let column = |(((map, _), verdict), impacts): ((&(ImpactMap, _), _), Vec<ImpactState>)| {
            let (kind, exponent) = judged(&verdict);
            let impact_phase_cycles = impacts.iter().map(|impact| impact.phase().cycles()).collect();
            Column { axial_forcing: map.vibration().axial_forcing(), kind, exponent, impact_phase_cycles }
        };
        Ok(starts.iter().zip(verdicts).zip(diagram).map(column).collect())
    }

    fn draw(data: &Vec<Column>) -> Result<Figure, ExperimentError> {
        const HEIGHT: f64 = 360.0;
        let margins = Margins { left: 46.0, right: 10.0, top: 12.0, bottom: 34.0 };
        let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 2, 1).margins(margins).gaps(0.0, 12.0);
        let x = || Axis::linear(FORCINGS.0, FORCINGS.1).ticks(Ticks::every(0.02).minor(4));
        let doubling = || {
            let stroke = Stroke::new(Colour::GREY, 0.6).dashed(Dash::Dashed);
            Rule::vertical(ImpactMap::first_doubling_forcing(RESTITUTION)).stroke(stroke)
        };
        let mut diagram = Panel::new(grid.cell(0, 0))
            .x(x().without_numbers())
            .y(Axis::linear(0.0, 1.0).label(r"$\tau_{imp}/2\pi$").ticks(Ticks::every(0.2).minor(4)))
            .letter("a")
            .layer(doubling());
        let mut exponents = Panel::new(grid.cell(1, 0))
            .x(x().label(r"$\Gamma$"))
            .y(Axis::linear(EXPONENTS.0, EXPONENTS.1)
                .label(r"exponent per impact")
                .ticks(Ticks::every(0.5).minor(5)))
            .letter("b")
            .layer(doubling())
            .layer(Rule::horizontal(0.0).stroke(Stroke::new(Colour::BLACK, 0.5)));
        for (kind, name, colour) in KINDS {
            let columns: Vec<&Column> = data.iter().filter(|column| column.kind == kind).collect();
            if columns.is_empty() {
                continue;
            }
            let phases = columns.iter().flat_map(|column| {
                column.impact_phase_cycles.iter().map(|phase| (column.axial_forcing, *phase))
            });
            diagram = diagram.layer(DensePoints::new(phases).colour(colour).radius(0.35).name(name));
            let points = columns
                .iter()
                .filter_map(|column| Some((column.axial_forcing, column.exponent?.max(EXPONENTS.0))));
            exponents = exponents.layer(DensePoints::new(points).radius(0.6).colour(colour));
        }
        Ok(Figure::new(DOUBLE_COLUMN, HEIGHT)
            .panels([diagram.legend(Legend::at(Corner::TopLeft).inset(24.0)), exponents]))
    }
}

/// The kind of a verdict, and its exponent per impact.
fn judged(verdict: &Verdict) -> (Kind, Option<f64>) {
    match *verdict {
        Verdict::Periodic { impacts, multipliers, .. } => {
            let exponent = ln(multipliers.spectral_radius()) / impacts as f64;
            (Kind::Periodic, exponent.is_finite().then_some(exponent))
        }
        Verdict::Chaotic { exponent, .. } => (Kind::Chaotic, Some(exponent)),
        Verdict::Chattering { cycle, .. } => match cycle.trust {
            CycleTrust::ChosenByRounding { exponent, .. } => (Kind::Rest, exponent),
            _ => (Kind::Rest, None),
        },
        Verdict::AtRest { .. } => (Kind::Rest, None),
        Verdict::Undecided {
            reason:
                UndecidedReason::ExponentNearZero { exponent, .. }
                | UndecidedReason::NoPeriodFound { exponent, .. }
                | UndecidedReason::TransientMayLast { exponent, .. },
            ..
        } => (Kind::Undecided, Some(exponent)),
        _ => (Kind::Undecided, None),
    }
}
