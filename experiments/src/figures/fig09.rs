//! Fig. 9: the coefficient of friction from the deceleration of the rotor.

use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::estimate::{BrakingRotor, Spread};
use bouncing_disk::{Engine, Event, InitialCondition, Trajectory};
use bouncing_disk_plot::{
    Axis, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Grid, Legend, Line, Margins, Marker, Panel, Rule,
    Scatter, Ticks,
};
use serde::Serialize;

use super::shared::motor::MotorCase;
use super::shared::numbers::{Noise, StraightLine};
use crate::claims::paper;
use crate::experiment::{ExperimentError, Paper};

/// Preloads of the model and of the synthetic record, evenly over the range of Sec. V B; the record is made up.
const PRELOADS: u32 = 9;
const SYNTHETIC: u32 = 25;
const SEED: u64 = 9;

/// Points of a curve, which the line is fitted to.
const SAMPLES: usize = 60;

/// Fig. 9.
pub(crate) fn fig09(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    let case = MotorCase::table_three()?;
    let rotor_mass = paper::section_five()?.rotor_mass_kg();
    // The most that the rotor can have.
    let first_speed = case.peak_angular_speed_rad_per_s;
    let [lowest, highest] = paper::preloads()?.measured_range_n;
    let preload = |k: u32, count: u32| lowest + f64::from(k) / f64::from(count - 1) * (highest - lowest);
    let curves = (0..PRELOADS)
        .map(|k| braking(&case, rotor_mass, preload(k, PRELOADS), first_speed))
        .collect::<Result<Vec<_>, _>>()?;
    fig.record("case", &case)?;
    fig.record("rotor_mass_kg", &rotor_mass)?;
    fig.record("first_speed_rad_per_s", &first_speed)?;
    fig.record("curves", &curves)?;

    // Preload (N) and μ, not measured.
    let mean = paper::value("section5.mean_friction")?;
    let deviation = paper::value("section5.friction_deviation")?;
    let mut noise = Noise::new(fig.seed("readings of the friction", SEED));
    let synthetic: Vec<(f64, f64)> =
        (0..SYNTHETIC).map(|k| (preload(k, SYNTHETIC), noise.log_normal(mean, deviation))).collect();
    let spread = Spread::of(&synthetic.iter().map(|point| point.1).collect::<Vec<_>>())?;
    let (slope, slope_error) =
        StraightLine::through(&synthetic).map_or((0.0, 0.0), |line| (line.slope, line.slope_error));
    fig.record("printed_mean", &mean)?;
    fig.record("printed_deviation", &deviation)?;
    fig.record("synthetic", &synthetic)?;
    fig.record("synthetic_spread", &spread)?;
    fig.record("synthetic_slope_per_n", &slope)?;
    fig.record("synthetic_slope_error_per_n", &slope_error)?;

    fig.caption(format!(
        "The coefficient of friction between rotor and stator. (a) Speed of the model's rotor after the motor is switched off at \
         {} rad/s, at the lowest, middle and highest preload of Sec. V B; dashed: fitted lines −α̈_brake (t − t_c), from which \
         Eq. (17) gives μ. Residual vibration is not modelled. (b) Circles: μ from the model's curves. Dots: \
         synthetic, not measured, log-normal with the printed mean {} and standard deviation {} (seed {}). Line: the printed mean. \
         The paper's points are not in its text.",
        first_speed, mean, deviation, SEED
    ));
    fig.parameter("coefficient of friction μ of the model", case.friction);
    fig.parameter("contact radius a_e", format!("{} m", case.contact_radius_m));
    fig.parameter("radius of gyration a_g", format!("{} m", case.gyration_radius_m));
    fig.parameter("mass of the rotor", format!("{rotor_mass:.4} kg"));
    fig.parameter(
        "synthetic record",
        format!(
            "mean {:.3}, standard deviation {:.3}, slope {slope:.2} ± {slope_error:.2} 1/N",
            spread.mean, spread.deviation
        ),
    );

    const HEIGHT: f64 = 200.0;
    let margins = Margins { left: 40.0, right: 10.0, top: 8.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 1, 2).margins(margins).gaps(52.0, 20.0);
    let last = curves.iter().map(|curve| curve.stop_s).fold(0.0, f64::max);
    let mut speeds = Panel::new(grid.cell(0, 0))
        .letter_in("a", Corner::BottomLeft)
        .x(Axis::linear(0.0, 1.05 * last).label(r"$t$ (s)"))
        .y(Axis::linear(0.0, 1.1 * first_speed).label(r"$\dot{\alpha}$ (rad/s)").ticks(Ticks::every(10.0)));
    // The lowest, the middle and the highest preload.
    let shown = || curves.iter().step_by(curves.len() / 2);
    for (curve, colour) in shown().zip([Colour::SKY, Colour::GREEN, Colour::VERMILION]) {
        let points = curve.time_s.iter().copied().zip(curve.angular_speed_rad_per_s.iter().copied());
        let name = format!("{:.0} mN", 1e3 * curve.preload_n);
        speeds = speeds.layer(Line::new(points).colour(colour).width(2.4).name(name));
    }
    for (index, curve) in shown().enumerate() {
        let first = curve.brake_rad_per_s2 * (0.0 - curve.stop_s);
        let line = Line::new([(0.0, first), (curve.stop_s, 0.0)]).dash(Dash::Dashed);
        speeds = speeds.layer(if index == 2 { line.name("straight line") } else { line });
    }
    let milli = |(preload, friction): (f64, f64)| (1e3 * preload, friction);
    let recovered = curves.iter().map(|curve| milli((curve.preload_n, curve.friction)));
    let made_up = Scatter::new(synthetic.into_iter().map(milli)).size(2.6).colour(Colour::GREY);
    let frictions = Panel::new(grid.cell(0, 1))
        .letter_in("b", Corner::TopRight)
        .x(Axis::linear(60.0, 300.0).label("preload (mN)").ticks(Ticks::every(40.0)))
        .y(Axis::linear(0.0, 0.36).label(r"$\mu$").ticks(Ticks::every(0.1)))
        .layer(Rule::horizontal(mean).name("printed mean"))
        .layer(made_up.name("synthetic, not measured"))
        .layer(Scatter::new(recovered).marker(Marker::Circle).colour(Colour::BLUE).name("model, Eq. (17)"));
    fig.draw(
        Figure::new(DOUBLE_COLUMN, HEIGHT)
            .panel(speeds.legend(Legend::at(Corner::TopRight)))
            .panel(frictions.legend(Legend::at(Corner::TopLeft))),
    );
    Ok(())
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

/// The rotor on the still stator from `first_speed` to rest.
fn braking(case: &MotorCase, mass: f64, preload_n: f64, first_speed: f64) -> Result<Curve, ExperimentError> {
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
    let (contact_radius, gyration_radius) = (case.contact_radius_m, case.gyration_radius_m);
    fitted(BrakingRotor { normal_force: preload_n, mass, contact_radius, gyration_radius }, &points)
}

/// A curve with the line through its points; an error if it does not slow down.
fn fitted(rotor: BrakingRotor, points: &[(f64, f64)]) -> Result<Curve, ExperimentError> {
    let no_line = || ExperimentError::NoData { quantity: "the line of a braking rotor".to_owned() };
    let line = StraightLine::through(points).ok_or_else(no_line)?;
    Ok(Curve {
        preload_n: rotor.normal_force,
        time_s: points.iter().map(|point| point.0).collect(),
        angular_speed_rad_per_s: points.iter().map(|point| point.1).collect(),
        brake_rad_per_s2: line.slope,
        stop_s: -line.intercept / line.slope,
        friction: rotor.friction(line.slope)?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fit(points: &[(f64, f64)]) -> Result<Curve, ExperimentError> {
        let rotor =
            BrakingRotor { normal_force: 0.2, mass: 1e-2, contact_radius: 5e-3, gyration_radius: 1e-2 };
        fitted(rotor, points)
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
    fn a_rotor_that_does_not_brake_is_an_error() {
        let error = fit(&[(0.0, 1.0), (1.0, 2.0), (2.0, 3.0)]).expect_err("speeds up");
        assert!(crate::experiment::chain(&error).contains("angular_acceleration = 1"), "{error:?}");
        let error = fit(&[(0.0, 1.0)]).expect_err("one speed").to_string();
        assert!(error.contains("no data"), "{error}");
    }
}
