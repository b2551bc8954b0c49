//! Beyond the paper: Fig. 6(a) for platforms that do not move as a sine.

mod two_cycle;

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI, TAU};

use bouncing_disk::core::attractors::driven_diagram;
use bouncing_disk::core::numerics::roots::bisection;
use bouncing_disk::core::{ChatterPolicy, Drive, DrivenMap, Error, ImpactState, Phase, Unobserved};
use bouncing_disk::motion::PAPER_CHATTER;
use bouncing_disk_plot::pictures::{IMPACT_PHASE, OrbitDiagram};
use bouncing_disk_plot::{
    Axis, Colour, DOUBLE_COLUMN, Dash, DensePoints, Figure, Grid, Line, Margins, Panel, Rect, Rule, Stroke,
    Ticks,
};
use serde::{Deserialize, Serialize};

use self::two_cycle::{Doubled, doubled};
use super::shared::{distinct_phases, map_in_parallel};
use crate::claims::paper;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Γ of the picture.
const RANGE: (f64, f64) = (0.16, 0.90);

/// The share of the period in which the sawtooth rises.
const RISE: f64 = 0.25;

/// The phases of the picture begin here, so that no period-1 orbit lies at a seam.
const FIRST_PHASE: f64 = -0.3;

/// Starts lie beside the orbits of one impact in this many periods, earlier by `BESIDE` (rad).
const PERIODS: [f64; 2] = [1.0, 2.0];
const BESIDE: f64 = 1e-3;

/// The colour of a disk that was at rest.
const RESTED: Colour = Colour::rgb(160, 160, 160);

/// Γ and phase of impact (cycles).
type Dot = (f64, f64);

/// How a platform moves, with the amplitude 1: the phase 0 is in its steepest rise.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
enum Shape {
    Sine,
    Triangle,
    Sawtooth,
    Parabolas,
    Spline,
    OneCubic,
}

const SHAPES: [(Shape, &str); 6] = [
    (Shape::Sine, "sine"),
    (Shape::Triangle, "triangle"),
    (Shape::Sawtooth, "sawtooth"),
    (Shape::Parabolas, "parabolas"),
    (Shape::Spline, "cubic spline"),
    (Shape::OneCubic, "one cubic"),
];

impl Shape {
    fn drive(self, amplitude: f64) -> Result<Drive, Error> {
        match self {
            Self::Sine => Drive::fourier(&[(amplitude, 0.0)]),
            Self::Triangle => Drive::triangle(amplitude),
            Self::Sawtooth => Drive::sawtooth(amplitude, RISE),
            Self::Parabolas => Drive::parabolas(amplitude),
            Self::Spline => Drive::cubics(amplitude),
            Self::OneCubic => {
                // c t (t - pi)(t - 2 pi), highest at pi (1 - 1/sqrt 3).
                let c = amplitude * 1.5 * 3.0_f64.sqrt() / (PI * PI * PI);
                Drive::pieces(&[(TAU, [0.0, 2.0 * PI * PI * c, -3.0 * PI * c, c])])
            }
        }
    }

    fn map(self, axial_forcing: f64, restitution: f64) -> Result<DrivenMap, Error> {
        DrivenMap::new(self.drive(PI * axial_forcing)?, restitution)
    }

    fn is_piecewise_linear(self) -> bool {
        matches!(self, Self::Triangle | Self::Sawtooth)
    }

    /// Γ from which on a platform rises fast enough for one impact every k periods; without curvature there
    /// are such orbits at this Γ alone.
    fn birth(self, restitution: f64, periods: f64) -> Result<f64, Error> {
        Ok(periods * ratio(restitution) / self.drive(1.0)?.velocity(0.0))
    }

    /// Γ at which this orbit doubles its period; `None` if it never attracts.
    fn doubling(self, restitution: f64, periods: f64) -> Result<Option<f64>, Error> {
        let unit = self.drive(1.0)?;
        let (rise, bend) = (PI * periods * ratio(restitution), critical_bend(restitution));
        let before = |phase: f64| {
            let at = unit.at(phase);
            rise * at.acceleration + bend * at.velocity > 0.0
        };
        if self.is_piecewise_linear() || !before(0.0) {
            return Ok(None);
        }
        let phase = bisection(0.0, FRAC_PI_2, 60, |phase| Ok::<_, Error>(before(phase)))?;
        Ok(Some(rise / unit.velocity(phase) * FRAC_1_PI))
    }

    /// An impact beside the orbit of one impact every k periods, or where the platform rises steepest.
    fn start(self, axial_forcing: f64, restitution: f64, periods: f64) -> Result<ImpactState, Error> {
        let (drive, rise) = (self.drive(PI * axial_forcing)?, PI * periods * ratio(restitution));
        let phase = bisection(0.0, FRAC_PI_2, 60, |phase| Ok::<_, Error>(drive.velocity(phase) > rise))?;
        ImpactState::new(Phase::new(phase - BESIDE)?, -TAU * periods / (1.0 + restitution))
    }
}

/// (1 - r)/(1 + r).
fn ratio(restitution: f64) -> f64 {
    (1.0 - restitution) / (1.0 + restitution)
}

/// The deceleration of the platform at which the orbits of one impact double, 2 (1 + r^2)/(1 + r)^2.
fn critical_bend(restitution: f64) -> f64 {
    1.0 + ratio(restitution) * ratio(restitution)
}

/// Orbit diagrams on six drives.
#[derive(Debug)]
pub struct ExtraDrives;

/// The data of the orbit diagrams on six drives.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraDrivesData {
    restitution: f64,
    diagrams: Vec<Diagram>,
}

/// The orbit diagram on one drive.
#[derive(Debug, Serialize, Deserialize)]
struct Diagram {
    shape: Shape,
    /// The orbits from beside those of one impact, and of a disk that was at rest.
    from_orbits: Vec<Dot>,
    from_rest: Vec<Dot>,
    /// Γ from which on, or at which alone, there is one impact every 1, 2 periods, and where it doubles.
    births: Vec<f64>,
    doublings: Vec<f64>,
    /// The 2-cycle of the first doubling, where it is in closed form.
    doubled: Option<Doubled>,
}

impl Experiment for ExtraDrives {
    type Data = ExtraDrivesData;
    const ID: &'static str = "extra-drives";
    const TITLE: &'static str = "The orbit diagram for drives that are no sine";
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(PAPER_CHATTER);

    fn caption(data: &ExtraDrivesData) -> String {
        format!(
            "Fig. 6(a) for six motions of the platform with the same period and amplitude (ε = {}): (a) the sine; (b) a triangle; (c) a \
             sawtooth that rises for {} of the period; (d) two parabolas; (e) four cubics, the spline through zeros and extremes of the \
             sine; (f) one cubic for the whole period. Dark: orbits that start beside those of one impact every 1 or 2 periods; grey, on \
             top: a disk that was at rest. Red, dotted: the forcings from which on these orbits exist, in (b) and (c) at which alone; blue, \
             dashed: their doublings. Blue lines: the orbit of two impacts that is born in the first doubling, in closed form, until an \
             impact comes to the joint of two pieces at phase 0.",
            data.restitution, RISE
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraDrivesData, ExperimentError> {
        let restitution = paper::section_four()?.restitution;
        progress.start(SHAPES.len() as u64, "drives");
        let diagrams = SHAPES.iter().map(|(shape, _)| {
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
        let panels = data.diagrams.iter().zip(SHAPES).enumerate().map(|(index, (diagram, (_, name)))| {
            let (row, column) = (index / 3, index % 3);
            let x = Axis::linear(RANGE.0, RANGE.1).ticks(Ticks::every(0.2).minor(4));
            let y = Axis::linear(FIRST_PHASE, FIRST_PHASE + 1.0).ticks(Ticks::every(0.2).minor(4));
            let letter = ["a", "b", "c", "d", "e", "f"][index];
            panel(diagram, grid.cell(row, column))
                .title(format!("({letter}) {name}"))
                .x(if row == 0 { x.without_numbers() } else { x.label(r"$\Gamma$") })
                .y(if column == 0 { y.label(IMPACT_PHASE) } else { y.without_numbers() })
        });
        Ok(Figure::new(DOUBLE_COLUMN, HEIGHT).panels(panels))
    }
}

fn diagram(shape: Shape, restitution: f64, quality: Quality) -> Result<Diagram, ExperimentError> {
    let (columns, transient, kept) = quality.choose((120, 400, 20), (480, 2_000, 80));
    let forcings: Vec<f64> =
        (0..columns).map(|k| RANGE.0 + (RANGE.1 - RANGE.0) * f64::from(k) / f64::from(columns - 1)).collect();
    let maps = map_in_parallel(&forcings, |forcing| Ok(shape.map(*forcing, restitution)?))?;
    let dots = |columns: &[Vec<ImpactState>]| -> Vec<Dot> {
        let columns = forcings.iter().zip(columns);
        columns
            .flat_map(|(forcing, impacts)| {
                distinct_phases(impacts).into_iter().map(|phase| (*forcing, phase))
            })
            .collect()
    };
    let resting = ImpactState::new(Phase::new(-FRAC_PI_2)?, 0.0)?;
    let from_rest = driven_diagram(&maps, resting, transient, kept, PAPER_CHATTER, &Unobserved)?;
    let mut from_orbits = Vec::new();
    for periods in PERIODS {
        let columns = map_in_parallel(&forcings, |forcing| {
            let map = [shape.map(*forcing, restitution)?];
            let start = shape.start(*forcing, restitution, periods)?;
            Ok(driven_diagram(&map, start, transient, kept, PAPER_CHATTER, &Unobserved)?.concat())
        })?;
        from_orbits.extend(dots(&columns));
    }
    let births = PERIODS.map(|periods| shape.birth(restitution, periods));
    let doublings = PERIODS.map(|periods| shape.doubling(restitution, periods));
    Ok(Diagram {
        shape,
        from_orbits,
        from_rest: dots(&from_rest),
        births: births.into_iter().collect::<Result<_, _>>()?,
        doublings: doublings.into_iter().filter_map(Result::transpose).collect::<Result<_, _>>()?,
        doubled: doubled(shape, restitution)?,
    })
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
    let branch = diagram.doubled.iter().flat_map(|doubled| [&doubled.first, &doubled.second]);
    Panel::new(area)
        .layer(dots(&diagram.from_orbits, OrbitDiagram::ALONE))
        .layer(dots(&diagram.from_rest, RESTED))
        .layers(rules(&diagram.births, Colour::VERMILION, Dash::Dotted))
        .layers(rules(&diagram.doublings, Colour::BLUE, Dash::Dashed))
        .layers(branch.map(|points| Line::new(points.iter().copied()).colour(Colour::BLUE).width(1.2)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Silent;

    const PAGE: &str = include_str!("../../../docs/studying-the-dynamics.md");

    /// On a slope u, k periods on, the disk meets the platform 2 pi k (sqrt(u/u_k) - 1) later with the speed of
    /// the impact before: at the birth anywhere, with the multipliers 1 and r^2.
    #[test]
    fn impacts_of_one_speed_drift_along_a_slope() {
        for (shape, restitution, periods, steeper) in [
            (Shape::Triangle, 0.5, 1.0, 1.0),
            (Shape::Triangle, 0.7, 2.0, 1.02),
            (Shape::Sawtooth, 0.6, 1.0, 1.0),
            (Shape::Sawtooth, 0.6, 2.0, 1.01),
        ] {
            let map = shape.map(steeper * shape.birth(restitution, periods).unwrap(), restitution).unwrap();
            let slope = map.drive().velocity(0.0);
            let speed = (2.0 * TAU * periods * slope / (1.0 - restitution * restitution)).sqrt();
            let before = ImpactState::new(Phase::new(0.3).unwrap(), -speed).unwrap();
            let (landing, derivative) = map.step_with_derivative(before).unwrap();
            let drift = TAU * periods * (f64::sqrt(steeper) - 1.0);
            let impact = landing.impact;
            assert!((impact.phase.angle() - 0.3 - drift).abs() < 1e-13, "{shape:?} {impact:?}");
            assert!((impact.velocity + speed).abs() < 1e-12 && impact.turns == periods as u64);
            assert!((derivative.x_axis - glam::DVec2::X).length() < 1e-12);
            assert!((derivative.determinant() - restitution * restitution).abs() < 1e-12);
        }
    }

    /// One impact every k periods is where the platform rises with pi k (1 - r)/(1 + r), and doubles where the
    /// multipliers are -1 and -r^2.
    #[test]
    fn the_map_doubles_where_the_closed_form_says() {
        for (shape, _) in SHAPES.into_iter().filter(|(shape, _)| !shape.is_piecewise_linear()) {
            for restitution in [0.5, 0.8] {
                let forcing = shape.doubling(restitution, 1.0).unwrap().expect("attracts before");
                let map = shape.map(forcing, restitution).unwrap();
                let orbit = map.refine(&[shape.start(forcing, restitution, 1.0).unwrap()]).unwrap();
                let trace = orbit.monodromy.x_axis.x + orbit.monodromy.y_axis.y;
                assert!((trace + 1.0 + restitution * restitution).abs() < 1e-11, "{shape:?} {trace}");
                assert!(forcing > shape.birth(restitution, 1.0).unwrap() && orbit.platform_periods == 1);
            }
        }
    }

    /// What the literature claims, as the page has it.
    #[test]
    fn the_page_has_the_verdicts_of_the_data() {
        let data = ExtraDrives::compute(Quality::Draft, &Silent).unwrap();
        let of = |shape| {
            let diagram = data.diagrams.iter().find(|diagram| diagram.shape == shape).unwrap();
            (diagram, diagram.doubled.as_ref().unwrap(), diagram.births[0], diagram.doublings[0])
        };
        let (_, arcs, arcs_born, arcs_double) = of(Shape::Parabolas);
        let (_, spline, _, spline_doubles) = of(Shape::Spline);
        let (_, cubic, cubic_born, cubic_doubles) = of(Shape::OneCubic);
        let (on_arcs, on_cubic) = (arcs.beyond.as_ref().unwrap(), cubic.beyond.as_ref().unwrap());
        let corner = |beyond: &two_cycle::Beyond| {
            beyond.has_two_bands
                && beyond.exponent > 0.1
                && beyond.multiplier > 1.0
                && beyond.first_phase < 0.0
        };
        let (spline_to, cubic_to) = (spline.attracts_to.unwrap(), cubic.attracts_to.unwrap());
        let rises = |doubled: &Doubled| doubled.first.windows(2).all(|pair| pair[0].0 < pair[1].0);
        let at_once = arcs.first.iter().all(|dot| (dot.0 - arcs_double).abs() < 1e-14);
        let misfit = spline.misfit.max(cubic.misfit);
        let rows = [
            (
                "quadratic | fixed points, 2-cycles",
                format!("one impact from Γ = {arcs_born:.4} to {arcs_double:.4}; there a family of 2-cycles"),
                arcs_born < arcs_double && at_once && arcs.misfit < 1e-13,
            ),
            (
                "quadratic | chaotic bands out of unstable 2-cycles in a corner-type bifurcation",
                format!(
                    "at Γ = {:.4} two bands, exponent {:.2}; 2-cycle over the corner, multiplier {:.1}",
                    on_arcs.axial_forcing, on_arcs.exponent, on_arcs.multiplier
                ),
                corner(on_arcs) && arcs.attracts_to.is_none(),
            ),
            (
                "cubic | fixed points, 2-cycles, chaotic bands",
                format!(
                    "(f): one impact from Γ = {cubic_born:.4} to {cubic_doubles:.4}, a 2-cycle to {cubic_to:.4}, two bands with \
                     exponent {:.2} at {:.4}",
                    on_cubic.exponent, on_cubic.axial_forcing
                ),
                corner(on_cubic) && cubic_born < cubic_doubles && cubic_doubles < cubic_to,
            ),
            (
                "piecewise | the diagram changes qualitatively with the order",
                format!(
                    "an attracting 2-cycle: degree 2 nowhere, degree 3 to Γ = {spline_to:.4} (e), {cubic_to:.4} (f)"
                ),
                arcs.attracts_to.is_none() && spline_to > spline_doubles && cubic_to > cubic_doubles,
            ),
            (
                "piecewise | a curve for the cubic's branch near the doubling fits the numerical one",
                format!("it rises from the doubling; exact, misfit {misfit:.0e}"),
                rises(spline) && rises(cubic) && misfit < 1e-13,
            ),
        ];
        for (claim, found, holds) in rows {
            let row =
                format!("| {claim} | {found} | {} |", if holds { "reproduced" } else { "not reproduced" });
            assert!(PAGE.contains(&row), "{row}");
        }
    }
}
