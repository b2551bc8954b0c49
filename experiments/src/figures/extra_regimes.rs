//! Beyond the paper: the long-term motion of a disk, over forcing and restitution.

use std::f64::consts::{FRAC_1_PI, TAU};

use bouncing_disk::core::attractors::{Verdict, VerdictSettings, verdicts};
use bouncing_disk::core::{ChatterPolicy, ImpactMap, ImpactState, Phase, Vibration};
use bouncing_disk_plot::pictures::{REGIMES, key};
use bouncing_disk_plot::{
    Axis, Colour, DOUBLE_COLUMN, Dash, Figure, Line, Panel, Raster, Rect, Rule, Stroke, Ticks,
};
use serde::{Deserialize, Serialize};

use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::{Progress, advancing};

/// Γ and restitutions of the map.
const FORCINGS: (f64, f64) = (0.0, 3.0);
const RESTITUTIONS: (f64, f64) = (0.0, 0.95);

/// Points of the lines in closed form.
const POINTS: usize = 200;

/// Kinds of the data: those of the shared map that need no start of their own.
const KINDS: usize = 9;

/// Verdicts over forcing and restitution.
#[derive(Debug)]
pub struct ExtraRegimes;

/// The data of the map of verdicts.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraRegimesData {
    columns: usize,
    /// How long each orbit was followed.
    settings: VerdictSettings,
    /// The verdicts, row by row: of each column a digit, in the order of the key of the picture.
    rows: Vec<String>,
}

impl Experiment for ExtraRegimes {
    type Data = ExtraRegimesData;
    const ID: &'static str = "extra-regimes";
    const TITLE: &'static str = "What a disk does, over forcing and restitution";
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn caption(data: &ExtraRegimesData) -> String {
        format!(
            "What a disk does for good that first hits the platform as it rises fastest, with the speed of the period-1 orbit: at rest on a \
             platform that never falls away; thrown, chattering, and at rest in a cycle that doubles can follow exactly; in one that is \
             so long that its rounding chooses it; on an attracting periodic orbit of 1, 2, 3 or more impacts; chaotic, by an exponent more \
             than three standard errors above zero; undecided. Lines: birth and first doubling of the period-1 orbit, in closed \
             form, and Γ = 1/π, from which on the platform falls away (dotted). Each of {} by {} cells is followed for at most {} impacts, \
             and as many after a rest.",
            data.columns,
            data.rows.len(),
            data.settings.transient + data.settings.impacts,
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraRegimesData, ExperimentError> {
        let (columns, rows) = quality.choose((160, 120), (1_000, 1_000));
        let (transient, impacts) = quality.choose((300, 600), (1_000, 2_000));
        let settings = VerdictSettings { transient, impacts, longest_period: 64, tolerance: 1e-6 };
        let middle = |(from, to): (f64, f64), k: usize, count: usize| {
            from + (to - from) * (k as f64 + 0.5) / count as f64
        };
        let mut starts = Vec::with_capacity(columns * rows);
        for row in 0..rows {
            let restitution = middle(RESTITUTIONS, row, rows);
            // Where the platform rises fastest, with the speed of the period-1 orbit.
            let state = ImpactState::new(Phase::new(0.0)?, -TAU / (1.0 + restitution))?;
            for column in 0..columns {
                let vibration = Vibration::from_axial_forcing(middle(FORCINGS, column, columns))?;
                starts.push((ImpactMap::new(vibration, restitution)?, state));
            }
        }
        progress.start(starts.len() as u64, "cells");
        let verdicts = verdicts(&starts, settings, &advancing(progress))?;
        let row = |row: &[Verdict]| row.iter().map(|verdict| char::from(b'0' + kind(verdict))).collect();
        Ok(ExtraRegimesData { columns, settings, rows: verdicts.chunks(columns).map(row).collect() })
    }

    fn draw(data: &ExtraRegimesData) -> Result<Figure, ExperimentError> {
        let palette: Vec<Colour> = REGIMES.iter().take(KINDS).map(|(_, colour)| *colour).collect();
        let last = KINDS as u8 - 1;
        let cells =
            data.rows.iter().flat_map(|row| row.bytes().map(|own| own.saturating_sub(b'0').min(last)));
        let (x, y) = (FORCINGS, RESTITUTIONS);
        let along = |forcing: fn(f64) -> f64| {
            let restitutions = (0..=POINTS).map(move |k| y.0 + (y.1 - y.0) * k as f64 / POINTS as f64);
            Line::new(restitutions.map(move |restitution| (forcing(restitution), restitution))).width(0.7)
        };
        let map = Panel::new(Rect::new(40.0, 10.0, 350.0, 256.0))
            .x(Axis::linear(x.0, x.1).label(r"$\Gamma$").ticks(Ticks::every(0.5).minor(5)))
            .y(Axis::linear(y.0, y.1).label(r"restitution $\epsilon$").ticks(Ticks::every(0.2).minor(4)))
            .layer(Raster::new(data.columns, data.rows.len(), cells.collect(), &palette, x, y))
            .layer(along(|restitution| (1.0 - restitution) / (1.0 + restitution)).colour(Colour::BLACK))
            .layer(along(ImpactMap::first_doubling_forcing).colour(Colour::BLACK).dash(Dash::Dashed))
            .layer(Rule::vertical(FRAC_1_PI).stroke(Stroke::new(Colour::BLACK, 0.6).dashed(Dash::Dotted)));
        let names = (0..=last).zip(REGIMES.map(|(name, _)| name));
        let key = key(Rect::new(404.0, 40.0, 12.0, 171.0), &palette, names);
        Ok(Figure::new(DOUBLE_COLUMN, 300.0).panels([map, key]))
    }
}

/// The place of a verdict in [`REGIMES`].
fn kind(verdict: &Verdict) -> u8 {
    match verdict {
        Verdict::AtRest { .. } => 0,
        Verdict::Chattering { cycle, .. } if cycle.is_exact() => 1,
        Verdict::Chattering { .. } => 2,
        Verdict::Periodic { impacts, .. } => 2 + (*impacts).min(4) as u8,
        Verdict::Chaotic { .. } => 7,
        _ => 8,
    }
}
