//! Beyond the paper: the best hand motion of a toss under constraints, and how much of its advantage remains
//! if inputs are off.

use bouncing_disk::core::Unobserved;
use std::f64::consts::PI;

use bouncing_disk::parameters::Stroke;
use bouncing_disk::toss::{
    InitialSpin, TossConstraints, TossDesign, TossHalfUnits, TossRobustness, best_toss, single_toss,
};
use bouncing_disk::{Platform, System};
use bouncing_disk_plot::{
    Axis, Band, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Legend, Line, Marker, Panel, Rect, Scatter,
    Ticks,
};
use serde::{Deserialize, Serialize};

use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::figures::shared::map_in_parallel;
use crate::progress::Progress;

/// Friction between hand and dough, with more or less flour.
const FRICTION: [f64; 2] = [0.4, 0.7];

/// Angular frequencies of the hand (rad/s): at 8 rad/s and below the dough hardly leaves the hand, and any
/// error keeps it there.
const FREQUENCIES: [f64; 2] = [9.0, 16.0];

/// Limits of the flight (m): none, and that of a low ceiling; and how each is drawn.
const LIMITS: [(Option<f64>, Colour, Dash); 3] = [
    (None, Colour::BLACK, Dash::Solid),
    (Some(0.4), Colour::BLUE, Dash::Dashed),
    (Some(0.2), Colour::VERMILION, Dash::Dotted),
];

/// Half a unit of the last digit that a hand keeps.
const HALF_UNITS: TossHalfUnits = TossHalfUnits {
    stroke: 0.005,
    angular_frequency: 0.25,
    amplitude_angle: 0.005 * PI,
    phase_lag: 0.005 * PI,
    contact_radius: 0.0,
    gyration_radius: 0.0,
    preload_acceleration: 0.0,
};

/// The best hand motion.
#[derive(Debug)]
pub struct ExtraDesign;

/// The data of the best tosses.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraDesignData {
    /// The best hand at each frequency, one list for each limit of height, with its robustness.
    curves: Vec<Vec<(TossDesign, TossRobustness)>>,
    /// The hand of Table I, and its least airborne speed over the range of friction.
    table_one: Stroke,
    table_one_worst_rad_per_s: f64,
}

impl Experiment for ExtraDesign {
    type Data = ExtraDesignData;
    const ID: &'static str = "extra-design";
    const TITLE: &'static str = "The best hand motion of a toss under constraints";

    fn caption(data: &ExtraDesignData) -> String {
        format!(
            "The best hand motion for the dough of Table I with its stroke of {} m, at each frequency: the largest airborne speed that it \
             gives at every friction from {} to {}, with the flight limited in height or not. (a) That speed; bands: its least and most over \
             everything that rounds to the same digits; circle: the hand of Table I, over the same range of friction. (b) Amplitude \
             angle, where 0 is a vertical motion and 1/2 a rotary one, and (c) phase lag of the best hand.",
            data.table_one.stroke, FRICTION[0], FRICTION[1],
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraDesignData, ExperimentError> {
        let count = quality.choose(8, 36);
        progress.start(LIMITS.len() as u64 * count as u64, "designs");
        let best = |highest_flight: Option<f64>, k: i32| {
            let frequency =
                FREQUENCIES[0] + (FREQUENCIES[1] - FREQUENCIES[0]) * f64::from(k) / f64::from(count - 1);
            let table = TossConstraints::pizza_toss();
            let angular_frequency = [frequency; 2];
            let constraints =
                TossConstraints { friction: FRICTION, angular_frequency, highest_flight, ..table };
            let design = best_toss(&constraints, &Unobserved)?;
            let robustness = design.robustness(&HALF_UNITS)?;
            progress.advance(1);
            Ok::<_, ExperimentError>((design, robustness))
        };
        let steps: Vec<i32> = (0..count).collect();
        let mut curves = Vec::new();
        for (limit, ..) in LIMITS {
            curves.push(map_in_parallel(&steps, |&k| best(limit, k))?);
        }
        // The least over a fine grid: the speed is smooth in the friction but for where sliding begins.
        let mut worst = f64::INFINITY;
        for step in 0..=64 {
            worst = worst.min(speed(FRICTION[0] + (FRICTION[1] - FRICTION[0]) * f64::from(step) / 64.0)?);
        }
        Ok(ExtraDesignData { curves, table_one: Stroke::pizza_toss(), table_one_worst_rad_per_s: worst })
    }

    fn draw(data: &ExtraDesignData) -> Result<Figure, ExperimentError> {
        let frequencies = || Axis::linear(8.6, 16.4).ticks(Ticks::every(2.0).minor(2));
        let hand = &data.table_one;
        let circle = |value: f64| {
            let own = Scatter::new([(hand.angular_frequency, value)]).marker(Marker::Circle);
            own.colour(Colour::GREEN).size(6.0).width(1.2)
        };
        let lines = |of: fn(&TossDesign) -> f64| {
            let line = move |(points, (_, colour, dash)): (&Vec<(TossDesign, TossRobustness)>, _)| {
                let points = points.iter().map(|(design, _)| (design.hand.angular_frequency, of(design)));
                Line::new(points).colour(colour).dash(dash).width(1.0)
            };
            data.curves.iter().zip(LIMITS).map(line)
        };
        let named = lines(|design| design.value).zip(LIMITS).map(|(line, (limit, ..))| {
            line.name(limit.map_or("any height".to_owned(), |height| format!("at most {height} m")))
        });
        let most = data.curves.iter().flatten().map(|(_, left)| left.digits.most).fold(0.0, f64::max);
        let bands = data.curves.iter().zip(LIMITS).map(|(points, (_, colour, _))| {
            let band = points
                .iter()
                .map(|(design, left)| (design.hand.angular_frequency, left.digits.least, left.digits.most));
            Band::new(band).colour(colour).opacity(0.15)
        });
        let speeds = Panel::new(Rect::new(40.0, 12.0, 210.0, 165.0))
            .x(frequencies().label(r"$\omega$ (rad/s)"))
            .y(Axis::linear(0.0, 1.12 * most).label(r"airborne speed $\dot{\alpha}_f$ (rad/s)"))
            .letter_in("a", Corner::TopRight)
            .layers(bands)
            .layers(named)
            .layer(circle(data.table_one_worst_rad_per_s).name("Table I"))
            .legend(Legend::at(Corner::BottomRight));
        let angles = Panel::new(Rect::new(306.0, 12.0, 192.0, 78.0))
            .x(frequencies().without_numbers())
            .y(Axis::linear(0.0, 0.5).label(r"$\phi_L/\pi$").ticks(Ticks::every(0.25).minor(5)))
            .letter_in("b", Corner::BottomRight)
            .layers(lines(|design| design.hand.amplitude_angle / PI))
            .layer(circle(hand.amplitude_angle / PI));
        let lags = Panel::new(Rect::new(306.0, 98.0, 192.0, 79.0))
            .x(frequencies().label(r"$\omega$ (rad/s)"))
            .y(Axis::linear(-0.1, 0.1).label(r"$\theta/\pi$").ticks(Ticks::every(0.1).minor(5)))
            .letter_in("c", Corner::BottomRight)
            .layers(lines(|design| design.hand.phase_lag / PI))
            .layer(circle(hand.phase_lag / PI));
        Ok(Figure::new(DOUBLE_COLUMN, 215.0).panels([speeds, angles, lags]))
    }
}

/// The airborne speed (rad/s), in either direction, that the hand of Table I gives the dough; 0 where it does
/// not leave.
fn speed(friction: f64) -> Result<f64, ExperimentError> {
    let mut dough = TossConstraints::pizza_toss().dough;
    dough.friction = friction;
    let system = System::new(Platform::from_stroke(Stroke::pizza_toss())?, dough.build()?)?;
    match single_toss(&system, InitialSpin::AbsoluteRest) {
        Ok(toss) => Ok(toss.airborne_speed.abs()),
        Err(bouncing_disk::Error::NeverLeaves { .. }) => Ok(0.0),
        Err(error) => Err(error.into()),
    }
}
