//! Beyond the paper: Fig. 6(a) for platforms that do not move as a sine. The closed forms are derived in
//! `docs/studying-the-dynamics.md`.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI, TAU};

use bouncing_disk::core::attractors::driven_diagram;
use bouncing_disk::core::numerics::elementary::ln;
use bouncing_disk::core::numerics::roots::bisection;
use bouncing_disk::core::{
    ChatterPolicy, Drive, DrivenMap, DrivenOrbit, Error, ImpactState, Phase, Unobserved,
};
use bouncing_disk::motion::PAPER_CHATTER;
use bouncing_disk_plot::pictures::{IMPACT_PHASE, OrbitDiagram};
use bouncing_disk_plot::{
    Axis, Colour, DOUBLE_COLUMN, Dash, DensePoints, Figure, Grid, Line, Margins, Panel, Rect, Rule, Stroke,
    Ticks,
};
use glam::{DMat2, DVec2};
use serde::{Deserialize, Serialize};

use super::shared::distinct_phases;
use crate::claims::paper;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Γ of the picture. Its phases begin where no period-1 orbit lies at a seam.
const RANGE: (f64, f64) = (0.16, 0.90);
const FIRST_PHASE: f64 = -0.3;

/// The share of the period in which the sawtooth rises.
const RISE: f64 = 0.25;

/// Starts lie beside the orbits of one impact in this many periods, earlier by `BESIDE` (rad).
const PERIODS: [f64; 2] = [1.0, 2.0];
const BESIDE: f64 = 1e-3;

/// Points of a branch; its multipliers nearer to one than `NEUTRAL` are those of a neutral family.
const POINTS: u32 = 64;
const NEUTRAL: f64 = 1e-9;

/// Where a branch ends in a corner, the motion at a forcing that is higher by this share is judged, over
/// `JUDGED` impacts after `SETTLING` ones.
const BEYOND: f64 = 1e-3;
const SETTLING: usize = 2_000;
const JUDGED: usize = 20_000;

/// A drive of this amplitude; at phase 0 it rises steepest.
type Shape = fn(f64) -> Result<Drive, Error>;

const SHAPES: [(&str, Shape); 6] = [
    ("sine", |amplitude| Drive::fourier(&[(amplitude, 0.0)])),
    ("triangle", Drive::triangle),
    ("sawtooth", |amplitude| Drive::sawtooth(amplitude, RISE)),
    ("parabolas", Drive::parabolas),
    ("cubic spline", Drive::cubics),
    ("one cubic", |amplitude| {
        // c t (t - pi)(t - 2 pi), highest at pi (1 - 1/sqrt 3).
        let c = amplitude * 1.5 * 3.0_f64.sqrt() / (PI * PI * PI);
        Drive::pieces(&[(TAU, [0.0, 2.0 * PI * PI * c, -3.0 * PI * c, c])])
    }),
];

/// Orbit diagrams on six drives.
#[derive(Debug)]
pub struct ExtraDrives;

/// The data of the orbit diagrams on six drives.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraDrivesData {
    restitution: f64,
    diagrams: Vec<Diagram>,
}

/// Γ and phase of impact (cycles).
type Dot = (f64, f64);

/// The orbit diagram on one drive.
#[derive(Debug, Serialize, Deserialize)]
struct Diagram {
    /// The orbits from beside those of one impact, and of a disk that was at rest.
    from_orbits: Vec<Dot>,
    from_rest: Vec<Dot>,
    /// Γ from which on, or at which alone, there is one impact every 1, 2 periods, and where it doubles.
    births: Vec<f64>,
    doublings: Vec<f64>,
    /// The 2-cycle of the first doubling, where it is in closed form.
    branch: Option<Branch>,
}

/// The branch of a 2-cycle, up to where an impact is at the joint of two pieces.
#[derive(Debug, Serialize, Deserialize)]
struct Branch {
    first: Vec<Dot>,
    second: Vec<Dot>,
    /// The largest difference between an impact in closed form and that of the map.
    misfit: f64,
    /// Γ up to which it attracts; `None` if it does nowhere.
    attracts_to: Option<f64>,
    /// What follows, where the acceleration jumps at the joint.
    beyond: Option<Beyond>,
}

/// The motion just beyond the forcing at which an impact of a 2-cycle is in a corner of the acceleration.
#[derive(Debug, Serialize, Deserialize)]
struct Beyond {
    axial_forcing: f64,
    /// The larger multiplier of the 2-cycle, and whether one of its impacts is beyond the corner.
    multiplier: f64,
    is_over_corner: bool,
    /// Whether every second impact of an orbit is in an interval of its own; its exponent per impact.
    has_two_bands: bool,
    exponent: f64,
}

impl Experiment for ExtraDrives {
    type Data = ExtraDrivesData;
    const ID: &'static str = "extra-drives";
    const TITLE: &'static str = "The orbit diagram for drives that are no sine";
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(PAPER_CHATTER);

    fn caption(data: &ExtraDrivesData) -> String {
        format!(
            "Fig. 6(a) for six motions of the platform with the same period and amplitude (ε = {}): (a) the sine; (b) a triangle; (c) a \
             sawtooth that rises for {RISE} of the period; (d) two parabolas; (e) four cubics, the spline through zeros and extremes of \
             the sine; (f) one cubic for the whole period. Dark: orbits that start beside those of one impact every 1 or 2 periods; \
             grey, on top: a disk that was at rest. Red, dotted: the forcings from which on these orbits exist, in (b) and (c) at which \
             alone; blue, dashed: their doublings. Blue lines: the orbit of two impacts that is born in the first doubling, in closed \
             form, until an impact comes to the joint of two pieces at phase 0.",
            data.restitution
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraDrivesData, ExperimentError> {
        let restitution = paper::section_four()?.restitution;
        progress.start(SHAPES.len() as u64, "drives");
        let diagrams = SHAPES.iter().map(|(_, shape)| {
            let diagram = diagram(*shape, restitution, quality);
            progress.advance(1);
            diagram
        });
        Ok(ExtraDrivesData { restitution, diagrams: diagrams.collect::<Result<_, _>>()? })
    }

    fn draw(data: &ExtraDrivesData) -> Result<Figure, ExperimentError> {
        const HEIGHT: f64 = 380.0;
        let margins = Margins { left: 44.0, right: 10.0, top: 20.0, bottom: 34.0 };
        let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 2, 3).margins(margins).gaps(10.0, 24.0);
        let panels = data.diagrams.iter().zip(SHAPES).enumerate().map(|(index, (diagram, (name, _)))| {
            let (row, column) = (index / 3, index % 3);
            let x = Axis::linear(RANGE.0, RANGE.1).ticks(Ticks::every(0.2).minor(4));
            let y = Axis::linear(FIRST_PHASE, FIRST_PHASE + 1.0).ticks(Ticks::every(0.2).minor(4));
            panel(diagram, grid.cell(row, column))
                .title(format!("({}) {name}", ["a", "b", "c", "d", "e", "f"][index]))
                .x(if row == 0 { x.without_numbers() } else { x.label(r"$\Gamma$") })
                .y(if column == 0 { y.label(IMPACT_PHASE) } else { y.without_numbers() })
        });
        Ok(Figure::new(DOUBLE_COLUMN, HEIGHT).panels(panels))
    }
}

fn panel(diagram: &Diagram, area: Rect) -> Panel {
    let shown =
        |(forcing, phase): Dot| (forcing, if phase >= FIRST_PHASE + 1.0 { phase - 1.0 } else { phase });
    let dots = |dots: &[Dot], colour| {
        DensePoints::new(dots.iter().map(|dot| shown(*dot))).colour(colour).radius(0.3)
    };
    let rules = |forcings: &[f64], colour, dash| {
        let stroke = Stroke::new(colour, 0.7).dashed(dash);
        forcings.iter().map(|forcing| Rule::vertical(*forcing).stroke(stroke)).collect::<Vec<_>>()
    };
    let branch = diagram.branch.iter().flat_map(|branch| [&branch.first, &branch.second]);
    Panel::new(area)
        .layer(dots(&diagram.from_orbits, OrbitDiagram::ALONE))
        .layer(dots(&diagram.from_rest, Colour::rgb(160, 160, 160)))
        .layers(rules(&diagram.births, Colour::VERMILION, Dash::Dotted))
        .layers(rules(&diagram.doublings, Colour::BLUE, Dash::Dashed))
        .layers(branch.map(|points| Line::new(points.iter().copied()).colour(Colour::BLUE).width(1.2)))
}

fn diagram(shape: Shape, restitution: f64, quality: Quality) -> Result<Diagram, ExperimentError> {
    let (columns, transient, kept) = quality.choose((120, 400, 20), (480, 2_000, 80));
    let forcings: Vec<f64> =
        (0..columns).map(|k| RANGE.0 + (RANGE.1 - RANGE.0) * f64::from(k) / f64::from(columns - 1)).collect();
    let dots = |start: &dyn Fn(DrivenMap) -> Result<DrivenOrbit, Error>| -> Result<Vec<Dot>, Error> {
        let orbits = forcings.iter().map(|forcing| start(DrivenMap::new(shape(PI * forcing)?, restitution)?));
        let orbits = orbits.collect::<Result<Vec<_>, _>>()?;
        let columns = driven_diagram(&orbits, transient, kept, &Unobserved)?;
        let columns = forcings.iter().zip(&columns);
        let dots = columns
            .flat_map(|(forcing, column)| distinct_phases(column).into_iter().map(|phase| (*forcing, phase)));
        Ok(dots.collect())
    };
    let (unit, rises) = (shape(1.0)?, PERIODS.map(|periods| PI * periods * ratio(restitution)));
    let mut from_orbits = Vec::new();
    for (periods, rise) in PERIODS.into_iter().zip(rises) {
        // Where the platform no longer rises so fast, or, if it never does, where it rises fastest.
        from_orbits.extend(dots(&|map| {
            let rising = |phase| Ok::<_, Error>(map.drive().velocity(phase) > rise);
            let phase = Phase::new(bisection(0.0, FRAC_PI_2, 60, rising)? - BESIDE)?;
            Ok(map.orbit(ImpactState::new(phase, -TAU * periods / (1.0 + restitution))?, PAPER_CHATTER))
        })?);
    }
    Ok(Diagram {
        from_orbits,
        from_rest: dots(&|map| Ok(map.of_contact(-FRAC_PI_2, PAPER_CHATTER)))?,
        births: rises.iter().map(|rise| rise / unit.velocity(0.0) * FRAC_1_PI).collect(),
        doublings: rises.iter().filter_map(|rise| doubling(&unit, restitution, *rise)).collect(),
        branch: branch(shape, restitution)?,
    })
}

/// (1 - r)/(1 + r).
fn ratio(restitution: f64) -> f64 {
    (1.0 - restitution) / (1.0 + restitution)
}

/// The deceleration of the platform at which the orbits of one impact double, 2 (1 + r^2)/(1 + r)^2.
fn critical_bend(restitution: f64) -> f64 {
    1.0 + ratio(restitution) * ratio(restitution)
}

/// Whether the first piece of a drive is a line.
fn is_straight(unit: &Drive) -> bool {
    let start = unit.at(0.0);
    start.acceleration == 0.0 && start.jerk == 0.0
}

/// Γ at which the orbit that needs the velocity `rise` doubles; `None` if it never attracts.
fn doubling(unit: &Drive, restitution: f64, rise: f64) -> Option<f64> {
    let before = |phase: f64| {
        let at = unit.at(phase);
        rise * at.acceleration + critical_bend(restitution) * at.velocity > 0.0
    };
    let phase = bisection(0.0, FRAC_PI_2, 60, |phase| Ok::<_, Error>(before(phase))).ok()?;
    (before(0.0) && !is_straight(unit)).then(|| rise / unit.velocity(phase) * FRAC_1_PI)
}

/// The branch on a drive whose first piece is a curved cubic.
fn branch(shape: Shape, restitution: f64) -> Result<Option<Branch>, Error> {
    let unit = shape(1.0)?;
    let start = unit.at(0.0);
    if is_straight(&unit) || start.jerk - unit.at(BESIDE).jerk != 0.0 {
        return Ok(None);
    }
    let at = |apart| TwoCycle::new(shape, restitution, apart);
    let at_joint = bisection(0.0, PI, 60, |apart| Ok::<_, Error>(at(apart)?.phases[0] > 0.0))?;
    let (mut first, mut second, mut misfit) = (Vec::new(), Vec::new(), 0.0_f64);
    for k in 0..POINTS {
        let cycle = at(at_joint * f64::from(k) / f64::from(POINTS))?;
        first.push((cycle.axial_forcing, cycle.phases[0] / TAU));
        second.push((cycle.axial_forcing, cycle.phases[1] / TAU));
        misfit = misfit.max(cycle.round()?.0);
    }
    let attracts = |apart: f64| Ok::<_, Error>(at(apart)?.round()?.1);
    let attracts_to = if attracts(at_joint / f64::from(POINTS))? {
        Some(at(bisection(0.0, at_joint, 40, attracts)?)?.axial_forcing)
    } else {
        None
    };
    let beyond = if start.acceleration == 0.0 { None } else { Some(at(at_joint)?.beyond(shape)?) };
    Ok(Some(Branch { first, second, misfit, attracts_to, beyond }))
}

/// Two impacts in two periods, on the first piece of a drive or at its joint.
struct TwoCycle {
    axial_forcing: f64,
    phases: [f64; 2],
    states: [ImpactState; 2],
    map: DrivenMap,
}

impl TwoCycle {
    /// The one whose impacts are so far `apart` in phase (rad).
    fn new(shape: Shape, restitution: f64, apart: f64) -> Result<Self, Error> {
        let (unit, ratio, square) = (shape(1.0)?.at(0.0), ratio(restitution), apart * apart);
        let short = square / (6.0 * TAU);
        let amplitude = |middle: f64| {
            -critical_bend(restitution) / (unit.acceleration + unit.jerk * (middle - ratio * short))
        };
        let middle = bisection(0.0, FRAC_PI_2, 60, |middle| {
            let a = amplitude(middle);
            let velocity = a * (unit.velocity + middle * (unit.acceleration + 0.5 * unit.jerk * middle));
            let mean = (TAU * TAU - square) / (2.0 * TAU) * (ratio - a * unit.jerk * short);
            Ok::<_, Error>(a < 0.0 || velocity > mean - a * unit.jerk * square / 24.0)
        })?;
        let map = DrivenMap::new(shape(amplitude(middle))?, restitution)?;
        let phases = [middle - 0.5 * apart, middle + 0.5 * apart];
        let [one, two] = phases.map(|phase| map.drive().at(phase));
        let (rise, to_one, to_two) = (two.height - one.height, TAU - apart, TAU + apart);
        let states = [
            ImpactState::new(Phase::new(phases[0])?, -0.5 * to_one - rise / to_one - one.velocity)?,
            ImpactState::new(Phase::new(phases[1])?, -0.5 * to_two + rise / to_two - two.velocity)?,
        ];
        Ok(Self { axial_forcing: amplitude(middle) * FRAC_1_PI, phases, states, map })
    }

    /// By how much the map misses the impacts, and whether it attracts.
    fn round(&self) -> Result<(f64, bool), Error> {
        let (mut misfit, mut both) = (0.0_f64, DMat2::IDENTITY);
        for (from, to) in [(0, 1), (1, 0)] {
            let (landing, derivative) = self.map.step_with_derivative(self.states[from])?;
            let late = landing.impact.phase.angle() - self.states[to].phase().angle();
            misfit = misfit.max(late.abs()).max((landing.impact.velocity - self.states[to].velocity()).abs());
            both = derivative * both;
        }
        Ok((misfit, (both.x_axis.x + both.y_axis.y).abs() < 1.0 + both.determinant() - NEUTRAL))
    }

    /// From the 2-cycle at the corner to a slightly higher forcing.
    fn beyond(&self, shape: Shape) -> Result<Beyond, Error> {
        let axial_forcing = self.axial_forcing * (1.0 + BEYOND);
        let map = DrivenMap::new(shape(PI * axial_forcing)?, self.map.restitution())?;
        let mut state = ImpactState::new(Phase::new(-10.0 * BEYOND)?, self.states[0].velocity())?;
        let orbit = map.refine(&[state, self.states[1]])?;
        let (mut tangent, mut sum) = (DVec2::X, 0.0);
        let mut ends = [(f64::INFINITY, f64::NEG_INFINITY); 2];
        for index in 0..SETTLING + JUDGED {
            let (landing, derivative) = map.step_with_derivative(state)?;
            state = landing.impact.into();
            tangent = derivative * tangent;
            let (length, cycles) = (tangent.length(), state.phase().cycles());
            tangent /= length;
            if index >= SETTLING {
                sum += ln(length);
                let phase = if cycles > 0.5 { cycles - 1.0 } else { cycles };
                let (low, high) = ends[index % 2];
                ends[index % 2] = (low.min(phase), high.max(phase));
            }
        }
        Ok(Beyond {
            axial_forcing,
            multiplier: orbit.multipliers().spectral_radius(),
            is_over_corner: orbit.states[0].phase().cycles() > 0.5,
            has_two_bands: ends[0].1 < ends[1].0 || ends[1].1 < ends[0].0,
            exponent: sum / JUDGED as f64,
        })
    }
}

#[cfg(test)]
mod tests {
    use bouncing_disk::core::orbits::doubling_cascade;

    use super::*;
    use crate::progress::Silent;

    /// On a slope u, k periods on, the disk meets the platform 2 pi k (sqrt(u/u_k) - 1) later with the speed of
    /// the impact before, with the multipliers 1 and r^2.
    #[test]
    fn impacts_of_one_speed_drift_along_a_slope() {
        for (shape, periods, steeper) in [(1, 1.0, 1.0), (1, 2.0, 1.02), (2, 1.0, 1.0), (2, 2.0, 1.01)] {
            let (r, shape) = (0.6, SHAPES[shape].1);
            let slope = steeper * PI * periods * ratio(r);
            let map = DrivenMap::new(shape(slope / shape(1.0).unwrap().velocity(0.0)).unwrap(), r).unwrap();
            let speed = (2.0 * TAU * periods * slope / (1.0 - r * r)).sqrt();
            let before = ImpactState::new(Phase::new(0.3).unwrap(), -speed).unwrap();
            let (landing, derivative) = map.step_with_derivative(before).unwrap();
            let late = landing.impact.phase.angle() - 0.3;
            assert!((late - TAU * periods * (f64::sqrt(steeper) - 1.0)).abs() < 1e-13, "{landing:?}");
            assert!((landing.impact.velocity + speed).abs() < 1e-12, "{landing:?}");
            assert!(
                (derivative.x_axis - DVec2::X).length() < 1e-12 && landing.impact.turns == periods as u64
            );
            assert!((derivative.determinant() - r * r).abs() < 1e-12);
        }
    }

    /// What the literature claims, as the page has it.
    #[test]
    fn the_page_has_the_verdicts_of_the_data() {
        const PAGE: &str = include_str!("../../../docs/studying-the-dynamics.md");
        let data = ExtraDrives::compute(Quality::Draft, &Silent).unwrap();
        let [sine, _, _, arcs, spline, cubic] = data.diagrams.try_into().unwrap();
        let exact = doubling_cascade(data.restitution, 1, &Unobserved).unwrap().doublings[0].axial_forcing;
        assert!((sine.doublings[0] - exact).abs() < 1e-12);
        let ends = |diagram: &Diagram| (diagram.births[0], diagram.doublings[0]);
        let ((arcs_from, arcs_to), (cubic_from, cubic_to)) = (ends(&arcs), ends(&cubic));
        let spline_to = spline.doublings[0];
        let [arcs, spline, cubic] = [arcs, spline, cubic].map(|diagram| diagram.branch.unwrap());
        for (branch, doubling) in [(&arcs, arcs_to), (&spline, spline_to), (&cubic, cubic_to)] {
            assert!((branch.first[0].0 - doubling).abs() < 1e-12 && branch.misfit < 1e-13);
        }
        let corner = |beyond: &Beyond| {
            beyond.has_two_bands && beyond.exponent > 0.1 && beyond.multiplier > 1.0 && beyond.is_over_corner
        };
        let rises = |points: &[Dot]| points.windows(2).all(|pair| pair[0].0 < pair[1].0);
        let (on_arcs, on_cubic) = (arcs.beyond.unwrap(), cubic.beyond.unwrap());
        let (spline_last, cubic_last) = (spline.attracts_to.unwrap(), cubic.attracts_to.unwrap());
        let rows = [
            (
                format!("one impact from Γ = {arcs_from:.4} to {arcs_to:.4}; there a family of 2-cycles"),
                arcs_from < arcs_to && arcs.first.iter().all(|dot| (dot.0 - arcs_to).abs() < 1e-14),
            ),
            (
                format!(
                    "at Γ = {:.4} two bands, exponent {:.2}; a 2-cycle across the corner, multiplier {:.1}",
                    on_arcs.axial_forcing, on_arcs.exponent, on_arcs.multiplier
                ),
                corner(&on_arcs) && arcs.attracts_to.is_none(),
            ),
            (
                format!(
                    "(f): one impact from Γ = {cubic_from:.4} to {cubic_to:.4}, a 2-cycle to {cubic_last:.4}, two bands with \
                     exponent {:.2} at {:.4}",
                    on_cubic.exponent, on_cubic.axial_forcing
                ),
                corner(&on_cubic) && cubic_from < cubic_to && cubic_to < cubic_last,
            ),
            (
                format!(
                    "an attracting 2-cycle: degree 2 nowhere, degree 3 to Γ = {spline_last:.4} (e), {cubic_last:.4} (f)"
                ),
                arcs.attracts_to.is_none() && spline_last > spline_to && cubic_last > cubic_to,
            ),
            (
                format!("it rises from the doubling; exact, misfit {:.0e}", spline.misfit.max(cubic.misfit)),
                rises(&spline.first) && rises(&cubic.first),
            ),
        ];
        for (index, (found, holds)) in rows.into_iter().enumerate() {
            let verdict = match (holds, index) {
                (false, _) => "not reproduced",
                (true, 4) => "by our curve; theirs is not accessible",
                (true, _) => "reproduced",
            };
            let row = format!("| {found} | {verdict} |");
            assert!(PAGE.contains(&row), "{row}");
        }
    }
}
