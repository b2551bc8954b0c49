//! `bouncing-disk basins`: attractors and their basins.

use bouncing_disk::core::attractors::{
    ATTACHED, AfterRest, Attractor, AttractorKind, AttractorSearch, Attractors, Axis, BasinSettings, Grid,
    Label, UNDECIDED,
};
use bouncing_disk::core::orbits::PeriodicOrbit;
use bouncing_disk::drives::DrivenMap;
use bouncing_disk::parameters::Waveform;
use bouncing_disk::{Observer, Progress};
use serde::{Deserialize, Serialize};

use super::map::{ContactArgs, MapArgs, VERTICAL, and_shape, driven_map, is_rigid_sine, is_sine, map};
use super::prelude::*;

/// The forcing of the paper's Fig. 7(b), which has two attractors besides rest.
const FORCING: f64 = 0.486;

/// Attractors and their basins, in the plane of impact phase and speed
#[derive(Debug, Args)]
#[command(after_help = "\
First the attractors are found, without hints. Then each cell of the window shows the attractor that an impact at its \
centre reaches, as in Fig. 7 of the paper: phases in periods (tau_imp/2pi), speeds normalised, |w_A Gamma/(omega A)|. \
Labels in files: 0 undecided, 1 rest, 2 and more the other attractors in the order of the table; in .json each is \
two hexadecimal digits. A [drive] that is not a sine and --contact-periods take longer. See \
docs/studying-the-dynamics.md.

Examples:
  bouncing-disk basins --out basins.png
  bouncing-disk basins --axial-forcing 0.34 --cells 1000 --speed-range 0:5 --out basins.json
  bouncing-disk basins --cells 10000 --chunk 3/50 --out part-3.json")]
pub(crate) struct BasinsArgs {
    /// Axial forcing parameter Gamma = A omega^2/(pi g), a number. Taken from FILE, --preset or --set unless
    /// given; without these 0.486, as in the paper's Fig. 7(b)
    #[arg(help_heading = VERTICAL, long, short = 'G', value_name = "GAMMA", allow_hyphen_values = true)]
    axial_forcing: Option<Range>,
    #[command(flatten)]
    map: MapArgs,
    #[command(flatten)]
    contact: ContactArgs,
    /// Cells along each axis
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = 300)]
    cells: usize,
    /// Impact phases of the window, in periods
    #[arg(help_heading = OWN, long, alias = "phase", value_name = "LOW:HIGH", default_value = "0:1", allow_hyphen_values = true,
          value_parser = interval)]
    phase_range: [f64; 2],
    /// Normalised impact speeds of the window
    #[arg(help_heading = OWN, long, alias = "speed", allow_hyphen_values = true, value_name = "LOW:HIGH", default_value = "0:3",
          value_parser = interval)]
    speed_range: [f64; 2],
    /// Impacts after which a start is left undecided
    #[arg(help_heading = OWN, long, alias = "impacts", allow_negative_numbers = true, value_name = "N", default_value_t = BasinSettings::default().max_impacts)]
    max_impacts: u32,
    /// Starts of the search for attractors
    #[arg(help_heading = OWN, long, allow_negative_numbers = true, value_name = "N", default_value_t = AttractorSearch::default().starts())]
    starts: u32,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    output: OutputArgs,
}

pub(super) fn run(args: &BasinsArgs, context: Context) -> Result<()> {
    let given = args.map.begin(&args.output, Some(&args.grid), context)?;
    let Some((system, drive)) = given else { return Ok(()) };
    let (axial_forcing, restitution) = args.map.pair(&system, args.axial_forcing, FORCING)?;
    let job = BasinsJob {
        axial_forcing,
        restitution,
        cells: args.cells,
        phase_periods: args.phase_range,
        normalised_speed: args.speed_range,
        settings: BasinSettings { max_impacts: args.max_impacts, ..BasinSettings::default() },
        search: AttractorSearch::default().with_starts(args.starts)?,
        drive,
        contact_periods: args.contact.contact_periods,
    };
    grid::run(job, &args.grid, &args.output, context)
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BasinsJob {
    axial_forcing: f64,
    restitution: f64,
    cells: usize,
    phase_periods: [f64; 2],
    normalised_speed: [f64; 2],
    settings: BasinSettings,
    search: AttractorSearch,
    /// The shape of the height.
    #[serde(default, skip_serializing_if = "is_sine")]
    drive: Waveform,
    /// How long an impact lasts (periods).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    contact_periods: Option<f64>,
}

/// The attractors of the impacts.
pub(crate) enum Known {
    Sine(Attractors),
    /// Attractors on another drive, or with a compliant contact.
    Driven(Attractors<DrivenMap>),
}

impl Known {
    fn all(&self) -> &[Attractor] {
        match self {
            Self::Sine(found) => found.all(),
            Self::Driven(found) => found.all(),
        }
    }

    /// The attractors with their labels.
    fn labelled(&self) -> impl Iterator<Item = (Label, &Attractor)> {
        (ATTACHED..).zip(self.all())
    }
}

impl BasinsJob {
    fn window(&self) -> Result<Grid> {
        let axis = |option: &str, [low, high]: [f64; 2]| {
            let axis = Axis::new(low, high, self.cells)?;
            // Cells finer than the spacing of doubles would share one centre.
            if (1..self.cells).all(|cell| axis.centre(cell - 1) < axis.centre(cell)) {
                return Ok(axis);
            }
            let cells = self.cells;
            Err(Failure::Usage(format!(
                "{option}: {cells} cells from {low:?} to {high:?} have no distinct centres; widen the range or take \
                 fewer cells"
            )))
        };
        Ok(Grid::new(
            axis("--phase-range", self.phase_periods)?,
            axis("--speed-range", self.normalised_speed)?,
        )?)
    }
}

impl GridJob for BasinsJob {
    const COMMAND: &'static str = "basins";

    /// The labels of a row by phase, two hexadecimal digits each, because a list of numbers takes many times the
    /// memory.
    type Row = String;

    type Prepared = Known;

    fn rows(&self) -> usize {
        self.cells
    }

    fn prepare(&self, observer: &dyn Observer) -> Result<Known> {
        self.window()?;
        // The search is a small part of the work, and not part of the bar.
        let silent = |progress: Progress| observer.observe(Progress { done: 0, ..progress });
        if is_rigid_sine(&self.drive, self.contact_periods) {
            let map = map(self.axial_forcing, self.restitution)?;
            return Ok(Known::Sine(map.attractors(&self.search, &silent)?));
        }
        let map = driven_map(&self.drive, self.contact_periods, self.axial_forcing, self.restitution)?;
        Ok(Known::Driven(Attractors::find(&map, &self.search, &silent)?))
    }

    fn compute(&self, known: &Known, rows: Rows, observer: &dyn Observer) -> Result<Vec<String>> {
        let own = rows.len() as u64;
        // A row may count twice there.
        let within = |Progress { done, total }| {
            observer.observe(Progress { done: done * own / total.max(1), total: own })
        };
        let (window, settings) = (self.window()?, self.settings);
        let labelled = match known {
            Known::Sine(attractors) => attractors.basins_of_rows(window, rows, settings, &within)?,
            Known::Driven(attractors) => attractors.basins_of_rows(window, rows, settings, &within)?,
        };
        Ok(labelled.labels().chunks(self.cells).map(hexadecimal).collect())
    }

    fn report<'a>(&'a self, known: &'a Known, rows: &'a [String]) -> Result<Report<'a>> {
        let window = self.window()?;
        let labels = move || rows.iter().flat_map(|row| of_hexadecimal(row));
        let count = labels().count();
        if count != self.cells * self.cells {
            let cells = self.cells;
            return Err(Failure::Usage(format!(
                "the file has {count} labels, not one for each of {cells} by {cells} cells"
            )));
        }
        let mut counts = [0_u64; 256];
        labels().for_each(|label| counts[usize::from(label)] += 1);
        let legend = legend(known);
        let counted = |(label, words): &(Label, String)| (*label, words.clone(), counts[usize::from(*label)]);
        let all: Vec<(Label, String, u64)> = legend.iter().map(counted).collect();
        let columns = Columns::<(Label, String, u64)>::new()
            .column("label", "1", |row| u64::from(row.0))
            .column("attractor", "1", |row| row.1.clone())
            .column("cells", "1", |row| row.2)
            .column("share", "%", move |row| 100.0 * row.2 as f64 / count as f64);
        // Undecided cells are listed only if there are any.
        let shown = columns.to_text(all.iter().filter(|(label, _, count)| *label != UNDECIDED || *count > 0));
        let text = format!(
            "axial forcing {}, restitution {}, {} by {2} cells{}\n{shown}",
            self.axial_forcing,
            self.restitution,
            self.cells,
            and_shape(&self.drive, self.contact_periods)
        );
        let listed = move || {
            let all = all.clone().into_iter();
            all.map(|(label, words, count)| json!({ "label": label, "attractor": words, "cells": count }))
        };
        let figure = move || {
            let basins = pictures::Basins {
                title: pictures::forcing_and_restitution(self.axial_forcing, self.restitution)
                    + &and_shape(&self.drive, self.contact_periods),
                phases: self.phase_periods,
                speeds: self.normalised_speed,
                labels: &labels().collect::<Vec<_>>(),
                legend: &legend,
                impacts: &impacts(known),
            };
            basins.draw()
        };
        let table = move |to: &mut dyn Write| {
            let columns = Columns::<(f64, f64, Label)>::new()
                .column("impact_phase", "periods", |row| row.0)
                .column("normalised_impact_speed", "1", |row| row.1)
                .column("label", "1", |row| u64::from(row.2));
            let (phases, speeds) = (window.phase(), window.speed());
            let cell = |(index, label): (usize, Label)| {
                (phases.centre(index % phases.cells()), speeds.centre(index / phases.cells()), label)
            };
            columns.write_csv(to, labels().enumerate().map(cell))
        };
        Ok(Report {
            provenance: provenance("bouncing-disk basins", self)?.with_chatter_policy(self.settings.policy),
            text,
            table: Box::new(table),
            data: vec![
                ("labels", json::list(listed)),
                match known {
                    Known::Sine(attractors) => ("attractors", stored(attractors)?),
                    Known::Driven(attractors) => ("attractors", stored(attractors.all())?),
                },
                ("hexadecimal_labels_by_speed", stored(rows)?),
            ],
            figure: Some(Box::new(figure)),
        })
    }
}

fn hexadecimal(labels: &[Label]) -> String {
    labels.iter().map(|label| format!("{label:02x}")).collect()
}

/// The labels of a row. Invalid pairs of digits are skipped; the number of labels then shows the fault.
fn of_hexadecimal(row: &str) -> impl Iterator<Item = Label> + '_ {
    let pairs = row.as_bytes().chunks(2);
    pairs.filter_map(|pair| Label::from_str_radix(std::str::from_utf8(pair).ok()?, 16).ok())
}

/// The labels and their meanings, in order.
fn legend(known: &Known) -> Vec<(Label, String)> {
    let mut legend = vec![(UNDECIDED, "undecided".to_owned())];
    for (label, attractor) in known.labelled() {
        let words = match &attractor.kind {
            AttractorKind::Rest(AfterRest::StaysForEver) => "at rest for ever".to_owned(),
            AttractorKind::Rest(AfterRest::RestsAgain(cycle)) if cycle.is_exact() => cycle.to_string(),
            AttractorKind::Rest(AfterRest::RestsAgain(_)) => "rest, in a cycle set by rounding".to_owned(),
            AttractorKind::Rest(AfterRest::LeadsTo(number)) => {
                let to = known.labelled().nth(*number).map_or(ATTACHED, |(label, _)| label);
                format!("at rest, then to {to}")
            }
            AttractorKind::Periodic(known) => of_orbit(known.orbit()),
            AttractorKind::Marginal(orbit) => format!("{}, marginal", of_orbit(orbit)),
            AttractorKind::Rest(AfterRest::Several { .. }) => {
                "at rest, then one of several motions".to_owned()
            }
            AttractorKind::Rest(AfterRest::Undecided) => "at rest, then undecided".to_owned(),
            AttractorKind::Chaotic { exponent, standard_error, recurrence } => {
                let chaos = format!("chaos, exponent {exponent:.4} +- {standard_error:.4}");
                format!("{chaos}, {} orbits stay for {} impacts", recurrence.orbits, recurrence.impacts)
            }
            AttractorKind::Transient { lifetime, .. } => format!("chaotic transient, {lifetime}"),
            _ => "of another kind".to_owned(),
        };
        legend.push((label, words));
    }
    legend
}

fn of_orbit(orbit: &PeriodicOrbit) -> String {
    let counted = |count: u64, thing: &str| format!("{count} {thing}{}", if count == 1 { "" } else { "s" });
    format!("{} in {}", counted(orbit.period() as u64, "impact"), counted(orbit.platform_periods, "period"))
}

/// The impacts of the periodic attractors: label, phase (periods), normalised speed.
fn impacts(known: &Known) -> Vec<(Label, f64, f64)> {
    let periodic = known.labelled().filter_map(|(label, own)| Some((label, own.kind.orbit()?)));
    let of_orbit = |(label, orbit): (Label, &PeriodicOrbit)| {
        orbit
            .states
            .iter()
            .map(move |at| (label, at.phase().cycles(), at.normalised_speed()))
            .collect::<Vec<_>>()
    };
    periodic.flat_map(of_orbit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_written_and_read() {
        let all: Vec<Label> = (0..=Label::MAX).collect();
        let text = hexadecimal(&all);
        assert!(text.starts_with("000102") && text.ends_with("ff"));
        assert_eq!(of_hexadecimal(&text).collect::<Vec<_>>(), all);
        assert_eq!(of_hexadecimal("0g").count() + of_hexadecimal("").count(), 0);
    }
}
