//! Beyond the paper: the branches of periodic orbits over the orbit diagram.

use bouncing_disk::core::orbits::{
    BifurcationKind, Branch, Continuation, ContinuationParameter, follow_attractor,
};
use bouncing_disk::core::sweep::orbit_diagram;
use bouncing_disk::core::{ChatterPolicy, Error, Launch, Orbit, Unobserved};
use bouncing_disk::motion::PAPER_CHATTER;
use bouncing_disk_plot::{
    Anchor, Axis, Colour, Corner, DOUBLE_COLUMN, Dash, DensePoints, Figure, Grid, Legend, Line, Margins,
    Marker, Panel, Scatter, Text, Ticks,
};
use serde::{Deserialize, Serialize};

use super::shared::{distinct_phases, map};
use crate::claims::paper;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Γ of the picture, and the pairs of one impact every k periods in it.
const RANGE: (f64, f64) = (0.30, 1.50);
const MOST_PERIODS: u64 = 4;

/// Branches that double one from another: from k = 1, and from the other pairs.
const DOUBLINGS: [usize; 2] = [3, 1];

/// So far above its birth a pair is picked up: below its doubling, which is 0.046 above it for k = 4.
const ABOVE_BIRTH: f64 = 0.02;

/// The first and the largest step of a continuation (arclength), and the most points of a branch.
const STEPS: (f64, f64, usize) = (0.002, 0.02, 20_000);

/// The phases of the picture begin here, so that both orbits of a pair meet in their fold and not at a seam.
const FIRST_PHASE: f64 = -0.3;

/// Γ and phase of impact (cycles).
type Dot = (f64, f64);

/// Branches of periodic orbits over the forcing.
#[derive(Debug)]
pub struct ExtraBranches;

/// The data of the branches of periodic orbits.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraBranchesData {
    restitution: f64,
    /// The attractors that begin with one impact every k periods, followed upwards, and a disk that has been
    /// at rest.
    followed: Vec<Dot>,
    from_rest: Vec<Dot>,
    branches: Vec<BranchLine>,
    /// The special points of all branches, by kind.
    folds: Vec<Dot>,
    doublings: Vec<Dot>,
    grazes: Vec<Dot>,
}

/// A branch of orbits.
#[derive(Debug, Serialize, Deserialize)]
struct BranchLine {
    doubled: bool,
    axial_forcings: Vec<f64>,
    stable: Vec<bool>,
    /// The phases of each impact at all points.
    impact_phase_cycles: Vec<Vec<f64>>,
}

impl Experiment for ExtraBranches {
    type Data = ExtraBranchesData;
    const ID: &'static str = "extra-branches";
    const TITLE: &'static str = "Branches of periodic orbits";
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(PAPER_CHATTER);

    fn caption(data: &ExtraBranchesData) -> String {
        format!(
            "Branches of periodic orbits over the orbit diagram (grey; light: of a disk that has been at rest) for ε = {}: solid \
             where they attract, dashed where not. Black: one impact every k periods, from the graze of the saddle through the \
             fold to the node; blue: the orbits that double from it. The phase is drawn from −0.3 on, so that both orbits of a \
             pair meet.",
            data.restitution
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraBranchesData, ExperimentError> {
        let restitution = paper::section_four()?.restitution;
        let (columns, transient, examined) = quality.choose((240, 600, 60), (1_800, 3_000, 200));
        let forcings: Vec<f64> =
            (0..columns).map(|k| RANGE.0 + (RANGE.1 - RANGE.0) * k as f64 / (columns - 1) as f64).collect();
        progress.start(MOST_PERIODS, "pairs");
        let (mut found, mut orbits) = (Vec::new(), Vec::new());
        for k in 1..=MOST_PERIODS {
            found.extend(branches(restitution, k)?);
            let born = birth(restitution, k);
            let above: Vec<f64> =
                forcings.iter().copied().filter(|forcing| *forcing > born + 0.002).collect();
            let start = map(above[0], restitution)?.period_one(k);
            if let Some(start) = start {
                for at in follow_attractor(restitution, above, start, transient, PAPER_CHATTER) {
                    let at = at?;
                    orbits.push((at.axial_forcing, at.map.orbit(at.state, PAPER_CHATTER)));
                }
            }
            progress.advance(1);
        }
        let mut rested = Vec::new();
        for &forcing in &forcings {
            let map = map(forcing, restitution)?;
            if let Some(phase) = map.vibration().separation_phase() {
                rested.push((forcing, map.orbit_from_launch(Launch::new(phase, 0.0)?, PAPER_CHATTER)));
            }
        }
        let marks = |kinds: fn(&BifurcationKind) -> bool| {
            let special = found.iter().flat_map(|(_, branch)| &branch.bifurcations);
            let marks = special.filter(|found| kinds(&found.kind)).flat_map(|found| {
                let forcing = found.point.parameter;
                found.point.orbit.states.iter().map(move |state| (forcing, state.phase().cycles()))
            });
            marks.collect()
        };
        Ok(ExtraBranchesData {
            restitution,
            followed: dots(orbits, 0, examined)?,
            from_rest: dots(rested, transient, examined)?,
            folds: marks(|kind| matches!(kind, BifurcationKind::Fold)),
            doublings: marks(|kind| matches!(kind, BifurcationKind::Doubling)),
            grazes: marks(|kind| matches!(kind, BifurcationKind::Graze { .. })),
            branches: found.iter().map(|(doubled, branch)| line(*doubled, branch)).collect(),
        })
    }

    fn draw(data: &ExtraBranchesData) -> Result<Figure, ExperimentError> {
        const HEIGHT: f64 = 300.0;
        let margins = Margins { left: 46.0, right: 10.0, top: 12.0, bottom: 34.0 };
        let cell = Grid::new(DOUBLE_COLUMN, HEIGHT, 1, 1).margins(margins).cell(0, 0);
        let dense = |dots: &[Dot], colour| {
            DensePoints::new(dots.iter().map(|dot| shown(*dot))).colour(colour).radius(0.3)
        };
        let mut panel = Panel::new(cell)
            .x(Axis::linear(RANGE.0, RANGE.1).label(r"$\Gamma$").ticks(Ticks::every(0.2).minor(4)))
            .y(Axis::linear(FIRST_PHASE, FIRST_PHASE + 1.0)
                .label(r"$\tau_{imp}/2\pi$")
                .ticks(Ticks::every(0.2).minor(4)))
            .markers_on_top()
            .layer(dense(&data.from_rest, Colour::LIGHT_GREY))
            .layer(dense(&data.followed, Colour::GREY));
        for (index, branch) in data.branches.iter().enumerate() {
            let colour = if branch.doubled { Colour::BLUE } else { Colour::BLACK };
            let first = index == 0 || branch.doubled && !data.branches[index - 1].doubled;
            let solid = Line::new(parts(branch, true)).colour(colour).width(1.5);
            let named = if branch.doubled { "doubled" } else { "one impact" };
            panel = panel
                .layer(Line::new(parts(branch, false)).colour(colour).width(0.7).dash(Dash::Dashed))
                .layer(if first && index < 3 { solid.name(named) } else { solid });
        }
        let marks = [
            (&data.folds, "fold", Marker::Square),
            (&data.doublings, "doubling", Marker::Circle),
            (&data.grazes, "graze", Marker::Cross),
        ];
        for (marks, name, marker) in marks {
            let points = marks.iter().map(|mark| shown(*mark));
            panel = panel
                .layer(Scatter::new(points).marker(marker).size(3.6).width(0.7).filled_white().name(name));
        }
        for k in 1..=MOST_PERIODS {
            let place = Text::at_data(birth(data.restitution, k) + 0.015, 0.0, format!("$k = {k}$"));
            panel = panel.layer(place.anchor(Anchor::LeftCentre).size(8.0).halo(Colour::WHITE));
        }
        Ok(Figure::new(DOUBLE_COLUMN, HEIGHT).panel(panel.legend(Legend::at(Corner::TopRight))))
    }
}

/// Γ from which on there are orbits with one impact every k periods.
fn birth(restitution: f64, k: u64) -> f64 {
    k as f64 * (1.0 - restitution) / (1.0 + restitution)
}

/// Both ways along a pair of one impact every k periods, and what doubles from it, from branch to branch.
fn branches(restitution: f64, k: u64) -> Result<Vec<(bool, Branch)>, ExperimentError> {
    let way = |rising: bool| {
        Continuation::new(ContinuationParameter::Forcing, RANGE, rising)?
            .with_steps(STEPS.0, STEPS.1, STEPS.2)
    };
    let map = map(birth(restitution, k) + ABOVE_BIRTH, restitution)?;
    let Some(pair) = map.period_one_pair(k) else { return Ok(Vec::new()) };
    let Some(node) = pair.node.orbit(&map)? else { return Ok(Vec::new()) };
    let mut all = vec![
        (false, map.continued(&node, &way(false)?, &Unobserved)?),
        (false, map.continued(&node, &way(true)?, &Unobserved)?),
    ];
    for _ in 0..DOUBLINGS[usize::from(k > 1)] {
        let last = &all[all.len() - 1].1;
        let doubling = last.bifurcations.iter().position(|found| found.kind == BifurcationKind::Doubling);
        let Some(index) = doubling else { break };
        all.push((true, last.switched(index, &way(true)?, &Unobserved)?));
    }
    Ok(all)
}

fn line(doubled: bool, branch: &Branch) -> BranchLine {
    let period = branch.points.first().map_or(0, |point| point.orbit.period());
    let phases = |impact: usize| {
        branch.points.iter().map(|point| point.orbit.states[impact].phase().cycles()).collect()
    };
    BranchLine {
        doubled,
        axial_forcings: branch.points.iter().map(|point| point.parameter).collect(),
        stable: branch.points.iter().map(|point| point.is_stable()).collect(),
        impact_phase_cycles: (0..period).map(phases).collect(),
    }
}

/// The impacts of orbits at their forcings; a periodic orbit repeats them, and each is kept once.
fn dots(orbits: Vec<(f64, Orbit)>, transient: usize, examined: usize) -> Result<Vec<Dot>, Error> {
    let (forcings, orbits): (Vec<f64>, Vec<Orbit>) = orbits.into_iter().unzip();
    let diagram = orbit_diagram(&orbits, transient, examined, &Unobserved)?;
    let columns = forcings.into_iter().zip(&diagram);
    Ok(columns
        .flat_map(|(forcing, impacts)| {
            distinct_phases(impacts).into_iter().map(move |phase| (forcing, phase))
        })
        .collect())
}

fn shown((forcing, cycles): Dot) -> Dot {
    (forcing, if cycles >= FIRST_PHASE + 1.0 { cycles - 1.0 } else { cycles })
}

/// The parts of a branch that attract, or that do not, broken elsewhere and at the seam.
fn parts(branch: &BranchLine, stable: bool) -> Vec<Dot> {
    let gap = (f64::NAN, f64::NAN);
    let mut points = Vec::new();
    for phases in &branch.impact_phase_cycles {
        for index in 1..phases.len() {
            let [from, to] = [index - 1, index].map(|at| shown((branch.axial_forcings[at], phases[at])));
            let drawn = branch.stable[index - 1] == stable && (to.1 - from.1).abs() < 0.5;
            points.extend(if drawn { [from, to, gap] } else { [gap; 3] });
        }
    }
    points
}
