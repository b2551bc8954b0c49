//! Fig. 9: the coefficient of friction from the deceleration of the rotor.

use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::estimate::{BrakingRotor, Spread};
use bouncing_disk::{Engine, Event, InitialCondition, Trajectory};
use bouncing_disk_plot::{
    Axis, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Grid, Legend, Line, Margins, Marker, Panel, Rect,
    Rule, Scatter, Ticks,
};
use serde::Serialize;

use super::shared::motor::MotorCase;
use super::shared::numbers::{Noise, StraightLine};
use crate::claims::paper;
use crate::experiment::{ExperimentError, Paper};

/// Fig. 9.
pub(crate) fn fig09(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    fig.seed("readings of the friction", SEED);
    let progress = fig.progress;
    progress.start(u64::from(PRELOADS), "preloads");
    let section = paper::section_five()?;
    let case = MotorCase::table_three()?;
    let [lowest, highest] = paper::preloads()?.measured_range_n;
    let rotor_mass_kg = section.rotor_mass_kg();
    let first_speed_rad_per_s = case.peak_angular_speed_rad_per_s;
    let share = |k: u32, count: u32| f64::from(k) / f64::from(count - 1);
    let curves = (0..PRELOADS)
        .map(|k| {
            let preload = lowest + share(k, PRELOADS) * (highest - lowest);
            progress.advance(1);
            curve(&case, rotor_mass_kg, preload, first_speed_rad_per_s)
        })
        .collect::<Result<Vec<_>, _>>()?;
    let printed_mean = paper::value("section5.mean_friction")?;
    let printed_deviation = paper::value("section5.friction_deviation")?;
    let mut noise = Noise::new(SEED);
    let synthetic: Vec<(f64, f64)> = (0..SYNTHETIC)
        .map(|k| {
            let friction = noise.log_normal(printed_mean, printed_deviation);
            (lowest + share(k, SYNTHETIC) * (highest - lowest), friction)
        })
        .collect();
    let frictions: Vec<f64> = synthetic.iter().map(|point| point.1).collect();
    let line = StraightLine::through(&synthetic);
    let data = &Fig09Data {
        case,
        rotor_mass_kg,
        first_speed_rad_per_s,
        curves,
        printed_mean,
        printed_deviation,
        synthetic_spread: Spread::of(&frictions)?,
        synthetic_slope_per_n: line.map_or(0.0, |line| line.slope),
        synthetic_slope_error_per_n: line.map_or(0.0, |line| line.slope_error),
        synthetic,
    };
    fig.caption(format!(
        "Determining the coefficient of friction between rotor and stator. (a) Speed of the model's rotor after the \
         motor is switched off at {} rad/s, at the lowest, the middle and the highest preload of Sec. V B, with the fitted \
         line −α̈_brake (t − t_c) (dashed) from which Eq. (17) gives μ; a residual vibration of the stator is not \
         modelled. (b) μ against preload: circles, recovered from the model's curves; dots, a synthetic record, not \
         measured, drawn from the log-normal distribution with the printed mean {} and standard deviation {} (seed {}); \
         line, the printed mean. The paper's points are not in its text.",
        data.first_speed_rad_per_s, data.printed_mean, data.printed_deviation, SEED
    ));
    fig.parameter("coefficient of friction μ of the model", data.case.friction);
    fig.parameter("contact radius a_e", format!("{} m", data.case.contact_radius_m));
    fig.parameter("radius of gyration a_g", format!("{} m", data.case.gyration_radius_m));
    fig.parameter("mass of the rotor", format!("{:.4} kg", data.rotor_mass_kg));
    fig.parameter(
        "synthetic record",
        format!(
            "mean {:.3}, standard deviation {:.3}, slope {:.2} ± {:.2} 1/N",
            data.synthetic_spread.mean,
            data.synthetic_spread.deviation,
            data.synthetic_slope_per_n,
            data.synthetic_slope_error_per_n
        ),
    );
    fig.draw(draw(data)?);
    fig.data(data)
}

fn draw(data: &Fig09Data) -> Result<Figure, ExperimentError> {
    const HEIGHT: f64 = 200.0;
    let margins = Margins { left: 40.0, right: 10.0, top: 8.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 1, 2).margins(margins).gaps(52.0, 20.0);
    Ok(Figure::new(DOUBLE_COLUMN, HEIGHT)
        .panel(speeds(grid.cell(0, 0), data))
        .panel(frictions(grid.cell(0, 1), data)))
}

/// Braking curves of the model, and a synthetic record.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Fig09Data {
    case: MotorCase,
    rotor_mass_kg: f64,
    /// The rotor's speed as the motor is switched off (rad/s): ωΦ, the most it can have.
    first_speed_rad_per_s: f64,
    curves: Vec<Curve>,
    printed_mean: f64,
    printed_deviation: f64,
    /// Synthetic, not measured: preload (N) and μ.
    synthetic: Vec<(f64, f64)>,
    synthetic_spread: Spread,
    /// Slope of the synthetic μ against preload (1/N) and its standard error.
    synthetic_slope_per_n: f64,
    synthetic_slope_error_per_n: f64,
}

/// A braking curve and its straight line, α̇ = −α̈_brake (t − t_c).
#[derive(Clone, Debug, PartialEq, Serialize)]
struct Curve {
    preload_n: f64,
    time_s: Vec<f64>,
    angular_speed_rad_per_s: Vec<f64>,
    /// Slope of the line (rad/s²) and the time (s) at which it reaches 0.
    brake_rad_per_s2: f64,
    stop_s: f64,
    /// μ by Eq. (17).
    friction: f64,
}

/// Preloads of the model and of the synthetic record, evenly over the range of Sec. V B; the record is made up.
const PRELOADS: u32 = 9;
const SYNTHETIC: u32 = 25;
const SEED: u64 = 9;

/// Speeds of a curve that the line is fitted to.
const SAMPLES: usize = 60;

/// The rotor on the still stator from `first_speed` to rest.
fn curve(case: &MotorCase, mass: f64, preload_n: f64, first_speed: f64) -> Result<Curve, ExperimentError> {
    let still =
        MotorCase { amplitude_m: 0.0, peak_angular_speed_rad_per_s: 0.0, phase_lag_rad: 0.0, ..*case };
    let system = MotorCase { preload_acceleration_m_per_s2: preload_n / mass, ..still }.system()?;
    let scales = system.scales();
    let phase = Phase::new(0.0)?;
    let start = InitialCondition::Contact { phase, angular_speed: first_speed / scales.angular_speed };
    let mut engine = Engine::new(system, start, ChatterPolicy::Complete)?;
    let braked = Trajectory::record(&mut engine, |record| record.event == Event::SlipToStick)?;
    let points: Vec<(f64, f64)> = braked
        .uniform(SAMPLES)
        .map(|snapshot| (scales.time_seconds(snapshot.time), scales.state(&snapshot.disk).angular_speed))
        .collect();
    fitted(&rotor(case, mass, preload_n), &points).map_err(ExperimentError::model)
}

fn rotor(case: &MotorCase, mass: f64, normal_force: f64) -> BrakingRotor {
    let (contact_radius, gyration_radius) = (case.contact_radius_m, case.gyration_radius_m);
    BrakingRotor { normal_force, mass, contact_radius, gyration_radius }
}

/// A curve that no straight line to rest can be fitted to.
#[derive(Debug, thiserror::Error)]
enum BrakingError {
    #[error("{found} speeds; legal is 3 or more")]
    TooFew { found: usize },
    #[error("the slope of the line is {slope:e} rad/s²; legal is a number below 0")]
    NotBraking { slope: f64 },
    #[error(transparent)]
    Rotor(#[from] bouncing_disk::Error),
}

/// A curve with the line through its points.
fn fitted(rotor: &BrakingRotor, points: &[(f64, f64)]) -> Result<Curve, BrakingError> {
    let too_few = BrakingError::TooFew { found: points.len() };
    let line = StraightLine::through(points).ok_or(too_few)?;
    let stop_s = -line.intercept / line.slope;
    if line.slope >= 0.0 || !stop_s.is_finite() {
        return Err(BrakingError::NotBraking { slope: line.slope });
    }
    Ok(Curve {
        preload_n: rotor.normal_force,
        time_s: points.iter().map(|point| point.0).collect(),
        angular_speed_rad_per_s: points.iter().map(|point| point.1).collect(),
        brake_rad_per_s2: line.slope,
        stop_s,
        friction: rotor.friction(line.slope)?,
    })
}

impl Curve {
    fn points(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.time_s.iter().copied().zip(self.angular_speed_rad_per_s.iter().copied())
    }

    /// The line from `start` until it reaches 0.
    fn line(&self, start: f64) -> Line {
        let first = self.brake_rad_per_s2 * (start - self.stop_s);
        Line::new([(start, first), (self.stop_s, 0.0)]).dash(Dash::Dashed)
    }
}

fn speeds(area: Rect, data: &Fig09Data) -> Panel {
    let last = data.curves.iter().map(|curve| curve.stop_s).fold(0.0, f64::max);
    let top = 1.1 * data.first_speed_rad_per_s;
    let mut panel = Panel::new(area)
        .letter_in("a", Corner::BottomLeft)
        .x(Axis::linear(0.0, 1.05 * last).label(r"$t$ (s)"))
        .y(Axis::linear(0.0, top).label(r"$\dot{\alpha}$ (rad/s)").ticks(Ticks::every(10.0)));
    let shown = [0, data.curves.len() / 2, data.curves.len().saturating_sub(1)];
    let colours = [Colour::SKY, Colour::GREEN, Colour::VERMILION];
    let mut lines = Vec::new();
    for (index, colour) in shown.into_iter().zip(colours) {
        let Some(curve) = data.curves.get(index) else { continue };
        let name = format!("{:.0} mN", 1e3 * curve.preload_n);
        panel = panel.layer(Line::new(curve.points()).colour(colour).width(2.4).name(name));
        lines.push(curve.line(0.0));
    }
    if let Some(line) = lines.pop() {
        panel = panel.layers(lines).layer(line.name("straight line"));
    }
    panel.legend(Legend::at(Corner::TopRight))
}

fn frictions(area: Rect, data: &Fig09Data) -> Panel {
    let milli = |points: &[(f64, f64)]| points.iter().map(|(n, mu)| (1e3 * n, *mu)).collect::<Vec<_>>();
    let recovered: Vec<_> = data.curves.iter().map(|curve| (1e3 * curve.preload_n, curve.friction)).collect();
    let panel = Panel::new(area)
        .letter_in("b", Corner::TopRight)
        .x(Axis::linear(60.0, 300.0).label("preload (mN)").ticks(Ticks::every(40.0)))
        .y(Axis::linear(0.0, 0.36).label(r"$\mu$").ticks(Ticks::every(0.1)))
        .layer(Rule::horizontal(data.printed_mean).name("printed mean"))
        .layer(
            Scatter::new(milli(&data.synthetic))
                .size(2.6)
                .colour(Colour::GREY)
                .name("synthetic, not measured"),
        )
        .layer(Scatter::new(recovered).marker(Marker::Circle).colour(Colour::BLUE).name("model, Eq. (17)"));
    panel.legend(Legend::at(Corner::TopLeft))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fit(points: &[(f64, f64)]) -> Result<Curve, BrakingError> {
        let rotor =
            BrakingRotor { normal_force: 0.2, mass: 1e-2, contact_radius: 5e-3, gyration_radius: 1e-2 };
        fitted(&rotor, points)
    }

    #[test]
    fn the_slope_gives_the_friction() {
        // Synthetic: 20 − 100 t.
        let curve = fit(&[(0.0, 20.0), (0.1, 10.0), (0.15, 5.0)]).expect("brakes");
        assert!((curve.brake_rad_per_s2 + 100.0).abs() < 1e-9 && (curve.stop_s - 0.2).abs() < 1e-12);
        // 1e-6 · 100/(5e-3 · 0.2)
        assert!((curve.friction - 0.1).abs() < 1e-12);
    }

    #[test]
    fn a_rotor_that_does_not_brake_is_refused() {
        let error = fit(&[(0.0, 1.0), (1.0, 2.0), (2.0, 3.0)]).expect_err("speeds up").to_string();
        assert!(error.contains("the slope of the line is 1e0"), "{error}");
        let error = fit(&[(0.0, 1.0)]).expect_err("one speed").to_string();
        assert!(error.contains("1 speeds; legal is 3 or more"), "{error}");
    }
}
