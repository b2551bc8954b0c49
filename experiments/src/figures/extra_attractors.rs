//! Beyond the paper: all attractors of a map, and how much of its starts each of them has.

use std::f64::consts::PI;

use bouncing_disk::core::attractors::{
    Attractor, AttractorKind, AttractorSearch, BasinSettings, basin_fractions_over,
};
use bouncing_disk::core::{self, ChatterPolicy, ImpactMap, Unobserved, Vibration};
use bouncing_disk_plot::pictures::{IMPACT_PHASE, IMPACT_SPEED, key};
use bouncing_disk_plot::{
    Axis, Colour, Corner, DOUBLE_COLUMN, Figure, Legend, Marker, Panel, Raster, Rect, Scatter, Ticks,
};
use serde::{Deserialize, Serialize};

use crate::claims::paper;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::{Progress, advancing};

/// Γ of the two sweeps, and the restitution of the second.
const FORCINGS: [[f64; 2]; 2] = [[0.3, 1.2], [0.1, 1.0]];
const RESTITUTION: f64 = 0.8;

/// Γ of the basins, and the impacts after which a cell is undecided.
const BASINS: (f64, u32) = (0.35, 20_000);

/// The farthest that an attractor may move from one Γ to the next (rad).
const REACH: f64 = 0.3;

/// The least share that is drawn.
const LEAST: f64 = 3.0e-4;

/// Motions that are drawn alike, with their name and colour. The digits are platform periods for each impact.
const KINDS: [(&str, Colour); 7] = [
    ("rest", Colour::LIGHT_GREY),
    ("1", Colour::BLUE),
    ("2", Colour::GREEN),
    ("3", Colour::VERMILION),
    (r"$\geq 4$", Colour::PURPLE),
    ("other", Colour::ORANGE),
    ("no period", Colour::BLACK),
];

/// The colours of the labels of the basins: undecided, rest, and the attractors.
const LABELS: [Colour; 9] = [
    Colour::BLACK,
    Colour::WHITE,
    Colour::SKY,
    Colour::VERMILION,
    Colour::BLUE,
    Colour::GREEN,
    Colour::ORANGE,
    Colour::PURPLE,
    Colour::DARK_GREY,
];

/// Attractors over the forcing, and their basins at one.
#[derive(Debug)]
pub struct ExtraAttractors;

/// The data of the attractors over the forcing and at one of them.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraAttractorsData {
    search: AttractorSearch,
    sweeps: Vec<Sweep>,
    /// Top of |w_A Γ/(ωA)| of the basins: the bound of every attractor.
    top: f64,
    /// The labels of the cells, row by row: of each column a letter, `a` for an undecided one, `b` for rest,
    /// and so on.
    rows: Vec<String>,
    /// The attractors in the order of their labels.
    names: Vec<String>,
}

/// The kind of an attractor, its share of the starts, and the 95 % interval of this share.
type Found = (usize, f64, (f64, f64));

/// The attractors over the forcing for one restitution.
#[derive(Debug, Serialize, Deserialize)]
struct Sweep {
    restitution: f64,
    axial_forcings: Vec<f64>,
    /// The attractors at each Γ.
    found: Vec<Vec<Found>>,
}

impl Experiment for ExtraAttractors {
    type Data = ExtraAttractorsData;
    const ID: &'static str = "extra-attractors";
    const TITLE: &'static str = "All attractors, and the shares of their basins";
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn caption(data: &ExtraAttractorsData) -> String {
        let restitution = |index: usize| data.sweeps.get(index).map_or(f64::NAN, |sweep| sweep.restitution);
        format!(
            "All attractors of a disk, for the restitutions (a) {} and (b) {}: the share of the {} starts that end on each, spread evenly \
             over the region of impacts that no attractor can leave (95 % intervals are in the data). Colours: platform periods for \
             each impact. (c) Basins at Γ = {} and restitution {RESTITUTION}, up to the proven bound of the impact speed; the key gives \
             impacts and platform periods of each attractor.",
            restitution(0),
            restitution(1),
            data.search.starts(),
            BASINS.0,
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraAttractorsData, ExperimentError> {
        let (starts, impacts) = quality.choose((256, (1_000, 20_000)), (2_048, (2_000, 100_000)));
        let search = AttractorSearch::default().with_starts(starts)?.with_impacts(impacts.0, impacts.1)?;
        let (columns, cells) = quality.choose((18, 100), (180, 600));
        progress.start(2 * columns as u64, "forcings");
        let mut sweeps = Vec::new();
        for ([from, to], restitution) in
            FORCINGS.into_iter().zip([paper::section_four()?.restitution, RESTITUTION])
        {
            // Middles of equal parts of the range: its round ends are births of orbits.
            let middle = |k: usize| from + (to - from) * (k as f64 + 0.5) / columns as f64;
            let axial_forcings: Vec<f64> = (0..columns).map(middle).collect();
            let observer = advancing(progress);
            let over = basin_fractions_over(restitution, &axial_forcings, &search, REACH, &observer)?;
            let found = over.at.iter().map(|at| at.attractors.all().iter().map(found).collect()).collect();
            sweeps.push(Sweep { restitution, axial_forcings, found });
        }
        let map = ImpactMap::new(Vibration::from_axial_forcing(BASINS.0)?, RESTITUTION)?;
        let attractors = map.attractors(&search, &Unobserved)?;
        let top = map.impact_speed_bound() / PI;
        let grid = core::attractors::Grid::new(
            core::attractors::Axis::new(0.0, 1.0, cells)?,
            core::attractors::Axis::new(0.0, top, cells)?,
        )?;
        let settings = BasinSettings { max_impacts: BASINS.1, ..BasinSettings::default() };
        // Every row counts twice: known by points, then by cells.
        progress.start(2 * cells as u64, "rows");
        let basins = attractors.basins(grid, settings, &advancing(progress))?;
        let letter = |label: &u8| char::from(b'a' + (*label).min(25));
        Ok(ExtraAttractorsData {
            sweeps,
            top,
            rows: (0..cells).map(|row| basins.row(row).iter().map(letter).collect()).collect(),
            names: attractors.all().iter().map(name).collect(),
            search,
        })
    }

    fn draw(data: &ExtraAttractorsData) -> Result<Figure, ExperimentError> {
        let areas = [Rect::new(46.0, 12.0, 196.0, 150.0), Rect::new(296.0, 12.0, 196.0, 150.0)];
        let names = (1..LABELS.len() as u8).zip(data.names.iter().map(String::as_str));
        let sweeps = data.sweeps.iter().zip(areas).zip(["a", "b"]);
        Ok(Figure::new(DOUBLE_COLUMN, 400.0)
            .panels(sweeps.map(|((sweep, area), letter)| shares(sweep, area, letter)))
            .panel(basins(data, Rect::new(46.0, 206.0, 380.0, 158.0)))
            .panel(key(Rect::new(436.0, 220.0, 10.0, 130.0), &LABELS, names)))
    }
}

/// Impacts and platform periods of an attractor, if it has a period.
fn period(attractor: &Attractor) -> Option<(u64, u64)> {
    match &attractor.kind {
        AttractorKind::Periodic(known) => {
            Some((known.orbit().period() as u64, known.orbit().platform_periods))
        }
        _ => None,
    }
}

fn found(attractor: &Attractor) -> Found {
    let kind = match (&attractor.kind, period(attractor)) {
        (AttractorKind::Rest(_), _) => 0,
        (_, Some((impacts, periods))) if periods.is_multiple_of(impacts) => {
            (periods / impacts).min(4) as usize
        }
        (_, Some(_)) => 5,
        _ => 6,
    };
    (kind, attractor.starts.value(), attractor.starts.interval())
}

fn name(attractor: &Attractor) -> String {
    match (&attractor.kind, period(attractor)) {
        (AttractorKind::Rest(_), _) => "rest".to_owned(),
        (_, Some((impacts, periods))) => format!("{impacts}/{periods}"),
        _ => "no period".to_owned(),
    }
}

fn shares(sweep: &Sweep, area: Rect, letter: &str) -> Panel {
    let ends = (sweep.axial_forcings.first(), sweep.axial_forcings.last());
    let (low, high) = (ends.0.copied().unwrap_or(0.0), ends.1.copied().unwrap_or(1.0));
    // Room for a key below all that is drawn.
    let mut panel = Panel::new(area)
        .x(Axis::linear(low, high).label(r"$\Gamma$").ticks(Ticks::every(0.2).minor(4)))
        .y(Axis::log(1.0e-5, 1.5).label("share of the starts"))
        .letter_in(letter, Corner::BottomRight)
        .legend(Legend::at(Corner::BottomLeft).without_frame());
    for (kind, (name, colour)) in KINDS.into_iter().enumerate() {
        let all = sweep.found.iter().zip(&sweep.axial_forcings);
        let own = all.flat_map(|(found, forcing)| found.iter().map(move |found| (*forcing, *found)));
        let own: Vec<_> = own.filter(|(_, found)| found.0 == kind && found.1 >= LEAST).collect();
        if own.is_empty() {
            continue;
        }
        let dots = Scatter::new(own.iter().map(|(forcing, found)| (*forcing, found.1)));
        panel = panel.layer(dots.marker(Marker::Dot).size(1.3).colour(colour).name(name));
    }
    panel
}

fn basins(data: &ExtraAttractorsData, area: Rect) -> Panel {
    let last = LABELS.len() as u8 - 1;
    let cells = data.rows.iter().flat_map(|row| row.bytes().map(|own| own.saturating_sub(b'a').min(last)));
    let side = data.rows.len();
    Panel::new(area)
        .x(Axis::linear(0.0, 1.0).label(IMPACT_PHASE).ticks(Ticks::every(0.2).minor(2)))
        .y(Axis::linear(0.0, data.top).label(IMPACT_SPEED).ticks(Ticks::every(1.0).minor(2)))
        .letter("c")
        .layer(Raster::new(side, side, cells.collect(), &LABELS, (0.0, 1.0), (0.0, data.top)))
}
